"""The temperature of the oil in a film: cell by cell, openings that mix, bush and journal.

Temperatures are above that of the supply [K]; flows of oil and heat are in units of clearance x radius x
length/2, that is in 1/s and K/s.
"""

from __future__ import annotations

from ctypes import byref
from dataclasses import dataclass
from typing import Any, ClassVar, NamedTuple

import numpy as np

from ...core.errors import (
    ConvergenceError,
    InputError,
    require_count,
    require_each,
    require_non_negative,
    require_positive,
)
from ...core.inputs import quantities
from ...core.model import Array
from ...native.library import loops
from ...native.structs import structure
from ..films.mass_conserving import Fluidity, contiguous
from .film_flow import FilmFlow

# What holds a warm film: walls without heat, of given temperature, or a bush that conducts it away.


HARMONICS = 256
"""Waves around the bush that its temperature is made of."""


class WallResponse(NamedTuple):
    """How warm the walls of N cells get from the heat that they take.

    Bush: T = mean + spread q, with give (mean - ambient) = take x sum of q, q [W/m] in each cell per length
    of the bearing. Journal: of one temperature, shaft_give (T - shaft_ambient) = shaft_take x its heat [W].

    Attributes
    ----------
    spread : ndarray, shape (N, N) [K m/W]
    give : float [W/(m K)]
    take : float [1]
    ambient : float [K]
    shaft_give : float [W/K]
    shaft_take : float [1]
    shaft_ambient : float [K]
    """

    spread: Array
    give: float
    take: float
    ambient: float
    shaft_give: float
    shaft_take: float
    shaft_ambient: float


@dataclass(frozen=True)
class AdiabaticWalls:
    """Bush and journal that take no heat: all of it leaves with the oil."""

    def response(self, radius: float, start: Array, extent: Array) -> None:
        """Return None: no heat makes the walls warmer."""


@quantities
@dataclass(frozen=True, kw_only=True)
class HeldWalls:
    """Bush and journal at given temperatures.

    Parameters
    ----------
    bush_temperature, journal_temperature : float [K]
        At the bore, all round, and of the journal.
    """

    bush_temperature: float
    journal_temperature: float

    def __post_init__(self) -> None:
        require_each(self, require_positive, "bush_temperature", "journal_temperature")

    def response(self, radius: float, start: Array, extent: Array) -> WallResponse:
        """Return that heat changes nothing; see `BushRing.response`."""
        spread = np.zeros((len(start), len(start)))
        return WallResponse(spread, 1.0, 0.0, self.bush_temperature, 1.0, 0.0, self.journal_temperature)


@quantities
@dataclass(frozen=True, kw_only=True)
class BushRing:
    """A bush that conducts heat around and outwards, and a journal of one temperature.

    The bush is a ring of the bearing's length in which heat flows around and along the radius. Of a
    temperature cos(n theta) at its bore it takes the flux D_n cos(n theta), exactly,

        1/D_0 = r ln(r_o/r)/k + r/(r_o h),   D_n = (k n/r) (1 - s q)/(1 + s q),
        s = (n - Bi)/(n + Bi),   Bi = h r_o/k,   q = (r/r_o)^(2n).

    Parameters
    ----------
    outer_radius : float [m]
        r_o, above the bearing's radius r.
    conductivity : float [W/(m K)]
        k of the bush; 50 of steel.
    transfer : float [W/(m2 K)]
        h from the outside of the bush to its surroundings; 0 insulates it.
    ambient_temperature : float [K]
        Of the surroundings.
    shaft_conductance : float [W/K]
        Heat that the shaft carries off from the bearing, per kelvin above the surroundings; 0 if nothing is
        known, so that the journal is as warm as makes its net heat zero.

    Raises
    ------
    InputError
        If a parameter breaks its rule.
    """

    outer_radius: float
    conductivity: float = 50.0
    transfer: float = 80.0
    ambient_temperature: float = 303.15
    shaft_conductance: float = 0.0

    def __post_init__(self) -> None:
        require_each(self, require_positive, "outer_radius", "conductivity", "ambient_temperature")
        require_each(self, require_non_negative, "transfer", "shaft_conductance")

    def mean_transfer(self, radius: float) -> float:
        """Return D_0 [W/(m^2 K)], the heat per area of the bore and kelvin above the surroundings."""
        resistance = radius * np.log(self.outer_radius / radius) / self.conductivity
        outside = self.transfer * self.outer_radius / radius
        return float(outside / (1.0 + resistance * outside))

    def wave_transfer(self, radius: float, waves: Array) -> Array:
        """Return D_n [W/(m^2 K)] of n = 1, 2, ... waves around the bore, of their shape."""
        biot = self.transfer * self.outer_radius / self.conductivity
        sq = (waves - biot) / (waves + biot) * (radius / self.outer_radius) ** (2.0 * waves)
        return np.asarray(self.conductivity * waves / radius * (1.0 - sq) / (1.0 + sq))

    def response(self, radius: float, start: Array, extent: Array) -> WallResponse:
        """Return how warm the bush gets, by means over the cells.

        Parameters
        ----------
        radius : float [m]
            Of the bearing.
        start, extent : ndarray, shape (N,) [rad]
            Cells around the film.
        """
        if self.outer_radius <= radius:
            raise InputError(
                f"outer_radius must be above the bearing's radius {radius!r}, got {self.outer_radius!r}"
            )
        n = np.arange(1.0, HARMONICS + 1.0)
        before, after = (_waves(angle, HARMONICS) for angle in (start, start + extent))
        size = n * np.sqrt(np.pi * radius * self.wave_transfer(radius, n))
        mean = (after - before) / (extent[:, None] * size)
        parts = np.hstack([mean.real, mean.imag])
        spread = parts @ parts.T
        give = 2.0 * np.pi * radius * self.mean_transfer(radius)
        shaft = self.shaft_conductance, 1.0, self.ambient_temperature
        return WallResponse(spread, give, 1.0, self.ambient_temperature, *shaft)


