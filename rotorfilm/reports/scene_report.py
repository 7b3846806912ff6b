"""The report of a scene: its machine, inputs, assumptions, results, verdicts, models, errors and versions."""

from __future__ import annotations

import platform
import time
import warnings
from collections.abc import Callable, Iterator, Mapping
from contextlib import suppress
from dataclasses import replace
from importlib.metadata import version
from typing import TYPE_CHECKING, Any

import numpy as np

from .. import analysis, charts
from ..bearings.damper.answer import DamperAnswer
from ..bearings.journal import JournalBearing, ReynoldsFilm, film_state
from ..bearings.seal import AnnularSeal
from ..bearings.thrust.table import ThrustAnswer
from ..charts import CurveMark, Picture, PicturePanel
from ..core.answers import LeftOutRemark, QuestionAnswer
from ..core.errors import InputError, RotorfilmError, SceneError, ValidityWarning, require_positive
from ..core.frames import Column, ResultTable
from ..core.progress import Report as Progress, silent
from ..core.readable import Readable, Row, column_scale, label_of
from ..scenes import Scene
from ..scenes.film_answer import Answer
from ..scenes.new_scene import scene_text
from ..scenes.reading import quantity_of
from ..scenes.shared_tables import kind_of
from ..scenes.solve_shaft import RotorAnswer, added_unbalance
from ..sweeps import sweep, tolerance_study
from .answer_rows import RPM, answer_rows, damper_rows, level_one_rows, rotor_rows, seconds_text
from .motions import FollowedMotion, followed
from .page import Block, Report, ReportSection, Verdict

if TYPE_CHECKING:
    import xarray

MOVING = ("blade_loss", "run_up", "motor", "ground")
"""Excitations that are followed over time."""

AGAINST_SPEED = ("amplitude", "waterfall", "spectrogram", "orbits")
STEADY = ("orbit", "windows", "spectrum", "full_spectrum")
"""Pictures of a run whose speed changes, and of another."""

SHAPES = 3
"""Modes that are drawn in space."""

PRESSURE = ReynoldsFilm(cells=(144, 12))
"""Film of the pressure that is drawn."""

MAIN = ("minimum film", "temperature", "highest pressure", "maximum pressure", "power loss")
"""Rows of an answer that a summary repeats."""

PACKAGES = ("rotorfilm", "numpy", "scipy", "control")


def report_scene(
    scene: Scene,
    *,
    operating: tuple[float, float] | None = None,
    vary: Mapping[str, Any] | None = None,
    tolerances: Mapping[str, Any] | None = None,
    quantity: str = "",
    samples: int = 200,
    report: Progress = silent,
) -> Report:
    """Return the report of a scene, of which `save("report.html")` makes one page.

    A scene is answered as by `Scene.solve`; one whose excitation is a blade loss, a run-up, a motor or
    ground that shakes is followed over time too.

    Parameters
    ----------
    scene : Scene
    operating : (float, float), optional [rad/s]
        Operating range of a shaft, for the checks of API 617; by default the speed of its compressor or of
        `[operation]` alone.
    vary : mapping of str to sequence, optional
        Keys and their values, for a sweep; see `sweep`.
    tolerances : mapping of str to float or str, optional
        Keys and their largest deviations, for a study of tolerances; see `tolerance_study`.
    quantity : str
        What the study of tolerances is about.
    samples : int
        Of that study.
    report : callable
        Is told the progress.

    Raises
    ------
    InputError
        If the operating range is none, or the scene has no shaft for it.
    RotorfilmError
        Where the scene has no answer.
    """
    _check_operating(scene, operating)
    answer, motion = None, None
    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always", ValidityWarning)
        if _moves(scene):
            motion = followed(scene, full=False, fmus=False, report=report)
        if motion is None or scene.has_film or scene.shaft or scene.question:
            answer = scene.solve(report)
        parts = list(_results(scene, answer, operating))
        if scene.question is not None and (scene.has_film or scene.shaft or scene.damper):
            with suppress(
                RotorfilmError
            ):  # a question may have an answer where the film of the file has none
                parts += _results(scene, replace(scene, question=None).solve(report), operating)
        parts += [_motion(motion)] if motion else []
        parts += study_sections(scene, vary or {}, tolerances or {}, quantity, samples)
    told = [str(one.message) for one in caught if issubclass(one.category, ValidityWarning)]
    found = Report(scene.title, tuple(parts))
    sections = (
        ReportSection("Summary", [*found.verdicts, *_main(answer, motion)]),
        ReportSection("Machine", list(_machine(scene))),
        ReportSection("Inputs", [_inputs(scene)]),
        ReportSection("Assumptions and effects left out", list(_left_out(answer, told))),
        *parts,
        ReportSection("Models and versions", list(_models(answer))),
    )
    files = {"scene.toml": scene_text(scene.given)} if scene.given else {}
    return Report(scene.title, tuple(one for one in sections if one.blocks), files)


