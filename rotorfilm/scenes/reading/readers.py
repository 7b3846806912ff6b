"""Readers of values that several tables of a scene have."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Any, TypeVar

from ...errors import SceneError, brief
from ...inputs.spelling import nearest
from ...linear.equilibrium import UNLOADED
from .tables import Quantity, Reader, choose, text

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
        if not isinstance(value, str) or value not in names:
            hint = nearest(value, names)
            raise SceneError(f"{where} must be one of {', '.join(names)}, got {brief(value)}{hint}")
        return value

    return read


@takes(Quantity("N"), [Quantity("N"), Quantity("N")])
def read_load(where: str, value: Any) -> tuple[float, float]:
    """Read a load [N]: one positive magnitude, which acts along -y, or the two components [x, y]."""
    if isinstance(value, list):
        if len(value) != 2:
            raise SceneError(f"{where} must be one magnitude or two components [x, y], got {brief(value)}")
        x, y = (Quantity("N")(f"{where}[{index}]", entry) for index, entry in enumerate(value))
        return x, y
    magnitude = Quantity("N")(where, value)
    if magnitude == 0.0:
        raise SceneError(f"{where} must not be zero, got {brief(value)}: {UNLOADED}")
    if not magnitude > 0.0:
        raise SceneError(f"{where} must be a positive magnitude or two components [x, y], got {brief(value)}")
    return 0.0, -magnitude


@takes(Quantity("N"), [Quantity("N"), Quantity("N")])
def read_static_load(where: str, value: Any) -> tuple[float, float]:
    """Read a load [N] as `read_load` does, or none: preloaded balls carry themselves."""
    none = not isinstance(value, list) and Quantity("N")(where, value) == 0.0
    return (0.0, 0.0) if none else read_load(where, value)


@takes([Quantity("m"), Quantity("m")])
def read_place(where: str, value: Any) -> tuple[float, float]:
    """Read a place [x, y] [m]."""
    if not isinstance(value, list) or len(value) != 2:
        raise SceneError(f"{where} must be two lengths [x, y], got {brief(value)}")
    x, y = (Quantity("m")(f"{where}[{index}]", entry) for index, entry in enumerate(value))
    return x, y


@takes([text, ...])
def read_names(where: str, value: Any) -> tuple[str, ...]:
    """Read a list of names, one at least."""
    if not isinstance(value, list) or not value:
        raise SceneError(f"{where} must be a list of names, got {brief(value)}")
    return tuple(text(f"{where}[{index}]", entry) for index, entry in enumerate(value))


@dataclass(frozen=True)
class Count:
    """Reader of a whole number.

    Attributes
    ----------
    most : int
        The largest one, of `rotorfilm.limits`.
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


@dataclass(frozen=True)
class Counts:
    """Reader of a list of positive whole numbers.

    Attributes
    ----------
    names : tuple of str
        What they are.
    most : int
        Their largest product, of `rotorfilm.limits`.
    """

    names: tuple[str, ...]
    most: int

    def __call__(self, where: str, value: Any) -> tuple[int, ...]:
        """Return the numbers; raise SceneError if they are none or beyond the limits."""
        if not isinstance(value, list) or len(value) != len(self.names):
            raise SceneError(f"{where} must be [{', '.join(self.names)}], got {brief(value)}")
        counts = tuple(Count(self.most)(f"{where}[{index}]", entry) for index, entry in enumerate(value))
        if math.prod(counts) > self.most:
            raise SceneError(f"{where} must multiply to at most {self.most}, got {brief(value)}")
        return counts


@dataclass(frozen=True)
class Named:
    """Reader of the name of one of several things that have no parameters.

    Attributes
    ----------
    variants : mapping of str to callable
        What makes each thing, by its name.
    """

    variants: Mapping[str, Callable[[], Any]]

    def __call__(self, where: str, value: Any) -> Any:
        """Return the thing of this name."""
        return choose(where, value, self.variants)()
