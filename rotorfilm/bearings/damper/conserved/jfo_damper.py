"""A squeeze-film damper whose film conserves its oil where it ruptures, in SI units."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from numbers import Number
from typing import ClassVar

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ....errors import InputError, require_inside, require_kind, require_non_negative, require_number
from ....inputs.kinds import arguments
from ....inputs.si_arguments import quantities
from ....model import Array
from ...film_units import require_size
from ...films.conserved.conserved_cells import require_conserved_cells
from ...films.conserved.conserved_film import ConservedFilm, ConservedState, circular_gap, direction
from ...films.conserved.conserved_motion import dynamic_stiffness, slow_motion
from ...films.conserved.oil_spec import OilNumbers
from ...films.conserved.reynolds_oil import reynolds_state
from ...films.conserved.stepped_film import FilmMemory, SteppedFilm
from ...reaction import broadcast_state
from ...stepped_reaction import StepTrial
from .damper_supply import DamperSupply, damper_numbers
from .jfo_orbit import JFOOrbit, jfo_orbit
from .scaled_film import ScaledFilm, scaled_film

CIRCULAR = 1e-9
"""Radial velocity over the whole one, beyond which an orbit is no circle."""

QUARTER = np.array([[0.0, -1.0], [1.0, 0.0]])
"""Turns a vector by 90 deg."""


@quantities
@dataclass(frozen=True, kw_only=True)
class JFODamper(SteppedFilm):
    """A squeeze-film damper that conserves its oil (Jakobsson, Floberg and Olsson); its cage is solid.

    The race does not spin: oil in the cavity stays where it is, and only pressure moves it. So the cavity
    remembers the last turn, and what fills it again is the supply. There is a force on a centered circular
    orbit, steady in axes that turn with it, or at rest; any other motion wants its past. That is what
    `simulate` steps through with the rotor, and `damper_turn` for a motion that repeats itself: the damper is
    a Stepped model too. On 72 x 16 cells the force is .7 % above its limit.

    Parameters
    ----------
    radius, length, clearance : float [m]
        Of the film; the length with a groove in its middle.
    viscosity : float [Pa s]
    supply : DamperSupply
    stiffness : float [N/m]
        Of retainer springs, preloaded so that they carry the static load where the rotor is centered. Their
        force is part of `force` and of steps in time, not of that of the film: `orbit`, `damper_turn`.
    cells : tuple of int
        Lines around the film and cells along half its length, about; even numbers.

    Raises
    ------
    InputError
        If an argument breaks its rule.

    Warns
    -----
    ValidityWarning
        If ends in air would draw in more than 1 % of the side flow.

    Examples
    --------
    >>> supply = DamperSupply(supply_pressure=2e5, circumferential_groove=2e-3)
    >>> damper = JFODamper(radius=0.05, length=0.04, clearance=1e-4, viscosity=0.01, supply=supply)
    >>> orbit = damper.orbit(eccentricity_ratio=0.4, speed=500.0)
    >>> bool(orbit.oil_content.min() < 1.0)
    True
    """

    order: ClassVar[int] = 2
    """Order of convergence of the force in the size of the cells."""

    radius: float
    length: float
    clearance: float
    viscosity: float
    supply: DamperSupply
    stiffness: float = 0.0
    cells: tuple[int, int] = (72, 16)

    def __post_init__(self) -> None:
        require_size(self, "viscosity")
        require_kind("supply", self.supply, DamperSupply, "a DamperSupply")
        require_non_negative("stiffness", self.stiffness)
        require_conserved_cells(self.cells)
        _ = self.scaled

    @cached_property
    def scaled(self) -> ScaledFilm:
        """The film without dimensions, in axes at rest or turning, and its units."""
        return scaled_film(
            self.supply,
            radius=self.radius,
            length=self.length,
            clearance=self.clearance,
            viscosity=self.viscosity,
            cells=self.cells,
        )

    @property
    def film(self) -> ConservedFilm:
        """The film without dimensions; see `ConservedFilm`."""
        return self.scaled.film

    @property
    def scales(self) -> tuple[float, float]:
        """Units of the force [N s] and of the oil [m3]."""
        return self.scaled.force, self.scaled.oil

    @property
    def numbers(self) -> OilNumbers:
        """What its kernel has besides the film."""
        return damper_numbers(self.supply, self.radius, self.viscosity, self.stiffness)

    def carrying(self, motion: Array) -> float:
        """Return 0: the race does not spin."""
        return 0.0

    def answer(self, state: FilmMemory) -> Array:
        """Return the outputs of a state, shape (9,), the force with that of the springs."""
        found = super().answer(state)
        found[:2] -= self.stiffness * state.motion[:2]
        return found

    def step(
        self, state: FilmMemory, t: float, u: ArrayLike, dt: float
    ) -> tuple[FilmMemory, Array, dict[str, int]]:
        """Return state, outputs and counters of work after dt [s]; see `SteppedFilm.step`."""
        end, _, report = super().step(state, t, u, dt)
        return end, self.answer(end), report

    def attempt(self, state: FilmMemory, u: Array, dt: float, near: FilmMemory | None = None) -> StepTrial:
        """Return one inner step, with its slope; see `bearings.stepped_reaction`."""
        film = super().attempt(state, u, dt, near)
        slope = film.stiffness + self.stiffness * np.eye(2)
        return film._replace(output=self.answer(film.state), stiffness=slope)

    def slopes(self, state: FilmMemory) -> Array:
        """Return d force / d (x, y, vx, vy, speed) at a state whose cells keep their oil, shape (2, 5)."""
        found = super().slopes(state)
        found[:, :2] -= self.stiffness * np.eye(2)
        found[:, 4] = 0.0
        return found

    @arguments
    def orbit(self, eccentricity_ratio: float, speed: float) -> JFOOrbit:
        """Return the film on a centered circular orbit.

        Parameters
        ----------
        eccentricity_ratio : float [1]
            Radius of the orbit / clearance, at least 0 and below 1.
        speed : float [rad/s]
            Of the orbit, of either sign.

        Raises
        ------
        InputError
            If an argument breaks its rule, or the damper is fed by holes: it then has no steady orbit, and
            `damper_turn` steps to a periodic one.
        FilmContactError
            If the rotor touches the wall.
        """
        require_non_negative("eccentricity_ratio", eccentricity_ratio)
        omega = require_number("speed", speed)
        require_inside(np.array([eccentricity_ratio * self.clearance, 0.0]), self.clearance)
        found = jfo_orbit(self.scaled, self._turning(eccentricity_ratio, omega), eccentricity_ratio, omega)
        self.supply.warn_of_air(found.drawn_in, found.side_flow)
        return found

    @arguments
    def complex_stiffness(
        self, eccentricity_ratio: float, speed: float, s: complex
    ) -> NDArray[np.complex128]:
        """Return K(s) of the film about an orbit, in radial and tangential axes, shape (2, 2) [N/m].

        -K q e^(s t) is the change of the force when the rotor moves by q e^(s t) in axes that turn with it.

        Parameters
        ----------
        eccentricity_ratio, speed : float [1], [rad/s]
            As in `orbit`; speed 0 for a rotor at rest.
        s : complex [1/s]
        """
        if not isinstance(s, Number) or not np.isfinite(s):
            raise InputError(f"s must be a finite number, got {s!r}")
        state = self._turning(eccentricity_ratio, require_number("speed", speed))
        return self.scaled.force / self.clearance * dynamic_stiffness(self.film, state, complex(s))

    def force(self, position: ArrayLike, velocity: ArrayLike, speed: ArrayLike) -> Array:
        """Return the force of film and springs on centered circular orbits, shape (2, ...) [N].

        Parameters
        ----------
        position : array_like, shape (2, ...) [m]
        velocity : array_like, shape (2, ...) [m/s]
            Across the position, or 0.
        speed : array_like, shape (...) [rad/s]
            Of the rotor, without effect.

        Raises
        ------
        InputError
            If a motion is no centered circular orbit, whose force would need its past, or the supply is not
            the same all round.
        FilmContactError
            If the rotor touches the wall.
        """
        q, v, _ = broadcast_state(position, velocity, speed)
        columns = zip(q.reshape(2, -1).T, v.reshape(2, -1).T, strict=True)
        found = [self._force(*column) for column in columns]
        return np.array(found).T.reshape(q.shape) - self.stiffness * q

    def jacobian(self, position: ArrayLike, velocity: ArrayLike, speed: ArrayLike) -> Array:
        """Return d force / d (x, y, vx, vy, speed), shape (2, 5, ...), in slow motion about the orbit.

        Slow against a turn, in axes that turn with the orbit; about rotors at rest the film is full, and
        this is exact.

        Raises
        ------
        InputError, FilmContactError
            As `force`.
        """
        q, v, _ = broadcast_state(position, velocity, speed)
        columns = zip(q.reshape(2, -1).T, v.reshape(2, -1).T, strict=True)
        found = np.array([self._jacobian(*column) for column in columns])
        return np.moveaxis(found, 0, -1).reshape(2, 5, *q.shape[1:])

    def reynolds_force(self, position: ArrayLike, velocity: ArrayLike) -> Array:
        """Return the force of the same film with Reynolds' rupture, which makes the oil that it takes.

        Of the film alone, with its supply, on the same cells; for any motion, as it has no memory.

        Parameters
        ----------
        position, velocity : array_like, shape (2,) [m], [m/s]
        """
        q, v, _ = broadcast_state(position, velocity, 0.0)
        require_inside(q, self.clearance)
        gap = circular_gap(self.film.cells, q / self.clearance)
        closing = -(v / self.clearance) @ direction(self.film.cells.angle)
        return self.scaled.force * self.film.force(reynolds_state(self.film, gap, closing))

    def _turning(self, eccentricity_ratio: float, speed: float) -> ConservedState:
        """Return the film in axes that turn with the orbit, in which its wall carries the oil back."""
        if not self.supply.turns_alike:
            raise InputError(
                "feed_holes must be () for a steady orbit, as holes pass by once a turn; damper_turn finds "
                f"the periodic film, got {self.supply.feed_holes!r}"
            )
        gap = circular_gap(self.film.cells, np.array([eccentricity_ratio, 0.0]))
        return self.film.solve(gap, -speed)

    def _on_orbit(self, position: Array, velocity: Array) -> tuple[ConservedState, Array, float]:
        """Return the film of an orbit, the matrix whose columns are its axes, and its speed."""
        require_inside(position, self.clearance)
        e, v = float(np.hypot(*position)), float(np.hypot(*velocity))
        if abs(position @ velocity) > CIRCULAR * e * v or (e == 0.0 and v > 0.0):
            raise InputError(
                "velocity must be 0 or across the position, as on a centered circular orbit: the film "
                "remembers, and another motion needs its past (simulate, damper_turn), got velocity "
                f"{velocity.tolist()} at position {position.tolist()}"
            )
        radial = position / e if e > 0.0 else np.array([1.0, 0.0])
        axes = np.column_stack([radial, QUARTER @ radial])
        speed = float(axes[:, 1] @ velocity) / e if e > 0.0 else 0.0
        return self._turning(e / self.clearance, speed), axes, speed

    def _force(self, position: Array, velocity: Array) -> Array:
        state, axes, _ = self._on_orbit(position, velocity)
        return self.scaled.force * (axes @ self.film.force(state))

    def _jacobian(self, position: Array, velocity: Array) -> Array:
        """Return the slopes (2, 5) of F = F_0 - K r - C r', r in turning axes, by motion in axes at rest."""
        state, axes, speed = self._on_orbit(position, velocity)
        K, C = (self.scaled.force / self.clearance * part for part in slow_motion(self.film, state))
        by_position = axes @ (speed * C @ QUARTER - K) @ axes.T - self.stiffness * np.eye(2)
        return np.hstack([by_position, -axes @ C @ axes.T, np.zeros((2, 1))])
