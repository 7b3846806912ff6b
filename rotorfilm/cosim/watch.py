"""What is watched while a co-simulation runs: its distance from the limit, its local error, its chatter."""

from __future__ import annotations

import warnings
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from ..errors import ConvergenceError, CouplingWarning, RotorfilmError, warn_user
from ..model import Array, Linearization
from ..readable.result import Readable
from .bench import Tangents
from .chatter import WINDOW, calm_windows, inspect_coupling, is_calm
from .coupling_loop import Loop, dominant_eigenvalue, squeeze_limit
from .loops.record import Record
from .partners import Partners
from .schemes.adaptive import Adaptive
from .schemes.scheme import Scheme, extrapolation

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
    """How far a coupling was from its limit, and its local error.

    Attributes
    ----------
    local_error : float or None [1]
        Root mean square, over the steps, of the force that the scheme did not foresee, in root mean square
        forces: D of a linearly implicit scheme, the error of the extrapolation of an explicit one.
    explicit_ratio : float or None [1]
        Largest macro step * damping / local mass of the journal met: where an explicit coupling of these
        partners ends, between 0.5 and 2 by its degree. None where the derivatives are not known.
    spectral_radius : float or None [1]
        Largest growth per step of the sampled system of this scheme met.
    warnings : tuple of str
        What was warned of.
    """

    local_error: float | None
    explicit_ratio: float | None
    spectral_radius: float | None
    warnings: tuple[str, ...]


@contextmanager
def quietly() -> Iterator[None]:
    """Silence the warnings of couplings that go to their limit on purpose."""
    with warnings.catch_warnings(action="ignore", category=CouplingWarning):
        yield


class Check(NamedTuple):
    """What the distance from the limit follows from, at one communication point.

    Attributes
    ----------
    point : int
    stiffness, damping : ndarray, shape (m, m) [N/m], [N s/m]
    linear : Linearization
        Of the rotor, its journals only.
    """

    point: int
    stiffness: Array
    damping: Array
    linear: Linearization


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
        self._checks: list[Check] = []
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
        except RotorfilmError:
            linear = None
        if tangents is None or linear is None:
            self.checks = False
        else:
            self.checks = not np.any(linear.D)
            self.take([Check(point, tangents.stiffness, tangents.damping, linear)])

    def take(self, checks: list[Check]) -> None:
        """Take what the distance from the limit follows from."""
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
        self._measure([check for check in self._checks if check.point < count])
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

    def _measure(self, checks: Sequence[Check]) -> None:
        """Measure the distances from the limit."""
        if not checks:
            return
        m = len(checks[0].damping)
        felt = np.stack([check.linear.C[m:] @ check.linear.B for check in checks])
        rates = np.linalg.eigvals(felt @ np.stack([check.damping for check in checks])).real.max(axis=1)
        for check, rate in zip(checks, rates.tolist(), strict=True):
            ratio = float(self._macro_step * rate)
            if self._ratio is None or ratio > 1.01 * self._ratio:
                self._ratio, (A, B, C, _) = ratio, check.linear
                loop = Loop(A, B, C[:m], C[m:], check.stiffness, check.damping)
                self._judge(loop, ratio, float(self._record.time[check.point]))

    def _judge(self, loop: Loop, ratio: float, t: float) -> None:
        try:
            limit = squeeze_limit(self._scheme) if _has_fixed_steps(self._scheme) else np.inf
        except ConvergenceError:  # the run itself will say so
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
                f"at t = {t:.6g} s macro_step * damping / local mass is {ratio:.3g}, near the limit "
                f"{limit:.3g} of {self._scheme.label}: shorten macro_step or take scheme=SIExp3()"
            )

    def _warn(self, message: str) -> None:
        if not self._warnings:
            warn_user(message, CouplingWarning)
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


def _has_fixed_steps(scheme: Scheme) -> bool:
    return not isinstance(scheme, Adaptive)
