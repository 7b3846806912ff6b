"""Questions about the orbit of a flexible rotor under its unbalance: amplitude, phase, force on a bearing."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from functools import cached_property
from typing import TYPE_CHECKING

import numpy as np

from ...answers import DISAGREEMENT, SAFETY, ErrorEstimate, Found, Work, WorkUnit
from ...errors import InputError, RotorfilmError
from ...ladders import BaseRung, Ladder
from ...linear import RotorEquilibrium, rotor_equilibrium
from ...model import Array, Reaction
from ...motion.periodic.sampled_orbit import circles, rate_matrix
from ...motion.periodic.sampled_shaft_orbit import (
    ShaftAnswers,
    ShaftOrbit,
    linear_shaft_orbit,
    moved_by,
    nonlinear_shaft_orbit,
    reach_of,
    shaft_answers,
    shaft_defect,
    shaft_forces,
    wave_of,
)
from ...rotors.shaft.shaft_models import ShaftModel, shaft_models
from ...scenes.excitation_table import UnbalanceTable
from ...scenes.shaft.shaft_remarks import shaft_physics, shaft_remarks, stability_remark
from ..journal.unbalance_orbits import FORCE, PHASE, UNITS
from .shaft_films import ShaftFilms, film_levels

if TYPE_CHECKING:
    from ...scenes.scene import Scene

LINEAR = 15
"""Samples over a turn at which a linear orbit's defect is taken, and a little more than twice as many."""

NONLINEAR = (("reduced", 15), ("mesh", 15), ("mesh", 31), ("mesh", 63), ("split", 63), ("split", 127))
"""Models of the shaft and samples over a turn of the nonlinear rungs."""

RAMP = 8
"""Parts in which the unbalance is raised where Newton's method does not end at once."""

ROUNDOFF = 1e-12
"""Size of a step / size of the orbit that is no error any more."""

WALL = 0.999
"""Distance from the center / clearance from which a journal touches."""


@dataclass(frozen=True, kw_only=True)
class OrbitPlace:
    """What is asked about an orbit.

    Attributes
    ----------
    quantity : str
        A key of `UNITS`.
    places : tuple of str
        Bearings and probes among which the largest counts.
    probes : tuple of str
        Those of them that are probes.
    reference : float [rad]
        Angle of the unbalance from which a phase counts.
    """

    quantity: str
    places: tuple[str, ...]
    probes: tuple[str, ...]
    reference: float

    def value(self, answers: ShaftAnswers, orbit: ShaftOrbit) -> float:
        """Return the quantity of an orbit, from its first harmonic."""
        waves = [circles(self._wave(answers, orbit, name)) for name in self.places]
        if self.quantity == PHASE:
            with_it, against = waves[0]
            turn = np.angle(with_it) if answers.speed > 0.0 else np.angle(against)
            return math.remainder(float(turn) - self.reference, 2.0 * math.pi)
        return max(abs(with_it) + abs(against) for with_it, against in waves)

    def _wave(self, answers: ShaftAnswers, orbit: ShaftOrbit, name: str) -> np.ndarray:
        if name in self.probes:
            by_force, by_unbalance = answers.probes[name]
            return np.asarray(by_force @ orbit.excess + by_unbalance)
        k = answers.stations.index(name)
        pair = slice(2 * k, 2 * k + 2)
        motion = wave_of(orbit.position)
        if self.quantity != FORCE:
            return np.asarray(motion[pair])
        turn = abs(answers.speed)
        springs = answers.stiffness + 1j * turn * answers.damping
        return np.asarray((springs @ motion - orbit.excess)[pair])

    def largest_change(self, answers: ShaftAnswers, orbit: ShaftOrbit, forces: Array) -> float:
        """Return the most that first harmonics of forces on the journals (2 m,) [N] change the quantity by.

        Relative, or of a phase in radians: the phase of each force is the worst.
        """
        moved = answers.journals[1]
        if self.quantity == FORCE:
            springs = answers.stiffness + 1j * abs(answers.speed) * answers.damping
            moved = np.eye(len(moved)) - springs @ moved
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
        if self.quantity == PHASE:
            return abs(math.remainder(after - before, 2.0 * math.pi))
        return abs(after - before) / abs(after)


