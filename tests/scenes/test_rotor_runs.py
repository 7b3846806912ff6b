"""Runs of scenes over time: run-ups, motors, and ground that shakes."""

import math
import os
import tomllib
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from numpy.testing import assert_allclose

from rotorfilm import (
    BaseExcitedRotor,
    BaseMotion,
    Cooling,
    Disk,
    ElasticMaterial,
    Groove,
    InputError,
    JFOFilm,
    JournalBearing,
    Oil,
    SceneError,
    ShaftElement,
    ShaftRotor,
    Station,
    TiltingPadBearing,
    ValidityWarning,
    even_pivots,
    mount,
    rotor_equilibrium,
    simulate_rotor,
)
from rotorfilm.core.port import from_rest
from rotorfilm.scenes import Scene, read_scene, rotor_runs, run_damper
from rotorfilm.scenes.export_scene import from_shaft_rest
from rotorfilm.scenes.rotor_runs import run_rotor
from rotorfilm.scenes.shared_tables import GroundTable, MotorTable

EXAMPLES = Path(__file__).parents[2] / "examples"


def shaken(**excitation):
    data = tomllib.loads((EXAMPLES / "earthquake.toml").read_text(encoding="utf-8"))
    return data | {"excitation": {"kind": "ground", **excitation}}


def read(data, folder=EXAMPLES):
    return read_scene(data, str(folder / "scene.toml"))


@pytest.mark.regression
def test_ground_of_a_scene_is_that_of_its_record(tmp_path):
    """The same as the parts put together by hand, from a file and from rows."""
    rows = [[0.0, 0.0, 0.0], [0.02, 2.0, 1.0], [0.05, -1.0, 0.0]]
    (tmp_path / "record.csv").write_text(
        "time [s], x [m/s2],y [m/s2]\n" + "\n".join(",".join(map(str, row)) for row in rows)
    )
    scene = read(shaken(acceleration="record.csv", scale=2.0), tmp_path)
    assert read(shaken(acceleration=rows, scale=2.0)) == scene
    run = run_rotor(scene)
    assert run.trajectory.time[-1] == 0.05
    films, speed = scene.shaft.build_bearings(), scene.speed
    shaft = scene.shaft.build(speed)
    still = rotor_equilibrium(shaft, films, speed).displacement
    x, y = (0.0, 4.0, -2.0), (0.0, 2.0, 0.0)
    ground = BaseMotion(times=(0.0, 0.02, 0.05), acceleration_x=x, acceleration_y=y)
    model = BaseExcitedRotor(rotor=replace(shaft, initial=(*still, *0.0 * still)), base=ground)
    wanted = simulate_rotor(mount(model, films), duration=0.05, times=run.trajectory.time, rtol=1e-9)
    assert_allclose(run.trajectory["disk_x"], wanted["disk_x"], atol=1e-9)
    assert run.peaks["disk"] == pytest.approx(np.hypot(wanted["disk_x"], wanted["disk_y"]).max(), rel=1e-4)


@pytest.mark.closed_form
def test_displacement_and_spectrum_of_the_ground():
    """A cosine of 1 mm has w^2 mm/s2; a flat spectrum has the rms of its integral."""
    times = np.linspace(0.0, 2.0 * math.pi, 201)
    rows = np.column_stack([times, 1e-3 * np.cos(times)]).tolist()
    motion = read(shaken(displacement=rows)).excitation.motion(1.0)
    assert_allclose(motion.rows[1], -1e-3 * np.cos(times), atol=2e-7)
    flat = read(shaken(spectrum=[[10.0, 0.5], [110.0, 0.5]], scale=2.0, seed=3)).excitation.motion(40.0)
    assert_allclose(flat.rows[1:].std(axis=1), 2.0 * math.sqrt(50.0), rtol=0.02)


@pytest.mark.closed_form
def test_a_spectrum_is_a_sum_of_cosines_with_random_phases():
    omega, power, duration = np.array([30.0, 250.0]), np.array([1e-3, 2e-3]), 3.0
    motion = BaseMotion.from_spectrum(omega, power, duration=duration, seed=1)
    count = math.ceil(220.0 * duration / (2.0 * math.pi))
    step = 220.0 / count
    middle = 30.0 + step * (np.arange(count) + 0.5)
    size = np.sqrt(2.0 * step * np.interp(middle, omega, power))
    phases = np.random.default_rng(1).uniform(0.0, 2.0 * math.pi, (2, count))
    wanted = [np.cos(np.outer(motion.times, middle) + phase) @ size for phase in phases]
    assert_allclose(motion.rows[1:], wanted, atol=1e-10)


@pytest.mark.closed_form
def test_a_motor_speeds_up_a_balanced_rotor():
    """I w' = T (1 - w / w0) - r w, from operation.speed on."""
    scene = Scene.load(EXAMPLES / "weak_motor.toml")
    motor = replace(scene.excitation, unbalance=0.0, resistance=1e-3)
    run = run_rotor(replace(scene, excitation=motor))
    slope = motor.stall_torque / motor.idle_speed + motor.resistance
    end = motor.stall_torque / slope
    time = run.trajectory.time
    wanted = end + (scene.speed - end) * np.exp(-slope * time / motor.inertia)
    assert_allclose(run.trajectory["speed"], wanted, rtol=1e-5)
    assert run.end_speed == pytest.approx(wanted[-1], rel=1e-5)


