"""Reactions whose force one kernel of the C library answers state by state."""

from __future__ import annotations

from typing import Protocol

from ..model import Force, Tangent
from .reaction import StaticReaction


class _Kernel(Protocol):
    def call(self, *state: float) -> tuple[float, float, int]: ...

    def tangent(self, *state: float) -> tuple[float, float, list[float], int]: ...


class _Compiled(Protocol):
    @property
    def kernel(self) -> _Kernel: ...

    def report(self, status: int, state: tuple[float, ...]) -> None: ...


class KernelReaction(StaticReaction):
    """A static reaction with a `kernel`, and a `report` that raises, or warns, by the status of a state."""

    def prepare(self: _Compiled) -> Force:
        """Return the force as a function of five numbers; see `StaticReaction.prepare`."""
        call, report = self.kernel.call, self.report

        def force(x: float, y: float, vx: float, vy: float, speed: float) -> tuple[float, float]:
            force_x, force_y, status = call(x, y, vx, vy, speed)
            if status:
                report(status, (x, y, vx, vy, speed))
            return force_x, force_y

        return force

    def prepare_tangent(self: _Compiled) -> Tangent:
        """Return force and derivatives as one function of five numbers; see `model.TangentReaction`."""
        call, report = self.kernel.tangent, self.report

        def tangent(
            x: float, y: float, vx: float, vy: float, speed: float
        ) -> tuple[float, float, list[float]]:
            force_x, force_y, slopes, status = call(x, y, vx, vy, speed)
            if status:
                report(status, (x, y, vx, vy, speed))
            return force_x, force_y, slopes

        return tangent
