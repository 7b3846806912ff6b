"""Scenes with a journal bearing and its supply: grooves of a length, holes, static questions.

Judged by the film that conserves its oil, on cells finer than any rung has: Reynolds rupture answers where
its estimate says so, and that counts what the conservation of the oil would change.
"""

from __future__ import annotations

import math
from typing import Any

import numpy as np

from rotorfilm import FeedHole, Groove
from rotorfilm.bearings.journal import JFOFilm, JournalBearing

from .conserved_truth import by_conserved_oil
from .drawn import Drawn, log_uniform
from .journals import POSITIONS, SLOPES, journal

QUANTITIES = (*POSITIONS, *SLOPES, "side_flow", "power_loss")


def supplied(random: np.random.Generator) -> Drawn:
    """Return a static question about a bearing with grooves or holes, at ambient pressure or fed."""
    table, _ = journal(random, (0.2, 1.2))
    _open(random, table)
    if random.random() < 0.7:
        table["supply_pressure"] = log_uniform(random, 2e4, 1e6)
    speed = log_uniform(random, 50.0, 600.0) * float(random.choice([-1.0, 1.0]))
    question = {"quantity": str(random.choice(QUANTITIES)), "tolerance": log_uniform(random, 3e-3, 0.3)}
    operation = {"speed": speed, "load": _load(random, table, speed)}
    data = {"schema": 1, "journal": table, "operation": operation, "question": question}
    return Drawn("supplied", data, by_conserved_oil)


def _open(random: np.random.Generator, table: dict[str, Any]) -> None:
    """Add one to three grooves of a length, or one or two holes."""
    first, kind = float(random.uniform(0.0, 2.0 * math.pi)), float(random.random())
    if kind < 0.25:
        widest = 0.4 * min(table["length"], table["radius"])
        size, count = widest * float(random.uniform(0.3, 1.0)), int(random.integers(1, 3))
        table["feed_holes"] = [{"center": first + math.pi * k, "diameter": size} for k in range(count)]
        return
    count, width = int(random.integers(1, 4)), math.radians(float(random.uniform(8.0, 50.0)))
    length = table["length"] * float(random.uniform(0.3, 0.9))
    pitch = 2.0 * math.pi / count
    table["grooves"] = [{"center": first + pitch * k, "width": width, "length": length} for k in range(count)]


def _load(random: np.random.Generator, table: dict[str, Any], speed: float) -> list[float]:
    """Return a load that the film carries somewhere in the clearance."""
    film = JFOFilm(bearing=_bearing(table), cells=(72, 6), submerged=True)
    while True:
        ratio, angle = float(random.uniform(0.1, 0.85)), float(random.uniform(0.0, 2.0 * math.pi))
        position = ratio * film.clearance * np.array([math.cos(angle), math.sin(angle)])
        force = film.force(position, [0.0, 0.0], speed)
        mean = float(np.hypot(*force)) / (2.0 * table["radius"] * table["length"])
        if mean > 1e4 and float(force @ position) < 0.0:
            return [float(-force[0]), float(-force[1])]


def _bearing(table: dict[str, Any]) -> JournalBearing:
    """Return the bearing of a table, for its load only."""
    sizes = {key: table[key] for key in ("radius", "length", "clearance", "viscosity")}
    openings = [Groove(**one) for one in table.get("grooves", ())]
    holes = [FeedHole(**one) for one in table.get("feed_holes", ())]
    supply = table.get("supply_pressure", 0.0)
    return JournalBearing(**sizes, grooves=(*openings, *holes), supply_pressure=supply)
