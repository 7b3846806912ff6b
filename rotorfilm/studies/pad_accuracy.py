"""Error against cost of the films of pads, on random states of several bearings."""

from __future__ import annotations

import warnings
from collections.abc import Sequence
from dataclasses import replace
from enum import StrEnum
from typing import NamedTuple

import numpy as np

from ..bearings.pads import LobedBearing, PadFilm, PadGridFilm, PadMapFilm, lobe_set
from ..core.errors import InputError, ValidityWarning, require_count, require_positive
from ..core.model import Array
from ..core.progress import Report, part_of, silent
from .bearing_types import CLEARANCE, RADIUS, SPEED, VISCOSITY
from .study import (
    SEED,
    FilmCase,
    States,
    Study,
    StudyModel,
    StudyResult,
    film_times,
    run_study,
    spread,
)

CELLS = (288, 24)
"""Cells of a pad, and of half its length, of the reference."""

ROUNDS = 5


class PadFamily(StrEnum):
    """What films of pads have in common."""

    MAP = "map"
    GRID = "grid"


def pad_rungs() -> tuple[StudyModel, ...]:
    """Return the films of pads, maps from coarse to fine and then grids."""
    fine = PadMapFilm().resolution
    coarse, middle = replace(fine, cells=(48, 4), nodes=(6, 6, 24)), replace(fine, nodes=(9, 7, 64))
    films: list[tuple[PadFamily, tuple[int, ...], PadFilm]] = [
        *((PadFamily.MAP, r.nodes, PadMapFilm(resolution=r)) for r in (coarse, middle, fine)),
        *(
            (PadFamily.GRID, cells, PadGridFilm(cells=cells))
            for cells in ((32, 4), (48, 8), (96, 8), (192, 16))
        ),
    ]
    return tuple(
        StudyModel(name=f"{family} {' x '.join(map(str, size))}", family=family, law=film)
        for family, size, film in films
    )


PADS = Study(
    name="pads",
    solve=lambda model, case: [replace(one.bearing, film=model.law).force(*one.states) for one in case.at],
    quantities=lambda model, case, forces: {
        "family [-]": model.family,
        "film [-]": model.name,
        **spread(_errors(case.at, forces), "median", "90 %", "99 %"),
    },
    costs=film_times("force of a pad in a batch [s]", "force of a pad alone, prepare() [s]", counted=False),
)


def pad_accuracy(
    slenderness: float,
    *,
    states: int = 100,
    seed: int = SEED,
    rungs: Sequence[StudyModel] | None = None,
    cells: tuple[int, int] = CELLS,
    rounds: int = ROUNDS,
    report: Report = silent,
) -> StudyResult:
    """Measure error and cost of every film of pads in one run.

    Parameters
    ----------
    slenderness : float [1]
        Length / diameter.
    states : int
        Random states of each bearing.
    seed : int
        Of the random numbers.
    rungs : sequence of StudyModel, optional
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
    half = PadGridFilm(cells=(cells[0] // 2, cells[1] // 2))
    with warnings.catch_warnings(action="ignore", category=ValidityWarning):
        # Near contact maps go on beyond their nodes.
        own = _errors(samples, [replace(one.bearing, film=half).force(*one.states) for one in samples])
    timed = samples[0].bearing  # films of pads cost alike
    case = FilmCase(
        models=chosen,
        at=samples,
        states=samples[0].states,
        bearing=lambda film: replace(timed, film=film),
        pads=len(timed.lobes),
        rounds=rounds,
    )
    reference = f"two-dimensional film, {cells[0]} x {cells[1]} cells a pad, extrapolated"
    conditions = {
        "length/diameter [1]": slenderness,
        "states of each bearing [1]": states,
        "seed [-]": seed,
        "bearings [-]": ", ".join(compared),
        "reference [-]": reference,
        "reference error, 90 % [1]": float(np.quantile(own, 0.9)),
        "reference error, 99 % [1]": float(np.quantile(own, 0.99)),
    }
    return run_study(
        PADS, [case], reference=reference, conditions=conditions, report=part_of(report, 0.5, 1.0)
    )


def _errors(samples: Sequence[PadSample], forces: Sequence[Array]) -> Array:
    """Return the errors of forces at all states."""
    return np.concatenate([one.errors(force) for one, force in zip(samples, forces, strict=True)])


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
