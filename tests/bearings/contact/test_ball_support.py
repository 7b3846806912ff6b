"""A journal on lubricated balls: statics, derivatives, symmetry, motion."""

import math
from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, strategies as st

from rotorfilm import (
    BallSupport,
    ContactLaw,
    Disk,
    Dynamic,
    ElasticMaterial,
    InputError,
    LinearBearing,
    Reaction,
    RigidRotor,
    ShaftElement,
    ShaftRotor,
    Station,
    ValidityWarning,
    campbell,
    coefficients,
    equilibrium,
    mount,
    simulate,
)
from rotorfilm.core import Switched

ANGLES = (math.radians(-135), math.radians(-90), math.radians(-45), math.radians(90))


def law(order=2):
    """Return a law with round numbers: offset 0.3, span 2.1, exponent 1.5, one pair of poles."""
    A, B = np.array([[-2.0, 3.0], [-3.0, -2.0]]), np.array([[2.0], [0.0]])
    C = np.array([[-0.2, 0.1]])
    return ContactLaw(
        offset=0.3, span=2.1, exponent=1.5, operating=-1.8, A=A, B=B, C=C, D=C @ np.linalg.solve(A, B),
        static_error=0.0, damping_error=0.0, film_scale=1e-6, time_scale=1e-4, force_scale=50.0,
    )  # fmt: skip


STEEL = ElasticMaterial(density=7850.0, young_modulus=2.1e11, shear_modulus=8.1e10)
SUPPORT = BallSupport(law=law(), angles=ANGLES, gap=-1e-6)


def test_the_preload_of_a_law_is_a_gap():
    preloaded = BallSupport(law=law(), angles=ANGLES, gap=law().approach(20.0))
    assert preloaded.gap == float(law().approach(20.0))


def test_is_a_reaction_with_states():
    assert isinstance(SUPPORT, Reaction)
    assert isinstance(SUPPORT, Dynamic)
    assert isinstance(SUPPORT, Switched)
    assert len(SUPPORT.states) == 8


@pytest.mark.closed_form
def test_one_ball_pushes_along_its_line():
    one = BallSupport(law=law(), angles=(math.radians(-90),), gap=0.0)
    # Under 50 N the approach is 0.3 - 2.1 film scales; the ball below pushes up.
    z = float(law().approach(50.0))
    assert z == pytest.approx((0.3 - 2.1) * 1e-6)
    force = one.force([0.0, z], [0.0, 0.0])
    assert force == pytest.approx([0.0, 50.0], abs=1e-9)
    assert one.force([0.0, 1e-6], [0.0, 0.0]) == pytest.approx([0.0, 0.0], abs=1e-12)
    slope = one.jacobian([0.0, z], [0.0, 0.0])
    assert -slope[1, 1] == pytest.approx(1.5 * 50.0 / 2.1e-6)
    assert -slope[1, 3] == pytest.approx(law().damping)


@pytest.mark.closed_form
def test_damping_of_slow_motions_is_the_limit_of_the_dynamic_stiffness():
    own = law()
    s = 1e-4j
    answer = (own.C @ np.linalg.solve(s * np.eye(2) - own.A, own.B.astype(complex)) + own.D)[0, 0]
    assert own.damping == pytest.approx(-answer.imag / 1e-4 * 50.0 * 1e-4 / 1e-6, rel=1e-6)


def test_at_rest_the_states_add_nothing():
    position = np.array([2e-7, -5e-7])
    u = [*position, 0.0, 0.0, 100.0]
    x = SUPPORT.resting(position)
    assert SUPPORT.derivative(0.0, x, u) == pytest.approx(np.zeros(8), abs=1e-6)
    assert SUPPORT.output(0.0, x, u) == pytest.approx(SUPPORT.force(position, [0.0, 0.0]))


