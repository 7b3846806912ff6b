"""Questions about motions on the film of any bearing: orbits of an unbalance, peaks after a lost blade."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from functools import cached_property, partial
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from ..analysis import RotorEquilibrium, coefficients, driven_rotor, equal_steps, equilibrium
from ..analysis.harmonic_balance import Complex, circles, driven, first_wave, resized, rms
from ..core.answers import (
    DISAGREEMENT,
    SAFETY,
    CandidateRung,
    ErrorEstimate,
    Ladder,
    RungResult,
    Work,
    WorkUnit,
    beside_bound,
)
from ..core.errors import InputError
from ..core.model import Array
from ..core.port import Reaction, amplitude_ratio
from ..core.results import Coefficients
from ..rotors import RigidRotor
from ..scenes.film_rungs import FilmCandidate, any_candidate
from ..scenes.oil_film_tables import require_law
from ..scenes.shared_tables import BladeLossTable, UnbalanceTable
from .film_statics import FilmQuestion, Films, Units, film_ladder
from .quantities import FORCE, ORBIT_UNITS, PHASE, relative

if TYPE_CHECKING:
    from ..scenes.scene import Scene

# The orbit that an unbalance makes: amplitude, phase, force; linear about the rest, or nonlinear at so many
# samples of a turn.


SAMPLES = (15, 31, 63)
"""Samples over a turn of the nonlinear rungs; odd, as they stand for whole harmonics."""

MAKING = 1e4
"""Forces of a cheap film in a second."""

LINEAR = 31
"""Samples over a turn at which a linear orbit's defect is taken."""


@dataclass(frozen=True, kw_only=True)
class OrbitRung(CandidateRung):
    """The orbit on one film, by what the rotor answers to its forces.

    Attributes
    ----------
    quantity : str
        A key of `ORBIT_UNITS`.
    rotor : RigidRotor
    samples : int
        Samples over a turn; 0 for the linear orbit.
    """

    quantity: str
    rotor: RigidRotor
    samples: int

    @property
    def name(self) -> str:
        """Linear, or the number of samples, and the film."""
        how = f"nonlinear, {self.samples} samples" if self.samples else "linear"
        return f"{how}, {self.film.name}"

    @property
    def prior(self) -> float:
        """Order of magnitude of the film's error."""
        return 0.3 * float(self.film.prior)

    @property
    def refines(self) -> tuple[object, ...]:
        """The film, where there are samples."""
        return (self.film,) if self.samples else ()

    @property
    def place(self) -> OrbitPlace:
        """What is asked."""
        return OrbitPlace(quantity=self.quantity, places=("",), reference=self.rotor.unbalance_angle)

    def answer(self, before: RungResult | None) -> RungResult:
        """Return the quantity of the orbit; a nonlinear one starts from that of a lower rung."""
        made = self.film.prepare()
        # K0 and C0 of a lower rung's rest do as well, since the film's forces have them added.
        lower: SolvedTurn | None = before.solution if before is not None and self.samples else None
        at = driven_rotor.rest_on_film(self.rotor, self.film.reaction) if lower is None else lower.at
        answers = driven_rotor.rotor_answers(self.rotor.structure, at, (), self.samples or LINEAR)
        orbit, work = answers.linear_orbit(rest := driven_rotor.rest_position(at, answers.stations)), 6
        if self.samples:
            start = orbit if lower is None else resized(lower.orbit, answers.harmonics)
            found = driven(answers.on({"": self.film.reaction}), start, rest)
            orbit, work = found.series, (found.iterations + 1) * self.samples
        solved = SolvedTurn(at=at, answers=answers, orbit=orbit)
        return RungResult(self.place.value(answers, orbit), {self.film.tangents: work, **made}, solved)

    def estimate(self, found: RungResult, before: RungResult | None, tolerance: float) -> ErrorEstimate:
        """Return the change that the richer film, at twice the samples, would make to first order.

        For the map the richer film is the map itself, as long as its own verified error is small enough.
        """
        turn: SolvedTurn = found.solution
        amplitude_ratio = driven_rotor.orbit_amplitude_ratio(
            turn.orbit, turn.answers.stations, {"": self.film.reaction}
        )
        if amplitude_ratio >= WALL:
            return ErrorEstimate(math.inf, "defect", doubt="the orbit leaves the clearance: not linear")
        calls = 2 * turn.answers.samples + 1
        doubled = driven_rotor.rotor_answers(self.rotor.structure, turn.at, (), calls)
        bound = self.film.motion_bound(amplitude_ratio)
        if SAFETY * bound < tolerance:
            error, doubt = self._by_defect(doubled, turn, found.value, self.film.reaction)
            method, work = f"its defect at {calls} samples", {self.film.tangents: calls}
            return beside_bound(error, bound, method, work, doubt)
        error, doubt = self._by_defect(doubled, turn, found.value, self.film.rich)
        work = {self.film.defects(smooth=False): calls}
        method = f"defect of {self.film.rich_name}, {calls} samples"
        return ErrorEstimate(error, method, work, bound=self.film.bounded and bool(self.samples), doubt=doubt)

    def _by_defect(
        self, answers: driven_rotor.RotorAnswers, turn: SolvedTurn, value: float, rich: Reaction
    ) -> tuple[float, str]:
        own = {"": self.film.reaction}
        balance = answers.on({"": rich}, sloped=own if self.film.bounded else None)
        orbit = resized(turn.orbit, answers.harmonics)
        step, other = driven_rotor.propagated(balance, orbit, own if self.samples else None)
        error = self.place.change(value, self.place.value(answers, orbit + step))
        apart = rms(step - other) / max(rms(step), 1e-300)
        doubt = ""
        if apart > DISAGREEMENT:
            doubt = f"the slopes of both films disagree on the error by {apart:.0%}: not linear"
        return error, doubt

    def expected(self, done: Work) -> Work:
        """Return five Newton steps at these samples."""
        return self.film.expected(5 * self.samples if self.samples else 6)


