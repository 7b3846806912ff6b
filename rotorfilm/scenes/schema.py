"""Schema 1 of scene files: the tables, their keys and their units.

Each table checks its values by building what it describes. A later family has its table in a file of its own,
is listed by one line in `rotorfilm.scenes.families`, and renames nothing.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import TYPE_CHECKING, Annotated

from ..bearings import journal
from ..bearings.films.geometry import FeedHole, Groove, Pad
from ..bearings.films.law import FilmLaw
from ..bearings.journal import JFOFilm, JournalBearing
from ..bearings.oil import Cooling, Oil
from ..core.errors import InputError, require_finite, require_positive
from ..core.limits import STEPS
from ..core.progress import Report
from .journal_tables import (
    FEED_HOLE,
    FILMS,
    GROOVE,
    PAD,
    BearingData,
    ConservedOil,
    bearing_data,
    film_remarks,
)
from .lubricant_table import Lubricant, OiledTable
from .reading import Quantity, TableList, Variant, flag, made_from, read_static_load

if TYPE_CHECKING:
    from ..rotors.rigid import RigidRotor

SCHEMA = 1
"""The version that a scene file states as `schema = 1`."""


@dataclass(frozen=True, kw_only=True)
class JournalTable(OiledTable):
    """`[journal]`: a cylindrical journal bearing, full unless it has pads or grooves.

    Parameters
    ----------
    radius : float [m]
        Bearing radius; a file may give `diameter` instead.
    length : float [m]
        Full axial length.
    clearance : float [m]
        Radial clearance.
    viscosity : float or None [Pa s]
        None where `[lubricant]` gives the oil.
    oil : Oil or None
        Of `[lubricant]`, where there is no viscosity.
    cooling : Cooling or None
        Of `[lubricant]`, with the oil.
    film : FilmLaw, ConservedOil or None
        The film law; if the file does not say, the map where there is one, or what a question needs.
    pads : tuple of Pad
        Where there is a bearing wall; empty for the full circumference.
    grooves : tuple of Groove
        Axial grooves, over the whole length or in its middle.
    supply_pressure : float [Pa]
        Gauge pressure in grooves and holes.
    feed_holes : tuple of FeedHole
        Round holes at mid-length.
    circumferential_groove : float or None [m]
        Axial width of a groove all round at mid-length; None for none.
    supply_flow : float or None [m3/s]
        Oil given to each groove or hole, in place of a supply pressure; only a film that conserves its oil
        takes it, as the next two.
    cavitation_pressure : float [Pa]
        Gauge pressure in the cavity, not above 0.
    submerged : bool
        Whether there is oil around the ends.
    """

    radius: Annotated[float, Quantity("m", twice="diameter")]
    length: Annotated[float, Quantity("m")]
    clearance: Annotated[float, Quantity("m")]
    viscosity: Annotated[float | None, Quantity("Pa.s")] = None
    oil: Oil | None = None
    cooling: Cooling | None = None
    film: Annotated[FilmLaw | ConservedOil | None, Variant("name", FILMS)] = None
    pads: Annotated[tuple[Pad, ...], TableList(PAD)] = ()
    grooves: Annotated[tuple[Groove, ...], TableList(GROOVE)] = ()
    supply_pressure: Annotated[float, Quantity("Pa")] = 0.0
    feed_holes: Annotated[tuple[FeedHole, ...], TableList(FEED_HOLE)] = ()
    circumferential_groove: Annotated[float | None, Quantity("m")] = None
    supply_flow: Annotated[float | None, Quantity("m3/s")] = None
    cavitation_pressure: Annotated[float, Quantity("Pa")] = 0.0
    submerged: Annotated[bool, flag] = False

    def __post_init__(self) -> None:
        # Without a viscosity there is no bearing before `on` has given the oil.
        if self.has_lubricant:
            self.build()

    @property
    def film_is_given(self) -> bool:
        """Whether the file names the film, so that no other may answer."""
        return self.film is not None

    @property
    def conserves(self) -> bool:
        """Whether the film is one that conserves its oil: named so, or with keys that no other takes."""
        return isinstance(self.film, ConservedOil) or bool(self._supply_keys)

    @property
    def _supply_keys(self) -> list[str]:
        given = {
            "supply_flow": self.supply_flow is not None,
            "cavitation_pressure": self.cavitation_pressure != 0.0,
            "submerged": self.submerged,
        }
        return [name for name, there in given.items() if there]

    def require_law(self, what: str) -> None:
        """Raise InputError if the film conserves its oil: it has no force in any motion, as that takes."""
        if self.conserves:
            raise InputError(
                f"journal.film must be a law of the moment for {what}, as map or reynolds, got one that "
                "conserves its oil, and remembers"
            )

    def bearing(self) -> JournalBearing:
        """Return the bearing, with its film law where the file names one; InputError for a bad value."""
        named = None if isinstance(self.film, ConservedOil) else self.film
        if named is not None and self._supply_keys:
            raise InputError(
                f'{self._supply_keys[0]} must be left out unless film is {{name = "jfo"}} or not given, '
                f"got film {journal.film_name(named)}"
            )
        return made_from(JournalBearing, self, film=named, grooves=(*self.grooves, *self.feed_holes))

    def conserved(self, bearing: JournalBearing, cells: tuple[int, int] | None = None) -> JFOFilm:
        """Return the film of a bearing that conserves its oil, on cells that by default are the file's."""
        own = self.film if isinstance(self.film, ConservedOil) else ConservedOil()
        return made_from(JFOFilm, self, bearing=bearing, cells=cells or own.cells)

    def build(self) -> JournalBearing | JFOFilm:
        """Return the bearing, or its film that conserves the oil; InputError for a bad value."""
        bearing = self.bearing()
        return self.conserved(bearing) if self.conserves else bearing

    def echo(self, bearing: JournalBearing | JFOFilm) -> tuple[BearingData, str]:
        """Return what an answer repeats of the bearing, and the name of its film."""
        if isinstance(bearing, JFOFilm):
            return bearing_data(bearing.bearing), f"JFOFilm(cells={bearing.cells})"
        return bearing_data(bearing), journal.film_name(bearing.fitted_film)

    def remarks(
        self, bearing: JournalBearing | JFOFilm, oil: Lubricant, speed: float, load: tuple[float, float]
    ) -> tuple[str, ...]:
        """Return what its physics leaves out and should not; see `film_remarks`."""
        return film_remarks(bearing, oil, speed, load)

    def make_map(self, report: Report) -> None:
        """Make the map of openings, where there are some and the film is one, unless it lies on disk."""
        if not (self.grooves or self.pads):
            return
        bearing = self.build()
        if isinstance(bearing, JFOFilm):
            return
        if isinstance(bearing.fitted_film, journal.GroovedMapFilm):
            journal.build_groove_map(bearing, report)


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
    duration : float or None [s]
        Length of a run. None: `cosimulation.revolutions` turns of the shaft.
    """

    speed: Annotated[float, Quantity("rad/s")]
    load: Annotated[tuple[float, float] | None, read_static_load] = None
    duration: Annotated[float | None, Quantity("s")] = None

    def __post_init__(self) -> None:
        require_finite("speed", self.speed)
        if self.duration is not None:
            require_positive("duration", self.duration)
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
        from ..rotors.rigid import RigidRotor

        return made_from(RigidRotor, self, speed=speed, gravity=(0.0, 0.0), static_force=load)


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
        require_steps("revolutions / macro_angle", 2.0 * math.pi * self.revolutions, self)


def require_steps(name: str, angle: float, of: CosimulationTable) -> None:
    """Raise InputError where a run over an angle [rad] of the shaft has more exchanges than can be kept."""
    steps = angle / of.macro_angle
    if steps > STEPS:
        raise InputError(f"{name} must make at most {STEPS} steps of {of.macro_angle:g} rad, got {steps:.3g}")
