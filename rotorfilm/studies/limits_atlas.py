"""The atlas of limits of all physics, with the panels of heat, dampers, contacts and bushes."""

from __future__ import annotations

import warnings
from collections.abc import Callable, Iterator, Sequence
from dataclasses import replace
from functools import cache

import numpy as np

from ..analysis import equilibrium
from ..bearings.bush import BushReaction, f4k20_bush
from ..bearings.contact import ContactScheme, PointContact, StaggeredScheme, UpwindScheme
from ..bearings.damper import FiniteSqueeze, PorousDamper
from ..bearings.films.geometry import HalfSommerfeld
from ..bearings.journal import JournalBearing, heat_numbers
from ..bearings.oil import Cooling, Oil
from ..core.errors import InputError, ValidityWarning
from ..core.model import Array
from ..core.progress import Report, silent
from ..core.units import CELSIUS
from .bush_tiers import (
    COOLINGS,
    DURATION,
    HEAT,
    LOADS,
    SAMPLES,
    STUBBINESSES,
    TIGHT,
    published_run,
    shaft_flux_errors,
    two_moments,
    worn_run,
)
from .contact_cases import published_contact
from .contact_precision import natural_motions
from .damper_accuracy import compared_damper
from .heat_accuracy import HeatAnswer, HeatCase, HeatModel, answered, position_error
from .limits_journal import (
    JOURNAL_PANELS,
    ROTOR_PANELS,
    SUPPLY_PANELS,
    Curve,
    Limit,
    LimitAtlas,
    Panel,
    panel,
)
from .study import relative_error

# Limits of the polymer bush that melts, under a load that grows by half.
#
# References: the mixed problem of the shaft for the closed form of its heat; for the contact angle the two
# moments of the wear, `bush_tiers.two_moments`, which are exact whatever the shape of the pressure.


STEPS = (20, 200, 2000)
NODES = (129, 65, 33, 17, 9)
EXTENT = 1.5
"""Angle that the worn profile covers [rad]."""


@panel("bush", "closed form of the heat into the shaft", "Biot number of the shaft", "error of the flux")
def bush_flux() -> Iterator[Curve]:
    """Yield what the closed form errs by."""
    for stubbiness in STUBBINESSES:
        errors = [abs(row.error) for row in shaft_flux_errors(stubbinesses=(stubbiness,))]
        yield f"shaft radius / half length {stubbiness:g}", COOLINGS, errors


@panel("bush", "melting in stages, as published", "load / first load", "error of the contact angle")
def bush_published() -> Iterator[Curve]:
    """Yield what the published stage errs by under a growing load."""
    times, exact = _exact()
    grown = 1.0 + (LOADS[1] / LOADS[0] - 1.0) * times / DURATION
    for steps in STEPS:
        error = np.abs(published_run(f4k20_bush(), times, steps) / exact - 1.0)
        yield f"{steps} steps", grown[1:], error[1:]


@panel(
    "bush",
    "nodes of the worn profile",
    "angle between nodes [deg]",
    "error of the contact angle",
    logarithmic=True,
)
def bush_nodes() -> Iterator[Curve]:
    """Yield what few nodes err by."""
    times, exact = _exact()
    errors = []
    for nodes in NODES:
        worn = BushReaction(bush=f4k20_bush(), melting_heat=HEAT, extent=EXTENT, nodes=nodes)
        errors.append(np.abs(worn_run(times, worn) / exact - 1.0))
    between = np.degrees(EXTENT) / (np.array(NODES) - 1.0)
    yield "largest", between, [error.max() for error in errors]
    yield "at the end", between, [error[-1] for error in errors]


def _exact() -> tuple[Array, Array]:
    times = np.linspace(0.0, DURATION, SAMPLES)
    return times, two_moments(f4k20_bush(), times, **TIGHT)


BUSH_PANELS = (bush_flux, bush_published, bush_nodes)
"""Panels of the polymer bush, in the order in which they are drawn."""


# Limits of the point contact of a rolling ball, V = 0.1, Q0 = 5.
#
# Reference of the grid: the upwind scheme on 96 x 96 cells, extrapolated. Of the time step: the
# natural motion exp(s t) of a ball on the contact, by the linearized equations; the decay time that a
# scheme makes of it is a closed form. What load steps the published scheme survives has a chart of
# its own, `contact_limits`.


CELLS = (64, 56, 48, 40, 32, 28, 24, 20, 16)
REFERENCE = (96, 48)
"""Cells along each side of the grids that the reference is extrapolated from."""

STEP_CELLS = 24
INERTIAS = (0.1, 1.0, 3.0)

STEPPERS: dict[str, Callable[[complex], complex]] = {
    "Euler": lambda z: 1.0 / (1.0 - z),
    "BDF2": lambda z: (2.0 + np.sqrt(1.0 + 2.0 * z)) / (3.0 - 2.0 * z),
}
"""Growth of exp(s t) over one implicit step, by z = s times the step."""


