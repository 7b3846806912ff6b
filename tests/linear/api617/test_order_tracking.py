"""Coast-downs as responses over speed, against the steady response of a Jeffcott rotor."""

import math

import numpy as np
import pytest

import rotorfilm as rf
from rotorfilm.charts import plot_polar_response, plot_unbalance_response

NATURAL, RATIO, ECCENTRICITY = 200.0, 0.08, 1e-5


def steady(speeds):
    s = speeds / NATURAL
    return ECCENTRICITY * s**2 / (1.0 - s**2 + 2j * RATIO * s)


def signal(profile, duration, samples):
    """Return a run of the steady response, with a sag and what whirls at .46 of the speed."""
    time = np.linspace(0.0, duration, samples)
    angle, speed = (np.array([f(t) for t in time.tolist()]) for f in (profile.angle, profile.speed))
    turned = steady(speed) * np.exp(1j * angle)
    sub = 1e-7 * np.exp(0.46j * angle)
    signals = {"mid_x": turned.real + sub.real - 3e-5, "mid_y": turned.imag + sub.imag, "speed": speed}
    return rf.Trajectory(time=time, signals=signals, work={})


@pytest.mark.closed_form
@pytest.mark.parametrize(("first", "last"), [(400.0, 60.0), (60.0, 400.0)])
def test_phasors_of_a_signal(first, last):
    profile = rf.SpeedProfile(times=(0.0, 30.0), speeds=(first, last))
    found = rf.analysis.tracked_response(signal(profile, 30.0, 60001), profile, turns=4)
    assert found.output_labels == ["mid_x", "mid_y"]
    speeds = np.asarray(found.frequency)
    assert np.all(np.diff(speeds) > 0.0)
    wanted = steady(speeds)
    np.testing.assert_allclose(found.frdata[0, 0], wanted, atol=5e-3 * np.abs(wanted).max())
    np.testing.assert_allclose(found.frdata[1, 0], -1j * wanted, atol=5e-3 * np.abs(wanted).max())
    (peak,) = rf.separation_margins(found, 300.0, 350.0, ["mid_x"]).peaks
    assert peak.speed == pytest.approx(NATURAL / math.sqrt(1.0 - 2.0 * RATIO**2), rel=5e-3)


@pytest.mark.closed_form
def test_a_slow_coast_down_in_time_is_the_steady_response():
    """A rigid rotor on springs: m q'' + c q' + k q = m e w^2, coasting through its critical speed."""
    mass = 10.0
    bearing = rf.LinearBearing(stiffness=mass * NATURAL**2, damping=2.0 * RATIO * mass * NATURAL)
    profile = rf.SpeedProfile(times=(0.0, 40.0), speeds=(300.0, 120.0))
    rotor = rf.RigidRotor(mass=mass, speed=profile, unbalance=mass * ECCENTRICITY)
    run = rf.simulate(rotor, bearing, duration=40.0, times=np.linspace(0.0, 40.0, 40001), rtol=1e-6)
    found = rf.analysis.tracked_response(run, profile, ["x"], turns=4)
    speeds = np.asarray(found.frequency)
    late = speeds < 290.0
    wanted = steady(speeds)
    np.testing.assert_allclose(found.frdata[0, 0][late], wanted[late], atol=0.02 * np.abs(wanted).max())


def test_charts_of_a_coast_down():
    profile = rf.SpeedProfile(times=(0.0, 3.0), speeds=(400.0, 60.0))
    found = rf.analysis.tracked_response(signal(profile, 3.0, 6001), profile)
    above, _ = plot_unbalance_response(found).draw()
    assert len(above.get_lines()) == 2
    (polar,) = plot_polar_response(found, ["mid_x"]).draw()
    x, y = polar.get_lines()[0].get_data()
    np.testing.assert_allclose(x + 1j * y, 1e6 * np.asarray(found.frdata)[0, 0])
    assert any("rpm" in text.get_text() for text in polar.texts)


@pytest.mark.parametrize(
    ("samples", "ends", "outputs", "message"),
    [
        (200, (400.0, 60.0), None, "at least 12 samples a turn"),
        (6001, (100.0, 100.0), None, "rise or fall"),
        (6001, (100.0, -100.0), None, "must be positive"),
        (6001, (400.0, 60.0), ["mid_z"], "outputs must be among"),
    ],
)
def test_bad_runs(samples, ends, outputs, message):
    profile = rf.SpeedProfile(times=(0.0, 3.0), speeds=ends)
    with pytest.raises(rf.InputError, match=message):
        rf.analysis.tracked_response(signal(profile, 3.0, samples), profile, outputs)
