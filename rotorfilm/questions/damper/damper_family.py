"""What squeeze-film dampers bring to scenes and questions."""

from __future__ import annotations

from ...scenes.damper.damper_models import damper_fmus
from ...scenes.damper.damper_table import DamperTable
from ...scenes.families import Family
from ..coupling import coupling_ladder
from .damper_peaks import damper_peak_ladder
from .dampers import UNITS, damper_ladder

FAMILY = Family(
    table=DamperTable,
    ladders={
        **dict.fromkeys(UNITS, damper_ladder),
        "blade_loss_peak": damper_peak_ladder,
        "cosimulation_error": coupling_ladder,
    },
    models=damper_fmus,
    command="rotorfilm damper-run",
)
