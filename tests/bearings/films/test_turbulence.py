"""Turbulent films: closures, rows of a 500 mm bearing by an independent code, derivatives, the band."""

import math
import warnings
from dataclasses import replace

import numpy as np
import pytest
from numpy.testing import assert_allclose

import rotorfilm as rf
from rotorfilm import Groove, InputError, ValidityWarning
from rotorfilm.analysis import heated_equilibrium
from rotorfilm.bearings import (
    BushRing,
    PadGridFilm,
    PadMapFilm,
    Recess,
    RecessedPad,
    ReynoldsFilm,
    Turbulence,
    full_stress_forces,
    mobility_of,
)
from rotorfilm.bearings.films import eddy_layers, turbulence
from rotorfilm.bearings.journal import ExtrapolatedFilm

SIZE = {"radius": 0.25, "length": 0.4, "clearance": 5e-4}
OIL = rf.Oil.two_points((313.15, 32e-6), (373.15, 5.36e-6))
COOLING = rf.Cooling(supply_temperature=318.15)
LOAD, SPEED = [0.0, -3e5], 100.0 * math.pi
NUMBERS = np.array([1000.0, 2000.0, 5000.0, 10000.0])
RAW = {name: Turbulence(closure=name, band=False) for name in turbulence.CLOSURES}
GIVEN = {"oil": OIL, "temperature": 327.65}


def test_closures_are_those_of_the_note():
    wanted = [(17.50, 14.65, 1.767), (24.32, 18.32, 2.616), (42.73, 28.62, 4.823), (69.21, 43.57, 7.960)]
    assert_allclose(turbulence.reichardt(NUMBERS).T, wanted, rtol=5e-4)
    assert_allclose(turbulence.ng_pan(NUMBERS)[:, 1], (24.72, 18.35, 2.521), rtol=3e-4)
    assert_allclose(turbulence.constantinescu(NUMBERS)[:, 1], (25.91, 17.53, 2.521), rtol=3e-4)
    assert_allclose(turbulence.hirs(NUMBERS)[:, 1], (21.1, 14.1, 2.9), rtol=0.02)


def test_friction_is_that_of_the_measured_couette_flow():
    """Robertson (1959): sqrt(4 tau_c/Re) log10(Re/4) = 0.19."""
    friction = np.sqrt(4.0 * turbulence.reichardt(NUMBERS)[2] / NUMBERS) * np.log10(NUMBERS / 4.0)
    assert_allclose(friction[1:], (0.195, 0.192, 0.192), atol=6e-4)


@pytest.mark.closed_form
def test_heat_transfer_is_that_of_the_note_and_of_laminar_flow():
    found = eddy_layers.heat_transfer(NUMBERS, 300.0)
    assert_allclose(found, [(29.8, 49.3, 102.0, 183.0), (12.5, 21.5, 45.9, 83.0)], rtol=6e-3)
    assert_allclose(eddy_layers.heat_transfer(np.array([1e-3]), 300.0)[:, 0], (6.0, 1.0), rtol=1e-3)


def test_the_band_is_twice_differentiable_and_begins_at_taylors_number():
    edges = Turbulence().edges(0.25, 5e-4)
    assert edges[0] == pytest.approx(921.26, abs=5e-3)
    assert edges[1] == 2.0 * edges[0]
    assert Turbulence().edges(0.25, 1e-4)[0] == turbulence.TURBULENT
    for edge in edges:
        near = turbulence.blend(edge * np.exp(np.linspace(-2e-3, 2e-3, 5)), edges)
        assert abs(np.diff(near, 2)).max() < 1e-6  # a kink of the slope would leave 1e-3
    assert_allclose(turbulence.blend(np.array([0.0, 900.0, 1e5]), edges), (0.0, 0.0, 1.0), atol=1e-15)


@pytest.mark.parametrize("closure", turbulence.CLOSURES)
def test_splines_are_the_closure_and_exactly_laminar_below_the_onset(closure):
    effect = Turbulence(closure=closure)
    mobility, X = effect.mobility(0.25, 5e-4, 870.0), np.linspace(0.0, 4e4, 4001)
    k_x, k_z, tau = effect.factors(X, 0.25, 5e-4)
    found = mobility.factors(X)[0]
    assert_allclose(found, [12.0 / k_x, 12.0 / k_z, np.ones_like(X), tau], rtol=1e-4)
    assert np.all(found[:, X < 921.0] == 1.0)
    unbanded = RAW[closure].mobility(0.25, 5e-4, 870.0).factors(X[20:])[0]
    assert_allclose(unbanded[3], turbulence.CLOSURES[closure](X[20:])[2], rtol=1e-5)


