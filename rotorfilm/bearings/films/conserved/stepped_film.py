"""A film that conserves its oil as a Stepped model: the motion of the journal in, force and flows out."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from ....errors import require_inside, require_positive
from ....model import Array
from ....native.spec import NativeSpec
from ....signals import Signal, force_outputs, journal_inputs
from ...reaction import NOMINAL_SPEED, input_vector
from ...stepped_reaction import StepTrial
from .conserved_film import ConservedFilm, ConservedState, circular_gap
from .conserved_motion import step_stiffness, sudden_slopes
from .oil_kernel import OilSolution
from .oil_spec import OilNumbers, oil_spec
from .oil_steps import OilMemory, after_step, oil_step, packed_oil, passed_oil, unpacked_oil
from .step_kernel import FLOWS, MovingFilm, block_of, oil_sums, parts_of

LARGEST_ANGLE = 2.0 * math.pi / 192.0
"""Rotation of the shaft in one inner step [rad]."""

LARGEST_WAY = 0.02
"""Way of the journal in one inner step, in clearances."""

FLOW_NAMES = {
    "side_flow": "oil that leaves through both ends",
    "drawn_in": "oil that enters through both ends",
    "inflow": "oil that leaves all openings for the film, less what arrives there",
}


class FilmMemory(NamedTuple):
    """State of a film in motion.

    Attributes
    ----------
    oil : OilMemory
    motion : ndarray, shape (5,) [m, m, m/s, m/s, rad/s]
        x, y, vx, vy, speed of the journal.
    output : ndarray, shape (9,) [N, N, m3/s, m3/s, m3/s, m3, m3/s, m3/s, m3/s]
    passed : ndarray, shape (3,) [m3]
        Of side flow, what is drawn in and inflow, in the last inner step.
    """

    oil: OilMemory
    motion: Array
    output: Array
    passed: Array


class SteppedFilm:
    """Makes a Stepped model of a `film` in a `clearance`; force and oil have the units of `scales`.

    The input u is the motion of the journal at the end of a step. On the way there it goes along the cubic
    with the positions and velocities of both ends, in inner steps of a turn/192 and .02 clearances at most,
    halved where the film is not found. Outputs belong to the end of the last step, mean flows to the whole
    of it. They have the differences of the inner steps, so that in steps of any length, to round-off,

        oil_volume - oil_volume before = dt (mean_inflow + mean_drawn_in - mean_side_flow).
    """

    @property
    def film(self) -> ConservedFilm:
        """The film without dimensions."""
        raise NotImplementedError

    if TYPE_CHECKING:  # a field of some films, a property of others

        @property
        def clearance(self) -> float:
            """Radial clearance [m]."""

    @property
    def scales(self) -> tuple[float, float]:
        """Units of the force [N s] and of the oil, clearance radius length [m3]."""
        raise NotImplementedError

    @property
    def numbers(self) -> OilNumbers:
        """What its kernel has besides the film."""
        raise NotImplementedError

    def native(self) -> NativeSpec:
        """Return its kernel in the C library, which steps as this model does."""
        return oil_spec(self.moving, self.numbers)

    def carrying(self, motion: Array) -> float:
        """Return the speed with which the walls carry the oil [rad/s]: half that of a journal."""
        return 0.5 * float(motion[4])

    @property
    def inputs(self) -> tuple[Signal, ...]:
        """Signals x, y, vx, vy, speed, at the end of a step."""
        return journal_inputs(self.clearance, NOMINAL_SPEED)

    @property
    def outputs(self) -> tuple[Signal, ...]:
        """Signals force_x, force_y on the journal, side_flow, drawn_in, inflow, oil_volume, mean flows."""
        force, volume = self.scales
        flow = volume * NOMINAL_SPEED
        flows, means = (
            [Signal(name=f"{kind}{name}", unit="m3/s", nominal=flow, description=f"{text}{when}")
             for name, text in FLOW_NAMES.items()]
            for kind, when in (("", ""), ("mean_", "; mean over the last step"))
        )  # fmt: skip
        oil = "oil in the gap, over the openings too"
        held = Signal(name="oil_volume", unit="m3", nominal=volume, description=oil)
        return (*force_outputs(force * NOMINAL_SPEED), *flows, held, *means)

    def start(self, u: ArrayLike) -> FilmMemory:
        """Return the steady film at rest at u = (x, y, vx, vy, speed); the velocity counts later.

        Raises
        ------
        InputError
            If u is not five finite numbers.
        FilmContactError
            If the journal touches the wall.
        ConvergenceError
            If the search for the cavity does not end.
        """
        motion = self._inside(input_vector(u), "")
        return self._remembered(self.moving.begin(motion))

    def step(
        self, state: FilmMemory, t: float, u: ArrayLike, dt: float
    ) -> tuple[FilmMemory, Array, dict[str, int]]:
        """Return state, outputs and counters of work after dt [s] in which the journal goes to u.

        Raises
        ------
        InputError
            If u is not five finite numbers, or dt not finite and not negative.
        FilmContactError
            If the journal touches the wall; the old state stays good.
        ConvergenceError
            If the film is not found even in steps halved several times; the old state stays good.
        """
        target = self._inside(input_vector(u), f" at t = {t + dt:.9g} s")
        if dt == 0.0:
            return state, state.output, {"steps": 0, "solutions": 0}
        require_positive("dt", dt)
        heads = state.oil.length, state.motion, state.output, state.passed
        begin = block_of(heads, state.oil._asdict())
        block, steps, solutions = self.moving.travel(begin, t, target, dt)
        end = self._remembered(block)
        return end, end.output.copy(), {"steps": steps, "solutions": solutions}

    def attempt(self, state: FilmMemory, u: Array, dt: float, near: FilmMemory | None = None) -> StepTrial:
        """Return one inner step, with its slope; see `bearings.stepped_reaction`."""
        found = self._found(state, u, dt, near)
        sums = self._sums(found)
        passed = passed_oil(state.passed, sums[FLOWS], found, dt)
        output = np.concatenate([sums, passed / dt])
        end = FilmMemory(after_step(state.oil, found, dt), u, output, passed)
        force, _ = self.scales
        slope = force / self.clearance * step_stiffness(self.film, found)
        return StepTrial(end, end.output, slope, found.solution.solutions + 1)

    def slopes(self, state: FilmMemory) -> Array:
        """Return d force / d (x, y, vx, vy, speed) at a state whose cells keep their oil, shape (2, 5)."""
        rate = self.carrying(state.motion)
        gap = circular_gap(self.film.cells, state.motion[:2] / self.clearance)
        solution = OilSolution(state.oil.pressure, state.oil.theta, state.oil.full, 0, 0)
        film = ConservedState(gap, rate, self.film.equations(gap, rate), solution)
        force, _ = self.scales
        return force * sudden_slopes(self.film, film) / np.array([*[self.clearance] * 4, 1.0])

    def answer(self, state: FilmMemory) -> Array:
        """Return the outputs of a state, shape (9,)."""
        return state.output.copy()

    def pack(self, state: FilmMemory) -> bytes:
        """Return a state as bytes, to the last bit."""
        return packed_oil(state.oil, motion=state.motion, output=state.output, passed=state.passed)

    def unpack(self, content: bytes) -> FilmMemory:
        """Return the state in bytes; raise InputError if it is of other cells."""
        oil, further = unpacked_oil(content, self.film.cells.opening.shape)
        return FilmMemory(oil, further["motion"], further["output"], further["passed"])

    @property
    def moving(self) -> MovingFilm:
        """The film in SI units that the compiled library steps."""
        share = self.carrying(np.array([0.0, 0.0, 0.0, 0.0, 1.0]))
        return MovingFilm(self.film, self.clearance, share, *self.scales, LARGEST_ANGLE, LARGEST_WAY)

    def _remembered(self, block: Array) -> FilmMemory:
        (length, *heads), rows = parts_of(block, self.film.cells.opening.shape)
        return FilmMemory(OilMemory(length=length, **rows), *heads)

    def _found(self, state: FilmMemory, u: Array, dt: float, near: FilmMemory | None) -> ConservedState:
        gap = circular_gap(self.film.cells, u[:2] / self.clearance)
        like = None if near is None else near.oil
        return oil_step(self.film, state.oil, gap, self.carrying(u), dt, near=like)

    def _sums(self, state: ConservedState) -> Array:
        force, volume = self.scales
        return oil_sums(self.film, state) * np.repeat([force, volume], [2, 4])

    def _inside(self, motion: Array, when: str) -> Array:
        require_inside(motion[:2], self.clearance, when)
        return motion
