"""What the physics of films on pads leaves out, judged by dimensionless numbers."""

from __future__ import annotations

import math
import warnings
from dataclasses import replace

from ...bearings.pads import LobedBearing, PadGridFilm, PadMapFilm, PressureDamBearing, TiltingPadBearing
from ...errors import RotorfilmError, ValidityWarning
from ...linear import equilibrium
from ..journal.film_candidate import room
from ..journal.journal_remarks import NOTABLE, REMARKS, film_numbers
from ..lubricant_table import Lubricant
from ..remarks import Remark, said

PAD_REMARKS = (
    Remark(
        "thinning",
        NOTABLE,
        "heat: along one pad the oil warms by about {warming:.2g} K if it keeps its heat, which takes "
        "{thinning:.0%} of its viscosity; nor does hot oil go on from pad to pad",
        moves="heat",
    ),
    *(remark for remark in REMARKS if remark.number not in ("thinning", "unknown")),
)
"""What the physics of films on pads leaves out, by the numbers of `pad_numbers`."""

CELLS, DAM_CELLS = (48, 4), (32, 8)
"""Of films whose temperature is wanted in no time."""

AnyPads = LobedBearing | PressureDamBearing | TiltingPadBearing


def pad_numbers(
    bearing: AnyPads, oil: Lubricant, speed: float, load: tuple[float, float]
) -> dict[str, float]:
    """Return the dimensionless numbers of a bearing.

    Returns
    -------
    dict of str to float
        Those of `film_numbers`, over the assembled clearance c, and
        warming [K] : of oil that goes along the longest pad and keeps its heat, 2 viscosity speed R^2
        extent/(density heat capacity c^2), or between cold walls viscosity U^2/(8 conductivity), the lesser.
        thinning : relative loss of viscosity by that.
    """
    R, c, mu, omega = bearing.radius, room(bearing), bearing.film_viscosity, abs(speed)
    carried = 2.0 * mu * omega * R**2 * max(bearing.extents) / (oil.density * oil.heat_capacity * c**2)
    conducted = mu * (omega * R) ** 2 / (8.0 * oil.conductivity)
    warming = min(carried, conducted)
    dimensions = R, bearing.length, c, mu
    return {
        **film_numbers(dimensions, oil, speed, load),
        "warming": warming,
        "thinning": -math.expm1(-oil.thinning * warming),
    }


def pad_remarks(bearing: AnyPads, oil: Lubricant, speed: float, load: tuple[float, float]) -> tuple[str, ...]:
    """Return what is left out and should not be, one line each; the arguments are of `pad_numbers`.

    Of films on an oil it is said at their temperature, and that they warm is not left out.
    """
    remarks: tuple[Remark, ...] = PAD_REMARKS
    if bearing.oil is not None:
        remarks = tuple(remark for remark in PAD_REMARKS if remark.number != "thinning")
        bearing = _warmed(bearing, speed, load)
    return said(remarks, pad_numbers(bearing, oil, speed, load))


def quick_pads(bearing: AnyPads) -> AnyPads:
    """Return a bearing with its own films, or on coarse grids where those would take long."""
    if isinstance(bearing, PressureDamBearing):
        return replace(bearing, cells=DAM_CELLS)
    film = bearing.film
    if not isinstance(film, PadMapFilm) or any(
        film.making_time(extent, bearing.slenderness) for extent in bearing.extents
    ):
        return replace(bearing, film=PadGridFilm(cells=CELLS))
    return bearing


def _warmed(bearing: AnyPads, speed: float, load: tuple[float, float]) -> AnyPads:
    """Return a bearing at the temperature of its balance, or of fresh oil where it has no rest."""
    if not bearing.is_warming:
        return bearing
    with warnings.catch_warnings(action="ignore", category=ValidityWarning):
        try:
            at = equilibrium(quick_pads(bearing), load, speed)
        except RotorfilmError:
            return bearing.at_temperature(bearing.cooled[1].coldest)
    assert at.temperature is not None  # of films that warm
    return bearing.at_temperature(at.temperature)
