"""Arrays of FMI 3.0 in place of components, and derivatives of outputs in time."""

import fmpy
import numpy as np
import pytest
from fmpy.fmi1 import FMICallException
from fmpy.validation import validate_fmu
from lxml import etree

from rotorfilm import InputError, JournalBearing
from rotorfilm.bearings.journal import MapFilm
from rotorfilm.fmu import check_fmu, export_fmu, extracted, instantiated
from rotorfilm.rotors import RigidRotor, SpeedProfile

BEARING = JournalBearing(radius=0.05, length=0.03, clearance=1e-4, viscosity=0.1, film=MapFilm())
MASS, SPEED, UNBALANCE = 50.0, 157.0, 8e-4
ROTOR = RigidRotor(mass=MASS, speed=SPEED, unbalance=UNBALANCE, gravity=(0.0, 0.0))
VERSIONS = ["2.0", "3.0"]


@pytest.mark.parametrize("interface", ["CoSimulation", "ModelExchange"])
def test_fmpy_simulates_a_film_with_arrays(interface, tmp_path):
    path = export_fmu(BEARING, tmp_path / "film.fmu", "3.0", component="film", arrays=True)
    assert validate_fmu(str(path)) == []
    time, pair = np.linspace(0.0, 0.01, 6), (2,)
    columns = [("time", float), ("film.position", float, pair), ("film.velocity", float, pair)]
    # Inputs that change must all be of one shape for fmpy.
    rows = np.zeros(len(time), dtype=columns)
    rows["time"] = time
    rows["film.position"] = np.stack([5e-5 + 2e-3 * time, 4e-5 - 3e-3 * time], axis=1)
    rows["film.velocity"] = 2e-3, -3e-3
    names = ["film.position", "film.velocity", "film.speed", "film.force"]
    result = fmpy.simulate_fmu(
        str(path),
        fmi_type=interface,
        start_values={"film.speed": SPEED},
        input=rows,
        stop_time=0.01,
        output_interval=2e-3,
        output=names,
    )
    for row in result:
        u = np.concatenate([row["film.position"], row["film.velocity"], [row["film.speed"]]])
        np.testing.assert_allclose(row["film.force"], BEARING.output(0.0, (), u), rtol=1e-12)
    assert len(np.unique(result["film.position"], axis=0)) >= 5


@pytest.mark.parametrize("model", [BEARING, ROTOR])
def test_an_fmu_with_arrays_passes_its_checks(model, tmp_path):
    path = export_fmu(model, tmp_path / "part.fmu", "3.0", component="part", arrays=True)
    checked = {item.check: item.passed for item in check_fmu(path)}
    assert False not in checked.values()
    assert len(checked) >= 7
    with extracted(path) as (_, folder):
        icons = etree.parse(f"{folder}/terminalsAndIcons/terminalsAndIcons.xml")
    members = [dict(member.attrib) for member in icons.iter("TerminalMemberVariable")]
    assert {(m["memberName"], m["variableName"]) for m in members} == {
        (name, f"part.{name}") for name in ("position", "velocity", "speed", "force")
    }


def test_calls_count_the_numbers_of_arrays(tmp_path):
    path = export_fmu(ROTOR, tmp_path / "rotor.fmu", "3.0", component="rotor", arrays=True)
    with extracted(path) as (description, folder):
        known = {v.name: v.valueReference for v in description.modelVariables}
        instance = instantiated(description, folder, False)
        force, velocity = known["rotor.force"], known["rotor.velocity"]
        instance.initialize([force], [20.0, -30.0])
        assert instance.get([force, known["rotor.mass"]]) == [20.0, -30.0, MASS]
        np.testing.assert_allclose(
            instance.output_slopes([velocity]), [20.0 / MASS + UNBALANCE * SPEED**2 / MASS, -30.0 / MASS]
        )
        with pytest.raises(FMICallException):
            instance.set([force], [1.0])
        assert "1 variables have 2 values, got 1" in instance.log[-1]
        instance.close()


@pytest.mark.closed_form
@pytest.mark.parametrize("version", VERSIONS)
def test_outputs_of_a_rotor_have_derivatives_in_time(version, tmp_path):
    slope = 4000.0
    rotor = RigidRotor(
        mass=MASS,
        speed=SpeedProfile(times=(0.0, 0.1), speeds=(10.0, 10.0 + 0.1 * slope)),
        unbalance=UNBALANCE,
        gravity=(0.0, 0.0),
    )
    path = export_fmu(rotor, tmp_path / "rotor.fmu", version, component="rotor")
    with extracted(path) as (description, folder):
        assert description.coSimulation.maxOutputDerivativeOrder == 1
        known = {v.name: v.valueReference for v in description.modelVariables}
        instance = instantiated(description, folder, False)
        instance.initialize([known["rotor.force_x"], known["rotor.force_y"]], [20.0, -30.0])
        instance.step(0.0, 0.01)
        speed, angle = 10.0 + 0.01 * slope, 10.0 * 0.01 + 0.5 * slope * 1e-4
        turn = np.array([np.cos(angle), np.sin(angle)])
        push = UNBALANCE * (speed**2 * turn + slope * np.array([turn[1], -turn[0]]))
        expected = (np.array([20.0, -30.0]) + push) / MASS
        names = ["x", "y", "vx", "vy", "speed"]
        found = instance.output_slopes([known[f"rotor.{name}"] for name in names])
        velocity = instance.get([known["rotor.vx"], known["rotor.vy"]])
        np.testing.assert_allclose(found, [*velocity, *expected, slope], rtol=1e-9)
        instance.close()


@pytest.mark.parametrize("version", VERSIONS)
def test_a_film_without_states_offers_no_derivatives_in_time(version, tmp_path):
    path = export_fmu(BEARING, tmp_path / "film.fmu", version, component="film")
    with extracted(path) as (description, folder):
        assert not description.coSimulation.maxOutputDerivativeOrder
        known = {v.name: v.valueReference for v in description.modelVariables}
        instance = instantiated(description, folder, False)
        instance.initialize([], [])
        with pytest.raises(FMICallException):
            instance.output_slopes([known["film.force_x"]])
        instance.close()


def test_arrays_are_for_native_fmus_of_fmi_3(tmp_path):
    with pytest.raises(InputError, match=r"arrays must be False unless FMI is 3\.0"):
        export_fmu(BEARING, tmp_path / "a.fmu", "2.0", arrays=True)
