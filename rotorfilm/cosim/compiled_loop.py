"""Macro steps in C where rotor, films and scheme allow it, and what follows where one fails."""

from __future__ import annotations

from collections import Counter
from collections.abc import Sequence
from ctypes import addressof, byref
from dataclasses import dataclass
from enum import IntEnum
from time import perf_counter
from typing import Any, NamedTuple

import numpy as np

from ..core.errors import FmuError, UndefinedDerivativeError
from ..core.model import Array, Linearization, Reaction
from ..core.results import Trajectory
from ..core.signals import FORCE_OUTPUTS, JOURNAL_INPUTS
from ..native.library import master
from ..native.structs import constant, structure
from ..rotors.force_law import BASE_TIME, ForceLaw, law_inputs
from .partner_interface import Bench, Needs, Sample, StationMotion, Tangents
from .partners import WORK, Partners, Record, require_finite_outputs
from .schemes import MEMORY, NODES, TO_POWERS, GaussSeidel, Jacobi, Scheme, SIExp, SIExp3, started
from .slaves import Call, Compiled, CompiledPartner, Integrated, KernelPartner, Slave
from .watch import CHECK, Check, Watch


class Ended(IntEnum):
    """rf_coupled of couple.h."""

    COUPLED = 0
    ROTOR_FAILED = 1
    FILM_FAILED = 2
    NOT_NUMBERS = 3
    ROTOR_WAITING = 4
    FULL = 5


MOST_PAUSE = 64
"""Longest pause, in macro steps, after the rotor could not be integrated in C."""


class CompiledRun:
    """The macro steps of a run in C, between steps in Python where the rotor needs them.

    Parameters
    ----------
    loop : CompiledLoop
    partners : Partners
    """

    def __init__(self, loop: CompiledLoop, partners: Partners) -> None:
        self.loop, self._partners = loop, partners
        rotor = partners.rotor
        self._integrated = rotor if isinstance(rotor, Integrated) else None
        self._pause, self._waited = 0, 1
        if self._integrated is not None:
            self._x, base = self._integrated.state.copy(), self._integrated.base[partners.places.force]
            loop.integrate(self._x, self._integrated.nominals, base)

    def rests(self) -> bool:
        """Whether the next macro step is one in Python."""
        self._pause -= 1
        return self._pause >= 0

    def advance(self, step: int, t: float, steps: int) -> tuple[int, float]:
        """Go on from a macro step, in which the time t [s] is reached, by a chunk, to this one at most.

        Returns
        -------
        step : int
            Macro steps done.
        t : float [s]

        Raises
        ------
        FilmContactError, FmuError
            As the partner that failed says it.
        """
        if self._integrated is not None:
            self._x[:] = self._integrated.state
            self.loop.prepare(t, self._x, self._integrated.next_kink(t))
        count = self.loop.record.count
        step, t, ended = self.loop.advance(step, t, steps)
        if self._integrated is not None:
            self._integrated.resume(float(self.loop.record.time[self.loop.record.count - 1]), self._x)
        self._tell_beyond()
        if ended is Ended.ROTOR_WAITING:
            # Longer each time, where no step was made in between.
            idle = self.loop.record.count == count
            self._waited = min(2 * self._waited, MOST_PAUSE) if idle else 1
            self._pause = self._waited
        elif ended not in (Ended.COUPLED, Ended.FULL):
            self._raise(ended, t)
        return step, t

    def _tell_beyond(self) -> None:
        """Have a model warn where its kernel was beyond the verified range."""
        for slave, partner in self._kernels():
            beyond = partner.beyond()
            if beyond is not None:
                slave.set(beyond)
                slave.get()

    def _kernels(self) -> list[tuple[Slave, KernelPartner]]:
        films = zip(self._partners.films.values(), self.loop.films, strict=True)
        return [(slave, own) for slave, own in films if isinstance(own, KernelPartner)]

    def _raise(self, ended: Ended, t: float) -> None:
        """Raise what the partner that failed has to say."""
        who, call, status = self.loop.failure()
        rotor = who < 0
        slave = self._partners.rotor if rotor else list(self._partners.films.values())[who]
        partner = self.loop.rotor if rotor else self.loop.films[who]
        if isinstance(partner, KernelPartner) and not rotor:
            slave.set(partner.inputs_now())
        if ended is not Ended.NOT_NUMBERS and isinstance(slave, Compiled):
            slave.fail(call, status, t)
        require_finite_outputs("rotor" if rotor else "film", self.loop.reached, slave.get())
        raise FmuError(f"a partner failed in call {call.name} at t = {t:.9g} s with status {status}")


