"""Bearings by stiffness and damping, constant or tabulated over the speed, for any freedoms."""

from __future__ import annotations

import csv
import io
import math
import re
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from itertools import product
from pathlib import Path
from typing import Any, ClassVar

import numpy as np
from numpy.typing import ArrayLike
from scipy.interpolate import PchipInterpolator

from ..core.errors import InputError, brief, require_finite, warn_user
from ..core.files import read_text
from ..core.frames import Column, ResultTable, write_csv
from ..core.inputs import quantities
from ..core.model import Array
from ..core.port import Force, Tangent, force_of, tangent_of
from ..core.readable import Plottable, Tabled
from ..core.results import Equilibrium
from ..core.signals import FREEDOMS, PLANAR, Signal, checked_freedoms, force_outputs, journal_inputs
from ..core.units import UNITS, parse_quantity, si_name
from ..native.film_call import FilmCall
from ..native.spec import NativeSpec, linear_kernel, parameter
from .reaction import NOMINAL_SPEED, Feedthrough, broadcast_state, without_overflow

NOMINAL_LENGTH = 1e-4
"""Typical displacement [m]."""


class LinearReaction(Feedthrough):
    """What a bearing with `freedoms` and `stiffness` says of its signals."""

    clearance: ClassVar[float] = math.inf
    """Infinite: it does not know where a wall is."""

    freedoms: tuple[str, ...]
    stiffness: Any

    @property
    def nominal_speed(self) -> float:
        """Typical angular speed [rad/s]."""
        return NOMINAL_SPEED

    @property
    def inputs(self) -> tuple[Signal, ...]:
        """Signals of the places of its freedoms, of their rates, and the speed: x, y, vx, vy, speed."""
        return journal_inputs(NOMINAL_LENGTH, self.nominal_speed, self.freedoms, self._sizes[1])

    @property
    def outputs(self) -> tuple[Signal, ...]:
        """Signals of forces and moments on the shaft: force_x, force_y."""
        size, arm = self._sizes
        return force_outputs(size * NOMINAL_LENGTH or 1.0, self.freedoms, arm)

    @property
    def _sizes(self) -> tuple[float, float]:
        """The largest stiffness against displacements, and the arm [m] at which it is that against tilts."""
        turns = np.array([FREEDOMS[name].turns for name in self.freedoms])
        size = np.abs(self.stiffness).reshape(-1, len(turns), len(turns)).max(axis=0)
        along, about = (float(size[kind][:, kind].max(initial=0.0)) for kind in (~turns, turns))
        return along or about, math.sqrt(about / along) if along and about else 1.0


# A bearing whose stiffness and damping are tabulated over speed, as CSV in and out.


def headings(freedoms: tuple[str, ...]) -> list[str]:
    """Return the columns of the CSV file: speed, kxx to cyy, or as k_z_tilt_x for other freedoms."""
    gap = "" if freedoms == PLANAR else "_"
    found = ["speed [rad/s]"]
    for letter, times in (("k", ""), ("c", " s")):
        for force, place in product(freedoms, repeat=2):
            unit = (
                f"{'N m' if FREEDOMS[force].turns else 'N'}{times}/{'rad' if FREEDOMS[place].turns else 'm'}"
            )
            found.append(f"{letter}{gap}{force}{gap}{place} [{unit}]")
    return found


def _split_heading(text: str) -> tuple[str, str]:
    """Return the name in a heading and its unit, in brackets or parentheses; empty where it has none."""
    match = re.fullmatch(r"\s*(.*?)\s*[\[(]([^\[(]*)[\])]\s*", text)
    return (match[1], match[2].strip()) if match else (text.strip(), "")


def _numbers(path: Path | str, name: str, unit: str, entries: list[str]) -> Array:
    known = si_name(unit) in UNITS  # a force per angle is not
    try:
        return np.array(
            [
                parse_quantity(one, si_name(unit)) if known else float(one.removesuffix(f" {unit}"))
                for one in entries
            ]
        )
    except ValueError as wrong:
        raise InputError(f"{path} must hold numbers below {name!r}: {wrong}") from None


