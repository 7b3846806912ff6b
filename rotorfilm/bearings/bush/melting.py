"""Steady heat and contact of a bush that may melt: contact angle and temperature of one state, derivatives.

Evtushenko & Kovalenko (1993), (1.2), (2.16), (2.17). The source keeps the contact at the melting point; here
it is colder while friction heat does not suffice. Plain numbers in, plain numbers out: the inner loop of
`bearings.bush_wear`.
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np

from ...errors import ConvergenceError
from ...model import Array
from . import contact_arc as arc
from .heat import HeatBalance

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
        Per liner radius: cold clearance, thermal closing per kelvin, and a_1.
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
