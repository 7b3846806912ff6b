"""Films that conserve their oil with their temperature over and across them: limits, balances, order."""

import dataclasses

import numpy as np
import pytest

from rotorfilm import (
    Cooling,
    FeedHole,
    FilmContactError,
    Groove,
    HeatedFilm,
    HeatedJFOFilm,
    InputError,
    JFOFilm,
    JournalBearing,
    Oil,
    RigidRotor,
    coefficients,
    equilibrium,
    export_fmu,
    heated_equilibrium,
    simulate,
)
from rotorfilm.bearings import BushRing, HeldWalls, LayeredTemperature, MeanTemperature
from rotorfilm.bearings.oil.heated_bearing import carried_share
from rotorfilm.charts import plot_heated_film

R, L, c, T_S = 0.05, 0.05, 75e-6, 318.15
OMEGA, POSITION, LOAD = 314.0, np.array([22e-6, -37e-6]), np.array([0.0, -5000.0])
REST = np.zeros(2)
TOP = Groove(center=0.5 * np.pi, width=np.radians(20.0), length=0.04)
HOLES = tuple(FeedHole(center=angle, diameter=0.014) for angle in (0.3, 2.8))
SIDES = tuple(Groove(center=angle, width=np.radians(20.0)) for angle in (0.0, np.pi))
BATH = {"cavitation_pressure": -1e5, "submerged": True}
FED = {
    "pocket": ({"grooves": (TOP,), "supply_pressure": 2e5}, {}),
    "holes": ({"grooves": HOLES, "supply_pressure": 1e5}, {}),
    "starved": ({"grooves": (TOP,)}, {"supply_flow": 5e-6}),
    "all round": ({"circumferential_groove": 0.005, "supply_pressure": 2e5}, BATH),
    "open": ({"grooves": SIDES}, {}),
}
PROFILES = {"mean": MeanTemperature(), "layers": LayeredTemperature(4)}
WALLS = BushRing(outer_radius=2.0 * R)


def bearing_of(oil=None, carry_over=0.8, **openings):
    cooling = Cooling(supply_temperature=T_S, carry_over=carry_over)
    return JournalBearing(
        radius=R, length=L, clearance=c, oil=oil or Oil.iso_vg(46), cooling=cooling, **openings
    )


def heated(fed="pocket", *, cells=(36, 4), oil=None, carry_over=0.8, **rest):
    openings, supply = FED[fed]
    film = JFOFilm(bearing=bearing_of(oil, carry_over, **openings), cells=cells, **supply)
    return HeatedJFOFilm(film=film, **rest)


@pytest.mark.closed_form
@pytest.mark.parametrize("profile", PROFILES)
@pytest.mark.parametrize("fed", FED)
def test_every_watt_is_accounted_for_and_that_of_torque_and_supply(fed, profile):
    state = heated(fed, walls=WALLS, profile=PROFILES[profile]).solve(POSITION, OMEGA)
    heat, frozen = state.heat, state.film.solve(POSITION, OMEGA)
    assert abs(heat.missing) <= 1e-12 * heat.made
    assert state.power_loss == pytest.approx(frozen.friction_torque * OMEGA, rel=1e-12)
    np.testing.assert_allclose(frozen.force, state.force, rtol=1e-12)
    losses = state.film.losses(POSITION, [0.0, 0.0], OMEGA)
    assert heat.made == pytest.approx(losses.power_loss, rel=1e-12)
    assert state.side_flow - state.drawn_in == pytest.approx((state.inflow - state.arriving).sum(), rel=1e-10)


@pytest.mark.closed_form
@pytest.mark.parametrize("profile", PROFILES)
@pytest.mark.parametrize("fed", ["pocket", "holes", "starved", "open"])
def test_mean_temperature_of_leaking_oil_is_that_of_one_heat_balance(fed, profile):
    """Oil that does not thin, walls without heat, and all that arrives goes on: P = C Q (T - T_s)."""
    film = heated(fed, oil=Oil.constant(0.02), carry_over=1.0, profile=PROFILES[profile])
    state = film.solve(POSITION, OMEGA)
    per_flow = float(film.bearing.oil.volumetric_heat(T_S)) * state.side_flow
    expected = film.film.balanced_temperature(POSITION, np.zeros(2), OMEGA)
    assert T_S + state.heat.leaked / per_flow == pytest.approx(expected, abs=1e-7)
    assert expected > T_S + 5.0
    assert state.heat.drained == pytest.approx(0.0, abs=1e-8 * state.heat.made)
    same = film.film.at_temperature(T_S).solve(POSITION, OMEGA)
    np.testing.assert_allclose(state.force, same.force, rtol=1e-12)
    np.testing.assert_allclose(state.filled.sum(), same.oil_content[film.cold().film.cells.opening < 0].sum())


