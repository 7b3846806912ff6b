"""The film, its rupture, and openings of the bearing in scene files: schema 1."""

from __future__ import annotations

import math
from dataclasses import dataclass, field
from typing import Annotated, Any

from ...bearings.films.cavitation import Cavitation, Complementarity, FullFilm, HalfSommerfeld
from ...bearings.films.geometry import Groove, Pad
from ...bearings.journal import (
    ComplementarityArc,
    FixedArc,
    GroovedMapFilm,
    MapFilm,
    ReynoldsArc,
    ReynoldsFilm,
    RotatingArc,
    ShortFilm,
    SplittingFilm,
)
from ...errors import SceneError
from ...limits import FILM_CELLS, FUNCTIONS, MAP_NODES
from ...printable import brief
from ..readers import Count, read_counts
from ..tables import Quantity, Variant, flag


def read_order(where: str, value: Any) -> tuple[int, int | None]:
    """Read an order [n, m] of the splitting method; m may be "inf", all axial modes."""
    if not isinstance(value, list) or len(value) != 2:
        raise SceneError(f"{where} must be [n, m] of positive integers, m also 'inf', got {brief(value)}")
    n, m = value
    read = Count(FUNCTIONS)
    return read(f"{where}[0]", n), None if m == "inf" else read(f"{where}[1]", m)


def read_cells(where: str, value: Any) -> tuple[int, int]:
    """Read the cells [around, along] of a two-dimensional film."""
    around, along = read_counts(where, value, ("around", "along"), FILM_CELLS)
    return around, along


def read_nodes(where: str, value: Any) -> tuple[int, int, int]:
    """Read the nodes of a map with openings."""
    over, turning, moving = read_counts(where, value, ("over", "turning", "moving"), MAP_NODES)
    return over, turning, moving


@dataclass(frozen=True, kw_only=True)
class FixedArcTable:
    """`rupture = {kind = "fixed"}`: the film lies on an arc fixed to the line of maximum film.

    Parameters
    ----------
    start, extent : float [rad]
        Where the arc starts, and its length, in the sense of rotation.
    """

    start: Annotated[float, Quantity("rad")] = 0.0
    extent: Annotated[float, Quantity("rad")] = math.pi

    def __post_init__(self) -> None:
        self.build()

    def build(self) -> FixedArc:
        """Return the rupture rule."""
        return FixedArc(start=self.start, extent=self.extent)


@dataclass(frozen=True, kw_only=True)
class RotatingArcTable:
    """`rupture = {kind = "rotating"}`: the film lies where the wedge and squeeze press it."""

    def build(self) -> RotatingArc:
        """Return the rupture rule."""
        return RotatingArc()


@dataclass(frozen=True, kw_only=True)
class ReynoldsArcTable:
    """`rupture = {kind = "reynolds"}`: the film ends where its pressure leaves with no slope.

    Parameters
    ----------
    start : float or None [rad]
        Where the film starts, from the line of maximum film; if the file does not say, where the wedge and
        squeeze begin to press it.
    """

    start: Annotated[float | None, Quantity("rad")] = None

    def __post_init__(self) -> None:
        self.build()

    def build(self) -> ReynoldsArc:
        """Return the rupture rule."""
        return ReynoldsArc(start=self.start)


@dataclass(frozen=True, kw_only=True)
class ComplementarityArcTable:
    """`rupture = {kind = "complementarity"}`: the film starts and ends where pressure has no slope."""

    def build(self) -> ComplementarityArc:
        """Return the rupture rule."""
        return ComplementarityArc()


RuptureTable = FixedArcTable | RotatingArcTable | ReynoldsArcTable | ComplementarityArcTable
RUPTURES = {
    "fixed": FixedArcTable,
    "rotating": RotatingArcTable,
    "reynolds": ReynoldsArcTable,
    "complementarity": ComplementarityArcTable,
}
"""Rupture rules of the splitting film by their names."""

CAVITATIONS = {"complementarity": Complementarity, "half_sommerfeld": HalfSommerfeld, "full": FullFilm}
"""What the two-dimensional film does in tension, by name."""


@dataclass(frozen=True, kw_only=True)
class ShortFilmTable:
    """`film = {name = "short"}`: the short-bearing film on a moving arc of half a turn."""

    def build(self) -> ShortFilm:
        """Return the film law."""
        return ShortFilm()


