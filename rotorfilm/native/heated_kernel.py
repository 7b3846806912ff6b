"""A film at every state at the temperature at which its heat balances, in the C library."""

from __future__ import annotations

from collections.abc import Mapping
from ctypes import addressof, byref, c_double, c_size_t
from typing import Any, NamedTuple

import numpy as np

from ..model import Array
from .heat_structs import HeatedStruct, HeatSlopesStruct, HeatStruct, OilStruct
from .library import loops
from .loss_kernels import LossKernel
from .response_kernels import JournalKernel

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
        table = OilStruct(len(ln) - 5, ln.ctypes.data, oil.coldest, oil.hottest)
        data = None if losses.struct is None else addressof(losses.struct)
        openings = data if losses.openings else None
        self._struct = HeatedStruct(
            journal=journal.struct, loss=losses.address, loss_data=data, openings=openings, oil=table
        )
        for name, value in numbers.items():
            setattr(self._struct, name, int(value) if name == "full_gap" else value)
        self._reference = byref(self._struct)
        self._at, self._heat = loops()["rf_balanced_at"], loops()["rf_heat_at"]

    def __reduce__(self) -> tuple[Any, ...]:
        return type(self), self._arguments

    def tangent(
        self, x: float, y: float, vx: float, vy: float, speed: float
    ) -> tuple[float, float, list[float], float, int]:
        """Return force_x, force_y, the ten entries of the Jacobian, the temperature, and a status."""
        pair, ten, temperature = _Pair(), _Ten(), c_double()
        state = _Five(x, y, vx, vy, speed)
        status = self._at(self._reference, state, pair, ten, byref(temperature))
        return pair[0], pair[1], ten[:], temperature.value, status

    def heat_slopes(self, state: list[float]) -> tuple[Array, int]:
        """Return d(power, effective flow, side flow)/d state at unit viscosity, (3, 5), and a status."""
        heat, slopes = HeatStruct(), HeatSlopesStruct()
        status = self._heat(self._reference, _Five(*state), byref(heat), byref(slopes))
        return np.array([slopes.drag, slopes.flow, slopes.leak]), status

    def batch(self, states: Array, *, slopes: bool = True) -> BalancedBatch:
        """Return forces, temperatures and Jacobians of states x, y, vx, vy, speed, shape (5, n)."""
        states = np.ascontiguousarray(states, dtype=float)
        n, first = states.shape[1], c_size_t()
        force, temperature, jacobian = np.empty((2, n)), np.empty(n), np.empty((10, n))
        places = (rows.ctypes.data for rows in (states, force, temperature))
        slope = jacobian.ctypes.data if slopes else None
        status = loops()["rf_balanced_batch"](self._reference, n, *places, slope, byref(first))
        return BalancedBatch(force, temperature, jacobian, status, first.value)
