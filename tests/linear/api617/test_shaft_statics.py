"""Sag, shear force and bending moment of shafts, against beam theory."""

import math
from dataclasses import replace

import numpy as np
import pytest

import rotorfilm as rf
from rotorfilm.analysis.unbalance_margins import _extrapolated
from rotorfilm.core import carries_load

STEEL = rf.ElasticMaterial(young_modulus=2.1e11, shear_modulus=8e10, density=7800.0)
LENGTH, DIAMETER = 2.0, 0.1
AREA = math.pi * DIAMETER**2 / 4.0
BENDING = STEEL.young_modulus * math.pi * DIAMETER**4 / 64.0
WEIGHT = STEEL.density * AREA * 9.80665
BAR = rf.ShaftElement(length=LENGTH, outer_diameter=DIAMETER, material=STEEL, shear_coefficient=math.inf)


def shaft(left=0, right=8, disks=(), piece=BAR, **options):
    stations = (rf.Station(node=left, name="left"), rf.Station(node=right, name="right"))
    options = {"beam": rf.ClassicalBeam(), "speed": 0.0} | options
    return rf.ShaftRotor(elements=piece.split(8), stations=stations, disks=disks, **options)


@pytest.mark.closed_form
def test_a_shaft_on_both_ends_under_its_own_weight():
    found = rf.shaft_statics(shaft())
    z = found.places
    # bent downwards: M = -q z (l - z) / 2 towards +y, V = -dM/dz
    np.testing.assert_allclose(found.bending_moment[1], WEIGHT * z * (LENGTH - z) / 2.0, atol=1e-8 * WEIGHT)
    np.testing.assert_allclose(found.shear_force[1], -WEIGHT * (LENGTH / 2.0 - z), atol=1e-8 * WEIGHT)
    z = found.positions
    sag = WEIGHT * z * (LENGTH**3 - 2.0 * LENGTH * z**2 + z**3) / (24.0 * BENDING)
    np.testing.assert_allclose(found.sag[1], -sag, atol=1e-12)
    np.testing.assert_allclose(found.sag[0], 0.0, atol=1e-18)
    for name in ("left", "right"):
        np.testing.assert_allclose(found.loads[name], [0.0, -WEIGHT * LENGTH / 2.0], atol=1e-8)


@pytest.mark.closed_form
@pytest.mark.parametrize("beam", [rf.ClassicalBeam(), rf.rotors.FourthOrderBeam()])
def test_disks_and_overhang_by_statics(beam):
    """The moment of all that lies to the left of a place, cut by hand."""
    disks = (rf.Disk(node=3, mass=200.0), rf.Disk(node=8, mass=50.0))
    piece = rf.ShaftElement(length=LENGTH, outer_diameter=DIAMETER, material=STEEL)
    found = rf.shaft_statics(shaft(1, 6, disks, piece, beam=beam))
    g, a, b = 9.80665, LENGTH / 8.0, 6.0 * LENGTH / 8.0
    points = {3.0 * LENGTH / 8.0: 200.0 * g, LENGTH: 50.0 * g}
    moment = WEIGHT * LENGTH * (LENGTH / 2.0 - a) + sum(p * (z - a) for z, p in points.items())
    right = moment / (b - a)
    left = WEIGHT * LENGTH + sum(points.values()) - right
    assert found.loads["right"][1] == pytest.approx(-right, rel=1e-9)
    forces = {**{z: -p for z, p in points.items()}, a: left, b: right}
    for k, z in enumerate(found.places):
        inside = z - 1e-9 if k % 2 else z + 1e-9
        before = {place: force for place, force in forces.items() if place < inside}
        shear = -sum(before.values()) + WEIGHT * z
        bent = sum(force * (z - place) for place, force in before.items()) - WEIGHT * z**2 / 2.0
        assert found.shear_force[1, k] == pytest.approx(shear, abs=1e-5)
        assert found.bending_moment[1, k] == pytest.approx(bent, abs=1e-5)


@pytest.mark.closed_form
def test_on_springs_the_shaft_sinks_by_its_loads():
    rotor = shaft(gravity=(3.0, -4.0))
    springs = dict.fromkeys(("left", "right"), rf.LinearBearing(stiffness=1e8))
    soft, rigid = rf.shaft_statics(rotor, springs, 0.0), rf.shaft_statics(rotor)
    sunk = rotor.mass / 2.0 / 1e8 * np.array([3.0, -4.0])
    np.testing.assert_allclose(soft.sag - rigid.sag, np.outer(sunk, np.ones(9)), rtol=1e-6)
    np.testing.assert_allclose(soft.bending_moment, rigid.bending_moment, atol=1e-5)


@pytest.mark.closed_form
def test_tension_straightens():
    """A string in tension T, nearly: sag towards q z (l - z) / (2 T) for T l^2 >> E I."""
    thin = replace(BAR, outer_diameter=0.01, axial_force=1e5)
    found = rf.shaft_statics(shaft(piece=thin))
    weight, middle = WEIGHT / 100.0, 4
    k = math.sqrt(1e5 / (BENDING / 1e4))
    string = weight * LENGTH**2 / (8.0 * 1e5)
    beam = weight / (1e5 * k**2) * (1.0 - 1.0 / math.cosh(k * LENGTH / 2.0))
    assert -found.sag[1, middle] == pytest.approx(string - beam, rel=2e-3)


SEAL = rf.AnnularSeal(
    radius=0.06, length=0.02, clearance=3e-4, pressure_drop=6e5, viscosity=1e-3, density=1000.0
)


