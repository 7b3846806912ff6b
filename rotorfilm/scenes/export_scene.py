"""The bearing and the rotor of a scene as FMUs that fit together, or as one; a flexible rotor alone."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from .. import rotors
from ..analysis import RotorEquilibrium, equilibrium, rotor_equilibrium
from ..core.files import written_together
from ..core.inputs import arguments
from ..core.port import Reaction, from_rest
from ..fmu import export_fmu, export_ssp
from ..rotors.force_law import LawRotor
from ..rotors.rigid import RigidRotor
from ..rotors.structure import station_names
from .families import SceneModels, models_of

if TYPE_CHECKING:
    from .scene import Scene


def export_scene(
    scene: Scene,
    folder: Path,
    *,
    version: str = "2.0",
    backend: str | None = None,
    platforms: str = "host",
    tolerance: float = 1e-3,
) -> dict[str, Path]:
    """Write the FMUs of a scene, all or none.

    These are `film.fmu` and `rotor.fmu`, both starting at the static equilibrium; of a scene with a damper
    `damper.fmu`, springs included, and `rotor.fmu`, at rest in the center. A flexible rotor is one
    `system.fmu` with all its bearings, at rest in them; so is a rotor on a damper whose oil has mass. A
    thrust bearing is `thrust.fmu` alone, whose z is counted from its equilibrium under the axial load.

    Parameters
    ----------
    scene : Scene
        Scene with a rotor. A flexible one has `operation.speed`, without an operation the first of
        `shaft.speeds`.
    folder : Path
        Made if absent.
    version, backend, platforms : str
        See `export_fmu`.
    tolerance : float [1]
        Largest error of the reduction of a flexible rotor, up to the highest frequency of the shaft.

    Returns
    -------
    dict of str to Path
        The files of `film` and `rotor`, or of the `system`.

    Raises
    ------
    InputError
        If the scene has no rotor, no bearing that a rotor runs in, or a shaft with an excitation other than
        an unbalance.
    ConvergenceError
        If no reduction of a flexible rotor is within the tolerance.
    EquilibriumError
        If a film cannot carry its load.
    FmuError
        If a model cannot be exported.
    """
    heavy = scene.damper is not None and scene.damper.density > 0.0
    if heavy or (scene.shaft is not None and not scene.has_film):
        model, step, speed = _damped_rotor(scene) if heavy else _shaft_system(scene, tolerance)
        end = 2.0 * np.pi / (abs(speed) or 1.0)  # a turn: what Python takes for it is some seconds
        files = {"system": "system"}
        parts: Mapping[str, tuple[Any, Mapping[str, float]]] = {"system": (model, {})}
    elif scene.thrust is not None and not scene.has_film:
        from ..bearings.thrust.table import thrust_models  # another family, whose models no other scene needs

        end = 2.0 * np.pi / (abs(scene.speed) or 1.0)
        step, files, parts = 0.01 * end, {"thrust": "thrust"}, {"thrust": thrust_models(scene)}
    else:
        models = models_of(scene, "shaft", "thrust")
        files, parts = models.files, models.parts
        step, end = models.step, models.duration
    write_models(parts, folder, version, backend, platforms=platforms, step=step, end=end)
    return {name: folder / f"{file}.fmu" for name, file in files.items()}


def write_models(
    parts: Mapping[str, tuple[Any, Mapping[str, float]]],
    folder: Path,
    version: str = "2.0",
    backend: str | None = None,
    *,
    platforms: str = "host",
    step: float,
    end: float,
) -> None:
    """Write models with their start values as FMUs, all or none; see `export_fmu`.

    Parameters
    ----------
    parts : mapping of str to (model, mapping)
        Parts by the names of files and components.
    folder : Path
    version, backend, platforms : str
    step, end : float [s]
        Between two exchanges, and of a run.
    """
    with written_together(folder) as place:
        for name, (model, start) in parts.items():
            export_fmu(
                model,
                place / f"{name}.fmu",
                version,
                backend,
                platforms=platforms,
                component=name,
                start=start,
                step_size=step,
                stop_time=end,
            )


def export_scene_system(scene: Scene, path: Path, *, version: str = "2.0", platforms: str = "host") -> Path:
    """Write the film and the rotor of a scene, connected, as one file of SSP; see `export_ssp`.

    Parameters
    ----------
    scene : Scene
        Scene with a rotor.
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


