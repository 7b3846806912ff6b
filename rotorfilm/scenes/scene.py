"""A scene: one TOML file that says what is there and what is asked."""

from __future__ import annotations

import copy
import math
import re
import tomllib
from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from importlib import resources
from os import PathLike
from pathlib import Path
from types import MappingProxyType
from typing import TYPE_CHECKING, Annotated, Any

from ..analysis.threads import one_blas_thread
from ..core.answers import QuestionAnswer
from ..core.errors import InputError, SceneError, brief, require_positive, said_once, shortened, warn_user
from ..core.inputs import nearest
from ..core.limits import LINE_DOTS, SCENE_BYTES
from ..core.port import Reaction
from ..core.progress import Report, silent
from ..core.results import Equilibrium
from ..core.sources import offered
from ..core.units import STANDARD_GRAVITY, dotted_key, whole_number
from ..rotors.rigid import RigidRotor
from . import shared_tables
from .families import FAMILIES, brought, table_of
from .oil_film_tables import decided
from .reading import Beside, Quantity, Variant, one_of, read_table, require_no_near_miss, takes
from .shared_tables import film_table

if TYPE_CHECKING:
    from ..bearings.journal import JournalBearing
    from .film_answer import Answer

# `[question]`: the quantity that is asked for, and how accurate it must be.


QUANTITIES: dict[str, str] = tomllib.loads(
    resources.files(__package__).joinpath("quantities.toml").read_text("utf-8")
)
"""What a scene may ask for, by the name in `question.quantity`."""


@takes(Quantity("1"))
def read_tolerance(where: str, value: Any) -> float:
    """Read a relative tolerance; above 1 only in percent, as a plain number may be meant to be."""
    tolerance = Quantity("1")(where, value)
    if tolerance > 1.0 and "%" not in str(value):
        meant = brief(f"{value} %")
        raise SceneError(f"{where} must be at most 1 unless it is in percent, got {brief(value)}: {meant}?")
    return tolerance


@dataclass(frozen=True, kw_only=True)
class QuestionTable:
    """`[question]`: what is asked.

    Parameters
    ----------
    quantity : str
        Its name, such as "stiffness"; docs/questions.md lists all.
    tolerance : float [1]
        Largest error allowed, relative to the quantity; of a matrix to its largest entry, of the error of a
        co-simulation to the clearance, of an angle to 1 rad, of a temperature to its rise above the supply.
    at : str
        Of a flexible rotor: bearing or probe that is asked about, the one that moves most unless given.
    """

    quantity: Annotated[str, one_of(QUANTITIES)]
    tolerance: Annotated[float, read_tolerance]
    at: str = ""

    def __post_init__(self) -> None:
        require_positive("tolerance", self.tolerance)


# A scene: one TOML file that says what is there and what is asked.


BUNDLED = "friswell_5_9_6.toml"
"""The scene file that ships with the package."""

NO_LOAD = "operation.load is required where there is no [rigid_rotor], got neither"


