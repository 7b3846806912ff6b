"""Good and bad couplings for the monitor: drawn at random, in ranges that were fixed before it was tuned.

A case is a rigid rotor with unbalance on a journal bearing, coupled by some scheme. Good ones keep their
macro step below the local stability limit all along the orbit, by the squeeze damping met on it; bad ones
are past the limit at the static equilibrium already.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from rotorfilm import PartialResultError, RigidRotor, Trajectory
from rotorfilm.bearings.journal import JournalBearing, MapFilm
from rotorfilm.core import orbit_distance
from rotorfilm.core.model import Array
from rotorfilm.cosim import GaussSeidel, InProcessSlave, Scheme, SIExp, SIExp3, couple, critical_macro_step
from rotorfilm.cosim.coupling_loop import coupling_loop
from rotorfilm.studies.coupling_cost import EXPLICIT, SPEED, resting_rotor

TURNS = 3
REFERENCE_ANGLE = np.radians(2.0)

ECCENTRICITY_RATIOS = (0.3, 0.9)
SPEED_PARAMETERS = (0.6, 2.0)
SLENDERNESS = (0.25, 1.0)
UNBALANCE = (0.0, 0.3)
OFFSET = (0.0, 0.05)
GOOD = (0.1, 0.8)
BAD = (1.1, 2.5)
IMPLICIT_ANGLE = (1.0, 8.0)
HIGHEST = 0.95


@dataclass(frozen=True, kw_only=True)
class ComparedCase:
    """One run for the monitor.

    Attributes
    ----------
    rotor : RigidRotor
    bearing : JournalBearing
    scheme : Scheme
    macro_step : float [s]
    bad : bool
        Whether the macro step is past the limit.
    factor : float [1]
        Macro step / limit; of a scheme without one, of Gauss-Seidel with held force.
    reference : Trajectory
        The same motion by SIExp3 at 2 deg.
    """

    rotor: RigidRotor
    bearing: JournalBearing
    scheme: Scheme
    macro_step: float
    bad: bool
    factor: float
    reference: Trajectory

    @property
    def duration(self) -> float:
        """Length of the run [s]."""
        return TURNS * 2.0 * np.pi / SPEED

    def orbit_error(self, trajectory: Trajectory) -> float:
        """Return the largest distance from the reference / clearance, over the time that both cover."""
        return orbit_distance(trajectory, self.reference) / self.bearing.clearance


def coupling_cases(count: int, *, bad: bool, seed: int = 2026) -> list[ComparedCase]:
    """Return so many cases, all good or all bad; the same for the same seed, whatever the count before.

    Parameters
    ----------
    count : int
    bad : bool
    seed : int
    """
    found: list[ComparedCase] = []
    number = 0
    while len(found) < count:
        case = _drawn(np.random.default_rng([seed, int(bad), number]), bad)
        found += [] if case is None else [case]
        number += 1
    return found


def _drawn(random: np.random.Generator, bad: bool) -> ComparedCase | None:
    """Return a case, or None where the draw has no steady motion within the clearance."""
    slenderness, eccentricity, w = (
        random.uniform(*bounds) for bounds in (SLENDERNESS, ECCENTRICITY_RATIOS, SPEED_PARAMETERS)
    )
    unbalance, offset = random.uniform(*UNBALANCE), random.uniform(*OFFSET)
    turn = random.uniform(0.0, 2.0 * np.pi)
    schemes = EXPLICIT if bad else (*EXPLICIT, SIExp(), SIExp3())
    scheme = schemes[random.integers(len(schemes))]
    bearing = JournalBearing(
        radius=0.05, length=0.1 * slenderness, clearance=1e-4, viscosity=0.03, film=MapFilm()
    )
    steady = resting_rotor(bearing, eccentricity, mass_ratio=w**2, direction=turn, unbalance_ratio=unbalance)
    rest = np.array(steady.position)
    start = rest + offset * bearing.clearance * np.array([1.0, 0.0])
    rotor = replace(steady, position=(float(start[0]), float(start[1])))
    share = random.uniform(*(BAD if bad else GOOD))
    angle = np.radians(random.uniform(*IMPLICIT_ANGLE))
    if np.hypot(*start) >= bearing.clearance:
        return None
    return _checked(rotor, bearing, scheme, rest, share, angle, bad)


def _checked(
    rotor: RigidRotor,
    bearing: JournalBearing,
    scheme: Scheme,
    rest: Array,
    share: float,
    angle: float,
    bad: bool,
) -> ComparedCase | None:
    state = np.array([*rest, 0.0, 0.0])
    limited = scheme if scheme in EXPLICIT else GaussSeidel()
    limit = critical_macro_step(rotor, bearing, state=state, scheme=limited).macro_step
    reference = _reference(rotor, bearing)
    if limit is None or reference is None:
        return None
    at_rest = coupling_loop(rotor, bearing, state, 0.0).squeeze_rate
    if not bad:
        limit *= min(1.0, at_rest / _fastest(rotor, bearing, reference))
    step = share * limit if scheme in EXPLICIT else angle / SPEED
    return ComparedCase(
        rotor=rotor,
        bearing=bearing,
        scheme=scheme,
        macro_step=step,
        bad=bad,
        factor=step / limit,
        reference=reference,
    )


def _reference(rotor: RigidRotor, bearing: JournalBearing) -> Trajectory | None:
    """Return the motion, or None where it goes beyond the largest eccentricity ratio."""
    try:
        found = couple(
            InProcessSlave(rotor),
            InProcessSlave(bearing),
            macro_step=REFERENCE_ANGLE / SPEED,
            duration=TURNS * 2.0 * np.pi / SPEED,
            scheme=SIExp3(),
        ).trajectory
    except PartialResultError:
        return None
    return found if np.hypot(*found.position).max() < HIGHEST * bearing.clearance else None


def _fastest(rotor: RigidRotor, bearing: JournalBearing, reference: Trajectory) -> float:
    """Return the largest squeeze rate along a motion [1/s]."""
    states = np.concatenate([reference.position, reference.velocity]).T[::4]
    return max(coupling_loop(rotor, bearing, state, 0.0).squeeze_rate for state in states)
