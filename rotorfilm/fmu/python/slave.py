"""The slaves that run models inside an FMU; PythonFMU's compiled part calls their methods."""

from __future__ import annotations

import ctypes
import json
import math
import os
import sys
import warnings
import zlib
from collections.abc import Callable, Sequence
from contextlib import suppress
from functools import cache
from pathlib import Path
from typing import Any, ClassVar, NoReturn, TypeVar

import numpy as np

from ...core.errors import FmuError, InputError
from ...core.model import Array, Dynamic, Stepped
from ...core.signals import Variable
from ..description import fmi_variables
from ..reference import advance
from .codec import decode

T = TypeVar("T")

DISCARD = 2
"""FMI's number of fmi2Discard."""

TIME_SLACK = 1e-6
"""Accepted gap, in steps, between the end of a step and the start of the next: roundoff of a master."""


# What PythonFMU's compiled part expects of a slave, and how to survive its reference counting.
#
# PythonFMU 0.7.0 (PySlaveInstance.cpp) knows three outcomes: a method returns, fmi2OK; do_step returns False,
# fmi2Discard with fmi2Terminated true; a method raises, fmi2Fatal with the exception's repr in the log.
# There is no way to fmi2Error. An FMU carries the libraries it is exported with, so that the export is where
# another version is refused (`archive.require_verified_version`).


class Fmi2Slave:
    """The name by which PythonFMU finds a slave class; no copy of its Python package is needed."""


class LogMessage:
    """An entry of the log queue: status (FMI number), category and message."""

    def __init__(self, status: int, category: str, msg: str) -> None:
        self.status = status
        self.category = category
        self.msg = msg


class SlaveFailure(Exception):
    """What a failing slave raises; its repr is the line that the log shows."""

    def __repr__(self) -> str:
        return str(self)


def keep(*held: Any) -> None:
    """Take one more reference to each object, for one that PythonFMU releases without having it."""
    for value in held:
        ctypes.pythonapi.Py_IncRef(ctypes.py_object(value))


def abort(slave: Fmi2Slave, log_queue: list[LogMessage], message: str) -> NoReturn:
    """Raise SlaveFailure such that the instance, and the process, outlive it.

    On an exception PythonFMU releases its references to the class, the instance and the log queue and
    releases them again with the instance; each is taken once more here, so that the counts stay right.
    The queue must be empty, because PythonFMU would call the logger with the exception pending and lose it.
    """
    log_queue.clear()
    keep(type(slave), slave, log_queue)
    raise SlaveFailure(message)


# The slaves.


