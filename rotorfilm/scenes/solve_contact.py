"""The answer to one lubricated contact: film, approach, stiffness, and its response to a load over time."""

from __future__ import annotations

import contextlib
import warnings
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import NamedTuple

import numpy as np

from ..bearings.contact import (
    HERTZ_LOAD,
    ContactLaw,
    ContactRun,
    ContactState,
    PointContact,
    RollingBall,
    SineLoad,
    StepLoad,
    moes_parameters,
    reduce_contact,
    ride,
)
from ..core.errors import ConvergenceError, require_positive
from ..core.model import Array, breakpoints
from ..core.progress import Report, silent
from ..core.readable import Readable
from ..core.results import Trajectory


class ContactCase(NamedTuple):
    """A contact with the inertia of its ball and its units; all of them 1 without a ball.

    Attributes
    ----------
    contact : PointContact
    W : float [1]
    ball : RollingBall or None
    film_scale, time_scale, force_scale, pressure_scale : float [m, s, N, Pa]
    """

    contact: PointContact
    W: float
    ball: RollingBall | None = None
    film_scale: float = 1.0
    time_scale: float = 1.0
    force_scale: float = 1.0
    pressure_scale: float = 1.0


@dataclass(frozen=True, kw_only=True)
class ContactAnswer(Readable):
    """A stationary contact; in SI for a ball, else in units of the Hertzian contact.

    Attributes
    ----------
    V, Q0, W : float [1]
    moes : dict of str to float
        M and L.
    approach : float [m or 1]
        Of the ball's center beyond first touch, negative in contact.
    central_film, minimum_film : float [m or 1]
        Film thickness at the center, and the smallest.
    maximum_pressure : float [Pa or 1]
    checkerboard : float [1]
    stiffness, damping : float [N/m or 1], [N s/m or 1]
        -dF/dz at rest and in slow motion.
    static_error, damping_error : float [1]
        Of the reduced law.
    published : dict of str to float
        Film thicknesses by published formulas, in the same unit.
    """

    V: float
    Q0: float
    W: float
    moes: dict[str, float]
    approach: float
    central_film: float
    minimum_film: float
    maximum_pressure: float
    checkerboard: float
    stiffness: float
    damping: float
    static_error: float
    damping_error: float
    published: dict[str, float]


@dataclass(frozen=True, kw_only=True)
class ContactResponse(Readable):
    """The motion of the ball under a load over time, in the units of `ContactAnswer`.

    Attributes
    ----------
    model : str
        "full film", "reduced law", or the latter with the load that it is about, where that is not the static
        one: then `ContactAnswer` describes another law.
    complete : bool
        Whether it reached its end.
    time, approach, force : ndarray, shape (n,) [s or 1], [m or 1], [N or 1]
        Motion of the ball and force of the film on it.
    central_film : ndarray, shape (n,), or None [m or 1]
        The reduced law has none.
    work : dict of str to int
    """

    model: str
    complete: bool
    time: Array
    approach: Array
    force: Array
    central_film: Array | None
    work: dict[str, int]


def case_of(ball: RollingBall, contact: PointContact) -> ContactCase:
    """Return the contact of a ball with its units."""
    scales = ball.film_scale, ball.time_scale, ball.load, ball.contact_pressure
    return ContactCase(contact, ball.W, ball, *scales)


def solve_contact(case: ContactCase, order: int, report: Report = silent) -> tuple[ContactAnswer, ContactLaw]:
    """Return the stationary contact, and its dimensionless law.

    Raises
    ------
    ConvergenceError
        If the contact is not found.
    """
    report(0.0, "stationary contact")
    state = case.contact.stationary()
    report(0.3, "reduced law")
    law = reduce_contact(case.contact, order)
    report(1.0, "done")
    return _answer(case, state, law), law


def respond(
    case: ContactCase, law: ContactLaw, load: Callable[[float], float], *, duration: float
) -> ContactResponse:
    """Return the response by the reduced law; load f(t) and duration are dimensionless.

    Where the force exceeds the range of the law, the motion is that of the law about a larger load: the mean
    of the force, or the least whose range reaches its largest value.

    Warns
    -----
    ValidityWarning
        If the force leaves the range of the law all the same, as it does where the ball leaves the film.
    """
    with warnings.catch_warnings(record=True) as told:
        warnings.simplefilter("always")
        motion = _ridden(case, law, load, duration)
    other = _larger(case, law, motion["force_z"])
    if other is None:
        for each in told:
            warnings.warn_explicit(each.message, each.category, each.filename, each.lineno)
    else:
        motion = _ridden(case, other, load, duration)
    return ContactResponse(
        model="reduced law" if other is None else f"reduced law about {_load(case, other)}",
        complete=True,
        time=motion.time * case.time_scale,
        approach=motion["z"] * case.film_scale,
        force=motion["force_z"] * case.force_scale,
        central_film=None,
        work=motion.work,
    )


