"""How far off whirls are that were found in some of the shapes of a rotor, by what is left of its equations."""

from __future__ import annotations

import numpy as np

from ...model import Array
from ..rotor_system import SecondOrder
from .condensed import MARGIN, Condensed

TOLERANCE = 1e-6
"""Relative error of an eigenvalue, estimated, beyond which more shapes are taken."""


def whirl_errors(
    model: Condensed, whole: SecondOrder, values: np.ndarray, right: np.ndarray, left: np.ndarray
) -> Array:
    """Return estimates of |ds / s| of eigenvalues s found in the shapes of a model, shape (m,).

    With vectors x, y of the whole rotor, r = L(s) x and l = L(s)* y are the forces that the shapes do not
    balance, and the error is -l* A r / (y* L'(s) x) to leading order, A the answer of what is left out. It
    gives way as to slow forces, times 1 / (1 - 1 / MARGIN^2) at most.

    Parameters
    ----------
    model : Condensed
    whole : SecondOrder
        Sparse, of all coordinates.
    values : ndarray, shape (m,) [1/s]
    right, left : ndarray, shape (N, m)
        L right = 0 and left* L = 0 in the shapes of the model.
    """
    inertia, damping = whole.mass @ right, whole.damping @ right
    unbalanced = values**2 * inertia + values * damping + whole.stiffness @ right
    back = values.conj()
    other = back**2 * (whole.mass.T @ left) + back * (whole.damping.T @ left)
    other = other + whole.stiffness.conj().T @ left
    slope = np.sum(left.conj() * (2.0 * values * inertia + damping), axis=0)
    change = np.sum(other.conj() * model.answer(unbalanced), axis=0) / slope
    return np.asarray(np.abs(change / values) / (1.0 - MARGIN**-2.0))
