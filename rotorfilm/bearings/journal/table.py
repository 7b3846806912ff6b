"""`[journal]`: the bearing with its openings, its films and their rupture; what its physics leaves out."""

from __future__ import annotations

import math
import warnings
from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import cached_property
from typing import Annotated, Any

from ...analysis import equilibrium
from ...core.errors import InputError, RotorfilmError, SceneError, ValidityWarning, brief
from ...core.limits import FUNCTIONS, MAP_NODES
from ...core.progress import Report
from ...core.readable import Readable
from ...core.results import Equilibrium
from ...scenes import reading
from ...scenes.families import isothermal, messages, remarks_of
from ...scenes.oil_film_tables import (
    AUTO,
    CONSERVING,
    ConservedOil,
    ConservingTable,
    effect_of,
    film_numbers,
    film_of_cells,
    has_map,
    read_turbulence,
    turbulent_remarks,
    warmed,
    without_oil,
)
from ...scenes.shared_tables import Lubricant, OiledTable
from .. import journal
from ..films import geometry
from ..films.law import FilmLaw
from ..films.turbulence import Turbulence
from . import (
    ExtrapolatedFilm,
    HeldTilt,
    JFOFilm,
    JournalBearing,
    MapFilm,
    MomentCarryingJournal,
    ReynoldsFilm,
    ShortFilm,
    TiltLevel,
)

ORDER = reading.Count(FUNCTIONS)


@reading.takes([ORDER, (ORDER, {"inf": None})])
def read_order(where: str, value: Any) -> tuple[int, int | None]:
    """Read an order [n, m] of the splitting method; m may be "inf", all axial modes."""
    if not isinstance(value, list) or len(value) != 2:
        raise SceneError(f"{where} must be [n, m] of positive integers, m also 'inf', got {brief(value)}")
    n, m = value
    return ORDER(f"{where}[0]", n), None if m == "inf" else ORDER(f"{where}[1]", m)


NODES = reading.counts(("over", "turning", "moving"), MAP_NODES)
"""Reader of the nodes of a map with openings."""

RUPTURES: dict[str, Callable[[], reading.Keyed[Any]]] = {
    "fixed": lambda: reading.keys_of(journal.FixedArc, "start", "extent"),
    "rotating": lambda: reading.keys_of(journal.RotatingArc),
    "reynolds": lambda: reading.keys_of(journal.ReynoldsArc, "start"),
    "complementarity": lambda: reading.keys_of(journal.ComplementarityArc),
}
"""`rupture = {kind = "fixed", ...}`: rupture rules of the splitting film by their names."""

CAVITATIONS = {
    "complementarity": geometry.Complementarity,
    "half_sommerfeld": geometry.HalfSommerfeld,
    "full": geometry.FullFilm,
}
"""What the two-dimensional film does in tension, by name."""

STARTS = {"free": geometry.FreeOnset, "widest_gap": geometry.MaximumGapOnset, "line": geometry.FixedOnset}
"""Where the two-dimensional film of a bearing without openings starts, by name."""


FILMS: dict[str, Callable[[], reading.Keyed[FilmLaw | ConservedOil]]] = {
    # With grooves or several pads at ambient pressure that is `grooved_map` with its defaults.
    "map": lambda: reading.keys_of(journal.MapFilm),
    "grooved_map": lambda: reading.keys_of(
        journal.GroovedMapFilm, "largest_eccentricity_ratio", cells=reading.COUNTS["cells"], nodes=NODES
    ),
    "reynolds": lambda: reading.keys_of(
        journal.ReynoldsFilm,
        "cells",
        cavitation=reading.Variant("kind", CAVITATIONS),
        film_start=reading.Variant("kind", STARTS),
    ),
    **CONSERVING,
    "short": lambda: reading.keys_of(journal.ShortFilm),
    "splitting": lambda: reading.keys_of(
        journal.SplittingFilm,
        "constant",
        required=("order",),
        order=read_order,
        rupture=reading.Variant("kind", RUPTURES),
    ),
}
"""`film = {name = "map"}`: film laws by their names in scene files and at the command line."""


ANGLES = reading.Several(reading.Quantity("rad"), 2, 2, "two angles, about x and about y")


