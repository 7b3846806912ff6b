"""Questions about a rotor on a squeeze-film damper: jumps, width of the orbit, what it transmits."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import cached_property
from typing import TYPE_CHECKING

import numpy as np

from ...answers import DISAGREEMENT, ISOTHERMAL, ErrorEstimate, Found, Work, WorkUnit
from ...bearings.damper import FiniteSqueeze
from ...errors import AbsentError, FilmContactError, InputError, RotorfilmError
from ...ladders import CandidateRung, Ladder
from ...model import Reaction
from ...motion.circular.branches import synchronous_orbits
from ...motion.circular.orbit_near import (
    damped_orbit,
    force_at,
    orbit_near,
    slope_at,
    transmitted,
    unbalance_at,
    unbalances,
)
from ...motion.circular.orbit_points import OrbitRotor, orbit_rotor
from ...rotors import RigidRotor
from ...scenes.counted import Counted
from ...scenes.damper.built_films import orbit_films
from ...scenes.damper.damper_films import (
    NO_RICHER,
    AnyDamperFilm,
    ConservedDamperFilm,
    lands,
    mapped_short,
    quiet,
    sprung,
)
from ...scenes.damper.damper_models import damper_models
from ...scenes.damper.damper_remarks import rotor_remarks
from ...scenes.journal.film_rung import MAP_MADE
from .conserved_peaks import passing_holes_ladder

if TYPE_CHECKING:
    from ...scenes.scene import Scene

UP, DOWN = "jump_up", "jump_down"
UNITS = {UP: "kg m", DOWN: "kg m", "transmissibility": "1", "unbalance_amplitude": "m"}
"""Quantities of a damper and their units."""


@dataclass(frozen=True, kw_only=True)
class DamperCurveRung(CandidateRung[AnyDamperFilm]):
    """One film and one model of its cage.

    Attributes
    ----------
    rotor : RigidRotor
        Centered by its springs.
    stiffness : float [N/m]
        Of the springs.
    quantity : str
    """

    rotor: RigidRotor
    stiffness: float
    quantity: str

    @property
    def is_fold(self) -> bool:
        """Whether a jump is asked for: an end of a branch of orbits."""
        return self.quantity in (UP, DOWN)

    @cached_property
    def support(self) -> Reaction:
        """Film and springs."""
        return sprung(self.film.reaction, self.stiffness)

    @cached_property
    def search(self) -> Reaction:
        """Film and springs that are quick enough for hundreds of orbits."""
        slow = isinstance(self.film, ConservedDamperFilm) or isinstance(self.film.law, FiniteSqueeze)
        return sprung(self.film.moving, self.stiffness) if slow else self.support

    @property
    def unit(self) -> WorkUnit:
        """One force of this film."""
        return WorkUnit(f"forces of {self.name}", ("forces", self.film))

    def answer(self, before: Found | None) -> Found:
        """Return the quantity; raises RotorfilmError where there is no such jump, or contact."""
        made = self.film.prepare()
        counted = Counted(self.support)
        near = None if before is None else self._from(counted, float(before.solution))
        if near is None:
            value, radius = self._searched(Counted(self.search) if self.search != self.support else counted)
            near = (value, radius) if self.search == self.support else self._from(counted, radius)
        if near is None:
            raise RotorfilmError(f"{self.name} has no orbit beside that of its map")
        return Found(near[0], {self.unit: counted.forces + counted.tangents, **made}, near[1])

    def _searched(self, reaction: Counted) -> tuple[float, float]:
        """Return quantity and radius among all orbits: the smallest stable one, or the first jump."""
        orbits = synchronous_orbits(self.rotor, reaction)
        if self.is_fold:
            folds = [fold for fold in orbits.folds if fold.upward == (self.quantity == UP)]
            if not folds:
                reach = reaction.largest_eccentricity_ratio
                why = "no orbit ends so" if orbits.folds else "one orbit at every unbalance"
                why += "" if reach >= 1.0 else f", up to {reach:.4g} of the clearance"
                raise AbsentError(f"no {self.quantity.replace('_', ' ')} of the rotor in the damper: {why}")
            return folds[0].unbalance, folds[0].eccentricity_ratio
        found = orbits.at(self.rotor.unbalance)
        if not found:
            end = "the wall" if orbits.contact_unbalance is not None else "the end of the film's range"
            raise FilmContactError(f"no orbit at this unbalance: the rotor reaches {end}")
        chosen = next((orbit for orbit in found if orbit.stable), found[0])
        amplitude = chosen.eccentricity_ratio * reaction.clearance
        value = chosen.transmissibility if self.quantity == "transmissibility" else amplitude
        return value, chosen.eccentricity_ratio

    def _from(self, counted: Counted, radius: float) -> tuple[float, float] | None:
        """Return quantity and radius of the orbit next to that of a lower rung, if there is one."""
        system = damped_orbit(self.rotor, counted)
        found = orbit_near(system, radius, None if self.is_fold else self.rotor.unbalance)
        if found is None:
            return None
        if self.quantity == "transmissibility":
            return transmitted(system, found), found
        if self.is_fold:
            return unbalance_at(system, found), found
        return found * system.clearance, found

    def estimate(self, found: Found, before: Found | None, tolerance: float) -> ErrorEstimate:
        """Return the change that one orbit of the richest film, of the same radius, would make.

        At a fold u(e) is level, so that the fold's unbalance changes by what u does at the same radius, and
        to second order by the shift of the fold; at a given unbalance the radius shifts by the defect of u
        over u'.
        """
        rich = self.film.rich
        if rich is None and not math.isfinite(self.film.bound()):
            return ErrorEstimate(math.inf, "none", doubt=NO_RICHER)
        radius = float(found.solution)
        if rich is None:
            return self._by_bound(found.value, radius)
        reach = rich.largest_eccentricity_ratio
        if radius >= reach:
            doubt = f"the orbit goes to {radius:.4g} of the clearance, the richest film to {reach:.4g}"
            return ErrorEstimate(math.inf, "none", doubt=doubt)
        change = self._fold if self.is_fold else self._orbit
        richer = damped_orbit(self.rotor, sprung(rich, self.stiffness))
        value, doubt = change(orbit_rotor(self.rotor, self.support), richer, radius)
        error = abs(value - found.value) / abs(value)
        return ErrorEstimate(
            error,
            "orbits of the richest film",
            {RICH: 4 if self.is_fold else 3, **self.film.rich_work},
            doubt=doubt,
        )

    def _by_bound(self, value: float, radius: float) -> ErrorEstimate:
        """Return what the verified error of the film's force may make of the quantity.

        It changes the unbalance of an orbit of the same radius, and so that of a fold. At a given unbalance
        it shifts the radius by that over the smallest u' on the way: near a fold that is much, and past it
        there may be no such orbit.
        """
        system, work = damped_orbit(self.rotor, self.support), {self.unit: 7}
        force = force_at(system, radius)
        film = abs(force + self.stiffness * system.clearance * radius)
        change = self.film.bound() * film / system.speed**2
        method = "verified bound of the film, propagated"
        if self.is_fold:
            return ErrorEstimate(change / value, method, work, bound=True)
        slope = slope_at(system, radius)
        ends = radius + np.array([-1.0, 1.0]) * abs(change / slope)
        inside = ends[0] > 0.0 and ends[1] < 1.0
        least = min(slope_at(system, end) / slope for end in ends) if inside else 0.0
        if least < 1.0 - DISAGREEMENT:
            doubt = "so near to a jump, or to the wall, that the error of the film may take the orbit there"
            return ErrorEstimate(abs(change / slope) / radius, method, work, doubt=doubt)
        if self.quantity == "unbalance_amplitude":
            return ErrorEstimate(abs(change / slope) / least / radius, method, work, bound=True)
        # At a given unbalance the ratio changes as the force does: along the shift, and by the film itself.
        shifted = max(abs(abs(force_at(system, end)) - abs(force)) for end in ends) / least
        return ErrorEstimate((shifted + self.film.bound() * film) / abs(force), method, work, bound=True)

    def _fold(self, own: OrbitRotor, rich: OrbitRotor, radius: float) -> tuple[float, str]:
        """Return the unbalance of the rich film's fold by a parabola through three orbits about the other."""
        near = radius + np.array([-1.0, 0.0, 1.0]) * 0.02 * min(radius, 1.0 - radius)
        low, middle, high = unbalances(rich, near)
        bend, slope = low - 2.0 * middle + high, 0.5 * (high - low)
        cheap = unbalances(own, near)
        own_bend = float(cheap[0] - 2.0 * cheap[1] + cheap[2])
        moved = float(np.clip(-slope / own_bend, -10.0, 10.0)) if own_bend else 0.0
        value = float(middle + slope * moved + 0.5 * bend * moved**2)
        doubt = "the curvatures of both films disagree on the error: not linear"
        matters = abs(value - middle) > DISAGREEMENT * abs(value - cheap[1])
        return value, doubt if matters and abs(bend - own_bend) > DISAGREEMENT * abs(own_bend) else ""

    def _orbit(self, own: OrbitRotor, rich: OrbitRotor, radius: float) -> tuple[float, str]:
        """Return the quantity at the rotor's unbalance by two secant steps with the richest film."""
        target = self.rotor.unbalance
        slopes = [slope_at(system, radius) for system in (rich, own)]
        steps = [(target - unbalance_at(rich, radius)) / slope for slope in slopes]
        apart = abs(steps[0] - steps[1]) / max(abs(step) for step in steps)
        new = float(np.clip(radius + steps[0], 1e-9, 1.0 - 1e-9))
        again = (target - unbalance_at(rich, new)) / slopes[0]
        doubt = f"the slopes of both films disagree on the error by {apart:.0%}: not linear"
        final = new + again
        value = transmitted(rich, new) if self.quantity == "transmissibility" else final * own.clearance
        return value, doubt if apart > DISAGREEMENT else ""

    def expected(self, done: Work) -> Work:
        """Return as many forces as a lower rung took."""
        return {self.unit: sum(number for unit, number in done.items() if unit != MAP_MADE)}


