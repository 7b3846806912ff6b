"""The speed at which a rigid rotor on a film starts to whirl."""

from __future__ import annotations

import math
import warnings
from collections.abc import Callable, Iterator, Mapping
from contextlib import contextmanager
from dataclasses import dataclass, replace
from itertools import pairwise
from typing import Any, cast

import numpy as np
from numpy.typing import ArrayLike

from ..core import port
from ..core.dynamic_stiffness import (
    InertialStiffness,
    coefficients_of,
    has_own_stiffness,
    rigid_exponents,
    small_motion,
    states_rest,
)
from ..core.errors import (
    AbsentError,
    ConvergenceError,
    EquilibriumError,
    InputError,
    UnloadedPadWarning,
    ValidityWarning,
    brief,
    require_finite,
    require_positive,
    silencing,
)
from ..core.inputs import arguments
from ..core.model import Array
from ..core.readable import Readable
from ..core.results import (
    Coefficients,
    Equilibrium,
    FrequencyDependentCoefficients,
    InertialCoefficients,
    WhirlThreshold,
)
from ..core.signals import PLANAR
from .coefficients import GROWTH_ROUNDOFF, coefficients_at, film_coefficients
from .equilibrium import checked_load, equilibrium, settled
from .threads import one_blas_thread

_POINTS_PER_DECADE = 12
_SPEED_FACTOR = 100.0
_FURTHER = 1e-6
"""Part of a step by which motion is seen to grow beyond its threshold."""

NO_MASS: Mapping[str, Any] = dict.fromkeys(("mass", "whirl_frequency", "whirl_ratio"))
NO_THRESHOLD: Mapping[str, Any] = dict.fromkeys(
    ("speed", "whirl_ratio", "critical_mass", "speed_parameter", "equilibrium")
)
"""Fields of a `CriticalMass` and of a `WhirlThreshold` that do not exist; both say why."""


@one_blas_thread
@arguments
def whirl_threshold(
    reaction: port.Reaction, load: ArrayLike, mass: float, speed_range: tuple[float, float] | None = None
) -> WhirlThreshold:
    """Return the lowest speed at which the static equilibrium loses stability as the speed rises.

    Parameters
    ----------
    reaction : Reaction
        The film. If it has states that rest, such as tilting pads, the stability is that of rotor and states
        together. For a mass-conserving film it is that of rotor and film with K(s), and the result is a
        `VerifiedThreshold`.
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
        The threshold. If there is none in the range, its speed is None and it states the reason. Speeds that
        are too low for the film to carry the load are skipped.

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
        If the threshold is outside the range of validity of the film. Other speeds of the search give no
        warning; if no threshold is found, the reason names the speeds that are in doubt.

    Notes
    -----
    The range is scanned upwards in steps of 21 % and the first loss of stability is refined to roundoff;
    an instability that begins and ends within one step is not found.
    """
    port.require_reaction("reaction", reaction, planar=True)
    require_positive("mass", mass)
    force = checked_load(load)
    if speed_range is None and not port.clearance_of(reaction) < math.inf:
        raise InputError(
            "speed_range must be given of a reaction without a clearance, which scales it, got "
            f"{brief(reaction)}"
        )
    speeds = _speeds(
        *_checked_range(speed_range, math.sqrt(math.hypot(*force) / (port.clearance_of(reaction) * mass)))
    )
    passed: list[str] = []
    search = _settling if states_rest(reaction) else _searched
    with _passing(passed):
        first = _first_carried(reaction, force, speeds.tolist())
    found = search(reaction, force, mass, speeds, first, passed)
    if found.speed is None and passed:
        return replace(found, reason=f"{found.reason}; equilibria of the search are in doubt: {passed[0]}")
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
    reaction: Any, load: Array, mass: float, speeds: Array, first: int, passed: list[str]
) -> WhirlThreshold:
    """Return the threshold by stiffness and damping at the equilibria, from the first speed that has one."""
    stable: list[bool] = []
    before: Coefficients | None = None
    with _passing(passed):
        for at in _coefficients_over(reaction, load, speeds[first:].tolist()):
            if _does_no_work(at) or damping_has_rank_one(at):
                return WhirlThreshold(**NO_THRESHOLD, reason=critical_mass(at).reason)
            stable.append(is_stable(at, mass))
            if before is not None and stable[-2:] == [True, False]:
                break
            before = at
        else:
            return WhirlThreshold(**NO_THRESHOLD, reason=_why_none(stable, speeds))
    return _refined(reaction, load, mass, (before, at), passed)


