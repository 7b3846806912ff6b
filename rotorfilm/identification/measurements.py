"""What was measured of a bearing over speed, as arrays or from a CSV file."""

from __future__ import annotations

import csv
import io
import re
from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np
from numpy.typing import ArrayLike

from ..core.errors import InputError, brief, require_finite, require_positive
from ..core.files import read_text
from ..core.inputs import quantities
from ..core.model import Array
from ..core.units import parse_quantity

QUANTITIES = {
    "x": "m",
    "y": "m",
    "temperature": "K",
    "power_loss": "W",
    "side_flow": "m3/s",
    **{f"k{row}{column}": "N/m" for row in "xy" for column in "xy"},
    **{f"c{row}{column}": "N.s/m" for row in "xy" for column in "xy"},
}
"""What can be measured, and its unit: place of the journal, temperature of the film, stiffness, damping."""

_AXES = {"speed": "rad/s", "load_x": "N", "load_y": "N"}
_HEADING = re.compile(r"\s*(\w+)\s*(?:\[(.+)\]\s*)?")


@quantities
@dataclass(frozen=True, kw_only=True, eq=False)
class Measurements:
    """Measured quantities of a bearing at several speeds, or under several loads.

    Parameters
    ----------
    speed : array_like, shape (n,) [rad/s]
    load : array_like, shape (2,) or (2, n) [N]
        External static force on the journal.
    values : mapping of str to array_like, shape (n,)
        Values by name, in SI units: "x" and "y" of the journal, "temperature" of the
        film, "power_loss", "side_flow", and "kxx" to "cyy". Use not-a-number where a quantity was not
        measured.
    noise : mapping of str to float, optional
        Standard deviation of each quantity, in its unit. Without it, each quantity is weighted by its own
        size, and the residuals of the fit give its noise.

    Raises
    ------
    InputError
        If an argument has the wrong shape, is not finite, or names something else.

    Examples
    --------
    >>> Measurements(speed=[100.0, 200.0], load=[0.0, -500.0], values={"x": [4e-5, 5e-5]}).count
    2
    """

    speed: ArrayLike
    load: ArrayLike
    values: Mapping[str, ArrayLike]
    noise: Mapping[str, float] | None = None
    _found: dict[str, Array] = field(init=False, repr=False)

    def __post_init__(self) -> None:
        speed, load = require_finite("speed", self.speed), require_finite("load", self.load)
        if speed.ndim != 1 or not speed.size:
            raise InputError(f"speed must have shape (n,), got shape {speed.shape}")
        if load.shape not in ((2,), (2, speed.size)):
            raise InputError(f"load must have shape (2,) or (2, {speed.size}), got shape {load.shape}")
        _require_known("values", self.values)
        found = {}
        for name, given in self.values.items():
            try:
                found[name] = series = np.asarray(given, dtype=float)
            except (TypeError, ValueError):
                raise InputError(f"values must be numeric for {name!r}, got {brief(given)}") from None
            if series.shape != speed.shape or np.isinf(series).any():
                raise InputError(
                    f"values must have {speed.size} finite numbers or nan for {name!r}, got {series}"
                )
        if not any(np.isfinite(series).any() for series in found.values()):
            raise InputError("values must hold at least one measured number, got none")
        if self.noise is not None:
            for name in found:
                require_positive(f"noise of {name}", self.noise.get(name, np.nan))
        loads = np.broadcast_to(load.reshape(2, -1), (2, speed.size))
        for name, checked in (("speed", speed), ("load", loads.copy()), ("_found", found)):
            object.__setattr__(self, name, checked)

    @classmethod
    def read(
        cls, path: Path | str, *, load: ArrayLike | None = None, noise: Mapping[str, float] | None = None
    ) -> Measurements:
        """Read a CSV file: a column for each quantity, headings as "speed [rpm]", "temperature [degC]".

        The unit may stand in each entry instead, as "3000 rpm" below the heading "speed".

        Parameters
        ----------
        path : Path or str
        load : array_like, shape (2,) [N], optional
            Load of all rows; by default it stands in columns load_x and load_y.
        noise : mapping of str to float, optional
            As above.

        Raises
        ------
        InputError
            If a heading, its unit or an entry cannot be read. Empty entries are not measured.
        """
        headings, *rows = list(csv.reader(io.StringIO(read_text(path), newline=""))) or [[]]
        for number, row in enumerate(rows, start=2):
            if row and len(row) != len(headings):
                raise InputError(f"{path} must have {len(headings)} entries in line {number}, got {len(row)}")
        columns = dict(
            _column(heading, [row[k] for row in rows if row]) for k, heading in enumerate(headings)
        )
        if len(columns) < len(headings):
            raise InputError(f"{path} must have each quantity in one column, got {headings}")
        if "speed" not in columns or (load is None and not {"load_x", "load_y"} <= set(columns)):
            raise InputError(
                f"{path} must have columns speed, and load_x and load_y where none is given, got {headings}"
            )
        given = load if load is not None else [columns["load_x"], columns["load_y"]]
        values = {name: series for name, series in columns.items() if name not in _AXES}
        return cls(speed=columns["speed"], load=given, values=values, noise=noise)

    @property
    def count(self) -> int:
        """Number of measured values."""
        return int(sum(np.isfinite(series).sum() for series in self._found.values()))

    @property
    def rows(self) -> list[tuple[float, Array]]:
        """Speed [rad/s] and load [N] of each row."""
        return list(zip(np.asarray(self.speed).tolist(), np.asarray(self.load).T, strict=True))

    @property
    def names(self) -> tuple[str, ...]:
        """Names of the measured quantities."""
        return tuple(self._found)

    @property
    def table(self) -> Array:
        """Measured values, shape (n, quantities)."""
        return np.stack(list(self._found.values()), axis=-1)

    @property
    def scale(self) -> Array:
        """Scale of the residuals of each quantity: its noise, or its own size, shape (quantities,)."""
        if self.noise is not None:
            return np.array([self.noise[name] for name in self.names])
        sizes = np.sqrt(np.nanmean(self.table**2, axis=0))
        return np.where(sizes > 0.0, sizes, 1.0)


def _require_known(name: str, given: Mapping[str, object]) -> None:
    unknown = [key for key in given if key not in QUANTITIES]
    if unknown or not given:
        raise InputError(f"{name} must name some of {', '.join(QUANTITIES)}, got {unknown or 'nothing'}")


def _column(heading: str, entries: list[str]) -> tuple[str, list[float]]:
    """Return the name of a column and its numbers in SI units, by the unit of the heading or their own."""
    match = _HEADING.fullmatch(heading)
    known = {**QUANTITIES, **_AXES}
    if match is None or match[1] not in known:
        raise InputError(f"headings must be a quantity with its unit such as 'x [um]', got {brief(heading)}")
    unit, own = known[match[1]], match[2] or ""
    if not own and any(_is_bare(entry) for entry in entries):
        raise InputError(f"{match[1]} must have a unit in its heading or in each entry, got {brief(entries)}")
    return match[1], [
        parse_quantity(f"{entry} {own}", unit, absolute=unit == "K") if entry.strip() else np.nan
        for entry in entries
    ]


def _is_bare(entry: str) -> bool:
    """Return whether an entry is a number without a unit."""
    try:
        return bool(float(entry) or True)
    except ValueError:
        return False
