"""Every coupling scheme: its declared order, closed forms, what it asks of its partners, what it costs."""

from dataclasses import dataclass, replace

import numpy as np
import pytest
from numpy.testing import assert_allclose
from scipy.linalg import expm

from rotorfilm import ConvergenceError, InputError, JournalBearing
from rotorfilm.analysis import simulate
from rotorfilm.bearings.journal import MapFilm
from rotorfilm.cosim import (
    Adaptive,
    GaussSeidel,
    InProcessSlave,
    Jacobi,
    Newton,
    SIExp,
    SIExp3,
    Slave,
    cosimulate,
    couple,
    squeeze_limit,
)
from rotorfilm.rotors import RigidRotor, RigidShaft, SpeedProfile, mount

pytestmark = pytest.mark.filterwarnings("ignore::rotorfilm.core.errors.CouplingWarning")

EXPLICIT = [kind(degree=degree) for kind in (GaussSeidel, Jacobi) for degree in range(3)]
SCHEMES = [*EXPLICIT, SIExp(), SIExp3(), Newton()]


def labelled(scheme):
    return scheme.label


def run(rotor, film, step, duration, scheme):
    return couple(
        InProcessSlave(rotor), InProcessSlave(film), macro_step=step, duration=duration, scheme=scheme
    )


@pytest.fixture(scope="module")
def orbit():
    """Return a rotor and a film with a strong orbit, and its motion over three turns, 360 points a turn."""
    bearing = JournalBearing(radius=0.05, length=0.05, clearance=1e-4, viscosity=0.05, film=MapFilm())
    load = -bearing.force((0.5e-4, 0.0), (0.0, 0.0), 157.0)
    mass = float(np.hypot(*load)) / (1e-4 * 157.0**2)
    rotor = RigidRotor(
        mass=mass,
        speed=157.0,
        unbalance=0.25e-4 * mass,
        gravity=(0.0, 0.0),
        static_force=tuple(load),
        position=(0.5e-4, 0.0),
    )
    duration = 6.0 * np.pi / 157.0
    times = np.linspace(0.0, duration, 3 * 360 + 1)
    return rotor, bearing, simulate(rotor, bearing, duration=duration, times=times, rtol=1e-11)


