"""The kernels of the C library: the rows of `kernels/kernel_list.h`, and what a kernel's file says of it."""

from __future__ import annotations

import re
from functools import cache
from textwrap import dedent
from typing import NamedTuple

from ..errors import InputError
from .library import FOLDER
from .spec import NativeSpec

_LIBRARY = re.compile(r"^#define RF_(ROTORFILM\w*) \d+$", re.MULTILINE)
_ROW = re.compile(r"^RF_KERNEL\((\w+), ([| \w]+), (\w+)\)$", re.MULTILINE)
_PAGE = re.compile(r"/\* Documentation of the FMU\n(.*?)\*/", re.DOTALL)
_HEADINGS = ["Model", "Equations", "Validity"]


class KernelRow(NamedTuple):
    """What the list says of a kernel.

    Attributes
    ----------
    libraries : tuple of str
        Of `libraries()`, those that have it, the smallest first.
    picture : str
        Name of the picture of its FMUs.
    """

    libraries: tuple[str, ...]
    picture: str


@cache
def libraries() -> tuple[str, ...]:
    """Return the names of the compiled libraries, first that which Python calls; an FMU carries one."""
    return tuple(name.lower() for name in _LIBRARY.findall(_source("kernel_list.h")))


@cache
def kernel_table() -> dict[str, KernelRow]:
    """Return the rows by the name of the kernel."""
    rows = _ROW.findall(_source("kernel_list.h"))
    return {
        name: KernelRow(tuple(bit.strip()[3:].lower() for bit in bits.split("|")), picture)
        for name, bits, picture in rows
    }


def carried_library(spec: NativeSpec) -> str:
    """Return the library that an FMU of this kernel carries: the first that has those of its parts too."""
    parts = [set(kernel_row(part).libraries) for part in spec.parts]
    return next(name for name in kernel_row(spec.kernel).libraries if all(name in part for part in parts))


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
