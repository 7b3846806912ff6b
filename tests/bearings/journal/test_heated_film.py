"""Films with their temperature over and across them: limits, balances, symmetry, and order."""

import dataclasses

import numpy as np
import pytest

from rotorfilm import FilmContactError, Groove, InputError, ValidityWarning
from rotorfilm.analysis import coefficients, heated_equilibrium
from rotorfilm.bearings.journal import (
    AdiabaticWalls,
    BushRing,
    HeatedFilm,
    HeldWalls,
    JournalBearing,
    LayeredTemperature,
    MeanTemperature,
    ReynoldsFilm,
)
from rotorfilm.bearings.oil import Cooling, Oil

R, c, T_S = 0.05, 75e-6, 318.15
OMEGA = 100.0 * np.pi
POSITION = np.array([22e-6, -37e-6])
LOAD = np.array([0.0, -5000.0])
CELLS = (32, 4)
TWO = {"grooves": (Groove(center=0.0, width=0.35), Groove(center=np.pi, width=0.35))}
SUPPLIED = {**TWO, "supply_pressure": 2e5, "film": ReynoldsFilm()}
OPENINGS = {"plain": {}, "grooves": TWO, "supply": SUPPLIED}
WALLS = {
    "adiabatic": AdiabaticWalls(),
    "ring": BushRing(outer_radius=2.0 * R),
    "insulated": BushRing(outer_radius=2.0 * R, transfer=0.0),
    "shaft": BushRing(outer_radius=2.0 * R, shaft_conductance=3.0),
    "held": HeldWalls(bush_temperature=320.0, journal_temperature=325.0),
}
PROFILES = {"mean": MeanTemperature(), "layers": LayeredTemperature(6)}


def bearing_of(oil=None, cooling=None, **geometry):
    oil, cooling = oil or Oil.iso_vg(46), cooling or Cooling(supply_temperature=T_S)
    return JournalBearing(radius=R, length=0.05, clearance=c, oil=oil, cooling=cooling, **geometry)


def heated(walls=WALLS["adiabatic"], profile=PROFILES["mean"], cells=CELLS, **kept):
    return HeatedFilm(bearing=bearing_of(**kept), walls=walls, cells=cells, profile=profile)


@pytest.mark.closed_form
@pytest.mark.parametrize("profile", PROFILES)
def test_oil_that_does_not_thin_is_isothermal(profile):
    film = heated(oil=Oil.constant(0.03), profile=PROFILES[profile])
    state = film.solve(POSITION, OMEGA)
    cold = JournalBearing(radius=R, length=0.05, clearance=c, viscosity=0.03, film=ReynoldsFilm(cells=CELLS))
    np.testing.assert_allclose(state.force, cold.force(POSITION, np.zeros(2), OMEGA), rtol=1e-12)
    expected = cold.jacobian(POSITION, np.zeros(2), OMEGA)
    np.testing.assert_allclose(state.film.jacobian(POSITION, np.zeros(2), OMEGA), expected, rtol=1e-10)
    assert state.maximum_temperature > T_S + 20.0


@pytest.mark.closed_form
@pytest.mark.parametrize("profile", PROFILES)
@pytest.mark.parametrize("openings", ["plain", "grooves"])
def test_oil_that_conducts_at_once_is_isothermal(profile, openings):
    walls = HeldWalls(bush_temperature=T_S, journal_temperature=T_S)
    oil = Oil.iso_vg(46)
    film = heated(
        walls, PROFILES[profile], oil=dataclasses.replace(oil, conductivity=1e9), **OPENINGS[openings]
    )
    still = heated(
        profile=PROFILES[profile], oil=Oil.constant(float(oil.viscosity(T_S))), **OPENINGS[openings]
    )
    state = film.solve(POSITION, OMEGA)
    np.testing.assert_allclose(state.force, still.solve(POSITION, OMEGA).force, rtol=1e-6)
    assert state.maximum_temperature == pytest.approx(T_S, abs=1e-5)


@pytest.mark.closed_form
def test_oil_that_conducts_at_once_is_linear_between_its_walls():
    walls = HeldWalls(bush_temperature=320.0, journal_temperature=340.0)
    oil = dataclasses.replace(Oil.iso_vg(46), conductivity=1e9)
    mean, layers = (heated(walls, profile, oil=oil, **TWO) for profile in PROFILES.values())
    film = ~mean.cold().cells.held
    over = mean.solve(POSITION, OMEGA).oil_temperature[film]
    np.testing.assert_allclose(over, 330.0, atol=1e-5)
    across = layers.solve(POSITION, OMEGA).oil_temperature[film]
    eta = (np.arange(6) + 0.5) / 6.0
    np.testing.assert_allclose(across, np.broadcast_to(320.0 + 20.0 * eta, across.shape), atol=1e-3)


