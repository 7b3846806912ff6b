"""The impedance map of a bearing with axial grooves or several pads as a film law."""

from __future__ import annotations

import dataclasses
from collections.abc import Mapping
from dataclasses import dataclass, field
from functools import lru_cache

import numpy as np

from ..errors import InputError
from ..model import Array
from ..native import GrooveMapKernel, JournalKernel
from .geometry import FilmGeometry
from .groove_axis import AlignedOpenings, aligned_openings, require_mappable
from .groove_build import Report, Resolution, build_groove_table
from .groove_cache import cache_path, cached_table
from .groove_table import GrooveTable
from .map import BoundMap, MapFilm, report_batch
from .ring import COARSENING

SAME = 1e-9
"""Relative difference of length/diameter, and angle [rad], below which a table is that of a bearing."""


@dataclass(frozen=True, kw_only=True)
class GroovedMapFilm:
    """Finite-length film with Reynolds rupture in a bearing with axial grooves or several pads.

    The openings are at ambient pressure. As in `MapFilm` the force is F = dJ/dw of a tabulated potential
    J(e, w), here over two angles (`native/groove_kernel.h`): the damping matrix is symmetric, and the
    derivatives are exact. In a plain bearing this is `MapFilm`.

    A map belongs to one L/D and one set of openings, wherever they are turned to. It is made from some
    10^4 solutions of the two-dimensional film on first use, which takes from seconds to a minute, and then
    kept in the folder that the environment variable ROTORFILM_CACHE names, or the platform's cache.
    `build_groove_map` makes it beforehand and says how far it is.

    Beyond the largest eccentricity ratio J is continued as a power of X, without proof of its accuracy: a
    ValidityWarning says so.

    Parameters
    ----------
    cells : (int, int)
        Cells of the two-dimensional film around it and along half the length: multiples of 4, at least 16
        and 4.
    nodes : (int, int, int)
        Nodes of the map over the eccentricity ratio (at least 6), and over the directions of the
        eccentricity and of the source (even, at least 12).
    largest_eccentricity_ratio : float [1]
        Of the last node.
    table : GrooveTable, optional
        The map, where it is there already: nothing is then built nor looked for.
    geometry : FilmGeometry
        Set by `fitted`, from the geometry of the bearing.

    Raises
    ------
    InputError
        If an argument breaks its rule, an opening is wider than 60 deg, there is a supply pressure,
        or the table is that of other openings.
    """

    cells: tuple[int, int] = (192, 12)
    nodes: tuple[int, int, int] = (12, 72, 48)
    largest_eccentricity_ratio: float = 0.97
    table: GrooveTable | None = None
    geometry: FilmGeometry = field(default_factory=FilmGeometry)

    def __post_init__(self) -> None:
        if not _are_counts(self.cells, (16, 4), (COARSENING, COARSENING)):
            raise InputError(
                f"cells must be two multiples of {COARSENING}, at least (16, 4), got {self.cells!r}"
            )
        if not _are_counts(self.nodes, (6, 12, 12), (1, 2, 2)):
            raise InputError(f"nodes must be at least (6, 12, 12), the last two even, got {self.nodes!r}")
        if not 0.0 < self.largest_eccentricity_ratio < 1.0:
            raise InputError(
                f"largest_eccentricity_ratio must be in (0, 1), got {self.largest_eccentricity_ratio!r}"
            )
        if not isinstance(self.geometry, FilmGeometry):
            raise InputError(f"geometry must be a FilmGeometry, got {self.geometry!r}")
        if not self.geometry.plain:
            require_mappable(self.geometry)

    def fitted(self, geometry: FilmGeometry) -> GroovedMapFilm:
        """Return this film in a bearing of the given geometry."""
        return dataclasses.replace(self, geometry=geometry)

    def force(self, eccentricity: Array, source: Array, slenderness: float) -> Array:
        """Return the force on the journal, shape (2, ...); see `FilmLaw.force`.

        Raises
        ------
        InputError
            If the table is not that of this slenderness, or a state is not finite.
        FilmContactError
            If an eccentricity ratio is not below 1.
        """
        if self.geometry.plain:
            return MapFilm().force(eccentricity, source, slenderness)
        batch = self._kernel(slenderness).force(eccentricity.reshape(2, -1), source.reshape(2, -1))
        report_batch(batch, np.hypot(*eccentricity.reshape(2, -1)))
        return batch.values.reshape(eccentricity.shape)

    def jacobian(self, eccentricity: Array, source: Array, slenderness: float) -> Array:
        """Return d force / d (eccentricity, source), shape (2, 4, ...); see `FilmLaw.jacobian`.

        Raises
        ------
        InputError, FilmContactError
            As in `force`.
        UndefinedDerivativeError
            Where the source vanishes.
        """
        if self.geometry.plain:
            return MapFilm().jacobian(eccentricity, source, slenderness)
        batch = self._kernel(slenderness).jacobian(eccentricity.reshape(2, -1), source.reshape(2, -1))
        report_batch(batch, np.hypot(*eccentricity.reshape(2, -1)))
        return batch.values.reshape(2, 4, *eccentricity.shape[1:])

    def bind(self, *, slenderness: float, clearance: float, force_scale: float) -> BoundMap:
        """Return this film in one bearing, in SI units; see `law.BindableFilm`."""
        if self.geometry.plain:
            return MapFilm().bind(slenderness=slenderness, clearance=clearance, force_scale=force_scale)
        kernel = JournalKernel(self._kernel(slenderness), clearance, force_scale)
        return BoundMap(kernel, clearance)

    def native(self, slenderness: float) -> tuple[str, Mapping[str, Array]]:
        """Return the kernel and its tables, made now if they are not there yet; see `law.NativeFilm`."""
        if self.geometry.plain:
            return MapFilm().native(slenderness)
        kernel = self._kernel(slenderness)
        numbers = [slenderness, kernel.struct.x_end, kernel.struct.squeeze, kernel.struct.axis]
        return "grooved_journal", {
            "coefficients": kernel.coefficients,
            "center": kernel.center,
            "map": np.array(numbers),
        }

    def tabulated(self, slenderness: float) -> MapFilm | GroovedMapFilm:
        """Return this film with its table; see `law.TabulatedFilm`."""
        if self.geometry.plain:
            return MapFilm().tabulated(slenderness)
        return dataclasses.replace(self, table=self.built_table(slenderness)) if self.table is None else self

    def built_table(self, slenderness: float, report: Report | None = None) -> GrooveTable:
        """Return the map of this film: the given one, the one on disk, or a new one, which is then kept.

        Parameters
        ----------
        slenderness : float [1]
            Length / diameter.
        report : callable, optional
            Called with the fraction done, 0 to 1, and a text while a map is being made.
        """
        openings = aligned_openings(self.geometry)
        if self.table is not None:
            _require_same(self.table, openings, slenderness)
            return self.table
        resolution = Resolution(self.cells, self.nodes, self.largest_eccentricity_ratio)
        return cached_table(
            cache_path(openings, slenderness, resolution),
            lambda: build_groove_table(openings, slenderness, resolution, report),
        )

    def _kernel(self, slenderness: float) -> GrooveMapKernel:
        return _kernel(self, float(slenderness))


