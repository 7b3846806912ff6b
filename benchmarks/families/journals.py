"""Scenes with a journal bearing: static questions, whirl thresholds, orbits, lost blades, co-simulation."""

from __future__ import annotations

import math
from dataclasses import replace
from typing import Any

import numpy as np

from rotorfilm.analysis import equilibrium, whirl_threshold
from rotorfilm.bearings.journal import JournalBearing, MapFilm, ShortFilm
from rotorfilm.questions import ladder_of
from rotorfilm.questions.film_motions import OrbitRung, rotor_of
from rotorfilm.scenes import Scene
from rotorfilm.scenes.film_rungs import FilmRung, extrapolated, tangent

from .conserved_truth import by_conserved_oil
from .drawn import Drawn, Truth, log_uniform

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
    """Return a static question about a bearing with one or two grooves at ambient pressure."""
    table, _ = journal(random, (0.2, 1.2))
    first, width = float(random.uniform(0.0, 2.0 * math.pi)), math.radians(float(random.uniform(10.0, 40.0)))
    count = int(random.integers(1, 3))
    table["grooves"] = [{"center": first + math.pi * k, "width": width} for k in range(count)]
    quantity = str(random.choice([*POSITIONS, *SLOPES]))
    return Drawn("grooved", scene_of(random, table, quantity, (3e-4, 0.1), (0.1, 0.85)), by_conserved_oil)


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


def orbit_by_film(random: np.random.Generator) -> Drawn:
    """Return a question about an orbit in a plain bearing whose film the scene names."""
    drawn = orbit(random)
    drawn.data["journal"]["film"] = FIXED_FILMS[random.integers(len(FIXED_FILMS))]
    return replace(drawn, family="orbit, film")


def unbalance(random: np.random.Generator, data: dict[str, Any], low: float, high: float) -> float:
    """Return an unbalance whose force is a part of the load."""
    operation = data["operation"]
    return log_uniform(random, low, high) * operation["load"] / operation["speed"] ** 2


def blade(random: np.random.Generator) -> Drawn:
    """Return the peak after a blade is lost, in a plain bearing."""
    table, _ = journal(random, (0.12, 1.5))
    data = with_rotor(random, scene_of(random, table, "peak_displacement", (3e-3, 0.1), (0.2, 0.7)))
    size = unbalance(random, data, 0.05, 1.0)
    data["excitation"] = {"kind": "blade_loss", "unbalance": size, "revolutions": 5.0}
    return Drawn("blade loss", data, blade_by_map)


def blade_by_film(random: np.random.Generator) -> Drawn:
    """Return the peak after a blade is lost, by the short film or a coarse grid."""
    drawn = blade(random)
    drawn.data["journal"]["film"] = ({"name": "short"}, {"name": "reynolds", "cells": [48, 4]})[
        random.integers(2)
    ]
    return replace(drawn, family="blade, film")


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
    gap = at.minimum_film / bearing.clearance
    return Truth(getattr(at, quantity), floor / (gap if quantity == "minimum_film" else 1.0))


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
    film = FilmRung(name="", reaction=bearing, rich=bearing, rich_name="", position_prior=0.0, prior=0.0)
    rung = OrbitRung(film=film, quantity=scene.question.quantity, rotor=rotor_of(scene), samples=255)
    return Truth(rung.answer(None).value, 1e-6)


def blade_by_map(scene: Scene) -> Truth:
    """Return the peak by the map in 3072 steps over a turn."""
    assert scene.journal is not None
    by_map = scene.with_tables(journal=replace(scene.journal, film=None))
    rung = ladder_of(by_map).rungs[0]
    return Truth(replace(rung, steps=3072).answer(None).value, 1e-6)
