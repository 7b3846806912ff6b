"""The shapes of a rotor that a range of frequencies needs, by Lanczos' method and moments of its loads."""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np
from scipy.sparse.linalg import LinearOperator, eigsh

from ...model import Array
from ...rotors.projection import mean_plane, new_shapes
from ...rotors.structure import Structure
from .banded import BandedCholesky
from .inertia_count import negative_count

SHIFT = 0.003
"""Part of the highest frequency at which static shapes are taken: a free rotor has none at 0."""

_NEW = 1e-11
"""Part of a shape, as the root of its kinetic energy, that counts: it is stiff, and what films press on."""

_FIRST_COUNT = 8


class ShapeSpace(NamedTuple):
    """Shapes of one plane.

    Attributes
    ----------
    shapes : ndarray, shape (N / 2, n)
        Of unit mass, and without mass in common: modes of the shaft on no films, then what loads add.
    cut : float
        All modes below this frequency are among them [rad/s].
    frequencies : ndarray, shape (k,)
        Of these modes, rising [rad/s].
    solid : BandedCholesky
        K + shift^2 M in one plane.
    """

    shapes: Array
    cut: float
    frequencies: Array
    solid: BandedCholesky


def shape_space(full: Structure, cut: float) -> ShapeSpace:
    """Return the modes below a frequency [rad/s], and what motion of the bearings and loads add to them.

    With F = (K + shift^2 M)^-1 a load b adds F b and F (M, P, K_xy) F b: what is left out then answers the
    forces of the films to the first order in frequency^2, gyroscopic effect and torque.

    Raises
    ------
    numpy.linalg.LinAlgError
        If K + shift^2 M is not positive, as of a shaft that buckles.
    """
    n = len(full.coordinates)
    mass, stiffness = mean_plane(full.mass), mean_plane(full.stiffness)
    shift = SHIFT * cut
    solid = BandedCholesky(stiffness + shift**2 * mass)
    frequencies, modes = _modes_below(mass, stiffness, solid, shift, cut)
    first = solid.solve(_loads(full))
    coupled = [matrix @ first for matrix in (mass, full.gyroscopic[:n, n:], full.stiffness[:n, n:])]
    answers = np.hstack([first, solid.solve(np.hstack(coupled))])
    return ShapeSpace(np.hstack([modes, new_shapes(answers, modes, mass, _NEW)]), cut, frequencies, solid)


def _loads(full: Structure) -> Array:
    """Return what acts on the rotor in one plane, and the displacements that are asked for, as loads."""
    n = len(full.coordinates)
    housings = np.eye(n)[list(full.supports)]
    both = [full.journals[:, :n], full.journals[:, n:], housings]
    both += [full.weight.reshape(2, n), full.unbalance[:n].T, full.unbalance[n:].T]
    both += [readout.row[: 2 * n].reshape(2, n) for readout in full.readouts]
    both += [] if full.tilts is None else [full.tilts[:, :n], full.tilts[:, n:]]
    rows = np.vstack(both)
    return np.asarray(rows[np.any(rows, axis=1)].T)


def _modes_below(
    mass: Any, stiffness: Any, solid: BandedCholesky, shift: float, cut: float
) -> tuple[Array, Array]:
    """Return frequencies and shapes, of unit mass, of the modes below a frequency, with no bearings."""
    n = mass.shape[0]
    inverse = LinearOperator((n, n), matvec=solid.solve, dtype=float)
    start = np.random.default_rng(0).normal(size=n)
    count = _FIRST_COUNT
    while True:
        count = min(count, n - 2)
        squares, modes = eigsh(stiffness, count, mass, sigma=-(shift**2), which="LM", OPinv=inverse, v0=start)
        rising = [k for k in np.argsort(squares) if squares[k] <= cut**2]
        # Lanczos' method may miss one: the law of inertia tells how many there are.
        if (count > len(rising) == negative_count(stiffness, cut**2, mass)) or count == n - 2:
            return np.sqrt(np.maximum(squares[rising], 0.0)), modes[:, rising]
        count *= 2
