"""What answers repeat of bearings made of pads."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, TypeVar

from ...bearings.pads import Lobe, RecessedPad
from ...readable.result import Readable
from ..reading.shared_fields import made_from
from .pad_films import pad_film_name

D = TypeVar("D", bound=Readable)


@dataclass(frozen=True, kw_only=True)
class PadData(Readable):
    """A bearing made of pads as it was understood.

    Attributes
    ----------
    radius, length : float [m]
    slenderness : float [1]
        Length / diameter.
    viscosity : float [Pa s]
    """

    radius: float
    length: float
    slenderness: float
    viscosity: float


@dataclass(frozen=True, kw_only=True)
class FilmedPadData(PadData):
    """A bearing whose pads have a film of pads, as it was understood.

    Attributes
    ----------
    pad_clearance : float [m]
        c_p, in which the eccentricity ratio is.
    assembled_clearance : float [m]
        c_b, at the closest place of a centered journal.
    """

    pad_clearance: float
    assembled_clearance: float


@dataclass(frozen=True, kw_only=True)
class LobedData(FilmedPadData):
    """A bearing of fixed pads as it was understood.

    Attributes
    ----------
    lobes : tuple of Lobe
        Angles in the bearing frame [rad].
    """

    lobes: tuple[Lobe, ...]


@dataclass(frozen=True, kw_only=True)
class TiltingData(FilmedPadData):
    """A bearing of tilting pads as it was understood.

    Attributes
    ----------
    preload : float [1]
        1 - c_b/c_p.
    pivots : tuple of float [rad]
        Angles in the bearing frame.
    extent : float [rad]
        Of each pad.
    pivot_offset : float [1]
        Share of a pad before its pivot.
    """

    preload: float
    pivots: tuple[float, ...]
    extent: float
    pivot_offset: float


@dataclass(frozen=True, kw_only=True)
class DamData(PadData):
    """A bearing of pads with recesses as it was understood.

    Attributes
    ----------
    clearance : float [m]
        Radial clearance of the bearing as assembled.
    pads : tuple of RecessedPad
        Angles in the bearing frame [rad].
    """

    clearance: float
    pads: tuple[RecessedPad, ...]


def echo_of_pads(kind: type[D], bearing: Any, assembled_clearance: float) -> tuple[D, str]:
    """Return what an answer repeats of a bearing with a film of pads, and the name of that.

    Parameters
    ----------
    kind : type
        LobedData or TiltingData.
    bearing : LobedBearing or TiltingPadBearing
    assembled_clearance : float [m]
    """
    lengths = {"pad_clearance": bearing.clearance, "assembled_clearance": assembled_clearance}
    return made_from(kind, bearing, slenderness=bearing.slenderness, **lengths), pad_film_name(bearing.film)
