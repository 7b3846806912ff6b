"""Stiffness and damping of journal and tilting pads together, and what of them a journal feels."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ...core.dynamic_stiffness import StatesStiffness
from ...core.errors import (
    InputError,
    require_number,
)
from ...core.model import Array, Linearization
from ...core.readable import Readable
from ...core.results import ReducedCoefficients


@dataclass(frozen=True, kw_only=True)
class PadMatrices(Readable):
    """Stiffness, damping and mass of journal and pads together at rest: M p'' + C p' + K p = 0.

    The coordinates p are x, y of the journal, the tilts q_1 .. q_N of the pads as lengths, and on springs the
    places s_1 .. s_N of their pivots, negative outward. A pad without film has rows of zeros, except for its
    spring.

    Attributes
    ----------
    stiffness : ndarray, shape (n, n) [N/m]
    damping : ndarray, shape (n, n) [N s/m]
    mass : ndarray, shape (n, n) [kg]
        Mass of the pads; that of the journal is 0.
    position : ndarray, shape (2,) [m]
    speed : float [rad/s]
    unloaded : ndarray of bool, shape (N,)
        Which pads have no film.
    """

    stiffness: Array
    damping: Array
    mass: Array
    position: Array
    speed: float
    unloaded: NDArray[np.bool_]

    def reduced(self, frequency: float, growth_rate: float = 0.0) -> ReducedCoefficients:
        """Return the reduced K and C of the journal for motion as exp(s t), by a Schur complement.

        The result equals Lund's (1964) assembly of single pads.

        Parameters
        ----------
        frequency : float [rad/s]
            Frequency of the whirl, of either sign; 0 for the limit of slow motion.
        growth_rate : float [1/s]
            s = growth_rate + i frequency; 0 at frequency 0.

        Raises
        ------
        InputError
            If a number is not finite, or growth has no frequency.
        """
        nu, sigma = require_number("frequency", frequency), require_number("growth_rate", growth_rate)
        if nu == 0.0 and sigma != 0.0:
            raise InputError(f"growth_rate must be 0 at frequency 0, got {growth_rate!r}")
        s = complex(sigma, nu)
        Z, slope = self.dynamic_stiffness(s)
        C = slope.real if nu == 0.0 else Z.imag / nu
        return ReducedCoefficients(
            stiffness=Z.real - sigma * C,
            damping=C,
            position=self.position,
            speed=self.speed,
            frequency=nu,
            growth_rate=sigma,
        )

    def modes(self, rotor_mass: float) -> NDArray[np.complex128]:
        """Return the exponents of free motion of a rigid rotor and the pads, the least damped first [1/s].

        Parameters
        ----------
        rotor_mass : float [kg]
            Rotor mass that the bearing carries.
        """
        return StatesStiffness(self.linearization()).exponents(rotor_mass)

    def linearization(self) -> Linearization:
        """Return the loaded pads as states under a journal: inputs x, y, vx, vy, outputs its force.

        Pads with mass have their velocities as further states; without mass the velocities follow from the
        balance of moments.
        """
        kept = np.array([0, 1, *self._loaded])
        K, C, M = (whole[kept][:, kept] for whole in (self.stiffness, self.damping, self.mass))
        masses, n = np.diag(M), len(kept) - 2
        heavy, light = np.flatnonzero(masses > 0.0), 2 + np.flatnonzero(masses[2:] == 0.0)
        states = n + len(heavy)
        # Columns: places of the pads, velocities of the heavy ones, place and velocity of the journal.
        place, velocity = np.zeros((2, n + 2, states + 4))
        place[:, [states, states + 1, *range(n)]] = np.eye(n + 2)
        velocity[:2, states + 2 :] = np.eye(2)
        velocity[heavy, n:states] = np.eye(len(heavy))
        pull = K[light] @ place + C[light] @ velocity
        velocity[light] = -np.linalg.solve(C[light][:, light], pull)
        force = -K @ place - C @ velocity
        rates = np.vstack([velocity[2:], force[heavy] / masses[heavy, None]])
        return Linearization(rates[:, :states], rates[:, states:], force[:2, :states], force[:2, states:])

    @property
    def _loaded(self) -> list[int]:
        """Coordinates of the pads that have a film."""
        free = np.resize(~self.unloaded, len(self.stiffness) - 2)
        return [2 + k for k in np.flatnonzero(free).tolist()]

    def dynamic_stiffness(self, s: complex) -> tuple[NDArray[np.complex128], NDArray[np.complex128]]:
        """Return Z(s) of the journal, shape (2, 2), and dZ/ds; s is an exponent [1/s]."""
        whole = self.stiffness + s * self.damping + s * s * self.mass
        follow, push, kept = following(whole, self._loaded)
        slope = self.damping + 2.0 * s * self.mass
        return whole[:2, kept] @ follow, push @ slope[np.ix_(kept, kept)] @ follow


def following(whole: NDArray[Any], loaded: list[int]) -> tuple[NDArray[Any], NDArray[Any], list[int]]:
    """Return how loaded coordinates follow the journal, what they push it by, and which are not left out.

    Parameters
    ----------
    whole : ndarray, shape (n, n) [N/m]
        Stiffness of journal and pads together.
    loaded : list of int
        Coordinates of the pads that have a film.
    """
    inner = whole[np.ix_(loaded, loaded)]
    follow = np.vstack([np.eye(2), -np.linalg.solve(inner, whole[loaded, :2])])
    push = np.hstack([np.eye(2), -np.linalg.solve(inner.T, whole[:2, loaded].T).T])
    return follow, push, [0, 1, *loaded]
