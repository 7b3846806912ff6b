"""Linear analysis: equilibrium, coefficients, whirl, and systems for python-control."""

from .closed_loop import closed_loop, transmissibility
from .coefficients import coefficients
from .critical_mass import CriticalMass, critical_mass, damping_has_rank_one
from .equilibrium import equilibrium
from .linearize import OperatingPoint, linearize
from .nonlinear_system import ModelSystem, to_nlsys
from .orbit import OrbitCoefficients, orbit_coefficients, orbit_system, small_motion_transmissibility
from .whirl import speed_parameter, whirl_threshold

__all__ = [
    "CriticalMass",
    "ModelSystem",
    "OperatingPoint",
    "OrbitCoefficients",
    "closed_loop",
    "coefficients",
    "critical_mass",
    "damping_has_rank_one",
    "equilibrium",
    "linearize",
    "orbit_coefficients",
    "orbit_system",
    "small_motion_transmissibility",
    "speed_parameter",
    "to_nlsys",
    "transmissibility",
    "whirl_threshold",
]
