"""What a first answer must not import: each path loads its own family and the packages that it needs."""

import subprocess
import sys
from pathlib import Path

import pytest

import rotorfilm

FAR = {"scipy", "control", "matplotlib", "fmpy", "pythonfmu", "xarray", "platformdirs", "pint"}
"""Packages that none of these paths needs."""

OTHER_PARTS = {"cosim", "studies", "charts", "sweeps", "questions", "rotors", "fmu", "cli", "identification"}
OTHER_FAMILIES = {"bearings.damper", "bearings.contact", "bearings.bush"}
TABLES = {"bearings.films.map_fit", "bearings.journal.grooved_film"}
"""What makes a map where there is none."""

CALL = "import sys; sys.argv[1:] = {!r}; from rotorfilm.__main__ import main; main()"
FORCE = """
from rotorfilm import JournalBearing
bearing = JournalBearing(radius=0.05, length=0.03, clearance=1e-4, viscosity=0.1)
bearing.force([3e-5, 0.0], [0.0, 0.0], 100.0)
"""
SCENE = Path(__file__).parents[1] / "examples" / "friswell.toml"
QUESTION = SCENE.with_name("question.toml")

PATHS = {
    "import": ("import rotorfilm", {"numpy", "rich"}, {"analysis", "bearings", "core.errors", "core.model"}),
    "version": (CALL.format(["--version"]), {"numpy", "rich"}, {"cli", "bearings"}),
    "help": (CALL.format(["--help"]), {"rich"}, OTHER_PARTS - {"cli"} | {"bearings", "scenes", "analysis"}),
    "force": (FORCE, {"rich"}, OTHER_PARTS | OTHER_FAMILIES | TABLES | {"scenes", "analysis"}),
    "solve": (
        CALL.format(["solve", str(SCENE)]),
        {"rich.progress"},
        OTHER_PARTS - {"cli", "rotors"}
        | OTHER_FAMILIES
        | {
            "analysis.frequency_dependent",
            "analysis.modal_reduction",
            "analysis.rotor_equilibrium",
            "analysis.simulate",
            "bearings.linear",
            "bearings.rolling",
            "bearings.pads",
            "cli.chart_commands",
            "rotors.base_excitation",
            "rotors.motor",
            "rotors.reduced_rotor",
            "scenes.new_scene",
        },
    ),
    "question": (
        CALL.format(["solve", str(QUESTION)]),
        {"rich.progress"},
        OTHER_PARTS - {"cli", "rotors", "questions"}
        | OTHER_FAMILIES
        | {
            "analysis.equal_steps",
            "analysis.periodic_orbit",
            "analysis.rotor_modes",
            "questions.film_motions",
        },
    ),
}
NEEDED = {"solve": {"scipy"}, "question": {"scipy"}}
"""Packages of `FAR` that a path takes all the same."""


def loaded_by(code):
    """Return the names of all modules that a fresh Python has after it ran some code."""
    told = "import atexit, sys; atexit.register(lambda: sys.stderr.write('\\n'.join(sys.modules)))\n"
    done = subprocess.run([sys.executable, "-c", told + code], capture_output=True, text=True, check=True)
    return set(done.stderr.split())


@pytest.mark.parametrize("path", PATHS)
def test_a_light_path_imports_no_other_family(path):
    code, packages, parts = PATHS[path]
    loaded = loaded_by(code)
    assert "rotorfilm" in loaded
    far = FAR - NEEDED.get(path, set())
    assert not loaded & (far | packages | {f"rotorfilm.{part}" for part in parts})


def test_the_list_of_modules_is_seen():
    assert {"numpy", "rotorfilm.bearings.damper", "rotorfilm.analysis"} <= loaded_by(
        "from rotorfilm import PorousDamper, equilibrium"
    )


def test_names_load_from_the_module_that_holds_them():
    code = "from rotorfilm.bearings import HalfSommerfeld"
    loaded = loaded_by(f"{code}; from rotorfilm.bearings.thrust import ThrustBearing")
    assert {"rotorfilm.bearings.films.geometry", "rotorfilm.bearings.thrust.bearing"} <= loaded
    assert "rotorfilm.bearings.journal" not in loaded
    # What a family brings to scenes and questions stands in its folder, and is no part of its physics.
    upper = {"scenes", "questions", "table"}
    assert not {name for name in loaded if name.startswith("rotorfilm.") and upper & {*name.split(".")}}


def test_a_function_hides_the_module_of_its_name():
    code = "import rotorfilm.analysis.whirl, rotorfilm.analysis as a; print(a.equilibrium, a.coefficients)"
    code += "; assert callable(a.equilibrium) and callable(rotorfilm.equilibrium)"
    assert "rotorfilm.analysis.equilibrium" in loaded_by(code)


def test_a_package_lists_its_public_names_only():
    assert dir(rotorfilm) == sorted(rotorfilm.__all__)
    assert {"JournalBearing", "equilibrium", "InputError", "export_fmu"} < set(dir(rotorfilm))
    assert not {"TYPE_CHECKING", "annotations", "show", "tension"} & set(dir(rotorfilm))
