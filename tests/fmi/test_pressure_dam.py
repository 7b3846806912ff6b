"""Native FMUs of pressure dam bearings: forces and derivatives of Python, dimensions, walls, systems."""

from dataclasses import replace

import fmpy
import numpy as np
import pytest
from fmpy.fmi1 import FMICallException

from rotorfilm import PressureDamBearing, RigidRotor, export_fmu, mount, pressure_dam_pads, simulate
from rotorfilm.fmu import check_fmu

from .journals import FORCES, INPUTS, motions, version_and_kind

DAM = PressureDamBearing(
    radius=0.05,
    length=0.04,
    assembled_clearance=1e-4,
    viscosity=0.03,
    pads=pressure_dam_pads(
        depth=60e-6, end="140 deg", share=0.75, track_depth=2e-4, track_share=0.3, preload=0.2
    ),
    cells=(16, 8),
)
versions = pytest.mark.parametrize("version", ["2.0", "3.0"])


@version_and_kind
@pytest.mark.parametrize("extrapolated", [False, True])
def test_forces_and_derivatives_are_those_of_python(version, extrapolated, exchange, same_as_python):
    model = replace(DAM, extrapolated=extrapolated)
    same_as_python(model, version, exchange, motions(6, 0.9), rtol=1e-14)


@versions
def test_a_pressure_dam_is_native_by_default_and_passes_all_checks(version, tmp_path):
    """At a start where no node at the edge of the film fills within the differences of the check."""
    path = export_fmu(DAM, tmp_path / "d.fmu", version, start={"x": 3e-5, "y": -4e-5, "speed": 300.0})
    assert [item.check for item in check_fmu(path) if item.passed is False] == []
    description = fmpy.read_model_description(str(path))
    names = {variable.name.rpartition(".")[2] for variable in description.modelVariables}
    assert {*INPUTS, *FORCES, "radius", "length", "clearance", "viscosity"} <= names


@versions
@pytest.mark.parametrize("name", ["radius", "length", "clearance", "viscosity"])
def test_all_dimensions_are_tunable(name, version, opened):
    """The recess keeps its depth in metres: another clearance makes another ratio of both."""
    instance, reference = opened(DAM, version, False)
    state, value = motions(1, 0.9)[0] * 0.5, 1.2 * getattr(DAM, name)
    instance.initialize([reference[one] for one in INPUTS], state.tolist())
    instance.set([reference[name]], [value])
    changed = {"assembled_clearance": None, "pad_clearance": value} if name == "clearance" else {name: value}
    expected = replace(DAM, **changed).force(state[:2], state[2:4], state[4])
    np.testing.assert_array_equal(instance.get([reference[one] for one in FORCES]), expected)


def test_what_is_wrong_is_said_with_the_pad(opened):
    instance, reference = opened(DAM, "2.0", False)
    inputs, outputs = [reference[one] for one in INPUTS], [reference[one] for one in FORCES]
    instance.initialize(inputs, [0.0, 0.0, 0.0, 0.0, 300.0])
    instance.set(inputs, [0.0, -1.5e-4, 0.0, 0.0, 300.0])
    with pytest.raises(FMICallException):
        instance.get(outputs)
    assert any("must stay off the pads, got a film of -5e-05 m on pad 1" in line for line in instance.log)


def test_a_bad_parameter_is_named(opened):
    instance, reference = opened(DAM, "2.0", False)
    with pytest.raises(FMICallException):
        instance.initialize([reference["clearance"]], [0.055])
    assert any("clearance must be below the radius" in line for line in instance.log)


@pytest.mark.parametrize("version", [pytest.param("2.0", marks=pytest.mark.long), "3.0"])
def test_a_rotor_in_pressure_dams_is_one_system(version, tmp_path):
    """The whole system in C: the FMU of rotor and bearing follows the motion in Python."""
    rotor = RigidRotor(mass=10.0, speed=300.0, unbalance=1e-4)
    system = mount(rotor, {"": DAM})
    path = export_fmu(system, tmp_path / "system.fmu", version, component="system", stop_time=1e-4)
    ran = fmpy.simulate_fmu(
        str(path),
        fmi_type="CoSimulation",
        stop_time=0.01,
        output_interval=1e-3,
        output=["system.x", "system.y"],
    )
    motion = simulate(rotor, DAM, duration=0.01, samples=11)
    apart = np.stack([ran["system.x"], ran["system.y"]]) - motion.position
    assert np.abs(apart).max() < 1e-4 * np.abs(motion.position).max()
