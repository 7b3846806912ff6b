"""What shakes a rolling ball in a scene, and how long it is followed."""

from __future__ import annotations

import math
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from ..bearings.contact import (
    HIGGINSON_PRESSURE,
    ContactGrid,
    DowsonHigginsonDensity,
    PointContact,
    RollingBall,
    SineLoad,
    StepLoad,
)
from ..core.answers import WorkUnit
from ..core.errors import ConvergenceError, InputError
from ..core.limits import SWING_RATE, TRANSITS, require_at_most
from .contact_table import ContactTable
from .excitation_table import SineLoadTable, StepLoadTable
from .families import Remark, messages
from .journal_tables import NOTABLE
from .lubricant_table import Lubricant

if TYPE_CHECKING:
    from .scene import Scene

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
        Of what the ball does: of its natural motion, or of the load; 0 for a ball without mass under a step.
    """

    load: StepLoad | SineLoad
    duration: float
    shortest_period: float

    @property
    def extremes(self) -> tuple[float, float]:
        """Smallest and largest load f."""
        amplitude = self.load.amplitude
        if isinstance(self.load, SineLoad):
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
    if scene.contact is None:
        raise InputError("contact is required for the motion of a ball, got no such table")
    shaken = scene.excitation
    if not isinstance(shaken, StepLoadTable | SineLoadTable):
        got = "no such table" if shaken is None else type(shaken).__name__
        raise InputError(
            f'excitation of kind "step" or "sine" is required for the motion of a ball, got {got}'
        )
    ball = scene.contact.build()
    amplitude = _amplitude(shaken, ball)
    period = 2.0 * math.pi / natural_frequency(ball.W)
    if isinstance(shaken, SineLoadTable):
        frequency = shaken.frequency * ball.time_scale
        duration = max(UNDER_SINE, 2.0 * math.pi / frequency, period)
        require_followable(duration, frequency)
        return DrivenBall(
            load=SineLoad(amplitude=amplitude, frequency=frequency),
            duration=duration,
            shortest_period=min(2.0 * math.pi / frequency, period or math.inf),
        )
    end = (shaken.end - shaken.start) / ball.time_scale
    duration = max(AFTER_JUMP, period) + (end if math.isfinite(end) else 0.0)
    require_followable(duration, 0.0)
    return DrivenBall(
        load=StepLoad(amplitude=amplitude, end=end),
        duration=duration,
        shortest_period=period,
    )


def _amplitude(shaken: StepLoadTable | SineLoadTable, ball: RollingBall) -> float:
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
    def ball(self) -> RollingBall:
        """The ball in SI."""
        return self.table.build()

    @property
    def row(self) -> ContactQuantity:
        """The row of the quantity."""
        return QUANTITIES[self.quantity]

    def contact(self, cells: int, inlet: float = INLETS[0]) -> PointContact:
        """Return the contact on cells x cells of a rectangle."""
        grid = ContactGrid(
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
            raise ConvergenceError(f"a contact must be solvable on {cells} x {cells} cells, got none before")
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

DENSER = 0.1
"""Growth of the density under the contact that is worth a word."""

FLAT = 0.1
"""Contact radius / ball radius from which the ball is no paraboloid; the error of the gap is its square /
4."""


REMARKS = (
    Remark(
        "inlet_thinning",
        NOTABLE,
        "heat: the oil that flows back before the contact warms by about {inlet_warming:.2g} K, which takes "
        "{inlet_thinning:.0%} of its viscosity",
        moves="heat",
    ),
    Remark(
        "piezoviscosity",
        NOTABLE,
        "viscosity: where the film is formed the exponential law gives {exaggeration:.2g} times that of "
        "Roelands; `roelands = true` takes that",
    ),
    Remark(
        "densification",
        DENSER,
        "compressibility: {densification:.0%} under the contact, which thins its film about as much; "
        "`compressible = true` takes it into account",
        moves="compressibility",
    ),
    Remark(
        "flatness",
        FLAT,
        "shape: the contact is {flatness:.2g} of the ball's radius, too wide for a paraboloid",
    ),
)
"""What the physics of a rolling contact leaves out, by the numbers of `contact_numbers`."""


def contact_numbers(
    ball: RollingBall, oil: Lubricant, *, roelands: bool, compressible: bool
) -> dict[str, float]:
    """Return the dimensionless numbers of a lubricated ball.

    Parameters
    ----------
    ball : RollingBall
        With its load and speed.
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
    density = DowsonHigginsonDensity(pressure_ratio=ball.contact_pressure / HIGGINSON_PRESSURE)
    beyond = 0.0 if roelands else _beyond_roelands(ball)
    return {
        "inlet_warming": warming,
        "inlet_thinning": -math.expm1(-oil.thinning * warming),
        "piezoviscosity": beyond,
        "exaggeration": math.exp(beyond),
        "densification": 0.0 if compressible else float(density.density(np.ones(1))[0]) - 1.0,
        "flatness": ball.contact_radius / ball.radius,
    }


def _beyond_roelands(ball: RollingBall) -> float:
    try:
        law = ball.contact(roelands=True).piezoviscosity
    except InputError:
        return 0.0  # no such law for this oil
    pressure = np.array([min(FORMED / ball.Q0, 1.0)])
    return float(ball.Q0 * pressure[0] + np.log(law.mobility(pressure, ball.Q0)[0]))


def contact_remarks(
    ball: RollingBall, oil: Lubricant, *, roelands: bool, compressible: bool
) -> tuple[str, ...]:
    """Return the neglected effects that matter, one line each, of a ball; see `contact_numbers`."""
    return messages(REMARKS, contact_numbers(ball, oil, roelands=roelands, compressible=compressible))
