"""Time integration of a rotor of any size on films, compiled: as long as its bearings, not its shaft."""

from __future__ import annotations

import math
from collections import Counter
from collections.abc import Callable, Iterator, Mapping
from ctypes import addressof, byref, c_double, c_int32, c_int64
from enum import IntEnum
from functools import partial
from itertools import pairwise
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from ..core.errors import (
    ContactError,
    ConvergenceError,
    FilmContactError,
    InputError,
    require_finite,
    require_non_negative,
    require_positive,
)
from ..core.inputs import arguments
from ..core.limits import STEPS as MOST_STEPS, TURNS, require_at_most
from ..core.model import Array, Dynamic, breakpoints
from ..core.port import freedoms_of, require_turned
from ..core.results import Trajectory
from ..core.signals import indices, names, units
from ..native.film_call import FilmCall
from ..native.library import loops
from ..native.structs import constant, structure
from ..rotors import FlexibleRotor, MotorDrivenRotor, MountedRotor, RigidRotor, SpeedProfile, mount
from ..rotors.structure import prefixed
from . import compiled_rotor
from .bearing_forces import bearing_forces
from .collocation import STAGES, ModalArrays, StepTable, radau_scheme, stages_of
from .condensed_runs import RunStart, starts, verified
from .force_calls import (
    has_states_in_c,
    of_station,
    raise_foreign,
    torque_call,
    warn_beyond,
    warn_of_thin_films,
)
from .linear_runs import is_steady_and_linear, linear_states
from .threads import one_blas_thread

LONGEST_TURN = 1.0
"""Longest step in turns of the shaft."""

FEW_STATES = 240
"""States of a rotor whose linear motion costs less in all of its modes than in the shapes that it needs."""


@one_blas_thread
@arguments
def simulate_rotor(
    mounted: MountedRotor,
    *,
    duration: float,
    samples: int = 1001,
    times: ArrayLike | None = None,
    initial_state: ArrayLike | None = None,
    rtol: float = 1e-8,
    max_step: float = math.inf,
    condensation: float = 1e-5,
) -> Trajectory:
    """Return the motion of a rotor on films from t = 0.

    The shaft is integrated exactly in its modes, and the film forces by collocation with their exact
    derivatives (`native/loops/march.h`), of order 7, or of order 15 where `rtol` is below 1e-11, all of it
    compiled. A step costs some ten microseconds.

    On springs and dampers at constant speed the motion is exact at every sample, and no steps are taken.

    A `SpeedProfile` may change the gyroscopic effect and the rotating damping too. On a motor
    (`MotorDrivenRotor`) speed and angle are found along with the forces. A shaft of many elements
    (more than 60 coordinates) is reduced to its lowest mode shapes. Forces of the bearings, unbalance and
    weight in such a run also act on the whole shaft, and bend the shapes that were neglected. The run is
    accepted if that moves no journal further than `condensation`, estimated as twice the static response of
    these shapes, at first over an eighth of it. Otherwise it is repeated with shapes up to a higher
    frequency, and with the whole shaft in the end. The estimate is made moment by moment, so it also serves
    for unstable motion, in which two runs part however close they begin.

    Parameters
    ----------
    mounted : MountedRotor
        Mounted rotor from `mount`, with a bearing in at least one station, and without free force inputs. Its
        bearings react to x and y, or are a `MomentCarryingJournal`. Those that may have states are linear
        ones, as a `FrequencyDependentReaction`, plain journal bearings whose oil warms, and tilting pads with
        up to 48 states. The speed may be a profile, or follow from a motor.
    duration : float [s]
    samples : int
        Number of samples at equal distance, from 0 to `duration` inclusive.
    times : array_like, shape (n,) [s], optional
        Increasing sample times within [0, duration], instead of `samples`.
    initial_state : array_like, shape (n_states,), optional
        State at t = 0, instead of the rotor's own.
    rtol : float [1]
        Local error of the journals and pads at every moment: displacement / clearance and velocity /
        (clearance speed), and temperature / 30 K of films that warm. On a motor also that of the angle, in
        rad, and of the speed. There velocities and speed are divided by the largest speed that is known
        before the run, as the idle speed.
    max_step : float [s]
    condensation : float [1]
        Largest displacement of a journal by the neglected shapes of a large shaft, in clearances. With 0 the
        whole shaft is integrated.

    Returns
    -------
    Trajectory
        Signals: every output of `mounted`, including the bearing forces. Counters in `work`:
        film_evaluations, jacobians, steps, rejected, and restarts (rejected steps that were cut short at the
        wall).

    Raises
    ------
    InputError
        If an argument is out of range, or this function does not take the rotor.
    ContactError
        If a journal reaches the wall; the error carries the trajectory until then.
    ConvergenceError
        If a film force is not finite, steps become too small or a film gets so hot that the viscosity of its
        oil is not tabulated; the error carries the trajectory until then.

    Warns
    -----
    ValidityWarning
        If a journal goes beyond the map of its film, or a film gets thinner than the roughness of its
        surfaces.
    """
    require_duration(mounted.bare, duration)
    require_positive("rtol", rtol)
    require_longest_step(max_step)
    require_non_negative("condensation", condensation)
    size = len(mounted.states)
    state = np.asarray(mounted.initial_state if initial_state is None else initial_state, dtype=float)
    if require_finite("initial_state", state).shape != (size,):
        raise InputError(f"initial_state must have shape ({size},), got {state.shape}")
    grid = sample_times(duration, samples, times)
    begun, driven = (0.0, 0.0), mounted.bare
    if isinstance(driven, MotorDrivenRotor):
        place = len(driven.rotor.states)
        begun, state = tuple(state[place : place + 2].tolist()), np.delete(state, [place, place + 1])
    run_of = partial(_run, rtol=rtol, max_step=max_step, begun=begun)
    joined = partial(_mounted, mounted.all_bearings)
    few = len(state) <= FEW_STATES and is_steady_and_linear(joined(driven)[1])
    every = starts(driven, joined, state, whole=few or condensation == 0.0)
    run = verified(every, run_of, grid, duration, condensation)
    for bearing in mounted.all_bearings.values():
        require_turned(bearing, mounted.bare, run.signals)
    warn_of_thin_films(mounted.all_bearings, run)
    return run


