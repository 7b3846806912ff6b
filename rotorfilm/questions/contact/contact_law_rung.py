"""The approach of a rolling ball on its reduced law, over time."""

from __future__ import annotations

from dataclasses import dataclass

from ...answers import ErrorEstimate, Found, Work, WorkUnit
from ...bearings.contact import HERTZ_LOAD, ContactLaw, SineLoad, reduce_contact, ride
from ...errors import ConvergenceError, InputError
from ...ladders import BaseRung
from ...scenes.contact.contact_motions import ShakenBall, natural_frequency
from ...scenes.contact.contact_rest import RestingFilms

CELLS, FINE = 32, 64
"""Cells along each side of the film that the law is made of, and of a finer one that tells its error."""

RIDE, LAW = WorkUnit("motions on a reduced law"), WorkUnit("reduced laws")

ELSEWHERE = 0.7
"""Where between rest and the extreme load a second law is made, of which the difference tells the error."""


@dataclass(frozen=True, kw_only=True)
class LawRung(BaseRung):
    """The motion on the law of the contact under its static load.

    Attributes
    ----------
    films : RestingFilms
        Of the approach.
    shaken : ShakenBall
        Load over time, and motion asked for.
    """

    films: RestingFilms
    shaken: ShakenBall

    name = "reduced law over time"

    @property
    def order(self) -> int:
        """States of the law."""
        return self.films.table.order

    def answer(self, before: Found | None) -> Found:
        """Return the deepest approach [m]."""
        mass = self.films.table.mass
        if not mass > 0.0:
            raise InputError(f"contact.mass must be positive for a motion on a reduced law, got {mass!r} kg")
        law = reduce_contact(self.films.contact(CELLS), self.order)
        deepest, carried = self._motion(law)
        return Found(deepest * self.films.ball.film_scale, {LAW: 1, RIDE: 1}, (law, deepest, carried))

    def _motion(self, law: ContactLaw) -> tuple[float, tuple[float, float]]:
        """Return the deepest approach and the range of the force, in the units of the contact."""
        start = float(law.approach(1.0))
        motion = ride(
            law,
            mass=self.films.ball.W / HERTZ_LOAD,
            load=self.shaken.load,
            start=start,
            duration=self.shaken.duration,
        )
        force = motion["force_z"]
        return float(motion["z"].min()), (float(force.min()), float(force.max()))

    def estimate(self, found: Found, before: Found | None, tolerance: float) -> ErrorEstimate:
        """Return the errors of grid and rectangle at rest, of the fit, and of the law's one load."""
        law, deepest, carried = found.solution
        work: dict[WorkUnit, int] = {}
        load = min(max((deepest / law.operating) ** 1.5, 1.0), law.load_range[1])
        try:
            lacking = self.films.lacking(CELLS, FINE, work, load)
            other = reduce_contact(self.films.contact(CELLS), self.order, load=self._elsewhere())
            elsewhere = abs(self._motion(other)[0] - deepest) / abs(deepest)
        except ConvergenceError as error:
            return ErrorEstimate(1.0, "law about another load", work, doubt=f"no companion: {error}")
        fit = law.static_error / law.exponent
        work |= {LAW: 1, RIDE: 1}
        method = "order increments at rest; law about another load"
        return ErrorEstimate(lacking + fit + elsewhere, method, work, doubt=self._doubt(law, carried))

    def _elsewhere(self) -> float:
        least, most = self.shaken.extremes
        far = most if most > 1.0 else least
        return 1.0 + ELSEWHERE * (max(far, 0.3) - 1.0)

    def _doubt(self, law: ContactLaw, carried: tuple[float, float]) -> str:
        low, high = law.load_range
        if carried[0] < low or carried[1] > high:
            return (
                f"the force, {carried[0]:.2g} to {carried[1]:.2g} static loads, leaves the range of the law"
            )
        fastest = natural_frequency(self.films.ball.W)
        if isinstance(self.shaken.load, SineLoad):
            fastest = max(fastest, self.shaken.load.frequency)
        if fastest > law.highest_frequency:
            return f"the law reaches to the frequency {law.highest_frequency:g}, not to {fastest:.3g}"
        return ""

    def expected(self, done: Work) -> Work:
        """Return a law and a motion on it."""
        return {LAW: 1, RIDE: 1}