def _waves(angle: Array, count: int) -> Array:
    """Return exp(i n angle), n = 1, 2, ..., of angles (N,), shape (N, count)."""
    return np.cumprod(np.repeat(np.exp(1j * angle)[:, None], count, axis=1), axis=1)


Walls = AdiabaticWalls | HeldWalls | BushRing
"""The bush around a film and the journal in it, as the heat of the film sees them."""


# The heat in a film, in compiled code (`native/heat/energy.h`).


class Heating(NamedTuple):
    """What warms and cools the oil of one film.

    Attributes
    ----------
    opening : ndarray of int, shape (N, M)
        Opening of a cell, -1 in film.
    flow : FilmFlow
    speed : float [rad/s]
    viscosity : ndarray, shape (N, M, ...) [1]
        Over that of the bearing; a last axis is that of layers.
    thinning : ndarray, shape (N, M, ...) [1/K]
        By which heat falls as the oil warms; 0 to hold it.
    temperature : ndarray, shape (N, M, ...) [K]
        At which the oil has this viscosity, above that of the supply.
    heat_scale : float [K s]
        Viscosity of the bearing radius^2/(volumetric heat clearance^2).
    diffusion : float [1/s]
        Conductivity of the oil/(volumetric heat clearance^2).
    carry_over : float or None [1]
        Share of the oil that reaches an opening and clings to the shaft; None where none can leave there.
    walls : WallResponse or None
        None for walls that take no heat; in the units of the equations, ambients above the supply.
    """

    opening: np.ndarray
    flow: FilmFlow
    speed: float
    viscosity: Array
    thinning: Array
    temperature: Array
    heat_scale: float
    diffusion: float
    carry_over: float | None
    walls: WallResponse | None

    @property
    def openings(self) -> int:
        """Openings, that all round at mid-length the last."""
        return int(self.opening.max()) + 1 + (self.flow.central is not None)


class HeatSolution(NamedTuple):
    """Temperatures above that of the supply [K], and where the heat goes [K/s].

    Attributes
    ----------
    oil : ndarray, shape (N, M, ...) [K]
        In openings that of the mixed oil.
    openings : ndarray, shape (openings,) [K]
        Of that oil.
    bush : ndarray, shape (N,), or None [K]
    journal : float or None [K]
        Of the walls; None of those that take no heat.
    heat : ndarray, shape (N, M, ...) [K/s]
        Of shear and pressure in each cell.
    made : float [K/s]
        All of it.
    leaked : float [K/s]
        With the oil that leaves the film sideways.
    drained : float [K/s]
        With the oil that leaves through the openings, less what they give back to the film.
    to_bush, to_journal : float [K/s]
    """

    oil: Array
    openings: Array
    bush: Array | None
    journal: float | None
    heat: Array
    made: float
    leaked: float
    drained: float
    to_bush: float
    to_journal: float


