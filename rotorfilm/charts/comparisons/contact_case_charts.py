"""Figures 2 to 7 of the published cases of a ball on a lubricated plane, redrawn."""

from __future__ import annotations

from matplotlib.axes import Axes

from ...comparisons.contact.contact_cases import CaseSolution, ContactCases
from ...model import Array
from ..canvas import new_figure

TITLES = {
    "4.1": "figure 3: approach and pressure 20 % too small",
    "4.2": "figure 5: load 1.7 from t = 1 to 20",
    "4.3, A = 0.2": "figure 6: load 1 + 0.2 sin t",
    "4.3, A = 0.5": "figure 7: load 1 + 0.5 sin(omega t), W = 1",
}

SHOWN = {"published": ("--", 1.0), "converged": ("-", 1.6)}
"""Solutions drawn: line and its width."""

LATEST = 40.0
"""End of the time axes."""


def plot_contact_cases(cases: ContactCases) -> list[Axes]:
    """Draw figures 2 to 7: published scheme dashed, converged solid."""
    figure = new_figure(size=(11.0, 17.0))
    figure.suptitle("Panovko (2011), figures 2 to 7. Solid: converged; dashed: published scheme, dt = 0.2")
    rows = iter(figure.subplots(6, 2))
    axes = [*_draw_rest(next(rows), cases)]
    for section in cases.curves:
        axes += _draw_series(next(rows), cases, section)
        if section == "4.1":
            axes += _draw_waves(next(rows), cases)
    return axes


def _draw_rest(row: list[Axes], cases: ContactCases) -> list[Axes]:
    for solution in _shown(cases):
        style, width = SHOWN[solution.name]
        x, rest = solution.contact.grid.x, solution.rest
        for axes, values in zip(row, (rest.pressure, rest.thickness), strict=True):
            axes.plot(x, values[:, 0], style, color="C0", linewidth=width)
    return _dressed(row, ("figure 2: at rest, y = 0", ""), ("pressure p", "film H"), "x")


def _draw_waves(row: list[Axes], cases: ContactCases) -> list[Axes]:
    (curve,) = [curve for curve in cases.curves["4.1"] if curve.name == "W = 1"]
    for solution in _shown(cases):
        style, width = SHOWN[solution.name]
        run = curve.runs[cases.solutions.index(solution)]
        x: Array = solution.contact.grid.x
        for number, state in enumerate(run.snapshots):
            for axes, values in zip(row, (state.pressure, state.thickness), strict=True):
                label = f"t = {state.t:g}" if solution.name == "converged" else None
                axes.plot(x, values[:, 0], style, color=f"C{number}", linewidth=width, label=label)
    row[1].legend(fontsize=8)
    return _dressed(row, ("figure 4: case 4.1, W = 1, y = 0", ""), ("pressure p", "film H"), "x")


def _draw_series(row: list[Axes], cases: ContactCases, section: str) -> list[Axes]:
    for number, curve in enumerate(cases.curves[section]):
        for solution, run in zip(cases.solutions, curve.runs, strict=True):
            if solution.name not in SHOWN:
                continue
            style, width = SHOWN[solution.name]
            label = curve.name if solution.name == "converged" else None
            early = run.time <= LATEST
            row[0].plot(run.time[early], run.central_film[early], style, color=f"C{number}", linewidth=width)
            row[1].plot(
                run.time[early], -run.delta[early], style, color=f"C{number}", linewidth=width, label=label
            )
    row[1].legend(fontsize=8)
    return _dressed(row, (TITLES[section], ""), ("central film H0", "approach -delta"), "time")


def _shown(cases: ContactCases) -> list[CaseSolution]:
    return [solution for solution in cases.solutions if solution.name in SHOWN]


def _dressed(row: list[Axes], titles: tuple[str, str], labels: tuple[str, str], abscissa: str) -> list[Axes]:
    for axes, title, label in zip(row, titles, labels, strict=True):
        axes.set(title=title, ylabel=label, xlabel=abscissa)
        axes.grid(visible=True, alpha=0.3)
    # Films behind the contact and balls in the air are off the scale of the figures.
    if abscissa == "x":
        row[1].set_ylim(0.0, 1.0)
    return list(row)
