"""Which whirl at one speed is which at another."""

from __future__ import annotations

from typing import Any

import numpy as np
from scipy.optimize import linear_sum_assignment

from ..rotor_modes import RotorModes


def matches(before: RotorModes, after: RotorModes, mass: Any) -> dict[int, int]:
    """Return the mode of `before` that each mode of `after` continues, by eigenvalue and shape."""
    if not (before.eigenvalues.size and after.eigenvalues.size):
        return {}
    product = np.abs(before.shapes.conj().T @ (mass @ after.shapes)) ** 2
    sizes = [np.sum(m.shapes.conj() * (mass @ m.shapes), axis=0).real for m in (before, after)]
    likeness = product / np.outer(*sizes)
    scale = np.abs(before.eigenvalues)[:, None] + np.abs(after.eigenvalues)
    apart = np.abs(before.eigenvalues[:, None] - after.eigenvalues) / scale
    cost = apart + 0.2 * (1.0 - likeness)
    rows, columns = linear_sum_assignment(cost)
    return {int(c): int(r) for r, c in zip(rows, columns, strict=True) if apart[r, c] < 0.5}


def tracked(points: list[RotorModes], mass: Any) -> list[dict[int, int]]:
    """Return, for each mode, its index among the modes of each speed at which it was found."""
    tracks: list[dict[int, int]] = [{0: k} for k in range(len(points[0].eigenvalues))]
    current = list(range(len(tracks)))
    for column in range(1, len(points)):
        before, after = points[column - 1], points[column]
        partner = matches(before, after, mass)
        following = []
        for k in range(len(after.eigenvalues)):
            if k in partner:
                following.append(current[partner[k]])
            else:
                tracks.append({})
                following.append(len(tracks) - 1)
            tracks[following[-1]][column] = k
        current = following
    return tracks