@dataclass(frozen=True, kw_only=True)
class SplittingFilmTable:
    """`film = {name = "splitting"}`: the splitting method of order (n, m).

    Parameters
    ----------
    order : (int, int or None)
        Circumferential functions and odd axial modes; `[2, "inf"]` takes all axial modes.
    constant : bool
        Whether the constant function joins the circumferential ones.
    rupture : FixedArcTable, RotatingArcTable, ReynoldsArcTable or ComplementarityArcTable
        Where the film begins and ends.
    """

    order: Annotated[tuple[int, int | None], read_order]
    constant: Annotated[bool, flag] = False
    rupture: Annotated[RuptureTable, Variant("kind", RUPTURES)] = field(default_factory=FixedArcTable)

    def __post_init__(self) -> None:
        self.build()

    def build(self) -> SplittingFilm:
        """Return the film law."""
        return SplittingFilm(order=self.order, constant=self.constant, rupture=self.rupture.build())


@dataclass(frozen=True, kw_only=True)
class MapFilmTable:
    """`film = {name = "map"}`: the film with Reynolds rupture, from its impedance map.

    With grooves or several pads at ambient pressure that is `grooved_map` with its defaults.
    """

    def build(self) -> MapFilm:
        """Return the film law."""
        return MapFilm()


@dataclass(frozen=True, kw_only=True)
class GroovedMapFilmTable:
    """`film = {name = "grooved_map"}`: the impedance map of a bearing with grooves, made on first use.

    Parameters
    ----------
    cells : (int, int)
        Cells of the two-dimensional film around it and along half the length.
    nodes : (int, int, int)
        Nodes over the eccentricity ratio, its direction and that of the motion.
    largest_eccentricity_ratio : float [1]
        Of the last node.
    """

    cells: Annotated[tuple[int, int], read_cells] = GroovedMapFilm.cells
    nodes: Annotated[tuple[int, int, int], read_nodes] = GroovedMapFilm.nodes
    largest_eccentricity_ratio: Annotated[float, Quantity("1")] = GroovedMapFilm.largest_eccentricity_ratio

    def __post_init__(self) -> None:
        self.build()

    def build(self) -> GroovedMapFilm:
        """Return the film law."""
        return GroovedMapFilm(
            cells=self.cells,
            nodes=self.nodes,
            largest_eccentricity_ratio=self.largest_eccentricity_ratio,
        )


@dataclass(frozen=True, kw_only=True)
class ReynoldsFilmTable:
    """`film = {name = "reynolds"}`: the film in two dimensions, which may have pads and grooves.

    Parameters
    ----------
    cells : (int, int)
        Cells around the film and along half the length.
    cavitation : Complementarity, HalfSommerfeld or FullFilm
        What the film does in tension.
    """

    cells: Annotated[tuple[int, int], read_cells] = ReynoldsFilm.cells
    cavitation: Annotated[Cavitation, Variant("kind", CAVITATIONS)] = field(default_factory=Complementarity)

    def __post_init__(self) -> None:
        self.build()

    def build(self) -> ReynoldsFilm:
        """Return the film law."""
        return ReynoldsFilm(cells=self.cells, cavitation=self.cavitation)


FilmTable = MapFilmTable | GroovedMapFilmTable | ReynoldsFilmTable | ShortFilmTable | SplittingFilmTable
FILMS = {
    "map": MapFilmTable,
    "grooved_map": GroovedMapFilmTable,
    "reynolds": ReynoldsFilmTable,
    "short": ShortFilmTable,
    "splitting": SplittingFilmTable,
}
"""Film laws by their names in scene files and at the command line."""


@dataclass(frozen=True, kw_only=True)
class PadTable:
    """`pads = [{start, extent}]`: a fixed pad.

    Parameters
    ----------
    start, extent : float [rad]
        First end in the bearing frame, from +x towards +y, and angle covered.
    """

    start: Annotated[float, Quantity("rad")]
    extent: Annotated[float, Quantity("rad")]

    def __post_init__(self) -> None:
        self.build()

    def build(self) -> Pad:
        """Return the pad."""
        return Pad(start=self.start, extent=self.extent)


@dataclass(frozen=True, kw_only=True)
class GrooveTable:
    """`grooves = [{center, width}]`: an axial groove.

    Parameters
    ----------
    center, width : float [rad]
        Angle of its middle in the bearing frame, from +x towards +y, and angle covered.
    """

    center: Annotated[float, Quantity("rad")]
    width: Annotated[float, Quantity("rad")] = 0.0

    def __post_init__(self) -> None:
        self.build()

    def build(self) -> Groove:
        """Return the groove."""
        return Groove(center=self.center, width=self.width)
