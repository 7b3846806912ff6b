"""A flexible rotor on its films as a state space, with the states of bearings whose stiffness is K(s)."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from typing import NamedTuple

import numpy as np

from ...bearings.inertial_model import added_mass
from ...errors import InputError
from ...model import Array, Linearization
from ...results import Coefficients
from ...rotors import FlexibleRotor
from ...rotors.stations import station_name
from ...rotors.structure import output_rows
from ...signals import names
from ..closed_loop import HOUSING
from ..memory.film_system import film_states
from ..rotor_rest import RotorEquilibrium
from .second_order import journal_rows, remembering, second_order
from .tilting import film_rows
from .work import tally


class RotorStates(NamedTuple):
    """A rotor on its films: matrices, and the names of outputs and states."""

    matrices: Linearization
    outputs: list[str]
    states: list[str]


def rotor_states(rotor: FlexibleRotor, at: RotorEquilibrium, loads: Array) -> RotorStates:
    """Return a rotor on its films about a rest, under loads (N, m) [N] per unit of the inputs.

    Raises
    ------
    InputError
        If the rotor has hysteresis, which no state space has, or as `film_states`.
    """
    structure = rotor.structure
    if structure.hysteresis is not None:
        raise InputError("loss_factor must be 0 for a state space, which hysteresis has not; see rotor_modes")
    films = {name: film_states(film) for name, film in remembering(at).items()}
    direct = replace(at, coefficients={**at.coefficients, **_direct(at, films)})
    mass, damping, stiffness = second_order(structure, direct)
    n, sizes = len(mass), [len(film.A) for film in films.values()]
    rows = {name: journal_rows(structure, name) for name in films}
    pushes = [np.zeros((n, 0)), *(rows[name].T @ film.C for name, film in films.items())]
    tally("factorizations")
    columns = np.hstack([-stiffness, -damping, *pushes, loads])
    motion, pushed = np.split(np.linalg.solve(mass, columns), [2 * n + sum(sizes)], axis=1)
    felt = [np.hstack([f.B[:, :2] @ rows[name], f.B[:, 2:] @ rows[name]]) for name, f in films.items()]
    own = _on_diagonal([film.A for film in films.values()])
    sense, outputs = response_rows(rotor, direct)
    by_state = np.hstack([sense[:, : 2 * n], np.zeros((len(sense), sum(sizes)))])
    for name, first, film in zip(films, np.cumsum([2 * n, *sizes]), films.values(), strict=False):
        row = outputs.index(station_name(name, HOUSING[0]))
        by_state[row : row + 2, first : first + len(film.A)] -= film.C
    by_acceleration = sense[:, 2 * n :]
    A = [np.eye(n, motion.shape[1], n), motion, np.hstack([np.vstack([np.zeros((0, 2 * n)), *felt]), own])]
    B = [np.zeros_like(pushed), pushed, np.zeros((len(own), pushed.shape[1]))]
    further = [
        station_name(name, f"memory_{k}")
        for name, size in zip(films, sizes, strict=True)
        for k in range(size)
    ]
    return RotorStates(
        Linearization(
            np.vstack(A), np.vstack(B), by_state + by_acceleration @ motion, by_acceleration @ pushed
        ),
        outputs,
        [*names(rotor.states), *further],
    )


def response_rows(rotor: FlexibleRotor, at: RotorEquilibrium) -> tuple[Array, list[str]]:
    """Return rows over (q, q', q'') and names of all outputs of a rotor on its films."""
    s = rotor.assembly
    own = output_rows(s)
    rows: Sequence[Array] = [np.hstack([own, np.zeros((len(own), len(s.weight)))])]
    labels = names(rotor.outputs)[:-1]
    for name, film in at.coefficients.items():
        felt = film_rows(s, name, len(film.stiffness))
        parts = (film.stiffness, film.damping, added_mass(film))
        rows = [*rows, np.hstack([part[:2] @ felt for part in parts])]
        labels += [station_name(name, signal) for signal in HOUSING]
    return np.vstack(rows), labels


def _direct(at: RotorEquilibrium, films: dict[str, Linearization]) -> dict[str, Coefficients]:
    """Return stiffness and damping of films whose states are held."""
    return {
        name: Coefficients(
            stiffness=-film.D[:, :2],
            damping=-film.D[:, 2:],
            position=at.coefficients[name].position,
            speed=at.speed,
        )
        for name, film in films.items()
    }


def _on_diagonal(blocks: Sequence[Array]) -> Array:
    """Return square blocks on a diagonal; of none an empty matrix."""
    from scipy.linalg import block_diag

    return np.asarray(block_diag(*blocks)) if blocks else np.zeros((0, 0))
