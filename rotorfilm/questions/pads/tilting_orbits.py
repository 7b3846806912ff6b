"""Questions about the orbit that an unbalance makes on tilting pads: linear and nonlinear, pads in time."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from ...answers import DISAGREEMENT, ISOTHERMAL, ErrorEstimate, Found, Work, WorkUnit
from ...bearings.pads import TiltingPadBearing
from ...errors import FilmContactError
from ...ladders import Ladder
from ...linear import equilibrium
from ...model import Array
from ...motion.periodic.harmonics import basis, first_wave
from ...motion.periodic.stateful_orbit import StatefulTurn, TurnEquations, resampled
from ...scenes.pads.tilting_candidates import TiltingCandidate, tilting_candidates
from ..journal.unbalance_orbits import SAMPLES, rotor_of
from ..orbit_place import FORCE, UNITS, wave_change, wave_value
from ..orbit_rung import SampledOrbitRung
from .warm_pads import settled_scene

if TYPE_CHECKING:
    from ...scenes.scene import Scene

LINEAR = 15
"""Samples over a turn of a linear orbit."""

NEWTON = 6
"""Newton steps that an orbit takes about."""


@dataclass(frozen=True, kw_only=True)
class TiltingOrbitRung(SampledOrbitRung[TiltingCandidate]):
    """The orbit on tilting pads of one film, by its equations over a turn."""

    @property
    def points(self) -> WorkUnit:
        """The pads at one state and time, with derivatives."""
        nominal = self.film.time(1)
        return WorkUnit(f"states of {self.film.name}", ("states", self.film), nominal=nominal)

    def answer(self, before: Found | None) -> Found:
        """Return the quantity of the orbit, from that of a lower rung if there is one."""
        bearing = self.film.reaction
        if not self.samples:
            turn, count = self._equations(bearing, LINEAR).linear(self._rest(bearing)), LINEAR
        else:
            start = self._rest(bearing)[:, None] if before is None else before.solution.places
            turn, count = self._equations(bearing, self.samples).orbit(start), NEWTON * self.samples
        return Found(self._value(turn), {self.points: count}, turn)

    def estimate(self, found: Found, before: Found | None, tolerance: float) -> ErrorEstimate:
        """Return the change by two steps with the richer film, at twice the samples, by this one's slopes."""
        places = found.solution.places
        samples = 2 * places.shape[1] + 1
        places = resampled(places, samples)
        own, rich = (self._equations(one, samples) for one in (self.film.reaction, self.film.rich))
        try:
            matrix = own.matrix(own.residual(places, slopes=True)[1])
            first = rich.step(matrix, rich.residual(places)[0])
            second = rich.step(matrix, rich.residual(places + first)[0])
        except FilmContactError:
            return ErrorEstimate(math.inf, "defect", doubt="the orbit leaves the clearance: not linear")
        better = rich.turn(places + first + second)
        error = wave_change(self.quantity, found.value, self._value(better))
        left = float(np.linalg.norm(second[:2])) / max(float(np.linalg.norm(first[:2])), 1e-300)
        doubt = f"a second step is {left:.0%} of the first: not linear" if left > DISAGREEMENT else ""
        method = f"defect of {self.film.rich_name}, {samples} samples"
        return ErrorEstimate(error, method, {self.points: samples}, doubt=doubt)

    def expected(self, done: Work) -> Work:
        """Return some Newton steps at these samples."""
        return {self.points: NEWTON * self.samples if self.samples else LINEAR}

    def _equations(self, bearing: TiltingPadBearing, samples: int) -> TurnEquations:
        return TurnEquations(self.rotor, bearing.evaluated, bearing.clearance, samples)

    def _rest(self, bearing: TiltingPadBearing) -> Array:
        speed = self.rotor.profile.speeds[0]
        position = equilibrium(bearing, self.rotor.static_force, speed).position
        return np.concatenate([position, bearing.at_rest().state(position, speed)])

    def _value(self, turn: StatefulTurn) -> float:
        rows = turn.force if self.quantity == FORCE else turn.places[:2]
        samples = rows.shape[1]
        wave = first_wave(rows @ basis(samples // 2, samples).back.T)
        # Over the angle of the rotor, not time: the unbalance turns with the phase at negative speed too.
        speed = abs(self.rotor.profile.speeds[0])
        return wave_value(self.quantity, wave, speed, self.rotor.unbalance_angle)


def tilting_orbit_ladder(scene: Scene, quantity: str) -> Ladder:
    """Return the ladder of an orbit on tilting pads: linear, then nonlinear, on each film.

    On an oil the films keep the temperature of the rest.

    Raises
    ------
    InputError
        As `rotor_of`.
    """
    settled = settled_scene(scene)
    films = tilting_candidates(settled.table("tilting_pad").build(), fixed=settled.film_is_given)
    rotor = rotor_of(settled)
    rungs = [
        TiltingOrbitRung(film=film, quantity=quantity, rotor=rotor, samples=n)
        for film in films
        for n in (0, *SAMPLES)
    ]
    return Ladder(
        rungs=tuple(rungs),
        unit=UNITS[quantity],
        remarks=scene.film_remarks,
        within=ISOTHERMAL,
        distance=lambda value, better: wave_change(quantity, value, better),
    )
