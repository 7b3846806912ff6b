"""What journal bearings bring to scenes and questions."""

from __future__ import annotations

from ...scenes.export_scene import film_models
from ...scenes.families import Family
from ...scenes.schema import JournalTable
from ..coupling import coupling_ladder
from ..orbit_place import UNITS as ORBITS
from .blade_loss import blade_loss_ladder
from .static_ladders import static_ladder
from .statics import UNITS as STATICS
from .unbalance_orbits import orbit_ladder
from .warm_whirl import journal_whirl_ladder

FAMILY = Family(
    table=JournalTable,
    ladders={
        **dict.fromkeys(STATICS, static_ladder),
        **dict.fromkeys(ORBITS, orbit_ladder),
        "whirl_threshold": journal_whirl_ladder,
        "blade_loss_peak": blade_loss_ladder,
        "cosimulation_error": coupling_ladder,
    },
    models=film_models,
)
