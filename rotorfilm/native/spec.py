"""What a model with a kernel in the C library says of itself: the kernel's name, its numbers and tables."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from typing import Protocol, runtime_checkable

import numpy as np

from ..errors import InputError
from ..model import Array
from ..signals import Signal


@dataclass(frozen=True, kw_only=True)
class NativeParameter(Signal):
    """A number of a kernel that a simulator may set.

    Parameters
    ----------
    name, unit, description : str
        As of a `Signal`; the name is unique within the kernel.
    nominal, minimum, maximum : float
        As of a `Signal`.
    value : float
        Its value in the model, the start value.
    tunable : bool
        Whether it may be set between steps; otherwise only before and during initialization.

    Raises
    ------
    InputError
        If the value is not finite or outside its bounds, or a field breaks its rule.
    """

    value: float
    tunable: bool
    nominal: float = 1.0
    description: str = ""

    def __post_init__(self) -> None:
        super().__post_init__()
        if not (math.isfinite(self.value) and self.minimum <= self.value <= self.maximum):
            raise InputError(
                f"value of {self.name} must be within {self.minimum!r} and {self.maximum!r}, "
                f"got {self.value!r}"
            )


def parameter(
    name: str, unit: str, value: float, description: str, *, tunable: bool = True, minimum: float = 0.0
) -> NativeParameter:
    """Return a parameter whose own value is the typical one."""
    return NativeParameter(
        name=name,
        unit=unit,
        value=value,
        tunable=tunable,
        minimum=minimum,
        nominal=abs(value) or 1.0,
        description=description,
    )


@dataclass(frozen=True, kw_only=True, eq=False)
class NativeSpec:
    """A kernel of the C library with its numbers.

    Parameters
    ----------
    kernel : str
        Name in `native/kernels/kernel_list.h`.
    parameters : tuple of NativeParameter
        In the order of the kernel.
    tables : mapping of str to ndarray
        Finite numbers of at most four axes, by the name that the kernel asks for.
    inputs : tuple of str or None
        Inputs of the model that the kernel takes, in its order; the others have no effect. None for all.
    spring : str
        Parameter that is a stiffness [N/m] beside the model, along either axis; empty where there is none.
    parts : tuple of str
        Kernels that it calls, as a system those of its bearings.

    Raises
    ------
    InputError
        If two parameters have one name, or a table is not finite or has more than four axes.
    """

    kernel: str
    parameters: tuple[NativeParameter, ...] = ()
    tables: Mapping[str, Array] = field(default_factory=dict)
    inputs: tuple[str, ...] | None = None
    spring: str = ""
    parts: tuple[str, ...] = ()

    def __post_init__(self) -> None:
        names = [parameter.name for parameter in self.parameters]
        if len(set(names)) < len(names):
            raise InputError(f"parameters must have different names, got {names}")
        for name, table in self.tables.items():
            if np.ndim(table) > 4 or not np.isfinite(table).all():
                raise InputError(f"table {name} must be finite with at most four axes, got {np.shape(table)}")

    def stiffened(self, stiffness: float) -> NativeSpec | None:
        """Return this kernel with more stiffness [N/m] beside the model; None if it takes none."""
        if not self.spring:
            return None
        parameters = tuple(
            replace(p, value=p.value + stiffness, nominal=stiffness) if p.name == self.spring else p
            for p in self.parameters
        )
        return replace(self, parameters=parameters)


@runtime_checkable
class HasKernel(Protocol):
    """A Model that the C library runs without Python."""

    def native(self) -> NativeSpec | None:
        """Return its kernel; None if this instance has none, as a bearing under a film without kernel."""
