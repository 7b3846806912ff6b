"""The potential J of a full journal film with Reynolds rupture: the converged reference behind the map.

With the source g = g_s sin gamma + g_c cos gamma the film's force is (F_t, F_r) = (dJ/dg_s, dJ/dg_c), where
J = (g_s F_t + g_c F_r)/2 < 0 is twelve times the least energy among pressures p >= 0. J is homogeneous of
degree two in g, and its error is of third order in the error of the film's ends, against second order for
the force: J is what a table should hold.
"""

from __future__ import annotations

import math
from functools import cache
from typing import NamedTuple

import numpy as np
from scipy.linalg import cho_factor, cho_solve, solve_banded
from scipy.special import ellipj, ellipkinc

from rotorfilm.bearings.journal.rupture import integrated_legendre
from rotorfilm.core.errors import ConvergenceError, InputError
from rotorfilm.core.model import Array

# The ruptured film's region: two curved ends in the elliptic variable, mapped to a rectangle.


class RitzResolution(NamedTuple):
    """Numbers of circumferential functions, axial functions, and even polynomials that shape an end."""

    around: int
    along: int
    shapes: int


class Source(NamedTuple):
    """What drives the film: eccentricity ratio, g = sine sin gamma + cosine cos gamma, slenderness."""

    chi: float
    sine: float
    cosine: float
    slenderness: float

    def at(self, gamma: Array) -> Array:
        """Return g(gamma)."""
        return self.sine * np.sin(gamma) + self.cosine * np.cos(gamma)

    @property
    def turn(self) -> float:
        """Direction t of the source, g = |g| cos(gamma - t) [rad]."""
        return float(np.arctan2(self.sine, self.cosine))

    @property
    def parameter(self) -> float:
        """Parameter m of the elliptic variable y, gamma = 2 am(y | m)."""
        return 2.0 * self.chi / (1.0 + self.chi)

    def elliptic(self, gamma: Array) -> Array:
        """Return y(gamma)."""
        return np.asarray(ellipkinc(0.5 * gamma, self.parameter))


class Film(NamedTuple):
    """Local film at points y: angle, d gamma/dy, thickness H, d ln H^1.5/dy, conductances around and along.

    The energy of a pressure u is the mean over zeta of int (around u_y^2 + along u_zeta^2)/2 + g rate u dy.
    """

    gamma: Array
    rate: Array
    thickness: Array
    growth: Array
    around: Array
    along: Array


def local_film(source: Source, y: Array) -> Film:
    """Return the film at points of the elliptic variable."""
    sn, cn, _, amplitude = ellipj(y, source.parameter)
    ratio = (1.0 - source.chi) / (1.0 + source.chi)
    dn2 = ratio + (1.0 - ratio) * cn**2
    rate, thickness = 2.0 * np.sqrt(dn2), (1.0 + source.chi) * dn2
    growth = -6.0 * source.parameter * sn * cn / rate
    cube = thickness**3
    along = cube * rate / source.slenderness**2
    return Film(*map(np.asarray, (2.0 * amplitude, rate, thickness, growth, cube / rate, along)))


class Region(NamedTuple):
    """Ends y_1(zeta), y_2(zeta) at the axial nodes, each (2, Q): position and slope dy/dzeta."""

    end: Array
    slope: Array

    @property
    def half_width(self) -> Array:
        """Half the film's extent in y, shape (Q,)."""
        return 0.5 * (self.end[1] - self.end[0])

    def points(self, xi: Array) -> tuple[Array, Array]:
        """Return y and dy/dzeta at fixed xi, each (P, Q)."""
        left, right = 0.5 * (1.0 - xi)[:, None], 0.5 * (1.0 + xi)[:, None]
        return left * self.end[0] + right * self.end[1], left * self.slope[0] + right * self.slope[1]


def region(coefficients: Array, resolution: RitzResolution) -> Region:
    """Return the region whose ends are the even Legendre series `coefficients`, shape (2, S)."""
    value, slope = end_shapes(resolution.along, resolution.shapes)
    return Region(coefficients @ value.T, coefficients @ slope.T)


# Ritz solution of the Reynolds equation on a region with curved ends, p = 0 on its whole edge.


class RitzFilm(NamedTuple):
    """Film on a region, and how far its ends are from rest.

    Attributes
    ----------
    potential : float
        J, twelve times the energy.
    force : ndarray, shape (2,)
        (dJ/dg_s, dJ/dg_c) at fixed region.
    chi_slope : float
        dJ/dchi at fixed region.
    end_slope : ndarray, shape (2, Q)
        Inward slope du/dy at the two ends.
    area : Region
    """

    potential: float
    force: Array
    chi_slope: float
    end_slope: Array
    area: Region


