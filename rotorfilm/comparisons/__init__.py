"""Ladders: every model of one physics from the cheapest law to the reference, measured side by side."""

from .bush_tiers import BushTier, BushTiers, ShaftFluxError, bush_tiers, shaft_flux_errors
from .contact.contact_cases import contact_cases
from .contact.contact_limits import contact_limits
from .contact.contact_precision import contact_precision
from .coupling.coupling_cost import CostRow, CouplingCost, coupling_cost
from .coupling.coupling_limits import CouplingLimits, LimitRow, coupling_limits
from .damper_accuracy import DamperAccuracy, DamperRung, SqueezeFamily, damper_accuracy, damper_rungs
from .journal.journal_accuracy import JournalAccuracy, RungAccuracy, journal_accuracy, pareto_front
from .journal.journal_rungs import ComparedFilm, FilmFamily, comparison_bearing, fitted_bearing, journal_rungs
from .journal.journal_stability import journal_stability
from .journal.journal_states import LARGE, SMALL, StateRange, random_states
from .journal.journal_thresholds import JournalStability, RungStability
from .limits.limit_panels import Failure, Limit, LimitAtlas, Panel, failures
from .limits.limits_atlas import limits_atlas

__all__ = [
    "LARGE",
    "SMALL",
    "BushTier",
    "BushTiers",
    "ComparedFilm",
    "CostRow",
    "CouplingCost",
    "CouplingLimits",
    "DamperAccuracy",
    "DamperRung",
    "Failure",
    "FilmFamily",
    "JournalAccuracy",
    "JournalStability",
    "Limit",
    "LimitAtlas",
    "LimitRow",
    "Panel",
    "RungAccuracy",
    "RungStability",
    "ShaftFluxError",
    "SqueezeFamily",
    "StateRange",
    "bush_tiers",
    "comparison_bearing",
    "contact_cases",
    "contact_limits",
    "contact_precision",
    "coupling_cost",
    "coupling_limits",
    "damper_accuracy",
    "damper_rungs",
    "failures",
    "fitted_bearing",
    "journal_accuracy",
    "journal_rungs",
    "journal_stability",
    "limits_atlas",
    "pareto_front",
    "random_states",
    "shaft_flux_errors",
]
