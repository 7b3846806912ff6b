"""Error of each coupling scheme against the film calls that it takes."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from typing import Any

import numpy as np

from .. import cosim
from ..analysis import simulate
from ..bearings.journal import JournalBearing, MapFilm, ShortFilm
from ..core.errors import PartialResultError
from ..core.model import Array, Dynamic
from ..core.progress import Report, silent
from ..core.results import Trajectory, orbit_distance
from ..cosim.watch import quietly
from ..rotors.rigid import JeffcottRotor, RigidRotor
from .study import Study, StudyCase, StudyModel, StudyResult, run_study

# What couplings are compared on: the schemes by kind, and a rigid rotor at rest in its bearing.


SPEED = 157.0
"""Angular speed [rad/s]; in dimensionless form nothing depends on it."""


EXPLICIT: tuple[cosim.Scheme, ...] = (
    *(cosim.GaussSeidel(degree=degree) for degree in range(3)),
    *(cosim.Jacobi(degree=degree) for degree in range(3)),
)
"""Schemes with a longest stable macro step."""

MODELS = tuple(
    StudyModel(name=scheme.label, family=scheme.label, law=scheme)
    for scheme in (*EXPLICIT, cosim.SIExp(), cosim.SIExp3(), cosim.Newton())
)
"""All schemes; those that are not explicit are stable where explicit ones are not."""


def resting_rotor(
    bearing: JournalBearing,
    eccentricity_ratio: float,
    *,
    speed: float = SPEED,
    mass_ratio: float = 1.0,
    direction: float = 0.0,
    unbalance_ratio: float = 0.0,
) -> RigidRotor:
    """Return a rigid rotor whose load holds it at rest at a place in its bearing.

    Parameters
    ----------
    bearing : JournalBearing
    eccentricity_ratio : float [1]
    speed : float [rad/s]
    mass_ratio : float [1]
        speed^2 clearance mass / load, the square of the speed parameter.
    direction : float [rad]
        Direction of the eccentricity.
    unbalance_ratio : float [1]
        Unbalance / (mass clearance).
    """
    c = bearing.clearance
    rest = eccentricity_ratio * c * np.array([np.cos(direction), np.sin(direction)])
    load = -bearing.force(rest, (0.0, 0.0), speed)
    mass = mass_ratio * float(np.hypot(*load)) / (speed**2 * c)
    return RigidRotor(
        mass=mass,
        speed=speed,
        unbalance=unbalance_ratio * c * mass,
        gravity=(0.0, 0.0),
        static_force=(float(load[0]), float(load[1])),
        position=(float(rest[0]), float(rest[1])),
    )


# Error of each coupling scheme against the film calls that it takes.


REVOLUTIONS = 2
ECCENTRICITY_RATIO = 0.7
UNBALANCE_RATIO = 0.45
ANGLES = tuple(np.radians([0.5, 1.0, 2.0, 3.0, 5.0, 7.5, 10.0]).tolist())


COUPLING = Study(
    name="cosim_cost",
    solve=lambda model, case: coupled_run(model.law, case.at, case.reference),
    quantities=lambda model, case, columns: {
        "scheme": model.family,
        "macro_angle [deg]": float(np.degrees(case.at)),
        **columns,
    },
)


def coupling_cost(*, macro_angles: Sequence[float] = ANGLES, report: Report = silent) -> StudyResult:
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
    cases = [
        StudyCase(name=f"{np.degrees(angle):.3g} deg", models=MODELS, at=angle, reference=exact)
        for angle in macro_angles
    ]
    largest = float(np.hypot(*exact.position).max()) / bearing.clearance
    notes = {"eccentricity ratio": largest}
    return run_study(COUPLING, cases, reference="monolithic solution", notes=notes, report=report)


def cost_case() -> tuple[RigidRotor, JournalBearing]:
    """Return a rotor with strong unbalance on a map film, from rest at eccentricity ratio 0.7."""
    bearing = JournalBearing(radius=0.05, length=0.05, clearance=1e-4, viscosity=0.05, film=MapFilm())
    rotor = resting_rotor(bearing, ECCENTRICITY_RATIO, unbalance_ratio=UNBALANCE_RATIO)
    return rotor, bearing


def coupled_run(scheme: cosim.Scheme, angle: float, exact: Trajectory) -> dict[str, object]:
    """Return error and work of a scheme at a macro step [rad], by the headings of their columns.

    The error is the largest distance from the monolithic solution / clearance, None for a refused run;
    the work is film evaluations per turn, with the derivatives that the scheme asks for.
    """
    rotor, bearing = cost_case()
    run, refused = _coupled(rotor, bearing, scheme, angle / SPEED, float(exact.time[-1]))
    error = None if refused else orbit_distance(run.trajectory, exact) / bearing.clearance
    turns = max(run.trajectory.work["steps"], 1) * angle / (2.0 * np.pi) if refused else float(REVOLUTIONS)
    return {"orbit_error [1]": error, "film_calls [1/turn]": run.film_calls / turns, "refused": refused}


def _coupled(
    rotor: Dynamic, bearing: JournalBearing, scheme: cosim.Scheme, step: float, duration: float
) -> tuple[Any, str]:
    """Return a coupled run, and why it ended early."""
    slaves = cosim.InProcessSlave(rotor), cosim.InProcessSlave(bearing)
    try:
        with quietly():
            return cosim.couple(*slaves, macro_step=step, duration=duration, scheme=scheme), ""
    except PartialResultError as failure:
        return failure.partial, str(failure)


# How long a macro step each coupling scheme stands: by theory, and by runs of the scheme itself.


SHAFT = 4.0
"""Stiffness of the shaft of the rotor with a light journal, in load / clearance."""

SATURATED = 1e-3
"""Swing of the force, relative to it, where growth may have come to its end."""

DISTURBANCE = 1e-6
"""Of the start from rest, in clearances."""

SETTLED, COUNTED = 40, 40
"""Macro steps that are not counted, and those over which growth is."""


LIMITS = Study(
    name="cosim_limits",
    solve=lambda model, case: _limits(model.law, *case.at),
    quantities=lambda model, case, found: {
        "scheme": model.name,
        "eccentricity_ratio [1]": case.at[0],
        "mass_ratio [1]": case.at[1],
        "critical_macro_angle [deg]": _degrees(found[0]),
        "simulated [deg]": _degrees(found[1]),
    },
)


def coupling_limits(
    *,
    eccentricity_ratios: Sequence[float] = tuple(np.linspace(0.1, 0.95, 18)),
    simulated_at: Sequence[float] = (0.3, 0.5, 0.7, 0.9),
    mass_ratios: Sequence[float] = tuple(np.geomspace(0.005, 0.5, 9)),
    simulated_ratios: Sequence[float] = (0.02, 0.2),
    report: Report = silent,
) -> StudyResult:
    """Return the longest stable macro step of each scheme on a short bearing; None where it has no limit.

    Parameters
    ----------
    eccentricity_ratios, simulated_at : sequence of float [1]
        Where theory is asked, and where the scheme is run; a rigid rotor.
    mass_ratios, simulated_ratios : sequence of float [1]
        The same for a disk on a shaft whose journal has this part of its mass, at eccentricity ratio 0.7.
    report : callable, optional
        Told how far the job is.
    """
    places: list[tuple[float, float, bool]] = [
        *((float(e), 1.0, False) for e in eccentricity_ratios),
        *((float(e), 1.0, True) for e in simulated_at),
        *((ECCENTRICITY_RATIO, float(ratio), False) for ratio in mass_ratios),
        *((ECCENTRICITY_RATIO, float(ratio), True) for ratio in simulated_ratios),
    ]
    cases = [
        StudyCase(
            name=f"eccentricity ratio {e:.2f}, mass ratio {ratio:.3g}", models=MODELS, at=(e, ratio, run)
        )
        for e, ratio, run in places
    ]
    return run_study(LIMITS, cases, reference="linear theory", report=report)


def _limits(
    scheme: cosim.Scheme, eccentricity: float, ratio: float, run: bool
) -> tuple[float | None, float | None]:
    """Return the limit of a scheme by theory [s] and, if asked, that from where a run of it grows."""
    rotor, bearing, state = limit_case(eccentricity, ratio)
    theory = cosim.critical_macro_step(rotor, bearing, state=state, scheme=scheme).macro_step
    return theory, None if theory is None or not run else simulated_limit(rotor, bearing, scheme, theory)


def _degrees(step: float | None) -> float | None:
    return None if step is None else float(np.degrees(step * SPEED))


def limit_case(
    eccentricity: float, ratio: float = 1.0, w: float = 1.0
) -> tuple[Dynamic, JournalBearing, Array]:
    """Return a rotor at rest in a short bearing, the bearing, and the rotor's state.

    Parameters
    ----------
    eccentricity : float [1]
    ratio : float [1]
        1 for a rigid rotor; otherwise the share of the mass that a journal on an elastic shaft has.
    w : float [1]
        Speed parameter.
    """
    bearing = JournalBearing(radius=0.05, length=0.03, clearance=1e-4, viscosity=0.1, film=ShortFilm())
    rigid = resting_rotor(bearing, eccentricity, mass_ratio=w**2)
    if ratio == 1.0:
        return rigid, bearing, rigid.initial_state
    rest, load = np.array(rigid.position), np.array(rigid.static_force)
    # The weight of both masses is the load, so each hangs by its own share.
    pull = load / rigid.mass
    stiffness = SHAFT * float(np.hypot(*load)) / bearing.clearance
    disk = rest + load * (1.0 - ratio) / stiffness
    state = np.array([disk[0], rest[0], disk[1], rest[1], 0.0, 0.0, 0.0, 0.0])
    light = JeffcottRotor(
        mass=(1.0 - ratio) * rigid.mass,
        journal_mass=ratio * rigid.mass,
        stiffness=stiffness,
        speed=SPEED,
        gravity=(float(pull[0]), float(pull[1])),
        initial=tuple(state.tolist()),
    )
    return light, bearing, state


def simulated_limit(
    rotor: Dynamic, bearing: JournalBearing, scheme: cosim.Scheme, theory: float
) -> float | None:
    """Return the macro step from which a small disturbance of a run grows [s]; None if not near `theory`.

    It is searched for within 4 % of the theory, to 0.5 %.
    """
    low, high = 0.96 * theory, 1.04 * theory
    if _growth(rotor, bearing, scheme, low) > 1.0 or _growth(rotor, bearing, scheme, high) < 1.0:
        return None
    while high - low > 5e-3 * theory:
        middle = 0.5 * (low + high)
        grows = _growth(rotor, bearing, scheme, middle) > 1.0
        low, high = (low, middle) if grows else (middle, high)
    return 0.5 * (low + high)


def _growth(rotor: Dynamic, bearing: JournalBearing, scheme: cosim.Scheme, step: float) -> float:
    """Return how much a small alternation of the force grows over some steps, after others."""
    moved = nudged(rotor, DISTURBANCE * bearing.clearance)
    run = _coupled(moved, bearing, scheme, step, (SETTLED + COUNTED) * step)[0].trajectory
    forces = np.stack([run["force_x"], run["force_y"]])
    swing = np.hypot(*np.diff(forces, n=2, axis=1))[SETTLED:]
    half = len(swing) // 2
    if half < COUNTED // 4 or swing[-1] > SATURATED * np.abs(forces).max():
        return np.inf
    return float(np.linalg.norm(swing[half : 2 * half]) / np.linalg.norm(swing[:half]))


def nudged(rotor: Dynamic, distance: float) -> Dynamic:
    """Return the rotor with its journal moved along x [m]."""
    if isinstance(rotor, RigidRotor):
        x, y = rotor.position
        return replace(rotor, position=(x + distance, y))
    assert isinstance(rotor, JeffcottRotor)
    initial = np.array(rotor.initial)
    initial[1] += distance
    return replace(rotor, initial=tuple(initial.tolist()))
