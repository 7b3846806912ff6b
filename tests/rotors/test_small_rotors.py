"""Jeffcott rotor and rigid shaft, against their closed forms."""

import math

import numpy as np
import pytest
from numpy.testing import assert_allclose

from rotorfilm import InputError, LinearBearing
from rotorfilm.core import names
from rotorfilm.rotors import JeffcottRotor, RigidRotor, RigidShaft, mount


def jeffcott(speed, **changes):
    parts = {"mass": 3.0, "journal_mass": 0.5, "stiffness": 2e5, "gravity": (0.0, 0.0)}
    return JeffcottRotor(speed=speed, **(parts | changes))


def roots(rotor, bearing):
    model = mount(rotor, {"": bearing})
    return np.linalg.eigvals(model.linearization(0.0, model.initial_state, []).A)


@pytest.mark.closed_form
@pytest.mark.parametrize("external", [5.0, 50.0])
def test_internal_damping_drives_whirl_from_its_threshold_on(external):
    """The speed at which a Jeffcott rotor on rigid bearings whirls is w_n (1 + c_e / c_i)."""
    internal, natural = 20.0, math.sqrt(2e5 / 3.0)
    threshold = natural * (1.0 + external / internal)
    for factor, sign in ((1.0 - 1e-4, -1.0), (1.0 + 1e-4, 1.0)):
        rotor = jeffcott(factor * threshold, external_damping=external, internal_damping=internal)
        found = roots(rotor, LinearBearing(stiffness=1e13, damping=0.0))
        slow = found[np.abs(found) < 10.0 * natural]
        assert np.sign(slow.real.max()) == sign
        fastest = slow[np.argmax(slow.real)]
        assert abs(fastest.imag) == pytest.approx(natural, rel=1e-6)


@pytest.mark.closed_form
def test_modes_of_disk_and_journal_on_a_spring():
    """m u'' + k (u - v) = 0, m_j v'' + k (v - u) + k_b v = 0."""
    bearing = 3e5
    found = np.sort(np.abs(roots(jeffcott(100.0), LinearBearing(stiffness=bearing)).imag))[::4]
    K, M = np.array([[2e5, -2e5], [-2e5, 2e5 + bearing]]), np.diag([3.0, 0.5])
    assert_allclose(found, np.sqrt(np.sort(np.linalg.eigvals(np.linalg.solve(M, K)).real)), rtol=1e-10)


@pytest.mark.closed_form
def test_unbalance_response_is_that_of_the_textbook():
    """|r| / u = s^2 / sqrt((1 - s^2)^2 + (2 z s)^2) on rigid bearings, in steady motion."""
    ratio, damping_ratio, eccentricity = 1.3, 0.1, 1e-5
    natural = math.sqrt(2e5 / 3.0)
    speed, external = ratio * natural, 2 * damping_ratio * 3.0 * natural
    rotor = jeffcott(speed, external_damping=external, unbalance=3.0 * eccentricity)
    model = mount(rotor, {"": LinearBearing(stiffness=1e13, damping=1e3)})
    A = model.linearization(0.0, model.initial_state, []).A
    force = model.derivative(0.0, np.zeros(8), []) - 1j * model.derivative(
        math.pi / 2 / speed, np.zeros(8), []
    )
    motion = np.linalg.solve(1j * speed * np.eye(8) - A, force)
    wanted = eccentricity * ratio**2 / math.hypot(1 - ratio**2, 2 * damping_ratio * ratio)
    assert_allclose(np.abs(motion[[0, 2]]), wanted, rtol=1e-6)


def test_signals_of_a_jeffcott_rotor_fit_a_film():
    rotor = jeffcott(10.0)
    assert names(rotor.inputs) == ["force_x", "force_y"]
    assert names(rotor.outputs) == ["x", "y", "vx", "vy", "disk_x", "disk_y", "speed"]
    assert names(rotor.states)[:4] == ["disk_x", "journal_x", "disk_y", "journal_y"]


def rigid_shaft(speed, **changes):
    parts = {
        "mass": 20.0,
        "diametral_inertia": 0.8,
        "polar_inertia": 1.1,
        "stations": (("left", -0.3), ("right", 0.5)),
        "gravity": (0.0, -9.0),
    }
    return RigidShaft(speed=speed, **(parts | changes))


@pytest.mark.closed_form
def test_rigid_shaft_tilts_and_translates_as_in_closed_form():
    """Equal springs at equal distances decouple: m p^2 = 2 k and I p^2 - J w p - 2 k a^2 = 0."""
    k, a, speed = 1e6, 0.4, 300.0
    rotor = rigid_shaft(speed, stations=(("left", -a), ("right", a)))
    model = mount(rotor, dict.fromkeys(("left", "right"), LinearBearing(stiffness=k)))
    found = np.sort(np.abs(np.linalg.eigvals(model.linearization(0.0, model.initial_state, []).A)))[::2]
    tilt = np.abs(np.roots([0.8, -1.1 * speed, -2 * k * a**2]))
    assert_allclose(found, np.sort([*tilt, *[math.sqrt(2 * k / 20.0)] * 2]), rtol=1e-9)


@pytest.mark.closed_form
def test_rigid_shaft_in_its_middle_is_the_rigid_rotor():
    film = LinearBearing(stiffness=((1e6, 2e5), (-3e5, 2e6)), damping=500.0)
    tall = rigid_shaft(50.0, stations=(("", 0.0),), unbalances=((0.0, 1e-3, 0.3),))
    flat = RigidRotor(mass=20.0, speed=50.0, gravity=(0.0, -9.0), unbalance=1e-3, unbalance_angle=0.3)
    force = film.force([1e-5, 2e-5], [0.1, 0.2], 50.0)
    wanted = flat.derivative(0.2, [1e-5, 2e-5, 0.1, 0.2], force)
    found = tall.derivative(0.2, [1e-5, 0, 2e-5, 0, 0.1, 0, 0.2, 0], force)
    assert_allclose(found[[0, 2, 4, 6]], wanted, rtol=1e-13)
    assert_allclose(found[[1, 3, 5, 7]], 0.0)


@pytest.mark.closed_form
def test_unbalance_off_the_middle_tilts_a_rigid_shaft():
    rotor = rigid_shaft(40.0, unbalances=((0.25, 2e-3, 0.0),), gravity=(0.0, 0.0))
    rate = rotor.derivative(0.0, np.zeros(8), np.zeros(4))
    assert_allclose(rate[4:], [2e-3 * 1600 / 20.0, 0.25 * 2e-3 * 1600 / 0.8, 0.0, 0.0], atol=1e-15)


@pytest.mark.parametrize(
    ("make", "match"),
    [
        (lambda: jeffcott(0.0, journal_mass=0.0), "journal_mass must be finite and positive, got 0.0"),
        (lambda: jeffcott(0.0, internal_damping=-1.0), "internal_damping must be finite and not negative"),
        (lambda: jeffcott(math.inf), "speed must be a single finite number, got inf"),
        (lambda: rigid_shaft(0.0, polar_inertia=-1.0), "polar_inertia must be finite and not negative"),
        (lambda: rigid_shaft(0.0, unbalances=((0.0, 1.0),)), "unbalances must be triples of numbers"),
        (lambda: rigid_shaft(0.0, stations=(("a", 0.0), ("a", 1.0))), "stations must have different names"),
    ],
)
def test_bad_parameters_are_named(make, match):
    with pytest.raises(InputError, match=match):
        make()
