"""The C kernel of the map of a pad against a slow reference in Python, and its statuses."""

import pickle

import numpy as np
import pytest
from scipy.interpolate import BSpline

from rotorfilm.native import MapKernel, MapKind, Status

CELLS, U, Y_END, EXTENT = (7, 8, 11), (-0.6, 2.4), 1.5, 1.8
B = 0.5 * EXTENT
EDGE = 0.5 * np.pi + B
rng = np.random.default_rng(7)
M = rng.normal(size=[count + 5 for count in CELLS]) * 0.2
MAP = MapKernel(MapKind.PAD, {"coefficients": M, "map": [EXTENT, *U, Y_END]})


def axis(coefficients, first, last, at):
    """Return the spline over the first axis at a number, going on linearly beyond its nodes."""
    cells = len(coefficients) - 5
    spline = BSpline(first + np.arange(-5, cells + 6) * (last - first) / cells, coefficients, 5)
    within = min(max(at, first), last)
    return spline(within) + (at - within) * spline.derivative()(within)


def wall(xi):
    return np.sqrt(1.0 - xi**2) if xi > np.cos(B) else (1.0 - xi * np.cos(B)) / np.sin(B)


def reference_potential(e, w):
    """Return J as map_kernel.h defines it."""
    phi, step = np.arctan2(w[1], w[0]), 2.0 * EDGE / (CELLS[2] + 1)
    m = axis(M, *U, -np.log(1.0 - e[0]))
    m = axis(m, -Y_END, Y_END, np.arctanh(e[1] / wall(e[0])))
    knots = -EDGE + (np.arange(-5, CELLS[2] + 6) + 0.5) * step
    m = BSpline(knots, m, 5, extrapolate=True)(phi)
    return -(w @ w) * (np.cos(phi) + np.sin(B)) ** 5 * np.exp(m)


def differences(function, z, h):
    """Return the derivative of a function of a vector by central differences of sixth order."""
    columns = []
    for d in h * np.eye(len(z)):
        f = [function(z + k * d) for k in (-3, -2, -1, 1, 2, 3)]
        columns.append((-f[0] + 9 * f[1] - 45 * f[2] + 45 * f[3] - 9 * f[4] + f[5]) / (60 * h))
    return np.stack(columns, axis=-1)


def states(count, u_range=U, y_end=Y_END, seed=3):
    """Return states within the nodes, on both sides of xi = cos b and of the unit circle."""
    random = np.random.default_rng(seed)
    xi = -np.expm1(-random.uniform(*u_range, count))
    eta = np.tanh(random.uniform(-y_end, y_end, count)) * np.array([wall(each) for each in xi])
    phi, size = random.uniform(-EDGE + 0.02, EDGE - 0.02, count), random.uniform(0.5, 2.0, count)
    return np.stack([xi, eta]), size * np.stack([np.cos(phi), np.sin(phi)])


WITHIN = states(30)
BEYOND = [
    np.concatenate(parts, axis=1)
    for parts in zip(states(8, (2.5, 3.5)), states(8, (-2.0, -0.7)), strict=True)
]


def test_states_are_of_all_kinds():
    xi = WITHIN[0][0]
    assert 5 < np.count_nonzero(xi > np.cos(B)) < 25
    assert np.hypot(*WITHIN[0]).max() > 1.0


@pytest.mark.closed_form
@pytest.mark.parametrize(("places", "status"), [(WITHIN, Status.OK), (BEYOND, Status.OUTSIDE)])
def test_force_is_the_gradient_of_the_potential(places, status):
    e, w = places
    force = MAP.force(e, w)
    assert force.status == status
    for k in range(e.shape[1]):
        exact = differences(lambda v, k=k: reference_potential(e[:, k], v), w[:, k], 1e-3)
        size = abs(reference_potential(e[:, k], w[:, k]))
        np.testing.assert_allclose(force.values[:, k], exact, rtol=1e-7, atol=1e-7 * size)


@pytest.mark.parametrize("places", [WITHIN, BEYOND, states(12, y_end=1.51, seed=9)])
def test_jacobian_is_the_derivative_of_the_force(places):
    found = MAP.jacobian(*places).values
    for k, z in enumerate(np.concatenate(places).T):
        exact = differences(lambda at: MAP.force(at[:2, None], at[2:, None]).values[:, 0], z, 2e-5)
        np.testing.assert_allclose(found[:, :, k], exact, rtol=1e-6, atol=2e-7 * np.abs(exact).max())


def test_force_and_jacobian_agree_with_those_of_a_batch_of_one():
    e, w = WITHIN
    batch = MAP.jacobian(e, w).values, MAP.force(e, w).values
    for k in range(4):
        one = MAP.jacobian(e[:, [k]], w[:, [k]]).values, MAP.force(e[:, [k]], w[:, [k]]).values
        np.testing.assert_array_equal(one[0][..., 0], batch[0][..., k])
        np.testing.assert_array_equal(one[1][..., 0], batch[1][..., k])


