"""A rotor that rubs in its ring: bouncing, full annular rub, rolling dry, impacts, several routes, an FMU."""

import dataclasses

import numpy as np
import pytest
from fmpy import simulate_fmu
from numpy.testing import assert_allclose
from scipy.integrate import solve_ivp
from scipy.optimize import brentq, fsolve

import rotorfilm as rf

MASS, GAP = 2.0, 2e-4
RING = rf.RubRing(gap=GAP, stiffness=1e7, radius=0.05)
FREE = rf.LinearBearing(stiffness=0.0, damping=0.0)


def rotor(**change):
    given = {"mass": MASS, "speed": 0.0, "gravity": (0.0, 0.0), **change}
    return rf.RigidRotor(**given)


@pytest.mark.closed_form
def test_bounces_without_friction_keep_the_energy():
    # Along a line: free flight over 2 gaps, then half a period of mass and ring.
    v = 0.4
    run = rf.simulate(rotor(velocity=(v, 0.0)), RING, duration=0.05, samples=4001, rtol=1e-10)
    found = rf.ring_contacts(run, RING)
    rate = np.sqrt(RING.stiffness / MASS)
    period = 2.0 * GAP / v + np.pi / rate
    begin = GAP / v + period * np.arange(len(found.begin))
    assert len(begin) > 20
    assert_allclose(found.begin, begin, atol=2e-8)
    assert_allclose(found.end[:-1], begin[:-1] + np.pi / rate, atol=2e-8)
    assert_allclose(found.normal_force[:-1], MASS * rate * v, rtol=2e-4)
    depth = np.maximum(run.position[0] - GAP, 0.0) + np.maximum(-run.position[0] - GAP, 0.0)
    energy = 0.5 * MASS * run.velocity[0] ** 2 + 0.5 * RING.stiffness * depth**2
    assert_allclose(energy, 0.5 * MASS * v**2, rtol=1e-6)


def test_oblique_bounces_keep_energy_and_angular_momentum():
    start = {"position": (1e-4, 0.0), "velocity": (0.3, 0.25)}
    run = rf.simulate(rotor(**start), RING, duration=0.02, samples=401, rtol=1e-10)
    depth = np.maximum(np.hypot(*run.position) - GAP, 0.0)
    energy = 0.5 * MASS * np.sum(run.velocity**2, axis=0) + 0.5 * RING.stiffness * depth**2
    turned = run["x"] * run["vy"] - run["y"] * run["vx"]
    assert_allclose(energy, energy[0], rtol=1e-6)
    assert_allclose(turned, turned[0], rtol=1e-6)


@pytest.mark.closed_form
@pytest.mark.parametrize("velocity", [0.2, 1.0])
def test_impact_leaves_with_the_velocity_of_hunt_and_crossley(velocity):
    ring = dataclasses.replace(RING, dissipation=0.8)
    run = rf.simulate(
        rotor(position=(0.999 * GAP, 0.0), velocity=(velocity, 0.0)),
        ring,
        duration=1.7e-3,
        samples=2,
        rtol=1e-10,
    )
    after = float(run["vx"][-1])
    assert np.hypot(*run.position[:, -1]) < GAP
    lost = ring.dissipation * velocity

    # dissipation v (1 + e) = log((1 + dissipation v)/(1 - dissipation v e))
    def left(e):
        return lost * (1.0 + e) - np.log((1.0 + lost) / (1.0 - lost * e))

    assert_allclose(-after / velocity, brentq(left, 0.2, 1.0), rtol=1e-5)


JEFFCOTT = rf.JeffcottRotor(
    mass=10.0,
    journal_mass=1.0,
    stiffness=1e6,
    speed=250.0,
    external_damping=400.0,
    unbalance=4e-3,
    gravity=(0.0, 0.0),
    disk_station="disk",
)
BEARING = rf.LinearBearing(stiffness=2e7, damping=3e3)


