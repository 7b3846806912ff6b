"""The base of results: printed, shown in notebooks and handed on by what their docstrings say."""

from __future__ import annotations

import inspect
import math
import re
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import fields, is_dataclass
from enum import Enum
from functools import cache
from pathlib import Path
from typing import Any, ClassVar, NamedTuple, TypeVar

import numpy as np

from . import frames
from .errors import LONGEST, shortened, visible
from .sources import offered
from .units import CELSIUS, DISPLAY_UNITS

Row = tuple[str, str]

T = TypeVar("T")

MANY = 12
"""Results in a tuple beyond which only the first and the last are shown, and rows of a table."""


SERIES, UNITS = "signals", "units"
"""Fields of signals by their names, and of their units."""


class Item(NamedTuple):
    """One thing that a result holds.

    Attributes
    ----------
    name : str
    value : object
    unit : str
    shape : tuple of str
        Names of the dimensions of an array.
    absolute : bool
        Whether it is a temperature in K, which people read in degC, and no difference.
    """

    name: str
    value: Any
    unit: str
    shape: tuple[str, ...]
    absolute: bool = False


def items_of(value: Any, further: Iterable[str] = ()) -> Iterator[Item]:
    """Return what a dataclass holds, and further properties; the series of a mapping one by one."""
    found = _held(value, further)
    return value._entries(found) if isinstance(value, Readable) else found


def _held(value: Any, further: Iterable[str]) -> Iterator[Item]:
    own = value._own_units() if isinstance(value, Readable) else {}
    unset = {one.name for one in fields(value) if one.default is None and getattr(value, one.name) is None}
    for name in (*(one.name for one in fields(value) if not one.name.startswith("_")), *further):
        if name in unset:
            continue
        held, wording = getattr(value, name), explained(type(value), name)
        if isinstance(held, Mapping) and any(_is_measured(one) for one in held.values()):
            for key, one in held.items():
                below = key if name == SERIES else f"{name}_{key}"
                yield Item(below, one, own.get(key, wording.unit), wording.shape)
        elif name != UNITS:
            absolute = name.endswith("temperature") and "above ambient" not in wording.meaning.lower()
            yield Item(
                name, held, own.get(name, wording.unit), wording.shape, absolute and wording.unit == "K"
            )


def _is_measured(value: Any) -> bool:
    """Return whether an entry of a mapping is shown by itself, as a counter is not."""
    return isinstance(value, np.ndarray | Readable | float)


def rows_of(items: Iterable[Item]) -> list[Row]:
    """Return names and values with their units, a row for each.

    What a result in it repeats of a result of another kind is left out.
    """
    found: list[Row] = []
    told: dict[Row, type] = {}
    for item in items:
        kind = type(item.value)
        new = [row for row in _rows(item) if told.get(row, kind) is kind]
        told |= {row: kind for row in new if row[1] and row[0][:1].isspace()}
        found += new
    return found


def rows(**things: Any) -> list[Row]:
    """Return the rows of several things, by their names."""
    return rows_of(Item(name, value, "", ()) for name, value in things.items())


class Tabled:
    """What gives a table: its data frame, CSV and JSON."""

    def to_table(self) -> frames.ResultTable:
        """Return the numbers as columns with units."""
        raise NotImplementedError

    def to_dataframe(self) -> Any:
        """Return `to_table` as a pandas.DataFrame, its units by column in `attrs`, and its notes.

        Raises
        ------
        AbsentError
            If pandas is not installed.
        """
        return self.to_table().to_dataframe()

    def to_csv(self, path: Path | str) -> Path:
        """Write `to_table` as CSV, units in the headings; return the path."""
        return self.to_table().to_csv(path)

    def to_json(self) -> str:
        """Return `to_table` as JSON: title, units, columns and notes; what is not finite is null."""
        return self.to_table().to_json()


# Equality of inputs and results: that of their fields, arrays number by number.


HASHED = 16
"""Entries along each axis of an array that its hash depends on."""


def compared_by_value(cls: type) -> None:
    """Let a dataclass that compares its fields do so where they are arrays, and have a hash with them."""
    cls.__eq__ = _equal  # type: ignore[method-assign, assignment]
    cls.__hash__ = _hash  # type: ignore[method-assign, assignment]


