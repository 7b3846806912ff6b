"""What a scene with a flexible rotor is asked: modes over speed, critical speeds, stability, response."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import TYPE_CHECKING

import numpy as np

from ...errors import InputError
from ...linear import (
    Campbell,
    CriticalSpeed,
    RotorThreshold,
    campbell,
    critical_speeds,
    resonant_speeds,
    rotor_equilibrium,
    rotor_threshold,
)
from ...linear.rotor_system import driven_by_unbalance
from ...model import Array
from ...progress import Report, part_of, silent
from ...readable.result import Drawable
from ..excitation_table import GroundTable, UnbalanceTable, require_kind
from ..film_table import oil_remarks
from .shaft_remarks import shaft_remarks

if TYPE_CHECKING:
    import control

    from ..scene import Scene


@dataclass(frozen=True, kw_only=True)
class RotorAnswer(Drawable):
    """A flexible rotor in its bearings over a range of speeds.

    Attributes
    ----------
    title : str
    mass : float [kg]
        Of shaft and disks.
    states : int
    loads : dict of str to ndarray, shape (2,) [N]
        Static load on each bearing, at the first speed.
    residual : float [1]
        Largest imbalance of forces / weight there.
    critical_speeds : tuple of CriticalSpeed
        Where a whirl has the frequency of the rotation.
    threshold : RotorThreshold
        Where a whirl begins to grow.
    campbell : Campbell
        All whirls over the speed.
    amplitudes : dict of str to ndarray, shape (n_response,)
        Over the frequencies of `response`, which are closer about the critical speeds.
        Of each displacement [m] and force on a housing [N] under the unbalance; empty without one.
    response : control.FrequencyResponseData or None
        The same with phases.
    remarks : tuple of str
        What the physics of shaft and films leaves out and should not, at the last speed.
    """

    title: str
    mass: float
    states: int
    loads: Mapping[str, Array]
    residual: float
    critical_speeds: tuple[CriticalSpeed, ...]
    threshold: RotorThreshold
    campbell: Campbell
    amplitudes: Mapping[str, Array]
    response: control.FrequencyResponseData | None = field(repr=False)
    remarks: tuple[str, ...] = ()

    def _own_units(self) -> dict[str, str]:
        return {name: "N" if "_force_" in name else "m" for name in self.amplitudes}


def solve_rotor(scene: Scene, report: Report = silent) -> RotorAnswer:
    """Return what the shaft of a scene does over its speeds.

    Parameters
    ----------
    scene : Scene
        With a shaft; an unbalance as excitation is added to those of the shaft.
    report : callable
        Is told the progress.

    Raises
    ------
    InputError
        If the scene has no shaft, or an excitation of another kind.
    EquilibriumError
        If there is no equilibrium at one of the speeds.
    """
    if scene.shaft is None:
        raise InputError("shaft is required for the analyses of a flexible rotor, got no such table")
    rotor, bearings = scene.shaft.build(extra=added_unbalance(scene)), scene.shaft.build_bearings()
    speeds = scene.shaft.speeds.build()
    highest = scene.shaft.highest_frequency or 2.0 * float(speeds[-1])
    report(0.0, "equilibrium")
    at = rotor_equilibrium(rotor, bearings, float(speeds[0]))
    report(0.05, "modes over speed")
    chart = campbell(rotor, bearings, speeds, highest)
    report(0.35, "critical speeds")
    critical = critical_speeds(rotor, bearings, speeds)
    report(0.65, "threshold of stability")
    threshold = rotor_threshold(rotor, bearings, speeds, report=part_of(report, 0.65, 0.85))
    report(0.85, "unbalance response")
    turned = resonant_speeds(speeds, critical)
    response = driven_by_unbalance(rotor, bearings, turned) if rotor.assembly.unbalance.any() else None
    report(1.0, "done")
    return RotorAnswer(
        title=scene.title,
        mass=rotor.mass,
        states=len(rotor.states),
        loads=at.loads,
        residual=at.residual,
        critical_speeds=critical,
        threshold=threshold,
        campbell=chart,
        amplitudes={} if response is None else _amplitudes(response),
        response=response,
        remarks=(
            *oil_remarks(scene.tables, scene.lubricant),
            *shaft_remarks(rotor, bearings, scene.lubricant.properties, float(speeds[-1])),
        ),
    )


def campbell_columns(answer: RotorAnswer) -> dict[str, list[float | None]]:
    """Return the columns of a table of the modes over speed; None where one is overdamped."""
    chart = answer.campbell
    columns: dict[str, list[float | None]] = {"speed [rad/s]": chart.speeds.tolist()}
    for k in range(len(chart.eigenvalues)):
        columns[f"frequency {k} [rad/s]"] = _known(chart.frequency[k])
        columns[f"log decrement {k} [1]"] = _known(chart.log_decrement[k])
        columns[f"direction {k} [1]"] = _known(chart.direction[k])
    return columns


def response_columns(answer: RotorAnswer) -> dict[str, list[float]]:
    """Return the columns of a table of amplitude and phase over speed."""
    if answer.response is None:
        raise InputError("unbalance is required for a response, got a rotor without one")
    columns = {"speed [rad/s]": np.asarray(answer.response.frequency).tolist()}
    for k, name in enumerate(answer.response.output_labels):
        phasor = np.asarray(answer.response.complex)[k, 0]
        unit = _unit(name)
        columns[f"{name} [{unit}]"] = np.abs(phasor).tolist()
        columns[f"{name} phase [rad]"] = np.angle(phasor).tolist()
    return columns


def _known(values: Array) -> list[float | None]:
    return [None if math.isnan(value) else value for value in values.tolist()]


def _amplitudes(response: control.FrequencyResponseData) -> dict[str, Array]:
    values = np.abs(np.asarray(response.complex)[:, 0])
    return {name: values[k] for k, name in enumerate(response.output_labels) if _unit(name) != "m/s"}


def _unit(name: str) -> str:
    if "_force_" in name:
        return "N"
    return "m/s" if name.rpartition("_")[2] in ("vx", "vy") else "m"


def added_unbalance(scene: Scene) -> tuple[UnbalanceTable, ...]:
    """Return the unbalance that excites a shaft; raise InputError for an excitation of another kind.

    Ground that shakes has none; that of a run-up or of a rotor on a motor acts at any speed.
    """
    found = scene.excitation
    if found is None or isinstance(found, GroundTable):
        return ()
    require_kind(found, ("unbalance", "run_up", "motor", "ground"))
    assert isinstance(found, UnbalanceTable)
    return (found,)
