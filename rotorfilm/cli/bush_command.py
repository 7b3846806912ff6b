"""The command `rotorfilm bush`: contact and critical speeds of a polymer bush that melts."""

from __future__ import annotations

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
    console.print_rows("melting bush", answer.to_rows())