def _check_operating(scene: Scene, operating: tuple[float, float] | None) -> None:
    if operating is None:
        return
    if scene.shaft is None:
        raise InputError("operating must be of a scene with a [shaft], got one without")
    for speed in operating:
        require_positive("operating", speed)
    if len(operating) != 2 or operating[0] > operating[1]:
        raise InputError(f"operating must be the first and the last speed, got {operating} rad/s")


def _moves(scene: Scene) -> bool:
    """Return whether a scene is followed over time."""
    kind = kind_of(scene.excitation)
    on_film = kind == "unbalance" and scene.rigid_rotor is not None and scene.has_film
    return kind in MOVING or on_film or (scene.contact is not None and scene.excitation is not None)


def _main(answer: Any, motion: FollowedMotion | None) -> Iterator[Block]:
    """Yield the main results of a summary."""
    rows = [] if answer is None else answer_rows(answer)
    if isinstance(answer, QuestionAnswer):
        yield rows[:2]
    elif main := [(name.strip(), text) for name, text in rows if name.removeprefix("  ") in MAIN]:
        yield main
    elif answer is None and motion:
        yield motion.rows


# The machine and what was given.


def _machine(scene: Scene) -> Iterator[Block]:
    if scene.shaft is not None:
        rotor, bearings = _shaft(scene)
        yield charts.plot_rotor(rotor, bearings)
        yield ResultTable(
            (
                Column("part", "", ["shaft and disks", "disks"]),
                Column("mass", "kg", np.array([rotor.mass, sum(one.mass for one in rotor.disks)])),
            ),
            f"{len(rotor.elements)} elements, {len(rotor.disks)} disks, {len(rotor.stations)} bearings",
        )
        return
    with suppress(InputError, AttributeError):  # a contact has no bearing to draw
        if scene.thrust is not None:
            bearing = scene.thrust.one_side()
        else:
            bearing = scene.damper.build() if scene.damper is not None else scene.bearing
        yield charts.plot_bearing(getattr(bearing, "bearing", bearing))


def _shaft(scene: Scene) -> tuple[Any, dict[str, Any]]:
    return scene.shaft.build(extra=added_unbalance(scene)), scene.shaft.build_bearings()


def _inputs(scene: Scene) -> ResultTable:
    """Return the keys of a scene as they were read, and in SI."""
    rows = [row for key, value in scene.given.items() for row in _leaves((key,), value)]
    names = ("key", "as read", "in SI")
    return ResultTable(
        tuple(Column(name, "", [row[k] for row in rows]) for k, name in enumerate(names)), "Inputs"
    )


def _leaves(path: tuple[str, ...], value: Any) -> Iterator[tuple[str, str, str]]:
    """Yield key, text and value in SI of everything in a table of a scene."""
    inner = list(value.items()) if isinstance(value, Mapping) else []
    if isinstance(value, list) and any(isinstance(one, Mapping) for one in value):
        inner = [(str(k), one) for k, one in enumerate(value)]
    for key, one in inner:
        yield from _leaves((*path, key), one)
    if not inner:
        reader = quantity_of(Scene, path)
        known = reader is not None and not isinstance(value, list)
        number = f"{reader.parse(value):.6g} {reader.unit.removeprefix('1')}" if known else ""  # type: ignore[union-attr]
        yield ".".join(path), str(value), number


