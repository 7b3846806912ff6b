"""FMU export: native FMUs of models with a kernel, FMI 2.0 and 3.0; any other model through PythonFMU."""

from .check import CheckItem, check_fmu
from .described import describe_fmu
from .export import export_fmu
from .variables import Variable, fmi_variables

__all__ = ["CheckItem", "Variable", "check_fmu", "describe_fmu", "export_fmu", "fmi_variables"]
