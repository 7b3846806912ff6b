"""Models as readable data: frozen dataclasses of plain values to JSON and back, exactly."""

from __future__ import annotations

import dataclasses
import importlib
import math
import sys
from collections.abc import Iterator, Mapping
from enum import Enum
from types import FunctionType
from typing import Any

import numpy as np

from ...core.errors import FmuError

PLAIN_DTYPES = {"|b1", "<i4", "<i8", "<u4", "<u8", "<f4", "<f8"}
"""Array types that JSON numbers hold exactly."""

SHOWN = 50
"""Longest array that is shown to people."""


def encode(value: Any, name: str = "model") -> Any:
    """Return `value` as JSON data from which `decode` makes an equal value.

    What has a method `portable` goes with what it would otherwise make on first use.

    Parameters
    ----------
    value : Any
        A number, bool, string, None, tuple, list, numpy array of numbers, a function from the top of a
        module, a member of an enumeration, or a dataclass or named tuple of such values.
    name : str
        What messages call the value, as `model.film.rupture`.

    Raises
    ------
    FmuError
        If the value or a field of it is anything else; the message names the field.
    """
    if isinstance(value, np.generic):
        value = value.item()
    if value is None or type(value) in (bool, int, str):
        return value
    if type(value) is float:
        return value if math.isfinite(value) else {"float": repr(value)}
    if type(value) is list:
        return _encode_items(value, name)
    if type(value) is tuple:
        return {"tuple": _encode_items(value, name)}
    if isinstance(value, np.ndarray):
        return _encode_array(value, name)
    if hasattr(value, "_fields") or (dataclasses.is_dataclass(value) and not isinstance(value, type)):
        return _encode_fields(value, name)
    if isinstance(value, FunctionType):
        return _encode_function(value, name)
    if isinstance(value, Enum):
        return {"function": f"{type(value).__module__}:{type(value).__qualname__}.{value.name}"}
    raise FmuError(
        f"{name} must be a number, bool, string, None, tuple, list, numpy array of numbers, a function or a "
        f"dataclass of such values, got {value!r} of type {type(value).__qualname__}"
    )


def decode(data: Any, modules: Mapping[str, str]) -> Any:
    """Return the value that `encode` turned into `data`.

    Parameters
    ----------
    data : Any
        JSON data.
    modules : mapping of str to str
        Modules that stand in for those of the encoded classes; a module that is absent stands for itself.
    """
    if isinstance(data, list):
        return [decode(item, modules) for item in data]
    if not isinstance(data, dict):
        return data
    if "float" in data:
        return float(data["float"])
    if "tuple" in data:
        return tuple(decode(item, modules) for item in data["tuple"])
    if "array" in data:
        values = [decode(item, modules) for item in data["array"]]
        return np.array(values, dtype=data["dtype"]).reshape(data["shape"])
    if "function" in data:
        return _load(data["function"], modules)
    fields = {name: decode(field, modules) for name, field in data["fields"].items()}
    return _load(data["class"], modules)(**fields)


def shortened(data: Any) -> Any:
    """Return encoded data for people: of long arrays only how long they are."""
    if isinstance(data, dict) and len(data.get("array", ())) > SHOWN:
        return {**data, "array": f"{len(data['array'])} numbers"}
    if isinstance(data, dict):
        return {name: shortened(value) for name, value in data.items()}
    return [shortened(item) for item in data] if isinstance(data, list) else data


def class_modules(data: Any) -> set[str]:
    """Return the names of the modules whose classes and functions occur in encoded data."""
    return {name.partition(":")[0] for name in _loaded_names(data)}


def _encode_items(items: list[Any] | tuple[Any, ...], name: str) -> list[Any]:
    return [encode(item, f"{name}[{index}]") for index, item in enumerate(items)]


def _encode_array(array: np.ndarray, name: str) -> dict[str, Any]:
    if array.dtype.str not in PLAIN_DTYPES:
        raise FmuError(f"{name} must be an array of real numbers or bools, got dtype {array.dtype}")
    return {
        "array": _encode_items(array.ravel().tolist(), name),
        "dtype": array.dtype.str,
        "shape": list(array.shape),
    }


def _encode_fields(value: Any, name: str) -> dict[str, Any]:
    value = value.portable() if hasattr(value, "portable") else value
    cls = type(value)
    if cls.__module__ == "__main__" or "<locals>" in cls.__qualname__:
        raise FmuError(
            f"{name} must be of a class defined at the top of an importable module, because the FMU carries "
            f"that module's source; got {cls.__module__}.{cls.__qualname__}"
        )
    if isinstance(value, tuple):
        names = value._fields  # type: ignore[attr-defined]
    else:  # fields outside __init__ follow from the others in __post_init__
        names = tuple(field.name for field in dataclasses.fields(value) if field.init)
    fields = {field: encode(getattr(value, field), f"{name}.{field}") for field in names}
    return {"class": f"{cls.__module__}:{cls.__qualname__}", "fields": fields}


def _encode_function(value: FunctionType, name: str) -> dict[str, str]:
    module, qualname = value.__module__, value.__qualname__
    if (
        module == "__main__"
        or not qualname.isidentifier()
        or getattr(sys.modules[module], qualname, None) is not value
    ):
        raise FmuError(
            f"{name} must be a function that 'def' defines at the top of an importable module, because the "
            f"FMU carries that module's source, got {module}.{qualname}. Write it into a file of its own and "
            "import it from there. Make its parameters fields of a frozen dataclass with __call__"
        )
    return {"function": f"{module}:{qualname}"}


def _load(name: str, modules: Mapping[str, str]) -> Any:
    module, _, qualname = name.partition(":")
    found: Any = importlib.import_module(modules.get(module, module))
    for part in qualname.split("."):
        found = getattr(found, part)
    return found


def _loaded_names(data: Any) -> Iterator[str]:
    if isinstance(data, dict):
        yield from (data[kind] for kind in ("class", "function") if kind in data)
        data = list(data.values())
    if isinstance(data, list):
        for item in data:
            yield from _loaded_names(item)
