"""The ladder of journal films: what each rung costs, how far it is off, and what it says of whirl."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from time import perf_counter

import numpy as np
from numpy.typing import ArrayLike

from ..bearings.journal import JournalBearing
from ..films import FilmLaw, FixedArc, RotatingArc, ShortFilm, SpectralArcFilm, SplittingFilm
from ..linear import coefficients, critical_mass
from ..model import Array


@dataclass(frozen=True, kw_only=True)
class Rung:
    """One film law of the ladder under the name that charts print.

    Attributes
    ----------
    name : str
    film : FilmLaw
    """

    name: str
    film: FilmLaw


@dataclass(frozen=True, kw_only=True)
class RungAccuracy:
    """Error and cost of one rung against the converged film on the same arc.

    Attributes
    ----------
    name : str
    median_error, worst_error : float [1]
        Median and 99th percentile of |F - F_reference| / |F_reference|.
    cost : float [s]
        Time of one force in a batch, best of several runs.
    cost_ratio : float [1]
        Cost relative to the first rung in the same run.
    """

    name: str
    median_error: float
    worst_error: float
    cost: float
    cost_ratio: float


@dataclass(frozen=True, kw_only=True)
class StaticCurve:
    """Static and stability answers of one rung over the eccentricity ratio.

    Attributes
    ----------
    name : str
    eccentricity_ratio : ndarray, shape (n,) [1]
    attitude_angle : ndarray, shape (n,) [rad]
    sommerfeld_number : ndarray, shape (n,) [1]
        viscosity * (speed/2 pi) * 2 radius * length / load * (radius/clearance)^2.
    speed_parameter : tuple of (float or None), length n [1]
        Whirl threshold speed * sqrt(clearance * mass / load); None where there is none.
    reasons : tuple of str, length n
        Empty, or why there is no threshold.
    """

    name: str
    eccentricity_ratio: Array
    attitude_angle: Array
    sommerfeld_number: Array
    speed_parameter: tuple[float | None, ...]
    reasons: tuple[str, ...]


def fixed_arc_ladder() -> tuple[Rung, ...]:
    """Return the splitting orders on the published arc, the converged film on it last."""
    orders: tuple[tuple[str, tuple[int, int | None]], ...] = (
        ("(1, 1)", (1, 1)),
        ("(2, 1)", (2, 1)),
        ("(2, all)", (2, None)),
        ("(4, 2)", (4, 2)),
        ("(6, 3)", (6, 3)),
    )
    rungs = [Rung(name=f"splitting {name}", film=SplittingFilm(order=order)) for name, order in orders]
    return (*rungs, Rung(name="converged, arc [0, pi]", film=SpectralArcFilm(rupture=FixedArc())))


def rotating_arc_ladder() -> tuple[Rung, ...]:
    """Return the short film and the splitting orders on the rotating arc, the converged film last."""
    arc = RotatingArc()
    orders: tuple[tuple[str, tuple[int, int | None]], ...] = (
        ("(1, 1)", (1, 1)),
        ("(2, 1)", (2, 1)),
        ("(2, all)", (2, None)),
        ("(4, 2)", (4, 2)),
        ("(6, 3)", (6, 3)),
        ("(6, all)", (6, None)),
        ("(12, all)", (12, None)),
    )
    rungs = [
        Rung(name=f"splitting {name}", film=SplittingFilm(order=order, rupture=arc)) for name, order in orders
    ]
    return (
        Rung(name="short", film=ShortFilm()),
        *rungs,
        Rung(name="converged (Ritz, 48)", film=SpectralArcFilm(rupture=arc)),
    )


def measure_accuracy(
    bearing: JournalBearing, ladder: Sequence[Rung], *, samples: int = 400, seed: int = 0
) -> tuple[RungAccuracy, ...]:
    """Return error and cost of each rung on random states of large motion.

    The states are uniform in the eccentricity ratio from 0.05 to 0.95 and, at unit speed, in
    |d chi/dt| < 0.5 and -0.5 < d phi/dt < 1.5. The reference is the converged film of degree 96 on the
    rotating arc.
    """
    rng = np.random.default_rng(seed)
    chi = rng.uniform(0.05, 0.95, samples)
    radial, turning = rng.uniform(-0.5, 0.5, samples), rng.uniform(-0.5, 1.5, samples)
    eccentricity = np.stack([chi, np.zeros(samples)])
    source = np.stack([radial, chi * (turning - 0.5)])

    def evaluate(film: FilmLaw) -> Array:
        return film.force(eccentricity, source, bearing.slenderness)

    exact = evaluate(SpectralArcFilm(rupture=RotatingArc(), degree=96))
    size = np.linalg.norm(exact, axis=0)
    costs = [best_time(lambda film=rung.film: evaluate(film)) / samples for rung in ladder]  # type: ignore[misc]
    results = []
    for rung, cost in zip(ladder, costs, strict=True):
        error = np.linalg.norm(evaluate(rung.film) - exact, axis=0) / size
        results.append(
            RungAccuracy(
                name=rung.name,
                median_error=float(np.median(error)),
                worst_error=float(np.quantile(error, 0.99)),
                cost=cost,
                cost_ratio=cost / costs[0],
            )
        )
    return tuple(results)


def static_curve(bearing: JournalBearing, rung: Rung, eccentricity_ratio: ArrayLike) -> StaticCurve:
    """Return attitude, Sommerfeld number and whirl threshold of a rung at given eccentricity ratios."""
    chi = np.asarray(eccentricity_ratio, dtype=float)
    swapped = replace(bearing, film=rung.film)
    speed = 1.0
    position = np.stack([chi * bearing.clearance, np.zeros_like(chi)])
    force = swapped.force(position, np.zeros_like(position), speed)
    load = np.linalg.norm(force, axis=0)
    thresholds = [_threshold(swapped, position[:, i], speed, load[i]) for i in range(len(chi))]
    per_load = bearing.viscosity * bearing.length * bearing.radius**3 / (math.pi * bearing.clearance**2)
    return StaticCurve(
        name=rung.name,
        eccentricity_ratio=chi,
        attitude_angle=np.arctan2(force[1], -force[0]),
        sommerfeld_number=per_load * speed / load,
        speed_parameter=tuple(value for value, _ in thresholds),
        reasons=tuple(reason for _, reason in thresholds),
    )


def _threshold(
    bearing: JournalBearing, position: Array, speed: float, load: float
) -> tuple[float | None, str]:
    border = critical_mass(coefficients(bearing, position, speed))
    if border.mass is None:
        return None, border.reason
    return speed * math.sqrt(bearing.clearance * border.mass / load), ""


def best_time(call: Callable[[], object], repeats: int = 5) -> float:
    """Return the shortest time of several calls [s]."""
    times = []
    for _ in range(repeats):
        begin = perf_counter()
        call()
        times.append(perf_counter() - begin)
    return min(times)