@pytest.mark.closed_form
@pytest.mark.parametrize("profile", PROFILES)
@pytest.mark.parametrize("walls", WALLS)
@pytest.mark.parametrize("openings", OPENINGS)
def test_every_watt_is_accounted_for(profile, walls, openings):
    state = heated(WALLS[walls], PROFILES[profile], **OPENINGS[openings]).solve(POSITION, OMEGA)
    heat = state.heat
    assert abs(heat.missing) <= 1e-12 * heat.made
    taken = {"adiabatic": 0.0, "insulated": 0.0}
    if walls in taken:
        assert heat.into_bush == pytest.approx(taken[walls], abs=1e-9 * heat.made)
    if walls in ("ring", "insulated"):
        assert heat.into_journal == pytest.approx(0.0, abs=1e-9 * heat.made)
    if walls == "shaft":
        assert heat.into_journal == pytest.approx(3.0 * (state.journal_temperature - 303.15), rel=1e-9)
    if walls == "ring":
        extent, ring = state.film.cells.extent, WALLS["ring"]
        if openings == "plain":
            mean = float(state.bush_temperature @ extent) / (2.0 * np.pi)
            through = 2.0 * np.pi * R * 0.05 * ring.mean_transfer(R) * (mean - 303.15)
            assert heat.into_bush == pytest.approx(through, rel=1e-9)


@pytest.mark.closed_form
@pytest.mark.parametrize("openings", OPENINGS)
def test_power_is_that_of_the_torque(openings):
    """M_J = M_s + (E x F)/2, with M_s the shear of the oil that there is."""
    bearing = bearing_of(**OPENINGS[openings])
    state = HeatedFilm(bearing=bearing, cells=CELLS).solve(POSITION, OMEGA)
    film = state.film
    sheared = (state.filled * film.cells.width / film.fluidity.pressed).sum(axis=1)
    inverse = film.cells.integral_of_inverse(POSITION / c)[:, 0]
    M_s = bearing.film_viscosity * OMEGA * R**3 * bearing.length / c * float(sheared @ inverse)
    E, F = POSITION, state.force
    torque = M_s + 0.5 * (E[0] * F[1] - E[1] * F[0])
    assert state.friction_torque == pytest.approx(torque, rel=1e-12)
    assert state.power_loss == pytest.approx(torque * OMEGA, rel=1e-12)
    assert (state.power_loss < state.heat.made - 1e-6) == (openings == "supply")


@pytest.mark.closed_form
@pytest.mark.parametrize("profile", PROFILES)
@pytest.mark.parametrize("openings", OPENINGS)
def test_mirrored_rotation(profile, openings):
    film = heated(WALLS["ring"], PROFILES[profile], **OPENINGS[openings])
    mirror = np.array([1.0, -1.0])
    forward, backward = film.solve(POSITION, OMEGA), film.solve(mirror * POSITION, -OMEGA)
    np.testing.assert_allclose(backward.force, mirror * forward.force, rtol=1e-9)
    assert backward.friction_torque == pytest.approx(-forward.friction_torque, rel=1e-9)
    assert backward.maximum_temperature == pytest.approx(forward.maximum_temperature, rel=1e-10)
    assert backward.side_flow == pytest.approx(forward.side_flow, rel=1e-9)


@pytest.mark.closed_form
@pytest.mark.parametrize("layers", [4, 16])
def test_couette_flow_between_walls_of_one_temperature(layers):
    """T - T_w = mu U^2/(2 k) eta (1 - eta): a middle warmer by mu U^2/(8 k), a mean by mu U^2/(12 k)."""
    speed, mu, thin = 20.0, 0.02, 20e-6
    cooling = Cooling(supply_temperature=350.0, full_gap=True)
    bearing = dataclasses.replace(bearing_of(Oil.constant(mu), cooling), clearance=thin)
    walls = HeldWalls(bush_temperature=350.0, journal_temperature=350.0)
    at = {"position": [0.0, -1e-9], "speed": speed}
    unit = mu * (R * speed) ** 2 / bearing.oil.conductivity
    rise = HeatedFilm(bearing=bearing, walls=walls, cells=(16, 4)).solve(**at).oil_temperature - 350.0
    np.testing.assert_allclose(rise, unit / 12.0, rtol=1e-5)
    profile = LayeredTemperature(layers)
    film = HeatedFilm(bearing=bearing, walls=walls, cells=(16, 4), profile=profile)
    rise = film.solve(**at).oil_temperature - 350.0
    eta = (np.arange(layers) + 0.5) / layers
    np.testing.assert_allclose(rise, np.broadcast_to(0.5 * unit * eta * (1.0 - eta), rise.shape), rtol=1e-4)


