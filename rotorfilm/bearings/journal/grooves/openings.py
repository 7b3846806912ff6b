"""The openings of a bearing seen from an axis of their own, so that turned bearings share one map."""

from __future__ import annotations

from typing import NamedTuple

from ....errors import InputError
from ...films.geometry import TURN, FilmGeometry, Groove

STEPS = 7_200_000_000
"""Angles are compared as whole numbers of TURN/STEPS, 1e-9 rad."""

WIDEST = TURN / 6.0
"""Widest opening of a map: the wider, the less a source finds that carries; past half a turn J vanishes."""

_View = tuple[tuple[int, int], ...]


class AlignedOpenings(NamedTuple):
    """Openings at ambient pressure, the axis from which they are seen, and their symmetry.

    Attributes
    ----------
    grooves : tuple of Groove
        Grooves and gaps between pads; angles from the axis, in ascending order.
    axis : float [rad]
        Angle of the axis in the bearing frame.
    mirrored : bool
        Whether the axis is one of mirror symmetry.
    fold : int
        Whole turns are `fold` times a turn that leaves the openings as they are.
    """

    grooves: tuple[Groove, ...]
    axis: float
    mirrored: bool
    fold: int


def aligned_openings(geometry: FilmGeometry) -> AlignedOpenings:
    """Return the openings of a bearing seen from the middle of an opening or of a film between two.

    Raises
    ------
    InputError
        If there is a supply pressure, no opening, or one that is too wide.
    """
    require_mappable(geometry)
    middles = [span.start + 0.5 * span.extent for span in geometry.spans()]
    candidates = [(_view(geometry, axis), axis) for axis in middles]
    view, axis = min(candidates, key=lambda pair: (pair[0] != _mirror(pair[0]), pair[0]))
    grooves = tuple(Groove(center=c * TURN / STEPS, width=w * TURN / STEPS) for c, w in view)
    return AlignedOpenings(grooves, axis, view == _mirror(view), _fold(view))


def is_mappable(geometry: FilmGeometry) -> bool:
    """Return whether a film of this geometry has a map: no supply, openings of 60 deg at most."""
    try:
        require_mappable(geometry)
    except InputError:
        return geometry.plain and geometry.supply == 0.0
    return True


def require_mappable(geometry: FilmGeometry) -> None:
    """Raise InputError where a film of this geometry has no map, with what to take instead."""
    if geometry.supply > 0.0:
        raise InputError(
            f"supply pressure must be 0 for a map of the film, got {geometry.supply!r} 1/s in units of 12 "
            "viscosity radius^2/clearance^2: with a supply the force is not homogeneous in the velocity; "
            "take ReynoldsFilm"
        )
    geometry.require_whole_length("a map of the film")
    if geometry.plain:
        raise InputError("a map with openings needs grooves or pads, got a plain bearing; take MapFilm")
    widest = max(opening.extent for opening in geometry.openings())
    if widest > WIDEST * (1.0 + 1e-9):
        raise InputError(
            f"openings must not be wider than 60 deg for a map of the film, got {widest:.6g} rad: "
            "some motions find hardly a film that carries; take ReynoldsFilm"
        )


def _view(geometry: FilmGeometry, axis: float) -> _View:
    openings = (
        (opening.start + 0.5 * opening.extent - axis, opening.extent) for opening in geometry.openings()
    )
    return tuple(sorted((round(c / TURN * STEPS) % STEPS, round(w / TURN * STEPS)) for c, w in openings))


def _mirror(view: _View) -> _View:
    return tuple(sorted((-center % STEPS, width) for center, width in view))


def _fold(view: _View) -> int:
    for fold in range(len(view), 1, -1):
        turned = tuple(sorted(((center + STEPS // fold) % STEPS, width) for center, width in view))
        if STEPS % fold == 0 and turned == view:
            return fold
    return 1
