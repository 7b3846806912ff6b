"""Curves of orbits: folds in closed form, those of the short bearing, and where tori are born."""

import numpy as np
import pytest

from rotorfilm import (
    InputError,
    RigidRotor,
    continue_orbits,
    hopf_point,
    mount,
    periodic_orbit,
    simulate_rotor,
)
from rotorfilm.analysis import Bifurcation, basin_scan


@pytest.mark.long
@pytest.mark.closed_form
def test_folds_of_duffing(cubic_bearing):
    mass, k, h, c, unbalance = 1.0, 1.0, 1.0, 0.2, 0.12

    def family(speed):
        rotor = RigidRotor(mass=mass, speed=speed, unbalance=unbalance, gravity=(0.0, 0.0))
        return mount(rotor, {"": cubic_bearing(stiffness=k, hardening=h, damping=c, clearance=10.0)})

    curve = continue_orbits(family, periodic_orbit(family(0.3)), parameter=0.3, bounds=(0.25, 2.0))
    # Circles: ((k + h a^2 - m w^2)^2 + (c w)^2) a^2 = (U w^2)^2; each is on the curve.
    for w, orbit in zip(curve.parameters, curve.orbits, strict=True):
        a = 10.0 * orbit.amplitude
        assert ((k + h * a**2 - mass * w**2) ** 2 + (c * w) ** 2) * a**2 == pytest.approx(
            (unbalance * w**2) ** 2
        )
    # Folds: the derivative by the squared amplitude A vanishes as well.
    found = [event for event in curve.events if event.kind is Bifurcation.FOLD]
    assert len(found) == 2
    for event in found:
        d = k - mass * event.parameter**2
        A = (10.0 * event.orbit.amplitude) ** 2
        slope = (d + h * A) * (d + 3.0 * h * A) + (c * event.parameter) ** 2
        assert slope == pytest.approx(0.0, abs=1e-5)
    between = (curve.parameters > min(e.parameter for e in found)) & ~curve.stable
    assert between.any()
    unstable = [o for o in curve.orbits if not o.stable]
    assert all(np.abs(o.multipliers[0].imag) < 1e-9 and o.multipliers[0].real > 1.0 for o in unstable)


@pytest.mark.long
def test_large_whirl_of_the_short_bearing(short_rotor):
    family = short_rotor(0.2)
    onset = hopf_point(family, (0.97, 1.03))
    curve = continue_orbits(family, onset, bounds=(0.98, 1.02), most=40, tolerance=1e-6)
    folds = [event for event in curve.events if event.kind is Bifurcation.FOLD]
    assert [event.kind for event in curve.events] == [Bifurcation.FOLD] * 2
    assert folds[0].parameter == pytest.approx(1.01, abs=5e-4)
    assert folds[1].parameter == pytest.approx(0.995, abs=5e-4)
    assert curve.stable[[0, -1]].all()
    # The stable branches, and the one between them that is not, are where runs say.
    scan = basin_scan(family(0.999), 1e-4 * np.array([[0.02, 0.7], [0.0, 0.0]]), turns=3000)
    assert scan.whirls.tolist() == [False, True]


def test_torus_is_born_at_the_threshold_of_whirl(short_rotor):
    rotor = short_rotor(0.3)

    def family(ratio):
        return rotor(ratio, unbalance=1e-3)

    curve = continue_orbits(family, periodic_orbit(family(0.9)), parameter=0.9, bounds=(0.85, 1.1), most=40)
    kinds = [event.kind for event in curve.events]
    assert kinds == [Bifurcation.NEIMARK_SACKER]
    # With little unbalance the orbit loses its stability where the rest does.
    assert curve.events[0].parameter == pytest.approx(1.0, abs=1e-4)
    assert np.abs(curve.events[0].orbit.multipliers[0]) == pytest.approx(1.0, abs=1e-6)


def test_period_doubling_of_a_heavier_unbalance(short_rotor):
    rotor = short_rotor(0.3)

    def family(unbalance):
        return rotor(0.985, unbalance=unbalance)

    curve = continue_orbits(family, periodic_orbit(family(0.02)), parameter=0.02, bounds=(0.01, 0.6), most=40)
    doubled = [event for event in curve.events if event.kind is Bifurcation.PERIOD_DOUBLING]
    assert doubled
    at = doubled[0]
    assert np.min(np.abs(at.orbit.multipliers + 1.0)) < 1e-5


def two_turns(rotor, parameter):
    """Return where a run from the orbit of one turn ends, as an orbit of two turns, and the run."""
    one = periodic_orbit(rotor(0.985, unbalance=parameter))
    times = np.linspace(116.0, 120.0, 257) * one.period
    run = simulate_rotor(
        rotor(0.985, unbalance=parameter),
        duration=times[-1],
        times=times,
        initial_state=1.01 * one.state,
        rtol=1e-8,
    )
    return one, periodic_orbit(rotor(0.985, unbalance=parameter), start=run, periods=2), run


