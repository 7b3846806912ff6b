"""Explicit schemes: forces held, or extrapolated from communication points behind."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from ...inputs.si_arguments import quantities
from ..bench import Bench, Needs, Sample, StationMotion
from .scheme import extrapolated_law, extrapolation, require_degree, started


@dataclass(frozen=True, kw_only=True)
class _Extrapolating:
    """What the explicit schemes share: a polynomial in time through the latest forces."""

    degree: int = 0

    _name = ""

    def __post_init__(self) -> None:
        require_degree(self.degree)

    @property
    def label(self) -> str:
        """Its name in print."""
        return f"{self._name} {self.degree}"

    @property
    def order(self) -> int:
        """Order of convergence in the macro step."""
        return self.degree + 1

    @property
    def needs(self) -> Needs:
        """A rotor that takes laws, unless the force is held."""
        return Needs(laws=self.degree > 0)


@quantities
@dataclass(frozen=True, kw_only=True)
class GaussSeidel(_Extrapolating):
    """Rotor first, under extrapolated forces, then the films at the rotor's new state.

    Parameters
    ----------
    degree : int
        Of the polynomial in time through the latest forces: 0 holds the force, 1 and 2 extrapolate it.

    Raises
    ------
    InputError
        If the degree is none of these.
    """

    _name = "Gauss-Seidel"

    def step(self, bench: Bench, history: Sequence[Sample], t: float, dt: float) -> Sample:
        """Advance by one macro step, at the start by a part of it; see `Scheme`."""
        dt = started(history, self.degree, dt)
        motion = bench.drive(t, dt, extrapolated_law(history, self.degree))
        return bench.evaluate(t, dt, motion, False)


@quantities
@dataclass(frozen=True, kw_only=True)
class Jacobi(_Extrapolating):
    """Rotor and films in parallel: forces extrapolated for the rotor, its motion for the films.

    Parameters
    ----------
    degree : int
        Of both polynomials in time, 0 to 2.

    Raises
    ------
    InputError
        If the degree is none of these.
    """

    _name = "Jacobi"

    def step(self, bench: Bench, history: Sequence[Sample], t: float, dt: float) -> Sample:
        """Advance by one macro step, at the start by a part of it; see `Scheme`."""
        dt = started(history, self.degree, dt)
        seen = bench.evaluate(t, dt, _ahead(history[-1 - self.degree :], t + dt), False)
        motion = bench.drive(t, dt, extrapolated_law(history, self.degree))
        return seen._replace(motion=motion)


def _ahead(latest: Sequence[Sample], t: float) -> StationMotion:
    """Return the motion extrapolated to t."""
    times, elapsed = [sample.time for sample in latest], t - latest[-1].time
    powers = (1.0, elapsed, elapsed * elapsed)

    def at(series: list[np.ndarray]) -> np.ndarray:
        parts = extrapolation(times, series)
        return np.asarray(sum(power * part for power, part in zip(powers, parts, strict=True)))

    return StationMotion(
        at([sample.motion.position for sample in latest]),
        at([sample.motion.velocity for sample in latest]),
        float(at([np.array(sample.motion.speed) for sample in latest])),
        latest[-1].motion.outputs,
    )
