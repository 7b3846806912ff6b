"""A rotor and a damper whose oil has mass as one FMU."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from ...bearings.damper import JFODamper, MapSqueeze
from ...errors import InputError
from ...rotors import mount
from .damper_models import damper_models

if TYPE_CHECKING:
    from ..scene import Scene


class ExportedRotor(NamedTuple):
    """Where the FMU of a rotor on its damper is.

    Attributes
    ----------
    system : Path
    """

    system: Path


def export_damped_rotor(
    scene: Scene, folder: Path, *, version: str = "2.0", backend: str | None = None, platforms: str = "host"
) -> ExportedRotor:
    """Write `system.fmu`: the rotor of a scene on its damper, springs included, at rest.

    A film that the scene does not name is the map of the short film, which runs in C, or between tight seals
    that of finite length.

    Parameters
    ----------
    scene : Scene
        With a damper and a rotor.
    folder : Path
        Made if absent.
    version, backend, platforms : str
        See `export_fmu`.

    Raises
    ------
    InputError
        If the scene lacks a damper or a rotor.
    FmuError
        If the rotor cannot be exported.
    """
    from ...fmu import export_fmu  # slow to load, and not needed to read a scene

    table = scene.damper
    if table is None:
        raise InputError("damper is required for the FMU of a rotor on one, got no such table")
    if table.film is None and not table.needs_length:
        scene = replace(scene, damper=replace(table, film=MapSqueeze()))
    models = damper_models(scene)
    assert not isinstance(models.support, JFODamper)  # which no scene has that names a film, or seals
    path = folder / "system.fmu"
    export_fmu(
        mount(models.rotor, {"": models.support}),
        path,
        version,
        backend,
        platforms=platforms,
        component="system",
        step_size=models.step,
        stop_time=2.0 * np.pi / (abs(scene.speed) or 1.0),  # a turn: Python takes seconds for it
    )
    return ExportedRotor(system=path)
