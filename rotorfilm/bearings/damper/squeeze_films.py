"""The squeeze film of a short damper on its porous layer, and the full film of finite length.

The race of a damper does not spin. With the eccentricity e = (x, y)/c and its rate w = v/c [1/s], the film
h = c (1 + e.m), m(theta) the unit vector with theta from the line of maximum film, is squeezed by q = w.m,
and

    F = -integral of (q G(h/c) - S(h/c)) m dtheta,    G = sum of weight/(h^3 + leak),  S = sum of feed/(h^3 +
    leak)

in units of viscosity * radius * length^3 / clearance^2, the groups (weight, leak) from `layer_modes` and the
feed being what enters the film from outside. A solid cage is G = h^-3, the textbook squeeze film.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import cache, cached_property
from itertools import pairwise
from typing import ClassVar, NamedTuple, Protocol, runtime_checkable

import numpy as np

from ...core.errors import UndefinedDerivativeError, warn_user
from ...core.model import Array
from ...native import FilmKernel, SqueezeKernel
from ..films.law import (
    CENTER,
    BoundKernel,
    KernelFilm,
    PolarResponse,
    cartesian_force,
    cartesian_jacobian,
    polar_frame,
)

# What a porous layer takes from a squeeze film and gives to it, axial mode by axial mode.
#
# The layer -H <= y <= 0 lies under the film; its permeability is k(y) = A exp(grading y/H), A at the
# film. Darcy's law and continuity give, with Y = y/H, Z = 2z/L and the axial modes cos(a_n Z), a_n =
# (2n - 1) pi/2,
#
# P_YY + grading P_Y - q_n^2 P = 0, q_n = 2 (H/L) a_n sqrt(k_z/k_y),
#
# so the layer answers a film pressure of mode n with the flux D_n = P_Y(0)/P(0). The mode leaks as a
# film of thickness h does whose h^3 is raised by c_n = 12 Phi D_n/q^2 with q = 2 (H/L) a_n, Phi = A
# H/C^3: a short porous film is the weighted sum of films with 1/(h^3 + c_n), the weights being those
# of the parabola 1 - Z^2. After Cusano & Funk (1977); see docs/damper_films.md for errata of Akhverdiev
# et al.


SINGLE_MODES = 12
"""Axial modes that are kept one by one; those beyond are gathered in blocks."""

LAST_MODE = 3000
"""Last mode; those beyond weigh less than 1e-12."""

BLOCKS = (SINGLE_MODES, 24, 62, 215, 957, LAST_MODE)
"""Last modes of the blocks, the first entry that before them."""

BLOCK_NODES = 4
"""Values of a_n that stand for the modes of a block."""


class LayerModes(NamedTuple):
    """A porous film as a sum of films: G(h) = sum of weight/(h^3 + leak).

    Attributes
    ----------
    weight : ndarray, shape (N,) [1]
        Share of each mode in the axial mean of the pressure; the sum is 1.
    leak : ndarray, shape (N,) [1]
        c_n, what the layer adds to the cube of the relative film thickness.
    passage : ndarray, shape (N,) [1]
        Part of a flux entering at the back of a sealed layer that reaches the film, or the flux into the
        film, times H/A and per pressure at a vented back.
    """

    weight: Array
    leak: Array
    passage: Array


class PorousLayer(NamedTuple):
    """A porous layer in the film's units.

    Attributes
    ----------
    permeability_number : float [1]
        Phi = A H/C^3.
    grading : float [1]
        lambda of k(y) = A exp(lambda y/H).
    thickness_ratio : float [1]
        H/L.
    anisotropy : float [1]
        k_z/k_y, of the permeability along the layer to that through it, A.
    vented : bool
        Whether the back of the layer is open; otherwise it is sealed.
    thin : bool
        Whether the pressure does not vary through a sealed layer (Morgan & Cameron), and nothing flows along
        a vented one.
    """

    permeability_number: float
    grading: float
    thickness_ratio: float
    anisotropy: float
    vented: bool
    thin: bool


def layer_modes(layer: PorousLayer | None) -> LayerModes:
    """Return the groups of axial modes of a film on a layer; None for a solid cage, one film without leak."""
    one = LayerModes(np.ones(1), np.zeros(1), np.ones(1))
    if layer is None:
        return one
    if layer.thin and not layer.vented:
        return one._replace(leak=leakage(layer, np.ones(1)))
    numbers, shares = _groups()
    k2 = numbers**2
    weight = shares @ (6.0 / axial_numbers() ** 4)
    return LayerModes(weight / weight.sum(), leakage(layer, k2) / k2, _exchange(layer, k2)[1])


def leakage(layer: PorousLayer, k2: Array) -> Array:
    """Return what the layer takes from a pressure, 3 Phi D/(H/L)^2; k2 = a_n^2 + (m L/D)^2.

    The film's own term is h^3 k2, in the same unit.
    """
    phi, ratio2 = layer.permeability_number, layer.thickness_ratio**2
    if layer.thin and not layer.vented:
        return 12.0 * phi * mean_permeability(layer.grading) * layer.anisotropy * k2
    return 3.0 * phi / ratio2 * _exchange(layer, k2)[0]


def axial_numbers() -> Array:
    """Return a_n = (2n - 1) pi/2 of all modes, shape (LAST_MODE,)."""
    return np.asarray(0.5 * np.pi * (2.0 * np.arange(1, LAST_MODE + 1) - 1.0), dtype=np.float64)


def mean_permeability(grading: float) -> float:
    """Return (1 - exp(-grading))/grading, the mean permeability through the layer per A [1]."""
    return -math.expm1(-grading) / grading if grading else 1.0


def axial_shapes(modes: LayerModes, Z: Array) -> Array:
    """Return each group's pressure along the axis, shape (N, points); their sum is (1 - Z^2)/2."""
    whole = 0.5 * (1.0 - Z * Z)
    if len(modes.weight) == 1:
        return whole[None]
    a = axial_numbers()[:, None]
    signs = (-1.0) ** np.arange(LAST_MODE)[:, None]
    shapes = _groups()[1] @ (2.0 * signs / a**3 * np.cos(a * Z))
    shapes[-1] += whole - shapes.sum(axis=0)
    return np.asarray(shapes)


