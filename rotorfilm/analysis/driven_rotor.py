"""A rotor that turns once per orbit, as its journals feel it: any bearings, and a shaft of any kind."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Any, NamedTuple

import numpy as np

from ..core.model import Array
from ..core.port import Bearings, amplitude_ratio, clearance_of, static_force, static_slopes
from ..rotors import RigidRotor
from ..rotors.structure import Structure
from .coefficients import film_coefficients
from .compiled_rotor import Complex
from .equilibrium import equilibrium
from .harmonic_balance import Balance, JournalPairs, Receptance, basis, first_wave, with_wave
from .rotor_equilibrium import RotorEquilibrium
from .rotor_matrices import second_order, with_hysteresis

# With K0 and C0, the films' stiffness and damping at rest, and the displacements p of all journals,
#
#     p = R * (F(p, p') + K0 p + C0 p') + e,
#
# where R answers each harmonic by the dynamic stiffness of shaft, K0 and C0 together, and e answers weight
# and unbalance. What stands in the brackets varies over a turn only as far as the films are not linear.


class RotorAnswers(NamedTuple):
    """What a rotor on K0 and C0 answers over a turn.

    Attributes
    ----------
    stations : tuple of str
    speed : float [rad/s]
        Signed.
    journals : ndarray of complex, shape (H + 1, 2 m, 2 m)
        Displacement of the m journals per force on them.
    external : ndarray of complex, shape (2, 2 m)
        The same under weight, and under the unbalance in the first harmonic.
    probes : dict of str to (ndarray, ndarray), shapes (2, 2 m) and (2,)
        Displacement of each probe in the first harmonic per force on the journals, and under the unbalance.
    stiffness, damping : ndarray, shape (m, 2, 2)
        K0 and C0 of each bearing.
    """

    stations: tuple[str, ...]
    speed: float
    journals: Complex
    external: Complex
    probes: dict[str, tuple[Complex, Complex]]
    stiffness: Array
    damping: Array

    @property
    def harmonics(self) -> int:
        """Those that are known."""
        return len(self.journals) - 1

    @property
    def samples(self) -> int:
        """Samples over a turn that these harmonics stand for."""
        return 2 * self.harmonics + 1

    def on(self, bearings: Bearings, sloped: Bearings | None = None) -> Balance[DrivenRotor]:
        """Return the equations of the orbit on these bearings, their slopes those of others where given."""
        rotor = DrivenRotor(self, bearings, bearings if sloped is None else sloped)
        return Balance(rotor=rotor, harmonics=self.harmonics, periods=1, collocated=True)

    def linear_orbit(self, rest: Array) -> Array:
        """Return the orbit about a rest (2 m,) [m] by K0 and C0 alone."""
        return with_wave(rest, self.external[1], self.harmonics)

    def on_springs(self, wave: Complex) -> Complex:
        """Return K0 + i w C0 times first harmonics (2 m, ...) of the displacements."""
        springs = self.stiffness + 1j * abs(self.speed) * self.damping
        pairs = wave.reshape(len(springs), 2, -1)
        return np.asarray((springs @ pairs).reshape(wave.shape))

    def excess(self, orbit: Array) -> Complex:
        """Return the first harmonic (2 m,) [N] of F + K0 p + C0 p' that an orbit needs."""
        return np.asarray(np.linalg.solve(self.journals[1], first_wave(orbit) - self.external[1]))

    def film_wave(self, orbit: Array) -> Complex:
        """Return the first harmonic (2 m,) [N] of the forces on the journals that an orbit needs."""
        return self.excess(orbit) - self.on_springs(first_wave(orbit))


