"""The command `rotorfilm solve`, and how the answer of a journal bearing is printed."""

from __future__ import annotations

import json
import math
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import numpy as np

from ..errors import InputError
from ..progress import Report
from ..results import Coefficients, Equilibrium, WhirlThreshold
from . import printing as console
from .bush_command import print_bush
from .command import Option, Said, SceneFile

if TYPE_CHECKING:
    from ..bearings.journal import JournalBearing
    from ..scenes import Scene
    from ..scenes.journal.echo import BearingData
    from ..scenes.journal.solve_journal import Answer


def solve(
    scene: SceneFile,
    report: Report,
    explain: Annotated[
        bool, Option("--explain", help="Show the whole ladder behind the answer to a question.")
    ] = False,
) -> Said:
    """Answer a scene: its question, or else equilibrium, stiffness, damping and whirl threshold.

    Exits with 1 where no rung meets the tolerance of the question, or nothing is there to answer it; with 2
    for bad input.
    """
    from ..scenes import Scene

    loaded = Scene.load(scene)
    if loaded.question is not None:
        return _question(scene, loaded, explain)
    if explain:
        raise InputError(f"--explain must be given with a scene that has a [question], got {str(scene)!r}")
    if loaded.bush is not None and loaded.journal is None:
        melting = loaded.melting()
        return Said(melting, partial(print_bush, melting))
    make_map(loaded.bearing, report)
    answer = loaded.describe()
    return Said(answer, partial(print_answer, loaded.title, answer))


def schema(
    out: Annotated[Path | None, Option(help="Write it into this file instead.", metavar="FILE.json")] = None,
) -> Said:
    """Print the JSON Schema of scene files, by which editors complete and check them."""
    from ..files import write_whole
    from ..scenes.scene_file import json_schema

    text = json_schema()
    if out is None:
        return Said(json.loads(text), partial(print, text, end=""))
    written = str(write_whole(out, text.encode()))
    return Said({"schema": written}, partial(console.print_rows, "", [("schema", written)]))


def _question(path: Path, scene: Scene, explain: bool) -> Said:
    from .question_printing import print_question

    try:
        answer = scene.ask()
    except InputError as error:
        raise InputError(f"{path}: {error}") from None
    show = partial(print_question, scene.title, answer, explain=explain)
    return Said(answer, show, None if answer.met else answer.message)


def make_map(bearing: JournalBearing, report: Report) -> None:
    """Make the map of a bearing that needs one of its own, unless it lies on disk."""
    if not (bearing.grooves or bearing.pads):
        return
    from ..bearings.journal import GroovedMapFilm, build_groove_map

    if isinstance(bearing.fitted_film, GroovedMapFilm):
        build_groove_map(bearing, report)


def bearing_rows(bearing: BearingData) -> list[tuple[str, str]]:
    """Return the rows that repeat a bearing."""
    size = f"R {bearing.radius * 1e3:.6g} mm, L {bearing.length * 1e3:.6g} mm, L/D {bearing.slenderness:.6g}"
    rows = [
        ("bearing", f"{size}, c {bearing.clearance * 1e6:.6g} um"),
        ("viscosity", f"{bearing.viscosity:.6g} Pa s"),
    ]
    rows += [("groove", f"{_degrees(one.center)}, {_degrees(one.width)} wide") for one in bearing.grooves]
    rows += [("pad", f"from {_degrees(one.start)} over {_degrees(one.extent)}") for one in bearing.pads]
    if bearing.supply_pressure:
        rows.append(("supply pressure", f"{bearing.supply_pressure:.6g} Pa"))
    return rows


def equilibrium_rows(at: Equilibrium) -> list[tuple[str, str]]:
    """Return the rows that describe an equilibrium."""
    return [
        ("load", f"{_pair(at.load)} N"),
        ("speed", console.speed_text(at.speed)),
        ("position", f"{_pair(at.position * 1e6)} um"),
        ("eccentricity ratio", f"{at.eccentricity_ratio:.6g}"),
        ("attitude angle", _degrees(at.attitude_angle)),
        ("minimum film", f"{at.minimum_film * 1e6:.6g} um"),
    ]


def coefficient_rows(film: Coefficients) -> list[tuple[str, str]]:
    """Return the rows of a stiffness and a damping matrix."""
    (kxx, kxy), (kyx, kyy) = film.stiffness
    (cxx, cxy), (cyx, cyy) = film.damping
    return [
        ("stiffness K [N/m]", f"xx {kxx:14.7g}   xy {kxy:14.7g}"),
        ("", f"yx {kyx:14.7g}   yy {kyy:14.7g}"),
        ("damping C [N s/m]", f"xx {cxx:14.7g}   xy {cxy:14.7g}"),
        ("", f"yx {cyx:14.7g}   yy {cyy:14.7g}"),
    ]


def whirl_rows(threshold: WhirlThreshold | None) -> list[tuple[str, str]]:
    """Return the rows of a whirl threshold, or of the reason why there is none."""
    if threshold is None:
        return []
    if threshold.speed is None:
        return [("whirl threshold", f"none: {threshold.reason}")]
    ratio = "" if threshold.whirl_ratio is None else f", whirl ratio {threshold.whirl_ratio:.4g}"
    return [("whirl threshold", console.speed_text(threshold.speed) + ratio)]


def remark_rows(remarks: tuple[str, ...]) -> list[tuple[str, str]]:
    """Return the rows of what the physics of a film leaves out."""
    return [("left out", remark) for remark in remarks]


def print_answer(title: str, answer: Answer) -> None:
    """Print equilibrium, coefficients and whirl threshold."""
    rows = [*bearing_rows(answer.bearing), ("film", answer.model), *equilibrium_rows(answer.equilibrium)]
    rows += coefficient_rows(answer.coefficients)
    rows += whirl_rows(answer.whirl_threshold)
    console.print_rows(title, rows + remark_rows(answer.remarks))


def _degrees(angle: float) -> str:
    return f"{math.degrees(angle):.6g} deg"


def _pair(values: np.ndarray) -> str:
    return f"({values[0]:.6g}, {values[1]:.6g})"
