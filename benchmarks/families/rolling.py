"""Scenes with ball bearings by their dimensions, judged by a separate program of Harris and Jones."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any

import numpy as np
from scipy.interpolate import CubicSpline
from scipy.optimize import root

from rotorfilm.bearings.rolling import EllipticContact
from rotorfilm.bearings.rolling.table import rest_under, single_of
from rotorfilm.scenes import Scene, read_scene

from .drawn import Drawn, Truth, log_uniform

QUANTITIES = ("stiffness", "axial_stiffness", "contact_load", "contact_angle", "film_parameter")
RACE_FLOOR = 1e-6

Pair = tuple[float, float]
"""Of an inner and an outer contact, or along the axis and the radius."""


def ball_bearing(random: np.random.Generator) -> Drawn:
    """Return a question about a deep groove bearing, one of angular contact under thrust, or a pair."""
    kind = str(random.choice(["deep", "deep", "angular", "pair"]))
    table = _dimensions(random, deep=kind == "deep")
    contacts = read_scene(_scene(table, 0.0, 1.0), "drawn").table("ball_bearing").build().contacts
    reference = contacts[0].load_at(log_uniform(random, 0.7e9, 2.0e9))
    balls, angle = table["balls"], table.get("contact_angle", 0.0)
    load = reference * balls * math.cos(angle) / 5.0
    if kind != "deep":
        thrust = reference * balls * math.sin(angle) * float(random.uniform(0.3, 1.0))
        load *= float(random.uniform(0.1, 0.5))
        if kind == "angular":
            table["axial_load"] = thrust
        else:
            table |= {"arrangement": str(random.choice(["back_to_back", "face_to_face"])), "distance": 0.03}
            table["preload"] = 0.5 * thrust
    if random.random() < 0.7:
        table["viscosity"] = log_uniform(random, 5e-3, 60e-3)
        table["pressure_coefficient"] = float(random.uniform(12e-9, 22e-9))
        table["roughness"] = log_uniform(random, 0.05e-6, 0.4e-6)
    speed_rpm = log_uniform(random, 0.01e6, 1.0e6) / (1e3 * table["pitch_diameter"])
    data = _scene(table, speed_rpm * math.pi / 30.0, load)
    asked = [q for q in QUANTITIES if q != "film_parameter" or "viscosity" in table]
    asked = [q for q in asked if q != "contact_angle" or kind != "deep"]
    quantity = str(random.choice(asked))
    span = (5e-3, 0.1) if quantity == "contact_angle" else (0.02, 0.3)
    data["question"] = {"quantity": quantity, "tolerance": log_uniform(random, *span)}
    return Drawn("ball bearing", data, truth)


def _dimensions(random: np.random.Generator, *, deep: bool) -> dict[str, Any]:
    balls, diameter = int(random.integers(7, 21)), log_uniform(random, 4e-3, 20e-3)
    table: dict[str, Any] = {
        "balls": balls,
        "ball_diameter": diameter,
        "pitch_diameter": diameter / math.sin(math.pi / balls) * float(random.uniform(1.05, 1.4)),
        "inner_conformity": float(random.uniform(0.51, 0.54)),
        "outer_conformity": float(random.uniform(0.51, 0.54)),
        "cage_angle": float(random.uniform(0.0, 2.0 * math.pi)),
        "ball_material": "silicon_nitride" if random.random() < 1.0 / 3.0 else "steel",
    }
    if deep:
        return table | {"internal_clearance": float(random.uniform(0.0, 20e-6))}
    return table | {"contact_angle": math.radians(float(random.uniform(12.0, 40.0)))}


def _scene(table: dict[str, Any], speed: float, load: float) -> dict[str, Any]:
    return {"schema": 1, "ball_bearing": table, "operation": {"speed": speed, "load": load}}


@dataclass(frozen=True)
class Race:
    """Contacts of balls and one race, their stiffness by the contact angle, their films by the load."""

    inner: bool
    single: Any
    oil: Any
    speed: float

    def __post_init__(self) -> None:
        angles = np.radians(np.linspace(-85.0, 85.0, 69))
        stiff = CubicSpline(angles, [self.contact(a).stiffness for a in angles.tolist()])
        object.__setattr__(self, "stiff", stiff)

    def contact(self, angle: float) -> EllipticContact:
        """Return the dry contact at an angle [rad]."""
        one, side = self.single, 1.0 if self.inner else -1.0
        D, f = one.ball_diameter, one.inner_conformity if self.inner else one.outer_conformity
        along = 2.0 / D + side * 2.0 * math.cos(angle) / (one.pitch_diameter - side * D * math.cos(angle))
        modulus = 2.0 / (one.ball_material.compliance + one.ring_material.compliance)
        across = 2.0 / D - 1.0 / (f * D)
        return EllipticContact(
            rolling_radius=1.0 / along, groove_radius=1.0 / across, combined_modulus=modulus
        )

    def film(self, load: float, angle: float, *, least: bool = False) -> float:
        """Return the central, or the least film [m] by Hamrock and Dowson (1977)."""
        if self.oil is None or not load > 0.0 or self.speed == 0.0:
            return 0.0
        contact = self.contact(angle)
        R, E, kappa = contact.rolling_radius, contact.combined_modulus, contact.ellipticity
        g = self.single.ball_diameter * math.cos(angle) / self.single.pitch_diameter
        u = 0.25 * self.speed * self.single.pitch_diameter * (1.0 - g**2)
        U, G, W = self.oil.viscosity * u / (E * R), self.oil.pressure_coefficient * E, load / (E * R**2)
        if least:
            return R * 3.63 * U**0.68 * G**0.49 * W**-0.073 * (1.0 - math.exp(-0.68 * kappa))
        return R * 2.69 * U**0.67 * G**0.53 * W**-0.067 * (1.0 - 0.61 * math.exp(-0.73 * kappa))


class Bearing:
    """All balls of a scene, each solved by itself at every place of the shaft."""

    def __init__(self, scene: Scene) -> None:
        table = scene.table("ball_bearing")
        self.whole, self.speed, self.load = table.build(), scene.speed, np.array(scene.static_load)
        self.one = single_of(self.whole)
        self.races = [Race(inner, self.one, table.oil, scene.speed) for inner in (True, False)]
        self.reach = self.one.reaches
        self.thrust = self.whole.axial_load
        rows = self.whole.rows
        self.balls = [(row, row[6] + 2.0 * math.pi * k / row[5]) for row in rows for k in range(int(row[5]))]
        self.centers: list[Any] = [None] * len(self.balls)

    def ball(self, number: int, motion: Any) -> tuple[Any, Pair, Pair]:
        """Return force on the inner ring (axial, radial), loads and angles of a ball."""
        groove = self._groove(number, motion)
        guess = self._guess(groove)
        films = self._films((max(guess, 1e-3),) * 2, (self.one.free_contact_angle,) * 2)
        for _ in range(8):
            center, loads, angles = self._balanced(number, groove, films, guess)
            inner, outer = self._films(loads, angles)
            films = (inner if loads[0] else films[0]), outer
        self.centers[number] = center
        force = -loads[0] * np.array([math.sin(angles[0]), math.cos(angles[0])])
        return force, loads, angles

    def _groove(self, number: int, motion: Any) -> Pair:
        """Return the center of the inner groove from that of the outer one (axial, radial)."""
        (row, psi), (x, y, z) = self.balls[number], motion
        return row[2] + row[1] * z, row[3] + self.one.growth + x * math.cos(psi) + y * math.sin(psi)

    def _guess(self, groove: Pair) -> float:
        """Return about what presses a ball, with both contacts in series."""
        angle = self.one.free_contact_angle
        per = sum(float(race.stiff(angle)) ** (-2.0 / 3.0) for race in self.races)
        depth = max(math.hypot(*groove) - sum(self.reach), 0.0)
        return per**-1.5 * depth**1.5

    def _balanced(self, number: int, groove: Pair, films: Pair, guess: float) -> tuple[Any, Pair, Pair]:
        """Return center, loads and angles of a ball on films: in balance, or flung out with no inner load."""
        Fc, _ = self._inertia(0.0, 0.0)
        Ko = float(self.races[1].stiff(0.0))
        free = np.array([0.0, self.reach[1] - films[1] + (Fc / Ko) ** (2.0 / 3.0)])
        (Qi, _), angles = self._contacts(groove, films, free)
        if Qi == 0.0:
            return free, (0.0, Fc), (angles[0], 0.0)
        start = self.centers[number]
        if start is None:
            angle = self.one.free_contact_angle
            pull = np.array([guess * math.sin(angle), guess + Fc])
            start = pull / np.hypot(*pull) * (self.reach[1] + (np.hypot(*pull) / Ko) ** (2.0 / 3.0))

        def left(w: Any) -> Any:
            return self._left(groove, films, self.reach[1] * (w - 1.0)) / max(guess, 1.0)

        # Shifted by one: MINPACK takes its steps relative to the unknowns, and a center may be at 0.
        found = root(left, start / self.reach[1] + 1.0, tol=1e-13)
        center = self.reach[1] * (found.x - 1.0)
        return center, *self._contacts(groove, films, center)

    def _left(self, groove: Pair, films: Pair, center: Any) -> Any:
        """Return what forces leave on a ball with its center there (axial, radial)."""
        (Qi, Qo), (ai, ao) = self._contacts(groove, films, center)
        Fc, Mg = self._inertia(ai, ao)
        friction = 2.0 * Mg / self.one.ball_diameter
        return np.array(
            [
                Qi * math.sin(ai) - Qo * math.sin(ao) + friction * math.cos(ao),
                Qi * math.cos(ai) - Qo * math.cos(ao) - friction * math.sin(ao) + Fc,
            ]
        )

    def _contacts(self, groove: Pair, films: Pair, center: Any) -> tuple[Pair, Pair]:
        """Return loads and angles of both contacts."""
        a1, a2 = groove[0] - center[0], groove[1] - center[1]
        angles = math.atan2(a1, a2), math.atan2(center[0], center[1])
        lengths = math.hypot(a1, a2), math.hypot(*center)
        each = zip(self.races, angles, lengths, self.reach, films, strict=True)
        inner, outer = (float(race.stiff(a)) * max(d - r + h, 0.0) ** 1.5 for race, a, d, r, h in each)
        return (inner, outer), angles

    def _inertia(self, ai: float, ao: float) -> Pair:
        """Return centrifugal force and gyroscopic moment by Jones, with outer-race control."""
        one, D, dm = self.one, self.one.ball_diameter, self.one.pitch_diameter
        g, J, m = D / dm, 0.1 * one.ball_mass * D**2, one.ball_mass
        om = self.speed * (1.0 - g * math.cos(ai)) / (1.0 + math.cos(ai - ao))
        tan_b = math.sin(ao) / (math.cos(ao) + g)
        wa = -om * (1.0 / g + math.cos(ao)) / (math.cos(ao) + math.sin(ao) * tan_b)
        return 0.5 * m * om**2 * dm, J * om * wa * tan_b  # Mg = -J om w_r, w_r = -w_a tan b

    def _films(self, loads: Pair, angles: Pair) -> Pair:
        """Return the films of both contacts."""
        each = zip(self.races, loads, angles, strict=True)
        inner, outer = (race.film(max(load, 1e-9), angle) for race, load, angle in each)
        return inner, outer

    def force(self, motion: Any) -> Any:
        """Return the force on the shaft (3,)."""
        total = np.zeros(3)
        for k, (row, psi) in enumerate(self.balls):
            (axial, radial), _, _ = self.ball(k, motion)
            total += [radial * math.cos(psi), radial * math.sin(psi), row[1] * axial]
        return total

    def slopes(self, motion: Any) -> Any:
        """Return -dF/d(x, y, z) by central differences."""
        step = 1e-3 * float(self.one.contacts[0].approach(self.one.contacts[0].load_at(1.2e9)))
        columns = [(self.force(motion - h) - self.force(motion + h)) / (2.0 * step) for h in step * np.eye(3)]
        return np.array(columns).T

    def rest(self, start: Any) -> Any:
        """Return the place of the shaft by Newton's method."""
        motion = np.array(start, dtype=float)
        free = [0, 1] if self.thrust is None else [0, 1, 2]
        outside = np.array([*self.load, self.thrust or 0.0])
        for _ in range(30):
            left = (self.force(motion) + outside)[free]
            if np.hypot.reduce(left) < 1e-9 * np.hypot.reduce(outside):
                break
            step = np.linalg.solve(self.slopes(motion)[np.ix_(free, free)], left)
            motion[free] += step
        return motion


