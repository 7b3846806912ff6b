"""Scenes with a journal bearing in pads, or with grooves under supply pressure: static questions."""

from __future__ import annotations

import math
from dataclasses import replace
from typing import Any

import numpy as np

from rotorfilm import Groove, Pad
from rotorfilm.analysis import equilibrium
from rotorfilm.bearings.journal import JournalBearing, ReynoldsFilm
from rotorfilm.scenes import Scene
from rotorfilm.scenes.film_rungs import extrapolated, tangent

from .conserved_truth import by_conserved_oil
from .drawn import Drawn, Truth, log_uniform
from .journals import POSITIONS, REFERENCE, SLOPES, journal

COMPANION = (384, 16)
"""Cells of the grid beside the reference, whose distance is the reference's own error at most."""


def fed(random: np.random.Generator) -> Drawn:
    """Return a static question about a bearing with one or two grooves under supply pressure."""
    table, _ = journal(random, (0.1, 1.5))
    first, width = float(random.uniform(0.0, 2.0 * math.pi)), math.radians(float(random.uniform(8.0, 45.0)))
    count = int(random.integers(1, 3))
    table["grooves"] = [{"center": first + math.pi * k, "width": width} for k in range(count)]
    table["supply_pressure"] = log_uniform(random, 2e4, 5e5)
    return _scene(random, "fed", table)


def pads(random: np.random.Generator) -> Drawn:
    """Return a static question about a bearing of one to five pads at ambient pressure."""
    table, _ = journal(random, (0.2, 1.2))
    count = int(random.integers(1, 6))
    pitch = 2.0 * math.pi / count
    extent = math.radians(float(random.uniform(80.0, 300.0))) if count == 1 else None
    extent = extent or pitch * float(random.uniform(0.6, 0.95))
    first = float(random.uniform(0.0, 2.0 * math.pi))
    table["pads"] = [{"start": (first + pitch * k) % (2.0 * math.pi), "extent": extent} for k in range(count)]
    return replace(_scene(random, "pads", table), reference=by_conserved_oil)


def _scene(random: np.random.Generator, family: str, table: dict[str, Any]) -> Drawn:
    """Return a scene whose load is what the film carries somewhere in the clearance, in either sense."""
    speed = log_uniform(random, 30.0, 600.0) * float(random.choice([-1.0, 1.0]))
    bearing, force_on = _bearing(table), None
    while force_on is None:
        ratio, angle = float(random.uniform(0.1, 0.85)), float(random.uniform(0.0, 2.0 * math.pi))
        position = ratio * bearing.clearance * np.array([math.cos(angle), math.sin(angle)])
        force = bearing.force(position, [0.0, 0.0], speed)
        mean = float(np.hypot(*force)) / (2.0 * bearing.radius * bearing.length)
        force_on = force if mean > 1e3 and float(force @ position) < 0.0 else None
    question = {
        "quantity": str(random.choice([*POSITIONS, *SLOPES])),
        "tolerance": log_uniform(random, 3e-4, 0.1),
    }
    operation = {"speed": speed, "load": [float(-force_on[0]), float(-force_on[1])]}
    data = {"schema": 1, "journal": table, "operation": operation, "question": question}
    return Drawn(family, data, by_two_grids)


def _bearing(table: dict[str, Any]) -> JournalBearing:
    """Return the bearing of a table on a grid, for its load only."""
    sizes = {key: table[key] for key in ("radius", "length", "clearance", "viscosity")}
    return JournalBearing(
        **sizes,
        grooves=tuple(Groove(**groove) for groove in table.get("grooves", ())),
        pads=tuple(Pad(**pad) for pad in table.get("pads", ())),
        supply_pressure=table.get("supply_pressure", 0.0),
        film=ReynoldsFilm(cells=(96, 8)),
    )


def by_two_grids(scene: Scene) -> Truth:
    """Return a static quantity by the finest grid, and its distance from the grid of half the cells."""
    assert scene.question is not None
    quantity = scene.question.quantity
    fine, coarse = (_value(scene, quantity, cells) for cells in (REFERENCE, COMPANION))
    scale = 1.0 if quantity == "attitude_angle" else float(np.max(np.abs(fine)))
    return Truth(fine, max(float(np.max(np.abs(fine - coarse))) / scale, 5e-6))


def _value(scene: Scene, quantity: str, cells: tuple[int, int]) -> Any:
    bearing = extrapolated(scene.bearing, cells)
    at = equilibrium(bearing, scene.static_load, scene.speed)
    if quantity in SLOPES:
        slopes = tangent(bearing, at.position, scene.speed, smooth=True)[1]
        return -slopes[:, :2] if quantity == "stiffness" else -slopes[:, 2:]
    values = {
        "eccentricity_ratio": at.eccentricity_ratio,
        "minimum_film": at.minimum_film,
        "attitude_angle": at.attitude_angle,
    }
    return np.asarray(values[quantity])