@dataclass(frozen=True, kw_only=True)
class ShaftTurn:
    """A solved orbit, as its estimate and a higher rung start from it.

    Attributes
    ----------
    at : RotorEquilibrium
        The rotor at rest, about which its films are linearized.
    answers : ShaftAnswers
        What the shaft answers to forces on its journals over a turn.
    orbit : ShaftOrbit
        The orbit.
    """

    at: RotorEquilibrium
    answers: ShaftAnswers
    orbit: ShaftOrbit


@dataclass(frozen=True, kw_only=True)
class ShaftOrbitRung(BaseRung):
    """The orbit by one model of the shaft and one film for each journal, linear or nonlinear.

    Attributes
    ----------
    model : ShaftModel
    films : ShaftFilms
    place : OrbitPlace
    speed : float [rad/s]
    samples : int
        Over a turn; 0 for the linear orbit.
    """

    model: ShaftModel
    films: ShaftFilms
    place: OrbitPlace
    speed: float
    samples: int

    @property
    def name(self) -> str:
        """Linear or the number of samples, the model of the shaft, the film."""
        how = f"{self.samples} samples" if self.samples else "linear"
        return ", ".join(part for part in (how, self.model.name, self.films.name) if part)

    @property
    def refines(self) -> tuple[object, ...]:
        """Model of the shaft and films, where there are samples."""
        return (self.model, self.films) if self.samples else ()

    @property
    def unit(self) -> WorkUnit:
        """One turn."""
        return WorkUnit(f"turns of {self.name}", ("turns", id(self.model), id(self.films), self.samples))

    @cached_property
    def _reactions(self) -> dict[str, Reaction]:
        return self.films.reaction

    def answer(self, before: Found | None) -> Found:
        """Return the quantity of the orbit; a nonlinear one starts from that of a lower rung."""
        made = self.films.prepare()
        at = rotor_equilibrium(self.model.rotor, self._reactions, self.speed)
        answers = shaft_answers(self.model.rotor.structure, at, self.place.probes, self.samples or LINEAR)
        orbit, work = linear_shaft_orbit(answers, at), 1
        if self.samples:
            start = orbit if before is None else before.solution.orbit
            orbit, work = self._nonlinear(answers, at, start)
        solved = ShaftTurn(at=at, answers=answers, orbit=orbit)
        return Found(self.place.value(answers, orbit), {self.unit: work, **made}, solved)

    def _nonlinear(
        self, answers: ShaftAnswers, at: RotorEquilibrium, start: ShaftOrbit
    ) -> tuple[ShaftOrbit, int]:
        """Return the orbit; where its start is too far out, from the rest up in steps of the unbalance."""
        if reach_of(start, answers.stations, self._reactions) < 0.95:
            try:
                return nonlinear_shaft_orbit(answers, self._reactions, start)
            except RotorfilmError:
                pass
        still = answers._replace(external=answers.external * np.array([[1.0], [0.0]]))
        orbit, work = linear_shaft_orbit(still, at), 0
        for part in np.linspace(1.0 / RAMP, 1.0, RAMP):
            orbit, more = nonlinear_shaft_orbit(answers, self._reactions, orbit, float(part))
            work += more
        return orbit, work

    def estimate(self, found: Found, before: Found | None, tolerance: float) -> ErrorEstimate:
        """Return the change that elements half as long, the richer films and twice the samples would make.

        It is the defect of the orbit in them, propagated by the slopes of the richer films; a second defect
        there takes out what is of second order, and tells whether the first step was linear. The map is its
        own richer film, and where its verified bound is too large the forces of a grid are compared.
        """
        turn: ShaftTurn = found.solution
        if reach_of(turn.orbit, turn.answers.stations, self._reactions) >= WALL:
            return ErrorEstimate(math.inf, "defect", doubt="the orbit leaves the clearance: not linear")
        value, fine = float(found.value), self.model.finer.structure
        bound = self._bound(turn)
        trusted = SAFETY * bound < tolerance
        films = self._reactions if trusted or self.films.bounded else self.films.rich
        samples = 2 * turn.answers.samples + 1 if self.has_films else LINEAR
        answers = shaft_answers(fine, turn.at, self.place.probes, samples)
        error, doubt = self._by_defect(answers, turn, films, value)
        method = f"defect in {len(self.model.finer.elements)} elements"
        if self.has_films:
            method += f" at {samples} samples"
        if not trusted:
            method += f", {self.films.rich_name}"
        # The share of a map: its verified bound, or the distance to a grid, which is less close than it is.
        films_share = 0.0
        if self.has_films and self.films.bounded:
            films_share = bound if trusted else self._by_grid(turn, value)
        is_bound = films_share > error
        error += films_share if is_bound or not trusted else 0.0
        work = {WorkUnit(f"defects of {self.name}"): 1}
        return ErrorEstimate(error, method, work, bound=is_bound, doubt=doubt)

    def _by_grid(self, turn: ShaftTurn, value: float) -> float:
        """Return the change that the forces of the richer films make, propagated by the slopes of the map."""
        answers = shaft_answers(self.model.rotor.structure, turn.at, self.place.probes, LINEAR)
        orbit = turn.orbit.resampled(LINEAR)
        own = shaft_defect(answers, self._reactions, orbit)
        other = shaft_forces(answers, self.films.rich, orbit) - own.forces
        waves = np.fft.rfft(other, axis=1).T
        missing = np.fft.irfft((answers.journals @ waves[:, :, None])[:, :, 0].T, LINEAR, axis=1)
        step = moved_by(answers, missing, own.slope)
        change = wave_of(other + (own.slope @ step.ravel()).reshape(step.shape))
        moved = replace(turn.orbit.resampled(LINEAR), excess=turn.orbit.excess + change)
        moved = replace(moved, position=moved.position + step)
        return self.place.change(value, self.place.value(answers, moved))

    def _by_defect(
        self, fine: ShaftAnswers, turn: ShaftTurn, films: dict[str, Reaction], value: float
    ) -> tuple[float, str]:
        orbit = turn.orbit.resampled(fine.samples)
        rate = abs(self.speed) * rate_matrix(fine.samples)
        lack = shaft_defect(fine, films, orbit)
        sizes: list[float] = []
        for _ in range(2 if self.has_films else 1):
            step = moved_by(fine, lack.missing, lack.slope)
            sizes.append(float(np.linalg.norm(step)))
            position = orbit.position + step
            orbit = ShaftOrbit(
                position=position,
                velocity=position @ rate.T,
                excess=wave_of(lack.excess + (lack.slope @ step.ravel()).reshape(step.shape)),
            )
            if reach_of(orbit, fine.stations, films) >= WALL:
                return math.inf, "the error is larger than the gap"
            if self.has_films and len(sizes) == 1:
                lack = shaft_defect(fine, films, orbit)
        doubt = ""
        if len(sizes) > 1 and sizes[1] > DISAGREEMENT * sizes[0] and sizes[0] > ROUNDOFF * orbit.size:
            part = sizes[1] / sizes[0]
            doubt = f"what two defects say of the error differs by {part:.0%}: not linear"
        return self.place.change(value, self.place.value(fine, orbit)), doubt

    @property
    def has_films(self) -> bool:
        """Whether some bearing is nonlinear."""
        return bool(self.films.journals)

    def _bound(self, turn: ShaftTurn) -> float:
        """Return the error that the worst K and C within the verified bounds would make at most.

        At the farthest point of the orbit the bounds are the widest.
        """
        reach = reach_of(turn.orbit, turn.answers.stations, self._reactions)
        moved = np.abs(wave_of(turn.orbit.position))
        rate, worst = abs(turn.answers.speed), np.zeros(len(moved))
        for name, film in self.films.journals.items():
            k = turn.answers.stations.index(name)
            pair, found = slice(2 * k, 2 * k + 2), turn.at.coefficients[name]
            slope = np.abs(found.stiffness).max() + rate * np.abs(found.damping).max()
            worst[pair] = film.bound(reach, slopes=True) * slope * moved[pair].sum()
        if not worst.any():
            return 0.0
        return self.place.largest_change(turn.answers, turn.orbit, worst)

    def expected(self, done: Work) -> Work:
        """Return five Newton steps."""
        return {self.unit: 5 if self.samples else 1}