def _larger(case: ContactCase, law: ContactLaw, force: Array) -> ContactLaw | None:
    """Return the law about a larger load, if a force exceeds the range of a law and there is one."""
    if force.max() <= law.load_range[1]:
        return None
    share = law.load_range[1] / law.force_scale
    about = max(float(force.mean()), 1.001 * float(force.max()) / share)
    with contextlib.suppress(ConvergenceError):
        return reduce_contact(case.contact, law.order, about)
    return None


def _load(case: ContactCase, law: ContactLaw) -> str:
    """Return the load that a dimensionless law is about, as a user reads it."""
    unit = "" if case.ball is None else " N"
    return f"{law.force_scale * case.force_scale:.4g}{unit}"


def _ridden(
    case: ContactCase, law: ContactLaw, load: Callable[[float], float], duration: float
) -> Trajectory:
    start = float(law.approach(1.0))
    return ride(law, mass=case.W / HERTZ_LOAD, load=load, start=start, duration=duration, samples=1001)


def run_full(
    case: ContactCase,
    load: Callable[[float], float],
    *,
    duration: float,
    start: ContactState | ContactRun | None = None,
    keep: Path | None = None,
    report: Report = silent,
) -> ContactRun:
    """Return the response by the full film, dimensionless; an interruption returns what there is.

    A run as start is gone on with; `keep` is as in `PointContact.simulate`.

    Raises
    ------
    ConvergenceError
        If a step fails; its `partial` is the run up to there.
    """
    begin = case.contact.stationary() if start is None else start
    at = float(begin.time[0]) if isinstance(begin, ContactRun) else begin.t
    told = _Told(load, at, duration, report)
    return case.contact.simulate(begin, duration=duration, W=case.W, load=told, keep=keep)


def response_of(case: ContactCase, run: ContactRun) -> ContactResponse:
    """Return a run of the full film in the units of the case."""
    return ContactResponse(
        model="full film",
        complete=run.complete,
        time=run.time * case.time_scale,
        approach=run.delta * case.film_scale,
        force=run.carried_load * case.force_scale,
        central_film=run.central_film * case.film_scale,
        work=run.work,
    )


def load_over_time(step: float | None, sine: float | None, frequency: float) -> StepLoad | SineLoad:
    """Return f(t) of a jump at t = 0 or of a swing, by their amplitudes relative to the static load."""
    if sine is not None:
        require_positive("frequency", frequency)
        return SineLoad(amplitude=sine, frequency=frequency)
    return StepLoad(amplitude=0.0 if step is None else step)


class _Told:
    """A load that tells how far the run is."""

    def __init__(self, load: Callable[[float], float], start: float, duration: float, report: Report) -> None:
        self.load, self.start, self.duration, self.report = load, start, duration, report
        self.breakpoints = breakpoints(load)

    def __repr__(self) -> str:
        return repr(self.load)

    def __call__(self, t: float) -> float:
        self.report(min(max((t - self.start) / self.duration, 0.0), 1.0), "full film over time")
        return self.load(t)


def _answer(case: ContactCase, state: ContactState, law: ContactLaw) -> ContactAnswer:
    film, stiff = case.film_scale, case.force_scale / case.film_scale
    return ContactAnswer(
        V=case.contact.V,
        Q0=case.contact.Q0,
        W=case.W,
        moes=moes_parameters(case.contact.V, case.contact.Q0)._asdict(),
        approach=state.delta * film,
        central_film=state.central_film * film,
        minimum_film=state.minimum_film * film,
        maximum_pressure=float(np.max(state.pressure)) * case.pressure_scale,
        checkerboard=state.checkerboard,
        stiffness=law.stiffness * stiff,
        damping=law.damping * stiff * case.time_scale,
        static_error=law.static_error,
        damping_error=law.damping_error,
        published=_published(case),
    )


def _published(case: ContactCase) -> dict[str, float]:
    if case.ball is not None:
        return case.ball.published_films._asdict()
    moes = moes_parameters(case.contact.V, case.contact.Q0)
    # The other formulas need a speed beside M and L.
    return {"nijenbanning_venner_moes": moes.central_film * 2.0 / (1.5 * moes.M) ** (2.0 / 3.0)}
