"""The commands `rotorfilm coefficients` and `rotorfilm groove-map`: journal bearings without a scene file."""

from __future__ import annotations

from dataclasses import replace
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

from ..core.errors import InputError, brief
from ..core.progress import Report
from ..core.readable import rows
from ..core.units import whole_number
from . import printing as console
from .command import Argument, Option, Said

if TYPE_CHECKING:
    from ..bearings.films.geometry import Groove
    from ..bearings.films.law import FilmLaw
    from ..bearings.journal import GrooveMapTable
    from ..scenes.excitation_table import FilmTable
    from ..scenes.journal_tables import ConservedOil
    from ..scenes.lubricant_table import LubricantTable

Grooves = Annotated[
    list[str] | None,
    Option(help="Center and width of an axial groove; once for each.", metavar='"90 deg, 20 deg"'),
]


def coefficients(
    report: Report,
    radius: Annotated[str, Option(help="Journal radius.", metavar='"50 mm"')],
    length: Annotated[str, Option(help="Axial length.", metavar='"30 mm"')],
    clearance: Annotated[str, Option(help="Radial clearance.", metavar='"0.1 mm"')],
    load: Annotated[str, Option(help='Static load: downward, or "X,Y" components.', metavar='"525 N"')],
    speed: Annotated[str, Option(help="Angular speed about +z.", metavar='"1500 rpm"')],
    viscosity: Annotated[
        str | None, Option(help="Dynamic viscosity, at all temperatures.", metavar='"0.1 Pa s"')
    ] = None,
    oil: Annotated[
        str | None, Option(help="Or a grade, as warm as its film gets.", metavar='"ISO VG 46"')
    ] = None,
    supply_temperature: Annotated[
        str | None, Option(help="Of the fresh oil, with a grade.", metavar='"45 degC"')
    ] = None,
    film: Annotated[
        str, Option(help="Film law: map, grooved_map, reynolds, jfo, short or splitting.", metavar="NAME")
    ] = "map",
    order: Annotated[str | None, Option(help='Splitting order, "N,M" or "N,inf".', metavar="2,inf")] = None,
    constant: Annotated[bool, Option("--constant", help="Splitting film with the function 1.")] = False,
    rupture: Annotated[
        str | None,
        Option(
            help="Where the splitting film ends: fixed, rotating, reynolds or complementarity.",
            metavar="KIND",
        ),
    ] = None,
    cells: Annotated[
        str | None,
        Option(help='Cells of the reynolds, jfo or grooved_map film, "AROUND,ALONG".', metavar="96,8"),
    ] = None,
    groove: Grooves = None,
) -> Said:
    """Find equilibrium, stiffness and damping of a journal bearing; numbers without a unit are SI."""
    from ..scenes.reading import read_table
    from ..scenes.schema import JournalTable

    lubricant = lubricant_of(viscosity, oil, supply_temperature)
    geometry = {"radius": radius, "length": length, "clearance": clearance}
    geometry |= {"viscosity": viscosity} if viscosity is not None else {}
    grooves = tuple(_groove(text) for text in groove or [])
    law = _film(film, order, constant, rupture, cells)
    table = replace(read_table(JournalTable, "--", geometry), film=law, grooves=grooves).on("--", lubricant)
    return found_of("journal bearing", table, lubricant, operation_of(load, speed), report)


def groove_map(
    report: Report,
    scene: Annotated[
        Path | None, Argument(metavar="SCENE.toml", help="Scene whose bearing has grooves or pads.")
    ] = None,
    slenderness: Annotated[
        float | None, Option(help="Without a scene: length / diameter.", metavar="0.5")
    ] = None,
    groove: Grooves = None,
    cells: Annotated[
        str | None,
        Option(help="Without a scene: cells around the film and along half of it.", metavar="192,12"),
    ] = None,
    nodes: Annotated[
        str | None,
        Option(help="Without a scene: nodes over eccentricity, its direction, motion.", metavar="12,72,48"),
    ] = None,
    out: Annotated[Path | None, Option(help="File for a copy of the map.")] = None,
) -> Said:
    """Make the map of a bearing with grooves or pads; all of its shape and resolution find it on disk."""
    from ..bearings.films.map_table import cache_folder
    from ..bearings.journal import build_groove_map
    from ..scenes import Scene

    options = {"--slenderness": slenderness, "--groove": groove, "--cells": cells, "--nodes": nodes}
    if scene is None:
        table = _map_of_options(slenderness, groove, cells, nodes, report)
    elif given := [name for name, value in options.items() if value]:
        raise InputError(f"{given[0]} must not be given with a scene, got {options[given[0]]!r}")
    else:
        table = build_groove_map(Scene.load(scene).journal_bearing, report)
    if out is not None:
        table.save(out)
    folder, reach = str(cache_folder()), table.largest_eccentricity_ratio
    rows = [
        ("kept in", folder),
        ("length / diameter", f"{table.slenderness:.9g}"),
        ("eccentricity ratios", f"up to {reach:.3g}"),
    ]
    found = {"folder": folder, "slenderness": table.slenderness, "largest_eccentricity_ratio": reach}
    return Said(found, partial(console.print_rows, "map of the film", rows))


