"""Periodic orbits of a rotor on films: driven by its unbalance, or whirl at a frequency of its own."""

from __future__ import annotations

import math
from collections import Counter
from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from typing import Any, ClassVar, NamedTuple

import numpy as np
from numpy.typing import ArrayLike
from scipy import sparse

from ..core.errors import (
    ContactError,
    EquilibriumError,
    InputError,
    require_count,
    require_positive,
    require_vector,
)
from ..core.inputs import arguments
from ..core.model import Array
from ..core.port import (
    MOST_LEFT,
    Bearings,
    amplitude_ratio,
    clearance_of,
    freedoms_of,
    static_force,
    static_slopes,
    takes_steps,
)
from ..core.readable import Drawable, Readable
from ..core.results import Trajectory
from ..core.signals import PLANAR
from ..rotors import FlexibleRotor, MountedRotor, RigidRotor, mount
from ..rotors.structure import MatrixRotor, Structure, freedom_rows, station_name
from .coefficients import film_coefficients
from .compiled_march import LONGEST_TURN, March, ModalArrays
from .compiled_rotor import Complex, ModalRotor, Parts, journal_rows, modal_rotor, modes, take_apart
from .equilibrium import equilibrium
from .harmonic_balance import (
    CONVERGED,
    Balance,
    JournalPairs,
    ModalFilms,
    PeriodicRotor,
    Receptance,
    Solution,
    basis,
    constant,
    driven,
    end_of,
    film_forces,
    first_wave,
    lengthened,
    resized,
    series_rows,
    solve,
    subharmonic,
    truncation_of,
    with_wave,
)
from .modal_reduction import FEW, MARGIN, BandedMotion, Condensed, models
from .port_orbits import PortRotor, carried_over, step_phases
from .rotor_equilibrium import RotorEquilibrium, rotor_equilibrium
from .rotor_matrices import second_order, with_hysteresis
from .threads import one_blas_thread

HARMONICS = 8
"""Harmonics at first."""

TRUNCATION = 1e-7
"""Largest of the last harmonics / clearance at which a series is long enough."""

WHOLE = 3
"""Levels of shapes that are tried before the whole rotor."""

ABOVE = 4.0
"""Frequency to which shapes are kept / that of the level before; at first it is that of `HARMONICS`."""

BALANCED = 1e-3
"""Where the search for an orbit ends, in tolerances."""