def test_a_motor_turns_a_shaft_on_films():
    """Without unbalance: the same torque on the inertia; the names of the last bearing stay."""
    data = shaken(acceleration=[[0.0, 0.0], [1.0, 0.0]])
    data["excitation"] = {
        "kind": "motor",
        "unbalance": 0.0,
        "inertia": 0.5,
        "stall_torque": 50.0,
        "idle_speed": "3000 rpm",
    }
    data["operation"]["duration"] = 2e-3
    data["shaft"]["unbalances"] = []
    scene = read(data)
    assert isinstance(scene.excitation, MotorTable)
    run = run_rotor(scene)
    assert {"left", "right", "disk"} == set(run.peaks)
    gained = 50.0 * (1.0 - 0.5) / 0.5 * 2e-3
    assert run.end_speed - scene.speed == pytest.approx(gained, rel=1e-3)


def test_a_run_up_ends_at_its_speed():
    scene = Scene.load(EXAMPLES / "critical_run_up.toml")
    run = run_rotor(replace(scene, excitation=replace(scene.excitation, duration=0.02)))
    assert run.end_speed == pytest.approx(scene.excitation.end_speed)
    assert run.contact_time is None
    assert run.trajectory.work["steps"] > 10


@pytest.mark.parametrize(
    ("excitation", "said"),
    [
        ({}, "one of acceleration, displacement and spectrum must be given"),
        ({"acceleration": "none.csv"}, r"excitation\.acceleration must be a file of rows of numbers"),
        ({"acceleration": [[0.0, 1.0]]}, "must be 2 to 1000000 rows of 2 or 3 numbers"),
        ({"acceleration": [[0.0, 1.0], [0.0, 2.0]]}, "the first column must increase strictly"),
        ({"acceleration": [[0.0, 1.0], [1.0, "x"]]}, "row 1 must be 2 numbers"),
        ({"spectrum": [[1.0, 1.0, 1.0], [2.0, 1.0, 1.0]]}, "spectrum must have 2 columns, got 3"),
        ({"acceleration": [[0, 0], [1, 1]], "displacement": [[0, 0], [1, 1]]}, "one of acceleration"),
    ],
)
def test_records_that_are_none(excitation, said):
    with pytest.raises(SceneError, match=said):
        read(shaken(**excitation))


@pytest.mark.parametrize(
    ("key", "heading", "said"),
    [
        ("acceleration", "time [s],x [mm]", r"column 2 must be x \[m/s2\], got 'x \[mm\]'"),
        ("acceleration", "time [s],y [m/s2]", r"column 2 must be x \[m/s2\], got 'y \[m/s2\]'"),
        ("acceleration", "time [ms],x [m/s2]", r"column 1 must be time \[s\], got 'time \[ms\]'"),
        ("displacement", "time [s],x [m/s2]", r"column 2 must be x \[m\], got"),
        ("spectrum", "frequency [Hz],density [m2/s3]", r"column 1 must be frequency \[rad/s\], got"),
        ("spectrum", "frequency [rad/s],x,y", "must have at most 2 columns, got"),
    ],
)
def test_headings_say_what_the_columns_are(tmp_path, key, heading, said):
    (tmp_path / "record.csv").write_text(f"{heading}\n0.0,0.0\n1.0,2.0\n")
    with pytest.raises(SceneError, match=rf"scene.toml: excitation\.{key}:? {said}"):
        read(shaken(**{key: "record.csv"}), tmp_path)


@pytest.mark.skipif(os.name != "posix", reason="a device of POSIX")
def test_ground_that_never_ends_is_refused(tmp_path):
    (tmp_path / "record.csv").symlink_to("/dev/zero")
    with pytest.raises(SceneError, match=r"acceleration must be a file of rows of numbers.* regular file"):
        read(shaken(acceleration="record.csv"), tmp_path)


@pytest.mark.parametrize("heading", ["", "time [s],x [m/s2]\n", '\ufeff"time  [s]", "x [m/s2]"\n'])
def test_right_headings_and_none_are_taken(tmp_path, heading):
    (tmp_path / "record.csv").write_text(f"{heading}0.0,0.0\n1.0,2.0\n", encoding="utf-8")
    scene = read(shaken(acceleration="record.csv"), tmp_path)
    assert scene.excitation.acceleration == ((0.0, 1.0), (0.0, 2.0))


@pytest.mark.parametrize(
    "excitation",
    [{"kind": "step", "load": "1 N"}, {"kind": "sine", "load": "1 N", "frequency": "3 Hz"}],
)
def test_other_excitations_are_refused(excitation):
    kinds = "unbalance, blade_loss, run_up, motor or ground"
    said = f"excitation.kind must be {kinds} here, got {excitation['kind']}"
    with pytest.raises(InputError) as error:
        run_rotor(read(shaken() | {"excitation": excitation}))
    assert str(error.value) == said


