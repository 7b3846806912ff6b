"""Steady heat and contact of a bush that may melt: contact angle and temperature of one state, derivatives.

Evtushenko & Kovalenko (1993), (1.2), (2.16), (2.17). The source keeps the contact at the melting point; here
it is colder while friction heat does not suffice. Plain numbers in, plain numbers out: the inner loop of
`bearings.bush_wear`.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import cache
from typing import NamedTuple, Protocol, runtime_checkable

import numpy as np
from numpy.typing import ArrayLike
from scipy.special import i0e, i1e, jv

from ...core.errors import ConvergenceError, warn_user
from ...core.model import Array
from . import contact_arc as arc

# Where the friction heat of a bush goes: into the shaft, into the liner, and how the two are balanced.
#
# Small exchangeable rules with their derivatives; `bearings.bush.MeltingBush` takes one of each kind.


COOLING_LIMIT = 0.3
"""Largest kappa_1 R_1/lambda_1 that the source has its closed form in mind for."""


@dataclass(frozen=True)
class ExactShaft:
    """The heat flux Q_1 from the mixed problem (2.7)-(2.8) itself, with an error of 1e-7."""

    def flux(self, cooling: float, stubbiness: float) -> float:
        """Return Q_1 in units of lambda_1 T_*/R_1; cooling is kappa_1 R_1/lambda_1 and stubbiness R_1/l."""
        return exact_flux(cooling, stubbiness)


@dataclass(frozen=True)
class ApproximateShaft:
    """The heat flux Q_1 by the published closed form (2.13), 0.6 to 2.9 % too high at cooling 0.02 to 0.3."""

    def flux(self, cooling: float, stubbiness: float) -> float:
        """Return the flux Q_1 in units of lambda_1 T_*/R_1; warn beyond the `COOLING_LIMIT` of the source."""
        if cooling > COOLING_LIMIT:
            warn_user(
                f"air_transfer shaft_radius / conductivity must not exceed {COOLING_LIMIT} for "
                f"ApproximateShaft, got {cooling:.6g}: the heat into the shaft is too high",
            )
        return approximate_flux(cooling, stubbiness)


ShaftHeat = ExactShaft | ApproximateShaft
"""How the mean flux Q_1 into the shaft is computed."""


@runtime_checkable
class HeatBalance(Protocol):
    """How much of Q_1 the heat made per unit of contact area has to supply."""

    def share(self, alpha: ArrayLike) -> Array:
        """Return the factor of Q_1 in the balance over the contact, half angle alpha [rad]."""

    def share_slope(self, alpha: ArrayLike) -> Array:
        """Return d(share)/d(alpha) [1/rad]."""


@dataclass(frozen=True)
class ContactBalance:
    """Heat per area of contact = Q_1 + Q_2 + melting, as published (1.2).

    Q_1 is a flux through the whole circumference of the shaft, but friction heats the arc 2 alpha only. So in
    this balance the shaft takes only the share alpha/pi of the heat that its temperature field requires.
    """

    def share(self, alpha: ArrayLike) -> Array:
        """Return the factor by which the heat flux Q_1 enters the balance; it is 1 here."""
        return np.ones_like(np.asarray(alpha, dtype=float))

    def share_slope(self, alpha: ArrayLike) -> Array:
        """Return the derivative of `share` by alpha [1/rad]; it is 0 here."""
        return np.zeros_like(np.asarray(alpha, dtype=float))


@dataclass(frozen=True)
class GlobalBalance:
    """Heat made on the arc 2 alpha = Q_1 over the whole circumference + Q_2 and melting over the arc.

    Energy is then conserved over the whole shaft; critical speeds are several times higher than published.
    """

    def share(self, alpha: ArrayLike) -> Array:
        """Return the share of Q_1 in the balance over the whole shaft, pi/alpha [1]."""
        return math.pi / np.asarray(alpha, dtype=float)

    def share_slope(self, alpha: ArrayLike) -> Array:
        """Return the derivative of `share` by alpha, -pi/alpha^2 [1/rad]."""
        return -math.pi / np.asarray(alpha, dtype=float) ** 2


# Steady heat and contact of a bush that may melt: contact angle and temperature of one state, derivatives.


MAX_ITERATIONS = 200
"""Steps of the safeguarded Newton method; bisection alone would need about 60."""


class MeltingContact(NamedTuple):
    """The contact that belongs to a wear moment, a load and a speed.

    Attributes
    ----------
    alpha : float [rad]
        Half the contact angle.
    temperature : float [K]
        Above ambient.
    melting : bool
        Whether friction heat suffices to hold the contact at the melting point.
    """

    alpha: float
    temperature: float
    melting: bool


class MeltingLaw(NamedTuple):
    """The numbers of a bush that its thermal contact depends on.

    Attributes
    ----------
    clearance, closing, compliance : float [1], [1/K], [1]
        Clearance, closing and compliance per liner radius: cold clearance, thermal closing per kelvin, and
        a_1.
    pressure_work : float [N/m]
        G R_1: friction heat per contact area for unit pressure, friction coefficient and speed.
    shaft, liner : float [W/(m2 K)]
        Conductances, Q_1/T_* and that of the liner.
    melting : float [K]
        T_*.
    friction : tuple of three floats
        f0, f1, f2.
    outer : tuple of two floats [K]
        D_0, D_1.
    balance : HeatBalance
    """

    clearance: float
    closing: float
    compliance: float
    pressure_work: float
    shaft: float
    liner: float
    melting: float
    friction: tuple[float, float, float]
    outer: tuple[float, float]
    balance: HeatBalance

    def gap(self, temperature: float) -> float:
        """Return the clearance c(T) per liner radius."""
        return self.clearance - self.closing * temperature

    def coefficient(self, temperature: float) -> float:
        """Return the coefficient of friction f(T)."""
        f0, f1, f2 = self.friction
        return f0 + temperature * (f1 + temperature * f2)

    def coefficient_slope(self, temperature: float) -> float:
        """Return df/dT [1/K]."""
        return self.friction[1] + 2.0 * self.friction[2] * temperature

    def conductance(self, alpha: float) -> float:
        """Return the heat per contact area and kelvin that shaft and liner take [W/(m2 K)]."""
        return float(self.balance.share(alpha)) * self.shaft + self.liner

    def outer_temperature(self, alpha: float) -> float:
        """Return the mean temperature of the liner's outer surface over the contact [K]."""
        return self.outer[0] + self.outer[1] * float(arc.sinc(alpha))

    def losses(self, alpha: float, temperature: float | None = None) -> float:
        """Return the heat per contact area that shaft and liner take, by default at T_* [W/m2]."""
        contact = self.melting if temperature is None else temperature
        return self.conductance(alpha) * contact - self.liner * self.outer_temperature(alpha)

    def sliding(self, alpha: float, load_ratio: float, speed: float) -> float:
        """Return the friction heat per contact area for a friction coefficient of one [W/m2]."""
        return self.pressure_work * abs(speed) * load_ratio * float(arc.mean_weight(alpha))

    def steady_temperature(self, alpha: float, load_ratio: float, speed: float) -> float:
        """Return the temperature at which friction heat equals the losses [K]; inf if it runs away.

        conductance T = sliding f(T) + liner outer_temperature: of the two roots of this quadratic equation
        the lower one, which a contact that warms up from ambient temperature reaches and keeps.
        """
        f0, f1, f2 = self.friction
        sliding = self.sliding(alpha, load_ratio, speed)
        source = sliding * f0 + self.liner * self.outer_temperature(alpha)
        linear = self.conductance(alpha) - sliding * f1
        discriminant = linear * linear - 4.0 * sliding * f2 * source
        denominator = linear + math.sqrt(max(discriminant, 0.0))
        return math.inf if discriminant < 0.0 or denominator <= 0.0 else 2.0 * source / denominator

    def hot_angle(self, moment: float, load_ratio: float) -> float:
        """Return half the contact angle [rad] at the melting point, the widest there can be."""
        return float(arc.arc_angle((self.compliance * load_ratio + moment) / self.gap(self.melting)))

    def contact(self, moment: float, load_ratio: float, speed: float) -> MeltingContact:
        """Return the contact for a wear moment W, a load N and a speed [rad/s].

        Raises
        ------
        ConvergenceError
            If no steady contact exists: where friction rises steeply with temperature, a contact at the
            brink of thermal runaway jumps to the melting point and back.
        """
        alpha = self.hot_angle(moment, load_ratio)
        if alpha == 0.0:
            # No contact, as in the limit of no load: there is no friction heat.
            return MeltingContact(0.0, self._idle_temperature(), False)
        if self.steady_temperature(alpha, load_ratio, speed) >= self.melting:
            return MeltingContact(alpha, self.melting, True)
        alpha = self._cold_angle(moment, load_ratio, speed, alpha)
        return MeltingContact(alpha, self.steady_temperature(alpha, load_ratio, speed), False)

    def excess(self, moment: float, load_ratio: float, speed: float) -> float:
        """Return by how much the steady temperature is above the melting point [K], at most T_* itself."""
        alpha = self.hot_angle(moment, load_ratio)
        steady = (
            self.steady_temperature(alpha, load_ratio, speed) if alpha > 0.0 else self._idle_temperature()
        )
        return min(steady - self.melting, self.melting)

    def surplus(self, at: MeltingContact, load_ratio: float, speed: float) -> float:
        """Return the heat per contact area that melts the liner [W/m2], not negative."""
        if not at.melting:
            return 0.0
        heat = self.sliding(at.alpha, load_ratio, speed) * self.coefficient(self.melting)
        return max(heat - self.losses(at.alpha), 0.0)

    def _idle_temperature(self) -> float:
        return self.liner * self.outer_temperature(0.0) / (self.shaft + self.liner)

    def _cold_angle(self, moment: float, load_ratio: float, speed: float, hot: float) -> float:
        """Return the root of c(T(alpha)) F(alpha) = a_1 N + W below the angle `hot`, where it is positive.

        The residual rises with alpha, because a wider contact is colder: Newton's method between bounds.
        """
        lifted = self.compliance * load_ratio + moment
        low, high, alpha = 0.0, hot, hot
        for _ in range(MAX_ITERATIONS):
            temperature = min(self.steady_temperature(alpha, load_ratio, speed), self.melting)
            residual = self.gap(temperature) * float(arc.arc_function(alpha)) - lifted
            if abs(residual) <= 1e-15 * lifted or high - low <= 2.0 * math.ulp(high):
                return self._checked(alpha, residual, lifted)
            low, high = (alpha, high) if residual < 0.0 else (low, alpha)
            by_alpha, _, slope = self._residual_slopes(alpha, temperature, load_ratio, speed)
            trial = alpha - residual / (by_alpha + slope)
            alpha = trial if low < trial < high else 0.5 * (low + high)
        return self._checked(alpha, residual, lifted)

    def _checked(self, alpha: float, residual: float, lifted: float) -> float:
        if abs(residual) > 1e-9 * lifted:
            raise ConvergenceError(
                f"contact must be steady, got one at the brink of thermal runaway at {alpha:.6g} rad", alpha
            )
        return alpha

    def _residual_slopes(
        self, alpha: float, temperature: float, load_ratio: float, speed: float
    ) -> tuple[float, float, float]:
        """Return d(c F)/dalpha at fixed T, d(c F)/dT, and the part of d(c F)/dalpha that comes through T."""
        by_alpha = self.gap(temperature) * float(arc.arc_slope(alpha))
        by_temperature = -self.closing * float(arc.arc_function(alpha))
        heat = self.heat_slopes(alpha, temperature, load_ratio, speed)
        return by_alpha, by_temperature, -by_temperature * heat[0] / heat[1]

    def heat_slopes(
        self, alpha: float, temperature: float, load_ratio: float, speed: float
    ) -> tuple[float, float, float, float]:
        """Return the derivatives of (losses - friction heat) by alpha, T, N and |speed|."""
        weight, slope = float(arc.mean_weight(alpha)), float(arc.mean_weight_slope(alpha))
        friction = self.coefficient(temperature)
        unit = self.pressure_work * friction
        rate = abs(speed)
        by_alpha = (
            float(self.balance.share_slope(alpha)) * self.shaft * temperature
            - unit * rate * load_ratio * slope
            - self.liner * self.outer[1] * float(arc.sinc_slope(alpha))
        )
        by_temperature = self.conductance(alpha) - self.pressure_work * rate * load_ratio * (
            weight * self.coefficient_slope(temperature)
        )
        return by_alpha, by_temperature, -unit * rate * weight, -unit * load_ratio * weight

    def contact_slopes(self, at: MeltingContact, load_ratio: float, speed: float) -> Array:
        """Return d(alpha, T)/d(W, N, |speed|), shape (2, 3), at a contact with alpha > 0."""
        by_alpha, by_temperature, _ = self._residual_slopes(*at[:2], load_ratio, speed)
        balance = np.array([[by_alpha, by_temperature], [0.0, 1.0]])
        right = np.array([[1.0, self.compliance, 0.0], [0.0, 0.0, 0.0]])
        if not at.melting:
            heat = self.heat_slopes(*at[:2], load_ratio, speed)
            balance[1], right[1, 1:] = heat[:2], [-heat[2], -heat[3]]
        return np.linalg.solve(balance, right)


