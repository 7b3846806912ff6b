"""Linear reactions with states: K(s) is that of their system, fits that of their tables, motion both."""

from dataclasses import replace

import control
import fmpy
import numpy as np
import pytest
from scipy.linalg import block_diag, expm

from rotorfilm import (
    ConvergenceError,
    Disk,
    ElasticMaterial,
    Equilibrium,
    FrequencyDependentReaction as Reaction,
    InputError,
    JeffcottRotor,
    OperatingPoint,
    RigidRotor,
    ShaftElement,
    ShaftRotor,
    Station,
    ValidityWarning,
    coefficients,
    export_fmu,
    linearize,
    mount,
    rotor_equilibrium,
    rotor_modes,
    simulate,
)
from rotorfilm.core.dynamic_stiffness import quasi_static, rest_state, rigid_exponents, small_motion
from rotorfilm.core.port import mass_of
from rotorfilm.core.signals import FREEDOMS, force_names, names, place_names

RNG = np.random.default_rng(37)
DIAGONAL = np.diag([-80.0, -300.0, -1500.0])
SYSTEM = control.ss(
    DIAGONAL + 200.0 * np.array([[0.0, 1.0, 0.0], [-1.0, 0.0, 2.0], [0.0, -2.0, 0.0]]),
    RNG.normal(size=(3, 2)),
    2e8 * RNG.normal(size=(2, 3)),
    -2e6 * np.eye(2) + 3e5 * RNG.normal(size=(2, 2)),
)
SEAL = Reaction.from_system(SYSTEM)
CENTER = np.zeros(2)
EXPONENTS = [0j, 3.0j, -20.0 + 700.0j, 5e3j, 40.0 + 0j]


def response(reaction, s, speed=0.0):
    n = len(reaction.freedoms)
    return small_motion(reaction, np.zeros(n), speed)(s)[0]


@pytest.mark.parametrize("s", EXPONENTS)
def test_the_dynamic_stiffness_is_that_of_the_system(s):
    exact = -SYSTEM(s)
    assert response(SEAL, s) == pytest.approx(exact, rel=1e-12, abs=1e-12 * np.abs(exact).max())


@pytest.mark.parametrize("freedoms", [("z",), ("x", "y", "z", "tilt_x", "tilt_y"), ("z", "tilt_x", "twist")])
def test_any_motions_of_the_shaft(freedoms):
    n = len(freedoms)
    system = control.ss(-np.diag([10.0, 90.0]), RNG.normal(size=(2, n)), RNG.normal(size=(n, 2)), np.eye(n))
    reaction = Reaction.from_system(system, freedoms)
    assert names(reaction.inputs) == [*place_names(freedoms), "speed"]
    assert names(reaction.outputs) == force_names(freedoms)
    assert [s.unit for s in reaction.outputs] == ["N.m" if FREEDOMS[f].turns else "N" for f in freedoms]
    assert response(reaction, 50j) == pytest.approx(-np.reshape(system(50j), (n, n)), rel=1e-12)


def test_linearize_gives_back_the_system():
    at = Equilibrium(
        position=np.array([2e-5, -1e-5]),
        speed=300.0,
        load=np.array([0.0, -1.0]),
        eccentricity_ratio=0.0,
        attitude_angle=0.0,
        minimum_film=np.inf,
        residual=0.0,
        iterations=0,
        reaction=SEAL,
    )
    point = OperatingPoint(x=rest_state(SEAL, at.position, 300.0), u=[2e-5, -1e-5, 0.0, 0.0, 300.0])
    for found in (linearize(SEAL, at), linearize(SEAL, point)):
        for name, whole in (("A", found.A), ("B", found.B[:, :2]), ("C", found.C), ("D", found.D[:, :2])):
            assert whole == pytest.approx(getattr(SYSTEM, name), rel=1e-14)
        assert not found.B[:, 2:].any()
        assert not found.D[:, 2:].any()


