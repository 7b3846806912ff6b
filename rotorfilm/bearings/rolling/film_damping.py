"""How much the oil films of a ball bearing damp slow motions about a rest: little."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from ...errors import InputError, require_kind, require_non_negative, require_number
from ...inputs.kinds import arguments
from ...model import Array
from ...native.layouts.ball_structs import ROW
from ...readable.result import Readable
from .ball_bearing import BallBearing
from .ball_element import BallElement, require_balls
from .ball_films import race_films
from .ball_results import BallRest
from .bearing_pair import BearingPair
from .race_film import RaceFilm


@dataclass(frozen=True, kw_only=True)
class FilmDamping(Readable):
    """Damping of slow motions of a shaft in its ball bearings.

    Attributes
    ----------
    damping : ndarray, shape (5, 5) [N s/m]
        -d(force, moment)/d(rate of x, y, z, tilt_x, tilt_y), in [N s/m], [N s], [N m s/rad]; symmetric.
    planar : ndarray, shape (2, 2) [N s/m]
        Over x and y: z gives way where the bearing has an axial load, all else is held.
    ball_damping : ndarray, shape (balls,) [N s/m]
        Of each ball along its contacts in series; 0 without load.
    damping_time : ndarray, shape (5,) [s]
        c/k: diagonal of the damping over that of the stiffness.
    films : (RaceFilm, RaceFilm)
        Inner and outer film of the most loaded ball, from which the damping of all is taken.
    """

    damping: Array
    planar: Array
    ball_damping: Array
    damping_time: Array
    films: tuple[RaceFilm, RaceFilm]


@arguments
def film_damping(
    bearing: BallElement,
    rest: BallRest,
    *,
    viscosity: float,
    pressure_coefficient: float,
    structural_time: float = 0.0,
) -> FilmDamping:
    """Return the damping of the oil films about a rest, sum of B' c n n' B over contacts.

    Each contact damps by `RaceFilm.slow_damping`, nearly the same at every load; a ball passes its motion to
    both contacts by their stiffness, centrifugal force and gyroscopic moment held.

    Parameters
    ----------
    bearing : BallBearing or BearingPair
    rest : BallRest
        From `bearing.rest(load, speed)`, at a speed other than 0.
    viscosity : float [Pa s]
        At ambient pressure and the temperature of the races.
    pressure_coefficient : float [1/Pa]
        Of the viscosity, d ln mu/dp at ambient pressure.
    structural_time : float [s]
        c/k of everything else, joints and cage, as measured or assumed: this times the stiffness is added,
        none by default. A loss factor eta at an angular frequency omega is eta/omega.

    Raises
    ------
    InputError
        If an argument breaks its rule, or no ball carries.

    Warns
    -----
    ValidityWarning
        If the films are outside of the range of their formula.

    Examples
    --------
    >>> bearing = BallBearing(balls=8, ball_diameter=7.938e-3, pitch_diameter=33.5e-3, contact_angle=0.4363)
    >>> rest = bearing.rest((0.0, 0.0, 300.0, 0.0, 0.0), 1000.0)
    >>> film_damping(bearing, rest, viscosity=0.02, pressure_coefficient=2e-8).damping.shape
    (5, 5)
    """
    require_non_negative("structural_time", structural_time)
    films = films_at(bearing, rest, viscosity, pressure_coefficient)
    blocks, moves = ball_blocks(bearing, rest, films), ball_moves(bearing.rows)
    damping = np.einsum("jai,jab,jbk->ik", moves, blocks, moves)
    damping += 0.5 * structural_time * (rest.stiffness + rest.stiffness.T)
    return FilmDamping(
        damping=damping,
        planar=_planar(damping, rest.stiffness, free=bearing.axial_load is not None),
        ball_damping=np.trace(blocks, axis1=1, axis2=2),
        damping_time=np.diag(damping) / np.diag(rest.stiffness),
        films=films,
    )


def films_at(
    bearing: BallElement, rest: BallRest, viscosity: float, pressure_coefficient: float
) -> tuple[RaceFilm, RaceFilm]:
    """Return the inner and the outer film of the most loaded ball."""
    require_balls(bearing)
    require_kind("rest", rest, BallRest, "a BallRest of the bearing")
    single = bearing.bearing if isinstance(bearing, BearingPair) else bearing
    assert isinstance(single, BallBearing)
    load = float(np.max(rest.balls.inner_load))
    if not load > 0.0 or require_number("speed", rest.speed) == 0.0:
        raise InputError(
            f"rest must have loaded balls and turn, for the films to be there, got a largest load of "
            f"{load!r} N at {rest.speed!r} rad/s"
        )
    if len(rest.balls.inner_load) != int(bearing.rows[:, ROW.index("count")].sum()):
        raise InputError(f"rest must be of the bearing, got one of {len(rest.balls.inner_load)} balls")
    return race_films(
        single,
        load=load,
        speed=rest.speed,
        viscosity=viscosity,
        pressure_coefficient=pressure_coefficient,
    )


def ball_blocks(bearing: BallElement, rest: BallRest, films: tuple[RaceFilm, RaceFilm]) -> Array:
    """Return the damping of each ball over the (axial, radial) motion of its inner groove, (balls, 2, 2)."""
    slow = films[0].slow_damping, films[1].slow_damping
    return np.array(
        [
            slow[0] * np.outer(inner, inner) + slow[1] * np.outer(outer, outer)
            for inner, outer in _passed_on(bearing, rest)
        ]
    )


def ball_moves(rows: Array) -> Array:
    """Return the motion (axial, radial) of the inner groove at each ball per motion of the shaft.

    As `native/rolling/balls.c` has it, shape (balls, 2, 5).
    """
    moves = []
    for row in rows:
        column = dict(zip(ROW, row.tolist(), strict=True))
        side, place, count = column["direction"], column["place"], int(column["count"])
        angle = column["turn"] + 2.0 * np.pi / count * np.arange(count)
        c, s, zero = np.cos(angle), np.sin(angle), np.zeros(count)
        axial = [zero, zero, zero + side, side * column["arm"] * s, -side * column["arm"] * c]
        radial = [c, s, zero, -place * s, place * c]
        moves.append(np.stack([np.stack(axial, axis=-1), np.stack(radial, axis=-1)], axis=1))
    return np.concatenate(moves)


def _passed_on(bearing: BallElement, rest: BallRest) -> Iterator[tuple[Array, Array]]:
    """Yield the approaches of inner and outer contact of each ball per motion of its inner groove, (2,)."""
    balls, still = rest.balls, np.zeros(2)
    reach = np.repeat(bearing.rows[:, [ROW.index("inner"), ROW.index("outer")]], _counts(bearing), axis=0)
    numbers = zip(
        balls.inner_load, balls.outer_load, balls.inner_angle, balls.outer_angle, reach, strict=True
    )
    for inner_load, outer_load, inner_angle, outer_angle, touch in numbers:
        if not inner_load > 0.0:
            yield still, still
            continue
        loads, angles = (inner_load, outer_load), (inner_angle, outer_angle)
        (e_i, k_i), (e_o, k_o) = (
            _contact(contact.stiffness, *one)
            for contact, *one in zip(bearing.contacts, loads, angles, touch, strict=True)
        )
        share = np.linalg.solve(k_i + k_o, k_i)  # motion of the ball per that of the groove
        yield e_i @ (np.eye(2) - share), e_o @ share


def _contact(stiffness: float, load: float, angle: float, touch: float) -> tuple[Array, Array]:
    """Return direction and stiffness (2, 2) of a contact."""
    depth = (load / stiffness) ** (2.0 / 3.0)
    along, across = np.array([np.sin(angle), np.cos(angle)]), np.array([np.cos(angle), -np.sin(angle)])
    stiff = 1.5 * load / depth * np.outer(along, along)
    return along, stiff + load / (touch + depth) * np.outer(across, across)


def _counts(bearing: BallElement) -> list[int]:
    return [int(count) for count in bearing.rows[:, ROW.index("count")]]


def _planar(damping: Array, stiffness: Array, *, free: bool) -> Array:
    """Return the damping over x and y; a free z follows quasi-statically and costs its own damping."""
    to = np.zeros((5, 2))
    back = np.zeros((2, 5))
    to[0, 0] = to[1, 1] = back[0, 0] = back[1, 1] = 1.0
    if free:
        to[2] = -stiffness[2, :2] / stiffness[2, 2]
        back[:, 2] = -stiffness[:2, 2] / stiffness[2, 2]
    return np.asarray(back @ damping @ to)
