"""The atlas of limits of all physics: every panel of `limits_*.py`, computed in turn."""

from __future__ import annotations

import warnings
from collections.abc import Sequence

from ...errors import InputError, ValidityWarning
from ...progress import Report, silent
from . import (
    limits_bush,
    limits_contact,
    limits_damper,
    limits_heat,
    limits_journal,
    limits_rotor,
    limits_supply,
)
from .limit_panels import Limit, LimitAtlas, PanelCurves

PANELS: dict[str, PanelCurves] = {
    each.key: each
    for physics in (
        limits_journal,
        limits_supply,
        limits_heat,
        limits_rotor,
        limits_damper,
        limits_contact,
        limits_bush,
    )
    for each in physics.PANELS
}
"""All panels by their names, in the order in which they are drawn."""

PHYSICS = tuple(dict.fromkeys(each.panel.physics for each in PANELS.values()))
"""What the panels are about."""


def limits_atlas(physics: Sequence[str] | None = None, *, report: Report = silent) -> LimitAtlas:
    """Return the atlas of limits; all of it takes some 20 s of CPU.

    Parameters
    ----------
    physics : sequence of str, optional
        Which of `PHYSICS`; all by default.
    report : callable
        Called with the fraction done and a text.

    Raises
    ------
    InputError
        If one is not in `PHYSICS`, or there is none.
    """
    physics = PHYSICS if physics is None else physics
    for name in physics:
        if name not in PHYSICS:
            raise InputError(f"physics must be among {', '.join(PHYSICS)}, got {name!r}")
    chosen = {key: each for key, each in PANELS.items() if each.panel.physics in physics}
    if not chosen:
        raise InputError(f"physics must name one of {', '.join(PHYSICS)}, got none")
    found: list[Limit] = []
    for number, each in enumerate(chosen.values()):
        report(number / len(chosen), f"{each.panel.physics}: {each.panel.title}")
        with warnings.catch_warnings(action="ignore", category=ValidityWarning):
            # That a model is used beyond its range is what the atlas shows.
            found += each.limits()
    return LimitAtlas(panels={key: each.panel for key, each in chosen.items()}, limits=tuple(found))
