"""A sweep: the points of a scene's keys solved, kept, and gathered."""

from __future__ import annotations

import hashlib
import io
import json
import multiprocessing
import os
import tempfile
import time
from collections.abc import Callable, Iterator, Mapping, Sequence
from concurrent.futures import ProcessPoolExecutor, as_completed
from functools import partial
from importlib.metadata import version
from importlib.util import find_spec
from pathlib import Path
from types import MappingProxyType
from typing import IO, TYPE_CHECKING, Any

import numpy as np

from ..analysis.threads import one_blas_thread
from ..core.errors import FileWarning, InputError, require_count, warn_user
from ..core.files import (
    failures_named,
    read_sealed,
    sealed_line,
    unsealed_line,
    write_atomically,
    write_sealed,
)
from ..core.inputs import arguments
from ..core.limits import WORKERS, require_at_most
from ..core.progress import Report, silent
from ..scenes.scene import Scene, read_tables, varied
from .point import Axis, Row, Values, check, points, read_axes, run_points, sizes, solve_point, unit_of

if TYPE_CHECKING:
    import xarray


@one_blas_thread
@arguments
def sweep(
    scene: str | os.PathLike[str] | Mapping[str, Any],
    parameters: Mapping[str, Values],
    *,
    path: str | os.PathLike[str] | None = None,
    changes: Mapping[str, Any] = MappingProxyType({}),
    workers: int | None = None,
    dask: str | None = None,
    runs: bool = False,
    report: Report = silent,
) -> xarray.Dataset:
    """Solve a scene at many values of its keys.

    Parameters
    ----------
    scene : path or mapping
        A scene file, or its tables.
    parameters : mapping of str to sequence, or to (str, sequence)
        Values by dotted key, as a scene file would have them: `{"journal.clearance": ["50 um", "60 um"]}`.
        Each key is a dimension of its own, so that all combinations are solved. Keys given as (dimension,
        values) share that dimension, for example for Monte Carlo samples:
        `{"journal.clearance": ("sample", c), ...}`.
    path : path, optional
        NetCDF file to write. While the sweep runs, its rows are kept in a folder beside this file. If the
        same sweep is started again after an interruption, it continues from these rows.
    changes : mapping of str to object, optional
        Values of further keys at all points, in place of those of the scene.
    workers : int, optional
        Number of processes on this machine; by default as many as it has cores, if the points take longer
        than starting these. 1 uses this process.
    dask : str, optional
        Address of a Dask scheduler whose workers solve the points instead.
    runs : bool
        Whether each point is a run over time, as `rotorfilm run` makes it, on threads of this process.
    report : callable
        Called with the fraction done and a text.

    Returns
    -------
    xarray.Dataset
        Variables for a scene with a question: `value`, `error_estimate`, `met`, `model`. Without a question:
        `eccentricity_ratio`, `attitude_angle`, `minimum_film`, `stiffness`, `damping`, `power_loss`,
        `friction_torque`, `side_flow`, `threshold_speed`, `whirl_ratio`, `model`. For runs: `end_speed`,
        `contact_time` if a journal touches, and `peak`, `vibration` and `vibration_speed` of each journal and
        probe, such as `journal_peak`. A point without an answer
        has the reason in `failure` and not-a-number elsewhere; warnings are in `remarks`.

    Raises
    ------
    InputError
        If an argument breaks its rule, xarray is not installed, the path holds another sweep, or a scene
        without a question has no bearing with a film or a bush.
    SceneError
        If a scene file may not have the scene or one of the values.

    Warns
    -----
    UserWarning
        If some points have no answer, with their number.
    """
    _require_xarray()
    tables, source = _tables(scene)
    tables = varied(tables, changes)
    axes = read_axes(parameters)
    target = None if path is None else _file(path)
    if workers is not None:
        require_count("workers", workers)
        require_at_most("workers", workers, WORKERS)
    if runs and dask is not None:
        raise InputError(f"dask must be None for runs, which share threads of this process, got {dask!r}")
    read = check(tables, axes, source, runs)
    name = _name(tables, axes, runs)
    if target is not None and target.is_file():
        return load(target, name)
    local = partial(runs_here if runs else solved_locally, workers, read)
    solve = local if dask is None else partial(solved_by_dask, dask)
    rows = _rows(tables, axes, source, name, target, solve=solve, report=report)
    dataset = to_dataset(axes, rows, {"sweep": name, "scene": source, "rotorfilm": version("rotorfilm")})
    if target is not None:
        save(dataset, target, name)
        _waiting(target).unlink()
    failed = sum("failure" in row for row in rows)
    if failed:
        warn_user(f"{failed} of {len(rows)} points have no answer; `failure` says why")
    return dataset


