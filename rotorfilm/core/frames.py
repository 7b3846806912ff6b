"""Results as arrays with dimensions and units: a `pandas.DataFrame` or an `xarray.Dataset`."""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator, Mapping, Sequence
from importlib import import_module
from typing import Any, NamedTuple

import numpy as np

from .errors import AbsentError

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


def to_frame(arrays: Arrays, index: str, along: str, notes: Mapping[str, Any]) -> Any:
    """Return a pandas.DataFrame; what does not run along its rows is in its `attrs`, as are the units."""
    pandas = optional("pandas", "pandas")
    columns, units, rest = {}, {}, {}
    for name, one in arrays.items():
        if along and along not in one.dims:
            rest[name] = one.values.tolist()
            units[name] = one.unit
            continue
        for key, values in _columns(name, one, along):
            columns[key], units[key] = values, one.unit
    frame = pandas.DataFrame(columns)
    if index in columns:  # a complex one is two
        frame = frame.set_index(index)
    frame.attrs = {"units": units, **notes, **rest}
    return frame


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
        if np.iscomplexobj(column):  # which CSV, Excel and Parquet do not hold
            yield from ((f"{key}_real", column.real), (f"{key}_imag", column.imag))
        else:
            yield key, column
