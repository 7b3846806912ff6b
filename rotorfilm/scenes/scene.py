"""A scene: one TOML file that says what is there and what is asked."""

from __future__ import annotations

import math
import tomllib
from dataclasses import dataclass, field
from importlib import resources
from os import PathLike
from pathlib import Path
from typing import Annotated, Any

from ..bearings.journal import JournalBearing
from ..errors import InputError, SceneError
from ..rotors.rigid import RigidRotor
from ..units import STANDARD_GRAVITY
from .schema import SCHEMA, CosimulationTable, JournalTable, OperationTable, RigidRotorTable
from .solve import Answer, solve
from .tables import Table, read_table, text

BUNDLED = "friswell_5_9_6.toml"
"""The scene file that ships with the package."""


@dataclass(frozen=True, kw_only=True)
class Scene:
    """A bearing, what it carries, and how it is run.

    The fields are the tables of schema 1, by their names in the file.

    Parameters
    ----------
    title : str
        One line for print-outs and charts.
    journal : JournalTable
        The bearing.
    operation : OperationTable
        Speed and load.
    rigid_rotor : RigidRotorTable or None
        What the bearing carries; without it there is no whirl threshold and no transient.
    cosimulation : CosimulationTable
        Macro step and length of a coupled run.

    Raises
    ------
    InputError
        If a load is neither given nor follows from the weight of a rotor.
    """

    title: Annotated[str, text] = "untitled scene"
    journal: Annotated[JournalTable, Table(JournalTable)]
    operation: Annotated[OperationTable, Table(OperationTable)]
    rigid_rotor: Annotated[RigidRotorTable | None, Table(RigidRotorTable)] = None
    cosimulation: Annotated[CosimulationTable, Table(CosimulationTable)] = field(
        default_factory=CosimulationTable
    )

    def __post_init__(self) -> None:
        if self.operation.load is None and self.rigid_rotor is None:
            raise InputError("operation.load is required where there is no [rigid_rotor], got neither")

    @classmethod
    def load(cls, path: str | PathLike[str]) -> Scene:
        """Read a scene file.

        Parameters
        ----------
        path : str or path-like
            A TOML file of schema 1.

        Raises
        ------
        SceneError
            If the file cannot be read, is no TOML, or breaks the schema; the message names the file, the
            dotted key, the rule and the value.
        """
        try:
            document = Path(path).read_text(encoding="utf-8")
        except (OSError, UnicodeDecodeError) as error:
            reason = error.strerror if isinstance(error, OSError) else "it is not UTF-8 text"
            raise SceneError(f"{path}: scene file cannot be read: {reason}") from None
        return parse_scene(document, str(path))

    def solve(self) -> Answer:
        """Return equilibrium, coefficients and whirl threshold; see `rotorfilm.scenes.solve.solve`."""
        mass = None if self.rigid_rotor is None else self.rigid_rotor.mass
        return solve(self.bearing, load=self.static_load, speed=self.operation.speed, mass=mass)

    @property
    def static_load(self) -> tuple[float, float]:
        """Whole static force on the journal, weight included [N]."""
        if self.operation.load is not None:
            return self.operation.load
        assert self.rigid_rotor is not None  # checked in __post_init__
        return 0.0, -STANDARD_GRAVITY * self.rigid_rotor.mass

    @property
    def bearing(self) -> JournalBearing:
        """The bearing with its film law."""
        return self.journal.build()

    @property
    def rotor(self) -> RigidRotor:
        """The rotor under the static load; raises InputError if the scene has none."""
        if self.rigid_rotor is None:
            raise InputError("rigid_rotor is required for a transient and for a rotor FMU, got no such table")
        return self.rigid_rotor.build(self.operation.speed, self.static_load)

    @property
    def macro_step(self) -> float:
        """Time between two exchanges of signals in a co-simulation [s]; the shaft must turn."""
        return self.time_of(self.cosimulation.macro_angle)

    @property
    def duration(self) -> float:
        """Length of a run [s]; the shaft must turn."""
        return self.time_of(2.0 * math.pi * self.cosimulation.revolutions)

    def time_of(self, angle: float) -> float:
        """Return the time [s] in which the shaft turns by `angle` [rad]."""
        if self.operation.speed == 0.0:
            raise InputError("operation.speed must not be zero for a run in turns of the shaft, got 0.0")
        return angle / abs(self.operation.speed)


def parse_scene(document: str, source: str) -> Scene:
    """Return the scene that a TOML text describes; `source` names it in messages."""
    try:
        data = tomllib.loads(document)
    except tomllib.TOMLDecodeError as error:
        raise SceneError(f"{source}: not valid TOML: {error}") from None
    _require_schema(source, data.pop("schema", None))
    return read_table(Scene, f"{source}: ", data)


def bundled_scene() -> Scene:
    """Return the scene that ships with the package: Friswell et al. (2010), example 5.9.6."""
    document = resources.files(__package__).joinpath("data", BUNDLED).read_text(encoding="utf-8")
    return parse_scene(document, BUNDLED)


def _require_schema(source: str, value: Any) -> None:
    if type(value) is not int or value != SCHEMA:
        found = "nothing" if value is None else repr(value)
        raise SceneError(f"{source}: schema must be {SCHEMA} (write `schema = {SCHEMA}`), got {found}")
