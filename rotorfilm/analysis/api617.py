"""Stability of a compressor as API 617 wants it, level I: a screening by applied cross-coupling."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from typing import NamedTuple, Protocol, runtime_checkable

import numpy as np

from ..core.dynamic_stiffness import has_own_stiffness, states_rest
from ..core.errors import AbsentError, ConvergenceError, InputError, require_each, require_positive, warn_user
from ..core.inputs import arguments, in_si, quantities
from ..core.model import Array
from ..core.port import Bearings, carries_load
from ..core.readable import Drawable, Readable
from ..core.results import Coefficients
from ..rotors import ShaftRotor, Station
from ..rotors.structure import freedom_rows
from .coefficients import film_coefficients
from .modal_reduction import exact_structure, lu_solver
from .rotor_equilibrium import RotorEquilibrium, rotor_equilibrium
from .rotor_matrices import dynamics, motion_near, oscillates, second_order, whirl_near
from .rotor_modes import RotorModes, log_decrement, motions_about
from .shaft_statics import chosen_stations, rigid_support_speed
from .threads import one_blas_thread

# Log decrement of the first forward whirl over applied cross-coupling, in one set of bearings.


REACH = 10.0
"""Applied / anticipated cross-coupling up to which API 617 wants the curve."""

POINTS = 11
"""Points of a curve; API 617 wants five at least."""

FARTHEST = 1e3
"""Cross-coupling / anticipated one up to which a decrement of zero is looked for."""

_NEWTON = 30
_NEUTRAL = 1e-12


@dataclass(frozen=True, kw_only=True)
class StabilityCurve(Readable):
    """Log decrement of the first forward whirl over the applied cross-coupling, in one set of bearings.

    Attributes
    ----------
    name : str
        Name of the set of bearings.
    cross_coupling : ndarray, shape (n_points,) [N/m]
        Applied cross-coupled stiffness, from 0 to ten times the anticipated one, or until the decrement is 0.
    log_decrement : ndarray, shape (n_points,) [1]
    frequency : ndarray, shape (n_points,) [rad/s]
        Frequency of the whirl.
    zero_cross_coupling : float [N/m]
        Q0, at which the decrement is 0; 0 where the rotor whirls by itself, inf where none was found up to a
        thousand times the anticipated cross-coupling.
    anticipated_decrement : float [1]
        delta_A, at the anticipated cross-coupling.
    other_growth : str
        Description of another motion that grows at the anticipated cross-coupling; empty if there is none.
    """

    name: str
    cross_coupling: Array
    log_decrement: Array
    frequency: Array
    zero_cross_coupling: float
    anticipated_decrement: float
    other_growth: str = ""


def stability_curve(name: str, excited: CrossCoupledRotor, anticipated: float) -> StabilityCurve:
    """Return the curve of one set of bearings."""
    first = excited.first
    expected = excited.followed(first, anticipated)
    neutral = _neutral(excited, expected if expected.value.real < 0.0 else first, anticipated)
    zero = 0.0 if first.value.real >= 0.0 else math.inf if neutral is None else neutral.cross_coupling
    last = REACH * anticipated if zero == 0.0 else min(REACH * anticipated, zero)
    points = [first]
    for applied in np.linspace(0.0, last, POINTS)[1:]:
        points.append(excited.followed(points[-1], float(applied)))
    return StabilityCurve(
        name=name,
        cross_coupling=np.array([point.cross_coupling for point in points]),
        log_decrement=np.array([point.log_decrement for point in points]),
        frequency=np.array([point.value.imag for point in points]),
        zero_cross_coupling=zero,
        anticipated_decrement=expected.log_decrement,
        other_growth=other_growth(excited, expected, "at the anticipated cross-coupling"),
    )


def _neutral(excited: CrossCoupledRotor, start: ForwardWhirl, anticipated: float) -> ForwardWhirl | None:
    """Return the whirl at the decrement of zero, by Newton's method; None if there is none within reach."""
    whirl = start
    for _ in range(_NEWTON):
        if abs(whirl.value.real) <= _NEUTRAL * abs(whirl.value):
            return whirl
        if whirl.rate.real <= 0.0:
            return None
        wanted = whirl.cross_coupling - whirl.value.real / whirl.rate.real
        if not 0.0 <= wanted <= FARTHEST * anticipated:
            return None
        try:
            whirl = excited.followed(whirl, wanted)
        except ConvergenceError:
            return None
    return None


