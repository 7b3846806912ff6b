"""Tables of thrust films against the films that they were made from, and against their own differences."""

import math
from dataclasses import replace

import numpy as np
import pytest
from scipy.integrate import solve_ivp

import rotorfilm as rf
from rotorfilm.bearings import ThrustBearing, TiltingThrustBearing
from rotorfilm.bearings.thrust.film_tables import FILMS, ThrustFilmTable, film_table
from rotorfilm.core.dynamic_stiffness import small_motion

NONE, STILL = np.zeros(0), np.zeros(3)
FIXED = ThrustBearing(
    inner_radius=0.5,
    outer_radius=1.0,
    pads=8,
    pad_arc=math.radians(40.0),
    viscosity=0.7,
    taper_depth=1.0,
    cells=(16, 8),
    extrapolated=False,
)
FREE = TiltingThrustBearing(
    inner_radius=0.5, outer_radius=1.0, pads=4, pad_arc=math.radians(45.0), viscosity=0.7, cells=(16, 8)
)
FAST, QUICK = replace(FIXED, tabulated=True), replace(FREE, tabulated=True)


def both(bearing, x, u):
    found = bearing.answer(x, u, differentiated=False)
    return np.append(found.rates, found.wrench)


@pytest.mark.parametrize("bearing", [FAST, replace(FAST, side=-1, gap=0.8), QUICK])
def test_slopes_are_those_of_the_table(bearing):
    u = np.array([0.4 * bearing.side - bearing.gap * bearing.side, 0.03, -0.02, 0.02, 0.03, -0.01, 1.0])
    x = bearing.states_at_rest(np.array([*u[:3], 0, 0, 0, 1.0])) * 1.05 if bearing.states else NONE
    exact = np.block([[*bearing.linearization(0.0, x, u)[:2]], [*bearing.linearization(0.0, x, u)[2:]]])
    step, columns = 1e-6, []
    for k in range(len(x) + 7):
        way = step * np.eye(len(x) + 7)[k]
        ends = [both(bearing, x + s * way[: len(x)], u + s * way[len(x) :]) for s in (1, -1)]
        columns.append((ends[0] - ends[1]) / (2.0 * step))
    assert np.abs(np.transpose(columns) - exact).max() <= 1e-7 * np.abs(exact).max()


def test_force_of_fixed_pads_is_that_of_the_film():
    """At the aligned collar, to twice the taper, at rates to a fifth of film and speed."""
    random, errors, shear = np.random.default_rng(5), [], []
    films = np.exp(random.uniform(np.log(FILMS[0]), np.log(2.0), 150))
    for film, rate in zip(films, random.uniform(-0.2, 0.2, 150), strict=True):
        speed = random.choice([1.0, 30.0])
        u = np.array([film, 0.0, 0.0, rate * film * speed, 0.0, 0.0, speed])
        wedge = FIXED.answer(NONE, u * [1, 1, 1, 0, 1, 1, 1], differentiated=False).wrench[0]
        known, found = (one.answer(NONE, u, differentiated=False).wrench for one in (FIXED, FAST))
        errors.append(abs(found[0] - known[0]) / max(known[0], wedge))
        shear.append(found[3] / known[3] - 1.0)
    median, most, nearly_all = np.percentile(errors, [50, 90, 99])
    assert (median < 1e-6, most < 1e-5, nearly_all < 1e-4) == (True, True, True)
    assert np.abs(shear).max() < 0.015  # that of this coarse grid, whose shear is a sum over its cells


@pytest.mark.long
def test_extrapolated_pads_are_those_of_both_grids_also_where_half_the_cells_spread_otherwise():
    known = replace(FIXED, cells=(16, 16), extrapolated=True)
    found = replace(known, tabulated=True)
    for film in (0.06, 0.3, 1.0):
        for rate, speed in ((0.0, 1.0), (-0.1, 1.0), (-1.0, 0.0)):
            at = [film, 0.0, 0.0], [rate * film, 0.0, 0.0], speed
            assert found.force(*at)[0] == pytest.approx(known.force(*at)[0], rel=1e-6)
        closing = [film, 0.0, 0.0], [-3.0 * film, 0.0, 0.0], 1.0
        assert found.force(*closing)[0] == pytest.approx(known.force(*closing)[0], rel=0.01)


@pytest.mark.parametrize(
    ("tilt", "force", "moment"), [(0.1, 6e-4, 0.015), (0.2, 4e-3, 0.06), (0.29, 0.02, 0.12)]
)
def test_tilts_are_of_second_order(tilt, force, moment):
    for angle in np.linspace(0.0, 2.0 * math.pi, 5, endpoint=False):
        place = [0.3, 0.3 * tilt * math.cos(angle), 0.3 * tilt * math.sin(angle)]
        known, found = (one.force(place, STILL, 1.0) for one in (FIXED, FAST))
        assert found[0] == pytest.approx(known[0], rel=force)
        assert np.hypot(*(found - known)[1:]) < moment * np.hypot(*known[1:])


def test_moments_have_the_exact_slopes_at_the_aligned_collar():
    at = [0.3, 0.0, 0.0]
    known, found = (one.jacobian(at, STILL, 1.0) for one in (FIXED, FAST))
    np.testing.assert_allclose(found, known, atol=2e-4 * np.abs(known).max())


