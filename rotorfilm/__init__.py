"""Bearing reactions for rotor dynamics, handed to any simulator.

The public names load on first use, so that `import rotorfilm` costs nothing that is not needed.
"""

from typing import TYPE_CHECKING

from .core.sources import offer, show

if TYPE_CHECKING:
    from .analysis import *
    from .bearings import *
    from .core.errors import (
        AbsentError as AbsentError,
        ContactError as ContactError,
        ConvergenceError as ConvergenceError,
        CouplingError as CouplingError,
        CouplingWarning as CouplingWarning,
        EquilibriumError as EquilibriumError,
        FileWarning as FileWarning,
        FilmContactError as FilmContactError,
        FmuError as FmuError,
        FmuFileError as FmuFileError,
        FmuRunError as FmuRunError,
        InputError as InputError,
        PartialResultError as PartialResultError,
        RotorfilmError as RotorfilmError,
        SceneError as SceneError,
        UndefinedDerivativeError as UndefinedDerivativeError,
        UnknownArgumentError as UnknownArgumentError,
        UnloadedPadWarning as UnloadedPadWarning,
        ValidityWarning as ValidityWarning,
    )
    from .core.model import (
        Dynamic as Dynamic,
        Linearization as Linearization,
        Model as Model,
        Reaction as Reaction,
        Stepped as Stepped,
        Switched as Switched,
    )
    from .core.results import (
        CircularOrbit as CircularOrbit,
        Coefficients as Coefficients,
        Equilibrium as Equilibrium,
        Trajectory as Trajectory,
        WhirlThreshold as WhirlThreshold,
    )
    from .core.signals import Signal as Signal
    from .cosim import *
    from .fmu import *
    from .identification import *
    from .rotors import *
    from .scenes import *
    from .sweeps import *

    __version__: str
else:
    show(__name__)

offer("plot_result", f"{__name__}.charts")  # which `plot()` of results calls
offer("ask", f"{__name__}.questions")  # which scenes with a question call
offer("ladders_of", f"{__name__}.questions")  # which a new scene lists
