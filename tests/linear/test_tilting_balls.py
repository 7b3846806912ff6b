"""Flexible rotors on ball bearings that resist tilts: closed forms of a mass on a cantilever, balances."""

import math
from dataclasses import replace

import numpy as np
import pytest

import rotorfilm as rf
from rotorfilm import InputError

SINGLE = rf.BallBearing(
    balls=16, ball_diameter="7.938 mm", pitch_diameter="46.5 mm", contact_angle="25 deg", axial_load=400.0
)
PAIR = rf.back_to_back(SINGLE, distance="20 mm", preload="150 N")
LIGHT = rf.ElasticMaterial(young_modulus=211e9, shear_modulus=81.2e9, density=0.01)
STEEL = rf.ElasticMaterial(young_modulus=211e9, shear_modulus=81.2e9, density=7810.0)
LENGTH, DIAMETER, MASS, UNBALANCE = 0.12, 0.03, 0.02, 1e-8


def overhung() -> rf.ShaftRotor:
    """Return a mass at the end of a slender light shaft that one bearing holds."""
    piece = rf.ShaftElement(length=LENGTH, outer_diameter=DIAMETER, material=LIGHT, shear_coefficient=1e7)
    return rf.ShaftRotor(
        elements=piece.split(2),
        speed=0.0,
        stations=(rf.Station(node=0, name="left", feels_tilt=True),),
        disks=(rf.Disk(node=2, mass=MASS),),
        unbalances=(rf.Unbalance(node=2, unbalance=UNBALANCE),),
        probes=(rf.Probe(node=2, name="disk"),),
        gravity=(0.0, 0.0),
    )


def end_stiffness(bearing: rf.BallBearing, speed: float) -> float:
    """Return what a force along x at the end of that shaft meets [N/m]: all five degrees give way."""
    z = bearing.axial_place(speed=speed)
    arm = np.array([1.0, 0.0, 0.0, 0.0, LENGTH])
    ball = arm @ np.linalg.solve(bearing.stiffness((0.0, 0.0, z, 0.0, 0.0), speed), arm)
    bending = LENGTH**3 / (3.0 * 211e9 * math.pi * DIAMETER**4 / 64.0)
    return float(1.0 / (ball + bending))


def test_a_mass_on_a_cantilever_swings_with_the_stiffness_of_all_five_degrees() -> None:
    # The coupling of x and tilt_y is a third of the compliance here, of either sign for a tilt turned round.
    bearings = {"left": rf.MomentCarryingBalls(bearing=SINGLE)}
    speed = 800.0
    wanted = math.sqrt(end_stiffness(SINGLE, speed) / MASS)
    lowest = rf.rotor_modes(overhung(), bearings, speed).frequency[:2]
    assert lowest == pytest.approx([wanted, wanted], rel=2e-4)


def test_its_critical_speed_is_where_running_balls_leave_that_stiffness() -> None:
    wanted = 1600.0
    for _ in range(30):
        wanted = math.sqrt(end_stiffness(SINGLE, wanted) / MASS)
    bearings = {"left": rf.MomentCarryingBalls(bearing=SINGLE)}
    found = rf.critical_speeds(overhung(), bearings, np.linspace(1000.0, 2400.0, 7))
    assert [one.speed for one in found] == pytest.approx([wanted] * len(found), rel=2e-4)
    assert len(found) == 2
    still = math.sqrt(end_stiffness(SINGLE, 0.0) / MASS)
    assert abs(wanted / still - 1.0) > 1e-3  # the balls' inertia is seen


def test_its_unbalance_response_is_that_of_a_mass_on_a_spring() -> None:
    speed = 600.0
    response = rf.unbalance_response(overhung(), {"left": rf.MomentCarryingBalls(bearing=SINGLE)}, [speed])
    at = response.output_labels.index("disk_x")
    wanted = UNBALANCE * speed**2 / (end_stiffness(SINGLE, speed) - MASS * speed**2)
    assert abs(response.frdata[at, 0, 0]) == pytest.approx(abs(wanted), rel=1e-3)