@panel(
    "contact",
    "grid of a rolling ball",
    "size of a cell / Hertzian radius",
    "error of the film",
    logarithmic=True,
)
def contact_grid() -> Iterator[Curve]:
    """Yield what coarse grids err by, upwind and staggered."""
    fine, coarse = (_films(published_contact(cells, UpwindScheme())) for cells in REFERENCE)
    right = fine + (fine - coarse) / ((REFERENCE[0] / REFERENCE[1]) ** UpwindScheme.order - 1.0)
    schemes: dict[str, ContactScheme] = {"upwind": UpwindScheme(), "as published": StaggeredScheme()}
    for name, scheme in schemes.items():
        models = [published_contact(cells, scheme) for cells in CELLS]
        sizes = [model.grid.spacing[0] for model in models]
        errors = np.array([np.abs(_films(model) / right - 1.0) for model in models])
        for quantity, values in zip(("film in the middle", "smallest film"), errors.T, strict=True):
            yield f"{quantity}, {name}", sizes, values


def _films(model: PointContact) -> Array:
    state = model.stationary()
    return np.array([state.central_film, state.minimum_film])


@panel(
    "contact",
    "time step of a rolling ball",
    "step / time scale of the contact",
    "error of the decay time",
    logarithmic=True,
)
def contact_step() -> Iterator[Curve]:
    """Yield what implicit steps make of the decay of small oscillations."""
    steps = np.geomspace(1e-3, 1.0, 25)
    model = published_contact(STEP_CELLS, UpwindScheme())
    for W, s in zip(INERTIAS, natural_motions(model, model.stationary(), INERTIAS), strict=True):
        for name, growth in STEPPERS.items():
            shown = np.array([-step / np.log(abs(growth(s * step))) for step in steps.tolist()])
            yield f"{name}, W = {W:g}", steps, np.abs(shown * -s.real - 1.0)


CONTACT_PANELS = (contact_grid, contact_step)
"""Panels of the rolling contact, in the order in which they are drawn."""


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


def _whirling(model: PorousDamper, ratios: Array) -> Array:
    """Return the forces (2, n) on circles of these radii."""
    still = np.zeros_like(ratios)
    position = np.array([ratios * model.clearance, still])
    return model.force(position, np.array([still, RATE * position[0]]), still)


def _errors(models: Sequence[PorousDamper], better: Sequence[PorousDamper]) -> Array:
    """Return the errors of the force, shape (models, RATIOS)."""
    ratios, pairs = np.array(RATIOS), zip(models, better, strict=True)
    return np.array(
        [relative_error(_whirling(one, ratios), _whirling(right, ratios)) for one, right in pairs]
    )


@panel(
    "damper",
    "short film of finite length",
    "length / diameter",
    "error of the force, full film",
    logarithmic=True,
)
def damper_length() -> Iterator[Curve]:
    """Yield what the short film errs by, on a solid and on a porous cage."""
    slenderness = np.geomspace(0.05, 1.5, 12)
    for cage, number in (("solid cage", 0.0), ("porous, Phi = 0.1", 0.1)):
        made = [compared_damper(ld, number) for ld in slenderness.tolist()]
        errors = _errors(made, [replace(one, film=FiniteSqueeze()) for one in made])
        for ratio, values in zip(RATIOS, errors.T, strict=True):
            yield f"eccentricity ratio {ratio:g}, {cage}", slenderness, values


@panel(
    "damper",
    "porous cage taken as solid, or as thin",
    "permeability number Phi",
    "error of the force, short film",
    logarithmic=True,
)
def damper_cage() -> Iterator[Curve]:
    """Yield what a cage without depth, or without pores, errs by."""
    numbers = np.geomspace(1e-5, 10.0, 25)
    whole = [compared_damper(0.25, number) for number in numbers.tolist()]
    thin = [replace(one.cage, thin=True) for one in whole if one.cage is not None]
    for name, cages in (("solid cage", [None] * len(whole)), ("thin layer", thin)):
        simple = [replace(one, cage=cage) for one, cage in zip(whole, cages, strict=True)]
        for ratio, values in zip(RATIOS, _errors(simple, whole).T, strict=True):
            yield f"{name}, eccentricity ratio {ratio:g}", numbers, values


@panel("damper", "linearization about the center", "radius of the orbit / clearance", "error of the force")
def damper_linearization() -> Iterator[Curve]:
    """Yield what damping at the center errs by in large orbits."""
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
    still = np.zeros_like(ratios)
    wrong = -damping @ np.array([still, RATE * ratios * linear.clearance])
    return relative_error(wrong, _whirling(right, ratios))


DAMPER_PANELS = (damper_length, damper_cage, damper_linearization)
"""Panels of the squeeze-film damper, in the order in which they are drawn."""


# Limits of the models of a film's heat: a plain bearing with oils that thin and conduct more and less.
#
# All have the geometry, the viscosity of fresh oil and the load of one bearing, so that they differ in the
# thinning times rise E, the Peclet number Pe and the Nahme number Na alone. Reference: temperature over and
# across the film.


