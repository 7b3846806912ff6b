"""Other clients than fmpy: libcosim runs native FMUs, the FMU Manipulation Toolbox finds nothing wrong."""

import logging
from dataclasses import replace

import control
import fmpy
import numpy as np
import pytest
from scipy.integrate import DOP853

from rotorfilm import JournalBearing, ValidityWarning
from rotorfilm.analysis import simulate
from rotorfilm.bearings.journal import JFOFilm, MapFilm
from rotorfilm.bearings.oil import Cooling, Oil
from rotorfilm.cosim import Jacobi, critical_macro_step
from rotorfilm.fmu import export_fmu
from rotorfilm.rotors import RigidRotor, mount

BEARING = JournalBearing(radius=0.05, length=0.03, clearance=1e-4, viscosity=0.1, film=MapFilm())
ROTOR = RigidRotor(mass=50.0, speed=157.0, gravity=(0.0, 0.0), position=(2e-5, -4e-5))
PLANT = control.ss([[0.0, 1.0], [-400.0, -2.0]], [[0.0], [1.0]], [[1.0, 0.0]], [[0.0]])
BATH = JFOFilm(
    bearing=replace(BEARING, film=MapFilm()), cells=(16, 4), cavitation_pressure=-1e5, submerged=True
)
MODELS = {
    "film": BEARING,
    "rotor": ROTOR,
    "plant": PLANT,
    "system": mount(ROTOR, {"": BEARING}),
    "bath": BATH,
}


def references(path):
    return {v.name: v.valueReference for v in fmpy.read_model_description(str(path)).modelVariables}


@pytest.fixture
def cosim():
    """Return libcosim's Python modules, silenced; it has no wheels for some machines."""
    pytest.importorskip("libcosimpy")
    from libcosimpy import CosimExecution, CosimLogging, CosimObserver, CosimSlave

    CosimLogging.log_output_level(CosimLogging.CosimLogLevel.ERROR)
    return CosimExecution.CosimExecution, CosimSlave.CosimLocalSlave, CosimObserver.CosimObserver


def test_libcosim_gets_the_force_of_python(cosim, tmp_path):
    execution_of, slave_of, observer_of = cosim
    path = export_fmu(BEARING, tmp_path / "film.fmu", component="film")
    known = references(path)
    execution = execution_of.from_step_size(step_size=1_000_000)  # ns
    index = execution.add_local_slave(slave_of(fmu_path=str(path), instance_name="film"))
    observer = observer_of.create_last_value()
    execution.add_observer(observer)
    for name, value in {"film.x": 3e-5, "film.speed": 157.0}.items():
        assert execution.real_initial_value(index, known[name], value)
    assert execution.step(1)
    found = observer.last_real_values(index, [known["film.force_x"], known["film.force_y"]])
    expected = BEARING.force([3e-5, 0.0], [0.0, 0.0], 157.0)
    np.testing.assert_allclose(found, expected, rtol=1e-12)


def test_libcosim_steps_a_film_that_conserves_its_oil(cosim, tmp_path):
    from libcosimpy.CosimManipulator import CosimManipulator

    execution_of, slave_of, observer_of = cosim
    path = export_fmu(BATH, tmp_path / "film.fmu", component="film")
    known = references(path)
    execution = execution_of.from_step_size(step_size=1_000_000)
    index = execution.add_local_slave(slave_of(fmu_path=str(path), instance_name="film"))
    observer, manipulator = observer_of.create_last_value(), CosimManipulator.create_override()
    execution.add_observer(observer)
    execution.add_manipulator(manipulator)
    # It rests in the middle; from there the journal turns and goes to where it is held.
    film = BATH.start([0.0] * 5)
    for k, u in enumerate([[0.0] * 5, [3e-5, -6e-5, 0.0, 0.0, 157.0], [3e-5, -6e-5, 0.0, 0.0, 157.0]]):
        manipulator.slave_real_values(index, [known[f"film.{s.name}"] for s in BATH.inputs], u)
        assert execution.step(1)
        film, output, _ = BATH.step(film, 1e-3 * k, u, 1e-3)
    found = observer.last_real_values(index, [known[f"film.{s.name}"] for s in BATH.outputs])
    np.testing.assert_allclose(found, output, rtol=1e-9, atol=1e-12)


