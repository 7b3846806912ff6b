"""The command `rotorfilm solve`, and how the answer of a journal bearing is printed."""

from __future__ import annotations

import json
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

from ..errors import InputError
from ..progress import Report
from . import printing as console
from .bush_command import print_bush
from .command import Option, Said, SceneFile, inside

if TYPE_CHECKING:
    from ..scenes import Scene
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
    from ..files import write_whole
    from ..scenes.scene_file import json_schema

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
