"""Circular orbits; they live in `motion`."""

from .motion import *  # noqa: F403  (another roof over the same names)
