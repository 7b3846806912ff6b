"""Bearings of fixed pads: published coefficients, symmetries, and the reference figures of several grids."""

from dataclasses import replace

import numpy as np
import pytest

from rotorfilm import (
    FilmContactError,
    InputError,
    JournalBearing,
    Lobe,
    LobedBearing,
    Pad,
    ReynoldsFilm,
    TiltingPadBearing,
    coefficients,
    equilibrium,
    lobe_set,
    with_springs,
)
from rotorfilm.bearings import PadGridFilm, PadMapFilm
from rotorfilm.bearings.pads import PadResolution

DEGREE = np.pi / 180.0
RADIUS, CLEARANCE, VISCOSITY, SPEED = 0.05, 1e-4, 0.02, 300.0


def bearing(lobes, slenderness=1.0, cells=(96, 8)):
    return LobedBearing(
        radius=RADIUS,
        length=2.0 * RADIUS * slenderness,
        pad_clearance=CLEARANCE,
        viscosity=VISCOSITY,
        lobes=lobes,
        film=PadGridFilm(cells=cells),
    )


def at_load(of, load):
    """Return r/c, K and C in mu L R^3 omega/c^2 (/c, /c/omega) at a load along -y in that unit."""
    unit = of.force_scale * SPEED
    rest = equilibrium(of, (0.0, -load * unit), SPEED)
    found = coefficients(of, rest.position, SPEED)
    per = unit / CLEARANCE
    return rest, found.stiffness / per, found.damping * SPEED / per


def plain_pads(slenderness):
    pads = tuple(Pad(start=k * DEGREE, extent=160.0 * DEGREE) for k in (10.0, 190.0))
    return JournalBearing(
        radius=RADIUS,
        length=2.0 * RADIUS * slenderness,
        clearance=CLEARANCE,
        viscosity=VISCOSITY,
        pads=pads,
        film=ReynoldsFilm(cells=(384, 16)),
    )


REFERENCE = {
    "three_lobe": (2.0, (0.1715, -0.2228), (12.80, 2.81, -14.16, 9.13), (18.51, -7.13, -7.13, 19.22)),
    "four_lobe": (1.5, (0.2066, -0.1410), (5.20, 4.46, -8.47, 7.75), (10.56, -3.10, -3.10, 17.52)),
    "offset_halves": (2.0, (0.0045, -0.3121), (7.75, -0.00, -12.48, 9.10), (8.11, -8.22, -8.22, 20.29)),
}
"""Load, r/c, K and C of the notes: another discretization, extrapolated, L/D 1 and preload .5."""


@pytest.mark.parametrize("name", REFERENCE)
def test_lobes_are_those_of_another_discretization(name):
    load, place, K, C = REFERENCE[name]
    rest, stiffness, damping = at_load(bearing(lobe_set(name, preload=0.5)), load)
    assert rest.position / CLEARANCE == pytest.approx(place, abs=3e-4)
    assert stiffness.ravel() == pytest.approx(K, abs=0.012 * np.abs(K).max())
    assert damping.ravel() == pytest.approx(C, abs=0.012 * np.abs(C).max())


LUND_THOMSEN_ELLIPTICAL = {
    0.211: (0.260, 87.79, (6.65, 4.36, -3.21, 0.86), (13.09, -2.23, 3.70)),
    0.120: (0.350, 81.80, (4.99, 3.54, -1.52, 1.14), (9.04, -0.01, 2.49)),
}
"""Lund & Thomsen (1978), elliptical, preload .5, L/D 1 by S: eps, phi [deg], Kxx Kxy Kyx Kyy, Bxx Bxy Byy."""


@pytest.mark.parametrize("S", LUND_THOMSEN_ELLIPTICAL)
def test_elliptical_bearing_of_lund_and_thomsen(S):
    """Their x is along the load, y 90 deg ahead: Kxx = Kyy of ours, Kxy = -Kyx, Kyx = -Kxy."""
    eps, phi, K, B = LUND_THOMSEN_ELLIPTICAL[S]
    load = 1.0 / (np.pi * S)
    rest, stiffness, damping = at_load(bearing(lobe_set("elliptical", preload=0.5)), load)
    (a, b), (c, d) = stiffness / load
    (e, f), (_, h) = damping / load
    assert rest.eccentricity_ratio == pytest.approx(eps, abs=3e-3)
    assert np.degrees(rest.attitude_angle) == pytest.approx(phi, abs=0.2)
    assert [d, -c, -b, a] == pytest.approx(K, abs=0.03)
    assert [h, -f, e] == pytest.approx(B, abs=0.07)


