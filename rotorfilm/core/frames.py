"""Results as columns and as arrays with units: `pandas.DataFrame`, CSV, JSON, `xarray.Dataset`."""

from __future__ import annotations

import csv
import io
import json
import re
from collections.abc import Iterable, Iterator, Mapping, Sequence
from importlib import import_module
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np

from .errors import AbsentError
from .files import write_atomically

AXIS = "axis"
"""Dimension along x and y; that of forces in a matrix is `force_axis`."""


class LabeledArray(NamedTuple):
    """An array of a result.

    Attributes
    ----------
    dims : tuple of str
        Names of its dimensions.
    values : ndarray
    unit : str
    """

    dims: tuple[str, ...]
    values: np.ndarray
    unit: str


Arrays = dict[str, LabeledArray]


def optional(package: str, install: str) -> Any:
    """Import a package that not everyone has; raise AbsentError where it is not installed."""
    try:
        return import_module(package)
    except ModuleNotFoundError as error:
        if error.name != package:
            raise
        raise AbsentError(
            f"{package} must be installed for this, got no such package: python -m pip install {install}"
        ) from None


def dimensions(name: str, shape: Iterable[str], count: int) -> tuple[str, ...]:
    """Return the names of the dimensions of an array, from its shape as its docstring has it."""
    shape_of = tuple(shape)
    if len(shape_of) != count:
        return tuple(f"{name}_{k}" for k in range(count))
    dims = [AXIS if text == "2" else re.sub(r"\W+", "_", text).strip("_") or name for text in shape_of]
    # Rows of a matrix are those of the force.
    dims = [f"force_{AXIS}" if dim == AXIS and AXIS in dims[k + 1 :] else dim for k, dim in enumerate(dims)]
    return tuple(f"{dim}_{k}" if dim in dims[:k] else dim for k, dim in enumerate(dims))


def consistent(found: Mapping[str, LabeledArray]) -> Arrays:
    """Return arrays so that one name of a dimension has one length: others get the array's own name."""
    lengths: dict[str, int] = {}
    result = {}
    for name, one in found.items():
        pairs = zip(one.dims, one.values.shape, strict=True)
        dims = tuple(dim if lengths.setdefault(dim, n) == n else f"{name}_{dim}" for dim, n in pairs)
        result[name] = one._replace(dims=dims)
    return result


def stacked(name: str, dim: str, values: Sequence[Any], shape: Iterable[str], unit: str) -> Arrays:
    """Return equal numbers of many results along a dimension; arrays of unequal shapes by their number."""
    arrays = [np.asarray(one) for one in values if one is not None]
    if len({one.shape for one in arrays}) == 1:
        empty = np.full(arrays[0].shape, np.nan)
        whole = np.stack([empty if one is None else np.asarray(one) for one in values])
        return {name: LabeledArray((dim, *dimensions(name, shape, arrays[0].ndim)), whole, unit)}
    numbered = {f"{name}_{k}": np.asarray(one) for k, one in enumerate(values) if one is not None}
    return {key: LabeledArray(dimensions(key, (), one.ndim), one, unit) for key, one in numbered.items()}


def to_dataset(arrays: Arrays, index: str, along: str, notes: Mapping[str, Any]) -> Any:
    """Return an xarray.Dataset; the array `index`, if there is one, is the coordinate of its dimension."""
    xarray = optional("xarray", "'rotorfilm[sweep]'")
    renamed = {}
    for name, one in arrays.items():
        dims = tuple(index if index and dim == along else dim for dim in one.dims)
        renamed[name] = dims, one.values, {"units": one.unit} if one.unit else {}
    used = {dim for dims, _, _ in renamed.values() for dim in dims}
    coords: dict[str, Any] = {dim: list("xy") for dim in sorted(used) if dim in (AXIS, f"force_{AXIS}")}
    if index:
        coords[index] = renamed.pop(index)
    return xarray.Dataset(renamed, coords=coords, attrs=notes)


class Column(NamedTuple):
    """One quantity of a table.

    Attributes
    ----------
    name : str
    unit : str
        Unit of the values; empty for words.
    values : ndarray or sequence
        Real numbers or words, one a row.
    heading : str
        What is printed above it in place of the name.
    """

    name: str
    unit: str
    values: Any
    heading: str = ""


