"""Which family answers which quantity: by the records of the families."""

from __future__ import annotations

from typing import TYPE_CHECKING

from ..answers import QuestionAnswer
from ..errors import InputError
from ..ladders import Ladder
from ..scenes.families import FAMILIES, family_of
from .walk import walk

if TYPE_CHECKING:
    from ..scenes.scene import Scene


def ladder_of(scene: Scene) -> Ladder:
    """Return the ladder of a scene's question.

    Raises
    ------
    InputError
        If the scene asks nothing, or no table of it has the quantity, or several have.
    """
    if scene.question is None:
        raise InputError("question is required for a ladder, got no such table")
    quantity = scene.question.quantity
    tables = sorted(name for name in FAMILIES if quantity in family_of(name).ladders)
    given = [table for table in tables if scene.table(table) is not None]
    if len(given) > 1:
        raise InputError(
            f"question.quantity must be of one table, got {quantity!r} of [{'] and ['.join(given)}]"
        )
    if given:
        return family_of(given[0]).ladders[quantity](scene, quantity)
    there = (family_of(name).ladders for name in FAMILIES if scene.table(name) is not None)
    known = sorted({name for ladders in there for name in ladders})
    needs = f", which needs [{'] or ['.join(tables)}]" if tables else ""
    raise InputError(
        f"question.quantity must be one that this scene has ({', '.join(known)}), got {quantity!r}{needs}"
    )


def ask(scene: Scene) -> QuestionAnswer:
    """Return the answer to a scene's question; see `rotorfilm.questions.walk.walk`."""
    ladder = ladder_of(scene)
    assert scene.question is not None  # checked above
    return walk(scene.question.quantity, ladder, scene.question.tolerance)
