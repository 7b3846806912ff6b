"""An FMU taken out of its archive, and an instance of it."""

from __future__ import annotations

import shutil
import tempfile
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import chdir, contextmanager
from ctypes import c_double, c_int, c_uint, c_void_p, cast
from os import PathLike
from pathlib import Path
from typing import Any, NoReturn
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
from .native.platforms import host_libraries, require_complete_file


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
    version = "2.0" if description.fmiVersion == "2.0" else "3.0"
    kind = {"2.0": (FMU2Slave, FMU2Model), "3.0": (FMU3Slave, FMU3Model)}[version][exchange]
    for library in host_libraries(folder, interface.modelIdentifier):
        require_complete_file(library)
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
    instance = Instance(fmu, version, exchange, {v.valueReference: size_of(v) for v in reals_of(description)})
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

SPELLED = {
    "2.0": {
        "put": "setReal",
        "take": "getReal",
        "rate": "getDerivatives",
        "update": "newDiscreteStates",
        "deserialize": "deSerializeFMUstate",
        "save": "getFMUstate",
        "restore": "setFMUstate",
        "forget": "freeFMUstate",
        "output_slope": "getRealOutputDerivatives",
    },
    "3.0": {
        "put": "setFloat64",
        "take": "getFloat64",
        "rate": "getContinuousStateDerivatives",
        "update": "updateDiscreteStates",
        "deserialize": "deserializeFMUState",
        "save": "getFMUState",
        "restore": "setFMUState",
        "forget": "freeFMUState",
        "output_slope": "getOutputDerivatives",
    },
}
"""How each FMI version spells what both have."""

CALLED = {
    "stride": "doStep",
    "slope": "getDirectionalDerivative",
    "set_time": "setTime",
    "set_states": "setContinuousStates",
}
"""What both spell alike, of that what a loop in C calls."""


class Port:
    """Some variables of an instance, whose references are told once; `Instance.port` makes one."""

    def __init__(self, instance: Instance, references: Sequence[int]) -> None:
        count = len(references)
        self._values = (c_double * count)()
        tail = (count,) if instance.counts_values else ()
        component = instance.fmu.component
        self._arguments = (component, (c_uint * count)(*references), count, self._values, *tail)
        self._set, self._get = instance.function("put"), instance.function("take")
        self._fail = instance.fail

    def set(self, values: list[float]) -> None:
        """Set the variables."""
        self._values[:] = [*values]
        if values and (status := self._set(*self._arguments)) > FMI_WARNING:
            self._fail("put", status)

    def get(self) -> list[float]:
        """Return the variables."""
        if self._values and (status := self._get(*self._arguments)) > FMI_WARNING:
            self._fail("take", status)
        return self._values[:]


# The calls of an FMU instance through fmpy, by value references: FMI 2.0 and 3.0 behind the same methods.


FMI_OK = 0