@dataclass(frozen=True, kw_only=True)
class Scene:
    """A scene: bearings, the rotor that they carry, its operation, and a question.

    The fields are the tables of schema 1, by their names in the file. Each table is optional, but one at
    least must be given.

    Parameters
    ----------
    title : str
        One line for print-outs and charts.
    tables : mapping of str to object
        Tables of bearings and of rotors with bearings, by their names in the file; `FAMILIES` lists the
        names. Each is also an attribute, such as `scene.journal`, which is None if the scene does not have
        it.
    operation : OperationTable or None
        Speed and load.
    lubricant : LubricantTable
        The oil and its cooling, and properties for the checks of neglected effects.
    rigid_rotor : RigidRotorTable or None
        The rotor that the bearing carries; without it there is no whirl threshold and no transient.
    excitation : ExcitationTable or None
        Excitation or drive in addition to the steady load.
    cosimulation : CosimulationTable
        Macro step and length of a coupled run.
    question : QuestionTable or None
        The quantity that is asked for, and its tolerance.

    Raises
    ------
    InputError
        If there is no bearing, or a journal bearing without an operation, or with a load that is neither
        given nor follows from the weight of a rotor; if the question is about a place that does not exist.
    """

    title: str = "untitled scene"

    # A family checks what it needs of the other tables where it is solved.
    tables: Annotated[Mapping[str, Any], Beside(tuple(FAMILIES), table_of)] = field(
        default_factory=dict, hash=False
    )

    # What all families share.
    operation: shared_tables.OperationTable | None = None
    lubricant: shared_tables.LubricantTable = field(default_factory=shared_tables.LubricantTable)
    rigid_rotor: shared_tables.RigidRotorTable | None = None
    excitation: Annotated[
        shared_tables.ExcitationTable | None, Variant("kind", shared_tables.EXCITATIONS)
    ] = None
    cosimulation: shared_tables.CosimulationTable = field(default_factory=shared_tables.CosimulationTable)
    question: QuestionTable | None = None

    def __post_init__(self) -> None:
        self._take_oil()
        if not self.tables:
            raise InputError(f"{' or '.join(FAMILIES)} is required and missing")
        if self.question is not None and self.question.at:
            self._require_place(self.question.at, self.question.quantity)
        if isinstance(self.excitation, shared_tables.UnbalanceTable):
            self._require_node("excitation.node", self.excitation.node)
        if self.shaft is not None:
            self._decide("shaft", brought("scenes.turbulent_shaft.decided_shaft"))
        if not self.has_film:
            return
        if self.operation is None:
            raise InputError("operation is required and missing: the journal has no speed and no load")
        if self.operation.load is None and self.rigid_rotor is None:
            raise InputError(NO_LOAD)
        for name in shared_tables.film_tables(self.tables):
            self._decide(name, decided)

    def __getattr__(self, name: str) -> Any:
        """Return the table of a family by its name; None if the scene has none."""
        if name in FAMILIES:
            return self.tables.get(name)
        raise AttributeError(f"a scene has no attribute {name!r}")

    def _take_oil(self) -> None:
        """Give the oil of `[lubricant]` to the bearings that state no viscosity."""
        _ = shared_tables.film_tables(self.tables)  # at most one
        oiled = {
            name: table.on(name, self.lubricant)
            for name, table in self.tables.items()
            if hasattr(table, "on")
        }
        object.__setattr__(self, "tables", {**self.tables, **oiled})

    def _decide(self, name: str, decide: Any) -> None:
        """Keep what decides over the turbulence of a table in its place."""
        object.__setattr__(self, "tables", {**self.tables, name: decide(self.tables[name], self)})

    def _require_node(self, name: str, node: int) -> None:
        """Raise InputError unless the shaft has this node; where there is none, it is 0."""
        if self.shaft is None and node:
            raise InputError(f"{name} must be 0 where there is no [shaft], got {node}")
        if self.shaft is not None:
            self.shaft.require_node(name, node)

    def _require_place(self, place: str, quantity: str) -> None:
        """Raise InputError unless a question about a place names a bearing or a probe of the shaft."""
        if self.shaft is None:
            raise InputError(f"question.at must be left out where there is no [shaft], got {brief(place)}")
        known = self.shaft.places(forces=quantity == "unbalance_force")
        if place not in known:
            raise InputError(
                f"question.at must be one of {', '.join(known)} for {quantity}, "
                f"got {place!r}{nearest(place, known)}"
            )

    def with_tables(self, **tables: Any) -> Scene:
        """Return the scene with other tables of families, by their names."""
        return replace(self, tables={**self.tables, **tables})

    @classmethod
    def load(cls, path: str | PathLike[str], changes: Mapping[str, Any] = MappingProxyType({})) -> Scene:
        """Read a scene file.

        Parameters
        ----------
        path : str or path-like
            A TOML file of schema 1.
        changes : mapping of str to object
            Values in place of those of the file, by dotted key: `{"journal.clearance": "80 um"}`.

        Raises
        ------
        SceneError
            If the file cannot be read, is no TOML, or breaks the schema; the message names the file, the
            dotted key, the rule and the value.
        """
        return read_scene(varied(read_tables(path), changes), str(path))

    @said_once()
    @one_blas_thread
    def solve(self, report: Report = silent) -> Any:
        """Return the answer to the question, or without a question the results of the bearing or rotor.

        Parameters
        ----------
        report : callable
            Called with the progress.

        Returns
        -------
        Readable
            A `QuestionAnswer`. Without a question it is an `Answer` for a bearing with a film, a
            `RotorAnswer` for a `[shaft]`, a `DamperAnswer` for a `[damper]`, a `ContactAnswer` for a
            `[contact]`, and a `BushAnswer` for a `[bush]`.
        """
        if self.question is not None:
            return self.ask()
        if self.has_film:
            self.film_table.make_map(report)
            return self.describe()
        answer = next((FAMILIES[name].answer for name in self.tables if FAMILIES[name].answer), "")
        return brought(answer)(self, report) if answer else self.describe()

    @said_once()
    @one_blas_thread
    def ask(self) -> QuestionAnswer:
        """Return the answer to the question by the cheapest model that meets its tolerance.

        Returns
        -------
        QuestionAnswer
            The answer, with all models that were tried. If no model meets the tolerance, `met` is false.

        Raises
        ------
        InputError
            If the scene has no question, or one that its tables cannot answer.
        RotorfilmError
            If no model has an answer.

        Warns
        -----
        ValidityWarning
            If all models neglect an effect that matters in this scene.
        """
        answer: QuestionAnswer = offered("ask")(self)
        for remark in answer.remarks:
            warn_user(f"left out: {remark}")
        return answer

    def describe(self) -> Answer:
        """Return equilibrium, coefficients and whirl threshold of a bearing with a film.

        Effects that the film neglects are in `remarks` of the answer.
        """
        bearing = self.bearing  # once, and before an import resets what was warned of: making it may warn
        from .film_answer import film_answer  # which a scene with a question does not need

        mass = None if self.rigid_rotor is None else self.rigid_rotor.mass
        given = self.film_table.repeated_inputs(bearing)
        answer = film_answer(bearing, given, load=self.static_load, speed=self.speed, mass=mass)
        return replace(answer, remarks=self._remarks_of(bearing, answer.equilibrium))

    @property
    def given(self) -> Mapping[str, Any]:
        """The tables as the file has them, with its units; empty of a scene that was made in Python."""
        return MappingProxyType(vars(self).get("_given", {}))

    def save(self, path: str | PathLike[str]) -> Path:
        """Write the tables as a scene file, with the units as read; return the path."""
        save: Any = brought("scenes.save_scene.save_scene")
        return Path(save(self, path))

    def report(self, **asked: Any) -> Any:
        """Return a report of the scene, of which `save("report.html")` makes one page.

        Its arguments and errors are those of `rotorfilm.reports.report_scene`.
        """
        return offered("report_scene")(self, **asked)

    def table(self, name: str) -> Any:
        """Return the table of a family by its name in the file; None if the scene has none."""
        return self.tables.get(name)

    def required(self, name: str, what: str) -> Any:
        """Return a table by its name; raise InputError, which states its purpose, if there is none."""
        found = getattr(self, name)
        if found is None:
            raise InputError(f"{name} is required for {what}, got no such table")
        return found

    def excited_by(self, what: str, *kinds: type) -> Any:
        """Return the excitation; raise InputError, which states its purpose, for other kinds."""
        if not isinstance(self.excitation, kinds):
            named = " or ".join(
                f'"{name}"' for name, table in shared_tables.EXCITATIONS.items() if table in kinds
            )
            got = "none" if self.excitation is None else repr(self.excitation)
            raise InputError(f"excitation of kind {named} is required for {what}, got {got}")
        return self.excitation

    @property
    def film_remarks(self) -> tuple[str, ...]:
        """Effects that the film neglects although they matter, one line each."""
        return self._remarks_of(self.bearing)

    def _remarks_of(self, bearing: Reaction, at: Equilibrium | None = None) -> tuple[str, ...]:
        own = self.film_table.remarks(bearing, self.lubricant.properties, self.speed, self.static_load, at)
        return (*shared_tables.oil_remarks(self.tables, self.lubricant), *own)

    @property
    def film_is_given(self) -> bool:
        """Whether the file names the film, so that no other film may be used."""
        return self.has_film and self.film_table.film_is_given

    @property
    def has_film(self) -> bool:
        """Whether there is a bearing with a film that carries the static load."""
        return bool(shared_tables.film_tables(self.tables))

    @property
    def film_table(self) -> shared_tables.FilmTable:
        """The table of the bearing with a film; raises InputError if the scene has none."""
        return film_table(self.tables)

    @property
    def speed(self) -> float:
        """Angular speed about +z [rad/s]; raises InputError if the scene has no operation."""
        return self._operation.speed

    @property
    def static_load(self) -> tuple[float, float]:
        """Whole static force on the journal, weight included [N]."""
        if self._operation.load is not None:
            return self._operation.load
        if self.rigid_rotor is None:
            raise InputError(NO_LOAD)
        return 0.0, -STANDARD_GRAVITY * self.rigid_rotor.mass

    @property
    def bearing(self) -> Reaction:
        """The bearing with its film law; raises InputError if the scene has none with a film."""
        return self.film_table.build()

    @property
    def journal_bearing(self) -> JournalBearing:
        """The bearing of `[journal]`; raises InputError if the scene has none."""
        return self.required("journal", "a journal bearing").bearing()

    @property
    def rotor(self) -> RigidRotor:
        """The rotor under the static load; raises InputError if the scene has none."""
        table: shared_tables.RigidRotorTable = self.required("rigid_rotor", "a transient and for a rotor FMU")
        return table.build(self.speed, self.static_load)

    @property
    def macro_step(self) -> float:
        """Time between two exchanges of signals in a co-simulation [s]; the speed must not be 0."""
        return self.time_of(self.cosimulation.macro_angle)

    @property
    def duration(self) -> float:
        """Length of a run [s]; if it is given in turns, the speed must not be 0."""
        if self._operation.duration is not None:
            return self._operation.duration
        return self.time_of(2.0 * math.pi * self.cosimulation.revolutions)

    def time_of(self, angle: float) -> float:
        """Return the time [s] in which the shaft turns by `angle` [rad]."""
        if self.speed == 0.0:
            raise InputError("operation.speed must not be zero for a run in turns of the shaft, got 0.0")
        return angle / abs(self.speed)

    @property
    def _operation(self) -> shared_tables.OperationTable:
        return self.required("operation", "a speed and a load")


