"""Questions about the orbit that an unbalance makes: amplitude, phase, force; linear and nonlinear rungs."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from functools import partial
from typing import TYPE_CHECKING

import numpy as np

from ...answers import DISAGREEMENT, ISOTHERMAL, SAFETY, ErrorEstimate, Found, Work, WorkUnit, beside_bound
from ...errors import InputError
from ...ladders import Ladder
from ...model import Reaction
from ...motion.periodic.driven_rotor import (
    RotorAnswers,
    propagated,
    reach_of,
    rest_on_film,
    rest_position,
    rotor_answers,
)
from ...motion.periodic.harmonics import resized, rms
from ...motion.periodic.orbit_newton import driven
from ...rotors import RigidRotor
from ...scenes.excitation_table import UnbalanceTable
from ...scenes.journal.film_candidate import FilmCandidate, room
from ...scenes.journal.film_rung import FilmRung
from ...scenes.journal.film_rungs import turn_films
from ...scenes.journal.warm_rest import WarmRest
from ..orbit_place import PHASE, UNITS, WALL, OrbitPlace, SolvedTurn
from ..orbit_rung import SampledOrbitRung
from .conserved_whirl import with_moved_rupture
from .field_rungs import HeatedQuestion
from .heat_rungs import thermal_ladder

if TYPE_CHECKING:
    from ...scenes.scene import Scene

SAMPLES = (15, 31, 63)
"""Samples over a turn of the nonlinear rungs; odd, as they stand for whole harmonics."""

MAKING = 1e4
"""Forces of a cheap film in a second."""

LINEAR = 31
"""Samples over a turn at which a linear orbit's defect is taken."""


@dataclass(frozen=True, kw_only=True)
class OrbitRung(SampledOrbitRung[FilmCandidate]):
    """The orbit on one film, by what the rotor answers to its forces."""

    @property
    def place(self) -> OrbitPlace:
        """What is asked."""
        return OrbitPlace(quantity=self.quantity, places=("",), reference=self.rotor.unbalance_angle)

    def answer(self, before: Found | None) -> Found:
        """Return the quantity of the orbit; a nonlinear one starts from that of a lower rung."""
        made = self.film.prepare()
        # K0 and C0 of a lower rung's rest do as well, since the film's forces have them added.
        lower: SolvedTurn | None = before.solution if before is not None and self.samples else None
        at = rest_on_film(self.rotor, self.film.reaction) if lower is None else lower.at
        answers = rotor_answers(self.rotor.structure, at, (), self.samples or LINEAR)
        orbit, work = answers.linear_orbit(rest := rest_position(at, answers.stations)), 6
        if self.samples:
            start = orbit if lower is None else resized(lower.orbit, answers.harmonics)
            found = driven(answers.on({"": self.film.reaction}), start, rest)
            orbit, work = found.series, (found.iterations + 1) * self.samples
        solved = SolvedTurn(at=at, answers=answers, orbit=orbit)
        return Found(self.place.value(answers, orbit), {self.film.tangents: work, **made}, solved)

    def estimate(self, found: Found, before: Found | None, tolerance: float) -> ErrorEstimate:
        """Return the change that the richer film, at twice the samples, would make to first order.

        For the map the richer film is the map itself, as long as its own verified error is small enough.
        """
        turn: SolvedTurn = found.solution
        reach = reach_of(turn.orbit, turn.answers.stations, {"": self.film.reaction})
        if reach >= WALL:
            return ErrorEstimate(math.inf, "defect", doubt="the orbit leaves the clearance: not linear")
        calls = 2 * turn.answers.samples + 1
        doubled = rotor_answers(self.rotor.structure, turn.at, (), calls)
        bound = self.film.motion_bound(reach)
        if SAFETY * bound < tolerance:
            error, doubt = self._by_defect(doubled, turn, found.value, self.film.reaction)
            method, work = f"its defect at {calls} samples", {self.film.tangents: calls}
            return beside_bound(error, bound, method, work, doubt)
        error, doubt = self._by_defect(doubled, turn, found.value, self.film.rich)
        work = {self.film.defects(smooth=False): calls}
        method = f"defect of {self.film.rich_name}, {calls} samples"
        return ErrorEstimate(error, method, work, bound=self.film.bounded and bool(self.samples), doubt=doubt)

    def _by_defect(
        self, answers: RotorAnswers, turn: SolvedTurn, value: float, rich: Reaction
    ) -> tuple[float, str]:
        own = {"": self.film.reaction}
        balance = answers.on({"": rich}, sloped=own if self.film.bounded else None)
        orbit = resized(turn.orbit, answers.harmonics)
        step, other = propagated(balance, orbit, own if self.samples else None)
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
        require_one_unbalance(rotor)
        rotor = replace(rotor, unbalance=excitation.unbalance, unbalance_angle=excitation.unbalance_angle)
    elif excitation is not None:
        raise InputError(
            f'excitation must be of kind "unbalance" for a steady orbit, got {type(excitation).__name__}'
        )
    if rotor.unbalance <= 0.0:
        raise InputError(f"rigid_rotor.unbalance must be positive for an orbit, got {rotor.unbalance!r}")
    if scene.speed == 0.0:
        raise InputError("operation.speed must not be zero for an orbit, got 0.0")
    return rotor


