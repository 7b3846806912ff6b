"""The slave that runs a Stepped model inside an FMU: the model's state goes through FMI as one blob."""

from __future__ import annotations

from typing import Any

from ...core.model import Array
from .slave import ModelSlave


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
