"""The lubricant of a bearing: one viscosity, or an oil and how warm it is."""

from __future__ import annotations

from typing import cast

from ...errors import InputError, require_kind, require_positive
from .cooling import Cooling, require_absolute
from .oil import Oil


def require_lubricant(
    viscosity: float | None, oil: Oil | None, temperature: float | None, cooling: Cooling | None
) -> None:
    """Raise InputError unless there is a viscosity [Pa s], or an oil with temperature [K] or cooling."""
    if oil is None:
        if viscosity is None:
            raise InputError("viscosity or oil must be given, got neither")
        require_positive("viscosity", viscosity)
        for name, value in (("temperature", temperature), ("cooling", cooling)):
            if value is not None:
                raise InputError(f"{name} must be None without oil, got {value!r}")
        return
    require_kind("oil", oil, Oil, "an Oil such as Oil.iso_vg(46)")
    if viscosity is not None:
        raise InputError(f"viscosity must be None where oil is given, got {viscosity!r}")
    require_kind("cooling", cooling, Cooling | None, "a Cooling")
    if temperature is not None:
        require_absolute("temperature", temperature)
    elif cooling is None:
        raise InputError("temperature or cooling must be given with oil, got neither")


def film_viscosity(
    viscosity: float | None, oil: Oil | None, temperature: float | None, cooling: Cooling | None
) -> float:
    """Return the viscosity of a lubricant [Pa s] that `require_lubricant` let pass.

    Of an oil without a temperature it is that of fresh oil.
    """
    if oil is None:
        return cast(float, viscosity)
    stated = cast(Cooling, cooling).supply_temperature if temperature is None else temperature
    return float(oil.law.viscosity(stated))
