"""A journal bearing whose film conserves its oil where it ruptures, in SI units."""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import cached_property
from typing import Any, ClassVar, Protocol, runtime_checkable

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ...core.errors import (
    InputError,
    require_finite,
    require_inside,
    require_kind,
    require_number,
    require_pair,
    require_positive,
    require_vector,
)
from ...core.inputs import arguments, quantities
from ...core.model import Array
from ...core.port import minimum_film
from ...core.readable import Drawable, Readable
from ...core.results import BearingLosses, ReducedCoefficients
from ...core.signals import Signal, journal_inputs
from ..films.geometry import FilmGeometry
from ..films.mass_conserving import (
    FILM,
    ConservedCells,
    ConservedFilm,
    ConservedState,
    Supply,
    conserved_cells,
    direction,
    warn_of_air,
)
from ..films.mass_conserving_steps import ConservedAtRest, FilmInMotion, MassConserving, ScaledFilm
from ..films.mobility import Mobility, require_mobility, require_no_mobility
from ..formulas import extrapolated_value
from ..oil import Cooling, Oil
from ..oil.heated_bearing import FilmHeat, SelfHeatedFilm, film_heat
from ..reaction import NOMINAL_SPEED
from .bearing import StaticFilm, fitted_bearing
from .moment_carrying_journal import TiltedJournal, kind_of
from .reynolds_film import ReynoldsFilm

# What a film that conserves its oil takes from the shaft, and its flows at openings.


def opening_flows(film: ConservedFilm, state: ConservedState) -> tuple[Array, Array]:
    """Return what leaves each opening, and what arrives there, by the faces around it (openings,) [1/s].

    Over clearance, radius and length; a face has one or the other. A groove all round is the last.
    """
    cells, equations = film.cells, state.equations
    P, theta, through = state.solution.pressure, state.solution.theta, equations.along * film.falls(state)
    after, onward = np.roll(cells.opening, -1, axis=0), cells.opening[:, 1:]
    upstream = np.roll(theta, -1, axis=0) if equations.backward else theta
    around = equations.wedge * upstream + equations.around * (P - np.roll(P, -1, axis=0))
    leaving, arriving = (np.zeros(len(equations.flow)) for _ in range(2))
    for flow, here, there in (
        (around, cells.opening, after),
        (through[:, 1:-1], cells.opening[:, :-1], onward),
        (np.maximum(through[:, -1:], 0.0), cells.opening[:, -1:], np.full_like(after[:, -1:], FILM)),
    ):
        for sign, own, other in ((1.0, here, there), (-1.0, there, here)):
            edge = (own != FILM) & (other != own)
            out = sign * flow[edge]
            leaving += np.bincount(own[edge], np.maximum(out, 0.0), len(leaving))
            arriving += np.bincount(own[edge], np.maximum(-out, 0.0), len(arriving))
    if not cells.grooved:
        return leaving, arriving
    given, taken = (np.maximum(sign * through[:, 0], 0.0).sum() for sign in (1.0, -1.0))
    return np.append(leaving, given), np.append(arriving, taken)


def opening_pressure(film: ConservedFilm, state: ConservedState) -> Array:
    """Return the pressure of each opening, that of a groove all round last (openings,) [1/s]."""
    opening, P = film.cells.opening, state.solution.pressure
    held = opening != FILM
    count = len(state.equations.flow)
    cells = np.bincount(opening[held], minlength=count)
    own = np.bincount(opening[held], np.maximum(P[held], 0.0), count) / cells
    return np.append(own, film.supply.center_pressure) if film.cells.grooved else own


# A journal bearing whose film conserves its oil where it ruptures, in SI units.


