"""Scenes with a squeeze-film damper: orbits."""

from __future__ import annotations

from typing import Any

import numpy as np
from scipy.optimize import brentq

from rotorfilm.orbits.curve import orbit_points, orbit_rotor
from rotorfilm.scenes import Scene
from rotorfilm.scenes.questions.dampers import damper_ladder

from .drawn import Drawn, Truth, log_uniform


def damper(random: np.random.Generator) -> Drawn:
    """Return an orbit in a damper with a full film, a third of them with a porous cage."""
    radius = log_uniform(random, 0.02, 0.1)
    table: dict[str, Any] = {
        "radius": radius,
        "length": 2.0 * radius * log_uniform(random, 0.1, 0.4),
        "clearance": radius * log_uniform(random, 1e-3, 3e-3),
        "viscosity": log_uniform(random, 3e-3, 0.05),
        "extent": {"kind": "full"},
    }
    if random.random() < 1.0 / 3.0:
        permeability = log_uniform(random, 1e-16, 1e-12)
        table["cage"] = {"thickness": 0.05 * radius, "permeability": permeability}
    mass, speed = log_uniform(random, 5.0, 50.0), log_uniform(random, 100.0, 800.0)
    table["stiffness"] = mass * (speed / float(random.uniform(0.5, 3.0))) ** 2
    size = float(random.uniform(0.05, 0.6)) * mass * table["clearance"]
    return Drawn(
        "damper",
        {
            "schema": 1,
            "damper": table,
            "operation": {"speed": speed},
            "rigid_rotor": {"mass": mass, "unbalance": size},
            "question": {
                "quantity": str(random.choice(["transmissibility", "unbalance_amplitude"])),
                "tolerance": log_uniform(random, 3e-3, 0.1),
            },
        },
        damper_by_finite_film,
    )


def damper_by_finite_film(scene: Scene) -> Truth:
    """Return a quantity of the smallest orbit in the film of finite length, by bisection in its radius."""
    ladder = damper_ladder(scene, scene.question.quantity)
    top, short = ladder.rungs[-1], ladder.rungs[0]
    system = orbit_rotor(top.rotor, top.support)
    near = float(short.answer(None).solution)

    def excess(radius: float) -> float:
        pull = orbit_points(system, np.array([radius])).pull[0]
        return abs(pull) / system.speed**2 - top.rotor.unbalance

    radius = brentq(excess, 0.7 * near, min(1.3 * near, 0.5 * (1.0 + near)), xtol=1e-9)
    points = orbit_points(system, np.array([radius]))
    ratio = float(np.abs(points.force[0]) / np.abs(points.pull[0]))
    return Truth(ratio if scene.question.quantity == "transmissibility" else radius * system.clearance, 1e-6)
