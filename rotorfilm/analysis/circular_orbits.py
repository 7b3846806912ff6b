"""All synchronous orbits at given unbalances: branches between the folds, their stability, and contact."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass, replace
from itertools import pairwise
from typing import TYPE_CHECKING, Any, ClassVar, NamedTuple

import numpy as np
from numpy.typing import ArrayLike
from scipy.optimize import brentq

from ..core import port
from ..core.errors import InputError, brief, require_finite, require_kind, require_number, require_positive
from ..core.frames import ResultTable
from ..core.inputs import arguments
from ..core.model import Array
from ..core.readable import Drawable, Item, Readable, items_of, table_of
from ..core.results import CircularOrbit, InertialCoefficients, Trajectory
from ..core.signals import Signal, signals_of
from ..rotors import RigidRotor
from ..rotors.structure import rotating_linearization
from .coefficients import coefficients
from .linearize import state_space
from .threads import one_blas_thread

if TYPE_CHECKING:
    import control

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
        Eccentricity ratio, phase, transmissibility and growth rate as in `CircularOrbit`.
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
        Branches from the smallest orbits to the largest; one may be empty, as all are where the rotor hits
        the wall.
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


@one_blas_thread
@arguments
def synchronous_orbits(
    rotor: RigidRotor, reaction: port.Reaction, unbalances: ArrayLike | None = None
) -> SynchronousOrbits:
    """Return every synchronous circular orbit of an unbalanced rigid rotor, stable or not.

    Parameters
    ----------
    rotor : RigidRotor
        Rotor at constant speed, without static load (preloaded springs carry the weight).
    reaction : Reaction
        Isotropic: a `PorousDamper`, usually `with_springs`.
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
        raise InputError(f"unbalances must be positive and not empty, got {brief(given)}")
    system = orbit_rotor(rotor, reaction)
    nodes = _radii(system.largest_ratio)
    folds = _folds(system, nodes)
    ends = [nodes[0], *(fold.eccentricity_ratio for fold in folds), nodes[-1]]
    branches = tuple(_branch(system, low, high, wanted) for low, high in pairwise(ends))
    return SynchronousOrbits(
        branches=branches,
        folds=folds,
        contact_unbalance=_contact(system),
        speed=math.copysign(system.speed, rotor.profile.speeds[0]),
    )


@dataclass(frozen=True, kw_only=True)
class OrbitsOverSpeed(Drawable):
    """The circular orbits of a rotor with one unbalance over speed: the response curve of its damper.

    Attributes
    ----------
    unbalance : float [kg m]
    orbits : tuple of CircularOrbit
        Orbits by speed, at each from the smallest; none where the rotor hits the wall.
    """

    unbalance: float
    orbits: tuple[CircularOrbit, ...]

    _tabled: ClassVar[tuple[str, ...]] = ("orbits",)

    def to_table(self) -> ResultTable:
        """Return a table with one row for each orbit."""
        return table_of(self.orbits, "orbits") if self.orbits else ResultTable(())

    def _pages(self) -> tuple[ResultTable, ...]:
        return (self.to_table(),) if self.orbits else ()


@one_blas_thread
@arguments
def orbits_over_speed(rotor: RigidRotor, reaction: port.Reaction, speeds: ArrayLike) -> OrbitsOverSpeed:
    """Return the orbits of a rotor with its own unbalance at each of the speeds [rad/s]."""
    values = np.atleast_1d(require_finite("speeds", speeds))
    found = (synchronous_orbits(replace(rotor, speed=float(speed)), reaction) for speed in values)
    every = tuple(orbit for one in found for orbit in one.at(rotor.unbalance))
    return OrbitsOverSpeed(unbalance=rotor.unbalance, orbits=every)


def _radii(largest_ratio: float) -> Array:
    """Return eccentricity ratios from nearly 0 to the film's reach or nearly 1, denser towards the wall."""
    depth = np.linspace(math.log1p(-1e-7), math.log(WALL), NODES)
    inner = np.linspace(1e-7, 0.98, NODES)
    radii = np.union1d(inner, -np.expm1(depth[depth < math.log(0.02)]))
    return radii if largest_ratio >= 1.0 else np.append(radii[radii < largest_ratio], largest_ratio)


