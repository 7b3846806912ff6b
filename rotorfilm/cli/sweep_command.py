"""The command `rotorfilm sweep`: a scene at many values of its keys."""

from __future__ import annotations

import math
from functools import partial
from pathlib import Path
from typing import Annotated, Any

from ..core.errors import InputError, brief
from ..core.limits import SWEEP_POINTS
from ..core.progress import Report
from ..core.units import dotted_key, whole_number
from . import printing as console
from .command import CommandOutput, Option, SceneFile, Settings, read_settings


def sweep(
    scene: SceneFile,
    report: Report,
    vary: Annotated[
        list[str],
        Option(
            help="Key and its values: a list, as 80 um, 100 um, or first : last : count. Once for each key.",
            metavar='"KEY = VALUES"',
        ),
    ],
    out: Annotated[Path, Option(help="NetCDF file; run again, it goes on where it was interrupted.")],
    changes: Settings = None,
    workers: Annotated[int | None, Option(help="Processes; by default one for each core.")] = None,
    dask: Annotated[str | None, Option(help="Scheduler of a Dask cluster.", metavar="ADDRESS")] = None,
    runs: Annotated[bool, Option(help="Make a run over time at each point, as `rotorfilm run`.")] = False,
) -> CommandOutput:
    """Solve a scene at all combinations of some values of its keys, into a NetCDF file.

    Exits with 1 if every point failed, and with 2 for bad input.

    Example: rotorfilm sweep examples/question.toml --vary "journal.clearance = 50 um, 60 um, 70 um" --vary
    "operation.speed = 1000 rpm : 3000 rpm : 5" --out sweep.nc
    """
    from ..sweeps import sweep as run

    parameters: dict[str, list[Any]] = {}
    for key, values in map(read_variation, vary):
        if key in parameters:
            raise InputError(f"--vary must be given once for each key, got {brief(key)} twice")
        parameters[key] = values
    dataset = run(
        scene,
        parameters,
        path=out,
        changes=read_settings(changes),
        workers=workers,
        dask=dask,
        runs=runs,
        report=report,
    )
    failed = int((dataset["failure"] != "").sum())
    remarks = int((dataset["remarks"] != "").sum())
    answer = {
        "path": str(out),
        "points": int(dataset["failure"].size),
        "failed": failed,
        "remarks": remarks,
        "sizes": dict(dataset.sizes),
    }
    shown = {name: str(value) for name, value in answer.items()}
    if remarks:
        shown["remarks"] = f"{remarks} points: physics left out, or a model beyond its range"
    failure = None
    if failed == answer["points"]:
        failure = f"every point failed, the first with {dataset['failure'].values.flat[0]}"
    return CommandOutput(answer, partial(console.print_rows, "sweep", shown.items()), failure)


def read_variation(text: str) -> tuple[str, list[Any]]:
    """Return a key and its values from "key = a, b, c" or "key = first : last : count".

    Raises
    ------
    InputError
        If the text is neither.
    """
    key, equals, values = text.partition("=")
    if not (equals and key.strip() and values.strip()):
        raise InputError(
            f'--vary must be "KEY = VALUE, VALUE" or "KEY = first : last : count", got {brief(text)}'
        )
    key, parts = dotted_key(key.strip()), [part.strip() for part in values.split(":")]
    if len(parts) == 1:
        return key, [_value(part.strip()) for part in values.split(",")]
    count = whole_number(parts[2]) if len(parts) == 3 else None
    if count is None or not 2 <= count <= SWEEP_POINTS:
        raise InputError(
            f'--vary must be "KEY = VALUE, VALUE" or "KEY = first : last : count" with a count from 2 to '
            f"{SWEEP_POINTS}, got {brief(text)}"
        )
    return key, _spread(text, parts[0], parts[1], count)


def _spread(text: str, first: str, last: str, count: int) -> list[Any]:
    import numpy as np

    (low, unit), (high, other) = _split(first), _split(last)
    if low is None or high is None or unit != other:
        raise InputError(f"--vary must run between two numbers of one unit, got {brief(text)}")
    numbers = np.linspace(low, high, count).tolist()
    return [f"{number!r} {unit}" if unit else number for number in numbers]


def _split(text: str) -> tuple[float | None, str]:
    number, _, unit = text.replace("%", " %").partition(" ")
    try:
        value = float(number)
    except ValueError:
        return None, ""
    return (value if math.isfinite(value) else None), unit.strip()


def _value(text: str) -> Any:
    number, unit = _split(text)
    return text if number is None or unit else number
