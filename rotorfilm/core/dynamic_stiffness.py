"""A reaction about its rest: the states there, the force in slow motion, and the stiffness K(s) there."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any, Protocol

import numpy as np
from numpy.typing import ArrayLike

from .errors import EquilibriumError, FilmContactError, InputError, brief, require_number
from .model import Array, Linearization, static_linearization
from .port import (
    Complex,
    at_balanced_temperature,
    clearance_of,
    force_noise,
    freedoms_of,
    input_of,
    is_warming,
    mass_of,
    minimum_film,
    rest_place,
    static_slopes,
)
from .results import FrequencyDependentCoefficients, ReducedCoefficients
from .signals import PLANAR, Signal, names

# States at rest under a shaft at rest, and the force that is left then: quasi-static elimination.


_STEPS, _HALVINGS, _SETTLED = 40, 30, 1e-13


def states_rest(reaction: Any) -> bool:
    """Return whether a reaction has states that rest with the shaft, or K(s) in another way.

    Those that drift, as the wear of a bush or the temperature of a film, are held where they are.
    """
    told = getattr(reaction, "states_rest", None)
    return (
        told
        if told is not None
        else hasattr(reaction, "at_rest")
        or (not hasattr(reaction, "force") and bool(getattr(reaction, "states", ())))
    )


def drifts(reaction: Any) -> bool:
    """Return whether a reaction has states that hardly move within a turn, as wear or a temperature.

    Coefficients hold them where they are, unless a frequency is named.
    """
    return is_warming(reaction) or bool(getattr(reaction, "states", ()))


def quasi_static(reaction: Any) -> Any:
    """Return a reaction with its states at rest under a shaft at rest; itself where it has none."""
    own = getattr(reaction, "at_rest", None)
    if own is not None:
        return own()
    return QuasiStatic(reaction) if states_rest(reaction) else reaction


def rest_state(reaction: Any, position: ArrayLike, speed: float) -> Array:
    """Return the states of a reaction that rest with the shaft at a place, shape (m,).

    Parameters
    ----------
    reaction : Reaction
    position : array_like, shape (n,) [m]
    speed : float [rad/s]

    Raises
    ------
    EquilibriumError
        If the reaction does not tell them and Newton's method finds none.
    """
    own = getattr(reaction, "rest_state", None)
    if own is not None:
        return np.asarray(own(position, speed))
    if not reaction.states:
        return np.zeros(0)
    u = input_of(position, None, speed)
    found = newton_root(
        lambda x: np.asarray(reaction.derivative(0.0, x, u)),
        lambda x: np.asarray(reaction.linearization(0.0, x, u).A),
        np.array(reaction.initial_state, dtype=float),
        np.array([signal.nominal for signal in reaction.states]),
    )
    if found is None:
        raise no_rest(reaction, position, speed)
    return found


def no_rest(reaction: Any, position: ArrayLike, speed: float) -> EquilibriumError:
    """Return what to raise where no states were found that rest with the shaft at a place."""
    return EquilibriumError(
        f"reaction must have an equilibrium of its states {names(reaction.states)} with the shaft at "
        f"{np.asarray(position).tolist()} and "
        f"{speed!r} rad/s, got {brief(reaction)}, for which none was found"
    )


def newton_root(
    law: Callable[[Array], Array], slopes: Callable[[Array], Array], start: Array, nominal: Array
) -> Array | None:
    """Return where a law (m,) of x (m,) vanishes, by Newton's method with halved steps; None if nowhere.

    A trial at which the journal would touch its wall counts as one that is too far.

    Parameters
    ----------
    law, slopes : callable
        Its value and its derivatives (m, m).
    start, nominal : ndarray, shape (m,)
        Where to begin, and typical sizes of x and of its rates.
    """
    x, rate = start, law(start)
    for _ in range(_STEPS):
        A = slopes(x)
        if np.linalg.cond(A * nominal / nominal[:, None]) > 1e14:
            return None
        step = -np.linalg.solve(A, rate)
        if np.abs(step / nominal).max() <= _SETTLED * max(1.0, np.abs(x / nominal).max()):
            return np.asarray(x + step)
        for halving in range(_HALVINGS):
            trial = x + 0.5**halving * step
            try:
                moved = law(trial)
            except FilmContactError:
                continue
            if np.abs(moved / nominal).max() < np.abs(rate / nominal).max() or not moved.any():
                x, rate = trial, moved
                break
        else:
            return None
        if not rate.any():
            return x
    return None


def rest_linearization(reaction: Any, position: ArrayLike, speed: float) -> Linearization:
    """Return the exact derivatives of a reaction whose states rest with the shaft, without further signals.

    Inputs: places and rates, and the speed; outputs: the forces, shape (n,). A reaction that leaves out the
    speed, as tilting pads, tells its derivatives in slow motion by its `at_rest`.
    """
    n = len(freedoms_of(reaction))
    own = getattr(reaction, "rest_linearization", None)
    if own is not None:
        A, B, C, D = own(position, speed)
    elif hasattr(reaction, "linearization"):
        x = rest_state(reaction, position, speed)
        A, B, C, D = reaction.linearization(0.0, x, input_of(position, None, speed))
    else:
        still = np.zeros(n)
        A, B, C, D = static_linearization(static_slopes(reaction, position, still, speed))
    return Linearization(A, B[:, : 2 * n + 1], C[:n], D[:n, : 2 * n + 1])


@dataclass(frozen=True, eq=False)
class QuasiStatic:
    """A reaction without states: another one, whose states rest with a shaft at rest.

    Parameters
    ----------
    reaction : Reaction
        Reaction with states that rest.
    """

    reaction: Any

    @property
    def freedoms(self) -> tuple[str, ...]:
        """Those of the reaction."""
        return freedoms_of(self.reaction)

    @property
    def clearance(self) -> float:
        """That of the reaction [m]."""
        return clearance_of(self.reaction)

    @property
    def inputs(self) -> tuple[Signal, ...]:
        """Those of the reaction."""
        return self.reaction.inputs

    @property
    def outputs(self) -> tuple[Signal, ...]:
        """Those of the reaction."""
        return self.reaction.outputs

    def minimum_film(self, position: Array) -> Array:
        """Return the least film of the reaction [m]."""
        return minimum_film(self.reaction, position)

    def force_noise(self, speed: float) -> float:
        """Return what roundoff may leave of the force of the reaction [N]."""
        return force_noise(self.reaction, speed)

    def rest_place(self, load: Sequence[float], speed: float) -> Any:
        """Return where the reaction says that the shaft rests, shape (n,); None where it does not say."""
        return rest_place(self.reaction, load, speed)

    def force(self, position: ArrayLike, velocity: ArrayLike, speed: float) -> Array:
        """Return the force on a shaft at rest, shape (n,); the velocity is not used."""
        x = rest_state(self.reaction, position, speed)
        found = self.reaction.output(0.0, x, input_of(position, None, speed))
        return np.asarray(found)[: len(self.freedoms)]

    def jacobian(self, position: ArrayLike, velocity: ArrayLike, speed: float) -> Array:
        """Return the derivatives in slow motion, shape (n, 2 n + 1)."""
        A, B, C, D = rest_linearization(self.reaction, position, speed)
        if D.shape[1] == 2 * len(C):
            raise InputError(f"reaction must tell its derivatives by the speed, got {brief(self.reaction)}")
        K, slope = StatesStiffness(Linearization(A, B, C, D))(0j)
        by_speed = D[:, -1:] - C @ np.linalg.solve(A, B[:, -1:])
        return np.hstack([-K.real, -slope.real, by_speed])


# Stiffness over the exponent of the motion: K(s) = -dF/dq, states and added mass included.


class DynamicStiffness(Protocol):
    """The stiffness that a shaft feels in small motion, over the exponent of the motion.

    One of states that follow the shaft has them as `at`, as of `StatesStiffness`: a rotor may take them as
    states of its own.
    """

    def __call__(self, s: complex) -> tuple[Complex, Complex]:
        """Return K(s) [N/m] and dK/ds [N s/m], shape (n, n) each: the force changes by -K(s) q e^(s t).

        Parameters
        ----------
        s : complex [1/s]
        """

    def stiffness(self, s: complex) -> Complex:
        """Return K(s) alone.

        Parameters
        ----------
        s : complex [1/s]
        """


@dataclass(frozen=True)
class StatesStiffness:
    """K(s) of a reaction whose states follow the shaft, exactly, from its linearization about a rest.

    Parameters
    ----------
    at : Linearization
        Its inputs begin with places and rates, its outputs are the n forces.
    """

    at: Linearization

    def __call__(self, s: ArrayLike) -> tuple[Complex, Complex]:
        """Return K(s) [N/m] and dK/ds [N s/m], shape (..., n, n); see `DynamicStiffness`."""
        A, B, C, D = self.at
        n, each = len(C), np.asarray(s)[..., None, None]
        by_place, by_rate = slice(n), slice(n, 2 * n)
        follow = each * np.eye(len(A)) - A
        moved = _following(follow, B[:, by_place] + each * B[:, by_rate], s)
        slope = np.linalg.solve(follow, B[:, by_rate] - moved)
        K, damping = D[:, by_place] + each * D[:, by_rate] + C @ moved, D[:, by_rate] + C @ slope
        return -K.astype(complex), -damping.astype(complex)

    def stiffness(self, s: ArrayLike) -> Complex:
        """Return K(s) [N/m] alone, shape (..., n, n)."""
        A, B, C, D = self.at
        n, each = len(C), np.asarray(s)[..., None, None]
        moved = _following(each * np.eye(len(A)) - A, B[:, :n] + each * B[:, n : 2 * n], s)
        return -(D[:, :n] + each * D[:, n : 2 * n] + C @ moved).astype(complex)

    def exponents(self, mass: ArrayLike) -> Complex:
        """Return all exponents of a rigid mass [kg], or (n, n), on it [1/s], the least damped first."""
        A, B, C, D = self.at
        n, size = len(C), len(A)
        push = np.hstack([D[:, : 2 * n], C])
        push = np.linalg.solve(np.asarray(mass, dtype=float), push) if np.ndim(mass) else push / mass
        whole = np.vstack([np.eye(n, 2 * n + size, n), push, np.hstack([B[:, : 2 * n], A])])
        values = np.linalg.eigvals(whole).astype(complex)
        return values[np.argsort(-values.real)]


def _following(follow: np.ndarray, drive: np.ndarray, s: ArrayLike) -> np.ndarray:
    """Return what the states do, by (s - A) and what drives them."""
    try:
        return np.asarray(np.linalg.solve(follow, drive))
    except np.linalg.LinAlgError:
        raise InputError(
            "s must not be an eigenvalue of the states of the bearing alone, such as 0 for a state that "
            f"integrates, got {brief(s)}"
        ) from None


def stiffnesses(motion: Any, s: np.ndarray) -> Complex:
    """Return K(s) [N/m] at many s (m,) [1/s], shape (m, n, n), at once where the states are known."""
    if hasattr(motion, "at"):
        return np.asarray(motion.stiffness(s))
    return np.stack([motion.stiffness(complex(one)) for one in s])


def stiffnesses_and_slopes(motion: Any, s: ArrayLike) -> tuple[Complex, Complex]:
    """Return K(s) [N/m] and dK/ds [N s/m] at one s or at many (m,) [1/s], shape (..., n, n) each."""
    if hasattr(motion, "at") or not np.ndim(s):
        found: tuple[Complex, Complex] = motion(s)
        return found
    K, slope = zip(*(motion(complex(one)) for one in np.asarray(s)), strict=True)
    return np.stack(K), np.stack(slope)


@dataclass(frozen=True)
class InertialStiffness:
    """K(s) + s^2 mass of a reaction that adds a mass, as a `DynamicStiffness`.

    Parameters
    ----------
    motion : DynamicStiffness
        Motion without that mass.
    mass : ndarray, shape (n, n) [kg]
    """

    motion: Any
    mass: Array

    @property
    def at(self) -> Linearization:
        """The states of the reaction, if it tells them."""
        return self.motion.at

    def __call__(self, s: ArrayLike) -> tuple[Complex, Complex]:
        """Return K(s) + s^2 mass [N/m] and its slope [N s/m]; see `DynamicStiffness`."""
        (K, slope), each = self.motion(s), np.asarray(s)[..., None, None]
        return K + each**2 * self.mass, slope + 2.0 * each * self.mass

    def stiffness(self, s: ArrayLike) -> Complex:
        """Return K(s) + s^2 mass [N/m] alone, shape (..., n, n)."""
        return np.asarray(self.motion.stiffness(s) + np.multiply.outer(np.square(s), self.mass))


def has_own_stiffness(reaction: object) -> bool:
    """Return whether a reaction tells K(s) itself and has no states to tell it, as one that conserves oil.

    What grows on it is counted, by the argument principle: exponents can be followed, but not listed.
    """
    return hasattr(reaction, "dynamic_stiffness") and not hasattr(reaction, "derivative")


def small_motion(reaction: Any, position: ArrayLike, speed: float) -> DynamicStiffness:
    """Return K(s) and dK/ds of a reaction about a rest, without its added mass.

    Parameters
    ----------
    reaction : Reaction
    position : array_like, shape (n,) [m]
    speed : float [rad/s]
    """
    own = getattr(reaction, "dynamic_stiffness", None)
    if own is not None:
        return own(position, speed)
    return StatesStiffness(rest_linearization(reaction, position, speed))


def rigid_exponents(reaction: Any, position: ArrayLike, speed: float, mass: float) -> Complex:
    """Return the exponents of a rigid mass [kg] on a reaction about a rest [1/s], the least damped first.

    A film that warms keeps the temperature of the rest.
    """
    film = at_balanced_temperature(reaction, position, speed)
    at, added = (
        rest_linearization(film, position, speed),
        mass_of(film, position, np.zeros_like(position), speed),
    )
    return StatesStiffness(at).exponents(mass * np.eye(len(added)) + added if added.any() else mass)


def coefficients_of(
    motion: DynamicStiffness,
    position: Array,
    speed: float,
    frequency: float | None = None,
    freedoms: tuple[str, ...] = PLANAR,
) -> ReducedCoefficients:
    """Return Re K(i nu) and Im K(i nu)/nu, with their limits at 0.

    Without a frequency they are `FrequencyDependentCoefficients`.

    Parameters
    ----------
    motion : DynamicStiffness
    position, speed : ndarray, shape (n,) [m], and float [rad/s]
        Where the journal rests.
    frequency : float, optional [rad/s]
        nu; by default that of the shaft.
    freedoms : tuple of str
    """
    nu = abs(speed) if frequency is None else require_number("frequency", frequency)
    K, slope = motion(1j * nu) if nu == 0.0 else (motion.stiffness(1j * nu), None)
    damping = K.imag / nu if slope is None else slope.real
    found = ReducedCoefficients(
        stiffness=K.real, damping=damping, position=position, speed=speed, frequency=nu, freedoms=freedoms
    )
    return found if frequency is not None else FrequencyDependentCoefficients(**vars(found), motion=motion)
