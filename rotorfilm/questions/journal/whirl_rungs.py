"""At which speed a rigid rotor begins to whirl, by each film."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, Protocol

import numpy as np

from ...answers import DISAGREEMENT, ISOTHERMAL, SAFETY, ErrorEstimate, Found, Work
from ...errors import InputError, RotorfilmError
from ...ladders import CandidateRung, Ladder
from ...linear import coefficients, equilibrium, whirl_threshold
from ...model import Array
from ...results import Coefficients, Equilibrium, WhirlThreshold
from ...scenes.counted import counted_calls
from ...scenes.journal.film_candidate import FilmCandidate
from ...scenes.journal.film_defects import corrected
from ...scenes.journal.film_rungs import point_films
from ..walk import NoAnswerError
from .statics import film_units

if TYPE_CHECKING:
    from ...scenes.scene import Scene
    from ...scenes.schema import RigidRotorTable

AROUND = 1.4
"""A higher rung looks for the threshold within this factor of a lower one's."""

STEP = 1e-4
"""Relative change of speed over which the growth rate is differentiated."""


@dataclass(frozen=True, kw_only=True)
class WhirlRung(CandidateRung[FilmCandidate]):
    """The whirl threshold by one film.

    Attributes
    ----------
    load : (float, float) [N]
    mass : float [kg]
    """

    load: tuple[float, float]
    mass: float

    @property
    def prior(self) -> float:
        """Order of magnitude of the film's error."""
        return 0.3 * self.film.prior

    def answer(self, before: Found | None) -> Found:
        """Return the speed at which the equilibrium loses stability [rad/s]."""
        made = self.film.prepare()
        counted = counted_calls(self.film.reaction)
        close = self.film.bounded or self.film.on_grid(self.film.reaction)
        threshold = threshold_around(counted, self, before, NoAnswerError if close else RotorfilmError)
        return Found(threshold.speed, {self.film.tangents: counted.tangents, **made}, threshold.equilibrium)

    def estimate(self, found: Found, before: Found | None, tolerance: float) -> ErrorEstimate:
        """Return the change of speed that undoes the growth which the richer film's K and C would bring.

        The whirl s = i nu of the cheap film becomes s' with the richer one's coefficients; the speed changes
        by -Re s' / (d Re s/d speed), the slope being that of the cheap film along its own equilibria.
        """
        at: Equilibrium = found.solution
        bound = self._bound(at)
        if SAFETY * bound < tolerance:
            return ErrorEstimate(bound, "verified bound of the map", {self.film.tangents: 15}, bound=True)
        moved = corrected(self.film_at(at), at, np.array(self.load), smooth=True)
        cheap = coefficients(self.film.reaction, at.position, at.speed)
        own = self._matrix(cheap.stiffness, cheap.damping)
        other = self._matrix(-moved.slopes[:, :2], -moved.slopes[:, 2:])
        first_order, exact = growths(own, other)
        slope = self.slope(at.speed)
        error = abs(exact / slope) / at.speed
        doubt = moved.doubt
        if abs(first_order - exact) > DISAGREEMENT * abs(exact):
            doubt = doubt or "the perturbed eigenvalue disagrees with the exact one: not linear"
        work = {self.film.defects(smooth=True): 1, self.film.tangents: 15}
        method = f"defect of {self.film.rich_name}, eigenvalue perturbation"
        return ErrorEstimate(error, method, work, bound=self.film.bounded, doubt=doubt)

    def film_at(self, at: Equilibrium) -> FilmCandidate:
        """Return the film at one equilibrium."""
        return self.film

    def growth(self, found: Coefficients) -> float:
        """Return the growth rate of the least stable whirl on these coefficients [1/s]."""
        return float(least_stable(self._matrix(found.stiffness, found.damping))[0].real)

    def _bound(self, at: Equilibrium) -> float:
        """Return the error [1] that the worst K and C within the verified bound would make."""
        bound = self.film_at(at).rest_bound(at, slopes=True)
        if not math.isfinite(bound):
            return math.inf
        found = coefficients(self.film.reaction, at.position, at.speed)
        own = self._matrix(found.stiffness, found.damping)
        worst = np.zeros((4, 4))
        worst[2:, :2] = bound * np.abs(found.stiffness).max() / self.mass
        worst[2:, 2:] = bound * np.abs(found.damping).max() / self.mass
        _, left, right = least_stable(own)
        return float(np.abs(left) @ worst @ np.abs(right)) / abs(self.slope(at.speed)) / at.speed

    def _matrix(self, stiffness: Array, damping: Array) -> Array:
        zero, one = np.zeros((2, 2)), np.eye(2)
        return np.block([[zero, one], [-stiffness / self.mass, -damping / self.mass]])

    def slope(self, speed: float) -> float:
        """Return d Re s/d speed of the whirl of this film, by central differences."""
        growth = []
        for near in (speed * (1.0 - STEP), speed * (1.0 + STEP)):
            at = equilibrium(self.film.reaction, self.load, near)
            found = coefficients(self.film.reaction, at.position, near)
            values = np.linalg.eigvals(self._matrix(found.stiffness, found.damping))
            growth.append(float(np.max(values.real)))
        return (growth[1] - growth[0]) / (2.0 * STEP * speed)

    def expected(self, done: Work) -> Work:
        """Return as many tangents as a lower rung took."""
        return self.film.expected(sum(done.values()))


