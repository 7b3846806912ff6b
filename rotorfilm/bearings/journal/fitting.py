"""Which film law a bearing really has: the one that is given, or the usual one, in the bearing's geometry."""

from __future__ import annotations

import dataclasses

from ...errors import InputError
from ..films.geometry import FilmGeometry
from ..films.law import FilmLaw, FilmOptions, options
from .map.map_film import MapFilm

_GEOMETRY = "geometry"
"""Parameter of the films that are fitted to a bearing: the bearing itself shows it."""


def film_name(film: FilmLaw) -> str:
    """Return a film law as Python would make it, without its geometry and what is None."""
    name = type(film).__name__
    if not dataclasses.is_dataclass(film):
        return name
    values = {f.name: getattr(film, f.name) for f in dataclasses.fields(film) if f.repr}
    shown = [f"{key}={value!r}" for key, value in values.items() if value is not None and key != _GEOMETRY]
    return f"{name}({', '.join(shown)})"


def usual_film(geometry: FilmGeometry, slenderness: float) -> FilmLaw:
    """Return the film of a bearing that names none: the map where there is one, else in two dimensions."""
    if geometry.plain:
        return MapFilm()
    from .grooves.grooved_film import GroovedMapFilm
    from .grooves.openings import is_mappable
    from .reynolds_film import ReynoldsFilm

    low, high = GroovedMapFilm().slenderness_range
    return MapFilm() if is_mappable(geometry) and low <= slenderness <= high else ReynoldsFilm()


def fitted_film(film: FilmLaw, geometry: FilmGeometry) -> FilmLaw:
    """Return a film law in a bearing of this geometry; a `MapFilm` with openings is a `GroovedMapFilm`.

    Raises
    ------
    InputError
        If the law cannot represent the geometry: it has no place for openings, or, of maps, if there is a
        supply pressure, an opening wider than 60 deg, or a table of a plain bearing beside openings.
    """
    if isinstance(film, MapFilm) and not geometry.plain:
        from .grooves.grooved_film import GroovedMapFilm

        if film.table is not None:
            raise InputError(
                "table must be that of the bearing, got a MapTable, which is for no openings; take MapFilm() "
                "or GroovedMapFilm(table=...)"
            )
        film = GroovedMapFilm()
    fitted = options(film, FilmOptions).fitted(geometry)
    if fitted is None and not geometry.plain:
        raise InputError(
            f"film must represent the bearing's geometry, which {type(film).__name__} cannot: "
            f"got {geometry!r}; ReynoldsFilm and, without supply, MapFilm can"
        )
    return film if fitted is None else fitted
