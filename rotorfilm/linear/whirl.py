"""The speed at which a rigid rotor on a film starts to whirl."""

from __future__ import annotations

import math
import warnings
from collections.abc import Callable, Iterator
from contextlib import contextmanager

import numpy as np
from numpy.typing import ArrayLike
from scipy.optimize import brentq

from ..errors import (
    EquilibriumError,
    InputError,
    UnloadedPadWarning,
    ValidityWarning,
    require_finite,
    require_positive,
    warn_user,
)
from ..inputs.kinds import arguments
from ..model import Array, Dynamic, JournalForce, Reaction, require_reaction
from ..results import Coefficients, Equilibrium, WhirlThreshold
from ..warming import Remembering, Settling, settled
from .coefficients import coefficients
from .critical_mass import critical_mass, damping_has_rank_one, is_stable, whirl_margin
from .equilibrium import checked_load, equilibrium
from .memory.counted_threshold import counted_threshold, leading_exponent

_POINTS_PER_DECADE = 12
_SPEED_FACTOR = 100.0


@arguments
def whirl_threshold(
    reaction: Reaction, load: ArrayLike, mass: float, speed_range: tuple[float, float] | None = None
) -> WhirlThreshold:
    """Return the lowest speed at which the static equilibrium loses stability as the speed rises.

    Parameters
    ----------
    reaction : Reaction
        The film; of one with states that rest, as tilting pads, rotor and states are judged together, and
        of one that conserves its oil, rotor and oil by K(s): the result is a `CountedThreshold`.
    load : array_like, shape (2,) [N]
        External static force on the journal, weight included.
    mass : float [kg]
        Rigid mass that the bearing carries.
    speed_range : tuple of two floats, optional [rad/s]
        Lowest and highest speed searched, both positive; by default 1/100 and
        100 times sqrt(|load| / (clearance mass)).

    Returns
    -------
    WhirlThreshold
        With speed None and a reason where there is no threshold in the range. Speeds too low for the film
        to carry the load, below the first with an equilibrium, are passed over; a film that does not carry it
        at the highest speed carries it at none.

    Raises
    ------
    InputError
        If an argument breaks its rule.
    EquilibriumError
        If the equilibrium is lost, or not found, at a higher speed than the first that has one.
    UndefinedDerivativeError
        If the film has no derivative at an equilibrium.

    Warns
    -----
    ValidityWarning
        Once, where there is no threshold and rests that were searched are beyond what the film is meant for;
        and of a threshold beyond it. Not of speeds that are only passed, nor of unloaded pads, which the
        equilibrium at the threshold tells.

    Notes
    -----
    The range is scanned upwards in steps of 21 % and the first loss of stability is refined to roundoff;
    stability lost and regained within one step goes unseen.
    """
    require_reaction("reaction", reaction, JournalForce)
    require_positive("mass", mass)
    force = checked_load(load)
    low, high = _checked_range(speed_range, math.sqrt(math.hypot(*force) / (reaction.clearance * mass)))
    passed: list[str] = []
    search = _settling if isinstance(reaction, Settling) else _searched
    found = search(reaction, force, mass, (low, high), passed)
    if found.speed is None and passed:
        warn_user(f"no threshold was found, but rests that were searched are in doubt: {passed[0]}")
    return found


def speed_parameter(*, speed: float, clearance: float, mass: float, load: ArrayLike) -> float:
    """Return |speed| sqrt(clearance mass / |load|) [1], the speed in units of the rotor's own.

    Parameters
    ----------
    speed : float [rad/s]
        Angular speed, of either sign.
    clearance : float [m]
        Radial clearance.
    mass : float [kg]
        Rigid mass that the bearing carries.
    load : array_like, shape (2,) [N]
        External static force on the journal, not zero.
    """
    return abs(speed) * math.sqrt(clearance * mass / float(np.linalg.norm(load)))


def _checked_range(speed_range: tuple[float, float] | None, natural: float) -> tuple[float, float]:
    if speed_range is None:
        return natural / _SPEED_FACTOR, natural * _SPEED_FACTOR
    ends = require_finite("speed_range", speed_range)
    if ends.shape != (2,) or not 0.0 < ends[0] < ends[1]:
        raise InputError(f"speed_range must be (low, high) with 0 < low < high, got {speed_range!r}")
    return float(ends[0]), float(ends[1])


@contextmanager
def _passing(passed: list[str]) -> Iterator[None]:
    """Keep what warns of rests that a search only passes through: nobody asked for them."""
    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always", ValidityWarning)
        warnings.simplefilter("ignore", UnloadedPadWarning)  # of no doubt for a threshold
        yield
    for one in caught:
        if issubclass(one.category, ValidityWarning):
            passed.append(str(one.message))
        else:
            warnings.warn_explicit(one.message, one.category, one.filename, one.lineno)


def _searched(
    reaction: Reaction, load: Array, mass: float, ends: tuple[float, float], passed: list[str]
) -> WhirlThreshold:
    """Return the threshold by stiffness and damping at the equilibria."""
    stable: list[bool] = []
    before, rests = None, _scan(reaction, load, *ends)
    while True:
        with _passing(passed):
            at = next(rests, None)
        if at is None:
            return _none(_why_none(stable, *ends))
        if damping_has_rank_one(at):
            return _none(critical_mass(at).reason)
        stable.append(is_stable(at, mass))
        if before is not None and stable[-2:] == [True, False]:
            return _refined(reaction, load, mass, (before, at), passed)
        before = at


