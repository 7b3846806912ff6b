"""Whirl threshold of a rigid rotor by every journal film, and what is wrong with it."""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np

from ...bearings.journal import JournalBearing, ReynoldsFilm, fitted_bearing, tension
from ...errors import InputError, require_finite
from ...linear import critical_mass, damping_has_rank_one, speed_parameter
from ...model import Array
from ...progress import Report, silent
from ...results import Coefficients
from .averaged_film import PLACES, AveragedFilm
from .journal_accuracy import TENSION
from .journal_rungs import ComparedFilm, chosen_rungs, comparison_bearing
from .journal_states import LARGE, SPEED, States, random_states, require_cells
from .journal_thresholds import HIGHEST, JournalStability, RungStability

THRESHOLD_CELLS = (384, 16)
"""Finer grid of the reference; each derivative is a mean of eight solutions on it."""

ECCENTRICITY_RATIOS = tuple(np.linspace(0.05, 0.95, 46).tolist())
"""Where thresholds are computed."""

TENSION_STATES = 400
"""Random states of large motion in which tension is looked for."""


def journal_stability(
    slenderness: float,
    *,
    eccentricity_ratio: Sequence[float] = ECCENTRICITY_RATIOS,
    rungs: Sequence[ComparedFilm] | None = None,
    cells: tuple[int, int] = THRESHOLD_CELLS,
    report: Report = silent,
) -> JournalStability:
    """Return the whirl threshold of a rigid rotor by every rung and by the two-dimensional reference.

    Parameters
    ----------
    slenderness : float [1]
        Length / diameter, 0.1 to 4.
    eccentricity_ratio : sequence of float [1]
        Each above 0 and below 1.
    rungs : sequence of ComparedFilm, optional
        `journal_rungs()` by default.
    cells : tuple of int
        Cells of the finest grid of the reference, multiples of 16 and at least (64, 16).
    report : callable
        Told how far the job is.

    Raises
    ------
    InputError
        If an argument is out of range, or there are no rungs.

    Notes
    -----
    The reference is `AveragedFilm`. Its distance from the same on a grid with half the cells estimates its
    error; undivided, since the derivatives err by first order as the edge of the ruptured zone jumps.
    """
    rungs = chosen_rungs(rungs)
    ratios = _required_ratios(eccentricity_ratio)
    require_cells(cells)
    bearing = comparison_bearing(slenderness)
    report(0.0, "two-dimensional reference")
    around, along = cells
    exact, rough = (_curve(_averaged(bearing, grid), ratios) for grid in (cells, (around // 2, along // 2)))
    sample = random_states(LARGE, count=TENSION_STATES, clearance=bearing.clearance)
    judged = []
    for number, rung in enumerate(rungs):
        report((number + 1) / (len(rungs) + 1), f"whirl threshold by {rung.name}")
        judged.append(_judged(rung, bearing, ratios, exact.parameters, sample))
    return JournalStability(
        slenderness=slenderness,
        eccentricity_ratio=tuple(ratios.tolist()),
        speed_parameter=exact.parameters,
        reference=f"2-D film, {around} x {along} cells, averaged over {PLACES} positions within a cell",
        reference_error=_largest_gap(rough.parameters, exact.parameters),
        rungs=tuple(judged),
    )


class _Curve(NamedTuple):
    """Thresholds, why there is none, and the coefficients behind them, one entry for each ratio."""

    parameters: tuple[float | None, ...]
    reasons: tuple[str, ...]
    coefficients: tuple[Coefficients, ...]


def _averaged(bearing: JournalBearing, cells: tuple[int, int]) -> JournalBearing:
    return fitted_bearing(bearing, AveragedFilm(film=ReynoldsFilm(cells=cells)))


def _required_ratios(eccentricity_ratio: Sequence[float]) -> Array:
    ratios = require_finite("eccentricity_ratio", eccentricity_ratio)
    if ratios.ndim != 1 or ratios.size == 0 or np.any((ratios <= 0.0) | (ratios >= 1.0)):
        raise InputError(f"eccentricity_ratio must hold numbers within (0, 1), got {eccentricity_ratio!r}")
    return ratios


def _static_states(bearing: JournalBearing, ratios: Array) -> States:
    position = bearing.clearance * np.stack([ratios, np.zeros_like(ratios)])
    return States(position, np.zeros_like(position), np.full(len(ratios), SPEED))


def _curve(bearing: JournalBearing, ratios: Array) -> _Curve:
    states = _static_states(bearing, ratios)
    force, slopes = bearing.force(*states), bearing.jacobian(*states)
    parameters, reasons, matrices = [], [], []
    for k in range(len(ratios)):
        at = Coefficients(
            stiffness=-slopes[:, :2, k],
            damping=-slopes[:, 2:4, k],
            position=states.position[:, k],
            speed=SPEED,
        )
        border = critical_mass(at)
        parameters.append(_parameter(border.mass, bearing.clearance, force[:, k]))
        reasons.append(border.reason)
        matrices.append(at)
    return _Curve(tuple(parameters), tuple(reasons), tuple(matrices))


def _parameter(mass: float | None, clearance: float, load: Array) -> float | None:
    if mass is None:
        return None
    return speed_parameter(speed=SPEED, clearance=clearance, mass=mass, load=load)


def _judged(
    rung: ComparedFilm,
    bearing: JournalBearing,
    ratios: Array,
    exact: tuple[float | None, ...],
    sample: States,
) -> RungStability:
    own = fitted_bearing(bearing, rung.film)
    curve = _curve(own, ratios)
    at_rest = tension(rung.film, *own.kinematics(*_static_states(own, ratios)), own.slenderness)
    moving = tension(rung.film, *own.kinematics(*sample), own.slenderness)
    return RungStability(
        family=rung.family,
        label=rung.label,
        speed_parameter=curve.parameters,
        deviation=_deviation(curve.parameters, exact),
        reasons=curve.reasons,
        rank_one=tuple(damping_has_rank_one(at) for at in curve.coefficients),
        asymmetry=tuple(_asymmetry(at.damping) for at in curve.coefficients),
        static_tension=tuple(at_rest.tolist()),
        tension_share=float(np.mean(moving > TENSION)),
    )


def _asymmetry(damping: Array) -> float:
    return float(abs(damping[0, 1] - damping[1, 0]) / np.max(np.abs(damping)))


def _largest_gap(rough: tuple[float | None, ...], exact: tuple[float | None, ...]) -> float:
    pairs = zip(_deviation(rough, exact), exact, strict=True)
    gaps = [abs(gap) for gap, x in pairs if gap is not None and x is not None and x <= HIGHEST]
    return max(gaps, default=0.0)


def _deviation(values: tuple[float | None, ...], exact: tuple[float | None, ...]) -> tuple[float | None, ...]:
    pairs = zip(values, exact, strict=True)
    return tuple(None if v is None or x is None else v / x - 1.0 for v, x in pairs)
