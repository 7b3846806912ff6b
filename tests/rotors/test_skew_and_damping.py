"""Skewed disks, bowed shafts, proportional and modal damping, against rigid disks and Jeffcott rotors."""

import math
from dataclasses import replace

import numpy as np
import pytest

import rotorfilm as rf

LIGHT = rf.ElasticMaterial(young_modulus=2e11, shear_modulus=8e10, density=0.01)
SPEEDS = np.array([50.0, 200.0, 350.0, 700.0])


@pytest.mark.closed_form
@pytest.mark.parametrize(("diametral", "polar"), [(2.0, 3.0), (3.0, 1.0)])
def test_skew_of_a_rigid_disk_on_a_tilt_spring(diametral, polar):
    """(k - w^2 (I_d - I_p)) tilt = (I_d - I_p) w^2 skew, in forward circles."""
    length, k, skew, angle = 0.01, 4e5, 1e-4, 0.7
    rotor = rf.ShaftRotor(
        elements=(rf.ShaftElement(length=length, outer_diameter=0.2, material=LIGHT),),
        stations=(rf.Station(node=0, name="hinge"),),
        disks=(
            rf.Disk(
                node=0,
                mass=50.0,
                diametral_inertia=diametral,
                polar_inertia=polar,
                skew=skew,
                skew_angle=angle,
            ),
        ),
        tilt_springs=(rf.rotors.TiltSpring(node=0, stiffness=k),),
        probes=(rf.Probe(node=1, name="rim"),),
        speed=0.0,
        beam=rf.ClassicalBeam(),
    )
    found = rf.unbalance_response(rotor, {"hinge": rf.LinearBearing(stiffness=1e10)}, SPEEDS)
    x, y = (np.asarray(found.frdata)[list(found.output_labels).index(f"rim_{axis}"), 0] for axis in "xy")
    inertia = (diametral - polar) * SPEEDS**2
    wanted = length * inertia * skew / (k - inertia) * np.exp(1j * angle)
    np.testing.assert_allclose(x, wanted, rtol=1e-4)
    np.testing.assert_allclose(y, -1j * wanted, rtol=1e-4)


def jeffcott(damping=2e4):
    piece = rf.ShaftElement(length=1.0, outer_diameter=0.08, material=LIGHT, shear_coefficient=math.inf)
    rotor = rf.ShaftRotor(
        elements=piece.split(2),
        stations=(
            rf.Station(node=0, name="a"),
            rf.Station(node=1, name="disk"),
            rf.Station(node=2, name="b"),
        ),
        disks=(rf.Disk(node=1, mass=200.0),),
        probes=(rf.Probe(node=1, name="mid"),),
        unbalances=(rf.Unbalance(node=1, unbalance=200.0 * 2e-6),),
        speed=0.0,
        gravity=(0.0, 0.0),
        beam=rf.ClassicalBeam(),
    )
    stiff = rf.LinearBearing(stiffness=1e13)
    return rotor, {"a": stiff, "b": stiff, "disk": rf.LinearBearing(stiffness=0.0, damping=damping)}


@pytest.mark.closed_form
def test_bow_of_a_jeffcott_rotor_with_unbalance():
    """Nicholas, Gunter & Allaire (1976): (1 - s^2 + 2 i z s) q = bow + e s^2."""
    rotor, bearings = jeffcott()
    bow = 5e-6 * np.exp(1.1j)
    stiffness = 48.0 * 2e11 * math.pi * 0.08**4 / 64.0
    s, ratio = SPEEDS / math.sqrt(stiffness / 200.0), 2e4 / (2.0 * math.sqrt(stiffness * 200.0))
    bent = rf.analysis.bow_response(rotor, bearings, SPEEDS, [0.0, bow, 0.0])
    turned = rf.unbalance_response(rotor, bearings, SPEEDS)
    place = list(bent.output_labels).index("mid_x")
    assert list(turned.output_labels) == list(bent.output_labels)
    total = np.asarray(bent.frdata + turned.frdata)[place, 0]
    np.testing.assert_allclose(total, (bow + 2e-6 * s**2) / (1.0 - s**2 + 2j * ratio * s), rtol=1e-5)
    np.testing.assert_allclose(bent.frdata[place + 1, 0], -1j * bent.frdata[place, 0], rtol=1e-9)


