"""Units: the SI base exponents that FMI wants, and the factors that scene files and the CLI accept."""

from __future__ import annotations

import math
import re
from dataclasses import dataclass, field

from .errors import InputError, brief
from .limits import MAGNITUDE

STANDARD_GRAVITY = 9.80665
"""Standard acceleration of gravity [m/s2], by definition."""

CELSIUS = 273.15
"""0 degrees Celsius [K], by definition."""

_INCH = 0.0254
_POUND_FORCE = 0.45359237 * STANDARD_GRAVITY


@dataclass(frozen=True)
class Unit:
    """A unit as a factor times powers of the SI base units (kg, m, s, K, rad).

    Attributes
    ----------
    factor : float
        Value of one unit in SI base units.
    exponents : dict of str to int
        Power of each SI base unit; absent means zero.
    zero : float
        What the unit's own zero is in SI base units; not 0 of a temperature scale only.
    """

    factor: float
    exponents: dict[str, int] = field(default_factory=dict)
    zero: float = 0.0


UNITS: dict[str, Unit] = {
    "1": Unit(1.0),
    "m": Unit(1.0, {"m": 1}),
    "m2": Unit(1.0, {"m": 2}),
    "s": Unit(1.0, {"s": 1}),
    "kg": Unit(1.0, {"kg": 1}),
    "rad": Unit(1.0, {"rad": 1}),
    "m/s": Unit(1.0, {"m": 1, "s": -1}),
    "m/s2": Unit(1.0, {"m": 1, "s": -2}),
    "rad/s": Unit(1.0, {"rad": 1, "s": -1}),
    "rad/s2": Unit(1.0, {"rad": 1, "s": -2}),
    "N": Unit(1.0, {"kg": 1, "m": 1, "s": -2}),
    "N/s": Unit(1.0, {"kg": 1, "m": 1, "s": -3}),
    "N/s2": Unit(1.0, {"kg": 1, "m": 1, "s": -4}),
    "N/m": Unit(1.0, {"kg": 1, "s": -2}),
    "N.s/m": Unit(1.0, {"kg": 1, "s": -1}),
    "Pa": Unit(1.0, {"kg": 1, "m": -1, "s": -2}),
    "1/Pa": Unit(1.0, {"kg": -1, "m": 1, "s": 2}),
    "Pa.s": Unit(1.0, {"kg": 1, "m": -1, "s": -1}),
    "kg.m": Unit(1.0, {"kg": 1, "m": 1}),
    "N.m": Unit(1.0, {"kg": 1, "m": 2, "s": -2}),
    "N.m/rad": Unit(1.0, {"kg": 1, "m": 2, "s": -2, "rad": -1}),
    "N.m.s/rad": Unit(1.0, {"kg": 1, "m": 2, "s": -1, "rad": -1}),
    "kg.m2": Unit(1.0, {"kg": 1, "m": 2}),
    "1/s": Unit(1.0, {"s": -1}),
    "J/m3": Unit(1.0, {"kg": 1, "m": -1, "s": -2}),
    "kg/m3": Unit(1.0, {"kg": 1, "m": -3}),
    "K": Unit(1.0, {"K": 1}),
    "1/K": Unit(1.0, {"K": -1}),
    "1/K2": Unit(1.0, {"K": -2}),
    "J/(kg.K)": Unit(1.0, {"m": 2, "s": -2, "K": -1}),
    "W/(m.K)": Unit(1.0, {"kg": 1, "m": 1, "s": -3, "K": -1}),
    "W/(m2.K)": Unit(1.0, {"kg": 1, "s": -3, "K": -1}),
    "J/(m3.K)": Unit(1.0, {"kg": 1, "m": -1, "s": -2, "K": -1}),
    "W/K": Unit(1.0, {"kg": 1, "m": 2, "s": -3, "K": -1}),
    "W": Unit(1.0, {"kg": 1, "m": 2, "s": -3}),
    "J/K": Unit(1.0, {"kg": 1, "m": 2, "s": -2, "K": -1}),
    "m3": Unit(1.0, {"m": 3}),
    "m2/s": Unit(1.0, {"m": 2, "s": -1}),
    "m3/s": Unit(1.0, {"m": 3, "s": -1}),
    "m2/(Pa.s)": Unit(1.0, {"kg": -1, "m": 3, "s": 1}),
}
"""The SI units of signals, by their FMI spelling."""

