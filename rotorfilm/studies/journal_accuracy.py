"""Error against cost of every journal film, on random states, against a two-dimensional reference."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from enum import StrEnum
from functools import partial

import numpy as np

from ..bearings import journal
from ..bearings.films.law import FilmLaw
from ..core.errors import InputError, require_count, require_number, require_positive
from ..core.model import Array
from ..core.progress import Report, part_of, silent
from .study import (
    SEED,
    States,
    Study,
    StudyCase,
    StudyModel,
    StudyResult,
    film_times,
    relative_error,
    run_study,
    spread,
)

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


def journal_rungs() -> tuple[StudyModel, ...]:
    """Return the ladder, families from the cheapest to the closest."""
    fixed, rotating, free = journal.FixedArc(), journal.RotatingArc(), journal.ComplementarityArc()
    return (
        _rung(FilmFamily.SHORT, "", journal.ShortFilm()),
        *(_splitting(FilmFamily.PUBLISHED, fixed, n, 1) for n in (1, 2)),
        *(_splitting(FilmFamily.FIXED, fixed, n, None) for n in (2, 6)),
        _converged(FilmFamily.FIXED, fixed),
        *(_splitting(FilmFamily.ROTATING, rotating, n, m) for n, m in ROTATING_ORDERS),
        _converged(FilmFamily.ROTATING, rotating),
        *(_splitting(FilmFamily.REYNOLDS, journal.ReynoldsArc(), n, None, constant=True) for n in (4, 6)),
        *(_splitting(FilmFamily.FREE, free, n, m, constant=True) for n, m in ((4, 8), (6, None))),
        _converged(FilmFamily.FREE, free),
        *(_grid(FilmFamily.GRID, *cells) for cells in ((48, 4), (96, 8), (192, 16))),
        *(_grid(FilmFamily.EXTRAPOLATED, *cells) for cells in ((48, 8), (96, 8), (192, 8), (384, 16))),
        _rung(FilmFamily.MAP, "", journal.MapFilm()),
    )


def chosen_rungs(rungs: Sequence[StudyModel] | None) -> tuple[StudyModel, ...]:
    """Return the rungs to compare, the whole ladder for None.

    Raises
    ------
    InputError
        If there is none, one is not a `StudyModel`, or two have the same name.
    """
    if rungs is None:
        return journal_rungs()
    chosen = tuple(rungs)
    if not chosen or not all(isinstance(rung, StudyModel) for rung in chosen):
        raise InputError(f"rungs must hold at least one StudyModel and nothing else, got {rungs!r}")
    names = [rung.name for rung in chosen]
    if len(set(names)) < len(names):
        raise InputError(f"rungs must have different names, got {names!r}")
    return chosen


def comparison_bearing(slenderness: float) -> journal.JournalBearing:
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
    return journal.JournalBearing(
        radius=0.05, length=0.1 * slenderness, clearance=1e-4, viscosity=0.1, film=journal.MapFilm()
    )


def _rung(family: FilmFamily, label: str, film: FilmLaw) -> StudyModel:
    return StudyModel(name=f"{family} {label}".strip(), family=family, label=label, law=film)


def _splitting(
    family: FilmFamily, arc: journal.Rupture, n: int, m: int | None, constant: bool = False
) -> StudyModel:
    label = f"({n}{'+c' if constant else ''}, {'all' if m is None else m})"
    return _rung(family, label, journal.SplittingFilm(order=(n, m), constant=constant, rupture=arc))


def _converged(family: FilmFamily, arc: journal.Rupture) -> StudyModel:
    return _rung(family, "converged", journal.SpectralArcFilm(rupture=arc, degree=CONVERGED))


def _grid(family: FilmFamily, around: int, along: int) -> StudyModel:
    plain = journal.ReynoldsFilm(cells=(around, along))
    film = plain if family is FilmFamily.GRID else journal.ExtrapolatedFilm(film=plain)
    return _rung(family, f"{around} x {along}", film)


# The states at which journal films are compared, and the two-dimensional solution there.


SPEED = 100.0
"""Angular speed of the comparisons [rad/s]; in dimensionless form nothing depends on it."""

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


def _pair(name: str, values: tuple[float, float]) -> tuple[float, float]:
    if not isinstance(values, tuple) or len(values) != 2:
        raise InputError(f"{name} must be two numbers, got {values!r}")
    low, high = (require_number(name, value) for value in values)
    return low, high


LARGE = StateRange()
"""Large motion: from strong squeeze to whirl at one and a half times the speed, either way."""

SMALL = StateRange(squeeze=0.05, whirl=(-0.05, 0.05))
"""Small motion about static equilibria."""


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


def squeeze_share(bearing: journal.JournalBearing, states: States) -> float:
    """Return the share of the states in which squeeze outweighs the wedge, |g_c| > |g_s| [1]."""
    e, w = bearing.kinematics(*states)
    return float(np.mean(np.abs(np.sum(e * w, axis=0)) > np.abs(e[0] * w[1] - e[1] * w[0])))


def reference_force(
    bearing: journal.JournalBearing,
    states: States,
    *,
    cells: tuple[int, int] = REFERENCE_CELLS,
    report: Report = silent,
) -> tuple[Array, Array]:
    """Return the force (2, n) [N] of the two-dimensional film, extrapolated, and its relative error (n,) [1].

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
    return bearing.force_scale * force, error