@pytest.mark.parametrize("kind", ["motor", "ground"])
def test_runs_on_a_damper_name_what_they_do_not_take(kind):
    scene = Scene.load(EXAMPLES / "weak_motor.toml")
    if kind == "ground":
        scene = replace(scene, excitation=GroundTable(acceleration=((0.0, 1.0), (0.0, 1.0))))
    said = f"excitation.kind must be unbalance, blade_loss or run_up here, got {kind}"
    with pytest.raises(InputError, match=said):
        run_damper(scene)


@pytest.mark.closed_form
def test_displacement_at_rest_is_beside_the_peak():
    """On ground that does not shake, without unbalance, the peak is the sag, that of the equilibrium."""
    data = shaken(acceleration=[[0.0, 0.0], [0.02, 0.0]])
    data["shaft"]["unbalances"] = []
    scene = read(data)
    run = run_rotor(scene)
    rest = rotor_equilibrium(scene.shaft.build(scene.speed), scene.shaft.build_bearings(), scene.speed)
    sag = np.hypot(*rest.displacement.reshape(2, -1)[:, 2 * 4])  # the disk is at node 4
    assert run.at_rest["disk"] == pytest.approx(sag, rel=1e-6)
    assert run.peaks["disk"] == pytest.approx(sag, rel=1e-4)
    assert run.vibrations["disk"] < 1e-4 * sag
    assert sag > 5e-4


def test_vibration_is_about_the_place_at_rest_and_its_speed_is_told():
    run = run_rotor(Scene.load(EXAMPLES / "critical_run_up.toml"))
    x, y, speed = (run.trajectory[name] for name in ("disk_x", "disk_y", "speed"))
    far = [np.hypot(x[k] - x[0], y[k] - y[0]) for k in range(x.size)]
    assert run.vibrations["disk"] == pytest.approx(max(far), rel=1e-12)
    assert run.vibration_speeds["disk"] == speed[far.index(max(far))]
    assert abs(run.peaks["disk"] - run.at_rest["disk"]) < run.vibrations["disk"] < run.peaks["disk"]


@pytest.mark.long
def test_a_run_with_too_few_samples_a_turn_says_so(monkeypatch):
    monkeypatch.setattr(rotor_runs, "FEWEST", 11)
    monkeypatch.setattr(rotor_runs, "MOST", 21)
    scene = Scene.load(EXAMPLES / "weak_motor.toml")
    with pytest.warns(ValidityWarning, match=r"21 samples of a run are 1.05 in a turn at the highest speed"):
        run_rotor(scene)


def test_a_film_without_a_temperature_over_time_is_refused_by_name():
    film = JFOFilm(
        bearing=JournalBearing(
            radius=0.05,
            length=0.05,
            clearance=1e-4,
            oil=Oil.iso_vg(32),
            cooling=Cooling(supply_temperature=313.15),
            grooves=(Groove(center=0.0, width=0.3),),
        )
    )
    with pytest.raises(InputError, match="film must be a law with a heat balance over time"):
        from_rest(film, np.zeros(2), 300.0, 330.0)


def test_a_shaft_on_warm_films_and_pads_stays_where_it_rests():
    """Films begin as warm, and pads as tilted, as at rest: all rates are 0, those of temperatures too."""
    size = {"radius": 0.05, "length": 0.05}
    oil = {"oil": Oil.iso_vg(32), "cooling": Cooling(supply_temperature=313.15)}
    steel = ElasticMaterial(young_modulus=2.11e11, shear_modulus=8.12e10, density=7810.0)
    shaft = ShaftRotor(
        elements=ShaftElement(length=1.0, outer_diameter=0.06, material=steel).split(4),
        disks=(Disk(node=2, mass=50.0, polar_inertia=0.2, diametral_inertia=0.1),),
        stations=(Station(node=0, name="left"), Station(node=4, name="right")),
        speed=300.0,
    )
    pads = TiltingPadBearing(
        **size, **oil, pivots=even_pivots(5), extent=1.0, preload=0.3, assembled_clearance=7e-5
    )
    bearings = {"left": JournalBearing(**size, clearance=1e-4, **oil), "right": pads}
    at = rotor_equilibrium(shaft, bearings, 300.0)
    still = at.displacement
    whole = mount(replace(shaft, initial=(*still, *0.0 * still)), from_shaft_rest(bearings, at))
    nominal = np.array([signal.nominal for signal in whole.states])
    rates = whole.derivative(0.0, whole.initial_state, ()) / (300.0 * nominal)
    assert len(whole.states) == 2 * len(still) + 1 + 5
    assert_allclose(rates, 0.0, atol=1e-6)
    cold = mount(whole.rotor, {**from_shaft_rest(bearings, at), "left": bearings["left"]})
    assert np.abs(cold.derivative(0.0, cold.initial_state, ()) / (300.0 * nominal)).max() > 1e-3
