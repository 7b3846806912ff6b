"""The effect of turbulence on a question about a bearing with a film.

Levels are the laminar film, one Reynolds number for the whole film, a fit with the local Reynolds number, the
quadrature of the eddy viscosity that it fits, and the eddy viscosity of the full stress. What a level leaves
out is the step that the richer one makes at the place found: by its force and slopes there, without an
equilibrium of its own. That of one Reynolds number is a film of `scenes.film_rungs`. The band of
transition, behind which no measurement stands, is no part of the error: what it changes is said beside the
answer.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import replace
from functools import cache
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from ..analysis import coefficients, equilibrium
from ..bearings.films.turbulence import Turbulence
from ..bearings.journal import full_stress_forces
from ..core.answers import ErrorEstimate, Ladder, LeftOutRemark, Rung, RungResult
from ..core.errors import RotorfilmError
from ..core.results import Coefficients
from ..scenes.film_rungs import ONE_NUMBER, FilmCandidate
from ..scenes.oil_film_tables import (
    QUADRATURE,
    is_left_laminar,
    other_band,
    quick,
    quiet,
    turbulence_of,
    warmed,
)
from ..scenes.turbulent_shaft import JournalStation, highest_speed, left_laminar
from .conserved_oil import rest_on
from .variants import FunctionRung, with_estimate

if TYPE_CHECKING:
    from ..scenes.scene import Scene

WHOLE_STEP = 1.35
"""The way from a laminar place to the turbulent one over the first step, 70 % of it."""

NEAR_COARSE = 0.01
"""Change of a speed at which its search on turbulent films ends: coarse grids jump from cell to cell."""

BEYOND = "a laminar film above the onset of turbulence meets no tolerance"

TRANSITION = "what the band of transition changes"


def turbulent_oil(scene: Scene, question: Any, films: Sequence[FilmCandidate], ladder: Ladder) -> Ladder:
    """Return a ladder whose estimates count the turbulence that its films leave out.

    The error of a laminar film above the onset is what a turbulent one changes. That of a closure is what the
    quadrature and the full stress change, the latter not known of tilting pads.
    """
    bearing = films[-1].reaction
    effect = getattr(bearing, "turbulence", None)
    place = at_temperature(question, bearing)
    if effect is None:
        if not is_left_laminar(scene.film_table, scene):
            return ladder
        own = turbulence_of(bearing, scene)

        def step() -> ErrorEstimate:
            about = step_to(question, films[-1], place(), own)
            return about._replace(error=WHOLE_STEP * about.error, doubt=BEYOND)

        return _counted(ladder, cache(step), "turbulence")
    about = quiet(lambda: step_to(question, films[-1], place(), other_band(effect)))
    ladder = _said(ladder, [effect], None if about is None else about.error)

    def closer() -> ErrorEstimate:
        richer = replace(effect, closure=QUADRATURE, local=True)
        about = step_to(question, films[-1], place(), richer) if richer != effect else None
        stress = by_stress(question, films[-1], place())
        return about._replace(error=about.error + stress) if about else ErrorEstimate(stress, "full stress")

    return _counted(ladder, cache(closer), "closure")


def at_temperature(question: Any, bearing: Any) -> Callable[[], Any]:
    """Return a call for the bearing of a question on a coarse grid, at the temperature of its balance."""

    @cache
    def place() -> Any:
        cheap = quick(bearing)
        return warmed(cheap, question.load, question.speed) if cheap.is_warming else cheap

    return place


def _counted(ladder: Ladder, step: Callable[[], ErrorEstimate], name: str) -> Ladder:
    """Return a ladder each of whose estimates has that of a step added, which is found once."""
    token = object()

    def counted(rung: Rung) -> FunctionRung:
        def estimate(found: RungResult, before: RungResult | None, tolerance: float) -> ErrorEstimate:
            about = rung.estimate(found, before, tolerance)
            try:
                more, doubt = step().error, step().doubt
            except RotorfilmError as error:
                return about._replace(doubt=f"its error by turbulence is not known: {error}")
            return about._replace(
                error=about.error + more,
                method=f"{about.method}; {name}, {more:.2g}",
                bound=about.bound and about.error > more,
                doubt=about.doubt or doubt,
                shared=math.inf if doubt == BEYOND else about.shared + more,
                better=None,
            )

        made, film = with_estimate(rung, estimate, token), getattr(rung, "film", None)
        # Where no film meets the tolerance, the answer is still that of a better film.
        return replace(made, shares=None) if getattr(film, "name", "") == ONE_NUMBER else made

    return replace(ladder, rungs=tuple(counted(rung) for rung in ladder.rungs))


ROUND_OFF = 1e-6
"""Relative change of an answer that is not worth a remark."""


def step_to(question: Any, film: FilmCandidate, bearing: Any, richer: Turbulence) -> ErrorEstimate:
    """Return what a film of another turbulence changes in an answer, by its force and slopes at its place."""
    rich = replace(bearing, turbulence=richer)
    candidate = replace(film, reaction=bearing, rich=rich, rich_name="another turbulence", bounded=False)
    rung = question.make(replace(candidate, making=0.0), question.counts[0])
    found = rung.answer(None)
    return rung.estimate(found, None, 0.0)


def by_stress(question: Any, film: FilmCandidate, bearing: Any) -> float:
    """Return what the full stress changes in an answer: its force at the place found as another load."""
    if hasattr(bearing, "on_frozen"):
        return 0.0
    judge = question.judge_on(replace(film, reaction=bearing, making=0.0))
    own = rest_on(bearing, judge.load, judge.speed)
    linear, full = full_stress_forces(bearing, own.at.position, judge.speed)
    x, y = (np.asarray(judge.load) + full - linear).tolist()
    return float(judge.apart(own, rest_on(bearing, (x, y), judge.speed)))


def _said(ladder: Ladder, effects: Sequence[Turbulence], change: float | None) -> Ladder:
    """Return a ladder that names its closures, and what a band of transition, or the want of one, changes."""
    closures = " and ".join(dict.fromkeys(effect.closure for effect in effects))
    within = f"{ladder.within.replace('laminar films', 'films')}, turbulent by {closures}"
    if change is None or change < ROUND_OFF:
        return replace(ladder, within=within)
    other = "without the band" if effects[0].band else "with a band"
    text = f"turbulence: {other} of transition, behind which no measurement stands, the answer is "
    text += f"{change:.2g} away"
    return replace(ladder, within=within, remarks=(LeftOutRemark(text, TRANSITION, change), *ladder.remarks))


# Flexible rotors: what turbulence changes in K and C of their journals.


class ShaftTurbulence(NamedTuple):
    """Turbulence of the journals of a shaft, by station.

    Attributes
    ----------
    own : mapping of str to Turbulence
        Of those that are turbulent.
    laminar : tuple of str
        Those that are laminar above their onset at the highest speed of the scene.
    richer : mapping of str to Turbulence
        The quadrature for all of them.
    """

    own: Mapping[str, Turbulence]
    laminar: tuple[str, ...]
    richer: Mapping[str, Turbulence]

    @classmethod
    def of(cls, scene: Scene, journals: Mapping[str, Any]) -> ShaftTurbulence:
        """Return that of some bearings of the shaft of a scene."""
        own = {name: one.turbulence for name, one in journals.items() if one.turbulence is not None}
        laminar = left_laminar(scene, highest_speed(scene))
        richer = {name: turbulence_of(journals[name], scene) for name in laminar}
        richer |= {name: replace(effect, closure=QUADRATURE, local=True) for name, effect in own.items()}
        return cls(own, laminar, richer)

    def counted(self, ladder: Ladder, step: Callable[[], ErrorEstimate], band: float | None) -> Ladder:
        """Return a ladder that counts a step to the richer films, and says what another band changes."""
        said = _said(ladder, tuple(self.own.values()), band) if self.own else ladder
        return _counted(said, cache(step), "turbulence" if self.laminar else "closure")


def turbulent_shaft(scene: Scene, rung: Any, ladder: Ladder) -> Ladder:
    """Return a ladder of a shaft whose estimates count the turbulence that its films leave out.

    It is the change of the answer of a `ShaftRung` on the K and C that the journals have at their own
    equilibria, under the loads and at the speed of that answer.
    """
    journals = {name: film.reaction for name, film in rung.films.journals.items()}
    films = ShaftTurbulence.of(scene, journals)
    if not films.richer:
        return ladder
    found = cache(lambda: rung.answer(None))

    def on(effects: Mapping[str, Turbulence | None], *, stress: bool) -> float:
        at, own = rung.rest(found()), {}
        for name, effect in effects.items():
            bearing = replace(journals[name], turbulence=effect)
            own[name] = slopes_of(bearing, at.loads[name], at.speed, stress=stress)
        return rung.on(found(), {**at.coefficients, **own})

    def change(effects: Mapping[str, Turbulence], *, stress: bool) -> float:
        base = on({name: journals[name].turbulence for name in effects}, stress=False)
        return rung.distance(base, on(effects, stress=stress))

    def again() -> float | None:
        # From laminar to turbulent a speed moves so far that K and C change with it.
        rich = {name: replace(quick(journals[name]), turbulence=one) for name, one in films.richer.items()}
        bearings, start = {**rung.films.reaction, **rich}, found().value
        return quiet(lambda: rung.distance(start, rung.again(found(), bearings, start, NEAR_COARSE)))

    def step() -> ErrorEstimate:
        beyond = films.laminar and left_laminar(scene, rung.rest(found()).speed)
        far = (again() if films.laminar and hasattr(rung, "again") else None) or 0.0
        error = far if far > 2.0 * NEAR_COARSE else change(films.richer, stress=True)
        return ErrorEstimate(error, "K and C", doubt=BEYOND if beyond else "")

    bands = {name: other_band(effect) for name, effect in films.own.items()}
    return films.counted(ladder, step, quiet(lambda: change(bands, stress=False)) if bands else None)


def turbulent_run(
    scene: Scene, journals: Mapping[str, Any], ladder: Ladder, moved: Callable[[float], float]
) -> Ladder:
    """Return a ladder of a run over time whose estimates count the turbulence that its films leave out.

    `moved` takes a relative change of the forces of all films, and returns that of the answer.
    """
    films = ShaftTurbulence.of(scene, journals)
    if not films.richer:
        return ladder
    speed = highest_speed(scene)

    def share(name: str, effect: Turbulence, *, stress: bool) -> float:
        own = quick(journals[name])
        load = JournalStation(scene=scene, name=name, speed=speed).static_load
        at, rich = equilibrium(own, load, speed), replace(own, turbulence=effect)
        force = rich.force(at.position, np.zeros(2), speed)
        if stress:
            force = full_stress_forces(rich, at.position, speed)[1]
        return float(np.linalg.norm(force + load) / np.linalg.norm(load))

    def largest(effects: Mapping[str, Turbulence], *, stress: bool) -> float:
        return moved(max(share(name, one, stress=stress) for name, one in effects.items()))

    def step() -> ErrorEstimate:
        return ErrorEstimate(
            largest(films.richer, stress=True), "forces", doubt=BEYOND if films.laminar else ""
        )

    bands = {name: other_band(effect) for name, effect in films.own.items()}
    return films.counted(ladder, step, quiet(lambda: largest(bands, stress=False)) if bands else None)


def slopes_of(bearing: Any, load: np.ndarray, speed: float, *, stress: bool) -> Coefficients:
    """Return K and C of a bearing on a coarse grid, in balance, with the full stress where its oil has it."""
    cheap = quick(bearing)
    at = equilibrium(cheap, load, speed)
    if cheap.is_warming:
        cheap = cheap.at_temperature(at.temperature)
    if stress:
        linear, full = full_stress_forces(cheap, at.position, speed)
        at = equilibrium(cheap, load + full - linear, speed)
    return coefficients(cheap, at.position, speed)
