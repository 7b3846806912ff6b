"""Error against cost of the films of pads, on random states of several bearings."""

from __future__ import annotations

import warnings
from collections.abc import Sequence
from dataclasses import dataclass, replace
from enum import StrEnum
from typing import NamedTuple

import numpy as np

from ..bearings.pads import LobedBearing, PadFilm, PadGridFilm, PadMapFilm, lobe_set
from ..core.errors import InputError, ValidityWarning, require_count, require_positive
from ..core.model import Array
from ..core.progress import Report, part_of, silent
from ..core.readable import Readable
from .bearing_types import CLEARANCE, RADIUS, SPEED, VISCOSITY
from .journal_accuracy import SEED, FilmCost, States, film_costs

CELLS = (288, 24)
"""Cells of a pad, and of half its length, of the reference."""

ROUNDS = 5

TIMED = 1
"""Bearings whose forces are timed: films of pads cost alike."""


class PadFamily(StrEnum):
    """What films of pads have in common."""

    MAP = "map"
    GRID = "grid"


@dataclass(frozen=True, kw_only=True)
class ComparedPad:
    """One film of pads of the ladder.

    Attributes
    ----------
    name : str
    family : PadFamily
    film : PadFilm
    """

    name: str
    family: PadFamily
    film: PadFilm


@dataclass(frozen=True, kw_only=True)
class PadRung(Readable):
    """Error and cost of one film of pads.

    Attributes
    ----------
    name : str
    family : PadFamily
    median_error, usual_error, high_error : float [1]
        Median, 90th and 99th percentile of |force - reference| over the force, or over 5 % of the largest at
        that place where that is more.
    cost : FilmCost
        Of one pad.
    """

    name: str
    family: PadFamily
    median_error: float
    usual_error: float
    high_error: float
    cost: FilmCost


@dataclass(frozen=True, kw_only=True)
class PadAccuracy(Readable):
    """Error against cost of the films of pads.

    Attributes
    ----------
    slenderness : float [1]
        Length / diameter.
    bearings : tuple of str
        Of which states were drawn.
    states, seed : int
        Of each bearing, and the seed of the random numbers.
    reference : str
        What the errors are measured against.
    reference_usual, reference_high : float [1]
        The 90th and 99th percentile of the distance of the reference from half its cells: errors below mean
        nothing.
    rungs : tuple of PadRung
    """

    slenderness: float
    bearings: tuple[str, ...]
    states: int
    seed: int
    reference: str
    reference_usual: float
    reference_high: float
    rungs: tuple[PadRung, ...]

    def columns(self) -> dict[str, list[object]]:
        """Return the table of the rungs, headings with units; the conditions repeat in every row."""
        rows = [
            {
                "family [-]": rung.family,
                "film [-]": rung.name,
                "median error [1]": rung.median_error,
                "90 % error [1]": rung.usual_error,
                "99 % error [1]": rung.high_error,
                "force of a pad in a batch [s]": rung.cost.force_time,
                "force of a pad alone, prepare() [s]": rung.cost.call_time,
                "length/diameter [1]": self.slenderness,
                "states of each bearing [1]": self.states,
                "seed [-]": self.seed,
                "bearings [-]": ", ".join(self.bearings),
                "reference [-]": self.reference,
                "reference error, 90 % [1]": self.reference_usual,
                "reference error, 99 % [1]": self.reference_high,
            }
            for rung in self.rungs
        ]
        return {heading: [row[heading] for row in rows] for heading in rows[0]}


def pad_rungs() -> tuple[ComparedPad, ...]:
    """Return the films of pads, maps from coarse to fine and then grids."""
    fine = PadMapFilm().resolution
    coarse, middle = replace(fine, cells=(48, 4), nodes=(6, 6, 24)), replace(fine, nodes=(9, 7, 64))
    maps = [(f"map {' x '.join(map(str, r.nodes))}", r) for r in (coarse, middle, fine)]
    grids = ((32, 4), (48, 8), (96, 8), (192, 16))
    return (
        *(ComparedPad(name=n, family=PadFamily.MAP, film=PadMapFilm(resolution=r)) for n, r in maps),
        *(
            ComparedPad(name=f"grid {a} x {b}", family=PadFamily.GRID, film=PadGridFilm(cells=(a, b)))
            for a, b in grids
        ),
    )


