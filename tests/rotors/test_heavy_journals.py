"""Rotors that carry the oil of their dampers: small motion, orbits, time, FMUs, and what refuses."""

import fmpy
import numpy as np
import pytest
from numpy.testing import assert_allclose

import rotorfilm as rf
from rotorfilm import InputError

SIZE = {"radius": 0.05, "length": 0.02, "clearance": 1e-4, "viscosity": 5e-3}
STIFFNESS, MASS, SPEED = 2e6, 3.0, 600.0
DAMPERS = {
    "full": rf.SqueezeFilmDamper(**SIZE, density=850.0, extent=rf.FullFilm()),
    "ruptured": rf.SqueezeFilmDamper(**SIZE, density=850.0),
    # heavier than the rotor: an explicit exchange of accelerations would diverge
    "sealed": rf.SqueezeFilmDamper(
        **SIZE,
        density=850.0,
        extent=rf.FullFilm(),
        film=rf.FiniteSqueeze(),
        seals=rf.EndSeal(leakage=1e-11),
    ),
}
FULL = DAMPERS["full"]


def sprung(damper):
    return rf.with_springs(damper, STIFFNESS)


def rotor(unbalance=1e-4, **more):
    return rf.RigidRotor(mass=MASS, speed=SPEED, unbalance=unbalance, gravity=(0.0, 0.0), **more)


def test_transmissibility_is_one_at_the_crossing_and_levels_off():
    # |T| = 1 at omega^2 = 2 K/(m + 2 M), whatever the damping; M/(m + M) far above.
    added = float(FULL.mass([0.0, 0.0])[0, 0])
    assert_allclose(added, np.pi * 850.0 * 0.05 * 0.02**3 / (10.0 * 1e-4), rtol=1e-12)
    T = rf.small_motion_transmissibility(rotor(), sprung(FULL))
    crossing = np.sqrt(2.0 * STIFFNESS / (MASS + 2.0 * added))
    assert_allclose(abs(T(1j * crossing)), 1.0, rtol=1e-12)
    assert abs(abs(T(1j * np.sqrt(2.0 * STIFFNESS / MASS))) - 1.0) > 0.01
    assert_allclose(abs(T(1e7j)), added / (MASS + added), rtol=1e-5)
    # The closed loop takes the mass into that of the rotor; its housing feels the force of the oil.
    at = rf.equilibrium(sprung(FULL), [0.0, -1e-3], SPEED)
    loop = rf.closed_loop(rotor(), sprung(FULL), at)
    for s in (100.0j, 1j * crossing, 1e4j):
        assert_allclose(loop(s)[4, 0], T(s), rtol=1e-6)


@pytest.mark.parametrize("name", DAMPERS)
def test_an_orbit_lasts(name):
    # The radius by the explicit balance, the motion by integration, the exponents by both linear systems.
    support = sprung(DAMPERS[name])
    (orbit,) = rf.synchronous_orbits(rotor(), support).at(1e-4)
    radius = orbit.eccentricity_ratio * 1e-4
    position = radius * np.array([np.cos(orbit.phase), np.sin(orbit.phase)])
    velocity = SPEED * np.array([-position[1], position[0]])
    start = [*position, *velocity]
    run = rf.simulate(rotor(), support, duration=0.01, initial_state=start, samples=11, rtol=1e-7)
    assert_allclose(np.hypot(*run.position), radius, rtol=1e-5)
    housing = np.hypot(run["force_x"], run["force_y"]) / (1e-4 * SPEED**2)
    assert_allclose(housing, orbit.transmissibility, rtol=1e-5)
    poles = rf.analysis.orbit_system(rotor(), support, orbit).poles()
    assert_allclose(poles.real.max(), orbit.growth_rate, rtol=1e-9)


