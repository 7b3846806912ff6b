"""Variables of an FMU instance that are exchanged again and again, without new lists for each call."""

from __future__ import annotations

from collections.abc import Sequence
from ctypes import c_double, c_uint
from typing import Any, NamedTuple

import numpy as np

from ...model import Array


class Calls(NamedTuple):
    """How an FMI version spells what both have."""

    set: str
    get: str
    derivatives: str
    update: str
    deserialize: str
    counts_values: bool

    def function(self, fmu: Any, name: str) -> Any:
        """Return what calls a function of the FMU as it is and raises where it fails."""
        prefix = "fmi3" if self.counts_values else "fmi2"
        return getattr(fmu, f"{prefix}{name[0].upper()}{name[1:]}")


class Port:
    """Some variables of an instance, whose references are told once; `Instance.port` makes one."""

    def __init__(self, fmu: Any, calls: Calls, references: Sequence[int]) -> None:
        count = len(references)
        self._values = (c_double * count)()
        tail = (count,) if calls.counts_values else ()
        self._arguments = (fmu.component, (c_uint * count)(*references), count, self._values, *tail)
        self._set, self._get = calls.function(fmu, calls.set), calls.function(fmu, calls.get)

    def set(self, values: Sequence[float]) -> None:
        """Set the variables."""
        self._values[:] = values
        if values:
            self._set(*self._arguments)

    def get(self) -> list[float]:
        """Return the variables."""
        if self._values:
            self._get(*self._arguments)
        return self._values[:]


class Slopes:
    """Derivatives of some variables by others, whose references are told once; `Instance.slopes` makes one."""

    def __init__(self, fmu: Any, calls: Calls, unknowns: Sequence[int], knowns: Sequence[int]) -> None:
        count, seed = len(unknowns), (c_double * 1)(1.0)
        self._columns = np.zeros((len(knowns), count))
        self._get = calls.function(fmu, "getDirectionalDerivative")
        rows, many = (c_uint * count)(*unknowns), calls.counts_values
        self._arguments = [
            (fmu.component, rows, count, (c_uint * 1)(known), 1, seed)
            + ((1,) if many else ())
            + ((c_double * count).from_buffer(column), *((count,) if many else ()))
            for known, column in zip(knowns, self._columns, strict=True)
        ]

    def get(self) -> Array:
        """Return d(unknowns)/d(knowns) at present, shape (n_unknowns, n_knowns)."""
        for arguments in self._arguments:
            self._get(*arguments)
        return self._columns.T.copy()
