"""A loaded bush that wears by melting, with one state: load and speed in, angle, settlement, torque out."""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import ArrayLike

from ...core.errors import (
    FilmContactError,
    InputError,
    require_finite,
    require_kind,
    require_non_negative,
    require_positive,
    warn_user,
)
from ...core.inputs import quantities
from ...core.model import Array, Linearization
from ...core.signals import Signal, signals_of
from ...native.spec import NativeSpec
from . import contact_arc as arc
from .bearing import (
    NOMINAL_LOAD,
    NOMINAL_SPEED,
    MeltingBush,
    bush_parameters,
    bush_table,
    has_kernel,
    torque_row,
)
from .melting import MeltingContact, MeltingLaw

COOLED = 0.02
"""Part of the melting point by which a worn contact may be colder without a word."""


@quantities
@dataclass(frozen=True, kw_only=True)
class BushWear:
    """A `MeltingBush` under a load along one line: a Dynamic model with one state.

    The state is the wear moment W = int v cos(phi) dphi / R of the wear depth v. Contact angle alpha and
    contact temperature T follow from it and from load and speed,

        c(T) F(alpha) = a_1 N + W,   T = min(T_*, temperature at which losses equal friction heat),

    and the surplus q_m of friction heat over the losses at T_* melts the liner; q_m > 0 only at T = T_*:

        dW/dt = q_m N/(g gamma R qbar).

    Melting is taken proportional to the local pressure, whose shape is (2.14). The contact is taken to end on
    unworn liner, as it does while the load does not fall. A worn contact under a smaller load, or colder,
    ends within the worn part: it is narrower and warmer than this model says (docs/bush.md), and a warning
    says so. `BushReaction` follows the profile, and its `rest` finds how far the contact cools.

    Parameters
    ----------
    bush : MeltingBush
    melting_heat : float [J/m3]
        Heat g gamma that melts a unit of volume of the liner, from the melting point.
    wear : float [1]
        W at t = 0, not negative.

    Raises
    ------
    InputError
        If the melting heat is not finite and positive, or the wear is negative.
    """

    bush: MeltingBush
    melting_heat: float
    wear: float = 0.0

    def __post_init__(self) -> None:
        require_kind("bush", self.bush, MeltingBush, "a MeltingBush")
        require_positive("melting_heat", self.melting_heat)
        require_non_negative("wear", self.wear)

    @property
    def inputs(self) -> tuple[Signal, ...]:
        """Signals load, speed."""
        return signals_of(
            ("load", "N", NOMINAL_LOAD * self.bush.force_unit, "radial load, not negative"),
            ("speed", "rad/s", NOMINAL_SPEED, "angular speed about +z"),
        )

    @property
    def outputs(self) -> tuple[Signal, ...]:
        """Contact angle, settlement, temperature, pressure, friction torque, melt rate and speed ratio."""
        bush = self.bush
        depth, pressure = bush.geometry.radius * bush.clearance_ratio, NOMINAL_LOAD * bush.liner.shear_modulus
        rate = bush.law.losses(0.1) / self.melting_heat
        return signals_of(
            ("contact_angle", "rad", 0.1, "half the contact angle"),
            ("settlement", "m", depth, "displacement of the shaft beyond the clearance"),
            ("temperature", "K", bush.liner.melting_point, "contact temperature above ambient"),
            ("maximum_pressure", "Pa", pressure, "pressure on the load line"),
            torque_row(bush, float(bush.friction.at(bush.liner.melting_point))),
            ("melt_rate", "m/s", rate, "mean rate of wear over the contact"),
            ("speed_ratio", "1", 1.0, "speed / critical speed at the present contact angle"),
        )

    @property
    def states(self) -> tuple[Signal, ...]:
        """Signal wear: the wear moment W."""
        return signals_of(("wear", "1", 1e-3, "wear moment of the contact"))

    @property
    def initial_state(self) -> Array:
        """W at t = 0, shape (1,)."""
        return np.array([self.wear])

    def native(self) -> NativeSpec | None:
        """Return the kernel of the C library that is this model; None for another class or heat balance."""
        if type(self) is not BushWear or not has_kernel(self.bush):
            return None
        parameters = bush_parameters(self.bush, self.melting_heat)
        return NativeSpec(kernel="bush_wear", parameters=parameters, tables={"bush": bush_table(self.bush)})

    def derivative(self, t: float, x: ArrayLike, u: ArrayLike) -> Array:
        """Return dW/dt [1/s], shape (1,), at the state (wear,) and the input (load [N], speed [rad/s]).

        Raises
        ------
        InputError
            If the load is negative, or a value is not finite.
        ConvergenceError
            If friction rises so steeply with temperature that no steady contact exists.
        """
        point = self._point(x, u)
        at = self._law.contact(*point)
        if not at.melting:
            return np.zeros(1)
        return np.array([self._law.surplus(at, *point[1:]) / self._heat_per_moment(at.alpha)])

    def output(self, t: float, x: ArrayLike, u: ArrayLike) -> Array:
        """Return the outputs, shape (7,), in the order and the units of `outputs`.

        Raises
        ------
        InputError, ConvergenceError
            As in `derivative`.
        FilmContactError
            If the liner is worn through, so that the shaft reaches the housing.
        """
        point = self._point(x, u)
        at = self._law.contact(*point)
        settlement = float(self.bush.settlement(at.alpha, at.temperature))
        self._require_melting(point[0], at.temperature)
        thickness = self.bush.geometry.outer_radius - self.bush.geometry.radius
        if settlement >= thickness:
            raise FilmContactError(
                f"settlement must be below the thickness of the liner {thickness:.6g} m, "
                f"got {settlement:.6g} m"
            )
        if at.alpha == 0.0:
            return np.array([0.0, settlement, at.temperature, 0.0, 0.0, 0.0, 0.0])
        _, load_ratio, speed = point
        heat = self._law.sliding(at.alpha, load_ratio, speed) * self._law.coefficient(self._law.melting)
        return np.array(
            [
                at.alpha,
                settlement,
                at.temperature,
                self.bush.liner.shear_modulus * load_ratio * float(arc.peak_weight(at.alpha)),
                self._torque_unit(speed)
                * self._law.coefficient(at.temperature)
                * load_ratio
                * _arm(at.alpha),
                self._law.surplus(at, load_ratio, speed) / self.melting_heat,
                heat / self._law.losses(at.alpha),
            ]
        )

    def events(self, t: float, x: ArrayLike, u: ArrayLike) -> Array:
        """Return (steady temperature - melting point [K], speed [rad/s]), shape (2,).

        The model is smooth where neither changes sign: melting begins or ends, the shaft turns round.
        """
        point = self._point(x, u)
        return np.array([self._law.excess(*point), point[2]])

    def linearization(self, t: float, x: ArrayLike, u: ArrayLike) -> Linearization:
        """Return the exact derivatives on the present side of every event.

        Raises
        ------
        InputError
            If nothing is in contact: the angle then has no derivative by load or wear.
        """
        point = self._point(x, u)
        at = self._law.contact(*point)
        if at.alpha == 0.0:
            raise InputError(
                f"load and wear must not both be zero for a derivative, got u = {u!r}, x = {x!r}"
            )
        slopes = self._law.contact_slopes(at, *point[1:])
        # Columns W, load, speed from those by W, N, |speed|.
        worn = float(np.all(np.asarray(x) >= 0.0))
        chain = np.diag([worn, 1.0 / self.bush.force_unit, math.copysign(1.0, point[2])])
        rate = self._rate_slopes(at, slopes, *point[1:]) @ chain
        output = self._output_slopes(at, slopes, *point[1:]) @ chain
        return Linearization(rate[:, :1], rate[:, 1:], output[:, :1], output[:, 1:])

    def _rate_slopes(self, at: MeltingContact, slopes: Array, load_ratio: float, speed: float) -> Array:
        """Return d(dW/dt)/d(W, N, |speed|), shape (1, 3)."""
        if not at.melting:
            return np.zeros((1, 3))
        surplus = self._law.surplus(at, load_ratio, speed)
        weight_slope = float(arc.mean_weight_slope(at.alpha)) / float(arc.mean_weight(at.alpha))
        by = self._surplus_slopes(at, slopes, load_ratio, speed) - surplus * weight_slope * slopes[0]
        return (by / self._heat_per_moment(at.alpha))[None]

    def _surplus_slopes(self, at: MeltingContact, slopes: Array, load_ratio: float, speed: float) -> Array:
        """Return d(friction heat - losses at T_*)/d(W, N, |speed|), shape (3,)."""
        heat = self._law.heat_slopes(at.alpha, self._law.melting, load_ratio, speed)
        return -(heat[0] * slopes[0] + np.array([0.0, heat[2], heat[3]]))

    def _output_slopes(self, at: MeltingContact, slopes: Array, load_ratio: float, speed: float) -> Array:
        """Return d(outputs)/d(W, N, |speed|), shape (7, 3)."""
        law, modulus, radius = self._law, self.bush.liner.shear_modulus, self.bush.geometry.radius
        alpha, temperature = slopes
        by_load = np.array([0.0, 1.0, 0.0])
        cos = math.cos(at.alpha)
        friction, unit = law.coefficient(at.temperature), self._torque_unit(speed)
        surplus = self._surplus_slopes(at, slopes, load_ratio, speed)
        losses = law.losses(at.alpha)
        ratio = law.sliding(at.alpha, load_ratio, speed) * law.coefficient(law.melting) / losses
        # The speed ratio is (surplus + losses)/losses.
        loss_slope = law.heat_slopes(at.alpha, law.melting, 0.0, 0.0)[0] * alpha
        return np.array(
            [
                alpha,
                radius
                * (
                    law.gap(at.temperature) * math.sin(at.alpha) / cos**2 * alpha
                    - law.closing / cos * temperature
                ),
                temperature,
                modulus
                * (
                    float(arc.peak_weight(at.alpha)) * by_load
                    + load_ratio * float(arc.peak_weight_slope(at.alpha)) * alpha
                ),
                unit
                * (
                    friction * _arm(at.alpha) * by_load
                    + load_ratio * _arm(at.alpha) * law.coefficient_slope(at.temperature) * temperature
                    + friction * load_ratio * _arm_slope(at.alpha) * alpha
                ),
                surplus / self.melting_heat if at.melting else np.zeros(3),
                (surplus + (1.0 - ratio) * loss_slope) / losses,
            ]
        )

    def _require_melting(self, moment: float, temperature: float) -> None:
        """Warn of a worn contact that is colder than where it wears."""
        if moment > 0.0 and temperature < (1.0 - COOLED) * self._law.melting:
            warn_user(
                "load and speed must keep a worn contact at its melting point, got less than "
                f"{1.0 - COOLED:.0%} of that temperature. The model then takes the contact to end on unworn "
                "liner, and makes it too wide and too cold. BushReaction.rest has the worn profile"
            )

    @cached_property
    def _law(self) -> MeltingLaw:
        return self.bush.law

    def _point(self, x: ArrayLike, u: ArrayLike) -> tuple[float, float, float]:
        """Return wear moment, load in units of `force_unit`, and speed."""
        state, values = require_finite("x", x), require_finite("u", u)
        if state.shape != (1,) or values.shape != (2,):
            raise InputError(
                "x and u must have shapes (1,) for wear and (2,) for load, speed, "
                f"got {state.shape} and {values.shape}"
            )
        (moment,), (load, speed) = state.tolist(), values.tolist()
        require_non_negative("load", load)
        # Integrators try states beyond the solution: negative wear counts as none.
        return max(moment, 0.0), load / self.bush.force_unit, speed

    def _heat_per_moment(self, alpha: float) -> float:
        """Return the melting heat per contact area [J/m2] that raises W by one."""
        return self.melting_heat * self.bush.geometry.radius * float(arc.mean_weight(alpha))

    def _torque_unit(self, speed: float) -> float:
        sense = math.copysign(1.0, speed) if speed else 0.0
        return sense * self.bush.force_unit * self.bush.geometry.shaft_radius


def _arm(alpha: float) -> float:
    """Return the integral of the pressure over the contact for N = 1: friction acts on all of it."""
    return 2.0 * alpha * float(arc.mean_weight(alpha))


def _arm_slope(alpha: float) -> float:
    return 2.0 * (float(arc.mean_weight(alpha)) + alpha * float(arc.mean_weight_slope(alpha)))
