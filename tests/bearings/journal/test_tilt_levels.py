"""Levels of a tilted journal: closed forms, the film over the whole length, symmetries, refusals."""

import math
from dataclasses import replace

import numpy as np
import pytest
from numpy.testing import assert_allclose

import rotorfilm as rf
from rotorfilm import FilmContactError, InputError, UndefinedDerivativeError
from rotorfilm.bearings import ExtrapolatedFilm, PadGridFilm, mobility_of
from rotorfilm.bearings.journal import MomentCarryingJournal, TiltLevel, tilt_map
from rotorfilm.bearings.journal.moment_carrying_journal import moment_share

TURN = np.kron(np.eye(2), [[0.0, 1.0], [-1.0, 0.0]])
SIZE = {"radius": 0.05, "length": 0.1, "clearance": 1e-4, "viscosity": 0.02}
PLAIN = rf.JournalBearing(**SIZE)
GRID = rf.JournalBearing(**SIZE, film=rf.ReynoldsFilm(cells=(48, 4)))
GROOVED = replace(PLAIN, grooves=(rf.Groove(center=0.4, width=0.3),), film=rf.ReynoldsFilm(cells=(48, 4)))
LOBED = rf.LobedBearing(
    radius=0.05,
    length=0.05,
    pad_clearance=1e-4,
    viscosity=0.02,
    lobes=rf.lobe_set("elliptical"),
    film=PadGridFilm(cells=(32, 4)),
)
DAM = rf.PressureDamBearing(
    diameter="100 mm",
    length="50 mm",
    pad_clearance="100 um",
    viscosity=0.02,
    pads=rf.pressure_dam_pads(depth="61 um", end="145 deg", share=0.75),
    cells=(16, 8),
)
AT = np.array([2e-5, -4e-5, 2e-4, 1e-4])
RATE = np.array([2e-3, 4e-3, 2e-2, -4e-2])


@pytest.fixture(scope="module")
def table():
    """Return a map of tilts of L/D 1 from films on few cells."""
    return tilt_map.TiltMap(1.0, (96, 8)).built()


@pytest.fixture(scope="module")
def second(table):
    """Return the journal of second order on that map."""
    return MomentCarryingJournal(bearing=PLAIN, level=TiltLevel.SECOND_ORDER, tilt_map=table)


def closed(bearing=PLAIN):
    """Return the journal in closed form."""
    return MomentCarryingJournal(bearing=bearing, level=TiltLevel.CLOSED_FORM)


def differences(held, at=AT, rate=RATE, speed=300.0):
    """Return the derivatives of force and moment by central differences, (4, 9)."""
    state = np.array([*at, *rate, speed])
    steps = 1e-6 * np.array([1e-4, 1e-4, 1e-3, 1e-3, 3e-2, 3e-2, 0.3, 0.3, 300.0])
    columns = []
    for k, step in enumerate(steps):
        more, less = (state + sign * step * np.eye(9)[k] for sign in (1.0, -1.0))
        forces = [held.force(one[:4], one[4:8], one[8]) for one in (more, less)]
        columns.append((forces[0] - forces[1]) / (2.0 * step))
    return np.array(columns).T


def steady(film, tau, chi):
    """Return force and moment of a film over the whole length at rest, in the film's units."""
    place = np.array([0.0, -chi, *tau])
    return film.wrench(place, np.append(0.5 * TURN @ place, 0.5), differentiated=False)[0]


@pytest.mark.long
def test_second_order_is_close_to_the_full_film_at_small_tilts(table):
    """The tilt takes 0.2 and 0.4 of the aligned film: force within 0.2 and 1 %, moment 3 and 12 %."""
    film, kernel = tilt_map.whole_film(1.0, (96, 8)), tilt_map.TiltMapKernel(table)
    worst = {}
    for share in (0.2, 0.4):
        for chi in (0.3, 0.6, 0.8):
            aligned = steady(film, (0.0, 0.0), chi)[:2]
            for turn in 2.0 * np.pi * np.arange(8) / 8.0:
                tau = share * (1.0 - chi) * np.array([math.cos(turn), math.sin(turn)])
                exact, place = steady(film, tau, chi), np.array([0.0, -chi, *tau])
                more = kernel.wrench(place, 0.5 * TURN @ place)[0]
                found = np.append(aligned, [0.0, 0.0]) + more
                errors = [np.hypot(*(found - exact)[k]) / np.hypot(*exact[k]) for k in (np.s_[:2], np.s_[2:])]
                worst[share] = np.maximum(worst.get(share, 0.0), errors)
    assert np.all(worst[0.2] < (0.002, 0.035))
    assert np.all(worst[0.4] < (0.01, 0.13))
    assert worst[0.4][1] > 0.05  # more than the second order would be another map


