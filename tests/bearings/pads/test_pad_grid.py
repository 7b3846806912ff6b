"""Closed forms and symmetries of the two-dimensional film on one pad."""

import numpy as np
import pytest

from rotorfilm import JournalBearing, Pad, ReynoldsFilm
from rotorfilm.bearings.pads.pad_build import FINE, FLOOR, pad_grid, pad_states
from rotorfilm.native import Status

DEGREE = np.pi / 180.0


def test_long_narrow_gap_is_a_slider():
    """A pad so short that H is linear on it is an infinitely long wedge between two lines (closed form)."""
    extent, S = 0.02, 50.0
    e, w = np.array([[0.3], [8.0]]), np.array([[0.7], [0.4]])
    # (H^3 P')' = -w.n twice integrated along the pad, without a flow to the sides.
    x = np.linspace(-0.5 * extent, 0.5 * extent, 20001)
    n = np.array([np.cos(x), np.sin(x)])
    H, g = 1.0 - e[:, 0] @ n, w[:, 0] @ n
    step = x[1] - x[0]
    G = np.concatenate([[0.0], np.cumsum(0.5 * (g[1:] + g[:-1]) * step)])

    def integral(f):
        return np.concatenate([[0.0], np.cumsum(0.5 * (f[1:] + f[:-1]) * step)])

    first, second = integral(1.0 / H**3), integral(G / H**3)
    P = second[-1] / first[-1] * first - second
    assert np.all(P >= -1e-12)
    expected = -12.0 * np.array([integral(P * n[0])[-1], integral(P * n[1])[-1]])
    found = pad_grid(extent, S, (192, 16)).force(e, w).values[:, 0]
    # The sides take off some .63 of a film's length each, D/L times the width of the pad.
    assert found[0] == pytest.approx(expected[0], rel=2e-3)


def test_two_pads_without_preload_are_a_bore_with_two_openings():
    S = 0.5
    pads = tuple(Pad(start=k * DEGREE, extent=160.0 * DEGREE) for k in (10.0, 190.0))
    bore = JournalBearing(
        radius=0.05,
        length=0.05,
        clearance=1e-4,
        viscosity=0.02,
        pads=pads,
        film=ReynoldsFilm(cells=(384, 16)),
    )
    e, w = np.array([0.2, -0.5]), np.array([0.3, 0.4])
    found = np.zeros(2)
    for middle in (90.0 * DEGREE, 270.0 * DEGREE):
        Q = np.array([[np.cos(middle), -np.sin(middle)], [np.sin(middle), np.cos(middle)]])
        f = pad_grid(160.0 * DEGREE, S, (192, 16)).force((Q.T @ e)[:, None], (Q.T @ w)[:, None])
        assert f.status == 0
        found += Q @ f.values[:, 0]
    expected, error = bore.film.fitted(bore.geometry).extrapolated(e[:, None], w[:, None], S)
    assert found == pytest.approx(expected[:, 0], rel=1e-3, abs=2.0 * float(error[0]))


def test_journal_beyond_the_unit_circle_has_a_film_and_touches_only_on_the_arc():
    pad = pad_grid(60.0 * DEGREE, 0.5)
    w = np.array([[0.4], [-0.2]])
    beyond = pad.force(np.array([[-0.46], [1.07]]), w)
    assert beyond.status == 0
    assert np.isfinite(beyond.values).all()
    # Contact is at the edge, xi cos b + eta sin b = 1.
    edge = (1.0 + 0.46 * np.cos(np.pi / 6.0)) / np.sin(np.pi / 6.0)
    assert pad.force(np.array([[-0.46], [edge - 1e-3]]), w).status == 0
    assert pad.force(np.array([[-0.46], [edge + 1e-3]]), w).status == Status.AT_WALL
    assert pad.force(np.array([[1.0], [0.0]]), w).status == Status.AT_WALL


