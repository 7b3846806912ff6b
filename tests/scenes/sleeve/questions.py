"""The damping of a viscous sleeve: by a short film, then by one of finite length; what both leave out."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

from ...core.answers import CandidateRung, ErrorEstimate, Ladder, RungResult, Work, WorkUnit
from ...scenes.families import Remark, messages
from ...scenes.shared_tables import Lubricant
from .bearing import ViscousSleeve

if TYPE_CHECKING:
    from ...scenes.scene import Scene

ROUNDOFF = 1e-14


@dataclass(frozen=True, kw_only=True)
class SleeveFilm:
    """A film of a sleeve that may answer.

    Attributes
    ----------
    reaction : ViscousSleeve
    """

    reaction: ViscousSleeve

    @property
    def name(self) -> str:
        """Short or finite."""
        return "short film" if self.reaction.short else "finite film"

    @property
    def rich(self) -> ViscousSleeve | None:
        """The film of finite length, for the short one."""
        return replace(self.reaction, short=False) if self.reaction.short else None

    @property
    def prior(self) -> float:
        """Order of magnitude of the error."""
        return 0.1 * (self.reaction.length / self.reaction.radius) ** 2 if self.reaction.short else 0.0

    def bound(self, eccentricity_ratio: float, *, slopes: bool) -> float:
        """Return the verified error: the film of finite length is in closed form."""
        return float("inf") if self.reaction.short else ROUNDOFF

    def prepare(self) -> Work:
        """Return nothing: there is no map to make."""
        return {}


class SleeveRung(CandidateRung):
    """The damping by one film."""

    @property
    def unit(self) -> WorkUnit:
        """One formula."""
        return FORMULAS

    def answer(self, before: RungResult | None) -> RungResult:
        """Return the damping [N s/m]."""
        return RungResult(self.film.reaction.damping, {self.unit: 1})

    def estimate(self, found: RungResult, before: RungResult | None, tolerance: float) -> ErrorEstimate:
        """Return the change that the richer film makes, or the verified bound."""
        rich = self.film.rich
        if rich is None:
            return ErrorEstimate(self.film.bound(0.0, slopes=True), "closed form", bound=True)
        return ErrorEstimate(abs(found.value / rich.damping - 1.0), "the film of finite length")


FORMULAS = WorkUnit("formulas of a sleeve")

REMARKS = (
    Remark("taylor", 41.2, "turbulence: Taylor vortices above 41.2, the film has {taylor:.3g}"),
    Remark("thickness", 0.01, "thick film: its clearance is {thickness:.1%} of the radius"),
)


def sleeve_remarks(sleeve: ViscousSleeve, oil: Lubricant, speed: float) -> tuple[str, ...]:
    """Return what is left out and should not be, one line each, at a speed [rad/s]."""
    thickness = sleeve.clearance / sleeve.radius
    reynolds = abs(speed) * sleeve.radius * sleeve.clearance * oil.density / sleeve.viscosity
    return messages(REMARKS, {"taylor": reynolds * math.sqrt(thickness), "thickness": thickness})


def sleeve_ladder(scene: Scene, quantity: str) -> Ladder:
    """Return the ladder of the damping of a sleeve."""
    sleeve = scene.table("sleeve").build()
    films = (SleeveFilm(reaction=replace(sleeve, short=True)), SleeveFilm(reaction=sleeve))
    return Ladder(
        rungs=tuple(SleeveRung(film=film) for film in films),
        unit="N s/m",
        remarks=sleeve_remarks(sleeve, scene.lubricant.properties, scene.speed),
    )


LADDERS = {"damping": sleeve_ladder}
"""What a scene with a sleeve may be asked."""
