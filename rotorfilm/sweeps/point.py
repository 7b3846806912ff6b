"""One point of a sweep: a scene solved, and what is kept of its answer."""

from __future__ import annotations

import contextlib
import math
import warnings
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from itertools import product
from operator import attrgetter
from typing import Any

import numpy as np

from ..analysis.many_runs import each_run
from ..bearings.bush.table import BushAnswer
from ..core.answers import QuestionAnswer
from ..core.errors import InputError, RotorfilmError, ValidityWarning, said_once
from ..core.limits import SWEEP_POINTS, require_at_most
from ..core.units import UNITS, dotted_key
from ..scenes.film_answer import Answer
from ..scenes.reading import Quantity, quantity_of
from ..scenes.rotor_runs import PreparedRun, RotorRun, finished_run, prepared_run
from ..scenes.scene import Scene, read_scene, varied

Row = dict[str, Any]
"""What a point answers, by name: numbers, nested lists of numbers, text."""

Quantities = Mapping[str, tuple[str, str]]
"""What is kept of an answer: by name its attribute, and the unit."""

AT_REST: Quantities = {
    "eccentricity_ratio": ("equilibrium.eccentricity_ratio", "1"),
    "attitude_angle": ("equilibrium.attitude_angle", "rad"),
    "minimum_film": ("equilibrium.minimum_film", "m"),
    "stiffness": ("coefficients.stiffness", "N/m"),
    "damping": ("coefficients.damping", "N.s/m"),
}
LOSSES: Quantities = {
    "power_loss": ("losses.power_loss", "W"),
    "friction_torque": ("losses.friction_torque", "N.m"),
    "side_flow": ("losses.side_flow", "m3/s"),
}
THRESHOLD: Quantities = {
    "threshold_speed": ("whirl_threshold.speed", "rad/s"),
    "whirl_ratio": ("whirl_threshold.whirl_ratio", "1"),
}
MELTING: Quantities = {
    "contact_angle": ("contact.contact_angle", "rad"),
    "settlement": ("contact.settlement", "m"),
    "maximum_pressure": ("contact.maximum_pressure", "Pa"),
    "critical_speed": ("contact.critical_speed", "rad/s"),
    "onset_speed": ("onset_speed", "rad/s"),
}
ASKED: Quantities = {"value": ("value", ""), "error_estimate": ("error_estimate", "1")}

POINT_UNITS = {
    name: unit
    for each in (AT_REST, LOSSES, THRESHOLD, MELTING, ASKED)
    for name, (_, unit) in each.items()
    if unit
}
"""Units of what a scene without a question answers, and of the estimate of one with it."""


def solve_point(
    scene: Mapping[str, Any], values: Mapping[str, Any], source: str, read: Scene | None = None
) -> Row:
    """Return the answer of a scene with other values at some keys; a failure is a text in it.

    What depends on the machine and its load, the cost, is left out: equal sweeps give equal data. A scene
    that was `read` with these values is not read again.
    """
    row: Row = {"remarks": ""}
    with _told(row) as remarks:
        asked = read or read_scene(varied(scene, values), source)
        _require_kept(asked)
        answer = asked.solve()
        row |= _kept(answer)
        remarks |= {f"left out: {remark}" for remark in getattr(answer, "remarks", ())}
    return row


def run_points(
    scene: Mapping[str, Any],
    todo: Sequence[tuple[int, Mapping[str, Any]]],
    source: str,
    read: Mapping[int, Scene],
    workers: int,
) -> dict[int, Row]:
    """Return what the runs over time of points show, by their numbers; runs share `workers` threads."""
    rows: dict[int, Row] = {number: {"remarks": ""} for number, _ in todo}
    ready: dict[int, PreparedRun] = {}
    for number, values in todo:
        with _told(rows[number]):
            ready[number] = prepared_run(read.get(number) or read_scene(varied(scene, values), source))
    found = each_run([one.arguments for one in ready.values()], None, workers)
    for number, one in ready.items():
        with _told(rows[number]):
            rows[number] |= _moved(finished_run(one, next(found)))
    return rows


@contextlib.contextmanager
def _told(row: Row) -> Iterator[set[str]]:
    """Add to a row the remarks that are put in the set and the warnings; of a failure these and its text."""
    remarks = {row["remarks"]} - {""}
    with warnings.catch_warnings(record=True) as caught, said_once(anew=True):
        warnings.simplefilter("always")
        try:
            yield remarks
        except RotorfilmError as error:
            row["failure"] = f"{type(error).__name__}: {error}"
    told = {str(each.message) for each in caught if issubclass(each.category, ValidityWarning)}
    remarks |= {message for message in told if message not in row["remarks"]}
    row["remarks"] = "; ".join(sorted(remarks))


