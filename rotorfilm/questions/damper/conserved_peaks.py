"""A rotor on a damper that conserves its oil, in time: a lost blade, a run-up, an orbit past holes."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import cached_property
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from ...answers import ISOTHERMAL, ErrorEstimate, Found, WorkUnit
from ...bearings.damper import JFODamper
from ...errors import ContactError, ConvergenceError, FilmContactError
from ...ladders import BaseRung, Ladder
from ...model import Array
from ...motion import simulate
from ...motion.transient.equal_steps import peak
from ...results import Trajectory
from ...rotors import RigidRotor
from ...scenes.damper.damper_films import lands, mapped_short
from ...scenes.damper.damper_models import damper_models
from ...scenes.damper.damper_remarks import rotor_remarks

if TYPE_CHECKING:
    from ...scenes.scene import Scene

LEVELS = ((32, 8), 48), ((48, 12), 96), ((72, 16), 192)
"""Cells, and steps of a turn, of the rungs."""

STEP_TIME = 3e-6
"""About what a step takes for each cell [s]."""

FEWEST_TURNS, MOST_TURNS, REPEATED = 12, 96, 1e-3
"""Turns after which an orbit is looked at first and last, and its change from turn to turn when steady."""


class FollowedRotor(NamedTuple):
    """A motion that was followed: the equal steps of a turn, and what it shows."""

    steps: int
    run: Trajectory


@dataclass(frozen=True, kw_only=True)
class ConservedRunRung(BaseRung):
    """A quantity of a motion on the film that conserves its oil, judged by longer steps and by fewer cells.

    Attributes
    ----------
    damper : JFODamper
        With its springs, on the cells of this rung.
    rotor : RigidRotor
        At rest in the center.
    steps : int
        Of a turn, at the highest speed.
    value : callable
        Takes a rung and returns the quantity.
    """

    damper: JFODamper
    rotor: RigidRotor
    steps: int
    value: Callable[[ConservedRunRung], float]

    @property
    def name(self) -> str:
        """Cells and steps."""
        around, along = self.damper.cells
        return f"conserved oil {around} x {along}, {self.steps} steps"

    @property
    def unit(self) -> WorkUnit:
        """One answer."""
        seconds = STEP_TIME * math.prod(self.damper.cells) * self.steps * FEWEST_TURNS
        return WorkUnit(f"answers of {self.name}", ("answers", self.name), nominal=seconds)

    @cached_property
    def found(self) -> float:
        """The quantity."""
        return self.value(self)

    def follow(self, duration: float) -> FollowedRotor:
        """Return a motion from rest; raises FilmContactError at the wall."""
        fastest = max(abs(speed) for speed in self.rotor.profile.speeds)
        count = math.ceil(duration * fastest * self.steps / (2.0 * math.pi) - 1e-9)
        times = duration / count * np.arange(count + 1)
        try:
            run = simulate(self.rotor, self.damper, duration=duration, times=times, max_step=duration / count)
        except ContactError as error:
            raise FilmContactError(f"the rotor touches the wall: {error}") from error
        return FollowedRotor(self.steps, run)

    def answer(self, before: Found | None) -> Found:
        """Return the quantity; raises FilmContactError at the wall."""
        return Found(self.found, {self.unit: 1})

    def estimate(self, found: Found, before: Found | None, tolerance: float) -> ErrorEstimate:
        """Return the changes since steps twice as long and since half the cells: some thrice the error."""
        around, along = self.damper.cells
        fewer = replace(self.damper, cells=(2 * round(0.25 * around), 2 * round(0.25 * along)))
        others = replace(self, steps=self.steps // 2).found, replace(self, damper=fewer).found
        error = sum(abs(other / found.value - 1.0) for other in others)
        work = {WorkUnit(f"estimates of {self.name}"): 1}
        return ErrorEstimate(error, "steps twice as long, half the cells", work, bound=True)


def conserved_peak_ladder(scene: Scene) -> Ladder:
    """Return the ladder of the largest distance after a blade is lost, or over a run-up, with a supply."""
    duration = damper_models(scene).duration

    def value(rung: ConservedRunRung) -> float:
        return peak(rung.follow(duration).run.position)

    return _ladder(scene, value, "m", steady=False)


def passing_holes_ladder(scene: Scene, quantity: str, unit: str) -> Ladder:
    """Return the ladder of the orbit of a rotor past feed holes, or of what it transmits.

    Followed from rest until it repeats itself: the amplitude is the largest distance from the mean place, and
    the transmissibility that of the force at the rotor's frequency, the longer half axis of its ellipse.
    """

    def value(rung: ConservedRunRung) -> float:
        return _repeated(rung, quantity)

    return _ladder(scene, value, unit, steady=True)


def _repeated(rung: ConservedRunRung, quantity: str) -> float:
    """Return a quantity of the last turn, once it does so from turn to turn."""
    turns, period = FEWEST_TURNS, 2.0 * math.pi / abs(rung.rotor.profile.speeds[-1])
    while turns <= MOST_TURNS:
        found = rung.follow(turns * period)
        last, before = (_of_turn(found, rung.rotor, quantity, back) for back in (1, 2))
        if abs(last - before) <= REPEATED * abs(last):
            return last
        turns *= 2
    raise ConvergenceError(
        f"the orbit must repeat itself to {REPEATED:g} within {MOST_TURNS} turns, and changes by "
        f"{abs(last / before - 1.0):.2g} from the last but one to the last"
    )


def _of_turn(found: FollowedRotor, rotor: RigidRotor, quantity: str, back: int) -> float:
    """Return a quantity of one turn, 1 the last."""
    end = len(found.run.time) - (back - 1) * found.steps
    turn = slice(end - found.steps, end)
    if quantity == "unbalance_amplitude":
        q = found.run.position[:, turn]
        return float(np.hypot(*(q - q.mean(axis=1, keepdims=True))).max())
    speed, signals = rotor.profile.speeds[-1], found.run.signals
    force: Array = signals["force_x"][turn] + 1j * signals["force_y"][turn]
    wave = np.exp(2j * math.pi * np.arange(found.steps) / found.steps)
    size = sum(abs(np.mean(force * one)) for one in (wave, wave.conj()))
    return float(size / (rotor.unbalance * speed**2))


def _ladder(scene: Scene, value: Callable[[ConservedRunRung], float], unit: str, *, steady: bool) -> Ladder:
    table, models = scene.damper, damper_models(scene)
    assert table is not None  # whose question it is
    assert table.supply is not None
    damper = table.conserved(table.supply)
    rungs = tuple(
        ConservedRunRung(damper=replace(damper, cells=cells), rotor=models.rotor, steps=steps, value=value)
        for cells, steps in LEVELS
    )
    count, rotor = lands(table), models.rotor
    shared = replace(rotor, mass=rotor.mass / count, unbalance=rotor.unbalance / count)
    remarks = rotor_remarks(
        table, mapped_short(table), table.stiffness / count, shared, scene.lubricant.properties, steady=steady
    )
    return Ladder(rungs=rungs, unit=unit, remarks=remarks, within=ISOTHERMAL)
