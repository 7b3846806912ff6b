"""Tables of single bearings that the packaged table leaves out: very short ones and long ones.

A short film near the wall has ends as wide as it is long, and a long one closes its dry gap and then carries
pressure all round, where `potential` fails. The two-dimensional film meets both: its J = (F . w)/2,
extrapolated from two grids, has a smaller error than its force.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import lru_cache
from typing import TYPE_CHECKING

import numpy as np

from ....errors import InputError
from ....model import Array
from ...films.map_table import MapTable

if TYPE_CHECKING:
    from ..extrapolated_film import ExtrapolatedFilm
    from ..reynolds_film import ReynoldsFilm

OWN_RANGE = (0.001, 20.0)
"""Length/diameter for which a table can be made; beyond, the layers at the ends get too thin for the grid."""

TABLE_CELLS = (24, 96, 0)
REACH = 0.999
_SHORT, _LONG = (384, 16), (192, 24)


@dataclass(frozen=True)
class _TwoFilms:
    """A film, and a finer one where the journal leaves the wall: it is then opposite, where lines are few."""

    towards: ExtrapolatedFilm
    away: ExtrapolatedFilm

    def force(self, eccentricity: Array, source: Array, slenderness: float) -> Array:
        leaving = (eccentricity * source).sum(axis=0) < 0.0
        force = np.empty_like(source)
        for film, mine in ((self.towards, ~leaving), (self.away, leaving)):
            force[:, mine] = film.force(eccentricity[:, mine], source[:, mine], slenderness)
        return force


def _film(around: int, along: int) -> _TwoFilms:
    from ..extrapolated_film import ExtrapolatedFilm
    from ..reynolds_film import ReynoldsFilm

    films = (ExtrapolatedFilm(film=ReynoldsFilm(cells=(k * around, along))) for k in (1, 2))
    return _TwoFilms(*films)


def reference_film(slenderness: float) -> ReynoldsFilm:
    """Return the two-dimensional film of a bearing that the packaged table leaves out."""
    from ..reynolds_film import ReynoldsFilm

    return ReynoldsFilm(cells=_SHORT if slenderness < 1.0 else _LONG)


@lru_cache(maxsize=16)
def bearing_table(slenderness: float) -> MapTable:
    """Return the table of the full film with Reynolds rupture for one length/diameter, in half a minute.

    Parameters
    ----------
    slenderness : float [1]
        Length / diameter, .001 to 20.

    Returns
    -------
    MapTable
        Largest error of a force in nine directions, length/diameter .05 and 8: 3e-4 at eccentricity ratio
        .95, 7e-4 at .985, 3e-3 at .995 and .999.

    Raises
    ------
    InputError
        If the slenderness is outside its range.
    """
    import logging

    from ...films.map_fit import tabulate_film

    low, high = OWN_RANGE
    if not low <= slenderness <= high:
        raise InputError(f"length/diameter must be {low:g} to {high:g} for a map, got {slenderness!r}")
    logging.getLogger(__name__).warning(
        "length/diameter %.6g is outside the table of the package: making one for it, in about half a minute",
        slenderness,
    )
    return tabulate_film(
        _film(*(_SHORT if slenderness < 1.0 else _LONG)),
        slenderness_range=(slenderness, slenderness),
        cells=TABLE_CELLS,
        largest_eccentricity_ratio=REACH,
    )
