"""What a run says of itself: whirl that grows, lasts or dies out, and its one-sided spectrum."""

import numpy as np
import pytest

import rotorfilm as rf
from rotorfilm.analysis import run_spectrum, run_whirl

FILM = rf.JournalBearing(diameter="100 mm", length="50 mm", clearance="100 um", viscosity="20 mPa s")
LOAD, MASS = (0.0, -500.0), 50.0
ONSET = rf.whirl_threshold(FILM, LOAD, MASS).speed


def run(share, unbalance=0.0, off=0.0, duration=1.0):
    """Return a run at a share of the speed at the onset of whirl, begun at or near the equilibrium."""
    speed = share * ONSET
    at = rf.equilibrium(FILM, LOAD, speed)
    rotor = rf.RigidRotor(
        mass=MASS, speed=speed, unbalance=unbalance, gravity=(0.0, 0.0), static_force=LOAD,
        position=(at.position[0] + off, at.position[1]),
    )  # fmt: skip
    found = rf.coefficients(FILM, at.position, speed)
    zero, one = np.zeros((2, 2)), np.eye(2)
    values = np.linalg.eigvals(np.block([[zero, one], [-found.stiffness / MASS, -found.damping / MASS]]))
    slowest = values[values.real.argmax()]
    return rf.simulate(rotor, FILM, duration=duration, samples=4001, rtol=1e-9), slowest


@pytest.mark.closed_form
@pytest.mark.parametrize("share", [1.2, 1.05, 0.97])
def test_small_whirl_grows_or_dies_out_as_the_eigenvalue_says(share):
    one, value = run(share, off=1e-9, duration=0.2 if share == 1.2 else 0.6)
    found = run_whirl(one)
    assert found.growth_rate == pytest.approx(value.real, rel=0.02)
    assert found.whirl_ratio == pytest.approx(abs(value.imag) / (share * ONSET), rel=0.02)
    assert found.verdict.startswith("grows" if value.real > 0.0 else "dies out")
    assert found.verdict in str(one)


def test_large_whirl_lasts_and_may_do_so_below_the_threshold():
    """The linear threshold does not tell: a large unbalance leads to whirl below it."""
    assert run_whirl(run(1.3, unbalance=5e-4)[0]).verdict.startswith("lasts")
    below = run_whirl(run(0.95, unbalance=5e-4)[0])
    assert below.whirl_ratio == pytest.approx(0.5, abs=0.01)
    assert below.whirl_radius > 2e-5
    quiet = run_whirl(run(0.6, unbalance=5e-4)[0])
    assert quiet.whirl_ratio is None
    assert quiet.verdict.startswith("none")
    rest = run_whirl(run(0.6)[0])
    assert rest.verdict.startswith("nothing moves")
    assert (rest.growth_rate, rest.whirl_ratio) == (0.0, None)


def test_runs_that_show_no_whirl_are_refused_and_print_without_it():
    time = np.linspace(0.0, 1.0, 4001)
    signals = {"x": np.sin(300.0 * time), "y": np.cos(300.0 * time), "speed": 300.0 + time}
    rising = rf.Trajectory(time=time, signals=signals, work={})
    with pytest.raises(rf.InputError, match="run must be at a constant speed"):
        run_whirl(rising)
    assert "whirl" not in str(rising)
    with pytest.raises(rf.InputError, match="run must have 16 turns of 8 samples"):
        run_whirl(rising, speed=50.0)


@pytest.mark.closed_form
def test_a_spectrum_has_the_amplitude_peak_and_rms_of_its_sines():
    time = np.linspace(0.0, 2.0, 8001)
    values = 1.0 + 3.0 * np.sin(2.0 * np.pi * 50.0 * time) + 0.5 * np.cos(2.0 * np.pi * 121.0 * time)
    one = rf.Trajectory(time=time, signals={"left_force_x": values}, work={}, units={"left_force_x": "N"})
    found = run_spectrum(one, "left_force_x", start=1.0)
    hertz = found.frequency / (2.0 * np.pi)
    for at, size in ((50.0, 3.0), (121.0, 0.5), (80.0, 0.0)):
        assert found.signal_amplitude[np.abs(hertz - at) < 1.0].max() == pytest.approx(
            size, rel=2e-3, abs=1e-3
        ), at
    assert hertz[found.signal_amplitude.argmax()] == pytest.approx(50.0, abs=0.3)
    assert found.rms == pytest.approx(np.sqrt(0.5 * (3.0**2 + 0.5**2)), rel=1e-3)
    assert found.peak == pytest.approx(3.5, rel=0.01)
    axes = found.plot()
    assert axes.get_ylabel() == "amplitude, zero-to-peak [N]"
    assert "rms 2.15 N" in axes.get_title()
    with pytest.raises(rf.InputError, match="signal must be one of left_force_x, got 'right_x'"):
        run_spectrum(one, "right_x")
    with pytest.raises(rf.InputError, match="start must leave 8 samples"):
        run_spectrum(one, "left_force_x", start=2.0)
