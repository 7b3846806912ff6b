"""What every film law must obey: exact derivatives, symmetries, and the limits of its state space."""

import numpy as np
import pytest
from hypothesis import given, settings, strategies as st

from rotorfilm import FilmContactError, UndefinedDerivativeError
from rotorfilm.bearings import tabulate_film
from rotorfilm.bearings.journal import (
    ComplementarityArc,
    FixedArc,
    MapFilm,
    ReynoldsArc,
    RotatingArc,
    ShortFilm,
    SpectralArcFilm,
    SplittingFilm,
)

CUT = FixedArc(start=0.3, extent=5.9)
FILMS = {
    "short": ShortFilm(),
    "(1,1)": SplittingFilm(order=(1, 1)),
    "(1,all) rotating": SplittingFilm(order=(1, None), rupture=RotatingArc()),
    "(2,1)": SplittingFilm(order=(2, 1)),
    "(2,all)": SplittingFilm(order=(2, None)),
    "(2,all) short arc": SplittingFilm(order=(2, None), rupture=FixedArc(start=0.3, extent=2.5)),
    "(2,3) rotating": SplittingFilm(order=(2, 3), rupture=RotatingArc()),
    "(3,2)": SplittingFilm(order=(3, 2)),
    "(6,3) rotating": SplittingFilm(order=(6, 3), rupture=RotatingArc()),
    "(6+c,all) cut": SplittingFilm(order=(6, None), constant=True, rupture=CUT),
    "(4,all) periodic": SplittingFilm(order=(4, None), rupture=FixedArc(extent=2.0 * np.pi)),
    "spectral": SpectralArcFilm(degree=32),
    "spectral rotating": SpectralArcFilm(degree=32, rupture=RotatingArc()),
    "(4+c,all) Reynolds": SplittingFilm(order=(4, None), constant=True, rupture=ReynoldsArc()),
    "(5+c,2) Reynolds": SplittingFilm(order=(5, 2), constant=True, rupture=ReynoldsArc()),
    "spectral Reynolds": SpectralArcFilm(degree=32, rupture=ReynoldsArc()),
    "(4+c,8) complementary": SplittingFilm(order=(4, 8), constant=True, rupture=ComplementarityArc()),
    "spectral complementary": SpectralArcFilm(degree=32, rupture=ComplementarityArc()),
    "map": MapFilm(tabulate_film(ShortFilm(), slenderness_range=(0.1, 1.0), cells=(16, 32, 5))),
}
# Reynolds' condition at one end only is not mirrored by swapping the ends.
MIRRORED = ("rotating", "short", "complementary", "map")
ROTATING = {name: film for name, film in FILMS.items() if any(word in name for word in MIRRORED)}
ROTATING.pop("(2,all) short arc")
# One circumferential function has no isotropic limit at the center.
ISOTROPIC = {name: film for name, film in ROTATING.items() if not name.startswith("(1,")}
films = pytest.mark.parametrize("film", FILMS.values(), ids=FILMS.keys())

angle = st.floats(-3.1, 3.1)
states = st.tuples(st.floats(0.05, 0.95), angle, st.floats(0.2, 3.0), angle)


def vectors(chi, phi, size, direction):
    e = chi * np.array([np.cos(phi), np.sin(phi)])
    return e, size * np.array([np.cos(direction), np.sin(direction)])


def size(force, source):
    return np.linalg.norm(force) + np.linalg.norm(source)


def random_states(count, largest=0.9):
    rng = np.random.default_rng(7)
    chi, phi = rng.uniform(0.05, largest, count), rng.uniform(-np.pi, np.pi, count)
    return chi * np.stack([np.cos(phi), np.sin(phi)]), rng.normal(size=(2, count))


@films
@pytest.mark.parametrize("chi", [1.0, 1.2])
def test_position_at_the_wall_is_contact(film, chi):
    e, w = np.array([0.1, chi]), np.array([-0.3, 0.2])
    for call in (film.force, film.jacobian):
        with pytest.raises(FilmContactError, match=r"eccentricity ratio must be below 1, got 1\."):
            call(e, w, 0.5)


@films
def test_jacobian_equals_differences_of_fourth_order(film):
    e, w = random_states(6, largest=0.8)
    z, h = np.concatenate([e, w]), 1e-4

    def force(states):
        return film.force(states[:2], states[2:], 0.6)

    jacobian = film.jacobian(e, w, 0.6)
    for column in range(4):
        d = np.zeros((4, 1))
        d[column] = h
        near, far = force(z + d) - force(z - d), force(z + 2 * d) - force(z - 2 * d)
        difference = (8.0 * near - far) / (12.0 * h)
        scale = np.abs(jacobian).max(axis=(0, 1))
        np.testing.assert_allclose(jacobian[:, column] / scale, difference / scale, atol=2e-7)


