"""What users typed, as it may be shown: in a message, and on a terminal."""

from __future__ import annotations

import unicodedata

LONGEST = 120
"""Characters of a value in a message: one line of a terminal, with the rule beside it."""


def brief(value: object) -> str:
    """Return `repr(value)`, its middle left out where it is long."""
    try:
        text = repr(value)
    except (ValueError, RecursionError):  # an integer of thousands of digits, tables nested thousands deep
        return f"{type(value).__name__} too long to print"
    return shortened(text)


def shortened(text: str) -> str:
    """Return a text on one line, its middle left out where it is long."""
    # No letter gets shorter, so what is shown comes from the ends.
    head, tail = (visible(end.replace("\n", " ")) for end in (text[: LONGEST + 1], text[-LONGEST:]))
    if len(head) <= LONGEST:
        return head
    return f"{head[: LONGEST // 2]}... ({len(text)} characters) ...{tail[-LONGEST // 4 :]}"


def visible(text: str) -> str:
    r"""Return a text with what a terminal would obey, or cannot print, as escapes such as `\x1b`."""
    return "".join(
        letter.encode("unicode_escape").decode() if _is_control(letter) else letter for letter in text
    )


def _is_control(letter: str) -> bool:
    # Control codes, directions and other format characters, halves of letters that are none.
    return letter != "\n" and unicodedata.category(letter) in ("Cc", "Cf", "Cs")
