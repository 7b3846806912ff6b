"""Reactions of a user's own with other freedoms and states go through every analysis as they are."""

import warnings
from dataclasses import replace

import fmpy
import numpy as np
import pytest
from numpy.testing import assert_allclose
from scipy.linalg import expm

import rotorfilm as rf
from rotorfilm import (
    InputError,
    RigidRotor,
    closed_loop,
    coefficients,
    equilibrium,
    mount,
    rotor_equilibrium,
    rotor_modes,
    rotor_system,
    rotor_threshold,
    simulate,
)
from rotorfilm.analysis import dynamic_stiffness, frozen_coefficients, quasi_static_coefficients
from rotorfilm.analysis.api617 import cross_coupled
from rotorfilm.analysis.rotor_matrices import parted_pairs
from rotorfilm.bearings import Body, Series
from rotorfilm.core.port import force_along, has_film

from .port_toys import Rubber, Strips, ThrustSpring

SPEED = 300.0


RUBBER, STRIPS, THRUST = Rubber(), Strips(), ThrustSpring()


def test_states_are_eliminated_exactly():
    at = equilibrium(RUBBER, (0.0, -500.0), SPEED)
    assert_allclose(at.position, [0.0, -500.0 / RUBBER.stiffness], rtol=1e-12)
    assert at.residual <= 1e-12
    for s in (0.0, 1j * SPEED, 40.0 - 900.0j):
        assert_allclose(dynamic_stiffness(RUBBER, at, s), RUBBER.stiffness_at(s) * np.eye(2), rtol=1e-13)
    whole = RUBBER.stiffness_at(1j * 777.0)
    found = coefficients(RUBBER, at.position, SPEED, frequency=777.0)
    assert_allclose(found.stiffness, whole.real * np.eye(2), rtol=1e-13)
    assert_allclose(found.damping, whole.imag / 777.0 * np.eye(2), rtol=1e-12)
    slow = quasi_static_coefficients(RUBBER, at.position, SPEED)
    assert_allclose(slow.damping, (RUBBER.damping + RUBBER.maxwell * RUBBER.time) * np.eye(2), rtol=1e-12)
    held = frozen_coefficients(RUBBER, at.position, SPEED)
    assert_allclose(held.stiffness, (RUBBER.stiffness + RUBBER.maxwell) * np.eye(2), rtol=1e-13)
    assert_allclose(held.damping, RUBBER.damping * np.eye(2), rtol=1e-13)


class Wary(Rubber):
    """One that keeps what it is asked to warn of."""

    def __init__(self, asked):
        vars(self)["asked"] = asked

    def warn_of_load(self, load):
        self.asked.append(("load", *load))

    def warn_of_flow(self, speed, *temperatures):
        self.asked.append(("flow", speed))


@pytest.mark.parametrize("is_film", [False, True])
def test_a_reaction_or_its_bearing_is_asked_to_warn(is_film):
    asked = []
    reaction = Rubber() if is_film else Wary(asked)
    if is_film:
        vars(reaction)["bearing"] = Wary(asked)
    at = equilibrium(reaction, (0.0, -500.0), SPEED)
    assert asked == [("load", 0.0, -500.0), ("flow", SPEED)]
    coefficients(reaction, at.position, SPEED)
    assert asked[2:] == [("flow", SPEED)]


class Submerged:
    """A journal in a wide bath, which adds a mass and damps."""

    has_inertia = True

    def force(self, position, velocity, speed):
        return -200.0 * np.asarray(velocity)

    def mass(self, position, velocity, speed):
        return np.einsum("ij,...->ij...", [[3.0, 0.5], [0.5, 4.0]], 1.0 + np.asarray(position)[0])


@pytest.mark.closed_form
def test_force_along_a_motion_has_that_of_the_added_mass():
    q, v, a = np.random.default_rng(0).uniform(-1.0, 1.0, (3, 2, 5))
    along = force_along(Submerged(), q, v, a, SPEED)
    grown = 1.0 + q[0]
    expected = [grown * (3.0 * a[0] + 0.5 * a[1]), grown * (0.5 * a[0] + 4.0 * a[1])]
    assert_allclose(along, -200.0 * v - np.array(expected), rtol=1e-13)
    assert_allclose(force_along(rf.LinearBearing(stiffness=2.0), q, v, a, SPEED), -2.0 * q, rtol=1e-13)