def test_mirror_and_degree():
    pad, rng = pad_grid(100.0 * DEGREE, 1.0), np.random.default_rng(5)
    e = np.stack([rng.uniform(-0.4, 0.8, 20), rng.uniform(-0.3, 0.3, 20)])
    w = rng.normal(size=(2, 20))
    across = np.array([[1.0], [-1.0]])
    force = pad.force(e, w).values
    scale = np.abs(force).max()
    np.testing.assert_allclose(pad.force(across * e, across * w).values, across * force, atol=1e-9 * scale)
    np.testing.assert_allclose(pad.force(e, 3.0 * w).values, 3.0 * force, atol=1e-9 * scale)


def test_no_source_on_the_arc_no_force():
    """F = 0 exactly where w.n <= 0 on the whole arc, |phi| >= pi/2 + b."""
    pad, b = pad_grid(60.0 * DEGREE, 0.5), np.pi / 6.0
    e = np.array([[0.3], [0.2]])
    for sign in (1.0, -1.0):
        for turn, has in ((1e-6, False), (-0.05, True)):
            phi = sign * (np.pi / 2.0 + b + turn)
            force = pad.force(e, np.array([[np.cos(phi)], [np.sin(phi)]])).values
            assert bool(np.any(force != 0.0)) is has


@pytest.mark.closed_form
@pytest.mark.parametrize("e", [(0.3, 0.2), (-0.2, 0.942), (-0.2, np.sqrt(0.96)), (-0.46, 1.07)])
def test_shear_and_flow_of_a_full_pad_within_and_beyond_the_unit_circle(e):
    """A film on all of the pad shears as its gap, and feeds sides and trailing edge from the leading one."""
    extent, at = 60.0 * DEGREE, np.array(e)[:, None]
    w = np.array([at[1], -at[0]])
    film, streamers, side, leading, trailing = pad_grid(extent, 0.5).losses(at, w, np.ones(1))[:, 0]
    theta, weight = np.polynomial.legendre.leggauss(60)
    H = 1.0 - e[0] * np.cos(0.5 * extent * theta) - e[1] * np.sin(0.5 * extent * theta)
    assert film == pytest.approx(0.5 * extent * weight @ (1.0 / H), rel=1e-7)
    assert streamers == pytest.approx(0.0, abs=1e-12)
    assert side == pytest.approx(leading - trailing, rel=1e-8)
    # Pressure holds oil back at the leading edge and drives it out at the trailing one.
    first, last = 1.0 - np.array(e) @ [
        [np.cos(0.5 * extent)] * 2,
        [-np.sin(0.5 * extent), np.sin(0.5 * extent)],
    ]
    assert leading < first
    assert trailing > last


def test_shear_and_flow_are_those_of_the_mirrored_pad():
    extent, at = 100.0 * DEGREE, np.array([[0.7], [0.3]])
    w, across = np.array([[0.6], [0.2]]), np.array([[1.0], [-1.0]])
    pad = pad_grid(extent, 0.5)
    forward, backward = pad.losses(at, w, np.ones(1)), pad.losses(across * at, across * w, -np.ones(1))
    np.testing.assert_allclose(backward, forward, rtol=1e-9)


@pytest.mark.convergence
@pytest.mark.parametrize(("extent", "slenderness"), [(60, 1.0), (150, 0.5)])
def test_96_x_8_cells_are_within_a_thousandth(extent, slenderness):
    """In 99 of 100 states, of the force or of 5 % of the largest one at that place, as a map is measured."""
    angle = extent * DEGREE
    states = pad_states(angle, FINE.u_range, FINE.y_end, 120)
    fine = pad_grid(angle, slenderness, (384, 32)).force(states.e, states.w).values
    around = np.linspace(-np.pi, np.pi, 16, endpoint=False)
    coarse = pad_grid(angle, slenderness, (32, 4))
    largest = np.max(
        [np.hypot(*coarse.force(states.e, unit(phi, states.phi.size)).values) for phi in around], axis=0
    )
    found = pad_grid(angle, slenderness, (96, 8)).force(states.e, states.w).values
    errors = np.hypot(*(found - fine)) / np.maximum(np.hypot(*fine), FLOOR * largest)
    assert np.quantile(errors, 0.99) < 1e-3
    assert np.median(errors) < 2e-4


def unit(angle, count):
    """Return so many unit vectors in one direction, shape (2, count)."""
    return np.tile([[np.cos(angle)], [np.sin(angle)]], count)
