"""How far a co-simulation of rotor and film is from both as one system: rungs are macro steps."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from ...bearings.journal import JournalBearing
from ...cosim.master import CoSimulation, couple
from ...cosim.slaves import InProcessSlave
from ...linear import equilibrium
from ...rotors import RigidRotor
from ..ladder import DISAGREEMENT, ErrorEstimate, Found, Ladder, Work
from ..validity import journal_remarks
from .march import linear_march

if TYPE_CHECKING:
    from ..scene import Scene

ANGLES = (16.0, 8.0, 4.0, 2.0, 1.0, 0.5, 0.25, 0.125)
"""Macro steps of the rungs [deg], the cheapest first."""

STEP = "macro steps"


@dataclass(frozen=True, kw_only=True)
class CouplingRung:
    """Gauss-Seidel coupling with held force at one macro step, from the rest of the rotor.

    Attributes
    ----------
    bearing : JournalBearing
    rotor : RigidRotor
        At rest in its equilibrium.
    macro_angle : float [rad]
    revolutions : float [1]
    """

    bearing: JournalBearing
    rotor: RigidRotor
    macro_angle: float
    revolutions: float

    @property
    def name(self) -> str:
        """Scheme and macro step."""
        return f"Gauss-Seidel, {math.degrees(self.macro_angle):.4g} deg"

    @property
    def prior(self) -> float:
        """Nothing is known beforehand."""
        return 0.0

    @property
    def macro_step(self) -> float:
        """Time between two exchanges [s]."""
        return self.macro_angle / abs(self.rotor.profile.speeds[0])

    def run(self) -> CoSimulation:
        """Return the coupled run; raises CouplingError where it is no answer."""
        duration = 2.0 * math.pi * self.revolutions / abs(self.rotor.profile.speeds[0])
        partners = InProcessSlave(self.rotor), InProcessSlave(self.bearing)
        return couple(*partners, macro_step=self.macro_step, duration=duration)

    def answer(self, before: Found | None) -> Found:
        """Return the estimated error of the coupled run [clearances]."""
        run = self.run()
        error, doubt = self._error(run)
        return Found(error, {STEP: run.trajectory.time.size - 1}, (error, doubt))

    def estimate(self, found: Found, before: Found | None, tolerance: float) -> ErrorEstimate:
        """Return the error: half of each jump of the held force, propagated by the film's K and C."""
        error, doubt = found.solution
        return ErrorEstimate(error, "jumps of the held force, propagated", doubt=doubt)

    def _error(self, run: CoSimulation) -> tuple[float, str]:
        """Return the largest distance / clearance to the motion without held forces, and why not to trust it.

        Held from t_n on, the force F_n misses F(t) - F_n, on average over the step half of F_(n+1) - F_n.
        That is propagated by m d'' + C d' + K d = defect along the run, and again with the K and C of the
        corrected one.
        """
        trajectory, step = run.trajectory, run.macro_step
        uniform = np.append(True, np.isclose(np.diff(trajectory.time), step, rtol=1e-6))
        q, v = trajectory.position[:, uniform], trajectory.velocity[:, uniform]
        force = np.array([trajectory.signals["force_x"], trajectory.signals["force_y"]])[:, uniform]
        defect = np.zeros_like(force)
        defect[:, 1:] = 0.5 * np.diff(force, axis=1)
        first = self._propagated(q, v, defect, step)
        size = float(np.hypot(*first).max()) / self.bearing.clearance
        moved = q + first
        if not np.hypot(*moved).max() < self.bearing.clearance:
            return size, "the error is larger than the gap"
        rates = np.gradient(first, step, axis=1)
        second = self._propagated(moved, v + rates, defect, step)
        apart = float(np.linalg.norm(second - first)) / max(float(np.linalg.norm(first)), 1e-300)
        doubt = f"the slopes before and after disagree on the error by {apart:.0%}: not linear"
        return float(np.hypot(*second).max()) / self.bearing.clearance, doubt if apart > DISAGREEMENT else ""

    def _propagated(self, q: np.ndarray, v: np.ndarray, defect: np.ndarray, step: float) -> np.ndarray:
        slopes = self.bearing.jacobian(q, v, np.full(q.shape[1], self.rotor.profile.speeds[0]))
        return linear_march(self.rotor.mass, -slopes[:, :2], -slopes[:, 2:4], defect, step)

    def expected(self, done: Work) -> Work:
        """Return the number of macro steps."""
        return {STEP: math.ceil(2.0 * math.pi * self.revolutions / self.macro_angle)}


def coupling_ladder(scene: Scene, quantity: str) -> Ladder:
    """Return the ladder of macro steps."""
    at = equilibrium(scene.bearing, scene.static_load, scene.speed)
    x, y = at.position.tolist()
    built = scene.rotor
    rotor = RigidRotor(
        mass=built.mass,
        speed=scene.speed,
        unbalance=built.unbalance,
        unbalance_angle=built.unbalance_angle,
        gravity=(0.0, 0.0),
        static_force=scene.static_load,
        position=(x, y),
    )
    rungs = tuple(
        CouplingRung(
            bearing=scene.bearing,
            rotor=rotor,
            macro_angle=math.radians(angle),
            revolutions=scene.cosimulation.revolutions,
        )
        for angle in ANGLES
    )
    return Ladder(rungs=rungs, unit="1", remarks=journal_remarks(scene))
