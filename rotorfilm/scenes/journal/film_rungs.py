"""The rungs of a journal film: which films can answer a scene, the cheapest first, and what is richer."""

from __future__ import annotations

from dataclasses import replace

from ...bearings.films.law import FilmLaw
from ...bearings.journal import (
    ComplementarityArc,
    ExtrapolatedFilm,
    GroovedMapFilm,
    JournalBearing,
    MapFilm,
    ReynoldsFilm,
    RotatingArc,
    ShortFilm,
    SplittingFilm,
    film_name,
    fitted_bearing,
    is_mappable,
)
from .film_rung import MAP_MADE, FilmRung
from .packaged_map import has_map

COARSE_MAP = GroovedMapFilm(cells=(96, 8), nodes=(8, 48, 32))
"""Made in a fifth of the time of the map with openings, with errors some four times as large."""

MEDIUM, FINE, FINEST = (192, 16), (384, 16), (768, 32)


def film_rungs(bearing: JournalBearing, *, fixed: bool) -> tuple[FilmRung, ...]:
    """Return the films that can answer for a bearing, the cheapest first.

    Parameters
    ----------
    bearing : JournalBearing
    fixed : bool
        Whether the scene names the film of the bearing, so that no other may answer.
    """
    plain, tabulated = bearing.geometry.plain, has_map(bearing)
    if fixed:
        rungs = _named(bearing, tabulated)
    elif tabulated:
        rungs = [_map(bearing), *_plain_films(bearing, tabulated), *_grids(bearing, tabulated)]
    elif plain:
        low, high = MapFilm().slenderness_range
        own = [_map(bearing)] if low <= bearing.slenderness <= high else []
        rungs = [*_plain_films(bearing, tabulated), *_grids(bearing, tabulated), *own]
    else:
        maps = _grooved_maps(bearing)
        ready = [film for film in maps if not film.makes_map]
        rungs = [*ready, *_grids(bearing, tabulated), *(film for film in maps if film.makes_map)]
    return tuple(rungs)


def point_films(bearing: JournalBearing, *, fixed: bool) -> tuple[FilmRung, ...]:
    """Return the films for some equilibria: a map that must be made first costs more than any grid."""
    films = film_rungs(bearing, fixed=fixed)
    return tuple(film for film in films if fixed or not film.makes_map)


def turn_films(
    bearing: JournalBearing, *, fixed: bool, grids: tuple[tuple[int, int], ...], maps: bool
) -> tuple[FilmRung, ...]:
    """Return the films for states all round a turn: the map that is there, else the short film and grids.

    Parameters
    ----------
    bearing : JournalBearing
    fixed : bool
        Whether the scene names the film of the bearing.
    grids : tuple of (int, int)
        Cells of the grids worth taking.
    maps : bool
        Whether a map that must be made first is worth it.
    """
    films = tuple(_with_coarser_check(film) for film in film_rungs(bearing, fixed=fixed))
    if fixed:
        return films
    if films[0].bounded and not films[0].makes_map:
        return films[:1]
    return tuple(film for film in films if _is_kept(film, grids, maps=maps))


def _is_kept(film: FilmRung, grids: tuple[tuple[int, int], ...], *, maps: bool) -> bool:
    law = film.reaction.film
    on_grid = isinstance(law, ExtrapolatedFilm) and law.film.cells in grids
    return on_grid or isinstance(law, ShortFilm) or (maps and isinstance(law, MapFilm | GroovedMapFilm))


def _with_coarser_check(film: FilmRung) -> FilmRung:
    """Return a rung whose map is compared with a grid that may be sampled all round a turn."""
    if not film.bounded:
        return film
    return replace(film, rich=extrapolated(film.reaction, FINE), rich_name="2-D 384 x 16 extr.")


def extrapolated(bearing: JournalBearing, cells: tuple[int, int]) -> JournalBearing:
    """Return the bearing with the film in two dimensions, extrapolated from two grids."""
    return fitted_bearing(bearing, ExtrapolatedFilm(film=ReynoldsFilm(cells=cells)))


def _map(bearing: JournalBearing) -> FilmRung:
    rung = _rung("map", bearing, MapFilm(), (FINEST, "2-D 768 x 32 extr."), 1e-6, 1e-4, bounded=True)
    return rung if has_map(bearing) else replace(rung, making=MAP_MADE.nominal)


def _grooved_maps(bearing: JournalBearing) -> list[FilmRung]:
    """Return the maps of a bearing with openings: a coarse one too, where the fine one is to be made."""
    low, high = GroovedMapFilm().slenderness_range
    if not (is_mappable(bearing.geometry) and low <= bearing.slenderness <= high):
        return []
    fine = _opened("map with grooves", bearing, GroovedMapFilm(), 1e-5, 1e-3)
    coarse = _opened("coarse map with grooves", bearing, COARSE_MAP, 3e-4, 5e-3)
    return [coarse, fine] if fine.makes_map else [fine]


