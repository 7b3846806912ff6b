"""The commands `rotorfilm damper` and `rotorfilm damper-run`: a rigid rotor on a squeeze-film damper."""

from __future__ import annotations

import math
import tempfile
from enum import StrEnum
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

from ..core.results import CircularOrbit, write_csv
from . import printing as console
from .command import Argument, Option, Said, SignalFile, inside, make_room, written_rows

if TYPE_CHECKING:
    from ..bearings.damper import EndSeal, PorousCage
    from ..scenes import Scene
    from ..scenes.solve_damper import DamperAnswer, DamperRun


class Squeeze(StrEnum):
    """Film laws by their names in scene files."""

    SHORT = "short"
    MAP = "map"
    FINITE = "finite"
    FINITE_MAP = "finite_map"
    PUBLISHED = "published"


UNITS = {
    **dict.fromkeys(("radius", "length", "clearance", "thickness", "gap", "gap_length"), "m"),
    "viscosity": "Pa.s",
    "density": "kg/m3",
    "mass": "kg",
    "speed": "rad/s",
    "unbalance": "kg.m",
    "stiffness": "N/m",
    "permeability": "m2",
    "leakage": "m2/(Pa.s)",
}
"""Of the options that are quantities."""


def damper(
    radius: Annotated[str, Option(help="Radius of the film.", metavar='"50 mm"')],
    length: Annotated[str, Option(help="Axial length.", metavar='"25 mm"')],
    clearance: Annotated[str, Option(help="Radial clearance.", metavar='"0.1 mm"')],
    viscosity: Annotated[str, Option(help="Dynamic viscosity.", metavar='"4.1e-4 Pa s"')],
    mass: Annotated[str, Option(help="Mass on this damper.", metavar='"10 kg"')],
    speed: Annotated[str, Option(help="Angular speed.", metavar='"400 rad/s"')],
    unbalance: Annotated[str, Option(help="Mass times eccentricity.", metavar='"400 g mm"')],
    stiffness: Annotated[str, Option(help="Of the retainer springs.", metavar='"2.56e5 N/m"')] = "0",
    thickness: Annotated[
        str | None, Option(help="Of the porous cage; solid without.", metavar='"2.5 mm"')
    ] = None,
    permeability: Annotated[
        str | None, Option(help="Of the porous cage at the film.", metavar='"0.4 um2"')
    ] = None,
    grading: Annotated[float, Option(help="lambda of k = A exp(lambda y/H).")] = 0.0,
    anisotropy: Annotated[float, Option(help="Permeability along the cage / through it.")] = 1.0,
    vented: Annotated[bool, Option("--vented", help="Open back of the cage.")] = False,
    full: Annotated[bool, Option("--full", help="Full film, tension included.")] = False,
    film: Annotated[Squeeze, Option(help="Film law.")] = Squeeze.SHORT,
    density: Annotated[
        str, Option(help="Of the oil, whose inertia then counts.", metavar='"850 kg/m3"')
    ] = "0",
    leakage: Annotated[
        str | None, Option(help="Of seals at both ends; 0 for tight ones.", metavar='"4e-10 m2/(Pa s)"')
    ] = None,
    gap: Annotated[str | None, Option(help="Of seals that are gaps, instead.", metavar='"30 um"')] = None,
    gap_length: Annotated[str | None, Option(help="Along the axis.", metavar='"2 mm"')] = None,
    chart: Annotated[Path | None, Option(help="Draw the transmissibility into this PNG.")] = None,
) -> Said:
    """Find the synchronous orbits of an unbalanced rotor on a solid or porous squeeze-film damper.

    Beyond a squeeze Reynolds number of 20 (10 where the film ruptures) the inertia of the oil is refused.
    """
    from ..bearings.damper import PorousDamper
    from ..bearings.films.geometry import FullFilm, HalfSommerfeld
    from ..scenes.damper_table import SQUEEZES
    from ..scenes.solve_damper import solve_damper

    size = _in_si(radius=radius, length=length, clearance=clearance, viscosity=viscosity, density=density)
    rotor = _in_si(mass=mass, speed=speed, unbalance=unbalance, stiffness=stiffness)
    support = PorousDamper(
        **size,
        seals=_seals(leakage, gap, gap_length, size),
        extent=FullFilm() if full else HalfSommerfeld(),
        cage=_cage(thickness, permeability, grading, anisotropy, vented),
        film=SQUEEZES[film.value].makes(),
    )
    answer = solve_damper(support, **rotor)
    if chart is not None:
        from ..charts import plot_transmissibility, save

        unit = rotor["mass"] * support.clearance
        save(plot_transmissibility({"damper": answer.response}, unit=unit), chart)
    return Said(answer, partial(console.print_rows, "rotor on a squeeze-film damper", damper_rows(answer)))


def _in_si(**texts: str | None) -> dict[str, Any]:
    """Return the numbers of options, those that are not given left out."""
    from ..scenes.reading import Quantity

    given = {name: text for name, text in texts.items() if text is not None}
    return {name: Quantity(UNITS[name])(f"--{name.replace('_', '-')}", text) for name, text in given.items()}


