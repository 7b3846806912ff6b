"""Ladders of bearings of fixed pads: those of journals, by films of pads."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from functools import partial
from typing import TYPE_CHECKING

from ...errors import InputError
from ...ladders import Ladder
from ...scenes.journal.film_candidate import FilmCandidate
from ..coupling import coupling_ladder
from ..journal.blade_loss import cold_blade_ladder
from ..journal.statics import TEMPERATURES, UNITS as STATICS, StaticRung, cold_static_ladder
from ..journal.unbalance_orbits import cold_orbit_ladder
from ..journal.whirl_rungs import cold_whirl_ladder, required_rotor
from ..orbit_place import UNITS as ORBITS
from .warm_pads import is_warm, settled_scene, warm_static_ladder, warm_whirl_ladder

if TYPE_CHECKING:
    from ...scenes.scene import Scene

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
