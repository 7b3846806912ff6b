"""What pressure dams bring to scenes and questions."""

from __future__ import annotations

from functools import partial
from typing import TYPE_CHECKING

from ...scenes.export_scene import film_models
from ...scenes.families import Family
from ...scenes.pads.dam_candidates import DamCandidate, dam_candidates
from ...scenes.pads.dam_table import DamTable
from .fixed_ladders import fixed_ladders

if TYPE_CHECKING:
    from ...scenes.scene import Scene


def _films(scene: Scene, *, turns: bool = False) -> tuple[DamCandidate, ...]:
    return dam_candidates(scene.table("pressure_dam").build(), fixed=scene.film_is_given, turns=turns)


FAMILY = Family(
    table=DamTable, ladders=fixed_ladders(_films, partial(_films, turns=True)), models=film_models
)