@pytest.mark.parametrize("held", [closed(), closed(GROOVED), closed(LOBED), closed(DAM)])
def test_closed_form_is_differentiated_exactly(held):
    slopes = held.jacobian(AT, RATE, 300.0)
    sizes = np.where(np.arange(4)[:, None] < 2, 1.0, held.arm) * np.abs(slopes[:2]).max(axis=0)
    planar = [0, 1, 4, 5, 8]
    assert_allclose(slopes[:2, planar], held.bearing.jacobian(AT[:2], RATE[:2], 300.0), rtol=1e-13)
    assert not slopes[:2, [2, 3, 6, 7]].any()
    close = 1e-7 if held.bearing is PLAIN else 2e-2  # lines of the grid jump with the journal
    found = differences(held)
    sizes = np.maximum(np.abs(slopes).max(axis=0), 1e-30)
    assert_allclose(found[2:] / sizes, slopes[2:] / sizes, atol=close)


def test_closed_form_of_a_short_bearing_is_that_of_its_film():
    """T_w = F_w/15 and T_tau = 2 F_e/15 of a short full film; g of centered films by the notes."""
    assert [round(moment_share(ratio), 4) for ratio in (0.25, 0.5, 1.0)] == [0.0679, 0.0716, 0.0851]
    assert moment_share(0.0501) == pytest.approx(moment_share(0.0499), rel=1e-4)
    assert moment_share(1e4) == pytest.approx(1.0 / 3.0, rel=1e-3)
    short = rf.JournalBearing(**SIZE | {"length": 1e-3}, film=rf.ShortFilm())
    held, tilt = closed(short), np.array([*AT[:2], 1e-2, 2e-2])
    still, speed = np.zeros(4), 300.0
    end = held.arm * np.array([tilt[3], -tilt[2]])
    slopes = short.jacobian(AT[:2], still[:2], speed)
    fixed_w = slopes[:, :2] - 0.5 * speed * slopes[:, 2:4] @ TURN[:2, :2]
    T = (2.0 * fixed_w @ end + 0.5 * speed * slopes[:, 2:4] @ TURN[:2, :2] @ end) / 15.0
    assert_allclose(held.force(tilt, still, speed)[2:], held.arm * np.array([-T[1], T[0]]), rtol=1e-4)


@pytest.mark.parametrize("level", [TiltLevel.NONE, TiltLevel.CLOSED_FORM, TiltLevel.SECOND_ORDER])
def test_a_straight_shaft_feels_the_aligned_film(level, second):
    held = replace(second, level=level, tilt_map=second.tilt_map if level is TiltLevel.SECOND_ORDER else None)
    place, rate = np.array([*AT[:2], 0.0, 0.0]), np.array([*RATE[:2], 0.0, 0.0])
    force = PLAIN.force(AT[:2], RATE[:2], 300.0)
    assert_allclose(held.force(place, rate, 300.0), [*force, 0.0, 0.0], rtol=1e-14, atol=1e-12)
    slopes = held.jacobian(place, rate, 300.0)
    assert_allclose(slopes[:2, [0, 1, 4, 5, 8]], PLAIN.jacobian(AT[:2], RATE[:2], 300.0), rtol=1e-13)
    assert_allclose(slopes[2:, [0, 1, 4, 5, 8]], 0.0, atol=1e-9)


def test_second_order_has_exact_derivatives_and_a_symmetric_damping(second):
    slopes = second.jacobian(AT, RATE, 300.0)
    assert_allclose(
        differences(second) / np.abs(slopes).max(axis=0), slopes / np.abs(slopes).max(axis=0), atol=1e-7
    )
    damping = -slopes[:, 4:8]
    assert_allclose(damping, damping.T, atol=1e-13 * np.abs(damping).max())
    center = second.jacobian([1e-12, 0.0, 1e-4, 0.0], RATE, 300.0)
    beside = second.jacobian([0.0, 1e-12, 1e-4, 0.0], RATE, 300.0)
    size = np.abs(center).max(axis=0)
    assert_allclose(center / size, beside / size, atol=1e-4)


