"""Ladders of bearings of fixed pads: those of journals, by films of pads."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import TYPE_CHECKING

from ...ladders import Ladder
from ...scenes.journal.film_candidate import FilmCandidate
from ..coupling import coupling_ladder
from ..journal.blade_loss import cold_blade_ladder
from ..journal.statics import LOSSES, TEMPERATURES, UNITS as STATICS, cold_static_ladder
from ..journal.unbalance_orbits import cold_orbit_ladder
from ..journal.whirl_rungs import cold_whirl_ladder
from ..orbit_place import UNITS as ORBITS

if TYPE_CHECKING:
    from ...scenes.scene import Scene

Films = Callable[["Scene"], Sequence[FilmCandidate]]
"""Takes a scene and returns the candidates for its bearing."""

AT_REST = [quantity for quantity in STATICS if quantity not in {**LOSSES, **TEMPERATURES}]
"""Static quantities of films without losses."""


def fixed_ladders(points: Films, turns: Films) -> dict[str, Callable[[Scene, str], Ladder]]:
    """Return the ladders by quantity, of candidates for some equilibria and for states all round a turn."""

    def static(scene: Scene, quantity: str) -> Ladder:
        return cold_static_ladder(scene, quantity, points(scene))

    def whirl(scene: Scene, quantity: str) -> Ladder:
        return cold_whirl_ladder(scene, points(scene))

    def orbit(scene: Scene, quantity: str) -> Ladder:
        return cold_orbit_ladder(scene, quantity, turns(scene))

    def blade(scene: Scene, quantity: str) -> Ladder:
        return cold_blade_ladder(scene, turns(scene))

    return {
        **dict.fromkeys(AT_REST, static),
        **dict.fromkeys(ORBITS, orbit),
        "whirl_threshold": whirl,
        "blade_loss_peak": blade,
        "cosimulation_error": coupling_ladder,
    }
