"""What viscous sleeves bring to scenes and questions."""

from __future__ import annotations

from typing import TYPE_CHECKING

from ...core.errors import InputError
from ..families import Family, SceneModels
from .sleeve_rungs import sleeve_ladder
from .sleeve_table import SleeveTable

if TYPE_CHECKING:
    from ..scene import Scene


def sleeve_models(scene: Scene) -> SceneModels:
    """Return the sleeve of a scene and its rotor, at rest in the center."""
    if scene.rigid_rotor is None:
        raise InputError("rigid_rotor is required for FMUs, got no such table")
    rotor = scene.rigid_rotor.build(scene.speed, (0.0, 0.0))
    sleeve = scene.table("sleeve").build()
    return SceneModels("sleeve", sleeve, rotor, {}, scene.macro_step, scene.duration)


FAMILY = Family(table=SleeveTable, ladders={"damping": sleeve_ladder}, models=sleeve_models)
