"""A ball bearing by its dimensions, deep groove or angular contact, in SI units."""

from __future__ import annotations

import math
from dataclasses import dataclass, field, replace
from functools import cached_property

import numpy as np

from ...core.errors import (
    InputError,
    require_count,
    require_each,
    require_finite,
    require_kind,
    require_number,
    require_positive,
)
from ...core.inputs import arguments, quantities
from ...core.model import Array
from ...native.ball_kernel import ROW, WAVE
from .ball_element import BallElement, BallLaw, EllipticContact, RunningBalls

# What balls and rings are made of.


@quantities
@dataclass(frozen=True, kw_only=True)
class RollingMaterial:
    """An elastic material of balls or rings; `steel` and `silicon_nitride` are the usual two.

    Parameters
    ----------
    young_modulus : float [Pa]
        Elastic modulus.
    poisson_ratio : float [1]
        Above -1 and at most 0.5.
    density : float [kg/m3]
        Mass per volume.

    Raises
    ------
    InputError
        If an argument breaks its rule.
    """

    young_modulus: float
    poisson_ratio: float
    density: float

    def __post_init__(self) -> None:
        require_each(self, require_positive, "young_modulus", "density")
        if not -1.0 < require_number("poisson_ratio", self.poisson_ratio) <= 0.5:
            raise InputError(f"poisson_ratio must be above -1 and at most 0.5, got {self.poisson_ratio!r}")

    @classmethod
    def steel(cls) -> RollingMaterial:
        """Return bearing steel by usual figures of catalogs: 207 GPa, 0.3, 7800 kg/m3."""
        return cls(young_modulus=207e9, poisson_ratio=0.3, density=7800.0)

    @classmethod
    def silicon_nitride(cls) -> RollingMaterial:
        """Return the ceramic of hybrid bearings by usual figures of catalogs: 314 GPa, 0.26, 3200 kg/m3."""
        return cls(young_modulus=314e9, poisson_ratio=0.26, density=3200.0)

    @property
    def compliance(self) -> float:
        """Compliance of the material in a contact, (1 - nu^2)/E [1/Pa]."""
        return (1.0 - self.poisson_ratio**2) / self.young_modulus


# Waves of the races of a ball bearing.


@quantities
@dataclass(frozen=True, kw_only=True)
class Waviness:
    """One wave of the races of one ring: amplitude cos(lobes (angle - angle of the ring) + phase).

    With Z balls, m Z lobes move the shaft axially and change its stiffness; m Z + 1 and m Z - 1 lobes move it
    radially.

    Parameters
    ----------
    inner : bool
        Whether it is on the inner ring, which turns, or on the outer ring, which is fixed.
    lobes : int
        Number of waves around the circumference.
    radial_amplitude : float [m]
        Radial amplitude, added to the distance of the groove centers: positive where it reduces the
        clearance.
    axial_amplitude : float [m]
        Axial amplitude, along the thrust that the row carries.
    phase : float [rad]
        Phase at the angle of the ring, from +x.

    Raises
    ------
    InputError
        If an argument breaks its rule.
    """

    inner: bool
    lobes: int
    radial_amplitude: float
    axial_amplitude: float = 0.0
    phase: float = 0.0

    def __post_init__(self) -> None:
        require_count("lobes", self.lobes)
        require_each(self, require_number, "radial_amplitude", "axial_amplitude", "phase")

    @property
    def numbers(self) -> tuple[float, float, float, float, float]:
        """The wave, as the compiled kernel reads it."""
        return float(self.inner), float(self.lobes), self.radial_amplitude, self.axial_amplitude, self.phase


# A ball bearing by its dimensions, deep groove or angular contact, in SI units.


