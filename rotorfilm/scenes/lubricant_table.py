"""`[lubricant]`: what the films leave out, for the numbers that say whether they may."""

from __future__ import annotations

from dataclasses import dataclass, fields
from typing import Annotated

from ..errors import require_positive
from .reading.tables import Quantity


@dataclass(frozen=True, kw_only=True)
class LubricantTable:
    """`[lubricant]`: properties that no film law has.

    The defaults are assumptions, of the order of a mineral oil; warnings that rest on them are no better.

    Parameters
    ----------
    density : float [kg/m3]
    heat_capacity : float [J/(kg K)]
        Per mass.
    conductivity : float [W/(m K)]
    thinning : float [1/K]
        -d ln(viscosity)/d temperature.
    bulk_modulus : float [Pa]
        Pressure per relative change of volume.
    """

    density: Annotated[float, Quantity("kg/m3")] = 900.0
    heat_capacity: Annotated[float, Quantity("J/(kg.K)")] = 2000.0
    conductivity: Annotated[float, Quantity("W/(m.K)")] = 0.15
    thinning: Annotated[float, Quantity("1/K")] = 0.04
    bulk_modulus: Annotated[float, Quantity("Pa")] = 1.5e9

    def __post_init__(self) -> None:
        for field in fields(self):
            require_positive(field.name, getattr(self, field.name))
