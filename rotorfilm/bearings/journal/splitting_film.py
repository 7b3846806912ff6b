"""Splitting method of Sussi & Fridman (1978) for any number of circumferential and axial functions.

Axial mode j, k = j alpha, alpha = pi R/b, of (H^3 u')' - k^2 H^3 u = g on the film's arc is solved for the
coupling function psi = (H^3 u')' by Galerkin's method,

    (k^2 K + M) b = <X g>,    (F_t, F_r) = -sum_j 96/(pi j)^2 (K b)_(sin, cos),

with K and M of `coupling`. All axial modes share the eigenvectors of K against M, so their sum is one
scalar function of each eigenvalue (`axial`), also when it runs over all modes.
"""

from __future__ import annotations

import math
import warnings
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field, replace

import numpy as np
from numpy.typing import ArrayLike

from ...core.errors import InputError, ValidityWarning, require_kind, warn_user
from ...core.inputs import quantities
from ...core.model import Array
from ..films.law import PolarFrame, PolarResponse, polar_force, polar_jacobian
from ..films.polar_table import polar_tables
from .complementarity import trial_functions
from .rupture import (
    Basis,
    CouplingIntegrals,
    FilmArc,
    FilmNodes,
    FixedArc,
    Rupture,
    attitude_of,
    coupling_integrals,
    film_nodes,
    gauss_legendre,
    pair_integrals,
    whitened,
)

TABULATED = 0.999
"""Eccentricity ratio at which the table of an FMU ends."""


@quantities
@dataclass(frozen=True, kw_only=True)
class SplittingFilm:
    """Splitting-method film of order (n, m).

    Parameters
    ----------
    order : tuple of int and (int or None)
        n circumferential functions (sin gamma, cos gamma, sin 2 gamma, ...) and m odd axial modes; None
        means all axial modes. (1, 1) and (2, 1) are the published first and second approximation.
    constant : bool
        Adds the function X = 1, needed by arcs longer than about 3.6 rad. On an arc of exactly 2 pi the
        film without it is periodic (a full film, no pressure imposed anywhere on the circumference); with
        it the film is cut where the arc starts.
    rupture : Rupture
        Where the film ends: `FixedArc()` as published, `RotatingArc()` for large motion, `SlitArc(slit=...)`
        from a slit in the bearing, and `ReynoldsArc()` or `ComplementarityArc()` where the pressure decides.

    Raises
    ------
    InputError
        If n or m is not a positive integer.

    Warns
    -----
    ValidityWarning
        If the rupture rule does not suit this order: an arc between 3.6 rad and 2 pi without the constant
        function, or a `ReynoldsArc` with n < 4.

    Notes
    -----
    On a fixed arc, n = 1 gives a damping matrix of rank one, so that no whirl threshold exists; from n = 2 on
    the damping matrix is exactly symmetric. A bearing on a fixed arc is a native FMU; on other arcs its FMU
    needs Python.
    """

    order: tuple[int, int | None] = (2, None)
    constant: bool = False
    rupture: Rupture = field(default_factory=FixedArc)

    def __post_init__(self) -> None:
        _require_order(self.order)
        if self.constant and self.order[0] < 2:
            raise InputError(f"order must have n >= 2 when constant is set, got {self.order!r}")
        require_kind("rupture", self.rupture, Rupture, "an arc such as FixedArc()")
        shortcoming = self.rupture.shortcoming(self.basis)
        if shortcoming:
            warn_user(shortcoming)

    @property
    def basis(self) -> Basis:
        """The circumferential functions."""
        return Basis(self.order[0], self.constant)

    def force(self, eccentricity: Array, source: Array, slenderness: float) -> Array:
        """Return the force on the journal, shape (2, ...); see `FilmLaw.force`."""
        return polar_force(lambda frame: self._response(frame, slenderness), eccentricity, source)

    def jacobian(self, eccentricity: Array, source: Array, slenderness: float) -> Array:
        """Return d force / d (eccentricity, source), shape (2, 4, ...); see `FilmLaw.jacobian`."""
        return polar_jacobian(
            lambda frame: self._response(frame, slenderness), eccentricity, source, turns=self.rupture.turns
        )

    def native(self, slenderness: float) -> tuple[str, Mapping[str, Array]] | None:
        """Return the kernel of the C library and its tables; None unless the arc is fixed."""
        if not isinstance(self.rupture, FixedArc):
            return None
        tables = polar_tables(lambda e, w: self.jacobian(e, w, slenderness), TABULATED, slenderness)
        return "polar_journal", tables

    def _response(self, frame: PolarFrame, slenderness: float) -> PolarResponse:
        n, m = self.order
        arc = self.rupture.arc(frame.chi, frame.turn, slenderness, self.basis, attitude_of(frame))
        axial = axial_sum(m, slenderness)

        def respond(arc: FilmArc) -> PolarResponse:
            if n > 2 or self.constant:
                return galerkin_response(coupling_integrals(frame.chi, arc, self.basis), axial)
            pair = pair_integrals(frame.chi, arc)
            return first_order_response(pair, axial) if n == 1 else galerkin_response(whitened(pair), axial)

        return response_on(arc, respond)

    def mirrored(self) -> SplittingFilm | None:
        """Return the mirror image of this film (y to -y); None where its arc turns with the journal."""
        image = mirror_image(self.rupture)
        if image is None:
            return None
        with warnings.catch_warnings(action="ignore", category=ValidityWarning):
            return replace(self, rupture=image)


