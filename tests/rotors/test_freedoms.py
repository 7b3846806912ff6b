"""Stations with up to six freedoms: motion along the axis, twist and tilts beside that in both planes."""

from dataclasses import dataclass, replace

import numpy as np
import pytest
from numpy.testing import assert_allclose, assert_array_equal

import rotorfilm as rf
from rotorfilm import InputError, JournalBearing, LinearBearing, Linearization, RigidShaft, ShortFilm
from rotorfilm.analysis import axial_modes, torsional_modes
from rotorfilm.analysis.compiled_rotor import compiled_form, take_apart
from rotorfilm.core import force_outputs, journal_inputs, names
from rotorfilm.rotors import (
    ClassicalBeam,
    Coupling,
    Disk,
    LinearMotor,
    ModallyDampedRotor,
    MotorDrivenRotor,
    ReducedRotor,
    ShaftElement,
    ShaftRotor,
    Station,
    Support,
    Unbalance,
    mount,
)
from rotorfilm.rotors.structure import freedom_rows, in_planes, station_freedoms, station_names

LENGTH, SPEED = 0.9, 120.0
BEYOND = {"axial": True, "torsional": True}
SPRING = LinearBearing(stiffness=[[1e7, 1e5], [-1e5, 2e7]], damping=[[2e3, 0.0], [0.0, 2e3]])
SPRINGS = {"left": SPRING, "right": SPRING}
FILM = JournalBearing(radius=0.02, length=0.015, clearance=6e-5, viscosity=0.02, film=ShortFilm())


def shaft(steel, elements, **further):
    piece = ShaftElement(length=LENGTH, outer_diameter=0.04, material=steel)
    given = {
        "stations": (
            Station(node=0, name="left", feels_tilt=True),
            Station(node=elements, name="right", support=Support(mass=2.0, stiffness=3e7, damping=50.0)),
        ),
        "disks": (Disk(node=1, mass=8.0, diametral_inertia=0.05, polar_inertia=0.08),),
        "unbalances": (Unbalance(node=1, unbalance=1e-4),),
    }
    return ShaftRotor(elements=piece.split(elements), speed=SPEED, **given | further)


@dataclass(frozen=True)
class Spring:
    """A spring and a damper against one freedom."""

    freedom: str
    stiffness: float
    damping: float

    states = ()

    @property
    def freedoms(self):
        return (self.freedom,)

    @property
    def inputs(self):
        return journal_inputs(1e-4, 100.0, self.freedoms)

    @property
    def outputs(self):
        return force_outputs(1e3, self.freedoms)

    def output(self, t, x, u):
        return np.array([-self.stiffness * u[0] - self.damping * u[1]])

    def linearization(self, t, x, u):
        D = np.array([[-self.stiffness, -self.damping, 0.0]])
        return Linearization(np.zeros((0, 0)), np.zeros((0, 3)), np.zeros((1, 0)), D)


@pytest.mark.parametrize(
    ("asked", "modulus", "chain"),
    [("axial", "young_modulus", axial_modes), ("torsional", "shear_modulus", torsional_modes)],
)
def test_free_rod_modes_have_the_order_of_their_elements(steel, asked, modulus, chain):
    wave = np.pi / LENGTH * np.sqrt(getattr(steel, modulus) / steel.density)
    errors = []
    for elements in (2, 4, 8):
        rotor = shaft(steel, elements, stations=(), disks=(), gravity=(0.0, 0.0), **{asked: True})
        modes = rf.rotor_modes(rotor, {}, SPEED)
        planar = np.abs(modes.shapes[: 2 * len(rotor.structure.coordinates)]).max(axis=0)
        own = planar < 1e-6 * np.abs(modes.shapes).max(axis=0)
        assert_array_equal(modes.direction[own], 0.0)
        found = modes.frequency[own][:3]
        assert_allclose(chain(rotor).frequency[:4], [0.0, *found], rtol=1e-8)
        errors.append(found / (wave * np.arange(1, 4)) - 1.0)
    assert_allclose(np.log2(errors[-2] / errors[-1]), 4.0, atol=0.3)
    assert_allclose(errors[-1], (np.pi * np.arange(1, 4) / 8) ** 4 / 1440.0, rtol=0.1)


