"""The driver of the compiled integration: scheme, tables, what ends a run."""

from __future__ import annotations

import math
from ctypes import byref, c_int32, c_int64
from enum import IntEnum

import numpy as np

from ...errors import ContactError, ConvergenceError
from ...model import Array
from ...native.layouts.structs import (
    SLOTS,
    STEPS,
    GroundStruct,
    MarchStruct,
    SpeedsStruct,
    SpinStruct,
    StepTableStruct,
)
from ...native.library import loops
from ...rotors import SpeedProfile
from .collocation import STAGES, ModalArrays, StepTable, radau_scheme
from .film_calls import raise_foreign
from .journal_films import JournalFilms
from .modal import Complex, ModalRotor, spin_rates

BUDGET = 20000
"""Steps between two looks at the interpreter, where a user may interrupt."""

SHORTEST = 1e-13
"""Shortest step, relative to the duration, before a run is given up."""

NEWTON = 0.01
"""Error left by Newton's method, in local errors."""

_COUNTERS = {
    "film_evaluations": "films",
    "jacobians": "jacobians",
    "steps": "steps",
    "rejected": "rejected",
    "restarts": "walls",
}


def profile_rows(profile: SpeedProfile) -> tuple[Array, Array, Array, Array]:
    """Return times, speeds, slopes after them and angles turned since t = 0."""
    times = np.array(profile.times, dtype=float)
    slopes = np.array([profile.acceleration(t) for t in profile.times])
    angles = np.array([profile.angle(t) for t in profile.times])
    return times, np.array(profile.speeds, dtype=float), slopes, angles


class End(IntEnum):
    """Why a march ended: rf_march_end of march.h."""

    DONE = 0
    WALL = 1
    SHORT = 2
    BUSY = 3
    BROKEN = 4
    NO_MEMORY = 5


class March:
    """One run of a rotor, which goes on from stop to stop.

    Parameters
    ----------
    modal : ModalRotor
    state : ndarray of complex, shape (n_modes,)
        Modal coordinates; moved by `to`.
    rtol : float [1]
        Local error of the journals: displacement / clearance, velocity / (clearance speed).
    longest : float [s]
        Longest step.
    duration : float [s]
        Of the whole run, which says what step is too short.
    speed : float [rad/s], optional
        Of the modes, where the matrices depend on the speed and that is not always this one.
    stages : int
        Collocation nodes.
    """

    def __init__(
        self,
        *,
        modal: ModalRotor,
        state: Complex,
        rtol: float,
        longest: float,
        duration: float,
        speed: float | None = None,
        stages: int = STAGES,
    ) -> None:
        self.modal, self.state = modal, np.array(state, dtype=complex)
        self._duration = duration
        self._kept = ModalArrays.of(modal), radau_scheme(stages), JournalFilms.of_rotor(modal)
        self._numbers = *profile_rows(modal.parts.profile), journal_scales(modal)
        spins = speed is not None and modal.parts.turns and set(modal.parts.profile.speeds) != {speed}
        self._spin = spin_rates(modal) if spins else None
        base = modal.parts.base
        self._ground = None if base is None else base.rows
        self._tables = [StepTable.unfilled(self._kept[0], stages, spins=spins) for _ in range(SLOTS + 1)]
        times = len(self._numbers[0])
        self._struct = MarchStruct(
            *(of.struct() for of in self._kept),
            SpeedsStruct(times, *(row.ctypes.data for row in self._numbers[:4])),
            spin_struct(speed, self._spin),
            ground_struct(self._ground),
            self._numbers[4].ctypes.data,
            longest,
            SHORTEST * duration,
            rtol,
            max(NEWTON * rtol, 1e-12),
            (StepTableStruct * (SLOTS + 1))(*(table.struct() for table in self._tables)),
            (c_int32 * STEPS)(*[-1] * STEPS),
            (c_int32 * SLOTS)(*[-1] * SLOTS),
        )
        # A first step that the error control need not believe in: a hundredth of a turn or less.
        first = 0.01 * 2.0 * np.pi / max(rate_of(modal), 1.0 / duration)
        self._struct.step = math.ceil(4.0 * math.log2(max(1.0, longest / first)))
        self._struct.z = self.state.ctypes.data

    @property
    def work(self) -> dict[str, int]:
        """Film_evaluations, jacobians, steps, rejected steps and, of these, restarts at a wall so far."""
        return {name: getattr(self._struct, counter) for name, counter in _COUNTERS.items()}

    @property
    def time(self) -> float:
        """How far the run is [s]."""
        return float(self._struct.time)

    @property
    def step(self) -> int:
        """Which of the lengths of steps is the next one."""
        return int(self._struct.step)

    @property
    def left_map(self) -> bool:
        """Whether a film was asked beyond its map."""
        return bool(self._struct.left_map)

    def resume(self, time: float, state: Complex, step: int) -> None:
        """Go on at a time [s] with a state in modal coordinates, and the step of another march if not -1."""
        self._struct.time, self.state[:] = time, state
        self._struct.step = step if step >= 0 else self._struct.step

    def to(self, stop: float, grid: Array) -> Complex:
        """Integrate to a time and return the modal coordinates at the times of `grid` after the last stop.

        Raises
        ------
        ContactError, ConvergenceError
            With the modal coordinates until then as partial result.
        """
        out, place = np.empty((len(grid), len(self.state)), dtype=complex), c_int64()
        times = np.ascontiguousarray(grid, dtype=float)
        arguments = times.ctypes.data, len(times), byref(place), out.ctypes.data
        end = End.BUSY
        while end == End.BUSY:
            end = End(loops()["rf_march_to"](byref(self._struct), stop, BUDGET, *arguments))
        raise_foreign(self.modal.calls)
        if end == End.NO_MEMORY:
            raise MemoryError("no memory for the steps of a rotor")
        if end != End.DONE:
            raise self._failure(end, out[: place.value])
        return out

    def _failure(self, end: End, kept: Complex) -> ContactError | ConvergenceError:
        at = f"at t = {self.time:.9g} s"
        if end == End.WALL:
            return ContactError(f"journal reached the wall {at}", kept)
        if end == End.BROKEN:
            return ConvergenceError(
                f"film force must be finite and the forces of a step solvable, {at}", kept
            )
        return ConvergenceError(f"integration needs steps below {SHORTEST:g} of the duration {at}", kept)


def spin_struct(speed: float | None, rates: tuple[Array, Array] | None) -> SpinStruct:
    """Return what the speed changes as the C library reads it, while the arrays live."""
    return SpinStruct(speed or 0.0, *(part.ctypes.data for part in rates or ()))


def ground_struct(rows: Array | None) -> GroundStruct:
    """Return times and acceleration of the ground as the C library reads them, while the array lives."""
    return GroundStruct() if rows is None else GroundStruct(rows.shape[1], *(row.ctypes.data for row in rows))


def rate_of(modal: ModalRotor) -> float:
    """Return the largest angular speed [rad/s], or a slow mode's where the rotor does not turn."""
    return modal.parts.nominal_speed or float(np.abs(modal.values).min())


def journal_scales(modal: ModalRotor) -> Array:
    """Return what makes x, y, vx, vy of each journal dimensionless, shape (4 n_bearings,)."""
    rate = rate_of(modal)
    return np.concatenate([np.array([1.0, 1.0, 1.0 / rate, 1.0 / rate]) / c for c in modal.parts.lengths])
