"""Where the oil of a squeeze-film damper comes from."""

from __future__ import annotations

from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from ....errors import (
    InputError,
    require_kind,
    require_non_negative,
    require_number,
    require_tuple,
)
from ....inputs.si_arguments import quantities
from ...films.conserved.air_at_ends import warn_of_air
from ...films.conserved.conserved_film import Supply
from ...films.conserved.oil_spec import OilNumbers
from ...films.geometry import FeedHole, FilmGeometry, Pocket

REMEDY = (
    "supply_pressure with circumferential_groove (its width), end_groove=True or "
    "feed_holes=(FeedHole(...),), or ends in an oil bath with a cavity below ambient "
    "(submerged=True, cavitation_pressure=-1e5)"
)


@quantities
@dataclass(frozen=True, kw_only=True)
class DamperSupply:
    """What feeds a squeeze-film damper that conserves its oil: a groove all round, holes, or an oil bath.

    Pressures count from ambient pressure.

    Parameters
    ----------
    supply_pressure : float [Pa]
        In the groove or the holes.
    circumferential_groove : float or None [m]
        Width of a groove all round in the middle of the length, which has no film; None for none.
    end_groove : bool
        Whether the oil comes from a groove all round beyond one end of the film; the other end is open.
    feed_holes : tuple of FeedHole
        In the middle of the length.
    cavitation_pressure : float [Pa]
        In the cavity, not above 0.
    submerged : bool
        Whether there is oil around open ends. It is what they draw in where the film is below ambient
        pressure; in air that would be air, of which there is a warning.

    Raises
    ------
    InputError
        If there is no supply, without which the film runs dry, or more than one kind, or a value breaks its
        rule.
    """

    supply_pressure: float = 0.0
    circumferential_groove: float | None = None
    end_groove: bool = False
    feed_holes: tuple[FeedHole, ...] = ()
    cavitation_pressure: float = 0.0
    submerged: bool = False

    def __post_init__(self) -> None:
        require_non_negative("supply_pressure", self.supply_pressure)
        if not require_number("cavitation_pressure", self.cavitation_pressure) <= 0.0:
            raise InputError(f"cavitation_pressure must not be above 0, got {self.cavitation_pressure!r}")
        if self.circumferential_groove is not None:
            require_non_negative("circumferential_groove", self.circumferential_groove)
        require_kind("end_groove", self.end_groove, bool, "True or False")
        require_kind("submerged", self.submerged, bool, "True or False")
        require_tuple("feed_holes", self.feed_holes, FeedHole)
        self._require_one()

    def _require_one(self) -> None:
        grooves = self.circumferential_groove is not None, self.end_groove
        kinds = sum((*grooves, bool(self.feed_holes)))
        if kinds > 1:
            raise InputError(
                "a damper must be fed by one of circumferential_groove, end_groove and feed_holes, "
                f"got {self!r}"
            )
        if self.supply_pressure > 0.0 and not kinds:
            raise InputError(
                f"supply_pressure must be 0 without a groove or feed_holes, got {self.supply_pressure!r}"
            )
        pressure = self.supply_pressure - self.cavitation_pressure if kinds or self.submerged else 0.0
        if pressure <= 0.0:
            raise InputError(
                "a damper must have a supply above the pressure of its cavity, or a film that conserves its "
                f"oil runs dry: {REMEDY}, got {self!r}"
            )

    @property
    def grooved(self) -> bool:
        """Whether a groove all round feeds the film, in its middle or at one end."""
        return self.circumferential_groove is not None or self.end_groove

    @property
    def turns_alike(self) -> bool:
        """Whether the supply is the same all round, so that a centered circular orbit is a steady state."""
        return not self.feed_holes

    def warn_of_air(self, drawn_in: float, side_flow: float) -> None:
        """Warn where ends in air would draw in air."""
        warn_of_air(self.submerged, drawn_in, side_flow)


class SuppliedFilm(NamedTuple):
    """Supply and openings of a film, without dimensions, and the lengths that go with them.

    Attributes
    ----------
    geometry : FilmGeometry
    supply : Supply
    length : float [m]
        Of the film, from end to end; that of its mirror image included where a groove is at one end.
    share : float [1]
        Of that length which is there: 1, or 1/2 of a film with its mirror image.
    """

    geometry: FilmGeometry
    supply: Supply
    length: float
    share: float


def supplied_film(given: DamperSupply, radius: float, length: float, pressure_scale: float) -> SuppliedFilm:
    """Return a supply as the film of a damper sees it.

    Parameters
    ----------
    given : DamperSupply
    radius, length : float [m]
        Of the damper; the length with that of a groove in its middle.
    pressure_scale : float [Pa s]
        12 viscosity (radius/clearance)^2, the film's unit of pressure per 1/s.

    Raises
    ------
    InputError
        If a groove or a hole is too wide.
    """
    width = given.circumferential_groove or 0.0
    if width >= length:
        raise InputError(f"circumferential_groove must be below the length {length!r}, got {width!r}")
    pockets = tuple(_pocket(hole, radius, length) for hole in given.feed_holes)
    end, held = -given.cavitation_pressure / pressure_scale, given.supply_pressure / pressure_scale
    geometry = FilmGeometry(pockets=pockets, supply=held, circumferential=given.grooved)
    count = len(geometry.openings())
    supply = Supply(
        pressure=np.full(count, end + held),
        fed=np.zeros(count, dtype=bool),
        flow=np.zeros(count),
        end_pressure=end,
        center_pressure=end + held,
    )
    return SuppliedFilm(
        geometry, supply, *((2.0 * length, 0.5) if given.end_groove else (length - width, 1.0))
    )


def damper_numbers(given: DamperSupply, radius: float, viscosity: float, stiffness: float) -> OilNumbers:
    """Return what the kernel of a film has besides its shape."""
    supplied = np.ones(len(given.feed_holes), dtype=bool)
    return OilNumbers(
        radius=radius,
        viscosity=viscosity,
        cavitation_pressure=given.cavitation_pressure,
        supplied=supplied,
        supply_pressure=given.supply_pressure if given.grooved or supplied.any() else None,
        stiffness=stiffness,
    )


def _pocket(hole: FeedHole, radius: float, length: float) -> Pocket:
    largest = min(length * hole.diameter / hole.side, 2.0 * radius)
    if hole.diameter >= largest:
        raise InputError(f"diameter of a hole must be below {largest:.6g} m, got {hole.diameter!r}")
    return Pocket(center=hole.center, width=hole.side / radius, share=hole.side / length)
