"""Tilting pads whose place or tilt is hard to find: loads that one pad carries nearly alone, splines."""

import numpy as np
import pytest

from rotorfilm import FilmContactError, PadMapFilm, equilibrium
from rotorfilm.bearings.pads.pad_build import PadResolution
from rotorfilm.bearings.pads.tilting.held_pads import TURN
from rotorfilm.bearings.pads.tilting.pivots import directions

SPEED = 300.0
COARSE = PadMapFilm(resolution=PadResolution(cells=(16, 4), nodes=(8, 9, 24)))


@pytest.mark.closed_form
@pytest.mark.parametrize("heavy", [0.5, 10.0])
@pytest.mark.parametrize("side", [1e-3, -1e-3, 1e-4])
@pytest.mark.filterwarnings("ignore::rotorfilm.errors.UnloadedPadWarning")
def test_a_load_that_one_pad_carries_nearly_alone_has_its_place(tilting, side, heavy):
    bearing = tilting(3, 0.5, 80.0, -0.2, cells=(16, 4))
    load = heavy * bearing.force_scale * SPEED * np.array([side, -1.0])
    at = equilibrium(bearing, load, SPEED)
    # The heavy pad and the one that the load leans to; what a push along two pivots leaves is 0.
    pair = [0, 1] if side > 0.0 else [0, 2]
    expected = np.zeros(3)
    expected[pair] = np.linalg.solve(directions(bearing.pivots)[pair, :, 0].T, load)
    np.testing.assert_allclose(at.pads.pad_loads, expected, rtol=1e-9, atol=1e-12 * abs(load[1]))
    assert at.pads.unloaded.tolist() == (expected == 0.0).tolist()
    # Along its pivot the heavy pad is hardly moved: it stands as under the load alone.
    alone = equilibrium(bearing, [0.0, load[1]], SPEED)
    assert at.position[1] == pytest.approx(alone.position[1], rel=2e-3)
    assert abs(at.position[0]) > 0.3 * bearing.clearance


@pytest.mark.parametrize(
    ("place", "velocity", "tilts"),
    [
        ((15.768342966, -48.960275813), (-50.83726297558074, 30.385281535486464), (-32.8, 63.26, -14.6, -30.7)),
        ((11.533588193916555, 2.7984857394483638), (-2980.422431739963, -7789.090046664958), (50.7, 38.8, -28.3, -0.67)),
        ((-15.541, 48.498), (-13.036, -8.735), (-22.161, -59.757, -81.63, -37.14)),
    ],
)
def test_pads_follow_where_newtons_steps_would_go_round_in_circles(tilting, place, velocity, tilts):
    """The moment of a spline bends where the film ruptures: of some states in ten thousand steps repeat."""
    bearing = tilting(4, 0.5, 60.0, 0.3, film=COARSE)
    random, c = np.random.default_rng(3), bearing.clearance
    Q, found = directions(bearing.pivots), 0
    back = 0.5 * SPEED * TURN
    for _ in range(4000):
        place, tilts = 0.5 * c * random.uniform(-1.0, 1.0, 2), 0.9 * c * random.uniform(-1.0, 1.0, 4)
        velocity = c * SPEED * random.uniform(-1.0, 1.0, 2) * 10.0 ** random.uniform(-4.0, 0.0)
        try:
            rates = bearing.evaluated(tilts, [*place, *velocity, SPEED]).rates
        except FilmContactError:
            continue
        shift = np.array([[bearing.preload], [0.0]])
        e = (np.einsum("kij,i->jk", Q, place) + np.stack([np.zeros(4), tilts])) / c + shift
        w = (np.einsum("kij,i->jk", Q, velocity) + np.stack([np.zeros(4), rates])) / c + back @ e
        force = bearing.kernel.film.force(e, w).values
        film = force[0] != 0.0
        # With pivots in the middle the frames agree: no moment is left.
        assert (
            np.abs(force[1, film]).max(initial=0.0) <= 1e-9 * np.abs(force[0, film]).max(initial=0.0) + 1e-12
        )
        found += 1
    assert found > 2000