def _folds(system: OrbitRotor, nodes: Array) -> tuple[Fold, ...]:
    slopes = orbit_slope(system, nodes).slope
    folds = []
    for k in np.nonzero(np.diff(np.sign(slopes)))[0]:
        at = brentq(lambda eps: _squared_slope(system, eps), nodes[k], nodes[k + 1], xtol=1e-14, rtol=1e-14)
        folds.append(
            Fold(
                eccentricity_ratio=at,
                unbalance=unbalance_at(system, at),
                upward=bool(slopes[k] > 0.0),
            )
        )
    return tuple(folds)


def _branch(system: OrbitRotor, low: float, high: float, wanted: Array) -> OrbitBranch:
    """Return the orbits with eccentricity ratios between two folds at the wanted unbalances."""
    ends = unbalances(system, np.array([low, high]))
    unbalance = wanted[(wanted >= ends.min()) & (wanted <= ends.max())]
    eps = _inverted(system, low, high, unbalance, rising=bool(ends[1] > ends[0]))
    pull, force = orbit_points(system, eps)
    return OrbitBranch(
        unbalance=unbalance,
        eccentricity_ratio=eps,
        phase=np.angle(pull),
        transmissibility=np.abs(force) / np.abs(pull),
        growth_rate=growth_rates(system, orbit_slope(system, eps)),
    )


def _inverted(system: OrbitRotor, low: float, high: float, unbalance: Array, *, rising: bool) -> Array:
    """Return the eccentricity ratios of the unbalances on a monotone branch, by Newton within brackets."""
    target = (unbalance * system.speed**2) ** 2
    lower, upper = np.full(unbalance.shape, low), np.full(unbalance.shape, high)
    # A start from a coarse table of the branch, denser at the folds, where u(e) is level.
    table = low + (high - low) * 0.5 * (1.0 - np.cos(np.pi * np.linspace(0.0, 1.0, STARTS)))
    order = slice(None) if rising else slice(None, None, -1)
    eps = np.interp(unbalance, unbalances(system, table)[order], table[order])
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
    if system.largest_ratio < 1.0:
        return None
    near, nearer = unbalances(system, 1.0 - np.array([1e3 * WALL, WALL]))
    return float(nearer) if abs(nearer - near) <= _BOUNDED * near else None


# Synchronous circular orbits of a rigid rotor on an isotropic film: unbalance as a function of the radius.
#
# On a circular orbit the film force is constant in axes that turn with it, so the unbalance that keeps the
# radius e is explicit. With F_r outward and F_t in the sense of rotation, springs included,
#
#     u w^2 exp(i b) = -(m w^2 e + F_r) + i F_t,    T_r = |F|/(u w^2),
#
# b being the angle from the unbalance to the displacement (docs/damper.md).


_ISOTROPY = 1e-6


class OrbitRotor(NamedTuple):
    """What of a rotor and its film the orbits need: constants in SI units."""

    mass: float
    speed: float
    clearance: float
    reaction: Any
    largest_ratio: float
    """Largest eccentricity ratio that the film is meant for."""


class OrbitSlope(NamedTuple):
    """Derivatives along the orbits.

    Attributes
    ----------
    slope : ndarray, shape (n,) [N2/m]
        d(u w^2)^2/de over the radius.
    film : ndarray, shape (2, 5, n)
        Jacobian of the film.
    pull : ndarray of complex, shape (n,) [N]
        u w^2 exp(i b).
    added : tuple of two ndarrays or None
        Added of a film with inertia, as `orbit_mass` returns it.
    """

    slope: Array
    film: np.ndarray
    pull: np.ndarray
    added: tuple[Array, Array] | None


def orbit_rotor(rotor: RigidRotor, reaction: Any) -> OrbitRotor:
    """Return the constants of a rotor whose orbits are circular; raise InputError where they are not."""
    require_kind("rotor", rotor, RigidRotor, "a RigidRotor")
    port.require_reaction("reaction", reaction, heavy=True, planar=True)
    speeds = set(rotor.profile.speeds)
    if len(speeds) != 1 or 0.0 in speeds:
        raise InputError(f"speed must be constant and not zero for synchronous orbits, got {rotor.speed!r}")
    if np.any(rotor.static_load):
        raise InputError(
            f"rotor must carry no static load for circular orbits, got {rotor.static_load.tolist()} N: "
            "preload the springs and set gravity to (0, 0)"
        )
    # A film that does not depend on direction answers the mirrored motion with the mirrored force.
    system = damped_orbit(rotor, reaction)
    _require_isotropy(system)
    port.require_turning(reaction, rotor)
    return system