def rotor_of(scene: Scene) -> RigidRotor:
    """Return the rotor of a scene with the unbalance of its excitation, or else its own.

    Raises
    ------
    InputError
        If it has none or both, another excitation, or does not turn.
    """
    rotor, excitation = scene.rotor, scene.excitation
    if type(excitation) is UnbalanceTable:  # a lost blade is one too
        rotor = excitation.given_to(rotor)
    elif excitation is not None:
        raise InputError(
            f'excitation must be of kind "unbalance" for a steady orbit, got {type(excitation).__name__}'
        )
    if rotor.unbalance <= 0.0:
        raise InputError(f"rigid_rotor.unbalance must be positive for an orbit, got {rotor.unbalance!r}")
    if scene.speed == 0.0:
        raise InputError("operation.speed must not be zero for an orbit, got 0.0")
    return rotor


# Ladders of motions on the films of any bearing.


def motion_question(
    scene: Scene,
    make: Callable[[Any, int], Any],
    counts: tuple[int, ...],
    unit: str,
    distance: Callable[[Any, Any], float],
    **how: Any,
) -> FilmQuestion:
    """Return a question about a motion, linear about the rest or in ever more samples or steps of a turn.

    On an oil the films keep the temperature of the rest. What a richer level of heat, or the conservation of
    the oil, would change is taken of the linear motion.

    Parameters
    ----------
    scene : Scene
    make, counts, unit, distance
        As in `FilmQuestion`; a count of 0 is the linear motion.
    **how
        `effort` or `scaled` of it.
    """

    def units(films: Sequence[FilmCandidate]) -> Units:
        return {unit: call for film in films for unit, call in film.batch_units(scene.speed).items()}

    def linear(own: Any) -> float:
        return float(make(any_candidate(own.reaction), 0).answer(None).value)

    return FilmQuestion(
        load=scene.static_load,
        speed=scene.speed,
        unit=unit,
        make=make,
        value=linear,
        distance=distance,
        units=units,
        counts=(0, *counts),
        moves=True,
        **how,
    )


def _turn_films(films: Films, scene: Scene, quantity: str) -> Sequence[FilmCandidate]:
    """Return films for states all round a turn; InputError for one that conserves its oil."""
    require_law(scene.film_table, quantity)
    return films(scene)


def orbit_ladder(films: Films, scene: Scene, quantity: str, rung: type[OrbitRung] = OrbitRung) -> Ladder:
    """Return the ladder of a quantity of the synchronous orbit: linear, then nonlinear, on each film.

    Parameters
    ----------
    films : callable
        Takes the scene and returns the candidates for states all round a turn.
    scene : Scene
    quantity : str
        A key of `ORBIT_UNITS`.
    rung : type
        `OrbitRung`, or `StatefulOrbitRung` on tilting pads.

    Raises
    ------
    InputError
        As `rotor_of`.
    """
    rotor, known = rotor_of(scene), _turn_films(films, scene, quantity)

    def effort(one: OrbitRung) -> float:
        """Return a measure of cost: films by place, each twice the one before; maps to be made last."""
        each = 1.0 if one.film.makes_map else 2.0 ** known.index(one.film)
        return MAKING * float(one.film.making) + each * (6 if one.samples == 0 else 5 * one.samples)

    question = motion_question(
        scene,
        lambda film, samples: rung(film=film, quantity=quantity, rotor=rotor, samples=samples),
        SAMPLES,
        ORBIT_UNITS[quantity],
        partial(wave_change, quantity),
        effort=effort if rung is OrbitRung else None,
        scaled=quantity != PHASE,
    )
    return film_ladder(scene, lambda scene: known, question)