RICH = WorkUnit("forces of the richest film")


@quiet()
def damper_ladder(scene: Scene, quantity: str) -> Ladder:
    """Return the ladder of a quantity of a rotor on a damper.

    Raises
    ------
    InputError
        If the scene has no rotor, no unbalance, no speed or no operation.
    """
    for table in ("damper", "rigid_rotor"):
        if getattr(scene, table) is None:
            raise InputError(f"{table} is required for {quantity}, got no such table")
    assert scene.damper is not None  # checked by the above
    rotor = damper_models(scene).rotor
    if quantity in (UP, DOWN):
        rotor = replace(rotor, unbalance=1e-9 * rotor.mass * scene.damper.clearance)
    elif rotor.unbalance <= 0.0:
        raise InputError(f"rigid_rotor.unbalance must be positive for {quantity}, got 0.0")
    stiffness, supply = scene.damper.stiffness, scene.damper.supply
    if supply is not None and not supply.turns_alike and quantity not in (UP, DOWN):
        return passing_holes_ladder(scene, quantity, UNITS[quantity])
    rungs = tuple(
        DamperCurveRung(film=film, rotor=rotor, stiffness=stiffness, quantity=quantity)
        for film in orbit_films(scene.damper, rotor)
        if not _endless(film, quantity, is_named=scene.damper.film is not None)
    )
    units = {rung.unit: _one(rung, scene.speed) for rung in rungs}
    asked, count = replace(rotor, unbalance=0.0) if quantity in (UP, DOWN) else rotor, lands(scene.damper)
    return Ladder(
        rungs=rungs,
        unit=UNITS[quantity],
        units=units,
        remarks=rotor_remarks(
            scene.damper,
            mapped_short(scene.damper),
            stiffness / count,
            replace(asked, mass=asked.mass / count, unbalance=asked.unbalance / count),
            scene.lubricant.properties,
            steady=quantity not in (UP, DOWN),
        ),
        within=ISOTHERMAL,
    )


def _endless(film: AnyDamperFilm, quantity: str, *, is_named: bool) -> bool:
    """Return whether hundreds of orbits would take minutes: a fed film of finite length has no map.

    One that the scene names is the only rung there is.
    """
    slow = isinstance(film.law, FiniteSqueeze) and film.shape.is_fed
    return slow and not is_named and quantity in (UP, DOWN)


def _one(rung: DamperCurveRung, speed: float) -> Callable[[], object]:
    def force() -> object:
        radius = 0.5 * rung.support.clearance
        return rung.support.force([radius, 0.0], [0.0, speed * radius], speed)

    return force