def truth(scene: Scene) -> Truth:
    """Return the quantity by contacts at their own angles, each with the film of its own load."""
    bearing = Bearing(scene)
    near = rest_under(bearing.whole, scene.static_load, scene.speed)
    motion = bearing.rest((*near.position, bearing.whole.axial_place(near.position, scene.speed)))
    balls = [bearing.ball(k, motion) for k in range(len(bearing.balls))]
    loads = np.array([ball[1] for ball in balls])
    angles = np.array([ball[2] for ball in balls])
    most = int(np.argmax(loads[:, 0]))
    quantity = scene.question.quantity
    if quantity == "contact_load":
        return Truth(float(loads.max()), RACE_FLOOR)
    if quantity == "contact_angle":
        return Truth(float(angles[most, 0]), RACE_FLOOR)
    if quantity == "film_parameter":
        films = [
            race.film(q, a, least=True)
            for number, race in enumerate(bearing.races)
            for q, a in zip(loads[:, number], angles[:, number], strict=True)
            if q > 0.0
        ]
        return Truth(float(min(films)) / scene.table("ball_bearing").roughness, RACE_FLOOR)
    K = bearing.slopes(motion)
    if quantity == "axial_stiffness":
        return Truth(float(K[2, 2]), 1e-4)
    if bearing.thrust is None:
        return Truth(K[:2, :2], 1e-4)
    return Truth(K[:2, :2] - np.outer(K[:2, 2], K[2, :2]) / K[2, 2], 1e-4)
