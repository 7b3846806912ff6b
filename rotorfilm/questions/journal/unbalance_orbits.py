"""Questions about the orbit that an unbalance makes: amplitude, phase, force; linear and nonlinear rungs."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

import numpy as np

from ...answers import DISAGREEMENT, ISOTHERMAL, SAFETY, ErrorEstimate, Found, Work, WorkUnit, beside_bound
from ...errors import InputError, RotorfilmError
from ...ladders import CandidateRung, Ladder
from ...linear import coefficients, equilibrium
from ...model import Array, Reaction
from ...motion.periodic.sampled_orbit import (
    SampledOrbit,
    circles,
    defect,
    first_wave,
    linear_orbit,
    nonlinear_orbit,
    pull,
    resampled,
    shift,
)
from ...rotors import RigidRotor
from ...scenes.excitation_table import UnbalanceTable
from ...scenes.journal.film_rungs import MAP_BOUNDS, FilmRung, turn_films

if TYPE_CHECKING:
    from ...scenes.scene import Scene

AMPLITUDE, PHASE, FORCE = "unbalance_amplitude", "unbalance_phase", "unbalance_force"
UNITS = {AMPLITUDE: "m", PHASE: "rad", FORCE: "N"}
"""Quantities of an orbit and their units."""

SAMPLES = (15, 31, 63)
"""Samples over a turn of the nonlinear rungs; odd, see `rate_matrix`."""

LINEAR = 31
"""Samples over a turn at which a linear orbit's defect is taken."""


