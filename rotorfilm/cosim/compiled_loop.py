"""Macro steps in C where rotor, films and scheme allow it, and what follows where one fails."""

from __future__ import annotations

from collections import Counter
from collections.abc import Mapping, Sequence
from ctypes import addressof, byref
from enum import IntEnum
from time import perf_counter
from typing import Any

import numpy as np

from ..core.errors import FmuError
from ..core.model import Array
from ..core.signals import FORCE_OUTPUTS, JOURNAL_INPUTS
from ..native.library import master
from ..native.structs import constant, structure
from ..rotors.force_law import BASE_TIME, ForceLaw, law_inputs
from . import schemes
from .coupling_loop import Loop
from .partners import WORK, Partners, Record, require_finite_outputs
from .slaves import NODES, TO_POWERS, Call, CompiledPartner, Integrated
from .watch import CHECK, Watch


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

FIRST_CHUNK, MOST_CHUNK = 32, 1024
"""Macro steps between two looks at a run."""

PATIENCE = 0.05
"""Longest chunk [s]: an interrupt waits for its end."""

EXTRA = 8
"""Most further points of a gentle start."""

TANGENTIAL: dict[type, int] = {schemes.SIExp: 0, schemes.SIExp3: 1, schemes.SIMemory: 2}
"""Points behind the latest one that laws of the films' tangents go through."""