def orbit_points(system: OrbitRotor, eccentricity_ratio: Array) -> tuple[np.ndarray, np.ndarray]:
    """Return pull and force [N] of the orbits of the given radii / clearance, complex, shape (n,).

    The pull is u w^2 exp(i b) of the unbalance u that keeps the orbit, the force radial + i tangential.
    """
    position, velocity = _motion(system, eccentricity_ratio)
    speed = np.full(eccentricity_ratio.shape, system.speed)
    radial, tangential = system.reaction.force(position, velocity, speed)
    heavy = port.inertial(system.reaction)
    if heavy is not None:
        swung = system.speed**2 * position[0] * heavy.mass(position, velocity, speed)[:, 0]
        radial, tangential = radial + swung[0], tangential + swung[1]
    inertia = system.mass * system.speed**2 * position[0]
    return -(inertia + radial) + 1j * tangential, radial + 1j * tangential


def orbit_slope(system: OrbitRotor, eccentricity_ratio: Array) -> OrbitSlope:
    """Return d(u w^2)^2/de and what it is made of."""
    position, velocity = _motion(system, eccentricity_ratio)
    speed = np.full(eccentricity_ratio.shape, system.speed)
    film = system.reaction.jacobian(position, velocity, speed)
    along = film[:, 0] + system.speed * film[:, 3]
    added = port.orbit_mass(system.reaction, position, velocity, system.speed)
    if added is not None:
        along = along - added[1][:, 0] - system.speed * added[1][:, 3] + system.speed**2 * added[0][:, 0]
    pull_slope = -(system.mass * system.speed**2 + along[0]) + 1j * along[1]
    pull = orbit_points(system, eccentricity_ratio)[0]
    return OrbitSlope(2.0 * (pull.conj() * pull_slope).real, film, pull, added)


def growth_rates(system: OrbitRotor, orbits: OrbitSlope) -> Array:
    """Return the largest real part of the Floquet exponents of orbits, shape (n,)."""
    A = rotating_linearization(system.mass, system.speed, orbits.film, orbits.added).A
    return np.linalg.eigvals(A).real.max(axis=-1)


def _motion(system: OrbitRotor, eccentricity_ratio: Array) -> tuple[Array, Array]:
    radius = system.clearance * np.asarray(eccentricity_ratio, dtype=float)
    none = np.zeros_like(radius)
    return np.stack([radius, none]), np.stack([none, system.speed * radius])


def _require_isotropy(system: OrbitRotor) -> None:
    """Raise InputError if the force depends on the direction of the orbit's radius."""
    require_positive("clearance", system.clearance)
    (position, velocity), speed = _motion(system, np.array(0.5)), system.speed
    cos, sin = np.cos(1.0), np.sin(1.0)
    turn = np.array([[cos, -sin], [sin, cos]])
    force = system.reaction.force(position, velocity, speed)
    turned = turn.T @ system.reaction.force(turn @ position, turn @ velocity, speed)
    if np.linalg.norm(turned - force) > _ISOTROPY * np.linalg.norm(force):
        raise InputError(
            "reaction must not depend on direction for circular orbits, got forces "
            f"{force.tolist()} and {turned.tolist()} N in axes turned by 1 rad"
        )


# One synchronous orbit of a rotor in a damper, next to one that is known; radii are eccentricity ratios.


def damped_orbit(rotor: RigidRotor, reaction: Any) -> OrbitRotor:
    """Return the constants of a rotor on a film that is known to be isotropic, at its first speed."""
    largest_ratio = port.largest_eccentricity_ratio(reaction)
    return OrbitRotor(rotor.mass, abs(rotor.profile.speeds[0]), reaction.clearance, reaction, largest_ratio)


def unbalances(system: OrbitRotor, radius: Array) -> Array:
    """Return the unbalances [kg m] of orbits."""
    return np.asarray(np.abs(orbit_points(system, radius)[0]) / system.speed**2)


def unbalance_at(system: OrbitRotor, radius: float) -> float:
    """Return the unbalance [kg m] of one orbit."""
    return float(unbalances(system, np.array([radius]))[0])


