"""The C kernel against a slow reference in Python, at the limits of its state space, and its statuses."""

import pickle

import numpy as np
import pytest
from scipy.interpolate import BSpline

from rotorfilm.native import JournalKernel, MapKernel, MapKind, Status, slice_table

CELLS_X, CELLS_T, REACH, CENTER = 7, 9, 3.0, -0.4


def random_coefficients():
    """Return coefficients of a rough M that is linear in the cosine at X = 0, as every map is."""
    c = np.random.default_rng(5).normal(size=(CELLS_X + 5, CELLS_T + 5)) * 0.2
    # Three rows of the five that meet at X = 0 are chosen so that their mean is linear, and antisymmetric.
    line = (np.arange(CELLS_T + 5) - (CELLS_T + 4) / 2) * 0.1
    c[2] = (line - (c[0] + 26.0 * c[1] + 26.0 * c[3] + c[4]) / 120.0) * 120.0 / 66.0
    return c


def plain_map(coefficients, reach, center):
    """Return a map that goes on as a power of X."""
    return MapKernel(MapKind.PLAIN, {"coefficients": coefficients[None], "center": [center], "map": [reach]})


MAP = plain_map(random_coefficients(), REACH, CENTER)


def spline_value(x, t, derivatives=(0, 0)):
    """Return a derivative of M by scipy's general B-splines."""
    kx = np.arange(-5, CELLS_X + 6) * REACH / CELLS_X
    kt = np.arange(-5, CELLS_T + 6) / CELLS_T
    along_t = BSpline(kt, random_coefficients().T, 5).derivative(derivatives[1])(t)
    return float(BSpline(kx, along_t, 5).derivative(derivatives[0])(x))


def reference_force(e, w):
    """Return F = E (2 - chi s M_s) w + E M_s |w| e, as the theory writes it."""
    chi, size = np.hypot(*e), np.hypot(*w)
    s = e @ w / (chi * size)
    x = chi / (1.0 - chi**2) ** 0.25
    M, M_s = spline_value(x, (1 + s) / 2), 0.5 * spline_value(x, (1 + s) / 2, (0, 1))
    E = -np.exp(CENTER + chi * M)
    return E * (2.0 - chi * s * M_s) * w + E * M_s * size * e


def reference_damping(e, w):
    """Return -d force / d source with M_ss, in Cartesian form: the Hessian of -J."""
    chi, size = np.hypot(*e), np.hypot(*w)
    n = w / size
    m = np.array([-n[1], n[0]])
    s, b = e @ n / chi, e @ m
    x, t = chi / (1.0 - chi**2) ** 0.25, (1.0 + s) / 2.0
    M, M_s = spline_value(x, t), 0.5 * spline_value(x, t, (0, 1))
    M_ss = 0.25 * spline_value(x, t, (0, 2))
    E = np.exp(CENTER + chi * M)
    turn, turned = M_s * b, M_ss * b**2 / chi - M_s * (e @ n)
    mixed = np.outer(n, m) + np.outer(m, n)
    return E * (2 * np.outer(n, n) + turn * mixed + (2 + turn**2 + turned) * np.outer(m, m))


def random_states(count, largest=0.95):
    rng = np.random.default_rng(3)
    chi, phi = rng.uniform(1e-3, largest, count), rng.uniform(-np.pi, np.pi, count)
    return chi * np.stack([np.cos(phi), np.sin(phi)]), rng.normal(size=(2, count))


def test_force_equals_the_reference_to_roundoff():
    e, w = random_states(60)
    expected = np.stack([reference_force(a, b) for a, b in zip(e.T, w.T, strict=True)], axis=1)
    np.testing.assert_allclose(MAP.force(e, w).values / expected, 1.0, rtol=2e-12)


def test_damping_equals_the_reference_to_roundoff():
    e, w = random_states(40)
    expected = np.stack([reference_damping(a, b) for a, b in zip(e.T, w.T, strict=True)], axis=-1)
    scale = np.abs(expected).max(axis=(0, 1))
    np.testing.assert_allclose(-MAP.jacobian(e, w).values[:, 2:] / scale, expected / scale, atol=1e-11)


def differences(e, w, step):
    z = np.concatenate([e, w])
    columns = []
    for k in range(4):
        d = np.zeros((4, 1))
        d[k] = step
        ahead, back, ahead2, back2 = (MAP.force(*np.split(z + s * d, 2)).values for s in (1, -1, 2, -2))
        columns.append((8 * (ahead - back) - (ahead2 - back2)) / (12 * step))
    return np.stack(columns, axis=1)


