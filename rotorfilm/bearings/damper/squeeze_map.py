"""Squeeze films as impedance maps: the potential in a table of its own, evaluated in C.

Without feed the film is the gradient of a potential of degree two in the velocity (docs/map.md), leakage into
the layer included, because Darcy's law is linear and symmetric. So the journal's map and kernel serve a
damper too.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import cached_property, lru_cache
from pathlib import Path
from typing import Any, ClassVar, cast

import numpy as np
from scipy.optimize import root

from ...core.errors import ConvergenceError, InputError
from ...core.inputs import quantities
from ...core.model import Array
from ...core.sources import source_digest
from ..films.map_fit import fit_map_table, node_eccentricities, tabulate_film
from ..films.map_table import MapTable, cached_table, table_path
from .squeeze_films import (
    FiniteSqueezeFilm,
    KernelSqueezeFilm,
    LayerModes,
    PorousLayer,
    SqueezeFilm,
    arc_nodes,
    axial_numbers,
    layer_modes,
    leakage,
    mean_permeability,
    short_squeeze_film,
)
from .squeeze_laws import (
    FilmInertia,
    SqueezeCase,
    SqueezeLaw,
    SqueezeOptions,
    finite_film_inertia,
    sealed_short,
    short_film_inertia,
)

# Making the tables of squeeze films: potentials at the nodes of a map, kept in memory and on disk.


LARGEST_FINITE = 0.985

LARGEST = 0.99
"""Eccentricity ratio of the table's last node; beyond, the kernel goes on to the wall, with a warning."""

FULL = 3
"""Times as many cells over the direction for a full film, whose tension narrows the peak over it."""

RATIO = 1.0
"""The slenderness that a table of a damper says it is for: the damper's own is in its numbers."""


@dataclass(frozen=True)
class SqueezeTable:
    """A table and the damper it is for.

    Parameters
    ----------
    slenderness : float or None [1]
        L/D; None for a short film, whose table holds for any.
    layer : tuple or None
        The numbers of the PorousLayer; None for a solid cage.
    cavitated : bool
        Whether the film ruptures.
    table : MapTable
        Table in units of viscosity * radius * length^3 / clearance^2 per 1/s.
    """

    slenderness: float | None
    layer: tuple[float, ...] | None
    cavitated: bool
    table: MapTable

    def required(self, slenderness: float | None, layer: PorousLayer | None, cavitated: bool) -> SqueezeTable:
        """Return this table; raise InputError if it is that of another damper."""
        own, other = (self.slenderness, self.layer, self.cavitated), (slenderness, layer, cavitated)
        if own != other:
            raise InputError(f"table must be that of the damper, {other}, got that of {own}")
        return self


@lru_cache(maxsize=32)
def squeeze_table(
    slenderness: float | None, layer: PorousLayer | None, cavitated: bool, cells: tuple[int, int]
) -> SqueezeTable:
    """Return the table of a film.

    That of a short film is made in some hundredths of a second, that of a film of finite length in some
    seconds if it is not on disk.

    Parameters
    ----------
    slenderness : float or None [1]
        L/D; None for a short film.
    layer : PorousLayer or None
        None for a solid cage.
    cavitated : bool
    cells : (int, int)
        Cells over the eccentricity ratio and the direction of the velocity.
    """
    if slenderness is None:
        table = _short_table(layer, cavitated, cells)
    else:
        path = squeeze_path(slenderness, layer, cavitated, cells)
        table = cached_table(MapTable, path, lambda: _finite_table(slenderness, layer, cavitated, cells))
    return SqueezeTable(slenderness, layer and tuple(layer), cavitated, table)


def squeeze_path(
    slenderness: float, layer: PorousLayer | None, cavitated: bool, cells: tuple[int, int]
) -> Path:
    """Return where a table lies; the name is a digest of all that decides its content."""
    return table_path("damper", (source_digest(__name__), slenderness, layer, cavitated, cells))


def _short_table(layer: PorousLayer | None, cavitated: bool, cells: tuple[int, int]) -> MapTable:
    modes = layer_modes(layer)
    if not cavitated:
        return _full_table(short_squeeze_film(modes), cells, LARGEST)
    return tabulate_film(
        short_squeeze_film(modes, cavitated=True),
        slenderness_range=(RATIO, RATIO),
        cells=(*cells, 0),
        largest_eccentricity_ratio=LARGEST,
    )


