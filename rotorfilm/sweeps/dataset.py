"""The rows of a sweep as an xarray.Dataset with units, and on disk as NetCDF."""

from __future__ import annotations

import io
import tempfile
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from ..files import read_sealed, write_sealed
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


def save(dataset: xarray.Dataset, path: Path, name: str) -> None:
    """Write the dataset of a sweep as NetCDF with a seal (`files.write_sealed`)."""
    with tempfile.TemporaryDirectory() as folder:
        made = Path(folder, "sweep.nc")
        dataset.to_netcdf(made, engine="h5netcdf")
        write_sealed(path, made.read_bytes(), name)


def load(path: Path, name: str) -> xarray.Dataset:
    """Return what `save` wrote.

    Raises
    ------
    InputError
        If the file is damaged, or that of another sweep.
    """
    import xarray

    content = read_sealed(path, name, "path must be that of the same sweep, or of none")
    with xarray.open_dataset(io.BytesIO(content), engine="h5netcdf") as found:
        return found.load()
