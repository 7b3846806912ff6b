"""A rotor with a crack in its shaft that opens and closes as it turns under its weight."""

from __future__ import annotations

import math
from dataclasses import dataclass, field
from functools import cached_property
from typing import Protocol, runtime_checkable

import numpy as np
from numpy.polynomial.legendre import leggauss
from numpy.typing import ArrayLike

from ..core.errors import (
    InputError,
    require_count,
    require_kind,
    require_non_negative,
    require_number,
    require_positive,
)
from ..core.inputs import arguments, quantities
from ..core.model import Array, Linearization
from .profile import SpeedProfile
from .rigid import JeffcottRotor
from .shaft_elements import ShaftElement
from .shaft_rotor import ShaftRotor
from .structure import AroundStructure

# Cracks of a shaft: which motion they give way to, and how much of the stiffness they take.


Weakness = tuple[Array, Array]
"""What an open crack takes: what it gives way to, in the x-z and in the y-z plane, of the coordinates of the
rotor, shape (2, N); and the stiffness against that which it takes in its weak and in its strong direction."""


@quantities
@dataclass(frozen=True, kw_only=True)
class JeffcottCrack:
    """A crack in the shaft of a `JeffcottRotor`, given by the loss of stiffness when it is open.

    Parameters
    ----------
    reduction : float [1]
        Share of the stiffness lost in the direction of the crack, from 0 to below 1.
    cross_reduction : float [1]
        Share of the stiffness lost across the crack; not larger than `reduction`.
    crack_angle : float [rad]
        Crack angle from +x to the crack at t = 0, positive about +z.

    Raises
    ------
    InputError
        If an argument breaks its rule.
    """

    reduction: float
    cross_reduction: float = 0.0
    crack_angle: float = 0.0

    def __post_init__(self) -> None:
        require_non_negative("cross_reduction", self.cross_reduction)
        require_number("crack_angle", self.crack_angle)
        if not self.cross_reduction <= self.reduction < 1.0:
            raise InputError(
                f"reduction must be from cross_reduction {self.cross_reduction!r} to below 1, "
                f"got {self.reduction!r}"
            )

    def weakness(self, rotor: object) -> Weakness:
        """Return the loss of stiffness of a JeffcottRotor; raise InputError for another rotor."""
        require_kind("rotor", rotor, JeffcottRotor, "a JeffcottRotor for a JeffcottCrack")
        assert isinstance(rotor, JeffcottRotor)
        rows = np.array([[1.0, -1.0, 0.0, 0.0], [0.0, 0.0, 1.0, -1.0]])
        return rows, rotor.stiffness * np.array([self.reduction, self.cross_reduction])


@quantities
@dataclass(frozen=True, kw_only=True)
class ShaftCrack:
    """A transverse crack with a straight edge, in the middle of an element of a `ShaftRotor`.

    Parameters
    ----------
    element : int
        Index of the cracked element, from 0; it must be a solid cylinder.
    depth : float [m]
        Largest depth of the crack, at most the radius.
    crack_angle : float [rad]
        Crack angle from +x to the crack at t = 0, positive about +z.

    Raises
    ------
    InputError
        If an argument breaks its rule; where the rotor is known, if it has no such solid element.

    Notes
    -----
    A hinge of compliance h (`crack_compliance`) in the middle of an element of bending stiffness EI over a
    length l reduces its stiffness against the difference of the tilts of its ends by kappa^2 h/(1 + kappa h),
    kappa = EI/l. This is exact, with or without shear.
    """

    element: int
    depth: float
    crack_angle: float = 0.0

    def __post_init__(self) -> None:
        require_count("element", self.element, 0)
        require_non_negative("depth", self.depth)
        require_number("crack_angle", self.crack_angle)

    def weakness(self, rotor: object) -> Weakness:
        """Return the loss of stiffness of a ShaftRotor; raise InputError for another rotor."""
        require_kind("rotor", rotor, ShaftRotor, "a ShaftRotor for a ShaftCrack")
        assert isinstance(rotor, ShaftRotor)
        piece = self._piece(rotor)
        compliance = crack_compliance(
            depth=self.depth,
            radius=0.5 * piece.outer_diameter,
            young_modulus=piece.material.young_modulus,
            poisson_ratio=piece.material.poisson_ratio,
        )
        stiff = float(np.mean(piece.section().bending)) / piece.length
        loss = [stiff * stiff * h / (1.0 + stiff * h) for h in compliance]
        size = len(rotor.assembly.coordinates)
        rows = np.zeros((2, len(rotor.assembly.weight)))
        for plane in range(2):
            first = plane * size + 2 * self.element + 1
            rows[plane, [first, first + 2]] = -1.0, 1.0
        return rows, np.array(loss)

    def _piece(self, rotor: ShaftRotor) -> ShaftElement:
        count = len(rotor.elements)
        if self.element >= count:
            raise InputError(f"element must be from 0 to {count - 1}, got {self.element!r}")
        piece = rotor.elements[self.element]
        if not isinstance(piece, ShaftElement) or piece.tapered or piece.inner_diameter > 0.0:
            raise InputError(f"element {self.element} must be a solid cylinder for a crack, got {piece!r}")
        return piece