def _finite_table(
    slenderness: float, layer: PorousLayer | None, cavitated: bool, cells: tuple[int, int]
) -> MapTable:
    if cavitated:
        return _cavitated_table(slenderness, layer, cells)
    modes = layer_modes(layer)
    film = FiniteSqueezeFilm(slenderness, layer, modes, np.zeros_like(modes.weight))
    return _full_table(film, cells, LARGEST_FINITE)


def _cavitated_table(slenderness: float, layer: PorousLayer | None, cells: tuple[int, int]) -> MapTable:
    potential = CavitatedPotential(slenderness, layer)
    headings = np.arccos(np.linspace(-1.0, 1.0, cells[1] + 1))
    nodes = node_eccentricities(LARGEST_FINITE, cells[0])
    logs = [[np.log(-potential(float(eps), float(turn))) for turn in headings] for eps in nodes[1:]]
    center = np.full(headings.size, np.log(-potential(0.0, 0.0)))
    return fit_map_table(
        np.array([[center, *logs]]),
        slenderness_range=(RATIO, RATIO),
        largest_eccentricity_ratio=LARGEST_FINITE,
    )


def _full_table(film: SqueezeFilm, cells: tuple[int, int], largest: float) -> MapTable:
    """Return the table of a full film: -J = (C_t + (C_r - C_t) cos^2)/2, linear in the velocity."""
    eps = node_eccentricities(largest, cells[0])
    none = np.zeros_like(eps)
    damping = -film.jacobian(np.stack([eps, none]), np.stack([none, none]))[:, 2:]
    cos2 = np.linspace(-1.0, 1.0, FULL * cells[1] + 1) ** 2
    radial, tangential = damping[0, 0][:, None], damping[1, 1][:, None]
    return fit_map_table(
        np.log(0.5 * (tangential + (radial - tangential) * cos2))[None],
        slenderness_range=(RATIO, RATIO),
        largest_eccentricity_ratio=largest,
        slope=np.zeros(1),
    )


# Squeeze films as impedance maps: the potential in a table of its own, evaluated in C.


SHORT = 1e-6
"""Length / diameter of a short film, at the wall too."""


class TabulatedSqueeze(SqueezeOptions):
    """A film from a table of its potential, in a damper without feed."""

    is_short: ClassVar[bool]
    cells: tuple[int, int]
    table: SqueezeTable | None

    def tabulated(self, case: SqueezeCase) -> SqueezeLaw:
        """Return this law with the table of one damper; see `SqueezeOptions`."""
        return cast(SqueezeLaw, replace(cast(Any, self), table=self._table(case)))

    def _table(self, case: SqueezeCase) -> SqueezeTable:
        key = None if self.is_short else case.slenderness, case.layer, case.cavitated
        return squeeze_table(*key, self.cells) if self.table is None else self.table.required(*key)

    def _mapped(self, case: SqueezeCase) -> KernelSqueezeFilm:
        """Return the film of one damper; one that ruptures in a solid cage is a journal's at the wall."""
        if np.any(case.feed) or (case.cavitated and np.any(case.ends)):
            raise InputError(
                f"feed must be None for {type(self).__name__}(): a film with feed has no potential to "
                "tabulate"
            )
        own, ratio = self._table(case), SHORT if self.is_short else case.slenderness
        wall = (ratio, 0.25 / ratio**2) if own.cavitated and own.layer is None else (0.0, 0.0)
        return KernelSqueezeFilm(own.table.kernel(RATIO, wall), not self.is_short)


@quantities
@dataclass(frozen=True)
class MapSqueeze(TabulatedSqueeze):
    """Short film from a table: within 1e-4 of `ShortSqueeze()`, and about a hundred times faster.

    The table is made at the first use of a damper and kept in memory for dampers of the same layer.

    Parameters
    ----------
    cells : tuple of int
        Cells of the table over the eccentricity ratio and over the direction of the velocity; a full film
        takes three times as many of the latter.
    table : SqueezeTable, optional
        Table of this damper, as `tabulated` gives it; made by default.
    """

    is_short: ClassVar[bool] = True
    """Whether the table holds for any length / diameter."""
    slenderness_limit: ClassVar[float] = 0.25
    """Largest length / diameter for which the film is meant [1]."""
    largest_eccentricity_ratio: ClassVar[float] = LARGEST
    """Eccentricity ratio to which the film is meant [1]."""

    cells: tuple[int, int] = (24, 48)
    table: SqueezeTable | None = None

    def bind(self, case: SqueezeCase) -> SqueezeFilm:
        """Return the film of one damper; raise InputError for one with feed."""
        return sealed_short(self._mapped(case), case)

    def inertia(self, case: SqueezeCase) -> FilmInertia:
        """Return the inertia of the film of one damper; see `SqueezeOptions`."""
        return short_film_inertia(case)


