"""Questions about the orbit of a flexible rotor under its unbalance: amplitude, phase, force on a bearing."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass, replace
from functools import cache, cached_property, partial
from typing import TYPE_CHECKING, Any

import numpy as np

from ..analysis import RotorEquilibrium, rotor_equilibrium, simulate_rotor
from ..analysis.driven_rotor import (
    RotorAnswers,
    distance,
    orbit_amplitude_ratio,
    rest_position,
    rotor_answers,
)
from ..analysis.harmonic_balance import driven, first_wave, newton_step, resized, rms
from ..core.answers import DISAGREEMENT, SAFETY, ErrorEstimate, Ladder, Rung, RungResult, Work, WorkUnit
from ..core.errors import ContactError, InputError
from ..core.model import Array
from ..core.port import Reaction
from ..core.results import Coefficients, Trajectory
from ..rotors import BaseExcitedRotor, BaseMotion, FlexibleRotor, ReducedRotor, ShaftRotor, mount
from ..rotors.shaft_rotor import ShaftModel, shaft_models
from ..scenes.export_scene import at_rest
from ..scenes.rotor_runs import after_loss, largest_distance, run_span, run_times
from ..scenes.shared_tables import GroundTable, RunUpTable, UnbalanceTable, require_kind
from ..scenes.solve_shaft import shaft_physics, shaft_remarks, stability_remark
from . import shaft_films
from .film_motions import WALL, OrbitPlace, SolvedTurn
from .quantities import FORCE, ORBIT_UNITS, PHASE
from .turbulent_oil import turbulent_run
from .variants import FunctionRung

if TYPE_CHECKING:
    from ..scenes.scene import Scene

LINEAR = 15
"""Samples over a turn at which a linear orbit's defect is taken, and a little more than twice as many."""

NONLINEAR = (("reduced", 15), ("mesh", 15), ("mesh", 31), ("mesh", 63), ("split", 63), ("split", 127))
"""Models of the shaft and samples over a turn of the nonlinear rungs."""

ROUNDOFF = 1e-12
"""Size of a step / size of the orbit that is no error any more."""


