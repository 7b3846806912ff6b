"""Bearing and rotor of a scene written as two FMUs, both or none."""

from __future__ import annotations

from pathlib import Path
from typing import NamedTuple

from ..files import written_together
from ..fmu import export_fmu
from .families import SceneModels


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
    parts = ((models.name, models.bearing, models.start), ("rotor", models.rotor, {}))
    with written_together(folder) as part:
        for name, model, start in parts:
            export_fmu(
                model,
                part / f"{name}.fmu",
                version,
                backend,
                platforms=platforms,
                component=name,
                start=start,
                step_size=models.step,
                stop_time=models.duration,
            )
    return ExportedScene(film=folder / f"{models.name}.fmu", rotor=folder / "rotor.fmu")