def subharmonic(orbit):
    """Return the largest amplitude of the harmonics that one turn has not [m]."""
    cos, sin = np.split(orbit.series[0, :, 1:], 2, axis=1)
    return np.hypot(cos[:, ::2], sin[:, ::2]).max()


def test_a_run_doubles_its_period_where_the_orbit_of_one_turn_has_lost_stability(short_rotor):
    one, two, run = two_turns(short_rotor(0.3), 0.15)
    assert (one.stable, two.stable) == (False, True)
    assert two.period == pytest.approx(2.0 * one.period, rel=1e-12)
    assert run.position == pytest.approx(two.position(run.time)[0], abs=1e-7 * 1e-4)
    back = simulate_rotor(
        short_rotor(0.3)(0.985, unbalance=0.15),
        duration=two.period,
        initial_state=two.state,
        samples=3,
        rtol=1e-11,
    )
    assert back.position[:, 2] == pytest.approx(two.state[:2], abs=1e-7 * 1e-4)
    assert np.abs(back.position[:, 1] - two.state[:2]).max() > 0.5 * 1e-4


@pytest.mark.convergence
def test_orbits_of_two_turns_begin_at_the_period_doubling(short_rotor):
    """Normal form of a flip: amplitude^2 is proportional, 1 - mu_2 = 2 (mu_1^2 - 1) to first order."""
    rotor = short_rotor(0.3)

    def family(unbalance):
        return rotor(0.985, unbalance=unbalance)

    curve = continue_orbits(
        family, periodic_orbit(family(0.3)), parameter=0.3, bounds=(0.28, 0.31), direction=-1, most=12
    )
    (event,) = curve.events
    assert event.kind is Bifurcation.PERIOD_DOUBLING
    _, two, _ = two_turns(rotor, 0.28)
    squares, slopes = [], []
    parameters = np.array([0.2845, 0.287, 0.2884])
    for parameter in parameters:
        two = periodic_orbit(family(parameter), start=two, periods=2)
        first = periodic_orbit(family(parameter)).multipliers.real.min()
        squares.append(subharmonic(two) ** 2)
        slopes.append((1.0 - two.multipliers.real.max()) / (first**2 - 1.0))
    begin = np.polyval(np.polyfit(squares, parameters, 2), 0.0)
    assert begin == pytest.approx(event.parameter, abs=1e-6)
    assert slopes[-1] == pytest.approx(2.0, abs=0.01)
    assert slopes == sorted(slopes)


def test_more_turns_than_an_orbit_takes_are_the_same_orbit(short_rotor):
    mounted = short_rotor(0.3)(0.8, unbalance=0.1)
    one = periodic_orbit(mounted)
    three = periodic_orbit(mounted, periods=3)
    times = np.linspace(0.0, three.period, 50)
    assert three.position(times) == pytest.approx(one.position(times), abs=1e-9 * 1e-4)
    assert np.abs(three.multipliers[0]) == pytest.approx(np.abs(one.multipliers[0]) ** 3, rel=1e-6)


def test_over_any_parameter(short_rotor):
    rotor = short_rotor(0.3)
    curve = continue_orbits(
        lambda unbalance: rotor(0.8, unbalance=unbalance),
        periodic_orbit(rotor(0.8, unbalance=0.01)),
        parameter=0.01,
        bounds=(0.0, 0.2),
    )
    assert curve.parameters[-1] == pytest.approx(0.2, abs=1e-12)
    direct = periodic_orbit(rotor(0.8, unbalance=0.2))
    assert curve.orbits[-1].amplitude == pytest.approx(direct.amplitude, rel=1e-6)
    assert "bounds" in curve.reason


@pytest.mark.filterwarnings("ignore:.*beyond the Reynolds number")  # a model problem at any speed
def test_unstable_cycle_separates_two_ends(short_rotor):
    rotor = short_rotor(0.1)
    onset = hopf_point(rotor, (0.97, 1.03))
    curve = continue_orbits(rotor, onset, bounds=(0.97, 1.0), most=30, tolerance=1e-6)
    cycle = curve.orbits[-1]
    assert curve.parameters[-1] == pytest.approx(0.97)
    assert not cycle.stable
    mounted = rotor(0.97)
    ends = []
    for push in (-1e-3, 1e-3):
        mean = np.array([*cycle.series[0][:, 0], 0.0, 0.0])
        start = mean + (1.0 + push) * (cycle.state - mean)
        run = simulate_rotor(
            mounted, duration=300 * 2.0 * np.pi / cycle.speed, initial_state=start, rtol=1e-7
        )
        ends.append(np.ptp(run["y"][-20:]) / 2e-4)
    assert ends[0] < 0.4 < 0.6 < ends[1]


def test_arguments_are_checked(short_rotor):
    rotor = short_rotor(0.3)
    orbit = periodic_orbit(rotor(0.8, unbalance=0.01))
    with pytest.raises(InputError, match="parameter must be given"):
        continue_orbits(rotor, orbit, bounds=(0.0, 1.0))
    with pytest.raises(InputError, match="bounds must rise"):
        continue_orbits(rotor, orbit, parameter=0.8, bounds=(1.0, 0.5))
