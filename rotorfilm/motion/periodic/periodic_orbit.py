"""Periodic orbits of a rotor on films: driven by its unbalance, or whirl at a frequency of its own."""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import cached_property
from typing import ClassVar

import numpy as np
from numpy.typing import ArrayLike

from ...errors import InputError, require_count, require_positive
from ...inputs.kinds import arguments
from ...model import Array
from ...readable.result import Drawable
from ...results import Trajectory
from ...rotors import MountedRotor
from ..compiled.modal import Complex, ModalRotor, modal_rotor, take_apart
from .balance import Balance
from .floquet import multipliers, state_at_start
from .harmonics import constant, resized, series_rows
from .modal_films import ModalFilms
from .orbit_newton import CONVERGED, Solution, driven, lengthened, solve, truncation_of
from .rest import first_guess
from .start_series import end_of, subharmonic

HARMONICS = 8
"""Harmonics at first."""

TRUNCATION = 1e-7
"""Largest of the last harmonics / clearance at which a series is long enough."""

BALANCED = 1e-3
"""Where the search for an orbit ends, in tolerances."""


@dataclass(frozen=True, kw_only=True, eq=False)
class PeriodicOrbit(Drawable):
    """A periodic orbit of a rotor on films.

    Attributes
    ----------
    frequency : float [rad/s]
        Angular frequency; speed / periods for an orbit that the unbalance drives.
    speed : float [rad/s]
    periods : int
        Turns of the shaft per orbit; 0 for whirl at a frequency of its own.
    stations : tuple of str
    lengths : ndarray, shape (n_bearings,) [m]
        Clearance of each bearing.
    series : ndarray, shape (n_bearings, 2, 2 H + 1) [m]
        Journal displacement x, y: mean, cosines, sines of the phase frequency * t.
    state : ndarray, shape (n_states,)
        State of the whole rotor at t = 0.
    multipliers : ndarray of complex, shape (n_states,)
        Floquet multipliers, the largest first; one of whirl is 1. Empty without `stability`.
    residual : float [1]
        Imbalance left / clearance.
    truncation : float [1]
        Largest of the last quarter of the harmonics / clearance.
    work : dict of str to int
        film_evaluations, iterations.
    """

    frequency: float
    speed: float
    periods: int
    stations: tuple[str, ...]
    lengths: Array
    series: Array
    state: Array
    multipliers: Complex
    residual: float
    truncation: float
    work: dict[str, int]

    _shown: ClassVar[tuple[str, ...]] = ("period", "amplitude")

    @property
    def period(self) -> float:
        """Duration of one orbit [s]."""
        return 2.0 * math.pi / self.frequency

    @property
    def harmonics(self) -> int:
        """Harmonics of the series."""
        return self.series.shape[-1] // 2

    def position(self, time: ArrayLike) -> Array:
        """Return x, y of each journal at times (n,) [s], shape (n_bearings, 2, n) [m]."""
        values, _ = series_rows(self.harmonics, self.frequency * np.atleast_1d(np.asarray(time, dtype=float)))
        return np.asarray(self.series @ values.T)

    @cached_property
    def eccentricity_ratios(self) -> Array:
        """Eccentricity ratio of each journal over the orbit, shape (n_bearings, 256)."""
        position = self.position(self.period * np.arange(256) / 256)
        return np.hypot(position[:, 0], position[:, 1]) / self.lengths[:, None]

    @property
    def amplitude(self) -> float:
        """Largest distance of a journal from its mean position / clearance [1]."""
        position = self.position(self.period * np.arange(256) / 256) - self.series[:, :, :1]
        return float((np.hypot(position[:, 0], position[:, 1]) / self.lengths[:, None]).max())

    @property
    def free_multipliers(self) -> Complex:
        """The multipliers without the one that is 1 because whirl has no phase of its own."""
        if self.periods:
            return self.multipliers
        return np.delete(self.multipliers, int(np.argmin(np.abs(self.multipliers - 1.0))))

    @property
    def stable(self) -> bool:
        """Whether a small disturbance dies out; InputError where the multipliers were not computed."""
        if not self.multipliers.size:
            raise InputError("stability must be True for an orbit that knows whether it is stable")
        return bool(np.all(np.abs(self.free_multipliers) < 1.0))


