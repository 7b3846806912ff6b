"""Reactions side by side, one behind the other with a body between, and beside springs."""

from dataclasses import dataclass, replace

import fmpy
import numpy as np
import pytest
from numpy.testing import assert_allclose
from scipy.linalg import expm

from rotorfilm import (
    BallBearing,
    Cooling,
    EquilibriumError,
    FrequencyDependentReaction,
    FullFilm,
    InputError,
    JournalBearing,
    LinearBearing,
    Linearization,
    Oil,
    Parallel,
    RigidRotor,
    RubRing,
    ShortFilm,
    SqueezeFilmDamper,
    TiltingPadBearing,
    UndefinedDerivativeError,
    ValidityWarning,
    coefficients,
    equilibrium,
    export_fmu,
    mount,
    simulate,
    synchronous_orbits,
    with_springs,
)
from rotorfilm.analysis import dynamic_stiffness
from rotorfilm.analysis.force_calls import film_call
from rotorfilm.bearings import Body, HalfSommerfeld, Series
from rotorfilm.core import force_outputs, journal_inputs, names
from rotorfilm.core.dynamic_stiffness import quasi_static, rest_state, small_motion, states_rest
from rotorfilm.core.port import compiled_force, mass_of, require_range

CENTER, SPEED = np.zeros(2), 300.0
FILM = JournalBearing(radius=0.05, length=0.03, clearance=1e-4, viscosity=0.05, film=ShortFilm())
DAMPER = SqueezeFilmDamper(
    radius=0.06, length=0.02, clearance=1.2e-4, viscosity=0.01, extent=FullFilm(), density=870.0
)
RUPTURED = replace(DAMPER, extent=HalfSommerfeld())
RING = LinearBearing(stiffness=2e7, damping=300.0)
SUPPORT = LinearBearing(stiffness=((5e6, 4e5), (-3e5, 8e6)), damping=((800.0, 50.0), (-20.0, 600.0)))
SEAL = FrequencyDependentReaction(
    A=[[-400.0, 150.0], [-90.0, -700.0]],
    B=[[1.0, 0.5], [-0.4, 1.0]],
    C=[[2e9, -1e9], [1e9, 3e9]],
    D=[[-2e7, 4e6], [-5e6, -2e7]],
    damping=[[900.0, 0.0], [50.0, 700.0]],
)


@dataclass(frozen=True)
class Springs:
    """Springs and dampers along any freedoms."""

    freedoms: tuple
    stiffness: tuple
    damping: tuple = (0.0, 0.0, 0.0, 0.0, 0.0)

    states = ()

    @property
    def inputs(self):
        return journal_inputs(1e-4, 100.0, self.freedoms, arm=0.1)

    @property
    def outputs(self):
        return force_outputs(100.0, self.freedoms, arm=0.1)

    def output(self, t, x, u):
        return self.linearization(t, x, u).D @ u

    def linearization(self, t, x, u):
        n = len(self.freedoms)
        D = np.hstack([-np.diag(self.stiffness[:n]), -np.diag(self.damping[:n]), np.zeros((n, 1))])
        return Linearization(np.zeros((0, 0)), np.zeros((0, 2 * n + 1)), np.zeros((n, 0)), D)


THRUST = Springs(("z", "tilt_x"), (3e7, 2e4), (2e3, 4.0))


def stiffness(reaction, s, position=CENTER, speed=SPEED):
    return small_motion(reaction, position, speed)(s)[0]


def differences(reaction, x, u, step=1e-6):
    """Return the derivatives of rates and outputs by central differences over states and inputs."""
    sizes = np.array([signal.nominal for signal in (*reaction.states, *reaction.inputs)])
    at, m = np.concatenate([x, u]), len(x)

    def answer(z):
        return np.concatenate([reaction.derivative(0.0, z[:m], z[m:]), reaction.output(0.0, z[:m], z[m:])])

    columns = [
        (answer(at + step * size * unit) - answer(at - step * size * unit)) / (2.0 * step * size)
        for size, unit in zip(sizes, np.eye(len(at)), strict=True)
    ]
    return np.transpose(columns)


