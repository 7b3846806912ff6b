"""Integration of a rotor under a force law by the matrix exponential, exact where the rotor is linear.

Over a step from (t, x), y = x(t + tau) - x obeys y' = M y + g(tau) + r with M = A + B dF/d(motion) C, the
film's stiffness and damping included, g(tau) the rate of the frozen state x at t + tau, and a remainder r
that is zero for a linear rotor. g is interpolated by a polynomial, and

    y(H) = int_0^H exp(M (H - tau)) g(tau) dtau

follows from one exponential of an augmented matrix (Van Loan 1978). One more call of the rotor at the end
tells whether polynomial and linearity hold; where they do not, the step is halved, and a rotor that is not
linear is integrated by Radau's method.
"""

from __future__ import annotations

from typing import Protocol

import numpy as np
from scipy.integrate import solve_ivp
from scipy.linalg import expm

from ...errors import ConvergenceError
from ...model import Array, Linearization
from ...rotors.force_law import ForceLaw
from ..wiring import Wiring

DEGREE = 6
"""Degree of the polynomial of the rates in time."""

NODES = np.concatenate([[0.0], 0.5 - 0.5 * np.cos(np.pi * (2.0 * np.arange(DEGREE) + 1.0) / (2.0 * DEGREE))])
"""Where the rates are taken, in steps."""

TO_POWERS = np.linalg.inv(np.vander(NODES, increasing=True))
"""Coefficients of the polynomial from the rates at the nodes."""

TOLERANCE = 1e-9
"""Of the state at the end of a step, relative to it and to its nominal value."""

HALVINGS = 4
"""How often a step is halved before the rotor counts as not linear."""


class System(Protocol):
    """A rotor as a system of ordinary differential equations; signals go by their names."""

    @property
    def inputs(self) -> tuple[str, ...]:
        """Names of the inputs."""

    @property
    def outputs(self) -> tuple[str, ...]:
        """Names of the outputs."""

    @property
    def nominals(self) -> Array:
        """Typical magnitudes of the states, shape (n_states,)."""

    def rates(self, t: float, x: Array, u: Array) -> Array:
        """Return dx/dt, shape (n_states,)."""

    def outcome(self, t: float, x: Array, u: Array) -> Array:
        """Return the outputs, shape (n_outputs,)."""

    def matrices(self, t: float, x: Array, u: Array) -> Linearization:
        """Return the exact derivatives."""

    def next_kink(self, t: float) -> float:
        """Return the first time after t at which the rates have a kink; infinite without one."""

    def pass_kink(self, t: float, x: Array) -> None:
        """Go beyond a kink at the time t."""


class LawIntegrator:
    """Advances the state of a rotor under force laws.

    Parameters
    ----------
    system : System
    wiring : Wiring
    inputs : ndarray, shape (n_inputs,)
        Values of the inputs that no film drives.
    """

    def __init__(self, system: System, wiring: Wiring, inputs: Array) -> None:
        self._system, self._inputs = system, inputs
        self._at = wiring.places(system.inputs, system.outputs)
        self._matrices: Linearization | None = None

    def advance(self, t: float, x: Array, dt: float, law: ForceLaw) -> Array:
        """Return the state at t + dt.

        Raises
        ------
        ConvergenceError
            If the rotor cannot be integrated.
        """
        while dt > 0.0:
            kink = self._system.next_kink(t)
            step = min(dt, kink - t)
            x = self._smooth(t, x, step, law, HALVINGS)
            if kink <= t + dt:
                self._system.pass_kink(kink, x)
                self._matrices = None
            t, dt = t + step, dt - step if step < dt else 0.0
        return x

    def _smooth(self, t: float, x: Array, dt: float, law: ForceLaw, halvings: int) -> Array:
        for fresh in (False, True):
            if fresh or self._matrices is None:
                self._matrices = self._system.matrices(t, x, self._inputs)
            end, error = self._trial(t, x, dt, law, self._matrices)
            if error <= 1.0:
                return end
        if halvings == 0:
            return self._stiff(t, x, dt, law)
        middle = self._smooth(t, x, 0.5 * dt, law, halvings - 1)
        return self._smooth(t + 0.5 * dt, middle, 0.5 * dt, law, halvings - 1)

    def _trial(
        self, t: float, x: Array, dt: float, law: ForceLaw, matrices: Linearization
    ) -> tuple[Array, float]:
        """Return the state after an exponential step, and its error in tolerances."""
        nominal = self._system.nominals
        M = self._loop(matrices, law)
        rates = np.array([self._rates(t + node * dt, x, law) for node in NODES])
        powers = (TO_POWERS @ rates).T
        y = nominal * _integral(dt * M * nominal / nominal[:, None], dt * powers / nominal[:, None])
        # Just before the end, where there may be a kink.
        found = self._rates(float(np.nextafter(t + dt, t)), x + y, law)
        defect = found - M @ y - powers.sum(axis=1)
        allowed = TOLERANCE * (nominal + np.abs(y)) + 1e-14 * np.abs(dt * found)
        return x + y, float(np.max(np.abs(dt * defect) / allowed, initial=0.0))

    def _stiff(self, t: float, x: Array, dt: float, law: ForceLaw) -> Array:
        """Integrate a rotor that is not linear."""
        found = solve_ivp(
            lambda time, state: self._rates(time, state, law),
            (t, t + dt),
            x,
            "Radau",
            jac=lambda time, state: self._loop(self._system.matrices(time, state, self._inputs), law),
            rtol=TOLERANCE,
            atol=TOLERANCE * self._system.nominals,
            first_step=0.5 * dt,
        )
        if not found.success:
            raise ConvergenceError(f"the rotor cannot be integrated from t = {t:.9g} s: {found.message}", x)
        return np.asarray(found.y[:, -1])

    def _rates(self, t: float, x: Array, law: ForceLaw) -> Array:
        motion = self._system.outcome(t, x, self._inputs)
        u = self._inputs.copy()
        u[self._at.force] = law.at(t, motion[self._at.position], motion[self._at.velocity])
        return self._system.rates(t, x, u)

    def _loop(self, matrices: Linearization, law: ForceLaw) -> Array:
        feedback = law.stiffness @ matrices.C[self._at.position] + law.damping @ matrices.C[self._at.velocity]
        closed: Array = matrices.A - matrices.B[:, self._at.force] @ feedback
        return closed


def _integral(M: Array, powers: Array) -> Array:
    """Return int_0^1 exp(M (1 - s)) sum_k powers[:, k] s^k ds."""
    n, count = powers.shape
    augmented = np.zeros((n + count, n + count))
    augmented[:n, :n], augmented[:n, n:] = M, powers
    augmented[n + 1 :, n:-1] += np.diag(np.arange(1.0, count))
    # Scaled by columns: the polynomial is of order 1, whatever the unit of its coefficients.
    return np.asarray(expm(augmented)[:n, n])
