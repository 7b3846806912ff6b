"""What journal bearings bring to scenes and questions."""

from __future__ import annotations

from typing import TYPE_CHECKING

from ..scenes.film_rungs import FilmRung, point_films, turn_films
from .film_motions import film_ladders
from .quantities import QUANTITIES

if TYPE_CHECKING:
    from ..scenes.scene import Scene


def journal_points(scene: Scene) -> tuple[FilmRung, ...]:
    """Return the films of a journal bearing for some equilibria."""
    return point_films(scene.journal_bearing, fixed=scene.film_is_given)


def journal_turns(scene: Scene) -> tuple[FilmRung, ...]:
    """Return those for states all round a turn: the map where there is one, else short film, grids, map."""
    return turn_films(scene.journal_bearing, fixed=scene.film_is_given, grids=((48, 8), (96, 8)), maps=True)


LADDERS = film_ladders(journal_points, journal_turns, QUANTITIES)
