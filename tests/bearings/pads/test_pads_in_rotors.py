"""Rotors on fixed pads: orbits, thresholds and transients agree with each other and with K and C."""

import re
from dataclasses import replace

import numpy as np
import pytest
from scipy.integrate import Radau

from rotorfilm import (
    FilmContactError,
    LobedBearing,
    RigidRotor,
    TiltingPadBearing,
    ValidityWarning,
    coefficients,
    continue_orbits,
    equilibrium,
    even_pivots,
    hopf_point,
    lobe_set,
    mount,
    periodic_orbit,
    simulate,
    whirl_threshold,
)
from rotorfilm.analysis.equal_steps import march
from rotorfilm.bearings import PadGridFilm, PadMapFilm, PadResolution
from rotorfilm.core import UnloadedPadWarning

FILM = PadMapFilm(resolution=PadResolution(cells=(32, 4), nodes=(10, 9, 32)))
BEARING = LobedBearing(
    radius=0.05,
    length=0.05,
    pad_clearance=1e-4,
    viscosity=0.02,
    lobes=lobe_set("three_lobe", preload=0.3),
    film=FILM,
)
SPEED, MASS, LOAD = 300.0, 80.0, (0.0, -900.0)
ROTOR = RigidRotor(mass=MASS, speed=SPEED, gravity=(0.0, 0.0), static_force=LOAD)


def test_a_small_orbit_is_that_of_the_coefficients():
    rest = equilibrium(BEARING, LOAD, SPEED)
    at = coefficients(BEARING, rest.position, SPEED)
    unbalance = 1e-8 * MASS
    rotor = replace(ROTOR, unbalance=unbalance, position=tuple(rest.position))
    orbit = periodic_orbit(mount(rotor, {"": BEARING}))
    dynamic = at.stiffness + 1j * SPEED * at.damping - SPEED**2 * MASS * np.eye(2)
    linear = np.abs(np.linalg.solve(dynamic, unbalance * SPEED**2 * np.array([1.0, -1j])))
    turn = np.linspace(0.0, orbit.period, 401)
    found = 0.5 * np.ptp(np.reshape(orbit.position(turn), (2, -1)), axis=1)
    assert found == pytest.approx(linear, rel=2e-3)


def test_the_hopf_point_is_the_whirl_threshold():
    threshold = whirl_threshold(BEARING, LOAD, MASS)
    point = hopf_point(
        lambda speed: mount(replace(ROTOR, speed=speed), {"": BEARING}),
        (0.8 * threshold.speed, 1.2 * threshold.speed),
    )
    assert point.speed == pytest.approx(threshold.speed, rel=1e-6)


def test_the_compiled_transient_is_that_of_scipy():
    rotor = replace(ROTOR, unbalance=3e-3, position=(1e-5, -2e-5))
    fast, slow = (
        simulate(rotor, BEARING, duration=0.05, samples=101, rtol=1e-8, **method)
        for method in ({}, {"method": Radau})
    )
    assert "film_evaluations" in fast.work
    assert fast.position == pytest.approx(slow.position, abs=1e-5 * BEARING.clearance)


def test_a_heavy_load_never_reaches_a_lobe():
    """The film carries any load: what is left of it goes on, and no step lands in the wall."""
    rotor = replace(ROTOR, static_force=(0.0, -2e5), mass=2e4)
    with pytest.warns(ValidityWarning, match="beyond the map of"):
        run = simulate(rotor, BEARING, duration=0.05, rtol=1e-6)
    assert run.time[-1] == pytest.approx(0.05)
    assert 0.0 < BEARING.minimum_film(run.position).min() < 0.05 * BEARING.clearance


