"""A film that conserves its oil with its temperature over it, or over and across it (T2 and T3)."""

from __future__ import annotations

from dataclasses import dataclass, field, replace
from functools import cached_property
from typing import NoReturn

import numpy as np
from numpy.typing import ArrayLike

from ...core.errors import InputError, require_kind
from ...core.inputs import quantities
from ...core.model import Array
from ..films.mass_conserving import (
    FILM,
    ConservedFilm,
    ConservedState,
    Fluidity,
    circular_gap,
    conserved_cells,
)
from .bearing import JournalBearing
from .energy_equation import AdiabaticWalls, MeanTemperature, Walls
from .film_flow import FilmFlow, film_weight, in_cells, through
from .heated_film import FilmProfile, FoundFilm, HeatedState, HeatRound, HeatRounds, state_fields
from .jfo_film import JFOFilm, jfo_state, opening_flows, opening_pressure


@dataclass(frozen=True, eq=False, kw_only=True)
class HeatedJFOState(HeatedState):
    """A film that conserves its oil with its temperature, for a journal at rest; `filled` is its oil content.

    Attributes
    ----------
    inflow, arriving : ndarray, shape (openings,) [m3/s]
        Oil that leaves each opening for the film, and that arrives there, in the order of
        `FilmGeometry.openings`; a circumferential groove is the last.
    opening_temperature : ndarray, shape (openings,) [K]
        Of what leaves it: the oil that arrives, as much as goes on, mixed with fresh oil.
    drawn_in : float [m3/s]
        Oil that enters through both ends, of the temperature of the supply.
    """

    inflow: Array
    arriving: Array
    opening_temperature: Array
    drawn_in: float


@quantities
@dataclass(frozen=True, kw_only=True)
class HeatedJFOFilm(HeatRounds):
    """The film of a `JFOFilm` with oil and cooling, its temperature a field.

    As `HeatedFilm`, but the heat goes with the oil that the film conserves: through film and cavity, out of
    the ends, and back to grooves, pockets and holes. There what arrives, less the share that the supply
    replaces, mixes with the fresh oil that the balance of the opening asks for. An opening with a given flow
    replaces none: all that arrives goes on with the oil of the pump.

    Parameters
    ----------
    film : JFOFilm
        Of a bearing with oil and cooling; of these it takes supply temperature and carry-over. What fills
        the cavity is known, so that `full_gap` has no part.
    walls : Walls
        `BushRing(...)`, `HeldWalls(...)`, or by default `AdiabaticWalls()`.
    profile : FilmProfile
        `MeanTemperature()`, or `LayeredTemperature(...)` for the temperature across the film too.

    Raises
    ------
    InputError
        If the bearing lacks oil or cooling, or another argument breaks its rule.

    Examples
    --------
    >>> from rotorfilm import Cooling, Groove, Oil
    >>> top = Groove(center="90 deg", width="20 deg", length="40 mm")
    >>> size = dict(radius=0.05, length=0.05, clearance=75e-6)
    >>> warm = dict(oil=Oil.iso_vg(46), cooling=Cooling(supply_temperature=318.15))
    >>> bearing = JournalBearing(**size, **warm, grooves=(top,), supply_pressure=2e5)
    >>> film = HeatedJFOFilm(film=JFOFilm(bearing=bearing, cells=(72, 8)))
    >>> state = film.solve(position=[20e-6, -30e-6], speed=314.2)
    >>> round(state.maximum_temperature - 273.15)
    78
    """

    film: JFOFilm
    walls: Walls = field(default_factory=AdiabaticWalls)
    profile: FilmProfile = field(default_factory=MeanTemperature)

    def __post_init__(self) -> None:
        require_kind("film", self.film, JFOFilm, "a JFOFilm of a bearing with oil and cooling")
        self._require_heat()

    @property
    def bearing(self) -> JournalBearing:
        """The bearing of the film."""
        return self.film.bearing

    def cold(self) -> FrozenJFOFilm:
        """Return the film of fresh oil."""
        return self._frozen(self._fresh())

    def frozen(self, position: ArrayLike, speed: float, temperature: ArrayLike) -> FrozenJFOFilm:
        """Return the film of the viscosity at a temperature [K], the same at all positions and speeds."""
        return self._frozen(np.broadcast_to(temperature, self._fresh().shape))

    def _shape(self) -> tuple[int, int]:
        lines, along = conserved_cells(self.bearing.geometry, *self.film.cells).opening.shape
        return lines, along

    def _round(
        self, position: Array, speed: float, temperature: Array, before: HeatedState | None, closing: bool
    ) -> HeatedJFOState:
        bearing, frozen = self.bearing, self._frozen(temperature)
        film = frozen.film
        cells, start = film.cells, np.roll(film.cells.face, 1)
        state = film.solve(circular_gap(cells, position / bearing.clearance), 0.5 * speed)
        seen = jfo_state(frozen.bearing, film, state, position, frozen.cavitation_pressure)
        flow_unit = bearing.clearance * bearing.radius * bearing.film_length
        inflow, arriving = (flow_unit * flow for flow in opening_flows(film, state))
        pressure = bearing.pressure_scale * (opening_pressure(film, state) - film.supply.end_pressure)
        flow = conserved_flow(film, state)
        heating = self._heating(cells.opening, flow, speed, temperature, closing)
        warm = self.profile.warm(
            heating._replace(
                walls=self._walls(start, cells.extent),
                carry_over=None if self.film.supply_flow is not None else heating.carry_over,
            )
        )
        found = FoundFilm(
            force=seen.force,
            angle=seen.angle,
            axial=seen.axial,
            pressure=seen.pressure,
            pumped=float(pressure @ (inflow - arriving)),
            side_flow=seen.side_flow,
        )
        rounds = 1 if before is None else before.rounds + 1
        done = HeatRound(position, speed, rounds, temperature, cells.opening, frozen, found, flow, warm)
        return HeatedJFOState(
            **state_fields(bearing, done),
            inflow=inflow,
            arriving=arriving,
            opening_temperature=self.supply_temperature + warm.openings,
            drawn_in=seen.drawn_in,
        )

    def _frozen(self, temperature: Array) -> FrozenJFOFilm:
        """Return the film of the viscosity that oil has at a temperature."""
        given = self.film
        return FrozenJFOFilm(
            bearing=given.bearing.at_temperature(self.supply_temperature),
            cells=given.cells,
            supply_flow=given.supply_flow,
            cavitation_pressure=given.cavitation_pressure,
            submerged=given.submerged,
            fluidity=self.profile.fluidity(self._viscosity(temperature)),
        )


