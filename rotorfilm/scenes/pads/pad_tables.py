"""What the tables of bearings made of pads share: dimensions, oil, film and maps."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Annotated, Any

from ...bearings.oil import Cooling, Oil
from ...bearings.pads import PadFilm, PadMapFilm
from ...progress import Report
from ..lubricant_table import Lubricant, OiledTable
from ..reading.tables import Quantity, Variant
from .pad_films import PAD_FILMS
from .pad_remarks import AnyPads, pad_remarks


@dataclass(frozen=True, kw_only=True)
class PadTable(OiledTable):
    """The table of a bearing made of pads; a family adds its pads, `build` and `echo`.

    Parameters
    ----------
    radius : float [m]
        Of the journal; a file may give `diameter` instead.
    length : float [m]
        Full axial length.
    pad_clearance : float or None [m]
        c_p: the radius of curvature of a pad less that of the journal. Give this or the assembled one.
    assembled_clearance : float or None [m]
        c_b = (1 - preload) c_p: the least gap around a centered journal.
    viscosity : float or None [Pa s]
        None where `[lubricant]` gives the oil.
    oil : Oil or None
        Of `[lubricant]`, where there is no viscosity.
    cooling : Cooling or None
        Of `[lubricant]`, with the oil.
    temperature : float or None [K]
        Of the films, where a question keeps it; None for that of the balance of their heat.
    """

    radius: Annotated[float, Quantity("m", twice="diameter")]
    length: Annotated[float, Quantity("m")]
    pad_clearance: Annotated[float | None, Quantity("m")] = None
    assembled_clearance: Annotated[float | None, Quantity("m")] = None
    viscosity: Annotated[float | None, Quantity("Pa.s")] = None
    oil: Oil | None = None
    cooling: Cooling | None = None
    temperature: float | None = None

    def __post_init__(self) -> None:
        if self.has_lubricant:
            self.build()
        else:  # until `on` gives the oil, the other values are checked beside any viscosity
            replace(self, viscosity=1.0)

    def build(self) -> AnyPads:
        """Return the bearing; raise InputError where a value breaks its rule."""
        raise NotImplementedError

    def remarks(
        self, bearing: AnyPads, oil: Lubricant, speed: float, load: tuple[float, float]
    ) -> tuple[str, ...]:
        """Return what its physics leaves out and should not."""
        return pad_remarks(bearing, oil, speed, load)


@dataclass(frozen=True, kw_only=True)
class FilmedPadTable(PadTable):
    """The table of a bearing whose pads have a film of pads.

    Parameters
    ----------
    film : PadFilm or None
        The film law; if the file does not say, the map of a pad, or what a question needs.
    """

    film: Annotated[PadFilm | None, Variant("name", PAD_FILMS)] = None

    @property
    def film_is_given(self) -> bool:
        """Whether the file names the film, so that no other may answer."""
        return self.film is not None

    def make_map(self, report: Report) -> None:
        """Make the maps of the pads, where the film is one, unless they lie on disk."""
        bearing: Any = self.build()
        if isinstance(bearing.film, PadMapFilm):
            for extent in sorted(set(bearing.extents)):
                bearing.film.table(extent, bearing.slenderness, report)