@dataclass(frozen=True, kw_only=True)
class ShaftOrbitRung(shaft_films.ShaftRung):
    """The orbit by one model of the shaft and one film for each journal, linear or nonlinear.

    Attributes
    ----------
    place : OrbitPlace
        Place where the orbit is asked about, and which of its quantities.
    speed : float [rad/s]
    samples : int
        Samples over a turn; 0 for the linear orbit.
    """

    place: OrbitPlace
    speed: float
    samples: int

    @property
    def how(self) -> str:
        """Linear, or the number of samples."""
        return f"{self.samples} samples" if self.samples else "linear"

    @property
    def refines(self) -> tuple[object, ...]:
        """Model of the shaft and films, where there are samples."""
        return (self.model, self.films) if self.samples else ()

    @property
    def unit(self) -> WorkUnit:
        """One turn."""
        return replace(super().unit, name=f"turns of {self.name}")

    @cached_property
    def _reactions(self) -> dict[str, Reaction]:
        return self.films.reaction

    def answer(self, before: RungResult | None) -> RungResult:
        """Return the quantity of the orbit; a nonlinear one starts from that of a lower rung."""
        made = self.films.prepare()
        at = rotor_equilibrium(self.model.rotor, self._reactions, self.speed)
        samples = self.samples or LINEAR
        answers = rotor_answers(self.model.rotor.structure, at, self.place.probes, samples)
        rest = rest_position(at, answers.stations)
        orbit, work = answers.linear_orbit(rest), 1
        if self.samples:
            start = orbit if before is None else resized(before.solution.orbit, answers.harmonics)
            found = driven(answers.on(self._reactions), start, rest)
            orbit, work = found.series, found.iterations + 1
        solved = SolvedTurn(at=at, answers=answers, orbit=orbit)
        return RungResult(self.place.value(answers, orbit), {self.unit: work, **made}, solved)

    def estimate(self, found: RungResult, before: RungResult | None, tolerance: float) -> ErrorEstimate:
        """Return the change that elements half as long, the richer films and twice the samples would make.

        It is the defect of the orbit in them, propagated by the slopes of the richer films; a second defect
        there takes out what is of second order, and tells whether the first step was linear. The map is its
        own richer film, and where its verified bound is too large the forces of a grid are compared.
        """
        turn: SolvedTurn = found.solution
        if orbit_amplitude_ratio(turn.orbit, turn.answers.stations, self._reactions) >= WALL:
            return ErrorEstimate(math.inf, "defect", doubt="the orbit leaves the clearance: not linear")
        value, fine = float(found.value), self.model.finer.structure
        bound = self._bound(turn)
        trusted = SAFETY * bound < tolerance
        films = self._reactions if trusted or self.films.bounded else self.films.rich
        samples = 2 * turn.answers.samples + 1 if self.has_films else LINEAR
        answers = rotor_answers(fine, turn.at, self.place.probes, samples)
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

    def rest(self, found: RungResult) -> RotorEquilibrium:
        """Return the rotor at rest."""
        return found.solution.at

    def on(self, found: RungResult, coefficients: dict[str, Coefficients]) -> float:
        """Return the quantity of the linear orbit on these K and C."""
        at = self.rest(found)
        structure = self.model.rotor.structure
        answers = rotor_answers(structure, replace(at, coefficients=coefficients), self.place.probes, LINEAR)
        return self.place.value(answers, answers.linear_orbit(rest_position(at, answers.stations)))

    def distance(self, value: float, better: float) -> float:
        """Return how far a value is from a better one."""
        return self.place.change(value, better)

    def _by_grid(self, turn: SolvedTurn, value: float) -> float:
        """Return the change that the forces of the richer films make, propagated by the slopes of the map."""
        answers = rotor_answers(self.model.rotor.structure, turn.at, self.place.probes, LINEAR)
        orbit = resized(turn.orbit, answers.harmonics)
        change = distance(answers.on(self._reactions), self.films.rich, orbit)
        return self.place.change(value, self.place.value(answers, orbit + change))

    def _by_defect(
        self, fine: RotorAnswers, turn: SolvedTurn, films: dict[str, Reaction], value: float
    ) -> tuple[float, str]:
        balance, orbit = fine.on(films), resized(turn.orbit, fine.harmonics)
        step = newton_step(balance, orbit)
        orbit, size, doubt = orbit + step, rms(step), ""
        if orbit_amplitude_ratio(orbit, fine.stations, films) >= WALL:
            return math.inf, "the error is larger than the gap"
        if self.has_films:
            step = newton_step(balance, orbit)
            orbit, again = orbit + step, rms(step)
            if orbit_amplitude_ratio(orbit, fine.stations, films) >= WALL:
                return math.inf, "the error is larger than the gap"
            if again > DISAGREEMENT * size and size > ROUNDOFF * rms(orbit):
                doubt = f"what two defects say of the error differs by {again / size:.0%}: not linear"
        return self.place.change(value, self.place.value(fine, orbit)), doubt

    @property
    def has_films(self) -> bool:
        """Whether some bearing is nonlinear."""
        return bool(self.films.journals)

    def _bound(self, turn: SolvedTurn) -> float:
        """Return the error that the worst K and C within the verified bounds would make at most.

        At the farthest point of the orbit the bounds are the widest.
        """
        amplitude_ratio = orbit_amplitude_ratio(turn.orbit, turn.answers.stations, self._reactions)
        moved = np.abs(first_wave(turn.orbit))
        rate, worst = abs(turn.answers.speed), np.zeros(len(moved))
        for name, film in self.films.journals.items():
            k = turn.answers.stations.index(name)
            pair, found = slice(2 * k, 2 * k + 2), turn.at.coefficients[name]
            slope = np.abs(found.stiffness).max() + rate * np.abs(found.damping).max()
            worst[pair] = film.bound(amplitude_ratio, slopes=True) * slope * moved[pair].sum()
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
    shaft.require_lateral(quantity)
    shaft.require_aligned(quantity)
    rotor, levels = shaft.build(speed=scene.speed, extra=_extra(scene)), shaft_films.film_levels(shaft)
    models, films = shaft_models(rotor), levels[0]
    choices = _choices(models, nonlinear=bool(films.journals))
    # In vibration films keep the temperatures of the rest.
    rest = rotor_equilibrium(models[0].rotor, films.reaction, scene.speed) if films.on_oil else None

    def rung_on(films: shaft_films.ShaftFilms, model: ShaftModel, samples: int) -> ShaftOrbitRung:
        return ShaftOrbitRung(model=model, films=films, place=place, speed=scene.speed, samples=samples)

    def rungs_on(at: Callable[[shaft_films.ShaftFilms], shaft_films.ShaftFilms]) -> list[ShaftOrbitRung]:
        return [rung_on(one, *choice) for one in map(at, levels) for choice in choices]

    def heated() -> tuple[list[ShaftOrbitRung], Iterator[Rung]]:
        assert rest is not None  # on an oil
        return rungs_on(shaft_films.at_supply), shaft_films.field_orbits(films, rest, rung_on, choices)

    rungs = rungs_on(lambda one: one if rest is None else shaft_films.at_temperatures(one, rest.temperatures))
    ladder = shaft_films.shaft_ladder_on(scene, rotor, scene.speed, ORBIT_UNITS[quantity], rungs, heated)
    unstable = stability_remark(rotor, rungs[0].films.reaction, scene.speed)
    return replace(ladder, remarks=(*ladder.remarks, *unstable))


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
    shaft = scene.required("shaft", f"{quantity} of a flexible rotor")
    if scene.speed == 0.0:
        raise InputError("operation.speed must not be zero for an orbit, got 0.0")
    if scene.operation is not None and scene.operation.load is not None:
        load = scene.operation.load
        raise InputError(f"operation.load must be left out for a [shaft], which has its weight, got {load!r}")
    unbalances = (*shaft.unbalances, *_extra(scene))
    if not any(one.unbalance > 0.0 for one in unbalances):
        raise InputError("shaft.unbalances must have a positive one for an orbit, got none")
    known = shaft.places(forces=quantity == FORCE)
    at = scene.question.at if scene.question is not None else ""
    if quantity == PHASE and not at and len(known) > 1:
        raise InputError(f"question.at is required for {quantity}: one of {', '.join(known)}, got nothing")
    places = (at,) if at else known
    probes = {probe.name for probe in shaft.probes}
    return OrbitPlace(
        quantity=quantity,
        places=places,
        probes=tuple(name for name in places if name in probes),
        reference=unbalances[0].unbalance_angle,
    )


