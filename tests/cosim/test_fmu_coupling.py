"""The master on real FMUs, run by fmpy."""

import gc
import tempfile
import zipfile
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from numpy.testing import assert_allclose

from rotorfilm import ContactError, CouplingError, FilmContactError, FmuError, InputError, JournalBearing
from rotorfilm.analysis import equilibrium, simulate
from rotorfilm.bearings.journal import MapFilm, ShortFilm
from rotorfilm.cosim import InProcessSlave, cosimulate, couple, critical_macro_step, open_fmu
from rotorfilm.fmu import export_fmu
from rotorfilm.rotors import RigidRotor, SpeedProfile

pytestmark = pytest.mark.filterwarnings("ignore::rotorfilm.core.errors.CouplingWarning")

BEARING = JournalBearing(radius=0.05, length=0.03, clearance=1e-4, viscosity=0.1, film=MapFilm())
ROTOR = RigidRotor(
    mass=525.0 / 9.80665,
    speed=SpeedProfile(times=(0.0, 0.015), speeds=(120.0, 157.0)),
    unbalance=1e-3,
    position=(2e-5, -4e-5),
)
THROWN = replace(ROTOR, velocity=(0.0, -0.3))
TURN = 2.0 * np.pi / 157.0


@pytest.fixture(
    scope="module", params=[("native", "2.0"), ("native", "3.0"), ("python", "2.0")], ids="-".join
)
def fmus(request, tmp_path_factory):
    backend, version = request.param
    folder = tmp_path_factory.mktemp("fmus")
    models = {"film": BEARING, "rotor": ROTOR, "thrown": THROWN}
    return {
        name: export_fmu(model, folder / f"{name}.fmu", version, backend, component=name)
        for name, model in models.items()
    }


@pytest.fixture(autouse=True)
def scratch(tmp_path, monkeypatch):
    """Give the master a folder of its own for temporary files, which must be empty afterwards."""
    monkeypatch.setattr(tempfile, "tempdir", str(tmp_path))
    yield
    if list(tmp_path.iterdir()):  # of what is not freed yet
        gc.collect()
    assert list(tmp_path.iterdir()) == []


def test_coupled_fmus_give_what_the_models_give_in_this_process(fmus):
    arguments = {"macro_step": TURN / 400, "duration": TURN}
    coupled = cosimulate(fmus["rotor"], fmus["film"], **arguments)
    direct = couple(InProcessSlave(ROTOR), InProcessSlave(BEARING), **arguments)
    assert_allclose(coupled.trajectory.time, direct.trajectory.time, rtol=1e-15)
    assert list(coupled.trajectory.signals) == list(direct.trajectory.signals)
    for name, series in direct.trajectory.signals.items():
        assert_allclose(coupled.trajectory[name], series, atol=1e-9 * np.abs(series).max(), err_msg=name)
    assert coupled.coupling.chatter == direct.coupling.chatter
    assert_allclose(coupled.coupling.amplitude, direct.coupling.amplitude, rtol=1e-6, atol=1e-9)
    for name in ("steps", "film_evaluations", "rotor_steps"):
        assert coupled.trajectory.work[name] == direct.trajectory.work[name]


