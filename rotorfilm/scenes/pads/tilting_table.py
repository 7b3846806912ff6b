"""`[tilting_pad]` of a scene: a bearing of tilting pads."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Annotated, Any

from ...bearings.pads import TiltingPadBearing, even_pivots
from ...errors import InputError, SceneError, brief
from ..reading.readers import Count, one_of, takes
from ..reading.shared_fields import made_from
from ..reading.tables import Quantity
from .pad_data import TiltingData, echo_of_pads
from .pad_films import pad_film_name, usual_film
from .pad_tables import FilmedPadTable

PADS = 64
"""Most pads: each has a film of its own."""

LOADINGS = {"on_pad": False, "between_pads": True}
"""Whether a load along -y points between two pivots, by the name in scene files."""


@takes([Quantity("rad"), ...])
def read_pivots(where: str, value: Any) -> tuple[float, ...]:
    """Read a list of angles."""
    if not isinstance(value, list) or not 1 <= len(value) <= PADS:
        raise SceneError(f"{where} must be a list of 1 to {PADS} angles, got {brief(value)}")
    return tuple(Quantity("rad")(f"{where}[{k}]", one) for k, one in enumerate(value))


@dataclass(frozen=True, kw_only=True)
class TiltingTable(FilmedPadTable):
    """`[tilting_pad]`: a journal bearing of equal tilting pads.

    Parameters
    ----------
    extent : float [rad]
        Angle that a pad covers.
    pad_count : int or None
        Number of evenly spaced pads; give this, with `loading`, or `pivots`.
    loading : str or None
        Whether a load along -y points to a pivot, "on_pad", or "between_pads".
    pivots : tuple of float [rad]
        Angles of the pivots, from +x towards +y.
    pivot_offset : float [1]
        Share of a pad before its pivot.
    preload : float [1]
        1 - c_b/c_p.
    pivot_stiffness : float or None [N/m]
        Of a spring below each pivot; None for rigid ones.
    pad_inertia : float or None [kg m2]
        About the pivot; None for pads that follow at once.
    pivot_distance : float [m]
        From the film back to the center about which a pad rolls or rocks.
    pad_mass : float or None [kg]
        That moves with the pivot.
    """

    extent: Annotated[float, Quantity("rad")]
    pad_count: Annotated[int | None, Count(PADS, 2)] = None
    loading: Annotated[str | None, one_of(LOADINGS)] = None
    pivots: Annotated[tuple[float, ...], read_pivots] = ()
    pivot_offset: Annotated[float, Quantity("1")] = 0.5
    preload: Annotated[float, Quantity("1")] = 0.0
    pivot_stiffness: Annotated[float | None, Quantity("N/m")] = None
    pad_inertia: Annotated[float | None, Quantity("kg.m2")] = None
    pivot_distance: Annotated[float, Quantity("m")] = 0.0
    pad_mass: Annotated[float | None, Quantity("kg")] = None

    def __post_init__(self) -> None:
        if (self.pad_count is None) is (not self.pivots):
            got = "neither" if self.pad_count is None else "both"
            raise InputError(f"pad_count or pivots is required, one of both, got {got}")
        if (self.pad_count is None) is not (self.loading is None):
            raise InputError(
                f"loading must be given with pad_count, and only then, got {self.loading!r} and "
                f"{self.pad_count!r}"
            )
        super().__post_init__()

    def build(self) -> TiltingPadBearing:
        """Return the bearing; raise InputError where a value breaks its rule."""
        pivots = self.pivots
        if self.pad_count is not None and self.loading is not None:
            pivots = even_pivots(self.pad_count, between_pads=LOADINGS[self.loading])
        film = self.film or usual_film([self.extent], self.radius, self.length)
        return made_from(TiltingPadBearing, self, pivots=pivots, film=film)

    def echo(self, bearing: TiltingPadBearing) -> tuple[TiltingData, str]:
        """Return what an answer repeats of the bearing, and the name of its film."""
        return echo_of_pads(TiltingData, bearing), pad_film_name(bearing.film)
