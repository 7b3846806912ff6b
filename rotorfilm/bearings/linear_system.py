"""A bearing, seal or controller that is known by its frequency response: a linear reaction with states."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from typing import TYPE_CHECKING, Any, ClassVar

import numpy as np
from numpy.typing import ArrayLike
from scipy.interpolate import PchipInterpolator

from ..core.dynamic_stiffness import QuasiStatic, StatesStiffness, rest_linearization
from ..core.errors import (
    InputError,
    brief,
    require_count,
    require_finite,
    require_kind,
    require_positive,
    warn_user,
)
from ..core.inputs import quantities
from ..core.model import Array, Linearization
from ..core.port import Complex
from ..core.signals import (
    FREEDOMS,
    PLANAR,
    Signal,
    checked_freedoms,
    force_names,
    force_outputs,
    journal_inputs,
    place_names,
)
from ..native.spec import NativeSpec, linear_kernel
from .linear import NOMINAL_LENGTH, require_rising, within_table
from .rational_fit import rational_fit
from .reaction import NOMINAL_SPEED, input_vector, mass_entries, mass_outputs

if TYPE_CHECKING:
    import control

INTEGRATES, LEAK = 1e-10, 1e-9
"""Pole, over the fastest one, below which a state integrates; its decay at rest, over the slowest other."""

_SAMPLE = 0.6 + 0.8j  # of the sizes of states and forces, off the axes on which poles lie


@quantities
@dataclass(frozen=True, kw_only=True)
class FrequencyDependentReaction:
    """A linear reaction with states x to small motion q of the shaft, such as a seal or a magnetic bearing.

        x' = A x + B q,    force = C x + D q - damping q' - added_mass q''

    so that K(s) + s C(s) = -D - C (s - A)^-1 B + s damping. `from_system` makes it from a python-control
    system, `from_table` from a table over frequency, and `from_isotropic` from a complex system.

    Parameters
    ----------
    A : array_like, shape (m, m)
        State matrix; the number of states may be 0. With several `speeds` A, B, C and D have one matrix for
        each.
    B : array_like, shape (m, n)
        Input matrix: rates of the states by the n displacements of the shaft [m], [rad].
    C : array_like, shape (n, m)
        Output matrix: forces and moments on the shaft [N], [N m] by the states.
    D : array_like, shape (n, n)
        Feedthrough: forces and moments by the displacements, which is minus a stiffness.
    freedoms : tuple of str
        Motions of the shaft, as ("x", "y") or ("z",), in the order of `core.signals.FREEDOMS`.
    speeds : array_like, shape (k,) [rad/s]
        Rising; empty for a reaction that is the same at any speed. Between them each entry of A, B, C, D
        follows a monotone cubic: states must mean the same at all speeds. Beyond them an error is raised.
    damping : array_like, shape (n, n) [N s/m], or None
        Damping of forces by rates, at all speeds.
    added_mass : array_like, shape (n, n) [kg], or None
        Added mass, symmetric, the same at all speeds; a rotor includes it in its own mass.
    state_names : tuple of str
        Empty for state_0, state_1, ...
    band : tuple of two floats [rad/s], or None
        Frequencies between which it is known; None for all.
    error : float or None [1]
        Largest error of K(s) + s C(s) in the band over the largest entry; None where it is not known.

    Raises
    ------
    InputError
        If a shape is wrong, a number is not finite or another value breaks its rule.

    Notes
    -----
    At rest the states are -A^-1 B q. An integrating state, as in a controller, would make the static
    stiffness infinite. It is given a decay rate of 1e-9 of the slowest other pole, so that the static
    stiffness is very large but finite.

    Examples
    --------
    >>> seal = FrequencyDependentReaction.from_isotropic([[-500.0 + 60.0j]], [[1.0]], [[4e8]], [[-2e6]])
    >>> [state.name for state in seal.states]
    ['state_0', 'state_1']
    """

    A: ArrayLike
    B: ArrayLike
    C: ArrayLike
    D: ArrayLike
    freedoms: tuple[str, ...] = PLANAR
    speeds: ArrayLike = ()
    damping: ArrayLike | None = None
    added_mass: ArrayLike | None = None
    state_names: tuple[str, ...] = ()
    band: tuple[float, float] | None = None
    error: float | None = None

    clearance: ClassVar[float] = math.inf
    """Infinite: a linear system does not know where the wall is [m]."""

    def __post_init__(self) -> None:
        freedoms, speeds = checked_freedoms(self.freedoms), require_rising("speeds", self.speeds, least=0)
        n, lead = len(freedoms), (len(speeds),) * bool(speeds.size)
        m = (require_finite("A", self.A).shape or (0,))[-1]
        shapes = {"A": (*lead, m, m), "B": (*lead, m, n), "C": (*lead, n, m), "D": (*lead, n, n)}
        for name, shape in (*shapes.items(), ("damping", (n, n)), ("added_mass", (n, n))):
            value = getattr(self, name)
            table = np.zeros((n, n)) if value is None and name not in shapes else require_finite(name, value)
            if table.shape != shape:
                raise InputError(f"{name} must have shape {shape}, got {table.shape}")
            object.__setattr__(self, name, table)
        object.__setattr__(self, "freedoms", freedoms)
        object.__setattr__(self, "speeds", speeds)
        if not np.allclose(self._mass, self._mass.T, rtol=1e-9, atol=0.0):
            raise InputError(f"added_mass must be symmetric, got {self._mass.tolist()}")
        if self.state_names and len(self.state_names) != m:
            raise InputError(f"state_names must be empty or {m} names, got {brief(self.state_names)}")
        if self.state_names and not _are_free(self.state_names, freedoms):
            raise InputError(
                f"state_names must differ from each other and from those of motions and forces, got "
                f"{brief(self.state_names)}"
            )
        if self.band is not None:
            require_rising("band", self.band, least=2)

    @classmethod
    def from_system(
        cls,
        system: control.StateSpace | Sequence[control.StateSpace],
        freedoms: Sequence[str] = PLANAR,
        *,
        speeds: ArrayLike = (),
    ) -> FrequencyDependentReaction:
        """Return a python-control system as a reaction; it need not be stable.

        Parameters
        ----------
        system : control.StateSpace, or one for each of the speeds
            Inputs: places of the shaft; outputs: forces on the shaft, both in the order of the freedoms.
        freedoms : sequence of str
        speeds : array_like, shape (k,) [rad/s]
            Rising; empty for one system.

        Raises
        ------
        InputError
            If a system is not in continuous time or has other inputs or outputs, or systems differ in size.
        """
        wanted = checked_freedoms(freedoms)
        single = not isinstance(system, list | tuple)
        systems: Any = [system] if single else system
        if single != (np.size(speeds) == 0) or (not single and len(systems) != np.size(speeds)):
            raise InputError(
                f"system must be one, or a list of one for each of the speeds, got {brief(system)}"
            )
        matrices = [_matrices(f"system[{k}]", one, wanted) for k, one in enumerate(systems)]
        if len({part[0].shape for part in matrices}) > 1:
            raise InputError(f"system must have one size, got {[len(part[0]) for part in matrices]} states")
        A, B, C, D = matrices[0] if single else map(np.array, zip(*matrices, strict=True))
        labels = tuple(systems[0].state_labels)
        named = all(label.isidentifier() for label in labels) and _are_free(labels, wanted)
        return cls(
            A=A, B=B, C=C, D=D, freedoms=wanted, speeds=speeds, state_names=labels if named else ()
        )  # fmt: skip

    @classmethod
    def from_isotropic(
        cls, A: ArrayLike, B: ArrayLike, C: ArrayLike, D: ArrayLike
    ) -> FrequencyDependentReaction:
        """Return the complex system Z' = A Z + B z, F = C Z + D z of z = x + i y as a reaction.

        Parameters
        ----------
        A : array_like of complex, shape (m, m)
        B : array_like of complex, shape (m, 1)
        C : array_like of complex, shape (1, m)
            Force on the shaft, F_x + i F_y.
        D : array_like of complex, shape (1, 1)
        """
        return cls(A=_in_plane("A", A), B=_in_plane("B", B), C=_in_plane("C", C), D=_in_plane("D", D))

    @classmethod
    def from_table(
        cls,
        frequencies: ArrayLike,
        stiffness: ArrayLike,
        damping: ArrayLike,
        mass: ArrayLike | None = None,
        *,
        poles: int | None = None,
        tolerance: float = 1e-3,
        freedoms: Sequence[str] = PLANAR,
    ) -> FrequencyDependentReaction:
        """Return a reaction through a table over frequency, by rational functions with common stable poles.

        Z(i w) = K + i w C - w^2 M becomes a constant, a damping, with a mass an added mass, and fractions.

        Parameters
        ----------
        frequencies : array_like, shape (m,) [rad/s]
            Frequencies of whirl, positive and rising.
        stiffness : array_like, shape (m, n, n) [N/m]
        damping : array_like, shape (m, n, n) [N s/m]
        mass : array_like, shape (m, n, n) [kg], optional
        poles : int, optional
            Number of poles, both of each complex pair. By default as few as the tolerance needs.
        tolerance : float [1]
            Largest error of the table, as `error` counts it; not below the noise of a measured one.
        freedoms : sequence of str

        Returns
        -------
        FrequencyDependentReaction
            Its `band` is that of the table. Its `error` is that at all frequencies, every second of which
            was fitted.

        Raises
        ------
        InputError
            If an argument breaks its rule.
        ConvergenceError
            If the tolerance is not reached with any number of poles, for example if the mass is far from
            symmetric.
        """
        known = require_rising("frequencies", frequencies, least=2)
        require_positive("frequencies[0]", float(known[0]))
        require_positive("tolerance", tolerance)
        if poles is not None:
            require_count("poles", poles, 0)
        wanted = checked_freedoms(freedoms)
        shape = (len(known), len(wanted), len(wanted))
        given = {"stiffness": stiffness, "damping": damping, **({} if mass is None else {"mass": mass})}
        tables = [_checked(name, table, shape) for name, table in given.items()]
        Z = np.sum([(1j * known[:, None, None]) ** k * table for k, table in enumerate(tables)], axis=0)
        scale = _scale(Z, wanted)
        fit = rational_fit(known, Z, scale, poles=poles, tolerance=tolerance, powers=len(tables))
        added = None
        if mass is not None:  # is symmetric; the fractions take up what is left
            added = 0.5 * (fit.polynomial[2] + fit.polynomial[2].T)
            less = Z + known[:, None, None] ** 2 * added
            fit = rational_fit(known, less, scale, poles=len(fit.poles), tolerance=tolerance, powers=2)
            if poles is None and fit.error > tolerance:
                fit = rational_fit(known, less, scale, poles=None, tolerance=tolerance, powers=2)
        A, B, C, D = fit.realization()
        return cls(
            A=A,
            B=B,
            C=-C,
            D=-D,
            freedoms=wanted,
            damping=fit.polynomial[1],
            added_mass=added,
            band=(float(known[0]), float(known[-1])),
            error=fit.error,
        )

    def require_range(self, frequency: float) -> None:
        """Warn where motion at a frequency [rad/s] is outside of the band.

        Warns
        -----
        ValidityWarning
        """
        if self.band is not None and not self.band[0] <= abs(frequency) <= self.band[1]:
            warn_user(
                f"frequency should be {self.band[0]:.6g} to {self.band[1]:.6g} rad/s, which the reaction is "
                f"known for, got {frequency!r}"
            )

    @property
    def inputs(self) -> tuple[Signal, ...]:
        """Signals of the displacements along its freedoms, of their rates, and of the speed."""
        fastest = float(np.abs(self._known).max(initial=0.0)) or NOMINAL_SPEED
        return journal_inputs(NOMINAL_LENGTH, fastest, self.freedoms)

    @cached_property
    def outputs(self) -> tuple[Signal, ...]:
        """Signals of the forces on the shaft, and of its added mass."""
        return (*force_outputs(self._sizes[1], self.freedoms), *mass_outputs(self))

    @cached_property
    def states(self) -> tuple[Signal, ...]:
        """Signals of the states."""
        labels = self.state_names or [f"state_{k}" for k in range(len(self._sizes[0]))]
        return tuple(
            Signal(name=name, unit="1", nominal=size, description="state of the linear system, in its units")
            for name, size in zip(labels, self._sizes[0].tolist(), strict=True)
        )

    @property
    def initial_state(self) -> Array:
        """The states at rest at the center: zeros, shape (m,)."""
        return np.zeros(len(self.states))

    def output(self, t: float, x: ArrayLike, u: ArrayLike) -> Array:
        """Return the forces on the shaft, and the added mass [kg] if any, at u = (places, rates, speed)."""
        (_, _, C, D), state, q, v = self._at(x, u)
        return np.concatenate([C @ state + D @ q - self._damping @ v, mass_entries(self, self._mass)])

    def derivative(self, t: float, x: ArrayLike, u: ArrayLike) -> Array:
        """Return the rates of the states, shape (m,)."""
        (A, B, _, _), state, q, _ = self._at(x, u)
        return A @ state + B @ q

    def linearization(self, t: float, x: ArrayLike, u: ArrayLike) -> Linearization:
        """Return the exact derivatives, including that by the speed."""
        (A, B, C, D), state, q, _ = self._at(x, u)
        turned = self._system(float(np.asarray(u)[-1]), 1)
        seen = np.hstack([D, -self._damping, (turned.C @ state + turned.D @ q)[:, None]])
        told = len(mass_entries(self, self._mass))
        return Linearization(
            A.copy(),
            np.hstack([B, np.zeros_like(B), (turned.A @ state + turned.B @ q)[:, None]]),
            np.vstack([C, np.zeros((told, len(A)))]),
            np.vstack([seen, np.zeros((told, seen.shape[1]))]),
        )

    def native(self) -> NativeSpec | None:
        """Return the kernel of a linear model; None for a subclass, an added mass or several speeds."""
        if type(self) is not FrequencyDependentReaction or self._known.size or self.has_inertia:
            return None
        return linear_kernel(
            self.linearization(0.0, self.initial_state, np.zeros(2 * len(self.freedoms) + 1))
        )

    def linear_system(self, *speeds: float) -> Linearization | None:
        """Return A, B, C, D over places and rates at the first speed; see `core.port.Reaction`."""
        if type(self) is not FrequencyDependentReaction or (self._known.size > 1 and len(set(speeds)) > 1):
            return None
        still = np.append(np.zeros(2 * len(self.freedoms)), speeds[0])
        A, B, C, D = self.linearization(0.0, self.initial_state, still)
        n = len(self.freedoms)
        return Linearization(A, B[:, : 2 * n], C[:n], D[:n, : 2 * n])

    def rest_state(self, position: ArrayLike, speed: float) -> Array:
        """Return the states that rest with the shaft at a place (n,), shape (m,)."""
        A, B, _, _ = self.leaking._system(speed)
        return np.asarray(np.linalg.solve(A, -B @ require_finite("position", position)))

    def dynamic_stiffness(self, position: ArrayLike, speed: float) -> HoldingStiffness:
        """Return K(s) of small motion; see `core.port`."""
        return HoldingStiffness(rest_linearization(self, position, speed))

    def force_noise(self, speed: float) -> float:
        """Return the roundoff error of the static force [N], which is large where a state integrates."""
        A, B, C, D = self.leaking._system(speed)
        static = D - C @ np.linalg.solve(A, B)
        return float(np.finfo(float).eps * NOMINAL_LENGTH * np.abs(static).max(initial=0.0))

    def at_rest(self) -> QuasiStatic:
        """Return the reaction with its states at their equilibrium for a shaft at rest."""
        return QuasiStatic(self.leaking)

    @property
    def has_inertia(self) -> bool:
        """Whether the reaction adds a mass to the rotor."""
        return bool(self._mass.any())

    def mass(self, position: ArrayLike, velocity: ArrayLike, speed: ArrayLike = 0.0) -> Array:
        """Return the added mass, shape (n, n, ...) [kg], the same everywhere."""
        batch = np.shape(position)[1:]
        return np.broadcast_to(
            self._mass.reshape(*self._mass.shape, *(1,) * len(batch)), (*self._mass.shape, *batch)
        )

    def mass_slopes(self, position: ArrayLike, velocity: ArrayLike, speed: ArrayLike = 0.0) -> Array:
        """Return d mass / d (places, rates, speed), shape (n, n, 2 n + 1, ...): zeros."""
        n = len(self.freedoms)
        return np.zeros((n, n, 2 * n + 1, *np.shape(position)[1:]))

    @property
    def _mass(self) -> Array:
        return np.asarray(self.added_mass, dtype=float)

    @property
    def _damping(self) -> Array:
        return np.asarray(self.damping, dtype=float)

    @property
    def _known(self) -> Array:
        return np.asarray(self.speeds, dtype=float)

    def _at(self, x: ArrayLike, u: ArrayLike) -> tuple[Linearization, Array, Array, Array]:
        """Return the matrices at the speed of the input, the state, places and rates."""
        state, values, n = require_finite("x", x), input_vector(u, self.freedoms), len(self.freedoms)
        found = self._system(float(values[-1]))
        if state.shape != (len(found.A),):
            raise InputError(f"x must have shape ({len(found.A)},), got shape {state.shape}")
        return found, state, values[:n], values[n : 2 * n]

    def _system(self, speed: float, derivative: int = 0) -> Linearization:
        """Return A, B, C, D at a speed, or their derivatives by it."""
        if not self._known.size:
            return self._matrices if not derivative else Linearization(*(0.0 * one for one in self._matrices))
        omega = float(within_table(speed, self._known))
        if self._known.size == 1:
            return Linearization(*(one[0] * (derivative == 0) for one in self._matrices))
        return Linearization(*(curve(omega, nu=derivative) for curve in self._curves))

    @property
    def _matrices(self) -> Linearization:
        return Linearization(*map(np.asarray, (self.A, self.B, self.C, self.D)))

    @cached_property
    def _curves(self) -> list[PchipInterpolator]:
        return [PchipInterpolator(self._known, table, axis=0) for table in self._matrices]

    @cached_property
    def leaking(self) -> FrequencyDependentReaction:
        """The same reaction with a small decay of all states where some integrate."""
        own = np.abs(np.linalg.eigvals(self._matrices.A))
        fast = own.max(axis=-1, initial=0.0)[..., None]
        integrates = own <= INTEGRATES * fast
        if not integrates.any():
            return self
        slowest = np.where(integrates, np.inf, own).min(axis=-1)
        decay = LEAK * np.where(np.isfinite(slowest), slowest, 1.0)
        found = replace(self, A=self._matrices.A - decay[..., None, None] * np.eye(own.shape[-1]))
        vars(found)["leaking"] = found
        return found

    @cached_property
    def _sizes(self) -> tuple[Array, float]:
        """Typical sizes of the states, and of the force [N], in motion as fast as the poles."""
        A, B, C, D = self._system(float(self._known[0]) if self._known.size else 0.0)
        own = np.abs(np.linalg.eigvals(A)) if len(A) else np.zeros(0)
        paces = own[own > INTEGRATES * own.max(initial=0.0)] if own.any() else np.ones(1)
        moved = np.array([np.linalg.solve(_SAMPLE * pace * np.eye(len(A)) - A, B) for pace in paces])
        states, forces = np.abs(moved).sum(axis=2).max(axis=0), np.abs(C @ moved + D).max(initial=0.0)
        fallback = states.max(initial=0.0) or 1.0 / NOMINAL_LENGTH
        return NOMINAL_LENGTH * np.where(states > 0.0, states, fallback), NOMINAL_LENGTH * float(
            forces
        ) or 1.0


class HoldingStiffness(StatesStiffness):
    """K(s) of states some of which may integrate: these hold the shaft in motion that is infinitely slow."""

    def __call__(self, s: ArrayLike) -> tuple[Complex, Complex]:
        """Return K(s) [N/m] and dK/ds [N s/m]; InputError at 0 where a state integrates."""
        try:
            return super().__call__(s)
        except InputError:
            if np.any(s):
                raise
            raise InputError(
                "frequency must be above 0: at 0 a state that integrates holds the shaft, with infinite "
                "stiffness, got 0.0"
            ) from None


def _are_free(labels: Sequence[str], freedoms: tuple[str, ...]) -> bool:
    """Return whether names differ from each other and from those of inputs and outputs."""
    taken = [*place_names(freedoms), "speed", *force_names(freedoms), *labels]
    return len(set(taken)) == len(taken)


def _matrices(name: str, system: Any, freedoms: tuple[str, ...]) -> tuple[Array, Array, Array, Array]:
    """Return A, B, C, D of a python-control system; InputError unless its signals are those of freedoms."""
    from control import StateSpace

    require_kind(name, system, StateSpace, "a control.StateSpace, which has no more zeros than poles")
    if system.isdtime(strict=True):
        raise InputError(f"{name} must be in continuous time, got one with steps of {system.dt!r} s")
    n = len(freedoms)
    if (system.ninputs, system.noutputs) != (n, n):
        raise InputError(
            f"{name} must have {n} inputs and {n} outputs for the freedoms {', '.join(freedoms)}, "
            f"got {system.ninputs} and {system.noutputs}"
        )
    for labels, own in ((system.input_labels, list(freedoms)), (system.output_labels, force_names(freedoms))):
        if labels != own and set(labels) == set(own):
            raise InputError(f"{name} must have its signals in the order {own}, got {labels}")
    return system.A, system.B, system.C, system.D


def _in_plane(name: str, matrix: ArrayLike) -> Array:
    """Return the matrix of a complex system for real parts, and after them imaginary parts."""
    try:
        complex_matrix = np.asarray(matrix, dtype=complex)
    except (TypeError, ValueError):
        raise InputError(f"{name} must be numeric, got {brief(matrix)}") from None
    if complex_matrix.ndim != 2:
        raise InputError(f"{name} must be a matrix, got shape {complex_matrix.shape}")
    re, im = complex_matrix.real, complex_matrix.imag
    return np.block([[re, -im], [im, re]])


def _checked(name: str, table: ArrayLike, shape: tuple[int, ...]) -> Array:
    found = require_finite(name, table)
    if found.shape != shape:
        raise InputError(f"{name} must have shape {shape}, got {found.shape}")
    return found


def _scale(Z: Complex, freedoms: tuple[str, ...]) -> Array:
    """Return the roots of the largest entries of Z, one for all places and one for all angles."""
    turns = np.array([FREEDOMS[name].turns for name in freedoms])
    largest = np.abs(Z).max(axis=0)
    sizes = {kind: largest[np.ix_(turns == kind, turns == kind)].max(initial=0.0) for kind in (False, True)}
    return np.sqrt([sizes[kind] or 1.0 for kind in turns.tolist()])
