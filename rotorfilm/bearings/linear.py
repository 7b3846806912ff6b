"""A bearing with constant stiffness and damping."""

from __future__ import annotations

import csv
import io
import math
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path
from typing import ClassVar

import numpy as np
from numpy.typing import ArrayLike
from scipy.interpolate import PchipInterpolator

from ..core.errors import InputError, require_finite
from ..core.files import read_text
from ..core.inputs import quantities
from ..core.model import Array
from ..core.results import write_csv
from ..core.signals import Signal, force_outputs, journal_inputs
from .reaction import Feedthrough, broadcast_state, without_overflow

# A bearing whose stiffness and damping are tabulated over speed, as CSV in and out.


ENTRIES = ("xx", "xy", "yx", "yy")
HEADINGS = ("speed [rad/s]", *(f"k{e} [N/m]" for e in ENTRIES), *(f"c{e} [N s/m]" for e in ENTRIES))
"""Columns of the CSV file."""


@quantities
@dataclass(frozen=True, kw_only=True)
class TabulatedBearing(Feedthrough):
    """force = -K(speed) position - C(speed) velocity: a Reaction for small motion about an equilibrium.

    Between the speeds the entries follow a monotone cubic (Fritsch & Butland 1984); beyond them the bearing
    refuses. A single speed makes a table that holds for that speed only.

    Parameters
    ----------
    speeds : array_like, shape (n,) [rad/s]
        Rising.
    stiffness : array_like, shape (n, 2, 2) [N/m]
    damping : array_like, shape (n, 2, 2) [N s/m]

    Raises
    ------
    InputError
        If a shape is wrong, a number is not finite or the speeds do not rise.
    """

    speeds: ArrayLike
    stiffness: ArrayLike
    damping: ArrayLike

    def __post_init__(self) -> None:
        speeds = require_rising("speeds", self.speeds)
        for name in ("stiffness", "damping"):
            table = require_finite(name, getattr(self, name))
            if table.shape != (len(speeds), 2, 2):
                raise InputError(f"{name} must have shape ({len(speeds)}, 2, 2), got {table.shape}")
            object.__setattr__(self, name, table)
        object.__setattr__(self, "speeds", speeds)

    @classmethod
    def from_csv(cls, path: Path | str) -> TabulatedBearing:
        """Read a table that `to_csv` wrote; raise InputError where it is not one."""
        heading, *rows = list(csv.reader(io.StringIO(read_text(path), newline=""))) or [[]]
        if tuple(heading) != HEADINGS:
            raise InputError(f"{path} must have the columns {list(HEADINGS)}, got {heading}")
        try:
            numbers = np.array([[float(entry) for entry in row] for row in rows])
        except ValueError as wrong:
            raise InputError(f"{path} must hold numbers below its heading, got {wrong}") from None
        if numbers.ndim != 2 or numbers.shape[1] != len(HEADINGS):
            raise InputError(f"{path} must have {len(HEADINGS)} numbers in every row")
        tables = numbers[:, 1:].reshape(len(numbers), 2, 2, 2)
        return cls(speeds=numbers[:, 0], stiffness=tables[:, 0], damping=tables[:, 1])

    def to_csv(self, path: Path | str) -> Path:
        """Write the table with nine digits; return the path."""
        columns = np.column_stack([self.speeds, *(np.reshape(t, (-1, 4)) for t in self._tables)])
        return write_csv(path, dict(zip(HEADINGS, columns.T.tolist(), strict=True)))

    clearance: ClassVar[float] = math.inf
    """Infinite: the table does not know where the wall is."""

    @property
    def inputs(self) -> tuple[Signal, ...]:
        """Signals x, y, vx, vy, speed."""
        return journal_inputs(NOMINAL_LENGTH, float(np.abs(self.speeds).max()) or 1.0)

    @property
    def outputs(self) -> tuple[Signal, ...]:
        """Signals force_x, force_y: the force on the journal."""
        return force_outputs(float(np.abs(self._tables[0]).max()) * NOMINAL_LENGTH or 1.0)

    def force(self, position: ArrayLike, velocity: ArrayLike, speed: ArrayLike) -> Array:
        """Return the force on the journal [N], shape (2, ...).

        Raises
        ------
        InputError
            If a speed is outside the table.
        """

        def law(q: Array, v: Array, omega: Array) -> Array:
            stiffness, damping = self._at(omega, 0)
            return -np.einsum("...ij,j...->i...", stiffness, q) - np.einsum("...ij,j...->i...", damping, v)

        return without_overflow(law, *broadcast_state(position, velocity, speed))

    def jacobian(self, position: ArrayLike, velocity: ArrayLike, speed: ArrayLike) -> Array:
        """Return d(force_x, force_y)/d(x, y, vx, vy, speed), shape (2, 5, ...); InputError as in `force`."""

        def law(q: Array, v: Array, omega: Array) -> Array:
            stiffness, damping = self._at(omega, 0)
            k_slope, c_slope = self._at(omega, 1)
            by_speed = -np.einsum("...ij,j...->i...", k_slope, q) - np.einsum("...ij,j...->i...", c_slope, v)
            blocks = [np.moveaxis(-table, (-2, -1), (0, 1)) for table in (stiffness, damping)]
            return np.concatenate([*blocks, by_speed[:, None]], axis=1)

        return without_overflow(law, *broadcast_state(position, velocity, speed))

    @property
    def _tables(self) -> tuple[Array, Array]:
        return np.asarray(self.stiffness), np.asarray(self.damping)

    @cached_property
    def _curves(self) -> list[PchipInterpolator]:
        speeds = np.asarray(self.speeds)
        return [PchipInterpolator(speeds, table, axis=0) for table in self._tables]

    def _at(self, speed: ArrayLike, derivative: int) -> tuple[Array, Array]:
        """Return K and C, or their derivatives by speed, shape (..., 2, 2)."""
        known = np.asarray(self.speeds)
        omega = within_table(speed, known)
        if len(known) == 1:
            stiffness, damping = (np.broadcast_to(t[0], (*omega.shape, 2, 2)) for t in self._tables)
            return (0.0 * stiffness, 0.0 * damping) if derivative else (stiffness, damping)
        stiffness, damping = (curve(omega, nu=derivative) for curve in self._curves)
        return stiffness, damping


