"""The stability limit of a coupling: it is stable while the spectral radius of its loop is below 1."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike
from scipy.optimize import brentq

from ..errors import require_positive
from ..inputs.kinds import arguments
from ..model import Dynamic, Model
from ..readable.result import Readable
from .coupling_loop import Loop, coupling_loop, dominant_eigenvalue
from .schemes.explicit import GaussSeidel
from .schemes.scheme import Scheme

SHORTEST = 1e-6
"""Where the search for the limit begins, in reciprocals of the fastest rate of the coupled system."""

LONGEST = 1e3
"""Where the search for the limit ends, in the same unit."""

SEARCH_RATIO = 1.1
"""Ratio of neighboring trial steps: a stable island narrower than this could be missed."""


ROUNDOFF = 1e-12
"""Growth per step that may be roundoff: steps much shorter than the slowest rate have an eigenvalue of 1."""


@dataclass(frozen=True, kw_only=True)
class CouplingStability(Readable):
    """How a coupling amplifies small disturbances.

    Attributes
    ----------
    macro_step : float [s]
    spectral_radius : float [1]
        Largest growth per macro step; stable below 1.
    eigenvalue : complex [1]
        The eigenvalue of that size: near the negative real axis it chatters from step to step, off it the
        delay of the force drives a whirl.
    """

    macro_step: float
    spectral_radius: float
    eigenvalue: complex


@dataclass(frozen=True, kw_only=True)
class CriticalMacroStep(Readable):
    """The longest macro step of a coupling, or why there is none.

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


@arguments
def coupling_stability(
    rotor: Dynamic,
    reaction: Model | Mapping[str, Model],
    *,
    state: ArrayLike,
    macro_step: float,
    scheme: Scheme | None = None,
    time: float = 0.0,
) -> CouplingStability:
    """Return the growth per macro step of a coupling, to first order.

    Parameters
    ----------
    rotor : Dynamic
    reaction : Model, or mapping of station to Model
        Films without states; connected to the rotor by the names of the signals.
    state : array_like, shape (n_states,)
        State of the rotor, for instance at the static equilibrium.
    macro_step : float [s]
    scheme : Scheme, optional
        With macro steps of one length; by default `GaussSeidel()`, which holds the force.
    time : float [s]
        Where the rotor changes with time.

    Raises
    ------
    InputError
        If an argument is out of range, the signals do not fit or the rotor's outputs depend on its inputs.
    FilmContactError, UndefinedDerivativeError
        If a film has no force or no derivative there.
    """
    require_positive("macro_step", macro_step)
    loop = coupling_loop(rotor, reaction, state, time)
    dominant = dominant_eigenvalue(loop, macro_step, scheme or GaussSeidel())
    return CouplingStability(macro_step=macro_step, spectral_radius=abs(dominant), eigenvalue=dominant)


@arguments
def critical_macro_step(
    rotor: Dynamic,
    reaction: Model | Mapping[str, Model],
    *,
    state: ArrayLike,
    scheme: Scheme | None = None,
    time: float = 0.0,
) -> CriticalMacroStep:
    """Return the macro step at which a coupling becomes unstable.

    Parameters and errors are those of `coupling_stability`.
    """
    loop, chosen = coupling_loop(rotor, reaction, state, time), scheme or GaussSeidel()
    rates = np.linalg.eigvals(loop.closed)
    growth = float(rates.real.max())
    if growth >= 0.0:
        return _none(growth, f"the system itself is not stable: it grows at {growth:.6g} 1/s for any step")
    unit = 1.0 / float(np.abs(rates).max())
    count = int(np.log(LONGEST / SHORTEST) / np.log(SEARCH_RATIO)) + 2
    trials = unit * np.geomspace(SHORTEST, LONGEST, count)
    below = trials[0]
    if _excess(below, loop, chosen) >= 0.0:
        return _none(growth, f"the coupling is unstable even at a macro step of {below:.3g} s")
    for above in trials[1:]:
        if _excess(above, loop, chosen) >= 0.0:
            limit = float(brentq(_excess, below, above, args=(loop, chosen), xtol=1e-12 * above))
            eigenvalue = dominant_eigenvalue(loop, limit, chosen)
            return CriticalMacroStep(macro_step=limit, eigenvalue=eigenvalue, growth_rate=growth)
        below = above
    return _none(growth, f"the coupling is stable up to a macro step of {below:.3g} s")


def _none(growth: float, reason: str) -> CriticalMacroStep:
    return CriticalMacroStep(macro_step=None, eigenvalue=None, growth_rate=growth, reason=reason)


def _excess(macro_step: float, loop: Loop, scheme: Scheme) -> float:
    return abs(dominant_eigenvalue(loop, macro_step, scheme)) - 1.0 - ROUNDOFF
