"""Shear and flow of films in the C library, on NumPy arrays."""

from __future__ import annotations

from collections.abc import Mapping
from ctypes import addressof, byref, c_double, c_size_t
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from ..core.model import Array
from .film_call import FilmCall, address_of
from .film_kernels import JournalKernel, as_floats, taken
from .library import loops
from .structs import structure


class LossBatch(NamedTuple):
    """The answer for a batch.

    Attributes
    ----------
    losses : ndarray, shape (3, n)
        Sigma of the film, Sigma of the streamers, side flow.
    slopes : ndarray, shape (3, 4, n)
        Their derivatives by (eccentricity, source).
    status : int
        The most severe status.
    first : int
        The index of the first state that has it.
    """

    losses: Array
    slopes: Array
    status: int
    first: int


class LossKernel:
    """The losses of a film, an rf_loss of the C library.

    Parameters
    ----------
    tables : mapping of str to ndarray, optional
        Maps of shear and flow, as the C library reads them (`native/heat/loss_kernel.h`); without them the
        losses are those of the short-bearing film, whatever its length / diameter.

    Attributes
    ----------
    struct : ctypes.Structure or None
        What it reads.
    openings : bool
        Whether that is of a film with openings.
    tables : dict of str to ndarray
        What the kernels of bearings whose oil warms read of these losses.

    Raises
    ------
    ValueError
        If the tables are not finite or do not fit each other.
    """

    struct: Any = None

    def __init__(self, tables: Mapping[str, ArrayLike] | None = None) -> None:
        self.tables = as_floats(tables or {})
        self.openings = "loss_flows" in self.tables
        if self.tables:
            self.struct = taken(structure("rf_loss_map")(), "rf_take_losses", self.tables, self.openings)

    def __reduce__(self) -> tuple[Any, ...]:
        return type(self), (self.tables,)

    @property
    def address(self) -> int:
        """The address of its rf_loss."""
        return address_of("rf_map_losses" if self.tables else "rf_short_losses")

    def losses(self, eccentricity: Array, source: Array) -> LossBatch:
        """Return losses and slopes at the eccentricities and sources (2, n)."""
        e, w = (np.ascontiguousarray(rows, dtype=float) for rows in (eccentricity, source))
        losses, slopes, first = np.empty((3, e.shape[1])), np.empty((3, 4, e.shape[1])), c_size_t()
        data = None if self.struct is None else byref(self.struct)
        places = [rows.ctypes.data for rows in (e, w, losses, slopes)]
        status = loops()["rf_loss_batch"](self.address, data, e.shape[1], *places, byref(first))
        return LossBatch(losses, slopes, status, first.value)

    def flows(self, eccentricity: Array, rate: Array) -> Array:
        """Return flows out of the openings and into them, (2, openings, n), at half the speeds (n,)."""
        e, along = (np.ascontiguousarray(rows, dtype=float) for rows in (eccentricity, rate))
        found = np.empty((2, self.struct.openings, e.shape[1]))
        places = [rows.ctypes.data for rows in (e, along, found)]
        loops()["rf_groove_flows"](byref(self.struct), e.shape[1], *places)
        return found


# A film at every state at the temperature at which its heat balances, in the C library.


_Pair, _Five, _Ten = c_double * 2, c_double * 5, c_double * 10


class OilTable(NamedTuple):
    """ln viscosity [ln Pa s] of an oil as quintic splines over its temperature.

    Attributes
    ----------
    coefficients : ndarray, shape (cells + 5,)
    coldest, hottest : float [K]
        Between these it is known; beyond, it goes on as an exponential.
    """

    coefficients: Array
    coldest: float
    hottest: float


class BalancedBatch(NamedTuple):
    """The answer for a batch.

    Attributes
    ----------
    force : ndarray, shape (2, n) [N]
    temperature : ndarray, shape (n,) [K]
    jacobian : ndarray, shape (10, n)
        d force / d (x, y, vx, vy, speed), row by row.
    status : int
        The most severe status.
    first : int
        The index of the first state that has it.
    """

    force: Array
    temperature: Array
    jacobian: Array
    status: int
    first: int


