"""How fine the elements of a shaft are for one of its modes."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from ...errors import InputError, require_count
from ...inputs.kinds import arguments
from ...model import Array, Reaction
from ...readable.result import Readable
from ...rotors import ShaftRotor
from ...rotors.shaft.shaft_models import split
from ..rotor_modes import rotor_modes

_ROUNDOFF = 1e-11


@dataclass(frozen=True, kw_only=True)
class MeshConvergence(Readable):
    """The frequency of a mode on finer and finer elements.

    Attributes
    ----------
    elements : ndarray of int, shape (n_meshes,) [1]
        Number of elements.
    frequency : ndarray, shape (n_meshes,) [rad/s]
        Damped frequency of the mode.
    order : float [1]
        Of convergence, measured on the last three meshes; nan where they differ by roundoff only, or the
        changes alternate or do not shrink, so that nothing converges yet.
    estimate : float [rad/s]
        By Richardson's extrapolation from the last two with that order; the last frequency where it is nan.
    relative_error : float [1]
        Of the first mesh, that of the rotor as it is, against the estimate; signed.
    """

    elements: Array
    frequency: Array
    order: float
    estimate: float
    relative_error: float


@arguments
def mesh_convergence(
    rotor: ShaftRotor, bearings: Mapping[str, Reaction], speed: float, mode: int, *, meshes: int = 3
) -> MeshConvergence:
    """Return how the frequency of a mode converges as each element is split in 2, 4 and so on.

    Parameters
    ----------
    rotor : ShaftRotor
        On its own elements first.
    bearings : mapping of str to Reaction
        As in `rotor_modes`.
    speed : float [rad/s]
    mode : int
        Number of the whirl among the `rotor_modes` of the rotor, from 1; on the finer elements it is the one
        nearest to it.
    meshes : int
        At least 3.

    Raises
    ------
    InputError
        If there is no such mode, or too few meshes.
    EquilibriumError
        If there is no equilibrium.
    """
    require_count("mode", mode)
    require_count("meshes", meshes, 3)
    rotors = [split(rotor, 2**k) for k in range(meshes)]
    values: list[complex] = []
    floor = _ROUNDOFF
    for one in rotors:
        found = rotor_modes(one, bearings, speed)
        if not values and mode > len(found.eigenvalues):
            raise InputError(f"mode must be at most {len(found.eigenvalues)}, got {mode}")
        near = mode - 1 if not values else int(np.argmin(np.abs(found.eigenvalues - values[-1])))
        values.append(complex(found.eigenvalues[near]))
        floor = max(floor, found.error)
    frequency = np.array(values).imag
    order, estimate = _extrapolated(frequency[-3:], floor)
    return MeshConvergence(
        elements=np.array([len(one.elements) for one in rotors]),
        frequency=frequency,
        order=order,
        estimate=estimate,
        relative_error=float(frequency[0] / estimate - 1.0),
    )


def _extrapolated(last: Sequence[float] | Array, floor: float) -> tuple[float, float]:
    """Return order and limit of three numbers on halved meshes; nan and the last unless they converge."""
    before, after = last[0] - last[1], last[1] - last[2]
    small = min(abs(before), abs(after)) <= floor * abs(last[2])
    if small or before * after <= 0.0 or abs(after) >= abs(before):
        return math.nan, float(last[2])
    order = math.log2(before / after)
    return order, float(last[2] - after / (2.0**order - 1.0))