@runtime_checkable
class ArcBearing(Protocol):
    """A bearing whose wall are arcs, about its own center or each about one of its own, as `LobedBearing`.

    Pads that tilt are without tilt here, and `on_frozen` puts them on a film around all of them.
    """

    @property
    def clearance(self) -> float:
        """Radial clearance of the arcs [m]."""

    @property
    def cooled(self) -> tuple[Any, Any]:
        """Oil and cooling."""

    @property
    def geometry(self) -> FilmGeometry:
        """Arcs and openings."""

    def centers_at(self, angle: Array) -> Array | None:
        """Return centers of curvature at angles (N,) [rad] over the clearance, (2, N); None of one."""


AT_REST = np.eye(2)
"""Axes in which the film of a journal stands."""


@quantities
@dataclass(frozen=True, kw_only=True)
class JFOFilm(MassConserving, SelfHeatedFilm):
    """The film of a bearing with mass-conserving cavitation (Jakobsson, Floberg and Olsson).

    Behind the rupture the oil flows on in a partly filled gap, until there is enough oil to form a film
    again. So the film starts where oil is supplied, and not where Reynolds' rupture starts it: the supply by
    grooves, holes and pumps decides force, side flow and friction. The film depends on its past. Position and
    speed alone determine the force only for a journal at rest or in slow motion; in vibration, stiffness and
    damping depend on the frequency. `equilibrium` and `coefficients` take it like any bearing.

    Grid lines are fixed in the bearing and uniform between the edges of openings. On 144 x 10 cells the force
    has an error of 0.7 % up to the eccentricity ratio 0.9, in about 1 ms.

    Parameters
    ----------
    bearing : JournalBearing, LobedBearing, PressureDamBearing or TiltingPadBearing
        The bearing with its supply: short grooves, feed holes, a circumferential groove, or grooves over the
        whole length at ambient pressure. Gaps between pads are full of oil at ambient pressure. Its own film
        law is not used. With an oil and a cooling, `equilibrium` finds the film temperature too. Its
        turbulence acts on pressure flow and shear. In the cavity it acts on the part of the gap that is oil,
        with the factors of a full gap. Each tilting pad stands so that its film has no moment about the
        pivot. Tilting pads have no steps in time, and with a cavity below ambient pressure all must carry a
        load.
    cells : tuple of int
        Approximate numbers of lines around the film and of cells along half the length; even.
    supply_flow : float or None [m3/s]
        Oil flow into each opening, whose pressure then follows, or which starves; None for openings at the
        supply pressure of the bearing.
    cavitation_pressure : float [Pa]
        Gauge pressure in the cavity, not above 0.
    submerged : bool
        Whether there is oil around the ends, which they draw in where the film is below ambient pressure.
        Otherwise they would draw in air, and a warning says so.
    mobility : Mobility or None
        How easily the oil flows over the thickness of the film (`mobility_of`); None for laminar flow.

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

    bearing: Any
    cells: tuple[int, int] = (144, 10)
    supply_flow: float | None = None
    cavitation_pressure: float = 0.0
    submerged: bool = False
    mobility: Mobility | None = None

    def __post_init__(self) -> None:
        require_arcs(self.bearing)
        require_no_mobility(self.bearing, "JFOFilm")
        require_mobility(self.mobility)
        if self.mobility is not None and self.bearing.turbulence is not None:
            raise InputError(f"mobility must be None in a turbulent bearing, got {self.mobility!r}")
        self._require_fields(self.cavitation_pressure, self.submerged)
        if self.supply_flow is not None:
            require_positive("supply_flow", self.supply_flow)
        oil_supply(self.bearing, self.supply_flow, self.cavitation_pressure, self.submerged)

    @property
    def clearance(self) -> float:
        """Radial clearance of the bearing [m]; for pads the pad clearance."""
        clearance: float = self.bearing.clearance
        return clearance

    @property
    def minimum_film(self) -> Any:
        """The minimum film of bearings that compute it; a circular bore has no such attribute."""
        return self.bearing.minimum_film

    def require_film(self, position: Array) -> None:
        """Raise FilmContactError where the journal touches the wall at a position (2,) [m]."""
        if hasattr(self, "minimum_film"):
            self.bearing.require_film(position)
        else:
            require_inside(position, self.clearance)

    @cached_property
    def scaled(self) -> ScaledFilm:
        """The film without dimensions, its units, and what is beside it; see `ScaledFilm`."""
        return self.over()

    def over(self, *, whole: bool = False) -> ScaledFilm:
        """Return the film over half the length, or over the whole of it, as for a journal that tilts."""
        bearing = self.bearing
        bearing.require_temperature()
        supply = oil_supply(bearing, self.supply_flow, self.cavitation_pressure, self.submerged)
        cells = conserved_cells(bearing.geometry, *self.cells, whole=whole)
        film = ConservedFilm(
            cells._replace(wall=wall_of(bearing, cells)),
            bearing.slenderness,
            supply,
            mobility=bearing.turbulent_mobility or self.mobility,
            reynolds_scale=bearing.radius * bearing.clearance / bearing.film_viscosity,
        )
        # Openings that end in the bearing are at the supply.
        supplied = np.array([span.share < 1.0 for span in bearing.geometry.openings()], dtype=bool)
        pressed = self.supply_flow is None and (supplied.any() or bearing.geometry.circumferential)
        return ScaledFilm(
            film=film,
            radius=bearing.radius,
            clearance=bearing.clearance,
            viscosity=bearing.film_viscosity,
            area=bearing.radius * bearing.film_length,
            carrying=0.5,
            axial=0.5 * (bearing.length - bearing.film_length * (1.0 - film.cells.axial)),
            cavitation_pressure=self.cavitation_pressure,
            supplied=supplied,
            supply_pressure=supply_pressure(bearing) if pressed else None,
            supply_flow=self.supply_flow,
            pads=bearing.on_frozen(OilOnPads(self, film)) if tilts(bearing) else None,
        )

    @arguments
    def solve(self, position: ArrayLike, speed: float) -> JFOState:
        """Return the steady film of a journal at rest.

        Parameters
        ----------
        position : array_like, shape (2,) [m]
            Position of the journal's center.
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
        found = jfo_state(self, state, q)
        warn_of_air(self.submerged, found.drawn_in, found.side_flow)
        return found

    @arguments
    def complex_stiffness(self, position: ArrayLike, speed: float, s: complex) -> NDArray[np.complex128]:
        """Return K(s), shape (2, 2) [N/m]: -K q e^(s t) is the change of the force when the journal moves so.

        Parameters
        ----------
        position, speed : array_like, shape (2,) [m], and float [rad/s]
            Position and speed as in `solve`.
        s : complex [1/s]
            Growth rate + i frequency.
        """
        return self._stiffness(self._steady(position, speed)[1], s)

    def dynamic_stiffness(self, position: ArrayLike, speed: float) -> FilmInMotion:
        """Return K(s) and dK/ds about a journal at rest, as a function of s; see `core.port`."""
        return self.scaled.about(self._steady(position, speed)[1])

    @arguments
    def slow_coefficients(self, position: ArrayLike, speed: float) -> ReducedCoefficients:
        """Return K and C for motion that is slow compared with the flow through the cavity: K(0), dK/ds(0).

        Neither matrix is symmetric, and C may have a negative diagonal entry.

        Parameters
        ----------
        position, speed : array_like, shape (2,) [m], and float [rad/s]
            Position and speed as in `solve`.
        """
        q, state = self._steady(position, speed)
        K, C, _ = self.scaled.about(state).slow()
        return ReducedCoefficients(stiffness=K, damping=C, position=q, speed=float(speed), frequency=0.0)

    def at_place(self, position: Array, velocity: Array, speed: float) -> tuple[ConservedState, Array, float]:
        """Return the film of a journal at rest, in axes at rest; InputError unless the velocity is 0."""
        require_at_rest(velocity)
        self.require_film(position)
        film, place, pads = self.film, position / self.clearance, self.scaled.pads
        if pads is not None:
            film, place = pads.film.tilted(pads.eccentricity(position, speed)), np.zeros(2)
        return film.steady(place, 0.5 * speed), AT_REST, 0.0

    def at_temperature(self, temperature: float) -> JFOFilm:
        """Return this film at one temperature [K]; raises InputError if its bearing has no oil."""
        return replace(self, bearing=self.bearing.at_temperature(temperature))

    def at_rest(self) -> Any:
        """Return this film itself, whose force is that of a journal at rest, or the pads that tilt on it."""
        return self.scaled.pads if tilts(self.bearing) else self

    def losses(self, position: ArrayLike, velocity: ArrayLike, speed: float) -> BearingLosses:
        """Return power loss, torques and oil flow of a journal at rest, openings in the order of `inflow`.

        The power loss is the power of the shaft plus that of the supply pressure. The torque on the bush
        differs from that on the journal by the moment of the force.

        Parameters
        ----------
        position : array_like, shape (2,) [m]
        velocity : array_like, shape (2,) [m/s]
            Must be 0.
        speed : float [rad/s]

        Raises
        ------
        InputError, FilmContactError, ConvergenceError
            As `force`.
        """
        q, omega = require_pair("position", position), require_number("speed", speed)
        state, *_ = self.at_place(q, require_finite("velocity", velocity), omega)
        found = jfo_state(self, state, q)
        (inflow, arriving), pumped = self.supplied(state)
        torque, force = found.friction_torque, found.force
        return BearingLosses(
            power_loss=found.power_loss + pumped,
            friction_torque=torque,
            bush_torque=torque - float(q[0] * force[1] - q[1] * force[0]),
            side_flow=found.side_flow,
            inflow=inflow,
            arriving=arriving,
        )

    def supplied(self, state: ConservedState) -> tuple[tuple[Array, Array], float]:
        """Return the flows out of and into the openings [m3/s], and the power of the supply pressure [W].

        The flows are in the order of `opening_flows`.
        """
        film, scaled = self.film, self.scaled
        inflow, arriving = (scaled.oil * flow for flow in opening_flows(film, state))
        pressure = scaled.pressure * (opening_pressure(film, state) - film.supply.end_pressure)
        return (inflow, arriving), float(pressure @ (inflow - arriving))

    @property
    def is_warming(self) -> bool:
        """Whether the heat balance determines the temperature of the film."""
        return bool(self.bearing.is_warming)

    @property
    def cooled(self) -> tuple[Oil, Cooling]:
        """Oil and cooling of its bearing; raises InputError if one of them is not given."""
        found: tuple[Oil, Cooling] = self.bearing.cooled
        return found

    def coldest(self) -> float:
        """Return the lowest possible film temperature [K]; raises InputError without cooling."""
        return float(self.bearing.coldest())

    def balanced(self) -> None:
        """Return None, because no model finds the balance temperature at every state."""
        return

    def in_time(self, start_temperature: float | None = None) -> None:
        """Raise InputError: its temperature over time is not modeled."""
        raise InputError("film must be a law with a heat balance over time, such as MapFilm, got JFOFilm")

    def film_heat(self, position: ArrayLike, velocity: ArrayLike, speed: float) -> FilmHeat:
        """Return the heat of the film by the oil that leaves, enters, and returns to the openings.

        Parameters and errors are those of `losses`.
        """
        _, cooling = self.cooled
        found = film_heat(self.losses(position, velocity, speed), self.bearing.film_viscosity, cooling)
        # What arrives at an opening with a given flow cannot leave by it: all of it goes on.
        return found if self.supply_flow is None else found._replace(flow=found.side_flow)

    @property
    def reshapes(self) -> bool:
        """Whether the shape of the film depends on its viscosity; see `WarmBearing`."""
        is_fed = self.supply_flow is not None or supply_pressure(self.bearing) or self.cavitation_pressure
        return bool(is_fed or self.bearing.turbulence or self.mobility)

    def _steady(self, position: ArrayLike, speed: float) -> tuple[Array, ConservedState]:
        q, omega = require_pair("position", position), require_number("speed", speed)
        return q, self.at_place(q, np.zeros(2), omega)[0]