def response_on(arc: FilmArc, respond: Callable[[FilmArc], PolarResponse]) -> PolarResponse:
    """Return the response of a film on an arc, by the attitude too where that moves the arc."""
    found, attitude = respond(arc), arc.by_attitude
    return found if attitude is None else found._replace(A_attitude=respond(attitude).A_turn)


def mirror_image(rupture: Rupture) -> Rupture | None:
    """Return a rule for the ends of a film in a mirror, y to -y; None where it is its own image."""
    image: Callable[[], Rupture] | None = getattr(rupture, "in_mirror", None)
    return None if image is None else image()


def _require_order(order: object) -> None:
    match order:
        case (int() as n, int() | None as m) if n >= 1 and (m is None or m >= 1):
            if not isinstance(n, bool) and not isinstance(m, bool):
                return
    raise InputError(f"order must be (n, m) of positive integers, m may be None, got {order!r}")


def galerkin_response(integrals: CouplingIntegrals, axial: AxialSum) -> PolarResponse:
    """Return A = E^T M^(1/2) phi(M^(-1/2) K M^(-1/2)) M^(1/2) E and its derivatives.

    E holds the coordinates of (sin, cos). In the eigenvectors of K, where M = 1, perturbations dK and dM
    change the matrix function by phi[l_i, l_j] (dK - dM (l_i + l_j)/2) + dM (phi_i + phi_j)/2.
    """
    eigenvalues, vectors = np.linalg.eigh(integrals.K)
    ratio = np.maximum(eigenvalues, np.finfo(float).tiny)
    P = vectors.swapaxes(-1, -2) @ integrals.source
    phi, divided = axial.value(ratio), axial.divided(ratio)
    mean_ratio = 0.5 * (ratio[:, :, None] + ratio[:, None, :])
    mean_phi = 0.5 * (phi[:, :, None] + phi[:, None, :])

    def change(dM: Array, dK: Array) -> Array:
        dM, dK = (vectors.swapaxes(-1, -2) @ matrix @ vectors for matrix in (dM, dK))
        return P.swapaxes(-1, -2) @ (divided * (dK - mean_ratio * dM) + mean_phi * dM) @ P

    return PolarResponse(
        P.swapaxes(-1, -2) @ (phi[:, :, None] * P),
        change(integrals.M_chi, integrals.K_chi),
        change(integrals.M_turn, integrals.K_turn),
    )


def first_order_response(pair: CouplingIntegrals, axial: AxialSum) -> PolarResponse:
    """Return A = (K_11, K_21)^T phi(lambda)/lambda (1, M_12/M_11), lambda = K_11/M_11, and its derivatives.

    With the single function sin gamma the source enters only through <sin g>, so A has rank one.
    """
    M = pair.source
    ratio = pair.K[:, 0, 0] / M[:, 0, 0]
    gain = axial.value(ratio) / ratio
    gain_slope = (axial.slope(ratio) - gain) / ratio
    column, row = pair.K[:, :, 0], M[:, 0, :] / M[:, :1, 0]

    def change(dM: Array, dK: Array) -> Array:
        d_ratio = (dK[:, 0, 0] - ratio * dM[:, 0, 0]) / M[:, 0, 0]
        d_row = (dM[:, 0, :] - row * dM[:, :1, 0]) / M[:, :1, 0]
        by_gain = _dyad(gain_slope * d_ratio, column, row)
        return by_gain + _dyad(gain, dK[:, :, 0], row) + _dyad(gain, column, d_row)

    return PolarResponse(
        _dyad(gain, column, row), change(pair.M_chi, pair.K_chi), change(pair.M_turn, pair.K_turn)
    )


