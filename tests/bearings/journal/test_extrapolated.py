"""The extrapolated two-dimensional film: closer than its finer grid, exact derivatives, clear mistakes."""

import numpy as np
import pytest

from rotorfilm import FullFilm, Groove, InputError
from rotorfilm.bearings import Complementarity, FilmGeometry, HalfSommerfeld
from rotorfilm.bearings.films.finite_volumes import richardson
from rotorfilm.bearings.journal import ExtrapolatedFilm, JournalBearing, MapFilm, ReynoldsFilm

E, W = np.array([0.5, 0.2]), np.array([-0.4, 0.6])


@pytest.mark.parametrize("cells", [(48, 8), (96, 8), (192, 16)])
def test_extrapolation_is_closer_than_its_finer_grid(cells):
    exact = MapFilm().force(E, W, 0.5)
    plain, film = ReynoldsFilm(cells=cells), ExtrapolatedFilm(film=ReynoldsFilm(cells=cells))
    gap, rest = (np.hypot(*(law.force(E, W, 0.5) - exact)) for law in (plain, film))
    assert rest < 0.2 * gap


def test_derivatives_are_those_of_the_force():
    # A full film, so that no edge jumps from node to node within the step of the differences. Those are along
    # with the lines, the derivatives beside them: what is left of either by the extrapolation differs.
    film = ExtrapolatedFilm(film=ReynoldsFilm(cells=(48, 8), cavitation=FullFilm()))
    jacobian, state, step = film.jacobian(E, W, 0.5), np.concatenate([E, W]), 1e-4
    for k, unit in enumerate(np.eye(4)):
        ahead, behind = (film.force(*np.split(state + s * step * unit, 2), 0.5) for s in (1.0, -1.0))
        np.testing.assert_allclose(jacobian[:, k], (ahead - behind) / (2.0 * step), rtol=1e-4, atol=1e-7)


@pytest.mark.parametrize("cavitation", [Complementarity(), HalfSommerfeld(), FullFilm()], ids=str)
@pytest.mark.parametrize("grooves", [(), (Groove(center=0.4, width=0.3),)])
def test_compiled_film_is_that_of_two_grids(cavitation, grooves):
    geometry = FilmGeometry(grooves=grooves)
    fine = ReynoldsFilm(cells=(48, 8), cavitation=cavitation, geometry=geometry)
    film = ExtrapolatedFilm(film=fine)
    rng = np.random.default_rng(1)
    e, w = 0.6 * rng.uniform(-1.0, 1.0, (2, 20)), rng.normal(size=(2, 20))
    assert np.array_equal(film.force(e, w, 0.5), fine.extrapolated(e, w, 0.5)[0])
    exact = richardson(fine.jacobian(e, w, 0.5), film.coarse.jacobian(e, w, 0.5))
    np.testing.assert_allclose(film.jacobian(e, w, 0.5), exact, atol=1e-11 * np.abs(exact).max())


def test_a_bearing_on_it_is_a_kernel():
    film = ExtrapolatedFilm(film=ReynoldsFilm(cells=(32, 8)))
    bearing = JournalBearing(radius=0.05, length=0.05, clearance=1e-4, viscosity=0.1, film=film)
    spec = bearing.native()
    assert spec.kernel == "reynolds_journal"
    assert spec.tables["ring"].tolist() == [0.5, 1.0, 0.0, 0.0, 0.0, 1.0]


def test_grooves_reach_both_grids():
    dimensions = {"radius": 0.05, "length": 0.05, "clearance": 1e-4, "viscosity": 0.1}
    film = ExtrapolatedFilm(film=ReynoldsFilm(cells=(96, 8)))
    grooved = JournalBearing(**dimensions, film=film, grooves=(Groove(center=0.4, width=0.3),))
    state = 1e-4 * E, 1e-2 * W, 100.0
    assert grooved.fitted_film.coarse.geometry == grooved.geometry
    exact = JournalBearing(
        **dimensions, film=ReynoldsFilm(cells=(384, 32)), grooves=(Groove(center=0.4, width=0.3),)
    ).force(*state)
    assert np.hypot(*(grooved.force(*state) - exact)) < 0.02 * np.hypot(*exact)


@pytest.mark.parametrize("cells", [(36, 8), (48, 4), (16, 8)])
def test_cells_that_cannot_be_halved_are_refused(cells):
    with pytest.raises(InputError, match=r"cells must be multiples of 8, at least \(32, 8\)"):
        ExtrapolatedFilm(film=ReynoldsFilm(cells=cells))


def test_other_films_are_refused():
    with pytest.raises(InputError, match="film must be a ReynoldsFilm, got MapFilm"):
        ExtrapolatedFilm(film=MapFilm())
