"""Which squeeze film a damper has: short, of finite length, or as published."""

from __future__ import annotations

import math
from abc import abstractmethod
from dataclasses import dataclass
from functools import cached_property, lru_cache
from typing import ClassVar, NamedTuple, Protocol, runtime_checkable

import numpy as np
from scipy.linalg import cho_factor, cho_solve

from ...core.errors import InputError, require_non_negative, require_positive
from ...core.inputs import arguments, quantities
from ...core.model import Array
from ...native.film_kernels import OilDamperKernel, OilParts, OilScales
from ..films.law import report_law
from .squeeze_films import (
    LARGEST,
    FiniteSqueezeFilm,
    LayerModes,
    PorousLayer,
    SqueezeFilm,
    short_squeeze_film,
)


class SqueezeCase(NamedTuple):
    """A damper as its film sees it.

    Attributes
    ----------
    slenderness : float [1]
        L/D.
    layer : PorousLayer or None
        None for a solid cage.
    modes : LayerModes
        Modes of the layer.
    feed : ndarray, shape (N,) [1/s]
        Feed of each group of modes, weight included.
    ends : tuple of two floats [1/s]
        Pressure at both ends times clearance^2/(3 viscosity length^2).
    cavitated : bool
    end_leak : float [1]
        12 viscosity radius/clearance^3 times the leakage of either end; infinite for open ends.
    heavy : bool
        Whether the inertia of the oil counts.
    """

    slenderness: float
    layer: PorousLayer | None
    modes: LayerModes
    feed: Array
    ends: tuple[float, float]
    cavitated: bool
    end_leak: float = math.inf
    heavy: bool = False

    @property
    def is_sealed(self) -> bool:
        """Whether seals hold pressure at its ends."""
        return math.isfinite(self.end_leak)


@runtime_checkable
class SqueezeLaw(Protocol):
    """A choice of squeeze film."""

    def bind(self, case: SqueezeCase) -> SqueezeFilm:
        """Return the film of one damper; raise InputError where the law cannot represent it."""


class SqueezeOptions:
    """What a squeeze law may have besides `bind`: what it leaves as it is here, it has not."""

    slenderness_limit: ClassVar[float] = math.inf
    """Largest length / diameter for which the film is meant; beyond, a damper warns."""

    largest_eccentricity_ratio: ClassVar[float] = 1.0
    """Eccentricity ratio to which the film is meant; 1 where it is meant up to the wall."""

    def tabulated(self, case: SqueezeCase) -> SqueezeLaw | None:
        """Return this law with the table that it would make in a damper; None if it makes none."""
        return None

    def inertia(self, case: SqueezeCase) -> FilmInertia:
        """Return the inertia of the film of one damper; raise InputError where it is not known."""
        raise InputError(f"density must be 0 for {self!r}, whose inertia is not known")


@dataclass(frozen=True)
class ShortSqueeze(SqueezeOptions):
    """Short film: flow along the axis only, in the film and in the porous layer."""

    slenderness_limit: ClassVar[float] = 0.25
    """Largest length / diameter for which the film is meant [1]."""

    def bind(self, case: SqueezeCase) -> SqueezeFilm:
        """Return the film of one damper; raise InputError where its seals are tight."""
        film = short_squeeze_film(case.modes, case.feed, cavitated=case.cavitated, ends=case.ends)
        return sealed_short(film, case)

    def inertia(self, case: SqueezeCase) -> FilmInertia:
        """Return the inertia of the film of one damper; see `SqueezeOptions`."""
        return short_film_inertia(case)


@dataclass(frozen=True)
class FiniteSqueeze(SqueezeOptions):
    """Full film of finite length: the reference for the short film. A force takes some milliseconds."""

    largest_eccentricity_ratio: ClassVar[float] = LARGEST
    """Eccentricity ratio to which the film is meant [1]."""

    def bind(self, case: SqueezeCase) -> SqueezeFilm:
        """Return the film of one damper; raise InputError for a cavitated film."""
        if case.cavitated:
            raise InputError("extent must be FullFilm() for FiniteSqueeze(), got a cavitated film")
        if case.is_sealed or case.heavy:
            return radial_table(case.slenderness, case.end_leak)
        return FiniteSqueezeFilm(case.slenderness, case.layer, case.modes, case.feed)

    def inertia(self, case: SqueezeCase) -> FilmInertia:
        """Return the inertia of the film of one damper; see `SqueezeOptions`."""
        return finite_film_inertia(case)


