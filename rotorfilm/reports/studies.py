"""Sections of a report about a scene at many values of its keys: sweeps and studies of tolerances."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

import numpy as np

from .. import charts
from ..charts import CurveMark, Picture, PicturePanel
from ..core.frames import Column, ResultTable
from ..core.readable import column_scale, label_of
from ..sweeps import sweep, tolerance_study
from .page import Block, ReportSection

if TYPE_CHECKING:
    import xarray

    from ..scenes import Scene


def study_sections(
    scene: Scene, vary: Mapping[str, Any], tolerances: Mapping[str, Any], quantity: str, samples: int
) -> list[ReportSection]:
    """Return the sections of a sweep and of a study of tolerances, those that are asked for."""
    found = []
    if vary:
        found.append(ReportSection("Sweep", sweep_blocks(sweep(scene.given, vary, workers=1))))
    if tolerances:
        study = tolerance_study(scene.given, tolerances, quantity, samples=samples, workers=1)
        pictures = [charts.picture_of(study), charts.picture_of(study, "tornado")]
        found.append(ReportSection("Tolerances", [study._rows(), *study._pages(), *pictures]))
    return found


def sweep_blocks(found: xarray.Dataset) -> list[Block]:
    """Return the table of a sweep, and its pictures over one key or two."""
    keys = [name for name in found.coords if "key" in found[name].attrs]
    numbers = [
        name
        for name in found.data_vars
        if found[name].dtype.kind == "f" and found[name].dims == found["failure"].dims
    ]
    frame = found[[*numbers, "model", "failure"] if "model" in found else [*numbers, "failure"]]
    flat = frame.to_dataframe().reset_index()
    units = {name: found[name].attrs.get("units", "") for name in (*keys, *numbers)}
    table = ResultTable(
        tuple(Column(str(name), units.get(name, ""), flat[name].to_numpy()) for name in flat), "Points"
    )
    lines = len(keys) == 1 and found[keys[0]].dtype.kind in "fi"
    maps = (
        len(keys) == 2 and found["failure"].ndim == 2 and all(found[key].dtype.kind in "fi" for key in keys)
    )
    pictures = [_line(found, keys[0], name) for name in numbers if lines]
    pictures += [_map(found, keys, name) for name in numbers if maps]
    return [table, *pictures]


def _scaled(found: xarray.Dataset, name: Any) -> tuple[str, np.ndarray]:
    """Return the label of a quantity with its unit, and its numbers in that."""
    unit, values = column_scale(str(name), found[name].attrs.get("units", ""), found[name].values)
    return f"{label_of(str(name))} [{unit or '1'}]", values


def _line(found: xarray.Dataset, key: Any, name: Any) -> Picture:
    (along, x), (label, y) = _scaled(found, key), _scaled(found, name)
    return Picture((PicturePanel([CurveMark(x, y, marker="o")], along, label),), size=(6.4, 3.6))


def _map(found: xarray.Dataset, keys: list[Any], name: Any) -> Picture:
    (along, x), (upright, y), (label, values) = (_scaled(found, one) for one in (*keys, name))
    return charts.plot_map(x, y, np.transpose(values), labels=(along, upright, label))
