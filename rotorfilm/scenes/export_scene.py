"""The bearing and the rotor of a scene as FMUs that fit together."""

from __future__ import annotations

import dataclasses
from pathlib import Path
from typing import NamedTuple

from ..files import written_together
from ..fmu import export_fmu
from ..linear import equilibrium
from ..model import Model
from ..rotors.law_rotor import LawRotor
from ..rotors.rigid import RigidRotor
from .damper.damper_runs import export_damper
from .scene import Scene


class ExportedScene(NamedTuple):
    """Where the two FMUs of a scene are.

    Attributes
    ----------
    film, rotor : Path
    """

    film: Path
    rotor: Path


def resting_rotor(scene: Scene) -> RigidRotor:
    """Return the rotor of a scene at rest in its static equilibrium.

    Raises
    ------
    InputError
        If the scene has no rotor.
    EquilibriumError
        If the film cannot carry the load.
    """
    at = equilibrium(scene.bearing, scene.static_load, scene.speed)
    return dataclasses.replace(scene.rotor, position=(float(at.position[0]), float(at.position[1])))


def export_scene(
    scene: Scene,
    folder: Path,
    *,
    version: str = "2.0",
    backend: str | None = None,
    platforms: str = "host",
) -> ExportedScene:
    """Write `film.fmu` and `rotor.fmu`, both or none, both starting at the static equilibrium.

    Of a scene with a damper these are `damper.fmu`, springs included, and `rotor.fmu`, at rest in the center.

    Parameters
    ----------
    scene : Scene
        With a rotor.
    folder : Path
        Made if absent.
    version, backend, platforms : str
        See `export_fmu`.

    Raises
    ------
    InputError
        If the scene has no rotor.
    EquilibriumError
        If the film cannot carry the load.
    FmuError
        If a model cannot be exported.
    """
    if scene.damper is not None:
        turning, damper = export_damper(scene, folder, version, backend=backend, platforms=platforms)
        return ExportedScene(film=damper, rotor=turning)
    rotor = resting_rotor(scene)
    start = {"x": rotor.position[0], "y": rotor.position[1], "speed": scene.speed}

    def write(model: Model, name: str, values: dict[str, float]) -> None:
        export_fmu(
            model,
            part / f"{name}.fmu",
            version,
            backend,
            platforms=platforms,
            component=name,
            start=values,
            step_size=scene.macro_step,
            stop_time=scene.duration,
        )

    with written_together(folder) as part:
        write(scene.bearing, "film", start)
        write(LawRotor(rotor=rotor), "rotor", {})
    return ExportedScene(film=folder / "film.fmu", rotor=folder / "rotor.fmu")
