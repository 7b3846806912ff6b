"""What polymer bushes bring to scenes and questions."""

from __future__ import annotations

from ...scenes.bush.bush_table import BushTable
from ...scenes.families import Family
from .bush_wear_rungs import wear_ladder
from .bushes import bush_ladder

FAMILY = Family(
    table=BushTable,
    ladders={
        "critical_speed": bush_ladder,
        "wear": wear_ladder,
    },
)
