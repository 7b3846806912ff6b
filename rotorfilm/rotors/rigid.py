"""A rigid rotor's share on one journal: two degrees of freedom, gravity, unbalance, any speed profile."""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import ArrayLike

from ..core.errors import (
    InputError,
    keep_pair,
    require_each,
    require_finite,
    require_non_negative,
    require_number,
    require_positive,
)
from ..core.inputs import quantities
from ..core.model import Array, Linearization
from ..core.signals import MOTION_NAMES, Signal, force_outputs, journal_inputs
from ..core.units import STANDARD_GRAVITY
from ..native.spec import NativeParameter, NativeSpec, parameter
from .profile import SpeedProfile, Turning
from .structure import (
    NOMINAL_LENGTH,
    FlexibleRotor,
    Operators,
    Structure,
    across_planes,
    both_planes,
    check_motion,
    checked_stations,
    displacements,
    extended,
    unbalance_columns,
)

NATIVE_PARAMETERS = {
    "mass": ("kg", "mass carried by this journal"),
    "unbalance": ("kg.m", "mass times eccentricity of the mass center"),
    "unbalance_angle": ("rad", "angle of the mass center from +x at t = 0, positive about +z"),
    "gravity_x": ("m/s2", "acceleration of gravity along x"),
    "gravity_y": ("m/s2", "acceleration of gravity along y"),
    "static_force_x": ("N", "constant external force along x, besides the weight"),
    "static_force_y": ("N", "constant external force along y, besides the weight"),
    "constant_speed": ("rad/s", "angular speed about +z, at all times"),
}
"""Units and meanings of what a simulator may set in the compiled rotor."""