def _require_xarray() -> None:
    missing = [name for name in ("xarray", "h5netcdf", "h5py") if find_spec(name) is None]
    if missing:
        raise InputError(f"a sweep needs {', '.join(missing)} of {EXTRA}")


EXTRA = "the extra `sweep`: python -m pip install '.[sweep]' in the source of rotorfilm"
"""Where the packages of a sweep come from."""


def _tables(scene: str | os.PathLike[str] | Mapping[str, Any]) -> tuple[Mapping[str, Any], str]:
    if isinstance(scene, Mapping):
        return scene, "scene"
    return read_tables(scene), str(scene)


def _name(tables: Mapping[str, Any], axes: tuple[Axis, ...], runs: bool) -> str:
    """Return a fingerprint of the scene and of all values."""
    varied_by = [[axis.key, axis.dimension, list(axis.values)] for axis in axes]
    parts = [tables, varied_by, version("rotorfilm"), *(["runs"] if runs else [])]
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
    solve: Solving,
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
        for number, row in solve(tables, todo, source):
            rows[number] = row
            if store is not None:
                store.add(number, row)
            report(len(rows) / len(every), f"{len(rows)} of {len(every)} points")
    finally:
        if store is not None:
            store.close()
    return [rows[number] for number, _ in every]


# The rows of a sweep as an xarray.Dataset with units, and on disk as NetCDF.


INNER = ("row", "column")
"""Dimensions of what is a vector or a matrix at each point."""