def _settling(
    reaction: Reaction, load: Array, mass: float, ends: tuple[float, float], passed: list[str]
) -> WhirlThreshold:
    """Return the threshold by the exponents of rotor and bearing together."""

    def least_damped(at: Equilibrium) -> complex:
        if isinstance(reaction, Remembering) and not isinstance(reaction, Dynamic):
            return leading_exponent(reaction, at, mass)
        film: Settling = settled(reaction, at.position, at.speed)
        return complex(film.at_rest().modes(at.position, at.speed, mass)[0])

    def growth(speed: float) -> float:
        with _passing(passed):
            return least_damped(equilibrium(reaction, load, speed)).real

    speeds = _speeds(*ends)
    with _passing(passed):
        first = _first_carried(reaction, load, speeds.tolist())
    onset, stable = _first_onset(growth, speeds[first:])
    if onset is None:
        return _none(_why_none(stable, *ends))
    with warnings.catch_warnings(action="ignore", category=UnloadedPadWarning):  # the rest itself tells them
        rest = equilibrium(reaction, load, onset)
    exponent = least_damped(rest)
    found = WhirlThreshold(
        speed=onset,
        whirl_ratio=abs(exponent.imag) / onset,
        critical_mass=mass,
        speed_parameter=speed_parameter(speed=onset, clearance=reaction.clearance, mass=mass, load=load),
        equilibrium=rest,
    )
    if isinstance(reaction, Remembering) and not isinstance(reaction, Dynamic):
        return counted_threshold(reaction, found)
    return found  # a film with states has no exponents but those that were found


def _first_onset(growth: Callable[[float], float], speeds: Array) -> tuple[float | None, list[bool]]:
    """Return the lowest speed at which growth turns positive, None without, and where it is stable."""
    stable: list[bool] = []
    for k, speed in enumerate(speeds.tolist()):
        stable.append(growth(speed) < 0.0)
        if stable[-2:] == [True, False]:
            low, high = np.log(speeds[k - 1 : k + 1]).tolist()
            return math.exp(brentq(lambda log: growth(math.exp(log)), low, high, xtol=1e-14)), stable
    return None, stable


def _speeds(low: float, high: float) -> Array:
    points = max(3, 1 + math.ceil(_POINTS_PER_DECADE * math.log10(high / low)))
    return np.geomspace(low, high, points)


def _scan(reaction: Reaction, load: Array, low: float, high: float) -> Iterator[Coefficients]:
    """Yield the coefficients at the equilibria, from the lowest speed at which there is one."""
    speeds = _speeds(low, high).tolist()
    for speed in speeds[_first_carried(reaction, load, speeds) :]:
        at = equilibrium(reaction, load, speed)
        yield coefficients(reaction, at.position, at.speed)


def _first_carried(reaction: Reaction, load: Array, speeds: list[float]) -> int:
    """Return the place of the lowest speed that carries the load, by bisection; past the end if none does.

    A failed search costs far more than one that finds its equilibrium.
    """

    def carries(k: int) -> bool:
        try:
            equilibrium(reaction, load, speeds[k])
        except EquilibriumError:
            return False
        return True

    if carries(0):
        return 0
    below, above = 0, len(speeds) - 1
    if not carries(above):
        return len(speeds)
    while above - below > 1:
        middle = (below + above) // 2
        below, above = (below, middle) if carries(middle) else (middle, above)
    return above


def _refined(
    reaction: Reaction,
    load: Array,
    mass: float,
    bracket: tuple[Coefficients, Coefficients],
    passed: list[str],
) -> WhirlThreshold:
    def margin(log_speed: float) -> float:
        with _passing(passed):
            at = equilibrium(reaction, load, math.exp(log_speed))
            return whirl_margin(coefficients(reaction, at.position, at.speed), mass)

    stable, unstable = bracket
    if whirl_margin(unstable, mass) > 0.0:
        return _none(
            f"static stability is lost (det K <= 0) between {stable.speed:.6g} and {unstable.speed:.6g} rad/s"
        )
    root = brentq(margin, math.log(stable.speed), math.log(unstable.speed), xtol=1e-14)
    return _threshold(equilibrium(reaction, load, math.exp(root)), reaction, mass)


def _threshold(onset: Equilibrium, reaction: Reaction, mass: float) -> WhirlThreshold:
    border = critical_mass(coefficients(reaction, onset.position, onset.speed))
    return WhirlThreshold(
        speed=onset.speed,
        whirl_ratio=border.whirl_ratio,
        critical_mass=border.mass,
        speed_parameter=speed_parameter(
            speed=onset.speed, clearance=reaction.clearance, mass=mass, load=onset.load
        ),
        equilibrium=onset,
    )


def _none(reason: str) -> WhirlThreshold:
    return WhirlThreshold(
        speed=None,
        whirl_ratio=None,
        critical_mass=None,
        speed_parameter=None,
        equilibrium=None,
        reason=reason,
    )


def _why_none(stable: list[bool], low: float, high: float) -> str:
    between = f"from {low:.6g} to {high:.6g} rad/s"
    if not stable:
        return f"no static equilibrium at any speed {between}"
    if all(stable):
        return f"stable at every speed {between}"
    if not any(stable):
        return f"unstable at every speed {between}"
    return f"unstable at low speeds and then stable, with no loss of stability {between}"