@films
@settings(deadline=None, max_examples=10)
@given(state=states, turn=angle)
def test_rotation_invariance(film, state, turn):
    e, w = vectors(*state)
    R = np.array([[np.cos(turn), -np.sin(turn)], [np.sin(turn), np.cos(turn)]])
    force = film.force(e, w, 0.5)
    np.testing.assert_allclose(film.force(R @ e, R @ w, 0.5), R @ force, atol=1e-8 * size(force, w))


@pytest.mark.parametrize("film", ROTATING.values(), ids=ROTATING.keys())
@settings(deadline=None, max_examples=10)
@given(state=states)
def test_mirror_symmetry_of_films_without_a_fixed_arc(film, state):
    e, w = vectors(*state)
    mirror = np.array([1.0, -1.0])
    force = film.force(e, w, 0.5)
    np.testing.assert_allclose(
        film.force(mirror * e, mirror * w, 0.5), mirror * force, atol=1e-8 * size(force, w)
    )


@films
@settings(deadline=None, max_examples=10)
@given(state=states, factor=st.floats(1e-3, 1e3))
def test_positive_homogeneity_in_the_source(film, state, factor):
    e, w = vectors(*state)
    force = film.force(e, w, 0.5)
    np.testing.assert_allclose(
        film.force(e, factor * w, 0.5), factor * force, atol=1e-8 * factor * size(force, w)
    )


@films
def test_batch_equals_single_states(film):
    e, w = random_states(6)
    batch = film.jacobian(e.reshape(2, 2, 3), w.reshape(2, 2, 3), 0.4)
    assert batch.shape == (2, 4, 2, 3)
    for k in range(6):
        single = film.jacobian(e[:, k], w[:, k], 0.4)
        scale = np.abs(single).max()
        np.testing.assert_allclose(batch.reshape(2, 4, 6)[..., k] / scale, single / scale, atol=1e-9)


@films
def test_empty_batch(film):
    empty = np.zeros((2, 0))
    assert film.force(empty, empty, 0.5).shape == (2, 0)
    assert film.jacobian(empty, empty, 0.5).shape == (2, 4, 0)


@films
@pytest.mark.filterwarnings("ignore::rotorfilm.core.errors.ValidityWarning")
@pytest.mark.parametrize("chi", [0.0, 1e-8, 1e-4, 0.9999])
def test_finite_over_the_whole_range_of_eccentricity(film, chi):
    e, w = np.array([chi, 0.0]), np.array([0.3, -0.5])
    assert np.all(np.isfinite(film.force(e, w, 0.5)))
    assert np.all(np.isfinite(film.jacobian(e, w, 0.5)))


@pytest.mark.closed_form
@pytest.mark.parametrize("film", ISOTROPIC.values(), ids=ISOTROPIC.keys())
def test_isotropic_and_continuous_at_the_center(film):
    w = np.array([0.3, -0.5])
    center = film.jacobian(np.zeros(2), w, 0.5)[:, 2:]
    np.testing.assert_allclose(center, center[0, 0] * np.eye(2), atol=1e-7 * abs(center[0, 0]))
    np.testing.assert_allclose(
        film.jacobian(np.array([1e-6, 0]), w, 0.5)[:, 2:], center, rtol=2e-6, atol=3e-6
    )


@pytest.mark.closed_form
@pytest.mark.parametrize("name", [*ISOTROPIC, "(4,all) periodic"])
def test_stiffness_and_damping_identities_of_a_full_bearing_near_the_center(name):
    # K_xy = omega C_xx/2 and K_yx = -omega C_yy/2 as chi -> 0; omega = 1.
    e = np.array([1e-4, 0.0])
    w = -0.5 * np.array([-e[1], e[0]])
    jacobian = FILMS[name].jacobian(e, w, 0.5)
    quarter = np.array([[0.0, -1.0], [1.0, 0.0]])
    K, C = -(jacobian[:, :2] - 0.5 * jacobian[:, 2:] @ quarter), -jacobian[:, 2:]
    assert K[0, 1] == pytest.approx(0.5 * C[0, 0], rel=1e-3)
    assert K[1, 0] == pytest.approx(-0.5 * C[1, 1], rel=1e-3)
    assert abs(K[0, 0]) < 1e-3 * K[0, 1]


@pytest.mark.parametrize("film", ROTATING.values(), ids=ROTATING.keys())
def test_vanishing_source_has_a_force_of_zero_and_no_derivative(film):
    e, w = np.array([0.5, 0.0]), np.zeros(2)
    np.testing.assert_array_equal(film.force(e, w, 0.5), 0.0)
    with pytest.raises(UndefinedDerivativeError, match=r"source .* must not vanish .* got w = 0"):
        film.jacobian(e, w, 0.5)


def test_fixed_arc_is_differentiable_where_the_source_vanishes():
    jacobian = SplittingFilm(order=(2, 1)).jacobian(np.array([0.5, 0.0]), np.zeros(2), 0.5)
    np.testing.assert_array_equal(jacobian[:, :2], 0.0)
    assert np.all(np.linalg.eigvalsh(-jacobian[:, 2:]) > 0.0)
