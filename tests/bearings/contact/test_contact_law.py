"""The reduced contact: against the full model, and as a Model."""

import control
import numpy as np
import pytest
from scipy.integrate import solve_ivp
from scipy.interpolate import CubicSpline

from rotorfilm import (
    ContactGrid,
    ConvergenceError,
    Dynamic,
    InputError,
    Linearization,
    PointContact,
    RollingBall,
    ValidityWarning,
    linearize,
    reduce_ball,
    reduce_contact,
)
from rotorfilm.analysis import OperatingPoint
from rotorfilm.bearings import HERTZ_LOAD, FixedSteps, SineLoad, SmallMotion, StepLoad, ball_transient
from rotorfilm.bearings.contact.contact_law import fit_static_law, transfer
from rotorfilm.bearings.contact.reduction import fit_transfer


@pytest.fixture(autouse=True, scope="module")
def _cache(tmp_path_factory):
    with pytest.MonkeyPatch.context() as patch:
        patch.setenv("ROTORFILM_CACHE", str(tmp_path_factory.mktemp("cache")))
        yield


CONTACT = PointContact(V=0.1, Q0=5.0, grid=ContactGrid(cells=(28, 28)))


@pytest.fixture(scope="module")
def law():
    return reduce_contact(CONTACT, order=5)


@pytest.fixture(scope="module")
def resting():
    return CONTACT.stationary()


@pytest.mark.closed_form
def test_vector_fit_finds_a_rational_function():
    rng = np.random.default_rng(0)
    poles = np.array([-0.5 + 2.0j, -0.5 - 2.0j, -3.0])
    residues = np.array([1.0 + 0.5j, 1.0 - 0.5j, -2.0])
    omega = np.geomspace(0.1, 10.0, 25)
    s = 1j * omega
    value = sum(r * s / (s - p) for r, p in zip(residues, poles, strict=True))
    fit, error = fit_transfer(omega, value, 3, np.ones(25))
    assert error < 1e-9
    assert np.sort_complex(np.linalg.eigvals(fit.A)) == pytest.approx(np.sort_complex(poles), rel=1e-7)
    assert transfer(fit, np.zeros(1))[0] == pytest.approx(0.0, abs=1e-9)
    # and stays stable on noise
    noisy, _ = fit_transfer(omega, rng.normal(size=25) + 1j * rng.normal(size=25), 6, np.ones(25))
    assert np.linalg.eigvals(noisy.A).real.max() < 0.0


@pytest.mark.closed_form
def test_static_fit_finds_a_power_law():
    delta = -np.linspace(0.5, 3.0, 7)
    fitted = fit_static_law(delta, ((0.2 - delta) / 2.1) ** 1.54)
    assert fitted[:3] == pytest.approx((0.2, 2.1, 1.54), rel=1e-5)


@pytest.mark.long
def test_static_law_holds_between_its_loads(law):
    state = CONTACT.stationary(0.8)
    for load in (0.25, 0.8, 1.8, 2.7):
        state = CONTACT.stationary(load, near=state)
        force = law.output(0.0, law.resting(state.delta), [state.delta])[0]
        static = ((law.offset - state.delta) / law.span) ** law.exponent
        assert static == pytest.approx(load, rel=5e-3)
        assert force == pytest.approx(static, rel=1e-9)  # resting, the state space adds nothing


def test_state_space_is_the_dynamic_stiffness(law, resting):
    small = SmallMotion(CONTACT.equations, resting.levels[0].pressure, resting.delta)
    still = small.stiffness(1e-6j).real
    assert law.static_error < 5e-3
    assert law.damping_error < 0.01
    for omega in (0.7, 1.3, 2.9, 4.4):
        change = -(small.stiffness(1j * omega) - still) / HERTZ_LOAD
        fitted = transfer(Linearization(law.A, law.B, law.C, law.D), np.array([1j * omega]))[0]
        assert fitted.imag == pytest.approx(change.imag, rel=0.02)
        assert abs(fitted - change) < 2e-3


def test_law_is_a_dynamic_model_with_exact_derivatives(law):
    assert isinstance(law, Dynamic)
    x, u = np.linspace(-0.1, 0.2, 5), np.array([-1.7])
    matrices = law.linearization(0.0, x, u)
    step = 1e-4
    forces = [law.output(0.0, x, u + k * step)[0] for k in (-2, -1, 1, 2)]
    slope = (forces[0] - 8.0 * forces[1] + 8.0 * forces[2] - forces[3]) / (12.0 * step)
    assert matrices.D[0, 0] == pytest.approx(slope, rel=1e-8)
    rates = [law.derivative(0.0, x, u + k * step) for k in (-1, 1)]
    assert matrices.B[:, 0] == pytest.approx((rates[1] - rates[0]) / (2.0 * step), rel=1e-7)
    system = linearize(law, OperatingPoint(x=law.initial_state, u=[law.operating]), name="contact")
    assert isinstance(system, control.StateSpace)
    assert system.input_labels == ["z"]
    assert system.poles().real.max() < 0.0


