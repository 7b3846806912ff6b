"""Rotors of Friswell, Penny, Garvey & Lees, Dynamics of Rotating Machines (2010), chapters 5 and 6.

The numbers are those that ROSS (https://github.com/petrobras/ross, commit 631a249) quotes from the book in
`ross/tests/test_examples.py`, or prints for the example in `docs/user_guide`; the docstrings say which.
Printed digits may be cut, not rounded: the tolerance is one unit of the last place. Modes of torsion, at
650.41 rad/s or 103.52 Hz, are in the lists of ROSS and left out here.
"""

import numpy as np
import pytest
from numpy.testing import assert_allclose

from rotorfilm import LinearBearing
from rotorfilm.analysis import critical_speeds, rotor_modes
from rotorfilm.rotors import ClassicalBeam, Disk, ElasticMaterial, ShaftElement, ShaftRotor, Station

pytestmark = pytest.mark.literature

STEEL = ElasticMaterial(young_modulus=211e9, shear_modulus=81.2e9, density=7810.0)
RPM, HERTZ = np.pi / 30.0, 2.0 * np.pi
DISK = {"density": 7810.0, "width": 0.07, "inner_diameter": 0.05}


def rotor(pieces=6, load=None, **changes):
    """Section 5.9: 1.5 m x 50 mm, disks at thirds, bearings at both ends."""
    whole = ShaftElement(length=1.5, outer_diameter=0.05, material=STEEL, **(load or {}))
    third = pieces // 3
    parts = {
        "elements": whole.split(pieces),
        "disks": (
            Disk.solid(third, outer_diameter=0.28, **DISK),
            Disk.solid(2 * third, outer_diameter=0.35, **DISK),
        ),
        "stations": (Station(node=0, name="left"), Station(node=pieces, name="right")),
        "speed": 0.0,
        "beam": ClassicalBeam(),
    }
    return ShaftRotor(**(parts | changes))


def roots(model, bearing, speed, count):
    modes = rotor_modes(model, dict.fromkeys(model.structure.stations, bearing), speed)
    return modes.eigenvalues[:count]


@pytest.mark.parametrize(
    ("speed", "printed"),
    [(0.0, [86.66, 86.66, 274.31, 274.31, 716.78]), (4000.0, [85.39, 87.80, 251.78, 294.71, 600.18])],
)
def test_591_isotropic(speed, printed):
    """test_examples.py, rad/s, two decimals."""
    found = roots(rotor(), LinearBearing(stiffness=1e6), speed * RPM, 5)
    assert_allclose(np.abs(found), printed, atol=0.01)


@pytest.mark.parametrize(
    ("speed", "printed"),
    [(0.0, [82.65, 86.66, 254.52, 274.31, 679.49]), (4000.0, [82.33, 86.86, 239.64, 287.25, 583.49])],
)
def test_592_anisotropic(speed, printed):
    """test_examples.py, rad/s, two decimals; six elements, though that test takes 48."""
    bearing = LinearBearing(stiffness=((1e6, 0.0), (0.0, 0.8e6)))
    assert_allclose(np.abs(roots(rotor(), bearing, speed * RPM, 5)), printed, atol=0.01)


def test_593_mixed_modes():
    """test_examples.py, Hz at 4000 rpm, four digits: that test divides them by 2 pi and allows 100 %."""
    bearing = LinearBearing(stiffness=((1e6, 0.0), (0.0, 0.2e6)))
    found = np.abs(roots(rotor(), bearing, 4000.0 * RPM, 6)) / HERTZ
    assert_allclose(found, [8.545, 13.77, 22.35, 44.06, 78.76, 120.4], rtol=6e-4)


