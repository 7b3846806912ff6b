"""`[excitation]`: what shakes the scene besides its steady load, and what drives it."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Annotated, Any, Protocol, Self, runtime_checkable

from ..core.errors import InputError, require_count, require_non_negative, require_number, require_positive
from ..core.limits import SEEDS
from ..core.progress import Report
from ..core.readable import Readable
from ..rotors.profile import SpeedProfile
from .lubricant_table import Lubricant, LubricantTable
from .reading import Count, Record, made_from, read_load, record_of

if TYPE_CHECKING:
    from ..rotors import BaseMotion, LinearMotor


@dataclass(frozen=True, kw_only=True)
class UnbalanceTable:
    """`[excitation] kind = "unbalance"`: an unbalance that turns with the rotor.

    Parameters
    ----------
    unbalance : float [kg m]
        Mass times eccentricity of its center.
    unbalance_angle : float [rad]
        From +x at t = 0.
    node : int
        Of a flexible rotor, where it sits; 0 for all others.
    """

    unbalance: float
    unbalance_angle: float = 0.0
    node: int = 0

    def __post_init__(self) -> None:
        require_non_negative("unbalance", self.unbalance)
        require_number("unbalance_angle", self.unbalance_angle)
        require_count("node", self.node, 0)


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
        Of the way there.
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
    start, end : float [s]
        When it jumps up and down; the end is never where a file gives none.
    """

    load: Annotated[tuple[float, float], read_load]
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

    load: Annotated[tuple[float, float], read_load]
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
        At which the motor has no torque.
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

        return made_from(LinearMotor, self)


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
        By which the motion is multiplied.
    seed : int
        Of the random phases of a spectrum.
    """

    acceleration: Annotated[Record | None, record_of("time [s]", "x [m/s2]", "y [m/s2]")] = None
    displacement: Annotated[Record | None, record_of("time [s]", "x [m]", "y [m]")] = None
    spectrum: Annotated[Record | None, record_of("frequency [rad/s]", "density [m2/s3]")] = None
    scale: float = 1.0
    seed: Annotated[int, Count(SEEDS, 0)] = 0

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
        self, bearing: Any, oil: Lubricant, speed: float, load: tuple[float, float]
    ) -> tuple[str, ...]:
        """Return what its physics leaves out and should not, at a speed [rad/s] and a load [N]."""

    def make_map(self, report: Report) -> None:
        """Make the map that the bearing needs, unless it lies on disk."""


def film_tables(tables: Mapping[str, Any]) -> dict[str, FilmTable]:
    """Return those of the tables of a scene, by their names in the file, that are of bearings with a film.

    Raises
    ------
    InputError
        If there are several.
    """
    found = {name: table for name, table in tables.items() if isinstance(table, FilmTable)}
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
    journals: dict[str, Any] = dict(film_tables(tables))
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
