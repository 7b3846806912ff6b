"""The sizes that machines have, for the warning that a number is in another unit than SI."""

from __future__ import annotations

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
    "permeability": ("m2", 1e-20, 1e-6),
    "viscosity": ("Pa s", 1e-7, 1e3),
    "pressure_coefficient": ("1/Pa", 1e-12, 1e-6),
    "modulus": ("Pa", 1e5, 1e13),
    "young_modulus": ("Pa", 1e5, 1e13),
    "shear_modulus": ("Pa", 1e4, 1e13),
    "density": ("kg/m3", 1e-2, 3e4),
    "mass": ("kg", 1e-12, 1e7),
    "speed": ("rad/s", 0.0, 1e6),
}
"""Unit, smallest and largest size of what is built, by the name of an argument, from micromachines and gases
to hydrogenerators and greases. Zero is no size: where it may stand for nothing, the classes say."""


def warn_of_odd_size(name: str, value: float, unit: str) -> None:
    """Warn where a dimension [`unit`] is far outside of what is built, and say which unit may be meant."""
    measure, least, most = BUILT.get(name, ("", 0.0, 0.0))
    if unit != measure or value == 0.0 or least <= abs(value) <= most:
        return
    same = UNITS[si_name(unit)].exponents
    meant = (
        f": {value:g} {other}?"
        for other, scale in DISPLAY_UNITS.items()
        if scale.exponents == same and least <= abs(value) * scale.factor <= most
    )
    if abs(value) < float("inf"):
        warn_user(f"{name} should be {least:g} to {most:g} {unit}, got {value:g}{next(meant, '')}")