def test_damping_is_symmetric_and_the_force_has_degree_one():
    e, w = WITHIN
    force, slopes = MAP.force(e, w).values, MAP.jacobian(e, w).values
    scale = np.abs(slopes[:, 2:]).max(axis=(0, 1))
    np.testing.assert_array_less(np.abs(slopes[0, 3] - slopes[1, 2]), 4e-16 * scale + 1e-300)
    # Euler: F = (dF/dw) w, and F.w/2 is the potential.
    along = np.einsum("ijn,jn->in", slopes[:, 2:], w)
    np.testing.assert_allclose(along, force, rtol=1e-12, atol=1e-12 * np.abs(force).max())
    potential = [reference_potential(e[:, k], w[:, k]) for k in range(e.shape[1])]
    np.testing.assert_allclose(0.5 * np.sum(force * w, axis=0), potential, rtol=1e-11)


@pytest.mark.parametrize("scale", [1e-250, 1e-150, 1e150, 1e250])
def test_sources_of_any_size(scale):
    e, w = WITHIN
    np.testing.assert_allclose(MAP.force(e, scale * w).values / scale, MAP.force(e, w).values, rtol=1e-11)


@pytest.mark.parametrize("side", [1.0, -1.0])
def test_no_film_is_an_answer_where_the_source_drives_none(side):
    e = np.array([[0.3], [0.2]])
    for turn, drives in ((-1e-3, True), (1e-9, False), (0.3, False)):
        phi = side * (EDGE + turn)
        w = np.array([[np.cos(phi)], [np.sin(phi)]])
        force, slopes = MAP.force(e, w), MAP.jacobian(e, w)
        assert force.status == slopes.status == Status.OK
        assert bool(np.any(force.values != 0.0)) is drives
        assert bool(np.any(slopes.values != 0.0)) is drives
    away = MAP.jacobian(e, np.array([[-1.0], [0.0]]))
    assert away.status == Status.OK
    np.testing.assert_array_equal(away.values, 0.0)


def test_force_vanishes_as_the_fifth_power_towards_the_edge():
    phi = EDGE - np.array([2e-4, 1e-4])
    e, w = np.tile([[0.3], [0.2]], 2), np.stack([np.cos(phi), np.sin(phi)])
    potential = np.sum(MAP.force(e, w).values * w, axis=0)
    assert np.log2(potential[0] / potential[1]) == pytest.approx(5.0, abs=1e-3)


@pytest.mark.parametrize(
    ("e", "w", "status"),
    [
        ((0.3, 0.2), (1.0, 0.0), Status.OK),
        ((0.0, 0.0), (1.0, 0.0), Status.OK),
        ((-0.46, 1.07), (1.0, 0.0), Status.OK),
        ((0.999, 0.0), (1.0, 0.0), Status.OUTSIDE),
        ((-3.0, 0.0), (1.0, 0.0), Status.OUTSIDE),
        ((0.2, 0.95 * wall(0.2)), (1.0, 0.0), Status.OUTSIDE),
        ((0.2, 0.2), (0.0, 0.0), Status.UNDEFINED),
        ((1.0, 0.0), (1.0, 0.0), Status.AT_WALL),
        ((0.8, 0.601), (1.0, 0.0), Status.AT_WALL),
        ((-0.46, wall(-0.46) + 1e-9), (1.0, 0.0), Status.AT_WALL),
        ((-0.46, -wall(-0.46) - 1e-9), (-1.0, 0.0), Status.AT_WALL),
        ((1.5, 0.0), (0.0, 0.0), Status.AT_WALL),
        ((np.nan, 0.0), (1.0, 0.0), Status.NOT_FINITE),
        ((0.1, np.inf), (1.0, 0.0), Status.NOT_FINITE),
        ((0.1, 0.0), (-np.inf, 0.0), Status.NOT_FINITE),
        ((0.1, 0.0), (-1.0, np.nan), Status.NOT_FINITE),
    ],
)
def test_statuses(e, w, status):
    ok = np.array([[0.1, 0.2], [0.1, 0.2]]), np.ones((2, 2))
    given = [np.insert(good, 1, bad, axis=1) for good, bad in zip(ok, (e, w), strict=True)]
    jacobian, force = MAP.jacobian(*given), MAP.force(*given)
    assert (jacobian.status, jacobian.first) == (status, 1 if status else 0)
    assert force.status == (Status.OK if status == Status.UNDEFINED else status)
    assert np.isfinite(jacobian.values[..., [0, 2]]).all()
    assert np.isfinite(jacobian.values[..., 1]).all() == (status <= Status.OUTSIDE)
    if status == Status.UNDEFINED:
        np.testing.assert_array_equal(force.values[:, 1], 0.0)


def test_kernel_is_pickled_whole():
    twin = pickle.loads(pickle.dumps(MAP))
    np.testing.assert_array_equal(twin.jacobian(*WITHIN).values, MAP.jacobian(*WITHIN).values)
