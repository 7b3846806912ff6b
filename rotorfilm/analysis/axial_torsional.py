"""Modes and response of a shaft along its axis, and its modes about it."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Any, ClassVar

import numpy as np
from numpy.typing import ArrayLike, NDArray
from scipy.linalg import eig

from ..core.dynamic_stiffness import small_motion
from ..core.errors import (
    EquilibriumError,
    InputError,
    require_count,
    require_each,
    require_finite,
    require_non_negative,
    require_number,
)
from ..core.inputs import arguments, quantities
from ..core.model import Array
from ..core.port import MOST_LEFT, Bearings, freedoms_of
from ..core.readable import Readable
from ..rotors import Coupling, LayeredElement, ShaftRotor, SkewedCollar
from ..rotors.rod_elements import Chain, axial_chain, torsional_chain
from ..rotors.shaft_elements import ShaftPiece
from ..rotors.structure import dense_matrix, freedom_rows
from .closed_loop import checked_speeds, frequency_response, synchronous_response
from .rotor_equilibrium import rotor_equilibrium
from .threads import one_blas_thread

if TYPE_CHECKING:
    import control

_SWINGS = 1e-6
"""Frequency / size of an eigenvalue, above which a motion swings."""


@dataclass(frozen=True, kw_only=True)
class _Spring:
    """A spring and a damper from a node to the ground."""

    node: int
    stiffness: float
    damping: float = 0.0

    def __post_init__(self) -> None:
        require_each(self, require_non_negative, "stiffness", "damping")


@quantities
@dataclass(frozen=True, kw_only=True)
class AxialSpring(_Spring):
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
    """Axial or torsional modes of a shaft that oscillate, in the order of rising |eigenvalue|.

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
        """Damping ratio, -Re / |eigenvalue| [1]; 0 for rigid-body motion."""
        size = np.abs(self.eigenvalues)
        return np.asarray(-self.eigenvalues.real / np.where(size > 0.0, size, 1.0))


@one_blas_thread
@arguments
def axial_modes(
    rotor: ShaftRotor, bearings: Sequence[AxialSpring] = (), count: int = 6
) -> AxialTorsionalModes:
    """Return the lowest axial modes of a rotor. Overdamped modes are left out.

    Parameters
    ----------
    rotor : ShaftRotor
        Its disks move with their nodes; a coupling must have an `axial_stiffness`.
    bearings : sequence of AxialSpring
        None for a free shaft.
    count : int
        Largest number of modes.

    Raises
    ------
    InputError
        If a bearing is on no node, or a coupling has no stiffness.

    Notes
    -----
    Each element has an internal degree of freedom, so frequencies converge at fourth order in the element
    length. The axial motion of a straight shaft does not depend on its bending and its rotation.
    """
    return _modes(axial_chain(rotor.elements, rotor.disks), rotor, bearings, count)


@one_blas_thread
@arguments
def torsional_modes(
    rotor: ShaftRotor, springs: Sequence[TorsionalSpring] = (), count: int = 6
) -> AxialTorsionalModes:
    """Return the lowest torsional modes of a rotor. Overdamped modes are left out.

    Parameters
    ----------
    rotor : ShaftRotor
        A coupling must have a `twist_stiffness`.
    springs : sequence of TorsionalSpring
        None for a free shaft.
    count : int
        Largest number of modes.

    Raises
    ------
    InputError
        If a spring is on no node, or a coupling has no stiffness.
    """
    return _modes(torsional_chain(rotor.elements, rotor.disks), rotor, springs, count)


@one_blas_thread
@arguments
def axial_response(
    rotor: ShaftRotor, bearings: Sequence[AxialSpring], frequencies: ArrayLike, node: int
) -> control.FrequencyResponseData:
    """Return the response of a rotor to a force along its axis, over frequency.

    Parameters
    ----------
    rotor : ShaftRotor
    bearings : sequence of AxialSpring
    frequencies : array_like, shape (n,) [rad/s]
        Positive and rising.
    node : int
        Node where the force acts.

    Returns
    -------
    control.FrequencyResponseData
        Input `force_z` [N]; outputs `z_0`, `z_1` and so on, displacements of the nodes along +z [m].
    """
    grid = checked_speeds(frequencies, "frequencies")
    require_shaft_node("node", node, rotor)
    chain = axial_chain(rotor.elements, rotor.disks)
    stiffness, damping = grounded(chain, rotor, bearings)
    mass, count = dense_matrix(chain.mass), len(rotor.elements) + 1
    load = np.zeros(len(stiffness))
    load[node] = 1.0
    found = [np.linalg.solve(stiffness - w**2 * mass + 1j * w * damping, load)[:count, None] for w in grid]
    return frequency_response(found, grid, ["force_z"], [f"z_{k}" for k in range(count)], "axial_response")