@lru_cache(maxsize=64)
def _kernel(film: GroovedMapFilm, slenderness: float) -> GrooveMapKernel:
    table = film.built_table(slenderness)
    axis = aligned_openings(film.geometry).axis
    return GrooveMapKernel(table.coefficients, table.reach, table.center, table.squeeze, axis)


def _require_same(table: GrooveTable, openings: AlignedOpenings, slenderness: float) -> None:
    if abs(table.slenderness / slenderness - 1.0) > SAME:
        raise InputError(
            f"length/diameter must be that of the table, {table.slenderness!r}, got {slenderness!r}"
        )
    same = len(table.grooves) == len(openings.grooves) and all(
        abs(a.center - b.center) <= 2.0 * SAME and abs(a.width - b.width) <= 2.0 * SAME
        for a, b in zip(table.grooves, openings.grooves, strict=True)
    )
    if not same:
        raise InputError(f"openings must be those of the table, {table.grooves!r}, got {openings.grooves!r}")


def _are_counts(counts: object, least: tuple[int, ...], factors: tuple[int, ...]) -> bool:
    if not isinstance(counts, tuple) or len(counts) != len(least):
        return False
    rules = zip(counts, least, factors, strict=True)
    return all(type(n) is int and n >= low and n % factor == 0 for n, low, factor in rules)
