"""A rotor with its bearings in one kernel, against the Python model and independent integrations."""

from dataclasses import replace

import numpy as np
import pytest
from fmpy.fmi2 import FMU2Model, FMU2Slave
from fmpy.fmi3 import FMU3Model, FMU3Slave
from scipy.integrate import solve_ivp

from rotorfilm import (
    EndSeal,
    FiniteSqueeze,
    FullFilm,
    JournalBearing,
    ReynoldsFilm,
    RigidRotor,
    ShortFilm,
    ShortSqueeze,
    SpeedProfile,
    SplittingFilm,
    SqueezeFilmDamper,
    equilibrium,
    simulate,
    with_springs,
)
from rotorfilm.analysis import rotor_equilibrium
from rotorfilm.bearings import AxialFeed, MapSqueeze
from rotorfilm.bearings.journal import RotatingArc
from rotorfilm.native.resource import carried_library
from rotorfilm.rotors import (
    Disk,
    ElasticMaterial,
    ReducedRotor,
    RigidShaft,
    ShaftElement,
    ShaftRotor,
    SpeedInputRotor,
    Station,
    Unbalance,
    mount,
)

BEARING = JournalBearing(radius=0.05, length=0.03, clearance=1e-4, viscosity=0.1)
WIDE = JournalBearing(radius=0.05, length=0.05, clearance=1.2e-4, viscosity=0.05)
SHORT = JournalBearing(radius=0.05, length=0.03, clearance=1e-4, viscosity=0.1, film=ShortFilm())
DAMPER = SqueezeFilmDamper(radius=0.05, length=0.02, clearance=1e-4, viscosity=0.01, film=MapSqueeze())
HEAVY = with_springs(replace(DAMPER, density=850.0), 1e6)
SEALED = replace(DAMPER, density=850.0, extent=FullFilm(), film=FiniteSqueeze(), seals=EndSeal(leakage=2e-10))
"""It adds 35 kg."""
FED = replace(DAMPER, film=ShortSqueeze(), feed=AxialFeed(start_pressure=2e4, end_pressure=1e4))
STEEL = ElasticMaterial(young_modulus=211e9, shear_modulus=81.2e9, density=7810.0)
RUN_UP = SpeedProfile((0.0, 0.01, 0.03), (100.0, 150.0, 120.0))


def shaft(speed, **options):
    piece = ShaftElement(length=1.5, outer_diameter=0.05, material=STEEL)
    return ShaftRotor(
        elements=piece.split(6),
        speed=speed,
        stations=(Station(node=0, name="left"), Station(node=6, name="right")),
        disks=(Disk.solid(2, density=7810.0, width=0.07, outer_diameter=0.28, inner_diameter=0.05),),
        unbalances=(Unbalance(node=2, unbalance=1e-3, unbalance_angle=0.4),),
        internal_damping=1e-5,
        **options,
    )


def reduced(speed):
    rotor = shaft(speed)
    return ReducedRotor(rotor=rotor, modes=2, speed=speed, gravity=rotor.gravity)


def rigid(speed=157.0, unbalance=2e-3, position=None):
    """Return a rotor of 53.5 kg in one film, at the equilibrium unless told otherwise."""
    at = equilibrium(BEARING, [0.0, -53.5 * 9.80665], 157.0).position if position is None else position
    return mount(RigidRotor(mass=53.5, speed=speed, unbalance=unbalance, position=tuple(at)), {"": BEARING})


def systems():
    """Return systems with two films of one table or of two, a free station, a profile, and a rigid rotor."""
    return {
        "two of a kind": mount(reduced(150.0), {"left": BEARING, "right": BEARING}),
        "two tables": mount(reduced(RUN_UP), {"left": BEARING, "right": WIDE}),
        "two films": mount(reduced(RUN_UP), {"left": SHORT, "right": WIDE}),
        "free station": mount(reduced(RUN_UP), {"right": WIDE}),
        "whole shaft": mount(shaft(150.0), {"left": WIDE, "right": BEARING}),
        "rigid": rigid(RUN_UP),
        "damper": mount(reduced(RUN_UP), {"left": DAMPER, "right": BEARING}),
        "sealed damper": mount(RigidRotor(mass=2.0, speed=RUN_UP, unbalance=1e-5), {"": SEALED}),
        "two dampers": mount(shaft(150.0), {"left": SEALED, "right": HEAVY}),
        "fed damper": mount(reduced(RUN_UP), {"left": FED, "right": BEARING}),
        "speed input": mount(SpeedInputRotor(rotor=reduced(150.0)), {"right": WIDE}),
        "speed input, two dampers": mount(
            SpeedInputRotor(rotor=shaft(150.0)), {"left": SEALED, "right": HEAVY}
        ),
    }


