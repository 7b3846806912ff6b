"""What an answer repeats of the question: the bearing in SI, and the film law that answered."""

from __future__ import annotations

from dataclasses import dataclass

from ...bearings.films.geometry import FeedHole, Groove, Pad
from ...bearings.journal import JournalBearing
from ...readable.result import Readable
from ..reading.shared_fields import made_from


@dataclass(frozen=True, kw_only=True)
class BearingData(Readable):
    """A journal bearing as it was understood.

    Attributes
    ----------
    radius, length, clearance : float [m]
    slenderness : float [1]
        Length / diameter of the film.
    viscosity : float [Pa s]
        Of the film, or of fresh oil where the temperature follows from the balance of its heat.
    pads : tuple of Pad
        Empty for the full circumference; angles in the bearing frame [rad].
    grooves : tuple of Groove or FeedHole
        Angles in the bearing frame [rad].
    supply_pressure : float [Pa]
        Gauge pressure in grooves and holes.
    circumferential_groove : float or None [m]
        Axial width of a groove all round; None for none.
    """

    radius: float
    length: float
    slenderness: float
    clearance: float
    viscosity: float
    pads: tuple[Pad, ...]
    grooves: tuple[Groove | FeedHole, ...]
    supply_pressure: float
    circumferential_groove: float | None = None


def bearing_data(bearing: JournalBearing) -> BearingData:
    """Return what a journal bearing is, without its film."""
    viscosity = bearing.film_viscosity
    return made_from(BearingData, bearing, slenderness=bearing.slenderness, viscosity=viscosity)
