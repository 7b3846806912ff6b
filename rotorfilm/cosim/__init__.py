"""Co-simulation of rotor and film: masters, their stability limit, and the detection of chatter."""

from .chatter import CouplingReport, inspect_coupling
from .fmu_slave import FmuSlave, open_fmu
from .master import CoSimulation, cosimulate, couple
from .slaves import InProcessSlave, Slave
from .stability import CouplingStability, CriticalMacroStep, coupling_stability, critical_macro_step

__all__ = [
    "CoSimulation",
    "CouplingReport",
    "CouplingStability",
    "CriticalMacroStep",
    "FmuSlave",
    "InProcessSlave",
    "Slave",
    "cosimulate",
    "couple",
    "coupling_stability",
    "critical_macro_step",
    "inspect_coupling",
    "open_fmu",
]