# Steady heat flow from a bush into an endless rotating shaft that the air cools outside the bush.
#
# The mixed problem (2.7)-(2.8) of Evtushenko & Kovalenko (1993): temperature T_* on |z| < l of the shaft's
# surface, dT/dr + (lambda/R_1) T = 0 outside. Without dimensions it has two numbers, `cooling` lambda =
# kappa_1 R_1/lambda_1 (the Biot number of the shaft) and `stubbiness` mu = R_1/l. Both functions return the
# mean flux under the bush, Q_1, in units of lambda_1 T_*/R_1.


FUNCTIONS = 16
"""Chebyshev functions of the flux: Q_1 to 1e-8 for stubbiness 0.1 to 1."""

CUTOFF = 2000.0
"""Where the numerical part of the Galerkin integrals ends, in u/mu; the tail is added in closed form."""

PANEL_POINTS = 12
"""Gauss points on each half period of the Bessel functions."""

HALVINGS = 8
"""Halvings of the first panel towards zero."""

C1, C2, C3 = 38.37, 76.74, 11.45
"""Coefficients of the rational approximation of the kernel (2.11)."""


def exact_flux(cooling: float, stubbiness: float) -> float:
    """Return the mean flux into the shaft, from the mixed problem itself.

    The flux p(x) of (2.10) solves the integral equation (2.9), here with its true kernel
    K(u) = I_0(u)/(u I_1(u) + lambda I_0(u)); the source approximates the kernel. Galerkin's method with
    p = sum of a_n T_2n(x)/sqrt(1 - x^2) gives the matrix

        M_mn = (-1)^(m+n) int_0^inf K(mu v) mu J_2m(v) J_2n(v) dv

    because T_2n/sqrt(1 - x^2) has the cosine transform (-1)^n pi J_2n. The part 1/v of K(mu v) mu is
    integrated in closed form (zero for m != n, 1/(4 n), and ln 2 for the (0, 0) entry without exp(-v)/v), and
    so is the next part, (1/2 - lambda)/(mu v^2), beyond the cutoff.

    Parameters
    ----------
    cooling : float
        lambda = kappa_1 R_1/lambda_1, positive.
    stubbiness : float
        mu = R_1/l, positive.
    """
    v, weights, bessel = _nodes()
    u = stubbiness * v
    kernel = stubbiness * i0e(u) / (u * i1e(u) + cooling * i0e(u))
    rest = (bessel * (weights * (kernel - 1.0 / v))) @ bessel.T
    rest[0, 0] += weights @ (np.exp(-v) / v) + math.log(2.0)
    rest += (0.5 - cooling) / (2.0 * math.pi * stubbiness * CUTOFF**2)
    index = np.arange(1, FUNCTIONS)
    rest[index, index] += 0.25 / index
    right = np.zeros(FUNCTIONS)
    right[0] = 1.0
    # p has the mean (pi/2) a_0, in units of lambda_1 T_*/l; the air would take kappa_1 T_* of it.
    return 0.5 * math.pi * stubbiness * float(np.linalg.solve(rest, right)[0]) - cooling


