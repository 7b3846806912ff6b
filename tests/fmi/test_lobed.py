"""Native FMUs of lobed bearings: forces and derivatives of Python, walls, systems."""

import fmpy
import numpy as np
import pytest
from fmpy.fmi1 import FMICallException

from rotorfilm import Lobe, LobedBearing, RigidRotor, export_fmu, lobe_set, mount, simulate
from rotorfilm.bearings import PadMapFilm, PadResolution
from rotorfilm.fmu import check_fmu

from .journals import FORCES, INPUTS, motions, version_and_kind

FILM = PadMapFilm(resolution=PadResolution(cells=(32, 4), nodes=(8, 9, 24)))
LOBED = LobedBearing(
    radius=0.05, length=0.04, pad_clearance=1e-4, viscosity=0.03, lobes=lobe_set("three_lobe"), film=FILM
)
MIXED = LobedBearing(
    radius=0.05,
    length=0.04,
    pad_clearance=1e-4,
    viscosity=0.03,
    lobes=(
        Lobe(start=3.6, extent=2.0, preload=0.3, offset=0.6),
        Lobe(start=0.2, extent=1.0),
        Lobe(start=1.5, extent=1.0, preload=0.5, offset=1.0),
    ),
    film=FILM,
)
versions = pytest.mark.parametrize("version", ["2.0", "3.0"])


@version_and_kind
@pytest.mark.parametrize("model", [LOBED, MIXED], ids=["three lobes", "mixed"])
def test_forces_and_derivatives_are_those_of_python(version, model, exchange, same_as_python):
    same_as_python(model, version, exchange, motions(6, 0.45), rtol=1e-13)


@versions
def test_a_lobed_bearing_is_native_by_default_and_passes_all_checks(version, tmp_path):
    path = export_fmu(LOBED, tmp_path / "l.fmu", version, start={"x": 2e-5, "y": -3e-5, "speed": 300.0})
    assert [item.check for item in check_fmu(path) if item.passed is False] == []


@versions
def test_clearance_and_viscosity_scale_the_film(version, opened):
    """The film knows position / clearance only: a bearing of twice the clearance at twice the position."""
    instance, reference = opened(LOBED, version, False)
    state = np.array([2e-5, -3e-5, 1e-3, 2e-3, 300.0])
    twice = np.array([2.0, 2.0, 2.0, 2.0, 1.0]) * state
    instance.initialize([reference[one] for one in INPUTS], state.tolist())
    instance.set([reference["clearance"], reference["viscosity"]], [2e-4, 0.09])
    instance.set([reference[one] for one in INPUTS], twice.tolist())
    found = np.array(instance.get([reference[one] for one in FORCES]))
    expected = 3.0 / 4.0 * LOBED.force(state[:2], state[2:4], state[4])
    np.testing.assert_allclose(found, expected, rtol=1e-12)


def test_contact_and_another_length_are_refused(opened):
    instance, reference = opened(LOBED, "2.0", False)
    inputs, outputs = [reference[one] for one in INPUTS], [reference[one] for one in FORCES]
    instance.initialize(inputs, [0.0, 0.0, 0.0, 0.0, 300.0])
    instance.set(inputs, [0.0, 6e-5, 0.0, 0.0, 300.0])
    with pytest.raises(FMICallException):
        instance.get(outputs)
    assert any("must leave a film on every pad" in line for line in instance.log)
    other, reference = opened(LOBED, "2.0", False)
    with pytest.raises(FMICallException):
        other.initialize([reference["length"]], [0.05])
    assert any("length/diameter must be that of the maps of the pads" in line for line in other.log)


@versions
def test_a_rotor_in_lobed_bearings_is_one_system(version, tmp_path):
    """The whole system in C: the FMU of rotor and bearing follows the motion in Python."""
    rotor = RigidRotor(mass=10.0, speed=300.0, unbalance=1e-4)
    path = export_fmu(
        mount(rotor, {"": LOBED}), tmp_path / "system.fmu", version, component="system", stop_time=1e-4
    )
    ran = fmpy.simulate_fmu(
        str(path), fmi_type="CoSimulation", stop_time=0.01, output_interval=1e-4, relative_tolerance=1e-8
    )
    name = next(one for one in ran.dtype.names if one.endswith(".y") or one == "y")
    followed = simulate(rotor, LOBED, duration=0.01, rtol=1e-9)
    expected = np.interp(ran["time"], followed.time, followed["y"])
    assert ran[name] == pytest.approx(expected, abs=1e-4 * np.abs(expected).max())
