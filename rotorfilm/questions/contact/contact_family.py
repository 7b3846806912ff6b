"""What rolling balls bring to scenes and questions."""

from __future__ import annotations

from ...scenes.contact.contact_table import ContactTable
from ...scenes.families import Family
from .contacts import QUANTITIES, contact_ladder

FAMILY = Family(
    table=ContactTable,
    ladders={
        **dict.fromkeys(QUANTITIES, contact_ladder),
    },
    command="rotorfilm contact",
)
