"""The reduced point contact: static law and dynamic stiffness as a small state space."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import ArrayLike

from ...errors import InputError, require_each, require_finite, require_positive
from ...inputs.si_arguments import quantities
from ...model import Array, Linearization
from ...native.spec import NativeSpec
from ...signals import Signal
from .contact_kernel import LawNumbers, contact_spec
from .operating_points import FREQUENCIES, LOADS
from .static_law import StaticLaw


@quantities
@dataclass(frozen=True, kw_only=True)
class ContactLaw:
    """Force of a lubricated point contact over the approach z of the ball, a Model with `order` states.

    F = F_s(z) - [Z(s) - Z(0)] (z - z_1): the static law, and what the dynamic stiffness at the load f = 1
    adds to it. The state space is stable and has no static part. A film does not pull: F is at least 0, and
    a ball beyond the offset of the static law no longer drives the state space. Built by `reduce_contact`,
    `reduce_ball` or `interpolate_contact`; the errors of both fits, and of an interpolation, are kept, that
    of a motion is to be asked from the full model.

    Valid for loads within `load_range` and motions up to `highest_frequency`. `linearize(law,
    OperatingPoint(x=..., u=[z]))` makes it a control.StateSpace, `BallSupport` a Reaction under a rotor.

    Parameters
    ----------
    offset, span, exponent : float [1]
        Static law f = ((offset - delta)/span)^exponent.
    operating : float [1]
        Approach delta under f = 1.
    A, B, C, D : ndarray
        State space of -[Z(s) - Z(0)], per 2 pi/3, in dimensionless time.
    static_error : float [1]
        Largest relative error of the static law, for loads from 0.2 to 3.
    damping_error : float [1]
        Largest error of Im Z/omega over the frequencies to 6, over the largest Im Z/omega.
    film_scale, time_scale, force_scale : float [m, s, N]
        Units of approach, time and force; 1 for a dimensionless law.
    """

    offset: float
    span: float
    exponent: float
    operating: float
    A: Array
    B: Array
    C: Array
    D: Array
    static_error: float
    damping_error: float
    film_scale: float = 1.0
    time_scale: float = 1.0
    force_scale: float = 1.0

    def __post_init__(self) -> None:
        require_each(self, require_positive, "span", "exponent", "film_scale", "time_scale", "force_scale")
        require_state_space(self.A, self.B, self.C, self.D)

    @property
    def order(self) -> int:
        """Number of states."""
        return len(self.A)

    @property
    def initial_state(self) -> Array:
        """Rest at any approach: the static force acts."""
        return np.zeros(self.order)

    @cached_property
    def inputs(self) -> tuple[Signal, ...]:
        """The approach."""
        text = "approach of the ball's center beyond first touch, negative in contact"
        return (Signal(name="z", unit="m", nominal=2.0 * self.film_scale, description=text),)

    @cached_property
    def outputs(self) -> tuple[Signal, ...]:
        """The force."""
        text = "force of the film on the ball, away from the plane"
        return (Signal(name="force_z", unit="N", nominal=self.force_scale, description=text),)

    @cached_property
    def states(self) -> tuple[Signal, ...]:
        """States of the dynamic part, without dimension."""
        return tuple(
            Signal(name=f"contact_{k}", unit="1", nominal=1.0, description="state of the dynamic stiffness")
            for k in range(self.order)
        )

    def output(self, t: float, x: ArrayLike, u: ArrayLike) -> Array:
        """Return (force_z,) [N] for u = (z,) [m]; t is not used."""
        delta = float(np.asarray(u)[0]) / self.film_scale
        return self.force_scale * np.maximum(self._load(delta, np.asarray(x, dtype=float)), 0.0)

    def derivative(self, t: float, x: ArrayLike, u: ArrayLike) -> Array:
        """Return dx/dt [1/s]."""
        delta = float(np.asarray(u)[0]) / self.film_scale
        return (self.A @ np.asarray(x, dtype=float) + self.B[:, 0] * self._drive(delta)) / self.time_scale

    def linearization(self, t: float, x: ArrayLike, u: ArrayLike) -> Linearization:
        """Return the exact derivatives, in SI; at a kink those of the side in contact."""
        delta = float(np.asarray(u)[0]) / self.film_scale
        near = float(delta <= self.offset)
        pressed = float(self._load(delta, np.asarray(x, dtype=float))[0] >= 0.0)
        per_length = self.force_scale / self.film_scale
        return Linearization(
            self.A / self.time_scale,
            near * self.B / (self.time_scale * self.film_scale),
            pressed * self.force_scale * self.C,
            pressed * per_length * (self._static.slope(delta) + near * self.D),
        )

    def events(self, t: float, x: ArrayLike, u: ArrayLike) -> Array:
        """Return what changes sign where the ball leaves the film, and where the force vanishes."""
        delta = float(np.asarray(u)[0]) / self.film_scale
        return np.array([(delta - self.offset) / self.span, self._load(delta, np.asarray(x, dtype=float))[0]])

    @property
    def load_range(self) -> tuple[float, float]:
        """Smallest and largest load of the static law's fit [N]."""
        return LOADS[0] * self.force_scale, LOADS[-1] * self.force_scale

    @property
    def highest_frequency(self) -> float:
        """Angular frequency to which the dynamic stiffness was fitted [rad/s]."""
        return float(FREQUENCIES[-1]) / self.time_scale

    @property
    def stiffness(self) -> float:
        """Static stiffness under the load f = 1, -dF/dz [N/m]."""
        return -self.force_scale / self.film_scale * self._static.slope(self.operating)

    @property
    def damping(self) -> float:
        """Damping of slow motions under the load f = 1, -dF/d(dz/dt) [N s/m]."""
        if not self.order:
            return 0.0
        slow = self.C @ np.linalg.solve(self.A, np.linalg.solve(self.A, self.B))
        return float(slow[0, 0]) * self.force_scale * self.time_scale / self.film_scale

    def static_force(self, z: ArrayLike) -> Array:
        """Return the force [N] of a contact that has long rested at the approaches z (...) [m]."""
        depth = np.maximum(self.offset - np.asarray(z, dtype=float) / self.film_scale, 0.0) / self.span
        return np.asarray(self.force_scale * depth**self.exponent)

    def static_slope(self, z: ArrayLike) -> Array:
        """Return its derivative by z [N/m], shape (...)."""
        depth = np.maximum(self.offset - np.asarray(z, dtype=float) / self.film_scale, 0.0) / self.span
        factor = -self.exponent / self.span * self.force_scale / self.film_scale
        return np.asarray(factor * depth ** (self.exponent - 1.0))

    def approach(self, load: ArrayLike) -> Array:
        """Return the approach z (...) [m] under static loads (...) [N], none negative."""
        share = np.asarray(load, dtype=float) / self.force_scale
        if not np.all(share >= 0.0):
            raise InputError(f"load must not be negative, got {load!r}")
        return np.asarray(self.film_scale * (self.offset - self.span * share ** (1.0 / self.exponent)))

    def native(self) -> NativeSpec:
        """Return the kernel `contact`."""
        return contact_spec(self.in_si, np.ones((1, 1)), np.ones((1, 1)), 0.0)

    @property
    def in_si(self) -> LawNumbers:
        """The numbers of the law as its kernel takes them."""
        film, time, force = self.film_scale, self.time_scale, self.force_scale
        matrices = {
            "A": self.A / time,
            "B": self.B / (time * film),
            "C": self.C * force,
            "D": self.D * force / film,
        }
        static = (self.offset * film, self.span * film, self.exponent, force, self.operating * film)
        return LawNumbers(matrices, (*static, *self.load_range), film)

    def resting(self, delta: float) -> Array:
        """Return the state in which the contact has long rested at an approach delta [1]."""
        if not self.order:
            return np.zeros(0)
        return np.asarray(-np.linalg.solve(self.A, self.B[:, 0]) * self._drive(delta), dtype=float)

    def _drive(self, delta: float) -> float:
        """Return what drives the state space: a ball that has left does so no longer."""
        return min(delta, self.offset) - self.operating

    def _load(self, delta: float, x: Array) -> Array:
        return self._static.load(delta) + self.C @ x + self.D[:, 0] * self._drive(delta)

    @property
    def _static(self) -> StaticLaw:
        return StaticLaw(self.offset, self.span, self.exponent, self.static_error)


def transfer(system: Linearization, s: np.ndarray) -> np.ndarray:
    """Return C (s - A)^-1 B + D of a system with one input and output, shape (n,)."""
    A, B, C, D = system
    return np.array([(C @ np.linalg.solve(v * np.eye(len(A)) - A, B.astype(complex)) + D)[0, 0] for v in s])


def require_state_space(A: Array, B: Array, C: Array, D: Array) -> None:
    """Raise InputError unless the matrices are of a stable system of one input and one output."""
    size = len(require_finite("A", A))
    wanted = {"A": (A, (size, size)), "B": (B, (size, 1)), "C": (C, (1, size)), "D": (D, (1, 1))}
    for name, (matrix, shape) in wanted.items():
        if np.shape(matrix) != shape:
            raise InputError(f"{name} must have shape {shape}, got {np.shape(matrix)}")
    if size and np.linalg.eigvals(A).real.max() >= 0.0:
        raise InputError(f"A must be stable, got eigenvalues {np.linalg.eigvals(A)}")
