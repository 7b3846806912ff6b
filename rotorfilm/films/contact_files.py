"""Runs and states of a point contact in NetCDF files."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import numpy as np
from scipy.io import netcdf_file

from ..errors import InputError
from .contact_equations import ContactEquations
from .contact_levels import Level
from .contact_run import SERIES
from .contact_state import ContactRun, state_of

COLUMNS = (*SERIES, "driven")


def save_run(run: ContactRun, path: str | Path, contact: str) -> None:
    """Write a run and its final state as NetCDF 3; snapshots are not written.

    Parameters
    ----------
    run : ContactRun
    path : str or Path
    contact : str
        What was computed, to be compared on loading.
    """
    file: Any
    with netcdf_file(path, "w") as file:
        file.contact, file.complete = contact.encode(), int(run.complete)
        file.work = json.dumps(run.work).encode()
        for name, size in (
            ("step", len(run.time)),
            ("level", len(run.final.levels)),
            ("cell", run.final.pressure.size),
        ):
            file.createDimension(name, size)
        for name in COLUMNS:
            file.createVariable(name, "f8", ("step",))[:] = getattr(run, name)
        for name in Level._fields:
            values = np.array([getattr(level, name) for level in run.final.levels])
            dimensions = ("level", "cell")[: values.ndim]
            file.createVariable(f"level_{name}", "f8", dimensions)[:] = values


def load_run(path: str | Path, contact: str, equations: ContactEquations) -> ContactRun:
    """Return a run that `save_run` wrote.

    Raises
    ------
    InputError
        If the file is of another contact.
    """
    file: Any
    with netcdf_file(path, "r", mmap=False) as file:
        if file.contact.decode() != contact:
            raise InputError(f"path must be a run of {contact}, got one of {file.contact.decode()}")
        arrays = {name: np.array(variable[:], dtype=float) for name, variable in file.variables.items()}
        complete, work = bool(file.complete), json.loads(file.work.decode())
    rows = zip(*(arrays[f"level_{name}"] for name in Level._fields), strict=True)
    levels = tuple(Level(float(t), float(d), float(v), p, s) for t, d, v, p, s in rows)
    return ContactRun(
        **{name: arrays[name] for name in COLUMNS},
        snapshots=(),
        final=state_of(equations, levels),
        complete=complete,
        work=work,
    )
