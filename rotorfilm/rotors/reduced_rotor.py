"""A flexible rotor in fewer coordinates: motion of its stations, and some modes between them."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field
from functools import cached_property

import numpy as np
from numpy.typing import NDArray
from scipy.linalg import LinAlgError, eigh, null_space

from ..core.errors import ConvergenceError, InputError, require_non_negative, require_positive
from ..core.inputs import arguments, quantities
from ..core.model import Array
from ..core.readable import Readable
from .profile import SpeedProfile
from .structure import (
    FlexibleRotor,
    Structure,
    beside,
    both_planes,
    check_motion,
    dense,
    dense_matrix,
    in_planes,
    mean_plane,
    new_shapes,
    projected,
    whole_basis,
)


@quantities
@dataclass(frozen=True, kw_only=True)
class ReducedRotor(FlexibleRotor):
    """A rotor in the coordinates of Craig and Bampton (1968), AIAA J. 6, 1313-1319: a Dynamic model.

    The coordinates of a plane are the displacements of journals and housings (with the static shape of the
    rotor), the static shapes under weight and unbalance, and the lowest modes of the rotor with all of these
    fixed. Inputs and outputs are those of the rotor; static deflections and the total mass are exact.
    `reduce_rotor` chooses the number of modes.

    Parameters
    ----------
    rotor : FlexibleRotor
        Rotor that its stations hold: at least two, unless other springs to the ground hold it.
    modes : int
        Modes kept in each plane.
    speed : float or SpeedProfile [rad/s]
        Speed that replaces that of the rotor.
    gravity : tuple of two floats [m/s2]
        Gravity; it must be that of the rotor.
    initial : tuple of float
        State at t = 0; empty for a straight shaft at rest.

    Raises
    ------
    InputError
        If the stations do not hold the rotor, or it has fewer modes.
    """

    rotor: FlexibleRotor
    modes: int
    speed: float | SpeedProfile
    gravity: tuple[float, float]
    initial: tuple[float, ...] = ()

    def __post_init__(self) -> None:
        if tuple(self.gravity) != tuple(self.rotor.gravity):
            raise InputError(f"gravity must be that of the rotor {self.rotor.gravity}, got {self.gravity}")
        check_motion(self)

    def assembled(self) -> Structure:
        """Return the matrices of the rotor in the reduced coordinates."""
        return projected(self.rotor.assembly, self.basis)

    @cached_property
    def basis(self) -> Array:
        """Shapes of one plane in its coordinates, largest entry 1; axial and torsional ones are all kept."""
        full = in_planes(self.rotor.structure)
        n = len(full.coordinates)
        mass, stiffness = mean_plane(full.mass), mean_plane(full.stiffness)
        held = np.vstack([full.journals[::2, :n], np.eye(n)[list(full.supports)]])
        loads = np.column_stack([full.weight.reshape(2, n).T, full.unbalance[:n], full.unbalance[n:]])
        modes = _held_modes(mass, stiffness, held, self.modes)
        slow, bent = _static_shapes(stiffness, held, loads)
        shapes = np.hstack([slow, modes, new_shapes(bent, modes, mass)])
        return shapes / np.abs(shapes).max(axis=0)

    @property
    def transformation(self) -> Array:
        """Matrix from the reduced coordinates to those of the rotor, shape (N, n)."""
        return whole_basis(self.basis, len(self.rotor.assembly.others))


def _held_modes(mass: Array, stiffness: Array, held: Array, count: int) -> Array:
    """Return the lowest modes of the rotor with its journals held, in one plane."""
    free = null_space(held)
    size = free.shape[1]
    if not isinstance(count, int) or not 0 <= count <= size:
        raise InputError(f"modes must be an integer from 0 to {size}, got {count!r}")
    # In these roles round-off spares the lowest modes, which the shapes under loads nearly are.
    try:
        rising, shapes = eigh(free.T @ mass @ free, free.T @ stiffness @ free)
    except LinAlgError:
        rising = np.zeros(size)
    if rising[0] <= 1e-12 * rising[-1]:
        raise InputError(f"stations must hold the rotor, got {len(held)} that leave it free to move")
    return np.asarray(free @ (shapes / np.sqrt(rising))[:, ::-1][:, :count])


def _static_shapes(stiffness: Array, held: Array, loads: Array) -> tuple[Array, Array]:
    """Return the shapes under slow motion of each journal, and those under loads with the journals held."""
    n, stations = len(stiffness), len(held)
    saddle = np.block([[stiffness, held.T], [held, np.zeros((stations, stations))]])
    right = np.zeros((n + stations, stations + loads.shape[1]))
    right[n:, :stations] = np.eye(stations)
    right[:n, stations:] = loads
    # Forces and displacements differ by the stiffness: rows and columns are scaled alike.
    scale = np.concatenate([np.diag(stiffness) ** -0.5, np.full(stations, np.abs(stiffness).max() ** 0.5)])
    shapes = scale[:, None] * np.linalg.solve(saddle * np.outer(scale, scale), right * scale[:, None])
    return shapes[:n, :stations], shapes[:n, stations:]


# How many modes a reduced rotor needs, and what it is wrong by.


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
        Largest relative error at the bearings over all frequencies: of the dynamic stiffness of the rotor at
        its journals, and of the unbalance forces on fixed journals. It is found by comparison with the whole
        rotor, at rest and at the speed of the highest frequency.
    frequency : float [rad/s]
        Highest frequency, and speed, of the comparison.
    work : dict of str to int
        Counters: eigenproblems of the rotor with fixed journals, one for each number of modes that was tried;
        solutions at one frequency and speed, of the whole and of the reduced rotors.
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
        Rotor such as a `ShaftRotor`, held by its stations.
    frequency : float [rad/s]
        Highest frequency and speed of interest.
    tolerance : float [1]
        Largest `Reduction.error`.

    Raises
    ------
    InputError
        If an argument is not positive, or the stations do not hold the rotor.
    ConvergenceError
        If not even all modes are enough; the error carries the last Reduction.
    """
    require_positive("frequency", frequency)
    require_positive("tolerance", tolerance)
    s = rotor.structure
    if np.linalg.matrix_rank(s.journals) < len(s.journals):
        raise InputError(f"stations must be at different nodes for a reduction, got {list(s.stations)}")
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
    stiffness: NDArray[np.complex128] = np.linalg.inv(moved[:, :stations]).astype(complex)
    return stiffness, stiffness @ moved[:, stations:]


