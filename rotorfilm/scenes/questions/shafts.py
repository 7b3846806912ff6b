"""The first critical speed of a flexible rotor: few shapes, plain elements, ever finer meshes."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from ...errors import InputError, RotorfilmError
from ...linear import critical_speeds, rotor_equilibrium
from ...linear.rotor_system import SecondOrder
from ...model import Array
from ..ladder import DISAGREEMENT, SAFETY, ErrorEstimate, Found, Ladder, Work
from .films import NOMINAL
from .shaft_films import ShaftFilms, coefficient_bounds, film_levels, rich_coefficients
from .shaft_models import ShaftModel, shaft_models
from .shaft_remarks import shaft_remarks
from .shaft_whirl import (
    Whirl,
    dynamics,
    frequency_rate,
    inverse_steps,
    journal,
    mode_near,
    on_films,
    small_motion,
    synchronous_whirl,
)

if TYPE_CHECKING:
    from ..scene import Scene

LARGEST = 0.1
"""Change of speed [1] beyond which a linear step tells nothing."""

ROUNDOFF = float(np.finfo(float).eps)


@dataclass(frozen=True, kw_only=True)
class ShaftSpeed:
    """A critical speed by one model, as a higher rung starts from it.

    Attributes
    ----------
    whirl : Whirl
    model : ShaftModel
    """

    whirl: Whirl
    model: ShaftModel


@dataclass(frozen=True, kw_only=True)
class ShaftRung:
    """The first critical speed by one model of the shaft and one film for each journal.

    Attributes
    ----------
    model : ShaftModel
    films : ShaftFilms
    speeds : ndarray, shape (n,) [rad/s]
        Where it is looked for.
    """

    model: ShaftModel
    films: ShaftFilms
    speeds: Array

    @property
    def name(self) -> str:
        """Name of the model of the shaft, and of the film."""
        return f"{self.model.name}, {self.films.name}" if self.films.name else self.model.name

    @property
    def prior(self) -> float:
        """Nothing is known beforehand."""
        return 0.0

    @property
    def unit(self) -> str:
        """Name of one linear problem."""
        return f"problems of {self.name}"

    def answer(self, before: Found | None) -> Found:
        """Return the first critical speed [rad/s]: looked for, or followed from that of a lower rung."""
        made = self.films.prepare()
        rotor = self.model.rotor
        known: ShaftSpeed | None = None if before is None else before.solution
        if before is None or known is None or known.model.modes == 0:
            # Static shapes may be so far off that another whirl is nearer to theirs.
            speed, value, load, work = self._looked_for()
        else:
            speed, value, work = float(before.value), known.whirl.value, 0
            load = self.model.seen(known.model.nodal(known.whirl.right))
        whirl, more = synchronous_whirl(rotor, self.films, speed, value, load)
        found = whirl.at.speed
        if not self.speeds[0] <= found <= self.speeds[-1]:
            raise RotorfilmError(f"the critical speed {found:.6g} rad/s is not in shaft.speeds")
        return Found(found, {self.unit: work + more, **made}, ShaftSpeed(whirl=whirl, model=self.model))

    def _looked_for(self) -> tuple[float, complex, np.ndarray, int]:
        """Return speed, eigenvalue and shape of the first critical speed, and how many speeds were looked at."""
        rotor = self.model.rotor
        found = critical_speeds(rotor, self.films.reactions, self.speeds)
        if not found:
            raise RotorfilmError(
                f"no critical speed in shaft.speeds, {self.speeds[0]:.6g} to {self.speeds[-1]:.6g} rad/s: "
                "no whirl has the frequency of the rotation there"
            )
        speed = found[0].speed
        value = speed * complex(-found[0].log_decrement / (2.0 * math.pi), 1.0)
        system = small_motion(rotor.structure, rotor_equilibrium(rotor, self.films.reactions, speed))
        start = np.random.default_rng(0).normal(size=len(system.mass)) + 0j
        value, right, _ = mode_near(system, value, start)
        return speed, value, right, len(self.speeds) + 1

    def estimate(self, found: Found, before: Found | None, tolerance: float) -> ErrorEstimate:
        """Return the change of speed by one shift of inverse iteration in elements half as long, on richer films.

        The map is its own richer film as long as its verified bound is small enough.
        """
        solution: ShaftSpeed = found.solution
        whirl, fine = solution.whirl, self.model.finer.structure
        rate = frequency_rate(self.model.rotor.structure, whirl, self.films) - 1.0
        bound = self._bound(solution, rate)
        trusted = SAFETY * bound < tolerance
        coefficients, doubt = (
            (whirl.at.coefficients, "") if trusted else rich_coefficients(self.films, whirl.at)
        )
        system = small_motion(fine, on_films(whirl.at, coefficients))
        right, left = self.model.lifted(whirl.right), self.model.lifted(whirl.left)
        steps = inverse_steps(system, whirl.value, right, left, 3)
        first, second = (-(value.imag - found.value) / rate / found.value for value, *_ in steps[1:])
        noise = _roundoff(system, steps[-1][0], *steps[-1][1:]) / abs(rate) / found.value
        error = abs(second) + noise
        if error > LARGEST:
            doubt = doubt or f"a change by {error:.0%} is too large to be linear"
        if abs(first - second) > DISAGREEMENT * abs(second) + noise:
            doubt = doubt or "two steps of inverse iteration disagree on the error"
        if found.value * (1.0 - SAFETY * error) < self.speeds[0]:
            doubt = doubt or "so near to the first of shaft.speeds that it may be below"
        method = f"inverse iteration, {len(self.model.finer.elements)} elements"
        if self.films.name and not trusted:
            method += f", {self.films.rich_name}"
        is_bound = bool(self.films.name) and self.films.bounded and (not trusted or bound > error)
        if trusted:
            error = max(error, bound)
        return ErrorEstimate(error, method, {f"steps for {self.name}": 3}, bound=is_bound, doubt=doubt)

    def _bound(self, solution: ShaftSpeed, rate: float) -> float:
        """Return the error [1] that the worst K and C within the verified bounds of the films would make."""
        whirl, structure = solution.whirl, self.model.rotor.structure
        _, slope = dynamics(small_motion(structure, whirl.at), whirl.value)
        scale = abs(whirl.left.conj() @ slope @ whirl.right)
        total = 0.0
        for name, bound in coefficient_bounds(self.films, whirl.at).items():
            rows, film = journal(structure, name), whirl.at.coefficients[name]
            worst = np.abs(film.stiffness).max() + abs(whirl.value) * np.abs(film.damping).max()
            total += bound * float(worst * np.abs(rows @ whirl.left).sum() * np.abs(rows @ whirl.right).sum())
        return total / scale / abs(rate) / whirl.at.speed

    def expected(self, done: Work) -> Work:
        """Return the linear problems of four speeds."""
        return {self.unit: 4}


def _roundoff(system: SecondOrder, value: complex, right: np.ndarray, left: np.ndarray) -> float:
    """Return what roundoff in the stiffness may make of an eigenvalue [1/s]."""
    _, slope = dynamics(system, value)
    size = float(np.linalg.norm(np.abs(left) * (np.abs(system.stiffness) @ np.abs(right))))
    return ROUNDOFF * size / float(abs(left.conj() @ slope @ right))


def shaft_ladder(scene: Scene, quantity: str) -> Ladder:
    """Return the ladder of the first critical speed of a flexible rotor.

    Raises
    ------
    InputError
        If the scene has no shaft.
    """
    if scene.shaft is None:
        raise InputError(f"shaft is required for {quantity}, got no such table")
    speeds, models = scene.shaft.speeds.build(), shaft_models(scene.shaft.build())
    levels = film_levels(scene.shaft)
    rungs = [
        ShaftRung(model=model, films=films, speeds=speeds)
        for films in levels
        for model in (models if films is levels[-1] else models[:3])
    ]
    return Ladder(
        rungs=tuple(rungs),
        unit="rad/s",
        nominal=NOMINAL,
        remarks=shaft_remarks(scene, float(speeds[-1])),
    )
