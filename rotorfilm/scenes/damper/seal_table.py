"""`[damper.seals]`: seals at both ends of a squeeze film, by leakage, by their gap or by a leak test."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Annotated

from ...bearings.damper import EndSeal, gap_seal, leak_test_seal
from ...errors import InputError
from ..reading.tables import Quantity

WAYS = (("leakage",), ("gap", "gap_length"), ("flow", "pressure"))
"""Keys of each way to say how seals leak."""


@dataclass(frozen=True, kw_only=True)
class SealsTable:
    """`[damper.seals]`: equal seals at both ends.

    Parameters
    ----------
    leakage : float or None [m2/(Pa s)]
        Volume per time, circumference and pressure; 0 for tight seals, as O-rings.
    gap, gap_length : float or None [m]
        Instead: a narrow gap, along the radius and along the axis.
    flow, pressure : float or None [m3/s], [Pa]
        Instead: of a leak test, out of one end.
    uncertainty : float [1]
        Of the leakage, relative; an answer then says how far it may move.
    """

    leakage: Annotated[float | None, Quantity("m2/(Pa.s)")] = None
    gap: Annotated[float | None, Quantity("m")] = None
    gap_length: Annotated[float | None, Quantity("m")] = None
    flow: Annotated[float | None, Quantity("m3/s")] = None
    pressure: Annotated[float | None, Quantity("Pa")] = None
    uncertainty: Annotated[float, Quantity("1")] = 0.0

    def __post_init__(self) -> None:
        given = tuple(name for way in WAYS for name in way if getattr(self, name) is not None)
        if given not in WAYS:
            raise InputError(
                "seals must have leakage, or gap and gap_length, or flow and pressure, got "
                f"{', '.join(given) or 'none'}"
            )
        _ = self.seal(viscosity=1.0, radius=1.0)

    def seal(self, *, viscosity: float, radius: float) -> EndSeal:
        """Return the seals of a film of a viscosity [Pa s] and a radius [m]."""
        if self.gap is not None and self.gap_length is not None:
            found = gap_seal(height=self.gap, length=self.gap_length, viscosity=viscosity)
        elif self.flow is not None and self.pressure is not None:
            found = leak_test_seal(flow=self.flow, pressure=self.pressure, radius=radius)
        else:
            found = EndSeal(leakage=self.leakage or 0.0)
        return replace(found, uncertainty=self.uncertainty)
