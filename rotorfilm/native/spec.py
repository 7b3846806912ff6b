"""What a model with a kernel in the C library says of itself: the kernel's name, its numbers and tables."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from typing import Protocol, runtime_checkable

import numpy as np

from ..core.errors import InputError
from ..core.model import Array, Linearization
from ..core.signals import Signal
from .library import functions


@dataclass(frozen=True, kw_only=True)
class NativeParameter(Signal):
    """A number of a kernel that a simulator may set.

    Parameters
    ----------
    name, unit, description : str
        Name, unit and description as for a `Signal`; the name is unique within the kernel.
    nominal, minimum, maximum : float
        Nominal, minimum and maximum as for a `Signal`.
    value : float
        Its value in the model, the start value.
    tunable : bool
        Whether it may be set between steps; otherwise only before and during initialization.

    Raises
    ------
    InputError
        If the value is not finite or outside its bounds, or a field breaks its rule.
    """

    value: float
    tunable: bool
    nominal: float = 1.0
    description: str = ""

    def __post_init__(self) -> None:
        super().__post_init__()
        if not (math.isfinite(self.value) and self.minimum <= self.value <= self.maximum):
            raise InputError(
                f"value of {self.name} must be within {self.minimum!r} and {self.maximum!r}, "
                f"got {self.value!r}"
            )


def parameter(
    name: str, unit: str, value: float, description: str, *, tunable: bool = True, minimum: float = 0.0
) -> NativeParameter:
    """Return a parameter whose own value is the typical one."""
    return NativeParameter(
        name=name,
        unit=unit,
        value=value,
        tunable=tunable,
        minimum=minimum,
        nominal=abs(value) or 1.0,
        description=description,
    )


@dataclass(frozen=True, kw_only=True, eq=False)
class NativeSpec:
    """A kernel of the C library with its numbers.

    Parameters
    ----------
    kernel : str
        Name in `native/kernels/kernel_list.h`.
    parameters : tuple of NativeParameter
        Parameters in the order of the kernel.
    tables : mapping of str to ndarray
        Finite numbers of at most four axes, by the name that the kernel asks for.
    inputs : tuple of str or None
        Inputs of the model that the kernel takes, in its order; the others have no effect. None for all.
    spring : str
        Parameter that is a stiffness [N/m] beside the model, along either axis; empty where there is none.
    parts : tuple of str
        Kernels that it calls, as a system those of its bearings.
    sampled : tuple of str or None
        Of a kernel whose parameters are a map, sampled over one input: the name of the sampling points, which
        are numbered from 1 as `speeds_1`, and the input. All other parameters are values at these points.

    Raises
    ------
    InputError
        If two parameters have one name, or a table is not finite or has more than four axes.
    """

    kernel: str
    parameters: tuple[NativeParameter, ...] = ()
    tables: Mapping[str, Array] = field(default_factory=dict)
    inputs: tuple[str, ...] | None = None
    spring: str = ""
    parts: tuple[str, ...] = ()
    sampled: tuple[str, str] | None = None

    def __post_init__(self) -> None:
        names = [parameter.name for parameter in self.parameters]
        if len(set(names)) < len(names):
            raise InputError(f"parameters must have different names, got {names}")
        for name, table in self.tables.items():
            if np.ndim(table) > 4 or not np.isfinite(table).all():
                raise InputError(f"table {name} must be finite with at most four axes, got {np.shape(table)}")

    def stiffened(self, stiffness: float) -> NativeSpec | None:
        """Return this kernel with more stiffness [N/m] beside the model; None if it takes none."""
        if not self.spring:
            return None
        parameters = tuple(
            replace(p, value=p.value + stiffness, nominal=stiffness) if p.name == self.spring else p
            for p in self.parameters
        )
        return replace(self, parameters=parameters)


@runtime_checkable
class HasKernel(Protocol):
    """A Model that the C library runs without Python."""

    def native(self) -> NativeSpec | None:
        """Return its kernel; None if this instance has none, as a bearing under a film without kernel."""


def linear_kernel(at: Linearization) -> NativeSpec:
    """Return the kernel of a linear model without parameters, which starts at zero."""
    return NativeSpec(kernel="linear", tables=dict(zip("ABCD", map(np.asarray, at), strict=True)))


# The kernel of the C library that is a journal bearing over a film.


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
        Tables of the film.
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
    if layers.ndim != 3 or len(layers) == 1 or "range" not in spec.tables:
        return None
    slenderness = numbers["length"] / (2.0 * numbers["radius"])
    low, high = spec.tables["range"].tolist()
    tables = {
        name: slice_table(spec.tables[name], (low, high), slenderness)[None]
        for name in ("coefficients", "center")
    } | {"range": np.array([slenderness, slenderness])}
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


# The map of one bearing from the table of all.


def slice_table(layers: Array, slenderness_range: tuple[float, float], slenderness: float) -> Array:
    """Return the numbers of one bearing from those of all.

    Parameters
    ----------
    layers : ndarray, shape (s, ...)
        Quintic B-spline coefficients over ln(L/D); s = 1 for a single bearing.
    slenderness_range : (float, float)
        Smallest and largest L/D.
    slenderness : float
        L/D within that range.
    """
    numbers, ends = np.ascontiguousarray(layers, dtype=float), np.array(slenderness_range, dtype=float)
    own = np.empty(numbers.shape[1:])
    places = ends.ctypes.data, slenderness, own.ctypes.data
    if functions()["rf_map_slice"](numbers.ctypes.data, len(numbers), own.size, *places):
        raise ValueError(f"slenderness must be within {slenderness_range}, got {slenderness!r}")
    return own
