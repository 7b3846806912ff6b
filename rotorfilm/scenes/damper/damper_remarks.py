"""What a question about a damper leaves open: which of several orbits, and what the films leave out."""

from __future__ import annotations

import math
from dataclasses import replace

from ...bearings.damper import FULL_LIMITS, RUPTURED_LIMITS, PorousDamper, feed_squeeze_number, land_share
from ...bearings.films.cavitation import FullFilm
from ...motion.circular.branches import synchronous_orbits
from ...results import CircularOrbit
from ...rotors import RigidRotor
from ..lubricant_table import Lubricant
from ..remarks import Remark, said
from .damper_films import sprung
from .damper_ranges import damper_remarks
from .damper_table import DamperTable

MIDDLING = 0.5
"""Eccentricity ratio of an orbit for the checks of a question that names no unbalance."""


AIR = (
    Remark(
        "feed_squeeze",
        1.0,
        "air: {feed_squeeze:.2g} of what the ends suck is fed (feed-squeeze number), so that air is drawn in "
        "and the damping falls, by how much only a measured [damper] air_fraction says",
        below=True,
    ),
    Remark(
        "air_fraction",
        0.0,
        "air: the oil of the answer has {air_fraction:.0%} less viscosity and density, the most that so much "
        "air takes; the truth lies between it and that without air_fraction",
    ),
)
"""Air in the oil, by the numbers of `built_remarks`."""

SEALED = Remark(
    "sealing",
    0.0,
    "seals: damping and added mass in small motion are {sealing:.3g} times those of open ends, so that the "
    "leakage of the seals sets them",
)
FAST = Remark(
    "beyond",
    1.0,
    "inertia of the film: squeeze Reynolds number {reynolds:.3g}, above {limit:g}, to which its model is "
    "good",
)


def built_remarks(
    table: DamperTable, damper: PorousDamper, speed: float, eccentricity_ratio: float
) -> tuple[str, ...]:
    """Return the remarks on seals, inertia and air, for an orbit at a speed [rad/s]."""
    limit = (FULL_LIMITS if isinstance(damper.extent, FullFilm) else RUPTURED_LIMITS)[0]
    reynolds = damper.reynolds_number(speed)
    numbers = {"reynolds": reynolds, "limit": limit, "beyond": reynolds / limit}
    told = [FAST] if damper.has_inertia else []
    if table.seals is not None:
        share = land_share(damper.slenderness, damper.squeeze_case.end_leak).real
        numbers["sealing"] = share / land_share(damper.slenderness, math.inf).real
        told.append(SEALED)
    numbers["air_fraction"], numbers["feed_squeeze"] = table.air_fraction, math.inf
    if table.feed_flow is not None and speed and eccentricity_ratio:
        amplitude = eccentricity_ratio * table.clearance
        numbers["feed_squeeze"] = feed_squeeze_number(
            damper, flow=table.feed_flow, amplitude=amplitude, frequency=abs(speed)
        )
    return said((*told, *AIR), numbers)


def rotor_remarks(
    table: DamperTable,
    damper: PorousDamper,
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
        With a film that is quick enough for hundreds of orbits.
    stiffness : float [N/m]
        Of its springs.
    rotor : RigidRotor
        With the unbalance in question, 0 if that is what is asked for.
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


def _orbits(damper: PorousDamper, stiffness: float, rotor: RigidRotor) -> tuple[CircularOrbit, ...]:
    """Return the orbits in the short film; none where that takes seconds, a cavitated film with feed."""
    slow = damper.is_fed and not isinstance(damper.extent, FullFilm)
    if slow or not rotor.unbalance:
        return ()
    return synchronous_orbits(rotor, sprung(damper, stiffness)).at(rotor.unbalance)


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
