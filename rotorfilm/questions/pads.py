"""What bearings of fixed pads bring to scenes and questions."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from functools import partial
from typing import TYPE_CHECKING, Any

import numpy as np

from ..analysis import coefficients, equilibrium
from ..analysis.harmonic_balance import basis, first_wave
from ..analysis.stateful_orbit import StatefulTurn, TurnEquations, resampled
from ..bearings.pads import TiltingPadBearing
from ..core.answers import (
    DISAGREEMENT,
    ISOTHERMAL,
    CandidateRung,
    ErrorEstimate,
    Found,
    Ladder,
    Rung,
    Work,
    WorkUnit,
)
from ..core.errors import FilmContactError, InputError
from ..core.model import Array, settled
from ..core.results import Equilibrium
from ..scenes.export_scene import film_models
from ..scenes.families import Family, SceneModels
from ..scenes.film_heat import HeatError, WarmRest, assumed_figures, uniform_rest
from ..scenes.film_rungs import FilmCandidate, corrected
from ..scenes.pad_candidates import (
    DamCandidate,
    LobedCandidate,
    TiltingCandidate,
    dam_candidates,
    few_forces,
    lobed_candidates,
    many_forces,
    tilting_candidates,
)
from ..scenes.pad_tables import DamTable, LobedTable, TiltingTable, quick_pads
from .coupling import coupling_ladder
from .journal_heat import BALANCE, BALANCED, FRESH, HeatedQuestion, UniformRung
from .journal_orbits import (
    FORCE,
    ORBIT_UNITS,
    ORBIT_UNITS as ORBITS,
    SAMPLES,
    SampledOrbitRung,
    cold_blade_ladder,
    cold_orbit_ladder,
    rotor_of,
    wave_change,
    wave_value,
)
from .journal_statics import (
    HEAT,
    MATRIX,
    STATIC_UNITS,
    STATIC_UNITS as STATICS,
    TEMPERATURES,
    StaticRung,
    attitude,
    cold_static_ladder,
    film_prior,
    heat_value,
    relative_distance,
    rest_value,
)
from .journal_whirl import STEP, WarmWhirlRung, cold_whirl_ladder, required_rotor, threshold_around
from .walk import NoAnswerError

if TYPE_CHECKING:
    from ..scenes.scene import Scene

# Ladders of bearings of fixed pads: those of journals, by films of pads.


Films = Callable[["Scene"], Sequence[FilmCandidate]]
"""Takes a scene and returns the candidates for its bearing."""

PAD_STATICS = [quantity for quantity in STATICS if quantity != "maximum_temperature"]
"""Static quantities of pads, whose films have one temperature."""


def fixed_ladders(points: Films, turns: Films) -> dict[str, Callable[[Scene, str], Ladder]]:
    """Return the ladders by quantity, of candidates for some equilibria and for states all round a turn."""

    def static(scene: Scene, quantity: str) -> Ladder:
        if not is_warm(scene):
            refuse_temperature(scene, quantity)
            return cold_static_ladder(scene, quantity, points(scene))
        make = partial(_static_rung, quantity, scene.static_load, scene.speed)
        return warm_static_ladder(scene, quantity, points(scene), make)

    def whirl(scene: Scene, quantity: str) -> Ladder:
        if is_warm(scene):
            return warm_whirl_ladder(scene, required_rotor(scene, quantity).mass, points(scene))
        return cold_whirl_ladder(scene, points(scene))

    def orbit(scene: Scene, quantity: str) -> Ladder:
        settled = settled_scene(scene)
        return cold_orbit_ladder(settled, quantity, turns(settled))

    def blade(scene: Scene, quantity: str) -> Ladder:
        settled = settled_scene(scene)
        return cold_blade_ladder(settled, turns(settled))

    return {
        **dict.fromkeys(PAD_STATICS, static),
        **dict.fromkeys(ORBITS, orbit),
        "whirl_threshold": whirl,
        "blade_loss_peak": blade,
        "cosimulation_error": coupling_ladder,
    }


def refuse_temperature(scene: Scene, quantity: str) -> None:
    """Raise InputError if a temperature is asked of films of a stated viscosity."""
    if quantity in TEMPERATURES:
        raise InputError(
            f"lubricant must give the oil of the pads for {quantity}, as a grade, got a viscosity of "
            f"{scene.film_table.viscosity!r} Pa s"
        )


def _static_rung(quantity: str, load: tuple[float, float], speed: float, film: FilmCandidate) -> StaticRung:
    return StaticRung(film=film, quantity=quantity, load=load, speed=speed)


# What bearings of fixed pads bring to scenes and questions.


def _all(scene: Scene) -> tuple[LobedCandidate, ...]:
    return lobed_candidates(scene.table("lobed_journal").build(), fixed=scene.film_is_given)


LOBED = Family(
    table=LobedTable,
    ladders=fixed_ladders(
        lambda scene: few_forces(_all(scene), fixed=scene.film_is_given),
        lambda scene: many_forces(_all(scene), fixed=scene.film_is_given),
    ),
    models=film_models,
    example={
        "lobed_journal": {
            "diameter": "100 mm",
            "length": "50 mm",
            "viscosity": "20 mPa s",
            "preset": "elliptical",
            "assembled_clearance": "70 um",
            "preload": 0.5,
        },
        "operation": {"speed": "3000 rpm"},
        "rigid_rotor": {"mass": "200 kg"},
    },
)


# What pressure dams bring to scenes and questions.


def _dam_films(scene: Scene, *, turns: bool = False) -> tuple[DamCandidate, ...]:
    return dam_candidates(scene.table("pressure_dam").build(), fixed=scene.film_is_given, turns=turns)


PRESSURE_DAM = Family(
    table=DamTable,
    ladders=fixed_ladders(_dam_films, partial(_dam_films, turns=True)),
    models=film_models,
    example={
        "pressure_dam": {
            "diameter": "100 mm",
            "length": "50 mm",
            "viscosity": "20 mPa s",
            "pad_clearance": "80 um",
            "depth": "140 um",
            "end": "145 deg",
            "share": 0.75,
        },
        "operation": {"speed": "3000 rpm"},
        "rigid_rotor": {"mass": "200 kg"},
    },
)


# Questions about tilting pads: where a journal rests on them, K and C at the shaft's frequency, whirl.


CALLS, SPEEDS = 8, 40
"""Forces with derivatives that an equilibrium takes about, and equilibria of a search for a threshold."""


@dataclass(frozen=True, kw_only=True)
class TiltingRung(CandidateRung[TiltingCandidate]):
    """An answer on tilting pads by one film.

    Attributes
    ----------
    quantity : str
    load : (float, float) [N]
    """

    quantity: str
    load: tuple[float, float]

    @property
    def unit(self) -> WorkUnit:
        """One answer."""
        return WorkUnit(f"answers of {self.name}", ("answers", self.film), nominal=self.film.time(CALLS))

    @property
    def estimates(self) -> WorkUnit:
        """One estimate."""
        return WorkUnit(f"estimates by {self.film.rich_name}", ("estimates", self.film))

    def corrected_rest(self, at: Equilibrium) -> tuple[Array, str]:
        """Return where the richer film has its equilibrium (2,) [m], and why not to trust that."""
        moved = corrected(self.film.resting, at, np.array(self.load), smooth=False)
        return moved.position, moved.doubt


@dataclass(frozen=True, kw_only=True)
class TiltingRestRung(TiltingRung):
    """A static quantity, or K and C at the frequency of the shaft.

    Attributes
    ----------
    speed : float [rad/s]
    """

    speed: float

    @property
    def prior(self) -> float:
        """Order of magnitude of the film's error."""
        return film_prior(self.film, self.quantity)

    def answer(self, before: Found | None) -> Found:
        """Return the quantity at the equilibrium of this film."""
        at = equilibrium(self.film.reaction, self.load, self.speed)
        return Found(self._value(self.film, at.position), {self.unit: 1}, at)

    def _value(self, film: TiltingCandidate, position: Array, *, rich: bool = False) -> Array | float:
        bearing = film.rich if rich else film.reaction
        if self.quantity in MATRIX:
            own = film.coefficients if rich else partial(coefficients, bearing)
            return np.asarray(getattr(own(position, self.speed), self.quantity))
        if self.quantity in HEAT:
            return heat_value(bearing, self.quantity, position, self.speed)
        if self.quantity == "eccentricity_ratio":
            return float(np.hypot(*position)) / bearing.clearance
        if self.quantity == "minimum_film":
            return float(bearing.at_rest().pad_states(position, self.speed).film_thickness.min())
        return attitude(position, self.load, self.speed)

    def estimate(self, found: Found, before: Found | None, tolerance: float) -> ErrorEstimate:
        """Return the change that the richer film makes, at its own equilibrium as far as its defect tells."""
        position, doubt = self.corrected_rest(found.solution)
        better = self._value(self.film, position, rich=True)
        error = relative_distance(self.quantity, found.value, better, self.film.supply_temperature)
        method = f"defect of {self.film.rich_name}"
        return ErrorEstimate(error, method, {self.estimates: 1}, doubt=doubt)


