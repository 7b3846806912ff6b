"""The temperature over a film: one mean across it, by finite volumes on the cells of the pressure (T2)."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from .....model import Array
from ....films.conserved.fluidity import Fluidity
from .heat_equations import HeatEquations, Heating, HeatSolution, Terms, carried, drained, from_center


@dataclass(frozen=True)
class MeanTemperature:
    """One temperature across the film, a parabola between the walls with that mean.

    With q the flow per length, alpha the share of the gap that oil fills and h the thickness,

        C div(q T) = mu U^2 alpha/h + h^3 |grad p|^2/(12 mu) - (k alpha/h) (12 T - 6 T_bush - 6 T_journal),

    of which (k alpha/h) (6 T - 4 T_bush - 2 T_journal) goes into the bush. Fluxes are those of the pressure
    itself, upwind: heat is accounted for to the last digit on any grid.
    """

    def shape(self, cells: tuple[int, int]) -> tuple[int, ...]:
        """Return the shape of a temperature of cells (N, M)."""
        return cells

    def fluidity(self, viscosity: Array) -> Fluidity:
        """Return how easily oil of a relative viscosity (N, M) flows."""
        return Fluidity(1.0 / viscosity, np.full(viscosity.shape, 0.5), viscosity)

    def warm(self, heating: Heating) -> HeatSolution:
        """Return the temperature of a film, from one sparse solution."""
        flow, film, index = heating.flow, heating.film, heating.unknowns()
        oil = carried(
            (index, np.roll(index, -1, axis=0), flow.around),
            (index[:, :-1], index[:, 1:], flow.axial[:, :-1]),
            *from_center(heating, index[:, 0], flow.central),
        )
        equations = HeatEquations(index.size, heating)
        made = heating.heat_scale * (heating.speed**2 * heating.viscosity * flow.shear + flow.dissipation)
        less = made * heating.thinning
        through = np.maximum(flow.entering, flow.leaving) + less
        equations.warm_film(index, oil, through, made + less * heating.temperature)
        bush, journal = _into_walls(equations, heating.diffusion * flow.shear, index)
        line = np.broadcast_to(np.arange(len(index))[:, None], index.shape)
        equations.lose((index, index), bush, journal, line)
        x = equations.solve()
        T = x[index]
        return HeatSolution(
            oil=T,
            openings=equations.in_openings(x),
            walls=equations.wall_temperatures(x),
            made=float(np.sum((made - less * (T - heating.temperature))[film])),
            leaked=float(np.sum((flow.leaked * T)[film])),
            drained=drained(oil, x, index.size),
            to_bush=equations.total(bush, x),
            to_journal=equations.total(journal, x),
        )


def _into_walls(equations: HeatEquations, into: Array, index: np.ndarray) -> tuple[Terms, Terms]:
    """Return the heat into bush and journal of each cell, of a parabola across the film."""
    at_bush = np.broadcast_to(equations.bush[:, None], index.shape)
    at_journal = np.full(index.shape, equations.journal)
    bush: Terms = [(index, 6.0 * into), (at_bush, -4.0 * into), (at_journal, -2.0 * into)]
    journal: Terms = [(index, 6.0 * into), (at_bush, -2.0 * into), (at_journal, -4.0 * into)]
    return bush, journal