@pytest.mark.parametrize(("largest", "step"), [(0.9, 1e-4), (0.02, 1e-5)])
def test_jacobian_equals_differences(largest, step):
    e, w = random_states(50, largest)
    jacobian = MAP.jacobian(e, w).values
    scale = np.abs(jacobian).max(axis=(0, 1))
    np.testing.assert_allclose(jacobian / scale, differences(e, w, step) / scale, atol=1e-7)


@pytest.mark.parametrize("chi", [0.0, 1e-200, 1e-12, 1e-8])
@pytest.mark.parametrize("direction", [0.0, 0.7, 2.0, -1.5])
def test_jacobian_is_regular_at_the_center(chi, direction):
    e = chi * np.array([[np.cos(direction)], [np.sin(direction)]])
    w = np.array([[0.3], [-0.8]])
    jacobian = MAP.jacobian(e, w).values
    assert np.isfinite(jacobian).all()
    center = MAP.jacobian(np.zeros((2, 1)), w).values
    np.testing.assert_allclose(jacobian, center, atol=1e-9 + 10 * chi)
    # The rough M has no parity, so the second derivative jumps across the center: first order in h.
    h = 1e-6
    for k in range(2):
        d = np.zeros((2, 1))
        d[k] = h
        slope = (MAP.force(e + d, w).values - MAP.force(e - d, w).values) / (2 * h)
        np.testing.assert_allclose(jacobian[:, k], slope, atol=2e-6 + 10 * chi)


def test_jacobian_is_continuous_beyond_the_last_node_and_right_there():
    edge = np.sqrt(2 * REACH**2 / (REACH**2 + np.sqrt(REACH**4 + 4)))
    w = np.array([[0.4], [0.9]])
    inside, outside = (np.array([[edge * k], [0.0]]) for k in (1 - 1e-9, 1 + 1e-9))
    np.testing.assert_allclose(MAP.force(inside, w).values, MAP.force(outside, w).values, rtol=1e-5)
    assert MAP.force(inside, w).status == Status.OK
    assert MAP.force(outside, w).status == Status.OUTSIDE
    e = np.array([[0.6], [0.78]]) * 0.9975 / np.hypot(0.6, 0.78)
    h = 1e-7
    for k in range(2):
        d = np.zeros((2, 1))
        d[k] = h
        slope = (MAP.force(e + d, w).values - MAP.force(e - d, w).values) / (2 * h)
        jacobian = MAP.jacobian(e, w)
        np.testing.assert_allclose(jacobian.values[:, k], slope, rtol=1e-5)
        assert jacobian.status == Status.OUTSIDE


def test_contiguous_rows_are_read_in_place_and_others_are_copied():
    e, w = random_states(20)
    expected = MAP.force(e, w).values
    wide = np.zeros((4, 40))
    wide[::2, :20] = e
    np.testing.assert_array_equal(MAP.force(wide[::2, :20], w).values, expected)
    np.testing.assert_array_equal(MAP.force(e, np.asfortranarray(w)).values, expected)
    np.testing.assert_array_equal(MAP.force(e[:, ::-1], w[:, ::-1]).values, expected[:, ::-1])
    np.testing.assert_array_equal(MAP.force(e[::-1], w[::-1]).values.shape, expected.shape)


@pytest.mark.parametrize(
    ("bad", "source", "status"),
    [
        ([1.0, 0.0], [1.0, 0.0], Status.AT_WALL),
        ([np.nan, 0.0], [1.0, 0.0], Status.NOT_FINITE),
        ([0.1, 0.0], [0.0, np.inf], Status.NOT_FINITE),
        ([0.1, 0.0], [1e308, 1e308], Status.NOT_FINITE),
    ],
)
def test_what_cannot_be_has_a_status_and_no_number(bad, source, status):
    e, w = random_states(5)
    e[:, 3], w[:, 3] = bad, source
    for batch in (MAP.force(e, w), MAP.jacobian(e, w)):
        assert (batch.status, batch.first) == (status, 3)
        assert np.isnan(batch.values[..., 3]).all()
        assert np.isfinite(batch.values[..., [0, 1, 2, 4]]).all()


def test_tiny_and_huge_sources_keep_their_homogeneity():
    e, w = random_states(5)
    expected = MAP.force(e, w).values
    for factor in (1e-250, 1e-120, 1e150):
        np.testing.assert_allclose(MAP.force(e, factor * w).values / factor, expected, rtol=1e-12)