def test_states_at_rest_and_their_names():
    q = np.array([3e-5, -2e-5])
    x = rest_state(SEAL, q, 0.0)
    assert SYSTEM.A @ x + SYSTEM.B @ q == pytest.approx(0.0, abs=1e-14 * np.abs(SYSTEM.B @ q).max())
    assert quasi_static(SEAL).force(q, CENTER, 0.0) == pytest.approx(SYSTEM(0.0).real @ q, rel=1e-12)
    assert SEAL.initial_state.tolist() == [0.0, 0.0, 0.0]
    assert names(SEAL.states) == ["state_0", "state_1", "state_2"]
    named = control.ss(SYSTEM, states=["lag", "lead", "filter"])
    assert names(Reaction.from_system(named).states) == ["lag", "lead", "filter"]
    taken = control.ss(SYSTEM, states=["x", "lead", "filter"])
    assert names(Reaction.from_system(taken).states)[0] == "state_0"


def test_a_complex_system_is_the_real_one_of_both_directions():
    """Equation (1) of complex notation: Z(i w) = K + c w + i (w C - k) for both signs of w."""
    A, B, C, D = (
        [[-500.0 + 60.0j, 30.0], [5.0j, -90.0 - 8.0j]],
        [[1.0], [2.0j]],
        [[4e8, -1e8j]],
        [[-2e6 + 1e5j]],
    )
    seal, w = Reaction.from_isotropic(A, B, C, D), 400.0

    def Z(s):
        return complex((-np.array(C) @ np.linalg.solve(s * np.eye(2) - np.array(A), B) - np.array(D))[0, 0])

    whole = response(seal, 1j * w)
    K, cross, damping, gyration = (
        whole[0, 0].real,
        whole[0, 1].real,
        whole[0, 0].imag / w,
        whole[0, 1].imag / w,
    )
    assert [whole[1, 1], whole[1, 0]] == pytest.approx([whole[0, 0], -whole[0, 1]], rel=1e-12)
    for sign in (1.0, -1.0):
        expected = K + sign * gyration * w + 1j * (sign * damping * w - cross)
        assert Z(sign * 1j * w) == pytest.approx(expected, rel=1e-12)


# An active magnetic bearing: two magnets of 100 turns for each axis, with a PID controller.


K_I, K_S, MASS = 55.7271005, 334362.603126, 20.0


def magnet(derivative, integral=2e4, proportional=12000.0):
    """Return the magnets of both axes with sensor, controller and amplifier, minus the open stiffness."""
    s = control.tf("s")

    def lag(frequency):
        return 1.0 / (1.0 + s / (2.0 * np.pi * frequency))

    law = proportional + derivative * s * lag(4000.0) + integral / s
    one = control.ss(-K_I * lag(1500.0) * law * lag(5000.0))
    both = control.append(one, one)
    return Reaction.from_system(control.ss(both.A, both.B, both.C, both.D + K_S * np.eye(2)))


@pytest.mark.parametrize(("derivative", "pole"), [(92.8084, -3.52078), (46.4042, -3.41979)])
def test_the_slowest_pole_of_a_magnetic_bearing(derivative, pole):
    found = rigid_exponents(magnet(derivative), CENTER, 0.0, MASS)
    assert found[:2].real == pytest.approx(pole, abs=5e-6)
    assert found[0].imag == pytest.approx(0.0, abs=1e-6)


def test_the_stiffness_of_a_magnetic_bearing_at_50_hz():
    Z = response(magnet(92.8084), 100j * np.pi)
    assert [Z[0, 0], Z[1, 1]] == pytest.approx(2 * [423765.55 + 1588690.04j], rel=1e-6)  # D has six digits


def test_a_controller_that_integrates_holds_the_shaft_at_its_place():
    bearing = magnet(92.8084)
    static = quasi_static(bearing)
    load = np.array([0.0, -9.80665 * MASS])
    place = np.linalg.solve(static.jacobian(CENTER, CENTER, 0.0)[:, :2], -load)
    dynamic = load[1] / response(bearing, 100j)[0, 0].real
    assert 0.0 < place[1] / dynamic < 1e-4
    x = rest_state(bearing, place, 0.0)
    assert bearing.output(0.0, x, [*place, 0.0, 0.0, 0.0]) == pytest.approx(-load, rel=1e-6)
    run = simulate(RigidRotor(mass=MASS, speed=100.0), bearing, duration=2.5, samples=2)
    assert run["y"][-1] == pytest.approx(0.0, abs=1e-3 * 9.80665 * MASS / 423765.0)