def compiled_run(
    partners: Partners,
    scheme: Scheme,
    record: Record,
    watch: Watch,
    macro_step: float,
    points: Sequence[float],
) -> CompiledRun | None:
    """Return the macro steps in C of partners that were started; None where one needs Python."""
    plan = plan_of(scheme)
    slaves = [partners.rotor, *partners.films.values()]
    if plan is None or not all(isinstance(slave, Compiled) for slave in slaves):
        return None
    found = [slave.compiled(film=number > 0) for number, slave in enumerate(slaves)]  # type: ignore[attr-defined]
    if any(partner is None for partner in found):
        return None
    rotor, *films = found
    times: Array = np.array(points)
    loop = CompiledLoop(partners, rotor, films, plan, record, watch, macro_step, times)
    return CompiledRun(loop, partners)


# The loop over macro steps in C (`native/master/couple.h`), for partners and schemes that it knows.


FIRST_CHUNK, MOST_CHUNK = 32, 1024
"""Macro steps between two looks at a run."""

PATIENCE = 0.05
"""Longest chunk [s]: an interrupt waits for its end."""

EXTRA = 8
"""Most further points of a gentle start."""


class CompiledLoop:
    """The loop over macro steps of partners that were started.

    Parameters
    ----------
    partners : Partners
    rotor : CompiledPartner
    films : list of CompiledPartner
        In the order of the stations.
    plan : Plan
    record : Record
    watch : Watch
    macro_step : float [s]
    points : ndarray [s]
        Of the macro steps.
    """

    def __init__(
        self,
        partners: Partners,
        rotor: CompiledPartner,
        films: list[CompiledPartner],
        plan: Plan,
        record: Record,
        watch: Watch,
        macro_step: float,
        points: Array,
    ) -> None:
        self._partners, self.rotor, self.films = partners, rotor, films
        self.record, self._watch, self._chunk = record, watch, FIRST_CHUNK
        self._kept: list[Any] = [points]
        m, n = record.size, len(rotor.states)
        self._shapes = ((2 * m * m + m,), (n + 2 * m, n + m))
        most = (MOST_CHUNK + EXTRA) // CHECK + 2
        self._checked = np.zeros(most, dtype=np.int64)
        self._check_tangents = np.zeros((most, *self._shapes[0]))
        self._check_slopes = np.zeros((most, *self._shapes[1]))
        self._laws = np.zeros((MOST_CHUNK + EXTRA, 1 + 5 * m + 2 * m * m))
        self._driven = self._rotor_struct()
        stations = (structure("rf_station") * len(films))(*map(self._station, partners.films, films))
        self._kept.append(stations)
        self._struct = structure("rf_coupling")(
            scheme=plan.scheme,
            degree=plan.degree,
            gentle=plan.gentle,
            third=plan.third,
            stations=len(films),
            rotor=addressof(self._driven),
            films=addressof(stations),
            record=structure("rf_record")(
                m=m,
                columns=record.outputs.shape[1],
                position=self._ints(record.at.position),
                velocity=self._ints(record.at.velocity),
                speed=-1 if record.speed_at is None else record.speed_at,
                derived=record.tangents.shape[1] > 0,
            ),
            points=points.ctypes.data,
            macro_step=macro_step,
            every=CHECK,
            checked=self._checked.ctypes.data,
            check_tangents=self._check_tangents.ctypes.data,
            check_slopes=self._check_slopes.ctypes.data,
        )
        widest = max(len(film.inputs) for film in films) + 10
        self._struct.work = self._room(master()["rf_coupling_work"](byref(self._struct), widest))

    def integrate(self, x: Array, nominal: Array, base: Array) -> None:
        """Have the rotor integrated: its state, nominal values, forces where its motion is asked for."""
        self._driven.mode, self._driven.x = constant("RF_INTEGRATED"), self._held(x)
        self._driven.nominal, self._driven.base = self._floats(nominal), self._floats(base)
        names = self._partners.wiring.force
        self._driven.drive_refs = self._refs([self.rotor.inputs[name] for name in names])

    def prepare(self, t: float, x: Array, kink: float) -> None:
        """Take time [s] and state of a rotor that is integrated, and the time of its next kink."""
        self.rotor.sync(t, x)
        self._driven.kink, self._driven.known = kink, 0

    @property
    def reached(self) -> float:
        """End of the step that failed [s]."""
        return float(self._struct.reached)

    def advance(self, step: int, t: float, steps: int) -> tuple[int, float, Ended]:
        """Go on from a macro step, in which the time t [s] is reached, by a chunk, to this one at most.

        Returns
        -------
        step : int
            Macro steps done.
        t : float [s]
        ended : Ended
            Why it ended.
        """
        c, record, chunk = self._struct, self.record, min(self._chunk, steps - step)
        record.require_room(chunk + EXTRA)
        self._bind()
        c.step, c.t, c.checks = step, t, 0
        work = self._partners.work
        for k, name in enumerate(WORK):
            c.done[k] = work[name]
        first, begun = record.count, perf_counter()
        ended = Ended(master()["rf_couple"](byref(c), step + chunk))
        taken = perf_counter() - begun
        if taken < 0.5 * PATIENCE:
            self._chunk = min(2 * self._chunk, MOST_CHUNK)
        elif taken > PATIENCE:
            self._chunk = max(1, self._chunk // 2)
        record.count = c.record.count
        self._partners.work = Counter(dict(zip(WORK, c.done, strict=True)))
        self._hand_over(first)
        return c.step, c.t, ended

    def failure(self) -> tuple[int, Call, int]:
        """Return who failed, -1 for the rotor or the number of a film, in which call, with which status."""
        who = self._struct.who
        struct = (self.rotor if who < 0 else self.films[who]).struct
        return who, Call(struct.failed), struct.status

    def calls(self) -> list[dict[Call, int]]:
        """Return how often each function was called: of the rotor, then of the films."""
        return [dict(zip(Call, p.struct.calls, strict=True)) for p in (self.rotor, *self.films)]

    def _bind(self) -> None:
        """Tell where the arrays of the record are."""
        c, record = self._struct.record, self.record
        c.count, c.room = record.count, len(record.time)
        for name in ("time", "outputs", "force", "tangents", "work"):
            setattr(c, name, getattr(record, name).ctypes.data)
        if self._partners.laws is not None:
            # The first row is that of the latest point.
            offset = (record.count - 1) * self._laws[0].nbytes
            self._struct.laws = self._laws.ctypes.data - offset
        self._struct.checking = self._watch.checks

    def _hand_over(self, first: int) -> None:
        """Give what was met to those who keep it."""
        c, m, n = self._struct, self.record.size, len(self.rotor.states)
        tangents, slopes = self._check_tangents[: c.checks].copy(), self._check_slopes[: c.checks].copy()
        if not c.checking or np.any(slopes[:, n:, n:]):
            self._watch.checks = False
        square = (c.checks, m, m)
        stiffness = tangents[:, : m * m].reshape(square)
        damping = tangents[:, m * m : 2 * m * m].reshape(square)
        parts = (slopes[:, :n, :n], slopes[:, :n, n:], slopes[:, n:, :n], slopes[:, n:, n:])
        linear = map(Linearization, *parts)
        self._watch.take(list(map(Check, self._checked[: c.checks].tolist(), stiffness, damping, linear)))
        if self._partners.laws is not None:
            rows = self._laws[: self.record.count - first].copy()
            self._partners.laws += [_law(row, m) for row in rows]

    def _rotor_struct(self) -> Any:
        rotor, record = self.rotor, self.record
        wiring, m = self._partners.wiring, record.size
        motion = [rotor.outputs[name] for name in (*wiring.position, *wiring.velocity)]
        lawful = [BASE_TIME, *(name for station in wiring.stations for name in law_inputs(station))]
        mode, driven = constant("RF_HELD"), list(wiring.force)
        if set(lawful) <= set(rotor.inputs):
            mode, driven = constant("RF_LAWFUL"), lawful
        room = max(
            master()["rf_rotor_work"](len(rotor.states), m), len(lawful), len(motion) + len(rotor.states)
        )
        struct = structure("rf_rotor")(
            partner=addressof(rotor.struct),
            mode=mode,
            stations=len(wiring.stations),
            outputs=len(record.rotor),
            output_refs=self._refs([rotor.outputs[name] for name in record.rotor]),
            motion_refs=self._refs(motion),
            drive_refs=self._refs([rotor.inputs[name] for name in driven]),
            rows=self._refs([*rotor.rates, *motion]),
            columns=self._refs([*rotor.states, *(rotor.knowns[name] for name in wiring.force)]),
            nodes=self._floats(NODES),
            to_powers=self._floats(TO_POWERS),
            kink=np.inf,
            slopes=self._room(self._shapes[1][0] * self._shapes[1][1]),
            work=self._room(room),
        )
        return struct

    def _station(self, station: str, film: CompiledPartner) -> Any:
        slave, (_, feeds) = self._partners.films[station], self._partners.feeds[station]
        known = [(k, name) for k, name in enumerate(JOURNAL_INPUTS) if name in film.knowns]
        taken = [(name, place, source) for name, place, source in feeds if name in film.inputs]
        outputs = list(slave.outputs)
        return structure("rf_station")(
            partner=addressof(film.struct),
            inputs=len(taken),
            outputs=len(outputs),
            known=len(known),
            input_refs=self._refs([film.inputs[name] for name, _, _ in taken]),
            output_refs=self._refs([film.outputs[name] for name in outputs]),
            feeds=self._ints(
                [self.record.rotor.index(source) if k is None else -1 - k for _, k, source in taken]
            ),
            force_refs=self._refs([film.outputs[name] for name in FORCE_OUTPUTS]),
            known_refs=self._refs([film.knowns[name] for _, name in known]),
            knowns=self._ints([k for k, _ in known]),
            force_at=tuple(outputs.index(name) for name in FORCE_OUTPUTS),
        )

    def _refs(self, values: list[int]) -> int:
        return self._held(np.array(values, dtype=np.uint32))

    def _ints(self, values: list[int]) -> int:
        return self._held(np.array(values, dtype=np.int32))

    def _floats(self, values: Array) -> int:
        return self._held(np.ascontiguousarray(values, dtype=float))

    def _room(self, count: int) -> int:
        return self._held(np.zeros(count))

    def _held(self, values: Any) -> int:
        self._kept.append(values)
        return int(values.ctypes.data)


def _law(row: Array, m: int) -> ForceLaw:
    """Return the force law that the loop was driven by; see law.h."""
    sizes = np.cumsum([m, m, m, m * m, m * m, m])
    force, slope, curvature, stiffness, damping, position, velocity = np.split(row[1:], sizes)
    square = (m, m)
    return ForceLaw(
        float(row[0]),
        force,
        slope,
        curvature,
        stiffness.reshape(square),
        damping.reshape(square),
        position,
        velocity,
    )


# Which schemes the loop in C knows, and as what.


class Plan(NamedTuple):
    """A scheme as the loop in C knows it; see couple.h."""

    scheme: int
    degree: int = 0
    gentle: bool = False
    third: bool = False


def plan_of(scheme: Scheme) -> Plan | None:
    """Return how the loop in C takes a scheme; None if it does not, as those that go back."""
    if type(scheme) is Starting:
        inner = plan_of(scheme.scheme)
        return None if inner is None else inner._replace(gentle=True)
    if type(scheme) is GaussSeidel or type(scheme) is Jacobi:
        return Plan(int(type(scheme) is Jacobi), scheme.degree, scheme.degree > 1)
    if type(scheme) is SIExp or type(scheme) is SIExp3:
        return Plan(2, third=type(scheme) is SIExp3)
    return None


# Schemes on a motion known beforehand: the force laws that they would have there.


@dataclass(frozen=True, kw_only=True)
class Starting:
    """A scheme that begins with short steps, as parabolas do, so that all schemes find their points in it.

    Parameters
    ----------
    scheme : Scheme
    """

    scheme: Scheme

    @property
    def order(self) -> int:
        """Order of convergence in the macro step."""
        return self.scheme.order

    @property
    def label(self) -> str:
        """Its name in print."""
        return self.scheme.label

    @property
    def needs(self) -> Needs:
        """What it asks of its partners."""
        return self.scheme.needs

    def step(self, bench: Bench, history: Sequence[Sample], t: float, dt: float) -> Sample:
        """Advance by one macro step, at the start by a part of it; see `Scheme`."""
        return self.scheme.step(bench, history, t, started(history, 2, dt))


class _Replay:
    """A `Bench` on which a scheme is given a motion known beforehand, to see its force law."""

    def __init__(self, following: Sample) -> None:
        self._following = following
        self.law: ForceLaw | None = None

    def drive(self, t: float, dt: float, law: ForceLaw) -> StationMotion:
        """Keep the law; the motion is the known one."""
        self.law = law
        return self._following.motion

    def evaluate(self, t: float, dt: float, motion: StationMotion, derive: bool) -> Sample:
        """Return the known forces."""
        return self._following

    def sensitivity(self, t: float, dt: float) -> Array:
        """Not asked for by the schemes here."""
        raise NotImplementedError

    def save(self) -> None:
        """Do nothing: no scheme here goes back."""

    def restore(self, state: None) -> None:
        """Do nothing."""

    def release(self, state: None) -> None:
        """Do nothing."""


def samples_of(reaction: Reaction, run: Trajectory, speed: float) -> list[Sample]:
    """Return the communication points of a motion at constant speed [rad/s], with the films' derivatives."""
    time, q, v = run.time, run.position, run.velocity
    forces = reaction.force(q, v, np.full(time.size, speed))
    try:
        slopes = reaction.jacobian(q, v, np.full(time.size, speed))
    except UndefinedDerivativeError:  # a damper at rest, where the schemes too go without
        moving = reaction.jacobian(q[:, 1:], v[:, 1:], np.full(time.size - 1, speed))
        slopes = np.concatenate([np.zeros((2, 5, 1)), moving], axis=2)
    return [
        Sample(
            float(time[n]),
            StationMotion(q[:, n], v[:, n], speed, {}),
            forces[:, n],
            Tangents(-slopes[:, :2, n], -slopes[:, 2:4, n], slopes[:, 4, n]),
            {},
        )
        for n in range(time.size)
    ]


def laws_on(samples: Sequence[Sample], scheme: Scheme) -> list[ForceLaw]:
    """Return the force laws of a scheme on a known motion."""
    laws = []
    for n in range(len(samples) - 1):
        bench, now = _Replay(samples[n + 1]), samples[n]
        length = samples[n + 1].time - now.time
        scheme.step(bench, samples[max(0, n + 1 - MEMORY) : n + 1], now.time, length)
        assert bench.law is not None  # every scheme drives the rotor
        laws.append(bench.law)
    return laws
