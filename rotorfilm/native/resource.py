"""The file `resources/rotorfilm.bin` of a native FMU, which the C library reads (`native/fmi/resource.h`)."""

from __future__ import annotations

import re
import struct
import zlib
from collections.abc import Iterator, Sequence
from enum import IntEnum
from functools import cache
from textwrap import dedent

import numpy as np

from ..core.errors import InputError
from ..core.model import Array
from ..core.signals import Variable, elements_of
from .library import FOLDER
from .spec import NativeSpec

FILE_NAME = "rotorfilm.bin"
MAGIC = b"RFILMRES"
VERSION = 2
"""Since 2 a table may be stored in multiples of a quantum."""

_HEADER = struct.Struct("<8sIIQ")  # magic, version, checksum of what follows the header, size of the file
_MODEL = struct.Struct("<128s32sIIII")  # token, kernel, variables, tables, two reserved
# role, index, flags, elements of the array behind it, start, minimum, maximum, nominal, name
_VARIABLE = struct.Struct("<IIII4d48s")
_TABLE = struct.Struct("<32sIIIIIIQ")  # name, axes, four extents, whether in quanta, offset in the file
_TUNABLE = 1

QUANTA = (1e-7, 1e-8)
"""Units of tables that were rounded before they came here, as the map of the journal bearing is."""

LARGE = 256
"""Numbers of a table from which on its size matters."""


class Role(IntEnum):
    """What a variable is to the kernel, in the order of the value references."""

    TIME = 0
    PARAMETER = 1
    INPUT = 2
    OUTPUT = 3
    STATE = 4
    DERIVATIVE = 5
    SWITCH = 6


_ROLES = {
    "independent": Role.TIME,
    "parameter": Role.PARAMETER,
    "input": Role.INPUT,
    "output": Role.OUTPUT,
}


def role_of(variable: Variable) -> Role:
    """Return what a variable is to the kernel."""
    if variable.switch:
        return Role.SWITCH
    return _ROLES.get(variable.causality, Role.STATE if variable.state is None else Role.DERIVATIVE)


def pack(spec: NativeSpec, token: str, variables: Sequence[Variable]) -> bytes:
    """Return the content of the file.

    Parameters
    ----------
    spec : NativeSpec
    token : str
        FMI 2 guid, FMI 3 instantiationToken: what the simulator must present. At most 127 bytes.
    variables : sequence of Variable
        Variables in the order of their value references, roles ascending. Of a name, which serves messages,
        at most 47 bytes are kept.

    Raises
    ------
    InputError
        If a text is too long, the roles are not in order or the parameters are not those of the kernel.
    """
    _require_order(spec, variables)
    tables = sorted(spec.tables.items())
    entries = b"".join(_variables(variables))
    offset = _HEADER.size + _MODEL.size + len(entries) + len(tables) * _TABLE.size
    stored = [_stored(table) for _, table in tables]
    directory = b""
    for (name, table), (in_quanta, content) in zip(tables, stored, strict=True):
        directory += _directory(name, np.shape(table), in_quanta, offset)
        offset += len(content)
    head = _MODEL.pack(
        _text("token", token, 128), _text("kernel", spec.kernel, 32), len(variables), len(tables), 0, 0
    )
    body = b"".join([head, entries, directory, *(content for _, content in stored)])
    return _HEADER.pack(MAGIC, VERSION, zlib.crc32(body), _HEADER.size + len(body)) + body


def _require_order(spec: NativeSpec, variables: Sequence[Variable]) -> None:
    roles = [role_of(variable) for variable in variables]
    counts = {role: roles.count(role) for role in Role}
    if roles != sorted(roles) or counts[Role.TIME] != 1:
        raise InputError(
            f"variables must be time, parameters, inputs, outputs, states, derivatives, got {roles}"
        )
    if counts[Role.PARAMETER] != len(spec.parameters) or counts[Role.STATE] != counts[Role.DERIVATIVE]:
        raise InputError(
            f"variables must have {len(spec.parameters)} parameters and one derivative per state, got {roles}"
        )


def _variables(variables: Sequence[Variable]) -> Iterator[bytes]:
    seen = dict.fromkeys(Role, 0)
    for k, v in enumerate(variables):
        role, kept = role_of(v), v.name.encode()[:47].decode(errors="ignore").encode()
        start, nominal = 0.0 if v.start is None else v.start, v.nominal or 1.0
        flags = _TUNABLE if v.tunable else 0
        more = len(elements_of(variables, k)) - 1
        yield _VARIABLE.pack(role, seen[role], flags, more, start, v.minimum, v.maximum, nominal, kept)
        seen[role] += 1


