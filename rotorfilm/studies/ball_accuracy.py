"""Error against cost of the models of ball bearings, on random loads and speeds."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import ArrayLike

from ..analysis import VariableCompliance, coefficients, equilibrium, variable_compliance
from ..bearings import rolling
from ..core.errors import InputError, RotorfilmError, require_count, require_finite, require_kind
from ..core.inputs import arguments
from ..core.model import Array
from ..core.port import PlanarReaction, prepared_tangent
from ..core.progress import Report, silent
from ..core.readable import Readable
from .study import Study, StudyCase, StudyModel, StudyResult, run_study, shortest_time, spread, table

SEED, ROUNDS = 1907, 200
VISCOSITY, COEFFICIENT = 0.02, 18e-9
"""Of the oil [Pa s], [1/Pa]."""

PRESSURES, SPEEDS = (0.8e9, 1.8e9), (50.0, 3000.0)
"""Ranges of the largest contact pressure under a share of the load [Pa], and of the speed [rad/s]."""

CLOSED, STATIC, RUNNING, FILMS = "closed form", "static balls", "running balls", "running balls on films"


BALLS = Study(
    name="rolling_ladder",
    solve=lambda model, case: model.law[1],
    quantities=lambda model, case, errors: {
        "model [-]": model.name,
        **spread(errors, "median", "90 %", of=" of K"),
        "states [1]": len(errors),
    },
    costs=lambda study, case, report: (
        (study.solve(model, case), {"force and derivatives [s]": _time(model.law[0])})
        for model in case.models
    ),
)


@arguments
def ball_accuracy(states: int = 40, *, seed: int = SEED, report: Report = silent) -> StudyResult:
    """Return how far the stiffness of each model is from that of running balls on oil films, and its cost.

    Parameters
    ----------
    states : int
        Random loads and speeds of each bearing.
    seed : int
        Seed of the random numbers.
    report : Report
        Of progress.

    Raises
    ------
    InputError
        If an argument breaks its rule.
    """
    require_count("states", states)
    random = np.random.default_rng(seed)
    errors: dict[str, list[float]] = {CLOSED: [], STATIC: [], RUNNING: []}
    bearings = grooved(usual_bearing()), usual_bearing()
    for number in range(2 * states):
        bearing, load, speed = _drawn(bearings[number % 2], random)
        for name, error in _errors(bearing, load, speed).items():
            errors[name].append(error)
        report((number + 1) / (2 * states), "states")
    laws = _laws(bearings[0])
    models = [StudyModel(name=name, family="balls", law=(laws[name], errors[name])) for name in errors]
    reference = f"{FILMS} of {1e3 * VISCOSITY:g} mPa s, those of the most loaded ball"
    conditions = {"states of each bearing [1]": states, "seed [-]": seed, "reference [-]": reference}
    return run_study(BALLS, [StudyCase(models=models)], reference=reference, conditions=conditions)


def _drawn(
    bearing: rolling.BallBearing, random: np.random.Generator
) -> tuple[rolling.BallBearing, tuple[float, float], float]:
    """Return a bearing with its thrust, a radial load [N] and a speed [rad/s]."""
    pressure, speed = (math.exp(random.uniform(*np.log(span))) for span in (PRESSURES, SPEEDS))
    reference = bearing.contacts[0].load_at(pressure) * bearing.balls
    if not bearing.separates:
        return bearing, (0.0, -reference / 5.0), speed
    thrust = reference * math.sin(bearing.free_contact_angle)
    return replace(bearing, axial_load=thrust), (0.0, -0.3 * thrust), speed


def _laws(bearing: rolling.BallBearing) -> dict[str, PlanarReaction]:
    """Return the models of a bearing; the closed form has no contact angle."""
    laws: dict[str, PlanarReaction] = {STATIC: replace(bearing, law=rolling.StaticBalls()), RUNNING: bearing}
    if not bearing.separates:
        laws[CLOSED] = rolling.PalmgrenBalls(balls=bearing.balls, ball_diameter=bearing.ball_diameter)
    return laws


def _errors(bearing: rolling.BallBearing, load: tuple[float, float], speed: float) -> dict[str, float]:
    """Return the errors of the models that have an answer; none where the reference has none."""
    try:
        best = _stiffness(_on_films(bearing, load, speed), load, speed)
    except RotorfilmError:
        return {}
    found = {}
    for name, model in _laws(bearing).items():
        try:
            gap = _stiffness(model, load, speed) - best
        except RotorfilmError:
            continue
        found[name] = float(np.max(np.abs(gap)) / np.max(np.abs(best)))
    return found


def _on_films(bearing: rolling.BallBearing, load: tuple[float, float], speed: float) -> rolling.BallBearing:
    """Return the bearing with the films of its most loaded ball."""
    most = float(balls_under(bearing, load, speed).inner_load.max())
    films = rolling.ball_films(
        bearing, load=most, speed=speed, viscosity=VISCOSITY, pressure_coefficient=COEFFICIENT
    )
    return replace(bearing, films=films)


def _stiffness(model: PlanarReaction, load: Sequence[float], speed: float) -> Array:
    at = equilibrium(model, tuple(load), speed)
    return coefficients(model, at.position, speed).stiffness


def _time(model: PlanarReaction) -> float:
    """Return the shortest time of force and derivatives at one place [s]."""
    tangent, way = prepared_tangent(model), 0.3 * model.clearance
    return shortest_time(lambda: tangent(0.2 * way, -way, 0.0, 0.0, 1000.0), ROUNDS)


# Ball bearings over speed and preload: loads of the balls, contact angles, stiffness, swing.


DISTANCE = 2.5
"""Of the rows of a pair, in ball diameters."""

GROOVE_SHARE = 1.25e-3
"""Radial clearance of the deep groove bearing whose swing is shown, over the ball diameter: 10 um of 8 mm."""


@dataclass(frozen=True, kw_only=True)
class BallCurves(Readable):
    """An angular contact bearing under thrust and radial load, and pairs of it, over speed.

    Attributes
    ----------
    thrust, load : float [N]
        Thrust and load along +z, and along -y.
    speeds : ndarray, shape (n,) [rad/s]
    ball_angle : ndarray, shape (balls,) [rad]
        Where the balls are.
    inner_load, outer_load : ndarray, shape (n, balls) [N]
        Inner load and outer load of their contacts under both loads.
    inner_angle, outer_angle : ndarray, shape (n,) [rad]
        Contact angles under the thrust alone.
    preloads : tuple of float [N]
        Preloads as pairs back to back were clamped.
    running_preload : ndarray, shape (preloads, n) [N]
        Running preload with which the rows of these pairs press each other at speed.
    radial_stiffness, axial_stiffness : ndarray, shape (preloads, n) [N/m]
        Radial stiffness and axial stiffness of these pairs, unloaded.
    swing : VariableCompliance
        Swing of a deep groove bearing with the same balls under the radial load at the highest speed.
    """

    thrust: float
    load: float
    speeds: Array
    ball_angle: Array
    inner_load: Array
    outer_load: Array
    inner_angle: Array
    outer_angle: Array
    preloads: tuple[float, ...]
    running_preload: Array
    radial_stiffness: Array
    axial_stiffness: Array
    swing: VariableCompliance

    def columns(self) -> dict[str, list[object]]:
        """Return the table over speed and preload, headings with units."""
        rows = [
            {
                "speed [rad/s]": speed,
                "inner contact angle under thrust [rad]": self.inner_angle[k],
                "outer contact angle under thrust [rad]": self.outer_angle[k],
                "largest inner load [N]": self.inner_load[k].max(),
                "largest outer load [N]": self.outer_load[k].max(),
                "preload of a pair [N]": preload,
                "running preload [N]": self.running_preload[m, k],
                "radial stiffness of the pair [N/m]": self.radial_stiffness[m, k],
                "axial stiffness of the pair [N/m]": self.axial_stiffness[m, k],
            }
            for m, preload in enumerate(self.preloads)
            for k, speed in enumerate(self.speeds.tolist())
        ]
        return table(rows)


def usual_bearing() -> rolling.BallBearing:
    """Return a hybrid bearing of a spindle: 16 balls of 7.938 mm, 25 deg."""
    return rolling.BallBearing(
        balls=16,
        ball_diameter=7.938e-3,
        pitch_diameter=46.5e-3,
        contact_angle=math.radians(25.0),
        ball_material=rolling.RollingMaterial.silicon_nitride(),
    )


def ball_curves(
    bearing: rolling.BallBearing,
    speeds: ArrayLike,
    *,
    thrust: float = 500.0,
    load: float = 300.0,
    preloads: Sequence[float] = (50.0, 150.0, 400.0),
    report: Report = silent,
) -> BallCurves:
    """Return how an angular contact bearing and pairs of it change with speed.

    Parameters
    ----------
    bearing : BallBearing
        Bearing with a contact angle; how it holds its shaft does not count.
    speeds : array_like, shape (n,) [rad/s]
    thrust, load : float [N]
    preloads : sequence of float [N]
    report : Report
        Of progress.

    Raises
    ------
    InputError
        If an argument breaks its rule.
    EquilibriumError
        If there is no rest at one of the speeds.
    """
    require_kind("bearing", bearing, rolling.BallBearing, "a BallBearing")
    if not bearing.separates:
        raise InputError(f"bearing must have a contact angle, got {bearing.contact_angle!r}")
    grid = np.atleast_1d(require_finite("speeds", speeds))
    pressed = replace(bearing, axial_load=thrust, tilt=(0.0, 0.0))
    both = [balls_under(pressed, (0.0, -load), speed) for speed in grid.tolist()]
    alone = [bearing.rest((0.0, 0.0, thrust, 0.0, 0.0), speed).balls for speed in grid.tolist()]
    report(0.3, "bearing")
    pairs = [
        rolling.back_to_back(bearing, distance=DISTANCE * bearing.ball_diameter, preload=one)
        for one in preloads
    ]
    still = np.zeros(5)
    stiffness = np.array([[pair.stiffness(still, speed) for speed in grid.tolist()] for pair in pairs])
    report(0.7, "pairs")
    return BallCurves(
        thrust=thrust,
        load=load,
        speeds=grid,
        ball_angle=both[0].ball_angle,
        inner_load=np.array([one.inner_load for one in both]),
        outer_load=np.array([one.outer_load for one in both]),
        inner_angle=np.array([one.inner_angle.mean() for one in alone]),
        outer_angle=np.array([one.outer_angle.mean() for one in alone]),
        preloads=tuple(preloads),
        running_preload=np.array([[pair.running_preload(s) for s in grid.tolist()] for pair in pairs]),
        radial_stiffness=stiffness[:, :, 1, 1],
        axial_stiffness=stiffness[:, :, 2, 2],
        swing=variable_compliance(grooved(bearing), (0.0, -load), float(grid.max())),
    )


def balls_under(bearing: rolling.BallBearing, load: tuple[float, float], speed: float) -> rolling.BallLoads:
    """Return the balls of a bearing under a radial load [N], with tilts held, and z as the bearing says."""
    place = equilibrium(bearing, load, speed).position
    return bearing.loads((*place, bearing.axial_place(place, speed), *bearing.tilt), speed)


def grooved(bearing: rolling.BallBearing) -> rolling.BallBearing:
    """Return a deep groove bearing with the same balls and races."""
    clearance = GROOVE_SHARE * bearing.ball_diameter
    return replace(bearing, contact_angle=None, internal_clearance=clearance, axial_load=None)
