"""Potential of a cavitated squeeze film of finite length on a porous layer: the free arc, solved spectrally.

As in the journal's film the first axial mode decides where the pressure ends (p >= 0, and p and its slope
vanish there); the other modes live on that arc. The potential errs by the third power of the error of the
ends, the force by the second, so the potential is what goes into a table (docs/map.md).
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property, lru_cache
from typing import NamedTuple

import numpy as np
from scipy.optimize import root

from ...errors import ConvergenceError
from ...model import Array
from .cavitated_squeeze import arc_nodes
from .porous_layer import (
    LayerModes,
    PorousLayer,
    axial_numbers,
    layer_modes,
    leakage,
    mean_permeability,
)

AXIAL_MODES = 10
FUNCTIONS = 30
NODES = 128
HARMONICS = 64
STARTS = (0.3, 0.0, 0.8)
"""How far beyond the half circle the search for both ends starts, in L/D [rad]."""

RESIDUAL = 1e-4
"""Slope of the pressure that an end may keep; the potential errs by its third power."""

FARTHEST = 1.5
"""How far an end of the film may lie from where the squeeze vanishes [rad]."""


class _Basis(NamedTuple):
    """Trial functions on -1 <= x <= 1 that vanish at both ends; values and slopes at Gauss-Legendre nodes."""

    x: Array
    weight: Array
    value: Array
    slope: Array
    end_slope: Array


class _Film(NamedTuple):
    """One arc: conductance h^3 + leak, dpsi/dx, source w.u, weights, and harmonics of the trial functions."""

    h: Array
    stretch: Array
    source: Array
    weight: Array
    harmonics: np.ndarray
    end_stretch: Array
    end_h: Array


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
            film = self._film(eps, heading, ends)
            P = self._solved(film, 0)[0]
            return (film.end_h**3 + self._leak) * (_basis().end_slope @ P) / film.end_stretch

        for beyond in STARTS:
            start = heading + np.array([-0.5, 0.5]) * (np.pi + beyond * self.slenderness)
            # A search that goes astray may try a film without length; the next start goes on.
            with np.errstate(divide="ignore", invalid="ignore"):
                found = root(slopes, start, tol=1e-7)
            if np.all(np.abs(found.x - start) < FARTHEST) and np.abs(found.fun).max() < RESIDUAL:
                return self._potential(self._film(eps, heading, found.x))
        raise ConvergenceError(
            "ends of the film must be found, and were not at eccentricity ratio "
            f"{eps:.6g}, direction {heading:.6g} rad"
        )

    def _potential(self, film: _Film) -> float:
        power = 0.0
        for n in range(AXIAL_MODES):
            P, source = self._solved(film, n)
            power += 6.0 / axial_numbers()[n] ** 2 * float(source @ P)
        rest = self._rest
        conductance = rest.weight @ (1.0 / (film.h**3 + rest.leak[:, None]))
        return -0.5 * (power + float(film.weight @ (film.source**2 * conductance)))

    def _solved(self, film: _Film, n: int) -> tuple[Array, Array]:
        """Return the coefficients of the pressure of axial mode n and of its source."""
        basis, a2 = _basis(), axial_numbers()[n] ** 2
        cube = film.h**3 + self._along
        matrix = self.slenderness**2 * (basis.slope.T * (cube / film.stretch * basis.weight)) @ basis.slope
        matrix += (basis.value.T * (film.weight * (a2 * cube + self._through))) @ basis.value
        if self._spectral:
            m = np.arange(HARMONICS + 1.0)
            taken = self._taken(a2 + (self.slenderness * m) ** 2)
            taken[1:] *= 2.0
            matrix += (film.harmonics.conj().T * taken / (2.0 * np.pi) @ film.harmonics).real
        source = basis.value.T @ (film.weight * film.source)
        return np.asarray(np.linalg.solve(matrix, source), dtype=np.float64), source

    def _film(self, eps: float, heading: float, ends: Array) -> _Film:
        basis = _basis()
        e, first, last = np.asarray(eps), ends[0], ends[1]
        arc = arc_nodes(e, first, last, self._depth, basis.x, basis.weight)
        edge = arc_nodes(e, first, last, self._depth, np.array([-1.0, 1.0]), np.ones(2))
        weighted = arc.weight[:, None] * basis.value
        powers = (arc.cos - 1j * arc.sin)[:, None] ** np.arange(HARMONICS + 1)
        source = np.cos(heading) * arc.cos + np.sin(heading) * arc.sin
        return _Film(
            arc.h, arc.weight / basis.weight, source, arc.weight, powers.T @ weighted, edge.weight, edge.h
        )

    @property
    def _spectral(self) -> bool:
        """Whether the layer's flux depends on more than the pressure and its second derivative here."""
        return self.layer is not None and not self.layer.thin

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
def _basis() -> _Basis:
    """Return integrated Legendre polynomials."""
    x, weight = np.polynomial.legendre.leggauss(NODES)
    k = np.arange(FUNCTIONS)
    P = np.polynomial.legendre.legvander(x, FUNCTIONS + 1)
    scale = 1.0 / np.sqrt(4.0 * k + 6.0)
    slope = scale * (2.0 * k + 3.0)
    ends = np.stack([slope * (-1.0) ** (k + 1), slope])
    return _Basis(x, weight, scale * (P[:, 2:] - P[:, :-2]), slope * P[:, 1:-1], ends)