SUPPLY, VISCOSITY, SPEED = 45.0 + CELSIUS, 0.03, 100.0 * np.pi
LOAD = 5e3
"""It takes the cold journal to an eccentricity ratio of .48 [N]."""

HEAT_CELLS, LAYERS = (48, 4), 6

THINNING_RISES = (0.05, 0.2, 0.5, 1.0, 3.0, 10.0)
PECLETS = (2.0, 7.0, 20.0, 70.0, 200.0)
PROFILES = (2.0, 20.0, 200.0)
AT_PECLET, AT_RISE = 20.0, 1.0
COMPARED = (HeatModel.SUPPLY, HeatModel.HOUSING, HeatModel.BUSH)


@panel("heat", f"models, Pe = {AT_PECLET:g}", "thinning x rise E", "error of the position", logarithmic=True)
def heat_rise() -> Iterator[Curve]:
    """Yield what the models err by as oil thins more."""
    for model in COMPARED:
        yield model.said, THINNING_RISES, [_error(model, rise, AT_PECLET) for rise in THINNING_RISES]


@panel("heat", f"models, E = {AT_RISE:g}", "Peclet number Pe", "error of the position", logarithmic=True)
def heat_peclet() -> Iterator[Curve]:
    """Yield what the models err by as oil conducts less."""
    for model in COMPARED:
        yield model.said, PECLETS, [_error(model, AT_RISE, peclet) for peclet in PECLETS]


@panel(
    "heat", "no profile across the film (T2)", "Nahme number Na", "error of the position", logarithmic=True
)
def heat_profile() -> Iterator[Curve]:
    """Yield what a mean temperature across the film errs by."""
    for peclet in PROFILES:
        rises: Sequence[float] = THINNING_RISES[1:] if peclet == AT_PECLET else (0.2, AT_RISE, 3.0)
        nahmes = [rise * nahme_per_rise() * peclet / AT_PECLET for rise in rises]
        yield f"Pe = {peclet:g}", nahmes, [_error(HeatModel.BUSH, rise, peclet) for rise in rises]


def nahme_per_rise() -> float:
    """Return Na/E at the Peclet number `AT_PECLET`, which the geometry and the load decide."""
    case = heat_case(1.0, AT_PECLET)
    at = equilibrium(case.bearing.at_temperature(SUPPLY), case.load, case.speed)
    return heat_numbers(case.bearing, at.position, case.speed).nahme


@cache
def heat_case(thinning_rise: float, peclet: float) -> HeatCase:
    """Return the bearing with these numbers E and Pe."""
    unit = _case(1.0, 1.0)
    at = equilibrium(unit.bearing.at_temperature(SUPPLY), unit.load, unit.speed)
    numbers = heat_numbers(unit.bearing, at.position, unit.speed)
    return _case(thinning_rise / numbers.thinning_rise, numbers.peclet / peclet)


def _case(thinning: float, conductivity: float) -> HeatCase:
    bearing = JournalBearing(
        radius=0.05,
        length=0.05,
        clearance=75e-6,
        oil=Oil.thinning_at(VISCOSITY, SUPPLY, thinning, conductivity=conductivity),
        cooling=Cooling(supply_temperature=SUPPLY),
    )
    return HeatCase(name="plain bearing", bearing=bearing, force=LOAD, speed=SPEED)


def _error(model: HeatModel, thinning_rise: float, peclet: float) -> float:
    reference = _answered(HeatModel.LAYERS, thinning_rise, peclet)
    return position_error(_answered(model, thinning_rise, peclet), reference)


@cache
def _answered(model: HeatModel, thinning_rise: float, peclet: float) -> HeatAnswer:
    return answered(heat_case(thinning_rise, peclet), model, cells=HEAT_CELLS, layers=LAYERS)


HEAT_PANELS = (heat_rise, heat_peclet, heat_profile)
"""Panels of a film's heat, in the order in which they are drawn."""


# All panels, computed in turn.


PANELS: tuple[Panel, ...] = (
    *JOURNAL_PANELS,
    *SUPPLY_PANELS,
    *HEAT_PANELS,
    *ROTOR_PANELS,
    *DAMPER_PANELS,
    *CONTACT_PANELS,
    *BUSH_PANELS,
)
"""All panels, in the order in which they are drawn."""

PHYSICS = tuple(dict.fromkeys(each.physics for each in PANELS))
"""What the panels are about."""


def limits_atlas(physics: Sequence[str] | None = None, *, report: Report = silent) -> LimitAtlas:
    """Return the atlas of limits; all of it takes some 20 s of CPU.

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
    found: list[Limit] = []
    for number, each in enumerate(chosen):
        report(number / len(chosen), f"{each.physics}: {each.title}")
        with warnings.catch_warnings(action="ignore", category=ValidityWarning):
            # That a model is used beyond its range is what the atlas shows.
            found += each.limits()
    return LimitAtlas(limits=tuple(found))
