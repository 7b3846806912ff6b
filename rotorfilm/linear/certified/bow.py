"""A shaft that is bent when nothing loads it, and turns."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import ArrayLike
from scipy.sparse.linalg import splu

from ...errors import InputError
from ...inputs.kinds import arguments
from ...model import Reaction
from ...rotors import ShaftRotor
from ..rotor_system import synchronous_response

if TYPE_CHECKING:
    import control


@arguments
def bow_response(
    rotor: ShaftRotor, bearings: Mapping[str, Reaction], speeds: ArrayLike, bow: ArrayLike
) -> control.FrequencyResponseData:
    """Return the synchronous response of a rotor to a bow of its shaft.

    Unbalances are left out: the sum with `unbalance_response` is the whole response.

    Parameters
    ----------
    rotor : ShaftRotor
    bearings : mapping of str to Reaction
        By the name of the station; each is linearized at the equilibrium of every speed.
    speeds : array_like, shape (n,) [rad/s]
        Angular speeds, positive and rising.
    bow : array_like of complex, shape (n_nodes,) [m]
        Deflection of the nodes of the unloaded shaft: a real number along +x at t = 0, i along +y. Between
        them it is bent as little as it can be.

    Returns
    -------
    control.FrequencyResponseData
        Input `bow` [1]: the bow, 1 as it is. Outputs as of `unbalance_response`, displacements with the bow
        in them: a slow shaft on rigid bearings moves as it is bent.

    Raises
    ------
    InputError
        If an argument breaks its rule.
    EquilibriumError
        If there is no equilibrium at one of the speeds.

    Notes
    -----
    The shaft resists what deflects it from its bow, K (q - q_bow), whatever the speed; of a Jeffcott rotor
    that is Nicholas, Gunter & Allaire (1976), J. Eng. Power 98, 171-181. Internal damping does not feel it.
    """
    shape = np.asarray(bow, dtype=complex)
    count = len(rotor.elements) + 1
    if shape.shape != (count,) or not np.isfinite(shape).all():
        raise InputError(f"bow must be {count} finite numbers, one for each node, got shape {shape.shape}")
    force = _straightening(rotor, shape)
    turning = np.concatenate([force, -1j * force])
    loads = np.column_stack([turning.real, turning.imag])
    parts = np.array([[1.0], [1.0j]])
    return synchronous_response(rotor, bearings, speeds, loads, lambda speed: parts, "bow")


def _straightening(rotor: ShaftRotor, shape: np.ndarray) -> np.ndarray:
    """Return the forces of one plane that would bend a straight shaft to a shape of its nodes, (N / 2,)."""
    stiffness = rotor.bending.tocsc()
    nodes = 2 * np.arange(len(shape))
    still = {*nodes.tolist(), *rotor.assembly.supports}
    others = np.array([k for k in range(stiffness.shape[0]) if k not in still])
    free = splu(stiffness[others][:, others])
    coupled = stiffness[others][:, nodes] @ shape
    moved = -(free.solve(coupled.real.copy()) + 1j * free.solve(coupled.imag.copy()))
    forces = np.zeros(stiffness.shape[0], dtype=complex)
    forces[nodes] = stiffness[nodes][:, nodes] @ shape + stiffness[nodes][:, others] @ moved
    return forces
