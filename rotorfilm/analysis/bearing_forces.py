"""What the bearings of a rotor did in a compiled run, from the states at its samples."""

from __future__ import annotations

from typing import Any

import numpy as np

from ..core.model import Array
from ..core.port import freedoms_of, inertial, mass_of
from ..rotors.structure import freedom_rows
from .compiled_rotor import Parts, equations, state_matrices, turning_pairs
from .force_calls import CrackForce, has_states_in_c


def bearing_forces(parts: Parts, time: Array, states: Array, turn: Array) -> list[Array]:
    """Return what each bearing adds to a trajectory, shape (n_signals, n_times).

    These are its forces with that of the added mass, and for one with states its further outputs and states.

    Parameters
    ----------
    parts : Parts
    time : ndarray, shape (n_times,) [s]
    states : ndarray, shape (n_times, n_states)
    turn : ndarray, shape (3, n_times)
        Angle, speed and angular acceleration.
    """
    n, speed = len(parts.structure.weight), turn[1]
    journals = list(zip(parts.names, parts.bearings, strict=False))
    rows = [freedom_rows(parts.structure, name, freedoms_of(bearing)) for name, bearing in journals]
    moved = [(seen @ states[:, :n].T, seen @ states[:, n : 2 * n].T) for seen in rows]
    first, inner = 2 * n, {}
    for one in parts.linear:
        last = first + len(one.system.A)
        inner[one.station], first = states[:, first:last].T, last
    outputs = [
        bearing.outputs_over_time(inner[name], *at, speed) if has_states_in_c(bearing) else None
        for (name, bearing), at in zip(journals, moved, strict=True)
    ]
    found = [
        shown[:2] if shown is not None else _force(bearing, at, speed, linear=name in inner)
        for (name, bearing), at, shown in zip(journals, moved, outputs, strict=True)
    ]
    accelerations = np.zeros((2 * len(journals), len(time)))
    if any(inertial(bearing) is not None for _, bearing in journals):
        found, accelerations = _with_inertia(parts, found, moved, time, states, turn)
    for one in parts.linear:
        k = parts.names.index(one.station)
        shown, own = outputs[k], inner[one.station]
        if shown is not None:
            found[k] = np.concatenate([found[k], shown[2:], own])
            continue
        force = one.system.C @ own + one.system.D @ np.concatenate(moved[k])
        found[k] = force - one.mass @ accelerations[2 * k : 2 * k + 2]
        if one.reaction.states:
            still = np.append(np.zeros(4), parts.profile.speeds[0])
            further = one.reaction.output(0.0, one.reaction.initial_state, still)[2:]
            found[k] = np.concatenate([found[k], np.outer(further, np.ones(len(time))), own])
    return found


def _force(bearing: Any, at: tuple[Array, Array], speed: Array, *, linear: bool) -> Array:
    """Return the force of a bearing in a motion, shape (2, n_times), less that of the linear equations."""
    return np.zeros_like(at[0]) if linear else np.asarray(bearing.force(*at, speed))


def _with_inertia(
    parts: Parts,
    forces: list[Array],
    moved: list[tuple[Array, Array]],
    time: Array,
    states: Array,
    turn: Array,
) -> tuple[list[Array], Array]:
    """Return forces F less M a of the added masses of bearings, and the accelerations a of all journals.

    With a = a0 + D u for all forces u, u = F - M a is solved for the forces.
    """
    n, speed = len(parts.structure.weight), turn[1]
    A, B, weight = state_matrices(parts, 0.0)
    given = [turning_pairs(turn)]
    if parts.excited is not None:
        given += [np.interp(time, parts.excited[0], row, 0.0, 0.0)[:, None] for row in parts.excited[1:]]
    pushed = np.hstack(given) @ B[:, len(parts.rows) :].T
    free = states @ A.T + speed[:, None] * (states @ equations(parts).by_speed.T) + pushed + weight
    by_force = parts.rows @ B[n : 2 * n, : len(parts.rows)]
    acting = [*forces, *(_released(one, states[:, :n], time) for one in parts.bearings[len(forces) :])]
    force, a0 = np.concatenate(acting).T, free[:, n : 2 * n] @ parts.rows.T
    masses = np.zeros((len(time), len(parts.rows), len(parts.rows)))
    for k, (bearing, at) in enumerate(zip(parts.bearings, moved, strict=False)):
        if inertial(bearing) is not None and not parts.is_linear(bearing):
            own = slice(2 * k, 2 * k + 2)
            masses[:, own, own] = np.moveaxis(mass_of(bearing, *at, speed), -1, 0)
    joint = np.eye(len(by_force)) + masses @ by_force
    whole = np.linalg.solve(joint, (force - np.einsum("tij,tj->ti", masses, a0))[..., None])[..., 0]
    accelerations = a0 + whole @ by_force.T
    return [whole[:, 2 * k : 2 * k + 2].T for k in range(len(forces))], accelerations.T


def _released(crack: CrackForce, places: Array, time: Array) -> Array:
    """Return the force of a crack over time, shape (2, n_times)."""
    lost = np.array([crack.rotor.lost(t) for t in time])
    return np.einsum("tij,tj->it", lost, places @ crack.rotor.weakness[0].T)