def test_a_stiffness_that_is_infinite_is_named():
    with pytest.raises(InputError, match=r"frequency must be above 0: .* integrates"):
        coefficients(magnet(92.8084), CENTER, 0.0)


def test_a_flexible_shaft_rests_in_magnets_that_integrate():
    rotor = JeffcottRotor(mass=15.0, journal_mass=5.0, stiffness=3e6, speed=100.0, internal_damping=100.0)
    bearing = magnet(92.8084)
    at = rotor_equilibrium(rotor, {"": bearing}, 100.0)
    assert abs(at.coefficients[""].position[1]) < 1e-8
    assert at.loads[""] == pytest.approx([0.0, -20.0 * 9.80665], rel=1e-9)
    whole = mount(rotor, {"": bearing})
    poles = np.linalg.eigvals(whole.linearization(0.0, whole.initial_state, ()).A)
    for value in rotor_modes(rotor, {"": bearing}, 100.0).eigenvalues:
        assert np.abs(poles - value).min() < 1e-6 * abs(value)


# Over time and in an FMU.


def joined(reaction, mass):
    """Return A of a rigid mass on a reaction, its states last."""
    A, B, C, D = reaction.linearization(0.0, reaction.initial_state, np.zeros(5))
    M = mass * np.eye(2) + mass_of(reaction, CENTER, CENTER, 0.0)
    push = np.linalg.solve(M, np.hstack([D[:2, :4], C[:2]]))
    return np.vstack([np.eye(2, 4 + len(A), 2), push, np.hstack([B[:, :4], A])])


HEAVY = replace(SEAL, damping=[[400.0, 90.0], [-80.0, 500.0]], added_mass=[[3.0, 0.5], [0.5, 2.0]])


@pytest.mark.parametrize("reaction", [SEAL, HEAVY], ids=["plain", "damping and mass"])
def test_motion_is_the_exponential_of_the_joined_system(reaction):
    rotor = RigidRotor(
        mass=MASS, speed=100.0, gravity=(0.0, 0.0), position=(1e-5, -2e-5), velocity=(1e-3, 5e-4)
    )
    run = simulate(rotor, reaction, duration=0.02, samples=9, rtol=1e-10)
    A = joined(reaction, MASS)
    states = np.array([expm(t * A) @ np.array([*rotor.initial_state, 0.0, 0.0, 0.0]) for t in run.time])
    for name, row in zip(["x", "y", "vx", "vy", *names(reaction.states)], states.T, strict=True):
        assert run[name] == pytest.approx(row, abs=1e-7 * np.abs(row).max()), name


def test_without_states_it_is_a_spring_in_compiled_loops():
    spring = Reaction.from_system(control.ss([], [], [], -1e6 * np.eye(2)))
    assert spring.states == ()
    rotor = RigidRotor(mass=4.0, speed=100.0, gravity=(0.0, 0.0), position=(1e-5, 0.0))
    run = simulate(rotor, spring, duration=0.02, samples=5, rtol=1e-10)
    assert run["x"] == pytest.approx(1e-5 * np.cos(500.0 * run.time), abs=1e-11)


@pytest.mark.parametrize("reaction", [SEAL, HEAVY], ids=["plain", "damping and mass"])
def test_an_fmu_has_the_same_motion(reaction, tmp_path):
    start = {"x": 2e-5, "vy": 1e-3}
    path = export_fmu(reaction, tmp_path / "seal.fmu", component="seal", start=start, backend="python")
    told = fmpy.simulate_fmu(str(path), stop_time=0.01, output_interval=2e-3, step_size=2e-3)
    A, B, C, D = reaction.linearization(0.0, reaction.initial_state, np.zeros(5))
    u = np.array([2e-5, 0.0, 0.0, 1e-3, 0.0])
    whole = block_diag(A, 0.0)
    whole[:3, 3] = B @ u
    mass = [3.0, 0.5, 2.0] if reaction.has_inertia else []
    for row in told:
        x = (expm(row["time"] * whole) @ [0.0, 0.0, 0.0, 1.0])[:3]
        y = (C @ x + D @ u)[:2]
        found = [row[f"seal.{name}"] for name in names(reaction.outputs)]
        assert found == pytest.approx([*y, *mass], rel=1e-7, abs=1e-7 * np.abs(y).max())