@pytest.mark.closed_form
def test_full_annular_rub():
    ring = rf.RubRing(gap=GAP, stiffness=5e6, radius=0.1, friction_coefficient=0.02)
    r, w = JEFFCOTT, JEFFCOTT.speed
    # The disk on its shaft and bearing, and the ring: |(Z + k (1 + i mu)) r - k gap (1 + i mu)| = u w^2.
    held = BEARING.stiffness[0][0] + 1j * w * BEARING.damping[0][0] - r.journal_mass * w**2
    Z = r.stiffness * held / (r.stiffness + held) - r.mass * w**2 + 1j * w * r.external_damping
    slip = w * ring.radius
    mu = ring.friction_coefficient

    def left(radius):
        rubbed = mu * (slip + w * radius) / np.hypot(slip + w * radius, ring.slip_velocity)
        force = ring.stiffness * (radius - ring.gap) * (1.0 + 1j * rubbed)
        return abs(Z * radius + force) - r.unbalance * w**2

    radius = brentq(left, GAP, 20 * GAP, xtol=1e-16)
    assert radius > 1.02 * GAP
    run = rf.simulate(
        rf.mount(r, {"disk": ring}), BEARING, duration=1.2, times=np.linspace(1.1, 1.2, 21), rtol=1e-9
    )
    assert_allclose(np.hypot(run["disk_x"], run["disk_y"]), radius, rtol=1e-6)
    power = ring.contact([radius, 0.0], [0.0, w * radius], w)
    assert_allclose(power.friction_force, -mu * power.normal_force, rtol=1e-5)


@pytest.mark.closed_form
def test_dry_backward_whirl_rolls():
    # Black (1968): without slip the whirl is -speed radius/eccentricity. A damper that turns the other way
    # is what friction has to overcome: slip creeps at what its share asks for.
    ring = dataclasses.replace(RING, friction_coefficient=0.3, slip_velocity=1e-3, dissipation=0.05)
    support, speed = rf.LinearBearing(stiffness=5e4, damping=20.0), 4.0

    def balance(unknown):
        e, creep = unknown * [GAP, 1e-3]
        along = -speed * ring.radius + creep
        normal = ring.stiffness * (e - GAP)
        share = creep / np.hypot(creep, ring.slip_velocity)
        inward = normal + 5e4 * e - MASS * along**2 / e
        return [inward / 100.0, normal * ring.friction_coefficient * share + 20.0 * along]

    e, creep = fsolve(balance, [1.01, 0.1], xtol=1e-14) * [GAP, 1e-3]
    both = rf.Parallel((support, ring))
    start = {"speed": speed, "position": (1.01 * GAP, 0.0), "velocity": (0.0, -0.15)}
    run = rf.simulate(rotor(**start), both, duration=1.0, times=np.linspace(0.99, 1.0, 5), rtol=1e-9)
    whirl = (run["x"] * run["vy"] - run["y"] * run["vx"]) / (run["x"] ** 2 + run["y"] ** 2)
    assert_allclose(np.hypot(*run.position), e, rtol=1e-6)
    assert_allclose(whirl, (-speed * ring.radius + creep) / e, rtol=1e-6)
    assert_allclose(whirl, -speed * ring.radius / e, rtol=1e-2)


OFF_CENTER = dataclasses.replace(RING, friction_coefficient=0.1, dissipation=0.1, ring_center=(2e-5, -3e-5))
SPRING = rf.LinearBearing(stiffness=1e6, damping=500.0)


def test_a_rigid_rotor_against_an_own_integration():
    whole = rotor(speed=300.0, unbalance=2e-3)
    run = rf.simulate(whole, rf.Parallel((SPRING, OFF_CENTER)), duration=0.02, samples=41, rtol=1e-10)
    assert "rejected" in run.work  # compiled

    def rates(t, x):
        force = SPRING.force(x[:2], x[2:], 300.0) + OFF_CENTER.force(x[:2], x[2:], 300.0)
        return [*x[2:], *(force + whole.unbalance_force(t)) / MASS]

    own = integrated(rates, np.zeros(4), run.time)
    assert_allclose(run.position, own[:2], atol=2e-10)
    assert OFF_CENTER.contact(run.position, run.velocity, 300.0).depth.max() > 0.02 * GAP