@quantities
@dataclass(frozen=True)
class FiniteMapSqueeze(TabulatedSqueeze):
    """Film of finite length from a table of its potential, flow around the circumference included.

    It covers L/D up to 2 and eccentricity ratios up to 0.985. The table takes some seconds to make for each
    damper and is kept on disk.

    Parameters
    ----------
    cells : tuple of int
        Cells of the table over the eccentricity ratio and over the direction of the velocity; a full film
        takes three times as many of the latter.
    table : SqueezeTable, optional
        Table of this damper, as `tabulated` gives it; made, or found on disk, by default.
    """

    is_short: ClassVar[bool] = False
    """Whether the table holds for any length / diameter."""
    largest_eccentricity_ratio: ClassVar[float] = LARGEST_FINITE
    """Eccentricity ratio to which the film is meant [1]."""

    cells: tuple[int, int] = (16, 32)
    table: SqueezeTable | None = None

    def bind(self, case: SqueezeCase) -> SqueezeFilm:
        """Return the film of one damper; raise InputError for one with feed or seals."""
        mapped = self._mapped(case)
        if case.is_sealed:
            raise InputError(
                "seals must be None for FiniteMapSqueeze(): FullFilm() with FiniteSqueeze() has them, and a "
                "short film"
            )
        return mapped

    def inertia(self, case: SqueezeCase) -> FilmInertia:
        """Return the inertia of the film of one damper; see `SqueezeOptions`."""
        return finite_film_inertia(case)


# Potential of a cavitated squeeze film of finite length on a porous layer: the free arc, solved spectrally.
#
# As in the journal's film the first axial mode decides where the pressure ends (p >= 0, and p and its slope
# vanish there); the other modes live on that arc. The potential errs by the third power of the error of the
# ends, the force by the second, so the potential is what goes into a table (docs/map.md).


AXIAL_MODES = 10
FUNCTIONS = 30
NODES = 128
HARMONICS = 64
STARTS = (0.3, 0.0, 0.8)
"""How far beyond the half circle the search for both ends starts, in L/D [rad]."""

RESIDUAL = 1e-4
"""Slope of the pressure that an end may keep; the error of the potential is its third power."""

FARTHEST = 1.5
"""How far an end of the film may lie from where the squeeze vanishes [rad]."""


