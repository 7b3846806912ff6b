"""The command line: solve a scene, tabulate coefficients, export FMUs, run the demonstration."""

# Packages that take long to import are imported inside the commands, so that --help answers at once.

from __future__ import annotations

import sys
import warnings
from dataclasses import fields, replace
from enum import StrEnum
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from ..errors import FileWarning, InputError, RotorfilmError, SceneError, ValidityWarning
from ..printable import brief
from ..units import whole_number
from . import printing as console
from .chart_commands import chart_app
from .contact_command import CONTACT_EXAMPLE, contact
from .cosim_command import COSIM_EXAMPLE, cosim
from .damper_command import DAMPER_EXAMPLE, damper
from .damper_run_command import DAMPER_RUN_EXAMPLE, damper_run
from .rotor_command import ROTOR_EXAMPLE, rotor
from .sweep_command import SWEEP_EXAMPLE, sweep

if TYPE_CHECKING:
    from ..bearings.films.geometry import Groove
    from ..bearings.journal import GrooveMapTable, JournalBearing
    from ..scenes import Scene
    from ..scenes.journal.film_tables import FilmTable
    from ..scenes.schema import JournalTable

BAD_INPUT = 2
FAILED = 1

app = typer.Typer(
    no_args_is_help=True,
    add_completion=False,
    pretty_exceptions_enable=False,
    epilog="Example: rotorfilm solve examples/question.toml --explain",
    context_settings={"help_option_names": ["-h", "--help"]},
)
app.add_typer(chart_app, name="chart", epilog="Example: rotorfilm chart journal --ld 0.5 --out pictures")

fmu = typer.Typer(
    help="Build FMUs of a scene, check one, show what is in one.",
    no_args_is_help=True,
    context_settings={"help_option_names": ["-h", "--help"]},
)
app.add_typer(fmu, name="fmu", epilog="Example: rotorfilm fmu build examples/friswell.toml --out fmus")


class FmiVersion(StrEnum):
    """FMI versions of an export."""

    TWO = "2.0"
    THREE = "3.0"


class Backend(StrEnum):
    """What runs a model inside an FMU: the C library, or Python."""

    NATIVE = "native"
    PYTHON = "python"


class Platforms(StrEnum):
    """Machines for which a native FMU carries a library."""

    HOST = "host"
    ALL = "all"


SceneFile = Annotated[Path, typer.Argument(metavar="SCENE.toml", help="Scene file of schema 1.")]
FmuFile = Annotated[Path, typer.Argument(metavar="FILE.fmu", help="FMU of FMI 2.0 or 3.0.")]
Json = Annotated[bool, typer.Option("--json", help="Print JSON on stdout instead of tables.")]
Grooves = Annotated[
    list[str] | None,
    typer.Option(help="Center and width of an axial groove; once for each.", metavar='"90 deg, 20 deg"'),
]


def _show_version(wanted: bool) -> None:
    if wanted:
        from importlib import metadata

        typer.echo(f"rotorfilm {metadata.version('rotorfilm')}")
        raise typer.Exit


@app.callback()
def options(
    version: Annotated[
        bool,
        typer.Option("--version", help="Print the version and exit.", callback=_show_version, is_eager=True),
    ] = False,
) -> None:
    """Bearing films for rotor dynamics: static and dynamic coefficients, FMUs, coupled simulation."""


@app.command(epilog="Example: rotorfilm solve examples/question.toml --explain")
def solve(
    scene: SceneFile,
    explain: Annotated[
        bool, typer.Option("--explain", help="Show the whole ladder behind the answer to a question.")
    ] = False,
    json: Json = False,
) -> None:
    """Answer a scene: its question, or else equilibrium, stiffness, damping and whirl threshold.

    Exits with 1 where no rung meets the tolerance of the question, or nothing is there to answer it; with 2
    for bad input.
    """
    from ..scenes import Scene

    loaded = Scene.load(scene)
    if loaded.question is not None:
        _print_question(scene, loaded, explain, json)
        return
    if explain:
        raise InputError(f"--explain must be given with a scene that has a [question], got {str(scene)!r}")
    if loaded.bush is not None and loaded.journal is None:
        melting = loaded.melting()
        if json:
            console.print_json(melting)
            return
        console.print_bush(melting)
        return
    _make_map(loaded.bearing)
    answer = loaded.describe()
    if json:
        console.print_json(answer)
        return
    console.print_answer(loaded.title, answer)


