"""The dimensionless groups of a rotor on a damper."""

from __future__ import annotations

import math
from dataclasses import dataclass

from ...errors import require_non_negative, require_number, require_positive
from ...inputs.kinds import arguments
from ...inputs.si_arguments import quantities
from .bearing import PorousDamper


@quantities
@dataclass(frozen=True, kw_only=True)
class DamperGroups:
    """The dimensionless groups of a rotor on a damper, w_r being any reference speed.

    Attributes
    ----------
    squeeze_number : float [1]
        Bs = mu R L^3/(m w_r C^3).
    damper_number : float [1]
        B = mu R^3 L/(2 m w_r C^3) = Bs/(8 (L/D)^2).
    permeability_number : float [1]
        Phi = A H/C^3; 0 for a solid cage.
    grading : float [1]
        lambda.
    thickness_ratio : float [1]
        H/L.
    slenderness : float [1]
        L/D.
    speed_ratio : float [1]
        Omega = omega/w_r.
    spring_ratio : float [1]
        Omega_s = sqrt(K/m)/w_r, K the stiffness of the retainer springs.
    unbalance_ratio : float [1]
        U = u/(m C).
    """

    squeeze_number: float
    damper_number: float
    permeability_number: float
    grading: float
    thickness_ratio: float
    slenderness: float
    speed_ratio: float
    spring_ratio: float
    unbalance_ratio: float


@arguments
def damper_groups(
    damper: PorousDamper,
    *,
    mass: float,
    speed: float,
    stiffness: float = 0.0,
    unbalance: float = 0.0,
    reference_speed: float | None = None,
) -> DamperGroups:
    """Return the dimensionless groups of a rigid rotor on a damper.

    Parameters
    ----------
    damper : PorousDamper
    mass : float [kg]
        Carried by this damper.
    speed : float [rad/s]
        Of the rotor.
    stiffness : float [N/m]
        Of the retainer springs.
    unbalance : float [kg m]
    reference_speed : float [rad/s], optional
        w_r; the speed itself by default.

    Raises
    ------
    InputError
        If a value breaks its rule.
    """
    reference = abs(speed) if reference_speed is None else reference_speed
    require_positive("mass", mass)
    require_number("speed", speed)
    require_positive("reference_speed", reference)
    require_non_negative("stiffness", stiffness)
    require_non_negative("unbalance", unbalance)
    layer = damper.layer
    squeeze = damper.force_scale / (damper.clearance * mass * reference)
    return DamperGroups(
        squeeze_number=squeeze,
        damper_number=squeeze / (8.0 * damper.slenderness**2),
        permeability_number=0.0 if layer is None else layer.permeability_number,
        grading=0.0 if layer is None else layer.grading,
        thickness_ratio=0.0 if layer is None else layer.thickness_ratio,
        slenderness=damper.slenderness,
        speed_ratio=speed / reference,
        spring_ratio=math.sqrt(stiffness / mass) / reference,
        unbalance_ratio=unbalance / (mass * damper.clearance),
    )