@dataclass(frozen=True, kw_only=True, eq=False)
class PeriodicOrbit(Drawable):
    """A periodic orbit of a rotor on films.

    Attributes
    ----------
    frequency : float [rad/s]
        Angular frequency; speed / periods for an orbit that the unbalance drives.
    speed : float [rad/s]
    periods : int
        Turns of the shaft per orbit; 0 for whirl at a frequency of its own.
    stations : tuple of str
    lengths : ndarray, shape (n_bearings,) [m]
        Clearance of each bearing.
    series : ndarray, shape (n_bearings, 2, 2 H + 1) [m]
        Journal displacement x, y: mean, cosines, sines of the phase frequency * t.
    further : dict of str to ndarray, shape (2 H + 1,)
        Series of the other motions of the journals and of the states of bearings, by their names, as
        left_tilt_x [rad]; empty where bearings react to x and y only.
    state : ndarray, shape (n_states,)
        State of the whole rotor at t = 0.
    multipliers : ndarray of complex, shape (n_multipliers,)
        Floquet multipliers, the largest first; for free whirl one of them is 1. Empty without `stability`.
        A shaft of more than 24 coordinates has those of motion that its lower modes make, other rotors
        have one for each state.
    residual : float [1]
        Remaining imbalance of the equations / clearance, in all coordinates of the rotor.
    truncation : float [1]
        Largest of the last quarter of the harmonics / clearance: the truncation error.
    work : dict of str to int
        film_evaluations, iterations.
    """

    frequency: float
    speed: float
    periods: int
    stations: tuple[str, ...]
    lengths: Array
    series: Array
    further: dict[str, Array]
    state: Array
    multipliers: Complex
    residual: float
    truncation: float
    work: dict[str, int]

    _shown: ClassVar[tuple[str, ...]] = ("period", "amplitude")

    @property
    def period(self) -> float:
        """Duration of one orbit [s]."""
        return 2.0 * math.pi / self.frequency

    @property
    def harmonics(self) -> int:
        """Number of harmonics of the series."""
        return self.series.shape[-1] // 2

    def position(self, time: ArrayLike) -> Array:
        """Return x, y of each journal at times (n,) [s], shape (n_bearings, 2, n) [m]."""
        values, _ = series_rows(self.harmonics, self.frequency * np.atleast_1d(np.asarray(time, dtype=float)))
        return np.asarray(self.series @ values.T)

    @cached_property
    def eccentricity_ratios(self) -> Array:
        """Eccentricity ratio of each journal over the orbit, shape (n_bearings, 256)."""
        position = self.position(self.period * np.arange(256) / 256)
        return np.hypot(position[:, 0], position[:, 1]) / self.lengths[:, None]

    @property
    def amplitude(self) -> float:
        """Largest distance of a journal from its mean position / clearance [1]."""
        position = self.position(self.period * np.arange(256) / 256) - self.series[:, :, :1]
        return float((np.hypot(position[:, 0], position[:, 1]) / self.lengths[:, None]).max())

    @property
    def free_multipliers(self) -> Complex:
        """The multipliers without the one that is always 1, because the phase of free whirl is arbitrary."""
        if self.periods:
            return self.multipliers
        return np.delete(self.multipliers, int(np.argmin(np.abs(self.multipliers - 1.0))))

    @property
    def stable(self) -> bool:
        """Whether a small disturbance dies out; InputError where the multipliers were not computed."""
        if not self.multipliers.size:
            raise InputError("stability must be True for an orbit that knows whether it is stable")
        return bool(np.all(np.abs(self.free_multipliers) < 1.0))


@one_blas_thread
@arguments
def periodic_orbit(
    mounted: MountedRotor,
    *,
    start: PeriodicOrbit | Trajectory | None = None,
    periods: int = 1,
    tolerance: float = TRUNCATION,
    stability: bool = True,
) -> PeriodicOrbit:
    """Return a periodic orbit of a rotor on films, stable or not, and its Floquet multipliers.

    With unbalance the orbit repeats after `periods` turns of the shaft. Without it the orbit is whirl, whose
    frequency is found with it; it needs a start.

    Parameters
    ----------
    mounted : MountedRotor
        Mounted rotor from `mount`, at constant speed. Its bearings may react to any motions of the shaft and
        may have states, but no added mass. Bearings that react to x and y alone run in compiled loops.
    start : PeriodicOrbit or Trajectory, optional
        An orbit nearby, or a run of `simulate_rotor` that ends in one; by default small motion about the
        rest, which leads to the orbit of one turn.
    periods : int
        Turns of the shaft per orbit: 2 after a period doubling. The orbit of one turn solves these equations
        too, so that another one needs a start.
    tolerance : float [1]
        Harmonics are added until the last quarter of them is smaller than this, in clearances. The equations
        are solved to a thousandth of it.
    stability : bool
        Whether to compute the Floquet multipliers; without them the stability of the orbit is unknown.

    Raises
    ------
    InputError
        If an argument breaks its rule, or whirl has no start.
    ConvergenceError
        If no orbit is found, or something drifts where the rotor rests, as wear does.
    EquilibriumError
        If there is no rest.
    """
    require_count("periods", periods)
    require_positive("tolerance", tolerance)
    converged = max(CONVERGED, BALANCED * tolerance)
    for level in range(WHOLE + 1):
        found = _found(orbit_rotor(mounted, level), start, periods, converged)
        orbit = finished(lengthened(found, tolerance, converged), stability=stability)
        if orbit.residual <= tolerance:
            break
    return orbit


