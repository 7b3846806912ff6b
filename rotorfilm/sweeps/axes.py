"""What varies in a sweep: keys of a scene file, their values, and the points these make."""

from __future__ import annotations

import contextlib
import copy
import math
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from itertools import product
from typing import Any

import numpy as np

from ..errors import InputError, SceneError
from ..limits import SWEEP_POINTS, require_at_most
from ..scenes.reading.tables import Quantity, quantity_of
from ..scenes.scene import Scene, read_scene
from ..units import UNITS, whole_number

Values = Sequence[Any] | tuple[str, Sequence[Any]]
"""Values of a key, a dimension of their own; or (dimension, values), to share it as samples do."""


@dataclass(frozen=True, kw_only=True)
class Axis:
    """A key that varies along a dimension.

    Attributes
    ----------
    key : str
        Dotted, as `journal.clearance`; entries of lists by their number, as `shaft.disks.0.width`.
    dimension : str
        Of the dataset.
    values : tuple
        As a scene file would have them.
    """

    key: str
    dimension: str
    values: tuple[Any, ...]

    @property
    def name(self) -> str:
        """Name of its coordinate: the key with underscores for dots."""
        return self.key.replace(".", "_")

    def coordinate(self) -> tuple[list[Any], str]:
        """Return the values as numbers in SI with their unit, or as text where they are no quantities."""
        known = quantity_of(Scene, self.key.split("."))
        if known is None and all(_is_number(value) for value in self.values):
            return list(self.values), ""
        for reader in map(Quantity, UNITS) if known is None else (known,):
            with contextlib.suppress(InputError):
                return [reader.parse(value) for value in self.values], reader.unit
        return [str(value) for value in self.values], ""


def read_axes(parameters: Mapping[str, Values]) -> tuple[Axis, ...]:
    """Return what varies.

    Raises
    ------
    InputError
        If nothing does, a key has no values, values that share a dimension are not as many, or the points are
        too many.
    """
    axes = tuple(_axis(key, values) for key, values in parameters.items())
    if not axes:
        raise InputError("parameters must name at least one key, got none")
    lengths: dict[str, int] = {}
    for axis in axes:
        if not axis.values:
            raise InputError(f"parameters[{axis.key!r}] must have at least one value, got none")
        if lengths.setdefault(axis.dimension, len(axis.values)) != len(axis.values):
            raise InputError(
                f"parameters[{axis.key!r}] must have {lengths[axis.dimension]} values, as others along "
                f"{axis.dimension!r}, got {len(axis.values)}"
            )
    require_at_most("points of a sweep", math.prod(lengths.values()), SWEEP_POINTS)
    return axes


def _axis(key: str, values: Values) -> Axis:
    shared = isinstance(values, tuple) and len(values) == 2 and isinstance(values[0], str)
    if shared and not isinstance(values[1], str) and isinstance(values[1], Sequence | np.ndarray):
        return Axis(key=key, dimension=str(values[0]), values=_plain(key, values[1]))
    return Axis(key=key, dimension=key.replace(".", "_"), values=_plain(key, values))


def _plain(key: str, values: Any) -> tuple[Any, ...]:
    if isinstance(values, str) or not isinstance(values, Sequence | np.ndarray):
        raise InputError(f"parameters[{key!r}] must be a sequence of values, got {values!r}")
    return tuple(value.item() if isinstance(value, np.generic) else value for value in values)


def _is_number(value: object) -> bool:
    return isinstance(value, int | float) and not isinstance(value, bool) and math.isfinite(value)


def sizes(axes: Sequence[Axis]) -> dict[str, int]:
    """Return the length of each dimension, in the order in which they come up."""
    return {axis.dimension: len(axis.values) for axis in axes}


def points(axes: Sequence[Axis]) -> Iterator[dict[str, Any]]:
    """Yield the values of all keys at each point, the last dimension fastest."""
    lengths = sizes(axes)
    for place in product(*(range(length) for length in lengths.values())):
        index = dict(zip(lengths, place, strict=True))
        yield {axis.key: axis.values[index[axis.dimension]] for axis in axes}


def varied(scene: Mapping[str, Any], values: Mapping[str, Any]) -> dict[str, Any]:
    """Return the tables of a scene file with other values at some keys.

    Raises
    ------
    SceneError
        If a key leads through something that is no table or list.
    """
    data = copy.deepcopy(dict(scene))
    for key, value in values.items():
        *path, last = key.split(".")
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
    raise SceneError(f"parameters[{key!r}] must lead through tables of the scene, got no {part!r}")


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
        raise SceneError(f"parameters[{key!r}] must lead through tables of the scene, got no {last!r}")


def check(scene: Mapping[str, Any], axes: Sequence[Axis], source: str) -> None:
    """Read one scene with each value in turn, so that a wrong key or value is found before the work.

    Raises
    ------
    SceneError
        As a scene file raises it.
    """
    first = next(points(axes))
    for axis in axes:
        for value in axis.values:
            read_scene(varied(scene, {**first, axis.key: value}), f"{source}, {axis.key} = {value!r}")
