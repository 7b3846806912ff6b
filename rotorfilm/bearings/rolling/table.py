"""`[ball_bearing]` of a scene: a ball bearing by its dimensions, or a pair of them."""

from __future__ import annotations

import math
import warnings
from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import Annotated, Any, NamedTuple, Self

import numpy as np

from ...analysis import equilibrium
from ...core.errors import InputError, RotorfilmError, ValidityWarning, require_given, require_positive
from ...core.model import Array
from ...core.progress import Report
from ...core.readable import Readable
from ...scenes import reading
from ...scenes.families import messages, remarks_of
from ...scenes.shared_tables import Lubricant, LubricantTable
from .. import rolling

ANGLES = "two angles, about x and about y"
MOST_BALLS = 200
"""Balls of a row: thin slewing rings have about so many."""

ARRANGEMENTS: dict[str, Callable[..., rolling.BearingPair]] = {
    "back_to_back": rolling.back_to_back,
    "face_to_face": rolling.face_to_face,
    "tandem": lambda bearing, distance, **_: rolling.BearingPair(
        bearing=bearing, distance=distance, directions=(1, 1)
    ),
}
"""Pairs, by the name in scene files."""

MATERIALS = {
    "steel": rolling.RollingMaterial.steel,
    "silicon_nitride": rolling.RollingMaterial.silicon_nitride,
}
OWN_MATERIAL = reading.Keyed(
    rolling.RollingMaterial,
    {
        "young_modulus": reading.Quantity("Pa"),
        "poisson_ratio": reading.Quantity("1"),
        "density": reading.Quantity("kg/m3"),
    },
)
INERTIAS = {
    "static": rolling.StaticBalls,
    "running": rolling.RunningBalls,
    "race_control": rolling.RaceControl,
}
BALL_LAWS = {
    "traction_coefficient": rolling.RunningBalls,
    "slide_to_roll_ratio": rolling.RunningBalls,
    "outer_control": rolling.RaceControl,
}
"""Which law a number of the table belongs to."""


@reading.takes(MATERIALS, reading.Table(OWN_MATERIAL))
def read_material(where: str, value: Any) -> rolling.RollingMaterial:
    """Read the name of a material, or its properties."""
    if isinstance(value, str):
        return reading.named(MATERIALS)(where, value)
    return reading.Table(OWN_MATERIAL)(where, value)


