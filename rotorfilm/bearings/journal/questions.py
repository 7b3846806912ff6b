"""Questions to journal bearings: the films that may answer, those of a journal that keeps a tilt too."""

from __future__ import annotations

from collections.abc import Callable, Collection, Sequence
from dataclasses import dataclass, replace
from itertools import pairwise
from typing import TYPE_CHECKING, Any, ClassVar

import numpy as np

from ...core.errors import InputError
from ...core.results import Equilibrium
from ...questions.film_ladders import film_ladders
from ...questions.quantities import QUANTITIES
from ...scenes.film_rungs import FilmCandidate, grid_name, grid_of, point_films, turn_films
from ...scenes.oil_film_tables import has_map
from . import (
    ExtrapolatedFilm,
    HeldTilt,
    JournalBearing,
    MapFilm,
    MomentCarryingJournal,
    ReynoldsFilm,
    TiltLevel,
    film_name,
    has_tilt_map,
    is_mapped,
)

if TYPE_CHECKING:
    from ...scenes.scene import Scene


CELLS = (96, 8), (192, 16), (384, 16)
"""Cells of films over the whole length, each judged by the next."""

SLOPES = 2.0
"""Error of K and C over that of the force, as a tilt makes it."""

UNSURE = 2.0
"""Error over its estimate, at most."""


@dataclass(frozen=True)
class TiltLevelFilm(FilmCandidate):
    """A level of a tilted journal that may answer, and the film over the whole length beside it.

    Both are reactions of a `MomentCarryingJournal`, or of a `HeldTilt` of one.
    """

    bound_name: ClassVar[str] = "twice the estimate of what a tilt makes"
    """How `rest_bound` is known."""

    @property
    def has_losses(self) -> bool:
        """Whether power loss and flow of oil are known: not of a tilted journal."""
        return False

    def on_grid(self, bearing: Any) -> bool:
        """Return whether the film of one of both bearings lives on a grid in two dimensions."""
        own = bearing.journal if isinstance(bearing, HeldTilt) else bearing
        return grid_of(own.bearing.film) is not None

    def rest_bound(self, at: Equilibrium, *, slopes: bool) -> float:
        """Return twice the estimated error in an equilibrium; infinite of films over the whole length.

        That of K and C is known of the aligned force alone.
        """
        own = self.reaction
        if not isinstance(own, HeldTilt) or own.journal.level is TiltLevel.FULL:
            return np.inf
        about = own.journal.estimate(np.append(at.position, own.tilt), at.speed)
        if not slopes:
            return UNSURE * about.force_error
        aligned = own.journal.level is not TiltLevel.SECOND_ORDER
        return UNSURE * SLOPES * about.force_error if aligned else np.inf


LEVELS = {
    TiltLevel.NONE: "no tilt",
    TiltLevel.CLOSED_FORM: "closed form",
    TiltLevel.SECOND_ORDER: "second order",
    TiltLevel.FULL: "whole length",
}
"""Names of the levels in answers."""


def tilted_films(
    bearing: JournalBearing,
    *,
    fixed: bool,
    levels: Collection[TiltLevel],
    made: Callable[[MomentCarryingJournal], Any],
) -> tuple[TiltLevelFilm, ...]:
    """Return the levels that can answer for a bearing with a tilted journal, the cheapest first.

    A map of tilts counts where it is there already, or where the scene names the map or the level: films over
    the whole length cost less than to make one.

    Parameters
    ----------
    bearing : JournalBearing
    fixed : bool
        Whether the scene names the film of the bearing.
    levels : collection of TiltLevel
        Those that may answer.
    made : callable
        Takes the bearing with a level and returns the reaction.

    Raises
    ------
    InputError
        If the film of the scene is neither a map nor one on a grid.
    """
    wholes = [replace(bearing, film=ExtrapolatedFilm(film=ReynoldsFilm(cells=cells))) for cells in CELLS]
    aligned = bearing if fixed else replace(bearing, film=MapFilm() if has_map(bearing) else wholes[0].film)
    require_tilt_film(aligned)
    mapped = isinstance(aligned.film, MapFilm)
    wanted = fixed or len(levels) == 1
    second = mapped and is_mapped(aligned) and (wanted or has_tilt_map(float(aligned.slenderness)))
    cheap = [TiltLevel.NONE, TiltLevel.CLOSED_FORM, *([TiltLevel.SECOND_ORDER] if second else [])]
    rows = [(aligned, level, wholes[0]) for level in cheap]
    if not fixed:
        rows += [(own, TiltLevel.FULL, finer) for own, finer in pairwise(wholes)]
    elif not mapped:
        rows.append((bearing, TiltLevel.FULL, wholes[1]))
    found = tuple(_candidate(*row, made) for row in rows if row[1] in levels)
    if not found:
        raise InputError(
            f"film must be one that knows a tilt at level {_named(levels)}, got {_film(aligned)}"
        )
    return found


def _named(levels: Collection[TiltLevel]) -> str:
    return " or ".join(level.value for level in levels)


def require_tilt_film(bearing: JournalBearing) -> None:
    """Raise InputError unless the film of a bearing can feel a tilt: a map, or one on a grid."""
    if not isinstance(bearing.film, MapFilm) and grid_of(bearing.fitted_film) is None:
        raise InputError(
            f"film must be map or reynolds for a tilt, or left out, got {film_name(bearing.fitted_film)}"
        )


def _candidate(
    bearing: JournalBearing,
    level: TiltLevel,
    finer: JournalBearing,
    made: Callable[[MomentCarryingJournal], Any],
) -> TiltLevelFilm:
    own = MomentCarryingJournal(bearing=bearing, level=level)
    rich = MomentCarryingJournal(bearing=finer, level=TiltLevel.FULL)
    name, rich_name = (f"{LEVELS[one.level]}, {_film(one.bearing)}" for one in (own, rich))
    return TiltLevelFilm(name, made(own), made(rich), rich_name, 0.0, 0.0)


def _film(bearing: JournalBearing) -> str:
    grid = grid_of(bearing.fitted_film)
    if grid is None:
        return "map"
    return grid_name(grid.cells) if isinstance(bearing.film, ExtrapolatedFilm) else film_name(bearing.film)


# What journal bearings bring to scenes and questions.


def journal_points(scene: Scene) -> Sequence[FilmCandidate]:
    """Return the films of a journal bearing for some equilibria, or its levels with a tilt."""
    if scene.journal.tilt is not None:
        return tilted_points(scene)
    return point_films(scene.journal_bearing, fixed=scene.film_is_given)


def journal_turns(scene: Scene) -> Sequence[FilmCandidate]:
    """Return those for states all round a turn: the map where there is one, else short film, grids, map."""
    if scene.journal.tilt is not None:
        return tilted_points(scene)
    return turn_films(scene.journal_bearing, fixed=scene.film_is_given, grids=((48, 8), (96, 8)), maps=True)


def tilted_points(scene: Scene) -> Sequence[FilmCandidate]:
    """Return the levels of a journal that keeps a tilt."""
    tilt = scene.journal.tilt
    return tilted_films(
        scene.journal_bearing,
        fixed=scene.film_is_given,
        levels={*TiltLevel} - {TiltLevel.CLOSED_FORM},  # whose force is that without tilt
        made=lambda journal: HeldTilt(journal=journal, tilt=tilt),
    )


LADDERS = film_ladders(journal_points, journal_turns, QUANTITIES)
