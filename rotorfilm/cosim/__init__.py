"""Co-simulation of rotor and films: schemes, their stability limits, and the detection of chatter."""

from .auto import Auto, choose_scheme
from .chatter import CouplingReport, inspect_coupling
from .cosim_run import Choice, CoSimulation, Trial, couple
from .coupling_loop import squeeze_limit
from .coupling_stability import (
    CouplingStability,
    CriticalMacroStep,
    coupling_stability,
    critical_macro_step,
)
from .fmu_slave import FmuSlave
from .master import cosimulate, open_fmu, open_rotor
from .schemes.adaptive import Adaptive
from .schemes.explicit import GaussSeidel, Jacobi
from .schemes.implicit import SIExp, SIExp3
from .schemes.newton import Newton
from .schemes.scheme import Scheme
from .slaves import InProcessSlave, Slave
from .watch import CouplingWatch
