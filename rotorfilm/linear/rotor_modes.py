"""Whirl modes of a flexible rotor: frequency, damping, direction, and how they go with speed."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass
from typing import ClassVar

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ..errors import InputError, require_finite
from ..inputs.kinds import arguments
from ..model import Array, Reaction
from ..readable.result import Readable
from ..rotors import FlexibleRotor
from ..rotors.structure import Structure
from .rotor_rest import rotor_equilibrium
from .rotor_system import SecondOrder, second_order, with_hysteresis

_OSCILLATES = 1e-6

_HELD = 1e-12
"""Stiffness force / the forces that cancel in it, below which nothing holds a shape."""


class Whirls:
    """What eigenvalues say of whirl."""

    eigenvalues: NDArray[np.complex128]

    _shown: ClassVar[tuple[str, ...]] = ("frequency", "log_decrement")

    @property
    def frequency(self) -> Array:
        """Damped frequency [rad/s], in the shape of the eigenvalues."""
        return self.eigenvalues.imag

    @property
    def log_decrement(self) -> Array:
        """Logarithm of the ratio of two successive amplitudes [1]: negative where the whirl grows."""
        return log_decrement(self.eigenvalues)


@dataclass(frozen=True, kw_only=True)
class RotorModes(Whirls, Readable):
    """The oscillating modes of a rotor at a speed, by rising frequency.

    Attributes
    ----------
    speed : float [rad/s]
    eigenvalues : ndarray, shape (n,) [1/s]
        Those with a positive imaginary part, which is the damped frequency.
    shapes : ndarray, shape (N, n)
        Complex coordinates of the rotor.
    direction : ndarray, shape (n,) [1]
        From 1, whirl in circles with the rotation, to -1, in circles against it.
    """

    speed: float
    eigenvalues: NDArray[np.complex128]
    shapes: NDArray[np.complex128]
    direction: Array


def log_decrement(eigenvalues: ArrayLike) -> Array:
    """Return -2 pi Re / |Im| of eigenvalues [1]."""
    values = np.asarray(eigenvalues)
    return np.asarray(-2.0 * np.pi * values.real / np.abs(values.imag))


@arguments
def rotor_modes(rotor: FlexibleRotor, bearings: Mapping[str, Reaction], speed: float) -> RotorModes:
    """Return the whirl modes of a rotor on its films at a speed.

    Motion that nothing holds, as that of a weightless rotor without bearings as a whole, is no whirl.

    Parameters
    ----------
    rotor : FlexibleRotor
        Its own speed is not used.
    bearings : mapping of str to Reaction
        By the name of the station; linearized at the equilibrium of this speed.
    speed : float [rad/s]
        Of either sign; a rotor at rest counts as turning about +z.

    Raises
    ------
    EquilibriumError
        If there is no equilibrium.
    """
    motions = motions_at(rotor, bearings, speed)
    whirls = oscillates(motions.eigenvalues)
    return RotorModes(
        speed=motions.speed,
        eigenvalues=motions.eigenvalues[whirls],
        shapes=motions.shapes[:, whirls],
        direction=motions.direction[whirls],
    )


def motions_at(rotor: FlexibleRotor, bearings: Mapping[str, Reaction], speed: float) -> RotorModes:
    """Return the whirl modes at a speed, and before them the motions that do not oscillate."""
    at = rotor_equilibrium(rotor, bearings, speed)
    structure = rotor.structure
    values, shapes = _whirls(structure, second_order(structure, at), at.speed)
    n = len(structure.coordinates)
    mass = structure.mass[:n, :n]
    turned = [shapes[:n] + sign * 1j * shapes[n:] for sign in (1.0, -1.0)]
    forward, backward = (np.einsum("ik,ij,jk->k", u.conj(), mass, u).real for u in turned)
    sense = -1.0 if at.speed < 0.0 else 1.0
    return RotorModes(
        speed=at.speed,
        eigenvalues=values,
        shapes=shapes,
        direction=sense * (forward - backward) / (forward + backward),
    )


def oscillates(values: NDArray[np.complex128]) -> NDArray[np.bool_]:
    """Return which eigenvalues are those of whirl."""
    return np.asarray(values.imag > _OSCILLATES * np.abs(values))


def _whirls(
    structure: Structure, system: SecondOrder, speed: float
) -> tuple[NDArray[np.complex128], NDArray[np.complex128]]:
    """Return the eigenvalues that do not oscillate, those that do, rising, and the shapes of all."""
    if structure.hysteresis is None:
        return _eigen(system, 0.0, math.inf)
    turn = abs(speed)
    slow = _eigen(with_hysteresis(structure, system, 0.5 * turn, speed), 0.0, turn)
    fast = _eigen(with_hysteresis(structure, system, 2.0 * turn + 1.0, speed), turn, math.inf)
    return np.concatenate([slow[0], fast[0]]), np.hstack([slow[1], fast[1]])


def _eigen(
    system: SecondOrder, low: float, high: float
) -> tuple[NDArray[np.complex128], NDArray[np.complex128]]:
    """Return eigenvalues of low <= Im s < high, rising, and shapes; not of motion that nothing holds."""
    values, vectors = np.linalg.eig(system.state_matrix())
    shapes = vectors[: len(system.mass)]
    size = np.abs(values)
    inertia, damping = (np.linalg.norm(m @ shapes, axis=0) for m in (system.mass, system.damping))
    held = np.linalg.norm(np.abs(system.stiffness) @ np.abs(shapes), axis=0)
    moves = size * (size * inertia + damping) > _HELD * held
    chosen = moves & (values.imag >= low) & (values.imag < high)
    order = np.flatnonzero(chosen)[np.argsort(values.imag[chosen])]
    return values[order].astype(complex), shapes[:, order].astype(complex)


def speeds_in_turn(speeds: ArrayLike) -> Array:
    """Return angular speeds [rad/s]; raise InputError unless they rise or fall throughout."""
    grid = require_finite("speeds", speeds)
    steps = np.diff(grid) if grid.ndim == 1 else np.zeros(1)
    if not grid.size or not (np.all(steps > 0.0) or np.all(steps < 0.0)):
        raise InputError(f"speeds must be a list of rising or of falling numbers, got {speeds!r}")
    return grid