def test_second_order_obeys_mirror_and_turn(second):
    """A mirror at y = 0, which turns the rotation around, and a turn of everything by an angle."""
    force = second.force(AT, RATE, 300.0)
    mirror = np.array([1.0, -1.0, -1.0, 1.0])
    assert_allclose(second.force(mirror * AT, mirror * RATE, -300.0), mirror * force, rtol=1e-12)
    odd = np.array([1.0, 1.0, -1.0, -1.0])
    assert_allclose(second.force(odd * AT, odd * RATE, 300.0), odd * force, rtol=1e-13)
    c, s = math.cos(0.7), math.sin(0.7)
    turn = np.kron(np.eye(2), [[c, -s], [s, c]])
    assert_allclose(second.force(turn @ AT, turn @ RATE, 300.0), turn @ force, rtol=1e-11)


def test_power_of_the_second_order_is_that_of_its_potential(second):
    """J = G.w/2 is of degree two in the sources, so G is of degree one in rates and speed together."""
    force = second.force(AT, RATE, 300.0)
    assert_allclose(second.force(AT, 3.0 * RATE, 900.0), 3.0 * force, rtol=1e-12)
    scale = second._scales
    source = scale @ RATE + 150.0 * TURN @ scale @ AT
    slopes = second.jacobian(AT, RATE, 300.0)[:, 4:8] @ np.linalg.inv(scale)
    assert_allclose(slopes @ source, force, rtol=1e-11)  # Euler: G = G_w w


def test_a_map_is_kept_and_carried(second, table, tmp_path):
    table.save(tmp_path / "map.bin")
    again = tilt_map.TiltMapTable.load(tmp_path / "map.bin")
    held = replace(second, tilt_map=again)
    assert_allclose(held.force(AT, RATE, 300.0), second.force(AT, RATE, 300.0), rtol=1e-15)
    assert second.portable().tilt_map == table
    with pytest.raises(InputError, match="tilt_map must be of length/diameter"):
        replace(second, bearing=replace(PLAIN, length=0.05))


def test_lobes_without_tilt_are_the_lobes():
    held = MomentCarryingJournal(bearing=LOBED)
    force, slopes = LOBED.force(AT[:2], RATE[:2], 300.0), LOBED.jacobian(AT[:2], RATE[:2], 300.0)
    straight, still = np.array([*AT[:2], 0.0, 0.0]), np.array([*RATE[:2], 0.0, 0.0])
    assert_allclose(held.force(straight, still, 300.0), [*force, 0.0, 0.0], atol=1e-10 * np.abs(force).max())
    found = held.jacobian(straight, still, 300.0)
    assert_allclose(found[:2, [0, 1, 4, 5, 8]], slopes, rtol=1e-9, atol=1e-9 * np.abs(slopes).max())
    damping = -held.jacobian(AT, RATE, 300.0)[:, 4:8]
    assert_allclose(damping, damping.T, atol=1e-12 * np.abs(damping).max())
    ends = [LOBED.minimum_film(AT[:2] + sign * held.arm * np.array([AT[3], -AT[2]])) for sign in (1.0, -1.0)]
    assert held.minimum_film(AT) == pytest.approx(min(ends), rel=1e-12)
    assert closed(LOBED).minimum_film(AT) == pytest.approx(min(ends), rel=1e-12)


def test_a_bush_has_a_place_and_a_tilt_of_its_own():
    """A misaligned bush feels a shaft in line as an aligned one feels a shaft that is moved the other way."""
    straight = MomentCarryingJournal(bearing=GRID)
    moved = replace(straight, bush_offset=(1e-5, -2e-4), bush_tilt=(1e-4, -2e-4))
    assert_allclose(moved.force(AT + moved.bush, RATE, 300.0), straight.force(AT, RATE, 300.0), rtol=1e-9)
    assert moved.minimum_film(AT + moved.bush) == pytest.approx(straight.minimum_film(AT))
    rest = rf.equilibrium(moved, [0.0, -8e3, 0.0, 0.0], 300.0)
    other = rf.equilibrium(straight, [0.0, -8e3, 0.0, 0.0], 300.0)
    assert_allclose(rest.position - moved.bush, other.position, atol=1e-9)
    assert moved.clearance == pytest.approx(1e-4 + math.hypot(1e-5, 2e-4))


