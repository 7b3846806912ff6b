"""The FMU of a bearing whose oil warms: the thermal state inside, as the model has it in Python."""

import shutil
import subprocess
from dataclasses import replace
from functools import cache
from pathlib import Path

import fmpy
import numpy as np
import pytest
from scipy.integrate import DOP853, solve_ivp

from rotorfilm import (
    Cooling,
    Groove,
    HeatedFilm,
    JournalBearing,
    Oil,
    RigidRotor,
    ShortFilm,
    ValidityWarning,
    export_fmu,
    simulate,
)
from rotorfilm.analysis import heated_equilibrium
from rotorfilm.bearings import Turbulence
from rotorfilm.bearings.journal import GroovedMapFilm, LayeredTemperature, MapFilm, ReynoldsFilm
from rotorfilm.fmu import check_fmu
from rotorfilm.native import FOLDER

HOST = Path(__file__).parents[2] / "benchmarks" / "step_host.c"
GROOVES = tuple(Groove(center=center, width=0.35) for center in (0.3, 3.4))
COARSE = GroovedMapFilm(cells=(32, 4), nodes=(6, 12, 12), largest_eccentricity_ratio=0.9)

COOLING = Cooling(
    supply_temperature=310.25, housing_conductance=3.0, ambient_temperature=300.0, bush_heat_capacity=20.0
)
START = {"x": 2e-5, "y": -3e-5, "vx": 1e-4, "vy": -2e-3, "speed": 157.0}


@pytest.fixture(scope="module", autouse=True)
def _kept(tmp_path_factory):
    """Keep the maps of this module in a folder of its own."""
    with pytest.MonkeyPatch.context() as patch:
        patch.setenv("ROTORFILM_CACHE", str(tmp_path_factory.mktemp("maps")))
        yield


def bearing(film):
    size = {"radius": 0.05, "length": 0.03, "clearance": 1e-4, "oil": Oil.iso_vg(100)}
    return JournalBearing(**size, cooling=COOLING, film=film, grooves=GROOVES if film is COARSE else ())


@cache
def integrated(film, times):
    """Return the temperature at these times by an integrator of scipy, and the outputs, (n, n_outputs)."""
    running, u = bearing(film).in_time(), np.array(list(START.values()))
    temperature = solve_ivp(
        lambda t, x: running.derivative(t, x, u),
        (0.0, times[-1]),
        running.initial_state,
        method="DOP853",
        rtol=1e-12,
        atol=1e-9,
        t_eval=times,
    ).y[0]
    return temperature, np.array([running.output(t, [T], u) for t, T in zip(times, temperature, strict=True)])


films = pytest.mark.parametrize("film", [MapFilm(), ShortFilm(), COARSE], ids=["map", "short", "grooves"])


@pytest.mark.parametrize("version", ["2.0", "3.0"])
@films
def test_the_temperature_is_that_of_the_model(film, version, tmp_path):
    path = export_fmu(
        bearing(film), tmp_path / "warm.fmu", version, start=START, stop_time=0.5, step_size=0.5
    )
    assert not fmpy.read_model_description(path).modelVariables[0].name.startswith("python")
    told = fmpy.simulate_fmu(
        str(path), stop_time=20.0, step_size=0.5, output_interval=0.5, fmi_type="CoSimulation"
    )
    temperature, outputs = integrated(film, tuple(told["time"].tolist()))
    names = {name.rpartition(".")[2]: name for name in told.dtype.names}
    assert np.abs(told[names["film_temperature"]] / temperature - 1.0).max() < 1e-9
    for signal, expected in zip(bearing(film).in_time().outputs, outputs.T, strict=True):
        assert told[names[signal.name]] == pytest.approx(expected, rel=1e-8)


@pytest.mark.long
@films
def test_temperatures_are_those_of_simulate(film, tmp_path):
    """A rotor of so much mass that it stays where it is: the same inputs, by an integrator of its own."""
    position = (START["x"], START["y"])
    with pytest.warns(ValidityWarning, match="mass should be"):
        rotor = RigidRotor(mass=1e25, speed=START["speed"], gravity=(0.0, 0.0), position=position)
    model = bearing(film).in_time()
    motion = simulate(rotor, model, duration=4.0, samples=9, rtol=1e-12, method=DOP853)
    start = {"x": position[0], "y": position[1], "speed": START["speed"]}
    path = export_fmu(model, tmp_path / "warm.fmu", component="film", start=start)
    told = fmpy.simulate_fmu(
        str(path),
        stop_time=4.0,
        step_size=0.5,
        output_interval=0.5,
        fmi_type="CoSimulation",
        output=["film.film_temperature", "film.power_loss"],
    )
    warm = motion["film_temperature"]
    assert warm[-1] > warm[0] + 3.0
    np.testing.assert_allclose(told["film.film_temperature"], warm, rtol=1e-10)
    np.testing.assert_allclose(told["film.power_loss"], motion["power_loss"], rtol=1e-9)


