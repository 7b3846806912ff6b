"""The compiled contact law and support of balls: Python's numbers, exact derivatives, limits."""

from dataclasses import replace

import numpy as np
import pytest
from fmpy.fmi1 import FMICallException
from fmpy.fmi2 import FMU2Model, FMU2Slave
from fmpy.fmi3 import FMU3Model, FMU3Slave
from scipy.integrate import solve_ivp

from rotorfilm import BallSupport, ContactLaw

A = np.array([[-2.0, 3.0, 0.0], [-3.0, -2.0, 0.0], [0.0, 0.0, -0.7]])
B, C = np.array([[2.0], [0.0], [1.0]]), np.array([[-0.2, 0.1, 0.15]])
LAW = ContactLaw(
    offset=0.3, span=2.1, exponent=1.55, operating=-1.8, A=A, B=B, C=C, D=C @ np.linalg.solve(A, B),
    static_error=0.0, damping_error=0.0, film_scale=1e-6, time_scale=1e-4, force_scale=50.0,
)  # fmt: skip
SUPPORT = BallSupport(law=LAW, angles=(-2.2, -1.5, 0.4), gap=-1e-6)
MODELS = [LAW, SUPPORT]
POINTS = {
    "law": [[-1.8e-6], [-3e-6], [0.29e-6], [0.31e-6], [4e-6]],
    "support": [
        [1e-7, -2e-7, 0.0, 0.0, 9.0],
        [1.2e-6, 1.9e-6, 1.0, 1.0, 0.0],
        [-2e-6, 0.5e-6, 0.0, 0.0, 1.0],
    ],
}


def case(model):
    return POINTS["law" if model is LAW else "support"]


@pytest.mark.parametrize("kind", [FMU2Slave, FMU3Slave])
@pytest.mark.parametrize("model", MODELS, ids=["law", "support"])
def test_outputs_are_those_of_python(model, kind, unzipped):
    client = unzipped(model).open(kind).start()
    names = [signal.name for signal in model.outputs]
    for u in case(model):
        client.set(**{signal.name: value for signal, value in zip(model.inputs, u, strict=True)})
        assert client.get(*names) == pytest.approx(
            model.output(0.0, model.initial_state, u), rel=1e-13, abs=1e-12
        )


@pytest.mark.parametrize("kind", [FMU2Model, FMU3Model])
@pytest.mark.parametrize("model", MODELS, ids=["law", "support"])
def test_derivatives_are_those_of_python(model, kind, unzipped):
    client = unzipped(model).open(kind).start()
    client.pass_event()
    client.fmu.enterContinuousTimeMode()
    rng = np.random.default_rng(3)
    inputs, outputs = ([s.name for s in signals] for signals in (model.inputs, model.outputs))
    states = [f"state_{s.name}" for s in model.states]
    slopes = [f"der(m.{name})" for name in states]
    for u in case(model):
        x = rng.uniform(-0.3, 0.3, len(states))
        client.set(**dict(zip(inputs, u, strict=True)))
        client.set_states(x)
        assert client.derivatives(len(x)) == pytest.approx(model.derivative(0.0, x, u), rel=1e-12, abs=1e-9)
        events = model.events(0.0, x, u)
        found = client.get(*(f"event_{k}" for k in range(len(events))))
        assert found == pytest.approx(events, rel=1e-12, abs=1e-12)
        at = model.linearization(0.0, x, u)
        for k, name in enumerate(inputs):
            assert client.differentiate(outputs, [name], [1.0]) == pytest.approx(at.D[:, k], rel=1e-12)
            assert client.differentiate(slopes, [name], [1.0]) == pytest.approx(at.B[:, k], rel=1e-12)
        for k, name in enumerate(states):
            assert client.differentiate(outputs, [name], [1.0]) == pytest.approx(at.C[:, k], rel=1e-12)
            assert client.differentiate(slopes, [name], [1.0]) == pytest.approx(at.A[:, k], rel=1e-12)


@pytest.mark.parametrize("kind", [FMU2Slave, FMU3Slave])
def test_a_step_is_the_exact_one_under_a_held_approach(kind, unzipped):
    client = unzipped(SUPPORT).open(kind).start()
    u, x = POINTS["support"][1], SUPPORT.initial_state
    client.set(**{signal.name: value for signal, value in zip(SUPPORT.inputs, u, strict=True)})
    t = 0.0
    for dt in (1e-5, 3e-4, 5e-5):
        client.step(t, dt)
        t += dt
    done = solve_ivp(lambda s, y: SUPPORT.derivative(s, y, u), (0.0, t), x, rtol=1e-11, atol=1e-13).y[:, -1]
    assert client.get(*(f"state_{s.name}" for s in SUPPORT.states)) == pytest.approx(done, rel=1e-8, abs=1e-9)


@pytest.mark.closed_form
def test_the_gap_moves_the_approach(unzipped):
    client = unzipped(LAW).open(FMU2Slave).start()
    client.set(gap=-1e-6, z=-0.8e-6)
    moved = client.get("force_z")
    client.set(gap=0.0, z=-1.8e-6)
    assert client.get("force_z") == pytest.approx(moved)
    with pytest.raises(FMICallException):
        client.set(gap=np.inf)


def test_loads_beyond_the_fit_are_warned_of(unzipped):
    messages = []
    folder = unzipped(LAW, {"z": -1.8e-6})
    client = folder.open(FMU3Slave, loggingOn=True, logMessage=lambda *a: messages.append(a[3].decode()))
    client.start()
    client.set(z=float(LAW.approach(140.0)))
    client.get("force_z")
    before = len(messages)
    client.set(z=float(LAW.approach(160.0)))
    assert client.get("force_z") == pytest.approx(LAW.output(0.0, np.zeros(3), [LAW.approach(160.0)]))
    assert "load 160 N of contact 0 is outside 10 to 150 N, to which its law was fitted" in messages[before]


def test_a_law_without_states_is_the_static_one(unzipped):
    static = replace(LAW, A=np.zeros((0, 0)), B=np.zeros((0, 1)), C=np.zeros((1, 0)), D=np.zeros((1, 1)))
    client = unzipped(static).open(FMU2Slave).start()
    client.set(z=float(static.approach(70.0)))
    assert client.get("force_z")[0] == pytest.approx(70.0)
    client.step(0.0, 1e-3)
    assert client.get("force_z")[0] == pytest.approx(70.0)
