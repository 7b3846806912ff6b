"""The picture of each result: what `plot()` of it draws."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any

import numpy as np
from matplotlib.axes import Axes

from ..bearings.contact import ContactRun
from ..bearings.damper import JFOOrbit
from ..bearings.journal import FilmState, JFOState
from ..core.answers import QuestionAnswer
from ..core.errors import InputError
from ..core.model import Array
from ..core.readable import Drawable, label_of
from ..core.results import Trajectory
from .canvas import add_color_bar, labeled, new_axes, new_figure, with_grids
from .film_charts import plot_bistable, plot_damper_run, plot_damper_turn, plot_eccentricity
from .rolling_charts import plot_compliance
from .rotor_charts import (
    plot_campbell,
    plot_orbit_curves,
    plot_periodic_orbit,
    plot_separation_margins,
    plot_shaft_statics,
    plot_stability_level_one,
)

GRAM_MILLIMETER = 1e-6


def plot_result(result: Drawable, *, axes: Any = None) -> Any:
    """Draw a result as its kind has it: what its `plot()` calls.

    Parameters
    ----------
    result : Drawable
        A trajectory, a co-simulation, a Campbell diagram, periodic or synchronous orbits or a curve of them,
        a bistable map, the state of a film, a contact over time, or the answer to a question or about a
        rotor.
    axes : Axes, or two of them for a trajectory, optional
        Where to draw; a new figure by default.

    Returns
    -------
    Axes, or two of them
    """
    kind = next(one.__name__ for one in type(result).__mro__ if one.__name__ in PICTURES)
    return PICTURES[kind](result, axes=axes)


def plot_trajectory(run: Trajectory, *, axes: Sequence[Axes] | None = None) -> tuple[Axes, Axes]:
    """Draw the orbits of all journals [um], and their displacements over time.

    Where no journal moves in a plane, the second signal over the first, and the first over time, in SI.

    Parameters
    ----------
    run : Trajectory
    axes : two Axes, optional
        For orbit and time; a new figure by default.
    """
    beside, below = axes if axes is not None else new_figure(size=(9.6, 4.4)).subplots(1, 2)
    stations = [name[:-1] for name in run.signals if name == "x" or name.endswith("_x")]
    stations = [name for name in stations if not name.endswith("force_") and f"{name}y" in run.signals]
    pairs, unit, factor = [(f"{name}x", f"{name}y") for name in stations], "um", 1e6
    if not pairs:
        pairs, unit, factor = [(*run.signals,)[:2]], "SI", 1.0  # type: ignore[list-item]
    for pair in pairs:
        first, second = (factor * run[name] for name in pair)
        label = label_of(pair[0].removesuffix("x")) or "journal"
        beside.plot(first, second, linewidth=1.3, label=label)
        for name, values in zip(pair, (first, second), strict=True):
            below.plot(run.time, values, linewidth=1.2, label=label_of(name))
    x, y = (label_of(name) for name in pairs[0])
    beside.set(xlabel=f"{x} [{unit}]", ylabel=f"{y} [{unit}]", title="Orbit")
    if stations:
        beside.set(xlabel="x [um]", ylabel="y [um]", aspect="equal", adjustable="datalim")
    below.set(xlabel="time [s]", ylabel=f"displacement [{unit}]", title="Over time")
    with_grids(beside, below)
    return beside, below


def plot_film(state: FilmState | JFOState | JFOOrbit, *, axes: Axes | None = None) -> Axes:
    """Draw the pressure [MPa] of a film, unwrapped: the angle in the bearing, and from end to end.

    Of a film that conserves its oil there is a line too around what is not full; that of a damper is drawn
    in axes that turn with its orbit, and with its mirror image where a groove is at one end.

    Parameters
    ----------
    state : FilmState, JFOState or JFOOrbit
    axes : Axes, optional
        Where to draw; a new figure by default.
    """
    if state.angle is None or state.axial is None or state.pressure is None:
        raise InputError("state must have a pressure field, as that of a ReynoldsFilm, got one without")
    axes = axes or new_axes("Pressure of the film")
    order = np.argsort(state.angle)
    first = 1 if state.axial[0] == 0.0 else 0
    ends = np.concatenate([-state.axial[first:][::-1], state.axial])

    def both_halves(numbers: Array) -> Array:
        return np.hstack([numbers[order, first:][:, ::-1], numbers[order]]).T

    places = np.degrees(state.angle[order]), 1e3 * ends
    shown = axes.pcolormesh(*places, 1e-6 * both_halves(state.pressure), shading="nearest")
    add_color_bar(axes, shown, "pressure [MPa]")
    if isinstance(state, JFOState | JFOOrbit) and state.oil_content.min() < 1.0:
        axes.contour(*places, both_halves(state.oil_content), levels=[0.999], colors="white", linewidths=1.0)
    turning = isinstance(state, JFOOrbit)
    origin = "the line of centers in the sense of +z" if turning else "+x towards +y"
    axes.set(xlabel=f"angle from {origin} [deg]", ylabel="axial [mm]")
    return axes


def plot_question(answer: QuestionAnswer, *, axes: Axes | None = None) -> Axes:
    """Draw the ladder behind an answer: the estimated error of each rung that was tried over its cost.

    Parameters
    ----------
    answer : QuestionAnswer
    axes : Axes, optional
        Where to draw; a new figure by default.
    """
    points = [
        (one.name, error, cost, one.name == answer.model)
        for one in answer.rungs
        if (error := one.error_estimate) is not None and (cost := one.cost) is not None
    ]
    title = label_of(answer.quantity)
    return plot_scene_ladder(points, title=title, tolerance=answer.tolerance, axes=axes)


def plot_contact_run(run: ContactRun, *, axes: Axes | None = None) -> Axes:
    """Draw the central and the smallest film of a contact over time, in units of the Hertzian contact.

    Parameters
    ----------
    run : ContactRun
    axes : Axes, optional
        Where to draw; a new figure by default.
    """
    axes = axes or new_axes("Film of the contact")
    axes.plot(run.time, run.central_film, label="central film")
    axes.plot(run.time, run.minimum_film, "--", label="smallest film")
    return labeled(axes, "time", "film thickness")


def _synchronous(orbits: Any, *, axes: Axes | None) -> Axes:
    drawn = plot_eccentricity({"orbits": orbits}, unit=GRAM_MILLIMETER, axes=axes)
    drawn.set_xlabel("unbalance [g mm]")
    return drawn


PICTURES: dict[str, Callable[..., Any]] = {
    "Trajectory": plot_trajectory,
    "CoSimulation": lambda result, axes: plot_trajectory(result.trajectory, axes=axes),
    "Campbell": plot_campbell,
    "RotorAnswer": lambda result, axes: plot_campbell(
        result.campbell, critical=result.critical_speeds, axes=axes
    ),
    "SeparationMargins": plot_separation_margins,
    "ShaftStatics": plot_shaft_statics,
    "StabilityLevelOne": plot_stability_level_one,
    "PeriodicOrbit": plot_periodic_orbit,
    "OrbitCurve": lambda result, axes: plot_orbit_curves({"orbits": result}, axes=axes),
    "SynchronousOrbits": _synchronous,
    "BistableMap": plot_bistable,
    "DamperRun": lambda result, axes: plot_damper_run(
        result.trajectory.time, result.eccentricity_ratio, result.force, axes=axes
    ),
    "FilmState": plot_film,
    "JFOState": plot_film,
    "JFOOrbit": plot_film,
    "DamperTurn": plot_damper_turn,
    "ContactRun": plot_contact_run,
    "QuestionAnswer": plot_question,
    "VariableCompliance": plot_compliance,
}
"""What draws a result, by the name of its class."""


# Chart of the models that could answer a scene's question: estimated error against cost.


def plot_scene_ladder(
    points: Sequence[tuple[str, float, float, bool]],
    *,
    title: str,
    tolerance: float,
    axes: Axes | None = None,
) -> Axes:
    """Draw the estimated error of each model over its cost, the tolerance, and the model that answers.

    Parameters
    ----------
    points : sequence of (str, float, float, bool)
        Name of a model, its estimated error [1], the cost of its answer [s], and whether it is chosen.
    title : str
    tolerance : float [1]
    axes : Axes, optional
        Where to draw; a new figure by default.
    """
    axes = axes or new_axes(title, size=(7.5, 5.0))
    for number, (name, error, cost, chosen) in enumerate(points):
        style = {"marker": "*", "markersize": 16} if chosen else {"marker": "o"}
        label = f"{name}, chosen" if chosen else name
        axes.plot(1e3 * cost, error, color=f"C{number % 10}", ls="", label=label, **style)
    axes.axhline(tolerance, color="k", linewidth=1.0, linestyle="--", label="tolerance")
    return labeled(axes, "cost of the answer [ms]", "estimated error", xscale="log", yscale="log")
