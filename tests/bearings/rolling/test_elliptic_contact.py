"""Hertz's elliptic contact, and the load zone, against closed forms and printed tables."""

import math
from itertools import pairwise

import numpy as np
import pytest
from scipy.integrate import quad
from scipy.special import ellipe, ellipk

from rotorfilm import InputError, RollingMaterial
from rotorfilm.bearings import EllipticContact, load_integrals, palmgren_stiffness, stribeck_load
from rotorfilm.bearings.rolling import elliptic_integrals

INCH, PSI, POUND = 0.0254, 6894.757293, 4.4482216153


def contact(ratio, modulus=230e9):
    return EllipticContact(rolling_radius=4e-3, groove_radius=4e-3 * ratio, combined_modulus=modulus)


@pytest.mark.closed_form
@pytest.mark.parametrize("ellipticity", [1.0, 1.0 + 1e-9, 1.3, 4.0, 30.0])
def test_elliptic_integrals_are_those_of_scipy(ellipticity):
    found, m = elliptic_integrals(ellipticity), (1.0 - 1.0 / ellipticity) * (1.0 + 1.0 / ellipticity)
    assert found.first == pytest.approx(ellipk(m), rel=1e-14)
    assert found.second == pytest.approx(ellipe(m), rel=1e-14)
    assert found.share * found.first == pytest.approx(ellipk(m) - ellipe(m), rel=1e-12, abs=1e-15)


@pytest.mark.closed_form
@pytest.mark.parametrize("ratio", [1.2, 2.0, 7.0, 45.0, 300.0])
def test_the_ellipse_obeys_its_equation(ratio):
    kappa = contact(ratio).ellipticity
    K, E = ellipk(1.0 - kappa**-2), ellipe(1.0 - kappa**-2)
    assert (kappa**2 * E - K) / (K - E) == pytest.approx(ratio, rel=1e-12)


@pytest.mark.closed_form
def test_equal_curvatures_make_a_circle():
    at, load = contact(1.0), 70.0
    a = (1.5 * load * 4e-3 / 230e9) ** (1.0 / 3.0)
    assert at.half_axes(load) == pytest.approx((a, a), rel=1e-12)
    assert at.approach(load) == pytest.approx(a**2 / 4e-3, rel=1e-12)
    assert at.pressure(load) == pytest.approx(1.5 * load / (math.pi * a**2), rel=1e-12)
    assert at.load_at(at.pressure(load)) == pytest.approx(load, rel=1e-12)


@pytest.mark.closed_form
def test_the_pressure_makes_the_shape_of_the_bodies():
    """By the half-space itself: the deflection under Hertz's pressure at the center and at both ends."""
    at, load = contact(9.0), 400.0
    a, b = at.half_axes(load)
    peak, approach = at.pressure(load), at.approach(load)

    def deflection(x, y):  # of an ellipsoidal pressure inside its ellipse, by rays from the point
        def along(angle):
            c, s = math.cos(angle) / a, math.sin(angle) / b
            p, q, r = c * c + s * s, y * c / a + x * s / b, 1.0 - (y / a) ** 2 - (x / b) ** 2
            return 0.5 * math.pi * peak * (r + q * q / p) / math.sqrt(p)

        return quad(along, 0.0, math.pi, epsabs=0.0, epsrel=1e-12)[0] / (0.5 * math.pi * 230e9)

    assert deflection(0.0, 0.0) == pytest.approx(approach, rel=1e-9)
    assert deflection(b, 0.0) == pytest.approx(approach - b**2 / (2.0 * 4e-3), rel=1e-9)
    assert deflection(0.0, a) == pytest.approx(approach - a**2 / (2.0 * 36e-3), rel=1e-9)


TABLE = [
    (0.1075, 1.0760, 0.9318, 0.9974),
    (0.4795, 1.4556, 0.7278, 0.9429),
    (0.6716, 1.8258, 0.6245, 0.8733),
    (0.7948, 2.265, 0.5480, 0.7961),
    (0.87366, 2.800, 0.4863, 0.7169),
    (0.93657, 3.738, 0.4166, 0.6112),
    (0.97290, 5.267, 0.3490, 0.4960),
    (0.990902, 8.062, 0.2814, 0.3745),
    (0.99730, 12.789, 0.2232, 0.2705),
    (0.9989156, 17.974, 0.18822, 0.2106),
]


@pytest.mark.literature
@pytest.mark.parametrize(("difference", "a", "b", "delta"), TABLE)
def test_dimensionless_contacts_of_harris_and_kotzalas(difference, a, b, delta):
    """Rolling Bearing Analysis, 5th edition, table 6.1, over the curvature difference."""
    at = contact((1.0 + difference) / (1.0 - difference), modulus=2.0)
    load, total = 1e-9, 1.0 / at.radius
    unit = (1.5 * load / total) ** (1.0 / 3.0)
    assert np.array(at.half_axes(load)) / unit == pytest.approx([a, b], rel=2.4e-4)
    assert at.approach(load) / (unit**2 * total / 2.0) == pytest.approx(delta, rel=3.3e-4)


