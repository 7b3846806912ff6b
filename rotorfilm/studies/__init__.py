"""Studies of models: error against cost, stability, and the atlas of limits."""

from typing import TYPE_CHECKING

from ..core.sources import show

if TYPE_CHECKING:
    from ..bearings.journal import fitted_bearing as fitted_bearing
    from ..core.sources import show
    from .ball_accuracy import (
        BallAccuracy as BallAccuracy,
        BallCurves as BallCurves,
        BallModelRung as BallModelRung,
        ball_accuracy as ball_accuracy,
        ball_curves as ball_curves,
        usual_bearing as usual_bearing,
    )
    from .bearing_types import (
        BearingCoefficients as BearingCoefficients,
        BearingThresholds as BearingThresholds,
        BearingType as BearingType,
        TypeCoefficients as TypeCoefficients,
        TypeThresholds as TypeThresholds,
        WhirlOutcome as WhirlOutcome,
        bearing_coefficients as bearing_coefficients,
        bearing_thresholds as bearing_thresholds,
        bearing_types as bearing_types,
    )
    from .bush_tiers import (
        BushTier as BushTier,
        BushTiers as BushTiers,
        ShaftFluxError as ShaftFluxError,
        bush_tiers as bush_tiers,
        shaft_flux_errors as shaft_flux_errors,
    )
    from .contact_cases import contact_cases as contact_cases
    from .contact_precision import contact_limits as contact_limits, contact_precision as contact_precision
    from .coupling_cost import (
        CostRow as CostRow,
        CouplingCost as CouplingCost,
        CouplingLimits as CouplingLimits,
        LimitRow as LimitRow,
        coupling_cost as coupling_cost,
        coupling_limits as coupling_limits,
    )
    from .damper_accuracy import (
        DamperAccuracy as DamperAccuracy,
        DamperRung as DamperRung,
        SqueezeFamily as SqueezeFamily,
        damper_accuracy as damper_accuracy,
        damper_rungs as damper_rungs,
    )
    from .heat_accuracy import (
        HEAT_CASES as HEAT_CASES,
        HeatAccuracy as HeatAccuracy,
        HeatAnswer as HeatAnswer,
        HeatCase as HeatCase,
        HeatLadder as HeatLadder,
        HeatModel as HeatModel,
        HeatRung as HeatRung,
        heat_accuracy as heat_accuracy,
    )
    from .journal_accuracy import (
        LARGE as LARGE,
        SMALL as SMALL,
        ComparedFilm as ComparedFilm,
        FilmFamily as FilmFamily,
        JournalAccuracy as JournalAccuracy,
        RungAccuracy as RungAccuracy,
        StateRange as StateRange,
        comparison_bearing as comparison_bearing,
        journal_accuracy as journal_accuracy,
        journal_rungs as journal_rungs,
        pareto_front as pareto_front,
        random_states as random_states,
    )
    from .journal_stability import (
        JournalStability as JournalStability,
        RungStability as RungStability,
        journal_stability as journal_stability,
    )
    from .limits_atlas import limits_atlas as limits_atlas
    from .limits_journal import (
        Failure as Failure,
        Limit as Limit,
        LimitAtlas as LimitAtlas,
        Panel as Panel,
        failures as failures,
    )
    from .pad_accuracy import (
        ComparedPad as ComparedPad,
        PadAccuracy as PadAccuracy,
        PadFamily as PadFamily,
        PadRung as PadRung,
        pad_accuracy as pad_accuracy,
        pad_rungs as pad_rungs,
    )
else:
    show(__name__)
