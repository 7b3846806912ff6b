"""What answers repeat of bearings made of pads."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TypeVar

from ...bearings.pads import Lobe, RecessedPad
from ...readable.result import Readable
from ..reading.shared_fields import made_from
from .pad_remarks import AnyPads

D = TypeVar("D", bound=Readable)


@dataclass(frozen=True, kw_only=True)
class PadData(Readable):
    """A bearing made of pads as it was understood.

    Attributes
    ----------
    radius, length : float [m]
    slenderness : float [1]
        Length / diameter.
    pad_clearance : float [m]
        c_p, in which the eccentricity ratio is.
    assembled_clearance : float [m]
        c_b, at the closest place of a centered journal.
    viscosity : float [Pa s]
        Of the films, or of fresh oil where the temperature follows from the balance of their heat.
    """

    radius: float
    length: float
    slenderness: float
    pad_clearance: float
    assembled_clearance: float
    viscosity: float


@dataclass(frozen=True, kw_only=True)
class LobedData(PadData):
    """A bearing of fixed pads as it was understood.

    Attributes
    ----------
    lobes : tuple of Lobe
        Angles in the bearing frame [rad].
    """

    lobes: tuple[Lobe, ...]


@dataclass(frozen=True, kw_only=True)
class TiltingData(PadData):
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
    pads : tuple of RecessedPad
        Angles in the bearing frame [rad].
    """

    pads: tuple[RecessedPad, ...]


def echo_of_pads(kind: type[D], bearing: AnyPads) -> D:
    """Return what an answer repeats of a bearing made of pads.

    Parameters
    ----------
    kind : type
        LobedData, TiltingData or DamData.
    bearing : LobedBearing, TiltingPadBearing or PressureDamBearing
    """
    return made_from(
        kind,
        bearing,
        slenderness=bearing.slenderness,
        viscosity=bearing.film_viscosity,
        pad_clearance=bearing.clearance,
        assembled_clearance=bearing.bore_clearance,
    )
