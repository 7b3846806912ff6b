"""Which family answers which quantity: a family adds one line per quantity."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING

from ..answers import QuestionAnswer
from ..errors import InputError
from .bush.bush_wear_rungs import wear_ladder
from .bush.bushes import bush_ladder
from .contact.contacts import QUANTITIES as CONTACTS
from .contact.contacts import contact_ladder
from .coupling import coupling_ladder
from .damper.damper_peaks import damper_peak_ladder
from .damper.dampers import UNITS as DAMPERS
from .damper.dampers import damper_ladder
from .journal.blade_loss import blade_loss_ladder
from .journal.statics import UNITS as STATICS
from .journal.statics import static_ladder
from .journal.unbalance_orbits import orbit_ladder
from .journal.whirl_rungs import whirl_ladder
from .orbit_place import UNITS as ORBITS
from .shaft.shaft_orbits import shaft_orbit_ladder
from .shaft.shafts import EVENTS as SHAFT_SPEEDS
from .shaft.shafts import shaft_ladder
from .walk import Ladder, walk

if TYPE_CHECKING:
    from ..scenes.scene import Scene

LadderOf = Callable[["Scene", str], Ladder]

LADDERS: dict[tuple[str, str], LadderOf] = {
    **{("journal", quantity): static_ladder for quantity in STATICS},
    **{("journal", quantity): orbit_ladder for quantity in ORBITS},
    ("journal", "whirl_threshold"): whirl_ladder,
    ("journal", "blade_loss_peak"): blade_loss_ladder,
    ("journal", "cosimulation_error"): coupling_ladder,
    **{("shaft", quantity): shaft_ladder for quantity in SHAFT_SPEEDS},
    **{("shaft", quantity): shaft_orbit_ladder for quantity in ORBITS},
    **{("contact", quantity): contact_ladder for quantity in CONTACTS},
    ("bush", "critical_speed"): bush_ladder,
    ("bush", "wear"): wear_ladder,
    ("damper", "cosimulation_error"): coupling_ladder,
    **{("damper", quantity): damper_ladder for quantity in DAMPERS},
    ("damper", "blade_loss_peak"): damper_peak_ladder,
}
"""Builders of ladders by table of the scene and quantity."""


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
    tables = sorted({table for table, name in LADDERS if name == quantity})
    given = [table for table in tables if getattr(scene, table, None) is not None]
    if len(given) > 1:
        raise InputError(
            f"question.quantity must be of one table, got {quantity!r} of [{'] and ['.join(given)}]"
        )
    if given:
        return LADDERS[given[0], quantity](scene, quantity)
    known = sorted({name for table, name in LADDERS if getattr(scene, table, None) is not None})
    needs = f", which needs [{'] or ['.join(tables)}]" if tables else ""
    raise InputError(
        f"question.quantity must be one that this scene has ({', '.join(known)}), got {quantity!r}{needs}"
    )


def ask(scene: Scene) -> QuestionAnswer:
    """Return the answer to a scene's question; see `rotorfilm.questions.walk.walk`."""
    ladder = ladder_of(scene)
    assert scene.question is not None  # checked above
    return walk(scene.question.quantity, ladder, scene.question.tolerance)
