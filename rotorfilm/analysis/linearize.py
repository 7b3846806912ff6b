"""Models at an operating point, as linear python-control systems with named signals."""

from __future__ import annotations

import math
import warnings
from collections.abc import Iterator
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from ..core import port
from ..core.dynamic_stiffness import coefficients_of, has_own_stiffness, rest_state, small_motion, states_rest
from ..core.errors import ConvergenceError, InputError, brief, require_finite, require_kind, require_positive
from ..core.inputs import arguments, quantities
from ..core.model import Array, Linearization, Model
from ..core.readable import Readable
from ..core.results import Equilibrium, FrequencyDependentCoefficients
from ..core.signals import FORCE_OUTPUTS, JOURNAL_INPUTS, Signal, names, place_names
from .threads import one_blas_thread

if TYPE_CHECKING:
    import control


@quantities
@dataclass(frozen=True, kw_only=True)
class OperatingPoint:
    """The time, state and input at which a model is linearized.

    Attributes
    ----------
    t : float [s]
        Time; matters only to models that depend on it.
    x : array_like, shape (n_states,)
        State, in the order and SI units of `model.states`.
    u : array_like, shape (n_inputs,)
        Input, in the order and SI units of `model.inputs`.
    """

    t: float = 0.0
    x: ArrayLike = ()
    u: ArrayLike = ()


@one_blas_thread
@arguments
def linearize(model: Model, at: OperatingPoint | Equilibrium, name: str | None = None) -> control.StateSpace:
    """Return the exact linearization of a model, in SI units and with the model's signal names.

    Parameters
    ----------
    model : Model
        A static film gives a system without states whose D holds its derivatives. A frequency-dependent film
        gives the system of `film_system`, with an error up to 1e-3 at frequencies up to that of the shaft.
    at : OperatingPoint or Equilibrium
        With an Equilibrium the journal is at this equilibrium, and so are the states of the reaction. A bush
        keeps its initial wear, and a heated film keeps the temperature of the equilibrium.
    name : str, optional
        Name of the system; python-control numbers it by default.

    Raises
    ------
    InputError
        If the point does not fit the model, or an Equilibrium is given for a model that is no film.
    EquilibriumError
        If the states of a reaction do not rest with the journal.
    """
    if isinstance(at, Equilibrium):
        if has_own_stiffness(model):
            return film_system(model, at, name=name).system
        require_kind("model", model, Model, "a Model such as a bearing or a rotor")
        model, point = _rested(model, at)
    else:
        require_kind("model", model, Model, "a Model such as a bearing or a rotor")
        point = at
    x = checked_vector("x", point.x, len(model.states))
    u = checked_vector("u", point.u, len(model.inputs))
    matrices = model.linearization(point.t, x, u)
    return state_space(matrices, model.inputs, model.outputs, model.states, name)


def state_space(
    matrices: Linearization,
    inputs: tuple[Signal, ...],
    outputs: tuple[Signal, ...],
    states: tuple[Signal, ...],
    name: str | None,
) -> control.StateSpace:
    """Return a linearization as a python-control system that carries the names of its signals."""
    return control_system(
        *matrices, inputs=names(inputs), outputs=names(outputs), states=names(states), name=name
    )


def control_system(*parts: Any, **labels: Any) -> control.StateSpace:
    """Return the `control.StateSpace` of these arguments, all its states kept."""
    import control

    with warnings.catch_warnings():
        # It sets the shape of the arrays of a system without states, which numpy deprecates since 2.5.
        warnings.filterwarnings("ignore", category=DeprecationWarning, module=r"control\.")
        return control.StateSpace(*parts, remove_useless_states=False, **labels)


def checked_vector(name: str, value: ArrayLike, size: int) -> Array:
    """Return a vector of `size` finite numbers; raise InputError otherwise."""
    array = require_finite(name, value)
    if array.shape != (size,):
        raise InputError(f"{name} must have shape ({size},) to fit the model, got shape {array.shape}")
    return array