@dataclass(frozen=True, kw_only=True)
@reading.fields_of(JournalBearing, JFOFilm, without=("bearing", "cells", "mobility"))
class JournalTable(ConservingTable, OiledTable):
    """`[journal]`: a cylindrical journal bearing, full unless it has pads or grooves.

    Supply flow, cavitation pressure and submerged ends are for a film that conserves its oil only.

    Parameters
    ----------
    length : float [m]
        Full axial length.
    viscosity : float or None [Pa s]
        None where `[lubricant]` gives the oil.
    film : FilmLaw, ConservedOil or None
        The film law; if the file does not say, the map where there is one, or what a question needs.
    pads : tuple of Pad
        Where there is a bearing wall; empty for the full circumference.
    grooves : tuple of Groove
        Axial grooves, over the whole length or in its middle.
    feed_holes : tuple of FeedHole
        Round holes at mid-length.
    turbulence : Turbulence or str
        "auto": laminar below the onset and turbulent above it, where no film is named or it is one on a grid;
        "none", the name of a closure, or a table of `Turbulence`.
    tilt : (float, float) or None [rad]
        Rotation of the journal about x and y, which it keeps; then the least film is that over the whole
        length. Of a laminar film, a map or one on a grid, at a viscosity.
    """

    film: Annotated[FilmLaw | ConservedOil | None, reading.Variant("name", FILMS)] = None
    pads: tuple[geometry.Pad, ...] = ()
    grooves: tuple[geometry.Groove, ...] = ()
    feed_holes: tuple[geometry.FeedHole, ...] = ()
    turbulence: Annotated[Turbulence | str, read_turbulence] = AUTO
    tilt: Annotated[tuple[float, float] | None, ANGLES] = None

    def __post_init__(self) -> None:
        if self.tilt is not None and (self.conserves or isinstance(self.turbulence, Turbulence)):
            raise InputError(
                "tilt must be left out of a journal whose film conserves its oil or is turbulent, "
                f"got {self.tilt!r} rad"
            )
        # Without a viscosity there is no bearing before `on` has given the oil.
        if self.has_lubricant:
            self.build()

    @property
    def film_is_given(self) -> bool:
        """Whether the file names the film, so that no other may answer."""
        return self.film is not None

    @property
    def _supply_keys(self) -> list[str]:
        given = {
            "supply_flow": self.supply_flow is not None,
            "cavitation_pressure": self.cavitation_pressure != 0.0,
            "submerged": self.submerged,
        }
        return [name for name, there in given.items() if there]

    def bearing(self) -> JournalBearing:
        """Return the bearing, with its film law where the file names one; InputError for a bad value."""
        named = self.named_film
        if named is not None and self._supply_keys:
            raise InputError(
                f'{self._supply_keys[0]} is only for film = {{name = "jfo"}} or where film is not given, '
                f"got film {journal.film_name(named)}"
            )
        openings = (*self.grooves, *self.feed_holes)
        return reading.made_from(
            JournalBearing, self, film=named, grooves=openings, turbulence=effect_of(self)
        )

    @cached_property
    def _built(self) -> JournalBearing | JFOFilm | HeldTilt:
        """The bearing, its film that conserves the oil, or its tilted journal."""
        if self.tilt is not None:
            return HeldTilt(journal=feeling_tilt(self.bearing(), named=self.film is not None), tilt=self.tilt)
        return super()._built

    def repeated_inputs(self, bearing: JournalBearing | JFOFilm | HeldTilt) -> tuple[BearingData, str]:
        """Return what an answer repeats of the bearing, and the name of its film."""
        if isinstance(bearing, HeldTilt):
            inner = bearing.journal.bearing
            name = journal.film_name(inner.fitted_film)
            return bearing_data(inner), f"{name}, tilt at level {bearing.journal.level.value}"
        if isinstance(bearing, JFOFilm):
            return bearing_data(bearing.bearing), film_of_cells(bearing)
        return bearing_data(bearing), journal.film_name(bearing.fitted_film)

    def remarks(
        self,
        bearing: JournalBearing | JFOFilm | HeldTilt,
        oil: Lubricant,
        speed: float,
        load: tuple[float, float],
        at: Equilibrium | None = None,
    ) -> tuple[str, ...]:
        """Return what its physics leaves out and should not; see `film_remarks`."""
        if isinstance(bearing, HeldTilt):
            return film_remarks(bearing.journal.bearing, oil, speed, load)
        turbulent = turbulent_remarks(without_oil(bearing), speed, load)
        return (*turbulent, *film_remarks(bearing, oil, speed, load, at))

    def make_map(self, report: Report) -> None:
        """Make the map of openings, where there are some and the film is one, unless it lies on disk."""
        if not (self.grooves or self.pads):
            return
        bearing = self.build()
        if not isinstance(bearing, JournalBearing):
            return
        if isinstance(bearing.fitted_film, journal.GroovedMapFilm):
            journal.build_groove_map(bearing, report)