# How far a rotor goes after something has begun to shake it at rest: rungs in ever shorter steps.


STEPS = (48, 96, 192, 384, 768)
"""Steps over a turn of the nonlinear rungs."""

LINEAR_STEPS = 192
"""Those of the linear motion."""

SAMPLED = 48
"""States over a turn at which the defect is taken."""


class PeakMotion(NamedTuple):
    """A motion, as its estimate and the rung above it start from it.

    Attributes
    ----------
    motion : MarchMotion
    coarse : float [m]
        The peak in steps twice as long; nan where nobody needs it.
    steps : int
        Steps over a turn; 0 for the linear motion.
    """

    motion: equal_steps.MarchMotion
    coarse: float
    steps: int


@dataclass(frozen=True, kw_only=True)
class PeakRung(CandidateRung):
    """The peak by one film, linear about the rest or nonlinear in so many steps over a turn.

    A rung adds `shaken`, `at_rest`, `grid`, `answer` and `estimate`.

    Attributes
    ----------
    steps : int
        Steps over a turn, at the highest speed; 0 for the linear motion.
    """

    steps: int

    @property
    def name(self) -> str:
        """Linear, or the number of steps, and the film."""
        return f"{f'nonlinear, {self.steps} steps' if self.steps else 'linear'}, {self.film.name}"

    @property
    def prior(self) -> float:
        """Order of magnitude of the error of the steps, and of the film."""
        return max(0.3 * self.film.prior, 3.0 / self.steps**2 if self.steps else 0.0)

    @property
    def refines(self) -> tuple[object, ...]:
        """The film, where there are steps."""
        return (self.film,) if self.steps else ()

    @property
    def tangents(self) -> WorkUnit:
        """One force of the film with derivatives."""
        return self.film.tangents

    @property
    def shaken(self) -> equal_steps.ExcitedRotor:
        """The rotor on this film, and what shakes it."""
        raise NotImplementedError

    @property
    def at_rest(self) -> equal_steps.RestTangent:
        """The film at rest, by which the linear motion goes."""
        raise NotImplementedError

    def grid(self, steps: int) -> tuple[float, int]:
        """Return the length [s] and the number of steps, so many over a turn."""
        raise NotImplementedError

    def linear(self, steps: int) -> equal_steps.MarchMotion:
        """Return the motion by the film at rest."""
        return self.shaken.linear(self.at_rest, *self.grid(steps))

    def nonlinear(self, before: RungResult | None) -> RungResult:
        """Return the peak, and with it that in steps twice as long, which the rung below may have."""
        made = self.film.prepare()
        motion, calls = self.shaken.nonlinear(*self.grid(self.steps))
        if before is not None and self.tangents in before.work and 2 * before.solution.steps == self.steps:
            coarse = float(before.value)
        else:
            other, more = self.shaken.nonlinear(*self.grid(self.steps // 2))
            coarse, calls = equal_steps.peak(other.position), calls + more
        solved = PeakMotion(motion, coarse, self.steps)
        return RungResult(equal_steps.peak(motion.position), {self.tangents: calls, **made}, solved)

    def increment(self, found: RungResult) -> float:
        """Return the relative error of the steps by their order, with its sign."""
        return float((found.value - found.solution.coarse) / (2.0**equal_steps.ORDER - 1.0) / found.value)

    def stride(self, samples: int) -> int:
        """Return how many steps of the motion lie between samples, so many over a turn."""
        return max(1, (self.steps or LINEAR_STEPS) // samples)

    def by_defect(self, states: equal_steps.StatesAlong, rich: Reaction) -> tuple[Array, str]:
        """Return how much a richer film moves the rotor (2, n) [m], and why not to trust it."""
        own = self.shaken.reaction if self.steps else self.at_rest
        moved, apart = self.shaken.propagated(states, own, rich)
        doubt = f"the slopes of both films disagree on the error by {apart:.0%}: not linear"
        return moved, doubt if apart > DISAGREEMENT else ""


# How far the journal goes after a blade is lost: linear, then nonlinear in ever shorter steps.


COMMON_STEPS = 192
"""Steps over a turn that are enough for most motions; by their cost the films are ordered."""

LINEAR_CALLS = 6
"""Forces with derivatives that a linear motion takes."""


@dataclass(frozen=True, kw_only=True)
class BladeLossRung(PeakRung):
    """The peak in a journal bearing.

    Attributes
    ----------
    load : (float, float) [N]
    speed : float [rad/s]
    mass : float [kg]
    excitation : BladeLossTable
    """

    load: tuple[float, float]
    speed: float
    mass: float
    excitation: BladeLossTable

    @cached_property
    def rest(self) -> Coefficients:
        """Position, K and C of the film at rest."""
        at = equilibrium(self.film.reaction, self.load, self.speed)
        return coefficients(self.film.reaction, at.position, self.speed)

    @property
    def shaken(self) -> equal_steps.ExcitedRotor:
        """The rotor on this film, and what shakes it."""
        return equal_steps.ExcitedRotor(
            self.film.reaction, self.mass, self.speed, self.rest.position, self._pull
        )

    @property
    def at_rest(self) -> equal_steps.RestTangent:
        """The film at rest, by which the linear motion goes."""
        return equal_steps.RestTangent(-np.array(self.load), self.rest.stiffness, self.rest.damping)

    def grid(self, steps: int) -> tuple[float, int]:
        """Return the length [s] and the number of steps, so many over a turn."""
        return 2.0 * math.pi / (abs(self.speed) * steps), math.ceil(steps * self.excitation.revolutions)

    def answer(self, before: RungResult | None) -> RungResult:
        """Return the largest distance from the center of the bearing [m]."""
        if self.steps:
            return self.nonlinear(before)
        made, motion = self.film.prepare(), self.linear(LINEAR_STEPS)
        rates = np.gradient(motion.position, self.grid(LINEAR_STEPS)[0], axis=1, edge_order=2)
        solved = PeakMotion(replace(motion, velocity=rates), math.nan, 0)
        return RungResult(equal_steps.peak(motion.position), {self.tangents: LINEAR_CALLS, **made}, solved)

    def _pull(self, t: float) -> tuple[float, float]:
        angle = self.speed * t + self.excitation.unbalance_angle
        force = self.excitation.unbalance * self.speed**2
        return self.load[0] + force * math.cos(angle), self.load[1] + force * math.sin(angle)

    def estimate(self, found: RungResult, before: RungResult | None, tolerance: float) -> ErrorEstimate:
        """Return the error of the steps (order increment), and of the film by its defect along the motion."""
        motion: equal_steps.MarchMotion = found.solution.motion
        near = amplitude_ratio(self.film.reaction, motion.position)
        if near >= 0.999:
            return ErrorEstimate(math.inf, "defect", doubt="the motion leaves the clearance: not linear")
        steps, how = (abs(self.increment(found)), "order increment; ") if self.steps else (0.0, "")
        bound = self.film.motion_bound(near)
        if self.steps and SAFETY * bound < tolerance:
            return beside_bound(steps, bound, how + "verified bound of the map", {})
        own = not self.steps and SAFETY * bound < tolerance
        states = equal_steps.states_along(motion, self.stride(SAMPLED))
        moved, doubt = self.by_defect(states, self.film.reaction if own else self.film.rich)
        change = (
            abs(equal_steps.peak(states.position + moved) - equal_steps.peak(states.position)) / found.value
        )
        work = {self.tangents if own else self.film.defects(smooth=False): states.position.shape[1]}
        method = f"{how}defect of {self.film.name if own else self.film.rich_name}"
        return beside_bound(change + steps, bound if own else 0.0, method, work, doubt)

    def expected(self, done: Work) -> Work:
        """Return three tangents for each step."""
        return self.film.expected(3 * self.grid(self.steps)[1] if self.steps else LINEAR_CALLS)


def blade_loss_ladder(films: Films, scene: Scene, quantity: str) -> Ladder:
    """Return the ladder of the peak after a blade is lost: linear, then nonlinear, on each film.

    Parameters
    ----------
    films : callable
        Takes the scene and returns the candidates for states all round a turn.
    scene : Scene
    quantity : str

    Raises
    ------
    InputError
        If the scene loses no blade, has no rotor or one with an unbalance, or does not turn.
    """
    excitation = lost_blade(scene)
    mass = excitation.given_to(scene.rotor).mass
    calls = math.ceil(3 * COMMON_STEPS * excitation.revolutions)
    known = sorted(_turn_films(films, scene, quantity), key=lambda film: film.time(calls))

    def make(film: FilmCandidate, steps: int) -> BladeLossRung:
        return BladeLossRung(
            film=film,
            load=scene.static_load,
            speed=scene.speed,
            mass=mass,
            excitation=excitation,
            steps=steps,
        )

    def effort(rung: BladeLossRung) -> float:
        """Return the time of a rung; a linear motion takes so few forces that no map is worth it."""
        return rung.film.time(calls if rung.steps else LINEAR_CALLS)

    made = any(film.makes_map for film in known[:-1])
    question = motion_question(scene, make, STEPS, "m", relative, effort=effort if made else None)
    return film_ladder(scene, lambda scene: known, question)


def lost_blade(scene: Scene) -> BladeLossTable:
    """Return the blade that a scene loses; raise InputError if there is none, or nothing turns."""
    lost: BladeLossTable = scene.excited_by("peak_displacement", BladeLossTable)
    if scene.speed == 0.0:
        raise InputError("operation.speed must not be zero for a lost blade, got 0.0")
    return lost


# What is asked about an orbit that an unbalance makes, and where.

WALL = 0.999
"""Distance from the center / clearance from which a journal touches."""


@dataclass(frozen=True, kw_only=True)
class SolvedTurn:
    """A solved orbit, as its estimate and a higher rung start from it.

    Attributes
    ----------
    at : RotorEquilibrium
        The rotor at rest, about which its films are linearized.
    answers : RotorAnswers
        What the rotor answers to forces on its journals over a turn.
    orbit : ndarray, shape (2 m, 2 H + 1) [m]
        Series of the journals over a turn.
    """

    at: RotorEquilibrium
    answers: driven_rotor.RotorAnswers
    orbit: Array


@dataclass(frozen=True, kw_only=True)
class OrbitPlace:
    """What is asked about an orbit.

    Attributes
    ----------
    quantity : str
        A key of `UNITS`.
    places : tuple of str
        Bearings and probes among which the largest counts.
    reference : float [rad]
        Angle of the unbalance from which a phase counts.
    probes : tuple of str
        Those of the places that are probes.
    """

    quantity: str
    places: tuple[str, ...]
    reference: float
    probes: tuple[str, ...] = ()

    def value(self, answers: driven_rotor.RotorAnswers, orbit: Array) -> float:
        """Return the quantity of an orbit, from its first harmonic."""
        places = self.places[:1] if self.quantity == PHASE else self.places
        waves = (self._wave(answers, orbit, name) for name in places)
        return max(wave_value(self.quantity, wave, answers.speed, self.reference) for wave in waves)

    def _wave(self, answers: driven_rotor.RotorAnswers, orbit: Array, name: str) -> Complex:
        if name in self.probes:
            by_force, by_unbalance = answers.probes[name]
            return np.asarray(by_force @ answers.excess(orbit) + by_unbalance)
        wave = answers.film_wave(orbit) if self.quantity == FORCE else first_wave(orbit)
        k = answers.stations.index(name)
        return wave[2 * k : 2 * k + 2]

    def largest_change(self, answers: driven_rotor.RotorAnswers, orbit: Array, forces: Array) -> float:
        """Return the most that first harmonics of forces on the journals (2 m,) [N] change the quantity by.

        Relative, or of a phase in radians: the phase of each force is the worst.
        """
        moved = answers.journals[1]
        if self.quantity == FORCE:
            moved = np.eye(len(moved)) - answers.on_springs(moved)
        changes = []
        for name in self.places:
            if name in self.probes:
                rows = answers.probes[name][0]
            else:
                k = answers.stations.index(name)
                rows = moved[2 * k : 2 * k + 2]
            changes.append(float(np.linalg.norm(np.abs(rows) @ forces)))
        if self.quantity != PHASE:
            return max(changes) / abs(self.value(answers, orbit))
        with_it, against = circles(self._wave(answers, orbit, self.places[0]))
        # half of the sum of x and +-i y
        return changes[0] / math.sqrt(2.0) / abs(with_it if answers.speed > 0.0 else against)

    def change(self, before: float, after: float) -> float:
        """Return the relative distance of two values; of phases in radians."""
        return wave_change(self.quantity, before, after)


def wave_value(quantity: str, wave: Complex, speed: float, reference: float) -> float:
    """Return the quantity of a first harmonic (2,) at a signed speed; a phase from a reference [rad] on."""
    with_it, against = circles(wave)
    if quantity != PHASE:
        return float(abs(with_it) + abs(against))
    turn = np.angle(with_it) if speed > 0.0 else np.angle(against)
    return math.remainder(float(turn) - reference, 2.0 * math.pi)


def wave_change(quantity: str, before: float, after: float) -> float:
    """Return the relative distance of two values; of phases in radians."""
    if quantity == PHASE:
        return abs(math.remainder(after - before, 2.0 * math.pi))
    return abs(after - before) / abs(after)
