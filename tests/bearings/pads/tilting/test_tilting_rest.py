"""Tilting pads at rest: other programs' figures, symmetries, what a journal feels at a frequency."""

import math
import pickle
from dataclasses import replace

import numpy as np
import pytest
from scipy.optimize import root

from rotorfilm import FilmContactError, InputError, TiltingPadBearing, coefficients, equilibrium, even_pivots
from rotorfilm.bearings import PadGridFilm, PadMapFilm, ReducedCoefficients
from rotorfilm.bearings.pads.pads_at_rest import WEDGE, directions
from rotorfilm.core import UnloadedPadWarning

SPEED = 300.0

ROWS = {
    "four, load between": (
        (4, 0.7, 75.0, 0.5),
        {"first": 45.0},
        1.0,
        -0.1219,
        (6.536, 6.536),
        (7.590, 7.590),
    ),
    "five, load on": ((5, 0.5, 60.0, 0.3), {"first": 270.0}, 0.6, -0.2623, (1.128, 2.573), (2.118, 3.182)),
    "five, offset": ((5, 0.5, 60.0, 0.0, 0.6), {"first": 90.0}, 0.6, -0.4637, (1.580, 2.251), (1.615, 2.200)),
}
"""Arguments, load / unit, y / c, Kxx Kyy, Cxx Cyy at the frequency of the shaft: a prototype of finite
volumes on 64 x 8 and 128 x 16 cells, extrapolated."""

ONE_PAD = {
    0.5: {
        0.04: (0.098, 0.0237, 0.354),
        0.2: (0.203, 0.081, 0.438),
        0.6: (0.274, 0.673, 4.25),
        0.9: (0.230, 13.0, 233.7),
    },
    0.6: {
        -0.2: (0.942, 0.110, 0.206),
        0.04: (0.813, 0.181, 0.416),
        0.2: (0.721, 0.270, 0.733),
        0.6: (0.465, 1.163, 5.93),
        0.9: (0.245, 15.45, 262.9),
    },
}
"""eta, load and stiffness of one pad of 60 deg, L/D .5, by offset and xi: the same prototype on 64 x 8
cells, whose loads are .3 to .9 % low."""


def units(bearing):
    """Return the units of force and stiffness."""
    force = bearing.force_scale * SPEED
    return force, force / bearing.clearance


@pytest.mark.parametrize("name", ROWS)
def test_bearings_of_another_discretization(tilting, name):
    arguments, further, load, y, K, C = ROWS[name]
    bearing = tilting(*arguments, **further)
    force, stiffness = units(bearing)
    at = equilibrium(bearing, [0.0, -load * force], SPEED)
    np.testing.assert_allclose(at.position / bearing.clearance, [0.0, y], atol=2e-4)
    found = coefficients(bearing, at.position, SPEED)
    assert isinstance(found, ReducedCoefficients)
    assert found.frequency == SPEED
    np.testing.assert_allclose(found.stiffness / stiffness, np.diag(K), atol=1.5e-3 * max(K))
    np.testing.assert_allclose(found.damping * SPEED / stiffness, np.diag(C), atol=1.5e-3 * max(C))


def test_loads_and_tilts_of_five_pads(tilting):
    bearing = tilting(5, 0.5, 60.0, 0.3, first=270.0, cells=(64, 8))
    force, _ = units(bearing)
    at = equilibrium(bearing, [0.0, -0.6 * force], SPEED)
    eta = at.pads.tilts + directions(bearing.pivots)[:, :, 1] @ at.position
    np.testing.assert_allclose(at.pads.pad_loads / force, [0.5387, 0.2036, 0.0399, 0.0399, 0.2036], atol=2e-4)
    np.testing.assert_allclose(eta / 1e-4, [0.2730, 0.2539, 0.1419, 0.1419, 0.2539], atol=4e-4)
    assert at.minimum_film == at.pads.film_thickness.min()