@pytest.mark.parametrize("name", DAMPERS)
def test_orbits_are_the_explicit_balance(name):
    # u w^2 = |-(m w^2 e + F_r) + i F_t| with F = force - mass a, a = -w^2 e
    damper = DAMPERS[name]
    (orbit,) = rf.synchronous_orbits(rotor(), sprung(damper)).at(1e-4)
    e = np.array([orbit.eccentricity_ratio * 1e-4, 0.0])
    v = np.array([0.0, SPEED * e[0]])
    force = damper.force(e, v) - STIFFNESS * e + damper.mass(e, v) @ (SPEED**2 * e)
    assert_allclose(np.hypot(MASS * SPEED**2 * e[0] + force[0], force[1]), 1e-4 * SPEED**2, rtol=1e-9)
    found = rf.orbit_coefficients(sprung(damper), orbit.eccentricity_ratio, SPEED)
    assert_allclose([-found.stiffness * e[0], -found.damping * v[1]], force, rtol=1e-12)


def test_folds_feel_the_inertia_of_the_film():
    # The slope of u^2 along the orbits, exact, against differences: folds are its zeros.
    from rotorfilm.analysis.circular_orbits import orbit_points, orbit_rotor, orbit_slope

    for damper in DAMPERS.values():
        system = orbit_rotor(rotor(), sprung(damper))
        eps = np.array([0.2, 0.6, 0.8])
        up, down = (np.abs(orbit_points(system, eps + d)[0]) ** 2 for d in (1e-6, -1e-6))
        assert_allclose(orbit_slope(system, eps).slope * 1e-4, (up - down) / 2e-6, rtol=1e-6)


@pytest.mark.parametrize("name", DAMPERS)
def test_mounted_rotor_has_the_derivatives_of_its_equations(name):
    mounted = rf.mount(rotor(position=(3e-5, 1e-5), velocity=(0.01, 0.02)), {"": sprung(DAMPERS[name])})
    x, none = mounted.initial_state, np.zeros(0)
    found = mounted.linearization(0.0, x, none)
    for k, step in enumerate((1e-10, 1e-10, 1e-7, 1e-7)):
        shift = np.zeros(4)
        shift[k] = step
        up, down = x + shift, x - shift
        rate = (mounted.derivative(0.0, up, none) - mounted.derivative(0.0, down, none)) / (2.0 * step)
        assert_allclose(found.A[:, k], rate, atol=1e-6 * np.abs(found.A[:, k]).max())
        seen = (mounted.output(0.0, up, none) - mounted.output(0.0, down, none)) / (2.0 * step)
        assert_allclose(found.C[:, k], seen, atol=1e-6 * np.abs(found.C[:, k]).max())
    # (m + M) a = F + springs + unbalance, solved by hand
    damper, q, v = DAMPERS[name], x[:2], x[2:]
    force = damper.force(q, v) - STIFFNESS * q + rotor().unbalance_force(0.0)
    by_hand = np.linalg.solve(MASS * np.eye(2) + damper.mass(q, v), force)
    assert_allclose(mounted.derivative(0.0, x, none)[2:], by_hand, rtol=1e-10)


