"""The annular seal against closed forms of others, and against the perturbed bulk flow solved in full."""

import re

import numpy as np
import pytest
from numpy.testing import assert_allclose
from scipy.integrate import solve_ivp
from seal_range import SPEED, BulkFlow, fitted

import rotorfilm as rf
from rotorfilm.bearings import seal as short_seal

WATER = {"viscosity": 1e-3, "density": 1000.0}


def seal(slenderness=0.2, **change):
    size = {"radius": 0.05, "length": 0.1 * slenderness, "clearance": 2e-4, "pressure_drop": 1e6}
    return rf.AnnularSeal(**{**size, **WATER, "inlet_loss": 0.2, **change})


@pytest.mark.literature
def test_the_coefficients_of_black():
    # mu_0, mu_1, mu_2 of Black (1969) with friction that does not depend on the Reynolds number.
    own = seal(friction=rf.bearings.HirsFriction(coefficient=0.008, exponent=0.0), inlet_loss=0.5)
    found, flow = own.matrices(0.0), own.flow(0.0)
    a, sigma = 1.5, flow.friction_factor * own.length / own.clearance
    D, transit = a + 2.0 * sigma, own.length / flow.axial_velocity
    scale = np.pi * own.radius * own.pressure_drop / flow.friction_factor
    mu_0 = a * sigma**2 / D**2
    mu_1 = (a**2 * sigma + a * (1 + 4 * a / 3) * sigma**2 + 10 / 3 * a * sigma**3 + 4 / 3 * sigma**4) / D**3
    mu_2 = a**2 * (2 * a / 3 - 1) * sigma + a * (2 * a - 1) * sigma**2 + 2 * a * sigma**3 + 4 / 3 * sigma**4
    assert_allclose(found.K, scale * mu_0, rtol=1e-12)
    assert_allclose(found.C, scale * mu_1 * transit, rtol=1e-12)
    assert_allclose(found.M, scale * mu_2 / D**4 * transit**2, rtol=1e-12)


@pytest.mark.closed_form
def test_fluid_at_half_speed_turns_the_resting_seal():
    own = seal()
    K, k, C, c, M = own.matrices(SPEED)
    assert_allclose(k, 0.5 * SPEED * C, rtol=1e-13)
    assert_allclose(c, SPEED * M, rtol=1e-13)
    # Against a shaft and a seal that both turn with the fluid nothing but K0 is left.
    whirl = 0.5 * SPEED
    turned = BulkFlow(own, SPEED, short=True).impedance(whirl)
    assert_allclose(K + c * whirl - M * whirl**2, turned.real, rtol=1e-9)
    assert abs(turned.imag) < 1e-9 * turned.real


@pytest.mark.closed_form
def test_laminar_flow_is_the_short_bearing():
    laminar = rf.bearings.HirsFriction(coefficient=24.0, exponent=-1.0)
    own = seal(0.1, viscosity=0.2, pressure_drop=1e4, friction=laminar)
    K, k, C, _, M = own.matrices(SPEED)
    mu, R, L, c = own.viscosity, own.radius, own.length, own.clearance
    assert_allclose(C, np.pi * mu * R * L**3 / c**3, rtol=2e-3)
    assert_allclose(k, 0.5 * SPEED * C, rtol=1e-12)
    # 6/5 of this with the profile of the velocity, which a bulk flow does not see.
    assert_allclose(M, np.pi * own.density * R * L**3 / (12.0 * c), rtol=2e-2)
    assert_allclose(own.flow(0.0).axial_velocity, c**2 * 1e4 / (12.0 * mu * L), rtol=1e-3)
    assert_allclose(K, -M * (0.5 * SPEED) ** 2 + laminar_rise(own), rtol=5e-2)


