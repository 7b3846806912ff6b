"""Air that the ends of a film would draw in where there is no oil around them."""

from __future__ import annotations

from ....errors import warn_user

AIR_SHARE = 0.01
"""Of the side flow, what ends in air may draw in before a warning."""


def warn_of_air(submerged: bool, drawn_in: float, side_flow: float) -> None:
    """Warn where ends in air would draw in air, beside flows in one unit."""
    if not submerged and drawn_in > AIR_SHARE * side_flow:
        warn_user(
            "submerged must be True for ends that draw in oil: in air they would draw in air, "
            f"{100.0 * drawn_in / side_flow:.2g} % of the side flow"
        )
