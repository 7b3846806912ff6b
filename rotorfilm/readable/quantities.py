"""A number, an array or a dictionary as people read it: six digits, and a unit of the size of the value."""

from __future__ import annotations

import math
from collections.abc import Mapping
from enum import Enum
from typing import Any

import numpy as np

from ..errors import shortened
from ..units import CELSIUS, DISPLAY_UNITS

PREFIXED = {
    "m": ("m", "mm", "um", "nm"),
    "m/s": ("m/s", "mm/s", "um/s"),
    "s": ("s", "ms", "us"),
    "Pa": ("GPa", "MPa", "kPa", "Pa"),
    "kg m": ("kg m", "g mm"),
    "rad": ("deg",),
}
"""Units that are shown in place of the SI unit: the largest that leaves a value of 1 or more."""

FACTORS = {"us": 1e-6, "nm": 1e-9, "mm/s": 1e-3, "um/s": 1e-6}
"""SI units in those that `units.DISPLAY_UNITS` does not have."""

FEW = 4
"""Entries of a vector, and rows or columns of a matrix, that are shown one by one."""

ROUND_OFF = 1e-12
"""Share of the largest entry of a matrix below which another is shown as 0."""

AXES = "xy"


WORDS = {"remarks": "left out"}
"""Names that say more than themselves: remarks are what the physics leaves out."""


def label_of(name: str) -> str:
    """Return the name of a field as words."""
    return WORDS.get(name, name.strip("_").replace("_", " "))


def quantity(value: Any, unit: str, name: str = "") -> str:
    """Return a number or a short vector with its unit; "degC" is that of temperatures in K, shown in both."""
    numbers = np.asarray(value)
    if unit == "degC":
        return f"{_number(numbers)} K = {_number(numbers - CELSIUS)} degC"
    if unit == "rad/s":
        turns = ("Hz", 0.5 / math.pi) if "frequency" in name else ("rpm", 30.0 / math.pi)
        return f"{_number(numbers)} rad/s = {_number(numbers * turns[1])} {turns[0]}"
    size = np.abs(numbers[np.isfinite(numbers)]).max(initial=0.0)
    shown, factor = _scale(unit, float(size))
    return f"{_number(numbers / factor if factor != 1.0 else numbers)} {shown}".rstrip()


def _scale(unit: str, size: float) -> tuple[str, float]:
    """Return the unit in which a size is shown, in terms of the given one."""
    named = PREFIXED.get(unit, ())
    scales = [(one, FACTORS.get(one) or DISPLAY_UNITS[one].factor) for one in named]
    fitting = [(one, factor) for one, factor in scales if size >= 0.999999 * factor]
    if fitting and size > 0.0:
        return fitting[0]
    if scales:
        return scales[0 if size == 0.0 and unit != "Pa" else -1]
    return _spelled(unit), 1.0


def _spelled(unit: str) -> str:
    """Return a unit as it is written behind a number."""
    return "" if unit == "1" else unit.replace(".", " ")


def _number(value: np.ndarray) -> str:
    if value.ndim:
        return f"({', '.join(_number(entry) for entry in value)})"
    if value.dtype.kind == "b":
        return "yes" if value else "no"
    if value.dtype.kind == "c":
        return f"{value.real:.6g}{value.imag:+.6g}i"
    if value.dtype.kind in "iu":
        return str(value)
    return f"{float(value):.6g}" if value.dtype.kind == "f" else shortened(str(value))


def is_number(value: object) -> bool:
    """Return whether a value is a number or an array of numbers, or of what is true and false."""
    return isinstance(value, (bool, int, float, complex, np.generic, np.ndarray))


def texts(name: str, value: Any, unit: str) -> list[str]:
    """Return the lines that show a value which is no result; none where it is empty."""
    if value is None:
        return ["none"]
    if isinstance(value, Enum):
        return [str(value.value)]
    if isinstance(value, str):
        return [value] if value else []
    if isinstance(value, Mapping):
        counts = ", ".join(f"{shortened(str(n))} {label_of(str(key))}" for key, n in value.items())
        return [counts] if value else []
    if isinstance(value, tuple | list):
        if all(isinstance(entry, int | float) for entry in value):
            value = np.array(value)
        else:
            return [line for entry in value for line in texts(name, entry, unit)]
    return _array(name, np.asarray(value), unit) if is_number(value) else [shortened(str(value))]


def _array(name: str, value: np.ndarray, unit: str) -> list[str]:
    if value.ndim == 0 or (value.ndim == 1 and 0 < value.size <= FEW):
        return [quantity(value, unit, name)]
    if value.dtype.kind not in "fiucb":
        return [shortened(str(value))] if value.size else []
    if value.shape == (2, 2) and value.dtype.kind != "b":
        value = without_round_off(value)
        rows = [[f"{a}{b} {value[i, j]:14.7g}" for j, b in enumerate(AXES)] for i, a in enumerate(AXES)]
        return [f"{'   '.join(row)} {_spelled(unit)}".rstrip() for row in rows]
    return [_summary(name, value, unit)] if value.size else []


def without_round_off(value: np.ndarray) -> np.ndarray:
    """Return the entries of a matrix to be shown, 0 where it is round-off beside the largest."""
    size = np.abs(value)
    return np.where(size < ROUND_OFF * size.max(initial=0.0), 0.0, value)


def _summary(name: str, value: np.ndarray, unit: str) -> str:
    """Return the shape of an array and its smallest and largest number."""
    shape = " x ".join(map(str, value.shape))
    if value.dtype.kind == "b":
        return f"{shape}, {np.count_nonzero(value)} yes"
    known = np.abs(value) if value.dtype.kind == "c" else value
    known = known[np.isfinite(known)]
    if not known.size:
        return f"{shape}, no finite number"
    ends = quantity(known.min(), unit, name), quantity(known.max(), unit, name)
    return f"{shape}, {'sizes ' if value.dtype.kind == 'c' else ''}from {ends[0]} to {ends[1]}"