# How far a crack is open over the turn of a shaft that its weight bends.


@runtime_checkable
class Breathing(Protocol):
    """The share of its stiffness that a crack takes, over its angle from where it is wide open."""

    def share(self, angle: float) -> float:
        """Return the share [1], 0 closed and 1 open, at an angle [rad]."""


@dataclass(frozen=True)
class MayesDaviesBreathing:
    """A crack that opens and closes as a cosine: share = (1 + cos angle)/2 (Mayes & Davies 1984).

    J. Vib. Acoust. 106, 139-145.
    """

    def share(self, angle: float) -> float:
        """Return the share of the crack that is open [1] at an angle [rad]."""
        return 0.5 * (1.0 + math.cos(angle))


@quantities
@dataclass(frozen=True, kw_only=True)
class GaschHinge:
    """A hinge model: the crack is either open or closed (Gasch 1976, 1993, J. Sound Vib. 160, 313-332).

    It switches at the neutral axis, a quarter of a turn from the fully open position.

    Parameters
    ----------
    edge : float [rad]
        Angle to either side over which it switches smoothly, as a cubic; at most a quarter of a turn.

    Raises
    ------
    InputError
        If the edge is not positive, or wider than a quarter of a turn.
    """

    edge: float = 0.1

    def __post_init__(self) -> None:
        require_positive("edge", self.edge)
        if self.edge > 0.5 * math.pi:
            raise InputError(f"edge must not exceed a quarter of a turn, got {self.edge!r}")

    def share(self, angle: float) -> float:
        """Return the share of the crack that is open [1] at an angle [rad]."""
        away = abs(math.remainder(angle, 2.0 * math.pi)) - 0.5 * math.pi
        place = min(max(0.5 * (1.0 - away / self.edge), 0.0), 1.0)
        return place * place * (3.0 - 2.0 * place)


@dataclass(frozen=True)
class OpenCrack:
    """A notch that never closes: an asymmetric shaft, like a rotor with slots or a keyway."""

    def share(self, angle: float) -> float:
        """Return the open share of the notch, which is 1 at every angle [rad]."""
        return 1.0


# A rotor with a crack in its shaft that opens and closes as it turns under its weight.


