"""A flexible rotor as a native FMU, coupled with two film FMUs."""

from dataclasses import replace
from pathlib import Path

import fmpy
import numpy as np
import pytest
from numpy.testing import assert_allclose
from scipy.integrate import solve_ivp
from scipy.linalg import expm

from rotorfilm import ConvergenceError, InputError
from rotorfilm.analysis import rotor_equilibrium, unbalance_response
from rotorfilm.bearings import LinearBearing
from rotorfilm.bearings.journal import JournalBearing
from rotorfilm.core import names
from rotorfilm.cosim import open_fmu
from rotorfilm.fmu import describe_fmu, export_fmu
from rotorfilm.rotors import (
    Disk,
    ElasticMaterial,
    Probe,
    ShaftElement,
    ShaftRotor,
    SpeedProfile,
    Station,
    SteadyRotor,
    Unbalance,
    mount,
    reduce_rotor,
)
from rotorfilm.scenes import export_machine_fmu, export_rotor_fmu, parse_scene
from rotorfilm.scenes.export_scene import export_scene

SPEED = 1500.0 * np.pi / 30.0
STEEL = ElasticMaterial(young_modulus=211e9, shear_modulus=81.2e9, density=7810.0)
FILM = JournalBearing(radius=0.05, length=0.03, clearance=1e-4, viscosity=0.1)
FILMS = {"left": FILM, "right": FILM}
MOTION = ("x", "y", "vx", "vy")


def rotor(**changes):
    disk = {"density": 7810.0, "width": 0.07, "inner_diameter": 0.05}
    parts = {
        "elements": ShaftElement(length=1.5, outer_diameter=0.05, material=STEEL).split(6),
        "disks": (Disk.solid(2, outer_diameter=0.28, **disk), Disk.solid(4, outer_diameter=0.35, **disk)),
        "stations": (Station(node=0, name="left"), Station(node=6, name="right")),
        "probes": (Probe(node=2, name="small"),),
        "unbalances": (Unbalance(node=2, unbalance=2e-3, unbalance_angle=0.3),),
        "speed": SPEED,
    }
    return ShaftRotor(**(parts | changes))


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    return tmp_path_factory.mktemp("fmus")


@pytest.fixture(scope="module")
def reduction(folder):
    found = export_rotor_fmu(rotor(), folder / "rotor.fmu", frequency=500.0, bearings=FILMS)
    for name in FILMS:
        export_fmu(FILM, folder / f"{name}.fmu", component="film", start={"speed": SPEED})
    return found


@pytest.mark.closed_form
@pytest.mark.parametrize("speed", [SPEED, -SPEED, 0.0])
def test_steady_rotor_is_the_rotor(speed):
    """Turned by the exact exponential, the state moves as the rotor's own equations say, at any time."""
    model = rotor(speed=speed, internal_damping=1e-5)
    steady = SteadyRotor(rotor=model)
    n = len(model.states)
    u = np.array([10.0, -20.0, 30.0, 5.0])
    A, B, C, _ = steady.linearization(0.0, steady.initial_state, u)
    turning = expm(A[-3:, -3:] * 0.013) @ steady.initial_state[-3:]
    inner = 1e-5 * np.random.default_rng(0).standard_normal(n)
    x = np.concatenate([inner, turning])
    wanted = model.derivative(0.013, inner, u)
    assert_allclose(steady.derivative(0.0, x, u)[:n], wanted, atol=1e-10 * np.abs(wanted).max())
    assert_allclose(steady.output(0.0, x, u), model.output(0.013, inner, u), rtol=1e-12)
    assert_allclose(A @ x + B @ u, steady.derivative(0.0, x, u))
    assert names(steady.outputs) == names(model.outputs)
    assert len(C) == len(steady.outputs)


@pytest.mark.long
def test_its_signals_are_those_of_the_stations(reduction, folder):
    variables = {v.name: v for v in fmpy.read_model_description(str(folder / "rotor.fmu")).modelVariables}
    for name in FILMS:
        assert {f"rotor.{name}_{signal}" for signal in (*MOTION, "force_x", "force_y")} <= set(variables)
    assert {"rotor.speed", "rotor.small_x"} <= set(variables)
    load = rotor_equilibrium(reduction.rotor, FILMS, SPEED).loads["left"][1]
    assert float(variables["rotor.left_force_y"].start) == pytest.approx(-load, rel=1e-6)