def random_state(system, rng):
    """Return a state with the journals well inside their clearance."""
    scale = np.array([signal.nominal for signal in system.states])
    return 0.1 * scale * rng.standard_normal(len(scale))


@pytest.mark.parametrize("name", systems())
@pytest.mark.parametrize("kind", [FMU2Model, FMU3Model])
def test_outputs_and_derivatives_are_those_of_python(unzipped, name, kind):
    system = systems()[name]
    client = unzipped(system).open(kind).start()
    client.fmu.enterContinuousTimeMode()
    rng = np.random.default_rng(3)
    outputs = [signal.name for signal in system.outputs]
    for _ in range(5):
        x, u = random_state(system, rng), 100.0 * rng.standard_normal(len(system.inputs))
        client.set_states(x)
        client.set(**{signal.name: value for signal, value in zip(system.inputs, u, strict=True)})
        dx, y = system.derivative(0.0, x, u), system.output(0.0, x, u)
        np.testing.assert_allclose(client.derivatives(len(x)), dx, rtol=1e-11, atol=1e-11 * abs(dx).max())
        np.testing.assert_allclose(client.get(*outputs), y, rtol=1e-12, atol=1e-12 * abs(y).max())


@pytest.mark.parametrize("name", systems())
def test_directional_derivatives_are_those_of_python(unzipped, name):
    system = systems()[name]
    client = unzipped(system).open(FMU2Model).start()
    client.fmu.enterContinuousTimeMode()
    rng = np.random.default_rng(4)
    x, u = random_state(system, rng), np.array([signal.nominal for signal in system.inputs])
    client.set_states(x)
    client.set(**{signal.name: value for signal, value in zip(system.inputs, u, strict=True)})
    A, B, C, D = system.linearization(0.0, x, u)
    knowns = [f"state_{s.name}" for s in system.states] + [s.name for s in system.inputs]
    unknowns = [f"der(m.state_{s.name})" for s in system.states] + [s.name for s in system.outputs]
    seed = np.array([s.nominal for s in (*system.states, *system.inputs)]) * rng.standard_normal(len(knowns))
    answer = client.differentiate(unknowns, knowns, seed)
    right = np.block([[A, B], [C, D]]) @ seed
    np.testing.assert_allclose(answer, right, rtol=1e-10, atol=1e-12 * np.abs(right).max())


@pytest.mark.convergence
@pytest.mark.parametrize("kind", [FMU2Slave, FMU3Slave])
def test_a_machine_whose_speed_is_an_input_follows_it_as_a_rotor_with_that_profile(unzipped, kind):
    """Held over each step, speed and acceleration in its middle: the error is of second order in the step."""
    films, end = {"left": BEARING, "right": WIDE}, 0.03
    rotor = replace(reduced(150.0), speed=100.0)
    resting = rotor_equilibrium(rotor, films, 100.0).displacement
    rotor = replace(rotor, initial=(*resting.tolist(), *[0.0] * len(resting)))
    times = np.linspace(0.0, end, 3)
    run = simulate(replace(rotor, speed=RUN_UP), films, duration=end, times=times, rtol=1e-10)
    right = np.array([run[name][-1] for name in ("left_x", "left_y", "right_x", "right_y")])
    system, errors = mount(SpeedInputRotor(rotor=rotor), films), []
    for steps in (60, 120):
        client = (
            unzipped(system, start={"prescribed_speed": 100.0}, folder=str(steps))
            .open(kind)
            .start(tolerance=1e-8)
        )
        dt = end / steps
        for k in range(steps):
            middle = (k + 0.5) * dt
            client.set(
                prescribed_speed=RUN_UP.speed(middle), prescribed_acceleration=RUN_UP.acceleration(middle)
            )
            client.step(k * dt, dt)
        assert client.get("speed") == pytest.approx(120.0, abs=1.0)
        assert client.get("state_angle") == pytest.approx(RUN_UP.angle(end), rel=1e-9)
        found = client.get("left_x", "left_y", "right_x", "right_y")
        errors.append(np.abs(found - right).max() / BEARING.clearance)
    assert errors[1] < 2e-4
    assert errors[0] / errors[1] == pytest.approx(4.0, rel=0.1)


