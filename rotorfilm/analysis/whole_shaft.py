"""All coordinates of a shaft whose periodic orbit was found in few of its shapes: what these leave out."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np
from scipy import sparse

from ..core.model import Array
from ..rotors.structure import Structure, freedom_rows
from .compiled_rotor import Complex
from .harmonic_balance import apply, at_start, basis, constant, with_wave
from .modal_reduction import MARGIN, BandedMotion, Condensed

ROUND_OFF = 1e-6
"""Part of the damping of a bearing, over an orbit, below which it does not count."""

MANY, FAR = 48, 1e3
"""Frequencies at which bearings are looked at, and how far above their own ones the last is."""


@dataclass(frozen=True, eq=False)
class WholeShaft:
    """A shaft on springs and dampers at its journals, under forces along x and y at these.

    Attributes
    ----------
    model : Condensed
        The shapes, and all of the shaft.
    names : tuple of str
        Stations of the journals.
    spring, damper : ndarray, shape (2 n_bearings,) [N/m], [N s/m]
        What it rests on, and the forces give back.
    speed : float [rad/s]
    unbalanced : float [1]
        Part of the unbalance.
    """

    model: Condensed
    names: tuple[str, ...]
    spring: Array
    damper: Array
    speed: float
    unbalanced: float = 1.0

    @property
    def whole(self) -> Structure:
        """All of the shaft."""
        return self.model.whole

    @property
    def known_to(self) -> float:
        """Frequency of modes up to which multipliers in the shapes are known [rad/s]."""
        assert self.model.space is not None
        return self.model.space.cut / MARGIN**2

    @cached_property
    def rows(self) -> Array:
        """Displacement of the journals, shape (2 n_bearings, N)."""
        return np.concatenate([freedom_rows(self.whole, name) for name in self.names])

    @cached_property
    def motion(self) -> BandedMotion:
        """Its small motion."""
        s, rows, speed = self.whole, sparse.csr_array(self.rows), self.speed
        spring, damper = (rows.T @ sparse.diags_array(part) @ rows for part in (self.spring, self.damper))
        damping = sparse.csr_array(s.damping) + speed * sparse.csr_array(s.gyroscopic) + damper
        stiffness = sparse.csr_array(s.stiffness) + speed * sparse.csr_array(s.circulation) + spring
        return BandedMotion(sparse.csr_array(s.mass), damping, stiffness)

    def missing(self, series: Array, force: Array, frequency: float, periods: int) -> Array:
        """Return by how much the series of x and y of an orbit are not those under its forces [m].

        Parameters
        ----------
        series, force : ndarray, shape (2 n_bearings, 2 H + 1) [m], [N]
            Series of the journals, and of the forces of films, springs and dampers on them.
        frequency : float [rad/s]
        periods : int
        """
        harmonics, rows = series.shape[1] // 2, self.rows
        answers = [rows @ self.motion.solve(1j * k * frequency, rows.T) for k in range(harmonics + 1)]
        own = constant((rows @ self.motion.solve(0.0, self.whole.weight[:, None])).real[:, 0], harmonics)
        if periods:
            moved = rows @ self.motion.solve(1j * periods * frequency, self._turning[:, None])
            own = with_wave(own[:, 0], moved[:, 0], harmonics, periods)
        return np.asarray(series - apply(np.array(answers), force) - own)

    @property
    def _turning(self) -> Complex:
        """The force of the unbalance, shape (N,): it is the real part of this exp(i |speed| t)."""
        pair = np.array([1.0, -1.0j * np.sign(self.speed)])
        return np.asarray(self.unbalanced * self.speed**2 * self.whole.unbalance @ pair)

    def state(
        self, series: Array, frequency: float, periods: int, forces: Callable[[Array, Array], Array]
    ) -> Array:
        """Return the state (2 N,) at phase 0 of an orbit, whose forces are a function of rows and rates."""

        def answer(k: int, force: Complex) -> Array:
            beside = 0.0 if k and k != periods else self._turning if k else self.whole.weight
            pole = 1j * k * frequency
            moved = self.motion.solve(pole, (self.rows.T @ force + beside)[:, None])[:, 0]
            return np.concatenate([moved, pole * moved]).real

        return np.asarray(at_start(series, frequency, forces, answer))


class InShapes:
    """What a rotor in few shapes of its shaft leaves out of a periodic orbit.

    It needs `lengths`, `journal_series`, and `shaft`, which is None where all of it moves. `shaft_forces` has
    the forces of films and of the springs of the shaft at places and rates. `fast_films` has Z of the mean
    slopes of the films over the frequency, shape (n_bearings, 2, 2), and its poles.
    """

    def neglected(self: Any, balance: Any, series: Array, frequency: float) -> float:
        """Return the imbalance of an orbit by the shapes that were left out, in clearances.

        It is infinite where a bearing may drive motions faster than those whose multipliers are known.
        """
        shaft = self.shaft
        if shaft is None:
            return 0.0
        at = basis(series.shape[1] // 2, 2 * series.shape[1] + 6)
        stiffness_at, poles = self.fast_films(series @ at.values.T, frequency * (series @ at.slopes.T))
        if any(may_add_energy(stiffness_at(w), w) for w in frequencies_above(shaft.known_to, poles)):
            return math.inf
        at = balance.basis
        force = self.shaft_forces(series @ at.values.T, frequency * (series @ at.slopes.T)) @ at.back.T
        journals = self.journal_series(series).reshape(-1, series.shape[1])
        missing = shaft.missing(journals, force, frequency, balance.periods)
        away = float(np.abs(missing / np.repeat(self.lengths, 2)[:, None]).max())
        return away if math.isfinite(away) else math.inf

    @property
    def known_to(self: Any) -> float:
        """Frequency of modes up to which multipliers are known [rad/s]."""
        return math.inf if self.shaft is None else float(self.shaft.known_to)


def frequencies_above(lowest: float, poles: Complex) -> Array:
    """Return frequencies from the lowest on, close around poles [1/s] and to far above all of them."""
    fast = poles[np.abs(poles.imag) > 0.5 * lowest]
    near = (np.abs(fast.imag)[:, None] + np.abs(fast.real)[:, None] * np.linspace(-2.0, 2.0, 9)).ravel()
    top = FAR * max(lowest, np.abs(poles).max(initial=0.0))
    found = np.concatenate([np.geomspace(lowest, top, MANY), near])
    return found[found >= lowest]


def may_add_energy(stiffness: Complex, frequency: float) -> bool:
    """Return whether bearings may feed motion of a frequency.

    A bearing with the force Z u at u exp(i w t) takes the power w^2 u* H u / 2. H is the Hermitian part of
    i Z/w: (C + C^T) / 2 - i (K - K^T) / (2 w) of springs K and dampers C.

    Parameters
    ----------
    stiffness : ndarray of complex, shape (n_bearings, 2, 2) [N/m]
        Z of each bearing.
    frequency : float [rad/s]
    """
    part = 1j * stiffness / frequency
    taken = np.linalg.eigvalsh(0.5 * (part + part.conj().swapaxes(1, 2)))
    return bool(np.any(taken[:, 0] < -ROUND_OFF * np.abs(taken).max(axis=1)))


def slow_multipliers(
    matrix: Array, scale: Array, values: Complex, shapes: Complex, inverse: Complex, known_to: float
) -> Complex:
    """Return the Floquet multipliers, the largest first, of motion in modes up to a frequency [rad/s].

    Parameters
    ----------
    matrix : ndarray, shape (Z, Z)
        Monodromy matrix.
    scale : ndarray, shape (Z,)
        Sizes of the states.
    values, shapes, inverse : ndarray of complex
        Modes: their exponents, states, and back.
    known_to : float [rad/s]
    """
    found, vectors = np.linalg.eig(matrix * scale / scale[:, None])
    motion, sizes = scale[:, None] * vectors, np.linalg.norm(shapes / scale[:, None], axis=0)
    shares = np.abs(inverse @ motion) + np.abs(inverse.conj() @ motion)
    leading = (sizes[:, None] * shares).argmax(axis=0)
    found = found[np.abs(values)[leading] <= known_to]
    return found[np.argsort(-np.abs(found))]
