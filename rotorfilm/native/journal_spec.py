"""The kernel of the C library that is a journal bearing over a film."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace

import numpy as np

from ..model import Array
from .map_slice import slice_table
from .spec import NativeSpec, parameter

NATIVE_PARAMETERS = (
    ("radius", "m", "bearing radius"),
    ("length", "m", "axial length"),
    ("clearance", "m", "radial clearance"),
    ("viscosity", "Pa.s", "dynamic viscosity"),
)
"""Names, units and meanings of what a simulator may set in the compiled bearing."""

SCALES = {"clearance", "viscosity"}
"""Those of them that only scale a film: the others change what the map of a film depends on."""


def journal_spec(
    kernel: str, tables: Mapping[str, Array], dimensions: Mapping[str, float], *, fixed: bool
) -> NativeSpec:
    """Return the kernel of a journal bearing.

    Parameters
    ----------
    kernel : str
    tables : mapping of str to ndarray
        Of the film.
    dimensions : mapping of str to float
        Radius, length, clearance [m] and viscosity [Pa s].
    fixed : bool
        Whether the film is for one length / diameter only, so that radius and length are fixed.
    """
    bounds = _bounds(tables.get("range")) if tables else ""
    parameters = tuple(
        parameter(name, unit, dimensions[name], text)
        if name in SCALES
        else parameter(name, unit, dimensions[name], text + bounds, tunable=not fixed)
        for name, unit, text in NATIVE_PARAMETERS
    )
    return NativeSpec(kernel=kernel, parameters=parameters, tables=tables)


def sized_spec(spec: NativeSpec) -> NativeSpec | None:
    """Return the kernel with the map of its own length / diameter in place of the map over all of them.

    Radius and length are fixed then. None for a kernel without such a map.
    """
    layers = spec.tables.get("coefficients", np.zeros(0))
    numbers = {parameter.name: parameter.value for parameter in spec.parameters}
    if layers.ndim != 3 or len(layers) == 1 or not {"radius", "length"} <= set(numbers):
        return None
    slenderness = numbers["length"] / (2.0 * numbers["radius"])
    low, high = spec.tables["range"]
    own, center = slice_table(layers, spec.tables["center"], (float(low), float(high)), slenderness)
    tables = {
        "coefficients": own[None],
        "center": np.array([center]),
        "range": np.array([slenderness, slenderness]),
    }
    parameters = tuple(
        replace(p, tunable=False, description=f"{p.description.partition(';')[0]}{_bounds(None)}")
        if p.name in ("radius", "length")
        else p
        for p in spec.parameters
    )
    return replace(spec, parameters=parameters, tables={**spec.tables, **tables})


def _bounds(slenderness_range: Array | None) -> str:
    """Return what the description of radius and length says of their range."""
    if slenderness_range is None:
        return "; fixed, as the map of the film holds for this length / diameter"
    low, high = slenderness_range
    return f"; length / diameter must stay from {low:g} to {high:g}"
