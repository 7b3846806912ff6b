"""Native FMUs beside Python: simulated trajectories, derivatives, state spaces, own sources, own files."""

import io
import os
import re
import subprocess
import sys
import zipfile
from dataclasses import replace
from pathlib import Path

import control
import fmpy
import numpy as np
import pytest
from fmpy.fmi1 import FMICallException
from fmpy.validation import validate_fmu
from lxml import etree
from scipy.linalg import expm

from rotorfilm import FmuError, JournalBearing
from rotorfilm.analysis import equilibrium, linearize
from rotorfilm.bearings.journal import MapFilm
from rotorfilm.fmu import check_fmu, export_fmu, extracted, instantiated
from rotorfilm.rotors import RigidRotor, SpeedProfile

BEARING = JournalBearing(radius=0.05, length=0.03, clearance=1e-4, viscosity=0.1, film=MapFilm())
MASS, SPEED, UNBALANCE = 50.0, 157.0, 8e-4
ROTOR = RigidRotor(mass=MASS, speed=SPEED, unbalance=UNBALANCE, gravity=(0.0, 0.0))
VERSIONS = ["2.0", "3.0"]
INTERFACES = ["CoSimulation", "ModelExchange"]
INPUTS = ["x", "y", "vx", "vy", "speed"]


def signals(rows):
    """Return a table of inputs for fmpy: time and columns by name."""
    names = ["time", *(f"bearing.{name}" for name in INPUTS)]
    return np.array([tuple(row) for row in rows], dtype=[(name, float) for name in names])


@pytest.fixture
def open_fmu(tmp_path):
    """Return a function (model, version, exchange) -> (instance, value references by name)."""
    held = []

    def open_one(model, version, exchange, **options):
        path = export_fmu(
            model, tmp_path / f"{len(held)}.fmu", version, "native", component="part", **options
        )
        context = extracted(path)
        description, folder = context.__enter__()
        instance = instantiated(description, folder, exchange)
        held.append((context, instance))
        return instance, {v.name: v.valueReference for v in description.modelVariables}

    yield open_one
    for context, instance in held:
        instance.close()
        context.__exit__(None, None, None)


@pytest.mark.parametrize("interface", INTERFACES)
@pytest.mark.parametrize("version", VERSIONS)
def test_fmpy_simulates_a_film_to_the_forces_of_python(version, interface, tmp_path):
    time = np.linspace(0.0, 0.02, 21)
    angle = SPEED * time
    rows = np.column_stack(
        [
            time,
            5e-5 * np.cos(angle),
            4e-5 * np.sin(angle),
            -5e-5 * SPEED * np.sin(angle),
            4e-5 * SPEED * np.cos(angle),
            np.full_like(time, SPEED),
        ]
    )
    path = export_fmu(BEARING, tmp_path / "film.fmu", version, component="bearing", start={"x": 5e-5})
    result = fmpy.simulate_fmu(
        str(path),
        fmi_type=interface,
        input=signals(rows),
        stop_time=0.02,
        step_size=1e-3,
        output_interval=1e-3,
        output=[*(f"bearing.{name}" for name in INPUTS), "bearing.force_x", "bearing.force_y"],
    )
    assert len(result) == 21
    for row in result:
        u = [row[f"bearing.{name}"] for name in INPUTS]
        np.testing.assert_allclose(list(row)[-2:], BEARING.output(0.0, (), u), rtol=1e-12)


