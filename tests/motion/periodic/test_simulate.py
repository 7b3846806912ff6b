"""Compiled integration against closed forms, against an independent integrator, and at the wall."""

from dataclasses import dataclass

import numpy as np
import pytest
from scipy.integrate import solve_ivp
from scipy.linalg import expm

from rotorfilm import (
    ClassicalBeam,
    ContactError,
    ConvergenceError,
    Disk,
    ElasticMaterial,
    InputError,
    JournalBearing,
    LinearBearing,
    RigidRotor,
    ShaftElement,
    ShaftRotor,
    SpeedProfile,
    Station,
    Unbalance,
    ValidityWarning,
    mount,
    periodic_orbit,
    reduce_rotor,
    rotor_equilibrium,
    simulate,
    simulate_rotor,
)
from rotorfilm.analysis.collocation import radau_scheme
from rotorfilm.analysis.compiled_march import March
from rotorfilm.analysis.compiled_rotor import modal_rotor, take_apart
from rotorfilm.bearings.reaction import StaticReaction

BEARING = JournalBearing(radius=0.05, length=0.03, clearance=1e-4, viscosity=0.1)
STEEL = ElasticMaterial(young_modulus=211e9, shear_modulus=81.2e9, density=7810.0)


def shaft(speed=400.0, **changes):
    piece = ShaftElement(length=1.5, outer_diameter=0.05, material=STEEL)
    disk = {"density": 7810.0, "width": 0.07, "inner_diameter": 0.05}
    parts = {
        "elements": piece.split(6),
        "disks": (Disk.solid(2, outer_diameter=0.28, **disk), Disk.solid(4, outer_diameter=0.35, **disk)),
        "stations": (Station(node=0, name="left"), Station(node=6, name="right")),
        "unbalances": (
            Unbalance(node=2, unbalance=2e-3),
            Unbalance(node=4, unbalance=1e-3, unbalance_angle=1.0),
        ),
        "beam": ClassicalBeam(),
        "speed": speed,
    }
    return ShaftRotor(**(parts | changes))


@dataclass(frozen=True, kw_only=True)
class BrokenBearing(StaticReaction):
    """Answers with a number that is none, or, without one, raises an error of its own."""

    answer: float | None
    clearance: float = 1e-4
    nominal_force = 1.0

    def prepared_force(self, q, v, omega):
        if self.answer is None:
            raise ZeroDivisionError("mine")
        return np.stack([np.full(q.shape[1:], self.answer), np.zeros(q.shape[1:])])

    def prepared_jacobian(self, q, v, omega):
        return np.zeros((2, 5, *q.shape[1:]))


def rigid(**changes):
    values = {"mass": 53.5, "speed": 157.08, "unbalance": 2e-3, "position": (1e-5, -2e-5)}
    return RigidRotor(**(values | changes))


@pytest.mark.closed_form
def test_flexible_rotor_on_springs_is_the_matrix_exponential():
    rotor = shaft(internal_damping=1e-5, gravity=(0.0, 0.0), unbalances=())
    bearing = LinearBearing(stiffness=((2e6, 5e5), (-5e5, 3e6)), damping=800.0)
    mounted = mount(rotor, {"left": bearing, "right": bearing})
    start = 1e-5 * np.sin(np.arange(56.0))
    times = np.array([0.0, 0.011, 0.02, 0.05])
    run = simulate_rotor(mounted, duration=0.05, times=times, initial_state=start, rtol=1e-9)
    A = mounted.linearization(0.0, start, []).A
    sense = mounted.rotor.linearization(0.0, start, np.zeros(4)).C
    for k, t in enumerate(times):
        exact = (sense @ expm(A * t) @ start)[:4]
        found = [run[f"left_{name}"][k] for name in ("x", "y", "vx", "vy")]
        assert found[:2] == pytest.approx(exact[:2], abs=1e-12)
        assert found[2:] == pytest.approx(exact[2:], abs=1e-12 * 400.0)


