"""Tilting pads whose place or tilt is hard to find: loads that one pad carries nearly alone, splines."""

import re
import warnings
from dataclasses import replace

import numpy as np
import pytest

from rotorfilm import (
    EquilibriumError,
    TiltingPadBearing,
    ValidityWarning,
    coefficients,
    equilibrium,
    even_pivots,
    whirl_threshold,
)
from rotorfilm.bearings import PadGridFilm, PadMapFilm
from rotorfilm.bearings.pads.pads_at_rest import WEDGE, directions

SPEED = 300.0


@pytest.mark.closed_form
@pytest.mark.parametrize("heavy", [pytest.param(0.5, marks=pytest.mark.long), 10.0])
@pytest.mark.parametrize("side", [1e-3, -1e-3, pytest.param(1e-4, marks=pytest.mark.long)])
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


@pytest.mark.long
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
        w = (np.einsum("kij,i->jk", Q, (vx, vy)) + np.stack([none, rates])) / c + 0.5 * SPEED * WEDGE @ e
        force = bearing.kernel.film.force(e, w).values
        # With pivots in the middle the frames agree: no moment is left.
        assert np.abs(force[0]).max() > 0.0
        assert np.all(np.abs(force[1]) <= 1e-9 * np.abs(force[0]).max())


@pytest.mark.closed_form
@pytest.mark.parametrize("angle", [90.0, 60.0])
def test_a_load_that_no_pad_can_carry_is_refused(tilting, angle):
    """Pads push along their pivots only: two opposite ones have no force across."""
    bearing = tilting(2, 0.5, 60.0, 0.3, film=PadMapFilm(), first=0.0)
    load = -1000.0 * np.array([np.cos(np.radians(angle)), np.sin(np.radians(angle))])
    with pytest.raises(EquilibriumError, match=r"it has no force in the opposite direction"):
        equilibrium(bearing, load, SPEED)


def light_pads(tilting, seed, preload):
    """Return a random bearing of pads, a load of 0.01 to 1 N in the direction of a pivot, and a speed."""
    random = np.random.default_rng(seed)
    bearing = tilting(
        int(random.choice([3, 4, 5])),
        0.5,
        56.0,
        preload,
        cells=(16, 4),
        pad_clearance=random.uniform(5e-5, 2e-4),
        viscosity=random.uniform(0.005, 0.04),
    )
    return bearing, np.array([0.0, -(10.0 ** random.uniform(-2.0, 0.0))]), random.uniform(100.0, 800.0)


@pytest.mark.closed_form
@pytest.mark.parametrize("seed", range(5))
@pytest.mark.parametrize("preload", [0.1, 0.3, 0.7])
def test_a_light_load_on_preloaded_pads_moves_the_journal_by_the_stiffness_of_the_center(
    tilting, preload, seed
):
    bearing, load, speed = light_pads(tilting, seed, preload)
    at = equilibrium(bearing, load, speed)
    stiffness = coefficients(bearing, [0.0, 0.0], speed, 0.0).stiffness
    moved = np.linalg.solve(stiffness, load)
    np.testing.assert_allclose(at.position, moved, rtol=0.0, atol=2e-3 * np.hypot(*moved))
    carried = at.pads.pad_loads @ directions(bearing.pivots)[:, :, 0]
    np.testing.assert_allclose(carried, load, rtol=0.0, atol=1e-6 * abs(load[1]))


@pytest.mark.closed_form
@pytest.mark.parametrize("seed", [0, 1, *(pytest.param(k, marks=pytest.mark.long) for k in (2, 3, 4))])
@pytest.mark.filterwarnings("ignore::rotorfilm.core.errors.UnloadedPadWarning")
def test_a_light_load_on_pads_without_preload_moves_the_journal_by_its_square(tilting, seed):
    """The load of a centrally pivoted pad begins as the root of the way."""
    bearing, load, speed = light_pads(tilting, seed, 0.0)
    places = [equilibrium(bearing, part * load, speed).position[1] for part in (0.1, 1.0)]
    assert places[1] / places[0] == pytest.approx(100.0, rel=0.05)


@pytest.mark.long
@pytest.mark.closed_form
@pytest.mark.filterwarnings("ignore::rotorfilm.core.errors.UnloadedPadWarning")
def test_the_whirl_threshold_of_light_rotors_scales_with_their_load(tilting):
    """All pads are at the beginning of their load, where forces have one scale: speed goes as sqrt(load)."""
    bearing = tilting(5, 0.5, 60.0, 0.0, film=PadMapFilm())
    speeds = [whirl_threshold(bearing, [0.0, -load], mass=1.0).speed for load in (0.04, 1.0)]
    assert speeds[1] / speeds[0] == pytest.approx(5.0, rel=1e-3)


@pytest.mark.long
def test_a_load_below_the_roundoff_of_preloaded_pads_is_refused(tilting):
    bearing = tilting(4, 0.5, 60.0, 0.7, film=PadMapFilm())
    with pytest.raises(EquilibriumError, match="load must stand out from the roundoff of the film's forces"):
        equilibrium(bearing, [0.0, -1e-7], SPEED)


def test_the_default_map_reaches_the_thin_films_of_pads_with_much_preload():
    """Least film 0.025 of the assembled clearance, 0.005 of that of a pad: beside the grid, no warning."""
    bearing = TiltingPadBearing(
        radius=0.05,
        length=0.05,
        assembled_clearance=7e-5,
        preload=0.8,
        extent=np.pi / 3.0,
        viscosity=0.02,
        pivots=even_pivots(5),
    )
    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always")
        at = equilibrium(bearing, (0.0, -1.1e5), SPEED)
    assert not [one for one in caught if "beyond the map" in str(one.message)]
    assert at.minimum_film < 0.03 * 7e-5
    found = coefficients(bearing, at.position, SPEED)
    fine = coefficients(replace(bearing, film=PadGridFilm()), at.position, SPEED)
    for name in ("stiffness", "damping"):
        exact = getattr(fine, name)
        np.testing.assert_allclose(getattr(found, name), exact, atol=0.01 * np.abs(exact).max())