# A rotor whose modes have damping ratios that were measured, or are usual.


@quantities
@dataclass(frozen=True, kw_only=True)
class ModallyDampedRotor(FlexibleRotor):
    """A rotor with prescribed damping ratios of its lowest undamped modes in each plane.

        C = sum over the modes of 2 ratio w M u u' M,  u' M u = 1

    is added to the existing damping; it does not rotate with the shaft. Other modes keep their damping. The
    ratios are exact at rest on bearings of the given stiffness; with gyroscopic effect and on other bearings
    the modes couple.

    Parameters
    ----------
    rotor : FlexibleRotor
    damping_ratios : tuple of float [1]
        Damping ratios from the lowest mode on.
    bearing_stiffness : float [N/m]
        Stiffness at each station for these modes; 0 for the free shaft, whose rigid-body motions count as the
        first modes.
    speed : float or SpeedProfile [rad/s]
        Speed that replaces that of the rotor.
    gravity : tuple of two floats [m/s2]
        Gravity; it must be that of the rotor.
    initial : tuple of float
        State at t = 0; empty for a straight shaft at rest.

    Raises
    ------
    InputError
        If a ratio is negative, or the rotor has fewer modes.
    """

    rotor: FlexibleRotor
    damping_ratios: tuple[float, ...]
    speed: float | SpeedProfile
    gravity: tuple[float, float]
    bearing_stiffness: float = 0.0
    initial: tuple[float, ...] = ()

    def __post_init__(self) -> None:
        require_non_negative("bearing_stiffness", self.bearing_stiffness)
        for k, ratio in enumerate(self.damping_ratios):
            require_non_negative(f"damping_ratios[{k}]", ratio)
        most = len(self.rotor.assembly.coordinates)
        if len(self.damping_ratios) > most:
            raise InputError(f"damping_ratios must be at most {most}, got {len(self.damping_ratios)}")
        if tuple(self.gravity) != tuple(self.rotor.gravity):
            raise InputError(f"gravity must be that of the rotor {self.rotor.gravity}, got {self.gravity}")
        check_motion(self)

    def assembled(self) -> Structure:
        """Return the matrices of the rotor, dense, with the damping of its modes."""
        full = dense(self.rotor.assembly)
        none = np.zeros((len(full.others),) * 2)
        return full._replace(damping=full.damping + beside(both_planes(self._modal(in_planes(full))), none))

    def _modal(self, full: Structure) -> Array:
        n, count = len(full.coordinates), len(self.damping_ratios)
        if not count:
            return np.zeros((n, n))
        journals = full.journals[::2, :n]
        mass = dense_matrix(mean_plane(full.mass))
        held = mean_plane(full.stiffness) + self.bearing_stiffness * journals.T @ journals
        squares, shapes = eigh(held, mass, subset_by_index=[0, count - 1])
        rates = 2.0 * np.array(self.damping_ratios) * np.sqrt(np.maximum(squares, 0.0))
        pushed = mass @ shapes
        return np.asarray((pushed * rates) @ pushed.T)
