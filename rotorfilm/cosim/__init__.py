"""Co-simulation of rotor and films: schemes, their stability limits, and the detection of chatter."""

from typing import TYPE_CHECKING

from ..core.sources import show

if TYPE_CHECKING:
    from .coupling_loop import (
        CouplingStability,
        CriticalMacroStep,
        coupling_stability as coupling_stability,
        critical_macro_step as critical_macro_step,
        squeeze_limit,
    )
    from .fmu_slave import FmuSlave
    from .master import (
        Auto as Auto,
        Choice,
        CoSimulation as CoSimulation,
        Trial,
        choose_scheme,
        cosimulate as cosimulate,
        couple,
        open_fmu,
        open_rotor,
    )
    from .schemes import (
        Adaptive as Adaptive,
        GaussSeidel as GaussSeidel,
        Jacobi as Jacobi,
        Newton as Newton,
        Scheme as Scheme,
        SIExp as SIExp,
        SIExp3 as SIExp3,
        SIMemory as SIMemory,
    )
    from .slaves import InProcessSlave, Slave
    from .watch import CouplingReport as CouplingReport, CouplingWatch as CouplingWatch, inspect_coupling
else:
    show(__name__)