def _extra(scene: Scene) -> tuple[UnbalanceTable, ...]:
    if scene.excitation is None:
        return ()
    require_kind(scene.excitation, ("unbalance",))
    assert isinstance(scene.excitation, UnbalanceTable)
    return (scene.excitation,)


# How far a flexible rotor goes in a run: a run-up, a lost blade, ground that shakes.


PEAK = "peak_displacement"

RTOL, FINE_RTOL = 1e-6, 1e-8
"""Local error of the steps of an answer, and of the run that it is judged by."""

MODES = 18
"""Modes in each plane of what answers are judged by: three times those of the widest reduced model."""

STATES = 12
"""States of a run at which a richer grid is asked for its force."""

SMALL_CHANGE = 0.05
"""Relative change of all forces up to which the peak moves in proportion to it."""

LEAST_CHANGE = 1e-4
"""Change of the viscosity, at least, by which the error of a map is told."""


@dataclass(frozen=True, kw_only=True)
class ShaftExcitation:
    """What shakes a shaft, for how long, and where it is asked about.

    Attributes
    ----------
    places : tuple of str
        Bearings and probes among which the largest displacement counts.
    speed : float [rad/s]
        Speed at rest, where the run begins.
    times : ndarray, shape (n,) [s]
        Times of the samples.
    base : BaseMotion or None
        Of the ground.
    """

    places: tuple[str, ...]
    speed: float
    times: Array
    base: BaseMotion | None

    def run(self, rotor: FlexibleRotor, bearings: Mapping[str, Reaction], rtol: float) -> Trajectory:
        """Return the motion of a rotor from its rest on."""
        started: Any = at_rest(rotor, bearings, self.speed)[0]
        if self.base is not None:
            started = BaseExcitedRotor(rotor=started, base=self.base)
        end = float(self.times[-1])
        return simulate_rotor(mount(started, bearings), duration=end, times=self.times, rtol=rtol)

    def peak(self, run: Trajectory) -> float:
        """Return the largest displacement of the places in a motion [m]."""
        return max(largest_distance(run.time, run[f"{name}_x"], run[f"{name}_y"]) for name in self.places)


