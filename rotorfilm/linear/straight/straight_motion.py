"""Modes and response of a shaft along its axis, and its modes about it."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, ClassVar

import numpy as np
from numpy.typing import ArrayLike, NDArray
from scipy.linalg import eig

from ...errors import InputError, require_count, require_non_negative
from ...inputs.kinds import arguments
from ...inputs.si_arguments import quantities
from ...model import Array
from ...readable.result import Readable
from ...rotors import ShaftRotor
from ...rotors.shaft.straight_chain import StraightChain, axial_chain, twist_chain
from ...rotors.sparse_chain import dense_matrix
from ..closed_loop import checked_speeds

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
class TwistSpring(_Spring):
    """A spring and a damper about the shaft, from a node to the ground.

    Parameters
    ----------
    node : int
    stiffness : float [N m/rad]
    damping : float [N m s/rad]
    """


@dataclass(frozen=True, kw_only=True)
class StraightModes(Readable):
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
def axial_modes(rotor: ShaftRotor, bearings: Sequence[ThrustBearing] = (), count: int = 6) -> StraightModes:
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
def twist_modes(rotor: ShaftRotor, springs: Sequence[TwistSpring] = (), count: int = 6) -> StraightModes:
    """Return the lowest torsional modes of a rotor that swing; those overdamped are left out.

    Parameters
    ----------
    rotor : ShaftRotor
        A coupling must have a `twist_stiffness`.
    springs : sequence of TwistSpring
        None for a free shaft.
    count : int
        Most modes.

    Raises
    ------
    InputError
        If a spring is on no node, or a coupling has no stiffness.
    """
    chain = twist_chain(rotor.elements, [(disk.node, disk.polar_inertia) for disk in rotor.disks])
    return _modes(chain, rotor, springs, count)


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
    mass, count = dense_matrix(chain.mass), len(rotor.elements) + 1
    load = np.zeros(len(stiffness))
    load[node] = 1.0
    found = [np.linalg.solve(stiffness - w**2 * mass + 1j * w * damping, load)[:count, None] for w in grid]
    import control

    return control.FrequencyResponseData(
        np.stack(found, axis=-1),
        grid,
        inputs=["force_z"],
        outputs=[f"z_{k}" for k in range(count)],
        name="axial_response",
    )


def axial_of(rotor: ShaftRotor) -> StraightChain:
    """Return the matrices of a rotor along its axis."""
    return axial_chain(rotor.elements, [(disk.node, disk.mass) for disk in rotor.disks])


def require_shaft_node(name: str, node: int, rotor: ShaftRotor) -> None:
    """Raise InputError unless a rotor has this node."""
    if not isinstance(node, int) or not 0 <= node <= len(rotor.elements):
        raise InputError(f"{name} must be on a node 0 to {len(rotor.elements)}, got node {node!r}")


def grounded(chain: StraightChain, rotor: ShaftRotor, springs: Sequence[_Spring]) -> tuple[Array, Array]:
    """Return stiffness and damping with the springs to the ground, dense."""
    stiffness = dense_matrix(chain.stiffness)
    damping = np.zeros_like(stiffness)
    for spring in springs:
        require_shaft_node("bearings", spring.node, rotor)
        stiffness[spring.node, spring.node] += spring.stiffness
        damping[spring.node, spring.node] += spring.damping
    return stiffness, damping


def _modes(chain: StraightChain, rotor: ShaftRotor, springs: Sequence[_Spring], count: int) -> StraightModes:
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
    chosen = [k for k in order[_whole_count(values[order[0]]) if whole else 0 :] if swings[k]]
    shapes = [np.ones(n, dtype=complex)] if whole else []
    shapes += [vectors[:n, k] for k in chosen]
    nodes = np.array(shapes).T[: len(rotor.elements) + 1]
    largest = np.array([column[np.argmax(np.abs(column))] for column in nodes.T])
    found = np.array([*whole, *values[chosen]], dtype=complex)[:count]
    return StraightModes(eigenvalues=found, shapes=(nodes / largest)[:, :count])


def _whole_count(smallest: complex) -> int:
    """Return how many of the smallest eigenvalues are the motion of a free shaft, one piece, as a whole.

    That is 0 twice, by roundoff two real ones, of which none swings, or a pair. With dampers it is 0 once.
    """
    return 1 if smallest.imag == 0.0 else 2