def parse_scene(document: str, source: str) -> Scene:
    """Return the scene that a TOML text describes; `source` names it in messages."""
    return read_scene(parsed(document, source), source)


def read_scene(data: Mapping[str, Any], source: str) -> Scene:
    """Return the scene that the tables of a file describe; `source` names it in messages."""
    tables = dict(data)
    require_schema(source, tables)
    scene = read_table(Scene, f"{source}: ", tables)
    object.__setattr__(scene, "_given", copy.deepcopy(dict(data)))
    return scene


def bundled_scene() -> Scene:
    """Return the scene that ships with the package: Friswell et al. (2010), example 5.9.6."""
    document = resources.files(__package__).joinpath("data", BUNDLED).read_text(encoding="utf-8")
    return parse_scene(document, BUNDLED)


# The text of a scene file: read, parsed, and of the right schema.


BYTE_ORDER_MARK = "\ufeff"
"""What some editors put before the text of a file."""


def read_tables(path: str | PathLike[str]) -> dict[str, Any]:
    """Return the tables of a scene file as they are; raise SceneError if it cannot be read or is no TOML."""
    try:
        with Path(path).open("rb") as file:
            content = file.read(SCENE_BYTES + 1)
        document = content.decode("utf-8")
    except (OSError, ValueError) as error:
        reason = error.strerror if isinstance(error, OSError) else "it is not UTF-8 text"
        raise SceneError(f"{path}: scene file cannot be read: {reason}") from None
    if len(content) > SCENE_BYTES:
        raise SceneError(f"{path}: scene file must be at most {SCENE_BYTES} bytes long, got more")
    return parsed(document, str(path))


