"""Scenes with a squeeze-film damper: orbits, jumps, lost blades and run-ups."""

from __future__ import annotations

import math
from dataclasses import replace
from typing import Any

import numpy as np
from scipy.integrate import DOP853
from scipy.optimize import brentq

from rotorfilm import ContactError, Reaction, with_springs
from rotorfilm.analysis import simulate, synchronous_orbits
from rotorfilm.analysis.circular_orbits import orbit_points, orbit_rotor
from rotorfilm.bearings.damper import FiniteMapSqueeze, FiniteSqueeze, PorousDamper
from rotorfilm.bearings.damper.questions import damper_ladder
from rotorfilm.bearings.damper.table import damper_models
from rotorfilm.rotors import RigidRotor
from rotorfilm.scenes import Scene

from .drawn import Drawn, Truth, log_uniform

NOWHERE = 1e-30
"""Truth of a question that has no answer: any number is wrong."""


def damper(random: np.random.Generator) -> Drawn:
    """Return an orbit in a damper with a full film, a third of them with a porous cage."""
    table = slim(random)
    table["extent"] = {"kind": "full"}
    if random.random() < 1.0 / 3.0:
        permeability = log_uniform(random, 1e-16, 1e-12)
        table["cage"] = {"thickness": 0.05 * table["radius"], "permeability": permeability}
    data = {
        **turned(random, table),
        "question": {
            "quantity": str(random.choice(["transmissibility", "unbalance_amplitude"])),
            "tolerance": log_uniform(random, 3e-3, 0.1),
        },
    }
    return Drawn("damper", data, damper_by_finite_film)


def slim(random: np.random.Generator) -> dict[str, Any]:
    """Return a damper so short that the short film is not far off."""
    radius = log_uniform(random, 0.02, 0.1)
    return {
        "radius": radius,
        "length": 2.0 * radius * log_uniform(random, 0.1, 0.4),
        "clearance": radius * log_uniform(random, 1e-3, 3e-3),
        "viscosity": log_uniform(random, 3e-3, 0.05),
    }


def turned(random: np.random.Generator, table: dict[str, Any]) -> dict[str, Any]:
    """Return a scene of a damper, to which it adds springs, and of a rotor with unbalance."""
    mass, speed = log_uniform(random, 5.0, 50.0), log_uniform(random, 100.0, 800.0)
    table["stiffness"] = mass * (speed / float(random.uniform(0.5, 3.0))) ** 2
    size = float(random.uniform(0.05, 0.6)) * mass * table["clearance"]
    return {
        "schema": 1,
        "damper": table,
        "operation": {"speed": speed},
        "rigid_rotor": {"mass": mass, "unbalance": size},
    }


def damper_by_finite_film(scene: Scene) -> Truth:
    """Return a quantity of the smallest orbit in the film of finite length, by bisection in its radius."""
    ladder = damper_ladder(scene, scene.question.quantity)
    top, short = ladder.rungs[-1], ladder.rungs[0]
    system = orbit_rotor(top.rotor, top.support)
    near = float(short.answer(None).solution)

    def excess(radius: float) -> float:
        pull, _ = orbit_points(system, np.array([radius]))
        return abs(pull[0]) / system.speed**2 - top.rotor.unbalance

    radius = brentq(excess, 0.7 * near, min(1.3 * near, 0.5 * (1.0 + near)), xtol=1e-9)
    pull, force = orbit_points(system, np.array([radius]))
    ratio = float(np.abs(force[0]) / np.abs(pull[0]))
    return Truth(ratio if scene.question.quantity == "transmissibility" else radius * system.clearance, 1e-6)


def squeeze(random: np.random.Generator, numbers: tuple[float, float]) -> tuple[dict[str, Any], float, float]:
    """Return a damper, and speed and mass of its rotor, for squeeze numbers mu R L^3/(m w C^3) in a range."""
    while True:
        radius, speed = log_uniform(random, 0.02, 0.1), log_uniform(random, 100.0, 1000.0)
        length = 2.0 * radius * log_uniform(random, 0.08, 0.6)
        clearance = radius * log_uniform(random, 8e-4, 3e-3)
        viscosity, number = log_uniform(random, 1e-3, 0.05), log_uniform(random, *numbers)
        mass = viscosity * radius * length**3 / (number * speed * clearance**3)
        if 1.0 < mass < 500.0:
            break
    table: dict[str, Any] = {
        "radius": radius,
        "length": length,
        "clearance": clearance,
        "viscosity": viscosity,
    }
    if random.random() < 0.6:
        table["cage"] = cage(random, table)
    return table, speed, mass