class Instance:
    """An instantiated FMU, for Co-Simulation or for Model Exchange; `instantiated` makes one.

    Parameters
    ----------
    fmu : fmpy.fmi2._FMU2 or fmpy.fmi3._FMU3
    version : str
        Version of FMI, "2.0" or "3.0".
    exchange : bool
        Whether it is for Model Exchange.
    sizes : mapping of int to int
        How many numbers its variables have, by value reference.
    """

    def __init__(self, fmu: Any, version: str, exchange: bool, sizes: Mapping[int, int]) -> None:
        self._sizes = sizes
        self.fmu, self._version, self._exchange = fmu, version, exchange
        self._names = SPELLED[version] | CALLED
        self.counts_values = version == "3.0"
        """Whether functions take the number of values beside that of variables."""
        self.log: list[str] = []
        """Messages so far, except those of success."""

    def instantiate(self) -> None:
        """Make the instance."""
        # With logging on, or PythonFMU would keep the reason of a failure to itself.
        if self.counts_values:
            self.fmu.instantiate(loggingOn=True, logMessage=self._keep)
            return
        self._callbacks = fmi2CallbackFunctions()
        self._callbacks.logger = fmi2CallbackLoggerTYPE(lambda host, *message: self._keep(*message))
        self._callbacks.allocateMemory = fmi2CallbackAllocateMemoryTYPE(calloc)
        self._callbacks.freeMemory = fmi2CallbackFreeMemoryTYPE(free)
        self.fmu.instantiate(callbacks=self._callbacks, loggingOn=True)

    def initialize(
        self,
        references: Sequence[int],
        values: Sequence[float],
        time: float = 0.0,
        tolerance: float | None = None,
    ) -> float | None:
        """Initialize at the time [s] with these start values; afterwards it is ready to step or integrate.

        The tolerance is that of its time integration, its own default unless given.

        Returns
        -------
        float or None [s]
            Time of the next event, if it has one.
        """
        experiment = {"tolerance": tolerance, "startTime": time}
        if self.counts_values:
            self.fmu.enterInitializationMode(**experiment)
        else:
            self.fmu.setupExperiment(**experiment)
            self.fmu.enterInitializationMode()
        self.set(references, values)
        self.fmu.exitInitializationMode()
        return self._settle()

    def set(self, references: Sequence[int], values: Sequence[float]) -> None:
        """Set variables."""
        if len(references):
            self._call("put", list(references), list(values))

    def get(self, references: Sequence[int]) -> list[float]:
        """Return variables."""
        count = self._count(references)
        return list(self._call("take", list(references), *count)) if len(references) else []

    def port(self, references: Sequence[int]) -> Port:
        """Return these variables to be set or got again and again; the instance must exist."""
        return Port(self, references)

    def slopes(self, unknowns: Sequence[int], knowns: Sequence[int]) -> Callable[[], Array]:
        """Return a function that returns d(unknowns)/d(knowns) at present, shape (n_unknowns, n_knowns)."""
        count, seed, many = len(unknowns), (c_double * 1)(1.0), self.counts_values
        columns, rows = np.zeros((len(knowns), count)), (c_uint * count)(*unknowns)
        function = self.function("slope")
        told = [
            (self.fmu.component, rows, count, (c_uint * 1)(known), 1, seed)
            + ((1,) if many else ())
            + ((c_double * count).from_address(column.ctypes.data), *((count,) if many else ()))
            for known, column in zip(knowns, columns, strict=True)
        ]

        def get() -> Array:
            for arguments in told:
                if (status := function(*arguments)) > FMI_WARNING:
                    self.fail("slope", status)
            return columns.T.copy()

        return get

    def function(self, name: str) -> Any:
        """Return a function of the FMU's library, which answers a status, by its name here."""
        return getattr(self.fmu.dll, self._spelled(name))

    def entry(self) -> tuple[int, int, dict[str, int | None]]:
        """Return the version, the component and the addresses of what a loop in C calls, if it is there."""
        library, names = self.fmu.dll, ("put", "take", "rate", "save", "restore", "forget", *CALLED)
        there = [name for name in names if hasattr(library, self._spelled(name))]
        found = {name: cast(self.function(name), c_void_p).value for name in there}
        return int(self._version[0]), self.fmu.component, found

    def fail(self, call: str, status: int) -> NoReturn:
        """Raise what fmpy raises where a function, by its name here, answers this status."""
        raise FMICallException(function=self._spelled(call), status=status)

    def deserialize(self, content: bytes) -> Any:
        """Return the FMU state that `serialize` turned into bytes."""
        return self._call("deserialize", content)

    def step(self, t: float, dt: float) -> None:
        """Advance from t to t + dt [s] (Co-Simulation)."""
        self.fmu.doStep(t, dt, noSetFMUStatePriorToCurrentPoint=False)

    def move(self, t: float, states: Array) -> None:
        """Go to a time [s] and a state (Model Exchange)."""
        self.fmu.setTime(t)
        if len(states):
            values = (c_double * len(states)).from_buffer_copy(np.asarray(states, dtype=float).tobytes())
            self.fmu.setContinuousStates(values, len(states))

    def states(self, count: int) -> Array:
        """Return the state (Model Exchange)."""
        values = (c_double * count)()
        if count:
            self.fmu.getContinuousStates(values, count)
        return np.array(values)

    def derivatives(self, count: int) -> Array:
        """Return the derivatives of the state (Model Exchange)."""
        values = (c_double * count)()
        if count:
            self._call("rate", values, count)
        return np.array(values)

    def event(self) -> float | None:
        """Pass through event mode (Model Exchange); return the time of the next event [s], if it has one."""
        self.fmu.enterEventMode()
        return self._settle()

    def directional(
        self, unknowns: Sequence[int], knowns: Sequence[int], seed: Sequence[float]
    ) -> list[float]:
        """Return the derivative of the unknowns along `seed`, in the space of the knowns."""
        count = self._count(unknowns)
        return self.fmu.getDirectionalDerivative(unknowns, knowns, seed, *count)

    def adjoint(self, unknowns: Sequence[int], knowns: Sequence[int], seed: Sequence[float]) -> list[float]:
        """Return the derivative of the sum of the unknowns, weighted by `seed`, by each known (FMI 3.0)."""
        (count,) = self._count(knowns)
        return self.fmu.getAdjointDerivative(unknowns, knowns, seed, nSensitivity=count)

    def output_slopes(self, references: Sequence[int]) -> list[float]:
        """Return the derivatives of outputs in time under held inputs (Co-Simulation), FMI 3.0 or 2.0."""
        many, count = len(references), self._count(references)
        values = (c_double * (count or (many,))[0])()
        orders = (c_int * many)(*[1] * many)
        arguments = self.fmu.component, (c_uint * many)(*references), many, orders, values, *count
        if (status := self.function("output_slope")(*arguments)) > FMI_WARNING:
            self.fail("output_slope", status)
        return list(values)

    def reset(self) -> None:
        """Return to what it was before the initialization."""
        self.fmu.reset()

    def save(self) -> Any:
        """Return the FMU state."""
        return self.fmu.getFMUState()

    def restore(self, state: Any) -> None:
        """Return to an FMU state."""
        self.fmu.setFMUState(state)

    def release(self, state: Any) -> None:
        """Free an FMU state."""
        self.fmu.freeFMUState(state)

    def serialize(self, state: Any) -> bytes:
        """Return an FMU state as bytes."""
        return self.fmu.serializeFMUState(state)

    def close(self, terminate: bool = True) -> None:
        """Terminate if asked, free the instance and unload its library."""
        try:
            if terminate:
                self.fmu.terminate()
        finally:
            let_go(self.fmu)
            self.fmu.freeInstance()

    def _count(self, references: Sequence[int]) -> tuple[int, ...]:
        """Return how many numbers variables have; nothing in FMI 2.0, where they are scalars."""
        return (sum(self._sizes.get(k, 1) for k in references),) if self.counts_values else ()

    def _settle(self) -> float | None:
        """Leave event mode; in Co-Simulation there is none."""
        terminate, time = False, None
        again = self._exchange
        while again and not terminate:
            again, terminate, _, _, defined, next_time = self._call("update")
            time = next_time if defined else None
        if self._exchange:
            self.fmu.enterContinuousTimeMode()
        return time

    def _call(self, name: str, *arguments: Any) -> Any:
        return getattr(self.fmu, self._names[name])(*arguments)

    def _spelled(self, name: str) -> str:
        """Return the name of a function in the library of an FMU."""
        name = self._names[name]
        return f"fmi{self._version[0]}{name[0].upper()}{name[1:]}"

    def _keep(self, environment: Any, status: int, category: bytes, message: bytes) -> None:
        if status != FMI_OK:
            self.log.append(" ".join(message.decode("utf-8", errors="replace").split()))


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
    texts = [str(variable.start or 0.0) for variable in variables_of(description, causality)]
    return np.array([float(number) for text in texts for number in text.split()])