@quantities
@dataclass(frozen=True, kw_only=True)
class BallBearing(BallElement):
    """A deep groove or angular contact ball bearing, its outer ring fixed: a Reaction and a static Model.

    Give the radial internal clearance of a deep groove bearing, whose rings face each other at z = 0, or the
    contact angle of an angular contact bearing, whose balls just touch at z = 0 and which carries thrust
    along +z. Under a rotor the shaft moves along x and y only. Its tilts are fixed, and z is fixed or follows
    from an axial load. `wrench`, `stiffness` and `rest` use all five degrees of freedom.

    Parameters
    ----------
    balls : int
        Number of balls.
    ball_diameter : float [m]
        Diameter of a ball.
    pitch_diameter : float [m]
        Diameter of the circle on which the ball centers lie.
    internal_clearance : float or None [m]
        Radial internal clearance as in catalogs (ISO 5753): the whole radial travel of one ring in the other.
        Negative for a preload by a tight fit.
    contact_angle : float or None [rad]
        Contact angle of the unloaded balls, in place of the clearance.
    inner_conformity : float [1]
        Radius of the inner groove over the diameter of the ball.
    outer_conformity : float [1]
        Radius of the outer groove over the diameter of the ball.
    ball_material, ring_material : RollingMaterial
        Steel by default.
    growth : float [m]
        Radial growth of the inner ring against the outer one, by fits, heat and rotation.
    films : (float, float) [m]
        Oil film thickness of the inner and the outer contact, as from `ball_films`: the contacts carry K (d +
        film)^1.5.
    law : BallLaw
        `RunningBalls()` (friction at both races), `RaceControl()` or, for low speeds, `StaticBalls()`.
    axial_displacement : float [m]
        z of the shaft, where there is no `axial_load`.
    axial_load : float or None [N]
        External force on the shaft along z, which then determines z.
    tilt : (float, float) [rad]
        Tilt of the shaft about +x and +y.
    cage_angle : float [rad]
        Where the first ball is, from +x towards +y.
    damping : float [N s/m]
        Viscous damping in parallel with the balls along x and y, measured or assumed; dry contacts have none.
    waviness : tuple of Waviness
        Waviness of the races. Waves of the inner race are at the shaft angle 0 where the angle is not known.

    Raises
    ------
    InputError
        If an argument breaks its rule.

    Examples
    --------
    >>> bearing = BallBearing(
    ...     balls=9, ball_diameter=9.525e-3, pitch_diameter=46e-3, internal_clearance=10e-6
    ... )
    >>> bearing.force(position=[0.0, -12e-6], velocity=[0.0, 0.0], speed=300.0).shape
    (2,)
    """

    balls: int
    ball_diameter: float
    pitch_diameter: float
    internal_clearance: float | None = None
    contact_angle: float | None = None
    inner_conformity: float = 0.52
    outer_conformity: float = 0.52
    ball_material: RollingMaterial = field(default_factory=RollingMaterial.steel)
    ring_material: RollingMaterial = field(default_factory=RollingMaterial.steel)
    growth: float = 0.0
    films: tuple[float, float] = (0.0, 0.0)
    law: BallLaw = field(default_factory=RunningBalls)
    axial_displacement: float = 0.0
    axial_load: float | None = None
    tilt: tuple[float, float] = (0.0, 0.0)
    cage_angle: float = 0.0
    damping: float = 0.0
    waviness: tuple[Waviness, ...] = ()

    def __post_init__(self) -> None:
        require_count("balls", self.balls, 3)
        require_each(self, require_positive, "ball_diameter", "pitch_diameter")
        require_each(self, require_number, "growth", "cage_angle")
        room = self.pitch_diameter * math.sin(math.pi / self.balls)
        if self.ball_diameter > room:
            raise InputError(
                f"balls must fit on the pitch circle, which has {room:.4g} m for each, got {self.balls} "
                f"balls of {self.ball_diameter!r} m"
            )
        for name in ("inner_conformity", "outer_conformity"):
            if not 0.5 < require_number(name, getattr(self, name)) < 0.75:
                raise InputError(f"{name} must be above 0.5 and below 0.75, got {getattr(self, name)!r}")
        for name in ("ball_material", "ring_material"):
            require_kind(name, getattr(self, name), RollingMaterial, "a RollingMaterial")
        require_kind("law", self.law, BallLaw, "RunningBalls(), RaceControl() or StaticBalls()")
        for number, wave in enumerate(self.waviness):
            require_kind(f"waviness[{number}]", wave, Waviness, "a Waviness")
        self._require_films()
        self._require_one_of_both()
        self.require_place()

    def _require_films(self) -> None:
        films = require_finite("films", self.films)
        if films.shape != (2,) or not (np.all(films >= 0.0) and np.all(films < 0.5 * np.array(self.reaches))):
            raise InputError(
                "films must be two thicknesses far below the distances between ball center and groove "
                f"centers, {self.reaches!r} m, got {self.films!r}"
            )

    def _require_one_of_both(self) -> None:
        given = {"internal_clearance": self.internal_clearance, "contact_angle": self.contact_angle}
        if sum(value is not None for value in given.values()) != 1:
            raise InputError(f"internal_clearance or contact_angle must be given, and not both, got {given}")
        if self.contact_angle is not None and not 0.0 <= require_number(
            "contact_angle", self.contact_angle
        ) < math.radians(75.0):
            raise InputError(f"contact_angle must be 0 to 75 deg, got {self.contact_angle!r} rad")
        if (
            self.internal_clearance is not None
            and not abs(require_number("internal_clearance", self.internal_clearance)) < self.groove_distance
        ):
            raise InputError(
                f"internal_clearance must be below the distance of the groove centers "
                f"{self.groove_distance:.4g} m, got {self.internal_clearance!r}"
            )

    @property
    def running(self) -> tuple[BallLaw, float]:
        """The law of the balls, and the growth of the inner ring [m]."""
        return self.law, self.growth

    @property
    def cage_ratio(self) -> float:
        """Speed of the cage over that of the shaft at the free contact angle."""
        return 0.5 * (1.0 - self.ball_diameter / self.pitch_diameter * math.cos(self.free_contact_angle))

    def turned(self, angle: float) -> BallBearing:
        """Return the bearing with its cage turned further [rad]."""
        return replace(self, cage_angle=self.cage_angle + angle)

    @property
    def waves(self) -> Array:
        """Waves of the races as the compiled kernel reads them, shape (waves, columns)."""
        return np.array([wave.numbers for wave in self.waviness]).reshape(-1, len(WAVE))

    @property
    def separates(self) -> bool:
        """Whether this is an angular contact bearing, whose rings separate under a thrust along -z."""
        return bool(self.contact_angle)

    @property
    def reaches(self) -> tuple[float, float]:
        """Distances [m] of a ball's center from the centers of the inner and outer groove at first touch."""
        D = self.ball_diameter
        return (self.inner_conformity - 0.5) * D, (self.outer_conformity - 0.5) * D

    @property
    def groove_distance(self) -> float:
        """Distance A of the centers of curvature of both grooves when the balls first touch [m]."""
        return sum(self.reaches)

    @property
    def free_contact_angle(self) -> float:
        """Contact angle [rad] of the unloaded balls under thrust; 0 without clearance."""
        if self.contact_angle is not None:
            return self.contact_angle
        assert self.internal_clearance is not None  # one of both is given
        return math.acos(min(1.0, 1.0 - self.internal_clearance / (2.0 * self.groove_distance)))

    @cached_property
    def contacts(self) -> tuple[EllipticContact, EllipticContact]:
        """Inner and outer contact of a ball, at the free contact angle."""
        return self.contacts_at(self.free_contact_angle, self.free_contact_angle)

    def contacts_at(self, inner_angle: float, outer_angle: float) -> tuple[EllipticContact, EllipticContact]:
        """Return the inner and the outer contact of a ball at given contact angles [rad]."""
        compliance = self.ball_material.compliance + self.ring_material.compliance
        sides = (1.0, self.inner_conformity, inner_angle), (-1.0, self.outer_conformity, outer_angle)
        found = []
        for side, conformity, angle in sides:
            cosine = math.cos(angle)
            race = 2.0 * cosine / (self.pitch_diameter - side * self.ball_diameter * cosine)
            groove = (2.0 - 1.0 / conformity) / self.ball_diameter
            found.append(
                EllipticContact(
                    rolling_radius=1.0 / (2.0 / self.ball_diameter + side * race),
                    groove_radius=1.0 / groove,
                    combined_modulus=2.0 / compliance,
                )
            )
        return found[0], found[1]

    @property
    def ball_mass(self) -> float:
        """Mass of a ball [kg]."""
        return self.ball_material.density * math.pi / 6.0 * self.ball_diameter**3

    @property
    def rows(self) -> Array:
        """The row of balls as the compiled kernel reads it, shape (1, columns)."""
        angle, distance = self.free_contact_angle, self.groove_distance
        radial = distance * math.cos(angle)
        if self.internal_clearance is not None:
            radial = distance - 0.5 * self.internal_clearance
        (reach, outer_reach), (inner, outer) = self.reaches, self.contacts
        row = {
            "place": 0.0,
            "direction": 1.0,
            "axial": distance * math.sin(angle) if self.separates else 0.0,
            "radial": radial,
            "arm": 0.5 * self.pitch_diameter + reach * math.cos(angle),
            "count": self.balls,
            "turn": self.cage_angle,
            "inner": reach - self.films[0],
            "outer": outer_reach - self.films[1],
            "inner_stiffness": inner.stiffness,
            "outer_stiffness": outer.stiffness,
            "ratio": self.ball_diameter / self.pitch_diameter,
            "diameter": self.ball_diameter,
            "mass": self.ball_mass,
            "largest": self.largest_load,
            "inner_reach": inner.friction_lever(1.0),
            "outer_reach": outer.friction_lever(1.0),
        }
        return np.array([[row[name] for name in ROW]])


