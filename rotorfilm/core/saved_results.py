"""Results and inputs in one JSON file with a checksum, and back as the same objects."""

from __future__ import annotations

import json
from collections.abc import Mapping
from dataclasses import fields, is_dataclass
from functools import cached_property
from importlib import import_module
from pathlib import Path
from typing import Any

import numpy as np

from .errors import InputError
from .files import read_sealed, write_sealed
from .inputs import arguments
from .readable import Readable
from .sources import PACKAGE

SETTINGS = "result of rotorfilm, version 1"
"""What the seal of a file belongs to."""

LABELS = ("input_labels", "output_labels")
"""Of a response of python-control."""

KIND = "="
"""Key of an object of JSON that names what it stands for."""


@arguments
def save_result(result: Any, path: Path | str) -> Path:
    """Write a result, or an input as a bearing or a rotor, into a JSON file with a checksum.

    Parameters
    ----------
    result : object
        A dataclass of this package whose fields are numbers, arrays, texts or such dataclasses, or a response
        of python-control.
    path : Path or str

    Raises
    ------
    InputError
        If it contains something else, such as a function; the message names it.
    """
    return write_sealed(path, json.dumps(_packed(result, type(result).__name__)).encode(), SETTINGS)


@arguments
def load_result(path: Path | str) -> Any:
    """Return what `save_result` wrote, an object of the same class.

    Raises
    ------
    InputError
        If the file is damaged, or none of `save_result`.
    """
    return _unpacked(json.loads(read_sealed(path, SETTINGS, f"path must be a file of {SETTINGS}")))


def _is_ours(kind: type) -> bool:
    return is_dataclass(kind) and kind.__module__.startswith(f"{PACKAGE}.")


def _packed(value: Any, where: str) -> Any:
    """Return a value as JSON has it; `where` names it in messages."""
    if value is None or isinstance(value, bool | str | int | float):
        return value
    if isinstance(value, complex | np.ndarray | np.generic) and np.asarray(value).dtype.kind in "biufc":
        array = np.ascontiguousarray(value)
        parts = array.ravel().view(array.real.dtype) if array.dtype.kind == "c" else array.ravel()
        shape = None if not isinstance(value, np.ndarray) else value.shape
        return {KIND: "array", "type": array.dtype.str, "shape": shape, "of": parts.tolist()}
    if type(value).__name__ == "FrequencyResponseData":
        held = {name: getattr(value, name) for name in ("frdata", "omega", *LABELS)}
        return {KIND: "response", "of": {name: _packed(one, f"{where}.{name}") for name, one in held.items()}}
    if isinstance(value, tuple | list):
        return {
            KIND: type(value).__name__,
            "of": [_packed(one, f"{where}[{k}]") for k, one in enumerate(value)],
        }
    if isinstance(value, Mapping):
        pairs = [[_packed(key, where), _packed(one, f"{where}[{key!r}]")] for key, one in value.items()]
        return {KIND: "dict", "of": pairs}
    if not _is_ours(type(value)):
        raise InputError(
            f"{where} must be a number, an array, a text or a dataclass to be saved, got {value!r}"
        )
    held = {name: _packed(one, f"{where}.{name}") for name, one in _held(value).items()}
    return {KIND: "object", "module": type(value).__module__, "name": type(value).__name__, "of": held}


def _held(value: Any) -> dict[str, Any]:
    """Return what a result holds, what it keeps of its arguments included; of an input its arguments."""
    if not isinstance(value, Readable):
        return {one.name: getattr(value, one.name) for one in fields(value) if one.init}
    kept = vars(value)
    return {
        name: kept[name] for name in kept if not isinstance(getattr(type(value), name, None), cached_property)
    }


def _unpacked(value: Any) -> Any:
    if not isinstance(value, dict):
        return value
    inner: Any = value["of"]
    match value[KIND]:
        case "array":
            dtype: Any = np.dtype(value["type"]).newbyteorder("=")
            array = np.array(inner, dtype.type(0).real.dtype).view(dtype)
            return array.item() if value["shape"] is None else array.reshape(value["shape"])
        case "response":
            held = {name: _unpacked(one) for name, one in inner.items()}
            names = {name.removesuffix("_labels") + "s": held[name] for name in LABELS}
            data = import_module("control").FrequencyResponseData
            return data(held["frdata"], held["omega"], **names)
        case "dict":
            return {_unpacked(key): _unpacked(one) for key, one in inner}
        case "tuple":
            return tuple(map(_unpacked, inner))
        case "list":
            return [*map(_unpacked, inner)]
    ours = value["module"].startswith(f"{PACKAGE}.")
    kind = getattr(import_module(value["module"]), value["name"], None) if ours else None
    if not (isinstance(kind, type) and _is_ours(kind)):
        raise InputError(f"path must hold objects of {PACKAGE}, got {value['module']}.{value['name']}")
    held = {name: _unpacked(one) for name, one in inner.items()}
    if not issubclass(kind, Readable):
        return kind(**held)
    made = kind.__new__(kind)
    vars(made).update(held)
    return made
