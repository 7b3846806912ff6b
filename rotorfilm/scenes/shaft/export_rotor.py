"""FMUs of a flexible rotor, alone or with its bearings, in as few states as a tolerance allows."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from ...errors import InputError
from ...inputs.kinds import arguments
from ...linear import rotor_equilibrium
from ...model import Array, Reaction
from ...rotors import FlexibleRotor, ReducedRotor, Reduction, SteadyRotor, mount, reduce_rotor
from ...rotors.stations import station_names
from .solve_shaft import added_unbalance

if TYPE_CHECKING:
    from ..scene import Scene


class ExportedSystem(NamedTuple):
    """Where the FMU of a flexible rotor in its bearings is.

    Attributes
    ----------
    system : Path
    """

    system: Path


@arguments
def export_rotor_fmu(
    rotor: FlexibleRotor,
    path: str | Path,
    version: str = "2.0",
    *,
    frequency: float,
    tolerance: float = 1e-3,
    bearings: Mapping[str, Reaction] | None = None,
    platforms: str = "host",
    component: str = "rotor",
) -> Reduction:
    """Write a rotor at constant speed as a native FMU, reduced as far as a tolerance allows.

    Parameters
    ----------
    rotor : FlexibleRotor
        With a constant speed; held by its stations, whose signals are those of the FMU.
    path, version, platforms, component
        As in `export_fmu`.
    frequency : float [rad/s]
        Highest frequency of interest, as in `reduce_rotor`.
    tolerance : float [1]
        Largest error of the reduction.
    bearings : mapping of str to Reaction, optional
        By station: the FMU begins at rest in them, under their forces; without, straight and without forces.

    Returns
    -------
    Reduction
        The rotor in the FMU, with its error.

    Raises
    ------
    InputError
        If an argument breaks its rule.
    ConvergenceError
        If no reduction is within the tolerance.
    EquilibriumError
        If there is no equilibrium in the bearings.
    """
    from ...fmu import export_fmu  # slow to load, and not needed to read a scene

    reduction = reduce_rotor(rotor, frequency=frequency, tolerance=tolerance)
    start = {}
    if bearings is not None:
        rotor, loads = _at_rest(reduction.rotor, bearings, float(reduction.rotor.profile.speed(0.0)))
        reduction = replace(reduction, rotor=rotor)
        start = {
            name: -value
            for station, load in loads.items()
            for name, value in zip(station_names(station)[1], load.tolist(), strict=True)
        }
    model = SteadyRotor(rotor=reduction.rotor)
    export_fmu(model, path, version, platforms=platforms, component=component, start=start)
    return reduction


def export_system(
    scene: Scene,
    folder: Path,
    *,
    version: str = "2.0",
    backend: str | None = None,
    platforms: str = "host",
    tolerance: float = 1e-3,
) -> ExportedSystem:
    """Write `system.fmu`: the flexible rotor of a scene with all its bearings, at rest in them.

    Its speed is `operation.speed`, without an operation the first one of `shaft.speeds`.

    Parameters
    ----------
    scene : Scene
        With a shaft.
    folder : Path
        Made if absent.
    version, backend, platforms : str
        See `export_fmu`.
    tolerance : float [1]
        Largest error of the reduction of the rotor, up to the highest frequency of the shaft.

    Raises
    ------
    InputError
        If the scene has no shaft, or an excitation other than an unbalance.
    ConvergenceError
        If no reduction is within the tolerance.
    EquilibriumError
        If there is no equilibrium in the bearings.
    FmuError
        If a model cannot be exported.
    """
    from ...fmu import export_fmu  # slow to load, and not needed to read a scene

    if scene.shaft is None:
        raise InputError("shaft is required for the FMU of a rotor and its bearings, got no such table")
    speeds = scene.shaft.speeds
    speed = speeds.first if scene.operation is None else scene.speed
    highest = scene.shaft.highest_frequency or 2.0 * speeds.last
    whole = scene.shaft.build(speed=speed, extra=added_unbalance(scene))
    bearings = scene.shaft.build_bearings()
    rotor, _ = _at_rest(reduce_rotor(whole, frequency=highest, tolerance=tolerance).rotor, bearings, speed)
    model = mount(rotor, bearings)
    path = folder / "system.fmu"
    turning = abs(speed) or 1.0
    export_fmu(
        model,
        path,
        version,
        backend,
        platforms=platforms,
        component="system",
        step_size=scene.cosimulation.macro_angle / turning,
        stop_time=2.0 * np.pi / turning,  # a turn: what Python takes for it is some seconds
    )
    return ExportedSystem(system=path)


def _at_rest(
    rotor: ReducedRotor, bearings: Mapping[str, Reaction], speed: float
) -> tuple[ReducedRotor, Mapping[str, Array]]:
    """Return the rotor as it rests in its bearings at a speed [rad/s], and its load on each [N]."""
    at = rotor_equilibrium(rotor, bearings, speed)
    rest = np.concatenate([at.displacement, np.zeros(len(at.displacement))])
    return replace(rotor, initial=tuple(rest.tolist())), at.loads