@given(st.tuples(*[st.floats(-1.5e-6, 1.5e-6)] * 2), st.lists(st.floats(-0.3, 0.3), min_size=8, max_size=8))
def test_linearization_is_exact(position, x):
    u = np.array([*position, 0.0, 0.0, 10.0])
    at = SUPPORT.linearization(0.0, x, u)
    if np.min(np.abs(SUPPORT.events(0.0, x, u))) < 1e-3:
        return  # at a kink
    step = 1e-12
    for k in range(2):
        ends = [u + sign * step * np.eye(5)[k] for sign in (-1.0, 1.0)]
        slope = np.subtract(*[SUPPORT.output(0.0, x, end) for end in ends[::-1]]) / (2.0 * step)
        assert at.D[:, k] == pytest.approx(slope, rel=1e-4, abs=1e3)
        rate = np.subtract(*[SUPPORT.derivative(0.0, x, end) for end in ends[::-1]]) / (2.0 * step)
        assert at.B[:, k] == pytest.approx(rate, rel=1e-4, abs=1e3)
    x = np.array(x)
    forces = [SUPPORT.output(0.0, x + d, u) for d in (1e-6 * np.eye(8))]
    slope = (np.array(forces) - SUPPORT.output(0.0, x, u)).T / 1e-6
    assert pytest.approx(slope, abs=1e-3) == at.C


@given(
    st.floats(0.0, 6.3), st.tuples(*[st.floats(-1e-6, 1e-6)] * 2), st.tuples(*[st.floats(-1e-4, 1e-4)] * 2)
)
def test_turned_balls_turn_the_force(angle, position, velocity):
    turn = np.array([[math.cos(angle), -math.sin(angle)], [math.sin(angle), math.cos(angle)]])
    turned = BallSupport(law=law(), angles=tuple(a + angle for a in ANGLES), gap=-1e-6)
    expected = turn @ SUPPORT.force(position, velocity)
    assert turned.force(turn @ position, turn @ velocity) == pytest.approx(expected, abs=1e-6)


def test_force_takes_batches():
    position = np.random.default_rng(1).uniform(-1e-6, 1e-6, (2, 5, 3))
    velocity = 1e-3 * position[::-1]
    forces, slopes = SUPPORT.force(position, velocity), SUPPORT.jacobian(position, velocity)
    assert (forces.shape, slopes.shape) == ((2, 5, 3), (2, 5, 5, 3))
    assert forces[:, 2, 1] == pytest.approx(SUPPORT.force(position[:, 2, 1], velocity[:, 2, 1]))
    assert slopes[..., 2, 1] == pytest.approx(SUPPORT.jacobian(position[:, 2, 1], velocity[:, 2, 1]))


@pytest.mark.closed_form
def test_a_rotor_swings_with_the_stiffness_of_the_balls():
    at = equilibrium(SUPPORT, [0.0, -80.0], 0.0)
    assert SUPPORT.force(at.position, [0.0, 0.0]) == pytest.approx([0.0, 80.0], abs=1e-6)
    stiffness = coefficients(SUPPORT, at.position, 0.0).stiffness
    mass = 1.0
    rotor = RigidRotor(
        mass=mass, speed=0.0, gravity=(0.0, 0.0), static_force=(0.0, -80.0),
        position=(at.position[0], at.position[1] - 1e-9),
    )  # fmt: skip
    start = np.concatenate([rotor.initial_state, SUPPORT.resting(at.position)])
    period = 2.0 * math.pi / math.sqrt(stiffness[1, 1] / mass)
    motion = simulate(rotor, SUPPORT, duration=4.0 * period, samples=2001, initial_state=start)
    swing = motion["y"] - at.position[1]
    crossings = motion.time[1:][np.diff(np.sign(swing)) > 0]
    assert np.diff(crossings).mean() == pytest.approx(period, rel=0.02)


@pytest.mark.parametrize(
    ("change", "message"),
    [
        ({"law": 1.0}, r"law must be a ContactLaw, got 1\.0"),
        ({"angles": ()}, r"angles must be a list of at least one angle, got \(\)"),
        ({"gap": math.nan}, "gap must be"),
        ({"gap": -5e-6}, r"gap must keep the load of each ball below 150 N, .* got -5e-06"),
    ],
)
def test_names_the_broken_rule(change, message):
    with pytest.raises(InputError, match=message):
        BallSupport(**{"law": law(), "angles": ANGLES, **change})