class CompiledRun:
    """The macro steps of a run in C, in chunks, between steps in Python where the rotor needs them.

    Parameters
    ----------
    partners : Partners
        Partners that were started.
    rotor : CompiledPartner
    films : list of CompiledPartner
        Films in the order of the stations.
    plan : mapping of str to number
        The scheme; see `plan_of`.
    record : Record
    watch : Watch
    macro_step : float [s]
    points : ndarray [s]
        Points of the macro steps.
    """

    def __init__(
        self,
        partners: Partners,
        rotor: CompiledPartner,
        films: list[CompiledPartner],
        plan: Mapping[str, float],
        record: Record,
        watch: Watch,
        macro_step: float,
        points: Array,
    ) -> None:
        self._partners, self.rotor, self.films = partners, rotor, films
        self.record, self._watch, self._chunk = record, watch, FIRST_CHUNK
        self._pause, self._waited = 0, 1
        self._kept: list[Any] = [points]
        m, n = record.size, len(rotor.states)
        self._shapes = ((2 * m * m + m,), (n + 2 * m, n + m))
        most = (MOST_CHUNK + EXTRA) // CHECK + 2
        self._sensitivity = np.zeros((2 * m, m + 1))
        self._checked = np.zeros(most, dtype=np.int64)
        self._check_tangents = np.zeros((most, *self._shapes[0]))
        self._check_slopes = np.zeros((most, *self._shapes[1]))
        self._laws = np.zeros((MOST_CHUNK + EXTRA, 1 + 5 * m + 2 * m * m))
        self._driven = self._rotor_struct()
        stations = (structure("rf_station") * len(films))(*map(self._station, partners.films, films))
        self._kept.append(stations)
        self._struct = structure("rf_coupling")(
            **plan,
            stations=len(films),
            rotor=addressof(self._driven),
            films=addressof(stations),
            record=structure("rf_record")(
                m=m,
                columns=record.outputs.shape[1],
                position=self._ints(record.position_at),
                velocity=self._ints(record.velocity_at),
                speed=-1 if record.speed_at is None else record.speed_at,
                derived=record.tangents.shape[1] > 0,
            ),
            points=points.ctypes.data,
            macro_step=macro_step,
            every=CHECK,
            sensitivity=self._sensitivity.ctypes.data,
            kept=self._room(n),
            checked=self._checked.ctypes.data,
            check_tangents=self._check_tangents.ctypes.data,
            check_slopes=self._check_slopes.ctypes.data,
        )
        widest = max(len(film.inputs) for film in films) + 10
        self._struct.work = self._room(master()["rf_coupling_work"](byref(self._struct), widest))
        self._integrated = partners.rotor if isinstance(partners.rotor, Integrated) else None
        if self._integrated is not None:
            self._integrate(self._integrated)

    def _integrate(self, rotor: Integrated) -> None:
        """Have the rotor integrated: its state, nominal values, forces where its motion is asked for."""
        self._x, driven = rotor.state.copy(), self._driven
        driven.mode, driven.x = constant("RF_INTEGRATED"), self._held(self._x)
        driven.nominal = self._floats(rotor.nominals)
        driven.base = self._floats(rotor.base[self._partners.places[0]])
        driven.drive_refs = self._refs([self.rotor.inputs[name] for name in self._partners.wiring.force])

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
        record, rotor, count = self.record, self._integrated, self.record.count
        if rotor is not None:
            self._x[:] = rotor.state
            self.rotor.sync(t, self._x)
            self._driven.kink, self._driven.known = rotor.next_kink(t), 0
        ended = self._couple(step, t, min(self._chunk, steps - step))
        if rotor is not None:
            rotor.resume(float(record.time[record.count - 1]), self._x)
        self._tell_beyond()
        if ended is Ended.ROTOR_WAITING:
            # Longer each time, where no step was made in between.
            self._waited = min(2 * self._waited, MOST_PAUSE) if record.count == count else 1
            self._pause = self._waited
        elif ended not in (Ended.COUPLED, Ended.FULL):
            self._raise(ended, self._struct.t)
        return self._struct.step, self._struct.t

    def _couple(self, step: int, t: float, chunk: int) -> Ended:
        """Make a chunk of macro steps, and return why it ended."""
        c, record = self._struct, self.record
        record.require_room(chunk + EXTRA)
        self._bind()
        c.record.room = record.count + chunk + EXTRA  # what is kept of each point has no more
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
        return ended

    def _tell_beyond(self) -> None:
        """Have a model warn where its kernel was beyond the verified range."""
        for slave, partner in zip(self._partners.films.values(), self.films, strict=True):
            beyond = partner.beyond()
            if beyond is not None:
                slave.set(beyond)
                slave.get()

    def _raise(self, ended: Ended, t: float) -> None:
        """Raise what the partner that failed has to say: the rotor, or the film of this number."""
        who = self._struct.who
        rotor = who < 0
        slave = self._partners.rotor if rotor else list(self._partners.films.values())[who]
        partner = self.rotor if rotor else self.films[who]
        call, status = Call(partner.struct.failed), partner.struct.status
        if partner.own is not None and not rotor:
            slave.set(partner.inputs_now())
        if ended is not Ended.NOT_NUMBERS:
            slave.fail(call, status, t)
        require_finite_outputs("rotor" if rotor else "film", float(self._struct.reached), slave.get())
        raise FmuError(f"a partner failed in call {call.name} at t = {t:.9g} s with status {status}")

    def calls(self) -> list[dict[Call, int]]:
        """Return how often each function was called: of the rotor, then of the films."""
        return [dict(zip(Call, p.struct.calls, strict=True)) for p in (self.rotor, *self.films)]

    def _bind(self) -> None:
        """Tell where the arrays of the record are."""
        c, record = self._struct.record, self.record
        c.count = record.count
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
        rotor = slopes[:, :n, :n], slopes[:, :n, n:], slopes[:, n : n + m, :n], slopes[:, n + m :, :n]
        loops = map(Loop, *rotor, stiffness, damping)
        self._watch.take(list(zip(self._checked[: c.checks].tolist(), loops, strict=True)))
        if self._partners.laws is not None:
            rows = self._laws[: self.record.count - first].copy()
            self._partners.laws += [_law(row, m) for row in rows]

    def _rotor_struct(self) -> Any:
        rotor, record = self.rotor, self.record
        wiring, m = self._partners.wiring, record.size
        motion = [rotor.outputs[name] for name in (*wiring.position, *wiring.velocity)]
        lawful = [BASE_TIME, *(name for station in wiring.stations for name in law_inputs(station))]
        takes = set(lawful) <= set(rotor.inputs)
        mode, driven = ("RF_LAWFUL", lawful) if takes else ("RF_HELD", list(wiring.force))
        n = len(rotor.states)
        room = max(master()["rf_rotor_work"](n, m), len(lawful), len(motion) + n)
        return structure("rf_rotor")(
            partner=addressof(rotor.struct),
            mode=constant(mode),
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
    force, slope, curvature, K, C, q, v = np.split(row[1:], np.cumsum([m, m, m, m * m, m * m, m]))
    return ForceLaw(float(row[0]), force, slope, curvature, K.reshape(m, m), C.reshape(m, m), q, v)


def plan_of(scheme: schemes.Scheme) -> dict[str, float] | None:
    """Return how the loop in C takes a scheme (couple.h); None of one that it does not know."""
    kind = type(scheme)
    if isinstance(scheme, schemes.GaussSeidel | schemes.Jacobi) and kind in (
        schemes.GaussSeidel,
        schemes.Jacobi,
    ):
        named = "RF_JACOBI" if kind is schemes.Jacobi else "RF_GAUSS_SEIDEL"
        return {"scheme": constant(named), "degree": scheme.degree, "gentle": scheme.degree > 1}
    if kind in TANGENTIAL:
        gentle = kind is schemes.SIMemory
        return {"scheme": constant("RF_TANGENTIAL"), "behind": TANGENTIAL[kind], "gentle": gentle}
    if isinstance(scheme, schemes.Newton) and kind is schemes.Newton:
        most = min(scheme.most, 2**31 - 1)
        return {"scheme": constant("RF_NEWTON"), "tolerance": scheme.tolerance, "most": most}
    if isinstance(scheme, schemes.Adaptive) and kind is schemes.Adaptive:
        own = plan_of(scheme.scheme) if type(scheme.scheme) in (schemes.SIExp, schemes.SIExp3) else None
        return own and {**own, "adaptive": 1, "tolerance": scheme.tolerance}
    return None


def compiled_run(
    partners: Partners,
    scheme: schemes.Scheme,
    record: Record,
    watch: Watch,
    macro_step: float,
    points: Sequence[float],
    gentle: bool,
) -> CompiledRun | None:
    """Return the macro steps in C of partners that were started; None where one needs Python."""
    plan = plan_of(scheme)
    if plan is None:
        return None
    slaves = [partners.rotor, *partners.films.values()]
    found = [slave.compiled(film=number > 0) for number, slave in enumerate(slaves)]
    known = [partner for partner in found if partner is not None]
    if len(known) < len(found) or (scheme.needs.rollback and not all(one.goes_back for one in known)):
        return None
    plan |= {"gentle": True} if gentle else {}
    return CompiledRun(partners, known[0], known[1:], plan, record, watch, macro_step, np.array(points))
