"""How large the error of a response in some of the shapes of a rotor is, at many speeds.

L(s) is a sum of numbers times matrices that stay as they are. What each of them makes of the shapes, and how
what is left out answers that, is worked out once.
"""

from __future__ import annotations

from typing import Any

import numpy as np

from ...bearings.inertial_model import added_mass
from ...model import Array
from ...rotors.structure import Structure, across_planes, both_planes
from ..rotor_rest import RotorEquilibrium
from .condensed import Condensed
from .defects import FASTER, seen_rows


class LeftOut:
    """The forces that the shapes of a model do not balance under given loads.

    Parameters
    ----------
    model : Condensed
        In some of the shapes.
    loads : ndarray, shape (N, m) [N]
    """

    def __init__(self, model: Condensed, loads: Array) -> None:
        whole = model.whole
        shapes = model.lifted(np.eye(len(model.structure.weight)))
        pieces = _pieces(whole)
        felt = [whole.journals] if whole.tilts is None else [whole.journals, whole.tilts]
        forces = [rows.T for rows in felt]
        heavy = whole.mass @ shapes
        self.count = len(pieces)
        self.places = seen_rows(whole)
        self.felt = np.vstack(felt) @ shapes
        self.seen = self.places @ shapes
        starts, ends = (
            _unbalanced(np.hstack([first, *(piece @ shapes for piece in matrices), *forces]), shapes, heavy)
            for first, matrices in ((loads, pieces), (self.places.T, [piece.T for piece in pieces]))
        )
        self.energies = ends.T @ model.answer(starts)
        self.stations = whole.stations

    def error(
        self,
        at: RotorEquilibrium,
        frequency: float,
        amplitudes: np.ndarray,
        motion: np.ndarray,
        dual: np.ndarray,
    ) -> float:
        """Return the largest error of displacements at bearings and probes / the largest of them, estimated.

        With r = f - L x and l = t - L* y, where y is the answer to unit forces t there, it is l* A r, A the
        answer of what is left out.

        Parameters
        ----------
        at : RotorEquilibrium
        frequency : float [rad/s]
        amplitudes : ndarray, shape (m, k)
            Of the loads.
        motion, dual : ndarray, shape (n, ...)
            x and y in the shapes.
        """
        weights = _weights(at.speed, frequency)[: self.count]
        film = self._films(at, frequency)
        left = [np.eye(len(self.places)), *(-np.conj(w) * dual for w in weights)]
        right = [amplitudes, *(-w * motion for w in weights)]
        ends = np.vstack([*left, -film.conj().T @ (self.felt @ dual)])
        starts = np.vstack([*right, -film @ (self.felt @ motion)])
        seen = np.abs(self.seen @ motion).max(initial=0.0)
        change = np.abs(ends.conj().T @ (self.energies @ starts)).max(initial=0.0)
        return float(FASTER * change / seen) if seen else 0.0

    def _films(self, at: RotorEquilibrium, frequency: float) -> np.ndarray:
        """Return K + i frequency C - frequency^2 M of all stations, over their displacements and tilts."""
        found = np.zeros((len(self.felt), len(self.felt)), dtype=complex)
        for name, film in at.coefficients.items():
            k = 2 * self.stations.index(name)
            places = [k, k + 1, k + 2 * len(self.stations), k + 1 + 2 * len(self.stations)]
            own = places[: len(film.stiffness)]
            found[np.ix_(own, own)] += film.stiffness + 1j * frequency * film.damping
            found[np.ix_(own, own)] -= frequency**2 * added_mass(film)
        return found


def _pieces(s: Structure) -> list[Any]:
    """Return the matrices that `_weights` are of."""
    found = [s.mass, s.damping, s.gyroscopic, s.stiffness, s.circulation]
    return found if s.hysteresis is None else [*found, across_planes(s.hysteresis), both_planes(s.hysteresis)]


def _weights(speed: float, frequency: float) -> list[complex]:
    """Return what the matrices of L(i frequency) are multiplied with."""
    share = 0.5 * (1.0 + np.sign(frequency - abs(speed)))
    s = 1j * frequency
    return [s**2, s, s * speed, 1.0, speed, (1.0 - share) * np.sign(speed), 1j * share]


def _unbalanced(forces: Array, shapes: Array, heavy: Array) -> Array:
    """Return forces less what the shapes take of them: nothing is lost of those that no shape feels."""
    return np.asarray(forces - heavy @ (shapes.T @ forces))
