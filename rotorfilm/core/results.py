"""Results: frozen data that linear, transient and co-simulation analyses return."""

from __future__ import annotations

import dataclasses
import warnings
from collections.abc import Iterable, Iterator, Mapping, Sequence
from contextlib import suppress
from dataclasses import InitVar, dataclass, field
from functools import cached_property
from typing import Any, ClassVar

import numpy as np
from numpy.typing import NDArray

from .errors import RotorfilmError, require_each, require_finite
from .readable import Drawable, Item, Readable, Row, rows_of
from .signals import FREEDOMS, PLANAR
from .sources import offered

Array = NDArray[np.float64]


@dataclass(frozen=True, kw_only=True)
class BearingLosses(Readable):
    """What a film takes from the shaft, and the oil that runs through it; arrays for a batch of states.

    Attributes
    ----------
    power_loss : float [W]
        Heat made in the oil: what the journal gives to the film, its torque times the speed minus force times
        velocity, and what a supply pressure puts in.
    friction_torque : float [N m]
        Torque about +z that keeps the journal turning; of the sign of the speed.
    bush_torque : float [N m]
        Torque about +z of the film on the bush. It differs from `friction_torque` by position x force.
    side_flow : float [m3/s]
        Oil that leaves the film at both ends, without that straight out of grooves.
    inflow, arriving : ndarray, shape (openings, ...) [m3/s]
        Oil that leaves each opening into the films beside it, and that comes to it from films and streamers
        beside it, in the order of `FilmGeometry.openings`.
    """

    power_loss: float | Array
    friction_torque: float | Array
    bush_torque: float | Array
    side_flow: float | Array
    inflow: Array
    arriving: Array

    def __post_init__(self) -> None:
        require_each(self, require_finite, *(one.name for one in dataclasses.fields(self)))


def by_freedom(items: Iterable[Item], freedoms: Sequence[str]) -> Iterator[Item]:
    """Yield items, those of other motions than x and y entry by entry, each with its unit.

    An entry of a matrix that is round-off beside its diagonal is 0; what only x and y have is left out
    without them.
    """
    for item in items:
        if item.name in _PLANAR_ONLY and not {*PLANAR} <= {*freedoms}:
            continue
        units = _UNITS.get(item.name)
        if units is None or tuple(freedoms) == PLANAR:
            yield item
            continue
        value = _without_noise(np.asarray(item.value))
        for place in np.ndindex(value.shape):
            named = [freedoms[k] for k in place]
            unit = units[tuple(FREEDOMS[name].turns for name in named)]
            yield Item("_".join([item.name, *named]), value[place].item(), unit, ())


def _without_noise(value: Array) -> Array:
    """Return a matrix with 0 where an entry is round-off beside its diagonal; a vector as it is."""
    if value.ndim != 2:
        return value
    sizes = np.sqrt(np.abs(np.diag(value)))
    return np.where(np.abs(value) < NOISE * np.outer(sizes, sizes), 0.0, value)


NOISE, _PLANAR_ONLY = 1e-12, frozenset({"eccentricity_ratio", "attitude_angle"})
"""Share of the diagonal that is round-off in a printed matrix, and what is said with x and y alone."""


_UNITS: Mapping[str, Mapping[Any, str]] = {
    "position": {(False,): "m", (True,): "rad"},
    "load": {(False,): "N", (True,): "N.m"},
    "stiffness": {(False, False): "N/m", (False, True): "N/rad", (True, False): "N", (True, True): "N.m/rad"},
    "damping": {
        (False, False): "N.s/m",
        (False, True): "N.s/rad",
        (True, False): "N.s",
        (True, True): "N.m.s/rad",
    },
}
"""Units of the entries, by whether rows and columns turn the shaft."""


class InFreedoms(Readable):
    """A result about some motions of a shaft, which `freedoms` names."""

    freedoms: Any

    def _entries(self, items: Iterator[Item]) -> Iterator[Item]:
        return by_freedom(items, self.freedoms)