@quantities
@dataclass(frozen=True, kw_only=True)
class TabulatedBearing(Plottable, Tabled, LinearReaction):
    """force = -K(speed) position - C(speed) velocity: a Reaction for small motion about an equilibrium.

    Between the speeds the entries follow a monotone cubic (Fritsch & Butland 1984); beyond them an error is
    raised. A table with a single speed holds for that speed only.

    Parameters
    ----------
    speeds : array_like, shape (m,) [rad/s]
        Rising.
    stiffness : array_like, shape (m, n, n) [N/m]
        Rows: forces and moments; columns: places; both in the order of the freedoms. In [N/rad], [N],
        [N m/rad] where there are tilts.
    damping : array_like, shape (m, n, n) [N s/m]
        Damping in the same arrangement, by the rates.
    freedoms : tuple of str
        Motions of the shaft that it reacts to, some of `core.signals.FREEDOMS`; ("x", "y") by default.

    Raises
    ------
    InputError
        If a shape is wrong, a number is not finite, the speeds do not rise, or freedoms are unknown or in
        another order.
    """

    speeds: ArrayLike
    stiffness: ArrayLike
    damping: ArrayLike
    freedoms: tuple[str, ...] = PLANAR

    _tabled: ClassVar[tuple[str, ...]] = ("speeds", "stiffness", "damping")

    def __post_init__(self) -> None:
        object.__setattr__(self, "freedoms", checked_freedoms(self.freedoms))
        speeds = require_rising("speeds", self.speeds)
        for name in ("stiffness", "damping"):
            table = require_finite(name, getattr(self, name))
            wanted = (len(speeds), len(self.freedoms), len(self.freedoms))
            if table.shape != wanted:
                raise InputError(f"{name} must have shape {wanted}, got {table.shape}")
            object.__setattr__(self, name, table)
        object.__setattr__(self, "speeds", speeds)

    @classmethod
    def from_csv(cls, path: Path | str, columns: Mapping[str, str] | None = None) -> TabulatedBearing:
        """Read a table of speed, stiffness and damping in any units and order.

        Parameters
        ----------
        path : Path or str
            A file of `to_csv`, or a table with headings as "speed [rpm]", "Kxx [N/mm]".
        columns : mapping of str to str, optional
            Headings of the file by "speed", "kxx" to "kyy", "cxx" to "cyy" (in any case), where they have
            other names: `{"Kxx": "stiffness hor. [N/mm]", "speed": "n [rpm]"}`. A unit may stand there alone.

        Returns
        -------
        TabulatedBearing
            Cross terms and damping that the file does not have are zero. A heading without a unit is in SI.

        Raises
        ------
        InputError
            If a heading, a unit or a number cannot be read, speed, kxx or kyy is missing, or a column is
            there twice.

        Warns
        -----
        ValidityWarning
            If entries are taken as zero while columns that begin with k or c are not read.
        """
        heading, *rows = list(csv.reader(io.StringIO(read_text(path), newline=""))) or [[]]
        known = {entry.partition(" ")[0] for entry in heading}
        freedoms = tuple(name for name in FREEDOMS if f"k_{name}_{name}" in known) or PLANAR
        units = dict(map(_split_heading, headings(freedoms)))
        given = {key.lower(): text for key, text in (columns or {}).items()}
        if unknown := [key for key in given if key not in units]:
            raise InputError(f"columns must be of {', '.join(units)}, got {unknown[0]!r}")
        found, there = {}, [_split_heading(entry)[0].lower() for entry in heading]
        unread = {place for place, entry in enumerate(there) if entry[:1] in ("k", "c")}
        needed = ("speed", "kxx", "kyy") if freedoms == PLANAR else units
        for name, unit in units.items():
            wanted, meant = _split_heading(given.get(name, name))
            if wanted.lower() in there:
                place = there.index(wanted.lower())
                unread.discard(place)
                if there.count(wanted.lower()) > 1:
                    raise InputError(f"{path} must have one column {wanted!r}, got {heading}")
                written = meant or _split_heading(heading[place])[1] or unit
                entries = [f"{row[place] if place < len(row) else ''} {written}" for row in rows if any(row)]
                found[name] = _numbers(path, name, unit, entries)
            elif name in given or name in needed:
                raise InputError(f"{path} must have a column {given.get(name, name)!r}, got {heading}")
        if unread and (zero := [name for name in units if name not in found]):
            named = ", ".join(repr(heading[place]) for place in sorted(unread))
            warn_user(f"{path}: {', '.join(zero)} are taken as 0, and the columns {named} are not read")
        size, n = len(found["speed"]), len(freedoms)
        columns_of = [found.get(name, np.zeros(size)) for name in list(units)[1:]]
        tables = np.array(columns_of).T.reshape(size, 2, n, n)
        return cls(speeds=found["speed"], stiffness=tables[:, 0], damping=tables[:, 1], freedoms=freedoms)

    def found_at(self, equilibria: Sequence[Equilibrium]) -> TabulatedBearing:
        """Return the table together with the equilibrium of each speed, for printing and tables."""
        found = replace(self)
        object.__setattr__(found, "_equilibria", tuple(equilibria))
        return found

    def to_table(self) -> ResultTable:
        """Return a row for each speed: the equilibrium if known, and the entries of K and C."""
        rests = vars(self).get("_equilibria", ())
        return ResultTable(
            (
                Column("speed", "rad/s", np.asarray(self.speeds)),
                *_rest_columns(rests),
                *(
                    Column(name.partition(" ")[0], name.partition("[")[2][:-1], values)
                    for name, values in zip(
                        headings(self.freedoms)[1:],
                        np.hstack([table.reshape(len(table), -1) for table in self._tables]).T,
                        strict=True,
                    )
                ),
            ),
            "coefficients",
            "speed",
        )

    def _pages(self) -> tuple[ResultTable, ...]:
        return (self.to_table(),)

    def to_csv(self, path: Path | str, *, speed_unit: str = "rad/s") -> Path:
        """Write the table with nine digits, the speed in rad/s, rpm or Hz; return the path."""
        speeds = np.asarray(self.speeds) / parse_quantity(f"1 {speed_unit}", "rad/s")
        columns = np.column_stack([speeds, *(t.reshape(len(t), -1) for t in self._tables)])
        names = [f"speed [{speed_unit}]", *headings(self.freedoms)[1:]]
        return write_csv(path, dict(zip(names, columns.T.tolist(), strict=True)))

    @property
    def nominal_speed(self) -> float:
        """The largest speed of the table [rad/s]."""
        return float(np.abs(self.speeds).max()) or 1.0

    def force(self, position: ArrayLike, velocity: ArrayLike, speed: ArrayLike) -> Array:
        """Return forces [N] and moments [N m] on the shaft, shape (n, ...).

        Raises
        ------
        InputError
            If a speed is outside the table.
        """

        def law(q: Array, v: Array, omega: Array) -> Array:
            stiffness, damping = self._at(omega, 0)
            return -np.einsum("...ij,j...->i...", stiffness, q) - np.einsum("...ij,j...->i...", damping, v)

        return without_overflow(law, *broadcast_state(position, velocity, speed, len(self.freedoms)))

    def jacobian(self, position: ArrayLike, velocity: ArrayLike, speed: ArrayLike) -> Array:
        """Return d force/d(places, rates, speed), shape (n, 2 n + 1, ...); InputError as in `force`."""

        def law(q: Array, v: Array, omega: Array) -> Array:
            stiffness, damping = self._at(omega, 0)
            k_slope, c_slope = self._at(omega, 1)
            by_speed = -np.einsum("...ij,j...->i...", k_slope, q) - np.einsum("...ij,j...->i...", c_slope, v)
            blocks = [np.moveaxis(-table, (-2, -1), (0, 1)) for table in (stiffness, damping)]
            return np.concatenate([*blocks, by_speed[:, None]], axis=1)

        return without_overflow(law, *broadcast_state(position, velocity, speed, len(self.freedoms)))

    def native(self) -> NativeSpec | None:
        """Return the kernel with the table as parameters; None for other freedoms and for a subclass."""
        if type(self) is not TabulatedBearing or self.freedoms != PLANAR:
            return None
        columns = {"speeds": np.asarray(self.speeds)}
        for letter, table in zip("kc", self._tables, strict=True):
            columns |= {
                f"{letter}{i}{j}": table[:, a, b] for (a, i), (b, j) in product(enumerate("xy"), repeat=2)
            }
        parameters = [
            parameter(f"{name}_{k + 1}", unit, value, text, minimum=-math.inf, tunable=name != "speeds")
            for name, values in columns.items()
            for unit, text in [_MEANINGS[name[0]]]
            for k, value in enumerate(values.tolist())
        ]
        size = np.array([float(len(columns["speeds"]))])
        return NativeSpec(
            kernel="tabulated",
            parameters=tuple(parameters),
            tables={"size": size},
            sampled=("speeds", "speed"),
        )

    @property
    def _tables(self) -> tuple[Array, Array]:
        return np.asarray(self.stiffness), np.asarray(self.damping)

    @cached_property
    def _curves(self) -> list[PchipInterpolator]:
        speeds = np.asarray(self.speeds)
        return [PchipInterpolator(speeds, table, axis=0) for table in self._tables]

    def _at(self, speed: ArrayLike, derivative: int) -> tuple[Array, Array]:
        """Return K and C, or their derivatives by speed, shape (..., n, n)."""
        known = np.asarray(self.speeds)
        omega = within_table(speed, known)
        if len(known) == 1:
            size = *omega.shape, len(self.freedoms), len(self.freedoms)
            stiffness, damping = (np.broadcast_to(t[0], size) for t in self._tables)
            return (0.0 * stiffness, 0.0 * damping) if derivative else (stiffness, damping)
        stiffness, damping = (curve(omega, nu=derivative) for curve in self._curves)
        return stiffness, damping