def test_a_speed_input_without_its_acceleration_leaves_out_the_tangential_force():
    rotor = RigidRotor(mass=2.0, speed=100.0, unbalance=1e-3, unbalance_angle=0.3)
    model = SpeedInputRotor(rotor=rotor)
    x, force = np.array([1e-5, 0.0, 0.0, 0.1, 2.0]), [3.0, 4.0]
    given = replace(rotor, speed=SpeedProfile((0.0, 1.0), (0.0, 40.0)))
    t = np.sqrt(2.0 / 20.0)  # the angle 2 rad
    rates = model.derivative(0.0, x, [*force, 40.0 * t, 40.0])
    np.testing.assert_allclose(rates[:4], given.derivative(t, x[:4], force), rtol=1e-12)
    assert rates[4] == 40.0 * t
    without = model.derivative(0.0, x, [*force, 40.0 * t, 0.0])
    assert np.hypot(*(rates - without)[2:4]) == pytest.approx(1e-3 * 40.0 / 2.0)


def reference(system, end, tolerance=1e-12):
    """Return the state at `end` by an implicit method of scipy with the exact Jacobian."""
    nominal = np.array([signal.nominal for signal in system.states])
    none = np.zeros(len(system.inputs))
    x, t = system.initial_state, 0.0
    for stop in (*(time for time in system.breakpoints if 0.0 < time < end), end):
        before = np.nextafter(stop, 0.0)
        x = solve_ivp(
            lambda s, q, before=before: system.derivative(min(s, before), q, none),
            (t, stop),
            x,
            method="Radau",
            jac=lambda s, q, before=before: system.linearization(min(s, before), q, none).A,
            rtol=tolerance,
            atol=tolerance * nominal,
        ).y[:, -1]
        t = stop
    return x


@pytest.mark.long
@pytest.mark.parametrize("kind", [FMU2Slave, FMU3Slave])
@pytest.mark.parametrize("steps", [2, 60])
def test_steps_follow_an_independent_integration(unzipped, kind, steps):
    system = rigid(SpeedProfile((0.0, 0.01, 0.03), (157.0, 250.0, 157.0)))
    client, end = unzipped(system).open(kind).start(tolerance=1e-9), 0.04
    for k in range(steps):
        client.step(k * end / steps, end / steps)
    answer = client.get("x", "y")
    np.testing.assert_allclose(answer, reference(system, end)[:2], atol=1e-8 * BEARING.clearance)


@pytest.mark.parametrize("damper", [SEALED, HEAVY], ids=["sealed", "ruptured"])
def test_a_rotor_lighter_than_its_oil_follows_an_independent_integration(unzipped, damper):
    rotor = RigidRotor(mass=2.0, speed=400.0, unbalance=2e-4, position=(1e-5, 0.0), velocity=(0.0, 1e-3))
    system, end = mount(rotor, {"": damper}), 0.002
    client = unzipped(system).open(FMU2Slave).start(tolerance=1e-8)
    for k in range(20):
        client.step(k * end / 20, end / 20)
    right = reference(system, end, 1e-9)
    np.testing.assert_allclose(client.get("x", "y"), right[:2], atol=1e-6 * damper.clearance)
    np.testing.assert_allclose(client.get("mass_xx"), system.output(end, right, [])[-3], rtol=1e-5)


def test_one_degree_at_the_default_tolerance_is_the_monolithic_solution(unzipped):
    system = rigid(unbalance=4e-3)
    client, step, count = unzipped(system).open(FMU2Slave).start(), np.radians(1.0) / 157.0, 360
    for k in range(count):
        client.step(k * step, step)
    exact = reference(system, step * count)
    assert np.hypot(*(client.get("x", "y") - exact[:2])) < 1e-6 * BEARING.clearance


@pytest.mark.convergence
def test_integrator_has_order_four(unzipped):
    # The coarsest tolerance accepts every one of these steps at once, so they are steps of the formula.
    system = rigid(unbalance=4e-3)
    end = 0.5 / 157.0
    exact, errors = reference(system, end, 1e-13), []
    for steps in (8, 16, 32):
        client = unzipped(system, folder=str(steps)).open(FMU2Slave).start(tolerance=1e-3)
        for k in range(steps):
            client.step(k * end / steps, end / steps)
        errors.append(np.hypot(*(client.get("x", "y") - exact[:2])))
    orders = np.log2(np.array(errors[:-1]) / errors[1:])
    assert np.all((orders > 3.6) & (orders < 4.6)), (orders, errors)