@one_blas_thread
@arguments
def collar_response(
    collar: SkewedCollar, bearings: Bearings, speeds: ArrayLike
) -> control.FrequencyResponseData:
    """Return the synchronous response of a rotor to a thrust collar that is out of square.

    Unbalances are not included: the whole response is the sum with that of `unbalance_response`.

    Parameters
    ----------
    collar : SkewedCollar
        With its rotor.
    bearings : mapping of str to Reaction
        Bearings by the name of the station; each is linearized at the equilibrium of every speed.
    speeds : array_like, shape (n,) [rad/s]
        Angular speeds, positive and rising.

    Returns
    -------
    control.FrequencyResponseData
        Input `skew` [1]: that of the collar. Outputs as in `unbalance_response`, for the shaft without the
        skew. The forces at its station are only those of this motion.

    Raises
    ------
    InputError
        If nothing at the station feels the tilt, or an argument breaks its rule.
    EquilibriumError
        If there is no equilibrium at one of the speeds.
    """
    bearing = bearings.get(collar.station)
    felt = () if bearing is None else freedoms_of(bearing)
    if bearing is None or not {"tilt_x", "tilt_y"} <= {*felt}:
        raise InputError(
            f"bearings must have one that feels tilts at {collar.station!r}, got {list(bearings)}"
        )
    columns = [felt.index(name) for name in ("tilt_x", "tilt_y")]
    turning = collar.skew * np.exp(1j * collar.skew_angle) * np.array([[1.0], [-1.0j]])

    def moments(speed: float) -> np.ndarray:
        at = rotor_equilibrium(collar.rotor, bearings, speed)
        temperature = at.temperatures.get(collar.station)
        film: Any = bearing
        warm = film if temperature is None else film.at_temperature(temperature)
        stiffness, _ = small_motion(warm, at.coefficients[collar.station].position, speed)(1j * speed)
        return -stiffness[:, columns] @ turning

    loads = freedom_rows(collar.rotor.assembly, collar.station, felt).T
    return synchronous_response(collar.rotor, bearings, speeds, loads, moments, "skew")


def require_shaft_node(name: str, node: int, rotor: ShaftRotor) -> None:
    """Raise InputError unless a rotor has this node."""
    if not isinstance(node, int) or not 0 <= node <= len(rotor.elements):
        raise InputError(f"{name} must be on a node 0 to {len(rotor.elements)}, got node {node!r}")


def grounded(chain: Chain, rotor: ShaftRotor, springs: Sequence[_Spring]) -> tuple[Array, Array]:
    """Return stiffness and damping with the springs to the ground, dense."""
    stiffness = dense_matrix(chain.stiffness)
    damping = np.zeros_like(stiffness)
    for spring in springs:
        require_shaft_node("bearings", spring.node, rotor)
        stiffness[spring.node, spring.node] += spring.stiffness
        damping[spring.node, spring.node] += spring.damping
    return stiffness, damping


def _modes(chain: Chain, rotor: ShaftRotor, springs: Sequence[_Spring], count: int) -> AxialTorsionalModes:
    require_count("count", count)
    stiffness, damping = grounded(chain, rotor, springs)
    mass = dense_matrix(chain.mass)
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
        Displacement along +z.
    tension : ndarray, shape (n_elements,) [N]
        Tension of each element, positive where it is stretched.
    thrust : ndarray, shape (n_bearings,) [N]
        Thrust on each thrust bearing, along +z.
    """

    displacement: Array
    tension: Array
    thrust: Array


@one_blas_thread
@arguments
def axial_statics(
    rotor: ShaftRotor, bearings: Sequence[AxialSpring], forces: Mapping[int, float]
) -> AxialStatics:
    """Return displacement, tension and thrust of a rotor under static forces along its axis.

    Parameters
    ----------
    rotor : ShaftRotor
    bearings : sequence of AxialSpring
        Bearings with some stiffness.
    forces : mapping of int to float [N]
        Forces by node, along +z.

    Raises
    ------
    InputError
        If a node does not exist, or no bearing holds the shaft.
    EquilibriumError
        If the bearings are so soft beside the shaft that roundoff decides what they carry.
    """
    chain = axial_chain(rotor.elements, rotor.disks)
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
            "bearings must be stiff enough to hold the shaft along its axis, got stiffnesses of "
            f"{[b.stiffness for b in bearings]} N/m, at which round-off leaves {left:.3g} N of {size:.3g} N "
            "unbalanced"
        )
    for bearing, force in zip(bearings, thrust, strict=True):
        held[bearing.node] += force
    # Of what acts on the nodes up to an element, its tension is the opposite.
    outer = load[: len(rotor.elements) + 1].copy()
    for node, force in held.items():
        outer[node] -= force
    return AxialStatics(displacement=moved[: len(outer)], tension=-np.cumsum(outer)[:-1], thrust=thrust)


@one_blas_thread
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
        raise InputError(
            f"at must have a tension for each of the {len(rotor.elements)} elements, got {len(tension)} "
            "tensions"
        )
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