@quantities
@dataclass(frozen=True, kw_only=True)
class RigidRotor(Turning):
    """The share of a rigid rotor that one journal carries; it moves without tilting.

    m a = film force + m gravity + static force + unbalance force. The mass center lies at
    q + (unbalance/m) (cos p, sin p), p = angle(t) + unbalance_angle, off the journal center q; two time
    derivatives give the unbalance force on the journal

        unbalance * (w^2 cos p + alpha sin p, w^2 sin p - alpha cos p)

    with the angular speed w = dp/dt and the angular acceleration alpha = dw/dt.

    Parameters
    ----------
    mass : float [kg]
        Mass carried by this journal.
    speed : float or SpeedProfile [rad/s]
        Angular speed about +z.
    unbalance : float [kg m]
        Mass times eccentricity of the mass center, not negative.
    unbalance_angle : float [rad]
        Angle of the mass center from +x at t = 0, positive about +z.
    gravity : tuple of two floats [m/s2]
    static_force : tuple of two floats [N]
        Constant external force on the journal besides the weight.
    position, velocity : tuple of two floats [m], [m/s]
        Position and velocity of the journal center at t = 0.

    Raises
    ------
    InputError
        If the mass is not positive, the unbalance is negative, or a value is not finite or no pair.
    """

    mass: float
    speed: float | SpeedProfile
    unbalance: float = 0.0
    unbalance_angle: float = 0.0
    gravity: tuple[float, float] = (0.0, -STANDARD_GRAVITY)
    static_force: tuple[float, float] = (0.0, 0.0)
    position: tuple[float, float] = (0.0, 0.0)
    velocity: tuple[float, float] = (0.0, 0.0)

    def __post_init__(self) -> None:
        require_positive("mass", self.mass)
        require_non_negative("unbalance", self.unbalance)
        for name in ("unbalance_angle", *(() if isinstance(self.speed, SpeedProfile) else ("speed",))):
            require_number(name, getattr(self, name))
        for name in ("gravity", "static_force", "position", "velocity"):
            keep_pair(self, name)

    @property
    def static_load(self) -> Array:
        """External static force on the journal, mass * gravity + static_force, shape (2,) [N]."""
        return self.mass * np.array(self.gravity) + np.array(self.static_force)

    @property
    def inputs(self) -> tuple[Signal, ...]:
        """Signals force_x, force_y: the film force on the journal, nominally its weight."""
        return force_outputs(self.mass * STANDARD_GRAVITY)

    @property
    def outputs(self) -> tuple[Signal, ...]:
        """Signals x, y, vx, vy and speed, which are the inputs of a film."""
        return journal_inputs(NOMINAL_LENGTH, self.nominal_speed)

    @property
    def states(self) -> tuple[Signal, ...]:
        """Signals x, y, vx, vy of the journal center."""
        return self.outputs[: len(MOTION_NAMES)]

    @property
    def initial_state(self) -> Array:
        """The state (x, y, vx, vy) at t = 0, shape (4,) [m, m, m/s, m/s]."""
        return np.array([*self.position, *self.velocity])

    def unbalance_force(self, t: float) -> Array:
        """Return the force of the unbalance on the journal at the time t [s], shape (2,) [N]."""
        return self.unbalance * self.rotating(t, self.unbalance_angle)

    def derivative(self, t: float, x: ArrayLike, u: ArrayLike) -> Array:
        """Return d(x, y, vx, vy)/dt, shape (4,), at the time t [s] for u = (force_x, force_y) [N]."""
        state = np.asarray(x, dtype=float)
        force = np.asarray(u, dtype=float) + self._static_load + self.unbalance_force(t)
        return np.concatenate([state[2:], force / self.mass])

    def output(self, t: float, x: ArrayLike, u: ArrayLike) -> Array:
        """Return (x, y, vx, vy, speed) at the time t [s]; the input u is not used."""
        return np.concatenate([np.asarray(x, dtype=float), [self.profile.speed(t)]])

    def linearization(self, t: float, x: ArrayLike, u: ArrayLike) -> Linearization:
        """Return the exact derivatives, which are the same at every time, state and input."""
        A, B = np.zeros((4, 4)), np.zeros((4, 2))
        A[:2, 2:] = np.eye(2)
        B[2:] = np.eye(2) / self.mass
        return Linearization(A, B, np.eye(5, 4), np.zeros((5, 2)))

    def native(self) -> NativeSpec | None:
        """Return the kernel of the C library that is this rotor; None for a subclass, which may differ.

        Its parameters are those of the rotor, one for each component. A constant speed is a fixed parameter.
        """
        if type(self) is not RigidRotor:
            return None
        values = {name: getattr(self, name) for name in ("mass", "unbalance", "unbalance_angle")}
        for name in ("gravity", "static_force"):
            values |= {f"{name}_{axis}": value for axis, value in zip("xy", getattr(self, name), strict=True)}
        if len(self.profile.times) == 1:
            values["constant_speed"] = self.profile.speeds[0]
        return NativeSpec(
            kernel="rigid_rotor",
            parameters=tuple(native_parameter(name, float(value)) for name, value in values.items()),
            tables={"times": np.array(self.profile.times), "speeds": np.array(self.profile.speeds)},
        )

    @cached_property
    def operators(self) -> Operators:
        """The equations of motion of the states."""
        A, B, C, _ = self.linearization(0.0, self.initial_state, np.zeros(2))
        return Operators(
            steady=A,
            by_speed=np.zeros_like(A),
            push=B,
            weight=B @ self._static_load,
            unbalance=B @ unbalance_columns(self.unbalance, self.unbalance_angle),
            sense=C[:4],
        )

    @cached_property
    def structure(self) -> Structure:
        """The matrices of the rotor: a mass that nothing holds but its bearing."""
        none = np.zeros((2, 2))
        return Structure(
            mass=self.mass * np.eye(2),
            damping=none,
            gyroscopic=none,
            stiffness=none,
            circulation=none,
            stations=("",),
            journals=np.eye(2),
            weight=self._static_load,
            unbalance=unbalance_columns(self.unbalance, self.unbalance_angle),
            coordinates=(("{}", "m", NOMINAL_LENGTH),),
            readouts=(),
        )

    @cached_property
    def _static_load(self) -> Array:
        return self.static_load


