"""From one dataclass to another that has fields of the same names."""

from __future__ import annotations

from dataclasses import fields
from typing import Any, TypeVar

T = TypeVar("T")


def made_from(makes: type[T], table: Any, **further: Any) -> T:
    """Return an object of a dataclass: what its fields share with those of a table, and further values.

    Parameters
    ----------
    makes : type
        The dataclass.
    table : object
        Of another dataclass.
    **further
        Values of fields that the table does not have, or that differ there.
    """
    own = {field.name for field in fields(makes)}  # type: ignore[arg-type]
    shared = own & {field.name for field in fields(table)} - further.keys()
    return makes(**{name: getattr(table, name) for name in shared}, **further)
