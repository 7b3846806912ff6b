"""Questions about pads on an oil: the film of fresh oil (T0), or one temperature in balance (T1).

There is no temperature field over the films of pads: answers say that all have one.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import replace
from typing import TYPE_CHECKING, Any

from ...ladders import Ladder, Rung
from ...linear import equilibrium
from ...results import Equilibrium
from ...scenes.journal.assumed import assumed_figures
from ...scenes.journal.film_candidate import FilmCandidate
from ...scenes.journal.heat_steps import HeatError
from ...scenes.journal.warm_rest import WarmRest, uniform_rest
from ...scenes.pads.pad_remarks import quick_pads
from ..journal.field_rungs import HeatedQuestion
from ..journal.heat_rungs import BALANCE, BALANCED, FRESH, UniformRung
from ..journal.statics import TEMPERATURES, UNITS, relative_distance, rest_value
from ..journal.warm_whirl import WarmWhirlRung

if TYPE_CHECKING:
    from ...scenes.scene import Scene

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
        unit=UNITS[quantity],
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
