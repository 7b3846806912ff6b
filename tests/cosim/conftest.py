"""Films and rotors in the units of the clearance, the load and the angle of rotation."""

from dataclasses import dataclass

import numpy as np
import pytest
from studies.master_cases import BEARING, RAMP, ROTOR, rotor_at

from rotorfilm import FilmContactError, PartialResultError
from rotorfilm.core import force_outputs, journal_inputs, static_linearization
from rotorfilm.cosim import cosimulate, master
from rotorfilm.fmu import export_fmu
from rotorfilm.rotors import LawRotor, RigidRotor

GAUSS, WEIGHTS = np.polynomial.legendre.leggauss(120)


@dataclass(frozen=True)
class QuadratureFilm:
    """Short bearing on its moving half circle, integrated by brute force: clearance, load and speed are 1.

    F = 2 sigma int N/h^3 (cos, sin) dth over N < 0 with N = (x - 2 vy) sin th - (y + 2 vx) cos th and
    h = 1 - x cos th - y sin th.
    """

    sigma: float

    clearance = 1.0
    inputs = property(lambda self: journal_inputs(1.0, 1.0))
    outputs = property(lambda self: force_outputs(1.0))
    states = ()

    def _arc(self, u):
        x, y, vx, vy, speed = (np.asarray(value)[..., None] for value in u)
        if np.any(np.hypot(x, y) >= 1.0):
            raise FilmContactError(f"outside at {np.max(np.hypot(x, y))}")
        start = np.arctan2(speed * y + 2.0 * vx, speed * x - 2.0 * vy) + np.pi
        angle = start + np.pi / 2.0 * (GAUSS + 1.0)
        cos, sin = np.cos(angle), np.sin(angle)
        source = (speed * x - 2.0 * vy) * sin - (speed * y + 2.0 * vx) * cos
        return cos, sin, source, 1.0 - x * cos - y * sin

    def output(self, t, x, u):
        cos, sin, source, h = self._arc(u)
        return np.pi * self.sigma * np.sum(np.stack([cos, sin]) * (WEIGHTS * source / h**3), axis=-1)

    def force(self, position, velocity, speed):
        return self.output(0.0, (), [*position, *velocity, speed])

    def jacobian(self, position, velocity, speed):
        cos, sin, source, h = self._arc([*position, *velocity, speed])
        x, y = position
        by_source = np.stack([speed * sin, -speed * cos, -2.0 * cos, -2.0 * sin, x * sin - y * cos])
        by_film = 3.0 * source / h * np.stack([cos, sin, 0.0 * cos, 0.0 * cos, 0.0 * cos])
        return np.pi * self.sigma * (np.stack([cos, sin]) * WEIGHTS / h**3) @ (by_source + by_film).T

    def linearization(self, t, x, u):
        return static_linearization(self.jacobian(u[:2], u[2:4], u[4]))


@dataclass(frozen=True)
class SpringDamper:
    """F = -k q - c v, without a wall."""

    stiffness: float
    damping: float

    clearance = 1e9
    inputs = property(lambda self: journal_inputs(1.0, 1.0))
    outputs = property(lambda self: force_outputs(1.0))
    states = ()

    def force(self, position, velocity, speed):
        return -self.stiffness * np.asarray(position) - self.damping * np.asarray(velocity)

    def output(self, t, x, u):
        return self.force(u[:2], u[2:4], u[4])

    def linearization(self, t, x, u):
        eye = np.eye(2)
        return static_linearization(np.hstack([-self.stiffness * eye, -self.damping * eye, np.zeros((2, 1))]))


@dataclass(frozen=True)
class Case:
    """A film, and a rotor that it carries at an eccentricity ratio with w = omega sqrt(C m / W)."""

    film: QuadratureFilm
    rotor: RigidRotor

    @property
    def state(self):
        return self.rotor.initial_state


def nondimensional(eccentricity, w=1.0, offset=(0.0, 0.0), unbalance=0.0):
    """Return the case at static equilibrium plus an offset; the unit load is turned along +x."""
    e = eccentricity
    sigma = (1.0 - e * e) ** 2 / (e * np.sqrt(16.0 * e * e + np.pi**2 * (1.0 - e * e)))
    film = QuadratureFilm(sigma)
    force = film.force((e, 0.0), (0.0, 0.0), 1.0)
    turn = np.pi - np.arctan2(force[1], force[0])
    start = e * np.array([np.cos(turn), np.sin(turn)]) + offset
    rotor = RigidRotor(
        mass=w * w,
        speed=1.0,
        unbalance=unbalance * w * w,
        gravity=(0.0, 0.0),
        static_force=(1.0, 0.0),
        position=tuple(start),
    )
    return Case(film, rotor)


@pytest.fixture(name="nondimensional")
def _nondimensional():
    return nondimensional


@pytest.fixture
def make_spring_damper():
    return SpringDamper


@pytest.fixture(scope="module", params=["2.0", "3.0"])
def native_fmus(request, tmp_path_factory):
    folder = tmp_path_factory.mktemp("fmus")
    models = {
        "film": BEARING,
        "held": ROTOR,
        "law": LawRotor(rotor=rotor_at(0.6, 0.2, speed=RAMP)),
        "thrown": rotor_at(0.6, 0.2, velocity=(0.0, -0.6)),
    }
    return {
        name: export_fmu(model, folder / f"{name}.fmu", request.param, "native", component=name)
        for name, model in models.items()
    }


@pytest.fixture
def compiled(monkeypatch):
    """Return a list to which each run adds its part in C, or nothing for one in Python."""
    made, make = [], master.compiled_run
    monkeypatch.setattr(master, "compiled_run", lambda *given: made.append(make(*given)) or made[-1])
    return made


@pytest.fixture
def outcome():
    """Return what runs partners and returns the run, complete or not, and what it was stopped by."""

    def outcome(*partners, **arguments):
        try:
            return cosimulate(*partners, **arguments), ""
        except PartialResultError as error:
            return error.partial, str(error)

    return outcome
