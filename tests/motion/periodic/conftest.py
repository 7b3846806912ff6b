"""Bearings whose motion is known in closed form, and the short bearing of the whirl scenes."""

from dataclasses import dataclass

import numpy as np
import pytest
from scipy.integrate import quad

from rotorfilm import JournalBearing, RigidRotor, ShortFilm, mount
from rotorfilm.bearings.reaction import StaticReaction

CLEARANCE = 1e-4


@dataclass(frozen=True, kw_only=True)
class CubicBearing(StaticReaction):
    """F = -(k + h |q|^2) q - c v, whose synchronous orbits are circles."""

    stiffness: float
    hardening: float
    damping: float
    clearance: float = 1.0

    nominal_force = 1.0

    def prepared_force(self, q, v, omega):
        return -(self.stiffness + self.hardening * np.sum(q**2, axis=0)) * q - self.damping * v

    def prepared_jacobian(self, q, v, omega):
        out = np.zeros((2, 5, *q.shape[1:]))
        squared = np.sum(q**2, axis=0)
        for i in range(2):
            out[i, i] = -(self.stiffness + self.hardening * squared)
            out[i, 2 + i] = -self.damping
            for j in range(2):
                out[i, j] = out[i, j] - 2.0 * self.hardening * q[i] * q[j]
        return out


@dataclass(frozen=True, kw_only=True)
class VanDerPolBearing(StaticReaction):
    """Along x van der Pol's oscillator, -k x + (drive - limit x^2) vx; along y a damped spring."""

    stiffness: float
    drive: float
    limit: float
    clearance: float = 1.0

    nominal_force = 1.0

    def prepared_force(self, q, v, omega):
        along = -self.stiffness * q[0] + (self.drive - self.limit * q[0] ** 2) * v[0]
        return np.stack([along, -2.0 * self.stiffness * q[1] - 3.0 * v[1]])

    def prepared_jacobian(self, q, v, omega):
        out = np.zeros((2, 5, *q.shape[1:]))
        out[0, 0] = -self.stiffness - 2.0 * self.limit * q[0] * v[0]
        out[0, 2] = self.drive - self.limit * q[0] ** 2
        out[1, 1], out[1, 3] = -2.0 * self.stiffness, -3.0
        return out


class ShortScene:
    """The rigid rotor on a short bearing: lengths / C, time omega t, forces / W, by quadrature of the film.

    f = 2 int N/h^3 (cos, sin) dth over N < 0, N = (x - 2 vy) sin th - (y + 2 vx) cos th.
    """

    def __init__(self, eps):
        self.eps = eps
        self.sigma = (1 - eps**2) ** 2 / (eps * np.sqrt(16 * eps**2 + np.pi**2 * (1 - eps**2)))
        angle = np.arctan2(np.pi * np.sqrt(1 - eps**2), 4 * eps)
        self.rest = eps * np.array([np.cos(angle), np.sin(angle)])

    def slopes(self):
        """Return -d(sigma f)/d(x, y, vx, vy) at rest; the ends of the film, where N = 0, add nothing."""
        x, y = self.rest
        begin = np.arctan2(y, x)

        def integral(part):
            # N = e sin(th - begin) at rest, negative over the half turn before.
            return quad(part, begin - np.pi, begin, epsabs=1e-13, epsrel=1e-12)[0]

        def integrand(th, axis, column):
            direction = (np.cos(th), np.sin(th))
            h = 1 - x * direction[0] - y * direction[1]
            source = x * np.sin(th) - y * np.cos(th)
            by = (np.sin(th), -np.cos(th), -2 * np.cos(th), -2 * np.sin(th))[column]
            film = by / h**3
            if column < 2:
                film += 3 * source * direction[column] / h**4
            return film * direction[axis]

        rows = [[integral(lambda th, a=a, c=c: integrand(th, a, c)) for c in range(4)] for a in range(2)]
        return -2 * self.sigma * np.array(rows)

    def threshold(self):
        """Return w = omega sqrt(C m / W) where the rest loses its stability; nan where it never does."""
        K, C = np.split(self.slopes(), 2, axis=1)
        # z''/w^-2 + C z' + K z = 0 at z ~ exp(i nu t): both parts of the determinant vanish.
        k = (K[0, 0] * C[1, 1] + K[1, 1] * C[0, 0] - K[0, 1] * C[1, 0] - K[1, 0] * C[0, 1]) / np.trace(C)
        squared = ((K[0, 0] - k) * (K[1, 1] - k) - K[0, 1] * K[1, 0]) / np.linalg.det(C)
        return np.sqrt(k / squared) if squared > 0 else np.nan


class ShortRotor:
    """That scene in SI: its bearing, load and mass for the threshold at an eccentricity ratio."""

    load = 500.0
    bearing = JournalBearing(radius=0.05, length=0.02, clearance=CLEARANCE, viscosity=0.02, film=ShortFilm())

    def __init__(self, eps):
        b, scene = self.bearing, ShortScene(eps)
        self.speed = scene.sigma * 4 * CLEARANCE**2 * self.load / (b.viscosity * b.radius * b.length**3)
        self.parameter = scene.threshold()
        self.mass = self.load / CLEARANCE * (self.parameter / self.speed) ** 2
        self.rest = scene.rest * CLEARANCE

    def __call__(self, ratio, unbalance=0.0):
        """Return the rotor at a speed / threshold: the bearing is fixed, so sigma changes too."""
        rotor = RigidRotor(
            mass=self.mass,
            speed=ratio * self.speed,
            gravity=(self.load / self.mass, 0.0),
            unbalance=unbalance * self.mass * CLEARANCE,
        )
        return mount(rotor, {"": self.bearing})


@pytest.fixture(scope="session")
def short_scene():
    return ShortScene


@pytest.fixture(scope="session")
def short_rotor():
    return ShortRotor


@pytest.fixture(scope="session")
def cubic_bearing():
    return CubicBearing


@pytest.fixture(scope="session")
def van_der_pol():
    return VanDerPolBearing
