"""What the text of Panovko (2011), section 4, says of its figures, asked of a solution of the cases."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from enum import StrEnum
from itertools import pairwise
from typing import NamedTuple

import numpy as np

from ...bearings.contact import AdaptiveSteps, ContactRun, ContactState, FixedSteps, PointContact
from .motion_features import amplitude, decay_time, overshoot, unrest, wave_height, wave_speed

STEP = {"amplitude": 0.7, "start": 1.0, "end": 20.0}
"""Load of case 4.2."""

SWEEP = (1.0, 2.0, 5.0)
"""Frequencies of case 4.3."""

PUBLISHED_REST = (0.1761, -1.793)
"""H0 and delta of the stationary contact, with the sign of delta that the paper lost."""

PERIOD = 2.0 * np.pi


class CaseSection(StrEnum):
    """Sections of the paper whose figures are redrawn, case 4.3 by its two amplitudes."""

    FREE = "4.1"
    STEPPED = "4.2"
    SLOW = "4.3, A = 0.2"
    FAST = "4.3, A = 0.5"


class Claim(NamedTuple):
    """A sentence of the text, what to measure, the numbers of one solution, and whether they bear it out."""

    section: str
    text: str
    measure: str
    numbers: tuple[float, ...]
    holds: bool


class Statement(NamedTuple):
    """A sentence, what was measured, by the three solutions, and the verdict."""

    section: str
    text: str
    measure: str
    published: str
    same_grid: str
    converged: str
    verdict: str

    @classmethod
    def judged(cls, published: Claim, same_grid: Claim, converged: Claim) -> Statement:
        """Return the row of a table from the three answers to one sentence."""
        if converged.holds:
            verdict = "confirmed"
        elif not published.holds:
            verdict = "not confirmed"
        elif same_grid.holds:
            verdict = "artefact of the grid"
        else:
            verdict = "artefact of numerical damping"
        answers = (published, same_grid, converged)
        first, second, third = (_written(answer.numbers) for answer in answers)
        return cls(published.section, published.text, published.measure, first, second, third, verdict)


class SolutionKind(StrEnum):
    """The ways to solve the cases."""

    PUBLISHED = "published"
    SAME_GRID = "same grid"
    CONVERGED = "converged"


class CaseSolution(NamedTuple):
    """One way to solve the cases: which, contact, its rest under f = 1 and under f = 1.7, and its steps."""

    kind: SolutionKind
    contact: PointContact
    rest: ContactState
    pressed: ContactState
    control: AdaptiveSteps | FixedSteps


def statements(runs: Mapping[CaseSection, list[ContactRun]], solution: CaseSolution) -> list[Claim]:
    """Return what a solution has to say on every sentence, from its runs by section."""
    return [
        *_at_rest(solution),
        *_free(runs[CaseSection.FREE], solution),
        *_stepped(runs[CaseSection.STEPPED], solution),
        *_driven(runs[CaseSection.SLOW], runs[CaseSection.FAST]),
    ]


def _claim(
    section: str,
    text: str,
    measure: str,
    numbers: Sequence[float],
    holds: Callable[[Sequence[float]], bool],
) -> Claim:
    return Claim(section, text, measure, tuple(numbers), bool(holds(numbers)))


def _at_rest(solution: CaseSolution) -> list[Claim]:
    found = (solution.rest.central_film, solution.rest.delta)

    def near(row: Sequence[float]) -> bool:
        return all(abs(a / b - 1.0) < 0.03 for a, b in zip(row, PUBLISHED_REST, strict=True))

    return [_claim("4", "H0 = 0.1761 and delta = -1.793 at rest, to 3 %", "H0, delta", found, near)]


def _free(runs: list[ContactRun], solution: CaseSolution) -> list[Claim]:
    rest, x = solution.rest, solution.contact.grid.x
    swing = [overshoot(run, rest.delta) for run in runs]
    decay = [decay_time(run, rest.delta) for run in runs[1:]]
    waves = runs[2].snapshots
    heights = [wave_height(state, rest, x) for state in waves[1:3]]
    return [
        _claim("4.1", "without inertia delta goes back to rest without oscillation", "overshoot, W = 0",
               swing[:1], lambda row: row[0] < 0.02),
        _claim("4.1", "with inertia it oscillates about rest and decays", "overshoot, W = 0.5, 1",
               swing[1:], lambda row: min(row) > 0.1),
        _claim("4.1", "the decay takes longer with larger W", "decay times, W = 0.5, 1",
               decay, lambda row: row[1] > 1.05 * row[0]),
        _claim("4.1", "almost twice as long for W = 1 as for W = 0.5", "ratio of decay times",
               [decay[1] / decay[0]], lambda row: 1.7 < row[0] < 2.3),
        _claim("4.1", "a modulation of the film moves along the contact at the rolling speed, to 10 %",
               "speed of its crest; range at t = 0.6, 0.8", [wave_speed(waves, rest, x), *heights],
               lambda row: abs(row[0] - 1.0) < 0.1),
    ]  # fmt: skip


def _stepped(runs: list[ContactRun], solution: CaseSolution) -> list[Claim]:
    pressed, start, end = solution.pressed, STEP["start"], STEP["end"]
    swing = [overshoot(run, pressed.delta, start, end) for run in runs]
    decay = [decay_time(run, pressed.delta, start + 0.5, end) for run in runs]
    left = [amplitude(run, end - 4.0, end) / amplitude(run, start, start + 4.0) for run in runs]
    peaks = [float(np.max(solution.rest.delta - run.delta)) for run in runs]
    films = [amplitude(run, start, end, "central_film") for run in runs]
    return [
        _claim("4.2", "a load step causes decaying oscillations about the new rest",
               "overshoot, W = 0.3, 1, 3", swing, lambda row: min(row) > 0.1),
        _claim("4.2", "their decay time grows with W", "decay times, W = 0.3, 1, 3", decay, _rising),
        _claim("4.2", "for W = 0.3 they have decayed wholly before the load falls, for W = 3 not",
               "amplitude left, W = 0.3, 3", [left[0], left[2]], lambda row: row[0] < 0.05 < row[1]),
        _claim("4.2", "amplitudes of delta fall markedly with W", "largest change of delta", peaks, _falling),
        _claim("4.2", "amplitudes of H0 fall markedly with W", "half the range of H0", films, _falling),
    ]  # fmt: skip


def _driven(slow: list[ContactRun], fast: list[ContactRun]) -> list[Claim]:
    early = [unrest(run, PERIOD, 30.0) for run in slow]
    late = [unrest(run, PERIOD / w, run.time[-1]) for run, w in zip(fast, SWEEP, strict=True)]
    rows = {
        name: [[amplitude(run, run.time[-1] - 2.0 * PERIOD, name=name) for run in part]
               for part in (slow, fast)]
        for name in ("delta", "central_film")
    }  # fmt: skip
    (delta_W, delta_w), (film_W, film_w) = rows["delta"], rows["central_film"]
    return [
        _claim("4.3", "the oscillations become steady and periodic, A = 0.2: by t = 30",
               "change over a period, W = 0.01, 0.1, 1", early, lambda row: max(row) < 0.05),
        _claim("4.3", "the same for A = 0.5, W = 1: at last", "change over a period, omega = 1, 2, 5",
               late, lambda row: max(row) < 0.1),
        _claim("4.3", "the amplitude of delta falls with W", "amplitude, W = 0.01, 0.1, 1",
               delta_W, _falling),
        _claim("4.3", "the amplitude of H0 falls with W", "amplitude, W = 0.01, 0.1, 1", film_W, _falling),
        _claim("4.3", "omega = 2 has the largest amplitude of delta", "amplitude, omega = 1, 2, 5",
               delta_w, _second_largest),
        _claim("4.3", "omega = 2 has the largest amplitude of H0", "amplitude, omega = 1, 2, 5",
               film_w, _second_largest),
        _claim("4.3", "the amplitude does not depend on omega monotonically", "of H0, omega = 1, 2, 5",
               film_w, lambda row: not (_falling(row) or _rising(row))),
    ]  # fmt: skip


def _written(numbers: Sequence[float]) -> str:
    return ", ".join(f"{value:.3g}" if abs(value) < 1.0 else f"{value:.4g}" for value in numbers)


def _falling(row: Sequence[float]) -> bool:
    """Whether numbers fall, by more than the errors of the solution."""
    return all(later < 0.98 * earlier for earlier, later in pairwise(row))


def _rising(row: Sequence[float]) -> bool:
    return all(later > 1.02 * earlier for earlier, later in pairwise(row))


def _second_largest(row: Sequence[float]) -> bool:
    """Whether the second number is the largest."""
    return row[1] == max(row)
