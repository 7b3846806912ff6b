"""The bearing's geometry: pads, grooves and feed holes, and the openings of a film, dimensionless."""

from __future__ import annotations

import math
from dataclasses import dataclass
from itertools import pairwise
from typing import ClassVar, NamedTuple

import numpy as np

from ...core.errors import InputError, brief, require_finite, require_non_negative, require_positive
from ...core.inputs import quantities
from ...core.model import Array

TURN = 2.0 * math.pi


@quantities
@dataclass(frozen=True, kw_only=True)
class Groove:
    """An axial groove in the bearing wall, filled with oil at the supply pressure.

    Parameters
    ----------
    center : float [rad]
        Angle of its middle in the bearing frame, from +x towards +y.
    width : float [rad]
        Angle covered, 0 (a line) <= width < 2 pi.
    length : float or None [m]
        Length along the axis, centered; None for a groove that is open at both ends of the bearing.
    """

    center: float
    width: float = 0.0
    length: float | None = None

    def __post_init__(self) -> None:
        require_finite("center", self.center)
        require_non_negative("width", self.width)
        if self.width >= TURN:
            raise InputError(f"width must be below 2 pi, got {self.width!r}")
        if self.length is not None:
            require_positive("length", self.length)


@quantities
@dataclass(frozen=True, kw_only=True)
class FeedHole:
    """A round hole in the wall at mid-length, filled with lubricant at the supply pressure.

    The film model replaces it by a square of the same area.

    Parameters
    ----------
    center : float [rad]
        Angle of its middle in the bearing frame, from +x towards +y.
    diameter : float [m]
        Diameter of a round hole.
    """

    center: float
    diameter: float

    def __post_init__(self) -> None:
        require_finite("center", self.center)
        require_positive("diameter", self.diameter)

    @property
    def side(self) -> float:
        """Side of the square that has the area of the hole [m]."""
        return 0.5 * math.sqrt(math.pi) * self.diameter

    def require_fit(self, radius: float, length: float) -> None:
        """Raise InputError where its square leaves no room in a bearing of a radius and a length [m]."""
        largest = min(length * self.diameter / self.side, 2.0 * radius)
        if self.diameter >= largest:
            raise InputError(
                f"diameter of a feed hole must be below {largest:.6g} m, so that the square of the same area "
                f"fits into the bearing, got {self.diameter!r}"
            )


@dataclass(frozen=True, kw_only=True)
class Pocket:
    """An opening that ends within the bearing, in the middle of its length.

    Parameters
    ----------
    center : float [rad]
        Angle of its middle in the bearing frame, from +x towards +y.
    width : float [rad]
        Angle covered, 0 (a line) <= width < 2 pi.
    share : float [1]
        Share of the bearing's length that it covers, 0 < share < 1.
    """

    center: float
    width: float
    share: float

    def __post_init__(self) -> None:
        Groove(center=self.center, width=self.width)
        if not 0.0 < self.share < 1.0:
            raise InputError(f"share must be above 0 and below 1, got {self.share!r}")


@quantities
@dataclass(frozen=True, kw_only=True)
class Pad:
    """A fixed pad: the film covers it and is at ambient pressure, 0, at both its ends.

    A single pad of exactly 2 pi is the full bearing: it has no ends.

    Parameters
    ----------
    start : float [rad]
        First end in the bearing frame, from +x towards +y.
    extent : float [rad]
        Angle covered, 0 < extent <= 2 pi.
    """

    start: float
    extent: float

    def __post_init__(self) -> None:
        require_finite("start", self.start)
        require_finite("extent", self.extent)
        if not 0.0 < self.extent <= TURN:
            raise InputError(f"extent must be in (0, 2 pi], got {self.extent!r}")


@dataclass(frozen=True, kw_only=True)
class SunkArc:
    """A recess in the wall: an arc of one depth in the middle of the length.

    Parameters
    ----------
    start, end : float [rad]
        Angles of its edges in the bearing frame.
    share : float [1]
        Share of the bearing's length that it covers, 0 < share <= 1.
    depth_ratio : float [1]
        Depth below the wall over the clearance.
    """

    start: float
    end: float
    share: float
    depth_ratio: float

    def covers(self, angle: float) -> bool:
        """Return whether it lies at an angle [rad]."""
        return (angle - self.start) % TURN < self.end - self.start

    def depth_at(self, angle: Array, share: Array) -> Array:
        """Return its depth over the clearance at angles (N,) [rad] and shares of the length (M,), (N, M)."""
        around = (angle - self.start) % TURN < self.end - self.start
        return self.depth_ratio * np.logical_and.outer(around, share < self.share)


