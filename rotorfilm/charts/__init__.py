"""Charts: functions from results to matplotlib Axes; nothing here computes physics."""

from .bush_charts import plot_contact_pressure, plot_critical_speed
from .canvas import new_axes, new_figure, save
from .comparisons.bush_tier_charts import plot_bush_tiers, plot_shaft_flux_error
from .comparisons.contact_case_charts import plot_contact_cases
from .comparisons.contact_ladder import plot_contact_limits, plot_contact_precision
from .comparisons.coupling_charts import plot_coupling_cost, plot_coupling_limits
from .comparisons.coupling_error import plot_coupling_error
from .comparisons.damper_ladder import plot_damper_accuracy
from .comparisons.limit_charts import plot_limits
from .comparisons.scene_ladder import RungPoint, plot_scene_ladder
from .comparisons.whirl_verdicts import plot_journal_stability, plot_thresholds
from .comparisons.work_precision import plot_force_error, plot_journal_accuracy
from .damper_charts import (
    plot_bistable,
    plot_damper_run,
    plot_eccentricity,
    plot_phase,
    plot_transmissibility,
    plot_transmitted,
)
from .motion_charts import plot_locus, plot_orbits
from .page import write_page
from .rotor_charts import (
    plot_campbell,
    plot_critical_speed_map,
    plot_log_decrement,
    plot_mode_shape,
    plot_unbalance_response,
)
from .whirl_charts import plot_basin, plot_orbit_curves

__all__ = [
    "RungPoint",
    "new_axes",
    "new_figure",
    "plot_basin",
    "plot_bistable",
    "plot_bush_tiers",
    "plot_campbell",
    "plot_contact_cases",
    "plot_contact_limits",
    "plot_contact_precision",
    "plot_contact_pressure",
    "plot_coupling_cost",
    "plot_coupling_error",
    "plot_coupling_limits",
    "plot_critical_speed",
    "plot_critical_speed_map",
    "plot_damper_accuracy",
    "plot_damper_run",
    "plot_eccentricity",
    "plot_force_error",
    "plot_journal_accuracy",
    "plot_journal_stability",
    "plot_limits",
    "plot_locus",
    "plot_log_decrement",
    "plot_mode_shape",
    "plot_orbit_curves",
    "plot_orbits",
    "plot_phase",
    "plot_scene_ladder",
    "plot_shaft_flux_error",
    "plot_thresholds",
    "plot_transmissibility",
    "plot_transmitted",
    "plot_unbalance_response",
    "save",
    "write_page",
]
