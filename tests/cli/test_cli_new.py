"""`rotorfilm new`: a scene of each machine element has all of its keys, and is solved as it stands."""

import json
import tomllib

import pytest

from rotorfilm import PorousDamper, RigidRotor, synchronous_orbits, with_springs
from rotorfilm.scenes import parse_scene
from rotorfilm.scenes.families import FAMILIES, table_of
from rotorfilm.scenes.new_scene import new_scene
from rotorfilm.scenes.reading import keyed, twice_of


@pytest.mark.parametrize("name", FAMILIES)
def test_the_scene_of_an_element_is_solved_as_it_stands(run, tmp_path, name):
    path = tmp_path / "new.toml"
    assert run("new", name, "--out", path)[0] == 0
    code, out, _ = run("solve", path)
    assert code == 0
    assert out.startswith(f"A {name.replace('_', ' ')}")
    assert len(out.splitlines()) > 5


@pytest.mark.parametrize("name", FAMILIES)
def test_the_scene_of_an_element_has_all_of_its_keys(run, name):
    text = run("new", name)[1]
    lines = [line.removeprefix("# ") for line in text.splitlines()]
    for key, reader in keyed(table_of(name)).readers.items():
        assert any(line.startswith((f"{key} = ", f"{twice_of(reader) or key} = ")) for line in lines), key
    assert json.loads(run("new", name, "--json")[1]) == tomllib.loads(text)


def test_defaults_and_units_are_those_of_the_table():
    text = new_scene("tilting_pad")
    assert "# pivot_offset = 0.5" in text
    assert "Share of the pad before its pivot, from its start in the positive sense" in text
    assert '# pivot_stiffness = "... N/m"  # [N/m] Stiffness of each pivot in the radial direction' in text
    # A key with a default may be written as it is.
    plain = new_scene("journal").replace('# supply_pressure = "0 Pa"', 'supply_pressure = "0 Pa"')
    assert parse_scene(plain, "new").journal == parse_scene(new_scene("journal"), "new").journal


def test_other_names_are_refused(run):
    code, out, err = run("new", "tilting_pads")
    assert (code, out) == (2, "")
    assert "did you mean 'tilting_pad'" in err


def test_a_damper_answers_with_its_orbits(run, tmp_path):
    path = tmp_path / "damper.toml"
    path.write_text(new_scene("damper"), encoding="utf-8")
    code, out, _ = run("solve", path, "--json", "--out", tmp_path / "out")
    assert code == 0
    film = PorousDamper(radius=0.05, length=0.025, clearance=1e-4, viscosity=0.01)
    rotor = RigidRotor(mass=10.0, speed=628.3185307179587, unbalance=2e-4, gravity=(0.0, 0.0))
    orbits = synchronous_orbits(rotor, with_springs(film, 2e6)).at(2e-4)
    found = json.loads(out)["orbits"]
    assert [one["transmissibility"] for one in found] == pytest.approx(
        [one.transmissibility for one in orbits]
    )
    assert {one.name for one in (tmp_path / "out").iterdir()} == {"answer.json", "transmissibility.png"}
    assert "jumps" in run("solve", path)[1]
    for change, message in (
        ("rigid_rotor.unbalance=0", "rigid_rotor.unbalance must be positive"),
        ('damper.offset=["10 um", 0]', "damper.offset must be 0 for orbits about the center"),
        (
            "damper.supply={ supply_pressure = 1e5, end_groove = true }",
            "damper.film must be given beside supply",
        ),
    ):
        code, _, err = run("solve", path, "--set", change)
        assert code == 2
        assert message in err