def test_beyond_the_table_the_film_itself_answers():
    for place in ([6.0, 0.0, 0.0], [0.02, 0.0, 0.0], [0.3, 0.1, 0.0]):
        np.testing.assert_array_equal(FAST.force(place, STILL, 1.0), FIXED.force(place, STILL, 1.0))
    with pytest.raises(rf.FilmContactError):
        FAST.force([0.3, 0.4, 0.0], STILL, 1.0)
    opening = [1.0, 0.0, 0.0, 3.0, 0.0, 0.0, 1.0]
    x = FREE.rest_state([1.0, 0.0, 0.0], 1.0)
    np.testing.assert_array_equal(QUICK.output(0.0, x, opening), FREE.output(0.0, x, opening))


@pytest.mark.parametrize(
    ("rates", "speed"),
    [
        ([0.0, 1.0, 0.0], 1.0),  # a tilt rate beside a slow wedge
        ([0.0, 0.3, 0.0], 0.0),
        ([0.1, 0.1, 0.2], 0.1),
        ([1.0, 0.0, 0.0], 0.3),  # pads that open, or turn the other way, rupture
        ([0.0, 0.0, 0.0], -1.0),
        ([0.0, 0.01, 0.02], -1.0),
        ([-1.0, 0.0, 0.0], -1.0),
        ([0.3, 0.0, 0.0], 1.0),
    ],
)
def test_where_the_second_order_fails_the_film_itself_answers(rates, speed):
    at = [1.0, 0.03, 0.0], rates, speed
    np.testing.assert_array_equal(FAST.force(*at), FIXED.force(*at))
    if speed > 0.0:
        np.testing.assert_array_equal(FAST.jacobian(*at), FIXED.jacobian(*at))


def test_forces_at_random_tilt_rates_are_those_of_the_film():
    """In the table and beside it, over the largest rates of a vibrating collar; and the table does answer."""
    random, errors = np.random.default_rng(8), []
    for _ in range(60):
        film = math.exp(random.uniform(math.log(0.1), math.log(3.0)))
        rates = film * random.normal(0.0, 0.1 ** random.uniform(0.0, 3.0), 3)
        at = [film, 0.0, 0.0], rates, 1.0
        known, found = (one.force(*at) for one in (FIXED, FAST))
        errors.append(np.abs(found - known).max() / np.abs(known).max())
    assert max(errors) < 0.05
    assert np.count_nonzero(errors) > 20


def test_pads_that_tilt_are_those_of_the_film():
    """Also in their torque and in their rates, at random tilts and rates."""
    random, rest = np.random.default_rng(6), FREE.rest_state([1.0, 0.0, 0.0], 1.0)
    for _ in range(10):
        u = np.append(random.normal([1.0, 0, 0, 0, 0, 0], [0.1, 0.05, 0.05, 0.1, 0.1, 0.1]), 1.0)
        x = rest * random.normal(1.0, 0.1, len(rest))
        known, found = (both(one, x, u) for one in (FREE, QUICK))
        np.testing.assert_allclose(found, known, atol=1e-5 * np.abs(known).max())


def test_tilts_in_time_are_those_of_the_schur_complement():
    nu, swing, calls = 0.5, 1e-3, [0]

    def input_at(t):
        calls[0] += 1
        return [1.0 + swing * math.sin(nu * t), 0.0, 0.0, swing * nu * math.cos(nu * t), 0.0, 0.0, 1.0]

    end = 4.0 * math.pi / nu
    times = np.linspace(0.5 * end, end, 40, endpoint=False)
    run = solve_ivp(
        lambda t, x: QUICK.derivative(t, x, input_at(t)),
        (0.0, end),
        QUICK.rest_state([1.0, 0.0, 0.0], 1.0),
        t_eval=times,
        rtol=1e-6,
        atol=1e-9,
    )
    force = np.array([QUICK.output(t, x, input_at(t))[0] for t, x in zip(times, run.y.T, strict=True)])
    harmonic = 2.0 * np.mean(force * np.exp(-1j * nu * times)) / (-1j * swing)
    wanted = small_motion(FREE, [1.0, 0.0, 0.0], 1.0)(1j * nu)[0][0, 0]
    assert -harmonic == pytest.approx(wanted, rel=1e-4)
    assert calls[0] < 400


def test_it_is_kept_on_disk_and_holds_for_any_oil_speed_and_place():
    table = film_table(FAST)
    assert film_table(replace(FAST, viscosity=0.02, gap=0.3, side=-1, start=0.2)) is not None
    assert ThrustFilmTable.from_bytes(table.to_bytes()) == table


@pytest.mark.parametrize(
    ("bearing", "change", "message"),
    [
        (FIXED, {"taper_depth": 0.0}, r"tabulated must be False for plane pads.* got True with a depth of 0"),
        (FIXED, {"pads": 2}, "tabulated must be False for fewer than 3 pads"),
        (FIXED, {"extrapolated": True}, r"cells must be 16 at least .* got \(16, 8\)"),
        (FREE, {"crown": 0.1}, "tabulated must be False for tilting pads with a crown"),
        (FREE, {"tabulated": 1}, "tabulated must be True or False"),
    ],
)
def test_pads_without_a_table_say_so(bearing, change, message):
    with pytest.raises(rf.InputError, match=message):
        replace(bearing, **{"tabulated": True, **change})
