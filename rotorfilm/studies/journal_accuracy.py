"""Error against cost of every journal film, on random states, against a two-dimensional reference."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from enum import StrEnum
from time import perf_counter
from typing import NamedTuple, Protocol

import numpy as np
from numpy.typing import ArrayLike

from ..bearings.films.law import FilmLaw
from ..bearings.journal import (
    ComplementarityArc,
    ExtrapolatedFilm,
    FixedArc,
    JournalBearing,
    MapFilm,
    ReynoldsArc,
    ReynoldsFilm,
    RotatingArc,
    Rupture,
    ShortFilm,
    SpectralArcFilm,
    SplittingFilm,
    fitted_bearing,
    tension,
)
from ..core.errors import InputError, require_count, require_number, require_positive
from ..core.model import Array
from ..core.progress import Report, part_of, silent
from ..core.readable import Readable

# The rungs of the journal film: every law, every place where its film may end, several orders.


SLENDERNESS = (0.1, 4.0)
"""Smallest and largest length / diameter at which all rungs exist."""

CONVERGED = 24
"""Degree of the converged films: 4e-8 at eccentricity ratios to 0.99."""

ROTATING_ORDERS = ((1, 1), (2, 1), (2, None), (4, 2), (6, None))
"""Orders on the rotating arc, from the published first approximation to all but converged."""


class FilmFamily(StrEnum):
    """What films of the ladder have in common: where they end, or how they are solved."""

    SHORT = "short film"
    PUBLISHED = "published"
    FIXED = "fixed arc"
    ROTATING = "rotating arc"
    REYNOLDS = "Reynolds arc"
    FREE = "free arc"
    GRID = "2-D"
    EXTRAPOLATED = "2-D extrapolated"
    MAP = "map"


@dataclass(frozen=True, kw_only=True)
class RungName:
    """What a rung is called.

    Attributes
    ----------
    family : FilmFamily
        What it has in common with its neighbors.
    label : str
        What tells it from them; empty if nothing has to.
    """

    family: FilmFamily
    label: str

    @property
    def name(self) -> str:
        """Family and label, unique in the ladder."""
        return f"{self.family} {self.label}".strip()


@dataclass(frozen=True, kw_only=True)
class ComparedFilm(RungName):
    """One film law of the ladder.

    Attributes
    ----------
    film : FilmLaw
    """

    film: FilmLaw


def journal_rungs() -> tuple[ComparedFilm, ...]:
    """Return the ladder, families from the cheapest to the closest."""
    fixed, rotating, free = FixedArc(), RotatingArc(), ComplementarityArc()
    return (
        ComparedFilm(family=FilmFamily.SHORT, label="", film=ShortFilm()),
        *(_splitting(FilmFamily.PUBLISHED, fixed, n, 1) for n in (1, 2)),
        *(_splitting(FilmFamily.FIXED, fixed, n, None) for n in (2, 6)),
        _converged(FilmFamily.FIXED, fixed),
        *(_splitting(FilmFamily.ROTATING, rotating, n, m) for n, m in ROTATING_ORDERS),
        _converged(FilmFamily.ROTATING, rotating),
        *(_splitting(FilmFamily.REYNOLDS, ReynoldsArc(), n, None, constant=True) for n in (4, 6)),
        *(_splitting(FilmFamily.FREE, free, n, m, constant=True) for n, m in ((4, 8), (6, None))),
        _converged(FilmFamily.FREE, free),
        *(_grid(FilmFamily.GRID, *cells) for cells in ((48, 4), (96, 8), (192, 16))),
        *(_grid(FilmFamily.EXTRAPOLATED, *cells) for cells in ((48, 8), (96, 8), (192, 8), (384, 16))),
        ComparedFilm(family=FilmFamily.MAP, label="", film=MapFilm()),
    )


def chosen_rungs(rungs: Sequence[ComparedFilm] | None) -> tuple[ComparedFilm, ...]:
    """Return the rungs to compare, the whole ladder for None.

    Raises
    ------
    InputError
        If there is none, one is not a `Rung`, or two have the same name.
    """
    if rungs is None:
        return journal_rungs()
    chosen = tuple(rungs)
    if not chosen or not all(isinstance(rung, ComparedFilm) for rung in chosen):
        raise InputError(f"rungs must hold at least one Rung and nothing else, got {rungs!r}")
    names = [rung.name for rung in chosen]
    if len(set(names)) < len(names):
        raise InputError(f"rungs must have different names, got {names!r}")
    return chosen


def comparison_bearing(slenderness: float) -> JournalBearing:
    """Return the bearing of the comparisons; dimensionless results depend on length / diameter alone.

    Raises
    ------
    InputError
        If length / diameter is outside the range of the ladder.
    """
    require_positive("slenderness", slenderness)
    lowest, highest = SLENDERNESS
    if not lowest <= slenderness <= highest:
        raise InputError(f"slenderness (L/D) must be from {lowest} to {highest}, got {slenderness!r}")
    return JournalBearing(
        radius=0.05, length=0.1 * slenderness, clearance=1e-4, viscosity=0.1, film=MapFilm()
    )


def _splitting(
    family: FilmFamily, arc: Rupture, n: int, m: int | None, constant: bool = False
) -> ComparedFilm:
    label = f"({n}{'+c' if constant else ''}, {'all' if m is None else m})"
    return ComparedFilm(
        family=family, label=label, film=SplittingFilm(order=(n, m), constant=constant, rupture=arc)
    )


def _converged(family: FilmFamily, arc: Rupture) -> ComparedFilm:
    return ComparedFilm(family=family, label="converged", film=SpectralArcFilm(rupture=arc, degree=CONVERGED))


def _grid(family: FilmFamily, around: int, along: int) -> ComparedFilm:
    plain = ReynoldsFilm(cells=(around, along))
    film = plain if family is FilmFamily.GRID else ExtrapolatedFilm(film=plain)
    return ComparedFilm(family=family, label=f"{around} x {along}", film=film)


# The states at which journal films are compared, and the two-dimensional solution there.


SPEED = 100.0
"""Angular speed of the comparisons [rad/s]; in dimensionless form nothing depends on it."""

SEED = 1978
"""Seed of the states, so that every run compares the same ones."""

REFERENCE_CELLS = (768, 32)
"""Cells of the finest of the three grids behind the reference."""

CHUNK = 20
"""States between two reports."""


@dataclass(frozen=True, kw_only=True)
class StateRange:
    """Ranges from which states are drawn uniformly; the direction of the journal is uniform too.

    Attributes
    ----------
    eccentricity_ratio : tuple of 2 floats [1]
        Smallest and largest.
    squeeze : float [1]
        Largest |rate of the eccentricity ratio| / speed.
    whirl : tuple of 2 floats [1]
        Smallest and largest rate of the attitude angle / speed.

    Raises
    ------
    InputError
        If a range is empty, not finite, or leaves the clearance.
    """

    eccentricity_ratio: tuple[float, float] = (0.05, 0.95)
    squeeze: float = 0.5
    whirl: tuple[float, float] = (-0.5, 1.5)

    def __post_init__(self) -> None:
        lowest, highest = _pair("eccentricity_ratio", self.eccentricity_ratio)
        slowest, fastest = _pair("whirl", self.whirl)
        require_number("squeeze", self.squeeze)
        if not 0.0 < lowest < highest < 1.0:
            raise InputError(f"eccentricity_ratio must rise within (0, 1), got {self.eccentricity_ratio!r}")
        if not (self.squeeze > 0.0 and slowest < fastest):
            raise InputError(f"squeeze and whirl must span a range, got {self.squeeze!r}, {self.whirl!r}")

    def describe(self) -> str:
        """Return the ranges in one line."""
        (low, high), (slow, fast) = self.eccentricity_ratio, self.whirl
        return (
            f"eps {low:g} to {high:g}, |deps/dt| < {self.squeeze:g} omega, "
            f"{slow:g} omega < dphi/dt < {fast:g} omega, all uniform"
        )


def _pair(name: str, values: tuple[float, float]) -> tuple[float, float]:
    if not isinstance(values, tuple) or len(values) != 2:
        raise InputError(f"{name} must be two numbers, got {values!r}")
    low, high = (require_number(name, value) for value in values)
    return low, high


LARGE = StateRange()
"""Large motion: from strong squeeze to whirl at one and a half times the speed, either way."""

SMALL = StateRange(squeeze=0.05, whirl=(-0.05, 0.05))
"""Small motion about static equilibria."""


class States(NamedTuple):
    """Position (2, n) [m], velocity (2, n) [m/s] and speed (n,) [rad/s]."""

    position: Array
    velocity: Array
    speed: Array


class ReferenceForce(NamedTuple):
    """Force (2, n) [N] and the estimate of its relative error (n,) [1]."""

    force: Array
    error: Array


def random_states(ranges: StateRange, *, count: int, clearance: float, seed: int = SEED) -> States:
    """Return `count` random states of a journal that turns at `SPEED`.

    Raises
    ------
    InputError
        If count is not a positive integer, seed not a natural number.
    """
    require_count("states", count)
    require_count("seed", seed, least=0)
    random = np.random.default_rng(seed)
    ratio = random.uniform(*ranges.eccentricity_ratio, count)
    angle = random.uniform(0.0, 2.0 * np.pi, count)
    squeeze = random.uniform(-ranges.squeeze, ranges.squeeze, count)
    whirl = random.uniform(*ranges.whirl, count)
    outward = np.array([np.cos(angle), np.sin(angle)])
    across = np.array([-outward[1], outward[0]])
    velocity = clearance * SPEED * (squeeze * outward + ratio * whirl * across)
    return States(clearance * ratio * outward, velocity, np.full(count, SPEED))


def require_cells(cells: tuple[int, int]) -> None:
    """Raise InputError unless the cells are multiples of 16, at least (64, 16): a grid halved twice."""
    match cells:
        case (int() as around, int() as along) if around % 16 == along % 16 == 0 < along and around >= 64:
            return
    raise InputError(f"cells must be two multiples of 16, at least (64, 16), got {cells!r}")


def squeeze_share(bearing: JournalBearing, states: States) -> float:
    """Return the share of the states in which squeeze outweighs the wedge, |g_c| > |g_s| [1]."""
    e, w = bearing.kinematics(*states)
    return float(np.mean(np.abs(np.sum(e * w, axis=0)) > np.abs(e[0] * w[1] - e[1] * w[0])))


def relative_error(force: Array, reference: Array) -> Array:
    """Return |force - reference| / |reference| of vectors (2, n)."""
    return np.asarray(np.hypot(*(force - reference)) / np.hypot(*reference))


def reference_force(
    bearing: JournalBearing,
    states: States,
    *,
    cells: tuple[int, int] = REFERENCE_CELLS,
    report: Report = silent,
) -> ReferenceForce:
    """Return the force of the two-dimensional film, extrapolated from two grids, and its error.

    Three grids with 1, 1/2 and 1/4 of the cells give two extrapolations. The error of the finer one is
    estimated as a third of their distance: what the extrapolation leaves is still of second order at least,
    because the edge of the ruptured zone jumps from node to node.

    Parameters
    ----------
    bearing : JournalBearing
        Its own film is not used.
    states : States
    cells : tuple of int
        Cells of the finest grid, multiples of 16 and at least (64, 16).
    report : callable

    Raises
    ------
    InputError
        If the cells break their rule.
    """
    require_cells(cells)
    e, w = bearing.kinematics(*states)
    count = e.shape[1]
    force, error = np.empty((2, count)), np.empty(count)
    for begin in range(0, count, CHUNK):
        part = slice(begin, begin + CHUNK)
        force[:, part], error[part] = _extrapolation(e[:, part], w[:, part], bearing.slenderness, cells)
        done = min(begin + CHUNK, count)
        report(done / count, f"two-dimensional reference, {done} of {count} states")
    return ReferenceForce(bearing.force_scale * force, error)


def _extrapolation(e: Array, w: Array, slenderness: float, cells: tuple[int, int]) -> tuple[Array, Array]:
    around, along = cells
    finer, _ = ReynoldsFilm(cells=cells).extrapolated(e, w, slenderness)
    coarser, _ = ReynoldsFilm(cells=(around // 2, along // 2)).extrapolated(e, w, slenderness)
    return finer, np.hypot(*(finer - coarser)) / (3.0 * np.hypot(*finer))


# Cost of one evaluation, measured so that rungs can be compared: interleaved, shortest of several rounds.


SHORTEST_RUN = 0.01
"""Length [s] of a measured run, long against the resolution of the clock."""

BATCH = (8, 8192)
"""States of a batch at least and at most."""

STILL_FALLING = 0.9
"""A batch is doubled while that lowers the cost of a state below this part of it."""


class Timed(Protocol):
    """A bearing whose forces are timed."""

    def force(self, position: ArrayLike, velocity: ArrayLike, speed: ArrayLike) -> Array:
        """Return the force, shape (2, ...)."""

    def prepare(self) -> Callable[[float, float, float, float, float], tuple[float, float]]:
        """Return the force as a function of five numbers."""


@dataclass(frozen=True, kw_only=True)
class FilmCost(Readable):
    """Cost of one force.

    Attributes
    ----------
    force_time : float [s]
        In a batch.
    call_time : float [s]
        One state at a time from Python, through `prepare()` of the bearing.
    batch : int
        States of the batch.
    """

    force_time: float
    call_time: float
    batch: int


def film_costs(
    bearings: Mapping[str, Timed],
    states: States,
    *,
    rounds: int,
    report: Report = silent,
) -> dict[str, FilmCost]:
    """Return the cost of each film at the given states, which repeat as often as the batch needs.

    Every round measures every film once, so that a disturbance of the machine hits all of them. A
    batch holds as many states as make a state cheap, and as last long enough to be measured; not more, since
    on a busy machine short runs are more often left alone.
    """
    runs = {}
    for name, bearing in bearings.items():
        report(0.0, f"batch for {name}")
        runs[name] = _batch_run(bearing, states), _call_run(bearing, states)
    shortest = {name: [np.inf, np.inf] for name in runs}
    for number in range(rounds):
        for name, pair in runs.items():
            report(number / rounds, f"cost, round {number + 1} of {rounds}: {name}")
            for k, (run, _) in enumerate(pair):
                shortest[name][k] = min(shortest[name][k], shortest_time(run, 1))
    return {
        name: FilmCost(
            force_time=shortest[name][0] / batch[1], call_time=shortest[name][1] / calls[1], batch=batch[1]
        )
        for name, (batch, calls) in runs.items()
    }


def shortest_time(call: Callable[[], object], repeats: int = 7, loops: int = 1) -> float:
    """Return the shortest time [s] of a call, among several runs of so many calls each."""
    times = []
    for _ in range(repeats):
        begin = perf_counter()
        for _ in range(loops):
            call()
        times.append(perf_counter() - begin)
    return min(times) / loops


def _batch_run(bearing: Timed, states: States) -> tuple[Callable[[], object], int]:
    """Return a call long enough to be measured, and how many states it evaluates."""
    (size, largest), each = BATCH, np.inf
    while True:
        repeated = [np.resize(part.T, (size, *part.T.shape[1:])).T.copy() for part in states]

        def run(arguments: list[np.ndarray] = repeated) -> object:
            return bearing.force(*arguments)

        run()  # The first call compiles and builds tables.
        seconds, before = shortest_time(run, 2), each
        each = seconds / size
        if size >= largest or (seconds > SHORTEST_RUN and each > STILL_FALLING * before):
            return run, size
        size *= 2


def _call_run(bearing: Timed, states: States) -> tuple[Callable[[], object], int]:
    """Return a loop over states long enough to be measured, and how many states it visits."""
    call = bearing.prepare()
    columns = np.concatenate([states.position, states.velocity, states.speed[None]]).T.tolist()
    size = 8
    while True:
        visited = [columns[k % len(columns)] for k in range(size)]

        def run(states: list[list[float]] = visited) -> None:
            for state in states:
                call(*state)

        run()
        if shortest_time(run, 1) > SHORTEST_RUN:
            return run, size
        size *= 2


# Error against cost of every journal film, on random states, against a two-dimensional reference.


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