def assert_exact(reaction, x, u):
    """Assert that the linearization has the derivatives of rates and outputs."""
    A, B, C, D = reaction.linearization(0.0, x, u)
    found, sizes = np.block([[A, B], [C, D]]), [s.nominal for s in (*reaction.states, *reaction.inputs)]
    wanted = differences(reaction, x, u)
    rows = np.abs(wanted * sizes).max(axis=1, initial=1e-300)[:, None]
    assert np.abs((found - wanted) * sizes / rows).max() < 1e-6


# One behind the other.


def test_springs_and_a_mass_in_series_have_the_closed_form():
    one, other, mass = 2e7, 5e6, 3.0
    series = Series(LinearBearing(stiffness=other), Body(mass), LinearBearing(stiffness=one))
    for w in (0.0, 700.0, 1500.0, 6000.0):
        exact = one * (other - mass * w**2) / (one + other - mass * w**2)
        assert_allclose(stiffness(series, 1j * w), exact * np.eye(2), rtol=1e-11, atol=1e-3)


@pytest.mark.parametrize("s", [0j, 500j, -40.0 + 900j, 3000j])
def test_any_two_reactions_in_series_have_the_closed_form(s):
    """Z = Z1 - Z1 (Z1 + Z2 + m s^2)^-1 Z1, those of the seal with its states."""
    for inner, outer in ((RING, SUPPORT), (SEAL, SUPPORT), (SUPPORT, SEAL), (SEAL, SEAL)):
        one, other = stiffness(inner, s), stiffness(outer, s, speed=0.0)
        exact = one - one @ np.linalg.solve(one + other + 4.0 * s**2 * np.eye(2), one)
        found = stiffness(Series(outer, Body(4.0), inner), s)
        assert_allclose(found, exact, rtol=1e-10, atol=1e-11 * np.abs(exact).max())


def test_names_of_states():
    series = Series(SEAL, Body(4.0), SEAL)
    assert names(series.states) == [
        *("body_x", "body_y", "body_vx", "body_vy"),
        *("inner_state_0", "inner_state_1", "outer_state_0", "outer_state_1"),
    ]
    assert [s.unit for s in series.states[:4]] == ["m", "m", "m/s", "m/s"]
    assert names(series.inputs) == names(SEAL.inputs)
    assert names(series.outputs) == ["force_x", "force_y"]


def test_the_added_mass_of_the_outer_reaction_is_added_to_the_body():
    outer = with_springs(DAMPER, 5e6)
    added = mass_of(DAMPER, CENTER, CENTER, 0.0)
    assert added[0, 0] > 0.1
    own = coefficients(outer, CENTER, 0.0)
    for s in (0j, 800j, -30.0 + 1200j):
        one, other = 2e7 + 300.0 * s, own.stiffness + s * own.damping
        body = one * np.eye(2) + other + s**2 * (2.0 * np.eye(2) + added)
        exact = one * np.eye(2) - one**2 * np.linalg.inv(body)
        assert_allclose(stiffness(Series(outer, Body(2.0), RING), s), exact, rtol=1e-9, atol=1e-4)


def test_the_linearization_is_exact():
    series = Series(with_springs(DAMPER, 5e6), Body(2.0), FILM)
    x, u = np.array([2e-5, -3e-5, 2e-3, 1e-3]), np.array([4e-5, -5e-5, 3e-3, -2e-3, SPEED])
    assert_exact(series, x, u)
    assert_exact(Series(SEAL, Body(2.0), SEAL), np.array([*x, 1e-8, 2e-8, -1e-8, 3e-8]), u)


def test_a_journal_bearing_in_a_sprung_body_rests_where_both_carry_the_load():
    load = np.array([50.0, -300.0])
    series = Series(LinearBearing(stiffness=(lambda k: ((k, 0.0), (0.0, 2.0 * k)))(6e6)), Body(2.0), FILM)
    body = load / [6e6, 12e6]
    at = equilibrium(FILM, load, SPEED)
    place = at.position + body
    assert_allclose(rest_state(series, place, SPEED), [*body, 0.0, 0.0], atol=1e-15)
    assert_allclose(quasi_static(series).force(place, CENTER, SPEED), -load, rtol=1e-9)
    found = equilibrium(series, load, SPEED)
    assert_allclose(found.position, place, rtol=1e-9)
    assert series.clearance == np.inf
    assert Series(with_springs(DAMPER, 6e6), Body(2.0), FILM).clearance == pytest.approx(2.2e-4)
    exact = coefficients(FILM, at.position, SPEED)
    one = exact.stiffness + 200j * exact.damping
    whole = one - one @ np.linalg.solve(one + np.diag([6e6, 12e6]) - 2.0 * 200.0**2 * np.eye(2), one)
    assert_allclose(dynamic_stiffness(series, found, 200j), whole, rtol=1e-8)


