"""The calls of an FMU instance through fmpy, by value references: FMI 2.0 and 3.0 behind the same methods."""

from __future__ import annotations

from collections.abc import Sequence
from ctypes import c_double
from typing import Any, ClassVar, NamedTuple

import numpy as np
from fmpy.fmi1 import FMICallException
from fmpy.fmi2 import (
    calloc,
    fmi2CallbackAllocateMemoryTYPE,
    fmi2CallbackFreeMemoryTYPE,
    fmi2CallbackFunctions,
    fmi2CallbackLoggerTYPE,
    free,
)

from ...model import Array
from .ports import Calls, Port, Slopes

FMI_OK = 0


class EventInfo(NamedTuple):
    """What an FMU answers after an event.

    Attributes
    ----------
    terminate : bool
        Whether it wants the simulation to end.
    next_time : float or None [s]
        Time of the next event, if it has one.
    """

    terminate: bool
    next_time: float | None


class Instance:
    """An instantiated FMU, for Co-Simulation or for Model Exchange; `instantiated` makes one.

    Parameters
    ----------
    fmu : fmpy.fmi2._FMU2 or fmpy.fmi3._FMU3
    exchange : bool
        Whether it is for Model Exchange.
    """

    calls: ClassVar[Calls]

    def __init__(self, fmu: Any, exchange: bool) -> None:
        self._fmu, self._exchange = fmu, exchange
        self.log: list[str] = []
        """Messages so far, but those of success."""

    def instantiate(self) -> None:
        """Make the instance."""
        raise NotImplementedError

    def initialize(
        self,
        references: Sequence[int],
        values: Sequence[float],
        time: float = 0.0,
        tolerance: float | None = None,
    ) -> EventInfo:
        """Initialize at the time [s] with these start values; afterwards it is ready to step or integrate.

        The tolerance is that of its time integration, its own default unless given.
        """
        self._enter(time, tolerance)
        self.set(references, values)
        self._fmu.exitInitializationMode()
        return self._settle()

    def set(self, references: Sequence[int], values: Sequence[float]) -> None:
        """Set variables."""
        if len(references):
            self._call(self.calls.set, list(references), list(values))

    def get(self, references: Sequence[int]) -> list[float]:
        """Return variables."""
        return list(self._call(self.calls.get, list(references))) if len(references) else []

    def port(self, references: Sequence[int]) -> Port:
        """Return these variables to be set or got again and again; the instance must exist."""
        return Port(self._fmu, self.calls, references)

    def slopes(self, unknowns: Sequence[int], knowns: Sequence[int]) -> Slopes:
        """Return the derivatives of the unknowns by each known, to be asked for again and again."""
        return Slopes(self._fmu, self.calls, unknowns, knowns)

    def entry(self) -> tuple[int, int, dict[str, int | None]]:
        """Return the version, the component and the addresses of what a loop in C calls."""
        found = {name: self.calls.address(self._fmu, spelled) for name, spelled in self.calls.called.items()}
        return 3 if self.calls.counts_values else 2, self._fmu.component, found

    def fail(self, call: str, status: int) -> None:
        """Raise what fmpy raises where a function of `entry` answers this status."""
        raise FMICallException(function=self.calls.spelled(self.calls.called[call]), status=status)

    def deserialize(self, content: bytes) -> Any:
        """Return the FMU state that `serialize` turned into bytes."""
        return self._call(self.calls.deserialize, content)

    def step(self, t: float, dt: float) -> None:
        """Advance from t to t + dt [s] (Co-Simulation)."""
        self._fmu.doStep(t, dt)

    def move(self, t: float, states: Array) -> None:
        """Go to a time [s] and a state (Model Exchange)."""
        self._fmu.setTime(t)
        if len(states):
            self._fmu.setContinuousStates((c_double * len(states))(*states), len(states))

    def states(self, count: int) -> Array:
        """Return the state (Model Exchange)."""
        values = (c_double * count)()
        if count:
            self._fmu.getContinuousStates(values, count)
        return np.array(values)

    def derivatives(self, count: int) -> Array:
        """Return the derivatives of the state (Model Exchange)."""
        values = (c_double * count)()
        if count:
            self._call(self.calls.derivatives, values, count)
        return np.array(values)

    def event(self) -> EventInfo:
        """Pass through event mode (Model Exchange)."""
        self._fmu.enterEventMode()
        return self._settle()

    def directional(
        self, unknowns: Sequence[int], knowns: Sequence[int], seed: Sequence[float]
    ) -> list[float]:
        """Return the derivative of the unknowns along `seed`, in the space of the knowns."""
        found: list[float] = self._fmu.getDirectionalDerivative(unknowns, knowns, seed)
        return found

    def reset(self) -> None:
        """Return to what it was before the initialization."""
        self._fmu.reset()

    def save(self) -> Any:
        """Return the FMU state."""
        return self._fmu.getFMUState()

    def restore(self, state: Any) -> None:
        """Return to an FMU state."""
        self._fmu.setFMUState(state)

    def release(self, state: Any) -> None:
        """Free an FMU state."""
        self._fmu.freeFMUState(state)

    def serialize(self, state: Any) -> bytes:
        """Return an FMU state as bytes."""
        content: bytes = self._fmu.serializeFMUState(state)
        return content

    def close(self, terminate: bool = True) -> None:
        """Terminate if asked, free the instance and unload its library."""
        try:
            if terminate:
                self._fmu.terminate()
        finally:
            let_go(self._fmu)
            self._fmu.freeInstance()

    def _settle(self) -> EventInfo:
        """Leave event mode; in Co-Simulation there is none."""
        terminate, time = False, None
        again = self._exchange
        while again and not terminate:
            again, terminate, _, _, defined, next_time = self._call(self.calls.update)
            time = next_time if defined else None
        if self._exchange:
            self._fmu.enterContinuousTimeMode()
        return EventInfo(terminate, time)

    def _enter(self, time: float, tolerance: float | None) -> None:
        """Enter initialization mode."""
        raise NotImplementedError

    def _call(self, name: str, *arguments: Any) -> Any:
        return getattr(self._fmu, name)(*arguments)

    def _keep(self, status: int, message: bytes) -> None:
        if status != FMI_OK:
            self.log.append(" ".join(message.decode("utf-8", errors="replace").split()))