# Over the speed.


def at_speed(speed):
    turn = speed * np.array([[0.0, -0.4, 0.0], [0.4, 0.0, 0.1], [0.0, -0.1, 0.0]])
    return control.ss(SYSTEM.A + turn, SYSTEM.B, SYSTEM.C * (1.0 + 1e-6 * speed**2), SYSTEM.D)


SPEEDS = [0.0, 100.0, 250.0, 400.0]
TURNING = Reaction.from_system([at_speed(w) for w in SPEEDS], speeds=SPEEDS)


def test_at_speeds_of_the_table_it_is_the_system_there():
    for speed in SPEEDS:
        exact = -at_speed(speed)(200j)
        assert response(TURNING, 200j, speed) == pytest.approx(exact, rel=1e-12)
    # Entries that are linear in the speed are followed exactly; the others by a monotone cubic.
    between = TURNING.linearization(0.0, np.zeros(3), [0.0, 0.0, 0.0, 0.0, 180.0])
    assert pytest.approx(at_speed(180.0).A, rel=1e-12) == between.A
    assert pytest.approx(at_speed(180.0).C, rel=1e-2) == between.C


def test_the_derivative_by_the_speed_is_exact():
    x, u, h = 1e-8 * np.array([1.0, -2.0, 3.0]), np.array([2e-5, -1e-5, 0.0, 0.0, 180.0]), 0.5
    at = TURNING.linearization(0.0, x, u)

    def moved(step):
        v = u + step * np.eye(5)[4]
        return np.concatenate([TURNING.derivative(0.0, x, v), TURNING.output(0.0, x, v)])

    slope = (8.0 * (moved(h) - moved(-h)) - (moved(2.0 * h) - moved(-2.0 * h))) / (12.0 * h)
    assert np.concatenate([at.B[:, 4], at.D[:, 4]]) == pytest.approx(slope, rel=1e-8)
    assert at.D[:, 4].any()


def test_one_that_is_tied_to_speeds_has_no_kernel_that_would_answer_at_others():
    single = Reaction.from_system([at_speed(SPEEDS[0])], speeds=SPEEDS[:1])
    assert SEAL.native().kernel == "linear"
    assert single.native() is None
    assert TURNING.native() is None


def test_beyond_the_speeds_of_the_table_it_refuses():
    with pytest.raises(InputError, match=r"speed must be within the table, 0 to 400 rad/s, got 500"):
        TURNING.derivative(0.0, np.zeros(3), [0.0, 0.0, 0.0, 0.0, 500.0])
    single = Reaction.from_system([SYSTEM], speeds=[100.0])
    assert response(single, 3j, 100.0) == pytest.approx(-SYSTEM(3j), rel=1e-12)
    with pytest.raises(InputError, match="speed must be within the table"):
        response(single, 3j, 101.0)


# From a table over frequency.


W = np.linspace(5.0, 2000.0, 60)


def table(Z, w=W, mass=None):
    """Return frequencies, K, C and M of Z over s, with all of the inertia in the given mass."""
    values = np.array([Z(1j * one) for one in w])
    if mass is None:
        return w, values.real, values.imag / w[:, None, None]
    return (
        w,
        (values + w[:, None, None] ** 2 * mass).real,
        values.imag / w[:, None, None],
        np.array([mass] * len(w)),
    )


def rational(s):
    poles, sizes = [-300.0, -90.0 + 800.0j, -90.0 - 800.0j], [1.0, 0.6 + 0.3j, 0.6 - 0.3j]
    shape = np.array([[1.0, 0.4], [-0.2, 0.8]])
    return (
        1e6 * np.eye(2)
        + s * 300.0 * shape
        + sum(3e8 * c * shape / (s - p) for p, c in zip(poles, sizes, strict=True))
    )