@pytest.mark.parametrize("beside", [False, True])
def test_the_least_film_of_a_series_is_that_of_its_journal_bearing(beside):
    load, springs = np.array([3000.0, -15000.0]), with_springs(DAMPER, 5e8)
    alone, series = equilibrium(FILM, load, SPEED), Series(springs, Body(2.0), FILM)
    assert alone.minimum_film < 2e-5
    ring = RubRing(gap=5e-4, stiffness=1e7, radius=0.05)
    found = equilibrium(Parallel((series, ring)) if beside else series, load, SPEED)
    assert_allclose(found.position, alone.position + load / 5e8, rtol=1e-9)
    assert_allclose(found.minimum_film, alone.minimum_film, rtol=1e-8)
    assert_allclose(found.eccentricity_ratio, alone.eccentricity_ratio, rtol=1e-9)


def test_the_least_film_of_a_series_is_that_of_its_damper_where_this_is_nearer_to_its_wall():
    load = np.array([0.0, -200.0])
    soft = Series(with_springs(DAMPER, 2e6), Body(2.0), FILM)
    found = equilibrium(soft, load, SPEED)
    assert equilibrium(FILM, load, SPEED).minimum_film > DAMPER.clearance - 1e-4
    assert_allclose(found.minimum_film, DAMPER.clearance - 1e-4, rtol=1e-8)
    assert_allclose(found.eccentricity_ratio, 1e-4 / DAMPER.clearance, rtol=1e-9)


def test_the_rest_of_a_series_without_a_clearance_tells_the_film_of_its_parts():
    load = np.array([50.0, -300.0])
    alone, still = equilibrium(FILM, load, SPEED), quasi_static(Series(RING, Body(2.0), FILM))
    found = still.completed(equilibrium(Series(RING, Body(2.0), FILM), load, SPEED))
    assert_allclose(found.minimum_film, alone.minimum_film, rtol=1e-8)
    assert_allclose(found.eccentricity_ratio, alone.eccentricity_ratio, rtol=1e-8)


@pytest.mark.long
def test_the_least_film_on_pads_in_a_sprung_body_is_that_of_the_pads():
    pads = TiltingPadBearing(radius=0.05, length=0.05, pad_clearance=1e-4, viscosity=0.02,
                             pivots=(0.8, 2.4, 3.9, 5.5), extent=1.0, preload=0.3)  # fmt: skip
    load = [0.0, -500.0]
    alone, series = (
        equilibrium(pads, load, SPEED),
        Series(with_springs(DAMPER, 5e8), Body(2.0), pads),
    )
    found = equilibrium(series, load, SPEED)
    assert_allclose([found.minimum_film, found.eccentricity_ratio],
                    [alone.minimum_film, alone.eccentricity_ratio], rtol=1e-7)  # fmt: skip


# Where balls with clearance rest, and reactions with states that integrate; the band of a part.


LOOSE = BallBearing(balls=9, ball_diameter=7.9e-3, pitch_diameter=46e-3, internal_clearance=12e-6)
DISK = Springs(("z", "tilt_x", "tilt_y"), (2e8, 5e4, 5e4), (0.0, 0.0, 0.0))


def test_loose_balls_beside_a_thrust_bearing_rest_as_both_alone():
    load = [10.0, -100.0]
    place = equilibrium(LOOSE, load, SPEED).position
    found = equilibrium(Parallel((DISK, LOOSE)), [*load, 1.0, 0.0, 5e-3], SPEED)
    assert_allclose(found.position, [*place, 5e-9, 0.0, 1e-7], rtol=1e-8, atol=1e-18)


def test_loose_balls_in_a_sprung_body_rest_where_both_carry_the_load():
    load = np.array([10.0, -100.0])
    found = equilibrium(Series(LinearBearing(stiffness=(1e7, 2e7)), Body(1.0), LOOSE), load, SPEED)
    place = equilibrium(LOOSE, load, SPEED).position + load / [1e7, 2e7]
    assert_allclose(found.position, place, rtol=1e-8)


