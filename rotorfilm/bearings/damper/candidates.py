"""The films of a squeeze-film damper as rungs: which can answer a scene, and what is richer."""

from __future__ import annotations

import math
import warnings
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass, replace
from functools import cached_property
from typing import TYPE_CHECKING, Any

import numpy as np

from ...analysis.circular_orbits import synchronous_orbits
from ...core.answers import WorkUnit
from ...core.errors import InputError, RotorfilmError, ValidityWarning
from ...core.port import PlanarReaction
from ...core.results import CircularOrbit
from ...rotors import RigidRotor
from ...scenes.families import messages, remarks_of
from ...scenes.film_rungs import MAP_MADE
from ...scenes.oil_film_tables import ATMOSPHERE
from ...scenes.shared_tables import Lubricant
from .. import damper as dampers
from ..assemblies import with_springs
from ..films.geometry import FullFilm
from .table import DamperTable

if TYPE_CHECKING:
    pass

DEFECT_CELLS = (10, 20)
"""Cells of the map of finite length that defects are sampled with: within 5e-4 of the force, in a second."""

TOP_BOUNDS = {dampers.FiniteSqueeze: 1e-6, dampers.FiniteMapSqueeze: 3e-4}
"""Verified errors of the force of the richest films: docs/accuracy.md."""

RICH_MADE = WorkUnit("maps of the film of finite length made for estimates")
"""WorkUnit of the work of making the map that defects are sampled with."""

NO_RICHER = (
    "no film of finite length is there for a cavitated damper with feed, so that nobody knows how far the "
    "short one is off"
)


@dataclass(frozen=True)
class DamperFilm:
    """A film of a damper that may answer; the dampers are made when they are needed, for a map takes seconds.

    Attributes
    ----------
    name : str
    shape : PorousDamper
        The damper with a short film, and the cage that this rung knows.
    law : SqueezeLaw or None
        The film; None for the one of `conserved`.
    rich_shape : PorousDamper
        The damper with a short film and its whole cage.
    rich_law : SqueezeLaw or None
        The film that the defect is sampled with; None where there is none.
    prior : float [1]
        Order of magnitude of the error of its force; 0 if unknown.
    conserved : JFODamper or None
        The damper without springs that conserves its oil, where the scene has its supply: it is richer than
        all of these, and judged itself by one on twice as fine a grid.
    frequency : float or None [rad/s]
        Frequency with which the rotor whirls, of a film between seals or with inertia: what the richest one
        leaves out is estimated at that, and has no bound.
    """

    name: str
    shape: dampers.PorousDamper
    law: dampers.SqueezeLaw | None
    rich_shape: dampers.PorousDamper
    rich_law: dampers.SqueezeLaw | None
    prior: float
    conserved: dampers.JFODamper | None = None
    frequency: float | None = None

    @property
    def makes_map(self) -> bool:
        """Whether the damper is made with a map, which takes seconds."""
        return isinstance(self.law, dampers.FiniteMapSqueeze)

    @property
    def bound(self) -> float:
        """Verified error of its force [1], the same everywhere; infinite where there is none."""
        judged = self.conserved is not None or self.frequency is not None
        return math.inf if judged else TOP_BOUNDS.get(type(self.law), math.inf)

    def prepare(self) -> dict[WorkUnit, int]:
        """Return the work of making the damper, which its first use makes."""
        return {MAP_MADE: 1} if self.makes_map else {}

    @property
    def tangents(self) -> WorkUnit:
        """One force of this film with derivatives."""
        return WorkUnit(f"tangents of {self.name}", ("tangents", self))

    @property
    def rich_work(self) -> dict[WorkUnit, int]:
        """Work of making the richer one."""
        made = self.conserved is None and isinstance(self.rich_law, dampers.FiniteMapSqueeze)
        return {RICH_MADE: 1} if made else {}

    @cached_property
    def reaction(self) -> Any:
        """The damper with its film; one that conserves its oil, on circular orbits."""
        if self.law is not None:
            return with_changes(self.shape, film=self.law)
        assert self.conserved is not None
        return dampers.ExtrapolatedDamper(damper=self.conserved)

    @cached_property
    def rich(self) -> dampers.PorousDamper | dampers.ExtrapolatedDamper | dampers.JudgedDamper | None:
        """The damper with the richer film, and what the richest of all leaves out."""
        if self.conserved is not None:
            around, along = self.conserved.cells
            finer = self.conserved if self.law else replace(self.conserved, cells=(2 * around, 2 * along))
            return dampers.ExtrapolatedDamper(damper=finer)
        if self.rich_law is None:
            return None
        damper = with_changes(self.rich_shape, film=self.rich_law)
        return (
            damper
            if self.frequency is None
            else dampers.JudgedDamper(damper=damper, frequency=self.frequency)
        )

    @cached_property
    def moving(self) -> dampers.PorousDamper | dampers.ExtrapolatedDamper:
        """The damper on the map of its film, where it has one: a motion takes thousands of forces.

        One that conserves its oil on half as many lines and cells, for searches through hundreds of orbits.
        """
        if self.law is None:
            return dampers.ExtrapolatedDamper(damper=self.reaction.coarser)
        if self.frequency is None:
            return with_changes(self.shape, film=_mapped(self.law, self.shape))
        return with_changes(
            self.shape, film=dampers.MapSqueeze() if isinstance(self.law, dampers.ShortSqueeze) else self.law
        )

    @cached_property
    def rich_moving(self) -> Any:
        """The richer damper on its map."""
        if self.frequency is not None:
            return self.rich
        if self.rich_law is None:
            return None
        return with_changes(self.rich_shape, film=_mapped(self.rich_law, self.rich_shape))