def peak_rung(
    model: ShaftModel,
    films: shaft_films.ShaftFilms,
    peak: Callable[[float], float],
    best: shaft_films.ShaftFilms,
    shaken: ShaftExcitation,
) -> FunctionRung:
    """Return the largest displacement [m] by one model of the shaft and one film for each journal.

    Its error is the distance to the run in elements half as long, on richer films, in finer steps. Of those
    elements the lowest modes are taken, three times as many as a reduced model has. The `best` films are
    those by which it is judged, unless they are these. A map with a verified bound is its own richer film: by
    how much its bound may move the peak is told by a run in so much more viscous oil. Runs of turbulent
    films on a richer grid would take a hundred times as long. These are judged by the force of that grid at a
    few states of the run, and by what such a change of all forces does to the peak.
    """
    name = shaft_films.ShaftRung(model=model, films=films).name
    unit = WorkUnit(f"runs of {name}", ("runs", id(model), id(films)))

    def answer(before: RungResult | None) -> RungResult:
        made = films.prepare()
        return RungResult(peak(0.0), {unit: 1, **made})

    def estimate(found: RungResult, before: RungResult | None, tolerance: float) -> ErrorEstimate:
        method = f"run in {len(model.finer.elements)} elements"
        work = {WorkUnit(f"runs to check {name}"): 1}
        turbulent = any(film.reaction.turbulence is not None for film in films.journals.values())
        rich = best.reaction if best.bounded else films.reaction if turbulent else films.rich
        try:
            fine = shaken.run(_lowest(model.finer), rich, RTOL if turbulent else FINE_RTOL)
        except ContactError:
            return ErrorEstimate(math.inf, method, work, doubt="a journal touches in the run that checks it")
        better = shaken.peak(fine)
        error = abs(better - found.value) / better
        if turbulent:
            more = _moved(peak, _richer_share(films, fine))
            return ErrorEstimate(error + more, f"{method}, and with the force of {films.rich_name}", work)
        if not best.journals or not best.bounded:
            return ErrorEstimate(error, method, work)
        bound = _largest_bound(best, fine)
        if not math.isfinite(bound):
            doubt = "the journals go beyond where the map has a verified bound"
            return ErrorEstimate(math.inf, method, work, doubt=doubt)
        share = max(bound, LEAST_CHANGE)
        more = abs(peak(share) - found.value) / found.value * bound / share
        return ErrorEstimate(error + more, f"{method}, and with the bound of the map", work)

    return FunctionRung(name=name, answer=answer, estimate=estimate, expected=lambda _: {unit: 1})


def _largest_bound(films: shaft_films.ShaftFilms, run: Trajectory) -> float:
    """Return the largest verified error of films over a motion [1]."""
    bounds = []
    for name, film in films.journals.items():
        amplitude_ratio = float(np.hypot(run[f"{name}_x"], run[f"{name}_y"]).max()) / film.reaction.clearance
        bounds.append(film.bound(amplitude_ratio, slopes=True))
    return max(bounds)


def _peak_by(
    model: ShaftModel, films: shaft_films.ShaftFilms, shaken: ShaftExcitation
) -> Callable[[float], float]:
    """Return the peak with the forces of all films larger by a share, each run once."""

    @cache
    def peak(share: float) -> float:
        bearings = _thicker(films, 1.0 + share) if share else films.reaction
        return shaken.peak(shaken.run(model.rotor, bearings, RTOL))

    return peak


