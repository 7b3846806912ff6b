"""The films of pads in scene files: schema 1."""

from __future__ import annotations

from collections.abc import Callable

from ...bearings.pads import PadFilm, PadGridFilm, PadMapFilm
from ..journal.film_tables import CELLS
from ..reading.tables import Keyed

PAD_FILMS: dict[str, Callable[[], Keyed[PadFilm]]] = {
    "map": lambda: Keyed(PadMapFilm),
    "reynolds": lambda: Keyed(PadGridFilm, {"cells": CELLS}),
}
"""`film = {name = "map"}`: the films of a pad by their names."""


def pad_film_name(film: PadFilm) -> str:
    """Return what the film of a pad is called in print."""
    if isinstance(film, PadGridFilm):
        return f"2-D {film.cells[0]} x {film.cells[1]} extr. on each pad"
    return "map of a pad"
