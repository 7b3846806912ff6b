"""What the tests of the linear analyses compare with: films and coefficients in closed form."""

from dataclasses import dataclass, replace

import numpy as np
import pytest

from rotorfilm import JournalBearing, ShortFilm
from rotorfilm.core import force_outputs, journal_inputs, static_linearization


@dataclass(frozen=True)
class LinearFilm:
    """A spring and a damper: F = -K q - C v."""

    stiffness: np.ndarray
    damping: np.ndarray
    clearance: float = 1e-3

    inputs = property(lambda self: journal_inputs(self.clearance, 100.0))
    outputs = property(lambda self: force_outputs(1.0))
    states = ()

    def force(self, position, velocity, speed):
        return -self.stiffness @ np.asarray(position) - self.damping @ np.asarray(velocity)

    def jacobian(self, position, velocity, speed):
        return np.hstack([-self.stiffness, -self.damping, np.zeros((2, 1))])

    def output(self, t, x, u):
        return self.force(u[:2], u[2:4], u[4])

    def linearization(self, t, x, u):
        return static_linearization(self.jacobian(u[:2], u[2:4], u[4]))


@dataclass(frozen=True)
class SkewedFilm:
    """A film whose force depends on direction: F = S f(q) of a journal bearing, S any matrix."""

    bearing: JournalBearing
    skew: np.ndarray

    clearance = property(lambda self: self.bearing.clearance)

    def force(self, position, velocity, speed):
        return self.skew @ self.bearing.force(position, velocity, speed)

    def jacobian(self, position, velocity, speed):
        return self.skew @ self.bearing.jacobian(position, velocity, speed)


class Ocvirk:
    """Short bearing in closed form (Friswell et al. 2010, section 5.5), independent of rotorfilm's film.

    Load W along -y, rotation +z; K and C are in units of W / clearance and W / (clearance speed).
    """

    def __init__(self, bearing):
        self.bearing = bearing

    def load(self, eps, speed):
        """Return |W| [N] at the eccentricity ratio eps."""
        b = self.bearing
        square = np.pi**2 * (1 - eps**2) + 16 * eps**2
        scale = b.viscosity * abs(speed) * b.radius * b.length**3 / (4 * b.clearance**2)
        return scale * eps / (1 - eps**2) ** 2 * np.sqrt(square)

    @staticmethod
    def attitude_angle(eps):
        return np.arctan2(np.pi * np.sqrt(1 - eps**2), 4 * eps)

    @staticmethod
    def stiffness(eps):
        e2, pi2, root = eps**2, np.pi**2, np.sqrt(1 - eps**2)
        h = (pi2 * (1 - e2) + 16 * e2) ** -1.5
        return h * np.array(
            [
                [4 * (pi2 * (2 - e2) + 16 * e2), np.pi * (pi2 * (1 - e2) ** 2 - 16 * e2**2) / (eps * root)],
                [
                    -np.pi * (pi2 * (1 - e2) * (1 + 2 * e2) + 32 * e2 * (1 + e2)) / (eps * root),
                    4 * (pi2 * (1 + 2 * e2) + 32 * e2 * (1 + e2) / (1 - e2)),
                ],
            ]
        )

    @staticmethod
    def damping(eps):
        e2, pi2, root = eps**2, np.pi**2, np.sqrt(1 - eps**2)
        h = (pi2 * (1 - e2) + 16 * e2) ** -1.5
        cross = -8 * h * (pi2 * (1 + 2 * e2) - 16 * e2)
        return np.array(
            [
                [2 * np.pi * root * h * (pi2 * (1 + 2 * e2) - 16 * e2) / eps, cross],
                [cross, 2 * np.pi * h * (pi2 * (1 - e2) ** 2 + 48 * e2) / (eps * root)],
            ]
        )


@pytest.fixture(scope="session")
def bearing():
    """The bearing of Friswell et al. (2010), example 5.9.6."""
    return JournalBearing(radius=0.05, length=0.03, clearance=1e-4, viscosity=0.1, film=ShortFilm())


@pytest.fixture(scope="session")
def with_film(bearing):
    return lambda film: replace(bearing, film=film)


@pytest.fixture(scope="session")
def ocvirk(bearing):
    return Ocvirk(bearing)


@pytest.fixture(scope="session")
def linear_film():
    return lambda stiffness, damping: LinearFilm(np.array(stiffness, float), np.array(damping, float))


@pytest.fixture(scope="session")
def skewed_film(bearing):
    return SkewedFilm(bearing, np.array([[1.0, 0.3], [-0.5, 0.7]]))