def _equal(self: Any, other: Any) -> Any:
    if self is other:
        return True
    if other.__class__ is not self.__class__ or not self.__dataclass_params__.eq:
        return NotImplemented
    return all(same(getattr(self, one.name), getattr(other, one.name)) for one in fields(self) if one.compare)


def same(one: Any, other: Any) -> bool:
    """Return whether two values are equal, with arrays in them number by number."""
    if one is other:
        return True
    if isinstance(one, np.ndarray) or isinstance(other, np.ndarray):
        one, other = np.asarray(one), np.asarray(other)
        return np.array_equal(one, other, equal_nan=one.dtype.kind in "fc" and other.dtype.kind in "fc")
    if isinstance(one, tuple | list) and isinstance(other, tuple | list):
        return len(one) == len(other) and all(map(same, one, other))
    if isinstance(one, Mapping) and isinstance(other, Mapping):
        return one.keys() == other.keys() and all(same(one[name], other[name]) for name in one)
    return bool(one == other or (one != one and other != other))  # NaN stands for the same as NaN


def _hash(self: Any) -> int:
    if not self.__dataclass_params__.eq:
        return object.__hash__(self)
    return hash(tuple(_hashed(getattr(self, one.name)) for one in fields(self) if one.compare))


def _hashed(value: Any) -> Any:
    """Return what has the hash of a value; that of an array or a list depends on its first entries."""
    if isinstance(value, np.ndarray):
        value = value[:HASHED].tolist() if value.ndim else value.item()
    if isinstance(value, tuple | list):
        return tuple(map(_hashed, value[:HASHED]))
    if isinstance(value, float | complex) and value != value:
        return None
    return frozenset(value) if isinstance(value, Mapping) else value


class Readable(Tabled):
    """A result that people, notebooks and tables read with units; its docstring says which.

    A result that reads as a table says its columns in `to_table`, what is printed of them in `_pages`, and
    which of its fields these show in `_tabled`.
    """

    _shown: ClassVar[tuple[str, ...]] = ()
    """Properties that are shown behind the fields."""

    _tabled: ClassVar[tuple[str, ...]] = ()
    """Fields and properties that its pages show, which have no row of their own in print."""

    _along: ClassVar[str] = ""
    """Dimension along which the rows of a data frame run, where it is not that of the first series."""

    def __init_subclass__(cls) -> None:
        super().__init_subclass__()
        cls.__repr__ = Readable.__repr__  # type: ignore[method-assign]  # a dataclass keeps what is there
        compared_by_value(cls)

    def _own_units(self) -> Mapping[str, str]:
        """Return units that only the result itself knows, by the name of the field or of the entry in it."""
        return {}

    def _entries(self, items: Iterator[Item]) -> Iterator[Item]:
        """Return items with those in their place that people read in their stead."""
        return items

    def _items(self) -> Iterator[Item]:
        """Yield what goes into data frames and data sets."""
        return items_of(self, self._shown)

    def _pages(self) -> Iterable[frames.ResultTable]:
        """Return the tables that are printed below the rows."""
        return ()

    def to_rows(self) -> list[Row]:
        """Return names and values with their units, a row for each; of a result in it, all of its rows."""
        return rows_of(items_of(self, self._shown))

    def __repr__(self) -> str:
        return f"{type(self).__name__}({in_one_line(self.to_rows())})"

    def __str__(self) -> str:
        return printed(self, self._rows(), self._pages())

    def _rows(self) -> list[Row]:
        """Return the rows above the pages."""
        items = items_of(self, self._shown)
        return (
            rows_of(one for one in items if one.name not in self._tabled) if self._tabled else self.to_rows()
        )

    def _repr_pretty_(self, printer: Any, cycle: bool) -> None:
        printer.text("..." if cycle else str(self))

    def _repr_html_(self) -> str:
        return printed_html(self, self._rows(), self._pages())

    def to_xarray(self) -> Any:
        """Return the numbers as an xarray.Dataset, each with its unit in `attrs`; texts are in its own.

        Where the first field is a series, as the time, it is the coordinate of the others. What is a vector
        has the dimension `axis`, a matrix `force_axis` and `axis`, both with x and y.

        Raises
        ------
        AbsentError
            If xarray is not installed.
        """
        return self._handed(frames.to_dataset)

    def to_table(self) -> frames.ResultTable:
        """Return the numbers as columns with units, from which data frame, CSV and JSON are made.

        Rows run along the first series, as the time; what does not is among the notes. Without a series there
        is one row. Vectors and matrices have a column for each entry, as `position_x` and `stiffness_xy`;
        complex numbers have two, which end in `_real` and `_imag`.
        """
        return self._handed(frames.to_table)

    def _handed(self, make: Callable[..., Any]) -> Any:
        arrays, notes = _arrays(self._items())
        arrays = frames.consistent(arrays)
        first = fields(self)[0].name  # type: ignore[arg-type]
        along = self._along or frames.rows_of(arrays)
        index = first if first in arrays and arrays[first].dims == (along,) else ""
        return make(arrays, index, along, {"title": type(self).__name__, **notes})


