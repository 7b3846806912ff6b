"""Turbulent oil films: closures, the band of transition, and heat transfer, as the mobility of a bearing.

Turbulence acts on a thin film by factors of the local Reynolds number Re_h = density |speed| R h/viscosity,

    d/dx (h^3/(k_x viscosity) dp/dx) + d/dz (h^3/(k_z viscosity) dp/dz) = (U/2) dh/dx + dh/dt,
    shear stress = tau_c viscosity U/h +- (h/2) dp/dx;  laminar k_x = k_z = 12, tau_c = 1.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import lru_cache
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from ...core.errors import InputError, require_finite, require_kind, require_positive
from ...core.inputs import quantities, require_choice
from ...core.model import Array
from .mobility import Mobility

KAPPA, SUBLAYER, TURBULENT_PRANDTL = 0.4, 10.7, 0.9
"""Of Reichardt's eddy viscosity kappa (y+ - delta tanh(y+/delta)), and of the eddies' heat [1]."""

TAYLOR = 41.2
"""Reynolds number times sqrt(c/R) from which vortices grow between cylinders, the inner one turning.

The square root of half the critical Taylor number 3390 of a narrow gap (tests/scenes/test_validity.py).
"""

TURBULENT = 1300.0
"""Reynolds number speed R c/nu above which plane Couette flow may stay turbulent; quoted up to 1450."""

WIDTH = 2.0
"""Reynolds number at the end of the band over that at its start, where a band is not given."""

TO_ONSET, CELLS, SPREAD = 160, 1024, 30.0
"""Cells of the splines below the onset, fewest in all, and where nodes without a band cease to be uniform."""

LAST = 1e5
"""Local Reynolds number to which the splines reach at least; beyond it the factors are powers of it [1]."""


def onset(radius: float, clearance: float) -> float:
    """Return the Reynolds number up to which a film is laminar [1].

    That of Taylor's vortices in the concentric film, 41.2 sqrt(radius/clearance) (Taylor 1923, doi
    10.1098/rsta.1923.0008), or of turbulence without them where that is lower. Eccentricity delays
    vortices (DiPrima & Stuart 1972), so that this is the cautious number.
    """
    return min(TAYLOR * math.sqrt(radius / clearance), TURBULENT)


# Closures: k_x, k_z and tau_c over the local Reynolds number.


def ng_pan(reynolds: Array) -> Array:
    """Return k_x, k_z and tau_c of the fit to the theory of Ng & Pan (1965), shape (3, ...)."""
    return np.stack([12.0 + 0.0136 * reynolds**0.9, 12.0 + 0.0043 * reynolds**0.96, _couette(reynolds)])


def stiffening(reynolds: float) -> float:
    """Return how much more a turbulent film resists flow along it than a laminar one, by `ng_pan` [1]."""
    return float(ng_pan(np.array(reynolds))[0]) / 12.0 - 1.0


def constantinescu(reynolds: Array) -> Array:
    """Return the same of Constantinescu's mixing length."""
    return np.stack([12.0 + 0.026 * reynolds**0.8265, 12.0 + 0.0198 * reynolds**0.741, _couette(reynolds)])


def hirs(reynolds: Array) -> Array:
    """Return the same of Hirs' bulk flow (1973), joined to laminar flow by fourth powers."""
    rise = reynolds**0.75
    return np.stack(
        [(low**4 + (k * rise) ** 4) ** 0.25 for low, k in ((12, 0.0687), (12, 0.0392), (1, 0.00981))]
    )


def _couette(reynolds: Array) -> Array:
    return 1.0 + 0.0012 * reynolds**0.94


def reichardt(reynolds: Array) -> Array:
    """Return the same by quadrature of Reichardt's eddy viscosity (1951), linear in the pressure."""
    film = eddy_film(reynolds)
    return np.stack(
        [1.0 / film.mean(film.arm**2 * film.along), 1.0 / film.mean(film.arm**2 / film.f), film.tau]
    )


CLOSURES: dict[str, Callable[[Array], Array]] = {
    "ng_pan": ng_pan,
    "constantinescu": constantinescu,
    "hirs": hirs,
    "reichardt": reichardt,
}
"""Closures by name."""

_PLACES, _WEIGHTS = np.polynomial.legendre.leggauss(48)
_ROUNDS = 80
"""Places across half the film, and rounds of its shear stress, of which each halves the error."""


