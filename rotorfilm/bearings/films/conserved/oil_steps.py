"""Steps in time of a film that conserves its oil: what it remembers, and the step from there to a gap.

A journal bearing or a damper gives the gap at the end of the step and half the speed; nothing here knows
which.
"""

from __future__ import annotations

import io
from typing import NamedTuple

import numpy as np

from ....errors import InputError
from ....model import Array
from .conserved_film import ConservedFilm, ConservedState, Gap, Storage, step_storage

MOST_GROWTH = 2.0
"""Of a step over the last one, up to which differences of second order take both (stable to 2.41)."""

EMPTY = -1e-9
"""Content of a cell below which a difference of second order took more oil from it than it had."""

STILL, MOST_STILL, WEIGHT = 1e-13, 80, 0.7
"""Change of theta at which the steady film stands, most solutions on the way, and how much of each counts."""


class OilMemory(NamedTuple):
    """What a film that conserves its oil knows of its past.

    Attributes
    ----------
    content : ndarray, shape (N, M) [1]
        theta H of every cell.
    before : ndarray, shape (N, M) [1]
        The same one step earlier.
    length : float [s]
        Of the last step; 0 where there was none.
    pressure, theta : ndarray, shape (N, M) [1/s], [1]
    full : ndarray of uint8, shape (N, M)
    """

    content: Array
    before: Array
    length: float
    pressure: Array
    theta: Array
    full: np.ndarray


def steady_oil(film: ConservedFilm, gap: Gap, rate: float) -> ConservedState:
    """Return the steady film that steps in a gap that stays come to: its oil is carried at second order.

    Raises
    ------
    ConvergenceError
        As `ConservedFilm.solve`.
    """
    state = film.solve(gap, rate)
    carried = np.zeros(film.cells.opening.shape)
    for _ in range(MOST_STILL):
        theta = state.solution.theta
        carried = (1.0 - WEIGHT) * carried + WEIGHT * sharpened(film, gap, rate, theta)
        state = film.solve(gap, rate, storage=Storage(0.0, -carried), guess=state.solution.full)
        if np.abs(state.solution.theta - theta).max() <= STILL:
            break
    return state


def remembered(state: ConservedState) -> OilMemory:
    """Return the memory of a film that has long stood as it is."""
    return OilMemory(state.content, state.content, 0.0, *state.solution[:3])


def after_step(memory: OilMemory, state: ConservedState, dt: float) -> OilMemory:
    """Return the memory after a step of length dt [s] that ended at a state."""
    return OilMemory(state.content, memory.content, dt, *state.solution[:3])


def oil_step(
    film: ConservedFilm, memory: OilMemory, gap: Gap, rate: float, dt: float, *, near: OilMemory | None = None
) -> ConservedState:
    """Return the film at the end of a step.

    Differences of second order in time (BDF2) of the last two contents, steps of any lengths; Euler's where
    there was none, after one that was less than half as long, and where the former would take more from a
    cell than it has.

    Parameters
    ----------
    film : ConservedFilm
    memory : OilMemory
    gap : Gap
        At the end of the step.
    rate : float [1/s]
        Half the speed there.
    dt : float [s]
        Length of the step.
    near : OilMemory, optional
        A film near that at the end, as the last iterate: its theta tells by how much transport of second
        order differs from that of upstream values. By default that at the beginning.

    Raises
    ------
    ConvergenceError
        If the search for the cavity does not end.
    """
    like = memory if near is None else near
    carried = sharpened(film, gap, rate, like.theta)
    ratio = dt / memory.length if memory.length > 0.0 else np.inf
    if ratio <= MOST_GROWTH:
        state = _solved(
            film, gap, rate, step_storage(dt, memory.content, memory.before, ratio), carried, like
        )
        if state.solution.theta.min() >= EMPTY:
            return state
    return _solved(film, gap, rate, step_storage(dt, memory.content), carried, like)


def _solved(
    film: ConservedFilm, gap: Gap, rate: float, storage: Storage, carried: Array, near: OilMemory
) -> ConservedState:
    return film.solve(gap, rate, storage=storage._replace(held=storage.held - carried), guess=near.full)


def sharpened(film: ConservedFilm, gap: Gap, rate: float, theta: Array) -> Array:
    """Return what leaves the cells beyond transport at upstream theta, over their area, shape (N, M) [1/s].

    At a face theta is that upstream plus d_- d_+/(d_- + d_+) where both have one sign (van Leer 1974), d_-
    and d_+ being the differences before and behind that cell.
    """
    forward = rate >= 0.0
    row = theta if forward else theta[::-1]
    behind, ahead = row - np.roll(row, 1, axis=0), np.roll(row, -1, axis=0) - row
    product = behind * ahead
    rises = product > 0.0
    limited = np.where(rises, product / np.where(rises, behind + ahead, 1.0), 0.0)
    # Turned round, the face of line k is that before it.
    face = limited if forward else np.roll(limited[::-1], -1, axis=0)
    flux = rate * film.carried(gap) * face * film.cells.width
    return np.asarray((flux - np.roll(flux, 1, axis=0)) / film.cells.area)


def packed_oil(memory: OilMemory, **further: Array) -> bytes:
    """Return a memory, and further numbers, as bytes to the last bit."""
    buffer = io.BytesIO()
    np.savez(buffer, **memory._asdict(), **further)  # type: ignore[arg-type]
    return buffer.getvalue()


def unpacked_oil(content: bytes, shape: tuple[int, ...]) -> tuple[OilMemory, dict[str, Array]]:
    """Return what `packed_oil` made bytes of; raise InputError if it is not of a shape (N, M)."""
    with np.load(io.BytesIO(content), allow_pickle=False) as file:
        rows = {name: file[name] for name in file.files}
    memory = OilMemory(**{name: rows.pop(name) for name in OilMemory._fields})
    if memory.content.shape != shape:
        raise InputError(f"content must be of {shape} cells, got {memory.content.shape}")
    return memory._replace(length=float(memory.length)), rows
