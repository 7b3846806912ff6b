"""One temperature for a film: the balance of its heat, at rest, at every state, and over time."""

from dataclasses import replace

import numpy as np
import pytest
from scipy.integrate import solve_ivp
from scipy.optimize import fsolve

from rotorfilm import (
    Cooling,
    Groove,
    InputError,
    JournalBearing,
    MapFilm,
    Oil,
    ReynoldsFilm,
    ShortFilm,
    coefficients,
    equilibrium,
)
from rotorfilm.bearings import Turbulence, heat_numbers
from rotorfilm.bearings.oil.heated_bearing import carried_share, effective_flow, flow_slopes

OIL = Oil.iso_vg(100)
COOLING = Cooling(supply_temperature=310.25)
SPEED = 50.0 * np.pi
LOAD = (0.0, -525.0)
AT = np.array([2e-5, -3e-5]), np.array([1e-4, -2e-3]), SPEED


def demo(**changes):
    given = {"radius": 0.05, "length": 0.03, "clearance": 1e-4, "oil": OIL, "cooling": COOLING}
    return JournalBearing(**{**given, **changes})


def test_a_turbulent_film_hotter_than_any_oil_names_the_speed():
    with pytest.raises(InputError, match=r"speed must leave the oil below 1000 K, got one at which"):
        equilibrium(demo(turbulence=Turbulence()), LOAD, 3e5)


def surplus(bearing, temperature, state):
    """Return heat made less heat taken away [W], from losses and oil alone."""
    losses = bearing.at_temperature(temperature).losses(*state)
    cooling = bearing.cooling
    heat = bearing.oil.volumetric_heat(cooling.supply_temperature)
    flow = effective_flow(losses.side_flow, losses.inflow, losses.arriving, cooling.carry_over)
    taken = heat * flow * (temperature - cooling.supply_temperature)
    return losses.power_loss - taken - cooling.housing_conductance * (temperature - cooling.ambient)


GROOVES = tuple(Groove(center=c, width=0.35) for c in (0.0, np.pi))


@pytest.mark.closed_form
@pytest.mark.parametrize(
    "bearing",
    [
        demo(),
        demo(film=ShortFilm()),
        demo(film=ReynoldsFilm(cells=(48, 4))),
        demo(cooling=replace(COOLING, housing_conductance=4.0, ambient_temperature=295.0, full_gap=True)),
        demo(film=ReynoldsFilm(cells=(48, 4)), grooves=GROOVES),
        demo(film=ReynoldsFilm(cells=(48, 4)), grooves=GROOVES, supply_pressure=5e4),
    ],
    ids=["map", "short", "grid", "housing", "grooves", "supply"],
)
def test_the_heat_of_an_equilibrium_balances(bearing):
    at = equilibrium(bearing, LOAD, SPEED)
    state = at.position, np.zeros(2), SPEED
    power = at.losses.power_loss
    assert abs(surplus(bearing, at.temperature, state)) < 1e-7 * power
    frozen = bearing.at_temperature(at.temperature)
    assert frozen.force(*state) == pytest.approx([0.0, 525.0], abs=1e-6)


@pytest.mark.literature
def test_the_demonstration_bearing_as_it_runs():
    # One temperature, all heat with the oil: eps .440, attitude 58.6 deg, 262 W, 52.5 degC, K_yy 12.3 MN/m by
    # a finite-volume code of its own; here within its own error of .3 % and 1 % of the rise.
    at = equilibrium(demo(), LOAD, SPEED)
    assert at.eccentricity_ratio == pytest.approx(0.440, rel=5e-3)
    assert np.degrees(at.attitude_angle) == pytest.approx(58.6, abs=0.3)
    assert at.losses.power_loss == pytest.approx(262.0, rel=5e-3)
    assert at.temperature - 273.15 == pytest.approx(52.5, abs=0.15)
    assert coefficients(demo(), at.position, SPEED).stiffness[1, 1] == pytest.approx(12.3e6, rel=1e-2)