def test_a_rigid_shaft_with_five_freedoms_is_hand_algebra():
    m, diametral, polar, place = 7.0, 0.3, 0.5, 0.25
    body = RigidShaft(
        mass=m,
        diametral_inertia=diametral,
        polar_inertia=polar,
        stations=(("", place),),
        speed=SPEED,
        axial=True,
        feels_tilt=True,
    )
    freedoms = ("x", "y", "z", "tilt_x", "tilt_y")
    motion, force = station_names("", freedoms)
    A, B, C, _ = body.linearization(0.0, np.zeros(10), np.zeros(5))
    sense = C[[names(body.outputs).index(name) for name in motion]]
    push = B[:, [names(body.inputs).index(name) for name in force]]
    # About the mass center with tilts a, b about +x, +y: I a'' + P w b' = M_a, I b'' - P w a' = M_b.
    at = np.eye(5)
    at[0, 4], at[1, 3] = place, -place
    inertia = np.diag([m, m, m, diametral, diametral])
    gyroscopic = np.zeros((5, 5))
    gyroscopic[3, 4], gyroscopic[4, 3] = polar * SPEED, -polar * SPEED
    back = np.linalg.inv(at)
    accelerations = np.hstack([np.zeros((5, 5)), -at @ np.linalg.solve(inertia, gyroscopic) @ back])
    wanted = np.vstack([np.eye(5, 10, 5), accelerations])
    assert_allclose(sense @ A @ np.linalg.inv(sense), wanted, atol=1e-12 * np.abs(wanted).max())
    pushed = np.vstack([np.zeros((5, 5)), at @ np.linalg.solve(inertia, at.T)])
    assert_allclose(sense @ push, pushed, atol=1e-13 * np.abs(pushed).max())


def test_a_spring_along_the_axis_holds_it():
    body = RigidShaft(
        mass=7.0,
        diametral_inertia=0.3,
        polar_inertia=0.5,
        stations=(("left", -0.3), ("right", 0.2), ("collar", 0.1)),
        speed=SPEED,
        axial=True,
    )
    collar = Spring("z", 4e6, 300.0)
    root = np.roots([7.0, 300.0, 4e6])[0]
    modes = rf.rotor_modes(body, {**SPRINGS, "collar": collar}, SPEED)
    (axial,) = np.flatnonzero(modes.direction == 0.0)
    assert_allclose(modes.eigenvalues[axial], root, rtol=1e-10)
    loose = rf.rotor_modes(replace(body, axial=False), SPRINGS, SPEED)
    assert_allclose(np.delete(modes.eigenvalues, axial), loose.eigenvalues, rtol=1e-9)
    found = rf.critical_speeds(body, {**SPRINGS, "collar": collar}, np.linspace(100.0, 2500.0, 7))
    assert min(abs(one.speed - root.imag) for one in found if one.direction == 0.0) < 1e-6
    driving = Spring("z", 4e6, -1.0)
    threshold = rf.rotor_threshold(body, {**SPRINGS, "collar": driving}, [10.0, 20.0])
    assert threshold.reason == "unstable at the first speed given"
    whole = mount(body, {**SPRINGS, "collar": collar})
    poles = np.linalg.eigvals(whole.linearization(0.0, np.zeros(10), np.zeros(len(whole.inputs))).A)
    assert np.abs(poles - root).min() < 1e-9 * abs(root)


def test_motion_without_a_stiffness_has_no_critical_speed():
    undamped = LinearBearing(stiffness=np.diag([1e7, 1e7]), damping=np.zeros((2, 2)))
    body = RigidShaft(
        mass=7.0,
        diametral_inertia=0.3,
        polar_inertia=0.1,
        stations=(("left", -0.3), ("right", 0.3)),
        speed=SPEED,
        axial=True,
    )
    found = rf.critical_speeds(body, {"left": undamped, "right": undamped}, np.linspace(0.0, 4000.0, 6))
    # Of translation; of tilt forward and backward, whose inertia is less and more by the polar one.
    squares = [2e7 / 7.0, 2e7 / 7.0, 2.0 * 0.3**2 * 1e7 / 0.4, 2.0 * 0.3**2 * 1e7 / 0.2]
    assert_allclose([one.speed for one in found], np.sqrt(squares), rtol=1e-9)