class Plottable:
    """What has pictures."""

    def plot(self, kind: str = "", *, axes: Any = None, backend: str = "") -> Any:
        """Draw a picture by its function of `rotorfilm.charts`.

        Parameters
        ----------
        kind : str
            Which picture; the usual one by default. An unknown one raises an error that lists all.
        axes : Axes, or several of them where the picture has several, optional
            Where to draw with matplotlib; a new figure by default, which `matplotlib.pyplot.show` shows.
        backend : str
            "matplotlib" or "plotly"; by default what `rotorfilm.charts.use` chose, or matplotlib.

        Returns
        -------
        Axes, or several of them; of plotly a plotly.graph_objects.Figure
        """
        return offered("plot_result")(self, kind, axes=axes, backend=backend)


class Drawable(Plottable, Readable):
    """A result that has pictures."""


# Print and notebooks: names and values, and tables below them.


def printed(thing: Any, rows: Sequence[Row], pages: Iterable[frames.ResultTable]) -> str:
    """Return the name of a class, rows and pages of an object of it as text."""
    width = max((len(label) for label, _ in rows), default=0)
    lines = [f"{visible(label):{width}}  {visible(text)}".rstrip() for label, text in rows]
    return "\n".join([type(thing).__name__, *lines, *map(table_text, pages)])


def printed_html(thing: Any, rows: Sequence[Row], pages: Iterable[frames.ResultTable]) -> str:
    """Return the same as HTML."""
    from html import escape  # with a table of all letters, which no calculation needs

    lines = "".join(
        f'<tr><th style="text-align:left">{escape(visible(label)).replace("  ", "&#8195;")}</th>'
        f'<td style="text-align:left"><pre style="margin:0">{escape(visible(text))}</pre></td></tr>'
        for label, text in rows
    )
    head = f"<table><caption>{type(thing).__name__}</caption><tbody>{lines}</tbody></table>"
    tables = "".join(map(table_html, pages))
    return f"<div>{head}{tables}</div>" if tables else head


def table_of(things: Sequence[Any], title: str = "") -> frames.ResultTable:
    """Return what many objects of one dataclass hold as a table, one a row, without what is usual in all.

    A dataclass that all of them share is told in the title.
    """
    rows = [list(items_of(one, getattr(one, "_shown", ()))) for one in things]
    usual = {one.name: repr(one.default) for one in fields(things[0])}
    columns: list[frames.Column] = []
    for name in dict.fromkeys(item.name for row in rows for item in row):
        items = [next((item for item in row if item.name == name), None) for row in rows]
        first = next(item for item in items if item is not None)
        values = [None if item is None else item.value for item in items]
        if all(repr(value) == usual.get(name) for value in values):
            continue
        if all(value is None or (is_number(value) and not np.ndim(value)) for value in values):
            absolute = [math.nan if value is None else value for value in values]
            columns.append(frames.Column(name, first.unit, np.array(absolute)))
            continue
        words = ["" if item is None else _words(item) for item in items]
        if is_dataclass(first.value) and len(words) > 1 and len(set(words)) == 1:
            title += f"; {label_of(name)}: {words[0]}"
        else:
            columns.append(frames.Column(name, "", np.array(words, dtype=object)))
    return frames.ResultTable(tuple(columns), title)