@pytest.mark.convergence
def test_error_of_coupled_fmus_halves_with_the_macro_step(fmus):
    errors = []
    duration = TURN / 2.0
    exact = simulate(ROTOR, BEARING, duration=duration, times=np.linspace(0.0, duration, 201))
    for count in (200, 400, 800):
        step = duration / count
        run = cosimulate(fmus["rotor"], str(fmus["film"]), macro_step=step, duration=duration).trajectory
        errors.append(np.abs(run.position[:, :: count // 200] - exact.position).max() / BEARING.clearance)
    assert_allclose(np.log2(np.divide(errors[:-1], errors[1:])), 1.0, atol=0.1)


def test_fmus_past_the_stability_limit_are_reported(tmp_path_factory):
    """On the short film at eps .9 and w = 1: silent chatter from 10.1 degrees of rotation on."""
    bearing = replace(BEARING, film=ShortFilm())
    speed, position = 157.0, (0.9e-4, 0.0)
    load = -bearing.force(position, (0.0, 0.0), speed)
    rotor = RigidRotor(
        mass=np.hypot(*load) / (speed**2 * 1e-4),
        speed=speed,
        gravity=(0.0, 0.0),
        static_force=tuple(load),
        position=(0.895e-4, 0.0),
    )
    at_rest = equilibrium(bearing, load, speed)
    limit = critical_macro_step(rotor, bearing, state=[*at_rest.position, 0.0, 0.0]).macro_step
    assert_allclose(np.degrees(limit * speed), 10.1, rtol=0.02)
    folder = tmp_path_factory.mktemp("chatter")
    pair = (export_fmu(rotor, folder / "rotor.fmu"), export_fmu(bearing, folder / "film.fmu"))
    below = cosimulate(*pair, macro_step=0.9 * limit, duration=90.0 * limit)
    assert not below.coupling.chatter
    assert_allclose(below.trajectory.position[:, -1], at_rest.position, atol=2e-3 * bearing.clearance)
    for factor in (1.2, 1.5):
        with pytest.raises(CouplingError, match="macro_step must be below the stability limit") as caught:
            cosimulate(*pair, macro_step=factor * limit, duration=100.0 * factor * limit)
        assert 16 <= caught.value.partial.trajectory.time.size <= 101


def test_a_journal_at_the_wall_ends_the_run_and_leaves_the_process_sound(fmus):
    for _ in range(3):
        with pytest.raises(
            ContactError, match=r"journal reached the wall after t = .*inside the clearance"
        ) as caught:
            cosimulate(fmus["thrown"], fmus["film"], macro_step=TURN / 100, duration=TURN)
        partial = caught.value.partial.trajectory
        assert_allclose(partial["vy"][0], -0.3)
        assert partial.time.size < 101
    run = cosimulate(fmus["rotor"], fmus["film"], macro_step=TURN / 400, duration=TURN / 40)
    assert run.trajectory.time.size == 11


def test_a_film_fmu_beyond_the_wall_answers_with_contact(fmus):
    with open_fmu(fmus["film"]) as film:
        film.start({"x": 1e-5, "y": 0.0, "vx": 0.0, "vy": 0.0, "speed": 100.0})
        film.set({"x": 2e-4})
        with pytest.raises(FilmContactError, match=r"FMU .* failed in the step .*inside the clearance"):
            film.step(0.0, 1e-4)


@pytest.mark.parametrize(
    ("arguments", "match"),
    [
        ({"macro_step": 0.0, "duration": 1.0}, "macro_step must be finite and positive, got 0.0"),
        ({"macro_step": 1.0, "duration": -1.0}, "duration must be finite and positive, got -1.0"),
    ],
)
def test_times_are_checked_before_a_file_is_opened(arguments, match):
    with pytest.raises(InputError, match=match):
        cosimulate("absent.fmu", "absent.fmu", **arguments)


def test_signals_lose_their_component_and_start_values_count(fmus):
    with open_fmu(fmus["film"]) as film:
        assert film.inputs == ("x", "y", "vx", "vy", "speed")
        assert film.outputs == ("force_x", "force_y")
        state = {"x": 1e-5, "y": -2e-5, "vx": 1e-3, "vy": 0.0, "speed": 100.0}
        film.start(state)
        expected = BEARING.force((1e-5, -2e-5), (1e-3, 0.0), 100.0)
        assert_allclose(list(film.get().values()), expected, rtol=1e-12)


@pytest.mark.parametrize("version", ["2.0", "3.0"])
def test_a_native_film_knows_its_derivatives(version, tmp_path_factory):
    state = [3e-5, -2e-5, 1e-3, 0.0, 100.0]
    path = export_fmu(BEARING, tmp_path_factory.mktemp("known") / "film.fmu", version, "native")
    with open_fmu(path) as film:
        film.start(dict(zip(film.inputs, state, strict=True)))
        found = film.jacobian(film.outputs, film.inputs)
    assert_allclose(found, BEARING.jacobian(state[:2], state[2:4], state[4]), rtol=1e-12)


def test_fmus_that_do_not_fit_are_named(fmus):
    with pytest.raises(InputError, match=r"rotor must have the inputs \['force_x', 'force_y'\], got \['x'"):
        cosimulate(fmus["film"], fmus["rotor"], macro_step=1e-4, duration=1e-3)


def test_a_file_that_is_no_fmu_is_named(fmus, tmp_path_factory):
    folder = tmp_path_factory.mktemp("bad")
    text = folder / "text.fmu"
    text.write_text("not a zip file")
    with pytest.raises(FmuError, match=r"fmu must be a readable FMU, got .*text.fmu"):
        cosimulate(text, fmus["film"], macro_step=1e-4, duration=1e-3)
    with pytest.raises(FmuError, match=r"fmu must be a readable FMU, got .*absent.fmu"):
        cosimulate(fmus["rotor"], folder / "absent.fmu", macro_step=1e-4, duration=1e-3)


def rewritten(source: Path, target: Path, old: str, new: str) -> Path:
    """Copy an FMU with another model description, or without its binaries where `old` is empty."""
    with zipfile.ZipFile(source) as before, zipfile.ZipFile(target, "w") as after:
        for item in before.namelist():
            content = before.read(item)
            if item == "modelDescription.xml":
                content = content.decode().replace(old, new).encode()
            if old or not item.startswith("binaries/"):
                after.writestr(item, content)
    return target


def test_an_fmu_that_cannot_run_here_is_named(fmus, tmp_path_factory):
    folder = tmp_path_factory.mktemp("strange")
    exchange = rewritten(fmus["film"], folder / "me.fmu", "CoSimulation", "ModelExchange")
    with pytest.raises(FmuError, match=r"fmu must have the interface Co-Simulation, got 'film' without"):
        cosimulate(fmus["rotor"], exchange, macro_step=1e-4, duration=1e-3)
    bare = rewritten(fmus["film"], folder / "bare.fmu", "", "")
    with pytest.raises(FmuError, match=r"FMU .film. cannot be instantiated: Cannot find shared library"):
        cosimulate(fmus["rotor"], bare, macro_step=1e-4, duration=1e-3)
    twice = rewritten(fmus["film"], folder / "twice.fmu", '"film.vx"', '"other.x"')
    with pytest.raises(InputError, match="input names must differ without their component, got 'x' twice"):
        cosimulate(fmus["rotor"], twice, macro_step=1e-4, duration=1e-3)
