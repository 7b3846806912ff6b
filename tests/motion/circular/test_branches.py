"""Synchronous orbits: closed forms, folds of the notes, stability by exponents and by simulation, contact."""

from dataclasses import replace

import numpy as np
import pytest
from numpy.testing import assert_allclose
from scipy.integrate import quad
from scipy.optimize import brentq

from rotorfilm import (
    ContactError,
    FullFilm,
    Groove,
    InputError,
    JournalBearing,
    PorousDamper,
    ReynoldsFilm,
    simulate,
    synchronous_orbits,
)
from rotorfilm.analysis import (
    bistability_limit,
    bistable_map,
    orbit_system,
    orbits_over_speed,
    polar_series,
    transmitted_ratio,
)
from rotorfilm.bearings import AxialFeed
from rotorfilm.bearings.damper import layer_modes


@pytest.mark.closed_form
def test_solid_cavitated_branch_is_explicit(support, rotor, unit):
    # f_r = -2 Bs e^2/(1-e^2)^2, f_t = -Bs (pi/2) e/(1-e^2)^1.5 at Omega = 1.
    Bs, spring = 0.08, 0.4
    found = synchronous_orbits(rotor(0.1), support(Bs, spring), unit * np.linspace(0.02, 0.9, 60))
    for branch in found.branches:
        e = branch.eccentricity_ratio
        f_r, f_t = -2.0 * Bs * e**2 / (1 - e**2) ** 2, -0.5 * np.pi * Bs * e / (1 - e**2) ** 1.5
        along = (spring**2 - 1.0) * e - f_r
        assert_allclose(np.hypot(along, f_t), branch.unbalance / unit, rtol=1e-9)
        assert_allclose(branch.phase, np.arctan2(f_t, along), rtol=1e-9)
        transmitted = np.hypot(f_r - spring**2 * e, f_t) / (branch.unbalance / unit)
        assert_allclose(branch.transmissibility, transmitted, rtol=1e-9)
    assert np.all(found.branches[0].phase < 0.0)  # the displacement lags


@pytest.mark.closed_form
@pytest.mark.parametrize(("phi", "up", "down"), [(0.0, 0.3931, 0.3617), (0.001, 0.4079, None)])
def test_folds_are_those_of_the_notes(support, rotor, unit, phi, up, down):
    folds = synchronous_orbits(rotor(0.1), support(0.08, 0.4, phi)).folds
    assert [fold.upward for fold in folds] == [True, False]
    assert folds[0].unbalance / unit == pytest.approx(up, abs=5e-5)
    if down:
        assert folds[1].unbalance / unit == pytest.approx(down, abs=5e-5)


def test_a_data_frame_has_a_row_for_each_orbit(support, rotor, unit):
    unbalances = unit * np.array([0.1, 0.38, 0.5])
    found = synchronous_orbits(rotor(0.1), support(0.08, 0.4), unbalances)
    frame = found.to_dataframe()
    assert frame.columns.tolist() == [
        *("branch", "unbalance", "eccentricity_ratio", "phase"),
        *("transmissibility", "growth_rate", "stable", "speed"),
    ]
    for unbalance in unbalances:
        rows = frame[frame["unbalance"] == unbalance]
        orbits = found.at(unbalance)
        assert len(rows) == len(orbits) == (3 if unbalance == unbalances[1] else 1)
        for (_, row), orbit in zip(rows.iterrows(), orbits, strict=True):
            assert all(row[name] == getattr(orbit, name) for name in frame.columns.drop("branch"))
    assert frame.attrs["units"]["speed"] == "rad/s"
    assert frame.attrs["folds_unbalance"] == [fold.unbalance for fold in found.folds]


@pytest.mark.closed_form
def test_solid_folds_are_the_roots_of_the_polynomial(support, rotor, unit):
    # dU^2/de = 0 by the closed form, on a fine grid and by bisection: independent of the film and of Newton.
    Bs, s2 = 0.08, 0.16 - 1.0

    def square(e):
        f_r, f_t = -2.0 * Bs * e**2 / (1 - e**2) ** 2, -0.5 * np.pi * Bs * e / (1 - e**2) ** 1.5
        return (s2 * e - f_r) ** 2 + f_t**2

    e = np.linspace(0.5, 0.85, 2_000_001)
    values = np.sqrt(square(e))
    turns = np.nonzero(np.diff(np.sign(np.diff(values))))[0] + 1
    found = [fold.unbalance / unit for fold in synchronous_orbits(rotor(0.1), support(Bs, 0.4)).folds]
    assert_allclose(found, values[turns], rtol=1e-11)