def force_at(system: OrbitRotor, radius: float) -> complex:
    """Return the turning force on the rotor on one orbit [N]."""
    return complex(orbit_points(system, np.array([radius]))[1][0])


def transmitted(system: OrbitRotor, radius: float) -> float:
    """Return force on the housing / pull of the unbalance."""
    pull, force = orbit_points(system, np.array([radius]))
    return float(np.abs(force[0]) / np.abs(pull[0]))


def slope_at(system: OrbitRotor, radius: float) -> float:
    """Return du/de [kg m] at a radius, from d(u w^2)^2/de."""
    squared = _squared_slope(system, radius) * system.clearance
    return squared / (2.0 * unbalance_at(system, radius) * system.speed**4)


def orbit_near(system: OrbitRotor, radius: float, unbalance: float | None) -> float | None:
    """Return the radius of the orbit next to another one, or None if there is none.

    Parameters
    ----------
    system : OrbitRotor
    radius : float [1]
        Where it is looked for, within a fifth.
    unbalance : float or None [kg m]
        Unbalance of the orbit; None for the fold, where the unbalance is largest or smallest.
    """
    near = (0.8 * radius, min(1.2 * radius, 0.5 * (1.0 + radius)))

    def excess(at: float) -> float:
        return _squared_slope(system, at) if unbalance is None else unbalance_at(system, at) - unbalance

    if excess(near[0]) * excess(near[1]) > 0.0:
        return None
    return float(brentq(excess, *near, xtol=1e-12))


def _squared_slope(system: OrbitRotor, radius: float) -> float:
    return float(orbit_slope(system, np.array([radius]))[0][0])


# Motion on a damper in eccentricity and phase, and what reaches the housing over time.


def polar_acceleration(rotor: RigidRotor, reaction: Any, t: float, polar: Array) -> tuple[float, float]:
    """Return the second derivatives of eccentricity ratio and angle.

    Parameters
    ----------
    rotor : RigidRotor
    reaction : Reaction
    t : float [s]
    polar : array_like, shape (4,)
        Eccentricity ratio [1], angle phi from +x [rad] and their rates [1/s, rad/s]; not at the center.

    Returns
    -------
    (float, float) [1/s2], [rad/s2]
        eps'' = eps phi'^2 + F_r/(m c), phi'' = (F_t/(m c) - 2 eps' phi')/eps, F being film, springs,
        unbalance and static load; Akhverdiev et al. (5), (6) with the misprints corrected.
    """
    eps, phi, eps_rate, phi_rate = (float(value) for value in polar)
    if eps <= 0.0:
        raise InputError(f"eccentricity ratio must be positive in polar coordinates, got {eps!r}")
    state = cartesian_state((eps, phi, eps_rate, phi_rate), reaction.clearance)
    film = reaction.force(state[:2], state[2:], rotor.profile.speed(t))
    ax, ay = (film + rotor.static_load + rotor.unbalance_force(t)) / (rotor.mass * reaction.clearance)
    radial = math.cos(phi) * ax + math.sin(phi) * ay
    tangential = math.cos(phi) * ay - math.sin(phi) * ax
    return radial + eps * phi_rate**2, (tangential - 2.0 * eps_rate * phi_rate) / eps


def cartesian_state(polar: tuple[float, float, float, float], clearance: float) -> Array:
    """Return (x, y, vx, vy) [m, m/s] of (eps, phi, eps', phi') [1, rad, 1/s, rad/s]."""
    eps, phi, eps_rate, phi_rate = polar
    cos, sin = math.cos(phi), math.sin(phi)
    return clearance * np.array(
        [eps * cos, eps * sin, eps_rate * cos - eps * phi_rate * sin, eps_rate * sin + eps * phi_rate * cos]
    )


def polar_series(trajectory: Trajectory, rotor: RigidRotor, clearance: float) -> tuple[Array, Array]:
    """Return eccentricity ratio and phase, from unbalance to displacement in (-pi, pi], shape (n,)."""
    x, y = trajectory.position
    turned = np.array([rotor.profile.angle(float(t)) for t in trajectory.time]) + rotor.unbalance_angle
    phase = np.angle(np.exp(1j * (np.arctan2(y, x) - turned)))
    return np.hypot(x, y) / clearance, phase


