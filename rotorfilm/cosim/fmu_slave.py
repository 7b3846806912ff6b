"""An FMI 2.0 Co-Simulation FMU as a partner in a co-simulation, run by fmpy."""

from __future__ import annotations

import shutil
import tempfile
from collections.abc import Iterator, Mapping
from contextlib import contextmanager, suppress
from os import PathLike
from typing import Any

import fmpy
from fmpy.fmi1 import FMICallException
from fmpy.fmi2 import (
    FMU2Slave,
    calloc,
    fmi2CallbackAllocateMemoryTYPE,
    fmi2CallbackFreeMemoryTYPE,
    fmi2CallbackFunctions,
    fmi2CallbackLoggerTYPE,
    free,
)

from ..errors import FilmContactError, FmuError, InputError
from ..signals import from_fmi_name

CONTACT = FilmContactError.__name__
"""What the log of a film FMU contains when its journal touched the wall."""

FMI_OK = 0


class FmuSlave:
    """An instantiated FMU; `open_fmu` makes one and frees it.

    Parameters
    ----------
    description : fmpy.model_description.ModelDescription
    folder : str
        Where the FMU was extracted.
    """

    def __init__(self, description: Any, folder: str) -> None:
        self._name = description.modelName
        self._log: list[str] = []
        self._failed = False
        self._references = {
            causality: _references(description, causality) for causality in ("input", "output")
        }
        self._fmu = FMU2Slave(
            guid=description.guid,
            unzipDirectory=folder,
            modelIdentifier=description.coSimulation.modelIdentifier,
            instanceName=description.modelName,
        )
        self._callbacks = _callbacks(self._log)
        try:
            # With logging on, or PythonFMU would keep the reason of a failure to itself.
            self._fmu.instantiate(callbacks=self._callbacks, loggingOn=True)
        except Exception as error:
            self._fmu.freeLibrary()
            message = " ".join([f"FMU {self._name!r} cannot be instantiated: {error}", *self._log])
            raise FmuError(message) from error

    @property
    def inputs(self) -> tuple[str, ...]:
        """Local names of the real inputs."""
        return tuple(self._references["input"])

    @property
    def outputs(self) -> tuple[str, ...]:
        """Local names of the real outputs."""
        return tuple(self._references["output"])

    def start(self, values: Mapping[str, float]) -> None:
        """Initialize at t = 0 with these inputs."""
        with self._reported("initialization"):
            self._fmu.setupExperiment(startTime=0.0)
            self._fmu.enterInitializationMode()
            self._set(values)
            self._fmu.exitInitializationMode()

    def set(self, values: Mapping[str, float]) -> None:
        """Set inputs by their local names."""
        with self._reported("setting inputs"):
            self._set(values)

    def step(self, t: float, dt: float) -> None:
        """Advance from t to t + dt [s]."""
        with self._reported(f"the step from t = {t:.9g} s"):
            self._fmu.doStep(currentCommunicationPoint=t, communicationStepSize=dt)

    def get(self) -> dict[str, float]:
        """Return the outputs at the present time."""
        references = self._references["output"]
        with self._reported("reading outputs"):
            return dict(zip(references, self._fmu.getReal(list(references.values())), strict=True))

    def close(self) -> None:
        """Terminate, free the instance and unload its library, whatever happened before."""
        if not self._failed:
            with suppress(FMICallException):
                self._fmu.terminate()
        # FMI forbids even this after fmi2Fatal, but PythonFMU calls every exception fatal and its
        # instances can be freed; not freeing them would leak one for each run into the wall.
        self._fmu.freeInstance()

    def _set(self, values: Mapping[str, float]) -> None:
        references = self._references["input"]
        self._fmu.setReal([references[name] for name in values], list(values.values()))

    @contextmanager
    def _reported(self, doing: str) -> Iterator[None]:
        """Turn an error status into an FmuError, or FilmContactError, that quotes the log."""
        try:
            yield
        except FMICallException as error:
            self._failed = True
            text = " ".join([f"FMU {self._name!r} failed in {doing}: {error}", *self._log])
            raise (FilmContactError if CONTACT in text else FmuError)(text) from error


@contextmanager
def open_fmu(path: str | PathLike[str]) -> Iterator[FmuSlave]:
    """Extract and instantiate an FMU; free it and delete the files at the end, in any case.

    Parameters
    ----------
    path : path of the .fmu file

    Raises
    ------
    FmuError
        If the file cannot be read, is no FMI 2.0 Co-Simulation FMU, or cannot be instantiated.
    """
    folder = tempfile.mkdtemp(prefix="rotorfilm-")
    try:
        slave = _instantiated(path, folder)
        try:
            yield slave
        finally:
            slave.close()
    finally:
        shutil.rmtree(folder, ignore_errors=True)


def _instantiated(path: str | PathLike[str], folder: str) -> FmuSlave:
    try:
        description = fmpy.read_model_description(str(path), validate=False)
        fmpy.extract(str(path), unzipdir=folder)
    except Exception as error:
        raise FmuError(f"fmu must be a readable FMU, got {str(path)!r}: {error}") from error
    if description.fmiVersion != "2.0" or description.coSimulation is None:
        raise FmuError(
            f"fmu must be an FMI 2.0 Co-Simulation FMU, got FMI {description.fmiVersion} in {str(path)!r}"
        )
    try:
        return FmuSlave(description, folder)
    except (InputError, FmuError):
        raise
    except Exception as error:
        raise FmuError(f"FMU {str(path)!r} cannot be instantiated: {error}") from error


def _references(description: Any, causality: str) -> dict[str, int]:
    """Return the value references of the real inputs or outputs, by local name."""
    references: dict[str, int] = {}
    for variable in description.modelVariables:
        if variable.causality != causality or variable.type != "Real":
            continue
        name = _local_name(variable.name)
        if name in references:
            raise InputError(f"{causality} names must differ without their component, got {name!r} twice")
        references[name] = variable.valueReference
    return references


def _local_name(name: str) -> str:
    """Return the signal of `component.signal`; other spellings stay as they are."""
    try:
        return from_fmi_name(name)[1]
    except InputError:
        return name


def _callbacks(log: list[str]) -> fmi2CallbackFunctions:
    """Return callbacks that collect error messages instead of printing them."""

    def logger(environment: Any, instance: bytes, status: int, category: bytes, message: bytes) -> None:
        if status != FMI_OK:
            log.append(" ".join(message.decode("utf-8", errors="replace").split()))

    callbacks = fmi2CallbackFunctions()
    callbacks.logger = fmi2CallbackLoggerTYPE(logger)
    callbacks.allocateMemory = fmi2CallbackAllocateMemoryTYPE(calloc)
    callbacks.freeMemory = fmi2CallbackFreeMemoryTYPE(free)
    return callbacks
