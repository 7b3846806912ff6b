"""Hertz's contact of two bodies with different curvatures along and across the way that they roll."""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import cached_property

from ...errors import InputError, require_each, require_non_negative, require_positive
from ...inputs.si_arguments import quantities
from ..ellipse import EllipticIntegrals, curvature_ratio, elliptic_integrals


@quantities
@dataclass(frozen=True, kw_only=True)
class EllipticContact:
    """The dry elastic contact of a ball and a groove (Hertz 1881).

    The longer half-axis a of the ellipse lies across the way that the ball rolls. Load and approach obey
    load = stiffness * approach^1.5.

    Parameters
    ----------
    rolling_radius : float [m]
        Radius of the relative curvature along the way that the ball rolls, 1/rho_x; not above the other one.
    groove_radius : float [m]
        That across it, 1/rho_y: of a ball and its groove 1/(2/D - 1/r).
    combined_modulus : float [Pa]
        E', 2/E' = the sum of (1 - nu^2)/E of both bodies.

    Raises
    ------
    InputError
        If an argument is not finite and positive, or the rolling radius is above the other.
    """

    rolling_radius: float
    groove_radius: float
    combined_modulus: float

    def __post_init__(self) -> None:
        require_each(self, require_positive, "rolling_radius", "groove_radius", "combined_modulus")
        if self.rolling_radius > self.groove_radius:
            raise InputError(
                f"rolling_radius must not be above groove_radius {self.groove_radius!r}, "
                f"got {self.rolling_radius!r}"
            )

    @cached_property
    def ellipticity(self) -> float:
        """Longer over shorter axis [1], the root of rho_x/rho_y = (kappa^2 E - K)/(K - E)."""
        ratio = self.groove_radius / self.rolling_radius
        # Axes of 1 and of the whole ratio enclose it: rho_x/rho_y is between kappa and kappa^2.
        low, high = 1.0, ratio
        kappa = ratio**0.636  # Hamrock and Brewe (1983)
        for _ in range(200):
            excess = curvature_ratio(kappa) - ratio
            low, high = (low, kappa) if excess > 0.0 else (kappa, high)
            slope = 1.57 * ratio / kappa
            trial = kappa - excess / slope
            trial = trial if low < trial < high else 0.5 * (low + high)
            if abs(trial - kappa) <= 2e-16 * kappa:
                break
            kappa = trial
        return kappa

    @cached_property
    def integrals(self) -> EllipticIntegrals:
        """K and E of this ellipse."""
        return elliptic_integrals(self.ellipticity)

    @property
    def radius(self) -> float:
        """R [m], 1/R = the sum of both curvatures."""
        return 1.0 / (1.0 / self.rolling_radius + 1.0 / self.groove_radius)

    @property
    def stiffness(self) -> float:
        """Load over approach^1.5 [N/m^1.5]."""
        first, second, _ = self.integrals
        scale = math.sqrt(2.0 * second * self.radius / (9.0 * first**3))
        return math.pi * self.ellipticity * self.combined_modulus * scale

    def half_axes(self, load: float) -> tuple[float, float]:
        """Return the longer and the shorter half-axis [m] under a load [N]."""
        require_non_negative("load", load)
        kappa, second = self.ellipticity, self.integrals.second
        cube = 6.0 * second * load * self.radius / (math.pi * kappa * self.combined_modulus)
        return kappa * cube ** (1.0 / 3.0), cube ** (1.0 / 3.0)

    def friction_lever(self, load: float) -> float:
        """Return 3/8 a E(m) [m] under a load [N]: the moment of friction in pure spin, over its force."""
        return 0.375 * self.half_axes(load)[0] * self.integrals.second

    def pressure(self, load: float) -> float:
        """Return the largest pressure [Pa] under a load [N]."""
        a, b = self.half_axes(load)
        return 1.5 * load / (math.pi * a * b) if load else 0.0

    def approach(self, load: float) -> float:
        """Return the approach of both bodies [m] under a load [N]."""
        require_non_negative("load", load)
        return float((load / self.stiffness) ** (2.0 / 3.0))

    def load_at(self, pressure: float) -> float:
        """Return the load [N] under which the largest pressure [Pa] is this."""
        require_non_negative("pressure", pressure)
        return (pressure / self.pressure(1.0)) ** 3
