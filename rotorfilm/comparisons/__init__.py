"""Ladders: every model of one physics from the cheapest law to the reference, measured side by side."""

from typing import TYPE_CHECKING

from ..sources import show

if TYPE_CHECKING:
    from ..bearings.journal import fitted_bearing as fitted_bearing
    from .bush_tiers import (
        BushTier as BushTier,
        BushTiers as BushTiers,
        ShaftFluxError as ShaftFluxError,
        bush_tiers as bush_tiers,
        shaft_flux_errors as shaft_flux_errors,
    )
    from .contact.contact_cases import contact_cases as contact_cases
    from .contact.contact_limits import contact_limits as contact_limits
    from .contact.contact_precision import contact_precision as contact_precision
    from .coupling.coupling_cost import (
        CostRow as CostRow,
        CouplingCost as CouplingCost,
        coupling_cost as coupling_cost,
    )
    from .coupling.coupling_limits import (
        CouplingLimits as CouplingLimits,
        LimitRow as LimitRow,
        coupling_limits as coupling_limits,
    )
    from .damper_accuracy import (
        DamperAccuracy as DamperAccuracy,
        DamperRung as DamperRung,
        SqueezeFamily as SqueezeFamily,
        damper_accuracy as damper_accuracy,
        damper_rungs as damper_rungs,
    )
    from .journal.heat_accuracy import (
        HeatAccuracy as HeatAccuracy,
        HeatLadder as HeatLadder,
        HeatRung as HeatRung,
        heat_accuracy as heat_accuracy,
    )
    from .journal.heat_cases import HEAT_CASES as HEAT_CASES, HeatCase as HeatCase
    from .journal.heat_models import HeatAnswer as HeatAnswer, HeatModel as HeatModel
    from .journal.journal_accuracy import (
        JournalAccuracy as JournalAccuracy,
        RungAccuracy as RungAccuracy,
        journal_accuracy as journal_accuracy,
        pareto_front as pareto_front,
    )
    from .journal.journal_rungs import (
        ComparedFilm as ComparedFilm,
        FilmFamily as FilmFamily,
        comparison_bearing as comparison_bearing,
        journal_rungs as journal_rungs,
    )
    from .journal.journal_stability import journal_stability as journal_stability
    from .journal.journal_states import (
        LARGE as LARGE,
        SMALL as SMALL,
        StateRange as StateRange,
        random_states as random_states,
    )
    from .journal.journal_thresholds import (
        JournalStability as JournalStability,
        RungStability as RungStability,
    )
    from .limits.limit_panels import (
        Failure as Failure,
        Limit as Limit,
        LimitAtlas as LimitAtlas,
        Panel as Panel,
        failures as failures,
    )
    from .limits.limits_atlas import limits_atlas as limits_atlas
    from .pads.bearing_types import BearingType as BearingType, bearing_types as bearing_types
    from .pads.pad_accuracy import (
        ComparedPad as ComparedPad,
        PadAccuracy as PadAccuracy,
        PadFamily as PadFamily,
        PadRung as PadRung,
        pad_accuracy as pad_accuracy,
        pad_rungs as pad_rungs,
    )
    from .pads.type_coefficients import (
        BearingCoefficients as BearingCoefficients,
        TypeCoefficients as TypeCoefficients,
        bearing_coefficients as bearing_coefficients,
    )
    from .pads.type_thresholds import (
        BearingThresholds as BearingThresholds,
        TypeThresholds as TypeThresholds,
        WhirlOutcome as WhirlOutcome,
        bearing_thresholds as bearing_thresholds,
    )
    from .rolling.ball_accuracy import (
        BallAccuracy as BallAccuracy,
        BallModelRung as BallModelRung,
        ball_accuracy as ball_accuracy,
    )
    from .rolling.ball_curves import (
        BallCurves as BallCurves,
        ball_curves as ball_curves,
        usual_bearing as usual_bearing,
    )
else:
    show(__name__)