@pytest.mark.convergence
@pytest.mark.parametrize("viscosity", [0.02, 0.05, 0.2])
def test_swirl_that_laminar_flow_loses_at_once(viscosity, monkeypatch):
    # Oil loses its swirl within 1/1600 to 1/26000 of the length.
    laminar = rf.bearings.HirsFriction(coefficient=24.0, exponent=-1.0)
    size = {"length": 0.02, "clearance": 1e-4, "viscosity": viscosity, "density": 870.0, "inlet_swirl": 0.0}
    own, speeds = seal(**size, friction=laminar), np.array([100.0, SPEED])
    found = own.matrices(speeds)
    nodes, weights = np.polynomial.legendre.leggauss(1500)
    monkeypatch.setattr(short_seal, "PLACES", (0.5 * (nodes + 1.0)) ** 2)
    monkeypatch.setattr(short_seal, "WEIGHTS", 0.5 * weights * (nodes + 1.0))
    for value, reference in zip(found, own.matrices(speeds), strict=True):
        assert_allclose(value, reference, rtol=1e-5)


def laminar_rise(own):
    """Return the stiffness of a laminar seal at rest, whose inlet loses little: (1 - m) sigma E as m = -1."""
    at_rest = own.matrices(0.0)
    entrance, flow = 1.0 + own.inlet_loss, own.flow(0.0)
    loss = flow.friction_factor * own.length / own.clearance
    scale = np.pi * own.radius * own.length * own.density * flow.axial_velocity**2 / own.clearance
    assert_allclose(at_rest.K, scale * loss * entrance / (entrance + loss), rtol=1e-12)
    return at_rest.K


@pytest.mark.convergence
def test_the_impedance_to_second_order():
    own, errors = seal(), []
    K, k, C, c, M = own.matrices(SPEED)
    flow = BulkFlow(own, SPEED, short=True)
    for shift in (400.0, 800.0):
        whirl = 0.5 * SPEED + shift
        closed = K - 1j * k + 1j * whirl * (C - 1j * c) - M * whirl**2
        errors.append(abs(closed - flow.impedance(whirl)))
    assert 2.8 < np.log2(errors[1] / errors[0]) < 3.2


@pytest.mark.parametrize("swirl", [0.5, 0.3])
def test_against_the_bulk_flow_of_finite_length(swirl):
    errors = {}
    for slenderness in (0.1, 0.2):
        own = seal(slenderness, inlet_swirl=swirl)
        reference = fitted(BulkFlow(own, SPEED), SPEED)
        errors[slenderness] = np.array(own.matrices(SPEED)) / reference - 1.0
    assert np.abs(errors[0.2]).max() < 0.05
    assert 3.0 < errors[0.2][0] / errors[0.1][0] < 5.0  # as length^2


def test_swirl_that_the_moving_gap_disturbs_counts_in_very_short_seals():
    own = seal(0.05, inlet_swirl=0.3)
    reference = fitted(BulkFlow(own, SPEED), SPEED)
    assert_allclose(own.matrices(SPEED).k, reference[1], rtol=5e-3)  # without that effect it is 11 % off


@pytest.mark.parametrize(("swirl", "tolerance"), [(0.5, 1e-9), (0.0, 1e-2)])
def test_leakage(swirl, tolerance):
    own = seal(inlet_swirl=swirl)
    flow = BulkFlow(own, SPEED)

    def rates(z, y):
        drag, _ = flow.friction(y[0])
        return [flow.slowed(y[0]), 0.5 * drag.sum() * flow.V * own.density / own.clearance]

    run = solve_ivp(rates, (0.0, own.length), [flow.surface * swirl, 0.0], rtol=1e-11, atol=1e-9)
    needed = run.y[1, -1] + 0.5 * own.density * (1.0 + own.inlet_loss) * flow.V**2
    assert_allclose(needed, own.pressure_drop, rtol=tolerance)
    through = 2.0 * np.pi * own.radius * own.clearance * flow.V
    assert_allclose(own.flow(SPEED).leakage_flow, through, rtol=1e-14)