def as_data_sheet(cls: type[T]) -> type[T]:
    """Let inputs print as a data sheet: what was given, with units, and tables of their parts."""

    def text(self: Any) -> str:
        return printed(self, sheet_rows(self), sheet_pages(self))

    def pretty(self: Any, printer: Any, cycle: bool) -> None:
        printer.text("..." if cycle else str(self))

    made: Any = cls
    if made.__dataclass_params__.eq and any("rray" in str(one.type) for one in fields(made)):
        compared_by_value(cls)
    cls.__str__ = text  # type: ignore[method-assign]
    cls._repr_pretty_ = pretty  # type: ignore[attr-defined]
    cls._repr_html_ = lambda self: printed_html(self, sheet_rows(self), sheet_pages(self))  # type: ignore[attr-defined]
    return cls


def sheet_rows(thing: Any) -> list[Row]:
    """Return the rows of an input: all but plain defaults, what its pages show, and what repr hides."""
    usual = {one.name: repr(one.default) for one in fields(thing)}
    hidden = {*getattr(thing, "_tabled", ()), *(one.name for one in fields(thing) if not one.repr)}
    items = items_of(thing, getattr(thing, "_shown", ()))
    told = (one for one in items if one.name not in hidden and not _is_many(one.value))
    return rows_of(one for one in told if is_dataclass(one.value) or repr(one.value) != usual.get(one.name))


def sheet_pages(thing: Any) -> Iterator[frames.ResultTable]:
    """Yield the pages of an input: its own, and a table of each tuple of parts, as the disks of a rotor."""
    for one in items_of(thing):
        if _is_many(one.value):
            yield table_of(one.value, label_of(one.name))
    yield from getattr(thing, "_pages", tuple)()


def _is_many(value: Any) -> bool:
    return isinstance(value, tuple) and bool(value) and all(is_dataclass(one) for one in value)


def table_text(table: frames.ResultTable) -> str:
    """Return a table as text, numbers to the right; of many rows some, from the first to the last."""
    columns = [[heading, *cells] for heading, cells in shown_columns(table)]
    words = [_is_words(one) for one in table.columns]
    widths = [max(map(len, column), default=0) for column in columns]
    lines = [
        "  ".join(
            f"{cell:{'<' if word else '>'}{width}}"
            for cell, word, width in zip(row, words, widths, strict=True)
        ).rstrip()
        for row in zip(*columns, strict=True)
    ]
    return "\n".join(["", *([_titled(table)] if table.title else []), *lines])


def table_html(table: frames.ResultTable, most: int = MANY) -> str:
    """Return a table as HTML, of more rows than `most` so many of them."""
    from html import escape

    columns = [[heading, *cells] for heading, cells in shown_columns(table, most)]
    heads, *rows = zip(*columns, strict=True)
    head = "".join(f"<th>{escape(cell)}</th>" for cell in heads)
    body = "".join(f"<tr>{''.join(f'<td>{escape(cell)}</td>' for cell in row)}</tr>" for row in rows)
    title = escape(_titled(table, most))
    return f"<table><caption>{title}</caption><tbody><tr>{head}</tr>{body}</tbody></table>"


def shown_columns(table: frames.ResultTable, most: int = MANY) -> list[tuple[str, list[str]]]:
    """Return heading and cells of each column, in a unit of the size of its numbers."""
    return [_shown_column(one, most) for one in table.columns]


def _titled(table: frames.ResultTable, most: int = MANY) -> str:
    count = len(table.columns[0].values) if table.columns else 0
    return f"{table.title} ({most} of {count} rows)" if count > most else table.title


def _is_words(column: frames.Column) -> bool:
    return np.asarray(column.values).dtype.kind in "OU"


def _shown_column(column: frames.Column, most: int) -> tuple[str, list[str]]:
    values, heading = np.asarray(column.values), column.heading or label_of(column.name)
    if len(values) > most:
        values = values[np.linspace(0, len(values) - 1, most).round().astype(int)]
    if _is_words(column):
        return heading, ["" if one is None else visible(str(one)) for one in values]
    if values.dtype.kind in "iub":
        return heading, [_number(one) for one in values]
    unit, numbers = column_scale(column.name, column.unit, values)
    cells = [f"{one + 0.0:.5g}" if np.isfinite(one) else "-" for one in numbers]
    return f"{heading} [{unit}]" if unit else heading, cells


