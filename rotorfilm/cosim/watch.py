"""What is watched while a co-simulation runs: its distance from the limit, its local error, its chatter."""

from __future__ import annotations

import warnings
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass

import numpy as np
from numpy.lib.stride_tricks import sliding_window_view
from numpy.typing import ArrayLike, NDArray

from ..core import errors
from ..core.model import Array
from ..core.readable import Readable
from .coupling_loop import Loop, dominant_eigenvalue, squeeze_limit
from .partners import Partners, Record
from .schemes import Adaptive, Scheme, Tangents, extrapolation

# Finds, from the exchanged forces alone, whether a co-simulation chatters past its stability limit.
#
# Past the limit of an explicit coupling the force overshoots from step to step. The run seldom blows
# up: the film saturates the alternation, the sampled position may even stand still and the mean force
# stays plausible, so only the alternation itself tells. It is told from physics by three marks
# together: the second difference of the force reverses from step to step (a motion resolved by the
# macro step reverses it twice a period), it does so on, and it does not decay, as every alternation
# below the limit does.
#
# A journal thrown about passes the limit only here and there, in bursts that no such mark sees. What
# remains of them is a force that changes by a good part of itself within single steps: a run that
# holds it is coarse, whatever the cause.


WINDOW = 12
"""Consecutive steps that are judged together."""

REVERSALS = 10
"""Reversals within the window that make an alternation: past 1.4 times the limit it is not quite regular."""

REVERSED = -0.5
"""Cosine between consecutive second differences below which they count as reversed."""

SIGNIFICANT = 0.01
"""Amplitude of an alternation that matters, in root mean square forces of the run."""


JUMP = 0.25
"""Half a force increment, in root mean square forces of the run, that makes a step too long."""

JUMPS = 5
"""Such steps within a window that make a run coarse; a load that comes on at once makes one or two."""


@dataclass(frozen=True, kw_only=True)
class CouplingReport(Readable):
    """Reliability of a coupling, judged from the exchanged forces.

    Attributes
    ----------
    chatter : bool
        Whether the force alternates from step to step without decaying: the macro step is beyond the
        stability limit or too coarse for the motion, and the result is not valid.
    coarse : bool
        Whether, within some window, the force jumps by half its root mean square in many steps: the result is
        not valid either.
    onset : float or None [s]
        When the alternation, or else the coarse window, begins.
    amplitude : float [1]
        Largest amplitude of such an alternation, in root mean square forces of the run; 0 without one.
    hold_defect : float [1]
        Root mean square of half the force increments, in root mean square forces: the mean error of
        holding the force over a step. The order of magnitude of the coupling error in the force.
    """

    chatter: bool
    coarse: bool
    onset: float | None
    amplitude: float
    hold_defect: float


def inspect_coupling(time: ArrayLike, force: ArrayLike) -> CouplingReport:
    """Return what the exchanged forces say about the coupling.

    Parameters
    ----------
    time : array_like, shape (n,) [s]
        Communication points.
    force : array_like, shape (k, n) [N]
        The forces exchanged there.

    Raises
    ------
    InputError
        If a value is not finite or the shapes do not fit.
    """
    times, forces = errors.require_finite("time", time), errors.require_finite("force", force)
    if times.ndim != 1 or forces.ndim != 2 or forces.shape[1] != times.size:
        raise errors.InputError(f"force must have shape (k, {times.size}), got {forces.shape}")
    level = _rms(forces)
    # Second differences of an alternation of amplitude a have the size 4 a.
    swing = np.diff(forces, n=2, axis=1) / 4.0
    sustained, amplitudes = _sustained(swing)
    hit = np.flatnonzero(sustained & (amplitudes > SIGNIFICANT * level))
    jumps = np.flatnonzero(_jumps(forces, level) >= JUMPS)
    first = [*hit[:1], *jumps[:1]][:1]
    return CouplingReport(
        chatter=hit.size > 0,
        coarse=jumps.size > 0,
        onset=float(times[first[0]]) if first else None,
        amplitude=float(amplitudes[hit].max() / level) if hit.size else 0.0,
        hold_defect=0.5 * _rms(np.diff(forces, axis=1)) / level if level > 0.0 else 0.0,
    )