@one_blas_thread
@arguments
def transmitted_ratio(trajectory: Trajectory, rotor: RigidRotor) -> Array:
    """Return the force on the housing over time per centrifugal force of the unbalance, shape (n,) [1].

    Parameters
    ----------
    trajectory : Trajectory
        Trajectory from `simulate`, its reaction holding everything between rotor and housing (film and
        springs).
    rotor : RigidRotor
        Rotor with unbalance, at a speed other than zero.

    Raises
    ------
    InputError
        If there is no centrifugal force to compare with.
    """
    pull = rotor.unbalance * trajectory["speed"] ** 2
    if not np.all(pull > 0.0):
        raise InputError(f"rotor must have an unbalance and turn at all times, got {rotor!r}")
    return np.hypot(trajectory["force_x"], trajectory["force_y"]) / pull


# Where a damper answers one unbalance with two orbits: dimensionless maps.


_NODES = 2001
_LARGEST = 0.999
_STRONGEST = 20.0


@dataclass(frozen=True, kw_only=True)
class BistableMap(Drawable):
    """Unbalance ratios at the folds over squeeze number Bs and spring ratio, both per speed of the rotor.

    Attributes
    ----------
    squeeze_number : ndarray, shape (n,) [1]
        Bs/Omega.
    spring_ratio : ndarray, shape (m,) [1]
        Omega_s/Omega.
    jump_up, jump_down : ndarray, shape (n, m) [1]
        U at which the orbit jumps to the larger, and back to the smaller one; NaN where it does not jump.
    """

    squeeze_number: Array
    spring_ratio: Array
    jump_up: Array
    jump_down: Array


@one_blas_thread
@arguments
def bistable_map(damper: port.Reaction, squeeze_numbers: ArrayLike, spring_ratios: ArrayLike) -> BistableMap:
    """Return the squeeze numbers and spring ratios at which the unbalance response is bistable.

    Parameters
    ----------
    damper : PorousDamper
        Damper without feed. Its cage and its film extent matter, its size does not.
    squeeze_numbers : array_like, shape (n,) [1]
        Bs/Omega, positive.
    spring_ratios : array_like, shape (m,) [1]
        Omega_s/Omega, not negative.

    Raises
    ------
    InputError
        If a value breaks its rule or the damper has feed.
    """
    strengths = np.atleast_1d(require_finite("squeeze_numbers", squeeze_numbers))
    springs = np.atleast_1d(require_finite("spring_ratios", spring_ratios))
    if np.any(strengths <= 0.0) or np.any(springs < 0.0):
        raise InputError(
            "squeeze_numbers must be positive and spring_ratios must not be negative, got "
            f"{squeeze_numbers!r} and {spring_ratios!r}"
        )
    response = _Response(damper)
    folds = np.array([[response.folds(b, s) for s in springs] for b in strengths])
    return BistableMap(
        squeeze_number=strengths, spring_ratio=springs, jump_up=folds[..., 0], jump_down=folds[..., 1]
    )


@one_blas_thread
@arguments
def bistability_limit(damper: port.Reaction, spring_ratio: float) -> float:
    """Return the squeeze number Bs/Omega above which the response to an unbalance has no fold."""
    require_number("spring_ratio", spring_ratio)
    response = _Response(damper)

    def least_slope(strength: float) -> float:
        return response.least_slope(strength, spring_ratio)

    if least_slope(_STRONGEST) <= 0.0 or least_slope(1e-4) >= 0.0:
        raise InputError(
            f"damper must have a squeeze number at which folds appear below {_STRONGEST}, got none"
        )
    return float(brentq(least_slope, 1e-4, _STRONGEST, xtol=1e-10))