def limit_of_the_closed_form(spring):
    """Return Bs/Omega at which U^2(eps^2) of the solid film is level; slope by a complex step."""

    def least(b):
        E = np.linspace(0.1, 0.9, 40_001) + 1e-30j
        along = (spring**2 - 1.0) + 2.0 * b * np.sqrt(E) / (1.0 - E) ** 2
        across = 0.5 * np.pi * b / (1.0 - E) ** 1.5
        return np.min((E * (along**2 + across**2)).imag) / 1e-30

    return brentq(least, 0.05, 0.3, xtol=1e-9)


@pytest.mark.closed_form
@pytest.mark.parametrize(("spring", "limit"), [(0.0, 0.1377), (0.4, 0.1156)])
def test_bistability_ends_where_the_notes_say(support, rotor, spring, limit):
    damper = support(0.05, 0.0)
    found = bistability_limit(damper, spring)
    assert found == pytest.approx(limit, abs=1.1e-4)
    assert found == pytest.approx(limit_of_the_closed_form(spring), rel=1e-6)
    assert len(synchronous_orbits(rotor(0.1), support(0.999 * found, spring)).folds) == 2
    assert not synchronous_orbits(rotor(0.1), support(1.001 * found, spring)).folds


def test_map_of_the_bistable_region_equals_the_folds_of_single_dampers(support, rotor, unit):
    found = bistable_map(support(1.0, 0.0, 0.001), [0.04, 0.08, 0.3], [0.2, 0.4])
    for i, strength in enumerate(found.squeeze_number[:2]):
        for j, spring in enumerate(found.spring_ratio):
            folds = synchronous_orbits(rotor(0.1), support(strength, spring, 0.001)).folds
            expected = [fold.unbalance / unit for fold in folds]
            assert_allclose([found.jump_up[i, j], found.jump_down[i, j]], expected, rtol=1e-7)
    assert np.all(np.isnan(found.jump_up[2]))


def test_middle_branch_is_a_saddle_and_the_outer_ones_are_stable(support, rotor):
    shaft, film = rotor(0.385), support(0.08, 0.4)
    low, middle, high = synchronous_orbits(shaft, film).at(shaft.unbalance)
    assert (low.stable, middle.stable, high.stable) == (True, False, True)
    exponents = np.linalg.eigvals(orbit_system(shaft, film, middle).A)
    growing = exponents[exponents.real > 0.0]
    assert growing.size == 1
    assert growing[0].imag == 0.0
    assert growing[0].real == pytest.approx(middle.growth_rate, rel=1e-9)


@pytest.mark.long
def test_saddle_by_simulation_from_both_sides(support, rotor, whirl):
    shaft, film = rotor(0.385), support(0.08, 0.4)
    low, middle, high = synchronous_orbits(shaft, film).at(shaft.unbalance)
    values, vectors = np.linalg.eig(orbit_system(shaft, film, middle).A)
    direction = vectors[:, np.argmax(values.real)].real
    direction /= direction[0]
    direction[2:] /= middle.speed
    slopes = []
    for side, end in ((-1.0, low), (1.0, high)):
        start = whirl(middle, side * 2e-3 * direction)
        run = simulate(shaft, film, duration=0.35, samples=701, initial_state=start, rtol=1e-6)
        eps, phase = polar_series(run, shaft, film.clearance)
        assert eps[-1] == pytest.approx(end.eccentricity_ratio, abs=2e-3)
        assert phase[-1] == pytest.approx(end.phase, abs=1e-2)
        assert transmitted_ratio(run, shaft)[-1] == pytest.approx(end.transmissibility, rel=1e-2)
        departed = side * (eps - middle.eccentricity_ratio)
        slopes.append(np.log(departed[30] / departed[5]) / (run.time[30] - run.time[5]))
    # What bends the two departures cancels in their mean.
    assert np.mean(slopes) == pytest.approx(middle.growth_rate, rel=1e-2)


def test_stable_orbit_stays(support, rotor, whirl):
    shaft, film = rotor(0.3), support(0.08, 0.4, 0.001, 0.1)
    (orbit,) = synchronous_orbits(shaft, film).at(shaft.unbalance)
    run = simulate(shaft, film, duration=0.1, initial_state=whirl(orbit))
    eps, phase = polar_series(run, shaft, film.clearance)
    assert_allclose(eps, orbit.eccentricity_ratio, atol=1e-6)
    assert_allclose(phase, orbit.phase, atol=1e-5)
    assert_allclose(transmitted_ratio(run, shaft), orbit.transmissibility, rtol=1e-5)


def test_rotation_in_the_other_sense_is_the_mirror(support, rotor):
    forward = synchronous_orbits(rotor(0.3), support(0.08, 0.4)).at(rotor(0.3).unbalance)
    backward = synchronous_orbits(rotor(0.3, speed=-400.0), support(0.08, 0.4)).at(rotor(0.3).unbalance)
    assert [replace(orbit, speed=400.0) for orbit in backward] == list(forward)


