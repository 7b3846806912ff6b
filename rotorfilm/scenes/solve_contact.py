"""The answer to one lubricated contact: film, approach, stiffness, and its response to a load over time."""

from __future__ import annotations

import contextlib
import warnings
from collections.abc import Callable
from dataclasses import dataclass
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from ..bearings.contact import (
    HERTZ_LOAD,
    ContactLaw,
    ContactRun,
    ContactState,
    PointContact,
    RollingBall,
    ball_transient,
    moes_parameters,
    reduce_contact,
)
from ..core.errors import ConvergenceError, InputError
from ..core.model import Array, breakpoints
from ..core.progress import Report, silent
from ..core.readable import Readable
from ..core.results import Trajectory
from .contact_motions import contact_motion, require_followable

if TYPE_CHECKING:
    from .scene import Scene


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
    """A stationary contact; one without a ball is in the units of its Hertzian contact, not in SI.

    Attributes
    ----------
    V, Q0, W : float [1]
    moes : dict of str to float
        M and L.
    approach : float [m]
        Of the ball's center beyond first touch, negative in contact.
    central_film, minimum_film : float [m]
        Film thickness at the center, and the smallest.
    maximum_pressure : float [Pa]
    checkerboard : float [1]
        Share of the pressure that alternates from cell to cell.
    stiffness, damping : float [N/m], [N s/m]
        -dF/dz at rest and in slow motion.
    static_error, damping_error : float [1]
        Of the reduced law.
    published : dict of str to float [m]
        Film thicknesses by published formulas.
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
    time, approach, force : ndarray, shape (n,) [s], [m], [N]
        Motion of the ball and force of the film on it.
    central_film : ndarray, shape (n,), or None [m]
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
    return ball_transient(
        law, mass=case.W / HERTZ_LOAD, load=load, start=start, duration=duration, samples=1001
    )


def answer_contact(scene: Scene, report: Report = silent) -> ContactAnswer:
    """Return the stationary contact of a scene."""
    assert scene.contact is not None  # or it is not asked
    case = case_of(scene.contact.build(), scene.contact.contact())
    return solve_contact(case, scene.contact.order, report)[0]


def run_contact(scene: Scene, *, full: bool = False, report: Report = silent) -> ContactResponse:
    """Return the motion of the ball of a scene under its step or its sine; see `contact_motion`.

    Parameters
    ----------
    scene : Scene
        With a contact; `operation.duration` is how long it is followed, if it is given.
    full : bool
        Whether by the full film, in place of its reduced law. An interruption returns what there is.
    report : callable
        Is told the progress.

    Raises
    ------
    InputError
        If the scene has no contact, no step or sine, or a ball without mass on a reduced law.
    ConvergenceError
        If a step fails; its `partial` is the run up to there.
    """
    motion, table = contact_motion(scene), scene.contact
    assert table is not None  # or there is no motion
    case, duration = case_of(table.build(), table.contact()), motion.duration
    if scene.operation is not None and scene.operation.duration is not None:
        duration = scene.operation.duration / case.time_scale
        require_followable(duration, 0.0)
    if full:
        told = _Told(motion.load, 0.0, duration, report)
        start = case.contact.stationary()
        return _response_of(case, case.contact.simulate(start, duration=duration, W=case.W, load=told))
    if not case.W > 0.0:
        raise InputError("contact.mass must be positive for a motion on the reduced law, got 0.0 kg")
    report(0.3, "reduced law")
    law = reduce_contact(case.contact, table.order)
    return respond(case, law, motion.load, duration=duration)


def _response_of(case: ContactCase, run: ContactRun) -> ContactResponse:
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
