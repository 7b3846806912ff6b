"""A shaft of many elements in as few shapes as a run over time needs."""

from __future__ import annotations

from collections.abc import Iterator
from typing import NamedTuple

import numpy as np

from ...linear.large.condensed import Condensed, models
from ...model import Array
from ...results import Trajectory
from ...rotors import FlexibleRotor, MountedRotor, mount
from ...rotors.projection import mean_plane
from ...rotors.stations import station_name
from ...rotors.structure import Structure
from .modal import Parts

FREQUENCY = 4.0
"""Frequency of the fewest shapes / largest speed."""

FURTHER = 2
"""Doublings of the frequency from one set of shapes to the next: one may add shapes that nothing excites."""


class ShapesRotor(FlexibleRotor):
    """A rotor that moves in some of its shapes.

    Parameters
    ----------
    rotor : FlexibleRotor
    structure : Structure
        Its matrices in the shapes.
    """

    def __init__(self, rotor: FlexibleRotor, structure: Structure) -> None:
        self.speed, self.gravity, self.initial = rotor.speed, rotor.gravity, ()
        self._structure = structure

    def assembled(self) -> Structure:
        """Return the matrices."""
        return self._structure


class ShapedStart(NamedTuple):
    """A rotor in its bearings and its state at t = 0; whether more shapes may follow."""

    mounted: MountedRotor
    state: Array
    condensed: bool


def starts(mounted: MountedRotor, state: Array, *, whole: bool) -> Iterator[ShapedStart]:
    """Yield a rotor in ever more of its shapes, and whole in the end or at once."""
    rotor = mounted.bare
    if not whole and isinstance(rotor, FlexibleRotor) and rotor.assembly.hysteresis is None:
        for k, model in enumerate(models(rotor, FREQUENCY * rotor.nominal_speed)):
            if model.space is None:
                break
            if k % FURTHER == 0:
                small = ShapesRotor(rotor, model.structure)
                yield ShapedStart(mount(small, mounted.all_bearings), _within(model, state), True)
    yield ShapedStart(mounted, state, False)


def _within(model: Condensed, state: Array) -> Array:
    """Return what of a state (2 N,) the shapes have, which are of unit mass."""
    assert model.space is not None
    mass, shapes = mean_plane(model.whole.mass), model.space.shapes
    return np.concatenate([shapes.T @ (mass @ part) for part in np.split(state, 4)])


def largest_difference(parts: Parts, one: Trajectory, other: Trajectory) -> float:
    """Return by how much journals of two runs are apart, in clearances; inf where not both go as far."""
    if len(one.time) != len(other.time):
        return np.inf
    worst = 0.0
    for name, length in zip(parts.names, parts.lengths, strict=True):
        for axis in "xy":
            key = station_name(name, axis)
            worst = max(worst, float(np.abs(one[key] - other[key]).max(initial=0.0)) / float(length))
    return worst