_AT_ONCE = 16
"""Equilibria that are searched at once: those beyond a threshold are in vain."""


def _coefficients_over(reaction: Any, load: Array, speeds: list[float]) -> Iterator[Coefficients]:
    """Yield stiffness and damping at the equilibria of speeds, with the warnings of each."""
    for k in range(0, len(speeds), _AT_ONCE):
        part = speeds[k : k + _AT_ONCE]
        rests = settled(reaction, [load], part)
        if None in rests:
            for speed in part:
                yield film_coefficients(reaction, equilibrium(reaction, load, speed).position, speed)
            continue
        port.warn_of_load(reaction, load)
        for at in coefficients_at(reaction, cast(list[Equilibrium], rests)):
            port.warn_of_flow(reaction, at.speed)
            yield at


def _settling(
    reaction: Any, load: Array, mass: float, speeds: Array, first: int, passed: list[str]
) -> WhirlThreshold:
    """Return the threshold by the exponents of rotor and bearing together."""

    def least_damped(at: Equilibrium) -> complex:
        if has_own_stiffness(reaction):
            from .frequency_dependent import counted_exponents

            # Where nothing grows it is one that is damped, not always the least: only its sign counts.
            return complex(counted_exponents(_film(reaction, at), mass)[0][0])
        return complex(rigid_exponents(reaction, at.position, at.speed, mass)[0])

    def growth(speed: float) -> float:
        with _passing(passed):
            s = least_damped(equilibrium(reaction, load, speed))
        return s.real / (abs(s) + speed)

    onset, stable = _first_onset(growth, speeds[first:])
    if onset is None:
        return WhirlThreshold(**NO_THRESHOLD, reason=_why_none(stable, speeds))
    with silencing(UnloadedPadWarning):  # the rest itself tells them
        rest = equilibrium(reaction, load, onset)
    found = _threshold(reaction, rest, mass, abs(least_damped(rest).imag) / onset, mass)
    if has_own_stiffness(reaction):
        return counted_threshold(reaction, found)
    return found  # a film with states has no exponents but those that were found


def _first_onset(growth: Callable[[float], float], speeds: Array) -> tuple[float | None, list[bool]]:
    """Return the lowest speed at which growth / frequency turns positive, None without; where it does not."""
    stable: list[bool] = []
    rate = 0.0
    for k, speed in enumerate(speeds.tolist()):
        last, rate = rate, growth(speed)
        stable.append(rate <= GROWTH_ROUNDOFF)
        if stable[-2:] == [True, False]:
            low, high = np.log(speeds[k - 1 : k + 1]).tolist()
            # Of motion that nothing damped before, only what exceeds roundoff tells where it grows.
            least = GROWTH_ROUNDOFF if last > -GROWTH_ROUNDOFF else 0.0

            def excess(log_speed: float, least: float = least) -> float:
                return growth(math.exp(log_speed)) - least

            root = _root(excess, low, high, xtol=1e-14)
            if least:  # the line through two speeds at which it grows
                further = _FURTHER * (high - root)
                root = max(low, root - further * least / max(excess(root + further), least))
            return math.exp(root), stable
    return None, stable


def _root(
    function: Callable[[float], float], low: float, high: float, xtol: float = 2e-12, rtol: float = 2.0**-50
) -> float:
    """Return a root between two places, to the tolerances of scipy unless others are given."""
    # scipy.optimize takes longer to load than a journal bearing to be answered.
    from scipy.optimize import brentq

    return float(brentq(function, low, high, xtol=xtol, rtol=rtol))


def _speeds(low: float, high: float) -> Array:
    points = max(3, 1 + math.ceil(_POINTS_PER_DECADE * math.log10(high / low)))
    return np.geomspace(low, high, points)


def _first_carried(reaction: Any, load: Array, speeds: list[float]) -> int:
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
    reaction: Any,
    load: Array,
    mass: float,
    bracket: tuple[Coefficients, Coefficients],
    passed: list[str],
) -> WhirlThreshold:
    known = {math.log(one.speed): one for one in bracket}

    def margin(log_speed: float) -> float:
        if log_speed not in known:
            with _passing(passed):
                at = equilibrium(reaction, load, math.exp(log_speed))
                known[log_speed] = film_coefficients(reaction, at.position, at.speed)
        return whirl_margin(known[log_speed], mass)

    stable, unstable = bracket
    if whirl_margin(unstable, mass) > 0.0:
        return WhirlThreshold(
            **NO_THRESHOLD,
            reason="static stability is lost (det K <= 0) between "
            f"{stable.speed:.6g} and {unstable.speed:.6g} rad/s",
        )
    root = _root(margin, math.log(stable.speed), math.log(unstable.speed), xtol=1e-14)
    onset = equilibrium(reaction, load, math.exp(root))
    border = critical_mass(known.get(root) or film_coefficients(reaction, onset.position, onset.speed))
    return _threshold(reaction, onset, mass, border.whirl_ratio, border.mass)