@dataclass(frozen=True)
class Span:
    """A piece of the circumference between two edges: film, or an opening held at a pressure.

    Attributes
    ----------
    start, extent : float [rad]
    held : float | None [1/s]
        Pressure p c^2/(12 viscosity R^2) of an opening; None for film.
    share : float [1]
        Share of the bearing's length that an opening covers; beside it there is film.
    """

    start: float
    extent: float
    held: float | None = None
    share: float = 1.0

    @property
    def end(self) -> float:
        """Angle of the second edge [rad]."""
        return self.start + self.extent

    @property
    def film(self) -> float:
        """Share of the bearing's length that is film."""
        return 1.0 if self.held is None else 1.0 - self.share


@dataclass(frozen=True, kw_only=True)
class FilmGeometry:
    """Pads, openings and supply of a bearing.

    Parameters
    ----------
    grooves : tuple of Groove
        Axial grooves over the whole length; they may not overlap each other nor leave their pad.
    pads : tuple of Pad
        Where there is a bearing wall; empty for the full circumference.
    supply : float [1/s]
        Supply pressure of the openings as p c^2/(12 viscosity R^2), not negative.
    pockets : tuple of Pocket
        Openings that end within the bearing; they may not touch each other, a groove or an end of a pad.
    circumferential : bool
        Whether a groove all round holds the line at mid-length at the supply pressure.
    recesses : tuple of SunkArc
        Where the wall of a pad is deeper; their edges are those of spans.

    Raises
    ------
    InputError
        If openings overlap, a groove has a length, the supply is negative, or there is a supply without an
        opening.
    """

    grooves: tuple[Groove, ...] = ()
    pads: tuple[Pad, ...] = ()
    supply: float = 0.0
    pockets: tuple[Pocket, ...] = ()
    circumferential: bool = False
    recesses: tuple[SunkArc, ...] = ()

    def __post_init__(self) -> None:
        require_non_negative("supply", self.supply)
        if self.supply > 0.0 and not self.fed:
            raise InputError(f"supply must be 0 without grooves, got {self.supply!r}")
        for groove in self.grooves:
            if groove.length is not None:
                raise InputError(
                    f"grooves must be open at both ends of the bearing and so have no length, got {groove!r}"
                )
        if self.pads and math.fsum(pad.extent for pad in self.pads) > TURN * (1.0 + 1e-12):
            raise InputError(f"pads must not overlap, got {brief(self.pads)}")
        self.openings()

    @property
    def plain(self) -> bool:
        """Whether the film runs all round and from end to end without an opening."""
        return not (self.circumferential or self.openings())

    @property
    def fed(self) -> bool:
        """Whether there is an opening that a supply feeds."""
        return bool(self.grooves or self.pockets or self.circumferential)

    def require_whole_length(self, film: str, remedy: str = "ReynoldsFilm") -> None:
        """Raise InputError, naming the film that cannot and one that can, of an opening within the length."""
        if self.pockets or self.circumferential:
            found = [*self.pockets, *["a circumferential groove"] * self.circumferential]
            raise InputError(
                f"openings must run over the whole length for {film}, got {found}; take {remedy}"
            )

    def openings(self) -> tuple[Span, ...]:
        """Return grooves, pockets and gaps between pads in the order of their start, in [0, 2 pi)."""
        if not (self.grooves or self.pockets or self.pads):
            return ()
        fed = [(g, 1.0) for g in self.grooves] + [(p, p.share) for p in self.pockets]
        grooves = [Span((g.center - 0.5 * g.width) % TURN, g.width, self.supply, share) for g, share in fed]
        spans = sorted([*grooves, *_gaps(self.pads)], key=lambda span: span.start)
        for first, second in zip(spans, [*spans[1:], *spans[:1]], strict=True):
            room = (second.start - first.start) % TURN if len(spans) > 1 else TURN
            _require_apart(first, second, room)
        return tuple(spans)

    def spans(self) -> tuple[Span, ...]:
        """Return openings and the films between them, all round from the first opening.

        Beside an opening with a share there is film too. At the edges of recesses one film ends and the next
        begins.
        """
        openings = self.openings()
        if not openings:
            return (Span(0.0, TURN),)
        pieces = []
        for first, second in zip(openings, [*openings[1:], openings[0]], strict=True):
            room = (second.start - first.start) % TURN or TURN
            pieces += [first, *self._cut(Span(first.end, room - first.extent))]
        return tuple(piece for piece in pieces if piece.held is not None or piece.extent > 0.0)

    def _cut(self, film: Span) -> list[Span]:
        """Return the pieces of a film between the edges of recesses."""
        edges = {(angle - film.start) % TURN for sunk in self.recesses for angle in (sunk.start, sunk.end)}
        inside = sorted(edge for edge in edges if _MEETING < edge < film.extent - _MEETING)
        bounds = [0.0, *inside, film.extent]
        return [Span(film.start + low, high - low) for low, high in pairwise(bounds)]


