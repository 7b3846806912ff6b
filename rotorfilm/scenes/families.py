"""The bearing families that a scene may have: one line each, and the record that each brings."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass, field
from importlib import import_module
from typing import Any, NamedTuple

from ..core.answers import Ladder, LeftOutRemark
from ..core.errors import InputError
from ..core.model import Model, Stepped
from ..core.progress import Report

FAMILIES = {
    "journal": "questions.journal.FAMILY",
    "bush": "questions.bush.FAMILY",
    "contact": "questions.contact.FAMILY",
    "shaft": "questions.shaft.FAMILY",
    "damper": "questions.damper.FAMILY",
    "lobed_journal": "questions.pads.LOBED",
    "pressure_dam": "questions.pads.PRESSURE_DAM",
    "tilting_pad": "questions.pads.TILTING",
    "ball_bearing": "questions.rolling.FAMILY",
}
"""By the name of its table in a scene, the module of a family and the name of its record there.

Found late: answers to questions stand above scenes.
"""


class SceneModels(NamedTuple):
    """Bearing and rotor of a scene as they become FMUs.

    Attributes
    ----------
    name : str
        Of the bearing and of its file.
    bearing : Model or Stepped
    rotor : Model
    start : mapping of str to float
        Start values of the bearing.
    step : float [s]
        Between two exchanges.
    duration : float [s]
    """

    name: str
    bearing: Model | Stepped
    rotor: Model
    start: Mapping[str, float]
    step: float
    duration: float


@dataclass(frozen=True, kw_only=True)
class Family:
    """What a bearing family brings to scenes and questions.

    Attributes
    ----------
    table : type
        The dataclass that its table is read into; see `rotorfilm.scenes.reading`.
    ladders : mapping of str to callable
        By quantity, a call that takes a scene and the quantity and returns the ladder of its rungs.
    models : callable or None
        Takes a scene and returns what of it becomes FMUs; None if that is not one bearing under one rotor.
    answer : callable or None
        Takes a scene without a question and a Report of its progress, and returns what the scene answers;
        None where that is what any bearing with a film answers.
    example : mapping of str to mapping
        Tables of a scene that has an answer, with values as a file has them, for `rotorfilm new`.
    """

    table: type
    ladders: Mapping[str, Callable[[Any, str], Ladder]]
    models: Callable[[Any], SceneModels] | None = None
    answer: Callable[[Any, Report], Any] | None = None
    example: Mapping[str, Mapping[str, Any]] = field(default_factory=dict)


def family_of(name: str) -> Family:
    """Return the record of a family, by the name of its table."""
    home = __package__.rpartition(".")[0]
    module, _, record = FAMILIES[name].rpartition(".")
    found: Family = getattr(import_module(f"{home}.{module}"), record)
    return found


def table_of(name: str) -> type:
    """Return the dataclass of a family's table."""
    return family_of(name).table


def models_of(scene: Any) -> SceneModels:
    """Return what of a scene becomes FMUs.

    Raises
    ------
    InputError
        If no family of the scene has a bearing under a rotor.
    """
    given = [name for name in reversed(FAMILIES) if scene.table(name) is not None]
    makers = [family_of(name).models for name in given]
    make = next((maker for maker in makers if maker is not None), None)
    if make is None:
        raise InputError(f"{' or '.join(FAMILIES)} must be a bearing under a rotor for FMUs, got {given}")
    return make(scene)


# Remarks on what a physics leaves out: a number, its limit, and what is said beyond it.


class Remark(NamedTuple):
    """What is said where a number passes a limit.

    Attributes
    ----------
    number : str
        Which one.
    limit : float
        Of that number.
    text : str
        In braces the numbers by their names, with their formats.
    below : bool
        Whether it is said below the limit, not above it.
    moves : str
        What is left out, if the number tells about how much that moves an answer, relative to it.
    """

    number: str
    limit: float
    text: str
    below: bool = False
    moves: str = ""

    def line(self, numbers: Mapping[str, float]) -> str:
        """Return the text with its numbers; a `LeftOutRemark` where they tell how much it moves an answer."""
        text = self.text.format_map(numbers)
        return LeftOutRemark(text, self.moves, float(numbers[self.number])) if self.moves else text

    def applies(self, numbers: Mapping[str, float]) -> bool:
        """Return whether the limit is passed; not-a-number passes none."""
        value = numbers[self.number]
        return value < self.limit if self.below else value > self.limit


def said(remarks: Iterable[Remark], numbers: Mapping[str, float]) -> tuple[str, ...]:
    """Return the lines of the remarks whose limits the numbers pass."""
    return tuple(remark.line(numbers) for remark in remarks if remark.applies(numbers))


def prefixed(prefix: str, lines: Iterable[str]) -> list[str]:
    """Return lines with a text before each; what they say of their size stays."""
    return [line.prefixed(prefix) if isinstance(line, LeftOutRemark) else f"{prefix}{line}" for line in lines]