def test_a_light_stiff_journal_takes_any_macro_step(unzipped):
    # The film alone would decay within 1 us: an explicit method or coupling fails at 1 deg, here 30 deg work.
    system = mount(reduced(150.0), {"left": BEARING, "right": BEARING})
    rates = np.linalg.eigvals(system.linearization(0.0, system.initial_state, np.zeros(0)).A).real
    assert rates.min() < -1e5
    ends = []
    for degrees, folder in ((1.0, "fine"), (30.0, "coarse")):
        client, step = unzipped(system, folder=folder).open(FMU2Slave).start(), np.radians(degrees) / 150.0
        for k in range(round(360.0 / degrees)):
            client.step(k * step, step)
        ends.append(client.get("left_x", "left_y", "right_x", "right_y"))
    np.testing.assert_allclose(ends[0], ends[1], atol=1e-6 * BEARING.clearance)


def test_a_saved_state_goes_on_to_the_last_bit(unzipped):
    system = mount(reduced(RUN_UP), {"left": BEARING, "right": WIDE})
    client = unzipped(system).open(FMU2Slave).start()
    names = [signal.name for signal in system.outputs]
    for k in range(20):
        client.step(k * 2e-4, 2e-4)
    saved = client.fmu.getFMUState()
    ends = []
    for _ in range(2):
        for k in range(20, 30):
            client.step(k * 2e-4, 2e-4)
        ends.append(client.get(*names))
        client.fmu.setFMUState(saved)
    client.fmu.freeFMUState(saved)
    assert np.array_equal(*ends)


def test_a_throw_never_passes_the_wall(unzipped):
    system = rigid(unbalance=200.0, position=(0.0, 0.0))  # 4.9 MN on a film that carries 525 N at ease
    client, answers = unzipped(system).open(FMU2Slave).start(), []
    for k in range(40):
        client.step(k * 1e-3, 1e-3)
        answers.append(client.get("x", "y"))
    eccentricities = np.hypot(*np.transpose(answers)) / BEARING.clearance
    assert 0.98 < eccentricities.max() < 1.0


def test_a_state_beyond_the_wall_is_refused(unzipped):
    client = unzipped(rigid(position=(1.1e-4, 0.0))).open(FMU2Slave)
    client.fmu.setupExperiment()
    client.fmu.enterInitializationMode()
    with pytest.raises(Exception, match="fmi2ExitInitializationMode"):
        client.fmu.exitInitializationMode()


def test_parameters_reach_their_bearing(unzipped):
    system = mount(reduced(150.0), {"left": BEARING, "right": BEARING})
    other = mount(reduced(150.0), {"left": BEARING, "right": WIDE})
    client = unzipped(system).open(FMU2Slave)
    client.fmu.setupExperiment()
    client.fmu.enterInitializationMode()
    client.set(right_length=0.05, right_clearance=1.2e-4, right_viscosity=0.05)
    client.fmu.exitInitializationMode()
    twin = unzipped(other, folder="other").open(FMU2Slave).start()
    for k in range(30):
        client.step(k * 1e-4, 1e-4)
        twin.step(k * 1e-4, 1e-4)
    names = [signal.name for signal in system.outputs]
    np.testing.assert_allclose(client.get(*names), twin.get(*names), rtol=1e-12)


def test_a_rotor_on_a_film_without_kernel_has_none():
    film = SplittingFilm(order=(4, 2), constant=True, rupture=RotatingArc())
    own = JournalBearing(radius=0.05, length=0.03, clearance=1e-4, viscosity=0.1, film=film)
    rotor = RigidShaft(
        mass=50.0,
        diametral_inertia=1.0,
        polar_inertia=0.5,
        speed=100.0,
        stations=(("left", -0.5), ("right", 0.5)),
    )
    assert mount(rotor, {"left": BEARING, "right": BEARING}).native() is not None
    assert mount(rotor, {"left": BEARING, "right": own}).native() is None


@pytest.mark.parametrize("kind", [FMU2Slave, FMU3Slave])
def test_a_rotor_on_a_grid_is_a_system_in_a_library_of_its_own(unzipped, kind):
    grid = JournalBearing(
        radius=0.05, length=0.03, clearance=1e-4, viscosity=0.1, film=ReynoldsFilm(cells=(32, 4))
    )
    rotor = RigidRotor(mass=50.0, speed=150.0, unbalance=1e-3, position=(1e-5, -3e-5))
    system = mount(rotor, {"": grid})
    assert carried_library(system.native()) == "rotorfilm_grid_systems"
    assert carried_library(mount(rotor, {"": BEARING}).native()) == "rotorfilm_systems"
    client = unzipped(system).open(kind).start()
    for k in range(50):
        client.step(k * 1e-4, 1e-4)
    run = simulate(rotor, grid, duration=5e-3, samples=2, rtol=1e-6)
    np.testing.assert_allclose(client.get("x", "y"), run.position[:, -1], atol=1e-3 * grid.clearance)
