"""The bearing of fixed pads, each about a center of curvature of its own, in SI units."""

from __future__ import annotations

from dataclasses import dataclass, field, replace
from functools import cached_property

import numpy as np
from numpy.typing import ArrayLike

from ...errors import (
    FilmContactError,
    InputError,
    require_tuple,
    require_vector,
)
from ...inputs.si_arguments import quantities
from ...model import Array
from ...native import JournalKernel, Status
from ...native.journal_spec import journal_spec
from ...native.response_kernels import LobePlace, LobesKernel
from ...native.spec import NativeSpec
from ...results import BearingLosses
from ..films.kernel_film import BoundKernel
from ..reaction import FilmReaction, broadcast_state
from .heat_of_pads import SPEED, PadSlopes, heat_slopes_of_pads
from .lobe import Lobe, require_apart
from .losses_of_pads import PadUnderJournal, losses_of_pads
from .pad_bearing import PadBearing
from .pad_film import PadFilm, PadMapFilm, film_for_preload, require_pad_film, warn_beyond_map
from .pad_losses import LossyPadFilm

_WEDGE = np.array([[0.0, 1.0], [-1.0, 0.0]])
"""-z^ x, which makes the wedge of an eccentricity."""


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

    def films(self, position: Array) -> list[float]:
        """Return the least film on each pad [m] of a journal at a position (2,) [m]."""
        return [self.clearance * float(lobe.least_film(position / self.clearance)) for lobe in self.lobes]

    def require_inside(self, position: Array) -> None:
        """Raise FilmContactError, which names the pad, where a journal at a position (2,) [m] touches."""
        films = self.films(position)
        touched = int(np.argmin(films))
        if not films[touched] > 0.0:
            raise FilmContactError(
                f"position must leave a film on every pad, got {position.tolist()} m with a film of "
                f"{films[touched]:.6g} m on lobe {touched}, {self.lobes[touched]!r}"
            )

    def report(self, status: int, x: float, y: float, vx: float, vy: float, speed: float) -> None:
        """Raise, or warn, about a state that has this status."""
        if status == Status.OUTSIDE:
            warn_beyond_map(self.films(np.array([x, y])), self.kernel.film)
        else:
            super().report(status, x, y, vx, vy, speed)


