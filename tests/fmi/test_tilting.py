"""Native FMUs of tilting-pad bearings: Python's forces, tilts against tight integration, a C host."""

import shutil
import subprocess
from dataclasses import replace
from pathlib import Path

import fmpy
import numpy as np
import pytest
from fmpy.fmi1 import FMICallException
from scipy.integrate import solve_ivp

from rotorfilm import InputError, TiltingPadBearing, equilibrium, even_pivots, export_fmu
from rotorfilm.bearings import PadMapFilm, PadResolution
from rotorfilm.fmu import check_fmu
from rotorfilm.native import FOLDER

from .journals import crosswise

HOST = Path(__file__).parents[2] / "benchmarks" / "step_host.c"
FILM = PadMapFilm(resolution=PadResolution(cells=(32, 4), nodes=(8, 9, 24)))
LIGHT = TiltingPadBearing(
    radius=0.05,
    length=0.05,
    viscosity=0.02,
    pivots=even_pivots(5),
    extent=np.pi / 3.0,
    preload=0.3,
    pad_clearance=1e-4,
    film=FILM,
)
HEAVY = replace(LIGHT, pad_inertia=2e-4, pivot_distance=0.01)
SPRUNG = replace(LIGHT, pivot_stiffness=2e8)
BOTH = replace(HEAVY, pivot_stiffness=2e8, pad_mass=0.1)
INPUTS, SPEED = ("x", "y", "vx", "vy", "speed"), 300.0
PLACE = np.array([3e-6, -1.5e-5, 1e-4, -2e-4, SPEED])
kinds = pytest.mark.parametrize(
    ("model", "version"),
    [(LIGHT, "2.0"), (LIGHT, "3.0"), (SPRUNG, "3.0"), (HEAVY, "2.0"), (BOTH, "3.0")],
    ids=["light 2.0", "light 3.0", "sprung", "heavy", "sprung and heavy"],
)


def started(model):
    """Return the bearing with the pads a little off their rest, so that they have somewhere to go."""
    at = model.at_rest().state(PLACE[:2], SPEED)[: model.coordinates]
    if model.pivot_stiffness is not None:
        at = at - np.repeat([0.0, 2e-7], len(model.pivots))
    return replace(model, start=tuple((at + 5e-7).tolist()))


def integrated(model, u, duration, x=None):
    """Return the state after a duration under held inputs, by an integrator of scipy."""
    x = model.initial_state if x is None else x
    jac = {} if model.pad_inertia is None else {"jac": lambda t, now: model.linearization(t, now, u).A}
    ran = solve_ivp(
        lambda t, now: model.derivative(t, now, u),
        (0.0, duration),
        x,
        method="DOP853" if model.pad_inertia is None else "Radau",
        rtol=1e-11,
        atol=1e-18,
        **jac,
    )
    return ran.y[:, -1]


@kinds
def test_outputs_rates_and_derivatives_are_those_of_python(model, version, opened):
    model = started(model)
    instance, reference = opened(model, version, True)
    inputs = [reference[name] for name in INPUTS]
    outputs = [reference[one.name] for one in model.outputs]
    instance.initialize(inputs, PLACE.tolist())
    expected = model.output(0.0, model.initial_state, PLACE)
    np.testing.assert_array_equal(instance.get(outputs), expected)
    by = model.linearization(0.0, model.initial_state, PLACE)
    columns = np.array([instance.directional(outputs, [one], [1.0]) for one in inputs]).T
    np.testing.assert_allclose(columns, by.D, rtol=1e-12, atol=1e-12 * np.abs(by.D).max())
    columns = np.array(
        [instance.directional(outputs, [reference[f"state_{one.name}"]], [1.0]) for one in model.states]
    ).T
    np.testing.assert_allclose(columns, by.C, rtol=1e-12, atol=1e-12 * np.abs(by.C).max())


@pytest.mark.parametrize(("name", "version"), crosswise(["light", "sprung"]))
def test_tilting_pads_are_native_by_default_and_pass_all_checks(name, version, tmp_path):
    model = {"light": LIGHT, "sprung": SPRUNG}[name]
    start = dict(zip(INPUTS, PLACE.tolist(), strict=True))
    path = export_fmu(started(model), tmp_path / "t.fmu", version, start=start)
    assert [item.check for item in check_fmu(path) if item.passed is False] == []