def feeling_tilt(bearing: JournalBearing, *, named: bool) -> MomentCarryingJournal:
    """Return a bearing at the closest level of tilt that its film has.

    A film that is not `named` is on a grid over the whole length.
    """
    if not named:
        bearing = replace(bearing, film=ExtrapolatedFilm(film=ReynoldsFilm()))
    grid = isinstance(bearing.film, ExtrapolatedFilm | ReynoldsFilm)
    level = TiltLevel.FULL if grid else TiltLevel.SECOND_ORDER
    return MomentCarryingJournal(bearing=bearing, level=level)


# What the physics of every rung leaves out, judged by dimensionless numbers.


COARSE = (48, 4)
"""Cells of a film whose loss and flow tell how far the oil warms where its own would take long."""


CONSERVED = (48, 4)
"""The same of a film that conserves its oil."""


CONCENTRIC = 1e-3
"""Eccentricity ratio below which nothing to speak of flows out of a film."""

SLIGHT = 0.1
"""Eccentricity ratio below which the oil that leaves is too little to take all heat along."""


SMOOTH = 1e-7
"""Least film [m] that separates the finest surfaces of bearings."""

SMALL = 0.01
"""Radius [m] of a journal, up to which films of a few micrometers are usual."""


def journal_numbers(
    bearing: JournalBearing,
    oil: Lubricant,
    speed: float,
    load: tuple[float, float],
    film: Any = None,
    at: Equilibrium | None = None,
) -> dict[str, float]:
    """Return the dimensionless numbers of a bearing at a speed [rad/s] and a load [N].

    Loss and flow are those of a film, or if None is given of a quick one of the bearing; `at` is its
    equilibrium where that is known.

    Returns
    -------
    dict of str to float
        reynolds : speed R c/nu; taylor : that times sqrt(c/R). Laminar below `TURBULENT` and `TAYLOR`.
        turbulence : how much stiffer it makes the film, about; 0 of a laminar one.
        inertia : speed c^2/nu, inertia of the film over its viscous stress.
        peclet : speed c^2/diffusivity, heat carried along over heat conducted across the film.
        power [W] : loss in the film, at rest and at the viscosity of the bearing; not-a-number, as side_flow,
        warming and thinning are, where the coarse film has no answer; `unknown` is 1 then, else 0.
        side_flow [m3/s] : oil that leaves at both ends.
        least_film [m] : at rest, with the axes of journal and bearing parallel.
        rough_film [m] : the same where it separates the finest surfaces, of a journal that is not `SMALL`.
        mean_pressure [MPa] : load over length and diameter.
        warming [K] : rise of temperature, of the oil that leaves (Peclet number above 1) or between cold
        walls; thinning : relative loss of viscosity by that.
        pressure : mean pressure of the load over the ambient one: how much the rupture pressure matters.
        compression : mean pressure of the load over the bulk modulus.
        tilt [mrad] : of the journal, that closes even a centered film.

    Notes
    -----
    The oil that leaves carries the power that the film takes, both of an isothermal film under the load.
    Between cold walls, and where nothing flows, the middle of the film is warmer by viscosity U^2/(8
    conductivity). Between an eccentricity ratio of `SLIGHT` and the center one passes into the other with the
    square of the ratio, since power/flow grows as its inverse.
    """
    R, c, mu, omega = bearing.radius, bearing.clearance, bearing.film_viscosity, abs(speed)
    volumetric = oil.density * oil.heat_capacity
    numbers = film_numbers((R, bearing.length, c, mu), oil, speed, load)
    peclet = numbers["peclet"]
    power, flow, eccentricity_ratio = film_loss(bearing, speed, load, film, at)
    conducted = mu * (omega * R) ** 2 / (8.0 * oil.conductivity)
    carried = power / (volumetric * flow) if flow else conducted
    share = min(eccentricity_ratio / SLIGHT, 1.0) ** 2
    warming = min(carried, conducted + share * (carried - conducted))
    if peclet <= 1.0:
        warming = min(warming, conducted)
    least = c * (1.0 - eccentricity_ratio)
    return {
        **numbers,
        "power": power,
        "side_flow": flow,
        "least_film": least,
        "rough_film": least if least >= SMOOTH and R > SMALL else math.nan,
        "warming": warming,
        "unknown": float(math.isnan(warming)),
        # A bearing that is given its oil is answered as warm as it gets.
        "thinning": 0.0 if bearing.oil is not None else -math.expm1(-oil.thinning * warming),
    }