def test_a_rotor_on_states_of_a_users_own_is_the_joined_system():
    rotor = RigidRotor(mass=30.0, speed=SPEED)
    at = equilibrium(RUBBER, rotor.static_load, SPEED)
    whole = mount(rotor, {"": RUBBER})
    A = whole.linearization(0.0, np.zeros(6), []).A
    loop = closed_loop(rotor, RUBBER, at)
    assert_allclose(np.sort(loop.poles()), np.sort(np.linalg.eigvals(A)), rtol=1e-10)
    s = 1j * 650.0
    receptance = np.linalg.inv(rotor.mass * s**2 * np.eye(2) + RUBBER.stiffness_at(s) * np.eye(2))
    assert_allclose(loop(s)[:2], receptance, rtol=1e-10)
    rest = np.array([0.0, at.position[1], 0.0, 0.0, 0.0, at.position[1]])
    start = rest + np.array([1e-6, 0.0, 0.0, 0.0, 0.0, 0.0])
    run = simulate(rotor, RUBBER, duration=0.02, samples=21, initial_state=start, rtol=1e-11)
    moved = [expm(A * t) @ (start - rest) + rest for t in run.time]
    assert_allclose(run["x"], [one[0] for one in moved], atol=1e-9 * 1e-6)


def test_modes_and_threshold_go_by_the_states():
    rotor = rf.JeffcottRotor(mass=20.0, journal_mass=2.0, stiffness=2e7, speed=SPEED, internal_damping=3000.0)
    at = rotor_equilibrium(rotor, {"": RUBBER}, SPEED)
    poles = np.linalg.eigvals(mount(rotor, {"": RUBBER}).linearization(0.0, np.zeros(10), []).A)
    for value in rotor_modes(rotor, {"": RUBBER}, SPEED).eigenvalues:
        assert np.abs(poles - value).min() < 1e-8 * abs(value)
    assert_allclose(np.sort(rotor_system(rotor, at).poles()), np.sort(poles), rtol=1e-9)
    found = rotor_threshold(rotor, {"": RUBBER}, np.linspace(300.0, 6000.0, 30))
    fast = replace(rotor, speed=found.speed)
    values = np.linalg.eigvals(mount(fast, {"": RUBBER}).linearization(0.0, np.zeros(10), []).A)
    assert abs(values.real.max()) < 1e-6 * abs(values).max()


def test_strips_have_the_stiffness_of_their_forces():
    load = (30.0, -120.0, 0.1, -0.2)
    at = equilibrium(STRIPS, load, SPEED)
    assert_allclose(STRIPS.output(0.0, [], [*at.position, *np.zeros(4), SPEED]), np.negative(load), rtol=1e-9)
    K = coefficients(STRIPS, at.position, SPEED).stiffness
    step = np.array([1e-9, 1e-9, 1e-7, 1e-7])
    for k, h in enumerate(step):
        ends = [
            STRIPS.output(0.0, [], [*(at.position + side * h * np.eye(4)[k]), *np.zeros(4), SPEED])
            for side in (-1.0, 1.0)
        ]
        assert_allclose(K[:, k], (ends[0] - ends[1]) / (2.0 * h), rtol=1e-5, atol=1e-7 * np.abs(K).max())


def test_a_reaction_that_does_not_fit_its_station_says_what_is_missing():
    rotor = RigidRotor(mass=30.0, speed=SPEED)
    with pytest.raises(InputError, match=r"rotor must have the outputs .*tilt_x"):
        mount(rotor, {"": STRIPS})
    with pytest.raises(InputError, match="reaction must react to x and y alone here"):
        rf.whirl_threshold(STRIPS, (0.0, -100.0), 10.0)
    with pytest.raises(InputError, match=r"load must have shape \(4,\) for x, y, tilt_x, tilt_y"):
        equilibrium(STRIPS, (0.0, -100.0), SPEED)


STEEL = rf.ElasticMaterial(young_modulus=2.1e11, shear_modulus=8.1e10, density=7850.0)