def test_signals_of_further_freedoms_follow_the_planar_ones(steel):
    rotor, planar = shaft(steel, 2, **BEYOND), shaft(steel, 2)
    further = ["z", "tilt_x", "tilt_y", "twist", "vz", "tilt_rate_x", "tilt_rate_y", "twist_rate"]
    assert names(rotor.inputs) == [
        *(f"{name}_force_{axis}" for name in ("left", "right") for axis in "xy"),
        *(f"left_{name}" for name in ("force_z", "moment_x", "moment_y", "torque")),
        *("right_force_z", "right_torque"),
    ]
    assert names(rotor.outputs) == [
        *(f"{name}_{motion}" for name in ("left", "right") for motion in ("x", "y", "vx", "vy")),
        *(f"left_{name}" for name in further),
        *(f"right_{name}" for name in ("z", "twist", "vz", "twist_rate")),
        *("right_ground_force_x", "right_ground_force_y", "speed"),
    ]
    assert names(planar.inputs)[4:] == ["left_moment_x", "left_moment_y"]
    for signal in rotor.inputs + rotor.outputs:
        turns = any(word in signal.name for word in ("tilt", "twist", "moment", "torque"))
        assert ("rad" in signal.unit or signal.unit == "N.m") == (turns or signal.name == "speed")
    n = len(rotor.structure.weight)
    assert names(rotor.states)[-n:] == [f"v{name}" for name in names(rotor.states)[:n]]
    assert station_freedoms(rotor.structure, "right") == ("x", "y", "z", "twist")
    for name, size in (("left", 6), ("right", 4)):
        motion, force = station_names(name, station_freedoms(rotor.structure, name))
        assert set(motion) <= set(names(rotor.outputs))
        assert set(force) <= set(names(rotor.inputs))
        assert len(force) == size


def test_tilts_are_right_handed(steel):
    rows = freedom_rows(shaft(steel, 2).structure, "left", ("tilt_x", "tilt_y"))
    coordinates = [name for name, *_ in shaft(steel, 2).structure.coordinates]
    n, k = len(coordinates), coordinates.index("tilt_{}_0")
    # dx/dz turns +z towards +x, about +y; dy/dz turns it towards +y, about -x.
    assert_array_equal(np.argwhere(rows), [[0, n + k], [1, k]])
    assert_array_equal(rows[rows != 0.0], [-1.0, 1.0])


def test_the_planes_of_a_rotor_stay_as_they_are(steel):
    damped = {"internal_damping": 1e-5, "mass_damping": 3.0, "stiffness_damping": 1e-6, "loss_factor": 0.01}
    rotor, planar = shaft(steel, 3, **damped, **BEYOND), shaft(steel, 3, **damped)
    for one, other in zip(in_planes(rotor.structure), planar.structure, strict=True):
        if isinstance(other, np.ndarray):
            assert_array_equal(one, other)
    damped["loss_factor"] = 0.0
    rotor, planar = shaft(steel, 3, **damped, **BEYOND), shaft(steel, 3, **damped)
    assert rotor.mass == planar.mass
    n, N = len(planar.structure.weight), len(rotor.structure.weight)
    states = [*range(n), *range(N, N + n)]
    own = {
        "inputs": [names(rotor.inputs).index(name) for name in names(planar.inputs)],
        "outputs": [names(rotor.outputs).index(name) for name in names(planar.outputs)[:-1]],
    }
    few, many = planar.operators, rotor.operators
    for name in ("steady", "by_speed"):
        one, other = getattr(many, name), getattr(few, name)
        assert_allclose(one[np.ix_(states, states)], other, rtol=0.0, atol=1e-14 * np.abs(other).max())
        assert not np.delete(one[states], states, axis=1).any()
    for name, one in (
        ("push", many.push[np.ix_(states, own["inputs"])]),
        ("unbalance", many.unbalance[states]),
        ("weight", many.weight[states]),
    ):
        other = getattr(few, name)
        assert_allclose(one, other, rtol=0.0, atol=1e-12 * np.abs(other).max())
    assert_array_equal(many.sense[np.ix_(own["outputs"], states)], few.sense)
    assert [rotor.inputs[k] for k in own["inputs"]] == list(planar.inputs)
    assert [rotor.outputs[k] for k in own["outputs"]] == list(planar.outputs[:-1])


