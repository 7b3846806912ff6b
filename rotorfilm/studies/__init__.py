"""Studies of models: error against cost, stability, and the atlas of limits."""

from typing import TYPE_CHECKING

from ..core.sources import show

if TYPE_CHECKING:
    from ..bearings.journal import fitted_bearing as fitted_bearing
    from ..core.sources import show
    from .ball_accuracy import (
        BallCurves as BallCurves,
        ball_accuracy as ball_accuracy,
        ball_curves as ball_curves,
        usual_bearing as usual_bearing,
    )
    from .bearing_types import (
        WHIRL_OUTCOMES as WHIRL_OUTCOMES,
        bearing_coefficients as bearing_coefficients,
        bearing_thresholds as bearing_thresholds,
        bearing_types as bearing_types,
    )
    from .bush_accuracy import bush_tiers as bush_tiers
    from .contact_precision import contact_precision as contact_precision, decay_time as decay_time
    from .coupling_cost import coupling_cost as coupling_cost, coupling_limits as coupling_limits
    from .damper_accuracy import damper_accuracy as damper_accuracy
    from .heat_accuracy import (
        HEAT_CASES as HEAT_CASES,
        HeatCase as HeatCase,
        HeatModel as HeatModel,
        heat_accuracy as heat_accuracy,
    )
    from .journal_accuracy import (
        LARGE as LARGE,
        SMALL as SMALL,
        FilmFamily as FilmFamily,
        StateRange as StateRange,
        comparison_bearing as comparison_bearing,
        journal_accuracy as journal_accuracy,
        journal_rungs as journal_rungs,
        random_states as random_states,
        reference_force as reference_force,
    )
    from .journal_stability import journal_stability as journal_stability
    from .limits_atlas import (
        Panel as Panel,
        failures as failures,
        limit_curves as limit_curves,
        limits_atlas as limits_atlas,
    )
    from .pad_accuracy import pad_accuracy as pad_accuracy, pad_rungs as pad_rungs
    from .study import (
        States as States,
        Study as Study,
        StudyCase as StudyCase,
        StudyModel as StudyModel,
        StudyResult as StudyResult,
        StudyRow as StudyRow,
        film_costs as film_costs,
        pareto_front as pareto_front,
        relative_error as relative_error,
        run_study as run_study,
        shortest_time as shortest_time,
        timed as timed,
    )
else:
    show(__name__)
