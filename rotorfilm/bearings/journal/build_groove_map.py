"""Making the map of a grooved bearing before it is needed."""

from __future__ import annotations

from ...core.errors import InputError
from ...core.inputs import arguments
from ...core.progress import Report, silent
from .bearing import JournalBearing
from .groove_map import GrooveMapTable
from .grooved_film import GroovedMapFilm


@arguments
def build_groove_map(bearing: JournalBearing, report: Report = silent) -> GrooveMapTable:
    """Return the map of a bearing with grooves or several pads; made and kept on disk if it is not there yet.

    Parameters
    ----------
    bearing : JournalBearing
        Bearing with grooves or several pads, and a `MapFilm()` or a `GroovedMapFilm`.
    report : callable, optional
        Called with the fraction done, 0 to 1, and a text while a map is being made.

    Returns
    -------
    GrooveMapTable
        The map. A `GroovedMapFilm(table=...)` needs neither the disk nor a compiler, for example in an FMU.

    Raises
    ------
    InputError
        If the bearing is plain or its film has no map.

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
        raise InputError(
            "bearing must have openings, and a MapFilm() or GroovedMapFilm, for a map of its own, "
            f"got {bearing!r}"
        )
    return film.built_table(bearing.slenderness, report)
