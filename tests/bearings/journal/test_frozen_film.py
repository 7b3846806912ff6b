"""The film of a viscosity field: that of Reynolds' equation where it is uniform, its derivatives exact."""

import numpy as np
import pytest

from rotorfilm import Groove, Pad
from rotorfilm.bearings.films.mass_conserving import Fluidity
from rotorfilm.bearings.journal import JournalBearing, ReynoldsFilm
from rotorfilm.bearings.journal.film_flow import FrozenFilm, film_cells

CELLS = (48, 8)
OPENINGS = {
    "plain": {},
    "pads": {"pads": (Pad(start=0.3, extent=2.0), Pad(start=2.6, extent=3.0))},
    "grooves": {"grooves": (Groove(center=0.0, width=0.35), Groove(center=np.pi, width=0.35))},
    "supply": {"grooves": (Groove(center=1.0),), "supply_pressure": 1e5},
}
STATE = np.array([1.5e-3, 2e-3]), 300.0


def bearing_of(openings):
    film = ReynoldsFilm(cells=CELLS)
    return JournalBearing(radius=0.05, length=0.05, clearance=75e-6, viscosity=0.03, film=film, **openings)


def frozen(bearing, eccentricity, fluidity=None):
    spans, grids = bearing.fitted_film.grids(bearing.slenderness)
    cells = film_cells(spans, grids[0], bearing.slenderness, eccentricity)
    lines, along = cells.shape
    return FrozenFilm(
        cells=cells,
        fluidity=fluidity or Fluidity(np.ones(cells.shape), np.full(cells.shape, 0.5), np.ones(cells.shape)),
        empty=np.zeros((lines, along - 1), dtype=bool),
        bearing=bearing,
    )


@pytest.mark.closed_form
@pytest.mark.parametrize("openings", OPENINGS)
@pytest.mark.parametrize("eccentricity", [(0.1, -0.5), (-0.3, -0.8), (0.0, 0.01)])
def test_uniform_viscosity_is_the_reynolds_film(openings, eccentricity):
    bearing, e = bearing_of(OPENINGS[openings]), np.array(eccentricity)
    film, (velocity, speed) = frozen(bearing, e), STATE
    position = e * bearing.clearance
    force = bearing.force(position, velocity, speed)
    np.testing.assert_allclose(film.force(position, velocity, speed), force, rtol=1e-12)
    jacobian = bearing.jacobian(position, velocity, speed)
    np.testing.assert_allclose(film.jacobian(position, velocity, speed), jacobian, rtol=1e-10)
    fx, fy, slopes = film.prepare_tangent()(*position, *velocity, speed)
    np.testing.assert_allclose([fx, fy], force, rtol=1e-12)
    np.testing.assert_allclose(slopes, jacobian.ravel(), rtol=1e-10)


@pytest.mark.closed_form
@pytest.mark.parametrize("openings", OPENINGS)
def test_derivatives_of_any_field_are_exact(openings):
    bearing, e, rng = bearing_of(OPENINGS[openings]), np.array([0.1, -0.5]), np.random.default_rng(1)
    shape = frozen(bearing, e).cells.shape
    fluidity = Fluidity(
        np.exp(0.3 * rng.standard_normal(shape)), 0.5 + 0.05 * rng.standard_normal(shape), np.ones(shape)
    )
    film, (velocity, speed) = frozen(bearing, e, fluidity), STATE
    state = np.array([*(e * bearing.clearance), *velocity, speed])
    jacobian = film.jacobian(state[:2], state[2:4], state[4])
    for column, scale in enumerate([bearing.clearance, bearing.clearance, 1e-2, 1e-2, speed]):
        step = np.zeros(5)
        step[column] = 1e-6 * scale
        ahead, behind = (film.force(u[:2], u[2:4], u[4]) for u in (state + step, state - step))
        difference = (ahead - behind) / (2.0 * step[column])
        np.testing.assert_allclose(
            jacobian[:, column], difference, rtol=2e-7, atol=1e-9 * abs(jacobian).max()
        )


def test_thicker_oil_carries_more_in_proportion():
    bearing, e = bearing_of(OPENINGS["grooves"]), np.array([0.1, -0.5])
    film = frozen(bearing, e)
    thick = frozen(bearing, e, film.fluidity._replace(pressed=film.fluidity.pressed / 3.0))
    at = e * bearing.clearance, *STATE
    np.testing.assert_allclose(thick.force(*at), 3.0 * film.force(*at), rtol=1e-12)


def test_batches_are_their_states():
    bearing, e = bearing_of(OPENINGS["plain"]), np.array([0.1, -0.5])
    film = frozen(bearing, e)
    position = bearing.clearance * np.array([[0.1, 0.3], [-0.5, 0.2]])
    velocity, speed = np.zeros((2, 2)), np.array([100.0, 200.0])
    force = film.force(position, velocity, speed)
    for k in range(2):
        np.testing.assert_array_equal(force[:, k], film.force(position[:, k], velocity[:, k], speed[k]))
    assert film.jacobian(position, velocity, speed).shape == (2, 5, 2)