@arguments
def periodic_orbit(
    mounted: MountedRotor,
    *,
    start: PeriodicOrbit | Trajectory | None = None,
    periods: int = 1,
    tolerance: float = TRUNCATION,
    stability: bool = True,
) -> PeriodicOrbit:
    """Return a periodic orbit of a rotor on films, stable or not, and its Floquet multipliers.

    With unbalance the orbit repeats after `periods` turns of the shaft. Without it the orbit is whirl, whose
    frequency is found with it; it needs a start.

    Parameters
    ----------
    mounted : MountedRotor
        From `mount`, at constant speed.
    start : PeriodicOrbit or Trajectory, optional
        An orbit nearby, or a run of `simulate_rotor` that ends in one; by default small motion about the
        rest, which leads to the orbit of one turn.
    periods : int
        Turns of the shaft per orbit: 2 after a period doubling. The orbit of one turn solves these equations
        too, so that another one needs a start.
    tolerance : float [1]
        Harmonics are added until the last quarter of them is smaller, in clearances; the equations of those
        that there are hold to a thousandth of it.
    stability : bool
        Whether to compute the Floquet multipliers; without them the orbit does not know whether it is stable.

    Raises
    ------
    InputError
        If an argument breaks its rule, or whirl has no start.
    ConvergenceError
        If no orbit is found.
    """
    require_count("periods", periods)
    require_positive("tolerance", tolerance)
    modal = modal_rotor(parts := take_apart(mounted), parts.speed)
    converged = max(CONVERGED, BALANCED * tolerance)
    if bool(np.any(parts.structure.unbalance)) and parts.speed != 0.0:
        found = _driven(mounted, modal, start, periods, converged)
    elif start is None:
        raise InputError("start must be an orbit or a run that ends in whirl for a rotor without unbalance")
    else:
        series, frequency = _start_series(modal, start, None)
        balance = Balance(rotor=ModalFilms(modal), harmonics=HARMONICS, periods=0)
        found = solve(balance, resized(series, HARMONICS), frequency, converged)
    return finished(lengthened(found, tolerance, converged), stability=stability)


def _driven(
    mounted: MountedRotor,
    modal: ModalRotor,
    start: PeriodicOrbit | Trajectory | None,
    periods: int,
    converged: float,
) -> Solution[ModalFilms]:
    harmonics = HARMONICS * periods
    balance = Balance(rotor=ModalFilms(modal), harmonics=harmonics, periods=periods)
    if start is not None:
        series, _ = _start_series(modal, start, balance.frequency)
        return solve(balance, resized(series, harmonics), balance.frequency, converged)
    rest = first_guess(mounted, modal)
    return driven(balance, constant(rest, harmonics), rest, converged)


def finished(solution: Solution[ModalFilms], *, stability: bool = True) -> PeriodicOrbit:
    """Return the orbit of a solution, with its multipliers if asked for."""
    balance, series = solution.balance, solution.series
    modal = balance.rotor.modal
    parts = modal.parts
    return PeriodicOrbit(
        frequency=solution.frequency,
        speed=parts.speed,
        periods=balance.periods,
        stations=parts.names,
        lengths=parts.lengths,
        series=series.reshape(len(parts.names), 2, -1),
        state=state_at_start(modal, series, solution.frequency, balance.periods),
        multipliers=multipliers(modal, series, solution.frequency)
        if stability
        else np.zeros(0, dtype=complex),
        residual=solution.residual,
        truncation=truncation_of(solution),
        work={
            "film_evaluations": (solution.iterations + 1) * balance.samples * len(parts.names),
            "iterations": solution.iterations,
        },
    )


def _start_series(
    modal: ModalRotor, start: PeriodicOrbit | Trajectory, frequency: float | None
) -> tuple[Array, float]:
    """Return the series of a start and its frequency; of a run, that of its end."""
    if isinstance(start, PeriodicOrbit):
        series = start.series.reshape(-1, start.series.shape[-1])
        if len(series) != 2 * len(modal.parts.names):
            raise InputError(
                f"start must be an orbit of {len(modal.parts.names)} journals, got {len(series) // 2}"
            )
        if frequency is None or start.periods * frequency == 0.0:
            return series, start.frequency
        ratio = start.frequency / frequency
        return subharmonic(series, round(ratio)), frequency
    return end_of(modal, start, frequency, HARMONICS)
