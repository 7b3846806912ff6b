"""A rotor in bearings whose oil adds mass: the forces that solve the accelerations of both at once.

A bearing answers F - M a, a = V f(x, u) being the acceleration of its journal, f linear in the forces u, so

    (1 + M V B) (u - F) = -M V f(x, F)

is solved for the forces, whatever the rotor: no exchange of accelerations, which diverges where the oil is
heavier than the rotor.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import ArrayLike

from ..model import Array, Linearization, Reaction
from ..reactions.added_mass import InertialReaction, inertial


class HeavyJournals:
    """The journals of a rotor, by their places in its inputs and outputs.

    Parameters
    ----------
    bearings : sequence of Reaction
        One for each journal, those without mass too.
    motion : sequence of list of int
        Places of x, y, vx, vy, speed of each among the rotor's outputs.
    """

    def __init__(self, bearings: Sequence[Reaction], motion: Sequence[Sequence[int]]) -> None:
        self.heavy: list[InertialReaction | None] = [inertial(bearing) for bearing in bearings]
        self.motion = [list(rows) for rows in motion]

    def __bool__(self) -> bool:
        return any(bearing is not None for bearing in self.heavy)

    def forces(self, rotor: Linearization, push: Array, sensed: Array, forces: Array, rates: Array) -> Array:
        """Return the forces of all bearings on the journals [N], shape (2 n,).

        Parameters
        ----------
        rotor : Linearization
        push : ndarray, shape (n_states, 2 n)
            Columns of its B for these forces.
        sensed : ndarray, shape (n_outputs,)
            Outputs of the rotor.
        forces : ndarray, shape (2 n,) [N]
            Of the bearings without their mass.
        rates : ndarray, shape (n_states,)
            dx/dt of the rotor under those.
        """
        mass, along = self._mass(sensed), self._velocity(rotor)
        return forces - np.linalg.solve(np.eye(len(mass)) + mass @ along @ push, mass @ along @ rates)

    def slopes(
        self, rotor: Linearization, push: Array, free: Array, sensed: Array, slopes: Array, rates: Array
    ) -> tuple[Array, Array]:
        """Return the derivatives of these forces, by the whole state and by the free inputs.

        Parameters
        ----------
        rotor, push, sensed
            As in `forces`.
        free : ndarray, shape (n_states, n_free)
            Columns of B for the free inputs.
        slopes : ndarray, shape (2 n, n_whole)
            Of the forces without mass by the whole state, which begins with that of the rotor.
        rates : ndarray, shape (n_states,)
            dx/dt of the rotor under the forces that `forces` returns.
        """
        mass, along = self._mass(sensed), self._velocity(rotor)
        moved, size = slopes.copy(), len(rotor.A)
        moved[:, :size] -= mass @ along @ rotor.A
        for k, (bearing, rows) in enumerate(zip(self.heavy, self.motion, strict=True)):
            if bearing is not None:
                at = sensed[rows]
                by_place = bearing.mass_slopes(at[:2], at[2:4], at[4])
                by_motion = np.einsum("ijk,j->ik", by_place, rotor.C[rows[2:4]] @ rates)
                moved[2 * k : 2 * k + 2, :size] -= by_motion @ rotor.C[rows]
        joint = np.eye(len(mass)) + mass @ along @ push
        by_state = np.asarray(np.linalg.solve(joint, moved), dtype=float)
        by_input = -np.asarray(np.linalg.solve(joint, mass @ along @ free), dtype=float)
        return by_state, by_input

    def _mass(self, sensed: Array) -> Array:
        """Return the added masses of all journals, shape (2 n, 2 n) [kg]."""
        mass = np.zeros((2 * len(self.heavy), 2 * len(self.heavy)))
        for k, (bearing, rows) in enumerate(zip(self.heavy, self.motion, strict=True)):
            if bearing is not None:
                own = slice(2 * k, 2 * k + 2)
                mass[own, own] = bearing.mass(sensed[rows[:2]], sensed[rows[2:4]], sensed[rows[4]])
        return mass

    def _velocity(self, rotor: Linearization) -> Array:
        """Return the rows of the velocities of the journals, shape (2 n, n_states)."""
        return np.concatenate([rotor.C[rows[2:4]] for rows in self.motion])


def with_mass(rotor: Linearization, mass: ArrayLike, force: list[int], motion: list[int]) -> Linearization:
    """Return a rotor whose journal carries an added mass: its forces accelerate both.

    Parameters
    ----------
    rotor : Linearization
        Without feedthrough.
    mass : array_like, shape (2, 2) [kg]
    force : list of int
        Inputs that are the force on the journal.
    motion : list of int
        Outputs that are x, y, vx, vy of the journal.

    Returns
    -------
    Linearization
        With two outputs more: minus the added mass times the acceleration of the journal [N].
    """
    M, V, push = np.asarray(mass, dtype=float), rotor.C[motion[2:]], rotor.B[:, force]
    joint = np.eye(2) + M @ V @ push
    by_state, by_input = (-np.linalg.solve(joint, M @ V @ part) for part in (rotor.A, rotor.B))
    return Linearization(
        rotor.A + push @ by_state,
        rotor.B + push @ by_input,
        np.vstack([rotor.C, by_state]),
        np.vstack([rotor.D, by_input]),
    )