@dataclass(frozen=True)
class PublishedSqueeze(SqueezeOptions):
    """Film for small motion as published by Akhverdiev et al., with corrected signs; for comparison only.

    The film is full, and linear in eccentricity and velocity. The leakage is that of a vented back with the
    flux number Delta1 = 12 grading/(grading + 6), from the authors' polynomial through the layer. It has no
    effect without grading, and a trend opposite to that of a real layer. Equations (37)-(40);
    docs/damper_films.md has the errata. Do not use it for design.
    """

    def bind(self, case: SqueezeCase) -> SqueezeFilm:
        """Return the film of one damper; raise InputError for a cavitated film or a grading below 0."""
        if case.cavitated:
            raise InputError("extent must be FullFilm() for PublishedSqueeze(), got a cavitated film")
        if case.is_sealed:
            raise InputError("seals must be None for PublishedSqueeze()")
        if case.layer is not None and case.layer.grading < 0.0:
            raise InputError(
                f"grading must not be negative for PublishedSqueeze(), got {case.layer.grading!r}"
            )
        conductance = 1.0 if case.layer is None else published_conductance(case.layer)
        return LinearSqueezeFilm(math.pi * conductance, 3.0 * math.pi * float(np.sum(case.feed)))


def sealed_short(film: SqueezeFilm, case: SqueezeCase) -> SqueezeFilm:
    """Return a short film with the seals of a damper; raise InputError where they are tight."""
    if not case.is_sealed:
        return film
    if case.end_leak == 0.0:
        raise InputError(
            "leakage of seals must be positive for a short film, got 0: its oil flows only along the axis; "
            "FullFilm() with FiniteSqueeze() also has the flow around the circumference"
        )
    # c^3/(2 viscosity G_s L), half the circle where the film ruptures
    damping = math.pi * 3.0 / (case.end_leak * case.slenderness)
    return SealedShortFilm(film, 0.5 * damping if case.cavitated else damping)


def short_film_inertia(case: SqueezeCase) -> FilmInertia:
    """Return the inertia of a short film: that of its zone where it ruptures."""
    return FilmInertia(zone=1.0) if case.cavitated else FilmInertia(closed=1.0)


def finite_film_inertia(case: SqueezeCase) -> FilmInertia:
    """Return the inertia of a film of finite length; of one that ruptures that of its zone."""
    if case.cavitated:
        return FilmInertia(zone=parabola_mean(case.slenderness))
    return FilmInertia(table=radial_table(case.slenderness, case.end_leak).table, reach=LARGEST_TABULATED)


def published_conductance(layer: PorousLayer) -> float:
    """Return G(1) of the published film: 3 (1 - tanh x/x)/x^2, x^2 = 3 Phi Delta1/(H/L)^2."""
    flux = 12.0 * layer.grading / (layer.grading + 6.0)
    return parabola_mean(math.sqrt(3.0 * layer.permeability_number * flux) / layer.thickness_ratio)


def parabola_mean(x: float) -> float:
    """Return 3 (1 - tanh x/x)/x^2, 1 at x = 0: what flow across a boundary leaves of a parabola's mean."""
    if x < 0.02:
        return 1.0 - 0.4 * x * x + 17.0 / 105.0 * x**4
    return 3.0 * (1.0 - math.tanh(x) / x) / (x * x)


@dataclass(frozen=True)
class LinearSqueezeFilm:
    """A full film of constant damping and stiffness.

    Parameters
    ----------
    damping, stiffness : float [1]
        Force per rate and per eccentricity, against them.
    """

    damping: float
    stiffness: float

    def force(self, eccentricity: Array, rate: Array) -> Array:
        """Return the force on the rotor, shape (2, ...); see `SqueezeFilm.force`."""
        return -self.damping * rate - self.stiffness * eccentricity

    def jacobian(self, eccentricity: Array, rate: Array) -> Array:
        """Return d force / d (eccentricity, rate), shape (2, 4, ...); see `SqueezeFilm.jacobian`."""
        constant = np.concatenate([-self.stiffness * np.eye(2), -self.damping * np.eye(2)], axis=1)
        axes = (1,) * (eccentricity.ndim - 1)
        return np.broadcast_to(constant.reshape(2, 4, *axes), (2, 4, *eccentricity.shape[1:])).copy()


# Films of the C library that have seals or inertia, in the film's units (`native/films/oil_damper.h`).