class _Whirling(Protocol):
    @property
    def name(self) -> str: ...
    @property
    def load(self) -> tuple[float, float]: ...
    @property
    def mass(self) -> float: ...


def threshold_around(
    bearing: Any, rung: _Whirling, before: Found | None, absent: type[RotorfilmError] = RotorfilmError
) -> WhirlThreshold:
    """Return the threshold of a rung, looked for around that of a lower one first; an error without one."""
    around = None if before is None else (before.value / AROUND, before.value * AROUND)
    threshold = whirl_threshold(bearing, rung.load, rung.mass, around)
    if threshold.speed is None and around is not None:
        threshold = whirl_threshold(bearing, rung.load, rung.mass)
    if threshold.speed is None:
        raise absent(f"no threshold: {threshold.reason}, by {rung.name}")
    return threshold


def least_stable(matrix: Array) -> tuple[complex, Array, Array]:
    """Return the eigenvalue with the largest real part, its left and its right vector, left right = 1."""
    values, right = np.linalg.eig(matrix)
    k = int(np.argmax(values.real + 1e-12 * np.abs(values.imag)))
    return complex(values[k]), np.linalg.inv(right)[k], right[:, k]


def growths(own: Array, other: Array) -> tuple[float, float]:
    """Return the growth rate [1/s] that the least stable mode of `own` has in `other`: first order, exact.

    With the right and left eigenvectors r, l of a mode the first order of its change is l (other - own) r.
    """
    value, left, right = least_stable(own)
    shifted = value + left @ (other - own) @ right
    exact = np.linalg.eigvals(other)
    return float(shifted.real), float(exact[np.argmin(np.abs(exact - shifted))].real)


def required_rotor(scene: Scene, quantity: str) -> RigidRotorTable:
    """Return the table of the rigid rotor; raise InputError if the scene has none."""
    if scene.rigid_rotor is None:
        raise InputError(f"rigid_rotor is required for {quantity}, got no such table")
    return scene.rigid_rotor


def whirl_ladder(scene: Scene, quantity: str) -> Ladder:
    """Return the ladder of the whirl threshold.

    Raises
    ------
    InputError
        If the scene has no rigid rotor.
    """
    required_rotor(scene, quantity)
    return cold_whirl_ladder(scene, point_films(scene.journal_bearing, fixed=scene.film_is_given))


def cold_whirl_ladder(scene: Scene, films: Sequence[FilmCandidate]) -> Ladder:
    """Return the ladder of the whirl threshold of a scene with a rigid rotor by films of one viscosity."""
    mass = required_rotor(scene, "whirl_threshold").mass
    return Ladder(
        rungs=tuple(WhirlRung(film=film, load=scene.static_load, mass=mass) for film in films),
        unit="rad/s",
        units=film_units(films, math.sqrt(math.hypot(*scene.static_load) / (mass * scene.bearing.clearance))),
        remarks=scene.film_remarks,
        within=ISOTHERMAL,
    )
