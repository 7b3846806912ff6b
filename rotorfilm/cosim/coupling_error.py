"""One rotor and one film to be coupled: runs by any scheme, their error, and what is known beforehand."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray
from scipy.linalg import expm

from ..core.answers import DISAGREEMENT
from ..core.errors import PartialResultError, UndefinedDerivativeError
from ..core.model import Array
from ..core.port import PlanarReaction
from ..core.results import Trajectory
from ..rotors import RigidRotor
from ..rotors.force_law import ForceLaw
from . import schemes
from .coupling_loop import coupling_loop, dominant_eigenvalue
from .master import CoSimulation, coupled, first_possible
from .partners import Partners
from .slaves import InProcessSlave
from .watch import quietly

SCHEMES: tuple[schemes.Scheme, ...] = (
    *(schemes.GaussSeidel(degree=degree) for degree in range(3)),
    schemes.Jacobi(),
    schemes.SIExp(),
    schemes.SIExp3(),
)
"""Those that are left out cost as much and do less.

Newton's takes twice the calls of SI-exp for a larger error; extrapolation in parallel as many as Gauss-Seidel
for a larger error and a shorter limit, and masters in parallel hold their signals.
"""

PILOTS: tuple[tuple[schemes.Scheme, float], ...] = (
    (schemes.SIExp3(), math.radians(4.0)),
    (schemes.SIExp(), math.radians(4.0)),
    (schemes.SIExp(), math.radians(1.0)),
    (schemes.SIExp(), math.radians(0.25)),
)
"""Scheme and macro step of the run that all others are predicted from; the first that is possible."""

PARALLEL = 3.0
"""Error of Jacobi in that of Gauss-Seidel at the same step, at least.

