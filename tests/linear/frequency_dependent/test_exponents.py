"""Exponents, their count and critical masses on films that remember, by pencils, polynomials and notes."""

from dataclasses import dataclass

import numpy as np
import pytest
from scipy.linalg import eigvals

from rotorfilm import Coefficients, ConvergenceError, coefficients, critical_mass, whirl_threshold
from rotorfilm.analysis.frequency_dependent import (
    counted_exponents,
    growing_count,
    mass_borders,
    rigid_growing,
)
from rotorfilm.bearings import FrequencyDependentCoefficients
from rotorfilm.bearings.films.mass_conserving import oil_outflow
from rotorfilm.bearings.films.mass_conserving_steps import FilmInMotion

SPEED = 314.0


@dataclass
class Stepped:
    """The stiffness of a film whose cavity blurs waves as steps in time do: a rational function of s."""

    motion: FilmInMotion

    def stiffness(self, s):
        return self.motion.stiffness(s, as_stepped=True)

    def __call__(self, s):
        h = 1e-5
        slope = (self.stiffness(s + h) - self.stiffness(s - h)) / (2.0 * h)
        return self.stiffness(s), slope


@dataclass
class Springs:
    """K + s C."""

    K: np.ndarray
    C: np.ndarray

    def stiffness(self, s):
        return self.K + s * self.C

    def __call__(self, s):
        return self.stiffness(s), self.C + 0j


def remembered(motion, speed):
    K = motion.stiffness(1j * speed)
    given = {"position": np.zeros(2), "speed": speed, "frequency": speed, "motion": motion}
    return FrequencyDependentCoefficients(stiffness=K.real, damping=K.imag / speed, **given)


def pencil(film, e, state):
    """Return A and E of E x' = A x without the mass: place, velocity, P of full cells and theta of others.

    All by differences of what flows out of the cells, which is linear in P and theta.
    """
    found, cells = state.solution, film.cells
    free = np.flatnonzero(cells.opening.ravel() < 0)
    full = found.full.ravel().astype(bool)
    n = 4 + len(free)
    A, E = np.zeros((n, n)), np.zeros((n, n))

    def outflow(place, step=None):
        P, theta = found.pressure.copy(), found.theta.copy()
        if step is not None:
            (P if full[step] else theta).flat[step] += 1.0
        return oil_outflow(film.equations(film.gap(place), state.rate), P, theta).ravel()[free]

    gap = (state.gap.line * cells.area).ravel()
    for k, cell in enumerate(free):
        A[4:, 4 + k] = outflow(e) - outflow(e, cell)
        if full[cell]:
            A[2:4, 4 + k] = -12.0 * film.weights.reshape(2, -1)[:, cell]
        else:
            E[4 + k, 4 + k] = gap[cell]
    for axis, unit in enumerate(1e-5 * np.eye(2)):
        A[4:, axis] = (outflow(e - unit) - outflow(e + unit)) / 2e-5
        turned = (film.gap(e + unit).line - film.gap(e - unit).line) / 2e-5
        E[4:, axis] = (found.theta * cells.area * turned).ravel()[free]
    A[:2, 2:4] = np.eye(2)
    E[:2, :2] = np.eye(2)
    return A, E


def roots_of(A, E, mass):
    weighted = E.copy()
    weighted[2:4, 2:4] = mass * np.eye(2)
    values = eigvals(A, weighted)
    return values[np.isfinite(values) & (np.abs(values) < 1e6)]


@pytest.fixture(scope="module")
def small(film_of, rest_of):
    """Return the film of a rotor at speed 1 without dimensions on 24 x 4 cells, and its pencil."""
    given = film_of(cells=(24, 4))
    film, e = given.film, rest_of(given).position / given.clearance
    state = film.solve(film.gap(e), 0.5)
    return remembered(Stepped(FilmInMotion(film, state)), 1.0), pencil(film, e, state)


@pytest.mark.closed_form
def test_exponents_are_those_of_the_pencil_of_rotor_and_oil(small):
    film, matrices = small
    ((border, _),) = mass_borders(film)
    for mass in border * np.array([0.3, 0.9, 1.1, 3.0]):
        all_roots = roots_of(*matrices, mass)
        values, growing = counted_exponents(film, mass)
        for s in values:
            assert np.abs(all_roots - s).min() < 1e-7 * abs(s)
        assert growing == rigid_growing(film, mass) == np.sum(all_roots.real > 0.0)
        assert values[0].real == pytest.approx(all_roots.real.max(), rel=1e-4)


@pytest.mark.closed_form
def test_the_border_is_that_of_the_pencil(small):
    film, matrices = small
    ((border, frequency),) = mass_borders(film)
    roots = roots_of(*matrices, border)
    assert roots.real.max() == pytest.approx(0.0, abs=1e-9)
    assert np.abs(roots - 1j * frequency).min() < 1e-8


@pytest.mark.closed_form
def test_without_memory_the_critical_mass_is_that_of_lund():
    K, C = np.array([[2.0, 0.7], [-3.6, 3.4]]), np.array([[2.2, -2.0], [-2.1, 6.4]])
    known = critical_mass(Coefficients(stiffness=K, damping=C, position=np.zeros(2), speed=1.0))
    found = critical_mass(remembered(Springs(K, C), 1.0))
    assert found.mass == pytest.approx(known.mass, rel=1e-10)
    assert found.whirl_ratio == pytest.approx(known.whirl_ratio, rel=1e-10)
    assert (found.growing_below, found.growing_above) == (0, 2)
    stable = critical_mass(remembered(Springs(np.diag([2.0, 3.0]), C), 1.0))
    assert stable.mass is None
    assert "stable whatever" in stable.reason
    falling = critical_mass(remembered(Springs(np.diag([-2.0, 3.0]), C), 1.0))
    assert "unstable whatever" in falling.reason
    assert falling.growing_below == 1


