"""`[damper]`: a squeeze-film damper with its retainer springs in scene files, schema 1."""

from __future__ import annotations

import warnings
from dataclasses import dataclass, field
from typing import Annotated

from ...bearings.damper import (
    AxialFeed,
    FiniteMapSqueeze,
    FiniteSqueeze,
    MapSqueeze,
    PorousCage,
    PorousDamper,
    PublishedSqueeze,
    RadialFeed,
    ShortSqueeze,
    SqueezeLaw,
)
from ...bearings.films.cavitation import FullFilm, HalfSommerfeld
from ...bearings.sprung import Sprung
from ...errors import ValidityWarning, require_non_negative
from ..reading.shared_fields import made_from
from ..reading.tables import Keyed, Quantity, Table, Variant, flag

CAGE = Keyed(
    PorousCage,
    {
        "thickness": Quantity("m"),
        "permeability": Quantity("m2"),
        "grading": Quantity("1"),
        "anisotropy": Quantity("1"),
        "vented": flag,
        "supply_pressure": Quantity("Pa"),
        "thin": flag,
    },
)
"""`cage = {thickness, permeability, ...}`: a porous cage."""

FEEDS: dict[str, Keyed] = {
    "radial": Keyed(RadialFeed, {"inflow": Quantity("m/s"), "cosine": flag, "at_film": flag}),
    "axial": Keyed(AxialFeed, {"start_pressure": Quantity("Pa"), "end_pressure": Quantity("Pa")}),
}
"""`feed = {kind = "radial", ...}`: how lubricant is fed, through the cage or at both ends."""

EXTENTS: dict[str, Keyed] = {"half_sommerfeld": Keyed(HalfSommerfeld), "full": Keyed(FullFilm)}

SQUEEZES: dict[str, Keyed[SqueezeLaw]] = {
    "short": Keyed(ShortSqueeze),
    "map": Keyed(MapSqueeze),
    "finite": Keyed(FiniteSqueeze),
    "finite_map": Keyed(FiniteMapSqueeze),
    "published": Keyed(PublishedSqueeze),
}
"""`film = {name = "short"}`: squeeze films by their names in scene files."""


@dataclass(frozen=True, kw_only=True)
class DamperTable:
    """`[damper]`: a squeeze-film damper and its retainer springs.

    Parameters
    ----------
    radius : float [m]
        Of the film; a file may give `diameter` instead.
    length, clearance : float [m]
        Axial length, radial clearance.
    viscosity : float [Pa s]
    stiffness : float [N/m]
        Of the retainer springs, which carry the static load; 0 for none.
    cage : PorousCage or None
        None for a solid one.
    extent : FullFilm or HalfSommerfeld
        Whether the film carries tension.
    feed : RadialFeed, AxialFeed or None
    film : SqueezeLaw or None
        The film law; if the file does not say, the short film, or what the question of the scene needs.
    """

    radius: Annotated[float, Quantity("m", twice="diameter")]
    length: Annotated[float, Quantity("m")]
    clearance: Annotated[float, Quantity("m")]
    viscosity: Annotated[float, Quantity("Pa.s")]
    stiffness: Annotated[float, Quantity("N/m")] = 0.0
    cage: Annotated[PorousCage | None, Table(CAGE)] = None
    extent: Annotated[FullFilm | HalfSommerfeld, Variant("kind", EXTENTS)] = field(
        default_factory=HalfSommerfeld
    )
    feed: Annotated[RadialFeed | AxialFeed | None, Variant("kind", FEEDS)] = None
    film: Annotated[SqueezeLaw | None, Variant("name", SQUEEZES)] = None

    def __post_init__(self) -> None:
        require_non_negative("stiffness", self.stiffness)
        with warnings.catch_warnings():
            # Which film answers is not known yet; a run of this one warns when it is built.
            warnings.simplefilter("ignore", ValidityWarning)
            self.build()

    def build(self) -> PorousDamper:
        """Return the damper without its springs; raise InputError where a value breaks its rule."""
        return made_from(PorousDamper, self, film=self.film or ShortSqueeze())

    def support(self) -> PorousDamper | Sprung:
        """Return the damper with its springs, if it has some."""
        damper = self.build()
        return Sprung(reaction=damper, stiffness=self.stiffness) if self.stiffness else damper