def shaft(**changes):
    """Return a shaft on two tilting stations and one in the middle, which moves along its axis too."""
    piece = rf.ShaftElement(length=0.6, outer_diameter=0.04, material=STEEL)
    given = {
        "elements": piece.split(4),
        "speed": SPEED,
        "stations": (
            rf.Station(node=0, name="left", feels_tilt=True),
            rf.Station(node=4, name="right", feels_tilt=True),
            rf.Station(node=2, name="thrust", feels_tilt=True),
        ),
        "disks": (rf.Disk(node=2, mass=8.0, diametral_inertia=0.05, polar_inertia=0.09),),
        "internal_damping": 2e-6,
        "axial": True,
    }
    return rf.ShaftRotor(**{**given, **changes})


BEARINGS = {"left": STRIPS, "right": STRIPS, "thrust": THRUST}


def joined(rotor, bearings):
    """Return where a rotor rests as a state of the mounted system, and the matrix of small motion there."""
    whole = mount(rotor, bearings)
    at = rotor_equilibrium(rotor, bearings, SPEED)
    x = np.concatenate([at.displacement, np.zeros_like(at.displacement)])
    u = np.zeros(len(whole.inputs))
    assert np.abs(whole.derivative(0.0, x, u)).max() < 1e-6
    return at, x, whole.linearization(0.0, x, u)


def test_a_shaft_with_five_freedoms_is_one_system_in_all_analyses():
    rotor = shaft()
    at, _, (A, B, C, _) = joined(rotor, BEARINGS)
    poles = np.linalg.eigvals(A)
    found = rotor_modes(rotor, BEARINGS, SPEED).eigenvalues
    assert len(found) >= 10
    for value in found:
        assert np.abs(poles - value).min() < 1e-8 * abs(value) + 1e-6
    system = rotor_system(rotor, at)
    free, s = [signal.name for signal in mount(rotor, BEARINGS).inputs], 1j * 450.0
    assert free == ["thrust_force_x", "thrust_force_y", "left_force_z", "right_force_z"]
    seen = system.output_labels.index("thrust_z")
    rows = [signal.name for signal in rotor.outputs].index("thrust_z")
    receptance = C[rows] @ np.linalg.solve(s * np.eye(len(A)) - A, B)
    for k, name in enumerate(free):
        assert_allclose(
            system(s)[seen, system.input_labels.index(name)], receptance[k], rtol=1e-8, atol=1e-20
        )


def test_small_motion_of_a_shaft_over_time_is_that_of_its_matrix():
    rotor = shaft(
        elements=rf.ShaftElement(length=0.6, outer_diameter=0.04, material=STEEL).split(2),
        stations=(
            rf.Station(node=0, name="left", feels_tilt=True),
            rf.Station(node=2, name="right", feels_tilt=True),
            rf.Station(node=1, name="thrust", feels_tilt=True),
        ),
        disks=(rf.Disk(node=1, mass=8.0, diametral_inertia=0.05, polar_inertia=0.09),),
    )
    _, rest, (A, _, C, _) = joined(rotor, BEARINGS)
    kick = np.zeros_like(rest)
    kick[[signal.name for signal in rotor.states].index("vz_1")] = 1e-6
    run = simulate(rotor, BEARINGS, duration=2e-3, samples=5, initial_state=rest + kick, rtol=1e-10)
    moved = np.array([expm(A * t) @ kick for t in run.time]).T
    labels = [signal.name for signal in rotor.outputs]
    wanted = (C @ moved)[labels.index("thrust_z")]
    assert_allclose(run["thrust_z"], wanted, atol=1e-9 * np.abs(wanted).max())
    assert {"thrust_vz", "left_moment_y", "right_force_x"} <= set(run.signals)


def test_a_thrust_bearing_on_a_gyroscopic_shaft_is_the_hand_calculation():
    """A rigid disk on a collar: z swings alone, and tilts precess by I s^2 -+ i G s + k + c s = 0."""
    inertia, gyroscopic, m = 0.08, 0.14 * SPEED, 12.0
    rotor = rf.RigidShaft(
        mass=m,
        diametral_inertia=inertia,
        polar_inertia=0.14,
        stations=(("", 0.0),),
        speed=SPEED,
        gravity=(0.0, 0.0),
        axial=True,
        feels_tilt=True,
    )
    collar = rf.Parallel((THRUST, rf.LinearBearing(stiffness=1e7, damping=100.0)))
    A = mount(rotor, {"": collar}).linearization(0.0, np.zeros(10), []).A
    k, c = THRUST.stiffness, THRUST.damping
    wanted = [
        *np.roots([m, c[0], k[0]]),
        *np.roots([inertia, c[1] - 1j * gyroscopic, k[1]]),
        *np.roots([inertia, c[1] + 1j * gyroscopic, k[1]]),
        *np.roots([m, 100.0, 1e7]),
        *np.roots([m, 100.0, 1e7]),
    ]
    poles = np.linalg.eigvals(A)
    for value in wanted:
        assert np.abs(poles - value).min() < 1e-9 * abs(value)
    values = rotor_modes(rotor, {"": collar}, SPEED).eigenvalues
    for value in values:
        assert min(abs(value - one) for one in wanted) < 1e-8 * abs(value)
    assert len(values) == 5