def test_a_crown_and_a_profile_widen_the_gap():
    held = MomentCarryingJournal(bearing=GRID, crown=1e-5)
    assert held.minimum_film([5e-5, 0.0, 0.0, 0.0]) == pytest.approx(5e-5)
    assert held.minimum_film([5e-5, 0.0, 0.0, 8e-4]) > MomentCarryingJournal(bearing=GRID).minimum_film(
        [5e-5, 0.0, 0.0, 8e-4]
    )
    Z = np.linspace(-1.0, 1.0, 201)
    told = replace(held, crown=0.0, profile=tuple(1e-5 * Z**2))
    assert_allclose(told.force(AT, RATE, 300.0), held.force(AT, RATE, 300.0), rtol=1e-4)
    aligned = MomentCarryingJournal(bearing=GRID).force(AT, RATE, 300.0)
    assert np.abs(held.force(AT, RATE, 300.0)[:2]).max() < np.abs(aligned[:2]).max()


def test_estimates_hold_within_a_factor_of_two(second):
    """Nine of ten forces and 17 of 20 moments: eccentricity 0.1 to 0.85, 0.1 to 0.6 of the film taken.

    So does the force of second order, where its error is above that of the coarse films of this map.
    """
    rng, film = np.random.default_rng(7), tilt_map.whole_film(1.0, (96, 8))
    kernel = tilt_map.TiltMapKernel(second.tilt_map)
    ratios, centered, seen = [], [], []
    for _ in range(100):
        chi, share, way, angle = rng.uniform([0.1, 0.1, 0.0, 0.0], [0.85, 0.6, 6.3, 6.3])
        e = chi * np.array([math.cos(way), math.sin(way)])
        place = np.array([*e, *(share * (1.0 - chi) * np.array([math.cos(angle), math.sin(angle)]))])
        drive, straight = np.append(0.5 * TURN @ place, 0.5), np.array([*e, 0.0, 0.0])
        exact = film.wrench(place, drive, differentiated=False)[0]
        aligned = film.wrench(straight, np.append(0.5 * TURN @ straight, 0.5), differentiated=False)[0]
        more = kernel.wrench(place, drive[:4])[0]
        told = second.estimate(np.linalg.solve(second._scales, place), 1.0)
        errors = (
            (np.hypot(*(aligned - exact)[:2]) / np.hypot(*exact[:2]), told.correction),
            (np.hypot(*(more - exact)[2:]) / np.hypot(*exact[2:]), told.moment_error),
            (np.hypot(*(aligned + more - exact)[:2]) / np.hypot(*exact[:2]), told.force_error),
        )
        ratios.append([error / estimate for error, estimate in errors])
        seen.append(told.force_error > 4e-4)
        centered.append(np.hypot(*place[2:]) > 1.5 * chi)
    ratios, centered = np.array(ratios), np.array(centered)
    assert centered.sum() > 5
    assert np.all(ratios[centered][:, :2] < 2.0)
    seen = np.array(seen)[~centered]
    within = (ratios[~centered] < 2.0) & (ratios[~centered] > 0.5)
    assert np.all(np.mean(within[:, :2], axis=0) >= (0.9, 0.85))
    assert np.mean(within[seen, 2]) >= 0.9
    assert seen.sum() > 40


def test_estimates_of_other_bearings_go_by_the_share_of_the_film():
    told = MomentCarryingJournal(bearing=GROOVED).estimate(AT, 300.0)
    assert told.correction == pytest.approx(0.57 * told.share**2)
    assert (told.force_error, told.moment_error) == pytest.approx((0.02, 0.048))  # of 48 x 4 cells
    assert told.end_shift == pytest.approx(0.5 * 0.1 / 1e-4 * math.hypot(1e-4, 2e-4))
    assert told.share == pytest.approx(told.end_shift * 1e-4 / (1e-4 - math.hypot(2e-5, 4e-5)))


def test_contact_and_rest_are_said(second):
    with pytest.raises(FilmContactError, match="over the whole length"):
        second.force([5e-5, 0.0, 0.0, 1.01e-3], np.zeros(4), 100.0)
    with pytest.warns(rf.ValidityWarning, match="60 %"):
        second.force([5e-5, 0.0, 0.0, 8e-4], np.zeros(4), 100.0)
    assert not second.force(AT, np.zeros(4), 0.0).any()
    for held in (second, closed()):
        with pytest.raises(UndefinedDerivativeError):
            held.jacobian(AT, np.zeros(4), 0.0)
    batch = second.force(np.stack([AT, 0.5 * AT], axis=1), RATE[:, None], 300.0)
    assert_allclose(batch[:, 1], second.force(0.5 * AT, RATE, 300.0), rtol=1e-14)