@dataclass(frozen=True, kw_only=True)
@reading.fields_of(rolling.RunningBalls, rolling.RaceControl, optional=True)
@reading.fields_of(rolling.BallBearing, without=("films", "law", "waviness"))
class BallTable(reading.Taking):
    """`[ball_bearing]`: a deep groove or angular contact ball bearing, or a pair of angular contact bearings.

    Parameters
    ----------
    balls : int
        Number of balls of a row.
    internal_clearance : float or None [m]
        Radial internal clearance of a deep groove bearing; give this or the contact angle.
    contact_angle : float or None [rad]
        Contact angle of the unloaded balls of an angular contact bearing.
    ball_material : RollingMaterial
        Of the balls: "steel", "silicon_nitride", or a table of young_modulus, poisson_ratio and density;
        steel unless given.
    ring_material : RollingMaterial
        Of the rings, likewise.
    growth : float [m]
        Radial growth of the inner ring.
    axial_displacement : float [m]
        z of the shaft, where there is no axial load.
    axial_load : float or None [N]
        External force along z, to which z gives way.
    tilt : (float, float) [rad]
        Tilt of the shaft about x and y, held.
    cage_angle : float [rad]
        Where the first ball is.
    damping : float [N s/m]
        Beside the balls.
    arrangement : str or None
        Arrangement of a pair: "back_to_back", "face_to_face", "tandem"; None for one bearing.
    distance : float or None [m]
        Distance of the rows of a pair.
    preload : float or None [N]
        Preload of a pair, as clamped at rest, dry and without growth.
    inertia : StaticBalls or RunningBalls or RaceControl or None
        "static" balls, "running" ones that friction holds, or "race_control"; if the file does not say,
        running ones, or what a question needs.
    traction_coefficient : float or None [1]
        Traction coefficient of running balls; None for 0.06.
    slide_to_roll_ratio : float or None [1]
        Slide-to-roll ratio of running balls; None for 0.005.
    outer_control : bool or None
        Whether balls under race control spin on the inner race only; None for true.
    viscosity : float or None [Pa s]
        Viscosity of the oil on the races; None without oil, or where `[lubricant]` gives it.
    pressure_coefficient : float or None [1/Pa]
        Pressure coefficient of that viscosity.
    roughness : float or None [m]
        Roughness of ball and race together, for the film parameter.
    """

    balls: Annotated[int, reading.Count(MOST_BALLS, 3)]
    ball_material: Annotated[rolling.RollingMaterial, read_material]
    ring_material: Annotated[rolling.RollingMaterial, read_material]
    tilt: Annotated[tuple[float, float], reading.Several(reading.Quantity("rad"), 2, 2, ANGLES)]
    arrangement: Annotated[str | None, reading.one_of(ARRANGEMENTS)] = None
    distance: float | None = None
    preload: float | None = None
    inertia: Annotated[
        rolling.StaticBalls | rolling.RunningBalls | rolling.RaceControl | None, reading.named(INERTIAS)
    ] = None
    viscosity: float | None = None
    pressure_coefficient: float | None = None
    roughness: float | None = None

    def __post_init__(self) -> None:
        require_given(self, require_positive, "viscosity", "pressure_coefficient", "roughness")
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

    def _law(self) -> rolling.StaticBalls | rolling.RunningBalls | rolling.RaceControl:
        """Return the law of the balls with the numbers that the file gives."""
        law = self.inertia or rolling.RunningBalls()
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
            return reading.made_from(rolling.BallBearing, self, law=law)
        alone = {"axial_displacement": 0.0, "axial_load": None, "tilt": (0.0, 0.0), "damping": 0.0}
        one = reading.made_from(rolling.BallBearing, self, law=law, **alone)
        if self.arrangement == "tandem" and self.preload is not None:
            raise InputError(f"preload must not be given in tandem, got {self.preload!r}")
        pair = ARRANGEMENTS[self.arrangement](one, distance=self.distance, preload=self.preload)
        return replace(pair, **place)

    def repeated_inputs(self, bearing: Balls) -> tuple[Readable, str]:
        """Return what an answer repeats of the bearing, and the name of the law of its balls."""
        name = law_name(bearing)
        if isinstance(bearing, rolling.BearingPair):
            return reading.made_from(
                PairData, self, arrangement=self.arrangement or "", preload=self.preload
            ), name
        return reading.made_from(BallData, self), name

    def remarks(
        self, bearing: Balls, oil: Lubricant, speed: float, load: tuple[float, float], at: Any = None
    ) -> tuple[str, ...]:
        """Return what its physics leaves out and should not."""
        return ball_remarks(bearing, speed, load, self.oil, self.roughness)

    def make_map(self, report: Report) -> None:
        """Do nothing: ball bearings have no map."""


LAW_NAMES = {
    rolling.StaticBalls: "static balls",
    rolling.RunningBalls: "running balls",
    rolling.RaceControl: "running balls under race control",
}


def law_name(bearing: Balls) -> str:
    """Return what the law of the balls is called in print."""
    single = single_of(bearing)
    name = next(called for law, called in LAW_NAMES.items() if isinstance(single.law, law))
    return f"{name} on films" if any(single.films) else name


# What answers repeat of ball bearings.


NOT_REPEATED = ("ball_material", "ring_material", "axial_displacement", "tilt", "cage_angle", "damping")


@dataclass(frozen=True, kw_only=True)
@reading.fields_of(rolling.BallBearing, without=("films", "law", "waviness", *NOT_REPEATED))
class BallData(Readable):
    """A ball bearing as it was understood."""


@dataclass(frozen=True, kw_only=True)
class PairData(BallData):
    """A pair of ball bearings as it was understood.

    Attributes
    ----------
    arrangement : str
    distance : float [m]
        Distance of the rows.
    preload : float or None [N]
        Preload as clamped.
    """

    arrangement: str
    distance: float
    preload: float | None


# A shaft at rest in ball bearings: where it is, what each ball carries, and what follows from that.


Balls = rolling.BallBearing | rolling.BearingPair

STEPS, EXACT = 3, 1e-9
"""Newton steps by which a richer law moves a rest, and the share of the load that may be left of it."""


class RaceOil(NamedTuple):
    """The oil on the races.

    Attributes
    ----------
    viscosity : float [Pa s]
        Viscosity at ambient pressure and the temperature of the races.
    pressure_coefficient : float [1/Pa]
    """

    viscosity: float
    pressure_coefficient: float


