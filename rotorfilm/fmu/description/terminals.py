"""Terminals of FMI 3.0, section 2.4.9: the signals of a journal as one plug, for bearing and rotor alike.

A bearing and a rotor have a terminal for each journal with the same members: position, velocity, speed and
force, each an input of the one and an output of the other. The force is that on the journal on both sides, so
all members are signals, which are equal in connected terminals.
"""

from __future__ import annotations

import re
from collections.abc import Sequence
from typing import NamedTuple
from xml.etree.ElementTree import Element, SubElement

from ...model import Model, Stepped
from ...signals import names
from .model_description import to_bytes
from .variables import structured_name

FORCE = re.compile(r"(?:(\w+)_)?force_[xyz]", re.ASCII)
"""The force at a station, which has a name or none."""

MOTION = ("x", "y", "z", "vx", "vy", "vz")
MEMBERS = (*MOTION, "speed", "force_x", "force_y", "force_z")

KIND = "_rotorfilm.Mechanical.Translational.Journal"
"""Kinds that a tool defines begin with its name."""

RULE = "bus"
"""Members are matched by name; a damper has no speed, and connects all the same."""

FMI = "3.0"
"""The version whose schema the file follows. FMI 2.0.4 and later take it too."""


class Terminal(NamedTuple):
    """The signals of one journal.

    Attributes
    ----------
    name : str
        That of the station; of an FMU with one journal that of the component.
    members : dict of str to str
        Variables by the names that they have in every terminal, as `force_x`.
    """

    name: str
    members: dict[str, str]


def terminals(
    component: str, prefix: str, inputs: Sequence[str], outputs: Sequence[str]
) -> tuple[Terminal, ...]:
    """Return the terminals of a model: a station has force and motion, the one as input, the other as output.

    Parameters
    ----------
    component : str
        Name of the FMU.
    prefix : str
        What stands before the dot of its variables; empty where their names are flat.
    inputs, outputs : sequence of str
        Names of the signals.
    """
    found, known = [], {*inputs, *outputs}
    for station in _stations((*inputs, *outputs)):
        own = {member: f"{station}_{member}" if station else member for member in MEMBERS}
        if own["speed"] not in known:
            own["speed"] = "speed"
        given = {member: name for member, name in own.items() if name in known}
        # A motion that comes in and a force that goes out are one side of a journal, the reverse the other.
        sides = {
            (name in inputs) == (member in MOTION) for member, name in given.items() if member != "speed"
        }
        if len(sides) == 1 and not set(MOTION).isdisjoint(given):
            named = {member: structured_name(prefix, name) for member, name in given.items()}
            found.append(Terminal(station or component, named))
    return tuple(found)


def terminal_files(model: Model | Stepped, component: str, prefix: str, icon: bool) -> dict[str, bytes]:
    """Return terminalsAndIcons.xml by its path; nothing where there are neither terminals nor an icon."""
    found = terminals(component, prefix, names(model.inputs), names(model.outputs))
    path = "terminalsAndIcons/terminalsAndIcons.xml"
    return {path: terminals_and_icons(found, icon)} if found or icon else {}


def _stations(labels: Sequence[str]) -> list[str]:
    """Return the stations with a force, in order; the empty name is that of the only one."""
    matches = [FORCE.fullmatch(label) for label in labels]
    return list(dict.fromkeys(match[1] or "" for match in matches if match))


def terminals_and_icons(found: Sequence[Terminal], icon: bool) -> bytes:
    """Return terminalsAndIcons.xml: the size of icon.png on a diagram, if there is one, and the terminals."""
    root = Element("fmiTerminalsAndIcons", fmiVersion=FMI)
    if icon:
        corners = {"x1": "-100", "y1": "-100", "x2": "100", "y2": "100"}
        graphics = SubElement(root, "GraphicalRepresentation")
        SubElement(graphics, "CoordinateSystem", {**corners, "suggestedScalingFactorTo_mm": "0.1"})
        SubElement(graphics, "Icon", corners)
    if found:
        parent = SubElement(root, "Terminals")
        for terminal in found:
            _add(parent, terminal)
    return to_bytes(root)


def _add(parent: Element, terminal: Terminal) -> None:
    said = {"terminalKind": KIND, "description": "motion of the journal and force on it"}
    element = SubElement(parent, "Terminal", {"name": terminal.name, "matchingRule": RULE, **said})
    for member, variable in terminal.members.items():
        own = {"variableName": variable, "memberName": member}
        SubElement(element, "TerminalMemberVariable", {**own, "variableKind": "signal"})
