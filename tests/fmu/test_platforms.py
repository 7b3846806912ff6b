"""Libraries for other machines: where they go, what they are made from, what is said without a compiler."""

import os
import re
import shutil
import subprocess
import sys

import pytest

from rotorfilm import FmuError
from rotorfilm.fmu import export_fmu
from rotorfilm.fmu.native import platforms
from rotorfilm.native.resource import kernel_table
from rotorfilm.rotors import RigidRotor

FOLDERS = {
    "2.0": {"linux64/part.so", "aarch64-linux/part.so", "win64/part.dll", "darwin64/part.dylib"},
    "3.0": {
        "x86_64-linux/part.so",
        "aarch64-linux/part.so",
        "x86_64-windows/part.dll",
        "x86_64-darwin/part.dylib",
        "aarch64-darwin/part.dylib",
    },
}


@pytest.mark.parametrize("version", FOLDERS)
def test_each_library_has_the_folder_of_its_fmi_version(version, monkeypatch):
    made = {}

    def compiled(target, sources):
        made[target.folder] = sources
        processor = 7 if target.folder.startswith("x86_64") else 12
        return bytes.fromhex("cffaedfe") + processor.to_bytes(4, "little") + bytes(4)

    monkeypatch.setattr(platforms, "compiled", compiled)
    found = platforms.all_binaries("part", version, {"a.c": b""})
    assert set(found) == {f"binaries/{folder}" for folder in FOLDERS[version]}
    assert len(made) == 5
    fat = {path for path, content in found.items() if content.startswith(bytes.fromhex("cafebabe"))}
    assert fat == ({"binaries/darwin64/part.dylib"} if version == "2.0" else set())


def test_without_zig_the_extra_is_named(monkeypatch, tmp_path):
    monkeypatch.setattr(platforms, "find_spec", lambda name: None)
    with pytest.raises(FmuError, match=r"platforms must be 'host' unless .*\[platforms\]"):
        export_fmu(RigidRotor(mass=1.0, speed=1.0), tmp_path / "a.fmu", platforms="all")
    assert list(tmp_path.iterdir()) == []


def test_a_library_is_compiled_once_for_each_source(monkeypatch, tmp_path):
    runs = []

    def run(command, cwd, **options):
        runs.append(command)
        (cwd / command[command.index("-o") + 1]).write_bytes(b"library")
        return subprocess.CompletedProcess(command, 0, "", "")

    monkeypatch.setattr(platforms, "find_spec", lambda name: True)
    monkeypatch.setattr(platforms, "version", lambda name: "1")
    monkeypatch.setattr(platforms, "cache_folder", lambda: tmp_path)
    monkeypatch.setattr(platforms.subprocess, "run", run)
    target, sources = platforms.TARGETS[0], {"a.c": b"int a;", "sub/b.h": b""}
    assert [platforms.compiled(target, sources) for _ in range(2)] == [b"library"] * 2
    assert len(runs) == 1
    assert runs[0][:4] == [sys.executable, "-m", "ziglang", "cc"]
    platforms.compiled(target, {**sources, "a.c": b"int b;"})
    assert len(runs) == 2
    assert all("a.c" in command and "sub/b.h" not in command for command in runs)


def test_what_the_compiler_says_is_told(monkeypatch, tmp_path):
    failed = subprocess.CompletedProcess([], 1, "", "a.c:1: error: no")
    monkeypatch.setattr(platforms, "find_spec", lambda name: True)
    monkeypatch.setattr(platforms, "version", lambda name: "1")
    monkeypatch.setattr(platforms, "cache_folder", lambda: tmp_path)
    monkeypatch.setattr(platforms.subprocess, "run", lambda *arguments, **options: failed)
    with pytest.raises(FmuError, match=r"zig must compile the library for x86_64-linux, got: a\.c:1: error"):
        platforms.compiled(platforms.TARGETS[0], {"a.c": b""})


def test_sources_are_complete():
    sources = platforms.native_sources()
    included = {
        line.split('"')[1].rpartition("/")[2]
        for content in sources.values()
        for line in content.decode().splitlines()
        if line.startswith('#include "')
    }
    assert included <= {name.rpartition("/")[2] for name in sources}
    assert platforms.foreign_licenses()


def test_sources_of_a_kernel_declare_those_that_they_name():
    """As a ball contact has the kernel of its law in it."""
    known = {*kernel_table()}
    for kernel in known:
        own = platforms.model_sources([kernel], "3.0")
        rows = own[platforms.KERNEL_LIST].decode().splitlines()
        declared = {row.split(",")[0][10:] for row in rows if row.startswith("RF_KERNEL(")}
        text = b"".join(content for path, content in own.items() if path.endswith(".c")).decode()
        assert declared == {*re.findall(r"\brf_(\w+)_type\b", text)} & known
        assert kernel in declared


@pytest.mark.skipif(sys.platform == "win32", reason="the options are those of gcc and clang")
@pytest.mark.long
def test_each_kernel_links_from_its_own_sources(tmp_path):
    compiler = os.environ.get("CC", "cc")
    if shutil.which(compiler) is None:
        pytest.skip("no C compiler")
    sources = platforms.native_sources()
    for path, content in sources.items():
        (tmp_path / path).parent.mkdir(exist_ok=True)
        (tmp_path / path).write_bytes(content)
    units = [path for path in sources if path.endswith(".c")]
    options = ["-std=c99", "-O0", "-fPIC", "-I."]
    for path in units:
        command = [compiler, *options, "-c", path, "-o", path[:-1] + "o"]
        subprocess.run(command, check=True, cwd=tmp_path)
    for kernel in kernel_table():
        own = platforms.model_sources([kernel], "3.0")
        (tmp_path / platforms.KERNEL_LIST).write_bytes(own[platforms.KERNEL_LIST])
        objects = [path[:-1] + "o" for path in own if path.endswith(".c") and path != "kernels/kernels.c"]
        command = [compiler, *options, "-shared", "-Wl,--no-undefined", "kernels/kernels.c", *objects, "-lm"]
        subprocess.run([*command, "-o", f"{kernel}.so"], check=True, cwd=tmp_path)
        assert (tmp_path / f"{kernel}.so").stat().st_size > 0


def test_an_unknown_machine_is_named(monkeypatch):
    monkeypatch.setattr(platforms.platform, "machine", lambda: "riscv64")
    with pytest.raises(FmuError, match=r"machine must be one of .*got None-"):
        platforms.host_binary("part", "2.0", "rotorfilm")
