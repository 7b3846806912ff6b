"""Reynolds equation on a given arc, solved to convergence: the reference of the splitting method.

The splitting method is a Galerkin method for the flux; this one is a Ritz method for the pressure, so the
two share nothing but the equation. Every axial mode j of (H^3 u')' - k_j^2 H^3 u = g has the same
circumferential eigenfunctions, -(H^3 f')' = l H^3 f with f = 0 at both ends. With r = 1/l and the axial sum
phi of `axial`

    (F_t, F_r) = -sum_m phi(r_m) <(sin, cos), f_m> <f_m, g>

sums all axial modes in closed form. Trial functions are integrated Legendre polynomials in the elliptic
variable of `elliptic`, times H^(-7/4).
"""

from __future__ import annotations

from dataclasses import dataclass, field, replace

import numpy as np

from ....errors import InputError, require_kind
from ....inputs.si_arguments import quantities
from ....model import Array
from ...films.law import PolarFrame, PolarResponse, polar_force, polar_jacobian
from ...films.legendre import gauss_weights, trial_functions
from ..rupture.elliptic import FilmNodes, film_nodes
from ..rupture.rupture import Basis, FilmArc, FixedArc, Rupture, attitude_of
from .axial_sums import FullAxialSum
from .splitting_film import mirror_image, response_on

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
        """Return this film in a mirror, y to -y; None where its arc turns with the journal."""
        image = mirror_image(self.rupture)
        return None if image is None else replace(self, rupture=image)


def spectral_response(
    nodes: FilmNodes, arc: FilmArc, chi: float, degree: int, axial: FullAxialSum
) -> PolarResponse:
    """Return A and its derivatives, each of shape (1, 2, 2), from the eigenpairs of one arc.

    The chi-derivative changes the weight H^3 by 3 cos gamma / H. Ends that move take the trial functions with
    them, at a rate v linear in gamma: then H^3 v d(log H^3)/dgamma -+ H^3 v' is the change of the weights of
    f'^2 and f^2, and (sin, cos) changes by its derivative of v (sin, cos).
    """
    dgamma = nodes.weight[0] * nodes.film[0] ** 3
    f, slope = trial_functions(degree, nodes.gamma.shape[1])
    slope = slope * (gauss_weights(nodes.gamma.shape[1]) / dgamma)[:, None]
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