class ResultTable(NamedTuple):
    """Columns of equal length, from which print, data frame, CSV and JSON follow.

    Attributes
    ----------
    columns : tuple of Column
    title : str
    key : str
        Name of the column that is the index of a data frame; may be empty.
    notes : mapping
        What is said beside the rows, by name: numbers in SI and words.
    units : mapping of str to str
        Units of the numbers among the notes.
    """

    columns: tuple[Column, ...]
    title: str = ""
    key: str = ""
    notes: Mapping[str, Any] = {}
    units: Mapping[str, str] = {}

    @property
    def every_unit(self) -> dict[str, str]:
        """The units of all columns and of the notes that have one, by name."""
        return {**{one.name: one.unit for one in self.columns}, **self.units}

    def to_dataframe(self) -> Any:
        """Return a pandas.DataFrame, its units in `attrs`; raise AbsentError without pandas."""
        pandas = optional("pandas", "pandas")
        frame = pandas.DataFrame({one.name: one.values for one in self.columns})
        if self.key in frame:
            frame = frame.set_index(self.key)
        frame.attrs = {"units": self.every_unit, "title": self.title, **self.notes}
        return frame

    def to_csv(self, path: Path | str) -> Path:
        """Write the columns as CSV, units in the headings and floats with nine digits; return the path."""
        headed = {f"{one.name} [{one.unit}]" if one.unit else one.name: one.values for one in self.columns}
        return write_csv(path, {name: np.asarray(values).tolist() for name, values in headed.items()})

    def to_json(self) -> str:
        """Return title, units, columns by name and notes as JSON; what is not finite is null."""
        columns = {one.name: _plain(np.asarray(one.values).tolist()) for one in self.columns}
        notes = {name: _plain(value) for name, value in self.notes.items()}
        return json.dumps(
            {"title": self.title, "units": self.every_unit, "columns": columns, "notes": notes},
            allow_nan=False,
        )


def _plain(value: Any) -> Any:
    """Return numbers and lists of them as JSON holds them."""
    if isinstance(value, list | tuple):
        return [_plain(one) for one in value]
    return None if isinstance(value, float) and not np.isfinite(value) else value


def to_table(arrays: Arrays, index: str, along: str, notes: Mapping[str, Any]) -> ResultTable:
    """Return the columns of arrays along their rows; arrays that do not run along them are notes."""
    columns: list[Column] = []
    rest: dict[str, Any] = {}
    units: dict[str, str] = {}
    for name, one in arrays.items():
        if along and along not in one.dims:
            for key, part in _real(name, one.values):
                rest[key], units[key] = part.tolist(), one.unit
        else:
            columns += [Column(key, one.unit, values) for key, values in _columns(name, one, along)]
    return ResultTable(tuple(columns), notes.get("title", ""), index, {**notes, **rest}, units)


def _real(name: str, values: np.ndarray) -> tuple[tuple[str, np.ndarray], ...]:
    """Return numbers under their name, complex ones as two, which CSV, Excel and Parquet hold."""
    if not np.iscomplexobj(values):
        return ((name, values),)
    return (f"{name}_real", values.real), (f"{name}_imag", values.imag)


def rows_of(arrays: Arrays) -> str:
    """Return the dimension beside x and y that the first array with entries has; nothing for numbers."""
    dims = (dim for one in arrays.values() if one.values.size for dim in one.dims if not dim.endswith(AXIS))
    return next(dims, "")


def _columns(name: str, one: LabeledArray, along: str) -> Iterator[tuple[str, np.ndarray]]:
    """Yield a column for each entry of an array beside its rows, two for a complex one."""
    values = np.moveaxis(one.values, one.dims.index(along), 0) if along else one.values[None]
    dims = [dim for dim in one.dims if dim != along]
    for place in np.ndindex(values.shape[1:]):
        ends = ["xy"[k] if dim.endswith(AXIS) else str(k) for k, dim in zip(place, dims, strict=True)]
        matrix = "".join(ends) if all(dim.endswith(AXIS) for dim in dims) else "_".join(ends)
        key, column = "_".join([name, matrix]) if matrix else name, values[(slice(None), *place)]
        yield from _real(key, column)


def write_csv(path: Path | str, columns: Mapping[str, Iterable[object]]) -> Path:
    """Write columns of equal length, by their headings, as CSV: floats with nine digits; return the path."""
    text = io.StringIO(newline="")
    writer = csv.writer(text, lineterminator="\n")
    writer.writerow(columns)
    for row in zip(*columns.values(), strict=True):
        writer.writerow([f"{entry:.9g}" if isinstance(entry, float) else entry for entry in row])
    return write_atomically(path, text.getvalue().encode())
