"""Runs and states of a point contact in NetCDF files."""

from __future__ import annotations

import io
import json
from pathlib import Path
from typing import Any

import numpy as np
from scipy.io import netcdf_file

from ....files import read_sealed, write_sealed
from ..film.film_equations import ContactEquations
from ..film.linear_contact import Closure, Place
from .contact_run import SERIES
from .contact_state import ContactRun, state_of
from .contact_steps import Memory
from .levels import Level

COLUMNS = (*SERIES, "driven")

FACTS = ("complete", "work", "asked")

PLACE = {"pressure": "cell", "film": "sample", "wet": "cell"}
"""Arrays of a `Place`, and their dimensions."""


def save_run(run: ContactRun, path: str | Path, contact: str) -> None:
    """Write a run and what it takes to go on with it as NetCDF 3 with a seal; snapshots are not written.

    Parameters
    ----------
    run : ContactRun
    path : str or Path
    contact : str
        What was computed, to be compared on loading.
    """
    file: Any
    buffer = io.BytesIO()
    place = run.memory.place
    facts: dict[str, Any] = {name: getattr(run, name) for name in FACTS}
    facts |= {"step": run.memory.step}
    tables: dict[str, Any] = {name: (("step",), getattr(run, name)) for name in COLUMNS}
    for name in Level._fields:
        values = np.array([getattr(level, name) for level in run.final.levels])
        tables[f"level_{name}"] = ("level", "cell")[: values.ndim], values
    if place is not None:
        facts |= {"closure": list(place.closure), "rate": place.rate}
        for name, dimension in PLACE.items():
            tables[f"place_{name}"] = (dimension,), getattr(place, name)
    with netcdf_file(buffer, "w") as file:
        file.contact, file.facts = contact.encode(), json.dumps(facts).encode()
        for name, (dimensions, values) in tables.items():
            for dimension, size in zip(dimensions, values.shape, strict=True):
                if dimension not in file.dimensions:
                    file.createDimension(dimension, size)
            file.createVariable(name, "f8", dimensions)[:] = values
        file.flush()
        write_sealed(path, buffer.getvalue(), contact)


def load_run(path: str | Path, contact: str, equations: ContactEquations) -> ContactRun:
    """Return a run that `save_run` wrote.

    Raises
    ------
    InputError
        If the file is damaged, or of another contact.
    """
    content = read_sealed(path, contact, f"path must be a run of {contact}")
    file: Any
    with netcdf_file(io.BytesIO(content), "r", mmap=False) as file:
        arrays: dict[str, Any] = {
            name: np.array(variable[:], dtype=float) for name, variable in file.variables.items()
        }
        facts = json.loads(file.facts.decode())
    rows = zip(*(arrays[f"level_{name}"] for name in Level._fields), strict=True)
    levels = tuple(Level(float(t), float(d), float(v), p, s) for t, d, v, p, s in rows)
    place = None
    if "closure" in facts:
        pressure, film, wet = (arrays[f"place_{name}"] for name in PLACE)
        place = Place(pressure, film, wet > 0.0, Closure(*facts["closure"]), facts["rate"])
    return ContactRun(
        **{name: arrays[name] for name in COLUMNS},
        **{name: facts[name] for name in FACTS},
        snapshots=(),
        final=state_of(equations, levels),
        memory=Memory(facts["step"], place, facts["work"]),
    )