def approximate_flux(cooling: float, stubbiness: float) -> float:
    """Return the mean flux into the shaft by the closed form (2.12)-(2.13) of the source.

    It is 0.6 to 2.9 % high for lambda = 0.02 to 0.3 and mu = 0.1 to 1, because (2.11) replaces the kernel.

    Parameters
    ----------
    cooling, stubbiness : float
        Cooling and stubbiness as in `exact_flux`.
    """
    s = math.sqrt(C2 / C3)
    half = 0.5 * (C1 + cooling * C3)
    root = math.sqrt(half**2 - cooling * C2)
    zeta_1, zeta_2 = math.sqrt(half + root), math.sqrt(half - root)
    # cosh and sinh of s/mu, both divided by exp(s/mu): Lambda is divided by it too.
    decay = math.exp(-2.0 * s / stubbiness)
    cosh, sinh = 0.5 * (1.0 + decay), 0.5 * (1.0 - decay)
    scale = zeta_1 * zeta_2 * ((s**2 + zeta_1 * zeta_2) * cosh + (zeta_1 + zeta_2) * s * sinh)
    a_2 = -cooling * (zeta_1**2 - s**2) * (zeta_2**2 - s**2) / scale
    a_3 = cooling * (1.0 / zeta_1 - (zeta_2**2 - s**2) * (zeta_1 * cosh + s * sinh) / scale)
    return stubbiness * (a_2 * sinh / s + a_3)


@cache
def _nodes() -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Return Gauss nodes v and weights on [0, CUTOFF], and (-1)^n J_2n(v), shape (FUNCTIONS, nodes)."""
    points, weights = np.polynomial.legendre.leggauss(PANEL_POINTS)
    # Halved towards zero: the kernel has poles at u = +-i sqrt(2 lambda), close to zero for little cooling.
    halves = math.pi * 0.5 ** np.arange(HALVINGS, 0, -1)
    edges = np.concatenate([[0.0], halves, np.linspace(math.pi, CUTOFF, round(CUTOFF / math.pi))])
    width = np.diff(edges)[:, None]
    v = (edges[:-1, None] + 0.5 * width * (1.0 + points)).ravel()
    orders = np.arange(FUNCTIONS)[:, None]
    bessel = (-1.0) ** orders * jv(2 * orders, v)
    return v, (0.5 * width * weights).ravel(), bessel
