"""Losses and heat of tilting pads under a journal at rest."""

import dataclasses
import warnings

import numpy as np
import pytest

from rotorfilm import (
    Cooling,
    Disk,
    ElasticMaterial,
    InputError,
    Oil,
    ShaftElement,
    ShaftRotor,
    Station,
    TiltingPadBearing,
    ValidityWarning,
    coefficients,
    equilibrium,
    even_pivots,
    rotor_equilibrium,
    whirl_threshold,
)
from rotorfilm.bearings import PadGridFilm, PadMapFilm, PadResolution, heat_surplus
from rotorfilm.bearings.pads.pad_build import PadMap, pad_grid
from rotorfilm.bearings.pads.pads_at_rest import directions, turning

DEGREE = np.pi / 180.0
SPEED, LOAD = 314.0, (300.0, -3000.0)
FAST = PadResolution(cells=(64, 8), nodes=(14, 9, 40))
COOLING = Cooling(supply_temperature=318.15, ambient_temperature=300.0, housing_conductance=2.0)
OIL = Oil.iso_vg(46)


@pytest.fixture(scope="module")
def film():
    return PadMapFilm(resolution=FAST, tables=(PadMap(60.0 * DEGREE, 0.5, FAST).built(),))


@pytest.fixture
def five(tilting, film):
    """Return a bearing of five offset, preloaded pads."""

    def make(offset=0.55, **further):
        return tilting(5, 0.5, 60.0, 0.3, offset, **({"film": film} | further))

    return make


@pytest.mark.parametrize("speed", [SPEED, -SPEED])
def test_losses_are_the_sum_of_films_on_grids_at_the_tilts_of_the_pads(five, speed):
    of = five(0.55 if speed > 0.0 else 0.45)
    at = equilibrium(of, LOAD, speed)
    found, pads = at.losses, at.pads
    local = np.einsum("kij,i->jk", directions(of.pivots), at.position)
    e = turning(of) @ (
        (local + np.stack([pads.pivot_deflections, pads.tilts])) / of.clearance + [[0.3], [0.0]]
    )
    w = 0.5 * speed * np.stack([e[1], -e[0]])
    film = pad_grid(of.extent, 0.5, (128, 16))
    rows = film.losses(e, w, np.full(5, 0.5 * speed))
    unit = of.viscosity * speed * of.radius**3 * of.length / of.clearance
    forces = film.force(e, w).values * of.force_scale
    torque = unit * (rows[0] + rows[1]) + 0.5 * of.clearance * (e[0] * forces[1] - e[1] * forces[0])
    np.testing.assert_allclose(found.friction_torque, torque.sum(), rtol=3e-3)
    np.testing.assert_allclose(found.power_loss, found.friction_torque * speed, rtol=1e-12)
    flow = of.clearance * of.radius * of.length
    np.testing.assert_allclose(found.side_flow, flow * (rows[3] - rows[4]).sum(), rtol=1e-2)
    np.testing.assert_allclose((found.inflow - found.arriving).sum(), found.side_flow, rtol=1e-12)
    moment = -at.position[0] * LOAD[1] + at.position[1] * LOAD[0]
    np.testing.assert_allclose(found.friction_torque - found.bush_torque, moment, atol=1e-9)


def test_losses_by_map_and_by_grid_agree(five):
    found, exact = (
        equilibrium(of, LOAD, SPEED).losses for of in (five(), five(film=PadGridFilm(cells=(96, 8))))
    )
    np.testing.assert_allclose(found.power_loss, exact.power_loss, rtol=2e-3)
    np.testing.assert_allclose(found.side_flow, exact.side_flow, rtol=1e-2)


def test_full_gap_takes_more_and_an_unloaded_pad_has_streamers(tilting, film):
    of = tilting(5, 0.5, 60.0, 0.0, film=film)
    with pytest.warns(Warning, match="unloaded"):
        at = equilibrium(of, (0.0, -3000.0), SPEED)
    assert at.pads.unloaded.any()
    full = of.losses(at.position, [0.0, 0.0], SPEED, full_gap=True)
    assert 0.0 < at.losses.power_loss < full.power_loss


