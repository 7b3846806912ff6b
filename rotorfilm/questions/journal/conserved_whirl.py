"""Whirl thresholds and motions on a film that conserves its oil, by K and C at the frequency of the whirl."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING, Any

import numpy as np

from ...answers import Found
from ...bearings.journal import JFOFilm
from ...ladders import Ladder
from ...linear import whirl_threshold
from ...linear.speed_events import secant_speed
from ...model import Array
from ...results import Coefficients
from .conserved_rungs import ConservedRung, conserved_films
from .ruptured_rungs import Change, Rupture, rest_on, with_rupture, within_of
from .whirl_rungs import AROUND, least_stable, required_rotor

if TYPE_CHECKING:
    from ...scenes.scene import Scene

STEP, NEAR, FARTHEST, MOST = 0.01, 1e-5, 0.25, 25
"""Relative change of speed by which the search gets its first slope, at which it ends, the largest of a step,
and most steps."""

WHIRLS, SAME = 40, 1e-9
"""Most frequencies at which K and C are taken, and the relative change at which the whirl has that one."""


def whirl_growth(film: JFOFilm, position: Array, speed: float, mass: float) -> float:
    """Return the growth rate [1/s] of the least stable whirl of a rigid rotor, K and C at its frequency.

    Exact where it vanishes: then K(s) is that of the whirl itself.
    """
    frequency, value = 0.5 * abs(speed), 0j
    for _ in range(WHIRLS):
        value = least_stable(_matrix(film.coefficients(position, speed, frequency), mass))[0]
        before, frequency = frequency, max(abs(value.imag), 1e-3 * abs(speed))
        if abs(frequency - before) <= SAME * frequency:
            break
    return float(value.real)


def _matrix(found: Coefficients, mass: float) -> Array:
    zero, one = np.zeros((2, 2)), np.eye(2)
    return np.block([[zero, one], [-found.stiffness / mass, -found.damping / mass]])


def conserved_threshold(film: JFOFilm, load: tuple[float, float], mass: float, start: float) -> float:
    """Return the speed at which the whirl of a rigid rotor begins [rad/s], by secants from another one.

    Raises
    ------
    ConvergenceError
        If none is found, as where the rotor is stable.
    """

    def growth(speed: float) -> tuple[float, None]:
        rest = rest_on(film, load, speed)
        return whirl_growth(rest.film, rest.at.position, speed, mass), None

    slope = (growth(start * (1.0 + STEP))[0] - growth(start)[0]) / (STEP * start)
    return float(secant_speed(growth, start, slope, near=NEAR, farthest=FARTHEST, most=MOST).speed)


def with_conserved_whirl(scene: Scene, quantity: str, ruptured: Callable[[], Ladder]) -> Ladder:
    """Return the ladder of the whirl threshold, with what conserves its oil.

    Parameters
    ----------
    scene : Scene
    quantity : str
    ruptured : callable
        Returns the ladder by Reynolds rupture.
    """
    mass, load = required_rotor(scene, quantity).mass, scene.static_load
    bearing, table = scene.journal_bearing, scene.journal
    assert table is not None  # whose question it is

    def start(before: Found | None) -> float:
        if before is not None:
            return float(before.value)
        found = whirl_threshold(Rupture(bearing, load, scene.speed).films[-1][0], load, mass).speed
        return scene.speed if found is None else found

    def above() -> tuple[ConservedRung, ...]:
        def value(film: JFOFilm, before: Found | None) -> float:
            return conserved_threshold(film, load, mass, start(before))

        return tuple(
            ConservedRung(film=film, value=value, distance=relative) for film in conserved_films(scene)
        )

    def change(found: Found) -> Change:
        reynolds, conserved = Rupture(bearing, load, found.value).films[-1]
        around = found.value / AROUND, found.value * AROUND
        own = whirl_threshold(reynolds, load, mass, around).speed or found.value
        return Change(own, conserved_threshold(conserved, load, mass, own), relative=True)

    if table.conserves:
        rungs = above()
        return Ladder(rungs=rungs, unit="rad/s", remarks=scene.film_remarks, within=within_of(scene))
    ladder = ruptured()
    # On an oil the error by heat of a threshold by conserved oil is not known yet.
    return with_rupture(scene, ladder, change, relative, None if bearing.is_warming else above)


def with_moved_rupture(
    scene: Scene,
    ladder: Ladder,
    linear: Callable[[Any], float],
    distance: Callable[[float, float], float],
    *,
    scaled: bool,
) -> Ladder:
    """Return the ladder of a motion with what the conservation of oil changes in the linear one.

    Parameters
    ----------
    scene : Scene
    ladder : Ladder
    linear : callable
        Takes a film as a candidate, and returns the quantity in linear motion about its rest.
    distance : callable
        As of `RupturedRung`.
    scaled : bool
        Whether the share counts, rather than the difference.
    """
    rupture = Rupture(scene.journal_bearing, scene.static_load, scene.speed)

    def change(found: Found) -> Change:
        return rupture.change(lambda rest: linear(rest.frozen), relative=scaled)

    return with_rupture(scene, ladder, change, distance)


def relative(value: float, better: float) -> float:
    """Return by which share of the better one a value is off."""
    return abs(better - value) / abs(better)