The film sees the motion held too, so that its force lags by a whole step more, beside the mean lag of half a
step under the held force.
"""

GROWTH = 100.0
"""Growth of a small disturbance over a run beyond which the run need not be made."""


class PilotRun(NamedTuple):
    """A coupled run and the force laws of its macro steps.

    Attributes
    ----------
    outcome : CoSimulation
    laws : list of ForceLaw
    """

    outcome: CoSimulation
    laws: list[ForceLaw]


@dataclass(frozen=True, kw_only=True)
class CouplingCase:
    """A rigid rotor and the film or damper under it, from where the rotor starts.

    Parameters
    ----------
    rotor : RigidRotor
        Rotor at constant speed.
    reaction : PlanarReaction
        Reaction without states.
    revolutions : float [1]
        Length of a run.
    film : str
        Its name, where it is not that of the scene.
    """

    rotor: RigidRotor
    reaction: PlanarReaction
    revolutions: float
    film: str = ""

    def exchanges(self, angle: float) -> int:
        """Return the number of macro steps [rad] in a run."""
        return math.ceil(2.0 * math.pi * self.revolutions / angle * (1.0 - 1e-12))

    def run(self, scheme: schemes.Scheme, angle: float, *, gentle: bool = False) -> PilotRun:
        """Return a coupled run at a macro step [rad]; a gentle start has short steps.

        Raises
        ------
        CouplingError, ContactError, ConvergenceError
            See `cosimulate`.
        """
        speed, films = abs(self.rotor.profile.speeds[0]), {"": InProcessSlave(self.reaction)}
        partners = Partners(InProcessSlave(self.rotor), films, scheme.needs)
        laws: list[ForceLaw] = []
        partners.laws = laws
        with quietly():
            duration = 2.0 * math.pi * self.revolutions / speed
            outcome = coupled(partners, scheme, angle / speed, duration, gentle=gentle)
        return PilotRun(outcome, laws)

    def drift(self, run: PilotRun) -> Drift:
        """Return the error of a run; raises FilmContactError where it is at the wall within a step."""
        return drift(self.rotor, self.reaction, run.laws, self._inner(run))

    def _inner(self, run: PilotRun) -> InnerMotion:
        own = run.outcome.trajectory
        return inner_motion(self.rotor, run.laws, own.position[:, :-1], own.velocity[:, :-1], own.time)

    def instability(self, scheme: schemes.Scheme, angle: float) -> str:
        """Return why a run cannot be stable, by linear theory where the rotor starts; empty if it may be."""
        state, step = self.rotor.initial_state, angle / abs(self.rotor.profile.speeds[0])
        try:
            loop = coupling_loop(self.rotor, self.reaction, state, 0.0)
        except UndefinedDerivativeError:
            return ""  # a damper at rest
        radius = abs(dominant_eigenvalue(loop, step, scheme))
        itself = max(0.0, float(np.linalg.eigvals(loop.closed).real.max())) * step
        if self.exchanges(angle) * (math.log(radius) - itself) < math.log(GROWTH):
            return ""
        return (
            f"a macro step of {step:.3g} s is past the limit: the coupling grows by a factor of {radius:.3g} "
            "per step at rest"
        )

    @cached_property
    def errors(self) -> dict[tuple[schemes.Scheme, float], float]:
        """Errors of the runs made so far, by scheme and macro step [rad], / clearance."""
        return {}

    def least(self, scheme: schemes.Scheme, angle: float) -> float:
        """Return the least error of a scheme at a macro step [rad], by its order from longer ones."""
        met = [(own, error) for (other, own), error in self.errors.items() if other == scheme]
        return max((error * min(1.0, angle / own) ** scheme.order for own, error in met), default=0.0)

    @cached_property
    def pilot(self) -> tuple[PilotRun, float]:
        """The run that others are predicted from, and its macro step [rad].

        It begins with short steps, as parabolas do, so that all schemes find their points in it.

        Raises
        ------
        PartialResultError
            If the journal cannot be followed even at the shortest step.
        """

        def run(scheme: schemes.Scheme, angle: float) -> tuple[PilotRun, float]:
            return self.run(scheme, angle, gentle=True), angle

        return first_possible(run, PILOTS, PartialResultError)

    def predicted(self, scheme: schemes.Scheme, angle: float) -> float:
        """Return the error that a scheme would have at a macro step [rad], / clearance, were it stable.

        To leading order: the defect of its force law along the motion of the pilot, propagated, and scaled
        by the order of the scheme.
        """
        ratio = angle / self.pilot[1]
        # Long steps fall behind their order where the film is stiff.
        order = scheme.order if ratio < 1.0 else min(scheme.order, 2)
        return float(self._constants[scheme] * ratio**order)

    @cached_property
    def _constants(self) -> dict[schemes.Scheme, float]:
        """Errors of all schemes at the pilot's macro step."""
        run = self.pilot[0]
        own = run.outcome.trajectory
        samples = samples_of(self.reaction, own, self.rotor.profile.speeds[0])
        whole = 0.999 * min(run.outcome.macro_step, own.time[-1])
        regular = [samples[0], *(each for each in samples if each.time > whole)]
        motion = self._inner(run)
        speed = np.full(motion.position.shape[1:], self.rotor.profile.speeds[0])
        force = self.reaction.force(motion.position, motion.velocity, speed)
        slopes = self.reaction.jacobian(motion.position, motion.velocity, speed)
        found: dict[schemes.Scheme, float] = {}
        for scheme in SCHEMES:
            if isinstance(scheme, schemes.Jacobi):
                found[scheme] = PARALLEL * found[schemes.GaussSeidel(degree=scheme.degree)]
                continue
            # Only parabolas begin with short steps.
            met = samples if isinstance(scheme, schemes.GaussSeidel) and scheme.degree > 1 else regular
            defect = force - law_forces(laws_on(met, scheme), motion)
            moved, _ = propagated(self.rotor.mass, motion.dt, slopes, defect)
            found[scheme] = largest(moved, motion.parts) / self.reaction.clearance
        return found


# Schemes on a motion known beforehand: the force laws that they would have there.


class _Replay(schemes.PartnerInterface):
    """A scheme is given a motion known beforehand, to see its force law."""

    def __init__(self, following: schemes.Sample) -> None:
        self._following = following
        self.law: ForceLaw | None = None

    def drive(self, t: float, dt: float, law: ForceLaw) -> schemes.StationMotion:
        """Keep the law; the motion is the known one."""
        self.law = law
        return self._following.motion

    def evaluate(self, t: float, dt: float, motion: schemes.StationMotion, derive: bool) -> schemes.Sample:
        """Return the known forces."""
        return self._following


def samples_of(reaction: PlanarReaction, run: Trajectory, speed: float) -> list[schemes.Sample]:
    """Return the communication points of a motion at constant speed [rad/s], with the films' derivatives."""
    time, q, v = run.time, run.position, run.velocity
    forces = reaction.force(q, v, np.full(time.size, speed))
    try:
        slopes = reaction.jacobian(q, v, np.full(time.size, speed))
    except UndefinedDerivativeError:  # a damper at rest, where the schemes too go without
        moving = reaction.jacobian(q[:, 1:], v[:, 1:], np.full(time.size - 1, speed))
        slopes = np.concatenate([np.zeros((2, 5, 1)), moving], axis=2)
    return [
        schemes.Sample(
            float(time[n]),
            schemes.StationMotion(q[:, n], v[:, n], speed, {}),
            forces[:, n],
            schemes.Tangents(-slopes[:, :2, n], -slopes[:, 2:4, n], slopes[:, 4, n]),
            {},
        )
        for n in range(time.size)
    ]


