"""Losses and heat of lobed bearings: identities, limits, and the same as of a grooved bearing."""

import dataclasses

import numpy as np
import pytest

from rotorfilm import (
    Cooling,
    FilmContactError,
    InputError,
    JournalBearing,
    Lobe,
    LobedBearing,
    Oil,
    Pad,
    ReynoldsFilm,
    RigidRotor,
    coefficients,
    equilibrium,
    export_fmu,
    lobe_set,
    simulate,
)
from rotorfilm.bearings import PadGridFilm, PadMapFilm, PadResolution, heat_surplus
from rotorfilm.bearings.pads.pad_bearing import behind_pads
from rotorfilm.bearings.pads.pad_build import PadMap, pad_grid

DEGREE = np.pi / 180.0
RADIUS, LENGTH, CLEARANCE, VISCOSITY, SPEED = 0.05, 0.05, 75e-6, 0.02, 314.0
FAST = PadResolution(cells=(64, 8), nodes=(14, 9, 40))
LOAD = (0.0, -3000.0)
COOLING = Cooling(supply_temperature=318.15, ambient_temperature=300.0, housing_conductance=2.0)
STATES = [((1e-5, -1.5e-5), (2e-3, -1e-3), SPEED), ((-1.2e-5, 8e-6), (1e-3, 3e-3), -SPEED)]


@pytest.fixture(scope="module")
def film():
    extents = [160.0 * DEGREE, 100.0 * DEGREE]
    return PadMapFilm(resolution=FAST, tables=tuple(PadMap(each, 0.5, FAST).built() for each in extents))


def bearing(film, lobes=None, **lubricant):
    return LobedBearing(
        radius=RADIUS,
        length=LENGTH,
        pad_clearance=CLEARANCE,
        lobes=lobes or lobe_set("three_lobe", preload=0.4),
        film=film,
        **(lubricant or {"viscosity": VISCOSITY}),
    )


def plain_halves(film, **lubricant):
    return bearing(
        film, tuple(Lobe(start=k * DEGREE, extent=160.0 * DEGREE) for k in (10.0, 190.0)), **lubricant
    )


def grooved(**lubricant):
    return JournalBearing(
        radius=RADIUS,
        length=LENGTH,
        clearance=CLEARANCE,
        pads=tuple(Pad(start=k * DEGREE, extent=160.0 * DEGREE) for k in (10.0, 190.0)),
        film=ReynoldsFilm(cells=(192, 8)),
        **lubricant,
    )


@pytest.mark.parametrize(("position", "velocity", "speed"), STATES)
@pytest.mark.parametrize("full_gap", [False, True])
def test_torques_power_and_flow_balance(film, position, velocity, speed, full_gap):
    of = bearing(film)
    force = of.force(position, velocity, speed)
    found = of.losses(position, velocity, speed, full_gap=full_gap)
    moment = position[0] * force[1] - position[1] * force[0]
    np.testing.assert_allclose(found.friction_torque - found.bush_torque, moment, rtol=1e-9)
    power = found.friction_torque * speed - force @ velocity
    np.testing.assert_allclose(found.power_loss, power, rtol=1e-13)
    np.testing.assert_allclose((found.inflow - found.arriving).sum(), found.side_flow, rtol=1e-13)
    assert found.power_loss > 0.0
    assert found.side_flow > 0.0


def test_pressure_part_of_the_power_is_twice_the_potentials(film):
    """P less the shear of all pads is -sum F.W, each twice its potential J, also in motion."""
    of, (position, velocity, speed) = bearing(film), STATES[0]
    still, total = 0.0, of.losses(position, velocity, speed, full_gap=True).power_loss
    for lobe in of.lobes:
        c, s = np.cos(lobe.middle), np.sin(lobe.middle)
        back = np.array([[c, s], [-s, c]])
        e = back @ (np.array(position) / CLEARANCE - lobe.center)
        w = back @ np.array(velocity) / CLEARANCE + 0.5 * speed * np.array([e[1], -e[0]])
        force = film.kernel(lobe.extent, 0.5).force(e[:, None], w[:, None]).values[:, 0]
        still -= of.force_scale * CLEARANCE * force @ w
        nodes, weights = np.polynomial.legendre.leggauss(40)
        t = 0.5 * lobe.extent * nodes
        gap = 0.5 * lobe.extent * (weights / (1.0 - e[0] * np.cos(t) - e[1] * np.sin(t))).sum()
        still += VISCOSITY * speed**2 * RADIUS**3 * LENGTH / CLEARANCE * gap
    np.testing.assert_allclose(total, still, rtol=1e-10)


