"""Coexisting rest and whirl, and the border between them."""

import numpy as np
import pytest

from rotorfilm import InputError, continue_orbits, hopf_point, periodic_orbit, simulate_rotor
from rotorfilm.analysis import basin_scan


@pytest.fixture(scope="module")
def below(short_rotor):
    """eps .1 at the threshold, 3 % below it."""
    return short_rotor(0.1)(0.97)


@pytest.mark.filterwarnings("ignore:.*beyond the Reynolds number")  # a model problem at any speed
def test_border_of_the_basin_along_the_load(below):
    scan = basin_scan(below, 1e-4 * np.array([[0.3, 0.507, 0.508, 0.6], [0.0, 0.0, 0.0, 0.0]]))
    assert scan.whirls.tolist() == [False, False, True, True]
    assert np.all(scan.amplitude[:2] < 0.01)


@pytest.mark.filterwarnings("ignore:.*beyond the Reynolds number")  # a model problem at any speed
def test_whirl_of_the_scan_is_a_stable_orbit(short_rotor, below):
    run = simulate_rotor(
        below,
        duration=200 * 2.0 * np.pi / (0.97 * short_rotor(0.1).speed),
        initial_state=[*(short_rotor(0.1).rest + np.array([0.6e-4, 0.0])), 0.0, 0.0],
        samples=20001,
        rtol=1e-8,
    )
    whirl = periodic_orbit(below, start=run)
    assert whirl.stable
    assert np.ptp(whirl.position(np.linspace(0.0, whirl.period, 400))[0, 1]) / 2e-4 == pytest.approx(
        0.755, abs=1e-3
    )
    scan = basin_scan(below, 1e-4 * np.array([[0.6], [0.0]]), rtol=1e-8)
    assert scan.eccentricity[0] == pytest.approx(whirl.eccentricity_ratios.max(), abs=1e-4)


def test_unbalance_is_refused(short_rotor):
    with pytest.raises(InputError, match="rotor must have no unbalance"):
        basin_scan(short_rotor(0.1)(0.97, unbalance=0.1), [[0.0], [0.0]])


@pytest.mark.filterwarnings("ignore:.*beyond the Reynolds number")  # a model problem at any speed
def test_start_at_the_wall_counts_as_whirl(below):
    scan = basin_scan(below, 1e-4 * np.array([[0.97], [0.0]]), turns=5)
    assert scan.whirls[0]


@pytest.mark.filterwarnings("ignore:.*beyond the Reynolds number")  # a model problem at any speed
def test_scan_keeps_the_shape_of_its_offsets(below):
    offsets = 1e-4 * np.stack(np.meshgrid([0.0, 0.01], [-0.02, 0.0, 0.02], indexing="ij"))
    scan = basin_scan(below, offsets, turns=20)
    assert scan.amplitude.shape == scan.whirls.shape == (2, 3)


@pytest.mark.filterwarnings("ignore:.*beyond the Reynolds number")  # a model problem at any speed
def test_onset_is_the_end_of_the_branch(short_rotor):
    family = short_rotor(0.1)
    onset = hopf_point(family, (0.97, 1.03))
    curve = continue_orbits(family, onset, bounds=(0.94, 1.0), most=12)
    assert not curve.stable[:8].any()