@pytest.mark.parametrize("band", [(1.0, 2.0), (10.0, 20.0), (100.0, 1e4), (1300.0, 2600.0)])
def test_splines_are_the_closure_to_the_last_reynolds_number_whatever_the_band(band):
    effect, X = Turbulence(band=band), np.geomspace(1.0, turbulence.LAST, 500)
    k_x, k_z, tau = effect.factors(X, 0.25, 5e-4)
    found = effect.mobility(0.25, 5e-4, 870.0).factors(X)[0]
    assert_allclose(found, [12.0 / k_x, 12.0 / k_z, np.ones_like(X), tau], rtol=1e-4)


@pytest.mark.parametrize(
    ("change", "message"),
    [
        ({"reynolds": [-1000.0, 5.0]}, "reynolds must not be negative, got -1000"),
        ({"reynolds": [5.0, math.nan]}, "reynolds must be finite"),
        ({"reynolds": math.inf}, "reynolds must be finite"),
        ({"radius": -0.1}, "radius must be finite and positive, got -0.1"),
        ({"clearance": math.nan}, "clearance must be finite and positive, got nan"),
    ],
)
def test_factors_of_impossible_films_are_refused(change, message):
    with pytest.raises(InputError, match=message):
        Turbulence().factors(**{"reynolds": 1000.0, "radius": 0.25, "clearance": 1e-4, **change})


def test_a_mobility_names_what_it_refuses():
    with pytest.raises(InputError, match="density must be finite and positive, got -5"):
        Turbulence().mobility(0.25, 1e-4, density=-5.0)
    with pytest.raises(InputError, match="radius must be finite and positive, got nan"):
        Turbulence().mobility(math.nan, 1e-4, 870.0)


def critical_mass(bearing, position):
    """Return the mass of a rigid rotor [t] at the limit of stability, by its quadratic equation."""
    film = rf.coefficients(bearing, position, SPEED)
    K, C = film.stiffness, film.damping
    stiff = np.trace(K @ np.array([[C[1, 1], -C[0, 1]], [-C[1, 0], C[0, 0]]])) / np.trace(C)
    return 1e-3 * stiff * np.linalg.det(C) / np.linalg.det(K - stiff * np.eye(2))


ROWS = {
    "ng_pan": (0.547, 298.0, 37.1),
    "constantinescu": (0.549, 297.0, 37.8),
    "hirs": (0.603, 330.0, 39.4),
    "reichardt": (0.552, 304.0, 36.5),
    "band": (0.574, 256.0, 34.4),
}
WARM_ROWS = {
    "ng_pan": (0.595, 264.0, 38.6, 63.0),
    "constantinescu": (0.599, 263.0, 40.0, 62.7),
    "hirs": (0.649, 300.0, 42.4, 63.7),
    "reichardt": (0.598, 271.0, 37.7, 63.4),
    "band": (0.605, 247.0, 34.7, 61.7),
}
EFFECTS = {**RAW, "band": Turbulence(closure="reichardt")}


@pytest.mark.parametrize("name", ROWS)
def test_a_large_bearing_of_one_temperature_is_that_of_the_note(name):
    """Another code, 144 x 10 cells: eccentricity, power and critical mass; F = C (speed/2) z x E."""
    bearing = rf.JournalBearing(**SIZE, **GIVEN, turbulence=EFFECTS[name])
    at = rf.equilibrium(bearing, LOAD, SPEED)
    eccentricity_ratio, power, mass = ROWS[name]
    assert at.eccentricity_ratio == pytest.approx(eccentricity_ratio, abs=0.005)
    assert 1e-3 * at.losses.power_loss == pytest.approx(power, rel=0.01)
    assert critical_mass(bearing, at.position) == pytest.approx(mass, rel=0.04)
    film = rf.coefficients(bearing, at.position, SPEED)
    turned = 0.5 * SPEED * np.array([-at.position[1], at.position[0]])
    assert_allclose(film.damping @ turned, bearing.force(at.position, [0.0, 0.0], SPEED), atol=1e-8 * 3e5)


