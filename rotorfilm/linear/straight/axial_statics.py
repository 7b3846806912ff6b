"""A shaft under static forces along its axis, and what its tension does to bending."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np

from ...errors import EquilibriumError, InputError, require_finite, require_number
from ...inputs.kinds import arguments
from ...model import Array
from ...reactions.noise import MOST_LEFT
from ...readable.result import Readable
from ...rotors import Coupling, LayeredElement, ShaftRotor
from ...rotors.shaft.elements import ShaftPiece
from .straight_motion import ThrustBearing, axial_of, grounded, require_shaft_node


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
def tensioned(rotor: ShaftRotor, at: AxialStatics) -> ShaftRotor:
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