@pytest.mark.parametrize(("offset", "xi"), [(offset, xi) for offset, rows in ONE_PAD.items() for xi in rows])
def test_one_pad_over_its_gap(tilting, offset, xi):
    eta, load, stiffness = ONE_PAD[offset][xi]
    one = tilting(1, 0.5, 60.0, xi, offset, first=0.0, cells=(64, 8))
    force, unit = units(one)
    rest = one.at_rest()
    pads = rest.pad_states([0.0, 0.0], SPEED)
    assert pads.tilts[0] / 1e-4 == pytest.approx(eta, abs=5e-3)
    assert pads.pad_loads[0] / force == pytest.approx(load, rel=0.012)
    assert -rest.jacobian([0.0, 0.0], [0.0, 0.0], SPEED)[0, 0] / unit == pytest.approx(stiffness, rel=0.02)
    # The tilt is that of the gap alone, whatever the speed; turned the other way it is the mirror image.
    other = rest.pad_states([0.0, 0.0], 7.0)
    assert other.tilts[0] == pytest.approx(pads.tilts[0], abs=1e-12 * 1e-4)
    back = replace(one, pivot_offset=1.0 - offset).at_rest().pad_states([0.0, 0.0], -SPEED)
    assert back.tilts[0] == pytest.approx(-pads.tilts[0], abs=1e-6 * 1e-4)
    assert back.pad_loads[0] == pytest.approx(pads.pad_loads[0], rel=1e-6)


def test_rest_is_where_a_search_over_all_tilts_finds_it(tilting):
    """Position and tilts as unknowns of one system over the film itself (scipy's hybrid method)."""
    bearing = tilting(5, 0.5, 60.0, 0.3, 0.55, first=270.0)
    force, _ = units(bearing)
    load = force * np.array([0.1, -0.6])
    film, Q, N = bearing.film.kernel(bearing.extent, bearing.slenderness), directions(bearing.pivots), 5
    turn = 0.05 * bearing.extent
    R = np.array([[math.cos(turn), -math.sin(turn)], [math.sin(turn), math.cos(turn)]])

    def lacking(unknown):
        r, q = unknown[:2], unknown[2:]
        e = np.einsum("kij,i->jk", Q, r) + np.stack([np.full(N, 0.3), q])
        f = R.T @ film.force(R @ e, R @ (0.5 * WEDGE @ e)).values
        return np.concatenate([np.einsum("kij,jk->i", Q, f) + load / force, f[1]])

    at = equilibrium(bearing, load, SPEED)
    # From somewhere near: far from it that search leaves the film.
    near = np.concatenate([at.position, at.pads.tilts]) / 1e-4 + 0.02 * np.random.default_rng(3).normal(
        size=2 + N
    )
    found = root(lacking, near, tol=1e-13)
    assert np.abs(found.fun).max() < 1e-9
    np.testing.assert_allclose(at.position / 1e-4, found.x[:2], atol=1e-8)
    np.testing.assert_allclose(at.pads.tilts / 1e-4, found.x[2:], atol=1e-8)


def test_center_feels_no_direction(tilting):
    for offset in (0.5, 0.6):
        bearing = tilting(3, 0.5, 100.0, 0.4, offset)
        for frequency in (0.0, 0.5 * SPEED, SPEED):
            found = coefficients(bearing, [0.0, 0.0], SPEED, frequency)
            for matrix in (found.stiffness, found.damping):
                np.testing.assert_allclose(matrix, matrix[0, 0] * np.eye(2), atol=1e-9 * abs(matrix[0, 0]))


@pytest.mark.parametrize(("offset", "first"), [(0.5, 270.0), (0.65, 270.0), (0.65, 90.0)])
def test_no_shift_across_an_axis_of_symmetry(tilting, offset, first):
    bearing = tilting(5, 0.5, 60.0, 0.4, offset, first=first, cells=(32, 4))
    at = equilibrium(bearing, [0.0, -0.3 * units(bearing)[0]], SPEED)
    assert abs(at.position[0]) < 1e-9 * abs(at.position[1])