def at_rest_on_film(scene: Scene) -> tuple[RigidRotor, Any]:
    """Return the rotor of a scene at rest in its static equilibrium, and its bearing, as warm as there.

    Raises
    ------
    InputError
        If the scene has no rotor.
    EquilibriumError
        If the film cannot carry the load.
    """
    at = equilibrium(scene.bearing, scene.static_load, scene.speed)
    bearing = from_rest(scene.bearing, at.position, scene.speed, at.temperature)
    return replace(scene.rotor, position=tuple(at.position.tolist())), bearing


def film_models(scene: Scene) -> SceneModels:
    """Return the journal bearing of a scene and its rotor, both at the static equilibrium."""
    rotor, bearing = at_rest_on_film(scene)
    start = {"x": rotor.position[0], "y": rotor.position[1], "speed": scene.speed}
    law = LawRotor(rotor=rotor)
    return SceneModels("film", bearing, law, start, scene.macro_step, scene.duration)


def _damped_rotor(scene: Scene) -> tuple[Any, float, float]:
    """Return the rotor of a scene on its damper, springs included, a step [s], and its speed.

    A film that the scene does not name is the map of the short film, which runs in C, or between tight seals
    that of finite length.
    """
    from ..bearings.damper import MapSqueeze  # another family, whose models no other scene needs
    from ..bearings.damper.table import damper_models

    table = scene.damper
    if table.film is None and not table.needs_length:
        scene = scene.with_tables(damper=replace(table, film=MapSqueeze()))
    models = damper_models(scene)
    support: Any = models.support
    return rotors.mount(models.rotor, {"": support}), models.step, scene.speed


def system_speed(scene: Scene) -> float:
    """Return the speed at which a flexible rotor is exported [rad/s]."""
    return float(scene.shaft.speeds.first if scene.operation is None else scene.speed)


def _shaft_system(scene: Scene, tolerance: float) -> tuple[Any, float, float]:
    """Return the flexible rotor of a scene at rest in its bearings, a step [s], and its speed."""
    from .solve_shaft import added_unbalance  # as above

    speed = system_speed(scene)
    highest = scene.shaft.highest_frequency or 2.0 * scene.shaft.speeds.last
    whole = scene.shaft.build(speed=speed, extra=added_unbalance(scene))
    bearings = scene.shaft.build_bearings()
    reduced = rotors.reduce_rotor(whole, frequency=highest, tolerance=tolerance).rotor
    rotor, at = at_rest(reduced, bearings, speed)
    step = scene.cosimulation.macro_angle / (abs(speed) or 1.0)
    return rotors.mount(rotor, from_shaft_rest(bearings, at)), step, speed


