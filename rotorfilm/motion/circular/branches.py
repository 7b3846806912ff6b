"""All synchronous orbits at given unbalances: branches between the folds, their stability, and contact."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass, replace
from itertools import pairwise
from typing import ClassVar

import numpy as np
from numpy.typing import ArrayLike
from scipy.optimize import brentq

from ...errors import InputError, require_finite
from ...inputs.kinds import arguments
from ...model import Array, Reaction
from ...readable.result import Drawable, Item, Readable, items_of
from ...results import CircularOrbit
from ...rotors import RigidRotor
from .orbit_points import OrbitRotor, growth_rates, orbit_points, orbit_rotor, orbit_slope

NODES = 160
STARTS = 100
NEWTON_STEPS = 40
TOLERANCE = 1e-13
WALL = 1e-9
"""Distance from the wall, in clearances, where the orbits end."""

_BOUNDED = 1e-2


@dataclass(frozen=True, kw_only=True)
class OrbitBranch(Readable):
    """Orbits between two folds, over the unbalance: arrays of shape (n,).

    Attributes
    ----------
    unbalance : ndarray [kg m]
        Those of the unbalances asked for at which the branch exists; empty where it does at none of them.
    eccentricity_ratio, phase, transmissibility, growth_rate : ndarray [1], [rad], [1], [1/s]
        As in `CircularOrbit`.
    """

    unbalance: Array
    eccentricity_ratio: Array
    phase: Array
    transmissibility: Array
    growth_rate: Array

    _shown: ClassVar[tuple[str, ...]] = ("stable",)

    @property
    def stable(self) -> np.ndarray:
        """Whether small disturbances die out, shape (n,)."""
        return self.growth_rate < 0.0


@dataclass(frozen=True, kw_only=True)
class Fold(Readable):
    """An unbalance at which two orbits merge and the rotor jumps.

    Attributes
    ----------
    eccentricity_ratio : float [1]
    unbalance : float [kg m]
    upward : bool
        Whether the jump is to a larger orbit, as the unbalance grows; otherwise to a smaller one, as it
        falls.
    """

    eccentricity_ratio: float
    unbalance: float
    upward: bool


@dataclass(frozen=True, kw_only=True)
class SynchronousOrbits(Drawable):
    """The circular orbits of a rotor at one speed; a data frame has a row for each, branch by branch.

    Attributes
    ----------
    branches : tuple of OrbitBranch
        From the smallest orbits to the largest; one may be empty, as all are where the rotor hits the wall.
    folds : tuple of Fold
        Between the branches.
    contact_unbalance : float or None [kg m]
        Unbalance whose orbit is as wide as the clearance; None for a film whose force has no bound
        there, and for one that is not meant up to the wall (a map).
    speed : float [rad/s]
    """

    branches: tuple[OrbitBranch, ...]
    folds: tuple[Fold, ...]
    contact_unbalance: float | None
    speed: float

    _along: ClassVar[str] = "orbit"

    def _items(self) -> Iterator[Item]:
        """Yield what all branches hold, one behind the other, and what is said of them as a whole."""
        along = (self._along,)
        counts = [branch.unbalance.size for branch in self.branches]
        yield Item("branch", np.repeat(np.arange(len(counts)), counts), "", along)
        for items in zip(*(items_of(one, one._shown) for one in self.branches), strict=True):
            joined = np.concatenate([np.atleast_1d(item.value) for item in items])
            yield Item(items[0].name, joined, items[0].unit, along)
        for item in items_of(self):
            if item.name == "speed":
                yield item._replace(value=np.full(sum(counts), item.value), shape=along)
            elif item.name != "branches":
                yield item

    def at(self, unbalance: float) -> tuple[CircularOrbit, ...]:
        """Return the orbits at one of the unbalances asked for, the smallest first.

        There is none where the rotor hits the wall.
        """
        return tuple(
            CircularOrbit(
                eccentricity_ratio=float(branch.eccentricity_ratio[k]),
                unbalance=unbalance,
                speed=self.speed,
                phase=float(branch.phase[k]),
                transmissibility=float(branch.transmissibility[k]),
                growth_rate=float(branch.growth_rate[k]),
            )
            for branch in self.branches
            for k in np.nonzero(branch.unbalance == unbalance)[0]
        )


@arguments
def synchronous_orbits(
    rotor: RigidRotor, reaction: Reaction, unbalances: ArrayLike | None = None
) -> SynchronousOrbits:
    """Return every synchronous circular orbit of an unbalanced rigid rotor, stable or not.

    Parameters
    ----------
    rotor : RigidRotor
        At constant speed, without static load (preloaded springs carry the weight).
    reaction : Reaction
        Isotropic: a `PorousDamper`, usually inside a `Sprung`.
    unbalances : array_like, shape (n,) [kg m], optional
        Positive; the rotor's own by default.

    Returns
    -------
    SynchronousOrbits
        An unbalance beyond `contact_unbalance` and beyond every branch has no orbit: the rotor hits the wall.

    Raises
    ------
    InputError
        If there is no unbalance or one is not positive, the speed not constant, the rotor loaded or the film
        anisotropic.

    Notes
    -----
    Folds are zeros of d(u^2)/de, which the exact Jacobian of the film gives; between them u(e) is monotone
    and is inverted by Newton's method within brackets.
    """
    wanted = np.atleast_1d(
        require_finite("unbalances", rotor.unbalance if unbalances is None else unbalances)
    )
    if wanted.ndim != 1 or not wanted.size or np.any(wanted <= 0.0):
        given = wanted if unbalances is None else unbalances
        raise InputError(f"unbalances must be positive and not empty, got {given!r}")
    system = orbit_rotor(rotor, reaction)
    nodes = _radii(system.reach)
    folds = _folds(system, nodes)
    ends = [nodes[0], *(fold.eccentricity_ratio for fold in folds), nodes[-1]]
    branches = tuple(_branch(system, low, high, wanted) for low, high in pairwise(ends))
    return SynchronousOrbits(
        branches=branches,
        folds=folds,
        contact_unbalance=_contact(system),
        speed=math.copysign(system.speed, rotor.profile.speeds[0]),
    )


@arguments
def orbits_over_speed(
    rotor: RigidRotor, reaction: Reaction, speeds: ArrayLike
) -> tuple[SynchronousOrbits, ...]:
    """Return the orbits of a rotor with its own unbalance at each of the speeds [rad/s]."""
    values = np.atleast_1d(require_finite("speeds", speeds))
    return tuple(synchronous_orbits(replace(rotor, speed=float(speed)), reaction) for speed in values)


def _radii(reach: float) -> Array:
    """Return eccentricity ratios from nearly 0 to the film's reach or nearly 1, denser towards the wall."""
    depth = np.linspace(math.log1p(-1e-7), math.log(WALL), NODES)
    inner = np.linspace(1e-7, 0.98, NODES)
    radii = np.union1d(inner, -np.expm1(depth[depth < math.log(0.02)]))
    return radii if reach >= 1.0 else np.append(radii[radii < reach], reach)


