"""Native FMUs of tilted journals: force, moment and derivatives are those of Python."""

import fmpy
import numpy as np
import pytest
from fmpy.fmi1 import FMICallException

from rotorfilm import JournalBearing, ValidityWarning, export_fmu
from rotorfilm.bearings import MomentCarryingJournal
from rotorfilm.bearings.journal import TiltLevel
from rotorfilm.bearings.journal.tilt_map import TiltMap
from rotorfilm.fmu import check_fmu

PLAIN = JournalBearing(radius=0.05, length=0.1, clearance=1e-4, viscosity=0.02)
INPUTS = ("x", "y", "tilt_x", "tilt_y", "vx", "vy", "tilt_rate_x", "tilt_rate_y", "speed")
OUTPUTS = ("force_x", "force_y", "moment_x", "moment_y")
AT = np.array([2e-5, -4e-5, 2e-4, 1e-4, 2e-3, 4e-3, 2e-2, -4e-2, 300.0])
versions = pytest.mark.parametrize("version", ["2.0", "3.0"])
levels = pytest.mark.parametrize("level", [TiltLevel.NONE, TiltLevel.CLOSED_FORM, TiltLevel.SECOND_ORDER])


@pytest.fixture(scope="module")
def table():
    """Return a map of tilts from films on few cells."""
    return TiltMap(1.0, (32, 8)).built()


def held(level, table):
    """Return the journal of a level."""
    own = table if level is TiltLevel.SECOND_ORDER else None
    return MomentCarryingJournal(bearing=PLAIN, level=level, tilt_map=own)


@versions
@levels
def test_forces_moments_and_derivatives_are_those_of_python(level, version, table, opened):
    model = held(level, table)
    instance, reference = opened(model, version, False)
    inputs, outputs = [reference[one] for one in INPUTS], [reference[one] for one in OUTPUTS]
    instance.initialize(inputs, AT.tolist())
    np.testing.assert_allclose(instance.get(outputs), model.output(0.0, (), AT), rtol=1e-13)
    slopes = model.linearization(0.0, (), AT).D
    found = np.array([instance.directional(outputs, [one], [1.0]) for one in inputs]).T
    np.testing.assert_allclose(found, slopes, rtol=1e-12, atol=1e-13 * np.abs(slopes).max())


@versions
def test_a_tilted_journal_is_native_and_passes_all_checks(version, table, tmp_path):
    start = {"x": 2e-5, "y": -4e-5, "tilt_x": 2e-4, "speed": 300.0}
    model = held(TiltLevel.SECOND_ORDER, table)
    path = export_fmu(model, tmp_path / "journal.fmu", version, start=start, stop_time=1e-3)
    assert [item.check for item in check_fmu(path) if item.passed is False] == []
    described = fmpy.read_model_description(str(path))
    names = {variable.name.rpartition(".")[2] for variable in described.modelVariables}
    assert {*INPUTS, *OUTPUTS, "clearance", "viscosity"} <= names


@versions
def test_parameters_are_tunable_and_contact_is_said(version, table, opened):
    instance, reference = opened(held(TiltLevel.SECOND_ORDER, table), version, False)
    inputs, outputs = [reference[one] for one in INPUTS], [reference[one] for one in OUTPUTS]
    instance.initialize(inputs, AT.tolist())
    before = np.array(instance.get(outputs))
    instance.set([reference["viscosity"]], [0.04])
    np.testing.assert_allclose(instance.get(outputs), 2.0 * before, rtol=1e-12)
    instance.set(inputs, [5e-5, 0.0, 0.0, 1.1e-3, *AT[4:]])
    with pytest.raises(FMICallException):
        instance.get(outputs)
    assert any("the ends of the journal must stay inside" in line for line in instance.log)


@versions
def test_a_tilt_that_drives_the_film_alone_is_warned_of(version, table, opened):
    state = np.array([0.0, -4e-5, 2e-4, 0.0, 0.0, 0.0, 0.1, 0.0, 1e-2])
    model = held(TiltLevel.SECOND_ORDER, table)
    instance, reference = opened(model, version, False)
    instance.initialize([reference[one] for one in INPUTS], state.tolist())
    found = instance.get([reference[one] for one in OUTPUTS])
    with pytest.warns(ValidityWarning, match="1.5 times"):
        np.testing.assert_allclose(found, model.output(0.0, (), state), rtol=1e-12)
    assert any("1.5 times as fast as the displacement" in line for line in instance.log)


def test_what_has_no_kernel_has_none(table):
    model = held(TiltLevel.SECOND_ORDER, table)
    assert model.native() is not None
    moved = MomentCarryingJournal(
        bearing=PLAIN, level=TiltLevel.SECOND_ORDER, tilt_map=table, bush_offset=(1e-5, 0.0)
    )
    assert moved.native() is None
