"""FMU export: any model as an FMI 2.0 Co-Simulation FMU, through PythonFMU."""

from .export import export_fmu
from .variables import Variable, fmi_variables

__all__ = ["Variable", "export_fmu", "fmi_variables"]
