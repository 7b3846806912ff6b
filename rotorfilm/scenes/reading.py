"""Read tables of a scene file into dataclasses: a field is read by its type and by the unit of its docstring.

Where a class says enough, its fields are the keys: units, defaults and meanings stand there alone. A table of
its own takes fields over (`fields_of`), and annotates with a reader what a file says in another way.
"""

from __future__ import annotations

import dataclasses
import inspect
import math
import re
import sys
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass, fields, is_dataclass
from functools import cache
from pathlib import Path
from types import NoneType, UnionType
from typing import TYPE_CHECKING, Any, Generic, NamedTuple, TypeVar, get_args, get_origin, get_type_hints

from ..analysis.equilibrium import UNLOADED
from ..core.errors import InputError, SceneError, brief, shortened
from ..core.files import read_text
from ..core.inputs import nearest, require_choice, require_no_near_miss, temperatures_of, units_of
from ..core.limits import FILM_CELLS, SHAFT_ELEMENTS, TEXT
from ..core.readable import entries, explained
from ..core.units import parse_quantity, si_name

# From one dataclass to another that has fields of the same names.


def fields_of(
    *homes: Callable[..., Any], without: Iterable[str] = (), optional: bool = False
) -> Callable[[type[T]], type[T]]:
    """Let a class, before it becomes a dataclass, have the fields of others: type, default, unit and meaning.

    Parameters
    ----------
    *homes : callable
        Dataclasses, or functions, whose arguments are taken.
    without : iterable of str
        Those that are not taken over. What the class has itself, or by a base, stays as it is; a field
        without a default takes that.
    optional : bool
        Whether each may be left out, and is None then.
    """

    def taking(cls: type[T]) -> type[T]:
        own, text = inspect.get_annotations(cls), inspect.cleandoc(cls.__doc__ or "")
        inherited = getattr(cls, "__dataclass_fields__", {})
        told = {*without, *inherited, *(entry.name for entry in entries(text, cls.__name__))}
        text += "" if "Parameters\n" in text else "\n\nParameters\n----------"
        hints: dict[str, Any] = {}
        for home in homes:
            for name, default in _parameters(home).items():
                if name not in told:
                    told.add(name)
                    text += _entry(home, name)
                if name in (*without, *inherited, *hints):
                    continue
                if name not in own:
                    kind = _hints(home)[name]
                    hints[name] = kind | None if optional else kind
                if name not in vars(cls) and (optional or default is not dataclasses.MISSING):
                    setattr(cls, name, None if optional else default)
        cls.__annotations__, cls.__doc__ = {**hints, **own}, text
        return cls

    return taking


def _parameters(home: Callable[..., Any]) -> dict[str, Any]:
    """Return the defaults of a dataclass or a function by their names, `MISSING` for none."""
    if not isinstance(home, type):
        return dict.fromkeys(inspect.signature(home).parameters, dataclasses.MISSING)
    return {
        one.name: one.default
        if one.default_factory is dataclasses.MISSING
        else dataclasses.field(default_factory=one.default_factory)
        for one in fields(home)
        if one.init
    }


def _entry(home: Callable[..., Any], name: str) -> str:
    """Return what is said of a parameter as an entry of a docstring without indentation."""
    if isinstance(home, type):
        wording = explained(home, name)
    else:
        wording = next(one for one in entries(home.__doc__ or "", name) if one.name == name)
    unit = f" [{wording.unit}]" if wording.unit else ""
    return f"\n{name} : {wording.kind}{unit}" + (f"\n    {wording.meaning}" if wording.meaning else "")


class Taking:
    """The base of a table that has fields of other classes, which type checkers do not see."""

    if TYPE_CHECKING:

        def __getattr__(self, name: str) -> Any:
            """Return the value of a key."""


def made_from(makes: type[T], table: Any, **further: Any) -> T:
    """Return an object of a dataclass: what its fields share with those of a table, and further values.

    Parameters
    ----------
    makes : type
        The dataclass.
    table : object
        Table of another dataclass.
    **further
        Values of fields that the table does not have, or that differ there.
    """
    own = {field.name for field in fields(makes)}  # type: ignore[arg-type]
    shared = own & {field.name for field in fields(table)} - further.keys()
    return makes(**{name: getattr(table, name) for name in shared}, **further)


