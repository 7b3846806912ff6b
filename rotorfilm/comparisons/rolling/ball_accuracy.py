"""Error against cost of the models of ball bearings, on random loads and speeds."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace
from time import perf_counter

import numpy as np

from ...bearings.rolling import BallBearing, PalmgrenBalls, StaticBalls, ball_films
from ...errors import RotorfilmError, require_count
from ...inputs.kinds import arguments
from ...linear import coefficients, equilibrium
from ...model import Array, Reaction, prepared_tangent
from ...progress import Report, silent
from ...readable.result import Readable
from .ball_curves import balls_under, grooved, usual_bearing

SEED, ROUNDS = 1907, 200
VISCOSITY, COEFFICIENT = 0.02, 18e-9
"""Of the oil [Pa s], [1/Pa]."""

PRESSURES, SPEEDS = (0.8e9, 1.8e9), (50.0, 3000.0)
"""Ranges of the largest contact pressure under a share of the load [Pa], and of the speed [rad/s]."""

CLOSED, STATIC, RUNNING, FILMS = "closed form", "static balls", "running balls", "running balls on films"


@dataclass(frozen=True, kw_only=True)
class BallModelRung(Readable):
    """Error and cost of one model.

    Attributes
    ----------
    name : str
    median_error, usual_error : float [1]
        Median and 90th percentile of the error of the stiffness, relative to its largest entry.
    states : int
        Where the model has an answer.
    call_time : float [s]
        Of force and derivatives at one place.
    """

    name: str
    median_error: float
    usual_error: float
    states: int
    call_time: float


@dataclass(frozen=True, kw_only=True)
class BallAccuracy(Readable):
    """Error against cost of the models of ball bearings.

    Attributes
    ----------
    states, seed : int
        Of each of two bearings: deep groove under a radial load, angular contact under thrust too.
    reference : str
        What errors are measured against.
    rungs : tuple of BallModelRung
    """

    states: int
    seed: int
    reference: str
    rungs: tuple[BallModelRung, ...]

    def columns(self) -> dict[str, list[object]]:
        """Return the table of the rungs, headings with units; the conditions repeat in every row."""
        rows = [
            {
                "model [-]": rung.name,
                "median error of K [1]": rung.median_error,
                "90 % error of K [1]": rung.usual_error,
                "states [1]": rung.states,
                "force and derivatives [s]": rung.call_time,
                "states of each bearing [1]": self.states,
                "seed [-]": self.seed,
                "reference [-]": self.reference,
            }
            for rung in self.rungs
        ]
        return {heading: [row[heading] for row in rows] for heading in rows[0]}


@arguments
def ball_accuracy(states: int = 40, *, seed: int = SEED, report: Report = silent) -> BallAccuracy:
    """Return how far the stiffness of each model is from that of running balls on oil films, and its cost.

    Parameters
    ----------
    states : int
        Random loads and speeds of each bearing.
    seed : int
        Of the random numbers.
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
    last: dict[str, Reaction] = {
        CLOSED: _closed(bearings[0]),
        STATIC: replace(bearings[0], law=StaticBalls()),
        RUNNING: bearings[0],
    }
    return BallAccuracy(
        states=states,
        seed=seed,
        reference=f"{FILMS} of {1e3 * VISCOSITY:g} mPa s, those of the most loaded ball",
        rungs=tuple(
            BallModelRung(
                name=name,
                median_error=float(np.median(found)),
                usual_error=float(np.quantile(found, 0.9)),
                states=len(found),
                call_time=_time(last[name]),
            )
            for name, found in errors.items()
        ),
    )


def _drawn(
    bearing: BallBearing, random: np.random.Generator
) -> tuple[BallBearing, tuple[float, float], float]:
    """Return a bearing with its thrust, a radial load [N] and a speed [rad/s]."""
    pressure, speed = (math.exp(random.uniform(*np.log(span))) for span in (PRESSURES, SPEEDS))
    reference = bearing.contacts[0].load_at(pressure) * bearing.balls
    if not bearing.separates:
        return bearing, (0.0, -reference / 5.0), speed
    thrust = reference * math.sin(bearing.free_contact_angle)
    return replace(bearing, axial_load=thrust), (0.0, -0.3 * thrust), speed


def _closed(bearing: BallBearing) -> PalmgrenBalls:
    return PalmgrenBalls(balls=bearing.balls, ball_diameter=bearing.ball_diameter)


def _errors(bearing: BallBearing, load: tuple[float, float], speed: float) -> dict[str, float]:
    """Return the errors of the models that have an answer; none where the reference has none."""
    models: dict[str, Reaction] = {STATIC: replace(bearing, law=StaticBalls()), RUNNING: bearing}
    if not bearing.separates:
        models[CLOSED] = _closed(bearing)
    try:
        best = _stiffness(_on_films(bearing, load, speed), load, speed)
    except RotorfilmError:
        return {}
    found = {}
    for name, model in models.items():
        try:
            gap = _stiffness(model, load, speed) - best
        except RotorfilmError:
            continue
        found[name] = float(np.max(np.abs(gap)) / np.max(np.abs(best)))
    return found


def _on_films(bearing: BallBearing, load: tuple[float, float], speed: float) -> BallBearing:
    """Return the bearing with the films of its most loaded ball."""
    most = float(balls_under(bearing, load, speed).inner_load.max())
    films = ball_films(bearing, load=most, speed=speed, viscosity=VISCOSITY, pressure_coefficient=COEFFICIENT)
    return replace(bearing, films=films)


def _stiffness(model: Reaction, load: Sequence[float], speed: float) -> Array:
    at = equilibrium(model, tuple(load), speed)
    return coefficients(model, at.position, speed).stiffness


def _time(model: Reaction) -> float:
    """Return the shortest time of force and derivatives at one place [s]."""
    tangent, way = prepared_tangent(model), 0.3 * model.clearance
    spent = []
    for _ in range(ROUNDS):
        begin = perf_counter()
        tangent(0.2 * way, -way, 0.0, 0.0, 1000.0)
        spent.append(perf_counter() - begin)
    return min(spent)