def to_dataset(axes: Sequence[Axis], rows: Sequence[Row], attributes: Mapping[str, str]) -> xarray.Dataset:
    """Return the dataset of all points; numbers that a point does not have are not-a-number, texts empty."""
    import xarray

    lengths = sizes(axes)
    names = sorted({name for row in rows for name in row if name != "unit"} | {"failure"})
    units = {"value": next((row["unit"] for row in rows if "unit" in row), "")}
    return xarray.Dataset(
        {name: _variable(name, rows, lengths, units.get(name) or unit_of(name)) for name in names},
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


# The rows of a sweep on disk while it runs: one line each, so that nothing done is lost.


HEAD = "rows of a sweep, version 1"
"""What the first line of a file belongs to."""


class Store:
    """A file of rows, to be added to and read again.

    Parameters
    ----------
    path : Path
        Its first line names the sweep, each other one holds a point and its row, behind its checksum.
    name : str
        Name of the sweep: another one in the file is refused.

    Raises
    ------
    InputError
        If the file holds another sweep, or none.

    Warns
    -----
    FileWarning
        Of damaged rows, which are left out.
    """

    def __init__(self, path: Path, name: str) -> None:
        self.path, self.name = path, name
        self.rows: dict[int, Row] = {}
        head = sealed_line(json.dumps({"sweep": name}), HEAD)
        content = path.read_bytes() if path.is_file() else b""
        # What was cut off when the sweep was killed is computed again.
        whole = content[: content.rfind(b"\n") + 1].splitlines(keepends=True)
        if not head.startswith(content):
            self._require_same(whole[0] if whole else content)
        kept = [line for line in whole[1:] if self._read(line)]
        if lost := len(whole[1:]) - len(kept):
            warn_user(f"{lost} damaged rows of {str(path)!r} are computed again", FileWarning)
        if (found := head + b"".join(kept)) != content:
            write_atomically(path, found)
        self._file: IO[bytes] = path.open("ab")

    def _read(self, line: bytes) -> bool:
        """Take the row of a line; return whether it is one."""
        text = unsealed_line(line, self.name)
        if text is not None:
            entry = json.loads(text)
            self.rows[entry["point"]] = entry["row"]
        return text is not None

    def _require_same(self, line: bytes) -> None:
        text = unsealed_line(line, HEAD)
        if text is None:
            raise InputError(
                f"path must leave {str(self.path)!r} to the rows of a sweep, got another file there, or a "
                "damaged one"
            )
        if json.loads(text)["sweep"] != self.name:
            raise InputError(
                f"path must be that of the same sweep, or of none, got {str(self.path)!r} with the rows of "
                "another scene or of other values; delete the file or choose another path"
            )

    def add(self, point: int, row: Row) -> None:
        """Keep a row; it is on disk when this returns."""
        self.rows[point] = row
        with failures_named(self.path):
            self._file.write(sealed_line(json.dumps({"point": point, "row": row}), self.name))
            self._file.flush()
            os.fsync(self._file.fileno())

    def close(self) -> None:
        """Close the file."""
        with failures_named(self.path):
            self._file.close()


# Who solves the points of a sweep: this process, processes of this machine, or a Dask cluster.


Points = Sequence[tuple[int, dict[str, Any]]]
"""Numbers of points, and the values of the keys there."""

Solving = Callable[[Mapping[str, Any], Points, str], Iterator[tuple[int, Row]]]
"""Takes the tables of a scene, points and the name of the scene, and yields the rows of the points."""


def solved_here(
    scene: Mapping[str, Any], todo: Points, source: str, read: Mapping[int, Scene] = MappingProxyType({})
) -> Iterator[tuple[int, Row]]:
    """Yield the rows of points, one after the other; scenes that were read are not read again."""
    for number, values in todo:
        yield number, solve_point(scene, values, source, read.get(number))


RUNS_PER_THREAD = 2
"""Runs whose results wait to be kept; each has megabytes of samples."""


def runs_here(
    workers: int | None, read: Mapping[int, Scene], scene: Mapping[str, Any], todo: Points, source: str
) -> Iterator[tuple[int, Row]]:
    """Yield the rows of points that are runs over time, some for each of `workers` threads at once."""
    cores = workers or os.cpu_count() or 1
    for k in range(0, len(todo), RUNS_PER_THREAD * cores):
        yield from run_points(scene, todo[k : k + RUNS_PER_THREAD * cores], source, read, cores).items()


START, ANSWER = 3.0, 1.0
"""Time in which a process starts and imports what it needs [s], about, and in which it gives an answer."""

TRIED, SHARES = 2, 4
"""Points that are solved here, to see how long one takes, and the fewest answers of each process."""


def solved_locally(
    workers: int | None, read: Mapping[int, Scene], scene: Mapping[str, Any], todo: Points, source: str
) -> Iterator[tuple[int, Row]]:
    """Yield the rows of points, solved here and, where there is time to gain, by processes of this machine.

    With a number of `workers` more than one they are used whatever a point takes.
    """
    cores = workers or os.cpu_count() or 1
    for done, one in enumerate(todo):
        begin, left = time.monotonic(), todo[done + 1 :]
        yield from solved_here(scene, [one], source, read)
        each = time.monotonic() - begin
        if done + 1 >= TRIED and min(cores, len(left)) > 1 and (workers or each * len(left) > START):
            size = min(int(ANSWER / each), len(left) // (SHARES * cores))
            yield from solved_by_processes(scene, left, source, min(cores, len(left)), max(1, size))
            return


def _solve_part(scene: Mapping[str, Any], part: Points, source: str) -> list[tuple[int, Row]]:
    with one_blas_thread:
        return list(solved_here(scene, part, source))


def solved_by_processes(
    scene: Mapping[str, Any], todo: Points, source: str, workers: int, size: int
) -> Iterator[tuple[int, Row]]:
    """Yield the rows of points, `size` of them at a time, as processes of this machine complete them."""
    # Forked processes would inherit threads and locks of libraries that were loaded before.
    context = multiprocessing.get_context("spawn")
    parts = [todo[k : k + size] for k in range(0, len(todo), size)]
    with ProcessPoolExecutor(workers, mp_context=context) as pool:
        futures = [pool.submit(_solve_part, scene, part, source) for part in parts]
        try:
            for future in as_completed(futures):
                yield from future.result()
        finally:
            pool.shutdown(wait=True, cancel_futures=True)


def solved_by_dask(
    address: str, scene: Mapping[str, Any], todo: Points, source: str
) -> Iterator[tuple[int, Row]]:
    """Yield the rows of points as a Dask cluster completes them.

    Raises
    ------
    InputError
        If Dask is not installed, or nobody answers at the address.
    """
    try:
        from distributed import Client, as_completed as completed
    except ImportError:
        raise InputError(f"dask needs distributed of {EXTRA}") from None
    try:
        client = Client(address, timeout=10)
    except OSError as error:
        raise InputError(
            f"dask must be the address of a scheduler that answers, got {address!r}: {error}"
        ) from None
    with client:
        futures = {
            client.submit(solve_point, scene, values, source, pure=False): number for number, values in todo
        }
        for future in completed(list(futures)):
            yield futures[future], future.result()
