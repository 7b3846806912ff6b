"""A rotor on reactions of any motions and states, as the equations of a periodic orbit see it.

Let v be the places and states of all reactions and z the state of rotor and reactions together, v = S z.
Reactions answer g(v, v'), forces and rates of their states, with derivatives G, H by v and v' at rest. Then

    z' = A z + P (g - G v - H v') + w(t),

where A is the matrix of small motion about the rest and w has weight and unbalance. Harmonic k of v answers
what stands in the brackets by S (i k nu - A)^-1 P. Floquet multipliers are those of
z' = (A + P (dG S + dH S')) z with the change dG, dH of the derivatives along the orbit.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import cached_property, lru_cache
from itertools import pairwise
from typing import Any, NamedTuple

import numpy as np
from scipy.linalg import matrix_balance

from ..core.dynamic_stiffness import rest_state
from ..core.errors import ConvergenceError, InputError, require_inside
from ..core.model import Array
from ..core.port import clearance_of, freedoms_of, inertial, minimum_film, static_force, static_slopes
from ..core.signals import PLANAR
from ..rotors import FlexibleRotor, MountedRotor, RigidRotor, mount
from ..rotors.mounted import Mount
from ..rotors.structure import NOMINAL_LENGTH, MatrixRotor, station_name
from .collocation import STAGES, ModalArrays, StepTable, radau_scheme
from .compiled_rotor import LARGEST_CONDITION, Complex, modes
from .equilibrium import equilibrium
from .force_calls import film_samples
from .harmonic_balance import Receptance, at_start, series_rows, with_wave
from .modal_reduction import Condensed
from .rotor_equilibrium import rotor_equilibrium
from .whole_shaft import InShapes, WholeShaft, slow_multipliers

STEPS_PER_HARMONIC, LEAST_STEPS = 2, 64
"""Steps of the monodromy matrix."""

LARGEST_DRIFT = 1e13
"""Condition of the balanced matrix of small motion from which on something counts as free to drift.

