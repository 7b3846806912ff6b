"""Quintic interpolation, the table of a map: order, symmetries, and what a damaged file says."""

import numpy as np
import pytest
from scipy.interpolate import BSpline, make_interp_spline

from rotorfilm import InputError, RotorfilmError
from rotorfilm.bearings import MapTable, fit_map_table, tabulate_film
from rotorfilm.bearings.films.map_fit import node_eccentricities, quintic_coefficients
from rotorfilm.bearings.films.map_table import stretch, unstretch
from rotorfilm.bearings.journal import MapFilm, ShortFilm

SMALL = tabulate_film(ShortFilm(), slenderness_range=(0.1, 4.0), cells=(8, 10, 5))


def interpolated(values, at):
    cells = len(values) - 1
    knots = np.arange(-5, cells + 6) / cells
    return float(BSpline(knots, quintic_coefficients(values), 5)(at))


@pytest.mark.parametrize("cells", [5, 9])
def test_quintic_is_the_not_a_knot_spline(cells):
    values = np.random.default_rng(2).normal(size=cells + 1)
    other = make_interp_spline(np.linspace(0.0, 1.0, cells + 1), values, k=5)
    for at in np.linspace(0.0, 1.0, 23):
        assert interpolated(values, at) == pytest.approx(float(other(at)), abs=1e-11)


@pytest.mark.convergence
def test_quintic_is_of_sixth_order_up_to_the_ends():
    points = np.linspace(0.0, 1.0, 101)
    errors = []
    for cells in (24, 48):
        values = np.sin(5.0 * np.linspace(0.0, 1.0, cells + 1))
        errors.append(max(abs(interpolated(values, at) - np.sin(5.0 * at)) for at in points))
    assert np.log2(errors[0] / errors[1]) == pytest.approx(6.0, abs=0.4)


def test_stretch_and_its_inverse():
    chi = np.array([0.0, 1e-9, 0.1, 0.5, 0.99, 0.999, 1.0 - 1e-9])
    np.testing.assert_allclose(unstretch(stretch(chi)), chi, rtol=1e-13)
    assert node_eccentricities(0.999, 12)[-1] == pytest.approx(0.999, rel=1e-14)


def smooth_potential(chi, cos, S):
    """Return an analytic L with the parity of a film: a function of chi^2, chi cos and S alone."""
    a = chi * cos
    return (
        2.0 * S
        - np.log(1.0 + np.exp(S))
        + np.exp(-0.3 * S) * (0.8 * a + 0.5 * a**2 + chi**2 - 0.3 * a * chi**2)
    )


def synthetic_table(cells, **options):
    chi = node_eccentricities(0.9, cells)[:, None]
    S = np.linspace(np.log(0.1), np.log(4.0), cells + 1)
    L = np.stack([smooth_potential(chi, np.linspace(-1.0, 1.0, cells + 1), s) for s in S])
    return fit_map_table(L, slenderness_range=(0.1, 4.0), largest_eccentricity_ratio=0.9, **options)


def force_error(table, slenderness):
    """Return the largest relative error of the potential, which is F.w/2, over random states."""
    rng = np.random.default_rng(4)
    chi, turn = rng.uniform(0.0, 0.9, 300), rng.uniform(-np.pi, np.pi, 300)
    e, w = np.stack([chi * np.cos(turn), chi * np.sin(turn)]), np.stack([np.ones(300), np.zeros(300)])
    force = MapFilm(table).force(e, w, slenderness)
    exact = smooth_potential(chi, np.cos(turn), np.log(slenderness))
    return np.abs(np.log(-0.5 * force[0]) - exact).max()


@pytest.mark.convergence
def test_table_is_of_sixth_order_in_all_three_axes_together():
    errors = [
        max(force_error(synthetic_table(cells), ratio) for ratio in (0.13, 0.77, 3.1)) for cells in (12, 24)
    ]
    assert errors[1] < 1e-6
    assert np.log2(errors[0] / errors[1]) > 5.3


@pytest.mark.closed_form
def test_slope_at_the_center_is_extrapolated_or_given():
    exact = 0.8 * np.exp(-0.3 * np.linspace(np.log(0.1), np.log(4.0), 25))
    given, guessed = synthetic_table(24, slope=exact), synthetic_table(24)
    np.testing.assert_allclose(guessed.coefficients, given.coefficients, atol=2e-5)
    e, w = np.full((2, 1), 1e-6), np.array([[1.0], [0.0]])
    stiffness = MapFilm(given).jacobian(e, w, 0.1)[:, :2, 0]
    # dF/de at the center, w along x: -2 e^L0 diag(slope, slope/2).
    expected = -2.0 * np.exp(smooth_potential(0.0, 0.0, np.log(0.1))) * exact[0] * np.diag([1.0, 0.5])
    np.testing.assert_allclose(stiffness, expected, atol=1e-5)