class FilmProfile:
    """What a film knows of the temperature across it: a number of `layers`, each with its own velocity.

    With q the flow per length, alpha the share of the gap that oil fills and h the thickness, one layer is

        C div(q T) = mu U^2 alpha/h + h^3 |grad p|^2/(12 mu) - (k alpha/h) (12 T - 6 T_bush - 6 T_journal),

    of which (k alpha/h) (6 T - 4 T_bush - 2 T_journal) goes into the bush, and several are (Dowson, 1962)

        C (u T_x + u_z T_z + u_y T_y) = k T_yy + mu (u_y^2 + u_z,y^2)

    with the flow of the pressure itself shared by the layers as their viscosities have it, u_y from the
    balance of each layer, and the walls by one-sided differences of second order. Fluxes are those of the
    pressure itself, upwind: heat is accounted for to the last digit on any grid.
    """

    layers: int

    def shape(self, cells: tuple[int, int]) -> tuple[int, ...]:
        """Return the shape of a temperature of cells (N, M)."""
        return cells if self.layers == 1 else (*cells, self.layers)

    def fluidity(self, viscosity: Array) -> Fluidity:
        """Return how easily oil of a relative viscosity, of `shape`, flows."""
        shares = layer_shares(1.0 / viscosity.reshape(*viscosity.shape[:2], self.layers))
        return Fluidity(12.0 * shares.F2, shares.dragged.sum(axis=-1), 1.0 / shares.F0)

    def warm(self, heating: Heating) -> HeatSolution:
        """Return the temperature of a film, from one linear system.

        Raises
        ------
        ConvergenceError
            If it is singular.
        """
        walls, lines = heating.walls, len(heating.opening)
        struct, kept = _struct(heating, self.layers)
        oil, heat = np.empty(heating.viscosity.shape), np.empty(heating.viscosity.shape)
        openings, bush, account = np.zeros(heating.openings), np.empty(lines), structure("rf_heat_account")()
        places = [answer.ctypes.data for answer in (oil, openings, bush, heat)]
        status = loops()["rf_solve_energy"](byref(struct), *places, byref(account))
        del kept
        if status:
            raise ConvergenceError(f"the heat of a film must have a solution, got status {status}")
        names = ("made", "leaked", "drained", "to_bush", "to_journal")
        return HeatSolution(
            oil=oil,
            openings=openings,
            bush=None if walls is None else bush,
            journal=None if walls is None else account.journal,
            heat=heat,
            **{name: getattr(account, name) for name in names},
        )


@dataclass(frozen=True)
class MeanTemperature(FilmProfile):
    """One temperature across the film, a parabola between the walls with that mean; see `FilmProfile`."""

    layers: ClassVar[int] = 1


@quantities
@dataclass(frozen=True)
class LayeredTemperature(FilmProfile):
    """The temperature in layers of equal share of the gap, each with its own velocity; see `FilmProfile`.

    Parameters
    ----------
    layers : int
        At least 2; 8, 12 and 24 differ by less than 0.5 % in eccentricity and rise.
    """

    layers: int = 12

    def __post_init__(self) -> None:
        require_count("layers", self.layers, 2)


def _struct(heating: Heating, layers: int) -> tuple[Any, list[Array]]:
    """Return an rf_energy, and what it points to."""
    flow, walls = heating.flow, heating.walls or WallResponse(np.zeros((0, 0)), *(0.0,) * 6)
    names = ("dragged", "pressed", "axial", "entering", "leaving", "shear", "dissipation", "climb", "central")
    fields = [getattr(flow, name) for name in names]
    fields += [heating.viscosity, heating.thinning, heating.temperature, walls.spread]
    kept = [np.zeros(0) if field is None else contiguous(field) for field in fields]
    opening = np.ascontiguousarray(heating.opening, dtype=np.int32)
    *places, spread = (None if of is None else its.ctypes.data for of, its in zip(fields, kept, strict=True))
    struct = structure("rf_energy")(
        *opening.shape,
        layers,
        heating.openings,
        heating.walls is not None,
        heating.speed < 0.0,
        opening.ctypes.data,
        *places,
        heating.speed,
        heating.heat_scale,
        heating.diffusion,
        -1.0 if heating.carry_over is None else heating.carry_over,
        spread,
        *walls[1:],
    )
    return struct, [*kept, opening]


class LayerShares(NamedTuple):
    """Integrals over layers of equal share of the gap, of oil of fluidity f across it, eta = 0 at the bush.

    With F_0 = int f, F_1 = int f eta, y = F_1/F_0 and F_2 = int f eta (eta - y), and u = U int_0^eta f/F_0 +
    h^2 p_x int_0^eta f (eta' - y).

    Attributes
    ----------
    F0, F2 : ndarray, shape (N, M + 1)
    dragged : ndarray, shape (N, M + 1, K)
        Flow of each layer over U h where the journal drags; its sum is 1 - y.
    pressed : ndarray, shape (N, M + 1, K)
        Flow of each layer over -h^3 p_x; its sum is F_2.
    sheared : ndarray, shape (N, M + 1, K)
        Share of the heat of the drag; its sum is 1.
    squeezed : ndarray, shape (N, M + 1, K)
        Share of the heat of the pressure; its sum is 1.
    crossed : ndarray, shape (N, M + 1, K)
        Share of U h p_x of half the heat of both together; its sum is 0.
    """

    F0: Array
    F2: Array
    dragged: Array
    pressed: Array
    sheared: Array
    squeezed: Array
    crossed: Array


def layer_shares(fluidity: Array) -> LayerShares:
    """Return the shares of layers of a fluidity 1/viscosity (N, M + 1, K) [any unit]."""
    f, (lines, cells, layers) = contiguous(fluidity), fluidity.shape
    shares = LayerShares(*np.empty((2, lines, cells)), *np.empty((5, *fluidity.shape)))
    places = [field.ctypes.data for field in (f, *shares)]
    loops()["rf_layer_shares"](lines * cells, layers, *places)
    return shares
