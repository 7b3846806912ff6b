"""Error against cost of the models of a film's heat: one temperature, a field, layers across the film."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from functools import partial
from time import process_time
from typing import Any

from ...bearings.journal import HeatNumbers, heat_numbers
from ...linear import equilibrium
from ...progress import Report, silent
from ...units import CELSIUS
from .heat_cases import HEAT_CASES, HeatCase
from .heat_models import (
    CELLS,
    LAYERS,
    ONE_TEMPERATURE,
    REFERENCE_CELLS,
    REFERENCE_LAYERS,
    HeatAnswer,
    HeatModel,
    answered,
    bearing_of,
    position_error,
)

ROUNDS = 5
"""Runs of a model with one temperature, the shortest of which counts."""


SHOWN = {
    "eps": ("eccentricity ratio [1]", 1.0, 0.0, ".4f"),
    "angle [deg]": ("attitude angle [rad]", 180.0 / math.pi, 0.0, ".1f"),
    "power [W]": ("power loss [W]", 1.0, 0.0, ".0f"),
    "T [degC]": ("temperature, or largest [K]", 1.0, CELSIUS, ".1f"),
    "Kyy [MN/m]": ("stiffness yy [N/m]", 1e-6, 0.0, ".4g"),
    "place off [%]": ("error of the position [1]", 100.0, 0.0, ".1f"),
    "power off [%]": ("error of the power [1]", 100.0, 0.0, ".1f"),
    "time [ms]": ("CPU time [s]", 1e3, 0.0, ".4g"),
}
"""What a print-out shows: column of the table, its factor, its zero and its format. T is the one temperature
of the film, or the largest of its field."""


@dataclass(frozen=True, kw_only=True)
class HeatRung:
    """Answer, error and cost of one model for one bearing.

    Attributes
    ----------
    model : HeatModel
    answer : HeatAnswer
    position_error : float [1]
        Distance from the journal's position by the reference / its eccentricity.
    power_error : float [1]
        |power loss - reference| / reference.
    cost : float [s]
        CPU time of an equilibrium with its coefficients.
    """

    model: HeatModel
    answer: HeatAnswer
    position_error: float
    power_error: float
    cost: float


@dataclass(frozen=True, kw_only=True)
class HeatLadder:
    """All models for one bearing.

    Attributes
    ----------
    case : HeatCase
    numbers : HeatNumbers
        Of the film at supply temperature.
    reference : HeatAnswer
        Layers across the film, on finer cells.
    rungs : tuple of HeatRung
    """

    case: HeatCase
    numbers: HeatNumbers
    reference: HeatAnswer
    rungs: tuple[HeatRung, ...]


@dataclass(frozen=True, kw_only=True)
class HeatAccuracy:
    """Error against cost of the models of heat on several bearings.

    Attributes
    ----------
    ladders : tuple of HeatLadder
    reference : str
    """

    ladders: tuple[HeatLadder, ...]
    reference: str

    def columns(self) -> dict[str, list[object]]:
        """Return the table: a row for each model and bearing, and one for each reference."""
        rows = [row for ladder in self.ladders for row in _rows(ladder)]
        return {heading: [row[heading] for row in rows] for heading in rows[0]}

    def summary(self) -> dict[str, list[str]]:
        """Return the answers as a print-out, under a row with the name of each bearing."""
        table, previous = self.columns(), None
        rows: list[list[str]] = []
        for k, (name, model) in enumerate(zip(table["bearing [-]"], table["model [-]"], strict=True)):
            if name != previous:
                rows.append([str(name), *("" for _ in SHOWN)])
                previous = name
            rows.append([f"  {model}", *(_shown(table, k, *how) for how in SHOWN.values())])
        return {heading: [row[k] for row in rows] for k, heading in enumerate(("model", *SHOWN))}


def heat_accuracy(
    cases: Sequence[HeatCase] = HEAT_CASES,
    *,
    cells: tuple[int, int] = REFERENCE_CELLS,
    layers: int = REFERENCE_LAYERS,
    report: Report = silent,
) -> HeatAccuracy:
    """Return error and cost of all models of heat.

    Parameters
    ----------
    cases : sequence of HeatCase
    cells : tuple of int
        Of the reference.
    layers : int
        Of the reference.
    report : callable, optional
        Told how far the job is.
    """
    ladders = []
    for number, case in enumerate(cases):
        report(number / len(cases), case.name)
        ladders.append(_ladder(case, cells, layers))
    text = f"temperature over {cells[0]} x {cells[1]} cells and in {layers} layers across the film"
    return HeatAccuracy(ladders=tuple(ladders), reference=text)


def _ladder(case: HeatCase, cells: tuple[int, int], layers: int) -> HeatLadder:
    reference = answered(case, HeatModel.LAYERS, cells=cells, layers=layers)
    cold = bearing_of(case, HeatModel.SUPPLY)
    at = equilibrium(cold, case.load, case.speed)
    return HeatLadder(
        case=case,
        numbers=heat_numbers(case.bearing, at.position, case.speed),
        reference=reference,
        rungs=tuple(_rung(case, model, reference) for model in HeatModel),
    )


def _rung(case: HeatCase, model: HeatModel, reference: HeatAnswer) -> HeatRung:
    solve = partial(answered, case, model, cells=CELLS, layers=LAYERS)
    answer, cost = _timed(solve, ROUNDS if model in ONE_TEMPERATURE else 1)
    return HeatRung(
        model=model,
        answer=answer,
        position_error=position_error(answer, reference),
        power_error=abs(answer.power_loss / reference.power_loss - 1.0),
        cost=cost,
    )


def _timed(solve: partial[HeatAnswer], rounds: int) -> tuple[HeatAnswer, float]:
    """Return an answer, and the shortest of the CPU times that it took."""
    times = []
    for _ in range(rounds):
        begin = process_time()
        answer = solve()
        times.append(process_time() - begin)
    return answer, min(times)


def _shown(
    table: dict[str, list[object]], row: int, column: str, factor: float, zero: float, form: str
) -> str:
    value: Any = table[column][row]
    return "" if value is None else format(factor * value - zero, form)


def _rows(ladder: HeatLadder) -> Iterator[dict[str, object]]:
    for rung in ladder.rungs:
        errors = (rung.position_error, rung.power_error, rung.cost)
        yield _row(ladder, rung.model.value, rung.answer, errors)
    yield _row(ladder, "reference", ladder.reference, (None, None, None))


def _row(
    ladder: HeatLadder, model: str, answer: HeatAnswer, errors: tuple[float | None, ...]
) -> dict[str, object]:
    return {
        "bearing [-]": ladder.case.name,
        "thinning x rise E [1]": ladder.numbers.thinning_rise,
        "Peclet number [1]": ladder.numbers.peclet,
        "Nahme number [1]": ladder.numbers.nahme,
        "model [-]": model,
        "eccentricity ratio [1]": answer.eccentricity_ratio,
        "attitude angle [rad]": answer.attitude_angle,
        "power loss [W]": answer.power_loss,
        "temperature, or largest [K]": answer.temperature,
        "stiffness yy [N/m]": answer.load_stiffness,
        "error of the position [1]": errors[0],
        "error of the power [1]": errors[1],
        "CPU time [s]": errors[2],
    }
