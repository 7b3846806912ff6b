"""The two bush models as FMUs: valid, and the same physics as in Python."""

import math

import fmpy
import numpy as np
import pytest
from fmpy.validation import validate_fmu
from numpy.testing import assert_allclose
from scipy.integrate import solve_ivp

from rotorfilm.bearings.bush import BushReaction, BushWear, f4k20_bush
from rotorfilm.fmu import export_fmu

WEAR = BushWear(bush=f4k20_bush(), melting_heat=1e8)
WORN = BushReaction(bush=f4k20_bush(), melting_heat=1e8, nodes=24, extent=1.4)


def run(path, model, component, inputs, duration, step):
    """Return the outputs of an FMU under constant inputs, by name, at the communication points."""
    names = [signal.name for signal in model.outputs]
    result = fmpy.simulate_fmu(
        str(path),
        stop_time=duration,
        output_interval=step,
        step_size=step,
        start_values={f"{component}.{name}": value for name, value in inputs.items()},
        output=[f"{component}.{name}" for name in names],
    )
    return {name: result[f"{component}.{name}"] for name in names}


def test_wear_under_a_load(tmp_path):
    path = export_fmu(WEAR, tmp_path / "wear.fmu", component="bush", start={"load": 3750.0, "speed": 9.0})
    assert validate_fmu(str(path)) == []
    found = run(path, WEAR, "bush", {"load": 3750.0, "speed": 9.0}, 1.0, 0.25)
    u = [3750.0, 9.0]
    exact = solve_ivp(
        lambda t, x: WEAR.derivative(t, x, u), (0.0, 1.0), [0.0], "DOP853", rtol=1e-11, atol=1e-16
    )
    assert_allclose([found[s.name][0] for s in WEAR.outputs], WEAR.output(0.0, [0.0], u), rtol=1e-12)
    last = WEAR.output(1.0, exact.y[:, -1], u)
    assert_allclose([found[s.name][-1] for s in WEAR.outputs], last, rtol=1e-8)


def test_wear_begins_within_a_step_of_a_cold_bush(tmp_path):
    """Below the critical speed nothing happens, above it the FMU wears; the state says so."""
    path = export_fmu(WEAR, tmp_path / "wear.fmu", component="bush", start={"load": 3750.0})
    cold = run(path, WEAR, "bush", {"load": 3750.0, "speed": 3.9}, 0.5, 0.25)
    assert cold["melt_rate"].tolist() == [0.0, 0.0, 0.0]
    assert cold["temperature"][0] < 250.0
    hot = run(path, WEAR, "bush", {"load": 3750.0, "speed": 4.1}, 0.5, 0.25)
    assert np.all(np.diff(hot["contact_angle"]) > 0.0)
    assert hot["temperature"].tolist() == [250.0] * 3


@pytest.mark.parametrize("speed", [12.0])
def test_worn_bush_as_a_reaction(speed, tmp_path):
    x, y = WORN.position([0.0, -3750.0], speed)
    inputs = {"x": float(x), "y": float(y), "speed": speed}
    path = export_fmu(WORN, tmp_path / "worn.fmu", component="bush", start=inputs)
    assert validate_fmu(str(path)) == []
    description = fmpy.read_model_description(str(path))
    assert sum(v.name.startswith("bush.state_wear_") for v in description.modelVariables) == 24
    found = run(path, WORN, "bush", inputs, 0.02, 0.005)
    u = [x, y, 0.0, 0.0, speed]
    exact = solve_ivp(
        lambda t, v: WORN.derivative(t, v, u),
        (0.0, 0.02),
        WORN.initial_state,
        "DOP853",
        rtol=1e-10,
        atol=1e-16,
    )
    last = WORN.output(0.02, exact.y[:, -1], u)
    # Held in place, the shaft rubs itself free: the force falls.
    assert math.hypot(*last[:2]) < 0.9 * math.hypot(*WORN.output(0.0, WORN.initial_state, u)[:2])
    assert_allclose([found[s.name][-1] for s in WORN.outputs], last, rtol=1e-6)
