"""The effect of turbulence on a question about a bearing with a film.

Levels are the laminar film, a fit with the local Reynolds number, the quadrature of the eddy viscosity that
it fits, and the eddy viscosity of the full stress. What a level leaves out is the step that the richer one
makes at the place found: by its force and slopes there, without an equilibrium of its own. The band of
transition, behind which no measurement stands, is no part of the error: what it changes is said beside the
answer.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import replace
from functools import cache
from typing import TYPE_CHECKING, Any

import numpy as np

from ..bearings.films.turbulence import Turbulence
from ..bearings.journal import full_stress_forces
from ..core.answers import ErrorEstimate, Ladder, LeftOutRemark, Rung, RungResult
from ..core.errors import RotorfilmError
from ..scenes.film_rungs import FilmCandidate
from ..scenes.turbulent import QUADRATURE, is_left_laminar, other_band, quick, quiet, turbulence_of, warmed
from .conserved_oil import rest_on
from .variants import FunctionRung, with_estimate

if TYPE_CHECKING:
    from ..scenes.scene import Scene

WHOLE_STEP = 1.35
"""The way from a laminar place to the turbulent one over the first step, 70 % of it."""

TRANSITION = "what the band of transition changes"


def turbulent_oil(scene: Scene, question: Any, films: Sequence[FilmCandidate], ladder: Ladder) -> Ladder:
    """Return a ladder whose estimates count the turbulence that its films leave out.

    The error of a laminar film above the onset is what a turbulent one changes. That of a closure is what the
    quadrature and the full stress change, the latter not known of tilting pads.
    """
    bearing = films[0].reaction
    effect = getattr(bearing, "turbulence", None)
    place = at_temperature(question, bearing)
    if effect is None:
        if not is_left_laminar(scene.film_table, scene):
            return ladder
        own = turbulence_of(bearing, scene)

        def step() -> ErrorEstimate:
            about = step_to(question, films[0], place(), own)
            return about._replace(error=WHOLE_STEP * about.error)

        return _counted(ladder, cache(step), "turbulence")
    said = f"turbulent by {effect.closure}"
    ladder = replace(ladder, within=f"{ladder.within.replace('laminar films', 'films')}, {said}")
    remark = _transition(question, films[0], place, effect)
    ladder = replace(ladder, remarks=(*remark, *ladder.remarks))

    def closer() -> ErrorEstimate:
        richer = replace(effect, closure=QUADRATURE)
        about = step_to(question, films[0], place(), richer) if richer != effect else None
        stress = by_stress(question, place())
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
                shared=about.shared + more,
                better=None,
            )

        return with_estimate(rung, estimate, token)

    return replace(ladder, rungs=tuple(counted(rung) for rung in ladder.rungs))


def step_to(question: Any, film: FilmCandidate, bearing: Any, richer: Turbulence) -> ErrorEstimate:
    """Return what a film of another turbulence changes in an answer, by its force and slopes at its place."""
    rich = replace(bearing, turbulence=richer)
    candidate = replace(film, reaction=bearing, rich=rich, rich_name="another turbulence", bounded=False)
    rung = question.make(replace(candidate, making=0.0), question.counts[0])
    found = rung.answer(None)
    about: ErrorEstimate = rung.estimate(found, None, 0.0)
    return about


def by_stress(question: Any, bearing: Any) -> float:
    """Return what the full stress changes in an answer: its force at the place found as another load."""
    if hasattr(bearing, "on_frozen"):
        return 0.0
    own = rest_on(bearing, question.load, question.speed)
    linear, full = full_stress_forces(bearing, own.at.position, question.speed)
    x, y = (np.asarray(question.load) + full - linear).tolist()
    return float(
        question.distance(question.value(own), question.value(rest_on(bearing, (x, y), question.speed)))
    )


def _transition(
    question: Any, film: FilmCandidate, place: Callable[[], Any], effect: Turbulence
) -> tuple[LeftOutRemark, ...]:
    """Return what a band of transition changes, or the want of one."""
    about = quiet(lambda: step_to(question, film, place(), other_band(effect)))
    if about is None:
        return ()
    other = "with a band of transition" if effect.band is False else "without the band of transition"
    text = f"turbulence: {other}, behind which no measurement stands, the answer is {about.error:.2g} away"
    return (LeftOutRemark(text, TRANSITION, about.error),)
