"""The plain annular seal of a pump: what leaks holds the shaft, damps it, and moves along as a mass."""

from __future__ import annotations

from dataclasses import dataclass, field
from functools import lru_cache

import numpy as np
from numpy.typing import ArrayLike

from ...errors import require_finite, require_kind, require_non_negative, require_number, warn_user
from ...inputs.si_arguments import in_si, quantities
from ...model import Array
from ..film_units import require_size
from ..inertial_model import InertialModel
from ..reaction import broadcast_state, without_overflow
from .seal_flow import HirsFriction, SealFlow, SealGap, steady_flow
from .short_seal import SealMatrices, short_seal

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
    """A plain annular liquid seal about its shaft in the middle: a Reaction with an added mass.

        force = -[[K, k], [-k, K]] position - [[C, c], [-c, C]] velocity,   then - M acceleration

    Parameters
    ----------
    radius, length, clearance : float [m]
        Of the gap.
    pressure_drop : float [Pa]
        Across the seal, inlet included; positive.
    viscosity : float [Pa s]
        Dynamic viscosity.
    density : float [kg/m3]
    inlet_loss : float [1]
        Pressure lost at the inlet, in (1/2) density V^2; not negative. Sharp edges lose 0.1 to 0.5.
    inlet_swirl : float [1]
        Velocity of the fluid round the shaft where it comes in, in radius * speed.
    friction : HirsFriction
        Of both walls.
    added_mass : bool
        Whether the fluid's mass M moves with the rotor; False leaves it out, for analyses that take none.

    Raises
    ------
    InputError
        If an argument breaks its rule.

    Warns
    -----
    ValidityWarning
        Beyond length / diameter 0.25, and where the flow at rest is outside of what Blasius measured.

    Notes
    -----
    The closed form for short seals of Black (1969) and Childs (1983); see `short_seal` for its one addition.
    Against the perturbed bulk flow with pressure flow round the shaft K, k, C, M are up to 5 % too large at
    length / diameter 0.2, 25 % at 0.5. Small motion: to half of the clearance.
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

    @property
    def carries_load(self) -> bool:
        """Whether it is a bearing: it is none, and no rigid support of a critical speed."""
        return False

    @property
    def slenderness(self) -> float:
        """Length / diameter [1]."""
        return self.length / (2.0 * self.radius)

    @property
    def largest_eccentricity_ratio(self) -> float:
        """Eccentricity ratio to which the coefficients are meant: 0.5."""
        return SMALL

    @property
    def nominal_force(self) -> float:
        """Force at half of the clearance, at rest [N]."""
        return 0.5 * self.clearance * float(self.matrices(0.0).K)

    @property
    def has_inertia(self) -> bool:
        """Whether the fluid's mass is part of the answer."""
        return self.added_mass

    @in_si
    def flow(self, speed: float) -> SealFlow:
        """Return the leakage at a speed.

        Parameters
        ----------
        speed : float [rad/s]
        """
        stream = steady_flow(self.gap, np.asarray(require_number("speed", speed)))
        V = float(stream.velocity)
        return SealFlow(
            axial_velocity=V,
            leakage_flow=2.0 * np.pi * self.radius * self.clearance * V,
            friction_factor=float(stream.friction),
            reynolds_number=self._reynolds(V / float(np.sqrt(stream.axial))),
        )

    @property
    def gap(self) -> SealGap:
        """What the flow depends on."""
        own = (self.radius, self.length, self.clearance, self.pressure_drop)
        return SealGap(*own, self.viscosity, self.density, self.inlet_loss, self.friction)

    def matrices(self, speed: ArrayLike) -> SealMatrices:
        """Return K, k, C, c, M at speeds (...) [rad/s], each of that shape."""
        omega = require_finite("speed", speed)
        return SealMatrices(*self._values(omega)[0])

    def mass(self, position: ArrayLike, velocity: ArrayLike, speed: ArrayLike = 0.0) -> Array:
        """Return the added mass [kg], shape (2, 2, ...), at a speed; see `InertialReaction`."""
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

    def require_range(self, frequency: float) -> None:
        """Warn where motion is too fast for the second order in the time that the fluid takes through.

        Parameters
        ----------
        frequency : float [rad/s]
            Of the motion: of a synchronous whirl, as the flow is taken at this speed of the shaft.
        """
        stream = steady_flow(self.gap, np.asarray(float(frequency)))
        m, loss = self.friction.exponent, float(stream.friction) * self.length / self.clearance
        carried = 1.0 + self.inlet_loss + loss * (1.0 + (1.0 + m) * float(stream.axial))
        share = abs(frequency) * self.length / float(stream.velocity) / carried
        if share > TRANSIT:
            warn_user(
                f"frequency * transit time of the seal must not exceed {TRANSIT:g} of 1 + inlet_loss + drag, "
                f"got {share:.3g}: its coefficients follow motion that is slow beside the flow"
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
                f"{reynolds:.4g} at rest: give a HirsFriction, of laminar flow coefficient=24, exponent=-1"
            )


@lru_cache(maxsize=1024)
def _at(seal: AnnularSeal, speed: float) -> tuple[Array, Array]:
    return _values(seal, np.asarray(speed))


def _values(seal: AnnularSeal, speed: Array) -> tuple[Array, Array]:
    """Return the coefficients and their derivatives, by a complex step: analytic in the speed."""
    step = _STEP * np.sqrt(seal.pressure_drop / seal.density) / seal.radius
    shifted = speed + 1j * step
    stream = steady_flow(seal.gap, shifted)
    found = np.stack(short_seal(seal.gap, stream, seal.inlet_swirl, shifted))
    return found.real, found.imag / step


def _apply(direct: Array, cross: Array, vector: Array) -> Array:
    return np.stack([direct * vector[0] + cross * vector[1], direct * vector[1] - cross * vector[0]])


def _matrix(direct: Array, cross: Array) -> Array:
    whole: Array = np.tensordot(_PATTERN, np.stack([direct, cross]), ([0], [0]))
    return whole
