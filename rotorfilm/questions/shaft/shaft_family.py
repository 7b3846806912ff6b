"""What flexible rotors in their bearings bring to scenes and questions."""

from __future__ import annotations

from ...scenes.families import Family
from ...scenes.shaft.shaft_table import ShaftTable
from ..orbit_place import UNITS as ORBITS
from .shaft_orbits import shaft_orbit_ladder
from .shaft_peaks import PEAK, shaft_peak_ladder
from .shafts import EVENTS, shaft_ladder

FAMILY = Family(
    table=ShaftTable,
    ladders={
        **dict.fromkeys(EVENTS, shaft_ladder),
        **dict.fromkeys(ORBITS, shaft_orbit_ladder),
        PEAK: shaft_peak_ladder,
    },
    command="rotorfilm rotor",
)
