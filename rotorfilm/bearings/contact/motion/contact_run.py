"""A run of a moving contact, kept up to where it got."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator, Sequence
from itertools import takewhile
from time import monotonic

import numpy as np

from ....errors import ConvergenceError, InputError, shortened
from ..film.film_equations import ContactEquations
from .contact_state import ContactRun, ContactState, state_of
from .contact_steps import AdaptiveSteps, FixedSteps, Stepper
from .levels import ContactMotion, Level

SERIES = ("time", "delta", "velocity", "central_film", "minimum_film", "carried_load")


EVERY = 20.0
"""Seconds after which a run that is kept is kept again, at the end of a step."""

_ADDRESS = re.compile(r" at 0x[0-9a-fA-F]+")


class _Recorder:
    """Series of a run as it grows."""

    def __init__(self, stepper: Stepper, asked: str, wanted: Sequence[float]) -> None:
        self.stepper, self.asked, self.wanted = stepper, asked, list(wanted)
        self.rows: list[tuple[float, ...]] = []
        self.snapshots: list[ContactState] = []

    def go_on(self, run: ContactRun) -> None:
        """Begin with what a run has recorded."""
        self.rows = list(zip(*(getattr(run, name).tolist() for name in (*SERIES, "driven")), strict=True))
        self.snapshots = list(run.snapshots)
        self.last = len(self.rows), run.final.levels, run.memory

    def take(self, levels: tuple[Level, ...]) -> None:
        """Record the newest of the levels."""
        equations, newest = self.stepper.equations, levels[0]
        film = equations.film(newest.pressure, newest.delta)
        central = equations.central_film(newest.pressure, newest.delta)
        load = equations.carried_load(newest.pressure)
        drive = self.stepper.motion.drive(newest.t)
        row = (newest.t, newest.delta, newest.velocity, central, film.min(), load, drive)
        if any(abs(newest.t - t) < 1e-9 for t in self.wanted):
            self.snapshots.append(state_of(equations, levels))
        self.rows.append(row)
        # At once, so that an interruption finds things that belong together.
        self.last = len(self.rows), levels, self.stepper.memory(levels)

    def run(self, *, complete: bool) -> ContactRun:
        """Return what has been recorded."""
        count, levels, memory = self.last
        columns = np.array(self.rows[:count], dtype=float).T
        return ContactRun(
            **dict(zip(SERIES, columns, strict=False)),
            driven=columns[-1],
            snapshots=tuple(self.snapshots),
            final=state_of(self.stepper.equations, levels),
            complete=complete,
            work=memory.work,
            asked=self.asked,
            memory=memory,
        )


def run_contact(
    equations: ContactEquations,
    motion: ContactMotion,
    control: AdaptiveSteps | FixedSteps,
    start: ContactState | ContactRun,
    duration: float,
    snapshots: Sequence[float],
    keep: Callable[[ContactRun], None] | None = None,
) -> ContactRun:
    """Return the run from a state; an interruption from the keyboard returns what there is.

    A run in place of the state is gone on with to its end; `keep` is called with what there is, every now and
    then and at the end, however the run ends.

    Raises
    ------
    InputError
        If a run to go on with was asked for otherwise, or was driven otherwise until now.
    ConvergenceError
        If a step fails; its `partial` is the run up to there.
    """
    begun = start if isinstance(start, ContactRun) else None
    now = start.final if isinstance(start, ContactRun) else start
    end = duration + float(now.t if begun is None else begun.time[0])
    asked = _ADDRESS.sub("", f"{motion!r}, {control!r}, end={end!r}, snapshots={tuple(snapshots)!r}")
    if begun is not None:
        _require_same(begun, asked, motion)
    stepper = Stepper(equations, motion, control, None if begun is None else begun.memory)
    recorder = _Recorder(stepper, asked, snapshots)
    if begun is None:
        recorder.take(now.levels)
    else:
        recorder.go_on(begun)
    ends = [t for t in sorted({*motion.breakpoints, *snapshots, end}) if now.t < t <= end]
    return _finished(recorder, stepper.advance(now.levels, ends), keep or _forget)


def _require_same(begun: ContactRun, asked: str, motion: ContactMotion) -> None:
    if begun.asked != asked:
        same = sum(
            1 for _ in takewhile(lambda pair: pair[0] == pair[1], zip(begun.asked, asked, strict=False))
        )
        at = asked.rfind(" ", 0, same) + 1  # where they part, for the whole may be long
        raise InputError(
            f"start must be gone on with as it was begun, by {shortened(begun.asked[at:])}, "
            f"got {shortened(asked[at:])}"
        )
    # Functions do not say what they are: they are compared where the run has been.
    for t, driven in zip(begun.time.tolist(), begun.driven.tolist(), strict=True):
        if (drive := motion.drive(t)) != driven:
            raise InputError(
                f"start must be gone on with as it was begun, driven by {driven!r} at t = {t:.6g}, "
                f"got {drive!r}"
            )


def _finished(
    recorder: _Recorder, steps: Iterator[tuple[Level, ...]], keep: Callable[[ContactRun], None]
) -> ContactRun:
    complete, kept = False, monotonic()
    try:
        for levels in steps:
            recorder.take(levels)
            if monotonic() - kept > EVERY:
                keep(recorder.run(complete=False))
                kept = monotonic()
        complete = True
    except KeyboardInterrupt:
        pass
    except ConvergenceError as error:
        partial = recorder.run(complete=False)
        keep(partial)
        raise ConvergenceError(f"{error} (at t = {partial.final.t:.6g})", partial) from error
    run = recorder.run(complete=complete)
    keep(run)
    return run


def _forget(run: ContactRun) -> None:
    """Keep nothing."""
