"""The states at which journal films are compared, and the two-dimensional solution there."""

from __future__ import annotations

from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from ...bearings.journal import JournalBearing, ReynoldsFilm
from ...errors import InputError, require_count, require_number
from ...model import Array
from ...progress import Report, silent

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
