"""The plain annular seal of a pump: what leaks holds the shaft, damps it, and moves along as a mass."""

from __future__ import annotations

from dataclasses import dataclass, field
from functools import lru_cache
from typing import ClassVar, NamedTuple

import numpy as np
from numpy.polynomial.legendre import leggauss
from numpy.typing import ArrayLike

from ..core.errors import (
    InputError,
    require_finite,
    require_kind,
    require_non_negative,
    require_number,
    require_positive,
    warn_user,
)
from ..core.inputs import in_si, quantities
from ..core.model import Array, Linearization, static_linearization
from ..core.readable import Readable
from .reaction import InertialModel, broadcast_state, require_size, without_overflow

# The steady flow through a plain annular gap around a shaft in its middle.


ROUNDS = 100
"""Steps of Newton's method, which falls monotonically to the root and needs a few."""


@quantities
@dataclass(frozen=True, kw_only=True)
class HirsFriction:
    """Friction of a fluid at a wall: stress = (1/2) density W^2 coefficient Re^exponent, Re = 2 W h/nu.

    W is the mean velocity relative to that wall, and 2 h is the hydraulic diameter of the gap h (Hirs 1973,
    J. Lubr. Technol. 95, 137-146). The defaults are Blasius' values for smooth walls, for Reynolds numbers
    from 3000 to 100 000. Laminar flow has 24 and -1.

    Parameters
    ----------
    coefficient : float [1]
        Friction factor of the wall at a Reynolds number of 1.
    exponent : float [1]
        Exponent from -1 to 0.

    Raises
    ------
    InputError
        If the coefficient is not positive, or the exponent not within -1 to 0.
    """

    coefficient: float = 0.079
    exponent: float = -0.25

    def __post_init__(self) -> None:
        require_positive("coefficient", self.coefficient)
        if not -1.0 <= self.exponent <= 0.0:
            raise InputError(f"exponent must be within -1 to 0, got {self.exponent!r}")


@dataclass(frozen=True, kw_only=True)
class SealFlow(Readable):
    """The leakage through a seal.

    Attributes
    ----------
    axial_velocity : float [m/s]
        Mean over the gap.
    leakage_flow : float [m3/s]
        Volume per time.
    friction_factor : float [1]
        lambda: pressure drop along the gap = density axial_velocity^2 lambda length/clearance.
    reynolds_number : float [1]
        2 W clearance/nu with the mean velocity W relative to either wall, for a fluid that rotates at half
        the shaft speed.
    """

    axial_velocity: float
    leakage_flow: float
    friction_factor: float
    reynolds_number: float


class Stream(NamedTuple):
    """Steady flow at speeds (...): axial velocity V [m/s], lambda [1], and the share of V^2 in W^2 [1]."""

    velocity: np.ndarray
    friction: np.ndarray
    axial: np.ndarray


def steady_flow(seal: AnnularSeal, speed: np.ndarray) -> Stream:
    """Return the flow that takes the pressure drop, in the mean half as fast round as the shaft.

    Parameters
    ----------
    seal : AnnularSeal
    speed : ndarray, shape (...) [rad/s]
        Complex too: the flow is analytic in it.

    Notes
    -----
    pressure drop = density V^2 ((1 + inlet loss)/2 + lambda length/clearance), lambda V^2 = f W V with the
    friction f of either wall, W^2 = V^2 + (radius speed/2)^2 (Childs 1983, J. Lubr. Technol. 105, 429-436).
    """
    half, m = 0.5 * seal.radius * speed, seal.friction.exponent
    entrance, slender = 0.5 * (1.0 + seal.inlet_loss), seal.length / seal.clearance
    head = seal.pressure_drop / seal.density
    scale = seal.friction.coefficient * (2.0 * seal.clearance * seal.density / seal.viscosity) ** m
    # From above, where all of the pressure accelerates the fluid.
    velocity = np.sqrt(head / entrance) * np.ones_like(half)
    for _ in range(ROUNDS):
        W2 = velocity**2 + half**2
        rough = scale * W2 ** (0.5 * (1.0 + m))
        left = entrance * velocity**2 + slender * rough * velocity - head
        slope = 2.0 * entrance * velocity + slender * rough * (1.0 + (1.0 + m) * velocity**2 / W2)
        step = left / slope
        velocity = velocity - step
        if np.all(np.abs(step) <= 1e-15 * np.abs(velocity)):
            break
    W2 = velocity**2 + half**2
    return Stream(velocity, scale * W2 ** (0.5 * (1.0 + m)) / velocity, velocity**2 / W2)


