"""Orbits of shafts in few of their shapes against those of all coordinates."""

import sys
from dataclasses import replace

import numpy as np
import pytest

from rotorfilm import (
    Cooling,
    FrequencyDependentReaction,
    JournalBearing,
    LinearBearing,
    Oil,
    ShortFilm,
    TiltingPadBearing,
    Unbalance,
    even_pivots,
    mount,
    periodic_orbit,
)
from rotorfilm.analysis import harmonic_balance
from rotorfilm.analysis.force_calls import film_samples
from rotorfilm.analysis.modal_reduction import counted, models
from rotorfilm.analysis.periodic_orbit import orbit_rotor
from rotorfilm.rotors import Station

from ...linear.test_big_rotors import long_rotor

BEARING = JournalBearing(radius=0.05, length=0.03, clearance=1e-4, viscosity=0.1)
PADS = TiltingPadBearing(
    radius=0.05,
    length=0.03,
    viscosity=0.1,
    pivots=even_pivots(4, between_pads=True),
    extent=np.radians(72.0),
    preload=0.3,
    assembled_clearance=1e-4,
)
SPRUNG = replace(PADS, pivot_stiffness=2e8, pad_inertia=2e-4, pad_mass=0.3)
WARM = JournalBearing(
    radius=0.05,
    length=0.03,
    clearance=1e-4,
    oil=Oil.iso_vg(100),
    cooling=Cooling(supply_temperature=313.15, bush_heat_capacity=2.0),
    film=ShortFilm(),
)
SEARCH = "rotorfilm.analysis.periodic_orbit"