def _found(
    rotor: PeriodicRotor, start: PeriodicOrbit | Trajectory | None, periods: int, converged: float
) -> Solution[PeriodicRotor]:
    """Return the orbit of a rotor in its first harmonics."""
    if rotor.is_driven:
        return _driven(rotor, start, periods, converged)
    if start is None:
        raise InputError("start must be an orbit or a run that ends in whirl for a rotor without unbalance")
    series, frequency = _start_series(rotor, start, None)
    balance = Balance(rotor=rotor, harmonics=HARMONICS, periods=0)
    return solve(balance, resized(series, HARMONICS), frequency, converged)


def orbit_rotor(mounted: MountedRotor, level: int = 0) -> PeriodicRotor:
    """Return a rotor with its bearings as the equations of an orbit see it, in C where its bearings allow.

    It is in more of its shapes at a higher level, and whole at `WHOLE`.

    Raises
    ------
    InputError
        If the rotor has no orbits here: its speed must be constant, the ground still.
    """
    bare, bearings = mounted.bare, mounted.all_bearings.values()
    aside = isinstance(bare, FlexibleRotor) and bool(bare.assembly.others)
    if aside or any(freedoms_of(one) != PLANAR or (one.states and not takes_steps(one)) for one in bearings):
        return PortRotor.of(mounted)
    model = None
    if isinstance(bare, FlexibleRotor) and (model := _model(bare, level)) is not None:
        mounted = mount(MatrixRotor(bare, model.structure), mounted.all_bearings)
    parts = take_apart(mounted)
    return CompiledRotor(modal_rotor(parts, parts.speed), mounted, model)


def _model(rotor: FlexibleRotor, level: int) -> Condensed | None:
    """Return a rotor in the shapes of a level; None where it is whole."""
    if rotor.assembly.hysteresis is not None or level == WHOLE:
        return None
    model = next(models(rotor, HARMONICS * max(rotor.nominal_speed, 1.0) * ABOVE**level, FEW))
    return None if model.space is None else model


def _driven(
    rotor: PeriodicRotor, start: PeriodicOrbit | Trajectory | None, periods: int, converged: float
) -> Solution[PeriodicRotor]:
    harmonics = HARMONICS * periods
    balance = Balance(rotor=rotor, harmonics=harmonics, periods=periods)
    if start is not None:
        series, _ = _start_series(rotor, start, balance.frequency)
        return solve(balance, resized(series, harmonics), balance.frequency, converged)
    rest = rotor.guess()
    return driven(balance, constant(rest, harmonics), rest, converged)


def finished(solution: Solution[PeriodicRotor], *, stability: bool = True) -> PeriodicOrbit:
    """Return the orbit of a solution, with its multipliers if asked for."""
    balance, series, frequency = solution.balance, solution.series, solution.frequency
    rotor = balance.rotor
    return PeriodicOrbit(
        frequency=frequency,
        speed=rotor.speed,
        periods=balance.periods,
        stations=rotor.names,
        lengths=rotor.lengths,
        series=rotor.journal_series(series),
        further=rotor.further(series),
        state=rotor.state(series, frequency, balance.periods),
        multipliers=rotor.multipliers(series, frequency) if stability else np.zeros(0, dtype=complex),
        residual=max(solution.residual, rotor.neglected(balance, series, frequency)),
        truncation=truncation_of(solution),
        work={
            "film_evaluations": (solution.iterations + 1) * balance.samples * len(rotor.names),
            "iterations": solution.iterations,
        },
    )


def _start_series(
    rotor: PeriodicRotor, start: PeriodicOrbit | Trajectory, frequency: float | None
) -> tuple[Array, float]:
    """Return the series of a start and its frequency; of a run, that of its end."""
    if not isinstance(start, PeriodicOrbit):
        return end_of(rotor, start, frequency, HARMONICS)
    series = series_of(rotor, start)
    if frequency is None or start.periods * frequency == 0.0:
        return series, start.frequency
    return subharmonic(series, round(start.frequency / frequency)), frequency


