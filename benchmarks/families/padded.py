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
from typing import Any

import numpy as np

from .drawn import log_uniform
from .journals import POSITIONS, SLOPES

SETS = ("elliptical", "three_lobe", "four_lobe", "offset_halves", "tapered_land")
WAY = (0.1, 0.85)
"""Of a journal towards contact."""

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
