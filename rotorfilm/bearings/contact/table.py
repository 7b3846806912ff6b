"""A rolling ball in a scene: its table, its motions, neglected effects, and the answers of solve and run."""

from __future__ import annotations

import contextlib
import math
import warnings
from collections.abc import Callable
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Annotated, NamedTuple

import numpy as np

from ...core.answers import WorkUnit
from ...core.errors import ConvergenceError, InputError, require_non_negative
from ...core.limits import CONTACT_CELLS, LAW_STATES, SWING_RATE, TRANSITS, require_at_most
from ...core.model import Array, breakpoints
from ...core.progress import Report, silent
from ...core.readable import Readable
from ...core.results import Trajectory
from ...scenes.families import messages, remarks_of
from ...scenes.reading import Count, Taking, fields_of, made_from
from ...scenes.shared_tables import Lubricant, SineLoadTable, StepLoadTable
from .. import contact as contacts

if TYPE_CHECKING:
    from ...scenes.scene import Scene


@dataclass(frozen=True, kw_only=True)
@fields_of(contacts.RollingBall)
class ContactTable(Taking):
    """`[contact]`: a rolling ball, its lubricant, and where such balls carry a journal.

    Parameters
    ----------
    mass : float [kg]
        Mass of the ball; 0 where it follows its load without inertia.
    load : float [N]
        Load of one ball, about which its law is made.
    cells : int
        Cells along each side of the film's rectangle.
    order : int
        States of the reduced law.
    roelands : bool
        Whether the viscosity follows Roelands, not Barus, as in `RollingBall.contact`.
    compressible : bool
        Whether the density grows with pressure, by Dowson and Higginson.
    angles : tuple of float [rad]
        Angles of the balls that carry a journal, from +x towards +y; empty for a ball on a plane.
    preload : float [N]
        Preload of each of these balls while the journal is in the center.
    """

    mass: float = 0.0
    cells: Annotated[int, Count(CONTACT_CELLS)] = 40
    order: Annotated[int, Count(LAW_STATES)] = 5
    roelands: bool = False
    compressible: bool = False
    angles: tuple[float, ...] = ()
    preload: float = 0.0

    def __post_init__(self) -> None:
        self.contact()
        require_non_negative("preload", self.preload)

    def build(self) -> contacts.RollingBall:
        """Return the ball; raise InputError where a value breaks its rule."""
        return made_from(contacts.RollingBall, self)

    def contact(self) -> contacts.PointContact:
        """Return its dimensionless contact."""
        grid = contacts.ContactGrid(cells=(self.cells, self.cells))
        return self.build().contact(grid, roelands=self.roelands, compressible=self.compressible)

    def support(self) -> contacts.BallSupport:
        """Return the balls around a journal; raises InputError if there are no angles."""
        if not self.angles:
            raise InputError("contact.angles is required for a support of a rotor, got none")
        law = contacts.reduce_ball(self.build(), self.contact(), self.order)
        return contacts.BallSupport(law=law, angles=self.angles, gap=float(law.approach(self.preload)))


# What shakes a rolling ball in a scene, and how long it is followed.


AFTER_JUMP, UNDER_SINE = 10.0, 20.0
"""Transit times t0 that a ball is followed after the last jump of its load, and under a sine."""

DRY_STIFFNESS = math.pi / 2.0
"""-d(integral of p)/d(delta) of the dry contact under the unit load (Hertz): of (2 pi/3) (-delta/2)^(3/2)."""


@dataclass(frozen=True, kw_only=True)
class DrivenBall:
    """A load over time in the units of a contact, and the motion that is asked for.

    Attributes
    ----------
    load : StepLoad or SineLoad
        f(t); the ball has rested until t = 0.
    duration : float [1]
    shortest_period : float [1]
        Shortest period of what the ball does: of its natural motion, or of the load; 0 for a ball without
        mass under a step.
    """

    load: contacts.StepLoad | contacts.SineLoad
    duration: float
    shortest_period: float

    @property
    def extremes(self) -> tuple[float, float]:
        """Smallest and largest load f."""
        amplitude = self.load.amplitude
        if isinstance(self.load, contacts.SineLoad):
            return 1.0 - abs(amplitude), 1.0 + abs(amplitude)
        return min(1.0, 1.0 + amplitude), max(1.0, 1.0 + amplitude)


def require_followable(duration: float, frequency: float) -> None:
    """Raise InputError for a motion of more transit times, or a faster load, than can be followed."""
    require_at_most("duration / transit time", duration, TRANSITS)
    require_at_most("frequency * transit time", frequency, SWING_RATE)


def natural_frequency(W: float) -> float:
    """Return sqrt(k/W) of a ball on the dry contact; infinite without a mass."""
    return math.sqrt(DRY_STIFFNESS / W) if W > 0.0 else math.inf