def series_of(rotor: PeriodicRotor, orbit: PeriodicOrbit) -> Array:
    """Return the series of all rows of an orbit; raise InputError where it is that of another rotor."""
    planar = [station_name(name, axis) for name in orbit.stations for axis in PLANAR]
    known = {**dict(zip(planar, orbit.series.reshape(len(planar), -1), strict=True)), **orbit.further}
    if missing := [name for name in rotor.row_names if name not in known]:
        raise InputError(f"start must be an orbit of these bearings, got one without {missing}")
    return np.array([known[name] for name in rotor.row_names])


@dataclass(frozen=True, eq=False)
class CompiledRotor(ModalFilms):
    """A rotor in modes on bearings that react to x and y without states, whose forces are asked for in C.

    Attributes
    ----------
    mounted : MountedRotor
    model : Condensed, optional
        The shapes that it moves in, where these are not all.
    """

    mounted: MountedRotor
    model: Condensed | None = None

    @property
    def names(self) -> tuple[str, ...]:
        """The stations of its bearings."""
        return self.modal.parts.names

    @property
    def lengths(self) -> Array:
        """Clearance of each bearing, shape (n_bearings,) [m]; a nominal length without one."""
        return self.modal.parts.lengths

    @property
    def row_names(self) -> list[str]:
        """Names of the rows, as those of a run."""
        return [station_name(name, axis) for name in self.names for axis in PLANAR]

    @property
    def is_driven(self) -> bool:
        """Whether it turns with an unbalance."""
        return bool(np.any(self.modal.parts.structure.unbalance)) and self.speed != 0.0

    def guess(self) -> Array:
        """Return the positions of the journals at rest, or near it."""
        return first_guess(self.mounted, self.modal)

    def journal_series(self, series: Array) -> Array:
        """Return the series of x and y of each bearing, shape (n_bearings, 2, 2 H + 1) [m]."""
        return series.reshape(len(self.names), 2, -1)

    def further(self, series: Array) -> dict[str, Array]:
        """Return nothing."""
        return {}

    def state(self, series: Array, frequency: float, periods: int) -> Array:
        """Return the state of the rotor at phase 0 of an orbit."""
        if self.model is None:
            return state_at_start(self.modal, series, frequency, periods)
        return WholeFilms(self.modal, self.model.whole).state(series, frequency, periods)

    def neglected(self, balance: Balance[Any], series: Array, frequency: float) -> float:
        """Return the imbalance of an orbit by the shapes that were left out, in clearances."""
        if self.model is None:
            return 0.0
        whole = balance._replace(rotor=WholeFilms(self.modal, self.model.whole))
        return float(np.abs(whole.values(series, frequency)).max())

    def multipliers(self, series: Array, frequency: float) -> Complex:
        """Return the Floquet multipliers of an orbit, the largest first."""
        space = None if self.model is None else self.model.space
        known_to = math.inf if space is None else space.cut / MARGIN**2
        return multipliers(self.modal, series, frequency, known_to)