def column_scale(name: str, unit: str, values: np.ndarray) -> tuple[str, np.ndarray]:
    """Return the unit in which people read numbers of a quantity, and the numbers in it."""
    if unit == "rad/s":
        turns = ("Hz", 0.5 / math.pi) if "frequency" in name else ("rpm", 30.0 / math.pi)
        return turns[0], values * turns[1]
    if unit == "K" and name.endswith("temperature"):
        return "degC", values - CELSIUS
    shown, factor = _scale(unit, float(np.abs(values[np.isfinite(values)]).max(initial=0.0)))
    return shown, values / factor if factor != 1.0 else values


def _rows(item: Item) -> list[Row]:
    """Return the rows of one thing that a result holds."""
    label, value = label_of(item.name), item.value
    if isinstance(value, Readable) or (is_dataclass(value) and len(_line(value)) > LONGEST):
        inside = value.to_rows() if isinstance(value, Readable) else sheet_rows(value)
        head = "" if inside else f"{type(value).__name__}()"
        return [(label, head), *((f"  {inner}", text) for inner, text in inside)]
    if isinstance(value, tuple | list) and any(is_dataclass(one) for one in value):
        return [(f"{label} {k}", _line(one) or "empty") for k, one in _ends(value)]
    unit = "degC" if item.absolute else item.unit
    lines = [_line(value)] if is_dataclass(value) else texts(item.name, value, unit)
    return [(label if k == 0 else "", line) for k, line in enumerate(lines)]


def _ends(results: Iterable[Any]) -> list[tuple[int, Any]]:
    """Return results with their numbers from 1: all, or of many the first and the last."""
    numbered = list(enumerate(results, start=1))
    return numbered if len(numbered) <= MANY else [numbered[0], numbered[-1]]


def _line(value: Any) -> str:
    """Return a dataclass in one line; of one that is no result its name too."""
    if isinstance(value, Readable):
        return in_one_line(value.to_rows())
    return f"{type(value).__name__}({in_one_line(rows_of(items_of(value)))})"


def in_one_line(rows: Iterable[Row]) -> str:
    """Return rows as one line."""
    line = ""
    for label, text in rows:
        comma = ", " if line and not line.endswith(": ") else ""
        line += f"{comma}{label.strip()}: " if label.strip() else "; "
        line += " ".join(text.split())
    return line


def _arrays(items: Iterable[Item]) -> tuple[frames.Arrays, dict[str, Any]]:
    """Return the arrays of a result, and what is said of it in words."""
    found: frames.Arrays = {}
    notes: dict[str, Any] = {}
    for name, value, unit, shape, *_ in items:
        if isinstance(value, Readable):
            inner, wording = _arrays(items_of(value, value._shown))
            found |= {f"{name}_{key}": one for key, one in inner.items()}
            notes |= {f"{name}_{key}": one for key, one in wording.items()}
        elif isinstance(value, tuple) and value and all(isinstance(one, Readable) for one in value):
            found |= _stacked(name, (*shape, name)[0], value)
        elif is_number(value) or (value is None and unit):
            values = np.asarray(np.nan if value is None else value)
            found[name] = frames.LabeledArray(frames.dimensions(name, shape, values.ndim), values, unit)
        elif isinstance(value, Mapping):
            notes |= {f"{name}_{key}": one for key, one in value.items()}
        else:
            notes[name] = _words(Item(name, value, unit, shape))
    return found, notes


def _stacked(name: str, dim: str, results: Sequence[Any]) -> frames.Arrays:
    """Return the arrays of many results of one kind."""
    found: frames.Arrays = {}
    parts = [list(items_of(one, one._shown)) for one in results]
    for items in zip(*parts, strict=False):
        key, values = f"{name}_{items[0].name}", [item.value for item in items]
        if all(isinstance(one, Readable) for one in values):
            found |= _stacked(key, dim, values)
        elif all(one is None or is_number(one) for one in values):
            found |= frames.stacked(key, dim, values, items[0].shape, items[0].unit)
        else:
            words = np.array([_words(item) for item in items], dtype=object)
            found[key] = frames.LabeledArray((dim,), words, "")
    return found


def _words(item: Item) -> str:
    """Return something that is no number as text."""
    return "; ".join(text for _, text in _rows(item))


# What numpydoc docstrings say of names: unit, type and meaning.