def test_where_a_reaction_says_that_it_rests_is_no_start_beyond_another_wall():
    load = [0.0, -50.0]
    tight = replace(FILM, clearance=5e-6)
    told = Parallel((LOOSE, tight)).rest_place(load, SPEED)
    assert np.hypot(*equilibrium(LOOSE, load, SPEED).position) > tight.clearance
    assert told is None
    assert equilibrium(Parallel((LOOSE, tight)), load, SPEED).residual < 1e-12


MAGNET = FrequencyDependentReaction(
    A=np.diag([0.0, 0.0, -100.0, -100.0]),
    B=np.vstack([np.eye(2)] * 2),
    C=np.hstack([-1e8 * np.eye(2), -1e7 * np.eye(2)]),
    D=-1e6 * np.eye(2),
    damping=1e3 * np.eye(2),
)


def test_a_state_that_integrates_beside_a_film_holds_the_shaft():
    load, both = [0.0, -100.0], Parallel((FILM, MAGNET))
    assert_allclose(equilibrium(both, load, SPEED).position, [0.0, -1e-13], rtol=1e-6, atol=1e-19)
    whole = dynamic_stiffness(both, equilibrium(both, load, SPEED), 90j)
    parts = [small_motion(one, CENTER, SPEED).stiffness(90j) for one in (FILM, MAGNET)]
    assert_allclose(whole, sum(parts), rtol=1e-8)
    for speed, nu in ((0.0, None), (SPEED, 0.0)):
        with pytest.raises(InputError, match=r"frequency must be above 0: at 0 a state that integrates"):
            coefficients(both, CENTER, speed, nu)


def test_a_state_that_integrates_on_springs_leaves_the_springs():
    load, springs = np.array([30.0, -100.0]), LinearBearing(stiffness=5e7)
    series, turned = Series(springs, Body(1.0), MAGNET), Series(MAGNET, Body(1.0), springs)
    for one in (series, turned):
        assert_allclose(equilibrium(one, load, SPEED).position, load / 5e7, rtol=1e-6)
        slow = coefficients(one, CENTER, SPEED, 0.0)
        assert_allclose(slow.stiffness, 5e7 * np.eye(2), rtol=1e-9)
        assert_allclose(slow.damping, -(5e7**2) / 1e8 * np.eye(2), rtol=1e-9)


def test_the_band_of_every_part_is_kept():
    banded, series = replace(SEAL, band=(10.0, 100.0)), Series(RING, Body(1.0), SEAL)
    wholes = [Parallel((FILM, banded)), replace(series, inner=banded), replace(series, outer=banded)]
    for one in (*wholes, Parallel((FILM, wholes[1]))):
        require_range(one, 50.0)
        with pytest.warns(ValidityWarning, match="frequency should be 10 to 100 rad/s"):
            coefficients(one, CENTER, SPEED)


@pytest.mark.long
def test_a_damper_without_springs_carries_no_load():
    bare = Series(DAMPER, Body(2.0), FILM)
    with pytest.raises(EquilibriumError):
        equilibrium(bare, [0.0, -300.0], SPEED)
    place = np.array([3e-5, -2e-5])
    assert_allclose(rest_state(Series(DAMPER, Body(2.0), RING), place, SPEED), [*place, 0.0, 0.0], atol=1e-15)


def test_a_ruptured_damper_has_a_rest_and_no_derivative_there():
    series = Series(with_springs(RUPTURED, 5e6), Body(2.0), RING)
    place = np.array([4e-5, -2e-5])
    assert_allclose(rest_state(series, place, SPEED), [*(0.8 * place), 0.0, 0.0], rtol=1e-10, atol=1e-18)
    with pytest.raises(UndefinedDerivativeError):
        small_motion(series, place, SPEED)


def test_where_the_outer_film_cannot_carry_there_is_no_rest():
    series = Series(FILM, Body(2.0), RING)  # the body does not turn: no wedge, and no derivative
    with pytest.raises(EquilibriumError, match="reaction must have an equilibrium of its states"):
        rest_state(series, [9e-4, 0.0], SPEED)