def laws_on(samples: Sequence[schemes.Sample], scheme: schemes.Scheme) -> list[ForceLaw]:
    """Return the force laws of a scheme on a known motion."""
    laws = []
    for n in range(len(samples) - 1):
        bench, now = _Replay(samples[n + 1]), samples[n]
        length = samples[n + 1].time - now.time
        scheme.step(bench, samples[max(0, n + 1 - schemes.MEMORY) : n + 1], now.time, length)
        assert bench.law is not None  # every scheme drives the rotor
        laws.append(bench.law)
    return laws


# What a coupled run of a rigid rotor misses within its macro steps, and how far that carries the
# journal.
#
# Over a macro step the rotor moves under a force law in place of the film. That motion q(t) is known
# exactly, and so is the defect of the law along it, F(q, q') - law. The distance d to the motion of
# rotor and film as one system obeys, to first order,
#
# m d'' + C(t) d' + K(t) d = defect
#
# with K and C of the film along the run, whatever the scheme.


NODES = np.array([(4.0 - np.sqrt(6.0)) / 10.0, (4.0 + np.sqrt(6.0)) / 10.0, 1.0])
"""Of Radau's method with three stages, in steps (Hairer & Wanner 1996, IV.5): order 5, L-stable."""

_POWERS = np.vander(NODES, increasing=True)
STAGES = NODES[:, None] * _POWERS / np.arange(1.0, 4.0) @ np.linalg.inv(_POWERS)
"""Its matrix: integrals from 0 to each node of the polynomials that are 1 at one node and 0 at the others."""

STEP_ANGLE = np.radians(5.4)
"""Longest step of the propagation, as an angle of the shaft."""

APART = np.radians(4.0)
"""Largest distance of the states at which the film is asked, as an angle of the shaft."""

BEGINNING = 24
"""Steps at the beginning of a run, where a sudden load is answered, of which none is left out."""

NEGLIGIBLE = 0.03
"""Change by the first mean of slopes below which no better mean is needed."""

LARGE = "the error is larger than the gap"


class InnerMotion(NamedTuple):
    """A coupled run at the nodes of n steps, each an equal part of a macro step.

    Attributes
    ----------
    start, dt : ndarray, shape (n,) [s]
        Where the steps begin, and their lengths.
    parts : int
        Steps in a macro step.
    position, velocity : ndarray, shape (2, n, 3) [m], [m/s]
    """

    start: Array
    dt: Array
    parts: int
    position: Array
    velocity: Array


class Drift(NamedTuple):
    """How far a coupled run is from rotor and film as one system.

    Attributes
    ----------
    error : float [1]
        Largest distance at the communication points / clearance.
    doubt : str
        Why not to trust it, or empty.
    states : int
        States of the film that were evaluated, in batches.
    """

    error: float
    doubt: str
    states: int


def inner_motion(
    rotor: RigidRotor, laws: Sequence[ForceLaw], position: Array, velocity: Array, time: Array
) -> InnerMotion:
    """Return the motion within macro steps, each under its law from where the run was at its start.

    Rotor, law and unbalance are linear with constant coefficients there, so that one matrix exponential
    carries (q, v, F, F', F''/2, cos, sin) from node to node exactly.

    Parameters
    ----------
    rotor : RigidRotor
        Rotor at constant speed.
    laws : sequence of ForceLaw, length n
        Each starts at its communication point.
    position, velocity : ndarray, shape (2, n) [m], [m/s]
        Position and velocity at the starts.
    time : ndarray, shape (n + 1,) [s]
        Communication points.
    """
    speed, length = rotor.profile.speeds[0], np.diff(time)
    parts = max(1, int(np.ceil(abs(speed) * float(length.max()) / STEP_ANGLE - 1e-9)))
    dt = length / parts
    units = np.stack([dt**0, dt, dt**2 / rotor.mass, dt**3 / rotor.mass, dt**4 / rotor.mass])
    state = _start(rotor, laws, position, velocity, time[:-1], units)
    rates, which = _rates(rotor, laws, dt)
    moves = [expm(node * rates) for node in NODES]
    found = np.empty((len(dt), parts, 3, 12))
    for part in range(parts):
        for k, move in enumerate(moves):
            found[:, part, k] = np.einsum("nij,nj->ni", move[which], state)
        state = found[:, part, -1]
    steps = np.repeat(dt, parts)
    q, v = (found[..., k : k + 2].reshape(-1, 3, 2).transpose(2, 0, 1) for k in (0, 2))
    begin = (time[:-1, None] + np.arange(parts) * dt[:, None]).ravel()
    return InnerMotion(begin, steps, parts, q, v / steps[:, None])


