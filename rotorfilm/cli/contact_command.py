"""The command `rotorfilm contact`: film, approach and load response of a lubricated rolling ball."""

from __future__ import annotations

from dataclasses import asdict
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

from ..core.limits import CONTACT_CELLS, LAW_STATES
from ..core.progress import Report
from . import printing as console
from .command import Option, Said

if TYPE_CHECKING:
    from collections.abc import Callable

    from ..bearings.contact import ContactRun, RollingBall
    from ..scenes.solve_contact import ContactAnswer, ContactCase, ContactResponse

BALL = (
    "radius", "modulus", "poisson_ratio", "viscosity", "pressure_coefficient", "speed", "load",
)  # fmt: skip
"""Options without which there is no ball."""

UNITS = {
    "radius": "m", "mass": "kg", "modulus": "Pa", "poisson_ratio": "1", "viscosity": "Pa.s",
    "pressure_coefficient": "1/Pa", "speed": "m/s", "load": "N", "plane_modulus": "Pa",
}  # fmt: skip


def contact(
    report: Report,
    radius: Annotated[str | None, Option(help="Of the ball.", metavar='"10 mm"')] = None,
    mass: Annotated[str | None, Option(help="Moving with the ball.", metavar='"33 g"')] = None,
    modulus: Annotated[str | None, Option(help="Of the ball.", metavar='"206 GPa"')] = None,
    poisson_ratio: Annotated[str | None, Option(help="Of the ball.", metavar="0.3")] = None,
    viscosity: Annotated[str | None, Option(help="At ambient pressure.", metavar='"8 mPa s"')] = None,
    pressure_coefficient: Annotated[str | None, Option(help="Of the viscosity.", metavar='"5 1/GPa"')] = None,
    speed: Annotated[str | None, Option(help="Of rolling.", metavar='"0.9 m/s"')] = None,
    load: Annotated[str | None, Option(help="Static, weight included.", metavar='"10 N"')] = None,
    plane_modulus: Annotated[str | None, Option(help="Of the plane; rigid without.")] = None,
    v: Annotated[float | None, Option("--v", help="Speed parameter V, instead of a ball.")] = None,
    q0: Annotated[float | None, Option("--q0", help="Pressure-viscosity coefficient Q0.")] = None,
    w: Annotated[float | None, Option("--w", help="Inertia W of the ball.")] = None,
    roelands: Annotated[bool, Option("--roelands", help="Roelands' viscosity.")] = False,
    compressible: Annotated[bool, Option("--compressible", help="Density that grows.")] = False,
    cells: Annotated[int, Option(help="Cells along each side of the rectangle.")] = 40,
    order: Annotated[int, Option(help="States of the reduced law.")] = 5,
    step: Annotated[float | None, Option(help="Jump of the load at t = 0, of the static one.")] = None,
    sine: Annotated[float | None, Option(help="Swing of the load, of the static one.")] = None,
    frequency: Annotated[
        str | None, Option(help="Angular, of the swing; plain for V, Q0.", metavar='"12000 rad/s"')
    ] = None,
    duration: Annotated[
        str | None, Option(help="Of the response; 20 transit times without.", metavar='"2 ms"')
    ] = None,
    full: Annotated[bool, Option("--full", help="Response by the full film.")] = False,
    save: Annotated[
        Path | None, Option(help="Keep the full film's run in this NetCDF file, as it goes.")
    ] = None,
    resume: Annotated[
        Path | None,
        Option(help="Go on from such a file: with a run that was cut off, else from where one ended."),
    ] = None,
) -> Said:
    """Film thickness, approach and stiffness of a lubricated rolling ball, and its response to a load."""
    from ..scenes.reading import Count
    from ..scenes.solve_contact import respond, response_of, solve_contact

    given = dict(
        radius=radius, mass=mass, modulus=modulus, poisson_ratio=poisson_ratio, viscosity=viscosity,
        pressure_coefficient=pressure_coefficient, speed=speed, load=load, plane_modulus=plane_modulus,
    )  # fmt: skip
    case = _case(given, (v, q0, w), roelands, compressible, cells)
    order = Count(LAW_STATES)("--order", order)
    full = full or save is not None or resume is not None
    _require_response(case, step, sine, frequency, full)
    time, drive = _drive(case, step, sine, frequency, duration)
    answer, law = solve_contact(case, order, report)
    response = None
    if full:
        response = response_of(case, _run(case, drive, time, save, resume, report))
    elif step is not None or sine is not None:
        response = respond(case, law, drive, duration=time)
    show = partial(_print, answer, response, case.ball is not None)
    return Said({**asdict(answer), "response": response}, show)


def _print(answer: ContactAnswer, response: ContactResponse | None, si: bool) -> None:
    console.print_rows("lubricated contact", contact_rows(answer, si))
    if response is not None:
        console.print_rows(f"response by the {response.model}", response_rows(response, si))


