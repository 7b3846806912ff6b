"""A run of a moving contact, kept up to where it got."""

from __future__ import annotations

import io
import json
import math
import re
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from itertools import takewhile
from pathlib import Path
from time import monotonic
from typing import Any

import numpy as np
from scipy.io import netcdf_file

from ...core.errors import ConvergenceError, InputError, require_number, shortened
from ...core.files import read_sealed, write_sealed
from ...core.inputs import quantities
from .contact_steps import (
    AdaptiveSteps,
    ContactMotion,
    ContactRun,
    ContactState,
    FixedSteps,
    Level,
    Memory,
    Stepper,
    state_of,
)
from .film_equations import ContactEquations
from .film_newton import Closure, Place

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


# Runs and states of a point contact in NetCDF files.


COLUMNS = (*SERIES, "driven")

FACTS = ("complete", "work", "asked")

PLACE = {"pressure": "cell", "film": "sample", "wet": "cell"}
"""Arrays of a `Place`, and their dimensions."""


def save_run(run: ContactRun, path: str | Path, contact: str) -> None:
    """Write a run and what it takes to go on with it as NetCDF 3 with a seal; snapshots are not written.

    Parameters
    ----------
    run : ContactRun
    path : str or Path
    contact : str
        What was computed, to be compared on loading.
    """
    file: Any
    buffer = io.BytesIO()
    place = run.memory.place
    facts: dict[str, Any] = {name: getattr(run, name) for name in FACTS}
    facts |= {"step": run.memory.step}
    tables: dict[str, Any] = {name: (("step",), getattr(run, name)) for name in COLUMNS}
    for name in Level._fields:
        values = np.array([getattr(level, name) for level in run.final.levels])
        tables[f"level_{name}"] = ("level", "cell")[: values.ndim], values
    if place is not None:
        facts |= {"closure": list(place.closure), "rate": place.rate}
        for name, dimension in PLACE.items():
            tables[f"place_{name}"] = (dimension,), getattr(place, name)
    with netcdf_file(buffer, "w") as file:
        file.contact, file.facts = contact.encode(), json.dumps(facts).encode()
        for name, (dimensions, values) in tables.items():
            for dimension, size in zip(dimensions, values.shape, strict=True):
                if dimension not in file.dimensions:
                    file.createDimension(dimension, size)
            file.createVariable(name, "f8", dimensions)[:] = values
        file.flush()
        write_sealed(path, buffer.getvalue(), contact)


def load_run(path: str | Path, contact: str, equations: ContactEquations) -> ContactRun:
    """Return a run that `save_run` wrote.

    Raises
    ------
    InputError
        If the file is damaged, or of another contact.
    """
    content = read_sealed(path, contact, f"path must be a run of {contact}")
    file: Any
    with netcdf_file(io.BytesIO(content), "r", mmap=False) as file:
        arrays: dict[str, Any] = {
            name: np.array(variable[:], dtype=float) for name, variable in file.variables.items()
        }
        facts = json.loads(file.facts.decode())
    rows = zip(*(arrays[f"level_{name}"] for name in Level._fields), strict=True)
    levels = tuple(Level(float(t), float(d), float(v), p, s) for t, d, v, p, s in rows)
    place = None
    if "closure" in facts:
        pressure, film, wet = (arrays[f"place_{name}"] for name in PLACE)
        place = Place(pressure, film, wet > 0.0, Closure(*facts["closure"]), facts["rate"])
    return ContactRun(
        **{name: arrays[name] for name in COLUMNS},
        **{name: facts[name] for name in FACTS},
        snapshots=(),
        final=state_of(equations, levels),
        memory=Memory(facts["step"], place, facts["work"]),
    )


# Loads over time that know where they jump.


@quantities
@dataclass(frozen=True, kw_only=True)
class StepLoad:
    """f = 1 + amplitude between two times, 1 outside (Panovko 2011, section 4.2).

    Parameters
    ----------
    amplitude : float [1]
    start, end : float [1]
        Times of the jumps; the end may be infinite.
    """

    amplitude: float
    start: float = 0.0
    end: float = math.inf

    def __post_init__(self) -> None:
        require_number("amplitude", self.amplitude)
        require_number("start", self.start)
        if not self.end > self.start:
            raise InputError(f"end must be after start, got {self.end!r} and {self.start!r}")

    def __call__(self, t: float) -> float:
        """Return f; at a jump, that before it, as a step that ends there expects."""
        return 1.0 + self.amplitude * (self.start < t <= self.end)

    @property
    def breakpoints(self) -> tuple[float, ...]:
        """Times of the jumps."""
        return (self.start, self.end) if math.isfinite(self.end) else (self.start,)


@quantities
@dataclass(frozen=True, kw_only=True)
class SineLoad:
    """f = 1 + amplitude sin(frequency t) (Panovko 2011, section 4.3).

    Parameters
    ----------
    amplitude : float [1]
    frequency : float [1]
        Angular.
    """

    amplitude: float
    frequency: float

    def __post_init__(self) -> None:
        require_number("amplitude", self.amplitude)
        require_number("frequency", self.frequency)

    def __call__(self, t: float) -> float:
        """Return f."""
        return 1.0 + self.amplitude * math.sin(self.frequency * t)
