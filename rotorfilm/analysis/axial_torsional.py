"""Modes and response of a shaft along its axis, and its modes about it."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Any, ClassVar

import numpy as np
from numpy.typing import ArrayLike, NDArray
from scipy.linalg import eig

from ..core.errors import (
    EquilibriumError,
    InputError,
    require_count,
    require_finite,
    require_non_negative,
    require_number,
)
from ..core.inputs import arguments, quantities
from ..core.model import Array
from ..core.port import MOST_LEFT
from ..core.readable import Readable
from ..rotors import Coupling, LayeredElement, ShaftRotor
from ..rotors.shaft_elements import POINTS, WEIGHTS, ShaftElement, ShaftPiece
from ..rotors.structure import dense_matrix, summed
from .closed_loop import checked_speeds, frequency_response

if TYPE_CHECKING:
    import control

_SWINGS = 1e-6
"""Frequency / size of an eigenvalue, above which a motion swings."""


Section = tuple[float | Array, float | Array]
"""Stiffness and inertia of a cross section of a rod: numbers, or arrays at the places `POINTS`."""

Chain = tuple[Any, Any]
"""Mass and stiffness of a shaft along its axis, or about it, sparse arrays; the nodes come first."""


@dataclass(frozen=True, kw_only=True)
class _Spring:
    """A spring and a damper from a node to the ground."""

    node: int
    stiffness: float
    damping: float = 0.0

    def __post_init__(self) -> None:
        require_non_negative("stiffness", self.stiffness)
        require_non_negative("damping", self.damping)


@quantities
@dataclass(frozen=True, kw_only=True)
class ThrustBearing(_Spring):
    """A spring and a damper along the shaft, from a node to the ground.

    Parameters
    ----------
    node : int
    stiffness : float [N/m]
    damping : float [N s/m]
    """


@quantities
@dataclass(frozen=True, kw_only=True)
class TorsionalSpring(_Spring):
    """A spring and a damper about the shaft, from a node to the ground.

    Parameters
    ----------
    node : int
    stiffness : float [N m/rad]
    damping : float [N m s/rad]
    """


@dataclass(frozen=True, kw_only=True)
class AxialTorsionalModes(Readable):
    """Modes of a shaft along its axis, or about it, that swing, by rising size of the eigenvalue.

    Attributes
    ----------
    eigenvalues : ndarray, shape (n,) [1/s]
        0 for the motion of a free shaft as a whole.
    shapes : ndarray, shape (n_nodes, n)
        Complex motion of the nodes, largest 1.
    """

    eigenvalues: NDArray[np.complex128]
    shapes: NDArray[np.complex128]

    _shown: ClassVar[tuple[str, ...]] = ("frequency", "damping_ratio")

    @property
    def frequency(self) -> Array:
        """Damped frequency [rad/s]."""
        return self.eigenvalues.imag

    @property
    def damping_ratio(self) -> Array:
        """-Re / |eigenvalue| [1], 0 for the motion as a whole."""
        size = np.abs(self.eigenvalues)
        return np.asarray(-self.eigenvalues.real / np.where(size > 0.0, size, 1.0))


@arguments
def axial_modes(
    rotor: ShaftRotor, bearings: Sequence[ThrustBearing] = (), count: int = 6
) -> AxialTorsionalModes:
    """Return the lowest modes of a rotor along its axis that swing; those overdamped are left out.

    Parameters
    ----------
    rotor : ShaftRotor
        Its disks move with their nodes; a coupling must have an `axial_stiffness`.
    bearings : sequence of ThrustBearing
        None for a free shaft.
    count : int
        Most modes.

    Raises
    ------
    InputError
        If a bearing is on no node, or a coupling has no stiffness.

    Notes
    -----
    Elements have a degree of freedom inside: frequencies are of fourth order in their length. Along its axis
    a straight shaft does not feel its bending and its rotation.
    """
    return _modes(axial_of(rotor), rotor, bearings, count)


@arguments
def torsional_modes(
    rotor: ShaftRotor, springs: Sequence[TorsionalSpring] = (), count: int = 6
) -> AxialTorsionalModes:
    """Return the lowest torsional modes of a rotor that swing; those overdamped are left out.

    Parameters
    ----------
    rotor : ShaftRotor
        A coupling must have a `twist_stiffness`.
    springs : sequence of TorsionalSpring
        None for a free shaft.
    count : int
        Most modes.

    Raises
    ------
    InputError
        If a spring is on no node, or a coupling has no stiffness.
    """
    return _modes(twist_of(rotor), rotor, springs, count)


@arguments
def axial_response(
    rotor: ShaftRotor, bearings: Sequence[ThrustBearing], frequencies: ArrayLike, node: int
) -> control.FrequencyResponseData:
    """Return the response of a rotor to a force along its axis, over frequency.

    Parameters
    ----------
    rotor : ShaftRotor
    bearings : sequence of ThrustBearing
    frequencies : array_like, shape (n,) [rad/s]
        Positive and rising.
    node : int
        Where the force acts.

    Returns
    -------
    control.FrequencyResponseData
        Input `force_z` [N]; outputs `z_0`, `z_1` and so on, displacements of the nodes along +z [m].
    """
    grid = checked_speeds(frequencies, "frequencies")
    require_shaft_node("node", node, rotor)
    chain = axial_of(rotor)
    stiffness, damping = grounded(chain, rotor, bearings)
    mass, count = dense_matrix(chain[0]), len(rotor.elements) + 1
    load = np.zeros(len(stiffness))
    load[node] = 1.0
    found = [np.linalg.solve(stiffness - w**2 * mass + 1j * w * damping, load)[:count, None] for w in grid]
    return frequency_response(found, grid, ["force_z"], [f"z_{k}" for k in range(count)], "axial_response")


def axial_of(rotor: ShaftRotor) -> Chain:
    """Return the matrices of a rotor along its axis, of sections with E A [N] and rho A [kg/m]."""

    def section(element: ShaftElement) -> Section:
        mass = element.section().mass
        return element.material.young_modulus / element.material.density * mass, mass

    return _chain(
        rotor.elements, "axial_stiffness", section, ((disk.node, disk.mass) for disk in rotor.disks)
    )


def twist_of(rotor: ShaftRotor) -> Chain:
    """Return the matrices of a rotor about its axis, of sections, round as they are, with G J and rho J."""

    def section(element: ShaftElement) -> Section:
        inertia = 2.0 * element.section().inertia
        return element.material.shear_modulus / element.material.density * inertia, inertia

    disks = ((disk.node, disk.polar_inertia) for disk in rotor.disks)
    return _chain(rotor.elements, "twist_stiffness", section, disks)


def require_shaft_node(name: str, node: int, rotor: ShaftRotor) -> None:
    """Raise InputError unless a rotor has this node."""
    if not isinstance(node, int) or not 0 <= node <= len(rotor.elements):
        raise InputError(f"{name} must be on a node 0 to {len(rotor.elements)}, got node {node!r}")


def grounded(chain: Chain, rotor: ShaftRotor, springs: Sequence[_Spring]) -> tuple[Array, Array]:
    """Return stiffness and damping with the springs to the ground, dense."""
    stiffness = dense_matrix(chain[1])
    damping = np.zeros_like(stiffness)
    for spring in springs:
        require_shaft_node("bearings", spring.node, rotor)
        stiffness[spring.node, spring.node] += spring.stiffness
        damping[spring.node, spring.node] += spring.damping
    return stiffness, damping


def _modes(chain: Chain, rotor: ShaftRotor, springs: Sequence[_Spring], count: int) -> AxialTorsionalModes:
    require_count("count", count)
    stiffness, damping = grounded(chain, rotor, springs)
    mass = dense_matrix(chain[0])
    n = len(mass)
    upper = np.hstack([np.zeros((n, n)), np.eye(n)])
    values, vectors = eig(np.vstack([upper, -np.linalg.solve(mass, np.hstack([stiffness, damping]))]))
    size = np.abs(values)
    held = any(spring.stiffness > 0.0 for spring in springs)
    order, swings = np.argsort(size), values.imag > _SWINGS * size
    whole = [] if held else [0.0j]
    # A free shaft in one piece has 0 twice, by roundoff two real ones or a pair; with dampers once.
    first = 0 if held else 1 if values[order[0]].imag == 0.0 else 2
    chosen = [k for k in order[first:] if swings[k]]
    shapes = [np.ones(n, dtype=complex)] if whole else []
    shapes += [vectors[:n, k] for k in chosen]
    nodes = np.array(shapes).T[: len(rotor.elements) + 1]
    largest = np.array([column[np.argmax(np.abs(column))] for column in nodes.T])
    found = np.array([*whole, *values[chosen]], dtype=complex)[:count]
    return AxialTorsionalModes(eigenvalues=found, shapes=(nodes / largest)[:, :count])


# A shaft under static forces along its axis, and what its tension does to bending.


@dataclass(frozen=True, kw_only=True)
class AxialStatics(Readable):
    """A shaft under forces along its axis.

    Attributes
    ----------
    displacement : ndarray, shape (n_nodes,) [m]
        Along +z.
    tension : ndarray, shape (n_elements,) [N]
        Of each element, positive where it is stretched.
    thrust : ndarray, shape (n_bearings,) [N]
        On each thrust bearing, along +z.
    """

    displacement: Array
    tension: Array
    thrust: Array


@arguments
def axial_statics(
    rotor: ShaftRotor, bearings: Sequence[ThrustBearing], forces: Mapping[int, float]
) -> AxialStatics:
    """Return displacement, tension and thrust of a rotor under static forces along its axis.

    Parameters
    ----------
    rotor : ShaftRotor
    bearings : sequence of ThrustBearing
        With some stiffness.
    forces : mapping of int to float [N]
        By node, along +z.

    Raises
    ------
    InputError
        If a node does not exist, or no bearing holds the shaft.
    EquilibriumError
        If the bearings are so soft beside the shaft that roundoff decides what they carry.
    """
    chain = axial_of(rotor)
    stiffness, _ = grounded(chain, rotor, bearings)
    if not any(bearing.stiffness > 0.0 for bearing in bearings):
        raise InputError("bearings must hold the shaft along its axis, got none with a stiffness")
    load = np.zeros(len(stiffness))
    for node, force in forces.items():
        require_shaft_node("forces", node, rotor)
        load[node] += require_number(f"forces[{node}]", force)
    moved: Array = np.asarray(np.linalg.solve(stiffness, load), dtype=float)
    held = {b.node: 0.0 for b in bearings}
    thrust = np.array([b.stiffness * moved[b.node] for b in bearings])
    left, size = abs(float(thrust.sum() - load.sum())), float(np.abs(load).sum())
    if not left <= MOST_LEFT * size:
        raise EquilibriumError(
            "bearings must be stiff enough beside the shaft to hold it along its axis, got stiffnesses of "
            f"{[b.stiffness for b in bearings]} N/m, which leave {left:.3g} N of {size:.3g} N to roundoff"
        )
    for bearing, force in zip(bearings, thrust, strict=True):
        held[bearing.node] += force
    # Of what acts on the nodes up to an element, its tension is the opposite.
    outer = load[: len(rotor.elements) + 1].copy()
    for node, force in held.items():
        outer[node] -= force
    return AxialStatics(displacement=moved[: len(outer)], tension=-np.cumsum(outer)[:-1], thrust=thrust)


@arguments
def stress_stiffened(rotor: ShaftRotor, at: AxialStatics) -> ShaftRotor:
    """Return a rotor whose elements have the tension of a static state, which stiffens their bending.

    Parameters
    ----------
    rotor : ShaftRotor
    at : AxialStatics
        Of this rotor, or of one with as many elements.

    Raises
    ------
    InputError
        If it has another number of elements, or tension in a coupling.
    """
    tension = require_finite("tension", at.tension)
    if len(tension) != len(rotor.elements):
        raise InputError(f"at must be of {len(rotor.elements)} elements, got {len(tension)}")
    pairs = zip(rotor.elements, tension.tolist(), strict=True)
    return replace(rotor, elements=tuple(_stretched(*pair) for pair in pairs))


def _stretched(element: ShaftPiece, tension: float) -> ShaftPiece:
    if isinstance(element, Coupling):
        return element
    if isinstance(element, LayeredElement):
        first, *others = element.layers
        rest = sum(layer.axial_force for layer in others)
        return replace(element, layers=(replace(first, axial_force=tension - rest), *others))
    return replace(element, axial_force=tension)


# A shaft that stretches, or twists: one degree of freedom a node, and one in each element.


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
    for number, element in enumerate(elements):
        ends = [number, number + 1]
        if isinstance(element, Coupling):
            spring = getattr(element, wanted)
            if spring is None:
                raise InputError(f"{wanted} must be given of the coupling behind node {number}, got None")
            stiffness.append((ends, spring * np.array([[1.0, -1.0], [-1.0, 1.0]])))
            continue
        mass, springs = _rod(element, section_of)
        inertia.append(([*ends, inside], mass))
        stiffness.append(([*ends, inside], springs))
        inside += 1
    return summed(inside, inertia), summed(inside, stiffness)
