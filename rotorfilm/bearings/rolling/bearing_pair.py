"""Two equal angular contact bearings on one shaft, mounted back to back, face to face or in tandem."""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np

from ...errors import InputError, require_kind, require_number, require_positive
from ...inputs.kinds import arguments
from ...inputs.si_arguments import quantities
from ...model import Array
from .ball_bearing import BallBearing
from .ball_element import BallElement
from .ball_law import BallLaw
from .elliptic_contact import EllipticContact


@quantities
@dataclass(frozen=True, kw_only=True)
class BearingPair(BallElement):
    """Two equal ball bearings on one shaft, preloaded against each other or in line: a Reaction as one is.

    `back_to_back`, `face_to_face` and `tandem` make the usual three. Displacements and moments are those of
    the shaft half-way between the rows. What the clamping has brought together stays so, and the preload
    changes with speed and growth: `running_preload` tells it.

    Parameters
    ----------
    bearing : BallBearing
        Each of the two; how its shaft is held, and its damping, do not count.
    distance : float [m]
        Of the rows along the shaft, spacers included.
    directions : (int, int)
        1 or -1: along z, of the thrust on the shaft that the first row, at -distance/2, and the second one
        carry.
    preload : float or None [N]
        Axial force with which the pair was clamped together, at rest, dry and without growth.
    spacer_offset : float or None [m]
        Axial approach of each row by the clamping, in place of the preload.
    axial_displacement : float [m]
        z of the shaft, where there is no `axial_load`.
    axial_load : float or None [N]
        External force on the shaft along z, to which z gives way.
    tilt : (float, float) [rad]
        Of the shaft about +x and +y.
    damping : float [N s/m]
        Viscous damping beside the balls along x and y.

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
        """Inner and outer contact of a ball."""
        return self.bearing.contacts

    @property
    def running(self) -> tuple[BallLaw, float]:
        """Law of the balls and growth of the inner rings [m], those of the bearing."""
        return self.bearing.running

    @property
    def cage_ratio(self) -> float:
        """Speed of the cages over that of the shaft, that of the bearing."""
        return self.bearing.cage_ratio

    def turned(self, angle: float) -> BearingPair:
        """Return the pair with its cages turned further [rad]."""
        return replace(self, bearing=self.bearing.turned(angle))

    @property
    def waves(self) -> Array:
        """Waves of the races of both rows, those of the bearing."""
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
        """Return the axial force [N] with which the rows press each other, with nothing else on the shaft.

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
    """Return a pair whose lines of contact meet the shaft outside of it (O arrangement); stiff against tilts.

    Parameters
    ----------
    bearing : BallBearing
    distance : float [m]
    preload : float [N], optional
    spacer_offset : float [m], optional
        As of a `BearingPair`.
    """
    return BearingPair(
        bearing=bearing, distance=distance, directions=(1, -1), preload=preload, spacer_offset=spacer_offset
    )


@arguments
def face_to_face(
    bearing: BallBearing, *, distance: float, preload: float | None = None, spacer_offset: float | None = None
) -> BearingPair:
    """Return a pair whose lines of contact meet the shaft towards its middle (X arrangement).

    Parameters
    ----------
    bearing, distance, preload, spacer_offset
        As of `back_to_back`.
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
        As of a `BearingPair`.
    """
    return BearingPair(bearing=bearing, distance=distance, directions=(1, 1), axial_load=axial_load)