def _threshold(
    reaction: Any, at: Equilibrium, mass: float, whirl_ratio: float | None, critical: float | None
) -> WhirlThreshold:
    """Return the threshold of a rigid rotor of a mass [kg] that begins to whirl in an equilibrium."""
    return WhirlThreshold(
        speed=at.speed,
        whirl_ratio=whirl_ratio,
        critical_mass=critical,
        speed_parameter=speed_parameter(
            speed=at.speed, clearance=reaction.clearance, mass=mass, load=at.load
        ),
        equilibrium=at,
    )


def _why_none(stable: list[bool], speeds: Array) -> str:
    between = f"from {speeds[0]:.6g} to {speeds[-1]:.6g} rad/s"
    if not stable:
        return f"no static equilibrium at any speed {between}"
    if all(stable):
        return f"stable at every speed {between}"
    if not any(stable):
        return f"unstable at every speed {between}"
    return f"unstable at low speeds and then stable, with no loss of stability {between}"


# The rigid mass at which a film with given stiffness and damping starts to whirl.


_RANK_TOLERANCE = 1e-10


@dataclass(frozen=True, kw_only=True)
class CriticalMass(Readable):
    """The mass at the border of stability, or the reason why there is none.

    Attributes
    ----------
    mass : float or None [kg]
        Lighter rotors are stable, heavier ones whirl; None when there is no such border.
    whirl_frequency : float or None [rad/s]
        Frequency of the undamped whirl at the border.
    whirl_ratio : float or None [1]
        whirl_frequency / |speed|; None at zero speed too.
    reason : str
        Why there is no critical mass; empty if there is one.
    """

    mass: float | None
    whirl_frequency: float | None
    whirl_ratio: float | None
    reason: str = ""


@dataclass(frozen=True, kw_only=True)
class VerifiedCriticalMass(CriticalMass):
    """The mass at the border of stability on a frequency-dependent film, with the growing motions beside it.

    Attributes
    ----------
    growing_below, growing_above : int [1]
        Number of growing exponents s of det(K(s) + mass s^2) = 0 for lighter and for heavier rotors, up to
        the next border. They are counted by the phase along all frequencies, so that none is missed. Without
        a border both numbers hold for any mass.
    """

    growing_below: int
    growing_above: int


@arguments
def critical_mass(coefficients: Coefficients) -> CriticalMass:
    """Return the mass at which the rotor m q'' + C q' + K q = 0 loses stability.

    Parameters
    ----------
    coefficients : Coefficients
        Film stiffness K and damping C; they act on the whole mass. With `FrequencyDependentCoefficients`, as
        `coefficients` returns them for a mass-conserving film, the border is found with K(s) at the whirl
        frequency, and the result is a `VerifiedCriticalMass`.

    Notes
    -----
    At the border q = q0 exp(i nu t), so that with k = m nu^2 the matrix K - k I + i nu C is singular. The
    imaginary and the real part of its determinant give

        k = (Kxx Cyy + Kyy Cxx - Kxy Cyx - Kyx Cxy) / (Cxx + Cyy),
        nu^2 = ((Kxx - k)(Kyy - k) - Kxy Kyx) / det C,    m = k / nu^2

    (the stability criterion in Lund (1987), J. Tribol. 109, 37-41, doi:10.1115/1.3261324).
    """
    if port.freedoms_of(coefficients) != PLANAR:
        raise InputError(
            f"coefficients must be those of x and y, got those of {', '.join(port.freedoms_of(coefficients))}"
        )
    told = getattr(coefficients, "dynamic_stiffness", None)
    if isinstance(coefficients, InertialCoefficients) or isinstance(told, InertialStiffness):
        raise InputError(f"coefficients must have no added mass, got {coefficients!r}: set the density to 0")
    if isinstance(coefficients, FrequencyDependentCoefficients) and np.any(coefficients.damping):
        return _counted(coefficients)
    reason = _why_no_border(coefficients)
    if reason:
        return CriticalMass(**NO_MASS, reason=reason)
    k = effective_stiffness(coefficients)
    squared = _shifted_determinant(coefficients, k) / _determinant(coefficients.damping)
    frequency = math.sqrt(squared)
    speed = abs(coefficients.speed)
    return CriticalMass(
        mass=k / squared,
        whirl_frequency=frequency,
        whirl_ratio=frequency / speed if speed else None,
    )


