"""Power loss, oil flow and heat of pads with recesses: by the pressure itself, and beside pads without."""

import math
from dataclasses import replace

import numpy as np
import pytest

from rotorfilm import InputError, Lobe, LobedBearing, Oil, PressureDamBearing, equilibrium, pressure_dam_pads
from rotorfilm.bearings import PadGridFilm, Recess, RecessedPad
from rotorfilm.bearings.oil import Cooling

BORE = {"radius": 0.05, "length": 0.05, "pad_clearance": 1e-4}
SPEED, STILL = 300.0, [0.0, 0.0]
OIL = {"oil": Oil.iso_vg(46), "cooling": Cooling(supply_temperature=318.15)}
NAMES = ("power_loss", "friction_torque", "bush_torque", "side_flow", "inflow", "arriving")


def dam(pads, cells=(64, 16), **options):
    return PressureDamBearing(**BORE, **({"viscosity": 0.03} | options), pads=pads, cells=cells)


@pytest.mark.parametrize("speed", [300.0, -200.0])
@pytest.mark.parametrize("full_gap", [False, True])
def test_pads_without_a_recess_lose_what_lobes_lose(speed, full_gap):
    """The grids of the lobes are rings, which share no code with these."""
    arcs = ({"start": 0.2, "extent": 2.7, "preload": 0.3}, {"start": 3.4, "extent": 2.5, "preload": 0.3})
    lobes = tuple(Lobe(**arc) for arc in arcs)
    others = LobedBearing(**BORE, viscosity=0.03, lobes=lobes, film=PadGridFilm(cells=(128, 16)))
    ours = dam(tuple(RecessedPad(**arc) for arc in arcs), (128, 16))
    for velocity in (STILL, [2e-3, -1e-3]):
        one, other = (
            each.losses([2e-5, -4e-5], velocity, speed, full_gap=full_gap) for each in (ours, others)
        )
        for name in NAMES:
            np.testing.assert_allclose(getattr(one, name), getattr(other, name), rtol=4e-3)


@pytest.mark.parametrize(
    "recess",
    [
        Recess(depth=8e-5, end=math.radians(140.0), share=0.75),
        Recess(depth=1.5e-4, end=math.radians(170.0), share=0.3),
        Recess(depth=8e-5, start=math.radians(60.0), end=math.radians(120.0)),
    ],
    ids=["dam", "track", "pocket"],
)
def test_power_and_side_flow_are_those_of_the_pressure(recess):
    """Power is what shear and pressure flow dissipate, side flow the slope of the pressure at the ends."""
    pad = RecessedPad(start=math.radians(10.0), extent=math.radians(160.0), recess=recess)
    bearing = replace(dam((pad,), (256, 64)), extrapolated=False)
    position = np.array([1e-5, 3e-5])
    theta, axial, p = bearing.pressure(0, position, STILL, SPEED)
    middle = 0.5 * (theta[1:] + theta[:-1]), 0.5 * (axial[1:] + axial[:-1])
    first, last = pad.edges[1:3]
    deep = np.outer((middle[0] > first) & (middle[0] < last), middle[1] < recess.share)
    land = BORE["pad_clearance"] - position @ [np.cos(middle[0]), np.sin(middle[0])]
    h = land[:, None] + recess.depth * deep
    R, half = 0.05, 0.025
    area = np.outer(np.diff(theta) * R, np.diff(axial) * half)
    around = np.diff(p, axis=0) / (np.diff(theta) * R)[:, None]
    along = np.diff(p, axis=1) / (np.diff(axial) * half)[None]
    squares = 0.5 * (around[:, 1:] ** 2 + around[:, :-1] ** 2) + 0.5 * (along[1:] ** 2 + along[:-1] ** 2)
    shear, pressed = 0.03 * (SPEED * R) ** 2 / h, h**3 / 0.36 * squares
    found = bearing.losses(position, STILL, SPEED, full_gap=True)
    sheared, driven = 2.0 * (shear * area).sum(), 2.0 * (pressed * area).sum()
    assert sheared + driven == pytest.approx(found.power_loss, abs=0.03 * driven)
    # the slope at the end of the length, through the last three nodes
    last_step = half * (axial[-1] - axial[-2])
    slope = -(4.0 * p[:, -2] - p[:, -3]) / (2.0 * last_step)
    edge = 0.5 * (h[:, -1] ** 3 / 0.36) * (slope[1:] + slope[:-1])
    leaked = -2.0 * (edge * np.diff(theta) * R).sum()
    if recess.start is None:
        assert leaked == pytest.approx(found.side_flow, rel=0.04)
    else:  # in a pocket oil is not there that its film would begin with
        assert found.side_flow < 0.2 * leaked


