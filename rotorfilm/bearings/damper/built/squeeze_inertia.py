"""What the inertia of its oil makes of a squeeze-film damper: an added mass, and a force of convection."""

from __future__ import annotations

from functools import cached_property

import numpy as np
from numpy.typing import ArrayLike

from ....errors import InputError, require_inside
from ....model import Array
from ...films.law import options
from ...inertial_model import InertialModel
from ...reaction import broadcast_state
from ..squeeze_laws import SqueezeCase, SqueezeLaw, SqueezeOptions
from .end_seals import EndSeal
from .film_inertia import FilmInertia
from .film_range import require_inertia_range
from .squeeze_impedance import FilmSegment, SegmentedDamper, SqueezeImpedance


class SqueezeInertia(InertialModel):
    """A damper with density, whose fields its class has: F = force - mass acceleration."""

    radius: float
    length: float
    clearance: float
    viscosity: float
    density: float
    film: SqueezeLaw
    seals: EndSeal | None

    @property
    def squeeze_case(self) -> SqueezeCase:
        """Itself as its film sees it."""
        raise NotImplementedError

    @property
    def has_inertia(self) -> bool:
        """Whether the inertia of the oil counts."""
        return self.density > 0.0

    @cached_property
    def film_inertia(self) -> FilmInertia:
        """The inertia of the film in this damper's dimensions."""
        return options(self.film, SqueezeOptions).inertia(self.squeeze_case)

    def mass(self, position: ArrayLike, velocity: ArrayLike | None = None, speed: ArrayLike = 0.0) -> Array:
        """Return the mass that the oil adds to the rotor [kg], shape (2, 2, ...); 0 without density.

        Parameters
        ----------
        position : array_like, shape (2, ...) [m]
            Journal center from the bearing center.
        velocity : array_like, shape (2, ...) [m/s], optional
            Of a ruptured film, whose mass depends on its direction; a full one takes none.
        speed : array_like, shape (...) [rad/s]
            Not used.

        Raises
        ------
        InputError
            If an argument is not finite, or a ruptured film is given no velocity.
        FilmContactError
            If the journal touches the wall.
        """
        if velocity is None and self.has_inertia and self.squeeze_case.cavitated:
            raise InputError("velocity must be given for the mass of a ruptured film, got None")
        q, v, _ = broadcast_state(position, np.zeros(2) if velocity is None else velocity, speed)
        require_inside(q, self.clearance)
        if not self.has_inertia:
            return np.zeros((2, *q.shape))
        return self._inertia_scale / self.clearance * self.film_inertia.mass(*self._scaled(q, v))

    def mass_slopes(self, position: ArrayLike, velocity: ArrayLike, speed: ArrayLike = 0.0) -> Array:
        """Return d mass / d (x, y, vx, vy, speed), shape (2, 2, 5, ...); see `InertialReaction`."""
        q, v, _ = broadcast_state(position, velocity, speed)
        require_inside(q, self.clearance)
        if not self.has_inertia:
            return np.zeros((2, 2, 5, *q.shape[1:]))
        slopes = self.film_inertia.mass_slopes(*self._scaled(q, v))
        by_motion = self._inertia_scale / self.clearance**2 * slopes
        return np.concatenate([by_motion, np.zeros_like(by_motion[:, :, :1])], axis=2)

    def reynolds_number(self, frequency: float) -> float:
        """Return the squeeze Reynolds number |frequency| clearance^2 density/viscosity at [rad/s]."""
        return abs(frequency) * self.clearance**2 * self.density / self.viscosity

    def require_range(self, frequency: float) -> None:
        """Warn where the inertia of first order ends, and raise InputError far beyond.

        Parameters
        ----------
        frequency : float [rad/s]
            Of the motion.
        """
        require_inertia_range(self.reynolds_number(frequency), cavitated=self.squeeze_case.cavitated)

    def small_motion(self, frequency: float) -> SqueezeImpedance:
        """Return damping and added mass of small motion about the center, exact in the frequency [rad/s].

        Parameters
        ----------
        frequency : float [rad/s]
            Of the motion; 0 for slow motion.

        Raises
        ------
        InputError
            For a ruptured film, which has no linear matrices, a porous cage or a feed.
        """
        case = self.squeeze_case
        if case.cavitated or case.layer is not None or np.any(case.feed) or np.any(case.ends):
            raise InputError(
                f"small_motion takes a FullFilm() in a solid cage without feed, got {self!r}: for a ruptured "
                "film, orbit_coefficients"
            )
        land = FilmSegment(length=self.length, clearance=self.clearance)
        return SegmentedDamper(
            radius=self.radius,
            segments=(land,),
            viscosity=self.viscosity,
            density=self.density,
            seals=self.seals,
        ).small_motion(frequency)

    def convection(self, position: Array, velocity: Array) -> Array:
        """Return the force of convection [N], shape (2, ...), of arrays of equal batch shape; in `force`."""
        if not self.has_inertia:
            return np.zeros_like(position)
        return self._inertia_scale * self.film_inertia.convection(*self._scaled(position, velocity))

    def convection_slopes(self, position: Array, velocity: Array) -> Array:
        """Return its derivatives by position and velocity, shape (2, 4, ...)."""
        if not self.has_inertia:
            return np.zeros((2, 4, *position.shape[1:]))
        slopes = self.film_inertia.convection_slopes(*self._scaled(position, velocity))
        return self._inertia_scale / self.clearance * slopes

    @property
    def _inertia_scale(self) -> float:
        """Density * radius * length^3 [kg m], the film's unit of force per 1/s^2."""
        return self.density * self.radius * self.length**3

    def _scaled(self, position: Array, velocity: Array) -> tuple[Array, Array]:
        return position / self.clearance, velocity / self.clearance