class EddyFilm(NamedTuple):
    """Couette flow with Reichardt's eddy viscosity over half the gap, at local Reynolds numbers (...).

    Attributes
    ----------
    tau : ndarray, shape (...)
        tau_c, the stress over that of laminar flow.
    f, along : ndarray, shape (places, ...)
        Eddy and molecular viscosity over the latter; response of the velocity to a stress along the flow.
    arm, weights : ndarray, shape (places, ...)
        Distance from the middle over the gap, and weights of the integral over half of it.
    """

    tau: Array
    f: Array
    along: Array
    arm: Array
    weights: Array

    def mean(self, values: Array) -> Array:
        """Return the integral over the gap of what is the same on both sides of its middle."""
        return 2.0 * np.sum(self.weights * values, axis=0)


def eddy_viscosity(y: Array) -> Array:
    """Return Reichardt's eddy and molecular viscosity over the latter at y+ from a wall (1951)."""
    return np.asarray(1.0 + KAPPA * (y - SUBLAYER * np.tanh(y / SUBLAYER)))


def eddy_film(reynolds: Array) -> EddyFilm:
    """Return the film of some local Reynolds numbers: tau_c times the integral of 1/f is 1."""
    u = (0.5 * (1.0 + _PLACES)).reshape(-1, *(1,) * reynolds.ndim)
    s = 0.5 * u**3  # places crowd at the wall
    weights = 0.75 * u**2 * _WEIGHTS.reshape(u.shape)
    tau = np.ones_like(reynolds)
    for _ in range(_ROUNDS):
        y = s * np.sqrt(reynolds * tau)
        f = eddy_viscosity(y)
        tau = 0.5 / np.sum(weights * 1.0 / f, axis=0)
    along = (1.0 - KAPPA * y * np.tanh(y / SUBLAYER) ** 2 / (2.0 * f)) / f
    return EddyFilm(tau, f, along, 0.5 - s, weights)


def blend(reynolds: Array, edges: tuple[float, float] | None) -> Array:
    """Return the share of turbulence: 0 below the band, 1 above it or without one; twice differentiable."""
    if edges is None:
        return np.ones_like(reynolds)
    q = np.log(np.maximum(reynolds, edges[0]) / edges[0]) / math.log(edges[1] / edges[0])
    q = np.minimum(q, 1.0)
    return q**3 * (10.0 - 15.0 * q + 6.0 * q**2)


# The effect, and the mobility that it gives to the oil of a bearing.


@quantities
@dataclass(frozen=True, kw_only=True)
class Turbulence:
    """Turbulence of an oil film, the `turbulence` of journal and pad bearings.

    Parameters
    ----------
    closure : str
        "ng_pan", "constantinescu", "hirs", or "reichardt", the quadrature that the first two are fits of.
    band : bool or (float, float) [1]
        Local Reynolds numbers between which the film passes from laminar to turbulent; True for the `onset`
        of the bearing and twice that, False for closures at any Reynolds number. No measurement stands
        behind the band: compare the answers with and without it.
    density : float or None [kg/m3]
        Density of the oil; None for that of the bearing's oil at its temperature, and 870 without an oil.
    local : bool
        Whether each place has the factors of its own thickness. With False the film has one Reynolds number,
        that of the clearance: the force is then that of a laminar film of another viscosity and length.

    Raises
    ------
    InputError
        If the closure has no such name, or a number breaks its rule.

    Notes
    -----
    With k = 12 + b (k_t - 12), tau_c = 1 + b (tau_t - 1), b = q^3 (10 - 15 q + 6 q^2) and q = ln(Re_h/Re_1)/
    ln(Re_2/Re_1) within 0 and 1. The closures are linear in the pressure, which holds for
    h^2 |grad p| < 5 viscosity U, as in oil bearings.

    Examples
    --------
    >>> effect = Turbulence(closure="hirs")
    >>> [round(edge) for edge in effect.edges(0.25, 0.0005)]
    [921, 1843]
    """

    closure: str = "ng_pan"
    band: bool | tuple[float, float] = True
    density: float | None = None
    local: bool = True

    def __post_init__(self) -> None:
        require_kind("local", self.local, bool, "True or False")
        require_choice("closure", self.closure, CLOSURES)
        if self.density is not None:
            require_positive("density", self.density)
        if not isinstance(self.band, bool):
            band = tuple(float(edge) for edge in self.band)
            if len(band) != 2 or not 0.0 < band[0] < band[1] < math.inf:
                raise InputError(
                    f"band must be True, False or two rising Reynolds numbers, got {self.band!r}"
                )
            object.__setattr__(self, "band", band)

    def edges(self, radius: float, clearance: float) -> tuple[float, float] | None:
        """Return the Reynolds numbers of the band in a bearing of these dimensions [m]; None without one.

        Raises
        ------
        InputError
            If a dimension is not finite and positive.
        """
        require_positive("radius", radius)
        require_positive("clearance", clearance)
        if isinstance(self.band, bool):
            begins = onset(radius, clearance)
            return (begins, WIDTH * begins) if self.band else None
        return self.band

    def factors(self, reynolds: ArrayLike, radius: float, clearance: float) -> Array:
        """Return k_x, k_z and tau_c at local Reynolds numbers (...) in such a bearing [m], shape (3, ...).

        Raises
        ------
        InputError
            If a Reynolds number is not finite or negative, or a dimension is not finite and positive.
        """
        local = require_finite("reynolds", reynolds)
        if (local < 0.0).any():
            raise InputError(f"reynolds must not be negative, got {local.min():.6g}")
        return _blended(self.closure, self.edges(radius, clearance), local)

    def mobility(self, radius: float, clearance: float, density: float) -> Mobility:
        """Return the mobility of oil of a density [kg/m3] in a bearing of these dimensions [m].

        Raises
        ------
        InputError
            If the density or a dimension is not finite and positive.
        """
        require_positive("density", density)
        own = _splines(self.closure, self.edges(radius, clearance))
        return replace(own, density=self.density or density, local=self.local)


