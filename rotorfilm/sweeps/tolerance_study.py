"""Studies of tolerances: what manufacture and oil do to a quantity, by samples and one by one."""

from __future__ import annotations

import os
import re
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from types import MappingProxyType
from typing import Any

import numpy as np

from ..core.errors import (
    AbsentError,
    InputError,
    RotorfilmError,
    brief,
    require_count,
    require_number,
    require_positive,
    warn_user,
)
from ..core.frames import Column, ResultTable
from ..core.inputs import arguments, nearest, require_choice
from ..core.model import Array
from ..core.progress import Report, silent
from ..core.readable import Drawable
from ..core.units import dotted_key, parse_quantity
from ..scenes.reading import quantity_of
from ..scenes.scene import Scene, read_tables, varied
from .sweep_run import sweep

SAMPLE = "sample"

CELSIUS_SIGN = re.compile(r"(?:deg|\N{DEGREE SIGN})C$")
"""How the unit of a temperature ends that has a zero of its own."""


@dataclass(frozen=True, kw_only=True)
class ToleranceStudy(Drawable):
    """How a quantity scatters with parameters that are within tolerances.

    Attributes
    ----------
    quantity, unit : str
        Name of the quantity and its unit.
    nominal : float
        Value of the quantity without deviations.
    mean, deviation : float
        Mean and standard deviation of the samples that have an answer.
    values : ndarray, shape (n_samples,)
        Value of the quantity in each sample. A sample without an answer has not-a-number.
    parameters : dict of str to ndarray, shape (n_samples,)
        Values that were drawn for each parameter, in its unit.
    effects : dict of str to (float, float)
        Values of the quantity at the low and at the high end of each parameter. The others are nominal.
    failures : int
        Number of samples without an answer.
    """

    quantity: str
    unit: str
    nominal: float
    mean: float
    deviation: float
    values: Array
    parameters: dict[str, Array]
    effects: dict[str, tuple[float, float]]
    failures: int = 0

    _tabled = ("values", "parameters", "effects")

    def _own_units(self) -> dict[str, str]:
        return dict.fromkeys(("nominal", "mean", "deviation", "values"), self.unit)

    def to_table(self) -> ResultTable:
        """Return a row for each sample: its parameters and the quantity."""
        columns = [Column(name, "", values) for name, values in self.parameters.items()]
        notes = {"nominal": self.nominal, **{name: list(ends) for name, ends in self.effects.items()}}
        return ResultTable(
            (*columns, Column(self.quantity, self.unit, self.values)),
            "Samples",
            "",
            notes,
            {"nominal": self.unit},
        )

    def _pages(self) -> tuple[ResultTable, ...]:
        ends = np.array(list(self.effects.values()))
        known = self.values[np.isfinite(self.values)]
        shares = (0.05, 0.5, 0.95)
        return (
            ResultTable(
                (
                    Column("parameter", "", list(self.effects)),
                    Column("low", self.unit, ends[:, 0], f"{self.quantity} at the low end"),
                    Column("high", self.unit, ends[:, 1], "at the high end"),
                ),
                "One by one",
            ),
            ResultTable(
                (
                    Column("share", "1", np.array(shares), "share below"),
                    Column(self.quantity, self.unit, np.quantile(known, shares)),
                ),
                f"{known.size} samples",
            ),
        )


