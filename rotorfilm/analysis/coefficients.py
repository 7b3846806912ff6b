"""Stiffness and damping of a film at a position of the journal, and over speed as a bearing."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from numbers import Number
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from ..core import port
from ..core.dynamic_stiffness import (
    InertialStiffness,
    coefficients_of,
    drifts,
    rest_linearization,
    small_motion,
    states_rest,
)
from ..core.errors import (
    InputError,
    brief,
    require_count,
    require_finite,
    require_kind,
    require_number,
)
from ..core.inputs import arguments
from ..core.model import Array
from ..core.readable import Drawable
from ..core.results import Coefficients, Equilibrium, coefficients_of_slopes
from ..core.sources import offered
from .equilibrium import equilibria, equilibrium
from .threads import one_blas_thread

GROWTH_ROUNDOFF = 1e-9
"""Growth rate / frequency of a motion that is roundoff."""


@arguments
def coefficients(
    reaction: port.Reaction, position: ArrayLike, speed: float, frequency: float | None = None
) -> Coefficients:
    """Return K = -dF/d(position) and C = -dF/d(velocity) of a film, for a journal at rest.

    A film with inertia also has an added mass (`InertialCoefficients`). If it has states too, K contains the
    added mass.

    Parameters
    ----------
    reaction : Reaction
        The film; F is its force on the journal. If the heat balance determines the film temperature, it is
        computed at this position and held: during vibration, bush, shaft and film keep their temperature.
    position : array_like, shape (2,) [m]
        Journal center from the bearing center, an equilibrium or not.
    speed : float [rad/s]
        Angular speed about +z.
    frequency : float or None [rad/s]
        Frequency of the whirl, where K and C depend on it, as for tilting pads. None takes the frequency of
        the shaft (synchronous coefficients), 0 takes slow motion. With a number the result is a
        `ReducedCoefficients`. With None it is a `FrequencyDependentCoefficients`, from which modes and
        critical masses take K(s). States that drift, such as the wear of a bush or the temperature of a film,
        are held with None; with a number they follow the motion.

    Raises
    ------
    InputError
        If an argument is not finite or has the wrong shape.
    FilmContactError
        If the position is outside the clearance.
    UndefinedDerivativeError
        If the film has no derivative there.

    Warns
    -----
    ValidityWarning
        If the film is not laminar, or its oil is beyond its viscosity law; see `equilibrium`.
    """
    port.require_reaction("reaction", reaction, heavy=True)
    position, speed = port.require_place(reaction, position), require_number("speed", speed)
    film = port.at_balanced_temperature(reaction, position, speed)
    port.warn_of_flow(film, speed)
    if states_rest(film):
        port.require_range(film, speed if frequency is None else frequency)
    return film_coefficients(film if frequency is None else reaction, position, speed, frequency)


def film_coefficients(
    reaction: Any, position: ArrayLike, speed: float, frequency: float | None = None
) -> Coefficients:
    """Return `coefficients` where an equilibrium has warned of the flow of the film already."""
    position = port.require_place(reaction, position)
    if states_rest(reaction) or (frequency is not None and drifts(reaction)):
        film = (
            port.at_balanced_temperature(reaction, position, speed)
            if states_rest(reaction)
            else port.in_time(reaction)
        )
        motion = small_motion(film, position, speed)
        if port.inertial(film) is not None:
            motion = InertialStiffness(motion, port.mass_of(film, position, np.zeros_like(position), speed))
        return coefficients_of(motion, position, speed, frequency, port.freedoms_of(film))
    return _held(port.at_balanced_temperature(reaction, position, speed), position, speed)


def coefficients_at(reaction: Any, rests: Sequence[Equilibrium]) -> list[Coefficients]:
    """Return `film_coefficients` at each of many equilibria: for a static force without heat all at once."""
    if states_rest(reaction) or port.is_warming(reaction) or port.inertial(reaction) or len(rests) < 2:
        return [film_coefficients(reaction, at.position, at.speed) for at in rests]
    positions, freedoms = np.array([at.position for at in rests]).T, port.freedoms_of(reaction)
    slopes = port.static_slopes(
        reaction, positions, np.zeros_like(positions), np.array([at.speed for at in rests])
    )
    return [
        coefficients_of_slopes(own, at.position, at.speed, freedoms)
        for own, at in zip(np.moveaxis(slopes, -1, 0), rests, strict=True)
    ]


def _held(film: Any, position: Array, speed: float) -> Coefficients:
    """Return K and C of a film with its states, if there are some, held."""
    still, heavy = np.zeros_like(position), port.inertial(film)
    if states_rest(film):
        slopes = rest_linearization(film, position, speed).D
    else:
        slopes = port.static_slopes(film, position, still, speed)
    mass = None if heavy is None else heavy.mass(position, still, speed)
    return coefficients_of_slopes(slopes, position, speed, port.freedoms_of(film), mass)


@arguments
def frozen_coefficients(reaction: port.Reaction, position: ArrayLike, speed: float) -> Coefficients:
    """Return K and C of a reaction with its states held at their equilibrium: the limit of very fast motion.

    Parameters
    ----------
    reaction, position, speed
        As in `coefficients`.

    Raises
    ------
    InputError, FilmContactError, UndefinedDerivativeError
        As in `coefficients`; also InputError for a film with a time step of its own, whose states cannot be
        held.
    """
    port.require_reaction("reaction", reaction, heavy=True, over_time=True)
    position, speed = port.require_place(reaction, position), require_number("speed", speed)
    return _held(port.at_balanced_temperature(reaction, position, speed), position, speed)


@arguments
def quasi_static_coefficients(reaction: port.Reaction, position: ArrayLike, speed: float) -> Coefficients:
    """Return K(0) and dK/ds(0) of a reaction whose states follow the shaft: the limit of slow motion.

    Parameters
    ----------
    reaction, position, speed
        As in `coefficients`.

    Raises
    ------
    InputError, FilmContactError, UndefinedDerivativeError
        As in `coefficients`.
    """
    return coefficients(reaction, position, speed, frequency=0.0)


@arguments
def dynamic_stiffness(reaction: port.Reaction, at: Equilibrium, s: complex) -> port.Complex:
    """Return K(s) + s C(s) + s^2 M of a reaction about an equilibrium, with its states eliminated.

    Parameters
    ----------
    reaction : Reaction
        The bearing. Its states follow the shaft; this includes the temperature of a film and the wear of a
        bush.
    at : Equilibrium
        Equilibrium where the shaft rests.
    s : complex [1/s]
        Exponent of the motion, growth rate + i frequency.

    Returns
    -------
    ndarray, shape (n, n), complex [N/m]
        The force on the shaft changes by minus this times q e^(s t) as the shaft moves by q e^(s t).

    Raises
    ------
    InputError
        If an argument breaks its rule, or s is an exponent of the states alone.

    Warns
    -----
    ValidityWarning
        If the motion is faster than the model of the reaction is meant for.
    """
    port.require_reaction("reaction", reaction, heavy=True)
    require_kind("at", at, Equilibrium, "an Equilibrium, as equilibrium() returns it")
    if not isinstance(s, Number) or not np.isfinite(s):
        raise InputError(f"s must be a finite number, got {s!r}")
    place, exponent = port.require_place(reaction, at.position, "at.position"), complex(s)
    film = (
        port.at_balanced_temperature(reaction, place, at.speed)
        if states_rest(reaction)
        else port.in_time(reaction)
    )
    if states_rest(film):
        port.require_range(film, abs(exponent))
    mass = port.mass_of(reaction, place, np.zeros_like(place), at.speed)
    return np.asarray(small_motion(film, place, at.speed).stiffness(exponent) + exponent**2 * mass)


@arguments
def coefficient_table(reaction: port.Reaction, load: ArrayLike, speeds: ArrayLike) -> Any:
    """Return K and C of a film at its equilibria under a load, over speed, as a `TabulatedBearing`.

    The result also has the eccentricity, attitude angle, minimum film, temperature, power loss and flow of
    each equilibrium.

    Parameters
    ----------
    reaction : Reaction
        The film.
    load : array_like, shape (2,) [N]
        External static force on the journal.
    speeds : array_like, shape (n,) [rad/s]
        Rising.

    Raises
    ------
    InputError
        If the speeds do not rise.
    EquilibriumError
        If there is no equilibrium at one of the speeds.
    """
    port.require_reaction("reaction", reaction)
    grid = require_finite("speeds", speeds)
    if grid.ndim != 1 or not grid.size:
        raise InputError(f"speeds must be a list of rising numbers, got {brief(speeds)}")
    rests = equilibria(reaction, load, grid)
    points = coefficients_at(reaction, rests)
    return offered("TabulatedBearing")(
        speeds=grid,
        stiffness=np.array([point.stiffness for point in points]),
        damping=np.array([point.damping for point in points]),
        freedoms=port.freedoms_of(reaction),
    ).found_at(rests)


# How a shaft swings as the balls of its bearing pass the load.


SAMPLES = 64
"""Angles of the cage over a ball pitch."""


@dataclass(frozen=True, kw_only=True)
class VariableCompliance(Drawable):
    """Variable compliance: a shaft under a steady load while the ball cage turns by one pitch.

    Attributes
    ----------
    cage_angle : ndarray, shape (samples,) [rad]
        Angle by which the cage has turned, from 0 to one ball pitch, end point excluded.
    position : ndarray, shape (2, samples) [m]
        Position where the shaft rests.
    swing : ndarray, shape (2,) [m]
        Peak to peak along x and y.
    swing_amplitude : ndarray, shape (2, harmonics) [m]
        Swing amplitude of the harmonics of the ball-pass frequency along x and y, the first one first.
    mean_stiffness : ndarray, shape (2, 2) [N/m]
        Averaged over the pitch.
    first_harmonic : ndarray, shape (2, 2, 2) [N/m]
        A, B of K = mean + A cos(2 pi angle/pitch) + B sin(2 pi angle/pitch): the parametric excitation.
    ball_pass_frequency : float [rad/s]
        Ball pass frequency at the speed of the shaft: balls times the speed of the cage.
    load : ndarray, shape (2,) [N]
    speed : float [rad/s]
    """

    cage_angle: Array
    position: Array
    swing: Array
    swing_amplitude: Array
    mean_stiffness: Array
    first_harmonic: Array
    ball_pass_frequency: float
    load: Array
    speed: float


@one_blas_thread
@arguments
def variable_compliance(
    bearing: port.Reaction, load: tuple[float, float], speed: float = 0.0, *, samples: int = SAMPLES
) -> VariableCompliance:
    """Return the equilibrium and the stiffness of a shaft at each cage angle over one ball pitch.

    The motion is quasi-static: the inertia of the shaft is neglected, which holds far below its resonances.

    Parameters
    ----------
    bearing : BallBearing or BearingPair
    load : (float, float) [N]
        External force on the shaft.
    speed : float [rad/s]
        Angular speed about +z: of the inertia of the balls, and of the ball-pass frequency.
    samples : int
        Angles over a pitch.

    Raises
    ------
    InputError
        If an argument breaks its rule.
    EquilibriumError
        If the shaft has no rest at an angle.
    """
    if not hasattr(bearing, "cage_ratio"):
        raise InputError(f"bearing must be a BallBearing or a BearingPair, got {brief(bearing)}")
    require_count("samples", samples, 4)
    require_number("speed", speed)
    balls: Any = bearing
    angles = np.arange(samples) * balls.pitch / samples
    turned = [balls.turned(angle) for angle in angles.tolist()]
    places = [equilibrium(one, load, speed).position for one in turned]
    stiffness = np.array(
        [film_coefficients(one, at, speed).stiffness for one, at in zip(turned, places, strict=True)]
    )
    position = np.array(places).T
    first = np.fft.fft(stiffness, axis=0)[1]
    return VariableCompliance(
        cage_angle=angles,
        position=position,
        swing=np.ptp(position, axis=1),
        swing_amplitude=2.0 / samples * np.abs(np.fft.rfft(position)[:, 1 : samples // 2]),
        mean_stiffness=stiffness.mean(axis=0),
        first_harmonic=2.0 / samples * np.stack([first.real, -first.imag]),
        ball_pass_frequency=2.0 * np.pi / balls.pitch * balls.cage_ratio * abs(speed),
        load=np.asarray(load, dtype=float),
        speed=speed,
    )
