"""The first critical speed of a flexible rotor: ever finer meshes of the shaft."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Any

import numpy as np

from ...errors import InputError, RotorfilmError
from ...linear import critical_speeds
from ...model import Array, Reaction
from ...rotors import ShaftElement, ShaftRotor
from ..ladder import ErrorEstimate, Found, Ladder, Work

if TYPE_CHECKING:
    from ..scene import Scene

PIECES = (1, 2, 4, 8)
"""Elements into which each rung splits one of the file."""

ORDER = 4
"""Of the elements' frequencies in the length of an element."""

WORK = "eigenproblems, {} nodes"


@dataclass(frozen=True, kw_only=True)
class ShaftRung:
    """The critical speed with every element split into so many.

    Attributes
    ----------
    rotor : ShaftRotor
    bearings : dict of str to Reaction
    speeds : ndarray, shape (n,) [rad/s]
        Where it is looked for.
    pieces : int
    """

    rotor: ShaftRotor
    bearings: dict[str, Reaction]
    speeds: Array
    pieces: int

    @property
    def name(self) -> str:
        """Number of elements."""
        return f"{self.pieces * len(self.rotor.elements)} elements"

    @property
    def prior(self) -> float:
        """Nothing is known beforehand."""
        return 0.0

    @property
    def unit(self) -> str:
        """Name of one eigenproblem."""
        return WORK.format(self.pieces * len(self.rotor.elements) + 1)

    def answer(self, before: Found | None) -> Found:
        """Return the first critical speed [rad/s]; raises RotorfilmError where there is none in the range."""
        speeds = self.speeds
        if before is not None:
            speeds = np.linspace(0.97 * before.value, 1.03 * before.value, 5)
        found = critical_speeds(split(self.rotor, self.pieces), self.bearings, speeds)
        if not found:
            raise RotorfilmError(f"no critical speed from {speeds[0]:.6g} to {speeds[-1]:.6g} rad/s")
        return Found(found[0].speed, {self.unit: len(speeds)}, self.pieces)

    def estimate(self, found: Found, before: Found | None, tolerance: float) -> ErrorEstimate:
        """Return the order increment from elements twice as long, which the rung below has."""
        if before is None or before.solution * 2 != self.pieces:
            return ErrorEstimate(np.inf, "order increment", doubt="there is no coarser mesh to compare with")
        error = abs(found.value - before.value) / (2.0**ORDER - 1.0) / found.value
        return ErrorEstimate(error, f"order increment, order {ORDER}")

    def expected(self, done: Work) -> Work:
        """Return as many eigenproblems as a lower rung took."""
        return {self.unit: sum(done.values())}


def split(rotor: ShaftRotor, pieces: int) -> ShaftRotor:
    """Return the rotor with each element in so many pieces; what sits at nodes stays in place."""
    if pieces == 1:
        return rotor
    if not all(isinstance(element, ShaftElement) for element in rotor.elements):
        raise InputError("shaft.elements must hold no coupling for finer meshes, got one")

    def moved(parts: tuple[Any, ...]) -> tuple[Any, ...]:
        return tuple(replace(part, node=part.node * pieces) for part in parts)

    elements = [
        piece for one in rotor.elements if isinstance(one, ShaftElement) for piece in one.split(pieces)
    ]
    return replace(
        rotor,
        elements=tuple(elements),
        disks=moved(rotor.disks),
        stations=moved(rotor.stations),
        tilt_springs=moved(rotor.tilt_springs),
        probes=moved(rotor.probes),
        unbalances=moved(rotor.unbalances),
    )


def shaft_ladder(scene: Scene, quantity: str) -> Ladder:
    """Return the ladder of meshes of a flexible rotor.

    Raises
    ------
    InputError
        If the scene has no shaft.
    """
    if scene.shaft is None:
        raise InputError(f"shaft is required for {quantity}, got no such table")
    rotor, bearings, speeds = scene.shaft.build(), scene.shaft.build_bearings(), scene.shaft.speeds.build()
    rungs = tuple(
        ShaftRung(rotor=rotor, bearings=bearings, speeds=speeds, pieces=pieces) for pieces in PIECES
    )
    return Ladder(rungs=rungs, unit="rad/s")
