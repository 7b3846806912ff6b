"""A run of a moving contact, kept up to where it got."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np

from ..errors import ConvergenceError
from .contact_equations import ContactEquations
from .contact_levels import ContactMotion, Level
from .contact_state import ContactRun, ContactState, state_of
from .contact_steps import AdaptiveSteps, FixedSteps, Stepper

SERIES = ("time", "delta", "velocity", "central_film", "minimum_film", "carried_load")


class _Recorder:
    """Series of a run as it grows."""

    def __init__(self, equations: ContactEquations, motion: ContactMotion, wanted: Sequence[float]) -> None:
        self.equations, self.motion = equations, motion
        self.wanted, self.rows = list(wanted), []  # type: ignore[var-annotated]
        self.snapshots: list[ContactState] = []

    def take(self, levels: tuple[Level, ...]) -> None:
        """Record the newest of the levels."""
        newest = levels[0]
        film = self.equations.film(newest.pressure, newest.delta)
        central = self.equations.central_film(newest.pressure, newest.delta)
        load = self.equations.load(newest.pressure) / (2.0 * np.pi / 3.0)
        row = (
            newest.t,
            newest.delta,
            newest.velocity,
            central,
            film.min(),
            load,
            self.motion.drive(newest.t),
        )
        self.levels = levels
        self.rows.append(row)
        if any(abs(newest.t - t) < 1e-9 for t in self.wanted):
            self.snapshots.append(state_of(self.equations, levels))

    def run(self, work: dict[str, int], *, complete: bool) -> ContactRun:
        """Return what has been recorded."""
        columns = np.array(self.rows, dtype=float).T
        return ContactRun(
            **dict(zip(SERIES, columns, strict=False)),
            driven=columns[-1],
            snapshots=tuple(self.snapshots),
            final=state_of(self.equations, self.levels),
            complete=complete,
            work=work,
        )


def run_contact(
    equations: ContactEquations,
    motion: ContactMotion,
    control: AdaptiveSteps | FixedSteps,
    start: ContactState,
    end: float,
    snapshots: Sequence[float],
) -> ContactRun:
    """Return the run from a state to a time; an interruption from the keyboard returns what there is.

    Raises
    ------
    ConvergenceError
        If a step fails; its `partial` is the run up to there.
    """
    stepper = Stepper(equations, motion, control)
    recorder = _Recorder(equations, motion, snapshots)
    recorder.take(start.levels)
    ends: Any = sorted({*motion.breakpoints, *snapshots, end})
    ends = [t for t in ends if start.t < t <= end]
    try:
        for levels in stepper.advance(start.levels, ends):
            recorder.take(levels)
    except KeyboardInterrupt:
        return recorder.run(stepper.work, complete=False)
    except ConvergenceError as error:
        raise ConvergenceError(
            f"{error} (at t = {recorder.levels[0].t:.6g})", recorder.run(stepper.work, complete=False)
        ) from error
    return recorder.run(stepper.work, complete=True)
