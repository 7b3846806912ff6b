"""What is asked about an orbit that an unbalance makes: amplitude, phase or force, and where."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from ..linear import RotorEquilibrium
from ..model import Array
from ..motion.periodic.driven_rotor import RotorAnswers
from ..motion.periodic.harmonics import Complex, circles, first_wave

AMPLITUDE, PHASE, FORCE = "unbalance_amplitude", "unbalance_phase", "unbalance_force"
UNITS = {AMPLITUDE: "m", PHASE: "rad", FORCE: "N"}
"""Quantities of an orbit and their units."""

WALL = 0.999
"""Distance from the center / clearance from which a journal touches."""


@dataclass(frozen=True, kw_only=True)
class SolvedTurn:
    """A solved orbit, as its estimate and a higher rung start from it.

    Attributes
    ----------
    at : RotorEquilibrium
        The rotor at rest, about which its films are linearized.
    answers : RotorAnswers
        What the rotor answers to forces on its journals over a turn.
    orbit : ndarray, shape (2 m, 2 H + 1) [m]
        Series of the journals over a turn.
    """

    at: RotorEquilibrium
    answers: RotorAnswers
    orbit: Array


@dataclass(frozen=True, kw_only=True)
class OrbitPlace:
    """What is asked about an orbit.

    Attributes
    ----------
    quantity : str
        A key of `UNITS`.
    places : tuple of str
        Bearings and probes among which the largest counts.
    reference : float [rad]
        Angle of the unbalance from which a phase counts.
    probes : tuple of str
        Those of the places that are probes.
    """

    quantity: str
    places: tuple[str, ...]
    reference: float
    probes: tuple[str, ...] = ()

    def value(self, answers: RotorAnswers, orbit: Array) -> float:
        """Return the quantity of an orbit, from its first harmonic."""
        places = self.places[:1] if self.quantity == PHASE else self.places
        waves = (self._wave(answers, orbit, name) for name in places)
        return max(wave_value(self.quantity, wave, answers.speed, self.reference) for wave in waves)

    def _wave(self, answers: RotorAnswers, orbit: Array, name: str) -> Complex:
        if name in self.probes:
            by_force, by_unbalance = answers.probes[name]
            return np.asarray(by_force @ answers.excess(orbit) + by_unbalance)
        wave = answers.film_wave(orbit) if self.quantity == FORCE else first_wave(orbit)
        k = answers.stations.index(name)
        return wave[2 * k : 2 * k + 2]

    def largest_change(self, answers: RotorAnswers, orbit: Array, forces: Array) -> float:
        """Return the most that first harmonics of forces on the journals (2 m,) [N] change the quantity by.

        Relative, or of a phase in radians: the phase of each force is the worst.
        """
        moved = answers.journals[1]
        if self.quantity == FORCE:
            moved = np.eye(len(moved)) - answers.on_springs(moved)
        changes = []
        for name in self.places:
            if name in self.probes:
                rows = answers.probes[name][0]
            else:
                k = answers.stations.index(name)
                rows = moved[2 * k : 2 * k + 2]
            changes.append(float(np.linalg.norm(np.abs(rows) @ forces)))
        if self.quantity != PHASE:
            return max(changes) / abs(self.value(answers, orbit))
        with_it, against = circles(self._wave(answers, orbit, self.places[0]))
        # half of the sum of x and +-i y
        return changes[0] / math.sqrt(2.0) / abs(with_it if answers.speed > 0.0 else against)

    def change(self, before: float, after: float) -> float:
        """Return the relative distance of two values; of phases in radians."""
        return wave_change(self.quantity, before, after)


def wave_value(quantity: str, wave: Complex, speed: float, reference: float) -> float:
    """Return the quantity of a first harmonic (2,) at a signed speed; a phase from a reference [rad] on."""
    with_it, against = circles(wave)
    if quantity != PHASE:
        return float(abs(with_it) + abs(against))
    turn = np.angle(with_it) if speed > 0.0 else np.angle(against)
    return math.remainder(float(turn) - reference, 2.0 * math.pi)


def wave_change(quantity: str, before: float, after: float) -> float:
    """Return the relative distance of two values; of phases in radians."""
    if quantity == PHASE:
        return abs(math.remainder(after - before, 2.0 * math.pi))
    return abs(after - before) / abs(after)