def require_one_unbalance(rotor: RigidRotor) -> None:
    """Raise InputError if a rotor has an unbalance beside that of an excitation."""
    if rotor.unbalance:
        raise InputError(
            "rigid_rotor.unbalance must be 0 where [excitation] has the unbalance, "
            f"got {rotor.unbalance!r} kg m"
        )


def orbit_ladder(scene: Scene, quantity: str) -> Ladder:
    """Return the ladder of a quantity of the synchronous orbit: linear, then nonlinear, on each film."""
    rotor = rotor_of(scene)
    assert scene.journal is not None  # whose question it is
    scene.journal.require_law(quantity)
    films = orbit_films(scene)
    warm = scene.journal_bearing.is_warming
    ladder = (
        warm_orbit_ladder(scene, quantity, rotor, films)
        if warm
        else cold_orbit_ladder(scene, quantity, films)
    )

    def linear(film: FilmCandidate) -> float:
        rung = OrbitRung(film=film, quantity=quantity, rotor=rotor, samples=0)
        return float(rung.answer(None).value)

    place = OrbitRung(film=films[0], quantity=quantity, rotor=rotor, samples=0).place
    return with_moved_rupture(scene, ladder, linear, place.change, scaled=quantity != PHASE)


def cold_orbit_ladder(scene: Scene, quantity: str, films: Sequence[FilmCandidate]) -> Ladder:
    """Return the ladder of an orbit by films of one viscosity: linear, then nonlinear, on each."""
    rotor = rotor_of(scene)
    rungs = [OrbitRung(film=film, quantity=quantity, rotor=rotor, samples=0) for film in films]
    rungs += [
        OrbitRung(film=film, quantity=quantity, rotor=rotor, samples=n) for film in films for n in SAMPLES
    ]
    rungs.sort(key=lambda rung: _effort(rung, films))
    return Ladder(
        rungs=tuple(rungs),
        unit=UNITS[quantity],
        units=film_batch_units(films, scene.speed),
        remarks=scene.film_remarks,
        within=ISOTHERMAL,
        distance=rungs[0].place.change,
    )


def warm_orbit_ladder(scene: Scene, quantity: str, rotor: RigidRotor, films: tuple[FilmRung, ...]) -> Ladder:
    """Return the ladder of an orbit on an oil, which keeps the temperature that it has at rest.

    What a richer level of heat would change is taken of the linear orbit.
    """

    def rung(film: FilmRung, samples: int = 0) -> OrbitRung:
        return OrbitRung(film=film, quantity=quantity, rotor=rotor, samples=samples)

    def value(own: WarmRest) -> float:
        found: float = rung(films[0].frozen(own.reaction)).answer(None).value
        return found

    distance = rung(films[0]).place.change
    questions = tuple(
        HeatedQuestion(
            load=scene.static_load,
            speed=scene.speed,
            make=partial(rung, samples=n),
            value=value,
            distance=distance,
            moves=True,
        )
        for n in (0, *SAMPLES)
    )
    return thermal_ladder(scene, films, questions, UNITS[quantity])


def orbit_films(scene: Scene) -> tuple[FilmRung, ...]:
    """Return the films worth taking round a turn: the map where there is one, else short film, grids, map."""
    return turn_films(scene.journal_bearing, fixed=scene.film_is_given, grids=((48, 8), (96, 8)), maps=True)


def _effort(rung: OrbitRung, films: Sequence[FilmCandidate]) -> float:
    """Return a measure of cost by which the rungs are ordered: films by place, each twice the one before.

    A map that is to be made comes after all that need none, by the time that it takes.
    """
    one = 1.0 if rung.film.makes_map else 2.0 ** films.index(rung.film)
    return MAKING * rung.film.making + one * (6 if rung.samples == 0 else 5 * rung.samples)


def film_batch_units(films: Sequence[FilmCandidate], speed: float) -> dict[WorkUnit, Callable[[], object]]:
    """Return one force with derivatives of each film and of its richer one."""
    units: dict[WorkUnit, Callable[[], object]] = {}
    for film in films:
        units[film.tangents] = _sampled(film.reaction, speed)
        units[film.defects(smooth=False)] = _sampled(film.rich, speed)
    return units


def _sampled(reaction: Reaction, speed: float) -> Callable[[], object]:
    position, velocity = np.array([0.3, 0.4]) * room(reaction), np.zeros(2)

    def one() -> object:
        return reaction.force(position, velocity, speed), reaction.jacobian(position, velocity, speed)

    return one
