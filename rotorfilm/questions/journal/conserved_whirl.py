"""Whirl thresholds and motions on a film that conserves its oil, by K and C at the frequency of the whirl."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING, Any

from ...answers import Found
from ...bearings.journal import JFOFilm
from ...ladders import Ladder, relative_change
from ...linear import whirl_threshold
from ...scenes.journal.solve_journal import conserved_threshold
from .conserved_rungs import ConservedRung, conserved_films
from .ruptured_rungs import Change, RuptureChange, with_rupture, within_of
from .whirl_rungs import AROUND, required_rotor

if TYPE_CHECKING:
    from ...scenes.scene import Scene


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
        found = whirl_threshold(RuptureChange(bearing, load, scene.speed).films[-1][0], load, mass).speed
        return scene.speed if found is None else found

    def above() -> tuple[ConservedRung, ...]:
        def value(film: JFOFilm, before: Found | None) -> float:
            return conserved_threshold(film, load, mass, start(before))

        return tuple(
            ConservedRung(film=film, value=value, distance=relative_change) for film in conserved_films(scene)
        )

    def change(found: Found) -> Change:
        reynolds, conserved = RuptureChange(bearing, load, found.value).films[-1]
        around = found.value / AROUND, found.value * AROUND
        own = whirl_threshold(reynolds, load, mass, around).speed or found.value
        return Change(own, conserved_threshold(conserved, load, mass, own), relative=True)

    if table.conserves:
        rungs = above()
        return Ladder(rungs=rungs, unit="rad/s", remarks=scene.film_remarks, within=within_of(scene))
    ladder = ruptured()
    # On an oil the error by heat of a threshold by conserved oil is not known yet.
    return with_rupture(scene, ladder, change, relative_change, None if bearing.is_warming else above)


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
    rupture = RuptureChange(scene.journal_bearing, scene.static_load, scene.speed)

    def change(found: Found) -> Change:
        return rupture.change(lambda rest: linear(rest.frozen), relative=scaled)

    return with_rupture(scene, ladder, change, distance)