NODES = np.polynomial.legendre.leggauss(40)
"""Of Gauss and Legendre over the zone of a ruptured film, and their weights."""


class OilTerms:
    """A force of the C library without dimensions, of a squeeze film or of its inertia."""

    @property
    @abstractmethod
    def kernel(self) -> OilDamperKernel:
        """The force of a damper of clearance 1 and unit scales."""

    def force(self, eccentricity: Array, rate: Array) -> Array:
        """Return the force on the rotor, shape (2, ...); see `SqueezeFilm.force`."""
        return self._answer(eccentricity, rate, slopes=False).reshape(eccentricity.shape)

    def jacobian(self, eccentricity: Array, rate: Array) -> Array:
        """Return d force / d (eccentricity, rate), shape (2, 4, ...); see `SqueezeFilm.jacobian`."""
        found = self._answer(eccentricity, rate, slopes=True)
        return found[:, :4].reshape(2, 4, *eccentricity.shape[1:])

    def _answer(self, eccentricity: Array, rate: Array, *, slopes: bool) -> Array:
        e, w = eccentricity.reshape(2, -1), rate.reshape(2, -1)
        batch = (self.kernel.jacobian if slopes else self.kernel.force)(e, w, np.zeros(1))
        report_law(batch, e, w, self.kernel.film)
        return batch.values


def oil_parts(
    *,
    zone: float = 0.0,
    closed: float = 0.0,
    tabled: float = 0.0,
    sealed: float = 0.0,
    radial: Array | None = None,
) -> OilParts:
    """Return what a damper is made of; see `OilParts`."""
    least = 1.0 if radial is None else least_root()
    return OilParts(zone, closed, tabled, sealed, radial, least, *NODES)


@dataclass(frozen=True, eq=False, kw_only=True)
class FilmInertia(OilTerms):
    """Inertia of the oil in a film: its added mass, and as its force that of convection.

    A ruptured film has the pressure of the inertia on the half circle towards which the rotor moves, as if
    this zone stayed so. In truth that pressure moves the edge of the film. On a circular orbit the rule has
    an error of 0, 0.5, 2.6 and 8 % of the force at eccentricity ratio 0.2, and of 0, 0.7, 4.6 and 18 % at
    0.5, for squeeze Reynolds numbers of 0.5, 2, 5 and 10.

    Parameters
    ----------
    zone : float [1]
        Share of the short film's inertia in a ruptured zone: 1, or that of a film of finite length in small
        motion about the center, where it is exact, since acceleration turns the half circle there. At
        eccentricity ratio 0.5 the mass along the motion is then 6 and 14 % too small at length / diameter 0.5
        and 1.
    closed : float [1]
        Share of the inertia of a short full film, which is known in closed form.
    table : ndarray, shape (NODES, 7), or None
        That of a full film of finite length, as of a `RadialTable`.
    reach : float [1]
        Eccentricity ratio to which it is meant.

    Notes
    -----
    The inertia of a short film's mean flow z h_t/h (first order, parabolic profile) gives the pressure

        integral of p dz = -(density L^3/12) [(6/5) h_tt/h - (102/35) h_t^2/h^2],

    M = (1/10) integral of m m/h, q = (17/70) integral of (w.m)^2 m/h^2 over the circumference, of a ruptured
    film over its zone. Seals change the viscous pressure only: what leaves a short film is its volume.
    """

    zone: float = 0.0
    closed: float = 0.0
    table: Array | None = None
    reach: float = 1.0

    def parts(self, sealed: float = 0.0, radial: Array | None = None) -> OilParts:
        """Return what a damper with this inertia is made of, with the table of its viscous film."""
        tabled, table = float(self.table is not None), radial if self.table is None else self.table
        return oil_parts(zone=self.zone, closed=self.closed, tabled=tabled, sealed=sealed, radial=table)

    @cached_property
    def kernel(self) -> OilDamperKernel:
        """The inertia alone, in units of density radius length^3."""
        return OilDamperKernel(self.parts(), None, OilScales(1.0, 0.0, 1.0, 0.0))

    def mass(self, eccentricity: Array, rate: Array) -> Array:
        """Return the added mass, shape (2, 2, ...), symmetric.

        Parameters
        ----------
        eccentricity : ndarray, shape (2, ...) [1]
            Position / clearance.
        rate : ndarray, shape (2, ...) [1/s]
            Velocity / clearance; of a ruptured film only its direction matters, of a full one nothing.
        """
        return self._masses(eccentricity, rate)[:, :, 0]

    def mass_slopes(self, eccentricity: Array, rate: Array) -> Array:
        """Return d mass / d (eccentricity, rate), shape (2, 2, 4, ...)."""
        return self._masses(eccentricity, rate)[:, :, 1:]

    def _masses(self, eccentricity: Array, rate: Array) -> Array:
        """Return the mass and its derivatives side by side, shape (2, 2, 5, ...)."""
        e, w = eccentricity.reshape(2, -1), rate.reshape(2, -1)
        batch = self.kernel.masses(e, w)
        report_law(batch, e, w, self.kernel.film)
        return batch.values[[[0, 1], [1, 2]]].reshape(2, 2, 5, *eccentricity.shape[1:])