def _extrapolation(e: Array, w: Array, slenderness: float, cells: tuple[int, int]) -> tuple[Array, Array]:
    around, along = cells
    finer, _ = journal.ReynoldsFilm(cells=cells).extrapolated(e, w, slenderness)
    coarser, _ = journal.ReynoldsFilm(cells=(around // 2, along // 2)).extrapolated(e, w, slenderness)
    return finer, np.hypot(*(finer - coarser)) / (3.0 * np.hypot(*finer))


# Error against cost of every journal film, on random states, against a two-dimensional reference.


TENSION = 0.01
"""Tension in a film, in its largest pressure, above which it counts as carrying tension."""

ROUNDS = 9
"""Rounds of timing, of which the shortest counts."""


def journal_accuracy(
    slenderness: float,
    *,
    states: int = 300,
    ranges: StateRange = LARGE,
    seed: int = SEED,
    rungs: Sequence[StudyModel] | None = None,
    cells: tuple[int, int] = REFERENCE_CELLS,
    rounds: int = ROUNDS,
    report: Report = silent,
) -> StudyResult:
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
        Seed of the random numbers.
    rungs : sequence of StudyModel, optional
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
    models, bearing = chosen_rungs(rungs), comparison_bearing(slenderness)
    sample = random_states(ranges, count=states, clearance=bearing.clearance, seed=seed)
    reference, own = reference_force(bearing, sample, cells=cells, report=part_of(report, 0.0, 0.5))
    at = bearing.kinematics(*sample)

    def quantities(model: StudyModel, case: StudyCase, force: Array) -> dict[str, object]:
        pulled = journal.tension(model.law, *at, bearing.slenderness)
        return {
            "family [-]": model.family,
            "label [-]": model.label,
            **spread(relative_error(force, reference), "median", "99 %", "largest"),
            "states in tension [1]": float(np.mean(pulled > TENSION)),
        }

    fitted = partial(journal.fitted_bearing, bearing)
    study = Study(
        name="journal",
        solve=lambda model, case: fitted(model.law).force(*sample),
        quantities=quantities,
        costs=film_times("force in a batch [s]", "force alone, prepare() [s]", sample, fitted, rounds=rounds),
    )
    text = f"2-D film, {cells[0]} x {cells[1]} and {cells[0] // 2} x {cells[1] // 2} cells extrapolated"
    conditions = {
        "length/diameter [1]": slenderness,
        "states [1]": states,
        "seed [-]": seed,
        "eccentricity ratio from [1]": ranges.eccentricity_ratio[0],
        "eccentricity ratio to [1]": ranges.eccentricity_ratio[1],
        "largest squeeze rate/speed [1]": ranges.squeeze,
        "whirl/speed from [1]": ranges.whirl[0],
        "whirl/speed to [1]": ranges.whirl[1],
        "squeeze above wedge [1]": squeeze_share(bearing, sample),
        "reference [-]": text,
        "reference error, median [1]": float(np.median(own)),
        "reference error, 99 % [1]": float(np.quantile(own, 0.99)),
    }
    case = StudyCase(models=models)
    return run_study(study, [case], reference=text, conditions=conditions, report=part_of(report, 0.5, 1.0))
