"""What the statuses of tilting pads mean, with the pad named."""

from __future__ import annotations

import math

from ....errors import ConvergenceError, FilmContactError, InputError, UndefinedDerivativeError
from ....model import Array
from ....native import Status
from .tilting_pads import TiltingPads


def report_pads(bearing: TiltingPads, status: int, pad: int, position: Array) -> None:
    """Raise what the status of a pad, counted from 0, says of a journal at a position (2,) [m]."""
    if status <= Status.OUTSIDE:
        return
    where = (
        f"pad {pad + 1} (pivot at {math.degrees(bearing.pivots[pad]) % 360.0:g} deg), "
        f"got a journal at {position.tolist()} m"
    )
    if status == Status.AT_WALL:
        raise FilmContactError(f"journal and pads must have a film everywhere, and touch at {where}")
    if status == Status.UNDEFINED:
        raise UndefinedDerivativeError(f"a film without source has no derivative, as that of {where}")
    if status == Status.NO_MEMORY:
        raise MemoryError("no memory for a film")
    if status == Status.STUCK:
        raise ConvergenceError(f"the tilt must be found, and was not, of {where}")
    raise InputError(f"states and inputs must be finite and not overflow, at {where}")