def require_rising(name: str, values: ArrayLike, least: int = 1) -> Array:
    """Return rising numbers, `least` of them at least, as an array; raise InputError otherwise."""
    array = require_finite(name, values)
    if array.ndim != 1 or array.size < least or np.any(np.diff(array) <= 0.0):
        raise InputError(f"{name} must be a list of rising numbers, got {values!r}")
    return array


def within_table(speed: ArrayLike, known: Array) -> Array:
    """Return speeds as an array; raise InputError where one is beyond those of a table [rad/s]."""
    omega = require_finite("speed", speed)
    if np.any(omega < known[0]) or np.any(omega > known[-1]):
        raise InputError(
            f"speed must be within the table, {known[0]:.6g} to {known[-1]:.6g} rad/s, got {speed!r}"
        )
    return omega


# A bearing with constant stiffness and damping.


Pair = tuple[tuple[float, float], tuple[float, float]]

NOMINAL_LENGTH = 1e-4
"""Typical displacement [m]."""


@quantities
@dataclass(frozen=True, kw_only=True)
class LinearBearing(Feedthrough):
    """A spring and a damper, force = -stiffness position - damping velocity: a Reaction at any speed.

    Parameters
    ----------
    stiffness : float [N/m] or 2 x 2 numbers
        Rows: force x, y; columns: position x, y. One number is the same in both directions.
    damping : float [N s/m] or 2 x 2 numbers

    Raises
    ------
    InputError
        If one of them is neither a finite number nor 2 x 2.
    """

    stiffness: float | Pair
    damping: float | Pair = 0.0

    def __post_init__(self) -> None:
        for name in ("stiffness", "damping"):
            array = require_finite(name, getattr(self, name))
            if array.shape not in ((), (2, 2)):
                raise InputError(f"{name} must be a number or 2 x 2 numbers, got {getattr(self, name)!r}")
            matrix = array if array.ndim else float(array) * np.eye(2)
            object.__setattr__(self, name, tuple(tuple(row) for row in matrix.tolist()))

    clearance: ClassVar[float] = math.inf
    """Infinite: the journal may go anywhere."""

    @property
    def inputs(self) -> tuple[Signal, ...]:
        """Signals x, y, vx, vy, speed."""
        return journal_inputs(NOMINAL_LENGTH, 100.0)

    @property
    def outputs(self) -> tuple[Signal, ...]:
        """Signals force_x, force_y: the force on the journal."""
        return force_outputs(float(np.abs(self.stiffness).max()) * NOMINAL_LENGTH or 1.0)

    def force(self, position: ArrayLike, velocity: ArrayLike, speed: ArrayLike) -> Array:
        """Return the force on the journal [N], shape (2, ...); the speed is not used."""
        return without_overflow(
            lambda q, v, _: -np.tensordot(self.stiffness, q, 1) - np.tensordot(self.damping, v, 1),
            *broadcast_state(position, velocity, speed),
        )

    def jacobian(self, position: ArrayLike, velocity: ArrayLike, speed: ArrayLike) -> Array:
        """Return d(force_x, force_y)/d(x, y, vx, vy, speed), shape (2, 5, ...): the same everywhere."""
        batch = np.broadcast_shapes(np.shape(position)[1:], np.shape(velocity)[1:], np.shape(speed))
        constant = np.hstack([-np.array(self.stiffness), -np.array(self.damping), np.zeros((2, 1))])
        return np.broadcast_to(constant.reshape(2, 5, *(1,) * len(batch)), (2, 5, *batch)).copy()
