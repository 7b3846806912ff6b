"""Stability of a compressor as API 617 wants it, level II."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

from ...inputs.kinds import arguments
from ...model import Reaction
from ...readable.result import Readable
from ...rotors import ShaftRotor
from .forward_whirl import cross_coupled
from .stability_curve import other_growth


@dataclass(frozen=True, kw_only=True)
class StabilityLevelTwo(Readable):
    """The result of an analysis of level II by API 617.

    Attributes
    ----------
    verdict : str
        In plain words.
    acceptable : bool
        Whether the final log decrement is above .1, and nothing else grows.
    log_decrement : float [1]
        delta_f, of the first forward whirl with all that disturbs and damps the rotor.
    frequency : float [rad/s]
        Of that whirl.
    speed : float [rad/s]
    """

    verdict: str
    acceptable: bool
    log_decrement: float
    frequency: float
    speed: float


LEAST_FINAL = 0.1
"""Final log decrement above which API 617 accepts a rotor."""


@arguments
def stability_level_two(
    rotor: ShaftRotor, bearings: Mapping[str, Reaction], speed: float
) -> StabilityLevelTwo:
    """Return whether the final log decrement of the first forward whirl is what API 617 wants, above .1.

    A rotor of which anything else grows, as a backward whirl or another mode, is not acceptable either.

    Parameters
    ----------
    rotor : ShaftRotor
    bearings : mapping of str to Reaction
        By station: bearings, and all that level I lumps together, as seals and impellers
        (`TabulatedBearing`, `LinearBearing`) in stations of their own.
    speed : float [rad/s]

    Raises
    ------
    EquilibriumError
        If the rotor does not rest in its bearings.
    AbsentError
        If it has no forward whirl with a resonance.

    Notes
    -----
    API 617, 7th ed. (2002), part 1, 2.6.6, and its successor in the 8th ed. (2014).
    """
    node = rotor.stations[0].node if rotor.stations else 0
    turning = cross_coupled(rotor, bearings, speed, {node: 1.0})
    whirl = turning.first
    other = other_growth(turning, whirl, f"at {speed:.4g} rad/s")
    fine = whirl.log_decrement > LEAST_FINAL
    place, word = "above" if fine else "not above", "acceptable" if fine and not other else "not acceptable"
    reasons = [f"final log decrement {whirl.log_decrement:.3g}, {place} {LEAST_FINAL}", other]
    return StabilityLevelTwo(
        verdict=f"{word}: {'; '.join(filter(None, reasons))}",
        acceptable=fine and not other,
        log_decrement=whirl.log_decrement,
        frequency=whirl.value.imag,
        speed=speed,
    )