def shaft_orbit_ladder(scene: Scene, quantity: str) -> Ladder:
    """Return the ladder of a quantity of the orbit of a flexible rotor: linear, then nonlinear.

    Raises
    ------
    InputError
        If the scene has no shaft, no speed or no unbalance, or a load besides the weight; if a phase is asked
        for without a place.
    """
    place, shaft = orbit_place(scene, quantity), scene.shaft
    assert shaft is not None  # checked by the above
    rotor = shaft.build(speed=scene.speed, extra=_extra(scene))
    models, levels, bearings = shaft_models(rotor), film_levels(shaft), shaft.build_bearings()
    rungs = tuple(
        ShaftOrbitRung(model=model, films=films, place=place, speed=scene.speed, samples=samples)
        for films in levels
        for model, samples in _choices(models, nonlinear=bool(films.journals))
    )
    return Ladder(
        rungs=rungs,
        unit=UNITS[quantity],
        remarks=(
            *shaft_remarks(rotor, bearings, scene.lubricant, scene.speed),
            *stability_remark(rotor, levels[0].reaction, scene.speed),
        ),
        within=shaft_physics(bearings),
    )


def _choices(models: tuple[ShaftModel, ...], *, nonlinear: bool) -> list[tuple[ShaftModel, int]]:
    """Return models of the shaft with samples over a turn, the cheapest first."""
    reduced = [model for model in models if model.modes]
    meshes = [model for model in models if model.modes is None and model.beam == model.shaft.beam]
    linear = [(model, 0) for model in (*reduced, *(meshes[:1] if nonlinear else meshes))]
    if not nonlinear:
        return linear
    kinds = {"reduced": reduced[-1:] or meshes[:1], "mesh": meshes[:1], "split": meshes[1:2]}
    return [*linear, *((model, samples) for kind, samples in NONLINEAR for model in kinds[kind])]