# Functions of the radius for full films of finite length, between ends of any leakage, in a short table.


LARGEST_TABULATED = 0.95
"""Eccentricity ratio to which the pressures are resolved; beyond, all goes on as powers of 1 - eps^2."""

INERTIA_NODES = 20
"""Of the table, over sqrt(1 - eps^2)."""

POWERS = np.array([1.0, 1.0, 1.0, 1.0, 3.0, 3.0, 5.0])
"""Of 1/sqrt(1 - eps^2) in the functions of the inertia and c, d of the damping: those of the short film."""


@dataclass(frozen=True, eq=False)
class RadialTable(OilTerms):
    """Full film of finite length between ends of any leakage: F = -c w - d (e.w) e, and its inertia.

    Seven functions of the squared eccentricity ratio, as polynomials in s = sqrt(1 - E).

    Parameters
    ----------
    table : ndarray, shape (NODES, 7)
        Chebyshev coefficients of the functions times s to the `POWERS`.
    """

    table: Array

    @cached_property
    def kernel(self) -> OilDamperKernel:
        """The viscous film alone."""
        return OilDamperKernel(oil_parts(radial=self.table), None, OilScales(1.0, 1.0, 0.0, 0.0))


@lru_cache(maxsize=32)
def radial_table(slenderness: float, end_leak: float) -> RadialTable:
    """Return the functions of a film of one length / diameter and one leakage of its ends [1], in a second.

    See `squeeze_motions`.
    """
    chebyshev, least = np.polynomial.chebyshev, least_root()
    x = chebyshev.chebpts1(INERTIA_NODES)
    s = 0.5 * ((1.0 - least) * x + 1.0 + least)
    rows = [_functions(float(eps), slenderness, end_leak) for eps in np.sqrt((1.0 - s) * (1.0 + s))]
    return RadialTable(chebyshev.chebfit(x, np.array(rows) * s[:, None] ** POWERS, INERTIA_NODES - 1))


def least_root() -> float:
    """Return the smallest sqrt(1 - eps^2) of a table."""
    return math.sqrt(1.0 - LARGEST_TABULATED**2)


def _functions(eps: float, slenderness: float, end_leak: float) -> tuple[float, ...]:
    """Return m, n, a, b, c of the inertia and c, d of the damping at one eccentricity ratio."""
    (c_r, c_t), (m_r, m_t), (radial, across, along) = squeeze_motions(eps, slenderness, end_leak)
    a, b = across / eps, along / eps
    return m_t, (m_r - m_t) / eps**2, a, b, (radial / eps - a - b) / eps**2, c_t, (c_r - c_t) / eps**2


# The inertia of the oil in a full squeeze film: the mass that it adds and the force of its
# convection.
#
# The first order in the Reynolds number: with the acceleration a of the rotor the film answers
#
# F = F_viscous(x, v) - M(x) a + q(x, v, v)
#
# M without q would be wrong by half at eccentricity ratio 0.5. In units: x = clearance e, v =
# clearance w; M in density radius length^3 / clearance, q in density radius length^3 per 1/s^2.


CONVECTION = 17.0 / 70.0
"""Force of convection in a short film per integral of (w.m)^2 m/h^2: (102/35)/12 of its pressure."""