@quantities
@dataclass(frozen=True, kw_only=True)
class MomentCarryingJFOFilm(TiltedJournal, ConservedAtRest):
    """The film of a `JFOFilm` under a journal that tilts: a reaction to x, y, tilt_x and tilt_y.

    Gap, tilts and moments are those of `MomentCarryingJournal`. The film covers the whole length, with about
    twice the cells. As with `JFOFilm`, its force is that of a journal at rest, and stiffness and damping
    depend on the frequency.

    Parameters
    ----------
    film : JFOFilm
        Film of a bearing without a circumferential groove, at a given temperature.

    Raises
    ------
    InputError
        If the film is of another kind.

    Examples
    --------
    >>> from rotorfilm import Groove
    >>> top = Groove(center="90 deg", width="20 deg", length="40 mm")
    >>> size = dict(radius=0.05, length=0.05, clearance=1e-4, viscosity=0.02)
    >>> bearing = JournalBearing(**size, grooves=(top,), supply_pressure=2e5)
    >>> tilted = MomentCarryingJFOFilm(film=JFOFilm(bearing=bearing, cells=(72, 6)))
    >>> tilted.force([3e-5, -5e-5, 1e-4, 0.0], [0.0, 0.0, 0.0, 0.0], 314.0).shape
    (4,)
    """

    film: JFOFilm

    def __post_init__(self) -> None:
        require_kind("film", self.film, JFOFilm, "a JFOFilm")
        require_fixed(self.film)
        if self.bearing.geometry.circumferential:
            raise InputError(
                "film must be of a bearing without a circumferential groove, got a groove of "
                f"{self.bearing.circumferential_groove:g} m"
            )

    @property
    def bearing(self) -> Any:
        """The bearing of the film."""
        return self.film.bearing

    @cached_property
    def scaled(self) -> ScaledFilm:
        """The film over the whole length; see `ScaledFilm`."""
        return self.film.over(whole=True)

    @property
    def inputs(self) -> tuple[Signal, ...]:
        """Signals of places and tilts, of their rates, and the speed."""
        return journal_inputs(self.clearance, NOMINAL_SPEED, self.freedoms, self.arm)

    def least(self, place: Array) -> float:
        """Return the minimum film, in units of the clearance, at one displacement and tilt (e, tau)."""
        ends = np.stack([place[:2] + place[2:], place[:2] - place[2:]], axis=1)
        return float(np.min(minimum_film(self.film, self.clearance * ends))) / self.clearance

    def at_place(self, position: Array, velocity: Array, speed: float) -> tuple[ConservedState, Array, float]:
        """Return the film of a journal at rest, with the units of its forces and moments."""
        require_at_rest(velocity)
        self.require_film(position)
        film, scales = self.scaled.film, self._scales
        return film.steady(scales @ position, 0.5 * speed), self.clearance * scales.T, 0.0

    def dynamic_stiffness(self, position: ArrayLike, speed: float) -> FilmInMotion:
        """Return K(s) and dK/ds about a journal at rest, (4, 4), as a function of s; see `core.port`."""
        state, axes, _ = self.at_place(np.asarray(position, dtype=float), np.zeros(4), speed)
        return self.scaled.about(state, axes)

    def at_rest(self) -> MomentCarryingJFOFilm:
        """Return this film itself, because its force is that of a journal at rest."""
        return self


