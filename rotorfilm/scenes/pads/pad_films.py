"""The films of pads in scene files: schema 1."""

from __future__ import annotations

from collections.abc import Callable, Iterable

from ...bearings.pads import PadFilm, PadGridFilm, PadMapFilm, is_pad_mappable
from ..journal.film_tables import CELLS
from ..reading.tables import Keyed

PAD_FILMS: dict[str, Callable[[], Keyed[PadFilm]]] = {
    "map": lambda: Keyed(PadMapFilm),
    "reynolds": lambda: Keyed(PadGridFilm, {"cells": CELLS}),
}
"""`film = {name = "map"}`: the films of a pad by their names."""


def usual_film(extents: Iterable[float], radius: float, length: float) -> PadFilm:
    """Return the film of pads of these extents [rad] where the file names none: the map, else a grid."""
    slenderness = length / (2.0 * radius) if radius else 0.0
    mappable = all(is_pad_mappable(extent, slenderness) for extent in extents)
    return PadMapFilm() if mappable else PadGridFilm()


def pad_film_name(film: PadFilm) -> str:
    """Return what the film of a pad is called in print."""
    if isinstance(film, PadGridFilm):
        return f"2-D {film.cells[0]} x {film.cells[1]} extr. on each pad"
    return "map of a pad"