@pytest.mark.parametrize("outer", ["full", pytest.param("ruptured", marks=pytest.mark.long)])
def test_small_motion_in_time_is_that_of_the_eigenvalues(outer):
    """A ring on springs in a full film: the exponential of the mounted system; a ruptured one just runs."""
    film = {"full": DAMPER, "ruptured": RUPTURED}[outer]
    series = Series(with_springs(film, 5e6), Body(2.0), RING)
    rotor = RigidRotor(mass=30.0, speed=SPEED, gravity=(0.0, 0.0), position=(3e-8, -6e-8))
    run = simulate(rotor, series, duration=0.02, samples=9, rtol=1e-10)
    if outer == "ruptured":
        assert np.hypot(run["x"], run["y"]).max() <= 6.8e-8
        return
    A = mount(rotor, {"": series}).linearization(0.0, np.zeros(8), []).A
    states = np.array([expm(A * t) @ np.array([3e-8, -6e-8, *np.zeros(6)]) for t in run.time]).T
    for name, row in zip(
        ["x", "y", "vx", "vy", "body_x", "body_y", "body_vx", "body_vy"], states, strict=True
    ):
        assert run[name] == pytest.approx(row, abs=1e-6 * np.abs(row).max()), name


def test_an_fmu_of_a_series_has_its_motion(tmp_path):
    series = Series(SEAL, Body(2.0), RING)
    path = export_fmu(series, tmp_path / "series.fmu", component="series", start={"x": 1e-5})
    told = fmpy.simulate_fmu(str(path), stop_time=0.004, output_interval=1e-3, step_size=1e-3)
    A, B, C, D = series.linearization(0.0, series.initial_state, np.zeros(5))
    u = np.array([1e-5, 0.0, 0.0, 0.0, 0.0])
    rest = -np.linalg.solve(A, B @ u)
    for row in told:
        x = rest - expm(A * row["time"]) @ rest
        found = [row[f"series.{name}"] for name in ("force_x", "force_y")]
        assert_allclose(found, C @ x + D @ u, rtol=1e-6, atol=1e-6)


FREE = ("x", "y", "z", "tilt_x", "tilt_y")
BALL = Springs(FREE, (2e7, 2e7, 1e7, 5e4, 5e4), (300.0, 300.0, 100.0, 2.0, 2.0))


def test_the_body_moves_in_what_both_react_to():
    """A ball bearing in a damper: the ring moves along x and y, and stands still in all else."""
    series = Series(SUPPORT, Body(2.0), BALL)
    assert series.freedoms == FREE
    assert names(series.states) == ["body_x", "body_y", "body_vx", "body_vy"]
    found = stiffness(series, 400j, np.zeros(5))
    assert_allclose(found[:2, :2], stiffness(Series(SUPPORT, Body(2.0), RING), 400j), rtol=1e-12)
    assert_allclose(np.diag(found)[2:], [1e7 + 4e4j, 5e4 + 800j, 5e4 + 800j], rtol=1e-13)


def test_a_body_with_an_inertia_tilts():
    holder = Springs(("x", "y", "tilt_x", "tilt_y"), (5e6, 5e6, 1e4, 2e4))
    upright, tilting = (Series(holder, Body(2.0, inertia), BALL) for inertia in (None, 0.01))
    assert names(upright.states) == ["body_x", "body_y", "body_vx", "body_vy"]
    assert names(tilting.states)[:4] == ["body_x", "body_y", "body_tilt_x", "body_tilt_y"]
    assert names(tilting.states)[4:] == ["body_vx", "body_vy", "body_tilt_rate_x", "body_tilt_rate_y"]
    s = 900j
    found, one = stiffness(tilting, s, np.zeros(5)), 5e4 + 2.0 * s
    assert stiffness(upright, s, np.zeros(5))[3, 3] == pytest.approx(one, rel=1e-12)
    for k, spring in ((3, 1e4), (4, 2e4)):
        assert found[k, k] == pytest.approx(one - one**2 / (one + spring + 0.01 * s**2), rel=1e-11)


# Side by side.


