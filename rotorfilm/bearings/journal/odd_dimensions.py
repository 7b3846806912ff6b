"""Dimensions that are probably a slip of units."""

from __future__ import annotations

from ...errors import warn_user

CLEARANCE_RATIOS = (1e-5, 2e-2)
"""Clearance / radius of bearings that are built; outside, a unit probably is wrong."""


def warn_of_odd_dimensions(
    radius: float, length: float, clearance: float, film: str, slenderness_limit: float
) -> None:
    """Warn where a bearing [m] is not of a size that is built, or too long for its film.

    Parameters
    ----------
    radius, length, clearance : float [m]
    film : str
        What the film is, for the message.
    slenderness_limit : float [1]
        Length / diameter to which the film is meant.
    """
    ratio, (least, most) = clearance / radius, CLEARANCE_RATIOS
    if not least * (1.0 - 1e-12) <= ratio <= most * (1.0 + 1e-12):
        warn_user(
            f"clearance / radius should be {least:g} to {most:g}, got {ratio:.3g} "
            f"from {clearance!r} m and {radius!r} m: check units"
        )
    slenderness = length / (2.0 * radius)
    if slenderness > slenderness_limit:
        warn_user(
            f"length / diameter must not exceed {slenderness_limit} for {film}, got {slenderness:.6g}: "
            "the film force can be wrong by half and more"
        )
