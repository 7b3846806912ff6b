"""Co-simulation of rotor and films: schemes, their stability limits, and the detection of chatter."""

from typing import TYPE_CHECKING

from ..sources import show

if TYPE_CHECKING:
    from .auto import Auto as Auto, choose_scheme
    from .chatter import CouplingReport as CouplingReport, inspect_coupling
    from .cosim_run import Choice, CoSimulation as CoSimulation, Trial, couple
    from .coupling_loop import squeeze_limit
    from .coupling_stability import (
        CouplingStability,
        CriticalMacroStep,
        coupling_stability as coupling_stability,
        critical_macro_step as critical_macro_step,
    )
    from .fmu_slave import FmuSlave
    from .master import cosimulate as cosimulate, open_fmu, open_rotor
    from .schemes.adaptive import Adaptive as Adaptive
    from .schemes.explicit import GaussSeidel as GaussSeidel, Jacobi as Jacobi
    from .schemes.implicit import SIExp as SIExp, SIExp3 as SIExp3
    from .schemes.newton import Newton as Newton
    from .schemes.remembering import SIMemory as SIMemory
    from .schemes.scheme import Scheme as Scheme
    from .slaves import InProcessSlave, Slave
    from .watch import CouplingWatch as CouplingWatch
else:
    show(__name__)