@dataclass(frozen=True, eq=False)
class WholeFilms(ModalFilms):
    """All coordinates of a rotor on the springs of modes in few shapes, as the equations of an orbit see it.

    Attributes
    ----------
    whole : Structure
        Sparse.
    """

    whole: Structure

    @cached_property
    def rows(self) -> Array:
        """Displacement of the journals, shape (2 n_bearings, N)."""
        return np.concatenate([freedom_rows(self.whole, name) for name in self.modal.parts.names])

    @cached_property
    def motion(self) -> BandedMotion:
        """Its small motion."""
        s, rows, speed = self.whole, sparse.csr_array(self.rows), self.speed
        spring, damper = (
            rows.T @ sparse.diags_array(part) @ rows for part in (self.modal.spring, self.modal.damper)
        )
        damping = sparse.csr_array(s.damping) + speed * sparse.csr_array(s.gyroscopic) + damper
        stiffness = sparse.csr_array(s.stiffness) + speed * sparse.csr_array(s.circulation) + spring
        return BandedMotion(sparse.csr_array(s.mass), damping, stiffness)

    def receptance(self, harmonics: int, frequency: float) -> Receptance:
        """Return what the journals answer on the springs of the modes."""
        rows = self.rows
        answers = [rows @ self.motion.solve(1j * k * frequency, rows.T) for k in range(harmonics + 1)]
        return np.array(answers), None

    def external(self, harmonics: int, periods: int, frequency: float) -> Array:
        """Return the series of the answer to weight, and to the unbalance if `periods` is not 0."""
        s, rows = self.whole, self.rows
        rest = (rows @ self.motion.solve(0.0, s.weight[:, None])).real[:, 0]
        if not periods:
            return constant(rest, harmonics)
        moved = rows @ self.motion.solve(1j * periods * frequency, self._turning[:, None])
        return with_wave(rest, moved[:, 0], harmonics, periods)

    @property
    def _turning(self) -> Complex:
        """The force of the unbalance, shape (N,): it is the real part of this exp(i |speed| t)."""
        pair = np.array([1.0, -1.0j * np.sign(self.speed)])
        return np.asarray(self.speed**2 * self.whole.unbalance @ pair)

    def state(self, series: Array, frequency: float, periods: int) -> Array:
        """Return the state (2 N,) at phase 0 of an orbit."""
        harmonics = series.shape[1] // 2
        at = basis(harmonics, 4 * harmonics + 8)
        force = self.forces(series @ at.values.T, frequency * (series @ at.slopes.T)) @ at.back.T
        place = self.motion.solve(0.0, (self.rows.T @ force[:, 0] + self.whole.weight)[:, None]).real[:, 0]
        rate = np.zeros_like(place)
        for k in range(1, harmonics + 1):
            push = self.rows.T @ (force[:, k] - 1j * force[:, harmonics + k])
            push = push + self._turning if k == periods else push
            moved = self.motion.solve(1j * k * frequency, push[:, None])[:, 0]
            place, rate = place + moved.real, rate - k * frequency * moved.imag
        return np.concatenate([place, rate])


# Floquet multipliers of a periodic orbit: the monodromy matrix, integrated with the slopes of the films.


