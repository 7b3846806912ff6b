import dataclasses
import math

import numpy as np
import pytest
from numpy.testing import assert_allclose

from rotorfilm import Dynamic, InputError
from rotorfilm.core import names
from rotorfilm.fmu.python.codec import decode, encode
from rotorfilm.rotors import (
    ClassicalBeam,
    Coupling,
    Disk,
    Probe,
    RigidRotor,
    ShaftElement,
    ShaftRotor,
    SpeedProfile,
    Station,
    Support,
    Unbalance,
)


def uniform(steel, pieces, speed, **changes):
    piece = ShaftElement(length=1.0, outer_diameter=0.08, material=steel, shear_coefficient=0.89)
    stations = (Station(node=0, name="left"), Station(node=pieces, name="right"))
    return ShaftRotor(elements=piece.split(pieces), speed=speed, stations=stations, **changes), piece


def test_it_is_a_dynamic_model_with_signals_by_station(rich_rotor):
    rotor = rich_rotor(100.0)
    assert isinstance(rotor, Dynamic)
    assert names(rotor.inputs) == ["left_force_x", "left_force_y", "force_x", "force_y"]
    motion = ["x", "y", "vx", "vy"]
    probes = ["small_x", "small_y", "large_x", "large_y"]
    ground = ["left_ground_force_x", "left_ground_force_y"]
    assert names(rotor.outputs) == [*(f"left_{m}" for m in motion), *motion, *probes, *ground, "speed"]
    assert len(rotor.states) == len(set(names(rotor.states))) == len(rotor.initial_state)


@pytest.mark.closed_form
@pytest.mark.parametrize("speed", [0.0, 3000.0, -3000.0])
def test_whirl_of_a_simply_supported_spinning_shaft_with_shear(
    steel, timoshenko, on_springs, frequencies, speed
):
    """Forward and backward whirl of three modes, against the roots of the closed form."""
    rotor, piece = uniform(steel, 16, speed)
    found = frequencies(on_springs(rotor, 1e15))
    exact = timoshenko(piece)
    wanted = np.sort(np.concatenate([np.sort(np.abs(exact.whirl(n, speed)))[:2] for n in (1, 2, 3)]))
    assert_allclose(found[:6], wanted, rtol=3e-5)
    if speed:
        assert np.all(np.diff(wanted)[::2] > 1e-3 * wanted[::2]), "the pairs are split"


@pytest.mark.closed_form
def test_gyroscopic_splitting_without_shear(steel, on_springs, frequencies):
    """(1 + r^2 b^2) p^2 - 2 r^2 b^2 speed p - b^4 EI / (rho A) = 0 with b = pi / L and r^2 = I / A."""
    speed, length, diameter = 2000.0, 1.0, 0.08
    piece = ShaftElement(length=length, outer_diameter=diameter, material=steel, shear_coefficient=math.inf)
    stations = (Station(node=0, name="left"), Station(node=12, name="right"))
    rotor = ShaftRotor(elements=piece.split(12), speed=speed, stations=stations, beam=ClassicalBeam())
    rb = (np.pi / length * diameter / 4.0) ** 2
    elastic = (np.pi / length) ** 4 * steel.young_modulus / steel.density * diameter**2 / 16.0
    wanted = np.sort(np.abs(np.roots([1.0 + rb, -2.0 * rb * speed, -elastic])))
    assert_allclose(frequencies(on_springs(rotor, 1e15))[:2], wanted, rtol=1e-5)


@pytest.mark.closed_form
def test_tilting_disk_on_a_light_overhang(steel, on_springs, frequencies):
    """A disk in the middle of a light shaft tilts without moving: I p^2 - J speed p - k = 0."""
    light = dataclasses.replace(steel, density=1e-2)
    piece = ShaftElement(length=1.0, outer_diameter=0.05, material=light, shear_coefficient=1e6)
    disk = Disk(node=2, mass=1.0, diametral_inertia=2.0, polar_inertia=3.5)
    stations = (Station(node=0, name="left"), Station(node=4, name="right"))
    rotor = ShaftRotor(
        elements=piece.split(4), speed=80.0, stations=stations, disks=(disk,), beam=ClassicalBeam()
    )
    bending = steel.young_modulus * np.pi * 0.05**4 / 64
    forward, backward = np.abs(np.roots([2.0, -3.5 * 80.0, -12.0 * bending / 1.0]))
    found = frequencies(on_springs(rotor, 1e12))
    assert_allclose([np.min(np.abs(found / w - 1.0)) for w in (forward, backward)], 0.0, atol=2e-5)


@pytest.mark.literature
@pytest.mark.parametrize(
    ("speed", "printed"),
    [(0.0, [86.66, 86.66, 274.31, 274.31, 716.78]), (4000.0, [85.39, 87.80, 251.78, 294.71, 600.18])],
)
def test_friswell_example_591(friswell_591, on_springs, frequencies, speed, printed):
    """Six classical elements, as printed; the last digit of 716.78 is cut, not rounded."""
    rotor = friswell_591(speed * np.pi / 30.0, beam=ClassicalBeam())
    assert_allclose(frequencies(on_springs(rotor, 1e6))[:5], printed, atol=0.007)
    better = friswell_591(speed * np.pi / 30.0)
    assert_allclose(frequencies(on_springs(better, 1e6))[:5], printed, rtol=4e-4)


