"""Tilting pads on a film whose temperature is a field: their tilts, and what a journal feels of them."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from ...core.errors import ConvergenceError
from ...core.model import Array, Linearization
from ...core.signals import Signal
from ...native import Status
from ...native.pad_kernels import RestPoint
from .pad_bearing import WEDGE
from .pad_film import PadGridFilm
from .pad_matrices import PadMatrices
from .pad_table import least_film
from .tilting_bearing import StaticTiltingPads, TiltingPadBearing, directions, report_pads, turning

QUICK = PadGridFilm(cells=(32, 4))
"""The film of one viscosity with which the search for the tilts begins."""

STEPS, SETTLED, SHARE = 60, 1e-13, 0.5
"""Steps of Newton's method, the last of them in clearances, and the most that one takes of a least film."""


@dataclass(frozen=True, eq=False)
class FrozenTiltingPads(StaticTiltingPads):
    """Tilting pads on a film whose oil keeps its temperature, under a journal at rest.

    Each pad stands so that the film of its own viscosity has no moment about its pivot, and a pivot on a
    spring where that carries the film. Whether a pad has a film at all does not depend on its viscosity: a
    film of one viscosity tells it.

    Parameters
    ----------
    bearing : TiltingPadBearing
    film : FrozenFilm
        Around all pads, as if they had no tilt.
    """

    film: Any

    @property
    def cells(self) -> Any:
        """Cells of the film."""
        return self.film.cells

    @property
    def empty(self) -> np.ndarray:
        """Nodes that no film may start at."""
        return np.asarray(self.film.empty)

    @property
    def inputs(self) -> tuple[Signal, ...]:
        """Those of the bearing."""
        return self.bearing.inputs

    @property
    def outputs(self) -> tuple[Signal, ...]:
        """Those of the bearing."""
        return self.bearing.outputs

    @cached_property
    def _lines(self) -> Array:
        """1 for the lines of each pad, shape (pads, N)."""
        pads = np.arange(len(self.bearing.pivots))[:, None]
        return (self.bearing.arc_at(self.cells.face) == pads) * self.cells.film

    def rest_place(self, load: tuple[float, float], speed: float) -> tuple[float, float] | None:
        """Return about where a journal rests [m]: where the film is frozen; see `core.port`."""
        place: tuple[float, float] | None = self.film.frozen_at
        return place

    def at_rest(self) -> FrozenTiltingPads:
        """Return this film: it has a force for a journal at rest only."""
        return self

    def losses(self, *state: Any, **options: Any) -> None:
        """Return None: the heat of a field has them."""

    def rest_linearization(self, position: ArrayLike, speed: float) -> Linearization:
        """Return the loaded pads about their rest as states; see `TiltingPadBearing.rest_linearization`."""
        return self.matrices(position, speed).linearization()

    def matrices(self, position: ArrayLike, speed: float, slopes: Any = None) -> PadMatrices:
        """Return stiffness, damping and mass of journal and pads; see `StaticTiltingPads.matrices`."""
        place = np.asarray(position, dtype=float)
        tilted = self._tilted(place, speed)

        def own(bearing: TiltingPadBearing, e: Array, w: Array) -> tuple[Array, Array]:
            by_e, by_w = (slope[tilted.loaded].transpose(1, 2, 0) for slope in tilted.slopes)
            return by_e - np.einsum("ijk,jl->ilk", by_w, 0.5 * speed * WEDGE), by_w

        return super().matrices(position, speed, own)

    def eccentricity(self, position: Array, speed: float) -> Array:
        """Return where the film at each line sees the journal from untilted pads, (2, N), in clearances."""
        return self._seen(position, self._tilted(position, speed).places)

    def _seen(self, position: Array, places: Array) -> Array:
        shift = np.einsum("kij,jk->ik", directions(self.bearing.pivots), places)
        return position[:, None] / self.bearing.clearance + shift @ self._lines

    def _tilted(self, position: Array, speed: float) -> TiltedFilm:
        """Return the film of each pad in its tilt; raise what a status of the film of one viscosity says."""
        bearing, c = self.bearing, self.bearing.clearance
        quick = bearing.kernel_on(QUICK).at_rest(position, speed)
        report_pads(bearing, quick.status, quick.pad, position)
        places = np.stack([quick.pads["pivot"], quick.pads["tilt"]]) / c
        Q, R, loaded = directions(bearing.pivots), turning(bearing), quick.pads["unloaded"] == 0.0
        middle = np.einsum("kij,i->jk", Q, position / c) + np.array([[bearing.preload], [0.0]])
        spring = (bearing.pivot_stiffness or 0.0) * c / bearing.force_scale
        for _ in range(STEPS):
            response = self.film.responses(self._seen(position, places), np.zeros(2), speed, self._lines)
            force = np.einsum("kai,ka->ki", Q, response[:, :, 0])
            by_e, by_w = (np.einsum("kai,kab,kbj->kij", Q, response[:, :, k : k + 2], Q) for k in (1, 3))
            tilted = TiltedFilm(places, force, (by_e, by_w), loaded & (by_e[:, 1, 1] != 0.0))
            least = least_film(R @ (middle + places), bearing.extent)
            move = _newton_step(tilted, spring) * tilted.loaded
            places = places + move * np.minimum(1.0, SHARE * least / np.maximum(np.hypot(*move), 1e-300))
            if np.abs(move).max() <= SETTLED:
                return tilted
        raise ConvergenceError(
            f"the tilts of pads on a warm film must be found within {STEPS} steps, and were not, with a "
            f"journal at {position.tolist()} m"
        )

    def _solved(self, position: Array, speed: float) -> RestPoint:
        bearing, c, scale = self.bearing, self.bearing.clearance, self.bearing.force_scale
        tilted = self._tilted(position, speed)
        by_e, Q, loaded = tilted.slopes[0], directions(bearing.pivots), tilted.loaded
        pull = by_e[:, 0, 1] * by_e[:, 1, 0] / np.where(loaded, by_e[:, 1, 1], 1.0)
        own = -scale / c * np.where(loaded, by_e[:, 0, 0] - pull, 0.0)
        spring = bearing.pivot_stiffness
        share = np.ones(len(own)) if spring is None else spring / (spring + own)
        normal, load = Q[:, :, 0], -scale * np.where(loaded, tilted.force[:, 0], 0.0)
        slopes = np.zeros((2, 5))
        slopes[:, :2] = -(normal.T * (own * share)) @ normal
        slopes[:, 4] = -(load * share / speed) @ normal if speed else 0.0
        middle = np.einsum("kij,i->jk", Q, position / c) + np.array([[bearing.preload], [0.0]])
        pads = {
            "tilt": c * tilted.places[1],
            "pivot": c * tilted.places[0],
            "load": load,
            "least": c * least_film(turning(bearing) @ (middle + tilted.places), bearing.extent),
            "unloaded": (~loaded).astype(float),
        }
        return RestPoint(-load @ normal, slopes, pads, Status.OK, 0)


class TiltedFilm(NamedTuple):
    """The films of pads in their tilts, without dimensions, in the frames of their pivots.

    Attributes
    ----------
    places : ndarray, shape (2, pads) [1]
        Deflections of the pivots and tilts, over the clearance.
    force : ndarray, shape (pads, 2) [1/s]
    slopes : (ndarray, ndarray), shape (pads, 2, 2)
        By the place of the journal, and by the source.
    loaded : ndarray of bool, shape (pads,)
    """

    places: Array
    force: Array
    slopes: tuple[Array, Array]
    loaded: np.ndarray


def _newton_step(tilted: TiltedFilm, spring: float) -> Array:
    """Return the move of pivots and tilts (2, pads) towards films without moment that the springs carry."""
    matrix, left = tilted.slopes[0].copy(), -tilted.force
    matrix[:, 1, 1] = np.where(tilted.loaded, -np.abs(matrix[:, 1, 1]), -1.0)
    if spring:
        matrix[:, 0, 0] -= spring
        left = left + spring * np.stack([tilted.places[0], np.zeros(len(left))], axis=1)
    else:
        matrix[:, 0], left[:, 0] = [1.0, 0.0], 0.0
    return np.asarray(np.linalg.solve(matrix, left[..., None])[..., 0].T)