@pytest.mark.closed_form
def test_one_long_step_is_exact_however_stiff_the_shaft(reduction, folder):
    """A tenth of a second at once under held forces; the fastest mode turns a hundred times in it."""
    u = np.array([10.0, 300.0, -20.0, 400.0])
    steady = SteadyRotor(rotor=reduction.rotor)
    A, B, C, _ = steady.linearization(0.0, steady.initial_state, u)
    n = len(A)
    block = np.zeros((n + 4, n + 4))
    block[:n] = 0.1 * np.hstack([A, B])
    state = expm(block)[:n] @ np.concatenate([steady.initial_state, u])
    assert np.abs(np.linalg.eigvals(A)).max() * 0.1 > 500.0
    with open_fmu(folder / "rotor.fmu") as fmu:
        fmu.start(dict(zip(fmu.inputs, u, strict=True)))
        fmu.step(0.0, 0.1)
        answer = fmu.get()
    scale = np.array([signal.nominal for signal in steady.outputs])
    assert_allclose(
        np.array([answer[k] for k in names(steady.outputs)]) / scale, C @ state / scale, atol=1e-7
    )


def coupled(folder, loads, step, duration):
    """Gauss-Seidel: the rotor under held forces, then both films at its new motion."""
    with (
        open_fmu(folder / "rotor.fmu") as turning,
        open_fmu(folder / "left.fmu") as left,
        open_fmu(folder / "right.fmu") as right,
    ):
        films = {"left": left, "right": right}

        def motion(name, y):
            return {signal: y[f"{name}_{signal}"] for signal in MOTION} | {"speed": y["speed"]}

        def forces():
            return {f"{name}_{k}": v for name, film in films.items() for k, v in film.get().items()}

        turning.start({f"{k}_force_{axis}": -loads[k][i] for k in films for i, axis in enumerate("xy")})
        y = turning.get()
        for name, film in films.items():
            film.start(motion(name, y))
        for k in range(round(duration / step)):
            turning.set(forces())
            turning.step(k * step, step)
            y = turning.get()
            for name, film in films.items():
                film.set(motion(name, y))
                film.step(k * step, step)
        return y


def spectral_radius(steady, at, step):
    """Return the growth per macro step of the linearized coupling."""
    A, B, C, _ = steady.linearization(0.0, steady.initial_state, np.zeros(4))
    labels = names(steady.outputs)
    slopes = np.zeros((4, len(labels)))
    for k, name in enumerate(FILMS):
        columns = [labels.index(f"{name}_{signal}") for signal in MOTION]
        slopes[2 * k : 2 * k + 2, columns] = FILM.jacobian(at.coefficients[name].position, [0.0, 0.0], SPEED)[
            :, :4
        ]
    n = len(A)
    block = np.zeros((n + 4, n + 4))
    block[:n] = step * np.hstack([A, B])
    exact = expm(block)
    whole = exact[:n, :n] + exact[:n, n:] @ slopes @ C
    return np.abs(np.linalg.eigvals(whole[:-3, :-3])).max()


@pytest.mark.long
@pytest.mark.convergence
def test_three_fmus_move_as_the_monolithic_model(reduction, folder):
    """Below the critical macro step, 4.35 us here, the error is small and of first order."""
    at = rotor_equilibrium(reduction.rotor, FILMS, SPEED)
    steady = SteadyRotor(rotor=reduction.rotor)
    assert spectral_radius(steady, at, 4e-6) < 1.0 < spectral_radius(steady, at, 5e-6)
    model = mount(reduction.rotor, FILMS)
    scale = np.array([signal.nominal for signal in model.states])
    end = solve_ivp(
        lambda t, x: model.derivative(t, x, []),
        (0.0, 0.006),
        model.initial_state,
        method="Radau",
        jac=lambda t, x: model.linearization(t, x, []).A,
        rtol=1e-9,
        atol=1e-9 * scale,
    ).y[:, -1]
    wanted = dict(zip(names(model.outputs), model.output(0.006, end, []), strict=True))
    places = ["left_x", "left_y", "right_x", "right_y", "small_x", "small_y"]

    def error(step):
        found = coupled(folder, at.loads, step, 0.006)
        return max(abs(found[k] - wanted[k]) for k in places) / FILM.clearance

    moved = max(abs(wanted[f"{k}_y"] - at.coefficients[k].position[1]) for k in FILMS) / FILM.clearance
    errors = [error(4e-6), error(2e-6)]
    assert errors[0] < 1e-3 * moved
    assert errors[0] / errors[1] == pytest.approx(2.0, rel=0.15)


