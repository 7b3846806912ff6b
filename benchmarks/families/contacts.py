"""Scenes with a rolling ball: film and approach at rest, and under a load that jumps or swings."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
from scipy.interpolate import CubicSpline

from rotorfilm import ConvergenceError, InputError
from rotorfilm.bearings.contact import ContactGrid, FixedSteps, RollingBall, SineLoad
from rotorfilm.bearings.contact.table import DrivenBall, contact_motion
from rotorfilm.scenes import Scene, read_scene

from .drawn import Drawn, Truth, log_uniform

QUANTITIES = ("central_film", "minimum_film", "approach")
SPEED_PARAMETERS, VISCOSITY_PARAMETERS = (0.008, 0.4), (2.0, 18.0)
STEEL = 206e9

GRIDS = {2.5: 2.0, 4.5: 3.0, 8.5: 5.0}
"""Half the width of the rectangle by the length of its inlet, in Hertzian radii."""

FAR = {"approach": 1.0, "central_film": 3.0, "minimum_film": 3.0}
"""Power of the length with which what lies outside of the rectangle loses its effect."""


def ball(random: np.random.Generator) -> dict[str, Any]:
    """Return a `[contact]` whose film the package can solve: V from .008 to .4, Q0 from 2 to 18."""
    while True:
        table = _ball(random)
        try:
            scene = read_scene({"schema": 1, "contact": table}, "ball")
        except InputError:
            continue  # no Roelands law for this oil
        made = scene.contact.build()
        inside = SPEED_PARAMETERS[0] <= made.V <= SPEED_PARAMETERS[1]
        if inside and VISCOSITY_PARAMETERS[0] <= made.Q0 <= VISCOSITY_PARAMETERS[1]:
            return table


def _ball(random: np.random.Generator) -> dict[str, Any]:
    table: dict[str, Any] = {
        "radius": log_uniform(random, 3e-3, 15e-3),
        "modulus": STEEL,
        "poisson_ratio": 0.3,
        "viscosity": log_uniform(random, 5e-3, 0.1),
        "pressure_coefficient": log_uniform(random, 5e-9, 2.2e-8),
        "speed": log_uniform(random, 0.1, 5.0),
        "roelands": bool(random.random() < 1.0 / 3.0),
        "compressible": bool(random.random() < 0.25),
    }
    if random.random() < 0.5:
        table["plane_modulus"] = STEEL
    pressure = log_uniform(random, 0.4e9, 1.4e9)
    compliance = (1.0 - 0.09) / STEEL * (2.0 if "plane_modulus" in table else 1.0)
    modulus = 2.0 / compliance
    contact_radius = math.pi * pressure * table["radius"] / modulus
    table["load"] = 2.0 * math.pi * pressure * contact_radius**2 / 3.0
    return table


def rest(random: np.random.Generator) -> Drawn:
    """Return a question about a ball under its static load."""
    table = ball(random)
    return Drawn("contact", _asked(random, table, (1e-3, 0.1)), at_rest)


def motion(random: np.random.Generator) -> Drawn:
    """Return a question about a ball under a load that jumps, is there for a while, or swings."""
    table = ball(random)
    made = read_scene({"schema": 1, "contact": table}, "ball").contact.build()
    inertia = log_uniform(random, 0.2, 5.0)
    table["mass"] = inertia * 3.0 * made.load * made.radius / (math.pi * made.speed**2)
    data = _asked(random, table, (5e-3, 0.2))
    if random.random() < 0.5:
        share = float(random.uniform(0.1, 1.0) if random.random() < 0.7 else random.uniform(-0.7, -0.1))
        data["excitation"] = {"kind": "step", "load": [0.0, -share * made.load]}
        if random.random() < 0.5:
            data["excitation"]["end"] = float(random.uniform(1.0, 8.0)) * made.time_scale
    else:
        data["excitation"] = {
            "kind": "sine",
            "load": float(random.uniform(0.1, 0.6)) * made.load,
            "frequency": log_uniform(random, 0.05, 4.0) / made.time_scale,
        }
    return Drawn("contact motion", data, in_motion)


def _asked(
    random: np.random.Generator, table: dict[str, Any], tolerance: tuple[float, float]
) -> dict[str, Any]:
    quantity = str(random.choice(QUANTITIES))
    question = {"quantity": quantity, "tolerance": log_uniform(random, *tolerance)}
    return {"schema": 1, "contact": table, "question": question}


def at_rest(scene: Scene) -> Truth:
    """Return a film on 144 x 144 cells, extrapolated to none and to an infinite rectangle."""
    fine, coarse, wide = (
        _resting(scene, inlet, cells) for inlet, cells in ((4.5, 144), (4.5, 96), (8.5, 160))
    )
    power = FAR[scene.question.quantity]
    cells = (fine - coarse) / (1.5**2 - 1.0)
    reach = (wide - coarse) / (1.0 - (4.5 / 8.5) ** power)
    value = fine + cells + reach
    return Truth(value, (0.3 * abs(cells) + 0.1 * abs(reach)) / abs(value))


def in_motion(scene: Scene) -> Truth:
    """Return a motion of the full film, extrapolated to no cells, no steps and an infinite rectangle.

    The last two on coarse grids, where there is a motion.
    """
    value = _moving(scene, 2.5, 32, 24)
    cells = (_moving(scene, 2.5, 56, 24) - value) / (1.0 - (32.0 / 56.0) ** 2)
    try:
        steps, reach = _steps_and_reach(scene, 24)
    except ConvergenceError:
        steps, reach = _steps_and_reach(scene, 32)
    parts = cells, steps, reach
    value += sum(parts)
    return Truth(value, 0.1 * sum(abs(part) for part in parts) / abs(value))


def _steps_and_reach(scene: Scene, cells: int) -> tuple[float, float]:
    plain = _moving(scene, 2.5, cells, 24)
    steps = _moving(scene, 2.5, cells, 72) - plain
    reach = _moving(scene, 4.5, 3 * cells // 2, 24) - plain
    power = FAR[scene.question.quantity]
    return steps / (1.0 - (24.0 / 72.0) ** 2), reach / (1.0 - (2.5 / 4.5) ** power)


def _grid(inlet: float, cells: int) -> ContactGrid:
    return ContactGrid(cells=(cells, cells), inlet=-inlet, half_width=GRIDS[inlet])


def _contact(scene: Scene, inlet: float, cells: int) -> tuple[RollingBall, Any]:
    table = scene.contact
    made = table.build()
    contact = made.contact(_grid(inlet, cells), roelands=table.roelands, compressible=table.compressible)
    return made, contact


def _resting(scene: Scene, inlet: float, cells: int) -> float:
    made, contact = _contact(scene, inlet, cells)
    state = contact.stationary()
    name = "delta" if scene.question.quantity == "approach" else scene.question.quantity
    return made.film_scale * float(getattr(state, name))


def _moving(scene: Scene, inlet: float, cells: int, steps: int) -> float:
    """Return the extreme over the motion that the question means (`bearings.contact.table`)."""
    made, contact = _contact(scene, inlet, cells)
    shaken = contact_motion(scene)
    run = contact.simulate(
        contact.stationary(),
        duration=shaken.duration,
        W=made.W,
        load=shaken.load,
        control=FixedSteps(step=min(0.25, _period(shaken, made.W) / steps), tolerance=1e-6),
    )
    name = "delta" if scene.question.quantity == "approach" else scene.question.quantity
    spline = CubicSpline(run.time, getattr(run, name))
    return made.film_scale * float(np.min(spline(np.linspace(0.0, run.time[-1], 20001))))


def _period(shaken: DrivenBall, inertia: float) -> float:
    """Return the shortest period of a ball on the dry contact, or of its load."""
    natural = 2.0 * math.pi * math.sqrt(inertia / (0.5 * math.pi))
    forced = 2.0 * math.pi / shaken.load.frequency if isinstance(shaken.load, SineLoad) else math.inf
    return min(natural, forced)