def test_derivatives_and_symmetries():
    own, rng = seal(inlet_swirl=0.2), np.random.default_rng(3)
    q, v = rng.uniform(-5e-5, 5e-5, (2, 3)), rng.uniform(-0.02, 0.02, (2, 3))
    speed = np.array([-400.0, 10.0, 350.0])
    jacobian, slopes = own.jacobian(q, v, speed), own.mass_slopes(q, v, speed)
    for k, step in enumerate((1e-5, 1e-5, 1e-3, 1e-3, 0.1)):
        shift = np.zeros((5, 1))
        shift[k] = step
        up, down = ((q + s * shift[:2], v + s * shift[2:4], speed + s * shift[4]) for s in (1, -1))
        by_force = (own.force(*up) - own.force(*down)) / (2.0 * step)
        assert_allclose(by_force, jacobian[:, k], atol=1e-6 * np.abs(jacobian[:, k]).max())
        by_mass = (own.mass(*up) - own.mass(*down)) / (2.0 * step)
        assert_allclose(by_mass, slopes[:, :, k], atol=1e-6 * np.abs(slopes).max())
    mirror = np.array([[1.0], [-1.0]])
    assert_allclose(own.force(mirror * q, mirror * v, -speed), mirror * own.force(q, v, speed), rtol=1e-12)
    one = [own.force(q[:, j], v[:, j], speed[j]) for j in range(3)]
    assert_allclose(own.force(q, v, speed), np.transpose(one), rtol=1e-14)


def test_a_rotor_that_runs_up_with_the_mass_of_the_fluid():
    own = seal()
    profile = rf.SpeedProfile(times=(0.0, 0.004), speeds=(50.0, 600.0))
    rotor = rf.RigidRotor(mass=3.0, speed=profile, unbalance=1e-4, position=(2e-5, 1e-5))
    run = rf.simulate(rotor, own, duration=0.004, samples=9, rtol=1e-9)

    def rates(t, x):
        K, k, C, c, M = own.matrices(profile.speed(t))
        force = [-K * x[0] - k * x[1] - C * x[2] - c * x[3], k * x[0] - K * x[1] + c * x[2] - C * x[3]]
        pull = np.array(force) + rotor.static_load + rotor.unbalance_force(t)
        return [*x[2:], *pull / (3.0 + M)]

    own_run = solve_ivp(
        rates, (0.0, 0.004), rotor.initial_state, method="DOP853", rtol=1e-11, atol=1e-14, t_eval=run.time
    )
    assert_allclose(run.signals["x"], own_run.y[0], atol=1e-10)
    assert_allclose(run.signals["y"], own_run.y[1], atol=1e-10)


def test_a_driven_rotor_knows_how_the_mass_depends_on_its_speed():
    driven = rf.MotorDrivenRotor(
        rotor=rf.RigidRotor(mass=3.0, speed=SPEED, unbalance=1e-4),
        inertia=0.01,
        torque=rf.rotors.LinearMotor(stall_torque=5.0, idle_speed=400.0),
    )
    whole = rf.mount(driven, {"": seal()})
    x = np.array([2e-5, -1e-5, 4e-3, 2e-3, 0.3, SPEED])
    A = whole.linearization(0.0, x, []).A
    for k, step in enumerate((1e-8, 1e-8, 1e-6, 1e-6, 1e-6, 1e-2)):
        shift = np.eye(6)[k] * step
        slope = (whole.derivative(0.0, x + shift, []) - whole.derivative(0.0, x - shift, [])) / (2.0 * step)
        assert_allclose(A[:, k], slope, atol=1e-7 * np.abs(A[:, k]).max() + 1e-7)


