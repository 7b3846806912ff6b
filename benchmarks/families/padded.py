"""Scenes with bearings made of pads: lobes, pressure dams, tilting pads; static questions.

The ranges, with uniform (U) and log-uniform (L) numbers: radius L 10-200 mm, length/diameter L .25-1.2,
assembled clearance/radius L 8e-4-3e-3, viscosity L 5-100 mPa s, speed L 30-600 rad/s, tolerance L 3e-4-.1,
quantity even among those of a journal at rest.

- lobes: one of the five usual sets, extent U .85-1 of the usual, preload U 0-.7, turned U 0-2 pi, either
  sense of speed, load that of a journal at U .1-.85 of the way to contact in a direction U 0-2 pi.
- dam: depth/clearance L .3-4, step U 90-160 deg, share U .5-.9, groove U 10-30 deg, in a third of them a
  preload U 0-.5, in a third a track of depth/clearance U .5-2 and share U .1-.4; the same load, less
  than 75 deg from -y.
- tilting: 3 to 6 pads on or between which the load acts, extent U .6-.85 of the pitch, offset .5 or U .5-.6,
  preload U 0-.6; load along -y of a Sommerfeld number, over the assembled clearance, L .05-2.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import replace
from typing import Any

import numpy as np

from rotorfilm import LobedBearing, PressureDamBearing, lobe_set, pressure_dam_pads
from rotorfilm.analysis import coefficients, equilibrium
from rotorfilm.bearings import SETS as USUAL
from rotorfilm.bearings.pads import PadGridFilm
from rotorfilm.scenes import Scene

from .drawn import Drawn, Truth, log_uniform
from .journals import POSITIONS, SLOPES

SETS = ("elliptical", "three_lobe", "four_lobe", "offset_halves", "tapered_land")
WAY = (0.1, 0.85)
"""Of a journal towards contact."""

CELLS, DAM_CELLS = ((288, 24), (192, 16)), ((256, 64), (192, 48))
"""Of the reference, and of the grid beside it whose distance is its own error at most."""

LEAST_MEAN = 1e3
"""Least load over the projected area [Pa]."""


def dimensions(random: np.random.Generator) -> dict[str, Any]:
    """Return journal, clearance and viscosity."""
    radius = log_uniform(random, 0.01, 0.2)
    return {
        "radius": radius,
        "length": 2.0 * radius * log_uniform(random, 0.25, 1.2),
        "assembled_clearance": radius * log_uniform(random, 8e-4, 3e-3),
        "viscosity": log_uniform(random, 5e-3, 0.1),
    }


def lobed(random: np.random.Generator) -> dict[str, Any]:
    """Return what a set of lobes is drawn from: its name, share of the usual extent, preload and turn."""
    return {
        "set": str(random.choice(SETS)),
        "share": float(random.uniform(0.85, 1.0)),
        "preload": float(random.uniform(0.0, 0.7)),
        "turned": float(random.uniform(0.0, 2.0 * math.pi)),
    }


def dammed(random: np.random.Generator, clearance: float) -> dict[str, Any]:
    """Return arguments of `pressure_dam_pads`."""
    drawn = {
        "depth": clearance * log_uniform(random, 0.3, 4.0),
        "end": math.radians(float(random.uniform(90.0, 160.0))),
        "share": float(random.uniform(0.5, 0.9)),
        "groove": math.radians(float(random.uniform(10.0, 30.0))),
    }
    kind = int(random.integers(3))
    if kind == 1:
        drawn["preload"] = float(random.uniform(0.0, 0.5))
    if kind == 2:
        drawn["track_depth"] = clearance * float(random.uniform(0.5, 2.0))
        drawn["track_share"] = float(random.uniform(0.1, 0.4))
    return drawn


def tilted(random: np.random.Generator) -> dict[str, Any]:
    """Return number of pads, whether the load is between them, extent, offset and preload."""
    count = int(random.integers(3, 7))
    centered = bool(random.integers(2))
    return {
        "count": count,
        "between": bool(random.integers(2)),
        "extent": 2.0 * math.pi / count * float(random.uniform(0.6, 0.85)),
        "pivot_offset": 0.5 if centered else float(random.uniform(0.5, 0.6)),
        "preload": float(random.uniform(0.0, 0.6)),
    }


def question(random: np.random.Generator) -> dict[str, Any]:
    """Return what is asked."""
    quantity = str(random.choice([*POSITIONS, *SLOPES]))
    return {"quantity": quantity, "tolerance": log_uniform(random, 3e-4, 0.1)}


def lobes(random: np.random.Generator) -> Drawn:
    """Return a static question about a bearing of fixed pads."""
    made, drawn = dimensions(random), lobed(random)
    speed = log_uniform(random, 30.0, 600.0) * float(random.choice([-1.0, 1.0]))
    shape = {
        "preload": drawn["preload"],
        "extent": USUAL[drawn["set"]][2] * drawn["share"],
        "turned": drawn["turned"],
    }
    pads = lobe_set(drawn["set"], **shape)
    bearing = LobedBearing(**made, lobes=pads, film=PadGridFilm(cells=(48, 4)))
    load = carried(random, bearing, speed, lambda: float(random.uniform(0.0, 2.0 * math.pi)))
    table = {**made, "preset": drawn["set"], **shape}
    return _scene(random, "lobes", {"lobed_journal": table}, speed, load)


def dam(random: np.random.Generator) -> Drawn:
    """Return a static question about a pressure dam bearing."""
    made = dimensions(random)
    shape = dammed(random, made["assembled_clearance"])
    speed = log_uniform(random, 30.0, 600.0)
    bearing = PressureDamBearing(**made, pads=pressure_dam_pads(**shape), cells=(32, 8))
    while True:
        downward = float(random.uniform(-0.5, 0.5)) * math.pi - 0.5 * math.pi
        load = carried(random, bearing, speed, lambda angle=downward: angle)
        if -load[1] > math.hypot(*load) * math.cos(math.radians(75.0)):
            return _scene(random, "dam", {"pressure_dam": {**made, **shape}}, speed, load)


def tilting(random: np.random.Generator) -> Drawn:
    """Return a static question about a bearing of tilting pads."""
    made, drawn = dimensions(random), tilted(random)
    speed = log_uniform(random, 30.0, 600.0)
    turns, c = speed / (2.0 * math.pi), made["assembled_clearance"]
    unit = made["viscosity"] * turns * made["length"] * 2.0 * made["radius"] * (made["radius"] / c) ** 2
    load = unit / log_uniform(random, 0.05, 2.0)
    table = {
        **made,
        "pad_count": drawn["count"],
        "loading": "between_pads" if drawn["between"] else "on_pad",
        **{name: drawn[name] for name in ("extent", "pivot_offset", "preload")},
    }
    return _scene(random, "tilting", {"tilting_pad": table}, speed, (0.0, -load))


def carried(
    random: np.random.Generator,
    bearing: LobedBearing | PressureDamBearing,
    speed: float,
    direction: Callable[[], float],
) -> tuple[float, float]:
    """Return the load that the film carries at a place on the way to contact, in a direction [rad]."""
    while True:
        angle, share = direction(), float(random.uniform(*WAY))
        outward = np.array([math.cos(angle), math.sin(angle)])
        near, far = 0.0, 10.0 * bearing.clearance
        for _ in range(40):
            middle = 0.5 * (near + far)
            free = float(bearing.minimum_film(middle * outward)) > 0.0
            near, far = (middle, far) if free else (near, middle)
        force = bearing.force(share * near * outward, [0.0, 0.0], speed)
        mean = float(np.hypot(*force)) / (2.0 * bearing.radius * bearing.length)
        if mean > LEAST_MEAN and float(force @ outward) < 0.0:
            return float(-force[0]), float(-force[1])


def _scene(
    random: np.random.Generator,
    family: str,
    table: dict[str, Any],
    speed: float,
    load: tuple[float, float],
) -> Drawn:
    operation = {"speed": speed, "load": list(load)}
    data = {"schema": 1, **table, "operation": operation, "question": question(random)}
    return Drawn(family, data, by_two_grids)


def by_two_grids(scene: Scene) -> Truth:
    """Return a static quantity by a grid finer than any rung, and its distance from a coarser one."""
    assert scene.question is not None
    quantity = scene.question.quantity
    fine, coarse = (_value(scene, quantity, level) for level in (0, 1))
    scale = 1.0 if quantity == "attitude_angle" else float(np.max(np.abs(fine)))
    return Truth(fine, max(float(np.max(np.abs(fine - coarse))) / scale, 5e-6))


def _value(scene: Scene, quantity: str, level: int) -> Any:
    bearing = scene.bearing
    if isinstance(bearing, PressureDamBearing):
        bearing = replace(bearing, cells=DAM_CELLS[level])
    else:
        bearing = replace(bearing, film=PadGridFilm(cells=CELLS[level]))
    at = equilibrium(bearing, scene.static_load, scene.speed)
    if quantity in SLOPES:
        return getattr(coefficients(bearing, at.position, scene.speed), quantity)
    return np.asarray(getattr(at, quantity))
