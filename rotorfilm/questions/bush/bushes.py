"""At which speed a polymer bush melts: the heat into the shaft in closed form, then exact."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

from ...answers import ErrorEstimate, Found, WorkUnit
from ...bearings.bush import ApproximateShaft, ExactShaft, MeltingBush
from ...errors import InputError
from ...ladders import BaseRung, Ladder

if TYPE_CHECKING:
    from ...scenes.scene import Scene

EXACT_ERROR = 2e-7
"""Verified error of the exact flux: docs/accuracy.md."""


@dataclass(frozen=True, kw_only=True)
class BushRung(BaseRung):
    """The critical speed by one formula of the heat into the shaft.

    Attributes
    ----------
    bush : MeltingBush
    load : float [N]
    """

    bush: MeltingBush
    load: float

    @property
    def is_exact(self) -> bool:
        """Whether the heat into the shaft is exact."""
        return isinstance(self.bush.shaft_heat, ExactShaft)

    @property
    def name(self) -> str:
        """The formula."""
        return "exact" if self.is_exact else "closed form of the flux"

    @property
    def prior(self) -> float:
        """Order of magnitude of the error of the closed form."""
        return 0.0 if self.is_exact else 1e-3

    @property
    def unit(self) -> WorkUnit:
        """One flux."""
        return WorkUnit(f"fluxes into the shaft, {self.name}", ("fluxes", self.is_exact))

    def answer(self, before: Found | None) -> Found:
        """Return the critical speed of the unworn bush [rad/s]."""
        at = self.bush.contact(self.load)
        return Found(at.critical_speed, {self.unit: 1}, at)

    def estimate(self, found: Found, before: Found | None, tolerance: float) -> ErrorEstimate:
        """Return what the exact flux would change: the speed goes with the heat into shaft and liner."""
        if self.is_exact:
            return ErrorEstimate(EXACT_ERROR, "verified bound of the flux", bound=True)
        at = found.solution
        exact = replace(self, bush=replace(self.bush, shaft_heat=ExactShaft()))
        change = float(exact.bush.shaft_flux(at.contact_angle)) - at.shaft_flux
        error = abs(change) / (at.shaft_flux + change + at.liner_flux)
        return ErrorEstimate(error, "defect of the exact flux", {exact.unit: 1})


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
    shafts = (ApproximateShaft(), ExactShaft())
    rungs = tuple(BushRung(bush=replace(bush, shaft_heat=shaft), load=load) for shaft in shafts)
    return Ladder(rungs=rungs, unit="rad/s")
