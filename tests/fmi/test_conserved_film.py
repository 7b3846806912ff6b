"""Films that conserve their oil as native FMUs: steps of the model, oil saved, restored and resumed."""

import signal
import subprocess
import sys

import fmpy
import numpy as np
import pytest
from fmpy.fmi1 import FMICallException
from fmpy.validation import validate_fmu

from rotorfilm import (
    DamperSupply,
    FeedHole,
    FilmContactError,
    FmuError,
    Groove,
    JFODamper,
    JFOFilm,
    JournalBearing,
    PressureDamBearing,
    export_fmu,
    pressure_dam_pads,
)
from rotorfilm.bearings import Turbulence
from rotorfilm.cosim import open_fmu
from rotorfilm.fmu import check_fmu

OMEGA, STEP = 314.0, 1e-4
TOP = Groove(center=np.pi / 2, width=np.radians(20.0), length=0.04)
SIZE = dict(radius=0.05, length=0.05, clearance=1e-4, viscosity=0.02)
PADS = dict(radius=0.05, length=0.05, pad_clearance=1e-4, viscosity=1e-3)
FILM = JFOFilm(bearing=JournalBearing(**SIZE, grooves=(TOP,), supply_pressure=2e5), cells=(24, 4))
FILMS = {
    "pressed": FILM,
    "starved": JFOFilm(bearing=JournalBearing(**SIZE, grooves=(TOP,)), cells=(24, 4), supply_flow=1.5e-5),
    "bathed": JFOFilm(
        bearing=JournalBearing(**SIZE), cells=(24, 4), cavitation_pressure=-1e5, submerged=True
    ),
    "all round": JFOFilm(
        bearing=JournalBearing(**SIZE, circumferential_groove=2e-3, supply_pressure=1e5), cells=(24, 4)
    ),
    "turbulent dam": JFOFilm(
        bearing=PressureDamBearing(
            **PADS,
            turbulence=Turbulence(),
            pads=pressure_dam_pads(depth=1e-4, end=2.4, share=0.75, preload=0.2),
        ),
        cells=(24, 4),
    ),
    "damper": JFODamper(
        **SIZE,
        cells=(24, 4),
        stiffness=1e6,
        supply=DamperSupply(supply_pressure=1e5, feed_holes=(FeedHole(center=0.5, diameter=5e-3),)),
    ),
}
VERSIONS = ["2.0", "3.0"]


def motion(k):
    """Return the motion of the journal after k steps."""
    phase = 0.5 * OMEGA * k * STEP
    place, rate = 2e-5 * np.array([1.0 - np.cos(phase), np.sin(phase)]), 2e-5 * 0.5 * OMEGA
    x, y = np.array([3e-5, -4e-5]) + place
    return dict(x=x, y=y, vx=rate * np.sin(phase), vy=rate * np.cos(phase), speed=OMEGA)


def values(answer):
    return np.array([answer[signal.name] for signal in FILM.outputs])


def followed(model, steps):
    """Return the outputs of a model after each step."""
    state, outputs = model.start(list(motion(0).values())), []
    for k in range(1, steps + 1):
        state, output, _ = model.step(state, (k - 1) * STEP, list(motion(k).values()), STEP)
        outputs.append(output)
    return np.array(outputs)


def exported(model, folder, version="2.0"):
    path = folder / f"film_{version}.fmu"
    return export_fmu(model, path, version, component="film", start=motion(0), stop_time=5e-3)


@pytest.fixture(scope="module", params=VERSIONS)
def film(request, tmp_path_factory):
    return exported(FILM, tmp_path_factory.mktemp("jfo"), request.param)