def require_arcs(bearing: object) -> None:
    """Raise InputError unless a bearing is one of arcs."""
    require_kind("bearing", bearing, ArcBearing, "a JournalBearing or a bearing of pads")


def require_fixed(film: JFOFilm) -> None:
    """Raise InputError where the pads of a film tilt."""
    if tilts(film.bearing):
        raise InputError(f"film must be of pads that do not tilt, got that of {kind_of(film.bearing)}")


def tilts(bearing: object) -> bool:
    """Return whether a bearing has pads that tilt on a film around all of them."""
    return hasattr(bearing, "on_frozen")


@dataclass(frozen=True, eq=False)
class OilOnPads:
    """The film around tilting pads as these ask for it: how it answers where each sees the journal.

    Parameters
    ----------
    reaction : JFOFilm
        The film with its pads.
    film : ConservedFilm
        The film of pads without tilt.
    """

    reaction: JFOFilm
    film: ConservedFilm
    frozen_at = None

    @property
    def cells(self) -> ConservedCells:
        """Cells of the film."""
        return self.film.cells

    @property
    def pulls(self) -> bool:
        """Whether pressures below ambient may hold a pad."""
        return self.film.supply.end_pressure > 0.0

    def tilted(self, eccentricity: Array) -> ConservedFilm:
        """Return the film whose lines see the journal at (2, N), in clearances, from pads without tilt."""
        cells: Any = self.cells
        return replace(self.film, cells=cells._replace(wall=cells.wall - wall_about(cells, eccentricity)))

    def responses(self, eccentricity: Array, squeeze: Array, speed: float, lines: Array) -> Array:
        """Return the force of each pad and its slopes, shape (P, 2, 6), as `FrozenFilm.responses`."""
        film = self.tilted(eccentricity)
        motion = FilmInMotion(film, film.solve(film.gap(squeeze), 0.5 * speed), parts=lines)
        K, C, by_speed = motion.slow()
        columns = motion.force()[:, None], -K, -C, by_speed[:, None]
        return np.hstack(columns).reshape(len(lines), 2, 6)


