"""Maps of grooved bearings, made once."""

import numpy as np
import pytest

from rotorfilm import Groove
from rotorfilm.bearings import FilmGeometry, aligned_openings
from rotorfilm.bearings.journal.groove_map import GrooveMap, Resolution

WIDTH = np.radians(20.0)
ONE = FilmGeometry(grooves=(Groove(center=0.7, width=WIDTH),))
TWO = FilmGeometry(grooves=(Groove(center=0.0, width=WIDTH), Groove(center=np.pi, width=WIDTH)))


@pytest.fixture(scope="session")
def one_groove():
    """Return the geometry, L/D and a coarse map of a bearing with one groove."""
    return ONE, 1.0, GrooveMap(aligned_openings(ONE), 1.0, Resolution((64, 8), (8, 48, 32), 0.95)).built()


@pytest.fixture(scope="session")
def two_grooves():
    """Return the geometry, L/D and a map of a bearing with two grooves, the better one."""
    return TWO, 0.5, GrooveMap(aligned_openings(TWO), 0.5, Resolution((96, 8), (12, 72, 48), 0.97)).built()
