"""The command `rotorfilm solve`, and how the answer of a journal bearing is printed."""

from __future__ import annotations

import json
import math
from dataclasses import replace
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

from ..core.errors import InputError
from ..core.progress import Report
from . import printing as console
from .command import Option, Said, SceneFile, inside

if TYPE_CHECKING:
    from ..scenes import Scene
    from ..scenes.bush_table import BushAnswer
    from ..scenes.solve_journal import Answer


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
        raise InputError(f"--explain needs a scene with a [question], got {str(scene)!r}, which has none")
    if loaded.bush is not None and not loaded.has_film:
        with inside(scene):
            melting = loaded.melting()
        return Said(melting, partial(print_bush, melting))
    with inside(scene):
        loaded.film_table.make_map(report)
        answer = loaded.describe()
    return Said(answer, partial(print_answer, loaded.title, answer))


def schema(
    out: Annotated[Path | None, Option(help="Write it into this file instead.", metavar="FILE.json")] = None,
) -> Said:
    """Print the JSON Schema of scene files, by which editors complete and check them."""
    from ..core.files import write_whole
    from ..scenes.scene import json_schema

    text = json_schema()
    if out is None:
        return Said(json.loads(text), partial(print, text, end=""))
    written = str(write_whole(out, text.encode()))
    return Said({"schema": written}, partial(console.print_rows, "", [("schema", written)]))


def _question(path: Path, scene: Scene, explain: bool) -> Said:
    from .question_printing import print_question

    with inside(path):
        answer = scene.ask()
    show = partial(print_question, scene.title, answer, explain=explain)
    return Said(answer, show, None if answer.met else answer.message)


def remark_rows(remarks: tuple[str, ...]) -> list[tuple[str, str]]:
    """Return the rows of what the physics of a film leaves out."""
    return [("left out", remark) for remark in remarks]


def print_answer(title: str, answer: Answer) -> None:
    """Print equilibrium, coefficients and whirl threshold."""
    console.print_rows(title, answer.to_rows())


# The command `rotorfilm bush`: contact and critical speeds of a polymer bush that melts.


def bush(
    load: Annotated[str, Option(help="Radial load.", metavar='"3750 N"')],
    speed: Annotated[str | None, Option(help="Angular speed to evaluate.", metavar='"9 rad/s"')] = None,
    settlement: Annotated[str, Option(help="Up to which the liner may wear.")] = "0 mm",
    change: Annotated[
        list[str] | None, Option("--set", help="Other value than the example's.", metavar="NAME=VALUE")
    ] = None,
    published: Annotated[bool, Option("--published", help="Shaft heat by the published formula.")] = False,
    whole_shaft: Annotated[bool, Option("--global", help="Balance heat over the whole shaft.")] = False,
) -> Said:
    """Find contact and critical speeds of a polymer bush that melts: the published example unless set."""
    from ..bearings.bush import ApproximateShaft, GlobalBalance
    from ..scenes.bush_table import bush_from_settings, solve_bush
    from ..scenes.reading import Quantity

    pairs = [text.partition("=")[::2] for text in change or ()]
    model = bush_from_settings({name.strip(): value.strip() for name, value in pairs})
    model = replace(model, shaft_heat=ApproximateShaft()) if published else model
    model = replace(model, balance=GlobalBalance()) if whole_shaft else model
    rate = None if speed is None else Quantity("rad/s")("--speed", speed)
    worn = Quantity("m")("--settlement", settlement)
    answer = solve_bush(model, Quantity("N")("--load", load), rate, worn)
    return Said(answer, partial(print_bush, answer))


def print_bush(answer: BushAnswer) -> None:
    """Print contact and critical speeds of a melting bush."""
    at = answer.contact
    onset = console.speed_text(answer.onset_speed)
    rows = [
        ("load", f"{at.load:.6g} N"),
        ("contact half angle", f"{at.contact_angle:.6g} rad = {math.degrees(at.contact_angle):.4g} deg"),
        ("settlement", f"{at.settlement * 1e6:.6g} um"),
        ("pressure", f"mean {at.mean_pressure * 1e-6:.5g} MPa, largest {at.maximum_pressure * 1e-6:.5g} MPa"),
        ("heat", f"shaft {at.shaft_flux:.6g} W/m2, liner {at.liner_flux:.6g} W/m2"),
        ("critical speed", console.speed_text(at.critical_speed)),
        ("", f"{onset} once worn to a settlement of {answer.settlement * 1e6:g} um"),
    ]
    operation = [(name.replace("_", " "), f"{value:.6g}") for name, value in answer.operation.items()]
    console.print_rows("melting bush", rows)
    if operation:
        console.print_rows("at the speed given, unworn (SI)", operation)