@pytest.mark.closed_form
def test_a_slow_shaft_moves_as_it_is_bent():
    rotor, bearings = jeffcott()
    slow = rf.analysis.bow_response(rotor, bearings, [0.1], [0.0, 1e-5, 0.0])
    assert slow.frdata[list(slow.output_labels).index("mid_x"), 0, 0] == pytest.approx(1e-5, rel=2e-4)
    with pytest.raises(rf.InputError, match="bow must be 3 finite numbers"):
        rf.analysis.bow_response(rotor, bearings, [0.1], [0.0, 1e-5])


STEEL = rf.ElasticMaterial(young_modulus=2.1e11, shear_modulus=8e10, density=7800.0)
FREE = rf.ShaftRotor(
    elements=rf.ShaftElement(length=1.0, outer_diameter=0.05, material=STEEL).split(4),
    disks=(rf.Disk(node=1, mass=12.0, diametral_inertia=0.1, polar_inertia=0.2),),
    stations=(rf.Station(node=0, name="left"), rf.Station(node=4, name="right")),
    speed=0.0,
    gravity=(0.0, 0.0),
)


def ratios(rotor, bearings, count):
    found = rf.rotor_modes(rotor, bearings, 0.0).eigenvalues[: 2 * count : 2]
    return -found.real / np.abs(found), np.abs(found)


@pytest.mark.closed_form
def test_proportional_damping_of_free_modes():
    alpha, beta = 4.0, 2e-5
    found, w = ratios(replace(FREE, mass_damping=alpha, stiffness_damping=beta), {}, 3)
    np.testing.assert_allclose(found, alpha / (2.0 * w) + beta * w / 2.0, rtol=1e-6)


@pytest.mark.closed_form
def test_proportional_damping_of_elements():
    """Without disks that of all elements is that of the rotor; with one it damps no disk."""
    alpha, beta = 4.0, 2e-5
    pieces = tuple(replace(e, mass_damping=alpha, stiffness_damping=beta) for e in FREE.elements)
    found, w = ratios(replace(FREE, elements=pieces, disks=()), {}, 3)
    np.testing.assert_allclose(found, alpha / (2.0 * w) + beta * w / 2.0, rtol=1e-6)
    on_disk, w = ratios(replace(FREE, elements=pieces), {}, 1)
    shape = rf.rotor_modes(FREE, {}, 0.0).shapes[:, :1]
    whole, shaft = (one.structure.mass for one in (FREE, replace(FREE, disks=())))
    moving, own = ((shape.conj().T @ mass @ shape).real[0, 0] for mass in (whole, shaft))
    np.testing.assert_allclose(on_disk, alpha / (2.0 * w) * own / moving + beta * w / 2.0, rtol=1e-3)
    with pytest.raises(rf.InputError, match="layers must have equal mass_damping"):
        rf.rotors.LayeredElement(layers=(FREE.elements[0], pieces[0]))


@pytest.mark.closed_form
def test_modal_damping_on_bearings():
    wanted = (0.01, 0.02, 0.005)
    damped = rf.rotors.ModallyDampedRotor(
        rotor=FREE, damping_ratios=wanted, bearing_stiffness=1e7, speed=0.0, gravity=(0.0, 0.0)
    )
    springs = dict.fromkeys(("left", "right"), rf.LinearBearing(stiffness=1e7))
    found, w = ratios(damped, springs, 4)
    np.testing.assert_allclose(found, [*wanted, 0.0], atol=1e-9)
    _, bare = ratios(FREE, springs, 4)
    np.testing.assert_allclose(w, bare, rtol=1e-9)


def test_bad_damping():
    with pytest.raises(rf.InputError, match="mass_damping must be finite and not negative"):
        replace(FREE, mass_damping=-1.0)
    with pytest.raises(rf.InputError, match=r"damping_ratios\[0\] must be"):
        rf.rotors.ModallyDampedRotor(rotor=FREE, damping_ratios=(-0.1,), speed=0.0, gravity=(0.0, 0.0))
    with pytest.raises(rf.InputError, match="skew must be"):
        rf.Disk(node=0, mass=1.0, skew=math.nan)
