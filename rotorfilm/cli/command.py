"""How functions become commands: their options and examples, `--json`, progress and exit codes.

The parameters of a function are its options: each is `Annotated` with an `Option` or an `Argument`; one
called `report` is no option but moves a progress bar.
"""

from __future__ import annotations

import argparse
import errno
import inspect
import math
import os
import sys
import tomllib
from collections.abc import Callable, Iterable, Iterator, Sequence
from contextlib import contextmanager
from functools import partial
from importlib import import_module
from pathlib import Path
from types import NoneType, UnionType
from typing import TYPE_CHECKING, Annotated, Any, Literal, NamedTuple, NoReturn, Union, get_args, get_origin

from ..core.errors import EquilibriumError, InputError, brief
from ..core.units import dotted_key
from . import printing as console

if TYPE_CHECKING:
    from ..scenes import Scene

BAD_INPUT = 2
FAILED = 1

NUMBERS: dict[type[Any], str] = {float: "a number", int: "a whole number"}


class Option(NamedTuple):
    """A parameter of a command line, which stands there behind its name unless it is positional.

    Attributes
    ----------
    flag : str
        Its name there, if it is not that of the parameter.
    help : str
        What it is.
    metavar : str or None
        An example in the help.
    min, max : float
        Smallest and largest number.
    positional : bool
        Whether it has no name in a command line.
    """

    flag: str = ""
    help: str = ""
    metavar: str | None = None
    min: float = -math.inf
    max: float = math.inf
    positional: bool = False


Argument = partial(Option, positional=True)


class CommandOutput(NamedTuple):
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


class Group(NamedTuple):
    """Commands with what their help says in common.

    Attributes
    ----------
    text : str
        Its help, with an example.
    commands : sequence of str
        As `module.function` of this folder.
    slow : bool
        Whether the commands take long from the beginning, so that the bar shows at once.
    """

    text: str
    commands: Sequence[str]
    slow: bool = False

    @property
    def homes(self) -> dict[str, str]:
        """Where each command lives, by its name in a command line."""
        return {home.rpartition(".")[2].replace("_", "-"): home for home in self.commands}


SceneFile = Annotated[Path, Argument(metavar="SCENE.toml", help="Scene file of schema 1.")]
Settings = Annotated[
    list[str] | None,
    Option(
        "--set",
        help="Value of a key in place of the file's, as in TOML or with a unit. Once for each key.",
        metavar="KEY=VALUE",
    ),
]
SignalFile = Annotated[Path | None, Option(help="CSV file for the signals.", metavar="FILE.csv")]


def load_scene(path: Path, settings: Sequence[str] | None) -> Scene:
    """Return the scene of a file with the values of `--set` in place of its own."""
    from ..scenes import Scene

    return Scene.load(path, read_settings(settings))


def read_settings(settings: Sequence[str] | None, flag: str = "--set") -> dict[str, Any]:
    """Return keys and values of texts as "journal.clearance=80 um"; raise InputError where one is none."""
    pairs = [text.partition("=") for text in settings or ()]
    for text, (key, equals, value) in zip(settings or (), pairs, strict=True):
        if not (equals and key.strip() and value.strip()):
            raise InputError(f'{flag} must be "KEY=VALUE", got {brief(text)}')
    keys = [dotted_key(key.strip()) for key, _, _ in pairs]
    if twice := next((key for key in keys if keys.count(key) > 1), None):
        raise InputError(f"{flag} must be given once for each key, got {brief(twice)} twice")
    return {key: _toml_value(value.strip()) for key, (_, _, value) in zip(keys, pairs, strict=True)}


def _toml_value(text: str) -> Any:
    """Return a value of TOML, or the text itself where it is none, as a quantity without quotes."""
    try:
        read = tomllib.loads(f"value = {text}")
    except (ValueError, RecursionError):
        return text
    return read["value"] if len(read) == 1 else text


@contextmanager
def inside(scene: Path) -> Iterator[None]:
    """Let an error about a scene begin with the name of its file, and a load or speed be a key of it."""
    try:
        yield
    except (InputError, EquilibriumError) as error:
        operating = isinstance(error, EquilibriumError) and str(error).startswith(("load must", "speed must"))
        operating = operating and "operation" in tomllib.loads(scene.read_text(encoding="utf-8"))
        raise type(error)(f"{scene}: {'operation.' if operating else ''}{error}") from None


def make_room(out: Path | None) -> None:
    """Make the folder of a file that is to be written, before what takes long; raise where that is one."""
    if out is None:
        return
    if out.is_dir():
        raise IsADirectoryError(errno.EISDIR, os.strerror(errno.EISDIR), str(out))
    out.parent.mkdir(parents=True, exist_ok=True)


def written_rows(out: Path | None) -> list[tuple[str, str]]:
    """Return the row that says where the signals are."""
    return [] if out is None else [("signals", str(out))]


JSON = inspect.Parameter(
    "json",
    inspect.Parameter.KEYWORD_ONLY,
    default=False,
    annotation=Annotated[bool, Option(help="Print JSON on stdout instead of tables.")],
)


