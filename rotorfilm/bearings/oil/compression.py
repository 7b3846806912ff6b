"""How much the load of a bearing compresses its oil, which films of one density and viscosity leave out."""

from __future__ import annotations

import math

from ...errors import warn_user
from ...model import Array
from ..film_units import FilmUnits

BULK_MODULUS = 1.5e9
"""Of a mineral oil [Pa], pressure per relative change of volume."""

MOST = 0.5
"""Compression by the mean pressure from which a film without it is no answer, whatever the oil.

Bearings carry a hundredth of that. Scenes, which know their oil, tell of less.
"""


def compression(
    load: tuple[float, float] | Array, radius: float, length: float, bulk_modulus: float = BULK_MODULUS
) -> float:
    """Return the relative change of volume [1] of oil by the mean pressure |load|/(2 radius length).

    Parameters
    ----------
    load : array_like, shape (2,) [N]
    radius, length : float [m]
        Of the bearing.
    bulk_modulus : float [Pa]
    """
    return math.hypot(*load) / (2.0 * radius * length) / bulk_modulus


def warn_of_pressure(reaction: object, load: Array) -> None:
    """Warn of a load [N] whose mean pressure is beyond films of one density and viscosity."""
    bearing = getattr(reaction, "bearing", reaction)  # of a film that is told which bearing is around it
    if not isinstance(bearing, FilmUnits):
        return
    R, L = bearing.radius, bearing.length  # type: ignore[attr-defined]
    share = compression(load, R, L)
    if share > MOST:
        warn_user(
            f"load {math.hypot(*load):.6g} N makes a mean pressure of {share * BULK_MODULUS:.3g} Pa over "
            f"2 radius length, {share:.0%} of the bulk modulus of a mineral oil: a film of one density and "
            "viscosity does not hold there"
        )