def damper_films(table: DamperTable) -> tuple[DamperFilm, ...]:
    """Return the films that can answer for an orbit, the cheapest first; one that a scene names alone.

    With a supply the short film, judged by the film that conserves its oil, and that film, which takes less
    time than the map of one of finite length.

    Raises
    ------
    InputError
        If the supply differs around the damper.
    """
    plain = plain_films(table)
    if table.supply is None:
        return plain
    if not table.supply.turns_alike:
        raise InputError(
            "supply.feed_holes must be left out for a question about jumps, as they make orbits unsteady: "
            f"ask for unbalance_amplitude, or run the scene, got {table.supply.feed_holes!r}"
        )
    damper = replace(table.conserved(table.supply), stiffness=0.0)
    judged = [replace(film, conserved=damper) for film in plain]
    if table.film is not None:
        return tuple(judged)
    quick = [film for film in judged if not film.makes_map]
    own = replace(plain[0], name="conserved oil", law=None, rich_law=None, prior=0.0, conserved=damper)
    return (*quick, own)


def plain_films(table: DamperTable) -> tuple[DamperFilm, ...]:
    """Return the films that know no supply, the cheapest first; one that a scene names alone.

    Solid cage, thin layer, Darcy's layer with the short film, then the film of finite length. A film with
    feed keeps its cage, through which it is fed.
    """
    shape, top = _short(table), richest_law(_short(table))
    named = table.film
    found = _free(shape, top) if named is None else [(type(named).__name__, shape, named, 0.0)]
    rich = dampers.FiniteMapSqueeze(cells=DEFECT_CELLS) if isinstance(top, dampers.FiniteMapSqueeze) else top
    return tuple(
        DamperFilm(name, own, law, shape, None if law == top else rich, prior)
        for name, own, law, prior in found
    )


def _short(table: DamperTable) -> dampers.PorousDamper:
    """Return the damper of a scene with the short film, which takes no time to make."""
    with quiet():
        return replace(table, film=None).build()


def _free(
    shape: dampers.PorousDamper, top: dampers.SqueezeLaw | None
) -> list[tuple[str, dampers.PorousDamper, dampers.SqueezeLaw, float]]:
    short = dampers.ShortSqueeze()
    slim = 0.02 * min(shape.slenderness**2, 1.0)
    rungs: list[tuple[str, dampers.PorousDamper, dampers.SqueezeLaw, float]] = []
    if shape.cage is not None and not shape.is_fed:
        rungs.append(("short film, solid cage", with_changes(shape, cage=None), short, slim))
        if not shape.cage.thin:
            try:
                thin = with_changes(shape, cage=replace(shape.cage, thin=True))
                rungs.append(("short film, thin layer", thin, short, slim))
            except RotorfilmError:
                pass
    own = "" if shape.cage is None else ", thin layer" if shape.cage.thin else ", Darcy's layer"
    rungs.append((f"short film{own}", shape, short, slim))
    return rungs if top is None else [*rungs, (f"finite film{own}", shape, top, 0.0)]


def richest_law(damper: dampers.PorousDamper) -> dampers.SqueezeLaw | None:
    """Return the film of finite length of a damper; None for a cavitated one with feed, which has none."""
    full = isinstance(damper.extent, FullFilm)
    if damper.is_fed and not full:
        return None
    return dampers.FiniteSqueeze() if full else dampers.FiniteMapSqueeze()


