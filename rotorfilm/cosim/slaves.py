"""What a master asks of its partners, and a model in this process as such a partner."""

from __future__ import annotations

import ctypes
from collections.abc import Mapping, Sequence
from ctypes import byref
from enum import IntEnum
from typing import Any, Protocol, runtime_checkable

import numpy as np

from ..core.errors import InputError
from ..core.model import Array, Dynamic, Linearization, Model, breakpoints, in_time
from ..core.signals import names, units
from ..fmu.reference import advance
from ..native.library import master
from ..native.spec import HasKernel, NativeSpec
from ..native.structs import constant, structure
from ..rotors.force_law import ForceLaw
from .partner_interface import Wiring
from .schemes import LawIntegrator


class Call(IntEnum):
    """rf_call of partner.h."""

    PUT = 0
    TAKE = 1
    STRIDE = 2
    SLOPE = 3
    MOVE = 4
    RATE = 5


class Slave(Protocol):
    """A partner in a co-simulation: it holds its inputs and steps on its own.

    Signals go by their local names, without the component, in SI units.
    """

    @property
    def inputs(self) -> tuple[str, ...]:
        """Names of the inputs."""

    @property
    def outputs(self) -> tuple[str, ...]:
        """Names of the outputs."""

    def start(self, values: Mapping[str, float]) -> None:
        """Initialize at t = 0 with these inputs; inputs not named keep their start values."""

    def set(self, values: Mapping[str, float]) -> None:
        """Set inputs."""

    def step(self, t: float, dt: float) -> None:
        """Advance from t to t + dt [s] under the inputs set."""

    def get(self) -> dict[str, float]:
        """Return the outputs at the present time."""


@runtime_checkable
class Differentiable(Protocol):
    """What a film may add: its exact derivatives."""

    @property
    def differentiates(self) -> bool:
        """Whether it knows them."""

    def jacobian(self, outputs: Sequence[str], inputs: Sequence[str]) -> Array:
        """Return d(outputs)/d(inputs) at present, shape (n_outputs, n_inputs)."""


@runtime_checkable
class Measured(Protocol):
    """What a partner may add: the units of its outputs."""

    @property
    def units(self) -> dict[str, str]:
        """SI units by the names of the outputs, where they are known."""


@runtime_checkable
class Restorable(Protocol):
    """What a partner may add: a way back."""

    @property
    def restores(self) -> bool:
        """Whether it has one."""

    def save(self) -> Any:
        """Return the state at present."""

    def restore(self, state: Any) -> None:
        """Return to a state."""

    def release(self, state: Any) -> None:
        """Forget a state."""


@runtime_checkable
class Driven(Protocol):
    """What a rotor may add: steps under a force law in place of a held force."""

    def takes_laws(self, wiring: Wiring) -> bool:
        """Whether it takes any force law; otherwise held forces only."""

    def drive(self, t: float, dt: float, law: ForceLaw, wiring: Wiring) -> None:
        """Advance from t to t + dt [s] under a force law."""

    def linear(self, t: float) -> Linearization | None:
        """Return the exact derivatives of the rotor at present, if it knows them."""


@runtime_checkable
class Compiled(Protocol):
    """What a partner may add: the loop over macro steps in C calls it itself."""

    def compiled(self, film: bool) -> CompiledPartner | None:
        """Return how C calls it, as a film or as the rotor; None if it does not."""

    def fail(self, call: Call, status: int, t: float) -> None:
        """Raise what a call from C that failed in the step from t [s] means."""


@runtime_checkable
class Integrated(Compiled, Protocol):
    """A rotor that the master integrates."""

    @property
    def state(self) -> Array:
        """The state at present."""

    @property
    def nominals(self) -> Array:
        """Typical magnitudes of the states."""

    @property
    def base(self) -> Array:
        """The inputs beside the forces of films, shape (n_inputs,)."""

    def next_kink(self, t: float) -> float:
        """Return the next time after t [s] at which the rates have a kink."""

    def resume(self, t: float, x: Array) -> None:
        """Go to a time [s] and a state that were reached in C."""


