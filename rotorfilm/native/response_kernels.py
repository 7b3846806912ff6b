"""Forces in SI units of the C library: a state of five numbers in, a force and its derivatives out."""

from __future__ import annotations

from collections.abc import Sequence
from ctypes import addressof, byref, c_double, c_void_p, cast
from typing import Any, ClassVar, NamedTuple

import numpy as np

from ..model import Array
from .film_kernels import Batch, FilmKernel, as_rows, row_places, run_batch
from .library import functions, loops
from .pad_structs import LobesStruct, LobeStruct
from .structs import JournalStruct

_Pair, _Five, _Ten = c_double * 2, c_double * 5, c_double * 10


class ResponseKernel:
    """A force [N] on a journal at (x, y, vx, vy, speed) [m, m/s, rad/s].

    Attributes
    ----------
    function : str
        Its rf_response (`native/films/film.h`).
    struct : ctypes.Structure
        What that reads.
    film : FilmKernel
        Its film, or that of its first pad.
    """

    function: ClassVar[str]
    film: FilmKernel
    _arguments: tuple[Any, ...]
    struct: Any

    def __init__(self) -> None:
        self._reference = byref(self.struct)
        self._tangent = {**functions(), **loops()}[self.function]
        self._address = cast(self._tangent, c_void_p).value
        self._call = functions()["rf_response_call"]

    def __reduce__(self) -> tuple[Any, ...]:
        return type(self), self._arguments

    def call(self, x: float, y: float, vx: float, vy: float, speed: float) -> tuple[float, float, int]:
        """Return (force_x, force_y, status) for numbers."""
        pair = _Pair()
        status = self._call(self._address, self._reference, x, y, vx, vy, speed, pair)
        return pair[0], pair[1], status

    def tangent(
        self, x: float, y: float, vx: float, vy: float, speed: float
    ) -> tuple[float, float, list[float], int]:
        """Return force_x, force_y, the ten entries of the Jacobian row by row, and a status."""
        pair, ten = _Pair(), _Ten()
        status = self._tangent(self._reference, _Five(x, y, vx, vy, speed), pair, ten)
        return pair[0], pair[1], ten[:], status

    def force(self, position: Array, velocity: Array, speed: Array) -> Batch:
        """Return the forces (2, n) at positions, velocities (2, n) and speeds (n,) or (1,)."""
        return self._batch(position, velocity, speed, ())

    def jacobian(self, position: Array, velocity: Array, speed: Array) -> Batch:
        """Return d force / d (x, y, vx, vy, speed), shape (2, 5, n)."""
        return self._batch(position, velocity, speed, (2, 5))

    def _batch(self, q: Array, v: Array, omega: Array, shape: tuple[int, ...]) -> Batch:
        q, v, omega = as_rows(q), as_rows(v), np.ascontiguousarray(omega, dtype=float)
        n = q.shape[1]
        step = 0 if omega.shape == (1,) else 1
        given = [*row_places(q), *row_places(v), omega.ctypes.data, step]
        if v.shape != (2, n):
            raise ValueError(f"velocity must have the shape of position, (2, {n}), got {v.shape}")
        if step and omega.shape != (n,):
            raise ValueError(f"speed must have shape ({n},) or (1,), got {omega.shape}")
        return run_batch("rf_response_batch", [self._address, self._reference], n, given, shape)


class JournalKernel(ResponseKernel):
    """The film force of a journal bearing in SI units.

    Parameters
    ----------
    kernel : FilmKernel
        Its film.
    clearance : float [m]
        Radial clearance.
    force_scale : float [N s]
        viscosity * length * radius^3 / clearance^2.
    """

    function: ClassVar[str] = "rf_journal_at"

    def __init__(self, kernel: FilmKernel, clearance: float, force_scale: float) -> None:
        self._arguments = (kernel, clearance, force_scale)
        self.film = kernel
        self.struct = JournalStruct(
            kernel.film, addressof(kernel.struct), clearance, force_scale, kernel.error, kernel.openings
        )
        super().__init__()


class LobePlace(NamedTuple):
    """Where a pad is.

    Attributes
    ----------
    middle : float [rad]
        Angle of the middle of its arc.
    center : (float, float) [m]
        Of its curvature.
    """

    middle: float
    center: tuple[float, float]


class LobesKernel(ResponseKernel):
    """The film force of fixed pads in SI units.

    Parameters
    ----------
    films : sequence of JournalKernel
        Of each pad, in its own frame.
    places : sequence of LobePlace
        As many.
    """

    function: ClassVar[str] = "rf_lobes_at"

    def __init__(self, films: Sequence[JournalKernel], places: Sequence[LobePlace]) -> None:
        self._arguments = (films, places)
        self._kept: list[Any] = [films]
        self.film = films[0].film
        lobes = [
            LobeStruct(film.struct, np.cos(middle), np.sin(middle), *center)
            for film, (middle, center) in zip(films, places, strict=True)
        ]
        rows = (LobeStruct * len(lobes))(*lobes)
        self._kept.append(rows)
        self.struct = LobesStruct(len(lobes), addressof(rows))
        super().__init__()
