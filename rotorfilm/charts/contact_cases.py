"""Chart of the published cases of a ball on a lubricated plane."""

from __future__ import annotations

from matplotlib.axes import Axes

from ..ladders.contact_cases import ContactCases
from .canvas import new_figure

TITLES = {
    "4.1": "4.1: approach and pressure 20 % too small",
    "4.2": "4.2: load 1.7 from t = 1 to 20",
    "4.3 A = 0.2": "4.3: load 1 + 0.2 sin t",
    "4.3 A = 0.5": "4.3: load 1 + 0.5 sin(omega t), W = 1",
}


def plot_contact_cases(cases: ContactCases) -> list[Axes]:
    """Draw central film thickness and approach over time: published scheme dashed, converged solid."""
    figure = new_figure(size=(11.0, 12.0))
    grid = figure.subplots(len(cases.runs), 2, sharex=True)
    for row, (section, curves) in zip(grid, cases.runs.items(), strict=True):
        for number, case in enumerate(curves):
            color = f"C{number}"
            for axes, name in zip(row, ("central_film", "delta"), strict=True):
                fine, rough = case.converged, case.published
                axes.plot(fine.time, getattr(fine, name), color=color, label=case.name)
                axes.plot(rough.time, getattr(rough, name), "--", color=color, linewidth=1.0)
        row[0].set(title=TITLES[section], ylabel="central film H0")
        row[1].set(title="solid: converged, dashed: published scheme", ylabel="approach delta")
        row[1].legend(fontsize=8)
        for axes in row:
            axes.grid(visible=True, alpha=0.3)
    for axes in grid[-1]:
        axes.set_xlabel("time")
    return [axes for row in grid for axes in row]
