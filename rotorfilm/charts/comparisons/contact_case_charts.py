"""Figures 2 to 7 of the published cases of a ball on a lubricated plane, redrawn."""

from __future__ import annotations

from matplotlib.axes import Axes

from ...bearings.contact import ContactState
from ...comparisons.contact.contact_cases import CaseRun, CaseSolution, ContactCases
from ...comparisons.contact.contact_statements import CaseSection, SolutionKind
from ...model import Array
from ..canvas import legend_beside, new_figure

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
    _draw(row, solution, x, (state.pressure[:, 0], state.thickness[:, 0]), color, label)


def _draw_series(row: list[Axes], cases: ContactCases, section: CaseSection) -> list[Axes]:
    for number, curve in enumerate(cases.curves[section]):
        for solution, run in zip(cases.solutions, curve.runs, strict=True):
            early = run.time <= LATEST
            values = (run.central_film[early], -run.delta[early])
            _draw(row, solution, run.time[early], values, f"C{number}", curve.name)
    legend_beside(row[1])
    return _dressed(row, (TITLES[section], ""), ("central film H0", "approach -delta"), "time")


def _draw(
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