@pytest.mark.long
def test_forced_motion_is_that_of_the_full_model(law, resting):
    load = SineLoad(amplitude=0.5, frequency=2.0)
    full = CONTACT.simulate(resting, duration=12.0, W=1.0, load=load, control=FixedSteps(step=0.05))
    reduced = ball_transient(
        law, mass=1.0 / HERTZ_LOAD, load=load, start=resting.delta, duration=12.0, samples=full.time.size
    )
    error = np.interp(full.time, reduced.time, reduced["z"]) - full.delta
    assert np.sqrt(np.mean(error**2) / np.mean((full.delta - resting.delta) ** 2)) < 0.05


@pytest.mark.filterwarnings("ignore:force must stay within")
@pytest.mark.parametrize("load", [SineLoad(amplitude=0.5, frequency=2.0), StepLoad(amplitude=0.7, start=1.3)])
def test_ride_integrates_the_law(law, load):
    # An independent integrator on the law's own output and derivative.
    def rate(t, y):
        force = law.output(t, y[2:], y[:1])[0]
        return [y[1], (force - load(t)) / 0.4, *law.derivative(t, y[2:], y[:1])]

    begin = np.array([law.operating, 0.0, *law.resting(law.operating)])
    options = {"method": "DOP853", "rtol": 1e-10, "atol": 1e-12, "max_step": 0.02}
    exact = solve_ivp(rate, (0.0, 6.0), begin, **options).y[:, -1]
    for rtol in (1e-4, 1e-8):
        motion = ball_transient(
            law, mass=0.4, load=load, start=law.operating, duration=6.0, samples=333, rtol=rtol
        )
        assert motion["z"][-1] == pytest.approx(exact[0], abs=2.0 * max(rtol, 1e-8))
        assert motion["force_z"][-1] == pytest.approx(law.output(6.0, exact[2:], exact[:1])[0], rel=1e-3)
    smooth = CubicSpline(motion.time, motion["z"])
    assert motion["vz"][50:-50] == pytest.approx(smooth(motion.time, 1)[50:-50], abs=8e-3)
    assert motion["z"][::2][:-1] == pytest.approx(
        CubicSpline(motion.time[1::2], motion["z"][1::2])(motion.time[::2][:-1]), abs=1e-4
    )


@pytest.mark.closed_form
def test_ball_that_has_left_falls_freely(law):
    load = StepLoad(amplitude=-1.8, start=0.5)
    with pytest.warns(ValidityWarning, match=r"force must stay within 0\.2 and 3, .* got 0 to "):
        motion = ball_transient(law, mass=0.3, load=load, start=law.operating, duration=4.0, samples=401)
    away = motion["z"] > law.offset + 1.0
    assert away.sum() > 20
    slope = np.polyfit(motion.time[away], motion["vz"][away], 1)[0]
    assert slope == pytest.approx(0.8 / 0.3, rel=2e-2)
    assert motion["force_z"].min() >= 0.0


def test_ride_says_when_a_motion_does_not_settle(law):
    rng = np.random.default_rng(0)
    with pytest.raises(ConvergenceError, match=r"halving the steps must settle the motion to 1\.0e-12"):
        ball_transient(
            law, mass=0.4, load=lambda t: rng.normal(), start=law.operating, duration=0.05, samples=5,
            rtol=1e-12,
        )  # fmt: skip


@pytest.mark.closed_form
def test_law_of_a_ball_is_the_dimensionless_one_in_si():
    ball = RollingBall(
        radius=0.01, mass=0.033, modulus=206e9, poisson_ratio=0.3, viscosity=0.008,
        pressure_coefficient=5e-9, speed=0.9, load=10.0,
    )  # fmt: skip
    contact = ball.contact(ContactGrid(cells=(24, 24)))
    bare, si = reduce_contact(contact, 3), reduce_ball(ball, contact, 3)
    z = bare.operating * ball.film_scale
    assert si.output(0.0, np.zeros(3), [z])[0] == pytest.approx(ball.load, rel=5e-3)
    motions = [
        ball_transient(
            bare, mass=ball.W / HERTZ_LOAD, load=lambda t: 1.1, start=bare.operating, duration=5.0, rtol=1e-8
        ),
        ball_transient(
            si,
            mass=ball.mass,
            load=lambda t: 1.1 * ball.load,
            start=z,
            duration=5.0 * ball.time_scale,
            rtol=1e-8,
        ),
    ]
    scaled = motions[1]["z"] / ball.film_scale
    assert scaled == pytest.approx(motions[0]["z"], abs=1e-5)
    with pytest.raises(InputError, match="contact must be of the ball, with V = "):
        reduce_ball(ball, CONTACT)