def test_losses_are_those_of_the_films_on_grids(film):
    """Random states at rest, the sum of the pads beside `RingKernel.losses` of each."""
    of, random = bearing(film), np.random.default_rng(4)
    theta, chi = random.uniform(0.0, 2.0 * np.pi, 20), 0.5 * np.sqrt(random.uniform(size=20))
    position = CLEARANCE * chi * np.stack([np.cos(theta), np.sin(theta)])
    speed = random.choice([-SPEED, SPEED], 20)
    found = of.losses(position, np.zeros_like(position), speed)
    force = of.force(position, np.zeros_like(position), speed)
    unit = VISCOSITY * RADIUS**3 * LENGTH / CLEARANCE
    shear, flow = np.zeros((2, 20))
    torque = 0.5 * (position[0] * force[1] - position[1] * force[0])
    for lobe in of.lobes:
        c, s = np.cos(lobe.middle), np.sin(lobe.middle)
        e = np.array([[c, s], [-s, c]]) @ (position / CLEARANCE - np.array(lobe.center)[:, None])
        w = 0.5 * speed * np.stack([e[1], -e[0]])
        rows = pad_grid(lobe.extent, 0.5, (128, 16)).losses(e, w, 0.5 * speed)
        shear += rows[0] + rows[1]
        flow += rows[3] - rows[4]
        own = film.kernel(lobe.extent, 0.5).force(e, w).values * of.force_scale
        at = CLEARANCE * np.array(lobe.center)
        own = np.array([[c, -s], [s, c]]) @ own
        torque -= 0.5 * (at[0] * own[1] - at[1] * own[0])
    np.testing.assert_allclose(found.friction_torque, unit * speed * shear + torque, rtol=4e-3)
    leak = CLEARANCE * RADIUS * LENGTH * flow
    np.testing.assert_allclose(found.side_flow, leak, atol=5e-3 * CLEARANCE * RADIUS * LENGTH * SPEED)


def test_full_gap_of_a_centered_journal_is_the_share_of_petroff(film):
    """Concentric pads: 2 pi mu omega R^3 L/c, times the part of the circle that they cover."""
    petroff = 2.0 * np.pi * VISCOSITY * SPEED * RADIUS**3 * LENGTH / CLEARANCE
    of = plain_halves(film)
    for full_gap in (True, False):
        found = of.losses([0.0, 0.0], [0.0, 0.0], SPEED, full_gap=full_gap)
        share = found.friction_torque / petroff
        np.testing.assert_allclose(share, 320.0 / 360.0, rtol=1e-12 if full_gap else 3e-3)
    np.testing.assert_allclose(found.inflow, 0.5 * SPEED * CLEARANCE * RADIUS * LENGTH, rtol=3e-3)


@pytest.mark.parametrize("load", [300.0, 3000.0])
def test_plain_halves_are_a_bearing_with_two_grooves(film, load):
    found, other = (
        equilibrium(of, (0.0, -load), SPEED) for of in (plain_halves(film), grooved(viscosity=VISCOSITY))
    )
    np.testing.assert_allclose(found.position, other.position, atol=4e-3 * CLEARANCE)
    ours, theirs = found.losses, other.losses
    np.testing.assert_allclose(ours.power_loss, theirs.power_loss, rtol=3e-3)
    np.testing.assert_allclose(ours.friction_torque, theirs.friction_torque, rtol=3e-3)
    np.testing.assert_allclose(ours.bush_torque, theirs.bush_torque, rtol=3e-3)
    unit = 0.5 * SPEED * CLEARANCE * RADIUS * LENGTH
    np.testing.assert_allclose(ours.side_flow, theirs.side_flow, atol=1e-2 * unit)
    np.testing.assert_allclose(ours.inflow, theirs.inflow, atol=1e-2 * unit)
    np.testing.assert_allclose(ours.arriving, theirs.arriving, atol=1e-2 * unit)


@pytest.mark.parametrize("carry_over", [0.0, 0.8, 1.0])
def test_plain_halves_run_as_warm_as_a_bearing_with_two_grooves(film, carry_over):
    warm = {"oil": Oil.iso_vg(46), "cooling": dataclasses.replace(COOLING, carry_over=carry_over)}
    found, other = (equilibrium(of, LOAD, SPEED) for of in (plain_halves(film, **warm), grooved(**warm)))
    rise = other.temperature - COOLING.supply_temperature
    assert rise > 5.0
    np.testing.assert_allclose(found.temperature - other.temperature, 0.0, atol=5e-3 * rise)
    np.testing.assert_allclose(found.position, other.position, atol=4e-3 * CLEARANCE)
    np.testing.assert_allclose(found.losses.power_loss, other.losses.power_loss, rtol=5e-3)