DISPLAY_UNITS: dict[str, Unit] = {
    **UNITS,
    "Pa s": UNITS["Pa.s"],
    "kg m": UNITS["kg.m"],
    "m2/(Pa s)": UNITS["m2/(Pa.s)"],
    "kg m2": UNITS["kg.m2"],
    "N m": UNITS["N.m"],
    "N m/rad": UNITS["N.m/rad"],
    "N m s/rad": UNITS["N.m.s/rad"],
    "N s/m": UNITS["N.s/m"],
    "kN m": Unit(1e3, {"kg": 1, "m": 2, "s": -2}),
    "N/mm": Unit(1e3, {"kg": 1, "s": -2}),
    "N/um": Unit(1e6, {"kg": 1, "s": -2}),
    "kN/m": Unit(1e3, {"kg": 1, "s": -2}),
    "MN/m": Unit(1e6, {"kg": 1, "s": -2}),
    "kN s/m": Unit(1e3, {"kg": 1, "s": -1}),
    "N s/mm": Unit(1e3, {"kg": 1, "s": -1}),
    "lbf s/in": Unit(_POUND_FORCE / _INCH, {"kg": 1, "s": -1}),
    "GPa": Unit(1e9, {"kg": 1, "m": -1, "s": -2}),
    "mm": Unit(1e-3, {"m": 1}),
    "um": Unit(1e-6, {"m": 1}),
    "um2": Unit(1e-12, {"m": 2}),
    "ms": Unit(1e-3, {"s": 1}),
    "g": Unit(1e-3, {"kg": 1}),
    "MPa": Unit(1e6, {"kg": 1, "m": -1, "s": -2}),
    "1/GPa": Unit(1e-9, {"kg": -1, "m": 1, "s": 2}),
    "MN": Unit(1e6, {"kg": 1, "m": 1, "s": -2}),
    "kN": Unit(1e3, {"kg": 1, "m": 1, "s": -2}),
    "mPa s": Unit(1e-3, {"kg": 1, "m": -1, "s": -1}),
    "g mm": Unit(1e-6, {"kg": 1, "m": 1}),
    "kPa": Unit(1e3, {"kg": 1, "m": -1, "s": -2}),
    "bar": Unit(1e5, {"kg": 1, "m": -1, "s": -2}),
    "cP": Unit(1e-3, {"kg": 1, "m": -1, "s": -1}),
    "cSt": Unit(1e-6, {"m": 2, "s": -1}),
    "mm2/s": Unit(1e-6, {"m": 2, "s": -1}),
    "l/min": Unit(1e-3 / 60.0, {"m": 3, "s": -1}),
    "kN/mm": Unit(1e6, {"kg": 1, "s": -2}),
    "MW": Unit(1e6, {"kg": 1, "m": 2, "s": -3}),
    "kW": Unit(1e3, {"kg": 1, "m": 2, "s": -3}),
    "kJ/K": Unit(1e3, {"kg": 1, "m": 2, "s": -2, "K": -1}),
    "degC": Unit(1.0, {"K": 1}, zero=CELSIUS),
    "in": Unit(_INCH, {"m": 1}),
    "lbf": Unit(_POUND_FORCE, {"kg": 1, "m": 1, "s": -2}),
    "lbf/in": Unit(_POUND_FORCE / _INCH, {"kg": 1, "s": -2}),
    "klbf/in": Unit(1e3 * _POUND_FORCE / _INCH, {"kg": 1, "s": -2}),
    "lb/ft3": Unit(0.45359237 / (12.0 * _INCH) ** 3, {"kg": 1, "m": -3}),
    "hp": Unit(550.0 * 12.0 * _INCH * _POUND_FORCE, {"kg": 1, "m": 2, "s": -3}),
    "psi": Unit(_POUND_FORCE / _INCH**2, {"kg": 1, "m": -1, "s": -2}),
    "deg": Unit(math.pi / 180.0, {"rad": 1}),
    "rpm": Unit(math.pi / 30.0, {"rad": 1, "s": -1}),
    "Hz": Unit(2.0 * math.pi, {"rad": 1, "s": -1}),
    "%": Unit(0.01),
}
"""Units accepted from Python, in scene files and at the command line, besides plain SI numbers."""

WEIGHT = f"; the weight of a mass is {STANDARD_GRAVITY} m/s2 times it"
"""What to say where a mass is given for a force."""

