"""What a scene with a compressor is asked: stability by API 617."""

from __future__ import annotations

from typing import TYPE_CHECKING

from ...errors import InputError
from ...linear import StabilityLevelOne, stability_level_one

if TYPE_CHECKING:
    from ..scene import Scene


def solve_level_one(scene: Scene) -> StabilityLevelOne:
    """Return the stability analysis of level I of the compressor of a scene.

    Parameters
    ----------
    scene : Scene
        With a table `[shaft.compressor]`.

    Raises
    ------
    InputError
        If the scene has none.
    EquilibriumError
        If the rotor does not rest in its bearings.
    AbsentError
        If it has no forward whirl with a resonance.
    """
    shaft = scene.shaft
    if shaft is None or shaft.compressor is None:
        raise InputError("shaft.compressor is required for stability by API 617, got no such table")
    table = shaft.compressor
    return stability_level_one(
        shaft.build(),
        table.cases(shaft.bearings),
        table.speed,
        table.stages,
        nodes=table.shares,
        stage_speed=table.stage_speed,
        average_density=table.average_density,
    )