class SlaveSystem:
    """A Dynamic model as the system that the exponential integrates; see `exponential.System`."""

    def __init__(self, model: Dynamic) -> None:
        self._model = model
        self.inputs, self.outputs = tuple(names(model.inputs)), tuple(names(model.outputs))
        self.nominals = np.array([signal.nominal for signal in model.states])
        self.rates, self.outcome, self.matrices = model.derivative, model.output, model.linearization
        self._kinks = np.array(sorted(breakpoints(model)))

    def next_kink(self, t: float) -> float:
        """Return the first kink after t [s]."""
        later = self._kinks[self._kinks > t]
        return float(later[0]) if later.size else np.inf

    def pass_kink(self, t: float, x: Array) -> None:
        """Do nothing: the model knows by the time."""


class InProcessSlave:
    """A model in this process, stepped as its own FMU would step it.

    Parameters
    ----------
    model : Model
        With or without states.
    """

    restores = True

    def __init__(self, model: Model) -> None:
        model = in_time(model)
        self._model = model
        self.differentiates = hasattr(model, "linearization")
        self._inputs, self._outputs = tuple(names(model.inputs)), tuple(names(model.outputs))
        self.units = units(model.outputs)
        self._u = np.zeros(len(model.inputs))
        # Asked once: checks against protocols are slow.
        self._moving = model if isinstance(model, Dynamic) else None
        self._x: Array = np.zeros(0) if self._moving is None else self._moving.initial_state
        self._t = 0.0
        self._integrator: LawIntegrator | None = None
        self._system: SlaveSystem | None = None

    @property
    def inputs(self) -> tuple[str, ...]:
        """Names of the inputs."""
        return self._inputs

    @property
    def outputs(self) -> tuple[str, ...]:
        """Names of the outputs."""
        return self._outputs

    def start(self, values: Mapping[str, float]) -> None:
        """Set the inputs at t = 0."""
        self.set(values)

    def set(self, values: Mapping[str, float]) -> None:
        """Set inputs by name; raise InputError for a name that is none."""
        for name, value in values.items():
            if name not in self._inputs:
                raise InputError(f"input must be one of {list(self._inputs)}, got {name!r}")
            self._u[self._inputs.index(name)] = value

    def step(self, t: float, dt: float) -> None:
        """Advance the states from t to t + dt [s] under the inputs held."""
        if self._moving is not None:
            self._x = advance(self._moving, t, self._x, self._u.copy(), dt)
        self._t = t + dt

    def get(self) -> dict[str, float]:
        """Return the outputs at the present time, state and inputs."""
        return dict(zip(self._outputs, self._model.output(self._t, self._x, self._u).tolist(), strict=True))

    def jacobian(self, outputs: Sequence[str], inputs: Sequence[str]) -> Array:
        """Return d(outputs)/d(inputs) at present, shape (n_outputs, n_inputs)."""
        rows, columns = ([self._outputs.index(n) for n in outputs], [self._inputs.index(n) for n in inputs])
        found: Array = self._model.linearization(self._t, self._x, self._u).D[np.ix_(rows, columns)]
        return found

    def save(self) -> tuple[float, Array, Array]:
        """Return time, states and inputs."""
        return self._t, self._x.copy(), self._u.copy()

    def restore(self, state: tuple[float, Array, Array]) -> None:
        """Return to time, states and inputs."""
        self._t, self._x, self._u = state[0], state[1].copy(), state[2].copy()

    def release(self, state: tuple[float, Array, Array]) -> None:
        """Do nothing."""

    def takes_laws(self, wiring: Wiring) -> bool:
        """Whether it is a rotor, that is, has states."""
        return self._moving is not None

    def drive(self, t: float, dt: float, law: ForceLaw, wiring: Wiring) -> None:
        """Advance the states from t to t + dt [s] under a force law."""
        if self._integrator is None:
            self._integrator = LawIntegrator(SlaveSystem(self._dynamic()), wiring, self._u.copy())
        self._x, self._t = self._integrator.advance(t, self._x, dt, law), t + dt

    def linear(self, t: float) -> Linearization | None:
        """Return the exact derivatives at present."""
        return self._dynamic().linearization(t, self._x, self._u)

    def compiled(self, film: bool) -> CompiledPartner | None:
        """Return the kernel of the model, for a film without states or a rotor with some."""
        if type(self) is not InProcessSlave or film is (self._moving is not None):
            return None
        return kernel_partner(self._model)

    def fail(self, call: Call, status: int, t: float) -> None:
        """Raise what the model raises where its kernel failed."""
        self.get()
        self.jacobian(self._outputs, self._inputs)

    @property
    def state(self) -> Array:
        """The states at present."""
        return self._x

    @property
    def nominals(self) -> Array:
        """Nominal values of the states."""
        return np.array([signal.nominal for signal in self._model.states])

    @property
    def base(self) -> Array:
        """The inputs beside the forces of films."""
        return self._u

    def next_kink(self, t: float) -> float:
        """Return the next kink after t [s]."""
        if self._system is None:
            self._system = SlaveSystem(self._dynamic())
        return self._system.next_kink(t)

    def resume(self, t: float, x: Array) -> None:
        """Go to a time [s] and a state."""
        self._t, self._x = t, x.copy()

    def _dynamic(self) -> Dynamic:
        if self._moving is None:
            raise InputError(f"rotor must have states, got {self._model!r}")
        return self._moving