def test_motions_of_all_reactions_in_order():
    both = Parallel((THRUST, FILM))
    assert both.freedoms == ("x", "y", "z", "tilt_x")
    assert names(both.outputs) == ["force_x", "force_y", "force_z", "moment_x"]
    q, v = np.array([3e-5, -4e-5, 1e-5, 2e-4]), np.array([1e-3, 2e-3, -1e-3, 0.01])
    film, thrust = FILM.force(q[:2], v[:2], SPEED), [-3e7 * 1e-5 + 2.0, -4.0 - 0.04]
    assert_allclose(both.force(q, v, SPEED), [*film, *thrust], rtol=1e-13)
    assert_allclose(both.output(0.0, [], [*q, *v, SPEED]), [*film, *thrust], rtol=1e-13)
    batch = both.jacobian(np.stack([q, 0.5 * q], axis=1), np.stack([v, v], axis=1), SPEED)
    assert batch.shape == (4, 9, 2)
    assert_allclose(batch[:, :, 0], both.linearization(0.0, [], [*q, *v, SPEED]).D, rtol=1e-12)
    assert_allclose(batch[:2, [0, 1, 4, 5, 8], 0], FILM.jacobian(q[:2], v[:2], SPEED), rtol=1e-13)
    assert not batch[:2, [2, 3, 6, 7]].any()
    assert both.clearance == FILM.clearance
    assert not states_rest(both)


def test_states_beside_a_film_without():
    both = Parallel((FILM, SEAL, replace(SEAL, added_mass=[[3.0, 1.0], [1.0, 2.0]])))
    assert names(both.states) == ["part1_state_0", "part1_state_1", "part2_state_0", "part2_state_1"]
    assert names(both.outputs) == ["force_x", "force_y", "mass_xx", "mass_xy", "mass_yy"]
    assert states_rest(both)
    assert both.has_inertia
    assert_allclose(both.mass(CENTER, CENTER, SPEED), [[3.0, 1.0], [1.0, 2.0]])
    place, s = np.array([2e-5, -6e-5]), 70.0 + 900j
    parts = stiffness(FILM, s, place) + 2.0 * stiffness(SEAL, s, place)
    assert_allclose(stiffness(both, s, place), parts, rtol=1e-12)
    x = rest_state(both, place, SPEED)
    assert_allclose(x, np.tile(rest_state(SEAL, place, SPEED), 2), rtol=1e-12)
    assert not np.any(np.abs(both.derivative(0.0, x, [*place, 0.0, 0.0, SPEED])) > 1e-15)
    assert_exact(both, 1.1 * x, np.array([*place, 1e-3, 2e-3, SPEED]))


def test_a_parallel_reaction_rests_with_its_states():
    both, load = Parallel((FILM, SEAL)), np.array([0.0, -400.0])
    at = equilibrium(both, load, SPEED)
    still = FILM.force(at.position, CENTER, SPEED) - stiffness(SEAL, 0j).real @ at.position
    assert_allclose(still, -load, rtol=1e-9, atol=1e-7)


@pytest.mark.long
def test_motion_of_parallel_reactions_is_that_of_both():
    """A seal beside springs is the seal with these springs."""
    rotor = RigidRotor(mass=20.0, speed=SPEED, gravity=(0.0, 0.0), position=(1e-5, 0.0))
    alone = replace(SEAL, D=np.asarray(SEAL.D) - 3e6 * np.eye(2))
    runs = [
        simulate(rotor, one, duration=0.01, samples=5, rtol=1e-10)
        for one in (Parallel((LinearBearing(stiffness=3e6), SEAL)), alone)
    ]
    assert_allclose(runs[0]["x"], runs[1]["x"], atol=1e-13)
    assert_allclose(
        runs[0]["part1_state_0"], runs[1]["state_0"], atol=1e-12 * np.abs(runs[1]["state_0"]).max()
    )


# Beside springs, by direction.


@pytest.mark.parametrize("springs", [3e6, (3e6, 5e6), ((3e6, 4e5), (-2e5, 5e6))])
def test_springs_add_their_pull_to_a_film(springs):
    held = with_springs(FILM, springs)
    matrix = np.array(springs) if np.ndim(springs) == 2 else springs * np.eye(2)
    q, v = np.array([3e-5, -4e-5]), np.array([1e-3, 2e-3])
    force, slopes = FILM.force(q, v, SPEED) - matrix @ q, FILM.jacobian(q, v, SPEED)
    slopes[:, :2] -= matrix
    assert_allclose(held.force(q, v, SPEED), force, rtol=1e-13)
    assert_allclose(held.jacobian(q, v, SPEED), slopes, rtol=1e-13)
    assert_allclose(held.prepare()(*q, *v, SPEED), force, rtol=1e-13)
    x, y, found = held.prepare_tangent()(*q, *v, SPEED)
    assert_allclose([x, y], force, rtol=1e-13)
    assert_allclose(np.reshape(found, (2, 5)), slopes, rtol=1e-13)
    assert held.inputs == FILM.inputs
    assert held.outputs == FILM.outputs
    assert held.native() is None