@pytest.mark.closed_form
@pytest.mark.parametrize("version", VERSIONS)
def test_fmpy_simulates_a_rotor_to_its_closed_form(version, tmp_path):
    path = export_fmu(ROTOR, tmp_path / "rotor.fmu", version, component="rotor")
    force, end = np.array([20.0, -30.0]), 0.05
    start = {"rotor.force_x": force[0], "rotor.force_y": force[1]}
    motion = ["rotor.x", "rotor.y", "rotor.vx", "rotor.vy"]
    angle = SPEED * end
    turn = np.array([1 - np.cos(angle), angle - np.sin(angle)])
    rate = np.array([np.sin(angle), 1 - np.cos(angle)])
    position = force * end**2 / (2 * MASS) + UNBALANCE / MASS * turn
    velocity = force * end / MASS + UNBALANCE / MASS * SPEED * rate
    # The second figure is the accuracy of fmpy's integrator.
    for interface, tolerance in (("CoSimulation", 1e-9), ("ModelExchange", 1e-4)):
        result = fmpy.simulate_fmu(
            str(path),
            fmi_type=interface,
            start_values=start,
            stop_time=end,
            step_size=1e-3,
            output_interval=1e-3,
            relative_tolerance=1e-8,
            output=motion,
        )
        found = [result[-1][name] for name in motion]
        np.testing.assert_allclose(found, [*position, *velocity], rtol=tolerance)


@pytest.mark.parametrize("version", VERSIONS)
@pytest.mark.parametrize("model", [BEARING, ROTOR], ids=["film", "rotor"])
def test_directional_derivatives_are_the_linearization(model, version, open_fmu):
    generator = np.random.default_rng(1)
    instance, references = open_fmu(model, version, True)
    inputs = [references[f"part.{s.name}"] for s in model.inputs]
    states = [references[f"part.state_{s.name}"] for s in model.states]
    outputs = [references[f"part.{s.name}"] for s in model.outputs]
    slopes = [references[f"der(part.state_{s.name})"] for s in model.states]
    instance.initialize([], [])
    for _ in range(5):
        u = 0.5 * generator.uniform(-1.0, 1.0, len(inputs)) * [s.nominal for s in model.inputs]
        instance.set(inputs, u.tolist())
        at = model.linearization(0.0, getattr(model, "initial_state", np.zeros(0)), u)
        expected = np.block([[at.D, at.C], [at.B, at.A]])
        found = np.array(
            [instance.directional([*outputs, *slopes], [k], [1.0]) for k in [*inputs, *states]]
        ).T
        np.testing.assert_allclose(found, expected, rtol=1e-12, atol=1e-15)
        seed = generator.normal(size=len(inputs)) * [s.nominal for s in model.inputs]
        along = instance.directional(outputs, inputs, seed.tolist())
        np.testing.assert_allclose(along, at.D @ seed, rtol=1e-12, atol=1e-12)


@pytest.mark.parametrize("version", VERSIONS)
def test_parameters_can_be_tuned_between_steps(version, open_fmu):
    instance, references = open_fmu(BEARING, version, False)
    state = [3e-5, -4e-5, 1e-3, 0.0, 157.0]
    inputs = [references[f"part.{name}"] for name in INPUTS]
    outputs = [references["part.force_x"], references["part.force_y"]]
    instance.initialize(inputs, state)
    for change in ({"viscosity": 0.03}, {"clearance": 8e-5}, {"radius": 0.04, "length": 0.06}):
        instance.step(0.0, 1e-3) if "viscosity" in change else None
        instance.set([references[f"part.{name}"] for name in change], list(change.values()))
        now = {name: instance.get([references[f"part.{name}"]])[0] for name in ("radius", "length")}
        now |= {name: instance.get([references[f"part.{name}"]])[0] for name in ("clearance", "viscosity")}
        expected = replace(BEARING, **now).output(0.0, (), state)
        np.testing.assert_allclose(instance.get(outputs), expected, rtol=1e-11)