@pytest.mark.parametrize("stiffness", [None, 2e8])
def test_heat_of_the_equilibrium_balances(five, stiffness):
    of = five(viscosity=None, oil=OIL, cooling=COOLING, pivot_stiffness=stiffness)
    at = equilibrium(of, LOAD, SPEED)
    held = of.at_temperature(at.temperature)
    heat = held.film_heat(at.position, [0.0, 0.0], SPEED)
    assert abs(heat_surplus(heat, OIL, COOLING, at.temperature)[0]) < 1e-10 * heat.power
    assert at.temperature > COOLING.supply_temperature + 3.0
    np.testing.assert_allclose(at.losses.power_loss, heat.power, rtol=1e-12)
    frozen = equilibrium(held, LOAD, SPEED)
    np.testing.assert_allclose(frozen.position, at.position, rtol=1e-10)
    np.testing.assert_allclose(frozen.pads.tilts, at.pads.tilts, rtol=1e-10)
    ours, theirs = (coefficients(each, at.position, SPEED) for each in (of, held))
    np.testing.assert_allclose(ours.stiffness, theirs.stiffness, rtol=1e-12)


def test_a_warm_equilibrium_solves_its_heat_few_times(five, monkeypatch):
    asked = {"losses": 0, "at_temperature": 0}

    def counting(name):
        own = getattr(TiltingPadBearing, name)

        def counted(*args, **options):
            asked[name] += 1
            return own(*args, **options)

        monkeypatch.setattr(TiltingPadBearing, name, counted)

    counting("losses")
    counting("at_temperature")
    equilibrium(five(viscosity=None, oil=OIL, cooling=COOLING), LOAD, SPEED)
    assert asked["losses"] <= 6
    assert asked["at_temperature"] <= 2


def test_oil_that_does_not_thin_is_isothermal(five):
    warm = five(viscosity=None, oil=Oil.constant(0.02), cooling=COOLING)
    found, other = (equilibrium(of, LOAD, SPEED) for of in (warm, five()))
    np.testing.assert_allclose(found.position, other.position, rtol=1e-12)
    assert found.temperature > COOLING.supply_temperature + 1.0


def test_infinite_cooling_holds_the_ambient_temperature(five):
    cold = dataclasses.replace(COOLING, housing_conductance=1e12)
    at = equilibrium(five(viscosity=None, oil=OIL, cooling=cold), LOAD, SPEED)
    np.testing.assert_allclose(at.temperature, COOLING.ambient_temperature, atol=1e-8)


@pytest.mark.filterwarnings("ignore:.*beyond the Reynolds number")  # a model problem at any speed
def test_threshold_of_a_warm_bearing_is_sought_at_its_temperatures(five):
    warm = five(viscosity=None, oil=OIL, cooling=COOLING)
    found = whirl_threshold(warm, LOAD, mass=300.0, speed_range=(200.0, 3000.0))
    assert found.reason.startswith("stable at every speed from 200 to 3000 rad/s")


def test_what_the_heat_of_tilting_pads_refuses(five):
    warm = five(viscosity=None, oil=OIL, cooling=COOLING)
    for call in (lambda: warm.force([0.0, 0.0], [0.0, 0.0], SPEED), lambda: warm.in_time()):
        with pytest.raises(InputError, match="temperature must be stated"):
            call()
    with pytest.raises(InputError, match="velocity be"):
        five().losses([0.0, 0.0], [1e-3, 0.0], SPEED)
    with pytest.raises(InputError, match="derivatives of its heat"):
        warm.heat_jacobian([0.0, 0.0], [0.0, 0.0], SPEED)
    assert warm.film_at_unit_viscosity() is None
    assert warm.native() is None


def test_a_rotor_rests_where_a_pad_gains_its_film():
    """The power jumps there by that of the pad, so that no temperature balances the heat."""
    pads = TiltingPadBearing(
        radius=0.04,
        length=0.04,
        assembled_clearance=8e-5,
        preload=0.3,
        extent=60.0 * DEGREE,
        pivots=even_pivots(5, between_pads=True),
        oil=Oil.iso_vg(32),
        cooling=Cooling(supply_temperature=318.15),
    )
    steel = ElasticMaterial(young_modulus=210e9, shear_modulus=80.8e9, density=7850.0)
    disk = {"density": 7850.0, "width": 0.06, "outer_diameter": 0.36, "inner_diameter": 0.08}
    rotor = ShaftRotor(
        elements=ShaftElement(length=1.6, outer_diameter=0.08, material=steel).split(16),
        disks=tuple(Disk.solid(node, **disk) for node in (5, 11)),
        stations=(Station(node=0, name="left"), Station(node=16, name="right")),
        speed=291.0,
    )
    films = {"left": pads, "right": pads}
    with warnings.catch_warnings(action="ignore", category=ValidityWarning):
        before, at, after = (
            rotor_equilibrium(rotor, films, speed) for speed in (291.0, 291.00254704852233, 291.01)
        )
    assert at.residual <= 1e-8
    assert before.temperatures["left"] < at.temperatures["left"] < after.temperatures["left"]
    assert after.temperatures["left"] - before.temperatures["left"] < 1e-3
