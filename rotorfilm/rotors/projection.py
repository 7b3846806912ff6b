"""The equations of a rotor that moves in some of its shapes only."""

from __future__ import annotations

from typing import Any

import numpy as np

from ..model import Array
from .sparse_chain import dense_matrix
from .structure import NOMINAL_LENGTH, Coordinate, Readout, Structure, both_planes

DEPENDENT = 1e-6
"""Part of a shape, as the root of its kinetic energy, below which it adds nothing to those before it."""


def projected(full: Structure, shapes: Array) -> Structure:
    """Return the matrices of a structure that moves in shapes of one plane, the same in both (Galerkin).

    Parameters
    ----------
    full : Structure
        With N coordinates.
    shapes : ndarray, shape (N / 2, n)
    """
    basis = both_planes(shapes)
    twice = both_planes(basis)

    def project(matrix: Any) -> Array:
        return np.asarray(basis.T @ dense_matrix(matrix @ basis))

    return Structure(
        mass=project(full.mass),
        damping=project(full.damping),
        gyroscopic=project(full.gyroscopic),
        stiffness=project(full.stiffness),
        circulation=project(full.circulation),
        stations=full.stations,
        journals=full.journals @ basis,
        weight=basis.T @ full.weight,
        unbalance=basis.T @ full.unbalance,
        coordinates=tuple(Coordinate(f"shape_{{}}_{k}", "m", NOMINAL_LENGTH) for k in range(shapes.shape[1])),
        readouts=tuple(Readout(readout.signal, readout.row @ twice) for readout in full.readouts),
        housings=None if full.housings is None else full.housings @ basis,
        hysteresis=None if full.hysteresis is None else shapes.T @ (full.hysteresis @ shapes),
        tilts=None if full.tilts is None else full.tilts @ basis,
    )


def mean_plane(matrix: Any) -> Any:
    """Return the mean of what a matrix is in both planes, shape (N / 2, N / 2)."""
    n = matrix.shape[0] // 2
    return 0.5 * (matrix[:n, :n] + matrix[n:, n:])


def new_shapes(shapes: Array, known: Array, mass: Any, least: float = DEPENDENT) -> Array:
    """Return what each shape adds, if anything, to known ones of unit mass and to the shapes before it.

    Parameters
    ----------
    shapes : ndarray, shape (N / 2, m)
    known : ndarray, shape (N / 2, n)
        Of unit mass, and without mass in common.
    mass : ndarray or sparse array, shape (N / 2, N / 2)
    least : float [1]
        Part of a shape that must be new.
    """
    count = known.shape[1]
    for shape in shapes.T:
        size = np.sqrt(shape @ (mass @ shape))
        if size == 0.0:
            continue
        rest = shape / size
        for _ in range(2):  # twice is enough (Kahan and Parlett)
            rest = rest - known @ (known.T @ (mass @ rest))
        left = np.sqrt(rest @ (mass @ rest))
        if left > least:
            known = np.column_stack([known, rest / left])
    return known[:, count:]