def test_without_source_the_force_vanishes_and_only_the_center_has_a_derivative():
    e, w = np.array([[0.3], [0.4]]), np.zeros((2, 1))
    force = MAP.force(e, w)
    np.testing.assert_array_equal(force.values, 0.0)
    assert force.status == Status.OK
    assert MAP.jacobian(e, w).status == Status.UNDEFINED
    resting = MAP.jacobian(0.0 * e, w)
    assert resting.status == Status.OK
    expected = np.concatenate([np.zeros((2, 2)), -2.0 * np.exp(CENTER) * np.eye(2)], axis=1)
    np.testing.assert_allclose(resting.values[:, :, 0], expected, rtol=1e-15)


def test_journal_kernel_is_the_map_in_si_units():
    c, k = 1e-4, 250.0
    journal = pickle.loads(pickle.dumps(JournalKernel(MAP, c, k)))
    e, w = random_states(30)
    omega = np.random.default_rng(1).normal(size=30) * 300.0
    v = c * (w - 0.5 * omega * np.stack([e[1], -e[0]]))
    np.testing.assert_allclose(journal.force(c * e, v, omega).values, k * MAP.force(e, w).values, rtol=1e-9)
    one_speed = journal.force(c * e, v, omega[:1]).values
    np.testing.assert_array_equal(one_speed, journal.force(c * e, v, np.full(30, omega[0])).values)
    numbers = [*(c * e[:, 4]), *v[:, 4], omega[4]]
    assert journal.call(*numbers) == (*journal.force(c * e, v, omega).values[:, 4], Status.OK)
    *force, derivatives, status = journal.tangent(*numbers)
    assert (*force, status) == journal.call(*numbers)
    np.testing.assert_array_equal(derivatives, journal.jacobian(c * e, v, omega).values[:, :, 4].ravel())


def test_coefficients_must_fit():
    with pytest.raises(ValueError, match=r"6 x 6 at least .* got 1 x 5 x 6, 1 and 1"):
        plain_map(np.zeros((5, 6)), 1.0, 0.0)
    with pytest.raises(ValueError, match="must be numbers of a film, got -1"):
        plain_map(np.zeros((6, 6)), -1.0, 0.0)
    with pytest.raises(ValueError, match="center must be finite"):
        plain_map(np.zeros((6, 6)), 1.0, np.nan)
    with pytest.raises(ValueError, match="tables must contain center, got 1 others"):
        MapKernel(MapKind.PLAIN, {"coefficients": np.zeros((1, 6, 6))})
    with pytest.raises(ValueError, match="speed must have shape"):
        JournalKernel(MAP, 1e-4, 1.0).force(np.zeros((2, 3)), np.zeros((2, 3)), np.zeros(2))


def test_a_force_that_overflows_in_si_units_is_no_number():
    journal = JournalKernel(MAP, 1e-4, 1e300)
    assert journal.call(3e-5, 4e-5, 1e5, 0.0, 1e5)[2] == Status.NOT_FINITE
    *_, jacobian, status = journal.tangent(3e-5, 4e-5, 1e5, 0.0, 1e5)
    assert status == Status.NOT_FINITE
    assert np.isnan(jacobian).all()


def test_slices_of_the_universal_table_are_its_splines():
    rng = np.random.default_rng(8)
    coefficients, center = rng.normal(size=(12, 7, 9)), rng.normal(size=12)
    knots = np.log(0.1) + np.arange(-5, 13) * np.log(4.0 / 0.1) / 7
    for slenderness in (0.1, 0.10001, 0.25, 1.0, 3.999, 4.0):
        sliced, middle = (slice_table(each, (0.1, 4.0), slenderness) for each in (coefficients, center))
        at = np.clip(np.log(slenderness), np.log(0.1), np.log(4.0))
        np.testing.assert_allclose(sliced, BSpline(knots, coefficients, 5)(at), atol=1e-14)
        assert middle == pytest.approx(float(BSpline(knots, center, 5)(at)), abs=1e-14)
    only, middle = (slice_table(each[:1], (0.5, 0.5), 0.5) for each in (coefficients, center))
    np.testing.assert_array_equal(only, coefficients[0])
    assert middle == center[0]
    with pytest.raises(ValueError, match=r"slenderness must be within \(0.1, 4.0\), got 4.1"):
        slice_table(coefficients, (0.1, 4.0), 4.1)