def _map_of_options(
    slenderness: float | None,
    groove: list[str] | None,
    cells: str | None,
    nodes: str | None,
    report: Report,
) -> GrooveMapTable:
    from ..bearings.films.geometry import FilmGeometry
    from ..bearings.journal import GroovedMapFilm
    from ..scenes.journal_tables import CELLS, NODES

    if slenderness is None or not groove:
        raise InputError("groove-map must have SCENE.toml, or --slenderness and --groove, got neither")
    geometry = FilmGeometry(grooves=tuple(_groove(text) for text in groove))
    film = GroovedMapFilm(geometry=geometry)
    if cells is not None:
        around, along = CELLS("--cells", _numbers(cells))
        film = replace(film, cells=(around, along))
    if nodes is not None:
        over, turning, moving = NODES("--nodes", _numbers(nodes))
        film = replace(film, nodes=(over, turning, moving))
    return film.built_table(slenderness, report)


def lubricant_of(viscosity: str | None, oil: str | None, supply_temperature: str | None) -> LubricantTable:
    """Return the oil of a grade; without one a mineral oil for the remarks, beside the viscosity."""
    from ..scenes.lubricant_table import LubricantTable, read_grade
    from ..scenes.reading import Quantity

    if (viscosity is None) is (oil is None):
        raise InputError(f"--viscosity or --oil must be given, got {'neither' if oil is None else 'both'}")
    if (supply_temperature is None) is not (oil is None):
        raise InputError(
            "--oil and --supply-temperature must be given together, got "
            f"{brief(oil)} and {brief(supply_temperature)}"
        )
    if oil is None:
        return LubricantTable()
    supplied = Quantity("K", absolute=True)("--supply-temperature", supply_temperature)
    return LubricantTable(grade=read_grade("--oil", oil), supply_temperature=supplied)


def _film(
    film: str, order: str | None, constant: bool, rupture: str | None, cells: str | None
) -> FilmLaw | ConservedOil:
    from ..scenes.journal_tables import FILMS
    from ..scenes.reading import choose, keyed, read_table

    given: dict[str, Any] = {
        "order": order and _numbers(order),
        "constant": constant,
        "rupture": rupture and {"kind": rupture},
        "cells": cells and _numbers(cells),
    }
    options = {name: value for name, value in given.items() if value}
    table = choose("--film", film, FILMS)
    for name in options:
        if name not in keyed(table).readers:
            raise InputError(f"--{name} must not be given with --film {film}, got {options[name]!r}")
    return read_table(table, "--", options)


def _numbers(text: str) -> list[int | str]:
    """Return the integers between commas, and what is none as it is."""
    return [part if (number := whole_number(part)) is None else number for part in text.split(",")]


def _groove(text: str) -> Groove:
    """Return the groove of "CENTER, WIDTH"."""
    from ..bearings.films.geometry import Groove
    from ..scenes.reading import Quantity

    parts = [part.strip() for part in text.split(",")]
    if len(parts) != 2:
        raise InputError(f'--groove must be a center and a width, as "90 deg, 20 deg", got {brief(text)}')
    center, width = (Quantity("rad")("--groove", part) for part in parts)
    return Groove(center=center, width=width)


def operation_of(load: str, speed: str) -> tuple[tuple[float, float], float]:
    """Return the load [N] and the speed [rad/s]."""
    from ..scenes.reading import read_load, read_table
    from ..scenes.schema import OperationTable

    components = load.split(",")
    options = {"load": components if len(components) > 1 else load, "speed": speed}
    read_load("--load", options["load"])  # which is not zero, that of an operation may be
    table = read_table(OperationTable, "--", options)
    assert table.load is not None
    return table.load, table.speed


def found_of(
    title: str,
    table: FilmTable,
    lubricant: LubricantTable,
    operation: tuple[tuple[float, float], float],
    report: Report,
    **whirl: float,
) -> Said:
    """Return equilibrium, losses, K and C of the bearing of a table, and what its physics leaves out."""
    from ..analysis import coefficients as film_coefficients, equilibrium

    bearing, (load, speed) = table.build(), operation
    table.make_map(report)
    at = equilibrium(bearing, load, speed)
    data, name = table.echo(bearing)
    answer = {"bearing": data, "model": name, "equilibrium": at, "losses": at.losses}
    answer["coefficients"] = film_coefficients(bearing, at.position, speed, **whirl)
    answer["remarks"] = table.remarks(bearing, lubricant.properties, speed, load)
    return Said(answer, partial(console.print_rows, title, rows(**answer)))