def _rested(model: Any, at: Equilibrium) -> tuple[Any, OperatingPoint]:
    """Return a reaction at the temperature of its rest, and the input and states that rest there."""
    given, wanted = names(model.inputs), [*place_names(port.freedoms_of(model)), "speed"]
    if given != wanted or len(at.position) != len(port.freedoms_of(model)):
        raise InputError(
            "at must be an OperatingPoint for a model that is not a film with the inputs "
            f"{', '.join(wanted)}, got an Equilibrium for the inputs {given}"
        )
    film = port.at_balanced_temperature(model, at.position, at.speed)
    x = rest_state(film, at.position, at.speed)
    return film, OperatingPoint(x=x, u=port.input_of(at.position, None, at.speed))


# A frequency-dependent film as a linear system for python-control, with its error over frequencies.


ORDERS = (2, 4, 6, 8, 12, 16, 24, 32)
"""States for each direction of the journal that are tried, until the error is small enough."""

POLES = (1.0, 0.5, 2.0)
"""Decay rates of these states / highest frequency."""

SAMPLES = 192
"""Frequencies at which the film is asked; every second one is fitted, and the error is that at all."""


TOLERANCE = 1e-3
"""Largest error of a system unless another one is asked for."""


@dataclass(frozen=True, kw_only=True)
class FilmSystem(Readable):
    """A frequency-dependent film, as a linear system with few states.

    Attributes
    ----------
    system : control.StateSpace
        Inputs x, y, vx, vy, speed, outputs force_x, force_y, as small changes about the equilibrium. The
        states are not oil contents: they are the recent history of x and of y, each through a chain of equal
        lags. The speed acts as in slow motion.
    error : float [1]
        Largest error of K(i nu) relative to its largest entry, at frequencies nu up to the highest; K(0) is
        exact.
    highest_frequency : float [rad/s]
        Highest frequency of the fit. Beyond it the error is unknown.
    """

    system: control.StateSpace
    error: float
    highest_frequency: float


class _Fit(NamedTuple):
    """K(s) = K(0) + s damping + sum of parts (k - k at s = 0), k = ((s - a)/(s + a))^j/(s + a)."""

    still: Array
    decay: float
    damping: Array
    parts: Array
    error: float
    highest_frequency: float

    @property
    def linearization(self) -> Linearization:
        """The fit over x, y, vx, vy: x_j' = q - a x_j - 2 a (x_1 + ... + x_(j-1)) for x and for y."""
        order = len(self.parts)
        lags = -self.decay * (np.eye(order) + 2.0 * np.tril(np.ones((order, order)), -1))
        static = self.still - np.tensordot(_at_rest(order, self.decay), self.parts, 1)
        return Linearization(
            np.asarray(np.kron(np.eye(2), lags), dtype=float),
            np.hstack([np.kron(np.eye(2), np.ones((order, 1))), np.zeros((2 * order, 2))]),
            -np.transpose(self.parts, (1, 2, 0)).reshape(2, 2 * order),
            np.hstack([-static, -self.damping]),
        )


@one_blas_thread
@arguments
def film_system(
    film: port.Reaction,
    at: Equilibrium,
    *,
    highest_frequency: float | None = None,
    tolerance: float = TOLERANCE,
    name: str | None = None,
) -> FilmSystem:
    """Return the small motion of a frequency-dependent film as a stable system with few states.

    Parameters
    ----------
    film : Reaction
        Film with a frequency-dependent stiffness K(s), such as `JFOFilm`.
    at : Equilibrium
        Equilibrium where the journal rests.
    highest_frequency : float, optional [rad/s]
        Highest frequency at which K(i nu) is fitted; by default the speed.
    tolerance : float [1]
        Largest error there, over the largest entry of K(i nu).
    name : str, optional
        Name of the system.

    Raises
    ------
    InputError
        If an argument breaks its rule, or the shaft is at rest.
    ConvergenceError
        If 32 states for each direction are not enough.

    Notes
    -----
    K(s) is fitted by least squares in Laguerre functions of s, at frequencies up to the highest, with K(0)
    exact: oil that crosses a cavity acts as a delay, and the functions converge to it at a geometric rate.
    The fitted system is always stable, and its damping in fast motion is positive.
    """
    port.require_reaction("film", film, heavy=True, planar=True)
    if not states_rest(film):
        raise InputError(f"film must be a frequency-dependent film, such as a JFOFilm, got {brief(film)}")
    require_kind("at", at, Equilibrium, "an Equilibrium, as equilibrium() returns it")
    require_positive("tolerance", tolerance)
    coefficients: Any = coefficients_of(small_motion(film, at.position, at.speed), at.position, at.speed)
    fit = _fitted(coefficients, highest_frequency, tolerance)
    A, B, C, D = fit.linearization
    by_speed = port.static_slopes(film, at.position, np.zeros(2), at.speed)[:, 4:]
    system = control_system(
        A,
        np.hstack([B, np.zeros((len(A), 1))]),
        C,
        np.hstack([D, by_speed]),
        inputs=list(JOURNAL_INPUTS),
        outputs=list(FORCE_OUTPUTS),
        states=[f"memory_{axis}_{k}" for axis in "xy" for k in range(len(fit.parts))],
        name=name,
    )
    return FilmSystem(system=system, error=fit.error, highest_frequency=float(fit.highest_frequency))


