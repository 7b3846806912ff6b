"""Tabulated bearings as native FMUs, and in FMI 3.0 as calibratable maps of FMI-LS-STRUCT."""

from contextlib import closing
from dataclasses import replace
from pathlib import Path

import fmpy
import numpy as np
import pytest
from fmpy.fmi1 import FMICallException
from fmpy.validation import validate_fmu
from lxml import etree

from rotorfilm import TabulatedBearing
from rotorfilm.cosim import open_fmu
from rotorfilm.cosim.slaves import kernel_partner
from rotorfilm.fmu import check_fmu, export_fmu, extracted, instantiated

KIND = "org.fmi-standard.fmi-ls-struct.map"


def bearing(count):
    """Return a table whose entries rise, fall and turn."""
    numbers = np.random.default_rng(count)
    return TabulatedBearing(
        speeds=np.cumsum(numbers.uniform(20.0, 90.0, count)),
        stiffness=numbers.normal(size=(count, 2, 2)) * 1e7,
        damping=numbers.normal(size=(count, 2, 2)) * 1e4,
    )


TABLE = bearing(7)
MIDDLE = 0.5 * (TABLE.speeds[2] + TABLE.speeds[3])
MOTION = [2e-5, -3e-5, 4e-3, 1e-3]
START = dict(zip(("x", "y", "vx", "vy", "speed"), [*MOTION, MIDDLE], strict=True))


@pytest.mark.parametrize("count", [1, 2, 3, 7])
def test_the_kernel_has_the_force_of_python(count, tmp_path):
    table = bearing(count)
    start = {"speed": float(table.speeds[0])}
    path = export_fmu(table, tmp_path / "t.fmu", component="t", backend="native", start=start)
    between = np.linspace(table.speeds[0], table.speeds[-1], 1 if count == 1 else 23)
    with open_fmu(path) as fmu:
        fmu.start(dict(zip(fmu.inputs, [*MOTION, start["speed"]], strict=True)))
        for speed in [*table.speeds.tolist(), *between.tolist()]:
            fmu.set(dict(zip(fmu.inputs, [*MOTION, speed], strict=True)))
            found = [fmu.get()[name] for name in fmu.outputs]
            expected = table.force(MOTION[:2], MOTION[2:], speed)
            np.testing.assert_allclose(found, expected, rtol=1e-11, atol=1e-12 * np.abs(expected).max())


@pytest.mark.parametrize(
    ("version", "arrays"), [("2.0", False), pytest.param("3.0", False, marks=pytest.mark.long), ("3.0", True)]
)
def test_an_fmu_passes_its_checks(version, arrays, tmp_path):
    path = export_fmu(TABLE, tmp_path / "t.fmu", version, component="t", start=START, arrays=arrays)
    assert validate_fmu(str(path)) == []
    checked = {item.check: item.passed for item in check_fmu(path)}
    assert False not in checked.values()
    assert checked["directional derivatives"]
    names = {v.name for v in fmpy.read_model_description(str(path)).modelVariables}
    assert ("t.kxy" in names, "t.kxy_7" in names) == (arrays, not arrays)


def test_a_simulator_may_calibrate_the_map(tmp_path):
    path = export_fmu(TABLE, tmp_path / "t.fmu", "3.0", component="t", start=START, arrays=True)
    stiffer = replace(TABLE, stiffness=TABLE.stiffness * [[1.5, 1.0], [1.0, 1.0]])
    with (
        extracted(path) as (description, folder),
        closing(instantiated(description, folder, False)) as instance,
    ):
        known = {v.name: v.valueReference for v in description.modelVariables}
        instance.initialize([], [])
        assert instance.get([known["t.kxx"]]) == TABLE.stiffness[:, 0, 0].tolist()
        instance.set([known["t.kxx"]], stiffer.stiffness[:, 0, 0].tolist())
        expected = stiffer.force(MOTION[:2], MOTION[2:], MIDDLE)
        np.testing.assert_allclose(instance.get([known["t.force"]]), expected, rtol=1e-12)
        assert abs(expected[0] - TABLE.force(MOTION[:2], MOTION[2:], MIDDLE)[0]) > 1.0
        with pytest.raises(FMICallException):  # it is fixed after initialization
            instance.set([known["t.speeds"]], np.asarray(TABLE.speeds).tolist())


def test_the_map_is_a_terminal_of_the_layered_standard(tmp_path):
    path = export_fmu(TABLE, tmp_path / "t.fmu", "3.0", component="t", start=START, arrays=True)
    with extracted(path) as (description, folder):
        root = etree.parse(f"{folder}/terminalsAndIcons/terminalsAndIcons.xml")
        manifest = etree.parse(f"{folder}/extra/org.fmi-standard.fmi-ls-struct/fmi-ls-manifest.xml").getroot()
    schema = Path(fmpy.__file__).parent / "schema" / "fmi3" / "fmi3TerminalsAndIcons.xsd"
    assert etree.XMLSchema(file=str(schema)).validate(root)
    assert manifest.tag == "fmiLayeredStandardManifest"
    assert set(manifest.attrib.values()) == {
        "org.fmi-standard.fmi-ls-struct",
        "1.0.0-rc.1",
        "Layered standard for structuring of variables",
    }
    [terminal] = [t for t in root.iter("Terminal") if t.get("terminalKind") == f"{KIND}.rectilinearGrid"]
    assert (terminal.get("name"), terminal.get("matchingRule")) == ("t_map", KIND)
    members = [(m.get("variableKind").removeprefix(f"{KIND}."), m.get("variableName")) for m in terminal]
    assert members[:2] == [("domain", "t.speeds"), ("domainInput", "t.speed")]
    values = [f"t.{letter}{pair}" for letter in "kc" for pair in ("xx", "xy", "yx", "yy")]
    assert members[2:] == [("codomain", name) for name in values]
    variables = {v.name: v for v in description.modelVariables}
    for kind, name in members:
        size = [int(d.start) for d in variables[name].dimensions]
        assert size == ([] if kind == "domainInput" else [len(TABLE.speeds)])


def test_an_fmu_without_arrays_has_no_map(tmp_path):
    path = export_fmu(TABLE, tmp_path / "t.fmu", "3.0", component="t", start=START)
    with extracted(path) as (_, folder):
        assert not Path(folder, "extra").exists()


def test_speeds_beyond_the_table_and_falling_ones_are_refused(tmp_path):
    path = export_fmu(TABLE, tmp_path / "t.fmu", "3.0", component="t", start=START, arrays=True)
    with (
        extracted(path) as (description, folder),
        closing(instantiated(description, folder, False)) as instance,
    ):
        known = {v.name: v.valueReference for v in description.modelVariables}
        instance.initialize([], [])
        instance.set([known["t.speed"]], [1.1 * TABLE.speeds[-1]])
        with pytest.raises(FMICallException):
            instance.get([known["t.force"]])
        assert "speed must be within the table" in instance.log[-1]
    with extracted(path) as (description, folder):
        instance = instantiated(description, folder, False)
        with pytest.raises(FMICallException):
            instance.initialize([known["t.speeds"]], np.asarray(TABLE.speeds)[::-1].tolist())
        assert "speeds must rise" in instance.log[-1]


def test_other_freedoms_and_subclasses_have_no_kernel():
    class Own(TabulatedBearing):
        pass

    own = Own(speeds=TABLE.speeds, stiffness=TABLE.stiffness, damping=TABLE.damping)
    axial = TabulatedBearing(speeds=[1.0], stiffness=[[[1.0]]], damping=[[[1.0]]], freedoms=("z",))
    assert own.native() is axial.native() is None
    assert kernel_partner(TABLE) is not None
