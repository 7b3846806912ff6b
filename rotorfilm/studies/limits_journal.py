"""The atlas of limits: where each simplification fails, as curves and the level that counts as failed.

A panel is a record: which physics, how its axes read, and a function that yields its curves. Here are those
of a journal bearing, of its supply and of steps in time; `limits_atlas.py` has the others.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace
from functools import cache
from typing import Any

import numpy as np
from numpy.typing import ArrayLike
from scipy.linalg import expm

from ..analysis import coefficients, equilibrium
from ..bearings.films.geometry import Groove
from ..bearings.films.law import FilmLaw
from ..bearings.journal import (
    FixedArc,
    JFOFilm,
    JournalBearing,
    MapFilm,
    ReynoldsFilm,
    RotatingArc,
    ShortFilm,
    SplittingFilm,
    fitted_bearing,
)
from ..core.model import Array
from ..cosim import critical_macro_step
from .coupling_cost import resting_rotor
from .journal_accuracy import SPEED, comparison_bearing
from .study import relative_error

FAILED = 0.1
"""Relative error at which a simplification counts as failed."""


@dataclass(frozen=True, kw_only=True)
class Panel:
    """One panel of the atlas: a simplification, how it is read, and what computes its curves.

    Attributes
    ----------
    physics : str
        Which bearing it is about.
    title : str
    x_label, y_label : str
        Labels of its axes.
    logarithmic : bool
        Whether the abscissa is drawn so.
    level : float or None
        Error from which a curve counts as failed; None where the ordinate itself is the limit.
    curves : callable
        Yields name, abscissa and ordinate of each curve.
    """

    physics: str
    title: str
    x_label: str
    y_label: str
    level: float | None = FAILED
    logarithmic: bool = False
    curves: Callable[[], Iterator[Curve]]

    def limits(self) -> list[Limit]:
        """Return the curves."""
        return [
            Limit(panel=self, name=name, abscissa=np.asarray(x), ordinate=np.asarray(y))
            for name, x, y in self.curves()
        ]


Curve = tuple[str, ArrayLike, ArrayLike]
"""Name, abscissa and ordinate of one curve."""


@dataclass(frozen=True, kw_only=True)
class Limit:
    """One curve of the atlas.

    Attributes
    ----------
    panel : Panel
        The simplification.
    name : str
        Which variant of it.
    abscissa, ordinate : ndarray, shape (n,)
        What it depends on, and the error or limit there; not-a-number where it has none.
    """

    panel: Panel
    name: str
    abscissa: Array
    ordinate: Array


def panel(
    physics: str, title: str, x_label: str, y_label: str, **reading: Any
) -> Callable[[Callable[[], Iterator[Curve]]], Panel]:
    """Make a panel of the function below; arguments as of `Panel`."""
    return lambda curves: Panel(
        physics=physics, title=title, x_label=x_label, y_label=y_label, curves=curves, **reading
    )


@dataclass(frozen=True, kw_only=True)
class LimitAtlas:
    """All curves of the atlas.

    Attributes
    ----------
    limits : tuple of Limit
        The curves, those of a panel in a row.
    """

    limits: tuple[Limit, ...]

    @property
    def panels(self) -> dict[Panel, list[Limit]]:
        """The panels with their curves."""
        return {
            panel: [one for one in self.limits if one.panel is panel]
            for panel in dict.fromkeys(one.panel for one in self.limits)
        }

    def columns(self) -> dict[str, list[object]]:
        """Return the columns of the table, a row for each point of each curve."""
        rows = [
            (
                one.panel.physics,
                one.panel.title,
                one.name,
                one.panel.x_label,
                float(x),
                one.panel.y_label,
                float(y),
            )
            for one in self.limits
            for x, y in zip(one.abscissa, one.ordinate, strict=True)
        ]
        headings = ("physics", "simplification", "variant", "abscissa", "at", "ordinate", "error or limit")
        return {heading: [row[k] for row in rows] for k, heading in enumerate(headings)}


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


def failures(atlas: LimitAtlas) -> list[tuple[Limit, float | None]]:
    """Return all curves with a level, each with the abscissa from which it fails; None if nowhere."""
    return [(one, failure(one, one.panel.level)) for one in atlas.limits if one.panel.level is not None]


# Limits of the films of a journal bearing: a full one of L/D 1/2.
#
# Errors are those of the force, or of stiffness, against the next better model: the map (within 1e-5
# of the Reynolds equation) for extent, length and linearization; ten functions and all axial modes on
# the same arc for the order; the map's stiffness for the grid.


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


JOURNAL_PANELS = (extent, order, length, grid, linearization)
"""Panels of the journal bearing, in the order in which they are drawn."""


# Limits of steps in time: a rigid rotor on the film of a journal bearing.
#
# The time steps are those of the linearized system, which is what limits them: its shortest time
# constant is 1 / |largest eigenvalue|, mass / damping of the film for a light rotor. For the macro
# step the spectral radius of the sampled system, `cosim.critical_macro_step`, at the mass that makes
# speed^2 clearance mass / load the number in the name.


MASS_RATIOS = (0.01, 0.1, 1.0)
"""Speed^2 clearance mass / load of the rotor whose macro step is limited."""

TURNS = 0.25
"""Length of the runs of the time-step panel, in turns of the shaft."""

STEP_MASS, STEP_AT = 0.1, 0.5
"""Speed^2 clearance mass / load and eccentricity ratio of the rotor whose steps are compared."""

LARGEST_ERROR = 1e3
"""Error at which a run that grows without bound is given up."""

SCHEMES: dict[str, Callable[[Array], Array]] = {
    "explicit Euler": lambda Z: np.eye(4) + Z,
    "explicit Runge-Kutta, order 4": lambda Z: (
        np.eye(4) + Z @ (np.eye(4) + Z @ (np.eye(4) + Z @ (np.eye(4) + Z / 4.0) / 3.0) / 2.0)
    ),
    "implicit Euler": lambda Z: np.asarray(np.linalg.inv(np.eye(4) - Z), dtype=float),
    "trapezoidal rule": lambda Z: np.asarray(
        np.linalg.solve(np.eye(4) - 0.5 * Z, np.eye(4) + 0.5 * Z), dtype=float
    ),
}
"""What a step does to the linearized state, by the step times its matrix."""


@panel(
    "rotor",
    "time step, rigid rotor on the film",
    "step / shortest time constant",
    "error of the path / first displacement",
    logarithmic=True,
)
def time_step() -> Iterator[Curve]:
    """Yield what steps of each scheme err by."""
    matrix = _rotor_matrix(STEP_AT, STEP_MASS)
    shortest = 1.0 / float(np.abs(np.linalg.eigvals(matrix)).max())
    whole = TURNS * 2.0 * np.pi / SPEED
    counts = np.unique(np.geomspace(whole / (30.0 * shortest), whole / (0.02 * shortest), 40).astype(int))
    steps = whole / counts[::-1]
    for name, scheme in SCHEMES.items():
        errors = [_step_error(scheme(matrix * step), matrix * step, whole / step) for step in steps.tolist()]
        yield name, steps / shortest, errors


@panel("rotor", "macro step, force held", "eccentricity ratio", "longest stable macro step [deg]", level=None)
def macro_step() -> Iterator[Curve]:
    """Yield the longest macro steps of rotors of several masses."""
    for mass_ratio in MASS_RATIOS:
        steps = [_critical_angle(ratio, mass_ratio) for ratio in ECCENTRICITY_RATIOS]
        yield f"speed^2 c m / W = {mass_ratio:g}", ECCENTRICITY_RATIOS, np.degrees(steps)


def _critical_angle(ratio: float, mass_ratio: float) -> float:
    """Return the critical macro step in shaft rotation [rad]; not-a-number where the rotor whirls anyway."""
    model = bearing(MapFilm())
    rotor = resting_rotor(model, ratio, speed=SPEED, mass_ratio=mass_ratio)
    found = critical_macro_step(rotor, model, state=rotor.initial_state)
    return np.nan if found.macro_step is None else float(found.macro_step) * SPEED


def _rotor_matrix(ratio: float, mass_ratio: float) -> Array:
    """Return A of d/dt (x, y, vx, vy) = A (x, y, vx, vy) about an equilibrium [1/s]; lengths / clearance."""
    model = bearing(MapFilm())
    rotor = resting_rotor(model, ratio, speed=SPEED, mass_ratio=mass_ratio)
    found = coefficients(model, rotor.position, SPEED)
    blocks = [[np.zeros((2, 2)), np.eye(2)], [-found.stiffness / rotor.mass, -found.damping / rotor.mass]]
    return np.block(blocks)


def _step_error(by_scheme: Array, exponent: Array, count: float) -> float:
    """Return the largest error of the position in a run from unit displacement, / that; cut off."""
    exact, state = expm(exponent), np.array([1.0, 0.0, 0.0, 0.0])
    right, worst = state, 0.0
    for _ in range(round(count)):
        state, right = by_scheme @ state, exact @ right
        worst = max(worst, float(np.linalg.norm((state - right)[:2])))
        if worst > LARGEST_ERROR:
            return LARGEST_ERROR
    return worst


ROTOR_PANELS = (time_step, macro_step)
"""Panels of steps in time, in the order in which they are drawn."""


# Limits of Reynolds rupture in a bearing with its supply: a groove on top, against oil that is
# conserved.
#
# Stiffness is that at a whirl of half the speed. With a given flow the groove starves, and Reynolds
# rupture can only have it full at ambient pressure.


RADIUS, CLEARANCE, VISCOSITY, SUPPLY_SPEED = 0.05, 1e-4, 0.02, 100.0 * math.pi
SUPPLY_CELLS = (96, 8)

LOADS = (0.05, 0.1, 0.2, 0.4, 0.8, 1.6, 3.2)
PRESSURES = (0.001, 0.003, 0.01, 0.03, 0.1, 0.2)
MISSING = (0.0, 0.15, 0.3, 0.45, 0.6, 0.8)
AT_LOAD, AT_PRESSURE = 0.3, 0.01
QUANTITIES = ("place", "side flow", "friction torque", "stiffness")


@panel(
    "supply", f"Reynolds rupture, supply {AT_PRESSURE:g}", "Sommerfeld number So", "error", logarithmic=True
)
def supply_load() -> Iterator[Curve]:
    """Yield what Reynolds rupture errs by as the load rises, at one supply pressure."""
    yield from _curves(LOADS, lambda load: _errors(load, AT_PRESSURE))


@panel(
    "supply",
    f"Reynolds rupture, So {AT_LOAD:g}",
    "supply pressure c^2/(12 viscosity R^2 speed)",
    "error",
    logarithmic=True,
)
def supply_pressure() -> Iterator[Curve]:
    """Yield what Reynolds rupture errs by as the supply pressure rises, at one load."""
    yield from _curves(PRESSURES, lambda pressure: _errors(AT_LOAD, pressure))


@panel(
    "supply",
    f"Reynolds rupture, given flow, So {AT_LOAD:g}",
    "share missing of the flow at ambient pressure",
    "error",
)
def supply_starvation() -> Iterator[Curve]:
    """Yield what Reynolds rupture errs by as the groove gets less oil than it would take, at one load."""
    yield from _curves(MISSING, lambda missing: _errors(AT_LOAD, 0.0, 1.0 - missing))


def _curves(abscissa: tuple[float, ...], errors: Callable[[float], dict[str, float]]) -> Iterator[Curve]:
    found = [errors(at) for at in abscissa]
    for quantity in QUANTITIES:
        yield quantity, abscissa, [one[quantity] for one in found]


def _bearing(pressure: float) -> JournalBearing:
    """Return the bearing at a supply pressure over 12 viscosity R^2 speed/c^2."""
    top = Groove(center=0.5 * math.pi, width=math.radians(20.0), length=0.8 * RADIUS)
    bearing = JournalBearing(
        radius=RADIUS,
        length=RADIUS,
        clearance=CLEARANCE,
        viscosity=VISCOSITY,
        grooves=(top,),
        film=ReynoldsFilm(cells=SUPPLY_CELLS),
    )
    return replace(bearing, supply_pressure=pressure * SUPPLY_SPEED * bearing.pressure_scale)


def _load(bearing: JournalBearing, sommerfeld: float) -> list[float]:
    return [0.0, -2.0 * sommerfeld * SUPPLY_SPEED * bearing.force_scale]


@cache
def _full_flow() -> float:
    """Return what the groove takes at `AT_LOAD` and ambient pressure [m3/s]."""
    film: Any = JFOFilm(bearing=_bearing(0.0), cells=SUPPLY_CELLS)
    at = equilibrium(film, _load(film.bearing, AT_LOAD), SUPPLY_SPEED)
    return float(film.solve(at.position, SUPPLY_SPEED).side_flow)


def _errors(sommerfeld: float, pressure: float, share: float | None = None) -> dict[str, float]:
    bearing = _bearing(pressure)
    flow = None if share is None else share * _full_flow()
    film: Any = JFOFilm(bearing=bearing, cells=SUPPLY_CELLS, supply_flow=flow)
    load = _load(bearing, sommerfeld)
    own, better = equilibrium(bearing, load, SUPPLY_SPEED), equilibrium(film, load, SUPPLY_SPEED)
    assert own.losses is not None
    assert better.losses is not None
    K = coefficients(bearing, own.position, SUPPLY_SPEED).stiffness
    other = coefficients(film, better.position, SUPPLY_SPEED, frequency=0.5 * SUPPLY_SPEED).stiffness
    flows = float(own.losses.side_flow) / float(better.losses.side_flow)
    torques = float(own.losses.friction_torque) / float(better.losses.friction_torque)
    place = float(np.hypot(*(own.position - better.position)) / np.hypot(*better.position))
    stiffness = float(np.abs(K - other).max() / np.abs(other).max())
    return dict(zip(QUANTITIES, (place, abs(flows - 1.0), abs(torques - 1.0), stiffness), strict=True))


SUPPLY_PANELS = (supply_load, supply_pressure, supply_starvation)
"""Panels of a bearing's supply, in the order in which they are drawn."""
