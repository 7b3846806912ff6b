"""The structures in Python are those of the C library, byte for byte."""

import ctypes
import inspect
import re
import subprocess

import pytest

from rotorfilm.native import (
    master_structs,
    pad_kernels,
    pad_kernels as tilting_kernel,
    structs,
    structs as ball_structs,
    structs as conserved_structs,
    structs as damper_structs,
    structs as heat_structs,
    structs as pad_structs,
    structs as run_structs,
)
from rotorfilm.native.library import FOLDER

KINDS = {
    name: kind
    for module in (
        structs,
        ball_structs,
        conserved_structs,
        damper_structs,
        heat_structs,
        master_structs,
        pad_kernels,
        pad_structs,
        run_structs,
        tilting_kernel,
    )
    for name, kind in inspect.getmembers(module, inspect.isclass)
    if issubclass(kind, ctypes.Structure) and kind is not ctypes.Structure
}
PLACES = {
    name: re.match(r"(\w+) of ([\w.]+)\.$", inspect.getdoc(kind)).groups() for name, kind in KINDS.items()
}


@pytest.fixture(scope="module")
def printed(tmp_path_factory, compiled):
    """Return what C says of every structure: size and offsets, and the two counts of march.h."""
    headers = {header: next(FOLDER.rglob(header)) for _, header in PLACES.values()}
    lines = [f'#include "{path}"' for path in headers.values()]
    lines += ["#include <stddef.h>", "#include <stdio.h>", "int main(void) {"]
    for name, (c_name, _) in PLACES.items():
        lines.append(f'printf("{name} %zu", sizeof({c_name}));')
        for field, *_ in KINDS[name]._fields_:
            lines.append(f'printf(" %zu", offsetof({c_name}, {field}));')
        lines.append('printf("\\n");')
    lines.append('printf("counts %d %d\\n", RF_SLOTS, RF_STEPS); return 0; }')
    folder = tmp_path_factory.mktemp("structs")
    (folder / "sizes.c").write_text("\n".join(lines))
    program = compiled([folder / "sizes.c"])
    told = subprocess.run([str(program)], capture_output=True, text=True, check=True).stdout
    return {row.split()[0]: [int(n) for n in row.split()[1:]] for row in told.splitlines()}


@pytest.mark.parametrize("name", PLACES)
def test_size_and_places_are_those_of_c(printed, name):
    kind = KINDS[name]
    places = [getattr(kind, field).offset for field, *_ in kind._fields_]
    assert printed[name] == [ctypes.sizeof(kind), *places]


def test_counts_are_those_of_c(printed):
    assert printed["counts"] == [structs.SLOTS, structs.STEPS]