def _left_out(answer: Any, told: list[str]) -> Iterator[Block]:
    """Yield what was assumed, and what the physics leaves out with its size."""
    remarks = [*getattr(answer, "remarks", ())]
    sizes: dict[str, float] = {}
    for one in remarks:
        if isinstance(one, LeftOutRemark) and one.name:
            sizes[one.name] = max(one.size, sizes.get(one.name, 0.0))
    if sizes:
        yield ResultTable(
            (Column("effect", "", list(sizes)), Column("size", "1", np.array(list(sizes.values())))),
            "Effects that are left out, relative to the answer",
        )
    for remark in remarks:
        yield Verdict("left out", None, str(remark))
    for line in getattr(answer, "assumptions", ()):
        yield Verdict("assumed, as nobody gave it", None, line)
    for line in dict.fromkeys(told):
        if line.removeprefix("left out: ") not in remarks:
            yield Verdict("warned", None, line)
    yield "Unless the inputs say otherwise, films are laminar and of one temperature, and shafts linear."


def _models(answer: Any) -> Iterator[Block]:
    """Yield the models behind an answer with their errors, and the versions of all that computed it."""
    if isinstance(answer, QuestionAnswer):
        rungs = answer.rungs
        errors = [np.nan if one.error_estimate is None else one.error_estimate for one in rungs]
        yield ResultTable(
            (
                Column("model", "", [one.name for one in rungs]),
                Column("verdict", "", [one.verdict for one in rungs]),
                Column("error", "1", np.array(errors), "estimated error"),
                Column("cost", "", [seconds_text(one.cost) for one in rungs]),
                Column("method", "", [one.method or one.reason for one in rungs], "how it is known"),
            ),
            "Models that may answer, the cheapest first",
        )
        yield charts.plot_question(answer)
    elif isinstance(answer, Answer):
        yield [("film", answer.model), ("residual of the equilibrium", f"{answer.equilibrium.residual:.2g}")]
    elif isinstance(answer, RotorAnswer):
        yield [("residual of the equilibrium", f"{answer.residual:.2g}"), ("states", str(answer.states))]
    yield [
        *((name, version(name)) for name in PACKAGES),
        ("Python", f"{platform.python_version()} on {platform.platform()}"),
        ("made", time.strftime("%Y-%m-%d %H:%M UTC", time.gmtime())),
    ]


# Results by kind.


def _results(scene: Scene, answer: Any, operating: tuple[float, float] | None) -> Iterator[ReportSection]:
    match answer:
        case QuestionAnswer():
            fine = Verdict(answer.quantity.replace("_", " "), answer.met, answer.message)
            yield ReportSection("Answer", [fine, answer_rows(answer)])
        case RotorAnswer():
            yield from _rotor(scene, answer, operating)
        case Answer():
            yield ReportSection("Equilibrium, stiffness and damping", list(_film(scene, answer)))
        case DamperAnswer():
            stable, count = sum(orbit.stable for orbit in answer.orbits), len(answer.orbits)
            told = f"orbits at this unbalance: {count}, stable: {stable}; jumps over it: {len(answer.folds)}"
            if not count:
                told = "no orbit: the rotor hits the wall"
            kinds = ("transmissibility", "eccentricity", "phase")
            pictures = [charts.picture_of(answer.response, kind) for kind in kinds]
            fine = Verdict("orbit on the damper", stable == count == 1, told)
            yield ReportSection("Orbits", [fine, damper_rows(answer), *pictures])
        case ThrustAnswer():
            pressed: list[Block] = [answer_rows(answer), _pad_pressure(scene, answer)]
            yield ReportSection("Equilibrium, stiffness and damping", pressed)
        case Readable():
            yield ReportSection("Results", [answer_rows(answer)])


def _pad_pressure(scene: Scene, answer: ThrustAnswer) -> Picture:
    """Return the pressure on a pad, the same on all of the side of the collar that the load presses."""
    at = answer.equilibrium
    bearing = scene.thrust.build()
    if at.temperature is not None:
        bearing = bearing.at_temperature(at.temperature)
    sides = getattr(bearing, "reactions", (bearing,))
    each = [side.pressure(0, at.position, np.zeros(3), scene.speed) for side in sides]
    shown = max(each, key=lambda one: float(one.pressure.max()))
    return charts.plot_pad_pressure(shown, title=f"Pressure on each of {answer.bearing.pads} pads")


