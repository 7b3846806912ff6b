"""The film from a feed slit in the bearing: exact derivatives, a finite-volume film, backward rotation."""

import numpy as np
import pytest

from rotorfilm import FullFilm, InputError, JournalBearing, Pad, ValidityWarning
from rotorfilm.bearings import FilmGeometry
from rotorfilm.bearings.journal import FixedArc, ReynoldsFilm, SlitArc, SpectralArcFilm, SplittingFilm

PAIR = SlitArc(slit=3.4, extent=2.2)
ONE = SlitArc(slit=3.0)
FILMS = {
    "(1,1)": SplittingFilm(order=(1, 1), rupture=PAIR),
    "(2,all)": SplittingFilm(order=(2, None), rupture=PAIR),
    "(6+c,3)": SplittingFilm(order=(6, 3), constant=True, rupture=PAIR),
    "spectral": SpectralArcFilm(degree=24, rupture=PAIR),
    "(4+c,all) to (38)": SplittingFilm(order=(4, None), constant=True, rupture=ONE),
}


def rotating(chi, attitude, squeeze=(0.02, -0.03)):
    """Return eccentricity and source of a journal that turns at 1 rad/s and moves a little."""
    e = chi * np.array([np.cos(attitude), np.sin(attitude)])
    return e, np.asarray(squeeze) - 0.5 * np.array([-e[1], e[0]])


def states():
    """Return states about which the source drives pressure at the slit."""
    pairs = [rotating(chi, phi) for chi in (0.15, 0.5, 0.8) for phi in (-1.3, -0.7, 0.1)]
    return tuple(np.transpose(part) for part in zip(*pairs, strict=True))


@pytest.mark.parametrize("film", FILMS.values(), ids=FILMS.keys())
def test_derivatives_with_the_attitude_equal_differences_of_fourth_order(film):
    e, w = states()
    z, h = np.concatenate([e, w]), 1e-4

    def force(states):
        return film.force(states[:2], states[2:], 0.6)

    jacobian = film.jacobian(e, w, 0.6)
    for column in range(4):
        d = h * np.eye(4)[:, [column]]
        near, far = force(z + d) - force(z - d), force(z + 2.0 * d) - force(z - 2.0 * d)
        difference = (8.0 * near - far) / (12.0 * h)
        scale = np.abs(jacobian).max(axis=(0, 1))
        np.testing.assert_allclose(jacobian[:, column] / scale, difference / scale, atol=2e-7)


@pytest.mark.closed_form
@pytest.mark.parametrize("attitude", [-1.3, 0.4])
@pytest.mark.parametrize("slenderness", [0.5, 1.0])
def test_film_between_two_slits_is_that_of_finite_volumes(attitude, slenderness):
    e, w = rotating(0.6, attitude)
    pad = FilmGeometry(pads=(Pad(start=PAIR.slit, extent=PAIR.extent),))
    cells = ReynoldsFilm(cells=(128, 16), cavitation=FullFilm(), geometry=pad)
    exact = SpectralArcFilm(rupture=PAIR)
    force, _ = cells.extrapolated(e, w, slenderness)
    found = exact.force(e, w, slenderness)
    np.testing.assert_allclose(force, found, atol=1e-4 * np.hypot(*found))
    slopes, coarse = exact.jacobian(e, w, slenderness), cells.jacobian(e, w, slenderness)
    finer = ReynoldsFilm(cells=(256, 32), cavitation=FullFilm(), geometry=pad).jacobian(e, w, slenderness)
    extrapolated = finer + (finer - coarse) / 3.0
    np.testing.assert_allclose(extrapolated, slopes, atol=3e-4 * np.abs(slopes).max())
    # Without the term of the attitude, as of an arc that moves with the journal, K is another.
    moving = SpectralArcFilm(rupture=FixedArc(start=PAIR.slit - np.pi - attitude, extent=PAIR.extent))
    np.testing.assert_allclose(moving.force(e, w, slenderness), found, rtol=1e-9)
    change = np.abs(moving.jacobian(e, w, slenderness) - slopes).max(axis=0)
    assert change[:2].max() > 0.1 * np.abs(slopes[:, :2]).max()
    assert change[2:].max() < 1e-9 * np.abs(slopes[:, 2:]).max()
    splitting = SplittingFilm(order=(6, None), rupture=PAIR)
    np.testing.assert_allclose(
        splitting.jacobian(e, w, slenderness), slopes, atol=1e-3 * np.abs(slopes).max()
    )


def test_the_film_is_smooth_at_the_center():
    film = FILMS["(6+c,3)"]
    w, h = np.array([0.2, -0.3]), 1e-3
    steps = h * np.eye(2)[:, :, None]
    ahead, behind = (film.force(sign * steps[:, :, 0], np.stack([w, w], -1), 0.6) for sign in (1.0, -1.0))
    jacobian = film.jacobian(np.zeros(2), w, 0.6)[:, :2]
    np.testing.assert_allclose(
        jacobian, (ahead - behind) / (2.0 * h), atol=1e-5 * np.abs(film.force(np.zeros(2), w, 0.6)).max()
    )


def bearing(rupture):
    film = SplittingFilm(order=(4, None), constant=True, rupture=rupture)
    return JournalBearing(radius=0.05, length=0.05, clearance=1e-4, viscosity=0.02, film=film)


def test_slits_stay_where_they_are_when_the_shaft_turns_backward():
    """A full film between two slits is odd in the speed; one to a free end goes the other way round."""
    place, still = np.array([4e-5, -3e-5]), np.zeros(2)
    forward, back = (bearing(PAIR).force(place, still, speed) for speed in (100.0, -100.0))
    np.testing.assert_allclose(back, -forward, rtol=1e-9)
    mirror = np.array([1.0, -1.0])
    seen = bearing(SlitArc(slit=-3.0)).force(mirror * place, still, -100.0)
    np.testing.assert_allclose(mirror * seen, bearing(ONE).force(place, still, 100.0), rtol=1e-9)
    both = bearing(ONE).force(np.stack([place, place], -1), np.zeros((2, 2)), np.array([100.0, 80.0]))
    assert both.shape == (2, 2)
    speeds = np.array([100.0, -100.0])
    many = bearing(PAIR).jacobian(np.stack([place, place], -1), np.zeros((2, 2)), speeds)
    for k, speed in enumerate(speeds):
        np.testing.assert_allclose(many[..., k], bearing(PAIR).jacobian(place, still, speed), rtol=1e-12)


def test_what_it_refuses():
    with pytest.raises(InputError, match=r"extent must be from 0\.001 to 2 pi, got 7\.0"):
        SlitArc(slit=0.0, extent=7.0)
    with pytest.raises(InputError, match="slit must be"):
        SlitArc(slit=np.nan)
    with pytest.warns(ValidityWarning, match="without constant=True"):
        SplittingFilm(rupture=SlitArc(slit=0.0, extent=5.0))