# Where the oil of a film goes that conserves it: what `film_flow` has for Reynolds' rupture.


def conserved_flow(film: ConservedFilm, state: ConservedState) -> FilmFlow:
    """Return the flow of a steady film on N lines of M cells.

    All oil is that of the film's own balance: what openings give, what comes back to them, what is drawn in.
    The power of the pressure has in it what oil loses that strikes the start of a film, so that all of it is
    that of the shaft and of the supply, to roundoff.
    """
    cells, equations, (P, theta, full, *_) = film.cells, state.equations, state.solution
    opening = cells.opening != FILM
    upstream = np.roll(theta, -1, axis=0) if equations.backward else theta
    rise = np.roll(P, -1, axis=0) - P
    dragged = equations.wedge * upstream * cells.width
    pressed = -equations.around * rise * cells.width
    axial = equations.along[:, None] * equations.conductance * film.falls(state)
    axial[opening[:, -1], -1] = 0.0
    central = equations.along * equations.center * (equations.center_pressure - P[:, 0])
    from_groove = central if cells.grooved else None
    entering, leaving = through(dragged + pressed, axial, from_groove)
    weight = film_weight(full > 0, opening)
    struck = equations.wedge * (1.0 - upstream) * rise * cells.width
    power = in_cells(struck - pressed * rise, axial[:, :-1] * (P[:, :-1] - P[:, 1:]), weight)
    power[:, -1] += axial[:, -1] * (P[:, -1] - equations.end_pressure)
    power[:, 0] += central * (equations.center_pressure - P[:, 0])
    climbing = state.gap.face[:, None] * rise * cells.width
    return FilmFlow(
        dragged=dragged,
        pressed=pressed,
        axial=axial,
        entering=entering,
        leaving=leaving,
        filled=np.where(opening, 0.0, np.clip(theta, 0.0, 1.0)),
        full=(full > 0) & ~opening,
        shear=film.sheared_area(state),
        dissipation=12.0 * power,
        climb=in_cells(climbing, np.zeros((len(P), len(cells.width) - 1)), weight),
        central=from_groove,
    )


# The film that conserves its oil with a given viscosity field: `JFOFilm` at frozen temperature.


@dataclass(frozen=True, kw_only=True, eq=False)
class FrozenJFOFilm(JFOFilm):
    """A `JFOFilm` whose cells keep their viscosity: at rest, in vibration, and its losses.

    `start`, `step` and `native`, and so `simulate` and `export_fmu`, refuse it: they know one viscosity.

    Parameters
    ----------
    fluidity : Fluidity
        Of the oil in each cell, over that of the bearing.
    """

    fluidity: Fluidity

    @cached_property
    def film(self) -> ConservedFilm:
        """The film without dimensions; see `ConservedFilm`."""
        return replace(super().film, fluidity=self.fluidity)

    def at_temperature(self, temperature: float) -> NoReturn:
        """Raise InputError: the temperature of each cell is given already."""
        raise InputError(
            f"temperature must not be set on a film of frozen temperature, got {temperature!r}: "
            "take that of the JFOFilm"
        )
