"""At which speed a polymer bush melts: the heat into the shaft in closed form, then exact."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

from ...answers import ErrorEstimate, Found, Work
from ...bearings.bush import ApproximateShaft, ExactShaft, MeltingBush
from ...errors import InputError
from ..walk import Ladder

if TYPE_CHECKING:
    from ...scenes.scene import Scene

EXACT_ERROR = 2e-7
"""Verified error of the exact flux: docs/accuracy.md."""

FLUX = "fluxes into the shaft"


@dataclass(frozen=True, kw_only=True)
class BushRung:
    """The critical speed by one formula of the heat into the shaft.

    Attributes
    ----------
    name : str
    bush : MeltingBush
    load : float [N]
    prior : float [1]
    """

    name: str
    bush: MeltingBush
    load: float
    prior: float

    @property
    def unit(self) -> str:
        """Name of one flux."""
        return f"{FLUX}, {self.name}"

    def answer(self, before: Found | None) -> Found:
        """Return the critical speed of the unworn bush [rad/s]."""
        at = self.bush.contact(self.load)
        return Found(at.critical_speed, {self.unit: 1}, at)

    def estimate(self, found: Found, before: Found | None, tolerance: float) -> ErrorEstimate:
        """Return what the exact flux would change: the speed goes with the heat into shaft and liner."""
        if isinstance(self.bush.shaft_heat, ExactShaft):
            return ErrorEstimate(EXACT_ERROR, "verified bound of the flux", bound=True)
        at = found.solution
        exact = replace(self.bush, shaft_heat=ExactShaft())
        change = float(exact.shaft_flux(at.contact_angle)) - at.shaft_flux
        error = abs(change) / (at.shaft_flux + change + at.liner_flux)
        return ErrorEstimate(error, "defect of the exact flux", {f"{FLUX}, exact": 1})

    def expected(self, done: Work) -> Work:
        """Return one flux."""
        return {self.unit: 1}


def bush_ladder(scene: Scene, quantity: str) -> Ladder:
    """Return the ladder of the speed at which a bush melts.

    Raises
    ------
    InputError
        If the scene has no bush.
    """
    if scene.bush is None:
        raise InputError(f"bush is required for {quantity}, got no such table")
    bush, load = scene.bush.build(), math.hypot(*scene.static_load)
    rungs = (
        BushRung(
            name="closed form of the flux",
            bush=replace(bush, shaft_heat=ApproximateShaft()),
            load=load,
            prior=1e-3,
        ),
        BushRung(name="exact", bush=replace(bush, shaft_heat=ExactShaft()), load=load, prior=0.0),
    )
    return Ladder(rungs=rungs, unit="rad/s")
