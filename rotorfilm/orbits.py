"""Circular orbits; they live in `motion`."""

from .motion import (
    BistableMap,
    Fold,
    OrbitBranch,
    SynchronousOrbits,
    bistability_limit,
    bistable_map,
    cartesian_state,
    orbits_over_speed,
    polar_acceleration,
    polar_series,
    synchronous_orbits,
    transmitted_ratio,
)

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