class ModelSlave(Fmi2Slave):
    """A model as FMI 2.0 Co-Simulation slave, its inputs held over each step.

    Outputs are computed when they are asked for and always belong to the present inputs, states and time.
    A call that fails ends in fmi2Fatal, and so does every later one until the instance is reset or a saved
    state is restored. Only a failing step of a dynamic model is discarded instead: its states stay where
    the last good step left them.
    """

    tag: ClassVar[str] = ""
    """Content hash of the FMU: states of another FMU are refused."""

    def __init__(self, *, instance_name: str, resources: str, logger: int, visible: int) -> None:
        _leave_search_path(resources)
        data = json.loads(Path(resources, "model.json").read_text(encoding="utf-8"))
        with warnings.catch_warnings(action="ignore"):
            # Whoever exported the model has seen what its parameters warn of.
            self._model = decode(data["model"], data["modules"])
        self._variables = fmi_variables(self._model, data["component"], data["start"])
        self._name = instance_name
        self._log_queue: list[LogMessage] = []
        self._failure = ""
        self._running = False
        self._time = 0.0
        self._inputs = _start_values(self._variables, "input")
        self._state = _start_values(self._variables, "local")
        self._output: list[float] | None = None
        self._read_files()
        for library in Path(resources).parent.glob("binaries/linux64/*.so"):
            _end_in_time(str(library))

    def setup_experiment(self, start_time: float, stop_time: float | None, tolerance: float | None) -> None:
        """Take over the start time [s]; the tolerance is fixed."""
        self._time = start_time

    def enter_initialization_mode(self) -> None:
        """Do nothing: start values may be set until the mode is left."""

    def exit_initialization_mode(self) -> None:
        """Compute the outputs at the start time."""
        self._guard(self._start)

    def do_step(self, current_time: float, step_size: float) -> bool:
        """Advance by step_size [s]; return False where a dynamic model cannot."""
        return self._guard(self._step, current_time, step_size)

    def terminate(self) -> None:
        """Do nothing: there is nothing to close."""

    def set_real(self, references: Sequence[int], values: Sequence[float]) -> None:
        """Set inputs, and states before the simulation starts."""
        self._guard(self._write, references, values)

    def get_real(self, references: Sequence[int]) -> list[float]:
        """Return inputs, present outputs and states."""
        return self._guard(self._read, references)

    def set_integer(self, references: Sequence[int], values: Sequence[Any]) -> None:
        """Refuse: all variables are real."""
        self._guard(self._refuse, references)

    set_boolean = set_integer
    set_string = set_integer

    def get_integer(self, references: Sequence[int]) -> list[Any]:
        """Refuse: all variables are real."""
        return self._guard(self._refuse, references)

    get_boolean = get_integer
    get_string = get_integer

    def _get_log_queue(self) -> list[LogMessage]:
        return self._log_queue

    def _get_fmu_state(self) -> dict[str, Any]:
        return self._guard(self._save)

    def _set_fmu_state(self, state: dict[str, Any]) -> None:
        self._failure = ""
        self._guard(self._restore, state)

    @staticmethod
    def _fmu_state_to_bytes(state: dict[str, Any]) -> bytes:
        # JSON writes the shortest decimals that read back as the same doubles.
        values = {name: value for name, value in state.items() if name != "blob"}
        return sealed(json.dumps(values).encode() + b"\n" + state["blob"])

    @staticmethod
    def _fmu_state_from_bytes(data: bytes) -> dict[str, Any]:
        try:
            values, _, blob = unsealed(data).partition(b"\n")
            return {**json.loads(values), "blob": blob}
        except ValueError:
            # Raising here would harm an instance that is not known here; restoring it is refused instead.
            return {"tag": "unreadable bytes"}

    def _guard(self, method: Callable[..., T], *arguments: Any) -> T:
        """Call a method; turn any failure into the one that PythonFMU survives, and stay failed."""
        if not self._failure:
            try:
                return method(*arguments)
            except BaseException as error:
                self._failure = self._described(error)
        abort(self, self._log_queue, self._failure)

    def _described(self, error: BaseException) -> str:
        values = [*self._inputs.tolist(), *self._state.tolist()]
        names = [variable.name for variable in self._variables if variable.causality != "output"]
        present = ", ".join(f"{name} = {value!r}" for name, value in zip(names, values, strict=True))
        return f"{self._name}: {type(error).__name__}: {error} (at time = {self._time!r}, {present})"

    def _read_files(self) -> None:
        """Evaluate the model once: what it reads from the FMU's folder, it reads while that is there."""
        # A failure is told when the initialization ends, with the values that then count.
        with suppress(Exception), warnings.catch_warnings(action="ignore"):
            self._evaluate(self._time, self._state)

    def _start(self) -> None:
        self._outputs()
        self._running = True

    def _step(self, current_time: float, step_size: float) -> bool:
        self._require_step(current_time, step_size)
        try:
            self._advance(current_time, step_size)
        except Exception as error:
            if not isinstance(self._model, Dynamic | Stepped):
                raise
            self._log_queue.append(LogMessage(DISCARD, "logStatusDiscard", self._described(error)))
            return False
        return True

    def _advance(self, time: float, step_size: float) -> None:
        """Go to the end of a step, if the outputs exist there."""
        state, end = self._state, time + step_size
        if isinstance(self._model, Dynamic):
            state = advance(self._model, time, state, self._inputs, step_size)
        output = self._evaluate(end, state)
        self._time, self._state, self._output = end, state, output

    def _evaluate(self, time: float, state: Array) -> list[float]:
        return self._finite(self._model.output(time, state, self._inputs))

    def _finite(self, values: Array) -> list[float]:
        output = [float(value) for value in values]
        for signal, value in zip(self._model.outputs, output, strict=True):
            if not math.isfinite(value):
                raise FmuError(f"output {signal.name} must be finite, got {value!r}")
        return output

    def _outputs(self) -> list[float]:
        if self._output is None:
            self._output = self._evaluate(self._time, self._state)
        return self._output

    def _write(self, references: Sequence[int], values: Sequence[float]) -> None:
        self._output = None
        for reference, value in zip(references, values, strict=True):
            variable = self._variable(reference)
            if not math.isfinite(value):
                raise InputError(f"{variable.name} must be finite, got {value!r}")
            if variable.causality == "input":
                self._inputs[reference] = value
            elif variable.causality == "local" and not self._running:
                self._state[reference - len(self._variables)] = value
            else:
                raise InputError(f"{variable.name} is a calculated {variable.causality}, it cannot be set")

    def _read(self, references: Sequence[int]) -> list[float]:
        return [self._value(reference, self._variable(reference)) for reference in references]

    def _value(self, reference: int, variable: Variable) -> float:
        if variable.causality == "input":
            return float(self._inputs[reference])
        if variable.causality == "local":
            return float(self._state[reference - len(self._variables)])
        return self._outputs()[reference - len(self._inputs)]

    def _variable(self, reference: int) -> Variable:
        if not 0 <= reference < len(self._variables):
            raise InputError(f"value reference must be in 0 ... {len(self._variables) - 1}, got {reference}")
        return self._variables[reference]

    def _refuse(self, references: Sequence[int]) -> Any:
        raise InputError(f"value references must be read and set as reals, got {list(references)}")

    def _require_step(self, current_time: float, step_size: float) -> None:
        if not self._running:
            raise FmuError("do_step must follow exit_initialization_mode, got it before")
        if not (math.isfinite(step_size) and step_size >= 0.0):
            raise InputError(f"communicationStepSize must be finite and not negative, got {step_size!r}")
        slack = TIME_SLACK * step_size + 1e-9 * abs(self._time)
        if not abs(current_time - self._time) <= slack:
            raise InputError(f"currentCommunicationPoint must be {self._time!r}, got {current_time!r}")

    def _save(self) -> dict[str, Any]:
        return {
            "tag": self.tag,
            "time": self._time,
            "running": self._running,
            "inputs": self._inputs.tolist(),
            "state": self._state.tolist(),
            "blob": b"",
        }

    def _restore(self, state: dict[str, Any]) -> None:
        if state["tag"] != self.tag:
            raise FmuError(f"the FMU state must come from this FMU ({self.tag}), got {state['tag']}")
        self._time, self._running, self._output = state["time"], state["running"], None
        self._inputs, self._state = np.array(state["inputs"]), np.array(state["state"])


