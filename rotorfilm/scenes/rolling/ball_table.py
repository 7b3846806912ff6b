"""`[ball_bearing]` of a scene: a ball bearing by its dimensions, or a pair of them."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field, replace
from typing import Annotated, Any, Self

from ...bearings.rolling import (
    BallBearing,
    BearingPair,
    RaceControl,
    RollingMaterial,
    RunningBalls,
    StaticBalls,
    back_to_back,
    face_to_face,
)
from ...errors import InputError, SceneError, brief, require_positive
from ...progress import Report
from ...readable.result import Readable
from ..lubricant_table import Lubricant, LubricantTable
from ..reading.readers import Count, Named, one_of, takes
from ..reading.shared_fields import made_from
from ..reading.tables import Keyed, Quantity, Table, flag
from .ball_data import BallData, PairData
from .ball_remarks import ball_remarks
from .ball_rest import Balls, RaceOil, single_of

MOST_BALLS = 200
"""Balls of a row: thin slewing rings have about so many."""

ARRANGEMENTS: dict[str, Callable[..., BearingPair]] = {
    "back_to_back": back_to_back,
    "face_to_face": face_to_face,
    "tandem": lambda bearing, distance, **_: BearingPair(
        bearing=bearing, distance=distance, directions=(1, 1)
    ),
}
"""Pairs, by the name in scene files."""

MATERIALS = {"steel": RollingMaterial.steel, "silicon_nitride": RollingMaterial.silicon_nitride}
OWN_MATERIAL = Keyed(
    RollingMaterial,
    {"young_modulus": Quantity("Pa"), "poisson_ratio": Quantity("1"), "density": Quantity("kg/m3")},
)
INERTIAS = {"static": StaticBalls, "running": RunningBalls, "race_control": RaceControl}
BALL_LAWS = {
    "traction_coefficient": RunningBalls,
    "slide_to_roll_ratio": RunningBalls,
    "outer_control": RaceControl,
}
"""Which law a number of the table belongs to."""


@takes(Named(MATERIALS), Table(OWN_MATERIAL))
def read_material(where: str, value: Any) -> RollingMaterial:
    """Read the name of a material, or its properties."""
    if isinstance(value, str):
        return Named(MATERIALS)(where, value)
    return Table(OWN_MATERIAL)(where, value)


@takes([Quantity("rad"), Quantity("rad")])
def read_tilt(where: str, value: Any) -> tuple[float, float]:
    """Read two angles."""
    if not isinstance(value, list) or len(value) != 2:
        raise SceneError(f"{where} must be two angles, about x and about y, got {brief(value)}")
    about_x, about_y = (Quantity("rad")(f"{where}[{k}]", one) for k, one in enumerate(value))
    return about_x, about_y


@dataclass(frozen=True, kw_only=True)
class BallTable:
    """`[ball_bearing]`: a deep groove or angular contact ball bearing, or a pair of angular contact bearings.

    Parameters
    ----------
    balls : int
        Number of balls of a row.
    ball_diameter, pitch_diameter : float [m]
    internal_clearance : float or None [m]
        Radial internal clearance of a deep groove bearing; give this or the contact angle.
    contact_angle : float or None [rad]
        Of the unloaded balls of an angular contact bearing.
    inner_conformity, outer_conformity : float [1]
        Groove radius over ball diameter.
    ball_material, ring_material : RollingMaterial
        "steel", "silicon_nitride", or a table of young_modulus, poisson_ratio and density.
    growth : float [m]
        Radial growth of the inner ring.
    axial_displacement : float [m]
        z of the shaft, where there is no axial load.
    axial_load : float or None [N]
        External force along z, to which z gives way.
    tilt : (float, float) [rad]
        Of the shaft about x and y, held.
    cage_angle : float [rad]
        Where the first ball is.
    damping : float [N s/m]
        Beside the balls.
    arrangement : str or None
        Of a pair: "back_to_back", "face_to_face", "tandem"; None for one bearing.
    distance : float or None [m]
        Of the rows of a pair.
    preload : float or None [N]
        Of a pair, as clamped at rest, dry and without growth.
    inertia : StaticBalls or RunningBalls or RaceControl or None
        "static" balls, "running" ones that friction holds, or "race_control"; if the file does not say,
        running ones, or what a question needs.
    traction_coefficient, slide_to_roll_ratio : float or None [1]
        Of running balls; None for 0.06 and 0.005.
    outer_control : bool or None
        Whether balls under race control spin on the inner race only; None for true.
    viscosity : float or None [Pa s]
        Of the oil on the races; None without oil, or where `[lubricant]` gives it.
    pressure_coefficient : float or None [1/Pa]
        Of that viscosity.
    roughness : float or None [m]
        Of ball and race together, for the film parameter.
    """

    balls: Annotated[int, Count(MOST_BALLS, 3)]
    ball_diameter: Annotated[float, Quantity("m")]
    pitch_diameter: Annotated[float, Quantity("m")]
    internal_clearance: Annotated[float | None, Quantity("m")] = None
    contact_angle: Annotated[float | None, Quantity("rad")] = None
    inner_conformity: Annotated[float, Quantity("1")] = BallBearing.inner_conformity
    outer_conformity: Annotated[float, Quantity("1")] = BallBearing.outer_conformity
    ball_material: Annotated[RollingMaterial, read_material] = field(default_factory=RollingMaterial.steel)
    ring_material: Annotated[RollingMaterial, read_material] = field(default_factory=RollingMaterial.steel)
    growth: Annotated[float, Quantity("m")] = 0.0
    axial_displacement: Annotated[float, Quantity("m")] = 0.0
    axial_load: Annotated[float | None, Quantity("N")] = None
    tilt: Annotated[tuple[float, float], read_tilt] = (0.0, 0.0)
    cage_angle: Annotated[float, Quantity("rad")] = 0.0
    damping: Annotated[float, Quantity("N.s/m")] = 0.0
    arrangement: Annotated[str | None, one_of(ARRANGEMENTS)] = None
    distance: Annotated[float | None, Quantity("m")] = None
    preload: Annotated[float | None, Quantity("N")] = None
    inertia: Annotated[StaticBalls | RunningBalls | RaceControl | None, Named(INERTIAS)] = None
    traction_coefficient: Annotated[float | None, Quantity("1")] = None
    slide_to_roll_ratio: Annotated[float | None, Quantity("1")] = None
    outer_control: Annotated[bool | None, flag] = None
    viscosity: Annotated[float | None, Quantity("Pa.s")] = None
    pressure_coefficient: Annotated[float | None, Quantity("1/Pa")] = None
    roughness: Annotated[float | None, Quantity("m")] = None

    def __post_init__(self) -> None:
        for name in ("viscosity", "pressure_coefficient", "roughness"):
            if getattr(self, name) is not None:
                require_positive(name, getattr(self, name))
        if self.viscosity is not None and self.pressure_coefficient is None:
            raise InputError("pressure_coefficient must be given with a viscosity, got None")
        if self.arrangement is None:
            for name in ("distance", "preload"):
                if getattr(self, name) is not None:
                    raise InputError(f"{name} must be given with an arrangement, got {getattr(self, name)!r}")
        elif self.distance is None:
            raise InputError("distance must be given with an arrangement, got None")
        self.build()

    @property
    def film_is_given(self) -> bool:
        """Whether the file names the inertia of the balls, so that no other law may answer."""
        return self.inertia is not None

    @property
    def oil(self) -> RaceOil | None:
        """The oil on the races; None without."""
        if self.viscosity is None or self.pressure_coefficient is None:
            return None
        return RaceOil(self.viscosity, self.pressure_coefficient)

    def on(self, where: str, lubricant: LubricantTable) -> Self:
        """Return this table with the viscosity of the scene's fresh oil, unless it has its own.

        Parameters
        ----------
        where : str
            Its name in the file, for messages.
        lubricant : LubricantTable
        """
        if self.viscosity is not None or not lubricant.has_viscosity:
            return self
        if self.pressure_coefficient is None:
            raise InputError(f"{where}.pressure_coefficient is required where [lubricant] gives an oil")
        fresh = lubricant.cooling.supply_temperature
        return replace(self, viscosity=float(lubricant.oil.viscosity(fresh)))

    def _law(self) -> StaticBalls | RunningBalls | RaceControl:
        """Return the law of the balls with the numbers that the file gives."""
        law = self.inertia or RunningBalls()
        given = {name: getattr(self, name) for name in BALL_LAWS if getattr(self, name) is not None}
        for name, value in given.items():
            if not isinstance(law, BALL_LAWS[name]):
                called = next(one for one, kind in INERTIAS.items() if kind is BALL_LAWS[name])
                raise InputError(f"{name} must be given with inertia {called!r}, got {value!r}")
        return replace(law, **given)

    def build(self) -> Balls:
        """Return the bearing, its contacts dry; raise InputError where a value breaks its rule."""
        law = self._law()
        place = {
            name: getattr(self, name) for name in ("axial_displacement", "axial_load", "tilt", "damping")
        }
        if self.arrangement is None:
            return made_from(BallBearing, self, law=law)
        alone = {"axial_displacement": 0.0, "axial_load": None, "tilt": (0.0, 0.0), "damping": 0.0}
        one = made_from(BallBearing, self, law=law, **alone)
        if self.arrangement == "tandem" and self.preload is not None:
            raise InputError(f"preload must not be given in tandem, got {self.preload!r}")
        pair = ARRANGEMENTS[self.arrangement](one, distance=self.distance, preload=self.preload)
        return replace(pair, **place)

    def echo(self, bearing: Balls) -> tuple[Readable, str]:
        """Return what an answer repeats of the bearing, and the name of the law of its balls."""
        name = law_name(bearing)
        if isinstance(bearing, BearingPair):
            return made_from(PairData, self, arrangement=self.arrangement or "", preload=self.preload), name
        return made_from(BallData, self), name

    def remarks(
        self,
        bearing: Balls,
        oil: Lubricant,
        speed: float,
        load: tuple[float, float],
    ) -> tuple[str, ...]:
        """Return what its physics leaves out and should not."""
        return ball_remarks(bearing, speed, load, self.oil, self.roughness)

    def make_map(self, report: Report) -> None:
        """Do nothing: ball bearings have no map."""


LAW_NAMES = {
    StaticBalls: "static balls",
    RunningBalls: "running balls",
    RaceControl: "running balls under race control",
}


def law_name(bearing: Balls) -> str:
    """Return what the law of the balls is called in print."""
    single = single_of(bearing)
    name = next(called for law, called in LAW_NAMES.items() if isinstance(single.law, law))
    return f"{name} on films" if any(single.films) else name
