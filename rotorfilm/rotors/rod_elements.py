"""Rod elements: a shaft that stretches or twists, one degree of freedom a node and one in each element."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Sequence
from typing import Any, NamedTuple

import numpy as np

from ..core.errors import InputError
from ..core.model import Array
from .shaft_elements import POINTS, WEIGHTS, Coupling, Disk, LayeredElement, ShaftElement, ShaftPiece
from .structure import Coordinate, summed

Section = tuple[float | Array, float | Array]
"""Stiffness and inertia of a cross section of a rod: numbers, or arrays at the places `POINTS`."""


class Chain(NamedTuple):
    """Mass, stiffness and damping of a shaft along its axis, or about it: sparse arrays, the nodes first.

    Attributes
    ----------
    mass, stiffness : sparse array, shape (n, n)
    damping : sparse array, shape (n, n)
        Proportional damping of the elements that have one of their own.
    """

    mass: Any
    stiffness: Any
    damping: Any


def axial_chain(elements: Sequence[ShaftPiece], disks: Iterable[Disk]) -> Chain:
    """Return the matrices of a shaft along its axis, of sections with E A [N] and rho A [kg/m]."""

    def section(element: ShaftElement) -> Section:
        mass = element.section().mass
        return element.material.young_modulus / element.material.density * mass, mass

    return _chain(elements, "axial_stiffness", section, ((disk.node, disk.mass) for disk in disks))


def torsional_chain(elements: Sequence[ShaftPiece], disks: Iterable[Disk]) -> Chain:
    """Return the matrices of a shaft about its axis, of sections, round as they are, with G J and rho J."""

    def section(element: ShaftElement) -> Section:
        inertia = 2.0 * element.section().inertia
        return element.material.shear_modulus / element.material.density * inertia, inertia

    return _chain(elements, "twist_stiffness", section, ((disk.node, disk.polar_inertia) for disk in disks))


def chain_coordinates(
    elements: Sequence[ShaftPiece], name: str, unit: str, nominal: float
) -> Iterator[Coordinate]:
    """Yield the coordinates of a chain: those of the nodes, then those inside the elements."""
    yield from ((f"{name}_{node}", unit, nominal) for node in range(len(elements) + 1))
    for number, element in enumerate(elements):
        if not isinstance(element, Coupling):
            yield f"inner_{name}_{number}", unit, nominal


def _rod(
    element: ShaftElement | LayeredElement, section_of: Callable[[ShaftElement], Section]
) -> tuple[Array, Array]:
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
    section_of: Callable[[ShaftElement], Section],
    masses: Iterable[tuple[int, float]],
) -> Chain:
    """Return the matrices of a shaft with masses [kg], or polar moments of inertia [kg m2], at nodes."""
    inside = len(elements) + 1
    inertia = [([node], np.array([[mass]])) for node, mass in masses]
    stiffness: list[tuple[list[int], Array]] = []
    damping: list[tuple[list[int], Array]] = []
    for number, element in enumerate(elements):
        ends = [number, number + 1]
        if isinstance(element, Coupling):
            spring = getattr(element, wanted)
            if spring is None:
                raise InputError(f"{wanted} must be given of the coupling behind node {number}, got None")
            stiffness.append((ends, spring * np.array([[1.0, -1.0], [-1.0, 1.0]])))
            continue
        mass, springs = _rod(element, section_of)
        places = [*ends, inside]
        inertia.append((places, mass))
        stiffness.append((places, springs))
        damping.append((places, element.mass_damping * mass + element.stiffness_damping * springs))
        inside += 1
    return Chain(*(summed(inside, parts) for parts in (inertia, stiffness, damping)))
