"""The stability limit of explicit coupling, from the linearizations of rotor and film.

The sampled system of the Gauss-Seidel scheme with held force: with the rotor's transition matrices over the
macro step, Ad = exp(A H) and Bd = int_0^H exp(A s) ds B, and the film's feedthrough G = d force/d motion
(that is -K, -C), x_(n+1) = (Ad + Bd G C) x_n, because the film is evaluated at the rotor's new state and
its force held over the next step. The coupling is stable while the spectral radius is below 1.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike
from scipy.linalg import expm
from scipy.optimize import brentq

from ..errors import InputError, require_finite, require_positive
from ..model import Array, Dynamic, Model, indices
from ..signals import names

SHORTEST = 1e-6
"""Where the search for the limit begins, in reciprocals of the fastest rate of the coupled system."""

LONGEST = 1e3
"""Where the search for the limit ends, in the same unit."""

SEARCH_RATIO = 1.1
"""Ratio of neighboring trial steps: a stable island narrower than this could be missed."""


@dataclass(frozen=True, kw_only=True)
class CouplingStability:
    """How a Gauss-Seidel coupling with held force amplifies small disturbances.

    Attributes
    ----------
    macro_step : float [s]
    spectral_radius : float [1]
        Largest growth per macro step; stable below 1.
    eigenvalue : complex [1]
        The eigenvalue of that size: near the negative real axis it chatters from step to step, off it the
        delay of the held force drives a whirl.
    """

    macro_step: float
    spectral_radius: float
    eigenvalue: complex


@dataclass(frozen=True, kw_only=True)
class CriticalMacroStep:
    """The longest macro step of a Gauss-Seidel coupling with held force, or why there is none.

    Attributes
    ----------
    macro_step : float or None [s]
        The spectral radius passes 1 here for the first time; None where it does not.
    eigenvalue : complex or None [1]
        The eigenvalue that leaves the unit circle.
    growth_rate : float [1/s]
        Largest real part of the eigenvalues of the system without coupling error.
    reason : str
        Empty, or why there is no critical macro step.
    """

    macro_step: float | None
    eigenvalue: complex | None
    growth_rate: float
    reason: str = ""


class _Loop(NamedTuple):
    """dx/dt = A x + B f, f = G C x: the rotor's rates A, the way in B, and the film's feedback G C."""

    A: Array
    B: Array
    feedback: Array


def coupling_stability(
    rotor: Dynamic, reaction: Model, *, state: ArrayLike, macro_step: float, time: float = 0.0
) -> CouplingStability:
    """Return the growth per macro step of a Gauss-Seidel coupling with held force, to first order.

    Parameters
    ----------
    rotor : Dynamic
    reaction : Model
        A film without states; connected to the rotor by the names of the signals.
    state : array_like, shape (n_states,)
        State of the rotor, for instance at the static equilibrium.
    macro_step : float [s]
    time : float [s]
        Where the rotor changes with time.

    Raises
    ------
    InputError
        If an argument is out of range, the signals do not fit or the rotor's outputs depend on its inputs.
    FilmContactError, UndefinedDerivativeError
        If the film has no force or no derivative there.
    """
    require_positive("macro_step", macro_step)
    dominant = _dominant(_loop(rotor, reaction, state, time), macro_step)
    return CouplingStability(macro_step=macro_step, spectral_radius=abs(dominant), eigenvalue=dominant)


def critical_macro_step(
    rotor: Dynamic, reaction: Model, *, state: ArrayLike, time: float = 0.0
) -> CriticalMacroStep:
    """Return the macro step at which a Gauss-Seidel coupling with held force becomes unstable.

    Parameters and errors are those of `coupling_stability`.
    """
    loop = _loop(rotor, reaction, state, time)
    rates = np.linalg.eigvals(loop.A + loop.B @ loop.feedback)
    growth = float(rates.real.max())
    if growth >= 0.0:
        return _none(growth, f"the system itself is not stable: it grows at {growth:.6g} 1/s for any step")
    unit = 1.0 / float(np.abs(rates).max())
    count = int(np.log(LONGEST / SHORTEST) / np.log(SEARCH_RATIO)) + 2
    trials = unit * np.geomspace(SHORTEST, LONGEST, count)
    below = trials[0]
    if _excess(below, loop) >= 0.0:
        return _none(growth, f"the coupling is unstable even at a macro step of {below:.3g} s")
    for above in trials[1:]:
        if _excess(above, loop) >= 0.0:
            limit = float(brentq(_excess, below, above, args=(loop,), xtol=1e-12 * above))
            return CriticalMacroStep(macro_step=limit, eigenvalue=_dominant(loop, limit), growth_rate=growth)
        below = above
    return _none(growth, f"the coupling is stable up to a macro step of {below:.3g} s")


def _none(growth: float, reason: str) -> CriticalMacroStep:
    return CriticalMacroStep(macro_step=None, eigenvalue=None, growth_rate=growth, reason=reason)


def _excess(macro_step: float, loop: _Loop) -> float:
    return abs(_dominant(loop, macro_step)) - 1.0


def _dominant(loop: _Loop, macro_step: float) -> complex:
    """Return the largest eigenvalue of the sampled system."""
    n, m = loop.B.shape
    held = np.zeros((n + m, n + m))
    held[:n, :n], held[:n, n:] = loop.A, loop.B
    transition = expm(held * macro_step)[:n]
    eigenvalues = np.linalg.eigvals(transition[:, :n] + transition[:, n:] @ loop.feedback)
    return complex(eigenvalues[np.abs(eigenvalues).argmax()])


def _loop(rotor: Dynamic, reaction: Model, state: ArrayLike, time: float) -> _Loop:
    """Return the linear loop of rotor and film at a state, wired by the names of the signals."""
    x = require_finite("state", state)
    if x.shape != (len(rotor.states),):
        raise InputError(f"state must have shape ({len(rotor.states)},), got {x.shape}")
    motion = indices("rotor must have the outputs", names(rotor.outputs), names(reaction.inputs))
    force = indices("film must have the outputs", names(reaction.outputs), names(rotor.inputs))
    journal = rotor.output(time, x, np.zeros(len(rotor.inputs)))[motion]
    film = reaction.linearization(time, np.zeros(0), journal)
    u = reaction.output(time, np.zeros(0), journal)[force]
    linear = rotor.linearization(time, x, u)
    if np.any(linear.D[motion]):
        raise InputError("rotor must have outputs that its inputs do not reach directly, got a matrix D != 0")
    return _Loop(linear.A, linear.B, film.D[force] @ linear.C[motion])