LUND_THOMSEN_GROOVES = {
    0.917: (0.5, 0.372, 57.45, (2.12, 4.01, -1.30, 1.85), (7.70, 2.06, 3.23)),
    0.635: (1.0, 0.224, 63.54, (1.62, 5.33, -1.57, 1.56), (10.80, 1.70, 3.41)),
}
"""The same for two axial grooves of 20 deg, without preload: L/D first."""


@pytest.mark.parametrize("S", LUND_THOMSEN_GROOVES)
def test_two_axial_grooves_of_lund_and_thomsen(S):
    slenderness, eps, phi, K, B = LUND_THOMSEN_GROOVES[S]
    load = 1.0 / (np.pi * S)
    film = bearing(lobe_set("elliptical", preload=0.0), slenderness, (192, 16))
    rest, stiffness, damping = at_load(film, load)
    (a, b), (c, d) = stiffness / load
    (e, f), (_, h) = damping / load
    assert rest.eccentricity_ratio == pytest.approx(eps, abs=3e-3)
    assert np.degrees(rest.attitude_angle) == pytest.approx(phi, abs=0.3)
    assert [d, -c, -b, a] == pytest.approx(K, abs=0.03)
    assert [h, -f, e] == pytest.approx(B, abs=0.07)


def test_lobes_without_preload_are_a_bore_with_openings():
    lobed, plain = bearing(lobe_set("elliptical", preload=0.0), 0.5, (192, 16)), plain_pads(0.5)
    rng = np.random.default_rng(2)
    position = CLEARANCE * np.array([[0.3, -0.2, 0.0], [-0.5, 0.1, 0.6]])
    velocity = 1e-3 * rng.normal(size=(2, 3))
    found, expected = (each.force(position, velocity, SPEED) for each in (lobed, plain))
    # The plain film is not extrapolated: 384 x 16 cells err by some 1e-3.
    assert found == pytest.approx(expected, abs=2e-3 * np.abs(expected).max())


def test_equal_lobes_at_the_center():
    """N >= 3 equal pads: no force, K = a 1 + b (z x), C a multiple of 1."""
    for name in ("three_lobe", "four_lobe", "tapered_land"):
        of = bearing(lobe_set(name, preload=0.4, turned=0.3))
        zero, unit = np.zeros(2), of.force_scale * SPEED
        assert np.abs(of.force(zero, zero, SPEED)).max() < 1e-9 * unit
        at = coefficients(of, zero, SPEED)
        (a, b), (c, d) = at.stiffness * CLEARANCE / unit
        assert (a, b) == pytest.approx((d, -c), abs=1e-6)
        (a, b), (c, d) = at.damping * SPEED * CLEARANCE / unit
        assert (a, b, c) == pytest.approx((d, 0.0, 0.0), abs=1e-6)


def test_derivatives_are_those_of_the_force():
    of = bearing((Lobe(start=3.0, extent=1.8, preload=0.3, offset=0.7), Lobe(start=5.3, extent=1.2)), 0.7)
    state = np.array([0.1 * CLEARANCE, -0.3 * CLEARANCE, 2e-3, -1e-3, SPEED])

    def force(s):
        return of.force(s[:2], s[2:4], s[4])

    steps = np.array([2e-9, 2e-9, 2e-6, 2e-6, 0.05])
    jacobian = of.jacobian(state[:2], state[2:4], state[4])
    for k, step in enumerate(steps):
        d = np.zeros(5)
        d[k] = step
        near, far = (force(state + k * d) - force(state - k * d) for k in (1.0, 2.0))
        slope = (8.0 * near - far) / (12.0 * step)
        # The edge of the film jumps from node to node, and the lines of the grid follow the journal.
        tolerance = 2e-3 if k < 2 else 1e-4
        assert jacobian[:, k] == pytest.approx(slope, abs=tolerance * np.abs(jacobian[:, k]).max())
    damping = jacobian[:, 2:4]
    assert damping[0, 1] == pytest.approx(damping[1, 0], rel=1e-9)