def _print_question(path: Path, scene: Scene, explain: bool, json: bool) -> None:
    from .question_printing import print_question

    try:
        answer = scene.ask()
    except InputError as error:
        raise InputError(f"{path}: {error}") from None
    if json:
        console.print_json(answer)
    else:
        print_question(scene.title, answer, explain=explain)
    if not answer.met:
        console.complain("error", answer.message)
        raise typer.Exit(FAILED)


@app.command(
    epilog='Example: rotorfilm coefficients --radius "50 mm" --length "30 mm" --clearance "0.1 mm" '
    '--viscosity "0.1 Pa s" --load "525 N" --speed "1500 rpm"'
)
def coefficients(
    radius: Annotated[str, typer.Option(help="Journal radius.", metavar='"50 mm"')],
    length: Annotated[str, typer.Option(help="Axial length.", metavar='"30 mm"')],
    clearance: Annotated[str, typer.Option(help="Radial clearance.", metavar='"0.1 mm"')],
    viscosity: Annotated[str, typer.Option(help="Dynamic viscosity.", metavar='"0.1 Pa s"')],
    load: Annotated[str, typer.Option(help='Static load: downward, or "X,Y" components.', metavar='"525 N"')],
    speed: Annotated[str, typer.Option(help="Angular speed about +z.", metavar='"1500 rpm"')],
    film: Annotated[
        str, typer.Option(help="Film law: map, grooved_map, reynolds, short or splitting.", metavar="NAME")
    ] = "map",
    order: Annotated[
        str | None, typer.Option(help='Splitting order, "N,M" or "N,inf".', metavar="2,inf")
    ] = None,
    constant: Annotated[bool, typer.Option("--constant", help="Splitting film with the function 1.")] = False,
    rupture: Annotated[
        str | None,
        typer.Option(
            help="Where the splitting film ends: fixed, rotating, reynolds or complementarity.",
            metavar="KIND",
        ),
    ] = None,
    cells: Annotated[
        str | None,
        typer.Option(help='Cells of the reynolds or grooved_map film, "AROUND,ALONG".', metavar="96,8"),
    ] = None,
    groove: Grooves = None,
    json: Json = False,
) -> None:
    """Find equilibrium, stiffness and damping of a journal bearing; numbers without a unit are SI."""
    from ..linear import coefficients as film_coefficients
    from ..linear import equilibrium
    from ..scenes.journal.echo import bearing_data, film_name
    from ..scenes.journal.journal_remarks import film_remarks
    from ..scenes.lubricant_table import LubricantTable

    geometry = {"radius": radius, "length": length, "clearance": clearance, "viscosity": viscosity}
    bearing = _journal(geometry, _film(film, order, constant, rupture, cells), groove or []).build()
    _make_map(bearing)
    force, rate = _operation(load, speed)
    at = equilibrium(bearing, force, rate)
    derivatives = film_coefficients(bearing, at.position, rate)
    data, name = bearing_data(bearing), film_name(bearing.fitted_film)
    remarks = film_remarks(bearing, LubricantTable(), rate, force)
    if json:
        found = {"bearing": data, "model": name, "equilibrium": at, "coefficients": derivatives}
        console.print_json({**found, "remarks": remarks})
        return
    rows = [*console.bearing_rows(data), ("film", name), *console.equilibrium_rows(at)]
    rows += [*console.coefficient_rows(derivatives), *console.remark_rows(remarks)]
    console.print_rows("journal bearing", rows)


