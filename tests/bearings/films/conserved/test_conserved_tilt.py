"""The film over the whole length, around a journal that is tilted: forces, moments, derivatives, oil."""

import numpy as np
import pytest

from rotorfilm.bearings import FilmGeometry, Pocket
from rotorfilm.bearings.films.mass_conserving import ConservedFilm, conserved_cells, reynolds_state
from rotorfilm.bearings.films.mass_conserving_steps import FilmInMotion

POCKETS = (Pocket(center=0.3, width=0.4, share=0.8), Pocket(center=3.4, width=0.3, share=0.6))
TWO = FilmGeometry(pockets=POCKETS, supply=0.0106)
PLACE = np.array([0.4, -0.3, 0.2, 0.1])


@pytest.fixture(scope="module")
def whole_of(supply):
    """Return a function that makes the film of a geometry over the whole length."""

    def make(geometry, cells=(72, 6), slenderness=0.5, end=0.0):
        pressures = [end + (span.held or 0.0) for span in geometry.openings()]
        cells = conserved_cells(geometry, *cells, whole=True)
        return ConservedFilm(cells, slenderness, supply(pressures, end))

    return make


def solved(film, place, rate=0.5):
    return film.solve(film.gap(place), rate)


@pytest.mark.closed_form
@pytest.mark.parametrize("end", [0.0, 0.05])
def test_without_tilt_the_whole_is_twice_the_half(end, film_of, whole_of):
    half, whole = film_of(TWO, end=end), whole_of(TWO, end=end)
    one, both = solved(half, PLACE[:2]), solved(whole, PLACE[:2])
    for row, mirrored in zip(both.solution[:2], one.solution[:2], strict=True):
        expected = np.hstack([mirrored[:, ::-1], mirrored])
        np.testing.assert_allclose(row, expected, atol=1e-13 * np.abs(expected).max())
    force, (half_flows, flows) = half.force(one), (half.flows(one), whole.flows(both))
    expected = np.append(force, [0.0, 0.0])
    np.testing.assert_allclose(whole.force(both), expected, atol=1e-13 * np.abs(force).max())
    np.testing.assert_allclose(flows.inflow, half_flows.inflow, rtol=1e-12)
    assert flows.out == pytest.approx(half_flows.out, rel=1e-12)
    assert flows.drawn_in == pytest.approx(half_flows.drawn_in, rel=1e-12)
    assert whole.shear(both) == pytest.approx(half.shear(one), rel=1e-13)
    for s in (0.0, 0.3 + 0.7j):
        K, expected = FilmInMotion(whole, both).stiffness(s), FilmInMotion(half, one).stiffness(s)
        np.testing.assert_allclose(K[:2, :2], expected, rtol=1e-10)
        np.testing.assert_allclose(K[:2, 2:], 0.0, atol=1e-11 * np.abs(K).max())


@pytest.mark.closed_form
@pytest.mark.parametrize("slenderness", [0.5, 1.0])
def test_a_full_film_about_the_center_has_the_damping_of_its_closed_form(slenderness, whole_of):
    tanh = np.tanh(slenderness)
    force = 1.0 - tanh / slenderness
    moment = 1.0 / 3.0 - (slenderness / tanh - 1.0) / slenderness**2
    found = []
    for cells in ((72, 8), (144, 16)):
        film = whole_of(FilmGeometry(), cells, slenderness, end=1.0)
        _, C, _ = FilmInMotion(film, solved(film, np.zeros(4))).slow()
        found.append(C)
        np.testing.assert_allclose(C, np.diag(np.diag(C)), atol=1e-12)
    # Errors of second order, of the angle and of the length.
    errors = [np.diag(C) / (12.0 * np.pi * np.repeat([force, moment], 2)) - 1.0 for C in found]
    np.testing.assert_allclose(errors[0] / errors[1], 4.0, rtol=0.05)
    np.testing.assert_allclose((4.0 * errors[1] - errors[0]) / 3.0, 0.0, atol=1e-4)


@pytest.mark.literature
@pytest.mark.parametrize(
    ("slenderness", "place", "expected"),
    [
        (0.5, (0.4, -0.3, 0.2, 0.1), (0.0104, 0.6335, -0.0390, 0.0169)),
        (1.0, (0.3, -0.4, 0.15, -0.1), (0.6354, 1.7298, -0.0392, 0.1846)),
    ],
)
def test_with_reynolds_rupture_it_is_the_tilted_reynolds_film(slenderness, place, expected, whole_of):
    film = whole_of(FilmGeometry(), (192, 24), slenderness)
    x, y, a, b = place
    sliding = 0.5 * np.array([y, -x, b, -a])  # at rest, in axes that turn with half the speed
    found = film.force(reynolds_state(film, np.array(place), sliding))
    np.testing.assert_allclose(found, expected, atol=4e-3 * np.abs(expected).max())


@pytest.mark.closed_form
@pytest.mark.parametrize("rate", [0.5, -0.5])
def test_a_tilted_film_conserves_its_oil(rate, whole_of):
    film = whole_of(TWO, end=0.005)
    state = solved(film, PLACE, rate)
    flows, full = film.flows(state), state.solution.full != 0
    assert 0.1 < full.mean() < 0.9
    assert not np.array_equal(full, full[:, ::-1])  # the tilt moves the cavity
    assert flows.drawn_in > 0.0
    assert flows.inflow.sum() + flows.drawn_in == pytest.approx(flows.out, rel=1e-12)
    assert flows.defect < 1e-13


@pytest.mark.closed_form
def test_the_other_tilt_is_the_mirror_image(whole_of):
    film = whole_of(TWO)
    one, other = (film.force(solved(film, PLACE * [1.0, 1.0, sign, sign])) for sign in (1.0, -1.0))
    np.testing.assert_allclose(other, one * [1.0, 1.0, -1.0, -1.0], rtol=1e-10)
    assert np.abs(one[2:]).min() > 1e-3 * np.abs(one[:2]).max()


def test_stiffness_by_places_and_tilts_is_that_of_the_force(whole_of):
    film, step = whole_of(TWO), 1e-6
    K, C, by_speed = FilmInMotion(film, solved(film, PLACE)).slow()
    sides = [
        [film.force(solved(film, PLACE + side * step * unit)) for side in (1.0, -1.0)] for unit in np.eye(4)
    ]
    expected = np.array([(ahead - back) / (2.0 * step) for ahead, back in sides]).T
    np.testing.assert_allclose(-K, expected, atol=1e-6 * np.abs(K).max())
    assert C.shape == (4, 4)
    faster, slower = (film.force(solved(film, PLACE, rate)) for rate in (0.5005, 0.4995))
    np.testing.assert_allclose(by_speed, (faster - slower) / 2e-3, rtol=1e-4)