def _dyad(factor: Array, column: Array, row: Array) -> Array:
    return factor[:, None, None] * column[:, :, None] * row[:, None, :]


# First and second approximation for the film [0, pi] in the closed form of Sussi & Fridman (1978).
#
# The formulas are the paper's with its misprints corrected (docs/journal.md lists them); they equal
# `SplittingFilm(order=(1, 1))` and `SplittingFilm(order=(2, m))` on `FixedArc()`. Forces are in units of
# viscosity * length * radius^3 / clearance^2 with rates and speed in rad/s; alpha = pi R/b = (pi/2)/(L/D).


def load_function(chi: ArrayLike, slenderness: float) -> Array:
    """Return f(chi), the static radial force of the first approximation per speed [1], negative.

    Sussi & Fridman (1978), last display before (38). The print multiplies by the bracket that divides.
    """
    chi = np.asarray(chi, dtype=float)
    alpha2 = (0.5 * math.pi / slenderness) ** 2
    s2 = (1.0 - chi) * (1.0 + chi)
    return -96.0 / math.pi**2 * chi**2 / (s2 * (2.0 + chi**2 + 2.0 * alpha2 * s2))


def first_approximation(
    chi: ArrayLike, chi_rate: ArrayLike, phi_rate: ArrayLike, speed: ArrayLike, slenderness: float
) -> tuple[Array, Array]:
    """Return the radial and tangential force P1*, P2* on the journal (order (1, 1), film [0, pi]).

    Parameters
    ----------
    chi : array_like, shape (...) [1]
        Eccentricity ratio, 0 < chi < 1.
    chi_rate, phi_rate : array_like, shape (...) [1/s]
        Rates of the eccentricity ratio and of the attitude angle.
    speed : array_like, shape (...) [rad/s]
        Angular speed of the journal.
    slenderness : float [1]
        Length / diameter.

    Returns
    -------
    radial, tangential : ndarray, shape (...) [viscosity length radius^3 / clearance^2]
        Outward along the line of centers, and 90 degrees ahead.
    """
    chi = np.asarray(chi, dtype=float)
    s = np.sqrt((1.0 - chi) * (1.0 + chi))
    drive = np.asarray(speed) - 2.0 * np.asarray(phi_rate) + 8.0 / math.pi * np.asarray(chi_rate) / s
    radial = load_function(chi, slenderness) * drive
    return radial, -0.5 * math.pi * s / chi * radial


def first_approximation_slopes(chi: ArrayLike, slenderness: float) -> tuple[Array, Array]:
    """Return c11* = dP1*/dchi and c21* = dP2*/dchi of the static first approximation, per speed [1].

    The printed c11* is too small by the factor 2 alpha^2; c21* lost the term d(s/chi)/dchi.
    """
    chi = np.asarray(chi, dtype=float)
    f = load_function(chi, slenderness)
    alpha2 = (0.5 * math.pi / slenderness) ** 2
    s = np.sqrt((1.0 - chi) * (1.0 + chi))
    c11 = -(math.pi**2) / 48.0 * f**2 / chi**3 * (2.0 * alpha2 * (1.0 - chi**4) + 2.0 + chi**4)
    c21 = -0.5 * math.pi * s / chi * c11 + 0.5 * math.pi * f / (chi**2 * s)
    return c11, c21


