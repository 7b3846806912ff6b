"""Scenes with a polymer bush: the speed at which it melts, and how far it wears."""

from __future__ import annotations

import math
from typing import Any

import numpy as np

from rotorfilm.scenes import read_scene

from .bush_truth import speed_by_volumes, wear_by_nodes
from .drawn import Drawn, log_uniform

LEAST_MELTING_SPEED = 0.5
LARGEST_MELTING_SPEED = 4.0
"""Of the run over the critical speed of the unworn bush."""


def bush_table(random: np.random.Generator) -> dict[str, Any]:
    """Return a bush with data about those of the source, which are in the middle of most ranges."""
    radius = log_uniform(random, 5e-3, 50e-3)
    outer = radius * (1.0 + float(random.uniform(0.05, 0.2)))
    nu, expansion = float(random.uniform(0.3, 0.45)), log_uniform(random, 4e-5, 1.5e-4)
    melting = float(random.uniform(150.0, 300.0))
    closing = math.log(outer / radius) * expansion * (1.0 + nu) / (1.0 - nu) * melting
    table: dict[str, Any] = {
        "melting_heat": log_uniform(random, 5e7, 3e8),
        "radius": radius,
        "outer_radius": outer,
        "shaft_radius": radius * (1.0 - closing - log_uniform(random, 5e-3, 4e-2)),
        "length": radius * log_uniform(random, 1.0, 10.0),
        "shear_modulus": log_uniform(random, 1e8, 1e9),
        "poisson_ratio": nu,
        "expansion": expansion,
        "melting_point": melting,
        "liner_conductivity": log_uniform(random, 0.2, 0.6),
        "shaft_conductivity": log_uniform(random, 15.0, 60.0),
        "air_transfer": log_uniform(random, 30.0, 500.0),
        "friction": log_uniform(random, 0.05, 0.3),
        "outer_mean": melting * float(random.uniform(0.1, 0.95)),
    }
    table["outer_swing"] = float(random.uniform(0.0, 0.5)) * (melting - table["outer_mean"])
    if random.random() < 0.2:
        table["friction"] = [table["friction"], -0.3 * table["friction"] / melting]
    if random.random() < 0.2:
        table["balance"] = "global"
    return table


def load_of(random: np.random.Generator, table: dict[str, Any]) -> float:
    """Return a load [N] of 1e-3 to 1.5e-2 of the shear modulus on shaft radius and length."""
    unit = table["shear_modulus"] * table["shaft_radius"] * table["length"]
    return unit * log_uniform(random, 1e-3, 1.5e-2)


def bush_speed(random: np.random.Generator) -> Drawn:
    """Return a bush whose critical speed is asked for."""
    table = bush_table(random)
    data = {
        "schema": 1,
        "bush": table,
        "operation": {"speed": 10.0, "load": load_of(random, table)},
        "question": {"quantity": "critical_speed", "tolerance": log_uniform(random, 1e-5, 0.1)},
    }
    return Drawn("bush speed", data, speed_by_volumes)


def bush_wear(random: np.random.Generator) -> Drawn:
    """Return a bush that runs below its critical speed or wears, in part under a load that changes."""
    table = bush_table(random)
    load = load_of(random, table)
    if random.random() < 0.35:
        table["melting"] = "local"
    f0 = float(np.atleast_1d(table["friction"])[0])
    speed = unworn_speed(table, load) * log_uniform(random, LEAST_MELTING_SPEED, LARGEST_MELTING_SPEED)
    compliance = math.log(table["outer_radius"] / table["radius"]) * (1.0 - 2.0 * table["poisson_ratio"])
    compliance /= 2.0 * (1.0 - table["poisson_ratio"])
    work = table["shear_modulus"] * table["shaft_radius"] * f0 * speed
    time = compliance * table["melting_heat"] * table["radius"] / work
    duration = time * log_uniform(random, 0.3, 100.0)
    data: dict[str, Any] = {
        "schema": 1,
        "bush": table,
        "operation": {"speed": speed, "load": load, "duration": duration},
        "question": {"quantity": "wear", "tolerance": log_uniform(random, 1e-4, 0.2)},
    }
    kind = random.random()
    if kind < 0.25:
        change = float(random.uniform(0.1, 0.5) if kind < 0.15 else -random.uniform(0.1, 0.7))
        start = duration * float(random.uniform(0.1, 0.7))
        data["excitation"] = {"kind": "step", "load": [0.0, -change * load], "start": start}
    return Drawn("bush wear", data, wear_by_nodes)


def unworn_speed(table: dict[str, Any], load: float) -> float:
    """Return the critical speed of the unworn bush [rad/s]."""
    scene = read_scene({"schema": 1, "bush": table, "operation": {"speed": 1.0, "load": load}}, "drawn")
    assert scene.bush is not None
    return float(scene.bush.build().critical_speed(load))
