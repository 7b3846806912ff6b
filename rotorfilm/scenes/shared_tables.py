"""Tables that scenes of all families share: speed and load, oil, rotor, excitation, co-simulation."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Annotated, Any, Protocol, Self, runtime_checkable

from ..bearings.oil import Cooling, Oil
from ..bearings.oil.oil import BULK_MODULUS, COLDEST_OIL, HOTTEST_OIL, WALTHER_END, grade_number
from ..core.errors import (
    InputError,
    SceneError,
    brief,
    lacked,
    require_count,
    require_each,
    require_finite,
    require_given,
    require_non_negative,
    require_number,
    require_positive,
)
from ..core.limits import SEEDS, STEPS
from ..core.progress import Report
from ..core.readable import Readable
from ..core.results import Equilibrium
from ..core.units import CELSIUS
from ..rotors.profile import SpeedProfile
from ..rotors.rigid import RigidRotor
from . import reading

if TYPE_CHECKING:
    from ..rotors import BaseMotion, LinearMotor


SCHEMA = 1
"""The version that a scene file states as `schema = 1`."""


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

    speed: float
    load: Annotated[tuple[float, float] | None, reading.read_static_load] = None
    duration: float | None = None

    def __post_init__(self) -> None:
        require_finite("speed", self.speed)
        require_given(self, require_positive, "duration")
        require_given(self, require_finite, "load")


@dataclass(frozen=True, kw_only=True)
@reading.fields_of(RigidRotor, without=("speed", "gravity", "static_force", "position", "velocity"))
class RigidRotorTable(reading.Taking):
    """`[rigid_rotor]`: a rigid rotor in translation, the share that one bearing carries."""

    def __post_init__(self) -> None:
        self.build(speed=0.0, load=(0.0, 0.0))

    def build(self, speed: float, load: tuple[float, float]) -> RigidRotor:
        """Return the rotor under the whole static load [N], at a constant speed [rad/s]."""
        return reading.made_from(RigidRotor, self, speed=speed, gravity=(0.0, 0.0), static_force=load)


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

    macro_angle: float = math.radians(1.0)
    revolutions: float = 10.0

    def __post_init__(self) -> None:
        require_each(self, require_positive, "macro_angle", "revolutions")
        require_steps("revolutions / macro_angle", 2.0 * math.pi * self.revolutions, self)


def require_steps(name: str, angle: float, of: CosimulationTable) -> None:
    """Raise InputError where a run over an angle [rad] of the shaft has more exchanges than can be kept."""
    steps = angle / of.macro_angle
    if steps > STEPS:
        raise InputError(f"{name} must make at most {STEPS} steps of {of.macro_angle:g} rad, got {steps:.3g}")


# `[lubricant]`: the oil of a scene, what cools it, and properties for the checks of what films leave out.


WARM, HOT = 40.0 + CELSIUS, 100.0 + CELSIUS
"""Temperatures of `viscosity_40` and `viscosity_100` [K]."""


@reading.takes(reading.Count(9999), reading.text)
def read_grade(where: str, value: Any) -> int:
    """Read an ISO viscosity grade, as "ISO VG 46" or 46."""
    number = grade_number(value)
    if number is None or isinstance(value, float):
        raise SceneError(f"{where} must be an ISO viscosity grade such as 'ISO VG 46', got {brief(value)}")
    return number


@dataclass(frozen=True, kw_only=True)
class Lubricant:
    """Properties of an oil at one temperature.

    Parameters
    ----------
    density : float [kg/m3]
    heat_capacity : float [J/(kg K)]
        Heat capacity per mass.
    conductivity : float [W/(m K)]
    thinning : float [1/K]
        -d ln(viscosity)/d temperature.
    bulk_modulus : float [Pa]
        Pressure per relative change of volume.
    """

    density: float = 900.0
    heat_capacity: float = 2000.0
    conductivity: float = 0.15
    thinning: float = 0.04
    bulk_modulus: float = BULK_MODULUS


@dataclass(frozen=True, kw_only=True)
@reading.fields_of(Cooling, without=("full_gap",))
class LubricantTable(reading.Taking):
    """`[lubricant]`: an oil by its viscosity over temperature, what cools it, and further properties.

    Where it gives a viscosity and a bearing gives none, that bearing runs on this oil, in the balance of its
    heat. Otherwise the properties serve the checks of what the films leave out; what is not given is assumed,
    of the order of a mineral oil (`Lubricant`), and warnings that rest on it are no better.

    Parameters
    ----------
    grade : int or None
        ISO viscosity grade, as "ISO VG 46": the kinematic viscosity at 40 degC. That at 100 degC is assumed
        unless it is given.
    viscosity_40 : float or None [m2/s]
        Kinematic viscosity at 40 degC.
    viscosity_100 : float or None [m2/s]
        Kinematic viscosity at 100 degC.
    supply_temperature : float or None [K]
        Supply temperature of the fresh oil; required with a viscosity.
    density : float or None [kg/m3]
        Density at 15 degC, of an oil with a viscosity here.
    heat_capacity : float or None [J/(kg K)]
        Heat capacity per mass.
    conductivity : float or None [W/(m K)]
        Thermal conductivity of the oil.
    thinning : float or None [1/K]
        -d ln(viscosity)/d temperature; with `viscosity_40` alone the same at all temperatures.
    bulk_modulus : float [Pa]
        Pressure per relative change of volume.
    """

    grade: Annotated[int | None, read_grade] = None
    viscosity_40: float | None = None
    viscosity_100: float | None = None
    supply_temperature: float | None = None
    density: float | None = None
    heat_capacity: float | None = None
    conductivity: float | None = None
    thinning: float | None = None
    bulk_modulus: float = Lubricant.bulk_modulus

    def __post_init__(self) -> None:
        require_given(
            self, require_positive, "density", "heat_capacity", "conductivity", "thinning", "bulk_modulus"
        )
        require_non_negative("housing_conductance", self.housing_conductance)
        if not self.has_viscosity:
            return
        if self.grade is not None and self.viscosity_40 is not None:
            raise InputError(
                f"grade must not be given beside viscosity_40, which it is, got VG {self.grade} and "
                f"{self.viscosity_40!r}"
            )
        for name in ("viscosity_40", "viscosity_100"):
            value = getattr(self, name)
            if value is not None and value <= WALTHER_END:
                raise InputError(f"{name} must be above {WALTHER_END:g} m2/s, as of oil, got {value!r}")
        at = self.supply_temperature
        if at is not None and not COLDEST_OIL <= at <= HOTTEST_OIL:
            raise InputError(
                f"supply_temperature must be from {COLDEST_OIL:g} to {HOTTEST_OIL:g} K, as of oil, got {at!r}"
            )
        _ = self.oil, self.cooling

    @property
    def has_viscosity(self) -> bool:
        """Whether the table says how viscous the oil is."""
        return self.grade is not None or self.viscosity_40 is not None or self.viscosity_100 is not None

    @property
    def oil(self) -> Oil:
        """The oil; InputError where its viscosity over temperature is not given."""
        given: dict[str, Any] = {
            "reference_density": self.density,
            "fixed_heat_capacity": self.heat_capacity,
            "conductivity": self.conductivity,
        }
        further = {name: value for name, value in given.items() if value is not None}
        warm = self.viscosity_40 if self.grade is None else 1e-6 * self.grade
        if warm is not None and self.viscosity_100 is not None:
            return Oil.two_points((WARM, warm), (HOT, self.viscosity_100), **further)
        if self.grade is not None:
            return Oil.iso_vg(self.grade, **further)
        if warm is None or self.thinning is None:
            raise InputError(
                "viscosity_40 and viscosity_100 must be given, or viscosity_40 and thinning, or a grade, "
                f"got {self.viscosity_40!r}, {self.viscosity_100!r} and {self.thinning!r}"
            )
        density = float(Oil.constant(1.0, **further).density(WARM))
        return Oil.thinning_at(warm * density, WARM, self.thinning, **further)

    @property
    def cooling(self) -> Cooling:
        """What cools the oil; InputError where the supply temperature is not given."""
        if self.supply_temperature is None:
            raise InputError("supply_temperature must be given where the oil has a viscosity, got None")
        return reading.made_from(Cooling, self)

    @property
    def properties(self) -> Lubricant:
        """What the checks of left-out physics need: as given, of the fresh oil, or assumed."""
        known: dict[str, float] = {"bulk_modulus": self.bulk_modulus}
        if self.has_viscosity:
            oil, fresh = self.oil, self.cooling.supply_temperature
            known |= {
                "density": float(oil.density(fresh)),
                "heat_capacity": float(oil.heat_capacity(fresh)),
                "conductivity": oil.conductivity,
                "thinning": float(oil.thinning(fresh)),
            }
        names = ("density", "heat_capacity", "conductivity", "thinning")
        given = {name: getattr(self, name) for name in names if getattr(self, name) is not None}
        return Lubricant(**{**known, **given})


class OiledTable(reading.Taking):
    """The table of a bearing, a dataclass with `viscosity`, `oil` and `cooling`, on the oil of a scene."""

    not_keys = ("oil", "cooling", "temperature")

    @property
    def has_lubricant(self) -> bool:
        """Whether there is a viscosity, or the oil of the scene."""
        return self.viscosity is not None or self.oil is not None

    def on(self, where: str, lubricant: LubricantTable) -> Self:
        """Return this table with the oil of the scene, unless it has a viscosity or an oil.

        Parameters
        ----------
        where : str
            Its name in the file, for messages.
        lubricant : LubricantTable

        Raises
        ------
        InputError
            If neither gives a viscosity.
        """
        if self.has_lubricant:
            return self
        if not lubricant.has_viscosity:
            raise InputError(f"{where}.viscosity is required where [lubricant] gives no grade or viscosity")
        return replace(self, oil=lubricant.oil, cooling=lubricant.cooling)  # type: ignore[type-var]


# `[excitation]`: what shakes the scene besides its steady load, and what drives it.


@dataclass(frozen=True, kw_only=True)
class UnbalanceTable:
    """`[excitation] kind = "unbalance"`: an unbalance that turns with the rotor.

    Parameters
    ----------
    unbalance : float [kg m]
        Mass times eccentricity of its center.
    unbalance_angle : float [rad]
        Unbalance angle from +x at t = 0.
    node : int
        Node of a flexible rotor, where it sits; 0 for all others.
    """

    unbalance: float
    unbalance_angle: float = 0.0
    node: int = 0

    def __post_init__(self) -> None:
        require_non_negative("unbalance", self.unbalance)
        require_number("unbalance_angle", self.unbalance_angle)
        require_count("node", self.node, 0)

    def given_to(self, rotor: RigidRotor) -> RigidRotor:
        """Return a rigid rotor with this unbalance; raise InputError if it has one already."""
        if rotor.unbalance:
            raise InputError(
                "rigid_rotor.unbalance must be 0 where [excitation] has the unbalance, "
                f"got {rotor.unbalance:g} beside {self.unbalance:g} kg m"
            )
        return replace(rotor, unbalance=self.unbalance, unbalance_angle=self.unbalance_angle)


@dataclass(frozen=True, kw_only=True)
class BladeLossTable(UnbalanceTable):
    """`[excitation] kind = "blade_loss"`: an unbalance that is there from one moment on.

    Parameters
    ----------
    start : float [s]
        When it appears; until then the rotor rests in its equilibrium.
    revolutions : float [1]
        Turns of the shaft that are followed from then on.
    """

    start: float = 0.0
    revolutions: float = 10.0

    def __post_init__(self) -> None:
        super().__post_init__()
        require_non_negative("start", self.start)
        require_positive("revolutions", self.revolutions)


@dataclass(frozen=True, kw_only=True)
class RunUpTable(UnbalanceTable):
    """`[excitation] kind = "run_up"`: an unbalance while the speed changes steadily from `operation.speed`.

    Parameters
    ----------
    end_speed : float [rad/s]
        Last speed of the run-up.
    duration : float [s]
        Duration of the way there.
    back : bool
        Whether the speed returns in the same time.
    """

    end_speed: float
    duration: float
    back: bool = False

    def __post_init__(self) -> None:
        super().__post_init__()
        require_number("end_speed", self.end_speed)
        require_positive("duration", self.duration)

    def profile(self, speed: float) -> SpeedProfile:
        """Return the speed over time, from `speed` [rad/s] on."""
        returned = ((2.0 * self.duration, speed),) if self.back else ()
        times, speeds = zip((0.0, speed), (self.duration, self.end_speed), *returned, strict=True)
        return SpeedProfile(times=times, speeds=speeds)


@dataclass(frozen=True, kw_only=True)
class StepLoadTable:
    """`[excitation] kind = "step"`: a force beside the static load, between two moments.

    Parameters
    ----------
    load : (float, float) [N]
        In a file one magnitude, along -y, or `[x, y]`.
    start : float [s]
        When it jumps up.
    end : float [s]
        When it jumps back; never where a file gives none.
    """

    load: Annotated[tuple[float, float], reading.read_load]
    start: float = 0.0
    end: float = math.inf

    def __post_init__(self) -> None:
        require_non_negative("start", self.start)
        if not self.end > self.start:
            raise InputError(f"end must be after start, {self.start!r} s, got {self.end!r}")


@dataclass(frozen=True, kw_only=True)
class SineLoadTable:
    """`[excitation] kind = "sine"`: a force load * sin(frequency t) beside the static load.

    Parameters
    ----------
    load : (float, float) [N]
        Amplitude; in a file one magnitude, along -y, or `[x, y]`.
    frequency : float [rad/s]
        Angular; a file may say Hz.
    """

    load: Annotated[tuple[float, float], reading.read_load]
    frequency: float

    def __post_init__(self) -> None:
        require_positive("frequency", self.frequency)


@dataclass(frozen=True, kw_only=True)
class MotorTable(UnbalanceTable):
    """`[excitation] kind = "motor"`: an unbalance, and a motor that turns the rotor.

    The rotor has `operation.speed` at t = 0.

    Parameters
    ----------
    inertia : float [kg m2]
        Polar moment of inertia of all that turns.
    stall_torque : float [N m]
        Torque at rest; it falls in a line to nothing at the idle speed.
    idle_speed : float [rad/s]
        Idle speed at which the motor has no torque.
    resistance : float [N m s/rad]
        Torque per rad/s that resists.
    """

    inertia: float
    stall_torque: float
    idle_speed: float
    resistance: float = 0.0

    def __post_init__(self) -> None:
        super().__post_init__()
        require_positive("inertia", self.inertia)
        self.motor()

    def motor(self) -> LinearMotor:
        """Return the motor."""
        from ..rotors import LinearMotor

        return reading.made_from(LinearMotor, self)


@dataclass(frozen=True, kw_only=True)
class GroundTable:
    """`[excitation] kind = "ground"`: ground that shakes, and all housings with it.

    Parameters
    ----------
    acceleration : tuple or None
        Columns time [s], x and maybe y [m/s2]; linear between the times.
    displacement : tuple or None
        Columns time [s], x and maybe y [m]; the cubic spline through it, at rest at both ends.
    spectrum : tuple or None
        Columns `frequency [rad/s]` and `density [m2/s3]`, the one-sided spectral density of the acceleration,
        the same along x and along y.
    scale : float [1]
        Scale by which the motion is multiplied.
    seed : int
        Seed of the random phases of a spectrum.
    """

    acceleration: Annotated[reading.Record | None, reading.record_of("time [s]", "x [m/s2]", "y [m/s2]")] = (
        None
    )
    displacement: Annotated[reading.Record | None, reading.record_of("time [s]", "x [m]", "y [m]")] = None
    spectrum: Annotated[reading.Record | None, reading.record_of("frequency [rad/s]", "density [m2/s3]")] = (
        None
    )
    scale: float = 1.0
    seed: Annotated[int, reading.Count(SEEDS, 0)] = 0

    def __post_init__(self) -> None:
        require_number("scale", self.scale)
        given = [name for name in ("acceleration", "displacement", "spectrum") if getattr(self, name)]
        if len(given) != 1:
            raise InputError(f"one of acceleration, displacement and spectrum must be given, got {given}")
        if self.spectrum is not None and len(self.spectrum) != 2:
            raise InputError(f"spectrum must have 2 columns, got {len(self.spectrum)}")

    @property
    def end(self) -> float | None:
        """Last time of a record [s]; None of a spectrum."""
        record = self.acceleration or self.displacement
        return None if record is None else record[0][-1]

    def motion(self, duration: float) -> BaseMotion:
        """Return the motion of the ground; that of a spectrum for so long [s]."""
        from ..rotors import BaseMotion

        if self.spectrum is not None:
            omega, power = self.spectrum
            density = [self.scale**2 * value for value in power]
            return BaseMotion.from_spectrum(omega, density, duration=duration, seed=self.seed)
        record = self.acceleration or self.displacement
        assert record is not None
        times, *rows = record
        x, y = ([self.scale * value for value in row] for row in (*rows, ())[:2])
        if self.displacement is not None:
            return BaseMotion.from_displacement(times, x, y)
        return BaseMotion(times=times, acceleration_x=tuple(x), acceleration_y=tuple(y))


ExcitationTable = UnbalanceTable | BladeLossTable | RunUpTable | StepLoadTable | SineLoadTable | GroundTable
EXCITATIONS = {
    "unbalance": UnbalanceTable,
    "blade_loss": BladeLossTable,
    "run_up": RunUpTable,
    "step": StepLoadTable,
    "sine": SineLoadTable,
    "motor": MotorTable,
    "ground": GroundTable,
}
"""What may shake a scene, by name."""


def fastest_speed(scene: Any) -> float:
    """Return the highest speed of the operation of a scene, and of what drives it, without a sign [rad/s]."""
    excitation, speed = scene.excitation, abs(scene.speed)
    if isinstance(excitation, RunUpTable):
        return max(speed, abs(excitation.end_speed))
    return max(speed, abs(excitation.idle_speed)) if isinstance(excitation, MotorTable) else speed


def kind_of(excitation: object) -> str:
    """Return the name of what shakes a scene; empty for nothing."""
    return next((name for name, table in EXCITATIONS.items() if type(excitation) is table), "")


def require_kind(excitation: object, kinds: Sequence[str]) -> None:
    """Raise InputError unless a scene is shaken by one of some kinds, or by nothing.

    Parameters
    ----------
    excitation : ExcitationTable or None
    kinds : sequence of str
    """
    found = kind_of(excitation)
    if not found or found in kinds:
        return
    wanted = " or ".join([", ".join(kinds[:-1]), kinds[-1]] if len(kinds) > 1 else kinds)
    raise InputError(f"excitation.kind must be {wanted} here, got {found}")


# The table of one bearing with a film, of whatever family, on which the rotor of a scene rests.


@runtime_checkable
class FilmTable(Protocol):
    """What the table of one bearing with a film has besides its keys: a rotor may rest on it."""

    @property
    def viscosity(self) -> float | None:
        """That the file gives [Pa s]; None where `[lubricant]` does."""

    @property
    def film_is_given(self) -> bool:
        """Whether the file names the film, so that no other may answer."""

    def on(self, where: str, lubricant: LubricantTable) -> Self:
        """Return this table with the oil of the scene, unless it has its own viscosity.

        Parameters
        ----------
        where : str
            Its name in the file, for messages.
        lubricant : LubricantTable
        """

    def build(self) -> Any:
        """Return the bearing, a Reaction or a film at rest; InputError where a value breaks its rule."""

    def repeated_inputs(self, bearing: Any) -> tuple[Readable, str]:
        """Return what an answer repeats of the bearing that was built, and the name of its film."""

    def remarks(
        self,
        bearing: Any,
        oil: Lubricant,
        speed: float,
        load: tuple[float, float],
        at: Equilibrium | None = None,
    ) -> tuple[str, ...]:
        """Return what its physics leaves out and should not, at a speed [rad/s] and a load [N].

        `at` is the equilibrium of the bearing where it is known.
        """

    def make_map(self, report: Report) -> None:
        """Make the map that the bearing needs, unless it lies on disk."""


def film_tables(tables: Mapping[str, Any]) -> dict[str, FilmTable]:
    """Return those of the tables of a scene, by their names in the file, that are of bearings with a film.

    Raises
    ------
    InputError
        If there are several.
    """
    found = {name: table for name, table in tables.items() if not lacked(table, FilmTable)}
    if len(found) > 1:
        raise InputError(f"{' and '.join(found)} must not stand in one scene: which does the rotor rest on?")
    return found


def film_table(tables: Mapping[str, Any]) -> FilmTable:
    """Return the table of the bearing with a film among those of a scene; raise InputError without one."""
    found = next(iter(film_tables(tables).values()), None)
    if found is None:
        given = ", ".join(f"[{name}]" for name, table in tables.items() if table is not None)
        raise InputError(f"journal or another bearing with a film is required, got {given}")
    return found


def oil_remarks(tables: Mapping[str, Any], lubricant: LubricantTable) -> tuple[str, ...]:
    """Return that bearings have a viscosity of their own although `[lubricant]` has one, one line each."""
    if not lubricant.has_viscosity:
        return ()
    journals: dict[str, Any] = {
        name: table for name, table in tables.items() if hasattr(table, "on") and name != "shaft"
    }
    shaft = tables.get("shaft")
    for k, one in enumerate(shaft.bearings if shaft is not None else ()):
        if one.journal is not None:
            journals[f"shaft.bearings[{k}].journal"] = one.journal
    return tuple(
        f"oil: {name} runs on its own viscosity of {one.viscosity:g} Pa s at all temperatures and not on "
        f"the oil of [lubricant]; without {name}.viscosity it would"
        for name, one in journals.items()
        if one.viscosity is not None
    )
