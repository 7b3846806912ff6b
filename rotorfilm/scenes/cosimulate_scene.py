"""A scene as a co-simulation: its FMUs coupled by a scheme, the limit of that scheme, and the error."""

from __future__ import annotations

import tempfile
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from .. import cosim
from ..analysis import simulate
from ..core.errors import ContactError
from ..core.inputs import require_choice
from ..core.model import Array, Stepped
from ..core.port import clearance_of, in_time
from ..core.progress import Report, part_of, silent
from ..core.readable import Readable
from ..core.results import Trajectory, orbit_distance
from ..native.spec import HasKernel
from .export_scene import at_rest_on_film, export_scene
from .oil_film_tables import require_law
from .reading import made_from
from .scene import Scene
from .shared_tables import require_steps

SCHEMES: dict[str, cosim.Scheme] = {
    **{f"gauss-seidel-{degree}": cosim.GaussSeidel(degree=degree) for degree in range(3)},
    **{f"jacobi-{degree}": cosim.Jacobi(degree=degree) for degree in range(3)},
    "si-exp": cosim.SIExp(),
    "si-exp3": cosim.SIExp3(),
    "si-memory": cosim.SIMemory(),
    "newton": cosim.Newton(),
    "adaptive": cosim.Adaptive(),
}
"""Schemes by their names on the command line."""


@dataclass(frozen=True, kw_only=True)
class TrialRow(Readable):
    """A trial of `Auto`, for print; the fields are those of `cosim.Trial`.

    Attributes
    ----------
    scheme : str
    orbit_error, spectral_radius, film_calls : float or None [1]
    reason : str
    """

    scheme: str
    orbit_error: float | None
    spectral_radius: float | None
    film_calls: float | None
    reason: str


@dataclass(frozen=True, kw_only=True)
class CosimAnswer(Readable):
    """What a co-simulation of a scene says.

    Attributes
    ----------
    scheme : str
        The scheme that ran.
    order : int
        Its order of convergence.
    macro_angle : float [rad]
        Shaft rotation between two exchanges.
    critical_macro_angle : float or None [rad]
        Where the scheme becomes unstable at the static equilibrium; None where it does not, or is not known.
    is_stability_known : bool
        False of a bearing with states, as tilts of pads or a temperature, and of `Adaptive`.
    orbit_error : float [1]
        Largest distance from the monolithic solution / clearance.
    eccentricity_ratio : float [1]
        Largest one met.
    hold_defect : float [1]
        See `CouplingReport`.
    watch : CouplingWatch
    work : dict of str to int
        Counters.
    trials : tuple of TrialRow
        Why this scheme, if it was asked for.
    """

    scheme: str
    order: int
    macro_angle: float
    critical_macro_angle: float | None
    is_stability_known: bool
    orbit_error: float
    eccentricity_ratio: float
    hold_defect: float
    watch: cosim.CouplingWatch
    work: dict[str, int]
    trials: tuple[TrialRow, ...]


def scheme_named(name: str, tolerance: float) -> cosim.Scheme | cosim.Auto:
    """Return the scheme of a name; `auto` and `adaptive` take the tolerance.

    Raises
    ------
    InputError
        If there is no such scheme.
    """
    if name == "auto":
        return cosim.Auto(tolerance=tolerance)
    if name == "adaptive":
        return cosim.Adaptive(tolerance=tolerance)
    require_choice("--scheme", name, ("auto", "adaptive", *SCHEMES))
    return SCHEMES[name]


