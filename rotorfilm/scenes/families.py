"""The bearing families that a scene may have: one line each, and the record that each brings."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from importlib import import_module
from typing import Any, NamedTuple

from ..errors import InputError
from ..ladders import Ladder
from ..model import Model, Stepped

FAMILIES = {
    "journal": "questions.journal.journal_family",
    "bush": "questions.bush.bush_family",
    "contact": "questions.contact.contact_family",
    "shaft": "questions.shaft.shaft_family",
    "damper": "questions.damper.damper_family",
    "lobed_journal": "questions.pads.lobed_family",
    "pressure_dam": "questions.pads.dam_family",
    "tilting_pad": "questions.pads.tilting_family",
    "ball_bearing": "questions.rolling.rolling_family",
}
"""By the name of its table in a scene, the module of a family that has its record, `FAMILY`.

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
        The dataclass that its table is read into; see `rotorfilm.scenes.reading.tables`.
    ladders : mapping of str to callable
        By quantity, a call that takes a scene and the quantity and returns the ladder of its rungs.
    models : callable or None
        Takes a scene and returns what of it becomes FMUs; None if that is not one bearing under one rotor.
    command : str
        What the command line offers for a scene that asks nothing.
    """

    table: type
    ladders: Mapping[str, Callable[[Any, str], Ladder]]
    models: Callable[[Any], SceneModels] | None = None
    command: str = ""


def family_of(name: str) -> Family:
    """Return the record of a family, by the name of its table."""
    home = __package__.rpartition(".")[0]
    found: Family = import_module(f"{home}.{FAMILIES[name]}").FAMILY
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
