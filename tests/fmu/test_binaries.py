"""The end of a library by its headers, for each kind of file that an FMU has."""

import struct
import sys
from importlib.resources import files

import pytest

from rotorfilm import FmuError
from rotorfilm.fmu.native.platforms import require_complete_file, universal

SHIPPED = files("pythonfmu").joinpath("resources", "binaries")


def macho(wide, processor=7):
    """Return a Mach-O file of a segment with 100 bytes, behind 16 bytes of another command."""
    command, form, magic, header = (25, "QQQQ", 0xFEEDFACF, 32) if wide else (1, "IIII", 0xFEEDFACE, 28)
    size = 8 + 16 + struct.calcsize(f"<{form}")
    start = header + 16 + size
    segment = struct.pack(f"<II16s{form}", command, size, b"__TEXT", 0, 4096, start, 100)
    commands = struct.pack("<II8x", 0x1B, 16) + segment
    head = struct.pack("<IIIIII", magic, processor, 3, 6, 2, len(commands))
    return head.ljust(header, b"\0") + commands + bytes(100)


CASES = {
    "elf": lambda: SHIPPED.joinpath("linux64", "libpythonfmu-export.so").read_bytes(),
    "pe": lambda: SHIPPED.joinpath("win64", "pythonfmu-export.dll").read_bytes(),
    "mach-o": lambda: macho(True),
    "mach-o of 32 bits": lambda: macho(False),
    "universal": lambda: universal([macho(True), macho(True, 12)]),
}


@pytest.fixture
def written(tmp_path):
    def write(content):
        path = tmp_path / "binaries" / "platform" / "a.so"
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_bytes(content)
        return path

    return write


@pytest.mark.parametrize("kind", CASES)
def test_a_whole_library_passes_and_each_shorter_one_is_refused(kind, written):
    content = CASES[kind]()
    require_complete_file(written(content))
    require_complete_file(written(content + b"behind the end"))
    for length in {*range(4, min(len(content), 400)), *(len(content) * k // 20 for k in range(1, 20))}:
        with pytest.raises(FmuError, match=r"binaries/platform/a\.so must be whole, got \d+"):
            require_complete_file(written(content[:length]))
    with pytest.raises(FmuError, match=rf"got {len(content) - 1} of {len(content)} bytes"):
        require_complete_file(written(content[:-1]))


def test_the_interpreter_is_whole(written):
    if sys.platform != "linux":
        pytest.skip("an ELF program is needed")
    with open(sys.executable, "rb") as program:
        require_complete_file(written(program.read()))


def test_a_universal_file_within_a_universal_file_is_refused(written):
    content = bytearray(universal([macho(True), macho(True, 12)]))
    struct.pack_into(">II", content, 16, 0, len(content))
    with pytest.raises(FmuError, match="must be an ELF, PE or Mach-O file"):
        require_complete_file(written(content))


@pytest.mark.parametrize("content", [b"", b"#!/bin/sh\n", b"MZ" + bytes(200), b"\x7fEL"])
def test_what_is_no_library_is_refused(content, written):
    with pytest.raises(FmuError, match="must be an ELF, PE or Mach-O file, got one that starts with"):
        require_complete_file(written(content))