class _Mesh(NamedTuple):
    """Film at the tensor nodes (P, Q); quadrature weights in y and zeta; the factor H^-1.5; mapping."""

    film: Film
    area: Array
    scale: Array
    skew: Array
    half: Array


def solve_region(source: Source, area: Region, resolution: RitzResolution) -> RitzFilm:
    """Return the film that minimizes the energy among pressures that vanish at the edge of the region.

    The unknown is v = H^1.5 u (Liouville), which stays of one order of magnitude where u grows as H^-3.
    """
    mesh = _mesh(source, area, resolution)
    load = mesh.area * mesh.film.rate * mesh.scale
    x, z = around(resolution.around), along(resolution.along)
    drive = x.value.T @ (load * source.at(mesh.film.gamma)) @ z.value
    factor = cho_factor(_stiffness(mesh, resolution), lower=True, overwrite_a=True, check_finite=False)
    v = -cho_solve(factor, drive.ravel(), check_finite=False).reshape(drive.shape)
    pressure = load * (x.value @ v @ z.value.T)
    gamma = mesh.film.gamma
    force = 12.0 * np.array([np.sum(np.sin(gamma) * pressure), np.sum(np.cos(gamma) * pressure)])
    end_scale = local_film(source, area.end).thickness ** -1.5
    end_slope = end_scale * (end_slopes(resolution.around) @ v @ z.value.T) / mesh.half
    return RitzFilm(6.0 * float(np.sum(drive * v)), force, _chi_slope(mesh, v, resolution), end_slope, area)


def _mesh(source: Source, area: Region, resolution: RitzResolution) -> _Mesh:
    x, z = around(resolution.around), along(resolution.along)
    y, skew = area.points(x.node)
    half, film = area.half_width, local_film(source, y)
    return _Mesh(film, np.outer(x.weight, z.weight * half), film.thickness**-1.5, skew, half)


def _stiffness(mesh: _Mesh, resolution: RitzResolution) -> Array:
    """Return the energy's matrix.

    H^1.5 u_y = v_xi/half - growth v, and H^1.5 u_zeta at fixed y is v_zeta - skew v_xi/half.
    """
    x, z = around(resolution.around), along(resolution.along)
    n, m = resolution.around, resolution.along
    area = mesh.area * mesh.scale**2
    flow, side = area * mesh.film.around, area * mesh.film.along
    tilt = -side * mesh.skew / mesh.half
    decline = _sandwich(x.slope, -flow * mesh.film.growth / mesh.half, x.value)
    parts = (
        _sandwich(x.slope, (flow + side * mesh.skew**2) / mesh.half**2, x.slope)
        + _sandwich(x.value, flow * mesh.film.growth**2, x.value)
        + decline
        + decline.swapaxes(1, 2),
        _sandwich(x.slope, tilt, x.value),
        _sandwich(x.value, tilt, x.slope),
        _sandwich(x.value, side, x.value),
    )
    axial = (
        _products(z.value, z.value),
        _products(z.value, z.slope),
        _products(z.slope, z.value),
        _products(z.slope, z.slope),
    )
    matrix = np.concatenate(parts).reshape(-1, n * n).T @ np.concatenate(axial)
    return matrix.reshape(n, n, m, m).transpose(0, 2, 1, 3).reshape(n * m, n * m)


def _sandwich(left: Array, weight: Array, right: Array) -> Array:
    """Return left^T diag(weight_q) right for every axial node q, shape (Q, N, N)."""
    return np.asarray((left.T[None] * weight.T[:, None, :]) @ right)


def _products(left: Array, right: Array) -> Array:
    return (left[:, :, None] * right[:, None, :]).reshape(left.shape[0], -1)


def _chi_slope(mesh: _Mesh, v: Array, resolution: RitzResolution) -> float:
    """Return dJ/dchi: both conductances scale with H^3 at fixed gamma, d ln H^3/dchi = 3 cos gamma/H."""
    x, z = around(resolution.around), along(resolution.along)
    v_y = x.slope @ v @ z.value.T / mesh.half
    value = x.value @ v @ z.value.T
    u_y = mesh.scale * (v_y - mesh.film.growth * value)
    u_zeta = mesh.scale * (x.value @ v @ z.slope.T - mesh.skew * v_y)
    density = mesh.film.around * u_y**2 + mesh.film.along * u_zeta**2
    change = 3.0 * np.cos(mesh.film.gamma) / mesh.film.thickness
    return 6.0 * float(np.sum(mesh.area * change * density))


# The potential J of a full journal film with Reynolds rupture: the converged reference behind the map.


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
    ends = local_film(source, _settled(source, resolution, 0.0)[0].area.end).gamma
    return ends, along(resolution.along).weight