def _exchange(layer: PorousLayer, k2: Array) -> tuple[Array, Array]:
    """Return D and the passage from the exponents r+ >= 0 >= r- of exp(r Y), free of cancellation."""
    q2 = np.zeros_like(k2) if layer.thin else 4.0 * layer.anisotropy * layer.thickness_ratio**2 * k2
    d = np.sqrt(layer.grading**2 + 4.0 * q2)
    larger = 0.5 * (d + abs(layer.grading))
    smaller = q2 / np.where(larger > 0.0, larger, 1.0)
    plus, minus = (smaller, larger) if layer.grading >= 0.0 else (larger, smaller)  # r+ and -r-
    safe = np.where(d > 0.0, d, 1.0)
    # d -> 0 (no grading, no flow along the layer): a linear pressure in a vented layer, none through a sealed
    # one.
    span = np.where(d > 0.0, -np.expm1(-d) / safe, 1.0)
    if layer.vented:
        return np.where(d > 0.0, (plus + minus * np.exp(-d)) / (safe * span), 1.0), np.exp(-minus) / span
    below = np.where(d > 0.0, (minus + plus * np.exp(-d)) / safe, 1.0)
    return q2 * span / below, np.exp(-plus) / below


@cache
def _groups() -> tuple[Array, Array]:
    """Return the a_n that stand for groups of modes, (N,), and how much of each mode is in which, (N, modes).

    Single modes, then blocks by Gauss quadrature of their modes over log a_n, 6/a_n^4 the weight.

    What multiplies a mode is interpolated in log a_n from the nodes of its block. 1/(h^3 + c_n) is smooth
    there whatever the layer, though c_n itself falls by decades.
    """
    a = axial_numbers()
    numbers, shares = [a[:SINGLE_MODES]], [np.eye(SINGLE_MODES, LAST_MODE)]
    for first, last in pairwise(BLOCKS):
        low, high = math.log(a[first]), math.log(a[last - 1])
        x = (2.0 * np.log(a[first:last]) - low - high) / (high - low)
        powers = np.vander(x, BLOCK_NODES)
        basis = np.linalg.qr(powers / a[first:last, None] ** 2)[0]
        nodes = np.linalg.eigvalsh(basis.T @ (x[:, None] * basis))
        share = np.zeros((BLOCK_NODES, LAST_MODE))
        share[:, first:last] = np.linalg.solve(np.vander(nodes).T, powers.T)
        numbers.append(np.exp(0.5 * (low + high + (high - low) * nodes)))
        shares.append(share)
    return np.concatenate(numbers), np.concatenate(shares)


# What a squeeze film answers.