def damped_support():
    """Return eight preloaded balls with one state each, whose damping is k a/(nu^2 + a^2), with a and k."""
    a, k = 0.5, 0.08
    one = replace(
        law(), A=np.array([[-a]]), B=np.ones((1, 1)), C=np.array([[k * a]]), D=np.array([[-k]])
    )  # -[Z(s) - Z(0)] = -k s/(s + a) in units of 50 N, 1e-6 m, 1e-4 s
    support = BallSupport(law=one, angles=tuple(math.pi / 4 * np.arange(8)), gap=float(one.approach(20.0)))
    return support, a / 1e-4, k * 50.0 / 1e-6


@pytest.mark.closed_form
@pytest.mark.parametrize("frequency", [0.0, 100.0, 2e4, 5.9e4])
def test_coefficients_are_those_of_the_frequency(frequency):
    """The sum of n n' is 4: the spring 4 k nu^2/(nu^2 + a^2) and the damper 4 k a/(nu^2 + a^2) are added."""
    support, a, k = damped_support()
    found = coefficients(support, (0.0, 0.0), 100.0, frequency=frequency)
    static = -4.0 * float(support.law.static_slope(support.gap))
    size = frequency**2 + a**2
    assert found.frequency == frequency
    assert found.stiffness == pytest.approx(
        (static + 4.0 * k * frequency**2 / size) * np.eye(2), abs=1e-6 * static
    )
    assert found.damping == pytest.approx(4.0 * k * a / size * np.eye(2), abs=1e-9 * k / a)
    assert coefficients(support, (0.0, 0.0), 100.0).damping == pytest.approx(
        4.0 * k * a / (100.0**2 + a**2) * np.eye(2), abs=1e-9 * k / a
    )


def test_a_frequency_beyond_the_law_is_warned_of():
    support, *_ = damped_support()
    with pytest.warns(
        ValidityWarning, match="frequency should be at most 60000 rad/s, to which the law was fitted"
    ):
        coefficients(support, (0.0, 0.0), 100.0, frequency=6.1e4)
    with pytest.warns(ValidityWarning, match="frequency should be at most 60000 rad/s, .* got 61000.0"):
        coefficients(support, (0.0, 0.0), -6.1e4)
    coefficients(support, (0.0, 0.0), 6.1e4, frequency=100.0)


def test_a_campbell_diagram_has_the_damping_of_each_frequency():
    """All log decrements of a shaft on two supports are those of the state space of both."""
    support, *_ = damped_support()
    rotor = ShaftRotor(
        elements=ShaftElement(length=0.15, outer_diameter=0.04, material=STEEL).split(4),
        disks=(Disk(node=2, mass=3.0, polar_inertia=2e-3, diametral_inertia=1e-3),),
        stations=(Station(name="left", node=0), Station(name="right", node=4)),
        gravity=(0.0, 0.0),
        speed=100.0,
    )
    films = {"left": support, "right": support}
    modes = campbell(rotor, films, [100.0]).eigenvalues[:, 0]
    mounted = mount(rotor, films)
    values = np.linalg.eigvals(mounted.linearization(0.0, mounted.initial_state, ()).A)
    below = modes[(modes.imag > 1e3) & (modes.imag < 5e4)]
    assert len(below) >= 4
    for value in below:
        assert np.abs(values - value).min() < 1e-9 * abs(value)
    slow = LinearBearing(
        **{
            name: getattr(coefficients(support, (0.0, 0.0), 100.0, frequency=0.0), name)
            for name in ("stiffness", "damping")
        }
    )
    wrong = campbell(rotor, dict.fromkeys(films, slow), [100.0]).log_decrement[:, 0]
    assert wrong[0] > 1.02 * (-2.0 * np.pi * below[0].real / below[0].imag)
