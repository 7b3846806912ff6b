"""Seals and grooves of squeeze-film dampers: closed forms, independent tables, published ratios."""

import cmath
import math

import numpy as np
import pytest
from numpy.testing import assert_allclose

import rotorfilm as rf
from rotorfilm import InputError, ValidityWarning
from rotorfilm.bearings.damper.squeeze_inertia import film_impedance
from rotorfilm.bearings.damper.squeeze_laws import squeeze_motions

SIZE = {"radius": 63.5e-3, "length": 25.4e-3, "clearance": 0.127e-3, "viscosity": 2.5e-3}
FULL = rf.FullFilm()
AT_100_HZ = 200.0 * math.pi


def land(length=25.4e-3, clearance=0.127e-3):
    return rf.bearings.FilmSegment(length=length, clearance=clearance)


def damper_of(*segments, seals=None):
    return rf.bearings.SegmentedDamper(
        radius=63.5e-3, segments=segments, viscosity=2.5e-3, density=800.0, seals=seals
    )


@pytest.mark.literature
@pytest.mark.parametrize("eps", [0.3, 0.5, 0.8])
def test_tight_film_is_the_long_bearing(eps):
    # "end_seals" of ROSS 3.1: C = 12 pi mu L (R/c)^3/((2 + eps^2) s) cavitated, full twice that.
    s, unit = math.sqrt(1.0 - eps**2), 1.5 / 0.2**2
    radial, across = squeeze_motions(eps, 0.2, 0.0).damping
    assert_allclose(across, unit * 4.0 * math.pi / ((2.0 + eps**2) * s), rtol=1e-9)
    assert_allclose(radial, unit * 2.0 * math.pi / s**3, rtol=1e-9)


def test_open_film_is_that_of_the_axial_series():
    shape = {"radius": 0.05, "length": 0.1, "clearance": 1e-4, "viscosity": 0.01, "extent": FULL}
    series = rf.SqueezeFilmDamper(**shape, film=rf.FiniteSqueeze())
    q, v = np.array([4e-5, 5e-5]), np.array([0.01, 0.02])
    leaking = rf.SqueezeFilmDamper(**shape, film=rf.FiniteSqueeze(), seals=rf.EndSeal(leakage=1e-3))
    assert_allclose(leaking.force(q, v), series.force(q, v), rtol=1e-5)


@pytest.mark.parametrize("extent", [FULL, rf.bearings.HalfSommerfeld()])
def test_short_film_between_leaking_seals(extent):
    # The finite film, and a quadrature of the end pressure -h_t L/(2 G_s) over the film that is filled.
    shape = {"radius": 0.5, "length": 0.02, "clearance": 1e-4, "viscosity": 0.01, "extent": extent}
    seals = rf.EndSeal(leakage=2e-10)
    with pytest.warns(ValidityWarning, match="seals of a short film must leak more"):
        rf.SqueezeFilmDamper(**shape, seals=rf.EndSeal(leakage=1e-13))
    found = rf.SqueezeFilmDamper(**shape, seals=seals)
    q, v = np.array([4e-5, 2e-5]), np.array([0.01, 0.02])
    theta = 2.0 * np.pi * (np.arange(20000) + 0.5) / 20000
    m = np.stack([np.cos(theta), np.sin(theta)])
    p = -(v @ m) * 0.02 / (2.0 * 2e-10)
    if extent is not FULL:
        p = np.maximum(p, 0.0)
    ends = m @ p * (2.0 * np.pi / theta.size) * 0.5 * 0.02
    bare = rf.SqueezeFilmDamper(**shape).force(q, v)
    assert_allclose(found.force(q, v), bare + ends, rtol=1e-6)
    if extent is FULL:
        whole = rf.SqueezeFilmDamper(**shape, seals=seals, film=rf.FiniteSqueeze())
        assert_allclose(found.force(q, v), whole.force(q, v), rtol=3e-3)


def test_sealing_raises_damping_and_mass_by_76():
    open_ends, tight = (
        damper_of(land(), seals=seals).small_motion(0.0) for seals in (None, rf.EndSeal(leakage=0.0))
    )
    assert_allclose([open_ends.damping, open_ends.added_mass], [3.9e3, 2.03], rtol=0.01)
    assert_allclose([tight.damping, tight.added_mass], [299e3, 154.0], rtol=3e-3)
    # The closed forms: 12 pi mu R^3 L/c^3 and (6/5) pi rho R^3 L/c
    R, L, c = 63.5e-3, 25.4e-3, 0.127e-3
    assert_allclose(tight.damping, 12.0 * math.pi * 2.5e-3 * R**3 * L / c**3, rtol=1e-7)
    assert_allclose(tight.added_mass, 1.2 * math.pi * 800.0 * R**3 * L / c, rtol=1e-6)


@pytest.mark.literature
def test_a_leak_leaves_the_mass_and_changes_the_damping():
    # San Andres, Koo & Jeung (2018), abstract: O-rings and piston rings, same added mass, other damping.
    wide = land(clearance=0.373e-3)
    tight, ring = (damper_of(wide, seals=rf.EndSeal(leakage=g)).small_motion(AT_100_HZ) for g in (0.0, 1e-10))
    assert abs(ring.added_mass / tight.added_mass - 1.0) < 0.05
    assert 1.05 < ring.damping / tight.damping < 1.2


