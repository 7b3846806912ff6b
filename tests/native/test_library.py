"""The C sources compile without a warning, show only their interface, and their absence is explained."""

import ctypes
import platform
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

from rotorfilm.native import NativeLibraryError, library
from rotorfilm.native.resource import libraries

SOURCES = sorted((Path(__file__).parents[2] / "rotorfilm" / "native").rglob("*.c"))
COMPILERS = [name for name in ("gcc", "clang") if shutil.which(name)]
LARGEST = {
    "rotorfilm": 87_000,
    "rotorfilm_states": 125_000,
    "rotorfilm_systems": 118_000,
    "rotorfilm_bushes": 62_000,
    "rotorfilm_grids": 166_000,
    "rotorfilm_grid_systems": 179_000,
    "rotorfilm_heat": 122_000,
    "rotorfilm_pads": 84_000,
    "rotorfilm_oil": 122_000,
    "rotorfilm_loops": 472_000,
    "rotorfilm_master": 405_000,
}
"""Bytes of each library on Linux, x86_64: what it has, and some room for other compilers."""

CALLED = ("rotorfilm", "rotorfilm_loops", "rotorfilm_master")
"""Libraries that Python calls."""


@pytest.mark.skipif(not COMPILERS, reason="no C compiler")
@pytest.mark.parametrize("compiler", COMPILERS)
@pytest.mark.parametrize("source", SOURCES, ids=lambda path: path.name)
def test_compiles_without_a_warning(compiler, source, tmp_path):
    strict = ["-std=c99", "-O2", "-Wall", "-Wextra", "-Wpedantic", "-Wshadow", "-Wconversion", "-Werror"]
    command = [compiler, *strict, "-c", str(source), "-o", str(tmp_path / "out.o")]
    ran = subprocess.run(command, capture_output=True, text=True, check=False)
    assert ran.returncode == 0, ran.stderr


def test_there_is_something_to_compile():
    assert {path.name for path in SOURCES} >= {"map_kernel.c", "journal_kernel.c"}


@pytest.mark.skipif(not shutil.which("nm"), reason="no nm")
@pytest.mark.parametrize("name", libraries())
def test_only_the_interface_is_visible(name):
    built = library.library_path(name)
    listed = subprocess.run(
        ["nm", "-D", "--defined-only", str(built)], capture_output=True, text=True, check=True
    )
    symbols = [line.split()[-1] for line in listed.stdout.splitlines()]
    assert symbols
    own = ("rf_", "fmi2", "fmi3") if name in CALLED else ("fmi2", "fmi3")
    assert all(symbol.startswith(own) for symbol in symbols)


@pytest.mark.skipif(
    (sys.platform, platform.machine()) != ("linux", "x86_64"), reason="the bound is that of Linux on x86_64"
)
@pytest.mark.parametrize("name", libraries())
def test_every_fmu_carries_little(name):
    assert library.library_path(name).stat().st_size <= LARGEST[name]


def test_missing_library_says_what_to_do(monkeypatch):
    monkeypatch.setattr(library, "SUFFIXES", dict.fromkeys(("linux", "darwin", "win32"), ".absent"))
    with pytest.raises(NativeLibraryError, match=r"rotorfilm\.absent of rotorfilm is missing.*C compiler"):
        library._load(ctypes.CDLL, "rotorfilm")


def test_library_of_another_version_says_what_to_do():
    with pytest.raises(NativeLibraryError, match=r"of another version \(.*rf_absent.*cmake"):
        library._typed(ctypes.CDLL, "rotorfilm", {"rf_absent": (None, [])})
