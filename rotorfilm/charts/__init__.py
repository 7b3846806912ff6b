"""Charts: functions from results to matplotlib Axes; nothing here computes physics."""

from .accuracy import plot_accuracy, plot_coupling_error
from .canvas import new_axes, save
from .damper import plot_bistable, plot_eccentricity, plot_phase, plot_transmissibility, plot_transmitted
from .motion import plot_locus, plot_orbits
from .stability import plot_stability
from .whirl_verdicts import plot_journal_stability
from .work_precision import plot_journal_accuracy

__all__ = [
    "new_axes",
    "plot_accuracy",
    "plot_bistable",
    "plot_coupling_error",
    "plot_eccentricity",
    "plot_journal_accuracy",
    "plot_journal_stability",
    "plot_locus",
    "plot_orbits",
    "plot_phase",
    "plot_stability",
    "plot_transmissibility",
    "plot_transmitted",
    "save",
]