def monodromy(modal: ModalRotor, series: Array, frequency: float, steps: int | None = None) -> Array:
    """Return how a small change of the state is mapped over one period, shape (2 N, 2 N).

    Parameters
    ----------
    modal : ModalRotor
    series : ndarray, shape (2 n_bearings, 2 H + 1) [m]
    frequency : float [rad/s]
    steps : int, optional
        By default two for each harmonic.
    """
    steps, phase = step_phases(series.shape[1] // 2, steps)
    values, rates = series_rows(series.shape[1] // 2, phase)
    _, stiffness, damping = film_forces(modal, series @ values.T, frequency * (series @ rates.T))
    slopes = np.moveaxis(np.concatenate([stiffness, damping], axis=1), 2, 0)
    mean = slopes.mean(axis=0)
    modal, count = on_mean_films(modal, mean), len(modal.parts.names)
    local = np.zeros((len(phase), count, 2, count, 4))
    for k in range(count):
        local[:, k, :, k] = (slopes - mean).reshape(-1, count, 2, 4)[:, k]
    step = 2.0 * np.pi / (frequency * steps)
    by_film = local.reshape(len(phase), 2 * count, 4 * count)
    return carried_over(ModalArrays.of(modal), modal.shapes, modal.inverse, by_film, step)


def on_mean_films(modal: ModalRotor, slopes: Array) -> ModalRotor:
    """Return a rotor on other springs and dampers at its journals: further slopes (2 n, 4)."""
    A, B = shifted_matrix(modal), (modal.shapes @ modal.push).real
    size = len(A) // 2
    rate = float(np.sqrt(np.abs(A[size:, :size]).max())) or 1.0
    scale = np.repeat([1.0, rate], size)
    values, shapes, inverse, condition = modes(A + B[:, : len(slopes)] @ _by_state(modal, slopes), scale)
    return modal._replace(
        values=values,
        shapes=shapes,
        inverse=inverse,
        push=inverse @ B,
        sense=journal_rows(modal.parts) @ shapes,
        condition=condition,
    )


def multipliers(modal: ModalRotor, series: Array, frequency: float, known_to: float = math.inf) -> Complex:
    """Return the Floquet multipliers, the largest first, of motion in modes up to a frequency [rad/s]."""
    scale = np.repeat([1.0, frequency], len(modal.shapes) // 2)
    matrix = monodromy(modal, series, frequency)
    values, vectors = np.linalg.eig(matrix * scale / scale[:, None])
    motion, sizes = scale[:, None] * vectors, np.linalg.norm(modal.shapes / scale[:, None], axis=0)
    shares = np.abs(modal.inverse @ motion) + np.abs(modal.inverse.conj() @ motion)
    leading = (sizes[:, None] * shares).argmax(axis=0)
    values = values[np.abs(modal.values)[leading] <= known_to]
    return values[np.argsort(-np.abs(values))]


def state_at_start(modal: ModalRotor, series: Array, frequency: float, periods: int) -> Array:
    """Return the state (2 N,) at phase 0 of an orbit, the whole rotor's."""
    harmonics = series.shape[1] // 2
    samples = 4 * harmonics + 8
    phase = 2.0 * np.pi * np.arange(samples) / samples
    values, rates = series_rows(harmonics, phase)
    force = film_forces(modal, series @ values.T, frequency * (series @ rates.T))[0]
    spectrum = np.fft.rfft(force, axis=1)[:, : harmonics + 1] / samples
    total = np.zeros(len(modal.values), dtype=complex)
    for k in range(harmonics + 1):
        pole = 1j * k * frequency
        push = modal.push[:, :-2] @ spectrum[:, k]
        back = modal.push[:, :-2] @ spectrum[:, k].conj()
        if k and k == periods:
            pair = 0.5 * modal.parts.speed**2 * np.array([1.0, -1.0j * np.sign(modal.parts.speed)])
            push = push + modal.push[:, -2:] @ pair
            back = back + modal.push[:, -2:] @ pair.conj()
        total += push / (pole - modal.values)
        if k:
            total += back / (-pole - modal.values)
    return modal.physical(total)


# Where a mounted rotor rests, and its linear matrix there.


TOLERANCE = 1e-12
_NEWTON_STEPS = 30


class Rest(NamedTuple):
    """A rotor at rest in its bearings.

    Attributes
    ----------
    position : ndarray, shape (2 n_bearings,) [m]
        Position of the journals.
    matrix : ndarray, shape (2 N, 2 N)
        x' = A x of small motion.
    """

    position: Array
    matrix: Array


def rest_of(mounted: MountedRotor, modal: ModalRotor) -> Rest:
    """Return where a rotor rests.

    Raises
    ------
    EquilibriumError
        If it is not found.
    """
    position = _newton(modal, first_guess(mounted, modal))
    _, stiffness, damping = film_forces(modal, position[:, None], np.zeros((len(position), 1)))
    forced = _by_state(modal, np.concatenate([stiffness, damping], axis=1)[..., 0])
    return Rest(position, shifted_matrix(modal) + force_columns(modal) @ forced)


def _by_state(modal: ModalRotor, slopes: Array) -> Array:
    """Return the derivatives of forces (2 n, 4) by each bearing's own motion by the state of the rotor."""
    rows = journal_rows(modal.parts).reshape(-1, 4, len(modal.shapes))
    return np.asarray(np.einsum("bij,bjn->bin", slopes.reshape(-1, 2, 4), rows).reshape(len(slopes), -1))


def shifted_matrix(modal: ModalRotor) -> Array:
    """Return A of the rotor on the springs of its modes."""
    return np.asarray(((modal.shapes * modal.values) @ modal.inverse).real)


def force_columns(modal: ModalRotor) -> Array:
    """Return the acceleration per force on each journal, shape (2 N, 2 n_bearings)."""
    return np.asarray((modal.shapes @ modal.push[:, :-2]).real)


def leading(matrix: Array) -> Complex:
    """Return the eigenvalues of a matrix, the least stable first."""
    values = np.linalg.eigvals(matrix)
    return values[np.argsort(-values.real)]


def _newton(modal: ModalRotor, start: Array) -> Array:
    balance = Balance(rotor=ModalFilms(modal), harmonics=0, periods=0)
    series = constant(start, 0)
    for _ in range(_NEWTON_STEPS):
        at = balance.residual(series, 1.0)
        step = np.asarray(np.linalg.solve(at.by_series, -at.values))
        size = float(np.abs(step).max())
        series += (min(1.0, 0.2 / size) if size else 1.0) * balance.in_length(step)
        if size < TOLERANCE:
            break
    left = float(np.abs(balance.values(series, 1.0)).max())
    if not (size < TOLERANCE and left <= MOST_LEFT):
        raise EquilibriumError(
            f"rotor must have a rest near its first guess, and the search found none: the last Newton step "
            f"was {size:.3g} of the clearance, and the rotor under the forces there is {left:.3g} of it away"
        )
    return np.asarray(series[:, 0])


def first_guess(mounted: MountedRotor, modal: ModalRotor) -> Array:
    """Return the positions of the journals at rest by the search of `linear`; zeros without weight."""
    rotor = mounted.bare
    parts = modal.parts
    if not np.any(parts.structure.weight):
        return np.zeros(2 * len(parts.bearings))
    if isinstance(rotor, FlexibleRotor):
        bearings = dict(zip(parts.names, parts.bearings, strict=True))
        return np.asarray(parts.rows @ rotor_equilibrium(rotor, bearings, parts.speed).displacement)
    assert isinstance(rotor, RigidRotor)
    return np.asarray(equilibrium(parts.bearings[0], rotor.static_load, parts.speed).position)


# A rotor that turns once per orbit, as its journals feel it: any bearings, and a shaft of any kind.
#
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


# Which initial offsets of a rotor at rest decay, and which end in whirl.


BLOCK = 10
"""Turns between two looks at the amplitude."""

SAMPLES = 200
"""Samples of a block."""

SETTLED = 0.01
"""Amplitude, in that of the offset, below which a stable rest is taken to be reached."""

STEADY = 1e-6
"""Relative change of the amplitude from block to block at which whirl is taken to be steady."""


@dataclass(frozen=True, kw_only=True, eq=False)
class BasinScan(Readable):
    """Basins of attraction: the long-term motion of a rotor from offsets of its journals.

    Attributes
    ----------
    offsets : ndarray, shape (2, ...) [m]
        Initial displacement of all journals from their rest.
    amplitude : ndarray, shape (...) [1]
        Largest distance of a journal from its rest / clearance over the last turns; nan where it hit
        the wall.
    whirls : ndarray of bool, shape (...)
        Whether the rotor whirls in the end, or hit the wall.
    eccentricity : ndarray, shape (...) [1]
        Largest eccentricity ratio over the last turns.
    rest : ndarray, shape (2 n_bearings,) [m]
        Position of the journals at rest.
    work : dict of str to int
    """

    offsets: Array
    amplitude: Array
    whirls: np.ndarray
    eccentricity: Array
    rest: Array
    work: dict[str, int]


@one_blas_thread
@arguments
def basin_scan(
    mounted: MountedRotor, offsets: ArrayLike, *, turns: int = 400, rtol: float = 1e-6
) -> BasinScan:
    """Return which offsets from the equilibrium decay and which end in whirl.

    The rotor starts without velocity. All journals start at the same displacement from their equilibrium,
    with the shaft bent as little as possible.

    Parameters
    ----------
    mounted : MountedRotor
        Mounted rotor from `mount`, at constant speed, without unbalance.
    offsets : array_like, shape (2, ...) [m]
        Initial displacements from the equilibrium. Those that touch the wall count as whirl, with the
        amplitude nan.
    turns : int
        Longest run in turns of the shaft; it ends sooner once it is decided.
    rtol : float [1]
        Rtol as in `simulate_rotor`.

    Raises
    ------
    InputError
        If an argument breaks its rule, or the rotor has an unbalance.
    EquilibriumError
        If there is no rest.
    """
    require_count("turns", turns)
    require_positive("rtol", rtol)
    grid = require_vector("offsets", offsets)
    parts = take_apart(mounted)
    if np.any(parts.structure.unbalance):
        raise InputError("rotor must have no unbalance for a basin of whirl")
    modal = modal_rotor(parts, parts.speed)
    rest = rest_of(mounted, modal)
    shapes = offset_shapes(parts)
    state = _rest_state(modal, rest)
    work: Counter[str] = Counter()
    flat = grid.reshape(2, -1)
    ends = np.array([_end(modal, rest, state, shapes @ offset, turns, rtol, work) for offset in flat.T])
    amplitude, eccentricity, whirls = ends.reshape(*grid.shape[1:], 3).transpose(-1, *range(grid.ndim - 1))
    return BasinScan(
        offsets=grid,
        amplitude=amplitude,
        whirls=whirls > 0.0,
        eccentricity=eccentricity,
        rest=rest.position,
        work=dict(work),
    )


def _end(
    modal: ModalRotor, rest: Rest, state: Array, shape: Array, turns: int, rtol: float, work: Counter[str]
) -> tuple[float, float, bool]:
    """Return amplitude, eccentricity ratio and whether it whirls in the end, from one offset."""
    start = state.copy()
    start[: len(shape)] += shape
    turn = 2.0 * np.pi / abs(modal.parts.speed)
    march = March(
        modal=modal,
        state=modal.modal(start),
        rtol=rtol,
        longest=LONGEST_TURN * turn,
        duration=turns * turn,
    )
    first = _amplitude(modal, rest, march.state[:, None].copy())[0]
    before, amplitude, eccentricity = np.inf, first, 0.0
    begin = 0.0
    while begin < turns * turn * (1.0 - 1e-12):
        stop = min(begin + BLOCK * turn, turns * turn)
        try:
            kept = march.to(stop, np.linspace(begin, stop, SAMPLES + 1)[1:])
        except ContactError:
            work.update(march.work)
            return float("nan"), 1.0, True
        amplitude, eccentricity = _amplitude(modal, rest, kept.T)
        if amplitude < SETTLED * first or abs(amplitude - before) <= STEADY * amplitude:
            break
        before, begin = amplitude, stop
    work.update(march.work)
    return amplitude, eccentricity, amplitude > 0.5 * first or amplitude > 0.05


def _amplitude(modal: ModalRotor, rest: Rest, kept: Complex) -> tuple[float, float]:
    """Return the largest distance of a journal from its rest, and from its center, in clearances."""
    motion = (modal.sense @ kept).real + modal.journal_rest[:, None]
    position = motion.reshape(-1, 4, motion.shape[1])[:, :2]
    lengths = modal.parts.lengths[:, None]
    away = position - rest.position.reshape(-1, 2, 1)
    return (
        float((np.hypot(away[:, 0], away[:, 1]) / lengths).max()),
        float((np.hypot(position[:, 0], position[:, 1]) / lengths).max()),
    )


def _rest_state(modal: ModalRotor, rest: Rest) -> Array:
    """Return the state of the whole rotor at rest."""
    none = np.zeros((len(rest.position), 1))
    force = film_forces(modal, rest.position[:, None], none)[0][:, 0]
    return modal.physical(-(modal.push[:, :-2] @ force) / modal.values)


def offset_shapes(parts: Parts) -> Array:
    """Return the displacement of the rotor per common offset of its journals, least bent, shape (N, 2)."""
    stiffness, rows = parts.structure.stiffness, parts.rows
    n, count = len(stiffness), len(rows)
    size = float(np.abs(stiffness).max()) or 1.0
    saddle = np.block([[stiffness / size, rows.T], [rows, np.zeros((count, count))]])
    right = np.zeros((n + count, 2))
    right[n:] = np.tile(np.eye(2), (count // 2, 1))
    return np.asarray(np.linalg.lstsq(saddle, right, rcond=None)[0][:n])
