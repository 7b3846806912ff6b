"""Free ends of a ruptured film: moved until the pressure leaves them without slope.

At the free end of the complementarity solution u and its gradient vanish, and just inside u_yy = kappa. An
end that is off by delta shows the slope kappa delta, and moving it changes the slope by -kappa per unit to
first order, without any influence from afar: the local step delta = slope/kappa converges quadratically. What
is left changes the energy by -int C slope^3/(6 kappa) dzeta, C the conductance across the end.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from ....model import Array
from .potential_basis import along, end_shapes
from .potential_domain import Region, RitzResolution, Source, local_film

FLOOR = 0.02
"""Least curvature in the remainder, relative to the largest at that end: it vanishes with the slope."""


class EndState(NamedTuple):
    """Curvature kappa and conductance C across both ends at the axial nodes, each (2, Q)."""

    curvature: Array
    conductance: Array


def end_state(source: Source, area: Region) -> EndState:
    """Return the curvature du/dy that complementarity asks for at the ends, and the conductance."""
    film = local_film(source, area.end)
    conductance = film.around + film.along * area.slope**2
    return EndState(source.at(film.gamma) * film.rate / conductance, conductance)


def shape_step(slope: Array, state: EndState, resolution: RitzResolution) -> Array:
    """Return the change of the ends' series (2, S): slope = kappa delta in least squares."""
    value, _ = end_shapes(resolution.along, resolution.shapes)
    root = np.sqrt(along(resolution.along).weight)[:, None]
    outward = (-1.0, 1.0)
    steps = [
        sign * np.linalg.lstsq(root * np.maximum(kappa, 0.0)[:, None] * value, root[:, 0] * m, rcond=1e-8)[0]
        for sign, m, kappa in zip(outward, slope, state.curvature, strict=True)
    ]
    return np.stack(steps)


def remainder(slope: Array, state: EndState, resolution: RitzResolution) -> tuple[float, float]:
    """Return the change of J by the slopes left at the ends, and the same with all slopes positive."""
    weight = along(resolution.along).weight
    kappa = np.maximum(state.curvature, FLOOR * state.curvature.max(axis=1, keepdims=True))
    density = weight * state.conductance * slope**3 / kappa
    return -2.0 * float(np.sum(density)), 2.0 * float(np.sum(np.abs(density)))
