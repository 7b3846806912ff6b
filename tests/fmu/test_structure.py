"""Dependencies: claimed wherever a derivative may differ from zero, and only there."""

from dataclasses import dataclass

import numpy as np

from rotorfilm import JournalBearing, RigidRotor, UndefinedDerivativeError
from rotorfilm.bearings.journal import ShortFilm
from rotorfilm.core import Signal, static_linearization
from rotorfilm.fmu.description import dependencies

BEARING = JournalBearing(radius=0.05, length=0.03, clearance=1e-4, viscosity=0.1, film=ShortFilm())


def signals(*names):
    return tuple(Signal(name=name, unit="1", nominal=1.0, description="") for name in names)


@dataclass(frozen=True)
class Product:
    """y = a b, z = c: at the origin, all of the first row of D vanishes."""

    inputs = signals("a", "b", "c")
    outputs = signals("y", "z")
    states = ()

    def linearization(self, t, x, u):
        return static_linearization(np.array([[u[1], u[0], 0.0], [0.0, 0.0, 1.0]]))


class Kinked(Product):
    def linearization(self, t, x, u):
        raise UndefinedDerivativeError("nowhere")


def test_a_derivative_that_vanishes_at_the_start_only_is_a_dependency():
    found = dependencies(Product(), np.zeros(3))
    assert found.on_inputs.tolist() == [[True, True, False], [False, False, True]]
    assert found.on_states.shape == (2, 0)


def test_without_derivatives_everything_may_depend():
    assert dependencies(Kinked(), np.zeros(3)).on_inputs.all()


def test_a_film_feeds_every_input_through():
    assert dependencies(BEARING, np.zeros(5)).on_inputs.all()


def test_a_rotor_feeds_nothing_through():
    found = dependencies(RigidRotor(mass=50.0, speed=157.0), np.zeros(2))
    assert not found.on_inputs[:5].any()
    assert found.on_inputs[5:].tolist() == np.eye(4, 2, k=-2, dtype=bool).tolist()
    outputs, derivatives = np.split(found.on_states, [5])
    assert outputs.tolist() == np.eye(5, 4, dtype=bool).tolist()
    assert derivatives.tolist() == np.eye(4, k=2, dtype=bool).tolist()


def test_what_is_linear_and_what_depends_on_time():
    rotor = RigidRotor(mass=50.0, speed=157.0, unbalance=1e-3)
    found = dependencies(rotor, np.zeros(2), (0.0, 0.01))
    assert not found.bent.any()
    assert found.on_time.tolist() == [False] * 5 + [False, False, True, True]
    film = dependencies(BEARING, np.array([1e-5, 0.0, 0.0, 0.0, 100.0]), (0.0, 0.01))
    assert film.bent.all()
    assert not film.on_time.any()
