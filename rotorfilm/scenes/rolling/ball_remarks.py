"""What the physics of ball bearings leaves out, judged by numbers of a rest."""

from __future__ import annotations

import warnings
from dataclasses import replace

import numpy as np

from ...bearings.rolling import BearingPair, RunningBalls, StaticBalls
from ...errors import RotorfilmError, ValidityWarning
from ...model import Array
from ..remarks import Remark, said
from .ball_rest import Balls, RaceOil, RestingBalls, rest_under, single_of, still, with_single

APART, TOUCHING = 3.0, 1.0
"""Film parameters above which the surfaces are apart, and below which they touch."""

HEAVY = 0.06
"""Centrifugal force over the contact load beyond which balls are not to be taken as static."""

REMARKS = (
    Remark(
        "sliding",
        1.0,
        "sliding: the gyroscopic moment asks for a traction coefficient of {traction:.3g}, and balls slide "
        "beyond about {most_traction:.3g}",
    ),
    Remark(
        "lifted",
        0.0,
        "lift-off: {lifted:.0f} of {all:.0f} balls have left the inner race, or inertia only holds them, in "
        "spite of thrust or preload",
    ),
    Remark("idle_rows", 0.0, "loss of contact: {idle_rows:.0f} of 2 rows carry nothing"),
    Remark(
        "neglected_inertia",
        HEAVY,
        "inertia: the centrifugal force of a ball would be {neglected_inertia:.2g} of the largest contact "
        "load, and static balls have none",
    ),
    Remark(
        "film_parameter",
        TOUCHING,
        "mixed lubrication: the film parameter is {film_parameter:.2g}, below 1 the surfaces touch",
        below=True,
    ),
)
"""What the physics of a ball bearing leaves out, by the numbers of `ball_numbers`."""


def ball_numbers(rest: RestingBalls, oil: RaceOil | None, roughness: float | None) -> dict[str, float]:
    """Return the numbers of a rest that decide on remarks.

    Parameters
    ----------
    rest : RestingBalls
    oil : RaceOil or None
    roughness : float or None [m]

    Returns
    -------
    dict of str to float
        traction : traction coefficient that the gyroscopic moment asks for.
        most_traction : that beyond which balls slide; sliding : the first over it.
        lifted : balls that the rings do not press although thrust or preload should; all : all balls.
        idle_rows : rows of a preloaded pair whose balls are not pressed.
        neglected_inertia : centrifugal force over the largest contact load of static balls; else 0.
        film_parameter : lambda, nan without oil and roughness.
    """
    balls, bearing = rest.balls, rest.bearing
    idle = _idle(rest)
    traction, most = float(balls.traction.max()), bearing.running[0].most_traction
    known = oil is not None and roughness is not None and rest.speed != 0.0
    return {
        "traction": traction,
        "most_traction": most,
        "sliding": traction / most,
        "lifted": float(idle.sum()),
        "all": float(idle.size),
        "idle_rows": float(_idle_rows(bearing, idle)),
        "neglected_inertia": _neglected(bearing, rest),
        "film_parameter": rest.film_parameter(oil, roughness) if known else float("nan"),  # type: ignore[arg-type]
    }


def ball_remarks(
    bearing: Balls, speed: float, load: tuple[float, float], oil: RaceOil | None, roughness: float | None
) -> tuple[str, ...]:
    """Return what is left out and should not be, one line each; that there is no rest where there is none."""
    with warnings.catch_warnings(action="ignore", category=ValidityWarning):
        try:
            rest = rest_under(bearing, load, speed)
        except RotorfilmError as error:
            return (f"rest: none found, {error}",)
        return said(REMARKS, ball_numbers(rest, oil, roughness))


def _presses_all(bearing: Balls) -> bool:
    preloaded = isinstance(bearing, BearingPair) and bearing.approach > 0.0
    return preloaded or (single_of(bearing).separates and bearing.axial_load is not None)


def _idle(rest: RestingBalls) -> Array:
    """Return which balls the rings do not press, where thrust or preload should press all, shape (balls,)."""
    if not _presses_all(rest.bearing):
        return np.zeros(rest.balls.inner_load.size, dtype=bool)
    pressed = still(rest.bearing).loads(rest.displacement).inner_load
    return np.asarray(np.minimum(pressed, rest.balls.inner_load) == 0.0)


def _idle_rows(bearing: Balls, idle: Array) -> int:
    if not isinstance(bearing, BearingPair):
        return 0
    return sum(bool(row.all()) for row in np.split(idle, 2))


def _neglected(bearing: Balls, rest: RestingBalls) -> float:
    """Return the centrifugal force that static balls do not have, over the largest contact load."""
    single = single_of(bearing)
    if not isinstance(single.law, StaticBalls):
        return 0.0
    running = with_single(bearing, replace(single, law=RunningBalls()))
    centrifugal = running.loads(rest.displacement, rest.speed).centrifugal_force.max()
    return float(centrifugal / rest.contact_load)
