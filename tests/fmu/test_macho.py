"""The header of a universal file of macOS, read back as <mach-o/fat.h> says."""

import struct

import pytest

from rotorfilm import FmuError
from rotorfilm.fmu.native.platforms import universal

X86_64, ARM64 = 0x01000007, 0x0100000C


def library(processor, subtype, size):
    return struct.pack("<III", 0xFEEDFACF, processor, subtype).ljust(size, b"\x5a")


def slices(content):
    """Return (processor, subtype, library) of each slice, as the loader reads them."""
    magic, count = struct.unpack_from(">II", content)
    assert magic == 0xCAFEBABE
    for k in range(count):
        processor, subtype, offset, size, align = struct.unpack_from(">IIIII", content, 8 + 20 * k)
        assert offset % (1 << align) == 0
        yield processor, subtype, content[offset : offset + size]


@pytest.mark.closed_form
@pytest.mark.parametrize("sizes", [(20, 20), (16384, 1), (16385, 100_000), (40_000, 16384)])
def test_slices_come_back_as_they_went_in(sizes):
    parts = [library(ARM64, 0, max(12, sizes[0])), library(X86_64, 3, max(12, sizes[1]))]
    content = universal(parts)
    assert list(slices(content)) == [(X86_64, 3, parts[1]), (ARM64, 0, parts[0])]
    last = max(content.rindex(part) + len(part) for part in parts)
    assert len(content) == last


def test_one_slice_has_a_header_of_28_bytes():
    content = universal([library(ARM64, 0, 100)])
    assert content[28:16384].strip(b"\0") == b""
    assert content[:28].strip(b"\0") != b""


def test_the_order_of_the_slices_does_not_matter():
    parts = [library(ARM64, 0, 50), library(X86_64, 3, 70)]
    assert universal(parts) == universal(parts[::-1])


@pytest.mark.parametrize("content", [b"", b"\x7fELF" + bytes(20), struct.pack(">III", 0xFEEDFACF, ARM64, 0)])
def test_what_is_no_library_is_refused(content):
    with pytest.raises(FmuError, match="slice must be a little-endian 64-bit Mach-O file, got"):
        universal([content])


def test_two_libraries_for_one_processor_are_refused():
    with pytest.raises(FmuError, match="slices must be for different processors"):
        universal([library(ARM64, 0, 50), library(ARM64, 0, 60)])