@pytest.mark.long
def test_a_station_of_a_shaft_against_an_own_integration():
    steel = rf.ElasticMaterial(young_modulus=2.1e11, shear_modulus=8e10, density=7800.0)
    piece = rf.ShaftElement(length=0.6, outer_diameter=0.03, material=steel)
    shaft = rf.ShaftRotor(
        elements=piece.split(2),
        speed=300.0,
        stations=(rf.Station(node=0, name="left"), rf.Station(node=1, name="ring"), rf.Station(node=2)),
        disks=(rf.Disk(node=1, mass=5.0, polar_inertia=0.01, diametral_inertia=0.005),),
        unbalances=(rf.Unbalance(node=1, unbalance=5e-3),),
        beam=rf.ClassicalBeam(),
    )
    whole = rf.mount(shaft, {"left": SPRING, "ring": OFF_CENTER})
    run = rf.simulate(whole, SPRING, duration=0.012, samples=13, rtol=1e-10)
    assert "rejected" in run.work  # compiled
    model = shaft.operators
    A = model.steady + 300.0 * model.by_speed

    def rates(t, x):
        seen = (model.sense @ x).reshape(3, 4)
        films = zip((SPRING, OFF_CENTER, SPRING), seen, strict=True)
        forces = np.concatenate([film.force(at[:2], at[2:], 300.0) for film, at in films])
        return A @ x + model.push @ forces + model.weight + model.unbalance @ shaft.rotating(t)

    own = model.sense @ integrated(rates, shaft.initial_state, run.time)
    assert_allclose([run["ring_x"], run["ring_y"]], own[4:6], atol=2e-9)
    depth = np.hypot(*(own[4:6].T - OFF_CENTER.ring_center).T) - GAP
    assert depth.max() > 0.02 * GAP


def integrated(rates, start, time):
    run = solve_ivp(rates, (0.0, time[-1]), start, method="DOP853", rtol=1e-10, atol=1e-13, t_eval=time)
    return run.y


def test_derivatives_of_the_ring_in_python_and_compiled():
    ring = dataclasses.replace(RING, friction_coefficient=0.2, dissipation=0.3, ring_center=(1e-5, -2e-5))
    rng = np.random.default_rng(0)
    angle, radius = rng.uniform(0.0, 2.0 * np.pi, 9), np.linspace(1e-4, 4e-4, 9)
    q, v = radius * np.array([np.cos(angle), np.sin(angle)]), rng.uniform(-0.3, 0.3, (2, 9))
    speed = rng.uniform(-6.0, 6.0, 9)
    jacobian = ring.jacobian(q, v, speed)
    for k, step in enumerate((1e-9, 1e-9, 1e-5, 1e-5, 1e-4)):
        shift = np.zeros((5, 1))
        shift[k] = step
        up, down = ((q + s * shift[:2], v + s * shift[2:4], speed + s * shift[4]) for s in (1, -1))
        slope = (ring.force(*up) - ring.force(*down)) / (2.0 * step)
        assert_allclose(slope, jacobian[:, k], atol=1e-7 * np.abs(jacobian[:, k]).max())
    from rotorfilm.core.port import compiled_force
    from rotorfilm.native import loops

    both = rf.Parallel((ring, rf.LinearBearing(stiffness=1e6, damping=30.0)))
    for reaction, name in ((ring, "rf_rub_at"), (both, "rf_both_at")):
        call = compiled_force(reaction)
        force, slopes = np.empty(2), np.empty((2, 5))
        for k in range(9):
            state = np.array([*q[:, k], *v[:, k], speed[k]])
            loops()[name](call.data, state.ctypes.data, force.ctypes.data, slopes.ctypes.data)
            one = q[:, k], v[:, k], speed[k]
            assert_allclose(force, reaction.force(*one), rtol=1e-13, atol=1e-12)
            assert_allclose(slopes, reaction.jacobian(*one), rtol=1e-12, atol=1e-7)


def test_events_change_sign_at_contact():
    assert RING.events(0.0, [], [0.99 * GAP, 0.0, 0.0, 0.0, 0.0]) < 0.0
    assert RING.events(0.0, [], [0.0, 1.01 * GAP, 0.0, 0.0, 0.0]) > 0.0
    still = RING.contact([0.5 * GAP, 0.0], [0.0, 0.0], 10.0)
    assert still.normal_force == 0.0
    assert still.friction_force == 0.0
    assert_allclose(still.depth, -0.5 * GAP)