def test_streamers_keep_their_thickness_over_a_step():
    """A pad that opens all along: oil of the thickness at its edge, Sigma = H_1 int dt/H^2."""
    pad = RecessedPad(start=-0.5, extent=1.0, recess=Recess(depth=5e-5, start=0.1, end=0.5))
    bearing = dam((pad,), (128, 8))
    position = 1e-4 * np.array([-0.3, -1.2])
    t = np.linspace(-0.5, 0.5, 20001)
    h = 1.0 + 0.3 * np.cos(t) + 1.2 * np.sin(t)
    thick = h + 0.5 * (t > 0.1)
    assert np.all(np.diff(h) > 0.0)
    sigma = thick[0] * np.trapezoid(thick**-2.0, t)
    found = bearing.losses(position, STILL, SPEED)
    unit = 1e-4 * 0.05 * 0.05 * 0.5 * SPEED
    assert found.power_loss == pytest.approx(0.03 * SPEED**2 * 0.05**4 / 1e-4 * sigma, rel=2e-3)
    np.testing.assert_allclose([found.inflow[0], found.arriving[0]], unit * thick[0], rtol=1e-9)


def test_deeper_dams_take_less_power():
    depths = [2e-5, 6e-5, 2e-4, 1e-3]
    bearings = [dam(pressure_dam_pads(depth=depth, end="140 deg", share=0.75)) for depth in depths]
    found = [bearing.losses([0.0, -2e-5], STILL, SPEED) for bearing in bearings]
    power = [one.power_loss for one in found]
    assert power == sorted(power, reverse=True)


def test_dam_warms_as_its_balance_says():
    bearing = dam(pressure_dam_pads(depth="60 um", end="140 deg", share=0.75), (32, 8), viscosity=None, **OIL)
    at = equilibrium(bearing, (0.0, -1000.0), SPEED)
    cold = bearing.at_temperature(at.temperature)
    np.testing.assert_allclose(cold.force(at.position, STILL, SPEED), [0.0, 1000.0], atol=1e-6)
    lost = cold.losses(at.position, STILL, SPEED)
    x = 0.8 * lost.arriving / lost.inflow
    share = x - 0.05 * np.log1p(np.exp((x - 1.0) / 0.05))  # of what an opening gives, that arrived there
    replaced = (2.0 * (lost.arriving - share * lost.inflow) / (1.0 + share)).sum()
    carried = OIL["oil"].volumetric_heat(318.15) * (lost.side_flow + replaced) * (at.temperature - 318.15)
    assert carried == pytest.approx(lost.power_loss, rel=1e-6)
    assert 5.0 < at.temperature - 318.15 < 30.0


def test_dam_of_no_depth_is_as_warm_as_two_lobes():
    pads = pressure_dam_pads(depth=0.0, end=2.0, share=0.5)
    ours = dam(pads, (64, 8), viscosity=None, **OIL)
    lobes = tuple(Lobe(start=pad.start, extent=pad.extent) for pad in pads)
    others = LobedBearing(**BORE, lobes=lobes, film=PadGridFilm(cells=(96, 8)), **OIL)
    one, other = (equilibrium(each, (0.0, -1000.0), SPEED) for each in (ours, others))
    assert one.temperature == pytest.approx(other.temperature, abs=0.02)


def test_dams_without_a_stated_temperature_have_no_force():
    bearing = dam(pressure_dam_pads(depth="60 um", end="140 deg", share=0.75), viscosity=None, **OIL)
    with pytest.raises(InputError, match="temperature must be stated"):
        bearing.force([0.0, 0.0], STILL, SPEED)
    assert bearing.minimum_film([0.0, -2e-5]) == pytest.approx(8e-5)


def test_an_empty_batch_has_empty_losses_and_no_force():
    bearing, none = dam(pressure_dam_pads(depth="60 um", end="140 deg", share=0.75)), np.zeros((2, 0))
    assert bearing.force(none, none, np.zeros(0)).shape == (2, 0)
    assert bearing.losses(none, none, np.zeros(0)).inflow.shape == (2, 0)
