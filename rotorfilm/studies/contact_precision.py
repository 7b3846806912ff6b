"""Error of a ball's motion against its cost: schemes in time and space, steps, grids, reduced laws."""

from __future__ import annotations

import warnings
from collections.abc import Callable, Iterator, Sequence
from contextlib import AbstractContextManager
from functools import partial
from time import process_time

import numpy as np
from scipy.interpolate import CubicSpline

from ..bearings import contact as contacts
from ..core.errors import ValidityWarning
from ..core.model import Array
from ..core.progress import Report, silent
from .study import Study, StudyCase, StudyModel, StudyResult, run_study, timed

SPEED_PARAMETER, PRESSURE_COEFFICIENT = 0.1, 5.0
PUBLISHED_CELLS, PUBLISHED_STEP = 40, 0.2
"""Of the cases of Panovko (2011), section 4."""

LOAD = contacts.SineLoad(amplitude=0.5, frequency=2.0)
INERTIA = 1.0
RIDES = 5
"""Runs of a reduced law, the shortest of which counts."""


Series = tuple[Array, Array]
"""Times, and delta at them."""


def _quantities(model: StudyModel, case: StudyCase, found: Series) -> dict[str, object]:
    times, reference = case.reference
    miss = CubicSpline(*found)(times) - reference
    size = float(np.sqrt(np.mean((reference - reference[0]) ** 2)))
    error = float(np.sqrt(np.mean(miss**2))) / size
    return {"family": model.family, "label": model.label, "rms error of delta": error}


CONTACT = Study(
    name="contact",
    solve=lambda model, case: model.law(),
    quantities=_quantities,
    costs=timed("cost [s]", process_time),
)
"""Error: rms of that of delta / rms of its change from rest. Building a reduced law is not counted."""


def contact_precision(
    cells: int = 64,
    duration: float = 10.0,
    tolerance: float = 1e-5,
    orders: tuple[int, ...] = (2, 3, 5, 8),
    report: Report = silent,
) -> StudyResult:
    """Return the ladder for W = 1 under the load 1 + 0.5 sin(2 t) from rest; some minutes.

    Parameters
    ----------
    cells : int
        Cells along each side of the reference; the rungs have a half to three quarters of them.
    duration : float [1]
    tolerance : float
        Tolerance of the steps of the reference.
    orders : tuple of int
        Orders of the reduced laws.
    report : callable
        Told how far the work is.
    """
    report(0.0, "reference")
    exact = _full(cells, contacts.UpwindScheme(), contacts.AdaptiveSteps(tolerance=tolerance), duration)()
    times = np.linspace(0.0, duration, 2001)
    models = [*_full_models(cells, duration), *_law_models(cells // 2, duration, orders)]
    return run_study(
        CONTACT,
        [StudyCase(models=models, reference=(times, CubicSpline(*exact)(times)))],
        reference=f"BDF2 of tolerance {tolerance:g}, {cells} x {cells} upwind cells",
        notes={"duration": duration},
        report=report,
    )


def _model(family: str, label: str, run: Callable[[], Series], repeats: int = 1) -> StudyModel:
    return StudyModel(name=f"{family}, {label}", family=family, label=label, law=run, repeats=repeats)


def _full_models(cells: int, duration: float) -> Iterator[StudyModel]:
    coarse, middle = cells // 2, 3 * cells // 4
    middle -= middle % 2
    published = contacts.FixedSteps(step=PUBLISHED_STEP, order=1)
    run = _full(PUBLISHED_CELLS, contacts.StaggeredScheme(), published, duration)
    yield _model("published scheme", f"dt {PUBLISHED_STEP:g}", run)
    for step in (0.2, 0.1, 0.05, 0.025):
        run = _full(middle, contacts.UpwindScheme(), contacts.FixedSteps(step=step, order=1), duration)
        yield _model(f"Euler, {middle} cells", f"dt {step:g}", run)
    for size in (coarse, middle):
        for step in (0.2, 0.1, 0.05):
            run = _full(size, contacts.UpwindScheme(), contacts.FixedSteps(step=step), duration)
            yield _model(f"BDF2, {size} cells", f"dt {step:g}", run)
        for tolerance in (1e-3, 1e-4):
            run = _full(size, contacts.UpwindScheme(), contacts.AdaptiveSteps(tolerance=tolerance), duration)
            yield _model(f"adaptive, {size} cells", f"tol {tolerance:g}", run)


def _law_models(cells: int, duration: float, orders: tuple[int, ...]) -> Iterator[StudyModel]:
    contact = published_contact(cells, contacts.UpwindScheme())
    for order in orders:
        run = partial(_ridden, contacts.reduce_contact(contact, order), duration)
        yield _model("reduced law", f"order {order}", run, RIDES)


def _ridden(law: contacts.ContactLaw, duration: float) -> Series:
    mass = INERTIA / contacts.HERTZ_LOAD
    motion = contacts.ball_transient(
        law, mass=mass, load=LOAD, start=law.operating, duration=duration, samples=401, rtol=1e-4
    )
    return motion.time, motion["z"]


def _full(
    cells: int,
    scheme: contacts.ContactScheme,
    control: contacts.AdaptiveSteps | contacts.FixedSteps,
    duration: float,
) -> Callable[[], Series]:
    contact = published_contact(cells, scheme)
    rest = contact.stationary()

    def run() -> Series:
        with as_published():
            motion = contact.simulate(rest, duration=duration, W=INERTIA, load=LOAD, control=control)
        return motion.time, motion.delta

    return run


def published_contact(cells: int, scheme: contacts.ContactScheme) -> contacts.PointContact:
    """Return the contact of the published cases on cells x cells."""
    grid = contacts.ContactGrid(cells=(cells, cells))
    return contacts.PointContact(V=SPEED_PARAMETER, Q0=PRESSURE_COEFFICIENT, grid=grid, scheme=scheme)


def as_published() -> AbstractContextManager[object]:
    """Silence what the published scheme is warned of: that its pressure alternates."""
    return warnings.catch_warnings(action="ignore", category=ValidityWarning)


# Numbers that describe a motion of a ball: the decay of its oscillation, in a run and by the equations.


SMALLEST_PEAK = 1e-4
"""Peaks of delta below which a decay is lost in the errors of the steps."""

STIFFNESS = 1.57
"""Static stiffness of the contact, from which the search for its natural motion starts."""


def decay_time(run: contacts.ContactRun, rest: float, begin: float = 1.0, end: float = np.inf) -> float:
    """Return the time in which delta's oscillation about `rest` falls by e, from its peaks; 0 if none."""
    spline = CubicSpline(run.time, run.delta - rest)
    peaks = spline.derivative().roots(extrapolate=False)
    peaks = peaks[(peaks > begin) & (peaks < end)]
    height = np.abs(spline(peaks))
    peaks, height = peaks[height > SMALLEST_PEAK], height[height > SMALLEST_PEAK]
    return float(-1.0 / np.polyfit(peaks, np.log(height), 1)[0]) if len(peaks) > 1 else 0.0


def natural_motions(
    contact: contacts.PointContact,
    rest: contacts.ContactState,
    inertias: Sequence[float],
    report: Report = silent,
) -> Array:
    """Return s of the natural motions exp(s t) about rest with some inertias, by the linearized equations."""
    small = contacts.SmallMotion(contact.equations, rest.levels[0].pressure, rest.delta)
    found = []
    for number, W in enumerate(inertias):
        report(number / len(inertias), f"natural motion, W = {W:g}")
        found.append(small.natural_motion(W, 1j * np.sqrt(STIFFNESS / W)))
    return np.array(found)
