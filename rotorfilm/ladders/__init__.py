"""Ladders: every model of one physics from the cheapest law to the reference, measured side by side."""

from .contact_cases import contact_cases
from .damper_accuracy import DamperAccuracy, DamperRung, damper_accuracy, damper_rungs
from .journal_accuracy import JournalAccuracy, RungAccuracy, journal_accuracy, pareto_front
from .journal_rungs import Rung, comparison_bearing, fitted_bearing, journal_rungs
from .journal_stability import journal_stability
from .journal_states import LARGE, SMALL, StateRange, random_states
from .journal_thresholds import JournalStability, RungStability

__all__ = [
    "LARGE",
    "SMALL",
    "DamperAccuracy",
    "DamperRung",
    "JournalAccuracy",
    "JournalStability",
    "Rung",
    "RungAccuracy",
    "RungStability",
    "StateRange",
    "comparison_bearing",
    "contact_cases",
    "damper_accuracy",
    "damper_rungs",
    "fitted_bearing",
    "journal_accuracy",
    "journal_rungs",
    "journal_stability",
    "pareto_front",
    "random_states",
]
