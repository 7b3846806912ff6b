"""Error against cost of every journal film, on random states, against a two-dimensional reference."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from ...bearings.journal import JournalBearing, fitted_bearing, tension
from ...errors import require_count
from ...progress import Report, part_of, silent
from ...readable.result import Readable
from .journal_rungs import ComparedFilm, RungName, chosen_rungs, comparison_bearing
from .journal_states import (
    LARGE,
    REFERENCE_CELLS,
    SEED,
    ReferenceForce,
    StateRange,
    States,
    random_states,
    reference_force,
    relative_error,
    squeeze_share,
)
from .timing import FilmCost, film_costs

TENSION = 0.01
"""Tension in a film, in its largest pressure, above which it counts as carrying tension."""

ROUNDS = 9
"""Rounds of timing, of which the shortest counts."""


@dataclass(frozen=True, kw_only=True)
class RungAccuracy(RungName, Readable):
    """Error and cost of one rung.

    Attributes
    ----------
    median_error, high_error, worst_error : float [1]
        Median, 99th percentile and maximum of |force - reference| / |reference|.
    tension_share : float [1]
        Share of the states in which the film carries tension of more than 1 % of its largest pressure.
    cost : FilmCost
    """

    median_error: float
    high_error: float
    worst_error: float
    tension_share: float
    cost: FilmCost


@dataclass(frozen=True, kw_only=True)
class JournalAccuracy(Readable):
    """Error against cost of the ladder of journal films.

    Attributes
    ----------
    slenderness : float [1]
        Length / diameter.
    ranges : StateRange
        Where the states were drawn from.
    states, seed : int
        How many, and the seed of the random numbers.
    squeeze_share : float [1]
        Share of the states in which squeeze outweighs the wedge.
    reference : str
        What the errors are measured against.
    reference_median, reference_high : float [1]
        Median and 99th percentile of the estimated relative error of the reference: errors below mean
        nothing.
    rungs : tuple of RungAccuracy
    """

    slenderness: float
    ranges: StateRange
    states: int
    seed: int
    squeeze_share: float
    reference: str
    reference_median: float
    reference_high: float
    rungs: tuple[RungAccuracy, ...]

    def columns(self) -> dict[str, list[object]]:
        """Return the table of the rungs, headings with units; the conditions repeat in every row."""
        low, high = self.ranges.eccentricity_ratio
        rows = [
            {
                "family [-]": rung.family,
                "label [-]": rung.label,
                "median error [1]": rung.median_error,
                "99 % error [1]": rung.high_error,
                "largest error [1]": rung.worst_error,
                "force in a batch [s]": rung.cost.force_time,
                "force alone, prepare() [s]": rung.cost.call_time,
                "batch [1]": rung.cost.batch,
                "states in tension [1]": rung.tension_share,
                "length/diameter [1]": self.slenderness,
                "states [1]": self.states,
                "seed [-]": self.seed,
                "eccentricity ratio from [1]": low,
                "eccentricity ratio to [1]": high,
                "largest squeeze rate/speed [1]": self.ranges.squeeze,
                "whirl/speed from [1]": self.ranges.whirl[0],
                "whirl/speed to [1]": self.ranges.whirl[1],
                "squeeze above wedge [1]": self.squeeze_share,
                "reference [-]": self.reference,
                "reference error, median [1]": self.reference_median,
                "reference error, 99 % [1]": self.reference_high,
            }
            for rung in self.rungs
        ]
        return {heading: [row[heading] for row in rows] for heading in rows[0]}


def journal_accuracy(
    slenderness: float,
    *,
    states: int = 300,
    ranges: StateRange = LARGE,
    seed: int = SEED,
    rungs: Sequence[ComparedFilm] | None = None,
    cells: tuple[int, int] = REFERENCE_CELLS,
    rounds: int = ROUNDS,
    report: Report = silent,
) -> JournalAccuracy:
    """Measure error and cost of every rung in one run.

    Parameters
    ----------
    slenderness : float [1]
        Length / diameter, 0.1 to 4.
    states : int
        Number of random states.
    ranges : StateRange
        Where they are drawn from.
    seed : int
        Of the random numbers.
    rungs : sequence of ComparedFilm, optional
        `journal_rungs()` by default.
    cells : tuple of int
        Cells of the finest grid of the reference, multiples of 16 and at least (64, 16).
    rounds : int
        Rounds of timing, the shortest counts.
    report : callable
        Told how far the job is.

    Raises
    ------
    InputError
        If a number is out of range, the cells break their rule, or there are no rungs.
    """
    require_count("rounds", rounds)
    rungs = chosen_rungs(rungs)
    bearing = comparison_bearing(slenderness)
    sample = random_states(ranges, count=states, clearance=bearing.clearance, seed=seed)
    reference = reference_force(bearing, sample, cells=cells, report=part_of(report, 0.0, 0.5))
    bearings = {rung.name: fitted_bearing(bearing, rung.film) for rung in rungs}
    costs = film_costs(bearings, sample, rounds=rounds, report=part_of(report, 0.5, 0.8))
    measured: list[RungAccuracy] = []
    for rung, fitted, cost in zip(rungs, bearings.values(), costs.values(), strict=True):
        report(0.8 + 0.2 * len(measured) / len(rungs), f"error of {rung.name}")
        measured.append(_measured(rung, fitted, sample, reference, cost))
    return JournalAccuracy(
        slenderness=slenderness,
        ranges=ranges,
        states=states,
        seed=seed,
        squeeze_share=squeeze_share(bearing, sample),
        reference=_reference_text(cells),
        reference_median=float(np.median(reference.error)),
        reference_high=float(np.quantile(reference.error, 0.99)),
        rungs=tuple(measured),
    )


def pareto_front(costs: Sequence[float], errors: Sequence[float]) -> list[int]:
    """Return the indices of the points that no other beats in both cost and error, cheapest first."""
    front: list[int] = []
    for i in np.lexsort((errors, costs)).tolist():
        if not front or errors[i] < errors[front[-1]]:
            front.append(i)
    return front


def _measured(
    rung: ComparedFilm, bearing: JournalBearing, sample: States, reference: ReferenceForce, cost: FilmCost
) -> RungAccuracy:
    error = relative_error(bearing.force(*sample), reference.force)
    pulled = tension(rung.film, *bearing.kinematics(*sample), bearing.slenderness)
    return RungAccuracy(
        family=rung.family,
        label=rung.label,
        median_error=float(np.median(error)),
        high_error=float(np.quantile(error, 0.99)),
        worst_error=float(np.max(error)),
        tension_share=float(np.mean(pulled > TENSION)),
        cost=cost,
    )


def _reference_text(cells: tuple[int, int]) -> str:
    around, along = cells
    return f"2-D film, {around} x {along} and {around // 2} x {along // 2} cells extrapolated"
