"""What a shaft is made of: material, pieces of shaft, couplings, disks, bearing stations, unbalance."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import ArrayLike

from ...errors import InputError, require_finite, require_non_negative, require_number, require_positive
from ...model import Array
from .beam import POINTS, Beam, BeamMatrices, Section, beam_matrices, cowper_coefficient, round_section

Pair = tuple[tuple[float, float], tuple[float, float]]


@dataclass(frozen=True, kw_only=True)
class ElasticMaterial:
    """An elastic material.

    Parameters
    ----------
    young_modulus, shear_modulus : float [Pa]
        Elastic moduli in tension and in shear.
    density : float [kg/m3]
    """

    young_modulus: float
    shear_modulus: float
    density: float

    def __post_init__(self) -> None:
        for name in ("young_modulus", "shear_modulus", "density"):
            require_positive(name, getattr(self, name))

    @property
    def poisson_ratio(self) -> float:
        """E / (2 G) - 1 [1]."""
        return self.young_modulus / (2.0 * self.shear_modulus) - 1.0


@dataclass(frozen=True, kw_only=True)
class ShaftElement:
    """A piece of shaft between two nodes: a cylinder, or a cone where a diameter changes along it.

    Parameters
    ----------
    length, outer_diameter, inner_diameter : float [m]
        Diameters at the first node, and along the whole element unless it is a cone.
    material : ElasticMaterial
    shear_coefficient : float or None [1]
        kappa; by default that of Cowper for a round section (in the middle of a cone), infinite for a section
        that does not shear.
    end_outer_diameter, end_inner_diameter : float or None [m]
        Diameters at the second node of a cone; None for the same as at the first.
    axial_force : float [N]
        Static tension; negative for compression.
    torque : float [N m]
        Static torque, which follows the tilt of the shaft.

    Raises
    ------
    InputError
        If a dimension is not positive, or the bore is not below the outer diameter.
    """

    length: float
    outer_diameter: float
    inner_diameter: float = 0.0
    material: ElasticMaterial
    shear_coefficient: float | None = None
    end_outer_diameter: float | None = None
    end_inner_diameter: float | None = None
    axial_force: float = 0.0
    torque: float = 0.0

    def __post_init__(self) -> None:
        require_positive("length", self.length)
        require_number("axial_force", self.axial_force)
        require_number("torque", self.torque)
        outer, inner = self._ends
        for prefix, out, bore in zip(("", "end_"), outer, inner, strict=True):
            require_positive(f"{prefix}outer_diameter", out)
            require_non_negative(f"{prefix}inner_diameter", bore)
            if bore >= out:
                raise InputError(
                    f"{prefix}inner_diameter must be below {prefix}outer_diameter {out!r}, got {bore!r}"
                )
        if self.shear_coefficient is not None and not self.shear_coefficient > 0.0:
            raise InputError(f"shear_coefficient must be positive, got {self.shear_coefficient!r}")

    @property
    def _ends(self) -> tuple[tuple[float, float], tuple[float, float]]:
        """Outer and inner diameter at both nodes [m]."""
        out, bore = self.end_outer_diameter, self.end_inner_diameter
        return (
            (self.outer_diameter, self.outer_diameter if out is None else out),
            (self.inner_diameter, self.inner_diameter if bore is None else bore),
        )

    @property
    def tapered(self) -> bool:
        """Whether a diameter changes along the element."""
        return any(start != end for start, end in self._ends)

    def split(self, pieces: int) -> tuple[ShaftElement, ...]:
        """Return this piece of shaft as so many equally long elements."""
        if pieces < 1:
            raise InputError(f"pieces must be at least 1, got {pieces!r}")
        short = replace(self, length=self.length / pieces)
        if not self.tapered:
            return (short,) * pieces
        outer, inner = (np.linspace(*ends, pieces + 1).tolist() for ends in self._ends)
        return tuple(
            replace(
                short,
                outer_diameter=outer[k],
                inner_diameter=inner[k],
                end_outer_diameter=outer[k + 1],
                end_inner_diameter=inner[k + 1],
            )
            for k in range(pieces)
        )

    def section(self) -> Section:
        """Return stiffness and inertia of the cross section: of a cone, along it."""
        places = POINTS if self.tapered else 0.0
        outer, inner = (start + (end - start) * places for start, end in self._ends)
        kappa = self.shear_coefficient
        if kappa is None:
            (a, b), (c, d) = self._ends
            kappa = cowper_coefficient(self.material.poisson_ratio, (c + d) / (a + b))
        return round_section(
            outer_diameter=outer,
            inner_diameter=inner,
            young_modulus=self.material.young_modulus,
            shear=kappa * self.material.shear_modulus,
            density=self.material.density,
        )

    def matrices(self, beam: Beam) -> BeamMatrices:
        """Return the matrices of one plane."""
        return beam_matrices(beam, self.section(), self.length)


@dataclass(frozen=True, kw_only=True)
class LayeredElement:
    """Pieces of shaft inside each other, as a shaft and its sleeve: one deflection and tilt for all.

    Parameters
    ----------
    layers : tuple of ShaftElement
        Of equal length.
    """

    layers: tuple[ShaftElement, ...]

    def __post_init__(self) -> None:
        lengths = {layer.length for layer in self.layers}
        if len(lengths) != 1:
            raise InputError(f"layers must be of equal length, got {sorted(lengths)}")

    @property
    def length(self) -> float:
        """Length [m]."""
        return self.layers[0].length

    @property
    def axial_force(self) -> float:
        """Static tension of all layers [N]."""
        return sum(layer.axial_force for layer in self.layers)

    @property
    def torque(self) -> float:
        """Static torque of all layers [N m]."""
        return sum(layer.torque for layer in self.layers)

    def matrices(self, beam: Beam) -> BeamMatrices:
        """Return the matrices of one plane."""
        sections = [layer.section() for layer in self.layers]
        return beam_matrices(
            beam, Section(*(sum(parts) for parts in zip(*sections, strict=True))), self.length
        )


@dataclass(frozen=True, kw_only=True)
class Coupling:
    """An elastic coupling without length or mass between two nodes; its flanges are disks.

    Parameters
    ----------
    stiffness : float [N/m]
        Against deflection of one side from the other.
    tilt_stiffness : float [N m/rad]
        Against tilt of one side from the other.
    """

    stiffness: float
    tilt_stiffness: float

    length = 0.0
    axial_force = 0.0
    torque = 0.0

    def __post_init__(self) -> None:
        require_positive("stiffness", self.stiffness)
        require_non_negative("tilt_stiffness", self.tilt_stiffness)

    def matrices(self, beam: Beam) -> BeamMatrices:
        """Return the matrices of one plane."""
        springs = np.diag((self.stiffness, self.tilt_stiffness))
        none = np.zeros((4, 4))
        elastic = np.asarray(np.kron([[1.0, -1.0], [-1.0, 1.0]], springs), dtype=float)
        return BeamMatrices(none, none, elastic, none, none)


@dataclass(frozen=True, kw_only=True)
class Disk:
    """A rigid disk on a node.

    Parameters
    ----------
    node : int
    mass : float [kg]
    diametral_inertia, polar_inertia : float [kg m2]
        Moments of inertia about a diameter and about the axis.
    """

    node: int
    mass: float
    diametral_inertia: float = 0.0
    polar_inertia: float = 0.0

    def __post_init__(self) -> None:
        for name in ("mass", "diametral_inertia", "polar_inertia"):
            require_non_negative(name, getattr(self, name))

    @classmethod
    def solid(
        cls, node: int, *, density: float, width: float, outer_diameter: float, inner_diameter: float = 0.0
    ) -> Disk:
        """Return a disk of even thickness with a bore [kg/m3, m]."""
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
    """

    node: int
    name: str = ""
    support: Support | None = None

    def __post_init__(self) -> None:
        if self.name and not self.name.isidentifier():
            raise InputError(f"name must be an identifier or empty, got {self.name!r}")


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
