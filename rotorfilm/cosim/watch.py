"""What is watched while a co-simulation runs: its distance from the limit, its local error, its chatter."""

from __future__ import annotations

import warnings
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass

import numpy as np

from ..errors import CouplingWarning, RotorfilmError, warn_user
from ..model import Array
from ..readable.result import Readable
from .bench import Sample
from .chatter import WINDOW, inspect_coupling, is_calm
from .coupling_loop import Loop, dominant_eigenvalue, squeeze_limit
from .partners import Partners
from .schemes.adaptive import Adaptive
from .schemes.implicit import defect
from .schemes.scheme import Scheme, extrapolation

EVERY = 8
"""Steps between two looks for chatter."""

LOOK_BACK = 4 * WINDOW
"""Steps that are looked at."""

CHECK = 8
"""Steps between two checks of the distance from the limit, each at the price of the films' derivatives."""

EARLY = 0.5
"""Share of the explicit limit beyond which a coupling is warned of."""


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
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", CouplingWarning)
        yield


class Watch:
    """Watches the communication points of one run, as they come.

    Parameters
    ----------
    partners : Partners
    scheme : Scheme
    macro_step : float [s]
    """

    def __init__(self, partners: Partners, scheme: Scheme, macro_step: float) -> None:
        self._partners, self._scheme, self._macro_step = partners, scheme, macro_step
        self._latest: list[Sample] = []
        self._count = 0
        self._unforeseen, self._squares = 0.0, 0.0
        self._ratio: float | None = None
        self._radius: float | None = None
        self._warnings: list[str] = []
        self._known = partners.differentiates

    @property
    def chatters(self) -> bool:
        """Whether the latest forces alternate; looked for now and then."""
        if self._count % EVERY or self._count <= WINDOW:
            return False
        forces = np.array([sample.force for sample in self._latest]).T
        if is_calm(forces):
            return False
        report = inspect_coupling([sample.time for sample in self._latest], forces)
        return report.chatter or report.coarse

    def see(self, sample: Sample) -> None:
        """Take the next communication point."""
        if self._latest:
            self._unforeseen += float(np.sum(self._surprise(sample) ** 2))
        self._squares += float(np.sum(sample.force**2))
        self._latest = [*self._latest[1 - LOOK_BACK :], sample]
        self._count += 1
        if self._known and self._count % CHECK == 1:
            self._check(sample)

    def result(self) -> CouplingWatch:
        """Return what was seen so far."""
        known = self._count > 1 and self._squares > 0.0
        return CouplingWatch(
            local_error=float(np.sqrt(self._unforeseen / self._squares)) if known else None,
            explicit_ratio=self._ratio,
            spectral_radius=self._radius,
            warnings=tuple(self._warnings),
        )

    def _surprise(self, sample: Sample) -> Array:
        """Return the force that the scheme did not foresee."""
        if sample.tangents is not None:
            return defect(self._latest[-1], sample)
        return unforeseen(self._latest, sample, self._scheme.order)

    def _check(self, sample: Sample) -> None:
        """Measure the distance from the limit."""
        try:
            tangents = sample.tangents or self._partners.tangents()
            linear = self._partners.linear_rotor(sample.time)
        except RotorfilmError:
            self._known = False
            return
        if linear is None or np.any(linear.D):
            self._known = False
            return
        m = len(tangents.damping)
        loop = Loop(linear.A, linear.B, linear.C[:m], linear.C[m:], tangents.stiffness, tangents.damping)
        ratio = float(self._macro_step * loop.squeeze_rate)
        if self._ratio is None or ratio > 1.01 * self._ratio:
            self._ratio = ratio
            self._judge(loop, ratio, sample.time)

    def _judge(self, loop: Loop, ratio: float, t: float) -> None:
        limit = squeeze_limit(self._scheme) if _has_fixed_steps(self._scheme) else np.inf
        if not np.isfinite(limit):
            return
        radius = abs(dominant_eigenvalue(loop, self._macro_step, self._scheme))
        self._radius = max(radius, self._radius or 0.0)
        itself = float(np.linalg.eigvals(loop.closed).real.max())
        if radius > 1.0 and itself < 0.0:
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


def unforeseen(latest: Sequence[Sample], sample: Sample, order: int) -> Array:
    """Return the force at a sample less the one extrapolated to it from the latest ones."""
    used = latest[-order:]
    if len(used) == 1:
        return sample.force - used[-1].force
    parts = extrapolation([s.time for s in used], [s.force for s in used])
    elapsed = sample.time - used[-1].time
    ahead = sum(elapsed**k * part for k, part in enumerate(parts))
    return np.asarray(sample.force - ahead)


def _has_fixed_steps(scheme: Scheme) -> bool:
    return not isinstance(scheme, Adaptive)