@pytest.mark.filterwarnings(
    "ignore:speeds should be below the threshold", "ignore:the journal of 'left' should"
)
@pytest.mark.parametrize("tolerance", [1e-2, 1e-3])
def test_the_error_of_a_reduction_holds_for_the_response_on_films(tolerance):
    """Unbalance response of journals, at speeds that the search did not look at, within the error stated."""
    whole = rotor()
    reduction = reduce_rotor(whole, frequency=450.0, tolerance=tolerance)
    speeds = np.array([61.3, 97.7, 203.9, 333.3, 447.1])
    one, other = (unbalance_response(r, FILMS, speeds).complex[:4, 0] for r in (whole, reduction.rotor))
    size = np.linalg.norm(one, axis=0)
    deviation = np.linalg.norm(one - other, axis=0) / size
    assert 0.0 < reduction.error <= tolerance
    # a resonance of rotor and film multiplies the error of the rotor by a few
    assert deviation.max() < 5.0 * reduction.error
    coarser = reduce_rotor(whole, frequency=450.0, tolerance=30.0 * tolerance)
    if coarser.rotor.modes < reduction.rotor.modes:
        rough = unbalance_response(coarser.rotor, FILMS, speeds).complex[:4, 0]
        assert np.max(np.linalg.norm(one - rough, axis=0) / size) > deviation.max()


def test_what_no_linear_fmu_can_be_is_refused(tmp_path):
    run_up = SpeedProfile(times=(0.0, 1.0), speeds=(0.0, 100.0))
    with pytest.raises(InputError, match="rotor must have a constant speed, got SpeedProfile"):
        export_rotor_fmu(rotor(speed=run_up), tmp_path / "rotor.fmu", frequency=300.0)
    with pytest.raises(InputError, match="loss_factor must be 0 over time"):
        SteadyRotor(rotor=rotor(loss_factor=0.01))
    with pytest.raises(ConvergenceError, match="tolerance must be within reach"):
        export_rotor_fmu(rotor(), tmp_path / "rotor.fmu", frequency=300.0, tolerance=1e-30)


def test_without_bearings_it_begins_straight(tmp_path):
    small = export_rotor_fmu(rotor(), tmp_path / "rotor.fmu", "3.0", frequency=300.0, tolerance=1e-2).rotor
    assert small.initial == ()
    moved = replace(small, speed=2.0)
    assert len(SteadyRotor(rotor=moved).states) == len(small.states) + 3


@pytest.mark.long
@pytest.mark.closed_form
def test_scene_becomes_one_fmu_of_rotor_and_bearings_that_moves_as_the_model(tmp_path):
    """After an eighth of a turn under its unbalance it is where Radau takes the model."""
    text = (Path(__file__).parents[2] / "examples" / "flexible_rotor.toml").read_text(encoding="utf-8")
    scene = parse_scene(text.replace("[shaft]", '[operation]\nspeed = "1500 rpm"\n[shaft]', 1), "flexible")
    made = export_scene(scene, tmp_path)
    assert made["system"].name == "system.fmu"
    known = {v.name: v for v in fmpy.read_model_description(str(made["system"])).modelVariables}
    assert {"system.left_x", "system.right_force_y", "system.small_x"} <= set(known)
    bearings = scene.shaft.build_bearings()
    small = reduce_rotor(
        scene.shaft.build(speed=scene.speed), frequency=scene.shaft.highest_frequency, tolerance=1e-3
    ).rotor
    at = rotor_equilibrium(small, bearings, scene.speed).displacement
    model = mount(replace(small, initial=(*at.tolist(), *np.zeros(len(at)).tolist())), bearings)
    end = 0.125 * 2.0 * np.pi / scene.speed
    run = solve_ivp(
        lambda t, x: model.derivative(t, x, []),
        (0.0, end),
        model.initial_state,
        "Radau",
        rtol=1e-8,
        atol=1e-11,
    )
    wanted = dict(zip(names(model.outputs), model.output(end, run.y[:, -1], []), strict=True))
    with open_fmu(made["system"]) as fmu:
        fmu.start({})
        fmu.step(0.0, end)
        found = fmu.get()
    for name in ("left_x", "left_y", "right_y"):
        assert found[name] == pytest.approx(wanted[name], abs=1e-10)