def second_approximation(chi: float, g_s: float, g_c: float, slenderness: float, modes: int | None) -> Array:
    """Return (radial, tangential) force of order (2, modes) for the film [0, pi], shape (2,).

    Parameters
    ----------
    chi : float [1]
        Eccentricity ratio, 0 <= chi < 1.
    g_s, g_c : float [1/s]
        chi (phi_rate - speed/2) and chi_rate.
    slenderness : float [1]
        Length / diameter.
    modes : int or None
        Number of odd axial modes; None sums all of them.

    Notes
    -----
    (F_t, F_r) = -sum_j 96/(pi j)^2 (K^-1 + (j alpha)^2 M^-1)^-1 (g_s, g_c): the harmonic sum of the long
    bearing (K) and the short bearing (M), exact in both limits.
    """
    K, M = _half_circle_matrices(chi)
    # Symmetric matrices, one definite: real, though numpy 2.5 says so by complex numbers.
    ratio, vectors = (part.real for part in np.linalg.eig(np.linalg.solve(M, K)))
    phi = axial_sum(modes, slenderness).value(ratio.real)
    tangential, radial = -M @ (vectors * phi) @ np.linalg.solve(vectors, np.array([g_s, g_c]))
    return np.array([radial, tangential])


def _half_circle_matrices(chi: float) -> tuple[Array, Array]:
    """Return K and M of (sin, cos) over [0, pi]."""
    s2 = (1.0 - chi) * (1.0 + chi)
    s, q = math.sqrt(s2), 2.0 + chi**2
    K_sc, M_sc = -2.0 * chi / (s2 * q), -2.0 * chi / s2**2
    K = np.array([[math.pi / (s * q), K_sc], [K_sc, (0.5 * math.pi - 8.0 / (math.pi * q)) / s**3]])
    M = np.array([[0.5 * math.pi / s**3, M_sc], [M_sc, 0.5 * math.pi * (1.0 + 2.0 * chi**2) / s**5]])
    return K, M


# Reynolds equation on a given arc, solved to convergence: the reference of the splitting method.
#
# The splitting method is a Galerkin method for the flux; this one is a Ritz method for the pressure,
# so the two share nothing but the equation. Every axial mode j of (H^3 u')' - k_j^2 H^3 u = g has the
# same circumferential eigenfunctions, -(H^3 f')' = l H^3 f with f = 0 at both ends. With r = 1/l and
# the axial sum phi of `axial`
#
# (F_t, F_r) = -sum_m phi(r_m) <(sin, cos), f_m> <f_m, g>
#
# sums all axial modes in closed form. Trial functions are integrated Legendre polynomials in the
# elliptic variable of `elliptic`, times H^(-7/4).


BASIS = Basis(16, constant=True)
"""What a rupture rule is told that asks for the coupling functions: as good as converged."""

EXTRA_NODES = 32
"""Quadrature nodes beyond the degree, enough for the rational coefficients."""


@quantities
@dataclass(frozen=True, kw_only=True)
class SpectralArcFilm:
    """Converged film on a prescribed arc, all axial modes: what `SplittingFilm` approximates.

    Parameters
    ----------
    rupture : Rupture
        Where the film ends.
    degree : int
        Number of circumferential trial functions: 16 converges to 2e-7 at eccentricity ratios to 0.99,
        24 to 4e-8 and 48 to 2e-10 at ratios to 0.9999.

    Raises
    ------
    InputError
        If the degree is not an integer >= 2.
    """

    rupture: Rupture = field(default_factory=FixedArc)
    degree: int = 48

    def __post_init__(self) -> None:
        if not isinstance(self.degree, int) or self.degree < 2:
            raise InputError(f"degree must be an integer >= 2, got {self.degree!r}")
        require_kind("rupture", self.rupture, Rupture, "an arc such as FixedArc()")

    def force(self, eccentricity: Array, source: Array, slenderness: float) -> Array:
        """Return the force on the journal, shape (2, ...); see `FilmLaw.force`."""
        return polar_force(lambda frame: self._response(frame, slenderness), eccentricity, source, chunk=1)

    def jacobian(self, eccentricity: Array, source: Array, slenderness: float) -> Array:
        """Return d force / d (eccentricity, source), shape (2, 4, ...); see `FilmLaw.jacobian`."""
        return polar_jacobian(
            lambda frame: self._response(frame, slenderness),
            eccentricity,
            source,
            turns=self.rupture.turns,
            chunk=1,
        )

    def _response(self, frame: PolarFrame, slenderness: float) -> PolarResponse:
        arc = self.rupture.arc(frame.chi, frame.turn, slenderness, BASIS, attitude_of(frame))
        nodes, axial = (
            film_nodes(frame.chi, arc.start, arc.end, self.degree + EXTRA_NODES),
            FullAxialSum(slenderness),
        )
        return response_on(arc, lambda one: spectral_response(nodes, one, frame.chi[0], self.degree, axial))

    def mirrored(self) -> SpectralArcFilm | None:
        """Return the mirror image of this film (y to -y); None where its arc turns with the journal."""
        image = mirror_image(self.rupture)
        return None if image is None else replace(self, rupture=image)


