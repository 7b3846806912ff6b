"""Variables of an FMU instance that are exchanged again and again, without new lists for each call."""

from __future__ import annotations

from collections.abc import Sequence
from ctypes import c_double, c_uint, c_void_p, cast
from typing import Any, NamedTuple

import numpy as np
from fmpy.fmi1 import FMICallException

from ...model import Array

FMI_WARNING = 1
"""The worst status of a call that did what it was asked for."""

SLOPE = "getDirectionalDerivative"


class Calls(NamedTuple):
    """How an FMI version spells what both have."""

    set: str
    get: str
    derivatives: str
    update: str
    deserialize: str
    counts_values: bool

    def function(self, fmu: Any, name: str) -> Any:
        """Return a function of the FMU's library, which answers a status."""
        return getattr(fmu.dll, self.spelled(name))

    @property
    def called(self) -> dict[str, str]:
        """What a loop in C calls."""
        return {
            "put": self.set,
            "take": self.get,
            "stride": "doStep",
            "slope": SLOPE,
            "set_time": "setTime",
            "set_states": "setContinuousStates",
            "rate": self.derivatives,
        }

    def address(self, fmu: Any, name: str) -> int | None:
        """Return where a function of the FMU's library is; None if it has none."""
        found = getattr(fmu.dll, self.spelled(name), None)
        return None if found is None else cast(found, c_void_p).value

    def spelled(self, name: str) -> str:
        """Return the name of a function in the library of an FMU."""
        return f"{'fmi3' if self.counts_values else 'fmi2'}{name[0].upper()}{name[1:]}"


class Port:
    """Some variables of an instance, whose references are told once; `Instance.port` makes one."""

    def __init__(self, fmu: Any, calls: Calls, references: Sequence[int]) -> None:
        count = len(references)
        self._values = (c_double * count)()
        tail = (count,) if calls.counts_values else ()
        self._arguments = (fmu.component, (c_uint * count)(*references), count, self._values, *tail)
        self._set, self._get = calls.function(fmu, calls.set), calls.function(fmu, calls.get)
        self._calls = calls

    def set(self, values: list[float]) -> None:
        """Set the variables."""
        self._values[:] = [*values]
        if values and (status := self._set(*self._arguments)) > FMI_WARNING:
            raise FMICallException(function=self._calls.spelled(self._calls.set), status=status)

    def get(self) -> list[float]:
        """Return the variables."""
        if self._values and (status := self._get(*self._arguments)) > FMI_WARNING:
            raise FMICallException(function=self._calls.spelled(self._calls.get), status=status)
        return self._values[:]


class Slopes:
    """Derivatives of variables by others, whose references are told once; `Instance.slopes` makes one."""

    def __init__(self, fmu: Any, calls: Calls, unknowns: Sequence[int], knowns: Sequence[int]) -> None:
        count, seed = len(unknowns), (c_double * 1)(1.0)
        self._columns = np.zeros((len(knowns), count))
        self._calls, self._get = calls, calls.function(fmu, SLOPE)
        rows, many = (c_uint * count)(*unknowns), calls.counts_values
        self._arguments = [
            (fmu.component, rows, count, (c_uint * 1)(known), 1, seed)
            + ((1,) if many else ())
            + ((c_double * count).from_address(column.ctypes.data), *((count,) if many else ()))
            for known, column in zip(knowns, self._columns, strict=True)
        ]

    def get(self) -> Array:
        """Return d(unknowns)/d(knowns) at present, shape (n_unknowns, n_knowns)."""
        for arguments in self._arguments:
            if (status := self._get(*arguments)) > FMI_WARNING:
                raise FMICallException(function=self._calls.spelled(SLOPE), status=status)
        return self._columns.T.copy()