@pytest.mark.parametrize(
    ("depth", "damping", "mass"),
    [(0.0, 56.7, 29.2), (0.1, 50.9, 31.3), (0.5, 36.2, 43.1), (2.0, 14.7, 31.3), (9.6, 8.3, 11.3)],
)
def test_groove_between_two_lands(depth, damping, mass):
    groove = land(length=12.7e-3, clearance=(0.127 + depth) * 1e-3)
    found = damper_of(land(), groove, land()).small_motion(AT_100_HZ)
    assert_allclose([1e-3 * found.damping, found.added_mass], [damping, mass], rtol=5e-3)


def test_a_land_cut_in_pieces_is_one_land():
    whole = damper_of(land(), seals=rf.EndSeal(leakage=1e-10)).small_motion(AT_100_HZ)
    pieces = damper_of(
        *(land(length=25.4e-3 * share) for share in (0.2, 0.5, 0.3)), seals=rf.EndSeal(leakage=1e-10)
    )
    cut = pieces.small_motion(AT_100_HZ)
    assert_allclose([cut.damping, cut.added_mass], [whole.damping, whole.added_mass], rtol=1e-9)


@pytest.mark.parametrize(
    ("reynolds", "stiffer", "lighter"), [(5, 0.003, 0), (10, 0.012, 0.001), (50, 0.23, 0.024)]
)
def test_impedance_is_exact_in_the_frequency(reynolds, stiffer, lighter):
    Z = film_impedance(1.0, 1.0, 1.0, reynolds)
    assert_allclose(Z.real / 12.0 - 1.0, stiffer, atol=0.006)
    assert_allclose(1.0 - Z.imag / (1.2 * reynolds), lighter, atol=1e-3)
    # Half the channel: u = G/(i w rho) (1 - cosh(k y)/cosh(k h/2)), integrated by quadrature.
    k, y = cmath.sqrt(1j * reynolds), (np.arange(20000) + 0.5) / 20000 - 0.5
    mean = np.mean((1.0 - np.cosh(k * y) / np.cosh(0.5 * k)) / (1j * reynolds))
    assert_allclose(Z, 1.0 / mean, rtol=1e-8)


def test_impedance_has_no_step_where_its_series_begins():
    Z = [film_impedance(1.0, 1.0, 1.0, 0.01 * (1.0 + small)) for small in (-1e-9, 1e-9)]
    assert_allclose(Z[0], Z[1], rtol=1e-10)


def test_leakage_of_a_gap_and_of_a_leak_test():
    assert_allclose(rf.bearings.gap_seal(height=5e-5, length=2e-3, viscosity=2.5e-3).leakage, 5e-5**3 / 6e-5)
    found = rf.bearings.leak_test_seal(flow=1e-6, pressure=2e5, radius=0.05, uncertainty=0.3)
    assert_allclose(found.leakage, 1e-6 / (2.0 * math.pi * 0.05 * 2e5))
    low, high = found.bounds
    assert_allclose([low.leakage, high.leakage], [0.7 * found.leakage, 1.3 * found.leakage])


def test_air_takes_damping_and_mass():
    damper = rf.SqueezeFilmDamper(**SIZE, density=800.0, extent=FULL)
    found, bare = rf.bearings.aerated_damper(damper, 0.3).small_motion(0.0), damper.small_motion(0.0)
    ratio = [found.damping / bare.damping, found.added_mass / bare.added_mass]
    assert_allclose(ratio, 0.7, rtol=1e-9)
    given = rf.bearings.feed_squeeze_number(damper, flow=1e-5, amplitude=5e-5, frequency=500.0)
    assert_allclose(given, 1e-5 / (math.pi * 0.127 * 25.4e-3 * 5e-5 * 500.0))
    with pytest.raises(InputError, match=r"air_fraction must be below 1, got 1\.0"):
        rf.bearings.aerated_damper(damper, 1.0)


@pytest.mark.parametrize(
    ("make", "text"),
    [
        (lambda: rf.EndSeal(leakage=-1.0), "leakage must"),
        (lambda: rf.EndSeal(leakage=math.inf), "leakage must"),
        (lambda: rf.EndSeal(leakage=1e-10, uncertainty=1.0), "uncertainty must be below 1"),
        (lambda: rf.bearings.gap_seal(height=0.0, length=1.0, viscosity=1.0), "height must be"),
        (
            lambda: rf.SqueezeFilmDamper(**SIZE, seals=rf.EndSeal(leakage=0.0)),
            "leakage of seals must be positive",
        ),
        (lambda: rf.SqueezeFilmDamper(**SIZE, seals=1e-10), "seals must be an EndSeal"),
        (
            lambda: rf.SqueezeFilmDamper(**SIZE, film=rf.FiniteMapSqueeze(), seals=rf.EndSeal(leakage=1e-10)),
            "seals must be None for FiniteMapSqueeze",
        ),
        (lambda: damper_of(), "segments must be at least one"),
        (lambda: damper_of(1.0), "segments must be FilmSegments"),
        (lambda: damper_of(land()).small_motion(-1.0), "frequency must"),
    ],
)
def test_bad_values_are_named(make, text):
    with pytest.raises(InputError, match=text):
        make()