def parsed(document: str, source: str) -> dict[str, Any]:
    """Return the tables of a TOML text; `source` names it in messages."""
    if any(line.count(".") > LINE_DOTS for line in document.splitlines()):
        raise SceneError(f"{source}: lines must not have more than {LINE_DOTS} dots")
    try:
        return tomllib.loads(document.removeprefix(BYTE_ORDER_MARK))
    except tomllib.TOMLDecodeError as error:
        lines = document.splitlines()
        where = str(error).replace("(at end of document)", f"(at line {len(lines)}, the last)")
        raise SceneError(f"{source}: not valid TOML: {shortened(where)}{_quotes(lines, where)}") from None
    except RecursionError:
        raise SceneError(f"{source}: tables and lists must not be nested that deep") from None
    except ValueError:  # Python reads no integer of more than 4300 digits
        raise SceneError(f"{source}: integers must not have thousands of digits") from None


def _quotes(lines: list[str], where: str) -> str:
    """Return that a number with a unit must be in quotes, where a message tells of a line with one."""
    told = re.search(r"at line (\d+)", where)
    line = lines[int(told[1]) - 1] if told and lines else ""
    bare = re.match(r"\s*[\w.-]+\s*=\s*([-+.\d][-+.\w]*\s+[A-Za-z%][^#\"]*)", line)
    return f'; a number with a unit must be in quotes, as "{bare[1].strip()}"' if bare else ""