def mounted(count, speed=150.0, unbalance=3e-3, bearing=BEARING):
    rotor = long_rotor(count, speed=speed, unbalances=(Unbalance(node=count // 3, unbalance=unbalance),))
    return mount(rotor, {"left": bearing, "right": bearing})


@pytest.mark.parametrize(
    "bearing", [BEARING, PADS, SPRUNG, WARM.in_time()], ids=["plain", "pads", "heavy pads on springs", "warm"]
)
def test_an_orbit_in_few_shapes_is_that_of_the_whole_shaft(monkeypatch, bearing):
    few = periodic_orbit(mounted(6, bearing=bearing))
    monkeypatch.setattr(sys.modules[SEARCH], "_model", lambda rotor, level: None)
    whole = periodic_orbit(mounted(6, bearing=bearing))
    assert len(few.multipliers) < len(whole.multipliers) == len(few.state)
    assert few.amplitude > 0.01
    assert few.residual <= 1e-7
    assert few.series / 1e-4 == pytest.approx(whole.series / 1e-4, abs=1e-8)
    for name, series in whole.further.items():
        assert few.further[name] == pytest.approx(series, abs=1e-8 * np.abs(series).max())
    count = len(mounted(6).states)
    assert few.state == pytest.approx(whole.state, abs=1e-6 * np.abs(whole.state[:count]).max())
    assert len(few.multipliers) >= 8
    for one in few.multipliers:  # those of fast motion of the whole shaft are larger
        assert np.abs(whole.multipliers - one).min() < 1e-6


def test_more_shapes_are_taken_until_the_whole_shaft_is_in_balance(monkeypatch):
    wanted, asked = periodic_orbit(mounted(12)), []

    def poor(rotor, level):
        asked.append(level)
        return next(models(rotor, 10.0 if level == 0 else 1e4, 24))

    monkeypatch.setattr(sys.modules[SEARCH], "_model", poor)
    found = periodic_orbit(mounted(12), tolerance=1e-10)
    assert asked == [0, 1]
    assert found.residual <= 1e-10
    times = np.linspace(0.0, wanted.period, 16)
    assert found.position(times) / 1e-4 == pytest.approx(wanted.position(times) / 1e-4, abs=1e-7)


def test_a_bearing_that_drives_fast_motions_makes_the_orbit_of_the_whole_shaft_unstable():
    """The lower modes decay: damping that is negative drives those of high frequency first."""
    rotor = mounted(8).bare
    rotor = replace(rotor, stations=(*rotor.stations, Station(node=4, name="seal")))
    bearings = {"left": BEARING, "right": BEARING, "seal": LinearBearing(stiffness=0.0, damping=-100.0)}
    orbit = periodic_orbit(mount(rotor, bearings))
    assert not orbit.stable
    cross = LinearBearing(stiffness=((0.0, 5e4), (-5e4, 0.0)), damping=100.0)
    calm = periodic_orbit(mount(rotor, bearings | {"seal": cross}))
    assert len(calm.multipliers) < len(orbit.multipliers) == len(orbit.state)


def test_a_bearing_that_drives_fast_motions_is_seen_beside_pads():
    rotor = mounted(6).bare
    rotor = replace(rotor, stations=(*rotor.stations, Station(node=3, name="seal")))
    bearings = {"left": PADS, "right": PADS, "seal": LinearBearing(stiffness=0.0, damping=-100.0)}
    orbit = periodic_orbit(mount(rotor, bearings))
    assert len(orbit.multipliers) == len(orbit.state)
    on_pads = mount(rotor, bearings | {"seal": LinearBearing(stiffness=0.0, damping=100.0)})
    calm = periodic_orbit(on_pads)
    assert (len(calm.multipliers) < len(calm.state)) is has_shapes(on_pads)


def has_shapes(on_films):
    """Return whether the stiffness of a shaft is positive in spite of round-off: else all of it moves."""
    return orbit_rotor(on_films).shaft is not None


def resonant(gain):
    """Return a bearing with the force gain w^2/(s^2 + 0.04 w s + w^2), w = 2340 rad/s, and dampers."""
    w, pair = 2340.0, np.eye(2)
    return FrequencyDependentReaction(
        A=np.kron(pair, [[0.0, w], [-w, -0.04 * w]]),
        B=np.kron(pair, [[0.0], [w]]),
        C=np.kron(pair, [[gain, 0.0]]),
        D=np.zeros((2, 2)),
        damping=100.0 * pair,
    )


@pytest.mark.parametrize(("gain", "is_stable"), [(-1e6, False), (1e3, True)])
def test_states_that_feed_one_fast_motion_are_found(gain, is_stable):
    rotor = mounted(6).bare
    rotor = replace(rotor, stations=(*rotor.stations, Station(node=1, name="seal")))
    on_films = mount(rotor, {"left": BEARING, "right": BEARING, "seal": resonant(gain)})
    orbit = periodic_orbit(on_films)
    assert orbit.stable is is_stable
    assert (len(orbit.multipliers) < len(orbit.state)) is (is_stable and has_shapes(on_films))


def test_a_stiffness_that_states_make_holds_the_shaft(monkeypatch):
    pair = np.eye(2)
    followed = FrequencyDependentReaction(
        A=-2000.0 * pair, B=2000.0 * pair, C=-5e6 * pair, D=np.zeros((2, 2)), damping=2e4 * pair
    )
    few = periodic_orbit(mounted(6, bearing=followed))
    monkeypatch.setattr(sys.modules[SEARCH], "_model", lambda rotor, level: None)
    whole = periodic_orbit(mounted(6, bearing=followed))
    assert len(few.multipliers) < len(whole.multipliers)
    assert few.state == pytest.approx(whole.state, abs=1e-8 * np.abs(whole.state).max())
    assert 0.0 < few.residual < 1e-7


def test_a_part_of_the_unbalance_bends_the_shapes_left_out_as_much(monkeypatch):
    def half():
        rotor = orbit_rotor(mounted(6, bearing=PADS)).loaded(0.5)
        balance = harmonic_balance.Balance(rotor=rotor, harmonics=8, periods=1)
        found = harmonic_balance.solve(balance, harmonic_balance.constant(rotor.guess(), 8), 150.0, 1e-10)
        series = found.series
        return rotor.state(series, 150.0, 1), rotor.neglected(balance, series, 150.0)

    state, missing = half()
    monkeypatch.setattr(sys.modules[SEARCH], "_model", lambda rotor, level: None)
    assert 0.0 < missing < 1e-7
    assert state == pytest.approx(half()[0], abs=1e-6 * np.abs(state).max())


@pytest.mark.parametrize("bearing", [PADS, SPRUNG, WARM.in_time()], ids=["pads", "springs", "warm"])
def test_films_at_many_motions_are_those_at_one(bearing):
    random, n = np.random.default_rng(3), len(bearing.states)
    places, rates = random.uniform(-3e-5, 3e-5, (2, 7)), random.uniform(-5e-3, 5e-3, (2, 7))
    own = bearing.initial_state[:, None] + np.array([[s.nominal] for s in bearing.states]) * random.uniform(
        0.0, 0.02, (n, 7)
    )
    answers, slopes = film_samples(bearing, np.vstack([places, rates, own]), 300.0)
    for k in range(7):
        u, x = np.array([*places[:, k], *rates[:, k], 300.0]), own[:, k]
        expected = np.append(bearing.output(0.0, x, u)[:2], bearing.derivative(0.0, x, u))
        assert answers[:, k] == pytest.approx(expected, rel=1e-11, abs=1e-11 * np.abs(expected).max())
        A, B, C, D = bearing.linearization(0.0, x, u)
        for found, wanted in (
            (slopes[:2, :5], D[:2]),
            (slopes[:2, 5:], C[:2]),
            (slopes[2:, :5], B),
            (slopes[2:, 5:], A),
        ):
            np.testing.assert_allclose(found[..., k], wanted, rtol=1e-9, atol=1e-9 * np.abs(wanted).max())


def test_the_work_of_an_orbit_does_not_grow_with_the_coordinates():
    """Each harmonic is solved once in all coordinates for its balance, and once for the state."""
    periodic_orbit(mounted(24))
    with counted("factorizations") as work:
        orbit = periodic_orbit(mounted(24, speed=151.0))
    assert work["factorizations"] <= 2 * (orbit.harmonics + 1) + 3


def test_shafts_of_the_same_parts_share_their_matrices():
    slow, fast, other = (long_rotor(4, speed=w) for w in (1.0, 2.0, 1.0))
    assert slow.assembly is fast.assembly is other.assembly
    assert long_rotor(4, internal_damping=1e-6).assembly is not slow.assembly
    weight = fast.structure.weight.copy()
    slow.structure.weight[:] = 0.0
    assert (fast.structure.weight == weight).all()