def cage(random: np.random.Generator, table: dict[str, Any]) -> dict[str, Any]:
    """Return a porous cage whose permeability number A H/C^3 is 1e-4 to .1."""
    thickness = table["length"] * log_uniform(random, 0.03, 0.3)
    permeability = log_uniform(random, 1e-4, 0.1) * table["clearance"] ** 3 / thickness
    made: dict[str, Any] = {"thickness": thickness, "permeability": permeability}
    kind = random.random()
    if kind < 0.3:
        made["grading"] = float(random.uniform(-1.0, 2.0))
    elif kind < 0.45:
        made["vented"] = True
    elif kind < 0.6:
        made["thin"] = True
    elif kind < 0.7:
        made["anisotropy"] = log_uniform(random, 0.3, 3.0)
    return made


def named(random: np.random.Generator, table: dict[str, Any]) -> None:
    """Name the film of every fourth damper."""
    if random.random() < 0.25:
        table["film"] = {"name": str(random.choice(["short", "map", "finite_map"]))}


def jumps(random: np.random.Generator) -> Drawn:
    """Return a jump of a rotor in a damper, most of them cavitated; some do not jump at all."""
    table, speed, mass = squeeze(random, (0.015, 0.2))
    if random.random() < 0.15:
        table["extent"] = {"kind": "full"}
    named(random, table)
    table["stiffness"] = mass * (speed * float(random.uniform(0.0, 0.7))) ** 2
    question = {"quantity": str(random.choice(["jump_up", "jump_down"]))}
    data = {
        "schema": 1,
        "damper": table,
        "operation": {"speed": speed},
        "rigid_rotor": {"mass": mass},
        "question": {**question, "tolerance": log_uniform(random, 3e-3, 0.2)},
    }
    return Drawn("damper jumps", data, jump_by_finite_film)


def jump_by_finite_film(scene: Scene) -> Truth:
    """Return a jump among all orbits in the film of finite length; nowhere if there is none."""
    rotor = RigidRotor(mass=scene.rigid_rotor.mass, speed=scene.speed, unbalance=1e-9, gravity=(0.0, 0.0))
    found = synchronous_orbits(rotor, finite(scene))
    upward = scene.question.quantity == "jump_up"
    values = [fold.unbalance for fold in found.folds if fold.upward == upward]
    return Truth(values[0] if values else NOWHERE, 1e-6)


def finite(scene: Scene) -> Reaction:
    """Return film and springs of a scene, the film of finite length."""
    damper: PorousDamper = scene.damper.build()
    law = FiniteMapSqueeze() if damper.feed is None else FiniteSqueeze()
    film = replace(damper, film=law)
    return with_springs(film, scene.damper.stiffness) if scene.damper.stiffness else film


def lost_blade(random: np.random.Generator) -> Drawn:
    """Return the peak after a blade is lost, every fourth time over a run-up, some beyond the wall."""
    table, speed, mass = squeeze(random, (0.03, 3.0))
    kind = random.random()
    if kind < 0.35:
        table["extent"] = {"kind": "full"}
    if kind < 0.04:
        table["feed"] = {"kind": "radial", "inflow": 0.1 * speed * table["clearance"]}
        if table.get("cage", {}).get("vented"):
            del table["cage"]
    else:
        named(random, table)
    table["stiffness"] = mass * (speed * float(random.uniform(0.1, 1.5))) ** 2
    shaken: dict[str, Any] = {"unbalance": log_uniform(random, 0.02, 0.8) * mass * table["clearance"]}
    if kind >= 0.04 and random.random() < 0.25:
        turns, speed, end = float(random.uniform(15.0, 40.0)), 0.6 * speed, speed
        shaken |= {"kind": "run_up", "end_speed": end, "duration": turns * 4.0 * math.pi / (speed + end)}
    else:
        shaken |= {"kind": "blade_loss", "revolutions": 3.0 if "feed" in table else 6.0}
    data = {
        "schema": 1,
        "damper": table,
        "operation": {"speed": speed},
        "rigid_rotor": {"mass": mass},
        "excitation": shaken,
        "question": {"quantity": "peak_displacement", "tolerance": log_uniform(random, 3e-3, 0.2)},
    }
    return Drawn("damper blade loss", data, peak_by_finite_film)


def peak_by_finite_film(scene: Scene) -> Truth:
    """Return the largest distance in the film of finite length by Dormand and Prince's steps of order 8."""
    models, support = damper_models(scene), finite(scene)
    fastest = max(abs(speed) for speed in models.rotor.profile.speeds)
    times = np.linspace(0.0, models.duration, math.ceil(models.duration * fastest / 0.01))
    fed = scene.damper.feed is not None
    try:
        run = simulate(
            models.rotor,
            support,
            duration=models.duration,
            times=times,
            rtol=1e-6 if fed else 1e-9,
            max_step=0.3 / fastest,
            method=DOP853,
        )
    except ContactError:
        return Truth(NOWHERE, 1e-6)
    return Truth(float(np.hypot(*run.position).max()), 3e-5)