# Two equal angular contact bearings on one shaft, mounted back to back, face to face or in tandem.


@quantities
@dataclass(frozen=True, kw_only=True)
class BearingPair(BallElement):
    """A pair of equal ball bearings on one shaft, preloaded against each other or in tandem: a Reaction.

    `back_to_back`, `face_to_face` and `tandem` make the usual three. Displacements and moments are those of
    the shaft half-way between the rows. The axial approach by clamping stays constant, so the preload changes
    with speed and thermal growth: `running_preload` returns it.

    Parameters
    ----------
    bearing : BallBearing
        One of the two bearings; its damping and its axial settings are not used.
    distance : float [m]
        Distance of the rows along the shaft, spacers included.
    directions : (int, int)
        Direction along z (1 or -1) of the thrust on the shaft that each row carries: first the row at
        -distance/2, then the other.
    preload : float or None [N]
        Axial force with which the pair was clamped together, at rest, dry and without growth.
    spacer_offset : float or None [m]
        Axial approach of each row by the clamping, in place of the preload.
    axial_displacement : float [m]
        z of the shaft, where there is no `axial_load`.
    axial_load : float or None [N]
        External force on the shaft along z, which then determines z.
    tilt : (float, float) [rad]
        Tilt of the shaft about +x and +y.
    damping : float [N s/m]
        Viscous damping in parallel with the balls along x and y.

    Raises
    ------
    InputError
        If an argument breaks its rule, or both preload and spacer_offset are given.
    """

    bearing: BallBearing
    distance: float
    directions: tuple[int, int]
    preload: float | None = None
    spacer_offset: float | None = None
    axial_displacement: float = 0.0
    axial_load: float | None = None
    tilt: tuple[float, float] = (0.0, 0.0)
    damping: float = 0.0

    def __post_init__(self) -> None:
        require_kind("bearing", self.bearing, BallBearing, "a BallBearing")
        require_positive("distance", self.distance)
        if not isinstance(self.directions, tuple) or self.directions not in _DIRECTIONS:
            raise InputError(f"directions must be a tuple of two of 1 and -1, got {self.directions!r}")
        given = {name: getattr(self, name) for name in ("preload", "spacer_offset")}
        told = {name: value for name, value in given.items() if value is not None}
        if len(told) > 1:
            raise InputError(f"preload or spacer_offset must be given, not both, got {given}")
        if self.directions[0] == self.directions[1] and told:
            raise InputError(
                f"directions of a pair with {', '.join(told)} must differ, got {self.directions!r}"
            )
        if self.preload is not None:
            require_positive("preload", self.preload)
        if self.spacer_offset is not None:
            require_number("spacer_offset", self.spacer_offset)
        self.require_place()

    @property
    def contacts(self) -> tuple[EllipticContact, EllipticContact]:
        """The contacts of a ball with the inner and the outer race."""
        return self.bearing.contacts

    @property
    def running(self) -> tuple[BallLaw, float]:
        """Law of the balls and growth of the inner rings [m], as in the single bearing."""
        return self.bearing.running

    @property
    def cage_ratio(self) -> float:
        """Speed of the cages over that of the shaft, as in the single bearing."""
        return self.bearing.cage_ratio

    def turned(self, angle: float) -> BearingPair:
        """Return the pair with its cages turned further [rad]."""
        return replace(self, bearing=self.bearing.turned(angle))

    @property
    def waves(self) -> Array:
        """Waves of the races of both rows, as in the single bearing."""
        return self.bearing.waves

    @property
    def separates(self) -> bool:
        """Whether both rows carry thrust of one direction only."""
        return self.bearing.separates and self.directions[0] == self.directions[1]

    @cached_property
    def approach(self) -> float:
        """Axial approach of each row by the clamping [m]."""
        if self.spacer_offset is not None:
            return self.spacer_offset
        if self.preload is None:
            return 0.0
        still = replace(self.bearing, growth=0.0, films=(0.0, 0.0))
        return float(still.rest((0.0, 0.0, self.preload, 0.0, 0.0)).displacement[2])

    @property
    def rows(self) -> Array:
        """Both rows of balls as the compiled kernel reads them, shape (2, columns)."""
        rows = np.repeat(self.bearing.rows, 2, axis=0)
        rows[:, 0] = -0.5 * self.distance, 0.5 * self.distance
        rows[:, 1] = self.directions
        rows[:, 2] += self.approach
        return rows

    def running_preload(self, speed: float = 0.0) -> float:
        """Return the preload at speed [N]: the axial force between the rows without an external load.

        Parameters
        ----------
        speed : float [rad/s]
            Angular speed about +z.
        """
        return -float(self.bearing.wrench((0.0, 0.0, self.approach, 0.0, 0.0), speed)[2])


