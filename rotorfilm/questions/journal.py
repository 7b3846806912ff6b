"""What journal bearings bring to scenes and questions."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from functools import partial
from typing import TYPE_CHECKING

from ..bearings.journal import HeldTilt, TiltLevel
from ..core.answers import Ladder
from ..scenes.film_rungs import FilmCandidate, point_films, turn_films
from ..scenes.tilted_films import tilted_films
from .film_statics import Films, static_ladder, whirl_ladder
from .quantities import ORBIT_UNITS, QUANTITIES

if TYPE_CHECKING:
    from ..scenes.scene import Scene


def film_ladders(
    points: Films, turns: Films, statics: Iterable[str]
) -> dict[str, Callable[[Scene, str], Ladder]]:
    """Return the ladders of a bearing with a film by quantity.

    Parameters
    ----------
    points, turns : callable
        Take a scene and return the candidates for some equilibria, and for states all round a turn.
    statics : iterable of str
        Quantities of the journal at rest that its films have.
    """
    return {
        **dict.fromkeys(statics, partial(static_ladder, points)),
        **dict.fromkeys(ORBIT_UNITS, partial(_orbit_ladder, turns)),
        "whirl_threshold": partial(whirl_ladder, points),
        "peak_displacement": partial(_peak_ladder, turns),
        "cosimulation_error": _coupling_ladder,
    }


# Motions and coupled simulations are imported when they are asked about: they are most of the package.


def _orbit_ladder(turns: Films, scene: Scene, quantity: str) -> Ladder:
    from .film_motions import orbit_ladder

    return orbit_ladder(turns, scene, quantity)


def _peak_ladder(turns: Films, scene: Scene, quantity: str) -> Ladder:
    from .film_motions import blade_loss_ladder

    return blade_loss_ladder(turns, scene, quantity)


def _coupling_ladder(scene: Scene, quantity: str) -> Ladder:
    from .coupling import coupling_ladder

    return coupling_ladder(scene, quantity)


def journal_points(scene: Scene) -> Sequence[FilmCandidate]:
    """Return the films of a journal bearing for some equilibria, or its levels with a tilt."""
    if scene.journal.tilt is not None:
        return tilted_points(scene)
    return point_films(scene.journal_bearing, fixed=scene.film_is_given)


def journal_turns(scene: Scene) -> Sequence[FilmCandidate]:
    """Return those for states all round a turn: the map where there is one, else short film, grids, map."""
    if scene.journal.tilt is not None:
        return tilted_points(scene)
    return turn_films(scene.journal_bearing, fixed=scene.film_is_given, grids=((48, 8), (96, 8)), maps=True)


def tilted_points(scene: Scene) -> Sequence[FilmCandidate]:
    """Return the levels of a journal that keeps a tilt."""
    tilt = scene.journal.tilt
    return tilted_films(
        scene.journal_bearing,
        fixed=scene.film_is_given,
        levels={*TiltLevel} - {TiltLevel.CLOSED_FORM},  # whose force is that without tilt
        made=lambda journal: HeldTilt(journal=journal, tilt=tilt),
    )


LADDERS = film_ladders(journal_points, journal_turns, QUANTITIES)
