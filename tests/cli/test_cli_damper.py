"""The damper at the command line: its numbers, JSON, chart, and one line for each mistake."""

import json

import pytest

from rotorfilm import (
    EndSeal,
    FiniteSqueeze,
    FullFilm,
    PorousCage,
    PorousDamper,
    RigidRotor,
    Sprung,
    SqueezeFilmDamper,
    synchronous_orbits,
)
from rotorfilm.cli import damper_command as cli_damper, main as cli
from rotorfilm.scenes.damper_table import SQUEEZES

OPTIONS = {
    "--radius": "50 mm",
    "--length": "25 mm",
    "--clearance": "0.1 mm",
    "--viscosity": "4.096e-4 Pa s",
    "--mass": "10 kg",
    "--speed": "400 rad/s",
    "--stiffness": "2.56e5 N/m",
    "--unbalance": "400 g mm",
    "--thickness": "2.5 mm",
    "--permeability": "0.4 um2",
}


def damper(drop=(), *flags, **changes):
    options = OPTIONS | {f"--{name}": value for name, value in changes.items()}
    words = [word for name, value in options.items() if name not in drop for word in (name, value)]
    return ["damper", *words, *flags]


@pytest.fixture
def run(capsys):
    def call(arguments):
        with pytest.raises(SystemExit) as exit_:
            cli.main([str(argument) for argument in arguments])
        out, err = capsys.readouterr()
        return exit_.value.code or 0, out, err

    return call


def test_numbers_are_those_of_the_library(run):
    code, out, err = run(damper((), "--json"))
    assert (code, err) == (0, "")
    answer = json.loads(out)
    cage = PorousCage(thickness=2.5e-3, permeability=4e-13)
    film = PorousDamper(radius=0.05, length=0.025, clearance=1e-4, viscosity=4.096e-4, cage=cage)
    rotor = RigidRotor(mass=10.0, speed=400.0, unbalance=4e-4, gravity=(0.0, 0.0))
    orbits = synchronous_orbits(rotor, Sprung(reaction=film, stiffness=2.56e5)).at(4e-4)
    assert len(orbits) == len(answer["orbits"]) == 3
    for found, expected in zip(answer["orbits"], orbits, strict=True):
        assert found["eccentricity_ratio"] == pytest.approx(expected.eccentricity_ratio, rel=1e-9)
        assert found["transmissibility"] == pytest.approx(expected.transmissibility, rel=1e-9)
    assert answer["groups"]["squeeze_number"] == pytest.approx(0.08)
    # the fold of the notes: U = .4079 of mass * clearance
    assert answer["folds"][0]["unbalance"] == pytest.approx(0.4079e-3, abs=5e-8)


def test_film_is_chosen_by_its_name(run):
    found = [json.loads(run(damper((), "--film", name, "--json"))[1]) for name in ("short", "map")]
    fold, mapped = (answer["folds"][0]["unbalance"] for answer in found)
    assert fold != mapped == pytest.approx(fold, rel=1e-5)
    assert found[1]["contact_unbalance"] is None
    code, _, err = run(damper((), "--film", "finite"))
    assert code == 2
    assert "extent must be FullFilm()" in err
    assert sorted(cli_damper.Squeeze) == sorted(SQUEEZES)


def test_people_read_jumps_and_contact(run, tmp_path):
    code, out, _ = run(damper((), "--chart", str(tmp_path / "response.png")))
    assert code == 0
    assert "up at 407.85 g mm, down at 392.06 g mm" in out
    assert out.count("stable") == 3
    assert out.count("unstable") == 1
    assert (tmp_path / "response.png").stat().st_size > 5000


def test_solid_full_film_has_neither(run):
    code, out, _ = run(damper(("--thickness", "--permeability"), "--full"))
    assert code == 0
    assert "none" in out


def test_contact_is_said(run):
    code, out, _ = run(damper(unbalance="1400 g mm"))
    assert code == 0
    assert "none: the rotor hits the wall" in out


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (damper(clearance="-0.1 mm"), "error: clearance must be finite and positive, got -0.0001"),
        (damper(permeability="3 mm"), "error: --permeability: quantity must be measured in m2"),
        (damper(("--permeability",)), "error: --thickness and --permeability must be given together"),
        (
            damper(("--thickness", "--permeability"), "--vented"),
            "error: --grading, --anisotropy and --vented need",
        ),
        (damper(unbalance="0"), "error: unbalances must be positive"),
        (damper(speed="0 rpm"), "error: reference_speed must be finite and positive"),
    ],
)
def test_mistake_gives_one_line(run, arguments, message):
    code, out, err = run(arguments)
    assert (code, out) == (2, "")
    assert message in err
    assert err.count("\n") == 1


def test_help_shows_an_example_that_runs(run):
    code, out, _ = run(["damper", "--help"])
    assert code == 0
    assert "Example: rotorfilm damper" in out


def test_seals_and_inertia(run):
    flags = ("--full", "--film", "finite", "--density", "850 kg/m3", "--leakage", "1e-9 m2/(Pa s)", "--json")
    code, out, _ = run(damper(("--thickness", "--permeability"), *flags, viscosity="4 mPa s"))
    film = SqueezeFilmDamper(
        radius=0.05,
        length=0.025,
        clearance=1e-4,
        viscosity=4e-3,
        density=850.0,
        extent=FullFilm(),
        film=FiniteSqueeze(),
        seals=EndSeal(leakage=1e-9),
    )
    rotor = RigidRotor(mass=10.0, speed=400.0, unbalance=4e-4, gravity=(0.0, 0.0))
    (orbit,) = synchronous_orbits(rotor, Sprung(reaction=film, stiffness=2.56e5)).at(4e-4)
    assert code == 0
    assert json.loads(out)["orbits"][0]["transmissibility"] == pytest.approx(orbit.transmissibility, rel=1e-9)
