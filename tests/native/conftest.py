"""A folder as an unzipped native FMU is, without its description."""

import shutil
from importlib.resources import files
from pathlib import Path

import pytest

from rotorfilm.native.resource import FILE_NAME, native_variables, pack

TOKEN = "{8c4e810f-3df3-4a00-8276-176fa3c9f000}"


def library_path():
    return next(path for path in files("rotorfilm.native").iterdir() if path.name.startswith("rotorfilm."))


@pytest.fixture
def unzipped(tmp_path):
    """Return a function that writes the folder of a model and returns it with its value references."""

    def write(model, start=None, folder="fmu", token=TOKEN):
        root = tmp_path / folder
        spec = model.native()
        variables = native_variables(model, spec, "m", start or {})
        for name in ("binaries/linux64", "binaries/x86_64-linux", "resources"):
            Path(root, name).mkdir(parents=True, exist_ok=True)
        for name in ("linux64", "x86_64-linux"):
            shutil.copy(library_path(), root / "binaries" / name / "m.so")
        (root / "resources" / FILE_NAME).write_bytes(pack(spec, token, variables))
        return root, {variable.name: reference for reference, variable in enumerate(variables)}

    return write
