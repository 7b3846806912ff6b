"""Conservation of oil in C: the matrix and its solution against dense ones, and what it refuses."""

from dataclasses import replace

import numpy as np
import pytest

from rotorfilm import ConvergenceError
from rotorfilm.bearings.films.mass_conserving import OilCells, oil_outflow, oil_response, solve_oil

N, M = 12, 4


def cells_of(seed, *, backward=False, fed=(), store=0.0, supplied=True):
    """Return cells with any coefficients, two openings, the second over all of a line."""
    rng = np.random.default_rng(seed)
    opening = np.full((N, M), -1, dtype=np.int32)
    if supplied:
        opening[3:5, :2], opening[9] = 0, 1
    count = 2 if supplied else 0
    return OilCells(
        wedge=(-1.0 if backward else 1.0) * rng.uniform(0.5, 1.0, (N, M)),
        around=rng.uniform(0.5, 2.0, (N, M)),
        store=store * rng.uniform(0.1, 0.3, (N, M)),
        along=rng.uniform(0.5, 2.0, (N, M + 1)) * np.append(float(supplied), np.ones(M)),
        first_pressure=0.1,
        last_pressure=0.05 if supplied else 0.0,
        opening=opening,
        fed=np.isin(np.arange(count), fed),
        flow=np.full(count, 0.3),
        backward=backward,
    )


def dense(cells, full, storage):
    """Return the matrix of all cells, column by column from the outflow, cells of a fed opening as one."""
    zero, columns = np.zeros((N, M)), []
    base = oil_outflow(cells, zero, zero)
    for q in range(N * M):
        unit = np.eye(N * M)[q].reshape(N, M)
        one = (unit, zero) if full.flat[q] else (zero, unit)
        change = (oil_outflow(cells, *one) - base).ravel() + 0j
        if not full.flat[q]:
            change[q] += storage.flat[q]
        columns.append(change)
    owner = np.arange(N * M)
    for k in np.flatnonzero(cells.fed):
        inside = np.flatnonzero(cells.opening == k)
        owner[inside] = inside[0]
    free = np.isin(cells.opening.ravel(), [-1, *np.flatnonzero(cells.fed)])
    kept = np.unique(owner[free])
    join = (owner[:, None] == kept) & free[:, None]
    return join.T @ np.array(columns).T @ join, join


@pytest.mark.parametrize("backward", [False, True])
@pytest.mark.parametrize("fed", [(), (0,), (0, 1)])
@pytest.mark.parametrize("is_complex", [False, True])
def test_response_is_that_of_a_dense_matrix(backward, fed, is_complex):
    cells, rng = cells_of(1, backward=backward, fed=fed, store=0.2), np.random.default_rng(2)
    full = (rng.random((N, M)) < 0.6).astype(np.uint8)
    full[cells.opening == 0] = 1
    full[cells.opening == 1] = 0
    storage = rng.random((N, M)) + (1j * rng.random((N, M)) if is_complex else 0.0)
    right = rng.normal(size=(2, N, M)) + (1j * rng.normal(size=(2, N, M)) if is_complex else 0.0)
    found = oil_response(cells, full, storage, right)
    matrix, join = dense(cells, full, storage)
    for one, given in zip(found, right, strict=True):
        expected = join @ np.linalg.solve(matrix, join.T @ given.ravel())
        np.testing.assert_allclose(one.ravel(), expected, atol=1e-12 * np.abs(expected).max())


@pytest.mark.parametrize("is_complex", [False, True])
def test_a_response_may_go_on_from_the_first(is_complex):
    cells, rng = cells_of(1, store=0.2), np.random.default_rng(2)
    full, turn = (rng.random((N, M)) < 0.6).astype(np.uint8), 1.0 + 0.7j if is_complex else 1.0
    storage, coupling = turn * rng.random((N, M)), rng.random((N, M)) * np.conj(turn)
    right = rng.normal(size=(4, N, M)) * turn
    first = oil_response(cells, full, storage, right[:2])
    both = oil_response(cells, full, storage, right, coupling)
    np.testing.assert_array_equal(both[:2], first)
    expected = oil_response(cells, full, storage, right[2:] - coupling * first)
    np.testing.assert_allclose(both[2:], expected, atol=1e-13 * np.abs(expected).max())


@pytest.mark.parametrize("fed", [(), (0,)])
@pytest.mark.parametrize("store", [0.0, 0.4])
@pytest.mark.parametrize("by_newton", [False, True])
def test_nothing_is_left_in_the_cells(fed, store, by_newton):
    cells = cells_of(3, fed=fed, store=store)
    P = np.where(cells.opening == 0, 0.2, 0.05)
    found = solve_oil(cells, P, np.ones((N, M)), by_newton=by_newton)
    outflow = oil_outflow(cells, found.pressure, found.theta)
    np.testing.assert_allclose(outflow[cells.opening < 0], 0.0, atol=1e-13)
    for k in fed:
        assert outflow[cells.opening == k].sum() == pytest.approx(0.3, rel=1e-12)
    assert np.abs(found.pressure * (1.0 - found.theta)).max() < 1e-13
    assert found.pressure.min() >= -1e-13
    assert found.theta.max() <= 1.0 + 1e-13


def test_a_guess_does_not_change_the_film():
    cells = cells_of(5)
    P, theta = np.where(cells.opening == 0, 0.2, 0.05), np.ones((N, M))
    cold, other = solve_oil(cells, P, theta), solve_oil(cells, P, theta, np.zeros((N, M)))
    np.testing.assert_array_equal(cold.full[cells.opening < 0], other.full[cells.opening < 0])
    np.testing.assert_array_equal(cold.pressure, other.pressure)


def test_sets_have_time_to_move_along_the_bearing():
    # Oil pressed in at mid-length fills one half-empty cell after the other of a line, one with each set.
    lines, nodes = 4, 90
    one = np.ones((lines, nodes))
    along = np.full((lines, nodes + 1), 1.0 * nodes)
    along[:, [0, -1]] = 2.0 * nodes
    cells = replace(
        cells_of(1, supplied=False),
        wedge=0.0 * one,
        around=0.0 * one,
        along=along,
        store=one / nodes,
        first_pressure=10.0,
        old=0.5 * one / nodes,
        opening=np.full((lines, nodes), -1, dtype=np.int32),
    )
    empty = np.zeros((lines, nodes))
    found = solve_oil(cells, empty, empty, empty)
    assert found.full.all()
    assert (found.solutions, found.newton) == (nodes + 1, 0)


def test_transport_without_a_supply_is_refused():
    cells = replace(cells_of(1, supplied=False), along=np.zeros((N, M + 1)), wedge=np.ones((N, M)))
    with pytest.raises(ConvergenceError, match="may have no supply, or be too thin"):
        solve_oil(cells, np.zeros((N, M)), np.ones((N, M)), np.zeros((N, M)))
