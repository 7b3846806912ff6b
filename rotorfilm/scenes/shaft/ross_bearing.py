"""Bearings of rotorfilm as elements of ROSS (https://github.com/petrobras/ross), the optional extra `ross`.

Tested with ROSS 2.3.0; 3.x is untested.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from ...bearings.linear import LinearBearing
from ...bearings.tabulated import TabulatedBearing
from ...errors import InputError
from ...inputs.kinds import arguments

if TYPE_CHECKING:
    from ross import BearingElement

ENTRIES = {"xx": (0, 0), "xy": (0, 1), "yx": (1, 0), "yy": (1, 1)}


@arguments
def to_ross(
    bearing: LinearBearing | TabulatedBearing, node: int, *, tag: str | None = None
) -> BearingElement:
    """Return stiffness and damping of a bearing, over speed if it has a table, as a bearing of ROSS.

    Both have the same axes: x to the right, y up, rotation from x to y; a load of [0, -W] is a weight. Give a
    film as `coefficient_table(film, load, speeds)`.

    Parameters
    ----------
    bearing : LinearBearing or TabulatedBearing
    node : int
        Node of the rotor of ROSS.
    tag : str, optional
        Name of the element.

    Returns
    -------
    ross.BearingElement
        It interpolates by a spline of its own and extrapolates in silence, where `TabulatedBearing` refuses.

    Raises
    ------
    InputError
        If ROSS cannot be imported, the bearing has no such coefficients, or its table has too few speeds.
    """
    if not isinstance(bearing, LinearBearing | TabulatedBearing):
        raise InputError(f"bearing must be a LinearBearing or a TabulatedBearing, got {bearing!r}")
    stiffness, damping = np.asarray(bearing.stiffness), np.asarray(bearing.damping)
    values: dict[str, Any] = {
        f"{letter}{entry}": table[..., row, column].tolist()
        for letter, table in (("k", stiffness), ("c", damping))
        for entry, (row, column) in ENTRIES.items()
    }
    if isinstance(bearing, TabulatedBearing):
        values["frequency"] = np.asarray(bearing.speeds)
        if len(values["frequency"]) < 4:
            raise InputError(f"speeds must be at least 4 for ROSS, got {len(values['frequency'])}")
    return _ross().BearingElement(n=node, tag=tag, **values)


def _ross() -> Any:
    try:
        import ross
    except ImportError as missing:
        raise InputError(f"ross must be installed, `pip install 'rotorfilm[ross]'`, got {missing}") from None
    return ross
