"""What the Reynolds number of turbulent oil adds to the map of a film.

At one Reynolds number, Re = density |speed| radius clearance/viscosity, the factors of a turbulent film are a
mobility over the thickness, so that a map can hold its potential. The logarithm of the potential over that of
laminar oil is smooth: some cells over the coordinates of the map and over r = ln(1 + Re/scale) hold it, from
films on few cells, whose errors cancel. The splines are cubic, and quintic over the direction of the source.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import partial
from typing import Any

import numpy as np

from ...core.errors import InputError
from ...core.model import Array
from ...core.sources import source_digest
from .finite_volumes import are_counts
from .map_fit import MapPart, MapPlan, batches, even_shares, joined
from .map_table import GrownTable
from .mobility import Mobility, checksum_of, require_mobility, require_thickness_law

SCALE, EDGE = 30.0, 5.236
"""Reynolds number below which the nodes are uniform, and above which their logarithms are. Where a band of
transition begins at a larger one, it is that over the second number: then both ends of the band can be nodes,
as ln(1 + Re/scale) of them are as 3 to 4."""


LARGEST_REYNOLDS = 20000.0
"""Largest Reynolds number of a map without a band of transition."""


def require_map_law(mobility: Mobility | None, cells: int) -> None:
    """Raise InputError where a film has no potential, or not so many cells over the Reynolds number."""
    require_mobility(mobility)
    if not are_counts((cells,), (6,), (1,)) and cells != 0:
        raise InputError(f"reynolds_cells must be 0 or a number from 6 on, got {cells!r}")
    if mobility is not None and (mobility.drags or cells == 0):
        require_thickness_law(mobility)


def reynolds_axis(mobility: Mobility, cells: int, largest: float) -> tuple[float, float]:
    """Return scale and largest Reynolds number of so many cells; a band begins and ends at nodes.

    With a band the largest follows from the number of cells.
    """
    if mobility.scale <= SCALE:
        return SCALE, largest
    low = mobility.scale / EDGE
    step = math.log1p(EDGE) / (3 * max(1, round(cells / 8)))
    return low, low * math.expm1(step * cells)


@dataclass(frozen=True)
class GrowthMap(MapPlan[Any]):
    """A map with its growth: that of laminar oil, kept by itself, and what the Reynolds number adds.

    Parameters
    ----------
    laminar : MapPlan
        The map that grows.
    coarse : MapPlan
        The same on the nodes of the growth, with films on few cells.
    mobility : Mobility
        Without a density.
    cells : int
        Cells over the Reynolds number.
    """

    laminar: Any
    coarse: Any
    mobility: Mobility
    cells: int
    name = "growth"
    title = "map over the Reynolds number"

    @property
    def kind(self) -> type[GrownTable]:  # type: ignore[override]
        """That of the map that grows."""
        found: type[GrownTable] = self.laminar.kind
        return found

    @property
    def key(self) -> object:
        """All that decides the content, with the modules of the map that grows."""
        return source_digest(type(self.laminar).__module__), self

    @property
    def label(self) -> str:
        """That of the map."""
        return str(self.coarse.label)

    @property
    def work(self) -> float:
        """Nodes times cells; see `MapPlan`."""
        return float((self.cells + 1) * self.coarse.work)

    def making_time(self) -> float:
        """Return about how long both maps take [s]; 0 where they are on disk."""
        own = super().making_time()
        return own + float(self.laminar.making_time()) if own else 0.0

    def parts(self) -> tuple[MapPart, ...]:
        """Return potentials at all Reynolds numbers, and finer films at some; see `MapPlan`."""
        scale, most = reynolds_axis(self.mobility, self.cells, LARGEST_REYNOLDS)
        numbers = scale * np.expm1(np.linspace(0.0, math.log1p(most / scale), self.cells + 1))
        layers = [self.coarse.potential(), *(self._at(each).potential() for each in numbers[1:].tolist())]
        count = len(layers[0].pieces)

        def fit(found: list[Array]) -> list[Array]:
            fits = [layer.fit(found[k * count : (k + 1) * count]) for k, layer in enumerate(layers)]
            grown = [[part - first for part, first in zip(one, fits[0], strict=True)] for one in fits]
            return [np.array(each) for each in zip(*grown, strict=True)]

        def exact(e: Array, w: Array, reynolds: Array) -> Array:
            columns = [
                self._at(each, self.laminar).solution(e[:, k : k + 1], w[:, k : k + 1])
                for k, each in enumerate(reynolds.tolist())
            ]
            return np.concatenate(columns, axis=1)

        pieces: list[Callable[[], Array]] = [piece for layer in layers for piece in layer.pieces]
        checks = [partial(exact, *some) for some in batches(*self._states())]
        return MapPart(pieces, fit), joined(checks)

    def _at(self, reynolds: float, plan: Any = None) -> Any:
        """Return a plan at one Reynolds number, by default the coarse one."""
        own = plan or self.coarse
        return replace(own, resolution=own.resolution.with_mobility(self.mobility.at(reynolds)))

    def _states(self) -> tuple[Array, Array, Array]:
        """Return states of the laminar bounds, with Reynolds numbers (n,)."""
        e, w = self.laminar.places
        scale, most = reynolds_axis(self.mobility, self.cells, LARGEST_REYNOLDS)
        shares = even_shares(e.shape[1], 4)[3]
        return e, w, scale * np.expm1(math.log1p(most / scale) * shares)

    def finished(self, growth: list[Array], exact: Array) -> Any:
        """Return the laminar map with its growth and the bounds of both together; see `MapPlan`."""
        scale, most = reynolds_axis(self.mobility, self.cells, LARGEST_REYNOLDS)
        M, center = self.coarse.growth(*growth)
        table = replace(
            self.laminar.kept(),
            growth=np.ascontiguousarray(M.transpose(1, 2, 0, 3)),
            growth_center=center,
            growth_axis=np.array([scale, math.log1p(most / scale)]),
            mobility=checksum_of(self.mobility),
        )
        return replace(table, bounds=self.laminar.grown_bounds(table, exact, self._states()[2]))