def fmu_outputs(model, path, state, version="2.0"):
    """Return the outputs of an FMU of a model without time, at one input."""
    file = rf.export_fmu(model, path, version, component="own", stop_time=1e-3)
    start = {f"own.{signal.name}": value for signal, value in zip(model.inputs, state, strict=True)}
    wanted = [f"own.{signal.name}" for signal in model.outputs]
    found = fmpy.simulate_fmu(
        str(file), start_values=start, output=wanted, stop_time=1e-3, output_interval=1e-3
    )
    return [found[name][0] for name in wanted]


@pytest.mark.parametrize("model", [THRUST, STRIPS], ids=["thrust", "strips"])
def test_an_fmu_has_the_freedoms_of_a_reaction(model, tmp_path):
    state = np.array([signal.nominal for signal in model.inputs]) * 0.3
    found = fmu_outputs(model, tmp_path / "own.fmu", state)
    assert_allclose(found, model.output(0.0, [], state), rtol=1e-12)


@pytest.mark.parametrize("version", ["2.0", "3.0"])
def test_a_linear_thrust_bearing_is_a_native_fmu(version, tmp_path):
    model = rf.LinearBearing(
        stiffness=THRUST.stiffness, damping=THRUST.damping, freedoms=("z", "tilt_x", "tilt_y")
    )
    state = np.array([signal.nominal for signal in model.inputs]) * 0.3
    found = fmu_outputs(model, tmp_path / "own.fmu", state, version)
    assert_allclose(found, THRUST.output(0.0, [], state), rtol=1e-14)


def test_a_rotor_on_states_of_a_users_own_is_an_fmu(tmp_path):
    rotor = RigidRotor(mass=30.0, speed=SPEED, unbalance=1e-4)
    whole = mount(rotor, {"": RUBBER})
    file = rf.export_fmu(whole, tmp_path / "whole.fmu", component="rotor", stop_time=5e-3, step_size=1e-3)
    found = fmpy.simulate_fmu(str(file), output=["rotor.x", "rotor.y"])
    run = simulate(rotor, RUBBER, duration=5e-3, samples=2, rtol=1e-10)
    assert_allclose([found["rotor.x"][-1], found["rotor.y"][-1]], [run["x"][-1], run["y"][-1]], rtol=1e-6)


BALLS = rf.back_to_back(
    rf.BallBearing(
        balls=10, ball_diameter=7.938e-3, pitch_diameter=33.5e-3, contact_angle=0.4363, damping=300.0
    ),
    distance=0.02,
    preload=150.0,
)


def test_balls_with_five_freedoms_hold_a_flexible_shaft(tmp_path):
    """One pair holds the shaft along its axis and against tilts, in time, in an FMU and in python-control."""
    held = rf.MomentCarryingBalls(bearing=BALLS, freedoms=rf.bearings.rolling.BALL_FREEDOMS)
    rotor = shaft(
        stations=(rf.Station(node=0, name="left", feels_tilt=True), rf.Station(node=4, name="right"))
    )
    bearings = {"left": held, "right": rf.LinearBearing(stiffness=2e7, damping=300.0)}
    at, rest, (A, *_) = joined(rotor, bearings)
    poles = np.linalg.eigvals(A)
    for value in rotor_modes(rotor, bearings, SPEED).eigenvalues:
        assert np.abs(poles - value).min() < 1e-8 * abs(value)
    assert_allclose(np.sort_complex(rotor_system(rotor, at).poles()), np.sort_complex(poles), rtol=1e-7)
    start = rest.copy()
    start[[signal.name for signal in rotor.states].index("vz_0")] += 1e-5
    run = simulate(rotor, bearings, duration=5e-4, samples=3, initial_state=start, rtol=1e-9)
    moved = [
        (expm(A * t) @ (start - rest) + rest)[[s.name for s in rotor.states].index("z_0")] for t in run.time
    ]
    assert_allclose(run["left_z"], moved, atol=1e-4 * np.ptp(moved))
    whole = mount(replace(rotor, initial=tuple(start)), bearings)
    file = rf.export_fmu(whole, tmp_path / "whole.fmu", component="rotor", stop_time=5e-4, step_size=2.5e-4)
    with warnings.catch_warnings(action="ignore"):  # trial states of its integrator press the balls too hard
        found = fmpy.simulate_fmu(str(file), output=["rotor.left_z"], output_interval=2.5e-4, stop_time=5e-4)
    assert_allclose(found["rotor.left_z"][-1], run["left_z"][-1], rtol=1e-5)