def _moved(run: RotorRun) -> Row:
    """Return the numbers of a run, those of each journal and probe by its name."""
    places = {
        f"{place}_{name}": value
        for name, values in (
            ("peak", run.peaks),
            ("vibration", run.vibrations),
            ("vibration_speed", run.vibration_speeds),
        )
        for place, value in values.items()
    }
    contact = {} if run.contact_time is None else {"contact_time": run.contact_time}
    return {**places, "end_speed": run.end_speed, **contact}


def unit_of(name: str) -> str:
    """Return the unit of a number that a scene without a question, or a run, shows; empty for none."""
    ends = {"_peak": "m", "_vibration": "m", "_speed": "rad/s", "contact_time": "s"}
    return POINT_UNITS.get(name) or next((unit for end, unit in ends.items() if name.endswith(end)), "")


def _require_kept(scene: Scene) -> None:
    """Raise InputError for a scene that asks nothing and of whose answer a sweep keeps no numbers."""
    if scene.question is None and scene.bush is None and not scene.has_film:
        what = "[shaft]" if scene.shaft else "scene without a film or a bush"
        raise InputError(f"a sweep of a {what} needs a [question], unless it makes runs (`--runs`)")


def _kept(answer: Answer | BushAnswer | QuestionAnswer) -> Row:
    if isinstance(answer, BushAnswer):
        return _taken(answer, MELTING)
    if isinstance(answer, QuestionAnswer):
        return {**_taken(answer, ASKED), "met": answer.met, "model": answer.model, "unit": answer.unit}
    threshold = answer.whirl_threshold
    whirls = threshold is not None and threshold.speed is not None
    kept = {**AT_REST, **(LOSSES if answer.losses else {}), **(THRESHOLD if whirls else {})}
    return {**_taken(answer, kept), "model": answer.model}


def _taken(answer: object, quantities: Quantities) -> Row:
    return {name: np.asarray(attrgetter(path)(answer)).tolist() for name, (path, _) in quantities.items()}


# What varies in a sweep: keys of a scene file, their values, and the points these make.


Values = Sequence[Any] | tuple[str, Sequence[Any]]
"""Values of a key, a dimension of their own; or (dimension, values), to share it as samples do."""


@dataclass(frozen=True, kw_only=True)
class Axis:
    """A key that varies along a dimension.

    Attributes
    ----------
    key : str
        Dotted, as `journal.clearance`; an entry of a list by its number, as `shaft.disks.0.width`.
    dimension : str
        Dimension of the dataset.
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
            with contextlib.suppress(InputError, TypeError):  # a table is no quantity
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
        return Axis(key=dotted_key(key), dimension=str(values[0]), values=_plain(key, values[1]))
    dotted = dotted_key(key)
    return Axis(key=dotted, dimension=dotted.replace(".", "_"), values=_plain(key, values))


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


KEPT = 10_000
"""Largest number of scenes that are kept from the check of a sweep, about 20 kB each."""


def check(scene: Mapping[str, Any], axes: Sequence[Axis], source: str, runs: bool) -> dict[int, Scene]:
    """Read the scenes along each dimension in turn, so that a wrong key or value is found before the work.

    Without `runs`, each scene must have an answer of which a sweep keeps numbers.

    Returns
    -------
    dict of int to Scene
        The scenes that gave no warning, by the numbers of their points; `KEPT` at most.

    Raises
    ------
    SceneError
        As a scene file raises it.
    InputError
        If a sweep keeps no numbers of a scene.
    """
    first, lengths = next(points(axes)), sizes(axes)
    stride, found = math.prod(lengths.values()), dict[int, Scene]()
    for dimension, length in lengths.items():
        stride //= length
        for k in range(length):
            values = {axis.key: axis.values[k] for axis in axes if axis.dimension == dimension}
            tables = varied(scene, {**first, **values})
            try:
                with warnings.catch_warnings(record=True) as caught, said_once(anew=True):
                    warnings.simplefilter("always")
                    read = read_scene(tables, source)
            except RotorfilmError:
                for key, value in values.items():
                    read_scene(varied(scene, {**first, key: value}), f"{source}, {key} = {value!r}")
                continue
            if not runs:
                _require_kept(read)
            if caught:
                read_scene(tables, source)
            elif len(found) < KEPT:
                found[k * stride] = read
    return found