def test_weight_is_carried_by_the_stations(rich_rotor):
    rotor = rich_rotor(0.0)
    s = rotor.structure
    assert s.weight[: len(s.weight) // 2].sum() != 0.0
    size = len(s.coordinates)
    shift = np.zeros(size)
    shift[0:14:2] = 1.0
    shift[-1] = 1.0
    total = shift @ s.weight[:size], shift @ s.weight[size:]
    assert_allclose(total, (rotor.mass + 7.0) * np.array([0.5, -9.0]), rtol=1e-12)


@pytest.mark.closed_form
def test_mass_is_that_of_the_parts(friswell_591):
    disks = np.pi / 4 * 7810.0 * 0.07 * (0.28**2 + 0.35**2 - 2 * 0.05**2)
    assert friswell_591().mass == pytest.approx(disks + 7810.0 * np.pi / 4 * 0.05**2 * 1.5, rel=1e-12)


def test_linearization_is_exact_in_state_and_force(rich_rotor):
    rotor = dataclasses.replace(rich_rotor(0.0), speed=SpeedProfile(times=(0.0, 2.0), speeds=(30.0, -90.0)))
    rng = np.random.default_rng(1)
    x, dx = 1e-4 * rng.standard_normal((2, len(rotor.states)))
    u, du = rng.standard_normal((2, 4))
    A, B, C, D = rotor.linearization(0.7, x, u)
    change = rotor.derivative(0.7, x + dx, u + du) - rotor.derivative(0.7, x, u)
    assert_allclose(change, A @ dx + B @ du, atol=1e-9 * np.abs(change).max())
    change = rotor.output(0.7, x + dx, u + du) - rotor.output(0.7, x, u)
    assert_allclose(change, C @ dx + D @ du, rtol=1e-10, atol=1e-12)


@pytest.mark.closed_form
def test_turning_the_axes_turns_the_motion(friswell_591):
    """An isotropic rotor has no axes: the equations of x + i y are linear over the complex numbers."""
    rotor = friswell_591(200.0, internal_damping=1e-4, gravity=(0.0, 0.0))
    n = len(rotor.structure.coordinates)
    rng = np.random.default_rng(2)
    x = rng.standard_normal(4 * n)
    turn = np.kron(np.eye(2), np.kron([[0.6, -0.8], [0.8, 0.6]], np.eye(n)))
    rate = rotor.derivative(0.0, x, np.zeros(4))
    assert_allclose(rotor.derivative(0.0, turn @ x, np.zeros(4)), turn @ rate, atol=1e-9 * np.abs(rate).max())


@pytest.mark.closed_form
def test_shaft_bent_at_its_own_speed_feels_no_internal_damping(friswell_591):
    """A shape that turns with the shaft is at rest in its material."""
    speed = 150.0
    damped, plain = (friswell_591(speed, internal_damping=d, gravity=(0.0, 0.0)) for d in (1e-3, 0.0))
    n = len(damped.structure.coordinates)
    shape = np.random.default_rng(3).standard_normal(n)
    turning = np.concatenate([shape, 0 * shape, 0 * shape, speed * shape])
    rates = [rotor.derivative(0.0, turning, np.zeros(4)) for rotor in (damped, plain)]
    assert_allclose(rates[0], rates[1], atol=1e-9 * np.abs(rates[1]).max())


@pytest.mark.closed_form
def test_unbalance_forces_are_those_of_the_rigid_rotor(friswell_591):
    ramp = SpeedProfile(times=(0.0, 2.0), speeds=(30.0, -90.0))
    unbalance = Unbalance(node=2, unbalance=0.02, unbalance_angle=0.7)
    rotor = friswell_591(ramp, unbalances=(unbalance,), gravity=(0.0, 0.0))
    single = RigidRotor(mass=1.0, speed=ramp, unbalance=0.02, unbalance_angle=0.7, gravity=(0.0, 0.0))
    n = len(rotor.structure.coordinates)
    for t in (0.1, 1.3):
        acceleration = rotor.derivative(t, np.zeros(4 * n), np.zeros(4))[2 * n :]
        forces = rotor.structure.mass @ acceleration
        assert_allclose(forces[[4, 4 + n]], single.unbalance_force(t), rtol=1e-10)
        assert np.abs(np.delete(forces, [4, 4 + n])).max() < 1e-9 * np.abs(forces).max()


@pytest.mark.closed_form
def test_support_is_in_series_with_the_bearing(steel, on_springs, frequencies):
    """Stiff shaft, light housings: the springs in series carry half the rotor each."""
    k_bearing, k_support = 2e6, 3e6
    support = Support(mass=1e-6, stiffness=k_support)
    stiff = dataclasses.replace(steel, young_modulus=211e12, shear_modulus=81e12)
    piece = ShaftElement(length=0.5, outer_diameter=0.1, material=stiff)
    stations = (Station(node=0, name="a", support=support), Station(node=2, name="b", support=support))
    rotor = ShaftRotor(elements=piece.split(2), speed=0.0, stations=stations)
    series = 1.0 / (1.0 / k_bearing + 1.0 / k_support)
    assert_allclose(
        frequencies(on_springs(rotor, k_bearing))[:2], np.sqrt(2 * series / rotor.mass), rtol=2e-5
    )


@pytest.mark.closed_form
def test_soft_coupling_lets_two_shafts_move_alone(steel, frequencies, on_springs):
    piece = ShaftElement(length=0.5, outer_diameter=0.05, material=steel)
    soft = Coupling(stiffness=1e-3, tilt_stiffness=1e-3)
    ends = tuple(Station(node=n, name=f"s{n}") for n in (0, 4, 5, 9))
    pair = ShaftRotor(elements=(*piece.split(4), soft, *piece.split(4)), speed=0.0, stations=ends)
    alone = ShaftRotor(elements=piece.split(4), speed=0.0, stations=ends[:2])
    one, two = (frequencies(on_springs(rotor, 1e9)) for rotor in (alone, pair))
    assert_allclose(two[:8:2], one[:4], rtol=1e-7)


@pytest.mark.closed_form
def test_stiff_coupling_is_a_shaft_in_one_piece(steel, frequencies, on_springs):
    piece = ShaftElement(length=0.5, outer_diameter=0.05, material=steel)
    stiff = Coupling(stiffness=1e14, tilt_stiffness=1e12)
    cut = ShaftRotor(
        elements=(*piece.split(2), stiff, *piece.split(2)),
        speed=0.0,
        stations=(Station(node=0, name="a"), Station(node=5, name="b")),
    )
    whole = ShaftRotor(
        elements=piece.split(2) * 2,
        speed=0.0,
        stations=(Station(node=0, name="a"), Station(node=4, name="b")),
    )
    one, two = (frequencies(on_springs(rotor, 1e8))[:6] for rotor in (whole, cut))
    assert_allclose(two, one, rtol=1e-5)


def test_disk_of_given_size():
    disk = Disk.solid(1, density=7800.0, width=0.05, outer_diameter=0.3, inner_diameter=0.1)
    mass = 7800.0 * 0.05 * math.pi * (0.15**2 - 0.05**2)
    assert disk.mass == pytest.approx(mass)
    assert disk.polar_inertia == pytest.approx(mass / 2 * (0.15**2 + 0.05**2))
    assert disk.diametral_inertia == pytest.approx(mass / 12 * (3 * (0.15**2 + 0.05**2) + 0.05**2))


def test_an_fmu_could_carry_it(rich_rotor):
    rotor = rich_rotor(10.0)
    again = decode(encode(rotor), {})
    assert again == rotor
    x = np.linspace(0.0, 1.0, len(rotor.states))
    assert_allclose(again.derivative(0.1, x, np.ones(4)), rotor.derivative(0.1, x, np.ones(4)), rtol=0)


@pytest.mark.parametrize(
    ("change", "match"),
    [
        ({"elements": ()}, "elements must hold at least one ShaftElement"),
        ({"stations": (Station(node=7),)}, "stations must be on a node 0 to 6, got node 7"),
        ({"disks": (Disk(node=-1, mass=1.0),)}, "disks must be on a node 0 to 6, got node -1"),
        ({"probes": (Probe(node=9, name="a"),)}, "probes must be on a node 0 to 6, got node 9"),
        ({"stations": (Station(node=0), Station(node=1))}, "stations must have different names"),
        ({"internal_damping": -1.0}, "internal_damping must be finite and not negative, got -1.0"),
        ({"gravity": 9.81}, "gravity must be a pair of numbers, got 9.81"),
        ({"initial": (0.0, 1.0)}, r"initial must be empty or 104 numbers, got shape \(2,\)"),
        ({"speed": math.nan}, "speed must be a single finite number, got nan"),
    ],
)
def test_bad_parameters_are_named(friswell_591, change, match):
    with pytest.raises(InputError, match=match):
        friswell_591(**change)


@pytest.mark.parametrize(
    ("make", "match"),
    [
        (lambda m: ShaftElement(length=0.0, outer_diameter=1.0, material=m), "length must be finite and pos"),
        (
            lambda m: ShaftElement(length=1.0, outer_diameter=1.0, inner_diameter=1.0, material=m),
            "inner_diameter must be below outer_diameter 1.0, got 1.0",
        ),
        (
            lambda m: ShaftElement(length=1.0, outer_diameter=1.0, material=m, shear_coefficient=-1.0),
            "shear_coefficient must be positive, got -1.0",
        ),
        (lambda m: Disk(node=0, mass=-1.0), "mass must be finite and not negative, got -1.0"),
        (lambda m: Support(mass=1.0, stiffness=(1.0, 2.0)), "stiffness must be a number or 2 x 2 numbers"),
        (lambda m: Station(node=0, name="a b"), "name must be an identifier or empty, got 'a b'"),
        (lambda m: Probe(node=0, name=""), "name must be an identifier, got ''"),
    ],
)
def test_bad_parts_are_named(steel, make, match):
    with pytest.raises(InputError, match=match):
        make(steel)