@fmu.command(epilog="Example: rotorfilm fmu build examples/friswell.toml --out fmus --fmi 3.0")
def build(
    scene: SceneFile,
    out: Annotated[Path, typer.Option(help="Folder for the FMUs; made if absent.")] = Path("."),
    fmi: Annotated[FmiVersion, typer.Option(help="FMI version.")] = FmiVersion.TWO,
    backend: Annotated[
        Backend | None, typer.Option(help="What runs in them; by default native where there is a kernel.")
    ] = None,
    platforms: Annotated[Platforms, typer.Option(help="This machine's platform, or all of them.")] = (
        Platforms.HOST
    ),
    json: Json = False,
) -> None:
    """Export the film and the rotor of a scene as FMUs; a flexible rotor as one, with its bearings in it."""
    from ..scenes import Scene
    from ..scenes.export_scene import export_scene
    from ..scenes.shaft.export_rotor import export_system

    loaded = Scene.load(scene)
    whole = loaded.shaft is not None and loaded.journal is None
    if loaded.journal is not None and loaded.damper is None:
        _make_map(loaded.bearing)
    made = (export_system if whole else export_scene)(
        loaded,
        out,
        version=fmi.value,
        backend=None if backend is None else backend.value,
        platforms=platforms.value,
    )
    files = {name: str(path) for name, path in made._asdict().items()}
    if json:
        console.print_json(files)
        return
    console.print_rows("FMUs", list(files.items()))


@fmu.command(epilog="Example: rotorfilm fmu check film.fmu")
def check(file: FmuFile, json: Json = False) -> None:
    """Check description, derivatives, FMU states and reference trajectory; exit with 1 if one fails."""
    from ..fmu import check_fmu

    items = check_fmu(file)
    if json:
        console.print_json([item._asdict() for item in items])
    else:
        console.print_rows(str(file), [console.check_row(*item) for item in items])
    if any(item.passed is False for item in items):
        raise typer.Exit(FAILED)


@fmu.command(epilog="Example: rotorfilm fmu info film.fmu --json")
def info(file: FmuFile, json: Json = False) -> None:
    """Show what an FMU says of itself: version, interfaces, platforms, variables."""
    from ..fmu import describe_fmu

    found = describe_fmu(file)
    if json:
        console.print_json(found)
        return
    variables = found.pop("variables")
    shown = {key: ", ".join(value) if isinstance(value, list) else value for key, value in found.items()}
    console.print_rows(str(file), [(key, str(value)) for key, value in shown.items()])
    console.print_table("variables", variables)


@app.command(
    epilog='Example: rotorfilm groove-map --slenderness 0.5 --groove "90 deg, 20 deg" '
    '--groove "270 deg, 20 deg"'
)
def groove_map(
    scene: Annotated[
        Path | None, typer.Argument(metavar="SCENE.toml", help="Scene whose bearing has grooves or pads.")
    ] = None,
    slenderness: Annotated[
        float | None, typer.Option(help="Without a scene: length / diameter.", metavar="0.5")
    ] = None,
    groove: Grooves = None,
    cells: Annotated[
        str | None,
        typer.Option(help="Without a scene: cells around the film and along half of it.", metavar="192,12"),
    ] = None,
    nodes: Annotated[
        str | None,
        typer.Option(
            help="Without a scene: nodes over eccentricity, its direction, motion.", metavar="12,72,48"
        ),
    ] = None,
    out: Annotated[Path | None, typer.Option(help="File for a copy of the map.")] = None,
    json: Json = False,
) -> None:
    """Make the map of a bearing with grooves or pads; all of its shape and resolution find it on disk."""
    from ..bearings.films.table_cache import cache_folder

    options = {"--slenderness": slenderness, "--groove": groove, "--cells": cells, "--nodes": nodes}
    if scene is None:
        table = _map_of_options(slenderness, groove, cells, nodes)
    elif given := [name for name, value in options.items() if value]:
        raise InputError(f"{given[0]} must not be given with a scene, got {options[given[0]]!r}")
    else:
        table = _map_of_scene(scene)
    if out is not None:
        table.save(out)
    folder, reach = str(cache_folder()), table.largest_eccentricity_ratio
    if json:
        console.print_json(
            {"folder": folder, "slenderness": table.slenderness, "largest_eccentricity_ratio": reach}
        )
        return
    rows = [("kept in", folder), ("length / diameter", f"{table.slenderness:.9g}")]
    console.print_rows("map of the film", [*rows, ("eccentricity ratios", f"up to {reach:.3g}")])


