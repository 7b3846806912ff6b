"""Scenes with a flexible rotor on two bearings: first critical speeds and synchronous orbits."""

from __future__ import annotations

import math
from dataclasses import replace
from typing import Any

import numpy as np
from scipy.optimize import brentq
from scipy.sparse.linalg import eigs

from rotorfilm import Reaction
from rotorfilm.analysis import (
    critical_speed_map,
    critical_speeds,
    periodic_orbit,
    rotor_equilibrium,
    rotor_threshold,
    simulate_rotor,
)
from rotorfilm.analysis.rotor_matrices import second_order
from rotorfilm.bearings.journal import JournalBearing, MapFilm
from rotorfilm.rotors import FlexibleRotor, FourthOrderBeam, ShaftElement, ShaftRotor, mount
from rotorfilm.scenes import Scene
from rotorfilm.scenes.reading import read_table
from rotorfilm.scenes.shaft_table import ShaftTable

from .drawn import Drawn, Truth, log_uniform

STEEL = {"young_modulus": 2.1e11, "shear_modulus": 8.0e10, "density": 7850.0}
QUANTITIES = ("unbalance_amplitude", "unbalance_phase", "unbalance_force")
SPLIT_SPEED, SPLIT_ORBIT = 4, 3
SOFT = 1e8
"""Stiffness of a bearing [N/m] by which the scale of the speeds of a scene is set."""


def shaft_table(random: np.random.Generator) -> tuple[dict[str, Any], float]:
    """Return a rotor on two bearings, and its first critical speed on bearings of `SOFT` [rad/s]."""
    length = log_uniform(random, 0.4, 2.0)
    diameter = length / log_uniform(random, 10.0, 28.0)
    count = int(random.integers(3, 9))
    parts = random.uniform(0.5, 1.5, count)
    elements = [
        {"length": float(part), "outer_diameter": diameter * float(random.uniform(0.75, 1.3))}
        for part in length * parts / parts.sum()
    ]
    overhung = bool(random.random() < 0.3)
    last = count - 1 if overhung else count
    inner = [node for node in range(1, count) if node != last]
    nodes = random.choice(inner, size=min(len(inner), int(random.integers(1, 4))), replace=False)
    places = sorted({*(int(node) for node in nodes[: 2 if overhung else 3]), *([count] if overhung else [])})
    disks = [
        {
            "node": node,
            "width": diameter * float(random.uniform(0.3, 1.0)),
            "outer_diameter": diameter * float(random.uniform(2.5, 6.0)),
            "inner_diameter": diameter,
        }
        for node in places
    ]
    table = {
        "material": STEEL,
        "elements": elements,
        "disks": disks,
        "bearings": bearings(random, (0, last), diameter),
        "speeds": {"first": 1.0, "last": 2.0},
    }
    rotor = read_table(ShaftTable, "drawn: ", table).build()
    scale = float(critical_speed_map(rotor, [SOFT], 1)[0, 0])
    table["speeds"] = {"first": 0.3 * scale, "last": 2.0 * scale, "count": 40}
    return table, scale


def bearings(random: np.random.Generator, nodes: tuple[int, int], diameter: float) -> list[dict[str, Any]]:
    """Return two bearings of one kind: journals whose film is free or named, or springs and dampers."""
    kind = random.random()
    names = ("left", "right")
    if kind < 0.4:
        stiffness = log_uniform(random, 3e6, 3e8)
        other = stiffness * float(random.uniform(0.5, 1.0))
        springs = {
            "stiffness": [[stiffness, 0.0], [0.0, other]],
            "damping": stiffness * log_uniform(random, 1e-5, 3e-4),
        }
        return [{"name": name, "node": node, **springs} for name, node in zip(names, nodes, strict=True)]
    journal: dict[str, Any] = {
        "diameter": diameter,
        "length": diameter * log_uniform(random, 0.3, 1.0),
        "clearance": 0.5 * diameter * log_uniform(random, 1e-3, 3e-3),
        "viscosity": log_uniform(random, 5e-3, 0.05),
    }
    if kind > 0.75:
        journal["film"] = {"name": "short"}
    return [{"name": name, "node": node, "journal": journal} for name, node in zip(names, nodes, strict=True)]


