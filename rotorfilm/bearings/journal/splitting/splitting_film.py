"""Splitting method of Sussi & Fridman (1978) for any number of circumferential and axial functions.

Axial mode j, k = j alpha, alpha = pi R/b, of (H^3 u')' - k^2 H^3 u = g on the film's arc is solved for the
coupling function psi = (H^3 u')' by Galerkin's method,

    (k^2 K + M) b = <X g>,    (F_t, F_r) = -sum_j 96/(pi j)^2 (K b)_(sin, cos),

with K and M of `coupling`. All axial modes share the eigenvectors of K against M, so their sum is one
scalar function of each eigenvalue (`axial`), also when it runs over all modes.
"""

from __future__ import annotations

import warnings
from collections.abc import Callable
from dataclasses import dataclass, field, replace

import numpy as np

from ....errors import InputError, ValidityWarning, require_kind, warn_user
from ....inputs.si_arguments import quantities
from ....model import Array
from ...films.law import PolarFrame, PolarResponse, polar_force, polar_jacobian
from ..rupture.rupture import Basis, FilmArc, FixedArc, Rupture, attitude_of
from ..rupture.trial_integrals import (
    CouplingIntegrals,
    PairIntegrals,
    coupling_integrals,
    pair_integrals,
    whitened,
)
from .axial_sums import AxialSum, axial_sum


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
        from a slit in the bearing on, or where the pressure says: `ReynoldsArc()`, `ComplementarityArc()`.

    Raises
    ------
    InputError
        If n or m is not a positive integer.

    Warns
    -----
    ValidityWarning
        If the rupture rule is not fit for this order: an arc longer than 3.6 rad, shorter than 2 pi, without
        the constant function, and for `ReynoldsArc` n < 4.

    Notes
    -----
    On a fixed arc, n = 1 gives a damping matrix of rank one, so that no whirl threshold exists; from n = 2
    on damping is symmetric exactly.
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
        """Return this film in a mirror, y to -y; None where its arc turns with the journal."""
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
    mirrored: Callable[[], Rupture] | None = getattr(rupture, "mirrored", None)
    return None if mirrored is None else mirrored()


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


def first_order_response(pair: PairIntegrals, axial: AxialSum) -> PolarResponse:
    """Return A = (K_11, K_21)^T phi(lambda)/lambda (1, M_12/M_11), lambda = K_11/M_11, and its derivatives.

    With the single function sin gamma the source enters only through <sin g>, so A has rank one.
    """
    ratio = pair.K[:, 0, 0] / pair.M[:, 0, 0]
    gain = axial.value(ratio) / ratio
    gain_slope = (axial.slope(ratio) - gain) / ratio
    column, row = pair.K[:, :, 0], pair.M[:, 0, :] / pair.M[:, :1, 0]

    def change(dM: Array, dK: Array) -> Array:
        d_ratio = (dK[:, 0, 0] - ratio * dM[:, 0, 0]) / pair.M[:, 0, 0]
        d_row = (dM[:, 0, :] - row * dM[:, :1, 0]) / pair.M[:, :1, 0]
        by_gain = _dyad(gain_slope * d_ratio, column, row)
        return by_gain + _dyad(gain, dK[:, :, 0], row) + _dyad(gain, column, d_row)

    return PolarResponse(
        _dyad(gain, column, row), change(pair.M_chi, pair.K_chi), change(pair.M_turn, pair.K_turn)
    )


def _dyad(factor: Array, column: Array, row: Array) -> Array:
    return factor[:, None, None] * column[:, :, None] * row[:, None, :]
