"""How functions become commands: their examples, `--json`, progress and exit codes."""

from __future__ import annotations

import inspect
from collections.abc import Callable
from functools import wraps
from pathlib import Path
from typing import Annotated, Any, NamedTuple

import typer

from . import printing as console

BAD_INPUT = 2
FAILED = 1

SceneFile = Annotated[Path, typer.Argument(metavar="SCENE.toml", help="Scene file of schema 1.")]
SignalFile = Annotated[Path | None, typer.Option(help="CSV file for the signals.", metavar="FILE.csv")]
Json = Annotated[bool, typer.Option("--json", help="Print JSON on stdout instead of tables.")]


class Said(NamedTuple):
    """What a command says.

    Attributes
    ----------
    data : object
        What `--json` prints.
    show : callable
        Prints the same for people.
    failure : str or None
        Complained of behind it on stderr, before the command exits with 1; empty if the data say it.
    """

    data: object
    show: Callable[[], None]
    failure: str | None = None


Commands = dict[Callable[..., Said], str]
"""Functions with their examples, without the name of the program."""


def group(text: str, commands: Commands, *, slow: bool = False, **options: Any) -> typer.Typer:
    """Return a group of commands.

    Parameters
    ----------
    text : str
        Its help.
    commands : dict of callable to str
        The parameters of a function are its options; one called `report` is no option but moves a progress
        bar.
    slow : bool
        Whether the commands take long from the beginning, so that the bar shows at once.
    **options
        Of the group, as typer has them.
    """
    made = typer.Typer(
        help=text, no_args_is_help=True, context_settings={"help_option_names": ["-h", "--help"]}, **options
    )
    for function, example in commands.items():
        made.command(epilog=f"Example: rotorfilm {example}")(_command(function, slow))
    return made


def _command(function: Callable[..., Said], slow: bool) -> Callable[..., None]:
    """Return a function as a command: with `--json`, and with the report of its progress."""
    parameters = inspect.signature(function, eval_str=True).parameters
    wanted = inspect.Parameter("json", inspect.Parameter.KEYWORD_ONLY, default=False, annotation=Json)
    options = [*(each for name, each in parameters.items() if name != "report"), wanted]

    @wraps(function)
    def run(json: bool, **given: Any) -> None:
        said = _followed(function, given, slow) if "report" in parameters else function(**given)
        if json:
            console.print_json(said.data)
        else:
            said.show()
        if said.failure:
            console.complain("error", said.failure)
        if said.failure is not None:
            raise typer.Exit(FAILED)

    run.__annotations__ = {each.name: each.annotation for each in options}
    vars(run)["__signature__"] = inspect.Signature(options)
    return run


def _followed(function: Callable[..., Said], given: dict[str, Any], slow: bool) -> Said:
    """Return what a function says, and show meanwhile how far it is."""
    with console.progress_display() as report:
        if slow:
            report(0.0, "packages")
        said = function(**given, report=report)
        if slow:
            report(1.0, "done")
    return said