def native_parameter(name: str, value: float) -> NativeParameter:
    """Return what a simulator may set in the compiled rotor, of `NATIVE_PARAMETERS`."""
    unit, description = NATIVE_PARAMETERS[name]
    minimum = 0.0 if name in ("mass", "unbalance") else -math.inf
    # A jump of the speed would turn the unbalance by an angle that depends on the time.
    return parameter(name, unit, value, description, tunable=name != "constant_speed", minimum=minimum)


# A rigid shaft that also tilts: four degrees of freedom or five, any number of bearings.


@quantities
@dataclass(frozen=True, kw_only=True)
class RigidShaft(FlexibleRotor):
    """A rigid rotor that translates and tilts, with gyroscopic effect: a Dynamic model.

    Parameters
    ----------
    mass : float [kg]
    diametral_inertia, polar_inertia : float [kg m2]
        Moments of inertia about a diameter through the mass center, and about the axis.
    stations : tuple of (str, float)
        Name and distance [m] from the mass center along z of each bearing; an empty name as in `Station`.
    speed : float or SpeedProfile [rad/s]
    unbalances : tuple of (float, float, float)
        Distance [m] from the mass center along z, mass times eccentricity [kg m] and angle from +x at t = 0
        [rad] of each unbalance.
    gravity : tuple of two floats [m/s2]
    initial : tuple of float
        State at t = 0: x, tilt_x, y, tilt_y of the mass center, z if it is axial, and their rates. Empty for
        rest at zero. Here tilt_x, tilt_y are the tilts dx/dz, dy/dz in both planes.
    axial : bool
        Whether it also moves along z. Then every station has z, vz and force_z.
    feels_tilt : bool
        Whether bearings may also resist its tilt. Then every station has tilt_x, tilt_y about +x and +y,
        their rates, moment_x and moment_y.

    Raises
    ------
    InputError
        If an argument breaks its rule.
    """

    mass: float
    diametral_inertia: float
    polar_inertia: float
    stations: tuple[tuple[str, float], ...]
    speed: float | SpeedProfile
    unbalances: tuple[tuple[float, float, float], ...] = ()
    gravity: tuple[float, float] = (0.0, -STANDARD_GRAVITY)
    initial: tuple[float, ...] = ()
    axial: bool = False
    feels_tilt: bool = False

    def __post_init__(self) -> None:
        require_each(self, require_positive, "mass", "diametral_inertia")
        require_non_negative("polar_inertia", self.polar_inertia)
        require_finite("stations", [place for _, place in self.stations])
        if require_finite("unbalances", self.unbalances).shape != (
            (len(self.unbalances), 3) if self.unbalances else (0,)
        ):
            raise InputError(f"unbalances must be triples of numbers, got {self.unbalances!r}")
        check_motion(self)

    def assembled(self) -> Structure:
        """Return the matrices of the rotor."""
        tilt = NOMINAL_LENGTH / max((abs(place) for _, place in self.stations if place), default=1.0)
        unbalance = np.zeros((4, 2))
        for place, amount, angle in self.unbalances:
            unbalance += np.kron(np.eye(2), [[1.0], [place]]) @ unbalance_columns(amount, angle)
        rows = [both_planes(np.array([[1.0, place]])) for _, place in self.stations]
        none: Array = np.zeros((4, 4))
        tilts = np.tile([[0.0, 0.0, 0.0, -1.0], [0.0, 1.0, 0.0, 0.0]], (len(rows), 1))
        planar = Structure(
            mass=both_planes(np.diag([self.mass, self.diametral_inertia])),
            damping=none,
            gyroscopic=across_planes(np.diag([0.0, self.polar_inertia])),
            stiffness=none,
            circulation=none,
            stations=checked_stations([name for name, _ in self.stations]),
            journals=np.concatenate(rows) if rows else np.zeros((0, 4)),
            weight=self.mass * np.array([self.gravity[0], 0.0, self.gravity[1], 0.0]),
            unbalance=unbalance,
            coordinates=(
                ("center_{}", "m", NOMINAL_LENGTH),
                ("tilt_{}", "rad", tilt),
            ),
            readouts=displacements("center", (0, 2), 4),
            tilts=tilts if self.feels_tilt else None,
        )
        if not self.axial:
            return planar
        still, rows_z = np.zeros((1, 1)), {"z": np.ones((len(rows), 1))}
        center = ("center_z", "m", NOMINAL_LENGTH)
        return extended(
            planar, [center], mass=self.mass * np.eye(1), damping=still, stiffness=still, rows=rows_z
        )


