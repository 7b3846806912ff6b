"""The flexible rotor of Friswell et al. (2010), section 5.9, reduced, at rest in two films."""

from dataclasses import replace
from functools import cache

import numpy as np
from numpy.typing import NDArray

from rotorfilm import (
    Disk,
    ElasticMaterial,
    JournalBearing,
    Probe,
    ShaftElement,
    ShaftRotor,
    Station,
    Unbalance,
    reduce_rotor,
    rotor_equilibrium,
)
from rotorfilm.rotors import SteadyRotor

COMPONENT = "rotor"
SPEED = 1500.0 * np.pi / 30.0


def films() -> dict[str, JournalBearing]:
    """Return the bearings that the start values belong to."""
    film = JournalBearing(radius=0.05, length=0.03, clearance=1e-4, viscosity=0.1)
    return {"left": film, "right": film}


def whole() -> ShaftRotor:
    """Return the rotor with all its states."""
    steel = ElasticMaterial(young_modulus=211e9, shear_modulus=81.2e9, density=7810.0)
    disk = {"density": 7810.0, "width": 0.07, "inner_diameter": 0.05}
    return ShaftRotor(
        elements=ShaftElement(length=1.5, outer_diameter=0.05, material=steel).split(6),
        disks=(Disk.solid(2, outer_diameter=0.28, **disk), Disk.solid(4, outer_diameter=0.35, **disk)),
        stations=(Station(node=0, name="left"), Station(node=6, name="right")),
        probes=(Probe(node=2, name="small"), Probe(node=4, name="large")),
        unbalances=(Unbalance(node=2, unbalance=1e-3),),
        speed=SPEED,
    )


@cache
def model() -> SteadyRotor:
    """Return the rotor in the 36 states that are right to 1e-3 up to 500 rad/s, at rest in its films."""
    small = reduce_rotor(whole(), frequency=500.0, tolerance=1e-3).rotor
    rest = rotor_equilibrium(small, films(), SPEED).displacement
    return SteadyRotor(rotor=replace(small, initial=(*rest.tolist(), *np.zeros(len(rest)).tolist())))


def start() -> dict[str, float]:
    """Return the start values: the forces of the films at rest."""
    loads = rotor_equilibrium(model().rotor, films(), SPEED).loads
    pairs = (
        (f"{name}_force_{axis}", -load)
        for name in loads
        for axis, load in zip("xy", loads[name], strict=True)
    )
    return {name: float(force) for name, force in pairs}


def stimulus() -> tuple[NDArray, NDArray]:
    """Return times [s] and the four forces: about the loads, pulsating at half the speed."""
    time = np.linspace(0.0, 0.04, 51)
    wave = np.sin(0.5 * SPEED * time)[:, None]
    return time, np.array(list(start().values())) + 50.0 * wave * [0.5, 1.0, -0.7, 0.8]
