"""A rotor under force laws, in Python and in the C library; any linear rotor as a state space."""

import numpy as np
import pytest
from numpy.testing import assert_allclose
from scipy.integrate import solve_ivp

from rotorfilm import InputError
from rotorfilm.fmu import export_fmu, extracted, instantiated
from rotorfilm.fmu.instance import knowns_of, references_of, unknowns_of
from rotorfilm.rotors import (
    ForceLaw,
    JeffcottRotor,
    LawRotor,
    RigidRotor,
    RigidShaft,
    SpeedProfile,
    SteadyRotor,
)
from rotorfilm.rotors.force_law import held_law, law_inputs

RIGID = RigidRotor(mass=50.0, speed=157.0, unbalance=2e-3, position=(2e-5, -4e-5), velocity=(1e-3, 0.0))
SHAFT = RigidShaft(
    mass=60.0,
    diametral_inertia=4.0,
    polar_inertia=0.6,
    speed=157.0,
    unbalances=((0.1, 1.5e-3, 0.3),),
    stations=(("left", -0.4), ("right", 0.3)),
)
JEFFCOTT = JeffcottRotor(mass=40.0, journal_mass=1.0, stiffness=5e6, speed=-120.0, unbalance=1e-3)


def random_inputs(model, seed=3):
    random = np.random.default_rng(seed)
    return random.normal(size=len(model.inputs)) * [signal.nominal for signal in model.inputs]


def random_state(model, seed=4):
    random = np.random.default_rng(seed)
    return random.normal(size=len(model.states)) * [signal.nominal for signal in model.states]


@pytest.mark.parametrize("rotor", [LawRotor(rotor=RIGID), LawRotor(rotor=SHAFT, stations=("left", "right"))])
def test_the_force_is_that_of_the_law(rotor):
    u, x, t = random_inputs(rotor), random_state(rotor), 0.013
    names = [signal.name for signal in rotor.inputs]
    outputs = dict(zip([s.name for s in rotor.outputs], rotor.output(t, x, u), strict=True))
    plain = []
    for station in rotor.stations:
        values = dict(zip(names, u, strict=True))
        force, slope, curvature, K, C, base = np.split(
            [values[name] for name in law_inputs(station)], [2, 4, 6, 10, 14]
        )
        prefix = f"{station}_" if station else ""
        motion = np.array([outputs[prefix + name] for name in ("x", "y", "vx", "vy")]) - base
        since = t - values["base_time"]
        expected = force + slope * since + curvature * since**2
        plain.append(expected - K.reshape(2, 2) @ motion[:2] - C.reshape(2, 2) @ motion[2:])
    bare = rotor.rotor.derivative(t, x, np.concatenate(plain))
    assert_allclose(rotor.derivative(t, x, u), bare, rtol=1e-12)


@pytest.mark.parametrize("rotor", [LawRotor(rotor=RIGID), LawRotor(rotor=SHAFT, stations=("left", "right"))])
def test_derivatives_are_those_of_differences(rotor):
    u, x, t = random_inputs(rotor), random_state(rotor), 0.013
    found = rotor.linearization(t, x, u)
    for k, signal in enumerate(rotor.inputs):
        step = 1e-4 * signal.nominal * np.eye(len(u))[k]
        column = (rotor.derivative(t, x, u + step) - rotor.derivative(t, x, u - step)) / (2 * step[k])
        assert_allclose(found.B[:, k], column, rtol=1e-5, atol=1e-9 * np.abs(found.B[:, k]).max() + 1e-12)
    for k, signal in enumerate(rotor.states):
        step = 1e-4 * signal.nominal * np.eye(len(x))[k]
        column = (rotor.derivative(t, x + step, u) - rotor.derivative(t, x - step, u)) / (2 * step[k])
        assert_allclose(found.A[:, k], column, rtol=1e-5, atol=1e-9 * np.abs(found.A).max())


