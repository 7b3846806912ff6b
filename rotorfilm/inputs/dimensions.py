"""The sizes that machines have, for the warning that a number is in another unit than SI."""

from __future__ import annotations

import math
from typing import Any

from ..errors import warn_user
from ..units import DISPLAY_UNITS, UNITS, si_name

BUILT: dict[str, tuple[str, float, float]] = {
    "radius": ("m", 1e-5, 5.0),
    "outer_radius": ("m", 1e-5, 5.0),
    "shaft_radius": ("m", 1e-5, 5.0),
    "outer_diameter": ("m", 1e-5, 10.0),
    "length": ("m", 1e-6, 20.0),
    "clearance": ("m", 1e-8, 1e-2),
    "thickness": ("m", 1e-7, 1.0),
    "permeability": ("m2", 0.0, 1e-6),
    "viscosity": ("Pa s", 0.0, 1e3),
    "pressure_coefficient": ("1/Pa", 0.0, 1e-6),
    "modulus": ("Pa", 1e5, math.inf),
    "young_modulus": ("Pa", 1e5, math.inf),
    "shear_modulus": ("Pa", 1e4, math.inf),
    "density": ("kg/m3", 0.0, 1e5),
    "mass": ("kg", 0.0, 1e7),
    "speed": ("rad/s", 0.0, 1e6),
}
"""Unit, smallest and largest size of what is built, by the name of an argument, from micromachines to
hydrogenerators and from gases to greases. What a study lets go to zero or to infinity, as
a viscosity or the modulus of a rigid shaft, has no bound there."""


def built_unit(name: str, value: float, unit: str) -> str:
    """Return the first unit in which a number is a size that is built; empty where there is none."""
    measure, least, most = BUILT.get(name) or BUILT.get(name.replace("diameter", "radius"), ("", 0.0, 0.0))
    if unit != measure:
        return ""
    same = UNITS[si_name(unit)].exponents
    fitting = (
        other
        for other, scale in DISPLAY_UNITS.items()
        if scale.exponents == same and least <= abs(value) * scale.factor <= most
    )
    return next(fitting, "")


def warn_of_odd_size(name: str, value: Any, unit: str) -> None:
    """Warn where a number in this unit is far outside of what is built; say which unit may be meant."""
    measure, least, most = BUILT[name]
    if unit != measure or not isinstance(value, float | int):
        return
    if value == 0.0 or least <= abs(value) <= most or abs(value) == math.inf:
        return
    meant = built_unit(name, value, unit)
    warn_user(
        f"{name} should be {least:g} to {most:g} {unit}, got {value:g}"
        f"{f': {value:g} {meant}?' if meant else ''}"
    )
