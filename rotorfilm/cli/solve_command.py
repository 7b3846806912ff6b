"""The commands `rotorfilm solve`, `schema` and `new`: a scene answered, described, and begun."""

from __future__ import annotations

import json
import tomllib
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

from ..core.errors import InputError, brief
from ..core.progress import Report
from . import printing as console
from .command import (
    Argument,
    CommandOutput,
    Option,
    SceneFile,
    Settings,
    inside,
    load_scene,
    make_room,
    read_settings,
)

if TYPE_CHECKING:
    from ..scenes import Scene


def solve(
    scene: SceneFile,
    report: Report,
    changes: Settings = None,
    explain: Annotated[
        bool, Option("--explain", help="Show the whole ladder behind the answer to a question.")
    ] = False,
    out: Annotated[
        Path | None, Option(help="Folder for the answer (JSON), its pictures (PNG) and tables (CSV).")
    ] = None,
) -> CommandOutput:
    """Answer a scene: its question, or else what its bearing or rotor does.

    Without a question a bearing with a film answers with equilibrium, stiffness, damping and whirl
    threshold. A shaft answers with modes, critical speeds, threshold, unbalance response and, for a
    compressor, stability by API 617. A damper answers with the orbits of its rotor, a contact with its film,
    and a bush with its critical speeds.

    Exits with 1 if no model meets the tolerance of the question, or if there is nothing to answer it. Exits
    with 2 for bad input.

    Example: rotorfilm solve examples/question.toml --explain --set "journal.clearance=80 um"
    """
    loaded = load_scene(scene, changes)
    if loaded.question is not None:
        return _question(scene, loaded, explain, out)
    if explain:
        raise InputError(f"--explain needs a scene with a [question], got {str(scene)!r}, which has none")
    with inside(scene):
        answer = loaded.solve(report)
    from .answer_printing import plain_answer, print_answer, write_answer

    if out is not None:
        write_answer(answer, out)
    return CommandOutput(plain_answer(answer), partial(print_answer, loaded.title, answer))


def _question(path: Path, scene: Scene, explain: bool, out: Path | None) -> CommandOutput:
    from .answer_printing import print_question, write_answer

    with inside(path):
        answer = scene.ask()
    if out is not None:
        write_answer(answer, out)
    show = partial(print_question, scene.title, answer, explain=explain)
    return CommandOutput(answer, show, None if answer.met else answer.message)


def report(
    scene: SceneFile,
    report: Report,
    changes: Settings = None,
    out: Annotated[Path, Option(help="HTML page to write.", metavar="FILE.html")] = Path("report.html"),
    operating: Annotated[
        str | None,
        Option(help="Operating range of a shaft, for API 617.", metavar='"3000 rpm : 4000 rpm"'),
    ] = None,
    vary: Annotated[
        list[str] | None,
        Option(help="Key and its values, for a sweep, as of `rotorfilm sweep`.", metavar='"KEY = VALUES"'),
    ] = None,
    tolerance: Annotated[
        list[str] | None,
        Option(help="Key and its largest deviation, for a study of tolerances.", metavar='"KEY = 5 %"'),
    ] = None,
    quantity: Annotated[str, Option(help="Of that study.")] = "",
    samples: Annotated[int, Option(help="Of that study.", min=2)] = 200,
) -> CommandOutput:
    """Write a report of a scene: one HTML page that needs no network, to be read and printed.

    It has the machine, inputs as read, assumptions, neglected effects, results, verdicts, models and errors.

    Example: rotorfilm report examples/compressor.toml --out report.html --operating "3000 rpm : 4000 rpm"
    """
    from ..core.units import parse_quantity
    from .sweep_command import read_variation

    loaded = load_scene(scene, changes)
    make_room(out)
    ends = operating.split(":") if operating else []
    if ends and len(ends) != 2:
        raise InputError(f'--operating must be "FIRST : LAST", got {brief(operating)}')
    with inside(scene):
        found = loaded.report(
            operating=tuple(parse_quantity(end.strip(), "rad/s") for end in ends) or None,
            vary=dict(map(read_variation, vary or ())),
            tolerances=read_settings(tolerance, "--tolerance"),
            quantity=quantity,
            samples=samples,
            report=report,
        )
    written = found.save(out)
    rows = [("report", str(written)), *((one.subject, one.text) for one in found.verdicts)]
    data = {"report": str(written), "verdicts": [one._asdict() for one in found.verdicts]}
    return CommandOutput(data, partial(console.print_rows, loaded.title, rows))


def schema(
    out: Annotated[Path | None, Option(help="Write it into this file instead.", metavar="FILE.json")] = None,
) -> CommandOutput:
    """Print the JSON Schema of scene files, by which editors complete and check them.

    Example: rotorfilm schema --out scene.schema.json
    """
    from ..scenes.scene import json_schema

    text = json_schema()
    return _printed("schema", text, json.loads(text), out)


def new(
    name: Annotated[str, Argument(metavar="NAME", help="Table of a bearing or a rotor, as tilting_pad.")],
    out: Annotated[Path | None, Option(help="Write it into this file instead.", metavar="FILE.toml")] = None,
) -> CommandOutput:
    """Print a commented scene of a machine element that `rotorfilm solve` answers as it stands.

    NAME is journal, lobed_journal, pressure_dam, tilting_pad, thrust, ball_bearing, damper, contact, bush or
    shaft.

    Example: rotorfilm new tilting_pad --out bearing.toml
    """
    from ..scenes.new_scene import new_scene

    text = new_scene(name)
    return _printed("scene", text, tomllib.loads(text), out)


def _printed(kind: str, text: str, data: Any, out: Path | None) -> CommandOutput:
    """Return what a command says that prints a text, or writes it into a file."""
    from ..core.files import write_atomically

    if out is None:
        return CommandOutput(data, partial(print, text, end=""))
    written = str(write_atomically(out, text.encode()))
    return CommandOutput({kind: written}, partial(console.print_rows, "", [(kind, written)]))
