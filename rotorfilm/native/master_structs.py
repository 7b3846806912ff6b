"""The structures of the co-simulation master in C (`native/master`), as ctypes reads them."""

from __future__ import annotations

import ctypes
from collections.abc import Sequence
from ctypes import c_char, c_double, c_int32, c_int64, c_size_t, c_uint32, c_void_p
from enum import IntEnum
from typing import Any, ClassVar


class Call(IntEnum):
    """rf_call of partner.h."""

    PUT = 0
    TAKE = 1
    STRIDE = 2
    SLOPE = 3
    MOVE = 4
    RATE = 5


class Ended(IntEnum):
    """rf_coupled of couple.h."""

    COUPLED = 0
    ROTOR_FAILED = 1
    FILM_FAILED = 2
    NOT_NUMBERS = 3
    ROTOR_WAITING = 4
    FULL = 5


FMI2, FMI3, KERNEL = range(3)
"""Kinds of partners, of partner.h."""

HELD, LAWFUL, INTEGRATED = range(3)
"""Modes of rotors, of rotor.h."""


class PartnerStruct(ctypes.Structure):
    """rf_partner of partner.h."""

    _fields_: ClassVar[Sequence[Any]] = [
        ("kind", c_int32),
        ("status", c_int32),
        ("failed", c_int32),
        ("component", c_void_p),
        ("put", c_void_p),
        ("take", c_void_p),
        ("stride", c_void_p),
        ("slope", c_void_p),
        ("set_time", c_void_p),
        ("set_states", c_void_p),
        ("rate", c_void_p),
        ("states", c_size_t),
        ("calls", c_int64 * len(Call)),
    ]


class TableStruct(ctypes.Structure):
    """rf_table of kernel.h."""

    _fields_: ClassVar[Sequence[Any]] = [
        ("name", c_char * 32),
        ("axes", c_uint32),
        ("extent", c_uint32 * 4),
        ("numbers", c_void_p),
    ]


class TablesStruct(ctypes.Structure):
    """rf_tables of kernel.h."""

    _fields_: ClassVar[Sequence[Any]] = [("list", c_void_p), ("count", c_size_t)]


class MessageStruct(ctypes.Structure):
    """rf_message of status.h."""

    _fields_: ClassVar[Sequence[Any]] = [("text", c_char * 320)]


class OwnStruct(ctypes.Structure):
    """rf_own of partner.h."""

    _fields_: ClassVar[Sequence[Any]] = [
        ("type", c_void_p),
        ("kernel", c_void_p),
        ("tables", TablesStruct),
        ("sizes", c_size_t * 5),
        ("t", c_double),
        ("x", ctypes.POINTER(c_double)),
        ("u", ctypes.POINTER(c_double)),
        ("y", c_void_p),
        ("slopes", c_void_p * 4),
        ("outside", c_int32),
        ("beyond", ctypes.POINTER(c_double)),
        ("why", MessageStruct),
    ]


class RotorStruct(ctypes.Structure):
    """rf_rotor of rotor.h."""

    _fields_: ClassVar[Sequence[Any]] = [
        ("partner", c_void_p),
        ("mode", c_int32),
        ("stations", c_int32),
        ("outputs", c_size_t),
        ("output_refs", c_void_p),
        ("motion_refs", c_void_p),
        ("drive_refs", c_void_p),
        ("rows", c_void_p),
        ("columns", c_void_p),
        ("x", c_void_p),
        ("nominal", c_void_p),
        ("base", c_void_p),
        ("nodes", c_void_p),
        ("to_powers", c_void_p),
        ("kink", c_double),
        ("known", c_int32),
        ("slopes", c_void_p),
        ("work", c_void_p),
    ]


class StationStruct(ctypes.Structure):
    """rf_station of couple.h."""

    _fields_: ClassVar[Sequence[Any]] = [
        ("partner", c_void_p),
        ("inputs", c_size_t),
        ("outputs", c_size_t),
        ("known", c_size_t),
        ("input_refs", c_void_p),
        ("output_refs", c_void_p),
        ("feeds", c_void_p),
        ("force_refs", c_void_p),
        ("known_refs", c_void_p),
        ("knowns", c_void_p),
        ("force_at", c_int32 * 2),
    ]


class RecordStruct(ctypes.Structure):
    """rf_record of law.h."""

    _fields_: ClassVar[Sequence[Any]] = [
        ("count", c_int64),
        ("room", c_int64),
        ("m", c_size_t),
        ("columns", c_size_t),
        ("position", c_void_p),
        ("velocity", c_void_p),
        ("speed", c_int32),
        ("derived", c_int32),
        ("time", c_void_p),
        ("outputs", c_void_p),
        ("force", c_void_p),
        ("tangents", c_void_p),
        ("work", c_void_p),
    ]


class CouplingStruct(ctypes.Structure):
    """rf_coupling of couple.h."""

    _fields_: ClassVar[Sequence[Any]] = [
        ("scheme", c_int32),
        ("degree", c_int32),
        ("gentle", c_int32),
        ("third", c_int32),
        ("stations", c_int32),
        ("who", c_int32),
        ("rotor", c_void_p),
        ("films", c_void_p),
        ("record", RecordStruct),
        ("points", c_void_p),
        ("macro_step", c_double),
        ("t", c_double),
        ("reached", c_double),
        ("step", c_int64),
        ("done", c_int64 * 5),
        ("laws", c_void_p),
        ("every", c_int32),
        ("checking", c_int32),
        ("checks", c_int64),
        ("checked", c_void_p),
        ("check_tangents", c_void_p),
        ("check_slopes", c_void_p),
        ("work", c_void_p),
    ]
