"""Periodic motion: synchronous orbits, their folds and stability, and what they transmit."""

from .bistable import BistableMap, bistability_limit, bistable_map
from .branches import Fold, OrbitBranch, SynchronousOrbits, orbits_over_speed, synchronous_orbits
from .motion import cartesian_state, polar_acceleration, polar_series, transmitted_ratio

__all__ = [
    "BistableMap",
    "Fold",
    "OrbitBranch",
    "SynchronousOrbits",
    "bistability_limit",
    "bistable_map",
    "cartesian_state",
    "orbits_over_speed",
    "polar_acceleration",
    "polar_series",
    "synchronous_orbits",
    "transmitted_ratio",
]
