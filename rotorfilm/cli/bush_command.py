"""The command `rotorfilm bush`: contact and critical speeds of a polymer bush that melts."""

from __future__ import annotations

import math
from dataclasses import replace
from functools import partial
from typing import TYPE_CHECKING, Annotated

from . import printing as console
from .command import Option, Said

if TYPE_CHECKING:
    from ..scenes.bush.solve_bush import BushAnswer


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
    from ..scenes.bush.solve_bush import bush_from_settings, solve_bush
    from ..scenes.reading.tables import Quantity

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