# Partners as the compiled loop calls them: the functions of an FMU's library, or a kernel of ours.


class CompiledPartner(Protocol):
    """A partner with its references by the names of its signals.

    Attributes
    ----------
    struct : Any
    inputs, outputs : mapping of str to int
        References to set inputs and to get outputs by.
    knowns : mapping of str to int
        References of the inputs in derivatives.
    rates, states : list of int
        References of the derivatives of the states, and of the states, in derivatives.
    """

    struct: Any
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
        Addresses by their names in `structure("rf_partner")`.
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
        self.struct = structure("rf_partner")(
            kind=constant(f"RF_IS_FMI{version}"), component=component, states=len(states), **functions
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
        self._tables = (structure("rf_table") * len(rows))(*rows)
        why = structure("rf_message")()
        parameters = np.array([parameter.value for parameter in spec.parameters])
        tables = structure("rf_tables")(list=ctypes.addressof(self._tables), count=len(self._numbers))
        own = master()["rf_open_kernel"](
            spec.kernel.encode(), byref(tables), parameters.ctypes.data, byref(why)
        )
        if not own:
            raise InputError(why.text.decode(errors="replace"))
        self.own = structure("rf_own").from_address(own)
        sizes = self.own.sizes
        inputs, outputs, states = sizes.inputs, sizes.outputs, sizes.states
        self.struct = structure("rf_partner")(kind=constant("RF_IS_KERNEL"), component=own, states=states)
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
        _numbers(self.own.x, len(x))[:] = x.tolist()

    def inputs_now(self) -> dict[str, float]:
        """Return the inputs at present."""
        return dict(zip(self.inputs, _numbers(self.own.u, len(self.inputs)), strict=True))

    def beyond(self) -> dict[str, float] | None:
        """Return the first inputs since the last call at which the model was beyond its verified range."""
        if not self.own.outside:
            return None
        self.own.outside = 0
        return dict(zip(self.inputs, _numbers(self.own.beyond, len(self.inputs)), strict=True))


def kernel_partner(model: Model) -> KernelPartner | None:
    """Return a model by its kernel; None if it has none, or one that steps by itself."""
    spec = model.native() if isinstance(model, HasKernel) and isinstance(model, Model) else None
    if spec is None:
        return None
    found = KernelPartner(model, spec)
    return found if found.fits else None


def _numbers(address: int | None, count: int) -> Any:
    """Return so many numbers at an address."""
    return (ctypes.c_double * count).from_address(address or 0)


def _table(name: str, numbers: Array) -> Any:
    extent = (*numbers.shape, 0, 0, 0, 0)[:4]
    return structure("rf_table")(
        name=name.encode(), axes=numbers.ndim, extent=extent, numbers=numbers.ctypes.data
    )