class _Response:
    """U(eps)^2 = ((s^2 - 1) eps - Bs g_r)^2 + (Bs g_t)^2 of one damper, g its film on circular orbits."""

    def __init__(self, damper: Any) -> None:
        if not hasattr(damper, "squeeze_case"):
            raise InputError(f"damper must be a PorousDamper, got {brief(damper)}")
        if damper.feed is not None or (damper.cage is not None and damper.cage.supply_pressure):
            raise InputError(f"damper must have no feed for a map over the squeeze number, got {damper!r}")
        self.eps = np.linspace(1e-4, min(_LARGEST, damper.largest_eccentricity_ratio), _NODES)
        none = np.zeros_like(self.eps)
        e, w = np.stack([self.eps, none]), np.stack([none, self.eps])
        self.film = damper.bound_film.force(e, w)
        slopes = damper.bound_film.jacobian(e, w)
        self.film_slope = slopes[:, 0] + slopes[:, 3]

    def parts(self, strength: float, spring: float) -> tuple[Array, Array]:
        """Return U^2 and d(U^2)/d eps at the nodes."""
        along = (spring**2 - 1.0) * self.eps - strength * self.film[0]
        along_slope = spring**2 - 1.0 - strength * self.film_slope[0]
        across, across_slope = strength * self.film[1], strength * self.film_slope[1]
        return along**2 + across**2, 2.0 * (along * along_slope + across * across_slope)

    def least_slope(self, strength: float, spring: float) -> float:
        """Return the least d(U^2)/d(eps^2) over the orbits, by a parabola through the least nodes."""
        slope = self.parts(strength, spring)[1] / (2.0 * self.eps)
        k = int(np.argmin(slope))
        if k in (0, slope.size - 1):
            return float(slope[k])
        a, b, c = slope[k - 1 : k + 2]
        return float(b - 0.125 * (a - c) ** 2 / (a - 2.0 * b + c))

    def folds(self, strength: float, spring: float) -> tuple[float, float]:
        """Return U where it stops rising and where it rises again, NaN where it never stops."""
        square, slope = self.parts(strength, spring)
        (turns,) = np.nonzero(np.diff(np.sign(slope)))
        if turns.size < 2:
            return np.nan, np.nan
        return self._turn(turns[0], square, slope), self._turn(turns[1], square, slope)

    def _turn(self, k: int, square: Array, slope: Array) -> float:
        """Return U at the zero of the slope between nodes k and k + 1, by the cubic of both ends."""
        step = self.eps[k + 1] - self.eps[k]
        part = slope[k] / (slope[k] - slope[k + 1])
        rise = part * slope[k] + 0.5 * part**2 * (slope[k + 1] - slope[k])
        return float(np.sqrt(square[k] + step * rise))


# Dampers for python-control: small motion about the center, and about a circular orbit in turning axes.


TURNING = ("radial", "tangential")
"""Axes that turn with the orbit."""

_SYMMETRY = 1e-9


@dataclass(frozen=True, kw_only=True)
class OrbitCoefficients(Readable):
    """Equivalent stiffness and damping of a film on a circular orbit: F_r = -K e, F_t = -C w e.

    Attributes
    ----------
    stiffness : float [N/m]
    damping : float [N s/m]
    eccentricity_ratio : float [1]
    speed : float [rad/s]
    """

    stiffness: float
    damping: float
    eccentricity_ratio: float
    speed: float


@one_blas_thread
@arguments
def orbit_coefficients(reaction: port.Reaction, eccentricity_ratio: float, speed: float) -> OrbitCoefficients:
    """Return the equivalent coefficients of a film on a synchronous circular orbit.

    With fluid inertia the stiffness includes the term -mass speed^2. A linear code may use these coefficients
    for a cavitated film, which has no damping matrix at rest. They are exact for this orbit only. They are no
    derivatives of the force, and they differ at every radius.

    Parameters
    ----------
    reaction : Reaction
        Isotropic.
    eccentricity_ratio : float [1]
        Radius of the orbit / clearance, above 0 and below 1.
    speed : float [rad/s]
        Speed of the orbit, not zero.

    Raises
    ------
    InputError
        If an argument breaks its rule.
    FilmContactError
        If the orbit is as wide as the clearance.
    """
    port.require_reaction("reaction", reaction, heavy=True, planar=True)
    require_positive("eccentricity_ratio", eccentricity_ratio)
    if require_number("speed", speed) == 0.0:
        raise InputError(f"speed must not be zero on an orbit, got {speed!r}")
    radius = eccentricity_ratio * port.clearance_of(reaction)
    radial, tangential = port.static_force(reaction, [radius, 0.0], [0.0, speed * radius], speed)
    heavy = port.inertial(reaction)
    if heavy is not None:
        heavy.require_range(speed)
        swung = heavy.mass([radius, 0.0], [0.0, speed * radius], speed)[:, 0] * speed**2 * radius
        radial, tangential = radial + swung[0], tangential + swung[1]
    return OrbitCoefficients(
        stiffness=float(-radial / radius),
        damping=float(-tangential / (speed * radius)),
        eccentricity_ratio=eccentricity_ratio,
        speed=speed,
    )


