"""Co-simulation of rotor and films: schemes, their stability limits, and the detection of chatter."""

from .adaptive import Adaptive
from .auto import Auto, choose_scheme
from .chatter import CouplingReport, inspect_coupling
from .choice import Choice, Trial
from .explicit import GaussSeidel, Jacobi
from .fmu_slave import FmuSlave, open_fmu, open_rotor
from .implicit import SIExp, SIExp3
from .master import cosimulate
from .newton import Newton
from .run import CoSimulation, couple
from .scheme import Scheme
from .slaves import InProcessSlave, Slave
from .stability import (
    CouplingStability,
    CriticalMacroStep,
    coupling_stability,
    critical_macro_step,
    squeeze_limit,
)
from .watch import CouplingWatch

__all__ = [
    "Adaptive",
    "Auto",
    "Choice",
    "CoSimulation",
    "CouplingReport",
    "CouplingStability",
    "CouplingWatch",
    "CriticalMacroStep",
    "FmuSlave",
    "GaussSeidel",
    "InProcessSlave",
    "Jacobi",
    "Newton",
    "SIExp",
    "SIExp3",
    "Scheme",
    "Slave",
    "Trial",
    "choose_scheme",
    "cosimulate",
    "couple",
    "coupling_stability",
    "critical_macro_step",
    "inspect_coupling",
    "open_fmu",
    "open_rotor",
    "squeeze_limit",
]
