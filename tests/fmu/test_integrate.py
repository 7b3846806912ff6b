"""The integrator inside an FMU, against closed forms."""

from dataclasses import dataclass

import numpy as np
import pytest

from rotorfilm import ConvergenceError, FilmContactError, Linearization, RigidRotor
from rotorfilm.core import Signal
from rotorfilm.fmu import advance

STATE = (Signal(name="z", unit="m", nominal=1.0, description=""),)


@dataclass(frozen=True)
class BlowUp:
    """dz/dt = z^2, z(0) = 1: z = 1/(1 - t)."""

    states = STATE

    def derivative(self, t, x, u):
        return x * x

    def linearization(self, t, x, u):
        return Linearization(np.diag(2.0 * x), np.zeros((1, 0)), np.zeros((0, 1)), np.zeros((0, 0)))


@dataclass(frozen=True)
class Kinked:
    """dz/dt = max(0, t - 1/3)."""

    states = STATE
    breakpoints = (1.0 / 3.0,)

    def derivative(self, t, x, u):
        return np.array([max(0.0, t - 1.0 / 3.0)])


@pytest.mark.closed_form
@pytest.mark.parametrize("step", [1e-5, 1e-3, 0.05])
def test_unbalanced_rotor_under_a_constant_force(step):
    m, w, U, f = 50.0, 157.0, 8e-4, np.array([20.0, -30.0])
    rotor = RigidRotor(mass=m, speed=w, unbalance=U, gravity=(0.0, 0.0))
    end = advance(rotor, 0.0, rotor.initial_state, f, step)
    cos, sin = np.cos(w * step), np.sin(w * step)
    x = f * step**2 / (2 * m) + U / m * np.array([1 - cos, w * step - sin])
    v = f * step / m + U / m * w * np.array([sin, 1 - cos])
    nominal = np.array([signal.nominal for signal in rotor.states])
    np.testing.assert_allclose(end / nominal, np.concatenate([x, v]) / nominal, rtol=1e-9, atol=1e-9)


@pytest.mark.closed_form
def test_finite_escape_time_is_approached_accurately():
    assert advance(BlowUp(), 0.0, np.array([1.0]), np.zeros(0), 0.99)[0] == pytest.approx(100.0, rel=1e-7)


@pytest.mark.long
def test_beyond_the_escape_time_there_is_an_error_with_the_state_reached():
    with np.errstate(all="ignore"), pytest.raises(ConvergenceError, match=r"must reach t = 1\.5 s") as caught:
        advance(BlowUp(), 0.0, np.array([1.0]), np.zeros(0), 1.5)
    assert caught.value.partial[0] > 1e6


@pytest.mark.closed_form
def test_breakpoints_are_stopped_at():
    end = advance(Kinked(), 0.0, np.zeros(1), np.zeros(0), 1.0)
    assert end[0] == pytest.approx(2.0 / 9.0, abs=1e-15)


def test_a_step_of_zero_changes_nothing():
    assert advance(BlowUp(), 0.3, np.array([2.0]), np.zeros(0), 0.0).tolist() == [2.0]


@dataclass(frozen=True)
class Stiff:
    """dz/dt = -rate (z - cos t) - sin t, z(0) = 1: z = cos t, whatever the rate."""

    rate: float
    states = STATE

    def derivative(self, t, x, u):
        return -self.rate * (x - np.cos(t)) - np.sin(t)

    def linearization(self, t, x, u):
        return Linearization(np.array([[-self.rate]]), np.zeros((1, 0)), np.zeros((0, 1)), np.zeros((0, 0)))


@dataclass(frozen=True)
class Walled(Stiff):
    """The same behind a wall, which an explicit step of the whole length would pass."""

    def derivative(self, t, x, u):
        if abs(x[0]) > 1.01:
            raise FilmContactError(f"beyond the wall at {x[0]!r}")
        return super().derivative(t, x, u)


@pytest.mark.closed_form
@pytest.mark.parametrize("kind", [Stiff, Walled])
@pytest.mark.parametrize("rate", [1e4, 1e7])
def test_a_stiff_model_is_integrated_implicitly(kind, rate):
    end = advance(kind(rate=rate), 0.0, np.array([1.0]), np.zeros(0), 1.0)
    assert end[0] == pytest.approx(np.cos(1.0), abs=1e-8)
