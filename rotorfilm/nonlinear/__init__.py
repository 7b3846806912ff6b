"""Large motion of rotors on films: compiled time integration, periodic orbits and where they come from."""

from .basin import BasinScan, basin_scan
from .continuation import Bifurcation, OrbitCurve, OrbitEvent, continue_orbits
from .hopf import HopfPoint, hopf_point
from .periodic import PeriodicOrbit, periodic_orbit
from .simulate import simulate_rotor

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