def test_a_branch_over_unbalance_is_where_the_journal_settles():
    """From small orbits, which grow in proportion, to large ones, which a run in time must come to."""
    rest = tuple(equilibrium(BEARING, LOAD, SPEED).position)

    def family(unbalance):
        return mount(replace(ROTOR, unbalance=unbalance, position=rest), {"": BEARING})

    small, large = 1e-4, 8e-3
    curve = continue_orbits(family, periodic_orbit(family(small)), parameter=small, bounds=(small, large))
    assert curve.stable.all()
    assert curve.events == ()
    assert (np.diff(curve.parameters) > 0.0).all()
    end, orbit = curve.parameters[-1], curve.orbits[-1]
    assert end == pytest.approx(large)
    assert (
        abs(orbit.amplitude / curve.orbits[0].amplitude / (large / small) - 1.0) > 0.02
    )  # not in proportion
    run = simulate(family(end).rotor, BEARING, duration=40 * orbit.period, samples=40 * 32 + 1, rtol=1e-9)
    expected = np.reshape(orbit.position(run.time[-33:]), (2, -1))
    assert run.position[:, -33:] == pytest.approx(expected, abs=1e-6 * BEARING.clearance)


def test_a_search_in_vain_beyond_the_film_says_so_in_its_reason():
    found = whirl_threshold(BEARING, (0.0, -5e4), 200.0, (20.0, 5000.0))
    assert found.speed is None
    stable, _, doubt = found.reason.partition("; ")
    assert stable == "stable at every speed from 20 to 5000 rad/s"
    begins = "equilibria of the search are in doubt: least films of"
    assert re.match(f"{begins} .* are beyond the map of a pad", doubt)


def test_unloaded_pads_do_not_make_a_search_doubtful():
    bearing = TiltingPadBearing(
        radius=0.05,
        length=0.05,
        viscosity=0.02,
        pivots=even_pivots(4),
        extent=1.1,
        preload=0.3,
        pad_clearance=1e-4,
        film=FILM,
    )
    with pytest.warns(UnloadedPadWarning):
        equilibrium(bearing, (0.0, -900.0), 20.0)
    found = whirl_threshold(bearing, (0.0, -900.0), 200.0, (20.0, 2000.0))
    assert found.reason.startswith("stable at every speed")


@pytest.mark.filterwarnings("ignore:.*beyond the Reynolds number")  # a model problem at any speed
def test_a_threshold_that_is_found_says_nothing_of_the_speeds_before():
    """At 20 rad/s the film is beyond its map, as a rest there says."""
    load = (0.0, -2e5)
    with pytest.warns(ValidityWarning, match="beyond the map"):
        equilibrium(BEARING, load, 20.0)
    assert whirl_threshold(BEARING, load, 200.0, (20.0, 20000.0)).exists


@pytest.mark.parametrize("preload", [0.0, pytest.param(0.6, marks=pytest.mark.long)])
def test_a_rotor_shaken_up_to_a_lobe_is_told_by_the_lobe(preload):
    """The wall is that of the pads, of clearance 1e-4 m: nearer with preload, and in the gaps beyond it."""
    lobes = lobe_set("three_lobe", preload=preload)
    bearing = replace(BEARING, lobes=lobes, film=PadGridFilm(cells=(48, 4)))
    rest = equilibrium(bearing, LOAD, SPEED).position

    def shaken(pull, count=24):
        return march(bearing, MASS, SPEED, lambda t: (LOAD[0] + pull, LOAD[1]), rest, 2e-4, count)[0]

    with pytest.raises(FilmContactError, match="got to the wall"):
        shaken(1e12, 2)
    motion = shaken(2e5)
    films = bearing.minimum_film(motion.position)
    assert 0.0 < films.min() < 0.1 * bearing.minimum_film(np.zeros(2))
    exact = simulate(
        replace(ROTOR, static_force=(LOAD[0] + 2e5, LOAD[1]), position=tuple(rest)),
        bearing,
        duration=24 * 2e-4,
        samples=25,
        rtol=1e-8,
        method=Radau,
    )
    late = np.abs(motion.position - exact.position)[:, 12:]
    assert late.max() < 3e-3 * bearing.clearance
