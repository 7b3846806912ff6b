"""Films that conserve their oil, without dimensions."""

import numpy as np
import pytest

from rotorfilm.bearings.films.mass_conserving import ConservedFilm, Supply, conserved_cells


@pytest.fixture(scope="session")
def supply():
    """Return a function that makes a supply of held openings."""

    def make(pressures, end=0.0, center=0.0):
        n = len(pressures)
        held = np.array(pressures, dtype=float)
        return Supply(held, np.zeros(n, dtype=bool), np.zeros(n), end, center)

    return make


@pytest.fixture(scope="session")
def film_of(supply):
    """Return a function that makes the film of a geometry; `end` is the pressure at its ends."""

    def make(geometry, cells=(72, 6), slenderness=0.5, end=0.0):
        pressures = [end + (span.held or 0.0) for span in geometry.openings()]
        cells = conserved_cells(geometry, *cells)
        return ConservedFilm(cells, slenderness, supply(pressures, end, end + geometry.supply))

    return make