@pytest.mark.closed_form
def test_an_oil_that_does_not_thin_is_the_isothermal_bearing():
    warm = demo(oil=Oil.constant(0.1))
    cold = JournalBearing(radius=0.05, length=0.03, clearance=1e-4, viscosity=0.1)
    at, isothermal = equilibrium(warm, LOAD, SPEED), equilibrium(cold, LOAD, SPEED)
    assert at.position == pytest.approx(isothermal.position, rel=1e-12)
    rise = isothermal.losses.power_loss / (
        warm.oil.volumetric_heat(COOLING.supply_temperature) * isothermal.losses.side_flow
    )
    assert at.temperature - COOLING.supply_temperature == pytest.approx(rise, rel=1e-9)


@pytest.mark.closed_form
def test_a_housing_that_conducts_everything_keeps_the_film_at_ambient():
    cooling = Cooling(supply_temperature=320.0, ambient_temperature=300.0, housing_conductance=1e9)
    assert equilibrium(demo(cooling=cooling), LOAD, SPEED).temperature == pytest.approx(300.0, abs=1e-5)


def test_the_balance_in_c_is_that_of_the_bracketing_search():
    bearing = demo()
    at = equilibrium(bearing, LOAD, SPEED)

    def residual(z):
        film = bearing.at_temperature(z[2])
        state = 1e-5 * z[:2], np.zeros(2), SPEED
        return [*(film.force(*state) + LOAD) / 525.0, surplus(bearing, z[2], state) / 100.0]

    x, y, temperature = fsolve(residual, [4.0, -2.0, 320.0], xtol=1e-12)
    assert at.position == pytest.approx([1e-5 * x, 1e-5 * y], rel=1e-8)
    assert at.temperature == pytest.approx(temperature, abs=1e-6)


@pytest.mark.parametrize("film", [MapFilm(), ShortFilm()], ids=["map", "short"])
def test_relaxed_derivatives_are_those_of_rebalanced_forces(film):
    bearing = demo(film=film, cooling=replace(COOLING, housing_conductance=3.0, ambient_temperature=300.0))
    balanced = bearing.balanced()
    slopes = balanced.jacobian(*AT)
    state = np.concatenate([AT[0], AT[1], [SPEED]])
    scale = np.array([1e-5, 1e-5, 1e-3, 1e-3, 100.0])

    def force(z):
        temperature = bearing.balanced_temperature(z[:2], z[2:4], z[4])
        return bearing.at_temperature(temperature).force(z[:2], z[2:4], z[4])

    for k in range(5):
        step = np.zeros(5)
        step[k] = 1e-4 * scale[k]
        slope = (force(state + step) - force(state - step)) / (2.0 * step[k])
        assert slopes[:, k] == pytest.approx(slope, rel=2e-5, abs=1e-6 * np.abs(slopes[:, k]).max())
    frozen = bearing.at_temperature(float(balanced.temperature(*AT))).jacobian(*AT)
    # A change of rank one in the position, and in vibration the temperature stays: another matrix.
    assert np.linalg.svd((slopes - frozen)[:, :4], compute_uv=False)[1] < 1e-7 * np.abs(frozen).max()
    assert np.abs(slopes - frozen)[:, :2].max() > 1e-2 * np.abs(frozen[:, :2]).max()


def test_over_time_the_bearing_comes_to_the_balance():
    bearing = demo(cooling=replace(COOLING, bush_heat_capacity=5.0))
    running = bearing.in_time()
    u = np.concatenate([AT[0], AT[1], [SPEED]])
    end = solve_ivp(lambda t, x: running.derivative(t, x, u), (0.0, 60.0), running.initial_state, rtol=1e-9)
    assert end.y[0, 0] == COOLING.supply_temperature
    assert end.y[0, -1] == pytest.approx(bearing.balanced_temperature(*AT), abs=1e-4)