@pytest.mark.closed_form
@pytest.mark.parametrize("profile", PROFILES)
def test_oil_that_conducts_at_once_is_isothermal(profile):
    oil = dataclasses.replace(Oil.iso_vg(46), conductivity=1e9)
    walls = HeldWalls(bush_temperature=T_S, journal_temperature=T_S)
    film = heated("holes", oil=oil, walls=walls, profile=PROFILES[profile])
    state = film.solve(POSITION, OMEGA)
    assert state.maximum_temperature == pytest.approx(T_S, abs=1e-5)
    np.testing.assert_allclose(
        state.force, film.film.at_temperature(T_S).solve(POSITION, OMEGA).force, rtol=1e-6
    )


@pytest.mark.closed_form
@pytest.mark.parametrize("carry_over", [0.0, 0.6, 1.0])
def test_openings_mix_what_arrives_with_what_their_balance_asks_for(carry_over):
    """T_g = T_s + a (T_in - T_s), a near the lesser of lambda Q_in/Q_out, 1; of a given flow all goes on."""
    state = heated(carry_over=carry_over).solve(POSITION, OMEGA)
    per_flow = float(Oil.iso_vg(46).volumetric_heat(T_S))
    given, warm = float(state.inflow[0]), float(state.opening_temperature[0]) - T_S
    share = carried_share(state.inflow, state.arriving, carry_over)[0][0]
    assert share == pytest.approx(carry_over * state.arriving[0] / given, rel=1e-4, abs=1e-9)
    arriving = state.heat.drained / per_flow + given * warm  # Q_in (T_in - T_s)
    assert state.arriving[0] * warm == pytest.approx(share * arriving, rel=1e-10, abs=1e-18)
    fed = heated("starved", carry_over=carry_over).solve(POSITION, OMEGA)
    assert fed.inflow - fed.arriving == pytest.approx(5e-6, rel=1e-10)
    assert fed.heat.drained == pytest.approx(0.0, abs=1e-11 * fed.heat.made)


@pytest.mark.closed_form
@pytest.mark.parametrize("profile", PROFILES)
def test_mirrored_rotation(profile):
    film, mirror = heated("open", walls=WALLS, profile=PROFILES[profile]), np.array([1.0, -1.0])
    forward, backward = film.solve(POSITION, OMEGA), film.solve(mirror * POSITION, -OMEGA)
    np.testing.assert_allclose(backward.force, mirror * forward.force, rtol=1e-9)
    assert backward.friction_torque == pytest.approx(-forward.friction_torque, rel=1e-9)
    assert backward.maximum_temperature == pytest.approx(forward.maximum_temperature, rel=1e-10)


@pytest.mark.convergence
def test_slopes_of_the_frozen_film_are_exact():
    film = heated("pocket", profile=PROFILES["layers"]).solve(POSITION, OMEGA).film
    assert film.fluidity.dragged.max() - film.fluidity.dragged.min() > 0.01
    J, errors = film.jacobian(POSITION, np.zeros(2), OMEGA), []
    for h in (1e-3, 5e-4):
        steps = [(h * c * axis, 0.0) for axis in np.eye(2)] + [(np.zeros(2), h * OMEGA)]
        difference = [
            (
                film.force(POSITION + q, [0.0, 0.0], OMEGA + w)
                - film.force(POSITION - q, [0.0, 0.0], OMEGA - w)
            )
            / (2.0 * (np.hypot(*q) + w))
            for q, w in steps
        ]
        error = np.abs(np.column_stack(difference) / J[:, [0, 1, 4]] - 1.0)
        errors.append(error.max())
    assert errors[1] < 1e-4
    assert errors[1] < 0.5 * errors[0]
    K = coefficients(film, POSITION, OMEGA, frequency=1e-6)
    np.testing.assert_allclose(K.stiffness, -J[:, :2], rtol=1e-6)


