"""Bearings of tilting pads in compiled code (`native/pads/tilting.h`), on NumPy arrays."""

from __future__ import annotations

from ctypes import addressof, byref, c_size_t, c_void_p
from typing import Any, NamedTuple

import numpy as np

from ..core.model import Array, Linearization
from .film_call import FilmCall, address_of
from .film_kernels import Batch, FilmKernel
from .library import loops
from .structs import structure

REST = ("tilt", "pivot", "load", "stiffness", "by_speed", "least", "unloaded")
"""The numbers of rf_tilting_rest."""

REMEMBERED = 16
"""Places of journals at rest of which the answers are kept."""


class TiltingPoint(NamedTuple):
    """Answers at one state.

    Attributes
    ----------
    rates : ndarray, shape (states,)
    outputs : ndarray, shape (2 + pads,)
        Force on the journal and loads of the pivots [N].
    slopes : Linearization or None
    status : int
    pad : int
        Place of the pad with the most severe status.
    """

    rates: Array
    outputs: Array
    slopes: Linearization | None
    status: int
    pad: int


class RestPoint(NamedTuple):
    """Answers at rest.

    Attributes
    ----------
    force : ndarray, shape (2,) [N]
    slopes : ndarray, shape (2, 5)
        Slopes by x, y, vx, vy, speed; those by the velocity are 0.
    pads : dict of str to ndarray, shape (pads,)
        Pads by the names of `REST`.
    status : int
    pad : int
        Pad as for a `TiltingPoint`.
    """

    force: Array
    slopes: Array
    pads: dict[str, Array]
    status: int
    pad: int


class TiltingKernel:
    """The forces of a bearing of equal tilting pads.

    Parameters
    ----------
    film : FilmKernel
        Film of one pad, in the frame of its middle.
    extent : float [rad]
        Extent of a pad.
    offset : float [1]
        Share of the extent before the pivot.
    pivots : ndarray, shape (pads,) [rad]
    preload : float [1]
    clearance : float [m]
        Clearance of a pad.
    force_scale : float [N s]
        viscosity * length * radius^3 / clearance^2.
    spring : float [N/m]
        Stiffness of a pivot, 0 for a rigid one.
    inertia : float [kg]
        Inertia about the pivot over the square of the distance from it to the film, 0 for none.
    mass : float [kg]
        What moves with a pivot on a spring, where there is inertia.
    """

    def __init__(
        self,
        film: FilmKernel,
        extent: float,
        offset: float,
        pivots: Array,
        preload: float,
        clearance: float,
        force_scale: float,
        spring: float = 0.0,
        inertia: float = 0.0,
        mass: float = 0.0,
    ) -> None:
        shape = film, extent, offset, pivots, preload
        self._arguments = (*shape, clearance, force_scale, spring, inertia, mass)
        self.film = film
        self.pads = len(pivots)
        self._directions = np.ascontiguousarray(np.stack([np.cos(pivots), np.sin(pivots)], axis=1))
        pad = structure("rf_tilting_pad")()
        loops()["rf_set_tilting_pad"](byref(pad), film.film, addressof(film.struct), extent, offset)
        place = self._directions.ctypes.data
        scales = preload, clearance, force_scale, spring, inertia, mass
        self.struct = structure("rf_tilting")(pad, self.pads, place, *scales)
        self.states = self.pads * (2 if spring > 0.0 else 1) * (2 if inertia > 0.0 else 1)
        self._reference = byref(self.struct)
        self._last: dict[tuple[float, ...], RestPoint] = {}

    def __reduce__(self) -> tuple[Any, ...]:
        return type(self), self._arguments

    def at(self, u: Array, x: Array, *, slopes: bool = False) -> TiltingPoint:
        """Return rates and outputs, and if asked for their derivatives, at an input (5,) and a state."""
        n, outputs = self.states, 2 + self.pads
        u, x = _floats(u), _floats(x)
        rates, answers, pad = np.empty(n), np.empty(outputs), c_size_t()
        by = [np.empty(shape) for shape in ((n, n), (n, 5), (outputs, n), (outputs, 5))] if slopes else []
        places = (c_void_p * 4)(*(one.ctypes.data for one in by)) if by else None
        given = [one.ctypes.data for one in (u, x, rates, answers)]
        status = loops()["rf_tilting_at"](self._reference, *given, places, byref(pad))
        return TiltingPoint(rates, answers, Linearization(*by) if by else None, status, pad.value)

    def at_rest(self, position: Array, speed: float) -> RestPoint:
        """Return the pads at rest under a journal at rest at a position (2,) [m].

        Force, slopes and pads are asked for one after the other: the last places are remembered.
        """
        key = (*position.tolist(), speed)
        found = self._last.get(key)
        if found is None:
            if len(self._last) >= REMEMBERED:
                self._last.clear()
            found = self._last[key] = self._rest(position, speed)
        return found

    def _rest(self, position: Array, speed: float) -> RestPoint:
        position, pad = _floats(position), c_size_t()
        force, slopes, rests = np.empty(2), np.empty((2, 5)), np.empty((self.pads, len(REST)))
        places = [one.ctypes.data for one in (force, slopes, rests)]
        status = loops()["rf_tilting_at_rest"](
            self._reference, position.ctypes.data, speed, *places, byref(pad)
        )
        for kept in (force, slopes, rests):
            kept.setflags(write=False)
        return RestPoint(force, slopes, dict(zip(REST, rests.T, strict=True)), status, pad.value)

    def call_with_states(self, beyond: str) -> FilmCall:
        """Return force and rates of the states over motion, speed and states, with what a `FilmCall` says."""
        return FilmCall(
            address_of("rf_tilting_moving"), addressof(self.struct), self, beyond, states=self.states
        )

    @property
    def still(self) -> FilmCall:
        """The force on a journal at rest."""
        return FilmCall(address_of("rf_tilting_still"), addressof(self.struct), self)

    def forces(self, u: Array, tilts: Array, rates: Array) -> Batch:
        """Return forces (2, n) at inputs (5, n) and given tilts and their rates, (pads, n) [m], [m/s]."""
        u, tilts, rates, first = _floats(u), _floats(tilts), _floats(rates), c_size_t()
        force = np.empty((2, u.shape[1]))
        places = [one.ctypes.data for one in (u, tilts, rates, force)]
        status = loops()["rf_tilting_forces"](self._reference, u.shape[1], *places, byref(first))
        return Batch(force, status, first.value)


def _floats(numbers: Array) -> Array:
    return np.ascontiguousarray(numbers, dtype=np.float64)