@arguments
def scatter_study(
    solve: Callable[..., float],
    nominal: Mapping[str, float],
    tolerances: Mapping[str, float],
    *,
    quantity: str = "value",
    unit: str = "",
    samples: int = 200,
    seed: int = 0,
) -> ToleranceStudy:
    """Return how a quantity scatters, by a function of your own.

    Parameters
    ----------
    solve : callable
        It takes the parameters by their names and returns the quantity. A sample fails where it raises a
        RotorfilmError or returns a number that is not finite.
    nominal, tolerances : mapping of str to float
        Nominal values, and the largest deviation of those that scatter, in the same units. All values within
        the tolerances are equally likely and independent. A deviation is smaller than its nominal value, so
        that no sign changes; where the nominal value is 0 it may have any size.
    quantity, unit : str
        Name and unit of what `solve` returns, for tables and pictures.
    samples, seed : int
        Number of samples, and the seed of their random numbers.

    Raises
    ------
    InputError
        If an argument breaks its rule.
    AbsentError
        If there is no answer without deviations, or in no sample.
    """
    draws = _draws(nominal, tolerances, samples, seed)
    reasons = []

    def solved(values: Mapping[str, float]) -> float:
        try:
            return float(solve(**{**nominal, **values}))
        except RotorfilmError as error:
            reasons.append(str(error))
            return np.nan

    rows = [dict(zip(draws, row, strict=True)) for row in zip(*draws.values(), strict=True)]
    return _study(draws, np.array([solved(row) for row in rows]), quantity, unit, reasons)


@arguments
def tolerance_study(
    scene: str | os.PathLike[str] | Mapping[str, Any],
    tolerances: Mapping[str, Any],
    quantity: str = "",
    *,
    samples: int = 200,
    seed: int = 0,
    changes: Mapping[str, Any] = MappingProxyType({}),
    path: str | os.PathLike[str] | None = None,
    workers: int | None = None,
    report: Report = silent,
) -> ToleranceStudy:
    """Return how a quantity of a scene scatters with keys that are within tolerances.

    Parameters
    ----------
    scene : path or mapping
        A scene file, or its tables; of a shaft with a question.
    tolerances : mapping of str to float or str
        Largest deviation by dotted key, as `{"journal.clearance": "5 um", "journal.viscosity": "10 %"}`. A
        percentage is a share of the nominal value. The deviation of a temperature is a difference, "5 degC"
        the same as "5 K", and no percentage. The rest is as in `scatter_study`.
    quantity : str
        A number that `sweep` returns, as "minimum_film"; by default it is the answer to the question, or the
        eccentricity ratio.
    samples, seed : int
        Number of samples, and the seed of their random numbers.
    changes, path, workers, report
        They are the same as in `sweep`.

    Raises
    ------
    InputError
        If an argument breaks its rule, a key is no quantity of the scene, or there is no such quantity.
    AbsentError
        If the scene has no answer without deviations, or in no sample.
    """
    tables = varied(scene if isinstance(scene, Mapping) else read_tables(scene), changes)
    nominal, deviations = {}, {}
    for key, tolerance in tolerances.items():
        nominal[key], deviations[key] = _read(tables, key, tolerance)
    draws = _draws(nominal, deviations, samples, seed)
    parameters = {key: (SAMPLE, values) for key, values in draws.items()}
    found = sweep(tables, parameters, path=path, workers=workers, report=report)
    name = quantity or ("value" if "value" in found else "eccentricity_ratio")
    numbers = [
        one for one in found.data_vars if found[one].dims == (SAMPLE,) and found[one].dtype.kind == "f"
    ]
    reasons = [one for one in map(str, found["failure"].values) if one]
    if not numbers:
        raise AbsentError(f"{name} must have a value without deviations, got none: {reasons[0]}")
    require_choice("quantity", name, map(str, numbers))
    asked = str(tables["question"]["quantity"]) if name == "value" else name
    return _study(draws, found[name].values, asked, str(found[name].attrs.get("units", "")), reasons)