# Read tables of a scene file into dataclasses: each field says by its annotation how it is read.


Reader = Callable[[str, Any], Any]
"""Turns (where, value) into the value of a field; `where` is `FILE: dotted.key`, for the messages."""

T = TypeVar("T")
V = TypeVar("V")

_ARGUMENT = re.compile(r"\w+(?=[.,\[]| (?:must|is|are|and)\b)")
"""The argument that a message begins with; `length / diameter must` is about none."""


@dataclass(frozen=True)
class Quantity:
    """Reader of a physical quantity: a number in `unit`, or a string with its own unit.

    Attributes
    ----------
    unit : str
        SI unit, a key of `rotorfilm.core.units.UNITS`.
    twice : str
        Another key that may give twice the value instead, as `diameter` for `radius`; empty for none.
    absolute : bool
        Whether it is a temperature, in K or degC, and not a difference.
    """

    unit: str
    twice: str = ""
    absolute: bool = False

    def __call__(self, where: str, value: Any) -> float:
        """Return the value in SI; raise SceneError if it is no such quantity."""
        if isinstance(value, bool) or not isinstance(value, int | float | str):
            raise SceneError(
                f"{where} must be a number or a string such as '1 {self.unit}', got {brief(value)}"
            )
        try:
            return self.parse(value)
        except InputError as error:
            raise SceneError(f"{where}: {error}") from None

    def parse(self, value: str | float) -> float:
        """Return the value in SI; raise InputError if it is no such quantity."""
        return parse_quantity(value, self.unit, absolute=self.absolute)


class Keyed(NamedTuple, Generic[T]):
    """A class of the physics as a table of its own parameters; what a file leaves out is the default there.

    Attributes
    ----------
    makes : type
        A dataclass, which checks its parameters.
    readers : mapping of str to Reader
        Of the parameters that a file may give.
    required : tuple of str
        Those that a file must give although they have a default.
    """

    makes: type[T]
    readers: Mapping[str, Reader] = {}
    required: tuple[str, ...] = ()


def keys_of(makes: type[T], *names: str, required: tuple[str, ...] = (), **readers: Reader) -> Keyed[T]:
    """Return a class as a table of some of its parameters, or of none.

    Parameters
    ----------
    makes : type
        A dataclass.
    *names : str
        Of the parameters whose readers follow from their types and units.
    required : tuple of str
        As in `Keyed`.
    **readers
        Of the others.
    """
    return Keyed(makes, {**{name: reader_of(makes, name) for name in names}, **readers}, required)


TableType = type[T] | Keyed[T] | Callable[[], Keyed[T]]
"""What a table is read into: a dataclass all of whose fields are keys, or one beside its readers."""


@dataclass(frozen=True)
class Table:
    """Reader of a sub-table with a fixed set of keys.

    Attributes
    ----------
    table : TableType
    """

    table: TableType[Any]

    def __call__(self, where: str, value: Any) -> Any:
        """Return the sub-table as a dataclass."""
        return read_table(self.table, f"{where}.", value)


@dataclass(frozen=True)
class TableList:
    """Reader of an array of sub-tables, each with the same fixed set of keys.

    Attributes
    ----------
    table : TableType
    """

    table: TableType[Any]

    def __call__(self, where: str, value: Any) -> tuple[Any, ...]:
        """Return the sub-tables as dataclasses."""
        if not isinstance(value, list):
            raise SceneError(f"{where} must be a list of tables, got {brief(value)}")
        return tuple(read_table(self.table, f"{where}[{k}].", entry) for k, entry in enumerate(value))


@dataclass(frozen=True)
class Variant:
    """Reader of a sub-table one key of which names one of several dataclasses.

    Attributes
    ----------
    tag : str
        That key.
    variants : mapping of str to TableType
        The dataclasses by the value of that key.
    """

    tag: str
    variants: Mapping[str, TableType[Any]]

    def __call__(self, where: str, value: Any) -> Any:
        """Return the sub-table as the dataclass that its tag names."""
        data = dict(require_table(where, value))
        if self.tag not in data:
            require_no_near_miss(f"{where}.", self.tag, data)
            raise SceneError(f"{where}.{self.tag} is required: one of {', '.join(sorted(self.variants))}")
        variant = choose(f"{where}.{self.tag}", data.pop(self.tag), self.variants)
        return read_table(variant, f"{where}.", data)


