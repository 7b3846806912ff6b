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
)
from ...bearings.films.cavitation import FullFilm, HalfSommerfeld
from ...bearings.sprung import Sprung
from ...errors import ValidityWarning, require_non_negative
from ..tables import Quantity, Table, Variant, flag


@dataclass(frozen=True, kw_only=True)
class CageTable:
    """`cage = {thickness, permeability, ...}`: a porous cage.

    Parameters
    ----------
    thickness : float [m]
        Radial, of the layer.
    permeability : float [m2]
        Through the layer, at its face to the film.
    grading : float [1]
        lambda of k = permeability exp(lambda y/thickness), y <= 0.
    anisotropy : float [1]
        Permeability along the layer / through it.
    vented : bool
        Whether its back is open to the supply pressure.
    supply_pressure : float [Pa]
        Gauge pressure there.
    thin : bool
        Morgan & Cameron's layer in place of Darcy's.
    """

    thickness: Annotated[float, Quantity("m")]
    permeability: Annotated[float, Quantity("m2")]
    grading: Annotated[float, Quantity("1")] = 0.0
    anisotropy: Annotated[float, Quantity("1")] = 1.0
    vented: Annotated[bool, flag] = False
    supply_pressure: Annotated[float, Quantity("Pa")] = 0.0
    thin: Annotated[bool, flag] = False

    def __post_init__(self) -> None:
        self.build()

    def build(self) -> PorousCage:
        """Return the cage."""
        return PorousCage(
            thickness=self.thickness,
            permeability=self.permeability,
            grading=self.grading,
            anisotropy=self.anisotropy,
            vented=self.vented,
            supply_pressure=self.supply_pressure,
            thin=self.thin,
        )


@dataclass(frozen=True, kw_only=True)
class RadialFeedTable:
    """`feed = {kind = "radial"}`: lubricant pressed through the cage.

    Parameters
    ----------
    inflow : float [m/s]
        Velocity at the back of the cage, towards the film.
    cosine : bool
        Whether it falls as a cosine from the middle to the ends.
    at_film : bool
        Whether the velocity is that into the film.
    """

    inflow: Annotated[float, Quantity("m/s")]
    cosine: Annotated[bool, flag] = False
    at_film: Annotated[bool, flag] = False

    def build(self) -> RadialFeed:
        """Return the feed."""
        return RadialFeed(inflow=self.inflow, cosine=self.cosine, at_film=self.at_film)


@dataclass(frozen=True, kw_only=True)
class AxialFeedTable:
    """`feed = {kind = "axial"}`: lubricant fed at both ends.

    Parameters
    ----------
    start_pressure, end_pressure : float [Pa]
        Gauge pressures at z = -length/2 and length/2.
    """

    start_pressure: Annotated[float, Quantity("Pa")]
    end_pressure: Annotated[float, Quantity("Pa")]

    def build(self) -> AxialFeed:
        """Return the feed."""
        return AxialFeed(start_pressure=self.start_pressure, end_pressure=self.end_pressure)


FeedTable = RadialFeedTable | AxialFeedTable
FEEDS: dict[str, type] = {"radial": RadialFeedTable, "axial": AxialFeedTable}
EXTENTS: dict[str, type] = {"half_sommerfeld": HalfSommerfeld, "full": FullFilm}


@dataclass(frozen=True, kw_only=True)
class ShortSqueezeTable:
    """`film = {name = "short"}`: a short film, by quadrature or closed form."""

    def build(self) -> ShortSqueeze:
        """Return the film."""
        return ShortSqueeze()


@dataclass(frozen=True, kw_only=True)
class MapSqueezeTable:
    """`film = {name = "map"}`: the short film on a map, which also runs without Python inside an FMU."""

    def build(self) -> MapSqueeze:
        """Return the film."""
        return MapSqueeze()


@dataclass(frozen=True, kw_only=True)
class FiniteSqueezeTable:
    """`film = {name = "finite"}`: a full film of finite length."""

    def build(self) -> FiniteSqueeze:
        """Return the film."""
        return FiniteSqueeze()


@dataclass(frozen=True, kw_only=True)
class FiniteMapSqueezeTable:
    """`film = {name = "finite_map"}`: a film of finite length on a map, which is kept on disk."""

    def build(self) -> FiniteMapSqueeze:
        """Return the film."""
        return FiniteMapSqueeze()


@dataclass(frozen=True, kw_only=True)
class PublishedSqueezeTable:
    """`film = {name = "published"}`: small motion as published, for history."""

    def build(self) -> PublishedSqueeze:
        """Return the film."""
        return PublishedSqueeze()


SqueezeTable = (
    ShortSqueezeTable | MapSqueezeTable | FiniteSqueezeTable | FiniteMapSqueezeTable | PublishedSqueezeTable
)
SQUEEZES: dict[str, type[SqueezeTable]] = {
    "short": ShortSqueezeTable,
    "map": MapSqueezeTable,
    "finite": FiniteSqueezeTable,
    "finite_map": FiniteMapSqueezeTable,
    "published": PublishedSqueezeTable,
}
"""Squeeze films by their names in scene files."""


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
    cage : CageTable or None
        None for a solid one.
    extent : FullFilm or HalfSommerfeld
        Whether the film carries tension.
    feed : FeedTable or None
    film : SqueezeTable or None
        The film law; if the file does not say, the short film, or what the question of the scene needs.
    """

    radius: Annotated[float, Quantity("m", twice="diameter")]
    length: Annotated[float, Quantity("m")]
    clearance: Annotated[float, Quantity("m")]
    viscosity: Annotated[float, Quantity("Pa.s")]
    stiffness: Annotated[float, Quantity("N/m")] = 0.0
    cage: Annotated[CageTable | None, Table(CageTable)] = None
    extent: Annotated[FullFilm | HalfSommerfeld, Variant("kind", EXTENTS)] = field(
        default_factory=HalfSommerfeld
    )
    feed: Annotated[FeedTable | None, Variant("kind", FEEDS)] = None
    film: Annotated[SqueezeTable | None, Variant("name", SQUEEZES)] = None

    def __post_init__(self) -> None:
        require_non_negative("stiffness", self.stiffness)
        with warnings.catch_warnings():
            # Which film answers is not known yet; a run of this one warns when it is built.
            warnings.simplefilter("ignore", ValidityWarning)
            self.build()

    def build(self) -> PorousDamper:
        """Return the damper without its springs; raise InputError where a value breaks its rule."""
        return PorousDamper(
            radius=self.radius,
            length=self.length,
            clearance=self.clearance,
            viscosity=self.viscosity,
            cage=None if self.cage is None else self.cage.build(),
            extent=self.extent,
            feed=None if self.feed is None else self.feed.build(),
            film=(self.film or ShortSqueezeTable()).build(),
        )

    def support(self) -> PorousDamper | Sprung:
        """Return the damper with its springs, if it has some."""
        damper = self.build()
        return Sprung(reaction=damper, stiffness=self.stiffness) if self.stiffness else damper
