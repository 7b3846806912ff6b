"""Where the film of a bearing without openings starts."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar, Protocol, runtime_checkable

from ...errors import require_finite
from ...inputs.si_arguments import quantities


@runtime_checkable
class FilmStart(Protocol):
    """The line at ambient pressure at which a film starts, if there is one."""

    @property
    def line(self) -> float | None:
        """Angle of a line that stays in the bearing [rad]; None for none."""

    @property
    def turning(self) -> bool:
        """Whether the line lies at the widest gap and turns with the journal."""

    def __hash__(self) -> int:
        """Return the same for equal starts: grids are kept by it."""


@dataclass(frozen=True)
class FreeStart:
    """The film starts where Reynolds' equation lets it: oil is there wherever pressure can be."""

    line: ClassVar[float | None] = None
    """No line is held."""

    turning: ClassVar[bool] = False
    """Nothing turns."""


@dataclass(frozen=True)
class WidestGap:
    """The film starts at the widest gap, opposite to the journal's displacement, with which the line turns.

    So do the printed tables of Butenschoen (1976) and others. At the center the gap is equal all round, and
    the force depends on the direction from which it is approached.
    """

    line: ClassVar[float | None] = None
    """No line stays in the bearing."""

    turning: ClassVar[bool] = True
    """The line turns with the journal."""


@quantities
@dataclass(frozen=True, kw_only=True)
class HeldLine:
    """The film starts at a line that stays in the bearing, such as a supply that is not a groove.

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