def _counted(film: FrequencyDependentCoefficients) -> VerifiedCriticalMass:
    """Return the lightest mass with which nothing grows below, and something above."""
    # Imported where a film is frequency-dependent: with it come flexible rotors and sparse matrices.
    from .frequency_dependent import mass_borders, rigid_growing

    borders = mass_borders(film)
    if not borders:
        growing = rigid_growing(film, float(np.abs(film.stiffness).max()) / film.speed**2)
        reason = "unstable whatever the mass" if growing else "stable whatever the mass"
        return VerifiedCriticalMass(**NO_MASS, reason=reason, growing_below=growing, growing_above=growing)
    masses = [mass for mass, _ in borders]
    between = [math.sqrt(one * other) for one, other in pairwise(masses)]
    counts = [rigid_growing(film, mass) for mass in (0.5 * masses[0], *between, 2.0 * masses[-1])]
    for (border, frequency), (below, above) in zip(borders, pairwise(counts), strict=True):
        if abs(above - below) != 2:
            raise ConvergenceError(
                f"one whirl must begin or cease to grow at a mass of {border:.6g} kg, but {below} motions "
                f"grow below it and {above} above it"
            )
        if below == 0:
            return VerifiedCriticalMass(
                mass=border,
                whirl_frequency=frequency,
                whirl_ratio=frequency / abs(film.speed),
                growing_below=below,
                growing_above=above,
            )
    reason = f"no light rotor is stable: {counts[0]} exponents grow"
    return VerifiedCriticalMass(**NO_MASS, reason=reason, growing_below=counts[0], growing_above=counts[-1])


def effective_stiffness(coefficients: Coefficients) -> float:
    """Return k = m nu^2 [N/m], the stiffness that the whirling rotor feels at the border."""
    (k_xx, k_xy), (k_yx, k_yy) = coefficients.stiffness.tolist()
    (c_xx, c_xy), (c_yx, c_yy) = coefficients.damping.tolist()
    mixed = k_xx * c_yy + k_yy * c_xx - k_xy * c_yx - k_yx * c_xy
    return float(np.divide(mixed, c_xx + c_yy))


def damping_has_rank_one(coefficients: Coefficients) -> bool:
    """Return whether det C vanishes to roundoff, so that stability does not depend on the mass."""
    C = coefficients.damping
    # Compared with the whole matrix: products of its entries depend on the axes, and may all be roundoff.
    return bool(abs(_determinant(C)) <= _RANK_TOLERANCE * np.vdot(C, C))


def _does_no_work(coefficients: Coefficients) -> bool:
    """Return whether C is skew, as that of a gyroscopic force, so that its power v C v is zero."""
    (xx, xy), (yx, yy) = coefficients.damping.tolist()
    largest = max(map(abs, (xx, xy, yx, yy)))
    return largest > 0.0 and max(abs(2.0 * xx), abs(xy + yx), abs(2.0 * yy)) <= _RANK_TOLERANCE * largest


def is_stable(coefficients: Coefficients, mass: float) -> bool:
    """Return whether all roots of det(m s^2 + C s + K) have negative real parts (Routh, Hurwitz)."""
    return bool(
        coefficients.damping.trace() > 0.0
        and effective_stiffness(coefficients) > 0.0
        and _determinant(coefficients.stiffness) > 0.0
        and whirl_margin(coefficients, mass) > 0.0
    )


def whirl_margin(coefficients: Coefficients, mass: float) -> float:
    """Return the third Hurwitz determinant, scaled to [-1, 1]: positive if no whirl grows.

    It is k det C - m ((Kxx - k)(Kyy - k) - Kxy Kyx), divided by the sum of the sizes of both terms.
    """
    k = effective_stiffness(coefficients)
    resisting = k * _determinant(coefficients.damping)
    driving = mass * _shifted_determinant(coefficients, k)
    return float((resisting - driving) / (abs(resisting) + abs(driving)))