def test_damping_along_the_axis_and_about_it_is_proportional(steel):
    joint = Coupling(stiffness=1e8, tilt_stiffness=1e4, axial_stiffness=1e7, twist_stiffness=3e4)
    own = {"mass_damping": 5.0, "stiffness_damping": 1e-5}
    piece = ShaftElement(length=0.3, outer_diameter=0.04, material=steel, **own)
    rotor = ShaftRotor(
        elements=(piece, joint, piece),
        speed=SPEED,
        internal_damping=2e-5,
        mass_damping=3.0,
        stiffness_damping=1e-6,
        **BEYOND,
    )
    s = rotor.structure
    m, springs = len(s.others), np.zeros((len(s.others),) * 2)
    for name, stiffness in (("z", 1e7), ("twist", 3e4)):
        first = [one for one, *_ in s.others].index(f"{name}_1")
        springs[first : first + 2, first : first + 2] = stiffness * np.array([[1.0, -1.0], [-1.0, 1.0]])
    mass, stiffness, damping = (part[-m:, -m:] for part in (s.mass, s.stiffness, s.damping))
    wanted = 8.0 * mass + 2.1e-5 * stiffness + 1e-5 * (stiffness - springs)
    assert_allclose(damping, wanted, atol=1e-14 * np.abs(wanted).max())
    assert not s.circulation[-m:].any()
    assert np.linalg.matrix_rank(stiffness, tol=1e-9 * np.abs(stiffness).max()) == m - 2
    with pytest.raises(InputError, match="axial_stiffness must be given of the coupling behind node 0"):
        replace(rotor, elements=(replace(joint, axial_stiffness=None), piece))


@pytest.mark.parametrize("elements", [3, pytest.param(40, marks=pytest.mark.long)])
def test_motion_that_no_bearing_touches_changes_no_analysis(steel, elements):
    rotor, planar = shaft(steel, elements, **BEYOND), shaft(steel, elements)
    at = [rf.rotor_equilibrium(one, SPRINGS, SPEED) for one in (rotor, planar)]
    assert_allclose(at[0].loads["left"], at[1].loads["left"], rtol=1e-9, atol=1e-9)
    n = len(planar.assembly.weight)
    assert_allclose(at[0].displacement[:n], at[1].displacement, atol=1e-12)
    assert not at[0].displacement[n:].any()
    whirls, wanted = (rf.rotor_modes(one, SPRINGS, SPEED, 1500.0) for one in (rotor, planar))
    assert_allclose(whirls.eigenvalues, wanted.eigenvalues, rtol=1e-7)
    assert_allclose(whirls.direction, wanted.direction, atol=1e-6)
    speeds = np.linspace(0.0, 1500.0, 5)
    critical = [[one.speed for one in rf.critical_speeds(each, SPRINGS, speeds)] for each in (rotor, planar)]
    assert_allclose(*critical, rtol=1e-9)
    films = {"left": FILM, "right": FILM}
    found, same = (rf.rotor_threshold(each, films, [100.0, 1000.0]) for each in (rotor, planar))
    assert_allclose(found.speed, same.speed, rtol=1e-7)
    response, same = (
        rf.unbalance_response(each, SPRINGS, [30.0, 60.0]).frdata[[0, -1]] for each in (rotor, planar)
    )
    assert_allclose(response, same, rtol=1e-6)
    assert rf.campbell(rotor, SPRINGS, [100.0, 150.0], 900.0).eigenvalues.shape == (2, 2)
    shown = [one for one in rf.rotor_modes(rotor, SPRINGS, SPEED, 2e4).eigenvalues if one.imag > 1500.0]
    for one in (
        *axial_modes(rotor, count=2).eigenvalues[1:],
        *torsional_modes(rotor, count=3).eigenvalues[1:],
    ):
        assert np.abs(np.array(shown) - one).min() < 1e-6 * abs(one)


def test_a_rotor_system_has_all_freedoms(steel):
    rotor = shaft(steel, 2, **BEYOND)
    system = rf.rotor_system(rotor, rf.rotor_equilibrium(rotor, SPRINGS, SPEED))
    assert system.input_labels == names(rotor.inputs)
    gain = system(300.0j)
    row, column = (system.output_labels.index("right_z"), system.input_labels.index("left_force_z"))
    s = rotor.structure
    whole = s.stiffness + 300.0j * s.damping - 300.0**2 * s.mass
    wanted = freedom_rows(s, "right", ("z",)) @ np.linalg.solve(whole, freedom_rows(s, "left", ("z",)).T)
    assert_allclose(gain[row, column], wanted.item(), rtol=1e-9)
    assert abs(gain[row, system.input_labels.index("left_force_x")]) == 0.0
    planar = rf.rotor_transmissibility(rotor, SPRINGS, [50.0])
    assert planar.input_labels == names(rotor.inputs)[:4]