def other_growth(excited: CrossCoupledRotor, expected: ForwardWhirl, where: str) -> str:
    """Return what grows besides the first forward whirl, with the words `where`; empty for nothing."""
    values = excited.motions(expected.cross_coupling).eigenvalues
    grows = (values.real > 1e-9 * np.abs(values)) & (np.abs(values - expected.value) > 1e-6 * np.abs(values))
    if not grows.any():
        return ""
    worst = values[grows][np.argmax(values[grows].real)]
    if not oscillates(worst):
        return f"the rotor departs to one side {where}"
    return f"another whirl, of {worst.imag:.4g} rad/s, grows {where}"


# Stability of a compressor as API 617 wants it, level I: a screening by applied cross-coupling.


OFF_CENTER = 0.05
"""Distance of a node from mid-span / span, beyond which there is a warning."""


@dataclass(frozen=True, kw_only=True)
class StabilityLevelOne(Drawable):
    """A stability analysis of level I by API 617.

    Attributes
    ----------
    verdict : str
        Verdict in plain words.
    level_two_required : bool
        Whether a criterion requires an analysis of level II.
    speed : float [rad/s]
        Maximum continuous speed.
    anticipated_cross_coupling : float [N/m]
        QA, of all stages.
    stage_cross_coupling : ndarray, shape (n_stages,) [N/m]
        Anticipated cross-coupled stiffness of each stage.
    zero_cross_coupling : float [N/m]
        Q0, the smallest of all curves.
    margin : float [1]
        Q0 / QA.
    anticipated_decrement : float [1]
        delta_A, the smallest of all curves.
    critical_speed_ratio : float [1]
        CSR: maximum continuous speed / first undamped critical speed on rigid supports. Seals do not count as
        supports.
    average_density : float or None [kg/m3]
        Average density of the gas; None without impellers.
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


@one_blas_thread
@arguments
def stability_level_one(
    rotor: ShaftRotor,
    cases: Mapping[str, Bearings],
    speed: float,
    stages: Sequence[DisturbingStage],
    *,
    nodes: Mapping[int, float] | None = None,
    stage_speed: float | None = None,
    average_density: float | None = None,
    supports: Sequence[str] | None = None,
) -> StabilityLevelOne:
    """Return the stability analysis of level I of a compressor, by API 617.

    Cross-coupled stiffness is applied to the rotor and increased until the log decrement of its first forward
    whirl is zero. The first forward whirl is the slowest one with the rotation that is damped so little that
    it has a resonance (log decrement below 2 pi). Films have K and C of their equilibrium at this speed. For
    tilting pads these are synchronous coefficients, as the standard requires.

    Parameters
    ----------
    rotor : ShaftRotor
    cases : mapping of str to mapping of str to Reaction
        Bearings by station, for each case by its name: the smallest and the largest clearance, say.
    speed : float [rad/s]
        Maximum continuous speed, of either sign.
    stages : sequence of Impeller or AxialStage
        At least one stage. An object of your own class with a method `cross_coupling(speed)` is accepted too;
        it needs an `average_density`.
    nodes : mapping of int to float, optional
        Nodes where the cross-coupling acts, as parts that are scaled to a sum of 1. By default the node next
        to the middle between the outermost bearings, as for rotors between bearings; for an overhung rotor
        give the nodes of its stages, with their anticipated cross-couplings as parts.
    stage_speed : float or None [rad/s]
        Stage speed at which the stages have their power; `speed` unless given.
    average_density : float or None [kg/m3]
        Mean of suction and discharge of the machine; by default of the lowest suction and highest discharge
        of the impellers, and none where all stages are axial.
    supports : sequence of str, optional
        Stations of the bearings, which are rigid for the critical speed ratio and between which the middle
        is. By default all except those of an `AnnularSeal` and of other reactions with
        `carries_load = False`. Name them if a `LinearBearing` or a `TabulatedBearing` represents a seal.

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
    API 617, 7th ed. (2002), part 1, 2.6.5, and its successor in the 8th ed. (2014). Level II is
    required for centrifugal compressors where Q0 / QA < 2, delta_A < 0.1, or Q0 / QA < 10 in region B of
    critical speed ratio and density; for axial rotors where delta_A < 0.1. The border of region B has the
    values that ROSS reads off the figure. It is CSR 2.5 up to 16.53 kg/m3, then a straight line to 2.0 at 60
    kg/m3. Beyond 60 kg/m3 every point is in region B.
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
    margin, decrement = zero / anticipated, min(curve.anticipated_decrement for curve in curves)
    ratio = abs(speed) / rigid_support_speed(rotor, held)
    reasons = [
        *screened(margin, decrement, ratio, density),
        *(f"in {c.name}, {c.other_growth}" for c in curves if c.other_growth),
    ]
    return StabilityLevelOne(
        verdict=_verdict(reasons),
        level_two_required=bool(reasons),
        speed=speed,
        anticipated_cross_coupling=anticipated,
        stage_cross_coupling=each,
        zero_cross_coupling=zero,
        margin=margin,
        anticipated_decrement=decrement,
        critical_speed_ratio=ratio,
        average_density=density,
        nodes={str(node): part for node, part in parts.items()},
        curves=curves,
    )


