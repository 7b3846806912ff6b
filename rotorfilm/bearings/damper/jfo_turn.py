"""A damper that conserves its oil over a turn of a motion that repeats itself, once its film does so too."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import ClassVar, NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from ...core.errors import (
    ConvergenceError,
    InputError,
    require_count,
    require_inside,
    require_kind,
    require_number,
    require_positive,
    require_vector,
)
from ...core.inputs import arguments
from ...core.model import Array
from ...core.readable import Drawable
from ..films.mass_conserving import ConservedState, circular_gap
from ..films.mass_conserving_steps import after_step, oil_step, remembered
from .jfo_damper import JFODamper, ScaledFilm

FEWEST_STEPS = 24
"""Of a turn: with 96 the force of a damper is within .5 %, with 192 within .2 %."""


@dataclass(frozen=True, eq=False, kw_only=True)
class DamperTurn(Drawable):
    """A damper over one turn of a periodic motion: n equal steps, N lines with M cells each.

    Attributes
    ----------
    time : ndarray, shape (n,) [s]
        From the start of the turn to the end of each step.
    position : ndarray, shape (2, n) [m]
        Of the rotor, at those times.
    force : ndarray, shape (2, n) [N]
        Of the film on the rotor.
    angle : ndarray, shape (N,) [rad]
        Lines, in the bearing frame from +x towards +y.
    axial : ndarray, shape (M,) [m]
        Middles of the cells, from the middle of the damper to its end, or from the groove at its end.
    peak_pressure : ndarray, shape (n,) [Pa]
        Largest gauge pressure of the film.
    oil_content : ndarray, shape (n, N, M) [1]
        Share of the gap that is oil: 1 in the film, less in the cavity.
    side_flow, drawn_in, inflow : float [m3/s]
        Mean of the oil that leaves through open ends, that enters there, and that comes from groove or holes.
    work : float [J]
        What the film takes from the motion in a turn, which becomes heat.
    turns : int
        Turns until film and motion repeated themselves.
    change : float [1]
        Of the force from the last turn but one to the last, over the largest force.
    """

    _shown: ClassVar[tuple[str, ...]] = ("peak_force",)

    time: Array
    position: Array
    force: Array
    angle: Array
    axial: Array
    peak_pressure: Array
    oil_content: Array
    side_flow: float
    drawn_in: float
    inflow: float
    work: float
    turns: int
    change: float

    @property
    def peak_force(self) -> float:
        """Largest force of the turn [N]."""
        return float(np.hypot(*self.force).max())


@arguments
def damper_turn(
    damper: JFODamper,
    position: ArrayLike,
    speed: float,
    *,
    most_turns: int = 40,
    tolerance: float = 1e-6,
) -> DamperTurn:
    """Return the film of a damper over a turn of a motion that repeats itself: any orbit, with any supply.

    It starts from the film of a rotor at rest, which is full, and goes on in steps of second order (BDF2)
    until its force repeats itself.

    Parameters
    ----------
    damper : JFODamper
    position : array_like, shape (2, n) [m]
        Of the rotor at n equal times of a turn, at least 24; 192 are good for .2 % of the force.
    speed : float [rad/s]
        Turns of the motion in 2 pi seconds, positive: with the rotor's unbalance, its speed.
    most_turns : int
        After which to give up.
    tolerance : float [1]
        Change of the force from turn to turn, over the largest force, at which it repeats itself.

    Raises
    ------
    InputError
        If an argument breaks its rule.
    FilmContactError
        If the rotor touches the wall.
    ConvergenceError
        If the film does not repeat itself within `most_turns`; its `partial` is the last turn.

    Warns
    -----
    ValidityWarning
        If ends in air draw in air.

    Notes
    -----
    When the last cell of a cavity fills, its pressure steps: the force scatters there by some per cent of the
    largest on 64 lines, and means and work are good.
    """
    require_kind("damper", damper, JFODamper, "a JFODamper")
    require_positive("speed", require_number("speed", speed))
    require_count("most_turns", most_turns, 2)
    require_positive("tolerance", tolerance)
    q = require_vector("position", position)
    if q.ndim != 2 or q.shape[1] < FEWEST_STEPS:
        raise InputError(f"position must have shape (2, n), n at least {FEWEST_STEPS}, got shape {q.shape}")
    require_inside(q, damper.clearance)
    going_on = _turns(damper.scaled, q, speed)
    turns, change, found = 1, np.inf, next(going_on)
    while change > tolerance and turns < most_turns:
        last, found, turns = found, next(going_on), turns + 1
        change = float(np.abs(found.force - last.force).max() / np.abs(found.force).max())
    result = _result(damper.scaled, found, q, speed, turns, change)
    damper.supply.warn_of_air(result.drawn_in, result.side_flow)
    if change > tolerance:
        raise ConvergenceError(
            f"the film must repeat itself within most_turns {most_turns} to {tolerance:g} of the force, "
            f"got a change of {change:.3g}",
            result,
        )
    return result


class _Rows(NamedTuple):
    """What a turn is made of: force (2, n), pressure (n,), theta (n, N, M) and flows (n, 3) of n steps."""

    force: Array
    pressure: Array
    theta: Array
    flows: Array


def _turns(scaled: ScaledFilm, position: Array, speed: float) -> Iterator[_Rows]:
    """Yield turn after turn of a motion, from a film at rest where it begins and ends."""
    film, gaps = scaled.film, [circular_gap(scaled.film.cells, q / scaled.clearance) for q in position.T]
    dt = 2.0 * np.pi / speed / len(gaps)
    oil = remembered(film.solve(gaps[-1], 0.0))
    while True:
        states: list[ConservedState] = []
        for gap in gaps:
            states.append(oil_step(film, oil, gap, 0.0, dt))
            oil = after_step(oil, states[-1], dt)
        yield _rows(scaled, states)


def _rows(scaled: ScaledFilm, states: list[ConservedState]) -> _Rows:
    flows = [scaled.film.flows(state) for state in states]
    return _Rows(
        force=scaled.force * np.array([scaled.film.force(state) for state in states]).T,
        pressure=scaled.gauge(np.array([state.solution.pressure.max() for state in states])),
        theta=np.minimum([state.solution.theta for state in states], 1.0),
        flows=scaled.oil * np.array([[one.out, one.drawn_in, one.inflow.sum()] for one in flows]),
    )


def _result(
    scaled: ScaledFilm, rows: _Rows, position: Array, speed: float, turns: int, change: float
) -> DamperTurn:
    count, flows = position.shape[1], rows.flows.mean(axis=0).tolist()
    way = position - np.roll(position, 1, axis=1)
    middle = 0.5 * (rows.force + np.roll(rows.force, 1, axis=1))
    return DamperTurn(
        time=2.0 * np.pi / speed / count * np.arange(1, count + 1),
        position=position,
        force=rows.force,
        angle=scaled.film.cells.angle % (2.0 * np.pi),
        axial=scaled.axial,
        peak_pressure=rows.pressure,
        oil_content=rows.theta,
        side_flow=flows[0],
        drawn_in=flows[1],
        inflow=flows[2],
        work=-float(np.sum(middle * way)),
        turns=turns,
        change=change,
    )
