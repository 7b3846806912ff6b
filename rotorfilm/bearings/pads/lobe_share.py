"""What the verified bounds of the maps of single pads leave open of a bearing of fixed ones at rest."""

from __future__ import annotations

import math

import numpy as np

from ...model import Array
from ..films.map_bounds import matrix_sizes
from .lobe import Lobe
from .lobed_bearing import LobedBearing
from .pad_bounds import DIRECTIONS, FLOOR
from .pad_film import PadMapFilm


class LobeShare:
    """What the bound of the map of one pad leaves open at rest: of its force [N], stiffness, damping.

    The bounds are relative to force and matrices, or to `FLOOR` of their largest values over all directions.
    """

    def __init__(
        self, bearing: LobedBearing, film: PadMapFilm, lobe: Lobe, position: Array, speed: float
    ) -> None:
        table = film.table(lobe.extent, bearing.slenderness)
        kernel, c, half = table.kernel(), bearing.clearance, 0.5 * speed
        cos, sin = math.cos(lobe.middle), math.sin(lobe.middle)
        e = np.array([[cos, sin], [-sin, cos]]) @ (position / c - np.array(lobe.center))
        w = half * np.array([e[1], -e[0]])
        size = float(np.hypot(*w))
        angle = np.append(np.arctan2(w[1], w[0]), (np.arange(DIRECTIONS) + 0.5) * 2.0 * np.pi / DIRECTIONS)
        places = np.repeat(e[:, None], angle.size, axis=1)
        around = np.stack([np.cos(angle), np.sin(angle)])
        forces = size * np.hypot(*kernel.force(places, around).values)
        # The slopes in the place are of degree one in the source, those in the source of degree zero.
        by_e, by_w = matrix_sizes(kernel.jacobian(places, around).values) * np.array([[size], [1.0]])
        own, by_e, by_w = (max(each[0], FLOOR * each.max()) for each in (forces, by_e, by_w))
        least = float(lobe.least_film(position / c))
        open_force, open_slopes = (table.bound(least, slopes=each) for each in (False, True))
        scale = bearing.force_scale
        self.force = open_force * scale * own
        self.stiffness = open_slopes * scale / c * (by_e + abs(half) * by_w)
        self.damping = open_slopes * scale / c * by_w
