"""Whirl thresholds and motions on a film that conserves its oil, by K and C at the frequency of the whirl."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING, Any

import numpy as np
from scipy.optimize import brentq

from ...answers import Found
from ...bearings.journal import JFOFilm
from ...errors import AbsentError
from ...ladders import Ladder
from ...linear import whirl_threshold
from ...model import Array
from ...results import Coefficients
from .conserved_rungs import ConservedRung, conserved_films
from .ruptured_rungs import Change, Rupture, rest_on, with_rupture, within_of
from .whirl_rungs import AROUND, least_stable, required_rotor

if TYPE_CHECKING:
    from ...scenes.scene import Scene

STEP, NEAR, MOST = 1.1, 1e-4, 30
"""Factor of the speed between two that are looked at for a border, relative change at which it is found, and
most looks. K and C jump a little with the cells of the cavity: a border between two speeds always ends."""

WHIRLS, SAME = 60, 1e-6
"""Most frequencies at which K and C are taken, and the relative change at which the whirl has that one."""


def whirl_growth(film: JFOFilm, position: Array, speed: float, mass: float) -> float:
    """Return the growth rate [1/s] of the least stable whirl of a rigid rotor, K and C at its frequency.

    Exact where it vanishes: then K(s) is that of the whirl itself.
    """
    frequency, value = 0.5 * abs(speed), 0j
    for _ in range(WHIRLS):
        value = least_stable(_matrix(film.coefficients(position, speed, frequency), mass))[0]
        own = max(abs(value.imag), 1e-3 * abs(speed))
        if abs(own - frequency) <= SAME * frequency:
            break
        frequency = 0.5 * (frequency + own)  # own alone may go round in a circle
    return float(value.real)


def _matrix(found: Coefficients, mass: float) -> Array:
    zero, one = np.zeros((2, 2)), np.eye(2)
    return np.block([[zero, one], [-found.stiffness / mass, -found.damping / mass]])


def conserved_threshold(film: JFOFilm, load: tuple[float, float], mass: float, start: float) -> float:
    """Return the speed at which the whirl of a rigid rotor begins [rad/s], the nearest to another one.

    Raises
    ------
    AbsentError
        If there is none within some 17 times that one.
    """

    def growth(speed: float) -> float:
        rest = rest_on(film, load, speed)
        return whirl_growth(rest.film, rest.at.position, speed, mass)

    speed, own = start, growth(start)
    factor = STEP if own < 0.0 else 1.0 / STEP
    for _ in range(MOST):
        last, speed = speed, speed * factor
        if (growth(speed) < 0.0) is not (own < 0.0):
            return float(brentq(growth, min(last, speed), max(last, speed), rtol=NEAR))
    raise AbsentError(
        f"no threshold: none from {start:.6g} to {speed:.6g} rad/s on a film that conserves its oil"
    )


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
