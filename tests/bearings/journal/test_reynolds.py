"""The two-dimensional film: orders of convergence, closed-form limits, exact derivatives, symmetries."""

import dataclasses

import numpy as np
import pytest
from hypothesis import given, settings, strategies as st
from scipy.integrate import quad
from scipy.optimize import brentq

from rotorfilm import FilmContactError, FullFilm, Groove, InputError, Pad, UndefinedDerivativeError
from rotorfilm.bearings import (
    Complementarity,
    FilmGeometry,
    FilmLaw,
    FreeOnset,
    HalfSommerfeld,
    MaximumGapOnset,
    Pocket,
)
from rotorfilm.bearings.journal import FixedArc, MapFilm, ReynoldsFilm, ShortFilm, SpectralArcFilm

HALF_TURN = np.array([[0.0, -1.0], [1.0, 0.0]])
GROOVES = FilmGeometry(grooves=(Groove(center=0.4, width=0.3), Groove(center=-2.2)), supply=0.1)
POCKETS = FilmGeometry(
    pockets=(Pocket(center=0.4, width=0.3, share=0.6), Pocket(center=-2.2, width=0.0, share=0.3)),
    supply=0.1,
)
ALL_ROUND = FilmGeometry(circumferential=True, supply=0.1)
PADS = FilmGeometry(pads=tuple(Pad(start=s, extent=1.8) for s in (0.1, 2.2, 4.3)))
FILMS = {
    "ruptured": ReynoldsFilm(cells=(48, 4)),
    "half": ReynoldsFilm(cells=(48, 4), cavitation=HalfSommerfeld()),
    "full": ReynoldsFilm(cells=(48, 4), cavitation=FullFilm()),
    "ruptured, grooves": ReynoldsFilm(cells=(48, 4), geometry=GROOVES),
    "full, grooves": ReynoldsFilm(cells=(48, 4), cavitation=FullFilm(), geometry=GROOVES),
    "ruptured, pads": ReynoldsFilm(cells=(48, 4), geometry=PADS),
    "ruptured, pockets": ReynoldsFilm(cells=(48, 4), geometry=POCKETS),
    "ruptured, circumferential": ReynoldsFilm(cells=(48, 4), geometry=ALL_ROUND),
    "ruptured, widest gap": ReynoldsFilm(cells=(48, 4), film_start=MaximumGapOnset()),
}
films = pytest.mark.parametrize("film", FILMS.values(), ids=FILMS.keys())
PLAIN = [FILMS[name] for name in ("ruptured", "half", "full")]

WEDGE, SQUEEZE, MIXED = np.array([0.0, -0.5]), np.array([1.0, 0.0]), np.array([-0.4, 0.6])
angle = st.floats(-3.1, 3.1)
states = st.tuples(st.floats(0.05, 0.9), angle, st.floats(0.2, 3.0), angle)


def vectors(chi, phi, size, direction):
    e = chi * np.array([np.cos(phi), np.sin(phi)])
    return e, size * np.array([np.cos(direction), np.sin(direction)])


def with_cells(film, around, along):
    return dataclasses.replace(film, cells=(around, along))


def observed_order(film, e, w, slenderness, coarse=(64, 8)):
    """Return log2 of the ratio of the errors of two grids, against an extrapolation from finer ones."""
    n, m = coarse
    exact, _ = with_cells(film, 8 * n, 4 * m).extrapolated(e, w, slenderness)
    errors = [np.hypot(*(with_cells(film, k * n, k * m).force(e, w, slenderness) - exact)) for k in (1, 2)]
    return np.log2(errors[0] / errors[1])


@pytest.mark.convergence
@pytest.mark.parametrize("cavitation", [Complementarity(), HalfSommerfeld(), FullFilm()])
@pytest.mark.parametrize("w", [WEDGE, SQUEEZE, MIXED], ids=["static", "squeeze", "mixed"])
def test_order_of_the_full_bearing(cavitation, w):
    film = ReynoldsFilm(cavitation=cavitation)
    e = np.array([0.6, 0.0])
    assert observed_order(film, e, w, 0.5) == pytest.approx(film.order, abs=0.25)