def test_slow_motion_is_the_slope_of_the_force_at_rest(smooth):
    bearing, place, step = smooth(), np.array([3e-6, -5e-6]), 1e-10
    rest = bearing.at_rest()
    moved = [
        [rest.force(place + sign * step * along, [0.0, 0.0], SPEED) for sign in (1.0, -1.0)]
        for along in np.eye(2)
    ]
    slope = -np.array([(plus - minus) / (2.0 * step) for plus, minus in moved]).T
    found = coefficients(bearing, place, SPEED, 0.0)
    np.testing.assert_allclose(found.stiffness, slope, rtol=1e-6, atol=1e-6 * slope.max())
    # Damping of slow motion: the limit of that at low frequencies.
    low = coefficients(bearing, place, SPEED, 1e-4 * SPEED)
    np.testing.assert_allclose(low.damping, found.damping, rtol=1e-6, atol=1e-6 * found.damping.max())


@pytest.mark.parametrize(
    "further",
    [
        {},
        {"pad_inertia": 3e-4},
        {"pivot_stiffness": 6e8},
        {"pivot_stiffness": 6e8, "pad_inertia": 3e-4, "pad_mass": 0.2},
    ],
    ids=["massless", "inertia", "springs", "springs and inertia"],
)
def test_whole_matrices_reduce_to_the_assembly_of_single_pads(smooth, further):
    """Lund (1964): sum of z_r n n^T, z_r = z_nn - z_nt z_tn/(z_tt + m s^2); springs are in series with it."""
    bearing, place = smooth(**further), np.array([3e-6, -5e-6])
    whole = bearing.at_rest().matrices(place, SPEED)
    N, Q = 3, directions(bearing.pivots)
    k_p, m_p, m_r = bearing.pivot_stiffness, bearing.reduced_inertia, bearing.pad_mass or 0.0
    for s in (1j * SPEED, complex(-20.0, 0.4 * SPEED)):
        Z = np.zeros((2, 2), dtype=complex)
        for k in range(N):
            own = Q[k].T
            film = single_pad(bearing, place, k)
            z = film[0] + s * film[1]
            if k_p is None:
                reduced = z - np.outer(z[:, 1], z[1]) / (z[1, 1] + m_p * s * s)
            else:
                reduced = z - z @ np.linalg.inv(z + np.diag([k_p + m_r * s * s, m_p * s * s])) @ z
            Z += own.T @ reduced @ own
        found = whole.reduced(s.imag, s.real)
        assert found.growth_rate == s.real
        np.testing.assert_allclose(found.stiffness + s * found.damping, Z, atol=1e-12 * abs(Z).max())


def single_pad(bearing, place, k):
    """Return K and C of the film of one pad in its own axes."""
    alone = replace(bearing, pivots=(bearing.pivots[k],), start=())
    whole, n = alone.at_rest().matrices(place, SPEED), directions(alone.pivots)[0]
    return [n.T @ matrix[:2, :2] @ n for matrix in (whole.stiffness, whole.damping)]


def test_modes_are_where_rotor_and_reduced_pads_have_no_stiffness_left(smooth):
    bearing, place, mass = smooth(), np.array([3e-6, -5e-6]), 50.0
    whole = bearing.at_rest().matrices(place, SPEED)
    for exponent in whole.modes(mass):
        if abs(exponent.imag) > 1.0:
            felt = whole.reduced(exponent.imag, exponent.real)
            left = felt.stiffness + exponent * felt.damping + mass * exponent**2 * np.eye(2)
            assert abs(np.linalg.det(left)) < 1e-9 * abs(mass * exponent**2) ** 2


