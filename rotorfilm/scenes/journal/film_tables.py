"""The film, its rupture, and openings of the bearing in scene files: schema 1."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

from ...bearings import journal
from ...bearings.films.cavitation import Complementarity, FullFilm, HalfSommerfeld
from ...bearings.films.conserved.conserved_cells import require_conserved_cells
from ...bearings.films.film_start import FreeStart, HeldLine, WidestGap
from ...bearings.films.geometry import FeedHole, Groove, Pad
from ...bearings.films.law import FilmLaw
from ...errors import SceneError, brief
from ...limits import FILM_CELLS, FUNCTIONS, MAP_NODES
from ..reading.readers import Count, Counts, takes
from ..reading.tables import Keyed, Quantity, Variant, flag

ORDER = Count(FUNCTIONS)


@takes([ORDER, (ORDER, {"inf": None})])
def read_order(where: str, value: Any) -> tuple[int, int | None]:
    """Read an order [n, m] of the splitting method; m may be "inf", all axial modes."""
    if not isinstance(value, list) or len(value) != 2:
        raise SceneError(f"{where} must be [n, m] of positive integers, m also 'inf', got {brief(value)}")
    n, m = value
    return ORDER(f"{where}[0]", n), None if m == "inf" else ORDER(f"{where}[1]", m)


CELLS = Counts(("around", "along"), FILM_CELLS)
"""Reader of the cells of a two-dimensional film, around it and along half its length."""

NODES = Counts(("over", "turning", "moving"), MAP_NODES)
"""Reader of the nodes of a map with openings."""

RUPTURES: dict[str, Callable[[], Keyed]] = {
    "fixed": lambda: Keyed(journal.FixedArc, {"start": Quantity("rad"), "extent": Quantity("rad")}),
    "rotating": lambda: Keyed(journal.RotatingArc),
    "reynolds": lambda: Keyed(journal.ReynoldsArc, {"start": Quantity("rad")}),
    "complementarity": lambda: Keyed(journal.ComplementarityArc),
}
"""`rupture = {kind = "fixed", ...}`: rupture rules of the splitting film by their names."""

CAVITATIONS: dict[str, Keyed] = {
    "complementarity": Keyed(Complementarity),
    "half_sommerfeld": Keyed(HalfSommerfeld),
    "full": Keyed(FullFilm),
}
"""What the two-dimensional film does in tension, by name."""

STARTS: dict[str, Keyed] = {
    "free": Keyed(FreeStart),
    "widest_gap": Keyed(WidestGap),
    "line": Keyed(HeldLine, {"line": Quantity("rad")}),
}
"""Where the two-dimensional film of a bearing without openings starts, by name."""


@dataclass(frozen=True, kw_only=True)
class ConservedOil:
    """`film = {name = "jfo"}`: the film that conserves its oil, which is no law of the moment; see `JFOFilm`.

    Parameters
    ----------
    cells : tuple of int
    """

    cells: tuple[int, int] = (144, 12)

    def __post_init__(self) -> None:
        require_conserved_cells(self.cells)


FILMS: dict[str, Callable[[], Keyed[FilmLaw | ConservedOil]]] = {
    # With grooves or several pads at ambient pressure that is `grooved_map` with its defaults.
    "map": lambda: Keyed(journal.MapFilm),
    "grooved_map": lambda: Keyed(
        journal.GroovedMapFilm,
        {"cells": CELLS, "nodes": NODES, "largest_eccentricity_ratio": Quantity("1")},
    ),
    "reynolds": lambda: Keyed(
        journal.ReynoldsFilm,
        {
            "cells": CELLS,
            "cavitation": Variant("kind", CAVITATIONS),
            "film_start": Variant("kind", STARTS),
        },
    ),
    "jfo": lambda: Keyed(ConservedOil, {"cells": CELLS}),
    "short": lambda: Keyed(journal.ShortFilm),
    "splitting": lambda: Keyed(
        journal.SplittingFilm,
        {"order": read_order, "constant": flag, "rupture": Variant("kind", RUPTURES)},
        required=("order",),
    ),
}
"""`film = {name = "map"}`: film laws by their names in scene files and at the command line."""

PAD = Keyed(Pad, {"start": Quantity("rad"), "extent": Quantity("rad")})
"""`pads = [{start, extent}]`: a fixed pad."""

GROOVE = Keyed(Groove, {"center": Quantity("rad"), "width": Quantity("rad"), "length": Quantity("m")})
"""`grooves = [{center, width, length}]`: an axial groove."""

FEED_HOLE = Keyed(FeedHole, {"center": Quantity("rad"), "diameter": Quantity("m")})
"""`feed_holes = [{center, diameter}]`: a round hole at mid-length."""