class Beside(NamedTuple):
    """Reader of further sub-tables that stand beside the fields of a table, gathered in one of them.

    Attributes
    ----------
    names : tuple of str
        Their keys; those that are fields are left to these.
    type_of : callable
        Takes such a key and returns the dataclass of its sub-table.
    """

    names: tuple[str, ...]
    type_of: Callable[[str], type]

    def __call__(self, where: str, value: Any) -> dict[str, Any]:
        """Return the sub-tables as dataclasses, by their keys."""
        return {name: read_table(self.type_of(name), f"{where}{name}.", data) for name, data in value.items()}


def choose(where: str, name: object, variants: Mapping[str, V]) -> V:
    """Return what has this name; raise SceneError if there is none."""
    require_choice(where, name, sorted(variants), SceneError)
    return variants[str(name)]


def text(where: str, value: Any) -> str:
    """Read a string of a line or two."""
    if not isinstance(value, str) or len(value) > TEXT:
        raise SceneError(f"{where} must be a string of at most {TEXT} characters, got {brief(value)}")
    return value


def flag(where: str, value: Any) -> bool:
    """Read true or false."""
    if not isinstance(value, bool):
        raise SceneError(f"{where} must be true or false, got {brief(value)}")
    return value


def require_table(where: str, value: Any) -> Mapping[str, Any]:
    """Return `value` if it is a TOML table; raise SceneError otherwise."""
    if not isinstance(value, Mapping):
        raise SceneError(f"{where} must be a table, got {brief(value)}")
    return value


def read_table(table: TableType[T], where: str, data: Any) -> T:
    """Return the TOML table `data` as the dataclass `table`.

    Parameters
    ----------
    table : TableType
    where : str
        `FILE: dotted.key.`, the prefix of each key in messages.
    data : Mapping
        What the TOML parser returned.

    Raises
    ------
    SceneError
        If a key is unknown, missing, given twice over, or its value breaks a rule.
    """
    values = dict(require_table(where.removesuffix("."), data))
    makes, readers, required = keyed(table)
    _require_known(where, values, readers)
    found = {
        name: value
        for name, reader in readers.items()
        for value in _read_field(where, name, reader, values, readers)
    }
    _require_complete(where, makes, required, found)
    try:
        return makes(**found)
    except InputError as error:
        raise SceneError(_located(where, str(error), readers, values)) from None


def _located(where: str, message: str, readers: Mapping[str, Reader], values: Mapping[str, Any]) -> str:
    """Return a message after the key that it is about, or after the table where it is about no one key."""
    begins = _ARGUMENT.match(message)
    name = begins[0] if begins else ""
    doubled = {one: twice for one, reader in readers.items() if (twice := twice_of(reader)) in values}
    if name in doubled:
        message = f"{doubled[name]} is twice the {name}, and {message}"
    told = [f"; {doubled[one]} is twice the {one}" for one in doubled if one != name and one in message]
    if name not in readers:
        return f"{where.removesuffix('.').removesuffix(': ')}: {message}{''.join(told)}"
    return f"{where}{message}{_as_written(name, readers[name], values)}{''.join(told)}"


def _as_written(name: str, reader: Reader, values: Mapping[str, Any]) -> str:
    """Return the SI unit of a key, and the text in the file if it has one."""
    if not isinstance(reader, Quantity) or reader.unit == "1":
        return ""
    key = reader.twice if reader.twice in values else name
    written = f"; {key} = {brief(values[key])}" if isinstance(values.get(key), str) else ""
    return f" [{reader.unit}{written}]"


def keyed(table: TableType[T]) -> Keyed[T]:
    """Return a table with its readers beside it; those of a plain dataclass follow from its fields."""
    if isinstance(table, Keyed):
        return table
    return _keyed(table) if isinstance(table, type) else table()


@cache
def _keyed(table: type[Any]) -> Keyed[Any]:
    hidden = getattr(table, "not_keys", ())
    return keys_of(table, *(field.name for field in fields(table) if field.name not in hidden))