class SteppedSlave(ModelSlave):
    """A Stepped model as FMI 2.0 Co-Simulation slave.

    The resting state under the start values is found when initialization ends. Outputs belong to the end of
    the last step; inputs set after it act in the next one. A step that fails is discarded: the state stays
    that of its beginning.
    """

    _held: Any = None

    def _read_files(self) -> None:
        """Do nothing: all modules are in memory, and a resting state may take seconds."""

    def _start(self) -> None:
        self._held, self._output = None, None
        super()._start()

    def _advance(self, time: float, step_size: float) -> None:
        held, _, _ = self._model.step(self._held, time, self._inputs.copy(), step_size)
        output = self._finite(self._model.answer(held))
        self._held, self._time, self._output = held, time + step_size, output

    def _evaluate(self, time: float, state: Array) -> list[float]:
        if self._held is None or not self._running:
            self._held = self._model.start(self._inputs.copy())
        return self._finite(self._model.answer(self._held))

    def _save(self) -> dict[str, Any]:
        return {**super()._save(), "blob": b"" if self._held is None else self._model.pack(self._held)}

    def _restore(self, state: dict[str, Any]) -> None:
        super()._restore(state)
        self._held = self._model.unpack(state["blob"]) if state["blob"] else None


def sealed(content: bytes) -> bytes:
    """Return a content behind its checksum."""
    return zlib.crc32(content).to_bytes(4, "little") + content


def unsealed(data: bytes) -> bytes:
    """Return the content behind a checksum; raise ValueError where that is another one."""
    if sealed(data[4:]) != data:
        raise ValueError("the bytes of an FMU state must have the checksum before them")
    return data[4:]


def _start_values(variables: tuple[Variable, ...], causality: str) -> Array:
    return np.array([float(v.start or 0.0) for v in variables if v.causality == causality])


@cache
def _end_in_time(library: str) -> None:
    """Have PythonFMU let go of Python as the first thing when the process ends.

    By itself it does so where exit() destroys its objects, when other libraries have lost theirs, and once
    more where the library is unloaded thereafter: faults of memory. After the function that it exports
    both do nothing. That function must stay: the library is not unloaded before the process ends.
    """
    with suppress(OSError, AttributeError):
        mode = os.RTLD_NOLOAD | os.RTLD_NODELETE | os.RTLD_NOW
        end = ctypes.CDLL(library, mode=mode).finalizePythonInterpreter
        ctypes.CDLL(None).__cxa_atexit(end, None, None)


def _leave_search_path(resources: str) -> None:
    """Undo PythonFMU's entry in sys.path: everything is imported by now, and the folder may vanish."""
    sys.path[:] = [entry for entry in sys.path if entry != resources]
