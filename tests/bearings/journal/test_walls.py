"""The bush around a warm film: its response against the closed solutions of a ring that conducts heat."""

import numpy as np
import pytest

from rotorfilm import InputError
from rotorfilm.bearings.journal import AdiabaticWalls, BushRing, HeldWalls

R, OUTER, K = 0.05, 0.1, 50.0
N = np.arange(1.0, 6.0)
START = np.linspace(0.0, 2.0 * np.pi, 400, endpoint=False)
EXTENT = np.full(400, 2.0 * np.pi / 400)


@pytest.mark.closed_form
def test_mean_heat_passes_ring_and_outer_film_in_series():
    ring = BushRing(outer_radius=OUTER, conductivity=K, transfer=80.0)
    resistance = np.log(OUTER / R) / (2.0 * np.pi * K) + 1.0 / (2.0 * np.pi * OUTER * 80.0)
    assert 2.0 * np.pi * R * ring.mean_transfer(R) == pytest.approx(1.0 / resistance, rel=1e-13)


@pytest.mark.closed_form
@pytest.mark.parametrize(("transfer", "factor"), [(0.0, np.tanh), (1e12, lambda x: 1.0 / np.tanh(x))])
def test_waves_in_a_ring_insulated_or_held_outside(transfer, factor):
    ring = BushRing(outer_radius=OUTER, conductivity=K, transfer=transfer)
    expected = K * N / R * factor(N * np.log(OUTER / R))
    np.testing.assert_allclose(ring.wave_transfer(R, N), expected, rtol=1e-8)


@pytest.mark.closed_form
@pytest.mark.parametrize("waves", [1, 3])
def test_response_to_a_wave_of_heat(waves):
    ring = BushRing(outer_radius=OUTER, conductivity=K, transfer=500.0)
    found = ring.response(R, START, EXTENT)
    middle = START + 0.5 * EXTENT
    heat = 1000.0 * np.cos(waves * middle) * R * EXTENT
    expected = 1000.0 * np.cos(waves * middle) / ring.wave_transfer(R, np.array(float(waves)))
    np.testing.assert_allclose(found.spread @ heat, expected, atol=2e-4 * abs(expected).max())
    assert found.take * heat.sum() == pytest.approx(0.0, abs=1e-9)


def test_response_on_uneven_cells_is_symmetric_and_gives():
    edges = np.sort(np.random.default_rng(3).uniform(0.0, 2.0 * np.pi, 30))
    extent = (np.roll(edges, -1) - edges) % (2.0 * np.pi)
    spread = BushRing(outer_radius=OUTER).response(R, edges, extent).spread
    np.testing.assert_allclose(spread, spread.T, atol=1e-15)
    assert np.linalg.eigvalsh(spread).min() > -1e-12
    np.testing.assert_allclose(spread @ extent, 0.0, atol=1e-12)


def test_walls_name_what_breaks_a_rule():
    with pytest.raises(InputError, match=r"outer_radius must be above the bearing's radius 0.05, got 0.05"):
        BushRing(outer_radius=R).response(R, START, EXTENT)
    with pytest.raises(InputError, match="conductivity must be finite and positive, got 0"):
        BushRing(outer_radius=OUTER, conductivity=0.0)
    with pytest.raises(InputError, match="transfer must be finite and not negative, got -1"):
        BushRing(outer_radius=OUTER, transfer=-1.0)
    with pytest.raises(InputError, match="bush_temperature must be finite and positive"):
        HeldWalls(bush_temperature=0.0, journal_temperature=300.0)
    assert AdiabaticWalls().response(R, START, EXTENT) is None