# The plain annular seal of a pump: what leaks holds the shaft, damps it, and moves along as a mass.


SHORT = 0.25
"""Length / diameter to which the short seal is meant."""

TURBULENT = (3e3, 1e5)
"""Reynolds numbers between which the friction of Blasius holds."""

TRANSIT = 1.0
"""Largest frequency times length/V, in 1 + inlet loss + sigma B, that the second order follows."""

SMALL = 0.5
"""Eccentricity ratio to which forces stay about linear (Allaire, Gunter, Lee & Barrett 1978)."""

_STEP = 1e-25
"""Imaginary part, relative, of a speed: the derivative of an analytic function, to roundoff."""

_PATTERN = np.array([[[1.0, 0.0], [0.0, 1.0]], [[0.0, 1.0], [-1.0, 0.0]]])


@quantities
@dataclass(frozen=True, kw_only=True)
class AnnularSeal(InertialModel):
    """A plain annular liquid seal around a centered shaft: a Reaction with an added mass.

        force = -[[K, k], [-k, K]] position - [[C, c], [-c, C]] velocity,   then - M acceleration

    Parameters
    ----------
    radius : float [m]
        Radius of the gap.
    length : float [m]
        Axial length of the gap.
    clearance : float [m]
        Radial clearance.
    pressure_drop : float [Pa]
        Pressure drop across the seal, including the inlet; positive.
    viscosity : float [Pa s]
        Dynamic viscosity.
    density : float [kg/m3]
    inlet_loss : float [1]
        Loss coefficient of the inlet, relative to `density V^2 / 2`; not negative. Sharp edges have 0.1 to
        0.5.
    inlet_swirl : float [1]
        Circumferential velocity of the fluid at the inlet, relative to radius * speed.
    friction : HirsFriction
        Friction of both walls.
    added_mass : bool
        Whether the added mass M of the fluid is included. Some analyses need False.

    Raises
    ------
    InputError
        If an argument breaks its rule.

    Warns
    -----
    ValidityWarning
        If length / diameter exceeds 0.25, or if the flow at rest is outside the range of Blasius' friction
        law.

    Notes
    -----
    The closed form for short seals of Black (1969) and Childs (1983); see `short_seal` for its one addition.
    K, k, C and M are up to 5 % too large at length / diameter 0.2 and up to 25 % at 0.5, compared with a
    perturbed bulk flow that includes circumferential pressure flow. Motion should be smaller than half of the
    clearance.
    """

    radius: float
    length: float
    clearance: float
    pressure_drop: float
    viscosity: float
    density: float
    inlet_loss: float = 0.1
    inlet_swirl: float = 0.5
    friction: HirsFriction = field(default_factory=HirsFriction)
    added_mass: bool = True

    def __post_init__(self) -> None:
        require_size(self, "pressure_drop", "viscosity", "density")
        require_non_negative("inlet_loss", self.inlet_loss)
        require_number("inlet_swirl", self.inlet_swirl)
        require_kind("friction", self.friction, HirsFriction, "a HirsFriction")
        self._warn()

    carries_load: ClassVar[bool] = False
    """Whether it is a bearing: it is none, and no rigid support of a critical speed."""

    @property
    def slenderness(self) -> float:
        """Length / diameter [1]."""
        return self.length / (2.0 * self.radius)

    largest_eccentricity_ratio: ClassVar[float] = SMALL
    """Eccentricity ratio to which the coefficients are meant: 0.5."""

    @property
    def nominal_force(self) -> float:
        """Force at a displacement of half the clearance, at rest [N]."""
        return 0.5 * self.clearance * float(self.matrices(0.0).K)

    @property
    def has_inertia(self) -> bool:
        """Whether the added mass of the fluid is included."""
        return self.added_mass

    @in_si
    def flow(self, speed: float) -> SealFlow:
        """Return the leakage at a speed.

        Parameters
        ----------
        speed : float [rad/s]
        """
        stream = steady_flow(self, np.asarray(require_number("speed", speed)))
        V = float(stream.velocity)
        return SealFlow(
            axial_velocity=V,
            leakage_flow=2.0 * np.pi * self.radius * self.clearance * V,
            friction_factor=float(stream.friction),
            reynolds_number=self._reynolds(V / float(np.sqrt(stream.axial))),
        )

    def matrices(self, speed: ArrayLike) -> SealMatrices:
        """Return K, k, C, c, M at speeds (...) [rad/s], each of that shape."""
        omega = require_finite("speed", speed)
        return SealMatrices(*self._values(omega)[0])

    def mass(self, position: ArrayLike, velocity: ArrayLike, speed: ArrayLike = 0.0) -> Array:
        """Return the added mass [kg], shape (2, 2, ...), at a speed; see `core.port.Reaction`."""
        q, v, omega = broadcast_state(position, velocity, speed)
        self.require_film(q)
        if not self.added_mass:
            return np.zeros((2, 2, *omega.shape))
        return without_overflow(
            lambda *_: np.multiply.outer(np.eye(2), self._values(omega)[0][4]), q, v, omega
        )

    def mass_slopes(self, position: ArrayLike, velocity: ArrayLike, speed: ArrayLike = 0.0) -> Array:
        """Return d mass / d (x, y, vx, vy, speed), shape (2, 2, 5, ...)."""
        q, _, omega = broadcast_state(position, velocity, speed)
        self.require_film(q)
        slopes = np.zeros((2, 2, 5, *omega.shape))
        if self.added_mass:
            slopes[:, :, 4] = np.multiply.outer(np.eye(2), self._values(omega)[1][4])
        return slopes

    def linear_system(self, *speeds: float) -> Linearization | None:
        """Return the force over places and rates at constant speed, as matrices; see `core.port`."""
        if type(self) is not AnnularSeal or len(set(speeds)) > 1:
            return None
        return static_linearization(self.jacobian(np.zeros(2), np.zeros(2), speeds[0])[:, :4])

    def require_range(self, frequency: float) -> None:
        """Warn where motion is too fast for the expansion to second order in the transit time of the fluid.

        Parameters
        ----------
        frequency : float [rad/s]
            Frequency of a synchronous whirl, which is also the shaft speed of the flow.
        """
        stream = steady_flow(self, np.asarray(float(frequency)))
        m, loss = self.friction.exponent, float(stream.friction) * self.length / self.clearance
        carried = 1.0 + self.inlet_loss + loss * (1.0 + (1.0 + m) * float(stream.axial))
        share = abs(frequency) * self.length / float(stream.velocity) / carried
        if share > TRANSIT:
            warn_user(
                f"frequency * transit time of the seal must not exceed {TRANSIT:g} of 1 + inlet_loss + drag, "
                f"got {share:.3g}: the coefficients hold for motion that is slow compared with the flow"
            )

    def prepared_force(self, position: Array, velocity: Array, speed: Array) -> Array:
        """Return `force` for inner loops: float arrays of equal batch shape, inside the clearance."""
        K, k, C, c, _ = self._values(speed)[0]
        return -(_apply(K, k, position) + _apply(C, c, velocity))

    def prepared_jacobian(self, position: Array, velocity: Array, speed: Array) -> Array:
        """Return `jacobian` for inner loops: float arrays of equal batch shape, inside the clearance."""
        (K, k, C, c, _), (dK, dk, dC, dc, _) = self._values(speed)
        by_speed = -(_apply(dK, dk, position) + _apply(dC, dc, velocity))
        return np.concatenate([-_matrix(K, k), -_matrix(C, c), by_speed[:, None]], axis=1)

    def _values(self, speed: Array) -> tuple[Array, Array]:
        """Return K, k, C, c, M, shape (5, ...), and their derivatives by the speed."""
        return _at(self, float(speed)) if np.ndim(speed) == 0 else _values(self, speed)

    def _reynolds(self, velocity: float) -> float:
        return 2.0 * velocity * self.clearance * self.density / self.viscosity

    def _warn(self) -> None:
        if self.slenderness > SHORT:
            warn_user(
                f"length / diameter must not exceed {SHORT} for a short seal, got {self.slenderness:.6g}: at "
                "0.5 its stiffness and damping are too large by about 25 %, since pressure drives flow round "
                "the shaft"
            )
        reynolds, (low, high) = self.flow(0.0).reynolds_number, TURBULENT
        if self.friction == HirsFriction() and not low <= reynolds <= high:
            warn_user(
                f"Reynolds number must be within {low:g} to {high:g} for the friction of Blasius, got "
                f"{reynolds:.4g} at rest: give another HirsFriction, for laminar flow coefficient=24 and "
                "exponent=-1"
            )


