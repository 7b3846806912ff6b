"""The base of results: printed, shown in notebooks and handed on by what their docstrings say."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import fields, is_dataclass
from importlib import import_module
from typing import Any, ClassVar, NamedTuple

import numpy as np

from ..errors import LONGEST, visible
from . import frames
from .docstrings import explained
from .quantities import is_number, label_of, texts

Row = tuple[str, str]

MANY = 12
"""Results in a tuple beyond which only the first and the last are shown."""


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
    """Yield what a dataclass holds, and further properties; the series of a mapping one by one."""
    own = value._own_units() if isinstance(value, Readable) else {}
    unset = {one.name for one in fields(value) if one.default is None and getattr(value, one.name) is None}
    for name in (*(one.name for one in fields(value) if not one.name.startswith("_")), *further):
        if name in unset:
            continue
        held, said = getattr(value, name), explained(type(value), name)
        if isinstance(held, Mapping) and any(_is_measured(one) for one in held.values()):
            for key, one in held.items():
                below = key if name == SERIES else f"{name}_{key}"
                yield Item(below, one, own.get(key, said.unit), said.shape)
        elif name != UNITS:
            absolute = name.endswith("temperature") and "above ambient" not in said.meaning.lower()
            yield Item(name, held, own.get(name, said.unit), said.shape, absolute and said.unit == "K")


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


class Readable:
    """A result that people, notebooks and tables read with units; its docstring says which."""

    _shown: ClassVar[tuple[str, ...]] = ()
    """Properties that are shown behind the fields."""

    _along: ClassVar[str] = ""
    """Dimension along which the rows of a data frame run, where it is not that of the first series."""

    def __init_subclass__(cls) -> None:
        super().__init_subclass__()
        cls.__repr__ = Readable.__repr__  # type: ignore[method-assign]  # a dataclass keeps what is there

    def _own_units(self) -> Mapping[str, str]:
        """Return units that only the result itself knows, by the name of the field or of the entry in it."""
        return {}

    def _items(self) -> Iterator[Item]:
        """Yield what goes into data frames and data sets."""
        return items_of(self, self._shown)

    def to_rows(self) -> list[Row]:
        """Return names and values with their units, a row for each; of a result in it, all of its rows."""
        return rows_of(items_of(self, self._shown))

    def __repr__(self) -> str:
        return f"{type(self).__name__}({in_one_line(self.to_rows())})"

    def __str__(self) -> str:
        shown = self.to_rows()
        width = max((len(label) for label, _ in shown), default=0)
        lines = [f"{visible(label):{width}}  {visible(text)}".rstrip() for label, text in shown]
        return "\n".join([type(self).__name__, *lines])

    def _repr_pretty_(self, printer: Any, cycle: bool) -> None:
        printer.text("..." if cycle else str(self))

    def _repr_html_(self) -> str:
        from html import escape  # with a table of all letters, which no calculation needs

        lines = "".join(
            f'<tr><th style="text-align:left">{escape(visible(label)).replace("  ", "&#8195;")}</th>'
            f'<td style="text-align:left"><pre style="margin:0">{escape(visible(text))}</pre></td></tr>'
            for label, text in self.to_rows()
        )
        return f"<table><caption>{type(self).__name__}</caption><tbody>{lines}</tbody></table>"

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

    def to_dataframe(self) -> Any:
        """Return the numbers as a pandas.DataFrame, with all units in its `attrs`, by column.

        Its rows run along the first series, as the time; what does not is in `attrs`. Without a series there
        is one row. Vectors and matrices have a column for each entry, as `position_x` and `stiffness_xy`;
        complex numbers have two, which end in `_real` and `_imag`.

        Raises
        ------
        AbsentError
            If pandas is not installed.
        """
        return self._handed(frames.to_frame)

    def _handed(self, make: Callable[..., Any]) -> Any:
        arrays, notes = _arrays(self._items())
        arrays = frames.consistent(arrays)
        first = fields(self)[0].name  # type: ignore[arg-type]
        along = self._along or frames.rows_of(arrays)
        index = first if first in arrays and arrays[first].dims == (along,) else ""
        return make(arrays, index, along, {"title": type(self).__name__, **notes})


class Drawable(Readable):
    """A result that has a picture."""

    def plot(self, *, axes: Any = None) -> Any:
        """Draw the result by its function of `rotorfilm.charts`.

        Parameters
        ----------
        axes : Axes, or several of them where the picture has several, optional
            Where to draw; a new figure by default.

        Returns
        -------
        Axes, or several of them
        """
        # Found late: charts stand above results.
        return import_module("..charts", __package__).plot_result(self, axes=axes)


def _rows(item: Item) -> list[Row]:
    """Return the rows of one thing that a result holds."""
    label, value = label_of(item.name), item.value
    if isinstance(value, Readable) or (is_dataclass(value) and len(_line(value)) > LONGEST):
        inside = rows_of(items_of(value, getattr(value, "_shown", ())))
        return [(label, ""), *((f"  {inner}", text) for inner, text in inside)]
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
            inner, said = _arrays(items_of(value, value._shown))
            found |= {f"{name}_{key}": one for key, one in inner.items()}
            notes |= {f"{name}_{key}": one for key, one in said.items()}
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