def _read(tables: Mapping[str, Any], key: str, tolerance: Any) -> tuple[float, float]:
    """Return the value of a key and its largest deviation, in SI."""
    if not isinstance(key, str):
        raise InputError(f"tolerances must have dotted keys of the scene, got {brief(key)}")
    value: Any = tables
    path = dotted_key(key).split(".")
    for part in path:
        try:
            value = value[int(part) if isinstance(value, list) else part]
        except (KeyError, IndexError, ValueError, TypeError):
            meant = nearest(part, value if isinstance(value, Mapping) else ())
            raise InputError(f"tolerances must have keys that the scene gives, got {key!r}{meant}") from None
    reader = quantity_of(Scene, path)
    if reader is None or isinstance(value, list):
        raise InputError(f"tolerances must have keys of quantities, got {key!r} = {value!r}")
    name, nominal = f"tolerances[{key!r}]", reader.parse(value)
    if isinstance(tolerance, bool) or not isinstance(tolerance, int | float | str):
        raise InputError(f"{name} must be a number or a string with a unit, got {brief(tolerance)}")
    text = tolerance.strip() if isinstance(tolerance, str) else tolerance
    try:
        if not str(text).endswith("%"):
            return nominal, _difference(text, reader.unit)
        if not reader.absolute:
            return nominal, abs(nominal) * parse_quantity(text, "1")
    except InputError as error:
        raise InputError(f"{name}: {error}") from None
    raise InputError(f"{name} must be a difference of temperatures in K or degC, got {brief(text)}")


def _difference(value: str | float, unit: str) -> float:
    """Return a deviation in SI; one of 5 degC is 5 K."""
    text = CELSIUS_SIGN.sub("K", value) if isinstance(value, str) and unit == "K" else value
    return parse_quantity(text, unit)


def _draws(
    nominal: Mapping[str, float], tolerances: Mapping[str, float], samples: int, seed: int
) -> dict[str, Array]:
    """Return the values of all parameters: nominal, the ends of each in turn, and samples."""
    require_count("samples", samples, 2)
    require_count("seed", seed, 0)
    if not tolerances:
        raise InputError("tolerances must have at least one parameter, got none")
    rng, draws = np.random.default_rng(seed), {}
    for k, (name, tolerance) in enumerate(tolerances.items()):
        if name not in nominal:
            raise InputError(
                f"tolerances must have names of nominal values, {', '.join(nominal)}, got {name!r}"
            )
        require_positive(f"tolerances[{name!r}]", tolerance)
        size = abs(require_number(f"nominal[{name!r}]", nominal[name]))
        if 0.0 < size <= tolerance:
            raise InputError(
                f"tolerances[{name!r}] must be below {size:.6g}, the size of the nominal value, so that no "
                f"sign changes, got {tolerance:.6g}"
            )
        ends = np.zeros(2 * len(tolerances))
        ends[2 * k : 2 * k + 2] = -1.0, 1.0
        draws[name] = nominal[name] + tolerance * np.concatenate(
            [[0.0], ends, rng.uniform(-1.0, 1.0, samples)]
        )
    return draws


def _study(
    draws: dict[str, Array], values: Array, quantity: str, unit: str, reasons: list[str]
) -> ToleranceStudy:
    first, reason = 1 + 2 * len(draws), "".join(f": {one}" for one in reasons[:1])
    values = np.where(np.isfinite(values), values, np.nan)
    if not np.isfinite(values[0]):
        raise AbsentError(f"{quantity} must have a value without deviations, got none{reason}")
    drawn = values[first:]
    effects = {name: (float(values[1 + 2 * k]), float(values[2 + 2 * k])) for k, name in enumerate(draws)}
    failures = int(np.count_nonzero(~np.isfinite(drawn)))
    if failures == drawn.size:
        raise AbsentError(
            f"{quantity} must have a value in at least one sample, got none in {failures}{reason}"
        )
    silent_ends = [name for name, ends in effects.items() if not np.isfinite(ends).all()]
    if silent_ends:
        warn_user(f"an end of the tolerance has no answer, of {', '.join(silent_ends)}{reason}")
    if failures:
        warn_user(f"{failures} of {drawn.size} samples have no answer, and are not in the histogram")
    return ToleranceStudy(
        quantity=quantity,
        unit=unit,
        nominal=float(values[0]),
        mean=float(np.nanmean(drawn)),
        deviation=float(np.nanstd(drawn)),
        values=drawn,
        parameters={name: column[first:] for name, column in draws.items()},
        effects=effects,
        failures=failures,
    )
