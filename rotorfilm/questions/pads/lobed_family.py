"""What bearings of fixed pads bring to scenes and questions."""

from __future__ import annotations

from typing import TYPE_CHECKING

from ...scenes.export_scene import film_models
from ...scenes.families import Family
from ...scenes.pads.lobed_candidates import LobedCandidate, few_forces, lobed_candidates, many_forces
from ...scenes.pads.lobed_table import LobedTable
from .fixed_ladders import fixed_ladders

if TYPE_CHECKING:
    from ...scenes.scene import Scene


def _all(scene: Scene) -> tuple[LobedCandidate, ...]:
    return lobed_candidates(scene.table("lobed_journal").build(), fixed=scene.film_is_given)


FAMILY = Family(
    table=LobedTable,
    ladders=fixed_ladders(
        lambda scene: few_forces(_all(scene), fixed=scene.film_is_given),
        lambda scene: many_forces(_all(scene), fixed=scene.film_is_given),
    ),
    models=film_models,
)