@runtime_checkable
class SqueezeFilm(Protocol):
    """A dimensionless, isotropic squeeze-film force with exact derivatives."""

    def force(self, eccentricity: Array, rate: Array) -> Array:
        """Return the force on the rotor [viscosity radius length^3 / clearance^2 / s].

        Parameters
        ----------
        eccentricity : ndarray, shape (2, ...) [1]
            Position / clearance, inside the unit circle.
        rate : ndarray, shape (2, ...) [1/s]
            Velocity / clearance.

        Returns
        -------
        ndarray, shape (2, ...)
        """

    def jacobian(self, eccentricity: Array, rate: Array) -> Array:
        """Return d force / d (eccentricity, rate), shape (2, 4, ...)."""


Arc = tuple[Array, Array, Array, Array]
"""Cosine and sine at the nodes of an arc, film thickness and weights, each (M, B)."""


def arc_nodes(eps: Array, start: Array, end: Array, depth: float, nodes: Array, weights: Array) -> Arc:
    """Return the nodes of an arc, angles from the minimum film, each (M, B) for (M,) nodes and (B,) arcs.

    psi = xi - 2 atan2(b sin xi, 1 + b cos xi), the Sommerfeld angle of a film thicker by `depth`; 1 - eps is
    kept apart from the rest of h, so nothing cancels near the wall.
    """
    rho = np.sqrt((1.0 - eps + depth) / (1.0 + eps + depth))
    b = (1.0 - rho) / (1.0 + rho)
    first, last = _spread(start, b), _spread(end, b)
    nodes, weights = (values.reshape(-1, *(1,) * np.ndim(eps)) for values in (nodes, weights))
    half = 0.5 * (last - first)
    xi = 0.5 * (first + last) + half * nodes
    den = 1.0 + b * b + 2.0 * b * np.cos(xi)
    one_minus_cos = 2.0 * ((1.0 - b) * np.sin(0.5 * xi)) ** 2 / den
    sin = (1.0 - b * b) * np.sin(xi) / den
    h = (1.0 - eps) + eps * one_minus_cos
    return 1.0 - one_minus_cos, sin, h, half * weights * (1.0 - b * b) / den


def _spread(psi: Array, b: Array) -> Array:
    return psi + 2.0 * np.arctan2(b * np.sin(psi), 1.0 - b * np.cos(psi))


# Short squeeze films in the C library, and the maps that stand for others.


NODES = 48
"""Gauss-Legendre nodes over the half circle: within 1e-9 of the force at any eccentricity and leak."""

AXIAL_NODES, CELL_NODES = 16, 6
"""Gauss-Legendre nodes of a fed film that ruptures: along its axis, and in each of 32 cells around it."""


@dataclass(frozen=True)
class KernelSqueezeFilm(KernelFilm):
    """A squeeze film in the C library: its source is the rate.

    Parameters
    ----------
    kernel : FilmKernel
        Film in units of a squeeze film: a map or a `SqueezeKernel`.
    one_slenderness : bool
        Whether it is that of one length / diameter only, as the map of a film of finite length.
    """

    kernel: FilmKernel
    one_slenderness: bool = False

    def _kernel(self, slenderness: float) -> FilmKernel:
        return self.kernel

    def bound(self, *, clearance: float, force_scale: float) -> BoundKernel:
        """Return the film of one damper in SI units, in C.

        Its speed must be 0, since a damper has no wedge.
        """
        return self.bind(slenderness=1.0, clearance=clearance, force_scale=force_scale)

    def force(self, eccentricity: Array, rate: Array, slenderness: float = 1.0) -> Array:
        """Return the force on the rotor, shape (2, ...); see `SqueezeFilm.force`."""
        return super().force(eccentricity, rate, slenderness)

    def jacobian(self, eccentricity: Array, rate: Array, slenderness: float = 1.0) -> Array:
        """Return d force / d (eccentricity, rate), shape (2, 4, ...); see `SqueezeFilm.jacobian`.

        Raises
        ------
        UndefinedDerivativeError
            Where the rotor is at rest in a film that ruptures without feed: its half circle has no direction.
        """
        try:
            return super().jacobian(eccentricity, rate, slenderness)
        except UndefinedDerivativeError as error:
            raise UndefinedDerivativeError(
                f"{error}: the force of a film that ruptures without feed is homogeneous of degree one in "
                "the velocity but not linear, so it has no damping matrix at rest. Use a FullFilm(), or the "
                "equivalent coefficients of a circular orbit (orbit_coefficients)"
            ) from None


