"""The command line: every command with its example, and what becomes of errors and warnings."""

# Packages that take long to import are imported inside the commands, so that --help answers at once.

from __future__ import annotations

import sys
import warnings
from typing import Annotated, Any

import typer

from ..errors import FileWarning, InputError, RotorfilmError, SceneError, ValidityWarning
from . import printing as console
from .bush_command import bush
from .chart_commands import CHARTS
from .command import BAD_INPUT, FAILED, Commands, group
from .contact_command import contact
from .cosim_command import cosim
from .damper_command import damper, damper_run
from .demo_command import demo
from .fmu_commands import build, check, info
from .journal_commands import coefficients, groove_map
from .rotor_command import rotor
from .solve_command import solve
from .sweep_command import sweep

COMMANDS: Commands = {
    solve: "solve examples/question.toml --explain",
    coefficients: 'coefficients --radius "50 mm" --length "30 mm" --clearance "0.1 mm" '
    '--viscosity "0.1 Pa s" --load "525 N" --speed "1500 rpm"',
    groove_map: 'groove-map --slenderness 0.5 --groove "90 deg, 20 deg" --groove "270 deg, 20 deg"',
    bush: 'bush --load "3750 N" --speed "9 rad/s" --set f0=0.12',
    demo: "demo --out rotorfilm-demo",
    cosim: 'cosim examples/friswell.toml --scheme si-exp3 --macro-angle "5 deg"',
    damper: 'damper --radius "50 mm" --length "25 mm" --clearance "0.1 mm" '
    '--viscosity "4.1e-4 Pa s" --mass "10 kg" --speed "400 rad/s" --stiffness "2.56e5 N/m" '
    '--unbalance "400 g mm" --thickness "2.5 mm" --permeability "0.4 um2"',
    damper_run: "damper-run examples/blade_loss.toml --out motion.csv",
    contact: 'contact --radius "10 mm" --mass "33 g" --modulus "206 GPa" --poisson-ratio 0.3 '
    '--viscosity "8 mPa s" --pressure-coefficient "5 1/GPa" --speed "0.9 m/s" --load "10 N" --sine 0.3 '
    '--frequency "12000 rad/s"; without dimensions: rotorfilm contact --v 0.1 --q0 5 --w 1 --step 0.7',
    rotor: "rotor examples/flexible_rotor.toml --out pictures",
    sweep: 'sweep examples/question.toml --vary "journal.clearance = 50 um, 60 um, 70 um" '
    '--vary "operation.speed = 1000 rpm : 3000 rpm : 5" --out sweep.nc',
}
"""Commands with their examples, in the order of the help."""

FMU_COMMANDS: Commands = {
    build: "fmu build examples/friswell.toml --out fmus --fmi 3.0",
    check: "fmu check film.fmu",
    info: "fmu info film.fmu --json",
}

app = group(
    "Bearing films for rotor dynamics: static and dynamic coefficients, FMUs, coupled simulation.",
    COMMANDS,
    add_completion=False,
    pretty_exceptions_enable=False,
    epilog="Example: rotorfilm solve examples/question.toml --explain",
)
app.add_typer(
    group(
        "Charts of a ladder of models, from the cheapest to the reference: PNG and CSV.", CHARTS, slow=True
    ),
    name="chart",
    epilog="Example: rotorfilm chart journal --ld 0.5 --out pictures",
)
app.add_typer(
    group("Build FMUs of a scene, check one, show what is in one.", FMU_COMMANDS),
    name="fmu",
    epilog="Example: rotorfilm fmu build examples/friswell.toml --out fmus",
)


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
    """Take what may stand before a command."""


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


def _show_warning(message: Warning | str, category: type[Warning], *_: Any) -> None:
    """Show what a model says of itself and of its files; others warn their developers."""
    if issubclass(category, ValidityWarning | FileWarning):
        console.complain("warning", message)