def _mapped(law: dampers.SqueezeLaw, shape: dampers.PorousDamper) -> dampers.SqueezeLaw:
    maps: dict[type, dampers.SqueezeLaw] = {
        dampers.ShortSqueeze: dampers.MapSqueeze(),
        dampers.FiniteSqueeze: dampers.FiniteMapSqueeze(),
    }
    return law if shape.is_fed else maps.get(type(law), law)


def mapped_short(table: DamperTable) -> dampers.PorousDamper:
    """Return one land of the damper with the short film, on its map where it has one; see `lands`."""
    shape = with_changes(_short(table), viscosity=(1.0 - table.air_fraction) * table.viscosity)
    return shape if table.needs_length else with_changes(shape, film=_mapped(dampers.ShortSqueeze(), shape))


def lands(table: DamperTable) -> int:
    """Return how many films the damper has side by side: two beside a groove in its middle."""
    return 2 if table.supply is not None and table.supply.circumferential_groove is not None else 1


def with_changes(damper: dampers.PorousDamper, **changes: object) -> dampers.PorousDamper:
    """Return the damper with other fields, without the warning of a short film: its error is estimated."""
    with quiet():
        return replace(damper, **changes)  # type: ignore[arg-type]


@contextmanager
def quiet() -> Iterator[None]:
    """Leave out what a film warns of when it is made: a ladder estimates its error."""
    with warnings.catch_warnings(action="ignore", category=ValidityWarning):
        yield


def on_springs(
    damper: dampers.PorousDamper | dampers.ExtrapolatedDamper | dampers.JudgedDamper, stiffness: float
) -> PlanarReaction:
    """Return the damper with springs of the stiffness [N/m], if there are some."""
    return with_springs(damper, stiffness) if stiffness else damper


# The films of a damper with seals or inertia as rungs: without and with inertia, short and finite.
#
# Each is judged by orbits and motions of the richest film beside what that leaves out itself: the
# second order of the inertia, the edge of a ruptured film that it moves, oil that runs around between
# seals.


NO_INERTIA = ", no inertia"


def orbit_films(table: DamperTable, rotor: RigidRotor) -> tuple[DamperFilm, ...]:
    """Return the films that can answer for the orbits of a rotor at one speed, the cheapest first.

    Raises
    ------
    InputError
        If the rotor is held off the center, the supply differs around the damper, or the inertia of the oil
        is no model at this speed.
    """
    if any(table.offset):
        raise InputError(
            "offset must be left out for a question about circular orbits, which are centered: a run, or "
            f"peak_displacement, has it, got {table.offset!r}"
        )
    return built_films(table, rotor.profile.speeds[0]) if table.is_built else damper_films(table)


@quiet()
def built_films(table: DamperTable, speed: float) -> tuple[DamperFilm, ...]:
    """Return the films of a damper with seals or inertia, the cheapest first; one that a scene names alone.

    Parameters
    ----------
    table : DamperTable
    speed : float [rad/s]

    Raises
    ------
    InputError
        If the inertia of the oil is no model at this speed.
    """
    whole = replace(table, film=None).build()
    whole.require_range(speed)
    laws = [law for law in _laws(table) if table.film is None] or [_named(table)]
    shapes = {NO_INERTIA: with_changes(whole, density=0.0), "": whole} if table.density else {"": whole}
    slim, at = 0.02 * min(whole.slenderness**2, 1.0), abs(speed)
    priors = {name: slim if isinstance(law, dampers.ShortSqueeze) else 0.0 for name, law in laws}
    return tuple(
        DamperFilm(f"{name}{inertia}", shape, law, whole, _richest(table, law), priors[name], frequency=at)
        for name, law in laws
        for inertia, shape in shapes.items()
        if table.film is None or not inertia
    )


def _laws(table: DamperTable) -> list[tuple[str, dampers.SqueezeLaw]]:
    short: list[tuple[str, dampers.SqueezeLaw]] = (
        [] if table.needs_length else [("short film", dampers.ShortSqueeze())]
    )
    if isinstance(table.extent, FullFilm):
        return [*short, ("finite film", dampers.FiniteSqueeze())]
    return short if table.seals is not None else [*short, ("finite film", dampers.FiniteMapSqueeze())]


def _named(table: DamperTable) -> tuple[str, dampers.SqueezeLaw]:
    law = table.film or dampers.ShortSqueeze()
    return type(law).__name__, law


def _richest(table: DamperTable, own: dampers.SqueezeLaw) -> dampers.SqueezeLaw:
    if isinstance(table.extent, FullFilm):
        return dampers.FiniteSqueeze()
    if table.seals is not None:
        return dampers.ShortSqueeze()
    return own if isinstance(own, dampers.FiniteMapSqueeze) else dampers.FiniteMapSqueeze(cells=DEFECT_CELLS)