@quantities
@dataclass(frozen=True, kw_only=True)
class CrackedRotor(AroundStructure):
    """A rotor with one crack: its stiffness rotates with the shaft, and the crack may breathe.

        M q'' + (C + w G) q' + (K + w H - share(p) E' R(p)' diag(loss) R(p) E) q = ...

    E q is the local deformation at the crack in both planes, R(p) rotates it into the axes of the crack, weak
    direction first, and p is the angle of the crack. The model assumes weight dominance: vibration is small
    compared with the static deflection, which alone decides when the crack is open. The damping of the shaft
    does not change.

    Parameters
    ----------
    rotor : JeffcottRotor or ShaftRotor
        Its speed may be a profile.
    crack : JeffcottCrack or ShaftCrack
        Position, depth and angle of the crack.
    breathing : Breathing
        `MayesDaviesBreathing()`, `GaschHinge()`, or `OpenCrack()` for a notch.
    opening_angle : float or None [rad]
        Angle from +x at which the crack is fully open. None takes the direction of gravity, which is right
        for a shaft between its bearings; an overhung shaft needs the opposite direction.

    Raises
    ------
    InputError
        If the crack does not fit the rotor, or there is neither gravity nor an opening angle.
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
    def profile(self) -> SpeedProfile:
        """The speed of the rotor as a `SpeedProfile`."""
        return self.rotor.profile

    @cached_property
    def weakness(self) -> Weakness:
        """What the open crack takes from the rotor."""
        return self.crack.weakness(self.rotor)

    def derivative(self, t: float, x: ArrayLike, u: ArrayLike) -> Array:
        """Return dx/dt at the time t [s] for the forces u [N] at the stations."""
        rate = np.array(self.rotor.derivative(t, x, u))
        half = len(rate) // 2
        rate[half:] += self._lift @ (self.lost(t) @ (self.weakness[0] @ np.asarray(x, dtype=float)[:half]))
        return rate

    def linearization(self, t: float, x: ArrayLike, u: ArrayLike) -> Linearization:
        """Return the exact derivatives, which depend on the time."""
        A, B, C, D = self.rotor.linearization(t, x, u)
        half = len(A) // 2
        whole = A.copy()
        whole[half:, :half] += self._lift @ self.lost(t) @ self.weakness[0]
        return Linearization(whole, B, C, D)

    def lost(self, t: float) -> Array:
        """Return the loss of stiffness by the crack at a time [s], along x and y, shape (2, 2)."""
        return self.lost_at(self.profile.angle(t))

    def lost_at(self, turned: float) -> Array:
        """Return the loss of stiffness after the shaft has turned by an angle [rad] since t = 0."""
        angle = turned + self.crack.crack_angle
        share = self.breathing.share(angle - self._open_at)
        turn = np.array([[math.cos(angle), math.sin(angle)], [-math.sin(angle), math.cos(angle)]])
        return np.asarray(share * turn.T @ (self.weakness[1][:, None] * turn))

    @cached_property
    def _open_at(self) -> float:
        x, y = self.rotor.gravity
        return math.atan2(y, x) if self.opening_angle is None else self.opening_angle

    @cached_property
    def _lift(self) -> Array:
        """Accelerations per what the crack does not hold, shape (N, 2)."""
        return np.asarray(np.linalg.solve(self.rotor.structure.mass, self.weakness[0].T))


# How much a crack lets a round shaft bend: the compliance of its section by fracture mechanics.


DEEPEST = 1.0
"""Depth / radius to which the strips have been compared with measurements."""

_NODES, _WEIGHTS = leggauss(40)
_SHARE, _PART = 0.5 * (_NODES + 1.0), 0.5 * _WEIGHTS


@arguments
def crack_compliance(
    *, depth: float, radius: float, young_modulus: float, poisson_ratio: float = 0.3
) -> tuple[float, float]:
    """Return the tilt per bending moment [rad/(N m)] that an open crack adds, weak and strong direction.

    The moment in the weak direction opens the crack; that in the strong direction bends the section along its
    straight edge. The section is divided into strips: plates with an edge crack, in bending for the weak
    direction and in tension for the strong one, whose energy release adds up (Dimarogonas & Papadopoulos
    1983, J. Sound Vib. 91, 583-593; stress intensities of Tada, Paris & Irwin).

    Parameters
    ----------
    depth : float [m]
        Largest depth of the crack, at most the radius.
    radius : float [m]
        Radius of the shaft, which is solid.
    young_modulus : float [Pa]
    poisson_ratio : float [1]

    Raises
    ------
    InputError
        If an argument breaks its rule.
    """
    require_non_negative("depth", depth)
    require_positive("radius", radius)
    require_positive("young_modulus", young_modulus)
    if not -1.0 < require_number("poisson_ratio", poisson_ratio) <= 0.5:
        raise InputError(f"poisson_ratio must be above -1 and at most 0.5, got {poisson_ratio!r}")
    if depth > DEEPEST * radius:
        raise InputError(f"depth must not exceed the radius {radius!r}, got {depth!r}")
    a = depth / radius
    scale = 32.0 * (1.0 - poisson_ratio**2) / (math.pi * young_modulus * radius**3)
    return scale * _released(a, bent=True), scale * _released(a, bent=False)


def _released(depth: float, *, bent: bool) -> float:
    """Return the integral of (1 - x^2 or x^2) alpha F(alpha/h)^2 over the crack, radius 1.

    x runs along the edge of the crack, h = 2 sqrt(1 - x^2) is the height of the strip at x.
    """
    half = math.sqrt(depth * (2.0 - depth))
    angle = 0.5 * math.pi * _SHARE
    x, by_x = half * np.sin(angle), half * np.cos(angle) * 0.5 * math.pi * _PART
    side = np.sqrt(1.0 - x**2)
    deep = depth - (1.0 - side)
    alpha = np.outer(_SHARE, deep)
    intensity = _bending(alpha / (2.0 * side)) if bent else _tension(alpha / (2.0 * side))
    strips = (_PART @ (alpha * intensity**2)) * deep
    arm = side**2 if bent else x**2
    return float(2.0 * np.sum(by_x * arm * strips))


def _bending(share: Array) -> Array:
    t = 0.5 * math.pi * share
    return _root(t) * (0.923 + 0.199 * (1.0 - np.sin(t)) ** 4) / np.cos(t)


def _tension(share: Array) -> Array:
    t = 0.5 * math.pi * share
    return _root(t) * (0.752 + 2.02 * share + 0.37 * (1.0 - np.sin(t)) ** 3) / np.cos(t)


def _root(t: Array) -> Array:
    return np.sqrt(np.tan(t) / np.maximum(t, np.finfo(float).tiny))
