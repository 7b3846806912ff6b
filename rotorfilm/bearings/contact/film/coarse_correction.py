"""A cycle over ever coarser grids as the preconditioner of a point contact's linear equations.

The sparse factors of `preconditioner` take the kernel by its near neighborhood, which is wrong for changes
that are smooth over many cells, the more of them the finer the grid: alone they let GMRES take half as many
iterations again whenever the cells are halved. Smooth changes are well represented on cells twice as large,
where the whole kernel counts again, so the answer there is corrected by the factors here, the other way about
from the usual order of multigrid methods (Venner and Lubrecht 2000), which saves one of two corrections. The
iterations are then the same on every grid. As the coarser grids carry what reaches far, the factors of the
finer ones may be cut into strips, which makes them as cheap per cell on every grid, too.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from typing import NamedTuple

import numpy as np

from ....model import Array
from .contact_scheme import UpwindScheme
from .film_equations import ContactEquations
from .linear_contact import LinearContact, Place, linearized
from .preconditioner import Distribution, Factors, distribution, factorize

COARSEST = 64
"""Fewest cells along a side down to which grids are halved: less is not worth its calls."""


class HalvedGrid(NamedTuple):
    """One of the grids: its equations and change of variables."""

    equations: ContactEquations
    change: Distribution


class Cycle(NamedTuple):
    """The preconditioner made at one state.

    Attributes
    ----------
    factors : Factors
        On this grid.
    coarse : Cycle or None
        On cells twice as large.
    linear : LinearContact
        The equations on this grid where it was made.
    """

    factors: Factors
    coarse: Cycle | None
    linear: LinearContact

    def answer(self, right: Array, linear: LinearContact) -> Array:
        """Return pressures and approach, shape (n + 1,), that about answer a right side of `linear`."""
        if self.coarse is None:
            return self.factors.answer(right, linear.place.wet)
        smooth = self._smooth(right, linear)
        left = right - linear.product(smooth)
        return smooth + self.factors.answer(left, linear.place.wet)

    def _smooth(self, right: Array, linear: LinearContact) -> Array:
        assert self.coarse is not None
        wet, shape = linear.place.wet, linear.equations.grid.shape
        share = restricted(np.where(wet, right[:-1], 0.0), shape)
        below = self.coarse.answer(np.append(share, right[-1]), self.coarse.linear)
        pressure = np.where(self.coarse.linear.place.wet, below[:-1], 0.0)
        fine = prolonged(pressure.reshape(shape[0] // 2, shape[1] // 2)).ravel()
        return np.append(np.where(wet, fine, right[:-1]), below[-1])


def halved_grids(equations: ContactEquations) -> tuple[HalvedGrid, ...]:
    """Return the grids from fine to coarse, with what of a preconditioner depends on nothing else.

    Coarse grids take the upwind scheme: those of a scheme that is blind to the checkerboard answer with one.
    """
    found = [equations]
    while (half := found[-1].halved) is not None and min(half.grid.cells) >= COARSEST:
        found.append(replace(half, scheme=UpwindScheme()) if half.scheme != UpwindScheme() else half)
    return tuple(HalvedGrid(each, distribution(each)) for each in found)


def cycle(ladder: Sequence[HalvedGrid], linear: LinearContact) -> Cycle:
    """Return the preconditioner of linearized equations, for `halved_grids` of the same equations."""
    coarse = None
    if len(ladder) > 1:
        place = coarser(linear, ladder[1].equations)
        if place.wet.any():
            coarse = cycle(ladder[1:], linearized(ladder[1].equations, place))
    factors = factorize(linear, ladder[0].change, in_strips=coarse is not None)
    return Cycle(factors, coarse, linear)


def coarser(linear: LinearContact, coarse: ContactEquations) -> Place:
    """Return the place of linearized equations on cells twice as large."""
    place, fine = linear.place, linear.equations
    pressure, stored, wet = (
        restricted(values, fine.grid.shape)
        for values in (place.pressure, fine.sampling.stored @ place.film, place.wet.astype(float))
    )
    delta = place.film[0] - fine.sampling.gap[0] - fine.sampling.deflection(place.pressure)[0]
    outside = coarse.film(pressure, delta)
    inside = coarse.sampling.spread @ np.ones(pressure.size) > 1.0 - 1e-9
    film = np.where(inside, coarse.sampling.spread @ stored, np.maximum(outside, place.film.min()))
    return place._replace(pressure=pressure, film=film, wet=wet >= 0.5)


def restricted(values: Array, shape: tuple[int, int]) -> Array:
    """Return the means over four cells each, flat."""
    return np.asarray(values.reshape(shape[0] // 2, 2, shape[1] // 2, 2).mean(axis=(1, 3)).ravel())


def prolonged(values: Array) -> Array:
    """Return values at the centers of cells half as large, linear between the old ones."""
    return _doubled(_doubled(values).T).T


def _doubled(values: Array) -> Array:
    wide = np.pad(values, ((1, 1), (0, 0)), mode="edge")
    pairs = (0.75 * values + 0.25 * wide[:-2], 0.75 * values + 0.25 * wide[2:])
    return np.stack(pairs, axis=1).reshape(2 * values.shape[0], values.shape[1])