def _verdict(reasons: Sequence[str]) -> str:
    if not reasons:
        return "acceptable: no analysis of level II is required"
    return f"an analysis of level II is required: {'; '.join(reasons)}"


def _require_cases(cases: Mapping[str, Bearings], stages: Sequence[DisturbingStage], speed: float) -> None:
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


def _bearings(rotor: ShaftRotor, cases: Mapping[str, Bearings]) -> list[str]:
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
        raise InputError("nodes must name at least one node, got none")
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
            f"the cross-coupling should act at mid-span, {middle:.4g} m, where the shaft has no node: it "
            f"acts at node {node}, {off:.3g} m away"
        )
    return node


# Stability of a compressor as API 617 wants it, level II.


@dataclass(frozen=True, kw_only=True)
class StabilityLevelTwo(Readable):
    """The result of an analysis of level II by API 617.

    Attributes
    ----------
    verdict : str
        Verdict in plain words.
    acceptable : bool
        Whether the final log decrement is above 0.1 and no other motion grows.
    log_decrement : float [1]
        delta_f, of the first forward whirl with all destabilizing and damping effects on the rotor.
    frequency : float [rad/s]
        Frequency of that whirl.
    speed : float [rad/s]
    """

    verdict: str
    acceptable: bool
    log_decrement: float
    frequency: float
    speed: float


LEAST_FINAL = 0.1
"""Final log decrement above which API 617 accepts a rotor."""


@one_blas_thread
@arguments
def stability_level_two(rotor: ShaftRotor, bearings: Bearings, speed: float) -> StabilityLevelTwo:
    """Return the stability analysis of level II by API 617: the final log decrement must exceed 0.1.

    A rotor is not acceptable either if another motion grows, such as a backward whirl.

    Parameters
    ----------
    rotor : ShaftRotor
    bearings : mapping of str to Reaction
        Bearings by station: bearings, and all that level I lumps together, as seals and impellers
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


# The cross-coupled stiffness that the stages of a compressor are expected to have.


CENTRIFUGAL, AXIAL = 3.0, 1.5
"""Factors Bc and Bt of API 617."""

MOLECULAR_WEIGHT = 10.0
"""Molecular weight per unit of the factor, in the formula of Wachel."""


@runtime_checkable
class DisturbingStage(Protocol):
    """A source of destabilizing cross-coupling: an impeller, an axial stage, or a user's own class."""

    def cross_coupling(self, speed: float) -> float:
        """Return the anticipated cross-coupled stiffness [N/m] at an angular speed [rad/s]."""