def test_rigid_rotor_agrees_with_the_general_integrator():
    times = np.linspace(0.0, 0.12, 40)
    run = simulate_rotor(mount(rigid(), {"": BEARING}), duration=0.12, times=times, rtol=1e-9)
    other = simulate(rigid(), BEARING, duration=0.12, times=times, rtol=1e-9)
    assert run.position == pytest.approx(other.position, abs=3e-8 * 1e-4)
    assert run.velocity == pytest.approx(other.velocity, abs=1e-6 * 1e-4 * 157.0)
    for name in ("force_x", "force_y"):
        assert run[name] == pytest.approx(other[name], abs=1e-5 * 525.0)


@pytest.mark.long
def test_flexible_rotor_agrees_with_an_independent_integrator():
    films = {"left": BEARING, "right": BEARING}
    small = reduce_rotor(shaft(), frequency=800.0, tolerance=1e-1).rotor
    mounted = mount(small, films)
    start = np.zeros(len(mounted.states))
    run = simulate_rotor(mounted, duration=0.05, samples=11, initial_state=start, rtol=1e-9)
    scale = np.array([signal.nominal for signal in mounted.states])
    other = solve_ivp(
        lambda t, x: mounted.derivative(t, x, []),
        (0.0, 0.05),
        start,
        method="Radau",
        t_eval=run.time,
        jac=lambda t, x: mounted.linearization(t, x, []).A,
        rtol=1e-8,
        atol=1e-8 * scale,
    )
    for name in ("left", "right"):
        rows = [mounted.rotor.output(t, x, np.zeros(4)) for t, x in zip(other.t, other.y.T, strict=True)]
        at = [signal.name for signal in mounted.rotor.outputs].index(f"{name}_x")
        assert run[f"{name}_x"] == pytest.approx(np.array(rows)[:, at], abs=2e-6 * 1e-4)


@pytest.mark.convergence
@pytest.mark.parametrize("stages", [2, 3, 4])
def test_order_of_the_scheme(stages):
    # On an orbit and without stiffness; a fast film is integrated with order stages + 1.
    thin = JournalBearing(radius=0.05, length=0.03, clearance=1e-4, viscosity=0.01)
    mounted = mount(rigid(speed=628.0, unbalance=5e-4), {"": thin})
    orbit = periodic_orbit(mounted, tolerance=1e-11)
    parts = take_apart(mounted)
    modal = modal_rotor(parts, parts.speed)

    def end(steps):
        length = orbit.period / steps
        state = modal.modal(orbit.state)
        run = March(modal=modal, state=state, rtol=1e9, longest=length, duration=orbit.period, stages=stages)
        run._struct.step, run._struct.newton = 0, 1e-13
        return modal.physical(run.to(orbit.period, np.array([orbit.period]))[0])[:2]

    exact = end(640)
    steps = np.array([4, 8, 16]) if stages == 4 else np.array([8, 16, 32])
    errors = [np.abs(end(int(n)) - exact).max() for n in steps]
    order = np.polyfit(np.log(steps), -np.log(errors), 1)[0]
    assert order == pytest.approx(2 * stages - 1, abs=0.3)


@pytest.mark.closed_form
@pytest.mark.parametrize("stages", [2, 3, 4, 5, 8])
def test_scheme_integrates_what_radau_does(stages):
    nodes, lagrange, remainder = radau_scheme(stages)
    weights = lagrange @ (1.0 / np.arange(1, stages + 1))
    for power in range(2 * stages - 1):
        # Powers of time cancel the more the higher they are, in each BLAS kernel a little differently.
        assert weights @ nodes**power == pytest.approx(1.0 / (power + 1), rel=1e-11 if stages == 8 else 1e-12)
    assert np.polynomial.polynomial.polyval(nodes, remainder) == pytest.approx(np.zeros(stages), abs=1e-11)
    assert remainder[0] == 1.0


@pytest.mark.parametrize("rtol", [1e-4, 1e-6, 1e-8])
def test_tolerance_is_kept(rtol):
    mounted = mount(rigid(), {"": BEARING})
    exact = simulate_rotor(mounted, duration=0.2, rtol=1e-12)
    run = simulate_rotor(mounted, duration=0.2, rtol=rtol)
    assert np.abs(run.position - exact.position).max() < 3.0 * rtol * 1e-4