def test_heat_of_the_equilibrium_balances(film):
    of = bearing(film, oil=Oil.iso_vg(46), cooling=COOLING)
    at = equilibrium(of, LOAD, SPEED)
    held = of.at_temperature(at.temperature)
    heat = held.film_heat(at.position, [0.0, 0.0], SPEED)
    surplus, _ = heat_surplus(heat, of.oil, COOLING, at.temperature)
    assert abs(surplus) < 1e-12 * heat.power
    np.testing.assert_allclose(held.force(at.position, [0.0, 0.0], SPEED), -np.array(LOAD), atol=1e-8)
    np.testing.assert_allclose(at.losses.power_loss, heat.power, rtol=1e-12)
    frozen = coefficients(held, at.position, SPEED)
    np.testing.assert_allclose(coefficients(of, at.position, SPEED).stiffness, frozen.stiffness, rtol=1e-12)


def test_oil_that_does_not_thin_is_isothermal(film):
    constant = Oil.constant(VISCOSITY)
    found = equilibrium(bearing(film, oil=constant, cooling=COOLING), LOAD, SPEED)
    other = equilibrium(bearing(film), LOAD, SPEED)
    np.testing.assert_allclose(found.position, other.position, rtol=1e-12)
    assert found.temperature > COOLING.supply_temperature + 1.0


def test_infinite_cooling_holds_the_ambient_temperature(film):
    cold = dataclasses.replace(COOLING, housing_conductance=1e12)
    at = equilibrium(bearing(film, oil=Oil.iso_vg(46), cooling=cold), LOAD, SPEED)
    np.testing.assert_allclose(at.temperature, COOLING.ambient_temperature, atol=1e-8)


def test_less_carry_over_and_more_housing_cool(film):
    def temperature(**changes):
        cooling = dataclasses.replace(COOLING, **changes)
        return equilibrium(bearing(film, oil=Oil.iso_vg(46), cooling=cooling), LOAD, SPEED).temperature

    assert temperature(carry_over=0.0) < temperature(carry_over=0.8) < temperature(carry_over=1.0)
    assert temperature(housing_conductance=20.0) < temperature() < temperature(full_gap=True)


@pytest.mark.parametrize(("position", "velocity", "speed"), STATES)
@pytest.mark.parametrize(("full_gap", "carry_over"), [(False, 0.8), (True, 0.0)])
def test_slopes_of_the_heat_are_those_of_the_heat(film, position, velocity, speed, full_gap, carry_over):
    cooling = dataclasses.replace(COOLING, full_gap=full_gap, carry_over=carry_over)
    of = bearing(film, oil=Oil.iso_vg(46), temperature=330.0, cooling=cooling)
    state = np.array([*position, *velocity, speed])
    slopes = of.heat_jacobian(position, velocity, speed)
    for k, step in enumerate((1e-10, 1e-10, 1e-6, 1e-6, 1e-3)):
        ahead, behind = state + step * np.eye(5)[k], state - step * np.eye(5)[k]
        heats = [of.film_heat(each[:2], each[2:4], each[4]) for each in (ahead, behind)]
        change = (
            np.array([heats[0].power, heats[0].flow, heats[0].side_flow])
            - [heats[1].power, heats[1].flow, heats[1].side_flow]
        ) / (2.0 * step)
        np.testing.assert_allclose(slopes[:, k], change, rtol=1e-6, atol=1e-12)


@pytest.mark.long
def test_film_in_time_comes_to_its_balance(film):
    """Held by a heavy rotor near its rest, the temperature goes from that of fresh oil to that in balance."""
    fast = dataclasses.replace(COOLING, bush_heat_capacity=0.2)
    of = bearing(film, oil=Oil.iso_vg(46), cooling=fast)
    rotor = RigidRotor(mass=300.0, speed=SPEED)
    at = equilibrium(of, (0.0, -300.0 * 9.80665), SPEED)
    path = simulate(rotor, of, duration=0.4, samples=5)
    np.testing.assert_allclose(path["temperature"][0], COOLING.supply_temperature)
    np.testing.assert_allclose(path["temperature"][-1], at.temperature, atol=0.02)
    np.testing.assert_allclose(path["power_loss"][-1], at.losses.power_loss, rtol=1e-3)


