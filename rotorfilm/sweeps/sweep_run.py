"""A sweep: the points of a scene's keys solved, kept, and gathered."""

from __future__ import annotations

import hashlib
import json
import os
from collections.abc import Iterator, Mapping
from importlib.metadata import version
from importlib.util import find_spec
from pathlib import Path
from typing import TYPE_CHECKING, Any

from ..errors import InputError, require_count, warn_user
from ..inputs.kinds import arguments
from ..limits import WORKERS, require_at_most
from ..progress import Report, silent
from ..scenes.scene_file import read_tables
from .axes import Axis, Values, check, points, read_axes
from .dataset import load, save, to_dataset
from .point import Row
from .store import Store
from .workers import Points, solved_by_dask, solved_by_processes, solved_here

if TYPE_CHECKING:
    import xarray


@arguments
def sweep(
    scene: str | os.PathLike[str] | Mapping[str, Any],
    parameters: Mapping[str, Values],
    *,
    path: str | os.PathLike[str] | None = None,
    workers: int | None = None,
    dask: str | None = None,
    report: Report = silent,
) -> xarray.Dataset:
    """Solve a scene at many values of its keys.

    Parameters
    ----------
    scene : path or mapping
        A scene file, or its tables.
    parameters : mapping of str to sequence, or to (str, sequence)
        Values by dotted key, as a scene file would have them: `{"journal.clearance": ["50 um", "60 um"]}`.
        Each key is a dimension of its own, so that all combinations are solved; keys given as (dimension,
        values) share that dimension, as Monte Carlo samples do: `{"journal.clearance": ("sample", c), ...}`.
    path : path, optional
        NetCDF file to write. While the sweep runs its rows are kept beside it; the same sweep, started again
        after an interruption, goes on from there.
    workers : int, optional
        Processes of this machine; by default as many as it has cores. 1: this process.
    dask : str, optional
        Address of a Dask scheduler whose workers solve the points instead.
    report : callable
        Called with the fraction done and a text.

    Returns
    -------
    xarray.Dataset
        For a scene with a question `value`, `error_estimate`, `met`, `model`; for one without
        `eccentricity_ratio`, `attitude_angle`, `minimum_film`, `stiffness`, `damping`, `power_loss`,
        `friction_torque`, `side_flow`, `threshold_speed`, `whirl_ratio`, `model`. A point without an answer
        has its reason in `failure` and numbers that are not-a-number; what a scene warned of is in `remarks`.

    Raises
    ------
    InputError
        If an argument breaks its rule, xarray is not installed, or the path holds another sweep.
    SceneError
        If the scene or one of the values is none that a scene file may have.

    Warns
    -----
    UserWarning
        With the number of points that have no answer.
    """
    _require_xarray()
    tables, source = _tables(scene)
    axes = read_axes(parameters)
    target = None if path is None else _file(path)
    if workers is not None:
        require_count("workers", workers)
        require_at_most("workers", workers, WORKERS)
    check(tables, axes, source)
    name = _name(tables, axes)
    if target is not None and target.is_file():
        return load(target, name)
    rows = _rows(tables, axes, source, name, target, workers=workers, dask=dask, report=report)
    dataset = to_dataset(axes, rows, {"sweep": name, "scene": source, "rotorfilm": version("rotorfilm")})
    if target is not None:
        save(dataset, target, name)
        _waiting(target).unlink()
    failed = sum("failure" in row for row in rows)
    if failed:
        warn_user(f"{failed} of {len(rows)} points have no answer; `failure` says why")
    return dataset


def _require_xarray() -> None:
    if any(find_spec(name) is None for name in ("xarray", "h5netcdf", "h5py")):
        raise InputError("a sweep needs the extra `sweep`: python -m pip install '.[sweep]' in its source")


def _tables(scene: str | os.PathLike[str] | Mapping[str, Any]) -> tuple[Mapping[str, Any], str]:
    if isinstance(scene, Mapping):
        return scene, "scene"
    return read_tables(scene), str(scene)


def _name(tables: Mapping[str, Any], axes: tuple[Axis, ...]) -> str:
    """Return a fingerprint of the scene and of all values."""
    parts = [tables, [[axis.key, axis.dimension, list(axis.values)] for axis in axes], version("rotorfilm")]
    return hashlib.sha256(json.dumps(parts, sort_keys=True, default=str).encode()).hexdigest()[:16]


def _file(path: str | os.PathLike[str]) -> Path:
    """Return a path; raise InputError where it is a folder, before the work."""
    if Path(path).is_dir():
        raise InputError(f"path must be that of a file, got the folder {str(path)!r}")
    return Path(path)


def _waiting(path: Path) -> Path:
    return path.with_name(f"{path.name}.rows")


def _rows(
    tables: Mapping[str, Any],
    axes: tuple[Axis, ...],
    source: str,
    name: str,
    path: Path | None,
    *,
    workers: int | None,
    dask: str | None,
    report: Report,
) -> list[Row]:
    """Return the rows of all points, those of an interrupted run from disk."""
    every = list(enumerate(points(axes)))
    store = None
    if path is not None:
        path.parent.mkdir(parents=True, exist_ok=True)
        store = Store(_waiting(path), name)
    rows = {} if store is None else dict(store.rows)
    todo = [(number, values) for number, values in every if number not in rows]
    try:
        for number, row in _solved(tables, todo, source, workers, dask):
            rows[number] = row
            if store is not None:
                store.add(number, row)
            report(len(rows) / len(every), f"{len(rows)} of {len(every)} points")
    finally:
        if store is not None:
            store.close()
    return [rows[number] for number, _ in every]


def _solved(
    tables: Mapping[str, Any], todo: Points, source: str, workers: int | None, dask: str | None
) -> Iterator[tuple[int, Row]]:
    if dask is not None:
        return solved_by_dask(tables, todo, source, dask)
    count = min(workers or os.cpu_count() or 1, len(todo))
    return (
        solved_here(tables, todo, source) if count <= 1 else solved_by_processes(tables, todo, source, count)
    )