# Full squeeze film of finite length between ends of any leakage: pressure, added mass and convection.
#
# Laminar flow -grad p = 12 viscosity v/h^2, div(h v) = -h_t, flow out of either end G_s p. By Ritz's
# method: harmonics around the circumference; along the axis Legendre polynomials that vanish at the
# ends, and a constant, which the ends leave free. The inertia of that flow adds a pressure p1 of
# first order in the Reynolds number, whose force needs no second solution: with the velocity field
# v_k of a unit velocity of the rotor along k, and v that of its whole motion,
#
# F1_k = -density * integral of h v_k.[(6/5) dv/dt + (54/35) (v.grad) v - (6/35) (h_t/h) v] dA,
#
# because leakage is linear and symmetric. (6/5, 54/35 and 6/35 belong to the parabolic profile.)


AXIAL = 8
"""Functions along half the axis."""

MOST_HARMONICS = 90
TOLERANCE = 1e-9


class SqueezeMotions(NamedTuple):
    """Damping, mass and convection of a full film at one eccentricity ratio, the rotor on the x axis.

    Attributes
    ----------
    damping, mass : tuple of two floats
        Damping and mass along the radius and across it; [viscosity radius length^3/clearance^3], [density
        radius length^3/clearance].
    convection : tuple of three floats
        Radial force of w_r^2, radial of w_t^2, tangential of w_r w_t; [density radius length^3].
    """

    damping: tuple[float, float]
    mass: tuple[float, float]
    convection: tuple[float, float, float]


def squeeze_motions(eps: float, slenderness: float, end_leak: float) -> SqueezeMotions:
    """Return what a film does in unit motions.

    Parameters
    ----------
    eps : float [1]
        Eccentricity ratio, above 0.
    slenderness : float [1]
        Length / diameter.
    end_leak : float [1]
        12 viscosity radius G_s/clearance^3 of either end, infinite for an open one.
    """
    film = _Film(eps, slenderness, end_leak)
    pressures = [film.pressure(k) for k in range(2)]
    slopes = [film.slopes(k, P) for k, P in enumerate(pressures)]
    flows = [film.flow(p) for p in slopes]
    mass = [0.15 / slenderness**2 * film.over(film.h * (v[0] ** 2 + v[1] ** 2)) for v in flows]
    damping = [film.damping(k, P) for k, P in enumerate(pressures)]
    moved = [[film.moved(k, p, way) for way in range(2)] for k, p in enumerate(slopes)]
    pushes = [film.convection(k, rate, flows, moved) for k, rate in ((0, (1, 0)), (0, (0, 1)), (1, (1, 1)))]
    return SqueezeMotions((damping[0], damping[1]), (mass[0], mass[1]), (pushes[0], pushes[1], pushes[2]))