@one_blas_thread
@arguments
def small_motion_transmissibility(
    rotor: RigidRotor, reaction: port.Reaction, name: str | None = None
) -> control.TransferFunction:
    """Return the force on the housing per force on the rotor in small motion about the center.

    T(s) = (M s^2 + C s + K)/((m + M) s^2 + C s + K), M being the mass that the film adds; |T| = 1 at
    s = i sqrt(2 K/(m + 2 M)) whatever the damping, and M/(m + M) at high speed.

    Parameters
    ----------
    rotor : RigidRotor
    reaction : Reaction
        Film and springs, isotropic at the center, without cross coupling: a damper with a full film.
    name : str, optional

    Raises
    ------
    UndefinedDerivativeError
        For a cavitated film, which has no damping matrix at rest; use `orbit_coefficients` instead.
    InputError
        If the film couples x and y at the center.
    """
    at = coefficients(reaction, [0.0, 0.0], 0.0)
    stiffness, damping = _isotropic("stiffness", at.stiffness), _isotropic("damping", at.damping)
    added = 0.0
    if isinstance(at, InertialCoefficients):
        added = _isotropic("mass", at.mass)
    numerator = [damping, stiffness]
    import control

    return control.TransferFunction(
        [added, *numerator] if added else numerator,
        [rotor.mass + added, *numerator],
        inputs=["force"],
        outputs=["housing_force"],
        name=name,
    )


@one_blas_thread
@arguments
def orbit_system(
    rotor: RigidRotor, reaction: port.Reaction, orbit: CircularOrbit, name: str | None = None
) -> control.StateSpace:
    """Return the small motion about a circular orbit, in radial and tangential axes that turn with it.

    Parameters
    ----------
    rotor : RigidRotor
    reaction : Reaction
        Film and springs.
    orbit : CircularOrbit
        Orbit as `synchronous_orbits(...).at(...)` returns them, stable or not.
    name : str, optional

    Returns
    -------
    control.StateSpace
        Inputs force_radial, force_tangential: small force on the rotor [N]. Outputs radial, tangential and
        their rates: change of the position in turning axes [m, m/s]; housing_radial, housing_tangential:
        change of the force on the housing [N]. Its poles are the Floquet exponents of the orbit.
    """
    port.require_reaction("reaction", reaction, heavy=True, planar=True)
    radius = orbit.eccentricity_ratio * port.clearance_of(reaction)
    position, velocity = np.array([radius, 0.0]), np.array([0.0, orbit.speed * radius])
    film = port.static_slopes(reaction, position, velocity, orbit.speed)
    added = port.orbit_mass(reaction, position, velocity, orbit.speed)
    matrices = rotating_linearization(rotor.mass, orbit.speed, film, added)
    nominal = reaction.outputs[0].nominal
    inputs = signals_of(*((f"force_{axis}", "N", nominal, f"{axis} force on the rotor") for axis in TURNING))
    housing = ((f"housing_{axis}", "N", nominal, f"{axis} force on the housing") for axis in TURNING)
    states = _turning_states(port.clearance_of(reaction), abs(orbit.speed))
    return state_space(matrices, inputs, (*states, *signals_of(*housing)), states, name)


def _turning_states(length: float, speed: float) -> tuple[Signal, ...]:
    """Return the signals of the position in turning axes and of its rates."""
    kinds = (("", "m", length), ("_rate", "m/s", length * speed))
    rows = (
        (axis + of, unit, size, f"{axis} displacement{of}") for of, unit, size in kinds for axis in TURNING
    )
    return signals_of(*rows)


def _isotropic(name: str, matrix: np.ndarray) -> float:
    value = 0.5 * float(np.trace(matrix))
    if np.abs(matrix - value * np.eye(2)).max() > _SYMMETRY * max(abs(value), np.abs(matrix).max()):
        raise InputError(
            f"{name} at the center must be isotropic without cross coupling, got {matrix.tolist()}"
        )
    return value