@pytest.mark.closed_form
@pytest.mark.parametrize("version", VERSIONS)
@pytest.mark.parametrize(("states", "inputs", "outputs"), [(4, 2, 3), (1, 1, 1), (0, 2, 2), (3, 0, 2)])
def test_a_state_space_steps_exactly(states, inputs, outputs, version, open_fmu):
    generator = np.random.default_rng(states)
    A = generator.normal(size=(states, states)) - 3.0 * np.eye(states)
    B, C = generator.normal(size=(states, inputs)), generator.normal(size=(outputs, states))
    D = generator.normal(size=(outputs, inputs))
    system = control.StateSpace(A, B, C, D, remove_useless_states=False)
    instance, references = open_fmu(system, version, False)
    initial = generator.normal(size=states)
    knowns = [references[f"part.state_{name}"] for name in system.state_labels]
    u = generator.normal(size=inputs)
    ports = [references[f"part.{name}"] for name in system.input_labels]
    instance.initialize([*knowns, *ports], [*initial, *u])
    for k in range(3):
        instance.step(0.2 * k, 0.2)
    whole = np.zeros((states + inputs, states + inputs))
    whole[:states] = np.hstack([A, B])
    x = (expm(0.6 * whole) @ np.concatenate([initial, u]))[:states]
    found = instance.get([references[f"part.{name}"] for name in system.output_labels])
    np.testing.assert_allclose(found, C @ x + D @ u, rtol=1e-12, atol=1e-13)


def test_a_linearized_bearing_exports_like_any_system(tmp_path):
    at = equilibrium(BEARING, [0.0, -525.0], 157.0)
    film = linearize(BEARING, at, name="film")
    path = export_fmu(film, tmp_path / "film.fmu", "3.0", component="film")
    assert validate_fmu(str(path)) == []
    names = {v.name for v in fmpy.read_model_description(str(path)).modelVariables}
    assert {f"film.{label}" for label in [*film.input_labels, *film.output_labels]} <= names
    assert [item.check for item in check_fmu(path) if item.passed is False] == []


def test_labels_that_no_identifier_can_be_are_quoted(tmp_path):
    system = control.ss(-1.0, 1.0, 1.0, 0.0, inputs=["torque (N m)"], outputs=["speed/rad"])
    path = export_fmu(system, tmp_path / "a.fmu", component="plant")
    assert validate_fmu(str(path)) == []
    names = [v.name for v in fmpy.read_model_description(str(path)).modelVariables]
    assert "plant.'torque (N m)'" in names


@pytest.mark.parametrize(
    ("system", "message"),
    [
        (control.ss(0.5, 1.0, 1.0, 0.0, 0.01), r"system must be continuous in time .*got dt = 0\.01"),
        (control.ss(np.inf, 1.0, 1.0, 0.0), "A must be finite"),
        (control.ss(-1.0, 1.0, 1.0, 0.0, inputs=["\u03c9"]), "signal names must be of ASCII"),
    ],
)
def test_systems_that_cannot_go_into_an_fmu_are_refused(system, message, tmp_path):
    with pytest.raises(FmuError, match=message):
        export_fmu(system, tmp_path / "a.fmu")


@pytest.mark.parametrize("version", VERSIONS)
def test_a_kink_of_the_speed_is_a_time_event(version, open_fmu):
    rotor = replace(ROTOR, speed=SpeedProfile(times=(0.01, 0.03), speeds=(40.0, 160.0)))
    instance, _ = open_fmu(rotor, version, True)
    assert instance.initialize([], []) == pytest.approx(0.01, rel=1e-12)
    instance.move(0.01, rotor.initial_state)
    assert instance.event() == pytest.approx(0.03, rel=1e-12)
    instance.move(0.03, rotor.initial_state)
    assert instance.event() is None


@pytest.mark.parametrize("version", VERSIONS)
@pytest.mark.parametrize("model", [BEARING, ROTOR, control.ss(-1.0, 1.0, 1.0, 0.0)])
def test_equal_models_give_equal_bytes(model, version, tmp_path):
    first = export_fmu(model, tmp_path / "a.fmu", version, component="part")
    second = export_fmu(model, tmp_path / "other" / "b.fmu", version, component="part")
    assert first.read_bytes() == second.read_bytes()
    other = export_fmu(model, tmp_path / "c.fmu", version, component="part", stop_time=0.2)
    tokens = {fmpy.read_model_description(str(path)).guid for path in (first, other)}
    assert len(tokens) == 2


