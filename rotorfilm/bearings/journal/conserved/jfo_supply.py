"""Where the oil of a journal bearing comes from, as a film that conserves it asks."""

from __future__ import annotations

import numpy as np

from ....errors import InputError
from ...films.conserved.conserved_film import Supply
from ...films.conserved.oil_spec import OilNumbers
from ..bearing import JournalBearing

REMEDY = (
    "a groove or a feed hole (grooves=(Groove(...),) of the bearing), circumferential_groove (its width), or "
    "ends in an oil bath with a cavity below ambient (submerged=True, cavitation_pressure=-1e5)"
)


def oil_supply(
    bearing: JournalBearing, supply_flow: float | None, cavitation_pressure: float, submerged: bool
) -> Supply:
    """Return the supply of a film.

    Raises
    ------
    InputError
        If the bearing has no supply, or one that such a film cannot take; the message names the remedy.
    """
    openings, geometry = bearing.geometry.openings(), bearing.geometry
    end = -cavitation_pressure / bearing.pressure_scale
    if not (openings or geometry.circumferential or (submerged and end > 0.0)):
        raise InputError(
            "bearing must have a supply, without which a film that conserves its oil runs dry: "
            f"{REMEDY}, got none"
        )
    _require_no_open_groove(bearing, supply_flow)
    _require_no_open_gap(bearing)
    count, flow = len(openings), 0.0
    if supply_flow is not None:
        _require_closed(bearing)
        flow = supply_flow / (bearing.clearance * bearing.radius * bearing.film_length)
    return Supply(
        pressure=np.array([end + (span.held or 0.0) for span in openings]),
        fed=np.full(count, supply_flow is not None),
        flow=np.full(count, flow),
        end_pressure=end,
        center_pressure=end + geometry.supply,
    )


def oil_numbers(bearing: JournalBearing, supply_flow: float | None, cavitation_pressure: float) -> OilNumbers:
    """Return what the kernel of a film has besides it; openings that end in the bearing are at the supply."""
    geometry = bearing.geometry
    supplied = np.array([span.share < 1.0 for span in geometry.openings()], dtype=bool)
    pressed = supply_flow is None and (supplied.any() or geometry.circumferential)
    return OilNumbers(
        radius=bearing.radius,
        viscosity=bearing.film_viscosity,
        cavitation_pressure=cavitation_pressure,
        supplied=supplied,
        supply_pressure=bearing.supply_pressure if pressed else None,
        supply_flow=supply_flow,
    )


def _require_no_open_groove(bearing: JournalBearing, supply_flow: float | None) -> None:
    """Raise InputError for a groove open at both ends of the bearing that is to have a pressure."""
    if bearing.geometry.grooves and (bearing.supply_pressure > 0.0 or supply_flow is not None):
        raise InputError(
            "grooves with a supply must end within the bearing, or their flow has no limit: give them a "
            f"length, as Groove(center=..., width=..., length={0.8 * bearing.length:g}), "
            f"got {bearing.geometry.grooves[0]!r}"
        )


def _require_no_open_gap(bearing: JournalBearing) -> None:
    """Raise InputError for a circumferential groove under pressure that opens into gaps between pads."""
    geometry = bearing.geometry
    if (
        geometry.circumferential
        and geometry.supply > 0.0
        and any(s.share == 1.0 for s in geometry.openings())
    ):
        raise InputError(
            "pads must have no gaps beside a circumferential_groove with a supply_pressure, which would flow "
            f"into them without limit, got {bearing.pads!r}"
        )


def _require_closed(bearing: JournalBearing) -> None:
    """Raise InputError unless every opening is one that can be given a flow."""
    if bearing.pads or not bearing.geometry.pockets or bearing.geometry.circumferential:
        raise InputError(
            "supply_flow must be None unless all openings of the bearing are grooves of a length or feed "
            f"holes, got {bearing!r}"
        )
    if bearing.supply_pressure > 0.0:
        raise InputError(
            f"supply_pressure must be 0 where supply_flow is given, got {bearing.supply_pressure!r}"
        )
