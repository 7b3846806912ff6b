"""Native FMUs of ball bearings in five degrees: forces, moments and derivatives of Python, in fmpy and C."""

import math
import shutil
import subprocess
from dataclasses import replace
from pathlib import Path

import fmpy
import numpy as np
import pytest
from fmpy.fmi1 import FMICallException

from rotorfilm import BallBearing, VariableComplianceBalls, back_to_back, export_fmu
from rotorfilm.bearings import Waviness
from rotorfilm.bearings.rolling import BALL_FREEDOMS
from rotorfilm.core import names
from rotorfilm.fmu import check_fmu
from rotorfilm.native import FOLDER

from .journals import version_and_kind

HOST = Path(__file__).parents[2] / "benchmarks" / "step_host.c"
ONE = BallBearing(
    balls=9,
    ball_diameter=7.938e-3,
    pitch_diameter=33.5e-3,
    contact_angle=math.radians(20.0),
    damping=120.0,
    waviness=(Waviness(inner=True, lobes=10, radial_amplitude=0.3e-6, phase=0.4),),
)
PAIR = back_to_back(replace(ONE, waviness=(), damping=0.0), distance=0.02, preload=200.0)


def five_degrees(bearing):
    return VariableComplianceBalls(bearing=bearing, freedoms=BALL_FREEDOMS)


MODELS = {"wavy": five_degrees(replace(ONE, tilt=(1e-4, 0.0))), "pair": five_degrees(PAIR)}
INPUTS, OUTPUTS = (names(getattr(MODELS["pair"], kind)) for kind in ("inputs", "outputs"))


def motions(count):
    scale = [8e-6, 8e-6, 6e-6, 2e-4, 2e-4, *[1e-2] * 5, 1500.0]
    return np.random.default_rng(3).uniform(-1.0, 1.0, (count, 11)) * scale + [0.0, 0.0, 6e-6, *[0.0] * 8]


@version_and_kind
@pytest.mark.parametrize("model", MODELS.values(), ids=MODELS)
def test_forces_moments_and_derivatives_are_those_of_python(version, model, exchange, opened):
    instance, reference = opened(model, version, exchange)
    inputs, outputs = [reference[name] for name in INPUTS], [reference[name] for name in OUTPUTS]
    states = motions(3)
    instance.initialize(inputs, states[0].tolist())
    angles = np.zeros(2)
    for number, state in enumerate(states):
        if not exchange:
            held = states[max(number - 1, 0)]
            instance.step(1e-3 * number, 1e-3)
            angles = angles + 1e-3 * np.array(model.derivative(0.0, angles, held))
        instance.set(inputs, state.tolist())
        expected = model.output(0.0, angles, state)
        np.testing.assert_allclose(instance.get(outputs), expected, rtol=1e-9, atol=1e-6)
        columns = [instance.directional(outputs, [one], [1.0]) for one in inputs]
        expected = model.linearization(0.0, angles, state).D
        np.testing.assert_allclose(np.array(columns).T, expected, rtol=1e-10, atol=1e-8)


@pytest.mark.parametrize("version", [pytest.param("2.0", marks=pytest.mark.long), "3.0"])
def test_it_is_native_by_default_and_passes_all_checks(version, tmp_path):
    path = export_fmu(MODELS["pair"], tmp_path / "b.fmu", version, start={"y": -2e-6, "speed": 300.0})
    assert [item.check for item in check_fmu(path) if item.passed is False] == []


def test_growth_and_damping_are_parameters(opened):
    instance, reference = opened(MODELS["wavy"], "2.0", False)
    state = motions(1)[0]
    instance.initialize([reference[one] for one in INPUTS], state.tolist())
    instance.set([reference["growth"], reference["damping"]], [3e-6, 40.0])
    other = five_degrees(replace(ONE, tilt=(1e-4, 0.0), growth=3e-6, damping=40.0))
    found = instance.get([reference[one] for one in OUTPUTS])
    np.testing.assert_allclose(found, other.output(0.0, [0.0, 0.0], state), rtol=1e-11, atol=1e-9)
    instance, reference = opened(MODELS["wavy"], "2.0", False)
    with pytest.raises(FMICallException):
        instance.initialize([reference["damping"]], [-1.0])
    assert any("damping must not be negative, got -1" in line for line in instance.log)


def test_a_host_in_c_gets_the_same(tmp_path):
    compiler = shutil.which("cc") or pytest.skip("no C compiler")
    host, rows, model = tmp_path / "host", motions(7), MODELS["pair"]
    subprocess.run(
        [compiler, "-std=c99", f"-I{FOLDER}", str(HOST), "-o", str(host), "-lm", "-ldl"], check=True
    )
    path = export_fmu(model, tmp_path / "b.fmu", component="balls")
    unzipped = fmpy.extract(str(path))
    description = fmpy.read_model_description(str(path))
    reference = {v.name: v.valueReference for v in description.modelVariables}
    library = next((Path(unzipped) / "binaries" / fmpy.platform).glob("*.so"))
    (tmp_path / "rows").write_bytes(rows.tobytes())
    told = subprocess.run(
        [
            str(host),
            str(library),
            (Path(unzipped) / "resources").as_uri(),
            description.guid,
            ",".join(str(reference[f"balls.{name}"]) for name in INPUTS),
            ",".join(str(reference[f"balls.{name}"]) for name in OUTPUTS),
            "1e-4",
            str(tmp_path / "rows"),
            "1",
        ],
        check=True,
        capture_output=True,
        text=True,
    )
    found = [float(word) for word in told.stdout.split()[1:]]
    angles = sum(1e-4 * np.array(model.derivative(0.0, [0.0, 0.0], row)) for row in rows)
    np.testing.assert_allclose(found, model.output(0.0, angles, rows[-1]), rtol=1e-9, atol=1e-8)
