"""What a question about a damper leaves open: which of several orbits, and what the films leave out."""

from __future__ import annotations

from dataclasses import replace

from ...bearings.damper import PorousDamper
from ...bearings.films.cavitation import FullFilm
from ...motion.circular.branches import synchronous_orbits
from ...results import CircularOrbit
from ...rotors import RigidRotor
from ..lubricant_table import Lubricant
from .damper_films import sprung
from .damper_ranges import damper_remarks

MIDDLING = 0.5
"""Eccentricity ratio of an orbit for the checks of a question that names no unbalance."""


def rotor_remarks(
    damper: PorousDamper, stiffness: float, rotor: RigidRotor, oil: Lubricant, *, steady: bool
) -> tuple[str, ...]:
    """Return the remarks on a rotor in a damper.

    Parameters
    ----------
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
    return (*(_which(found) if steady else ()), *physics)


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
