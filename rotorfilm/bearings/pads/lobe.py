"""A fixed pad with a center of curvature of its own, and the usual sets of them by name."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from ...errors import InputError, require_each, require_finite, require_number
from ...inputs.kinds import arguments
from ...inputs.si_arguments import quantities
from ...model import Array
from ..films.geometry import TURN

DEGREE = math.pi / 180.0


class OwnCenter:
    """An arc about a center of curvature of its own; the fields are those of a subclass."""

    if TYPE_CHECKING:
        start: float
        extent: float
        preload: float
        offset: float

    def _require_curve(self) -> None:
        if not 0.0 <= require_number("preload", self.preload) < 1.0:
            raise InputError(f"preload must be in [0, 1), got {self.preload!r}")
        if not 0.0 <= require_number("offset", self.offset) <= 1.0:
            raise InputError(f"offset must be in [0, 1], got {self.offset!r}")

    @property
    def closest(self) -> float:
        """Angle of the least film at the centered journal [rad]."""
        return self.start + self.offset * self.extent

    @property
    def center(self) -> tuple[float, float]:
        """Center of curvature in units of the pad clearance."""
        return -self.preload * math.cos(self.closest), -self.preload * math.sin(self.closest)


@quantities
@dataclass(frozen=True, kw_only=True)
class Lobe(OwnCenter):
    """A fixed pad of a lobed bearing: an arc about a center of curvature of its own.

    With the pad clearance c_p the journal at the center of the bearing has the film c_p (1 - preload) at
    the angle start + offset extent, the least on the pad. Ends and sides are at ambient pressure.

    Parameters
    ----------
    start : float [rad]
        First end of the arc in the bearing frame, from +x towards +y; the leading end for positive speeds.
    extent : float [rad]
        Angle covered, in (0, pi).
    preload : float [1]
        1 - c_b/c_p with the assembled clearance c_b, in [0, 1).
    offset : float [1]
        Place of the least film at the centered journal, as a share of the arc from its start, in [0, 1]:
        .5 for lobes, 1 where the film narrows all along the pad.

    Raises
    ------
    InputError
        If an argument breaks its rule.
    """

    start: float
    extent: float
    preload: float = 0.0
    offset: float = 0.5

    def __post_init__(self) -> None:
        require_each(self, require_finite, "start", "extent")
        if not 0.0 < self.extent < math.pi:
            raise InputError(f"extent must be in (0, pi) rad, got {self.extent!r}")
        self._require_curve()

    @property
    def middle(self) -> float:
        """Angle of the middle of the arc [rad]."""
        return self.start + 0.5 * self.extent

    def least_film(self, position: Array) -> Array:
        """Return the least film on the arc / c_p, shape (...), of journals at positions / c_p (2, ...)."""
        x, y = position[0] - self.center[0], position[1] - self.center[1]
        cos, sin, half = math.cos(self.middle), math.sin(self.middle), 0.5 * self.extent
        along, across = x * cos + y * sin, y * cos - x * sin
        place = np.clip(np.arctan2(across, along), -half, half)
        return np.asarray(1.0 - along * np.cos(place) - across * np.sin(place))


class _Set(NamedTuple):
    """Equal lobes all round: their number, the angle of the middle of the first, and the usual shape."""

    number: int
    first: float
    extent: float
    offset: float


SETS = {
    "elliptical": _Set(2, 90.0 * DEGREE, 160.0 * DEGREE, 0.5),
    "three_lobe": _Set(3, 90.0 * DEGREE, 100.0 * DEGREE, 0.5),
    "four_lobe": _Set(4, 0.0, 75.0 * DEGREE, 0.5),
    "offset_halves": _Set(2, 90.0 * DEGREE, 160.0 * DEGREE, 1.0),
    "tapered_land": _Set(3, 90.0 * DEGREE, 100.0 * DEGREE, 1.0),
}
"""The usual sets of lobes; for a load along -y, those of an elliptical bearing take it on a pad."""

PRELOAD = 0.5
"""Of the usual sets, unless another is said."""


@arguments
def lobe_set(
    name: str,
    *,
    preload: float = PRELOAD,
    extent: float | None = None,
    offset: float | None = None,
    turned: float = 0.0,
) -> tuple[Lobe, ...]:
    """Return one of the usual sets of lobes.

    Parameters
    ----------
    name : str
        `elliptical` (arcs 10-170 and 190-350 deg), `three_lobe` (middles at 90, 210, 330 deg, 100 deg each),
        `four_lobe` (0, 90, 180, 270 deg, 75 deg each), `offset_halves` (as elliptical, the least film at the
        trailing ends), or `tapered_land` (as three_lobe, narrowing all along each pad).
    preload : float [1]
        Of each lobe.
    extent : float [rad], optional
        Angle that each covers.
    offset : float [1], optional
        Of each lobe.
    turned : float [rad]
        Angle by which all are turned in the sense of +z.

    Raises
    ------
    InputError
        If an argument breaks its rule, or lobes of this extent overlap.

    Examples
    --------
    >>> len(lobe_set("three_lobe", preload=0.3))
    3
    """
    if name not in SETS:
        raise InputError(f"name of a set of lobes must be one of {sorted(SETS)}, got {name!r}")
    usual = SETS[name]
    arc = usual.extent if extent is None else extent
    share = usual.offset if offset is None else offset
    step = TURN / usual.number
    first = usual.first + turned - 0.5 * arc
    lobes = tuple(
        Lobe(start=first + k * step, extent=arc, preload=preload, offset=share) for k in range(usual.number)
    )
    require_apart(lobes)
    return lobes


def require_apart(lobes: tuple[Lobe, ...]) -> None:
    """Raise InputError where arcs overlap."""
    ordered = sorted(lobes, key=lambda lobe: lobe.start % (TURN))
    for lobe, following in zip(ordered, [*ordered[1:], *ordered[:1]], strict=True):
        room = (following.start - lobe.start) % (TURN) or TURN
        if lobe.extent > room * (1.0 + 1e-12):
            raise InputError(f"lobes must not overlap, got {lobe!r} and {following!r}")
