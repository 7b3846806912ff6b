"""Motion over time, periodic orbits and circular ones."""

from .circular.bistable import BistableMap, bistability_limit, bistable_map
from .circular.branches import Fold, OrbitBranch, SynchronousOrbits, orbits_over_speed, synchronous_orbits
from .circular.cartesian_motion import cartesian_state, polar_acceleration, polar_series, transmitted_ratio
from .compiled.simulate_rotor import simulate_rotor
from .periodic.basin import BasinScan, basin_scan
from .periodic.continuation import Bifurcation, OrbitCurve, OrbitEvent, continue_orbits
from .periodic.hopf import HopfPoint, hopf_point
from .periodic.periodic_orbit import PeriodicOrbit, periodic_orbit
from .transient.simulate import simulate

__all__ = [
    "BasinScan",
    "Bifurcation",
    "BistableMap",
    "Fold",
    "HopfPoint",
    "OrbitBranch",
    "OrbitCurve",
    "OrbitEvent",
    "PeriodicOrbit",
    "SynchronousOrbits",
    "basin_scan",
    "bistability_limit",
    "bistable_map",
    "cartesian_state",
    "continue_orbits",
    "hopf_point",
    "orbits_over_speed",
    "periodic_orbit",
    "polar_acceleration",
    "polar_series",
    "simulate",
    "simulate_rotor",
    "synchronous_orbits",
    "transmitted_ratio",
]
