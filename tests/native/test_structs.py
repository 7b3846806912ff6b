"""The structures in Python are those of the C library, byte for byte."""

import ctypes
import re
import subprocess
from pathlib import Path

import pytest

import rotorfilm
from rotorfilm.cosim.compiled_loop import Ended
from rotorfilm.cosim.slaves import Call
from rotorfilm.native import FOLDER
from rotorfilm.native.ball_kernel import ROW, WAVE
from rotorfilm.native.pad_kernels import REST
from rotorfilm.native.structs import constant, declared, structure

SOURCES = [path.read_text(encoding="utf-8") for path in Path(rotorfilm.__file__).parent.rglob("*.py")]
NAMES = sorted({name for text in SOURCES for name in re.findall(r'structure\("(\w+)"\)', text)})
CONSTANTS = sorted({name for text in SOURCES for name in re.findall(r'constant\("(\w+)"\)', text)})
HEADERS = [path for path in FOLDER.rglob("*.h") if path.parent.name not in ("fmi", "solvers")]


def header_of(name):
    return next(path for path in HEADERS if re.search(rf"typedef struct {name} \{{", path.read_text()))


@pytest.fixture(scope="module")
def printed(tmp_path_factory, compiled):
    """Return what C says of every structure, size and offsets, and of every constant."""
    headers = {header_of(name) for name in NAMES} | {FOLDER / "master" / "partner.h"}
    lines = [f'#include "{path}"' for path in sorted(headers)]
    lines += ["#include <stddef.h>", "#include <stdio.h>", "int main(void) {"]
    for name in NAMES:
        lines.append(f'printf("{name} %zu", sizeof({name}));')
        for field, *_ in structure(name)._fields_:
            lines.append(f'printf(" %zu", offsetof({name}, {field}));')
        lines.append('printf("\\n");')
    lines += [f'printf("{name} %d\\n", (int) {name});' for name in CONSTANTS]
    folder = tmp_path_factory.mktemp("structs")
    (folder / "sizes.c").write_text("\n".join([*lines, "return 0; }"]))
    program = compiled([folder / "sizes.c"])
    told = subprocess.run([str(program)], capture_output=True, text=True, check=True).stdout
    return {row.split()[0]: [int(n) for n in row.split()[1:]] for row in told.splitlines()}


def test_all_structures_are_found():
    assert {"rf_map", "rf_march", "rf_coupling", "rf_tilting"} <= set(NAMES)
    assert len(NAMES) > 45


@pytest.mark.parametrize("name", NAMES)
def test_size_and_places_are_those_of_c(printed, name):
    kind = structure(name)
    places = [getattr(kind, field).offset for field, *_ in kind._fields_]
    assert printed[name] == [ctypes.sizeof(kind), *places]


@pytest.mark.parametrize("name", CONSTANTS)
def test_constants_are_those_of_c(printed, name):
    assert printed[name] == [constant(name)]


@pytest.mark.parametrize(
    ("name", "columns"), [("rf_ball_row", ROW), ("rf_ball_wave", WAVE), ("rf_tilting_rest", REST)]
)
def test_columns_of_tables_are_those_of_c(name, columns):
    kind = structure(name)
    assert [field for field, *_ in kind._fields_] == list(columns)
    assert ctypes.sizeof(kind) == 8 * len(columns)


def test_calls_and_ends_are_those_of_c():
    assert [constant(f"RF_{call.name}") for call in Call] == list(Call)
    assert constant("RF_CALLS") == len(Call)
    text = (FOLDER / "master" / "couple.h").read_text(encoding="utf-8")
    assert all(re.search(rf"\bRF_{end.name} = {end.value}\b", text) for end in Ended)


def test_names_of_structures_are_told_once():
    texts = [path.read_text(encoding="utf-8") for path in FOLDER.rglob("*.h")]
    told = [name for text in texts for name in re.findall(r"typedef struct (\w+) \{", text)]
    assert len(told) == len(set(told))
    assert set(declared()) <= set(told)
