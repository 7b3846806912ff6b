"""Charts: functions from results to pictures, which matplotlib and plotly draw; no physics here."""

from typing import TYPE_CHECKING

from ..core.sources import show

if TYPE_CHECKING:
    from .canvas import (
        new_axes as new_axes,
        new_figure as new_figure,
    )
    from .film_charts import (
        plot_bistable as plot_bistable,
        plot_circumference as plot_circumference,
        plot_coefficients as plot_coefficients,
        plot_contact_pressure as plot_contact_pressure,
        plot_critical_speed as plot_critical_speed,
        plot_damper_run as plot_damper_run,
        plot_damper_speeds as plot_damper_speeds,
        plot_eccentricity as plot_eccentricity,
        plot_film as plot_film,
        plot_heated_film as plot_heated_film,
        plot_pad_pressure as plot_pad_pressure,
        plot_phase as plot_phase,
        plot_pressure_field as plot_pressure_field,
        plot_temperature_across as plot_temperature_across,
        plot_temperature_field as plot_temperature_field,
        plot_transmissibility as plot_transmissibility,
        plot_transmitted as plot_transmitted,
    )
    from .ladder_charts import (
        plot_study as plot_study,
    )
    from .on_matplotlib import save as save
    from .picture import (
        BarsMark as BarsMark,
        ColorScale as ColorScale,
        CurveMark as CurveMark,
        FieldMark as FieldMark,
        LevelMark as LevelMark,
        NoteMark as NoteMark,
        Picture as Picture,
        PicturePanel as PicturePanel,
        use as use,
    )
    from .result_charts import (
        picture_of as picture_of,
        plot_ball_curves as plot_ball_curves,
        plot_compliance as plot_compliance,
        plot_contact_run as plot_contact_run,
        plot_histogram as plot_histogram,
        plot_map as plot_map,
        plot_question as plot_question,
        plot_result as plot_result,
        plot_scene_ladder as plot_scene_ladder,
        plot_tornado as plot_tornado,
    )
    from .rotor_charts import (
        plot_basin as plot_basin,
        plot_campbell as plot_campbell,
        plot_clearance_check as plot_clearance_check,
        plot_critical_speed_map as plot_critical_speed_map,
        plot_locus as plot_locus,
        plot_log_decrement as plot_log_decrement,
        plot_orbit_curves as plot_orbit_curves,
        plot_orbits as plot_orbits,
        plot_periodic_orbit as plot_periodic_orbit,
        plot_polar_response as plot_polar_response,
        plot_separation_margins as plot_separation_margins,
        plot_shaft_statics as plot_shaft_statics,
        plot_stability_level_one as plot_stability_level_one,
        plot_unbalance_response as plot_unbalance_response,
    )
    from .run_charts import (
        plot_full_spectrum as plot_full_spectrum,
        plot_run_amplitudes as plot_run_amplitudes,
        plot_run_orbits as plot_run_orbits,
        plot_run_spectrum as plot_run_spectrum,
        plot_spectrogram as plot_spectrogram,
        plot_time_windows as plot_time_windows,
        plot_trajectory as plot_trajectory,
        plot_waterfall as plot_waterfall,
    )
    from .shaft_charts import (
        plot_bearing as plot_bearing,
        plot_deflected_orbits as plot_deflected_orbits,
        plot_deflected_shape as plot_deflected_shape,
        plot_mode_orbits as plot_mode_orbits,
        plot_mode_shape as plot_mode_shape,
        plot_rotor as plot_rotor,
    )
    from .study_charts import (
        plot_bearing_thresholds as plot_bearing_thresholds,
        plot_coupling_error as plot_coupling_error,
        plot_coupling_limits as plot_coupling_limits,
        plot_limit_summary as plot_limit_summary,
        plot_limits as plot_limits,
    )
    from .whirl_verdicts import (
        plot_journal_stability as plot_journal_stability,
        plot_thresholds as plot_thresholds,
        verdict_table as verdict_table,
    )
else:
    show(__name__)