def _opened(
    name: str, bearing: JournalBearing, film: GroovedMapFilm, position_prior: float, slope_prior: float
) -> FilmRung:
    rich = FINE, "2-D 384 x 16 extr."
    rung = _rung(name, bearing, film, rich, position_prior, slope_prior)
    return replace(rung, making=_making_time(rung.reaction))


def _making_time(bearing: JournalBearing) -> float:
    """Return about how long the map with openings of a bearing takes [s]; 0 where it is there."""
    film = bearing.fitted_film
    return film.making_time(bearing.slenderness) if isinstance(film, GroovedMapFilm) else 0.0


def _plain_films(bearing: JournalBearing, tabulated: bool) -> list[FilmRung]:
    """Return films of closed form: they are for bearings without openings."""
    slim = min(bearing.slenderness**2, 1.0)
    films: tuple[tuple[str, FilmLaw, float, float], ...] = (
        ("short film", ShortFilm(), 0.1 * slim, 0.1 * slim),
        ("splitting (2, all)", SplittingFilm(order=(2, None), rupture=RotatingArc()), 2e-3, 5e-3),
        ("splitting (6, all)", SplittingFilm(order=(6, None), rupture=RotatingArc()), 1e-3, 3e-3),
    )
    rich = _rich(tabulated, FINE)
    return [_rung(name, bearing, film, rich, *priors) for name, film, *priors in films]


def _grids(bearing: JournalBearing, tabulated: bool) -> list[FilmRung]:
    rich = _rich(tabulated, MEDIUM)
    coarse = _rung("2-D 48 x 4", bearing, ReynoldsFilm(cells=(48, 4)), rich, 1e-3, 1e-3)
    levels = (
        ((48, 8), FINE, 3e-5, 1e-3),
        ((96, 8), FINE, 5e-6, 3e-4),
        ((192, 16), FINEST, 1e-6, 1e-4),
        ((384, 16), FINEST, 5e-7, 5e-5),
    )
    finer = [
        _rung(
            f"2-D {cells[0]} x {cells[1]} extr.",
            bearing,
            ExtrapolatedFilm(film=ReynoldsFilm(cells=cells)),
            _rich(tabulated, above),
            *priors,
        )
        for cells, above, *priors in levels
    ]
    if not tabulated:  # the free arc is found for length / diameter .1 to 4
        return [coarse, *finer]
    free = SplittingFilm(order=(6, None), constant=True, rupture=ComplementarityArc())
    arc = _rung("free arc (6+c, all)", bearing, free, _rich(tabulated, FINE), 1e-5, 1e-4)
    return [coarse, *finer[:2], arc, *finer[2:]]


def _named(bearing: JournalBearing, tabulated: bool) -> list[FilmRung]:
    """Return the rung of a scene that names its film, after a coarser map of it where that is made sooner."""
    film = bearing.fitted_film
    fine = isinstance(film, MapFilm) or (isinstance(film, ReynoldsFilm) and film.cells[0] > 96)
    rich = _rich(tabulated and not isinstance(film, MapFilm), FINEST if fine else FINE)
    rung = _rung(film_name(film), bearing, film, rich, 0.0, 0.0, bounded=isinstance(film, MapFilm))
    rung = replace(rung, making=_making_time(rung.reaction))
    if not (rung.makes_map and film == GroovedMapFilm(geometry=bearing.geometry)):
        return [rung]
    return [_opened(film_name(COARSE_MAP), bearing, COARSE_MAP, 0.0, 0.0), rung]


def _rich(tabulated: bool, cells: tuple[int, int]) -> tuple[tuple[int, int] | None, str]:
    """Return the cells of the richer film, None for the map where there is one, and its name."""
    return (None, "map") if tabulated else (cells, f"2-D {cells[0]} x {cells[1]} extr.")


def _rung(
    name: str,
    bearing: JournalBearing,
    film: FilmLaw,
    rich: tuple[tuple[int, int] | None, str],
    position_prior: float,
    slope_prior: float,
    *,
    bounded: bool = False,
) -> FilmRung:
    cells, rich_name = rich
    return FilmRung(
        name=name,
        reaction=fitted_bearing(bearing, film),
        rich=fitted_bearing(bearing, MapFilm()) if cells is None else extrapolated(bearing, cells),
        rich_name=rich_name,
        position_prior=position_prior,
        prior=slope_prior,
        bounded=bounded,
    )
