"""The driver of the compiled integration: scheme, tables, what ends a run."""

from __future__ import annotations

from collections import Counter
from functools import lru_cache

import numpy as np
from scipy.special import roots_jacobi

from ...errors import ContactError, ConvergenceError, warn_user
from ...model import Array
from ...rotors import SpeedProfile
from . import rotor_kernels as kernels
from .modal import Complex, ModalRotor
from .step_tables import LEVELS, SLOTS

STAGES = 4
"""Collocation nodes of a step: order 7."""

BUDGET = 20000
"""Steps between two looks at the interpreter, where a user may interrupt."""

SHORTEST = 1e-13
"""Shortest step, relative to the duration, before a run is given up."""

NEWTON = 0.01
"""Error left by Newton's method, in local errors."""

_COUNTERS = ("film_evaluations", "jacobians", "steps", "rejected")


@lru_cache(maxsize=8)
def radau_scheme(stages: int) -> tuple[Array, Array, Array]:
    """Return the nodes of Radau's right rule and polynomials on them, coefficients by rising power.

    Returns
    -------
    nodes : ndarray, shape (s,)
    lagrange : ndarray, shape (s, s)
    remainder : ndarray, shape (1, s + 1)
        The polynomial that vanishes at the nodes and is 1 at the start.
    """
    # The inner nodes are the zeros of Jacobi's polynomial of weight 1 - x on [0, 1].
    inner = 0.5 * (1.0 + roots_jacobi(stages - 1, 1.0, 0.0)[0])
    nodes = np.append(inner, 1.0)
    lagrange = np.linalg.inv(np.vander(nodes, increasing=True)).T
    remainder = np.polynomial.polynomial.polyfromroots(nodes)
    return nodes, np.ascontiguousarray(lagrange), (remainder / remainder[0])[None]


def profile_rows(profile: SpeedProfile) -> tuple[Array, Array, Array, Array]:
    """Return times, speeds, slopes after them and angles turned since t = 0."""
    times = np.array(profile.times, dtype=float)
    slopes = np.array([profile.acceleration(t) for t in profile.times])
    angles = np.array([profile.angle(t) for t in profile.times])
    return times, np.array(profile.speeds, dtype=float), slopes, angles


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
    stages : int
        Collocation nodes.

    Attributes
    ----------
    work : Counter
        Film_evaluations, jacobians, steps, rejected.
    """

    def __init__(
        self,
        *,
        modal: ModalRotor,
        state: Complex,
        rtol: float,
        longest: float,
        duration: float,
        stages: int = STAGES,
    ) -> None:
        self.modal, self.state, self.work = modal, state, Counter[str]()
        self._rtol, self._longest, self._duration = rtol, longest, duration
        self._rotor = rotor_arrays(modal)
        self._scheme = radau_scheme(stages)
        self._tables = new_tables(self._rotor, stages)
        self._films = np.array([(call.address, call.data) for call in modal.calls], dtype=np.intp)
        self._supports = (modal.journal_rest, modal.spring, modal.damper, modal.parts.lengths)
        self._profile = profile_rows(modal.parts.profile)
        self._scales = journal_scales(modal)
        self._newton = max(NEWTON * rtol, 1e-12)
        self._counts = np.zeros(5, dtype=np.int64)
        # A first step that the error control need not believe in: a hundredth of a turn or less.
        first = 0.01 * 2.0 * np.pi / max(rate_of(modal), 1.0 / duration)
        self._clock = np.array([0.0, np.ceil(4.0 * np.log2(max(1.0, longest / first))), 0.0])

    @property
    def time(self) -> float:
        """How far the run is [s]."""
        return float(self._clock[0])

    def to(self, stop: float, grid: Array) -> Complex:
        """Integrate to a time and return the modal coordinates at the times of `grid` after the last stop.

        Raises
        ------
        ContactError, ConvergenceError
            With the modal coordinates until then as partial result.
        """
        self._clock[2] = 0.0
        out = np.empty((len(grid), len(self.state)), dtype=complex)
        options = (self._longest, self._rtol, SHORTEST * self._duration, BUDGET, self._newton)
        reason = kernels.BUSY
        while reason == kernels.BUSY:
            reason = kernels.march(
                self.state,
                self._clock,
                stop,
                self._rotor,
                self._scheme,
                self._tables,
                self._films,
                self._supports,
                self._profile,
                self._scales,
                options,
                grid,
                out,
                self._counts,
            )
        for name, count in zip(_COUNTERS, self._counts, strict=False):
            self.work[name] = int(count)
        if reason != kernels.DONE:
            raise self._failure(reason, out[: int(self._clock[2])])
        return out

    def warn(self) -> None:
        """Warn if a film was asked beyond its map."""
        if self._counts[4]:
            how = " or ".join(dict.fromkeys(c.beyond for c in self.modal.calls if c.beyond))
            warn_user(f"a journal went beyond the map of its film; its force is {how}")

    def _failure(self, reason: int, kept: Complex) -> ContactError | ConvergenceError:
        at = f"at t = {self.time:.9g} s"
        if reason == kernels.WALL:
            return ContactError(f"journal reached the wall {at}", kept)
        if reason == kernels.BROKEN:
            return ConvergenceError(
                f"film force must be finite and the forces of a step solvable, {at}", kept
            )
        return ConvergenceError(f"integration needs steps below {SHORTEST:g} of the duration {at}", kept)


def rotor_arrays(modal: ModalRotor) -> tuple[Complex, Complex, Complex]:
    """Return values, push and sense as the kernels want them."""
    return (
        np.ascontiguousarray(modal.values),
        np.ascontiguousarray(modal.push),
        np.ascontiguousarray(modal.sense),
    )


def rate_of(modal: ModalRotor) -> float:
    """Return the largest angular speed [rad/s], or a slow mode's where the rotor does not turn."""
    speed = max(abs(value) for value in modal.parts.profile.speeds)
    return float(speed or np.abs(modal.values).min())


def journal_scales(modal: ModalRotor) -> Array:
    """Return what makes x, y, vx, vy of each journal dimensionless, shape (4 n_bearings,)."""
    rate = rate_of(modal)
    return np.concatenate([np.array([1.0, 1.0, 1.0 / rate, 1.0 / rate]) / c for c in modal.parts.lengths])


def new_tables(rotor: tuple[Complex, Complex, Complex], stages: int) -> tuple[Array, ...]:
    """Return unfilled tables of steps; the last slot is for steps that happen once.

    They are the slot of each level, the level in each slot, the slot to be filled next; and per slot the
    motion of the journals at the nodes per modal coordinate (real, imaginary), per force at each node, per
    gap of the force at the start; and the modal coordinates at the end, per themselves and per force.
    """
    modes, channels = rotor[1].shape
    rows, slots = len(rotor[2]), SLOTS + 1
    return (
        np.full(LEVELS, -1, dtype=np.int64),
        np.full(slots, -1, dtype=np.int64),
        np.zeros(1, dtype=np.int64),
        np.empty((slots, stages * rows, 2 * modes)),
        np.empty((slots, stages, stages, rows, channels)),
        np.empty((slots, stages, rows, channels)),
        np.empty((slots, modes), dtype=complex),
        np.empty((slots, 2 * modes, stages * channels)),
    )
