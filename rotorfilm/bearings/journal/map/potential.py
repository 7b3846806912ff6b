"""The potential J of a full journal film with Reynolds rupture: the converged reference behind the map.

With the source g = g_s sin gamma + g_c cos gamma the film's force is (F_t, F_r) = (dJ/dg_s, dJ/dg_c), where
J = (g_s F_t + g_c F_r)/2 < 0 is twelve times the least energy among pressures p >= 0. J is homogeneous of
degree two in g, and its error is of third order in the error of the film's ends, against second order for
the force: J is what a table should hold.
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np

from ....errors import ConvergenceError, InputError
from ....model import Array
from .potential_arc import free_arc
from .potential_basis import along
from .potential_domain import Region, RitzResolution, Source, local_film, region
from .potential_ritz import RitzFilm, solve_region
from .potential_shape import end_state, remainder, shape_step

STEPS = 12
"""Moves of the ends at most; four to eight are needed."""

NEGLIGIBLE = 3e-9
"""Relative change of J by the slopes left at the ends, below which they stay where they are."""

REACH = 0.2
"""Largest move of an end, relative to half the film's extent."""


class Potential(NamedTuple):
    """Potential of the film for |g| = 1 and its derivatives.

    Attributes
    ----------
    log : float
        L = ln(-J), J in units of viscosity * length * radius^3 / clearance^2.
    error : float
        Estimated error of `log`: what the slopes left at the ends are worth. It leaves out the truncation
        of `Resolution`, to be measured with a higher one.
    force : ndarray, shape (2,)
        (F_t, F_r) / J = d ln(-J) / d (g_s, g_c).
    chi_slope : float
        dL/dchi at fixed direction.
    """

    log: float
    error: float
    force: Array
    chi_slope: float


def default_resolution(chi: float, slenderness: float) -> RitzResolution:
    """Return what converges L to about 1e-7.

    A long film near the wall has thin layers at its axial ends, of relative thickness sqrt(1 - chi)/(L/D);
    polynomials need the inverse root of that.
    """
    layer = math.sqrt(1.0 - chi) / slenderness
    along = min(max(math.ceil(2.0 / math.sqrt(layer)), 10), 24)
    return RitzResolution(32 if chi < 0.98 else 40, along, 4)


def potential(
    chi: float, turn: float, slenderness: float, resolution: RitzResolution | None = None
) -> Potential:
    """Return the potential of a full film with Reynolds rupture.

    Parameters
    ----------
    chi : float [1]
        Eccentricity ratio, 0 <= chi < 1.
    turn : float [1]
        T = (1 + g_c/|g|)/2 in [0, 1]: 0 journal leaving the wall, 1/2 rotation only, 1 approaching it.
    slenderness : float [1]
        Bearing length / diameter.
    resolution : RitzResolution, optional
        Numbers of trial functions; `default_resolution` by default.

    Returns
    -------
    Potential

    Raises
    ------
    InputError
        If an argument is outside its range.
    ConvergenceError
        If the ends of the film do not settle.
    """
    _check(chi, turn, slenderness)
    cosine = 2.0 * turn - 1.0
    sine = -2.0 * math.sqrt(turn * (1.0 - turn))
    source = Source(chi, sine, cosine, slenderness)
    return directed_potential(source, resolution or default_resolution(chi, slenderness))


def directed_potential(source: Source, resolution: RitzResolution) -> Potential:
    """Return the potential for any g, of unit magnitude or not; `log` is then that of the whole J.

    See Also
    --------
    potential
    """
    return _result(_settled(source, resolution, NEGLIGIBLE))


def film_ends(source: Source, resolution: RitzResolution) -> tuple[Array, Array]:
    """Return the angles at which the film begins and ends, (2, Q) [rad], and the axial weights, (Q,).

    The angles are those of gamma, without a jump from the first end to the second, at Gauss nodes of zeta in
    [0, 1]; the weights add up to 1.
    """
    # Near the wall ends far from it decide the flow, though they are worth next to nothing of J.
    ends = local_film(source, _settled(source, resolution, 0.0).area.end).gamma
    return ends, along(resolution.along).weight


def _settled(source: Source, resolution: RitzResolution, negligible: float) -> _Attempt:
    """Return the film whose ends have come to rest, but for a relative change of J that is negligible."""
    series = np.zeros((2, resolution.shapes))
    series[:, 0] = free_arc(source)
    best = _attempt(source, series, resolution)
    for _ in range(STEPS):
        if best.size < negligible * abs(best.value):
            break
        reach = REACH * float(np.mean(best.area.half_width))
        series = series + np.clip(best.step, -reach, reach)
        trial = _attempt(source, series, resolution)
        # Where the ends carry next to nothing their slopes sink into roundoff: no step helps any more.
        if trial.size > best.size:
            break
        best = trial
    return best


class _Attempt(NamedTuple):
    """A film on trial ends: corrected potential, size of the correction, next step."""

    film: RitzFilm
    area: Region
    value: float
    size: float
    step: Array


def _attempt(source: Source, series: Array, resolution: RitzResolution) -> _Attempt:
    area = region(series, resolution)
    if np.any(np.ptp(local_film(source, area.end).gamma, axis=0) > 2.0 * math.pi):
        raise ConvergenceError("the film must leave a dry gap on every circle, got none: bearing too long")
    film, state = solve_region(source, area, resolution), end_state(source, area)
    rest, size = remainder(film.end_slope, state, resolution)
    step = shape_step(film.end_slope, state, resolution)
    return _Attempt(film, area, film.potential + rest, size, step)


def _result(best: _Attempt) -> Potential:
    if not best.value < 0.0:
        raise ConvergenceError(f"the potential must be negative, got {best.value!r}")
    film, value = best.film, best.value
    return Potential(
        math.log(-value), best.size / -value, film.force / film.potential, film.chi_slope / film.potential
    )


def _check(chi: float, turn: float, slenderness: float) -> None:
    if not 0.0 <= chi < 1.0:
        raise InputError(f"chi must be in [0, 1), got {chi!r}")
    if not 0.0 <= turn <= 1.0:
        raise InputError(f"turn must be in [0, 1], got {turn!r}")
    if not (math.isfinite(slenderness) and slenderness > 0.0):
        raise InputError(f"slenderness must be finite and positive, got {slenderness!r}")
