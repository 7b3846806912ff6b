"""Partners as the compiled loop calls them: the functions of an FMU's library, or a kernel of ours."""

from __future__ import annotations

import ctypes
from collections.abc import Mapping
from ctypes import byref
from typing import Protocol

import numpy as np

from ...errors import InputError
from ...model import Array, Model
from ...native.layouts.master_structs import (
    FMI2,
    FMI3,
    KERNEL,
    MessageStruct,
    OwnStruct,
    PartnerStruct,
    TablesStruct,
    TableStruct,
)
from ...native.library import master
from ...native.spec import HasKernel, NativeSpec


class CompiledPartner(Protocol):
    """A partner with its references by the names of its signals.

    Attributes
    ----------
    struct : PartnerStruct
    inputs, outputs : mapping of str to int
        References to set inputs and to get outputs by.
    knowns : mapping of str to int
        References of the inputs in derivatives.
    rates, states : list of int
        References of the derivatives of the states, and of the states, in derivatives.
    """

    struct: PartnerStruct
    inputs: dict[str, int]
    outputs: dict[str, int]
    knowns: dict[str, int]
    rates: list[int]
    states: list[int]

    def sync(self, t: float, x: Array) -> None:
        """Take a time and a state, before the loop goes on."""


class FmuPartner:
    """An FMU, by the functions of its library; see `CompiledPartner`.

    Parameters
    ----------
    version : int
        2 or 3.
    component : int
        The instance.
    functions : mapping of str to int or None
        Addresses by their names in `PartnerStruct`.
    inputs, outputs : mapping of str to int
    rates, states : list of int
    """

    def __init__(
        self,
        version: int,
        component: int,
        functions: Mapping[str, int | None],
        inputs: dict[str, int],
        outputs: dict[str, int],
        rates: list[int],
        states: list[int],
    ) -> None:
        self.struct = PartnerStruct(
            kind={2: FMI2, 3: FMI3}[version], component=component, states=len(states), **functions
        )
        self.inputs, self.outputs, self.knowns = inputs, outputs, inputs
        self.rates, self.states = rates, states

    def sync(self, t: float, x: Array) -> None:
        """Do nothing: the FMU holds its state, or is told it in each step."""


class KernelPartner:
    """A model by its kernel in the library of the master; see `CompiledPartner`.

    Parameters
    ----------
    model : Model
    spec : NativeSpec

    Raises
    ------
    InputError
        If tables or parameters do not fit the kernel.
    """

    def __init__(self, model: Model, spec: NativeSpec) -> None:
        self._numbers = {
            name: np.ascontiguousarray(table, dtype=float) for name, table in spec.tables.items()
        }
        rows = [_table(name, numbers) for name, numbers in self._numbers.items()]
        self._tables = (TableStruct * len(rows))(*rows)
        why = MessageStruct()
        parameters = np.array([parameter.value for parameter in spec.parameters])
        tables = TablesStruct(list=ctypes.addressof(self._tables), count=len(self._numbers))
        own = master()["rf_open_kernel"](
            spec.kernel.encode(), byref(tables), parameters.ctypes.data, byref(why)
        )
        if not own:
            raise InputError(why.text.decode(errors="replace"))
        self.own = OwnStruct.from_address(own)
        _, inputs, outputs, states, _ = self.own.sizes
        self.struct = PartnerStruct(kind=KERNEL, component=own, states=states)
        names = [signal.name for signal in model.inputs] if spec.inputs is None else list(spec.inputs)
        self.fits = len(names) == inputs and len(model.outputs) == outputs and len(model.states) == states
        self.inputs = {name: k for k, name in enumerate(names)}
        self.outputs = {signal.name: k for k, signal in enumerate(model.outputs)}
        self.knowns = {name: states + k for name, k in self.inputs.items()}
        self.rates, self.states = [outputs + k for k in range(states)], list(range(states))

    def __del__(self) -> None:
        if hasattr(self, "own"):
            master()["rf_close_kernel"](ctypes.addressof(self.own))

    def sync(self, t: float, x: Array) -> None:
        """Take a time and a state."""
        self.own.t = t
        for k, value in enumerate(x.tolist()):
            self.own.x[k] = value

    def inputs_now(self) -> dict[str, float]:
        """Return the inputs at present."""
        return {name: self.own.u[k] for name, k in self.inputs.items()}

    def beyond(self) -> dict[str, float] | None:
        """Return the first inputs since the last call at which the model was beyond its verified range."""
        found = {name: self.own.beyond[k] for name, k in self.inputs.items()} if self.own.outside else None
        self.own.outside = 0
        return found


def kernel_partner(model: Model) -> KernelPartner | None:
    """Return a model by its kernel; None if it has none, or one that steps by itself."""
    spec = model.native() if isinstance(model, HasKernel) and isinstance(model, Model) else None
    if spec is None:
        return None
    found = KernelPartner(model, spec)
    return found if found.fits else None


def _table(name: str, numbers: Array) -> TableStruct:
    extent = (*numbers.shape, 0, 0, 0, 0)[:4]
    return TableStruct(name=name.encode(), axes=numbers.ndim, extent=extent, numbers=numbers.ctypes.data)