@quantities
@dataclass(frozen=True, kw_only=True)
class LobedBearing(FilmReaction, PadBearing):
    """A journal bearing of fixed pads, such as an elliptical one: a Reaction and a static Model.

    x and y are Cartesian from the bearing center, rotation is about +z, the force acts on the journal. The
    film of a pad knows the journal only from the pad's own center of curvature (Lund & Thomsen 1978); that of
    the bearing is their sum. Eccentricity ratios are in pad clearances. Dimensions, clearance and lubricant
    are given as to every `PadBearing`.

    Parameters
    ----------
    lobes : tuple of Lobe
        The pads; `lobe_set` makes the usual sets.
    film : PadFilm
        The film law of the pads.

    Raises
    ------
    InputError
        As a `PadBearing`, and if there is no lobe, lobes overlap, or the film cannot be that of their extents
        and length/diameter.

    Examples
    --------
    >>> lobes = lobe_set("elliptical", preload=0.5)
    >>> bearing = LobedBearing(radius=0.05, length=0.05, pad_clearance=1e-4, viscosity=0.02, lobes=lobes)
    >>> bearing.force(position=[0.0, -3e-5], velocity=[0.0, 0.0], speed=300.0).shape
    (2,)
    """

    lobes: tuple[Lobe, ...]
    film: PadFilm = field(default_factory=PadMapFilm)

    def __post_init__(self) -> None:
        require_tuple("lobes", self.lobes, Lobe)
        if not self.lobes:
            raise InputError("lobes must have one at least, got ()")
        require_apart(self.lobes)
        super().__post_init__()
        object.__setattr__(self, "film", film_for_preload(self.film, self.preloads))
        require_pad_film(self.film, self.extents, self.slenderness)

    @property
    def preloads(self) -> tuple[float, ...]:
        """Preload of each lobe [1]."""
        return tuple(lobe.preload for lobe in self.lobes)

    @property
    def extents(self) -> tuple[float, ...]:
        """Angle that each lobe covers [rad]."""
        return tuple(lobe.extent for lobe in self.lobes)

    def minimum_film(self, position: ArrayLike) -> Array:
        """Return the least film on any pad [m], shape (...), of journals at positions (2, ...) [m].

        It is not positive where the journal touches.
        """
        at = require_vector("position", position) / self.clearance
        return self.clearance * np.min([lobe.least_film(at) for lobe in self.lobes], axis=0)

    @cached_property
    def bound_film(self) -> BoundLobes:
        """The films of the pads tied to the dimensions; InputError without a stated temperature."""
        self.require_temperature()
        kernels = {extent: self.film.kernel(extent, self.slenderness) for extent in self.extents}
        films = [JournalKernel(kernels[lobe.extent], self.clearance, self.force_scale) for lobe in self.lobes]
        places = [
            LobePlace(lobe.middle, (self.clearance * lobe.center[0], self.clearance * lobe.center[1]))
            for lobe in self.lobes
        ]
        return BoundLobes(LobesKernel(films, places), self.clearance, self.lobes)

    def losses(
        self, position: ArrayLike, velocity: ArrayLike, speed: ArrayLike, *, full_gap: bool | None = None
    ) -> BearingLosses | None:
        """Return power loss, torques and oil flow; see `losses_of_pads`. None if the film law has none.

        The opening of a number is the gap behind the lobe of that number, in the sense of +theta. Where
        `full_gap` is None, it is that of the cooling, or false.

        Raises
        ------
        InputError, FilmContactError
            As `force`.
        """
        if not isinstance(self.film, LossyPadFilm):
            return None
        state = broadcast_state(position, velocity, speed)
        self.bound_film.force(*state)  # raises where the journal touches
        pads = [self._under(lobe, *state).pad for lobe in self.lobes]
        return losses_of_pads(self, self.film, pads, state, full_gap=self.full_gap(full_gap))

    def _under(
        self, lobe: Lobe, position: Array, velocity: Array, speed: Array, *, slopes: bool = False
    ) -> PadSlopes:
        """Return a lobe and the journal on it and, of one state, its slopes if asked for."""
        c, scale, turns = self.clearance, self.force_scale, 0.5 * speed.ravel()
        pad = PadUnderJournal(lobe.extent, lobe.middle, np.empty(0), np.empty(0))
        back = pad.turning.T
        e = back @ (position.reshape(2, -1) / c - np.array(lobe.center)[:, None])
        w = back @ velocity.reshape(2, -1) / c + turns * (_WEDGE @ e)
        film = self.film.kernel(lobe.extent, self.slenderness)
        pad = pad._replace(eccentricity=e, force=scale * film.force(e, w).values)
        if not slopes:
            return PadSlopes(pad, np.empty(0), np.empty(0))
        none = np.zeros((2, 1))
        de = np.hstack([back / c, np.zeros((2, 3))])
        dw = np.hstack([turns * _WEDGE @ back / c, back / c, none]) + 0.5 * np.outer(_WEDGE @ e, SPEED)
        by = scale * film.jacobian(e, w).values[..., 0]
        return PadSlopes(pad, de, by[:, :2] @ de + by[:, 2:] @ dw)

    def film_at_unit_viscosity(self) -> None:
        """Return no film for the loops in C over warm films, which know one film only."""

    def heat_jacobian(self, position: ArrayLike, velocity: ArrayLike, speed: float) -> Array:
        """Return d(power, effective flow, side flow)/d(x, y, vx, vy, speed) at one temperature, shape (3, 5).

        Parameters and errors are those of `film_heat`; InputError too if the film law has no slopes of its
        losses.
        """
        _, cooling = self.cooled
        if not isinstance(self.film, LossyPadFilm):
            raise InputError(f"film must be one with losses for heat, as PadMapFilm, got {self.film!r}")
        q, v, omega = broadcast_state(position, velocity, speed)
        self.bound_film.force(q, v, omega)  # raises where the journal touches
        pads = [self._under(lobe, q, v, omega, slopes=True) for lobe in self.lobes]
        return heat_slopes_of_pads(self, self.film, pads, (q, v, float(omega)), cooling)

    def native(self) -> NativeSpec | None:
        """Return the kernel of the C library that is this bearing; None if its film is no map.

        Nor has a subclass. Its parameters are the dimensions, with the clearance of the pads, and the
        viscosity; radius and length are fixed.
        """
        if type(self) is not LobedBearing or not isinstance(self.film, PadMapFilm) or self.is_warming:
            return None
        extents = list(dict.fromkeys(self.extents))
        tables = {"slenderness": np.array([self.slenderness])}
        for number, extent in enumerate(extents):
            kernel = self.film.table(extent, self.slenderness).kernel()
            tables |= {f"{number}.{name}": numbers for name, numbers in kernel.tables.items()}
        rows = [(lobe.middle, *lobe.center, extents.index(lobe.extent)) for lobe in self.lobes]
        lengths = {name: float(getattr(self, name)) for name in ("radius", "length", "clearance")}
        dimensions = {**lengths, "viscosity": self.film_viscosity}
        return journal_spec("lobed_journal", {"lobes": np.array(rows), **tables}, dimensions, fixed=True)

    def portable(self) -> LobedBearing:
        """Return this bearing with a film that carries the maps it needs; see `model.Portable`."""
        if not isinstance(self.film, PadMapFilm):
            return self
        tables = tuple(self.film.table(extent, self.slenderness) for extent in dict.fromkeys(self.extents))
        return replace(self, film=replace(self.film, tables=tables))