@pytest.mark.long
@pytest.mark.convergence
def test_order_of_the_cells():
    states = c * np.array([[0.3, -0.5], [0.45, -0.3], [0.2, -0.3]])
    sizes = (2, 3, 4)

    def answers(n):
        film = heated(WALLS["ring"], cells=(16 * n, 4 * n), **TWO)
        found = [film.solve(position, OMEGA) for position in states]
        return np.array([[*s.force, s.power_loss, s.maximum_temperature - T_S] for s in found])

    exact = answers(6)
    errors = [np.sqrt(np.mean((answers(n) / exact - 1.0) ** 2, axis=0)) for n in sizes]
    slopes = -np.polyfit(np.log(sizes), np.log(errors), 1)[0]
    assert min(slopes) > 0.9 * HeatedFilm.order
    assert errors[-1].max() < 0.02


@pytest.mark.long
@pytest.mark.convergence
def test_layers_converge():
    film = heated(WALLS["ring"], cells=(80, 8), **TWO)
    found = []
    for layers in (8, 16, 24):
        at = heated_equilibrium(dataclasses.replace(film, profile=LayeredTemperature(layers)), LOAD, OMEGA)
        found.append((at.rest.eccentricity_ratio, at.state.power_loss, at.state.maximum_temperature - T_S))
    first, second = np.abs(np.diff(found, axis=0))
    assert (second < 0.4 * first).all()
    assert (first < [0.0015, 1.5, 0.2]).all()


def test_rungs_agree_where_the_profile_is_flat():
    """Na = .2: a slow bearing, by energy equations that share nothing but the flow."""
    bearing = JournalBearing(
        radius=0.15,
        length=0.18,
        clearance=2e-4,
        oil=Oil.iso_vg(220),
        cooling=Cooling(supply_temperature=313.15),
        grooves=(Groove(center=0.5 * np.pi, width=np.radians(20.0)),),
    )
    mean = HeatedFilm(bearing=bearing, walls=BushRing(outer_radius=0.3), cells=(48, 4))
    across = dataclasses.replace(mean, profile=LayeredTemperature(8))
    over, through = (heated_equilibrium(film, [0.0, -60000.0], 10.472) for film in (mean, across))
    assert over.rest.eccentricity_ratio == pytest.approx(through.rest.eccentricity_ratio, rel=5e-3)
    assert over.state.power_loss == pytest.approx(through.state.power_loss, rel=1.5e-2)
    assert over.state.maximum_temperature == pytest.approx(through.state.maximum_temperature, abs=0.2)


@pytest.mark.parametrize("profile", PROFILES)
def test_openings_mix_with_fresh_oil(profile):
    def found(carry_over):
        cooling = Cooling(supply_temperature=T_S, carry_over=carry_over)
        return heated(profile=PROFILES[profile], cooling=cooling, **TWO).solve(POSITION, OMEGA)

    renewed, kept = found(0.0), found(1.0)
    in_openings = renewed.film.cells.held
    np.testing.assert_allclose(renewed.oil_temperature[in_openings], T_S, atol=1e-9)
    assert kept.oil_temperature[in_openings].min() > T_S + 3.0
    assert kept.maximum_temperature > renewed.maximum_temperature + 3.0


def rests(bearing, load, speed, cells=(48, 4), **rest):
    """Return the equilibrium of a film with its temperature, checked against itself."""
    film = HeatedFilm(bearing=bearing, cells=cells, **rest)
    at = heated_equilibrium(film, [0.0, -load], speed)
    np.testing.assert_allclose(
        at.state.film.force(at.rest.position, np.zeros(2), speed), [0.0, load], atol=1e-8 * load
    )
    assert abs(at.state.heat.missing) < 1e-9 * at.state.heat.made
    return at


@pytest.mark.long
def test_a_light_load_with_a_groove_that_sits_badly_has_its_rest():
    bearing = JournalBearing(
        radius=0.0381,
        length=0.0238,
        clearance=28e-6,
        oil=Oil.iso_vg(32),
        cooling=Cooling(supply_temperature=318.15),
        grooves=(Groove(center=np.radians(41.4), width=np.radians(18.4)),),
    )
    at = rests(bearing, 508.0, 729.6)
    assert at.rest.eccentricity_ratio == pytest.approx(0.358, abs=0.008)  # 96 x 8 cells
    assert at.state.power_loss == pytest.approx(537.0, rel=0.02)