def test_the_file_is_valid_and_passes_the_checks(film):
    assert validate_fmu(str(film)) == []
    items = {item.check: item for item in check_fmu(film)}
    assert [name for name, item in items.items() if item.passed is False] == []
    assert items["FMU state"].passed
    assert items["reference, Co-Simulation"].passed
    description = fmpy.read_model_description(str(film))
    assert description.coSimulation.canGetAndSetFMUstate
    assert description.coSimulation.canSerializeFMUstate
    assert not description.coSimulation.providesDirectionalDerivative
    assert description.modelExchange is None
    tunable = [v.name for v in description.modelVariables if v.variability == "tunable"]
    assert tunable == ["film.viscosity", "film.supply_pressure"]
    assert [len(unknown.dependencies) for unknown in description.outputs] == [0] * 9


@pytest.mark.parametrize(("version", "name"), [("2.0", name) for name in FILMS] + [("3.0", "damper")])
def test_steps_are_those_of_the_model(version, name, tmp_path):
    model, steps = FILMS[name], 8
    start = model.answer(model.start(list(motion(0).values())))
    with open_fmu(exported(model, tmp_path, version)) as fmu:
        fmu.start(motion(0))
        np.testing.assert_allclose(values(fmu.get()), start, rtol=1e-14)
        found = [stepped(fmu, k) for k in range(1, steps + 1)]
    expected = followed(model, steps)
    assert np.ptp(expected[:, 0]) > 0.05 * np.abs(expected[:, 0]).max()
    np.testing.assert_allclose(found, expected, rtol=1e-9, atol=1e-15)


def test_steps_go_on_elsewhere_from_saved_bytes(film):
    expected = followed(FILM, 8)
    with open_fmu(film) as fmu, open_fmu(film) as other:
        fmu.start(motion(0))
        other.start(motion(3))
        found = [stepped(fmu, k) for k in range(1, 5)]
        saved = fmu._instance.save()
        content = fmu._instance.serialize(saved)
        found += [stepped(fmu, k) for k in range(5, 9)]
        np.testing.assert_allclose(found, expected, rtol=1e-9)
        fmu._instance.restore(saved)
        again = [stepped(fmu, k) for k in range(5, 9)]
        fmu._instance.release(saved)
        other._instance.restore(other._instance.deserialize(content))
        resumed = [stepped(other, k) for k in range(5, 9)]
        for wrong in (content[:-3], content[:200] + bytes([content[200] ^ 1]) + content[201:]):
            with pytest.raises(FMICallException):
                other._instance.deserialize(wrong)
    np.testing.assert_array_equal(again, found[4:])
    np.testing.assert_array_equal(resumed, found[4:])


def test_a_reset_begins_anew(film):
    with open_fmu(film) as fmu:
        runs = []
        for _ in range(2):
            fmu.start(motion(0))
            runs.append([values(fmu.get()), *(stepped(fmu, k) for k in range(1, 4))])
            fmu._instance.reset()
    np.testing.assert_array_equal(*runs)


def stepped(fmu, k):
    """Return the outputs of an FMU after its k-th step."""
    fmu.set(motion(k))
    fmu.step((k - 1) * STEP, STEP)
    return values(fmu.get())


RUN = """
import os, signal, sys
import numpy as np
from rotorfilm.bearings import Turbulence
from rotorfilm.cosim import open_fmu
sys.path.insert(0, sys.argv[1])
from {module} import motion, stepped
film, file, begin, end = sys.argv[2], sys.argv[3], int(sys.argv[4]), int(sys.argv[5])
with open_fmu(film) as fmu:
    fmu.start(motion(0))
    if begin:
        fmu._instance.restore(fmu._instance.deserialize(open(file, "rb").read()))
    rows = [stepped(fmu, k) for k in range(begin + 1, end + 1)]
    if begin:
        print(np.array(rows).tobytes().hex(), flush=True)
    else:
        with open(file, "wb") as saved:
            saved.write(fmu._instance.serialize(fmu._instance.save()))
    os.kill(os.getpid(), signal.SIGKILL)
"""


