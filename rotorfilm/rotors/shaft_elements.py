"""What joins the nodes of a shaft: pieces of shaft of a material, and couplings."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from typing import ClassVar, NamedTuple, Protocol

import numpy as np
from numpy.polynomial import Polynomial
from numpy.polynomial.legendre import leggauss
from numpy.typing import ArrayLike

from ..core.errors import (
    InputError,
    require_each,
    require_finite,
    require_given,
    require_non_negative,
    require_number,
    require_positive,
    warn_user,
)
from ..core.inputs import in_si, quantities
from ..core.model import Array

LEAST_DENSITY = 500.0
"""Density of the lightest shaft [kg/m3]; far less is meant to be none."""

HEAVIEST = 25.0
"""Density of the heaviest metal [g/cm3]."""


@quantities
@dataclass(frozen=True, kw_only=True)
class ElasticMaterial:
    """An elastic material.

    Parameters
    ----------
    young_modulus : float [Pa]
        Elastic modulus in tension.
    shear_modulus : float [Pa]
        Elastic modulus in shear.
    density : float [kg/m3]
        Mass per volume.
    """

    young_modulus: float
    shear_modulus: float
    density: float

    def __post_init__(self) -> None:
        require_each(self, require_positive, "young_modulus", "shear_modulus", "density")
        if 1e-3 * LEAST_DENSITY < self.density < LEAST_DENSITY:
            meant = f": {self.density:g} g/cm3?" if 1.0 < self.density < HEAVIEST else ""
            warn_user(f"density should be at least {LEAST_DENSITY:g} kg/m3, got {self.density:g}{meant}")

    @property
    def poisson_ratio(self) -> float:
        """Poisson's ratio, E / (2 G) - 1 [1]."""
        return self.young_modulus / (2.0 * self.shear_modulus) - 1.0