def test_a_ball_that_leaves_is_neither_pulled_nor_felt(law):
    away = law.offset + np.array([0.01, 1.0, 5.0])
    rates = [law.derivative(0.0, np.zeros(5), [delta]) for delta in away]
    assert np.array_equal(rates[0], rates[1])
    assert np.array_equal(rates[0], rates[2])
    x = -10.0 * np.linalg.pinv(law.C)[:, 0]
    assert law.output(0.0, x, [away[0]]) == 0.0
    assert not law.linearization(0.0, x, [away[0]]).C.any()
    assert law.events(0.0, x, [away[1]])[0] == pytest.approx(1.0 / law.span)


@pytest.mark.long
@pytest.mark.filterwarnings("ignore:force must stay within")
def test_a_bounce_is_that_of_the_full_film(law, resting):
    load = StepLoad(amplitude=-1.2, start=1.0, end=2.5)
    full = CONTACT.simulate(resting, duration=8.0, W=1.0, load=load, control=FixedSteps(step=0.05))
    assert full.delta.max() > 1.0  # it leaves
    reduced = ball_transient(
        law, mass=1.0 / HERTZ_LOAD, load=load, start=resting.delta, duration=8.0, samples=full.time.size
    )
    error = np.interp(full.time, reduced.time, reduced["z"]) - full.delta
    assert np.sqrt(np.mean(error**2) / np.mean((full.delta - resting.delta) ** 2)) < 0.06
    assert reduced["force_z"].min() == 0.0


@pytest.mark.long
def test_a_motion_beyond_the_loads_of_the_law_is_said_and_better_on_a_law_about_a_larger_load(resting):
    load = StepLoad(amplitude=1.2)
    full = CONTACT.simulate(resting, duration=10.0, W=1.0, load=load, control=FixedSteps(step=0.05))

    def miss(law):
        options = {"mass": 1.0 / HERTZ_LOAD, "load": load, "start": resting.delta, "duration": 10.0}
        motion = ball_transient(law, **options, samples=full.time.size)
        error = np.interp(full.time, motion.time, motion["z"]) - full.delta
        return np.sqrt(np.mean(error**2) / np.mean((full.delta - full.delta.mean()) ** 2))

    with pytest.warns(ValidityWarning, match=r"got \S* to 3\.[0-9]*: fit the law at"):
        beyond = miss(reduce_contact(CONTACT))
    # about the load that the ball swings around; it needs no warning
    assert miss(reduce_contact(CONTACT, load=1.6)) < 0.5 * beyond


def test_a_law_about_another_load():
    heavy = reduce_contact(CONTACT, load=1.6)
    state = CONTACT.stationary(1.6)
    # The rectangles differ: that of the law is in the Hertzian radii of its load.
    assert float(heavy.approach(1.6)) == pytest.approx(state.delta, rel=0.01)
    assert heavy.load_range == pytest.approx((0.32, 4.8))
    small = SmallMotion(CONTACT.equations, state.levels[0].pressure, state.delta)
    answer = small.stiffness(1.0j) / HERTZ_LOAD
    assert heavy.stiffness == pytest.approx(small.stiffness(1e-6j).real / HERTZ_LOAD, rel=0.02)
    s = 1.0j * heavy.time_scale  # its own unit of time
    fitted = transfer(Linearization(heavy.A, heavy.B, heavy.C, heavy.D), np.array([s]))[0]
    damping = -fitted.imag * heavy.force_scale / heavy.film_scale
    assert damping == pytest.approx(answer.imag, rel=0.05)


@pytest.mark.closed_form
def test_approach_and_static_force_are_inverse(law):
    loads = np.array([[0.3, 1.0], [2.0, 0.0]])
    assert law.static_force(law.approach(loads)) == pytest.approx(loads, abs=1e-12)
    z, step = law.approach(1.3), 1e-6
    slope = (law.static_force(z + step) - law.static_force(z - step)) / (2.0 * step)
    assert float(law.static_slope(z)) == pytest.approx(float(slope), rel=1e-7)
    with pytest.raises(InputError, match="load must not be negative"):
        law.approach(-1.0)
