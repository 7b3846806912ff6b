"""Layers across a turbulent film: their conduction, velocity, power, and the temperature of a bearing."""

import math

import numpy as np
import pytest
from numpy.testing import assert_allclose

import rotorfilm as rf
from rotorfilm.analysis import heated_equilibrium
from rotorfilm.bearings import BushRing, LayeredTemperature, MeanTemperature, Turbulence
from rotorfilm.bearings.films.eddy_layers import eddy_moments, eddy_transfer, heat_transfer, laminar_moments
from rotorfilm.bearings.films.turbulence import eddy_film
from rotorfilm.bearings.journal.energy_equation import layer_shares

SIZE = {"radius": 0.25, "length": 0.4, "clearance": 5e-4}
COOLING = rf.Cooling(supply_temperature=318.15)
OIL = rf.Oil.two_points((313.15, 32e-6), (373.15, 5.36e-6))
PLACE, SPEED = [1.5e-4, -2e-4], 100.0 * math.pi
NUMBERS, PRANDTL = np.array([1000.0, 2000.0, 10000.0]), 300.0


def conducted(layers):
    """Return the conduction of layers at the Reynolds numbers."""
    return eddy_transfer(NUMBERS, np.full(3, PRANDTL), layers)


@pytest.mark.closed_form
@pytest.mark.parametrize("layers", [4, 5, 12])
def test_layers_in_series_conduct_what_the_whole_film_does(layers):
    of = conducted(layers)
    whole = 1.0 / (2.0 / of.beside[..., 0] + np.sum(1.0 / of.between, axis=-1))
    assert_allclose(whole, heat_transfer(NUMBERS, PRANDTL)[1], rtol=1e-3)


@pytest.mark.closed_form
def test_without_turbulence_layers_conduct_and_move_as_still_oil():
    still = np.array([1e-9])
    of = eddy_transfer(still, np.array([PRANDTL]), 8)
    assert_allclose(of.between, np.full((1, 7), 8.0))
    assert_allclose(of.beside, [[16.0, 0.0, 1.0 / 3.0]], atol=1e-3)
    assert_allclose(of.shifted, np.full((2, 1, 7), 1.0 / 6.0), atol=1e-2)
    assert_allclose(eddy_moments(still, 5)[:, 0], laminar_moments(5), atol=1e-9)


def own_nusselt(layers):
    """Return Nu of layers that their own dissipation warms, between two walls of one temperature."""
    of, made = conducted(layers), eddy_moments(NUMBERS, layers)[0]
    found = []
    for n, (between, (first, _, direct)) in enumerate(zip(of.between, of.beside, strict=True)):
        ends = np.zeros(layers)
        ends[[0, -1]] = 1.0
        beyond, before = np.append(between, 0.0), np.append(0.0, between)
        matrix = np.diag(beyond + before + first * ends) - np.diag(between, 1) - np.diag(between, -1)
        shift = of.shifted[0, n] * made[n, 1:] - of.shifted[1, n] * made[n, :-1]
        heat = made[n] * (1.0 - direct * ends) + np.diff(shift, prepend=0.0, append=0.0)
        found.append(0.5 / np.linalg.solve(matrix, heat).mean())
    return np.array(found)


@pytest.mark.closed_form
@pytest.mark.parametrize("layers", [2, 5, 8, 24])
def test_oil_that_its_own_dissipation_warms_has_the_nusselt_number_of_the_whole_film(layers):
    assert_allclose(own_nusselt(layers), heat_transfer(NUMBERS, PRANDTL)[0], rtol=5e-3)


@pytest.mark.closed_form
@pytest.mark.parametrize("layers", [4, 7])
def test_layers_have_the_velocity_of_turbulent_couette_flow(layers):
    film = eddy_film(np.array([5000.0]))
    place, sheared = 0.5 - film.arm[:, 0], (film.weights * film.tau / film.f)[:, 0]
    velocity = np.cumsum(sheared) - 0.5 * sheared  # at the places, from the wall that stands
    shares = layer_shares(np.ones(layers), eddy_moments(np.array([5000.0]), layers)[:, 0])
    fine = (np.arange(1000 * layers) + 0.5) / (1000 * layers)
    known = np.interp(np.minimum(fine, 1.0 - fine), np.append(0.0, place), np.append(0.0, velocity))
    exact = np.where(fine < 0.5, known, 1.0 - known)
    assert_allclose(layers * shares.dragged, exact.reshape(layers, 1000).mean(axis=1), atol=2e-3)
    edges = np.interp(np.arange(layers + 1) / layers, np.append(0.0, fine), np.append(0.0, exact))
    assert_allclose(shares.sheared, np.diff(edges), atol=4e-3)


def bearing(oil, **effect):
    return rf.JournalBearing(**SIZE, oil=oil, cooling=COOLING, turbulence=Turbulence(**effect))


def test_oil_of_one_viscosity_has_force_flow_and_power_of_the_mobility():
    own = bearing(rf.Oil.constant(0.0163), closure="reichardt")
    mean, across = (
        rf.HeatedFilm(bearing=own, cells=(48, 8), profile=profile).solve(PLACE, SPEED)
        for profile in (MeanTemperature(), LayeredTemperature(7))
    )
    assert_allclose(across.force, mean.force, rtol=1e-12)
    assert across.power_loss == pytest.approx(mean.power_loss, rel=1e-12)
    assert across.side_flow == pytest.approx(mean.side_flow, rel=1e-12)


def test_the_power_is_that_of_the_torque_whatever_is_warm_across_the_film():
    own = bearing(OIL, closure="ng_pan")
    walls = rf.bearings.HeldWalls(bush_temperature=310.0, journal_temperature=350.0)
    state = rf.HeatedFilm(bearing=own, walls=walls, cells=(48, 8), profile=LayeredTemperature(6)).solve(
        PLACE, SPEED
    )
    film, e = state.film, np.array(PLACE) / SIZE["clearance"]
    cells, P = film.cells, state.pressure / film.bearing.pressure_scale
    assert np.ptp(film.fluidity.dragged) > 0.01
    rise, dragged = np.roll(P, -1, axis=0) - P, film.fluidity.mean_at_faces().dragged
    H = 1.0 - e @ [np.cos(cells.face), np.sin(cells.face)]
    torque = 12.0 * np.sum(cells.width * H[:, None] * dragged * rise)
    sheared = film.walls(SPEED, cells.mean_thickness(e))[0] * film.fluidity.sheared
    torque += SPEED * np.sum(state.filled * cells.integral_of_inverse(e) * cells.width * sheared)
    unit = film.bearing.force_scale * SIZE["clearance"]
    assert state.friction_torque == pytest.approx(torque * unit, rel=1e-10)
    assert abs(state.heat.missing) < 1e-10 * state.heat.made


def test_layers_find_the_hottest_oil_of_the_mean_beside_even_walls():
    """The note has 76.5 degC with one mean across the film, 250 kW and an eccentricity ratio of 0.611."""
    own = bearing(OIL, closure="ng_pan", band=False)
    even = BushRing(outer_radius=0.5, conductivity=1e6, transfer=0.0)
    film = rf.HeatedFilm(bearing=own, walls=even, profile=LayeredTemperature(8))
    at = heated_equilibrium(film, [0.0, -3e5], SPEED)
    assert at.state.maximum_temperature - 273.15 == pytest.approx(76.5, abs=2.5)
    assert 1e-3 * at.state.power_loss == pytest.approx(250.0, rel=0.01)
    assert at.rest.eccentricity_ratio == pytest.approx(0.611, abs=0.01)
    assert abs(at.state.heat.missing) < 1e-4 * at.state.heat.made
