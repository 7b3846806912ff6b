"""Tilting pads whose place or tilt is hard to find: loads that one pad carries nearly alone, splines."""

import re

import numpy as np
import pytest

from rotorfilm import (
    EquilibriumError,
    PadMapFilm,
    TiltingPadBearing,
    ValidityWarning,
    equilibrium,
    even_pivots,
)
from rotorfilm.bearings.pads.tilting_pads import TURN, directions

SPEED = 300.0


@pytest.mark.closed_form
@pytest.mark.parametrize("heavy", [0.5, 10.0])
@pytest.mark.parametrize("side", [1e-3, -1e-3, 1e-4])
@pytest.mark.filterwarnings("ignore::rotorfilm.core.errors.UnloadedPadWarning")
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


@pytest.mark.filterwarnings("ignore::rotorfilm.core.errors.UnloadedPadWarning")
def test_an_overloaded_pad_is_told_as_an_overloaded_journal_is():
    bearing = TiltingPadBearing(
        radius=0.04,
        length=0.04,
        assembled_clearance=7e-5,
        preload=0.3,
        extent=np.pi / 3.0,
        viscosity=0.02,
        pivots=even_pivots(5, between_pads=True),
    )
    equilibrium(bearing, (0.0, -2e4), 314.0)
    beyond = r"least films of 6\.11e-09, .* are beyond the map of a pad; its force is extrapolated there"
    with pytest.warns(ValidityWarning, match="makes a mean pressure of 1.56e"), pytest.warns(match=beyond):
        equilibrium(bearing, (0.0, -5e6), 314.0)
    with pytest.raises(
        EquilibriumError, match=r"the film's capacity .*: the largest film force found is"
    ) as why:
        equilibrium(bearing, (0.0, -5e7), 314.0)
    carried = float(re.search(r"found is (\S+) N", str(why.value))[1])
    assert 5e6 < carried < 5e7


CIRCLES = [
    (
        (1.5768342966143575e-05, -4.8960275813175866e-05, -5.083726297558074e-05, 3.0385281535486464e-05),
        (-3.279893502959982e-05, 6.32633637350964e-05, -1.4555793215066918e-05, -3.0748299551809394e-05),
    ),
    (
        (1.1533588193916555e-05, 2.7984857394483638e-06, -0.002980422431739963, -0.007789090046664958),
        (5.0699225987634845e-05, 3.8815537911529006e-05, -2.8304797593655173e-05, -6.686912425611502e-07),
    ),
]
"""x, y, vx, vy and the tilts of four pads, of 33000 random states those that failed Newton's method."""


def test_pads_follow_where_newtons_steps_go_round_in_circles(tilting):
    """The moment of a spline bends where the film ruptures."""
    pivots = even_pivots(4, between_pads=True)
    bearing = tilting(4, 0.5, 60.0, 0.3, film=PadMapFilm(), pivots=pivots)
    Q, c, none = directions(pivots), bearing.clearance, np.zeros(4)
    for (*place, vx, vy), tilts in CIRCLES:
        rates = bearing.evaluated(tilts, [*place, vx, vy, SPEED]).rates
        shift = np.array([[bearing.preload], [0.0]])
        e = (np.einsum("kij,i->jk", Q, place) + np.stack([none, tilts])) / c + shift
        w = (np.einsum("kij,i->jk", Q, (vx, vy)) + np.stack([none, rates])) / c + 0.5 * SPEED * TURN @ e
        force = bearing.kernel.film.force(e, w).values
        # With pivots in the middle the frames agree: no moment is left.
        assert np.abs(force[0]).max() > 0.0
        assert np.all(np.abs(force[1]) <= 1e-9 * np.abs(force[0]).max())