def _folds(system: OrbitRotor, nodes: Array) -> tuple[Fold, ...]:
    slopes = orbit_slope(system, nodes).slope
    folds = []
    for k in np.nonzero(np.diff(np.sign(slopes)))[0]:
        at = brentq(_slope_at, nodes[k], nodes[k + 1], args=(system,), xtol=1e-14, rtol=1e-14)
        folds.append(
            Fold(
                eccentricity_ratio=at,
                unbalance=_unbalances(system, np.array([at]))[0],
                upward=bool(slopes[k] > 0.0),
            )
        )
    return tuple(folds)


def _slope_at(eccentricity_ratio: float, system: OrbitRotor) -> float:
    return float(orbit_slope(system, np.array([eccentricity_ratio])).slope[0])


def _unbalances(system: OrbitRotor, eccentricity_ratio: Array) -> Array:
    return np.abs(orbit_points(system, eccentricity_ratio).pull) / system.speed**2


def _branch(system: OrbitRotor, low: float, high: float, wanted: Array) -> OrbitBranch:
    """Return the orbits with eccentricity ratios between two folds at the wanted unbalances."""
    ends = _unbalances(system, np.array([low, high]))
    unbalance = wanted[(wanted >= ends.min()) & (wanted <= ends.max())]
    eps = _inverted(system, low, high, unbalance, rising=bool(ends[1] > ends[0]))
    points = orbit_points(system, eps)
    return OrbitBranch(
        unbalance=unbalance,
        eccentricity_ratio=eps,
        phase=np.angle(points.pull),
        transmissibility=np.abs(points.force) / np.abs(points.pull),
        growth_rate=growth_rates(system, orbit_slope(system, eps)),
    )


def _inverted(system: OrbitRotor, low: float, high: float, unbalance: Array, *, rising: bool) -> Array:
    """Return the eccentricity ratios of the unbalances on a monotone branch, by Newton within brackets."""
    target = (unbalance * system.speed**2) ** 2
    lower, upper = np.full(unbalance.shape, low), np.full(unbalance.shape, high)
    # A start from a coarse table of the branch, denser at the folds, where u(e) is level.
    table = low + (high - low) * 0.5 * (1.0 - np.cos(np.pi * np.linspace(0.0, 1.0, STARTS)))
    order = slice(None) if rising else slice(None, None, -1)
    eps = np.interp(unbalance, _unbalances(system, table)[order], table[order])
    for _ in range(NEWTON_STEPS):
        here = orbit_slope(system, eps)
        slope, excess = here.slope * system.clearance, np.abs(here.pull) ** 2 - target
        above = (excess > 0.0) == rising
        lower, upper = np.where(above, lower, eps), np.where(above, eps, upper)
        step = eps - excess / np.where(slope == 0.0, 1.0, slope)
        settled = (np.abs(step - eps) <= TOLERANCE * eps) | (np.abs(excess) <= TOLERANCE * target)
        inside = (step > lower) & (step < upper)
        eps = np.where(settled, eps, np.where(inside, step, 0.5 * (lower + upper)))
        if np.all(settled):
            break
    return eps


def _contact(system: OrbitRotor) -> float | None:
    """Return the unbalance of the orbit as wide as the clearance, if the film is bounded there."""
    if system.reach < 1.0:
        return None
    near, nearer = _unbalances(system, 1.0 - np.array([1e3 * WALL, WALL]))
    return float(nearer) if abs(nearer - near) <= _BOUNDED * near else None