@pytest.mark.closed_form
def test_the_exact_linearization_over_time():
    running = demo(cooling=replace(COOLING, housing_conductance=3.0)).in_time()
    u, x = np.concatenate([AT[0], AT[1], [SPEED]]), np.array([325.0])
    exact = running.linearization(0.0, x, u)
    whole = np.block([[exact.A, exact.B], [exact.C, exact.D]])
    z, scale = np.concatenate([x, u]), np.array([1.0, 1e-5, 1e-5, 1e-3, 1e-3, 100.0])

    def answer(z):
        return np.concatenate([running.derivative(0.0, z[:1], z[1:]), running.output(0.0, z[:1], z[1:])])

    for k in range(6):
        step = np.zeros(6)
        step[k] = 1e-4 * scale[k]
        slope = (answer(z + step) - answer(z - step)) / (2.0 * step[k])
        assert whole[:, k] == pytest.approx(slope, rel=1e-5, abs=1e-9 * np.abs(slope).max())


@pytest.mark.literature
def test_openings_whose_balance_gets_warmer_as_the_film_does():
    """What is replaced falls as the film warms. An independent code: VG 46, eps .575, 819 W, 61.5 degC."""
    grooves = tuple(Groove(center=center, width=np.radians(20.0)) for center in (0.0, np.pi))
    cooling, film = Cooling(supply_temperature=318.15), ReynoldsFilm(cells=(80, 8))
    size = {"length": 0.05, "clearance": 75e-6, "grooves": grooves}
    bearing = demo(**size, oil=Oil.iso_vg(46), cooling=cooling, film=film)
    at = equilibrium(bearing, [0.0, -5e3], 100.0 * np.pi)
    assert at.eccentricity_ratio == pytest.approx(0.575, rel=0.01)
    assert at.losses.power_loss == pytest.approx(819.0, rel=0.02)
    assert at.temperature - 273.15 == pytest.approx(61.5, abs=0.3)
    still = at.position, np.zeros(2), at.speed
    assert bearing.balanced_temperature(*still) == pytest.approx(at.temperature, abs=1e-6)


def test_a_bearing_that_begins_warm_stays_in_balance():
    at = equilibrium(demo(), LOAD, SPEED)
    running = demo().in_time(at.temperature)
    u = np.concatenate([at.position, np.zeros(2), [SPEED]])
    assert running.initial_state == at.temperature
    assert running.output(0.0, running.initial_state, u)[:2] == pytest.approx([0.0, 525.0], abs=1e-5)
    assert abs(running.derivative(0.0, running.initial_state, u)[0]) < 1e-6


def test_temperatures_are_given_in_degrees_too():
    warm = demo(cooling=Cooling(supply_temperature="37.1 degC", ambient_temperature="25 degC"))
    assert (warm.cooling.supply_temperature, warm.cooling.ambient_temperature) == (310.25, 298.15)
    assert demo(temperature="50 degC").temperature == 323.15


@pytest.mark.closed_form
def test_effective_flow_of_openings():
    # lambda 1: what leaks; lambda 0: Q_1 + Q_2 of each opening.
    inflow, arriving = np.array([3.0, 2.0]), np.array([1.0, 1.5])
    leaked = float((inflow - arriving).sum())
    assert effective_flow(leaked, inflow, arriving, 1.0) == pytest.approx(leaked)
    assert effective_flow(leaked, inflow, arriving, 0.0) == pytest.approx((inflow + arriving).sum())
    # Far below the intake all that clings to the shaft goes on, as if films had no limit.
    former = 2.0 * 0.2 * arriving[:1] / (1.0 + 0.8 * arriving[:1] / inflow[:1])
    assert effective_flow(0.0, inflow[:1], arriving[:1], 0.8) == pytest.approx(float(former[0]), rel=1e-5)
    # A film takes no more than its intake: the rest leaves, and no oil gets hotter than what heats it.
    assert effective_flow(0.0, np.ones(2), np.array([0.25, 2.48]), 0.8) == pytest.approx(1.563, abs=5e-4)
    assert effective_flow(0.0, np.array([0.0, -1.0]), np.array([2.0, -1.0]), 0.8) == 2.0