@pytest.mark.long
@pytest.mark.skipif(sys.platform == "win32", reason="no SIGKILL")
def test_a_run_goes_on_after_its_process_was_killed(film, tmp_path):
    with open_fmu(film) as fmu:
        fmu.start(motion(0))
        whole = [stepped(fmu, k) for k in range(1, 9)]
    # Killed in the middle, its oil in a file; another process takes it from there.
    folder, module = __file__.rpartition("/")[0], __name__.rpartition(".")[2]
    code, file = RUN.format(module=module), tmp_path / "oil.bin"
    for begin, end in ((0, 4), (4, 8)):
        command = [sys.executable, "-c", code, folder, str(film), str(file), str(begin), str(end)]
        ran = subprocess.run(command, capture_output=True, text=True, check=False)
        assert ran.returncode == -signal.SIGKILL, ran.stderr
    resumed = np.frombuffer(bytes.fromhex(ran.stdout.strip())).reshape(4, -1)
    np.testing.assert_array_equal(resumed, whole[4:])


def test_a_step_to_the_wall_is_discarded_and_says_why(film):
    with open_fmu(film) as fmu:
        fmu.start(motion(0))
        stepped(fmu, 1)
        before, saved = values(fmu.get()), fmu._instance.save()
        fmu.set({"x": 1.5e-4})
        with pytest.raises(
            FilmContactError, match=r"last good time t = 0\.0001 s: the journal must stay inside"
        ):
            fmu.step(STEP, STEP)
        np.testing.assert_array_equal(values(fmu.get()), before)
        fmu._instance.restore(saved)
        np.testing.assert_allclose(stepped(fmu, 2), followed(FILM, 2)[1], rtol=1e-9)
        fmu._instance.release(saved)


def test_a_start_at_the_wall_is_an_error(film):
    with open_fmu(film) as fmu, pytest.raises(FilmContactError, match=r"inside the clearance 0\.0001 m, got"):
        fmu.start({**motion(0), "x": 1.5e-4})


@pytest.mark.closed_form
@pytest.mark.parametrize("version", VERSIONS)
def test_mean_flows_balance_the_oil_of_long_communication_steps(version, tmp_path):
    with open_fmu(exported(FILM, tmp_path, version)) as fmu:
        fmu.start(motion(0))
        before, t, missed = values(fmu.get()), 0.0, []
        for k in (40, 41, 95, 98):  # of up to 55 inner steps
            dt = k * STEP - t
            fmu.set(motion(k))
            fmu.step(t, dt)
            after, t = values(fmu.get()), t + dt
            stored = after[5] - before[5]
            for (out, drawn, fed), kept in ((after[6:], 1e-13 * after[5]), (after[2:5], None)):
                missing = dt * (fed + drawn - out) - stored
                missed += [abs(missing) / abs(stored)] if kept is None else []
                assert kept is None or abs(missing) < kept
            before = after
    assert max(missed) > 0.05  # by the flows at the end of a step


@pytest.mark.closed_form
def test_the_supply_may_fail_between_steps(tmp_path):
    # What a pump gives is what the opening lets in; without it oil only leaves.
    path = exported(FILMS["starved"], tmp_path)
    variables = fmpy.read_model_description(str(path)).modelVariables
    flow = next(v.valueReference for v in variables if v.name == "film.supply_flow")
    with open_fmu(path) as fmu:
        fmu.start(motion(0))
        assert fmu.get()["inflow"] == pytest.approx(1.5e-5, rel=1e-9)
        fmu._instance.set([flow], [0.0])
        volumes = [stepped(fmu, k)[[4, 5]] for k in range(1, 6)]
    inflow, oil = np.array(volumes).T
    np.testing.assert_allclose(inflow, 0.0, atol=1e-15)
    assert np.all(np.diff(oil) < 0.0)


def test_export_names_what_cannot_be(tmp_path):
    with pytest.raises(FmuError, match="fixed_size"):
        export_fmu(FILM, tmp_path / "a.fmu", fixed_size=True, start=motion(0))
    path = export_fmu(FILM, tmp_path / "a.fmu", backend="python", start=motion(0), component="film")
    with open_fmu(path) as fmu:
        fmu.start(motion(0))
        np.testing.assert_array_equal(stepped(fmu, 1), followed(FILM, 1)[0])
