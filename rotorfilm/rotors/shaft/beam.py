"""Beam elements: stiffness, mass and polar inertia of a straight piece of shaft in one plane.

Degrees of freedom are the deflection w and the tilt of the cross section theta at both ends, in the order
w0, theta0, w1, theta1, then those inside the element. A cross section that does not shear has theta = dw/dz.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import ClassVar, NamedTuple, Protocol

import numpy as np
from numpy.polynomial import Polynomial
from numpy.polynomial.legendre import leggauss

from ...errors import InputError, require_number
from ...model import Array

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
        Of translation and of rotation about a diameter; of rotation about the axis, as it acts on the tilt;
        of bending and shear. Entries are per w [m] and theta [rad].
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
    """The element with two nodes that is exact under end forces, as textbooks and most codes have it.

    Shear and moment between the ends follow the end forces only, so that the eigenvalues of a shaft with
    shear converge at second order in the end; without shear at fourth order. Przemieniecki (1968), Nelson
    (1980), J. Mech. Des. 102, 793-803.
    """

    order: ClassVar[int] = 2
    """Order of convergence of the eigenvalues in the length of the elements."""

    @property
    def internal(self) -> int:
        """No degree of freedom inside."""
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
    """The classical element with two degrees of freedom inside, for eigenvalues of fourth order with shear.

    They are the responses of the element, clamped at both ends, to an even transverse load and to an even
    moment: what inertia exerts between the ends, to leading order.
    """

    order: ClassVar[int] = 4
    """Order of convergence of the eigenvalues in the length of the elements."""

    @property
    def internal(self) -> int:
        """Two degrees of freedom inside: an even load and an even moment."""
        return 2

    def shapes(self, length: float, shear_ratio: float) -> list[tuple[Polynomial, Polynomial]]:
        """Return the shapes of `ClassicalBeam` and the two of the clamped element."""
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
    With the virtual displacements dw, dtheta, axial tension P adds P int dw' w', and a torque T that follows
    the shaft adds T int (dtheta_x theta_y' - dw_x' theta_y' + dtheta_x' w_y') to the plane of x and the
    opposite to that of y (Friswell et al. 2010, section 5.4); without shear that is T int dtheta_x' theta_y.
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
