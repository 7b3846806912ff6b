"""FMU export: native FMUs of models with a kernel, FMI 2.0 and 3.0; any other through PythonFMU; systems."""

from typing import TYPE_CHECKING

from ..sources import show

if TYPE_CHECKING:
    from ..signals import Variable
    from .check.check_fmu import CheckItem, check_fmu
    from .check.described import describe_fmu
    from .description.variables import fmi_variables
    from .export import export_fmu as export_fmu
    from .system_export import export_ssp as export_ssp
else:
    show(__name__)
