"""A film that conserves its oil as a kernel of the C library: its tables, and what a simulator may set."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from ....model import Array
from ....native.spec import NativeParameter, NativeSpec, parameter
from .step_kernel import MovingFilm, shape_of


class OilNumbers(NamedTuple):
    """What a film in SI units has besides its shape.

    Attributes
    ----------
    radius : float [m]
    viscosity : float [Pa s]
    cavitation_pressure : float [Pa]
        In the cavity, from ambient pressure.
    supplied : ndarray of bool, shape (openings,)
        Which openings are at the supply; the others are at ambient pressure.
    supply_pressure : float or None [Pa]
        None where there is no such supply.
    supply_flow : float or None [m3/s]
        To each opening, in place of a pressure.
    stiffness : float or None [N/m]
        Of springs beside the film; None where there are none.
    """

    radius: float
    viscosity: float
    cavitation_pressure: float
    supplied: np.ndarray
    supply_pressure: float | None = None
    supply_flow: float | None = None
    stiffness: float | None = None


def oil_spec(moving: MovingFilm, numbers: OilNumbers) -> NativeSpec:
    """Return the kernel `conserved_film`; its tables are those of `kernel_conserved_film.c`."""
    shape, rows = shape_of(moving.film)
    fed, given = numbers.supply_flow is not None, numbers.supply_pressure is not None
    film = [
        *(numbers.radius, moving.clearance, moving.oil / moving.clearance, shape.slenderness),
        *(numbers.cavitation_pressure, moving.carrying, shape.center),
        *(moving.largest_angle, moving.largest_way),
        *(fed or given, fed, numbers.stiffness is not None),
    ]
    tables: dict[str, Array] = {
        "film": np.array(film, dtype=float),
        "lines": np.vstack([rows.spacing[None], rows.direction.reshape(4, -1)]),
        "width": rows.width,
        "cells": np.stack([rows.conductance, rows.opening.astype(float)]),
        "supplied": np.append(numbers.supplied, False).astype(float),
    }
    return NativeSpec(kernel="conserved_film", parameters=_parameters(numbers), tables=tables)


def _parameters(numbers: OilNumbers) -> tuple[NativeParameter, ...]:
    rows = (
        ("viscosity", "Pa.s", numbers.viscosity, "dynamic viscosity"),
        ("supply_pressure", "Pa", numbers.supply_pressure, "gauge pressure of the supply"),
        ("supply_flow", "m3/s", numbers.supply_flow, "oil given to each opening"),
        ("stiffness", "N/m", numbers.stiffness, "of springs beside the film, along either axis"),
    )
    return tuple(parameter(name, unit, value, text) for name, unit, value, text in rows if value is not None)