def test_reversed_rotation_is_the_mirror_image():
    left = bearing((Lobe(start=3.5, extent=1.5, preload=0.3, offset=0.7),), 0.5)
    right = bearing((Lobe(start=-3.5 - 1.5, extent=1.5, preload=0.3, offset=0.3),), 0.5)
    q, v, mirror = np.array([2e-5, -3e-5]), np.array([1e-3, 2e-3]), np.array([1.0, -1.0])
    found = right.force(mirror * q, mirror * v, -SPEED)
    assert found == pytest.approx(mirror * left.force(q, v, SPEED), rel=1e-9)


def test_contact_names_the_lobe_and_not_the_circle():
    of = bearing(lobe_set("elliptical", preload=0.5))
    zero = np.zeros(2)
    with pytest.raises(FilmContactError, match=r"film of -.* m on lobe 1"):
        of.force([0.0, -0.51 * CLEARANCE], zero, SPEED)
    sideways = [0.8 * CLEARANCE, 0.0]
    assert np.isfinite(of.force(sideways, zero, SPEED)).all()
    assert of.minimum_film([0.0, 0.0]) == pytest.approx(0.5 * CLEARANCE, rel=1e-14)
    assert of.minimum_film([0.0, -0.5 * CLEARANCE]) == pytest.approx(0.0, abs=1e-18)


def test_minimum_film_is_the_least_on_the_arcs():
    of, rng = bearing(lobe_set("three_lobe", preload=0.3, offset=0.8)), np.random.default_rng(1)
    positions = 0.6 * CLEARANCE * rng.uniform(-1.0, 1.0, (2, 50))
    least = np.full(50, np.inf)
    for lobe in of.lobes:
        theta = np.linspace(lobe.start, lobe.start + lobe.extent, 20001)
        d = positions - CLEARANCE * np.array(lobe.center)[:, None]
        film = CLEARANCE - d[0][:, None] * np.cos(theta) - d[1][:, None] * np.sin(theta)
        least = np.minimum(least, film.min(axis=1))
    assert of.minimum_film(positions) == pytest.approx(least, abs=1e-7 * CLEARANCE)


def test_springs_beside_leave_the_wall_to_the_lobes():
    of = bearing(lobe_set("elliptical", preload=0.5))
    sprung, zero = with_springs(of, 1e6), np.zeros(2)
    sideways = np.array([0.8 * CLEARANCE, 0.0])
    assert sprung.minimum_film(sideways) == of.minimum_film(sideways)
    assert sprung.force(sideways, zero, SPEED) == pytest.approx(
        of.force(sideways, zero, SPEED) - 1e6 * sideways
    )
    with pytest.raises(FilmContactError, match="on lobe 1"):
        sprung.force([0.0, -0.51 * CLEARANCE], zero, SPEED)


def test_equilibrium_of_a_tight_bearing_and_of_heavy_loads():
    tight = bearing(lobe_set("four_lobe", preload=0.9))
    rest, *_ = at_load(tight, 3.0)
    assert 0.0 < rest.minimum_film < 0.1 * CLEARANCE
    assert rest.residual < 1e-9
    elliptical = bearing(lobe_set("elliptical", preload=0.5))
    heavy, *_ = at_load(elliptical, 300.0)
    assert heavy.residual < 1e-9
    assert heavy.minimum_film == pytest.approx(float(elliptical.minimum_film(heavy.position)), rel=1e-12)


def test_assembled_clearance():
    lobes = lobe_set("three_lobe", preload=0.6)
    of = LobedBearing(radius=RADIUS, length=0.1, assembled_clearance=4e-5, viscosity=VISCOSITY, lobes=lobes)
    assert of.clearance == pytest.approx(1e-4, rel=1e-14)
    assert of.minimum_film([0.0, 0.0]) == pytest.approx(4e-5, rel=1e-12)