@cache
def _hints(home: Callable[..., Any]) -> dict[str, Any]:
    return get_type_hints(home, include_extras=True)


def reader_of(makes: type, name: str) -> Reader:
    """Return the reader of a field: that of its annotation, or what its type and its unit ask for."""
    hint = _hints(makes)[name]
    if hasattr(hint, "__metadata__"):
        return hint.__metadata__[0]
    union = isinstance(hint, UnionType)
    kind, *others = [one for one in get_args(hint) if one is not NoneType] if union else [hint]
    many = get_args(kind) if get_origin(kind) is tuple else ()
    plain = {bool: flag, str: text}.get(kind) or COUNTS.get(name)
    if plain is not None:
        return plain
    if isinstance(kind, type) and is_dataclass(kind):
        return Table(kind)
    if many and isinstance(many[0], type) and is_dataclass(many[0]):
        return TableList(many[0])
    number = _quantity_of(makes, name)
    if many:
        return Several(number, 0, ROWS) if many[-1] is ... else Several(number, len(many), len(many))
    return matrix(number) if others else number


RADII = ("radius", "inner_radius", "outer_radius")
"""Fields that may be given as a diameter, where they are required."""


def _quantity_of(makes: type, name: str) -> Quantity:
    """Return the reader of a field that is a number; a required radius may be given as a diameter."""
    if sys.flags.optimize > 1:
        raise InputError("scene files need the units of docstrings, got a Python that runs without (-OO)")
    bare = makes.__dataclass_fields__[name].default is dataclasses.MISSING  # type: ignore[attr-defined]
    twice = name.replace("radius", "diameter") if name in RADII and bare else ""
    return Quantity(si_name(units_of(makes)[name]), twice, name in temperatures_of(makes))


def _require_known(where: str, values: Mapping[str, Any], readers: Mapping[str, Reader]) -> None:
    known = {key: None for name, reader in readers.items() for key in _keys(name, reader) if key}
    for key in values:
        if key not in known:
            raise SceneError(
                f"{where}{shortened(key)} is no known key; known here: {', '.join(known)}"
                f"{nearest(key, known)}"
            )


def _read_field(
    where: str, name: str, reader: Reader, values: Mapping[str, Any], fields: Iterable[str]
) -> list[Any]:
    """Return a list of the value of one field, or an empty list when the file does not give it."""
    if isinstance(reader, Beside):
        beside = {key: values[key] for key in reader.names if key in values and key not in fields}
        return [reader(where, beside)]
    twice = twice_of(reader)
    if name in values and twice in values:
        raise SceneError(f"{where}{name} and {where}{twice} must not both be given")
    if name in values:
        return [reader(where + name, values[name])]
    return [0.5 * reader(where + twice, values[twice])] if twice in values else []


def _keys(name: str, reader: Reader) -> tuple[str, ...]:
    """Return the keys that a field is read from."""
    return reader.names if isinstance(reader, Beside) else (name, twice_of(reader))


def twice_of(reader: Reader) -> str:
    """Return the key that gives twice the value of this reader; empty for none."""
    return reader.twice if isinstance(reader, Quantity) else ""


def _require_complete(where: str, makes: type, required: Sequence[str], found: Mapping[str, Any]) -> None:
    for field in dataclasses.fields(makes):
        bare = field.default is dataclasses.MISSING and field.default_factory is dataclasses.MISSING
        if (bare or field.name in required) and field.name not in found:
            raise SceneError(f"{where}{field.name} is required and missing")


# Readers of values that several tables of a scene have.


R = TypeVar("R", bound=Reader)


def takes(*shapes: Any) -> Callable[[R], R]:
    """Say of a reader that is a function what it reads, for the JSON Schema of scene files.

    Parameters
    ----------
    *shapes
        Alternatives: each a reader; a list of shapes, its last one `...` for any number of the one before;
        a mapping whose keys are names; a tuple of alternatives.
    """

    def told(reader: R) -> R:
        reader.takes = shapes  # type: ignore[attr-defined]
        return reader

    return told


def one_of(names: Mapping[str, Any]) -> Callable[[str, Any], str]:
    """Return a reader of one of the keys of a mapping."""

    @takes(names)
    def read(where: str, value: Any) -> str:
        require_choice(where, value, names, SceneError)
        return str(value)

    return read