@lru_cache(maxsize=1024)
def _at(seal: AnnularSeal, speed: float) -> tuple[Array, Array]:
    return _values(seal, np.asarray(speed))


def _values(seal: AnnularSeal, speed: Array) -> tuple[Array, Array]:
    """Return the coefficients and their derivatives, by a complex step: analytic in the speed."""
    step = _STEP * np.sqrt(seal.pressure_drop / seal.density) / seal.radius
    shifted = speed + 1j * step
    stream = steady_flow(seal, shifted)
    found = np.stack(short_seal(seal, stream, shifted))
    return found.real, found.imag / step


def _apply(direct: Array, cross: Array, vector: Array) -> Array:
    return np.stack([direct * vector[0] + cross * vector[1], direct * vector[1] - cross * vector[0]])


def _matrix(direct: Array, cross: Array) -> Array:
    whole: Array = np.tensordot(_PATTERN, np.stack([direct, cross]), ([0], [0]))
    return whole


# Stiffness, damping and added mass of a short annular seal in closed form.
#
# The bulk flow of Hirs through a gap h (Childs 1983, J. Lubr. Technol. 105, 429-436, eqs. 1-3) is
# linearized about the shaft in the middle, where V is the axial velocity and the fluid goes round
# with
#
# radius speed (1/2 + v0 e), e = exp(-a z/length).
#
# Short: pressure drives no flow round the shaft. With T = length/V, sigma = lambda length/clearance
# and the displacement r = x + i y, the force is quadratic in the rate of change that the fluid sees
# on its way,
#
# s = p + q e(z), p = T (d/dt - i speed/2), q = -i T speed v0,
#
# which is followed to second order, as by Black (1969, J. Mech. Eng. Sci. 11, 206-213) for v0 = 0.
#
# What the published solutions leave out is the flow round the shaft that the moving gap disturbs
# where the fluid still loses its swirl. It acts to the first order in v0 on the cross-coupled
# stiffness, also of a very short seal, and is included here to that order.


