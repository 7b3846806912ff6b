"""The atlas of limits: where each simplification fails, as curves and the level that counts as failed.

A panel is a record: which physics, how its axes read, and a function that yields its curves.
"""

from __future__ import annotations

import math
import tomllib
import warnings
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, replace
from functools import cache
from importlib import resources
from typing import Any

import numpy as np
from numpy.typing import ArrayLike
from scipy.linalg import expm

from ..analysis import coefficients, equilibrium
from ..bearings import journal as journals
from ..bearings.bush import BushReaction, f4k20_bush
from ..bearings.contact import ContactScheme, PointContact, StaggeredScheme, UpwindScheme
from ..bearings.damper import FiniteSqueeze, PorousDamper
from ..bearings.films.geometry import Groove, HalfSommerfeld
from ..bearings.films.law import FilmLaw
from ..bearings.oil import Cooling, Oil
from ..core.errors import InputError, ValidityWarning
from ..core.model import Array
from ..core.progress import Report, silent
from ..core.units import CELSIUS
from ..cosim import critical_macro_step
from . import bush_accuracy
from .contact_precision import natural_motions, published_contact
from .coupling_cost import resting_rotor
from .damper_accuracy import compared_damper
from .heat_accuracy import HeatAnswer, HeatCase, HeatModel, answered, position_error
from .journal_accuracy import SPEED, comparison_bearing
from .study import StudyResult, StudyRow, relative_error

FAILED = 0.1
"""Relative error at which a simplification counts as failed."""

Curve = tuple[str, ArrayLike, ArrayLike]
"""Name, abscissa and ordinate of one curve."""