@pytest.mark.convergence
@pytest.mark.parametrize(
    "geometry", [PADS, dataclasses.replace(GROOVES, supply=0.0)], ids=["pads", "grooves"]
)
@pytest.mark.parametrize("slenderness", [0.3, 1.0])
def test_order_with_pads_and_grooves(geometry, slenderness):
    film = ReynoldsFilm(cavitation=FullFilm(), geometry=geometry)
    order = observed_order(film, np.array([0.5, 0.2]), MIXED, slenderness)
    assert order == pytest.approx(film.order, abs=0.25)


@pytest.mark.convergence
@pytest.mark.parametrize("cavitation", [Complementarity(), FullFilm()])
@pytest.mark.parametrize("slenderness", [0.3, 1.0])
def test_order_with_supply_is_lower(cavitation, slenderness):
    # At the open end of a groove the pressure jumps from supply to ambient. The force feels it weakly; the
    # flow out of the film beside it grows without bound, with the logarithm of the cell.
    film = ReynoldsFilm(cavitation=cavitation, geometry=GROOVES)
    e = np.array([0.5, 0.2])
    assert observed_order(film, e, MIXED, slenderness) == pytest.approx(film.order_with_supply, abs=0.25)
    flows = [with_cells(film, k * 64, k * 8).solve(e, MIXED, slenderness).side_flow for k in (1, 2, 4)]
    assert flows[2] - flows[1] == pytest.approx(flows[1] - flows[0], rel=0.05)
    assert flows[2] - flows[1] > 0.1 * flows[0]


@pytest.mark.convergence
@settings(deadline=None, max_examples=30)
@given(state=states, slenderness=st.sampled_from([0.25, 1.0, 3.0]))
def test_error_estimate_tells_the_size_of_the_error(state, slenderness):
    e, w = vectors(*state)
    film = ReynoldsFilm(cells=(64, 8))
    exact, _ = with_cells(film, 256, 16).extrapolated(e, w, slenderness)
    _, estimate = film.extrapolated(e, w, slenderness)
    error = np.hypot(*(film.force(e, w, slenderness) - exact))
    assert error <= 3.0 * estimate + 1e-3 * np.hypot(*exact)


def long_limit(film, e, w):
    """Return the force of an infinitely long film: the ends cost a share that is inverse to the length."""
    return 2.0 * film.extrapolated(e, w, 20.0)[0] - film.extrapolated(e, w, 10.0)[0]


@pytest.mark.closed_form
@pytest.mark.parametrize("chi", [0.2, 0.6, 0.9])
def test_long_full_film_is_sommerfeld(chi):
    # F_t = 12 pi chi/((2 + chi^2) sqrt(1 - chi^2)) for omega = 1.
    film = ReynoldsFilm(cells=(96, 32), cavitation=FullFilm())
    force = long_limit(film, np.array([chi, 0.0]), np.array([0.0, -0.5 * chi]))
    exact = 12.0 * np.pi * chi / ((2.0 + chi**2) * np.sqrt(1.0 - chi**2))
    np.testing.assert_allclose(force, [0.0, exact], atol=1e-3 * exact)


@pytest.mark.closed_form
@pytest.mark.parametrize("chi", [0.2, 0.6, 0.9])
def test_long_half_film_is_half_of_sommerfeld(chi):
    # p = chi sin g (2 + chi cos g)/(2 (2 + chi^2) (1 + chi cos g)^2) where positive, for omega = 1.
    film = ReynoldsFilm(cells=(96, 32), cavitation=HalfSommerfeld())
    force = long_limit(film, np.array([chi, 0.0]), np.array([0.0, -0.5 * chi]))
    root = 1.0 - chi**2
    exact = np.array([-12.0 * chi**2 / root, 6.0 * np.pi * chi / np.sqrt(root)]) / (2.0 + chi**2)
    np.testing.assert_allclose(force, exact, atol=2e-3 * np.hypot(*exact))


@pytest.mark.closed_form
@pytest.mark.parametrize("chi", [0.3, 0.7])
def test_long_ruptured_film_with_a_line_groove_at_the_maximum_film(chi):
    # 1-D Reynolds condition: H^3 p' = (cos g - cos g2) chi/2 for omega = 1, p(0) = p(g2) = 0.
    def slope(g, end):
        return 0.5 * chi * (np.cos(g) - np.cos(end)) / (1.0 + chi * np.cos(g)) ** 3

    end = brentq(lambda end: quad(slope, 0.0, end, args=(end,), epsabs=1e-12)[0], np.pi + 0.05, 1.9 * np.pi)
    # n = -(cos g, sin g) at theta = g + pi, and by parts F = 12 integral of p (cos g, sin g).
    radial = -12.0 * quad(lambda g: slope(g, end) * np.sin(g), 0.0, end, epsabs=1e-12)[0]
    tangential = 12.0 * quad(lambda g: slope(g, end) * np.cos(g), 0.0, end, epsabs=1e-12)[0]
    film = ReynoldsFilm(cells=(128, 32), geometry=FilmGeometry(grooves=(Groove(center=np.pi),)))
    force = long_limit(film, np.array([chi, 0.0]), np.array([0.0, -0.5 * chi]))
    np.testing.assert_allclose(force, [radial, tangential], rtol=2e-3)


