"""The command `rotorfilm pad-coefficients`: bearings made of pads without a scene file."""

from __future__ import annotations

from typing import Annotated, Any

from ..core.errors import InputError
from ..core.progress import Report
from .command import Option, Said
from .journal_commands import found_of, lubricant_of, operation_of

DAM, TILTING = "pressure_dam", "tilting_pad"


def pad_coefficients(
    report: Report,
    kind: Annotated[
        str,
        Option(
            "--type",
            help="elliptical, three_lobe, four_lobe, offset_halves, tapered_land, pressure_dam, tilting_pad.",
            metavar="NAME",
        ),
    ],
    radius: Annotated[str, Option(help="Journal radius.", metavar='"50 mm"')],
    length: Annotated[str, Option(help="Axial length.", metavar='"50 mm"')],
    load: Annotated[str, Option(help='Static load: downward, or "X,Y" components.', metavar='"3 kN"')],
    speed: Annotated[str, Option(help="Angular speed about +z.", metavar='"3000 rpm"')],
    pad_clearance: Annotated[
        str | None, Option(help="Radial clearance of a pad.", metavar='"0.1 mm"')
    ] = None,
    assembled_clearance: Annotated[
        str | None, Option(help="Or that of the bearing: (1 - preload) times as much.", metavar='"70 um"')
    ] = None,
    viscosity: Annotated[
        str | None, Option(help="Dynamic viscosity, at all temperatures.", metavar='"20 mPa s"')
    ] = None,
    oil: Annotated[
        str | None, Option(help="Or a grade, as warm as its films get.", metavar='"ISO VG 46"')
    ] = None,
    supply_temperature: Annotated[
        str | None, Option(help="Of the fresh oil, with a grade.", metavar='"45 degC"')
    ] = None,
    preload: Annotated[str | None, Option(help="Of the pads; 0.5 of lobes, else 0.", metavar="0.3")] = None,
    extent: Annotated[
        str | None, Option(help="Angle of a pad; usual ones of lobes.", metavar='"60 deg"')
    ] = None,
    offset: Annotated[
        str | None, Option(help="Least film of a lobe as a share of its arc.", metavar="0.5")
    ] = None,
    turned: Annotated[str | None, Option(help="Turn of all lobes.", metavar='"10 deg"')] = None,
    pad_count: Annotated[
        int | None, Option("--pads", help="Number of tilting pads.", metavar="5", min=2, max=64)
    ] = None,
    between_pads: Annotated[
        bool, Option("--load-between", help="Load between two tilting pads, not on one.")
    ] = False,
    pivot_offset: Annotated[
        str | None, Option(help="Share of a tilting pad before its pivot.", metavar="0.5")
    ] = None,
    frequency: Annotated[
        str | None,
        Option(help="Of the whirl on tilting pads; by default that of the shaft.", metavar='"0 rad/s"'),
    ] = None,
    depth: Annotated[str | None, Option(help="Of a dam.", metavar='"140 um"')] = None,
    end: Annotated[str | None, Option(help="Angle of its step from +x.", metavar='"145 deg"')] = None,
    share: Annotated[str | None, Option(help="Of the length that it takes.", metavar="0.75")] = None,
) -> Said:
    """Find equilibrium, stiffness and damping of a bearing made of pads; numbers without a unit are SI.

    K and C of tilting pads hold at one frequency, which is told with them.
    """
    given = {name: value for name, value in locals().items() if isinstance(value, str) or name == "pad_count"}
    lubricant = lubricant_of(viscosity, oil, supply_temperature)
    asked = {name: value for name, value in given.items() if name not in _NOT_OF_TABLES and value is not None}
    table = _table(kind, asked, between_pads).on("--", lubricant)
    whirl = {} if frequency is None else {"frequency": _frequency(kind, frequency)}
    return found_of(f"bearing: {kind}", table, lubricant, operation_of(load, speed), report, **whirl)


_NOT_OF_TABLES = ("kind", "load", "speed", "oil", "supply_temperature", "frequency")
"""Options that are no keys of the table of a bearing."""


def _table(kind: str, given: dict[str, Any], between_pads: bool) -> Any:
    """Return the table of a scene that these options are."""
    from ..bearings.pads import SETS
    from ..scenes.pad_tables import DamTable, LobedTable, TiltingTable
    from ..scenes.reading import choose, keyed, read_table

    tables: dict[str, Any] = {**dict.fromkeys(SETS, LobedTable), DAM: DamTable, TILTING: TiltingTable}
    table = choose("--type", kind, tables)
    if table is LobedTable:
        given |= {"preset": kind}
    if table is TiltingTable:
        given |= {"loading": "between_pads" if between_pads else "on_pad"}
    elif between_pads:
        raise InputError(f"--load-between must be given with tilting pads, got --type {kind}")
    for name, value in given.items():
        if name not in keyed(table).readers:
            option = "--pads" if name == "pad_count" else f"--{name.replace('_', '-')}"
            raise InputError(f"{option} must not be given with --type {kind}, got {value!r}")
    return read_table(table, "--", given)


def _frequency(kind: str, text: str) -> float:
    """Return the frequency of a whirl [rad/s]."""
    from ..scenes.reading import Quantity

    if kind != TILTING:
        raise InputError(f"--frequency must be given with tilting pads, got --type {kind}")
    return Quantity("rad/s")("--frequency", text)
