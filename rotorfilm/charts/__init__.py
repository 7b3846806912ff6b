"""Charts: functions from results to matplotlib Axes; nothing here computes physics."""

from .accuracy import plot_accuracy, plot_coupling_error
from .canvas import new_axes, save
from .motion import plot_locus, plot_orbits
from .stability import plot_stability

__all__ = [
    "new_axes",
    "plot_accuracy",
    "plot_coupling_error",
    "plot_locus",
    "plot_orbits",
    "plot_stability",
    "save",
]