def contact_motion(scene: Scene) -> DrivenBall:
    """Return the load of a scene's ball over time, and how long the question follows it.

    A ball under a step is followed from rest until 10 transit times t0 = a/speed after the last jump, under
    a sine for 20 transit times; for one natural period or one of the sine where that is longer. A jump
    begins at t = 0 whenever it is: until then the ball rests.

    Raises
    ------
    InputError
        If the scene has no contact, no step or sine, or a load that is not along y or pulls the ball off.
    """
    what = "the motion of a ball"
    table, shaken = scene.required("contact", what), scene.excited_by(what, StepLoadTable, SineLoadTable)
    ball = table.build()
    amplitude = _amplitude(shaken, ball)
    period = 2.0 * math.pi / natural_frequency(ball.W)
    if isinstance(shaken, SineLoadTable):
        frequency = shaken.frequency * ball.time_scale
        duration = max(UNDER_SINE, 2.0 * math.pi / frequency, period)
        require_followable(duration, frequency)
        return DrivenBall(
            load=contacts.SineLoad(amplitude=amplitude, frequency=frequency),
            duration=duration,
            shortest_period=min(2.0 * math.pi / frequency, period or math.inf),
        )
    end = (shaken.end - shaken.start) / ball.time_scale
    duration = max(AFTER_JUMP, period) + (end if math.isfinite(end) else 0.0)
    require_followable(duration, 0.0)
    return DrivenBall(
        load=contacts.StepLoad(amplitude=amplitude, end=end), duration=duration, shortest_period=period
    )


def _amplitude(shaken: StepLoadTable | SineLoadTable, ball: contacts.RollingBall) -> float:
    """Return the change of the load / the static load; along -y it presses the ball on its plane."""
    across, along = shaken.load
    if across != 0.0:
        raise InputError(f"excitation.load of a ball on a plane must act along y, got {shaken.load!r} N")
    return -along / ball.load


# Stationary films of a rolling ball on several grids, each solved once for all rungs of a question.


INLETS = (2.5, 4.5, 8.5)
"""Lengths of the inlet of the rectangles, in Hertzian radii; half as wide as long (`ContactGrid`)."""

OUTLET = 1.5
"""Length of their outlet."""


class ContactQuantity(NamedTuple):
    """What may be asked of a contact, a length [m].

    Attributes
    ----------
    field : str
        Its name in a `ContactState` and a `ContactRun`.
    reach : float
        Power of its length with which the rectangle changes it. Far from the contact the pressure is
        V (-x)/(5 r^4): it falls with r^-3, and its integral, the load beyond the rectangle, with 1/r.
    noise : float [1]
        Error on 32 x 32 cells below which an order increment says nothing: it may change its sign. It falls
        with the square of the cells, of what jumps with their power 3/2. Measured on random balls.
    formula_bound : float or None [1]
        Largest error of its formula, measured on random balls (docs/contact.md); None without one.
    jumps : bool
        Whether it jumps from cell to cell.
    """

    field: str
    reach: float
    noise: float
    formula_bound: float | None = None
    jumps: bool = False


QUANTITIES = {
    "approach": ContactQuantity("delta", 1.0, 0.0012, 0.08),
    "central_film": ContactQuantity("central_film", 3.0, 0.012, 0.16),
    "minimum_film": ContactQuantity("minimum_film", 3.0, 0.03, jumps=True),
}

SPACINGS = (8, 12, 16)
"""Cells per Hertzian radius of the two rectangles compared; thin films have no solution on coarse grids."""

Grid = tuple[float, int, float]
"""Length of the inlet, cells along a side, load f."""


