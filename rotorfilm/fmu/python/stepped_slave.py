"""The slave that runs a Stepped model inside an FMU: the model's state goes through FMI as one blob."""

from __future__ import annotations

import json
from typing import Any

from ...errors import FmuError
from ...model import Array
from .pythonfmu_api import LogMessage
from .slave import DISCARD, ModelSlave, sealed, unsealed


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

    def _step(self, current_time: float, step_size: float) -> bool:
        self._require_step(current_time, step_size)
        try:
            held, _, _ = self._model.step(self._held, current_time, self._inputs.copy(), step_size)
            output = self._finite(self._model.answer(held))
        except Exception as error:
            self._log_queue.append(LogMessage(DISCARD, "logStatusDiscard", self._described(error)))
            return False
        self._held, self._time, self._output = held, current_time + step_size, output
        return True

    def _evaluate(self, time: float, state: Array) -> list[float]:
        if self._held is None or not self._running:
            self._held = self._model.start(self._inputs.copy())
        return self._finite(self._model.answer(self._held))

    def _save(self) -> dict[str, Any]:
        return {**super()._save(), "blob": b"" if self._held is None else self._model.pack(self._held)}

    def _restore(self, state: dict[str, Any]) -> None:
        super()._restore(state)
        self._held = self._model.unpack(state["blob"]) if state["blob"] else None

    @staticmethod
    def _fmu_state_to_bytes(state: dict[str, Any]) -> bytes:
        return sealed(json.dumps({**state, "blob": ""}).encode() + b"\n" + state["blob"])

    @staticmethod
    def _fmu_state_from_bytes(data: bytes) -> dict[str, Any]:
        try:
            head, _, blob = unsealed(data).partition(b"\n")
            return {**json.loads(head), "blob": blob}
        except ValueError:
            # Raising here would harm an instance that is not known here; restoring it is refused instead.
            return {"tag": "unreadable bytes"}

    def _finite(self, values: Array) -> list[float]:
        output = [float(value) for value in values]
        for signal, value in zip(self._model.outputs, output, strict=True):
            if value - value != 0.0:
                raise FmuError(f"output {signal.name} must be finite, got {value!r}")
        return output
