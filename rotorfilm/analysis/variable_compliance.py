"""How a shaft swings as the balls of its bearing pass the load."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, Protocol, runtime_checkable

import numpy as np

from ..core.errors import require_count, require_kind, require_number
from ..core.inputs import arguments
from ..core.model import Array
from ..core.readable import Drawable
from .coefficients import coefficients
from .equilibrium import equilibrium

SAMPLES = 64
"""Angles of the cage over a ball pitch."""


@runtime_checkable
class Caged(Protocol):
    """A Reaction with rolling elements in a cage."""

    @property
    def pitch(self) -> float:
        """Angle from one rolling element to the next [rad]."""

    @property
    def cage_ratio(self) -> float:
        """Speed of the cage over that of the shaft."""

    def turned(self, angle: float) -> Any:
        """Return the Reaction with its cage turned further [rad]."""


@dataclass(frozen=True, kw_only=True)
class VariableCompliance(Drawable):
    """A shaft in slow motion under a steady load while its cage turns by a pitch.

    Attributes
    ----------
    cage_angle : ndarray, shape (samples,) [rad]
        By which the cage has turned, from 0 to a pitch, the last one left out.
    position : ndarray, shape (2, samples) [m]
        Where the shaft rests.
    swing : ndarray, shape (2,) [m]
        Peak to peak along x and y.
    swing_amplitude : ndarray, shape (2, harmonics) [m]
        Of the harmonics of the ball-pass frequency along x and y, the first one first.
    mean_stiffness : ndarray, shape (2, 2) [N/m]
        Averaged over the pitch.
    first_harmonic : ndarray, shape (2, 2, 2) [N/m]
        A, B of K = mean + A cos(2 pi angle/pitch) + B sin(2 pi angle/pitch): the parametric excitation.
    ball_pass_frequency : float [rad/s]
        At the speed of the shaft: balls times the speed of the cage.
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


@arguments
def variable_compliance(
    bearing: Caged, load: tuple[float, float], speed: float = 0.0, *, samples: int = SAMPLES
) -> VariableCompliance:
    """Return where a shaft rests at each angle of the cage over a ball pitch, and its stiffness there.

    Quasi-static: the inertia of the shaft does not count, which holds far below its resonances.

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
    require_kind("bearing", bearing, Caged, "a BallBearing or a BearingPair")
    require_count("samples", samples, 4)
    require_number("speed", speed)
    angles = np.arange(samples) * bearing.pitch / samples
    turned = [bearing.turned(angle) for angle in angles.tolist()]
    places = [equilibrium(one, load, speed).position for one in turned]
    stiffness = np.array(
        [coefficients(one, at, speed).stiffness for one, at in zip(turned, places, strict=True)]
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
        ball_pass_frequency=2.0 * np.pi / bearing.pitch * bearing.cage_ratio * abs(speed),
        load=np.asarray(load, dtype=float),
        speed=speed,
    )
