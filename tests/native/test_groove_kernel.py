"""The C kernel of grooved bearings against a slow reference in Python, and its statuses."""

import pickle

import numpy as np
import pytest
from scipy.interpolate import BSpline

from rotorfilm.native import JournalKernel, MapKernel, MapKind, Status
from rotorfilm.native.film_kernels import periodic as widened

CELLS, REACH, SQUEEZE, AXIS = (7, 9, 12, 15), 3.0, 0.7, 0.4
TURN = 2.0 * np.pi
rng = np.random.default_rng(5)
M, L0 = rng.normal(size=(CELLS[0] + 5, *CELLS[1:3])) * 0.2, rng.normal(size=CELLS[3]) * 0.2
MAP = MapKernel(
    MapKind.GROOVED,
    {
        "coefficients": widened(widened(M, 1), 2),
        "center": widened(L0, 0),
        "map": [0.5, REACH, SQUEEZE, AXIS],
    },
)


def periodic(c, angle, axis, derivative=0):
    count = c.shape[axis]
    wide = np.take(c, np.arange(-2, count + 3) % count, axis)
    knots = np.arange(-5, count + 6) * TURN / count
    return BSpline(knots, wide, 5, axis=axis).derivative(derivative)(angle % TURN)


def logarithm(chi, theta, phi):
    """Return ln(-J/|w|^2) as map_kernel.h defines it."""
    x, s = chi / (1.0 - chi**2) ** 0.25, np.arctan2(SQUEEZE * np.sin(phi - theta), np.cos(phi - theta))
    along = BSpline(np.arange(-5, CELLS[0] + 6) * REACH / CELLS[0], M, 5)(x)
    return periodic(L0, phi - AXIS, 0) + chi * periodic(periodic(along, theta - AXIS, 0), s, 0)


def reference_potential(e, w):
    chi, size = np.hypot(*e), np.hypot(*w)
    return -(size**2) * np.exp(logarithm(chi, np.arctan2(*e[::-1]), np.arctan2(*w[::-1])))


def differences(function, z, h=1e-3):
    """Return the derivative of a function of a vector by central differences of sixth order."""
    columns = []
    for d in h * np.eye(len(z)):
        f = [function(z + k * d) for k in (-3, -2, -1, 1, 2, 3)]
        columns.append((-f[0] + 9 * f[1] - 45 * f[2] + 45 * f[3] - 9 * f[4] + f[5]) / (60 * h))
    return np.stack(columns, axis=-1)


STATES = [
    (chi * np.array([np.cos(t), np.sin(t)]), size * np.array([np.cos(p), np.sin(p)]))
    for chi, t, size, p in zip(
        rng.uniform(0.05, 0.9, 12),
        rng.uniform(-7, 7, 12),
        rng.uniform(0.5, 2, 12),
        rng.uniform(-7, 7, 12),
        strict=True,
    )
]


@pytest.mark.closed_form
@pytest.mark.parametrize("state", STATES)
def test_force_is_the_gradient_of_the_potential(state):
    e, w = state
    force = MAP.force(e[:, None], w[:, None])
    exact = differences(lambda u: reference_potential(e, u), w)
    assert force.status == Status.OK
    np.testing.assert_allclose(force.values[:, 0], exact, atol=1e-8 * np.abs(exact).max())


@pytest.mark.parametrize("state", STATES)
def test_jacobian_is_the_derivative_of_the_force(state):
    def force(z):
        return MAP.force(z[:2, None], z[2:, None]).values[:, 0]

    z = np.concatenate(state)
    exact = differences(force, z, 1e-4)
    found = MAP.jacobian(z[:2, None], z[2:, None]).values[:, :, 0]
    np.testing.assert_allclose(found, exact, atol=1e-7 * np.abs(exact).max())


def test_angles_wrap_on_both_axes():
    w = np.array([[0.3], [-0.8]])
    for angle in (AXIS, AXIS + np.pi, np.pi):
        e = [0.5 * np.array([[np.cos(a)], [np.sin(a)]]) for a in (angle - 1e-9, angle + 1e-9)]
        sides = [MAP.jacobian(at, w).values for at in e]
        np.testing.assert_allclose(sides[0], sides[1], atol=1e-6)


@pytest.mark.parametrize(
    ("e", "w", "status"),
    [
        ((0.3, 0.2), (1.0, 0.0), Status.OK),
        ((0.0, 0.0), (1.0, 0.0), Status.OK),
        ((0.999, 0.0), (1.0, 0.0), Status.OUTSIDE),
        ((0.0, 0.0), (0.0, 0.0), Status.UNDEFINED),
        ((1.0, 0.0), (1.0, 0.0), Status.AT_WALL),
        ((np.nan, 0.0), (1.0, 0.0), Status.NOT_FINITE),
        ((0.1, 0.0), (np.inf, 0.0), Status.NOT_FINITE),
    ],
)
def test_statuses(e, w, status):
    ok = np.array([[0.1, 0.2], [0.1, 0.2]]), np.ones((2, 2))
    states = [np.insert(good, 1, bad, axis=1) for good, bad in zip(ok, (e, w), strict=True)]
    jacobian, force = MAP.jacobian(*states), MAP.force(*states)
    assert (jacobian.status, jacobian.first) == (status, 1 if status else 0)
    assert force.status == (Status.OK if status == Status.UNDEFINED else status)
    assert np.isfinite(jacobian.values[..., [0, 2]]).all()
    assert np.isfinite(jacobian.values[..., 1]).all() == (status <= Status.OUTSIDE)
    if status == Status.UNDEFINED:
        np.testing.assert_array_equal(force.values[:, 1], 0.0)


@pytest.mark.parametrize("scale", [1e-150, 1e-250, 1e150, 1e250])
def test_sources_of_any_size(scale):
    e, w = np.array([[0.3], [0.4]]), np.array([[0.6], [-0.2]])
    force = MAP.force(e, w).values
    np.testing.assert_allclose(MAP.force(e, scale * w).values / scale, force, rtol=1e-12)


def test_journal_scales_and_moves_with_the_speed():
    c, k, speed = 1e-4, 3.0, 80.0
    journal = JournalKernel(MAP, c, k)
    q, v = 1e-4 * np.array([[0.3], [-0.4]]), np.array([[2e-3], [1e-3]])
    w = v / c + 0.5 * speed * np.array([[-0.4], [-0.3]])
    exact = k * MAP.force(q / c, w).values
    np.testing.assert_allclose(journal.force(q, v, np.array([speed])).values, exact, rtol=1e-12)
    fx, fy, status = journal.call(*q[:, 0], *v[:, 0], speed)
    assert (fx, fy, status) == (pytest.approx(exact[0, 0]), pytest.approx(exact[1, 0]), Status.OK)
    entries = journal.tangent(*q[:, 0], *v[:, 0], speed)[2]
    np.testing.assert_array_equal(entries, journal.jacobian(q, v, np.array([speed])).values[:, :, 0].ravel())
    twin = pickle.loads(pickle.dumps(journal))
    assert twin.tangent(*q[:, 0], *v[:, 0], speed)[2] == entries
    assert journal.call(np.nan, 0.0, 0.0, 0.0, 1.0)[2] == Status.NOT_FINITE
