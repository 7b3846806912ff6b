"""A frequency-dependent film in python-control: its stiffness, its states, and a rotor on it."""

import numpy as np
import pytest

from rotorfilm import (
    ConvergenceError,
    InputError,
    RigidRotor,
    closed_loop,
    coefficients,
    critical_mass,
    film_system,
    linearize,
)
from rotorfilm.analysis.frequency_dependent import counted_exponents

SPEED = 314.0


@pytest.fixture(scope="module")
def top(film_of, rest_of):
    film = film_of("hole", 2e5)
    at = rest_of(film)
    return film, at, coefficients(film, at.position, SPEED)


def stiffness(system, nu):
    """Return K(i nu) of a system, positions and velocities moved together."""
    G = system(1j * nu)
    return -(G[:, :2] + 1j * nu * G[:, 2:4])


@pytest.mark.convergence
@pytest.mark.parametrize("tolerance", [1e-2, 1e-3, 1e-5])
def test_the_error_is_the_one_told(top, tolerance):
    film, at, exact = top
    found = film_system(film, at, tolerance=tolerance)
    assert found.error <= tolerance
    assert found.highest_frequency == SPEED
    assert np.linalg.eigvals(found.system.A).real.max() < 0.0
    errors = []
    for nu in SPEED * np.linspace(0.003, 1.0, 37):  # not those of the fit
        expected = exact.dynamic_stiffness.stiffness(1j * nu)
        errors.append(np.abs(stiffness(found.system, nu) - expected).max() / np.abs(expected).max())
    assert 0.3 * found.error < max(errors) < 1.1 * found.error


def test_a_wider_range_takes_more_states(top):
    film, at, _ = top
    narrow, wide = (film_system(film, at, highest_frequency=top * SPEED) for top in (1.0, 2.0))
    assert wide.system.nstates > narrow.system.nstates
    with pytest.raises(ConvergenceError, match="tolerance must be within reach of 32 states"):
        film_system(film, at, highest_frequency=20.0 * SPEED, tolerance=1e-9)


def test_at_rest_it_is_the_equilibrium(top):
    film, at, _ = top
    system = linearize(film, at, name="film")
    jacobian = film.jacobian(at.position, np.zeros(2), SPEED)
    np.testing.assert_allclose(system(0.0)[:, [0, 1, 4]], jacobian[:, [0, 1, 4]], rtol=1e-9)
    assert system.name == "film"
    assert system.input_labels == ["x", "y", "vx", "vy", "speed"]
    assert system.output_labels == ["force_x", "force_y"]


def test_a_rotor_on_it_has_the_exponents_of_the_film_itself(top):
    film, at, exact = top
    mass = 1.1 * critical_mass(exact).mass
    rotor = RigidRotor(mass=mass, speed=SPEED, position=tuple(at.position))
    values = np.linalg.eigvals(closed_loop(rotor, film, at).A)
    (whirl,) = counted_exponents(exact, mass)[0]
    assert whirl.real > 0.0
    assert np.abs(values - whirl).min() < 1e-3 * abs(whirl)
    assert np.sum(values.real > 0.0) == 2


def test_what_it_refuses(top, rest_of):
    film, at, _ = top
    with pytest.raises(InputError, match="tolerance must be"):
        film_system(film, at, tolerance=0.0)
    with pytest.raises(InputError, match="highest_frequency must be"):
        film_system(film, at, highest_frequency=-1.0)
    with pytest.raises(InputError, match="film must be a frequency-dependent film"):
        film_system(film.bearing, at)
