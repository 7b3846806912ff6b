"""The kernel of the C library that is a journal bearing whose oil warms."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np

from ...model import Array
from ...native.heated_kernel import OilTable
from ...native.spec import NativeSpec, parameter

_PARAMETERS = (
    ("radius", "m", "bearing radius; fixed, as the map of the film holds for this length / diameter"),
    ("length", "m", "axial length; fixed, as the map of the film holds for this length / diameter"),
    ("clearance", "m", "radial clearance"),
    ("supply_temperature", "K", "temperature of the fresh oil"),
    ("ambient_temperature", "K", "temperature around the housing"),
    ("housing_conductance", "W/K", "heat flow through bush and housing per kelvin between film and ambient"),
    ("bush_heat_capacity", "J/K", "heat capacity of bush and housing"),
    ("volumetric_heat", "J/(m3.K)", "density times heat capacity of the oil"),
    ("carry_over", "1", "share of the oil arriving at an opening that goes on, 0 to 1"),
)

_FIXED = {"radius", "length"}


def heated_spec(
    values: Mapping[str, float], film: Mapping[str, Array], oil: OilTable, *, full_gap: bool
) -> NativeSpec:
    """Return the kernel of a bearing whose oil warms.

    Parameters
    ----------
    values : mapping of str to float
        Of its parameters, in SI; `carry_over` where there are openings.
    film : mapping of str to ndarray
        Tables of the film and of its losses; empty for the short film.
    oil : OilTable
    full_gap : bool
        Whether oil fills the gap also where the film is ruptured.
    """
    parameters = tuple(
        parameter(name, unit, values[name], description, tunable=name not in _FIXED)
        for name, unit, description in _PARAMETERS
        if name in values
    )
    tables = {
        **film,
        "oil": oil.coefficients,
        "oil_range": np.array([oil.coldest, oil.hottest]),
        "full_gap": np.array([float(full_gap)]),
    }
    kernel = "heated_grooved_journal" if "carry_over" in values else "heated_journal"
    return NativeSpec(kernel=kernel, parameters=parameters, tables=tables)