def test_light_pad_loses_its_damping_in_slow_motion(tilting):
    """C_r of one pad of 60 deg at xi .01, at 0, .3, .5 and 1 of the speed, by a prototype on 64 x 8 cells."""
    one = tilting(1, 0.5, 60.0, 0.01, first=0.0, cells=(64, 8))
    _, unit = units(one)
    found = [
        coefficients(one, [0.0, 0.0], SPEED, nu * SPEED).damping[0, 0] * SPEED / unit
        for nu in (0.0, 0.3, 0.5, 1.0)
    ]
    np.testing.assert_allclose(found, [-2.5, -0.47, 0.04, 0.33], atol=0.05, rtol=0.05)


def test_unloaded_pads_are_flagged_and_said(tilting):
    """ROSS's fixture of five pads (tilt_5pad_isoviscous.json), on 20 x 10 elements: within 3.5 % of it."""
    bearing = TiltingPadBearing(
        diameter=0.4,
        length=0.263144,
        viscosity=0.0190157,
        pivots=even_pivots(5),
        extent=math.pi / 3.0,
        preload=0.3,
        assembled_clearance=194.564e-6,
        film=PadGridFilm(cells=(64, 8)),
    )
    with pytest.warns(UnloadedPadWarning, match=r"pads 3, 4 \(pivots at 54, 126 deg\) are unloaded"):
        at = equilibrium(bearing, [0.0, -112815.0], "900 rpm")
    assert at.pads.unloaded.tolist() == [False, False, True, True, False]
    # Without film at the very end of the neutral tilts: eta = -|xi| tan b.
    xi = directions(bearing.pivots)[2, :, 0] @ at.position + 0.3 * bearing.clearance
    eta = directions(bearing.pivots)[2, :, 1] @ at.position + at.pads.tilts[2]
    assert eta == pytest.approx(-abs(xi) * math.tan(math.pi / 6.0), rel=1e-9)
    K, C = (getattr(coefficients(bearing, at.position, at.speed), name) for name in ("stiffness", "damping"))
    found = [at.position[1] / bearing.bore_clearance, K[0, 0], K[1, 1], C[0, 0], C[1, 1]]
    np.testing.assert_allclose(found, [-0.618, 3.22e8, 2.571e9, 5.415e6, 1.939e7], rtol=0.035)
    np.testing.assert_allclose(found, [-0.6197, 3.31e8, 2.657e9, 5.39e6, 1.951e7], rtol=0.008)


def test_springs_of_pivots_are_in_series_with_the_film(smooth):
    soft, hard = smooth(pivot_stiffness=6e8), smooth()
    place = np.array([2e-6, -4e-6])
    pads = soft.at_rest().pad_states(place, SPEED)
    np.testing.assert_allclose(pads.pivot_deflections, -pads.pad_loads / 6e8, rtol=1e-9)
    # A pad on a spring is a rigid one under a journal that is as much nearer.
    n = directions(soft.pivots)[1, :, 0]
    moved = hard.at_rest().pad_states(place + n * pads.pivot_deflections[1], SPEED)
    assert moved.pad_loads[1] == pytest.approx(pads.pad_loads[1], rel=1e-9)
    stiff = coefficients(smooth(pivot_stiffness=1e16), place, SPEED)
    rigid = coefficients(hard, place, SPEED)
    np.testing.assert_allclose(stiff.stiffness, rigid.stiffness, rtol=1e-6)


def test_map_has_the_film_of_the_grid_and_goes_along(tilting, monkeypatch, tmp_path):
    bearing = tilting(5, 0.5, 60.0, 0.3, first=270.0, cells=(96, 8))
    mapped = replace(bearing, film=PadMapFilm())
    load = [0.0, -0.6 * units(bearing)[0]]
    at, over = (equilibrium(one, load, SPEED) for one in (bearing, mapped))
    np.testing.assert_allclose(over.position, at.position, atol=1e-4 * 1e-4)
    K, C = coefficients(bearing, at.position, SPEED), coefficients(mapped, over.position, SPEED)
    for name in ("stiffness", "damping"):
        most = getattr(K, name).max()
        np.testing.assert_allclose(getattr(C, name), getattr(K, name), atol=1e-3 * most)
    # What is carried along finds its map without the disk.
    carried = mapped.portable()
    monkeypatch.setenv("ROTORFILM_CACHE", str(tmp_path))
    np.testing.assert_array_equal(equilibrium(carried, load, SPEED).position, over.position)
    assert not list(tmp_path.iterdir())