def _directory(name: str, shape: tuple[int, ...], in_quanta: bool, offset: int) -> bytes:
    extents = [*shape, 0, 0, 0, 0][:4]
    return _TABLE.pack(_text("table", name, 32), len(shape), *extents, in_quanta, offset)


def _stored(table: Array) -> tuple[bool, bytes]:
    """Return whether a table is stored in quanta, and its bytes.

    Those are 8 a number; or, where all are multiples of a quantum, exactly, the quantum and the third
    differences of the multiples, modulo 2^32, first the lowest bytes of all: what zip makes small.
    """
    numbers = np.asarray(table, dtype="<f8")
    for quantum in QUANTA if numbers.size >= LARGE else ():
        multiples = np.rint(np.clip(numbers.ravel() / quantum, -(2**31), 2**31 - 1)).astype("<i4")
        if (multiples * quantum).tobytes() == numbers.tobytes():
            steps = np.diff(multiples, n=3, prepend=np.zeros(3, dtype="<i4"))
            planes = np.ascontiguousarray(steps).view(np.uint8).reshape(-1, 4).T
            return True, struct.pack("<d", quantum) + planes.tobytes()
    return False, numbers.tobytes()


def _text(what: str, text: str, size: int) -> bytes:
    data = text.encode()
    if len(data) >= size or b"\0" in data:
        raise InputError(f"{what} must have less than {size} bytes, got {text!r}")
    return data


# The kernels of the C library: the rows of `kernels/kernel_list.h`, and what a kernel's file says of it.


_LIBRARY = re.compile(r"^#define RF_(ROTORFILM\w*) \d+$", re.MULTILINE)
_ROW = re.compile(r"^RF_KERNEL\((\w+), ([| \w]+), (\w+)\)$", re.MULTILINE)
_PAGE = re.compile(r"/\* Documentation of the FMU\n(.*?)\*/", re.DOTALL)
_HEADINGS = ["Model", "Equations", "Validity"]


KernelRow = tuple[tuple[str, ...], str]
"""What the list says of a kernel: those of `libraries()` with it, the smallest first, and its picture."""


@cache
def libraries() -> tuple[str, ...]:
    """Return the names of the compiled libraries, first that which Python calls; an FMU carries one."""
    return tuple(name.lower() for name in _LIBRARY.findall(_source("kernel_list.h")))


@cache
def kernel_table() -> dict[str, KernelRow]:
    """Return the rows by the name of the kernel."""
    rows = _ROW.findall(_source("kernel_list.h"))
    return {
        name: (tuple(bit.strip()[3:].lower() for bit in bits.split("|")), picture)
        for name, bits, picture in rows
    }


def carried_library(spec: NativeSpec) -> str:
    """Return the library that an FMU of this kernel carries: the first that has those of its parts too."""
    own, *parts = (kernel_row(kernel)[0] for kernel in (spec.kernel, *spec.parts))
    return next(name for name in own if all(name in part for part in parts))


def kernel_row(kernel: str) -> KernelRow:
    """Return the row of a kernel.

    Raises
    ------
    InputError
        If there is none.
    """
    if kernel not in kernel_table():
        raise InputError(f"kernel must be one of {sorted(kernel_table())}, got {kernel!r}")
    return kernel_table()[kernel]


def kernel_texts(kernel: str) -> dict[str, str]:
    """Return the documentation of a kernel by heading, from a comment in its file; equations keep lines.

    Raises
    ------
    InputError
        If the comment is missing, or has other headings than Model, Equations and Validity.
    """
    found = _PAGE.search(_source(f"kernel_{kernel}.c"))
    blocks = dedent(found[1]).strip().split("\n\n") if found else []
    texts = {heading: text for heading, _, text in (block.partition(":") for block in blocks)}
    if list(texts) != _HEADINGS:
        raise InputError(f"kernel_{kernel}.c must document {_HEADINGS} for the FMU, got {list(texts)}")
    lines = texts["Equations"].strip("\n")
    return {name: " ".join(text.split()) for name, text in texts.items()} | {"Equations": lines}


def _source(name: str) -> str:
    return next(FOLDER.rglob(name)).read_text(encoding="utf-8")
