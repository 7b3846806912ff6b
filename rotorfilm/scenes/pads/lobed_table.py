"""`[lobed_journal]` of a scene: a bearing of fixed pads."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Annotated

from ...bearings.pads import SETS, Lobe, LobedBearing, lobe_set
from ...errors import InputError
from ..reading.readers import one_of
from ..reading.shared_fields import made_from
from ..reading.tables import Keyed, Quantity, TableList
from .pad_data import LobedData, echo_of_pads
from .pad_films import pad_film_name, usual_film
from .pad_tables import FilmedPadTable

LOBE = Keyed(
    Lobe,
    {"start": Quantity("rad"), "extent": Quantity("rad"), "preload": Quantity("1"), "offset": Quantity("1")},
)
"""`lobes = [{start, extent, preload, offset}]`: a fixed pad with a center of curvature of its own."""


@dataclass(frozen=True, kw_only=True)
class LobedTable(FilmedPadTable):
    """`[lobed_journal]`: a journal bearing of fixed pads: elliptical, of several lobes, of offset halves.

    Parameters
    ----------
    preset : str or None
        One of the usual sets of `lobe_set`; give this or `lobes`.
    preload, extent, offset, turned : float or None [1], [rad], [1], [rad]
        Of a preset: preload of each lobe (.5), its angle, the place of its least film as a share of its arc,
        and the angle by which all are turned.
    lobes : tuple of Lobe
        The pads one by one.
    """

    preset: Annotated[str | None, one_of(SETS)] = None
    preload: Annotated[float | None, Quantity("1")] = None
    extent: Annotated[float | None, Quantity("rad")] = None
    offset: Annotated[float | None, Quantity("1")] = None
    turned: Annotated[float | None, Quantity("rad")] = None
    lobes: Annotated[tuple[Lobe, ...], TableList(LOBE)] = ()

    def __post_init__(self) -> None:
        if (self.preset is None) is (not self.lobes):
            got = "neither" if self.preset is None else "both"
            raise InputError(f"preset or lobes is required, one of both, got {got}")
        for name, value in self._of_preset.items():
            if self.lobes:
                raise InputError(f"{name} must stand in each of lobes, or beside a preset, got {value!r}")
        super().__post_init__()

    @property
    def _of_preset(self) -> dict[str, float]:
        given = {name: getattr(self, name) for name in ("preload", "extent", "offset", "turned")}
        return {name: value for name, value in given.items() if value is not None}

    def build(self) -> LobedBearing:
        """Return the bearing; raise InputError where a value breaks its rule."""
        lobes = self.lobes or lobe_set(self.preset or "", **self._of_preset)
        film = self.film or usual_film((lobe.extent for lobe in lobes), self.radius, self.length)
        return made_from(LobedBearing, self, lobes=lobes, film=film)

    def echo(self, bearing: LobedBearing) -> tuple[LobedData, str]:
        """Return what an answer repeats of the bearing, and the name of its film."""
        return echo_of_pads(LobedData, bearing), pad_film_name(bearing.film)
