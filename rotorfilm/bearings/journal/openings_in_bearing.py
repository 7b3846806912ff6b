"""From the grooves and feed holes of a bearing in metres to the openings of its film."""

from __future__ import annotations

from ...errors import InputError
from ..films.geometry import FeedHole, FilmGeometry, Groove, Pad, Pocket

Opening = Groove | FeedHole
"""What a bearing is fed by, beside a circumferential groove."""

ROUNDOFF = 1e-12
"""Of the length of the bearing, by which a groove over the whole length may differ from it."""


def film_length(length: float, circumferential_groove: float | None) -> float:
    """Return the axial length that is film [m]: that of both lands beside a circumferential groove.

    Raises
    ------
    InputError
        If the groove leaves no land.
    """
    width = circumferential_groove or 0.0
    if not 0.0 <= width < length:
        raise InputError(
            f"circumferential_groove must be from 0 to below the length {length!r}, got {width!r}"
        )
    return length - width


def film_geometry(
    openings: tuple[Opening, ...],
    pads: tuple[Pad, ...],
    supply: float,
    *,
    radius: float,
    length: float,
    circumferential_groove: float | None,
) -> FilmGeometry:
    """Return the openings as the film of a bearing sees them.

    Parameters
    ----------
    openings : tuple of Groove or FeedHole
    pads : tuple of Pad
    supply : float [1/s]
        Supply pressure in the unit of the film.
    radius, length : float [m]
    circumferential_groove : float or None [m]
        Width along the axis; None for none. What it covers of the length has no film, so that of a groove
        beside it only the rest counts.

    Raises
    ------
    InputError
        If an opening is longer than the bearing, lies within the circumferential groove, or overlaps another.
    """
    lands = film_length(length, circumferential_groove)
    grooves, pockets = [], []
    for center, width, along in (_sized(opening, radius, length) for opening in openings):
        if along >= length * (1.0 - ROUNDOFF):
            grooves.append(Groove(center=center, width=width))
        else:
            pockets.append(Pocket(center=center, width=width, share=_share(along, length, lands)))
    return FilmGeometry(
        grooves=tuple(grooves),
        pads=pads,
        supply=supply,
        pockets=tuple(pockets),
        circumferential=circumferential_groove is not None,
    )


def _sized(opening: Opening, radius: float, length: float) -> tuple[float, float, float]:
    """Return center and width [rad] of an opening, and its length [m]."""
    if isinstance(opening, FeedHole):
        largest = min(length * opening.diameter / opening.side, 2.0 * radius)
        if opening.diameter >= largest:
            raise InputError(
                f"diameter of a feed hole must be below {largest:.6g} m, that of the bearing or of the "
                f"circle whose square is as long, got {opening.diameter!r}"
            )
        return opening.center, opening.side / radius, opening.side
    along = length if opening.length is None else opening.length
    if along > length * (1.0 + ROUNDOFF):
        raise InputError(f"grooves must be at most as long as the bearing, {length!r} m, got {along!r}")
    return opening.center, opening.width, along


def _share(along: float, length: float, lands: float) -> float:
    """Return the share of the lands that an opening of a length [m] covers."""
    covered = along - (length - lands)
    if covered <= 0.0:
        raise InputError(
            "an opening must be longer than the circumferential_groove that it crosses, "
            f"{length - lands:.6g} m, got {along:.6g}"
        )
    return covered / lands
