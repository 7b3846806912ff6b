"""A rotor in as few shapes as a range of frequencies needs, and how far off its whirls are."""

from __future__ import annotations

import math
from collections.abc import Iterator
from itertools import count
from typing import NamedTuple

import numpy as np

from ...rotors import FlexibleRotor
from ...rotors.projection import projected
from ...rotors.structure import Structure
from .shape_space import ShapeSpace, shape_space

WHOLE = 160
"""Coordinates up to which nothing is left out of a rotor unless a range of frequencies is named."""

SMALL = 60
"""Coordinates up to which nothing is left out."""

ANY = 1e15
"""Frequency [rad/s] from which on all motions are asked for."""

MARGIN = 2.0
"""Frequency up to which modes are kept / highest frequency of interest, at least."""

_FIRST = 6

USUAL = 10
"""Modes in each plane that are answered, unless a range of frequencies is named."""

TOLERANCE = 1e-6
"""Relative error, of an eigenvalue or of a response, estimated, beyond which more shapes are taken."""


class Condensed(NamedTuple):
    """A rotor in some of its shapes.

    Attributes
    ----------
    whole : Structure
        All of the rotor.
    structure : Structure
        The matrices in the shapes kept, dense.
    space : ShapeSpace or None
        The shapes; None where nothing is left out.
    """

    whole: Structure
    structure: Structure
    space: ShapeSpace | None

    def lifted(self, motion: np.ndarray) -> np.ndarray:
        """Return motions, shape (n, ...), in the coordinates of the whole rotor."""
        if self.space is None:
            return motion
        x, y = np.split(motion, 2)
        return np.concatenate([self.space.shapes @ x, self.space.shapes @ y])

    def seen(self, forces: np.ndarray) -> np.ndarray:
        """Return forces, shape (N, m), as the shapes kept feel them, shape (n, m)."""
        if self.space is None:
            return forces
        return np.concatenate([self.space.shapes.T @ plane for plane in np.split(forces, 2)])

    def answer(self, forces: np.ndarray) -> np.ndarray:
        """Return how what is left out gives way to slow forces, shape (N, m)."""
        assert self.space is not None
        return np.concatenate([self.space.solid.solve(plane) for plane in np.split(forces, 2)])


def exact_structure(rotor: FlexibleRotor) -> Structure:
    """Return all of the matrices of a rotor: dense ones of a small rotor, else as they were assembled."""
    return rotor.assembly if len(rotor.assembly.weight) > WHOLE else rotor.structure


def usual_frequency(rotor: FlexibleRotor, speed: float) -> float:
    """Return up to where whirls are answered unless a question says so [rad/s]: inf for a small rotor.

    Twice the speed, and at least the frequency of mode `USUAL` of the shaft on no bearings.
    """
    exponent = _FIRST
    while len(rotor.assembly.weight) > WHOLE:
        model = _remembered(rotor, exponent)
        if model is None or model.space is None:
            break
        if len(model.space.frequencies) >= USUAL:
            return max(2.0 * abs(speed), float(model.space.frequencies[USUAL - 1]))
        exponent += 2
    return math.inf


def models(rotor: FlexibleRotor, frequency: float) -> Iterator[Condensed]:
    """Yield a rotor in shapes up to a frequency [rad/s] and beyond, ever more of them; whole in the end."""
    full = rotor.assembly
    size = len(full.weight)
    if size > SMALL and frequency < ANY:
        for exponent in count(math.ceil(math.log2(MARGIN * max(frequency, 1.0)))):
            model = _remembered(rotor, exponent)
            if model is None or 2 * len(model.structure.weight) > size:
                break
            yield model
    yield Condensed(full, rotor.structure, None)


def _remembered(rotor: FlexibleRotor, exponent: int) -> Condensed | None:
    """Return the rotor in the modes below 2^exponent rad/s; None where its stiffness is not positive."""
    known = rotor.remembered
    if exponent not in known:
        try:
            space = shape_space(rotor.assembly, 2.0**exponent)
        except np.linalg.LinAlgError:
            return None
        known[exponent] = Condensed(rotor.assembly, projected(rotor.assembly, space.shapes), space)
    found: Condensed = known[exponent]
    return found