def local_reynolds(bearing: Any, speed: float, thickness: Array, viscosity: Array) -> Array:
    """Return the Reynolds number of films of a thickness and a viscosity over those of a bearing [1].

    Raises
    ------
    InputError
        If the turbulence of the bearing has one Reynolds number.
    """
    if not bearing.turbulence.local:
        raise InputError("turbulence must have local=True in films with a temperature field, got local=False")
    density = bearing.turbulence.density or bearing.film_density
    whole = density * abs(speed) * bearing.radius * bearing.clearance / bearing.film_viscosity
    return np.asarray(whole * thickness / viscosity)


def turbulent_factors(bearing: Any, speed: float, thickness: Array, viscosity: Array) -> tuple[Array, Array]:
    """Return the four factors of a `Mobility`, and their slopes over ln Re_h, at a thickness and a viscosity.

    Both are over those of a turbulent bearing; the speed is in rad/s.
    """
    local = local_reynolds(bearing, speed, thickness, viscosity)
    factors, slopes = bearing.turbulent_mobility.factors(local)
    return factors, slopes * local / factors


def is_turbulent(bearing: Any) -> bool:
    """Return whether the film of a bearing is turbulent above the onset, by it or by its mobility."""
    film = getattr(bearing, "film", None)
    mobile = (getattr(one, "mobility", None) for one in (bearing, film, getattr(film, "film", None)))
    own = any(isinstance(one, Mobility) and one.density > 0.0 for one in mobile)
    return own or getattr(bearing, "turbulence", None) is not None


def require_turbulence(turbulence: object) -> None:
    """Raise InputError unless this is a `Turbulence` or None."""
    require_kind("turbulence", turbulence, Turbulence | None, "a Turbulence, or None for laminar oil")


def _blended(closure: str, edges: tuple[float, float] | None, reynolds: Array) -> Array:
    laminar = np.array([12.0, 12.0, 1.0]).reshape(3, *(1,) * reynolds.ndim)
    return laminar + blend(reynolds, edges) * (CLOSURES[closure](reynolds) - laminar)


@lru_cache(maxsize=64)
def _splines(closure: str, edges: tuple[float, float] | None) -> Mobility:
    """Return the mobility without a density; a band begins at a node, below which the film is laminar."""
    from .map_fit import quintic_coefficients

    scale, cells = (SPREAD, CELLS) if edges is None else (edges[0], _cells(edges[0]))
    step = math.log1p(LAST / SPREAD) / CELLS if edges is None else math.log(2.0) / TO_ONSET
    nodes = scale * np.expm1(step * np.arange(cells + 1))
    k_x, k_z, tau = _blended(closure, edges, nodes)
    logarithms = np.log(np.stack([12.0 / k_x, 12.0 / k_z, np.ones_like(tau), tau], axis=1))
    coefficients = quintic_coefficients(logarithms).T
    if edges is not None:
        coefficients[:, : TO_ONSET + 5] = 0.0
    coefficients[2] = 0.0
    return Mobility(coefficients=coefficients, scale=scale, last_node=step * cells)


def _cells(scale: float) -> int:
    """Return the cells of splines whose band begins at a Reynolds number, out to `LAST`."""
    return max(CELLS, math.ceil(math.log2(1.0 + LAST / scale) * TO_ONSET))
