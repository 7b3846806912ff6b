"""`[tilting_pad]` of a scene: a bearing of tilting pads."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Annotated, Any, Self

from ...bearings.oil import Cooling, Oil
from ...bearings.pads import PadFilm, PadMapFilm, TiltingPadBearing, even_pivots
from ...errors import InputError, SceneError, brief
from ...progress import Report
from ...readable.result import Readable
from ..lubricant_table import Lubricant, LubricantTable
from ..reading.readers import Count, takes
from ..reading.shared_fields import made_from
from ..reading.spelling import nearest
from ..reading.tables import Quantity, Variant
from .pad_films import PAD_FILMS, make_pad_maps, on_oil, pad_film_name
from .pad_remarks import pad_remarks

PADS = 64
"""Most pads: each has a film of its own."""

LOADINGS = {"on_pad": False, "between_pads": True}
"""Whether a load along -y points between two pivots, by the name in scene files."""


@takes(LOADINGS)
def read_loading(where: str, value: Any) -> str:
    """Read whether the load points to a pivot or between two."""
    if not isinstance(value, str) or value not in LOADINGS:
        raise SceneError(
            f"{where} must be one of {', '.join(LOADINGS)}, got {brief(value)}{nearest(value, LOADINGS)}"
        )
    return value


@takes([Quantity("rad"), ...])
def read_pivots(where: str, value: Any) -> tuple[float, ...]:
    """Read a list of angles."""
    if not isinstance(value, list) or not 1 <= len(value) <= PADS:
        raise SceneError(f"{where} must be a list of 1 to {PADS} angles, got {brief(value)}")
    return tuple(Quantity("rad")(f"{where}[{k}]", one) for k, one in enumerate(value))


@dataclass(frozen=True, kw_only=True)
class TiltingData(Readable):
    """A bearing of tilting pads as it was understood.

    Attributes
    ----------
    radius, length : float [m]
    slenderness : float [1]
        Length / diameter.
    pad_clearance : float [m]
        c_p, in which the eccentricity ratio is.
    assembled_clearance : float [m]
        c_b, at a pivot around a centered journal.
    preload : float [1]
        1 - c_b/c_p.
    viscosity : float [Pa s]
        Of the films, or of fresh oil where the temperature follows from the balance of their heat.
    pivots : tuple of float [rad]
        Angles in the bearing frame.
    extent : float [rad]
        Of each pad.
    pivot_offset : float [1]
        Share of a pad before its pivot.
    """

    radius: float
    length: float
    slenderness: float
    pad_clearance: float
    assembled_clearance: float
    preload: float
    viscosity: float
    pivots: tuple[float, ...]
    extent: float
    pivot_offset: float


@dataclass(frozen=True, kw_only=True)
class TiltingTable:
    """`[tilting_pad]`: a journal bearing of equal tilting pads.

    Parameters
    ----------
    radius : float [m]
        Of the journal; a file may give `diameter` instead.
    length : float [m]
        Full axial length.
    extent : float [rad]
        Angle that a pad covers.
    pad_clearance : float or None [m]
        c_p: the radius of curvature of a pad less that of the journal. Give this or the assembled one.
    assembled_clearance : float or None [m]
        c_b = (1 - preload) c_p: the gap at a pivot around a centered journal.
    viscosity : float or None [Pa s]
        None where `[lubricant]` gives the oil.
    oil : Oil or None
        Of `[lubricant]`, where there is no viscosity.
    cooling : Cooling or None
        Of `[lubricant]`, with the oil.
    temperature : float or None [K]
        Of the films, where a question keeps it; None for that of the balance of their heat.
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
    film : PadFilm or None
        The film law; if the file does not say, the map of a pad, or what a question needs.
    """

    radius: Annotated[float, Quantity("m", twice="diameter")]
    length: Annotated[float, Quantity("m")]
    extent: Annotated[float, Quantity("rad")]
    pad_clearance: Annotated[float | None, Quantity("m")] = None
    assembled_clearance: Annotated[float | None, Quantity("m")] = None
    viscosity: Annotated[float | None, Quantity("Pa.s")] = None
    oil: Oil | None = None
    cooling: Cooling | None = None
    temperature: float | None = None
    pad_count: Annotated[int | None, Count(PADS, 2)] = None
    loading: Annotated[str | None, read_loading] = None
    pivots: Annotated[tuple[float, ...], read_pivots] = ()
    pivot_offset: Annotated[float, Quantity("1")] = 0.5
    preload: Annotated[float, Quantity("1")] = 0.0
    pivot_stiffness: Annotated[float | None, Quantity("N/m")] = None
    pad_inertia: Annotated[float | None, Quantity("kg.m2")] = None
    pivot_distance: Annotated[float, Quantity("m")] = 0.0
    pad_mass: Annotated[float | None, Quantity("kg")] = None
    film: Annotated[PadFilm | None, Variant("name", PAD_FILMS)] = None

    def __post_init__(self) -> None:
        if (self.pad_count is None) is (not self.pivots):
            got = "neither" if self.pad_count is None else "both"
            raise InputError(f"pad_count or pivots is required, one of both, got {got}")
        if (self.pad_count is None) is not (self.loading is None):
            raise InputError(
                f"loading must be given with pad_count, and only then, got {self.loading!r} and "
                f"{self.pad_count!r}"
            )
        # Without a viscosity there is no lubricant before `on` has given the oil.
        self._built(1.0 if self.viscosity is None and self.oil is None else self.viscosity)

    @property
    def film_is_given(self) -> bool:
        """Whether the file names the film, so that no other may answer."""
        return self.film is not None

    def on(self, where: str, lubricant: LubricantTable) -> Self:
        """Return this table with the oil of the scene, unless it has its own viscosity."""
        return on_oil(self, where, lubricant)

    def build(self) -> TiltingPadBearing:
        """Return the bearing; raise InputError where a value breaks its rule."""
        return self._built(self.viscosity)

    def _built(self, viscosity: float | None) -> TiltingPadBearing:
        pivots = self.pivots
        if self.pad_count is not None and self.loading is not None:
            pivots = even_pivots(self.pad_count, between_pads=LOADINGS[self.loading])
        film = self.film or PadMapFilm()
        return made_from(TiltingPadBearing, self, viscosity=viscosity, pivots=pivots, film=film)

    def echo(self, bearing: TiltingPadBearing) -> tuple[TiltingData, str]:
        """Return what an answer repeats of the bearing, and the name of its film."""
        data = made_from(
            TiltingData,
            bearing,
            slenderness=bearing.slenderness,
            viscosity=bearing.film_viscosity,
            pad_clearance=bearing.clearance,
            assembled_clearance=bearing.bore_clearance,
        )
        return data, pad_film_name(bearing.film)

    def remarks(
        self, bearing: TiltingPadBearing, oil: Lubricant, speed: float, load: tuple[float, float]
    ) -> tuple[str, ...]:
        """Return what its physics leaves out and should not."""
        return pad_remarks(bearing, bearing.extent, oil, speed, load)

    def make_map(self, report: Report) -> None:
        """Make the map of the pads, where the film is one, unless it lies on disk."""
        bearing = self.build()
        make_pad_maps(bearing.film, {bearing.extent}, bearing.slenderness, report)