SECTIONS = ("Parameters", "Attributes")
ENTRY = re.compile(r"(\w+(?:, \w+)*) : (.+)")
UNIT = re.compile(r"\[([^\[\]]+)\]")


class Entry(NamedTuple):
    """What a docstring says of one name."""

    name: str
    unit: str
    kind: str
    meaning: str
    where: str

    @property
    def shape(self) -> tuple[str, ...]:
        """The names of the dimensions of an array, as they are written; empty where none are."""
        found = re.search(r"shape \(([^()]*)\)", self.kind)
        return tuple(part for text in found[1].split(",") if (part := text.strip())) if found else ()


def units(kind: str, count: int) -> list[str]:
    """Return the units of the names of one entry: one for each, or one for all; empty for none."""
    found = [unit for text in UNIT.findall(kind) for unit in text.split(", ")]
    return found if len(found) == count else [", ".join(dict.fromkeys(found))] * count


def entries(docstring: str, where: str) -> Iterator[Entry]:
    """Yield what the sections of a numpydoc docstring say, name by name."""
    parts = re.split(r"^(\w[\w ]*)\n-{3,}$", inspect.cleandoc(docstring), flags=re.MULTILINE)
    for title, text in zip(parts[1::2], parts[2::2], strict=True):
        if title in SECTIONS:
            for block in re.split(r"\n(?=\S)", text.strip("\n")):
                yield from _block(block, where)


def _block(block: str, where: str) -> Iterator[Entry]:
    """Yield the names of one entry of a section."""
    head, _, body = block.partition("\n")
    match = ENTRY.fullmatch(head)
    if match is None:
        raise ValueError(f"{where}: an entry must be 'name : type [unit]', got {head!r}")
    names, kind = match[1].split(", "), match[2]
    bare = re.sub(r"\s*(?:, )?\[[^\[\]]+\]", "", kind)
    for name, unit in zip(names, units(kind, len(names)), strict=True):
        yield Entry(name, unit, bare, " ".join(body.split()), where)


def explained(kind: type, name: str) -> Entry:
    """Return what is said of a field of a class, or of a property by its own docstring."""
    for one in kind.__mro__:
        found = vars(one).get(name)
        if wording := _fields(one).get(name):
            return wording
        if hasattr(found, "__get__"):
            text = " ".join((found.__doc__ or "").split())
            return Entry(name, "".join(UNIT.findall(text)[-1:]), text, text, one.__name__)
    return Entry(name, "", "", "", kind.__name__)


@cache
def _fields(kind: type) -> dict[str, Entry]:
    """Return what the docstring of a class itself says of its fields."""
    text = vars(kind).get("__doc__") or ""  # none of them in an optimized Python
    return {entry.name: entry for entry in entries(text, kind.__name__)}


# A number, an array or a dictionary as people read it: six digits, and a unit of the size of the value.


PREFIXED = {
    "m": ("m", "mm", "um", "nm"),
    "m/s": ("m/s", "mm/s", "um/s"),
    "s": ("s", "ms", "us"),
    "Pa": ("GPa", "MPa", "kPa", "Pa"),
    "kg m": ("kg m", "g mm"),
    "rad": ("deg",),
}
"""Units that are shown in place of the SI unit: the largest that leaves a value of 1 or more."""

FACTORS = {"us": 1e-6, "nm": 1e-9, "mm/s": 1e-3, "um/s": 1e-6}
"""SI units in those that `units.DISPLAY_UNITS` does not have."""

FEW = 4
"""Entries of a vector, and rows or columns of a matrix, that are shown one by one."""

ROUND_OFF = 1e-12
"""Share of the largest entry of a matrix below which another is shown as 0."""

AXES = "xy"


WORDS = {"remarks": "left out"}
"""Names that say more than themselves: remarks are what the physics leaves out."""


def label_of(name: str) -> str:
    """Return the name of a field as words."""
    return WORDS.get(name, name.strip("_").replace("_", " "))


