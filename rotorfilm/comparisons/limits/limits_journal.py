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
)
from ...linear import coefficients
from ...model import Array
from .limit_panels import Limit, Panel, PanelCurves

SPEED = 100.0
"""Angular speed [rad/s]; in dimensionless form nothing depends on it."""

DIRECTIONS = 16
"""Directions in which a displacement is tried."""

ORDERS = ((1, 1), (1, None), (2, None), (3, None), (5, None))
CELLS = ((24, 4), (48, 4), (96, 8), (192, 16))
ECCENTRICITY_RATIOS = (0.1, 0.3, 0.5, 0.7, 0.8, 0.9, 0.95)


def bearing(film: FilmLaw, slenderness: float = 0.5) -> JournalBearing:
    """Return the bearing of the atlas with a film."""
    return JournalBearing(radius=0.05, length=0.1 * slenderness, clearance=1e-4, viscosity=0.1, film=film)


def _relative(force: Array, right: Array) -> Array:
    return np.asarray(np.linalg.norm(force - right, axis=0) / np.linalg.norm(right, axis=0))


def _static(model: JournalBearing, ratios: Array) -> Array:
    position = np.array([ratios * model.clearance, np.zeros_like(ratios)])
    return model.force(position, np.zeros_like(position), SPEED)


def _extents() -> Iterator[Limit]:
    whirl = np.linspace(-0.5, 1.5, 33)
    whirl = whirl[np.abs(whirl - 0.5) > 0.02]  # no source of pressure there
    exact = bearing(MapFilm())
    e = 0.5 * exact.clearance
    position = np.array([np.full_like(whirl, e), np.zeros_like(whirl)])
    velocity = np.array([np.zeros_like(whirl), whirl * SPEED * e])
    right = exact.force(position, velocity, SPEED)
    for name, rupture in (("arc fixed in small motion", FixedArc()), ("arc that turns", RotatingArc())):
        model = bearing(SplittingFilm(order=(5, None), rupture=rupture))
        error = _relative(model.force(position, velocity, SPEED), right)
        yield Limit(panel="extent", name=name, abscissa=whirl, ordinate=error)


def _orders() -> Iterator[Limit]:
    ratios = np.linspace(0.05, 0.95, 19)
    right = _static(bearing(SplittingFilm(order=(10, None), rupture=RotatingArc())), ratios)
    for n, m in ORDERS:
        film = SplittingFilm(order=(n, m), rupture=RotatingArc())
        name = f"({n}, {'all' if m is None else m})"
        error = _relative(_static(bearing(film), ratios), right)
        yield Limit(panel="order", name=name, abscissa=ratios, ordinate=error)


def _lengths() -> Iterator[Limit]:
    slenderness = np.geomspace(0.1, 2.0, 14)
    for ratio in (0.2, 0.6, 0.9):
        at = np.array([ratio])
        errors = [
            _relative(_static(bearing(ShortFilm(), ld), at), _static(bearing(MapFilm(), ld), at))[0]
            for ld in slenderness.tolist()
        ]
        yield Limit(
            panel="length",
            name=f"eccentricity ratio {ratio:g}",
            abscissa=slenderness,
            ordinate=np.array(errors),
        )


def _grids() -> Iterator[Limit]:
    exact = bearing(MapFilm())
    positions = [np.array([ratio * exact.clearance, 0.0]) for ratio in ECCENTRICITY_RATIOS]
    right = [coefficients(exact, position, SPEED).stiffness for position in positions]
    for cells in CELLS:
        model = replace(exact, film=ReynoldsFilm(cells=cells))
        errors = [
            np.linalg.norm(coefficients(model, position, SPEED).stiffness - K) / np.linalg.norm(K)
            for position, K in zip(positions, right, strict=True)
        ]
        yield Limit(
            panel="grid",
            name=f"{cells[0]} x {cells[1]} cells",
            abscissa=np.array(ECCENTRICITY_RATIOS),
            ordinate=np.array(errors),
        )


def _linearizations() -> Iterator[Limit]:
    model, parts = bearing(MapFilm()), np.geomspace(0.01, 0.8, 20)
    angles = np.linspace(0.0, 2.0 * np.pi, DIRECTIONS, endpoint=False)
    for ratio in (0.2, 0.5, 0.8):
        at = np.array([ratio * model.clearance, 0.0])
        K = coefficients(model, at, SPEED).stiffness
        still = model.force(at, np.zeros(2), SPEED)
        gap = (1.0 - ratio) * model.clearance
        errors = [_worst_direction(model, at, K, still, part * gap, angles) for part in parts.tolist()]
        name = f"about eccentricity ratio {ratio:g}"
        yield Limit(panel="linearization", name=name, abscissa=parts, ordinate=np.array(errors))


def _worst_direction(
    model: JournalBearing, at: Array, stiffness: Array, still: Array, size: float, angles: Array
) -> float:
    """Return the largest error of the linear change of force / the largest change, over directions."""
    step = size * np.array([np.cos(angles), np.sin(angles)])
    right = model.force(at[:, None] + step, np.zeros_like(step), SPEED) - still[:, None]
    wrong = np.linalg.norm(-stiffness @ step - right, axis=0)
    return float(wrong.max() / np.linalg.norm(right, axis=0).max())


PANELS: dict[str, PanelCurves] = {
    "extent": PanelCurves(
        Panel(
            physics="journal",
            title="where the film ends",
            x_label="whirl speed / shaft speed at eccentricity ratio .5",
            y_label="error of the force",
        ),
        _extents,
    ),
    "order": PanelCurves(
        Panel(
            physics="journal",
            title="order of the splitting film",
            x_label="eccentricity ratio",
            y_label="error of the force, same arc",
        ),
        _orders,
    ),
    "length": PanelCurves(
        Panel(
            physics="journal",
            title="short bearing",
            x_label="length / diameter",
            y_label="error of the static force",
            logarithmic=True,
        ),
        _lengths,
    ),
    "grid": PanelCurves(
        Panel(
            physics="journal",
            title="grid of the Reynolds film",
            x_label="eccentricity ratio",
            y_label="error of K",
        ),
        _grids,
    ),
    "linearization": PanelCurves(
        Panel(
            physics="journal",
            title="linearization",
            x_label="displacement / gap to the wall",
            y_label="error of the change of force",
        ),
        _linearizations,
    ),
}
"""Panels of the journal bearing, in the order in which they are drawn."""