@dataclass(frozen=True, kw_only=True)
class TiltingWhirlRung(TiltingRung):
    """The speed at which a rigid rotor begins to whirl, judged with the pads.

    Attributes
    ----------
    mass : float [kg]
    """

    mass: float

    def answer(self, before: Found | None) -> Found:
        """Return the speed [rad/s]; raises NoAnswerError where rotor and pads are stable at all speeds."""
        threshold = threshold_around(self.film.reaction, self, before, NoAnswerError)
        return Found(threshold.speed, {self.unit: SPEEDS}, threshold.equilibrium)

    def estimate(self, found: Found, before: Found | None, tolerance: float) -> ErrorEstimate:
        """Return the change of speed that undoes the growth by the richer film at its own equilibrium."""
        at: Equilibrium = found.solution
        film = self.film if at.temperature is None else self.film.at_temperature(at.temperature)
        position, doubt = replace(self, film=film).corrected_rest(at)
        growth = float(film.rich.at_rest().modes(position, at.speed, self.mass)[0].real)
        low, high = (self._growth(at.speed * (1.0 + sign * STEP)) for sign in (-1.0, 1.0))
        slope = (high - low) / (2.0 * STEP * at.speed)
        error = abs(growth / slope) / at.speed if slope else math.inf
        method = f"growth by {self.film.rich_name}"
        return ErrorEstimate(error, method, {self.estimates: 1}, doubt=doubt)

    def _growth(self, speed: float) -> float:
        at = equilibrium(self.film.reaction, self.load, speed)
        film = settled(self.film.reaction, at.position, speed)
        return float(film.at_rest().modes(at.position, speed, self.mass)[0].real)