def test_clearances_of_pad_and_assembly_are_one_bearing(tilting):
    one = tilting(4, 0.7, 75.0, 0.4)
    other = tilting(4, 0.7, 75.0, 0.4, pad_clearance=None, assembled_clearance=0.6e-4)
    assert other.clearance == pytest.approx(one.clearance, rel=1e-15)
    assert one.bore_clearance == pytest.approx(0.6e-4, rel=1e-15)


def test_contact_names_the_pad(tilting):
    bearing = tilting(4, 0.7, 75.0, 0.5, first=45.0)
    with pytest.raises(FilmContactError, match=r"pad 3 \(pivot at 225 deg\)"):
        bearing.at_rest().force([-0.4e-4, -0.4e-4], [0.0, 0.0], SPEED)
    # Between the pivots there is room beyond the assembled clearance.
    assert np.isfinite(bearing.at_rest().force([0.0, -0.6e-4], [0.0, 0.0], SPEED)).all()


@pytest.mark.parametrize(
    ("change", "message"),
    [
        ({"preload": 1.0}, "preload must be below 1"),
        ({"assembled_clearance": 1e-4}, "and not both"),
        ({"pad_clearance": None}, "and not both"),
        ({"extent": 3.2}, "extent must be below pi"),
        ({"pivots": (0.0, 1.0)}, "at least the extent"),
        ({"pivot_offset": 1.0}, "pivot_offset must be within 0 and 1"),
        ({"pad_mass": 1.0}, "pad_mass must be given"),
        ({"start": (0.0, 0.0)}, "start must hold no or 4 numbers"),
        ({"viscosity": -1.0}, "viscosity must be finite and positive"),
    ],
)
def test_what_breaks_a_rule_is_named(tilting, change, message):
    with pytest.raises(InputError, match=message):
        replace(tilting(4, 0.7, 75.0, 0.5), **change)


@pytest.mark.filterwarnings("ignore::rotorfilm.core.errors.ValidityWarning")
def test_a_journal_that_one_pad_carries_rests_on_its_axis():
    """Nothing holds it across: the other two pads have no film, and of all places it takes the nearest."""
    bearing = TiltingPadBearing(
        radius=0.045,
        length=0.037,
        assembled_clearance=6e-5,
        viscosity=0.048,
        pivots=even_pivots(3),
        extent=1.75,
        pivot_offset=0.572,
        preload=0.009,
        film=PadGridFilm(cells=(48, 4)),
    )
    at = equilibrium(bearing, (0.0, -9400.0), 280.0)
    assert at.pads.unloaded.tolist() == [False, True, True]
    assert at.pads.pad_loads[0] == pytest.approx(9400.0, rel=1e-9)
    assert abs(at.position[0]) < 1e-12 * 6e-5


def test_a_bearing_that_was_asked_is_pickled_with_its_equilibrium(tilting):
    """As to the workers of a sweep."""
    bearing = tilting(4, 0.5, 75.0, 0.2, cells=(16, 4))
    at = equilibrium(bearing, [0.0, -0.1 * bearing.force_scale * SPEED], SPEED)
    twin, same = pickle.loads(pickle.dumps((bearing, at)))
    assert twin == bearing
    assert same.position == pytest.approx(at.position, rel=0.0, abs=0.0)
    assert twin.force(at.position, [0.0, 0.0], SPEED) == pytest.approx(
        bearing.force(at.position, [0.0, 0.0], SPEED)
    )
