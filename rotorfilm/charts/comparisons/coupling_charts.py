"""Charts of coupling schemes: how long a macro step each stands, and its error against film calls."""

from __future__ import annotations

from collections.abc import Callable, Sequence

import numpy as np
from matplotlib.axes import Axes

from ...comparisons.coupling.coupling_cost import CouplingCost
from ...comparisons.coupling.coupling_limits import CouplingLimits, LimitRow
from ...comparisons.coupling.coupling_setup import SchemeName
from ..canvas import new_figure

STYLES = {
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
    _draw(left, rigid, lambda row: row.eccentricity_ratio)
    _draw(right, light, lambda row: row.mass_ratio)
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


def plot_coupling_cost(cost: CouplingCost) -> Sequence[Axes]:
    """Draw the orbit error over film calls, and over the macro step; refused runs are crosses at the top.

    Parameters
    ----------
    cost : CouplingCost
    """
    left, right = new_figure(size=(11.0, 4.8)).subplots(1, 2)
    top = max(row.orbit_error for row in cost.rows if row.orbit_error is not None) * 3.0
    for scheme in dict.fromkeys(row.scheme for row in cost.rows):
        rows = [row for row in cost.rows if row.scheme == scheme]
        good = [row for row in rows if row.orbit_error is not None]
        bad = [row for row in rows if row.orbit_error is None]
        color, line, mark = STYLES[scheme]
        errors = [row.orbit_error for row in good]
        angles = np.degrees([row.macro_angle for row in good])
        left.loglog([row.film_calls for row in good], errors, line, marker=mark, color=color, label=scheme)
        right.loglog(angles, errors, line, marker=mark, color=color, label=scheme)
        right.loglog(np.degrees([row.macro_angle for row in bad]), [top] * len(bad), "x", color=color)
    left.set(xlabel="film evaluations and derivatives per turn", ylabel="orbit error / clearance")
    right.set(xlabel="macro step [deg]; x: refused", ylabel="orbit error / clearance")
    left.set_title(f"orbit to eccentricity ratio {cost.eccentricity_ratio:.2f}")
    for axes in (left, right):
        axes.grid(visible=True, which="both", alpha=0.25)
    left.legend(fontsize=8)
    return [left, right]


def _draw(axes: Axes, rows: Sequence[LimitRow], place: Callable[[LimitRow], float]) -> None:
    for scheme in dict.fromkeys(row.scheme for row in rows if _limited(row)):
        own = sorted((row for row in rows if row.scheme == scheme), key=place)
        theory = [row for row in own if row.critical_macro_angle is not None]
        runs = [row for row in own if row.simulated is not None]
        color, line, mark = STYLES[scheme]
        angles = np.degrees([row.critical_macro_angle or np.nan for row in theory])
        axes.plot([place(row) for row in theory], angles, line, color=color, label=scheme)
        found = np.degrees([row.simulated or np.nan for row in runs])
        axes.plot([place(row) for row in runs], found, mark, color=color, markersize=5, fillstyle="none")


def _limited(row: LimitRow) -> bool:
    return row.critical_macro_angle is not None
