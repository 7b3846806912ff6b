"""The atlas of limits: where each simplification of a journal bearing fails, one panel for each.

A full bearing of L/D 1/2 with a rigid rotor; errors are those of the force, or of stiffness, against the next
better model. A panel is a family of curves and the level at which a curve counts as failed.
"""

from __future__ import annotations

import warnings
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from itertools import chain

import numpy as np

from ..bearings.journal import JournalBearing
from ..cosim import critical_macro_step
from ..errors import ValidityWarning
from ..films import FilmLaw, FixedArc, MapFilm, ReynoldsFilm, RotatingArc, ShortFilm, SplittingFilm
from ..linear import coefficients
from ..model import Array
from ..progress import Report, silent
from ..rotors import RigidRotor

SPEED = 100.0
"""Angular speed [rad/s]; in dimensionless form nothing depends on it."""

FAILED = 0.1
"""Relative error at which a simplification counts as failed."""

DIRECTIONS = 16
"""Directions in which a displacement is tried."""

ORDERS = ((1, 1), (1, None), (2, None), (3, None), (5, None))
CELLS = ((24, 4), (48, 4), (96, 8), (192, 16))
ECCENTRICITY_RATIOS = (0.1, 0.3, 0.5, 0.7, 0.8, 0.9, 0.95)
MASS_RATIOS = (0.01, 0.1, 1.0)
"""Speed^2 clearance mass / load of the rotor whose macro step is limited."""


@dataclass(frozen=True, kw_only=True)
class Limit:
    """One curve of the atlas.

    Attributes
    ----------
    panel : str
        The simplification.
    name : str
        Which of them.
    abscissa, ordinate : ndarray, shape (n,)
        What it depends on, and the error or limit there; not-a-number where it has none.
    """

    panel: str
    name: str
    abscissa: Array
    ordinate: Array


@dataclass(frozen=True, kw_only=True)
class Panel:
    """How one panel is read.

    Attributes
    ----------
    title : str
    x_label, y_label : str
    logarithmic : bool
        Whether the abscissa is drawn so.
    level : float or None
        Error from which a curve counts as failed; None where the ordinate itself is the limit.
    """

    title: str
    x_label: str
    y_label: str
    level: float | None = FAILED
    logarithmic: bool = False


PANELS = {
    "extent": Panel(
        title="where the film ends",
        x_label="whirl speed / shaft speed at eccentricity ratio .5",
        y_label="error of the force",
    ),
    "order": Panel(
        title="order of the splitting film",
        x_label="eccentricity ratio",
        y_label="error of the force, same arc",
    ),
    "length": Panel(
        title="short bearing",
        x_label="length / diameter",
        y_label="error of the static force",
        logarithmic=True,
    ),
    "grid": Panel(title="grid of the Reynolds film", x_label="eccentricity ratio", y_label="error of K"),
    "linearization": Panel(
        title="linearization",
        x_label="displacement / gap to the wall",
        y_label="error of the change of force",
    ),
    "macro_step": Panel(
        title="macro step, force held",
        x_label="eccentricity ratio",
        y_label="longest stable macro step [deg]",
        level=None,
    ),
}


@dataclass(frozen=True, kw_only=True)
class LimitAtlas:
    """All curves of the atlas.

    Attributes
    ----------
    limits : tuple of Limit
    """

    limits: tuple[Limit, ...]

    def columns(self) -> dict[str, list[object]]:
        """Return the columns of the table, a row for each point of each curve."""
        rows = [
            (one.panel, one.name, float(x), float(y))
            for one in self.limits
            for x, y in zip(one.abscissa, one.ordinate, strict=True)
        ]
        return {
            heading: [row[k] for row in rows]
            for k, heading in enumerate(("simplification", "variant", "at", "error or limit"))
        }


def failure(limit: Limit, level: float) -> float | None:
    """Return where a curve first passes a level, on a straight line of the logarithms; None if nowhere."""
    above = np.flatnonzero(limit.ordinate >= level)
    if not above.size:
        return None
    k = int(above[0])
    if k == 0:
        return float(limit.abscissa[0])
    x, y = limit.abscissa[k - 1 : k + 1], np.log(limit.ordinate[k - 1 : k + 1])
    return float(np.interp(np.log(level), y, x))


def journal_limits(*, report: Report = silent) -> LimitAtlas:
    """Return the atlas of limits of journal bearings; it takes half a minute.

    Parameters
    ----------
    report : callable
        Called with the fraction done and a text.

    Notes
    -----
    References: the map (within 1e-5 of the Reynolds equation) for extent, length and linearization; ten
    functions and all axial modes on the same arc for the order; the map's stiffness for the grid; for the
    macro step the spectral radius of the sampled system, `cosim.critical_macro_step`, at the mass that makes
    speed^2 clearance mass / load the number in the name.
    """
    families = (_extents, _orders, _lengths, _linearizations, _macro_steps, _grids)
    found: list[Limit] = []
    for number, family in enumerate(families):
        report(number / len(families), family.__name__.strip("_").replace("_", " "))
        with warnings.catch_warnings():
            # That a film is used beyond its range is what the atlas shows.
            warnings.simplefilter("ignore", ValidityWarning)
            found += family()
    return LimitAtlas(limits=tuple(found))


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


def _macro_steps() -> Iterator[Limit]:
    ratios = np.array(ECCENTRICITY_RATIOS)
    for mass_ratio in MASS_RATIOS:
        steps = [_critical_angle(ratio, mass_ratio) for ratio in ECCENTRICITY_RATIOS]
        yield Limit(
            panel="macro_step",
            name=f"speed^2 c m / W = {mass_ratio:g}",
            abscissa=ratios,
            ordinate=np.degrees(steps),
        )


def _critical_angle(ratio: float, mass_ratio: float) -> float:
    """Return the critical macro step in shaft rotation [rad]; not-a-number where the rotor whirls anyway."""
    model = bearing(MapFilm())
    position = np.array([ratio * model.clearance, 0.0])
    load = -model.force(position, np.zeros(2), SPEED)
    mass = mass_ratio * float(np.linalg.norm(load)) / (SPEED**2 * model.clearance)
    rotor = RigidRotor(mass=mass, speed=SPEED, gravity=(0.0, 0.0), static_force=(load[0], load[1]))
    found = critical_macro_step(rotor, model, state=list(chain(position, (0.0, 0.0))))
    return np.nan if found.macro_step is None else float(found.macro_step) * SPEED


def failures(atlas: LimitAtlas) -> Sequence[tuple[str, str, float | None]]:
    """Return panel title, curve and where it fails, of all curves with a level."""
    return [
        (PANELS[one.panel].title, one.name, failure(one, level))
        for one in atlas.limits
        if (level := PANELS[one.panel].level) is not None
    ]