def _mounted(bearings: Mapping[str, Any], bare: Any) -> tuple[MountedRotor, compiled_rotor.Parts]:
    """Return a rotor in its bearings, and its parts."""
    mounted = mount(bare, bearings)
    return mounted, compiled_rotor.take_apart(mounted, over_time=True)


def _run(
    start: RunStart,
    grid: Array,
    *,
    duration: float,
    rtol: float,
    max_step: float,
    begun: tuple[float, float],
) -> tuple[Trajectory, Array, Array, Exception | None]:
    """Return a run, the states at its times, the turning of the shaft there, and what ended it early.

    What began is the angle and the speed of a rotor on a motor, whose states have neither.
    """
    mounted, parts, state, neglected = start
    if (exact := linear_states(parts, state, grid, whole=neglected is not None)) is not None:
        turn = parts.profile.turn(grid)
        return _trajectory(mounted, grid, exact, parts, turn, dict.fromkeys(_COUNTERS, 0)), exact, turn, None
    rate = parts.nominal_speed or rate_of(compiled_rotor.modal_rotor(parts, 0.0))
    longest = min(max_step, duration, LONGEST_TURN * 2.0 * np.pi / rate)
    march = partial(March, rtol=rtol, longest=longest, duration=duration, stages=stages_of(rtol))
    run = RunUp(parts, state, duration, march, begun)
    kept: list[Array] = [np.zeros((0, len(state))), *([state[None]] if grid.size and grid[0] == 0.0 else [])]
    try:
        kept.extend(run.states(grid))
    except (ContactError, ConvergenceError) as failure:
        if failure.partial is None:  # without modes there is no run
            raise
        states = np.concatenate([*kept, failure.partial])
        turn = run.turn(grid[: len(states)])
        try:
            return _trajectory(mounted, grid, states, parts, turn, run.work), states, turn, failure
        except (InputError, FilmContactError):  # a film has no force in the last state
            states, turn = states[:-1], turn[:, :-1]
            return _trajectory(mounted, grid, states, parts, turn, run.work), states, turn, failure
    run.warn()
    states, turn = np.concatenate(kept), run.turn(grid)
    return _trajectory(mounted, grid, states, parts, turn, run.work), states, turn, None