_NODES, _WEIGHTS = leggauss(64)
_CROWDED = 0.5 * (_NODES + 1.0)
PLACES, WEIGHTS = _CROWDED**4, 2.0 * _WEIGHTS * _CROWDED**3
"""Gauss's rule over z / length, crowded at the inlet, where swirl decays: polynomials times exp(-a z/length).

Exact to roundoff for a up to 100, as of turbulent flow; 1e-7 at a = 1e4 and 1e-5 at 3e4, as of laminar flow.
"""

Wide = np.ndarray
"""Real or complex, of any shape."""


class SealMatrices(NamedTuple):
    """F = -[[K, k], [-k, K]] q - [[C, c], [-c, C]] v - M a of the journal, each (...) of speeds."""

    K: Wide
    k: Wide
    C: Wide
    c: Wide
    M: Wide


class _Numbers(NamedTuple):
    """Of the flow: sigma, 1 + inlet loss + sigma B, sigma B, a, exponent, rate at which w drags u along."""

    loss: Wide
    inertance: Wide
    drag: Wide
    decay: Wide
    exponent: float
    carried: Wide


class _Series(NamedTuple):
    """A constant (...), a linear form in (p, q) (2, ...), and a quadratic one in (pp, pq, qq) (3, ...)."""

    constant: Wide
    linear: Wide
    square: Wide


def short_seal(seal: AnnularSeal, stream: Stream, speed: Wide) -> SealMatrices:
    """Return the coefficients of a seal in a steady flow."""
    transit, found = seal.length / stream.velocity, _impedance(_numbers(seal, stream))
    turn, v0 = speed * transit, seal.inlet_swirl - 0.5
    scale = np.pi * seal.radius * seal.length * seal.density * stream.velocity**2 / seal.clearance
    (by_p, by_q), (pp, pq, qq) = found.linear, found.square
    return SealMatrices(
        K=scale * (found.constant - turn**2 * (0.25 * pp + 0.5 * v0 * pq + v0**2 * qq)),
        k=scale * turn * (0.5 * by_p + v0 * by_q),
        C=scale * transit * by_p,
        c=scale * transit * turn * (pp + v0 * pq),
        M=scale * transit**2 * pp,
    )