def short_squeeze_film(
    modes: LayerModes,
    feed: Array | None = None,
    *,
    cavitated: bool = False,
    ends: tuple[float, float] = (0.0, 0.0),
) -> KernelSqueezeFilm:
    """Return a short film on a porous layer, by `native/films/squeeze_film.c`.

    A full film is exact, in closed form. A film that ruptures carries pressure on the half circle towards
    which the rotor moves, within 1e-9. With feed it has a pressure where that is positive. The force is then
    within 1e-3, and within 1e-2 where the pressures at the ends have opposite signs.

    Parameters
    ----------
    modes : LayerModes
    feed : ndarray, shape (N,) [1/s], optional
        Feed of each group of modes, weight included.
    cavitated : bool
        Whether the film ruptures.
    ends : tuple of two floats [1/s]
        Pressure at Z = -1 and Z = 1 of a film that ruptures, in units of 3 viscosity length^2/clearance^2.
    """
    feed = np.zeros_like(modes.weight) if feed is None else feed
    tables = {"groups": np.stack([modes.weight, modes.leak, feed])}
    if cavitated:
        fed = bool(np.any(feed) or np.any(ends))
        tables["arc"] = np.array(np.polynomial.legendre.leggauss(CELL_NODES if fed else NODES))
        if fed:
            Z, weights = np.polynomial.legendre.leggauss(AXIAL_NODES)
            tables["axial"] = np.stack([Z, weights, *axial_shapes(modes, Z)])
    return KernelSqueezeFilm(SqueezeKernel(tables, ends))


# Full squeeze film of finite length on a porous layer, with flow around the circumference in both.


TWO_DIMENSIONAL_MODES = SINGLE_MODES - 2
"""Axial modes that are solved around the circumference; the rest hardly flow around it."""

TOLERANCE = 1e-13
"""Where the harmonics of the pressure are cut off."""

MOST_HARMONICS = 400

LARGEST = 0.99
"""Eccentricity ratio to which the harmonics resolve the pressure."""


_Matrix = tuple[Array, Array]
"""A matrix and its derivative by the eccentricity ratio."""