def quantity(value: Any, unit: str, name: str = "") -> str:
    """Return a number or a short vector with its unit; "degC" is that of temperatures in K, shown in both."""
    numbers = np.asarray(value)
    if unit == "degC":
        return f"{_number(numbers)} K = {_number(numbers - CELSIUS)} degC"
    if unit == "rad/s":
        turns = ("Hz", 0.5 / math.pi) if "frequency" in name else ("rpm", 30.0 / math.pi)
        return f"{_number(numbers)} rad/s = {_number(numbers * turns[1])} {turns[0]}"
    size = np.abs(numbers[np.isfinite(numbers)]).max(initial=0.0)
    shown, factor = _scale(unit, float(size))
    return f"{_number(numbers / factor if factor != 1.0 else numbers)} {shown}".rstrip()


def _scale(unit: str, size: float) -> tuple[str, float]:
    """Return the unit in which a size is shown, in terms of the given one."""
    named = PREFIXED.get(unit, ())
    scales = [(one, FACTORS.get(one) or DISPLAY_UNITS[one].factor) for one in named]
    fitting = [(one, factor) for one, factor in scales if size >= 0.999999 * factor]
    if fitting and size > 0.0:
        return fitting[0]
    if scales:
        return scales[0 if size == 0.0 and unit != "Pa" else -1]
    return _spelled(unit), 1.0


def _spelled(unit: str) -> str:
    """Return a unit as it is written behind a number."""
    return "" if unit == "1" else unit.replace(".", " ")


def _number(value: np.ndarray) -> str:
    if value.ndim:
        return f"({', '.join(_number(entry) for entry in value)})"
    if value.dtype.kind == "b":
        return "yes" if value else "no"
    if value.dtype.kind == "c":
        return f"{value.real:.6g}{value.imag:+.6g}i"
    if value.dtype.kind in "iu":
        return str(value)
    return f"{float(value) + 0.0:.6g}" if value.dtype.kind == "f" else shortened(str(value))


def is_number(value: object) -> bool:
    """Return whether a value is a number or an array of numbers, or of what is true and false."""
    return isinstance(value, (bool, int, float, complex, np.generic, np.ndarray))


def texts(name: str, value: Any, unit: str) -> list[str]:
    """Return the lines that show a value which is no result; none where it is empty."""
    if value is None:
        return ["none"]
    if isinstance(value, Enum):
        return [str(value.value)]
    if isinstance(value, str):
        return [value] if value else []
    if isinstance(value, Mapping):
        counts = ", ".join(f"{shortened(str(n))} {label_of(str(key))}" for key, n in value.items())
        return [counts] if value else []
    if isinstance(value, tuple | list):
        if all(isinstance(entry, int | float) for entry in value):
            value = np.array(value)
        else:
            return [line for entry in value for line in texts(name, entry, unit)]
    return _array(name, np.asarray(value), unit) if is_number(value) else [shortened(str(value))]


def _array(name: str, value: np.ndarray, unit: str) -> list[str]:
    if value.ndim == 0 or (value.ndim == 1 and 0 < value.size <= FEW):
        return [quantity(value, unit, name)]
    if value.dtype.kind not in "fiucb":
        return [shortened(str(value))] if value.size else []
    if value.shape == (2, 2) and value.dtype.kind != "b":
        value = without_round_off(value)
        rows = [[f"{a}{b} {value[i, j] + 0.0:14.7g}" for j, b in enumerate(AXES)] for i, a in enumerate(AXES)]
        return [f"{'   '.join(row)} {_spelled(unit)}".rstrip() for row in rows]
    return [_summary(name, value, unit)] if value.size else []


def without_round_off(value: np.ndarray) -> np.ndarray:
    """Return the entries of a matrix to be shown, 0 where it is round-off beside the largest."""
    size = np.abs(value)
    return np.where(size < ROUND_OFF * size.max(initial=0.0), 0.0, value)


def _summary(name: str, value: np.ndarray, unit: str) -> str:
    """Return the shape of an array and its smallest and largest number."""
    shape = " x ".join(map(str, value.shape))
    if value.dtype.kind == "b":
        return f"{shape}, {np.count_nonzero(value)} yes"
    known = np.abs(value) if value.dtype.kind == "c" else value
    known = known[np.isfinite(known)]
    if not known.size:
        return f"{shape}, no finite number"
    ends = quantity(known.min(), unit, name), quantity(known.max(), unit, name)
    return f"{shape}, {'sizes ' if value.dtype.kind == 'c' else ''}from {ends[0]} to {ends[1]}"
