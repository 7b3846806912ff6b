"""Turbulent films that conserve their oil: the laminar limit, full films, damping, shear of streamers."""

import math
from dataclasses import replace

import numpy as np
import pytest
from numpy.testing import assert_allclose

import rotorfilm as rf
from rotorfilm import Groove, InputError, JFOFilm
from rotorfilm.bearings import (
    AdiabaticWalls,
    BushRing,
    FullFilm,
    HeatedJFOFilm,
    LayeredTemperature,
    MeanTemperature,
    Turbulence,
    mobility_of,
)
from rotorfilm.bearings.journal import ReynoldsFilm
from rotorfilm.bearings.oil.heated_bearing import film_heat

SIZE = {"radius": 0.25, "length": 0.4, "clearance": 5e-4, "viscosity": 0.0163}
TOP = (Groove(center=1.5, width=0.35, length=0.3),)
SPEED, HERE, REST = 314.0, np.array([1.5e-4, -2e-4]), [0.0, 0.0]
EFFECT = Turbulence(closure="ng_pan")
FED = rf.JournalBearing(**SIZE, grooves=TOP, supply_pressure=2e5)
FILM = JFOFilm(bearing=replace(FED, turbulence=EFFECT), cells=(72, 6))
LINE = rf.JournalBearing(**SIZE, turbulence=EFFECT, grooves=(Groove(center=1.5),))
FLOODED = {"cavitation_pressure": -3e7, "submerged": True}


def told(film):
    state = film.solve(HERE, SPEED)
    K = film.complex_stiffness(HERE, SPEED, 20.0 + 90.0j)
    return [*state.force, state.friction_torque, state.side_flow, *state.inflow, *K.ravel()]


@pytest.mark.closed_form
def test_below_the_onset_the_film_is_the_laminar_one():
    slow = JFOFilm(bearing=replace(FED, turbulence=Turbulence(density=1.0)), cells=(72, 6))
    assert_allclose(told(slow), told(JFOFilm(bearing=FED, cells=(72, 6))), rtol=1e-12)
    assert told(FILM)[2] > 1.2 * told(slow)[2]


@pytest.mark.closed_form
def test_a_mobility_that_is_the_same_everywhere_is_another_viscosity():
    # H^3/2 and twice the shear are those of twice the viscosity.
    thick = mobility_of(lambda X: (0.5, 0.5, 1.0, 2.0), cells=8)
    found = told(JFOFilm(bearing=FED, cells=(48, 4), mobility=thick))
    twice = replace(FED, viscosity=2.0 * SIZE["viscosity"])
    assert_allclose(found, told(JFOFilm(bearing=twice, cells=(48, 4))), rtol=1e-9)


@pytest.mark.convergence
def test_a_full_film_comes_to_the_turbulent_film_of_reynolds_with_second_order():
    rings = replace(LINE, film=ReynoldsFilm(cells=(192, 16), cavitation=FullFilm()))
    fine, coarse = (
        replace(rings, film=replace(rings.film, cells=cells)).force(HERE, REST, SPEED)
        for cells in ((192, 16), (96, 8))
    )
    expected, size = (4.0 * fine - coarse) / 3.0, np.hypot(*fine)
    films = [JFOFilm(bearing=LINE, cells=cells, **FLOODED) for cells in ((72, 8), (144, 16))]
    assert films[0].solve(HERE, SPEED).oil_content.min() == 1.0
    first, second = (film.force(HERE, REST, SPEED) - expected for film in films)
    assert np.hypot(*first) / np.hypot(*second) == pytest.approx(4.0, rel=0.2)
    assert np.hypot(*second) < 2e-3 * size


@pytest.mark.closed_form
def test_the_force_at_rest_is_that_of_the_damping():
    # F = C (omega/2) z x e in a full film without supply. On lines a step h apart the wedge between two faces
    # is sin(h/2)/(h/2) of that which the damping has at a line; with it to round-off.
    film = JFOFilm(bearing=LINE, cells=(72, 6), **FLOODED)
    C, half = film.slow_coefficients(HERE, SPEED).damping, math.pi / len(film.film.cells.angle)
    x, y = HERE
    wedge = 0.5 * SPEED * math.sin(half) / half
    assert_allclose(film.force(HERE, REST, SPEED), wedge * C @ [-y, x], rtol=1e-8)


def test_derivatives_are_those_of_differences():
    by = FILM.jacobian(HERE, REST, SPEED)
    for k, step in ((0, 1e-9), (1, 1e-9), (4, 1e-4)):
        more, less = (
            FILM.force(HERE + sign * step * np.eye(5)[k, :2], REST, SPEED + sign * step * (k == 4))
            for sign in (1.0, -1.0)
        )
        assert_allclose((more - less) / (2.0 * step), by[:, k], atol=1e-6 * np.abs(by[:, k]).max())