def test_rotors_around_a_shaft_keep_its_further_freedoms(steel):
    rotor = shaft(steel, 4, **BEYOND)
    small = ReducedRotor(rotor=rotor, modes=1, speed=SPEED, gravity=rotor.gravity)
    damped = ModallyDampedRotor(rotor=rotor, damping_ratios=(0.02,), speed=SPEED, gravity=rotor.gravity)
    m = len(rotor.structure.others)
    for other in (small, damped):
        assert names(other.inputs) == names(rotor.inputs)
        assert names(other.outputs) == names(rotor.outputs)
        assert_allclose(other.structure.mass[-m:, -m:], rotor.structure.mass[-m:, -m:], rtol=1e-15)
        assert not other.structure.damping[-m:].any()
    error = rf.reduce_rotor(rotor, frequency=400.0).error
    assert_allclose(error, rf.reduce_rotor(shaft(steel, 4), frequency=400.0).error, rtol=1e-6)
    moving = replace(rotor, torsional=False)
    driven = MotorDrivenRotor(
        rotor=moving, inertia=2.0, torque=LinearMotor(stall_torque=5.0, idle_speed=200.0)
    )
    state = 1e-4 * np.random.default_rng(1).normal(size=len(driven.states))
    force = np.zeros(len(driven.inputs))
    force[names(driven.inputs).index("left_force_z")] = 10.0
    change = driven.derivative(0.0, state, force) - driven.derivative(0.0, state, 0.0 * force)
    place = names(driven.states).index("vz_0")
    assert change[place] > 0.0
    with pytest.raises(InputError, match="rotor must not twist beside a motor"):
        replace(driven, rotor=rotor)


@pytest.mark.long
def test_a_rotor_that_moves_along_its_axis_runs_in_time_as_one_that_does_not(steel):
    stations = (Station(node=0, name="left"), Station(node=2))
    planar = shaft(steel, 2, stations=stations, beam=ClassicalBeam())
    rotor = replace(planar, axial=True)
    assert compiled_form(mount(planar, {"left": FILM}), FILM) is not None
    assert compiled_form(mount(rotor, {"left": FILM}), FILM) is None
    with pytest.raises(InputError, match="rotor must move in its planes only here"):
        take_apart(mount(rotor, {"left": FILM, "": FILM}))
    collar = Spring("z", 1e6, 2e3)
    films = {"left": FILM, "": FILM}
    still = rf.simulate(planar, films, duration=0.004, samples=9, rtol=1e-9)
    with_collar = replace(rotor, stations=(*stations, Station(node=1, name="collar")))
    start = np.zeros(2 * len(rotor.structure.weight))
    pushed = names(rotor.states).index("z_0")
    start[pushed : pushed + 5] = 1e-5
    run = rf.simulate(
        with_collar, {**films, "collar": collar}, duration=0.004, samples=9, initial_state=start, rtol=1e-9
    )
    for name in ("left_x", "y", "vy"):
        assert_allclose(run[name], still[name], atol=1e-5 * np.abs(still[name]).max())
    # As a whole on a collar that is soft beside the shaft.
    mass = rotor.mass
    rate = -2e3 / (2.0 * mass)
    swing = np.sqrt(1e6 / mass - rate**2)
    free = np.exp(rate * run.time) * (np.cos(swing * run.time) - rate / swing * np.sin(swing * run.time))
    assert_allclose(run["collar_z"], 1e-5 * free, atol=2e-2 * 1e-5)


def test_a_freedom_that_a_station_has_not_is_named(steel):
    structure = shaft(steel, 2).structure
    for freedom, remedy in (("z", r"ShaftRotor\(axial=True\)"), ("twist", r"ShaftRotor\(torsional=True\)")):
        with pytest.raises(InputError, match=f"station 'left' must have the freedom {freedom}, .* {remedy}"):
            freedom_rows(structure, "left", ("x", freedom))
    with pytest.raises(
        InputError, match=r"'right' must have the freedom tilt_x, .* Station\(feels_tilt=True\)"
    ):
        freedom_rows(structure, "right", ("tilt_x", "tilt_y"))
    with pytest.raises(InputError, match=r"station must be one of the rotor's \['left', 'right'\], got 'up'"):
        freedom_rows(structure, "up", ("x",))
    with pytest.raises(InputError, match="freedom z"):
        rf.rotor_modes(shaft(steel, 2), {**SPRINGS, "left": Spring("z", 1.0, 0.0)}, SPEED)
