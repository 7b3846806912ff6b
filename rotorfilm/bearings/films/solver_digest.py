"""A name for the state of the two-dimensional solver, for what is kept of its work."""

from __future__ import annotations

import hashlib
from functools import cache
from pathlib import Path


@cache
def solver_digest(*others: str) -> str:
    """Return a digest of the sources of the solver, `ring*.py`, and of `others` beside them."""
    folder = Path(__file__).parent
    return source_digest(*sorted(path.name for path in folder.glob("ring*.py")), *others)


@cache
def source_digest(*names: str) -> str:
    """Return a digest of modules of this folder."""
    folder = Path(__file__).parent
    return hashlib.sha256(b"".join((folder / name).read_bytes() for name in names)).hexdigest()[:12]
