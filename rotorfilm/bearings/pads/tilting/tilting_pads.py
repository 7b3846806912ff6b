"""Tilting pads by their numbers: geometry, clearances, inertia, and the compiled bearing that they are."""

from __future__ import annotations

import math
from dataclasses import dataclass, field
from functools import cached_property

import numpy as np
from numpy.typing import ArrayLike

from ....errors import (
    InputError,
    brief,
    require_finite,
    require_non_negative,
    require_number,
    require_positive,
    require_vector,
)
from ....inputs.si_arguments import quantities
from ....model import Array
from ....native.pads.tilting_kernel import TiltingKernel
from ..pad_bearing import PadBearing
from ..pad_film import PadFilm, PadMapFilm, film_for_preload, require_pad_film
from .pivots import directions, gaps, reach


@quantities
@dataclass(frozen=True, kw_only=True)
class TiltingPads(PadBearing):
    """Equal tilting pads around a journal.

    Dimensions, clearance and lubricant are given as to every `PadBearing`; the assembled clearance c_b is the
    gap at a pivot around a centered journal. Eccentricities of ROSS and Someya are over c_b, those of Lund
    and Thomsen over c_p.

    Parameters
    ----------
    pivots : tuple of floats [rad]
        Angles of the pivots; `even_pivots` has them for a load on or between pads.
    extent : float [rad]
        Angle that a pad covers, below pi.
    pivot_offset : float [1]
        Share of a pad before its pivot, from its start in the positive sense: .5 in the middle, more
        towards the trailing end of a journal that turns in that sense.
    preload : float [1]
        1 - c_b / c_p, below 1.
    pivot_stiffness : float or None [N/m]
        Of a spring below each pivot, along its direction; None for rigid ones.
    pad_inertia : float or None [kg m2]
        Of a pad about its pivot; None for pads that follow at once.
    pivot_distance : float [m]
        From the film back to the center about which a pad rolls or rocks.
    pad_mass : float or None [kg]
        That moves with the pivot; needed with `pivot_stiffness` and `pad_inertia` together, and only then.
    start : tuple of floats [m]
        Tilts of the pads at t = 0, as lengths, and after them deflections of pivots on springs; empty for
        those at rest around a centered journal that turns in the positive sense.
    film : PadFilm
        The film law of a pad.

    Raises
    ------
    InputError
        As a `PadBearing`, and if another value breaks its rule, or the film cannot be that of pads of this
        extent and length/diameter.
    """

    pivots: tuple[float, ...]
    extent: float
    pivot_offset: float = 0.5
    preload: float = 0.0
    pivot_stiffness: float | None = None
    pad_inertia: float | None = None
    pivot_distance: float = 0.0
    pad_mass: float | None = None
    start: tuple[float, ...] = ()
    film: PadFilm = field(default_factory=PadMapFilm)

    def __post_init__(self) -> None:
        require_positive("extent", self.extent)
        require_non_negative("pivot_distance", self.pivot_distance)
        for name in ("pivot_stiffness", "pad_inertia", "pad_mass"):
            if getattr(self, name) is not None:
                require_positive(name, getattr(self, name))
        if self.extent >= math.pi:
            raise InputError(f"extent must be below pi, got {self.extent!r}")
        if not 0.0 < require_number("pivot_offset", self.pivot_offset) < 1.0:
            raise InputError(f"pivot_offset must be within 0 and 1, got {self.pivot_offset!r}")
        if require_number("preload", self.preload) >= 1.0:
            raise InputError(f"preload must be below 1, got {self.preload!r}")
        super().__post_init__()
        heavy = self.pivot_stiffness is not None and self.pad_inertia is not None
        if heavy != (self.pad_mass is not None):
            rule = "with both pivot_stiffness and pad_inertia, and only then"
            raise InputError(f"pad_mass must be given {rule}, got {self.pad_mass!r}")
        object.__setattr__(self, "film", film_for_preload(self.film, self.preloads))
        require_pad_film(self.film, self.extents, self.slenderness)
        self._check_pivots()

    def _check_pivots(self) -> None:
        angles = require_finite("pivots", self.pivots)
        if angles.ndim != 1 or not angles.size or np.min(gaps(angles)) < self.extent * (1.0 - 1e-12):
            rule = f"angles at least the extent {self.extent!r} apart"
            raise InputError(f"pivots must be {rule}, got {brief(self.pivots)}")
        start = require_finite("start", self.start)
        if start.shape not in ((0,), (self.coordinates,)):
            raise InputError(f"start must hold no or {self.coordinates} numbers, got {brief(self.start)}")
        object.__setattr__(self, "pivots", tuple(angles.tolist()))
        object.__setattr__(self, "start", tuple(start.tolist()))

    @property
    def preloads(self) -> tuple[float]:
        """The preload of all pads [1]."""
        return (self.preload,)

    @property
    def extents(self) -> tuple[float]:
        """The angle that all pads cover [rad]."""
        return (self.extent,)

    @property
    def room(self) -> float:
        """Distance [m] that the journal center stays within: the farthest corner that rigid pivots leave.

        Pivots on springs may give way: twice that. The pads themselves say where they are touched.
        """
        return self.bore_clearance * reach(self.pivots) * self._yielding

    def minimum_film(self, position: ArrayLike) -> Array:
        """Return the least gap at a pivot [m], shape (...), of journals at positions (2, ...) [m].

        It is not positive where no tilt leaves a film; of pivots on springs that may give way it is larger by
        the assembled clearance.
        """
        along = np.tensordot(directions(self.pivots)[:, :, 0], require_vector("position", position), 1)
        return np.asarray(self.bore_clearance * self._yielding - along.max(axis=0))

    @property
    def _yielding(self) -> float:
        return 1.0 if self.pivot_stiffness is None else 2.0

    @property
    def reduced_inertia(self) -> float:
        """Inertia of a pad over the square of the distance from its center of rotation to the film [kg]."""
        return (self.pad_inertia or 0.0) / (self.radius + self.pivot_distance) ** 2

    @cached_property
    def kernel(self) -> TiltingKernel:
        """The bearing in compiled code; InputError without a stated temperature."""
        self.require_temperature()
        return TiltingKernel(
            self.film.kernel(self.extent, self.slenderness),
            self.extent,
            self.pivot_offset,
            np.array(self.pivots),
            self.preload,
            self.clearance,
            self.force_scale,
            self.pivot_stiffness or 0.0,
            self.reduced_inertia,
            self.pad_mass or 0.0,
        )

    @property
    def coordinates(self) -> int:
        """Number of coordinates of all pads: tilts, and places of pivots on springs."""
        return len(self.pivots) * (1 if self.pivot_stiffness is None else 2)

    def moving(self, places: Array) -> Array:
        """Return the states of pads in these places, all rates 0."""
        return places if self.pad_inertia is None else np.concatenate([places, np.zeros_like(places)])
