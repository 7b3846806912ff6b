"""What a film that conserves its oil takes from the shaft, its flows at openings, the balance of its heat."""

from __future__ import annotations

from typing import TYPE_CHECKING, Protocol, Self

import numpy as np
from numpy.typing import ArrayLike

from ....errors import InputError
from ....model import Array
from ....results import BearingLosses
from ...films.conserved.conserved_cells import FILM
from ...films.conserved.conserved_film import ConservedFilm, ConservedState
from ...oil import Cooling, Oil
from ...oil.heat_balance import FilmHeat, balance_temperature, fed_temperature, film_heat

if TYPE_CHECKING:
    from ..bearing import JournalBearing


class _Film(Protocol):
    """What `JFOHeat` is mixed into: see `JFOFilm`."""

    @property
    def bearing(self) -> JournalBearing: ...

    @property
    def film(self) -> ConservedFilm: ...

    @property
    def supply_flow(self) -> float | None: ...

    @property
    def cavitation_pressure(self) -> float: ...

    def at_temperature(self, temperature: float) -> Self: ...

    def losses(self, position: ArrayLike, velocity: ArrayLike, speed: float) -> BearingLosses: ...

    def _at_rest(
        self, position: ArrayLike, velocity: ArrayLike, speed: ArrayLike
    ) -> tuple[Array, ConservedState]: ...


class JFOHeat:
    """Losses of a `JFOFilm`, and the temperature of the oil of its bearing."""

    def losses(self: _Film, position: ArrayLike, velocity: ArrayLike, speed: float) -> BearingLosses:
        """Return power loss, torques and oil flow of a journal at rest, openings in the order of `inflow`.

        Parameters
        ----------
        position : array_like, shape (2,) [m]
        velocity : array_like, shape (2,) [m/s]
            Not but 0.
        speed : float [rad/s]

        Raises
        ------
        InputError, FilmContactError, ConvergenceError
            As `force`.
        """
        q, state = self._at_rest(position, velocity, speed)
        return film_losses(self.bearing, self.film, state, q)

    @property
    def is_warming(self: _Film) -> bool:
        """Whether the temperature of the film is left to the heat balance."""
        return self.bearing.is_warming

    @property
    def cooled(self: _Film) -> tuple[Oil, Cooling]:
        """Oil and cooling of its bearing; InputError if one of them is not given."""
        return self.bearing.cooled

    def coldest(self: _Film) -> float:
        """Return the temperature below which the film never gets [K]; raises InputError without cooling."""
        return self.bearing.coldest()

    def balanced(self) -> None:
        """Return None: nothing has the temperature of the balance at every state."""
        return

    def in_time(self) -> None:
        """Raise InputError: over time it has no temperature."""
        raise InputError("film must be a law with a heat balance over time, as MapFilm, got JFOFilm")

    def balanced_temperature(self: _Film, position: ArrayLike, velocity: ArrayLike, speed: float) -> float:
        """Return the temperature at which the heat of the film balances at one state [K].

        The oil that leaves, enters and comes back to the openings is what the film conserves.

        Parameters and errors are those of `losses`.
        """
        oil, cooling = self.bearing.cooled

        def heat(temperature: float) -> FilmHeat:
            film = self.at_temperature(temperature)
            found = film_heat(film.losses(position, velocity, speed), film.bearing.film_viscosity, cooling)
            # What arrives at an opening with a given flow cannot leave by it: all of it goes on.
            return found if self.supply_flow is None else found._replace(flow=found.side_flow)

        if self.bearing.supply_pressure == 0.0 and self.supply_flow is None and not self.cavitation_pressure:
            return balance_temperature(heat(cooling.coldest), oil, cooling)
        return fed_temperature(heat, oil, cooling)


def film_losses(
    bearing: JournalBearing, film: ConservedFilm, state: ConservedState, position: Array
) -> BearingLosses:
    """Return losses and flows of a steady film in SI units, those of a groove all round last.

    The power is that of the shaft and what the pressure of the openings puts in; the torque on the bush
    differs from that on the journal by the moment of the force.
    """
    speed, flow_unit = 2.0 * state.rate, bearing.clearance * bearing.radius * bearing.film_length
    torque = bearing.force_scale * bearing.clearance * film.shear(state)
    force = bearing.force_scale * film.force(state)
    inflow, arriving = (flow_unit * flow for flow in opening_flows(film, state))
    pressure = bearing.pressure_scale * (opening_pressure(film, state) - film.supply.end_pressure)
    return BearingLosses(
        power_loss=torque * speed + float(pressure @ (inflow - arriving)),
        friction_torque=torque,
        bush_torque=torque - float(position[0] * force[1] - position[1] * force[0]),
        side_flow=flow_unit * film.flows(state).out,
        inflow=inflow,
        arriving=arriving,
    )


def opening_flows(film: ConservedFilm, state: ConservedState) -> tuple[Array, Array]:
    """Return what leaves each opening, and what arrives there, by the faces around it (openings,) [1/s].

    Over clearance, radius and length; a face has one or the other. A groove all round is the last.
    """
    cells, equations = film.cells, state.equations
    P, theta, width = state.solution.pressure, state.solution.theta, cells.width
    after, onward = np.roll(cells.opening, -1, axis=0), cells.opening[:, 1:]
    upstream = np.roll(theta, -1, axis=0) if equations.backward else theta
    carried = equations.wedge * upstream
    around = (carried + equations.around * (P - np.roll(P, -1, axis=0))) * width
    along = equations.along[:, None] * equations.conductance[:, :-1] * (P[:, :-1] - P[:, 1:])
    leaving, arriving = (np.zeros(len(equations.flow)) for _ in range(2))
    for flow, here, there in ((around, cells.opening, after), (along, cells.opening[:, :-1], onward)):
        for sign, own, other in ((1.0, here, there), (-1.0, there, here)):
            edge = (own != FILM) & (other != own)
            out = sign * flow[edge]
            leaving += np.bincount(own[edge], np.maximum(out, 0.0), len(leaving))
            arriving += np.bincount(own[edge], np.maximum(-out, 0.0), len(arriving))
    ends = equations.along * equations.conductance[:, -1] * (P[:, -1] - equations.end_pressure)
    open_end = cells.opening[:, -1] != FILM
    leaving += np.bincount(cells.opening[open_end, -1], np.maximum(ends[open_end], 0.0), len(leaving))
    if not cells.grooved:
        return leaving, arriving
    center = equations.along * equations.center * (equations.center_pressure - P[:, 0])
    parts = (np.maximum(sign * center, 0.0).sum() for sign in (1.0, -1.0))
    both = (np.append(flow, part) for flow, part in zip((leaving, arriving), parts, strict=True))
    return next(both), next(both)


def opening_pressure(film: ConservedFilm, state: ConservedState) -> Array:
    """Return the pressure of each opening, that of a groove all round last (openings,) [1/s]."""
    opening, P = film.cells.opening, state.solution.pressure
    held = opening != FILM
    count = len(state.equations.flow)
    cells = np.bincount(opening[held], minlength=count)
    own = np.bincount(opening[held], np.maximum(P[held], 0.0), count) / cells
    return np.append(own, film.supply.center_pressure) if film.cells.grooved else own
