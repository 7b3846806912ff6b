"""A shaft that stretches, or twists: one degree of freedom a node, and one in each element."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any, NamedTuple

import numpy as np

from ...errors import InputError
from ...model import Array
from ..sparse_chain import summed
from .beam import POINTS, WEIGHTS
from .elements import Coupling, LayeredElement, ShaftElement, ShaftPiece


class RodSection(NamedTuple):
    """What a rod needs to know about its cross section: numbers, or arrays at the places `POINTS`.

    Attributes
    ----------
    stiffness : float
        E A [N], or G J [N m2].
    inertia : float
        rho A [kg/m], or rho J [kg m].
    """

    stiffness: float | Array
    inertia: float | Array


class StraightChain(NamedTuple):
    """Matrices of a shaft along its axis, or about it; the nodes come first.

    Attributes
    ----------
    mass, stiffness : sparse array, shape (n, n)
    """

    mass: Any
    stiffness: Any


def axial_section(element: ShaftElement) -> RodSection:
    """Return E A and rho A of an element."""
    mass = element.section().mass
    return RodSection(element.material.young_modulus / element.material.density * mass, mass)


def twist_section(element: ShaftElement) -> RodSection:
    """Return G J and rho J of an element, round as it is."""
    inertia = 2.0 * element.section().inertia
    return RodSection(element.material.shear_modulus / element.material.density * inertia, inertia)


def axial_chain(elements: Sequence[ShaftPiece], masses: Sequence[tuple[int, float]]) -> StraightChain:
    """Return the matrices of a shaft that stretches, with masses [kg] at nodes."""
    springs = [e.axial_stiffness if isinstance(e, Coupling) else None for e in elements]
    rods = [None if isinstance(e, Coupling) else _rod(e, axial_section) for e in elements]
    return _chain(elements, "axial_stiffness", springs, rods, masses)


def twist_chain(elements: Sequence[ShaftPiece], inertias: Sequence[tuple[int, float]]) -> StraightChain:
    """Return the matrices of a shaft that twists, with polar moments of inertia [kg m2] at nodes."""
    springs = [e.twist_stiffness if isinstance(e, Coupling) else None for e in elements]
    rods = [None if isinstance(e, Coupling) else _rod(e, twist_section) for e in elements]
    return _chain(elements, "twist_stiffness", springs, rods, inertias)


def _rod(element: ShaftElement | LayeredElement, section_of: Any) -> tuple[Array, Array]:
    """Return mass and stiffness of an element, over both nodes and its middle."""
    layers = element.layers if isinstance(element, LayeredElement) else (element,)
    sections = [section_of(layer) for layer in layers]
    stiffness, inertia = (np.broadcast_to(sum(part), POINTS.shape) for part in zip(*sections, strict=True))
    s = POINTS
    shapes = np.array([(1.0 - s) * (1.0 - 2.0 * s), s * (2.0 * s - 1.0), 4.0 * s * (1.0 - s)])
    slopes = np.array([4.0 * s - 3.0, 4.0 * s - 1.0, 4.0 - 8.0 * s]) / element.length
    weights = element.length * WEIGHTS
    return (shapes * inertia * weights) @ shapes.T, (slopes * stiffness * weights) @ slopes.T


def _chain(
    elements: Sequence[ShaftPiece],
    wanted: str,
    springs: Sequence[float | None],
    rods: Sequence[tuple[Array, Array] | None],
    masses: Sequence[tuple[int, float]],
) -> StraightChain:
    count = len(elements) + 1
    size = count + sum(rod is not None for rod in rods)
    inertia = [([node], np.array([[mass]])) for node, mass in masses]
    stiffness: list[tuple[list[int], Array]] = []
    inside = count
    for number, (rod, spring) in enumerate(zip(rods, springs, strict=True)):
        ends = [number, number + 1]
        if rod is None:
            if spring is None:
                raise InputError(f"{wanted} must be given of the coupling behind node {number}, got None")
            stiffness.append((ends, spring * np.array([[1.0, -1.0], [-1.0, 1.0]])))
            continue
        inertia.append(([*ends, inside], rod[0]))
        stiffness.append(([*ends, inside], rod[1]))
        inside += 1
    return StraightChain(summed(size, inertia), summed(size, stiffness))