_MEANINGS = {
    "s": ("rad/s", "angular speed of a row of the table; the speeds rise"),
    "k": ("N/m", "stiffness at the speeds of the table: minus the force by a displacement"),
    "c": ("N.s/m", "damping at the speeds of the table: minus the force by a velocity"),
}
"""Unit and meaning of the columns of a table, by their first letter."""


def _rest_columns(rests: tuple[Equilibrium, ...]) -> Iterator[Column]:
    """Yield what is known of equilibria; a film that tells its losses has power loss and flow too."""
    units = {"eccentricity_ratio": "1", "attitude_angle": "rad", "minimum_film": "m", "temperature": "K"}
    for name, unit in units.items():
        values = [getattr(at, name) for at in rests]
        if values and None not in values and np.isfinite(values).all():
            yield Column(name, unit, np.array(values))
    losses = [at.losses for at in rests]
    if losses and None not in losses:
        for name, unit in {"power_loss": "W", "side_flow": "m3/s"}.items():
            yield Column(name, unit, np.array([getattr(one, name) for one in losses], dtype=float))


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
            f"speed must be within the table, {known[0]:.6g} to {known[-1]:.6g} rad/s, got {omega.tolist()}"
        )
    return omega


# A bearing with constant stiffness and damping.


Row = tuple[float, ...]