def film_states(film: FrequencyDependentCoefficients) -> Linearization:
    """Return a film with K(s) as states under a journal: inputs x, y, vx, vy, outputs its force.

    Exact where its states are known, as of tilting pads; else as `film_system` up to the speed of the shaft.

    Raises
    ------
    InputError, ConvergenceError
        As `film_system`.
    """
    motion = film.dynamic_stiffness
    if at := getattr(motion, "at", None):
        A, B, C, D = at
        n = len(C)
        return Linearization(A, B[:, : 2 * n], C, D[:, : 2 * n])
    return _fitted(film, None, TOLERANCE).linearization


def _fitted(film: FrequencyDependentCoefficients, highest_frequency: float | None, tolerance: float) -> _Fit:
    """Return the fit with the fewest states whose error is small enough, and which damps fast motion."""
    if film.speed == 0.0:
        raise InputError(
            "at.speed must not be 0 for a film whose coefficients depend on the frequency, got 0.0"
        )
    top = abs(film.speed) if highest_frequency is None else highest_frequency
    require_positive("highest_frequency", top)
    motion = film.dynamic_stiffness
    still = motion.stiffness(0j).real
    nu = top * np.arange(1, SAMPLES + 1) / SAMPLES
    K = np.array([motion.stiffness(1j * float(one)) for one in nu])
    least = math.inf
    for fit in _fits(nu, K, still, top):
        least = min(least, fit.error)
        if fit.error <= tolerance and np.linalg.eigvalsh(fit.damping + fit.damping.T)[0] > 0.0:
            return fit
    raise ConvergenceError(
        f"tolerance must be within reach of {ORDERS[-1]} states for each direction up to {top:.6g} rad/s, "
        f"got {tolerance!r}: the least error is {least:.3g}"
    )


def _fits(nu: Array, K: port.Complex, still: Array, top: float) -> Iterator[_Fit]:
    """Yield fits to the stiffness at some frequencies, those with few states first."""
    size = 1.0 / np.abs(K).max(axis=(1, 2))
    wanted = ((K - still) * size[:, None, None]).reshape(len(nu), 4)
    for order in ORDERS:
        for decay in (top * pole for pole in POLES):
            s = 1j * nu
            lags = ((s - decay) / (s + decay)) ** np.arange(order)[:, None] / (s + decay)
            rows: port.Complex = np.vstack([s / top, decay * (lags - _at_rest(order, decay)[:, None])])
            terms = (rows * size).T
            some = slice(1, None, 2)
            found, *_ = np.linalg.lstsq(_real(terms[some]), _real(wanted[some]), rcond=None)
            error = float(np.abs(terms @ found - wanted).max())
            damping, parts = found[0].reshape(2, 2) / top, decay * found[1:].reshape(-1, 2, 2)
            yield _Fit(still, decay, damping.astype(float), parts.astype(float), error, top)


def _at_rest(order: int, decay: float) -> Array:
    """Return the lags at s = 0."""
    return np.asarray((-1.0) ** np.arange(order) / decay)


def _real(rows: port.Complex) -> Array:
    return np.concatenate([rows.real, rows.imag])
