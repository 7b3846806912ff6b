"""What sits at the nodes of a shaft: disks, bearing stations, springs, probes, unbalance."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from ...errors import InputError, require_finite, require_non_negative, require_number, require_positive
from ...inputs.si_arguments import in_si, quantities
from ...model import Array

Pair = tuple[tuple[float, float], tuple[float, float]]


@quantities
@dataclass(frozen=True, kw_only=True)
class Disk:
    """A rigid disk on a node.

    Parameters
    ----------
    node : int
    mass : float [kg]
    diametral_inertia, polar_inertia : float [kg m2]
        Moments of inertia about a diameter and about the axis.
    skew : float [rad]
        By which its axis is out of that of the shaft; it excites as an unbalance does.
    skew_angle : float [rad]
        Angle from +x at t = 0, positive about +z, of the plane in which its axis leans: where it leans
        towards in the direction of +z.
    """

    node: int
    mass: float
    diametral_inertia: float = 0.0
    polar_inertia: float = 0.0
    skew: float = 0.0
    skew_angle: float = 0.0

    def __post_init__(self) -> None:
        require_number("skew", self.skew)
        require_number("skew_angle", self.skew_angle)
        for name in ("mass", "diametral_inertia", "polar_inertia"):
            require_non_negative(name, getattr(self, name))

    @classmethod
    @in_si
    def solid(
        cls, node: int, *, density: float, width: float, outer_diameter: float, inner_diameter: float = 0.0
    ) -> Disk:
        """Return a disk of even thickness with a bore.

        Parameters
        ----------
        node : int
        density, width, outer_diameter, inner_diameter : float [kg/m3, m, m, m]
        """
        for name, value in (("density", density), ("width", width), ("outer_diameter", outer_diameter)):
            require_positive(name, value)
        require_non_negative("inner_diameter", inner_diameter)
        if inner_diameter >= outer_diameter:
            raise InputError(
                f"inner_diameter must be below outer_diameter {outer_diameter!r}, got {inner_diameter!r}"
            )
        squares = outer_diameter**2 + inner_diameter**2
        mass = 0.25 * math.pi * density * width * (outer_diameter**2 - inner_diameter**2)
        polar = mass * squares / 8.0
        diametral = 0.5 * polar + mass * width**2 / 12.0
        return cls(node=node, mass=mass, diametral_inertia=diametral, polar_inertia=polar)


@quantities
@dataclass(frozen=True, kw_only=True)
class Support:
    """A housing on springs: what carries a bearing, in series with it.

    Parameters
    ----------
    mass : float [kg]
    stiffness : float [N/m] or 2 x 2 numbers
        From the housing to the ground; one number is the same in both directions.
    damping : float [N s/m] or 2 x 2 numbers

    Raises
    ------
    InputError
        If the mass is not positive, or a matrix is neither a number nor 2 x 2.
    """

    mass: float
    stiffness: float | Pair
    damping: float | Pair = 0.0

    def __post_init__(self) -> None:
        require_positive("mass", self.mass)
        for name in ("stiffness", "damping"):
            object.__setattr__(self, name, square_pair(name, getattr(self, name)))


@quantities
@dataclass(frozen=True, kw_only=True)
class TiltSpring:
    """Springs and dampers from the ground against the tilt of a node, as of a long bearing or a clamp.

    Parameters
    ----------
    node : int
    stiffness : float [N m/rad] or 2 x 2 numbers
        Moment against tilt_x (rotation of the shaft in the x-z plane) and tilt_y; one number is the same in
        both planes.
    damping : float [N m s/rad] or 2 x 2 numbers

    Raises
    ------
    InputError
        If a matrix is neither a number nor 2 x 2.
    """

    node: int
    stiffness: float | Pair
    damping: float | Pair = 0.0

    def __post_init__(self) -> None:
        for name in ("stiffness", "damping"):
            object.__setattr__(self, name, square_pair(name, getattr(self, name)))


@quantities
@dataclass(frozen=True, kw_only=True)
class Station:
    """Where a bearing acts: a journal at a node, in a housing that is rigid unless it has a support.

    Parameters
    ----------
    node : int
    name : str
        Prefix of its signals, as `left` in `left_force_x`; empty for one station at most, whose signals then
        are those that `simulate` and `cosimulate` connect with a film.
    support : Support, optional
        Its housing moves along x and y and does not tilt.
    feels_tilt : bool
        Whether the bearing here may also resist the tilt of the shaft, as `TiltingBalls` do.
    """

    node: int
    name: str = ""
    support: Support | None = None
    feels_tilt: bool = False

    def __post_init__(self) -> None:
        if self.name and not self.name.isidentifier():
            raise InputError(f"name must be an identifier or empty, got {self.name!r}")


@quantities
@dataclass(frozen=True, kw_only=True)
class Probe:
    """A node whose displacement is an output: `name_x`, `name_y` [m].

    Parameters
    ----------
    node : int
    name : str
    """

    node: int
    name: str

    def __post_init__(self) -> None:
        if not self.name.isidentifier():
            raise InputError(f"name must be an identifier, got {self.name!r}")


@quantities
@dataclass(frozen=True, kw_only=True)
class Unbalance:
    """An unbalance at a node.

    Parameters
    ----------
    node : int
    unbalance : float [kg m]
        Mass times eccentricity of its center.
    unbalance_angle : float [rad]
        Angle of its center from +x at t = 0, positive about +z.
    """

    node: int
    unbalance: float
    unbalance_angle: float = 0.0

    def __post_init__(self) -> None:
        require_non_negative("unbalance", self.unbalance)
        require_number("unbalance_angle", self.unbalance_angle)


def square_pair(name: str, value: ArrayLike) -> Pair:
    """Return a number, or 2 x 2 numbers, as 2 x 2 numbers; raise InputError otherwise."""
    array: Array = require_finite(name, value)
    if array.ndim == 0:
        array = float(array) * np.eye(2)
    if array.shape != (2, 2):
        raise InputError(f"{name} must be a number or 2 x 2 numbers, got {value!r}")
    (a, b), (c, d) = array.tolist()
    return (a, b), (c, d)