class Instance2(Instance):
    """An instance of an FMI 2.0 FMU; see `Instance`."""

    calls = Calls("setReal", "getReal", "getDerivatives", "newDiscreteStates", "deSerializeFMUstate", False)

    def __init__(self, fmu: Any, exchange: bool) -> None:
        super().__init__(fmu, exchange)
        self._callbacks = fmi2CallbackFunctions()
        self._callbacks.logger = fmi2CallbackLoggerTYPE(self._logger)
        self._callbacks.allocateMemory = fmi2CallbackAllocateMemoryTYPE(calloc)
        self._callbacks.freeMemory = fmi2CallbackFreeMemoryTYPE(free)

    def instantiate(self) -> None:
        """Make the instance; see `Instance`."""
        # With logging on, or PythonFMU would keep the reason of a failure to itself.
        self._fmu.instantiate(callbacks=self._callbacks, loggingOn=True)

    def _enter(self, time: float, tolerance: float | None) -> None:
        self._fmu.setupExperiment(tolerance=tolerance, startTime=time)
        self._fmu.enterInitializationMode()

    def _logger(self, environment: Any, name: bytes, status: int, category: bytes, message: bytes) -> None:
        self._keep(status, message)


class Instance3(Instance):
    """An instance of an FMI 3.0 FMU; see `Instance`."""

    calls = Calls(
        "setFloat64",
        "getFloat64",
        "getContinuousStateDerivatives",
        "updateDiscreteStates",
        "deserializeFMUState",
        True,
    )

    def instantiate(self) -> None:
        """Make the instance; see `Instance`."""
        self._fmu.instantiate(loggingOn=True, logMessage=self._logger)

    def adjoint(self, unknowns: Sequence[int], knowns: Sequence[int], seed: Sequence[float]) -> list[float]:
        """Return the derivative of the sum of the unknowns, weighted by `seed`, by each known."""
        found: list[float] = self._fmu.getAdjointDerivative(unknowns, knowns, seed, nSensitivity=len(knowns))
        return found

    def _enter(self, time: float, tolerance: float | None) -> None:
        self._fmu.enterInitializationMode(tolerance=tolerance, startTime=time)

    def _logger(self, environment: Any, status: int, category: bytes, message: bytes) -> None:
        self._keep(status, message)


def let_go(fmu: Any) -> None:
    """Have the library of PythonFMU, if it is that, let go of Python while there is time.

    The interpreter is ours and stays.
    """
    end = getattr(fmu.dll, "finalizePythonInterpreter", None)
    if end is not None:
        end()
