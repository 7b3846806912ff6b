"""Pads with recesses: closed forms, exact identities, convergence, derivatives, what is refused."""

import math
import pickle
from dataclasses import replace
from itertools import pairwise

import numpy as np
import pytest

from rotorfilm import (
    FilmContactError,
    InputError,
    JournalBearing,
    Pad,
    PressureDamBearing,
    ReynoldsFilm,
    RigidRotor,
    UndefinedDerivativeError,
    coefficients,
    equilibrium,
    mount,
    periodic_orbit,
    pressure_dam_pads,
    simulate,
)
from rotorfilm.bearings import Recess, RecessedPad

DIMENSIONS = {"radius": 0.05, "length": 0.05, "assembled_clearance": 1e-4, "viscosity": 0.03}
POSITION, VELOCITY, SPEED = np.array([2e-5, -6e-5]), np.array([1e-3, -2e-3]), 300.0
STATE = (POSITION, VELOCITY, SPEED)
DAM = pressure_dam_pads(depth=60e-6, end="130 deg", share=0.75)
TRACKED = pressure_dam_pads(depth=60e-6, end="130 deg", share=0.75, track_depth=2e-4, preload=0.5)
PLAIN = pressure_dam_pads(depth=0.0, end=2.0, share=0.5)
STEPPED = pressure_dam_pads(depth=60e-6, end="130 deg", share=1.0)


def bearing(pads, cells=(32, 8), **options):
    return PressureDamBearing(**DIMENSIONS, pads=pads, cells=cells, **options)


def states(count, largest=0.9, seed=3):
    """Return positions and velocities (2, count) and speeds (count) of either sign."""
    rng = np.random.default_rng(seed)
    chi, angle = rng.uniform(0.0, largest, count), rng.uniform(-np.pi, np.pi, count)
    position = 1e-4 * chi * np.stack([np.cos(angle), np.sin(angle)])
    return position, 1e-2 * rng.normal(size=(2, count)), 300.0 * rng.normal(size=count)


@pytest.mark.closed_form
@pytest.mark.parametrize("speed", [300.0, -300.0])
def test_long_step_has_the_pressure_of_rayleigh(speed):
    """A centered long pad: linear on both sides, the peak of Rayleigh (1918) on the step."""
    thick, thin, before, behind = 1.866e-4, 1e-4, 0.718, 0.282
    edge = {"end": before} if speed > 0.0 else {"start": behind, "end": 1.0}
    pad = RecessedPad(start=0.0, extent=1.0, recess=Recess(depth=thick - thin, **edge))
    long = replace(bearing((pad,)), length=5.0)
    theta, axial, pressure = long.pressure(0, [0.0, 0.0], [0.0, 0.0], speed)
    wall = 0.05 * abs(speed)
    peak = 6.0 * 0.03 * wall * (thick - thin) / (thick**3 / (0.05 * before) + thin**3 / (0.05 * behind))
    step = before if speed > 0.0 else behind
    expected = peak * np.interp(theta, [0.0, step, 1.0], [0.0, 1.0, 0.0])
    np.testing.assert_allclose(pressure[:, 0], expected, rtol=0.0, atol=1e-9 * peak)
    assert (axial[0], axial[-1]) == (0.0, 1.0)
    assert not pressure[:, -1].any()


@pytest.mark.closed_form
def test_step_that_falls_behind_the_recess_makes_no_pressure_when_turned_round():
    pad = RecessedPad(start=0.0, extent=1.0, recess=Recess(depth=5e-5, end=0.7))
    np.testing.assert_array_equal(bearing((pad,)).force([0.0, 0.0], [0.0, 0.0], -300.0), 0.0)


@pytest.mark.parametrize("preload", [0.0, 0.4])
def test_recess_all_over_a_pad_is_a_pad_of_more_clearance(preload):
    """Without a step the depth adds to the pad clearance, with the center of curvature where it was."""
    extent, depth, own = 2.0, 3e-5, 1e-4 / (1.0 - preload)
    pad = RecessedPad(start=0.3, extent=extent, preload=preload, recess=Recess(depth=depth, end=0.3 + extent))
    wider = RecessedPad(start=0.3, extent=extent, preload=preload * own / (own + depth))
    wide = replace(bearing((wider,)), assembled_clearance=None, pad_clearance=own + depth)
    np.testing.assert_allclose(wide.force(*STATE), bearing((pad,)).force(*STATE), rtol=1e-12)
    np.testing.assert_allclose(wide.jacobian(*STATE), bearing((pad,)).jacobian(*STATE), rtol=1e-11, atol=1e-9)


