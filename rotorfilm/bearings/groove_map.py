"""Making the map of a grooved bearing before it is needed."""

from __future__ import annotations

from ..errors import InputError
from ..films.groove_build import Report
from ..films.groove_map import GroovedMapFilm
from ..films.groove_table import GrooveTable
from .journal import JournalBearing


def build_groove_map(bearing: JournalBearing, report: Report | None = None) -> GrooveTable:
    """Return the map of a bearing with a `GroovedMapFilm`; made and kept on disk if it is not there yet.

    Parameters
    ----------
    bearing : JournalBearing
        With grooves or several pads.
    report : callable, optional
        Called with the fraction done, 0 to 1, and a text while a map is being made.

    Returns
    -------
    GrooveTable
        `GroovedMapFilm(table=...)` needs neither the disk nor a compiler, in an FMU for one.

    Raises
    ------
    InputError
        If the film is no `GroovedMapFilm`, or the bearing is plain.

    Examples
    --------
    >>> from rotorfilm import Groove, GroovedMapFilm, JournalBearing, build_groove_map
    >>> bearing = JournalBearing(
    ...     radius=0.05, length=0.05, clearance=1e-4, viscosity=0.1,
    ...     grooves=(Groove(center=0.0, width=0.35), Groove(center=3.1415926535, width=0.35)),
    ...     film=GroovedMapFilm(cells=(32, 4), nodes=(6, 16, 12)),
    ... )
    >>> build_groove_map(bearing).slenderness
    0.5
    """
    film = bearing.fitted_film
    if not isinstance(film, GroovedMapFilm):
        raise InputError(f"film must be a GroovedMapFilm to have a map of its own, got {bearing.film!r}")
    return film.built_table(bearing.slenderness, report)