@app.command(epilog='Example: rotorfilm bush --load "3750 N" --speed "9 rad/s" --set f0=0.12')
def bush(
    load: Annotated[str, typer.Option(help="Radial load.", metavar='"3750 N"')],
    speed: Annotated[str | None, typer.Option(help="Angular speed to evaluate.", metavar='"9 rad/s"')] = None,
    settlement: Annotated[str, typer.Option(help="Up to which the liner may wear.")] = "0 mm",
    change: Annotated[
        list[str] | None, typer.Option("--set", help="Other value than the example's.", metavar="NAME=VALUE")
    ] = None,
    published: Annotated[
        bool, typer.Option("--published", help="Shaft heat by the published formula.")
    ] = False,
    whole_shaft: Annotated[bool, typer.Option("--global", help="Balance heat over the whole shaft.")] = False,
    json: Json = False,
) -> None:
    """Find contact and critical speeds of a polymer bush that melts: the published example unless set."""
    from ..bearings.bush import ApproximateShaft, GlobalBalance
    from ..scenes.bush.solve_bush import bush_from_settings, solve_bush
    from ..scenes.tables import Quantity

    pairs = [text.partition("=")[::2] for text in change or ()]
    model = bush_from_settings({name.strip(): value.strip() for name, value in pairs})
    model = replace(model, shaft_heat=ApproximateShaft()) if published else model
    model = replace(model, balance=GlobalBalance()) if whole_shaft else model
    rate = None if speed is None else Quantity("rad/s")("--speed", speed)
    worn = Quantity("m")("--settlement", settlement)
    answer = solve_bush(model, Quantity("N")("--load", load), rate, worn)
    if json:
        console.print_json(answer)
        return
    console.print_bush(answer)


@app.command(epilog="Example: rotorfilm demo --out rotorfilm-demo")
def demo(
    out: Annotated[Path, typer.Option(help="Folder for results, FMUs and charts.")] = Path("rotorfilm-demo"),
    json: Json = False,
) -> None:
    """Run the whole way on a real bearing: equilibrium, stability, FMUs, coupled simulation, charts."""
    with console.progress_display() as report:
        report(0.0, "packages")
        from ..scenes import bundled_scene
        from ..scenes.demo import plain_results, run_demo
        from .demo_pictures import draw_demo

        result = run_demo(out, bundled_scene(), report)
        report(0.95, "charts")
        charts = draw_demo(result, out)
        report(1.0, "done")
    if json:
        console.print_json({**plain_results(result), "charts": [chart.name for chart in charts]})
        return
    console.print_demo(result)
    notes = {"demo.png": "overview: orbits, coupling error, whirl, force error"}
    console.print_rows("files", [(path.name, notes.get(path.name, "")) for path in sorted(out.iterdir())])


app.command(epilog=COSIM_EXAMPLE)(cosim)
app.command(epilog=DAMPER_EXAMPLE)(damper)
app.command(epilog=DAMPER_RUN_EXAMPLE)(damper_run)
app.command(epilog=CONTACT_EXAMPLE)(contact)
app.command(epilog=ROTOR_EXAMPLE)(rotor)
app.command(epilog=SWEEP_EXAMPLE)(sweep)


def main(arguments: list[str] | None = None) -> None:
    """Run the command line; exit with 0, with 1 for a failed computation, with 2 for bad input."""
    try:
        with warnings.catch_warnings():
            warnings.showwarning = _show_warning  # type: ignore[assignment]
            app(arguments)
    except (RotorfilmError, OSError, MemoryError) as error:
        message = f"not enough memory: {error}" if isinstance(error, MemoryError) else str(error)
        console.complain("error", message)
        if "--json" in (sys.argv if arguments is None else arguments):
            console.print_json({"error": type(error).__name__, "message": message})
        sys.exit(BAD_INPUT if isinstance(error, InputError | SceneError | OSError) else FAILED)