@quantities
@dataclass(frozen=True, kw_only=True)
class Impeller:
    """An impeller of a centrifugal compressor, with the cross-coupling that API 617 anticipates.

        q = alford_factor power / (|speed| diameter width) discharge_density / suction_density

    Parameters
    ----------
    power : float [W]
        Power of this impeller, at the operating condition.
    diameter : float [m]
        Outer diameter of the impeller, Dc.
    width : float [m]
        The smaller of the widths of impeller and diffuser at the discharge, Hc.
    suction_density : float [kg/m3]
        Density of the gas before the impeller.
    discharge_density : float [kg/m3]
        Density of the gas behind the impeller.
    alford_factor : float [1]
        Bc: 3 in API 617, molecular weight / 10 in the formula of Wachel (`Impeller.wachel`).

    Raises
    ------
    InputError
        If a number is not positive, or the gas is thinner at the discharge than at the suction.

    Notes
    -----
    Modified Alford equation, API 617, 7th ed. (2002), part 1, 2.6.5.5, and its successor in the 8th ed.;
    Wachel & von Nimitz (1981), J. Petroleum Technology 33, 2252-2260. Power / speed is the torque, so that in
    SI there is no other constant: the published C = 9.55 (N m/s, mm, rpm, kN/mm) and 63 (hp, in, rpm,
    klbf/in) are 30 / pi in those units, rounded.
    """

    power: float
    diameter: float
    width: float
    suction_density: float
    discharge_density: float
    alford_factor: float = CENTRIFUGAL

    def __post_init__(self) -> None:
        names = ("power", "diameter", "width", "suction_density", "discharge_density", "alford_factor")
        require_each(self, require_positive, *names)
        if self.discharge_density < self.suction_density:
            raise InputError(
                f"discharge_density must be at least suction_density {self.suction_density!r}, "
                f"got {self.discharge_density!r}"
            )

    @classmethod
    @in_si
    def wachel(
        cls,
        *,
        power: float,
        diameter: float,
        width: float,
        suction_density: float,
        discharge_density: float,
        molecular_weight: float,
    ) -> Impeller:
        """Return an impeller by the formula of Wachel, in which a heavy gas disturbs more.

        Parameters
        ----------
        power, diameter, width, suction_density, discharge_density : float [W, m, m, kg/m3, kg/m3]
        molecular_weight : float [1]
            Molecular weight of the gas; 30 is the factor of API 617.
        """
        require_positive("molecular_weight", molecular_weight)
        return cls(
            power=power,
            diameter=diameter,
            width=width,
            suction_density=suction_density,
            discharge_density=discharge_density,
            alford_factor=molecular_weight / MOLECULAR_WEIGHT,
        )

    def cross_coupling(self, speed: float) -> float:
        """Return the anticipated cross-coupled stiffness [N/m] at an angular speed [rad/s]."""
        gap = abs(speed) * self.diameter * self.width
        return self.alford_factor * self.power / gap * self.discharge_density / self.suction_density


@quantities
@dataclass(frozen=True, kw_only=True)
class AxialStage:
    """A stage of axial blades, with the cross-coupling of Alford that API 617 anticipates.

        q = alford_factor power / (|speed| diameter height)

    Parameters
    ----------
    power : float [W]
        Power of this stage.
    diameter : float [m]
        Pitch diameter of the blades, Dt.
    height : float [m]
        Effective height of the blades, Ht.
    alford_factor : float [1]
        Bt, 1.5 in API 617.

    Raises
    ------
    InputError
        If a number is not positive.

    Notes
    -----
    Alford (1965), J. Eng. Power 87, 333-334; API 617 as for `Impeller`.
    """

    power: float
    diameter: float
    height: float
    alford_factor: float = AXIAL

    def __post_init__(self) -> None:
        require_each(self, require_positive, "power", "diameter", "height", "alford_factor")

    def cross_coupling(self, speed: float) -> float:
        """Return the anticipated cross-coupled stiffness [N/m] at an angular speed [rad/s]."""
        return self.alford_factor * self.power / (abs(speed) * self.diameter * self.height)


# The first forward whirl of a rotor, followed as cross-coupled stiffness is applied to it.


