"""Bearings of rotorfilm as elements of ROSS (https://github.com/petrobras/ross), the optional extra `ross`.

Tested with ROSS 2.3.0 and 3.1.0.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from inspect import signature
from typing import TYPE_CHECKING, Any

import numpy as np

from ...bearings.linear import LinearBearing
from ...bearings.tabulated import TabulatedBearing
from ...errors import InputError
from ...inputs.kinds import arguments
from ...model import Array, Reaction
from ...reactions.added_mass import require_massless
from ...results import Coefficients

if TYPE_CHECKING:
    from ross import BearingElement, Rotor

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
        It interpolates by a spline of its own and may extrapolate, where `TabulatedBearing` refuses.

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
    speeds = np.asarray(bearing.speeds) if isinstance(bearing, TabulatedBearing) else None
    if speeds is not None and len(speeds) < 4:
        raise InputError(f"speeds must be at least 4 for ROSS, got {len(speeds)}")
    element = _ross().BearingElement
    if speeds is not None:
        # From 3 on what ROSS calls frequency is that of the whirl.
        values["speed" if "speed" in signature(element).parameters else "frequency"] = speeds
    return element(n=node, tag=tag, **values)


@arguments
def to_ross_force(
    rotor: Rotor, films: Mapping[int, Reaction], rests: Mapping[int, Coefficients]
) -> Callable[..., Array]:
    """Return what films do beyond their stiffness and damping, for `add_to_RHS` of ROSS's time response.

    The rotor of ROSS has a bearing `to_ross(LinearBearing(...))` of the film's stiffness K and damping C at
    each of these nodes, and its motion counts from the equilibrium, where ROSS starts, so that no weight is
    given. The force is F(q0 + d, v) - F(q0, 0) + K d + C v: with the linear part, which ROSS has in its
    matrices, it is the film at any displacement d. ROSS takes it at the start of a step,
    or iterates it (`newmark_type="robust"`). The speed is that of the coefficients.

    Parameters
    ----------
    rotor : ross.Rotor
    films : mapping of int to Reaction
        By node.
    rests : mapping of int to Coefficients
        Where each journal rests, with K and C there, as `coefficients` or a `RotorEquilibrium` has them.

    Returns
    -------
    callable
        `rotor.run_time_response(speed, F, t, method="newmark", add_to_RHS=...)`.

    Raises
    ------
    InputError
        If a film has no place of rest.
    FilmContactError
        From ROSS's run, where a journal meets the wall.
    """
    if set(films) != set(rests):
        raise InputError(f"rests must have the nodes of the films {sorted(films)}, got {sorted(rests)}")
    for node, film in films.items():
        require_massless(f"films[{node}]", film)
    places = {node: int(node) * int(rotor.number_dof) for node in films}
    static = {
        node: film.force(rests[node].position, np.zeros(2), rests[node].speed) for node, film in films.items()
    }

    def beyond(step: int, *, disp_resp: Array, velc_resp: Array, **state: object) -> Array:
        added = np.zeros(int(rotor.ndof))
        for node, film in films.items():
            at, where = rests[node], slice(places[node], places[node] + 2)
            moved, moving = disp_resp[where], velc_resp[where]
            force = film.force(at.position + moved, moving, at.speed)
            added[where] = force - static[node] + at.stiffness @ moved + at.damping @ moving
        return added

    return beyond


def _ross() -> Any:
    try:
        import ross
    except ImportError as missing:
        raise InputError(f"ross must be installed, `pip install 'rotorfilm[ross]'`, got {missing}") from None
    return ross