class BalancedKernel:
    """A journal's film at the temperature of its heat balance, in SI units.

    Parameters
    ----------
    journal : JournalKernel
        The film at unit viscosity.
    losses : LossKernel
    oil : OilTable
    numbers : mapping of str to float
        radius, length, clearance [m], supply, ambient [K], conductance [W/K], volumetric_heat [J/(m3 K)],
        carry_over, full_gap.
    """

    def __init__(
        self, journal: JournalKernel, losses: LossKernel, oil: OilTable, numbers: Mapping[str, float]
    ) -> None:
        self._arguments = (journal, losses, oil, dict(numbers))
        self.film = journal.film
        ln = np.ascontiguousarray(oil.coefficients, dtype=float)
        self._kept = ln, journal, losses
        table = structure("rf_oil")(len(ln) - 5, ln.ctypes.data, oil.coldest, oil.hottest)
        data = None if losses.struct is None else addressof(losses.struct)
        openings = data if losses.openings else None
        self._struct = structure("rf_heated")(
            journal=journal.struct, loss=losses.address, loss_data=data, openings=openings, oil=table
        )
        for name, value in numbers.items():
            setattr(self._struct, name, int(value) if name == "full_gap" else value)
        self._reference = byref(self._struct)
        self._at, self._heat = loops()["rf_balanced_at"], loops()["rf_heat_at"]

    def __reduce__(self) -> tuple[Any, ...]:
        return type(self), self._arguments

    def warming(self, capacity: float, beyond: str) -> FilmCall:
        """Return force and rate of the temperature over motion, speed and temperature (`rf_warming_at`).

        Parameters
        ----------
        capacity : float [J/K]
            Heat capacity of film and bush.
        beyond : str
            As that of a `FilmCall`.
        """
        struct = structure("rf_warming")(film=self._struct, per_capacity=1.0 / capacity)
        return FilmCall(address_of("rf_warming_at"), addressof(struct), (struct, self), beyond, states=1)

    def tangent(
        self, x: float, y: float, vx: float, vy: float, speed: float
    ) -> tuple[float, float, list[float], float, int]:
        """Return force_x, force_y, the ten entries of the Jacobian, the temperature, and a status."""
        pair, ten, temperature = _Pair(), _Ten(), c_double()
        state = _Five(x, y, vx, vy, speed)
        status = self._at(self._reference, state, pair, ten, byref(temperature))
        return pair[0], pair[1], ten[:], temperature.value, status

    def heat(self, state: list[float]) -> tuple[Any, int]:
        """Return an rf_heat at x, y, vx, vy, speed, which is at unit viscosity, and a status."""
        heat = structure("rf_heat")()
        return heat, self._heat(self._reference, _Five(*state), byref(heat), None)

    def heat_slopes(self, state: list[float]) -> tuple[Any, Any, int]:
        """Return an rf_heat and its rf_heat_slopes at unit viscosity, and a status."""
        heat, slopes = structure("rf_heat")(), structure("rf_heat_slopes")()
        return heat, slopes, self._heat(self._reference, _Five(*state), byref(heat), byref(slopes))

    def batch(self, states: Array, *, slopes: bool = True) -> BalancedBatch:
        """Return forces, temperatures and Jacobians of states x, y, vx, vy, speed, shape (5, n)."""
        states = np.ascontiguousarray(states, dtype=float)
        n, first = states.shape[1], c_size_t()
        force, temperature, jacobian = np.empty((2, n)), np.empty(n), np.empty((10, n))
        places = (rows.ctypes.data for rows in (states, force, temperature))
        slope = jacobian.ctypes.data if slopes else None
        status = loops()["rf_balanced_batch"](self._reference, n, *places, slope, byref(first))
        return BalancedBatch(force, temperature, jacobian, status, first.value)