def is_calm(force: Array) -> bool:
    """Return whether forces (k, n) change too little from step to step for any mark of chatter."""
    return bool(calm_windows(force, force.shape[1])[0])


def calm_windows(force: Array, length: int) -> NDArray[np.bool_]:
    """Return the same for each window of so many forces (k, n), at least 3, shape (n - length + 1,)."""
    change = np.diff(force, axis=1)
    swing = np.abs(np.diff(change, axis=1)).max(axis=0)
    level = np.sqrt(np.mean(sliding_window_view(np.sum(force**2, axis=0), length), axis=1))
    # Of vectors, which are no longer than the square root of k times their largest component.
    longest = len(force) ** 0.5
    alternates = 0.25 * longest * _peaks(swing, length - 2) > SIGNIFICANT * level
    jumps = 0.5 * longest * _peaks(np.abs(change).max(axis=0), length - 1) > JUMP * level
    return np.asarray(~(alternates | jumps | ~np.isfinite(level)))


def _peaks(values: Array, length: int) -> Array:
    """Return the largest value of each window."""
    return np.asarray(sliding_window_view(values, length).max(axis=1))


def _sustained(swing: Array) -> tuple[NDArray[np.bool_], Array]:
    """Return, for each window of second differences, whether they alternate undamped, and how strongly."""
    if swing.shape[1] < WINDOW + 1:
        return np.zeros(0, dtype=bool), np.zeros(0)
    size = np.hypot.reduce(swing, axis=0)
    reversed_ = np.sum(swing[:, 1:] * swing[:, :-1], axis=0) < REVERSED * size[1:] * size[:-1]
    alternating = sliding_window_view(reversed_, WINDOW).sum(axis=1) >= REVERSALS
    sizes = sliding_window_view(size, WINDOW + 1)
    half = (WINDOW + 1) // 2
    early, late = np.mean(sizes[:, :half] ** 2, axis=1), np.mean(sizes[:, -half:] ** 2, axis=1)
    return alternating & (late >= early), np.sqrt(np.mean(sizes**2, axis=1))


def _jumps(forces: Array, level: float) -> NDArray[np.int_]:
    """Return how many steps of each window change the force by too much."""
    jump = 0.5 * np.hypot.reduce(np.diff(forces, axis=1), axis=0) > JUMP * level
    if not jump.size:
        return np.zeros(0, dtype=int)
    return sliding_window_view(jump, min(WINDOW, jump.size)).sum(axis=1)


def _rms(vectors: Array) -> float:
    """Return the root mean square length of vectors (k, n)."""
    return float(np.sqrt(np.mean(np.sum(vectors**2, axis=0)))) if vectors.shape[1] else 0.0


# What is watched while a co-simulation runs: its distance from the limit, its local error, its chatter.


EVERY = 8
"""Steps between two looks for chatter."""

LOOK_BACK = 4 * WINDOW
"""Steps that are looked at."""

CHECK = 8
"""Steps between two checks of the distance from the limit, each at the price of the films' derivatives."""

EARLY = 0.5
"""Share of the explicit limit beyond which a coupling is warned of."""

NEUTRAL = 1e-9
"""Growth and decay per macro step that are roundoff: what swings without damping neither grows nor decays."""


@dataclass(frozen=True, kw_only=True)
class CouplingWatch(Readable):
    """Distance of a coupling from its stability limit, and its local error.

    Attributes
    ----------
    local_error : float or None [1]
        Root mean square, over the steps, of the part of the force that the scheme did not predict, relative
        to the root mean square force: D of a linearly implicit scheme, the error of the extrapolation of an
        explicit one.
    explicit_ratio : float or None [1]
        Largest value of macro step * damping / local mass of the journal. The limit of an explicit coupling
        is between 0.5 and 2, depending on its degree. None if the derivatives are unknown.
    spectral_radius : float or None [1]
        Largest growth per macro step (spectral radius) of the coupled, linearized system.
    warnings : tuple of str
        Texts of the warnings.
    """

    local_error: float | None
    explicit_ratio: float | None
    spectral_radius: float | None
    warnings: tuple[str, ...]


