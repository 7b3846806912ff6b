"""The kernel of the C library that is a squeeze-film damper over a map, with or without retainer springs."""

from __future__ import annotations

import math
from collections.abc import Mapping

from ...native.spec import NativeParameter, NativeSpec
from ...signals import MOTION_NAMES
from .full_squeeze import SqueezeFilm
from .mapped_squeeze import MappedSqueezeFilm

KERNEL = "damper"

DIMENSIONS = (
    ("radius", "m", "radius of the film"),
    ("length", "m", "axial length of the film"),
    ("clearance", "m", "radial clearance"),
    ("viscosity", "Pa.s", "dynamic viscosity of the lubricant"),
)


def damper_spec(
    film: SqueezeFilm, dimensions: Mapping[str, float], *, caged: bool, nominal_force: float
) -> NativeSpec | None:
    """Return the kernel of a damper; None if its film is no map.

    What the map holds for is fixed: the ratios L/D of a film of finite length, H/L and A H/C^3 of a cage.

    Parameters
    ----------
    film : SqueezeFilm
    dimensions : mapping of str to float
        Radius, length, clearance [m] and viscosity [Pa s].
    caged : bool
        Whether it has a porous cage.
    nominal_force : float [N]
    """
    if not isinstance(film, MappedSqueezeFilm):
        return None
    held = {"radius", "length"} if film.one_slenderness else set()
    if caged:
        held |= {"length", "clearance"}
    parameters = [
        dimension(name, unit, text, float(dimensions[name]), fixed=name in held)
        for name, unit, text in DIMENSIONS
    ]
    spring = spring_parameter(nominal_force / dimensions["clearance"])
    return NativeSpec(
        kernel=KERNEL,
        parameters=(*parameters, spring),
        tables=film.native_tables(),
        inputs=MOTION_NAMES,
        spring="stiffness",
    )


def spring_parameter(nominal: float) -> NativeParameter:
    """Return the stiffness of springs, none yet, of a nominal value [N/m]."""
    return NativeParameter(
        name="stiffness",
        unit="N/m",
        value=0.0,
        tunable=True,
        minimum=0.0,
        nominal=nominal,
        description="of the retainer springs along either axis, whose force is part of the output",
    )


def dimension(name: str, unit: str, text: str, value: float, *, fixed: bool) -> NativeParameter:
    """Return a dimension, which the map of the film may hold for only."""
    reason = ", as the map of the film holds for it"
    return bounded(name, unit, text, value, fixed=fixed, reason=reason)


def bounded(
    name: str, unit: str, text: str, value: float, *, fixed: bool, reason: str = ""
) -> NativeParameter:
    """Return a number that is not negative, or fixed for a reason."""
    return NativeParameter(
        name=name,
        unit=unit,
        value=value,
        tunable=not fixed,
        minimum=value if fixed else 0.0,
        maximum=value if fixed else math.inf,
        nominal=math.nextafter(0.0, 1.0) if value == 0.0 else value,
        description=f"{text}; fixed{reason}" if fixed else text,
    )
