"""A steel ball of 20 mm that rolls on a rigid plane, by the reduced law of its film.

The numbers of the law lie in contact_law.json, so that the FMU is the same on every machine;
`python fmus/contact.py` computes them again.
"""

import json
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from rotorfilm import ContactGrid, ContactLaw, RollingBall, reduce_ball
from rotorfilm.core.results import to_plain

COMPONENT = "contact"
LAW = Path(__file__).with_name("contact_law.json")


def ball() -> RollingBall:
    """Return the ball: 10 N at 0.9 m/s in a thin oil, V = 0.105 and Q0 = 4.99, close to Panovko (2011)."""
    return RollingBall(
        radius=0.01, mass=0.033, modulus=206e9, poisson_ratio=0.3, viscosity=0.008,
        pressure_coefficient=5e-9, speed=0.9, load=10.0,
    )  # fmt: skip


def compute_law() -> ContactLaw:
    """Return the law from the full film on 64 x 64 cells."""
    return reduce_ball(ball(), ball().contact(ContactGrid(cells=(64, 64))), order=5)


def model() -> ContactLaw:
    """Return the law with the numbers in the file."""
    numbers = json.loads(LAW.read_text(encoding="utf-8"))
    matrices = {name: np.array(numbers[name]) for name in "ABCD"}
    return ContactLaw(**{**numbers, **matrices})


def start() -> dict[str, float]:
    """Return the start values: the approach under 10 N, where the states at rest vanish."""
    return {"z": model().operating * model().film_scale}


def stimulus() -> tuple[NDArray, NDArray]:
    """Return times [s] and the approach: a swing that grows until the ball leaves its film."""
    law = model()
    time = np.linspace(0.0, 20.0, 101) * law.time_scale
    swing = 2.5 * time / time[-1] * np.sin(1.2 * time / law.time_scale)
    return time, (law.film_scale * (law.operating + swing))[:, None]


if __name__ == "__main__":
    LAW.write_text(json.dumps(to_plain(compute_law()), indent=1) + "\n", encoding="utf-8")
    print(f"{LAW} written")