def pad_accuracy(
    slenderness: float,
    *,
    states: int = 100,
    seed: int = SEED,
    rungs: Sequence[ComparedPad] | None = None,
    cells: tuple[int, int] = CELLS,
    rounds: int = ROUNDS,
    report: Report = silent,
) -> PadAccuracy:
    """Measure error and cost of every film of pads in one run.

    Parameters
    ----------
    slenderness : float [1]
        Length / diameter.
    states : int
        Random states of each bearing.
    seed : int
        Of the random numbers.
    rungs : sequence of ComparedPad, optional
        `pad_rungs()` by default.
    cells : (int, int)
        Cells of the reference, multiples of 8 and at least (32, 8).
    rounds : int
        Rounds of timing, the shortest counts.
    report : callable, optional
        Told how far the job is.

    Raises
    ------
    InputError
        If a number is out of range, or there are no rungs.
    """
    require_positive("slenderness", slenderness)
    require_count("rounds", rounds)
    chosen = pad_rungs() if rungs is None else tuple(rungs)
    if not chosen:
        raise InputError("rungs must hold one at least, got ()")
    compared = compared_bearings(slenderness)
    samples = []
    for k, bearing in enumerate(compared.values()):
        report(0.5 * k / len(compared), f"reference {k + 1} of {len(compared)}")
        samples.append(pad_sample(bearing, states, seed + k, cells))
    own = _errors(samples, PadGridFilm(cells=(cells[0] // 2, cells[1] // 2)))
    measured = []
    for done, rung in enumerate(chosen):
        first, last = (0.5 + 0.5 * (done + k) / len(chosen) for k in (0, 1))
        measured.append(_measured(rung, samples, rounds, part_of(report, first, last)))
    return PadAccuracy(
        slenderness=slenderness,
        bearings=tuple(compared),
        states=states,
        seed=seed,
        reference=f"two-dimensional film, {cells[0]} x {cells[1]} cells a pad, extrapolated",
        reference_usual=float(np.quantile(own, 0.9)),
        reference_high=float(np.quantile(own, 0.99)),
        rungs=tuple(measured),
    )


def _errors(samples: Sequence[PadSample], film: PadFilm) -> Array:
    """Return the errors of a film at all states."""
    found = (replace(sample.bearing, film=film).force(*sample.states) for sample in samples)
    # Near contact maps go on beyond their nodes.
    with warnings.catch_warnings(action="ignore", category=ValidityWarning):
        return np.concatenate([one.errors(force) for one, force in zip(samples, found, strict=True)])


def _measured(rung: ComparedPad, samples: Sequence[PadSample], rounds: int, report: Report) -> PadRung:
    errors = _errors(samples, rung.film)
    median, usual, high = np.quantile(errors, (0.5, 0.9, 0.99)).tolist()
    with warnings.catch_warnings(action="ignore", category=ValidityWarning):
        costs = [
            cost
            for one in samples[:TIMED]
            for cost in film_costs(
                {rung.name: replace(one.bearing, film=rung.film)}, one.states, rounds=rounds, report=report
            ).values()
        ]
    pads = sum(len(one.bearing.lobes) for one in samples[:TIMED])
    return PadRung(
        name=rung.name,
        family=rung.family,
        median_error=median,
        usual_error=usual,
        high_error=high,
        cost=FilmCost(
            force_time=sum(cost.force_time for cost in costs) / pads,
            call_time=sum(cost.call_time for cost in costs) / pads,
            batch=costs[0].batch,
        ),
    )


# Random states of bearings of fixed pads, and the two-dimensional film of all pads there.


BEARINGS = (("elliptical", 0.5), ("three_lobe", 0.3), ("four_lobe", 0.5), ("offset_halves", 0.5))
"""Sets of lobes with their preloads."""

WAY = (0.05, 0.95)
"""Of a journal towards contact."""

SQUEEZE = 0.5
"""Largest velocity / (assembled clearance x speed)."""

FLOOR = 0.05
"""Of the largest force at a place, below which errors are relative to that."""

DIRECTIONS = 16
"""Of the velocity, over which that force is the largest."""


class PadSample(NamedTuple):
    """States of a bearing, the force on its journal (2, n) [N], and what errors are relative to (n,) [N]."""

    bearing: LobedBearing
    states: States
    force: Array
    scale: Array

    def errors(self, force: Array) -> Array:
        """Return how far a force (2, n) is off, over |force| or 5 % of the largest at that place, (n,)."""
        return np.asarray(np.hypot(*(force - self.force)) / self.scale)


def compared_bearings(slenderness: float) -> dict[str, LobedBearing]:
    """Return the bearings of whose states the films are compared, by name."""
    return {
        f"{name.replace('_', ' ')} with preload {preload:g}": LobedBearing(
            radius=RADIUS,
            length=2.0 * RADIUS * slenderness,
            viscosity=VISCOSITY,
            assembled_clearance=CLEARANCE,
            lobes=lobe_set(name, preload=preload),
        )
        for name, preload in BEARINGS
    }


def pad_sample(bearing: LobedBearing, count: int, seed: int, cells: tuple[int, int]) -> PadSample:
    """Return random states of a bearing with their force by grids of so many cells."""
    states = lobe_states(bearing, count, seed)
    force = replace(bearing, film=PadGridFilm(cells=cells)).force(*states)
    # Near contact maps go on beyond their nodes.
    with warnings.catch_warnings(action="ignore", category=ValidityWarning):
        scale = np.maximum(np.hypot(*force), FLOOR * largest_force(bearing, states))
    return PadSample(bearing, states, force, scale)


def lobe_states(bearing: LobedBearing, count: int, seed: int) -> States:
    """Return random states of a journal that turns at `SPEED`.

    It is at a uniform part of the way to contact in a uniform direction, and has a velocity up to half of
    clearance times speed in a uniform direction.
    """
    require_count("states", count)
    require_count("seed", seed, least=0)
    random = np.random.default_rng(seed)
    outward, moving = (_unit(random.uniform(0.0, 2.0 * np.pi, count)) for _ in range(2))
    position = outward * (random.uniform(*WAY, count) * way_to_contact(bearing, outward))
    velocity = moving * (random.uniform(0.0, SQUEEZE, count) * CLEARANCE * SPEED)
    return States(position, velocity, np.full(count, SPEED))


def way_to_contact(bearing: LobedBearing, outward: Array) -> Array:
    """Return how far a journal may move from the center in directions (2, n) [m], (n,), by bisection."""
    near, far = np.zeros(outward.shape[1]), np.full(outward.shape[1], 10.0 * bearing.clearance)
    for _ in range(60):
        middle = 0.5 * (near + far)
        free = bearing.minimum_film(outward * middle) > 0.0
        near, far = np.where(free, middle, near), np.where(free, far, middle)
    return near


def largest_force(bearing: LobedBearing, states: States) -> Array:
    """Return the largest force at the places of states (n,) [N], over directions of velocities as large."""
    size = np.hypot(*states.velocity)
    around = _unit(2.0 * np.pi * np.arange(DIRECTIONS) / DIRECTIONS)
    velocity = around[:, None, :] * size[:, None]
    forces = bearing.force(states.position[:, :, None], velocity, states.speed[:, None])
    return np.asarray(np.hypot(*forces).max(axis=-1))


def _unit(angle: Array) -> Array:
    return np.stack([np.cos(angle), np.sin(angle)])