@pytest.mark.long
def test_another_process_builds_the_same_bytes(tmp_path):
    script = (
        "import sys\nfrom rotorfilm import JournalBearing, MapFilm, export_fmu\n"
        "bearing = JournalBearing(radius=0.05, length=0.03, clearance=1e-4, viscosity=0.1, film=MapFilm())\n"
        "export_fmu(bearing, sys.argv[1], component='bearing')\n"
    )
    here = export_fmu(BEARING, tmp_path / "a.fmu", component="bearing")
    environment = {**os.environ, "PYTHONHASHSEED": "1"}
    subprocess.run(
        [sys.executable, "-c", script, tmp_path / "b.fmu"], check=True, env=environment, cwd=tmp_path
    )
    assert here.read_bytes() == (tmp_path / "b.fmu").read_bytes()


@pytest.mark.long
@pytest.mark.skipif(sys.platform == "win32", reason="the options are those of gcc and clang")
@pytest.mark.parametrize(("model", "version"), [(ROTOR, "2.0"), (BEARING, "3.0")])
def test_an_fmu_can_be_compiled_from_its_own_sources(model, version, tmp_path):
    path = export_fmu(model, tmp_path / "part.fmu", version, component="part")
    files = tmp_path / "files"
    with zipfile.ZipFile(path) as archive:
        archive.extractall(files)
        names = archive.namelist()
    binary = next(name for name in names if name.startswith("binaries/"))
    assert sum(name.startswith("sources/") for name in names) <= 40
    units = fmpy.read_model_description(str(path)).buildConfigurations[0].sourceFileSets[0].sourceFiles
    command = [
        os.environ.get("CC", "cc"),
        "-std=c99",
        "-O0",
        "-shared",
        "-fPIC",
        "-fvisibility=hidden",
        "-I.",
    ]
    target = files / binary
    target.unlink()
    try:
        subprocess.run([*command, *units, "-o", target, "-lm"], check=True, cwd=files / "sources")
    except FileNotFoundError:
        pytest.skip("no C compiler")
    compiled = tmp_path / "compiled.fmu"
    with zipfile.ZipFile(compiled, "w") as archive:
        for file in files.rglob("*"):
            archive.write(file, file.relative_to(files))
    assert [item.check for item in check_fmu(compiled) if item.passed is False] == []


@pytest.mark.parametrize("version", VERSIONS)
def test_what_belongs_into_an_fmu_is_there(version, tmp_path):
    path = export_fmu(BEARING, tmp_path / "a.fmu", version, component="bearing")
    with zipfile.ZipFile(path) as archive:
        entries = archive.namelist()
        map_size = archive.getinfo("resources/rotorfilm.bin").compress_size
        page = archive.read("documentation/index.html").decode()
        csv = np.genfromtxt(
            io.BytesIO(archive.read("documentation/reference.csv")), delimiter=",", names=True
        )
    assert entries == sorted(entries)
    assert {"documentation/licenses/rotorfilm.txt", "documentation/licenses/fmi.txt"} <= set(entries)
    assert "resources/rotorfilm.bin" in entries
    assert map_size < 0.25 * BEARING.native().tables["coefficients"].nbytes
    extra = {"2.0": "model.png", "3.0": "terminalsAndIcons/terminalsAndIcons.xml"}
    assert extra[version] in entries
    assert "sources/buildDescription.xml" in entries or version == "2.0"
    assert "J(e, w)" in page
    assert "<td>bearing.force_x</td>" in page
    row = csv[7]
    np.testing.assert_allclose(list(row)[-2:], BEARING.output(0.0, (), list(row)[1:6]), rtol=1e-14)


def test_the_schemas_of_fmi_accept_the_other_files(tmp_path):
    schemas = Path(fmpy.__file__).parent / "schema" / "fmi3"
    path = export_fmu(BEARING, tmp_path / "a.fmu", "3.0")
    names = {
        "sources/buildDescription.xml": "fmi3BuildDescription.xsd",
        "terminalsAndIcons/terminalsAndIcons.xml": "fmi3TerminalsAndIcons.xsd",
    }
    with zipfile.ZipFile(path) as archive:
        for name, schema in names.items():
            etree.XMLSchema(file=str(schemas / schema)).assertValid(etree.fromstring(archive.read(name)))