def test_594_cross_coupling_is_at_rest_what_is_quoted_for_4000_rpm():
    """test_examples.py, Hz, two decimals, labelled 4000 rpm there, with kxy alone, and 100 % allowed.

    They are those at rest with kxy = kyx = 0.5 MN/m: principal stiffnesses 1.5 and 0.5 MN/m, so that each
    pair is that of two planes, which no gyroscopic effect ties together.
    """
    quoted = [11.66, 14.80, 33.97, 49.19, 97.97, 126.61]
    bearing = LinearBearing(stiffness=((1e6, 0.5e6), (0.5e6, 1e6)))
    rest = np.abs(roots(rotor(), bearing, 0.0, 6)) / HERTZ
    assert_allclose(rest, quoted, atol=0.01)
    planes = [np.abs(roots(rotor(), LinearBearing(stiffness=k), 0.0, 6))[::2] for k in (0.5e6, 1.5e6)]
    assert_allclose(np.sort(np.concatenate(planes)) / HERTZ, rest, rtol=1e-8)
    turning = np.abs(roots(rotor(), bearing, 4000.0 * RPM, 6)) / HERTZ
    assert np.abs(turning / quoted - 1.0).max() > 0.05


@pytest.mark.parametrize(
    ("speed", "natural", "damped"),
    [
        (0.0, [13.91, 13.91, 48.18, 48.18, 137.06, 137.06], [13.89, 13.89, 46.54, 46.54, 103.22, 103.22]),
        (4000.0, [13.70, 14.09, 43.61, 52.18, 122.37], [13.68, 14.07, 41.98, 50.65, 104.25]),
    ],
)
def test_595_damped(speed, natural, damped):
    """test_examples.py, Hz, two decimals."""
    found = roots(rotor(), LinearBearing(stiffness=1e6, damping=3e3), speed * RPM, len(natural))
    assert_allclose(np.abs(found) / HERTZ, natural, atol=0.01)
    assert_allclose(found.imag / HERTZ, damped, atol=0.01)


@pytest.mark.parametrize(
    ("load", "rest", "turning"),
    [
        (
            {},
            [13.792067, 43.658247, 114.080085],
            [13.590156, 13.973146, 40.072764, 46.905083, 95.521512, 131.633132],
        ),
        (
            {"axial_force": 1e4},
            [13.935788, 43.913150, 114.759565],
            [13.739728, 14.111493, 40.330147, 47.154123, 96.087639, 132.403364],
        ),
        (
            {"axial_force": 1e5},
            [15.020440, 46.132265, 120.620287],
            [14.867629, 15.156882, 42.570013, 49.325073, 100.969101, 139.063735],
        ),
        (
            {"axial_force": -1e4},
            [13.642635, 43.401542, 113.394556],
            [13.434622, 13.829336, 39.813547, 46.654356, 94.950323, 130.856441],
        ),
        (
            {"torque": 5e4},
            [13.661623, 43.307680, 113.826845],
            [13.439273, 13.860259, 39.718828, 46.569549, 95.179280, 131.621534],
        ),
        (
            {"torque": 1e5},
            [13.233779, 42.238874, 113.060004],
            [12.943261, 13.491418, 38.646459, 45.543484, 94.143329, 131.621623],
        ),
    ],
)
def test_597_axial_force_and_torque(load, rest, turning):
    """User guide, example 22, damped frequencies in Hz, six decimals, at 0 and 4000 rpm."""
    bearing = LinearBearing(stiffness=1e6)
    found = roots(rotor(load=load), bearing, 0.0, 6).imag / HERTZ
    assert_allclose(found, np.repeat(rest, 2), atol=2e-6, rtol=2e-6)
    found = roots(rotor(load=load), bearing, 4000.0 * RPM, 6).imag / HERTZ
    assert_allclose(found, turning, atol=2e-6, rtol=2e-6)