def test_a_rational_table_is_found_again():
    reaction = Reaction.from_table(*table(rational), tolerance=1e-10)
    assert reaction.error < 1e-10
    assert len(reaction.states) == 6  # three poles with residues of full rank
    assert reaction.band == (W[0], W[-1])
    for s in (7j, 1234j, -30.0 + 500.0j, 6000j):
        exact = rational(s)
        assert response(reaction, s) == pytest.approx(exact, abs=1e-10 * np.abs(exact).max())
    assert np.linalg.eigvals(reaction.A).real.max() < 0.0


def test_an_isotropic_pole_takes_two_states():
    seal = Reaction.from_isotropic([[-500.0 + 60.0j]], [[1.0]], [[4e8 + 1e8j]], [[-2e6]])
    again = Reaction.from_table(*table(lambda s: response(seal, s)), tolerance=1e-10)
    assert len(again.states) == 2
    assert response(again, 321j) == pytest.approx(response(seal, 321j), rel=1e-9)


def test_an_added_mass_of_a_table_is_that_of_the_reaction():
    mass = np.array([[4.0, 1.0], [1.0, 6.0]])
    reaction = Reaction.from_table(*table(lambda s: rational(s) + s**2 * mass, mass=mass), tolerance=1e-9)
    assert reaction.has_inertia
    assert reaction.mass(CENTER, CENTER, 0.0) == pytest.approx(mass, rel=1e-7)
    assert reaction.mass(np.zeros((2, 7)), np.zeros((2, 7)), 0.0).shape == (2, 2, 7)
    assert not reaction.mass_slopes(CENTER, CENTER, 0.0).any()
    assert names(reaction.outputs)[2:] == ["mass_xx", "mass_xy", "mass_yy"]
    assert response(reaction, 700j) == pytest.approx(rational(700j), rel=1e-6)


def test_a_mass_that_is_not_symmetric_is_fitted_by_fractions_within_the_tolerance():
    w, mass = np.linspace(10.0, 1000.0, 40), np.array([[30.0, 20.0], [-20.0, 30.0]])
    flat = [np.repeat(one[None], 40, 0) for one in (2e7 * np.eye(2), 900.0 * np.eye(2), mass)]
    reaction = Reaction.from_table(w, *flat, tolerance=1e-3)
    assert reaction.error <= 1e-3
    for s in (55j, 700j):
        Z = 2e7 * np.eye(2) + s * 900.0 * np.eye(2) + s**2 * mass
        assert response(reaction, s) + s**2 * reaction.mass(CENTER, CENTER) == pytest.approx(Z, abs=4e4)
    with pytest.raises(ConvergenceError, match=r"tolerance must be within reach of .* got 1e-15: the least"):
        Reaction.from_table(w, *flat, tolerance=1e-15)


def delayed(s):
    return 1e6 * np.exp(-1e-4 * s) * np.eye(1)


def test_the_fit_of_a_delay_converges_over_poles():
    """At least as fast as Pade blocks of the same order: 2e-2, 1e-4, 4e-7, 6e-10 at 1 kHz and 100 us."""
    w = 2.0 * np.pi * np.linspace(5.0, 1000.0, 81)
    made = [Reaction.from_table(*table(delayed, w), poles=n, freedoms=("z",)) for n in range(1, 5)]
    assert all(one.error < bound for one, bound in zip(made, [2e-2, 1e-4, 4e-7, 6e-10], strict=True))
    between = 2.0 * np.pi * 1j * np.array([33.0, 501.0, 987.0])
    for one in made:
        errors = [abs(response(one, s)[0, 0] - delayed(s)[0, 0]) / 1e6 for s in between]
        assert max(errors) <= 1.01 * one.error + 1e-14
    chosen = Reaction.from_table(*table(delayed, w), tolerance=1e-5, freedoms=("z",))
    assert len(chosen.states) == 2


def test_every_pole_of_a_fit_decays():
    """Data of a pole that grows are fitted by one that decays, and the error says so."""

    def growing(s):
        return 1e6 * np.eye(1) + 4e8 * np.eye(1) / (s - 200.0)

    found = Reaction.from_table(*table(growing), poles=1, freedoms=("z",))
    assert np.linalg.eigvals(found.A).real.max() < 0.0
    assert found.error > 0.1


