"""Bearings of pads with recesses by their numbers: geometry, clearances, and the compiled film."""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import ArrayLike

from ....errors import (
    ConvergenceError,
    FilmContactError,
    InputError,
    UndefinedDerivativeError,
    require_kind,
    require_tuple,
    require_vector,
)
from ....inputs.si_arguments import quantities
from ....model import Array
from ....native.film_kernels import Status
from ...films.geometry import FilmGeometry, Pad
from ...films.ring.ring_grids import are_counts
from ..pad_bearing import PadBearing
from .dam_kernel import DamKernel, pad_rows
from .recessed_pad import RecessedPad

DIMENSIONS = ("radius", "length", "clearance", "film_viscosity")
"""What the compiled film is given besides the pads."""


@quantities
@dataclass(frozen=True, kw_only=True)
class RecessedPads(PadBearing):
    """Fixed pads around a journal, any of which may have a recess.

    Dimensions, clearance and lubricant are given as to every `PadBearing`.

    Parameters
    ----------
    pads : tuple of RecessedPad
        See `pressure_dam_pads` for the usual two.
    cells : tuple of int
        Cells around each pad and along half the length, multiples of 4 and at least 16 and 8; on both sides
        of the edges of a recess about as many as its part of them, at least 4.
    extrapolated : bool
        Whether the force is extrapolated from these cells and half as many, by a third of the difference.

    Raises
    ------
    InputError
        As a `PadBearing`, and if another value breaks its rule or pads overlap.
    """

    pads: tuple[RecessedPad, ...]
    cells: tuple[int, int] = (64, 16)
    extrapolated: bool = True

    def __post_init__(self) -> None:
        require_tuple("pads", self.pads, RecessedPad)
        require_kind("extrapolated", self.extrapolated, bool, "True or False")
        if not self.pads:
            raise InputError(f"pads must be one at least, got {self.pads!r}")
        if not are_counts(self.cells, (16, 8), (4, 4)):
            raise InputError(f"cells must be two multiples of 4, at least (16, 8), got {self.cells!r}")
        super().__post_init__()
        FilmGeometry(pads=tuple(Pad(start=pad.start, extent=pad.extent) for pad in self.pads))

    @property
    def preloads(self) -> tuple[float, ...]:
        """Preload of each pad [1]."""
        return tuple(pad.preload for pad in self.pads)

    @property
    def extents(self) -> tuple[float, ...]:
        """Angle that each pad covers [rad]."""
        return tuple(pad.extent for pad in self.pads)

    @cached_property
    def kernel(self) -> DamKernel:
        """The films in compiled code; InputError without a stated temperature."""
        return self.kernel_on(self.extrapolated)

    def kernel_on(self, extrapolated: bool) -> DamKernel:
        """Return the films in compiled code, extrapolated from two grids or not."""
        self.require_temperature()
        return DamKernel(self.rows, [float(getattr(self, name)) for name in DIMENSIONS], extrapolated)

    @cached_property
    def rows(self) -> Array:
        """The pads as compiled code reads them."""
        return pad_rows(self.pads, self.cells)

    def minimum_film(self, position: ArrayLike) -> Array:
        """Return the least film over all pads [m], shape (...), of journals at positions (2, ...) [m].

        It is not positive where one is touched.
        """
        at = require_vector("position", position)
        films = [self._place.least(x, y)[0] for x, y in at.reshape(2, -1).T.tolist()]
        return np.array(films).reshape(at.shape[1:])

    @cached_property
    def _place(self) -> DamKernel:
        """The pads, of any viscosity."""
        return DamKernel(self.rows, [self.radius, self.length, self.clearance, 1.0], False)

    def require_film(self, position: Array) -> None:
        """Raise FilmContactError, with the pad, unless the journal at position (2, ...) [m] touches none.

        Inside the circle of the assembled clearance it never does, outside it need not.
        """
        flat = position.reshape(2, -1)
        for x, y in flat[:, ~(np.hypot(*flat) < self.bore_clearance)].T.tolist():
            least, touched = self._place.least(x, y)
            if not least > 0.0:
                pad = self.pads[touched]
                raise FilmContactError(
                    f"position must keep the journal off pads[{touched}], {math.degrees(pad.start):.6g} to "
                    f"{math.degrees(pad.end):.6g} deg, got ({x!r}, {y!r}) m with a film of {least:.6g} m"
                )

    def report(self, status: int, state: tuple[float, ...] | list[float]) -> None:
        """Raise what the status of a state x, y, vx, vy, speed says."""
        x, y, vx, vy, speed = state
        said = f"got ({x!r}, {y!r}) m, ({vx!r}, {vy!r}) m/s and {speed!r} rad/s"
        if status == Status.UNDEFINED:
            raise UndefinedDerivativeError(
                "velocity and speed must drive the film of every pad where a derivative is asked for, " + said
            )
        if status == Status.AT_WALL:
            self.require_film(np.array([x, y]))
        if status == Status.NOT_FINITE:
            raise InputError(f"position, velocity and speed must be finite and not overflow, {said}")
        if status == Status.NO_MEMORY:
            raise MemoryError("no memory for the film of a pad")
        raise ConvergenceError(f"the search for the ruptured zone of a pad must end, and did not: {said}")
