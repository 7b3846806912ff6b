"""What journal bearings bring to scenes and questions."""

from __future__ import annotations

from collections.abc import Callable
from functools import partial
from typing import TYPE_CHECKING

from ..core.answers import Ladder
from ..scenes.export_scene import film_models
from ..scenes.families import Family
from ..scenes.film_rungs import FilmRung, point_films, turn_films
from ..scenes.schema import JournalTable
from .coupling import coupling_ladder
from .film_motions import ORBIT_UNITS as ORBITS, blade_loss_ladder, orbit_ladder
from .film_statics import Films, static_ladder, whirl_ladder
from .quantities import QUANTITIES

if TYPE_CHECKING:
    from ..scenes.scene import Scene


def journal_points(scene: Scene) -> tuple[FilmRung, ...]:
    """Return the films of a journal bearing for some equilibria."""
    return point_films(scene.journal_bearing, fixed=scene.film_is_given)


def journal_turns(quantity: str, scene: Scene) -> tuple[FilmRung, ...]:
    """Return those for states all round a turn: the map where there is one, else short film, grids, map."""
    assert scene.journal is not None  # whose question it is
    scene.journal.require_law(quantity)
    return turn_films(scene.journal_bearing, fixed=scene.film_is_given, grids=((48, 8), (96, 8)), maps=True)


def on_turns(ladder: Callable[[Films, Scene, str], Ladder]) -> Callable[[Scene, str], Ladder]:
    """Return a ladder of a motion in a journal bearing."""
    return lambda scene, quantity: ladder(partial(journal_turns, quantity), scene, quantity)


FAMILY = Family(
    table=JournalTable,
    ladders={
        **dict.fromkeys(QUANTITIES, partial(static_ladder, journal_points)),
        **dict.fromkeys(ORBITS, on_turns(orbit_ladder)),
        "whirl_threshold": partial(whirl_ladder, journal_points),
        "blade_loss_peak": on_turns(blade_loss_ladder),
        "cosimulation_error": coupling_ladder,
    },
    models=film_models,
    example={
        "journal": {
            "diameter": "100 mm",
            "length": "50 mm",
            "viscosity": "20 mPa s",
            "clearance": "80 um",
        },
        "operation": {"speed": "3000 rpm"},
        "rigid_rotor": {"mass": "200 kg"},
    },
)