def _why_no_border(coefficients: Coefficients) -> str:
    if not np.any(coefficients.damping):
        return "no damping (C = 0): whirl neither grows nor decays by it, whatever the mass"
    if _does_no_work(coefficients):
        return "damping does no work (C = -C^T): whirl neither grows nor decays by it, whatever the mass"
    if damping_has_rank_one(coefficients):
        return "damping matrix has rank 1 (det C = 0): stability does not depend on the mass"
    if np.trace(coefficients.damping) <= 0.0 or _determinant(coefficients.damping) < 0.0:
        return "damping matrix is not positive (trace C <= 0 or det C < 0): no light rotor is stable"
    if _determinant(coefficients.stiffness) <= 0.0:
        return "position is statically unstable (det K <= 0) whatever the mass"
    k = effective_stiffness(coefficients)
    if k <= 0.0:
        return "position is unstable whatever the mass (effective stiffness <= 0)"
    if _shifted_determinant(coefficients, k) <= 0.0:
        return "stable whatever the mass"
    return ""


def _determinant(matrix: np.ndarray) -> float:
    (xx, xy), (yx, yy) = matrix.tolist()
    return float(xx * yy - xy * yx)


def _shifted_determinant(coefficients: Coefficients, k: float) -> float:
    (xx, xy), (yx, yy) = coefficients.stiffness.tolist()
    return float((xx - k) * (yy - k) - xy * yx)


# The onset of whirl on a frequency-dependent film, with the proof that no whirl was missed.


BESIDE = 1e-3
"""Relative change of speed at which exponents are counted beside a threshold."""

STEP, NEAR, MOST = 1.1, 1e-4, 30
"""Factor of the speed between two that are looked at for a border, relative change at which it is found, and
most looks. K and C jump a little with the cells of the cavity: a border between two speeds always ends."""


@dataclass(frozen=True, kw_only=True)
class VerifiedThreshold(WhirlThreshold):
    """The onset of whirl of a rigid rotor on a frequency-dependent film, with the growing motions beside it.

    Attributes
    ----------
    growing_below, growing_above : int [1]
        Number of growing exponents of rotor and film at a speed 0.1 % lower and higher, counted by the phase
        of det(K(i nu) - mass nu^2) along all frequencies nu, so that none is missed: 0 and 2.
    """

    growing_below: int
    growing_above: int


def counted_threshold(reaction: Any, found: WhirlThreshold) -> VerifiedThreshold:
    """Return a threshold with the numbers of exponents that grow beside it.

    Raises
    ------
    ConvergenceError
        If they are not 0 below and more above: then another whirl was missed.
    """
    from .frequency_dependent import rigid_growing

    speed, at, mass = found.speed, found.equilibrium, found.critical_mass
    assert speed is not None
    assert at is not None
    assert mass is not None
    beside = (speed * (1.0 - BESIDE), speed * (1.0 + BESIDE))
    rests = [equilibrium(reaction, at.load, one) for one in beside]
    below, above = (rigid_growing(_film(reaction, rest), mass) for rest in rests)
    if below or not above:
        raise ConvergenceError(
            f"one whirl must begin to grow at {speed:.6g} rad/s, but {below} motions grow below it and "
            f"{above} above it"
        )
    return VerifiedThreshold(**vars(found), growing_below=below, growing_above=above)


def threshold_near(reaction: Any, load: ArrayLike, mass: float, start: float) -> VerifiedThreshold:
    """Return the onset of whirl nearest to a speed [rad/s], found by the whirl at about half the speed.

    Only that whirl is followed, so that a speed takes a tenth of what a count does; what grows beside the
    onset is counted at the end.

    Raises
    ------
    AbsentError
        If there is none within some 17 times that speed.
    ConvergenceError
        If the whirl is not followed, or the count says that another one was missed.
    """
    from .frequency_dependent import whirl_exponent

    whole: Any = reaction  # a force at rest, which is what an equilibrium takes

    def exponent(speed: float) -> complex:
        return whirl_exponent(_film(reaction, equilibrium(whole, load, speed)), mass)

    speed, own = start, exponent(start).real
    factor = STEP if own < 0.0 else 1.0 / STEP
    for _ in range(MOST):
        last, speed = speed, speed * factor
        if (exponent(speed).real < 0.0) is not (own < 0.0):
            ends = min(last, speed), max(last, speed)
            onset = _root(lambda at: exponent(at).real, *ends, rtol=NEAR)
            at, ratio = equilibrium(whole, load, onset), abs(exponent(onset).imag) / onset
            return counted_threshold(reaction, _threshold(whole, at, mass, ratio, mass))
    raise AbsentError(
        f"the mass-conserving film has no whirl threshold from {start:.6g} to {speed:.6g} rad/s"
    )


def _film(reaction: Any, at: Equilibrium) -> FrequencyDependentCoefficients:
    film = port.at_balanced_temperature(reaction, at.position, at.speed)
    found = coefficients_of(small_motion(film, at.position, at.speed), at.position, at.speed)
    return cast(FrequencyDependentCoefficients, found)