@pytest.mark.closed_form
@settings(deadline=None, max_examples=20)
@given(state=states)
def test_short_limit_is_the_short_film(state):
    e, w = vectors(*state)
    film = ReynoldsFilm(cells=(192, 8))
    short = ShortFilm().force(e, w, 0.01)
    np.testing.assert_allclose(film.extrapolated(e, w, 0.01)[0], short, atol=6e-3 * np.hypot(*short))


@pytest.mark.closed_form
@pytest.mark.parametrize("slenderness", [0.25, 1.0, 4.0])
@pytest.mark.parametrize("w", [WEDGE, SQUEEZE], ids=["static", "squeeze"])
@pytest.mark.parametrize(("start", "extent"), [(0.0, np.pi), (0.5, 2.0)])
def test_full_film_on_a_pad_equals_the_spectral_arc(start, extent, w, slenderness):
    # The journal moves towards +x, so gamma = theta - pi.
    e = np.array([0.7, 0.0])
    pad = FilmGeometry(pads=(Pad(start=start + np.pi, extent=extent),))
    film = ReynoldsFilm(cells=(128, 16), cavitation=FullFilm(), geometry=pad)
    exact = SpectralArcFilm(rupture=FixedArc(start=start, extent=extent)).force(e, w, slenderness)
    force, _ = film.extrapolated(e, w, slenderness)
    np.testing.assert_allclose(force, exact, atol=1e-4 * np.hypot(*exact))


@pytest.mark.closed_form
@pytest.mark.parametrize("slenderness", [0.1, 1.0, 4.0])
@pytest.mark.parametrize("cavitation", [Complementarity(), FullFilm()])
def test_identities_of_a_full_bearing_at_the_center(cavitation, slenderness):
    # K_xy = omega C_xx/2 and K_yx = -omega C_yy/2 as chi -> 0; omega = 1.
    e = np.array([1e-5, 0.0])
    film = ReynoldsFilm(cavitation=cavitation)
    jacobian = film.jacobian(e, -0.5 * HALF_TURN @ e, slenderness)
    K, C = -(jacobian[:, :2] - 0.5 * jacobian[:, 2:] @ HALF_TURN), -jacobian[:, 2:]
    assert K[0, 1] == pytest.approx(0.5 * C[0, 0], rel=3e-3)
    assert K[1, 0] == pytest.approx(-0.5 * C[1, 1], rel=3e-3)
    assert C[0, 0] == pytest.approx(C[1, 1], rel=1e-2)


def random_states(count):
    rng = np.random.default_rng(3)
    chi, phi = rng.uniform(0.05, 0.85, count), rng.uniform(-np.pi, np.pi, count)
    return chi * np.stack([np.cos(phi), np.sin(phi)]), rng.normal(size=(2, count))


@films
def test_derivatives_in_the_source_equal_differences(film):
    e, w = random_states(12)
    jacobian, h = film.jacobian(e, w, 0.6), 1e-6
    scale = np.abs(jacobian).max(axis=(0, 1))
    for column, d in enumerate(h * np.eye(2)[:, :, None]):
        slope = (film.force(e, w + d, 0.6) - film.force(e, w - d, 0.6)) / (2 * h)
        np.testing.assert_allclose(jacobian[:, 2 + column] / scale, slope / scale, atol=2e-7)


