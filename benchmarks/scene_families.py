"""The families of the scene battery: where scenes are drawn from, and what each is judged by."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import Any, NamedTuple

import numpy as np
from scipy.optimize import brentq

from rotorfilm.bearings import JournalBearing
from rotorfilm.films import MapFilm, ShortFilm
from rotorfilm.linear import equilibrium, whirl_threshold
from rotorfilm.orbits.curve import orbit_points, orbit_rotor
from rotorfilm.scenes import Scene
from rotorfilm.scenes.questions.blade_loss import blade_loss_ladder
from rotorfilm.scenes.questions.coupling import coupling_ladder
from rotorfilm.scenes.questions.dampers import damper_ladder
from rotorfilm.scenes.questions.films import FilmRung, extrapolated, tangent
from rotorfilm.scenes.questions.orbits import OrbitRung, rotor_of
from rotorfilm.scenes.questions.statics import StaticRung
from rotorfilm.transient import simulate

POSITIONS = ("eccentricity_ratio", "minimum_film", "attitude_angle")
SLOPES = ("stiffness", "damping")
ORBITS = ("unbalance_amplitude", "unbalance_phase", "unbalance_force")
FIXED_FILMS: tuple[dict[str, Any], ...] = (
    {"name": "short"},
    {"name": "splitting", "order": [2, "inf"], "rupture": {"kind": "rotating"}},
    {"name": "splitting", "order": [6, "inf"], "rupture": {"kind": "rotating"}},
    {"name": "splitting", "order": [6, "inf"], "constant": True, "rupture": {"kind": "complementarity"}},
    {"name": "reynolds", "cells": [48, 4]},
    {"name": "reynolds", "cells": [96, 8]},
)
REFERENCE = (768, 32)


class Truth(NamedTuple):
    """The reference value, and the relative error it may have itself."""

    value: Any
    floor: float


@dataclass(frozen=True)
class Drawn:
    """A scene as data, and how it is judged."""

    family: str
    data: dict[str, Any]
    reference: Callable[[Scene], Truth]
    judge: Callable[[Scene, str], float] | None = None
    """Of a rung whose value is its own error: the true error by the name of the rung."""

    def distance(self, value: Any, truth: Any) -> float:
        """Return the error in the unit of the tolerance."""
        gap = np.asarray(value, dtype=float) - np.asarray(truth, dtype=float)
        quantity = self.data["question"]["quantity"]
        if quantity == "unbalance_phase":
            return abs(math.remainder(float(gap), 2.0 * math.pi))
        scale = 1.0 if quantity == "attitude_angle" else float(np.max(np.abs(truth)))
        return float(np.max(np.abs(gap))) / scale


def log_uniform(random: np.random.Generator, low: float, high: float) -> float:
    """Return a number whose logarithm is uniform."""
    return float(math.exp(random.uniform(math.log(low), math.log(high))))


def journal(random: np.random.Generator, slenderness: tuple[float, float]) -> tuple[dict[str, Any], float]:
    """Return a bearing and its length / diameter."""
    ratio = log_uniform(random, *slenderness)
    radius = log_uniform(random, 0.01, 0.2)
    table = {
        "radius": radius,
        "length": 2.0 * radius * ratio,
        "clearance": radius * log_uniform(random, 8e-4, 3e-3),
        "viscosity": log_uniform(random, 5e-3, 0.1),
    }
    return table, ratio


def scene_of(
    random: np.random.Generator,
    table: dict[str, Any],
    quantity: str,
    tolerance: tuple[float, float],
    eccentricity: tuple[float, float] = (0.05, 0.95),
) -> dict[str, Any]:
    """Return a scene whose journal would rest at a random eccentricity ratio in a plain bearing."""
    speed = log_uniform(random, 30.0, 600.0)
    target = float(random.uniform(*eccentricity))
    plain = {key: table[key] for key in ("radius", "length", "clearance", "viscosity")}
    ratio = plain["length"] / (2.0 * plain["radius"])
    film = MapFilm() if 0.1 <= ratio <= 4.0 else ShortFilm()
    bearing = JournalBearing(**plain, film=film)
    force = bearing.force([target * bearing.clearance, 0.0], [0.0, 0.0], speed)
    return {
        "schema": 1,
        "journal": table,
        "operation": {"speed": speed, "load": float(np.hypot(*force))},
        "question": {"quantity": quantity, "tolerance": log_uniform(random, *tolerance)},
    }


def fixed_film(random: np.random.Generator) -> Drawn:
    """Return a static question about a plain bearing whose film the scene names."""
    table, _ = journal(random, (0.12, 2.0))
    table["film"] = FIXED_FILMS[random.integers(len(FIXED_FILMS))]
    quantity = str(random.choice([*POSITIONS, *SLOPES]))
    return Drawn("named film", scene_of(random, table, quantity, (1e-3, 0.2)), by_map)


def slim(random: np.random.Generator) -> Drawn:
    """Return a static question about a plain bearing outside the map of the package."""
    table, _ = journal(random, (0.02, 0.095))
    quantity = str(random.choice([*POSITIONS, *SLOPES]))
    return Drawn("slim", scene_of(random, table, quantity, (1e-4, 0.1)), by_grid)


def grooved(random: np.random.Generator) -> Drawn:
    """Return a static question about a bearing with one or two grooves, fed or not."""
    table, _ = journal(random, (0.2, 1.2))
    first, width = float(random.uniform(0.0, 2.0 * math.pi)), math.radians(float(random.uniform(10.0, 40.0)))
    count = int(random.integers(1, 3))
    table["grooves"] = [{"center": first + math.pi * k, "width": width} for k in range(count)]
    quantity = str(random.choice([*POSITIONS, *SLOPES]))
    return Drawn("grooved", scene_of(random, table, quantity, (3e-4, 0.1), (0.1, 0.85)), by_grid)


def plain_map(random: np.random.Generator) -> Drawn:
    """Return a static question about a plain bearing, the film left to the ladder."""
    table, _ = journal(random, (0.12, 2.0))
    quantity = str(random.choice(POSITIONS))
    return Drawn("free film", scene_of(random, table, quantity, (1e-5, 0.1)), by_grid)


def whirl(random: np.random.Generator) -> Drawn:
    """Return a whirl threshold by a film that the scene names."""
    table, _ = journal(random, (0.12, 1.5))
    table["film"] = FIXED_FILMS[random.integers(len(FIXED_FILMS))]
    data = scene_of(random, table, "whirl_threshold", (3e-3, 0.2), (0.1, 0.6))
    return Drawn("whirl", with_rotor(random, data), whirl_by_map)


def with_rotor(random: np.random.Generator, data: dict[str, Any]) -> dict[str, Any]:
    """Return the scene with a rotor whose speed parameter is 0.3 to 2, below any threshold."""
    operation, clearance = data["operation"], data["journal"]["clearance"]
    parameter = float(random.uniform(0.3, 2.0))
    mass = operation["load"] / clearance * (parameter / operation["speed"]) ** 2
    return {**data, "rigid_rotor": {"mass": mass}}


def orbit(random: np.random.Generator) -> Drawn:
    """Return a question about an orbit in a plain bearing."""
    table, _ = journal(random, (0.12, 1.5))
    quantity = str(random.choice(ORBITS))
    data = with_rotor(random, scene_of(random, table, quantity, (3e-3, 0.1), (0.2, 0.8)))
    data["rigid_rotor"]["unbalance"] = unbalance(random, data, 0.01, 0.6)
    return Drawn("orbit", data, orbit_by_map)


def unbalance(random: np.random.Generator, data: dict[str, Any], low: float, high: float) -> float:
    """Return an unbalance whose force is a part of the load."""
    operation = data["operation"]
    return log_uniform(random, low, high) * operation["load"] / operation["speed"] ** 2


def blade(random: np.random.Generator) -> Drawn:
    """Return the peak after a blade is lost, in a plain bearing."""
    table, _ = journal(random, (0.12, 1.5))
    data = with_rotor(random, scene_of(random, table, "blade_loss_peak", (3e-3, 0.1), (0.2, 0.7)))
    size = unbalance(random, data, 0.05, 1.0)
    data["excitation"] = {"kind": "blade_loss", "unbalance": size, "revolutions": 5.0}
    return Drawn("blade loss", data, blade_by_map)


def coupling(random: np.random.Generator) -> Drawn:
    """Return the error of a co-simulation over two turns, in a plain bearing."""
    table, _ = journal(random, (0.12, 1.5))
    data = with_rotor(random, scene_of(random, table, "cosimulation_error", (1e-3, 3e-2), (0.2, 0.7)))
    data["rigid_rotor"]["unbalance"] = unbalance(random, data, 0.05, 0.5)
    data["cosimulation"] = {"revolutions": 2.0}
    return Drawn("coupling", data, lambda scene: Truth(0.0, 1e-7), coupled_error)


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


def coupled_error(scene: Scene, name: str) -> float:
    """Return the largest distance / clearance between a coupled run and both partners as one system."""
    rung = next(rung for rung in coupling_ladder(scene, "cosimulation_error").rungs if rung.name == name)
    coupled = rung.run().trajectory
    whole = simulate(
        rung.rotor, rung.bearing, duration=float(coupled.time[-1]), times=coupled.time, rtol=1e-9
    )
    return float(np.hypot(*(coupled.position - whole.position)).max()) / rung.bearing.clearance


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


def by_map(scene: Scene) -> Truth:
    """Return a static quantity by the map, which no rung of these scenes is."""
    return static_truth(scene, MapFilm(), 2e-5, 1e-3)


def by_grid(scene: Scene) -> Truth:
    """Return a static quantity by the extrapolated film in two dimensions, 768 x 32."""
    return static_truth(scene, None, 5e-6, 3e-4)


def static_truth(scene: Scene, film: MapFilm | None, floor: float, slope_floor: float) -> Truth:
    """Return a static quantity by a film, None for the finest grid, and what it may be off itself."""
    bearing = extrapolated(scene.bearing, REFERENCE) if film is None else replace(scene.bearing, film=film)
    assert scene.question is not None
    quantity = scene.question.quantity
    at = equilibrium(bearing, scene.static_load, scene.speed)
    if quantity in SLOPES:
        slopes = tangent(bearing, at.position, scene.speed, smooth=True)[1]
        return Truth(-slopes[:, :2] if quantity == "stiffness" else -slopes[:, 2:], slope_floor)
    rung = FilmRung(name="", bearing=bearing, rich=bearing, rich_name="", position_prior=0.0, slope_prior=0.0)
    made = StaticRung(film=rung, quantity=quantity, load=scene.static_load, speed=scene.speed)
    gap = at.minimum_film / bearing.clearance
    return Truth(made.scalar(at.position), floor / (gap if quantity == "minimum_film" else 1.0))


def whirl_by_map(scene: Scene) -> Truth:
    """Return the whirl threshold by the map."""
    bearing = replace(scene.bearing, film=MapFilm())
    assert scene.rigid_rotor is not None
    found = whirl_threshold(bearing, scene.static_load, scene.rigid_rotor.mass)
    return Truth(math.inf if found.speed is None else found.speed, 3e-4)


def orbit_by_map(scene: Scene) -> Truth:
    """Return a quantity of the orbit by the map at 255 samples over a turn."""
    assert scene.question is not None
    bearing = replace(scene.bearing, film=MapFilm())
    film = FilmRung(name="", bearing=bearing, rich=bearing, rich_name="", position_prior=0.0, slope_prior=0.0)
    rung = OrbitRung(film=film, quantity=scene.question.quantity, rotor=rotor_of(scene), samples=255)
    return Truth(rung.answer(None).value, 1e-6)


def blade_by_map(scene: Scene) -> Truth:
    """Return the peak by the map in 3072 steps over a turn."""
    rung = blade_loss_ladder(scene, "blade_loss_peak").rungs[0]
    return Truth(replace(rung, steps=3072).answer(None).value, 1e-6)


Draw = Callable[[np.random.Generator], Drawn]
FAMILIES: dict[str, tuple[int, Draw]] = {
    "named film": (6, fixed_film),
    "slim": (4, slim),
    "grooved": (2, grooved),
    "free film": (2, plain_map),
    "whirl": (2, whirl),
    "orbit": (3, orbit),
    "blade loss": (1, blade),
    "coupling": (1, coupling),
    "damper": (2, damper),
}
"""Weight of each family in a round of the battery, and how one scene of it is drawn."""