@pytest.mark.parametrize("version", ["2.0", "3.0"])
def test_the_compiled_rotor_is_the_one_in_python(version, tmp_path):
    rotor = LawRotor(rotor=RIGID)
    path = export_fmu(rotor, tmp_path / "law.fmu", version, "native")
    u, x, t = random_inputs(rotor), random_state(rotor), 0.013
    with extracted(path) as (description, folder):
        instance = instantiated(description, folder, exchange=True)
        try:
            instance.initialize([], [])
            instance.move(t, x)
            instance.set(references_of(description, "input"), u.tolist())
            slopes = instance.derivatives(4)
            unknowns, knowns = unknowns_of(description), knowns_of(description)
            columns = [instance.directional(unknowns, [known], [1.0]) for known in knowns]
        finally:
            instance.close()
    assert_allclose(slopes, rotor.derivative(t, x, u), rtol=1e-12)
    A, B, C, D = rotor.linearization(t, x, u)
    whole = np.block([[D, C], [B, A]])
    assert_allclose(np.array(columns).T, whole, rtol=1e-12, atol=1e-12 * np.abs(whole).max())


def test_a_co_simulation_step_under_a_law_is_that_of_an_independent_integration(tmp_path):
    path = export_fmu(LawRotor(rotor=RIGID), tmp_path / "law.fmu", "2.0", "native")
    law = ForceLaw(
        start=0.0,
        force=np.array([20.0, 500.0]),
        slope=np.array([3e3, -1e3]),
        curvature=np.array([-2e6, 1e6]),
        stiffness=np.array([[1e7, 2e6], [-3e6, 2e7]]),
        damping=np.array([[2e5, 1e4], [1e4, 3e5]]),
        position=np.array(RIGID.position),
        velocity=np.array(RIGID.velocity),
    )
    exact = solve_ivp(
        lambda t, x: RIGID.derivative(t, x, law.at(t, x[:2], x[2:])),
        (0.0, 1e-3),
        RIGID.initial_state,
        "Radau",
        rtol=1e-11,
        atol=1e-16,
    ).y[:, -1]
    with extracted(path) as (description, folder):
        instance = instantiated(description, folder, exchange=False)
        try:
            instance.initialize([], [])
            values = [*law.station(0), law.start]
            order = [v.name.partition(".")[2] for v in description.modelVariables if v.causality == "input"]
            assert order == [*law_inputs(""), "base_time"]
            instance.set(references_of(description, "input"), values)
            instance.step(0.0, 1e-3)
            found = instance.get(references_of(description, "output"))[:4]
        finally:
            instance.close()
    assert_allclose(found, exact, rtol=1e-7)


def test_a_law_is_evaluated_by_its_definition():
    law = held_law(0.5, np.array([1.0, 2.0]))
    assert law.held
    assert_allclose(law.at(9.0, [1.0, 1.0], [1.0, 1.0]), [1.0, 2.0])
    bent = law._replace(slope=np.array([1.0, 0.0]), stiffness=2.0 * np.eye(2), position=np.array([1.0, 0.0]))
    assert not bent.held
    assert_allclose(bent.at(1.5, [2.0, 3.0], [0.0, 0.0]), [1.0 + 1.0 - 2.0, 2.0 - 6.0])


def test_a_rotor_without_the_stations_is_refused():
    with pytest.raises(InputError, match="rotor must have the inputs"):
        LawRotor(rotor=RIGID, stations=("left",))


@pytest.mark.parametrize("rotor", [RIGID, SHAFT, JEFFCOTT], ids=["rigid", "shaft", "jeffcott"])
def test_a_steady_rotor_is_the_rotor(rotor):
    steady = SteadyRotor(rotor=rotor)
    n, u = len(rotor.states), random_inputs(rotor)
    turned = 0.037 * rotor.speed
    x = np.concatenate([random_state(rotor), [np.cos(turned), np.sin(turned), 1.0]])
    assert_allclose(steady.derivative(0.0, x, u)[:n], rotor.derivative(0.037, x[:n], u), rtol=1e-9, atol=1e-9)
    assert_allclose(steady.output(0.0, x, u), rotor.output(0.037, x[:n], u), rtol=1e-12)
    assert_allclose(steady.initial_state[:n], rotor.initial_state)
    assert steady.native().kernel == "linear"


def test_a_rotor_that_runs_up_is_not_steady():
    with pytest.raises(InputError, match="rotor must have a constant speed"):
        SteadyRotor(rotor=RigidRotor(mass=1.0, speed=SpeedProfile(times=(0.0, 1.0), speeds=(1.0, 2.0))))