def _require_apart(first: Span, second: Span, room: float) -> None:
    """Raise InputError unless two openings, their starts `room` [rad] apart, do not overlap."""
    if first.extent > room * (1.0 + 1e-12) or (second is not first and room == 0.0):
        raise InputError(f"grooves and gaps between pads must not overlap, got {first!r} and {second!r}")
    if min(first.share, second.share) < 1.0 and first.extent >= room * (1.0 - 1e-9):
        raise InputError(
            f"an opening that ends within the bearing must not touch another, got {first!r} and {second!r}"
        )


_MEETING = 1e-12
"""Gap between two pads [rad] below which they meet at a line."""


def _gaps(pads: tuple[Pad, ...]) -> list[Span]:
    """Return the gaps after each pad; a line where two pads meet, none after a pad of 2 pi."""
    if len(pads) == 1 and pads[0].extent == TURN:
        return []
    ordered = sorted(pads, key=lambda pad: pad.start % TURN)
    gaps = []
    for pad, following in zip(ordered, [*ordered[1:], *ordered[:1]], strict=True):
        room = (following.start - pad.start) % TURN or TURN
        if pad.extent > room * (1.0 + 1e-12):
            raise InputError(f"pads must not overlap, got {pad!r} and {following!r}")
        gap = room - pad.extent
        gaps.append(Span((pad.start + pad.extent) % TURN, gap if gap > _MEETING else 0.0, 0.0))
    return gaps


# The openings of a bearing seen from an axis of their own, so that turned bearings share one map.


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


# Where the film of a bearing without openings starts.


@dataclass(frozen=True)
class FreeOnset:
    """The film starts where Reynolds' equation allows it: oil is available wherever pressure can build up."""

    line: ClassVar[float | None] = None
    """No line is held."""

    turning: ClassVar[bool] = False
    """Nothing turns."""


@dataclass(frozen=True)
class MaximumGapOnset:
    """The film starts at the widest gap, opposite to the journal's displacement, and turns with it.

    The printed tables of Butenschoen (1976) and others do the same. At the center the gap is the same
    everywhere, and the force depends on the direction from which the journal approaches it.
    """

    line: ClassVar[float | None] = None
    """No line stays in the bearing."""

    turning: ClassVar[bool] = True
    """The line turns with the journal."""


@quantities
@dataclass(frozen=True, kw_only=True)
class FixedOnset:
    """The film starts at a line that is fixed in the bearing, such as a supply that is not a groove.

    Parameters
    ----------
    line : float [rad]
        Its angle in the bearing frame, from +x towards +y.
    """

    line: float

    turning: ClassVar[bool] = False
    """The line stays."""

    def __post_init__(self) -> None:
        require_finite("line", self.line)


FilmOnset = FreeOnset | MaximumGapOnset | FixedOnset
"""Where a film starts: at a `line` [rad] at ambient pressure, at one `turning` with the journal, or free."""


# What a two-dimensional film does where its pressure would fall below ambient.


@dataclass(frozen=True)
class Complementarity:
    """Reynolds rupture: p >= 0, and no flux out of the ruptured zone (p and its slope vanish at its edge)."""

    searched: ClassVar[bool] = True
    """The ruptured zone is searched for."""

    clipped: ClassVar[bool] = False
    """Nothing is left to clip."""


@dataclass(frozen=True)
class HalfSommerfeld:
    """Half-Sommerfeld (Guembel) film: negative pressures are set to zero; the flow is not conserved."""

    searched: ClassVar[bool] = False
    """The film is solved full."""

    clipped: ClassVar[bool] = True
    """Negative pressures are dropped."""


@dataclass(frozen=True)
class FullFilm:
    """Full film (Sommerfeld condition): it never ruptures, and negative pressures act."""

    searched: ClassVar[bool] = False
    """The film is solved full."""

    clipped: ClassVar[bool] = False
    """Negative pressures stay."""


Cavitation = Complementarity | HalfSommerfeld | FullFilm
"""How negative pressure is dealt with: find the ruptured zone, clip the pressure, or bear tension."""
