"""How far a rotor goes after something has begun to shake it at rest: rungs in ever shorter steps."""

from __future__ import annotations

from dataclasses import dataclass
from typing import NamedTuple

from ..answers import DISAGREEMENT, Found, WorkUnit
from ..ladders import C, CandidateRung
from ..model import Array, Reaction
from ..motion.transient.equal_steps import ORDER, MarchMotion, peak
from ..motion.transient.shaken_rotor import RestTangent, ShakenRotor, StatesAlong

STEPS = (48, 96, 192, 384, 768)
"""Steps over a turn of the nonlinear rungs."""

LINEAR_STEPS = 192
"""Those of the linear motion."""

SAMPLED = 48
"""States over a turn at which the defect is taken."""


class PeakMotion(NamedTuple):
    """A motion, as its estimate and the rung above it start from it.

    Attributes
    ----------
    motion : MarchMotion
    coarse : float [m]
        The peak in steps twice as long; nan where nobody needs it.
    steps : int
        Over a turn; 0 for the linear motion.
    """

    motion: MarchMotion
    coarse: float
    steps: int


@dataclass(frozen=True, kw_only=True)
class PeakRung(CandidateRung[C]):
    """The peak by one film, linear about the rest or nonlinear in so many steps over a turn.

    A rung adds `tangents`, `shaken`, `at_rest`, `grid`, `answer` and `estimate`.

    Attributes
    ----------
    steps : int
        Over a turn, at the highest speed; 0 for the linear motion.
    """

    steps: int

    @property
    def name(self) -> str:
        """Linear, or the number of steps, and the film."""
        return f"{f'nonlinear, {self.steps} steps' if self.steps else 'linear'}, {self.film.name}"

    @property
    def prior(self) -> float:
        """Order of magnitude of the error of the steps, and of the film."""
        return max(0.3 * self.film.prior, 3.0 / self.steps**2 if self.steps else 0.0)

    @property
    def refines(self) -> tuple[object, ...]:
        """The film, where there are steps."""
        return (self.film,) if self.steps else ()

    @property
    def tangents(self) -> WorkUnit:
        """One force with derivatives."""
        raise NotImplementedError

    @property
    def shaken(self) -> ShakenRotor:
        """The rotor on this film, and what shakes it."""
        raise NotImplementedError

    @property
    def at_rest(self) -> RestTangent:
        """The film at rest, by which the linear motion goes."""
        raise NotImplementedError

    def grid(self, steps: int) -> tuple[float, int]:
        """Return the length [s] and the number of steps, so many over a turn."""
        raise NotImplementedError

    def linear(self, steps: int) -> MarchMotion:
        """Return the motion by the film at rest."""
        return self.shaken.linear(self.at_rest, *self.grid(steps))

    def nonlinear(self, before: Found | None) -> Found:
        """Return the peak, and with it that in steps twice as long, which the rung below may have."""
        made = self.film.prepare()
        motion, calls = self.shaken.nonlinear(*self.grid(self.steps))
        if before is not None and self.tangents in before.work and 2 * before.solution.steps == self.steps:
            coarse = float(before.value)
        else:
            other, more = self.shaken.nonlinear(*self.grid(self.steps // 2))
            coarse, calls = peak(other.position), calls + more
        solved = PeakMotion(motion, coarse, self.steps)
        return Found(peak(motion.position), {self.tangents: calls, **made}, solved)

    def increment(self, found: Found) -> float:
        """Return the relative error of the steps by their order, with its sign."""
        return float((found.value - found.solution.coarse) / (2.0**ORDER - 1.0) / found.value)

    def stride(self, samples: int) -> int:
        """Return how many steps of the motion lie between samples, so many over a turn."""
        return max(1, (self.steps or LINEAR_STEPS) // samples)

    def by_defect(self, states: StatesAlong, rich: Reaction) -> tuple[Array, str]:
        """Return how much a richer film moves the rotor (2, n) [m], and why not to trust it."""
        own = self.shaken.reaction if self.steps else self.at_rest
        moved, apart = self.shaken.propagated(states, own, rich)
        doubt = f"the slopes of both films disagree on the error by {apart:.0%}: not linear"
        return moved, doubt if apart > DISAGREEMENT else ""
