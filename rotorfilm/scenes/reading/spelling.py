"""What a misspelled name of a scene file may have been meant to be."""

from __future__ import annotations

import difflib
from collections.abc import Iterable, Mapping
from typing import Any

from ...errors import SceneError, shortened

_SIMILAR = 0.4
"""Similarity, of 1, from which a known key is worth a hint."""

_SAME_WORD = 0.7
"""Similarity from which an unknown key is the known one with a typo."""


def nearest(name: object, known: Iterable[str]) -> str:
    """Return a hint with the known name nearest to `name`, or an empty string."""
    if not isinstance(name, str):
        return ""
    by_small_letters = {key.lower(): key for key in known}
    close = difflib.get_close_matches(name.lower(), by_small_letters, n=1, cutoff=_SIMILAR)
    return f"; did you mean {by_small_letters[close[0]]!r}?" if close else ""


def require_no_near_miss(where: str, tag: str, data: Mapping[str, Any]) -> None:
    """Raise SceneError if a key looks like a misspelled tag."""
    for key in data:
        if difflib.SequenceMatcher(None, key.lower(), tag).ratio() >= _SAME_WORD:
            raise SceneError(f"{where}{shortened(key)} is no known key; did you mean {tag!r}?")