@pytest.mark.long
def test_warm_bearing_goes_into_an_fmu_with_its_maps(film, tmp_path):
    fmpy = pytest.importorskip("fmpy")
    of = bearing(film, oil=Oil.iso_vg(46), cooling=dataclasses.replace(COOLING, bush_heat_capacity=5.0))
    path = export_fmu(of, tmp_path / "warm.fmu")
    state = (1e-5, -1.5e-5, 0.0, 0.0, SPEED)
    names = [variable.name for variable in fmpy.read_model_description(str(path)).modelVariables]
    prefix = next(name for name in names if name.endswith("film_temperature")).removesuffix(
        "film_temperature"
    )
    kinds = [("time", float), *((prefix + name, float) for name in ("x", "y", "vx", "vy", "speed"))]
    given = np.array([(t, *state) for t in (0.0, 1.0)], dtype=kinds)
    wanted = [prefix + name for name in ("film_temperature", "force_x", "power_loss", "side_flow")]
    last = fmpy.simulate_fmu(str(path), stop_time=0.01, output_interval=0.01, input=given, output=wanted)[-1]
    temperature = float(last[wanted[0]])
    assert temperature > COOLING.supply_temperature + 0.1
    expected = of.in_time().output(0.0, [temperature], state)
    np.testing.assert_allclose([last[name] for name in wanted[1:]], expected[[0, 3, 4]], rtol=1e-9)


def test_openings_lie_behind_their_pads_in_whatever_order(film):
    lobes = lobe_set("three_lobe", preload=0.4)
    of, mixed = bearing(film, lobes), bearing(film, (lobes[2], lobes[0], lobes[1]))
    state = (1e-5, -1.5e-5), (0.0, 0.0), -SPEED
    one, other = of.losses(*state), mixed.losses(*state)
    np.testing.assert_allclose(other.inflow, one.inflow[[2, 0, 1]], rtol=1e-12)
    np.testing.assert_allclose(other.arriving, one.arriving[[2, 0, 1]], rtol=1e-12)
    starts = [lobe.start for lobe in lobes]
    into, out = behind_pads(starts, np.arange(3.0), 10.0 + np.arange(3.0), np.array(True))
    np.testing.assert_array_equal(into, [1.0, 2.0, 0.0])
    np.testing.assert_array_equal(out, [10.0, 11.0, 12.0])


def test_a_film_on_grids_tells_losses_too_and_one_without_none(film):
    state = (1e-5, -1.5e-5), (0.0, 0.0), SPEED
    exact, found = bearing(PadGridFilm(cells=(96, 8))).losses(*state), bearing(film).losses(*state)
    np.testing.assert_allclose(found.power_loss, exact.power_loss, rtol=3e-3)

    class Bare:
        def kernel(self, extent, slenderness):
            return pad_grid(extent, slenderness)

    assert bearing(Bare()).losses(*state) is None
    warm = bearing(Bare(), oil=Oil.iso_vg(46), cooling=COOLING)
    with pytest.raises(InputError, match="film must be one with losses"):
        warm.balanced_temperature([1e-5, 0.0], [0.0, 0.0], SPEED)
    with pytest.raises(InputError, match="film must have slopes of its losses"):
        bearing(PadGridFilm(), oil=Oil.iso_vg(46), temperature=330.0, cooling=COOLING).heat_jacobian(*state)


def test_what_a_lubricant_must_be(film):
    with pytest.raises(InputError, match="viscosity or oil must be given"):
        bearing(film, viscosity=None)
    with pytest.raises(InputError, match="viscosity must be None where oil is given"):
        bearing(film, viscosity=VISCOSITY, oil=Oil.iso_vg(46), temperature=330.0)
    with pytest.raises(InputError, match="temperature or cooling must be given"):
        bearing(film, oil=Oil.iso_vg(46))
    warm = bearing(film, oil=Oil.iso_vg(46), cooling=COOLING)
    with pytest.raises(InputError, match="temperature must be stated"):
        warm.force([0.0, 0.0], [0.0, 0.0], SPEED)
    assert warm.native() is None
    assert warm.at_temperature(330.0).native() is not None
    with pytest.raises(FilmContactError, match="lobe"):
        bearing(film).losses([0.7 * CLEARANCE, 0.0], [0.0, 0.0], SPEED)