@dataclass(frozen=True, kw_only=True)
class StaticContactFilms:
    """A quantity of a ball at rest by grid and load.

    Attributes
    ----------
    table : ContactTable
    quantity : str
        A key of `QUANTITIES`.
    known : dict
        Values [1] found so far; an entry is nan where there is no solution.
    """

    table: ContactTable
    quantity: str
    known: dict[Grid, float] = field(default_factory=dict, compare=False)

    @property
    def ball(self) -> contacts.RollingBall:
        """The ball in SI."""
        return self.table.build()

    @property
    def row(self) -> ContactQuantity:
        """The row of the quantity."""
        return QUANTITIES[self.quantity]

    def contact(self, cells: int, inlet: float = INLETS[0]) -> contacts.PointContact:
        """Return the contact on cells x cells of a rectangle."""
        grid = contacts.ContactGrid(
            cells=(cells, cells), inlet=-inlet, outlet=OUTLET, half_width=0.5 * (inlet + OUTLET)
        )
        return self.ball.contact(grid, roelands=self.table.roelands, compressible=self.table.compressible)

    def value(
        self, cells: int, work: dict[WorkUnit, int], inlet: float = INLETS[0], load: float = 1.0
    ) -> float:
        """Return the quantity [1]; what had to be solved for it is added to `work`.

        Raises
        ------
        ConvergenceError
            If the film is too thin for the grid.
        """
        key = (inlet, cells, round(load, 12))
        if key not in self.known:
            unit = unknowns(cells)
            work[unit] = work.get(unit, 0) + cells**2
            self.known[key] = math.nan
            state = self.contact(cells, inlet).stationary(load)
            self.known[key] = float(getattr(state, self.row.field))
        if math.isnan(self.known[key]):
            raise ConvergenceError(f"no contact was found on {cells} x {cells} cells")
        return self.known[key]

    def lacking(self, cells: int, fine: int, work: dict[WorkUnit, int], load: float) -> float:
        """Return the relative error by cells, from finer ones, and by the end of the rectangle.

        Raises
        ------
        ConvergenceError
            If there is no solution on one of the grids.
        """
        rest, better = (self.value(n, work, load=load) for n in (cells, fine))
        by_cells = abs(better - rest) / (1.0 - (cells / fine) ** 2)
        return (by_cells + abs(self.beyond(work, load))) / abs(rest)

    def beyond(self, work: dict[WorkUnit, int], load: float = 1.0) -> float:
        """Return the change of the quantity [1] from the shortest to an infinite rectangle.

        Two rectangles with cells of one size, as coarse as there is a solution on.

        Raises
        ------
        ConvergenceError
            If there is none.
        """
        near, wide = INLETS[:2]
        for spacing in SPACINGS:
            try:
                short = self.value(round(spacing * (near + OUTLET)), work, near, load)
                longer = self.value(round(spacing * (wide + OUTLET)), work, wide, load)
            except ConvergenceError:
                if spacing == SPACINGS[-1]:
                    raise
                continue
            break
        return (longer - short) / (1.0 - (near / wide) ** self.row.reach)


def unknowns(cells: int) -> WorkUnit:
    """Return the unit of one unknown of a film at rest."""
    return WorkUnit(f"unknowns on grid {cells} x {cells}", ("unknowns", cells))


# What the physics of a rolling-ball contact leaves out, judged by dimensionless numbers.


FORMED = 2.0
"""Pressure times pressure coefficient at which a film is formed: flow by pressure is down to exp(-2)."""


def contact_numbers(
    ball: contacts.RollingBall, oil: Lubricant, *, roelands: bool, compressible: bool
) -> dict[str, float]:
    """Return the dimensionless numbers of a lubricated ball.

    Parameters
    ----------
    ball : RollingBall
        Ball with its load and speed.
    oil : Lubricant
    roelands, compressible : bool
        What the film takes into account.

    Returns
    -------
    dict of str to float
        inlet_warming [K] : of the oil that flows back before the contact.
        inlet_thinning : relative loss of viscosity by that, and about two thirds of it of the film.
        piezoviscosity : by how much the exponential law exceeds Roelands' in ln(viscosity), where the film is
        formed; 0 where that law is used or does not exist; exaggeration : its exponential.
        densification : relative growth of the density at the largest pressure; 0 where the film takes it into
        account.
        flatness : contact radius / ball radius.

    Notes
    -----
    Far before the contact nothing flows through: what the surfaces carry in at the speed u returns as a
    parabolic flow of the mean velocity u. Its dissipation between cold walls warms the middle by
    (3/4) viscosity u^2/conductivity, whatever the gap.
    """
    warming = 0.75 * ball.viscosity * ball.speed**2 / oil.conductivity
    density = contacts.DowsonHigginsonDensity(
        pressure_ratio=ball.contact_pressure / contacts.HIGGINSON_PRESSURE
    )
    beyond = 0.0 if roelands else _beyond_roelands(ball)
    return {
        "inlet_warming": warming,
        "inlet_thinning": -math.expm1(-oil.thinning * warming),
        "piezoviscosity": beyond,
        "exaggeration": math.exp(beyond),
        "densification": 0.0 if compressible else float(density.density(np.ones(1))[0]) - 1.0,
        "flatness": ball.contact_radius / ball.radius,
    }


def _beyond_roelands(ball: contacts.RollingBall) -> float:
    try:
        law = ball.contact(roelands=True).piezoviscosity
    except InputError:
        return 0.0  # no such law for this oil
    pressure = np.array([min(FORMED / ball.Q0, 1.0)])
    return float(ball.Q0 * pressure[0] + np.log(law.mobility(pressure, ball.Q0)[0]))


