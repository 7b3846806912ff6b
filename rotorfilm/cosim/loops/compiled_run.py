"""Macro steps in C where rotor, films and scheme allow it, and what follows where one fails."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from ...errors import FmuError
from ...model import Array
from ...native.layouts.master_structs import Ended
from ..partners import Partners, require_finite_outputs
from ..schemes.scheme import Scheme
from ..slaves import Compiled, Integrated, Slave
from ..watch import Watch
from .compiled_loop import CompiledLoop
from .compiled_partners import KernelPartner
from .plan import plan_of
from .record import Record

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