@pytest.mark.closed_form
def test_error_against_the_short_film_falls_as_the_table_grows():
    rng = np.random.default_rng(8)
    chi, phi = rng.uniform(0.0, 0.95, 500), rng.uniform(-np.pi, np.pi, 500)
    e, w = chi * np.stack([np.cos(phi), np.sin(phi)]), rng.normal(size=(2, 500))
    exact = ShortFilm().force(e, w, 0.25)
    errors = []
    for cells in ((12, 24, 0), (24, 48, 0)):
        film = MapFilm(tabulate_film(ShortFilm(), slenderness_range=(0.25, 0.25), cells=cells))
        difference = np.linalg.norm(film.force(e, w, 0.25) - exact, axis=0) / np.linalg.norm(exact, axis=0)
        errors.append(np.quantile(difference, 0.99))
    assert errors[0] < 2e-5
    assert errors[0] / errors[1] > 2**5


def test_parity_through_the_center_is_exact_in_the_coefficients():
    # M(-X, T) = -M(X, 1 - T): the coefficients around X = 0 mirror each other.
    collapsed = SMALL.at(0.5)[0]
    np.testing.assert_allclose(collapsed[:2], -collapsed[4:2:-1, ::-1], atol=1e-12)
    np.testing.assert_allclose(collapsed[2], -collapsed[2, ::-1], atol=1e-12)


def test_round_trip(tmp_path):
    SMALL.save(tmp_path / "map.bin")
    again = MapTable.load(tmp_path / "map.bin")
    assert again == SMALL
    assert hash(again) == hash(SMALL)
    assert again.to_bytes() == SMALL.to_bytes()
    assert again.largest_eccentricity_ratio == pytest.approx(0.99, rel=1e-14)


def test_rounded_table_takes_half_the_bytes_and_is_off_by_half_a_quantum():
    content, quantum = SMALL.to_bytes(2.0**-20), 2.0**-20
    again = MapTable.from_bytes(content)
    assert len(content) < 0.55 * len(SMALL.to_bytes())
    assert 0.0 < np.abs(again.coefficients - SMALL.coefficients).max() <= 0.5 * quantum
    np.testing.assert_array_equal(again.log_center, SMALL.log_center)
    assert again.to_bytes(quantum) == content
    with pytest.raises(InputError, match=r"quantum must be above .* got 1e-20"):
        SMALL.to_bytes(1e-20)


@pytest.mark.parametrize(
    ("damage", "message"),
    [
        (lambda b: b"x" + b[1:], "MapTable: the content does not begin with the mark of a table"),
        (lambda b: b[:15], "mark of a table"),
        (lambda b: b[:20], "checksum"),
        (lambda b: b[:-8], "checksum"),
        (lambda b: b[:-1] + bytes([b[-1] ^ 1]), "checksum"),
        (lambda b: b[:8] + b"\3" + b[9:], "version must be 1, got 3"),
    ],
)
def test_damaged_content_is_refused(damage, message):
    with pytest.raises(RotorfilmError, match=message):
        MapTable.from_bytes(damage(SMALL.to_bytes()))


@pytest.mark.parametrize("slenderness", [0.0999, 4.001, np.nan])
def test_slenderness_outside_the_table_is_refused(slenderness):
    with pytest.raises(
        InputError, match=r"length/diameter must be within the table of the film, 0.1 to 4, got"
    ):
        SMALL.at(slenderness)


def test_edges_of_the_slenderness_range_belong_to_it():
    for slenderness in (0.1, 4.0):
        assert SMALL.at(slenderness)[1] == pytest.approx(float(np.log(0.5 * 4 * slenderness**2 * np.pi / 2)))


@pytest.mark.parametrize(
    ("change", "message"),
    [
        ({"slenderness_range": (4.0, 0.1)}, "slenderness_range"),
        ({"reach": -1.0}, "reach must be positive"),
        ({"log_center": np.full(10, np.nan)}, "log_center must be finite"),
        ({"log_center": np.zeros(3)}, r"coefficients must be finite, of shape \(3, 6 or more, 6 or more\)"),
    ],
)
def test_inconsistent_table_is_refused(change, message):
    fields = {
        name: getattr(SMALL, name) for name in ("slenderness_range", "reach", "log_center", "coefficients")
    }
    with pytest.raises(InputError, match=message):
        MapTable(**{**fields, **change})


def test_bad_potentials_are_refused():
    L = np.zeros((1, 7, 7))
    L[0, 0, 3] = 1.0
    options = {"slenderness_range": (1.0, 1.0), "largest_eccentricity_ratio": 0.9}
    with pytest.raises(InputError, match="same for all directions"):
        fit_map_table(L, **options)
    with pytest.raises(InputError, match="6 nodes per axis"):
        fit_map_table(np.zeros((1, 5, 7)), **options)
