"""What a scene with a flexible rotor is asked: modes over speed, critical speeds, stability, response."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from itertools import pairwise
from typing import TYPE_CHECKING

import numpy as np

from .. import analysis
from ..analysis.closed_loop import LINEAR, driven_by_unbalance
from ..bearings.journal import USUAL_CORRECTION, JournalBearing, MomentCarryingJournal
from ..bearings.journal.table import film_remarks
from ..bearings.thrust.table import pads_load
from ..core.answers import ISOTHERMAL
from ..core.errors import InputError, RotorfilmError
from ..core.model import Array
from ..core.port import Reaction, clearance_of, has_film, minimum_film
from ..core.progress import Report, part_of, silent
from ..core.readable import Drawable, Readable
from ..rotors import ShaftElement, ShaftRotor
from .families import messages, prefixed, remarks_of
from .oil_film_tables import turbulent_remarks
from .shared_tables import GroundTable, Lubricant, UnbalanceTable, oil_remarks, require_kind
from .turbulent_shaft import on_stiff_bearings

if TYPE_CHECKING:
    import control

    from .scene import Scene
    from .shaft_table import CompressorTable, ShaftTable


@dataclass(frozen=True, kw_only=True)
class JournalAtRest(Readable):
    """A journal in its bearing.

    Attributes
    ----------
    speed : float [rad/s]
    load : float [N]
        Across the shaft.
    eccentricity_ratio : float [1]
    minimum_film : float [m]
    temperature : float or None [K]
        Of a film whose heat balances; None for one of given viscosity.
    """

    speed: float
    load: float
    eccentricity_ratio: float
    minimum_film: float
    temperature: float | None = None


@dataclass(frozen=True, kw_only=True)
class RotorAnswer(Drawable):
    """A flexible rotor in its bearings over a range of speeds.

    Attributes
    ----------
    title : str
    mass : float [kg]
        Mass of shaft and disks.
    states : int
    loads : dict of str to ndarray, shape (2,) [N]
        Static load, x and y, on each bearing that reacts across the shaft, at the first speed.
    moments : dict of str to ndarray, shape (2,) [N m]
        Static moment, about x and y, on each bearing that feels tilts, at that speed.
    axial_loads : dict of str to float [N]
        Load that the pads of each thrust bearing carry along z there, of a pair that of both sides together.
    residual : float [1]
        Largest imbalance of forces / weight there.
    critical_speeds : tuple of CriticalSpeed
        Where a whirl has the frequency of the rotation.
    threshold : RotorThreshold
        Where a whirl begins to grow.
    campbell : Campbell
        All whirls over the speed.
    amplitudes : dict of str to ndarray, shape (n_response,)
        Amplitudes over the frequencies of `response`, which are closer about the critical speeds.
        Of each displacement [m] and force on a housing [N] under the unbalance; empty without one.
    response : control.FrequencyResponseData or None
        The same with phases.
    journals : dict of str to JournalAtRest
        Each journal on a film, at rest at the speed of `[operation]`, or at the last one; empty where the
        rotor has no rest at that speed.
    remarks : tuple of str
        What the physics of shaft and films leaves out and should not, at the last speed, and at that of the
        compressor.
    level_one : StabilityLevelOne or None
        Stability by API 617 of a shaft with a `[shaft.compressor]`.
    """

    title: str
    mass: float
    states: int
    loads: Mapping[str, Array]
    moments: Mapping[str, Array]
    axial_loads: Mapping[str, float]
    residual: float
    critical_speeds: tuple[analysis.CriticalSpeed, ...]
    threshold: analysis.RotorThreshold
    campbell: analysis.Campbell
    amplitudes: Mapping[str, Array]
    response: control.FrequencyResponseData | None = field(repr=False)
    journals: Mapping[str, JournalAtRest] = field(default_factory=dict)
    remarks: tuple[str, ...] = ()
    level_one: analysis.StabilityLevelOne | None = None

    def _own_units(self) -> dict[str, str]:
        return {name: amplitude_unit(name) for name in self.amplitudes}


def solve_rotor(scene: Scene, report: Report = silent) -> RotorAnswer:
    """Return what the shaft of a scene does over its speeds.

    Parameters
    ----------
    scene : Scene
        Scene with a shaft; an unbalance as excitation is added to those of the shaft.
    report : callable
        Is told the progress.

    Raises
    ------
    InputError
        If the scene has no shaft, or an excitation of another kind.
    EquilibriumError
        If there is no equilibrium at one of the speeds.
    """
    shaft: ShaftTable = scene.required("shaft", "the analyses of a flexible rotor")
    rotor, bearings, speeds = (
        shaft.build(extra=added_unbalance(scene)),
        shaft.build_bearings(),
        shaft.speeds.build(),
    )
    highest = shaft.highest_frequency or 2.0 * float(speeds[-1])
    report(0.0, "equilibrium")
    at = analysis.rotor_equilibrium(rotor, bearings, float(speeds[0]))
    report(0.05, "modes over speed")
    chart = analysis.campbell(rotor, bearings, speeds, highest)
    report(0.35, "critical speeds")
    critical = analysis.critical_speeds(rotor, bearings, speeds)
    report(0.65, "threshold of stability")
    threshold = analysis.rotor_threshold(rotor, bearings, speeds, report=part_of(report, 0.65, 0.85))
    report(0.85, "unbalance response")
    turned = analysis.resonant_speeds(speeds, critical)
    response = driven_by_unbalance(rotor, bearings, turned) if rotor.assembly.unbalance.any() else None
    found, remarks = None, level_one_remarks(scene) if shaft.compressor is not None else ()
    if shaft.compressor is not None:
        report(0.95, "stability by API 617")
        found = solve_level_one(scene)
    own = (
        *oil_remarks(scene.tables, scene.lubricant),
        *shaft_remarks(rotor, bearings, scene.lubricant.properties, float(speeds[-1])),
        *(response_remarks(response) if response is not None else ()),
    )
    report(1.0, "done")
    return RotorAnswer(
        title=scene.title,
        mass=rotor.mass,
        states=len(rotor.states),
        loads=_static_loads(at, ("x", "y")),
        moments=_static_loads(at, ("tilt_x", "tilt_y")),
        axial_loads={
            one.name: pads_load(bearings[one.name], at.coefficients[one.name].position, at.speed)
            for one in shaft.bearings
            if one.thrust is not None
        },
        residual=at.residual,
        critical_speeds=critical,
        threshold=threshold,
        campbell=chart,
        amplitudes={} if response is None else _amplitudes(response),
        response=response,
        journals=dict(_journals(rotor, bearings, speeds if scene.operation is None else [scene.speed])),
        remarks=(*own, *(line for line in remarks if line not in own)),
        level_one=found,
    )


def _static_loads(at: analysis.RotorEquilibrium, pair: tuple[str, str]) -> dict[str, Array]:
    """Return the static loads of two freedoms, of the bearings that have both."""
    has = {name: film.freedoms for name, film in at.coefficients.items() if {*pair} <= {*film.freedoms}}
    return {name: at.loads[name][[felt.index(one) for one in pair]] for name, felt in has.items()}


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
        unit = amplitude_unit(name)
        columns[f"{name} [{unit}]"] = np.abs(phasor).tolist()
        columns[f"{name} phase [rad]"] = np.angle(phasor).tolist()
    return columns


def _known(values: Array) -> list[float | None]:
    return [None if math.isnan(value) else value for value in values.tolist()]


def _amplitudes(response: control.FrequencyResponseData) -> dict[str, Array]:
    values = np.abs(np.asarray(response.complex)[:, 0])
    labels = enumerate(response.output_labels)
    return {name: values[k] for k, name in labels if not amplitude_unit(name).endswith("/s")}


def amplitude_unit(name: str) -> str:
    """Return the unit of an output of an unbalance response."""
    for part, unit in (("_force_", "N"), ("_moment_", "N m"), ("tilt_rate_", "rad/s"), ("tilt_", "rad")):
        if part in name:
            return unit
    return "m/s" if name.rpartition("_")[2] in ("vx", "vy", "vz") else "m"


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


# What a scene with a compressor is asked: stability by API 617.


def solve_level_one(scene: Scene) -> analysis.StabilityLevelOne:
    """Return the stability analysis of level I of the compressor of a scene.

    Parameters
    ----------
    scene : Scene
        Scene with a table `[shaft.compressor]`.

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
    return analysis.stability_level_one(
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
        Scene with a table `[shaft.compressor]`.

    Raises
    ------
    InputError
        If the scene has none.
    """
    shaft, table = _compressor(scene)
    rotor, oil = shaft.build(), scene.lubricant.properties
    told_at = {
        name: shaft_remarks(rotor, bearings, oil, table.speed)
        for name, bearings in table.cases(shaft.bearings).items()
    }
    common = [
        line for line in next(iter(told_at.values())) if all(line in lines for lines in told_at.values())
    ]
    own = [f"{name}: {line}" for name, lines in told_at.items() for line in lines if line not in common]
    return (*oil_remarks(scene.tables, scene.lubricant), *common, *own)


def _compressor(scene: Scene) -> tuple[ShaftTable, CompressorTable]:
    """Return the tables of a compressor; InputError where there are none."""
    if scene.shaft is None or scene.shaft.compressor is None:
        raise InputError("shaft.compressor is required for stability by API 617, got no such table")
    return scene.shaft, scene.shaft.compressor


def _journals(
    rotor: ShaftRotor, bearings: Mapping[str, Reaction], speeds: Sequence[float] | Array
) -> Iterator[tuple[str, JournalAtRest]]:
    """Yield station and rest of the journals on films, at the last of the speeds; none without a rest."""
    try:
        at = analysis.rotor_equilibrium(rotor, bearings, float(speeds[-1]))
    except RotorfilmError:
        return
    for name, film in at.coefficients.items():
        if has_film(bearings[name]):
            yield (
                name,
                JournalAtRest(
                    speed=at.speed,
                    load=float(np.linalg.norm(at.loads[name][:2])),
                    eccentricity_ratio=float(np.linalg.norm(film.position[:2]))
                    / clearance_of(bearings[name]),
                    minimum_film=float(minimum_film(bearings[name], film.position)),
                    temperature=at.temperatures.get(name),
                ),
            )


# What the physics of all rungs leaves out of a flexible rotor.


UNLOADED = 1e-9
"""Load of a bearing over the weight of the rotor, below which it is roundoff."""


def shaft_remarks(
    rotor: ShaftRotor, bearings: Mapping[str, Reaction], oil: Lubricant, speed: float
) -> tuple[str, ...]:
    """Return the neglected effects that matter, one line each, of a shaft in its bearings at a speed."""
    at = on_stiff_bearings(rotor, bearings, speed)
    lines = list(beam_remarks(rotor))
    for name, given in bearings.items():
        tilted = isinstance(given, MomentCarryingJournal)
        bearing = given.bearing if isinstance(given, MomentCarryingJournal) else given
        if isinstance(bearing, JournalBearing):
            x, y = at.loads[name].tolist()[:2]
            if math.hypot(x, y) <= UNLOADED * float(np.linalg.norm(rotor.assembly.weight)):
                none = "it carries none, so that its film has no stiffness along a load"
                lines.append(f"{name}: load: {none} and may whirl at any speed")
                continue
            found = (*turbulent_remarks(bearing, speed, (x, y)), *film_remarks(bearing, oil, speed, (x, y)))
            found += () if tilted else tilt_remarks(rotor, name, bearing, at)
            lines += prefixed(f"{name}, at {speed:.4g} rad/s: ", found)
    return tuple(lines)


def response_remarks(response: control.FrequencyResponseData) -> Iterator[str]:
    """Yield which journals move too far for their films to be linear, of a response to unbalance."""
    for name, (share, speed) in response.largest_moves.items():
        touching = share > 1.0
        numbers = {
            "share": share if LINEAR < share <= 1.0 else math.nan,
            "touching": share if touching else math.nan,
            "rpm": speed * 30.0 / math.pi,
        }
        yield from prefixed(f"{name}: ", messages(remarks_of("response"), numbers))


def tilt_remarks(
    rotor: ShaftRotor, name: str, bearing: JournalBearing, at: analysis.RotorEquilibrium
) -> tuple[str, ...]:
    """Return what the tilt of a sagging shaft would do to a bearing that leaves it out, if that matters.

    The aligned film is that of a plain bearing under the same load.
    """
    stations = tuple(replace(one, feels_tilt=one.name == name) for one in rotor.stations)
    tilts = replace(rotor, stations=stations).structure.tilts
    assert tilts is not None  # of one station
    warm = bearing.at_temperature(bearing.coldest()) if bearing.is_warming else bearing
    sizes = {key: getattr(warm, key) for key in ("radius", "length", "clearance")}
    plain = JournalBearing(**sizes, viscosity=warm.film_viscosity)
    try:
        film = analysis.equilibrium(plain, at.loads[name][:2], at.speed).minimum_film
    except RotorfilmError:
        return ()  # the answer says what is wrong
    shift = 0.5 * plain.length * float(np.linalg.norm(tilts @ at.displacement))
    correction = USUAL_CORRECTION * (shift / film) ** 2
    numbers = {"shift": shift / plain.clearance, "share": shift / film, "correction": correction}
    return messages(remarks_of("tilt"), {**numbers, "twice": 2.0 * correction})


def shaft_physics(bearings: Mapping[str, Reaction]) -> str:
    """Return the physics in which the answers of a shaft are meant: that of its films, if it has some."""
    return ISOTHERMAL if any(isinstance(bearing, JournalBearing) for bearing in bearings.values()) else ""


def beam_remarks(rotor: ShaftRotor) -> tuple[str, ...]:
    """Return where a shaft is no beam, one line each."""
    pieces = [element for element in rotor.elements if isinstance(element, ShaftElement)]
    if not pieces:
        return ()
    length, diameters = sum(piece.length for piece in pieces), [piece.outer_diameter for piece in pieces]
    largest = max((max(a, b) / min(a, b) for a, b in pairwise(diameters)), default=1.0)
    return messages(remarks_of("beam"), {"slenderness": length / max(diameters), "step": largest})


def stability_remark(rotor: ShaftRotor, bearings: Mapping[str, Reaction], speed: float) -> tuple[str, ...]:
    """Return that a rotor whirls by itself, if the model of the file does: no orbit is steady then."""
    try:
        modes = analysis.rotor_modes(rotor, bearings, speed)
    except RotorfilmError:
        return ()  # the rungs say what is wrong
    growth = modes.eigenvalues.real / np.abs(modes.eigenvalues)
    if not growth.size:
        return ()
    k = int(np.argmax(growth))
    return messages(remarks_of("whirl"), {"growth": growth[k], "whirl": modes.frequency[k] / abs(speed)})