@dataclass(frozen=True, kw_only=True)
class BallEquilibriumCase:
    """A shaft at rest, or nearly so, in a bearing.

    Attributes
    ----------
    bearing : BallBearing or BearingPair
    position : ndarray, shape (2,) [m]
    displacement : ndarray, shape (5,) [m]
        x, y, z [m], tilt_x, tilt_y [rad].
    speed : float [rad/s]
    force : ndarray, shape (2,) [N]
        Force on the shaft.
    stiffness : ndarray, shape (2, 2) [N/m]
        Stiffness over x and y; z gives way where there is an axial load.
    axial_stiffness : float [N/m]
        Axial stiffness over z, with x, y and tilts held.
    balls : BallLoads
    """

    bearing: Balls
    position: Array
    displacement: Array
    speed: float
    force: Array
    stiffness: Array
    axial_stiffness: float
    balls: rolling.BallLoads

    @property
    def most_loaded(self) -> int:
        """Which ball presses most on the inner ring."""
        return int(np.argmax(self.balls.inner_load))

    @property
    def contact_load(self) -> float:
        """Largest load of a contact [N]."""
        return float(max(self.balls.inner_load.max(), self.balls.outer_load.max()))

    @property
    def contact_angle(self) -> float:
        """Inner contact angle of the most loaded ball [rad]."""
        return float(self.balls.inner_angle[self.most_loaded])

    @property
    def relative_film(self) -> float:
        """Both films over the approach of both contacts, at the mean load of the balls that carry [1]."""
        single = single_of(self.bearing)
        carrying = self.balls.inner_load > 0.0
        means = [float(loads[carrying].mean()) for loads in (self.balls.inner_load, self.balls.outer_load)]
        approach = sum(one.approach(load) for one, load in zip(single.contacts, means, strict=True))
        return sum(single.films) / approach

    def film_parameter(self, oil: RaceOil | None, roughness: float | None) -> float:
        """Return lambda [1], the smallest film over the roughness [m]; nan where one is not known."""
        if oil is None or roughness is None or self.speed == 0.0:
            return math.nan
        return rolling.film_parameter(
            single_of(self.bearing), self.balls, speed=self.speed, **oil._asdict(), roughness=roughness
        )


def single_of(bearing: Balls) -> rolling.BallBearing:
    """Return a bearing itself, or one of a pair."""
    return bearing.bearing if isinstance(bearing, rolling.BearingPair) else bearing


def with_single(bearing: Balls, **changes: Any) -> Balls:
    """Return a bearing, or a pair, whose single bearing is changed."""
    single = replace(single_of(bearing), **changes)
    return replace(bearing, bearing=single) if isinstance(bearing, rolling.BearingPair) else single


def with_law(bearing: Balls, law: rolling.StaticBalls | rolling.RunningBalls | rolling.RaceControl) -> Balls:
    """Return a bearing with another law of its balls."""
    return with_single(bearing, law=law)


def rest_at(bearing: Balls, position: Array, speed: float) -> BallEquilibriumCase:
    """Return what the balls of a shaft at a position (2,) [m] do, z and tilts as the bearing says."""
    x, y = position.tolist()
    tangent = bearing.prepare_tangent()
    *force, slopes = tangent(x, y, 0.0, 0.0, speed)
    displacement = np.array([x, y, bearing.axial_place(position, speed), *bearing.tilt])
    return BallEquilibriumCase(
        bearing=bearing,
        position=position,
        displacement=displacement,
        speed=speed,
        force=np.array(force),
        stiffness=-np.array(slopes).reshape(2, 5)[:, :2],
        axial_stiffness=float(bearing.stiffness(displacement, speed)[2, 2]),
        balls=bearing.loads(displacement, speed),
    )


def rest_under(bearing: Balls, load: tuple[float, float], speed: float) -> BallEquilibriumCase:
    """Return the equilibrium under a load [N], sought from that of static balls, or without one the center.

    Raises
    ------
    InputError
        If there is no load, and thrust or preload do not center the shaft.
    """
    free = not any(load)
    try:
        still = with_law(bearing, rolling.StaticBalls())
        place = np.zeros(2) if free else equilibrium(still, load, speed).position
        near = rest_at(still, place, speed)
        found, left = moved_to(bearing, near, load)
    except RotorfilmError:
        left = math.inf
    if free and not left <= EXACT:
        raise InputError(
            "load must not be zero for balls that neither thrust nor preload centers, got [0, 0]"
        )
    return found if left <= EXACT else rest_at(bearing, equilibrium(bearing, load, speed).position, speed)


