"""Amplification factors, separation margins and unbalance by mode, against closed forms."""

import math
from dataclasses import replace

import control
import numpy as np
import pytest
from scipy.optimize import brentq, minimize_scalar

import rotorfilm as rf
from rotorfilm.analysis.unbalance_margins import _lobes

NATURAL, ECCENTRICITY = 300.0, 1e-6
SPEEDS = np.linspace(30.0, 900.0, 1500)


def jeffcott(ratio, speeds=SPEEDS):
    """Return a mass with a damping ratio on a spring, under unbalance: |x| = e s^2 / |1 - s^2 + 2 i z s|."""
    s = speeds / NATURAL
    return ECCENTRICITY * s**2 / (1.0 - s**2 + 2j * ratio * s)


def as_response(phasors, speeds=SPEEDS):
    return control.FrequencyResponseData(
        phasors[None, None], speeds, inputs=["unbalance"], outputs=["probe_x"], name="response"
    )


def half_power(ratio):
    """Return peak speed and AF of the same by its amplitude alone."""

    def size(w):
        return abs(jeffcott(ratio, np.array(w)))

    peak = minimize_scalar(
        lambda w: -size(w), bounds=(200.0, 500.0), method="bounded", options={"xatol": 1e-10}
    ).x
    level = size(peak) * math.sqrt(0.5)
    low, high = (brentq(lambda w: size(w) - level, *ends) for ends in ((30.0, peak), (peak, 9000.0)))
    return peak, peak / (high - low)


@pytest.mark.closed_form
@pytest.mark.parametrize("ratio", [0.02, 0.05, 0.15])
def test_amplification_factor_of_a_jeffcott_rotor(ratio):
    peak, factor = half_power(ratio)
    assert peak == pytest.approx(NATURAL / math.sqrt(1.0 - 2.0 * ratio**2), rel=1e-7)
    assert rf.analysis.amplification_factor(SPEEDS, jeffcott(ratio), peak) == pytest.approx(factor, rel=1e-4)
    found = rf.separation_margins(as_response(jeffcott(ratio)), 500.0, 600.0)
    assert found.peaks[0].speed == pytest.approx(peak, rel=5e-6)
    assert found.peaks[0].amplification_factor == pytest.approx(factor, rel=1e-4)
    # lightly damped: AF = 1 / (2 z)
    assert factor == pytest.approx(0.5 / ratio, rel=2.5 * ratio)


@pytest.mark.closed_form
def test_a_peak_cut_off_on_one_side_counts_the_other_twice():
    peak, factor = half_power(0.05)
    grid, curve = SPEEDS[peak + 2.0 > SPEEDS], jeffcott(0.05)[peak + 2.0 > SPEEDS]
    half = rf.analysis.amplification_factor(grid, curve, peak)
    assert half == pytest.approx(factor, rel=0.1)
    assert half != pytest.approx(factor, rel=1e-3)


@pytest.mark.literature
@pytest.mark.parametrize(
    ("factor", "below", "above"),
    [
        (2.49, 0.0, 0.0),
        (2.5, 0.0, 0.10),
        (3.5, 0.085, 0.185),
        (5.0, 0.17 * (1.0 - 1.0 / 3.5), 0.10 + 0.17 * 5.0 / 7.0),
        (50.0, 0.16, 0.26),
    ],
)
def test_required_margins_of_api_617(factor, below, above):
    assert rf.analysis.required_margin(factor, above=False) == pytest.approx(below, abs=1e-12)
    assert rf.analysis.required_margin(factor, above=True) == pytest.approx(above, abs=1e-12)


@pytest.mark.closed_form
def test_margins_below_above_and_within_the_range():
    peak, factor = half_power(0.05)
    response = as_response(jeffcott(0.05))
    (below,) = rf.separation_margins(response, 400.0, 600.0).peaks
    assert below.separation_margin == pytest.approx(1.0 - peak / 400.0, rel=1e-5)
    assert below.required_margin == pytest.approx(0.17 * (1.0 - 1.0 / (factor - 1.5)), rel=1e-4)
    assert below.acceptable
    near = rf.separation_margins(response, 150.0, 280.0)
    assert near.peaks[0].separation_margin == pytest.approx(peak / 280.0 - 1.0, rel=1e-4)
    assert not near.acceptable
    assert "needs 2" in near.verdict
    within = rf.separation_margins(response, 250.0, 350.0)
    assert within.peaks[0].separation_margin == 0.0
    assert not within.acceptable
    assert rf.separation_margins(as_response(jeffcott(0.3)), 250.0, 350.0).acceptable