STILL = np.zeros(4)
FULL = MomentCarryingJournal(bearing=GRID)
MOVING = np.array([0.0, 0.0, 0.1, 0.0])


def warned_force(held, place, rate, speed):
    """Return the force and moment of a journal that must warn of what drives its film."""
    with pytest.warns(rf.ValidityWarning, match="1.5 times as fast as the displacement"):
        return held.force(place, rate, speed)


def test_a_tilt_that_moves_in_a_slow_film_is_outside(second):
    """The force tends to that of the aligned film, which is below the full one, and does not diverge."""
    place = np.array([0.0, -4e-5, 2e-4, 0.0])
    full = FULL.force(place, MOVING, 1e-3)
    for speed in (1.0, 1e-2, 1e-4, 1e-9, 0.0):
        found = warned_force(second, place, MOVING, speed)
        assert np.hypot(*found[:2]) < np.hypot(*full[:2])
        assert np.hypot(*found[2:]) == pytest.approx(np.hypot(*full[2:]), rel=0.25)
    rising = MOVING + np.array([0.0, 1e-6, 0.0, 0.0])  # across what a rotation at these speeds drives
    found, full = warned_force(second, place, rising, 0.0), FULL.force(place, rising, 0.0)
    assert 0.5 < np.hypot(*(found - full)[2:]) / np.hypot(*full[2:]) < 1.0  # as the page says of the moment
    spin = 0.999 * 150.0 * np.array([4e-5, 0.0, 0.0, 0.0])  # nearly at half the speed of the shaft
    assert np.hypot(*warned_force(second, place, spin, 300.0)[:2]) < 277.0
    for held in (closed(), replace(closed(), level=TiltLevel.NONE)):
        assert not warned_force(held, place, MOVING, 0.0).any()
        assert not held.force([0.0, 0.0, 2e-4, 0.0], STILL, 300.0)[:2].any()


def test_second_order_goes_on_smoothly_where_the_tilt_drives_more(second):
    """Force and derivatives are continuous at |w1| = 1.5 |w|, and exact beyond."""
    place = np.array([2e-5, -4e-5, 1e-4, 5e-5])
    source = 150.0 * TURN @ second._scales @ place
    more = np.array([0.3, -0.7]) / np.hypot(0.3, -0.7) * 1.5 * np.hypot(*source[:2])
    inside, beyond = (
        np.linalg.solve(second._scales, [0.0, 0.0, *(part * more - source[2:])])
        for part in (1.0 - 1e-9, 1.0 + 1e-9)
    )
    force, slopes = second.force(place, inside, 300.0), second.jacobian(place, inside, 300.0)
    assert_allclose(warned_force(second, place, beyond, 300.0), force, rtol=1e-7)
    far = np.linalg.solve(second._scales, [0.0, 0.0, *(2.5 * more - source[2:])])
    with pytest.warns(rf.ValidityWarning):
        after = second.jacobian(place, beyond, 300.0)
    with pytest.warns(rf.ValidityWarning):
        out = second.jacobian(place, far, 300.0)
    with pytest.warns(rf.ValidityWarning):
        steps = differences(second, place, far, 300.0)
    sizes = np.abs(slopes).max(axis=0)
    assert_allclose(after / sizes, slopes / sizes, atol=1e-6)
    assert_allclose(steps / np.abs(out).max(axis=0), out / np.abs(out).max(axis=0), atol=1e-6)


@pytest.mark.parametrize("away", [0.0, 1e-9, 2e-6])
def test_near_the_center_second_order_warns_and_estimates_are_not_too_low(second, away):
    place = np.array([0.0, -away, 2e-4, 0.0])
    found, full = warned_force(second, place, STILL, 300.0), FULL.force(place, STILL, 300.0)
    told = second.estimate(place, 300.0)
    if away:
        assert np.hypot(*(found - full)[:2]) < 2.0 * told.force_error * np.hypot(*full[:2])
    assert np.hypot(*(found - full)[2:]) < 1.2 * told.moment_error * np.hypot(*full[2:])
    steep, straight = (
        held.jacobian([0.0, -2e-6, tilt, 0.0], STILL, 300.0) for held, tilt in ((FULL, 2e-4), (FULL, 0.0))
    )
    error = np.abs(steep - straight)[:2, :2].max() / np.abs(steep[:2, :2]).max()
    assert error < 1.5 * second.estimate([0.0, -2e-6, 2e-4, 0.0], 300.0).stiffness_error
    assert closed().estimate(place, 300.0).correction == pytest.approx(told.correction)