@pytest.mark.closed_form
def test_libcosim_moves_a_rotor_as_its_closed_form(cosim, tmp_path):
    execution_of, slave_of, observer_of = cosim
    path = export_fmu(ROTOR, tmp_path / "rotor.fmu", component="rotor")
    known = references(path)
    execution = execution_of.from_step_size(step_size=1_000_000)
    index = execution.add_local_slave(slave_of(fmu_path=str(path), instance_name="rotor"))
    observer = observer_of.create_last_value()
    execution.add_observer(observer)
    assert execution.real_initial_value(index, known["rotor.force_x"], 20.0)
    assert execution.step(50)
    x, vx = observer.last_real_values(index, [known["rotor.x"], known["rotor.vx"]])
    np.testing.assert_allclose([x, vx], [2e-5 + 0.5 * 0.4 * 0.05**2, 0.4 * 0.05], rtol=1e-11)


@pytest.mark.long
def test_libcosim_warms_a_film_as_simulate(cosim, tmp_path):
    execution_of, slave_of, observer_of = cosim
    cooling = Cooling(supply_temperature=310.25, bush_heat_capacity=20.0)
    film = replace(BEARING, viscosity=None, oil=Oil.iso_vg(100), cooling=cooling).in_time()
    # So much mass that it stays where it is.
    with pytest.warns(ValidityWarning, match="mass should be"):
        rotor = RigidRotor(mass=1e25, speed=157.0, gravity=(0.0, 0.0), position=(2e-5, -4e-5))
    start = {"x": 2e-5, "y": -4e-5, "speed": 157.0}
    path = export_fmu(film, tmp_path / "film.fmu", component="film", start=start)
    execution = execution_of.from_step_size(step_size=10_000_000)
    index = execution.add_local_slave(slave_of(fmu_path=str(path), instance_name="film"))
    observer = observer_of.create_last_value()
    execution.add_observer(observer)
    assert execution.step(100)
    found = observer.last_real_values(index, [references(path)["film.film_temperature"]])
    motion = simulate(rotor, film, duration=1.0, samples=2, rtol=1e-12, method=DOP853)
    np.testing.assert_allclose(found, motion["film_temperature"][-1], rtol=1e-10)
    assert found[0] > 313.0


def resting(eccentricity):
    """Return a rotor with speed parameter 1 at rest on the film."""
    x = eccentricity * BEARING.clearance
    load = -BEARING.force((x, 0.0), (0.0, 0.0), ROTOR.speed)
    mass = float(np.hypot(*load)) / (BEARING.clearance * ROTOR.speed**2)
    return RigidRotor(
        mass=mass, speed=ROTOR.speed, gravity=(0.0, 0.0), static_force=tuple(load), position=(x, 0.0)
    )


def swing_in_libcosim(cosim, folder, rotor, step, count):
    """Return the swing of the force from step to step, coupled by libcosim with all FMUs in parallel."""
    execution_of, slave_of, observer_of = cosim
    execution = execution_of.from_step_size(step_size=round(step * 1e9))
    x, _ = rotor.position
    start = {"x": x, "y": 0.0, "speed": rotor.speed}
    models = {
        "film": (BEARING, start),
        # A trace off its place, and under the film's force from the start.
        "rotor": (
            replace(rotor, position=(x + 1e-6 * BEARING.clearance, 0.0)),
            {"force_x": -rotor.static_force[0], "force_y": -rotor.static_force[1]},
        ),
    }
    places, known = {}, {}
    for name, (model, values) in models.items():
        path = export_fmu(model, folder / f"{name}.fmu", component=name, start=values)
        places[name] = execution.add_local_slave(slave_of(fmu_path=str(path), instance_name=name))
        known |= references(path)
    wires = [("rotor", signal, "film") for signal in ("x", "y", "vx", "vy", "speed")]
    wires += [("film", signal, "rotor") for signal in ("force_x", "force_y")]
    for source, signal, target in wires:
        failed = execution.connect_real_variables(
            places[source], known[f"{source}.{signal}"], places[target], known[f"{target}.{signal}"]
        )
        assert failed == 0
    observer = observer_of.create_last_value()
    execution.add_observer(observer)
    forces = []
    for _ in range(count):
        assert execution.step(1)
        forces.append(observer.last_real_values(places["film"], [known["film.force_x"]])[0])
    return np.abs(np.diff(forces, n=2))


