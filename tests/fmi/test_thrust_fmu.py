"""Native FMUs of thrust bearings: force, torque, tilts and derivatives are those of Python."""

import math
from dataclasses import replace

import fmpy
import numpy as np
import pytest
from fmpy.fmi1 import FMICallException

from rotorfilm import export_fmu
from rotorfilm.bearings import ThrustBearing, TiltingThrustBearing
from rotorfilm.fmu import check_fmu

from .journals import crosswise, version_and_kind

SIZES = {"inner_radius": 0.025, "outer_radius": 0.05, "viscosity": 0.03, "gap": 5e-5, "cells": (16, 8)}
FIXED = ThrustBearing(pads=6, pad_arc=math.radians(50.0), taper_depth=4e-5, **SIZES)
BACK = ThrustBearing(pads=6, pad_arc=math.radians(50.0), step_depth=4e-5, side=-1, **SIZES)
RING = ThrustBearing(pads=1, pad_arc=2.0 * math.pi, continuous=True, **SIZES)
TILTING = TiltingThrustBearing(pads=4, pad_arc=math.radians(60.0), **SIZES)
LINE = TiltingThrustBearing(pads=3, pad_arc=math.radians(60.0), line_pivot=True, extrapolated=False, **SIZES)
MODELS = {"fixed": FIXED, "back": BACK, "ring": RING, "tilting": TILTING, "line": LINE}
MODELS |= {
    "fixed table": replace(FIXED, side=-1, extrapolated=False, tabulated=True),
    "tilting table": replace(TILTING, tabulated=True),
}

INPUTS = ("z", "tilt_x", "tilt_y", "vz", "tilt_rate_x", "tilt_rate_y", "speed")
OUTPUTS = ("force_z", "moment_x", "moment_y", "torque")
AT = np.array([4e-6, 1e-4, -5e-5, 1e-3, 0.02, -0.01, 300.0])
versions = pytest.mark.parametrize("version", ["2.0", "3.0"])


@version_and_kind
@pytest.mark.parametrize("name", MODELS)
def test_forces_tilts_and_derivatives_are_those_of_python(name, version, exchange, opened):
    model = MODELS[name]
    instance, reference = opened(model, version, exchange)
    x = np.asarray(getattr(model, "initial_state", np.zeros(0)))
    inputs, outputs = [reference[one] for one in INPUTS], [reference[one] for one in OUTPUTS]
    instance.initialize(inputs, AT.tolist())
    np.testing.assert_array_equal(instance.get(outputs), model.output(0.0, x, AT))
    slopes = model.linearization(0.0, x, AT)
    found = np.array([instance.directional(outputs, [one], [1.0]) for one in inputs]).T
    np.testing.assert_allclose(found, slopes.D, rtol=1e-13, atol=0.0)
    if len(x) and exchange:
        states = [reference[f"state_{signal.name}"] for signal in model.states]
        found = np.array([instance.directional(outputs, [one], [1.0]) for one in states]).T
        np.testing.assert_allclose(found, slopes.C, rtol=1e-12, atol=1e-12 * np.abs(slopes.C).max())


@pytest.mark.parametrize(("name", "version"), crosswise(["fixed", "tilting", "tilting table", "fixed table"]))
def test_a_thrust_bearing_is_native_and_passes_all_checks(name, version, tmp_path):
    start = {"speed": 300.0, "tilt_x": 1e-5}
    path = export_fmu(MODELS[name], tmp_path / "thrust.fmu", version, start=start, stop_time=1e-3)
    assert [item.check for item in check_fmu(path) if item.passed is False] == []
    described = fmpy.read_model_description(str(path))
    names = {variable.name.rpartition(".")[2] for variable in described.modelVariables}
    assert {*INPUTS, *OUTPUTS, "gap", "viscosity"} <= names


@versions
def test_parameters_are_tunable_and_contact_is_said(version, opened):
    instance, reference = opened(FIXED, version, False)
    inputs, outputs = [reference[one] for one in INPUTS], [reference[one] for one in OUTPUTS]
    instance.initialize(inputs, AT.tolist())
    before = np.array(instance.get(outputs))
    instance.set([reference["viscosity"]], [0.06])
    np.testing.assert_allclose(instance.get(outputs), 2.0 * before, rtol=1e-12)
    instance.set(inputs, [-6e-5, *AT[1:]])
    with pytest.raises(FMICallException):
        instance.get(outputs)
    assert any("the collar must stay off all pads" in line for line in instance.log)