def varied(scene: Mapping[str, Any], values: Mapping[str, Any]) -> dict[str, Any]:
    """Return the tables of a scene file with other values at some keys.

    Raises
    ------
    SceneError
        If a key leads through something that is no table or list.
    """
    data = copy.deepcopy(dict(scene))
    for key, value in values.items():
        if key.count(".") > LINE_DOTS:
            raise SceneError(f"keys must not have more than {LINE_DOTS} dots, got {brief(key)}")
        *path, last = dotted_key(key).split(".")
        place: Any = data
        for part in path:
            place = _inside(key, place, part)
        _set(key, place, last, value)
    return data


def _inside(key: str, place: Any, part: str) -> Any:
    if isinstance(place, dict):
        return place.setdefault(part, {})
    if isinstance(place, list) and (number := _entry(place, part)) is not None:
        return place[number]
    raise SceneError(f"{key} must be the dotted name of a key in a table of the scene, got no table {part!r}")


def _entry(place: list[Any], part: str) -> int | None:
    """Return the entry of a list that a part of a key names; it has one name only."""
    number = whole_number(part)
    return number if number is not None and number < len(place) and str(number) == part else None


def _set(key: str, place: Any, last: str, value: Any) -> None:
    if isinstance(place, dict):
        place[last] = value
    elif isinstance(place, list) and (number := _entry(place, last)) is not None:
        place[number] = value
    else:
        raise SceneError(
            f"{key} must be the dotted name of a key in a table of the scene, got no table {last!r}"
        )


def json_schema() -> str:
    """Return the JSON Schema of scene files, which `tools/scene_schema.py` makes of their tables."""
    return resources.files(__package__).joinpath("data", "scene.schema.json").read_text(encoding="utf-8")


def require_schema(source: str, data: dict[str, Any]) -> None:
    """Take the version out of the data; raise SceneError if it is not the one that is read here."""
    value, wanted = data.pop("schema", None), shared_tables.SCHEMA
    if type(value) is not int or value != wanted:
        require_no_near_miss(f"{source}: ", "schema", data)
        found = "nothing" if value is None else brief(value)
        raise SceneError(f"{source}: schema must be {wanted} (write `schema = {wanted}`), got {found}")