def run_scene(
    scene: Scene, scheme: cosim.Scheme | cosim.Auto, report: Report = silent
) -> tuple[CosimAnswer, Trajectory]:
    """Couple the FMUs of a scene; return what that says, and the signals.

    A film without a kernel in the C library runs as a model in this process, because its FMU would not tell
    its derivatives.

    Parameters
    ----------
    scene : Scene
        Scene with a rotor.
    scheme : Scheme or Auto
    report : callable, optional
        Told how far the job is.

    Raises
    ------
    InputError
        If the scene has no rotor, or see `cosimulate`.
    CouplingError, ContactError, ConvergenceError
        See `cosimulate`.
    """
    require_steps("operation.duration", scene.duration * abs(scene.speed), scene.cosimulation)
    if scene.has_film:
        require_law(scene.film_table, "a co-simulation")
    report(0.0, "equilibrium, FMUs")
    result = _coupled(scene, scheme, part_of(report, 0.05, 0.75))
    report(0.75, "monolithic solution")
    answer = _answer(scene, result)
    report(1.0, "done")
    return answer, result.trajectory


def _coupled(scene: Scene, scheme: cosim.Scheme | cosim.Auto, report: Report) -> cosim.CoSimulation:
    def progress(t: float) -> None:
        report(min(1.0, t / scene.duration), "coupled run")

    with tempfile.TemporaryDirectory() as folder:
        rotor, film = at_rest_on_film(scene)
        # A mass-conserving film couples by the slopes of its force, which its FMU does not tell.
        native = not isinstance(film, Stepped) and isinstance(film, HasKernel) and film.native() is not None
        fmus = export_scene(scene, Path(folder)) if native else None
        return cosim.cosimulate(
            rotor if fmus is None else fmus["rotor"],
            film if fmus is None else fmus["film"],
            macro_step=scene.macro_step,
            duration=scene.duration,
            scheme=scheme,
            progress=progress,
        )


def _answer(scene: Scene, result: cosim.CoSimulation) -> CosimAnswer:
    own, clearance, scheme = result.trajectory, clearance_of(scene.bearing), result.scheme
    times = np.minimum(own.time, scene.duration)
    try:
        whole = monolithic_solution(scene, times)
    except ContactError as wall:
        raise ContactError(f"the monolithic solution: {wall}", result) from wall
    known = not isinstance(scheme, cosim.Adaptive) and not getattr(in_time(scene.bearing), "states", ())
    tried = () if result.choice is None else result.choice.trials
    return CosimAnswer(
        scheme=scheme.label,
        order=scheme.order,
        macro_angle=scene.cosimulation.macro_angle,
        critical_macro_angle=critical_macro_angle(scene, scheme) if known else None,
        is_stability_known=known,
        orbit_error=orbit_distance(own, whole) / clearance,
        eccentricity_ratio=float(np.hypot(*own.position).max()) / clearance,
        hold_defect=result.coupling.hold_defect,
        watch=result.watch,
        work=own.work,
        trials=tuple(made_from(TrialRow, trial, scheme=trial.scheme.label) for trial in tried),
    )


def critical_macro_angle(scene: Scene, scheme: cosim.Scheme | None = None) -> float | None:
    """Return where a scheme becomes unstable at the static equilibrium [rad]; None where it does not.

    Parameters
    ----------
    scene : Scene
        Scene with a rotor.
    scheme : Scheme, optional
        Scheme as in `critical_macro_step`.
    """
    rotor, bearing = at_rest_on_film(scene)
    limit = cosim.critical_macro_step(rotor, bearing, state=rotor.initial_state, scheme=scheme).macro_step
    return None if limit is None else limit * abs(scene.speed)


# Rotor and film of a scene integrated as one system, beside which coupled runs are judged.


REFERENCE_TOLERANCE = 1e-9
"""Relative tolerance, far below any coupling error shown."""


def monolithic_solution(scene: Scene, times: Array) -> Trajectory:
    """Return the motion from rest in the static equilibrium at these times, shape (n,) [s].

    Raises
    ------
    ContactError
        If the journal reaches the wall.
    """
    rotor, bearing = at_rest_on_film(scene)
    return simulate(rotor, bearing, duration=scene.duration, times=times, rtol=REFERENCE_TOLERANCE)