@dataclass(frozen=True, kw_only=True)
class Equilibrium(InFreedoms):
    """The static position of a journal at which the film balances the load.

    Attributes
    ----------
    position : ndarray, shape (2,) [m]
        Journal center from the bearing center; with other freedoms the position along these, shape (n,).
    speed : float [rad/s]
        Angular speed about +z.
    load : ndarray, shape (2,) [N]
        External static force on the journal, and moments [N m] where the reaction has tilts.
    eccentricity_ratio : float [1]
        |position| / clearance; 0 without a clearance.
    attitude_angle : float [rad]
        Angle from the load line to the journal center, in the sense of rotation; 0 without x and y.
    minimum_film : float [m]
        clearance - |position|; infinite without a clearance.
    residual : float [1]
        |film force + load| / |load|.
    iterations : int
        Newton steps taken; 0 for ball bearings that find their equilibrium themselves.
    temperature : float or None [K]
        Temperature of the film, if the heat balance determines it.
    reaction : object, optional
        The reaction that was solved for, kept for its `losses`.
    """

    position: Array
    speed: float
    load: Array
    eccentricity_ratio: float
    attitude_angle: float
    minimum_film: float
    residual: float
    iterations: int
    temperature: float | None = None
    reaction: InitVar[Any] = None

    def __post_init__(self, reaction: Any) -> None:
        object.__setattr__(self, "_reaction", reaction)

    @property
    def freedoms(self) -> tuple[str, ...]:
        """Motions of the shaft to which the position belongs."""
        return tuple(getattr(vars(self)["_reaction"], "freedoms", PLANAR))

    def to_rows(self) -> list[Row]:
        """Return names and values with their units, with the power loss after a heat balance; never warns."""
        rows = super().to_rows()
        with warnings.catch_warnings(action="ignore"), suppress(RotorfilmError):
            if self.temperature is not None and self.losses is not None:
                rows += rows_of([Item("power_loss", self.losses.power_loss, "W", ())])
        return rows

    @cached_property
    def losses(self) -> BearingLosses | None:
        """Power loss, torques and oil flow of the film, found when first asked for.

        None for a reaction that is no film, or one whose film law does not know them.
        """
        reaction = vars(self)["_reaction"]
        losses = getattr(reaction, "losses", None)
        return None if losses is None else losses(self.position, np.zeros_like(self.position), self.speed)


@dataclass(frozen=True, kw_only=True)
class Coefficients(InFreedoms):
    """Stiffness K = -dF/dq and damping C = -dF/dv of a reaction at a place, F being the force on the shaft.

    Attributes
    ----------
    stiffness : ndarray, shape (2, 2) [N/m]
        Rows: force x, y; columns: position x, y. With other freedoms shape (n, n), in N m and rad for tilts.
    damping : ndarray, shape (2, 2) [N s/m]
        Rows: force x, y; columns: velocity x, y.
    position : ndarray, shape (2,) [m]
    speed : float [rad/s]
    freedoms : tuple of str
        Motions of the shaft to which rows and columns belong.
    """

    stiffness: Array
    damping: Array
    position: Array
    speed: float
    freedoms: InitVar[tuple[str, ...]] = PLANAR

    def __post_init__(self, freedoms: tuple[str, ...]) -> None:
        object.__setattr__(self, "freedoms", freedoms)


@dataclass(frozen=True, kw_only=True)
class InertialCoefficients(Coefficients):
    """K, C and the added mass M of a film with fluid inertia: F = -K q - C v - M a for small motion.

    Attributes
    ----------
    mass : ndarray, shape (2, 2) [kg]
        Rows: force x, y; columns: acceleration along x, y.
    """

    mass: Array