# The Jeffcott rotor: a disk in the middle of an elastic shaft, and the mass of its journals.


@quantities
@dataclass(frozen=True, kw_only=True)
class JeffcottRotor(FlexibleRotor):
    """One half of a symmetric Jeffcott rotor (a disk on an elastic shaft in two equal bearings).

    With u = x + i y of the disk and v of the journal,

        mass u'' + external_damping u' + internal_damping ((u - v)' - i w (u - v)) + stiffness (u - v) = ...
        journal_mass v'' - internal_damping ((u - v)' - i w (u - v)) - stiffness (u - v) = film force

    Parameters
    ----------
    mass : float [kg]
        Half the mass of the disk.
    journal_mass : float [kg]
        Mass of one journal, positive.
    stiffness : float [N/m]
        Half the stiffness of the shaft.
    speed : float or SpeedProfile [rad/s]
    external_damping : float [N s/m]
        Half the damping of the disk against the ground.
    internal_damping : float [N s/m]
        Half the damping of the rotating shaft.
    unbalance, unbalance_angle : float [kg m], [rad]
        Half the unbalance of the disk, and its angle from +x at t = 0.
    gravity : tuple of two floats [m/s2]
    initial : tuple of float
        State at t = 0; empty for a straight shaft at rest.
    disk_station : str
        Name of a station at the disk, for example for a rub ring; empty for none.

    Raises
    ------
    InputError
        If a mass or the stiffness is not positive, or another argument breaks its rule.
    """

    mass: float
    journal_mass: float
    stiffness: float
    speed: float | SpeedProfile
    external_damping: float = 0.0
    internal_damping: float = 0.0
    unbalance: float = 0.0
    unbalance_angle: float = 0.0
    gravity: tuple[float, float] = (0.0, -STANDARD_GRAVITY)
    initial: tuple[float, ...] = ()
    disk_station: str = ""

    def __post_init__(self) -> None:
        require_each(self, require_positive, "mass", "journal_mass", "stiffness")
        require_each(self, require_non_negative, "external_damping", "internal_damping", "unbalance")
        require_number("unbalance_angle", self.unbalance_angle)
        check_motion(self)

    def assembled(self) -> Structure:
        """Return the matrices of the rotor; node 0 is the disk, node 1 the journal."""
        names = ("", self.disk_station) if self.disk_station else ("",)
        places = np.array([[0.0, 1.0], [1.0, 0.0]])[: len(names)]
        spring = np.array([[1.0, -1.0], [-1.0, 1.0]])
        mass = np.diag([self.mass, self.journal_mass])
        inner = self.internal_damping * spring
        unbalance = np.zeros((4, 2))
        unbalance[[0, 2]] = unbalance_columns(self.unbalance, self.unbalance_angle)
        return Structure(
            mass=both_planes(mass),
            damping=both_planes(inner + np.diag([self.external_damping, 0.0])),
            gyroscopic=np.zeros((4, 4)),
            stiffness=both_planes(self.stiffness * spring),
            circulation=across_planes(inner),
            stations=names,
            journals=np.concatenate([both_planes(row[None]) for row in places]),
            weight=np.kron(self.gravity, np.diag(mass)),
            unbalance=unbalance,
            coordinates=tuple((f"{part}_{{}}", "m", NOMINAL_LENGTH) for part in ("disk", "journal")),
            # A station of that name has these outputs itself.
            readouts=() if "disk" in names else displacements("disk", (0, 2), 4),
        )