def _film(scene: Scene, answer: Answer) -> Iterator[Block]:
    """Yield rows, verdict and pictures of a bearing with a film."""
    found, speed = answer.whirl_threshold, abs(scene.speed)
    if found is not None:
        fine = found.speed is None or found.speed > speed
        text = found.reason or f"whirl begins at {(found.speed or 0.0) * RPM:.5g} rpm"
        yield Verdict(
            "stability of the rigid rotor", fine, f"{text}; the shaft turns at {speed * RPM:.5g} rpm"
        )
    yield answer_rows(answer)
    bearing, at = scene.bearing, answer.equilibrium
    if isinstance(bearing, JournalBearing):
        state = film_state(replace(bearing, film=PRESSURE), at.position, (0.0, 0.0), scene.speed)
        yield f"Pressure by a two-dimensional film on {PRESSURE.cells[0]} x {PRESSURE.cells[1]} cells."
        yield charts.picture_of(state)
        yield charts.picture_of(state, "circumference")
    with suppress(RotorfilmError):  # not every bearing has an equilibrium at every speed
        speeds = np.sort(np.linspace(0.5, 1.5, 11) * scene.speed)
        table = analysis.coefficient_table(bearing, scene.static_load, speeds)
        yield table.to_table()
        yield charts.picture_of(table)


def _rotor(
    scene: Scene, answer: RotorAnswer, operating: tuple[float, float] | None
) -> Iterator[ReportSection]:
    """Yield the sections of a flexible rotor."""
    rotor, bearings = _shaft(scene)
    compressor = scene.shaft.compressor
    last = compressor.speed if compressor else abs(scene.operation.speed) if scene.operation else 0.0
    first, last = operating or (last, last)
    speed = last or float(answer.campbell.speeds[-1])
    modes = analysis.rotor_modes(
        rotor, bearings, speed, highest_frequency=scene.shaft.highest_frequency or 2.0 * speed
    )
    shown = range(min(SHAPES, len(modes.eigenvalues)))
    yield ReportSection(
        "Modes and critical speeds",
        [
            *_threshold(answer, last),
            rotor_rows(replace(answer, remarks=(), level_one=None)),
            f"Modes at {speed * RPM:.5g} rpm.",
            *modes._pages(),
            *answer.campbell._pages(),
            charts.picture_of(answer),
            charts.picture_of(answer, "log_decrement"),
            *(charts.plot_mode_orbits(rotor, modes, k) for k in shown),
        ],
    )
    if answer.response is not None:
        bode = charts.plot_unbalance_response(
            answer.response,
            peak_to_peak=True,
            critical=answer.critical_speeds,
            threshold=answer.threshold.speed,
        )
        blocks: list[Block] = [bode]
        if last:
            blocks += _checks(answer.response, bearings, (first, last))
        blocks.append(charts.picture_of(analysis.deflected_shape(rotor, bearings, speed), "orbits"))
        yield ReportSection("Unbalance response", blocks)
    if compressor:
        yield ReportSection("Stability by API 617", list(_certified(answer, rotor, bearings, speed)))


def _threshold(answer: RotorAnswer, last: float) -> Iterator[Verdict]:
    found = answer.threshold
    text = found.reason or f"a whirl grows from {(found.speed or 0.0) * RPM:.5g} rpm on"
    if last:
        text += f"; the highest operating speed is {last * RPM:.5g} rpm"
    yield Verdict("threshold of stability", found.speed is None or found.speed > last if last else None, text)


def _checks(response: Any, bearings: Mapping[str, Any], operating: tuple[float, float]) -> Iterator[Block]:
    """Yield separation margins and clearances by API 617, or why there are none."""
    clearances = {
        name: one.clearance for name, one in bearings.items() if isinstance(one, JournalBearing | AnnularSeal)
    }
    checks: dict[str, Callable[[], Any]] = {
        "separation margins": lambda: analysis.separation_margins(response, *operating)
    }
    if clearances:
        checks["running clearances"] = lambda: analysis.clearance_check(response, clearances, *operating)
    for name, check in checks.items():
        try:
            found = check()
        except InputError as error:
            yield Verdict(name, None, f"not checked: {error}")
            continue
        yield Verdict(f"API 617, {name}", found.acceptable, found.verdict)
        yield from found._pages() or [_peaks(found)]
        yield charts.picture_of(found)


def _peaks(found: analysis.SeparationMargins) -> list[Row]:
    return [
        (
            f"{one.output} at {one.speed * RPM:.5g} rpm",
            f"amplification factor {one.amplification_factor:.3g}, margin {one.separation_margin:.1%}, "
            f"required {one.required_margin:.1%}",
        )
        for one in found.peaks
    ]


