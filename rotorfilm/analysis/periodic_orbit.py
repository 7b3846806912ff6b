"""Periodic orbits of a rotor on films: driven by its unbalance, or whirl at a frequency of its own."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property
from typing import ClassVar, NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from ..core.errors import EquilibriumError, InputError, require_count, require_positive
from ..core.inputs import arguments
from ..core.model import Array
from ..core.port import MOST_LEFT, freedoms_of, takes_steps
from ..core.readable import Drawable
from ..core.results import Trajectory
from ..core.signals import PLANAR
from ..rotors import FlexibleRotor, MountedRotor, RigidRotor, mount
from ..rotors.structure import MatrixRotor, station_name
from . import harmonic_balance
from .collocation import ModalArrays
from .compiled_rotor import Complex, ModalRotor, journal_rows, modal_rotor, modes, take_apart
from .equilibrium import equilibrium
from .modal_reduction import FEW, Condensed, models
from .port_orbits import PortRotor, carried_over, step_phases
from .rotor_equilibrium import rotor_equilibrium
from .threads import one_blas_thread
from .whole_shaft import InShapes, WholeShaft, slow_multipliers

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
        A shaft of more than 24 coordinates has only those of its lower modes, if all its bearings damp faster
        motion; other rotors have one for each state.
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
        """Number of harmonics in the Fourier series of the orbit."""
        return self.series.shape[-1] // 2

    def position(self, time: ArrayLike) -> Array:
        """Return x, y of each journal at times (n,) [s], shape (n_bearings, 2, n) [m]."""
        values, _ = harmonic_balance.series_rows(
            self.harmonics, self.frequency * np.atleast_1d(np.asarray(time, dtype=float))
        )
        return np.asarray(self.series @ values.T)

    @cached_property
    def eccentricity_ratios(self) -> Array:
        """Eccentricity ratio of each journal over the orbit, shape (n_bearings, 256)."""
        position = self.position(self.period * np.arange(256) / 256)
        return np.hypot(position[:, 0], position[:, 1]) / self.lengths[:, None]

    @property
    def amplitude(self) -> float:
        """Largest distance of a journal from its mean position, in clearances [1]."""
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
        """Whether small disturbances decay; raises InputError if the multipliers were not computed."""
        if not self.multipliers.size:
            raise InputError(
                "stable needs an orbit with Floquet multipliers, got one without: compute it with "
                "stability=True"
            )
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
        equilibrium, which leads to the orbit of one turn.
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
    converged = max(harmonic_balance.CONVERGED, BALANCED * tolerance)
    for level in range(WHOLE + 1):
        found = _found(orbit_rotor(mounted, level), start, periods, converged)
        orbit = finished(harmonic_balance.lengthened(found, tolerance, converged), stability=stability)
        if orbit.residual <= tolerance:
            break
    return orbit


def _found(
    rotor: harmonic_balance.PeriodicRotor,
    start: PeriodicOrbit | Trajectory | None,
    periods: int,
    converged: float,
) -> harmonic_balance.Solution[harmonic_balance.PeriodicRotor]:
    """Return the orbit of a rotor in its first harmonics."""
    if rotor.is_driven:
        return _driven(rotor, start, periods, converged)
    if start is None:
        raise InputError("start must be an orbit, or a run that ends in whirl, for a rotor without unbalance")
    series, frequency = _start_series(rotor, start, None)
    balance = harmonic_balance.Balance(rotor=rotor, harmonics=HARMONICS, periods=0)
    return harmonic_balance.solve(balance, harmonic_balance.resized(series, HARMONICS), frequency, converged)


def orbit_rotor(mounted: MountedRotor, level: int = 0) -> harmonic_balance.PeriodicRotor:
    """Return a rotor with its bearings as the equations of an orbit see it, in C where its bearings allow.

    It is in more of its shapes at a higher level, and whole at `WHOLE`.

    Raises
    ------
    InputError
        If the rotor has no orbits here: its speed must be constant, the ground still.
    """
    bare, bearings = mounted.bare, mounted.all_bearings.values()
    aside = isinstance(bare, FlexibleRotor) and bool(bare.assembly.others)
    if aside or any(freedoms_of(one) != PLANAR for one in bearings):
        return PortRotor.of(mounted)
    model = _model(bare, level) if isinstance(bare, FlexibleRotor) else None
    if any(one.states and not takes_steps(one) for one in bearings):
        return PortRotor.of(mounted, model)
    if isinstance(bare, FlexibleRotor) and model is not None:
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
    rotor: harmonic_balance.PeriodicRotor,
    start: PeriodicOrbit | Trajectory | None,
    periods: int,
    converged: float,
) -> harmonic_balance.Solution[harmonic_balance.PeriodicRotor]:
    harmonics = HARMONICS * periods
    balance = harmonic_balance.Balance(rotor=rotor, harmonics=harmonics, periods=periods)
    if start is not None:
        series, _ = _start_series(rotor, start, balance.frequency)
        return harmonic_balance.solve(
            balance, harmonic_balance.resized(series, harmonics), balance.frequency, converged
        )
    rest = rotor.guess()
    return harmonic_balance.driven(balance, harmonic_balance.constant(rest, harmonics), rest, converged)


def finished(
    solution: harmonic_balance.Solution[harmonic_balance.PeriodicRotor], *, stability: bool = True
) -> PeriodicOrbit:
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
        truncation=harmonic_balance.truncation_of(solution),
        work={
            "film_evaluations": (solution.iterations + 1) * balance.samples * len(rotor.names),
            "iterations": solution.iterations,
        },
    )


def _start_series(
    rotor: harmonic_balance.PeriodicRotor, start: PeriodicOrbit | Trajectory, frequency: float | None
) -> tuple[Array, float]:
    """Return the series of a start and its frequency; of a run, that of its end."""
    if not isinstance(start, PeriodicOrbit):
        return harmonic_balance.end_of(rotor, start, frequency, HARMONICS)
    series = series_of(rotor, start)
    if frequency is None or start.periods * frequency == 0.0:
        return series, start.frequency
    return harmonic_balance.subharmonic(series, round(start.frequency / frequency)), frequency


def series_of(rotor: harmonic_balance.PeriodicRotor, orbit: PeriodicOrbit) -> Array:
    """Return the series of all rows of an orbit; raise InputError where it is that of another rotor."""
    planar = [station_name(name, axis) for name in orbit.stations for axis in PLANAR]
    known = {**dict(zip(planar, orbit.series.reshape(len(planar), -1), strict=True)), **orbit.further}
    if missing := [name for name in rotor.row_names if name not in known]:
        raise InputError(f"start must be an orbit of these bearings, got one without {missing}")
    return np.array([known[name] for name in rotor.row_names])


@dataclass(frozen=True, eq=False)
class CompiledRotor(InShapes, harmonic_balance.ModalFilms):
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
        if self.shaft is None:
            return state_at_start(self.modal, series, frequency, periods)
        return self.shaft.state(series, frequency, periods, self.forces)

    @cached_property
    def shaft(self) -> WholeShaft | None:
        """All of the shaft; None where it moves in all of its coordinates."""
        if self.model is None or self.model.space is None:
            return None
        return WholeShaft(self.model, self.names, self.modal.spring, self.modal.damper, self.speed)

    @property
    def shaft_forces(self) -> Callable[[Array, Array], Array]:
        """The forces of films and springs at places and rates of the journals."""
        return self.forces

    def fast_films(self, position: Array, velocity: Array) -> tuple[Callable[[float], Complex], Complex]:
        """Return what the mean slopes over an orbit answer at a frequency, and no poles."""
        _, by_row, by_rate = self.tangents(position, velocity)
        K, C = (part.mean(axis=-1).reshape(-1, 2, 2) for part in (by_row, by_rate))
        C = C - self.modal.damper.reshape(-1, 2, 1) * np.eye(2)
        return lambda w: K + 1j * w * C, np.zeros(0, dtype=complex)

    def multipliers(self, series: Array, frequency: float) -> Complex:
        """Return the Floquet multipliers of an orbit, the largest first."""
        return multipliers(self.modal, series, frequency, self.known_to)


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
    values, rates = harmonic_balance.series_rows(series.shape[1] // 2, phase)
    _, stiffness, damping = harmonic_balance.film_forces(
        modal, series @ values.T, frequency * (series @ rates.T)
    )
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
    return slow_multipliers(matrix, scale, modal.values, modal.shapes, modal.inverse, known_to)


def state_at_start(modal: ModalRotor, series: Array, frequency: float, periods: int) -> Array:
    """Return the state (2 N,) at phase 0 of an orbit, the whole rotor's."""
    turning = modal.parts.speed**2 * np.array([1.0, -1.0j * np.sign(modal.parts.speed)])

    def answer(k: int, force: Complex) -> Complex:
        push = np.concatenate([force, turning * (k > 0 and k == periods)])
        pole = 1j * k * frequency
        ways = (modal.push @ one / (s - modal.values) for one, s in ((push, pole), (push.conj(), -pole)))
        return np.asarray(0.5 * sum(ways))

    def forces(places: Array, rates: Array) -> Array:
        return harmonic_balance.film_forces(modal, places, rates)[0]

    return modal.physical(harmonic_balance.at_start(series, frequency, forces, answer))


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
    _, stiffness, damping = harmonic_balance.film_forces(
        modal, position[:, None], np.zeros((len(position), 1))
    )
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
    balance = harmonic_balance.Balance(rotor=harmonic_balance.ModalFilms(modal), harmonics=0, periods=0)
    series = harmonic_balance.constant(start, 0)
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
            "rotor must have an equilibrium near its first guess, and the search found none: the last "
            "Newton step "
            f"was {size:.3g} of the clearance, and the forces there would move the rotor by {left:.3g} of it"
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