def supply_pressure(bearing: Any) -> float:
    """Return the gauge pressure in the openings of a bearing [Pa], 0 of gaps between pads."""
    return float(getattr(bearing, "supply_pressure", 0.0))


def wall_of(bearing: ArcBearing, cells: ConservedCells) -> Array | None:
    """Return the gap of the centered journal over the clearance, as of `ConservedCells.wall`."""
    centers = bearing.centers_at(cells.face)
    return None if centers is None else 1.0 + wall_about(cells, centers)


def wall_about(cells: ConservedCells, centers: Array) -> Array:
    """Return by how much centers of curvature (2, N), over the clearance, widen the gap, as of a wall."""
    rows = centers, np.roll(centers, 1, axis=1), centers
    angles = cells.face, cells.angle, cells.angle
    return np.array([np.sum(own * direction(at), axis=0) for own, at in zip(rows, angles, strict=True)])


def require_at_rest(velocity: Array) -> None:
    """Raise InputError unless the rates of a journal are 0."""
    if np.any(velocity):
        raise InputError(f"velocity must be 0 for a film that conserves its oil, got {velocity!r}")


# What a film that conserves its oil says at one place of the journal, in SI units.


@dataclass(frozen=True, eq=False, kw_only=True)
class JFOState(StaticFilm, Drawable):
    """The state of a mass-conserving film for a journal at rest; N lines with M cells on each.

    Attributes
    ----------
    axial : ndarray, shape (M,) [m]
        Middles of the cells, from the middle of the bearing to its end; the film is symmetric.
    pressure : ndarray, shape (N, M) [Pa]
        Gauge pressure; that of the cavity where the film has ruptured.
    oil_content : ndarray, shape (N, M) [1]
        Share of the gap that is oil: 1 in the film, less in the cavity.
    side_flow : float [m3/s]
        Oil that leaves through both ends.
    drawn_in : float [m3/s]
        Oil that enters through both ends, from around the bearing.
    inflow : ndarray, shape (openings,) [m3/s]
        Net oil flow out of each opening, in the order of `FilmGeometry.openings`; a circumferential groove is
        the last.
    friction_torque : float [N m]
        Torque about +z that keeps the journal turning, by the shear of the film and of the oil in the cavity,
        which forms strips across the gap; without the openings.
    power_loss : float [W]
        Power of the shaft that becomes heat: torque times speed.
    mass_defect : float [1]
        Error of the oil balance of the cells, relative to the oil that enters the film: roundoff.
    solutions : int
        Linear systems that were solved on these cells.
    newton_steps : int
        Steps of Newton's method, the fallback where the active-set search does not converge.
    """

    axial: Array
    pressure: Array
    oil_content: Array
    side_flow: float
    drawn_in: float
    inflow: Array
    friction_torque: float
    power_loss: float
    mass_defect: float
    solutions: int
    newton_steps: int


