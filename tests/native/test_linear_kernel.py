"""The compiled state space: its exponential against scipy's and against closed forms."""

from dataclasses import dataclass
from typing import Any

import numpy as np
import pytest
from fmpy.fmi2 import FMU2Model, FMU2Slave
from fmpy.fmi3 import FMU3Slave
from scipy.linalg import expm

from rotorfilm.core import Signal
from rotorfilm.native import NativeSpec


def signals(prefix, count):
    return tuple(Signal(name=f"{prefix}{k}", unit="1", nominal=1.0, description="") for k in range(count))


@dataclass
class StateSpace:
    A: Any
    B: Any
    C: Any
    D: Any
    initial_state: Any

    inputs = property(lambda self: signals("u", self.B.shape[1]))
    outputs = property(lambda self: signals("y", self.C.shape[0]))
    states = property(lambda self: signals("x", self.A.shape[0]))

    def output(self, t, x, u):
        return self.C @ x + self.D @ u

    def derivative(self, t, x, u):
        return self.A @ x + self.B @ u

    def linearization(self, t, x, u):
        return self.A, self.B, self.C, self.D

    def native(self):
        return NativeSpec(kernel="linear", tables={name: getattr(self, name) for name in "ABCD"})


def random_system(n, m, p, seed=0):
    rng = np.random.default_rng(seed)
    return StateSpace(
        *(rng.normal(size=shape) for shape in ((n, n), (n, m), (p, n), (p, m))), rng.normal(size=n)
    )


def rotor_on_film():
    """Return a rotor on a film in SI units: entries from 1 to 1e7."""
    K, C = np.array([[4e7, -3e7], [5e7, 8e7]]), np.array([[2e5, 4e4], [4e4, 3e5]])
    A = np.block([[np.zeros((2, 2)), np.eye(2)], [-K / 50.0, -C / 50.0]])
    B = np.vstack([np.zeros((2, 2)), np.eye(2) / 50.0])
    return StateSpace(A, B, np.eye(4), np.zeros((4, 2)), np.array([1e-5, -2e-5, 1e-3, 0.0]))


def names(model):
    return [s.name for s in model.outputs]


def exact(model, u, duration):
    n, m = model.B.shape
    block = np.zeros((n + m, n + m))
    block[:n] = np.hstack([model.A, model.B]) * duration
    return expm(block)[:n] @ np.concatenate([model.initial_state, u])


@pytest.mark.parametrize("kind", [FMU2Slave, FMU3Slave])
@pytest.mark.parametrize("size", [(1, 1, 1), (4, 2, 3), (9, 3, 2), (30, 4, 4), (3, 0, 2), (0, 2, 2)])
def test_steps_are_the_exponential_of_scipy(unzipped, kind, size):
    model = random_system(*size)
    u = np.arange(1.0, size[1] + 1.0)
    system = unzipped(model).open(kind).start()
    system.set(**{f"u{k}": value for k, value in enumerate(u)})
    for k in range(4):
        system.step(k * 0.25, 0.25)
    x = exact(model, u, 1.0)
    expected = model.output(1.0, x, u)
    np.testing.assert_allclose(
        system.get(*names(model)), expected, rtol=1e-12, atol=1e-12 * np.abs(x).max(initial=1)
    )


@pytest.mark.parametrize("dt", [1e-9, 1e-6, 1e-4, 1e-2, 1.0])
def test_badly_scaled_systems_keep_their_digits(unzipped, dt):
    model = rotor_on_film()
    system = unzipped(model).open(FMU2Slave).start()
    system.set(u0=100.0, u1=-50.0)
    system.step(0.0, dt)
    # In units of 1 um, 1 mm/s and 1 kN the matrix is well scaled.
    unit = np.array([1e-6, 1e-6, 1e-3, 1e-3, 1e3, 1e3])
    block = np.zeros((6, 6))
    block[:4] = np.hstack([model.A, model.B]) * dt
    start = np.array([*model.initial_state, 100.0, -50.0])
    x = (unit * (expm(block * unit / unit[:, None]) @ (start / unit)))[:4]
    scale = np.maximum(np.abs(x), [1e-6, 1e-6, 1e-3, 1e-3])
    np.testing.assert_allclose(system.get(*names(model)) / scale, x / scale, rtol=0, atol=1e-11)


@pytest.mark.closed_form
def test_integrator_chain_and_oscillator_are_exact(unzipped):
    # A nilpotent matrix, and a rotation by many turns.
    A = np.zeros((4, 4))
    A[0, 1] = 1.0
    A[2, 3], A[3, 2] = 300.0, -300.0
    model = StateSpace(A, np.array([[0.0], [2.0], [0.0], [0.0]]), np.eye(4), np.zeros((4, 1)), np.eye(4)[2])
    system = unzipped(model).open(FMU2Slave).start()
    system.set(u0=3.0)
    system.step(0.0, 0.5)
    expected = [3.0 * 0.5**2, 6.0 * 0.5, np.cos(150.0), -np.sin(150.0)]
    np.testing.assert_allclose(system.get(*names(model)), expected, rtol=1e-12)


def test_step_sizes_may_alternate(unzipped):
    model = random_system(5, 2, 3)
    system = unzipped(model).open(FMU2Slave).start()
    system.set(u0=0.5, u1=-1.0)
    t = 0.0
    for dt in (0.1, 0.3, 0.1, 0.1, 0.4):
        system.step(t, dt)
        t += dt
    x = exact(model, [0.5, -1.0], t)
    np.testing.assert_allclose(system.get(*names(model)), model.output(t, x, [0.5, -1.0]), rtol=1e-11)


def test_model_exchange_is_the_same_system(unzipped):
    model = random_system(4, 2, 3)
    system = unzipped(model).open(FMU2Model).start()
    system.set(u0=0.5, u1=-1.0)
    u, x = np.array([0.5, -1.0]), model.initial_state
    np.testing.assert_allclose(system.derivatives(4), model.derivative(0.0, x, u), rtol=1e-13)
    np.testing.assert_allclose(system.get(*names(model)), model.output(0.0, x, u), rtol=1e-13)
    seed = [1.0, 2.0, 3.0, 4.0, 5.0, 6.0]
    answer = system.differentiate(names(model), [*(f"state_x{k}" for k in range(4)), "u0", "u1"], seed)
    np.testing.assert_allclose(answer, np.hstack([model.C, model.D]) @ seed, rtol=1e-13)


def test_growth_beyond_all_numbers_discards_the_step(unzipped, capsys):
    model = StateSpace(np.array([[1e3]]), np.ones((1, 1)), np.eye(1), np.zeros((1, 1)), np.array([1.0]))
    system = unzipped(model).open(FMU3Slave).start()
    system.step(0.0, 0.5)
    good = system.get("y0")
    assert good == pytest.approx(np.exp(500.0), rel=1e-11)
    with pytest.raises(Exception, match="fmi3DoStep failed with status 2"):
        system.step(0.5, 0.5)
    assert "last good time t = 0.5 s" in capsys.readouterr().out
    np.testing.assert_array_equal(system.get("y0", "time"), [*good, 0.5])


@pytest.mark.parametrize("kind", [FMU2Slave, FMU3Slave])
def test_derivatives_that_overflow_are_an_error(unzipped, kind, capsys):
    model = StateSpace(np.eye(1), np.ones((1, 1)), np.eye(1), np.full((1, 1), 1e308), np.ones(1))
    system = unzipped(model).open(kind).start()
    with pytest.raises(Exception, match="failed with status 3"):
        system.differentiate(["y0"], ["u0"], [100.0])
    assert "partial derivative 0 is not finite" in capsys.readouterr().out
