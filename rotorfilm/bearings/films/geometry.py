"""The bearing's geometry as a film sees it: pads, axial grooves and supply, all dimensionless."""

from __future__ import annotations

import math
from dataclasses import dataclass

from ...errors import InputError, require_finite, require_non_negative
from ...inputs.si_arguments import quantities

TURN = 2.0 * math.pi


@quantities
@dataclass(frozen=True, kw_only=True)
class Groove:
    """An axial groove in the bearing wall, filled with lubricant at the supply pressure.

    Parameters
    ----------
    center : float [rad]
        Angle of its middle in the bearing frame, from +x towards +y.
    width : float [rad]
        Angle covered, 0 (a line) <= width < 2 pi.
    """

    center: float
    width: float = 0.0

    def __post_init__(self) -> None:
        require_finite("center", self.center)
        require_non_negative("width", self.width)
        if self.width >= TURN:
            raise InputError(f"width must be below 2 pi, got {self.width!r}")


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


@dataclass(frozen=True)
class Span:
    """A piece of the circumference between two edges: film, or an opening held at a pressure.

    Attributes
    ----------
    start, extent : float [rad]
    held : float | None [1/s]
        Pressure p c^2/(12 viscosity R^2) of an opening; None for film.
    """

    start: float
    extent: float
    held: float | None = None

    @property
    def end(self) -> float:
        """Angle of the second edge [rad]."""
        return self.start + self.extent


@dataclass(frozen=True, kw_only=True)
class FilmGeometry:
    """Pads, grooves and supply of a bearing.

    Parameters
    ----------
    grooves : tuple of Groove
        Axial grooves over the whole length; they may not overlap each other nor leave their pad.
    pads : tuple of Pad
        Where there is a bearing wall; empty for the full circumference.
    supply : float [1/s]
        Supply pressure of the grooves as p c^2/(12 viscosity R^2), not negative.

    Raises
    ------
    InputError
        If openings overlap, the supply is negative, or there is a supply without a groove.
    """

    grooves: tuple[Groove, ...] = ()
    pads: tuple[Pad, ...] = ()
    supply: float = 0.0

    def __post_init__(self) -> None:
        require_non_negative("supply", self.supply)
        if self.supply > 0.0 and not self.grooves:
            raise InputError(f"supply must be 0 without grooves, got {self.supply!r}")
        if self.pads and math.fsum(pad.extent for pad in self.pads) > TURN * (1.0 + 1e-12):
            raise InputError(f"pads must not overlap, got {self.pads!r}")
        self.openings()

    @property
    def plain(self) -> bool:
        """Whether the film runs all round without an opening."""
        return not self.openings()

    def openings(self) -> tuple[Span, ...]:
        """Return grooves and gaps between pads in the order of their start, in [0, 2 pi)."""
        grooves = [Span((g.center - 0.5 * g.width) % TURN, g.width, self.supply) for g in self.grooves]
        spans = sorted([*grooves, *_gaps(self.pads)], key=lambda span: span.start)
        for first, second in zip(spans, [*spans[1:], *spans[:1]], strict=True):
            room = (second.start - first.start) % TURN if len(spans) > 1 else TURN
            if first.extent > room * (1.0 + 1e-12) or (len(spans) > 1 and room == 0.0):
                raise InputError(
                    f"grooves and gaps between pads must not overlap, got {first!r} and {second!r}"
                )
        return tuple(spans)

    def spans(self) -> tuple[Span, ...]:
        """Return openings and the films between them, all round from the first opening."""
        openings = self.openings()
        if not openings:
            return (Span(0.0, TURN),)
        pieces = []
        for first, second in zip(openings, [*openings[1:], openings[0]], strict=True):
            room = (second.start - first.start) % TURN or TURN
            pieces += [first, Span(first.end, room - first.extent)]
        return tuple(piece for piece in pieces if piece.held is not None or piece.extent > 0.0)


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
        gaps.append(Span((pad.start + pad.extent) % TURN, max(room - pad.extent, 0.0), 0.0))
    return gaps
