"""Limits of steps in time: a rigid rotor on the film of a journal bearing.

The time steps are those of the linearized system, which is what limits them: its shortest time constant is
1 / |largest eigenvalue|, mass / damping of the film for a light rotor. For the macro step the spectral radius
of the sampled system, `cosim.critical_macro_step`, at the mass that makes speed^2 clearance mass / load the
number in the name.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator

import numpy as np
from scipy.linalg import expm

from ...bearings.journal import MapFilm
from ...cosim import critical_macro_step
from ...linear import coefficients
from ...model import Array
from ..coupling.coupling_setup import resting_rotor
from ..journal.journal_states import SPEED
from .limit_panels import Curve, panel
from .limits_journal import ECCENTRICITY_RATIOS, bearing

MASS_RATIOS = (0.01, 0.1, 1.0)
"""Speed^2 clearance mass / load of the rotor whose macro step is limited."""

TURNS = 0.25
"""Length of the runs of the time-step panel, in turns of the shaft."""

STEP_MASS, STEP_AT = 0.1, 0.5
"""Speed^2 clearance mass / load and eccentricity ratio of the rotor whose steps are compared."""

LARGEST_ERROR = 1e3
"""Error at which a run that grows without bound is given up."""

SCHEMES: dict[str, Callable[[Array], Array]] = {
    "explicit Euler": lambda Z: np.eye(4) + Z,
    "explicit Runge-Kutta, order 4": lambda Z: (
        np.eye(4) + Z @ (np.eye(4) + Z @ (np.eye(4) + Z @ (np.eye(4) + Z / 4.0) / 3.0) / 2.0)
    ),
    "implicit Euler": lambda Z: np.asarray(np.linalg.inv(np.eye(4) - Z), dtype=float),
    "trapezoidal rule": lambda Z: np.asarray(
        np.linalg.solve(np.eye(4) - 0.5 * Z, np.eye(4) + 0.5 * Z), dtype=float
    ),
}
"""What a step does to the linearized state, by the step times its matrix."""


@panel(
    "rotor",
    "time step, rigid rotor on the film",
    "step / shortest time constant",
    "error of the path / first displacement",
    logarithmic=True,
)
def time_step() -> Iterator[Curve]:
    """Yield what steps of each scheme err by."""
    matrix = _rotor_matrix(STEP_AT, STEP_MASS)
    shortest = 1.0 / float(np.abs(np.linalg.eigvals(matrix)).max())
    whole = TURNS * 2.0 * np.pi / SPEED
    counts = np.unique(np.geomspace(whole / (30.0 * shortest), whole / (0.02 * shortest), 40).astype(int))
    steps = whole / counts[::-1]
    for name, scheme in SCHEMES.items():
        errors = [_step_error(scheme(matrix * step), matrix * step, whole / step) for step in steps.tolist()]
        yield name, steps / shortest, errors


@panel("rotor", "macro step, force held", "eccentricity ratio", "longest stable macro step [deg]", level=None)
def macro_step() -> Iterator[Curve]:
    """Yield the longest macro steps of rotors of several masses."""
    for mass_ratio in MASS_RATIOS:
        steps = [_critical_angle(ratio, mass_ratio) for ratio in ECCENTRICITY_RATIOS]
        yield f"speed^2 c m / W = {mass_ratio:g}", ECCENTRICITY_RATIOS, np.degrees(steps)


def _critical_angle(ratio: float, mass_ratio: float) -> float:
    """Return the critical macro step in shaft rotation [rad]; not-a-number where the rotor whirls anyway."""
    model = bearing(MapFilm())
    rotor = resting_rotor(model, ratio, speed=SPEED, mass_ratio=mass_ratio)
    found = critical_macro_step(rotor, model, state=rotor.initial_state)
    return np.nan if found.macro_step is None else float(found.macro_step) * SPEED


def _rotor_matrix(ratio: float, mass_ratio: float) -> Array:
    """Return A of d/dt (x, y, vx, vy) = A (x, y, vx, vy) about an equilibrium [1/s]; lengths / clearance."""
    model = bearing(MapFilm())
    rotor = resting_rotor(model, ratio, speed=SPEED, mass_ratio=mass_ratio)
    found = coefficients(model, rotor.position, SPEED)
    blocks = [[np.zeros((2, 2)), np.eye(2)], [-found.stiffness / rotor.mass, -found.damping / rotor.mass]]
    return np.block(blocks)


def _step_error(by_scheme: Array, exponent: Array, count: float) -> float:
    """Return the largest error of the position in a run from unit displacement, / that; cut off."""
    exact, state = expm(exponent), np.array([1.0, 0.0, 0.0, 0.0])
    right, worst = state, 0.0
    for _ in range(round(count)):
        state, right = by_scheme @ state, exact @ right
        worst = max(worst, float(np.linalg.norm((state - right)[:2])))
        if worst > LARGEST_ERROR:
            return LARGEST_ERROR
    return worst


PANELS = (time_step, macro_step)
"""Panels of steps in time, in the order in which they are drawn."""