def law_forces(laws: Sequence[ForceLaw], motion: InnerMotion) -> Array:
    """Return the forces of laws along a motion, each from its start to that of the next, (2, n, 3) [N]."""
    starts = np.array([law.start for law in laws])
    which = np.searchsorted(starts, motion.start + 0.5 * motion.dt) - 1
    elapsed = (motion.start - starts[which])[:, None] + NODES * motion.dt[:, None]
    # Each field of the laws for each step, components first.
    value, slope, curvature, K, C, q, v = (
        np.moveaxis(np.asarray(each)[which], 0, -1)[..., None] for each in tuple(zip(*laws, strict=True))[1:]
    )
    pull = np.einsum("ijnk,jnk->ink", K, motion.position - q)
    pull += np.einsum("ijnk,jnk->ink", C, motion.velocity - v)
    return np.asarray(value + elapsed * (slope + elapsed * curvature) - pull)


def _start(
    rotor: RigidRotor, laws: Sequence[ForceLaw], q: Array, v: Array, time: Array, units: Array
) -> Array:
    """Return (q, v, F, F', F''/2, cos, sin) at the starts, times their units, shape (n, 12)."""
    constant = [
        law.force + law.stiffness @ law.position + law.damping @ law.velocity + rotor.static_load
        for law in laws
    ]
    series = (q.T, v.T, constant, [law.slope for law in laws], [law.curvature for law in laws])
    angle = rotor.profile.speeds[0] * time + rotor.unbalance_angle
    parts = [np.asarray(each) * unit[:, None] for each, unit in zip(series, units, strict=True)]
    return np.concatenate([*parts, np.cos(angle)[:, None], np.sin(angle)[:, None]], axis=1)


def _rates(rotor: RigidRotor, laws: Sequence[ForceLaw], dt: Array) -> tuple[Array, NDArray[np.intp]]:
    """Return the different matrices of the rates, per step, and which one belongs to each macro step."""
    longest, speed = dt.max(), rotor.profile.speeds[0]
    near = np.round(dt / longest, 9) * longest  # times are multiples of the macro step but for roundoff
    rows = [np.concatenate([law.stiffness.ravel(), law.damping.ravel()]) for law in laws]
    unique, which = np.unique(np.column_stack([near, rows]), axis=0, return_inverse=True)
    step, K, C = unique[:, 0], unique[:, 1:5].reshape(-1, 2, 2), unique[:, 5:].reshape(-1, 2, 2)
    M = np.zeros((len(unique), 12, 12))
    M[:, :2, 2:4] = M[:, 2:4, 4:6] = M[:, 4:6, 6:8] = np.eye(2)
    M[:, 6:8, 8:10] = 2.0 * np.eye(2)
    M[:, 2:4, :2] = -K * (step**2)[:, None, None] / rotor.mass
    M[:, 2:4, 2:4] = -C * step[:, None, None] / rotor.mass
    M[:, 2, 10] = M[:, 3, 11] = rotor.unbalance * (speed * step) ** 2 / rotor.mass
    M[:, 10, 11], M[:, 11, 10] = -speed * step, speed * step
    return M, which.ravel()


def drift(
    rotor: RigidRotor, reaction: PlanarReaction, laws: Sequence[ForceLaw], motion: InnerMotion
) -> Drift:
    """Return the error of a coupled run.

    The force of the film changes from the run to the true motion by its mean slopes between them. These are
    first those along the run, then half the sum of those at both ends and, if this changed the result,
    Simpson's rule. Where the last two disagree, they are not to be trusted.

    Raises
    ------
    FilmContactError
        If the run reaches the wall between two communication points.
    """
    clearance = reaction.clearance
    turned = abs(rotor.profile.speeds[0]) * motion.dt
    taken = _taken(turned)
    q, v = motion.position[:, taken], motion.velocity[:, taken]
    speed, states = np.full(q.shape[1:], rotor.profile.speeds[0]), q[0].size

    def slopes(part: float, moved: Array, rates: Array) -> Array:
        near = q + part * moved[:, taken], v + part * rates[:, taken]
        return _everywhere(reaction.jacobian(*near, speed), taken, len(turned))

    defect = reaction.force(q, v, speed) - law_forces(laws, motion)[:, taken]
    defect = _everywhere(defect, taken, len(turned))
    own = slopes(0.0, motion.position, motion.velocity)
    first = propagated(rotor.mass, motion.dt, own, defect)
    if not np.hypot(*(motion.position + first[0])).max() < clearance:
        return Drift(largest(first[0], motion.parts) / clearance, LARGE, 2 * states)
    second = propagated(rotor.mass, motion.dt, 0.5 * (own + slopes(1.0, *first)), defect)
    if not np.hypot(*(motion.position + second[0])).max() < clearance:
        return Drift(largest(second[0], motion.parts) / clearance, LARGE, 3 * states)
    if _apart(first[0], second[0]) < NEGLIGIBLE:
        return Drift(largest(second[0], motion.parts) / clearance, "", 3 * states)
    mean = (own + 4.0 * slopes(0.5, *second) + slopes(1.0, *second)) / 6.0
    best, _ = propagated(rotor.mass, motion.dt, mean, defect)
    apart = _apart(second[0], best)
    doubt = f"mean slopes of the film disagree on the error by {apart:.0%}: not linear"
    return Drift(largest(best, motion.parts) / clearance, doubt if apart > DISAGREEMENT else "", 5 * states)