@pytest.mark.parametrize(
    ("speed", "printed"),
    [
        (0.0, [90.14, 90.14, 630.73, 630.73, 830.43, 830.43]),
        (4000.0, [76.19, 103.91, 565.99, 634.23, 647.75, 1174.2]),
    ],
)
def test_599_overhung(speed, printed):
    """test_examples.py, rad/s, five digits."""
    overhung = rotor(
        disks=(Disk.solid(6, outer_diameter=0.35, **DISK),),
        stations=(Station(node=0, name="left"), Station(node=4, name="right")),
    )
    found = roots(overhung, LinearBearing(stiffness=1e7), speed * RPM, 6)
    assert_allclose(np.abs(found), printed, atol=0.01)


# Bearing and support characteristics, table 6.3: kxx, kyy [MN/m], c [kN s/m].
CASES = {1: (10, 10, 0), 2: (10, 20, 0), 3: (10, 20, 60), 4: (10, 20, 400), 5: (0.2, 0.4, 0)}


def overhung_681():
    """Example 6.8.1: 1.5 m x 25 mm, bearings at 0 and 1 m, a disk at the free end; Poisson's ratio 0.3."""
    steel = ElasticMaterial(young_modulus=211e9, shear_modulus=211e9 / 2.6, density=7810.0)
    return ShaftRotor(
        elements=ShaftElement(length=1.5, outer_diameter=0.025, material=steel).split(6),
        disks=(Disk(node=6, mass=15.3, diametral_inertia=0.062, polar_inertia=0.120),),
        stations=(Station(node=0, name="left"), Station(node=4, name="right")),
        speed=0.0,
        beam=ClassicalBeam(),
    )


def bearing_681(case):
    kxx, kyy, c = CASES[case]
    return LinearBearing(stiffness=((kxx * 1e6, 0.0), (0.0, kyy * 1e6)), damping=c * 1e3)


@pytest.mark.parametrize(
    ("speed", "left", "right", "printed"),
    [
        (0, 1, 1, [44.322j, 44.322j, 397.537j, 397.537j]),
        (0, 2, 2, [44.322j, 44.408j, 397.537j, 400.142j]),
        (0, 2, 3, [-0.038 + 44.332j, -0.010 + 44.409j, -1.219 + 400.564j, -0.850 + 401.182j]),
        (0, 2, 4, [-0.066 + 44.438j, -0.038 + 44.442j, -0.211 + 401.037j, -0.209 + 401.849j]),
        (0, 5, 5, [37.630j, 40.664j, 226.242j, 281.853j]),
        (1000, 1, 1, [42.250j, 46.404j, 389.801j, 402.327j]),
        (1000, 2, 3, [-0.020 + 42.292j, -0.028 + 46.460j, -0.617 + 391.899j, -1.358 + 406.609j]),
        (2000, 2, 3, [-0.017 + 40.243j, -0.033 + 48.539j, -0.189 + 377.688j, -1.607 + 410.454j]),
        (3000, 2, 3, [-0.014 + 38.241j, -0.039 + 50.592j, 356.968j, -1.788 + 413.175j]),
    ],
)
def test_681_overhung_in_bearings_and_supports(speed, left, right, printed):
    """User guide, example 25, eigenvalues in 1/s, three decimals."""
    model = overhung_681()
    modes = rotor_modes(model, {"left": bearing_681(left), "right": bearing_681(right)}, speed * RPM)
    found = modes.eigenvalues[np.argsort(np.abs(modes.eigenvalues))][:4]
    wanted = np.array(printed)
    order = [int(np.argmin(np.abs(found - w))) for w in wanted]
    assert_allclose(found[order], wanted, atol=0.0015)


@pytest.mark.long
def test_691_critical_speeds():
    """User guide, example 25 (after example 6.9.1), rpm, two decimals: case 5 at both bearings."""
    model, bearing = overhung_681(), bearing_681(5)
    found = critical_speeds(model, {"left": bearing, "right": bearing}, np.linspace(50.0, 3500.0, 70) * RPM)
    printed = [358.43, 389.35, 2123.79, 2659.10, 3118.14]
    assert_allclose([one.speed / RPM for one in found][:5], printed, atol=0.01)
