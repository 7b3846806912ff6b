"""`[sleeve]` of a scene, and its models for FMUs."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

from ...core.errors import InputError
from ...scenes.families import SceneModels
from ...scenes.reading import Taking, fields_of, made_from
from .bearing import ViscousSleeve

if TYPE_CHECKING:
    from ...scenes.scene import Scene


@dataclass(frozen=True, kw_only=True)
@fields_of(ViscousSleeve, without=("short",))
class SleeveTable(Taking):
    """`[sleeve]`: a viscous sleeve."""

    def __post_init__(self) -> None:
        self.build()

    def build(self) -> ViscousSleeve:
        """Return the bearing; raise InputError where a value breaks its rule."""
        return made_from(ViscousSleeve, self)


def sleeve_models(scene: Scene) -> SceneModels:
    """Return the sleeve of a scene and its rotor, at rest in the center."""
    if scene.rigid_rotor is None:
        raise InputError("rigid_rotor is required for FMUs, got no such table")
    rotor = scene.rigid_rotor.build(scene.speed, (0.0, 0.0))
    sleeve = scene.table("sleeve").build()
    return SceneModels("sleeve", sleeve, rotor, {}, scene.macro_step, scene.duration)