def damper_rows(answer: DamperAnswer) -> list[tuple[str, str]]:
    """Return the rows that describe an answer."""
    groups, small = answer.groups, answer.small_motion
    folds = ", ".join(
        f"{'up' if fold.upward else 'down'} at {_mass(fold.unbalance)}" for fold in answer.folds
    )
    contact = "none" if answer.contact_unbalance is None else f"from {_mass(answer.contact_unbalance)} on"
    return [
        (
            "squeeze number Bs, permeability number",
            f"{groups.squeeze_number:.5g}, {groups.permeability_number:.5g}",
        ),
        ("spring ratio, unbalance ratio", f"{groups.spring_ratio:.5g}, {groups.unbalance_ratio:.5g}"),
        (
            "K, C of an orbit of clearance/100",
            f"{small.stiffness:.6g} N/m, {small.damping:.6g} N s/m",
        ),
        *[("orbit", _orbit(orbit)) for orbit in answer.orbits],
        *([] if answer.orbits else [("orbit", "none: the rotor hits the wall")]),
        ("jumps", folds or "none"),
        ("contact", contact),
    ]


def _orbit(orbit: CircularOrbit) -> str:
    return (
        f"eccentricity ratio {orbit.eccentricity_ratio:.5f}, lag {-math.degrees(orbit.phase):.4g} deg, "
        f"transmissibility {orbit.transmissibility:.5g}, {'stable' if orbit.stable else 'unstable'}"
    )


def _mass(unbalance: float) -> str:
    return f"{unbalance * 1e6:.5g} g mm"


def _cage(
    thickness: str | None, permeability: str | None, grading: float, anisotropy: float, vented: bool
) -> PorousCage | None:
    from ..bearings.damper import PorousCage
    from ..core.errors import InputError

    if thickness is None and permeability is None:
        if (grading, anisotropy, vented) != (0.0, 1.0, False):
            raise InputError("--grading, --anisotropy and --vented need --thickness and --permeability")
        return None
    if thickness is None or permeability is None:
        raise InputError("--thickness and --permeability must be given together")
    size = _in_si(thickness=thickness, permeability=permeability)
    return PorousCage(**size, grading=grading, anisotropy=anisotropy, vented=vented)


def _seals(
    leakage: str | None, gap: str | None, gap_length: str | None, size: dict[str, float]
) -> EndSeal | None:
    from ..scenes.damper_table import SealsTable

    given = _in_si(leakage=leakage, gap=gap, gap_length=gap_length)
    return SealsTable(**given).seal(viscosity=size["viscosity"], radius=size["radius"]) if given else None


def damper_run(
    scene: Annotated[
        Path, Argument(metavar="SCENE.toml", help="Scene file with a damper and a rigid rotor.")
    ],
    fmus: Annotated[bool, Option("--fmus", help="As two FMUs, instead of one system.")] = False,
    out: SignalFile = None,
    chart: Annotated[Path | None, Option(help="Draw eccentricity and force over time into this PNG.")] = None,
) -> Said:
    """Follow a rotor on a damper after a blade is lost, over a run-up or with its unbalance.

    Where the rotor reaches the wall, or the end of a film's range, the motion until then is shown and
    written, and the command exits with 1.
    """
    from ..scenes import Scene

    loaded = Scene.load(scene)
    make_room(out)
    with inside(scene):
        run = _run(loaded, fmus)
    if out is not None:
        write_csv(out, {"time": run.trajectory.time, **run.trajectory.signals})
    if chart is not None:
        from ..charts import plot_damper_run, save

        save(plot_damper_run(run.trajectory.time, run.eccentricity_ratio, run.force), chart)
    failure = None if run.contact_time is None else contact_message(run)
    rows = damper_run_rows(run) + written_rows(out)
    return Said(plain_run(run), partial(console.print_rows, loaded.title, rows), failure)


def _run(scene: Scene, fmus: bool) -> DamperRun:
    from ..scenes.solve_damper import couple_damper, run_damper

    if not fmus:
        return run_damper(scene)
    with tempfile.TemporaryDirectory() as folder:
        return couple_damper(scene, Path(folder))


def contact_message(run: DamperRun) -> str:
    """Return what a run that did not end says."""
    return (
        f"the rotor must stay inside the clearance and the film's range, got an eccentricity ratio of "
        f"{run.eccentricity_ratio[-1]:.4g} at {run.contact_time:.6g} s; what is shown ends there"
    )


def plain_run(run: DamperRun) -> dict[str, object]:
    """Return a run as plain numbers."""
    return {
        "peak_eccentricity_ratio": run.peak_eccentricity_ratio,
        "peak_force": run.peak_force,
        "final_eccentricity_ratio": float(run.eccentricity_ratio[-1]),
        "contact_time": run.contact_time,
        "start": float(run.trajectory.time[0]),
        "end": float(run.trajectory.time[-1]),
        "work": dict(run.trajectory.work),
    }


def damper_run_rows(run: DamperRun) -> list[tuple[str, str]]:
    """Return the rows that describe a run."""
    time = run.trajectory.time
    calls = ", ".join(f"{count} {name.replace('_', ' ')}" for name, count in run.trajectory.work.items())
    return [
        ("from", f"{time[0]:.6g} s"),
        ("to", f"{time[-1]:.6g} s"),
        ("largest eccentricity ratio", f"{run.peak_eccentricity_ratio:.5f}"),
        ("eccentricity ratio at the end", f"{run.eccentricity_ratio[-1]:.5f}"),
        ("largest force on the housing", f"{run.peak_force:.5g} N"),
        ("contact", "none" if run.contact_time is None else f"at {run.contact_time:.6g} s"),
        ("work", calls),
    ]