def jfo_state(film: JFOFilm, state: ConservedState, position: Array) -> JFOState:
    """Return a film in SI units, of a journal at a position [m]."""
    scaled, speed = film.scaled, 2.0 * state.rate
    torque = scaled.force * scaled.clearance * scaled.film.shear(state)
    return JFOState(
        position=position,
        speed=speed,
        force=scaled.force * scaled.film.force(state),
        friction_torque=torque,
        power_loss=torque * speed,
        newton_steps=state.solution.newton,
        **scaled.fields(state),
    )


# Where the oil of a journal bearing comes from, as a film that conserves it asks.


REMEDY = (
    "a groove or a feed hole (grooves=(Groove(...),) of the bearing), circumferential_groove (its width), or "
    "ends in an oil bath with a cavity below ambient (submerged=True, cavitation_pressure=-1e5)"
)


def oil_supply(
    bearing: Any, supply_flow: float | None, cavitation_pressure: float, submerged: bool
) -> Supply:
    """Return the supply of a film.

    Raises
    ------
    InputError
        If the bearing has no supply, or one that such a film cannot take; the message names the remedy.
    """
    openings, geometry = bearing.geometry.openings(), bearing.geometry
    end = -cavitation_pressure / bearing.pressure_scale
    if not (openings or geometry.circumferential or (submerged and end > 0.0)):
        raise InputError(
            f"bearing must have an oil supply, or a mass-conserving film runs dry: give {REMEDY}, got none"
        )
    _require_no_open_groove(bearing, supply_flow)
    _require_no_open_gap(bearing)
    count, flow = len(openings), 0.0
    if supply_flow is not None:
        _require_closed(bearing)
        flow = supply_flow / (bearing.clearance * bearing.radius * bearing.film_length)
    return Supply(
        pressure=np.array([end + (span.held or 0.0) for span in openings]),
        fed=np.full(count, supply_flow is not None),
        flow=np.full(count, flow),
        end_pressure=end,
        center_pressure=end + geometry.supply,
    )


