"""Maps of films whose oil has a mobility, and their losses, against the films on grids."""

from dataclasses import replace

import numpy as np
import pytest
from numpy.testing import assert_allclose

import rotorfilm as rf
from rotorfilm import GroovedMapFilm, InputError
from rotorfilm.bearings import PadGridFilm, PadMapFilm, PadResolution, mobility_of
from rotorfilm.bearings.journal import ReynoldsFilm

SIZE = {"radius": 0.05, "length": 0.06, "viscosity": 0.02}
PLACE, VELOCITY, SPEED = np.array([2e-5, -3e-5]), np.array([1e-3, 2e-3]), 200.0
GROOVES = (rf.Groove(center=0.0, width=0.35), rf.Groove(center=np.pi, width=0.35))
TOY = mobility_of(lambda H: (1.0 / (1.0 + H), 1.0 / (1.0 + 0.5 * H), 1.0, 1.0 + H))
COARSE = PadResolution(cells=(32, 4), nodes=(10, 9, 40), xi_range=(-0.6, 0.9))


def both(name, mobility):
    """Return a bearing by its map, and by the grid that it is made of."""
    if name == "grooved":
        films = (
            GroovedMapFilm(cells=(64, 4), nodes=(8, 32, 24), mobility=mobility),
            ReynoldsFilm(cells=(96, 8), mobility=mobility),
        )
        return [rf.JournalBearing(**SIZE, clearance=1e-4, grooves=GROOVES, film=film) for film in films]
    films = PadMapFilm(resolution=COARSE, mobility=mobility), PadGridFilm(cells=(64, 8), mobility=mobility)
    pads = {**SIZE, "pad_clearance": 1e-4}
    if name == "lobed":
        return [rf.LobedBearing(**pads, lobes=rf.lobe_set("three_lobe"), film=film) for film in films]
    pivots = rf.even_pivots(4, between_pads=True)
    tilting = (
        rf.TiltingPadBearing(**pads, pivots=pivots, extent=1.3, preload=0.5, film=film) for film in films
    )
    return [one.at_rest() for one in tilting]


@pytest.fixture(scope="module", autouse=True)
def cache(tmp_path_factory):
    """Keep the maps in a folder of their own."""
    with pytest.MonkeyPatch.context() as patch:
        patch.setenv("ROTORFILM_CACHE", str(tmp_path_factory.mktemp("maps")))
        yield


@pytest.mark.parametrize("name", ["grooved", "lobed", "tilting"])
def test_a_mobility_reaches_maps_and_their_losses(name):
    mapped, grid = both(name, TOY)
    velocity = np.zeros(2) if name == "tilting" else VELOCITY
    force = grid.force(PLACE, velocity, SPEED)
    size = np.hypot(*force)
    assert_allclose(mapped.force(PLACE, velocity, SPEED), force, atol=0.01 * size)
    by = grid.jacobian(PLACE, velocity, SPEED)
    for column in ((0, 1), (2, 3), (4,)):
        wanted = by[:, column]
        assert_allclose(
            mapped.jacobian(PLACE, velocity, SPEED)[:, column], wanted, atol=0.04 * np.abs(wanted).max()
        )
    laminar = both(name, None)[1]
    assert np.hypot(*(force - laminar.force(PLACE, velocity, SPEED))) > 0.1 * size
    for full in (False, True):
        found, wanted, plain = (
            each.losses(PLACE, np.zeros(2), SPEED, full_gap=full) for each in (mapped, grid, laminar)
        )
        assert found.power_loss == pytest.approx(wanted.power_loss, rel=0.01)
        assert found.side_flow == pytest.approx(wanted.side_flow, rel=0.03)
        assert wanted.power_loss > 1.3 * plain.power_loss


def test_damping_of_an_eased_map_is_symmetric_and_its_force_of_degree_one():
    mapped, _ = both("grooved", TOY)
    by = mapped.jacobian(PLACE, VELOCITY, SPEED)
    assert_allclose(by[:, 2:4], by[:, 2:4].T, rtol=1e-12)
    assert_allclose(
        by[:, 2:4] @ VELOCITY + by[:, 4] * SPEED, mapped.force(PLACE, VELOCITY, SPEED), rtol=1e-11
    )


def test_the_error_beyond_an_eased_map_is_not_known():
    mapped, _ = both("grooved", TOY)
    assert mapped.bound_film.kernel.film.error == 0.0
    assert both("grooved", None)[0].bound_film.kernel.film.error > 0.0


def test_a_table_of_another_mobility_is_refused():
    film = both("grooved", TOY)[0].portable().film
    with pytest.raises(InputError, match="mobility must be the one that the table was made with"):
        replace(film, mobility=None)
    pads = both("lobed", TOY)[0].portable()
    with pytest.raises(InputError, match="mobility must be the one that the table was made with"):
        replace(pads, film=replace(pads.film, mobility=None))
    drags = mobility_of(lambda H: (1.0, 1.0, 1.0 + H, 1.0), cells=8)
    for other in (drags, replace(TOY, density=800.0)):
        with pytest.raises(InputError, match="mobility of a map must depend on the thickness only"):
            PadMapFilm(mobility=other)
        with pytest.raises(InputError, match="mobility of a map must depend on the thickness only"):
            GroovedMapFilm(mobility=other, reynolds_cells=0)