def orbit_place(scene: Scene, quantity: str) -> OrbitPlace:
    """Return what a scene asks about the orbit of its shaft.

    Raises
    ------
    InputError
        As `shaft_orbit_ladder` says.
    """
    if scene.shaft is None:
        raise InputError(f"shaft is required for {quantity} of a flexible rotor, got no such table")
    if scene.speed == 0.0:
        raise InputError("operation.speed must not be zero for an orbit, got 0.0")
    if scene.operation is not None and scene.operation.load is not None:
        load = scene.operation.load
        raise InputError(f"operation.load must be left out for a [shaft], which has its weight, got {load!r}")
    unbalances = (*scene.shaft.unbalances, *_extra(scene))
    if not any(one.unbalance > 0.0 for one in unbalances):
        raise InputError("shaft.unbalances must have a positive one for an orbit, got none")
    known = scene.shaft.places(forces=quantity == FORCE)
    at = scene.question.at if scene.question is not None else ""
    if quantity == PHASE and not at and len(known) > 1:
        raise InputError(f"question.at is required for {quantity}: one of {', '.join(known)}, got nothing")
    places = (at,) if at else known
    probes = {probe.name for probe in scene.shaft.probes}
    return OrbitPlace(
        quantity=quantity,
        places=places,
        probes=tuple(name for name in places if name in probes),
        reference=unbalances[0].unbalance_angle,
    )


def _extra(scene: Scene) -> tuple[UnbalanceTable, ...]:
    if scene.excitation is None:
        return ()
    if type(scene.excitation) is not UnbalanceTable:
        raise InputError(f"excitation.kind must be 'unbalance' for an orbit, got {scene.excitation!r}")
    return (scene.excitation,)