@pytest.mark.closed_form
def test_streamers_are_sheared_as_the_full_gap_on_the_part_that_is_oil():
    film = FILM.film
    state = film.solve(film.gap(HERE / FILM.clearance), 0.5 * SPEED)
    empty = state.solution.full == 0
    laminar = replace(film, mobility=None)
    ratio = film.sheared_area(state)[empty] / laminar.sheared_area(state)[empty]
    whole = 870.0 * SPEED * SIZE["radius"] * SIZE["clearance"] / SIZE["viscosity"]
    tau = EFFECT.factors(whole * state.gap.line[empty], SIZE["radius"], SIZE["clearance"])[2]
    assert state.solution.theta[empty].min() < 0.9
    assert_allclose(ratio, tau, rtol=0.02)
    film_cells = film.cells.opening < 0
    inside = empty & film_cells & np.roll(film_cells, 1, 0) & np.roll(film_cells, -1, 0)
    exact = EFFECT.factors(whole * state.gap.line[inside], SIZE["radius"], SIZE["clearance"])[2]
    assert_allclose(film.sheared_area(state)[inside] / laminar.sheared_area(state)[inside], exact, rtol=1e-6)


def test_what_it_refuses():
    thick = mobility_of(lambda X: (0.5, 0.5, 1.0, 2.0), cells=8)
    with pytest.raises(InputError, match="mobility must be None in a turbulent bearing"):
        replace(FILM, mobility=thick)
    with pytest.raises(InputError, match="mobility must be a Mobility"):
        JFOFilm(bearing=FED, mobility=2.0)


def test_the_heat_of_a_turbulent_film_balances():
    oil = {"viscosity": None, "oil": rf.Oil.iso_vg(32), "cooling": rf.Cooling(supply_temperature=318.15)}
    film = replace(FILM, bearing=replace(FILM.bearing, **oil), cells=(36, 4))
    found = film.balanced_temperature(HERE, REST, SPEED)
    warm = film.at_temperature(found)
    heat, (fluid, cooling) = warm.losses(HERE, REST, SPEED), film.cooled
    balance = film_heat(heat, warm.bearing.film_viscosity, cooling)
    carried = float(fluid.volumetric_heat(318.15)) * balance.flow * (found - 318.15)
    assert carried == pytest.approx(heat.power_loss, rel=1e-5)


VG32, BUSH = rf.Oil.iso_vg(32), BushRing(outer_radius=0.5)
WARM = {"viscosity": None, "cooling": rf.Cooling(supply_temperature=318.15)}
PROFILES = [MeanTemperature(), LayeredTemperature(5)]


def heated(profile, effect=EFFECT, oil=VG32, walls=BUSH):
    """Return the film that conserves its oil with a temperature field, at one place of the journal."""
    film = JFOFilm(bearing=replace(FED, **WARM, oil=oil, turbulence=effect), cells=(36, 4))
    return HeatedJFOFilm(film=film, walls=walls, profile=profile).solve(HERE, SPEED)


@pytest.mark.parametrize("profile", PROFILES)
def test_a_turbulent_temperature_field_has_the_power_of_its_torque(profile):
    state = heated(profile)
    laminar = heated(profile, None)
    assert state.power_loss > 1.2 * laminar.power_loss
    assert state.film.solve(HERE, SPEED).power_loss == pytest.approx(state.power_loss, rel=1e-10)
    assert abs(state.heat.missing) < 1e-10 * state.heat.made
    by = state.film.jacobian(HERE, REST, SPEED)
    for k, step in ((0, 1e-9), (1, 1e-9), (4, 1e-4)):
        more, less = (
            state.film.force(HERE + sign * step * np.eye(5)[k, :2], REST, SPEED + sign * step * (k == 4))
            for sign in (1.0, -1.0)
        )
        assert_allclose((more - less) / (2.0 * step), by[:, k], atol=1e-6 * np.abs(by[:, k]).max())


@pytest.mark.closed_form
@pytest.mark.parametrize("profile", PROFILES)
def test_below_the_onset_a_temperature_field_is_the_laminar_one(profile):
    slow, laminar = (heated(profile, effect) for effect in (Turbulence(density=1.0), None))
    assert_allclose(slow.force, laminar.force, rtol=1e-10)
    assert_allclose(slow.oil_temperature, laminar.oil_temperature, rtol=1e-10)


@pytest.mark.closed_form
@pytest.mark.parametrize("profile", PROFILES)
def test_oil_of_one_viscosity_has_the_turbulent_film_that_conserves_it(profile):
    oil = rf.Oil.constant(0.0163)
    state = heated(profile, oil=oil)
    film = JFOFilm(
        bearing=replace(FED, **WARM, oil=oil, turbulence=EFFECT).at_temperature(318.15), cells=(36, 4)
    )
    known = film.solve(HERE, SPEED)
    assert_allclose(state.force, known.force, rtol=1e-10)
    assert state.power_loss == pytest.approx(known.power_loss, rel=1e-10)
    assert state.side_flow == pytest.approx(known.side_flow, rel=1e-10)


def test_eddies_cool_a_film_that_conserves_its_oil_between_even_walls():
    """Laminar oil conducts an eighth: between walls of one temperature it would be hotter."""
    even = BushRing(outer_radius=0.5, conductivity=1e6, transfer=0.0)
    insulated = heated(MeanTemperature(), walls=AdiabaticWalls())
    mean, across = (heated(profile, walls=even) for profile in PROFILES)
    assert mean.maximum_temperature < insulated.maximum_temperature - 4.0
    assert across.maximum_temperature == pytest.approx(mean.maximum_temperature, abs=2.0)