def _trajectory(
    mounted: MountedRotor,
    grid: Array,
    states: Array,
    parts: compiled_rotor.Parts,
    turn: Array,
    work: dict[str, int],
) -> Trajectory:
    time = grid[: len(states)]
    rotor: Any = mounted.bare
    # Displacements and rates are linear in the state, then come the speed and, on a motor, the angle.
    plain = rotor.rotor if parts.motor else rotor
    rows = plain.linearization(0.0, plain.initial_state, np.zeros(len(plain.inputs))).C
    outputs = np.vstack([rows[:-1] @ states[:, : rows.shape[1]].T, turn[1], turn[0]])
    signals = dict(zip(names(rotor.outputs), outputs, strict=False))
    shown = list(rotor.outputs)
    found = bearing_forces(parts, time, states, turn)
    for name, bearing, rows in zip(parts.names, parts.bearings, found, strict=False):  # not for a crack
        further = bearing.outputs if bearing.states else bearing.outputs[: len(freedoms_of(bearing))]
        known = [prefixed(name, signal) for signal in (*further, *bearing.states)]
        signals |= zip((signal.name for signal in known), rows, strict=True)
        shown += known
    return Trajectory(time=time, signals=signals, work=work, units=units(shown))


# The driver of the compiled integration: scheme, tables, what ends a run.


BUDGET = 20000
"""Steps between two looks at the interpreter, where a user may interrupt."""

SHORTEST = 1e-13
"""Shortest step, relative to the duration, before a run is given up."""

KELVINS = 30.0
"""Difference of temperature that counts as much as a clearance [K]: it changes the viscosity e-fold."""

EDGE = 1e-3
"""Distance from where an oil is no longer tabulated at which a run that cannot go on is at its end [K]."""

NEWTON = 0.01
"""Error left by Newton's method, in local errors."""

_COUNTERS = {
    "film_evaluations": "films",
    "jacobians": "jacobians",
    "steps": "steps",
    "rejected": "rejected",
    "restarts": "walls",
}


def profile_rows(profile: SpeedProfile) -> tuple[Array, Array, Array, Array]:
    """Return times, speeds, slopes after them and angles turned since t = 0."""
    times = np.array(profile.times, dtype=float)
    slopes = np.array([profile.acceleration(t) for t in profile.times])
    angles = np.array([profile.angle(t) for t in profile.times])
    return times, np.array(profile.speeds, dtype=float), slopes, angles


class End(IntEnum):
    """Why a march ended: rf_march_end of march.h."""

    DONE = 0
    WALL = 1
    SHORT = 2
    BUSY = 3
    BROKEN = 4
    NO_MEMORY = 5
    BAND = 6