@pytest.mark.parametrize("name", ["ng_pan", "reichardt", "hirs", "band"])
def test_a_large_bearing_in_the_balance_of_its_heat_is_that_of_the_note(name):
    bearing = rf.JournalBearing(**SIZE, oil=OIL, cooling=COOLING, turbulence=EFFECTS[name])
    at = rf.equilibrium(bearing, LOAD, SPEED)
    eccentricity_ratio, power, mass, temperature = WARM_ROWS[name]
    assert at.temperature - 273.15 == pytest.approx(temperature, abs=0.5)
    assert at.eccentricity_ratio == pytest.approx(eccentricity_ratio, abs=0.005)
    warm = bearing.at_temperature(at.temperature)
    losses = warm.losses(at.position, [0.0, 0.0], SPEED)
    assert 1e-3 * losses.power_loss == pytest.approx(power, rel=0.01)
    assert critical_mass(warm, at.position) == pytest.approx(mass, rel=0.04)
    carried = OIL.volumetric_heat(318.15) * losses.side_flow * (at.temperature - 318.15)
    assert losses.power_loss == pytest.approx(carried, rel=1e-4)


DAM = RecessedPad(start=0.2, extent=2.8, preload=0.2, recess=Recess(depth=5e-4, end=1.9, share=0.5))
PADS = {"radius": 0.25, "length": 0.4, "pad_clearance": 5e-4, **GIVEN}
PLACE, VELOCITY = np.array([1e-4, -1.5e-4]), np.array([0.01, 0.02])


def bearings(effect):
    """Return all kinds of bearings with this turbulence, by name."""
    grid, ring = PadGridFilm(cells=(32, 4)), ReynoldsFilm(cells=(48, 8))
    grooves = (Groove(center=0.4, width=0.3), Groove(center=3.5, width=0.3))
    pivots = rf.even_pivots(4, between_pads=True)
    tilting = rf.TiltingPadBearing(
        **PADS, pivots=pivots, extent=1.2, preload=0.5, film=grid, turbulence=effect
    )
    return {
        "plain": rf.JournalBearing(**SIZE, **GIVEN, film=ring, turbulence=effect),
        "grooved": rf.JournalBearing(**SIZE, **GIVEN, film=ring, grooves=grooves, turbulence=effect),
        "lobed": rf.LobedBearing(
            **PADS, lobes=rf.lobe_set("three_lobe", preload=0.3), film=grid, turbulence=effect
        ),
        "dam": rf.PressureDamBearing(**PADS, pads=(DAM,), cells=(32, 8), turbulence=effect),
        "tilting": tilting.at_rest(),
    }


@pytest.mark.parametrize("name", bearings(None))
def test_every_bearing_carries_more_above_the_onset_and_the_same_below_it(name):
    laminar, banded = (bearings(effect)[name] for effect in (None, Turbulence()))
    still = np.zeros(2)
    slow, fast = 0.3 * SPEED * 0.5, SPEED
    assert_allclose(*(one.force(PLACE, still, slow) for one in (laminar, banded)), rtol=1e-13)
    one, other = (np.hypot(*film.force(PLACE, still, fast)) for film in (laminar, banded))
    assert other > 1.1 * one if name != "tilting" else other != one  # with less film where it is thin
    for full_gap in (False, True):
        shear = [film.losses(PLACE, still, fast, full_gap=full_gap).power_loss for film in (laminar, banded)]
        assert shear[1] > (1.02 if name == "tilting" else 1.2) * shear[0]


@pytest.mark.parametrize("name", ["plain", "grooved", "lobed", "dam"])
def test_derivatives_by_speed_and_viscosity_are_those_of_differences(name):
    bearing = bearings(Turbulence(closure="reichardt", density=840.0))[name]
    mu = bearing.film_viscosity
    own = {"oil": None, "temperature": None}

    def force(viscosity, speed=SPEED):
        return replace(bearing, viscosity=viscosity, **own).force(PLACE, VELOCITY, speed)

    found = bearing.viscosity_slope(PLACE, VELOCITY, SPEED)
    slope = (force(mu * 1.0001) - force(mu * 0.9999)) / (2e-4 * mu)
    assert_allclose(found, slope, rtol=1e-6)
    by_speed = bearing.jacobian(PLACE, VELOCITY, SPEED)[:, 4]
    slope = (force(mu, SPEED + 0.01) - force(mu, SPEED - 0.01)) / 0.02
    assert_allclose(by_speed, slope, atol=1e-6 * np.abs(by_speed).max())


