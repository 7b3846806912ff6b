"""Signals are data: one source for python-control labels, FMI variables, chart axes and documentation."""

from __future__ import annotations

import keyword
from dataclasses import dataclass

from .errors import InputError, require_positive
from .units import UNITS


@dataclass(frozen=True, kw_only=True)
class Signal:
    """One scalar quantity that enters or leaves a model.

    Parameters
    ----------
    name : str
        Underscore identifier, unique within its model (`force_x`).
    unit : str
        SI unit, a key of `rotorfilm.units.UNITS` (`"N"`, `"m/s"`, `"1"`).
    nominal : float
        Positive typical magnitude [unit]; scales difference steps, tolerances and FMI nominal values.
    description : str
        What the quantity is and its sign.

    Raises
    ------
    InputError
        If the name is no identifier, the unit is unknown or the nominal value is not positive.
    """

    name: str
    unit: str
    nominal: float
    description: str

    def __post_init__(self) -> None:
        if not self.name.isidentifier() or keyword.iskeyword(self.name):
            raise InputError(f"name must be an identifier without dots, got {self.name!r}")
        if self.unit not in UNITS:
            raise InputError(f"unit must be one of {sorted(UNITS)}, got {self.unit!r}")
        require_positive("nominal", self.nominal)


def names(signals: tuple[Signal, ...]) -> list[str]:
    """Return the names of `signals`, in order: the labels that python-control wants."""
    return [signal.name for signal in signals]


def to_fmi_name(component: str, name: str) -> str:
    """Return the structured FMI name `component.name`.

    Raises
    ------
    InputError
        If either part is not an identifier, which would make the mapping ambiguous.
    """
    for label, part in (("component", component), ("name", name)):
        if not part.isidentifier():
            raise InputError(f"{label} must be an identifier without dots, got {part!r}")
    return f"{component}.{name}"


def from_fmi_name(fmi_name: str) -> tuple[str, str]:
    """Return (component, name) of a structured FMI name: the inverse of `to_fmi_name`."""
    component, dot, name = fmi_name.partition(".")
    if not (dot and component.isidentifier() and name.isidentifier()):
        raise InputError(f"fmi_name must have the form component.name, got {fmi_name!r}")
    return component, name