@pytest.mark.closed_form
def test_porous_film_meets_the_wall_at_a_finite_unbalance(support, rotor, unit):
    film = support(0.08, 0.4, 0.001)
    found = synchronous_orbits(rotor(0.1), film, unit * np.array([0.5, 1.1, 1.3]))
    modes = layer_modes(film.reactions[0].layer)

    def component(trig):  # at eps = 1, over the half circle ahead of the rotor
        def integrand(theta):
            return (
                np.sin(theta) * trig(theta) * (modes.weight / ((1 + np.cos(theta)) ** 3 + modes.leak)).sum()
            )

        return -0.08 * quad(integrand, np.pi, 2.0 * np.pi, points=[np.pi + 0.3], epsabs=1e-9, limit=300)[0]

    # th from the maximum film: pressure over (pi, 2 pi) for phidot > 0
    f_r, f_t = component(np.cos), component(np.sin)
    contact = np.hypot((0.16 - 1.0) - f_r, f_t)
    assert found.contact_unbalance / unit == pytest.approx(contact, rel=1e-5)
    assert found.at(unit * 1.1)
    assert not found.at(unit * 1.3)
    assert synchronous_orbits(rotor(0.1), support(0.08, 0.4)).contact_unbalance is None


def test_beyond_the_contact_unbalance_the_simulation_hits_the_wall(support, rotor):
    shaft, film = rotor(1.4), support(0.08, 0.4, 0.001)
    assert not synchronous_orbits(shaft, film).at(shaft.unbalance)
    with pytest.raises(ContactError) as caught:
        simulate(shaft, film, duration=0.2, samples=201)
    eps, _ = polar_series(caught.value.partial, shaft, film.clearance)
    assert eps[-1] > 0.9


def test_response_over_speed_peaks_near_the_spring_resonance(support, rotor):
    shaft, film = rotor(0.05), support(0.02, 0.4)
    speeds = np.linspace(60.0, 400.0, 18)
    curve = orbits_over_speed(shaft, film, speeds)
    frame = curve.to_dataframe()
    peak = frame.groupby("speed")["transmissibility"].max().to_numpy()
    assert len(curve.plot()) == 2
    assert 100.0 < speeds[int(np.argmax(peak))] < 260.0
    assert peak[-1] < 1.0 < peak[0]


@pytest.mark.parametrize(
    ("change", "match"),
    [
        ({"gravity": (0.0, -9.8)}, "rotor must carry no static load"),
        ({"speed": 0.0}, "speed must be constant and not zero"),
        ({"unbalance": 0.0}, "unbalances must be positive"),
    ],
)
def test_rotors_without_circular_orbits_are_refused(support, rotor, change, match):
    with pytest.raises(InputError, match=match):
        synchronous_orbits(replace(rotor(0.1), **change), support(0.08, 0.4))


def test_film_that_knows_directions_is_refused(rotor):
    bearing = JournalBearing(
        radius=0.05,
        length=0.05,
        clearance=1e-4,
        viscosity=0.01,
        film=ReynoldsFilm(),
        grooves=(Groove(center=0.3),),
    )
    with pytest.raises(InputError, match="reaction must not depend on direction"):
        synchronous_orbits(rotor(0.1), bearing)


@pytest.mark.parametrize(
    ("arguments", "match"),
    [
        (([-0.1], [0.2]), "squeeze_numbers must be positive"),
        (([0.1], [-0.2]), "spring_ratios must not be negative"),
    ],
)
def test_bad_map_is_refused(support, arguments, match):
    with pytest.raises(InputError, match=match):
        bistable_map(support(0.08, 0.0), *arguments)


def test_map_needs_a_film_that_scales(support):
    damper: PorousDamper = replace(support(0.08, 0.0), feed=AxialFeed(start_pressure=1.0, end_pressure=0.0))
    with pytest.raises(InputError, match="damper must have no feed"):
        bistable_map(damper, [0.1], [0.2])
    with pytest.raises(InputError, match="damper must be a PorousDamper, got JournalBearing"):
        bistable_map(JournalBearing(radius=0.05, length=0.02, clearance=1e-4, viscosity=0.1), [0.1], [0.2])
    with pytest.raises(InputError, match="squeeze number at which folds appear"):
        bistability_limit(support(0.08, 0.0, extent=FullFilm()), 0.4)


def test_a_branch_without_an_orbit_says_so(support, rotor):
    film = support(0.08, 0.4, 0.001)
    wall = synchronous_orbits(rotor(0.1), film).contact_unbalance
    found = synchronous_orbits(rotor(0.1), film, [2.0 * wall])
    assert [branch.unbalance.size for branch in found.branches] == [0] * len(found.branches)
    assert dict(found.to_rows())["branches 1"] == "empty"
    assert found.at(2.0 * wall) == ()
    with pytest.raises(InputError, match=r"unbalances must be positive and not empty, got \[\]"):
        synchronous_orbits(rotor(0.1), film, [])