def tilting_rest_ladder(scene: Scene, quantity: str) -> Ladder:
    """Return the ladder of a static quantity, or of K or C, of tilting pads."""

    def make(film: TiltingCandidate) -> TiltingRestRung:
        return TiltingRestRung(film=film, quantity=quantity, load=scene.static_load, speed=scene.speed)

    films = _films(scene)
    if is_warm(scene):
        ladder = warm_static_ladder(scene, quantity, films, make)
    else:
        refuse_temperature(scene, quantity)
        rungs = tuple(make(film) for film in films)
        ladder = Ladder(
            rungs=rungs,
            unit=STATIC_UNITS[quantity],
            remarks=scene.film_remarks,
            within=ISOTHERMAL,
            distance=lambda value, better: relative_distance(quantity, value, better, 0.0),
        )
    if quantity not in MATRIX:
        return ladder
    return replace(ladder, within=f"{ladder.within}, whirl of {abs(scene.speed):.6g} rad/s, once a turn")


def tilting_whirl_ladder(scene: Scene, quantity: str) -> Ladder:
    """Return the ladder of the whirl threshold of a rigid rotor on tilting pads.

    Raises
    ------
    InputError
        If the scene has no rigid rotor.
    """
    mass = required_rotor(scene, quantity).mass
    rungs = tuple(
        TiltingWhirlRung(film=film, quantity=quantity, load=scene.static_load, mass=mass)
        for film in _films(scene)
    )
    within = ONE_TEMPERATURE if is_warm(scene) else ISOTHERMAL
    return Ladder(rungs=rungs, unit="rad/s", remarks=scene.film_remarks, within=within)


def _films(scene: Scene) -> tuple[TiltingCandidate, ...]:
    return tilting_candidates(scene.table("tilting_pad").build(), fixed=scene.film_is_given)


# Questions about the orbit that an unbalance makes on tilting pads: linear and nonlinear, pads in time.


LINEAR = 15
"""Samples over a turn of a linear orbit."""

NEWTON = 6
"""Newton steps that an orbit takes about."""


