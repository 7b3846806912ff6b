"""Shafts along and about their axis, against rods."""

import math
from dataclasses import replace

import numpy as np
import pytest
from scipy.optimize import brentq

import rotorfilm as rf

STEEL = rf.ElasticMaterial(young_modulus=2.1e11, shear_modulus=8e10, density=7800.0)
LENGTH, DIAMETER = 1.5, 0.08
AREA = math.pi * DIAMETER**2 / 4.0
POLAR = math.pi * DIAMETER**4 / 32.0
WAVE, TWIST = math.sqrt(2.1e11 / 7800.0), math.sqrt(8e10 / 7800.0)
BAR = rf.ShaftElement(length=LENGTH, outer_diameter=DIAMETER, material=STEEL)


def shaft(pieces=8, **parts):
    return rf.ShaftRotor(elements=BAR.split(pieces), speed=0.0, **parts)


@pytest.mark.closed_form
@pytest.mark.parametrize(
    ("modes", "speed"), [(rf.analysis.axial_modes, WAVE), (rf.analysis.torsional_modes, TWIST)]
)
def test_free_rod(modes, speed):
    """w_n = n pi c / l, and the motion as a whole."""
    found = modes(shaft(32), count=4)
    np.testing.assert_allclose(found.frequency, np.arange(4) * math.pi * speed / LENGTH, rtol=2e-5)
    np.testing.assert_allclose(np.abs(found.shapes[:, 0]), 1.0)
    np.testing.assert_allclose(found.damping_ratio, 0.0, atol=1e-9)
    middle = np.cos(math.pi * np.arange(33) / 32.0)
    np.testing.assert_allclose(np.abs(found.shapes[:, 1]), np.abs(middle), atol=1e-4)


@pytest.mark.closed_form
def test_rod_on_a_thrust_bearing_with_a_mass_at_the_end():
    """E A b (k - m w^2) / ... : tan of the rod between a spring and a mass."""
    k, m, ea = 3e8, 40.0, 2.1e11 * AREA
    rotor = shaft(16, disks=(rf.Disk(node=16, mass=m),))
    found = rf.analysis.axial_modes(rotor, [rf.analysis.AxialSpring(node=0, stiffness=k)], 3).frequency

    def closed(w):
        # u = A cos bz + B sin bz: E A b B = k A at 0, E A u'(l) = m w^2 u(l)
        b = w / WAVE
        a, c = 1.0, k / (ea * b)
        slope = ea * b * (-a * math.sin(b * LENGTH) + c * math.cos(b * LENGTH))
        return slope - m * w**2 * (a * math.cos(b * LENGTH) + c * math.sin(b * LENGTH))

    grid = np.linspace(10.0, 3e4, 3000)
    signs = np.array([closed(w) for w in grid])
    changes = np.flatnonzero(signs[1:] * signs[:-1] < 0.0)
    roots = [brentq(closed, grid[k], grid[k + 1]) for k in changes[:3]]
    np.testing.assert_allclose(found, roots, rtol=3e-5)


@pytest.mark.closed_form
def test_a_stiff_shaft_is_a_mass_on_the_spring_and_damper_of_its_bearing():
    k, c = 1e6, 2e3
    rotor = shaft(2, disks=(rf.Disk(node=1, mass=500.0),))
    bearing = rf.analysis.AxialSpring(node=1, stiffness=k, damping=c)
    found = rf.analysis.axial_modes(rotor, [bearing], 1)
    natural = math.sqrt(k / rotor.mass)
    assert np.abs(found.eigenvalues[0]) == pytest.approx(natural, rel=1e-4)
    assert found.damping_ratio[0] == pytest.approx(c / (2.0 * rotor.mass * natural), rel=1e-4)
    w = np.array([20.0, 44.0, 100.0])
    response = rf.analysis.axial_response(rotor, [bearing], w, 1)
    wanted = 1.0 / (k - rotor.mass * w**2 + 1j * w * c)
    np.testing.assert_allclose(response.frdata[1, 0], wanted, rtol=1e-3)
    assert response.output_labels == ["z_0", "z_1", "z_2"]