@pytest.mark.closed_form
@pytest.mark.parametrize("carry_over", [0.0, 0.5, 0.8, 0.9, 1.0])
def test_carried_share_is_a_smooth_minimum(carry_over):
    rng = np.random.default_rng(4)
    inflow, arriving = np.exp(rng.uniform(-3.0, 3.0, (2, 400)))
    x = carry_over * arriving / inflow
    share, by_inflow, by_arriving = carried_share(inflow, arriving, carry_over)
    assert (share <= np.minimum(x, 1.0)).all()
    np.testing.assert_allclose(share, np.minimum(x, 1.0), atol=0.05 * np.log(2.0))
    assert (by_arriving >= 0.0).all()
    assert (by_inflow <= 0.0).all()
    flows = np.stack([inflow, arriving])
    for k, slope in enumerate(flow_slopes(inflow, arriving, carry_over)):
        step = 1e-5 * flows * (np.arange(2) == k)[:, None]
        ends = [
            [effective_flow(0.0, *one[:, None], carry_over) for one in (flows + sign * step).T]
            for sign in (1.0, -1.0)
        ]
        expected = np.subtract(*ends) / (2.0 * step[k])
        np.testing.assert_allclose(slope, expected, rtol=2e-6, atol=2e-6)


@pytest.mark.parametrize(("turn", "colder"), [(60.0, 505.0), (-60.0, 460.0)])
def test_turned_grooves_do_not_heat_the_film(turn, colder):
    """T2 with adiabatic walls has the power `colder` [W]; without the cap T1 had 330 W at 60 degrees."""
    grooves = tuple(Groove(center=np.radians(at + turn), width=np.radians(30.0)) for at in (0.0, 180.0))
    bearing = JournalBearing(
        radius=0.0327,
        length=0.085,
        clearance=47e-6,
        oil=Oil.iso_vg(150),
        cooling=Cooling(supply_temperature=303.15),
        grooves=grooves,
        film=ReynoldsFilm(cells=(48, 8)),
    )
    at = equilibrium(bearing, [0.0, -6670.0], 158.9)
    assert at.losses.power_loss == pytest.approx(colder, rel=0.13)
    found = bearing.at_temperature(at.temperature).losses(at.position, [0.0, 0.0], 158.9)
    assert (found.arriving / found.inflow).max() > 2.0


@pytest.mark.parametrize(
    ("make", "match"),
    [
        (lambda: demo(viscosity=0.1), "viscosity must be None where oil is given"),
        (lambda: demo(oil=None), "viscosity or oil must be given"),
        (lambda: demo(cooling=None), "temperature or cooling must be given with oil"),
        (lambda: demo().force(*AT), "temperature must be stated"),
        (lambda: demo().balanced_temperature((0, 0), (0, 0), SPEED), "housing_conductance must be positive"),
        (lambda: Cooling(supply_temperature=45.0), "at least 150 K, got 45 K: .*'45 degC'"),
        (lambda: demo(temperature=52.0), "at least 150 K, got 52 K: .*'52 degC'"),
        (lambda: Cooling(supply_temperature=300.0, carry_over=1.2), "carry_over must be from 0 to 1"),
        (lambda: JournalBearing(radius=0.05, length=0.03, clearance=1e-4), "viscosity or oil must be given"),
    ],
)
def test_what_has_no_balance_is_refused(make, match):
    with pytest.raises(InputError, match=match):
        make()


@pytest.mark.closed_form
def test_numbers_of_heat_are_their_definitions():
    bearing, (position, _, speed) = demo(), AT
    T = COOLING.supply_temperature
    losses = bearing.at_temperature(T).losses(position, np.zeros(2), speed)
    heat, thinning = OIL.volumetric_heat(T), OIL.thinning(T)
    found = heat_numbers(bearing, ("20 um", "-30 um"), "1500 rpm")
    rise = losses.power_loss / (heat * losses.side_flow)
    assert found.thinning_rise == pytest.approx(thinning * rise, rel=1e-12)
    assert found.peclet == pytest.approx(speed * 1e-8 * heat / 0.13, rel=1e-12)
    assert found.nahme == pytest.approx(thinning * OIL.viscosity(T) * (speed * 0.05) ** 2 / 0.13, rel=1e-12)
    with pytest.raises(InputError, match=r"^position must be off the center, .*, got \(0.0, 0.0\)"):
        heat_numbers(bearing, (0.0, 0.0), speed)
    with pytest.raises(InputError, match=r"^bearing must be a WarmBearing, got 'film'"):
        heat_numbers("film", position, speed)