@dataclass(frozen=True, kw_only=True)
class OrbitRung(CandidateRung[FilmRung]):
    """The orbit on one film, linear about the equilibrium or nonlinear at so many samples.

    Attributes
    ----------
    quantity : str
        A key of `UNITS`.
    rotor : RigidRotor
    samples : int
        Over a turn; 0 for the linear orbit.
    """

    quantity: str
    rotor: RigidRotor
    samples: int

    @property
    def name(self) -> str:
        """Linear, or the number of samples, and the film."""
        how = f"nonlinear, {self.samples} samples" if self.samples else "linear"
        return f"{how}, {self.film.name}"

    @property
    def prior(self) -> float:
        """Order of magnitude of the film's error."""
        return 0.3 * self.film.prior

    @property
    def refines(self) -> tuple[object, ...]:
        """The film, where there are samples."""
        return (self.film,) if self.samples else ()

    @property
    def speed(self) -> float:
        """Of the rotor [rad/s]."""
        return self.rotor.profile.speeds[0]

    def answer(self, before: Found | None) -> Found:
        """Return the quantity of the orbit; a nonlinear one starts from that of a lower rung."""
        made = self.film.prepare()
        if not self.samples:
            orbit, work = self._linear(LINEAR), 6
        else:
            start = before.solution if before is not None else self._linear(self.samples)
            orbit, work = self._nonlinear(start)
        return Found(self.value(orbit), {self.film.tangents: work, **made}, orbit)

    def _linear(self, samples: int) -> SampledOrbit:
        at = equilibrium(self.film.reaction, self.rotor.static_load, self.speed)
        found = coefficients(self.film.reaction, at.position, self.speed)
        return linear_orbit(self.rotor, at.position, found.stiffness, found.damping, samples)

    def _nonlinear(self, start: SampledOrbit) -> tuple[SampledOrbit, int]:
        """Return the orbit; where its start is too far out, from the rest up in steps of the unbalance."""
        clearance = self.film.reaction.clearance
        if np.hypot(*start.position).max() < 0.98 * clearance:
            try:
                return nonlinear_orbit(self.rotor, self.film.reaction, resampled(start, self.samples))
            except RotorfilmError:
                pass
        calls, orbit = 0, _resting(self.film.reaction, self.rotor, self.samples)
        for part in np.linspace(0.125, 1.0, 8):
            rotor = replace(self.rotor, unbalance=part * self.rotor.unbalance)
            orbit, more = nonlinear_orbit(rotor, self.film.reaction, orbit)
            calls += more
        return orbit, calls

    def value(self, orbit: SampledOrbit) -> float:
        """Return the quantity of an orbit, from its first harmonic."""
        wave = first_wave(orbit.position)
        if self.quantity == FORCE:
            turning = first_wave(_unbalance(self.rotor, orbit.position.shape[1]))
            wave = -self.rotor.mass * self.speed**2 * wave - turning
        with_it, against = circles(wave)
        if self.speed < 0.0:
            with_it, against = np.conj(against), np.conj(with_it)
        if self.quantity == PHASE:
            turn = float(np.angle(with_it)) * math.copysign(1.0, self.speed)
            return math.remainder(turn - self.rotor.unbalance_angle, 2.0 * math.pi)
        return abs(with_it) + abs(against)

    def estimate(self, found: Found, before: Found | None, tolerance: float) -> ErrorEstimate:
        """Return the change that the richer film, at twice the samples, would make to first order.

        For the map the richer film is the map itself, as long as its own verified error is small enough.
        """
        orbit: SampledOrbit = found.solution
        reach = float(np.hypot(*orbit.position).max()) / self.film.reaction.clearance
        if reach >= 0.999:
            return ErrorEstimate(math.inf, "defect", doubt="the orbit leaves the clearance: not linear")
        doubled = resampled(orbit, 2 * orbit.position.shape[1] + 1)
        calls = doubled.position.shape[1]
        bound = MAP_BOUNDS[0][2] if self.film.bounded and reach <= MAP_BOUNDS[0][0] else math.inf
        if SAFETY * bound < tolerance:
            error, doubt = self._by_defect(doubled, found, self.film.reaction)
            method, work = f"its defect at {calls} samples", {self.film.tangents: calls}
            return beside_bound(error, bound, method, work, doubt)
        error, doubt = self._by_defect(doubled, found, self.film.rich)
        work = {self.film.defects(smooth=False): calls}
        method = f"defect of {self.film.rich_name}, {calls} samples"
        return ErrorEstimate(error, method, work, bound=self.film.bounded and bool(self.samples), doubt=doubt)

    def _by_defect(self, orbit: SampledOrbit, found: Found, rich: Reaction) -> tuple[float, str]:
        missing, *slopes = defect(self.rotor, orbit, rich, self.film.reaction if self.film.bounded else rich)
        step = shift(self.rotor, missing, *slopes)
        other = shift(self.rotor, missing, *self._own_slopes(orbit))
        moved = SampledOrbit(position=orbit.position + step, velocity=orbit.velocity)
        value = self.value(moved)
        change = value - found.value
        if self.quantity == PHASE:
            change = math.remainder(change, 2.0 * math.pi)
        scale = 1.0 if self.quantity == PHASE else abs(value)
        apart = float(np.linalg.norm(step - other)) / max(float(np.linalg.norm(step)), 1e-300)
        doubt = ""
        if apart > DISAGREEMENT:
            doubt = f"the slopes of both films disagree on the error by {apart:.0%}: not linear"
        return abs(change) / scale, doubt

    def _own_slopes(self, orbit: SampledOrbit) -> tuple[Array, Array]:
        """Return K and C of this rung along an orbit (2, 2, n): constant for the linear one."""
        n = orbit.position.shape[1]
        if self.samples:
            _, stiffness, damping = defect(self.rotor, orbit, self.film.reaction, self.film.reaction)
            return stiffness, damping
        at = equilibrium(self.film.reaction, self.rotor.static_load, self.speed)
        found = coefficients(self.film.reaction, at.position, self.speed)
        stiffness, damping = (part[:, :, None].repeat(n, axis=2) for part in (found.stiffness, found.damping))
        return stiffness, damping

    def expected(self, done: Work) -> Work:
        """Return five Newton steps at these samples."""
        return self.film.expected(5 * self.samples if self.samples else 6)


