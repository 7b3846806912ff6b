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
from .conserved_film import ConservedFilm, ConservedState, Gap
from .step_kernel import rest_oil, step_oil

MOST_GROWTH = 2.0
"""Of a step over the last one, up to which differences of second order take both (stable to 2.41)."""


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
    return rest_oil(film, gap, rate)


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
    past = memory.content, memory.before, memory.length
    return step_oil(film, gap, rate, dt, past, (like.theta, like.full))


def passed_oil(before: Array, flow: Array, state: ConservedState, dt: float) -> Array:
    """Return the oil [m3] of flows [m3/s] at the end of a step, by the differences that its storage has.

    Of `before`, what passed in the step before. So what entered less what left is what the oil changed by.
    """
    rate, share = state.difference
    return (dt * flow + share * before) / (rate * dt)


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