def heavy(elements: int, bearing: rf.BearingPair) -> tuple[rf.ShaftRotor, dict[str, rf.MomentCarryingBalls]]:
    """Return a spindle with an overhang on two equal pairs."""
    piece = rf.ShaftElement(length=0.3, outer_diameter=0.035, material=STEEL)
    stations = tuple(
        rf.Station(node=node * elements // 10, name=name, feels_tilt=True)
        for name, node in (("left", 1), ("right", 6))
    )
    rotor = rf.ShaftRotor(
        elements=piece.split(elements),
        speed=0.0,
        stations=stations,
        disks=(rf.Disk(node=elements, mass=3.0),),
    )
    return rotor, dict.fromkeys(("left", "right"), rf.MomentCarryingBalls(bearing=bearing))


def test_forces_and_moments_at_rest_balance_the_weight() -> None:
    rotor, bearings = heavy(10, PAIR)
    at = rf.rotor_equilibrium(rotor, bearings, 1000.0)
    places = rotor.positions[[station.node for station in rotor.stations]]
    loads = np.array([at.loads["left"], at.loads["right"]])
    weight = -9.80665 * rotor.mass
    shaft = rotor.mass - 3.0
    center = (shaft * 0.15 + 3.0 * 0.3) / rotor.mass
    assert loads[:, 1].sum() == pytest.approx(weight, rel=1e-9)
    # z x F: a force along y at z has the moment -z F about x.
    assert (loads[:, 2] - places * loads[:, 1]).sum() == pytest.approx(-center * weight, rel=1e-9)
    assert abs(loads[:, 2]).max() > 0.01


def test_two_rows_in_two_nodes_are_the_pair_between_them() -> None:
    z = 6e-6
    rows = rf.MomentCarryingBalls(
        bearing=rf.BallBearing(
            balls=16,
            ball_diameter=7.938e-3,
            pitch_diameter=46.5e-3,
            contact_angle=0.4363,
            axial_displacement=z,
        )
    )
    both = rf.tandem(rows.bearing, distance=0.02)
    pair = rf.MomentCarryingBalls(
        bearing=rf.BearingPair(bearing=both.bearing, distance=0.02, directions=(1, 1), axial_displacement=z)
    )
    solid = rf.ElasticMaterial(young_modulus=211e13, shear_modulus=81.2e13, density=7810.0)
    elements = rf.ShaftElement(length=0.02, outer_diameter=0.035, material=solid).split(2)
    elements += rf.ShaftElement(length=0.2, outer_diameter=0.035, material=STEEL).split(4)

    def frequencies(nodes: tuple[int, ...], bearing: rf.MomentCarryingBalls) -> np.ndarray:
        stations = tuple(rf.Station(node=k, name=f"row_{k}", feels_tilt=True) for k in nodes)
        rotor = rf.ShaftRotor(elements=elements, speed=0.0, stations=stations, gravity=(0.0, 0.0))
        at = {station.name: bearing for station in stations}
        return rf.rotor_modes(rotor, at, 900.0).frequency[:6]

    assert frequencies((1,), pair) == pytest.approx(frequencies((0, 2), rows), rel=1e-5)


def test_a_shaft_of_many_elements_moves_in_few_shapes_and_says_its_error() -> None:
    few, many = (heavy(n, PAIR) for n in (10, 40))
    known = rf.rotor_modes(*few, 1000.0)
    found = rf.rotor_modes(*many, 1000.0)
    assert found.frequency[:4] == pytest.approx(known.frequency[:4], rel=1e-5)
    assert 0.0 < found.error < 1e-6


@pytest.mark.parametrize("bearing", [SINGLE, PAIR], ids=["thrust", "pair"])
def test_coefficients_are_the_slopes_of_force_and_moment(bearing: rf.BallBearing | rf.BearingPair) -> None:
    held = rf.MomentCarryingBalls(bearing=bearing)
    place, still = np.array([3e-7, -5e-7, 2e-5, 1e-5]), np.zeros(4)
    steps = np.diag([1e-9, 1e-9, 1e-7, 1e-7])
    slopes = np.stack(
        [
            (held.force(place + step, still, 900.0) - held.force(place - step, still, 900.0))
            / (2.0 * step.max())
            for step in steps
        ],
        axis=1,
    )
    stiffness = rf.coefficients(held, place, 900.0).stiffness
    size = np.sqrt(np.outer(np.diag(stiffness), np.diag(stiffness)))
    assert np.abs((stiffness + slopes) / size).max() < 1e-5


def test_the_python_control_system_has_the_whirls_of_the_modes() -> None:
    rotor, bearings = heavy(10, PAIR)
    poles = rf.rotor_system(rotor, rf.rotor_equilibrium(rotor, bearings, 1000.0)).poles()
    lowest = np.sort(poles.imag[poles.imag > 0.0])[:4]
    assert lowest == pytest.approx(rf.rotor_modes(rotor, bearings, 1000.0).frequency[:4], rel=1e-7)


def test_a_rotor_mounted_on_them_has_the_whirls_of_its_modes() -> None:
    rotor, bearings = heavy(10, replace(PAIR, damping=300.0))
    at = rf.rotor_equilibrium(rotor, bearings, 1000.0)
    mounted = rf.mount(replace(rotor, speed=1000.0), bearings)
    state = np.concatenate([at.displacement, np.zeros_like(at.displacement)])
    assert np.abs(mounted.derivative(0.0, state, [])).max() < 1e-6  # m/s2, of gravity
    poles = np.linalg.eigvals(mounted.linearization(0.0, state, []).A)
    lowest = np.sort(poles.imag[poles.imag > 1.0])[:4]
    assert lowest == pytest.approx(rf.rotor_modes(rotor, bearings, 1000.0).frequency[:4], rel=1e-9)


def test_what_does_not_fit_is_named() -> None:
    rotor, bearings = heavy(10, PAIR)
    plain = rf.ShaftRotor(elements=rotor.elements, speed=0.0, stations=(rf.Station(node=1, name="left"),))
    with pytest.raises(InputError, match=r"station 'left' must have the freedom tilt_x"):
        rf.rotor_modes(plain, {"left": bearings["left"]}, 100.0)
    with pytest.raises(InputError, match=r"rotor must have the outputs .* without .*'left_tilt_x'"):
        rf.mount(plain, {"left": bearings["left"]})
    with pytest.raises(InputError, match="bearing must be a BallBearing or a BearingPair"):
        rf.MomentCarryingBalls(bearing=rotor)
    with pytest.raises(InputError, match=r"position must have shape \(4, \.\.\.\)"):
        bearings["left"].force([0.0, 0.0], [0.0, 0.0], 100.0)


def spindle(
    bearing: rf.BallBearing | rf.BearingPair,
) -> tuple[rf.ShaftRotor, dict[str, rf.MomentCarryingBalls]]:
    """Return a spindle with a tool in its holder on two equal bearings."""
    rotor = rf.ShaftRotor(
        elements=rf.ShaftElement(length=0.32, outer_diameter=0.035, material=STEEL).split(4),
        speed=0.0,
        stations=tuple(
            rf.Station(node=node, name=name, feels_tilt=True) for name, node in (("front", 1), ("rear", 3))
        ),
        disks=(rf.Disk(node=0, mass=1.2),),
    )
    return rotor, dict.fromkeys(("front", "rear"), rf.MomentCarryingBalls(bearing=bearing))


LOOSE = rf.BallBearing(
    balls=9, ball_diameter=9.525e-3, pitch_diameter=46e-3, internal_clearance=10e-6, cage_angle=0.2
)


def test_critical_speeds_of_a_spindle_are_those_of_its_modes_in_either_sense_of_rotation() -> None:
    rotor, bearings = spindle(PAIR)
    found = rf.critical_speeds(rotor, bearings, np.linspace(2500.0, 4500.0, 4))
    backward, forward = found
    assert (backward.direction < -0.99, forward.direction > 0.99) == (True, True)
    for one, number in ((backward, 0), (forward, 1)):
        assert rf.rotor_modes(rotor, bearings, one.speed).frequency[number] == pytest.approx(
            one.speed, rel=1e-7
        )
    reversed_ = rf.critical_speeds(rotor, bearings, -np.linspace(2500.0, 4500.0, 4))
    assert sorted(-one.speed for one in reversed_) == pytest.approx([one.speed for one in found], rel=1e-5)


def test_campbell_diagram_and_threshold_take_ball_bearings() -> None:
    rotor, bearings = spindle(replace(PAIR, damping=300.0))
    speeds = np.linspace(1000.0, 3000.0, 3)
    lines = rf.campbell(rotor, bearings, speeds)
    for k, speed in enumerate(speeds):
        modes = rf.rotor_modes(rotor, bearings, speed).frequency[:4]
        assert np.sort(lines.frequency[:4, k]) == pytest.approx(np.sort(modes), rel=1e-8)
    # Ball bearings have next to no cross coupling: damping makes every whirl decay.
    threshold = rf.rotor_threshold(rotor, bearings, speeds)
    assert threshold.speed is None
    assert threshold.reason == "stable at every speed given"


def test_deep_groove_bearings_with_clearance_rest_on_some_of_their_balls() -> None:
    rotor, bearings = spindle(LOOSE)
    at = rf.rotor_equilibrium(rotor, bearings, 1000.0)
    loads = np.array([at.loads["front"], at.loads["rear"]])
    assert loads[:, 1].sum() == pytest.approx(-9.80665 * rotor.mass, rel=1e-8)
    displacement = bearings["front"].displacement(at.coefficients["front"].position, 1000.0)
    assert 1 <= LOOSE.loads(displacement, 1000.0).carrying < 5
    # With next to no thrust the tilts are held by few balls: much lower than on balls that all carry.
    modes = rf.rotor_modes(rotor, bearings, 1000.0).frequency[:2]
    thrust = dict.fromkeys(
        ("front", "rear"), rf.MomentCarryingBalls(bearing=replace(LOOSE, axial_load=100.0))
    )
    pressed = rf.rotor_modes(rotor, thrust, 1000.0).frequency[:2]
    assert pressed[0] > 2.0 * modes[0]


def light_rotor(rng: np.random.Generator) -> tuple[rf.ShaftRotor, dict[str, rf.MomentCarryingBalls], float]:
    """Return a rotor of some 1 N in two deep groove bearings with clearance, and its weight [N]."""
    diameter, mass = 10.0 ** rng.uniform(-2.5, -1.5), 10.0 ** rng.uniform(-3.0, 0.0)
    piece = rf.ShaftElement(length=0.32, outer_diameter=diameter, material=STEEL)
    rotor = rf.ShaftRotor(
        elements=piece.split(4),
        speed=0.0,
        stations=tuple(
            rf.Station(node=node, name=name, feels_tilt=True) for node, name in ((1, "front"), (3, "rear"))
        ),
        disks=(rf.Disk(node=0, mass=mass),),
        gravity=(0.0, -9.81),
    )
    bearings = {
        name: rf.MomentCarryingBalls(
            bearing=rf.BallBearing(
                balls=int(rng.integers(6, 10)),
                ball_diameter=7.938e-3,
                pitch_diameter=33.5e-3,
                internal_clearance=rng.uniform(0.0, 20e-6),
                cage_angle=rng.uniform(0.0, 2.0 * math.pi),
            )
        )
        for name in ("front", "rear")
    }
    return rotor, bearings, 9.81 * (mass + STEEL.density * 0.32 * math.pi / 4.0 * diameter**2)


@pytest.mark.closed_form
@pytest.mark.parametrize("speed", [0.0, 100.0, 2000.0])
def test_light_rotors_rest_in_bearings_with_clearance(speed: float) -> None:
    """Forces and moments about the front bearing, of the balls at the places told, are balanced."""
    rng = np.random.default_rng(7)
    for _ in range(10):
        rotor, bearings, weight = light_rotor(rng)
        at = rf.rotor_equilibrium(rotor, bearings, speed)
        assert at.residual < 1e-9
        loads = [
            -bearings[name].force(at.coefficients[name].position, np.zeros(4), speed)
            for name in ("front", "rear")
        ]
        np.testing.assert_allclose(loads[0][:2] + loads[1][:2], [0.0, -weight], atol=1e-8 * weight)
        disk = rotor.disks[0].mass * 9.81
        # moments about x at the front node, 80 mm from the disk, 80 mm from the middle, 160 mm from the rear
        own = -0.08 * disk + 0.08 * (weight - disk)
        about = 0.16 * loads[1][1] - loads[0][2] - loads[1][2]
        assert own + about == pytest.approx(0.0, abs=1e-7 * weight)