@pytest.mark.closed_form
def test_stations_of_seals_hold_nothing():
    """Named, the bearings alone carry the bar, as without the stations of its seals."""
    seals = (rf.Station(node=4, name="wear_ring"), rf.Station(node=6, name="throttle"))
    sealed = replace(shaft(), stations=(*shaft().stations, *seals))
    found, bare = rf.shaft_statics(sealed, supports=["left", "right"]), rf.shaft_statics(shaft())
    assert set(found.loads) == {"left", "right"}
    assert found.loads["left"][1] == pytest.approx(-WEIGHT * LENGTH / 2.0, rel=1e-9)
    np.testing.assert_allclose(found.sag, bare.sag, atol=1e-14)
    with pytest.raises(rf.InputError, match=r"supports must be among .*, got \['middle'\]"):
        rf.shaft_statics(sealed, supports=["left", "middle"])


def test_what_carries_a_load():
    """A seal does not, nor two of them; springs or a bearing beside one do."""
    light, spring = replace(SEAL, added_mass=False), rf.LinearBearing(stiffness=1e8)
    carrying = [spring, rf.with_springs(light, 1e7), rf.Parallel((spring, SEAL))]
    assert [carries_load(one) for one in (*carrying, SEAL, rf.Parallel((SEAL, light)))] == [
        *(True, True, True),
        *(False, False),
    ]


def test_seals_alone_do_not_carry_a_shaft():
    with pytest.raises(rf.InputError, match=r"must hold one that carries a load, got seals only at \['left'"):
        rf.shaft_statics(shaft(), dict.fromkeys(("right", "left"), SEAL), 100.0)
    springs = dict.fromkeys(("right", "left"), rf.LinearBearing(stiffness=1e8))
    with pytest.raises(rf.InputError, match="supports must be None beside bearings"):
        rf.shaft_statics(shaft(), springs, 100.0, ["left"])


def test_what_does_not_hold_and_two_on_a_node():
    one = replace(shaft(), stations=(rf.Station(node=4, name="only"),))
    with pytest.raises(rf.InputError, match="stations must hold the rotor"):
        rf.shaft_statics(one)
    with pytest.raises(rf.InputError, match="on different nodes"):
        rf.shaft_statics(shaft(2, 2))


@pytest.mark.closed_form
def test_modes_of_a_free_shaft():
    """cosh(b l) cos(b l) = 1: b l = 4.7300, 7.8532, 10.9956."""
    rotor = replace(shaft(), stations=(), gravity=(0.0, 0.0), elements=BAR.split(16))
    # a slender shaft: rotary inertia changes the third by 4e-3 at l / d = 20
    thin = replace(rotor, elements=replace(BAR, outer_diameter=2e-3).split(36))
    found = rf.rotor_modes(thin, {}, 0.0).frequency[::2][:3]
    speed = math.sqrt(STEEL.young_modulus / STEEL.density) * 2e-3 / 4.0 / LENGTH**2
    np.testing.assert_allclose(np.sqrt(found / speed), [4.730040745, 7.853204624, 10.995607838], rtol=3e-5)


@pytest.mark.convergence
@pytest.mark.parametrize(("beam", "count"), [(rf.ClassicalBeam(), 8), (rf.rotors.FourthOrderBeam(), 4)])
def test_mesh_convergence_measures_the_order_of_the_element(beam, count):
    """A stubby shaft that shears, on hinges: its exact frequency is what the estimate is for."""
    piece = rf.ShaftElement(length=0.6, outer_diameter=0.1, material=STEEL)
    ends = (rf.Station(node=0, name="left"), rf.Station(node=count, name="right"))
    rotor = rf.ShaftRotor(
        elements=piece.split(count), stations=ends, speed=0.0, beam=beam, gravity=(0.0, 0.0)
    )
    stiff = dict.fromkeys(("left", "right"), rf.LinearBearing(stiffness=3e14))
    found = rf.analysis.mesh_convergence(rotor, stiff, 0.0, 1)
    assert found.elements.tolist() == [count, 2 * count, 4 * count]
    assert found.order == pytest.approx(beam.order, abs=0.1)
    kappa = 6.0 * (1.0 + STEEL.poisson_ratio) / (7.0 + 6.0 * STEEL.poisson_ratio)
    r2, b = (0.1 / 4.0) ** 2, math.pi / 0.6
    e, g = STEEL.young_modulus / STEEL.density, kappa * STEEL.shear_modulus / STEEL.density
    # w^4 r2 / g - w^2 (1 + r2 b^2 (1 + E / (kappa G))) + e r2 b^4 = 0
    middle = 1.0 + r2 * b**2 * (1.0 + e / g)
    exact = math.sqrt((middle - math.sqrt(middle**2 - 4.0 * r2 / g * e * r2 * b**4)) / (2.0 * r2 / g))
    assert found.estimate == pytest.approx(exact, rel=2e-6)
    assert found.relative_error == pytest.approx(found.frequency[0] / exact - 1.0, rel=0.05)
    with pytest.raises(rf.InputError, match="mode must be at most"):
        rf.analysis.mesh_convergence(rotor, stiff, 0.0, 999)


@pytest.mark.closed_form
def test_only_what_converges_is_extrapolated():
    assert _extrapolated([1.25, 1.0625, 1.015625], 1e-11) == pytest.approx((2.0, 1.0))
    for diverging in ([1.0, 2.0, 4.0], [1.0, 2.0, 3.0], [1.0, 2.0, 1.5]):
        order, limit = _extrapolated(diverging, 1e-11)
        assert math.isnan(order)
        assert limit == diverging[-1]