def moved_to(
    bearing: Balls, near: BallEquilibriumCase, load: tuple[float, float]
) -> tuple[BallEquilibriumCase, float]:
    """Return where a richer law takes a rest, by Newton steps, and what of the load is left [1].

    Without a load, what is left over the largest load of a contact.
    """
    at = rest_at(bearing, near.position, near.speed)
    for _ in range(STEPS):
        step = np.linalg.lstsq(at.stiffness, at.force + load, rcond=1e-9)[0]
        at = rest_at(bearing, at.position + step, near.speed)
    size = np.hypot(*load) if any(load) else at.contact_load
    return at, float(np.hypot(*(at.force + load)) / size) if size > 0.0 else math.inf


def rest_near(bearing: Balls, near: BallEquilibriumCase, load: tuple[float, float]) -> BallEquilibriumCase:
    """Return the equilibrium of another law, sought first from that of one near it."""
    at, left = moved_to(bearing, near, load)
    return at if left <= EXACT else rest_under(bearing, load, near.speed)


def on_films(near: BallEquilibriumCase, oil: RaceOil) -> Balls:
    """Return the bearing of a rest with the oil films of its most loaded ball in all contacts."""
    load = float(near.balls.inner_load.max())
    films = rolling.ball_films(single_of(near.bearing), load=load, speed=near.speed, **oil._asdict())
    return with_single(near.bearing, films=films)


# What the physics of ball bearings leaves out, judged by numbers of a rest.


APART, TOUCHING = 3.0, 1.0
"""Film parameters above which the surfaces are apart, and below which they touch."""


def ball_numbers(rest: BallEquilibriumCase, oil: RaceOil | None, roughness: float | None) -> dict[str, float]:
    """Return the numbers of a rest that decide on remarks.

    Parameters
    ----------
    rest : BallEquilibriumCase
    oil : RaceOil or None
    roughness : float or None [m]

    Returns
    -------
    dict of str to float
        traction : traction coefficient that the gyroscopic moment asks for.
        most_traction : that beyond which balls slide; sliding : the first over it.
        lifted : balls that the rings do not press although thrust or preload should; all : all balls.
        idle_rows : rows of a preloaded pair whose balls are not pressed.
        neglected_inertia : centrifugal force over the largest contact load of static balls; else 0.
        film_parameter : lambda, nan without oil and roughness.
    """
    balls, bearing = rest.balls, rest.bearing
    idle, is_pair = _idle(rest), isinstance(bearing, rolling.BearingPair)
    traction, most = float(balls.traction.max()), bearing.running[0].most_traction
    return {
        "traction": traction,
        "most_traction": most,
        "sliding": traction / most,
        "lifted": float(idle.sum()),
        "all": float(idle.size),
        "idle_rows": float(sum(row.all() for row in np.split(idle, 2))) if is_pair else 0.0,
        "neglected_inertia": _neglected(bearing, rest),
        "film_parameter": rest.film_parameter(oil, roughness),
    }


def ball_remarks(
    bearing: Balls, speed: float, load: tuple[float, float], oil: RaceOil | None, roughness: float | None
) -> tuple[str, ...]:
    """Return the neglected effects that matter, one line each; that there is no rest where there is none."""
    with warnings.catch_warnings(action="ignore", category=ValidityWarning):
        try:
            rest = rest_under(bearing, load, speed)
        except RotorfilmError as error:
            return (f"rest: none found, {error}",)
        return messages(remarks_of("ball_bearing"), ball_numbers(rest, oil, roughness))


def _idle(rest: BallEquilibriumCase) -> Array:
    """Return which balls the rings do not press, where thrust or preload should press all, shape (balls,)."""
    bearing = rest.bearing
    preloaded = isinstance(bearing, rolling.BearingPair) and bearing.approach > 0.0
    if not (preloaded or (single_of(bearing).separates and bearing.axial_load is not None)):
        return np.zeros(rest.balls.inner_load.size, dtype=bool)
    pressed = with_law(bearing, rolling.StaticBalls()).loads(rest.displacement).inner_load
    return np.asarray(np.minimum(pressed, rest.balls.inner_load) == 0.0)


def _neglected(bearing: Balls, rest: BallEquilibriumCase) -> float:
    """Return the centrifugal force that static balls do not have, over the largest contact load."""
    if not isinstance(single_of(bearing).law, rolling.StaticBalls):
        return 0.0
    running = with_law(bearing, rolling.RunningBalls())
    centrifugal = running.loads(rest.displacement, rest.speed).centrifugal_force.max()
    return float(centrifugal / rest.contact_load)