def test_high_order_takes_fewer_steps_to_the_same_motion():
    mounted = mount(rigid(), {"": BEARING})
    low, high = (simulate_rotor(mounted, duration=0.05, rtol=rtol) for rtol in (1.01e-11, 0.99e-11))
    assert np.abs(high.position - low.position).max() < 1e-10 * 1e-4
    assert high.work["steps"] < 0.5 * low.work["steps"]


def test_run_up_of_a_rigid_rotor():
    profile = SpeedProfile(times=(0.0, 0.05, 0.1), speeds=(20.0, 220.0, 150.0))
    times = np.linspace(0.0, 0.1, 21)
    rotor = rigid(speed=profile)
    run = simulate_rotor(mount(rotor, {"": BEARING}), duration=0.1, times=times, rtol=1e-9)
    other = simulate(rotor, BEARING, duration=0.1, times=times, rtol=1e-9)
    assert run.position == pytest.approx(other.position, abs=1e-7 * 1e-4)
    assert run["speed"] == pytest.approx(other["speed"])


def test_rest_stays_at_rest():
    rotor = shaft(unbalances=(), speed=150.0)
    films = {"left": BEARING, "right": BEARING}
    at = rotor_equilibrium(rotor, films, 150.0)
    start = np.concatenate([at.displacement, np.zeros(28)])
    run = simulate_rotor(mount(rotor, films), duration=0.1, initial_state=start)
    assert np.ptp(run["left_x"]) < 1e-8 * 1e-4
    assert run["left_force_y"] == pytest.approx(-at.loads["left"][1], rel=1e-6)


@pytest.mark.filterwarnings("ignore:eccentricity ratio .* is beyond the map", "ignore:the least film")
def test_a_journal_beyond_its_map_is_told_with_the_error_of_its_film():
    thrown = rigid(position=(0.9995e-4, 0.0), gravity=(0.0, 0.0))
    with pytest.warns(ValidityWarning, match=r"journal went beyond .* film at the wall, within 2 %$"):
        simulate_rotor(mount(thrown, {"": BEARING}), duration=1e-4)


def test_wall_keeps_the_partial_result(cubic_bearing):
    spring = LinearBearing(stiffness=1e6, damping=10.0)
    soft = cubic_bearing(stiffness=1e4, hardening=0.0, damping=1.0, clearance=1e-4)
    rotor = shaft(unbalances=(), gravity=(0.0, 0.0))
    start = np.zeros(56)
    start[28:42:2] = 0.5
    with pytest.raises(ContactError, match="wall at t = ") as caught:
        simulate_rotor(
            mount(rotor, {"left": soft, "right": spring}), duration=0.1, initial_state=start, samples=100001
        )
    partial = caught.value.partial
    assert 100 < len(partial.time) < 1000
    assert 0.98 < np.hypot(partial["left_x"], partial["left_y"])[-1] / 1e-4 < 1.0


@pytest.mark.parametrize(
    ("changes", "message"),
    [
        ({"duration": 0.0}, "duration must be"),
        ({"duration": 1.0, "rtol": -1.0}, "rtol must be"),
        ({"duration": 1.0, "samples": 1}, "samples must be"),
        ({"duration": 1.0, "times": [0.5, 0.2]}, "times must increase"),
        ({"duration": 1.0, "initial_state": [0.0]}, "initial_state must have shape"),
    ],
)
def test_arguments_are_checked(changes, message):
    with pytest.raises(InputError, match=message):
        simulate_rotor(mount(rigid(), {"": BEARING}), **changes)


@pytest.mark.parametrize("value", [np.nan, np.inf])
def test_a_force_that_is_no_number_ends_the_run(value):
    broken = BrokenBearing(answer=value)
    with pytest.raises(ConvergenceError, match="film force must be finite"):
        simulate_rotor(mount(rigid(), {"": broken}), duration=0.01)


def test_an_error_of_a_bearing_in_python_arrives():
    with pytest.raises(ZeroDivisionError, match="mine"):
        simulate_rotor(mount(rigid(), {"": BrokenBearing(answer=None)}), duration=0.01)