def _require_no_open_groove(bearing: Any, supply_flow: float | None) -> None:
    """Raise InputError for a groove open at both ends of the bearing that is to have a pressure."""
    if bearing.geometry.grooves and (supply_pressure(bearing) > 0.0 or supply_flow is not None):
        raise InputError(
            "grooves with a supply must end within the bearing, or their flow is unlimited: give them a "
            f"length, as Groove(center=..., width=..., length={0.8 * bearing.length:g}), "
            f"got {bearing.geometry.grooves[0]!r}"
        )


def _require_no_open_gap(bearing: Any) -> None:
    """Raise InputError for a circumferential groove under pressure that opens into gaps between pads."""
    geometry = bearing.geometry
    if (
        geometry.circumferential
        and geometry.supply > 0.0
        and any(s.share == 1.0 for s in geometry.openings())
    ):
        raise InputError(
            "pads must have no gaps beside a circumferential_groove with a supply_pressure, which would flow "
            f"into them without limit, got {bearing.pads!r}"
        )


def _require_closed(bearing: Any) -> None:
    """Raise InputError unless every opening is one that can be given a flow."""
    if bearing.geometry.pads or not bearing.geometry.pockets or bearing.geometry.circumferential:
        raise InputError(
            "supply_flow must be None unless all openings of the bearing are grooves of a length or feed "
            f"holes, got {kind_of(bearing)}"
        )
    if bearing.supply_pressure > 0.0:
        raise InputError(
            f"supply_pressure must be 0 where supply_flow is given, got {bearing.supply_pressure!r}"
        )


# How much the conservation of oil matters in a bearing: Reynolds rupture beside it, on a coarse grid.