def test_noise_sets_the_number_of_poles():
    """With noise of 1 % a fit is no better than that, and more poles follow the noise."""
    w, K, C = table(lambda s: response(SEAL, s))
    clean = K + 1j * w[:, None, None] * C
    noise = 0.01 * np.abs(clean).max() / np.sqrt(2.0)
    noisy = clean + noise * (RNG.normal(size=clean.shape) + 1j * RNG.normal(size=clean.shape))
    made = [Reaction.from_table(w, noisy.real, noisy.imag / w[:, None, None], poles=n) for n in (3, 12)]
    few, many = (
        max(np.abs(response(one, 1j * nu) - Z).max() for nu, Z in zip(w, clean, strict=True))
        / np.abs(clean).max()
        for one in made
    )
    assert few < 0.015 < made[0].error < 0.05
    assert many > few


def test_units_of_tilts_do_not_matter_to_the_fit():
    """Places in meters or millimeters: entries of one kind are counted over the largest of that kind."""
    freedoms, scale = ("x", "tilt_y"), np.diag([1.0, 1e3])
    w, K, C = table(rational)
    one = Reaction.from_table(w, K, C, poles=2, freedoms=freedoms)
    other = Reaction.from_table(w, scale @ K @ scale, scale @ C @ scale, poles=2, freedoms=freedoms)
    assert other.error == pytest.approx(one.error, rel=1e-6)
    assert response(other, 200j) == pytest.approx(scale @ response(one, 200j) @ scale, rel=1e-6)


def test_motion_beyond_the_band_is_warned_of():
    reaction = Reaction.from_table(*table(rational))
    reaction.require_range(W[-1])
    for frequency in (1.0, 2500.0):
        with pytest.warns(ValidityWarning, match=r"frequency should be 5 to 2000 rad/s, .*, got"):
            reaction.require_range(frequency)
    SEAL.require_range(1e9)


# What is refused.


K3 = np.zeros((3, 2, 2))
WRONG = [
    (lambda: replace(SEAL, A=np.zeros((2, 3))), r"A must have shape \(3, 3\), got \(2, 3\)"),
    (lambda: replace(SEAL, B=np.zeros((3, 1))), r"B must have shape \(3, 2\), got \(3, 1\)"),
    (lambda: replace(SEAL, D=np.full((2, 2), np.nan)), "D must be finite"),
    (lambda: replace(SEAL, damping=1.0), r"damping must have shape \(2, 2\), got \(\)"),
    (lambda: replace(SEAL, added_mass=[[1.0, 2.0], [0.0, 1.0]]), "added_mass must be symmetric"),
    (lambda: replace(SEAL, state_names=("a",)), "state_names must be empty or 3 names"),
    (lambda: replace(SEAL, state_names=("a", "b", "a")), "state_names must differ from each other"),
    (lambda: replace(SEAL, state_names=("a", "vx", "c")), "state_names must differ .* of motions and forces"),
    (lambda: replace(SEAL, state_names=("a", "b", "force_y")), "state_names must differ .* got .*force_y"),
    (lambda: replace(SEAL, band=(5.0, 5.0)), "band must be a list of rising numbers"),
    (lambda: replace(SEAL, speeds=[2.0, 1.0]), "speeds must be a list of rising numbers"),
    (lambda: replace(SEAL, freedoms=("y", "x")), "freedoms must be some of"),
    (lambda: Reaction.from_system(SYSTEM, ("z",)), r"must have 1 inputs and 1 outputs for .* z"),
    (lambda: Reaction.from_system(control.tf("s")), "a control.StateSpace, which has no more zeros than"),
    (lambda: Reaction.from_system(control.c2d(SYSTEM, 1e-3)), "must be in continuous time"),
    (lambda: Reaction.from_system([SYSTEM, SYSTEM], speeds=[1.0]), "one for each of the speeds"),
    (lambda: Reaction.from_system(SYSTEM, speeds=[1.0]), "one for each of the speeds"),
    (
        lambda: Reaction.from_system([SYSTEM, control.ss([], [], [], np.eye(2))], speeds=[1.0, 2.0]),
        r"system must have one size, got \[3, 0\] states",
    ),
    (
        lambda: Reaction.from_system(control.ss(SYSTEM, inputs=["y", "x"])),
        r"must have its signals in the order \['x', 'y'\]",
    ),
    (lambda: Reaction.from_isotropic(1.0, [[1.0]], [[1.0]], [[1.0]]), "A must be a matrix"),
    (lambda: Reaction.from_table([0.0, 1.0, 2.0], K3, K3), r"frequencies\[0\] must be finite"),
    (lambda: Reaction.from_table([1.0, 3.0, 2.0], K3, K3), "frequencies must be a list of rising"),
    (lambda: Reaction.from_table([1.0, 2.0], K3, K3), r"stiffness must have shape \(2, 2, 2\)"),
    (lambda: Reaction.from_table([1.0, 2.0, 3.0], K3, K3, K3[:1]), "mass must have shape"),
    (lambda: Reaction.from_table([1.0, 2.0, 3.0], K3, K3, poles=4), "frequencies must be 6 at least"),
    (lambda: Reaction.from_table([1.0, 2.0, 3.0], K3, K3, poles=-1), "poles must be an integer"),
    (lambda: SEAL.output(0.0, [0.0], np.zeros(5)), r"x must have shape \(3,\), got shape \(1,\)"),
    (lambda: SEAL.output(0.0, np.zeros(3), np.zeros(4)), r"u must have shape \(5,\) for x, y, vx, vy, speed"),
]  # fmt: skip