Attempt = tuple[RitzFilm, float, float, Array]
"""A film on trial ends, its corrected potential, the size of the correction, the next step of the ends."""


def _settled(source: Source, resolution: RitzResolution, negligible: float) -> Attempt:
    """Return the film whose ends have come to rest, but for a relative change of J that is negligible."""
    series = np.zeros((2, resolution.shapes))
    series[:, 0] = free_arc(source)
    best = _attempt(source, series, resolution)
    for _ in range(STEPS):
        film, value, size, step = best
        if size < negligible * abs(value):
            break
        reach = REACH * float(np.mean(film.area.half_width))
        series = series + np.clip(step, -reach, reach)
        trial = _attempt(source, series, resolution)
        # Where the ends carry next to nothing their slopes sink into roundoff: no step helps any more.
        if trial[2] > size:
            break
        best = trial
    return best


def _attempt(source: Source, series: Array, resolution: RitzResolution) -> Attempt:
    area = region(series, resolution)
    if np.any(np.ptp(local_film(source, area.end).gamma, axis=0) > 2.0 * math.pi):
        raise ConvergenceError("the film must leave a dry gap on every circle, got none: bearing too long")
    film, (curvature, conductance) = solve_region(source, area, resolution), end_state(source, area)
    rest, size = remainder(film.end_slope, curvature, conductance, resolution)
    return film, film.potential + rest, size, shape_step(film.end_slope, curvature, resolution)


def _result(best: Attempt) -> Potential:
    film, value, size, _ = best
    if not value < 0.0:
        raise ConvergenceError(f"the potential must be negative, got {value!r}")
    return Potential(
        math.log(-value), size / -value, film.force / film.potential, film.chi_slope / film.potential
    )


def _check(chi: float, turn: float, slenderness: float) -> None:
    if not 0.0 <= chi < 1.0:
        raise InputError(f"chi must be in [0, 1), got {chi!r}")
    if not 0.0 <= turn <= 1.0:
        raise InputError(f"turn must be in [0, 1], got {turn!r}")
    if not (math.isfinite(slenderness) and slenderness > 0.0):
        raise InputError(f"slenderness must be finite and positive, got {slenderness!r}")


# Trial functions of a film on a mapped rectangle: circumferential xi in [-1, 1], axial zeta in [0, 1].
#
# zeta = 2 |z|/length runs from the middle plane to the end of the bearing, where the pressure vanishes; the
# film is even in z. Both directions use integrated Legendre polynomials, which vanish at the edges.


EXTRA_AROUND = 16
"""Circumferential quadrature nodes beyond the trial functions: the coefficients are not polynomials."""

EXTRA_ALONG = 6
"""Axial quadrature nodes beyond the number of trial functions."""


class Line(NamedTuple):
    """Trial functions of one direction at its Gauss nodes.

    Attributes
    ----------
    node, weight : ndarray, shape (Q,)
    value, slope : ndarray, shape (Q, N)
    """

    node: Array
    weight: Array
    value: Array
    slope: Array


@cache
def around(count: int) -> Line:
    """Return `count` functions of xi that vanish at xi = -1 and 1."""
    x, weight = np.polynomial.legendre.leggauss(count + EXTRA_AROUND)
    return Line(x, weight, *integrated_legendre(x, count))


@cache
def along(count: int) -> Line:
    """Return `count` even functions of zeta that vanish at zeta = 1, on [0, 1]."""
    x, weight = np.polynomial.legendre.leggauss(2 * (count + EXTRA_ALONG))
    upper = x > 0.0
    value, slope = integrated_legendre(x[upper], 2 * count - 1)
    return Line(x[upper], weight[upper], value[:, ::2], slope[:, ::2])


@cache
def end_slopes(count: int) -> Array:
    """Return the inward slopes of the functions of xi at xi = -1 and 1, shape (2, N)."""
    _, slope = integrated_legendre(np.array([-1.0, 1.0]), count)
    return slope * np.array([[1.0], [-1.0]])


@cache
def end_shapes(along_count: int, shapes: int) -> tuple[Array, Array]:
    """Return even Legendre polynomials of zeta and their slopes at the axial nodes, each (Q, S)."""
    x = along(along_count).node
    polynomial = np.polynomial.legendre
    slopes = [polynomial.legval(x, polynomial.legder(row)) for row in np.eye(2 * shapes - 1)[::2]]
    values = polynomial.legvander(x, 2 * shapes - 2)[:, ::2]
    return np.asarray(values, dtype=float), np.asarray(np.stack(slopes, -1), dtype=float)


