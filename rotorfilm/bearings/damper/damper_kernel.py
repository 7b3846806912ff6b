"""The kernel of the C library that is a squeeze-film damper over a map, with or without retainer springs."""

from __future__ import annotations

import math
from dataclasses import replace
from typing import TYPE_CHECKING

from ...model import MOTION_NAMES
from ...native.spec import NativeParameter, NativeSpec
from .mapped_squeeze import MappedSqueezeFilm

if TYPE_CHECKING:
    from .bearing import PorousDamper

KERNEL = "damper"
SPRING = "stiffness"

_DIMENSIONS = (
    ("radius", "m", "radius of the film"),
    ("length", "m", "axial length of the film"),
    ("clearance", "m", "radial clearance"),
    ("viscosity", "Pa.s", "dynamic viscosity of the lubricant"),
)


def damper_spec(damper: PorousDamper) -> NativeSpec | None:
    """Return the kernel of a damper; None if its film is no map.

    What the map holds for is fixed: the ratios L/D of a film of finite length, H/L and A H/C^3 of a cage.
    """
    film = damper.bound_film
    if not isinstance(film, MappedSqueezeFilm):
        return None
    held = {"radius", "length"} if film.one_slenderness else set()
    if damper.cage is not None:
        held |= {"length", "clearance"}
    parameters = [
        _dimension(name, unit, text, float(getattr(damper, name)), fixed=name in held)
        for name, unit, text in _DIMENSIONS
    ]
    spring = NativeParameter(
        name=SPRING,
        unit="N/m",
        value=0.0,
        tunable=True,
        minimum=0.0,
        nominal=damper.nominal_force / damper.clearance,
        description="of the retainer springs along either axis, whose force is part of the output",
    )
    return NativeSpec(
        kernel=KERNEL,
        parameters=(*parameters, spring),
        tables=film.native_tables(),
        inputs=MOTION_NAMES,
    )


def sprung_spec(spec: NativeSpec | None, stiffness: float) -> NativeSpec | None:
    """Return the kernel of a damper with more springs [N/m] beside it; None if it is no damper."""
    if spec is None or spec.kernel != KERNEL:
        return None
    return replace(
        spec,
        parameters=tuple(
            replace(p, value=p.value + stiffness, nominal=stiffness) if p.name == SPRING else p
            for p in spec.parameters
        ),
    )


def _dimension(name: str, unit: str, text: str, value: float, *, fixed: bool) -> NativeParameter:
    return NativeParameter(
        name=name,
        unit=unit,
        value=value,
        tunable=not fixed,
        minimum=value if fixed else 0.0,
        maximum=value if fixed else math.inf,
        nominal=value,
        description=f"{text}; fixed, as the map of the film holds for it" if fixed else text,
    )