@quantities
@dataclass(frozen=True, kw_only=True)
class ShaftElement:
    """A piece of shaft between two nodes: a cylinder, or a cone where a diameter changes along it.

    Parameters
    ----------
    length : float [m]
        Length along the axis.
    outer_diameter : float [m]
        Outer diameter at the first node, and along the whole element unless it is a cone.
    inner_diameter : float [m]
        Inner diameter, likewise; 0 for a solid shaft.
    material : ElasticMaterial
    shear_coefficient : float or None [1]
        kappa; by default that of Cowper for a round section (in the middle of a cone), infinite for a section
        without shear deformation.
    end_outer_diameter : float or None [m]
        Outer diameter at the second node of a cone; None for the same as at the first.
    end_inner_diameter : float or None [m]
        Inner diameter there, likewise.
    axial_force : float [N]
        Static tension; negative for compression.
    torque : float [N m]
        Static torque, whose axis follows the tilt of the shaft.
    mass_damping, stiffness_damping : float [1/s, s]
        Proportional damping alpha M + beta K of this piece against the ground, in addition to that of the
        rotor.

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
    mass_damping: float = 0.0
    stiffness_damping: float = 0.0

    def __post_init__(self) -> None:
        require_positive("length", self.length)
        require_each(self, require_non_negative, "mass_damping", "stiffness_damping")
        require_each(self, require_number, "axial_force", "torque")
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
        """Return this piece of shaft as several elements of equal length."""
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
        """Return stiffness and inertia of the cross section; for a cone they vary along its length."""
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


@quantities
@dataclass(frozen=True, kw_only=True)
class LayeredElement:
    """Concentric pieces of shaft, such as a shaft and its sleeve, with the same deflection and tilt.

    Parameters
    ----------
    layers : tuple of ShaftElement
        Layers of equal length and proportional damping.
    """

    layers: tuple[ShaftElement, ...]

    def __post_init__(self) -> None:
        lengths = {layer.length for layer in self.layers}
        if len(lengths) != 1:
            raise InputError(f"layers must be of equal length, got {sorted(lengths)}")
        dampings = {(layer.mass_damping, layer.stiffness_damping) for layer in self.layers}
        if len(dampings) != 1:
            raise InputError(
                f"layers must have equal mass_damping, stiffness_damping, got {sorted(dampings)}"
            )

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

    @property
    def mass_damping(self) -> float:
        """Mass-proportional damping coefficient of every layer [1/s]."""
        return self.layers[0].mass_damping

    @property
    def stiffness_damping(self) -> float:
        """Stiffness-proportional damping coefficient of every layer [s]."""
        return self.layers[0].stiffness_damping

    def matrices(self, beam: Beam) -> BeamMatrices:
        """Return the matrices of one plane."""
        sections = [layer.section() for layer in self.layers]
        return beam_matrices(
            beam, Section(*(sum(parts) for parts in zip(*sections, strict=True))), self.length
        )


@quantities
@dataclass(frozen=True, kw_only=True)
class Coupling:
    """An elastic coupling without length or mass between two nodes; its flanges are disks.

    Parameters
    ----------
    stiffness : float [N/m]
        Stiffness against relative deflection of both sides.
    tilt_stiffness : float [N m/rad]
        Stiffness against relative tilt of both sides.
    axial_stiffness : float or None [N/m]
        Axial stiffness; needed for axial modes.
    twist_stiffness : float or None [N m/rad]
        Torsional stiffness; needed for torsional modes.
    """

    stiffness: float
    tilt_stiffness: float
    axial_stiffness: float | None = None
    twist_stiffness: float | None = None

    length = 0.0
    axial_force = 0.0
    torque = 0.0
    mass_damping = 0.0
    stiffness_damping = 0.0

    def __post_init__(self) -> None:
        require_positive("stiffness", self.stiffness)
        require_non_negative("tilt_stiffness", self.tilt_stiffness)
        require_given(self, require_positive, "axial_stiffness", "twist_stiffness")

    def matrices(self, beam: Beam) -> BeamMatrices:
        """Return the matrices of one plane."""
        springs = np.diag((self.stiffness, self.tilt_stiffness))
        none = np.zeros((4, 4))
        elastic = np.asarray(np.kron([[1.0, -1.0], [-1.0, 1.0]], springs), dtype=float)
        return BeamMatrices(none, none, elastic, none, none)


ShaftPiece = ShaftElement | LayeredElement | Coupling
"""What joins one node to the next."""


# Beam elements: stiffness, mass and polar inertia of a straight piece of shaft in one plane.
#
# Degrees of freedom are the deflection w and the tilt of the cross section theta at both ends, in the
# order w0, theta0, w1, theta1, then those inside the element. A cross section that does not shear has
# theta = dw/dz.


_NODES, _WEIGHTS = leggauss(7)
"""Exact to degree 13: the mass of the fourth-order element has degree 8, on a cone 10. One is the middle."""

POINTS = 0.5 * (_NODES + 1.0)
"""Places z / length at which a section that varies along an element is given."""

WEIGHTS = 0.5 * _WEIGHTS
"""Weights of these places, with the sum 1."""


class BeamMatrices(NamedTuple):
    """Matrices of one plane, shape (n, n) each.

    Attributes
    ----------
    mass, polar, stiffness : ndarray
        Mass, polar inertia and stiffness of translation and of rotation about a diameter; of rotation about
        the axis, as it acts on the tilt; of bending and shear. Entries are per w [m] and theta [rad].
    geometric : ndarray
        Stiffness per axial tension [1/N of the above].
    twist : ndarray
        Stiffness of x per torque and displacement along y; of y against x it is the opposite.
    """

    mass: Array
    polar: Array
    stiffness: Array
    geometric: Array
    twist: Array


class Section(NamedTuple):
    """What a beam needs to know about its cross section: numbers, or arrays at the places `POINTS`.

    Attributes
    ----------
    bending : float [N m2]
        E I.
    shear : float [N]
        kappa G A; infinite for a cross section that does not shear.
    mass : float [kg/m]
        rho A.
    inertia : float [kg m]
        rho I, rotary inertia about a diameter per length; the polar one is twice as large.
    """

    bending: float | Array
    shear: float | Array
    mass: float | Array
    inertia: float | Array


class Beam(Protocol):
    """How deflection and tilt vary along an element."""

    order: ClassVar[int]

    @property
    def internal(self) -> int:
        """Number of degrees of freedom inside the element."""

    def shapes(self, length: float, shear_ratio: float) -> list[tuple[Polynomial, Polynomial]]:
        """Return (w [m], theta [1]) over z / length for each degree of freedom.

        Parameters
        ----------
        length : float [m]
        shear_ratio : float [1]
            12 E I / (kappa G A length^2).
        """


@dataclass(frozen=True)
class ClassicalBeam:
    """The classical beam element with two nodes, exact under end forces, as in textbooks and most codes.

    Shear and moment between the ends follow from the end forces only. So the eigenvalues of a shaft with
    shear converge at second order, and without shear at fourth order. See Przemieniecki (1968), Nelson
    (1980), J. Mech. Des. 102, 793-803.
    """

    order: ClassVar[int] = 2
    """Order of convergence of the eigenvalues in the length of the elements."""

    @property
    def internal(self) -> int:
        """Number of internal degrees of freedom, which is 0."""
        return 0

    def shapes(self, length: float, shear_ratio: float) -> list[tuple[Polynomial, Polynomial]]:
        """Return the responses of the element to unit displacements of its ends."""
        p, c = shear_ratio, 1.0 / (1.0 + shear_ratio)
        deflections = (
            (c, (1.0 + p, -p, -3.0, 2.0)),
            (c * length, (0.0, 1.0 + p / 2.0, -2.0 - p / 2.0, 1.0)),
            (c, (0.0, p, 3.0, -2.0)),
            (c * length, (0.0, -p / 2.0, p / 2.0 - 1.0, 1.0)),
        )
        tilts = (
            (6.0 * c / length, (0.0, -1.0, 1.0)),
            (c, (1.0 + p, -4.0 - p, 3.0)),
            (6.0 * c / length, (0.0, 1.0, -1.0)),
            (c, (0.0, p - 2.0, 3.0)),
        )
        return [
            (a * Polynomial(w), b * Polynomial(theta))
            for (a, w), (b, theta) in zip(deflections, tilts, strict=True)
        ]


@dataclass(frozen=True)
class FourthOrderBeam:
    """A beam element with two internal degrees of freedom: eigenvalues of fourth order, also with shear.

    The internal shapes are the responses of the element, clamped at both ends, to a uniform transverse load
    and to a uniform moment. These are the inertia loads between the ends, to leading order.
    """

    order: ClassVar[int] = 4
    """Order of convergence of the eigenvalues in the length of the elements."""

    @property
    def internal(self) -> int:
        """Number of internal degrees of freedom: two, for a uniform load and a uniform moment."""
        return 2

    def shapes(self, length: float, shear_ratio: float) -> list[tuple[Polynomial, Polynomial]]:
        """Return the shapes of `ClassicalBeam`, and two further shapes of an element with clamped ends."""
        p = shear_ratio
        even_load = Polynomial((0.0, p, 1.0 - p, -2.0, 1.0))
        sheared = p * Polynomial((1.0, -2.0))
        even_moment = Polynomial((0.0, -1.0, 3.0, -2.0))
        return [
            *ClassicalBeam().shapes(length, shear_ratio),
            (length * even_load, even_load.deriv() - sheared),
            (length * even_moment, Polynomial((0.0, 6.0, -6.0))),
        ]


def beam_matrices(beam: Beam, section: Section, length: float) -> BeamMatrices:
    """Return the matrices of an element.

    The energies are integrated by Gauss's rule, which is exact here. Where the section varies, the shapes are
    those of the section in the middle, as in most codes.

    Parameters
    ----------
    beam : Beam
    section : Section
    length : float [m]

    Raises
    ------
    InputError
        If the section does not shear, but the element has shear among its degrees of freedom.

    Notes
    -----
    With the virtual displacements dw, dtheta, axial tension P adds P int dw' w'. A torque T that follows the
    shaft adds T int (dtheta_x theta_y' - dw_x' theta_y' + dtheta_x' w_y') to the plane of x and the opposite
    to that of y (Friswell et al. 2010, section 5.4); without shear that is T int dtheta_x' theta_y.
    """
    bending, shear, mass, inertia = np.broadcast_arrays(*section, POINTS)[:4]
    middle, sheared = len(POINTS) // 2, bool(np.isfinite(shear).all())
    if beam.internal and not sheared:
        raise InputError(f"shear_coefficient must be finite for {beam!r}, got inf; ClassicalBeam() allows it")
    shapes = beam.shapes(length, float(12.0 * bending[middle] / (shear[middle] * length**2)))
    weights = length * WEIGHTS
    w, slope, theta, curvature = (
        np.array(rows)
        for rows in (
            [shape(POINTS) for shape, _ in shapes],
            [shape.deriv()(POINTS) / length for shape, _ in shapes],
            [tilt(POINTS) for _, tilt in shapes],
            [tilt.deriv()(POINTS) / length for _, tilt in shapes],
        )
    )
    stiffness = _product(curvature, curvature, bending * weights)
    if sheared:
        stiffness += _product(slope - theta, slope - theta, shear * weights)
    rotary = _product(theta, theta, inertia * weights)
    mixed = _product(slope, curvature, weights)
    return BeamMatrices(
        mass=_product(w, w, mass * weights) + rotary,
        polar=2.0 * rotary,
        stiffness=stiffness,
        geometric=_product(slope, slope, weights),
        twist=_product(theta, curvature, weights) - mixed + mixed.T,
    )


def cowper_coefficient(poisson_ratio: float, bore_ratio: float = 0.0) -> float:
    """Return the shear coefficient kappa [1] of a round cross section.

    Cowper (1966), J. Appl. Mech. 33, 335-340: the mean over the cross section of the three-dimensional
    solution of a cantilever under an end force.

    Parameters
    ----------
    poisson_ratio : float [1]
    bore_ratio : float [1]
        Inner / outer diameter.
    """
    nu, square = require_number("poisson_ratio", poisson_ratio), (1.0 + bore_ratio**2) ** 2
    return 6.0 * (1.0 + nu) * square / ((7.0 + 6.0 * nu) * square + (20.0 + 12.0 * nu) * bore_ratio**2)


def round_section(
    *,
    outer_diameter: float | Array,
    inner_diameter: float | Array,
    young_modulus: float,
    shear: float,
    density: float,
) -> Section:
    """Return the section of a round shaft; `shear` is kappa G [Pa], the other units are SI."""
    area = 0.25 * math.pi * (outer_diameter**2 - inner_diameter**2)
    second_moment = area * (outer_diameter**2 + inner_diameter**2) / 16.0
    return Section(young_modulus * second_moment, shear * area, density * area, density * second_moment)


def _product(left: Array, right: Array, weights: Array) -> Array:
    return (left * weights) @ right.T


# What sits at the nodes of a shaft: disks, bearing stations, springs, probes, unbalance.


Pair = tuple[tuple[float, float], tuple[float, float]]


@quantities
@dataclass(frozen=True, kw_only=True)
class Disk:
    """A rigid disk on a node.

    Parameters
    ----------
    node : int
        Index of the node, from 0 at the first end of the shaft.
    mass : float [kg]
    diametral_inertia : float [kg m2]
        Moment of inertia about a diameter.
    polar_inertia : float [kg m2]
        Moment of inertia about the axis.
    skew : float [rad]
        Angle between the axis of the disk and that of the shaft; it excites vibration like an unbalance.
    skew_angle : float [rad]
        Angle from +x at t = 0, positive about +z, of the plane in which the disk axis is inclined, in the
        direction in which it leans for rising z.
    """

    node: int
    mass: float
    diametral_inertia: float = 0.0
    polar_inertia: float = 0.0
    skew: float = 0.0
    skew_angle: float = 0.0

    def __post_init__(self) -> None:
        require_each(self, require_number, "skew", "skew_angle")
        require_each(self, require_non_negative, "mass", "diametral_inertia", "polar_inertia")
        if 0.0 < self.diametral_inertia < 0.499 * self.polar_inertia:
            warn_user(
                "diametral_inertia should be at least half of polar_inertia, as that of every body is, got "
                f"{self.diametral_inertia:g} of {self.polar_inertia:g} kg m2"
            )

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
    """An elastic support of a bearing housing, in series with the bearing.

    Parameters
    ----------
    mass : float [kg]
        Mass of the housing.
    stiffness : float [N/m] or 2 x 2 numbers
        Stiffness from the housing to the ground; one number is the same in both directions.
    damping : float [N s/m] or 2 x 2 numbers
        Damping in parallel with that stiffness.

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
    """Springs and dampers against the tilt of a node, for example of a long bearing or a clamp.

    Parameters
    ----------
    node : int
        Index of the node, from 0 at the first end of the shaft.
    stiffness : float [N m/rad] or 2 x 2 numbers
        Moments against the slopes of the shaft in the x-z plane and in the y-z plane; one number is the same
        in both.
    damping : float [N m s/rad] or 2 x 2 numbers
        Moments against the rates of these slopes.

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
    """A bearing location: a journal at a node, in a housing that is rigid unless it has a support.

    Parameters
    ----------
    node : int
    name : str
        Prefix of its signals, such as `left` in `left_force_x`. At most one station may have an empty name;
        `simulate` and `cosimulate` connect a single film with it.
    support : Support, optional
        Elastic support of the housing, which moves along x and y and does not tilt. None for a rigid housing.
    feels_tilt : bool
        Whether the bearing may also resist the tilt of the shaft, as `MomentCarryingBalls` do.
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
        Index of the node, from 0 at the first end of the shaft.
    name : str
        Prefix of its outputs.
    angle : float [rad]
        From +x to the first of two sensors, which has the output `name_x`; the other is a quarter of a turn
        further about +z.
    """

    node: int
    name: str
    angle: float = 0.0

    def __post_init__(self) -> None:
        require_number("angle", self.angle)
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
