"""Film laws side by side on one bearing: locus, whirl threshold, accuracy and cost."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass, replace
from time import perf_counter

import numpy as np

from ..bearings.journal import JournalBearing
from ..films import ComplementarityArc, FilmLaw, MapFilm, ReynoldsFilm, RotatingArc, ShortFilm, SplittingFilm
from ..linear import coefficients, critical_mass, speed_parameter
from ..model import Array

SPEED = 100.0
"""Angular speed of the comparisons [rad/s]; in dimensionless form nothing depends on it."""

STATES = 200
"""States at which forces are compared."""

REPEATS = 5
"""Runs of which the shortest counts."""

PATIENCE = 0.5
"""Time [s] after which a law is not run again."""

REFERENCE_CELLS = (384, 32)
"""Cells of the two-dimensional film that errors are measured against, extrapolated from it and its half."""

SEED = 1978
"""Seed of those states, so that every run compares the same ones."""


FREE_ARC = SplittingFilm(order=(4, 8), constant=True, rupture=ComplementarityArc())
"""The best splitting film: both ends free, four functions and the constant, eight axial modes."""


@dataclass(frozen=True, kw_only=True)
class FilmCurve:
    """What a film law says over the eccentricity.

    Attributes
    ----------
    eccentricity_ratio : ndarray, shape (n,) [1]
    attitude_angle : ndarray, shape (n,) [rad]
        From the load line to the journal center, in the sense of rotation.
    speed_parameter : tuple of n floats or None [1]
        speed * sqrt(clearance * mass / load) at the onset of whirl; None where there is none.
    """

    eccentricity_ratio: Array
    attitude_angle: Array
    speed_parameter: tuple[float | None, ...]


@dataclass(frozen=True, kw_only=True)
class FilmAccuracy:
    """Error and cost of a film law.

    Attributes
    ----------
    force_time : float [s]
        Time of one force in a batch, the shortest of several runs.
    median_error, high_error : float [1]
        Median and 99th percentile of |force - reference| / |reference|.
    """

    force_time: float
    median_error: float
    high_error: float


def compared_laws() -> dict[str, FilmLaw]:
    """Return the laws of the locus and stability charts; film extent and order both differ."""
    return {
        "short": ShortFilm(),
        "(1, 1) fixed arc": SplittingFilm(order=(1, 1)),
        "(2, inf) fixed arc": SplittingFilm(order=(2, None)),
        "(6, inf) rotating arc": SplittingFilm(order=(6, None), rupture=RotatingArc()),
        "(4+1, 8) free arc": FREE_ARC,
        "two-dimensional, 96 x 8": ReynoldsFilm(cells=(96, 8)),
        "map": MapFilm(),
    }


def ladder_laws() -> dict[str, FilmLaw]:
    """Return the laws of the accuracy chart: extent first, then order, then cells, and the map of it all."""
    cells = ((48, 4), (96, 8), (192, 16))
    return {
        "short": ShortFilm(),
        "(1, 1) fixed arc": SplittingFilm(order=(1, 1)),
        "(2, 1) fixed arc": SplittingFilm(order=(2, 1)),
        "(2, inf) rotating arc": SplittingFilm(order=(2, None), rupture=RotatingArc()),
        "(6, inf) rotating arc": SplittingFilm(order=(6, None), rupture=RotatingArc()),
        "(4+1, 8) free arc": FREE_ARC,
        **{f"two-dimensional, {n} x {m}": ReynoldsFilm(cells=(n, m)) for n, m in cells},
        "map": MapFilm(),
    }


def film_curve(bearing: JournalBearing, eccentricity_ratio: Array) -> FilmCurve:
    """Return attitude angle and whirl threshold of a full bearing, at each eccentricity ratio (n,)."""
    points = [_static_point(bearing, float(ratio)) for ratio in eccentricity_ratio]
    return FilmCurve(
        eccentricity_ratio=eccentricity_ratio,
        attitude_angle=np.array([angle for angle, _ in points]),
        speed_parameter=tuple(parameter for _, parameter in points),
    )


def _static_point(bearing: JournalBearing, ratio: float) -> tuple[float, float | None]:
    """Return attitude angle [rad] and threshold of the journal displaced along +x."""
    position = np.array([ratio * bearing.clearance, 0.0])
    force = bearing.force(position, np.zeros(2), SPEED)
    border = critical_mass(coefficients(bearing, position, SPEED))
    angle = -math.atan2(-force[1], -force[0])
    if border.mass is None:
        return angle, None
    return angle, speed_parameter(speed=SPEED, clearance=bearing.clearance, mass=border.mass, load=force)


def film_accuracy(
    bearing: JournalBearing, laws: dict[str, FilmLaw], report: Callable[[str], None]
) -> dict[str, FilmAccuracy]:
    """Return error and cost of each law against the two-dimensional film with Reynolds rupture.

    The states are random: eccentricity ratio .05 to .95, velocity up to half of clearance * speed. The
    reference, extrapolated from two grids, is itself off by some 3e-6 (median) and 1e-4 (99 %): smaller
    errors are not told apart.

    Parameters
    ----------
    bearing : JournalBearing
        Gives the geometry; its own film law is replaced.
    laws : dict of str to FilmLaw
    report : callable
        Called with the label of each law before it is measured.
    """
    state = _random_states(bearing.clearance)
    report("the reference")
    film = ReynoldsFilm(cells=REFERENCE_CELLS)
    extrapolated, _ = film.extrapolated(*bearing.kinematics(*state), bearing.slenderness)
    reference = bearing.force_scale * extrapolated
    result = {}
    for label, law in laws.items():
        report(label)
        result[label] = _measured(replace(bearing, film=law), state, reference)
    return result


def _random_states(clearance: float) -> tuple[Array, Array, Array]:
    random = np.random.default_rng(SEED)
    ratio, size = random.uniform(0.05, 0.95, STATES), random.uniform(0.0, 0.5, STATES)
    turn, heading = random.uniform(0.0, 2.0 * np.pi, (2, STATES))
    position = clearance * ratio * np.array([np.cos(turn), np.sin(turn)])
    velocity = clearance * SPEED * size * np.array([np.cos(heading), np.sin(heading)])
    return position, velocity, np.full(STATES, SPEED)


def _measured(bearing: JournalBearing, state: tuple[Array, Array, Array], reference: Array) -> FilmAccuracy:
    times: list[float] = []
    while len(times) < REPEATS and sum(times) < PATIENCE:
        begin = perf_counter()
        force = bearing.force(*state)
        times.append(perf_counter() - begin)
    error = np.hypot(*(force - reference)) / np.hypot(*reference)
    return FilmAccuracy(
        force_time=min(times) / STATES,
        median_error=float(np.median(error)),
        high_error=float(np.quantile(error, 0.99)),
    )
