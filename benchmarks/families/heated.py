"""Scenes with a journal on an oil: static questions, judged by the temperature over and across the film.

The ranges, fixed before the first run: ISO VG 22 to 220, of assumed viscosity at 100 degC; radius 10 to 200
mm, length/diameter 0.25 to 1.2, clearance/radius 0.8e-3 to 2.5e-3; no groove, one opposite to the load, or
two at right angles to it, 15 to 35 degrees wide; supply at 30 to 60 degC; in every other scene a housing
that takes 5 to 50 W/K per square meter of bore, its surroundings at 15 to 30 degC; 1 to 40 m/s of the
journal's surface, in either sense; 0.1 to 4 MPa of load per length and diameter; tolerances of 1 to 30 %;
nine quantities. Drawn again is what by one temperature (T1) rests outside 0.1 to 0.9 of the clearance, is
hotter than 140 degC, or has a Reynolds number above 1000, where the film is not laminar.
"""

from __future__ import annotations

import math
from typing import Any

import numpy as np

from rotorfilm import RotorfilmError
from rotorfilm.bearings.journal import HeatedFilm, LayeredTemperature, ReynoldsFilm, fitted_bearing
from rotorfilm.core import CELSIUS
from rotorfilm.questions import QUANTITIES
from rotorfilm.questions.quantities import TEMPERATURES
from rotorfilm.scenes import Scene, read_scene
from rotorfilm.scenes.film_heat import WarmRest, bush_of, field_rest, uniform_rest

from .drawn import Drawn, Truth, log_uniform

GRADES = (22, 32, 46, 68, 100, 150, 220)
FINE, COARSE = (160, 16), (80, 8)
MANY, FEW = 24, 12
"""Cells and layers of the reference: it is extrapolated from fine and coarse, and from many and few."""

SMALLEST = 2e-4
"""Error that the reference may have itself in any case."""


def heated(random: np.random.Generator) -> Drawn:
    """Return a static question about a journal on an oil."""
    while True:
        data = _data(random)
        if _is_fair(read_scene(data, "drawn")):
            break
    zero = data["lubricant"]["supply_temperature"]
    is_temperature = data["question"]["quantity"] in TEMPERATURES
    return Drawn("heated", data, by_layers, zero=zero if is_temperature else 0.0)


def _data(random: np.random.Generator) -> dict[str, Any]:
    radius, ratio = log_uniform(random, 0.01, 0.2), log_uniform(random, 0.25, 1.2)
    length = 2.0 * radius * ratio
    width = math.radians(float(random.uniform(15.0, 35.0)))
    centers = ((), (0.5 * math.pi,), (0.0, math.pi))[random.integers(3)]
    supply = CELSIUS + float(random.uniform(30.0, 60.0))
    lubricant: dict[str, Any] = {"grade": int(random.choice(GRADES)), "supply_temperature": supply}
    if random.random() < 0.5:
        area = 2.0 * math.pi * radius * length
        lubricant["housing_conductance"] = area * log_uniform(random, 5.0, 50.0)
        lubricant["ambient_temperature"] = CELSIUS + float(random.uniform(15.0, 30.0))
    table = {
        "radius": radius,
        "length": length,
        "clearance": radius * log_uniform(random, 0.8e-3, 2.5e-3),
        "grooves": [{"center": center, "width": width} for center in centers],
    }
    speed = log_uniform(random, 1.0, 40.0) / radius * float(random.choice([-1.0, 1.0]))
    load = log_uniform(random, 1e5, 4e6) * 2.0 * radius * length
    question = {"quantity": str(random.choice(list(QUANTITIES))), "tolerance": log_uniform(random, 0.01, 0.3)}
    operation = {"speed": speed, "load": load}
    return {
        "schema": 1,
        "journal": table,
        "lubricant": lubricant,
        "operation": operation,
        "question": question,
    }


def _is_fair(scene: Scene) -> bool:
    bearing = fitted_bearing(scene.bearing, ReynoldsFilm(cells=(48, 4)))
    try:
        own = uniform_rest(bearing, scene.static_load, scene.speed)
    except RotorfilmError:
        return False
    oil, _ = bearing.cooled
    kinematic = float(oil.viscosity(own.temperature) / oil.density(own.temperature))
    reynolds = abs(scene.speed) * bearing.radius * bearing.clearance / kinematic
    inside = 0.1 < own.rest.eccentricity_ratio < 0.9
    return inside and own.temperature < CELSIUS + 140.0 and reynolds < 1000.0


def by_layers(scene: Scene) -> Truth:
    """Return a static quantity by T3, extrapolated to cells and layers without end.

    Heat moves upwind, of first order in the cells, and layers are of second order.
    """
    assert scene.question is not None
    quantity = scene.question.quantity
    fine, coarse, many = (np.asarray(QUANTITIES[quantity].value(rest)) for rest in _rests(scene))
    by_cells, by_layer = fine - coarse, 4.0 / 3.0 * (many - coarse)
    truth = fine + by_cells + by_layer
    zero = scene.bearing.cooled[1].supply_temperature if quantity in TEMPERATURES else 0.0
    scale = 1.0 if quantity == "attitude_angle" else float(np.max(np.abs(truth - zero)))
    own = 0.5 * float(np.max(np.abs(by_cells)) + np.max(np.abs(by_layer))) / scale
    return Truth(truth, own + SMALLEST)


def _rests(scene: Scene) -> tuple[WarmRest, ...]:
    return tuple(
        field_rest(
            HeatedFilm(
                bearing=scene.bearing,
                walls=bush_of(scene.bearing),
                cells=cells,
                profile=LayeredTemperature(layers),
            ),
            scene.static_load,
            scene.speed,
        )
        for cells, layers in ((FINE, FEW), (COARSE, FEW), (COARSE, MANY))
    )
