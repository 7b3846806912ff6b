"""The ladders of a bearing with a film, by quantity, of two sets of candidates."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from functools import partial
from typing import TYPE_CHECKING

from ..core.answers import Ladder
from .film_statics import Films, static_ladder, whirl_ladder
from .quantities import ORBIT_UNITS

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