# Free ends of a ruptured film: moved until the pressure leaves them without slope.
#
# At the free end of the complementarity solution u and its gradient vanish, and just inside u_yy =
# kappa. An end that is off by delta shows the slope kappa delta, and moving it changes the slope by
# -kappa per unit to first order, without any influence from afar: the local step delta = slope/kappa
# converges quadratically. What is left changes the energy by -int C slope^3/(6 kappa) dzeta, C the
# conductance across the end.


FLOOR = 0.02
"""Least curvature in the remainder, relative to the largest at that end: it vanishes with the slope."""


def end_state(source: Source, area: Region) -> tuple[Array, Array]:
    """Return the curvature du/dy that complementarity asks for at the ends, and their conductance, (2, Q)."""
    film = local_film(source, area.end)
    conductance = film.around + film.along * area.slope**2
    return source.at(film.gamma) * film.rate / conductance, conductance


def shape_step(slope: Array, curvature: Array, resolution: RitzResolution) -> Array:
    """Return the change of the ends' series (2, S): slope = kappa delta in least squares."""
    value, _ = end_shapes(resolution.along, resolution.shapes)
    root = np.sqrt(along(resolution.along).weight)[:, None]
    outward = (-1.0, 1.0)
    steps = [
        sign * np.linalg.lstsq(root * np.maximum(kappa, 0.0)[:, None] * value, root[:, 0] * m, rcond=1e-8)[0]
        for sign, m, kappa in zip(outward, slope, curvature, strict=True)
    ]
    return np.stack(steps)


def remainder(
    slope: Array, curvature: Array, conductance: Array, resolution: RitzResolution
) -> tuple[float, float]:
    """Return the change of J by the slopes left at the ends, and the same with all slopes positive."""
    weight = along(resolution.along).weight
    kappa = np.maximum(curvature, FLOOR * curvature.max(axis=1, keepdims=True))
    density = weight * conductance * slope**3 / kappa
    return -2.0 * float(np.sum(density)), 2.0 * float(np.sum(np.abs(density)))


# Free arc of the first axial mode: where the film ends, to start the two-dimensional solution.
#
# Finite volumes in the elliptic variable over one turn, cut where the source is largest, with u >= 0
# imposed by an active set (Hintermueller, Ito and Kunisch 2002), finite for the M-matrix at hand.


CELLS = 400
"""Cells over the full turn: the ends only start an iteration."""

SWEEPS = 100
"""Active sets tried before giving up; about ten are needed."""


def free_arc(source: Source) -> tuple[float, float]:
    """Return the ends of the first axial mode's film in the elliptic variable.

    Raises
    ------
    ConvergenceError
        If the active set does not settle.
    """
    cut = source.elliptic(source.turn + np.array([0.0, 2.0 * math.pi]))
    step = (cut[1] - cut[0]) / CELLS
    node = cut[0] + step * np.arange(1, CELLS)
    film, face = local_film(source, node), local_film(source, cut[0] + step * (np.arange(CELLS) + 0.5))
    link = face.around / step**2
    decay = (0.5 * math.pi) ** 2 * film.along
    drive = source.at(film.gamma) * film.rate
    u = _complementary(link, decay, drive)
    return _ends(node, u, drive / film.around, step)


def _complementary(link: Array, decay: Array, drive: Array) -> Array:
    """Return u >= 0 with A u + drive >= 0 and u (A u + drive) = 0."""
    diagonal = link[:-1] + link[1:] + decay
    off = link[1:-1]
    active = drive < 0.0
    for _ in range(SWEEPS):
        coupled = off * (active[:-1] & active[1:])
        bands = np.zeros((3, drive.size))
        bands[0, 1:], bands[1], bands[2, :-1] = -coupled, diagonal, -coupled
        u = solve_banded((1, 1), bands, np.where(active, -drive, 0.0), check_finite=False)
        excess = diagonal * u + drive
        excess[1:] -= off * u[:-1]
        excess[:-1] -= off * u[1:]
        updated = np.where(active, u > 0.0, excess < 0.0)
        if np.array_equal(updated, active):
            return np.asarray(u)
        active = updated
    raise ConvergenceError(f"the free arc's active set must settle within {SWEEPS} sweeps, got none")


def _ends(node: Array, u: Array, curvature: Array, step: float) -> tuple[float, float]:
    """Return the ends; there u grows as curvature distance^2/2."""
    film = np.flatnonzero(u > 0.0)
    reach = np.sqrt(2.0 * u[film[[0, -1]]] / np.maximum(curvature[film[[0, -1]]], 1e-300))
    reach = np.minimum(reach, step)
    return float(node[film[0]] - reach[0]), float(node[film[-1]] + reach[1])