def _certified(answer: RotorAnswer, rotor: Any, bearings: Mapping[str, Any], speed: float) -> Iterator[Block]:
    """Yield levels I and II."""
    if answer.level_one is not None:
        yield Verdict("API 617, level I", not answer.level_one.level_two_required, answer.level_one.verdict)
        yield level_one_rows(answer.level_one)
        yield charts.picture_of(answer.level_one)
    try:
        found = analysis.stability_level_two(rotor, bearings, speed)
    except (RotorfilmError, SceneError) as error:
        yield Verdict("API 617, level II", None, f"not checked: {error}")
        return
    yield Verdict("API 617, level II, bearings and seals as they are", found.acceptable, found.verdict)


def _motion(found: FollowedMotion) -> ReportSection:
    """Return what a run over time shows."""
    run = found.trajectory
    changes = "speed" in run.signals and np.ptp(run["speed"]) > 1e-3 * np.abs(run["speed"]).max()
    pictures = [] if found.shown is run else [charts.picture_of(found.shown)]
    for kind in AGAINST_SPEED if changes else STEADY:
        with suppress(InputError):  # a ball on a contact has no orbit, a short run no spectrum
            pictures.append(charts.picture_of(run, kind))
    blocks: list[Block] = [found.rows, *pictures]
    return ReportSection(
        "Motion over time", [Verdict("contact", False, found.failure), *blocks] if found.failure else blocks
    )


# A scene at many values of its keys: sweeps and studies of tolerances.


def study_sections(
    scene: Scene, vary: Mapping[str, Any], tolerances: Mapping[str, Any], quantity: str, samples: int
) -> list[ReportSection]:
    """Return the sections of a sweep and of a study of tolerances, those that are asked for."""
    found = []
    if vary:
        found.append(ReportSection("Sweep", sweep_blocks(sweep(scene.given, vary, workers=1))))
    if tolerances:
        study = tolerance_study(scene.given, tolerances, quantity, samples=samples, workers=1)
        pictures = [charts.picture_of(study), charts.picture_of(study, "tornado")]
        found.append(ReportSection("Tolerances", [study._rows(), *study._pages(), *pictures]))
    return found


def sweep_blocks(found: xarray.Dataset) -> list[Block]:
    """Return the table of a sweep, and its pictures over one key or two."""
    keys = [name for name in found.coords if "key" in found[name].attrs]
    numbers = [
        name
        for name in found.data_vars
        if found[name].dtype.kind == "f" and found[name].dims == found["failure"].dims
    ]
    frame = found[[*numbers, "model", "failure"] if "model" in found else [*numbers, "failure"]]
    flat = frame.to_dataframe().reset_index()
    units = {name: found[name].attrs.get("units", "") for name in (*keys, *numbers)}
    table = ResultTable(
        tuple(Column(str(name), units.get(name, ""), flat[name].to_numpy()) for name in flat), "Points"
    )
    lines = len(keys) == 1 and found[keys[0]].dtype.kind in "fi"
    maps = (
        len(keys) == 2 and found["failure"].ndim == 2 and all(found[key].dtype.kind in "fi" for key in keys)
    )
    pictures = [_line(found, keys[0], name) for name in numbers if lines]
    pictures += [_map(found, keys, name) for name in numbers if maps]
    return [table, *pictures]


def _scaled(found: xarray.Dataset, name: Any) -> tuple[str, np.ndarray]:
    """Return the label of a quantity with its unit, and its numbers in that."""
    unit, values = column_scale(str(name), found[name].attrs.get("units", ""), found[name].values)
    return f"{label_of(str(name))} [{unit or '1'}]", values


def _line(found: xarray.Dataset, key: Any, name: Any) -> Picture:
    (along, x), (label, y) = _scaled(found, key), _scaled(found, name)
    return Picture((PicturePanel([CurveMark(x, y, marker="o")], along, label),), size=(6.4, 3.6))


def _map(found: xarray.Dataset, keys: list[Any], name: Any) -> Picture:
    (along, x), (upright, y), (label, values) = (_scaled(found, one) for one in (*keys, name))
    return charts.plot_map(x, y, np.transpose(values), labels=(along, upright, label))