def test_a_laminar_film_above_its_onset_warns_and_a_turbulent_one_does_not():
    laminar = rf.JournalBearing(**SIZE, **GIVEN)
    with pytest.warns(
        ValidityWarning,
        match=r"Reynolds number 921.3 .* turbulence=rotorfilm.bearings.Turbulence\(\), or that key",
    ):
        rf.equilibrium(laminar, LOAD, SPEED)
    with warnings.catch_warnings(action="error"):
        rf.equilibrium(replace(laminar, turbulence=Turbulence()), LOAD, SPEED)


def test_impossible_turbulence_is_refused():
    with pytest.raises(InputError, match="closure must be one of ng_pan"):
        Turbulence(closure="prandtl")
    with pytest.raises(InputError, match="two rising Reynolds numbers"):
        Turbulence(band=(2000.0, 1000.0))
    with pytest.raises(InputError, match="local must be True or False"):
        Turbulence(local=1)
    whole = Turbulence(local=False)
    heated = rf.HeatedFilm(
        bearing=rf.JournalBearing(**SIZE, oil=OIL, cooling=COOLING, turbulence=whole), cells=(32, 4)
    )
    with pytest.raises(InputError, match="turbulence must have local=True in films with a temp"):
        heated_equilibrium(heated, LOAD, SPEED)
    with pytest.raises(InputError, match="turbulence must be a Turbulence"):
        rf.JournalBearing(**SIZE, **GIVEN, turbulence="hirs")
    with pytest.raises(InputError, match="film must be one that turbulence acts on"):
        rf.JournalBearing(**SIZE, **GIVEN, turbulence=Turbulence(), film=rf.ShortFilm())
    own = mobility_of(lambda H: (1.0, 1.0, 1.0, 1.0))
    film = ExtrapolatedFilm(film=ReynoldsFilm(mobility=own))
    with pytest.raises(InputError, match="no mobility of its own"):
        rf.JournalBearing(**SIZE, **GIVEN, turbulence=Turbulence(), film=film)
    law = mobility_of(lambda H: (1.0, 1.0, 1.0, 1.0 + 0.1 * H))
    lobes = rf.lobe_set("three_lobe", preload=0.3)
    own_law = rf.LobedBearing(**PADS, lobes=lobes, turbulence=Turbulence(), film=PadMapFilm(mobility=law))
    with pytest.raises(InputError, match="no mobility of its own"):
        own_law.force(PLACE, VELOCITY, SPEED)
    with pytest.raises(InputError, match="mobility must be None"):
        rf.PressureDamBearing(**PADS, pads=(DAM,), turbulence=Turbulence(), mobility=own)


@pytest.mark.parametrize("film", [ReynoldsFilm(cells=(96, 8)), rf.MapFilm()], ids=["grid", "map"])
def test_one_reynolds_number_is_that_of_the_note_on_a_grid_and_from_the_laminar_map(film):
    """At 54.5 degC eccentricity ratio 0.5245 and 331 kW; with the number of each place 0.547 and 298 kW."""
    effect = Turbulence(band=False, local=False)
    bearing = rf.JournalBearing(**SIZE, **GIVEN, film=film, turbulence=effect)
    at = rf.equilibrium(bearing, LOAD, SPEED)
    assert at.eccentricity_ratio == pytest.approx(0.5245, abs=0.003)
    assert at.losses.power_loss == pytest.approx(331e3, rel=0.01)


@pytest.mark.closed_form
def test_limits_of_an_endless_and_of_a_short_film_are_closed_forms():
    """Ng & Pan at Re 3000: e (0.5, 0), w (0, 1); a full film without ends, and a slim one."""
    mobility = RAW["ng_pan"].mobility(0.25, 5e-4, 870.0).at(3000.0)
    e, w = np.array([0.5, 0.0]), np.array([0.0, 1.0])

    def force(slenderness, **rule):
        film = ExtrapolatedFilm(film=ReynoldsFilm(cells=(96, 8), mobility=mobility, **rule))
        return film.force(e, w, slenderness)

    assert_allclose(force(1000.0, cavitation=rf.FullFilm()), (0.0, -102.13), atol=5e-3 * 102.13)
    assert_allclose(force(0.01) / 1e-4, (-10.125, -15.787), rtol=5e-3)


