"""Thrust bearings of fixed pads: plane, taper-land, step, a plain collar, and pairs with end play."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from ...core.errors import InputError, require_kind, require_non_negative, require_number, require_positive
from ...core.inputs import arguments, quantities
from ...core.model import Array, Linearization, static_linearization
from ..assemblies import Parallel
from ..films.geometry import TURN
from ..reaction import StaticReaction, state_of
from .film_tables import require_tabulable
from .sector_pads import SectorPads


@quantities
@dataclass(frozen=True, kw_only=True)
class ThrustBearing(SectorPads, StaticReaction):
    """A thrust bearing of fixed sector pads under a flat collar: a Reaction to z, tilt_x and tilt_y.

    The gap over a pad is h = depth + gap + side (z + tilt_x Y - tilt_y X), with X, Y on the pad, and the
    pressure p pushes the shaft along `side` z. For side = 1

        force_z = integral of p,    moment_x = integral of Y p,    moment_y = -integral of X p.

    Without taper, step and crown the pads are plane and carry nothing while the collar is aligned and at
    rest. With `continuous` the film continues from pad to pad. This is a ring with steps, or a plain collar,
    whose film is full and acts only against motion (a squeeze film). Dimensions, lubricant and side are given
    as to all `SectorPads`.

    Parameters
    ----------
    taper_depth : float [m]
        Depth of a taper at the leading edge, for rotation about +z.
    taper_share : float [1]
        Part of the arc that the taper takes; the remaining part is a land.
    step_depth : float [m]
        Depth of a step: of a recess from the leading edge.
    step_share : float [1]
        Part of the arc that it takes.
    step_width : float [1]
        Part of the width that it takes, about the middle.
    continuous : bool
        Whether the film continues from pad to pad.

    Raises
    ------
    InputError
        If a value breaks its rule.

    Notes
    -----
    Reynolds' equation in polar coordinates, with ambient pressure at all edges and where the film ruptures,

        (1/r)(r h^3 p_r/(12 mu))_r + (1/r^2)(h^3 p_phi/(12 mu))_phi = (speed/2) h_phi + h_t.

    Stiffness and damping are exact derivatives of the film found. Not included: pressure at inlets, inertia
    at steps, turbulence, deformation.

    Examples
    --------
    >>> bearing = ThrustBearing(
    ...     inner_diameter="50 mm", outer_diameter="100 mm", pads=8, pad_arc="40 deg", viscosity=0.02,
    ...     taper_depth="50 um",
    ... )
    >>> bearing.force([3e-5, 0.0, 0.0], [0.0, 0.0, 0.0], 300.0).shape
    (3,)
    """

    taper_depth: float = 0.0
    taper_share: float = 0.8
    step_depth: float = 0.0
    step_share: float = 0.7
    step_width: float = 1.0
    continuous: bool = False

    def __post_init__(self) -> None:
        super().__post_init__()
        require_kind("continuous", self.continuous, bool, "True or False")
        for name in ("taper_depth", "step_depth"):
            require_non_negative(name, getattr(self, name))
        for name in ("taper_share", "step_share", "step_width"):
            if not 0.0 < require_number(name, getattr(self, name)) <= 1.0:
                raise InputError(f"{name} must be in (0, 1], got {getattr(self, name)!r}")
        if self.continuous and abs(self.pads * self.pad_arc / TURN - 1.0) > 1e-9:
            raise InputError(
                f"pad_arc must be a turn over {self.pads!r} pads for a continuous film, "
                f"got {self.pad_arc!r} rad"
            )
        if self.tabulated:
            require_tabulable(self)

    @property
    def closed(self) -> bool:
        """Whether the pads form one continuous film around the collar."""
        return self.continuous

    @property
    def deepest(self) -> float:
        """Largest depth of the pads below their lands [m]."""
        return self.taper_depth + self.step_depth + self.crown

    def edges(self) -> tuple[list[float], list[float]]:
        """Return where the depth of a pad has kinks, as parts of its arc and its width."""
        arc = {0.0, 1.0}
        arc |= {self.taper_share} if self.taper_depth else set()
        arc |= {self.step_share} if self.step_depth else set()
        side = 0.5 * (1.0 - self.step_width)
        width = {0.0, 1.0} | ({side, 1.0 - side} if self.step_depth else set())
        return sorted(arc), sorted(width)

    def depth(self, along: Array, across: Array) -> Array:
        """Return the depth [m] at fractions of the arc and of the width, each from 0 to 1."""
        taper = self.taper_depth * np.maximum(1.0 - along / self.taper_share, 0.0)
        inside = (along < self.step_share) & (np.abs(2.0 * across - 1.0) < self.step_width)
        return np.asarray(super().depth(along, across) + taper + self.step_depth * inside)

    def prepared_force(self, position: Array, velocity: Array, speed: Array) -> Array:
        """Return `force` for inner loops: float arrays of equal batch shape."""
        return self._each(position, velocity, speed, differentiated=False)[:3, 0]

    def prepared_jacobian(self, position: Array, velocity: Array, speed: Array) -> Array:
        """Return `jacobian` for inner loops: float arrays of equal batch shape."""
        return self._each(position, velocity, speed, differentiated=True)[:3, 1:]

    def output(self, t: float, x: ArrayLike, u: ArrayLike) -> Array:
        """Return force_z, moment_x, moment_y and torque for u = (places, rates, speed)."""
        return self._checked(u, differentiated=False)[:, 0]

    def linearization(self, t: float, x: ArrayLike, u: ArrayLike) -> Linearization:
        """Return the exact derivatives at u: all of them in the feedthrough matrix D (4, 7)."""
        return static_linearization(self._checked(u, differentiated=True)[:, 1:])

    def _checked(self, u: ArrayLike, *, differentiated: bool) -> Array:
        place, rate, speed = state_of(self, u)
        return self._each(place, rate, np.asarray(speed), differentiated=differentiated)

    def _each(self, position: Array, velocity: Array, speed: Array, *, differentiated: bool) -> Array:
        """Return force, moments and torque and their derivatives side by side, shape (4, 8, ...)."""
        states = np.concatenate([position, velocity, speed[None]]).reshape(7, -1).T
        none = np.zeros(0)
        found = [self.answer(none, u, differentiated=differentiated) for u in states]
        rows = [np.column_stack([one.wrench, one.slopes[3]]) for one in found]
        return np.moveaxis(np.reshape(rows, (len(rows), 4, 8)), 0, -1).reshape(4, 8, *speed.shape)


@arguments
def double_acting(bearing: SectorPads, play: float, back: SectorPads | None = None) -> Parallel:
    """Return a double-acting thrust bearing: pads on both sides of a collar with some end play.

    Parameters
    ----------
    bearing : ThrustBearing or TiltingThrustBearing
        Bearing whose pads push the shaft along +z.
    play : float [m]
        Sum of both films over the lands; with the collar at z = 0 each has half of it.
    back : ThrustBearing or TiltingThrustBearing, optional
        Bearing whose pads push along -z; by default equal ones, met first at the same edges.

    Raises
    ------
    InputError
        If the play is not positive.
    """
    require_positive("play", play)
    half = 0.5 * play
    other = bearing if back is None else back
    for name, one in (("bearing", bearing), ("back", other)):
        require_kind(name, one, SectorPads, "a ThrustBearing or a TiltingThrustBearing")
    sides: Any = [replace(one, gap=half, side=side) for one, side in ((bearing, 1), (other, -1))]
    return Parallel(tuple(sides))
