"""A linear rotor and linear films as a scheme sees them: the loop, and its map from step to step.

A scheme maps what was exchanged at the latest communication points to the next one. With linear partners the
map is a matrix, had by running the scheme itself on a bench of unit disturbances: the rotor moves by its
transition matrices, exactly, and the films answer F = -K q - C v.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace
from functools import lru_cache
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike
from scipy.linalg import expm
from scipy.optimize import brentq

from ..core.errors import InputError, require_finite, require_positive
from ..core.inputs import arguments
from ..core.model import Array, Dynamic, Linearization, Model
from ..core.readable import Readable
from ..core.signals import FORCE_OUTPUTS, JOURNAL_INPUTS, indices, names
from ..rotors.force_law import ForceLaw
from .schemes import GaussSeidel, Newton, PartnerInterface, Sample, Scheme, StationMotion, Tangents
from .slaves import Names, sources, wired

CONVERGED = 1e-11
"""Tolerance of Newton's iteration, which is exact after one correction here."""


class Loop(NamedTuple):
    """dx/dt = A x + B f, q = position x, v = velocity x, f = -K q - C v of all journals.

    Attributes
    ----------
    A, B : ndarray, shape (n, n), (n, m)
    position, velocity : ndarray, shape (m, n)
        Motion of the journals by the states.
    stiffness, damping : ndarray, shape (m, m) [N/m], [N s/m]
        K and C of the films.
    """

    A: Array
    B: Array
    position: Array
    velocity: Array
    stiffness: Array
    damping: Array

    @property
    def closed(self) -> Array:
        """The matrix of the system without coupling error."""
        feedback = self.stiffness @ self.position + self.damping @ self.velocity
        return self.A - self.B @ feedback

    @property
    def squeeze_rate(self) -> float:
        """Largest eigenvalue of the damping over the local mass of the journals [1/s]."""
        return float(np.max(np.linalg.eigvals(self.velocity @ self.B @ self.damping).real))


def coupling_loop(
    rotor: Dynamic, reaction: Model | Mapping[str, Model], state: ArrayLike, time: float
) -> Loop:
    """Return the linear loop of rotor and films at a state, wired by the names of the signals."""
    x = require_finite("state", state)
    if x.shape != (len(rotor.states),):
        raise InputError(f"state must have shape ({len(rotor.states)},), got {x.shape}")
    films = reaction if isinstance(reaction, Mapping) else {"": reaction}
    known = inputs, told = _named(rotor)
    outputs = rotor.output(time, x, np.zeros(len(rotor.inputs)))
    felt = {}
    for station, film in films.items():
        feeds = list(sources(told, station, names(film.inputs)).values())
        felt[station] = outputs[indices("rotor must have the outputs", told, feeds)]
    wiring = wired(known, {station: _named(film) for station, film in films.items()})
    force, position, velocity = wiring.places(inputs, told)
    size = len(force)
    K, C, u = np.zeros((size, size)), np.zeros((size, size)), np.zeros(len(rotor.inputs))
    for number, (station, film) in enumerate(films.items()):
        own = slice(2 * number, 2 * number + 2)
        K[own, own], C[own, own], u[force[own]] = _film_matrices(film, felt[station], time)
    linear: Linearization = rotor.linearization(time, x, u)
    if np.any(linear.D[np.ix_([*position, *velocity], force)]):
        raise InputError(
            "rotor must have outputs that do not depend directly on its inputs, got a matrix D that is not 0"
        )
    return Loop(linear.A, linear.B[:, force], linear.C[position], linear.C[velocity], K, C)


def _named(model: Model) -> Names:
    return names(model.inputs), names(model.outputs)


def _film_matrices(film: Model, journal: Array, time: float) -> tuple[Array, Array, Array]:
    """Return K, C and the force of a film without states at the state of its journal."""
    if film.states:
        raise InputError(f"reaction must have no states for the stability of a coupling, got {film!r}")
    rows = indices("film must have the outputs", names(film.outputs), FORCE_OUTPUTS)
    columns = indices("film must have the inputs", names(film.inputs), JOURNAL_INPUTS[:4])
    D = film.linearization(time, np.zeros(0), journal).D[np.ix_(rows, columns)]
    return -D[:, :2], -D[:, 2:], film.output(time, np.zeros(0), journal)[rows]


def dominant_eigenvalue(loop: Loop, macro_step: float, scheme: Scheme) -> complex:
    """Return the largest eigenvalue of the sampled system."""
    eigenvalues = np.linalg.eigvals(sampled_matrix(loop, macro_step, scheme))
    return complex(eigenvalues[np.abs(eigenvalues).argmax()])