# What every squeeze film of a damper leaves out, judged by dimensionless numbers.


EDDIES = (0.0, 500.0, 1000.0, 2000.0, 5000.0, 10000.0), (0.0, 0.01, 0.03, 0.08, 0.26, 0.58)
"""Speed R c/nu of a whirl, and what eddies of the squeeze flow add to the force: orbit 0.4, L/D 0.5."""


def damper_numbers(
    damper: dampers.PorousDamper, oil: Lubricant, mass: float, speed: float, eccentricity_ratio: float
) -> dict[str, float]:
    """Return the dimensionless numbers of a film whose rotor [kg] whirls on a circle at a speed [rad/s].

    Returns
    -------
    dict of str to float
        eccentricity_ratio : of the circle.
        inertia : pressure of the film's inertia over the viscous one, a tenth of `reynolds`, the squeeze
        Reynolds number speed c^2/nu.
        added_mass : mass with which the film follows the rotor / mass of the rotor.
        peclet : speed c^2/diffusivity, heat carried along over heat conducted across the film.
        warming [K] : rise of temperature, of the oil squeezed out (Peclet number above 1) or between cold
        walls; thinning : relative loss of viscosity by that.
        pressure : largest pressure of the film over the ambient one: a full film carries as much tension; and
        the part of a cavity that ambient pressure fills again within a turn is the inverse of this.
        compression : largest pressure over the bulk modulus.
        squeezed : Reynolds number of the flow around the film that the orbit drives, eccentricity ratio times
        speed R c/nu; turbulence : what eddies of that flow add to the force, of an orbit of 0.4 and L/D 0.5.

    Notes
    -----
    With a parabolic profile the momentum of the flow is 6/5 of that of its mean, so that the pressure
    gradient is 12 viscosity/h^2 (1 + i Re/10) times the mean velocity, Re = speed h^2/nu. The film's power
    heats what is squeezed out, 2 radius length e speed, or, if it stays, the middle of a slab between cold
    walls, by power/volume c^2/(8 conductivity). The pressure is that of the short film in its middle.
    """
    R, L, c, omega = damper.radius, damper.length, damper.clearance, abs(speed)
    e = eccentricity_ratio * c
    volumetric = oil.density * oil.heat_capacity
    tangential = float(damper.force([e, 0.0], [0.0, omega * e], omega)[1])
    inertia = omega * c**2 * oil.density / damper.viscosity / 10.0
    power = -tangential * omega * e
    whirled = 10.0 * inertia * R / c
    peclet = omega * c**2 * volumetric / oil.conductivity
    adiabatic = power / (volumetric * 2.0 * R * L * e * omega)
    conducted = power * c / (2.0 * math.pi * R * L * 8.0 * oil.conductivity)
    warming = adiabatic if peclet > 1.0 else min(adiabatic, conducted)
    largest = largest_pressure(damper, omega, eccentricity_ratio)
    return {
        "eccentricity_ratio": eccentricity_ratio,
        "inertia": inertia,
        "reynolds": 10.0 * inertia,
        "squeezed": eccentricity_ratio * whirled,
        "turbulence": float(np.interp(whirled, *EDDIES)),
        "added_mass": inertia * -tangential / (omega**2 * e * mass),
        "peclet": peclet,
        "warming": warming,
        "thinning": -math.expm1(-oil.thinning * warming),
        "pressure": largest / ATMOSPHERE,
        "compression": largest / oil.bulk_modulus,
    }


def largest_pressure(damper: dampers.PorousDamper, speed: float, eccentricity_ratio: float) -> float:
    """Return the largest pressure [Pa] of a short film on a circular orbit, in the middle of its length.

    (3/2) viscosity (L/c)^2 speed max of eps sin(theta) G(h): the parabola of a film without flow around.
    Seals raise it as they do the damping.
    """
    theta = np.linspace(0.0, math.pi, 721)
    h = 1.0 + eccentricity_ratio * np.cos(theta)
    modes = dampers.layer_modes(damper.layer)
    G = modes.weight @ (1.0 / (h**3 + modes.leak[:, None]))
    source = eccentricity_ratio * speed * np.sin(theta)
    scale = 1.5 * damper.viscosity * (damper.length / damper.clearance) ** 2
    if damper.seals is not None:
        leak = damper.squeeze_case.end_leak
        scale *= (
            dampers.land_share(damper.slenderness, leak).real
            / dampers.land_share(damper.slenderness, math.inf).real
        )
    return scale * float(np.max(source * G))


