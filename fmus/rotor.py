"""The rotor of the scene that ships with the package, at rest in the equilibrium of its bearing."""

from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from rotorfilm.bearings.journal import MapFilm
from rotorfilm.rotors.rigid import RigidRotor
from rotorfilm.scenes import Scene, bundled_scene
from rotorfilm.scenes.export_scene import at_rest_on_film

COMPONENT = "rotor"


def scene() -> Scene:
    """Return the scene, with the film of `journal.py`."""
    bundled = bundled_scene()
    return bundled.with_tables(journal=replace(bundled.journal, film=MapFilm()))


def model() -> RigidRotor:
    """Return the rotor: 525 N at 1500 rpm, unbalanced by ISO 21940-11 grade G 6.3."""
    return at_rest_on_film(scene())[0]


def start() -> dict[str, float]:
    """Return the start values: no film force."""
    return {}


def stimulus() -> tuple[NDArray, NDArray]:
    """Return times [s] and inputs force_x, force_y: about the load, pulsating at half the speed."""
    time = np.linspace(0.0, 0.08, 101)
    angle, load = 0.5 * scene().operation.speed * time, np.hypot(*scene().static_load)
    return time, load * np.column_stack([0.2 * np.sin(angle), 1.0 + 0.3 * np.cos(angle)])
