"""A rolling ball under a load so slow that the film is at rest at each moment."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from ...answers import DISAGREEMENT, ErrorEstimate, Found, Work, WorkUnit
from ...bearings.contact import HERTZ_LOAD, SineLoad, SmallMotion
from ...errors import ConvergenceError, InputError
from ...ladders import BaseRung
from ...scenes.contact.contact_motions import ShakenBall, natural_frequency
from ...scenes.contact.contact_rest import RestingFilms, unknowns

CELLS, FINE = 48, 64
"""Cells along each side of the film at rest, and of a finer one that tells its error."""

SMALL = 32
"""Cells of the linearized film."""

REST = 1e-6
"""Frequency that stands for rest."""

SLACKEST = 0.05
"""Load below which there is no contact at rest to speak of."""


@dataclass(frozen=True, kw_only=True)
class SlowRung(BaseRung):
    """The extreme of a quantity over the loads, as if each had acted for long.

    Attributes
    ----------
    films : RestingFilms
    shaken : ShakenBall
    """

    films: RestingFilms
    shaken: ShakenBall

    name = "at rest under the extreme load"

    def answer(self, before: Found | None) -> Found:
        """Return the smallest value [m]: of the approach always that of the largest load."""
        least, most = self.shaken.extremes
        work: dict[WorkUnit, int] = {}
        loads = [most] if self.films.quantity == "approach" else [max(least, SLACKEST), most]
        values = {load: self.films.value(CELLS, work, load=load) for load in loads}
        load = min(values, key=lambda load: values[load])
        return Found(values[load] * self.films.ball.film_scale, work, load)

    def estimate(self, found: Found, before: Found | None, tolerance: float) -> ErrorEstimate:
        """Return the errors of grid and rectangle, and what the linearized film makes of the motion.

        Overestimated for a small motion: amplitudes are added whatever their phases.
        """
        work: dict[WorkUnit, int] = {}
        least, load = self.shaken.extremes[0], float(found.solution)
        try:
            lacking = self.films.lacking(CELLS, FINE, work, load)
            moved = abs(self._motion() / self.films.value(CELLS, work, load=load))
        except (ConvergenceError, InputError) as error:
            return ErrorEstimate(1.0, "linearized film", work, doubt=f"no companion: {error}")
        work[unknowns(SMALL)] = SMALL**2
        doubt = "the ball swings: no small motion about rest" if moved > DISAGREEMENT else ""
        if least < SLACKEST:
            doubt = "the ball leaves the film"
        method = "overestimated: order increments; amplitudes of the linearized film, whatever their phases"
        return ErrorEstimate(lacking + moved, method, work, bound=True, doubt=doubt)

    def _motion(self) -> float:
        """Return how far the quantity goes beyond that at rest, by the linearized film [1]."""
        contact = self.films.contact(SMALL)
        state = contact.stationary()
        small = SmallMotion(contact.equations, state.pressure.ravel(), state.delta)
        thinnest = int(np.argmin(contact.equations.film(state.pressure.ravel(), state.delta)))
        inertia = self.films.ball.W

        def per_load(w: float) -> tuple[complex, complex]:
            """Return the changes of quantity and approach per unit of a load as exp(i w t)."""
            approach = -HERTZ_LOAD / (small.stiffness(1j * w) - inertia * w**2)
            if self.films.quantity == "approach":
                return approach, approach
            central, samples = small.film(1j * w)
            return approach * (
                central if self.films.quantity == "central_film" else samples[thinnest]
            ), approach

        amplitude, natural = abs(self.shaken.load.amplitude), natural_frequency(inertia)
        still, depth = per_load(REST)
        rings = 0.0
        if math.isfinite(natural):
            ringing, ring_depth = per_load(natural)
            rings = abs(ringing / ring_depth * depth)
        if not isinstance(self.shaken.load, SineLoad):
            return amplitude * rings
        w = self.shaken.load.frequency
        forced = abs(per_load(w)[0])
        ratio = w / natural
        started = rings * ratio / max(abs(1.0 - ratio**2), 0.1)
        return amplitude * abs(forced + started - abs(still))

    def expected(self, done: Work) -> Work:
        """Return the number of unknowns."""
        return {unknowns(CELLS): 2 * CELLS**2}
