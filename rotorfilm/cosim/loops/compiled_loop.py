"""The loop over macro steps in C (`native/master/couple.h`), for partners and schemes that it knows."""

from __future__ import annotations

from collections import Counter
from ctypes import addressof, byref
from time import perf_counter
from typing import Any

import numpy as np

from ...model import Array, Linearization
from ...native.layouts.master_structs import (
    HELD,
    INTEGRATED,
    LAWFUL,
    Call,
    CouplingStruct,
    Ended,
    RecordStruct,
    RotorStruct,
    StationStruct,
)
from ...native.library import master
from ...rotors.force_law import BASE_TIME, ForceLaw, law_inputs
from ...signals import FORCE_OUTPUTS, JOURNAL_INPUTS
from ..partners import Partners
from ..schemes.exponential import NODES, TO_POWERS
from ..watch import CHECK, Check, Watch
from .compiled_partners import CompiledPartner
from .plan import Plan
from .record import WORK, Record

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
        stations = (StationStruct * len(films))(*map(self._station, partners.films, films))
        self._kept.append(stations)
        self._struct = CouplingStruct(
            scheme=plan.scheme,
            degree=plan.degree,
            gentle=plan.gentle,
            third=plan.third,
            stations=len(films),
            rotor=addressof(self._driven),
            films=addressof(stations),
            record=RecordStruct(
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
        self._driven.mode, self._driven.x = INTEGRATED, self._held(x)
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

    def _rotor_struct(self) -> RotorStruct:
        rotor, record = self.rotor, self.record
        wiring, m = self._partners.wiring, record.size
        motion = [rotor.outputs[name] for name in (*wiring.position, *wiring.velocity)]
        lawful = [BASE_TIME, *(name for station in wiring.stations for name in law_inputs(station))]
        mode, driven = HELD, list(wiring.force)
        if set(lawful) <= set(rotor.inputs):
            mode, driven = LAWFUL, lawful
        room = max(
            master()["rf_rotor_work"](len(rotor.states), m), len(lawful), len(motion) + len(rotor.states)
        )
        struct = RotorStruct(
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

    def _station(self, station: str, film: CompiledPartner) -> StationStruct:
        slave, (_, feeds) = self._partners.films[station], self._partners.feeds[station]
        known = [(k, name) for k, name in enumerate(JOURNAL_INPUTS) if name in film.knowns]
        taken = [(name, place, source) for name, place, source in feeds if name in film.inputs]
        outputs = list(slave.outputs)
        return StationStruct(
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