Of shafts of 50 elements on warming films it is 5e9, without a thrust bearing 4e16 and more.
"""


class LinearizedRotor(NamedTuple):
    """Rotor and reactions about their rest.

    Attributes
    ----------
    rest : ndarray, shape (Z,)
        The state there.
    matrix : ndarray, shape (Z, Z)
        A.
    push : ndarray, shape (Z, rows)
        P.
    sense, rates : ndarray, shape (rows, Z)
        S, and the rows of the rates of places; zero for states.
    held : ndarray, shape (Z,)
        The constant part of w: weight.
    turning : ndarray of complex, shape (Z,)
        w of the unbalance is the real part of turning exp(i |speed| t).
    by_row, by_rate : ndarray, shape (rows, widest)
        G and H, of each row by those of its own reaction.
    """

    rest: Array
    matrix: Array
    push: Array
    sense: Array
    rates: Array
    held: Array
    turning: Complex
    by_row: Array
    by_rate: Array


@dataclass(frozen=True, eq=False)
class PortRotor(InShapes):
    """A rotor at constant speed in reactions of any freedoms, with states or without.

    Attributes
    ----------
    mounted : MountedRotor
        All its bearings mounted in one step.
    speed : float [rad/s]
    unbalanced : float [1]
        Part of the unbalance.
    model : Condensed, optional
        The shapes that it moves in, where these are not all; then its bearings react to x and y only.
    """

    mounted: MountedRotor
    speed: float
    unbalanced: float = 1.0
    model: Condensed | None = None

    @classmethod
    def of(cls, mounted: MountedRotor, model: Condensed | None = None) -> PortRotor:
        """Return a mounted rotor, in the shapes of a model if one is given.

        Raises
        ------
        InputError
            If the rotor has no constant speed or hysteresis, or a bearing an added mass.
        ConvergenceError
            If something drifts from the rest.
        """
        bare, bearings = mounted.bare, mounted.all_bearings
        if not isinstance(bare, RigidRotor | FlexibleRotor):
            raise InputError(f"rotor must be a RigidRotor or a FlexibleRotor on still ground, got {bare!r}")
        assembly = bare.assembly if isinstance(bare, FlexibleRotor) else bare.structure
        if assembly.hysteresis is not None:
            raise InputError("loss_factor must be 0 in large motion, where hysteresis is not a force")
        if len(set(bare.profile.speeds)) != 1:
            raise InputError(f"speed must be constant, got a profile over {bare.profile.times!r} s")
        for name, bearing in bearings.items():
            if inertial(bearing) is not None:
                raise InputError(
                    f"bearings[{name!r}] must have no added mass on a periodic orbit, got {bearing!r}"
                )
        moving = MatrixRotor(bare, model.structure) if isinstance(bare, FlexibleRotor) and model else bare
        found = cls(mount(moving, bearings), float(bare.profile.speeds[0]), model=model)
        found.require_held()
        return found

    @cached_property
    def mounts(self) -> Sequence[Mount]:
        """The reactions in their stations."""
        return self.mounted.mounts

    @cached_property
    def blocks(self) -> list[slice]:
        """The rows of each reaction: its places, then its states."""
        ends = np.cumsum([0, *(m.size + len(m.reaction.states) for m in self.mounts)])
        return [slice(int(a), int(b)) for a, b in pairwise(ends)]

    @cached_property
    def units(self) -> Array:
        """Nominal value of each row, shape (rows,)."""
        signals = [(*m.reaction.inputs[: m.size], *m.reaction.states) for m in self.mounts]
        return np.array([signal.nominal for own in signals for signal in own])

    @property
    def names(self) -> tuple[str, ...]:
        """The stations of the bearings."""
        return tuple(m.station for m in self.mounts)

    @property
    def lengths(self) -> Array:
        """Clearance of each bearing, shape (n_bearings,) [m]; a nominal length without one."""
        sizes = [clearance_of(m.reaction) for m in self.mounts]
        return np.array([size if math.isfinite(size) else NOMINAL_LENGTH for size in sizes])

    def gaps(self, position: Array) -> Array:
        """Return the film left at samples, shape (n_bearings, samples) [m]; inf where nothing touches."""
        parts = zip(self.mounts, self.blocks, strict=True)
        return np.stack([minimum_film(m.reaction, position[b][: m.size]) for m, b in parts])

    @cached_property
    def small(self) -> LinearizedRotor:
        """Small motion about the rest."""
        rotor, mounts = self.mounted.rotor, self.mounts
        rest = self._rest()
        size, count, rows = len(rotor.states), len(rest), len(self.units)
        own = rotor.linearization(0.0, rest[:size], np.zeros(len(rotor.inputs)))
        push, sense, rates = np.zeros((count, rows)), np.zeros((rows, count)), np.zeros((rows, count))
        for m, block in zip(mounts, self.blocks, strict=True):
            places, states = range(block.start, block.start + m.size), range(block.start + m.size, block.stop)
            push[:size, places] = own.B[:, m.force]
            sense[places, :size] = own.C[m.motion[: m.size]]
            rates[places, :size] = own.C[m.motion[m.size : 2 * m.size]]
            push[range(m.inner.start, m.inner.stop), states] = 1.0
            sense[states, range(m.inner.start, m.inner.stop)] = 1.0
        by_row, by_rate = self._slopes((sense @ rest)[:, None], np.zeros((rows, 1)))
        springs, dampers = (self._square(part)[0] for part in (by_row, by_rate))
        matrix = push @ (springs @ sense + dampers @ rates)
        matrix[:size, :size] += own.A
        held, turning = self._drive(size)
        behind = np.zeros(count - size)
        return LinearizedRotor(
            rest,
            matrix,
            push,
            sense,
            rates,
            np.concatenate([held, behind]),
            np.concatenate([turning, behind]),
            by_row[..., 0],
            by_rate[..., 0],
        )

    def _drive(self, size: int) -> tuple[Array, Complex]:
        """Return what weight and unbalance add to the rates of the rotor's state."""
        rotor = self.mounted.rotor
        still, none = np.zeros(size), np.zeros(len(rotor.inputs))
        if self.speed == 0.0:
            return rotor.derivative(0.0, still, none), np.zeros(size, dtype=complex)
        quarter = 0.5 * np.pi / abs(self.speed)
        first, second, third = (rotor.derivative(k * quarter, still, none) for k in range(3))
        held = 0.5 * (first + third)
        return held, (first - held) - 1j * (second - held)

    def _rest(self) -> Array:
        """Return the state at rest."""
        rotor: Any
        rotor, speed = self.mounted.rotor, self.speed
        bearings = self.mounted.all_bearings
        if isinstance(rotor, RigidRotor):
            found = equilibrium(next(iter(bearings.values())), rotor.static_load, speed).position
        else:
            found = rotor_equilibrium(rotor, bearings, speed).displacement
        state = np.concatenate([found, np.zeros(len(rotor.states) - len(found))])
        sensed = rotor.output(0.0, state, np.zeros(len(rotor.inputs)))
        states = [rest_state(m.reaction, sensed[m.motion[: m.size]], speed) for m in self.mounts]
        return np.concatenate([state, *states])

    @property
    def is_driven(self) -> bool:
        """Whether it turns with an unbalance."""
        return bool(np.any(self.small.turning))

    def guess(self) -> Array:
        """Return the rows at rest, shape (rows,)."""
        return self.small.sense @ self.small.rest

    def receptance(self, harmonics: int, frequency: float) -> Receptance:
        """Return what the rows answer, at any frequency."""
        return self._known(harmonics, frequency)

    @cached_property
    def _known(self) -> Callable[[int, float], Receptance]:
        """The answers, kept: all steps towards one orbit ask for the same."""
        return lru_cache(maxsize=4)(self._answers)

    def _answers(self, harmonics: int, frequency: float) -> Receptance:
        small, answers, rates = self.small, [], []
        for k in range(harmonics + 1):
            moved = self._solved(1j * k * frequency, small.push)
            answers.append(small.sense @ moved)
            rates.append(-1j * k * (small.sense @ self._solved(1j * k * frequency, moved)))
        return np.array(answers), np.array(rates)

    def _solved(self, s: complex, right: Array) -> Complex:
        """Return (s - A)^-1 right."""
        return np.linalg.solve(s * np.eye(len(self.small.matrix)) - self.small.matrix, right)

    def require_held(self) -> None:
        """Raise ConvergenceError where a motion of the shaft or a state of a bearing drifts from its rest."""
        balanced, _ = matrix_balance(self.small.matrix, permute=False)
        if not np.linalg.cond(balanced) < LARGEST_DRIFT:
            raise ConvergenceError(
                "rotor and bearings must have an equilibrium for a periodic orbit, but a motion of the "
                "shaft or a state of a bearing drifts: a bush wears, or no thrust bearing holds the shaft"
            )

    @cached_property
    def _scale(self) -> Array:
        """Sizes of the states: rates by the speed, states of bearings by their nominal values."""
        nominal = [s.nominal / NOMINAL_LENGTH for m in self.mounts for s in m.reaction.states]
        half = len(self.mounted.rotor.states) // 2
        return np.array([*np.repeat([1.0, abs(self.speed) or 1.0], half), *nominal])

    def external(self, harmonics: int, periods: int, frequency: float) -> Array:
        """Return the series of the answer to weight, and to the unbalance if `periods` is not 0."""
        small = self.small
        rest, wave = (
            (small.sense @ self._solved(0.0, small.held)).real,
            np.zeros(len(self.units), dtype=complex),
        )
        if periods:
            wave = small.sense @ self._solved(1j * periods * frequency, self.unbalanced * small.turning)
        return with_wave(rest, wave, harmonics, max(1, periods))

    def loaded(self, part: float) -> PortRotor:
        """Return the same under a part of the unbalance."""
        found = PortRotor(self.mounted, self.speed, part, self.model)
        found.__dict__.update(
            {key: self.__dict__[key] for key in ("small", "_known") if key in self.__dict__}
        )
        return found

    def forces(self, position: Array, velocity: Array) -> Array:
        """Return g - G v - H v', (rows, samples)."""
        parts = zip(self.mounts, self.blocks, strict=True)
        found = np.concatenate([self._answer(m, position[b], velocity[b]) for m, b in parts])
        springs, dampers = (
            self._square(part[..., None])[0] for part in (self.small.by_row, self.small.by_rate)
        )
        return found - springs @ position - dampers @ velocity

    def tangents(self, position: Array, velocity: Array) -> tuple[Array, Array, Array]:
        """Return the same and its slopes by the rows of each reaction, (rows, widest, samples) each."""
        by_row, by_rate = self._slopes(position, velocity)
        small = self.small
        force = self.forces(position, velocity)
        return force, by_row - small.by_row[..., None], by_rate - small.by_rate[..., None]

    def _answer(self, m: Mount, position: Array, velocity: Array) -> Array:
        """Return forces and rates of states of one reaction at samples."""
        self._require_inside(m, position)
        n = m.size
        if not m.reaction.states:
            return static_force(m.reaction, position, velocity, np.full(position.shape[1], self.speed))
        in_c = film_samples(m.reaction, np.vstack([position[:n], velocity[:n], position[n:]]), self.speed)
        if in_c is not None:
            return in_c[0]
        found, model = [], m.reaction
        for q, v in zip(position.T, velocity.T, strict=True):
            u = np.array([*q[:n], *v[:n], self.speed])
            force = model.output(0.0, q[n:], u)[:n]
            found.append(np.concatenate([force, model.derivative(0.0, q[n:], u)]))  # type: ignore[attr-defined]
        return np.array(found).T

    def _require_inside(self, m: Mount, position: Array) -> None:
        if m.clearance < np.inf:
            worst = int(np.argmax(np.hypot(position[0], position[1])))
            require_inside(position[:2, worst], m.clearance, " on the orbit")

    def _slopes(self, position: Array, velocity: Array) -> tuple[Array, Array]:
        """Return the derivatives of g by the rows and by their rates, (rows, widest, samples) each."""
        samples, widest = position.shape[1], max(b.stop - b.start for b in self.blocks)
        by_row, by_rate = (np.zeros((len(position), widest, samples)) for _ in range(2))
        for m, block in zip(self.mounts, self.blocks, strict=True):
            n, q, v = m.size, position[block], velocity[block]
            if not m.reaction.states:
                self._require_inside(m, q)
                slopes = static_slopes(m.reaction, q, v, np.full(samples, self.speed))
                by_row[block, :n], by_rate[block, :n] = slopes[:, :n], slopes[:, n : 2 * n]
                continue
            in_c = film_samples(m.reaction, np.vstack([q[:n], v[:n], q[n:]]), self.speed)
            if in_c is not None:
                by_row[block, : len(q)] = np.delete(in_c[1], [2, 3, 4], axis=1)
                by_rate[block, :n] = in_c[1][:, 2:4]
                continue
            for k in range(samples):
                u = np.array([*q[:n, k], *v[:n, k], self.speed])
                A, B, C, D = m.reaction.linearization(0.0, q[n:, k], u)
                width = n + len(A)
                by_row[block, :width, k] = np.block([[D[:n, :n], C[:n]], [B[:, :n], A]])
                by_rate[block, :n, k] = np.vstack([D[:n, n : 2 * n], B[:, n : 2 * n]])
        return by_row, by_rate

    @cached_property
    def row_names(self) -> list[str]:
        """Names of the rows: `left_x`, `left_tilt_x`, and of the states."""
        own = [
            (m.station, [*freedoms_of(m.reaction), *(s.name for s in m.reaction.states)]) for m in self.mounts
        ]
        return [station_name(station, name) for station, names in own for name in names]

    def journal_series(self, series: Array) -> Array:
        """Return the series of x and y of each bearing, shape (n_bearings, 2, 2 H + 1) [m]."""
        rows = dict(zip(self.row_names, series, strict=True))
        still = np.zeros(series.shape[1])
        return np.array(
            [[rows.get(station_name(m.station, axis), still) for axis in PLANAR] for m in self.mounts]
        )

    def further(self, series: Array) -> dict[str, Array]:
        """Return the series of the other places and of the states, by their names."""
        planar = {station_name(m.station, axis) for m in self.mounts for axis in PLANAR}
        return {name: row for name, row in zip(self.row_names, series, strict=True) if name not in planar}

    def state(self, series: Array, frequency: float, periods: int) -> Array:
        """Return the state of rotor and bearings at phase 0 of an orbit."""
        if self.shaft is not None:
            shaft = self.shaft.state(series, frequency, periods, self.shaft_forces)
            now = series[:, : series.shape[1] // 2 + 1].sum(axis=1)
            return np.concatenate(
                [shaft, *(now[b][m.size :] for m, b in zip(self.mounts, self.blocks, strict=True))]
            )
        small = self.small

        def answer(k: int, force: Complex) -> Array:
            beside = 0.0 if k and k != periods else self.unbalanced * small.turning if k else small.held
            return self._solved(1j * k * frequency, small.push @ force + beside).real

        return np.asarray(at_start(series, frequency, self.forces, answer))

    @cached_property
    def shaft(self) -> WholeShaft | None:
        """All of the shaft, on springs about as stiff as its films; None where all of it moves."""
        if self.model is None or self.model.space is None:
            return None
        at_rest = self._stiffness_at(self._square(self.small.by_row[..., None])[0], None, 0.0)
        size = float(np.abs(at_rest).max()) or float(np.abs(self.model.whole.stiffness).max())
        spring = np.full(2 * len(self.names), size)
        damper = spring / (abs(self.speed) or 1.0)
        return WholeShaft(self.model, self.names, spring, damper, self.speed, self.unbalanced)

    def _stiffness_at(self, by_row: Array, by_rate: Array | None, frequency: float) -> Complex:
        """Return forces per displacement along x and y at a frequency, with the states that follow it."""
        found, s = [], 1j * frequency
        for b in self.blocks:
            whole = by_row[b, b] if by_rate is None else by_row[b, b] + s * by_rate[b, b]
            inner = np.linalg.solve(s * np.eye(len(whole) - 2) - by_row[b, b][2:, 2:], whole[2:, :2])
            found.append(whole[:2, :2] + by_row[b, b][:2, 2:] @ inner)
        return np.array(found)

    def shaft_forces(self, position: Array, velocity: Array) -> Array:
        """Return the forces on the journals with those that the springs of the shaft give back."""
        assert self.shaft is not None
        small, own = self.small, [k for b in self.blocks for k in (b.start, b.start + 1)]
        springs, dampers = (self._square(part[..., None])[0] for part in (small.by_row, small.by_rate))
        force = self.forces(position, velocity) + springs @ position + dampers @ velocity
        given = self.shaft.spring[:, None] * position[own] + self.shaft.damper[:, None] * velocity[own]
        return np.asarray(force[own] + given)

    def fast_films(self, position: Array, velocity: Array) -> tuple[Callable[[float], Complex], Complex]:
        """Return what the mean slopes over an orbit answer at a frequency, and the poles of that."""
        slopes = self._slopes(position, velocity)
        by_row, by_rate = (self._square(part).mean(axis=0) for part in slopes)
        poles = np.concatenate([np.linalg.eigvals(by_row[b, b][2:, 2:]) for b in self.blocks])
        return lambda w: self._stiffness_at(by_row, by_rate, w), poles.astype(complex)

    def multipliers(self, series: Array, frequency: float) -> Complex:
        """Return the Floquet multipliers, the largest first."""
        values, shapes, inverse, matrix = self._modes_and_monodromy(series, frequency, None)
        return slow_multipliers(matrix, self._scale, values, shapes, inverse, self.known_to)

    def monodromy(self, series: Array, frequency: float, steps: int | None = None) -> Array:
        """Return how a small change of the state is mapped over one period, shape (Z, Z)."""
        return self._modes_and_monodromy(series, frequency, steps)[3]

    def _modes_and_monodromy(
        self, series: Array, frequency: float, steps: int | None
    ) -> tuple[Complex, Complex, Complex, Array]:
        """Return the modes on the mean slopes: exponents, shapes and their inverse; and that matrix."""
        steps, phase = step_phases(series.shape[1] // 2, steps)
        values, slopes = series_rows(series.shape[1] // 2, phase)
        _, *both = self.tangents(series @ values.T, frequency * (series @ slopes.T))
        local = np.concatenate([self._square(part) for part in both], axis=2)
        small, mean = self.small, local.mean(axis=0)
        felt = np.vstack([small.sense, small.rates])
        step = 2.0 * np.pi / (frequency * steps)
        values, shapes, inverse, condition = modes(small.matrix + small.push @ mean @ felt, self._scale)
        if not condition < LARGEST_CONDITION:
            raise ConvergenceError(
                f"modes of rotor and bearings must be distinct, got a condition of {condition:.3g}"
            )
        push, sense = (np.ascontiguousarray(one) for one in (inverse @ small.push + 0j, felt @ shapes))
        arrays = ModalArrays(np.ascontiguousarray(values), push, sense)
        return values, shapes, inverse, carried_over(arrays, shapes, inverse, local - mean, step)

    def _square(self, slopes: Array) -> Array:
        """Return slopes (rows, widest, samples) by all rows, shape (samples, rows, rows)."""
        found = np.zeros((slopes.shape[2], len(slopes), len(slopes)))
        for b in self.blocks:
            found[:, b, b] = np.moveaxis(slopes[b, : b.stop - b.start], 2, 0)
        return found


# Floquet multipliers: the monodromy matrix, integrated with the slopes of the films.


def step_phases(harmonics: int, steps: int | None) -> tuple[int, Array]:
    """Return the number of steps, by default two a harmonic, and the phases of all their nodes."""
    steps = steps or max(LEAST_STEPS, STEPS_PER_HARMONIC * harmonics)
    nodes = radau_scheme(STAGES).nodes
    return steps, (2.0 * np.pi / steps * (np.arange(steps)[:, None] + nodes)).ravel()


def carried_over(rotor: ModalArrays, shapes: Complex, inverse: Complex, slopes: Array, step: float) -> Array:
    """Return how a small change of the state is mapped over all steps.

    The scheme is that of `simulate_rotor` (order 7), linear here: the rotor on the mean slopes of its films
    is exact, fast modes included, and over a step only what the films add to that is unknown.

    Parameters
    ----------
    rotor : ModalArrays
        Modes, their forces and what the films feel of them.
    shapes, inverse : ndarray of complex
        State per modal coordinate, and back.
    slopes : ndarray, shape (steps x stages, forces, felt)
        Change of the forces by what the films feel at the nodes of all steps.
    step : float [s]
    """
    table = StepTable.of_step(rotor, radau_scheme(STAGES), step)
    count, channels = len(rotor.values), slopes.shape[1]
    used = (np.arange(STAGES)[:, None] * rotor.push.shape[1] + np.arange(channels)).ravel()
    forced = table.forced[:count, used] + 1j * table.forced[count:, used]
    gain = np.moveaxis(table.gain[..., :channels], 1, 2).reshape(STAGES, -1, STAGES * channels)
    z, identity = inverse.astype(complex), np.eye(STAGES * channels)
    for local in slopes.reshape(-1, STAGES, *slopes.shape[1:]):
        moved = (table.move @ np.vstack([z.real, z.imag])).reshape(STAGES, -1, z.shape[1])
        right = (local @ moved).reshape(STAGES * channels, -1)
        matrix = (local @ gain).reshape(STAGES * channels, -1)
        z = table.keep[:, None] * z + forced @ np.linalg.solve(identity - matrix, right)
    return np.asarray((shapes @ z).real)