def test_what_a_planar_analysis_cannot_take_is_refused():
    disk = rf.RigidShaft(
        mass=12.0,
        diametral_inertia=0.08,
        polar_inertia=0.14,
        stations=(("", 0.0),),
        speed=SPEED,
        axial=True,
        feels_tilt=True,
    )
    film = replace(STRIPS.film, length=0.02)
    with pytest.raises(
        InputError, match=r"film must react to x and y alone in a co-simulation, got .*force_z"
    ):
        rf.cosimulate(disk, rf.Parallel((film, THRUST)), duration=1e-3, macro_step=1e-5)
    with pytest.raises(
        InputError, match="coefficients must be those of x and y, got those of z, tilt_x, tilt_y"
    ):
        rf.critical_mass(coefficients(THRUST, np.zeros(3), SPEED))

    class Crossed(ThrustSpring):
        freedoms = ("tilt_x", "z", "tilt_y")

    with pytest.raises(InputError, match=r"freedoms of reaction must be some of .* in this order"):
        equilibrium(Crossed(), np.zeros(3), SPEED)


def test_no_place_is_an_equilibrium_that_is_none():
    pushing = rf.as_reaction(lambda z, vz, speed: (5.0,), clearance=1e-4, freedoms=("z",))
    with pytest.raises(rf.EquilibriumError, match="the least imbalance found is"):
        equilibrium(pushing, [0.0], SPEED)
    weak = rf.as_reaction(lambda z, *_: (-1e6 * z,), clearance=1e-4, freedoms=("z",))
    assert equilibrium(weak, [50.0], SPEED).position == pytest.approx([5e-5], rel=1e-9)
    with pytest.warns(rf.ValidityWarning, match="statically unstable"):
        equilibrium(rf.LinearBearing(stiffness=(-1e6,), freedoms=("z",)), [1.0], SPEED)


def test_states_that_grow_by_themselves_are_counted():
    one = np.eye(2)
    growing = rf.FrequencyDependentReaction(A=40.0 * one, B=one, C=1e9 * one, D=-1e8 * one, damping=1e4 * one)
    rotor = rf.JeffcottRotor(mass=20.0, journal_mass=2.0, stiffness=2e7, speed=SPEED)
    A = mount(rotor, {"": growing}).linearization(0.0, np.zeros(10), []).A
    assert np.linalg.eigvals(A).real.max() > 10.0
    found = rotor_threshold(rotor, {"": growing}, np.linspace(100.0, 400.0, 4))
    assert found.speed is None
    assert "unstable" in found.reason


def test_a_pair_that_only_roundoff_makes_complex_is_two_real_motions():
    """A real eigenvalue that is there twice, as LAPACK may return it."""
    turn = np.linalg.qr(np.arange(16.0).reshape(4, 4) ** 0.5)[0]
    whirl = np.array([[1.0, -3.0], [3.0, 1.0]])
    matrix = turn @ np.block([[40.0 * np.eye(2), np.zeros((2, 2))], [np.zeros((2, 2)), whirl]]) @ turn.T
    values = np.array([40.0 + 1e-13j, 40.0 - 1e-13j, 1.0 + 3.0j, 1.0 - 3.0j])
    first, second = turn[:, 0] + 1j * turn[:, 1], turn[:, 2] - 1j * turn[:, 3]
    found, vectors = parted_pairs(values, np.array([first, first.conj(), second, second.conj()]).T)
    assert found.imag.tolist() == [0.0, 0.0, 3.0, -3.0]
    assert_allclose(matrix @ vectors, vectors * found, atol=1e-12)
    assert np.linalg.matrix_rank(vectors) == 4
    # Parts that are nearly parallel are those of one vector: the pair stays.
    near = turn[:, :1] + 1j * (0.3 * turn[:, :1] + 1e-9 * turn[:, 1:2])
    kept, same = parted_pairs(values[:2], np.hstack([near, near.conj()]))
    assert kept.tolist() == values[:2].tolist()
    assert same.tolist() == np.hstack([near, near.conj()]).tolist()


