"""Periodic orbits and large motion; they live in `motion`."""

from .motion import (
    BasinScan,
    Bifurcation,
    HopfPoint,
    OrbitCurve,
    OrbitEvent,
    PeriodicOrbit,
    basin_scan,
    continue_orbits,
    hopf_point,
    periodic_orbit,
    simulate_rotor,
)

__all__ = [
    "BasinScan",
    "Bifurcation",
    "HopfPoint",
    "OrbitCurve",
    "OrbitEvent",
    "PeriodicOrbit",
    "basin_scan",
    "continue_orbits",
    "hopf_point",
    "periodic_orbit",
    "simulate_rotor",
]