def spectral_response(
    nodes: FilmNodes, arc: FilmArc, chi: float, degree: int, axial: FullAxialSum
) -> PolarResponse:
    """Return A and its derivatives, each of shape (1, 2, 2), from the eigenpairs of one arc.

    The chi-derivative changes the weight H^3 by 3 cos gamma / H.

    Ends that move take the trial functions with them, at a rate v that is linear in gamma. Then the weights
    of f'^2 and f^2 change by H^3 v d(log H^3)/dgamma -+ H^3 v', and (sin, cos) by the derivative of
    v (sin, cos).
    """
    dgamma = nodes.weight[0] * nodes.film[0] ** 3
    f, slope = trial_functions(degree, nodes.gamma.shape[1])
    slope = slope * (gauss_legendre(nodes.gamma.shape[1])[1] / dgamma)[:, None]
    sine, cosine = 2.0 * nodes.half_sine[0] * nodes.half_cosine[0], nodes.cosine[0]
    f, slope = _balanced(f, slope, nodes.film[0], chi * sine)
    heft = (dgamma * nodes.film[0] ** 3)[:, None]
    eigenvalues, vectors = _generalized_eigen(slope.T @ (heft * slope), f.T @ (heft * f))
    f, slope = f @ vectors, slope @ vectors
    circular, quarter = np.stack([sine, cosine], -1), np.stack([cosine, -sine], -1)
    source = f.T @ (dgamma[:, None] * circular)
    ratio = 1.0 / eigenvalues
    phi = axial.value(ratio)
    divided = -axial.divided(ratio[None])[0] * ratio[:, None] * ratio
    along = (nodes.gamma[0] - arc.start) / (arc.end - arc.start)

    def change(log_slope: Array, start_rate: Array, end_rate: Array) -> Array:
        rate, stretch = (
            start_rate + (end_rate - start_rate) * along,
            (end_rate - start_rate) / (arc.end - arc.start),
        )
        log_slope = log_slope - 3.0 * chi * rate * sine / nodes.film[0]
        dK = slope.T @ (heft * (log_slope - stretch)[:, None] * slope)
        dM = f.T @ (heft * (log_slope + stretch)[:, None] * f)
        mean = 0.5 * (eigenvalues[:, None] + eigenvalues)
        response = divided * (dK - mean * dM) - 0.5 * dM * (phi[:, None] + phi)
        d_source = f.T @ (dgamma[:, None] * (rate[:, None] * quarter + stretch * circular))
        by_source = source.T @ (phi[:, None] * d_source)
        return source.T @ response @ source + by_source + by_source.T

    A_chi = change(3.0 * cosine / nodes.film[0], arc.start_chi, arc.end_chi)
    A_turn = change(np.zeros_like(sine), arc.start_turn, arc.end_turn)
    return PolarResponse((source.T @ (phi[:, None] * source))[None], A_chi[None], A_turn[None])


def _balanced(f: Array, slope: Array, film: Array, chi_sine: Array) -> tuple[Array, Array]:
    """Return the trial functions times H^(-7/4), under which the mass matrix has no preferred place.

    Without it H^3 spans twelve decades at chi = 0.9999, more than a factorization survives.
    """
    scale = (film**-1.75)[:, None]
    return f * scale, (slope + f * (1.75 * chi_sine / film)[:, None]) * scale


def _generalized_eigen(K: Array, M: Array) -> tuple[Array, Array]:
    """Return eigenvalues and M-orthonormal eigenvectors of K v = l M v."""
    inverse = np.linalg.inv(np.linalg.cholesky(M))
    eigenvalues, vectors = np.linalg.eigh(inverse @ K @ inverse.T)
    return eigenvalues, inverse.T @ vectors