def _resting(reaction: Reaction, rotor: RigidRotor, n: int) -> SampledOrbit:
    at = equilibrium(reaction, rotor.static_load, rotor.profile.speeds[0])
    return SampledOrbit(position=np.repeat(at.position[:, None], n, axis=1), velocity=np.zeros((2, n)))


def _unbalance(rotor: RigidRotor, n: int) -> Array:
    return pull(rotor, n) - rotor.static_load[:, None]


def rotor_of(scene: Scene) -> RigidRotor:
    """Return the rotor of a scene with the unbalance of its excitation, or else its own.

    Raises
    ------
    InputError
        If it has none or both, another excitation, or does not turn.
    """
    rotor, excitation = scene.rotor, scene.excitation
    if type(excitation) is UnbalanceTable:  # a lost blade is one too
        require_one_unbalance(rotor)
        rotor = replace(rotor, unbalance=excitation.unbalance, unbalance_angle=excitation.unbalance_angle)
    elif excitation is not None:
        raise InputError(
            f'excitation must be of kind "unbalance" for a steady orbit, got {type(excitation).__name__}'
        )
    if rotor.unbalance <= 0.0:
        raise InputError(f"rigid_rotor.unbalance must be positive for an orbit, got {rotor.unbalance!r}")
    if scene.speed == 0.0:
        raise InputError("operation.speed must not be zero for an orbit, got 0.0")
    return rotor


def require_one_unbalance(rotor: RigidRotor) -> None:
    """Raise InputError if a rotor has an unbalance beside that of an excitation."""
    if rotor.unbalance:
        raise InputError(
            "rigid_rotor.unbalance must be 0 where [excitation] has the unbalance, "
            f"got {rotor.unbalance!r} kg m"
        )


def orbit_ladder(scene: Scene, quantity: str) -> Ladder:
    """Return the ladder of a quantity of the synchronous orbit: linear, then nonlinear, on each film."""
    rotor = rotor_of(scene)
    films = orbit_films(scene)
    rungs = [OrbitRung(film=film, quantity=quantity, rotor=rotor, samples=0) for film in films]
    rungs += [
        OrbitRung(film=film, quantity=quantity, rotor=rotor, samples=n) for film in films for n in SAMPLES
    ]
    rungs.sort(key=lambda rung: _effort(rung, films))
    return Ladder(
        rungs=tuple(rungs),
        unit=UNITS[quantity],
        units=film_batch_units(films, scene.speed),
        remarks=scene.film_remarks,
        within=ISOTHERMAL,
    )


def orbit_films(scene: Scene) -> tuple[FilmRung, ...]:
    """Return the films worth taking round a turn: the map where there is one, else short film, grids, map."""
    return turn_films(scene.bearing, fixed=scene.film_is_given, grids=((48, 8), (96, 8)), maps=True)


def _effort(rung: OrbitRung, films: tuple[FilmRung, ...]) -> float:
    """Return a measure of cost by which the rungs are ordered: films by place, each twice the one before."""
    one = 1e3 if rung.film.makes_map else 2.0 ** films.index(rung.film)
    return one * (6 if rung.samples == 0 else 5 * rung.samples)


def film_batch_units(films: tuple[FilmRung, ...], speed: float) -> dict[WorkUnit, Callable[[], object]]:
    """Return one force with derivatives of each film and of its richer one."""
    units: dict[WorkUnit, Callable[[], object]] = {}
    for film in films:
        units[film.tangents] = _sampled(film.reaction, speed)
        units[film.defects(smooth=False)] = _sampled(film.rich, speed)
    return units


def _sampled(reaction: Reaction, speed: float) -> Callable[[], object]:
    position, velocity = np.array([0.3, 0.4]) * reaction.clearance, np.zeros(2)

    def one() -> object:
        return reaction.force(position, velocity, speed), reaction.jacobian(position, velocity, speed)

    return one
