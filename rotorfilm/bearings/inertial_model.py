"""The Model of a static reaction that may have an added mass: forces, and then the mass."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Protocol

import numpy as np
from numpy.typing import ArrayLike

from ..model import Array, Linearization, static_linearization
from ..results import Coefficients
from ..signals import MASS_OUTPUTS, Signal, force_outputs
from .reaction import StaticReaction, input_vector

_ROWS, _COLUMNS = [0, 0, 1], [0, 1, 1]


@dataclass(frozen=True, kw_only=True)
class InertialCoefficients(Coefficients):
    """K, C and the added mass M of a film whose oil has inertia: F = -K q - C v - M a for small motion.

    Attributes
    ----------
    mass : ndarray, shape (2, 2) [kg]
        Rows: force x, y; columns: acceleration along x, y.
    """

    mass: Array


def added_mass(film: Coefficients) -> Array:
    """Return the added mass of a film [kg], in the shape of its K and C: zeros where those are all."""
    return film.mass if isinstance(film, InertialCoefficients) else np.zeros_like(film.stiffness)


class _Heavy(Protocol):
    @property
    def nominal_force(self) -> float: ...

    @property
    def has_inertia(self) -> bool: ...

    def force(self, position: ArrayLike, velocity: ArrayLike, speed: ArrayLike) -> Array: ...

    def jacobian(self, position: ArrayLike, velocity: ArrayLike, speed: ArrayLike) -> Array: ...

    def mass(self, position: ArrayLike, velocity: ArrayLike, speed: ArrayLike) -> Array: ...

    def mass_slopes(self, position: ArrayLike, velocity: ArrayLike, speed: ArrayLike) -> Array: ...


class InertialModel(StaticReaction):
    """A StaticReaction with `has_inertia`, `mass` and `mass_slopes`: see `InertialReaction`."""

    @property
    def outputs(self: _Heavy) -> tuple[Signal, ...]:
        """Signals force_x, force_y: the force on the journal without that of its acceleration; the mass."""
        forces = force_outputs(self.nominal_force)
        if not self.has_inertia:
            return forces
        nominal = float(self.mass(np.zeros(2), np.array([1.0, 0.0]), 0.0)[0, 0])
        text = "added mass of the film, whose force on the journal is minus this times the acceleration"
        return (
            *forces,
            *(Signal(name=name, unit="kg", nominal=nominal, description=text) for name in MASS_OUTPUTS),
        )

    def force_along(
        self: _Heavy, position: Array, velocity: Array, acceleration: Array, speed: ArrayLike = 0.0
    ) -> Array:
        """Return the force in a motion, that of the added mass included, shape (2, n) [N].

        Parameters
        ----------
        position, velocity, acceleration : ndarray, shape (2, n) [m], [m/s], [m/s2]
        speed : array_like, shape () or (n,) [rad/s]
            Angular speed about +z.
        """
        force = self.force(position, velocity, speed)
        if not self.has_inertia:
            return force
        return force - np.einsum("ij...,j...->i...", self.mass(position, velocity, speed), acceleration)

    def output(self: _Heavy, t: float, x: ArrayLike, u: ArrayLike) -> Array:
        """Return force_x, force_y [N], and with inertia the mass [kg], for u = (x, y, vx, vy, speed)."""
        values = input_vector(u)
        force = self.force(values[:2], values[2:4], values[4])
        if not self.has_inertia:
            return force
        return np.concatenate([force, self.mass(values[:2], values[2:4], values[4])[_ROWS, _COLUMNS]])

    def linearization(self: _Heavy, t: float, x: ArrayLike, u: ArrayLike) -> Linearization:
        """Return the exact derivatives at u: all of them in the feedthrough matrix D."""
        values = input_vector(u)
        D = self.jacobian(values[:2], values[2:4], values[4])
        if self.has_inertia:
            mass = self.mass_slopes(values[:2], values[2:4], values[4])[_ROWS, _COLUMNS]
            D = np.vstack([D, mass])
        return static_linearization(D)