@pytest.mark.parametrize(
    ("model", "version"),
    [
        (LIGHT, "3.0"),
        (SPRUNG, "3.0"),
        pytest.param(HEAVY, "2.0", marks=pytest.mark.long),
        pytest.param(BOTH, "3.0", marks=pytest.mark.long),
    ],
)
def test_tilts_are_those_of_a_tight_integration(model, version, tmp_path):
    model, end = started(model), 2e-3
    start = dict(zip(INPUTS, PLACE.tolist(), strict=True))
    path = export_fmu(model, tmp_path / "t.fmu", version, component="film", start=start, stop_time=1e-4)
    names = [f"film.state_{one.name}" for one in model.states]
    ran = fmpy.simulate_fmu(
        str(path),
        fmi_type="CoSimulation",
        stop_time=end,
        step_size=1e-4,
        output=names,
        relative_tolerance=1e-12,
    )
    found = np.array([ran[name][-1] for name in names])
    expected = integrated(model, PLACE, end)
    n = model.coordinates
    assert found[:n] == pytest.approx(expected[:n], abs=1e-9 * 1e-4)


@pytest.mark.parametrize("own", [False, True], ids=["no start", "own start"])
def test_pads_without_a_start_rest_under_the_journal_at_its_start(own, tmp_path):
    load = np.array([0.0, -900.0])
    place = equilibrium(LIGHT, load, SPEED).position
    start = {"x": place[0], "y": place[1], "speed": f"{SPEED} rad/s"}
    model = started(LIGHT) if own else LIGHT
    path = export_fmu(model, tmp_path / "t.fmu", component="film", start=start)
    names = ["film.force_x", "film.force_y", *(f"film.state_{one.name}" for one in model.states)]
    ran = fmpy.simulate_fmu(str(path), fmi_type="CoSimulation", stop_time=1e-3, step_size=1e-3, output=names)
    found = np.array([ran[name] for name in names])
    if own:
        assert found[2:, 0] == pytest.approx(model.initial_state, rel=1e-12)
    else:
        np.testing.assert_allclose(found[:2].T + load, 0.0, atol=1e-6 * 900.0)


def test_pads_that_cannot_rest_under_the_start_are_named(tmp_path):
    with pytest.raises(InputError, match=r"start must be .* at which the pads rest, .*; got \[0.0, -0.0002"):
        export_fmu(LIGHT, tmp_path / "t.fmu", start={"y": -2e-4, "speed": SPEED})


def test_a_c_host_moves_the_pads_over_an_orbit(tmp_path):
    """Five pads, inputs that change from step to step, each step against a tight integration in Python."""
    compiler = shutil.which("cc") or pytest.skip("no C compiler")
    host, dt, model = tmp_path / "host", 5e-4, started(LIGHT)
    subprocess.run(
        [compiler, "-std=c99", f"-I{FOLDER}", str(HOST), "-o", str(host), "-lm", "-ldl"], check=True
    )
    angle = SPEED * dt * np.arange(25)
    rows = np.stack(
        [
            3e-6 + 5e-6 * np.cos(angle),
            -1.5e-5 + 5e-6 * np.sin(angle),
            -1.5e-3 * np.sin(angle),
            1.5e-3 * np.cos(angle),
            np.full(angle.size, SPEED),
        ],
        axis=1,
    )
    path = export_fmu(
        model, tmp_path / "t.fmu", start=dict(zip(INPUTS, rows[0].tolist(), strict=True)), component="film"
    )
    unzipped = fmpy.extract(str(path))
    description = fmpy.read_model_description(str(path))
    reference = {v.name: v.valueReference for v in description.modelVariables}
    library = next((Path(unzipped) / "binaries" / fmpy.platform).glob("*.so"))
    (tmp_path / "rows").write_bytes(rows.tobytes())
    outputs = [f"film.state_{one.name}" for one in model.states]
    outputs += ["film.force_x", "film.force_y"]
    told = subprocess.run(
        [
            str(host),
            str(library),
            (Path(unzipped) / "resources").as_uri(),
            description.guid,
            ",".join(str(reference[f"film.{name}"]) for name in INPUTS),
            ",".join(str(reference[name]) for name in outputs),
            repr(dt),
            str(tmp_path / "rows"),
            "1",
        ],
        capture_output=True,
        text=True,
        check=True,
    ).stdout.split()
    found = np.array([float(one) for one in told[-len(outputs) :]])
    x = model.initial_state
    for row in rows:
        x = integrated(model, row, dt, x)
    assert found[:5] == pytest.approx(x, abs=1e-9 * 1e-4)
    force = model.output(0.0, x, rows[-1])[:2]
    assert found[5:] == pytest.approx(force, abs=1e-8 * np.abs(force).max())


def test_contact_names_the_pad(opened):
    instance, reference = opened(started(LIGHT), "2.0", False)
    instance.initialize([reference[one] for one in INPUTS], PLACE.tolist())
    instance.set([reference["y"]], [-1.2e-4])
    with pytest.raises(FMICallException):
        instance.get([reference["force_x"]])
    assert any("must leave a film on every pad, and touches pad 1" in line for line in instance.log)