def run_machine(path, outputs, start):
    given = {f"machine.{name}": value for name, value in start.items()}
    shown = [f"machine.{name}" for name in outputs]
    run = fmpy.simulate_fmu(str(path), start_values=given, stop_time=0.02, output_interval=1e-3, output=shown)
    return np.array([run[name] for name in shown])


@pytest.mark.long
@pytest.mark.closed_form
def test_unbalances_of_a_machine_are_parameters_of_its_fmu(tmp_path):
    """Amounts and angles in two planes, set in one FMU, move it as the rotor that has them."""
    there = (Unbalance(node=2, unbalance=5e-4, unbalance_angle=-0.7), Unbalance(node=4, unbalance=1e-4))
    bare = (Unbalance(node=2, unbalance=3e-4, unbalance_angle=0.3), Unbalance(node=4, unbalance=0.0))
    model = export_machine_fmu(rotor(unbalances=there), FILMS, tmp_path / "there.fmu", frequency=500.0)
    export_machine_fmu(rotor(unbalances=bare), FILMS, tmp_path / "machine.fmu", frequency=500.0)
    outputs = ["small_x", "left_y", "left_force_y"]
    values = {"plane_2_unbalance": 5e-4, "plane_2_unbalance_angle": -0.7, "plane_4_unbalance": 1e-4}
    wanted = run_machine(tmp_path / "there.fmu", outputs, {})
    assert_allclose(run_machine(tmp_path / "machine.fmu", outputs, values), wanted, rtol=1e-9)
    other = run_machine(tmp_path / "machine.fmu", outputs, {})
    assert np.abs(other[0] - wanted[0]).max() > 1e-7
    still = run_machine(tmp_path / "machine.fmu", outputs, {"plane_2_unbalance": 0.0})
    assert_allclose(still, np.broadcast_to(still[:, :1], still.shape), rtol=1e-6)
    assert abs(model.native().tables["unbalance"]).max() < 1e-12


def test_a_machine_starts_at_rest_in_its_films_at_the_speed_that_its_importer_gives(tmp_path):
    """With the speed as an input, and no unbalance in its plane."""
    path = tmp_path / "driven.fmu"
    there = rotor(unbalances=(Unbalance(node=2, unbalance=0.0),))
    model = export_machine_fmu(there, FILMS, path, frequency=200.0, speed_input=True, stop_time=1e-5)
    outputs = ["small_x", "left_y", "left_force_y", "speed"]
    found = run_machine(path, outputs, {})
    assert_allclose(found, np.broadcast_to(found[:, :1], found.shape), rtol=1e-6)
    assert_allclose(found[3], SPEED)
    assert {signal.name for signal in model.inputs} >= {"prescribed_speed", "prescribed_acceleration"}
    assert "constant_speed" not in {one.name for one in model.native().parameters}
    values = {"prescribed_speed": 1.2 * SPEED}
    assert np.abs(run_machine(path, outputs, values)[1] - found[1]).max() > 1e-7


def test_a_machine_in_springs_is_an_fmu_in_python_and_planes_are_beside_bearings(tmp_path):
    springs = dict.fromkeys(("left", "right"), LinearBearing(stiffness=1e7, damping=1e4))
    path = tmp_path / "machine.fmu"
    export_machine_fmu(rotor(), springs, path, frequency=200.0, stop_time=1e-3)
    assert "PythonFMU" in describe_fmu(path)["generation_tool"]
    with pytest.raises(
        InputError, match=r"stations must be at different nodes for a reduction, got .*plane_0"
    ):
        export_machine_fmu(
            rotor(unbalances=(Unbalance(node=0, unbalance=1e-4),)), springs, path, frequency=200.0
        )
