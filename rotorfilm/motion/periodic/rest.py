"""Where a mounted rotor rests, and its linear matrix there."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from ...errors import EquilibriumError
from ...linear import equilibrium, rotor_equilibrium
from ...model import Array
from ...reactions.noise import MOST_LEFT
from ...rotors import FlexibleRotor, MountedRotor, RigidRotor
from ..compiled.modal import Complex, ModalRotor, journal_rows
from .balance import Balance
from .harmonics import constant
from .modal_films import ModalFilms, film_forces

TOLERANCE = 1e-12
_NEWTON_STEPS = 30


class Rest(NamedTuple):
    """A rotor at rest in its bearings.

    Attributes
    ----------
    position : ndarray, shape (2 n_bearings,) [m]
        Of the journals.
    matrix : ndarray, shape (2 N, 2 N)
        x' = A x of small motion.
    stiffness, damping : ndarray, shape (2 n_bearings, 2)
        Slopes of each bearing's force by its own position and velocity, positive where they drive.
    """

    position: Array
    matrix: Array
    stiffness: Array
    damping: Array


def rest_of(mounted: MountedRotor, modal: ModalRotor, guess: Array | None = None) -> Rest:
    """Return where a rotor rests, from a guess of its journals' positions if there is one.

    Raises
    ------
    EquilibriumError
        If it is not found.
    """
    start = first_guess(mounted, modal) if guess is None else guess
    try:
        position = _newton(modal, start)
    except EquilibriumError:
        if guess is None:
            raise
        position = _newton(modal, first_guess(mounted, modal))
    _, stiffness, damping = film_forces(modal, position[:, None], np.zeros((len(position), 1)))
    stiffness, damping = stiffness[..., 0], damping[..., 0]
    rows = journal_rows(modal.parts).reshape(-1, 4, len(modal.shapes))
    by_motion = np.concatenate([stiffness, damping], axis=1).reshape(-1, 2, 4)
    forced = np.einsum("bij,bjn->bin", by_motion, rows).reshape(-1, len(modal.shapes))
    return Rest(position, shifted_matrix(modal) + force_columns(modal) @ forced, stiffness, damping)


def shifted_matrix(modal: ModalRotor) -> Array:
    """Return A of the rotor on the springs of its modes."""
    return np.asarray(((modal.shapes * modal.values) @ modal.inverse).real)


def force_columns(modal: ModalRotor) -> Array:
    """Return the acceleration per force on each journal, shape (2 N, 2 n_bearings)."""
    return np.asarray((modal.shapes @ modal.push[:, :-2]).real)


def leading(matrix: Array) -> Complex:
    """Return the eigenvalues of a matrix, the least stable first."""
    values = np.linalg.eigvals(matrix)
    return values[np.argsort(-values.real)]


def _newton(modal: ModalRotor, start: Array) -> Array:
    balance = Balance(rotor=ModalFilms(modal), harmonics=0, periods=0)
    series = constant(start, 0)
    for _ in range(_NEWTON_STEPS):
        at = balance.residual(series, 1.0)
        step = np.asarray(np.linalg.solve(at.by_series, -at.values))
        size = float(np.abs(step).max())
        series += (min(1.0, 0.2 / size) if size else 1.0) * balance.in_length(step)
        if size < TOLERANCE:
            break
    left = float(np.abs(balance.values(series, 1.0)).max())
    if not (size < TOLERANCE and left <= MOST_LEFT):
        raise EquilibriumError(
            f"rotor must have a rest near its first guess, and the search found none: the last Newton step "
            f"was {size:.3g} of the clearance, and the rotor under the forces there is {left:.3g} of it away"
        )
    return np.asarray(series[:, 0])


def first_guess(mounted: MountedRotor, modal: ModalRotor) -> Array:
    """Return the positions of the journals at rest by the search of `linear`; zeros without weight."""
    rotor = mounted.bare
    parts = modal.parts
    if not np.any(parts.structure.weight):
        return np.zeros(2 * len(parts.bearings))
    if isinstance(rotor, FlexibleRotor):
        bearings = dict(zip(parts.names, parts.bearings, strict=True))
        return np.asarray(parts.rows @ rotor_equilibrium(rotor, bearings, parts.speed).displacement)
    assert isinstance(rotor, RigidRotor)
    return np.asarray(equilibrium(parts.bearings[0], rotor.static_load, parts.speed).position)