def test_bad_input_names_argument_rule_and_value():
    with pytest.raises(InputError, match=r"preload must be in \[0, 1\), got 1.0"):
        Lobe(start=0.0, extent=1.0, preload=1.0)
    with pytest.raises(InputError, match=r"extent must be in \(0, pi\) rad, got 3.2"):
        Lobe(start=0.0, extent=3.2)
    with pytest.raises(InputError, match="offset must be in"):
        Lobe(start=0.0, extent=1.0, offset=1.2)
    with pytest.raises(InputError, match="lobes must not overlap"):
        bearing((Lobe(start=0.0, extent=1.0), Lobe(start=0.9, extent=1.0)))
    with pytest.raises(InputError, match=r"name of a set of lobes must be one of.*got 'five_lobe'"):
        lobe_set("five_lobe")
    with pytest.raises(InputError, match="one preload"):
        LobedBearing(
            radius=RADIUS,
            length=0.1,
            assembled_clearance=4e-5,
            viscosity=VISCOSITY,
            lobes=(Lobe(start=0.0, extent=1.0), Lobe(start=2.0, extent=1.0, preload=0.2)),
        )
    with pytest.raises(InputError, match="pad_clearance or assembled_clearance must be given, and not both"):
        LobedBearing(radius=RADIUS, length=0.1, viscosity=VISCOSITY, lobes=lobe_set("elliptical"))


@pytest.mark.parametrize(
    ("extent", "length", "message"),
    [
        (3.12, 0.1, r"extent must be 0\.1 to 3\.1 for a map of a pad, got 3\.12"),
        (0.05, 0.1, r"extent must be 0\.1 to 3\.1 for a map of a pad, got 0\.05"),
        (1.0, 0.004, r"length/diameter must be 0\.05 to 20\.0 for a map of a pad, got 0\.04"),
    ],
)
def test_a_shape_without_a_map_is_refused_unless_the_film_needs_none(extent, length, message):
    one = {"radius": 0.05, "length": length, "pad_clearance": 1e-4, "viscosity": VISCOSITY}
    lobes = (Lobe(start=0.0, extent=extent),)
    with pytest.raises(InputError, match=message):
        LobedBearing(**one, lobes=lobes)
    with pytest.raises(InputError, match=message):
        TiltingPadBearing(**one, pivots=(0.0,), extent=extent)
    grid = PadGridFilm(cells=(16, 4))
    bearing = LobedBearing(**one, lobes=lobes, film=grid)
    assert np.isfinite(bearing.force([0.0, 0.0], [0.0, 0.0], SPEED)).all()
    assert TiltingPadBearing(**one, pivots=(0.0,), extent=extent, film=grid).film == grid


@pytest.mark.closed_form
@pytest.mark.parametrize("name", ["elliptical", "three_lobe", "four_lobe"])
def test_light_loads_on_preloaded_lobes_move_the_journal_in_proportion(name):
    """The load is the small difference of what the lobes press: roundoff of that is no imbalance."""
    lobed = bearing(lobe_set(name, preload=0.6), cells=(16, 4))
    heavy = equilibrium(lobed, (0.0, -1.0), SPEED)
    for load in (1e-3, 0.1):
        at = equilibrium(lobed, (0.0, -load), SPEED)
        far = np.hypot(*heavy.position)
        np.testing.assert_allclose(at.position / load, heavy.position, rtol=0.0, atol=1e-3 * far)
        assert at.residual < 1e-8 / load


def test_a_default_map_is_chosen_anew_for_another_preload():
    size = {"radius": 0.05, "length": 0.05, "pad_clearance": 1e-4, "viscosity": 0.02}
    tilting = TiltingPadBearing(**size, pivots=(0.0, 2.0, 4.0), extent=1.2, preload=0.3)
    lobed = LobedBearing(**size, lobes=lobe_set("elliptical", preload=0.3))
    for plain, other in (
        (tilting, {"preload": 0.7}),
        (lobed, {"lobes": lobe_set("elliptical", preload=0.7)}),
    ):
        near = replace(plain, **other)
        assert near.film != plain.film
        assert replace(near, **{name: getattr(plain, name) for name in other}) == plain
        chosen = PadMapFilm(resolution=PadResolution(cells=(48, 4)))
        assert replace(plain, film=chosen, **other).film.own_resolution == chosen.resolution