class March:
    """One run of a rotor, which goes on from stop to stop.

    Parameters
    ----------
    modal : ModalRotor
    state : ndarray of complex, shape (n_modes,)
        Modal coordinates; moved by `to`.
    rtol : float [1]
        Local error of the journals: displacement / clearance, velocity / (clearance speed).
    longest : float [s]
        Longest step.
    duration : float [s]
        Duration of the whole run, which says what step is too short.
    speed : float [rad/s], optional
        Speed of the modes, where the matrices depend on the speed and that is not always this one.
    stages : int
        Collocation nodes.
    band : float [rad/s]
        How far the speed that follows from a motor may leave that of the modes.
    """

    def __init__(
        self,
        *,
        modal: compiled_rotor.ModalRotor,
        state: compiled_rotor.Complex,
        rtol: float,
        longest: float,
        duration: float,
        speed: float | None = None,
        stages: int = STAGES,
        band: float = math.inf,
    ) -> None:
        self.modal, self.state = modal, np.array(state, dtype=complex)
        self._duration = duration
        self._kept = ModalArrays.of(modal), radau_scheme(stages), compiled_rotor.JournalFilms.of_rotor(modal)
        self._numbers = *profile_rows(modal.parts.profile), journal_scales(modal)
        motor = modal.parts.motor
        changes = motor is not None or set(modal.parts.profile.speeds) != {speed}
        spins = speed is not None and modal.parts.turns and changes
        self._spin = compiled_rotor.spin_rates(modal) if spins else None
        self._torque: tuple[FilmCall, ...] = () if motor is None else (torque_call(motor.torque),)
        self._damping = compiled_rotor.rotating_damping_torque(modal)
        self.turns = np.empty((0, 3))
        excited = modal.parts.excited
        self._excited = None if excited is None else np.ascontiguousarray(excited)
        slots, steps = constant("RF_SLOTS"), constant("RF_STEPS")
        self._tables = [StepTable.unfilled(self._kept[0], stages, spins=spins) for _ in range(slots + 1)]
        rows = structure("rf_step_table") * (slots + 1)
        self._table_rows = rows(*(table.struct() for table in self._tables))
        times = len(self._numbers[0])
        self._struct = structure("rf_march")(
            *(of.struct() for of in self._kept),
            structure("rf_speeds")(times, *(row.ctypes.data for row in self._numbers[:4])),
            spin_struct(speed, self._spin),
            excitation_struct(self._excited),
            self._motor_struct(motor, band),
            self._numbers[4].ctypes.data,
            longest,
            SHORTEST * duration,
            rtol,
            max(NEWTON * rtol, 1e-12),
            addressof(self._table_rows),
            (c_int32 * steps)(*[-1] * steps),
            (c_int32 * slots)(*[-1] * slots),
        )
        # A first step that the error control need not believe in: a hundredth of a turn or less.
        first = 0.01 * 2.0 * np.pi / max(rate_of(modal), 1.0 / duration)
        self._struct.step = math.ceil(4.0 * math.log2(max(1.0, longest / first)))
        self._struct.z = self.state.ctypes.data

    @property
    def work(self) -> dict[str, int]:
        """Film_evaluations, jacobians, steps, rejected steps and, of these, restarts at a wall so far."""
        return {name: getattr(self._struct, counter) for name, counter in _COUNTERS.items()}

    @property
    def time(self) -> float:
        """How far the run is [s]."""
        return float(self._struct.time)

    @property
    def step(self) -> int:
        """Which of the lengths of steps is the next one."""
        return int(self._struct.step)

    @property
    def left_map(self) -> bool:
        """Whether a film was asked beyond its map."""
        return bool(self._struct.left_map)

    def _motor_struct(self, motor: MotorDrivenRotor | None, band: float) -> Any:
        made = structure("rf_motor")
        if motor is None:
            return made()
        rubbed = None if self._damping is None else self._damping.ctypes.data
        gravity = (c_double * 2)(*(self.modal.parts.structure.unbalance.T @ motor.gravity))
        numbers = motor.inertia, rate_of(self.modal), band, gravity
        return made(*self._torque[0][:2], rubbed, None, *numbers)

    @property
    def turn(self) -> tuple[float, float]:
        """Angle [rad] and speed [rad/s] that follow from a motor."""
        return self._struct.motor.angle, self._struct.motor.speed

    @property
    def first_acceleration(self) -> float:
        """Angular acceleration at t = 0 that follows from a motor [rad/s2]."""
        return float(self._struct.motor.first)

    def resume(
        self, time: float, state: compiled_rotor.Complex, step: int, turn: tuple[float, float] = (0.0, 0.0)
    ) -> None:
        """Go on at a time [s] with a state in modal coordinates, and the step of another march if not -1.

        The turn is the angle [rad] and the speed [rad/s] of a rotor on a motor.
        """
        self._struct.time, self.state[:] = time, state
        self._struct.motor.angle, self._struct.motor.speed = turn
        self._struct.step = step if step >= 0 else self._struct.step

    def to(self, stop: float, grid: Array) -> compiled_rotor.Complex:
        """Integrate to a time and return the modal coordinates at the times of `grid` after the last stop.

        On a motor `turns` is then angle, speed and acceleration at the same times, shape (n, 3), and the run
        ends sooner where the speed leaves that of the modes too far.

        Raises
        ------
        ContactError, ConvergenceError
            With the modal coordinates until then as partial result.
        """
        out, place = np.empty((len(grid), len(self.state)), dtype=complex), c_int64()
        times = np.ascontiguousarray(grid, dtype=float)
        arguments = times.ctypes.data, len(times), byref(place), out.ctypes.data
        turns = np.empty((len(grid) * bool(self._torque), 3))
        self._struct.motor.turns = turns.ctypes.data
        end = End.BUSY
        while end == End.BUSY:
            end = End(loops()["rf_march_to"](byref(self._struct), stop, BUDGET, *arguments))
            raise_foreign((*self.modal.calls, *self._torque))
        self.turns = turns[: place.value]
        if end == End.NO_MEMORY:
            raise MemoryError("no memory for the steps of a rotor")
        if end not in (End.DONE, End.BAND):
            raise self._failure(end, out[: place.value])
        return out[: place.value]

    def _failure(self, end: End, kept: compiled_rotor.Complex) -> ContactError | ConvergenceError:
        at = f"at t = {self.time:.9g} s"
        if end == End.WALL:
            return ContactError(f"journal{of_station(self._closest())} reached the wall {at}", kept)
        if end == End.BROKEN and (hot := self._beyond_oil()):
            return ConvergenceError(f"{hot} {at}", kept)
        if end == End.BROKEN:
            return ConvergenceError(
                f"film force{' and drive torque' * bool(self._torque)} must be finite and the forces of a "
                f"step solvable, {at}",
                kept,
            )
        return ConvergenceError(f"integration needs steps below {SHORTEST:g} of the duration {at}", kept)

    def _beyond_oil(self) -> str:
        """Return which film has come to where its oil is not tabulated; empty where none has."""
        parts, now = self.modal.parts, self.modal.physical(self.state)
        for name, bearing, places in zip(parts.names, parts.bearings, parts.film_states, strict=False):
            if not places or not hasattr(bearing, "temperature_range"):
                continue
            (coldest, hottest), t = bearing.temperature_range, float(now[places[0]])
            if not coldest + EDGE < t < hottest - EDGE:
                return (
                    f"temperature{of_station(name)} must be from {coldest:g} to {hottest:g} K, where the "
                    f"viscosity of the oil is tabulated, got {t:.6g} K"
                )
        return ""

    def _closest(self) -> str:
        """Return the station whose journal is nearest to its wall."""
        parts, walls = self.modal.parts, self._kept[2].walls
        motion = (self.modal.sense @ self.state).real + self.modal.journal_rest
        shares = np.hypot(*motion.reshape(-1, 4)[:, :2].T) / walls
        return parts.names[int(np.argmax(shares)) // parts.points]


def spin_struct(speed: float | None, rates: tuple[Array, Array] | None) -> Any:
    """Return what the speed changes as the C library reads it, while the arrays live."""
    return structure("rf_spin_rates")(speed or 0.0, *(part.ctypes.data for part in rates or ()))


def excitation_struct(rows: Array | None) -> Any:
    """Return times and excitation as the C library reads them, while the array lives."""
    made = structure("rf_excitation")
    if rows is None:
        return made()
    return made(rows.shape[1], len(rows) - 1, rows.ctypes.data, rows[1:].ctypes.data)


def rate_of(modal: compiled_rotor.ModalRotor) -> float:
    """Return the largest angular speed [rad/s], or a slow mode's where the rotor does not turn."""
    of_shaft = np.any(modal.shapes[: 2 * len(modal.parts.structure.weight)] != 0.0, axis=0)
    return modal.parts.nominal_speed or float(np.abs(modal.values[of_shaft]).min())


def journal_scales(modal: compiled_rotor.ModalRotor) -> Array:
    """Return what makes x, y, vx, vy of each journal and states of films dimensionless, 0 for the others."""
    rate, lengths = rate_of(modal), modal.parts.lengths.copy()
    lengths[len(modal.parts.names) * modal.parts.points :] = math.inf
    motion = [np.array([1.0, 1.0, 1.0 / rate, 1.0 / rate]) / c for c in lengths]
    inner = [_film_scales(one, rate) for one in modal.parts.bearings if has_states_in_c(one)]
    further = 2 * len(lengths) * modal.is_heavy + 2 * bool(modal.parts.motor)
    return np.concatenate([*motion, *inner, np.zeros(further)])


def _film_scales(bearing: Any, rate: float) -> Array:
    """Return what makes the states of a film dimensionless."""
    faster = rate / bearing.inputs[-1].nominal
    sizes = [signal.nominal * (faster if signal.unit.endswith("/s") else 1.0) for signal in bearing.states]
    kelvins = [signal.unit == "K" for signal in bearing.states]
    return 1.0 / np.where(kelvins, KELVINS, sizes)


# A run of a rotor whose speed may change its gyroscopic effect and rotating damping: march after march.


BANDS = 12
"""Bands of speed between rest and the largest speed: in each the modes are those of its middle."""


def stretches(
    parts: compiled_rotor.Parts, duration: float, bands: int = BANDS
) -> Iterator[tuple[float, float]]:
    """Yield the parts of a run: between kinks of the speed, each within one band of it.

    A part is told by its end [s] and the speed of the modes that it is integrated in [rad/s].
    """
    profile = parts.profile
    largest = max(profile.speeds, key=abs)
    width = abs(largest) / bands
    ground = () if parts.excited is None else parts.excited[0].tolist()
    driven = breakpoints(parts.motor) if parts.motor else ()
    kinks = sorted({0.0, *(t for t in (*profile.times, *ground, *driven) if 0.0 < t < duration), duration})
    for begin, end in pairwise(kinks):
        speed, slope = profile.speed(begin), profile.acceleration(begin)
        if not parts.turns or slope == 0.0:
            yield end, speed if parts.turns else largest
            continue
        first, last = sorted((speed, speed + slope * (end - begin)))
        edges = width * np.arange(np.floor(first / width) + 1.0, np.ceil(last / width))
        crossed = sorted(begin + (float(edge) - speed) / slope for edge in edges)
        inner = [t for t in crossed if begin < t < end]
        for t, until in pairwise([begin, *inner, end]):
            middle = speed + slope * (0.5 * (t + until) - begin)
            yield until, width * float(np.floor(middle / width) + 0.5)


def band_of(parts: compiled_rotor.Parts, speed: float) -> tuple[float, float]:
    """Return the middle of the band of a speed that a motor leads to, and its width [rad/s].

    The bands are wider beyond the largest speed that is known before the run.
    """
    largest = parts.nominal_speed or SLOWEST
    width = largest * 2.0 ** max(0.0, math.ceil(math.log2(max(abs(speed), largest) / largest))) / BANDS
    return width * (math.floor(speed / width) + 0.5), width


class RunUp:
    """One run of a rotor in modes, in those of another speed where the speed has left a band.

    Parameters
    ----------
    parts : Parts
    state : ndarray, shape (2 N,)
        State at t = 0.
    duration : float [s]
    march : callable
        `March` with its error and step, of `modal`, `state` and `speed`.
    turn : tuple of two float [rad], [rad/s]
        Angle and speed at t = 0 of a rotor on a motor.
    """

    def __init__(
        self,
        parts: compiled_rotor.Parts,
        state: Array,
        duration: float,
        march: Callable[..., March],
        turn: tuple[float, float],
    ) -> None:
        self.parts, self._state, self._duration, self._begun = parts, state, duration, march
        self._marches: dict[float, March] = {}
        self._time, self._step = 0.0, -1
        self._turn, self._first, self._turns = turn, np.array([[*turn, 0.0]]), [np.empty((0, 3))]

    @property
    def work(self) -> dict[str, int]:
        """Counters of `March.work`, of all marches."""
        total: Counter[str] = Counter()
        for march in self._marches.values():
            total.update(march.work)
        return dict(total)

    def states(self, grid: Array) -> Iterator[Array]:
        """Integrate and yield the states at the times of `grid`, shape (m, 2 N), stretch by stretch.

        Raises
        ------
        ContactError, ConvergenceError
            With the states since the last stretch as partial result.
        """
        for end, speed in stretches(self.parts, self._duration):
            while self._time < end:
                yield self._stretch(end, speed, grid)

    def turn(self, time: Array) -> Array:
        """Return angle, speed and angular acceleration at the times of the states so far, shape (3, n)."""
        if self.parts.motor is None:
            return self.parts.profile.turn(time)
        first = self._first[: int(time.size > 0 and time[0] == 0.0)]
        return np.concatenate([first, *self._turns]).T

    def _stretch(self, end: float, speed: float, grid: Array) -> Array:
        """Return the states at the times of `grid` until an end, or until a motor leaves its band."""
        band = math.inf
        if self.parts.motor:
            speed, band = band_of(self.parts, self._turn[1])
        march = self._march(speed, band)
        march.resume(self._time, march.modal.modal(self._state), self._step, self._turn)
        inside, begins = grid[(grid > self._time) & (grid <= end)], self._time == 0.0
        try:
            kept = march.to(end, inside)
        except (ContactError, ConvergenceError) as failure:
            partial = march.modal.physical(failure.partial.T).T
            raise type(failure)(str(failure), partial) from failure
        finally:
            self._turns.append(march.turns)
            self._first[:, 2] = march.first_acceleration if begins else self._first[:, 2]
        self._state, self._turn = march.modal.physical(march.state), march.turn
        self._time, self._step = march.time, march.step
        return march.modal.physical(kept.T).T

    def warn(self) -> None:
        """Warn if a film was asked beyond its map."""
        for march in self._marches.values():
            if march.left_map:
                warn_beyond(march.modal.calls)
                return

    def _march(self, speed: float, band: float) -> March:
        if speed not in self._marches:
            modal = compiled_rotor.modal_rotor(self.parts, speed)
            state = modal.modal(self._state)
            self._marches[speed] = self._begun(modal=modal, state=state, speed=speed, band=band)
        return self._marches[speed]


# When a simulation is sampled, and how far it may step: checks of what the caller asks for.


FASTEST = 1e6
"""Speed that no shaft exceeds [rad/s]; a run that is short at it needs no look at the rotor."""

SLOWEST = 1.0
"""Speed [rad/s] as which a shaft counts that stands or turns more slowly: it may swing all the same."""


def require_duration(rotor: Dynamic, duration: float) -> None:
    """Raise InputError unless a run has a length, and no more turns than can be run."""
    require_positive("duration", duration)
    longest = 2.0 * math.pi * TURNS
    if duration * FASTEST <= longest:
        return
    speed = max(highest_speed(rotor, duration), SLOWEST)
    if duration * speed > longest:
        raise InputError(
            f"duration must be at most {TURNS:g} turns, {longest / speed:.3g} s at {speed:g} rad/s, "
            f"got {duration!r} s"
        )


def highest_speed(rotor: Dynamic, duration: float) -> float:
    """Return the highest speed of a rotor at its start and where its speed bends within a run [rad/s]."""
    moments = [0.0, *(t for t in breakpoints(rotor) if 0.0 < t < duration), duration]
    if isinstance(rotor, RigidRotor | FlexibleRotor):  # whose outputs take all matrices
        return float(max(abs(rotor.profile.speed(t)) for t in moments))
    speed = indices("rotor must have the outputs", names(rotor.outputs), ["speed"])
    none = np.zeros(len(rotor.inputs))
    return float(max(np.abs(rotor.output(t, rotor.initial_state, none)[speed]).max() for t in moments))


def sample_times(duration: float, samples: int, times: ArrayLike | None) -> Array:
    """Return increasing times within [0, duration]; raise InputError where they are not."""
    if times is None:
        if not isinstance(samples, int) or samples < 2:
            raise InputError(f"samples must be an integer of at least 2, got {samples!r}")
        require_at_most("samples", samples, MOST_STEPS)
        return np.linspace(0.0, duration, samples)
    grid = np.atleast_1d(require_finite("times", times))
    if grid.ndim != 1 or np.any(np.diff(grid) <= 0.0):
        raise InputError(f"times must increase strictly, got {times!r}")
    if grid.size and duration < grid[-1] <= duration * (1.0 + 1e-12):  # by roundoff
        grid = np.append(grid[:-1], duration)
    if grid.size and (grid[0] < 0.0 or grid[-1] > duration):
        raise InputError(f"times must lie within [0, {duration!r}] s, got {grid[0]!r} to {grid[-1]!r}")
    return grid


def require_longest_step(max_step: float) -> None:
    """Raise InputError unless the longest step is positive; it may be infinite."""
    if not max_step > 0.0:
        raise InputError(f"max_step must be positive, got {max_step!r}")