@pytest.mark.closed_form
@pytest.mark.parametrize(
    "roots",
    [
        [-1.0, -2.0, -0.1 + 3j, -0.1 - 3j],
        [-1.0, 2.0, -0.1 + 3j, -0.1 - 3j],
        [0.01 + 3j, 0.01 - 3j, -0.01 + 3.005j, -0.01 - 3.005j],
        [0.5 + 1j, 0.5 - 1j, 0.001 + 7j, 0.001 - 7j],
    ],
)
def test_roots_are_counted(roots):
    def ratio(nu):
        return np.prod(1j * nu[:, None] - np.array(roots), axis=1) / (1j * nu + 1.0) ** 4

    assert growing_count(ratio, np.linspace(0.0, 40.0, 161)) == np.sum(np.real(roots) > 0.0)
    # counted against another polynomial whose roots are known
    other = np.array([1.0, -1.0, -3.0, -3.0])
    count = growing_count(
        lambda nu: np.prod((1j * nu[:, None] - np.array(roots)) / (1j * nu[:, None] - other), axis=1),
        np.linspace(0.0, 40.0, 161),
        1,
    )
    assert count == np.sum(np.real(roots) > 0.0)


@pytest.mark.closed_form
def test_roots_are_counted_where_the_determinant_is_nearly_zero():
    """Below 1e-162 the product of two values is 0."""
    grid = np.concatenate([[0.0], np.geomspace(1.0, 1e11, 2000)])
    assert growing_count(lambda nu: ((1j * nu - 1e3) / (1j * nu + 1e9)) ** 30, grid) == 30


@pytest.mark.filterwarnings("error")
@pytest.mark.parametrize("within", [np.nan, 0.0])
def test_a_band_without_a_phase_is_refused(within):
    with pytest.raises(ConvergenceError, match="cannot be counted"):
        growing_count(
            lambda nu: np.where((nu > 2.0) & (nu < 3.0), within, 1.0 + 0j), np.linspace(0.0, 4.0, 9)
        )


def test_a_root_that_neither_grows_nor_decays_is_not_counted():
    with pytest.raises(ConvergenceError, match="neither grows nor decays"):
        growing_count(lambda nu: (9.0 - nu**2) / (1j * nu + 1.0) ** 2, np.linspace(0.0, 40.0, 100))


@pytest.mark.literature
@pytest.mark.parametrize(
    ("opening", "supply", "So", "expected", "quasi_static"),
    [("top", 0.0, 0.5, 6.08, 0.82), ("hole", 2.0, 0.5, 5.53, 0.69)],
)
def test_critical_masses_of_an_independent_code(
    film_of, rest_of, opening, supply, So, expected, quasi_static
):
    """M c w^2/W by K(s) of a code of its own; slow motion gives far less."""
    film = film_of(opening, supply * 0.0053 * SPEED * 12.0 * 0.02 * 500.0**2, (144, 10))
    at = rest_of(film, So)
    unit = np.hypot(*at.load) / film.clearance / SPEED**2
    found = critical_mass(coefficients(film, at.position, SPEED))
    assert found.mass / unit == pytest.approx(expected, rel=0.02)
    assert (found.growing_below, found.growing_above) == (0, 2)
    slow = critical_mass(coefficients(film, at.position, SPEED, frequency=0.0))
    assert slow.mass / found.mass == pytest.approx(quasi_static, abs=0.02)


@pytest.mark.literature
def test_slow_motion_may_know_no_border_where_there_is_one(film_of, rest_of):
    """Grooves at 45 and 225 deg, So .25, 2 bar: 2.31 in the code of its own, none by K(0) and C(0)."""
    film = film_of("two", 0.0106 * SPEED * 12.0 * 0.02 * 500.0**2, (144, 10))
    at = rest_of(film, 0.25)
    found = critical_mass(coefficients(film, at.position, SPEED))
    unit = np.hypot(*at.load) / film.clearance / SPEED**2
    assert found.mass / unit == pytest.approx(2.31, rel=0.02)
    slow = critical_mass(film.slow_coefficients(at.position, SPEED))
    assert slow.mass is None


def test_the_threshold_is_where_the_mass_is_critical(film_of, rest_of):
    film = film_of("hole", 1e5)
    at = rest_of(film)
    mass = critical_mass(coefficients(film, at.position, SPEED)).mass
    found = whirl_threshold(film, at.load, mass, speed_range=(0.5 * SPEED, 2.0 * SPEED))
    assert found.speed == pytest.approx(SPEED, rel=1e-9)
    assert (found.growing_below, found.growing_above) == (0, 2)
    none = whirl_threshold(film, at.load, mass, speed_range=(0.5 * SPEED, 0.9 * SPEED))
    assert none.speed is None
    assert "stable at every speed" in none.reason


def test_the_slope_of_the_stiffness_is_exact(film_of, rest_of):
    film = film_of()
    motion = coefficients(film, rest_of(film).position, SPEED).dynamic_stiffness
    for s in (0.3j * SPEED, (0.2 + 0.5j) * SPEED, -0.4 * SPEED + 0j):
        K, slope = motion(s)
        h = 1e-4 * SPEED
        expected = (motion.stiffness(s + h) - motion.stiffness(s - h)) / (2.0 * h)
        np.testing.assert_allclose(slope, expected, atol=1e-7 * np.abs(slope).max())
        np.testing.assert_allclose(K, film.complex_stiffness(rest_of(film).position, SPEED, s), rtol=1e-12)