def _numbers(seal: AnnularSeal, stream: Stream) -> _Numbers:
    m, axial = seal.friction.exponent, stream.axial
    loss = stream.friction * seal.length / seal.clearance
    drag = loss * (1.0 + (1.0 + m) * axial)
    return _Numbers(
        loss=loss,
        inertance=1.0 + seal.inlet_loss + drag,
        drag=drag,
        decay=loss * (1.0 + (1.0 + m) * (1.0 - axial)),
        exponent=m,
        carried=loss * (1.0 + m) * axial * (1.0 - (1.0 - m) * (1.0 - axial)),
    )


def _impedance(n: _Numbers) -> _Series:
    """Return the mean of the pressure along the seal per displacement, in density V^2/clearance.

    With w = (V/clearance)(W0 + S), S = int s dz, the momentum -p' = (1 - m) sigma + (sigma B + s)(W0 + S) + s
    from p = -(1 + inlet loss) W0 to 0 gives W0, and int z p' the mean.
    """
    e = np.exp(-np.multiply.outer(PLACES, n.decay))
    j0, j1, j2 = (_over(PLACES**k, e) for k in range(3))
    one = np.ones_like(j0)
    end, moment, mean = _pair(one, j0), _pair(0.5 * one, j1), _pair(0.5 * one, j0 - j1)
    late = _pair(one / 3.0, 0.5 * (j0 - j2))
    carried = (1.0 - e) / n.decay
    squares = np.stack([one / 3.0, 2.0 * late[1], _over(1.0, carried**2)])
    ends = _product(end, end)
    push, D = (1.0 - n.exponent) * n.loss, n.inertance
    entry = _entry(_Series(push, n.drag * mean + end, 0.5 * ends), end, D)
    bare = _Series(
        0.5 * push + 0.5 * n.drag * entry.constant,
        0.5 * n.drag * entry.linear + entry.constant * moment + n.drag * late + moment,
        0.5 * n.drag * entry.square + _product(entry.linear, moment) + 0.5 * (ends - squares),
    )
    return _with_swirl_carried(bare, entry, n, e)


def _entry(load: _Series, end: Wide, D: Wide) -> _Series:
    """Return W0 = -load/(D + S(1)) to second order."""
    constant = -load.constant / D
    linear = -(load.linear / D - load.constant * end / D**2)
    square = load.square / D - _product(load.linear, end) / D**2 + load.constant * _product(end, end) / D**3
    return _Series(constant, linear, -square)


def _with_swirl_carried(bare: _Series, entry: _Series, n: _Numbers, e: Wide) -> _Series:
    """Return the impedance with the disturbed flow round the shaft, U' + (s + a) U = -e[...].

    It changes continuity to W' = s - q U. U = e Y to first order in p, for W = W0 + p z:
    Y' + p Y = (a - carried) W - (1 - m) a.
    """
    z = PLACES.reshape(-1, *(1,) * (e.ndim - 1))
    gain, D = n.decay - n.carried, n.inertance
    start = gain * entry.constant - (1.0 - n.exponent) * n.decay
    first = -e * start * z
    second = -e * (gain * (entry.linear[0] * z + 0.5 * z**2) - 0.5 * start * z**2)
    mean, late = _over(1.0 - PLACES, first), _over(0.5 * (1.0 - PLACES**2), first)
    load = n.drag * mean + _over(1.0, first)
    loads = n.drag * _over(1.0 - PLACES, second) + _over(1.0, second) + mean
    half = 0.5 * n.drag
    by_q = -half * load / D + n.drag * late + _over(PLACES, first)
    by_pq = -half * (loads / D - load / D**2) - 0.5 * load / D + late
    by_pq += n.drag * _over(0.5 * (1.0 - PLACES**2), second) + _over(PLACES, second)
    none = np.zeros_like(by_q)
    return _Series(
        bare.constant, bare.linear + _pair(none, by_q), bare.square + np.stack([none, by_pq, none])
    )


def _over(factor: Wide | float, values: Wide) -> Wide:
    """Return the integral over z / length of a factor (n,) times values (n, ...)."""
    return np.asarray(np.tensordot(WEIGHTS * factor, values, 1))


def _pair(p: Wide, q: Wide) -> Wide:
    return np.stack([p, q])


def _product(u: Wide, v: Wide) -> Wide:
    return np.stack([u[0] * v[0], u[0] * v[1] + u[1] * v[0], u[1] * v[1]])
