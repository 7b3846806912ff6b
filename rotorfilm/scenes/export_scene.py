"""The bearing and the rotor of a scene as FMUs that fit together."""

from __future__ import annotations

import dataclasses
from collections.abc import Mapping
from pathlib import Path
from typing import TYPE_CHECKING, NamedTuple

from ..analysis import equilibrium
from ..core.files import written_together
from ..fmu import export_fmu, export_ssp
from ..rotors.force_law import LawRotor
from ..rotors.rigid import RigidRotor
from .families import SceneModels, models_of

if TYPE_CHECKING:
    from .scene import Scene


class ExportedScene(NamedTuple):
    """Where the two FMUs of a scene are.

    Attributes
    ----------
    film, rotor : Path
    """

    film: Path
    rotor: Path


def write_models(
    models: SceneModels,
    folder: Path,
    version: str = "2.0",
    backend: str | None = None,
    *,
    platforms: str = "host",
) -> ExportedScene:
    """Write the FMUs of a bearing and its rotor; see `export_fmu`."""
    starts: dict[str, Mapping[str, float]] = {models.name: models.start, "rotor": {}}
    parts = {models.name: models.bearing, "rotor": models.rotor}
    with written_together(folder) as part:
        for name, model in parts.items():
            export_fmu(
                model,
                part / f"{name}.fmu",
                version,
                backend,
                platforms=platforms,
                component=name,
                start=starts[name],
                step_size=models.step,
                stop_time=models.duration,
            )
    return ExportedScene(film=folder / f"{models.name}.fmu", rotor=folder / "rotor.fmu")


def export_scene_system(scene: Scene, path: Path, *, version: str = "2.0", platforms: str = "host") -> Path:
    """Write the film and the rotor of a scene, connected, as one file of SSP; see `export_ssp`.

    Parameters
    ----------
    scene : Scene
        With a rotor.
    path : Path
        Ending in `.ssp`.
    version, platforms : str
        See `export_fmu`.

    Raises
    ------
    InputError
        If the scene has no rotor, or no bearing that a rotor runs in.
    EquilibriumError
        If the film cannot carry the load.
    FmuError
        If a model cannot be exported.
    """
    models = models_of(scene)
    return export_ssp(
        models.rotor,
        models.bearing,
        path,
        version,
        platforms=platforms,
        start={"film": models.start},
        step_size=models.step,
        stop_time=models.duration,
    )


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


def film_models(scene: Scene) -> SceneModels:
    """Return the journal bearing of a scene and its rotor, both at the static equilibrium."""
    rotor = resting_rotor(scene)
    start = {"x": rotor.position[0], "y": rotor.position[1], "speed": scene.speed}
    law = LawRotor(rotor=rotor)
    return SceneModels("film", scene.bearing, law, start, scene.macro_step, scene.duration)


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
        If the scene has no rotor, or no bearing that a rotor runs in.
    EquilibriumError
        If the film cannot carry the load.
    FmuError
        If a model cannot be exported.
    """
    return write_models(models_of(scene), folder, version, backend, platforms=platforms)