def shaft_speed(random: np.random.Generator) -> Drawn:
    """Return a question about the first critical speed."""
    table, _ = shaft_table(random)
    question = {"quantity": "critical_speed", "tolerance": log_uniform(random, 1e-5, 0.1)}
    return Drawn("shaft speed", {"schema": 1, "shaft": table, "question": question}, speed_by_fine_mesh)


def shaft_orbit(random: np.random.Generator) -> Drawn:
    """Return a question about the synchronous orbit at a speed about the first critical one."""
    table, scale = shaft_table(random)
    speed = scale * float(random.uniform(0.3, 1.5))
    node = int(table["disks"][0]["node"])
    table["probes"] = [{"node": node, "name": "disk"}]
    journal = table["bearings"][0].get("journal")
    size = 1e-4 if journal is None else journal["clearance"]
    mass = sum(read_table(ShaftTable, "drawn: ", table).build().structure.mass[::2, ::2].diagonal()) / 2.0
    table["unbalances"] = [
        {
            "node": int(disk["node"]),
            "unbalance": float(log_uniform(random, 0.003, 0.3) * size * mass / len(table["disks"])),
            "unbalance_angle": float(random.uniform(0.0, 2.0 * math.pi)),
        }
        for disk in table["disks"]
    ]
    quantity = str(random.choice(QUANTITIES))
    places = ["left", "right"] if quantity == "unbalance_force" else ["left", "right", "disk"]
    question = {
        "quantity": quantity,
        "tolerance": log_uniform(random, 1e-3, 0.1),
    }
    if quantity == "unbalance_phase" or random.random() < 0.5:
        question["at"] = str(random.choice(places))
    data = {"schema": 1, "shaft": table, "operation": {"speed": speed}, "question": question}
    return Drawn("shaft orbit", data, orbit_of_fine_mesh)


def shaft_whirl(random: np.random.Generator) -> Drawn:
    """Return a question about the threshold of whirl on journals."""
    table, scale = shaft_table(random)
    while "journal" not in table["bearings"][0]:
        table, scale = shaft_table(random)
    table["speeds"] = {"first": 0.3 * scale, "last": 4.0 * scale, "count": 40}
    question = {"quantity": "whirl_threshold", "tolerance": log_uniform(random, 1e-4, 0.1)}
    return Drawn("shaft whirl", {"schema": 1, "shaft": table, "question": question}, threshold_by_fine_mesh)


def threshold_by_fine_mesh(scene: Scene) -> Truth:
    """Return the threshold of a mesh four times as fine, on maps, by the least stable of six modes.

    The modes of the mesh of the file on maps tell at which frequency.
    """
    assert scene.shaft is not None
    rotor, films = scene.shaft.build(), true_films(scene.shaft.build_bearings())
    first = rotor_threshold(rotor, films, scene.shaft.speeds.build())
    if first.speed is None or not first.whirl_frequency:
        return Truth(math.inf, 1e-4)
    fine, ratio = finer(rotor, SPLIT_SPEED), first.whirl_frequency / first.speed
    low, high = 0.995 * first.speed, 1.005 * first.speed

    def growth(speed: float) -> float:
        system = second_order(fine.structure, rotor_equilibrium(fine, films, speed))
        # Of a real matrix the shift would have to be real as well.
        near = eigs(
            system.state_matrix().astype(complex), k=6, sigma=1j * ratio * speed, return_eigenvectors=False
        )
        return float(near.real.max())

    while growth(low) * growth(high) > 0.0:
        low, high = 0.97 * low, 1.03 * high
    return Truth(float(brentq(growth, low, high, rtol=1e-12)), 1e-4)


def finer(rotor: ShaftRotor, pieces: int) -> ShaftRotor:
    """Return a rotor with every element in so many, of fourth order."""
    moved = {
        name: tuple(replace(part, node=part.node * pieces) for part in getattr(rotor, name))
        for name in ("disks", "stations", "tilt_springs", "probes", "unbalances")
    }
    whole = [one for one in rotor.elements if isinstance(one, ShaftElement)]
    elements = tuple(piece for one in whole for piece in one.split(pieces))
    return replace(rotor, elements=elements, beam=FourthOrderBeam(), **moved)


def true_films(found: dict[str, Reaction]) -> dict[str, Reaction]:
    """Return the bearings with the map as the film of every journal."""
    return {
        name: replace(one, film=MapFilm()) if isinstance(one, JournalBearing) else one
        for name, one in found.items()
    }


