"""The first forward whirl of a rotor, followed as cross-coupled stiffness is applied to it."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, replace
from functools import cached_property
from typing import NamedTuple

import numpy as np
from scipy import sparse

from ...errors import AbsentError, ConvergenceError
from ...model import Array, Reaction
from ...results import Coefficients
from ...rotors import ShaftRotor, Station
from ...warming import RestingStates
from ..coefficients import coefficients
from ..large.banded import BandedFactor, DenseFactor
from ..large.condensed import exact_structure
from ..large.inverse_iteration import dynamics, whirl_near
from ..large.second_order import journal_rows, motion_near, second_order
from ..rotor_modes import Motions, log_decrement, motions_about, oscillates
from ..rotor_rest import RotorEquilibrium, rotor_equilibrium

PEAKED = 2.0 * math.pi
"""Logarithmic decrement from which on a whirl has no resonance (damping ratio 1 / sqrt 2)."""

PROBE = 1e-5
"""Cross-coupling / stiffness of the rotor where it acts, at which forward and backward are told apart."""

STEP = 0.03
"""Largest change of an eigenvalue in a step, as a part of it."""

_STEPS = 1000


class ForwardWhirl(NamedTuple):
    """A whirl under an applied cross-coupling.

    Attributes
    ----------
    cross_coupling : float [N/m]
    value : complex [1/s]
        Its eigenvalue.
    shape : ndarray of complex, shape (N,)
    rate : complex [m/(N s)]
        d value / d cross_coupling.
    """

    cross_coupling: float
    value: complex
    shape: np.ndarray
    rate: complex

    @property
    def log_decrement(self) -> float:
        """Logarithm of the ratio of two successive amplitudes [1]."""
        return float(log_decrement(self.value))


@dataclass(frozen=True, kw_only=True)
class CrossCoupledRotor:
    """A rotor at rest in its bearings, to whose nodes cross-coupling is applied.

    Parameters
    ----------
    rotor : ShaftRotor
        With a station for each node where it acts.
    at : RotorEquilibrium
        Without it.
    shares : dict of str to float [1]
        Part of the cross-coupling, by these stations.
    """

    rotor: ShaftRotor
    at: RotorEquilibrium
    shares: Mapping[str, float]

    @cached_property
    def first(self) -> ForwardWhirl:
        """The first forward whirl without cross-coupling; AbsentError if there is none."""
        size = PROBE * self._stiffness
        motions = motions_about(self.rotor, self.under(size))
        swings = np.flatnonzero(oscillates(motions.eigenvalues) & (motions.direction > 0.0))
        chosen = swings[log_decrement(motions.eigenvalues[swings]) < PEAKED]
        if not chosen.size:
            raise AbsentError(
                f"rotor must have a forward whirl with a resonance at {self.at.speed:.6g} rad/s, and has none"
            )
        k = chosen[0]
        return self._whirl(0.0, complex(motions.eigenvalues[k]), motions.shapes[:, k])

    @cached_property
    def _stiffness(self) -> float:
        """Smallest static stiffness [N/m] of the rotor on its bearings, where cross-coupling acts."""
        exact = exact_structure(self.rotor)
        held = second_order(exact, self.at).stiffness
        factor = BandedFactor(held) if sparse.issparse(held) else DenseFactor(held)
        rows = [journal_rows(exact, name) for name in self.shares]
        return 1.0 / max(float(np.linalg.norm(pair @ factor.solve(pair.T), 2)) for pair in rows)

    def under(self, cross_coupling: float) -> RotorEquilibrium:
        """Return the rest with a cross-coupling [N/m] that drives whirl in the sense of the rotation."""
        turned = cross_coupling * math.copysign(1.0, self.at.speed) * _TURN
        added = {
            name: Coefficients(
                stiffness=share * turned,
                damping=np.zeros((2, 2)),
                position=np.zeros(2),
                speed=self.at.speed,
            )
            for name, share in self.shares.items()
        }
        return replace(self.at, coefficients={**self.at.coefficients, **added})

    def motions(self, cross_coupling: float) -> Motions:
        """Return all motions under a cross-coupling [N/m]."""
        return motions_about(self.rotor, self.under(cross_coupling))

    def followed(self, whirl: ForwardWhirl, cross_coupling: float) -> ForwardWhirl:
        """Return what becomes of a whirl under another cross-coupling [N/m], in steps small enough.

        Raises
        ------
        ConvergenceError
            If it is lost.
        """
        for _ in range(_STEPS):
            left = cross_coupling - whirl.cross_coupling
            most = STEP * abs(whirl.value) / max(abs(whirl.rate), 1e-300)
            step = float(np.clip(left, -most, most))
            ahead = whirl.value + whirl.rate * step
            whirl = self._whirl(whirl.cross_coupling + step, ahead, whirl.shape)
            if step == left:
                return whirl._replace(cross_coupling=cross_coupling)
        raise ConvergenceError(f"whirl must be followed to {cross_coupling:.6g} N/m, and was not")

    def _whirl(self, cross_coupling: float, value: complex, shape: np.ndarray) -> ForwardWhirl:
        """Return the whirl under a cross-coupling next to a value and a shape."""
        exact, at = exact_structure(self.rotor), self.under(cross_coupling)
        frequency = abs(value.imag)
        found, right, left = whirl_near(exact, at, frequency, value, shape)
        _, slope = dynamics(motion_near(exact, at, frequency)(found), found)
        driven = self.under(1.0).coefficients
        pushed = sum(
            (rows @ left).conj() @ driven[name].stiffness @ (rows @ right)
            for name, rows in ((name, journal_rows(exact, name)) for name in self.shares)
        )
        rate = -pushed / (left.conj() @ (slope @ right))
        return ForwardWhirl(cross_coupling, found, right, complex(rate))


_TURN: Array = np.array([[0.0, 1.0], [-1.0, 0.0]])
"""Stiffness whose force on x + i y is i times it: along the whirl with the rotation."""


def cross_coupled(
    rotor: ShaftRotor, bearings: Mapping[str, Reaction], speed: float, nodes: Mapping[int, float]
) -> CrossCoupledRotor:
    """Return a rotor at rest, with a station at each node for its part of a cross-coupling."""
    names = {node: f"cross_coupling_{node}" for node in nodes}
    added = tuple(Station(node=node, name=name) for node, name in names.items())
    excited = replace(rotor, stations=(*rotor.stations, *added))
    at = rotor_equilibrium(excited, bearings, speed)
    # The standard wants K and C of tilting pads, and of what else follows, at the frequency of the shaft.
    synchronous = {
        name: coefficients(bearing, at.coefficients[name].position, speed, abs(speed))
        for name, bearing in bearings.items()
        if isinstance(bearing, RestingStates)
    }
    at = replace(at, coefficients={**at.coefficients, **synchronous})
    return CrossCoupledRotor(
        rotor=excited, at=at, shares={names[node]: share for node, share in nodes.items()}
    )
