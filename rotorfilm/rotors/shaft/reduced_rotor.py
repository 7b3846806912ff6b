"""A flexible rotor in fewer coordinates: motion of its stations, and some modes between them."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from scipy.linalg import LinAlgError, eigh, null_space

from ...errors import InputError
from ...inputs.si_arguments import quantities
from ...model import Array
from ..profile import SpeedProfile
from ..projection import mean_plane, new_shapes, projected
from ..structure import FlexibleRotor, Structure, check_motion


@quantities
@dataclass(frozen=True, kw_only=True)
class ReducedRotor(FlexibleRotor):
    """A rotor in the coordinates of Craig and Bampton (1968), AIAA J. 6, 1313-1319: a Dynamic model.

    The coordinates of a plane are the displacements of journals and housings (with the shape that the rotor
    takes when they move slowly), the static shapes under weight and unbalance, and the lowest modes of the
    rotor with all of them held. Inputs and outputs are those of the rotor; static deflections and the total
    mass are exact. `reduce_rotor` chooses the number of modes.

    Parameters
    ----------
    rotor : FlexibleRotor
        With stations that hold it, so at least two unless it is on the ground otherwise.
    modes : int
        Modes kept in each plane.
    speed : float or SpeedProfile [rad/s]
        In place of that of the rotor.
    gravity : tuple of two floats [m/s2]
        Must be that of the rotor.
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
        """Shapes of one plane in the coordinates of the rotor, largest entry 1, shape (N / 2, n)."""
        full = self.rotor.structure
        n = len(full.coordinates)
        mass, stiffness = mean_plane(full.mass), mean_plane(full.stiffness)
        held = np.vstack([full.journals[::2, :n], np.eye(n)[list(full.supports)]])
        loads = np.column_stack([full.weight.reshape(2, n).T, full.unbalance[:n], full.unbalance[n:]])
        modes = _held_modes(mass, stiffness, held, self.modes)
        slow, bent = _static_shapes(stiffness, held, loads)
        shapes = np.hstack([slow, modes, new_shapes(bent, modes, mass)])
        return shapes / np.abs(shapes).max(axis=0)


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
        raise InputError(f"rotor must be held by its stations, got {len(held)} that leave it free to move")
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