def test_films_are_told_from_balls_springs_and_series():
    plain = rf.JournalBearing(radius=0.05, length=0.03, clearance=1e-4, viscosity=0.02)
    warm = replace(
        plain, viscosity=None, oil=rf.Oil.iso_vg(46), cooling=rf.Cooling(supply_temperature=318.15)
    )
    damper = rf.SqueezeFilmDamper(radius=0.06, length=0.03, clearance=1e-4, viscosity=0.01)
    fed = rf.JFOFilm(bearing=replace(plain, grooves=(rf.Groove(center=1.5, width=0.3),)))
    balls = rf.BallBearing(balls=9, ball_diameter=12e-3, pitch_diameter=65e-3, contact_angle=0.4)
    films = (plain, warm, warm.in_time(), fed, damper, rf.with_springs(damper, 1e6))
    others = (
        balls,
        rf.back_to_back(balls, distance=0.05, preload=100.0),
        rf.LinearBearing(stiffness=1e6),
        Series(outer=rf.LinearBearing(stiffness=1e6), body=Body(mass=1.0), inner=plain),
    )
    assert all(map(has_film, films))
    assert not any(map(has_film, others))


def test_whirl_of_an_isotropic_rotor_is_there_twice():
    """Without gyroscopic effect forward and backward whirl have one exponent and two shapes."""
    rotor = rf.JeffcottRotor(mass=20.0, journal_mass=2.0, stiffness=2e7, speed=SPEED)
    found = rotor_modes(rotor, {"": RUBBER}, SPEED).eigenvalues
    poles = np.linalg.eigvals(mount(rotor, {"": RUBBER}).linearization(0.0, np.zeros(10), []).A)
    assert_allclose(np.sort_complex(found), np.sort_complex(poles[poles.imag > 1.0]), rtol=1e-8)
    assert len(found) == 4


class Creeping(Rubber):
    """Rubber whose creep drifts: its force, and so its coefficients, hold it where it begins."""

    def force(self, position, velocity, speed):
        return self.output(0.0, self.initial_state, [*position, *velocity, speed])

    def jacobian(self, position, velocity, speed):
        return self.linearization(0.0, self.initial_state, [*position, *velocity, speed]).D

    def rest_state(self, position, speed):
        return self.initial_state


def test_states_that_drift_follow_where_a_frequency_is_named_only():
    one, place = Creeping(), np.zeros(2)
    assert coefficients(one, place, SPEED).stiffness[0, 0] == one.stiffness + one.maxwell
    whole = one.stiffness_at(1j * SPEED)
    named = coefficients(one, place, SPEED, frequency=SPEED)
    assert named.stiffness[0, 0] == pytest.approx(whole.real, rel=1e-12)
    rotor = shaft(axial=False, gravity=(0.0, 0.0))
    held = cross_coupled(rotor, {"left": one, "right": one}, SPEED, {2: 1.0}).at.coefficients["left"]
    assert held.stiffness[0, 0] == one.stiffness + one.maxwell


def test_motion_that_is_faster_than_a_model_is_warned_of():
    one, none = np.eye(2), np.zeros((2, 2))
    fitted = rf.FrequencyDependentReaction(
        A=-one, B=one, C=one, D=-1e6 * one, damping=none, band=(10.0, 100.0)
    )
    at = equilibrium(fitted, (0.0, -10.0), 50.0)
    assert dynamic_stiffness(fitted, at, 50j)[0, 0].real == pytest.approx(1e6, rel=1e-3)
    with pytest.warns(rf.ValidityWarning, match="frequency"):
        dynamic_stiffness(fitted, at, 300j)
