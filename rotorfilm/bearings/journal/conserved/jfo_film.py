"""A journal bearing whose film conserves its oil where it ruptures, in SI units."""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import cached_property
from numbers import Number
from typing import Any, ClassVar, cast

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ....errors import (
    InputError,
    require_finite,
    require_inside,
    require_kind,
    require_number,
    require_pair,
    require_positive,
)
from ....inputs.kinds import arguments
from ....inputs.si_arguments import quantities
from ....model import Array, Tangent
from ...at_frequency import ReducedCoefficients, coefficients_of
from ...films.conserved.air_at_ends import warn_of_air
from ...films.conserved.conserved_cells import conserved_cells, require_conserved_cells
from ...films.conserved.conserved_film import ConservedFilm, ConservedState, circular_gap
from ...films.conserved.conserved_motion import FilmInMotion, slow_motion, speed_slope
from ...films.conserved.oil_spec import OilNumbers
from ...films.conserved.stepped_film import SteppedFilm
from ..bearing import JournalBearing
from .jfo_losses import JFOHeat
from .jfo_state import JFOState, jfo_state
from .jfo_supply import oil_numbers, oil_supply


@quantities
@dataclass(frozen=True, kw_only=True)
class JFOFilm(JFOHeat, SteppedFilm):
    """The film of a journal bearing that conserves its oil (Jakobsson, Floberg and Olsson).

    Where the film ruptures the oil goes on, in a gap that it fills in part, until there is enough to start
    the film again. So the film starts where oil comes from, and not where Reynolds' rupture has it: what
    grooves, holes and pumps give decides force, side flow and friction. The film remembers: a force follows
    from position and speed for a journal at rest, or in slow motion, only; in a vibration stiffness and
    damping depend on its frequency. `equilibrium` and `coefficients` take it as they take any bearing.

    Lines stay in the bearing, uniform between the edges of openings. 144 x 10 cells are within .7 % of the
    force to eccentricity ratio .9, in about one ms.

    Parameters
    ----------
    bearing : JournalBearing
        With what feeds it: grooves of a length, feed holes, a circumferential groove, or grooves over the
        whole length at ambient pressure. Gaps between pads are full of oil at ambient pressure. Its own film
        law has no part. On an oil with a cooling `equilibrium` finds the temperature of the film too.
    cells : tuple of int
        Lines around the film and cells along half the length, about; even numbers.
    supply_flow : float or None [m3/s]
        Oil given to each opening, which then finds its own pressure, or starves; None for openings at the
        supply pressure of the bearing.
    cavitation_pressure : float [Pa]
        Gauge pressure in the cavity, not above 0.
    submerged : bool
        Whether there is oil around the ends. It is what they draw in where the film is below ambient
        pressure; in air that would be air, of which there is a warning.

    Raises
    ------
    InputError
        If the bearing has no supply, as it then runs dry, or one that such a film cannot take, or another
        argument breaks its rule.

    Warns
    -----
    ValidityWarning
        If ends in air would draw in more than 1 % of the side flow.

    Examples
    --------
    >>> from rotorfilm import Groove
    >>> top = Groove(center="90 deg", width="20 deg", length="40 mm")
    >>> size = dict(radius=0.05, length=0.05, clearance=1e-4, viscosity=0.02)
    >>> bearing = JournalBearing(**size, grooves=(top,), supply_pressure=2e5)
    >>> film = JFOFilm(bearing=bearing)
    >>> film.solve(position=[30e-6, -50e-6], speed=314.2).oil_content.shape
    (144, 10)
    """

    order: ClassVar[int] = 2
    """Order of convergence of the force in the size of the cells."""

    bearing: JournalBearing
    cells: tuple[int, int] = (144, 10)
    supply_flow: float | None = None
    cavitation_pressure: float = 0.0
    submerged: bool = False

    def __post_init__(self) -> None:
        require_kind("bearing", self.bearing, JournalBearing, "a JournalBearing")
        require_conserved_cells(self.cells)
        if self.supply_flow is not None:
            require_positive("supply_flow", self.supply_flow)
        if not require_number("cavitation_pressure", self.cavitation_pressure) <= 0.0:
            raise InputError(f"cavitation_pressure must not be above 0, got {self.cavitation_pressure!r}")
        require_kind("submerged", self.submerged, bool, "True or False")
        oil_supply(self.bearing, self.supply_flow, self.cavitation_pressure, self.submerged)

    @property
    def clearance(self) -> float:
        """Radial clearance of the bearing [m]."""
        return self.bearing.clearance

    @property
    def scales(self) -> tuple[float, float]:
        """Units of the force [N s] and of the oil, clearance radius length [m3]."""
        return self.bearing.force_scale, self.clearance * self.bearing.radius * self.bearing.film_length

    @property
    def numbers(self) -> OilNumbers:
        """What its kernel has besides the film."""
        return oil_numbers(self.bearing, self.supply_flow, self.cavitation_pressure)

    @cached_property
    def film(self) -> ConservedFilm:
        """The film without dimensions, for steps in time; see `ConservedFilm`."""
        self.bearing.require_temperature()
        supply = oil_supply(self.bearing, self.supply_flow, self.cavitation_pressure, self.submerged)
        return ConservedFilm(
            conserved_cells(self.bearing.geometry, *self.cells), self.bearing.slenderness, supply
        )

    @arguments
    def solve(self, position: ArrayLike, speed: float) -> JFOState:
        """Return the steady film of a journal at rest.

        Parameters
        ----------
        position : array_like, shape (2,) [m]
            Of the journal's center.
        speed : float [rad/s]
            Angular speed about +z, of either sign.

        Raises
        ------
        InputError
            If an argument breaks its rule.
        FilmContactError
            If the journal touches the wall.
        ConvergenceError
            If the search for the cavity does not end.
        """
        q, state = self._steady(position, speed)
        found = jfo_state(self.bearing, self.film, state, q, self.cavitation_pressure)
        warn_of_air(self.submerged, found.drawn_in, found.side_flow)
        return found

    @arguments
    def complex_stiffness(self, position: ArrayLike, speed: float, s: complex) -> NDArray[np.complex128]:
        """Return K(s), shape (2, 2) [N/m]: -K q e^(s t) is the change of the force when the journal moves so.

        Parameters
        ----------
        position, speed : array_like, shape (2,) [m], and float [rad/s]
            As in `solve`.
        s : complex [1/s]
            Growth rate + i frequency.
        """
        if not isinstance(s, Number) or not np.isfinite(s):
            raise InputError(f"s must be a finite number, got {s!r}")
        return self._in_motion(position, speed).stiffness(complex(s))

    @arguments
    def slow_coefficients(self, position: ArrayLike, speed: float) -> ReducedCoefficients:
        """Return K and C in motions slow against the time that oil takes to cross the cavity: K(0), dK/ds(0).

        Neither is symmetric, and C may be negative in a diagonal.

        Parameters
        ----------
        position, speed : array_like, shape (2,) [m], and float [rad/s]
            As in `solve`.
        """
        q, state = self._steady(position, speed)
        K, C = self._slow(state)
        return ReducedCoefficients(stiffness=K, damping=C, position=q, speed=float(speed), frequency=0.0)

    @arguments
    def coefficients(
        self, position: ArrayLike, speed: float, frequency: float | None = None
    ) -> ReducedCoefficients:
        """Return Re K(i frequency) and Im K(i frequency)/frequency; see `linear.coefficients`.

        Without a frequency they are `MemoryCoefficients`, at that of the shaft: what takes them for modes,
        thresholds or a critical mass goes by K(s).

        Parameters
        ----------
        position, speed : array_like, shape (2,) [m], and float [rad/s]
            As in `solve`.
        frequency : float, optional [rad/s]
        """
        own = abs(require_number("speed", speed))
        if (own if frequency is None else require_number("frequency", frequency)) == 0.0:
            return self.slow_coefficients(position, speed)
        q = np.asarray(position, dtype=float)
        return coefficients_of(self._in_motion(position, speed), q, float(speed), frequency)

    def force(self, position: ArrayLike, velocity: ArrayLike, speed: ArrayLike) -> Array:
        """Return the force on a journal at rest, shape (2,) [N].

        Raises
        ------
        InputError
            If an argument breaks its rule, or the velocity is not 0.
        FilmContactError, ConvergenceError
            As `solve`.
        """
        _, state = self._at_rest(position, velocity, speed)
        return self.bearing.force_scale * self.film.force(state)

    def jacobian(self, position: ArrayLike, velocity: ArrayLike, speed: ArrayLike) -> Array:
        """Return d force / d (x, y, vx, vy, speed), shape (2, 5): in slow motion, at velocity 0.

        Raises
        ------
        InputError, FilmContactError, ConvergenceError
            As `force`.
        """
        _, state = self._at_rest(position, velocity, speed)
        return self._jacobian(state)

    def prepare_tangent(self) -> Tangent:
        """Return force and derivatives as a function of five numbers."""

        def tangent(
            x: float, y: float, vx: float, vy: float, speed: float
        ) -> tuple[float, float, list[float]]:
            _, state = self._at_rest((x, y), (vx, vy), speed)
            force_x, force_y = (self.bearing.force_scale * self.film.force(state)).tolist()
            return force_x, force_y, self._jacobian(state).ravel().tolist()

        return tangent

    def at_temperature(self, temperature: float) -> JFOFilm:
        """Return this film at one temperature [K]; raises InputError if its bearing has no oil."""
        return replace(self, bearing=self.bearing.at_temperature(temperature))

    def at_rest(self) -> JFOFilm:
        """Return this film: it has a force for a journal at rest only."""
        return self

    def settled(self, found: Any) -> Any:
        """Return an equilibrium as it is."""
        return found

    @property
    def _per_length(self) -> float:
        return self.bearing.force_scale / self.clearance

    def _slow(self, state: ConservedState) -> tuple[Array, Array]:
        stiffness, damping = slow_motion(self.film, state)
        return self._per_length * stiffness, self._per_length * damping

    def _jacobian(self, state: ConservedState) -> Array:
        by_motion = -np.hstack(self._slow(state))
        return np.column_stack([by_motion, self.bearing.force_scale * speed_slope(self.film, state)])

    def _in_motion(self, position: ArrayLike, speed: float) -> FilmInMotion:
        return FilmInMotion(self.film, self._steady(position, speed)[1], self._per_length)

    def _at_rest(
        self, position: ArrayLike, velocity: ArrayLike, speed: ArrayLike
    ) -> tuple[Array, ConservedState]:
        if np.any(require_finite("velocity", velocity)):
            raise InputError(f"velocity must be (0, 0) for a film that remembers, got {velocity!r}")
        return self._steady(position, cast(float, np.asarray(speed)[()]))

    def _steady(self, position: ArrayLike, speed: float) -> tuple[Array, ConservedState]:
        q, omega = require_pair("position", position), require_number("speed", speed)
        require_inside(q, self.clearance)
        return q, self.film.solve(circular_gap(self.film.cells, q / self.clearance), 0.5 * omega)
