"""Charts: functions from results to matplotlib Axes; nothing here computes physics."""

from .accuracy import plot_accuracy, plot_coupling_error
from .canvas import new_axes, save
from .contact_cases import plot_contact_cases
from .motion import plot_locus, plot_orbits
from .stability import plot_stability
from .whirl_verdicts import plot_journal_stability
from .work_precision import plot_journal_accuracy

__all__ = [
    "new_axes",
    "plot_accuracy",
    "plot_contact_cases",
    "plot_coupling_error",
    "plot_journal_accuracy",
    "plot_journal_stability",
    "plot_locus",
    "plot_orbits",
    "plot_stability",
    "save",
]
