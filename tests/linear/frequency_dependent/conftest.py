"""Films that conserve their oil, on few cells, at rest under a load."""

import numpy as np
import pytest

from rotorfilm import FeedHole, Groove, JFOFilm, JournalBearing, equilibrium

SPEED = 314.0


def groove(angle):
    return Groove(center=np.radians(angle), width=np.radians(20.0), length=0.04)


OPENINGS = {
    "top": (groove(90.0),),
    "two": (groove(45.0), groove(225.0)),
    "hole": (FeedHole(center=np.pi / 2.0, diameter=np.sqrt(np.radians(15.0) * 0.05 * 0.01 * 4.0 / np.pi)),),
}


@pytest.fixture(scope="session")
def film_of():
    """Return a function that makes a film 50 mm long from the name of its openings and their pressure."""

    def make(opening="top", supply_pressure=0.0, cells=(36, 4)):
        bearing = JournalBearing(
            radius=0.05,
            length=0.05,
            clearance=1e-4,
            viscosity=0.02,
            grooves=OPENINGS[opening],
            supply_pressure=supply_pressure,
        )
        return JFOFilm(bearing=bearing, cells=cells)

    return make


@pytest.fixture(scope="session")
def rest_of():
    """Return a function that finds a film's rest at a load of twice `So` speed force scale, downward."""

    def find(film, So=0.5, speed=SPEED):
        return equilibrium(film, [0.0, -2.0 * So * speed * film.bearing.force_scale], speed)

    return find