@pytest.mark.closed_form
def test_disk_on_a_shaft_that_twists():
    """A heavy disk on a clamped shaft: w = sqrt(G J / (l (I + rho J l / 3)))."""
    rotor = shaft(8, disks=(rf.Disk(node=8, mass=1.0, polar_inertia=50.0),))
    found = rf.analysis.torsional_modes(
        rotor, [rf.analysis.TorsionalSpring(node=0, stiffness=1e14)], 1
    ).frequency[0]
    inertia = 50.0 + 7800.0 * POLAR * LENGTH / 3.0
    assert found == pytest.approx(math.sqrt(8e10 * POLAR / LENGTH / inertia), rel=1e-5)


@pytest.mark.convergence
def test_frequencies_are_of_fourth_order():
    exact = 3.0 * math.pi * WAVE / LENGTH
    errors = [rf.analysis.axial_modes(shaft(n), count=4).frequency[3] / exact - 1.0 for n in (6, 12, 24)]
    orders = np.log2(np.array(errors[:-1]) / errors[1:])
    np.testing.assert_allclose(orders, 4.0, atol=0.15)


@pytest.mark.closed_form
def test_static_thrust():
    """A force at the end goes through the shaft into the bearing at node 2."""
    bearing = rf.analysis.AxialSpring(node=2, stiffness=2e8)
    found = rf.analysis.axial_statics(shaft(8), [bearing], {8: 1e5, 0: -3e4})
    assert found.thrust == pytest.approx([7e4], rel=1e-9)
    np.testing.assert_allclose(found.tension, [3e4, 3e4, *[1e5] * 6], rtol=1e-8)
    sunk, piece = 7e4 / 2e8, LENGTH / 8.0 / (2.1e11 * AREA)
    wanted = [sunk - 3e4 * (2 - k) * piece if k < 2 else sunk + 1e5 * (k - 2) * piece for k in range(9)]
    np.testing.assert_allclose(found.displacement, wanted, rtol=1e-8)


def test_a_thrust_bearing_whose_load_is_roundoff_is_refused():
    with pytest.raises(rf.EquilibriumError, match="bearings must be stiff enough to hold the shaft"):
        rf.analysis.axial_statics(shaft(8), [rf.analysis.AxialSpring(node=2, stiffness=1e-6)], {8: 1e5})


@pytest.mark.closed_form
def test_tension_stiffens_the_bending():
    """w^2 = (pi / l)^4 EI / (rho A) + (pi / l)^2 T / (rho A) of a slender shaft on hinges."""
    thin = rf.ShaftElement(length=2.0, outer_diameter=0.01, material=STEEL, shear_coefficient=math.inf)
    ends = (rf.Station(node=0, name="a"), rf.Station(node=8, name="b"))
    rotor = rf.ShaftRotor(
        elements=thin.split(8), stations=ends, speed=0.0, gravity=(0.0, 0.0), beam=rf.ClassicalBeam()
    )
    pull = rf.analysis.axial_statics(rotor, [rf.analysis.AxialSpring(node=0, stiffness=1e9)], {8: 500.0})
    stiff = dict.fromkeys("ab", rf.LinearBearing(stiffness=1e9))
    found = rf.rotor_modes(rf.analysis.stress_stiffened(rotor, pull), stiff, 0.0).frequency[0]
    area, b = math.pi * 0.01**2 / 4.0, math.pi / 2.0
    bending = 2.1e11 * math.pi * 0.01**4 / 64.0
    assert found == pytest.approx(math.sqrt((b**4 * bending + b**2 * 500.0) / (7800.0 * area)), rel=1e-4)