@pytest.mark.convergence
@pytest.mark.parametrize("scheme", SCHEMES, ids=labelled)
def test_measured_order_is_the_declared_one(orbit, scheme):
    # In the last turn: what schemes of higher degree lose at the start, without a past, has died out there.
    rotor, bearing, exact = orbit
    counts = {"Jacobi 1": (360, 720), "Jacobi 2": (720, 1440)}.get(scheme.label, (180, 360))
    errors = []
    for count in counts:
        found = run(rotor, bearing, exact.time[-1] / (3 * count), exact.time[-1], scheme).trajectory
        times = exact.time[2 * 360 :: 360 // min(count, 360)]
        at, whole = (np.searchsorted(series, times - 1e-9) for series in (found.time, exact.time))
        away = found.position[:, at] - exact.position[:, whole]
        errors.append(np.hypot(*away).max() / bearing.clearance)
    assert_allclose(np.log2(errors[0] / errors[1]), scheme.order, atol=0.2)


@pytest.mark.closed_form
@pytest.mark.parametrize("step", [0.3, 3.0, 30.0])
@pytest.mark.parametrize("scheme", [SIExp(), SIExp3()], ids=labelled)
def test_linearly_implicit_schemes_are_exact_on_linear_films(make_spring_damper, scheme, step):
    m, k, c = 3.0, 7.0, 200.0
    rotor = RigidRotor(mass=m, speed=1.0, gravity=(0.0, 0.0), position=(1.0, -2.0), velocity=(0.5, 0.0))
    found = run(rotor, make_spring_damper(k, c), step, 5 * step, scheme).trajectory
    system = np.array([[0.0, 1.0], [-k / m, -c / m]])
    states = [expm(n * step * system) @ [[1.0, -2.0], [0.5, 0.0]] for n in range(6)]
    assert_allclose(found.position, np.array([s[0] for s in states]).T, atol=1e-9)
    assert_allclose(found.velocity, np.array([s[1] for s in states]).T, atol=1e-9)


@pytest.mark.closed_form
def test_newton_is_the_trapezoidal_rule_on_a_damper(make_spring_damper):
    m, c, h = 3.0, 40.0, 0.5
    rotor = RigidRotor(mass=m, speed=1.0, gravity=(0.0, 0.0), velocity=(1.0, -2.0))
    found = run(rotor, make_spring_damper(0.0, c), h, 20 * h, Newton()).trajectory
    ratio = (1.0 - 0.5 * c * h / m) / (1.0 + 0.5 * c * h / m)
    expected = np.outer([1.0, -2.0], ratio ** np.arange(21))
    assert_allclose(found.velocity, expected, atol=1e-5)
    assert found.work["film_evaluations"] == 41
    assert found.work["rollbacks"] == 20 + 3  # one for each step, three trial steps for the rotor


@pytest.mark.closed_form
def test_extrapolation_on_a_damper_is_the_method_of_adams_and_bashforth(make_spring_damper):
    m, c, h = 3.0, 4.0, 0.1
    weights = {1: (1.5, -0.5), 2: (23.0 / 12.0, -16.0 / 12.0, 5.0 / 12.0)}
    rotor = RigidRotor(mass=m, speed=1.0, gravity=(0.0, 0.0), velocity=(1.0, 0.0))
    for degree, coefficients in weights.items():
        found = run(rotor, make_spring_damper(0.0, c), h, 30 * h, GaussSeidel(degree=degree)).trajectory
        v = found["vx"]
        first = 1 if degree == 1 else 8  # parabolas begin with short steps
        for n in range(first, 30):
            latest = v[n - degree : n + 1][::-1]
            assert_allclose(v[n + 1], v[n] - c * h / m * np.dot(coefficients, latest), rtol=1e-9)


@pytest.mark.closed_form
def test_limits_on_a_damper_are_those_of_the_recursions():
    """Gauss-Seidel: Adams and Bashforth. Jacobi 0: z^2 - z + a = 0, on the circle at a = 1."""
    assert_allclose([squeeze_limit(GaussSeidel(degree=k)) for k in range(3)], [2.0, 1.0, 6 / 11], rtol=1e-5)
    assert_allclose(squeeze_limit(Jacobi()), 1.0, rtol=1e-5)
    assert [squeeze_limit(scheme) for scheme in (SIExp(), SIExp3(), Newton())] == [np.inf] * 3


@pytest.mark.parametrize("scheme", [SIExp(), SIExp3()], ids=labelled)
def test_a_linearly_implicit_step_calls_the_film_once(nondimensional, scheme):
    case = nondimensional(0.5, unbalance=0.2)
    work = run(case.rotor, case.film, 0.05, 1.0, scheme).trajectory.work
    assert work == {
        "steps": 20, "film_evaluations": 21, "film_jacobians": 21, "rotor_steps": 20, "rollbacks": 0
    }  # fmt: skip


@pytest.mark.convergence
def test_third_order_holds_over_a_run_up_with_kinks(orbit):
    rotor, bearing, _ = orbit
    rising = replace(rotor, speed=SpeedProfile(times=(0.0, 0.05), speeds=(140.0, 157.0)))
    exact = simulate(rising, bearing, duration=0.04, times=np.linspace(0.0, 0.04, 801), rtol=1e-11)
    errors = []
    for count in (100, 200):
        found = run(rising, bearing, 0.04 / count, 0.04, SIExp3()).trajectory
        errors.append(np.abs(found.position - exact.position[:, :: 800 // count]).max())
    assert_allclose(np.log2(errors[0] / errors[1]), 3.0, atol=0.3)


def test_adaptive_steps_keep_the_error_and_spare_steps(orbit):
    rotor, bearing, exact = orbit
    errors, steps = [], []
    for tolerance in (1e-2, 1e-4):
        found = run(rotor, bearing, np.radians(10.0) / 157.0, exact.time[-1], Adaptive(tolerance=tolerance))
        own = found.trajectory
        whole = simulate(rotor, bearing, duration=own.time[-1], times=own.time, rtol=1e-10)
        errors.append(np.hypot(*(own.position - whole.position)).max() / bearing.clearance)
        steps.append(own.work["steps"])
        assert own.time[-1] == exact.time[-1]
        assert np.diff(own.time).max() <= np.radians(10.0) / 157.0 * (1.0 + 1e-9)
    assert errors[0] < 1e-3
    assert errors[1] < 2e-5
    assert steps[0] < steps[1] / 2


def test_adaptive_steps_go_back_where_a_step_was_too_long(orbit):
    rotor, bearing, exact = orbit
    hit = replace(rotor, velocity=(3e-3, 0.0), static_force=tuple(3.0 * np.array(rotor.static_force)))
    found = run(hit, bearing, np.radians(20.0) / 157.0, exact.time[-1] / 3, Adaptive(tolerance=1e-4))
    assert found.trajectory.work["rollbacks"] > 0
    own = found.trajectory
    whole = simulate(hit, bearing, duration=own.time[-1], times=own.time, rtol=1e-10)
    assert np.hypot(*(own.position - whole.position)).max() < 2e-4 * bearing.clearance


def shaft_on_two_films():
    """Return a rigid shaft off its center on two different bearings."""
    shaft = RigidShaft(
        mass=60.0,
        polar_inertia=0.6,
        diametral_inertia=4.0,
        speed=157.0,
        unbalances=((0.1, 1.5e-3, 0.0),),
        stations=(("left", -0.4), ("right", 0.3)),
    )
    size = {"radius": 0.05, "clearance": 1e-4, "viscosity": 0.05}
    films = {"left": JournalBearing(**size, length=0.03), "right": JournalBearing(**size, length=0.04)}
    return shaft, films


@pytest.mark.long
@pytest.mark.parametrize("scheme", [GaussSeidel(), SIExp3(), Newton()], ids=labelled)
def test_several_films_on_one_rotor_are_the_monolithic_system(scheme):
    shaft, films = shaft_on_two_films()
    duration, count = 2.0 * np.pi / 157.0, 180
    whole = mount(shaft, films)
    steps = 8 * count if scheme.order == 1 else count
    found = cosimulate(shaft, films, macro_step=duration / steps, duration=duration, scheme=scheme).trajectory
    exact = monolithic(whole, duration, count)
    every = steps // count
    for name in ("left_x", "left_y", "right_x", "right_y"):
        error = np.abs(found[name][::every] - exact[name]).max() / 1e-4
        assert error < {1: 2e-2, 2: 2e-3, 3: 1e-5}[scheme.order]


def monolithic(model, duration, count):
    """Return the outputs of a rotor that has all its films, by Radau."""
    from scipy.integrate import solve_ivp

    times = np.linspace(0.0, duration, count + 1)
    none = np.zeros(0)
    found = solve_ivp(
        lambda t, x: model.derivative(t, x, none),
        (0.0, duration),
        model.initial_state,
        "Radau",
        times,
        jac=lambda t, x: model.linearization(t, x, none).A,
        rtol=1e-9,
        atol=1e-13,
    )
    outputs = np.array([model.output(t, x, none) for t, x in zip(times, found.y.T, strict=True)])
    return {signal.name: series for signal, series in zip(model.outputs, outputs.T, strict=True)}


@pytest.mark.long
def test_a_rotor_that_is_not_linear_is_integrated_as_well():
    """One film is inside the rotor, the other is coupled."""
    shaft, films = shaft_on_two_films()
    duration, count = 0.5 * np.pi / 157.0, 45
    inside = mount(shaft, {"left": films["left"]})
    found = cosimulate(
        inside,
        {"right": films["right"]},
        macro_step=duration / count,
        duration=duration,
        scheme=SIExp3(),
    ).trajectory
    exact = monolithic(mount(shaft, films), duration, count)
    for name in ("left_x", "right_y"):
        assert np.abs(found[name] - exact[name]).max() < 2e-5 * 1e-4


@dataclass(frozen=True)
class Opaque(Slave):
    """A slave that holds inputs, steps, and no more."""

    inner: InProcessSlave

    inputs = property(lambda self: self.inner.inputs)
    outputs = property(lambda self: self.inner.outputs)

    def start(self, values):
        self.inner.start(values)

    def set(self, values):
        self.inner.set(values)

    def step(self, t, dt):
        self.inner.step(t, dt)

    def get(self):
        return self.inner.get()


@pytest.mark.parametrize(
    ("scheme", "rotor", "film", "match"),
    [
        (GaussSeidel(degree=1), Opaque, InProcessSlave, "rotor must take force laws for this scheme"),
        (SIExp3(), Opaque, InProcessSlave, "rotor must take force laws for this scheme"),
        (SIExp3(), InProcessSlave, Opaque, "film must tell its directional derivatives"),
        (Newton(), InProcessSlave, Opaque, "film must tell its directional derivatives"),
        (Newton(), Opaque, InProcessSlave, "rotor and film must get and set their state"),
    ],
)
def test_what_a_scheme_needs_is_asked_for(orbit, scheme, rotor, film, match):
    a, b, _ = orbit
    wrap = {InProcessSlave: lambda m: m, Opaque: Opaque}
    with pytest.raises(InputError, match=match):
        couple(
            wrap[rotor](InProcessSlave(a)),
            wrap[film](InProcessSlave(b)),
            macro_step=1e-4,
            duration=1e-3,
            scheme=scheme,
        )


def test_held_forces_ask_for_nothing(orbit):
    rotor, bearing, _ = orbit
    for scheme in (GaussSeidel(), Jacobi()):
        plain = couple(
            Opaque(InProcessSlave(rotor)),
            Opaque(InProcessSlave(bearing)),
            macro_step=1e-4,
            duration=5e-3,
            scheme=scheme,
        )
        assert plain.trajectory.work["film_jacobians"] == 0
        assert plain.watch.explicit_ratio is None
        better = run(rotor, bearing, 1e-4, 5e-3, scheme)
        assert_allclose(plain.trajectory.position, better.trajectory.position, atol=1e-12)


@pytest.mark.parametrize("kind", [GaussSeidel, Jacobi])
def test_degrees_are_checked(kind):
    with pytest.raises(InputError, match="degree must be 0, 1 or 2, got 3"):
        kind(degree=3)


def test_other_arguments_are_checked(orbit):
    rotor, bearing, _ = orbit
    with pytest.raises(InputError, match=r"tolerance must be finite and positive, got 0\.0"):
        Newton(tolerance=0.0)
    with pytest.raises(InputError, match=r"tolerance must be finite and positive, got -1\.0"):
        Adaptive(tolerance=-1.0)
    for other in (GaussSeidel(degree=1), Jacobi()):
        with pytest.raises(InputError, match=r"scheme must be one that takes the derivatives.* got \w+\("):
            Adaptive(scheme=other)
    with pytest.raises(InputError, match="scheme must be a Scheme"):
        Adaptive(scheme="best")
    with pytest.raises(InputError, match="scheme must be a scheme such as SIExp3"):
        cosimulate(rotor, bearing, macro_step=1e-4, duration=1e-3, scheme="best")
    with pytest.raises(InputError, match="films must be one at least, got none"):
        couple(InProcessSlave(rotor), {}, macro_step=1e-4, duration=1e-3)


def test_newton_that_does_not_converge_says_so(orbit):
    rotor, bearing, _ = orbit
    with pytest.raises(ConvergenceError, match=r"must converge in 1 iterations.*imbalance") as caught:
        run(rotor, bearing, 1e-3, 2e-2, Newton(tolerance=1e-14, most=1))
    assert caught.value.partial.trajectory.time.size >= 1