@contextmanager
def quietly() -> Iterator[None]:
    """Silence the warnings of couplings that go to their limit on purpose."""
    with warnings.catch_warnings(action="ignore", category=errors.CouplingWarning):
        yield


class Watch:
    """Watches the communication points of one run, block by block.

    Parameters
    ----------
    partners : Partners
    scheme : Scheme
    macro_step : float [s]
    record : Record
        Where the points are.
    """

    def __init__(self, partners: Partners, scheme: Scheme, macro_step: float, record: Record) -> None:
        self._partners, self._scheme, self._macro_step = partners, scheme, macro_step
        self._record, self._seen = record, 0
        self._unforeseen, self._squares = 0.0, 0.0
        self._ratio: float | None = None
        self._radius: float | None = None
        self._warnings: list[str] = []
        self._checks: list[tuple[int, Loop]] = []
        self.checks = partners.differentiates
        """Whether the distance from the limit is known, and looked at in each `CHECK`-th step."""

    def check(self, tangents: Tangents | None) -> None:
        """Ask the partners at the latest point for what their distance from the limit follows from.

        The price is the films' derivatives, unless they are known.
        """
        point = self._record.count - 1
        if not self.checks or point % CHECK:
            return
        try:
            tangents = tangents or self._partners.tangents()
            linear = self._partners.linear_rotor(float(self._record.time[point]))
        except errors.RotorfilmError:
            linear = None
        if tangents is None or linear is None:
            self.checks = False
        else:
            self.checks = not np.any(linear.D)
            position, velocity = np.split(linear.C, 2)
            parts = linear.A, linear.B, position, velocity, tangents.stiffness, tangents.damping
            self.take([(point, Loop(*parts))])

    def take(self, checks: list[tuple[int, Loop]]) -> None:
        """Take communication points, and the linear loops there, from which the distances follow."""
        self._checks += checks if self.checks else []

    def alarm(self) -> int | None:
        """Look at the points since the last look; return the number of those before the forces alternate."""
        since, count = self._seen, self._record.count
        ends = range(max(WINDOW, since) // EVERY * EVERY + EVERY, count + 1, EVERY)
        found = next((end for end in self._restless(ends) if self._chatters(end)), None)
        self.look(count if found is None else found)
        return found

    def look(self, count: int) -> None:
        """Take account of the points before this one."""
        rows = slice(self._seen, count)
        if count > self._seen:
            later = count - max(self._seen, 1)
            self._unforeseen += float(np.sum(self._surprises()[:later] ** 2))
            self._squares += float(np.sum(self._record.force[rows] ** 2))
            self._seen = count
        self._measure([check for check in self._checks if check[0] < count])
        self._checks = []

    def result(self) -> CouplingWatch:
        """Return what was seen so far."""
        self.look(self._record.count)
        known = self._seen > 1 and self._squares > 0.0
        return CouplingWatch(
            local_error=float(np.sqrt(self._unforeseen / self._squares)) if known else None,
            explicit_ratio=self._ratio,
            spectral_radius=self._radius,
            warnings=tuple(self._warnings),
        )

    def _restless(self, ends: range) -> list[int]:
        """Return those numbers of points whose latest forces are not calm."""
        if not ends:
            return []
        early = [end for end in ends if end < LOOK_BACK]
        late = np.array(ends[len(early) :], dtype=int)
        found = [end for end in early if not is_calm(self._record.force[:end].T)]
        if late.size:
            first = late[0] - LOOK_BACK
            calm = calm_windows(self._record.force[first : late[-1]].T, LOOK_BACK)
            found += late[~calm[late - LOOK_BACK - first]].tolist()
        return found

    def _chatters(self, end: int) -> bool:
        """Return whether the latest of so many points alternate."""
        rows = slice(max(0, end - LOOK_BACK), end)
        report = inspect_coupling(self._record.time[rows], self._record.force[rows].T)
        return report.chatter or report.coarse

    def _surprises(self) -> Array:
        """Return the forces that the scheme did not foresee at the points since the last look."""
        record, first = self._record, max(self._seen, 1)
        rows, before = slice(first, record.count), slice(first - 1, record.count - 1)
        if not record.tangents.shape[1] or np.isnan(record.tangents[rows]).any():
            return unforeseen(
                record.time[: record.count], record.force[: record.count], first, self._scheme.order
            )
        stiffness, damping, by_speed = record.derivatives(rows)
        position, velocity, speed = (
            old - new for old, new in zip(record.motion(before), record.motion(rows), strict=True)
        )
        return np.asarray(
            record.force[before]
            - record.force[rows]
            + np.einsum("nij,nj->ni", stiffness, position)
            + np.einsum("nij,nj->ni", damping, velocity)
            - speed[:, None] * by_speed
        )

    def _measure(self, checks: Sequence[tuple[int, Loop]]) -> None:
        """Measure the distances from the limit."""
        if not checks:
            return
        felt = np.stack([loop.velocity @ loop.B for _, loop in checks])
        rates = np.linalg.eigvals(felt @ np.stack([loop.damping for _, loop in checks])).real.max(axis=1)
        for (point, loop), rate in zip(checks, rates.tolist(), strict=True):
            ratio = float(self._macro_step * rate)
            if self._ratio is None or ratio > 1.01 * self._ratio:
                self._ratio = ratio
                self._judge(loop, ratio, float(self._record.time[point]))

    def _judge(self, loop: Loop, ratio: float, t: float) -> None:
        try:
            limit = np.inf if isinstance(self._scheme, Adaptive) else squeeze_limit(self._scheme)
        except errors.ConvergenceError:  # the run itself will say so
            return
        if not np.isfinite(limit):
            return
        radius = abs(dominant_eigenvalue(loop, self._macro_step, self._scheme))
        self._radius = max(radius, self._radius or 0.0)
        itself = float(np.linalg.eigvals(loop.closed).real.max())
        if radius > 1.0 + NEUTRAL and itself * self._macro_step < -NEUTRAL:
            self._warn(
                f"at t = {t:.6g} s the coupling grows by a factor of {radius:.4g} per macro step, where "
                "rotor and film alone are stable: shorten macro_step or take scheme=SIExp3()"
            )
        elif ratio > EARLY * limit:
            self._warn(
                f"at t = {t:.6g} s macro_step * damping / local mass is {ratio:.3g}, near or beyond the "
                f"stability limit {limit:.3g} of {self._scheme.label}: shorten macro_step or take "
                "scheme=SIExp3()"
            )

    def _warn(self, message: str) -> None:
        if not self._warnings:
            errors.warn_user(message, errors.CouplingWarning)
        self._warnings.append(message)


def unforeseen(time: Array, force: Array, first: int, order: int) -> Array:
    """Return forces (n, m) at the points from the first on, less those extrapolated from before."""
    if first < order:
        parts = [force[first : first + 1] - _ahead(time, force, first, first + 1, first)]
        rest = unforeseen(time, force, first + 1, order) if first + 1 < len(time) else force[:0]
        return np.concatenate([*parts, rest])
    return np.asarray(force[first:] - _ahead(time, force, first, len(time), order))


def _ahead(time: Array, force: Array, first: int, end: int, order: int) -> Array:
    """Return the forces at some points that follow from so many before each."""
    moments = [time[first - k : end - k, None] for k in range(order, 0, -1)]
    values = [force[first - k : end - k] for k in range(order, 0, -1)]
    value, slope, curvature = extrapolation(moments, values)
    elapsed = time[first:end, None] - moments[-1]
    return np.asarray(value + elapsed * slope + elapsed**2 * curvature)
