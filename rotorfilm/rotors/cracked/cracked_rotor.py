"""A rotor with a crack in its shaft that opens and closes as it turns under its weight."""

from __future__ import annotations

import math
from dataclasses import dataclass, field
from functools import cached_property

import numpy as np
from numpy.typing import ArrayLike

from ...errors import InputError, require_kind, require_number
from ...inputs.si_arguments import quantities
from ...model import Array, Linearization
from ..jeffcott import JeffcottRotor
from ..profile import SpeedProfile
from ..shaft.shaft_rotor import ShaftRotor
from ..stations import AroundRotor
from .breathing import Breathing, MayesDaviesBreathing
from .cracks import JeffcottCrack, ShaftCrack, Weakness


@quantities
@dataclass(frozen=True, kw_only=True)
class CrackedRotor(AroundRotor):
    """A rotor with one crack: a Dynamic model with a stiffness that turns and breathes with the shaft.

        M q'' + (C + w G) q' + (K + w H - share(p) E' R(p)' diag(loss) R(p) E) q = ...

    E q is what the crack gives way to in both planes, R(p) turns it into the axes of the crack, weak
    direction first, and p is the angle of the crack. The motion stays small beside the deflection of the
    weight, which says when the crack is open: weight dominance. Damping of the shaft stays as it is.

    Parameters
    ----------
    rotor : JeffcottRotor or ShaftRotor
        Its speed may be a profile.
    crack : JeffcottCrack or ShaftCrack
        Where it is, how deep, and at what angle.
    breathing : Breathing
        `MayesDaviesBreathing()`, `GaschHinge()`, or `OpenCrack()` for a notch.
    opening_angle : float or None [rad]
        From +x to where the crack is wide open; None for the direction of gravity, towards which a shaft
        between its bearings is stretched. An overhung shaft wants the opposite.

    Raises
    ------
    InputError
        If the crack is none of the rotor's shaft, or there is neither gravity nor an opening angle.
    """

    rotor: JeffcottRotor | ShaftRotor
    crack: JeffcottCrack | ShaftCrack
    breathing: Breathing = field(default_factory=MayesDaviesBreathing)
    opening_angle: float | None = None

    def __post_init__(self) -> None:
        require_kind("rotor", self.rotor, JeffcottRotor | ShaftRotor, "a JeffcottRotor or a ShaftRotor")
        require_kind("crack", self.crack, JeffcottCrack | ShaftCrack, "a JeffcottCrack or a ShaftCrack")
        require_kind("breathing", self.breathing, Breathing, "a breathing as MayesDaviesBreathing()")
        if self.opening_angle is not None:
            require_number("opening_angle", self.opening_angle)
        elif not any(self.rotor.gravity):
            raise InputError("opening_angle must be given for a rotor without gravity, got None")
        _ = self.weakness

    @property
    def stations(self) -> tuple[str, ...]:  # type: ignore[override]
        """The stations of the rotor."""
        return self.rotor.structure.stations

    @property
    def profile(self) -> SpeedProfile:
        """The speed as a profile."""
        return self.rotor.profile

    @cached_property
    def weakness(self) -> Weakness:
        """What the open crack takes from the rotor."""
        return self.crack.weakness(self.rotor)

    def derivative(self, t: float, x: ArrayLike, u: ArrayLike) -> Array:
        """Return dx/dt at the time t [s] for the forces u [N] at the stations."""
        rate = np.array(self.rotor.derivative(t, x, u))
        half = len(rate) // 2
        rate[half:] += self._lift @ (self.lost(t) @ (self.weakness.rows @ np.asarray(x, dtype=float)[:half]))
        return rate

    def output(self, t: float, x: ArrayLike, u: ArrayLike) -> Array:
        """Return the outputs of the rotor."""
        return self.rotor.output(t, x, u)

    def linearization(self, t: float, x: ArrayLike, u: ArrayLike) -> Linearization:
        """Return the exact derivatives, which depend on the time."""
        A, B, C, D = self.rotor.linearization(t, x, u)
        half = len(A) // 2
        whole = A.copy()
        whole[half:, :half] += self._lift @ self.lost(t) @ self.weakness.rows
        return Linearization(whole, B, C, D)

    def lost(self, t: float) -> Array:
        """Return the stiffness that the crack takes at a time [s], along x and y, shape (2, 2)."""
        angle = self.profile.angle(t) + self.crack.crack_angle
        share = self.breathing.share(angle - self._open_at)
        turn = np.array([[math.cos(angle), math.sin(angle)], [-math.sin(angle), math.cos(angle)]])
        return np.asarray(share * turn.T @ (self.weakness.loss[:, None] * turn))

    @cached_property
    def _open_at(self) -> float:
        x, y = self.rotor.gravity
        return math.atan2(y, x) if self.opening_angle is None else self.opening_angle

    @cached_property
    def _lift(self) -> Array:
        """Accelerations per what the crack does not hold, shape (N, 2)."""
        return np.asarray(np.linalg.solve(self.rotor.structure.mass, self.weakness.rows.T))