def sampled_matrix(loop: Loop, macro_step: float, scheme: Scheme) -> Array:
    """Return the map of one macro step on (state, two motions before, three latest forces)."""
    n, m = loop.B.shape
    unit = np.eye(n + 7 * m)
    split = np.cumsum([n, 2 * m, 2 * m, m, m])
    x, before, earlier, *forces = np.split(unit, split)
    bench = _LinearPartners(loop, x)
    now = bench.motion()
    motions = [StationMotion(part[:m], part[m:], 0.0, {}) for part in (earlier, before)]
    history = [
        Sample(-k * macro_step, motion, force, bench.tangents, {})
        for k, motion, force in zip((2, 1, 0), (*motions, now), reversed(forces), strict=True)
    ]
    exact = replace(scheme, tolerance=CONVERGED) if isinstance(scheme, Newton) else scheme
    found = exact.step(bench, history, 0.0, macro_step)
    rows = [bench.x, now.position, now.velocity, before, found.force, *forces[:2]]
    return np.concatenate(rows)


class _LinearPartners(PartnerInterface):
    """A linear rotor and linear films under a batch of disturbances (n, batch)."""

    def __init__(self, loop: Loop, x: Array) -> None:
        self._loop, self.x = loop, x
        self.tangents = Tangents(loop.stiffness, loop.damping, np.zeros(len(loop.damping)))

    def motion(self) -> StationMotion:
        """Return the motion at present."""
        return StationMotion(self._loop.position @ self.x, self._loop.velocity @ self.x, 0.0, {})

    def drive(self, t: float, dt: float, law: ForceLaw) -> StationMotion:
        """Advance the rotor exactly."""
        loop = self._loop
        M = loop.A - loop.B @ (law.stiffness @ loop.position + law.damping @ loop.velocity)
        steady = law.force + law.stiffness @ law.position + law.damping @ law.velocity
        free, *driven = self._transition(M, dt)
        powers = (steady, dt * law.slope, 2.0 * dt**2 * law.curvature)
        self.x = free @ self.x + sum(a @ b for a, b in zip(driven, powers, strict=True))
        return self.motion()

    def evaluate(self, t: float, dt: float, motion: StationMotion, derive: bool) -> Sample:
        """Return the forces F = -K q - C v."""
        force = -self._loop.stiffness @ motion.position - self._loop.damping @ motion.velocity
        return Sample(t + dt, motion, force, self.tangents, {})

    def sensitivity(self, t: float, dt: float) -> Array:
        """Return d(motion)/d(held force)."""
        by_force = self._transition(self._loop.A, dt)[1]
        return np.concatenate([self._loop.position @ by_force, self._loop.velocity @ by_force])

    def save(self) -> Array:
        """Return the states."""
        return self.x

    def restore(self, state: Array) -> None:
        """Return to states."""
        self.x = state

    def _transition(self, M: Array, dt: float) -> list[Array]:
        """Return exp(M dt) and what the force, its slope and half its curvature over the step add."""
        n, m = self._loop.B.shape
        chain = np.zeros((n + 3 * m, n + 3 * m))
        chain[:n, :n], chain[:n, n : n + m] = M * dt, self._loop.B * dt
        chain[n : n + 2 * m, n + m :] = np.eye(2 * m)
        return np.split(expm(chain)[:n], [n, n + m, n + 2 * m], axis=1)


@lru_cache(maxsize=32)
def squeeze_limit(scheme: Scheme) -> float:
    """Return the longest macro step on a mass and a damper, times damping / mass [1]; infinite without one.

    2, 1 and 6/11 of Gauss-Seidel with degree 0, 1 and 2: there the scheme is that of Adams and Bashforth.
    """
    one, none = np.eye(1), np.zeros((1, 1))
    loop = Loop(
        np.array([[0.0, 1.0], [0.0, 0.0]]),
        np.array([[0.0], [1.0]]),
        np.array([[1.0, 0.0]]),
        np.array([[0.0, 1.0]]),
        none,
        one,
    )

    def excess(step: float) -> float:
        # The eigenvalue 1 belongs to the free displacement.
        sizes = np.sort(np.abs(np.linalg.eigvals(sampled_matrix(loop, step, scheme))))
        return float(sizes[-1] - 1.0 - 1e-6)

    steps = np.geomspace(0.05, 1e3, 100)
    above = next((step for step in steps if excess(step) >= 0.0), None)
    if above is None:
        return np.inf
    return float(brentq(excess, 0.8 * above, above, xtol=1e-9))


# The stability limit of a coupling: it is stable while the spectral radius of its loop is below 1.


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
    """Return the growth of a coupling per macro step (spectral radius), by linearization.

    Parameters
    ----------
    rotor : Dynamic
    reaction : Model, or mapping of station to Model
        Films without states; connected to the rotor by the names of the signals.
    state : array_like, shape (n_states,)
        State of the rotor, for instance at the static equilibrium.
    macro_step : float [s]
    scheme : Scheme, optional
        Scheme with macro steps of one length; by default `GaussSeidel()`, which holds the force.
    time : float [s]
        Time of the linearization, if the rotor depends on time.

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
