"""Reactions of a user's own, as a newcomer would write them: one file, which an FMU carries."""

from dataclasses import dataclass

import numpy as np

from rotorfilm import JournalBearing, Linearization, ShortFilm
from rotorfilm.core import force_outputs, journal_inputs, signals_of


@dataclass(frozen=True)
class ThrustSpring:
    """A collar between springs and dampers: one axial stiffness, one against tilts."""

    stiffness: tuple = (2e7, 4e4, 4e4)
    damping: tuple = (3e3, 5.0, 5.0)

    freedoms = ("z", "tilt_x", "tilt_y")
    inputs = journal_inputs(1e-4, 100.0, ("z", "tilt_x", "tilt_y"), arm=0.1)
    outputs = force_outputs(1e3, ("z", "tilt_x", "tilt_y"), arm=0.1)
    states = ()

    def output(self, t, x, u):
        return -np.multiply(self.stiffness, u[:3]) - np.multiply(self.damping, u[3:6])

    def linearization(self, t, x, u):
        D = np.hstack([-np.diag(self.stiffness), -np.diag(self.damping), np.zeros((3, 1))])
        return Linearization(np.zeros((0, 0)), np.zeros((0, 7)), np.zeros((3, 0)), D)


STRIP = JournalBearing(radius=0.025, length=0.002, clearance=5e-5, viscosity=0.02, film=ShortFilm())


@dataclass(frozen=True)
class Strips:
    """A journal bearing by strip theory: short films side by side, each at the place of its own journal."""

    film: JournalBearing = STRIP
    count: int = 6

    freedoms = ("x", "y", "tilt_x", "tilt_y")
    inputs = journal_inputs(5e-5, 100.0, ("x", "y", "tilt_x", "tilt_y"), arm=0.01)
    outputs = force_outputs(100.0, ("x", "y", "tilt_x", "tilt_y"), arm=0.01)
    states = ()
    clearance = 5e-5

    def _moves(self):
        for z in self.film.length * (np.arange(self.count) - 0.5 * (self.count - 1)):
            yield np.array([[1.0, 0.0, 0.0, z], [0.0, 1.0, -z, 0.0]])

    def output(self, t, x, u):
        u = np.asarray(u)
        parts = (move.T @ self.film.force(move @ u[:4], move @ u[4:8], u[8]) for move in self._moves())
        return sum(parts)

    def linearization(self, t, x, u):
        u, D = np.asarray(u), np.zeros((4, 9))
        for move in self._moves():
            own = self.film.jacobian(move @ u[:4], move @ u[4:8], u[8])
            D += move.T @ np.hstack([own[:, :2] @ move, own[:, 2:4] @ move, own[:, 4:]])
        return Linearization(np.zeros((0, 0)), np.zeros((0, 9)), np.zeros((4, 0)), D)


@dataclass(frozen=True)
class Rubber:
    """A spring with a Maxwell element along x and along y: two states that follow the shaft."""

    stiffness: float = 5e6
    maxwell: float = 8e6
    time: float = 2e-3
    damping: float = 200.0

    inputs = journal_inputs(1e-4, 100.0)
    outputs = force_outputs(1e3)
    states = signals_of(*((f"creep_{a}", "m", 1e-4, f"way of the dashpot along {a}") for a in "xy"))
    initial_state = np.zeros(2)

    def output(self, t, x, u):
        q, v, z = np.asarray(u[:2]), np.asarray(u[2:4]), np.asarray(x)
        return -self.stiffness * q - self.damping * v - self.maxwell * (q - z)

    def derivative(self, t, x, u):
        return (np.asarray(u[:2]) - np.asarray(x)) / self.time

    def linearization(self, t, x, u):
        one, none = np.eye(2), np.zeros((2, 1))
        return Linearization(
            -one / self.time,
            np.hstack([one / self.time, 0.0 * one, none]),
            self.maxwell * one,
            np.hstack([-(self.stiffness + self.maxwell) * one, -self.damping * one, none]),
        )

    def stiffness_at(self, s):
        follow = s * self.time / (1.0 + s * self.time)
        return self.stiffness + s * self.damping + self.maxwell * follow
