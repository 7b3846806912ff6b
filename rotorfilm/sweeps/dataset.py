"""The rows of a sweep as an xarray.Dataset with units, and on disk as NetCDF."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from .axes import Axis, sizes
from .point import UNITS, Row

if TYPE_CHECKING:
    import xarray

INNER = ("row", "column")
"""Dimensions of what is a vector or a matrix at each point."""


def to_dataset(axes: Sequence[Axis], rows: Sequence[Row], attributes: Mapping[str, str]) -> xarray.Dataset:
    """Return the dataset of all points; numbers that a point does not have are not-a-number, texts empty."""
    import xarray

    lengths = sizes(axes)
    names = sorted({name for row in rows for name in row if name != "unit"} | {"failure"})
    units = {**UNITS, "value": next((row["unit"] for row in rows if "unit" in row), "")}
    return xarray.Dataset(
        {name: _variable(name, rows, lengths, units.get(name, "")) for name in names},
        coords={axis.name: _coordinate(axis) for axis in axes},
        attrs=dict(attributes),
    )


def _variable(name: str, rows: Sequence[Row], lengths: Mapping[str, int], unit: str) -> Any:
    known = [row[name] for row in rows if name in row]
    if all(isinstance(value, str) for value in known):
        texts = np.array([row.get(name, "") for row in rows], dtype=object)
        return tuple(lengths), texts.reshape(tuple(lengths.values()))
    if all(isinstance(value, bool) for value in known):
        flags = np.array([bool(row.get(name, False)) for row in rows])
        return tuple(lengths), flags.reshape(tuple(lengths.values()))
    shape = np.shape(known[0])
    numbers = np.array([row.get(name, np.full(shape, np.nan)) for row in rows], dtype=float)
    dims = (*lengths, *(f"{name}_{inner}" for inner in INNER[: len(shape)]))
    return dims, numbers.reshape(*lengths.values(), *shape), {"units": unit}


def _coordinate(axis: Axis) -> Any:
    values, unit = axis.coordinate()
    return (axis.dimension,), values, {"key": axis.key, **({"units": unit} if unit else {})}


def save(dataset: xarray.Dataset, path: Path) -> None:
    """Write NetCDF: whole or not at all."""
    waiting = path.with_name(f"{path.name}.writing")
    dataset.to_netcdf(waiting, engine="h5netcdf")
    waiting.replace(path)


def load(path: Path) -> xarray.Dataset:
    """Return what `save` wrote."""
    import xarray

    with xarray.open_dataset(path, engine="h5netcdf") as found:
        return found.load()
