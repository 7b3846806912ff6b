"""The command line: every command with its example, and what becomes of errors and warnings."""

from __future__ import annotations

import argparse
import sys
import warnings
from collections.abc import Callable, Sequence
from typing import Any

from ..core.errors import FileWarning, InputError, RotorfilmError, SceneError, ValidityWarning
from ..core.sources import installed_version
from . import printing as console
from .command import BAD_INPUT, FAILED, Group, Parser, function_of, run_command

# A command's module is imported when it is called, and a package that takes long inside the command.


COMMANDS = (
    *(
        "solve_command.solve",
        "solve_command.report",
        "run_command.run",
        "sweep_command.sweep",
        "run_command.cosim",
    ),
    *("solve_command.new", "solve_command.schema", "demo_command.demo"),
)
"""Commands in the order of the help; each is a function of a module of this folder."""

CHARTS = (
    *("journal", "stability", "bearings", "pads", "rolling", "contact", "scene", "limits", "page"),
    *("bush", "heat", "damper", "cosim"),
)

ALL = Group(
    """Bearing films for rotor dynamics: static and dynamic coefficients, FMUs, coupled simulation.

    Example: rotorfilm solve examples/question.toml --explain""",
    COMMANDS,
)
GROUPS = {
    "chart": Group(
        """Charts of a ladder of models, from the cheapest to the reference: PNG and CSV.

        Example: rotorfilm chart journal --ld 0.5 --out pictures""",
        [f"chart_commands.{name}" for name in CHARTS],
        slow=True,
    ),
    "fmu": Group(
        """Build FMUs of a scene, check one, show what is in one.

        Example: rotorfilm fmu build examples/friswell.toml --out fmus""",
        [f"fmu_commands.{name}" for name in ("build", "check", "info")],
    ),
}
"""Commands behind another word."""


def main(arguments: list[str] | None = None) -> None:
    """Run the command line; exit with 0, with 1 for a failed computation, with 2 for bad input."""
    words = sys.argv[1:] if arguments is None else arguments
    try:
        with warnings.catch_warnings():
            warnings.showwarning = _shown_once()
            _run(words)
    except (RotorfilmError, OSError, MemoryError) as error:
        message = (
            f"not enough memory: {error}"
            if isinstance(error, MemoryError)
            else str(error).removeprefix("--: ")
        )
        console.complain("error", message)
        if "--json" in words:
            console.print_json({"error": type(error).__name__, "message": message})
        sys.exit(BAD_INPUT if isinstance(error, InputError | SceneError | OSError) else FAILED)


def _run(words: Sequence[str]) -> None:
    named = words[:1] if words and words[0] in GROUPS else []
    group, rest = (GROUPS[named[0]], words[1:]) if named else (ALL, words)
    program = " ".join([_program(), *named])
    if rest and rest[0] in group.homes:
        run_command(f"{program} {rest[0]}", group, group.homes[rest[0]], rest[1:])
    else:
        _show(program, group, rest)
    sys.exit()


def _program() -> str:
    """Return how the program was called."""
    package = __name__.partition(".")[0]
    started = getattr(sys.modules["__main__"], "__spec__", None)
    return f"python -m {package}" if started and started.name == f"{package}.__main__" else package


def _show(program: str, group: Group, words: Sequence[str]) -> None:
    """Show the help of a group, or the version, or say what is wrong with words that are no command."""
    parser = Parser(program, "COMMAND [OPTIONS]", group.text)
    if group is ALL:
        parser.add_argument("--version", action="store_true", help="Print the version and exit.")
    listed = parser.add_subparsers(title="commands", metavar="COMMAND", parser_class=argparse.ArgumentParser)
    for name, home in group.homes.items():
        listed.add_parser(name, help=_summary(function_of(home).__doc__), add_help=False)
    for name, below in GROUPS.items() if group is ALL else ():
        listed.add_parser(name, help=_summary(below.text), add_help=False)
    if "version" in parser.parse_args(words) and words:
        sys.stdout.write(f"rotorfilm {installed_version()}\n")
    else:
        parser.print_help(sys.stderr)
        sys.exit(BAD_INPUT)


def _summary(documented: str | None) -> str:
    """Return the first line of a docstring."""
    return (documented or "").strip().partition("\n")[0].replace("%", "%%")


def _shown_once() -> Callable[..., None]:
    """Return what shows what a model says of itself and its files, each text once; others warn developers."""
    told = set[str]()

    def show(message: Warning | str, category: type[Warning], *_: Any) -> None:
        if issubclass(category, ValidityWarning | FileWarning) and str(message) not in told:
            told.add(str(message))
            console.complain("warning", message)

    return show
