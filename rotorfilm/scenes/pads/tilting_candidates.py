"""The films that may answer for a bearing of tilting pads, the cheapest first, and what is richer."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace

from ...bearings.pads import (
    PadFilm,
    PadGridFilm,
    PadMapFilm,
    TiltingPadBearing,
    TiltingPads,
    differenced_slopes,
    is_pad_mappable,
)
from ...model import Array
from ...results import Coefficients
from ..journal.film_candidate import CELL_TIME, FilmCandidate
from ..journal.film_defects import STEP
from .pad_films import pad_film_name

GRIDS = (((48, 4), 1e-4, 1e-3), ((96, 8), 1e-5, 2e-4), ((192, 16), 1e-6, 5e-5))
"""Cells, and orders of magnitude of the error of a position, and of K and C."""

MAP_CALL = 2e-4
"""About what the force of pads at rest takes by a map [s]: each is looked for in all its tilts."""

LOOKS = 60
"""Films of one pad in the search for its tilt at rest."""


@dataclass(frozen=True, kw_only=True)
class TiltingCandidate(FilmCandidate):
    """A film of pads that may answer for a bearing of tilting ones.

    Attributes
    ----------
    reaction : TiltingPadBearing
        With this film.
    rich : TiltingPadBearing
        With the richer one.
    """

    reaction: TiltingPadBearing
    rich: TiltingPadBearing

    @property
    def call_time(self) -> float:
        """About what a force with derivatives of pads at rest takes [s]."""
        film = self.reaction.film
        if not isinstance(film, PadGridFilm):
            return MAP_CALL
        return LOOKS * len(self.reaction.pivots) * CELL_TIME * math.prod(film.cells)

    def coefficients(self, position: Array, speed: float) -> Coefficients:
        """Return what the journal feels of the richer film once a turn, its slopes smooth."""
        return self.rich.at_rest().matrices(position, speed, smooth_slopes).reduced(abs(speed))

    @property
    def resting(self) -> FilmCandidate:
        """The forces of both on a journal at rest, each pad in its tilt."""
        return FilmCandidate(
            name=self.name,
            reaction=self.reaction.at_rest(),
            rich=self.rich.at_rest(),
            rich_name=self.rich_name,
            position_prior=self.position_prior,
            prior=self.prior,
        )


def smooth_slopes(bearing: TiltingPads, e: Array, w: Array) -> tuple[Array, Array]:
    """Return dF/de and dF/dw of pads on a grid, the latter by differences over `STEP`."""
    return differenced_slopes(bearing, e, w, STEP)


def tilting_candidates(bearing: TiltingPadBearing, *, fixed: bool) -> tuple[TiltingCandidate, ...]:
    """Return the films that can answer for a bearing of tilting pads: the map if it is there, and grids.

    Parameters
    ----------
    bearing : TiltingPadBearing
    fixed : bool
        Whether the scene names the film of the bearing, so that no other may answer.
    """
    film = bearing.film
    if fixed:
        return (_candidate(bearing, film, pad_film_name(film), 0.0, 0.0),)
    grids = [
        _candidate(bearing, PadGridFilm(cells=cells), f"2-D {cells[0]} x {cells[1]} extr.", *priors)
        for cells, *priors in GRIDS
    ]
    if not is_pad_mappable(bearing.extent, bearing.slenderness):
        return tuple(grids)
    fine = _candidate(bearing, PadMapFilm(), "pad map", 2e-5, 1e-3)
    return tuple(grids) if fine.makes_map else (fine, *grids)


def _candidate(
    bearing: TiltingPadBearing, film: PadFilm, name: str, position_prior: float, prior: float
) -> TiltingCandidate:
    making, rich = 0.0, (96, 8)
    if isinstance(film, PadGridFilm):
        rich = 2 * film.cells[0], 2 * film.cells[1]
    elif isinstance(film, PadMapFilm):
        making = film.making_time(bearing.extent, bearing.slenderness)
    return TiltingCandidate(
        name=name,
        reaction=replace(bearing, film=film),
        rich=replace(bearing, film=PadGridFilm(cells=rich)),
        rich_name=f"2-D {rich[0]} x {rich[1]} extr.",
        position_prior=position_prior,
        prior=prior,
        making=making,
    )
