"""Charts of types of bearings, of the atlas of limits, of coupling schemes and of published cases."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from itertools import cycle

import numpy as np
from matplotlib.axes import Axes
from matplotlib.ticker import LogLocator, NullFormatter, StrMethodFormatter

from ..bearings.contact import ContactState
from ..core.model import Array
from ..studies import BearingCoefficients, BearingThresholds, ShaftFluxError, StudyResult, WhirlOutcome
from ..studies.contact_cases import CaseRun, CaseSection, CaseSolution, ContactCases, SolutionKind
from ..studies.contact_precision import ContactLimits
from ..studies.coupling_cost import CouplingLimits, LimitRow, SchemeName
from ..studies.limits_journal import Limit, LimitAtlas, Panel, failure
from .canvas import BAD, DOUBTFUL, GOOD, legend_beside, new_axes, new_figure

ENTRIES = ("xx", "xy", "yx", "yy")

LINES = ("C0-", "C1-", "C2-", "C3-", "C4-", "C8-", "k--", "C5--")
"""Color and dash of the types in turn."""

RPM, GRAVITY = 30.0 / math.pi, 9.81

CROSSED = (1, 2, 5)
"""Panels of entries that change their sign."""

LINEAR = 1.0
"""Numbers of these entries below which their scale is linear."""


def plot_bearing_coefficients(result: BearingCoefficients) -> list[Axes]:
    """Draw K, C and the least film of all types of bearings over the Sommerfeld number, entry by entry."""
    figure = new_figure(size=(15.0, 8.4))
    shown = figure.subplots(2, 4, sharex=True).ravel().tolist()
    stiffness = {one.name: one.stiffness_number.reshape(-1, 4) for one in result.types}
    damping = {one.name: one.damping_number.reshape(-1, 4) for one in result.types}
    for k, entry in enumerate(ENTRIES):
        _draw_types(shown[k], result.sommerfeld, {name: K[:, k] for name, K in stiffness.items()})
        shown[k].set_title(f"K{entry} c / W", fontsize=10)
    for axes, k, entry in zip(shown[4:], (0, 1, 3), ("xx", "xy = Cyx", "yy"), strict=False):
        _draw_types(axes, result.sommerfeld, {name: C[:, k] for name, C in damping.items()})
        axes.set_title(f"C{entry} c omega / W", fontsize=10)
    for k, axes in enumerate(shown[:7]):
        if k in CROSSED:
            axes.set_yscale("symlog", linthresh=LINEAR)
        else:
            axes.set_yscale("log")
    _draw_types(shown[7], result.sommerfeld, {one.name: one.film_ratio for one in result.types})
    shown[7].set_title("least film / c", fontsize=10)
    for axes in shown[4:]:
        axes.set_xlabel("Sommerfeld number S [1]")
    handles, labels = shown[0].get_legend_handles_labels()
    figure.legend(handles, labels, loc="outside lower center", ncols=4, fontsize=9, frameon=False)
    figure.suptitle(
        f"Bearings of one bore, L/D = {result.slenderness:g}, load along -y\n{result.convention}\n"
        "tilting pads at the frequency of the shaft",
        fontsize=10,
    )
    return shown


def _draw_types(axes: Axes, x: Array, curves: Mapping[str, Array]) -> None:
    for (name, y), line in zip(curves.items(), cycle(LINES), strict=False):
        axes.plot(x, y, line, label=name, linewidth=1.4)
    axes.set_xscale("log")
    axes.grid(visible=True, alpha=0.3)


def plot_bearing_thresholds(result: BearingThresholds, *, axes: Axes | None = None) -> Axes:
    """Draw the speed from which a rigid rotor whirls over the load, a line for each type of bearing.

    Types that never whirl lie on the upper edge; a cross is a load that a bearing does not carry.

    Parameters
    ----------
    result : BearingThresholds
    axes : Axes, optional
        Where to draw; a new figure by default.
    """
    axes = axes or new_axes("", size=(9.0, 6.6))
    low, top = (RPM * speed for speed in result.speed_range)
    lowest, width = top, 1.6
    for one, line in zip(result.types, cycle(LINES), strict=False):
        speed = RPM * np.array([np.nan if value is None else value for value in one.threshold_speed])
        lowest = min(lowest, float(np.min(speed, initial=lowest, where=np.isfinite(speed))))
        never, always, lost = (
            np.array([outcome is kind for outcome in one.outcomes])
            for kind in (WhirlOutcome.NEVER, WhirlOutcome.ALWAYS, WhirlOutcome.UNCARRIED)
        )
        label = f"{one.name}: no whirl" if never.all() else one.name
        drawn = np.where(never, top, np.where(always, low, speed))
        axes.plot(result.load, drawn, line, label=label, linewidth=width, clip_on=False)
        axes.plot(result.load[lost], np.full(int(lost.sum()), low), f"{line.strip('-')}x", clip_on=False)
        if never.all():  # the next one on the edge shows beside it
            width += 2.0
    ends = tuple(result.load[[0, -1]].tolist())
    axes.set(xscale="log", yscale="log", xlim=ends, ylim=(max(low, 0.7 * lowest), top))
    for axis in (axes.xaxis, axes.yaxis):
        axis.set_major_locator(LogLocator(subs=(1.0, 2.0, 5.0)))
        axis.set_major_formatter(StrMethodFormatter("{x:g}"))
        axis.set_minor_formatter(NullFormatter())
    axes.set(xlabel="load of the bearing along -y [N]", ylabel="speed from which the rotor whirls [rpm]")
    axes.set_title(
        f"Which bearing for a rigid rotor of {result.mass:g} kg a bearing? One journal, bore and oil, "
        f"L/D = {result.slenderness:g}\nstable below its line; on the upper edge, {top:.0f} rpm: "
        "no whirl at any speed searched",
        fontsize=10,
    )
    if ends[0] < GRAVITY * result.mass < ends[1]:
        axes.axvline(GRAVITY * result.mass, color="0.5", linewidth=0.8)
        place = (GRAVITY * result.mass, 0.01)
        axes.text(*place, " weight", transform=axes.get_xaxis_transform(), fontsize=8, color="0.4")
    axes.legend(fontsize=8, loc="lower right")
    return axes


# Further charts of the melting bush: the runs of its models, the closed form of the shaft.


def draw_bush_angles(axes: Axes, result: StudyResult) -> None:
    """Draw the contact angle by the last model of each family, and by the reference."""
    for rung in {rung.family: rung for rung in result.rungs}.values():
        assert rung.answer is not None
        axes.plot(result.notes["times"], rung.answer, label=rung.name)
    axes.plot(result.notes["times"], result.notes["exact"], "k:", label="reference")
    axes.set(xlabel="time [s]", ylabel="half contact angle [rad]", title="Growing load")
    axes.grid(visible=True, alpha=0.3)
    axes.legend(fontsize=7.5)


def draw_shaft_flux(axes: Axes, result: StudyResult) -> None:
    """Draw the error of the closed form (2.13) over the Biot number, by shaft radius / half length."""
    rows: Sequence[ShaftFluxError] = result.notes["shaft"]
    for stubbiness in dict.fromkeys(row.stubbiness for row in rows):
        line = np.array([(row.cooling, 100.0 * row.error) for row in rows if row.stubbiness == stubbiness]).T
        axes.plot(*line, label=f"R_1/l = {stubbiness:g}")
    axes.set(
        title="Closed form of the shaft heat (2.13)",
        xlabel="Biot number of the shaft",
        ylabel="error against the mixed problem [%]",
        ylim=(0.0, None),
    )
    axes.grid(visible=True, alpha=0.3)
    axes.legend(fontsize=7.5)


# Figures 2 to 7 of the published cases of a ball on a lubricated plane, redrawn.


TITLES = {
    CaseSection.FREE: "figure 3: approach and pressure 20 % too small",
    CaseSection.STEPPED: "figure 5: load 1.7 from t = 1 to 20",
    CaseSection.SLOW: "figure 6: load 1 + 0.2 sin t",
    CaseSection.FAST: "figure 7: load 1 + 0.5 sin(omega t), W = 1",
}

SHOWN = {SolutionKind.PUBLISHED: ("--", 1.0), SolutionKind.CONVERGED: ("-", 1.6)}
"""Solutions drawn: line and its width."""

LATEST = 40.0
"""End of the time axes."""


def plot_contact_cases(cases: ContactCases) -> list[Axes]:
    """Draw figures 2 to 7: published scheme dashed, converged solid."""
    figure = new_figure(size=(11.5, 17.0))
    figure.suptitle("Panovko (2011), figures 2 to 7. Solid: converged; dashed: published scheme, dt = 0.2")
    rows = iter(figure.subplots(6, 2))
    axes = [*_draw_rest(next(rows), cases)]
    for section, curves in cases.curves.items():
        axes += _draw_series(next(rows), cases, section)
        if section == CaseSection.FREE:
            axes += _draw_waves(next(rows), cases, curves[-1])
    return axes


def _draw_rest(row: list[Axes], cases: ContactCases) -> list[Axes]:
    for solution in cases.solutions:
        _draw_along(row, solution, solution.rest, "C0", None)
    return _dressed(row, ("figure 2: at rest, y = 0", ""), ("pressure p", "film H"), "x")


def _draw_waves(row: list[Axes], cases: ContactCases, heaviest: CaseRun) -> list[Axes]:
    for solution, run in zip(cases.solutions, heaviest.runs, strict=True):
        for number, state in enumerate(run.snapshots):
            _draw_along(row, solution, state, f"C{number}", f"t = {state.t:g}")
    legend_beside(row[1])
    return _dressed(row, ("figure 4: case 4.1, W = 1, y = 0", ""), ("pressure p", "film H"), "x")


def _draw_along(
    row: list[Axes], solution: CaseSolution, state: ContactState, color: str, label: str | None
) -> None:
    """Draw pressure and film along y = 0."""
    x: Array = solution.contact.grid.x
    _draw_cases(row, solution, x, (state.pressure[:, 0], state.thickness[:, 0]), color, label)


def _draw_series(row: list[Axes], cases: ContactCases, section: CaseSection) -> list[Axes]:
    for number, curve in enumerate(cases.curves[section]):
        for solution, run in zip(cases.solutions, curve.runs, strict=True):
            early = run.time <= LATEST
            values = (run.central_film[early], -run.delta[early])
            _draw_cases(row, solution, run.time[early], values, f"C{number}", curve.name)
    legend_beside(row[1])
    return _dressed(row, (TITLES[section], ""), ("central film H0", "approach -delta"), "time")


def _draw_cases(
    row: list[Axes],
    solution: CaseSolution,
    abscissa: Array,
    pair: tuple[Array, Array],
    color: str,
    label: str | None,
) -> None:
    """Draw a curve of a solution into each of two Axes if it is shown; converged ones have labels."""
    if solution.kind not in SHOWN:
        return
    style, width = SHOWN[solution.kind]
    shown = label if solution.kind == SolutionKind.CONVERGED else None
    for axes, values in zip(row, pair, strict=True):
        axes.plot(abscissa, values, style, color=color, linewidth=width, label=shown)


def _dressed(row: list[Axes], titles: tuple[str, str], labels: tuple[str, str], abscissa: str) -> list[Axes]:
    for axes, title, label in zip(row, titles, labels, strict=True):
        axes.set(title=title, ylabel=label, xlabel=abscissa)
        axes.grid(visible=True, alpha=0.3)
    # Films behind the contact and balls in the air are off the scale of the figures.
    if abscissa == "x":
        row[1].set_ylim(0.0, 1.0)
    return list(row)


# The atlas of limits: where each simplification fails, a figure for each physics and a summary of all.


COLUMNS = 2
SIZE = (4.7, 4.6)
"""Width and height of a panel [inch]."""

LONG = 24
"""Characters of a label that has a line of its own."""

HOLDS, DEPENDS, FAILS = "#9fd3a8", "#f5d97a", "#e79a8f"
"""Colors of the summary: where all variants hold, some, and none."""


def plot_limits(atlas: LimitAtlas) -> dict[str, list[Axes]]:
    """Draw one panel for each simplification, and the level from which it counts as failed.

    Parameters
    ----------
    atlas : LimitAtlas

    Returns
    -------
    dict of str to list of Axes
        Those of one figure by its physics, in the order of the panels of the atlas.
    """
    physics = dict.fromkeys(panel.physics for panel in atlas.panels)
    return {name: _figure(atlas, name) for name in physics}


def _figure(atlas: LimitAtlas, physics: str) -> list[Axes]:
    own = {panel: limits for panel, limits in atlas.panels.items() if panel.physics == physics}
    columns = min(COLUMNS, len(own))
    rows = math.ceil(len(own) / columns)
    figure = new_figure(size=(columns * SIZE[0], rows * SIZE[1]))
    figure.suptitle(physics)
    drawn = [figure.add_subplot(rows, columns, k + 1) for k in range(len(own))]
    for axes, (panel, limits) in zip(drawn, own.items(), strict=True):
        for limit in limits:
            axes.plot(limit.abscissa, limit.ordinate, ".-", label=limit.name)
        _finish(axes, panel)
    return drawn


def _finish(axes: Axes, panel: Panel) -> None:
    axes.set(xlabel=panel.x_label, ylabel=panel.y_label, yscale="log", title=panel.title)
    if panel.logarithmic:
        axes.set_xscale("log")
    else:
        axes.locator_params(axis="x", nbins=6)  # numbers that do not touch
    if panel.level is not None:
        axes.axhline(panel.level, color="k", linewidth=1.0, linestyle="--", label=f"failed: {panel.level:g}")
    axes.grid(visible=True, alpha=0.3)
    longest = max(len(label) for label in axes.get_legend_handles_labels()[1])
    columns = 1 if longest > LONG else 2
    # below, where no curve is
    axes.legend(fontsize=8, loc="upper center", bbox_to_anchor=(0.5, -0.2), ncols=columns, frameon=False)


def plot_limit_summary(atlas: LimitAtlas) -> list[Axes]:
    """Draw a strip for each simplification: where all of its variants hold, where some do, and where none.

    A panel whose ordinate is the limit itself has no strip.

    Parameters
    ----------
    atlas : LimitAtlas

    Returns
    -------
    list of Axes
        Of one figure, in the order of the panels of the atlas.
    """
    judged = {panel: limits for panel, limits in atlas.panels.items() if panel.level is not None}
    figure = new_figure(size=(9.4, 1.0 + 0.72 * len(judged)))
    figure.suptitle("Errors below 10 %: green all variants, yellow some, red none")
    drawn = list(figure.subplots(len(judged), 1, squeeze=False)[:, 0])
    for axes, (panel, limits) in zip(drawn, judged.items(), strict=True):
        _strip(axes, panel, limits)
    return drawn


def _strip(axes: Axes, panel: Panel, limits: list[Limit]) -> None:
    assert panel.level is not None
    every = np.concatenate([limit.abscissa for limit in limits])
    low, high = float(every.min()), float(every.max())
    found = [failure(limit, panel.level) for limit in limits]
    ends = [high if at is None else at for at in found]
    first, last = min(ends), max(ends)
    for start, end, color in ((low, first, HOLDS), (first, last, DEPENDS), (last, high, FAILS)):
        axes.axvspan(start, end, color=color, linewidth=0.0)
    if panel.logarithmic:
        axes.set_xscale("log")
    axes.set(xlim=(low, high), yticks=())
    axes.tick_params(axis="x", which="both", labelsize=7, pad=1)
    axes.set_ylabel(f"{panel.physics}: {panel.title}", rotation=0, ha="right", va="center", fontsize=8)
    axes.set_xlabel(panel.x_label, fontsize=7, labelpad=1)


# Charts of coupling schemes: how long a macro step each stands.


SCHEME_LINES = {
    SchemeName.HELD: ("#1f4fb4", "-", "o"),
    SchemeName.LINEAR: ("#1f4fb4", "--", "s"),
    SchemeName.QUADRATIC: ("#1f4fb4", ":", "^"),
    SchemeName.JACOBI_HELD: ("#d62728", "-", "o"),
    SchemeName.JACOBI_LINEAR: ("#d62728", "--", "s"),
    SchemeName.JACOBI_QUADRATIC: ("#d62728", ":", "^"),
    SchemeName.SI_EXP: ("#2ca02c", "-", "D"),
    SchemeName.SI_EXP3: ("#000000", "-", "D"),
    SchemeName.NEWTON: ("#ff7f0e", "-", "D"),
}
"""Color, line and mark of each scheme: kinds by color, degrees by line."""


def plot_coupling_limits(limits: CouplingLimits) -> Sequence[Axes]:
    """Draw the longest stable macro step over the eccentricity ratio, and over the mass of the journal.

    Lines are theory, marks are runs of the scheme; schemes without a limit are named above.

    Parameters
    ----------
    limits : CouplingLimits
    """
    left, right = new_figure(size=(11.0, 4.8)).subplots(1, 2)
    rigid = [row for row in limits.rows if row.mass_ratio == 1.0]
    light = [row for row in limits.rows if row.mass_ratio != 1.0]
    _draw_coupling(left, rigid, lambda row: row.eccentricity_ratio)
    _draw_coupling(right, light, lambda row: row.mass_ratio)
    left.set(xlabel="eccentricity ratio", title="rigid rotor, speed parameter 1")
    right.set(xlabel="mass of the journal / mass of the rotor", title="light journal, eccentricity ratio .7")
    right.set_xscale("log")
    for axes in (left, right):
        axes.set_yscale("log")
        axes.set_ylabel("longest stable macro step [deg]")
        axes.grid(visible=True, which="both", alpha=0.25)
    free = sorted({row.scheme for row in limits.rows} - {row.scheme for row in limits.rows if _limited(row)})
    handles, labels = right.get_legend_handles_labels()
    right.legend(handles, labels, fontsize=8, title=f"no limit: {', '.join(free)}", title_fontsize=8, ncols=2)
    return [left, right]


def _draw_coupling(axes: Axes, rows: Sequence[LimitRow], place: Callable[[LimitRow], float]) -> None:
    for scheme in dict.fromkeys(row.scheme for row in rows if _limited(row)):
        own = sorted((row for row in rows if row.scheme == scheme), key=place)
        theory = [row for row in own if row.critical_macro_angle is not None]
        runs = [row for row in own if row.simulated is not None]
        color, line, mark = SCHEME_LINES[scheme]
        angles = np.degrees([row.critical_macro_angle or np.nan for row in theory])
        axes.plot([place(row) for row in theory], angles, line, color=color, label=scheme)
        found = np.degrees([row.simulated or np.nan for row in runs])
        axes.plot([place(row) for row in runs], found, mark, color=color, markersize=5, fillstyle="none")


def _limited(row: LimitRow) -> bool:
    return row.critical_macro_angle is not None


# Chart of the error of a coupled run over its macro step.


def plot_coupling_error(
    macro_angles: np.ndarray,
    errors: np.ndarray,
    refused: np.ndarray,
    *,
    limit: float | None = None,
    axes: Axes | None = None,
) -> Axes:
    """Draw the error of the coupled run against the monolithic one over the macro step.

    Parameters
    ----------
    macro_angles : ndarray, shape (n,) [rad]
        Shaft rotation between two exchanges.
    errors : ndarray, shape (n,) [1]
        Largest distance of the orbits / clearance.
    refused : ndarray of bool, shape (n,)
        Runs that are no answer; drawn as crosses.
    limit : float, optional [rad]
        Explicit stability limit of the coupling.
    axes : Axes, optional
        Where to draw; a new figure by default.
    """
    axes = axes or new_axes("Co-simulation error against macro step")
    degrees, good = np.degrees(macro_angles), ~np.asarray(refused)
    axes.loglog(degrees[good], errors[good], "o-", label="Gauss-Seidel, force held")
    axes.loglog(degrees[~good], errors[~good], "x", color="C3", label="refused")
    if np.any(good):
        axes.loglog(degrees, errors[good][0] * degrees / degrees[good][0], "k:", label="first order")
    if limit is not None:
        axes.axvline(np.degrees(limit), color="C3", linewidth=1.0, label="explicit stability limit")
    axes.set_xticks(degrees, [f"{angle:.3g}" for angle in degrees])
    axes.minorticks_off()
    axes.set(xlabel="macro step [deg of shaft rotation]", ylabel="largest orbit error / clearance")
    axes.legend(fontsize=8)
    return axes


# Chart of the limits of the published scheme of a rolling ball.


def plot_contact_limits(result: ContactLimits) -> list[Axes]:
    """Draw where the published scheme fails under load steps, and the decay times it shows."""
    steps, decay = new_figure(size=(12.0, 4.8)).subplots(1, 2)
    _cells(steps, result.reached, result.steps, result.load_steps, _failure)
    steps.set(title="load step at W = 1: time of failure", xlabel="amplitude A", ylabel="step dt")
    ratio = result.shown / result.physical
    _cells(decay, ratio, result.steps, result.inertias, _decay)
    decay.set(title="decay time shown / physical", xlabel="inertia W", ylabel="step dt")
    return [steps, decay]


def _cells(
    axes: Axes, values: np.ndarray, rows: tuple[float, ...], columns: tuple[float, ...], describe: object
) -> None:
    assert callable(describe)
    for (i, j), value in np.ndenumerate(values):
        text, color = describe(float(value))
        axes.fill_between([j - 0.5, j + 0.5], i - 0.5, i + 0.5, color=color, edgecolor="white")
        axes.text(j, i, text, ha="center", va="center", fontsize=9)
    axes.set_xticks(range(len(columns)), [f"{value:g}" for value in columns])
    axes.set_yticks(range(len(rows)), [f"{value:g}" for value in rows])
    axes.set(xlim=(-0.5, len(columns) - 0.5), ylim=(-0.5, len(rows) - 0.5))


def _failure(time: float) -> tuple[str, str]:
    return ("runs", GOOD) if np.isinf(time) else (f"{time:.3g}", BAD)


def _decay(ratio: float) -> tuple[str, str]:
    color = GOOD if ratio > 0.9 else DOUBTFUL if ratio > 0.5 else BAD
    return f"{ratio:.2g}", color