@pytest.mark.parametrize(("make", "said"), WRONG)
def test_what_breaks_a_rule_is_named(make, said):
    with pytest.raises(InputError, match=said):
        make()


def test_a_tolerance_out_of_reach_says_what_is_the_least_error():
    w, K, C = table(rational)
    with pytest.raises(ConvergenceError, match=r"tolerance must be within reach of .* the least error is"):
        Reaction.from_table(w, RNG.normal(size=K.shape), C, tolerance=1e-6)


def test_a_system_that_grows_is_taken_as_it_is():
    grows = control.ss(np.diag([5.0, -10.0]), np.eye(2), np.eye(2), -np.eye(2))
    assert response(Reaction.from_system(grows), 3j) == pytest.approx(-grows(3j), rel=1e-12)


@pytest.mark.parametrize("seed", [12, 17, 30])
def test_whirls_on_random_systems_are_those_of_the_joined_matrix(seed):
    """With seed 12 the search from one exponent of the rotor with K and C of one frequency does not end."""
    rng = np.random.default_rng(seed)
    size = rng.integers(2, 5)
    A = rng.normal(size=(size, size)) * 300.0
    A -= (np.linalg.eigvals(A).real.max() + rng.uniform(20.0, 300.0)) * np.eye(size)
    B, C = rng.normal(size=(size, 2)) * 100.0, rng.normal(size=(2, size)) * 1e6 * rng.uniform(0.1, 3.0)
    bearing = Reaction.from_system(control.ss(A, B, -C, -rng.uniform(5e6, 5e7) * np.eye(2)))
    steel = ElasticMaterial(young_modulus=2.11e11, shear_modulus=8.12e10, density=7810.0)
    shaft = ShaftRotor(
        elements=ShaftElement(length=1.5, outer_diameter=0.05, material=steel).split(6),
        disks=(Disk(node=3, mass=30.0, polar_inertia=0.2, diametral_inertia=0.1),),
        stations=(Station(node=0, name="left"), Station(node=6, name="right")),
        speed=300.0,
    )
    bearings = {"left": bearing, "right": bearing}
    whole = mount(shaft, bearings)
    joined = whole.linearization(0.0, np.zeros(len(whole.states)), np.zeros(len(whole.inputs))).A
    poles = np.linalg.eigvals(joined)
    light = poles[(poles.imag > 0.0) & (-poles.real < 0.3 * abs(poles)) & (abs(poles) < 5e3)]
    found = rotor_modes(shaft, bearings, 300.0).eigenvalues
    assert len(light) > 4
    assert all(np.abs(found - pole).min() < 1e-6 * abs(pole) for pole in light)
    assert all(np.abs(poles - value).min() < 1e-6 * abs(value) for value in found if abs(value) < 5e3)