def test_a_large_plain_bearing_comes_to_rest_with_layers():
    bearing = JournalBearing(
        radius=0.25, length=0.4, clearance=0.5e-3, oil=Oil.iso_vg(32), cooling=Cooling(supply_temperature=T_S)
    )
    with pytest.warns(ValidityWarning, match="Taylor number .*at which Taylor vortices begin"):
        at = rests(bearing, 3e5, OMEGA, profile=LayeredTemperature(8))
    assert at.rounds < 40
    assert at.rest.eccentricity_ratio == pytest.approx(0.682, abs=0.006)  # 96 x 8 cells
    assert at.state.power_loss == pytest.approx(1.281e5, rel=0.01)


def test_a_film_hotter_than_its_viscosity_law_is_said():
    oil = Oil.thinning_at("30 mPa s", "20 degC", "0.01 1/K")
    with pytest.warns(ValidityWarning, match="oil is valid from -30 to 70 degC, and is used at"):
        rests(bearing_of(oil), 5000.0, OMEGA, cells=CELLS)


@pytest.mark.parametrize("seed", range(8))
def test_random_loads_and_grooves_have_their_rest(seed):
    rng = np.random.default_rng(100 + seed)
    start, count = rng.uniform(0.0, 2.0 * np.pi), int(rng.integers(0, 3))
    # Not straight under the load, where oil that leaves a groove can carry nothing.
    start = 0.5 * np.pi + rng.uniform(-2.0, 2.0) if count == 1 else start
    grooves = tuple(Groove(center=start + np.pi * k, width=rng.uniform(0.2, 0.5)) for k in range(count))
    bearing = bearing_of(Oil.iso_vg(int(rng.choice([32, 46, 68]))), grooves=grooves)
    load, speed = 10.0 ** rng.uniform(2.3, 4.0), rng.uniform(100.0, 500.0)
    at = rests(bearing, load, speed, cells=(32, 4))
    assert 0.0 < at.rest.eccentricity_ratio < 0.95
    assert T_S < at.state.maximum_temperature < T_S + 100.0


def test_film_starts_where_there_is_oil():
    state = heated(**TWO, cells=(48, 4)).solve(POSITION, OMEGA)
    cells, empty = state.film.cells, state.film.empty
    assert empty.any()
    free = dataclasses.replace(state.film, empty=np.zeros_like(empty))
    more = free.solve(POSITION / c, np.zeros(2), OMEGA).pressure
    assert more[empty].max() > 0.0
    assert (state.pressure[:, :-1][empty] == 0.0).all()
    ruptured = (state.filled < 1.0) & ~cells.held[:, None]
    assert state.filled[ruptured].min() > 0.0


@pytest.mark.parametrize("profile", PROFILES)
def test_equilibrium_balances_the_load_at_its_own_temperature(profile):
    film = heated(WALLS["ring"], PROFILES[profile], **TWO)
    found = heated_equilibrium(film, LOAD, OMEGA)
    assert found.rest.residual < 1e-11
    again = film.solve(found.rest.position, OMEGA)
    np.testing.assert_allclose(again.force, -LOAD, atol=1e-4 * 5000.0)
    assert again.maximum_temperature == pytest.approx(found.state.maximum_temperature, abs=2e-3)
    K = coefficients(found.state.film, found.rest.position, OMEGA)
    np.testing.assert_allclose(K.damping, K.damping.T, rtol=1e-9)
    assert np.linalg.eigvalsh(K.damping).min() > 0.0


def test_what_breaks_a_rule_is_named():
    film = heated()
    with pytest.raises(InputError, match="speed must not be 0"):
        film.solve(POSITION, 0.0)
    with pytest.raises(InputError, match=r"position must have shape \(2,\), got shape \(3,\)"):
        film.solve(np.zeros(3), OMEGA)
    with pytest.raises(FilmContactError, match="inside the clearance"):
        film.solve([c, 0.0], OMEGA)
    with pytest.raises(InputError, match="oil and cooling must be given"):
        HeatedFilm(bearing=JournalBearing(radius=R, length=0.05, clearance=c, viscosity=0.03))
    with pytest.raises(InputError, match="walls must be walls such as"):
        heated(walls=0.0)
    with pytest.raises(InputError, match="cells must be two multiples"):
        heated(cells=(30, 4))
    with pytest.raises(InputError, match="profile must be a profile such as"):
        heated(profile="layers")
    with pytest.raises(InputError, match="layers must be an integer, at least 2, got 1"):
        LayeredTemperature(1)