@pytest.mark.closed_form
def test_cones_and_layers_have_their_sections():
    """A cone under a force: elongation F l / (E A_0 r), r the ratio of the end diameters."""
    cone = replace(BAR, end_outer_diameter=0.05)
    rotor = rf.ShaftRotor(elements=cone.split(8), speed=0.0)
    found = rf.analysis.axial_statics(rotor, [rf.analysis.AxialSpring(node=0, stiffness=1e15)], {8: 1e5})
    assert found.displacement[-1] == pytest.approx(1e5 * LENGTH / (2.1e11 * AREA * 0.05 / 0.08), rel=1e-5)
    sleeve = replace(BAR, inner_diameter=DIAMETER, outer_diameter=0.1)
    whole = rf.ShaftRotor(elements=(rf.rotors.LayeredElement(layers=(BAR, sleeve)),), speed=0.0)
    thick = rf.ShaftRotor(elements=(replace(BAR, outer_diameter=0.1),), speed=0.0)
    for modes in (rf.analysis.axial_modes, rf.analysis.torsional_modes):
        np.testing.assert_allclose(modes(whole).frequency, modes(thick).frequency, rtol=1e-9, atol=1e-9)


@pytest.mark.closed_form
def test_couplings_are_springs_in_the_line():
    """Two heavy ends on a coupling: w^2 = k (1 / m + 1 / m)."""
    link = rf.Coupling(stiffness=1e8, tilt_stiffness=1e5, axial_stiffness=4e6, twist_stiffness=3e4)
    short = replace(BAR, length=0.01)
    rotor = rf.ShaftRotor(
        elements=(short, link, short),
        disks=tuple(rf.Disk(node=k, mass=900.0, polar_inertia=7.0) for k in (1, 2)),
        speed=0.0,
    )
    half = 900.0 + 7800.0 * AREA * 0.01
    assert rf.analysis.axial_modes(rotor).frequency[1] == pytest.approx(math.sqrt(8e6 / half), rel=1e-4)
    half = 7.0 + 7800.0 * POLAR * 0.01
    assert rf.analysis.torsional_modes(rotor).frequency[1] == pytest.approx(math.sqrt(6e4 / half), rel=1e-4)
    bare = replace(rotor, elements=(short, rf.Coupling(stiffness=1e8, tilt_stiffness=1e5), short))
    with pytest.raises(rf.InputError, match="axial_stiffness must be given of the coupling behind node 1"):
        rf.analysis.axial_modes(bare)


@pytest.mark.closed_form
@pytest.mark.parametrize("damping", [0.0, 1e-9, 1.0])
def test_one_very_short_element_hides_no_mode(damping):
    """Two disks on a shaft with an element of .02 mm: w^2 = 2 k / (I + a sixth of the shaft's)."""
    pieces = [replace(BAR, length=length, outer_diameter=0.05) for length in (0.6, 2e-5, 0.6)]
    ends = [rf.Disk(node=k, mass=90.0, polar_inertia=5.0, diametral_inertia=3.0) for k in (0, 3)]
    rotor = rf.ShaftRotor(elements=tuple(pieces), disks=tuple(ends), speed=0.0)
    polar = math.pi * 0.05**4 / 32.0
    wanted = math.sqrt(2.0 * 8e10 * polar / 1.20002 / (5.0 + 7800.0 * polar * 1.20002 / 6.0))
    found = rf.analysis.torsional_modes(
        rotor, [rf.analysis.TorsionalSpring(node=0, stiffness=0.0, damping=damping)], 3
    )
    assert found.eigenvalues[0] == 0.0
    assert found.frequency[1] == pytest.approx(wanted, rel=1e-5)
    assert found.frequency[2] == pytest.approx(math.pi * TWIST / 1.20002, rel=1e-2)


def test_bad_thrust():
    bearing = rf.analysis.AxialSpring(node=9, stiffness=1e8)
    with pytest.raises(rf.InputError, match="node 0 to 8"):
        rf.analysis.axial_modes(shaft(), [bearing])
    with pytest.raises(rf.InputError, match="bearings must hold the shaft"):
        rf.analysis.axial_statics(shaft(), [], {0: 1.0})
    with pytest.raises(rf.InputError, match="forces must be on a node"):
        rf.analysis.axial_statics(shaft(), [replace(bearing, node=0)], {11: 1.0})
    with pytest.raises(rf.InputError, match="stiffness must be finite and not negative"):
        rf.analysis.AxialSpring(node=0, stiffness=-1.0)