@dataclass(frozen=True, eq=False)
class FiniteSqueezeFilm:
    """Full film of finite length: harmonics around the circumference, cosines along the axis, both spectral.

    With q G = -sum (6/a_n^2) X_n and D_n acting on each harmonic m with its own wave number,

        (L/D)^2 (h^3 X_n')' - a_n^2 h^3 X_n - leakage X_n = source.

    Ten axial modes are solved so; the others are taken as short. For eccentricity ratios up to 0.99.

    Parameters
    ----------
    slenderness : float [1]
        L/D.
    layer : PorousLayer or None
        None for a solid cage.
    modes : LayerModes
        Modes of that layer.
    feed : ndarray, shape (N,) [1/s]
        Feed of each group of modes, weight included.
    """

    slenderness: float
    layer: PorousLayer | None
    modes: LayerModes
    feed: Array

    one_slenderness: ClassVar[bool] = True
    """It is that of one length / diameter only."""

    def force(self, eccentricity: Array, rate: Array) -> Array:
        """Return the force on the rotor, shape (2, ...); see `SqueezeFilm.force`."""
        e, w = eccentricity.reshape(2, -1), rate.reshape(2, -1)
        frame = polar_frame(e, w, floor=CENTER)
        response, lift, _ = self._response(frame.chi)
        film = cartesian_force(frame, response.A) - lift * e
        return film.reshape(eccentricity.shape) + self._short.force(eccentricity, rate)

    def jacobian(self, eccentricity: Array, rate: Array) -> Array:
        """Return d force / d (eccentricity, rate), shape (2, 4, ...); see `SqueezeFilm.jacobian`."""
        e, w = eccentricity.reshape(2, -1), rate.reshape(2, -1)
        frame = polar_frame(e, w, floor=CENTER)
        response, lift, lift_slope = self._response(frame.chi)
        film = cartesian_jacobian(frame, response)
        film[:, :2] -= lift * np.eye(2)[:, :, None] + lift_slope / frame.chi * e[:, None] * e
        return film.reshape(2, 4, *eccentricity.shape[1:]) + self._short.jacobian(eccentricity, rate)

    @cached_property
    def _short(self) -> KernelSqueezeFilm:
        """The remaining axial modes."""
        rest = slice(TWO_DIMENSIONAL_MODES, None)
        if len(self.modes.weight) == 1:  # one group stands for all modes
            share = np.array([1.0 - np.sum(6.0 / axial_numbers()[:TWO_DIMENSIONAL_MODES] ** 4)])
            return short_squeeze_film(self.modes._replace(weight=share), share * self.feed)
        modes = self.modes._replace(weight=self.modes.weight[rest], leak=self.modes.leak[rest])
        return short_squeeze_film(modes, self.feed[rest])

    def _response(self, chi: Array) -> tuple[PolarResponse, Array, Array]:
        """Return the polar matrix, the lift per eccentricity and its slope at eccentricity ratios (B,)."""
        if np.any(chi > LARGEST * (1.0 + 1e-12)):
            warn_user(
                f"eccentricity ratio must not exceed {LARGEST} for a film of finite length, got "
                f"{chi.max():.6g}: its harmonics no longer resolve the pressure",
            )
        values = np.array([self._radial(float(eps)) for eps in chi]).reshape(-1, 6)
        A, A_chi = np.zeros((2, chi.size, 2, 2))
        A[:, 1, 1], A[:, 0, 0], A_chi[:, 1, 1], A_chi[:, 0, 0] = values[:, (0, 1, 3, 4)].T
        return PolarResponse(A, A_chi, np.zeros_like(A)), values[:, 2], values[:, 5]

    def _radial(self, eps: float) -> Array:
        """Return integrals of cos, sin, -cos/eps times the pressures of sources cos, sin, feed; slopes."""
        even, odd = _cubes(eps, _harmonics(eps))
        m = np.arange(float(len(even[0])))
        total = np.zeros(6)
        for n, a in enumerate(axial_numbers()[:TWO_DIMENSIONAL_MODES]):
            k2 = a * a + (self.slenderness * m) ** 2
            leak = np.zeros_like(k2) if self.layer is None else leakage(self.layer, k2)
            feed = (self.feed[0] if len(self.feed) == 1 else self.feed[n] / self.modes.weight[n]) / eps
            cosines = self._around(odd, m[1:], first=0)
            (by_cos, by_feed), (cos_slope, feed_slope) = _solve(cosines, even, leak, a, sources=2)
            sines = self._around((even[0][1:, 1:], even[1][1:, 1:]), m[1:], first=1)
            (by_sin,), (sin_slope,) = _solve(sines, odd, leak[1:], a, sources=1)
            lift, lift_slope = -feed * by_feed, -feed * (feed_slope - by_feed / eps)
            total += 6.0 / a**2 * np.array([by_cos, by_sin, lift, cos_slope, sin_slope, lift_slope])
        return total

    def _around(self, cube: _Matrix, m: Array, *, first: int) -> _Matrix:
        """Return -(L/D)^2 (h^3 X')' from a `first` harmonic on; `cube` multiplies the other parity by h^3."""
        value, slope = (self.slenderness**2 * m[:, None] * part * m for part in cube)
        border = (1 - first, 0)
        return np.pad(value, border), np.pad(slope, border)


def _solve(around: _Matrix, cube: _Matrix, leak: Array, a: float, *, sources: int) -> tuple[Array, Array]:
    """Return pi times the first harmonic of -X, and its slope by eps.

    The sources are that harmonic and, as the second of two, a uniform one.
    """
    first = sources - 1
    matrix = around[0] + a * a * cube[0] + np.diag(leak)
    slope = around[1] + a * a * cube[1]
    source = np.zeros((len(matrix), sources))
    source[first, 0] = source[0, first] = 1.0
    X = np.linalg.solve(matrix, source)
    X_slope = -np.linalg.solve(matrix, slope @ X)
    return np.pi * X[first], np.pi * X_slope[first]


def _cubes(eps: float, size: int) -> tuple[_Matrix, _Matrix]:
    """Return the products by h^3 of cosines 0..size and of sines 1..size, with slopes by eps."""
    half = np.full(size, 0.5)
    even = np.diag(half, 1) + np.diag(half, -1)
    even[1, 0] = 1.0
    odd = np.diag(half[1:], 1) + np.diag(half[1:], -1)
    cubes = []
    for cos in (even, odd):
        h = np.eye(len(cos)) + eps * cos
        cubes.append((h @ h @ h, 3.0 * cos @ h @ h))
    return cubes[0], cubes[1]


def _harmonics(eps: float) -> int:
    """Return how many harmonics a pressure ~ 1/h^3 needs: they fall as (eps/(1 + sqrt(1 - eps^2)))^m."""
    z = eps / (1.0 + np.sqrt((1.0 - eps) * (1.0 + eps)))
    return int(min(MOST_HARMONICS, 12 + 1.3 * np.log(TOLERANCE) / np.log(max(z, 1e-3))))
