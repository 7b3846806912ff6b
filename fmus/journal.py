"""The bearing of the scene that ships with the package, with the film of the impedance map."""

from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from rotorfilm.bearings.journal import JournalBearing, MapFilm
from rotorfilm.scenes import Scene, bundled_scene
from rotorfilm.scenes.export_scene import at_rest_on_film

COMPONENT = "bearing"


def scene() -> Scene:
    """Return the scene, with the film that runs without Python."""
    bundled = bundled_scene()
    return bundled.with_tables(journal=replace(bundled.journal, film=MapFilm()))


def model() -> JournalBearing:
    """Return the bearing: diameter 100 mm, length 30 mm, radial clearance 0.1 mm, 0.1 Pa s."""
    return scene().bearing


def start() -> dict[str, float]:
    """Return the start values: the rotor of `rotor.py` at rest in its equilibrium."""
    x, y = at_rest_on_film(scene())[0].position
    return {"x": x, "y": y, "speed": scene().operation.speed}


def stimulus() -> tuple[NDArray, NDArray]:
    """Return times [s] and inputs x, y, vx, vy, speed: an ellipse up to eccentricity 0.9, during run-up."""
    speed, clearance = scene().operation.speed, scene().journal.clearance
    time = np.linspace(0.0, 0.08, 101)
    angle, center, radii = speed * time, clearance * np.array([0.2, -0.3]), clearance * np.array([0.5, 0.4])
    x, y = center[0] + radii[0] * np.cos(angle), center[1] + radii[1] * np.sin(angle)
    vx, vy = -radii[0] * speed * np.sin(angle), radii[1] * speed * np.cos(angle)
    return time, np.column_stack([x, y, vx, vy, speed * (0.5 + time / 0.08)])
