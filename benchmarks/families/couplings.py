"""Scenes of co-simulations, and how each coupled run is judged: by rotor and film as one system."""

from __future__ import annotations

import math
from functools import lru_cache
from typing import Any

import numpy as np

from rotorfilm.analysis import simulate
from rotorfilm.questions.coupling import CouplingRung, coupling_ladder
from rotorfilm.scenes import Scene

from .dampers import slim, turned
from .drawn import Drawn, Truth, log_uniform
from .journals import journal, scene_of, unbalance, with_rotor

FILMS: tuple[dict[str, Any] | None, ...] = (
    None,
    {"name": "short"},
    {"name": "splitting", "order": [6, "inf"], "rupture": {"kind": "rotating"}},
    {"name": "reynolds", "cells": [48, 4]},
)
"""Films that a scene names, None for the map."""

TOLERANCES = (1e-4, 3e-2)

POINT = math.radians(0.125)
"""Distance of the points of the reference [rad]; macro steps are multiples of it."""


def coupling(random: np.random.Generator) -> Drawn:
    """Return the error of a co-simulation over two turns, in a plain bearing."""
    table, _ = journal(random, (0.12, 1.5))
    data = with_rotor(random, scene_of(random, table, "cosimulation_error", (1e-3, 3e-2), (0.2, 0.7)))
    data["rigid_rotor"]["unbalance"] = unbalance(random, data, 0.05, 0.5)
    data["cosimulation"] = {"revolutions": 2.0}
    return Drawn("coupling", data, _nothing, coupled_error)


def hard(random: np.random.Generator) -> Drawn:
    """Return three turns of a light rotor, a heavily loaded one or both, with strong unbalance."""
    table, _ = journal(random, (0.12, 1.5))
    light, loaded = [(True, False), (False, True), (True, True)][random.integers(3)]
    reach = (0.7, 0.9) if loaded else (0.2, 0.7)
    data = scene_of(random, table, "cosimulation_error", TOLERANCES, reach)
    parameter = log_uniform(random, 0.02, 0.3) if light else float(random.uniform(0.3, 2.0))
    _add_rotor(data, parameter, unbalance(random, data, 0.3, 1.0))
    data["cosimulation"] = {"revolutions": 3.0}
    return Drawn("coupling hard", data, _nothing, coupled_error)


def other(random: np.random.Generator) -> Drawn:
    """Return a co-simulation with a film that the scene names, with grooves, or with a damper."""
    if random.random() < 0.4:
        return _damper(random)
    table, _ = journal(random, (0.2, 1.2))
    if random.random() < 0.5:
        first = float(random.uniform(0.0, 2.0 * math.pi))
        width = math.radians(float(random.uniform(10.0, 40.0)))
        table["grooves"] = [{"center": first, "width": width}]
    film = FILMS[random.integers(len(FILMS))]
    if film is not None and "grooves" not in table:
        table["film"] = film
    data = scene_of(random, table, "cosimulation_error", TOLERANCES, (0.2, 0.8))
    _add_rotor(data, float(random.uniform(0.3, 2.0)), unbalance(random, data, 0.05, 0.5))
    data["cosimulation"] = {"revolutions": 2.0}
    return Drawn("coupling other", data, _nothing, coupled_error)


def _damper(random: np.random.Generator) -> Drawn:
    """Return a co-simulation of a rotor on a sprung damper."""
    table = slim(random)
    if random.random() < 0.5:
        table["extent"] = {"kind": "full"}
    data = {
        **turned(random, table),
        "cosimulation": {"revolutions": 2.0},
        "question": {"quantity": "cosimulation_error", "tolerance": log_uniform(random, *TOLERANCES)},
    }
    return Drawn("coupling other", data, _nothing, coupled_error)


def _add_rotor(data: dict[str, Any], parameter: float, size: float) -> None:
    """Give the scene a rotor of a speed parameter, with unbalance [kg m]."""
    operation, clearance = data["operation"], data["journal"]["clearance"]
    mass = operation["load"] / clearance * (parameter / operation["speed"]) ** 2
    data["rigid_rotor"] = {"mass": mass, "unbalance": size}


def _nothing(scene: Scene) -> Truth:
    """Return that a coupled run is judged by itself, and how well that is known."""
    return Truth(0.0, 1e-7)


@lru_cache(maxsize=64)
def coupled_error(scene: Scene, name: str) -> float:
    """Return the largest distance / clearance between a coupled run and both partners as one system.

    At the communication points that are multiples of `POINT`: all but the first few of some schemes.
    """
    rungs, whole = _whole(scene)
    rung = next(rung for rung in rungs if rung.name == name)
    coupled, step = rung.case.run(rung.scheme, rung.macro_angle).outcome.trajectory, POINT / abs(scene.speed)
    at = np.round(coupled.time / step).astype(int)
    met = np.abs(coupled.time - at * step) < 1e-6 * step
    distance = np.hypot(*(coupled.position[:, met] - whole[:, at[met]]))
    return float(distance.max()) / rung.case.reaction.clearance


@lru_cache(maxsize=1)
def _whole(scene: Scene) -> tuple[tuple[CouplingRung, ...], np.ndarray]:
    """Return the rungs of a scene, and the journal's position with both partners as one system."""
    rungs = coupling_ladder(scene, "cosimulation_error").rungs
    turns, step = scene.cosimulation.revolutions, POINT / abs(scene.speed)
    times = step * np.arange(round(2.0 * math.pi * turns / POINT) + 1)
    run = simulate(
        rungs[0].case.rotor, rungs[0].case.reaction, duration=float(times[-1]), times=times, rtol=1e-9
    )
    return rungs, run.position