RUPTURE_CELLS = (36, 4), (72, 8)
"""Cells on which both films are solved; what they differ by is extrapolated from them, of second order."""


@dataclass(frozen=True, kw_only=True)
class RuptureError(Readable):
    """The error of Reynolds rupture, which does not conserve oil, against a mass-conserving film.

    Attributes
    ----------
    force_error : float [1]
        Distance of both forces, relative to the force of the mass-conserving film.
    side_flow_error, torque_error : float [1]
        Side flow and torque with Reynolds rupture, relative to those of the mass-conserving film, minus 1.
    """

    force_error: float
    side_flow_error: float
    torque_error: float


@arguments
def rupture_error(bearing: Any, position: ArrayLike, speed: float) -> RuptureError:
    """Return the error of Reynolds rupture in a bearing with its supply, for a journal at rest.

    Both films are solved on 36 x 4 and on 72 x 8 cells, and extrapolated. It is an estimate, not a bound:
    mostly within 25 % of the value on fine grids, nearly always within a factor of 2.

    Parameters
    ----------
    bearing : JournalBearing, LobedBearing or PressureDamBearing
        The bearing with its supply; its own film law is not used.
    position : array_like, shape (2,) [m]
        Position of the journal's center.
    speed : float [rad/s]
        Angular speed about +z.

    Raises
    ------
    InputError
        If the bearing has no supply or one that `JFOFilm` cannot take, as grooves under pressure that are
        open at both ends, or another argument breaks its rule; if the speed is 0, where nothing ruptures.
    FilmContactError
        If the journal touches the wall.
    ConvergenceError
        If the search for the cavity does not end.

    Examples
    --------
    >>> from rotorfilm import FeedHole, JournalBearing
    >>> size = dict(radius=0.05, length=0.05, clearance=1e-4, viscosity=0.02)
    >>> hole = FeedHole(center="90 deg", diameter="14 mm")
    >>> bearing = JournalBearing(**size, grooves=(hole,), supply_pressure=2e5)
    >>> rupture_error(bearing, position=[30e-6, -50e-6], speed=314.2).side_flow_error > 0.3
    True
    """
    require_arcs(bearing)
    if speed == 0.0:
        raise InputError("speed must not be zero for a film that ruptures, got 0.0")
    place, rest = require_vector("position", position), np.zeros(2)
    films = zip(*(both_films(bearing, cells) for cells in RUPTURE_CELLS), strict=True)
    reynolds, conserved = (
        extrapolated_value(_numbers(coarse, place, rest, speed), _numbers(fine, place, rest, speed))
        for coarse, fine in films
    )
    size = float(np.hypot(*conserved[:2]))
    if size == 0.0:
        raise InputError(f"position must be one where the film has a force, got {place!r}, where it has none")
    return RuptureError(
        force_error=float(np.hypot(*(reynolds - conserved)[:2])) / size,
        side_flow_error=float(reynolds[2] / conserved[2]) - 1.0,
        torque_error=float(reynolds[3] / conserved[3]) - 1.0,
    )


def _numbers(film: Any, place: Array, rest: Array, speed: float) -> Array:
    """Return the force (2,) [N], the side flow [m3/s] and the torque [N m]."""
    losses = film.losses(place, rest, speed)
    assert losses is not None  # of films on grids
    return np.array([*film.force(place, rest, speed), losses.side_flow, losses.friction_torque])


def both_films(bearing: Any, cells: tuple[int, int]) -> tuple[Any, JFOFilm]:
    """Return a bearing with Reynolds rupture and the film that conserves its oil, on the same cells.

    Raises
    ------
    InputError
        If the bearing has no supply, or one that cannot be.
    """
    conserved = JFOFilm(bearing=bearing, cells=cells)
    if bearing.centers_at(np.zeros(1)) is None:
        return fitted_bearing(bearing, ReynoldsFilm(cells=cells)), conserved
    return bearing.on_cells(*cells), conserved
