"""FMU export: native FMUs of models with a kernel, FMI 2.0 and 3.0; any other through PythonFMU; systems."""

from typing import TYPE_CHECKING

from ..core.sources import show

if TYPE_CHECKING:
    from ..core.signals import Variable
    from .check_fmu import CheckItem, check_fmu
    from .description import fmi_variables
    from .export import export_fmu as export_fmu
    from .instance import describe_fmu, extracted, instantiated
    from .layered import add_references
    from .reference import advance, from_state_space
    from .system_export import export_ssp as export_ssp
else:
    show(__name__)
