"""What a scene with a compressor is asked: stability by API 617."""

from __future__ import annotations

from typing import TYPE_CHECKING

from ...errors import InputError
from ...linear import StabilityLevelOne, stability_level_one
from ..film_table import oil_remarks
from .shaft_remarks import shaft_remarks

if TYPE_CHECKING:
    from ..scene import Scene
    from .compressor_table import CompressorTable
    from .shaft_table import ShaftTable


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
    shaft, table = _compressor(scene)
    return stability_level_one(
        shaft.build(),
        table.cases(shaft.bearings),
        table.speed,
        table.stages,
        nodes=table.shares,
        stage_speed=table.stage_speed,
        average_density=table.average_density,
        supports=table.supports or None,
    )


def level_one_remarks(scene: Scene) -> tuple[str, ...]:
    """Return what the physics leaves out and should not at the maximum continuous speed, one line each.

    Where there are several cases, a line that is not of all of them begins with the name of its own.

    Parameters
    ----------
    scene : Scene
        With a table `[shaft.compressor]`.

    Raises
    ------
    InputError
        If the scene has none.
    """
    shaft, table = _compressor(scene)
    rotor, oil = shaft.build(), scene.lubricant.properties
    said = {
        name: shaft_remarks(rotor, bearings, oil, table.speed)
        for name, bearings in table.cases(shaft.bearings).items()
    }
    common = [line for line in next(iter(said.values())) if all(line in lines for lines in said.values())]
    own = [f"{name}: {line}" for name, lines in said.items() for line in lines if line not in common]
    return (*oil_remarks(scene.tables, scene.lubricant), *common, *own)


def _compressor(scene: Scene) -> tuple[ShaftTable, CompressorTable]:
    """Return the tables of a compressor; InputError where there are none."""
    if scene.shaft is None or scene.shaft.compressor is None:
        raise InputError("shaft.compressor is required for stability by API 617, got no such table")
    return scene.shaft, scene.shaft.compressor