def _moved(peak: Callable[[float], float], share: float) -> float:
    """Return the relative change of a peak by such a change of all forces."""
    run = share if abs(share) > SMALL_CHANGE else SMALL_CHANGE
    return abs((peak(run) / peak(0.0) - 1.0) * share / run)


def _richer_share(films: shaft_films.ShaftFilms, run: Trajectory) -> float:
    """Return the largest change of force by richer films over its largest size, at a few states of a run."""
    few = np.linspace(0, len(run.time) - 1, STATES).astype(int)
    shares = []
    for name, film in films.journals.items():
        q, v = (
            np.stack([run[f"{name}_{axis}"][few] for axis in axes]) for axes in (("x", "y"), ("vx", "vy"))
        )
        own, rich = (of.force(q, v, run["speed"][few]) for of in (film.reaction, film.rich))
        shares.append(np.hypot(*(rich - own)).max() / np.hypot(*rich).max())
    return float(max(shares))


def _lowest(rotor: ShaftRotor) -> FlexibleRotor:
    """Return a rotor in its lowest modes between the bearings; whole where they do not hold it."""
    most = len(rotor.structure.coordinates) - len(rotor.stations) - len(rotor.structure.supports)
    few = ReducedRotor(rotor=rotor, modes=min(MODES, most), speed=rotor.speed, gravity=rotor.gravity)
    try:
        _ = few.structure
    except InputError:
        return rotor
    return few


def _thicker(films: shaft_films.ShaftFilms, share: float) -> dict[str, Reaction]:
    """Return the bearings with so many times the viscosity of their oil, at the same Reynolds number."""
    thick = dict(films.springs)
    for name, film in films.journals.items():
        bearing, effect = film.reaction, film.reaction.turbulence
        assert bearing.viscosity is not None  # films on an oil are refused
        if effect is not None:
            effect = replace(effect, density=share * (effect.density or bearing.film_density))
        thick[name] = replace(bearing, viscosity=share * bearing.viscosity, turbulence=effect)
    return thick


def shaft_peak_ladder(scene: Scene, quantity: str) -> Ladder:
    """Return the ladder of the largest displacement of a flexible rotor in a run.

    Raises
    ------
    InputError
        If the scene has no shaft, an excitation that is no run, or films on an oil.
    """
    given = scene.required("shaft", quantity)
    given.require_lateral(quantity)
    given.require_aligned(quantity)
    require_kind(scene.excitation, ("unbalance", "blade_loss", "run_up", "ground"))
    scene = after_loss(scene)
    excitation = scene.excitation
    rotor = scene.shaft.build(scene.speed, (excitation,) if isinstance(excitation, UnbalanceTable) else ())
    if isinstance(excitation, RunUpTable):
        rotor = replace(rotor, speed=excitation.profile(scene.speed))
    levels, bearings = shaft_films.film_levels(given), given.build_bearings()
    if levels[0].on_oil:
        raise InputError(
            f"journal of a bearing must have a viscosity for {quantity}, got an oil, {levels[0].on_oil}"
        )
    duration, fastest = run_span(scene)
    at = scene.question.at if scene.question is not None else ""
    shaken = ShaftExcitation(
        places=(at,) if at else scene.shaft.places(forces=False),
        speed=scene.speed,
        times=run_times(duration, fastest),
        base=excitation.motion(duration) if isinstance(excitation, GroundTable) else None,
    )
    models = [
        model
        for model in shaft_models(rotor)  # reduced, and meshes of the element of the file
        if model.modes or (model.modes is None and model.beam == rotor.beam)
    ]
    parts = [(model, films, _peak_by(model, films, shaken)) for films in levels for model in models]
    ladder = Ladder(
        rungs=tuple(peak_rung(*part, levels[-1], shaken) for part in parts),
        unit="m",
        remarks=shaft_remarks(rotor, bearings, scene.lubricant.properties, fastest),
        within=shaft_physics(bearings),
    )
    journals = {name: film.reaction for name, film in levels[0].journals.items()}
    return turbulent_run(scene, journals, ladder, partial(_moved, parts[0][2]))