def contact_remarks(
    ball: contacts.RollingBall, oil: Lubricant, *, roelands: bool, compressible: bool
) -> tuple[str, ...]:
    """Return the neglected effects that matter, one line each, of a ball; see `contact_numbers`."""
    return messages(
        remarks_of("contact"), contact_numbers(ball, oil, roelands=roelands, compressible=compressible)
    )


# The answer to one lubricated contact: film, approach, stiffness, and its response to a load over time.


class ContactCase(NamedTuple):
    """A contact with the inertia of its ball and its units; all of them 1 without a ball.

    Attributes
    ----------
    contact : PointContact
    W : float [1]
    ball : RollingBall or None
    film_scale, time_scale, force_scale, pressure_scale : float [m, s, N, Pa]
    """

    contact: contacts.PointContact
    W: float
    ball: contacts.RollingBall | None = None
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
        Approach of the ball's center beyond first touch, negative in contact.
    central_film, minimum_film : float [m]
        Film thickness at the center, and the smallest.
    maximum_pressure : float [Pa]
    checkerboard : float [1]
        Share of the pressure that alternates from cell to cell.
    stiffness, damping : float [N/m], [N s/m]
        -dF/dz at rest and in slow motion.
    static_error, damping_error : float [1]
        Static error and damping error of the reduced law.
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


def case_of(ball: contacts.RollingBall, contact: contacts.PointContact) -> ContactCase:
    """Return the contact of a ball with its units."""
    scales = ball.film_scale, ball.time_scale, ball.load, ball.contact_pressure
    return ContactCase(contact, ball.W, ball, *scales)


def solve_contact(
    case: ContactCase, order: int, report: Report = silent
) -> tuple[ContactAnswer, contacts.ContactLaw]:
    """Return the stationary contact, and its dimensionless law.

    Raises
    ------
    ConvergenceError
        If the contact is not found.
    """
    report(0.0, "stationary contact")
    state = case.contact.stationary()
    report(0.3, "reduced law")
    law = contacts.reduce_contact(case.contact, order)
    report(1.0, "done")
    return _answer(case, state, law), law


def respond(
    case: ContactCase, law: contacts.ContactLaw, load: Callable[[float], float], *, duration: float
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


def _larger(case: ContactCase, law: contacts.ContactLaw, force: Array) -> contacts.ContactLaw | None:
    """Return the law about a larger load, if a force exceeds the range of a law and there is one."""
    if force.max() <= law.load_range[1]:
        return None
    share = law.load_range[1] / law.force_scale
    about = max(float(force.mean()), 1.001 * float(force.max()) / share)
    with contextlib.suppress(ConvergenceError):
        return contacts.reduce_contact(case.contact, law.order, about)
    return None


def _load(case: ContactCase, law: contacts.ContactLaw) -> str:
    """Return the load that a dimensionless law is about, as a user reads it."""
    unit = "" if case.ball is None else " N"
    return f"{law.force_scale * case.force_scale:.4g}{unit}"


def _ridden(
    case: ContactCase, law: contacts.ContactLaw, load: Callable[[float], float], duration: float
) -> Trajectory:
    start = float(law.approach(1.0))
    return contacts.ball_transient(
        law, mass=case.W / contacts.HERTZ_LOAD, load=load, start=start, duration=duration, samples=1001
    )


def answer_contact(scene: Scene, report: Report = silent) -> ContactAnswer:
    """Return the stationary contact of a scene."""
    case = case_of(scene.contact.build(), scene.contact.contact())
    return solve_contact(case, scene.contact.order, report)[0]


def run_contact(scene: Scene, *, full: bool = False, report: Report = silent) -> ContactResponse:
    """Return the motion of the ball of a scene under its step or its sine; see `contact_motion`.

    Parameters
    ----------
    scene : Scene
        Scene with a contact; `operation.duration` is how long it is followed, if it is given.
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
    law = contacts.reduce_contact(case.contact, table.order)
    return respond(case, law, motion.load, duration=duration)


def _response_of(case: ContactCase, run: contacts.ContactRun) -> ContactResponse:
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


def _answer(case: ContactCase, state: contacts.ContactState, law: contacts.ContactLaw) -> ContactAnswer:
    film, stiff = case.film_scale, case.force_scale / case.film_scale
    return ContactAnswer(
        V=case.contact.V,
        Q0=case.contact.Q0,
        W=case.W,
        moes=contacts.moes_parameters(case.contact.V, case.contact.Q0)._asdict(),
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
    moes = contacts.moes_parameters(case.contact.V, case.contact.Q0)
    # The other formulas need a speed beside M and L.
    return {"nijenbanning_venner_moes": moes.central_film * 2.0 / (1.5 * moes.M) ** (2.0 / 3.0)}