@dataclass(frozen=True)
class Several:
    """Reader of a list of values of one kind.

    Attributes
    ----------
    each : Reader
        Of an entry.
    least, most : int
        How many there may be.
    wording : str
        What the list must be, for messages; empty for quantities.
    """

    each: Reader
    least: int
    most: int
    wording: str = ""

    @property
    def takes(self) -> tuple[Any, ...]:
        """What it reads, as `takes` has it."""
        return ([self.each] * self.least if self.least == self.most else [self.each, ...],)

    def __call__(self, where: str, value: Any) -> tuple[Any, ...]:
        """Return the values."""
        if not isinstance(value, list) or not self.least <= len(value) <= self.most:
            unit = ""
            if isinstance(self.each, Quantity) and self.each.unit != "1":
                unit = f" in {self.each.unit}"
            usual = "two quantities [x, y]" if self.most == 2 else "a list of quantities"
            raise SceneError(f"{where} must be {self.wording or usual + unit}, got {brief(value)}")
        return tuple(self.each(f"{where}[{index}]", entry) for index, entry in enumerate(value))


def matrix(each: Quantity) -> Reader:
    """Return the reader of one quantity, the same along x and y, or of 2 x 2 of them."""
    rows = Several(Several(each, 2, 2), 2, 2)

    @takes(each, [[each, each], [each, each]])
    def read(where: str, value: Any) -> Any:
        if not isinstance(value, list):
            return each(where, value)
        if len(value) != 2 or any(not isinstance(row, list) or len(row) != 2 for row in value):
            raise SceneError(f"{where} must be one quantity or 2 x 2 of them, got {brief(value)}")
        return rows(where, value)

    return read


NEWTONS = Several(Quantity("N"), 2, 2, "one magnitude or two components [x, y]")


@takes(Quantity("N"), *NEWTONS.takes)
def read_load(where: str, value: Any) -> tuple[float, float]:
    """Read a load [N]: one positive magnitude, which acts along -y, or the two components [x, y]."""
    if isinstance(value, list):
        x, y = NEWTONS(where, value)
        return x, y
    magnitude = Quantity("N")(where, value)
    if magnitude == 0.0:
        raise SceneError(f"{where} must not be zero, got {brief(value)}: {UNLOADED}")
    if not magnitude > 0.0:
        raise SceneError(f"{where} must be a positive magnitude or two components [x, y], got {brief(value)}")
    return 0.0, -magnitude


@takes(Quantity("N"), *NEWTONS.takes)
def read_static_load(where: str, value: Any) -> tuple[float, float]:
    """Read a load [N] as `read_load` does, or none: preloaded balls carry themselves."""
    none = not isinstance(value, list) and Quantity("N")(where, value) == 0.0
    return (0.0, 0.0) if none else read_load(where, value)


@dataclass(frozen=True)
class Count:
    """Reader of a whole number.

    Attributes
    ----------
    most : int
        The largest one, of `rotorfilm.core.limits`.
    least : int
        The smallest one.
    """

    most: int
    least: int = 1

    def __call__(self, where: str, value: Any) -> int:
        """Return the number; raise SceneError if it is none or beyond the limits."""
        if isinstance(value, bool) or not isinstance(value, int) or not self.least <= value <= self.most:
            raise SceneError(
                f"{where} must be a whole number from {self.least} to {self.most}, got {brief(value)}"
            )
        return value


def counts(names: Sequence[str], most: int) -> Reader:
    """Return a reader of a list of positive whole numbers, whose product is limited.

    Parameters
    ----------
    names : sequence of str
        What they are.
    most : int
        Their largest product, of `rotorfilm.core.limits`.
    """
    each = Several(Count(most), len(names), len(names), f"[{', '.join(names)}]")

    @takes(*each.takes)
    def read(where: str, value: Any) -> tuple[int, ...]:
        found = each(where, value)
        if math.prod(found) > most:
            raise SceneError(f"{where} must multiply to at most {most}, got {brief(value)}")
        return found

    return read


def named(variants: Mapping[str, Callable[[], Any]]) -> Reader:
    """Return a reader of the name of one of several things that have no parameters."""

    @takes(variants)
    def read(where: str, value: Any) -> Any:
        return choose(where, value, variants)()

    return read