@pytest.mark.parametrize("version", VERSIONS)
def test_units_bounds_and_kinds_are_described(version, tmp_path):
    path = export_fmu(ROTOR, tmp_path / "a.fmu", version, component="rotor")
    description = fmpy.read_model_description(str(path))
    variables = {v.name: v for v in description.modelVariables}
    mass, speed = variables["rotor.mass"], variables["rotor.constant_speed"]
    assert (mass.variability, mass.unit, float(mass.min), float(mass.start)) == ("tunable", "kg", 0.0, MASS)
    assert (speed.variability, speed.displayUnit) == ("fixed", "rpm")
    assert variables["der(rotor.state_vx)"].unit == "m/s2"
    assert variables["der(rotor.state_x)"].derivative is variables["rotor.state_x"]
    known = {u.variable.name: [v.name for v in u.dependencies] for u in description.derivatives}
    assert known["der(rotor.state_x)"] == ["rotor.state_vx"]
    assert known["der(rotor.state_vx)"] == ["time", "rotor.force_x"]
    shown = {unit.name: unit.displayUnits for unit in description.unitDefinitions}
    rpm = next(display for display in shown["rad/s"] if display.name == "rpm")
    assert float(rpm.factor) * 2.0 * np.pi / 60.0 == pytest.approx(1.0, rel=1e-15)


@pytest.mark.parametrize("version", VERSIONS)
@pytest.mark.parametrize(
    ("interface", "status"), [("CoSimulation", "3 (error)"), ("ModelExchange", "2 (discard)")]
)
def test_a_film_at_the_wall_ends_fmpy(interface, status, version, tmp_path, capsys):
    rows = [[0.0, 0.0, 0.0, 0.0, 0.0, SPEED], [0.01, 2e-4, 0.0, 0.0, 0.0, SPEED]]
    path = export_fmu(BEARING, tmp_path / "film.fmu", version, component="bearing")
    with pytest.raises(
        FMICallException, match=r"fmi[23](Get|DoStep)\w* failed with status " + re.escape(status)
    ):
        fmpy.simulate_fmu(
            str(path),
            fmi_type=interface,
            input=signals(rows),
            stop_time=0.01,
            step_size=1e-3,
            output_interval=1e-3,
        )
    assert "must stay inside the clearance 0.0001 m, got an eccentricity of" in capsys.readouterr().out


def test_a_rotor_that_cannot_step_ends_fmpy_at_the_last_good_time(tmp_path):
    light = replace(ROTOR, mass=1e-3)
    path = export_fmu(light, tmp_path / "rotor.fmu", component="rotor")
    # From 5 ms on the acceleration is beyond the largest number.
    columns = [("time", float), ("rotor.force_x", float), ("rotor.force_y", float)]
    rows = np.array(
        [(0.0, 0.0, 0.0), (0.005, 0.0, 0.0), (0.005, 1e308, 0.0), (1.0, 1e308, 0.0)], dtype=columns
    )
    result = fmpy.simulate_fmu(
        str(path), fmi_type="CoSimulation", input=rows, stop_time=1.0, step_size=1e-3, output_interval=1e-3
    )
    assert 0.0 < result["time"][-1] <= 0.006
    assert np.isfinite([list(row) for row in result]).all()


def test_a_subclass_that_may_differ_has_no_kernel(tmp_path):
    class Twin(JournalBearing):
        """Two bearings side by side."""

    twin = Twin(radius=0.05, length=0.03, clearance=1e-4, viscosity=0.1, film=MapFilm())
    with pytest.raises(FmuError, match="must have a kernel in the C library"):
        export_fmu(twin, tmp_path / "twin.fmu", backend="native")