@arguments
def export_rotor_fmu(
    rotor: rotors.FlexibleRotor,
    path: str | Path,
    version: str = "2.0",
    *,
    frequency: float,
    tolerance: float = 1e-3,
    bearings: Mapping[str, Reaction] | None = None,
    platforms: str = "host",
    component: str = "rotor",
) -> rotors.Reduction:
    """Write a rotor at constant speed as a native FMU, reduced as far as a tolerance allows.

    Parameters
    ----------
    rotor : FlexibleRotor
        Rotor with a constant speed, held by its stations. The signals of the FMU are those of the stations.
    path, version, platforms, component
        As in `export_fmu`.
    frequency : float [rad/s]
        Highest frequency of interest, as in `reduce_rotor`.
    tolerance : float [1]
        Largest error of the reduction.
    bearings : mapping of str to Reaction, optional
        Bearings by station. The FMU starts at the equilibrium in these bearings; without them it starts
        straight and without forces.

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
    reduction = rotors.reduce_rotor(rotor, frequency=frequency, tolerance=tolerance)
    start = {}
    if bearings is not None:
        resting, at = at_rest(reduction.rotor, bearings, float(reduction.rotor.profile.speed(0.0)))
        reduction = replace(reduction, rotor=resting)
        start = {
            name: -value
            for station, load in at.loads.items()
            for name, value in zip(station_names(station)[1], load.tolist(), strict=True)
        }
    model = rotors.SteadyRotor(rotor=reduction.rotor)
    export_fmu(model, path, version, platforms=platforms, component=component, start=start)
    return reduction


@arguments
def export_machine_fmu(
    rotor: rotors.ShaftRotor,
    bearings: Mapping[str, Reaction],
    path: str | Path,
    version: str = "2.0",
    *,
    frequency: float,
    tolerance: float = 1e-3,
    platforms: str = "host",
    component: str = "machine",
    stop_time: float = 0.1,
    step_size: float = 1e-4,
    speed_input: bool = False,
) -> rotors.MountedRotor:
    """Write a rotor with its bearings as one FMU, at rest in them at its speed.

    Outputs are the motions of its bearings and probes by their names, and the forces of the bearings.
    Parameters are `constant_speed` [rad/s], fixed, unless the speed is an input, and of each plane with an
    `Unbalance`, by its node k, `plane_k_unbalance` [kg m] and `plane_k_unbalance_angle` [rad], tunable; an
    unbalance of 0 makes a plane too. An FMU that is not compiled has no parameters, and the unbalances of the
    rotor. Inputs are forces in the planes, `plane_k_force_x` and _y [N]. A plane is at a node without a
    bearing.

    Parameters
    ----------
    rotor : ShaftRotor
    bearings : mapping of str to Reaction
        By station, one for each.
    path, version, frequency, tolerance, platforms, component
        As in `export_rotor_fmu`.
    stop_time, step_size : float [s]
        As in `export_fmu`.
    speed_input : bool
        Whether `prescribed_speed` [rad/s] and `prescribed_acceleration` [rad/s2] are inputs, as in
        `SpeedInputRotor`. The speed starts with that of the rotor.

    Returns
    -------
    MountedRotor
        The model that was written.

    Raises
    ------
    InputError
        If an argument breaks its rule.
    ConvergenceError
        If no reduction is within the tolerance.
    EquilibriumError
        If there is no equilibrium in the bearings.
    """
    sums: dict[int, complex] = {}
    for one in rotor.unbalances:
        phasor = one.unbalance * np.exp(1j * one.unbalance_angle)
        sums[one.node] = sums.get(one.node, 0.0) + phasor
    planes = tuple(
        rotors.UnbalancePlane(f"plane_{node}", float(abs(sum_)), float(np.angle(sum_)))
        for node, sum_ in sums.items()
    )
    further = (
        rotors.Station(node=node, name=plane.station) for node, plane in zip(sums, planes, strict=True)
    )
    whole = replace(rotor, stations=(*rotor.stations, *further))
    reduced = rotors.reduce_rotor(whole, frequency=frequency, tolerance=tolerance).rotor
    speed = float(reduced.profile.speed(0.0))
    resting, at = at_rest(reduced, bearings, speed)
    turning = rotors.SpeedInputRotor(rotor=replace(resting, speed=speed)) if speed_input else resting
    model = rotors.mount(turning, from_shaft_rest(bearings, at))
    if model.native() is not None:  # in Python the unbalances stay those of the rotor
        model = replace(model, planes=planes)
    export_fmu(
        model,
        path,
        version,
        platforms=platforms,
        component=component,
        start={"prescribed_speed": speed} if speed_input else None,
        stop_time=stop_time,
        step_size=step_size,
    )
    return model


def at_rest(rotor: Any, bearings: Mapping[str, Reaction], speed: float) -> tuple[Any, RotorEquilibrium]:
    """Return the rotor as it rests in its bearings at a speed [rad/s], and that equilibrium."""
    at = rotor_equilibrium(rotor, bearings, speed)
    return replace(rotor, initial=(*at.displacement.tolist(), *[0.0] * len(at.displacement))), at


def from_shaft_rest(bearings: Mapping[str, Reaction], at: RotorEquilibrium) -> dict[str, Reaction]:
    """Return the bearings of a shaft as they run from its rest: as warm, and pads as tilted, as there."""
    return {
        name: from_rest(bearing, at.coefficients[name].position, at.speed, at.temperatures.get(name))
        for name, bearing in bearings.items()
    }
