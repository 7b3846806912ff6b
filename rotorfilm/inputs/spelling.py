"""What a misspelled name, or a symbol in place of a name, may have been meant to be."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from typing import Any

from ..errors import SceneError, shortened

SIMILAR = 0.4
"""Similarity, of 1, from which a known name is worth a hint."""

SAME_WORD = 0.7
"""Similarity from which an unknown key is the known one with a typo."""

SYMBOLS = {
    "d": "diameter",
    "e": "young_modulus",
    "eta": "viscosity",
    "g": "shear_modulus",
    "g_s": "shear_modulus",
    "id": "diametral_inertia",
    "idl": "inner_diameter",
    "idr": "end_inner_diameter",
    "ip": "polar_inertia",
    "it": "diametral_inertia",
    "m": "mass",
    "mu": "viscosity",
    "n": "node",
    "odl": "outer_diameter",
    "odr": "end_outer_diameter",
    "omega": "speed",
    "poisson": "poisson_ratio",
    "rho": "density",
}
"""Names of arguments by the symbols of textbooks and of ROSS, in small letters."""

RADIAL = ("clearance", "pad_clearance", "assembled_clearance")
"""Arguments that are radial, which a diametral clearance is twice."""


def nearest(name: object, known: Iterable[str]) -> str:
    """Return a hint with the known name nearest to `name`, or an empty string."""
    if not isinstance(name, str):
        return ""
    import difflib  # needed in the face of an error alone

    by_small_letters = {key.lower(): key for key in known}
    symbol = SYMBOLS.get(name.lower())
    if symbol in by_small_letters:
        return f"; did you mean {symbol!r}?"
    close = difflib.get_close_matches(name.lower(), by_small_letters, n=1, cutoff=SIMILAR)
    if not close:
        return ""
    meant = by_small_letters[close[0]]
    radial = "diametral" in name.lower() and meant in RADIAL
    return f"; did you mean {meant!r}{', half of it' if radial else ''}?"


def require_no_near_miss(where: str, tag: str, data: Mapping[str, Any]) -> None:
    """Raise SceneError if a key looks like a misspelled tag."""
    import difflib

    for key in data:
        if difflib.SequenceMatcher(None, key.lower(), tag).ratio() >= SAME_WORD:
            raise SceneError(f"{where}{shortened(key)} is no known key; did you mean {tag!r}?")