def test_an_orbit_that_rubs():
    ring = rf.RubRing(gap=GAP, stiffness=5e6, radius=0.1, friction_coefficient=0.02)
    orbit = rf.periodic_orbit(rf.mount(JEFFCOTT, {"disk": ring, "": BEARING}))
    run = rf.simulate(rf.mount(JEFFCOTT, {"disk": ring}), BEARING, duration=1.2, samples=13, rtol=1e-8)
    disk = orbit.series[orbit.stations.index("disk")]
    at_start = disk[:, : (disk.shape[1] + 1) // 2].sum(axis=1)
    assert_allclose(np.hypot(*at_start), np.hypot(run["disk_x"], run["disk_y"])[-1], rtol=1e-5)


@pytest.mark.parametrize("kind", ["ring", "both", "seal"])
def test_as_an_fmu(kind, tmp_path):
    seal = rf.AnnularSeal(
        radius=0.05, length=0.02, clearance=3e-4, pressure_drop=1e6, viscosity=1e-3, density=1000.0
    )
    ring = dataclasses.replace(RING, friction_coefficient=0.1)
    model = {"ring": ring, "both": rf.Parallel((seal, ring)), "seal": seal}[kind]
    path = rf.export_fmu(model, tmp_path / "m.fmu", component="m", backend="python")
    start = {"x": 2.1e-4, "y": 1e-5, "vx": 0.02, "vy": -0.01, "speed": 200.0}
    names = [f"m.{signal.name}" for signal in model.outputs]
    given = {f"m.{name}": value for name, value in start.items()}
    answer = simulate_fmu(str(path), stop_time=0.1, step_size=0.1, start_values=given, output=names)
    expected = model.output(0.0, [], list(start.values()))
    assert_allclose([answer[name][-1] for name in names], expected, rtol=1e-12)


def test_parallel_reactions_add_up():
    film = rf.JournalBearing(radius=0.05, length=0.02, clearance=3e-4, viscosity=0.02)
    both, q, v = rf.Parallel((film, RING)), np.array([2.5e-4, 0.0]), np.array([0.0, 0.01])
    assert both.clearance == film.clearance
    assert_allclose(both.force(q, v, 50.0), film.force(q, v, 50.0) + RING.force(q, v, 50.0))
    with pytest.raises(rf.FilmContactError):
        both.force([3.1e-4, 0.0], v, 50.0)
    with pytest.raises(rf.InputError, match="reactions must be two at least, got 1"):
        rf.Parallel((film,))
    with pytest.raises(rf.InputError, match=r"reactions\[1\] must be a Reaction"):
        rf.Parallel((film, 3.0))


def test_where_one_of_two_touches_its_wall_nothing_is_added():
    from rotorfilm.core.port import compiled_force
    from rotorfilm.native import Status, loops

    film = rf.JournalBearing(radius=0.05, length=0.02, clearance=3e-4, viscosity=0.02)
    call = compiled_force(rf.Parallel((RING, film)))
    state, force, slopes = np.array([3.1e-4, 0.0, 0.0, 0.01, 50.0]), np.empty(2), np.empty((2, 5))
    status = loops()["rf_both_at"](call.data, state.ctypes.data, force.ctypes.data, slopes.ctypes.data)
    assert status == Status.AT_WALL
    assert_allclose(slopes, RING.jacobian(state[:2], state[2:4], 50.0), rtol=1e-12, atol=1e-7)


def test_what_a_ring_refuses():
    with pytest.raises(rf.InputError, match="gap must be finite and positive"):
        rf.RubRing(gap=0.0, stiffness=1e7, radius=0.05)
    with pytest.raises(rf.InputError, match="ring_center must be a pair of numbers"):
        rf.RubRing(gap=GAP, stiffness=1e7, radius=0.05, ring_center=(0.0,))
    run = rf.simulate(rotor(), RING, duration=1e-3, samples=2)
    with pytest.raises(rf.InputError, match="disk_x"):
        rf.ring_contacts(run, RING, station="disk")
    with pytest.raises(rf.InputError, match="ring must be a RubRing, got LinearBearing"):
        rf.ring_contacts(run, rf.LinearBearing(stiffness=1e6))