@pytest.mark.parametrize("eccentricity", [0.5, 0.8])
def test_a_foreign_explicit_master_fails_where_theory_says(cosim, tmp_path, eccentricity):
    """Its parallel steps with held signals are Jacobi's: stable 5 % below that limit, not 5 % above."""
    rotor = resting(eccentricity)
    limit = critical_macro_step(rotor, BEARING, state=rotor.initial_state, scheme=Jacobi()).macro_step
    growth = {}
    for factor in (0.95, 1.05):
        (tmp_path / str(factor)).mkdir()
        swing = swing_in_libcosim(cosim, tmp_path / str(factor), rotor, factor * limit, 120)
        growth[factor] = np.linalg.norm(swing[80:]) / np.linalg.norm(swing[40:80])
    assert growth[0.95] < 0.8
    assert growth[1.05] > 1.25
    held = critical_macro_step(rotor, BEARING, state=rotor.initial_state).macro_step
    assert held > 1.5 * limit  # the same step is still stable in a Gauss-Seidel master


def test_libcosim_takes_a_rotor_with_its_film_at_a_step_that_breaks_their_coupling(cosim, tmp_path):
    # Explicit coupling fails here: the step is longer than twice the decay of the journal's squeeze damping.
    execution_of, slave_of, observer_of = cosim
    light = RigidRotor(mass=0.5, speed=157.0, static_force=(0.0, -525.0), unbalance=1e-4)
    system = mount(light, {"": BEARING})
    path = export_fmu(system, tmp_path / "system.fmu", component="system")
    known = references(path)
    step = round(np.radians(10.0) / 157.0 * 1e9)
    execution = execution_of.from_step_size(step_size=step)
    index = execution.add_local_slave(slave_of(fmu_path=str(path), instance_name="system"))
    observer = observer_of.create_last_value()
    execution.add_observer(observer)
    assert execution.step(180)
    names = [known[f"system.{name}"] for name in ("x", "y")]
    found = np.array(observer.last_real_values(index, names))
    exact = simulate(light, BEARING, duration=180 * step * 1e-9, rtol=1e-10).position[:, -1]
    assert np.linalg.eigvals(system.linearization(0.0, [*exact, 0.0, 0.0], []).A).real.min() < -2.0 / (
        step * 1e-9
    )
    np.testing.assert_allclose(found, exact, atol=1e-6 * BEARING.clearance)


@pytest.mark.parametrize("version", ["2.0", "3.0"])
@pytest.mark.parametrize("name", MODELS)
def test_the_fmu_manipulation_toolbox_finds_nothing_wrong(name, version, tmp_path, caplog):
    checker = pytest.importorskip("fmu_manipulation_toolbox.checker")
    operations = pytest.importorskip("fmu_manipulation_toolbox.operations")
    path = export_fmu(MODELS[name], tmp_path / f"{name}.fmu", version)
    fmu = operations.FMU(str(path))
    caplog.set_level(logging.INFO, "fmu_manipulation_toolbox")
    for operation in checker.get_checkers():
        fmu.apply_operation(operation())
    assert [record.message for record in caplog.records if record.levelno >= logging.WARNING] == []
    assert f"compliant with FMI-{version}" in caplog.text
