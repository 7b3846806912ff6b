"""How many modes a reduced rotor needs, and what it is wrong by."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from ...errors import ConvergenceError, require_positive
from ...inputs.kinds import arguments
from ...model import Array
from ...readable.result import Readable
from ..structure import FlexibleRotor, Structure
from .reduced_rotor import ReducedRotor

_Felt = tuple[NDArray[np.complex128], ...]

POINTS = 40
"""Frequencies at which the rotors are compared."""

DAMPING_RATIO = 0.02
"""Damping of the oscillations in which they are compared: no resonance of a held rotor is infinite then."""


@dataclass(frozen=True, kw_only=True)
class Reduction(Readable):
    """A reduced rotor and its error.

    Attributes
    ----------
    rotor : ReducedRotor
    error : float [1]
        Largest relative error over the frequencies of what the bearings feel: the dynamic stiffness of the
        rotor at its journals, and the forces of its unbalance on journals that are held. Found by comparison
        with the whole rotor, at rest and at the speed of the highest frequency.
    frequency : float [rad/s]
        Highest frequency, and speed, of the comparison.
    work : dict of str to int
        Eigenproblems of the rotor held at its journals, one for each number of modes that was tried;
        solutions at one frequency and speed, of the whole rotor and of those.
    """

    rotor: ReducedRotor
    error: float
    frequency: float
    work: dict[str, int] = field(default_factory=dict, compare=False)


@arguments
def reduce_rotor(rotor: FlexibleRotor, *, frequency: float, tolerance: float = 1e-3) -> Reduction:
    """Return the rotor with as few modes as a tolerance allows.

    Parameters
    ----------
    rotor : FlexibleRotor
        As `ShaftRotor`; its stations hold it.
    frequency : float [rad/s]
        Highest frequency and speed of interest.
    tolerance : float [1]
        Largest `Reduction.error`.

    Raises
    ------
    InputError
        If an argument is not positive, or the stations do not hold the rotor.
    ConvergenceError
        If not even all modes are enough; carries the last Reduction.
    """
    require_positive("frequency", frequency)
    require_positive("tolerance", tolerance)
    s = rotor.structure
    most = len(s.coordinates) - len(s.stations) - len(s.supports)
    wanted = list(_felt_over(s, frequency))
    for modes in range(most + 1):
        small = ReducedRotor(rotor=rotor, modes=modes, speed=rotor.speed, gravity=rotor.gravity)
        error = _error(wanted, small.structure, frequency)
        work = {"eigenproblems": modes + 1, "solutions": (modes + 2) * len(wanted)}
        last = Reduction(rotor=small, error=error, frequency=frequency, work=work)
        if error <= tolerance:
            return last
    raise ConvergenceError(
        f"tolerance must be within reach, got {tolerance!r} and an error of {error:.3g}", last
    )


def _error(wanted: Sequence[_Felt], small: Structure, frequency: float) -> float:
    """Return the error of `Reduction` of one structure as a model of another with the same stations."""
    worst = 0.0
    for both in zip(wanted, _felt_over(small, frequency), strict=True):
        for right, wrong in zip(*both, strict=True):
            size = float(np.linalg.norm(right))
            if size > 0.0:
                worst = max(worst, float(np.linalg.norm(right - wrong)) / size)
    return worst


def _felt_over(structure: Structure, frequency: float) -> Iterator[_Felt]:
    """Yield what the bearings feel at all frequencies and speeds of the comparison."""
    for speed in (0.0, frequency):
        for omega in frequency * np.arange(1, POINTS + 1) / POINTS:
            yield _felt(structure, omega * complex(DAMPING_RATIO, 1.0), speed)


def _felt(structure: Structure, s: complex, speed: float) -> _Felt:
    """Return the dynamic stiffness at the journals, and the forces of the unbalance on held journals."""
    whole = (
        s * s * structure.mass
        + s * (structure.damping + speed * structure.gyroscopic)
        + structure.stiffness
        + speed * structure.circulation
    )
    inputs: Array = np.hstack([structure.journals.T, structure.unbalance])
    moved = structure.journals @ np.linalg.solve(whole, inputs)
    stations = len(structure.journals)
    stiffness = np.linalg.inv(moved[:, :stations]).astype(complex)
    return stiffness, stiffness @ moved[:, stations:]