def nominal_of(variable: Any) -> float:
    """Return the nominal value of a variable, 1 where it has none."""
    return abs(float(variable.nominal or 1.0)) or 1.0


def knowns_of(description: Any) -> list[int]:
    """Return the value references by which derivatives are taken: inputs and states."""
    return [*references_of(description, "input"), *references_of(description, "local")]


def known_nominals(description: Any) -> Array:
    """Return the nominal values of `knowns_of`."""
    return nominals_of([*variables_of(description, "input"), *variables_of(description, "local")])


def nominals_of(variables: Sequence[Any]) -> Array:
    """Return the nominal values of the numbers of variables."""
    return np.array([nominal_of(variable) for variable in variables for _ in elements_of(variable)])


def elements_of(variable: Any) -> list[str]:
    """Return the names of the numbers of a variable; those of an array count from 1."""
    return (
        [f"{variable.name}[{k + 1}]" for k in range(size_of(variable))] if variable.shape else [variable.name]
    )


def size_of(variable: Any) -> int:
    """Return how many numbers a variable has: several of an array of FMI 3.0."""
    return int(np.prod(variable.shape or 1))


def unknowns_of(description: Any) -> list[int]:
    """Return the value references of which derivatives are taken: outputs and derivatives of states."""
    slopes = description.derivatives if description.modelExchange is not None else []
    return [*references_of(description, "output"), *(u.variable.valueReference for u in slopes)]