def test_bad_margins():
    response = as_response(jeffcott(0.05))
    with pytest.raises(rf.InputError, match="maximum_speed must be at least"):
        rf.separation_margins(response, 400.0, 300.0)
    with pytest.raises(rf.InputError, match="outputs must be among"):
        rf.separation_margins(response, 400.0, 500.0, ["probe_z"])


def test_a_response_must_cover_the_operating_range():
    response = as_response(jeffcott(0.05))
    for ends in ((20.0, 400.0), (400.0, 901.0)):
        with pytest.raises(rf.InputError, match="response must cover the operating range"):
            rf.separation_margins(response, *ends)


def test_an_amplitude_that_still_rises_is_warned_of():
    before = SPEEDS[SPEEDS < 0.9 * NATURAL]
    with pytest.warns(rf.ValidityWarning, match="probe_x still rises at the last speed"):
        assert not rf.separation_margins(as_response(jeffcott(0.05, before), before), 100.0, 200.0).peaks


def test_parts_of_a_shape_with_a_node_at_rest():
    """A node that does not move at all, between two parts or at a bearing, is of neither."""
    assert list(_lobes(np.array([0.0, 1.0, 0.0, -2.0, -1.0, 0.0]))) == [1, 3]
    assert list(_lobes(np.array([-1.0, 0.0, -2.0]))) == [2]


STEEL = rf.ElasticMaterial(young_modulus=2.1e11, shear_modulus=8e10, density=7800.0)
BAR = rf.ShaftElement(length=1.6, outer_diameter=0.08, material=STEEL)


def shaft(left, right, disks=()):
    stations = (rf.Station(node=left, name="left"), rf.Station(node=right, name="right"))
    return rf.ShaftRotor(elements=BAR.split(8), stations=stations, disks=disks, speed=0.0)


def placed(rotor, mode, stiffness=1e8, **options):
    bearings = dict.fromkeys(("left", "right"), rf.LinearBearing(stiffness=stiffness))
    at = rf.rotor_equilibrium(rotor, bearings, "10000 rpm")
    return at, rf.analysis.mode_unbalances(rotor, at, mode, **options)


@pytest.mark.closed_form
def test_first_mode_at_mid_span_with_all_of_the_weight():
    rotor = shaft(0, 8)
    _, (one,) = placed(rotor, 1)
    assert one.node == 4
    # 6350 W / N [g mm], twice
    assert one.unbalance == pytest.approx(2.0 * 6350.0 * rotor.mass / 10000.0 * 1e-6, rel=1e-9)


@pytest.mark.closed_form
def test_second_mode_at_the_quarters_out_of_phase():
    rotor = shaft(0, 8, disks=(rf.Disk(node=2, mass=10.0),))
    at, (one, other) = placed(rotor, 2, multiple=4.0)
    assert (one.node, other.node) == (2, 6)
    assert (one.unbalance_angle, other.unbalance_angle) == (0.0, math.pi)
    for item, side in ((one, "left"), (other, "right")):
        journal = abs(at.loads[side][1]) / 9.80665
        assert item.unbalance == pytest.approx(4.0 * 6350.0 * journal / 10000.0 * 1e-6, rel=1e-9)


@pytest.mark.closed_form
def test_overhung_mode_with_the_overhung_mass():
    wheel = rf.Disk(node=8, mass=60.0, diametral_inertia=1.0, polar_inertia=2.0)
    rotor = shaft(0, 5, disks=(wheel,))
    _, (one,) = placed(rotor, 1)
    assert one.node == 8
    hung = 60.0 + 3.0 / 8.0 * (rotor.mass - 60.0)
    assert one.unbalance == pytest.approx(2.0 * 6350.0 * hung / 10000.0 * 1e-6, rel=1e-9)


@pytest.mark.literature
def test_residual_unbalance_in_published_units():
    """4 W / N oz in, W in lb; W / 3.937 g mm from 25000 rpm on."""
    ounce_inch, pound = 0.45359237 / 16.0 * 0.0254, 0.45359237
    assert rf.analysis.residual_unbalance(100.0 * pound, "8000 rpm") == pytest.approx(
        4.0 * 100.0 / 8000.0 * ounce_inch, rel=5e-4
    )
    assert rf.analysis.residual_unbalance(20.0, "40000 rpm") == pytest.approx(20.0 / 3.937 * 1e-6, rel=1e-3)


def test_bad_modes():
    rotor = shaft(0, 8)
    with pytest.raises(rf.InputError, match="mode must be an integer"):
        placed(rotor, 0)
    with pytest.raises(rf.InputError, match="mode must be at most"):
        placed(rotor, 1000)
    with pytest.raises(rf.InputError, match="must have weight"):
        placed(replace(rotor, gravity=(0.0, 0.0)), 1)
