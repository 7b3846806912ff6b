"""Thrust bearings with pads on pivots: two tilts of each pad as states, or one on a line pivot."""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import ArrayLike

from ...core.dynamic_stiffness import no_rest
from ...core.errors import (
    EquilibriumError,
    InputError,
    require_finite,
    require_kind,
    require_number,
    warn_user,
)
from ...core.inputs import quantities
from ...core.model import Array, Linearization
from ...core.signals import Signal, signals_of
from ..reaction import NOMINAL_SPEED, input_vector
from .film_tables import require_tabulable
from .sector_pads import SectorPads

_MIDDLE = 1e-3
"""Distance of a pivot from the middle of the arc, over the arc, below which a flat pad carries nothing."""

_STARTS = (
    *((along, 0.0) for along in (1.0, 0.5, 2.0, 0.2, 5.0)),
    *((along, out) for along in (1.0, 3.0) for out in (1.0, -1.0, 2.5)),
)
"""Closing along the rotation and opening outward, over film/radius, from which a rest of a pad is sought."""


@quantities
@dataclass(frozen=True, kw_only=True)
class TiltingThrustBearing(SectorPads):
    """A thrust bearing of pads on pivots: a Reaction to z, tilt_x, tilt_y, its states the tilts of the pads.

    A pad turns about its pivot until the pressure has no moment about it. Its gap is h = depth + h_p + A_t
    s_t + A_r s_r, with s_t along the rotation, s_r outward from the pivot, and h_p as for a fixed pad. Pads
    have no mass: their rates follow from the balance of moments. Under a collar at rest the ratios A_t/h_p
    and A_r/h_p of flat pads depend on the shape alone, and the force is proportional to viscosity
    speed/h_p^2. Coefficients name their frequency: the tilts follow slow motion and lag behind fast motion.

    Signs are those of a `ThrustBearing`, dimensions and lubricant those of all `SectorPads`.

    Parameters
    ----------
    pivot_arc : float [1]
        Place of the pivot as part of the arc from the leading edge; above 0.5 for rotation about +z.
    pivot_width : float [1]
        Place of the pivot as part of the width from the inner radius.
    line_pivot : bool
        Whether the pad turns about the radial line through the pivot alone, with one tilt.

    Raises
    ------
    InputError
        If a value breaks its rule, or flat pads have their pivot in the middle of the arc: rigid flat pads
        with oil of one viscosity carry nothing there.

    Examples
    --------
    >>> bearing = TiltingThrustBearing(
    ...     inner_diameter="50 mm", outer_diameter="100 mm", pads=8, pad_arc="38 deg", viscosity=0.02
    ... )
    >>> len(bearing.states)
    16
    """

    pivot_arc: float = 0.6
    pivot_width: float = 0.54
    line_pivot: bool = False

    def __post_init__(self) -> None:
        super().__post_init__()
        require_kind("line_pivot", self.line_pivot, bool, "True or False")
        for name in ("pivot_arc", "pivot_width"):
            if not 0.0 < require_number(name, getattr(self, name)) < 1.0:
                raise InputError(f"{name} must be in (0, 1), got {getattr(self, name)!r}")
        if self.tabulated:
            require_tabulable(self)
        if not self.crown and abs(self.pivot_arc - 0.5) < _MIDDLE:
            raise InputError(
                "pivot_arc must not be 0.5 for flat rigid pads with constant viscosity, which carry no load "
                f"on a pivot in the middle, got {self.pivot_arc!r}: give a crown, as that of pads that bend, "
                "or move the pivot"
            )

    @property
    def tilts(self) -> int:
        """Number of tilts of each pad."""
        return 1 if self.line_pivot else 2

    @property
    def origin(self) -> float:
        """Axis of a pad's frame: the position of the pivot as a fraction of the arc."""
        return self.pivot_arc

    @property
    def pivot_radius(self) -> float:
        """Radius of the pivots [m]."""
        return self.inner_radius + self.pivot_width * (self.outer_radius - self.inner_radius)

    @cached_property
    def states(self) -> tuple[Signal, ...]:
        """Tilts of each pad: along the rotation and, but on a line pivot, outward."""
        size = self.film_scale / self.arm
        kinds = (("along", "along the rotation"), ("out", "outward"))[: self.tilts]
        return signals_of(
            *(
                (f"pad{k}_tilt_{name}", "rad", size, f"growth of the gap {way} over pad {k}, per meter")
                for k in range(self.pads)
                for name, way in kinds
            )
        )

    @cached_property
    def initial_state(self) -> Array:
        """Tilts at t = 0, shape (m,): at rest, at film_scale if the gap is not given."""
        z = 0.0 if self.gap > 0.0 else self.side * self.film_scale
        return self.rest_state([z, 0.0, 0.0], self.turning)

    @property
    def turning(self) -> float:
        """A speed [rad/s] in the sense of rotation in which the pads carry load."""
        return math.copysign(NOMINAL_SPEED, self.pivot_arc - 0.5)

    def output(self, t: float, x: ArrayLike, u: ArrayLike) -> Array:
        """Return force_z, moment_x, moment_y and torque for tilts x and u = (places, rates, speed)."""
        return self.answer(*self._point(x, u), differentiated=False).wrench

    def derivative(self, t: float, x: ArrayLike, u: ArrayLike) -> Array:
        """Return the rates of the tilts [rad/s], shape (m,)."""
        return self.answer(*self._point(x, u), differentiated=False).rates

    def linearization(self, t: float, x: ArrayLike, u: ArrayLike) -> Linearization:
        """Return the exact derivatives at tilts x and u = (places, rates, speed)."""
        return Linearization(*self.answer(*self._point(x, u), differentiated=True).slopes)

    def _point(self, x: ArrayLike, u: ArrayLike) -> tuple[Array, Array]:
        state = require_finite("x", x)
        if state.shape != (len(self.states),):
            raise InputError(
                f"x must have shape ({len(self.states)},) for the tilts, got shape {state.shape}"
            )
        return state, input_vector(u, self.freedoms)

    def rest_state(self, position: ArrayLike, speed: float) -> Array:
        """Return the tilts that rest with the collar at a place (3,) [m], [rad], shape (m,)."""
        return self.states_at_rest(self._at(position, np.zeros(3), speed))

    def states_at_rest(self, u: Array) -> Array:
        """Return the tilts of the pads that rest under a collar at rest, shape (m,).

        Raises
        ------
        EquilibriumError
            If Newton's method finds none, as for a rotation that the pads do not carry, and for flat pads
            whose center of pressure cannot lie at the pivot.
        """
        turned = self._unit_turned(u)
        size = self._film(turned) / self.outer_radius
        for along, out in _STARTS:
            guess = np.full((self.pads, 2), size) * (-along * math.copysign(1.0, u[6]), out)
            guess = guess[:, : self.tilts]
            found, status = self._unit.rest(turned, guess.ravel())
            if not status:
                return found
        if self._turns_away(float(u[6])):
            raise EquilibriumError(
                f"{self._sense}, got {float(u[6])!r} rad/s: in the other direction they have no equilibrium"
            )
        if not self.crown:
            raise EquilibriumError(self._unbalanced(u[:3]))
        raise no_rest(self, u[:3], float(u[6]))

    def _unbalanced(self, place: Array) -> str:
        """Return that flat pads have no hydrodynamic rest."""
        return (
            "pivot_arc and pivot_width must be where the center of pressure of a flat pad can lie, got "
            f"{self.pivot_arc!r} and {self.pivot_width!r} with the collar at {place.tolist()}: no tilt has "
            "its pressure there. Oil moves faster outside, so a pivot near the middle of the arc must lie "
            "beyond the middle of the width. Flat pads rest on a pivot_arc of 0.6 and a pivot_width of 0.5"
        )

    def warn_of_flow(
        self, speed: float, temperature: float | None = None, hottest: float | None = None
    ) -> None:
        """Warn where flat pads turn away from their pivots, or the oil is beyond its law; see `core.port`."""
        super().warn_of_flow(speed, temperature, hottest)
        if self._turns_away(speed):
            warn_user(
                f"{self._sense}, got {speed!r} rad/s: in the other direction they carry a few percent of the "
                "load"
            )

    def _turns_away(self, speed: float) -> bool:
        return not self.crown and speed * self.turning < 0.0

    @property
    def _sense(self) -> str:
        sign = "positive" if self.turning > 0.0 else "negative"
        return f"speed must be {sign} for flat pads with pivot_arc {self.pivot_arc!r}"

    def held_coefficients(self, position: ArrayLike, speed: float) -> tuple[Array, Array]:
        """Return stiffness and damping with the pads held in their tilts at rest, shape (3, 3) each.

        They are too stiff for any motion of the shaft, as the pads follow it.

        Parameters
        ----------
        position : array_like, shape (3,) [m], [rad]
        speed : float [rad/s]
        """
        self.require_temperature()
        u = self._at(position, np.zeros(3), speed)
        kernel = self.kernel_of(self.film_viscosity, held=True)
        found, status = kernel.at(self.states_at_rest(u), u, differentiated=True)
        if status:
            self.report(status, u)
        D = found.slopes[3]
        return -D[:3, :3], -D[:3, 3:6]

    def _unit_turned(self, u: Array) -> Array:
        """Return inputs with no rates; tilts at rest do not depend on the size of the speed."""
        return np.array([*u[:3], 0.0, 0.0, 0.0, math.copysign(1.0, u[6]) if u[6] else self.turning])

    def _film(self, u: Array) -> float:
        """Return the film at the pivots of an aligned collar [m]."""
        film = self.gap + self.side * float(u[0])
        if not film > 0.0:
            self.require_film(u[:3])
        return film

    def _least(self, place: Array) -> float:
        """Return the least film [m] with the pads at rest; that over the lands if it is not positive."""
        u = np.array([*place, 0.0, 0.0, 0.0, self.turning])
        held = self._unit.least(np.zeros(len(self.states)), u)
        lands = self.gap + self.side * float(place[0])
        if not lands > 0.0:
            return min(held, lands)
        try:
            return self._unit.least(self.states_at_rest(u), u)
        except EquilibriumError:
            return min(held, 0.0)
