"""The reduced point contact: static law and dynamic stiffness as a small state space."""

from __future__ import annotations

import hashlib
import io
from collections.abc import Iterator
from dataclasses import dataclass, replace
from functools import cached_property
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import ArrayLike
from scipy.linalg import block_diag
from scipy.optimize import minimize_scalar

from ...core.errors import FileWarning, InputError, require_each, require_finite, require_positive, warn_user
from ...core.inputs import quantities
from ...core.model import Array, Linearization
from ...core.signals import Signal, signals_of
from ...core.sources import source_digest
from ...native.spec import NativeParameter, NativeSpec
from ..films.map_table import cache_folder, cached, read_kept
from .contact_grid import checkerboard
from .film_equations import BarusViscosity, ContactEquations, DowsonHigginsonDensity, RoelandsViscosity
from .film_newton import Contact
from .stationary import SmallMotion, follow, stationary

FORCE_TEXT = "force of the film on the ball, away from the plane"


@quantities
@dataclass(frozen=True, kw_only=True)
class ContactLaw:
    """Force of a lubricated point contact over the approach z of the ball, a Model with `order` states.

    F = F_s(z) - [Z(s) - Z(0)] (z - z_1): the static law plus the dynamic stiffness at the load f = 1. The
    state space is stable and has no static part. A film does not pull: F is at least 0, and a ball beyond the
    offset of the static law no longer drives the state space. `reduce_contact`, `reduce_ball` and
    `interpolate_contact` build this law. It keeps the errors of both fits and of an interpolation. The error
    for a given motion can only be found with the full model.

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
        """Number of states of the law."""
        return len(self.A)

    @property
    def initial_state(self) -> Array:
        """The state at rest, in which only the static force acts, at any approach."""
        return np.zeros(self.order)

    @cached_property
    def inputs(self) -> tuple[Signal, ...]:
        """The approach."""
        text = "approach of the ball's center beyond first touch, negative in contact"
        return signals_of(("z", "m", 2.0 * self.film_scale, text))

    @cached_property
    def outputs(self) -> tuple[Signal, ...]:
        """The force."""
        return signals_of(("force_z", "N", self.force_scale, FORCE_TEXT))

    @cached_property
    def states(self) -> tuple[Signal, ...]:
        """States of the dynamic part, without dimension."""
        text = "state of the dynamic stiffness"
        return signals_of(*((f"contact_{k}", "1", 1.0, text) for k in range(self.order)))

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
            pressed * per_length * (self._static_slope(delta) + near * self.D),
        )

    def events(self, t: float, x: ArrayLike, u: ArrayLike) -> Array:
        """Return the switching functions: the ball leaves the film, or the force vanishes."""
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
        return -self.force_scale / self.film_scale * self._static_slope(self.operating)

    @property
    def damping(self) -> float:
        """Damping of slow motions under the load f = 1, -dF/d(dz/dt) [N s/m]."""
        if not self.order:
            return 0.0
        slow = self.C @ np.linalg.solve(self.A, np.linalg.solve(self.A, self.B))
        return float(slow[0, 0]) * self.force_scale * self.time_scale / self.film_scale

    def static_force(self, z: ArrayLike) -> Array:
        """Return the static force [N] of the contact at the approaches z (...) [m]."""
        depth = np.maximum(self.offset - np.asarray(z, dtype=float) / self.film_scale, 0.0) / self.span
        return np.asarray(self.force_scale * depth**self.exponent)

    def static_slope(self, z: ArrayLike) -> Array:
        """Return the derivative of the static force by z [N/m], shape (...)."""
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
        return contact_spec(self, np.ones((1, 1)), np.ones((1, 1)), 0.0)

    def resting(self, delta: float) -> Array:
        """Return the steady state of the contact at an approach delta [1]."""
        if not self.order:
            return np.zeros(0)
        return np.asarray(-np.linalg.solve(self.A, self.B[:, 0]) * self._drive(delta), dtype=float)

    def _drive(self, delta: float) -> float:
        """Return what drives the state space: a ball that has left does so no longer."""
        return min(delta, self.offset) - self.operating

    def _load(self, delta: float, x: Array) -> Array:
        static = float(max(self.offset - delta, 0.0) / self.span) ** self.exponent
        return static + self.C @ x + self.D[:, 0] * self._drive(delta)

    def _static_slope(self, delta: float) -> float:
        depth = max(self.offset - delta, 0.0) / self.span
        return float(-self.exponent / self.span * depth ** (self.exponent - 1.0))


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


# The load of a stationary contact over its approach, as a power law.


def fit_static_law(delta: Array, load: Array) -> tuple[float, float, float, float]:
    """Return offset, span, exponent and largest relative error of the law through stationary contacts.

    f = ((offset - delta)/span)^exponent in Hertzian loads, of approaches (n,) and loads (n,), n >= 4; the dry
    contact has 0, 2 and 3/2.
    """
    highest = float(np.max(delta))

    def fitted(lead: float) -> tuple[Array, Array]:
        rows = np.stack([np.log(highest + lead - delta), np.ones(len(delta))], axis=1)
        solution = np.linalg.lstsq(rows, np.log(load), rcond=None)[0]
        return solution, rows @ solution - np.log(load)

    lead = np.exp(minimize_scalar(lambda x: float(np.sum(fitted(np.exp(x))[1] ** 2)), bounds=(-7.0, 2.0)).x)
    (exponent, shift), missed = fitted(float(lead))
    return (
        highest + float(lead),
        float(np.exp(-shift / exponent)),
        float(exponent),
        float(np.max(abs(np.expm1(missed)))),
    )


# What the C library is told of contacts under their reduced law.


MOST_CONTACTS = 64
"""Contacts that the kernel takes (`native/kernels/kernel_contact.c`)."""


def contact_spec(law: ContactLaw, motion: Array, push: Array, gap: float) -> NativeSpec:
    """Return the kernel `contact` for contacts of one law.

    Parameters
    ----------
    law : ContactLaw
    motion : ndarray, shape (n_contacts, n_inputs)
        Approach of each contact per input.
    push : ndarray, shape (n_outputs, n_contacts)
        Output per force of each contact.
    gap : float [m]
        Approach of every contact where all inputs vanish.
    """
    film, time, force = law.film_scale, law.time_scale, law.force_scale
    matrices = {
        "A": law.A / time,
        "B": law.B / (time * film),
        "C": law.C * force,
        "D": law.D * force / film,
    }
    static = (law.offset * film, law.span * film, law.exponent, force, law.operating * film, *law.load_range)
    tables = {name: block_diag(*[matrix] * len(motion)) for name, matrix in matrices.items()}
    place = NativeParameter(
        name="gap",
        unit="m",
        value=float(gap),
        tunable=True,
        nominal=2.0 * film,
        description="approach of the contact where the displacement vanishes",
    )
    return NativeSpec(
        kernel="contact",
        parameters=(place,),
        tables={**tables, "motion": motion, "push": push, "law": np.array(static)},
    )


# Operating points of a contact: what its reduced law is made of, computed once and kept on disk.
#
# A contact under another load is one under the unit load with other V and Q0 and other Hertzian
# units, so an operating point (V, Q0, load) is kept as the (V, Q0) that it has in its own units.


LOADS = (0.2, 0.35, 0.6, 1.0, 1.5, 2.2, 3.0)
"""Loads f of the stationary contacts of a point."""

FREQUENCIES = np.geomspace(0.05, 6.0, 32)
"""Angular frequencies of its dynamic stiffness."""

SLOW = 1e-6
"""Frequency that stands for 0, where the linearized equations have their static stiffness."""

_FIELDS = ("V", "Q0", "delta", "central_film", "stiffness", "checkerboard")


class ContactPoint(NamedTuple):
    """Stationary contacts about an operating point, and the dynamic stiffness there.

    Attributes
    ----------
    V, Q0 : float [1]
    delta, central_film : ndarray, shape (7,) [1]
        Approach and central film thickness under the loads `LOADS`.
    stiffness : ndarray of complex, shape (33,) [1]
        Z = -d(integral of p)/d(delta) under the unit load, first at rest, then at `FREQUENCIES`.
    checkerboard : float [1]
        Share of the pressure that alternates from cell to cell under the unit load.
    """

    V: float
    Q0: float
    delta: Array
    central_film: Array
    stiffness: np.ndarray
    checkerboard: float


def under_load(equations: ContactEquations, load: float) -> ContactEquations:
    """Return the equations, on the same grid, in the Hertzian units of `load` times their unit load.

    Hertzian radius and pressure grow with the cube root of the load: V = 24 mu0 u R^2/(p_H a^3) falls with
    its power 4/3, Q0 and the pressure ratios of the lubricant grow with its cube root.
    """
    growth = load ** (1.0 / 3.0)
    viscosity, density = equations.viscosity, equations.density
    if isinstance(viscosity, RoelandsViscosity):
        viscosity = replace(viscosity, pressure_ratio=growth * viscosity.pressure_ratio)
    if isinstance(density, DowsonHigginsonDensity):
        density = replace(density, pressure_ratio=growth * density.pressure_ratio)
    return replace(
        equations, V=equations.V / growth**4, Q0=equations.Q0 * growth, viscosity=viscosity, density=density
    )


def operating_point(equations: ContactEquations) -> ContactPoint:
    """Return the point of some equations under the unit load; from disk if it was computed before.

    Seven stationary and 33 dense linear solutions: some seconds on 40 x 40 cells, a minute on 64 x 64.

    Raises
    ------
    ConvergenceError
        If a stationary contact is not found.

    Warns
    -----
    FileWarning
        If the point on disk is damaged, or cannot be written: it will be computed again next time.
    """
    return cached(
        _path(equations),
        from_bytes=_point,
        build=lambda: _computed(equations),
        to_bytes=_bytes,
        what="the operating point",
    )


def kept_points(equations: ContactEquations) -> list[ContactPoint]:
    """Return the points on disk that differ from some equations in V and Q0 at most, sorted by these.

    Warns
    -----
    FileWarning
        Of a damaged point, which is left out.
    """
    found = []
    for path in sorted(cache_folder().glob(f"contact-{_family(equations)}-*.npz")):
        try:
            found.append(_point(read_kept(path)))
        except (OSError, InputError) as error:
            warn_user(f"an operating point is left out: {error}", FileWarning)
    return sorted(found, key=lambda point: (point.V, point.Q0))


def _computed(equations: ContactEquations) -> ContactPoint:
    contacts = list(_stationary(equations))
    at = contacts[LOADS.index(1.0)]
    small = SmallMotion(equations, at.pressure, at.delta)
    return ContactPoint(
        float(equations.V),
        float(equations.Q0),
        np.array([contact.delta for contact in contacts]),
        np.array([equations.central_film(contact.pressure, contact.delta) for contact in contacts]),
        np.array([small.stiffness(1j * w) for w in (SLOW, *FREQUENCIES)]),
        checkerboard(at.pressure.reshape(equations.grid.shape), equations.grid, 1.0),
    )


def _stationary(equations: ContactEquations) -> Iterator[Contact]:
    contact = stationary(equations, LOADS[0])
    yield contact
    for load in LOADS[1:]:
        contact = follow(equations, contact, load)
        yield contact


def _path(equations: ContactEquations) -> Path:
    place = _digest(repr((f"{equations.V:.12g}", f"{equations.Q0:.12g}")))
    return cache_folder() / f"contact-{_family(equations)}-{place}.npz"


def _family(equations: ContactEquations) -> str:
    """Return a digest of all that decides a point but V and Q0.

    The pressure ratios of one lubricant go with its Q0: of Roelands' law and of the density what counts is
    their quotient.
    """
    fluid: list[Any] = [type(equations.viscosity).__name__]
    if not isinstance(equations.viscosity, BarusViscosity | RoelandsViscosity):
        fluid.append(repr(equations.viscosity))
    if isinstance(equations.viscosity, RoelandsViscosity):
        fluid += [
            f"{equations.viscosity.exponent:.9g}",
            f"{equations.viscosity.pressure_ratio / equations.Q0:.9g}",
        ]
    if equations.density is not None:
        fluid.append(f"{equations.density.pressure_ratio / equations.Q0:.9g}")
    return _digest(
        repr((source_digest(__name__), equations.grid, equations.scheme, equations.ellipse, fluid))
    )


def _digest(key: str) -> str:
    return hashlib.sha256(key.encode()).hexdigest()[:16]


def _bytes(point: ContactPoint) -> bytes:
    buffer = io.BytesIO()
    values: Any = {name: np.asarray(getattr(point, name)) for name in _FIELDS}
    np.savez(buffer, **values)
    return buffer.getvalue()


def _point(content: bytes) -> ContactPoint:
    with np.load(io.BytesIO(content), allow_pickle=False) as file:
        values = {name: file[name] for name in _FIELDS}
    scalars = {name: float(values[name]) for name in ("V", "Q0", "checkerboard")}
    return ContactPoint(**{**values, **scalars})