@dataclass(frozen=True, kw_only=True)
class TiltingOrbitRung(SampledOrbitRung[TiltingCandidate]):
    """The orbit on tilting pads of one film, by its equations over a turn."""

    @property
    def points(self) -> WorkUnit:
        """The pads at one state and time, with derivatives."""
        nominal = self.film.time(1)
        return WorkUnit(f"states of {self.film.name}", ("states", self.film), nominal=nominal)

    def answer(self, before: Found | None) -> Found:
        """Return the quantity of the orbit, from that of a lower rung if there is one."""
        bearing = self.film.reaction
        if not self.samples:
            turn, count = self._equations(bearing, LINEAR).linear(self._rest(bearing)), LINEAR
        else:
            start = self._rest(bearing)[:, None] if before is None else before.solution.places
            turn, count = self._equations(bearing, self.samples).orbit(start), NEWTON * self.samples
        return Found(self._value(turn), {self.points: count}, turn)

    def estimate(self, found: Found, before: Found | None, tolerance: float) -> ErrorEstimate:
        """Return the change by two steps with the richer film, at twice the samples, by this one's slopes."""
        places = found.solution.places
        samples = 2 * places.shape[1] + 1
        places = resampled(places, samples)
        own, rich = (self._equations(one, samples) for one in (self.film.reaction, self.film.rich))
        try:
            matrix = own.matrix(own.residual(places, slopes=True)[1])
            first = rich.step(matrix, rich.residual(places)[0])
            second = rich.step(matrix, rich.residual(places + first)[0])
        except FilmContactError:
            return ErrorEstimate(math.inf, "defect", doubt="the orbit leaves the clearance: not linear")
        better = rich.turn(places + first + second)
        error = wave_change(self.quantity, found.value, self._value(better))
        left = float(np.linalg.norm(second[:2])) / max(float(np.linalg.norm(first[:2])), 1e-300)
        doubt = f"a second step is {left:.0%} of the first: not linear" if left > DISAGREEMENT else ""
        method = f"defect of {self.film.rich_name}, {samples} samples"
        return ErrorEstimate(error, method, {self.points: samples}, doubt=doubt)

    def expected(self, done: Work) -> Work:
        """Return some Newton steps at these samples."""
        return {self.points: NEWTON * self.samples if self.samples else LINEAR}

    def _equations(self, bearing: TiltingPadBearing, samples: int) -> TurnEquations:
        return TurnEquations(self.rotor, bearing.evaluated, bearing.clearance, samples)

    def _rest(self, bearing: TiltingPadBearing) -> Array:
        speed = self.rotor.profile.speeds[0]
        position = equilibrium(bearing, self.rotor.static_force, speed).position
        return np.concatenate([position, bearing.at_rest().state(position, speed)])

    def _value(self, turn: StatefulTurn) -> float:
        rows = turn.force if self.quantity == FORCE else turn.places[:2]
        samples = rows.shape[1]
        wave = first_wave(rows @ basis(samples // 2, samples).back.T)
        # Over the angle of the rotor, not time: the unbalance turns with the phase at negative speed too.
        speed = abs(self.rotor.profile.speeds[0])
        return wave_value(self.quantity, wave, speed, self.rotor.unbalance_angle)


def tilting_orbit_ladder(scene: Scene, quantity: str) -> Ladder:
    """Return the ladder of an orbit on tilting pads: linear, then nonlinear, on each film.

    On an oil the films keep the temperature of the rest.

    Raises
    ------
    InputError
        As `rotor_of`.
    """
    settled = settled_scene(scene)
    films = tilting_candidates(settled.table("tilting_pad").build(), fixed=settled.film_is_given)
    rotor = rotor_of(settled)
    rungs = [
        TiltingOrbitRung(film=film, quantity=quantity, rotor=rotor, samples=n)
        for film in films
        for n in (0, *SAMPLES)
    ]
    return Ladder(
        rungs=tuple(rungs),
        unit=ORBIT_UNITS[quantity],
        remarks=scene.film_remarks,
        within=ISOTHERMAL,
        distance=lambda value, better: wave_change(quantity, value, better),
    )


# What tilting pads bring to scenes and questions.


def tilting_models(scene: Scene) -> SceneModels:
    """Return the tilting pads of a scene and its rotor, all at rest, the films as warm as there."""
    scene = settled_scene(scene)
    models = film_models(scene)
    bearing = scene.table("tilting_pad").build()
    rest = np.array([models.start["x"], models.start["y"]])
    pads = bearing.at_rest().pad_states(rest, scene.speed)
    places = pads.tilts if bearing.pivot_stiffness is None else [*pads.tilts, *pads.pivot_deflections]
    return models._replace(bearing=replace(bearing, start=tuple(float(place) for place in places)))


TILTING = Family(
    table=TiltingTable,
    ladders={
        **dict.fromkeys(PAD_STATICS, tilting_rest_ladder),
        **dict.fromkeys(ORBITS, tilting_orbit_ladder),
        "whirl_threshold": tilting_whirl_ladder,
    },
    models=tilting_models,
    example={
        "tilting_pad": {
            "diameter": "100 mm",
            "length": "50 mm",
            "viscosity": "20 mPa s",
            "assembled_clearance": "70 um",
            "preload": 0.3,
            "pad_count": 5,
            "loading": "between_pads",
            "extent": "60 deg",
        },
        "operation": {"speed": "3000 rpm"},
        "rigid_rotor": {"mass": "200 kg"},
    },
)


# Questions about pads on an oil: the film of fresh oil (T0), or one temperature in balance (T1).
#
# There is no temperature field over the films of pads: answers say that all have one.


ONE_TEMPERATURE = "laminar films, all at one temperature in the balance of their heat"
"""`within` of what rests on films of an oil whose temperature is found."""


class PadHeatRung(UniformRung):
    """An answer on films of one temperature, beside which there is no richer heat."""

    def heat(self, own: WarmRest, tolerance: float) -> tuple[HeatError, str, str]:
        """Return what the balance would change."""
        return HeatError(self.question.apart(own, self.balanced(own)), False), BALANCE, ""


class PadWhirlRung(WarmWhirlRung):
    """The whirl threshold on films of one temperature, beside which there is no richer heat."""

    def heat(self, at: Equilibrium, tolerance: float) -> tuple[HeatError, str, str]:
        """Return what the balance would change."""
        growth, own, balanced = self.rests(at)
        return HeatError(growth.apart(own, balanced), False), BALANCE, ""


def is_warm(scene: Scene) -> bool:
    """Return whether the bearing of a scene runs on an oil, as warm as its films get."""
    return bool(scene.film_table.build().is_warming)


def settled_scene(scene: Scene) -> Scene:
    """Return a scene whose films keep the temperature that they have with the journal at rest."""
    if not is_warm(scene):
        return scene
    bearing: Any = scene.bearing
    at = equilibrium(quick_pads(bearing), scene.static_load, scene.speed)
    name = next(name for name, table in scene.others.items() if table is scene.film_table)
    kept: Any = replace(scene.film_table, temperature=at.temperature)  # type: ignore[type-var]
    return replace(scene, others={**scene.others, name: kept})


def warm_static_ladder(
    scene: Scene, quantity: str, films: Sequence[FilmCandidate], make: Callable[[Any], Rung]
) -> Ladder:
    """Return the ladder of a static quantity on an oil.

    Parameters
    ----------
    scene : Scene
    quantity : str
    films : sequence of FilmCandidate
        On the oil, the cheapest first.
    make : callable
        Takes a film at one temperature and returns the rung that answers on it.
    """
    quick = films[0].reaction
    question = HeatedQuestion(
        load=scene.static_load,
        speed=scene.speed,
        make=make,
        value=lambda own: rest_value(quantity, own),
        distance=lambda value, better: relative_distance(
            quantity, value, better, quick.cooled[1].supply_temperature
        ),
    )
    levels = (BALANCED,) if quantity in TEMPERATURES else (FRESH, BALANCED)

    def assumptions() -> tuple[str, ...]:
        own = uniform_rest(quick, question.load, question.speed)

        def moved(other: Any) -> float:
            return question.apart(own, uniform_rest(other, question.load, question.speed))

        return assumed_figures(quick, moved, fields=False)

    return Ladder(
        rungs=tuple(
            PadHeatRung(level=level, film=film, question=question) for level in levels for film in films
        ),
        unit=STATIC_UNITS[quantity],
        remarks=scene.film_remarks,
        within=ONE_TEMPERATURE,
        assumptions=assumptions,
        distance=question.distance,
    )


def warm_whirl_ladder(scene: Scene, mass: float, films: Sequence[FilmCandidate]) -> Ladder:
    """Return the ladder of the whirl threshold of a rigid rotor [kg] on fixed pads on an oil."""
    rungs = []
    for level in (FRESH, BALANCED):
        for warm in films:
            fresh = warm.at_temperature(warm.reaction.cooled[1].supply_temperature)
            film = fresh if level is FRESH else warm
            rungs.append(
                PadWhirlRung(film=film, load=scene.static_load, mass=mass, level=level, bearing=warm.reaction)
            )
    quick = rungs[len(films)]

    def assumptions() -> tuple[str, ...]:
        found = quick.answer(None)
        return assumed_figures(quick.bearing, lambda other: quick.moved(found, other), fields=False)

    return Ladder(
        rungs=tuple(rungs),
        unit="rad/s",
        remarks=scene.film_remarks,
        within=ONE_TEMPERATURE,
        assumptions=assumptions,
    )