def test_coefficients_and_damped_modes_carry_the_mass():
    own = seal()
    found = rf.coefficients(own, [0.0, 0.0], SPEED)
    K, k, C, c, M = own.matrices(SPEED)
    assert_allclose(found.stiffness, [[K, k], [-k, K]], rtol=1e-14)
    assert_allclose(found.damping, [[C, c], [-c, C]], rtol=1e-14)
    assert_allclose(found.mass, M * np.eye(2), rtol=1e-14)
    light = seal(added_mass=False)
    assert not isinstance(rf.coefficients(light, [0.0, 0.0], SPEED), rf.bearings.InertialCoefficients)
    assert [signal.name for signal in light.outputs] == ["force_x", "force_y"]


def sagging_shaft(mass):
    steel = rf.ElasticMaterial(young_modulus=2.1e11, shear_modulus=8e10, density=7800.0)
    return rf.ShaftRotor(
        elements=rf.ShaftElement(length=1.0, outer_diameter=0.06, material=steel).split(4),
        speed=SPEED,
        stations=tuple(rf.Station(node=n, name=name) for n, name in enumerate(("a", "", "seal", "_", "b"))),
        disks=(rf.Disk(node=2, mass=mass),),
    )


def test_a_shaft_rests_in_a_seal_that_could_not_carry_it():
    shaft = sagging_shaft(100.0)
    spring, own = rf.LinearBearing(stiffness=5e7, damping=1e4), seal(0.1, added_mass=False)
    bearings = {"a": spring, "b": spring, "seal": own}
    rest = rf.rotor_equilibrium(shaft, bearings, SPEED)
    K, k, C, c, _ = own.matrices(SPEED)
    assert K * own.clearance < 0.7 * 100.0 * 9.8  # what rigid bearings would give it
    assert_allclose(rest.loads["seal"], [[K, k], [-k, K]] @ rest.coefficients["seal"].position, rtol=1e-6)
    matrices = rf.LinearBearing(stiffness=((K, k), (-k, K)), damping=((C, c), (-c, C)))
    modes = rf.rotor_modes(shaft, bearings, SPEED, 1e3)
    same = rf.rotor_modes(shaft, {**bearings, "seal": matrices}, SPEED, 1e3)
    assert_allclose(modes.eigenvalues, same.eigenvalues, rtol=1e-8)


@pytest.mark.closed_form
def test_a_shaft_that_sags_beyond_its_seal_is_told_so():
    spring, own = rf.LinearBearing(stiffness=5e7, damping=1e4), seal(0.1, added_mass=False)
    message = r"at 'seal' the shaft sags (\S+) m there, and its clearance is 0.0002 m"
    with pytest.raises(rf.EquilibriumError, match=message) as told:
        rf.rotor_equilibrium(sagging_shaft(400.0), {"a": spring, "b": spring, "seal": own}, SPEED)
    bending = 2.1e11 * np.pi * 0.06**4 / 64.0
    own_weight = 7800.0 * np.pi * 0.03**2 * 9.81
    sag = 400.0 * 9.81 / (48.0 * bending) + 5.0 / 384.0 * own_weight / bending  # 1 m long, without shear
    assert_allclose(float(re.search(message, str(told.value))[1]), sag, rtol=0.02)


def test_what_is_outside_of_its_range():
    with pytest.warns(rf.ValidityWarning, match=r"length / diameter must not exceed 0.25"):
        seal(0.5)
    with pytest.warns(rf.ValidityWarning, match="Reynolds number must be within 3000 to 100000"):
        seal(viscosity=0.1)
    with pytest.warns(rf.ValidityWarning, match="transit time of the seal"):
        seal().require_range(1e5)
    with pytest.raises(rf.InputError, match="pressure_drop must be"):
        seal(pressure_drop=0.0)
    with pytest.raises(rf.InputError, match=r"exponent must be within -1 to 0, got 0.2"):
        rf.bearings.HirsFriction(exponent=0.2)
    with pytest.raises(rf.InputError, match="added_mass=False of a seal"):
        rf.analysis.coefficient_table(seal(), [0.0, 0.0], [100.0, 200.0])
