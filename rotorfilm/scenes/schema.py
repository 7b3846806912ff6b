"""Schema 1 of scene files: the tables, their keys and their units.

Each table checks its values by building what it describes. A later family adds a table to
`rotorfilm.scenes.scene.Scene`, or a variant to a mapping below, and renames nothing.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, field
from typing import Annotated, Any

from ..bearings.journal import JournalBearing
from ..errors import SceneError, require_finite, require_positive
from ..films import ComplementarityArc, FixedArc, MapFilm, ReynoldsArc, RotatingArc, ShortFilm, SplittingFilm
from ..rotors.rigid import RigidRotor
from .tables import Quantity, Variant, flag

SCHEMA = 1
"""The version that a scene file states as `schema = 1`."""


def read_load(where: str, value: Any) -> tuple[float, float]:
    """Read a load [N]: one positive magnitude, which acts along -y, or the two components [x, y]."""
    if isinstance(value, list):
        if len(value) != 2:
            raise SceneError(f"{where} must be one magnitude or two components [x, y], got {value!r}")
        x, y = (Quantity("N")(f"{where}[{index}]", entry) for index, entry in enumerate(value))
        return x, y
    magnitude = Quantity("N")(where, value)
    if not magnitude > 0.0:
        raise SceneError(f"{where} must be a positive magnitude or two components [x, y], got {value!r}")
    return 0.0, -magnitude


def read_order(where: str, value: Any) -> tuple[int, int | None]:
    """Read an order [n, m] of the splitting method; m may be "inf", all axial modes."""
    match value:
        case [int() as n, "inf"] if _is_count(n):
            return n, None
        case [int() as n, int() as m] if _is_count(n) and _is_count(m):
            return n, m
    raise SceneError(f"{where} must be [n, m] of positive integers, m also 'inf', got {value!r}")


def _is_count(value: int) -> bool:
    return not isinstance(value, bool) and value > 0


@dataclass(frozen=True, kw_only=True)
class FixedArcTable:
    """`rupture = {kind = "fixed"}`: the film lies on an arc fixed to the line of maximum film.

    Parameters
    ----------
    start, extent : float [rad]
        Where the arc starts, and its length, in the sense of rotation.
    """

    start: Annotated[float, Quantity("rad")] = 0.0
    extent: Annotated[float, Quantity("rad")] = math.pi

    def __post_init__(self) -> None:
        self.build()

    def build(self) -> FixedArc:
        """Return the rupture rule."""
        return FixedArc(start=self.start, extent=self.extent)


@dataclass(frozen=True, kw_only=True)
class RotatingArcTable:
    """`rupture = {kind = "rotating"}`: the film lies where the wedge and squeeze press it."""

    def build(self) -> RotatingArc:
        """Return the rupture rule."""
        return RotatingArc()


@dataclass(frozen=True, kw_only=True)
class ReynoldsArcTable:
    """`rupture = {kind = "reynolds"}`: the film ends where its pressure leaves with no slope.

    Parameters
    ----------
    start : float or None [rad]
        Where the film starts, from the line of maximum film; if the file does not say, where the wedge and
        squeeze begin to press it.
    """

    start: Annotated[float | None, Quantity("rad")] = None

    def __post_init__(self) -> None:
        self.build()

    def build(self) -> ReynoldsArc:
        """Return the rupture rule."""
        return ReynoldsArc(start=self.start)


@dataclass(frozen=True, kw_only=True)
class ComplementarityArcTable:
    """`rupture = {kind = "complementarity"}`: the film starts and ends where pressure has no slope."""

    def build(self) -> ComplementarityArc:
        """Return the rupture rule."""
        return ComplementarityArc()


RuptureTable = FixedArcTable | RotatingArcTable | ReynoldsArcTable | ComplementarityArcTable
RUPTURES = {
    "fixed": FixedArcTable,
    "rotating": RotatingArcTable,
    "reynolds": ReynoldsArcTable,
    "complementarity": ComplementarityArcTable,
}


@dataclass(frozen=True, kw_only=True)
class ShortFilmTable:
    """`film = {name = "short"}`: the short-bearing film on a moving arc of half a turn."""

    def build(self) -> ShortFilm:
        """Return the film law."""
        return ShortFilm()


@dataclass(frozen=True, kw_only=True)
class SplittingFilmTable:
    """`film = {name = "splitting"}`: the splitting method of order (n, m).

    Parameters
    ----------
    order : (int, int or None)
        Circumferential functions and odd axial modes; `[2, "inf"]` takes all axial modes.
    constant : bool
        Whether the constant function joins the circumferential ones.
    rupture : FixedArcTable, RotatingArcTable, ReynoldsArcTable or ComplementarityArcTable
        Where the film begins and ends.
    """

    order: Annotated[tuple[int, int | None], read_order]
    constant: Annotated[bool, flag] = False
    rupture: Annotated[RuptureTable, Variant("kind", RUPTURES)] = field(default_factory=FixedArcTable)

    def __post_init__(self) -> None:
        self.build()

    def build(self) -> SplittingFilm:
        """Return the film law."""
        return SplittingFilm(order=self.order, constant=self.constant, rupture=self.rupture.build())


@dataclass(frozen=True, kw_only=True)
class MapFilmTable:
    """`film = {name = "map"}`: the film with Reynolds rupture, from its impedance map."""

    def build(self) -> MapFilm:
        """Return the film law."""
        return MapFilm()


FilmTable = ShortFilmTable | SplittingFilmTable | MapFilmTable
FILMS = {"map": MapFilmTable, "short": ShortFilmTable, "splitting": SplittingFilmTable}


@dataclass(frozen=True, kw_only=True)
class JournalTable:
    """`[journal]`: a plain cylindrical journal bearing.

    Parameters
    ----------
    radius : float [m]
        Journal radius; a file may give `diameter` instead.
    length : float [m]
        Full axial length.
    clearance : float [m]
        Radial clearance.
    viscosity : float [Pa s]
    film : ShortFilmTable or SplittingFilmTable
        The film law; short if the file does not say.
    """

    radius: Annotated[float, Quantity("m", twice="diameter")]
    length: Annotated[float, Quantity("m")]
    clearance: Annotated[float, Quantity("m")]
    viscosity: Annotated[float, Quantity("Pa.s")]
    film: Annotated[FilmTable, Variant("name", FILMS)] = field(default_factory=ShortFilmTable)

    def __post_init__(self) -> None:
        self.build()

    def build(self) -> JournalBearing:
        """Return the bearing; raise InputError where a value breaks its rule."""
        return JournalBearing(
            radius=self.radius,
            length=self.length,
            clearance=self.clearance,
            viscosity=self.viscosity,
            film=self.film.build(),
        )


@dataclass(frozen=True, kw_only=True)
class OperationTable:
    """`[operation]`: the working point.

    Parameters
    ----------
    speed : float [rad/s]
        Angular speed about +z.
    load : (float, float) or None [N]
        Whole static force on the journal, weight included; in a file one magnitude, along -y, or
        `[x, y]`. None: the weight of the rotor.
    """

    speed: Annotated[float, Quantity("rad/s")]
    load: Annotated[tuple[float, float] | None, read_load] = None

    def __post_init__(self) -> None:
        require_finite("speed", self.speed)
        if self.load is not None:
            require_finite("load", self.load)


@dataclass(frozen=True, kw_only=True)
class RigidRotorTable:
    """`[rigid_rotor]`: a rigid rotor in translation, as much of it as one bearing carries.

    Parameters
    ----------
    mass : float [kg]
        Mass carried by the bearing.
    unbalance : float [kg m]
        Mass times eccentricity of its center of mass.
    unbalance_angle : float [rad]
        Angle of the unbalance from +x at t = 0.
    """

    mass: Annotated[float, Quantity("kg")]
    unbalance: Annotated[float, Quantity("kg.m")] = 0.0
    unbalance_angle: Annotated[float, Quantity("rad")] = 0.0

    def __post_init__(self) -> None:
        self.build(speed=0.0, load=(0.0, 0.0))

    def build(self, speed: float, load: tuple[float, float]) -> RigidRotor:
        """Return the rotor under the whole static load [N], at a constant speed [rad/s]."""
        return RigidRotor(
            mass=self.mass,
            speed=speed,
            unbalance=self.unbalance,
            unbalance_angle=self.unbalance_angle,
            gravity=(0.0, 0.0),
            static_force=load,
        )


@dataclass(frozen=True, kw_only=True)
class CosimulationTable:
    """`[cosimulation]`: how the rotor and the film are coupled as separate simulators.

    Parameters
    ----------
    macro_angle : float [rad]
        Shaft rotation between two exchanges of signals.
    revolutions : float [1]
        Length of a run in turns of the shaft.
    """

    macro_angle: Annotated[float, Quantity("rad")] = math.radians(1.0)
    revolutions: Annotated[float, Quantity("1")] = 10.0

    def __post_init__(self) -> None:
        require_positive("macro_angle", self.macro_angle)
        require_positive("revolutions", self.revolutions)