def coefficients_of_slopes(
    slopes: Array, position: Array, speed: float, freedoms: Sequence[str] = PLANAR, mass: Array | None = None
) -> Coefficients:
    """Return K = -dF/dq and C = -dF/dv of a film, with its added mass where one is given.

    Parameters
    ----------
    slopes : ndarray, shape (n, 2 n or more) [N/m], [N s/m]
        Derivatives of its force by places and rates.
    position, speed : ndarray, shape (n,) [m], and float [rad/s]
    freedoms : sequence of str
    mass : ndarray, shape (n, n), optional [kg]
    """
    n = len(slopes)
    stiffness, damping = -slopes[:, :n], -slopes[:, n : 2 * n]
    given: dict[str, Any] = {
        "stiffness": stiffness,
        "damping": damping,
        "position": position,
        "freedoms": tuple(freedoms),
    }
    if mass is None:
        return Coefficients(**given, speed=speed)
    return InertialCoefficients(**given, speed=speed, mass=mass)


def added_mass(film: Coefficients) -> Array:
    """Return the added mass of a film [kg], in the shape of its K and C: zeros where those are all."""
    return film.mass if isinstance(film, InertialCoefficients) else np.zeros_like(film.stiffness)


@dataclass(frozen=True, kw_only=True)
class ReducedCoefficients(Coefficients):
    """Stiffness and damping at one frequency, reduced to the journal: tilting pads or cavities follow it.

    The force on a journal that moves as exp(s t), s = growth_rate + i frequency, is -(K + s C) q. K and C
    depend on the frequency.

    Attributes
    ----------
    frequency : float [rad/s]
        Frequency of the whirl: `speed` for synchronous coefficients, 0 for slow motion.
    growth_rate : float [1/s]
        Growth rate of the motion; 0 for a steady one.
    """

    frequency: float
    growth_rate: float = 0.0


@dataclass(frozen=True, kw_only=True)
class FrequencyDependentCoefficients(ReducedCoefficients):
    """Stiffness and damping of a frequency-dependent film at one frequency, with access to all others.

    Modes, thresholds and critical masses use its K(s) at the exponent of each motion, not the one pair of
    matrices that it prints.

    Attributes
    ----------
    motion : object, optional
        The `DynamicStiffness` of the film.
    """

    motion: InitVar[Any] = None

    def __post_init__(self, freedoms: tuple[str, ...], motion: Any) -> None:
        super().__post_init__(freedoms)
        if motion is None:
            raise TypeError("motion must be the stiffness of the film over s, got None")
        object.__setattr__(self, "_motion", motion)

    @property
    def dynamic_stiffness(self) -> Any:
        """The function that returns K(s) and dK/ds at an exponent s [1/s]."""
        return vars(self)["_motion"]

    def near(self, s: complex) -> Coefficients:
        """Return complex matrices with K(s) = stiffness + s damping, exact about s to the first order.

        Parameters
        ----------
        s : complex [1/s]
        """
        K, slope = self.dynamic_stiffness(s)
        slopes = np.hstack([s * slope - K, -slope])
        return coefficients_of_slopes(slopes, self.position, self.speed, vars(self)["freedoms"])

    def held(self, slopes: Array) -> Coefficients:
        """Return K, C and added mass with the states of the film held, from its derivatives there."""
        mass = getattr(self.dynamic_stiffness, "mass", np.zeros((len(slopes), len(slopes))))
        return coefficients_of_slopes(slopes, self.position, self.speed, vars(self)["freedoms"], mass)


@dataclass(frozen=True, kw_only=True)
class WhirlThreshold(Readable):
    """The onset of self-excited whirl of a rigid rotor, or the reason why there is none.

    Attributes
    ----------
    speed : float or None [rad/s]
        Angular speed at onset; None if there is no threshold in the range.
    whirl_ratio : float or None [1]
        Whirl frequency / speed at onset.
    critical_mass : float or None [kg]
        Mass carried by the bearing at onset.
    speed_parameter : float or None [1]
        speed * sqrt(clearance * mass / load) at onset.
    equilibrium : Equilibrium or None
        Static equilibrium at onset.
    reason : str
        Why there is no threshold; empty if there is one.
    """

    speed: float | None
    whirl_ratio: float | None
    critical_mass: float | None
    speed_parameter: float | None
    equilibrium: Equilibrium | None
    reason: str = ""

    @property
    def exists(self) -> bool:
        """Whether there is a threshold."""
        return self.speed is not None