def damper_remarks(
    damper: dampers.PorousDamper, oil: Lubricant, mass: float, speed: float, eccentricity_ratio: float
) -> tuple[str, ...]:
    """Return the neglected effects that matter, one line each, for an orbit of an eccentricity ratio."""
    numbers = damper_numbers(damper, oil, mass, speed, eccentricity_ratio)
    ruptures = "damper_full" if isinstance(damper.extent, FullFilm) else "damper_ruptured"
    inertia = () if damper.has_inertia else ("damper_inertia",)
    return messages(remarks_of("hot", *inertia, "damper", ruptures), numbers)


# What a question about a damper leaves open: which of several orbits, and what the films leave out.


MIDDLING = 0.5
"""Eccentricity ratio of an orbit for the checks of a question that names no unbalance."""


def built_remarks(
    table: DamperTable, damper: dampers.PorousDamper, speed: float, eccentricity_ratio: float
) -> tuple[str, ...]:
    """Return the remarks on seals, inertia and air, for an orbit at a speed [rad/s]."""
    limit = (dampers.FULL_LIMITS if isinstance(damper.extent, FullFilm) else dampers.RUPTURED_LIMITS)[0]
    reynolds = damper.reynolds_number(speed)
    numbers = {"reynolds": reynolds, "limit": limit, "beyond": reynolds / limit}
    told = ["damper_fast"] if damper.has_inertia else []
    if table.seals is not None:
        share = dampers.land_share(damper.slenderness, damper.squeeze_case.end_leak).real
        numbers["sealing"] = share / dampers.land_share(damper.slenderness, math.inf).real
        told.append("damper_seals")
    numbers["air_fraction"], numbers["feed_squeeze"] = table.air_fraction, math.inf
    if table.feed_flow is not None and speed and eccentricity_ratio:
        amplitude = eccentricity_ratio * table.clearance
        numbers["feed_squeeze"] = dampers.feed_squeeze_number(
            damper, flow=table.feed_flow, amplitude=amplitude, frequency=abs(speed)
        )
    return messages(remarks_of(*told, "damper_air"), numbers)


def rotor_remarks(
    table: DamperTable,
    damper: dampers.PorousDamper,
    stiffness: float,
    rotor: RigidRotor,
    oil: Lubricant,
    *,
    steady: bool,
) -> tuple[str, ...]:
    """Return the remarks on a rotor in a damper.

    Parameters
    ----------
    table : DamperTable
    damper : PorousDamper
        Damper with a film that is quick enough for hundreds of orbits.
    stiffness : float [N/m]
        Stiffness of its springs.
    rotor : RigidRotor
        Rotor with the unbalance in question, 0 if that is what is asked for.
    oil : Lubricant
    steady : bool
        Whether its orbit is asked for, so that it matters how many there are.
    """
    fastest = max((abs(speed) for speed in rotor.profile.speeds), default=0.0)
    found = _orbits(damper, stiffness, replace(rotor, speed=fastest))
    chosen = _smallest_stable(found)
    reach = MIDDLING if chosen is None else chosen.eccentricity_ratio
    physics = damper_remarks(damper, oil, rotor.mass, fastest, reach)
    built = built_remarks(table, damper, fastest, reach)
    return (*(_which(found) if steady else ()), *built, *physics)


def _orbits(damper: dampers.PorousDamper, stiffness: float, rotor: RigidRotor) -> tuple[CircularOrbit, ...]:
    """Return the orbits in the short film; none where that takes seconds, a cavitated film with feed."""
    slow = damper.is_fed and not isinstance(damper.extent, FullFilm)
    if slow or not rotor.unbalance:
        return ()
    return synchronous_orbits(rotor, on_springs(damper, stiffness)).at(rotor.unbalance)


def _smallest_stable(found: tuple[CircularOrbit, ...]) -> CircularOrbit | None:
    return next((orbit for orbit in found if orbit.stable), next(iter(found), None))


def _which(found: tuple[CircularOrbit, ...]) -> tuple[str, ...]:
    if len(found) < 2:
        return ()
    shown = ", ".join(
        f"{orbit.eccentricity_ratio:.3g} ({'stable' if orbit.stable else 'unstable'})" for orbit in found
    )
    return (
        f"{len(found)} orbits at this unbalance, of eccentricity ratios about {shown}: the answer is the "
        "smallest stable one, on which a rotor is whose unbalance grew; a blow, or an unbalance that was "
        "larger before, may have it on another",
    )