def speed_by_fine_mesh(scene: Scene) -> Truth:
    """Return the first critical speed of a mesh four times as fine, on maps, by inverse iteration.

    The modes of the mesh of the file on maps tell which one; it is then followed by its dynamic stiffness.
    """
    assert scene.shaft is not None
    rotor, films = scene.shaft.build(), true_films(scene.shaft.build_bearings())
    first = critical_speeds(rotor, films, scene.shaft.speeds.build())[0]
    fine = finer(rotor, SPLIT_SPEED)
    near = first.speed * complex(-first.log_decrement / (2.0 * math.pi), 1.0)

    def lead(speed: float) -> float:
        return float(mode_near(fine, films, speed, near).imag) - speed

    low, high = 0.99 * first.speed, 1.01 * first.speed
    while lead(low) * lead(high) > 0.0:
        low, high = 0.97 * low, 1.03 * high
    journals = any(isinstance(one, JournalBearing) for one in films.values())
    return Truth(float(brentq(lead, low, high, rtol=1e-12)), 1e-4 if journals else 1e-9)


def mode_near(rotor: FlexibleRotor, films: dict[str, Reaction], speed: float, near: complex) -> complex:
    """Return the eigenvalue of a rotor at a speed next to another one, by inverse iteration."""
    system = second_order(rotor.structure, rotor_equilibrium(rotor, films, speed))
    random = np.random.default_rng(0)
    right = random.normal(size=len(system.mass)) + 0j
    left, value = right.copy(), near
    for step in range(30):
        whole = value**2 * system.mass + value * system.damping + system.stiffness
        slope = 2.0 * value * system.mass + system.damping
        right = np.linalg.solve(whole, slope @ right)
        left = np.linalg.solve(whole.conj().T, slope.conj().T @ left)
        right, left = right / np.linalg.norm(right), left / np.linalg.norm(left)
        if step < 2:
            continue  # the shift stays until the mode next to it stands out
        change = (left.conj() @ whole @ right) / (left.conj() @ slope @ right)
        value -= change
        if abs(change) < 1e-12 * abs(value):
            break
    return complex(value)


def orbit_of_fine_mesh(scene: Scene) -> Truth:
    """Return a quantity of the nonlinear orbit on maps of a mesh three times as fine, by harmonic balance.

    Motion of the probe is that of the whole rotor, integrated over one turn from the state on the orbit.
    """
    assert scene.shaft is not None
    assert scene.question is not None
    films = true_films(scene.shaft.build_bearings())
    rotor = finer(scene.shaft.build(speed=scene.speed), SPLIT_ORBIT)
    mounted = mount(rotor, films)
    orbit = periodic_orbit(mounted, tolerance=1e-6, stability=False)
    turn = orbit.period
    times = np.linspace(0.0, turn, 129)[:-1]
    run = simulate_rotor(
        mount(replace(rotor, initial=tuple(orbit.state.tolist())), films), duration=turn, times=times
    )
    quantity, at = scene.question.quantity, scene.question.at
    waves = {}
    for name in ["left", "right"] if quantity == "unbalance_force" else ["left", "right", "disk"]:
        kind = "force_" if quantity == "unbalance_force" else ""
        pair = np.array([run[f"{name}_{kind}x"], run[f"{name}_{kind}y"]])
        waves[name] = np.fft.fft(pair, axis=1)[:, 1] * (2.0 / len(times))
    wave = {name: circles(pair) for name, pair in waves.items()}
    name = at or max(wave, key=lambda one: sum(map(abs, wave[one])))
    forward, backward = wave[name]
    floor = 1e-4 if any(isinstance(one, JournalBearing) for one in films.values()) else 1e-6
    if quantity == "unbalance_phase":
        turned = float(np.angle(forward)) - scene.shaft.unbalances[0].unbalance_angle
        return Truth(math.remainder(turned, 2.0 * math.pi), floor)
    return Truth(abs(forward) + abs(backward), floor)


def circles(wave: np.ndarray) -> tuple[complex, complex]:
    """Return the circles with and against the rotation that make up a first harmonic (2,)."""
    x, y = complex(wave[0]), complex(wave[1])
    return 0.5 * (x + 1j * y), 0.5 * (x.conjugate() + 1j * y.conjugate())
