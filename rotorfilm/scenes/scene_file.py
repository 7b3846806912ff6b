"""The text of a scene file: read, parsed, and of the right schema."""

from __future__ import annotations

import tomllib
from importlib import resources
from os import PathLike
from pathlib import Path
from typing import Any

from ..errors import SceneError, brief, shortened
from ..limits import LINE_DOTS, SCENE_BYTES
from .reading.tables import require_no_near_miss
from .schema import SCHEMA

BYTE_ORDER_MARK = "\ufeff"
"""What some editors put before the text of a file."""


def read_tables(path: str | PathLike[str]) -> dict[str, Any]:
    """Return the tables of a scene file as they are; raise SceneError if it cannot be read or is no TOML."""
    try:
        with Path(path).open("rb") as file:
            content = file.read(SCENE_BYTES + 1)
        document = content.decode("utf-8")
    except (OSError, ValueError) as error:
        reason = error.strerror if isinstance(error, OSError) else "it is not UTF-8 text"
        raise SceneError(f"{path}: scene file cannot be read: {reason}") from None
    if len(content) > SCENE_BYTES:
        raise SceneError(f"{path}: scene file must be at most {SCENE_BYTES} bytes long, got more")
    return parsed(document, str(path))


def parsed(document: str, source: str) -> dict[str, Any]:
    """Return the tables of a TOML text; `source` names it in messages."""
    if any(line.count(".") > LINE_DOTS for line in document.splitlines()):
        raise SceneError(f"{source}: lines must not have more than {LINE_DOTS} dots")
    try:
        return tomllib.loads(document.removeprefix(BYTE_ORDER_MARK))
    except tomllib.TOMLDecodeError as error:
        where = str(error).replace("end of document", f"line {len(document.splitlines())}, the last")
        raise SceneError(f"{source}: not valid TOML: {shortened(where)}") from None
    except RecursionError:
        raise SceneError(f"{source}: tables and lists must not be nested that deep") from None
    except ValueError:  # Python reads no integer of more than 4300 digits
        raise SceneError(f"{source}: integers must not have thousands of digits") from None


def json_schema() -> str:
    """Return the JSON Schema of scene files, which `tools/scene_schema.py` makes of their tables."""
    return resources.files(__package__).joinpath("data", "scene.schema.json").read_text(encoding="utf-8")


def require_schema(source: str, data: dict[str, Any]) -> None:
    """Take the version out of the data; raise SceneError if it is not the one that is read here."""
    value = data.pop("schema", None)
    if type(value) is not int or value != SCHEMA:
        require_no_near_miss(f"{source}: ", "schema", data)
        found = "nothing" if value is None else brief(value)
        raise SceneError(f"{source}: schema must be {SCHEMA} (write `schema = {SCHEMA}`), got {found}")
