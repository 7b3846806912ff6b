"""Scenes with a squeeze-film damper between seals, or with the inertia of its oil: orbits and lost blades.

The ranges, and the seed 20297, were fixed before anything was run.
"""

from __future__ import annotations

import math
from typing import Any

import numpy as np
from scipy.optimize import brentq

from rotorfilm import ContactError, with_springs
from rotorfilm.analysis import simulate
from rotorfilm.bearings.damper import FiniteSqueeze, SqueezeFilmDamper
from rotorfilm.bearings.damper.table import damper_models
from rotorfilm.questions import ladder_of
from rotorfilm.scenes import Scene

from .built_truth import Place, beyond, impedance
from .drawn import Drawn, Truth, log_uniform

DENSITY = 850.0
NOWHERE = 1e-30
"""Truth of an orbit that is not there: any number is wrong."""
UNSURE = 0.3
"""Share of what no exact solution covers that the reference is given as its own error."""


def built_damper(random: np.random.Generator) -> Drawn:
    """Return an orbit or a lost blade: a third each open, sealed (both full), and ruptured with open ends."""
    kind = str(random.choice(["open", "sealed", "ruptured"]))
    lost = kind != "ruptured" and random.random() < 0.25
    table, speed = oil_film(random, kind)
    ratio = 0.5 * table["length"] / table["radius"]
    open_end = math.pi * DENSITY * table["radius"] * table["length"] ** 3 / (10.0 * table["clearance"])
    mass = open_end * 10.0 ** float(random.uniform(-0.5, 1.5))
    if kind == "sealed":
        mass *= 1.0 + 1.0 / (ratio * 10.0 ** float(random.uniform(0.0, 1.0)))
    table["stiffness"] = mass * (speed / float(random.uniform(0.5, 3.0))) ** 2
    size = float(random.uniform(0.05, 0.5)) * mass * table["clearance"]
    quantity = "peak_displacement"
    if not lost:
        quantity = str(random.choice(["transmissibility", "unbalance_amplitude"]))
    data: dict[str, Any] = {
        "schema": 1,
        "damper": table,
        "operation": {"speed": speed},
        "rigid_rotor": {"mass": mass} if lost else {"mass": mass, "unbalance": size},
        "question": {"quantity": quantity, "tolerance": log_uniform(random, 3e-3, 0.1)},
    }
    if lost:
        data["excitation"] = {"kind": "blade_loss", "unbalance": size, "revolutions": 4.0}
    return Drawn("built damper", data, peak if lost else orbit)


def oil_film(random: np.random.Generator, kind: str) -> tuple[dict[str, Any], float]:
    """Return a damper of a squeeze Reynolds number to 8, ruptured to 4, and the speed of its rotor."""
    ruptured = kind == "ruptured"
    while True:
        radius, speed = log_uniform(random, 0.01, 0.08), log_uniform(random, 200.0, 5000.0)
        clearance = radius * log_uniform(random, 1e-3, 4e-3)
        reynolds = log_uniform(random, 0.2, 4.0 if ruptured else 8.0)
        viscosity = DENSITY * speed * clearance**2 / reynolds
        if 5e-4 < viscosity < 0.1:
            break
    table: dict[str, Any] = {
        "radius": radius,
        "length": 2.0 * radius * log_uniform(random, 0.08, 0.25 if ruptured else 0.8),
        "clearance": clearance,
        "viscosity": viscosity,
        "density": DENSITY,
    }
    if not ruptured:
        table["extent"] = {"kind": "full"}
    if kind == "sealed":
        leak = log_uniform(random, 0.1, 10.0)
        table["seals"] = {"leakage": leak * clearance**3 / (12.0 * viscosity * radius)}
    return table, speed


def place_of(damper: SqueezeFilmDamper, speed: float, eps: float) -> Place:
    """Return the film of the reference on a circular orbit."""
    c = damper.clearance
    seals = damper.seals
    leak = math.inf if seals is None else 12.0 * damper.viscosity * damper.radius * seals.leakage / c**3
    reynolds = damper.density * speed * c * c / damper.viscosity
    return Place(0.5 * damper.length / damper.radius, leak, eps, reynolds)


def orbit(scene: Scene) -> Truth:
    """Return a quantity of the smallest orbit, and how far what no exact solution covers moves it."""
    best, plain = (_orbit(scene, whole=whole) for whole in (True, False))
    if best == NOWHERE:
        return Truth(best, 1e-6)
    damper = scene.damper.build()
    floor = 1e-5 + UNSURE * abs(plain / best - 1.0)
    if damper.squeeze_case.cavitated:
        s = 0.5 * damper.length / damper.radius
        floor = 1e-3 + 3.0 * abs(plain / best - 1.0) * UNSURE * (1.0 - 3.0 * (1.0 - math.tanh(s) / s) / s**2)
    return Truth(best, floor)


def _orbit(scene: Scene, *, whole: bool) -> float:
    """Return the quantity; not whole: full to first order, ruptured without inertia."""
    damper, rotor, stiffness = scene.damper.build(), scene.rigid_rotor, scene.damper.stiffness
    speed, c = scene.speed, damper.clearance
    unit = 12.0 * damper.viscosity * speed * damper.radius**4 / c**2

    def forces(eps: float) -> tuple[complex, complex]:
        place = place_of(damper, speed, eps)
        if damper.squeeze_case.cavitated:
            film = place.ruptured() if whole else Place(place.s, place.leak, eps, 0.0).ruptured()
        else:
            film = place.full() + (beyond(place) if whole else 0.0)
        force = unit * film - stiffness * c * eps
        return force, rotor.mass * speed**2 * c * eps + force

    def excess(eps: float) -> float:
        return abs(forces(eps)[1]) / speed**2 - rotor.unbalance

    near = float(ladder_of(scene).rungs[-1].answer(None).solution)
    ends = 0.7 * near, min(1.3 * near, 0.5 * (0.9 + near))
    if near > 0.85 or excess(ends[0]) * excess(ends[1]) > 0.0:
        return NOWHERE
    eps = brentq(excess, *ends, xtol=1e-7)
    force, pull = forces(eps)
    return abs(force) / abs(pull) if scene.question.quantity == "transmissibility" else eps * c


def peak(scene: Scene) -> Truth:
    """Return the largest distance by scipy in the film of finite length; in error by its second order."""
    models = damper_models(scene)
    whole = scene.damper.build()
    film = SqueezeFilmDamper(
        **{name: getattr(whole, name) for name in ("radius", "length", "clearance", "viscosity", "density")},
        extent=whole.extent,
        seals=whole.seals,
        film=FiniteSqueeze(),
    )
    support = with_springs(film, scene.damper.stiffness)
    times = np.linspace(0.0, models.duration, math.ceil(models.duration * scene.speed / 0.02))
    try:
        run = simulate(models.rotor, support, duration=models.duration, times=times, rtol=1e-7)
    except ContactError:
        return Truth(NOWHERE, 1e-6)
    reynolds = film.reynolds_number(scene.speed)
    second = abs(impedance(reynolds) - 1.0 - 0.1j * reynolds)
    return Truth(float(np.hypot(*run.position).max()), 1e-4 + second)
