"""An FMU of a film that reads a table and calls compiled code carries both."""

import subprocess
import sys
from pathlib import Path

import pytest

from rotorfilm.fmu.python.python_backend import bundle_source

ASK = """
from {package}.bearings.films.map_fit import tabulate_film
from {package}.bearings.journal.map_film import MapFilm
from {package}.bearings.journal.reynolds_film import ShortFilm
import numpy as np
film = MapFilm(tabulate_film(ShortFilm(), slenderness_range=(0.5, 0.5), cells=(6, 6, 0)))
print(film.force(np.array([0.1, 0.0]), np.array([0.0, 1.0]), 0.5)[1] < 0.0)
"""


def test_map_film_travels_with_its_library(tmp_path):
    bundle = bundle_source({"rotorfilm.bearings.journal.map_film"})
    for name, content in bundle.files.items():
        path = tmp_path / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_bytes(content)
    package = bundle.modules["rotorfilm"]
    ran = subprocess.run(
        [sys.executable, "-c", ASK.format(package=package)],
        cwd=tmp_path,
        capture_output=True,
        text=True,
        check=False,
    )
    assert ran.stdout.strip() == "True", ran.stderr


@pytest.mark.parametrize("name", ["map_film", "grooved_film"])
def test_every_film_of_the_library_travels_with_it(name):
    carried = {Path(file).name for file in bundle_source({f"rotorfilm.bearings.journal.{name}"}).files}
    assert "journal_map.bin" in carried
    assert any(file.startswith("rotorfilm.") for file in carried)


def test_a_users_film_over_a_map_travels_with_it(write_module):
    module = write_module("over_a_map", "from rotorfilm.bearings import GroovedMapFilm\n")
    assert [name for name in bundle_source({module.__name__}).files if name.endswith("journal_map.bin")]


def test_other_films_travel_without_it():
    files = bundle_source({"rotorfilm.bearings.journal.splitting_film"}).files
    assert not [name for name in files if name.endswith((".so", ".bin"))]


def test_fmus_of_other_models_share_no_modules():
    # The second would look for its table in the folder of the first, which may be gone.
    bearing = "rotorfilm.bearings.journal"
    short, mapped = (
        bundle_source({f"{bearing}.bearing", f"{bearing}.{film}"})
        for film in ("reynolds_film", "map_film")
    )
    assert set(short.modules) == set(mapped.modules)
    assert short.modules["rotorfilm"] != mapped.modules["rotorfilm"]