def test_a_flexible_shaft_carries_the_mass_too():
    # On both journals the force is F - M a, a being the acceleration that this very force gives the shaft.
    shaft = shaft_of()
    mounted = rf.mount(shaft, {"left": sprung(FULL), "right": sprung(DAMPERS["ruptured"])})
    x = 1e-5 * np.random.default_rng(3).normal(size=len(mounted.states))
    x[len(x) // 2 :] *= 300.0
    out, none = [signal.name for signal in mounted.outputs], np.zeros(0)
    values = mounted.output(0.0, x, none)
    rates = mounted.linearization(0.0, x, none).C[: len(shaft.outputs)] @ mounted.derivative(0.0, x, none)
    for name, damper in (("left", FULL), ("right", DAMPERS["ruptured"])):
        at = [out.index(f"{name}_{signal}") for signal in ("x", "y", "vx", "vy", "force_x", "force_y")]
        q, v, force = values[at[:2]], values[at[2:4]], values[at[4:]]
        bare = damper.force(q, v) - STIFFNESS * q
        assert_allclose(force, bare - damper.mass(q, v) @ rates[at[2:4]], rtol=1e-8)
        assert np.abs(force - bare).max() > 0.01 * np.abs(bare).max()


def test_a_shaft_with_a_free_station_has_the_derivatives_of_its_equations():
    # The shaft's own accelerations and the force at the free end move the mass of the other end.
    mounted = rf.mount(shaft_of(), {"left": sprung(FULL)})
    rng = np.random.default_rng(5)
    x, u = 1e-5 * rng.normal(size=len(mounted.states)), rng.normal(size=len(mounted.inputs))
    x[len(x) // 2 :] *= 300.0
    found = mounted.linearization(0.0, x, u)

    def seen(by):
        state, force = x + by[: len(x)], u + by[len(x) :]
        parts = mounted.derivative(0.0, state, force), mounted.output(0.0, state, force)
        return np.concatenate(parts)

    whole = np.block([[found.A, found.B], [found.C, found.D]])
    half = len(x) // 2
    steps = np.concatenate([np.full(half, 1e-8), np.full(half, 1e-4), np.full(len(u), 1.0)])
    for k, step in enumerate(steps):
        shift = np.eye(len(x) + len(u))[k] * step
        slope = (seen(shift) - seen(-shift)) / (2.0 * step)
        assert_allclose(whole[:, k], slope, atol=1e-6 * np.abs(whole[:, k]).max(), rtol=1e-6)


@pytest.mark.parametrize(
    "ask",
    [
        lambda damper: rf.whirl_threshold(damper, load=[0.0, -10.0], mass=MASS),
        lambda damper: rf.analysis.coefficient_table(damper, [0.0, -10.0], [100.0]),
    ],
    ids=["whirl_threshold", "coefficient_table"],
)
def test_what_knows_no_added_mass_refuses_it(ask):
    with pytest.raises(InputError, match="must not add the mass of its oil to the rotor"):
        ask(sprung(FULL))


def shaft_of():
    steel = rf.ElasticMaterial(young_modulus=2e11, shear_modulus=8e10, density=7800.0)
    piece = rf.ShaftElement(length=0.2, outer_diameter=0.05, material=steel)
    ends = (rf.Station(node=0, name="left"), rf.Station(node=1, name="right"))
    return rf.ShaftRotor(elements=(piece,), stations=ends, speed=SPEED)


@pytest.mark.long
def test_an_fmu_of_film_and_rotor_moves_as_the_simulation(tmp_path):
    # The film alone tells force and mass; its exchange with a rotor that takes no mass is refused.
    start = rotor(position=(2e-5, 0.0))
    mounted = rf.mount(start, {"": sprung(FULL)})
    whole = rf.export_fmu(mounted, tmp_path / "whole.fmu", component="whole")
    run = fmpy.simulate_fmu(str(whole), stop_time=2e-3, output_interval=1e-3, relative_tolerance=1e-8)
    right = rf.simulate(start, sprung(FULL), duration=2e-3, times=[2e-3], rtol=1e-9)
    assert_allclose(run["whole.x"][-1], right["x"][-1], rtol=1e-5)
    assert_allclose(run["whole.force_x"][-1], right["force_x"][-1], rtol=1e-4)
    film = rf.export_fmu(FULL, tmp_path / "film.fmu", component="film", start={"x": 3e-5, "vx": 0.01})
    told = fmpy.simulate_fmu(str(film), stop_time=1e-3)[-1]
    mass = FULL.mass([3e-5, 0.0], [0.01, 0.0])
    assert_allclose([told["film.mass_xx"], told["film.mass_yy"]], np.diag(mass), rtol=1e-12)
    bare = rf.export_fmu(start, tmp_path / "rotor.fmu", component="rotor")
    with pytest.raises(InputError, match="film must not add mass to a rotor without inputs for it"):
        rf.cosimulate(bare, film, macro_step=1e-5, duration=1e-4)


def test_a_rotor_too_fast_for_the_inertia_is_told():
    fast = rf.RigidRotor(mass=MASS, speed=2e4, unbalance=1e-4, gravity=(0.0, 0.0))
    for ask in (
        lambda: rf.simulate(fast, sprung(FULL), duration=1e-3),
        lambda: rf.synchronous_orbits(fast, sprung(FULL)),
        lambda: rf.mount(fast, {"": sprung(FULL)}),
    ):
        with pytest.raises(InputError, match="squeeze Reynolds number must not exceed 20"):
            ask()
