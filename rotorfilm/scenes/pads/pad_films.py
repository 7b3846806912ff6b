"""The films of pads in scene files: schema 1."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from typing import TypeVar

from ...bearings.pads import PadFilm, PadGridFilm, PadMapFilm
from ...errors import InputError
from ...progress import Report
from ..journal.film_tables import CELLS
from ..lubricant_table import LubricantTable
from ..reading.tables import Keyed

PAD_FILMS: dict[str, Callable[[], Keyed[PadFilm]]] = {
    "map": lambda: Keyed(PadMapFilm),
    "reynolds": lambda: Keyed(PadGridFilm, {"cells": CELLS}),
}
"""`film = {name = "map"}`: the films of a pad by their names."""

T = TypeVar("T")


def pad_film_name(film: PadFilm) -> str:
    """Return what the film of a pad is called in print."""
    if isinstance(film, PadGridFilm):
        return f"2-D {film.cells[0]} x {film.cells[1]} extr. on each pad"
    return "map of a pad"


def on_oil(table: T, where: str, lubricant: LubricantTable) -> T:
    """Return the table of a bearing with the oil of the scene, unless it has a viscosity or an oil.

    Parameters
    ----------
    table : dataclass
        With `viscosity`, `oil` and `cooling`.
    where : str
        Its name in the file, for messages.
    lubricant : LubricantTable

    Raises
    ------
    InputError
        If neither gives a viscosity.
    """
    if table.viscosity is not None or table.oil is not None:  # type: ignore[attr-defined]
        return table
    if not lubricant.has_viscosity:
        raise InputError(f"{where}.viscosity is required where [lubricant] gives no grade or viscosity")
    return replace(table, oil=lubricant.oil, cooling=lubricant.cooling)  # type: ignore[type-var]


def make_pad_maps(film: PadFilm, extents: set[float], slenderness: float, report: Report) -> None:
    """Make the maps of pads of these extents [rad], unless they lie on disk or the film is none."""
    if isinstance(film, PadMapFilm):
        for extent in sorted(extents):
            film.table(extent, slenderness, report)