def _apart(first: Array, second: Array) -> float:
    """Return how far two motions are apart, relative to the second."""
    return float(np.linalg.norm(second - first)) / max(float(np.linalg.norm(second)), 1e-300)


def _taken(turned: Array) -> NDArray[np.intp]:
    """Return which steps are evaluated, by the angles that they turn: an odd one, lest it hides a chatter."""
    every = int(APART / float(turned.max()) + 1e-9)
    every = max(1, every - 1 + every % 2)
    count = len(turned)
    later = np.arange(min(BEGINNING, count), count, every)
    return np.unique(np.concatenate([np.arange(min(BEGINNING, count)), later, [count - 1]]))


def _everywhere(values: Array, taken: NDArray[np.intp], count: int) -> Array:
    """Return values (..., n taken, 3) at all steps (..., count, 3), linear in between."""
    if len(taken) == count:
        return values
    right = np.clip(np.searchsorted(taken, np.arange(count)), 1, len(taken) - 1)
    share = (np.arange(count) - taken[right - 1]) / (taken[right] - taken[right - 1])
    return np.asarray(
        values[..., right - 1, :] + share[:, None] * (values[..., right, :] - values[..., right - 1, :])
    )


def largest(moved: Array, parts: int) -> float:
    """Return the largest distance at the ends of macro steps [m]."""
    return float(np.hypot(*moved[:, parts - 1 :: parts, -1]).max())


def propagated(mass: float, dt: Array, slopes: Array, pull: Array) -> tuple[Array, Array]:
    """Return q and q' of m q'' + C q' + K q = pull, from rest, at the nodes of all steps.

    Parameters
    ----------
    mass : float [kg]
    dt : ndarray, shape (n,) [s]
    slopes : ndarray, shape (2, 5, n, 3)
        -K, -C and the derivative by the speed, which does not count.
    pull : ndarray, shape (2, n, 3) [N]

    Returns
    -------
    q, rates : ndarray, shape (2, n, 3) [m], [m/s]
    """
    unit, count = float(dt.max()), len(dt)
    h = (dt / unit)[:, None, None]
    J = np.zeros((count, 3, 4, 4))
    J[:, :, :2, 2:] = np.eye(2)
    J[:, :, 2:, :2] = slopes[:, :2].transpose(2, 3, 0, 1) * (unit**2 / mass)
    J[:, :, 2:, 2:] = slopes[:, 2:4].transpose(2, 3, 0, 1) * (unit / mass)
    given = np.zeros((count, 3, 4))
    given[:, :, 2:] = pull.transpose(1, 2, 0) * (unit**2 / mass)
    stages = np.eye(12) - h * np.einsum("ij,njab->niajb", STAGES, J).reshape(count, 12, 12)
    known = np.concatenate(
        [np.tile(np.eye(4), (count, 3, 1)), (h * (STAGES @ given)).reshape(count, 12, 1)], axis=2
    )
    solved = np.linalg.solve(stages, known)
    carry, added = solved[:, 8:, :4], solved[:, 8:, 4]
    starts = np.zeros((count, 4))
    state = starts[0]
    for n in range(count - 1):
        state = carry[n] @ state + added[n]
        starts[n + 1] = state
    nodes = (np.einsum("nij,nj->ni", solved[:, :, :4], starts) + solved[:, :, 4]).reshape(count, 3, 4)
    moved = nodes.transpose(2, 0, 1)
    return moved[:2], moved[2:] / unit