@quantities
@dataclass(frozen=True, kw_only=True)
class LinearBearing(LinearReaction):
    """Springs and dampers, force = -stiffness position - damping velocity: a Reaction at any speed.

    Parameters
    ----------
    stiffness : float [N/m] or n x n numbers
        Rows: forces and moments, as force x, y; columns: places, as position x, y; both in the order of the
        freedoms. Entries of tilts are in [N/rad], [N] and [N m/rad]. One number holds for all directions, n
        numbers are the diagonal.
    damping : float [N s/m] or n x n numbers
        Damping in the same arrangement, by the rates.
    freedoms : tuple of str
        Motions of the shaft that it reacts to, some of `core.signals.FREEDOMS`; ("x", "y") by default.

    Raises
    ------
    InputError
        If stiffness or damping has another shape, is one number but 0 where there are tilts, or is not
        finite; if freedoms are unknown or in another order.

    Examples
    --------
    >>> thrust = LinearBearing(stiffness=(2e8, 5e4, 5e4), freedoms=("z", "tilt_x", "tilt_y"))
    >>> thrust.force([1e-5, 0.0, 2e-4], [0.0, 0.0, 0.0], 100.0)
    array([-2000.,     0.,   -10.])
    """

    stiffness: float | Row | tuple[Row, ...]
    damping: float | Row | tuple[Row, ...] = 0.0
    freedoms: tuple[str, ...] = PLANAR

    def __post_init__(self) -> None:
        object.__setattr__(self, "freedoms", checked_freedoms(self.freedoms))
        for name in ("stiffness", "damping"):
            matrix = self._matrix(name, getattr(self, name))
            object.__setattr__(self, name, tuple(tuple(row) for row in matrix.tolist()))

    def _matrix(self, name: str, value: ArrayLike) -> Array:
        """Return the matrix (n, n) of a field; InputError of one that is none."""
        array, n = require_finite(name, value), len(self.freedoms)
        turning = [one for one in self.freedoms if FREEDOMS[one].turns]
        if array.shape == (n, n):
            return array
        if array.shape == (n,) or (not array.ndim and not (turning and array)):
            return array * np.eye(n)
        raise InputError(
            f"{name} must be {'' if turning else 'a number or '}{n} x {n} numbers, or the {n} numbers of its "
            f"diagonal, for {', '.join(self.freedoms)}, got {brief(value)} of shape {array.shape}"
        )

    def force(self, position: ArrayLike, velocity: ArrayLike, speed: ArrayLike) -> Array:
        """Return forces [N] and moments [N m] on the shaft, shape (n, ...); the speed is not used."""
        return without_overflow(
            lambda q, v, _: -np.tensordot(self.stiffness, q, 1) - np.tensordot(self.damping, v, 1),
            *broadcast_state(position, velocity, speed, len(self.freedoms)),
        )

    def jacobian(self, position: ArrayLike, velocity: ArrayLike, speed: ArrayLike) -> Array:
        """Return d force/d(places, rates, speed), shape (n, 2 n + 1, ...): the same everywhere."""
        n = len(self.freedoms)
        batch = broadcast_state(position, velocity, speed, n)[2].shape
        constant = np.hstack([-np.array(self.stiffness), -np.array(self.damping), np.zeros((n, 1))])
        return np.broadcast_to(
            constant.reshape(n, 2 * n + 1, *(1,) * len(batch)), (n, 2 * n + 1, *batch)
        ).copy()

    def prepare_tangent(self) -> Tangent:
        """Return force and derivatives as a function of five numbers; see `core.port.Reaction`."""
        if not self.is_constant:
            return tangent_of(self)
        kxx, kxy, kyx, kyy = np.ravel(self.stiffness).tolist()
        cxx, cxy, cyx, cyy = np.ravel(self.damping).tolist()
        slopes = (-kxx, -kxy, -cxx, -cxy, 0.0, -kyx, -kyy, -cyx, -cyy, 0.0)

        def tangent(
            x: float, y: float, vx: float, vy: float, speed: float
        ) -> tuple[float, float, Sequence[float]]:
            force_x = -(kxx * x + kxy * y) - (cxx * vx + cxy * vy)
            return force_x, -(kyx * x + kyy * y) - (cyx * vx + cyy * vy), slopes

        return tangent

    def prepare(self) -> Force:
        """Return the force as a function of five numbers; see `core.port.Reaction`."""
        if not self.is_constant:
            return force_of(self)
        tangent = self.prepare_tangent()

        def force(x: float, y: float, vx: float, vy: float, speed: float) -> tuple[float, float]:
            return tangent(x, y, vx, vy, speed)[:2]

        return force

    @property
    def is_constant(self) -> bool:
        """Whether stiffness and damping determine the force; False for a subclass, which may differ."""
        return type(self) is LinearBearing

    def compiled(self) -> FilmCall | None:
        """Return the force in the C library; None for other freedoms than x, y, and for a subclass."""
        numbers = np.ravel([self.stiffness, self.damping])
        planar = self.is_constant and self.freedoms == PLANAR
        return FilmCall.of_numbers("rf_springs_at", numbers) if planar else None

    def native(self) -> NativeSpec | None:
        """Return the kernel of a linear model; None for a subclass, which may differ."""
        if not self.is_constant:
            return None
        return linear_kernel(self.linearization(0.0, (), np.zeros(2 * len(self.freedoms) + 1)))
