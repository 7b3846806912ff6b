"""The families of the scene battery: where scenes are drawn from, and what each is judged by."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from . import (
    built_dampers,
    bushes,
    contacts,
    couplings,
    dampers,
    heated,
    journals,
    openings,
    padded,
    rolling,
    shafts,
    supplied,
)
from .drawn import Drawn

Draw = Callable[[np.random.Generator], Drawn]
FAMILIES: dict[str, tuple[int, Draw]] = {
    "named film": (6, journals.fixed_film),
    "slim": (4, journals.slim),
    "grooved": (2, journals.grooved),
    "free film": (2, journals.plain_map),
    "whirl": (2, journals.whirl),
    "orbit": (3, journals.orbit),
    "blade loss": (1, journals.blade),
    "coupling": (1, couplings.coupling),
    "damper": (2, dampers.damper),
    "orbit, film": (1, journals.orbit_by_film),
    "blade, film": (1, journals.blade_by_film),
    "contact": (1, contacts.rest),
    "contact motion": (1, contacts.motion),
    "damper jumps": (2, dampers.jumps),
    "damper blade loss": (2, dampers.lost_blade),
    "bush speed": (1, bushes.bush_speed),
    "bush wear": (2, bushes.bush_wear),
    "coupling hard": (1, couplings.hard),
    "coupling other": (1, couplings.other),
    "shaft speed": (2, shafts.shaft_speed),
    "shaft orbit": (2, shafts.shaft_orbit),
    "shaft whirl": (1, shafts.shaft_whirl),
    "fed": (1, openings.fed),
    "pads": (1, openings.pads),
    "lobes": (2, padded.lobes),
    "dam": (1, padded.dam),
    "tilting": (2, padded.tilting),
    "ball bearing": (0, rolling.ball_bearing),
    "built damper": (0, built_dampers.built_damper),
    "heated": (0, heated.heated),
    "supplied": (0, supplied.supplied),
}
"""Weight of each family in a round of the battery, and how one scene of it is drawn; 0 of those run alone."""