@pytest.mark.convergence
@films
def test_derivatives_in_the_eccentricity_converge_to_differences_of_the_force(film):
    e, w = random_states(12)
    exact, h = with_cells(film, 384, 16), 0.05 * (1.0 - np.hypot(*e))
    slopes = []
    for unit in np.eye(2)[:, :, None]:
        low2, low, high, high2 = (exact.extrapolated(e + k * h * unit, w, 0.6)[0] for k in (-2, -1, 1, 2))
        slopes.append((low2 - 8.0 * low + 8.0 * high - high2) / (12.0 * h))
    errors = {}
    for cells in ((96, 8), (192, 16)):
        jacobian = with_cells(film, *cells).jacobian(e, w, 0.6)[:, :2]
        scale = np.abs(jacobian).max(axis=(0, 1))
        errors[cells] = np.median(np.abs(jacobian - np.stack(slopes, axis=1)).max(axis=(0, 1)) / scale)
    # Edges of the film that begin at a line, or at a corner, jump more.
    bound = (
        1.0 if film.film_start == FreeOnset() and film.geometry in (FilmGeometry(), GROOVES, PADS) else 2.0
    )
    assert errors[96, 8] < bound * 1e-2
    assert errors[192, 16] < bound * 3e-3


@pytest.mark.convergence
@pytest.mark.parametrize("chi", [0.9, 0.98])
@pytest.mark.parametrize("direction", [100.0, 120.0, 150.0, 180.0])
def test_derivatives_of_a_film_whose_journal_leaves_the_wall(chi, direction):
    # The lines are sparse opposite the wall, where the pressure is, and move fast: along with them the
    # derivative of this force is off by 1.8 times its largest entry on the coarser grid, by .4 on the finer.
    e, w = vectors(chi, 0.3, 1.0, 0.3 + np.radians(direction))
    exact = MapFilm().jacobian(e, w, 0.1)
    for cells, error in (((96, 8), 0.03), ((384, 32), 0.003)):
        jacobian = ReynoldsFilm(cells=cells).jacobian(e, w, 0.1)
        np.testing.assert_allclose(jacobian[:, :2], exact[:, :2], atol=error * np.abs(exact[:, :2]).max())


@pytest.mark.parametrize("chi", [0.0, 1e-9, 1e-4])
def test_jacobian_is_regular_around_the_center(chi):
    film = FILMS["ruptured"]
    near = film.jacobian(np.array([chi, 0.0]), MIXED, 0.5)
    center = film.jacobian(np.zeros(2), MIXED, 0.5)
    np.testing.assert_allclose(near, center, atol=1e-3 * np.abs(center).max())


@films
@settings(deadline=None, max_examples=20)
@given(state=states)
def test_damping_is_symmetric_and_positive_semidefinite(film, state):
    e, w = vectors(*state)
    C = -film.jacobian(e, w, 0.5)[:, 2:]
    if not film.cavitation.clipped:  # Dropping pressures afterwards leaves no potential.
        np.testing.assert_allclose(C, C.T, atol=1e-11 * np.abs(C).max())
        assert np.all(np.linalg.eigvalsh(C) >= -1e-11 * np.abs(C).max())


@pytest.mark.parametrize("film", PLAIN, ids=["ruptured", "half", "full"])
@settings(deadline=None, max_examples=20)
@given(state=states, factor=st.floats(1e-3, 1e3))
def test_positive_homogeneity_without_supply(film, state, factor):
    e, w = vectors(*state)
    force = film.force(e, w, 0.5)
    np.testing.assert_allclose(
        film.force(e, factor * w, 0.5), factor * force, atol=1e-9 * factor * np.hypot(*force)
    )


@pytest.mark.parametrize("film", PLAIN, ids=["ruptured", "half", "full"])
@settings(deadline=None, max_examples=20)
@given(state=states, steps=st.integers(1, 47))
def test_rotation_by_whole_cells_and_mirror_are_exact(film, state, steps):
    e, w = vectors(*state)
    turn = 2.0 * np.pi * steps / 48
    R = np.array([[np.cos(turn), -np.sin(turn)], [np.sin(turn), np.cos(turn)]])
    force = film.force(e, w, 0.5)
    np.testing.assert_allclose(film.force(R @ e, R @ w, 0.5), R @ force, atol=1e-8 * np.hypot(*force))
    mirror = np.array([1.0, -1.0])
    np.testing.assert_allclose(
        film.force(mirror * e, mirror * w, 0.5), mirror * force, atol=1e-8 * np.hypot(*force)
    )