COUNTS: dict[str, Reader] = {
    "node": Count(SHAFT_ELEMENTS, 0),
    "cells": counts(("around", "along"), FILM_CELLS),
}
"""Readers of whole numbers, whose limits no type tells, by the name of the key."""


# Records of a scene file: rows of numbers in a CSV file next to it, or in the scene itself.


Record = tuple[tuple[float, ...], ...]
"""Columns: the first rises, one or two more."""

ROWS = 1_000_000
"""Largest number of rows."""


def record_of(*headings: str) -> Reader:
    """Return the reader of a record: the name of a CSV file, from the folder of the scene on, or of its rows.

    Columns are separated by commas, in SI. A first line of a file that is no numbers must be the headings of
    its columns.
    """

    @takes(text, [[Quantity("1"), ...], ...])
    def read(where: str, value: Any) -> Record:
        rows = value if isinstance(value, list) else _rows_of(where, value, headings)
        return _columns(where, value, rows)

    return read


def _columns(where: str, value: Any, rows: list[Any]) -> Record:
    """Return the columns of rows; raise SceneError where they are no record."""
    columns = len(rows[0]) if rows and isinstance(rows[0], list) else 0
    if not 2 <= len(rows) <= ROWS or columns not in (2, 3):
        raise SceneError(f"{where} must be 2 to {ROWS} rows of 2 or 3 numbers, got {brief(value)}")
    for number, row in enumerate(rows):
        if not isinstance(row, list) or len(row) != columns or not all(map(_is_number, row)):
            raise SceneError(f"{where}: row {number} must be {columns} numbers, got {brief(row)}")
    table = tuple(zip(*(tuple(map(float, row)) for row in rows), strict=True))
    if any(b <= a for a, b in zip(table[0], table[0][1:], strict=False)):
        raise SceneError(f"{where}: the first column must increase strictly, and does not")
    return table


def _rows_of(where: str, value: Any, headings: Sequence[str]) -> list[Any]:
    """Return the rows of a CSV file, without its headings."""
    path = Path(where.partition(": ")[0]).parent / text(where, value)
    try:
        lines = read_text(path).splitlines()
    except (OSError, ValueError) as error:
        raise SceneError(f"{where} must be a file of rows of numbers, got {value!r}: {error}") from None
    cells = [line.split(",") for line in lines if line.strip()]
    rows = [[_number(cell) for cell in row] for row in cells]
    if not rows or any(_is_number(cell) for cell in rows[0]):
        return rows
    _require_headings(where, cells[0], headings)
    return rows[1:]


def _require_headings(where: str, cells: Sequence[str], headings: Sequence[str]) -> None:
    """Raise SceneError unless columns are those that are wanted, in their order and units."""
    if len(cells) > len(headings):
        raise SceneError(f"{where} must have at most {len(headings)} columns, got {brief(cells)}")
    for number, (cell, wanted) in enumerate(zip(cells, headings, strict=False), 1):
        found = " ".join(cell.strip(' "').split())
        if found != wanted:
            raise SceneError(f"{where}: column {number} must be {wanted}, got {brief(found)}")


def _number(cell: str) -> float | str:
    try:
        return float(cell)
    except ValueError:
        return cell.strip()


def _is_number(cell: Any) -> bool:
    return isinstance(cell, int | float) and not isinstance(cell, bool) and math.isfinite(cell)


# What a dotted key of a scene file is read as.


def quantity_of(table: TableType[Any], path: Sequence[str]) -> Quantity | None:
    """Return the reader of a key, given by its parts; None where it is none of a `Quantity`."""
    if not path:
        return None
    first, *rest = path
    readers = keyed(table).readers
    doubled = {twice_of(reader): reader for reader in readers.values()}
    reader = readers.get(first) or doubled.get(first)
    if isinstance(reader, Quantity):
        return None if rest else reader
    if isinstance(reader, Table | TableList):
        return quantity_of(reader.table, rest[isinstance(reader, TableList) :])
    beside = next((one for one in readers.values() if isinstance(one, Beside) and first in one.names), None)
    return None if beside is None else quantity_of(beside.type_of(first), rest)
