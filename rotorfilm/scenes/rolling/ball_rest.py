"""A shaft at rest in ball bearings: where it is, what each ball carries, and what follows from that."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from typing import NamedTuple

import numpy as np

from ...bearings.rolling import (
    BallBearing,
    BallLoads,
    BearingPair,
    StaticBalls,
    ball_films,
    film_parameter,
)
from ...errors import InputError, RotorfilmError
from ...linear import equilibrium
from ...model import Array

Balls = BallBearing | BearingPair

STEPS, EXACT = 3, 1e-9
"""Newton steps by which a richer law moves a rest, and the share of the load that may be left of it."""


class RaceOil(NamedTuple):
    """The oil on the races.

    Attributes
    ----------
    viscosity : float [Pa s]
        At ambient pressure and the temperature of the races.
    pressure_coefficient : float [1/Pa]
    """

    viscosity: float
    pressure_coefficient: float


@dataclass(frozen=True, kw_only=True)
class RestingBalls:
    """A shaft at rest, or nearly so, in a bearing.

    Attributes
    ----------
    bearing : BallBearing or BearingPair
    position : ndarray, shape (2,) [m]
    displacement : ndarray, shape (5,) [m]
        x, y, z [m], tilt_x, tilt_y [rad].
    speed : float [rad/s]
    force : ndarray, shape (2,) [N]
        On the shaft.
    stiffness : ndarray, shape (2, 2) [N/m]
        Over x and y; z gives way where there is an axial load.
    axial_stiffness : float [N/m]
        Over z, with x, y and tilts held.
    balls : BallLoads
    """

    bearing: Balls
    position: Array
    displacement: Array
    speed: float
    force: Array
    stiffness: Array
    axial_stiffness: float
    balls: BallLoads

    @property
    def most_loaded(self) -> int:
        """Which ball presses most on the inner ring."""
        return int(np.argmax(self.balls.inner_load))

    @property
    def contact_load(self) -> float:
        """Largest load of a contact [N]."""
        return float(max(self.balls.inner_load.max(), self.balls.outer_load.max()))

    @property
    def contact_angle(self) -> float:
        """Inner contact angle of the most loaded ball [rad]."""
        return float(self.balls.inner_angle[self.most_loaded])

    @property
    def relative_film(self) -> float:
        """Both films over the approach of both contacts, at the mean load of the balls that carry [1]."""
        single = single_of(self.bearing)
        carrying = self.balls.inner_load > 0.0
        means = [float(loads[carrying].mean()) for loads in (self.balls.inner_load, self.balls.outer_load)]
        approach = sum(one.approach(load) for one, load in zip(single.contacts, means, strict=True))
        return sum(single.films) / approach

    def film_parameter(self, oil: RaceOil, roughness: float) -> float:
        """Return lambda [1], the smallest film thickness over the roughness [m]."""
        return film_parameter(
            single_of(self.bearing), self.balls, speed=self.speed, **oil._asdict(), roughness=roughness
        )


def single_of(bearing: Balls) -> BallBearing:
    """Return a bearing itself, or one of a pair."""
    return bearing.bearing if isinstance(bearing, BearingPair) else bearing


def with_single(bearing: Balls, single: BallBearing) -> Balls:
    """Return a bearing, or a pair, made of another single bearing."""
    return replace(bearing, bearing=single) if isinstance(bearing, BearingPair) else single


def rest_at(bearing: Balls, position: Array, speed: float) -> RestingBalls:
    """Return what the balls of a shaft at a position (2,) [m] do, z and tilts as the bearing says."""
    x, y = position.tolist()
    tangent = bearing.prepare_tangent()
    *force, slopes = tangent(x, y, 0.0, 0.0, speed)
    displacement = np.array([x, y, bearing.axial_place(position, speed), *bearing.tilt])
    return RestingBalls(
        bearing=bearing,
        position=position,
        displacement=displacement,
        speed=speed,
        force=np.array(force),
        stiffness=-np.array(slopes).reshape(2, 5)[:, :2],
        axial_stiffness=float(bearing.stiffness(displacement, speed)[2, 2]),
        balls=bearing.loads(displacement, speed),
    )


def rest_under(bearing: Balls, load: tuple[float, float], speed: float) -> RestingBalls:
    """Return the equilibrium under a load [N], sought from that of static balls, or without one the center.

    Raises
    ------
    InputError
        If there is no load, and thrust or preload do not center the shaft.
    """
    free = not any(load)
    try:
        place = np.zeros(2) if free else equilibrium(still(bearing), load, speed).position
        near = rest_at(still(bearing), place, speed)
        found, left = moved_to(bearing, near, load)
    except RotorfilmError:
        left = math.inf
    if free and not left <= EXACT:
        raise InputError(
            "load must not be zero for balls that neither thrust nor preload centers, got [0, 0]"
        )
    return found if left <= EXACT else rest_at(bearing, equilibrium(bearing, load, speed).position, speed)


def still(bearing: Balls) -> Balls:
    """Return a bearing with static balls."""
    return with_single(bearing, replace(single_of(bearing), law=StaticBalls()))


def moved_to(bearing: Balls, near: RestingBalls, load: tuple[float, float]) -> tuple[RestingBalls, float]:
    """Return where a richer law takes a rest, by Newton steps, and what of the load is left [1].

    Without a load, what is left over the largest load of a contact.
    """
    at = rest_at(bearing, near.position, near.speed)
    for _ in range(STEPS):
        step = np.linalg.lstsq(at.stiffness, at.force + load, rcond=1e-9)[0]
        at = rest_at(bearing, at.position + step, near.speed)
    size = np.hypot(*load) if any(load) else at.contact_load
    return at, float(np.hypot(*(at.force + load)) / size) if size > 0.0 else math.inf


def rest_near(bearing: Balls, near: RestingBalls, load: tuple[float, float]) -> RestingBalls:
    """Return the equilibrium of another law, sought first from that of one near it."""
    at, left = moved_to(bearing, near, load)
    return at if left <= EXACT else rest_under(bearing, load, near.speed)


def on_films(near: RestingBalls, oil: RaceOil) -> Balls:
    """Return the bearing of a rest with the oil films of its most loaded ball in all contacts."""
    single = single_of(near.bearing)
    load = float(near.balls.inner_load.max())
    films = ball_films(single, load=load, speed=near.speed, **oil._asdict())
    return with_single(near.bearing, replace(single, films=films))
