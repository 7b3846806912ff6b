"""Floquet multipliers of a periodic orbit: the monodromy matrix, integrated with the slopes of the films."""

from __future__ import annotations

import numpy as np

from ...model import Array
from ..compiled.collocation import STAGES, ModalArrays, StepTable, radau_scheme
from ..compiled.modal import Complex, ModalRotor, journal_rows, modes
from .harmonics import series_rows
from .modal_films import film_forces

STEPS_PER_HARMONIC = 2
LEAST_STEPS = 64


def monodromy(modal: ModalRotor, series: Array, frequency: float, steps: int | None = None) -> Array:
    """Return how a small change of the state is mapped over one period, shape (2 N, 2 N).

    The scheme is that of `simulate_rotor` (order 7), linear here: the rotor on the mean slopes of its films
    is exact, fast modes included, and over a step only what the films add to that is unknown.

    Parameters
    ----------
    modal : ModalRotor
    series : ndarray, shape (2 n_bearings, 2 H + 1) [m]
    frequency : float [rad/s]
    steps : int, optional
        By default two for each harmonic.
    """
    harmonics = series.shape[1] // 2
    steps = steps or max(LEAST_STEPS, STEPS_PER_HARMONIC * harmonics)
    slopes = _slopes(modal, series, frequency, steps)
    mean = slopes.mean(axis=(0, 1))
    modal, slopes = on_mean_films(modal, mean), slopes - mean
    step = 2.0 * np.pi / (frequency * steps)
    table = StepTable.of_step(ModalArrays.of(modal), radau_scheme(STAGES), step)
    modes, count = len(modal.values), slopes.shape[2]
    channels = np.arange(STAGES)[:, None] * (count + 2) + np.arange(count)
    forced = table.forced[:modes, channels.ravel()] + 1j * table.forced[modes:, channels.ravel()]
    z: Complex = modal.inverse.astype(complex)
    identity = np.eye(STAGES * count)
    for local_slopes in slopes:
        moved = (table.move @ np.vstack([z.real, z.imag])).reshape(STAGES, -1, 4, z.shape[1])
        local = local_slopes.reshape(STAGES, -1, 2, 4)
        right = np.einsum("ibrk,ibkn->ibrn", local, moved).reshape(STAGES * count, -1)
        by_force = table.gain[..., :count].reshape(STAGES, STAGES, -1, 4, count)
        matrix = np.einsum("ibrk,ijbkc->ibrjc", local, by_force).reshape(STAGES * count, STAGES * count)
        z = table.keep[:, None] * z + forced @ np.linalg.solve(identity - matrix, right)
    return np.asarray((modal.shapes @ z).real)


def _slopes(modal: ModalRotor, series: Array, frequency: float, steps: int) -> Array:
    """Return the films' slopes at the nodes of all steps, shape (steps, stages, 2 n_bearings, 4)."""
    nodes = radau_scheme(STAGES).nodes
    phase = (2.0 * np.pi / steps * (np.arange(steps)[:, None] + nodes)).ravel()
    values, rates = series_rows(series.shape[1] // 2, phase)
    _, stiffness, damping = film_forces(modal, series @ values.T, frequency * (series @ rates.T))
    both = np.moveaxis(np.concatenate([stiffness, damping], axis=1), 2, 0)
    return both.reshape(steps, STAGES, len(series), 4)


def on_mean_films(modal: ModalRotor, slopes: Array) -> ModalRotor:
    """Return a rotor on other springs and dampers at its journals: further slopes (2 n, 4)."""
    rows = journal_rows(modal.parts).reshape(-1, 4, len(modal.shapes))
    forced = np.einsum("bij,bjn->bin", slopes.reshape(-1, 2, 4), rows).reshape(len(slopes), -1)
    A = ((modal.shapes * modal.values) @ modal.inverse).real
    B = (modal.shapes @ modal.push).real
    size = len(A) // 2
    rate = float(np.sqrt(np.abs(A[size:, :size]).max())) or 1.0
    values, shapes, inverse, condition = modes(A + B[:, : len(slopes)] @ forced, rate)
    return modal._replace(
        values=values,
        shapes=shapes,
        inverse=inverse,
        push=inverse @ B,
        sense=journal_rows(modal.parts) @ shapes,
        condition=condition,
    )


def multipliers(modal: ModalRotor, series: Array, frequency: float) -> Complex:
    """Return the Floquet multipliers, the largest first."""
    scale = np.repeat([1.0, frequency], len(modal.shapes) // 2)
    matrix = monodromy(modal, series, frequency)
    values = np.linalg.eigvals(matrix * scale / scale[:, None])
    return values[np.argsort(-np.abs(values))]


def state_at_start(modal: ModalRotor, series: Array, frequency: float, periods: int) -> Array:
    """Return the state (2 N,) at phase 0 of an orbit, the whole rotor's."""
    harmonics = series.shape[1] // 2
    samples = 4 * harmonics + 8
    phase = 2.0 * np.pi * np.arange(samples) / samples
    values, rates = series_rows(harmonics, phase)
    force = film_forces(modal, series @ values.T, frequency * (series @ rates.T))[0]
    spectrum = np.fft.rfft(force, axis=1)[:, : harmonics + 1] / samples
    total = np.zeros(len(modal.values), dtype=complex)
    for k in range(harmonics + 1):
        pole = 1j * k * frequency
        push = modal.push[:, :-2] @ spectrum[:, k]
        back = modal.push[:, :-2] @ spectrum[:, k].conj()
        if k and k == periods:
            pair = 0.5 * modal.parts.speed**2 * np.array([1.0, -1.0j * np.sign(modal.parts.speed)])
            push = push + modal.push[:, -2:] @ pair
            back = back + modal.push[:, -2:] @ pair.conj()
        total += push / (pole - modal.values)
        if k:
            total += back / (-pole - modal.values)
    return modal.physical(total)