@dataclass(frozen=True)
class CavitatedPotential:
    """Least J = (F.w)/2 of a cavitated film, in units viscosity * radius * length^3 / clearance^2 per 1/s.

    Parameters
    ----------
    slenderness : float [1]
        L/D.
    layer : PorousLayer or None
        None for a solid cage.
    """

    slenderness: float
    layer: PorousLayer | None

    def __call__(self, eps: float, heading: float) -> float:
        """Return J < 0 for |w| = 1 at `heading` [rad] from the position, whose eccentricity ratio is `eps`.

        Raises
        ------
        ConvergenceError
            If the ends of the film are not found.
        """

        def slopes(ends: Array) -> Array:
            P = self._solved(self._film(eps, heading, ends), 0)[0]
            edge = np.array([-1.0, 1.0]), np.ones(2)
            _, _, h, stretch = arc_nodes(np.asarray(eps), ends[0], ends[1], self._depth, *edge)
            return (h**3 + self._leak) * (_basis()[4] @ P) / stretch

        for beyond in STARTS:
            start = heading + np.array([-0.5, 0.5]) * (np.pi + beyond * self.slenderness)
            # A search that goes astray may try a film without length; the next start goes on.
            with np.errstate(divide="ignore", invalid="ignore"):
                found = root(slopes, start, tol=1e-7)
            if np.all(np.abs(found.x - start) < FARTHEST) and np.abs(found.fun).max() < RESIDUAL:
                return self._potential(self._film(eps, heading, found.x))
        raise ConvergenceError(
            "the ends of the film were not found at the eccentricity ratio "
            f"{eps:.6g}, direction {heading:.6g} rad"
        )

    def _potential(self, film: tuple[np.ndarray, ...]) -> float:
        h, towards, weight, _ = film
        power = 0.0
        for n in range(AXIAL_MODES):
            P, source = self._solved(film, n)
            power += 6.0 / axial_numbers()[n] ** 2 * float(source @ P)
        rest = self._rest
        conductance = rest.weight @ (1.0 / (h**3 + rest.leak[:, None]))
        return -0.5 * (power + float(weight @ (towards**2 * conductance)))

    def _solved(self, film: tuple[np.ndarray, ...], n: int) -> tuple[Array, Array]:
        """Return the coefficients of the pressure of axial mode n and of its source."""
        (_, gauss, value, slope, _), a2 = _basis(), axial_numbers()[n] ** 2
        h, towards, weight, harmonics = film
        cube = h**3 + self._along
        matrix = self.slenderness**2 * (slope.T * (cube / (weight / gauss) * gauss)) @ slope
        matrix += (value.T * (weight * (a2 * cube + self._through))) @ value
        # The flux of a layer that is not thin depends on more than pressure and second derivative here.
        if self.layer is not None and not self.layer.thin:
            m = np.arange(HARMONICS + 1.0)
            taken = self._taken(a2 + (self.slenderness * m) ** 2)
            taken[1:] *= 2.0
            matrix += (harmonics.conj().T * taken / (2.0 * np.pi) @ harmonics).real
        source = value.T @ (weight * towards)
        return np.asarray(np.linalg.solve(matrix, source), dtype=np.float64), source

    def _film(self, eps: float, heading: float, ends: Array) -> tuple[np.ndarray, ...]:
        """Return film, source w.u and weights at nodes of one arc, and harmonics of the trial functions."""
        x, gauss, value, *_ = _basis()
        cos, sin, h, weight = arc_nodes(np.asarray(eps), ends[0], ends[1], self._depth, x, gauss)
        powers = (cos - 1j * sin)[:, None] ** np.arange(HARMONICS + 1)
        towards = np.cos(heading) * cos + np.sin(heading) * sin
        return h, towards, weight, powers.T @ (weight[:, None] * value)

    def _taken(self, k2: Array) -> Array:
        assert self.layer is not None
        return leakage(self.layer, k2)

    @cached_property
    def _along(self) -> float:
        """What a thin sealed layer adds to h^3 in both directions."""
        layer = self.layer
        if layer is None or not layer.thin or layer.vented:
            return 0.0
        return 12.0 * layer.permeability_number * mean_permeability(layer.grading) * layer.anisotropy

    @cached_property
    def _through(self) -> float:
        """What a thin vented layer takes of any pressure."""
        if self.layer is None or not (self.layer.thin and self.layer.vented):
            return 0.0
        return float(self._taken(np.ones(1))[0])

    @cached_property
    def _rest(self) -> LayerModes:
        """The axial modes taken as short."""
        modes = layer_modes(self.layer)
        if len(modes.weight) == 1:
            share = 1.0 - np.sum(6.0 / axial_numbers()[:AXIAL_MODES] ** 4)
            return modes._replace(weight=np.array([share]))
        rest = slice(AXIAL_MODES, None)
        return LayerModes(modes.weight[rest], modes.leak[rest], modes.passage[rest])

    @cached_property
    def _leak(self) -> float:
        """Mean leak of the axial modes."""
        modes = layer_modes(self.layer)
        return float(modes.weight @ modes.leak)

    @cached_property
    def _depth(self) -> float:
        return 0.5 * float(np.cbrt(self._leak))


@lru_cache(maxsize=1)
def _basis() -> tuple[Array, Array, Array, Array, Array]:
    """Return trial functions on -1 <= x <= 1 that vanish at both ends: integrated Legendre polynomials.

    Gauss-Legendre nodes x and weights, values and slopes there, slopes at both ends.
    """
    x, weight = np.polynomial.legendre.leggauss(NODES)
    k = np.arange(FUNCTIONS)
    P = np.polynomial.legendre.legvander(x, FUNCTIONS + 1)
    scale = 1.0 / np.sqrt(4.0 * k + 6.0)
    slope = scale * (2.0 * k + 3.0)
    ends = np.stack([slope * (-1.0) ** (k + 1), slope])
    return x, weight, scale * (P[:, 2:] - P[:, :-2]), slope * P[:, 1:-1], ends
