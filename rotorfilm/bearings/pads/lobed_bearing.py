"""The bearing of fixed pads, each about a center of curvature of its own, in SI units."""

from __future__ import annotations

from dataclasses import dataclass, field
from functools import cached_property
from typing import Self

import numpy as np
from numpy.typing import ArrayLike

from ...errors import (
    FilmContactError,
    InputError,
    require_each,
    require_kind,
    require_positive,
    require_tuple,
    require_vector,
)
from ...inputs.si_arguments import quantities
from ...model import Array
from ...native import JournalKernel
from ...native.response_kernels import LobePlace, LobesKernel
from ...signals import Signal, force_outputs, journal_inputs
from ..films.kernel_film import BoundKernel
from ..reaction import NOMINAL_SPEED, FilmReaction
from .lobe import Lobe, require_apart
from .pad_films import PadFilm, PadGridFilm


@dataclass(frozen=True, eq=False)
class BoundLobes(BoundKernel):
    """The films of the pads of one bearing in SI units.

    Parameters
    ----------
    kernel : LobesKernel
        The compiled films.
    clearance : float [m]
        Of a pad.
    lobes : tuple of Lobe
    """

    lobes: tuple[Lobe, ...]

    def require_inside(self, position: Array) -> None:
        """Raise FilmContactError, which names the pad, where a journal at a position (2,) [m] touches."""
        films = [self.clearance * float(lobe.least_film(position / self.clearance)) for lobe in self.lobes]
        touched = int(np.argmin(films))
        if not films[touched] > 0.0:
            raise FilmContactError(
                f"position must leave a film on every pad, got {position.tolist()} m with a film of "
                f"{films[touched]:.6g} m on lobe {touched}, {self.lobes[touched]!r}"
            )


@quantities
@dataclass(frozen=True, kw_only=True)
class LobedBearing(FilmReaction):
    """A journal bearing of fixed pads, such as an elliptical one: a Reaction and a static Model.

    x and y are Cartesian from the bearing center, rotation is about +z, the force acts on the journal. The
    film of a pad knows the journal only from the pad's own center of curvature (Lund & Thomsen 1978); that of
    the bearing is their sum. Eccentricity ratios are in pad clearances.

    Parameters
    ----------
    radius : float [m]
        Journal radius; or `diameter`, twice that.
    length : float [m]
        Axial length.
    clearance : float [m]
        Radial clearance c_p of a pad: its radius of curvature less that of the journal. The assembled
        clearance, of the largest journal that fits in, is (1 - preload) c_p.
    viscosity : float [Pa s]
        Dynamic viscosity of the lubricant.
    lobes : tuple of Lobe
        The pads; `lobe_set` makes the usual sets.
    film : PadFilm
        The film law of the pads.

    Raises
    ------
    InputError
        If a dimension is not finite and positive, the clearance is not below the radius, there is no lobe, or
        lobes overlap.

    Examples
    --------
    >>> lobes = lobe_set("elliptical", preload=0.5)
    >>> bearing = LobedBearing(radius=0.05, length=0.05, clearance=1e-4, viscosity=0.02, lobes=lobes)
    >>> bearing.force(position=[0.0, -3e-5], velocity=[0.0, 0.0], speed=300.0).shape
    (2,)
    """

    radius: float
    length: float
    clearance: float
    viscosity: float
    lobes: tuple[Lobe, ...]
    film: PadFilm = field(default_factory=PadGridFilm)

    def __post_init__(self) -> None:
        require_each(self, require_positive, "radius", "length", "clearance", "viscosity")
        if self.clearance >= self.radius:
            raise InputError(f"clearance must be below the radius {self.radius!r}, got {self.clearance!r}")
        require_tuple("lobes", self.lobes, Lobe)
        if not self.lobes:
            raise InputError("lobes must have one at least, got ()")
        require_apart(self.lobes)
        require_kind("film", self.film, PadFilm, "a film law of a pad with pad_kernel")

    @classmethod
    def assembled(
        cls,
        *,
        radius: float,
        length: float,
        assembled_clearance: float,
        viscosity: float,
        lobes: tuple[Lobe, ...],
        film: PadFilm | None = None,
    ) -> Self:
        """Return a bearing by its assembled clearance, as drawings and ROSS (`radial_clearance`) have it.

        Parameters
        ----------
        radius, length : float [m]
        assembled_clearance : float [m]
            Radial clearance of the largest journal that fits in, (1 - preload) c_p.
        viscosity : float [Pa s]
        lobes : tuple of Lobe
            All of one preload.
        film : PadFilm, optional

        Raises
        ------
        InputError
            If the lobes have different preloads, or as the class does.
        """
        require_positive("assembled_clearance", assembled_clearance)
        preloads = {lobe.preload for lobe in lobes}
        if len(preloads) != 1:
            raise InputError(
                f"lobes must have one preload for an assembled clearance, got {sorted(preloads)}"
            )
        clearance = assembled_clearance / (1.0 - preloads.pop())
        law = {} if film is None else {"film": film}
        return cls(radius=radius, length=length, clearance=clearance, viscosity=viscosity, lobes=lobes, **law)

    @property
    def slenderness(self) -> float:
        """Length / diameter [1]."""
        return self.length / (2.0 * self.radius)

    @property
    def force_scale(self) -> float:
        """Viscosity * length * radius^3 / clearance^2 [N s], the unit of force of a pad per 1/s."""
        return self.viscosity * self.length * self.radius**3 / self.clearance**2

    @property
    def inputs(self) -> tuple[Signal, ...]:
        """Signals x, y, vx, vy, speed."""
        return journal_inputs(self.clearance, NOMINAL_SPEED)

    @property
    def outputs(self) -> tuple[Signal, ...]:
        """Signals force_x, force_y: the force on the journal."""
        return force_outputs(self.force_scale * NOMINAL_SPEED * min(1.0, self.slenderness**2))

    def minimum_film(self, position: ArrayLike) -> Array:
        """Return the least film on any pad [m], shape (...), of journals at positions (2, ...) [m].

        It is not positive where the journal touches.
        """
        at = require_vector("position", position) / self.clearance
        return self.clearance * np.min([lobe.least_film(at) for lobe in self.lobes], axis=0)

    @cached_property
    def bound_film(self) -> BoundLobes:
        """The films of the pads tied to the dimensions of this bearing."""
        extents = {lobe.extent: self.film.pad_kernel(lobe.extent, self.slenderness) for lobe in self.lobes}
        films = [JournalKernel(extents[lobe.extent], self.clearance, self.force_scale) for lobe in self.lobes]
        places = [
            LobePlace(lobe.middle, (self.clearance * lobe.center[0], self.clearance * lobe.center[1]))
            for lobe in self.lobes
        ]
        return BoundLobes(LobesKernel(films, places), self.clearance, self.lobes)
