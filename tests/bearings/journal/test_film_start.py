"""Where a film without openings starts: printed tables, the difference that it makes, exact derivatives."""

import numpy as np
import pytest

from rotorfilm import Groove, InputError, JournalBearing, ReynoldsFilm
from rotorfilm.bearings import ExtrapolatedFilm, FilmGeometry, FixedOnset, FreeOnset, MaximumGapOnset

from .butenschoen import BUTENSCHOEN


def static(eps):
    """Return eccentricity along +x and source of a journal at rest that turns at 1 rad/s."""
    return np.array([eps, 0.0]), np.array([0.0, -0.5 * eps])


def answer(start, eps, slenderness, cells=(192, 16)):
    """Return the Sommerfeld number, and the angle from the load to e in the sense of the speed [deg]."""
    force, _ = ReynoldsFilm(cells=cells, film_start=start).extrapolated(*static(eps), slenderness)
    return 0.5 * np.hypot(*force), np.degrees(-np.arctan2(-force[1], -force[0]))


@pytest.mark.literature
@pytest.mark.parametrize(("slenderness", "eps", "So", "attitude", "flow"), BUTENSCHOEN)
def test_widest_gap_is_the_start_of_printed_tables(slenderness, eps, So, attitude, flow):
    # Converged, .12 and .25 % lie between this film and the table at L/D 1, eccentricity ratios .7 and .9.
    found = answer(MaximumGapOnset(), eps, slenderness)
    assert found[0] == pytest.approx(So, rel=3e-3 if slenderness == 1.0 and eps >= 0.7 else 1.1e-3)
    assert found[1] == pytest.approx(attitude, abs=0.02)
    losses = ReynoldsFilm(cells=(192, 16), film_start=MaximumGapOnset()).losses(*static(eps), slenderness)
    assert 2.0 * slenderness * losses.side_flow == pytest.approx(flow, rel=6e-3)
    assert losses.inflow.shape == losses.arriving.shape == (0,)


@pytest.mark.parametrize(
    ("slenderness", "eps", "degrees"),
    [(1.0, 0.1, 4.43), (1.0, 0.5, 1.98), (1.0, 0.9, 0.23), (2.0, 0.3, 9.1), (2.0, 0.7, 4.9)],
)
def test_a_free_start_turns_the_force(slenderness, eps, degrees):
    # Free start minus widest gap, computed once by a program that shares no code with this one.
    free, widest = (answer(start, eps, slenderness) for start in (FreeOnset(), MaximumGapOnset()))
    assert free[1] - widest[1] == pytest.approx(degrees, abs=0.06)


@pytest.mark.closed_form
def test_a_line_that_stays_is_a_line_groove_at_ambient_pressure():
    e, w = np.array([0.3, -0.4]), np.array([0.4, 0.2])
    line = ReynoldsFilm(film_start=FixedOnset(line=0.7))
    groove = ReynoldsFilm(geometry=FilmGeometry(grooves=(Groove(center=0.7),)))
    np.testing.assert_allclose(line.force(e, w, 0.6), groove.force(e, w, 0.6), rtol=1e-12)
    np.testing.assert_allclose(line.jacobian(e, w, 0.6), groove.jacobian(e, w, 0.6), rtol=1e-10)
    assert line.losses(e, w, 0.6).inflow.shape == (0,)
    opposite = ReynoldsFilm(film_start=FixedOnset(line=float(np.arctan2(-e[1], -e[0]))))
    widest = ReynoldsFilm(film_start=MaximumGapOnset())
    np.testing.assert_allclose(opposite.force(e, w, 0.6), widest.force(e, w, 0.6), rtol=1e-12)


@pytest.mark.parametrize("film", [ReynoldsFilm, lambda **k: ExtrapolatedFilm(film=ReynoldsFilm(**k))])
def test_line_at_the_widest_gap_turns_exactly(film):
    # Turned, the lines turn along: at right angles to e the derivative is exact on every grid.
    film = film(cells=(64, 8), film_start=MaximumGapOnset())
    e, w, h = np.array([0.3, -0.45]), np.array([0.2, 0.3]), 1e-6

    def turned(angle, vector):
        cos, sin = np.cos(angle), np.sin(angle)
        return np.array([[cos, -sin], [sin, cos]]) @ vector

    slope = (film.force(turned(h, e), w, 0.7) - film.force(turned(-h, e), w, 0.7)) / (2.0 * h)
    across = film.jacobian(e, w, 0.7)[:, :2] @ np.array([-e[1], e[0]])
    np.testing.assert_allclose(across, slope, atol=1e-7 * np.abs(slope).max())
    force = film.force(e, w, 0.7)
    np.testing.assert_allclose(film.force(turned(1.3, e), turned(1.3, w), 0.7), turned(1.3, force), rtol=1e-9)


def test_a_moving_start_has_other_stiffness_and_damping():
    # Turning with the journal or staying where that was: the same force, other derivatives.
    e, w = static(0.3)
    turning = ReynoldsFilm(film_start=MaximumGapOnset()).jacobian(e, w, 1.0)
    staying = ReynoldsFilm(film_start=FixedOnset(line=np.pi)).jacobian(e, w, 1.0)
    np.testing.assert_allclose(turning[:, 2:], staying[:, 2:], rtol=1e-9)
    np.testing.assert_allclose(turning[:, 0], staying[:, 0], rtol=1e-9)
    assert np.abs(turning[:, 1] - staying[:, 1]).max() > 0.02 * np.abs(turning).max()


def test_starts_are_for_bearings_without_openings():
    sizes = {"radius": 0.05, "length": 0.05, "clearance": 1e-4, "viscosity": 0.02}
    for start in (MaximumGapOnset(), FixedOnset(line=0.3)):
        with pytest.raises(InputError, match=r"film_start must be FreeOnset\(\) in a bearing with openings"):
            JournalBearing(**sizes, grooves=(Groove(center=0.0),), film=ReynoldsFilm(film_start=start))
    with pytest.raises(InputError, match="film_start must be such as"):
        ReynoldsFilm(film_start="widest gap")
    with pytest.raises(InputError, match="line must be finite"):
        FixedOnset(line=np.nan)
