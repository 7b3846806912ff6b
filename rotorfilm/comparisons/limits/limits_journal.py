"""Limits of the films of a journal bearing: a full one of L/D 1/2.

Errors are those of the force, or of stiffness, against the next better model: the map (within 1e-5 of the
Reynolds equation) for extent, length and linearization; ten functions and all axial modes on the same arc for
the order; the map's stiffness for the grid.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace

import numpy as np

from ...bearings.films.law import FilmLaw
from ...bearings.journal import (
    FixedArc,
    JournalBearing,
    MapFilm,
    ReynoldsFilm,
    RotatingArc,
    ShortFilm,
    SplittingFilm,
    fitted_bearing,
)
from ...linear import coefficients
from ...model import Array
from ..journal.journal_rungs import comparison_bearing
from ..journal.journal_states import SPEED, relative_error
from .limit_panels import Curve, panel

DIRECTIONS = 16
"""Directions in which a displacement is tried."""

ORDERS = ((1, 1), (1, None), (2, None), (3, None), (5, None))
CELLS = ((24, 4), (48, 4), (96, 8), (192, 16))
ECCENTRICITY_RATIOS = (0.1, 0.3, 0.5, 0.7, 0.8, 0.9, 0.95)


def bearing(film: FilmLaw, slenderness: float = 0.5) -> JournalBearing:
    """Return the bearing of the atlas with a film."""
    return fitted_bearing(comparison_bearing(slenderness), film)


def _static(model: JournalBearing, ratios: Array) -> Array:
    position = np.array([ratios * model.clearance, np.zeros_like(ratios)])
    return model.force(position, np.zeros_like(position), SPEED)


@panel(
    "journal",
    "where the film ends",
    "whirl speed / shaft speed at eccentricity ratio .5",
    "error of the force",
)
def extent() -> Iterator[Curve]:
    """Yield what arcs err by in circular whirl."""
    whirl = np.linspace(-0.5, 1.5, 33)
    whirl = whirl[np.abs(whirl - 0.5) > 0.02]  # no source of pressure there
    exact = bearing(MapFilm())
    e = 0.5 * exact.clearance
    position = np.array([np.full_like(whirl, e), np.zeros_like(whirl)])
    velocity = np.array([np.zeros_like(whirl), whirl * SPEED * e])
    right = exact.force(position, velocity, SPEED)
    for name, rupture in (("arc fixed in small motion", FixedArc()), ("arc that turns", RotatingArc())):
        model = bearing(SplittingFilm(order=(5, None), rupture=rupture))
        yield name, whirl, relative_error(model.force(position, velocity, SPEED), right)


@panel("journal", "order of the splitting film", "eccentricity ratio", "error of the force, same arc")
def order() -> Iterator[Curve]:
    """Yield what few functions err by."""
    ratios = np.linspace(0.05, 0.95, 19)
    right = _static(bearing(SplittingFilm(order=(10, None), rupture=RotatingArc())), ratios)
    for n, m in ORDERS:
        film = SplittingFilm(order=(n, m), rupture=RotatingArc())
        name = f"({n}, {'all' if m is None else m})"
        yield name, ratios, relative_error(_static(bearing(film), ratios), right)


@panel("journal", "short bearing", "length / diameter", "error of the static force", logarithmic=True)
def length() -> Iterator[Curve]:
    """Yield what the short film errs by."""
    slenderness = np.geomspace(0.1, 2.0, 14)
    for ratio in (0.2, 0.6, 0.9):
        at = np.array([ratio])
        errors = [
            relative_error(_static(bearing(ShortFilm(), ld), at), _static(bearing(MapFilm(), ld), at))[0]
            for ld in slenderness.tolist()
        ]
        yield f"eccentricity ratio {ratio:g}", slenderness, errors


@panel("journal", "grid of the Reynolds film", "eccentricity ratio", "error of K")
def grid() -> Iterator[Curve]:
    """Yield what coarse grids err by."""
    exact = bearing(MapFilm())
    positions = [np.array([ratio * exact.clearance, 0.0]) for ratio in ECCENTRICITY_RATIOS]
    right = [coefficients(exact, position, SPEED).stiffness for position in positions]
    for cells in CELLS:
        model = replace(exact, film=ReynoldsFilm(cells=cells))
        errors = [
            np.linalg.norm(coefficients(model, position, SPEED).stiffness - K) / np.linalg.norm(K)
            for position, K in zip(positions, right, strict=True)
        ]
        yield f"{cells[0]} x {cells[1]} cells", ECCENTRICITY_RATIOS, errors


@panel("journal", "linearization", "displacement / gap to the wall", "error of the change of force")
def linearization() -> Iterator[Curve]:
    """Yield what stiffness errs by in large displacements."""
    model, parts = bearing(MapFilm()), np.geomspace(0.01, 0.8, 20)
    angles = np.linspace(0.0, 2.0 * np.pi, DIRECTIONS, endpoint=False)
    for ratio in (0.2, 0.5, 0.8):
        at = np.array([ratio * model.clearance, 0.0])
        K = coefficients(model, at, SPEED).stiffness
        still = model.force(at, np.zeros(2), SPEED)
        gap = (1.0 - ratio) * model.clearance
        errors = [_worst_direction(model, at, K, still, part * gap, angles) for part in parts.tolist()]
        yield f"about eccentricity ratio {ratio:g}", parts, errors


def _worst_direction(
    model: JournalBearing, at: Array, stiffness: Array, still: Array, size: float, angles: Array
) -> float:
    """Return the largest error of the linear change of force / the largest change, over directions."""
    step = size * np.array([np.cos(angles), np.sin(angles)])
    right = model.force(at[:, None] + step, np.zeros_like(step), SPEED) - still[:, None]
    wrong = np.linalg.norm(-stiffness @ step - right, axis=0)
    return float(wrong.max() / np.linalg.norm(right, axis=0).max())


PANELS = (extent, order, length, grid, linearization)
"""Panels of the journal bearing, in the order in which they are drawn."""
