"""Error of each coupling scheme against the film calls that it takes."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from ...bearings.journal import JournalBearing, MapFilm
from ...cosim import CoSimulation, InProcessSlave, Scheme, couple
from ...cosim.watch import quietly
from ...errors import PartialResultError
from ...motion import simulate
from ...progress import Report, silent
from ...readable.result import Readable
from ...results import Trajectory, orbit_distance
from ...rotors.rigid import RigidRotor
from .coupling_setup import SCHEMES, SPEED, SchemeName, resting_rotor

REVOLUTIONS = 2
ECCENTRICITY_RATIO = 0.7
UNBALANCE_RATIO = 0.45
ANGLES = tuple(np.radians([0.5, 1.0, 2.0, 3.0, 5.0, 7.5, 10.0]).tolist())


@dataclass(frozen=True, kw_only=True)
class CostRow(Readable):
    """One run of one scheme.

    Attributes
    ----------
    scheme : SchemeName
    macro_angle : float [rad]
    orbit_error : float or None [1]
        Largest distance from the monolithic solution / clearance; None where the run was refused.
    film_calls : float [1]
        Film evaluations per turn, with the derivatives that the scheme asks for.
    refused : str
        Empty, or why the run is no answer.
    """

    scheme: SchemeName
    macro_angle: float
    orbit_error: float | None
    film_calls: float
    refused: str


@dataclass(frozen=True, kw_only=True)
class CouplingCost(Readable):
    """Runs of all schemes on one orbit.

    Attributes
    ----------
    eccentricity_ratio : float [1]
        Largest one of the orbit.
    rows : tuple of CostRow
        One for each run.
    """

    eccentricity_ratio: float
    rows: tuple[CostRow, ...]

    def columns(self) -> dict[str, list[object]]:
        """Return the table, angles in degrees."""
        return {
            "scheme": [row.scheme for row in self.rows],
            "macro_angle [deg]": [float(np.degrees(row.macro_angle)) for row in self.rows],
            "orbit_error [1]": [row.orbit_error for row in self.rows],
            "film_calls [1/turn]": [row.film_calls for row in self.rows],
            "refused": [row.refused for row in self.rows],
        }


def coupling_cost(*, macro_angles: Sequence[float] = ANGLES, report: Report = silent) -> CouplingCost:
    """Return the errors and the work of all schemes at several macro steps.

    Parameters
    ----------
    macro_angles : sequence of float [rad]
        Each a whole part of a turn.
    report : callable, optional
        Told how far the job is.
    """
    rotor, bearing = cost_case()
    duration = REVOLUTIONS * 2.0 * np.pi / SPEED
    # Schemes that begin with short steps have more points than these.
    starts = [angle / SPEED * (2.0**k - 1.0) / 63.0 for angle in macro_angles for k in range(6)]
    points = np.concatenate(
        [*(np.linspace(0.0, duration, round(duration * SPEED / angle) + 1) for angle in macro_angles), starts]
    )
    exact = simulate(rotor, bearing, duration=duration, times=np.unique(points), rtol=1e-10)
    rows = []
    for number, angle in enumerate(macro_angles):
        for count, scheme in enumerate(SCHEMES):
            done = (number + count / len(SCHEMES)) / len(macro_angles)
            report(done, f"{scheme.label}, {np.degrees(angle):.3g} deg")
            rows.append(_row(rotor, bearing, scheme, angle, exact))
    largest = float(np.hypot(*exact.position).max()) / bearing.clearance
    return CouplingCost(eccentricity_ratio=largest, rows=tuple(rows))


def cost_case() -> tuple[RigidRotor, JournalBearing]:
    """Return a rotor with strong unbalance on a map film, from rest at eccentricity ratio .7."""
    bearing = JournalBearing(radius=0.05, length=0.05, clearance=1e-4, viscosity=0.05, film=MapFilm())
    rotor = resting_rotor(bearing, ECCENTRICITY_RATIO, unbalance_ratio=UNBALANCE_RATIO)
    return rotor, bearing


def _row(
    rotor: RigidRotor, bearing: JournalBearing, scheme: Scheme, angle: float, exact: Trajectory
) -> CostRow:
    try:
        with quietly():
            run = couple(
                InProcessSlave(rotor),
                InProcessSlave(bearing),
                macro_step=angle / SPEED,
                duration=float(exact.time[-1]),
                scheme=scheme,
            )
    except PartialResultError as failure:
        partial: CoSimulation = failure.partial
        turns = max(partial.trajectory.work["steps"], 1) * angle / (2.0 * np.pi)
        error, calls, refused = None, partial.film_calls / turns, str(failure)
    else:
        error = orbit_distance(run.trajectory, exact) / bearing.clearance
        calls, refused = run.film_calls / REVOLUTIONS, ""
    return CostRow(
        scheme=SchemeName(scheme.label),
        macro_angle=angle,
        orbit_error=error,
        film_calls=calls,
        refused=refused,
    )