class _Film:
    """One film: its grid, and pressures even (0) and odd (1) in the angle."""

    def __init__(self, eps: float, slenderness: float, end_leak: float) -> None:
        count = _harmonics(eps)
        theta = 2.0 * np.pi / (4 * count) * np.arange(4 * count)
        self.s, self.leak = slenderness, end_leak
        self.weight, self.axis, self.end = _axis(free_ends=math.isfinite(end_leak))
        self.m = (np.cos(theta)[:, None], np.sin(theta)[:, None])
        self.h, self.h_t = 1.0 + eps * self.m[0], -eps * self.m[1]
        self.step = 2.0 * np.pi / theta.size
        n = np.arange(count + 1.0)[:, None]
        cos, sin = np.cos(n * theta), np.sin(n * theta)
        even, odd = (cos, -n * sin, -n * n * cos), (sin, n * cos, -n * n * sin)
        self.ring = (even, tuple(rows[1:] for rows in odd))
        self.factor = [cho_factor(self._matrix(parity)) for parity in range(2)]

    def over(self, values: Array) -> float:
        """Return the integral over the angle and over the axis in half lengths."""
        return float(self.step * np.sum(values @ self.weight))

    def pressure(self, k: int) -> Array:
        """Return the pressure of a unit rate along x (0) or y (1): coefficients (harmonics, functions)."""
        source = (self.ring[k][0] * self.step) @ self.m[k] * (self.axis[0] @ self.weight)
        return self._solved(k, -self.s * source)

    def slopes(self, parity: int, P: Array) -> list[Array]:
        """Return p_t, p_z, p_tt, p_tz, p_zz, each (theta, z): over the angle and the axis in half lengths."""
        ring, line = self.ring[parity], self.axis
        return [ring[i].T @ P @ line[j] for i, j in ((1, 0), (0, 1), (2, 0), (1, 1), (0, 2))]

    def damping(self, k: int, P: Array) -> float:
        """Return minus the force on the rotor along k."""
        return -1.5 / self.s**2 * self.over(self.m[k] * (self.ring[k][0].T @ P @ self.axis[0]))

    def flow(self, p: list[Array]) -> list[Array]:
        """Return the velocity -h^2 grad p around and along, then its derivatives over both in radii."""
        (t, z, tt, tz, zz), h, s, grown = p, self.h**2, self.s, 2.0 * self.h * self.h_t
        around, along = -h * t, -h * z / s
        return [around, along, -(grown * t + h * tt), -h * tz / s, -(grown * z + h * tz) / s, -h * zz / s**2]

    def moved(self, k: int, p: list[Array], way: int) -> tuple[Array, Array]:
        """Return how the velocity of a unit rate along k changes as the rotor moves along x (0) or y (1)."""
        parity, by_h = (k + way) % 2, 2.0 * self.h * self.m[way]
        bent = 3.0 * self.h**2 * self.m[way] * self.step
        value, slope = self.ring[parity][:2]
        (along, along_slope, _), weight, p_t, p_z = self.axis, self.weight, *p[:2]
        load = self.s * (slope @ (bent * p_t)) @ (weight * along).T
        load += (value @ (bent * p_z)) @ (weight * along_slope).T / self.s
        change = self.slopes(parity, self._solved(parity, -load))
        h = self.h**2
        return -(by_h * p_t + h * change[0]), -(by_h * p_z + h * change[1]) / self.s

    def convection(
        self,
        k: int,
        rate: tuple[float, float],
        flows: list[list[Array]],
        moved: list[list[tuple[Array, Array]]],
    ) -> float:
        """Return the force of convection along k for a rate of the rotor that stays the same."""
        around, along, *by = (rate[0] * a + rate[1] * b for a, b in zip(*flows, strict=True))
        squeezed = 6.0 / 35.0 * (rate[0] * self.m[0] + rate[1] * self.m[1]) / self.h
        carried = (around * by[0] + along * by[1], around * by[2] + along * by[3])
        power = np.zeros_like(around)
        for axis, (own, v, convected) in enumerate(zip(flows[k], (around, along), carried, strict=False)):
            changing = sum(rate[i] * rate[j] * moved[i][j][axis] for i in range(2) for j in range(2))
            power += own * (1.2 * changing + 54.0 / 35.0 * convected - squeezed * v)
        return -0.125 / self.s**2 * self.over(self.h * power)

    def _matrix(self, parity: int) -> Array:
        """Return the quadratic form of the pressure: its flow in the film, and out of both ends."""
        value, slope, _ = self.ring[parity]
        cube = self.step * self.h[:, 0] ** 3
        lines = [(rows * self.weight) @ rows.T for rows in self.axis[:2]]
        matrix = self.s * np.kron((slope * cube) @ slope.T, lines[0])
        matrix += np.kron((value * cube) @ value.T, lines[1]) / self.s
        if math.isfinite(self.leak):
            ends = 2.0 * self.leak * np.outer(self.end, self.end)
            matrix += np.kron(self.step * value @ value.T, ends)
            if parity == 0 and self.leak == 0.0:
                matrix[0, 0] = 1.0  # of a sealed film the mean pressure is free, and has no force
        return np.asarray(matrix)

    def _solved(self, parity: int, load: Array) -> Array:
        return np.asarray(cho_solve(self.factor[parity], load.ravel()).reshape(load.shape))


def _axis(*, free_ends: bool) -> tuple[Array, list[Array], Array]:
    """Return Gauss weights along the axis, functions with two derivatives there, and their values at an end.

    They are differences of even Legendre polynomials, and a constant where the ends have a pressure.
    """
    x, weight = np.polynomial.legendre.leggauss(2 * AXIAL + 4)
    rows = np.zeros((AXIAL, 2 * AXIAL + 1))
    for j in range(AXIAL):
        rows[j, [2 * j, 2 * j + 2]] = np.array([-1.0, 1.0]) / math.sqrt(4.0 * j + 3.0)
    if free_ends:
        rows = np.vstack([np.eye(1, rows.shape[1]), rows])
    legendre = np.polynomial.legendre
    values = [np.asarray(legendre.legval(x, legendre.legder(rows.T, order)), float) for order in range(3)]
    return weight, values, np.sum(rows, axis=1)


