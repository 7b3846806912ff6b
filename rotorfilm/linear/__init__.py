"""Linear analysis: equilibrium, coefficients, whirl, and systems for python-control."""

from typing import TYPE_CHECKING, Any

from .campbell import Campbell, CriticalSpeed, campbell, critical_speed_map, critical_speeds
from .closed_loop import closed_loop, transmissibility
from .coefficients import coefficient_table, coefficients
from .critical_mass import CriticalMass, critical_mass, damping_has_rank_one
from .equilibrium import equilibrium
from .heated_equilibrium import HeatedEquilibrium, heated_equilibrium
from .linearize import OperatingPoint, linearize
from .orbit_coefficients import (
    OrbitCoefficients,
    orbit_coefficients,
    orbit_system,
    small_motion_transmissibility,
)
from .rotor_modes import RotorModes, rotor_modes
from .rotor_rest import RotorEquilibrium, rotor_equilibrium
from .rotor_system import rotor_system, rotor_transmissibility, unbalance_response
from .rotor_threshold import RotorThreshold, rotor_threshold
from .whirl import speed_parameter, whirl_threshold

if TYPE_CHECKING:
    from .nonlinear_system import ModelSystem, to_nlsys

__all__ = [
    "Campbell",
    "CriticalMass",
    "CriticalSpeed",
    "HeatedEquilibrium",
    "ModelSystem",
    "OperatingPoint",
    "OrbitCoefficients",
    "RotorEquilibrium",
    "RotorModes",
    "RotorThreshold",
    "campbell",
    "closed_loop",
    "coefficient_table",
    "coefficients",
    "critical_mass",
    "critical_speed_map",
    "critical_speeds",
    "damping_has_rank_one",
    "equilibrium",
    "heated_equilibrium",
    "linearize",
    "orbit_coefficients",
    "orbit_system",
    "rotor_equilibrium",
    "rotor_modes",
    "rotor_system",
    "rotor_threshold",
    "rotor_transmissibility",
    "small_motion_transmissibility",
    "speed_parameter",
    "to_nlsys",
    "transmissibility",
    "unbalance_response",
    "whirl_threshold",
]


def __getattr__(name: str) -> Any:
    """Import what is derived from a class of python-control when it is asked for: that takes a second."""
    if name not in ("ModelSystem", "to_nlsys"):
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    from . import nonlinear_system

    return getattr(nonlinear_system, name)
