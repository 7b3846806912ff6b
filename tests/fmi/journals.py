"""A journal as FMUs see it: its inputs, its outputs, and motions of it."""

from itertools import cycle

import numpy as np
import pytest

INPUTS, FORCES = ("x", "y", "vx", "vy", "speed"), ("force_x", "force_y")

OTHERS = [pytest.param(*pair, marks=pytest.mark.long) for pair in (("2.0", False), ("3.0", True))]
version_and_kind = pytest.mark.parametrize(
    ("version", "exchange"),
    [("2.0", True), ("3.0", False), *OTHERS],
    ids=["2.0-ME", "3.0-CS", "2.0-CS", "3.0-ME"],
)
"""Each version of FMI and each kind of FMU once; the other pairs are for long runs."""


def crosswise(names):
    """Return each of several names with one version of FMI, in turn, and the other pairs for long runs."""
    versions = ("2.0", "3.0")
    others = zip(names, cycle(versions[::-1]))
    return [*zip(names, cycle(versions)), *(pytest.param(*pair, marks=pytest.mark.long) for pair in others)]


def motions(count, largest):
    """Return rows of INPUTS at eccentricity ratios up to the largest, in a clearance of 0.1 mm."""
    rng = np.random.default_rng(7)
    chi, angle = rng.uniform(0.0, largest, count), rng.uniform(-np.pi, np.pi, count)
    position = 1e-4 * chi * np.stack([np.cos(angle), np.sin(angle)])
    velocity, speed = 0.01 * rng.normal(size=(2, count)), 300.0 * rng.normal(size=(1, count))
    return np.concatenate([position, velocity, speed]).T
