"""The pictures of each result, which its `plot()` draws, and those of studies over parameters."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from ..analysis import VariableCompliance
from ..bearings.contact import ContactRun
from ..core.answers import QuestionAnswer
from ..core.errors import InputError, require_finite
from ..core.inputs import require_choice
from ..core.readable import column_scale, label_of
from ..studies import BallCurves
from . import film_charts, rotor_charts, run_charts
from .picture import BarsMark, ColorScale, CurveMark, FieldMark, LevelMark, Mark, Picture, PicturePanel
from .shaft_charts import plot_deflected_orbits, plot_deflected_shape, plot_rotor

GRAM_MILLIMETER = 1e-6

Describe = Callable[[Any], Picture]


def picture_of(result: Any, kind: str = "") -> Picture:
    """Return a picture of a result, by its kind; the first of its class by default.

    Parameters
    ----------
    result : object
        What has `plot()`.
    kind : str

    Raises
    ------
    InputError
        If there is no picture of this kind or of this object; the message lists those that there are.
    """
    name = next((one.__name__ for one in type(result).__mro__ if one.__name__ in PICTURES), "")
    if not name:
        raise InputError(
            f"result must be one of {', '.join(PICTURES)}, got a {type(result).__name__}; functions such as "
            "charts.plot_unbalance_response draw other objects"
        )
    kinds = PICTURES[name]
    if kind:
        require_choice(f"kind of picture of a {name}", kind, kinds)
    return kinds[kind or next(iter(kinds))](result)


def plot_result(result: Any, kind: str = "", *, axes: Any = None, backend: str = "") -> Any:
    """Draw a picture of a result: what its `plot()` calls, whose parameters these are."""
    return picture_of(result, kind).shown(axes, backend)


def plot_question(answer: QuestionAnswer) -> Picture:
    """Describe the ladder behind an answer: the estimated error of each rung that was tried over its cost."""
    points = [
        (one.name, error, cost, one.name == answer.model)
        for one in answer.rungs
        if (error := one.error_estimate) is not None and (cost := one.cost) is not None
    ]
    return plot_scene_ladder(points, title=label_of(answer.quantity), tolerance=answer.tolerance)


def plot_contact_run(run: ContactRun) -> Picture:
    """Describe the central and the smallest film of a contact over time, in units of the Hertzian contact."""
    marks: list[Mark] = [
        CurveMark(run.time, run.central_film, "central film"),
        CurveMark(run.time, run.minimum_film, "smallest film", "C1", "--"),
    ]
    return Picture((PicturePanel(marks, "time", "film thickness", "Film of the contact"),))


def plot_scene_ladder(
    points: Sequence[tuple[str, float, float, bool]], *, title: str, tolerance: float
) -> Picture:
    """Describe the estimated error of each model over its cost, the tolerance, and the model that answers.

    Parameters
    ----------
    points : sequence of (str, float, float, bool)
        Name of a model, its estimated error [1], the cost of its answer [s], and whether it is chosen.
    title : str
    tolerance : float [1]
    """
    marks: list[Mark] = []
    for number, (name, error, cost, chosen) in enumerate(points):
        marker, size, label = ("*", 16.0, f"{name}, chosen") if chosen else ("o", 6.0, name)
        marks.append(CurveMark([1e3 * cost], [error], label, f"C{number % 10}", "", marker=marker, size=size))
    marks.append(LevelMark(tolerance, "tolerance", dash="--"))
    panel = PicturePanel(marks, "cost of the answer [ms]", "estimated error", title, log="xy")
    return Picture((panel,), size=(7.5, 5.0))


# Over parameters: maps of two, sensitivities, scatter.


def plot_map(
    x: ArrayLike, y: ArrayLike, values: ArrayLike, *, labels: tuple[str, str, str], level: float | None = None
) -> Picture:
    """Describe a quantity over two parameters, such as a stability map, and the line of one value.

    Parameters
    ----------
    x, y : array_like, shape (n,), (m,)
    values : array_like, shape (m, n)
    labels : (str, str, str)
        Labels of x, y and the values, with units.
    level : float, optional
        Whose line is drawn, as 0 of a log decrement or a growth rate, the border of stability.

    Raises
    ------
    InputError
        If the shapes do not fit.
    """
    across, upright = require_finite("x", x), require_finite("y", y)
    table = np.asarray(values, dtype=float)
    if table.shape != (upright.size, across.size):
        raise InputError(f"values must have shape {(upright.size, across.size)}, got {table.shape}")
    colors = ColorScale(labels[2])
    if level is not None:
        far = float(np.nanmax(np.abs(table - level)))
        colors = ColorScale(labels[2], "RdYlGn", level - far, level + far)
    field = FieldMark(across, upright, table, colors, None if level is None else table, level or 0.0, "k")
    return Picture((PicturePanel([field], *labels[:2]),), size=(7.0, 5.0))


def plot_tornado(effects: Mapping[str, tuple[float, float]], *, base: float, quantity: str) -> Picture:
    """Describe sensitivities as a tornado chart: what each parameter does to a quantity, the largest above.

    Parameters
    ----------
    effects : mapping of str to (float, float)
        Quantity at the low and at the high end of each parameter.
    base : float
        Quantity at the nominal parameters.
    quantity : str
        Its label, with its unit.
    """
    order = sorted(effects, key=lambda name: float(np.nan_to_num(np.ptp(effects[name]))))
    low, high = (np.array([effects[name][side] for name in order]) for side in (0, 1))
    names = np.array(order)
    marks: list[Mark] = [
        BarsMark(names, low, "low end", "C0", 0.6, base, across=True),
        BarsMark(names, high, "high end", "C1", 0.6, base, across=True),
        LevelMark(base, f"nominal, {base:.4g}", upright=True),
    ]
    return Picture((PicturePanel(marks, quantity, "", "Sensitivities"),), size=(7.4, 1.5 + 0.5 * len(order)))


def plot_histogram(values: ArrayLike, *, quantity: str, bins: int = 30) -> Picture:
    """Describe how a quantity scatters, as over manufactured bearings, with 5 %, 50 % and 95 % of them.

    Parameters
    ----------
    values : array_like, shape (n,)
    quantity : str
        Its label, with its unit.
    bins : int
    """
    found = require_finite("values", values).ravel()
    counts, edges = np.histogram(found, bins)
    marks: list[Mark] = [BarsMark(0.5 * (edges[1:] + edges[:-1]), counts, width=float(edges[1] - edges[0]))]
    for share, dash in ((0.05, ":"), (0.5, "--"), (0.95, ":")):
        at = float(np.quantile(found, share))
        marks.append(LevelMark(at, f"{share:.0%} below {at:.4g}", dash=dash, upright=True))
    return Picture((PicturePanel(marks, quantity, "count", f"{found.size} samples"),))


# Ball bearings: loads, contact angles and stiffness over speed, swing.


RPM = 30.0 / math.pi
SHOWN = 8
"""Harmonics of the ball-pass frequency that are drawn."""


def plot_ball_curves(result: BallCurves) -> Picture:
    """Describe load distribution, contact angles over speed, stiffness over speed and preload, and swing."""
    around = np.degrees(np.mod(result.ball_angle, 2.0 * math.pi))
    order, last, speeds = np.argsort(around), len(result.speeds) - 1, RPM * result.speeds
    loads, stiffness = [], []
    for c, k in enumerate(sorted({0, last // 2, last})):
        label = f"inner, {speeds[k]:.5g} rpm"
        loads.append(CurveMark(around[order], result.inner_load[k][order], label, f"C{c}", marker="o"))
        outer = around[order], result.outer_load[k][order], "outer", f"C{c}", "--"
        loads.append(CurveMark(*outer, marker="s", filled=False))
    for k, preload in enumerate(result.preloads):
        radial, axial = 1e-6 * result.radial_stiffness[k], 1e-6 * result.axial_stiffness[k]
        stiffness.append(CurveMark(speeds, radial, f"radial, {preload:g} N", f"C{k}"))
        stiffness.append(CurveMark(speeds, axial, f"axial, {preload:g} N", f"C{k}", "--"))
    angles = [
        CurveMark(speeds, np.degrees(result.inner_angle), "inner", "C0"),
        CurveMark(speeds, np.degrees(result.outer_angle), "outer", "C1", "--"),
    ]
    loaded = f"Load distribution, {result.thrust:g} N along z, {result.load:g} N along -y"
    thrust = f"Contact angles under {result.thrust:g} N of thrust"
    pairs = "Back-to-back pairs, by the preload at which they are clamped"
    panels = (
        PicturePanel(loads, "place of the ball from +x [deg]", "contact load [N]", loaded),
        PicturePanel(angles, "speed [rpm]", "contact angle [deg]", thrust),
        PicturePanel(stiffness, "speed [rpm]", "stiffness [N/um]", pairs, y_limits=(0.0, None)),
        plot_compliance(result.swing).panels[0],
    )
    return Picture(panels, columns=2, size=(6.25, 4.3))


def plot_compliance(result: VariableCompliance) -> Picture:
    """Describe the spectrum of the swing of a shaft as balls pass, at multiples of their frequency."""
    orders = np.arange(1, min(SHOWN, result.swing_amplitude.shape[1]) + 1)
    passing = result.ball_pass_frequency / (2.0 * math.pi)
    unit, tops = passing or 1.0, 1e9 * result.swing_amplitude
    marks = [
        BarsMark((orders + side) * unit, tops[k, : orders.size], name, color, 0.18 * unit)
        for k, (name, side, color) in enumerate((("x", -0.1, "#d62728"), ("y", 0.1, "#1f4fb4")))
    ]
    panel = PicturePanel(
        marks,
        "frequency [Hz]" if passing else "multiple of the ball-pass frequency",
        "amplitude of the shaft, zero-to-peak [nm]",
        f"Motion under {math.hypot(*result.load):.4g} N, ball-pass frequency {passing:.4g} Hz",
        log="y",
        y_limits=(1e-3 * tops.max(), 3.0 * tops.max()),
    )
    return Picture((panel,))


def _synchronous(plot: Callable[..., Picture]) -> Describe:
    """Return a picture of the orbits of a damper over the unbalance [g mm]."""

    def describe(orbits: Any) -> Picture:
        picture = plot({"orbits": orbits}, unit=GRAM_MILLIMETER)
        return picture._replace(panels=(picture.panels[0]._replace(x="unbalance [g mm]"),))

    return describe


def _of_trajectory(describe: Describe) -> Describe:
    return lambda found: describe(found.trajectory)


def _run(result: Any) -> Picture:
    return film_charts.plot_damper_run(result.trajectory.time, result.eccentricity_ratio, result.force)


def _scatter(study: Any) -> Picture:
    unit, values = column_scale(study.quantity, study.unit, study.values[np.isfinite(study.values)])
    return plot_histogram(values, quantity=f"{label_of(study.quantity)} [{unit or '1'}]")


def _tornado(study: Any) -> Picture:
    found = np.array([(study.nominal, study.nominal), *study.effects.values()])
    unit, ends = column_scale(study.quantity, study.unit, found)
    effects = dict(zip(study.effects, map(tuple, ends[1:].tolist()), strict=True))
    return plot_tornado(
        effects, base=float(ends[0, 0]), quantity=f"{label_of(study.quantity)} [{unit or '1'}]"
    )


_MODES: dict[str, Describe] = {
    "campbell": rotor_charts.plot_campbell,
    "log_decrement": rotor_charts.plot_log_decrement,
}

_FILM: dict[str, Describe] = {
    "pressure": film_charts.plot_film,
    "circumference": film_charts.plot_circumference,
}

PICTURES: dict[str, dict[str, Describe]] = {
    "Trajectory": run_charts.RUNS,
    "CoSimulation": {kind: _of_trajectory(own) for kind, own in run_charts.RUNS.items()},
    "RunAmplitudes": {"amplitude": run_charts.plot_run_amplitudes},
    "RunSpectra": {
        "waterfall": run_charts.plot_waterfall,
        "spectrogram": run_charts.plot_spectrogram,
        "full_spectrum": run_charts.plot_full_spectrum,
    },
    "RunOrbits": {"orbits": run_charts.plot_run_orbits},
    "RunSpectrum": {"spectrum": run_charts.plot_run_spectrum},
    "DeflectedShape": {"shape": plot_deflected_shape, "orbits": plot_deflected_orbits},
    "Campbell": _MODES,
    "RotorAnswer": {
        "campbell": lambda found: rotor_charts.plot_campbell(found.campbell, critical=found.critical_speeds),
        "log_decrement": lambda found: rotor_charts.plot_log_decrement(found.campbell),
        "response": lambda found: rotor_charts.plot_unbalance_response(
            found.response, critical=found.critical_speeds, threshold=found.threshold.speed
        ),
    },
    "ShaftRotor": {"rotor": plot_rotor},
    "TabulatedBearing": {"coefficients": film_charts.plot_coefficients},
    "ClearanceCheck": {"clearances": rotor_charts.plot_clearance_check},
    "SeparationMargins": {"margins": rotor_charts.plot_separation_margins},
    "ShaftStatics": {"statics": rotor_charts.plot_shaft_statics},
    "StabilityLevelOne": {"stability": rotor_charts.plot_stability_level_one},
    "PeriodicOrbit": {"orbit": rotor_charts.plot_periodic_orbit},
    "OrbitCurve": {"amplitude": lambda found: rotor_charts.plot_orbit_curves({"orbits": found})},
    "SynchronousOrbits": {
        "eccentricity": _synchronous(film_charts.plot_eccentricity),
        "transmissibility": _synchronous(film_charts.plot_transmissibility),
        "phase": _synchronous(film_charts.plot_phase),
    },
    "OrbitsOverSpeed": {"speed": film_charts.plot_damper_speeds},
    "BistableMap": {"jumps": film_charts.plot_bistable},
    "DamperRun": {"run": _run},
    "FilmState": _FILM,
    "JFOState": {"pressure": film_charts.plot_film},
    "JFOOrbit": {"pressure": film_charts.plot_film},
    "HeatedState": {"film": film_charts.plot_heated_film, "circumference": film_charts.plot_circumference},
    "DamperTurn": {"oil": film_charts.plot_damper_turn},
    "ContactRun": {"film": plot_contact_run},
    "QuestionAnswer": {"ladder": plot_question},
    "ToleranceStudy": {"histogram": _scatter, "tornado": _tornado},
    "VariableCompliance": {"spectrum": plot_compliance},
}
"""What describes the pictures of a result, by the name of its class and by kind, the usual one first."""