def test_plain_pads_are_the_film_on_a_ring():
    """The ring grid crowds its lines elsewhere and shares no code of its cells: equal within the errors."""
    arcs = tuple(Pad(start=pad.start, extent=pad.extent) for pad in PLAIN)
    ring = JournalBearing(
        radius=0.05,
        length=0.05,
        clearance=1e-4,
        viscosity=0.03,
        pads=arcs,
        film=ReynoldsFilm(cells=(256, 16)),
    )
    ours = bearing(PLAIN, (128, 16), extrapolated=False)
    position, velocity, speed = states(30, 0.8)
    force = ring.force(position, velocity, speed)
    apart = np.hypot(*(force - ours.force(position, velocity, speed)))
    assert np.all(apart <= 2.0 * ours.force_error(position, velocity, speed) + 1e-9)
    assert np.median(apart / np.hypot(*force)) < 1.5e-3


@pytest.mark.convergence
@pytest.mark.parametrize("pads", [PLAIN, STEPPED, DAM], ids=["plain", "step", "dam"])
def test_force_converges_at_second_order(pads):
    forces = [bearing(pads, (n, n // 2), extrapolated=False).force(*STATE) for n in (16, 32, 64, 128)]
    first, second, third = (np.hypot(*(b - a)) for a, b in pairwise(forces))
    assert 1.8 < math.log2(first / second) < 2.2
    assert 1.8 < math.log2(second / third) < 2.2


@pytest.mark.convergence
@pytest.mark.parametrize("pads", [DAM, TRACKED], ids=["dam", "track"])
def test_error_is_estimated_within_a_factor_of_two(pads):
    found = states(30)
    truth = bearing(pads, (128, 32)).force(*found)
    coarse = bearing(pads)
    estimate = coarse.force_error(*found)
    error = np.hypot(*(replace(coarse, extrapolated=False).force(*found) - truth))
    assert np.mean((0.5 * estimate < error) & (error < 2.0 * estimate)) >= 0.9
    assert np.median(np.hypot(*(coarse.force(*found) - truth)) / error) < 0.2


@pytest.mark.closed_form
@pytest.mark.parametrize("extrapolated", [False, True])
@pytest.mark.parametrize("pads", [DAM, TRACKED], ids=["dam", "track"])
def test_identities_of_the_potential(pads, extrapolated):
    """Degree one in (v, speed): F = F_v v + F_speed speed; and F_v is symmetric, as F = dJ/dv."""
    film = bearing(pads, extrapolated=extrapolated)
    position, velocity, speed = states(20)
    force, D = film.force(position, velocity, speed), film.jacobian(position, velocity, speed)
    euler = np.einsum("ijn,jn->in", D[:, 2:4], velocity) + D[:, 4] * speed
    np.testing.assert_allclose(euler, force, rtol=0.0, atol=1e-11 * np.abs(force).max())
    np.testing.assert_allclose(film.force(position, 3.0 * velocity, 3.0 * speed), 3.0 * force, rtol=1e-9)
    np.testing.assert_allclose(D[0, 3], D[1, 2], rtol=0.0, atol=1e-12 * np.abs(D[:, 2:4]).max())
    if not extrapolated:
        damping = -np.moveaxis(D[:, 2:4], -1, 0)
        assert np.linalg.eigvalsh(damping).min() >= -1e-12 * np.abs(damping).max()


@pytest.mark.closed_form
def test_mirror_image():
    """In the mirror x -> -x the other way round, arcs and recesses too."""

    def mirrored(pad):
        recess = Recess(depth=60e-6, start=math.radians(50.0), end=math.radians(170.0), share=0.75)
        start = math.pi - pad.end
        return replace(pad, start=start, offset=1.0 - pad.offset, recess=recess if pad.recess else None)

    pads = (replace(DAM[0], preload=0.3, offset=0.7), DAM[1])
    one = replace(bearing(DAM), assembled_clearance=None, pad_clearance=1.5e-4)
    there, here = replace(one, pads=tuple(map(mirrored, pads))), replace(one, pads=pads)
    position, velocity, speed = states(10)
    turn = np.array([[-1.0], [1.0]])
    np.testing.assert_allclose(
        there.force(turn * position, turn * velocity, -speed),
        turn * here.force(position, velocity, speed),
        1e-9,
    )


@pytest.mark.parametrize("extrapolated", [False, True])
@pytest.mark.parametrize("pads", [DAM, TRACKED], ids=["dam", "track"])
def test_derivatives_are_those_of_the_discrete_film(pads, extrapolated):
    film = bearing(pads, extrapolated=extrapolated)
    here = np.array([*POSITION, *VELOCITY, SPEED])
    steps = np.diag([1e-9, 1e-9, 1e-6, 1e-6, 1e-3])
    moved = (here + np.concatenate([k * steps for k in (1.0, -1.0, 2.0, -2.0)])).T
    ahead, back, far, away = np.split(film.force(moved[:2], moved[2:4], moved[4]), 4, axis=1)
    differences = ((ahead - back) * 2.0 / 3.0 - (far - away) / 12.0) / np.diag(steps)
    np.testing.assert_allclose(differences, film.jacobian(*STATE), rtol=1e-7)


def test_one_call_batch_and_numbers_agree():
    film = pickle.loads(pickle.dumps(bearing(TRACKED)))
    position, velocity, speed = states(6)
    force, D = film.force(position, velocity, speed), film.jacobian(position, velocity, speed)
    call, tangent = film.prepare(), film.prepare_tangent()
    for k in range(6):
        state = (*position[:, k], *velocity[:, k], speed[k])
        np.testing.assert_array_equal(call(*state), force[:, k])
        force_x, force_y, slopes = tangent(*state)
        np.testing.assert_array_equal((force_x, force_y), force[:, k])
        np.testing.assert_array_equal(np.reshape(slopes, (2, 5)), D[..., k])


def test_journal_may_leave_the_circle_where_no_pad_is():
    """One pad of 100 deg: the wall is at the arc only, and the film beyond is legal."""
    pad = RecessedPad(start=math.radians(-50.0), extent=math.radians(100.0))
    film = bearing((pad,))
    far = [-2e-4, 5e-5]
    ends = [1e-4 - far[0] * math.cos(end) - far[1] * math.sin(end) for end in (pad.start, pad.end)]
    assert film.minimum_film(far) == pytest.approx(min(ends), rel=1e-12)
    assert np.hypot(*film.force(far, [1e-2, 0.0], SPEED)) > 0.0
    inside = [0.5e-4, 0.2e-4]
    assert film.minimum_film(inside) == pytest.approx(1e-4 - np.hypot(*inside), rel=1e-12)
    np.testing.assert_array_equal(film.jacobian(far, [-1.0, 0.0], 0.0), 0.0)  # no film is an answer


def test_recess_of_full_length_lets_the_journal_deeper():
    pad = RecessedPad(start=-0.5, extent=1.0, recess=Recess(depth=5e-5, end=0.4))
    assert bearing((pad,)).minimum_film([1.05e-4, 0.0]) == pytest.approx(
        min(4.5e-5, 1e-4 - 1.05e-4 * math.cos(0.4)), rel=1e-12
    )
    narrow = replace(pad, recess=Recess(depth=5e-5, end=0.4, share=0.9))
    assert bearing((narrow,)).minimum_film([1.05e-4, 0.0]) == pytest.approx(-5e-6, rel=1e-9)


def test_contact_names_the_pad():
    film = bearing(DAM)
    message = r"off pads\[1\], 190 to 350 deg, got \(0.0, -0.00012\) m with a film of -2e-05 m"
    for touch in (film.force, film.jacobian, lambda q, v, speed: film.prepare()(*q, *v, speed)):
        with pytest.raises(FilmContactError, match=message):
            touch([0.0, -1.2e-4], [0.0, 0.0], SPEED)


def test_no_derivative_where_nothing_drives_a_pad():
    film = bearing(PLAIN)
    assert not film.force(POSITION, [0.0, 0.0], 0.0).any()
    with pytest.raises(UndefinedDerivativeError, match="must drive the film of every pad"):
        film.jacobian(POSITION, [0.0, 0.0], 0.0)


def test_equilibrium_coefficients_and_motion():
    """The film of a preloaded dam carries a load, and a journal let go settles where it is balanced."""
    film, load = bearing(TRACKED), np.array([0.0, -300.0])
    at = equilibrium(film, load, SPEED)
    np.testing.assert_allclose(film.force(at.position, [0.0, 0.0], SPEED), -load, atol=1e-8)
    found = coefficients(film, at.position, SPEED)
    np.testing.assert_allclose(found.stiffness, -film.jacobian(at.position, [0.0, 0.0], SPEED)[:, :2])
    mass = 300.0 / 9.80665
    rotor = RigidRotor(mass=mass, speed=SPEED, position=tuple(0.9 * at.position), velocity=(0.0, 0.0))
    motion = simulate(rotor, film, duration=0.3)
    assert np.hypot(*(motion.position[:, -1] - at.position)) < 1e-3 * np.hypot(*at.position)


@pytest.mark.closed_form
def test_small_periodic_orbit_is_that_of_the_coefficients():
    film, load, mass, unbalance = bearing(TRACKED, (16, 8)), (0.0, -300.0), 300.0 / 9.80665, 1e-6
    orbit = periodic_orbit(mount(RigidRotor(mass=mass, speed=SPEED, unbalance=unbalance), {"": film}))
    at = coefficients(film, equilibrium(film, load, SPEED).position, SPEED)
    Z = at.stiffness - mass * SPEED**2 * np.eye(2) + 1j * SPEED * at.damping
    expected = np.linalg.solve(Z, unbalance * SPEED**2 * np.array([1.0, -1j]))
    motion = orbit.position(2.0 * math.pi / SPEED * np.arange(32) / 32.0)[0]
    first = np.fft.rfft(motion, axis=-1)[:, 1] / 16.0
    np.testing.assert_allclose(first, expected, rtol=0.0, atol=1e-4 * np.abs(expected).max())


@pytest.mark.parametrize(
    ("wrong", "message"),
    [
        ({"depth": -1e-5}, "depth must be finite and not negative, got -1e-05"),
        ({"share": 0.0}, r"share must be in \(0, 1\], got 0.0"),
        ({"end": 4.0}, r"end of the recess must be on its pad, from 0.3 to 2.3 rad, got 4.0"),
        ({"start": 1.9}, "recess must end after its start, got from 1.9 to 1.5 rad"),
        ({"pad": {"preload": 1.0}}, r"preload must be in \[0, 1\), got 1.0"),
        ({"pad": {"offset": 1.2}}, r"offset must be in \[0, 1\], got 1.2"),
        ({"pad": {"extent": 7.0}}, r"extent must be in \(0, 2 pi\), got 7.0"),
        ({"pad": {"recess": 3}}, "recess must be a Recess or None, got 3"),
        (
            {"bearing": {"cells": (30, 8)}},
            r"cells must be two multiples of 4, at least \(16, 8\), got \(30, 8\)",
        ),
        ({"bearing": {"pads": ()}}, r"pads must be one at least, got \(\)"),
        ({"bearing": {"assembled_clearance": 0.06}}, "pad clearance must be below the radius 0.05, got 0.06"),
        ({"bearing": {"viscosity": 0.0}}, "viscosity must be finite and positive, got 0.0"),
    ],
)
def test_what_breaks_a_rule_is_named(wrong, message):
    wrong = dict(wrong)
    of_pad, of_bearing = wrong.pop("pad", {}), wrong.pop("bearing", {})

    def made():
        recess = Recess(**{"depth": 5e-5, "end": 1.5, **wrong})
        pad = RecessedPad(**{"start": 0.3, "extent": 2.0, "recess": recess, **of_pad})
        return PressureDamBearing(**{**DIMENSIONS, "pads": (pad,), **of_bearing})

    with pytest.raises(InputError, match=message):
        made()


def test_pads_that_overlap_are_refused():
    pads = (RecessedPad(start=0.0, extent=3.0), RecessedPad(start=2.9, extent=3.0))
    with pytest.raises(InputError, match="pads must not overlap"):
        bearing(pads)


def test_angles_of_a_recess_may_be_turns_away():
    there = RecessedPad(start=-0.3, extent=1.0, recess=Recess(depth=5e-5, end=0.2 + 2.0 * math.pi))
    assert there.edges == pytest.approx((-0.3, -0.3, 0.2, 0.7))