def test_springs_by_direction_have_a_kernel_in_c():
    assert compiled_force(with_springs(FILM, (3e6, 5e6))) is not None
    assert compiled_force(with_springs(FILM, 3e6)) is not None
    assert film_call(with_springs(FILM, (3e6, 5e6))).address


def test_circular_orbits_refuse_springs_that_differ():
    with pytest.raises(InputError):
        synchronous_orbits(
            RigidRotor(mass=20.0, speed=SPEED, gravity=(0.0, 0.0)),
            with_springs(replace(DAMPER, density=0.0), (3e6, 5e6)),
        )


# What is refused.


WARM = JournalBearing(
    radius=0.05,
    length=0.03,
    clearance=1e-4,
    oil=Oil.iso_vg(32),
    cooling=Cooling(supply_temperature=313.15),
)
HEAVY = replace(SEAL, added_mass=np.eye(2))
WRONG = [
    (lambda: Body(0.0), "mass must be finite and positive, got 0.0"),
    (lambda: Body(1.0, inertia=-1.0), "inertia must be finite and positive, got -1.0"),
    (lambda: Series(RING, Body(1.0), 3.0), "inner must be a Reaction"),
    (lambda: Series(3.0, Body(1.0), RING), "outer must be a Reaction"),
    (lambda: Series(RING, 2.0, RING), "body must be a Body"),
    (lambda: Series(RING, Body(1.0), HEAVY), "inner must not add a mass"),
    (
        lambda: Series(RING, Body(1.0), THRUST),
        "one motion that the body has, got x, y and z, tilt_x",
    ),
    (
        lambda: Series(Springs(("tilt_x",), (1.0,)), Body(1.0), THRUST),
        "must react to one motion that the body has",
    ),
    (
        lambda: Series(WARM, Body(1.0), RING),
        "outer must have a given temperature, or the temperature as a state",
    ),
    (lambda: Parallel((RING, WARM)), r"reactions\[1\] must have a given temperature"),
    (lambda: Parallel((RING,)), "reactions must be two at least, got 1"),
    (lambda: Parallel((RING, "seal")), r"reactions\[1\] must be a Reaction"),
    (
        lambda: with_springs(SEAL, 1e6),
        "reaction must be a Reaction such as a PorousDamper",
    ),
    (
        lambda: with_springs(FILM, (1e6, -1e6)),
        "stiffness must be positive in every direction",
    ),
    (
        lambda: with_springs(FILM, ((1e6, 3e6), (3e6, 1e6))),
        "must be positive in every",
    ),
    (
        lambda: with_springs(FILM, (1e6, 1e6, 1e6)),
        r"stiffness must be a number or 2 x 2 numbers",
    ),
    (lambda: Series(RING, Body(1.0), RING).output(0.0, [0.0], np.zeros(5)), r"x must have shape \(4,\)"),
    (lambda: Parallel((RING, SEAL)).output(0.0, [0.0], np.zeros(5)), r"x must have shape \(2,\)"),
    (lambda: Parallel((RING, SEAL)).output(0.0, np.zeros(2), [0.0]), r"u must have shape \(5,\) for x, y"),
]


@pytest.mark.parametrize(("make", "said"), WRONG)
def test_what_breaks_a_rule_is_named(make, said):
    with pytest.raises(InputError, match=said):
        make()


def test_a_film_with_states_has_them_beside_springs():
    from rotorfilm.bearings import BushReaction, f4k20_bush

    worn = BushReaction(bush=f4k20_bush(), melting_heat=1e8, nodes=8, extent=1.4, retardation=2e-4)
    both = with_springs(worn, 1e6)
    assert not states_rest(both)
    assert len(both.states) == len(worn.states)
    q = np.array([0.0, -4.6e-4])
    held = worn.force(q, CENTER, SPEED) - 1e6 * q
    assert_allclose(both.force(q, CENTER, SPEED), held, rtol=1e-12)


def test_a_seal_carries_no_load_in_series_or_beside():
    from rotorfilm import AnnularSeal
    from rotorfilm.core.port import carries_load

    ring = RubRing(gap=1e-3, stiffness=1e7, radius=0.05)
    assert carries_load(Series(RING, Body(1.0), RING))
    assert carries_load(Parallel((RING, ring)))
    assert AnnularSeal.carries_load is False