def film_loss(
    bearing: JournalBearing,
    speed: float,
    load: tuple[float, float],
    film: Any = None,
    at: Equilibrium | None = None,
) -> tuple[float, float, float]:
    """Return power [W], side flow [m3/s] and eccentricity ratio of an isothermal film.

    The equilibrium `at` is taken if it is that of the film. If no film is given it is that of the bearing
    where that is quick: a map of the package, or the short film; else a coarse grid. Not-a-number, all three,
    where that film has no answer under the load.
    """
    R, L, c = bearing.radius, bearing.length, bearing.clearance
    concentric = 2.0 * math.pi * bearing.film_viscosity * speed**2 * R**3 * L / c, 0.0, 0.0
    if not speed or not any(load):
        return concentric
    with warnings.catch_warnings(action="ignore", category=ValidityWarning):
        try:
            film = film or _quick(bearing)
            if at is None or vars(at)["_reaction"] is not film:
                at = equilibrium(film, load, speed)
            losses = at.losses
        except RotorfilmError:
            return math.nan, math.nan, math.nan
    if at.eccentricity_ratio < CONCENTRIC or losses is None:
        return concentric
    return float(losses.power_loss), float(losses.side_flow), at.eccentricity_ratio


def _quick(bearing: JournalBearing) -> JournalBearing:
    """Return the bearing with its own film, or with one on a coarse grid."""
    film = bearing.film
    if isinstance(film, ShortFilm) or (isinstance(film, MapFilm) and has_map(bearing)):
        return bearing
    coarse = replace(film if isinstance(film, ReynoldsFilm) else ReynoldsFilm(), cells=COARSE)
    return replace(bearing, film=coarse)


def film_remarks(
    bearing: JournalBearing | JFOFilm,
    oil: Lubricant,
    speed: float,
    load: tuple[float, float],
    at: Equilibrium | None = None,
) -> tuple[str, ...]:
    """Return the neglected effects that matter, one line each, at a speed [rad/s] and a load [N].

    Of a bearing whose oil warms it is said of the film at its temperature, and heat is not left out.
    """
    remarks = remarks_of("hot", "journal", "thin_film")
    film: Any = replace(bearing, cells=CONSERVED) if isinstance(bearing, JFOFilm) else None
    own: Any = bearing if film is None else film.bearing
    if own.is_warming:
        remarks = isothermal(remarks)
        own = warmed(own, load, speed, film or _quick(own))
        film = film and film.at_temperature(own.temperature)
    numbers = journal_numbers(own, oil, speed, load, film, at)
    if own.turbulence is not None:
        numbers["turbulence"] = 0.0
    return messages(remarks, numbers)


# What an answer repeats of the question: the bearing in SI, and the film law that answered.


@dataclass(frozen=True, kw_only=True)
class BearingData(Readable):
    """A journal bearing as it was understood.

    Attributes
    ----------
    radius, length, clearance : float [m]
    slenderness : float [1]
        Length / diameter of the film.
    viscosity : float [Pa s]
        Viscosity of the film, or of fresh oil where the temperature follows from the balance of its heat.
    pads : tuple of Pad
        Empty for the full circumference; angles in the bearing frame [rad].
    grooves : tuple of Groove or FeedHole
        Angles in the bearing frame [rad].
    supply_pressure : float [Pa]
        Gauge pressure in grooves and holes.
    circumferential_groove : float or None [m]
        Axial width of a groove all round; None for none.
    """

    radius: float
    length: float
    slenderness: float
    clearance: float
    viscosity: float
    pads: tuple[geometry.Pad, ...]
    grooves: tuple[geometry.Groove | geometry.FeedHole, ...]
    supply_pressure: float
    circumferential_groove: float | None = None


def bearing_data(bearing: JournalBearing) -> BearingData:
    """Return what a journal bearing is, without its film."""
    viscosity = bearing.film_viscosity
    return reading.made_from(BearingData, bearing, slenderness=bearing.slenderness, viscosity=viscosity)
