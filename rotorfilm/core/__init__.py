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
    from .frames import write_csv
    from .inputs import BUILT, units_of
    from .model import (
        Dynamic as Dynamic,
        Linearization as Linearization,
        Model as Model,
        Stepped as Stepped,
        Switched as Switched,
        static_linearization,
        stops,
    )
    from .port import Reaction as Reaction, carries_load, largest_eccentricity_ratio, prepared_tangent
    from .readable import Readable
    from .results import (
        CircularOrbit as CircularOrbit,
        Coefficients as Coefficients,
        Equilibrium as Equilibrium,
        Trajectory as Trajectory,
        WhirlThreshold as WhirlThreshold,
        orbit_distance,
        to_plain,
    )
    from .saved_results import load_result as load_result, save_result as save_result
    from .signals import (
        FORCE_OUTPUTS,
        JOURNAL_INPUTS,
        Signal as Signal,
        force_outputs,
        from_fmi_name,
        indices,
        journal_inputs,
        names,
        signals_of,
        to_fmi_name,
    )
    from .sources import published
    from .units import CELSIUS, DISPLAY_UNITS, UNITS, parse_quantity, si_name
else:
    show(__name__)