PEAKED = 2.0 * math.pi
"""Logarithmic decrement from which on a whirl has no resonance (damping ratio 1 / sqrt 2)."""

PROBE = 1e-5
"""Cross-coupling / stiffness of the rotor where it acts, at which forward and backward are told apart."""

STEP = 0.03
"""Largest change of an eigenvalue in a step, as a part of it."""

_STEPS = 1000


class ForwardWhirl(NamedTuple):
    """A whirl under an applied cross-coupling.

    Attributes
    ----------
    cross_coupling : float [N/m]
    value : complex [1/s]
        Its eigenvalue.
    shape : ndarray of complex, shape (N,)
    rate : complex [m/(N s)]
        d value / d cross_coupling.
    """

    cross_coupling: float
    value: complex
    shape: np.ndarray
    rate: complex

    @property
    def log_decrement(self) -> float:
        """Logarithm of the ratio of two successive amplitudes [1]."""
        return float(log_decrement(self.value))


@dataclass(frozen=True, kw_only=True)
class CrossCoupledRotor:
    """A rotor at rest in its bearings, to whose nodes cross-coupling is applied.

    Parameters
    ----------
    rotor : ShaftRotor
        Rotor with a station for each node where it acts.
    at : RotorEquilibrium
        Without it.
    shares : dict of str to float [1]
        Part of the cross-coupling, by these stations.
    """

    rotor: ShaftRotor
    at: RotorEquilibrium
    shares: Mapping[str, float]

    @cached_property
    def first(self) -> ForwardWhirl:
        """The first forward whirl without cross-coupling; AbsentError if there is none."""
        size = PROBE * self._stiffness
        motions = motions_about(self.rotor, self.under(size))
        swings = np.flatnonzero(oscillates(motions.eigenvalues) & (motions.direction > 0.0))
        chosen = swings[log_decrement(motions.eigenvalues[swings]) < PEAKED]
        if not chosen.size:
            raise AbsentError(
                f"rotor must have a forward whirl with a resonance at {self.at.speed:.6g} rad/s, and has none"
            )
        k = chosen[0]
        return self._whirl(0.0, complex(motions.eigenvalues[k]), motions.shapes[:, k])

    @cached_property
    def _stiffness(self) -> float:
        """Smallest static stiffness [N/m] of the rotor on its bearings, where cross-coupling acts."""
        exact = exact_structure(self.rotor)
        solve = lu_solver(second_order(exact, self.at).stiffness)
        rows = [freedom_rows(exact, name) for name in self.shares]
        return 1.0 / max(float(np.linalg.norm(pair @ solve(pair.T), 2)) for pair in rows)

    def under(self, cross_coupling: float) -> RotorEquilibrium:
        """Return the rest with a cross-coupling [N/m] that drives whirl in the sense of the rotation."""
        turned = cross_coupling * math.copysign(1.0, self.at.speed) * _TURN
        added = {
            name: Coefficients(
                stiffness=share * turned,
                damping=np.zeros((2, 2)),
                position=np.zeros(2),
                speed=self.at.speed,
            )
            for name, share in self.shares.items()
        }
        return replace(self.at, coefficients={**self.at.coefficients, **added})

    def motions(self, cross_coupling: float) -> RotorModes:
        """Return all motions under a cross-coupling [N/m]."""
        return motions_about(self.rotor, self.under(cross_coupling))

    def followed(self, whirl: ForwardWhirl, cross_coupling: float) -> ForwardWhirl:
        """Return what becomes of a whirl under another cross-coupling [N/m], in steps small enough.

        Raises
        ------
        ConvergenceError
            If it is lost.
        """
        for _ in range(_STEPS):
            left = cross_coupling - whirl.cross_coupling
            most = STEP * abs(whirl.value) / max(abs(whirl.rate), 1e-300)
            step = float(np.clip(left, -most, most))
            ahead = whirl.value + whirl.rate * step
            whirl = self._whirl(whirl.cross_coupling + step, ahead, whirl.shape)
            if step == left:
                return whirl._replace(cross_coupling=cross_coupling)
        raise ConvergenceError(f"whirl could not be followed to a coupling of {cross_coupling:.6g} N/m")

    def _whirl(self, cross_coupling: float, value: complex, shape: np.ndarray) -> ForwardWhirl:
        """Return the whirl under a cross-coupling next to a value and a shape."""
        exact, at = exact_structure(self.rotor), self.under(cross_coupling)
        frequency = abs(value.imag)
        found, right, left = whirl_near(exact, at, frequency, value, shape)
        _, slope = dynamics(motion_near(exact, at, frequency)(found), found)
        driven = self.under(1.0).coefficients
        pushed = sum(
            (rows @ left).conj() @ driven[name].stiffness @ (rows @ right)
            for name, rows in ((name, freedom_rows(exact, name)) for name in self.shares)
        )
        rate = -pushed / (left.conj() @ (slope @ right))
        return ForwardWhirl(cross_coupling, found, right, complex(rate))


