"""What the film of a viscous sleeve leaves out."""

from __future__ import annotations

import math

from ..families import Remark, messages
from ..shared_tables import Lubricant
from .sleeve_bearing import ViscousSleeve

REMARKS = (
    Remark("taylor", 41.2, "turbulence: Taylor vortices above 41.2, the film has {taylor:.3g}"),
    Remark("thickness", 0.01, "thick film: its clearance is {thickness:.1%} of the radius"),
)


def sleeve_remarks(sleeve: ViscousSleeve, oil: Lubricant, speed: float) -> tuple[str, ...]:
    """Return what is left out and should not be, one line each, at a speed [rad/s]."""
    thickness = sleeve.clearance / sleeve.radius
    reynolds = abs(speed) * sleeve.radius * sleeve.clearance * oil.density / sleeve.viscosity
    return messages(REMARKS, {"taylor": reynolds * math.sqrt(thickness), "thickness": thickness})