_QUANTITY = re.compile(r"^\s*([-+]?(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d+)?)\s*(.*?)\s*$")

_MICRO = str.maketrans({"\N{MICRO SIGN}": "u", "\N{GREEK SMALL LETTER MU}": "u", "\N{DEGREE SIGN}": "deg"})
"""Both signs of micro that keyboards have, and that of degrees."""

_NOT_FINITE = re.compile(r"^\s*[-+]?(?:nan|inf|infinity)\b", re.IGNORECASE)


def parse_quantity(text: str | float, unit: str, *, absolute: bool = False) -> float:
    """Return a quantity in SI.

    Parameters
    ----------
    text : str or float
        A plain number in `unit`, or a number with its unit, as `"0.1 mm"` or `"1500 rpm"`.
    unit : str
        The SI unit that the quantity must have, a key of `UNITS`.
    absolute : bool
        Whether a temperature is one, which may be given in degC, and not a difference of two.

    Raises
    ------
    InputError
        If the text is no finite quantity, is beyond `limits.MAGNITUDE`, its unit is unknown, or it measures
        something else than `unit`.
    """
    if isinstance(text, bool):
        raise InputError(f"quantity must be a number or a number with a unit, got {text!r}")
    if isinstance(text, int | float):
        return _sensible(text, text)
    if _NOT_FINITE.match(text):
        raise InputError(f"quantity must be finite, got {brief(text)}")
    match = _QUANTITY.match(text)
    if match is None:
        kind = "number such as '0.5'" if unit == "1" else f"number with a unit such as '1 {unit}'"
        raise InputError(f"quantity must be a {kind}, got {brief(text)}")
    name = (match[2] or unit).translate(_MICRO)
    name = next((known for known in (name, si_name(name), spaced(name)) if known in DISPLAY_UNITS), name)
    if name not in DISPLAY_UNITS:
        exponents = UNITS[unit].exponents
        fitting = sorted(known for known, other in DISPLAY_UNITS.items() if other.exponents == exponents)
        raise InputError(f"unit must be one of {', '.join(fitting)}, got {brief(name)} in {brief(text)}")
    found = DISPLAY_UNITS[name]
    value = float(match[1]) * found.factor
    if found.exponents != UNITS[unit].exponents:
        raise InputError(
            f"quantity must be measured in {unit} or a multiple of it, got {brief(text)}"
            f"{_weight_hint(value, name, unit)}"
        )
    if found.zero and not absolute:
        raise InputError(f"quantity must be a difference in {unit}, which has no zero, got {brief(text)}")
    return _sensible(value + found.zero, text)


def si_name(unit: str) -> str:
    """Return the key of `UNITS` of a unit as docstrings spell it, `"Pa s"` for `"Pa.s"`."""
    return unit.replace(" ", ".")


def spaced(unit: str) -> str:
    """Return a unit as people write it, `"mPa s"` for `"mPa.s"`."""
    return unit.replace(".", " ")


def _weight_hint(value: float, name: str, unit: str) -> str:
    """Return the force [N] that a mass [kg] is as a weight, where one stands for the other."""
    if unit != "N" or DISPLAY_UNITS[name].exponents != UNITS["kg"].exponents:
        return ""
    return f"{WEIGHT}, {value * STANDARD_GRAVITY:.6g} N"


def whole_number(text: str) -> int | None:
    """Return the whole number that a text is, of at most 18 digits; None where it is none."""
    return int(text) if re.fullmatch(r"\s*[0-9]{1,18}\s*", text) else None


def dotted_key(key: str) -> str:
    """Return a key with dots alone: `shaft.disks[0].mass`, as messages have it, is `shaft.disks.0.mass`."""
    return re.sub(r"\[([0-9]+)\]", r".\1", key)


def _sensible(value: float, text: str | float) -> float:
    """Return a number as a float; raise InputError unless it is 0 or of a size that products can bear."""
    if not abs(value) < math.inf:
        raise InputError(f"quantity must be finite, got {brief(text)}")
    if value != 0 and not 1.0 / MAGNITUDE <= abs(value) <= MAGNITUDE:
        raise InputError(
            f"quantity must be 0 or of a size from {1.0 / MAGNITUDE:g} to {MAGNITUDE:g} in SI, "
            f"got {brief(text)}"
        )
    return float(value)
