"""Partners and schemes of the master in C beside the same in Python."""

from dataclasses import dataclass, replace

import numpy as np

from rotorfilm import JournalBearing
from rotorfilm.bearings.journal import MapFilm
from rotorfilm.cosim import Adaptive, GaussSeidel, Jacobi, Newton, SIExp, SIExp3, SIMemory
from rotorfilm.rotors import RigidRotor, SpeedProfile

SPEED, CLEARANCE = 157.0, 1e-4
STEP = np.radians(1.0) / SPEED
BEARING = JournalBearing(radius=0.05, length=0.05, clearance=CLEARANCE, viscosity=0.05, film=MapFilm())
RAMP = SpeedProfile(times=(0.0, 0.0031, 0.02), speeds=(140.0, 157.0, 120.0))


@dataclass(frozen=True, kw_only=True)
class PythonGaussSeidel(GaussSeidel):
    """The same, of a class that the loop in C does not know."""


@dataclass(frozen=True, kw_only=True)
class PythonJacobi(Jacobi):
    """The same."""


@dataclass(frozen=True)
class PythonSIExp(SIExp):
    """The same."""


@dataclass(frozen=True)
class PythonSIExp3(SIExp3):
    """The same."""


@dataclass(frozen=True)
class PythonSIMemory(SIMemory):
    """The same."""


@dataclass(frozen=True, kw_only=True)
class PythonNewton(Newton):
    """The same."""


@dataclass(frozen=True, kw_only=True)
class PythonAdaptive(Adaptive):
    """The same."""


EXPLICIT = [
    (kind(degree=degree), plain(degree=degree))
    for kind, plain in ((GaussSeidel, PythonGaussSeidel), (Jacobi, PythonJacobi))
    for degree in range(3)
]
IMPLICIT = [(SIExp(), PythonSIExp()), (SIExp3(), PythonSIExp3()), (SIMemory(), PythonSIMemory())]
REPEATING = [
    (Newton(), PythonNewton()),
    (Adaptive(tolerance=1e-4), PythonAdaptive(tolerance=1e-4)),
    (Adaptive(scheme=SIExp()), PythonAdaptive(scheme=SIExp())),
]


def rotor_at(eccentricity, unbalance, **changes):
    """Return a rotor from rest at this eccentricity ratio, with unbalance * clearance * mass."""
    load = -BEARING.force((eccentricity * CLEARANCE, 0.0), (0.0, 0.0), SPEED)
    mass = float(np.hypot(*load)) / (CLEARANCE * SPEED**2)
    rotor = RigidRotor(
        mass=mass,
        speed=SPEED,
        unbalance=unbalance * CLEARANCE * mass,
        gravity=(0.0, 0.0),
        static_force=tuple(load),
        position=(eccentricity * CLEARANCE, 0.0),
    )
    return replace(rotor, **changes)


ROTOR = rotor_at(0.6, 0.2)
