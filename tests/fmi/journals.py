"""A journal as FMUs see it: its inputs, its outputs, and motions of it."""

import numpy as np

INPUTS, FORCES = ("x", "y", "vx", "vy", "speed"), ("force_x", "force_y")


def motions(count, largest):
    """Return rows of INPUTS at eccentricity ratios up to the largest, in a clearance of 0.1 mm."""
    rng = np.random.default_rng(7)
    chi, angle = rng.uniform(0.0, largest, count), rng.uniform(-np.pi, np.pi, count)
    position = 1e-4 * chi * np.stack([np.cos(angle), np.sin(angle)])
    velocity, speed = 0.01 * rng.normal(size=(2, count)), 300.0 * rng.normal(size=(1, count))
    return np.concatenate([position, velocity, speed]).T