Curves = dict[str, tuple[Array, Array]]
"""Abscissa and ordinate of the curves of a panel, by their names."""


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
        Yields name, abscissa and ordinate of each curve; not-a-number where it has none.
    """

    physics: str
    title: str
    x_label: str
    y_label: str
    level: float | None = FAILED
    logarithmic: bool = False
    curves: Callable[[], Iterator[Curve]]


def limits_atlas(physics: Sequence[str] | None = None, *, report: Report = silent) -> StudyResult:
    """Return the atlas of limits; all of it takes some 20 s of CPU.

    A case is a panel, a rung a point of one of its curves, and the notes have the panels by their titles.

    Parameters
    ----------
    physics : sequence of str, optional
        Which of `PHYSICS`; all by default.
    report : callable
        Called with the fraction done and a text.

    Raises
    ------
    InputError
        If one is not in `PHYSICS`, or there is none.
    """
    physics = PHYSICS if physics is None else physics
    for name in physics:
        if name not in PHYSICS:
            raise InputError(f"physics must be among {', '.join(PHYSICS)}, got {name!r}")
    chosen = [each for each in PANELS if each.physics in physics]
    if not chosen:
        raise InputError(f"physics must name one of {', '.join(PHYSICS)}, got none")
    found: list[StudyRow] = []
    for number, each in enumerate(chosen):
        report(number / len(chosen), f"{each.physics}: {each.title}")
        with warnings.catch_warnings(action="ignore", category=ValidityWarning):
            # That a model is used beyond its range is what the atlas shows.
            found += panel_points(each)
    notes = {each.title: each for each in chosen}
    return StudyResult(study="limits", reference="the next better model", notes=notes, rungs=tuple(found))


def panel_points(each: Panel) -> Iterator[StudyRow]:
    """Yield the points of the curves of a panel."""
    for name, abscissa, ordinate in each.curves():
        for x, y in zip(np.asarray(abscissa), np.asarray(ordinate), strict=True):
            values = {
                "physics": each.physics,
                "simplification": each.title,
                "variant": name,
                "abscissa": each.x_label,
                "at": float(x),
                "ordinate": each.y_label,
                "error or limit": float(y),
            }
            yield StudyRow(name=name, family=name, label="", case=each.title, values=values)


def limit_curves(atlas: StudyResult) -> dict[Panel, Curves]:
    """Return the curves of an atlas by their panels."""
    points: dict[Panel, dict[str, list[tuple[float, float]]]] = {}
    for rung in atlas.rungs:
        own = points.setdefault(atlas.notes[rung.case], {}).setdefault(rung.family, [])
        own.append((rung["at"], rung["error or limit"]))
    return {
        each: {name: (np.array(curve)[:, 0], np.array(curve)[:, 1]) for name, curve in curves.items()}
        for each, curves in points.items()
    }


def failure(abscissa: Array, ordinate: Array, level: float) -> float | None:
    """Return where a curve first passes a level, on a straight line of the logarithms; None if nowhere."""
    above = np.flatnonzero(ordinate >= level)
    if not above.size:
        return None
    k = int(above[0])
    if k == 0:
        return float(abscissa[0])
    return float(np.interp(np.log(level), np.log(ordinate[k - 1 : k + 1]), abscissa[k - 1 : k + 1]))


def failures(atlas: StudyResult) -> dict[Panel, dict[str, float | None]]:
    """Return the panels with a level: the abscissa from which each of their curves fails; None if nowhere."""
    return {
        each: {name: failure(*curve, each.level) for name, curve in curves.items()}
        for each, curves in limit_curves(atlas).items()
        if each.level is not None
    }


# Limits of the films of a journal bearing: a full one of L/D 1/2.
#
# Errors are those of the force, or of stiffness, against the next better model: the map (within 1e-5
# of the Reynolds equation) for extent, length and linearization; ten functions and all axial modes on
# the same arc for the order; the map's stiffness for the grid.


DIRECTIONS = 16
"""Directions in which a displacement is tried."""

ORDERS = ((1, 1), (1, None), (2, None), (3, None), (5, None))
JOURNAL_CELLS = ((24, 4), (48, 4), (96, 8), (192, 16))
ECCENTRICITY_RATIOS = (0.1, 0.3, 0.5, 0.7, 0.8, 0.9, 0.95)


def journal(film: FilmLaw, slenderness: float = 0.5) -> journals.JournalBearing:
    """Return the bearing of the atlas with a film."""
    return journals.fitted_bearing(comparison_bearing(slenderness), film)


def _static(model: journals.JournalBearing, ratios: Array) -> Array:
    position = np.array([ratios * model.clearance, np.zeros_like(ratios)])
    return model.force(position, np.zeros_like(position), SPEED)


def _whirling(
    model: journals.JournalBearing | PorousDamper, radius: Array, rate: Array | float, speed: ArrayLike
) -> Array:
    """Return the forces (2, n) on circles of radii [m] at rates and speeds [rad/s]."""
    still = np.zeros_like(radius)
    return model.force(np.array([radius, still]), np.array([still, rate * radius]), speed)


def journal_extent() -> Iterator[Curve]:
    """Yield the errors of arcs in circular whirl."""
    whirl = np.linspace(-0.5, 1.5, 33)
    whirl = whirl[np.abs(whirl - 0.5) > 0.02]  # no source of pressure there
    exact = journal(journals.MapFilm())
    radius = np.full_like(whirl, 0.5 * exact.clearance)
    right = _whirling(exact, radius, whirl * SPEED, SPEED)
    for name, rupture in (
        ("arc fixed in small motion", journals.FixedArc()),
        ("arc that turns", journals.RotatingArc()),
    ):
        model = journal(journals.SplittingFilm(order=(5, None), rupture=rupture))
        yield name, whirl, relative_error(_whirling(model, radius, whirl * SPEED, SPEED), right)


def journal_order() -> Iterator[Curve]:
    """Yield the errors of few functions."""
    ratios = np.linspace(0.05, 0.95, 19)

    def force(n: int, m: int | None) -> Array:
        return _static(journal(journals.SplittingFilm(order=(n, m), rupture=journals.RotatingArc())), ratios)

    right = force(10, None)
    for n, m in ORDERS:
        yield f"({n}, {'all' if m is None else m})", ratios, relative_error(force(n, m), right)


def journal_length() -> Iterator[Curve]:
    """Yield the errors of the short film."""
    slenderness = np.geomspace(0.1, 2.0, 14)
    for ratio in (0.2, 0.6, 0.9):
        pairs = [
            [
                _static(journal(film, ld), np.array([ratio]))
                for film in (journals.ShortFilm(), journals.MapFilm())
            ]
            for ld in slenderness.tolist()
        ]
        yield f"eccentricity ratio {ratio:g}", slenderness, [relative_error(*pair)[0] for pair in pairs]


def journal_grid() -> Iterator[Curve]:
    """Yield the errors of coarse grids."""
    exact = journal(journals.MapFilm())

    def stiffness(model: journals.JournalBearing) -> list[Array]:
        positions = [np.array([ratio * exact.clearance, 0.0]) for ratio in ECCENTRICITY_RATIOS]
        return [coefficients(model, position, SPEED).stiffness for position in positions]

    right = stiffness(exact)
    for cells in JOURNAL_CELLS:
        pairs = zip(stiffness(replace(exact, film=journals.ReynoldsFilm(cells=cells))), right, strict=True)
        errors = [np.linalg.norm(own - K) / np.linalg.norm(K) for own, K in pairs]
        yield f"{cells[0]} x {cells[1]} cells", ECCENTRICITY_RATIOS, errors


def journal_linearization() -> Iterator[Curve]:
    """Yield the errors of stiffness in large displacements, in the worst direction."""
    model, parts = journal(journals.MapFilm()), np.geomspace(0.01, 0.8, 20)
    angles = np.linspace(0.0, 2.0 * np.pi, DIRECTIONS, endpoint=False)
    around = np.array([np.cos(angles), np.sin(angles)])
    for ratio in (0.2, 0.5, 0.8):
        at = np.array([ratio * model.clearance, 0.0])
        K = coefficients(model, at, SPEED).stiffness
        still = model.force(at, np.zeros(2), SPEED)
        gap, errors = (1.0 - ratio) * model.clearance, []
        for part in parts.tolist():
            step = part * gap * around
            right = model.force(at[:, None] + step, np.zeros_like(step), SPEED) - still[:, None]
            wrong = np.linalg.norm(-K @ step - right, axis=0)
            errors.append(float(wrong.max() / np.linalg.norm(right, axis=0).max()))
        yield f"about eccentricity ratio {ratio:g}", parts, errors


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


def supply_load() -> Iterator[Curve]:
    """Yield the errors of Reynolds rupture as the load rises, at one supply pressure."""
    yield from _supply_curves(LOADS, lambda load: _supply_errors(load, AT_PRESSURE))


def supply_pressure() -> Iterator[Curve]:
    """Yield the errors of Reynolds rupture as the supply pressure rises, at one load."""
    yield from _supply_curves(PRESSURES, lambda pressure: _supply_errors(AT_LOAD, pressure))


def supply_starvation() -> Iterator[Curve]:
    """Yield the errors of Reynolds rupture as the groove gets less oil than it would take, at one load."""
    yield from _supply_curves(MISSING, lambda missing: _supply_errors(AT_LOAD, 0.0, 1.0 - missing))


def _supply_curves(abscissa: Sequence[float], errors: Callable[[float], Sequence[float]]) -> Iterator[Curve]:
    for quantity, values in zip(QUANTITIES, zip(*map(errors, abscissa), strict=True), strict=True):
        yield quantity, abscissa, values


def _supplied(pressure: float) -> journals.JournalBearing:
    """Return the bearing at a supply pressure over 12 viscosity R^2 speed/c^2."""
    top = Groove(center=0.5 * math.pi, width=math.radians(20.0), length=0.8 * RADIUS)
    bearing = journals.JournalBearing(
        radius=RADIUS,
        length=RADIUS,
        clearance=CLEARANCE,
        viscosity=VISCOSITY,
        grooves=(top,),
        film=journals.ReynoldsFilm(cells=SUPPLY_CELLS),
    )
    return replace(bearing, supply_pressure=pressure * SUPPLY_SPEED * bearing.pressure_scale)


def _supply_load(bearing: journals.JournalBearing, sommerfeld: float) -> list[float]:
    return [0.0, -2.0 * sommerfeld * SUPPLY_SPEED * bearing.force_scale]


@cache
def _full_flow() -> float:
    """Return what the groove takes at `AT_LOAD` and ambient pressure [m3/s]."""
    film: Any = journals.JFOFilm(bearing=_supplied(0.0), cells=SUPPLY_CELLS)
    at = equilibrium(film, _supply_load(film.bearing, AT_LOAD), SUPPLY_SPEED)
    return float(film.solve(at.position, SUPPLY_SPEED).side_flow)


def _supply_errors(sommerfeld: float, pressure: float, share: float | None = None) -> tuple[float, ...]:
    """Return the errors of `QUANTITIES`."""
    bearing = _supplied(pressure)
    flow = None if share is None else share * _full_flow()
    film: Any = journals.JFOFilm(bearing=bearing, cells=SUPPLY_CELLS, supply_flow=flow)
    load = _supply_load(bearing, sommerfeld)
    own, better = equilibrium(bearing, load, SUPPLY_SPEED), equilibrium(film, load, SUPPLY_SPEED)
    assert own.losses is not None
    assert better.losses is not None
    K = coefficients(bearing, own.position, SUPPLY_SPEED).stiffness
    other = coefficients(film, better.position, SUPPLY_SPEED, frequency=0.5 * SUPPLY_SPEED).stiffness
    flows = float(own.losses.side_flow) / float(better.losses.side_flow)
    torques = float(own.losses.friction_torque) / float(better.losses.friction_torque)
    place = float(np.hypot(*(own.position - better.position)) / np.hypot(*better.position))
    return place, abs(flows - 1.0), abs(torques - 1.0), float(np.abs(K - other).max() / np.abs(other).max())


# Limits of the models of a film's heat: a plain bearing with oils that thin and conduct more and less.
#
# All have the geometry, the viscosity of fresh oil and the load of one bearing, so that they differ in the
# thinning times rise E, the Peclet number Pe and the Nahme number Na alone. Reference: temperature over and
# across the film.


SUPPLY, HEAT_VISCOSITY, HEAT_SPEED = 45.0 + CELSIUS, 0.03, 100.0 * np.pi
LOAD = 5e3
"""It takes the cold journal to an eccentricity ratio of 0.48 [N]."""

HEAT_CELLS, LAYERS = (48, 4), 6

THINNING_RISES = (0.05, 0.2, 0.5, 1.0, 3.0, 10.0)
PECLETS = (2.0, 7.0, 20.0, 70.0, 200.0)
PROFILES = (2.0, 20.0, 200.0)
AT_PECLET, AT_RISE = 20.0, 1.0
COMPARED = (HeatModel.SUPPLY, HeatModel.HOUSING, HeatModel.BUSH)


def heat_rise() -> Iterator[Curve]:
    """Yield the errors of the models as oil thins more."""
    for model in COMPARED:
        yield model.label, THINNING_RISES, [_heat_error(model, rise, AT_PECLET) for rise in THINNING_RISES]


def heat_peclet() -> Iterator[Curve]:
    """Yield the errors of the models as oil conducts less."""
    for model in COMPARED:
        yield model.label, PECLETS, [_heat_error(model, AT_RISE, peclet) for peclet in PECLETS]


def heat_profile() -> Iterator[Curve]:
    """Yield the errors of a mean temperature across the film."""
    case = heat_case(1.0, AT_PECLET)
    # Na/E at this Peclet number, which the geometry and the load decide
    per_rise = _cold_numbers(case).nahme
    for peclet in PROFILES:
        rises: Sequence[float] = THINNING_RISES[1:] if peclet == AT_PECLET else (0.2, AT_RISE, 3.0)
        nahmes = [rise * per_rise * peclet / AT_PECLET for rise in rises]
        yield f"Pe = {peclet:g}", nahmes, [_heat_error(HeatModel.BUSH, rise, peclet) for rise in rises]


@cache
def heat_case(thinning_rise: float, peclet: float) -> HeatCase:
    """Return the bearing with these numbers E and Pe."""
    numbers = _cold_numbers(_heat_case(1.0, 1.0))
    return _heat_case(thinning_rise / numbers.thinning_rise, numbers.peclet / peclet)


def _cold_numbers(case: HeatCase) -> journals.HeatNumbers:
    """Return the numbers of a case where its film is as cold as its supply."""
    at = equilibrium(case.bearing.at_temperature(SUPPLY), case.load, case.speed)
    return journals.heat_numbers(case.bearing, at.position, case.speed)


def _heat_case(thinning: float, conductivity: float) -> HeatCase:
    bearing = journals.JournalBearing(
        radius=0.05,
        length=0.05,
        clearance=75e-6,
        oil=Oil.thinning_at(HEAT_VISCOSITY, SUPPLY, thinning, conductivity=conductivity),
        cooling=Cooling(supply_temperature=SUPPLY),
    )
    return HeatCase(name="plain bearing", bearing=bearing, force=LOAD, speed=HEAT_SPEED)


def _heat_error(model: HeatModel, thinning_rise: float, peclet: float) -> float:
    own, right = (_answered(one, thinning_rise, peclet) for one in (model, HeatModel.LAYERS))
    return position_error(own, right)


@cache
def _answered(model: HeatModel, thinning_rise: float, peclet: float) -> HeatAnswer:
    return answered(heat_case(thinning_rise, peclet), model, cells=HEAT_CELLS, layers=LAYERS)


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


def rotor_time_step() -> Iterator[Curve]:
    """Yield the errors of steps of each scheme."""
    matrix = _rotor_matrix(STEP_AT, STEP_MASS)
    shortest = 1.0 / float(np.abs(np.linalg.eigvals(matrix)).max())
    whole = TURNS * 2.0 * np.pi / SPEED
    counts = np.unique(np.geomspace(whole / (30.0 * shortest), whole / (0.02 * shortest), 40).astype(int))
    steps = whole / counts[::-1]
    for name, scheme in SCHEMES.items():
        errors = [_step_error(scheme(matrix * step), matrix * step, whole / step) for step in steps.tolist()]
        yield name, steps / shortest, errors


def rotor_macro_step() -> Iterator[Curve]:
    """Yield the longest macro steps of rotors of several masses; not-a-number where one whirls anyway."""
    model = journal(journals.MapFilm())
    for mass_ratio in MASS_RATIOS:
        steps = []
        for ratio in ECCENTRICITY_RATIOS:
            rotor = resting_rotor(model, ratio, speed=SPEED, mass_ratio=mass_ratio)
            found = critical_macro_step(rotor, model, state=rotor.initial_state).macro_step
            steps.append(np.nan if found is None else float(found) * SPEED)
        yield f"speed^2 c m / W = {mass_ratio:g}", ECCENTRICITY_RATIOS, np.degrees(steps)


def _rotor_matrix(ratio: float, mass_ratio: float) -> Array:
    """Return A of d/dt (x, y, vx, vy) = A (x, y, vx, vy) about an equilibrium [1/s]; lengths / clearance."""
    model = journal(journals.MapFilm())
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


# Limits of squeeze-film dampers: the journal whirls on a circle, about the center unless said
# otherwise.
#
# Errors are those of the force. References: the full film of finite length, by harmonics, for the
# length and for the linearization; the short film on the whole series of a porous layer for what the
# cage leaves out.


RATE = 100.0
"""Speed of the whirl [rad/s]; the force is proportional to it."""

RATIOS = (0.2, 0.6, 0.9)
SLENDERNESSES = (0.1, 0.5, 1.0)


def _orbiting(model: PorousDamper, ratios: Sequence[float] | Array) -> Array:
    """Return the forces (2, n) on circles of these radii / clearance."""
    ratios = np.asarray(ratios)
    return _whirling(model, ratios * model.clearance, RATE, np.zeros_like(ratios))


def _damper_errors(models: Sequence[PorousDamper], better: Sequence[PorousDamper]) -> Array:
    """Return the errors of the force, shape (RATIOS, models)."""
    pairs = zip(models, better, strict=True)
    return np.array([relative_error(*(_orbiting(one, RATIOS) for one in pair)) for pair in pairs]).T


def damper_length() -> Iterator[Curve]:
    """Yield the errors of the short film, on a solid and on a porous cage."""
    slenderness = np.geomspace(0.05, 1.5, 12)
    for cage, number in (("solid cage", 0.0), ("porous, Phi = 0.1", 0.1)):
        made = [compared_damper(ld, number) for ld in slenderness.tolist()]
        errors = _damper_errors(made, [replace(one, film=FiniteSqueeze()) for one in made])
        for ratio, values in zip(RATIOS, errors, strict=True):
            yield f"eccentricity ratio {ratio:g}, {cage}", slenderness, values


def damper_cage() -> Iterator[Curve]:
    """Yield the errors of a cage without depth, or without pores."""
    numbers = np.geomspace(1e-5, 10.0, 25)
    whole = [compared_damper(0.25, number) for number in numbers.tolist()]
    thin = [replace(one.cage, thin=True) for one in whole if one.cage is not None]
    for name, cages in (("solid cage", [None] * len(whole)), ("thin layer", thin)):
        simple = [replace(one, cage=cage) for one, cage in zip(whole, cages, strict=True)]
        for ratio, values in zip(RATIOS, _damper_errors(simple, whole), strict=True):
            yield f"{name}, eccentricity ratio {ratio:g}", numbers, values


def damper_linearization() -> Iterator[Curve]:
    """Yield the errors of damping at the center in large orbits."""
    ratios = np.linspace(0.02, 0.9, 30)
    for slenderness in SLENDERNESSES:
        full = replace(compared_damper(slenderness), film=FiniteSqueeze())
        yield f"full film, L/D {slenderness:g}", ratios, _linear_error(full, full, ratios)
    short = compared_damper(SLENDERNESSES[0])
    half = replace(short, extent=HalfSommerfeld())
    yield "of a full film, where half of it is empty", ratios, _linear_error(short, half, ratios)


def _linear_error(linear: PorousDamper, right: PorousDamper, ratios: Array) -> Array:
    """Return the error of the force of small motions about the center in a whirl of each radius."""
    damping = -linear.jacobian(np.zeros(2), np.zeros(2), 0.0)[:, 2:4]
    wrong = -damping @ np.array([np.zeros_like(ratios), RATE * ratios * linear.clearance])
    return relative_error(wrong, _orbiting(right, ratios))


# Limits of the point contact of a rolling ball, V = 0.1, Q0 = 5.
#
# Reference of the grid: the upwind scheme on 96 x 96 cells, extrapolated. Of the time step: the
# natural motion exp(s t) of a ball on the contact, by the linearized equations; the decay time that a
# scheme makes of it is a closed form.


CONTACT_CELLS = (64, 56, 48, 40, 32, 28, 24, 20, 16)
REFERENCE = (96, 48)
"""Cells along each side of the grids that the reference is extrapolated from."""

STEP_CELLS = 24
INERTIAS = (0.1, 1.0, 3.0)

STEPPERS: dict[str, Callable[[complex], complex]] = {
    "Euler": lambda z: 1.0 / (1.0 - z),
    "BDF2": lambda z: (2.0 + np.sqrt(1.0 + 2.0 * z)) / (3.0 - 2.0 * z),
}
"""Growth of exp(s t) over one implicit step, by z = s times the step."""


def contact_grid() -> Iterator[Curve]:
    """Yield the errors of coarse grids, upwind and staggered."""
    fine, coarse = (_films(published_contact(cells, UpwindScheme())) for cells in REFERENCE)
    right = fine + (fine - coarse) / ((REFERENCE[0] / REFERENCE[1]) ** UpwindScheme.order - 1.0)
    schemes: dict[str, ContactScheme] = {"upwind": UpwindScheme(), "as published": StaggeredScheme()}
    for name, scheme in schemes.items():
        models = [published_contact(cells, scheme) for cells in CONTACT_CELLS]
        sizes = [model.grid.spacing[0] for model in models]
        errors = np.array([np.abs(_films(model) / right - 1.0) for model in models])
        for quantity, values in zip(("film in the middle", "smallest film"), errors.T, strict=True):
            yield f"{quantity}, {name}", sizes, values


def _films(model: PointContact) -> Array:
    state = model.stationary()
    return np.array([state.central_film, state.minimum_film])


def contact_step() -> Iterator[Curve]:
    """Yield what implicit steps make of the decay of small oscillations."""
    steps = np.geomspace(1e-3, 1.0, 25)
    model = published_contact(STEP_CELLS, UpwindScheme())
    for W, s in zip(INERTIAS, natural_motions(model, model.stationary(), INERTIAS), strict=True):
        for name, growth in STEPPERS.items():
            shown = np.array([-step / np.log(abs(growth(s * step))) for step in steps.tolist()])
            yield f"{name}, W = {W:g}", steps, np.abs(shown * -s.real - 1.0)


# Limits of the polymer bush that melts, under a load that grows by half.
#
# References: the mixed problem of the shaft for the closed form of its heat; for the contact angle the two
# moments of the wear, `bush_accuracy.two_moments`, which are exact whatever the shape of the pressure.


STEPS = (20, 200, 2000)
NODES = (129, 65, 33, 17, 9)
EXTENT = 1.5
"""Angle that the worn profile covers [rad]."""


def bush_flux() -> Iterator[Curve]:
    """Yield the errors of the closed form."""
    for stubbiness in bush_accuracy.STUBBINESSES:
        *_, errors = bush_accuracy.shaft_flux_errors(stubbinesses=(stubbiness,)).values()
        yield f"shaft radius / half length {stubbiness:g}", bush_accuracy.COOLINGS, np.abs(errors)


def bush_published() -> Iterator[Curve]:
    """Yield the errors of the published stage under a growing load."""
    times, exact = _exact()
    grown = 1.0 + (bush_accuracy.LOADS[1] / bush_accuracy.LOADS[0] - 1.0) * times / bush_accuracy.DURATION
    for steps in STEPS:
        error = np.abs(bush_accuracy.published_run(f4k20_bush(), times, steps) / exact - 1.0)
        yield f"{steps} steps", grown[1:], error[1:]


def bush_nodes() -> Iterator[Curve]:
    """Yield the errors of few nodes."""
    times, exact = _exact()
    errors = []
    for nodes in NODES:
        worn = BushReaction(bush=f4k20_bush(), melting_heat=bush_accuracy.HEAT, extent=EXTENT, nodes=nodes)
        errors.append(np.abs(bush_accuracy.worn_run(times, worn) / exact - 1.0))
    between = np.degrees(EXTENT) / (np.array(NODES) - 1.0)
    yield "largest", between, [error.max() for error in errors]
    yield "at the end", between, [error[-1] for error in errors]


def _exact() -> tuple[Array, Array]:
    times = np.linspace(0.0, bush_accuracy.DURATION, bush_accuracy.SAMPLES)
    return times, bush_accuracy.two_moments(f4k20_bush(), times, **bush_accuracy.TIGHT)


def panels() -> Iterator[Panel]:
    """Yield the panels that `limits.toml` lists; an infinite level is none."""
    table = tomllib.loads(resources.files(__package__ or "").joinpath("limits.toml").read_text("utf-8"))
    for name, row in table.items():
        title = row.pop("title").format_map(globals())  # which names the constants of this module
        own = Panel(**row, title=title, curves=globals()[name])
        yield replace(own, level=None) if own.level == math.inf else own


PANELS = tuple(panels())
"""All panels, in the order of the physics and of the pictures."""

PHYSICS = tuple(dict.fromkeys(each.physics for each in PANELS))
"""What the panels are about."""