_DIRECTIONS = {(1, -1), (-1, 1), (1, 1), (-1, -1)}


@arguments
def back_to_back(
    bearing: BallBearing, *, distance: float, preload: float | None = None, spacer_offset: float | None = None
) -> BearingPair:
    """Return a pair in O arrangement, whose lines of contact diverge towards the shaft; stiff against tilts.

    Parameters
    ----------
    bearing : BallBearing
    distance : float [m]
    preload : float [N], optional
    spacer_offset : float [m], optional
        Spacer offset as for a `BearingPair`.
    """
    return BearingPair(
        bearing=bearing, distance=distance, directions=(1, -1), preload=preload, spacer_offset=spacer_offset
    )


@arguments
def face_to_face(
    bearing: BallBearing, *, distance: float, preload: float | None = None, spacer_offset: float | None = None
) -> BearingPair:
    """Return a pair in X arrangement, whose lines of contact converge towards the shaft.

    Parameters
    ----------
    bearing, distance, preload, spacer_offset
        As in `back_to_back`.
    """
    opposite = back_to_back(bearing, distance=distance, preload=preload, spacer_offset=spacer_offset)
    return replace(opposite, directions=(-1, 1))


@arguments
def tandem(bearing: BallBearing, *, distance: float, axial_load: float | None = None) -> BearingPair:
    """Return a pair that shares the thrust along +z.

    Parameters
    ----------
    bearing : BallBearing
    distance : float [m]
    axial_load : float [N], optional
        Axial load as for a `BearingPair`.
    """
    return BearingPair(bearing=bearing, distance=distance, directions=(1, 1), axial_load=axial_load)