@settings(deadline=None, max_examples=20)
@given(state=states, turn=angle)
def test_rotation_invariance_within_the_discretization_error(state, turn):
    e, w = vectors(*state)
    film = ReynoldsFilm(cells=(96, 8))
    R = np.array([[np.cos(turn), -np.sin(turn)], [np.sin(turn), np.cos(turn)]])
    force = film.force(e, w, 0.5)
    np.testing.assert_allclose(film.force(R @ e, R @ w, 0.5), R @ force, atol=5e-3 * np.hypot(*force))


@settings(deadline=None, max_examples=20)
@given(state=states, turn=angle)
def test_bearing_with_grooves_turns_as_a_whole(state, turn):
    e, w = vectors(*state)
    R = np.array([[np.cos(turn), -np.sin(turn)], [np.sin(turn), np.cos(turn)]])
    turned = tuple(dataclasses.replace(g, center=g.center + turn) for g in GROOVES.grooves)
    film = ReynoldsFilm(cells=(48, 4), geometry=dataclasses.replace(GROOVES, grooves=turned))
    force = FILMS["ruptured, grooves"].force(e, w, 0.5)
    np.testing.assert_allclose(film.force(R @ e, R @ w, 0.5), R @ force, atol=1e-8 * (np.hypot(*force) + 1.0))


@films
def test_batch_equals_single_states(film):
    rng = np.random.default_rng(5)
    e, w = rng.uniform(-0.6, 0.6, (2, 6)), rng.normal(size=(2, 6))
    force = film.force(e.reshape(2, 2, 3), w.reshape(2, 2, 3), 0.4)
    jacobian = film.jacobian(e.reshape(2, 2, 3), w.reshape(2, 2, 3), 0.4)
    assert (force.shape, jacobian.shape) == ((2, 2, 3), (2, 4, 2, 3))
    for k in range(6):
        np.testing.assert_allclose(force.reshape(2, 6)[:, k], film.force(e[:, k], w[:, k], 0.4))
        np.testing.assert_allclose(jacobian.reshape(2, 4, 6)[..., k], film.jacobian(e[:, k], w[:, k], 0.4))


@films
@pytest.mark.parametrize("slenderness", [0.1, 4.0])
@pytest.mark.parametrize("chi", [0.0, 1e-8, 0.99, 0.9999])
def test_finite_over_the_whole_range(film, chi, slenderness):
    e = chi * np.array([0.6, 0.8])
    for w in (WEDGE, SQUEEZE, -SQUEEZE, MIXED):
        assert np.all(np.isfinite(film.force(e, w, slenderness)))
        assert np.all(np.isfinite(film.jacobian(e, w, slenderness)))


@films
@pytest.mark.parametrize("chi", [1.0, 1.2])
def test_position_at_the_wall_is_contact(film, chi):
    e = chi * np.array([1.0, 0.0])
    for call in (film.force, film.jacobian, film.extrapolated):
        with pytest.raises(FilmContactError, match=r"eccentricity ratio must be below 1, got 1"):
            call(e, WEDGE, 0.5)
    with pytest.raises(FilmContactError, match=r"eccentricity ratio must be below 1, got 1"):
        film.solve(e, WEDGE, 0.5)


@films
def test_film_is_there_up_to_the_wall(film):
    for turn in (0.0, 0.3, 2.0):
        e = (1.0 - 1e-15) * np.array([np.cos(turn), np.sin(turn)])
        assert np.all(np.isfinite(film.force(e, MIXED, 0.5)))


def test_ruptured_pressure_obeys_complementarity():
    film = ReynoldsFilm(cells=(64, 8))
    field = film.solve(np.array([0.6, 0.1]), MIXED, 0.7)
    assert np.all(field.pressure >= 0.0)
    assert 0.2 < np.mean(field.pressure[:, 0] > 0.0) < 0.8
    np.testing.assert_array_equal(field.pressure[:, -1], 0.0)
    np.testing.assert_allclose(field.force, film.force(np.array([0.6, 0.1]), MIXED, 0.7), rtol=1e-12)


@pytest.mark.closed_form
def test_side_flow_balances_the_squeeze_of_a_pad_in_pressure():
    # Everything displaced by a descending journal leaves a nearly full short film through its ends.
    field = ReynoldsFilm(cells=(128, 8)).solve(np.zeros(2), SQUEEZE, 0.01)
    assert field.side_flow == pytest.approx(2.0, rel=1e-3)


