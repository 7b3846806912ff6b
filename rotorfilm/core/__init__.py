"""What every part uses: models and signals, units, errors, results, checked files."""

from typing import TYPE_CHECKING

from .sources import show

if TYPE_CHECKING:
    from .errors import (
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
    from .model import (
        Dynamic as Dynamic,
        Linearization as Linearization,
        Model as Model,
        Reaction as Reaction,
        Stepped as Stepped,
        Switched as Switched,
    )
    from .results import (
        CircularOrbit as CircularOrbit,
        Coefficients as Coefficients,
        Equilibrium as Equilibrium,
        Trajectory as Trajectory,
        WhirlThreshold as WhirlThreshold,
    )
    from .signals import Signal as Signal
    from .sources import published
else:
    show(__name__)
