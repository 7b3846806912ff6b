"""Which initial offsets of a rotor at rest decay, and which end in whirl."""

from __future__ import annotations

from collections import Counter
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from ..core.errors import ContactError, InputError, require_count, require_positive, require_vector
from ..core.inputs import arguments
from ..core.model import Array
from ..core.readable import Readable
from ..rotors import MountedRotor
from .compiled_march import LONGEST_TURN, March
from .compiled_rotor import Complex, ModalRotor, Parts, modal_rotor, take_apart
from .harmonic_balance import film_forces
from .periodic_orbit import Rest, rest_of
from .threads import one_blas_thread

BLOCK = 10
"""Turns between two looks at the amplitude."""

SAMPLES = 200
"""Samples of a block."""

SETTLED = 0.01
"""Amplitude, in that of the offset, below which a stable rest is taken to be reached."""

STEADY = 1e-6
"""Relative change of the amplitude from block to block at which whirl is taken to be steady."""


@dataclass(frozen=True, kw_only=True, eq=False)
class BasinScan(Readable):
    """Basins of attraction: the long-term motion of a rotor from offsets of its journals.

    Attributes
    ----------
    offsets : ndarray, shape (2, ...) [m]
        Initial displacement of all journals from their rest.
    amplitude : ndarray, shape (...) [1]
        Largest distance of a journal from its rest / clearance over the last turns; nan where it hit
        the wall.
    whirls : ndarray of bool, shape (...)
        Whether the rotor whirls in the end, or hit the wall.
    eccentricity : ndarray, shape (...) [1]
        Largest eccentricity ratio over the last turns.
    rest : ndarray, shape (2 n_bearings,) [m]
        Position of the journals at rest.
    work : dict of str to int
    """

    offsets: Array
    amplitude: Array
    whirls: np.ndarray
    eccentricity: Array
    rest: Array
    work: dict[str, int]


@one_blas_thread
@arguments
def basin_scan(
    mounted: MountedRotor, offsets: ArrayLike, *, turns: int = 400, rtol: float = 1e-6
) -> BasinScan:
    """Return which offsets from the equilibrium decay and which end in whirl.

    The rotor starts without velocity. All journals start at the same displacement from their equilibrium,
    with the shaft bent as little as possible.

    Parameters
    ----------
    mounted : MountedRotor
        Mounted rotor from `mount`, at constant speed, without unbalance.
    offsets : array_like, shape (2, ...) [m]
        Initial displacements from the equilibrium. Those that touch the wall count as whirl, with the
        amplitude nan.
    turns : int
        Longest run in turns of the shaft; it ends sooner once it is decided.
    rtol : float [1]
        Relative tolerance of the runs, as `rtol` of `simulate_rotor`.

    Raises
    ------
    InputError
        If an argument breaks its rule, or the rotor has an unbalance.
    EquilibriumError
        If there is no rest.
    """
    require_count("turns", turns)
    require_positive("rtol", rtol)
    grid = require_vector("offsets", offsets)
    parts = take_apart(mounted)
    if np.any(parts.structure.unbalance):
        raise InputError("rotor must have no unbalance for a basin of whirl")
    modal = modal_rotor(parts, parts.speed)
    rest = rest_of(mounted, modal)
    shapes = offset_shapes(parts)
    state = _rest_state(modal, rest)
    work: Counter[str] = Counter()
    flat = grid.reshape(2, -1)
    ends = np.array([_end(modal, rest, state, shapes @ offset, turns, rtol, work) for offset in flat.T])
    amplitude, eccentricity, whirls = ends.reshape(*grid.shape[1:], 3).transpose(-1, *range(grid.ndim - 1))
    return BasinScan(
        offsets=grid,
        amplitude=amplitude,
        whirls=whirls > 0.0,
        eccentricity=eccentricity,
        rest=rest.position,
        work=dict(work),
    )


def _end(
    modal: ModalRotor, rest: Rest, state: Array, shape: Array, turns: int, rtol: float, work: Counter[str]
) -> tuple[float, float, bool]:
    """Return amplitude, eccentricity ratio and whether it whirls in the end, from one offset."""
    start = state.copy()
    start[: len(shape)] += shape
    turn = 2.0 * np.pi / abs(modal.parts.speed)
    march = March(
        modal=modal, state=modal.modal(start), rtol=rtol, longest=LONGEST_TURN * turn, duration=turns * turn
    )
    first = _amplitude(modal, rest, march.state[:, None].copy())[0]
    before, amplitude, eccentricity = np.inf, first, 0.0
    begin = 0.0
    while begin < turns * turn * (1.0 - 1e-12):
        stop = min(begin + BLOCK * turn, turns * turn)
        try:
            kept = march.to(stop, np.linspace(begin, stop, SAMPLES + 1)[1:])
        except ContactError:
            work.update(march.work)
            return float("nan"), 1.0, True
        amplitude, eccentricity = _amplitude(modal, rest, kept.T)
        if amplitude < SETTLED * first or abs(amplitude - before) <= STEADY * amplitude:
            break
        before, begin = amplitude, stop
    work.update(march.work)
    return amplitude, eccentricity, amplitude > 0.5 * first or amplitude > 0.05


def _amplitude(modal: ModalRotor, rest: Rest, kept: Complex) -> tuple[float, float]:
    """Return the largest distance of a journal from its rest, and from its center, in clearances."""
    motion = (modal.sense @ kept).real + modal.journal_rest[:, None]
    position = motion.reshape(-1, 4, motion.shape[1])[:, :2]
    lengths = modal.parts.lengths[:, None]
    away = position - rest.position.reshape(-1, 2, 1)
    return (
        float((np.hypot(away[:, 0], away[:, 1]) / lengths).max()),
        float((np.hypot(position[:, 0], position[:, 1]) / lengths).max()),
    )


def _rest_state(modal: ModalRotor, rest: Rest) -> Array:
    """Return the state of the whole rotor at rest."""
    none = np.zeros((len(rest.position), 1))
    force = film_forces(modal, rest.position[:, None], none)[0][:, 0]
    return modal.physical(-(modal.push[:, :-2] @ force) / modal.values)


def offset_shapes(parts: Parts) -> Array:
    """Return the displacement of the rotor per common offset of its journals, least bent, shape (N, 2)."""
    stiffness, rows = parts.structure.stiffness, parts.rows
    n, count = len(stiffness), len(rows)
    size = float(np.abs(stiffness).max()) or 1.0
    saddle = np.block([[stiffness / size, rows.T], [rows, np.zeros((count, count))]])
    right = np.zeros((n + count, 2))
    right[n:] = np.tile(np.eye(2), (count // 2, 1))
    return np.asarray(np.linalg.lstsq(saddle, right, rcond=None)[0][:n])