class Parser(argparse.ArgumentParser):
    """A parser whose complaints are those of the program."""

    def __init__(self, program: str, usage: str, documented: str) -> None:
        text, _, example = inspect.cleandoc(documented).replace("%", "%%").partition("\n\nExample: ")
        super().__init__(
            prog=program,
            usage=f"{program} {usage}",
            description=text,
            epilog=f"Example: {' '.join(example.split())}",
            formatter_class=partial(argparse.RawDescriptionHelpFormatter, max_help_position=28),
            allow_abbrev=False,
        )

    def error(self, message: str) -> NoReturn:
        """Print the usage and one line, and exit."""
        self.print_usage(sys.stderr)
        console.complain("error", message)
        sys.exit(BAD_INPUT)


def function_of(home: str) -> Callable[..., CommandOutput]:
    """Return the function of a command, and import its module and no other."""
    module, _, name = home.rpartition(".")
    return getattr(import_module(f".{module}", __package__), name)


def run_command(program: str, group: Group, home: str, words: Sequence[str]) -> None:
    """Run a command with its options; exit with 1 if it failed, with 2 if an option is wrong."""
    function = function_of(home)
    parameters = {**inspect.signature(function, eval_str=True).parameters}
    followed = parameters.pop("report", None) is not None
    arguments = [get_args(each.annotation)[1] for each in parameters.values()]
    usage = " ".join(["[OPTIONS]", *(each.metavar for each in arguments if each.positional)])
    parser = Parser(program, usage, function.__doc__ or "")
    taking = {flag for each in (*parameters.values(), JSON) for flag in _add(parser, each)}
    given = vars(parser.parse_args(list(_joined(words, taking))))
    as_json = given.pop("json")
    answer = _followed(function, given, group.slow) if followed else function(**given)
    if as_json:
        console.print_json(answer.data)
    else:
        answer.show()
    if answer.failure:
        console.complain("error", answer.failure)
    if answer.failure is not None:
        sys.exit(FAILED)


def _followed(function: Callable[..., CommandOutput], given: dict[str, Any], slow: bool) -> CommandOutput:
    """Return what a function says, and show meanwhile how far it is."""
    with console.progress_display() as report:
        if slow:
            report(0.0, "packages")
        answer = function(**given, report=report)
        if slow:
            report(1.0, "done")
    return answer


def _add(parser: Parser, parameter: inspect.Parameter) -> list[str]:
    """Add a parameter to a parser; return its name if a value follows it."""
    annotation, meant = get_args(parameter.annotation)
    kind, many, choices = _kind_of(annotation)
    required = parameter.default is parameter.empty
    default = None if required else parameter.default
    if meant.positional:
        number = None if required else "?"
        parser.add_argument(
            parameter.name, type=kind, nargs=number, default=default, help=meant.help, metavar=meant.metavar
        )
        return []
    flag = meant.flag or f"--{parameter.name.replace('_', '-')}"
    notes = [meant.help.replace("%", "%%")]
    if kind is bool:
        parser.add_argument(flag, dest=parameter.name, action="store_true", help=notes[0])
        return []
    notes += (
        ["[required]"] if required else [f"[default: {default}]".replace("%", "%%")] * (default is not None)
    )
    parser.add_argument(
        flag,
        dest=parameter.name,
        type=lambda text: _read(kind, choices, meant, text),
        action="append" if many else "store",
        default=default,
        required=required,
        help=" ".join(notes),
        metavar=(meant.metavar or " | ".join(choices) or kind.__name__.upper()).replace("%", "%%"),
    )
    return [flag]


def _kind_of(annotation: Any) -> tuple[type[Any], bool, tuple[str, ...]]:
    """Return the type of a value, whether there may be many, and the words that it is one of, if it is."""
    one = annotation
    if get_origin(annotation) is UnionType or get_origin(annotation) is Union:
        one = next(each for each in get_args(annotation) if each is not NoneType)
    if get_origin(one) is Literal:
        return str, False, get_args(one)
    return (get_args(one)[0], True, ()) if get_origin(one) is list else (one, False, ())


def _read(kind: type[Any], choices: Sequence[str], option: Option, text: str) -> Any:
    """Return a value; raise ArgumentTypeError if the text is none, or beyond its bounds."""
    try:
        value = kind(text)
    except ValueError:
        raise argparse.ArgumentTypeError(f"must be {NUMBERS[kind]}, got {text!r}") from None
    if choices and value not in choices:
        raise argparse.ArgumentTypeError(f"must be one of {', '.join(choices)}, got {text!r}")
    if kind in NUMBERS and (value < option.min or value > option.max):
        raise argparse.ArgumentTypeError(f"must be {option.min:g} to {option.max:g}, got {text!r}")
    return value


def _joined(words: Iterable[str], taking: set[str]) -> Iterator[str]:
    """Yield words with each value behind its option, as `--mass=-5 kg`: a value may begin with a dash."""
    rest = iter(words)
    for word in rest:
        value = next(rest, None) if word in taking else None
        yield word if value is None else f"{word}={value}"
