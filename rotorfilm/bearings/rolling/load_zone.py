"""How the balls share a load: integrals over the loaded zone, closed forms of Stribeck and Palmgren."""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np

from ...errors import InputError, require_count, require_number, require_positive
from ...inputs.kinds import arguments

HALF_ZONE = 0.5
"""Extent of the zone with half of the balls under load: no clearance and no thrust."""

STIFFNESS_CONSTANT = 13e6
"""Of the radial stiffness of ball bearings, N^(2/3) m^(-4/3) (Kraemer 1993, as in Friswell et al. 2010)."""

_NODES = 64


class LoadIntegrals(NamedTuple):
    """Radial and axial load over balls * largest ball load * the cosine and the sine of the contact angle.

    Attributes
    ----------
    radial, axial : float [1]
        J_r and J_a.
    """

    radial: float
    axial: float


@arguments
def load_integrals(extent: float) -> LoadIntegrals:
    """Return the integrals of the loaded zone of a ball bearing (Sjovall 1933; Harris & Kotzalas, ch. 7).

    J_r, J_a = 1/pi * integral from 0 to psi_l of (1 - (1 - cos psi)/(2 extent))^1.5 (cos psi, 1) d psi,
    cos psi_l = 1 - 2 extent.

    Parameters
    ----------
    extent : float [1]
        Load distribution factor epsilon: share of the diameter that is loaded; above 1 all balls are.

    Raises
    ------
    InputError
        If it is not finite and positive.
    """
    require_positive("extent", extent)
    end = math.acos(max(1.0 - 2.0 * extent, -1.0))
    # psi = end * sin(s), so that the root at the end of the zone is smooth.
    nodes, weights = np.polynomial.legendre.leggauss(_NODES)
    s, weight = 0.25 * math.pi * (nodes + 1.0), 0.25 * math.pi * weights
    psi = end * np.sin(s)
    depth = 1.0 - np.sin(0.5 * psi) ** 2 / extent
    load = np.maximum(depth, 0.0) ** 1.5 * end * np.cos(s) * weight / math.pi
    return LoadIntegrals(float(load @ np.cos(psi)), float(load.sum()))


@arguments
def stribeck_load(*, load: float, balls: int, contact_angle: float = 0.0) -> float:
    """Return the load of the most loaded ball [N] of a bearing without clearance, 4.37 W/(Z cos alpha).

    Stribeck (1907). The constant is 1/J_r(1/2), the limit of many balls.

    Parameters
    ----------
    load : float [N]
        Radial.
    balls : int
        Number of balls.
    contact_angle : float [rad]

    Raises
    ------
    InputError
        If the load is not finite and positive, there is no ball, or the angle is not below 90 deg.
    """
    require_positive("load", load)
    require_count("balls", balls)
    return load / (load_integrals(HALF_ZONE).radial * balls * _cosine(contact_angle))


@arguments
def palmgren_stiffness(*, load: float, balls: int, ball_diameter: float, contact_angle: float = 0.0) -> float:
    """Return the stiffness along a radial load [N/m], 13e6 Z^(2/3) D^(1/3) W^(1/3) cos(alpha)^(5/3) in SI.

    After Palmgren, for steel and no clearance; across the load it is 2/3 of this, on the average over the
    angle of the cage.

    Parameters
    ----------
    load : float [N]
        Radial.
    balls : int
        Number of balls.
    ball_diameter : float [m]
    contact_angle : float [rad]

    Raises
    ------
    InputError
        If load or diameter are not finite and positive, there is no ball, or the angle is not below 90 deg.
    """
    require_positive("load", load)
    require_count("balls", balls)
    require_positive("ball_diameter", ball_diameter)
    scale = float((balls**2 * ball_diameter * load) ** (1.0 / 3.0))
    return float(STIFFNESS_CONSTANT * scale * _cosine(contact_angle) ** (5.0 / 3.0))


def _cosine(contact_angle: float) -> float:
    if not 0.0 <= require_number("contact_angle", contact_angle) < 0.5 * math.pi:
        raise InputError(f"contact_angle must be at least 0 and below 90 deg, got {contact_angle!r} rad")
    return math.cos(contact_angle)
