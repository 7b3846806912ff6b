"""Charts: functions from results to matplotlib Axes; nothing here computes physics."""

from .accuracy import plot_accuracy, plot_coupling_error
from .bush import plot_contact_pressure, plot_critical_speed
from .canvas import new_axes, save
from .motion import plot_locus, plot_orbits
from .stability import plot_stability
from .whirl_verdicts import plot_journal_stability
from .work_precision import plot_journal_accuracy

__all__ = [
    "new_axes",
    "plot_accuracy",
    "plot_contact_pressure",
    "plot_coupling_error",
    "plot_critical_speed",
    "plot_journal_accuracy",
    "plot_journal_stability",
    "plot_locus",
    "plot_orbits",
    "plot_stability",
    "save",
]
