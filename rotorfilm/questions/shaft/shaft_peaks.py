"""How far a flexible rotor goes in a run: a run-up, a lost blade, ground that shakes."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from ...answers import ErrorEstimate, Found, WorkUnit
from ...bearings.seal import AnnularSeal
from ...errors import ContactError, InputError
from ...ladders import BaseRung, Ladder
from ...linear import rotor_equilibrium
from ...model import Array, Reaction
from ...motion import simulate_rotor
from ...results import Trajectory
from ...rotors import BaseMotion, FlexibleRotor, ReducedRotor, ShaftRotor, ShakenBaseRotor, mount
from ...rotors.shaft.shaft_models import ShaftModel, shaft_models
from ...scenes.excitation_table import (
    BladeLossTable,
    GroundTable,
    RunUpTable,
    UnbalanceTable,
    require_kind,
)
from ...scenes.shaft.rotor_runs import largest_distance, run_span, run_times
from ...scenes.shaft.shaft_remarks import shaft_physics, shaft_remarks
from .shaft_films import ShaftFilms, film_levels

if TYPE_CHECKING:
    from ...scenes.scene import Scene

PEAK = "peak_displacement"

RTOL, FINE_RTOL = 1e-6, 1e-8
"""Local error of the steps of an answer, and of the run that it is judged by."""

MODES = 18
"""Modes in each plane of what answers are judged by: three times those of the widest reduced model."""

LEAST_CHANGE = 1e-4
"""Change of the viscosity, at least, by which the error of a map is told."""


class ShakenShaft(NamedTuple):
    """What shakes a shaft, for how long, and where it is asked about.

    Attributes
    ----------
    places : tuple of str
        Bearings and probes among which the largest displacement counts.
    speed : float [rad/s]
        At rest, where the run begins.
    times : ndarray, shape (n,) [s]
        Of the samples.
    base : BaseMotion or None
        Of the ground.
    """

    places: tuple[str, ...]
    speed: float
    times: Array
    base: BaseMotion | None

    def run(self, rotor: FlexibleRotor, bearings: Mapping[str, Reaction], rtol: float) -> Trajectory:
        """Return the motion of a rotor from its rest on."""
        still = rotor_equilibrium(rotor, bearings, self.speed).displacement
        started: Any = replace(rotor, initial=(*still, *0.0 * still))  # type: ignore[type-var]
        if self.base is not None:
            started = ShakenBaseRotor(rotor=started, base=self.base)
        end = float(self.times[-1])
        return simulate_rotor(mount(started, bearings), duration=end, times=self.times, rtol=rtol)

    def peak(self, run: Trajectory) -> float:
        """Return the largest displacement of the places in a motion [m]."""
        return max(largest_distance(run.time, run[f"{name}_x"], run[f"{name}_y"]) for name in self.places)


@dataclass(frozen=True, kw_only=True)
class ShaftPeakRung(BaseRung):
    """The largest displacement by one model of the shaft and one film for each journal.

    Attributes
    ----------
    model : ShaftModel
    films : ShaftFilms
    best : ShaftFilms
        Those by which it is judged, unless they are these.
    shaken : ShakenShaft
    """

    model: ShaftModel
    films: ShaftFilms
    best: ShaftFilms
    shaken: ShakenShaft

    @property
    def name(self) -> str:
        """Model of the shaft, and film."""
        return ", ".join(part for part in (self.model.name, self.films.name) if part)

    @property
    def unit(self) -> WorkUnit:
        """One run."""
        return WorkUnit(f"runs of {self.name}", ("runs", id(self.model), id(self.films)))

    def answer(self, before: Found | None) -> Found:
        """Return the largest displacement [m]."""
        made = self.films.prepare()
        run = self.shaken.run(self.model.rotor, self.films.reaction, RTOL)
        return Found(self.shaken.peak(run), {self.unit: 1, **made}, run)

    def estimate(self, found: Found, before: Found | None, tolerance: float) -> ErrorEstimate:
        """Return the distance to the run in elements half as long, on richer films, in finer steps.

        Of those elements the lowest modes are taken, three times as many as a reduced model has. A map with a
        verified bound is its own richer film: by how much its bound may move the peak is told by a run in so
        much more viscous oil.
        """
        method = f"run in {len(self.model.finer.elements)} elements"
        work = {WorkUnit(f"runs to judge {self.name}"): 1}
        rich = self.best.reaction if self.best.bounded else self.films.rich
        try:
            fine = self.shaken.run(_lowest(self.model.finer), rich, FINE_RTOL)
        except ContactError:
            return ErrorEstimate(math.inf, method, work, doubt="a journal touches in the run that judges it")
        better = self.shaken.peak(fine)
        error = abs(better - found.value) / better
        if not self.best.journals or not self.best.bounded:
            return ErrorEstimate(error, method, work)
        bound = self._bound(fine)
        if not math.isfinite(bound):
            doubt = "the journals go beyond where the map has a verified bound"
            return ErrorEstimate(math.inf, method, work, doubt=doubt)
        share = max(bound, LEAST_CHANGE)
        thick = self.shaken.run(self.model.rotor, _thicker(self.films, 1.0 + share), RTOL)
        moved = abs(self.shaken.peak(thick) - found.value) / found.value * bound / share
        return ErrorEstimate(error + moved, f"{method}, and with the bound of the map", work)

    def _bound(self, run: Trajectory) -> float:
        """Return the largest verified error of the best films over a motion [1]."""
        bounds = []
        for name, film in self.best.journals.items():
            reach = float(np.hypot(run[f"{name}_x"], run[f"{name}_y"]).max()) / film.reaction.clearance
            bounds.append(film.bound(reach, slopes=True))
        return max(bounds)


def _lowest(rotor: ShaftRotor) -> FlexibleRotor:
    """Return a rotor in its lowest modes between the bearings; whole where they do not hold it."""
    most = len(rotor.structure.coordinates) - len(rotor.stations) - len(rotor.structure.supports)
    few = ReducedRotor(rotor=rotor, modes=min(MODES, most), speed=rotor.speed, gravity=rotor.gravity)
    try:
        _ = few.structure
    except InputError:
        return rotor
    return few


def _thicker(films: ShaftFilms, share: float) -> dict[str, Reaction]:
    """Return the bearings with so many times the viscosity of their oil."""
    thick = dict(films.springs)
    for name, film in films.journals.items():
        viscosity = film.reaction.viscosity
        assert viscosity is not None  # films on an oil are refused
        thick[name] = replace(film.reaction, viscosity=share * viscosity)
    return thick


def shaft_peak_ladder(scene: Scene, quantity: str) -> Ladder:
    """Return the ladder of the largest displacement of a flexible rotor in a run.

    Raises
    ------
    InputError
        If the scene has no shaft, an excitation that is no run, or films on an oil.
    """
    if scene.shaft is None:
        raise InputError(f"shaft is required for {quantity}, got no such table")
    require_kind(scene.excitation, ("unbalance", "blade_loss", "run_up", "ground"))
    given, scene = scene.shaft, _with_loss(scene)
    rotor, levels = _rotor(scene), tuple(map(_massless, film_levels(given)))
    if levels[0].on_oil:
        raise InputError(
            f"journal of a bearing must have a viscosity for {quantity}, got an oil in {levels[0].on_oil}"
        )
    duration, fastest = run_span(scene)
    shaken = ShakenShaft(
        places=_places(scene),
        speed=scene.speed,
        times=run_times(duration, fastest),
        base=scene.excitation.motion(duration) if isinstance(scene.excitation, GroundTable) else None,
    )
    seals = [name for name, one in given.build_bearings().items() if isinstance(one, AnnularSeal)]
    bearings = given.build_bearings()
    return Ladder(
        rungs=tuple(
            ShaftPeakRung(model=model, films=films, best=levels[-1], shaken=shaken)
            for films in levels
            for model in _models(rotor)
        ),
        unit="m",
        remarks=(
            *shaft_remarks(rotor, bearings, scene.lubricant.properties, fastest),
            *(f"{name}: the added mass of the seal, in runs over time" for name in seals),
        ),
        within=shaft_physics(bearings),
    )


def _with_loss(scene: Scene) -> Scene:
    """Return a scene that loses a blade as one whose rotor rests, and has its unbalance from then on."""
    lost = scene.excitation
    if not isinstance(lost, BladeLossTable):
        return scene
    if scene.speed == 0.0:
        raise InputError("operation.speed must not be zero for a lost blade, got 0.0")
    assert scene.shaft is not None
    assert scene.operation is not None
    if any(one.unbalance > 0.0 for one in scene.shaft.unbalances):
        raise InputError("shaft.unbalances must be none where a blade is lost at rest, got some")
    sudden = UnbalanceTable(
        unbalance=lost.unbalance,
        unbalance_angle=lost.unbalance_angle + scene.speed * lost.start,
        node=lost.node,
    )
    duration = 2.0 * math.pi * lost.revolutions / abs(scene.speed)
    return replace(scene, excitation=sudden, operation=replace(scene.operation, duration=duration))


def _rotor(scene: Scene) -> ShaftRotor:
    """Return the shaft of a scene at its speed, with the unbalance of its excitation."""
    assert scene.shaft is not None
    excitation = scene.excitation
    extra = (excitation,) if isinstance(excitation, UnbalanceTable) else ()
    rotor = scene.shaft.build(scene.speed, extra)
    return (
        replace(rotor, speed=excitation.profile(scene.speed)) if isinstance(excitation, RunUpTable) else rotor
    )


def _places(scene: Scene) -> tuple[str, ...]:
    """Return the bearings and probes among which the largest displacement is asked for."""
    assert scene.shaft is not None
    assert scene.question is not None
    return (scene.question.at,) if scene.question.at else scene.shaft.places(forces=False)


def _models(rotor: ShaftRotor) -> Sequence[ShaftModel]:
    """Return reduced models with modes, and meshes of the element of the file."""
    return [
        model
        for model in shaft_models(rotor)
        if model.modes or (model.modes is None and model.beam == rotor.beam)
    ]


def _massless(films: ShaftFilms) -> ShaftFilms:
    """Return bearings that the compiled integration takes: seals without their added mass."""
    springs = {
        name: replace(one, added_mass=False) if isinstance(one, AnnularSeal) else one
        for name, one in films.springs.items()
    }
    return replace(films, springs=springs)
