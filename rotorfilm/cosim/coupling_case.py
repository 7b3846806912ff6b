"""One rotor and one film to be coupled: runs by any scheme, their error, and what is known beforehand."""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import cached_property
from typing import NamedTuple

import numpy as np

from ..errors import PartialResultError, UndefinedDerivativeError
from ..model import Reaction
from ..rotors import RigidRotor
from ..rotors.force_law import ForceLaw
from .cosim_run import CoSimulation, coupled
from .coupling_loop import coupling_loop, dominant_eigenvalue
from .coupling_motion import Drift, drift, inner_motion, largest, law_forces, propagated
from .coupling_replay import Starting, laws_on, samples_of
from .partners import Partners
from .schemes.explicit import GaussSeidel, Jacobi
from .schemes.implicit import SIExp, SIExp3
from .schemes.scheme import Scheme
from .slaves import InProcessSlave
from .watch import quietly

SCHEMES: tuple[Scheme, ...] = (
    *(GaussSeidel(degree=degree) for degree in range(3)),
    Jacobi(),
    SIExp(),
    SIExp3(),
)
"""Those that are left out cost as much and do less.

Newton's takes twice the calls of SI-exp for a larger error; extrapolation in parallel as many as Gauss-Seidel
for a larger error and a shorter limit, and masters in parallel hold their signals.
"""

PILOTS: tuple[tuple[Scheme, float], ...] = (
    (SIExp3(), math.radians(4.0)),
    (SIExp(), math.radians(4.0)),
    (SIExp(), math.radians(1.0)),
    (SIExp(), math.radians(0.25)),
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


class Pilot(NamedTuple):
    """The run that all others are predicted from.

    Attributes
    ----------
    run : PilotRun
    scheme : Scheme
    macro_angle : float [rad]
    """

    run: PilotRun
    scheme: Scheme
    macro_angle: float


@dataclass(frozen=True, kw_only=True)
class CouplingCase:
    """A rigid rotor and the film or damper under it, from where the rotor starts.

    Parameters
    ----------
    rotor : RigidRotor
        At constant speed.
    reaction : Reaction
        Without states.
    revolutions : float [1]
        Length of a run.
    film : str
        Its name, where it is not that of the scene.
    """

    rotor: RigidRotor
    reaction: Reaction
    revolutions: float
    film: str = ""

    def exchanges(self, angle: float) -> int:
        """Return the number of macro steps [rad] in a run."""
        return math.ceil(2.0 * math.pi * self.revolutions / angle * (1.0 - 1e-12))

    def run(self, scheme: Scheme, angle: float) -> PilotRun:
        """Return a coupled run at a macro step [rad].

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
            outcome = coupled(partners, scheme, angle / speed, 2.0 * math.pi * self.revolutions / speed)
        return PilotRun(outcome, laws)

    def drift(self, run: PilotRun) -> Drift:
        """Return how far a run is off; raises FilmContactError where it is at the wall within a step."""
        own = run.outcome.trajectory
        motion = inner_motion(self.rotor, run.laws, own.position[:, :-1], own.velocity[:, :-1], own.time)
        return drift(self.rotor, self.reaction, run.laws, motion)

    def instability(self, scheme: Scheme, angle: float) -> str:
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
    def errors(self) -> dict[tuple[Scheme, float], float]:
        """Errors of the runs made so far, by scheme and macro step [rad], / clearance."""
        return {}

    def least(self, scheme: Scheme, angle: float) -> float:
        """Return the least error of a scheme at a macro step [rad], by its order from longer ones."""
        met = [(own, error) for (other, own), error in self.errors.items() if other == scheme]
        return max((error * min(1.0, angle / own) ** scheme.order for own, error in met), default=0.0)

    @cached_property
    def pilot(self) -> Pilot:
        """The run that others are predicted from.

        Raises
        ------
        PartialResultError
            If the journal cannot be followed even at the shortest step.
        """
        for scheme, angle in PILOTS[:-1]:
            try:
                return Pilot(self.run(Starting(scheme=scheme), angle), scheme, angle)
            except PartialResultError:
                continue
        scheme, angle = PILOTS[-1]
        return Pilot(self.run(Starting(scheme=scheme), angle), scheme, angle)

    def predicted(self, scheme: Scheme, angle: float) -> float:
        """Return the error that a scheme would have at a macro step [rad], / clearance, were it stable.

        To leading order: the defect of its force law along the motion of the pilot, propagated, and scaled
        by the order of the scheme.
        """
        ratio = angle / self.pilot.macro_angle
        # Long steps fall behind their order where the film is stiff.
        order = scheme.order if ratio < 1.0 else min(scheme.order, 2)
        return float(self._constants[scheme] * ratio**order)

    @cached_property
    def _constants(self) -> dict[Scheme, float]:
        """Errors of all schemes at the pilot's macro step."""
        run = self.pilot.run
        own = run.outcome.trajectory
        samples = samples_of(self.reaction, own, self.rotor.profile.speeds[0])
        whole = 0.999 * min(run.outcome.macro_step, own.time[-1])
        regular = [samples[0], *(each for each in samples if each.time > whole)]
        motion = inner_motion(self.rotor, run.laws, own.position[:, :-1], own.velocity[:, :-1], own.time)
        speed = np.full(motion.position.shape[1:], self.rotor.profile.speeds[0])
        force = self.reaction.force(motion.position, motion.velocity, speed)
        slopes = self.reaction.jacobian(motion.position, motion.velocity, speed)
        found: dict[Scheme, float] = {}
        for scheme in SCHEMES:
            if isinstance(scheme, Jacobi):
                found[scheme] = PARALLEL * found[GaussSeidel(degree=scheme.degree)]
                continue
            # Only parabolas begin with short steps.
            met = samples if isinstance(scheme, GaussSeidel) and scheme.degree > 1 else regular
            defect = force - law_forces(laws_on(met, scheme), motion)
            moved, _ = propagated(self.rotor.mass, motion.dt, slopes, defect)
            found[scheme] = largest(moved, motion.parts) / self.reaction.clearance
        return found
