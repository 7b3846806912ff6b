"""A spring and damper film, whose motions are known in closed form."""

from dataclasses import dataclass

import numpy as np
import pytest

from rotorfilm import FilmContactError
from rotorfilm.core import force_outputs, journal_inputs, static_linearization


@dataclass(frozen=True)
class LinearFilm:
    """F = -k q - c v, with or without a wall that raises."""

    stiffness: float = 0.0
    damping: float = 0.0
    clearance: float = 1e-4

    inputs = property(lambda self: journal_inputs(self.clearance, 100.0))
    outputs = property(lambda self: force_outputs(1.0))
    states = ()

    def force(self, position, velocity, speed):
        eccentricity = np.hypot(*np.asarray(position)).max()
        if eccentricity >= self.clearance:
            raise FilmContactError(f"outside at {eccentricity}")
        return -self.stiffness * np.asarray(position) - self.damping * np.asarray(velocity)

    def jacobian(self, position, velocity, speed):
        eye = np.eye(2)
        return np.hstack([-self.stiffness * eye, -self.damping * eye, np.zeros((2, 1))])

    def output(self, t, x, u):
        return self.force(u[:2], u[2:4], u[4])

    def linearization(self, t, x, u):
        return static_linearization(self.jacobian(u[:2], u[2:4], u[4]))


@pytest.fixture
def make_linear_film():
    return LinearFilm