def contact_rows(answer: ContactAnswer, si: bool) -> list[tuple[str, str]]:
    """Return the rows that describe a stationary contact."""
    published = [
        (f"film by {name.replace('_', ' ')}", _length(film, si)) for name, film in answer.published.items()
    ]
    pressure = f"{answer.maximum_pressure * 1e-9:.5g} GPa" if si else f"{answer.maximum_pressure:.5g}"
    return [
        ("V, Q0, W", f"{answer.V:.5g}, {answer.Q0:.5g}, {answer.W:.5g}"),
        ("M, L (Moes)", f"{answer.moes['M']:.5g}, {answer.moes['L']:.5g}"),
        ("approach", _length(answer.approach, si)),
        ("central, minimum film", f"{_length(answer.central_film, si)}, {_length(answer.minimum_film, si)}"),
        *published,
        ("largest pressure", pressure),
        (
            "stiffness, damping",
            f"{answer.stiffness:.5g}, {answer.damping:.5g}" + (" N/m, N s/m" if si else ""),
        ),
        (
            "errors of the reduced law",
            f"load {answer.static_error:.2%} (at 0.2 to 3 times the load), "
            f"damping {answer.damping_error:.2%}",
        ),
        ("alternating share of the pressure", f"{answer.checkerboard:.2%}"),
    ]


def response_rows(response: ContactResponse, si: bool) -> list[tuple[str, str]]:
    """Return the rows that describe a response."""
    z, force = response.approach, response.force
    unit = " N" if si else ""
    rows = [
        ("until", f"{response.time[-1]:.6g}" + (" s" if si else "")),
        ("approach, from ... to", f"{_length(float(z.min()), si)} ... {_length(float(z.max()), si)}"),
        ("approach at the end", _length(float(z[-1]), si)),
        ("force, from ... to", f"{force.min():.5g} ... {force.max():.5g}{unit}"),
    ]
    if response.central_film is not None:
        rows.append(("smallest central film", _length(float(response.central_film.min()), si)))
    if not response.complete:
        rows.append(("interrupted", "this is what there is; --save keeps it, --resume goes on"))
    return rows


def _case(
    given: dict[str, str | None],
    plain: tuple[float | None, float | None, float | None],
    roelands: bool,
    compressible: bool,
    cells: int,
) -> ContactCase:
    from ..bearings.contact import ContactGrid, PointContact
    from ..core.errors import InputError
    from ..scenes.reading import Count, Quantity
    from ..scenes.solve_contact import ContactCase, case_of

    V, Q0, W = plain
    grid = ContactGrid(cells=(Count(CONTACT_CELLS)("--cells", cells),) * 2)
    if (V is None) != (Q0 is None) or (V is None and W is not None):
        raise InputError("--v and --q0 must be given together, and --w only with them")
    if V is not None and Q0 is not None:
        if roelands or compressible or any(value is not None for value in given.values()):
            raise InputError("--v and --q0 stand for a ball and its lubricant: give no option of these too")
        number = Quantity("1")
        contact = PointContact(V=number("--v", V), Q0=number("--q0", Q0), grid=grid)
        return ContactCase(contact, 1.0 if W is None else number("--w", W))
    ball = _ball(given)
    return case_of(ball, ball.contact(grid, roelands=roelands, compressible=compressible))


def _ball(given: dict[str, str | None]) -> RollingBall:
    from ..bearings.contact import RollingBall
    from ..core.errors import InputError
    from ..scenes.reading import Quantity

    missing = [_option(name) for name in BALL if given[name] is None]
    if missing:
        raise InputError(f"{', '.join(missing)} must be given, or --v and --q0")
    values = {
        name: Quantity(UNITS[name])(_option(name), text) for name, text in given.items() if text is not None
    }
    return RollingBall(**{"mass": 0.0, **values})


def _require_response(
    case: ContactCase, step: float | None, sine: float | None, frequency: str | None, full: bool
) -> None:
    from ..core.errors import InputError

    if step is not None and sine is not None:
        raise InputError("--step and --sine must not both be given")
    if (sine is None) != (frequency is None):
        raise InputError("--sine and --frequency must be given together")
    if not full and case.W == 0.0 and (step is not None or sine is not None):
        raise InputError("--mass (or --w) must be positive for a response, or --full, got 0")


def _scaled(case: ContactCase, name: str, text: str, unit: str, scale: float) -> float:
    """Return a time or frequency in the unit of the contact."""
    from ..scenes.reading import Quantity

    return Quantity(unit if case.ball is not None else "1")(name, text) / scale


def _drive(
    case: ContactCase,
    step: float | None,
    sine: float | None,
    frequency: str | None,
    duration: str | None,
) -> tuple[float, Callable[[float], float]]:
    """Return the duration of the response, and the load over time that drives it, both scaled."""
    from ..scenes.contact_motions import require_followable
    from ..scenes.solve_contact import load_over_time

    scale = case.time_scale
    time = 20.0 if duration is None else _scaled(case, "--duration", duration, "s", scale)
    rate = 0.0 if frequency is None else _scaled(case, "--frequency", frequency, "rad/s", 1.0 / scale)
    require_followable(time, rate)
    return time, load_over_time(step, sine, rate)


def _run(
    case: ContactCase,
    drive: Callable[[float], float],
    duration: float,
    save: Path | None,
    resume: Path | None,
    report: Any,
) -> ContactRun:
    """Return the run of the full film, kept on disk as it goes; one that is not complete is gone on with."""
    from ..scenes.solve_contact import run_full

    earlier = None if resume is None else case.contact.load(resume)
    start = earlier.final if earlier is not None and earlier.complete else earlier
    run = run_full(case, drive, duration=duration, start=start, keep=save, report=report)
    if save is not None:  # once more, where a failure is an error
        case.contact.save(run, save)
    return run


def _option(name: str) -> str:
    return f"--{name.replace('_', '-')}"


def _length(value: float, si: bool) -> str:
    return f"{value * 1e9:.5g} nm" if si else f"{value:.5g}"
