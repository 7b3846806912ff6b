"""The command line: solve a scene, tabulate coefficients, export FMUs, run the demonstration."""

# Packages that take long to import are imported inside the commands, so that --help answers at once.

from __future__ import annotations

import sys
import warnings
from enum import StrEnum
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from . import console
from .errors import InputError, RotorfilmError, SceneError

if TYPE_CHECKING:
    from .scenes.schema import FilmTable, JournalTable

BAD_INPUT = 2
FAILED = 1

app = typer.Typer(
    help="Bearing films for rotor dynamics: static and dynamic coefficients, FMUs, coupled simulation.",
    no_args_is_help=True,
    add_completion=False,
    pretty_exceptions_enable=False,
    context_settings={"help_option_names": ["-h", "--help"]},
)


class Film(StrEnum):
    """Film laws that the command line offers."""

    MAP = "map"
    SHORT = "short"
    SPLITTING = "splitting"


class Rupture(StrEnum):
    """Rupture rules of the splitting film."""

    FIXED = "fixed"
    ROTATING = "rotating"


SceneFile = Annotated[Path, typer.Argument(metavar="SCENE.toml", help="Scene file of schema 1.")]
Json = Annotated[bool, typer.Option("--json", help="Print JSON on stdout instead of tables.")]


@app.command(epilog="Example: rotorfilm solve examples/friswell.toml --json")
def solve(scene: SceneFile, json: Json = False) -> None:
    """Find equilibrium, stiffness, damping and whirl threshold of a scene."""
    from .scenes import Scene

    loaded = Scene.load(scene)
    answer = loaded.solve()
    if json:
        console.print_json(answer)
        return
    console.print_answer(loaded.title, answer)


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
    film: Annotated[Film, typer.Option(help="Film law.")] = Film.SHORT,
    order: Annotated[
        str | None, typer.Option(help='Splitting order, "N,M" or "N,inf".', metavar="2,inf")
    ] = None,
    rupture: Annotated[Rupture | None, typer.Option(help="Where the splitting film ends.")] = None,
    json: Json = False,
) -> None:
    """Find equilibrium, stiffness and damping of a journal bearing; numbers without a unit are SI."""
    from .linear import coefficients as film_coefficients
    from .linear import equilibrium

    geometry = {"radius": radius, "length": length, "clearance": clearance, "viscosity": viscosity}
    bearing = _journal(geometry, _film(film, order, rupture)).build()
    force, rate = _operation(load, speed)
    at = equilibrium(bearing, force, rate)
    derivatives = film_coefficients(bearing, at.position, rate)
    if json:
        console.print_json({"model": repr(bearing.film), "equilibrium": at, "coefficients": derivatives})
        return
    rows = [("film", repr(bearing.film)), *console.equilibrium_rows(at)]
    console.print_rows("journal bearing", rows + console.coefficient_rows(derivatives))


@app.command(epilog="Example: rotorfilm fmu examples/friswell.toml --out fmus")
def fmu(
    scene: SceneFile,
    out: Annotated[Path, typer.Option(help="Folder for the FMUs; made if absent.")] = Path("."),
    json: Json = False,
) -> None:
    """Export the film and the rotor of a scene as FMI 2.0 co-simulation FMUs."""
    from .scenes import Scene
    from .scenes.export import export_scene

    files = {name: str(path) for name, path in export_scene(Scene.load(scene), out)._asdict().items()}
    if json:
        console.print_json(files)
        return
    console.print_rows("FMUs", list(files.items()))


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
    from dataclasses import replace

    from .films import ApproximateShaft, GlobalBalance
    from .scenes.bush import bush_from_settings, solve_bush
    from .units import parse_quantity

    pairs = [text.partition("=")[::2] for text in change or ()]
    model = bush_from_settings({name.strip(): value.strip() for name, value in pairs})
    model = replace(model, shaft_heat=ApproximateShaft()) if published else model
    model = replace(model, balance=GlobalBalance()) if whole_shaft else model
    rate = None if speed is None else parse_quantity(speed, "rad/s")
    answer = solve_bush(model, parse_quantity(load, "N"), rate, parse_quantity(settlement, "m"))
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
        from .gallery import draw_demo
        from .scenes import bundled_scene
        from .scenes.demo import plain_results, run_demo

        result = run_demo(out, bundled_scene(), report)
        report(0.95, "charts")
        charts = draw_demo(result, out)
        report(1.0, "done")
    if json:
        console.print_json({**plain_results(result), "charts": [chart.name for chart in charts]})
        return
    console.print_demo(result)
    console.print_rows("files", [(path.name, "") for path in sorted(out.iterdir())])


def main(arguments: list[str] | None = None) -> None:
    """Run the command line; exit with 0, with 1 for a failed computation, with 2 for bad input."""
    try:
        with warnings.catch_warnings():
            warnings.showwarning = _show_warning  # type: ignore[assignment]
            app(arguments)
    except (InputError, SceneError, OSError) as error:
        console.complain("error", error)
        sys.exit(BAD_INPUT)
    except RotorfilmError as error:
        console.complain("error", error)
        sys.exit(FAILED)


def _show_warning(message: Warning | str, *_: Any) -> None:
    console.complain("warning", message)


def _film(film: Film, order: str | None, rupture: Rupture | None) -> FilmTable:
    from .scenes.schema import FILMS
    from .scenes.tables import read_table

    options: dict[str, Any] = {}
    if film is not Film.SPLITTING and (order, rupture) != (None, None):
        raise InputError(f"--order and --rupture need --film splitting, got --film {film.value}")
    if order is not None:
        options["order"] = [int(part) if part.strip().isdigit() else part for part in order.split(",")]
    if rupture is not None:
        options["rupture"] = {"kind": rupture.value}
    return read_table(FILMS[film.value], "--", options)


def _journal(geometry: dict[str, str], film: FilmTable) -> JournalTable:
    from dataclasses import replace

    from .scenes.schema import JournalTable
    from .scenes.tables import read_table

    return replace(read_table(JournalTable, "--", geometry), film=film)


def _operation(load: str, speed: str) -> tuple[tuple[float, float], float]:
    """Return the load [N] and the speed [rad/s]."""
    from .scenes.schema import OperationTable
    from .scenes.tables import read_table

    components = load.split(",")
    options = {"load": components if len(components) > 1 else load, "speed": speed}
    table = read_table(OperationTable, "--", options)
    assert table.load is not None
    return table.load, table.speed