@dataclass(frozen=True, kw_only=True)
class Trajectory(Drawable):
    """Signals over time, from a time integration or a co-simulation.

    Attributes
    ----------
    time : ndarray, shape (n,) [s]
        Times of the samples.
    signals : dict of str to ndarray, shape (n,)
        One series for each signal name, in the SI unit of the signal.
    work : dict of str to int
        Counters of the work done: film evaluations, Jacobians, steps.
    units : dict of str to str
        SI unit of each signal, where it is known.
    step_error : float or None [1]
        Step error of a run on mass-conserving films: the sum of the local errors of its steps, relative to
        the clearance.
    """

    time: Array
    signals: dict[str, Array]
    work: dict[str, int]
    units: dict[str, str] = field(default_factory=dict)
    step_error: float | None = None

    def _own_units(self) -> dict[str, str]:
        return self.units

    def to_rows(self) -> list[Row]:
        """Return names and values with their units, and what `run_whirl` says of a run at constant speed."""
        verdict = offered("whirl_verdict")(self)
        return super().to_rows() + [("whirl", verdict)] * bool(verdict)

    def __getitem__(self, name: str) -> Array:
        """Return the series of one signal, shape (n,)."""
        if name not in self.signals:
            raise KeyError(f"signal must be one of {', '.join(self.signals)}, got {name!r}")
        return self.signals[name]

    @property
    def position(self) -> Array:
        """Journal position, shape (2, n) [m]."""
        return np.stack([self.signals["x"], self.signals["y"]])

    @property
    def velocity(self) -> Array:
        """Journal velocity, shape (2, n) [m/s]."""
        return np.stack([self.signals["vx"], self.signals["vy"]])


def orbit_distance(
    own: Trajectory, reference: Trajectory, journals: Sequence[tuple[str, str]] = (("x", "y"),)
) -> float:
    """Return the largest distance of the journals between two trajectories [m].

    Compared at the sample times of the first up to the end of the second, which is interpolated linearly
    between its own.

    Parameters
    ----------
    own, reference : Trajectory
    journals : sequence of (str, str)
        Names of the signals x and y of each journal.
    """
    met = own.time <= reference.time[-1] * (1.0 + 1e-12)
    largest = 0.0
    for pair in journals:
        gaps = [own[name][met] - np.interp(own.time[met], reference.time, reference[name]) for name in pair]
        largest = max(largest, float(np.hypot(*gaps).max(initial=0.0)))
    return largest


@dataclass(frozen=True, kw_only=True)
class CircularOrbit(Readable):
    """A synchronous circular orbit of an unbalanced rotor, about the bearing center.

    Attributes
    ----------
    eccentricity_ratio : float [1]
        Radius of the orbit / clearance.
    unbalance : float [kg m]
    speed : float [rad/s]
        Angular speed of rotor and orbit about +z.
    phase : float [rad]
        Angle from the unbalance to the displacement in the sense of rotation; negative if the displacement
        lags.
    transmissibility : float [1]
        Force on the housing / centrifugal force of the unbalance.
    growth_rate : float [1/s]
        Largest real part of the four exponents of a small disturbance (Floquet exponents).
    """

    eccentricity_ratio: float
    unbalance: float
    speed: float
    phase: float
    transmissibility: float
    growth_rate: float

    _shown: ClassVar[tuple[str, ...]] = ("stable",)

    @property
    def stable(self) -> bool:
        """Whether small disturbances of the orbit decay."""
        return self.growth_rate < 0.0


def to_plain(value: Any) -> Any:
    """Return a result as plain dicts, lists and numbers, ready for JSON."""
    if dataclasses.is_dataclass(value) and not isinstance(value, type):
        return {f.name: to_plain(getattr(value, f.name)) for f in dataclasses.fields(value)}
    if isinstance(value, dict):
        return {str(key): to_plain(entry) for key, entry in value.items()}
    if isinstance(value, list | tuple):
        return [to_plain(entry) for entry in value]
    if isinstance(value, np.ndarray):
        return value.tolist()
    if isinstance(value, np.generic):
        return value.item()
    return value