def test_a_lightly_loaded_journal_finds_its_rest(second):
    with pytest.warns(rf.ValidityWarning):
        rest = rf.equilibrium(second, [0.0, -50.0, 5.0, 0.0], 300.0)
    full = rf.equilibrium(FULL, [0.0, -50.0, 5.0, 0.0], 300.0)
    assert_allclose(rest.position[[0, 3]], full.position[[0, 3]], rtol=0.3)


def test_places_and_profiles_that_are_none_are_refused(second):
    for bad, message in (([0.0, 1e-5], "shape"), ([0.0, math.nan, 0.0, 0.0], "position must be finite")):
        with pytest.raises(InputError, match=message):
            second.minimum_film(bad)
        with pytest.raises(InputError, match=message):
            FULL.estimate(bad, 300.0)
    for bad in (math.nan, "fast", [300.0]):
        with pytest.raises(InputError, match="speed must be a single finite number"):
            FULL.estimate(AT, bad)
    assert second.estimate(AT, 0.0) == pytest.approx(second.estimate(AT, 300.0))
    with pytest.raises(InputError, match="profile must have shape"):
        MomentCarryingJournal(bearing=GRID, profile=[[1e-5, 0.0]])
    depths = np.array([1e-5, 0.0, 1e-5])
    assert hash(MomentCarryingJournal(bearing=GRID, profile=depths)) == hash(
        MomentCarryingJournal(bearing=GRID, profile=tuple(depths.tolist()))
    )
    with pytest.raises(InputError, match=r"got PressureDamBearing$"):
        MomentCarryingJournal(bearing=DAM)


EASED = mobility_of(lambda H: (1.0 / (1.0 + H), 1.0 / (1.0 + H), 1.0, 1.0 + H))
OIL = rf.Oil.iso_vg(46)


@pytest.mark.parametrize(
    ("bearing", "options", "message"),
    [
        (PLAIN, {}, "film on a grid"),
        (DAM, {}, "film on a grid"),
        (replace(LOBED, film=rf.bearings.PadMapFilm()), {}, "film on a grid"),
        (GROOVED, {"level": TiltLevel.SECOND_ORDER}, "plain JournalBearing"),
        (LOBED, {"level": TiltLevel.SECOND_ORDER}, "plain JournalBearing"),
        (replace(PLAIN, film=rf.ReynoldsFilm(mobility=EASED)), {"level": TiltLevel.SECOND_ORDER}, "laminar"),
        (replace(PLAIN, circumferential_groove=0.01), {"level": TiltLevel.NONE}, "circumferential"),
        (PLAIN, {"level": TiltLevel.CLOSED_FORM, "crown": 1e-5}, "crown"),
        (GRID, {"profile": (1e-5,)}, "profile"),
        (GRID, {"level": 3}, "level must be"),
        (
            replace(GRID, viscosity=None, oil=OIL, cooling=rf.Cooling(supply_temperature=313.0)),
            {},
            "temperature",
        ),
    ],
)
def test_what_no_level_has_is_refused(bearing, options, message):
    with pytest.raises(InputError, match=message):
        MomentCarryingJournal(bearing=bearing, **options)


def test_pads_on_pivots_are_refused():
    pads = rf.TiltingPadBearing(
        radius=0.05, length=0.05, pad_clearance=1e-4, viscosity=0.02, pivots=rf.even_pivots(4), extent=1.2
    )
    with pytest.raises(InputError, match="pads on pivots may follow a tilt"):
        MomentCarryingJournal(bearing=pads, level=TiltLevel.NONE)


def test_a_mobility_reaches_the_closed_form():
    eased = replace(PLAIN, film=ExtrapolatedFilm(film=rf.ReynoldsFilm(cells=(32, 8), mobility=EASED)))
    force = closed(eased).force(AT, np.zeros(4), 300.0)
    full = MomentCarryingJournal(bearing=eased).force(AT, np.zeros(4), 300.0)
    assert_allclose(force[:2], full[:2], rtol=0.05)
    assert_allclose(force[2:], full[2:], atol=0.4 * np.abs(full[2:]).max())