def rotor_answers(
    structure: Structure, at: RotorEquilibrium, probes: Sequence[str], samples: int
) -> RotorAnswers:
    """Return what a rotor answers about an equilibrium, at the harmonics of an odd number of samples."""
    speed, rows = at.speed, structure.journals
    system, turn = second_order(structure, at), abs(at.speed)
    # (cos, sin) of the angle are the real parts of (1, -i) exp(i w t); turning backward mirrors it.
    turning = speed**2 * structure.unbalance @ np.array([1.0, -1.0j * np.sign(speed)])
    answers, external, seen = [], np.zeros((2, len(rows)), dtype=complex), {}
    own = {signal.name: row[: len(structure.weight)] for signal, row in structure.readouts}
    for k in range(samples // 2 + 1):
        whole = with_hysteresis(structure, system, k * turn, speed).dynamic_stiffness(k * turn)
        load = structure.weight if k == 0 else turning
        moved = np.linalg.solve(whole, np.column_stack([rows.T, load]) if k < 2 else rows.T)
        answers.append(rows @ moved[:, : len(rows)])
        if k < 2:
            # Weight is in balance with the films at rest, to which K0 adds its own.
            external[k] = rows @ moved[:, -1]
        if k == 1:
            for name in probes:
                pair = np.array([own[f"{name}_x"], own[f"{name}_y"]]) @ moved
                seen[name] = pair[:, :-1], pair[:, -1]
    films = [at.coefficients[name] for name in structure.stations]
    return RotorAnswers(
        stations=structure.stations,
        speed=speed,
        journals=np.array(answers),
        external=external,
        probes=seen,
        stiffness=np.array([film.stiffness for film in films]),
        damping=np.array([film.damping for film in films]),
    )


@dataclass(frozen=True)
class DrivenRotor(JournalPairs):
    """A rotor on its bearings as the equations of a driven orbit see it.

    Attributes
    ----------
    answers : RotorAnswers
        Answers of the rotor.
    bearings, sloped : mapping of str to Any
        By station: whose forces, and whose slopes.
    """

    answers: RotorAnswers
    bearings: Bearings
    sloped: Bearings

    @property
    def clearances(self) -> Array:
        """Of the bearings, shape (n_bearings,) [m]; infinite where there is none."""
        return np.array([clearance_of(self.bearings[name]) for name in self.answers.stations])

    @property
    def speed(self) -> float:
        """Angular speed of the shaft [rad/s]."""
        return self.answers.speed

    def receptance(self, harmonics: int, frequency: float) -> Receptance:
        """Return what the journals answer at the frequency of the shaft."""
        return self.answers.journals, None

    def external(self, harmonics: int, periods: int, frequency: float) -> Array:
        """Return the series of the answer to weight and unbalance."""
        rest, wave = self.answers.external
        return with_wave(rest.real, wave, harmonics)

    def forces(self, position: Array, velocity: Array) -> Array:
        """Return the forces of the bearings, those of K0 and C0 added."""
        forces = [
            static_force(self.bearings[name], *motion) for name, motion in self._motions(position, velocity)
        ]
        stiffness, damping = self.answers.stiffness, self.answers.damping
        springs = stiffness @ _by_bearing(position) + damping @ _by_bearing(velocity)
        return np.concatenate(forces) + springs.reshape(position.shape)

    def tangents(self, position: Array, velocity: Array) -> tuple[Array, Array, Array]:
        """Return the forces and their slopes."""
        slopes = np.concatenate(
            [static_slopes(self.sloped[name], *motion) for name, motion in self._motions(position, velocity)]
        )
        stiffness, damping = (
            part.reshape(-1, 2, 1) for part in (self.answers.stiffness, self.answers.damping)
        )
        force = self.forces(position, velocity)
        return force, slopes[:, :2] + stiffness, slopes[:, 2:4] + damping

    def _motions(self, position: Array, velocity: Array) -> list[tuple[str, tuple[Array, Array, Array]]]:
        """Return position, velocity and speed of each journal, by station."""
        speeds = np.full(position.shape[1], self.speed)
        pairs = zip(self.answers.stations, _by_bearing(position), _by_bearing(velocity), strict=True)
        return [(name, (p, v, speeds)) for name, p, v in pairs]

    def loaded(self, part: float) -> DrivenRotor:
        """Return the same under a part of the unbalance."""
        external = self.answers.external * np.array([[1.0], [part]])
        return replace(self, answers=self.answers._replace(external=external))


def rest_position(at: RotorEquilibrium, stations: Sequence[str]) -> Array:
    """Return the positions of the journals at rest, shape (2 m,) [m]."""
    return np.concatenate([at.coefficients[name].position for name in stations])


def rest_on_film(rotor: RigidRotor, bearing: Any) -> RotorEquilibrium:
    """Return where a rigid rotor at constant speed rests in its bearing, with stiffness and damping there."""
    speed, load = rotor.profile.speeds[0], rotor.static_load
    at = equilibrium(bearing, load, speed)
    return RotorEquilibrium(
        speed=speed,
        coefficients={"": film_coefficients(bearing, at.position, speed)},
        loads={"": load},
        displacement=at.position,
        residual=at.residual,
    )


def distance(balance: Balance[DrivenRotor], others: Bearings, orbit: Array) -> Array:
    """Return how much the forces of other bearings than its own change an orbit [m], to first order."""
    rotor = balance.rotor
    other = rotor.answers.on(others, sloped=rotor.sloped).residual(orbit, balance.frequency)
    missing = other.values - balance.values(orbit, balance.frequency)
    return balance.in_length(np.asarray(np.linalg.solve(other.by_series, -missing)))


def propagated(balance: Balance[DrivenRotor], orbit: Array, own: Bearings | None) -> tuple[Array, Array]:
    """Return the change of an orbit that makes up for what it lacks, by two slopes.

    The slopes of the balance's own, and those of other bearings along the orbit, or K0 and C0 where none are
    given.
    """
    at = balance.residual(orbit, balance.frequency)
    step = np.asarray(np.linalg.solve(at.by_series, -at.values))
    other = -at.values
    if own is not None:
        slopes = balance.rotor.answers.on(own).residual(orbit, balance.frequency).by_series
        other = np.asarray(np.linalg.solve(slopes, -at.values))
    return balance.in_length(step), balance.in_length(other)


def orbit_amplitude_ratio(orbit: Array, stations: Sequence[str], bearings: Bearings) -> float:
    """Return how far the journals go towards contact at the samples; see `amplitude_ratio`."""
    position = orbit @ basis(orbit.shape[1] // 2, orbit.shape[1]).values.T
    return max(
        amplitude_ratio(bearings[name], position[2 * k : 2 * k + 2]) for k, name in enumerate(stations)
    )


def _by_bearing(rows: Array) -> Array:
    """Return (2 m, n) as (m, 2, n)."""
    return rows.reshape(-1, 2, rows.shape[1])
