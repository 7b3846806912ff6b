"""Bearings in files of ROSS: coefficients, constant or over speed."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np

from ...bearings.linear import LinearBearing
from ...bearings.tabulated import TabulatedBearing
from ...errors import InputError

RossTable = Mapping[str, Any]


def over_speed(data: RossTable, tables: Mapping[str, dict[str, Any]]) -> dict[str, dict[str, Any]]:
    """Return the tables with one axis, named as in ROSS 1 and 2, whose `frequency` is the speed.

    From 3 on `frequency` is that of the whirl, which no table over speed has.
    """
    found = {}
    for name, table in tables.items():
        speed, whirl = table.get("speed"), table.get("frequency")
        if whirl is not None and (speed is not None or str(data.get("ross_version", "2")) >= "3"):
            raise InputError(f"speed must be the only axis of the coefficients, got frequency in {name!r}")
        found[name] = table if speed is None else {**table, "frequency": speed}
    return found


def read_bearing(name: str, table: RossTable) -> LinearBearing | TabulatedBearing:
    """Return the bearing of a table, whose `frequency` is the speed; see `over_speed`."""
    if "kxx" not in table:
        raise InputError(
            f"{name!r} must be a shaft element, a disk or have the coefficient kxx, got {list(table)}"
        )
    masses = [table.get(f"m{entry}", 0.0) for entry in ("xx", "xy", "yx", "yy")]
    if any(np.any(np.asarray(mass)) for mass in masses):
        raise InputError(f"mxx, mxy, myx, myy must be 0, got {masses} in {name!r}")
    stiffness, damping = (_entries(table, letter) for letter in "kc")
    if len(stiffness) == len(damping) == 1:
        return LinearBearing(stiffness=stiffness[0], damping=damping[0])
    speeds = np.asarray(table.get("frequency", ()), dtype=float)
    if len(speeds) < 2:
        raise InputError(
            f"frequency must go with the coefficients, got {table.get('frequency')!r} in {name!r}"
        )
    whole = [np.broadcast_to(t, (len(speeds), 2, 2)) for t in (stiffness, damping)]
    return TabulatedBearing(speeds=speeds, stiffness=whole[0], damping=whole[1])


def _entries(table: RossTable, letter: str) -> np.ndarray:
    """Return the coefficients k or c, shape (n, 2, 2); ROSS leaves out what it can guess."""
    main = table[f"{letter}xx"]
    cross = np.zeros_like(np.atleast_1d(main))
    found = [
        table.get(f"{letter}xx"),
        table.get(f"{letter}xy", cross),
        table.get(f"{letter}yx", cross),
        table.get(f"{letter}yy", main),
    ]
    columns = np.broadcast_arrays(*(np.atleast_1d(np.asarray(entry, dtype=float)) for entry in found))
    return np.stack(columns, axis=-1).reshape(-1, 2, 2)