@pytest.mark.convergence
def test_open_grooves_are_those_of_reynolds_rupture():
    """Film starts at its openings there: both are the same film in the limit, on other cells."""
    film = heated("open", cells=(108, 10), walls=WALLS)
    found = heated_equilibrium(film, LOAD, OMEGA)
    other = heated_equilibrium(HeatedFilm(bearing=film.bearing, walls=WALLS, cells=(80, 8)), LOAD, OMEGA)
    np.testing.assert_allclose(found.rest.position, other.rest.position, atol=5e-3 * c)
    np.testing.assert_allclose(found.rest.residual, 0.0, atol=1e-10)
    assert found.state.power_loss == pytest.approx(other.state.power_loss, rel=5e-3)
    assert found.state.maximum_temperature == pytest.approx(other.state.maximum_temperature, abs=0.2)
    assert found.state.heat.drained == pytest.approx(other.state.heat.drained, rel=0.03)


@pytest.mark.convergence
def test_order_of_the_cells():
    states, sizes = c * np.array([[0.3, -0.5], [0.45, -0.3], [0.2, -0.3]]), (1, 2, 3)

    def answers(n):
        film = heated("open", cells=(36 * n, 4 * n), walls=WALLS)
        found = [film.solve(position, OMEGA) for position in states]
        return np.array([[*s.force, s.power_loss, s.maximum_temperature - T_S] for s in found])

    exact = answers(6)
    errors = [np.sqrt(np.mean((answers(n) / exact - 1.0) ** 2, axis=0)) for n in sizes]
    slopes = -np.polyfit(np.log(sizes), np.log(errors), 1)[0]
    assert min(slopes) > 0.9 * HeatedJFOFilm.order
    assert errors[-1].max() < 0.02


def test_what_breaks_a_rule_is_named():
    film = heated()
    with pytest.raises(InputError, match="take HeatedJFOFilm"):
        HeatedFilm(bearing=film.bearing)
    cold = JFOFilm(bearing=JournalBearing(radius=R, length=L, clearance=c, viscosity=0.03, grooves=(TOP,)))
    with pytest.raises(InputError, match="oil and cooling must be given"):
        HeatedJFOFilm(film=cold)
    with pytest.raises(InputError, match="film must be a JFOFilm"):
        HeatedJFOFilm(film=film.bearing)
    with pytest.raises(InputError, match="speed must not be 0"):
        film.solve(POSITION, 0.0)
    with pytest.raises(FilmContactError, match="inside the clearance"):
        film.solve([c, 0.0], OMEGA)


def test_the_film_that_steps_begin_with_stands():
    groove = {"grooves": (TOP,)}
    film = JFOFilm(
        bearing=JournalBearing(radius=R, length=0.05, clearance=1e-4, viscosity=0.02, **groove),
        cells=(36, 4),
        supply_flow=5e-7,
    )
    u = [0.51e-4 * np.cos(4.6753), 0.51e-4 * np.sin(4.6753), 0.0, 0.0, -300.0]
    first = film.start(u)
    _, output, _ = film.step(first, 0.0, u, 1e-2)
    np.testing.assert_allclose(output[:2], first.output[:2], rtol=1e-9)


def test_a_viscosity_field_does_not_step_in_time(tmp_path):
    frozen = heated().solve(POSITION, OMEGA).film
    rotor = RigidRotor(mass=500.0, speed=OMEGA, position=tuple(POSITION))
    with pytest.raises(InputError, match="film must have one viscosity for steps in time and FMUs"):
        simulate(rotor, frozen, duration=1e-3)
    with pytest.raises(InputError, match="film must have one viscosity for steps in time and FMUs"):
        export_fmu(frozen, tmp_path / "frozen.fmu")
    with pytest.raises(InputError, match="temperature must not be set on a film with a"):
        frozen.at_temperature(T_S)


def test_it_rests_where_one_temperature_has_it_about_and_is_drawn():
    film = heated("pocket", walls=WALLS, profile=PROFILES["layers"])
    found = heated_equilibrium(film, LOAD, OMEGA)
    one = equilibrium(film.film, LOAD, OMEGA)
    np.testing.assert_allclose(found.rest.position, one.position, atol=0.08 * c)
    assert found.state.maximum_temperature > one.temperature
    axes = plot_heated_film(found.state).draw()
    assert len(axes) == 3
    assert axes[0].get_ylim() == pytest.approx((-25.0, 25.0), abs=4.0)
