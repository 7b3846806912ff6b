"""Error against cost of the films of pads, on random states of several bearings."""

from __future__ import annotations

import warnings
from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from ..bearings.pads import LobedBearing, PadFilm, PadGridFilm, PadMapFilm, lobe_set
from ..core.errors import InputError, ValidityWarning, require_count, require_positive
from ..core.model import Array
from ..core.progress import Report, part_of, silent
from .bearing_types import CLEARANCE, RADIUS, SPEED, VISCOSITY
from .study import SEED, States, Study, StudyCase, StudyModel, StudyResult, film_times, run_study, spread

CELLS = (288, 24)
"""Cells of a pad, and of half its length, of the reference."""

ROUNDS = 5


def pad_rungs() -> tuple[StudyModel, ...]:
    """Return the films of pads, maps from coarse to fine and then grids."""
    fine = PadMapFilm().resolution
    coarse, middle = replace(fine, cells=(48, 4), nodes=(6, 6, 24)), replace(fine, nodes=(9, 7, 64))
    films: list[tuple[str, tuple[int, ...], PadFilm]] = [
        *(("map", r.nodes, PadMapFilm(resolution=r)) for r in (coarse, middle, fine)),
        *(("grid", cells, PadGridFilm(cells=cells)) for cells in ((32, 4), (48, 8), (96, 8), (192, 16))),
    ]
    return tuple(
        StudyModel(name=f"{family} {' x '.join(map(str, size))}", family=family, law=film)
        for family, size, film in films
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
        Seed of the random numbers.
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

    def errors(film: PadFilm) -> Array:
        """Return the errors of a film at all states."""
        return np.concatenate(
            [
                np.hypot(*(replace(bearing, film=film).force(*sample) - force)) / scale
                for bearing, (sample, force, scale) in zip(compared.values(), samples, strict=True)
            ]
        )

    with warnings.catch_warnings(action="ignore", category=ValidityWarning):
        # Near contact maps go on beyond their nodes.
        own = errors(PadGridFilm(cells=(cells[0] // 2, cells[1] // 2)))
    timed = next(iter(compared.values()))  # films of pads cost alike
    study = Study(
        name="pads",
        solve=lambda model, case: errors(model.law),
        quantities=lambda model, case, found: {
            "family [-]": model.family,
            "film [-]": model.name,
            **spread(found, "median", "90 %", "99 %"),
        },
        costs=film_times(
            "force of a pad in a batch [s]",
            "force of a pad alone, prepare() [s]",
            samples[0][0],
            lambda film: replace(timed, film=film),
            rounds=rounds,
            pads=len(timed.lobes),
            sized=False,
        ),
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
    case = StudyCase(models=chosen)
    return run_study(
        study, [case], reference=reference, conditions=conditions, report=part_of(report, 0.5, 1.0)
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


def pad_sample(
    bearing: LobedBearing, count: int, seed: int, cells: tuple[int, int]
) -> tuple[States, Array, Array]:
    """Return random states of a bearing, their force (2, n) [N] by a grid, and what errors are relative to.

    That is |force|, or 5 % of the largest at that place, (n,) [N].
    """
    states = lobe_states(bearing, count, seed)
    force = replace(bearing, film=PadGridFilm(cells=cells)).force(*states)
    # Near contact maps go on beyond their nodes.
    with warnings.catch_warnings(action="ignore", category=ValidityWarning):
        return states, force, np.maximum(np.hypot(*force), FLOOR * largest_force(bearing, states))


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
