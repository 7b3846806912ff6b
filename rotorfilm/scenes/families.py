"""The bearing families that a scene may have: one row each, with the places of what each brings."""

from __future__ import annotations

import tomllib
from collections.abc import Iterable, Mapping
from functools import cache
from importlib import import_module, resources
from typing import Any, NamedTuple

from ..core.answers import LeftOutRemark
from ..core.errors import InputError
from ..core.model import Model, Stepped


class Family(NamedTuple):
    """What a bearing family brings to scenes: places of names below `rotorfilm`, loaded when they are needed.

    Attributes
    ----------
    table : str
        The dataclass that its table is read into; see `rotorfilm.scenes.reading`.
    ladders : str
        By quantity, a call that takes a scene and the quantity and returns the ladder of its rungs.
    models : str
        Takes a scene and returns what of it becomes FMUs; empty if that is not one bearing under one rotor.
    answer : str
        Takes a scene without a question and a Report of its progress, and returns what the scene answers;
        empty where that is what any bearing with a film answers.
    """

    table: str
    ladders: str
    models: str = ""
    answer: str = ""


FILM = "scenes.export_scene.film_models"

FAMILIES = {
    "journal": Family("bearings.journal.table.JournalTable", "bearings.journal.questions.LADDERS", FILM),
    "bush": Family(
        "bearings.bush.table.BushTable",
        "bearings.bush.questions.LADDERS",
        answer="bearings.bush.table.answer_bush",
    ),
    "contact": Family(
        "bearings.contact.table.ContactTable",
        "bearings.contact.questions.LADDERS",
        answer="bearings.contact.table.answer_contact",
    ),
    "shaft": Family(
        "scenes.shaft_table.ShaftTable",
        "questions.shaft.LADDERS",
        answer="scenes.solve_shaft.solve_rotor",
    ),
    "damper": Family(
        "bearings.damper.table.DamperTable",
        "bearings.damper.questions.LADDERS",
        "bearings.damper.table.damper_fmus",
        "bearings.damper.answer.answer_damper",
    ),
    "lobed_journal": Family("bearings.pads.table.LobedTable", "bearings.pads.questions.LOBED", FILM),
    "pressure_dam": Family("bearings.pads.table.DamTable", "bearings.pads.questions.PRESSURE_DAM", FILM),
    "tilting_pad": Family("bearings.pads.table.TiltingTable", "bearings.pads.questions.TILTING", FILM),
    "ball_bearing": Family("bearings.rolling.table.BallTable", "bearings.rolling.questions.LADDERS", FILM),
    "thrust": Family(
        "bearings.thrust.table.ThrustTable",
        "bearings.thrust.questions.LADDERS",
        answer="bearings.thrust.table.answer_thrust",
    ),
}
"""By the name of its table in a scene."""


def brought(place: str) -> Any:
    """Return what stands at a place that a family names."""
    module, _, name = place.rpartition(".")
    return getattr(import_module(f"{__package__.rpartition('.')[0]}.{module}"), name)


def table_of(name: str) -> type:
    """Return the dataclass of a family's table."""
    return brought(FAMILIES[name].table)


class SceneModels(NamedTuple):
    """Bearing and rotor of a scene as they become FMUs.

    Attributes
    ----------
    name : str
        Name of the bearing and of its file.
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

    @property
    def files(self) -> dict[str, str]:
        """Names of the files of film and rotor."""
        return {"film": self.name, "rotor": "rotor"}

    @property
    def parts(self) -> dict[str, tuple[Any, Mapping[str, float]]]:
        """Models and start values, by the names of their files."""
        return {self.name: (self.bearing, self.start), "rotor": (self.rotor, {})}


def models_of(scene: Any, *alone: str) -> SceneModels:
    """Return what of a scene becomes FMUs.

    Parameters
    ----------
    scene : Scene
    alone : str
        Tables that become an FMU by themselves, which the message names too.

    Raises
    ------
    InputError
        If no family of the scene has a bearing under a rotor.
    """
    given = [name for name in reversed(FAMILIES) if name in scene.tables]
    place = next((FAMILIES[name].models for name in given if FAMILIES[name].models), None)
    if place is None:
        known = [name for name, family in FAMILIES.items() if family.models or name in alone]
        raise InputError(
            f"scene must have one of the tables {known} for FMUs, got {given}; in Python "
            "`export_fmu` takes any bearing, also a contact's `ContactLaw` and a bush's `BushWear`"
        )
    return brought(place)(scene)


# Remarks on what a physics leaves out: a number, its limit, and what is said beyond it.


class Remark(NamedTuple):
    """What is said where a number passes a limit.

    Attributes
    ----------
    number : str
        Which one.
    limit : float
        Limit of that number.
    text : str
        In braces the numbers by their names, and `limit`, with their formats.
    below : bool
        Whether it is said below the limit, not above it.
    moves : str
        The neglected effect, if the number is about its relative influence on an answer.
    """

    number: str
    limit: float
    text: str
    below: bool = False
    moves: str = ""

    def line(self, numbers: Mapping[str, float]) -> str:
        """Return the text with its numbers; a `LeftOutRemark` where they tell how much it moves an answer."""
        text = self.text.format_map({"limit": self.limit, **numbers})
        return LeftOutRemark(text, self.moves, float(numbers[self.number])) if self.moves else text

    def applies(self, numbers: Mapping[str, float]) -> bool:
        """Return whether the limit is passed; not-a-number passes none."""
        value = numbers[self.number]
        return value < self.limit if self.below else value > self.limit


def remarks_of(*subjects: str) -> tuple[Remark, ...]:
    """Return what is said of subjects, tables of the file of remarks."""
    return tuple(Remark(**remark) for subject in subjects for remark in _remarks()[subject])


@cache
def _remarks() -> dict[str, Any]:
    return tomllib.loads(resources.files(__package__).joinpath("remarks.toml").read_text("utf-8"))


def isothermal(remarks: Iterable[Remark]) -> tuple[Remark, ...]:
    """Return remarks without those on the warming of a film, which one of an oil has in it."""
    return tuple(remark for remark in remarks if remark.number not in ("thinning", "unknown", "warming"))


def messages(remarks: Iterable[Remark], numbers: Mapping[str, float]) -> tuple[str, ...]:
    """Return the lines of the remarks whose limits the numbers pass.

    Where no oil survives the heat, that is said in place of how thin it makes the oil.
    """
    said = [remark for remark in remarks if remark.applies(numbers)]
    hot = next((one for one in said if one.number == "warming"), None)
    thin = next((one for one in said if one.number == "thinning"), None)
    if hot and thin:
        said[said.index(thin)] = thin._replace(text=hot.text)
        said.remove(hot)
    return tuple(remark.line(numbers) for remark in said)


def prefixed(prefix: str, lines: Iterable[str]) -> list[str]:
    """Return lines with a text before each; what they say of their size stays."""
    return [line.prefixed(prefix) if isinstance(line, LeftOutRemark) else f"{prefix}{line}" for line in lines]