# The sum over odd axial modes: one scalar function of the ratio lambda = stiffness / mass of a mode.
#
# With k_j = j pi R / b and the axial factor 96/(pi j)^2 of mode j = 1, 3, 5, ..., a circumferential
# eigenmode of ratio lambda contributes
#
#     phi(lambda) = sum_j 96/(pi j)^2 lambda/(1 + k_j^2 lambda),
#
# and, over all odd modes, phi = 12 lambda (1 - tanh(z)/z) with z = (L/D)/sqrt(lambda).


SERIES = 0.05
"""Below this z the closed form of 1 - tanh(z)/z cancels, and its Taylor series is exact to roundoff."""

COALESCENCE = 1e-5
"""Relative gap below which a divided difference is taken as the derivative at the midpoint."""


class FiniteAxialSum:
    """The sum over the first `modes` odd axial modes."""

    def __init__(self, modes: int, slenderness: float) -> None:
        j = 2.0 * np.arange(modes) + 1.0
        self._factor = 96.0 / (math.pi * j) ** 2
        self._k2 = (j * 0.5 * math.pi / slenderness) ** 2

    def value(self, ratio: Array) -> Array:
        """Return phi(ratio)."""
        x = ratio[..., None]
        return np.sum(self._factor * x / (1.0 + self._k2 * x), axis=-1)

    def slope(self, ratio: Array) -> Array:
        """Return d phi / d ratio."""
        return np.sum(self._factor / (1.0 + self._k2 * ratio[..., None]) ** 2, axis=-1)

    def divided(self, ratio: Array) -> Array:
        """Return phi[lambda_i, lambda_j], free of cancellation."""
        damped = 1.0 / (1.0 + self._k2 * ratio[..., None])
        return np.einsum("k,bik,bjk->bij", self._factor, damped, damped)


class FullAxialSum:
    """The sum over all odd axial modes, in closed form."""

    def __init__(self, slenderness: float) -> None:
        self._slenderness = slenderness

    def value(self, ratio: Array) -> Array:
        """Return phi(ratio)."""
        return 12.0 * ratio * one_minus_tanh_ratio(self._slenderness / np.sqrt(ratio))

    def slope(self, ratio: Array) -> Array:
        """Return d phi / d ratio = 12 (1 - tanh(z)/z - (z/2) d/dz(1 - tanh(z)/z))."""
        z = self._slenderness / np.sqrt(ratio)
        small = z < SERIES
        safe = np.where(small, 1.0, z)
        closed = 1.0 - 1.5 * np.tanh(safe) / safe + 0.5 / np.cosh(np.minimum(safe, 300.0)) ** 2
        near = np.where(small, z, 0.0) ** 2
        series = near**2 * (2.0 / 15.0 - near * (34.0 / 315.0 - near * 62.0 / 945.0))
        return 12.0 * np.where(small, series, closed)

    def divided(self, ratio: Array) -> Array:
        """Return phi[lambda_i, lambda_j], the derivative where the two nearly coincide."""
        first, second = ratio[:, :, None], ratio[:, None, :]
        middle = 0.5 * (first + second)
        gap = first - second
        close = np.abs(gap) < COALESCENCE * middle
        value = self.value(ratio)
        rise = value[:, :, None] - value[:, None, :]
        return np.where(close, self.slope(middle), rise / np.where(close, 1.0, gap))


AxialSum = FiniteAxialSum | FullAxialSum
"""A function phi of lambda with its derivative and its first divided difference."""


def axial_sum(modes: int | None, slenderness: float) -> AxialSum:
    """Return the sum over `modes` odd axial modes, or over all of them for None."""
    return FullAxialSum(slenderness) if modes is None else FiniteAxialSum(modes, slenderness)


def one_minus_tanh_ratio(z: Array) -> Array:
    """Return 1 - tanh(z)/z to roundoff for every z > 0."""
    small = z < SERIES
    safe = np.where(small, 1.0, z)
    near = np.where(small, z, 0.0) ** 2
    series = near * (1.0 / 3.0 - near * (2.0 / 15.0 - near * (17.0 / 315.0 - near * 62.0 / 2835.0)))
    return np.where(small, series, 1.0 - np.tanh(safe) / safe)