def _harmonics(eps: float) -> int:
    """Return how many harmonics a pressure ~ 1/h^3 takes: they fall as (eps/(1 + sqrt(1 - eps^2)))^m."""
    ratio = eps / (1.0 + math.sqrt((1.0 - eps) * (1.0 + eps)))
    return int(min(MOST_HARMONICS, 10 + 1.3 * math.log(TOLERANCE) / math.log(max(ratio, 1e-3))))


# Seals at the ends of a squeeze film, by their leakage.


@quantities
@dataclass(frozen=True, kw_only=True)
class EndSeal:
    """Equal seals at both ends of a squeeze film: flow out of an end = leakage * pressure * circumference.

    The seals, not the film, decide the damping and the added mass of a sealed damper, and the leakage of a
    seal is rarely known to better than some tenths. So its uncertainty is part of every answer. An O-ring is
    tight (leakage 0); `with_springs` adds its stiffness.

    Parameters
    ----------
    leakage : float [m2/(Pa.s)]
        G_s, volume per time, circumference and pressure; 0 for a tight seal.
    uncertainty : float [1]
        Uncertainty of the leakage, relative: it may be that much larger or smaller. Below 1.

    Raises
    ------
    InputError
        If the leakage is negative or not finite, or the uncertainty not from 0 to below 1.
    """

    leakage: float
    uncertainty: float = 0.0

    def __post_init__(self) -> None:
        require_non_negative("leakage", self.leakage)
        require_non_negative("uncertainty", self.uncertainty)
        if self.uncertainty >= 1.0:
            raise InputError(f"uncertainty must be below 1, got {self.uncertainty!r}")

    @property
    def bounds(self) -> tuple[EndSeal, EndSeal]:
        """The seals with the smallest and the largest leakage within the uncertainty."""
        low, high = (self.leakage * (1.0 + sign * self.uncertainty) for sign in (-1.0, 1.0))
        return EndSeal(leakage=low), EndSeal(leakage=high)


@arguments
def gap_seal(*, height: float, length: float, viscosity: float) -> EndSeal:
    """Return the end seal that a narrow gap forms: leakage = height^3/(12 viscosity length).

    Parameters
    ----------
    height, length : float [m]
        Height and length of the gap, along the radius and along the axis.
    viscosity : float [Pa s]

    Raises
    ------
    InputError
        If a value is not positive.
    """
    for name, value in (("height", height), ("length", length), ("viscosity", viscosity)):
        require_positive(name, value)
    return EndSeal(leakage=height**3 / (12.0 * viscosity * length))


@arguments
def leak_test_seal(*, flow: float, pressure: float, radius: float, uncertainty: float = 0.0) -> EndSeal:
    """Return the end seal from a leak test: leakage = flow/(2 pi radius pressure).

    The slit at the joint of a piston ring is treated as spread over the circumference.

    Parameters
    ----------
    flow : float [m3/s]
        Flow out of one end.
    pressure : float [Pa]
        Pressure difference across the seal.
    radius : float [m]
        Radius of the film.
    uncertainty : float [1]
        Uncertainty as for an `EndSeal`.

    Raises
    ------
    InputError
        If a value breaks its rule.
    """
    require_non_negative("flow", flow)
    require_positive("pressure", pressure)
    require_positive("radius", radius)
    return EndSeal(leakage=flow / (2.0 * math.pi * radius * pressure), uncertainty=uncertainty)


@dataclass(frozen=True, eq=False)
class SealedShortFilm:
    """A short film with seals: what leaves it needs the pressure h_t L/(2 G_s) at the ends, a damping more.

    Parameters
    ----------
    film : SqueezeFilm
        The same with open ends.
    damping : float [1]
        Damping of the seals: pi c^3/(2 viscosity G_s L) in the film's units, half of that where the film
        ruptures, since the pressure at the ends has the sign of that in the film.
    """

    film: SqueezeFilm
    damping: float

    def force(self, eccentricity: Array, rate: Array) -> Array:
        """Return the force on the rotor, shape (2, ...); see `SqueezeFilm.force`."""
        return self.film.force(eccentricity, rate) - self.damping * rate

    def jacobian(self, eccentricity: Array, rate: Array) -> Array:
        """Return d force / d (eccentricity, rate), shape (2, 4, ...); see `SqueezeFilm.jacobian`."""
        found = self.film.jacobian(eccentricity, rate)
        unit = np.eye(2).reshape(2, 2, *(1,) * (eccentricity.ndim - 1))
        found[:, 2:] -= self.damping * unit
        return found