@pytest.mark.long
@films
def test_a_c_host_gets_the_temperature_over_an_orbit(film, tmp_path):
    """Inputs that change from step to step, each step against a tight integration of the model in Python."""
    compiler = shutil.which("cc") or pytest.skip("no C compiler")
    host, dt = tmp_path / "host", 0.05
    subprocess.run(
        [compiler, "-std=c99", f"-I{FOLDER}", str(HOST), "-o", str(host), "-lm", "-ldl"], check=True
    )
    angle = np.linspace(0.0, 6.0, 25)
    x, y = 2e-5 + 3e-5 * np.cos(angle), -2e-5 + 3e-5 * np.sin(angle)
    rows = np.column_stack([x, y, -1e-3 * np.sin(angle), 1e-3 * np.cos(angle), 157.0 + 5.0 * angle])
    model = bearing(film).in_time()
    start = dict(zip(START, rows[0].tolist(), strict=True))
    path = export_fmu(model, tmp_path / "film.fmu", component="film", start=start)
    description = fmpy.read_model_description(str(path))
    unpacked = Path(fmpy.extract(str(path), unzipdir=str(tmp_path / "files")))
    rows.tofile(tmp_path / "rows.bin")
    places = {v.name: str(v.valueReference) for v in description.modelVariables}
    of = [",".join(places[f"film.{s.name}"] for s in signals) for signals in (model.inputs, model.outputs)]
    library = next((unpacked / "binaries").rglob("film.*"))
    resources = (unpacked / "resources").as_uri()
    command = [host, library, resources, description.guid, *of, repr(dt), tmp_path / "rows.bin", "2"]
    ran = subprocess.run([str(part) for part in command], capture_output=True, text=True, check=True)
    told = np.array(ran.stdout.split()[1:], dtype=float)
    state = model.initial_state
    for u in rows:
        rate = lambda t, z, held=u: model.derivative(t, z, held)  # noqa: E731
        state = solve_ivp(rate, (0.0, dt), state, method="DOP853", rtol=1e-12, atol=1e-10).y[:, -1]
    assert abs(state[0] - model.initial_state[0]) > 1.0
    expected = model.output(0.0, state, rows[-1])
    np.testing.assert_allclose(told, expected, rtol=1e-10)


@pytest.mark.long
@pytest.mark.parametrize("version", ["2.0", "3.0"])
def test_a_bearing_with_openings_is_native_and_passes_all_checks(version, tmp_path):
    path = export_fmu(bearing(COARSE), tmp_path / "warm.fmu", version, component="film", start=START)
    assert [item.check for item in check_fmu(path) if item.passed is False] == []
    described = {v.name: v for v in fmpy.read_model_description(str(path)).modelVariables}
    assert float(described["film.carry_over"].start) == COOLING.carry_over
    assert described["film.carry_over"].variability == "tunable"
    assert bearing(COARSE).in_time().native().kernel == "heated_grooved_journal"


@pytest.mark.long
@pytest.mark.parametrize(
    ("name", "value", "rule"),
    [("carry_over", 1.5, "carry_over must be from 0 to 1"), ("length", 0.04, "length/diameter must be that")],
)
def test_what_the_map_does_not_hold_for_is_refused(name, value, rule, tmp_path, capsys):
    path = export_fmu(bearing(COARSE), tmp_path / "warm.fmu", component="film", start=START)
    with pytest.raises(Exception, match="failed"):
        fmpy.simulate_fmu(str(path), start_values={f"film.{name}": value}, stop_time=0.1)
    assert rule in capsys.readouterr().out


@pytest.mark.long
def test_a_turbulent_film_warms_in_an_fmu_through_pythonfmu(tmp_path):
    """A density of 1e5 kg/m3 makes this small bearing turbulent."""
    film = bearing(ReynoldsFilm(cells=(16, 4)))
    running = replace(film, turbulence=Turbulence(density=1e5)).in_time()
    assert running.native() is None
    path = export_fmu(running, tmp_path / "warm.fmu", "2.0", start=START, stop_time=0.2, step_size=0.1)
    told = fmpy.simulate_fmu(str(path), stop_time=0.2, step_size=0.1, output_interval=0.1)

    def last(warming):
        u = np.array(list(START.values()))
        return solve_ivp(
            lambda t, x: warming.derivative(t, x, u), (0.0, 0.2), warming.initial_state, rtol=1e-10
        ).y[0, -1]

    name = next(name for name in told.dtype.names if name.rpartition(".")[2] == "film_temperature")
    assert told[name][-1] == pytest.approx(last(running), rel=1e-7)
    assert last(running) > last(film.in_time()) + 0.5


@pytest.mark.long
def test_a_turbulent_film_of_layers_has_its_forces_in_an_fmu_through_pythonfmu(tmp_path):
    """T3 with the temperature of its equilibrium held: the forces of Python, beside it and in motion."""
    size = {"radius": 0.25, "length": 0.4, "clearance": 5e-4, "oil": Oil.iso_vg(32), "cooling": COOLING}
    heated = HeatedFilm(
        bearing=JournalBearing(**size, turbulence=Turbulence(band=False)),
        cells=(24, 4),
        profile=LayeredTemperature(4),
    )
    film = heated.following(heated_equilibrium(heated, [0.0, -3e5], 314.16).state)
    laminar = replace(film, bearing=replace(film.bearing, turbulence=None))
    place, velocity = np.array([1.5e-4, -2e-4]), np.array([1e-3, -2e-3])
    inputs = dict(zip(("x", "y", "vx", "vy", "speed"), [*place, *velocity, 300.0], strict=True))
    path = export_fmu(film, tmp_path / "layers.fmu", "2.0", component="film", start=inputs)
    told = fmpy.simulate_fmu(str(path), stop_time=0.01, step_size=0.01, output_interval=0.01)
    force = film.force(place, velocity, 300.0)
    assert [told["film.force_x"][-1], told["film.force_y"][-1]] == force.tolist()
    assert np.hypot(*force) > 1.2 * np.hypot(*laminar.force(place, velocity, 300.0))