@pytest.mark.literature
def test_the_inner_contact_of_harris_and_mindel():
    """Harris & Mindel (1973), figure 15, with E = 29e6 psi and nu = .25."""
    angle, ball, pitch = math.radians(29.762), 0.8125 * INCH, 6.2008 * INCH
    steel = RollingMaterial(young_modulus=29e6 * PSI, poisson_ratio=0.25, density=7800.0)
    at = EllipticContact(
        rolling_radius=1.0 / (2.0 / ball + 2.0 * math.cos(angle) / (pitch - ball * math.cos(angle))),
        groove_radius=1.0 / (2.0 / ball - 1.0 / (0.52 * ball)),
        combined_modulus=1.0 / steel.compliance,
    )
    load = 287.76 * POUND
    assert np.array(at.half_axes(load)) / INCH == pytest.approx([0.078504, 0.0089653], rel=3e-5)
    assert at.approach(load) / INCH == pytest.approx(4.0335e-4, rel=1e-5)
    assert at.pressure(load) / PSI == pytest.approx(1.9522e5, rel=1e-5)


@pytest.mark.literature
def test_the_inner_contact_of_a_6206():
    """A public notebook (endofwave), 1000 N on 9 balls, by approximations: 1.368 x .112 mm, 1728 MPa."""
    ball, pitch = 9.525e-3, 46e-3
    steel = RollingMaterial(young_modulus=210e9, poisson_ratio=0.3, density=7800.0)
    at = EllipticContact(
        rolling_radius=1.0 / (2.0 / ball + 2.0 / (pitch - ball)),
        groove_radius=1.0 / (2.0 / ball - 1.0 / 4.89e-3),
        combined_modulus=1.0 / steel.compliance,
    )
    load = 5.0 * 1000.0 / 9.0  # Stribeck's rule
    # The formulas of Hamrock and Brewe are 3 % off in the ellipticity of so close a groove.
    assert at.ellipticity == pytest.approx(12.19, rel=0.03)
    assert np.array(at.half_axes(load)) * 1e3 == pytest.approx([1.368, 0.112], rel=0.021)
    assert at.pressure(load) / 1e6 == pytest.approx(1728.0, rel=0.0105)


ZONES = [
    (0.2, 0.1590, 0.1707),
    (0.4, 0.2117, 0.2462),
    (0.5, 0.2288, 0.2782),
    (0.7, 0.2505, 0.3374),
    (0.8, 0.2559, 0.3658),
    (1.0, 0.2546, 0.4244),
    (5.0 / 3.0, 0.1871, 0.6060),
    (5.0, 0.0711, 0.8558),
]


@pytest.mark.literature
@pytest.mark.parametrize(("extent", "radial", "axial"), ZONES)
def test_load_integrals_of_harris_and_kotzalas(extent, radial, axial):
    """Rolling Bearing Analysis, 5th edition, table 7.4; the row printed 1.67 is 5/3."""
    assert load_integrals(extent) == pytest.approx((radial, axial), rel=3.4e-4)


@pytest.mark.closed_form
@pytest.mark.parametrize("extent", [0.05, 0.5, 0.9, 1.0, 3.0])
def test_load_integrals_by_quadrature(extent):
    end = math.acos(max(1.0 - 2.0 * extent, -1.0))

    def load(psi):
        return max(1.0 - (1.0 - math.cos(psi)) / (2.0 * extent), 0.0) ** 1.5 / math.pi

    found = load_integrals(extent)
    assert found.axial == pytest.approx(quad(load, 0.0, end, epsrel=1e-11)[0], rel=1e-9)
    wanted = quad(lambda psi: load(psi) * math.cos(psi), 0.0, end, epsrel=1e-11)[0]
    assert found.radial == pytest.approx(wanted, rel=1e-9)


@pytest.mark.literature
def test_stribeck_and_palmgren_by_printed_numbers():
    """NSK catalogue E728g, section 5.1, and the stiffness printed by ROSS 3.1 for its example."""
    half = load_integrals(0.5)
    assert 1.0 / half.radial == pytest.approx(4.37, abs=5e-4)
    assert half.axial / half.radial == pytest.approx(1.216, abs=5e-4)
    assert stribeck_load(load=800.0, balls=8) == pytest.approx(437.01, abs=5e-3)
    angle = math.pi / 6.0
    found = palmgren_stiffness(load=500.0, balls=8, ball_diameter=0.03, contact_angle=angle)
    assert found == pytest.approx(1.009063e8, rel=1e-6)


@pytest.mark.closed_form
def test_contacts_stiffen_as_the_groove_closes():
    stiff = [contact(ratio).stiffness for ratio in (1.0, 2.0, 8.0, 40.0)]
    assert all(one < other for one, other in pairwise(stiff))


def test_wrong_arguments_are_named():
    with pytest.raises(
        InputError, match=r"rolling_radius must not be above groove_radius 0\.001, got 0\.002"
    ):
        EllipticContact(rolling_radius=2e-3, groove_radius=1e-3, combined_modulus=1e11)
    with pytest.raises(InputError, match=r"ellipticity must be at least 1, got 0\.5"):
        elliptic_integrals(0.5)
    with pytest.raises(InputError, match=r"load must be finite and not negative, got -1\.0"):
        contact(2.0).approach(-1.0)
    with pytest.raises(InputError, match="load must be finite and not negative, got nan"):
        contact(2.0).pressure(math.nan)
    with pytest.raises(InputError, match=r"contact_angle must be at least 0 and below 90 deg, got 2\.0 rad"):
        palmgren_stiffness(load=1.0, balls=8, ball_diameter=0.01, contact_angle=2.0)
    with pytest.raises(InputError, match="contact_angle must be a single finite number, got nan"):
        stribeck_load(load=1.0, balls=8, contact_angle=math.nan)
    with pytest.raises(InputError, match="extent must be finite and positive, got 0"):
        load_integrals(0.0)
    with pytest.raises(InputError, match=r"poisson_ratio must be above -1 and at most 0\.5, got 0\.7"):
        RollingMaterial(young_modulus=2e11, poisson_ratio=0.7, density=7800.0)