_TURN: Array = np.array([[0.0, 1.0], [-1.0, 0.0]])
"""Stiffness whose force on x + i y is i times it: along the whirl with the rotation."""


def cross_coupled(
    rotor: ShaftRotor, bearings: Bearings, speed: float, nodes: Mapping[int, float]
) -> CrossCoupledRotor:
    """Return a rotor at rest, with a station at each node for its part of a cross-coupling."""
    names = {node: f"cross_coupling_{node}" for node in nodes}
    added = tuple(Station(node=node, name=name) for node, name in names.items())
    excited = replace(rotor, stations=(*rotor.stations, *added))
    at = rotor_equilibrium(excited, bearings, speed)
    # The standard wants K and C of tilting pads, and of what else follows, at the frequency of the shaft.
    synchronous = {
        name: film_coefficients(bearing, at.coefficients[name].position, speed, abs(speed))
        for name, bearing in bearings.items()
        if states_rest(bearing) and not has_own_stiffness(bearing)
    }
    at = replace(at, coefficients={**at.coefficients, **synchronous})
    return CrossCoupledRotor(
        rotor=excited, at=at, shares={names[node]: share for node, share in nodes.items()}
    )


# The criteria of API 617 by which an analysis of level II is required.


LEAST_DECREMENT = 0.1
"""delta_A below which an analysis of level II is required."""

LEAST_MARGIN, SAFE_MARGIN = 2.0, 10.0
"""Q0 / QA below which it is required, and below which it is in region B."""

BORDER_DENSITY = (16.53, 60.0)
"""Average densities [kg/m3] between which the border of region B falls; beyond the second all is region B."""

BORDER_RATIO = (2.5, 2.0)
"""Critical speed ratios of the border there, and below the first density."""


def border_ratio(density: float) -> float:
    """Return the critical speed ratio [1] above which a density [kg/m3] is in region B."""
    if density > BORDER_DENSITY[1]:
        return 0.0
    return float(np.interp(density, BORDER_DENSITY, BORDER_RATIO))


def in_region_b(ratio: float, density: float) -> bool:
    """Return whether a critical speed ratio [1] and an average density [kg/m3] are in region B."""
    return ratio > border_ratio(density)


def screened(margin: float, decrement: float, speed_ratio: float, density: float | None) -> Iterator[str]:
    """Yield why an analysis of level II is required; nothing where it is not.

    Parameters
    ----------
    margin : float [1]
        Q0 / QA.
    decrement : float [1]
        The anticipated one.
    speed_ratio : float [1]
        Critical speed ratio.
    density : float or None [kg/m3]
        Average one; None for an axial rotor.
    """
    if decrement < LEAST_DECREMENT:
        yield f"delta_A = {decrement:.3g}, below {LEAST_DECREMENT}"
    if density is None:
        return
    if margin < LEAST_MARGIN:
        yield f"Q0/QA = {margin:.3g}, below {LEAST_MARGIN:g}"
    elif margin < SAFE_MARGIN and in_region_b(speed_ratio, density):
        yield (
            f"Q0/QA = {margin:.3g}, below {SAFE_MARGIN:g}, in region B (critical speed ratio "
            f"{speed_ratio:.3g}, {density:.3g} kg/m3)"
        )
