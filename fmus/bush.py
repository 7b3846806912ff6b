"""The bush of Evtushenko & Kovalenko (1993) under a load: contact, temperature and wear by melting."""

import numpy as np
from numpy.typing import NDArray

from rotorfilm.bearings.bush import BushWear, f4k20_bush

COMPONENT = "bush"
MELTING_HEAT = 1e8
"""Not in the source: a round number of the right size [J/m3]."""


def model() -> BushWear:
    """Return the bush: shaft of 25 mm in a liner of F4K20, 1.5 mm thick, 100 mm long."""
    return BushWear(bush=f4k20_bush(), melting_heat=MELTING_HEAT)


def start() -> dict[str, float]:
    """Return the start values: the largest load of the source, below its critical speed."""
    return {"load": 3750.0, "speed": 3.0}


def stimulus() -> tuple[NDArray, NDArray]:
    """Return times [s] and inputs load, speed: run-up through the critical speed, then the load grows."""
    time = np.linspace(0.0, 2.0, 101)
    load = 3750.0 * (1.0 + 0.3 * np.clip(time - 1.0, 0.0, 1.0))
    return time, np.column_stack([load, 3.0 + 9.0 * np.clip(time, 0.0, 1.0)])
