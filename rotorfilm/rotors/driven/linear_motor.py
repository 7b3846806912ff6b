"""The torque of a motor over its speed."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Protocol, runtime_checkable

from ...errors import InputError, require_non_negative, require_number, require_positive
from ...inputs.si_arguments import quantities
from ..profile import SpeedProfile


@runtime_checkable
class DriveTorque(Protocol):
    """What drives a shaft, all resistances of machine and bearings taken off: a motor of one's own."""

    def torque(self, t: float, speed: float) -> float:
        """Return the torque about +z [N m] at a time [s] and an angular speed [rad/s]."""

    def slope(self, t: float, speed: float) -> float:
        """Return d torque / d speed [N m s]."""


@quantities
@dataclass(frozen=True, kw_only=True)
class LinearMotor:
    """A motor whose torque falls in a line to nothing at its idle speed, and what resists it.

        torque = stall_torque (1 - speed / idle_speed) - resistance speed

    Parameters
    ----------
    stall_torque : float [N m]
        Torque at rest, in the direction of the idle speed; positive.
    idle_speed : float or SpeedProfile [rad/s]
        Speed without load. A profile is that of a converter: the slope of the line is then that of its
        largest value, stall_torque / |idle_speed|, and the line is shifted.
    resistance : float [N m s/rad]
        Torque per rad/s that resists, of bearings, windage and load.

    Raises
    ------
    InputError
        If the torque is not positive, the resistance negative, or the idle speed 0 at all times.
    """

    stall_torque: float
    idle_speed: float | SpeedProfile
    resistance: float = 0.0

    def __post_init__(self) -> None:
        require_positive("stall_torque", self.stall_torque)
        require_non_negative("resistance", self.resistance)
        if not isinstance(self.idle_speed, SpeedProfile):
            require_number("idle_speed", self.idle_speed)
        if not self._largest > 0.0:
            raise InputError(f"idle_speed must not be 0 at all times, got {self.idle_speed!r}")

    def torque(self, t: float, speed: float) -> float:
        """Return the torque about +z [N m] at a time [s] and an angular speed [rad/s]."""
        return self.stall_torque / self._largest * (self._profile.speed(t) - speed) - self.resistance * speed

    def slope(self, t: float, speed: float) -> float:
        """Return d torque / d speed [N m s], the same at all times and speeds."""
        return -self.stall_torque / self._largest - self.resistance

    @property
    def breakpoints(self) -> tuple[float, ...]:
        """Times [s] at which the idle speed has kinks."""
        return self._profile.times if len(self._profile.times) > 1 else ()

    @property
    def _profile(self) -> SpeedProfile:
        given = self.idle_speed
        return given if isinstance(given, SpeedProfile) else SpeedProfile.constant(given)

    @property
    def _largest(self) -> float:
        return max(abs(speed) for speed in self._profile.speeds)
