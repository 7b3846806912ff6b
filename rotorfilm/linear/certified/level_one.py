"""Stability of a compressor as API 617 wants it, level I: a screening by applied cross-coupling."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from ...errors import InputError, require_positive, warn_user
from ...inputs.kinds import arguments
from ...model import Array, Reaction
from ...reactions.carried_load import carries_load
from ...readable.result import Drawable
from ...rotors import ShaftRotor, Station
from .cross_coupling import AxialStage, DisturbingStage, Impeller
from .forward_whirl import cross_coupled
from .rigid_support import chosen_stations, rigid_support_speed
from .screening import Screening, screened
from .stability_curve import StabilityCurve, stability_curve

OFF_CENTER = 0.05
"""Distance of a node from mid-span / span, beyond which there is a warning."""


@dataclass(frozen=True, kw_only=True)
class StabilityLevelOne(Drawable):
    """A stability analysis of level I by API 617.

    Attributes
    ----------
    verdict : str
        In plain words.
    level_two_required : bool
        Whether a criterion wants an analysis of level II.
    speed : float [rad/s]
        Maximum continuous speed.
    anticipated_cross_coupling : float [N/m]
        QA, of all stages.
    stage_cross_coupling : ndarray, shape (n_stages,) [N/m]
        Of each.
    zero_cross_coupling : float [N/m]
        Q0, the smallest of all curves.
    margin : float [1]
        Q0 / QA.
    anticipated_decrement : float [1]
        delta_A, the smallest of all curves.
    critical_speed_ratio : float [1]
        CSR: maximum continuous speed / first undamped critical speed on rigid supports; seals are none.
    average_density : float or None [kg/m3]
        Of the gas; None without impellers.
    nodes : dict of str to float [1]
        Nodes at which the cross-coupling acts, and the part of each.
    curves : tuple of StabilityCurve
    """

    verdict: str
    level_two_required: bool
    speed: float
    anticipated_cross_coupling: float
    stage_cross_coupling: Array
    zero_cross_coupling: float
    margin: float
    anticipated_decrement: float
    critical_speed_ratio: float
    average_density: float | None = None
    nodes: Mapping[str, float]
    curves: tuple[StabilityCurve, ...]


@arguments
def stability_level_one(
    rotor: ShaftRotor,
    cases: Mapping[str, Mapping[str, Reaction]],
    speed: float,
    stages: Sequence[DisturbingStage],
    *,
    nodes: Mapping[int, float] | None = None,
    stage_speed: float | None = None,
    average_density: float | None = None,
    supports: Sequence[str] | None = None,
) -> StabilityLevelOne:
    """Return the stability analysis of level I of a compressor, by API 617.

    Cross-coupled stiffness is applied to the rotor, and the log decrement of its first forward whirl followed
    to zero. The first forward whirl is the slowest one with the rotation that is damped so little that it has
    a resonance (log decrement below 2 pi). Films have K and C of their equilibrium at this speed, tilting
    pads those at the frequency of the shaft, as the standard wants it.

    Parameters
    ----------
    rotor : ShaftRotor
    cases : mapping of str to mapping of str to Reaction
        Bearings by station, for each case by its name: the smallest and the largest clearance, say.
    speed : float [rad/s]
        Maximum continuous speed, of either sign.
    stages : sequence of Impeller or AxialStage
        At least one; a class of one's own with `cross_coupling(speed)` will do, with an `average_density`.
    nodes : mapping of int to float, optional
        Where the cross-coupling acts, as parts that are scaled to a sum of 1. By default the node next to the
        middle between the outermost bearings, as for rotors between bearings; overhung rotors want the nodes
        of their stages, with their anticipated cross-couplings as parts.
    stage_speed : float or None [rad/s]
        At which the stages have their power; `speed` unless given.
    average_density : float or None [kg/m3]
        Mean of suction and discharge of the machine; by default of the lowest suction and highest discharge
        of the impellers, and none where all stages are axial.
    supports : sequence of str, optional
        Stations of the bearings, which are rigid for the critical speed ratio and between which the middle
        is. By default all but those of an `AnnularSeal`, or what else says `carries_load = False`; name them
        where a `LinearBearing` or a `TabulatedBearing` is no bearing but a seal.

    Raises
    ------
    InputError
        If an argument breaks its rule.
    EquilibriumError
        If the rotor does not rest in a set of bearings.
    AbsentError
        If the rotor has no forward whirl with a resonance.
    ConvergenceError
        If its whirl is lost on the way.

    Warns
    -----
    ValidityWarning
        If no node is near the middle.

    Notes
    -----
    API 617, 7th ed. (2002), part 1, 2.6.5, and its successor in the 8th ed. (2014). Level II is required for
    centrifugal compressors where Q0 / QA < 2, delta_A < .1, or Q0 / QA < 10 in region B of critical speed
    ratio and density; for axial rotors where delta_A < .1. The border of region B is what ROSS reads off the
    figure: CSR 2.5 up to 16.53 kg/m3, from there in a line to 2.0 at 60 kg/m3; beyond, all is region B.
    """
    _require_cases(cases, stages, speed)
    each = _expected(stages, speed if stage_speed is None else stage_speed)
    anticipated = float(each.sum())
    density = _density(stages, average_density)
    held = _bearings(rotor, cases) if supports is None else supports
    parts = _shares(rotor, chosen_stations(rotor, held), nodes)
    curves = tuple(
        stability_curve(name, cross_coupled(rotor, bearings, speed, parts), anticipated)
        for name, bearings in cases.items()
    )
    zero = min(curve.zero_cross_coupling for curve in curves)
    found = Screening(
        margin=zero / anticipated,
        anticipated_decrement=min(curve.anticipated_decrement for curve in curves),
        critical_speed_ratio=abs(speed) / rigid_support_speed(rotor, held),
        average_density=density,
    )
    reasons = [*screened(found), *(f"in {c.name}, {c.other_growth}" for c in curves if c.other_growth)]
    return StabilityLevelOne(
        verdict=_verdict(reasons),
        level_two_required=bool(reasons),
        speed=speed,
        anticipated_cross_coupling=anticipated,
        stage_cross_coupling=each,
        zero_cross_coupling=zero,
        margin=found.margin,
        anticipated_decrement=found.anticipated_decrement,
        critical_speed_ratio=found.critical_speed_ratio,
        average_density=density,
        nodes={str(node): part for node, part in parts.items()},
        curves=curves,
    )


def _verdict(reasons: Sequence[str]) -> str:
    if not reasons:
        return "acceptable: no analysis of level II is required"
    return f"an analysis of level II is required: {'; '.join(reasons)}"


def _require_cases(
    cases: Mapping[str, Mapping[str, Reaction]], stages: Sequence[DisturbingStage], speed: float
) -> None:
    if not cases:
        raise InputError("cases must hold at least one set of bearings, got none")
    if not stages:
        raise InputError("stages must be at least one, got none")
    require_positive("|speed|", abs(speed))


def _expected(stages: Sequence[DisturbingStage], turning: float) -> Array:
    """Return the anticipated cross-coupling of each stage, with a sum that is positive."""
    require_positive("|stage_speed|", abs(turning))
    each = np.array([stage.cross_coupling(turning) for stage in stages], dtype=float)
    require_positive("anticipated cross-coupling of all stages", float(each.sum()))
    return each


def _density(stages: Sequence[DisturbingStage], given: float | None) -> float | None:
    """Return the average density of the gas; None where all stages are axial, which are judged without."""
    if given is not None:
        require_positive("average_density", given)
        return given
    impellers = [stage for stage in stages if isinstance(stage, Impeller)]
    if impellers:
        lowest = min(one.suction_density for one in impellers)
        return 0.5 * (lowest + max(one.discharge_density for one in impellers))
    if not all(isinstance(stage, AxialStage) for stage in stages):
        raise InputError("average_density must be given for stages of one's own, got None")
    return None


def _bearings(rotor: ShaftRotor, cases: Mapping[str, Mapping[str, Reaction]]) -> list[str]:
    """Return the names of the stations without a seal in any case."""
    seals = {name for case in cases.values() for name, one in case.items() if not carries_load(one)}
    return [station.name for station in rotor.stations if station.name not in seals]


def _shares(
    rotor: ShaftRotor, held: Sequence[Station], nodes: Mapping[int, float] | None
) -> dict[int, float]:
    """Return the parts of the cross-coupling by node, with the sum 1."""
    if nodes is None:
        return {_middle_node(rotor, held): 1.0}
    for node, part in nodes.items():
        require_positive(f"nodes[{node}]", part)
    if not nodes:
        raise InputError("nodes must hold at least one node, got none")
    total = sum(nodes.values())
    return {node: part / total for node, part in nodes.items()}


def _middle_node(rotor: ShaftRotor, stations: Sequence[Station]) -> int:
    """Return the node next to the middle between the outermost bearings."""
    places = rotor.positions
    held = [places[station.node] for station in stations]
    if len(held) < 2 or max(held) == min(held):
        raise InputError("nodes must be given for a rotor without two bearings, got none")
    middle = 0.5 * (min(held) + max(held))
    node = int(np.argmin(np.abs(places - middle)))
    off = abs(places[node] - middle)
    if off > OFF_CENTER * (max(held) - min(held)):
        warn_user(
            f"cross-coupling should act at mid-span, {middle:.4g} m, where no node is: node {node} is "
            f"{off:.3g} m off"
        )
    return node
