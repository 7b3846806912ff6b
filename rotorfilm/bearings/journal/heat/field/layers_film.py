"""The temperature over and across a film: layers between bush and journal (T3)."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from .....errors import require_count
from .....inputs.si_arguments import quantities
from .....model import Array
from ....films.conserved.fluidity import Fluidity
from .heat_equations import HeatEquations, Heating, HeatSolution, Terms, carried, drained, from_center
from .layer_shares import LayerShares, layer_shares


@quantities
@dataclass(frozen=True)
class LayeredTemperature:
    """The temperature in layers of equal share of the gap, each with its own velocity (Dowson, 1962).

        C (u T_x + u_z T_z + u_y T_y) = k T_yy + mu (u_y^2 + u_z,y^2)

    with the flow of the pressure itself shared by the layers as their viscosities have it, u_y from the
    balance of each layer, upwind, and the walls by one-sided differences of second order.

    Parameters
    ----------
    layers : int
        At least 2; 8, 12 and 24 differ by less than 0.5 % in eccentricity and rise.
    """

    layers: int = 12

    def __post_init__(self) -> None:
        require_count("layers", self.layers, 2)

    def shape(self, cells: tuple[int, int]) -> tuple[int, ...]:
        """Return the shape of a temperature of cells (N, M)."""
        return (*cells, self.layers)

    def fluidity(self, viscosity: Array) -> Fluidity:
        """Return how easily oil of a relative viscosity (N, M, layers) flows."""
        shares = layer_shares(1.0 / viscosity)
        return Fluidity(12.0 * shares.F2, shares.dragged.sum(axis=-1), 1.0 / shares.F0)

    def warm(self, heating: Heating) -> HeatSolution:
        """Return the temperature of a film, from one sparse solution."""
        flow, film, index = heating.flow, heating.film, heating.unknowns(self.layers)
        shares = layer_shares(1.0 / heating.viscosity)
        around, axial, central = _layer_flows(heating, shares)
        dragged = shares.dragged / shares.dragged.sum(axis=-1, keepdims=True)
        fresh, lost = (amount[..., None] * dragged for amount in (flow.fresh, flow.lost))
        inward = np.pad(axial, ((0, 0), (1, 0), (0, 0)))[:, :-1]
        if central is not None:
            inward[:, 0] = central
        net = np.roll(around, 1, axis=0) - around + inward - axial + fresh - lost
        upward = np.cumsum(net, axis=-1)[..., :-1]
        oil = carried(
            (index, np.roll(index, -1, axis=0), around),
            (index[:, :-1], index[:, 1:], axial[:, :-1]),
            (index[film][..., :-1], index[film][..., 1:], upward[film]),
            *from_center(heating, index[:, 0], central),
        )
        equations = HeatEquations(index.size, heating)
        made = heating.heat_scale * layer_heat(heating, shares)
        less = made * heating.thinning
        drawn = np.zeros(made.shape)
        drawn[:, -1] = np.maximum(-axial[:, -1], 0.0)
        arriving = np.bincount(oil.receiver, oil.amount, equations.size)[index]
        through = arriving + fresh + drawn + less
        equations.warm_film(index, oil, through, made + less * heating.temperature)
        bush, journal = self._conduct(equations, heating, index)
        x = equations.solve()
        T = x[index]
        leaked = lost
        leaked[:, -1] += np.maximum(axial[:, -1], 0.0)
        return HeatSolution(
            oil=T,
            openings=equations.in_openings(x),
            walls=equations.wall_temperatures(x),
            made=float(np.sum((made - less * (T - heating.temperature))[film])),
            leaked=float(np.sum((leaked * T)[film])),
            drained=drained(oil, x, index.size),
            to_bush=equations.total(bush, x),
            to_journal=equations.total(journal, x),
        )

    def _conduct(self, equations: HeatEquations, heating: Heating, index: np.ndarray) -> tuple[Terms, Terms]:
        """Add what layers conduct to each other and to the walls; return the latter."""
        film = heating.film
        each = self.layers * (heating.diffusion * heating.flow.shear)[film]
        layer, line = index[film], np.nonzero(film)[0]
        below, above = layer[..., :-1], layer[..., 1:]
        for here, there in ((below, above), (above, below)):
            equations.add(here, here, each[..., None])
            equations.add(here, there, -each[..., None])
        journal_column = np.full(each.shape, equations.journal)
        bush: Terms = [(layer[..., 0], 3.0 * each), (layer[..., 1], -each / 3.0)]
        journal: Terms = [(layer[..., -1], 3.0 * each), (layer[..., -2], -each / 3.0)]
        bush.append((equations.bush[line], -8.0 / 3.0 * each))
        journal.append((journal_column, -8.0 / 3.0 * each))
        equations.lose((layer[..., 0], layer[..., -1]), bush, journal, line)
        return bush, journal


def _layer_flows(heating: Heating, shares: LayerShares) -> tuple[Array, Array, Array | None]:
    """Return flows around, along and from the center, layer by layer, through faces as in `FilmFlow`."""
    flow = heating.flow
    dragged, pressed = (
        _normalized(field + np.roll(field, -1, axis=0)) for field in (shares.dragged, shares.pressed)
    )
    around = flow.dragged[..., None] * dragged + flow.pressed[..., None] * pressed
    sideways = np.concatenate(
        [shares.pressed[:, 1:] + shares.pressed[:, :-1], shares.pressed[:, -1:]], axis=1
    )
    central = None if flow.central is None else flow.central[:, None] * _normalized(shares.pressed[:, 0])
    return around, flow.axial[..., None] * _normalized(sideways), central


def _normalized(layers: Array) -> Array:
    return layers / layers.sum(axis=-1, keepdims=True)


def layer_heat(heating: Heating, shares: LayerShares) -> Array:
    """Return the heat that each layer makes [1/s^2]."""
    flow, speed = heating.flow, heating.speed
    dragged = (speed**2 * flow.shear / shares.F0)[..., None] * shares.sheared
    pressed = flow.dissipation[..., None] * shares.squeezed
    both = (24.0 * speed * flow.climb)[..., None] * shares.crossed
    return dragged + pressed + both