@pytest.mark.closed_form
@pytest.mark.parametrize("chi", [0.0, 0.5, 0.95])
def test_shear_of_a_full_bearing(chi):
    field = ReynoldsFilm().solve(np.array([chi, 0.0]), WEDGE, 0.5)
    assert field.shear == pytest.approx(2.0 * np.pi / np.sqrt(1.0 - chi**2), rel=2e-3)


def test_full_turn_as_a_pad_is_the_plain_bearing():
    e, w = np.array([0.3, 0.5]), MIXED
    film = ReynoldsFilm()
    whole = film.fitted(FilmGeometry(pads=(Pad(start=1.0, extent=2.0 * np.pi),)))
    nearly = film.fitted(FilmGeometry(pads=(Pad(start=np.arctan2(0.5, 0.3) + np.pi, extent=6.2831),)))
    np.testing.assert_array_equal(whole.force(e, w, 0.5), film.force(e, w, 0.5))
    np.testing.assert_allclose(nearly.force(e, w, 0.5), film.force(e, w, 0.5), rtol=0.1)


def test_supply_pressure_pushes_the_journal_away_from_its_groove():
    film = ReynoldsFilm(geometry=FilmGeometry(grooves=(Groove(center=0.0, width=0.3),), supply=1.0))
    force = film.force(np.zeros(2), np.zeros(2), 0.5)
    assert force[0] < -12.0 * 0.3 * 0.9
    assert force[1] == pytest.approx(0.0, abs=1e-9)


def test_vanishing_source_has_a_force_of_zero_and_no_derivative():
    film, e = FILMS["ruptured"], np.array([0.5, 0.0])
    np.testing.assert_array_equal(film.force(e, np.zeros(2), 0.5), 0.0)
    with pytest.raises(UndefinedDerivativeError, match=r"source .* must not vanish .* got w = 0"):
        film.jacobian(e, np.zeros(2), 0.5)


def test_centered_journal_at_rest_has_the_damping_of_the_limit():
    film = FILMS["ruptured"]
    at_rest = film.jacobian(np.zeros(2), np.zeros(2), 0.5)
    np.testing.assert_array_equal(at_rest[:, :2], 0.0)
    np.testing.assert_allclose(
        at_rest[:, 2:], film.jacobian(np.zeros(2), 1e-6 * SQUEEZE, 0.5)[:, 2:], rtol=1e-9, atol=1e-9
    )


def test_is_a_film_law():
    assert isinstance(ReynoldsFilm(), FilmLaw)


@pytest.mark.parametrize("cells", [(96, 6), (95, 8), (8, 8), (96,), "96", (96.0, 8)])
def test_bad_cells_are_refused(cells):
    with pytest.raises(InputError, match="cells must be two multiples of 4"):
        ReynoldsFilm(cells=cells)


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        ({"supply": 1.0}, "supply must be 0 without grooves, got 1.0"),
        ({"supply": -1.0, "grooves": (Groove(center=0.0),)}, "supply must be finite and not negative"),
        ({"grooves": (Groove(center=0.0, width=0.5), Groove(center=0.3, width=0.5))}, "must not overlap"),
        ({"grooves": (Groove(center=0.0), Groove(center=0.0))}, "must not overlap"),
        ({"pads": (Pad(start=0.0, extent=2.0), Pad(start=1.5, extent=1.0))}, "pads must not overlap"),
        ({"pads": (Pad(start=0.0, extent=4.0), Pad(start=4.0, extent=4.0))}, "pads must not overlap"),
    ],
)
def test_bad_geometry_is_refused(arguments, message):
    with pytest.raises(InputError, match=message):
        FilmGeometry(**arguments)


def test_bad_opening_is_refused():
    with pytest.raises(InputError, match="width must be below 2 pi"):
        Groove(center=0.0, width=7.0)
    with pytest.raises(InputError, match="extent must be in"):
        Pad(start=0.0, extent=7.0)


def test_states_without_a_film_are_told():
    film, e, w = ReynoldsFilm(cells=(16, 4)), np.array([[0.3], [0.1]]), np.array([[1.0], [0.0]])
    assert film.force_pair(e[:, :0], w[:, :0], 0.5)[0].shape == (2, 0)
    for broken in (np.nan, np.inf):
        with pytest.raises(InputError, match="must be finite"):
            film.force_pair(e, np.array([[broken], [0.0]]), 0.5)
        with pytest.raises(InputError, match="must be finite"):
            film.solve(e[:, 0], np.array([broken, 0.0]), 0.5)
