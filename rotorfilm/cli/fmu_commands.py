"""The commands `rotorfilm fmu ...`: build FMUs of a scene, check one, show what is in one."""

from __future__ import annotations

from functools import partial
from pathlib import Path
from typing import Annotated, Any, Literal

from ..core.progress import Report
from . import printing as console
from .command import Argument, CommandOutput, Option, SceneFile, Settings, inside, load_scene

FmuFile = Annotated[Path, Argument(metavar="FILE.fmu", help="FMU of FMI 2.0 or 3.0.")]


def build(
    scene: SceneFile,
    report: Report,
    changes: Settings = None,
    out: Annotated[Path, Option(help="Folder for the FMUs; made if absent.")] = Path("."),
    fmi: Annotated[Literal["2.0", "3.0"], Option(help="FMI version.")] = "2.0",
    backend: Annotated[
        Literal["native", "python"] | None,
        Option(help="What runs in them; by default native where there is a kernel."),
    ] = None,
    platforms: Annotated[
        Literal["host", "all"], Option(help="This machine's platform, or all of them.")
    ] = "host",
    ssp: Annotated[bool, Option("--ssp", help="Write system.ssp too: film and rotor, connected.")] = False,
) -> CommandOutput:
    """Export the film and the rotor of a scene as FMUs; a flexible rotor as one, with its bearings in it.

    So is a rotor on a damper whose oil has mass.

    Example: rotorfilm fmu build examples/friswell.toml --out fmus --fmi 3.0
    """
    from ..reports.answer_rows import RPM
    from ..scenes.export_scene import export_scene, export_scene_system, system_speed

    loaded = load_scene(scene, changes)
    with inside(scene):
        if loaded.has_film and loaded.damper is None:
            loaded.film_table.make_map(report)
        made = export_scene(loaded, out, version=fmi, backend=backend, platforms=platforms)
        files = {name: str(path) for name, path in made.items()}
        if ssp:
            made_system = export_scene_system(loaded, out / "system.ssp", version=fmi, platforms=platforms)
            files["ssp"] = str(made_system)
    rows = [*files.items()]
    if loaded.shaft is not None:
        rows += [("speed", f"{system_speed(loaded) * RPM:.6g} rpm")]
    return CommandOutput(files, partial(console.print_rows, "FMUs", rows))


def check(file: FmuFile) -> CommandOutput:
    """Check description, derivatives, FMU states and reference trajectory; exit with 1 if one fails.

    Example: rotorfilm fmu check film.fmu
    """
    from ..fmu import check_fmu

    items = check_fmu(file)
    rows = [_check_row(*item) for item in items]
    failed = any(item.passed is False for item in items)
    data = [item._asdict() for item in items]
    return CommandOutput(data, partial(console.print_rows, str(file), rows), "" if failed else None)


def _check_row(check: str, passed: bool | None, figure: float | None, remark: str) -> tuple[str, str]:
    verdict = {True: "passed", False: "FAILED", None: "not applicable"}[passed]
    measured = "" if figure is None else f" {figure:.2g}"
    return check, f"{verdict}:{measured} {remark}"


def info(file: FmuFile) -> CommandOutput:
    """Show what an FMU says of itself: version, interfaces, platforms, variables.

    Example: rotorfilm fmu info film.fmu --json
    """
    from ..fmu import describe_fmu

    found = describe_fmu(file)
    return CommandOutput(found, partial(_print_info, str(file), found))


NUMBER = len("-1.23456e-05")
"""Width of a number with six digits."""


def _cell(key: str, value: Any) -> str:
    """Return what a table shows of a variable: start values with six digits, of which an array has many."""
    text = "" if value is None else str(value)
    try:
        return " ".join(f"{float(number):.6g}" for number in text.split()) if key == "start" else text
    except ValueError:  # a text, or true and false
        return text


def _print_info(title: str, found: dict[str, Any]) -> None:
    variables = found["variables"]
    shown = {key: value for key, value in found.items() if value is not variables}
    rows = {key: ", ".join(value) if isinstance(value, list) else str(value) for key, value in shown.items()}
    console.print_rows(title, rows.items())
    table = console.plain_table("variables")
    for key in variables[0] if variables else ():
        table.add_column(key, overflow="fold", min_width=NUMBER if key == "start" else None)
    cells = [[_cell(key, value) for key, value in row.items()] for row in variables]
    console.plain_console().print(console.filled(table, cells))
