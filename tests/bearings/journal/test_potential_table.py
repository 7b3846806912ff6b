"""Axes and files of the impedance map's nodes."""

from pathlib import Path

import numpy as np
import pytest
from map_nodes import (
    FIELDS,
    load_table,
    modulation,
    save_table,
    table_row,
    universal_axes,
)
from map_potential import potential

from rotorfilm import InputError
from rotorfilm.bearings.films.map_table import stretch, unstretch

NODES = Path(__file__).parents[3] / "tools" / "map_nodes.npz"


def test_stretched_eccentricity_is_inverted():
    chi = np.array([0.0, 1e-9, 0.3, 0.9, 0.99, 0.999, 0.99999])
    np.testing.assert_allclose(unstretch(stretch(chi)), chi, rtol=1e-14)


def test_default_axes():
    axes = universal_axes()
    assert axes.shape == (17, 25, 97)
    assert axes.chi[-1] > 0.999
    np.testing.assert_allclose(np.exp(axes.log_slenderness[[0, -1]]), [0.1, 4.0])


def test_modulation_is_continuous_at_the_center():
    axes = universal_axes(cells=(2, 2, 1), top=0.02, slenderness=(0.5, 1.0))
    rows = [[table_row(chi, s, axes.T) for chi in axes.chi] for s in np.exp(axes.log_slenderness)]
    log, _, chi_slope, *_ = np.moveaxis(np.array(rows), 2, 0)
    center, M = modulation(axes, log, chi_slope)
    assert center[1] == pytest.approx(potential(0.0, 0.2, 1.0).log, abs=1e-8)
    np.testing.assert_allclose(M[:, 0], 2.0 * M[:, 1] - M[:, 2], atol=1e-3)


def test_file_round_trip(tmp_path):
    axes = universal_axes(cells=(1, 1, 1))
    fields = {name: np.full(axes.shape, float(i)) for i, name in enumerate(FIELDS)}
    save_table(tmp_path / "nodes.npz", axes, fields)
    loaded_axes, loaded = load_table(tmp_path / "nodes.npz")
    np.testing.assert_array_equal(loaded_axes.X, axes.X)
    assert all(np.array_equal(loaded[name], fields[name]) for name in FIELDS)


def test_incomplete_file_is_refused(tmp_path):
    np.savez(tmp_path / "nodes.npz", X=np.zeros(2))
    with pytest.raises(InputError, match="must hold"):
        load_table(tmp_path / "nodes.npz")


@pytest.fixture(scope="module")
def nodes():
    return load_table(NODES)


@pytest.mark.closed_form
def test_nodes_hold_the_parity_at_the_center(nodes):
    _, fields = nodes
    slope = fields["chi_slope"][:, 0]
    np.testing.assert_allclose(slope, -slope[:, ::-1], atol=2e-5)
    assert np.max(np.ptp(fields["log"][:, 0, ::2], axis=1)) < 1e-7


@pytest.mark.regression
@pytest.mark.parametrize("index", [(0, 3, 96), (7, 12, 48), (10, 20, 61), (16, 24, 0)])
def test_nodes_are_what_the_solver_gives(nodes, index):
    axes, fields = nodes
    k, i, j = index
    film = potential(float(axes.chi[i]), float(axes.T[j]), float(np.exp(axes.log_slenderness[k])))
    assert fields["log"][index] == pytest.approx(film.log, abs=1e-8)


def test_nodes_are_complete(nodes):
    # Below X = 2.4 every second direction: `tools/fit_map.py` fills the others.
    axes, fields = nodes
    left_out = np.zeros(axes.shape, dtype=bool)
    left_out[:, axes.X < 2.4 - 1e-9, 1::2] = True
    assert all(np.array_equal(np.isnan(fields[name]), left_out) for name in FIELDS)
    assert np.nanmax(fields["error"]) < 2e-6
