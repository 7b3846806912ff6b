"""The synchronous orbit of a rigid rotor on a bearing with states of its own, as the tilts of pads.

At n samples of a turn the series of n - 1 harmonics and less stands for position q and states x, and obeys

    m q'' = F(x, q, q') + load + unbalance,   x' = f(x, q, q'),

by Newton's method with the exact derivatives of the bearing. Its first step from the rest is the linear
orbit.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import NamedTuple, Protocol

import numpy as np

from ..core.errors import ConvergenceError, FilmContactError
from ..core.model import Array, Linearization
from ..rotors import RigidRotor
from .harmonic_balance import basis, resized

STEPS, HALVINGS, NEAR = 30, 8, 1e-9
"""Most Newton steps, most halvings of one, and the step / clearance at which they end."""


class Evaluated(Protocol):
    """A bearing at one state and input."""

    @property
    def rates(self) -> Array:
        """Of the states, shape (N,)."""

    @property
    def outputs(self) -> Array:
        """Forces first, shape (2 + ...,) [N]."""

    @property
    def slopes(self) -> Linearization | None:
        """Derivatives of both, where they were asked for."""


Bearing = Callable[..., Evaluated]
"""Takes a state (N,), an input (5,) and `slopes`."""


class StatefulTurn(NamedTuple):
    """Position and states over a turn.

    Attributes
    ----------
    places : ndarray, shape (2 + N, n) [m]
        Samples of x, y and the states.
    force : ndarray, shape (2, n) [N]
        Of the film on the journal.
    """

    places: Array
    force: Array


class TurnEquations:
    """The equations of an orbit at so many samples.

    Parameters
    ----------
    rotor : RigidRotor
    bearing : callable
        See `Bearing`.
    clearance : float [m]
        By which steps are measured.
    samples : int
        Over a turn, odd.
    """

    def __init__(self, rotor: RigidRotor, bearing: Bearing, clearance: float, samples: int) -> None:
        self.bearing, self.clearance, self.samples = bearing, clearance, samples
        series = basis(samples // 2, samples)
        self._speed, self._mass = rotor.profile.speeds[0], rotor.mass
        self._rate = self._speed * (series.slopes @ series.back)
        phase = 2.0 * np.pi * np.arange(samples) / samples + rotor.unbalance_angle
        turning = rotor.unbalance * self._speed**2 * np.stack([np.cos(phase), np.sin(phase)])
        self._given = np.array(rotor.static_force)[:, None] + turning

    def residual(self, places: Array, *, slopes: bool = False) -> tuple[Array, list[Evaluated]]:
        """Return what the equations lack, (2 + N, n), and the bearing at each sample."""
        q, x = places[:2], places[2:]
        moving = q @ self._rate.T
        inputs = np.vstack([q, moving, np.full(self.samples, self._speed)])
        found = [self.bearing(x[:, k], inputs[:, k], slopes=slopes) for k in range(self.samples)]
        force = np.stack([one.outputs[:2] for one in found], axis=1)
        rates = np.stack([one.rates for one in found], axis=1)
        return np.vstack(
            [self._mass * moving @ self._rate.T - force - self._given, x @ self._rate.T - rates]
        ), found

    def matrix(self, found: list[Evaluated]) -> Array:
        """Return the derivatives of the equations, rows and columns in the order of their samples."""
        parts = [one.slopes for one in found if one.slopes is not None]
        A, B, C, D = (
            np.stack([getattr(one, name) for one in parts], axis=-1) for name in Linearization._fields
        )
        n, N = self.samples, len(A)
        whole = np.zeros((2 + N, n, 2 + N, n))
        by_place, by_rate = (np.vstack([D[:2, k : k + 2], B[:, k : k + 2]]) for k in (0, 2))
        each = np.arange(n)
        for row in range(2 + N):
            for column in range(2):
                block = whole[row, :, column]
                block -= by_rate[row, column][:, None] * self._rate
                block[each, each] -= by_place[row, column]
            for state in range(N):
                whole[row, each, 2 + state, each] -= C[row, state] if row < 2 else A[row - 2, state]
            whole[row, :, row] += self._mass * self._rate @ self._rate if row < 2 else self._rate
        return whole.reshape((2 + N) * n, -1)

    def step(self, matrix: Array, residual: Array) -> Array:
        """Return the change of the places that takes a residual out; of pads without film the least."""
        size = np.linalg.norm(matrix, axis=1)
        found = np.linalg.lstsq(matrix / size[:, None], -residual.ravel() / size, rcond=1e-11)[0]
        return np.asarray(found.reshape(residual.shape))

    def linear(self, rest: Array) -> StatefulTurn:
        """Return the orbit about a rest (2 + N,) [m] by the slopes there."""
        places = np.repeat(rest[:, None], self.samples, axis=1)
        lacking, found = self.residual(places, slopes=True)
        moved = self.step(self.matrix(found), lacking)
        return self.turn(places + moved)

    def orbit(self, start: Array) -> StatefulTurn:
        """Return the orbit from a start (2 + N, any samples) [m].

        Raises
        ------
        ConvergenceError
            If Newton's method does not end.
        """
        places = resampled(start, self.samples)
        for _ in range(STEPS):
            lacking, found = self.residual(places, slopes=True)
            moved = self.step(self.matrix(found), lacking)
            places = self._inside(places, moved)
            if float(np.abs(moved).max()) < NEAR * self.clearance:
                return self.turn(places)
        raise ConvergenceError(f"the orbit must be found within {STEPS} steps, and was not", None)

    def _inside(self, places: Array, moved: Array) -> Array:
        """Return the places after the longest part of a step that leaves a film everywhere."""
        for halvings in range(HALVINGS):
            further = places + 0.5**halvings * moved
            try:
                self.residual(further)
            except FilmContactError:
                continue
            return further
        raise FilmContactError("journal and pads must have a film over the orbit, and touch")

    def turn(self, places: Array) -> StatefulTurn:
        """Return places with the force of the film by the balance of the rotor."""
        return StatefulTurn(places, self._mass * places[:2] @ self._rate.T @ self._rate.T - self._given)


def resampled(places: Array, samples: int) -> Array:
    """Return series at other samples of a turn, (rows, samples)."""
    old = places.shape[1]
    series = resized(places @ basis(old // 2, old).back.T, samples // 2)
    return np.asarray(series @ basis(samples // 2, samples).values.T)