def _make_map(bearing: JournalBearing) -> None:
    """Make the map of a bearing that needs one of its own, with a progress bar, unless it lies on disk."""
    from ..bearings.journal import GroovedMapFilm, build_groove_map

    if isinstance(bearing.fitted_film, GroovedMapFilm):
        with console.progress_display() as report:
            build_groove_map(bearing, report)


def _map_of_scene(scene: Path) -> GrooveMapTable:
    from ..bearings.journal import build_groove_map
    from ..scenes import Scene

    with console.progress_display() as report:
        return build_groove_map(Scene.load(scene).bearing, report)


def _map_of_options(
    slenderness: float | None, groove: list[str] | None, cells: str | None, nodes: str | None
) -> GrooveMapTable:
    from ..bearings.films.geometry import FilmGeometry
    from ..bearings.journal import GroovedMapFilm
    from ..scenes.journal.film_tables import read_cells, read_nodes

    if slenderness is None or not groove:
        raise InputError("groove-map must have SCENE.toml, or --slenderness and --groove, got neither")
    geometry = FilmGeometry(grooves=tuple(_groove(text) for text in groove))
    film = GroovedMapFilm(geometry=geometry)
    if cells is not None:
        around, along = read_cells("--cells", _numbers(cells))
        film = replace(film, cells=(around, along))
    if nodes is not None:
        over, turning, moving = read_nodes("--nodes", _numbers(nodes))
        film = replace(film, nodes=(over, turning, moving))
    with console.progress_display() as report:
        return film.built_table(slenderness, report)


def _show_warning(message: Warning | str, category: type[Warning], *_: Any) -> None:
    """Show what a model says of itself and of its files; others warn their developers."""
    if issubclass(category, ValidityWarning | FileWarning):
        console.complain("warning", message)


def _film(film: str, order: str | None, constant: bool, rupture: str | None, cells: str | None) -> FilmTable:
    from ..scenes.journal.film_tables import FILMS
    from ..scenes.tables import choose, read_table

    given: dict[str, Any] = {
        "order": order and _numbers(order),
        "constant": constant,
        "rupture": rupture and {"kind": rupture},
        "cells": cells and _numbers(cells),
    }
    options = {name: value for name, value in given.items() if value}
    table = choose("--film", film, FILMS)
    for name in options:
        if name not in {field.name for field in fields(table)}:
            raise InputError(f"--{name} must not be given with --film {film}, got {options[name]!r}")
    return read_table(table, "--", options)


def _numbers(text: str) -> list[int | str]:
    """Return the integers between commas, and what is none as it is."""
    return [part if (number := whole_number(part)) is None else number for part in text.split(",")]


def _groove(text: str) -> Groove:
    """Return the groove of "CENTER, WIDTH"."""
    from ..bearings.films.geometry import Groove
    from ..scenes.tables import Quantity

    parts = [part.strip() for part in text.split(",")]
    if len(parts) != 2:
        raise InputError(f'--groove must be a center and a width, as "90 deg, 20 deg", got {brief(text)}')
    center, width = (Quantity("rad")("--groove", part) for part in parts)
    return Groove(center=center, width=width)


def _journal(geometry: dict[str, str], film: FilmTable, grooves: list[str]) -> JournalTable:
    from ..scenes.journal.film_tables import GrooveTable
    from ..scenes.schema import JournalTable
    from ..scenes.tables import read_table

    found = [_groove(text) for text in grooves]
    tables = tuple(GrooveTable(center=one.center, width=one.width) for one in found)
    return replace(read_table(JournalTable, "--", geometry), film=film, grooves=tables)


def _operation(load: str, speed: str) -> tuple[tuple[float, float], float]:
    """Return the load [N] and the speed [rad/s]."""
    from ..scenes.schema import OperationTable
    from ..scenes.tables import read_table

    components = load.split(",")
    options = {"load": components if len(components) > 1 else load, "speed": speed}
    table = read_table(OperationTable, "--", options)
    assert table.load is not None
    return table.load, table.speed