@pytest.mark.parametrize("density", [None, 1500.0])
def test_fields_of_temperature_and_the_full_stress_have_the_density_of_the_effect(density):
    effect = Turbulence(closure="reichardt", density=density)
    fresh = rf.JournalBearing(**SIZE, oil=OIL, cooling=COOLING, turbulence=effect)
    at_supply = fresh.at_temperature(COOLING.supply_temperature)
    known = at_supply.force(PLACE, [0.0, 0.0], SPEED)
    cold = rf.HeatedFilm(bearing=fresh, cells=(64, 8)).cold()
    assert_allclose(cold.force(PLACE, [0.0, 0.0], SPEED), known, rtol=0.01)
    assert_allclose(full_stress_forces(at_supply, PLACE, SPEED)[0], known, rtol=0.01)


@pytest.mark.parametrize("name", ["plain", "lobed", "dam"])
def test_the_full_stress_of_every_bearing_begins_with_the_film_of_the_quadrature(name):
    bearing = bearings(Turbulence(closure="reichardt"))[name]
    linear, full = full_stress_forces(bearing, PLACE, SPEED)
    assert_allclose(linear, bearing.force(PLACE, np.zeros(2), SPEED), atol=0.02 * np.hypot(*linear))
    assert 1e-4 < np.hypot(*(full - linear)) / np.hypot(*linear) < 0.1


def test_the_full_stress_needs_a_speed():
    bearing = rf.JournalBearing(**SIZE, **GIVEN, turbulence=Turbulence())
    with pytest.raises(InputError, match="speed must not be 0 for a turbulent film"):
        full_stress_forces(bearing, PLACE, 0.0)


def heated(effect, walls=None, **further):
    """Return the film of the large bearing with a temperature field, and its equilibrium."""
    bearing = rf.JournalBearing(**SIZE, oil=OIL, cooling=COOLING, turbulence=effect)
    film = rf.HeatedFilm(bearing=bearing, **({} if walls is None else {"walls": walls}), **further)
    return film, heated_equilibrium(film, LOAD, SPEED)


def test_heat_that_eddies_carry_to_the_walls_cools_the_hottest_oil():
    """The note: at most 87.1 degC between adiabatic walls, 76.5 beside even walls; power and place."""
    _, adiabatic = heated(RAW["ng_pan"])
    even = BushRing(outer_radius=0.5, conductivity=1e6, transfer=0.0)
    _, cooled = heated(RAW["ng_pan"], even)
    for at, hottest, eccentricity_ratio, power in (
        (adiabatic, 87.1, 0.607, 248.0),
        (cooled, 76.5, 0.611, 250.0),
    ):
        state = at.state
        assert state.maximum_temperature - 273.15 == pytest.approx(hottest, abs=2.5)
        assert at.rest.eccentricity_ratio == pytest.approx(eccentricity_ratio, abs=0.005)
        assert 1e-3 * state.power_loss == pytest.approx(power, rel=0.01)
        assert abs(state.heat.missing) < 1e-4 * state.heat.made
        film = rf.coefficients(state.film, at.rest.position, SPEED)
        x, y = at.rest.position
        turned = film.damping @ (0.5 * SPEED * np.array([-y, x]))
        assert_allclose(turned, state.film.force(at.rest.position, [0.0, 0.0], SPEED), atol=1e-8 * 3e5)


@pytest.mark.parametrize("name", ["plain", "dam", "tilting"])
def test_derivatives_of_a_film_with_a_temperature_field_are_those_of_differences(name):
    effect, own = Turbulence(closure="hirs"), {"temperature": None, "cooling": COOLING}
    bearing = replace(getattr(bearings(effect)[name], "bearing", bearings(effect)[name]), **own)
    film = rf.HeatedFilm(bearing=bearing, cells=(32, 4)).solve(PLACE, SPEED).film
    state, steps = np.array([*PLACE, *VELOCITY, SPEED]), [1e-10, 1e-10, 1e-7, 1e-7, 1e-3]
    if name == "tilting":
        state[2:4] = 0.0
    by = film.jacobian(state[:2], state[2:4], state[4])
    for k, step in enumerate(steps[: 5 if name != "tilting" else 2]):
        more, less = (state + sign * step * np.eye(5)[k] for sign in (1.0, -1.0))
        one, other = (film.force(each[:2], each[2:4], each[4]) for each in (more, less))
        atol = 2e-6 * np.abs(by[:, k]).max()
        assert_allclose(by[:, k], (one - other) / (2.0 * step), atol=atol, err_msg=f"column {k}")
