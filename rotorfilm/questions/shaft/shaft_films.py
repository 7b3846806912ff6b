"""The bearings of a flexible rotor: which films may stand in its journals, and what is richer."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from ...answers import WorkUnit
from ...linear import RotorEquilibrium, equilibrium
from ...model import Reaction
from ...results import Coefficients
from ...scenes.journal.film_defects import corrected
from ...scenes.journal.film_rung import FilmRung
from ...scenes.journal.film_rungs import turn_films
from ...scenes.journal.packaged_map import has_map
from ..journal.heat_rungs import known_films

if TYPE_CHECKING:
    from ...scenes.schema import JournalTable
    from ...scenes.shaft.shaft_table import ShaftTable

REST_BOUNDS = ((0.5, 2e-5), (0.95, 5e-5))
"""Eccentricity ratio up to which, and largest error of K, C of the packaged map at rest."""

GRIDS = ((96, 8),)
"""Cells of films beside the short one, of journals that no map of the package holds."""


@dataclass(frozen=True, kw_only=True)
class ShaftFilms:
    """A film for each journal of a shaft, beside its springs and dampers.

    Attributes
    ----------
    journals : dict of str to FilmRung
        By station.
    springs : dict of str to Reaction
        Bearings without a film, by station.
    """

    journals: Mapping[str, FilmRung]
    springs: Mapping[str, Reaction]

    @property
    def name(self) -> str:
        """Names of the films, each once; empty without journals."""
        return " and ".join(dict.fromkeys(film.name for film in self.journals.values()))

    @property
    def rich_name(self) -> str:
        """Names of the richer films, each once; empty without journals."""
        return " and ".join(dict.fromkeys(film.rich_name for film in self.journals.values()))

    @property
    def bounded(self) -> bool:
        """Whether every film has a verified bound."""
        return all(film.bounded for film in self.journals.values())

    @property
    def reaction(self) -> dict[str, Reaction]:
        """All bearings by station, with these films."""
        return {**self.springs, **self.turning}

    @property
    def turning(self) -> dict[str, Reaction]:
        """The films by station, whose K and C change with the speed."""
        return {name: film.reaction for name, film in self.journals.items()}

    @property
    def rich(self) -> dict[str, Reaction]:
        """All bearings by station, with the richer films."""
        return {**self.springs, **{name: film.rich for name, film in self.journals.items()}}

    @property
    def on_oil(self) -> tuple[str, ...]:
        """Stations whose films are of an oil, with a temperature."""
        return tuple(name for name, film in self.journals.items() if film.reaction.oil is not None)

    def prepare(self) -> dict[WorkUnit, int]:
        """Make the maps that are not there yet, and return the work of that."""
        made: dict[WorkUnit, int] = {}
        for film in self.journals.values():
            for unit, count in film.prepare().items():
                made[unit] = made.get(unit, 0) + count
        return made


def film_levels(shaft: ShaftTable) -> tuple[ShaftFilms, ...]:
    """Return what may stand in the journals of a shaft, the cheapest first; one level if all is settled."""
    springs = {one.name: one.build() for one in shaft.bearings if one.journal is None}
    choices = {one.name: _choices(one.journal) for one in shaft.bearings if one.journal is not None}
    count = max((len(each) for each in choices.values()), default=1)
    return tuple(
        ShaftFilms(
            journals={name: each[min(level, len(each) - 1)] for name, each in choices.items()},
            springs=springs,
        )
        for level in range(count)
    )


def _choices(journal: JournalTable) -> tuple[FilmRung, ...]:
    bearing = journal.bearing()
    films = turn_films(bearing, fixed=journal.film is not None, grids=GRIDS, maps=False)
    return known_films(films) if bearing.is_warming else films


def rich_coefficients(films: ShaftFilms, at: RotorEquilibrium) -> tuple[dict[str, Coefficients], str]:
    """Return K and C of all bearings by the richer films at their own equilibria, and why to doubt them."""
    found, doubt = dict(at.coefficients), ""
    for name, film in films.journals.items():
        load = at.loads[name]
        if name in at.temperatures:
            film = film.at_temperature(at.temperatures[name])
        moved = corrected(film, equilibrium(film.reaction, load, at.speed), load, smooth=True)
        found[name] = Coefficients(
            stiffness=-moved.slopes[:, :2],
            damping=-moved.slopes[:, 2:],
            position=moved.position,
            speed=at.speed,
        )
        doubt = doubt or moved.doubt
    return found, doubt


def coefficient_bounds(films: ShaftFilms, at: RotorEquilibrium) -> dict[str, float]:
    """Return the verified relative error of K and C of each film at rest; infinite where there is none."""
    return {
        name: _rest_bound(film, float(np.hypot(*at.coefficients[name].position)) / film.reaction.clearance)
        for name, film in films.journals.items()
    }


def _rest_bound(film: FilmRung, eccentricity_ratio: float) -> float:
    if not (film.bounded and has_map(film.reaction)):
        return film.bound(eccentricity_ratio, slopes=True)
    return min((bound for reach, bound in REST_BOUNDS if eccentricity_ratio <= reach), default=math.inf)
