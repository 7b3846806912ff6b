"""An FMU taken out of its archive, and an instance of it."""

from __future__ import annotations

import shutil
import tempfile
from collections.abc import Iterator, Sequence
from contextlib import chdir, contextmanager
from ctypes import c_double, c_uint, c_void_p, cast
from os import PathLike
from pathlib import Path
from typing import Any, ClassVar, NamedTuple
from xml.etree.ElementTree import parse

import fmpy
import numpy as np
from fmpy.fmi1 import FMICallException
from fmpy.fmi2 import (
    FMU2Model,
    FMU2Slave,
    calloc,
    fmi2CallbackAllocateMemoryTYPE,
    fmi2CallbackFreeMemoryTYPE,
    fmi2CallbackFunctions,
    fmi2CallbackLoggerTYPE,
    free,
)
from fmpy.fmi3 import FMU3Model, FMU3Slave

from ..core.errors import FmuError, FmuFileError
from ..core.model import Array
from .archive import read_description
from .binaries import host_libraries, require_whole


@contextmanager
def extracted(path: str | PathLike[str]) -> Iterator[tuple[Any, str]]:
    """Yield fmpy's description of an FMU and the folder with its files, which goes at the end.

    Raises
    ------
    FmuFileError
        If the file cannot be read, or is of another FMI version.
    """
    description = read_description(str(path))
    folder = tempfile.mkdtemp(prefix="rotorfilm-")
    try:
        try:
            fmpy.extract(str(path), unzipdir=folder)
        except Exception as error:
            raise FmuFileError(f"fmu must be a readable FMU, got {str(path)!r}: {error}") from error
        yield description, folder
    finally:
        shutil.rmtree(folder, ignore_errors=True)


def instantiated(description: Any, folder: str, exchange: bool) -> Instance:
    """Return an instance of an extracted FMU, for Model Exchange if `exchange`, else for Co-Simulation.

    Raises
    ------
    FmuError
        If it lacks this interface, its library is not whole, or it does not instantiate.
    """
    interface = description.modelExchange if exchange else description.coSimulation
    wanted = "Model Exchange" if exchange else "Co-Simulation"
    if interface is None:
        raise FmuError(f"fmu must have the interface {wanted}, got {description.modelName!r} without")
    kind, wrap = {
        (True, True): (FMU2Model, Instance2),
        (True, False): (FMU2Slave, Instance2),
        (False, True): (FMU3Model, Instance3),
        (False, False): (FMU3Slave, Instance3),
    }[description.fmiVersion == "2.0", exchange]
    for library in host_libraries(folder, interface.modelIdentifier):
        require_whole(library)
    try:
        # fmpy stays in the library's folder where it cannot load the library.
        with chdir("."):
            fmu = kind(
                guid=description.guid,
                unzipDirectory=folder,
                modelIdentifier=interface.modelIdentifier,
                instanceName=description.modelName,
            )
    except Exception as error:
        raise FmuError(f"FMU {description.modelName!r} cannot be instantiated: {error}") from error
    instance = wrap(fmu, exchange)
    try:
        instance.instantiate()
    except Exception as error:
        let_go(fmu)
        fmu.freeLibrary()
        raise FmuError(
            " ".join([f"FMU {description.modelName!r} cannot be instantiated: {error}", *instance.log])
        ) from error
    return instance


# Variables of an FMU instance that are exchanged again and again, without new lists for each call.


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


# The calls of an FMU instance through fmpy, by value references: FMI 2.0 and 3.0 behind the same methods.


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


# What an FMU says of itself, by fmpy and by its modelDescription.xml.


def describe_fmu(path: str | PathLike[str]) -> dict[str, Any]:
    """Return what an FMU says of itself: version, interfaces, platforms, capabilities, variables.

    Raises
    ------
    FmuError
        If the file cannot be read.
    """
    with extracted(path) as (description, folder):
        binaries = Path(folder, "binaries")
        found = interfaces(folder)
        return {
            "fmi_version": description.fmiVersion,
            "model_name": description.modelName,
            "token": description.guid,
            "description": description.description,
            "generation_tool": description.generationTool,
            "interfaces": sorted(found),
            "capabilities": sorted(common_capabilities(folder)),
            "platforms": sorted(p.name for p in binaries.iterdir()) if binaries.is_dir() else [],
            "variables": [_row(variable) for variable in description.modelVariables],
        }


def interfaces(folder: str) -> dict[str, dict[str, str]]:
    """Return the attributes of each interface; fmpy 0.3 does not read all of them."""
    root = parse(Path(folder, "modelDescription.xml")).getroot()
    names = ("ModelExchange", "CoSimulation", "ScheduledExecution")
    found = {name: root.find(name) for name in names}
    return {name: dict(element.attrib) for name, element in found.items() if element is not None}


def common_capabilities(folder: str) -> set[str]:
    """Return the attributes that are true for every interface."""
    yes = [
        {name for name, value in attributes.items() if value in ("true", "1")}
        for attributes in interfaces(folder).values()
    ]
    return set.intersection(*yes) if yes else set()


DERIVATIVES = {"providesDirectionalDerivative", "providesDirectionalDerivatives"}
STATES = {"canGetAndSetFMUstate", "canGetAndSetFMUState"}
SERIAL_STATES = {"canSerializeFMUstate", "canSerializeFMUState"}
ADJOINT_DERIVATIVES = {"providesAdjointDerivatives"}
"""Capabilities, as FMI 2.0 and 3.0 spell them."""


def provides(folder: str, *capabilities: set[str]) -> bool:
    """Return whether every interface has all of these capabilities, spelled one way or the other."""
    common = common_capabilities(folder)
    return all(common & spellings for spellings in capabilities)


def _row(variable: Any) -> dict[str, Any]:
    keys = ("name", "causality", "variability", "unit", "start", "description")
    return {key: getattr(variable, key) for key in keys}


def variables_of(description: Any, causality: str) -> list[Any]:
    """Return the real variables of a causality; of "local" the continuous states in Model Exchange."""
    if causality == "local":
        slopes = [unknown.variable for unknown in description.derivatives]
        return [slope.derivative for slope in slopes] if description.modelExchange is not None else []
    return [v for v in reals_of(description) if v.causality == causality]


def reals_of(description: Any) -> list[Any]:
    """Return the real variables."""
    return [v for v in description.modelVariables if v.type in ("Real", "Float64")]


def references_of(description: Any, causality: str) -> list[int]:
    """Return their value references; see `variables_of`."""
    return [variable.valueReference for variable in variables_of(description, causality)]


def starts_of(description: Any, causality: str) -> Array:
    """Return their start values; see `variables_of`."""
    return np.array([float(variable.start or 0.0) for variable in variables_of(description, causality)])


def nominal_of(variable: Any) -> float:
    """Return the nominal value of a variable, 1 where it has none."""
    return abs(float(variable.nominal or 1.0)) or 1.0


def knowns_of(description: Any) -> list[int]:
    """Return the value references by which derivatives are taken: inputs and states."""
    return [*references_of(description, "input"), *references_of(description, "local")]


def known_nominals(description: Any) -> Array:
    """Return the nominal values of `knowns_of`."""
    known = [*variables_of(description, "input"), *variables_of(description, "local")]
    return np.array([nominal_of(variable) for variable in known])


def unknowns_of(description: Any) -> list[int]:
    """Return the value references of which derivatives are taken: outputs and derivatives of states."""
    slopes = description.derivatives if description.modelExchange is not None else []
    return [*references_of(description, "output"), *(u.variable.valueReference for u in slopes)]
